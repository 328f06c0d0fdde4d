"""Tests of standard shapes, scene files, polyhedra from files and hulls, and pictures."""

import math
import re
from fractions import Fraction
from xml.etree import ElementTree

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from modern.geometry.vectors import Vector, plus
from modern.papers.nakamae_nishita.bodies import polyhedron_of_hull
from modern.papers.nakamae_nishita.hidden import Drawing, draw
from modern.papers.nakamae_nishita.picture import DASHED, PLOT_HEIGHT, PLOT_WIDTH, SOLID, as_hpgl, as_svg, ends, plot
from modern.papers.nakamae_nishita.polyhedron import SceneError, checked
from modern.papers.nakamae_nishita.projection import image, parallel
from modern.papers.nakamae_nishita.scenes import names, parse, scene
from modern.papers.nakamae_nishita.shapes import column, cuboid, parallelepiped, plate, rotation, round_base
from modern.port import convex_hull
from tests.support.paths import ROOT


def point(*numbers: int | Fraction) -> Vector:
    x, y, z = map(Fraction, numbers)
    return x, y, z


# --- shapes


@given(st.fractions(-800, 800, max_denominator=60))
def test_a_rotation_is_exact_and_close_to_its_angle(degrees: Fraction) -> None:
    cosine, sine = rotation(degrees)
    assert cosine * cosine + sine * sine == 1
    angle = math.radians(float(degrees))
    assert math.hypot(float(cosine) - math.cos(angle), float(sine) - math.sin(angle)) < math.radians(0.001)
    if degrees % 90 == 0:
        assert {abs(cosine), abs(sine)} == {0, 1}


@pytest.mark.parametrize("sides", [3, 4, 5, 17])
def test_columns_and_plates_are_convex_polyhedra_clockwise_from_outside(sides: int) -> None:
    base = round_base("c", sides, Fraction(7, 2))
    assert all(x * x + y * y == Fraction(49, 4) and z == 0 for x, y, z in base)
    for corners in (base, base[::-1]):
        for along in (point(0, 0, 2), point(1, 3, -2)):
            prism = column("c", corners, along)
            assert checked(prism) == prism
            assert (len(prism.vertices), len(prism.faces)) == (2 * sides, sides + 2)
        flat = plate("c", corners)
        assert checked(flat) == flat


@settings(max_examples=40)
@given(st.lists(st.tuples(*[st.integers(-5, 5)] * 3), min_size=3, max_size=3))
def test_the_vertices_of_a_parallelepiped_are_the_sums_of_its_edges(edges: list[tuple[int, int, int]]) -> None:
    a, b, c = (point(*edge) for edge in edges)
    volume = sum(a[k] * (b[k - 2] * c[k - 1] - b[k - 1] * c[k - 2]) for k in range(3))
    if not volume:
        with pytest.raises(SceneError, match="expected three edges that do not lie in one plane"):
            parallelepiped("p", a, b, c)
        return
    polyhedron = parallelepiped("p", a, b, c)
    assert checked(polyhedron) == polyhedron
    sums = {point(0, 0, 0)}
    for edge in (a, b, c):
        sums |= {plus(vertex, edge) for vertex in sums}
    assert sums == set(polyhedron.vertices)


def test_invalid_shapes_are_rejected() -> None:
    corner = [point(0, 0, 0), point(4, 0, 0), point(1, 1, 0), point(0, 4, 0)]
    with pytest.raises(SceneError, match=r"^c: the polygon is not convex$"):
        column("c", corner, point(0, 0, 1))
    star = [point(*p, 0) for p in ((0, 3), (2, -3), (-3, 1), (3, 1), (-2, -3))]
    with pytest.raises(SceneError, match="not convex"):
        plate("c", star)
    with pytest.raises(SceneError, match="one plane"):
        plate("c", [*corner[:2], point(1, 1, 1), corner[3]])
    with pytest.raises(SceneError, match="all lie in a line"):
        plate("c", [point(k, k, k) for k in range(3)])
    with pytest.raises(SceneError, match="at least 3 corners, found"):
        plate("c", corner[:2])
    with pytest.raises(SceneError, match="sides longer than 0"):
        cuboid("c", Fraction(1), Fraction(0), Fraction(1))
    with pytest.raises(SceneError, match="expected 3 to 1000 sides, found 2"):
        round_base("c", 2, Fraction(1))


# --- polyhedra from files and hulls


def test_a_hull_of_two_or_three_dimensions_is_a_polyhedron() -> None:
    hull = convex_hull([(0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4), (1, 1, 1), (3, 3, 3)])
    polyhedron = polyhedron_of_hull(hull, "hull")
    assert {tuple(map(str, map(int, v))) for v in polyhedron.vertices} == {hull.points[k] for k in hull.vertices}
    flat = polyhedron_of_hull(convex_hull([(0, 0, 0), (4, 0, 0), (0, 4, 0)]), "flat")
    assert len(flat.faces) == 2
    with pytest.raises(SceneError, match="a segment is not a polyhedron; expected points not on one line"):
        polyhedron_of_hull(convex_hull([(0, 0, 0), (4, 0, 0)]), "flat")


