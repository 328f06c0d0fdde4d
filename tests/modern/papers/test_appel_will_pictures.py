"""Pictures of Appel and Will's method: the solid, the star polygon of a line, and the planar topological map."""

import random
from collections import Counter
from fractions import Fraction
from itertools import combinations
from pathlib import Path
from xml.etree import ElementTree

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from modern.geometry.mesh import ExportError, sides
from modern.papers.appel_will import appel_will
from modern.papers.appel_will.pictures import PictureError, solid_svg, star, star_svg
from modern.papers.appel_will.planar import MOST, embedded, map_svg
from modern.papers.appel_will.results import found_solid
from tests.support.commands import call
from tests.support.paths import ROOT
from tests.support.solids import dodecahedron

CUBE = [(x, y, z) for x in (0, 2) for y in (0, 2) for z in (0, 2)]
Points = list[tuple[int, int, int]]


def texts(points: Points) -> list[tuple[str, str, str]]:
    return [(str(x), str(y), str(z)) for x, y, z in points]


def groups(picture: str) -> dict[str, list[ElementTree.Element]]:
    return {item.attrib["class"]: list(item) for item in ElementTree.fromstring(picture) if "class" in item.attrib}


def pairs(items: list[ElementTree.Element], name: str = "data-points") -> list[tuple[int, int]]:
    return [tuple(int(number) for number in item.attrib[name].split()) for item in items]


def legend(picture: str) -> str:
    return " ".join(str(item.text) for item in groups(picture)["legend"])


def scattered(seed: int, most: int = 12) -> Points:
    draw = random.Random(seed)
    return [tuple(draw.randrange(-4, 5) for _ in range(3)) for _ in range(draw.randrange(4, most))]


# --- the star polygon


@settings(deadline=None, max_examples=40)
@given(st.integers(0, 10**6))
def test_c_is_outside_of_the_star_polygon_of_exactly_the_convex_edges(seed: int) -> None:
    points = scattered(seed, 9)
    hull = appel_will(points)
    live = set(range(len(points))) - {d.point for d in hull.deleted} - {k for k, _ in hull.duplicates}
    for pair in combinations(sorted(live), 2):
        polygon = star(hull, pair)
        assert polygon.outside == (pair in hull.edges)
        assert len(polygon.clockwise) <= 1
        assert sorted((*polygon.line, *polygon.order)) == sorted(live)
        # The images are in the order of their angles, so only the clockwise sides turn right.
        images = polygon.images
        turns = [a[0] * b[1] - a[1] * b[0] for a, b in zip(images, (*images[1:], *images[:1]), strict=True)]
        assert [k for k, turn in enumerate(turns) if turn < 0] == list(polygon.clockwise)


def test_the_star_polygon_of_a_cubes_edge_and_of_its_diagonal() -> None:
    edge, across = (groups(star_svg(appel_will(CUBE), pair)) for pair in ((0, 1), (0, 7)))
    assert sorted(str(item.text) for item in edge["numbers"]) == ["3,4", "5,6", "7,8", "C = 1-2"]
    assert len(edge["clockwise"]) == 1
    assert "clockwise" not in across
    assert len(across["star"]) == 6
    assert len(across["rays"]) == 6
    assert "is inside or on a side; the line is not a convex edge" in legend(star_svg(appel_will(CUBE), (0, 7)))
    caption = legend(star_svg(appel_will(CUBE), (0, 1)))
    assert "Star polygon of line 1-2, seen along the line: C, the image of the line, is outside (one side" in caption


@pytest.mark.parametrize(
    ("pair", "message"),
    [
        ((0, 9), "point 10 does not exist; the points are 1 to 6"),
        ((-1, 2), "point 0 does not exist; the points are 1 to 6"),
        ((2, 2), "a line needs two different points, found 3 twice"),
        ((0, 4), "point 5 was deleted: it lies between points 1 and 2"),
        ((5, 1), "point 6 was deleted: it equals point 1"),
    ],
)
def test_a_star_polygon_needs_two_existing_points(pair: tuple[int, int], message: str) -> None:
    hull = appel_will([(0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4), (2, 0, 0), (0, 0, 0)])
    with pytest.raises(PictureError, match=f"^{message}$"):
        star(hull, pair)


# --- the solid


