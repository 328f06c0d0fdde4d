"""Options of a picture: numbers, hidden parts, differences from a punched result, the construction."""

import json
import re
from collections.abc import Sequence
from pathlib import Path
from xml.etree import ElementTree

import pytest

from modern.comparison.difference import CardDifferences, UnrelatedCards, card_differences
from modern.drawing.against import draw_against
from modern.drawing.draw import Show, draw_svg
from modern.drawing.stages import frames, played, strip
from modern.edition.programs import loader
from modern.formats.export import export_text
from modern.geometry.hull import Hull
from modern.geometry.mesh import ExportError
from modern.port import convex_hull
from modern.thesis.cards import read_hull
from modern.thesis.job import run_hull
from tests.support.commands import call
from tests.support.judged import deck_of

SVG = "{http://www.w3.org/2000/svg}"
BOX = [(4 * x, 4 * y, 4 * z) for x in (0, 1) for y in (0, 1) for z in (0, 1)] + [(2, 2, 2), (2, 0, 2), (1, 2, 2)]
SOLID = [(9, -3, 4), (-8, 2, 7), (5, 8, -9), (-7, -9, -2), (3, 6, 8), (-2, 7, -6), (1, 0, 1), (6, -8, -7)]


def groups(text: str) -> dict[str, list[ElementTree.Element]]:
    """Return the elements of a picture by the class of their group, at any depth."""
    by_class: dict[str, list[ElementTree.Element]] = {}
    for group in ElementTree.fromstring(text).iter(f"{SVG}g"):
        by_class.setdefault(group.get("class", ""), []).extend(group)
    return by_class


def numbers(text: str) -> set[str]:
    return {name for element in groups(text).get("numbers", []) for name in str(element.text).split(",")}


def test_vertices_hidden_parts_and_other_points_are_drawn_on_request() -> None:
    hull = convex_hull(SOLID)
    assert hull.vertices != tuple(sorted(hull.vertices))
    count = len(hull.vertices)
    assert numbers(draw_svg(hull)) == {str(k) for k in range(1, count + 1)}
    assert numbers(draw_svg(hull, show=Show("input"))) == {str(index + 1) for index in hull.vertices}
    assert numbers(draw_svg(hull, show=Show("none"))) == set()
    assert "not numbered" not in draw_svg(hull, show=Show("none"))
    hull = convex_hull(BOX)
    whole = groups(draw_svg(hull))
    assert {"hidden", "vertices-hidden", "inside"} <= whole.keys()
    front = groups(draw_svg(hull, show=Show(hidden=False)))
    assert not {"hidden", "vertices-hidden", "boundary-hidden"} & front.keys()
    assert len(front["seen"]) == len(whole["seen"])
    assert len(numbers(draw_svg(hull, show=Show(hidden=False)))) == 7
    bare = groups(draw_svg(hull, show=Show(points=False)))
    assert not {"inside", "boundary", "boundary-hidden"} & bare.keys()
    assert "hidden" in bare


def test_a_crowded_picture_is_wider_with_smaller_type_and_no_hidden_numbers() -> None:
    hull = convex_hull([(x, y, x * x + y * y) for x in range(-6, 7) for y in range(-5, 6)])
    assert len(hull.vertices) > 120
    text = draw_svg(hull)
    root = ElementTree.fromstring(text)
    assert root.get("width") == "1000"
    assert 'font-size="9"' in text
    hidden = len(groups(text)["vertices-hidden"])
    assert hidden
    assert len(numbers(text)) <= len(hull.vertices) - hidden
    assert ElementTree.fromstring(draw_svg(hull, width=700)).get("width") == "700"


# --- comparison with a punched result


def punched(points: Sequence[tuple[int, int, int]]) -> list[str]:
    return list(run_hull(deck_of(points), loader(())).final.result.punched)


@pytest.mark.parametrize("points", [SOLID, [(0, 0, 1), (4, 0, 1), (4, 5, 1), (0, 5, 1), (1, 1, 1), (2, 0, 1)]])
def test_a_correct_result_has_no_differences(points: list[tuple[int, int, int]]) -> None:
    hull = convex_hull(points)
    claim = card_differences(read_hull(punched(points)), hull, "cards")
    assert claim == CardDifferences()
    assert "no differences" in draw_against(hull, claim)