# --- scene files

HEAD = "[[part]]\nshape = "
BOX = HEAD + "'cuboid'\nsize = [1, 1, 1]\n"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "s: expected at least one part, found none"),
        ("a = = 1", "s: line 1, column 5: invalid value"),
        ("[[part]]\nshape = 'cuboid", "s: line 2, column 16"),
        ("a = 1\n" + BOX, "s: 'a' is not a known field of this table"),
        (HEAD + "'ball'", "s: part 1: shape: 'ball' is not one of cuboid, parallelepiped, column, plate, polyhedron"),
        (HEAD + "'cuboid'", "s: part 1: size: a cuboid needs the lengths of its sides"),
        (HEAD + "'cuboid'\nsize = [1, 1]", "s: part 1: size: expected a point, three numbers in brackets"),
        (HEAD + "'cuboid'\nsize = [1, 1, true]", "s: part 1: size: expected a number"),
        (HEAD + "'cuboid'\nsize = [1, 1, inf]", "s: 'inf' is not a decimal number"),
        (HEAD + "'cuboid'\nsize = [1, 1, '1/0']", "s: part 1: size: '1/0' has the denominator 0"),
        (BOX + "count = [2, 1, 1]", "s: part 1: step: several copies need the field step"),
        (BOX + "count = [200, 200, 1]\nstep = [2, 2, 2]", "at most 20,000 in all"),
        (BOX + "name = 3", "s: part 1: name: expected a string"),
        (HEAD + "'column'\nsides = 5\nheight = 2", "s: part 1: base: a column needs either a base, or"),
        (HEAD + "'column'\nsides = 5\nradius = 1", "s: part 1: height: a column needs either a height, or"),
        (HEAD + "'polyhedron'\nvertices = [[0, 0, 0]]\nfaces = [[0]]", "faces: expected vertex numbers from 1 to 1"),
        ("view = 3\n" + BOX, "s: view: expected a table"),
        ("[view]\nprojection = 'flat'\n" + BOX, "'flat' is neither parallel nor"),
        ("[view]\neye = [0, 0, 0]\n" + BOX, "view: eye: expected a direction of view other than 0,0,0"),
        (
            "[view]\nprojection = 'perspective'\neye = [3, 2, 1]\ntowards = [3, 2, 1]\n"
            + HEAD
            + "'cuboid'\nsize = [1, 1, 1]",
            "view: towards: expected a point other than the observation point in the field eye",
        ),
        ("[view]\ntowards = [1, 1, 1]\n" + BOX, "has only a direction, in the field eye"),
        (BOX + "figures = [[[0, 0, 0], [1, 1, 1], [0, 1, 0]]]", "expected all corners of a figure in one face"),
        (BOX + "figures = [[[0, 0, 0], [2, 0, 0], [0, 1, 0]]]", "expected all corners of a figure in one face"),
        (BOX + "figures = [[[0, 0, 0], [1, 0, 0]]]", "expected at least 3 corners, found 2"),
    ],
)
def test_an_invalid_scene_is_rejected_with_one_line(text: str, message: str) -> None:
    with pytest.raises(SceneError) as caught:
        parse(text, "s").make()
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_numbers_of_a_scene_are_exact() -> None:
    text = HEAD + "'cuboid'\nsize = [0.1, '1/3', 1e-40]\nat = [1_0.5, 0, 0]"
    (polyhedron,) = parse(text, "s").make()
    assert max(v[0] for v in polyhedron.vertices) == Fraction(106, 10)
    assert {v[1] for v in polyhedron.vertices} == {0, Fraction(1, 3)}
    assert {v[2] for v in polyhedron.vertices} == {0, Fraction(1, 10**40)}


def test_copies_are_rotated_moved_and_named() -> None:
    text = (
        HEAD
        + "'cuboid'\nsize = [2, 1, 1]\nturn = 90\nat = [5, 0, 0]\ncount = [2, 1, 3]\nstep = [4, 9, 2]\nobject = 'o'"
    )
    copies = parse(text, "s").make()
    assert [p.name for p in copies[:2]] == ["s: part 1, copy 1,1,1", "s: part 1, copy 1,1,2"]
    assert {p.thing for p in copies} == {"o"}
    corners = [tuple(map(min, zip(*p.vertices, strict=True))) for p in copies]
    assert corners == [(4 + 4 * i, 0, 2 * k) for i in range(2) for k in range(3)]