@pytest.mark.parametrize("name", ["fig14", "fig18", "fig23"])
def test_the_solid_shows_its_convex_edges_and_the_other_given_lines(name: str) -> None:
    solid = found_solid(name)
    hull = appel_will(solid.points, solid.surfaces)
    parts = groups(solid_svg(hull, texts(list(solid.points)), solid.surfaces, title=name))
    drawn = pairs(parts["seen"] + parts.get("hidden", []), "data-vertices")
    drawn_edges = {tuple(sorted((hull.vertices[a - 1], hull.vertices[b - 1]))) for a, b in drawn}
    assert drawn_edges == set(hull.edges)
    assert len(drawn) == len(hull.edges)
    lines = {(min(a, b), max(a, b)) for surface in solid.surfaces for a, b in sides(surface)}
    nonconvex = lines - set(hull.edges)
    assert {(a - 1, b - 1) for a, b in pairs(parts.get("given", []))} == nonconvex
    assert sorted(int(str(item.text)) for item in parts["lines"]) == list(range(1, len(hull.edges) + 1))
    numbers = [number for item in parts["numbers"] for number in str(item.text).split(",")]
    assert sorted(map(int, numbers)) == list(range(1, len(solid.points) + 1))
    legend_rows = str([item.text for item in parts["more"]])
    assert ("given line that is not a convex edge" in legend_rows) == bool(nonconvex)


# --- the map


def crosses(p, q, r, s) -> bool:
    """Return True if two segments cross at a point inside both, decided by exact areas."""

    def area(a, b, c) -> Fraction:
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    return area(p, q, r) * area(p, q, s) < 0 and area(r, s, p) * area(r, s, q) < 0


@settings(deadline=None, max_examples=10)
@example(560)
@given(st.integers(0, 10**6))
def test_no_two_lines_of_the_map_cross_and_every_region_is_convex(seed: int) -> None:
    hull = appel_will(scattered(seed, 16))
    if hull.dimension < 3:
        return
    surfaces = hull.outward()
    for outer in range(min(3, len(surfaces))):
        places = {k: (Fraction(x), Fraction(y)) for k, (x, y) in embedded(surfaces, outer).items()}
        assert len(set(places.values())) == len(hull.vertices)
        for (a, b), (c, d) in combinations(hull.edges, 2):
            assert len({a, b, c, d}) < 4 or not crosses(places[a], places[b], places[c], places[d])
        signs = Counter()
        for order, surface in enumerate(surfaces):
            ring = [places[k] for k in surface]
            for p, q, r in zip(ring, ring[1:] + ring[:1], ring[2:] + ring[:2], strict=True):
                turn = (q[0] - p[0]) * (r[1] - q[1]) - (q[1] - p[1]) * (r[0] - q[0])
                # The positions are floats of size 1; a turn below 1e-9 may have the wrong sign and cannot be seen.
                if abs(turn) > 1e-9:
                    signs[order == outer, turn > 0] += 1
        assert len(signs) == 2, signs


def test_the_map_has_every_line_point_and_surface_once() -> None:
    solid = found_solid("fig23")
    hull = appel_will(solid.points, solid.surfaces)
    parts = groups(map_svg(hull.surfaces, hull.edges, "a map"))
    assert sorted(pairs(parts["seen"])) == sorted((a + 1, b + 1) for a, b in hull.edges)
    assert sorted(int(str(item.text)) for item in parts["numbers"]) == sorted(k + 1 for k in hull.vertices)
    assert sorted(int(str(item.text)) for item in parts["lines"]) == list(range(1, len(hull.edges) + 1))
    outside = max(range(len(hull.surfaces)), key=lambda k: (len(hull.surfaces[k]), -k)) + 1
    numbers = {int(str(item.text)) for item in parts["surfaces"]}
    assert numbers == set(range(1, len(hull.surfaces) + 1)) - {outside}
    assert f"surface {outside} is the outside." in legend(map_svg(hull.surfaces, hull.edges, "a map"))


def test_a_polygon_has_a_map_and_maps_that_cannot_be_drawn_are_rejected() -> None:
    square = appel_will([(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)])
    assert [item.text for item in groups(map_svg(square.surfaces, square.edges))["surfaces"]] == ["1"]
    with pytest.raises(PictureError, match=r"^expected a hull with surfaces, found none: there is no map to draw$"):
        map_svg(appel_will([(0, 0, 0), (4, 0, 0)]).surfaces, ())
    ring = tuple(range(MOST + 1))
    with pytest.raises(PictureError, match=rf"^a map of {MOST + 1} points cannot be drawn legibly"):
        map_svg((ring, ring[::-1]), ())
    with pytest.raises(ExportError, match="9 pixels wide"):
        map_svg(square.surfaces, square.edges, width=9)


@pytest.mark.parametrize(
    ("name", "options"),
    [("solid", ()), ("star", ("--star-of", "5-6", "--width", "480")), ("map", ("--map", "--width", "480"))],
)
def test_the_committed_pictures_are_current(name: str, options: tuple[str, ...], tmp_path: Path, capsys) -> None:
    drawn = tmp_path / "drawn.svg"
    assert call(capsys, "appel-will", "appel-will/fig18", "-o", str(drawn), *options)[0] == 0
    assert drawn.read_text() == (ROOT / "docs" / "papers" / f"appel_will_{name}.svg").read_text()


# --- the command


