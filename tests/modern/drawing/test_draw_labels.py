"""The placement of numbers, and the text of the file: its size, its characters, directions as text."""

import itertools
import math
from fractions import Fraction
from xml.etree import ElementTree

import pytest
from hypothesis import given
from hypothesis import strategies as st

from modern.drawing.draw import draw_svg
from modern.drawing.labels import HEIGHT, Label, crosses, place_labels
from modern.drawing.scene import eye_of
from modern.drawing.svg import escape, number
from modern.geometry.mesh import ExportError
from modern.port import convex_hull
from tests.support.drawn import BOX, CUBE, EXAMPLE_6, OCTAHEDRON, SQUARE, Picture, Whole, draw

# --- labels


def boxes(picture: Picture) -> dict[str, tuple[float, float, float, float]]:
    """Return the space that each number occupies, slightly less than with the real font."""
    return {text: (x - 3.5 * len(text), y - 9.0, x + 3.5 * len(text), y) for text, (x, y) in picture.numbers().items()}


@pytest.mark.parametrize("points", [CUBE, OCTAHEDRON, EXAMPLE_6, SQUARE, BOX])
def test_numbers_are_next_to_their_vertex_and_clear_of_lines_and_each_other(points: list[Whole]) -> None:
    _, picture = draw(points)
    places, number_boxes = picture.vertices(), boxes(picture)
    lines = [*picture.edges("seen").values()]
    for text, box in number_boxes.items():
        x, y = places[int(text) - 1]
        centre = ((box[0] + box[2]) / 2, (box[1] + box[3]) / 2)
        assert math.dist(centre, (x, y)) < 24
        assert min(places, key=lambda k, c=centre: math.dist(places[k], c)) == int(text) - 1
        assert not any(crosses(line, box) for line in lines)
    for a, b in itertools.combinations(number_boxes.values(), 2):
        assert a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1]


@pytest.mark.parametrize("apart", [8.0, 12.0, 20.0, 30.0])
def test_labels_of_points_in_a_row_do_not_overlap(apart: float) -> None:
    labels = [Label(20.0 + apart * k, 50.0, str(100 + k)) for k in range(4)]
    places = place_labels(labels, [], [], (150.0, 100.0))
    for (x, y), (u, v) in itertools.combinations(places, 2):
        assert abs(x - u) >= 2 * labels[0].half[0] or abs(y - v) >= HEIGHT


def test_labels_stay_within_the_picture() -> None:
    labels = [Label(2.0, 2.0, "1"), Label(98.0, 2.0, "100"), Label(50.0, 99.0, "12")]
    for (x, y), label in zip(place_labels(labels, [], [], (100.0, 100.0)), labels, strict=True):
        assert label.half[0] <= x <= 100 - label.half[0]
        assert HEIGHT / 2 <= y <= 100 - HEIGHT / 2


@given(*[st.tuples(st.integers(-9, 9), st.integers(-9, 9))] * 2)
def test_crosses_agrees_with_exact_intersections(a: tuple[int, int], b: tuple[int, int]) -> None:
    """A line that meets a box has an end in it, or meets the line of one of its sides inside it."""
    low, high = (-3, -2), (4, 5)
    times = [Fraction(0), Fraction(1)]
    for axis in (0, 1):
        step = b[axis] - a[axis]
        times += [Fraction(end - a[axis], step) for end in (low[axis], high[axis]) if step]
    meets = any(0 <= t <= 1 and all(low[k] <= a[k] + t * (b[k] - a[k]) <= high[k] for k in (0, 1)) for t in times)
    # Touching a corner is left to rounding.
    corner = any((b[0] - a[0]) * (y - a[1]) == (b[1] - a[1]) * (x - a[0]) for x in (-3, 4) for y in (-2, 5))
    if not corner:
        assert crosses((a, b), (*low, *high)) == meets


def test_vertices_beyond_the_limit_are_not_numbered(monkeypatch) -> None:
    monkeypatch.setattr("modern.drawing.draw.MOST_NUMBERS", 20)
    curve = [(k, k * k, 0) for k in range(21)]
    _, picture = draw(curve)
    assert picture.numbers() == {}
    assert "vertices not numbered" in picture.legend()[0]
    assert draw(curve[1:])[1].numbers()


# --- the file


def test_text_is_escaped_and_numbers_are_short() -> None:
    text = draw_svg(convex_hull(CUBE), title='<a> & "b" \x00 \ud800 é 立')
    assert text.isascii()
    root = ElementTree.fromstring(text)
    assert root[0].text == '<a> & "b" ? ? é 立'
    assert escape("a<b>&c") == "a&lt;b&gt;&amp;c"
    assert [number(n) for n in (1250, 100, -5, 0, -100, 7)] == ["12.5", "1", "-0.05", "0", "-1", "0.07"]
    assert eye_of(["1", "-2.5", " 1e-3"]) == (1, Fraction(-5, 2), Fraction(1, 1000))
    with pytest.raises(ExportError, match="expected 3 numbers X,Y,Z, found 2"):
        eye_of(["1", "2"])
    with pytest.raises(ExportError, match="'x' is not a number"):
        eye_of(["1", "2", "x"])


def test_all_elements_are_within_the_size_of_the_file() -> None:
    for points in (CUBE, EXAMPLE_6, SQUARE, [(0, 0, 0), (0, 0, 1)], [(0, 0, 0), (1, 0, 0)], [(0, 0, 0)]):
        for width in (320, 640, 1000):
            root = ElementTree.fromstring(draw_svg(convex_hull(points), width=width, title="a"))
            wide, tall = int(root.attrib["width"]), int(root.attrib["height"])
            assert root.attrib["viewBox"] == f"0 0 {wide} {tall}"
            assert wide == width
            for item in root.iter():
                for names, limit in ((("x", "x1", "x2", "cx"), wide), (("y", "y1", "y2", "cy"), tall)):
                    assert all(0 <= float(item.attrib[name]) <= limit for name in names if name in item.attrib)