def test_the_scenes_of_the_project_have_the_counts_of_table_1() -> None:
    counts = {name: draw(scene(name).make(), parallel((3, -5, 2))).counts for name in names()}
    assert counts.keys() == {"columns", "cuboids", "house"}
    assert counts["cuboids"] == (60, 480, 360, 0)
    assert counts["columns"] == (11, 116, 80, 0)
    assert counts["house"][3] == 32
    with pytest.raises(
        SceneError, match="'barn' is not a scene of the project; its scenes are columns, cuboids, house"
    ):
        scene("barn")


def drawing_of(name: str, hidden: bool = False, without: tuple[str, ...] = ()) -> Drawing:
    """Draw a scene of the project from its own viewpoint."""
    return draw(scene(name).make, scene(name).sight.observer(scene(name).make), without, hidden)


def test_the_house_has_no_line_between_its_floors() -> None:
    drawing = drawing_of("house")
    lower = next(s for s in drawing.solids if "lower floor" in s.polyhedron.name)
    top = {k for k, v in enumerate(lower.polyhedron.vertices) if v[2] == 3}
    front = {k for k, v in enumerate(lower.polyhedron.vertices) if v[1] == 0}
    edge = tuple(sorted(top & front))
    assert not [p for p in drawing.pieces if p.solid == lower.number and (p.start, p.end) == edge]
    with_ghosts = drawing_of("house", without=("ghosts",))
    assert [p for p in with_ghosts.pieces if p.solid == lower.number and (p.start, p.end) == edge]


def test_the_committed_picture_of_the_house_is_up_to_date() -> None:
    committed = ROOT / "docs" / "papers" / "house.svg"
    assert committed.read_text() == as_svg(drawing_of("house"), scene("house").title)


# --- pictures


def test_the_svg_has_one_line_for_each_piece() -> None:
    drawing = drawing_of("house", hidden=True)
    root = ElementTree.fromstring(as_svg(drawing, "a <title>"))
    names_ = {item.tag.rpartition("}")[2] for item in root.iter()}
    assert names_ == {"svg", "title", "rect", "g", "line", "text"}
    groups = {item.attrib["class"]: item for item in root if "class" in item.attrib}
    for name, seen in (("seen", True), ("hidden", False)):
        drawn = [item.attrib["data-edge"] for item in groups[name]]
        expected = [f"{p.solid + 1}: {p.start + 1} {p.end + 1}" for p in drawing.pieces if p.visible == seen]
        assert set(drawn) == set(expected)
    wide, tall = int(root.attrib["width"]), int(root.attrib["height"])
    for item in groups["seen"]:
        assert all(0 <= float(item.attrib[k]) <= wide for k in ("x1", "x2"))
        assert all(0 <= float(item.attrib[k]) <= tall for k in ("y1", "y2"))


def test_svg_and_plot_are_true_to_scale() -> None:
    """In both pictures, all distances have one ratio to those between the exact images."""
    drawing = drawing_of("columns")
    root = ElementTree.fromstring(as_svg(drawing))
    lines = [item.attrib for item in root.iter() if item.tag.endswith("line")]
    drawn = [((float(a["x1"]), -float(a["y1"])), (float(a["x2"]), -float(a["y2"]))) for a in lines]
    exact = [tuple(tuple(map(float, image(end, drawing.observer))) for end in ends(drawing, p)) for p in drawing.pieces]
    plotted = strokes(as_hpgl(drawing))
    low, high = min(exact), max(exact)
    for picture, tolerance in ((drawn, 0.03), (plotted, 3)):
        assert len(picture) == len(exact)
        scale = math.dist(picture[exact.index(low)][0], picture[exact.index(high)][0]) / math.dist(low[0], high[0])
        for (a, b), (p, q) in zip(picture, exact, strict=True):
            assert b[0] - a[0] == pytest.approx(scale * (q[0] - p[0]), abs=tolerance)
            assert b[1] - a[1] == pytest.approx(scale * (q[1] - p[1]), abs=tolerance)


def strokes(text: str) -> list[tuple[tuple[int, int], tuple[int, int]]]:
    """Return the strokes of a plot by following its pen."""
    drawn, at = [], (0, 0)
    for kind, x, y in re.findall(r"(PU|PD)(\d+),(\d+);", text):
        there = (int(x), int(y))
        if kind == "PD":
            drawn.append((at, there))
        at = there
    return drawn


def test_the_plot_fits_the_sheet_and_ends_with_the_pen_up() -> None:
    text = as_hpgl(drawing_of("cuboids", hidden=True))
    assert text.startswith("IN;\nSP1;\nLT;\n")
    assert text.endswith("PU;\nSP0;\n")
    assert text.count(DASHED) == 1
    places = [place for stroke in strokes(text) for place in stroke]
    assert all(0 <= x <= PLOT_WIDTH and 0 <= y <= PLOT_HEIGHT for x, y in places)
    assert plot([(SOLID, [((0, 0), (1, 0)), ((1, 0), (1, 1))])]).count("PU") == 2