@pytest.fixture
def folder(tmp_path: Path, monkeypatch) -> Path:
    monkeypatch.chdir(tmp_path)
    draw = random.Random(5)
    rows = [",".join(str(draw.randrange(-99, 100)) for _ in range(3)) for _ in range(70)]
    Path("many.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
    Path("d.csv").write_text("".join(f"{x!r},{y!r},{z!r}\n" for x, y, z in dodecahedron()), encoding="utf-8")
    return tmp_path


def test_the_command_draws_all_three(folder: Path, capsys) -> None:
    pictures = []
    for options in ((), ("--map",), ("--star-of", "1-7"), ("--eye", "1,2,3"), ("--map", "--width", "900")):
        code, out, err = call(capsys, "appel-will", "appel-will/fig23", "-o", "a.svg", *options)
        assert (code, err) == (0, "")
        assert "Convex edge list" in out
        ElementTree.parse("a.svg")
        pictures.append(Path("a.svg").read_text(encoding="utf-8"))
    assert len(set(pictures)) == 5
    code, out, err = call(capsys, "appel-will", "appel-will/fig23", "-o", "-", "--map")
    assert (code, "Convex edge list" in err) == (0, True)
    ElementTree.fromstring(out)


def test_more_than_50_points_are_summarised(folder: Path, capsys) -> None:
    code, out, err = call(capsys, "appel-will", "many.csv")
    assert (code, err) == (0, "")
    lines = out.splitlines()
    assert len(lines) == 5
    assert lines[0] == "many.csv: 70 points"
    assert lines[2].startswith("convex edge list: ")
    assert lines[3].startswith("loop table: ")
    assert lines[3].endswith(" with 3 lines)")
    assert lines[4] == "for all tables add --all"
    everything = call(capsys, "appel-will", "many.csv", "--all")[1]
    edges = int(lines[2].split()[3])
    start = everything.splitlines().index("Convex edge list")
    assert everything.splitlines()[start + 1 + edges].split()[0] == str(edges)
    assert "IUC(L)" in call(capsys, "appel-will", "many.csv", "--trace")[1]


def test_merged_faces_match_the_faces_of_the_file(folder: Path, capsys) -> None:
    assert call(capsys, "export", "d.csv", "-o", "d.off", "--coplanar-within", "1e-9")[0] == 0
    assert "added: " in call(capsys, "appel-will", "d.off")[1]
    code, out, err = call(capsys, "appel-will", "d.off", "--coplanar-within", "1e-9", "-o", "e.off")
    assert (code, err.count("\n")) == (0, 1)
    assert err.startswith("note: d.off: 36 faces are joined into 12 within 1e-9; ")
    assert "Topological map, faces within 1e-9 of one plane merged\nsurface 1: " in out
    assert out.count(": kept as surface") == 12
    assert "added" not in out
    assert Path("e.off").read_text(encoding="utf-8").splitlines()[1] == "20 12 30"
    flat = call(capsys, "appel-will", "appel-will/fig23", "--coplanar-within", "0")
    assert "no two of 7 faces lie within 0 of one plane" in flat[2]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("-o", "a.stl"), "a.stl: appel-will expects a name that ends with .off or .svg"),
        (("--map",), "--map draws a picture: add -o FILE.svg"),
        (("--map", "-o", "a.off"), "--map draws a picture: add -o FILE.svg"),
        (("--star-of", "1-2", "-o", "a.off"), "--star-of draws a picture"),
        (("--star-of", "1", "-o", "a.svg"), "--star-of: expected a line I-J by the numbers of its points, found '1'"),
        (("--star-of", "1-99", "-o", "a.svg"), "point 99 does not exist"),
        (("--star-of", "1-2", "--map", "-o", "a.svg"), "not allowed with argument"),
        (("--eye", "1,2,3"), "--eye applies only to a picture"),
        (("--eye", "1,2,3", "-o", "a.off"), "--eye applies only to a picture"),
        (("--eye", "1,2,3", "--map", "-o", "a.svg"), "--eye applies only to a picture of the solid"),
        (("--eye", "1,2", "-o", "a.svg"), "the direction of view: expected 3 numbers X,Y,Z, found 2"),
        (("--width", "5", "-o", "a.svg"), "5 pixels wide"),
        (("--width", "500"), "--width applies only to a picture"),
        (("--coplanar-within", "99", "-o", "a.svg"), "d.csv: all points lie within 99 of the plane"),
        (("--coplanar-within", "x", "-o", "a.svg"), "'x' is not a decimal number"),
    ],
)
def test_invalid_options_are_rejected(folder: Path, options: tuple[str, ...], message: str, capsys) -> None:
    code, out, err = call(capsys, "appel-will", "d.csv", *options)
    assert (code, out, err.count("\n")) == (2, "", 1), err
    assert message in err
    assert not list(folder.glob("a.*"))