def test_missing_vertices_and_false_faces_of_cards_are_drawn() -> None:
    hull, cards = convex_hull(SOLID), punched(SOLID)
    first = cards.index(next(card for card in cards if card.startswith("  1 ")))
    complete = read_hull(cards)
    incomplete = read_hull([card for k, card in enumerate(cards) if k != first])
    claim = card_differences(incomplete, hull, "cards")
    removed = tuple(map(float, complete.vertices[0]))
    index = next(i for i, p in enumerate(hull.points) if tuple(map(float, p)) == removed)
    assert claim.missed == (index,)
    equation = next(k for k, card in enumerate(cards) if k > first + len(complete.vertices) and card.startswith("  1 "))
    turned = list(cards)
    turned[equation] = turned[equation][:4] + "   .10000000E+01   .10000000E+01   .10000000E+01  -.90000000E+02"
    claim = card_differences(read_hull(turned), hull, "cards")
    assert len(claim.not_found) == len(claim.polygons) == 1
    assert set(claim.polygons[0]) == set(hull.faces[claim.not_found[0]].polygon)
    text = draw_against(hull, claim)
    drawn = groups(text)
    assert len(drawn["not-found"]) == len(drawn["no-face"]) == 1
    assert "1 missing face" in text
    assert "1 false face" in text


def test_differences_of_points_are_drawn_and_explained() -> None:
    hull = convex_hull(BOX)
    claim = CardDifferences(missed=hull.vertices[:2], added=hull.inside[:1], others=3)
    text = draw_against(hull, claim, show=Show(points=False))
    drawn = groups(text)
    assert [str(ring[0].text).split(":")[0] for ring in drawn["missed"]] == ["missing vertex"] * 2
    assert f"point {hull.inside[0] + 1}" in str(drawn["added"][0][0].text)
    assert "not drawn: 3" in text


def test_unrelated_cards_and_segments_without_stages_are_refused() -> None:
    hull = convex_hull(BOX)
    with pytest.raises(UnrelatedCards, match=r"x.punch: these cards have no vertices"):
        card_differences(read_hull(["", "N=  3"]), hull, "x.punch")
    with pytest.raises(UnrelatedCards, match=r"x.punch: \d of the points on these cards are not among the points"):
        card_differences(read_hull(punched(SOLID)), hull, "x.punch")
    assert len(frames(staged([(0, 0, 0), (5, 0, 0), (6, 4, 0), (2, 7, 0), (-3, 4, 0), (2, 2, 0)]))) > 1
    with pytest.raises(ExportError, match="no stages"):
        frames(staged([(0, 0, 0), (1, 1, 1), (2, 2, 2)]))


# --- the construction


def staged(points: Sequence[tuple[int, int, int]]) -> Hull:
    return convex_hull(points, history=True)


def test_every_stage_has_the_hull_of_the_vertices_so_far() -> None:
    hull = staged(SOLID)
    stages = frames(hull)
    assert len(stages) == len(hull.history) > 2
    assert set(stages[-1].hull.points) == {hull.points[index] for index in hull.vertices}
    for frame, stage in zip(stages, hull.history, strict=True):
        assert len(frame.hull.faces) <= len(stage.equations)
        assert len(frame.added) == len(stage.added)
        assert frame.caption[0].startswith(f"H{stage.number}: point")
    assert len({frame.picture.view.eye for frame in stages}) == 1
    assert stages[-1].waiting == ()


def test_the_last_stage_shows_every_point_as_vertex_inside_or_boundary_point() -> None:
    flat_top = [(0, 0, 0), (6, 0, 0), (0, 6, 0), (0, 0, 6), (1, 1, 1), (2, 2, 2), (3, 3, 0), (6, 6, 6)]
    hull = staged(flat_top)
    last = frames(hull)[-1]
    assert last.waiting == ()
    assert len(last.boundary) == len(hull.boundary) > 0
    assert len(last.struck) == len(hull.inside) > 0
    numbers = groups(strip(frames(hull)))["numbers"]
    assert [number.text for number in numbers] == [str(index + 1) for stage in hull.history for index in stage.added]


