"""Tests of the near plane of a perspective: polyhedra are clipped exactly, and those behind it are reported."""

import random
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from modern.exact_hull import exact_hull
from modern.papers.nakamae_nishita.clipping import Clipped, beyond_near
from modern.papers.nakamae_nishita.hidden import draw
from modern.papers.nakamae_nishita.picture import as_svg
from modern.papers.nakamae_nishita.polyhedron import Figure, Polyhedron, SceneError, checked
from modern.papers.nakamae_nishita.projection import Observer, parallel, perspective
from modern.papers.nakamae_nishita.scenes import Sight, parse, scene
from modern.papers.nakamae_nishita.shapes import cuboid, moved, placed, plate
from tests.support.commands import call
from tests.support.paths import ROOT
from tests.support.scenes_at_random import hull_of, vector
from tests.support.visibility import Judge, wrong

EYE = vector(0, -10, 0)


def looking(near: Fraction | int | str) -> Observer:
    return perspective(EYE, vector(0, 0, 0), Fraction(near))


def box(low, high, name: str = "box") -> Polyhedron:
    size = [Fraction(b) - Fraction(a) for a, b in zip(low, high, strict=True)]
    return placed(cuboid(name, *size), moved(vector(*low)), name)


def clip(polyhedron: Polyhedron, near: Fraction | int | str) -> Clipped:
    return beyond_near([polyhedron], looking(near))


@settings(deadline=None, max_examples=30)
@given(st.integers(0, 10**6))
def test_a_clipped_polyhedron_is_the_hull_of_the_vertices_beyond_and_the_crossings(seed: int) -> None:
    """Compare with the exact hull of crossings of all segments between two vertices, not only of the edges."""
    source = random.Random(seed)
    points = [vector(*(source.randint(-4, 4) for _ in range(3))) for _ in range(source.randint(4, 9))]
    polyhedron = hull_of(points, "p")
    assume(polyhedron is not None)
    assert polyhedron is not None
    # The near plane is y = level, because the eye looks along the y axis.
    level = Fraction(source.randint(-8, 8), 2)
    if all(p[1] <= level for p in polyhedron.vertices):
        with pytest.raises(SceneError, match="expected a polyhedron beyond the near plane"):
            clip(polyhedron, level + 10)
        return
    clipped = clip(polyhedron, level + 10)
    beyond = [p for p in polyhedron.vertices if p[1] >= level]
    crossed = [
        tuple(a + (level - p[1]) / (q[1] - p[1]) * (b - a) for a, b in zip(p, q, strict=True))
        for p in polyhedron.vertices
        for q in polyhedron.vertices
        if p[1] < level < q[1]
    ]
    (remainder,) = clipped.polyhedra
    places = [*beyond, *crossed]
    expected = exact_hull(places)
    assert set(remainder.vertices) == {tuple(places[index]) for index in expected.vertices}
    assert len(remainder.faces) == len(expected.facets)
    assert checked(remainder) == remainder
    assert clipped.cut == (("p",) if any(p[1] < level for p in polyhedron.vertices) else ())


@pytest.mark.parametrize("seed", range(6))
def test_the_drawing_of_a_clipped_scene_agrees_with_the_judge(seed: int) -> None:
    source = random.Random(seed)
    polyhedra = [
        box((x, y, z), (x + source.randint(1, 3), y + source.randint(1, 3), z + source.randint(1, 3)), f"{x}{y}{z}")
        for x in (-4, 0, 4)
        for y in (-4, 0, 4)
        for z in (-4, 0)
    ]
    eye = vector(source.randint(-2, 2), -9, source.randint(-2, 3))
    observer = perspective(eye, vector(0, 0, source.randint(-1, 1)), Fraction(source.randint(10, 27), 2))
    drawing = draw(polyhedra, observer)
    assert drawing.cut
    remaining = [solid.polyhedron for solid in drawing.solids]
    assert len(remaining) == len(polyhedra) - len(drawing.behind)
    assert wrong(drawing, Judge(remaining, point=eye))[0] == []


def test_the_distance_is_measured_along_the_direction_of_view() -> None:
    """The distance is exact if the length of the direction is rational, and otherwise within a relative 1e-15."""
    observer = perspective(vector(0, 0, 0), vector(3, 4, 0), Fraction(5))
    (remainder,) = beyond_near([box((0, 0, 0), (20, 20, 1))], observer).polyhedra
    assert {3 * x + 4 * y for x, y, _ in remainder.vertices if 3 * x + 4 * y <= 25} == {25}
    slanted = perspective(vector(0, 0, 0), vector(1, 1, 1), Fraction(2))
    (remainder,) = beyond_near([box((0, 0, 0), (9, 9, 9))], slanted).polyhedra
    (level,) = {sum(p) for p in remainder.vertices if sum(p) < 5}
    assert 0 <= 12 - level * level < Fraction(1, 10**13)


def test_a_polyhedron_that_the_plane_only_touches_is_not_clipped() -> None:
    solid = box((0, 0, 0), (2, 2, 2))
    assert clip(solid, 10) == Clipped((solid,))
    with pytest.raises(
        SceneError, match=r"^expected a polyhedron beyond the near plane, but all polyhedra lie on its near side$"
    ):
        clip(solid, 12)
    clipped = beyond_near([solid, box((5, 5, 5), (6, 6, 6), "far")], looking(12))
    assert ([p.name for p in clipped.polyhedra], clipped.cut, clipped.behind) == (["far"], (), ("box",))
    assert beyond_near([solid], parallel((0, -1, 0))) == Clipped((solid,))