@pytest.mark.parametrize("columns", [1, 2, 3])
def test_the_legend_of_the_stages_fits_into_the_picture(columns: int) -> None:
    flat_top = [(0, 0, 0), (6, 0, 0), (0, 6, 0), (0, 0, 6), (1, 1, 1), (2, 2, 2), (3, 3, 0), (6, 6, 6)]
    text = strip(frames(staged(flat_top), width=212), columns=columns)
    picture = ElementTree.fromstring(text)
    width, height = float(picture.get("width")), float(picture.get("height"))
    names = [entry for entry in groups(text)["legend"] if entry.text]
    assert [entry.text for entry in names][-1] == "on the boundary"
    # A letter of 12 pixels is about 6.6 pixels wide.
    assert all(float(entry.get("x")) + 6.6 * len(entry.text) <= width for entry in names)
    assert all(float(entry.get("y")) < height for entry in names)


def test_strip_and_animation_contain_all_stages() -> None:
    construction = frames(staged(SOLID))
    text = strip(construction, "solid")
    assert len(groups(text)["words"]) >= len(construction)
    assert ElementTree.fromstring(text).find(f"{SVG}title").text == "solid"
    moving = played(construction)
    stages = [g for g in ElementTree.fromstring(moving).iter(f"{SVG}g") if "stage" in g.get("class", "").split()]
    assert len(stages) == len(construction)
    assert stages[-1].get("class") == "stage end"
    delays = [float(re.findall(r"([\d.]+)s", g.get("style", ""))[0]) for g in stages]
    assert delays == sorted(set(delays))
    assert "prefers-reduced-motion" in moving


# --- the command


def test_draw_command_accepts_every_option(tmp_path: Path, capsys, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("s.csv").write_text("".join(f"{x},{y},{z}\n" for x, y, z in SOLID), encoding="utf-8")
    assert call(capsys, "cards", "s.csv", "-o", "s.deck")[0] == 0
    assert call(capsys, "hull", "s.deck", "--punch", "s.punch", "--typewriter", "s.typed")[0] == 0
    code, out, err = call(capsys, "draw", "s.csv", "--against", "s.punch", "--labels", "input", "--width", "800")
    assert (code, err) == (0, "")
    assert "no differences" in out
    assert 'width="800"' in out
    for option in ("--stages", "--animate"):
        code, out, err = call(capsys, "draw", "s.csv", option)
        assert (code, err) == (0, "")
        assert "H2: point" in out
    assert call(capsys, "draw", "s.csv", "--no-hidden", "--no-points")[0] == 0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["s.csv", "--stages", "--width", "400"], "--stages and --animate cannot be combined with --width"),
        (["-", "--against", "-"], "points and cards cannot both come from standard input"),
        (["s.csv", "--against", "s.csv"], "these cards have no vertices"),
        (["s.csv", "--width", "10"], "a picture cannot be 10 pixels wide"),
    ],
)
def test_draw_command_reports_errors_in_one_line(arguments, message, tmp_path, capsys, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("s.csv").write_text("0,0,0\n1,0,0\n0,1,0\n0,0,1\n", encoding="utf-8")
    code, out, err = call(capsys, "draw", *arguments)
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert message in err


# --- the interactive page


def test_interactive_page_contains_the_solid_and_loads_nothing() -> None:
    hull = convex_hull(BOX)
    text = export_text(hull, "html")
    data = json.loads(text.split('id="hull">')[1].split("</script>")[0])
    assert len(data["points"]) == 8
    assert {frozenset(face) for face in data["faces"]} == {
        frozenset(hull.vertices.index(i) for i in face.polygon) for face in hull.faces
    }
    assert all(abs(x) <= 0.5 for point in data["points"] for x in point)
    assert "http" not in text.replace("http://www.w3.org/2000/svg", "")
    assert "<td>1</td><td>" in text
    with pytest.raises(ExportError, match="too large"):
        export_text(convex_hull([("1e400", "0", "0"), ("0", "1", "0")]), "html")