def test_plates_figures_and_merged_faces_are_clipped() -> None:
    flat = plate("plate", [vector(0, y, z) for y, z in ((-2, 0), (2, 0), (2, 2), (-2, 2))])
    (remainder,) = clip(flat, 11).polyhedra
    assert (len(remainder.faces), {p[1] for p in remainder.vertices}) == (2, {1, 2})
    side = box((0, -2, 0), (2, 2, 2))
    order = next(k for k, face in enumerate(side.faces) if all(side.vertices[p][0] == 2 for p in face))
    front = next(k for k, face in enumerate(side.faces) if all(side.vertices[p][1] == -2 for p in face))
    triangle = (vector(2, -1, 1), vector(2, 1, 1), vector(2, 1, "3/2"))
    window = (vector(1, -2, 1), vector("3/2", -2, 1), vector(1, -2, "3/2"))
    figures = (
        Figure(order, triangle),
        Figure(front, window),
        Figure(order, tuple(vector(2, "-3/2", k) for k in (0, 1, 2))),
        Figure(order, (vector(2, -1, 1), vector(2, 0, 1), vector(2, 0, "3/2"))),
    )
    solid = Polyhedron("s", side.vertices, side.faces, figures=figures, joined=tuple(range(6)))
    (remainder,) = clip(solid, 10).polyhedra
    assert [figure.corners for figure in remainder.figures] == [(vector(2, 0, 1), *triangle[1:], vector(2, 0, "5/4"))]
    assert {remainder.vertices[p][0] for p in remainder.faces[remainder.figures[0].face]} == {2}
    assert len(set(remainder.joined)) == len(remainder.faces) == 6
    assert {remainder.vertices[p][1] for p in remainder.faces[-1]} == {0}


SCENE = """[view]
projection = "perspective"
eye = [0, -10, 1]
towards = [0, 0, 1]
near = 8
[[part]]
name = "near"
shape = "cuboid"
size = [2, 1, 2]
at = [-6, -9, 0]
[[part]]
name = "across"
shape = "cuboid"
size = [2, 9, 2]
at = [0, -5, 0]
"""


def test_the_command_reports_clipped_and_omitted_parts(tmp_path: Path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    Path("s.toml").write_text(SCENE, encoding="utf-8")
    code, _, err = call(capsys, "hidden-line", "s.toml", "-o", "a.svg")
    assert code == 0
    assert err.splitlines()[:2] == [
        "note: 1 part cut by the near plane: s.toml: part 2 (across)",
        "note: 1 part omitted behind the near plane: s.toml: part 1 (near)",
    ]
    assert call(capsys, "hidden-line", "s.toml", "--near", "1/2", "-o", "b.svg")[2].startswith("polyhedra ")
    assert Path("a.svg").read_text(encoding="utf-8") != Path("b.svg").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("old", "new", "arguments", "message"),
    [
        ("near = 8", "near = 0", (), "s.toml: view: near: expected a distance greater than 0"),
        ('projection = "perspective"\n', "", (), "towards: a parallel projection has only a direction, in the field"),
        ('projection = "perspective"\neye', "eye", ("--towards", "1,2,3"), "towards: a parallel projection"),
        (
            "near = 8",
            "near = 99",
            (),
            "expected a polyhedron beyond the near plane, but all polyhedra lie on its near side",
        ),
        ("near = 8", "", ("--near", "0"), "--near: expected a distance greater than 0, found '0'"),
        ("near = 8", "", ("--near", "a"), "--near: 'a' is not a decimal number"),
        ("near = 8", "", ("--near", "-1"), "--near: expected a distance greater than 0, found '-1'"),
    ],
)
def test_invalid_near_planes_are_rejected(tmp_path, monkeypatch, capsys, old, new, arguments, message) -> None:
    monkeypatch.chdir(tmp_path)
    Path("s.toml").write_text(SCENE.replace(old, new), encoding="utf-8")
    code, _, err = call(capsys, "hidden-line", "s.toml", *arguments, "-o", "a.svg")
    assert (code, err.count("\n"), Path("a.svg").exists()) == (2, 1, False), err
    assert message in err


def test_a_near_plane_is_for_perspective_only_and_is_suggested_there(capsys) -> None:
    with pytest.raises(SceneError, match="view: near: a parallel projection has no near plane"):
        parse("[view]\nnear = 1\n[[part]]\nshape = 'cuboid'\nsize = [1, 1, 1]", "s")
    code, _, err = call(capsys, "hidden-line", "house", "--near", "2")
    assert (code, err) == (2, "hull1620: --near needs --perspective; a parallel projection has only a direction\n")
    with pytest.raises(
        SceneError, match=r"^box: not entirely in front of the observation point; set a near plane to clip it$"
    ):
        draw([box((-1, -11, -1), (1, 1, 1))], perspective(EYE, vector(0, 0, 0)))


def test_the_committed_picture_of_the_clipped_house_is_up_to_date() -> None:
    sight = Sight(vector(40, -35, 30), "perspective", vector(4, 5, 1), Fraction(53))
    make = scene("house").make
    picture = as_svg(draw(make, sight.observer(make)), "The house cut by a near plane")
    assert (ROOT / "docs" / "papers" / "section.svg").read_text() == picture
