"""Compute each published result of Nakamae and Nishita, as lines worded like those in the paper."""

from collections.abc import Iterator, Sequence
from fractions import Fraction

from modern.drawing.visible import line_through, sign
from modern.papers import Lines
from modern.papers.nakamae_nishita.contours import Tables, tables, values
from modern.papers.nakamae_nishita.crossings import clipped
from modern.papers.nakamae_nishita.hidden import Drawing, draw
from modern.papers.nakamae_nishita.projection import Homogeneous, parallel
from modern.papers.nakamae_nishita.scenes import names, scene

Place = tuple[int, int]
_SQUARE: tuple[Place, ...] = ((0, 0), (0, 4), (4, 4), (4, 0))
_NUMBERS = ("none", "one", "two", "three", "four")
_OTHER_SIDE = (Fraction(-34), Fraction(37), Fraction(41))


def produced(_: Lines) -> Lines:
    """Return the lines of each published result that can be computed, by the result's id in ``results.toml``."""
    lines: dict[str, Sequence[str]] = dict(_crossing_numbers())
    drawings = {name: drawing(name) for name in names()}
    most = max(
        len(passage.marks) for item in drawings.values() for course in item.passages for _, passage in course.behind
    )
    # Section 3.5: a line meets the boundary of a convex contour at most twice.
    lines["intersections"] = [f"intersection between a contour line and a segment is no more than {_NUMBERS[most]}"]
    lines["sense"] = [f"{_contour_sense()} \\times (P_A - P_B)"]
    # Rows (a) and (b) of Table 1 have the same counts, so one scene is drawn from two directions.
    lines["table1-a"] = [_row("a", drawings["columns"])]
    columns = [item.polyhedron for item in drawings["columns"].solids]
    lines["table1-b"] = [_row("b", draw(columns, parallel(_OTHER_SIDE)))]
    lines["table1-c"] = [_row("c", drawings["cuboids"])]
    return lines


def drawing(name: str) -> Drawing:
    """Draw one of the project's scenes as seen from the direction that the scene states."""
    file = scene(name)
    return draw(file.make, file.sight.observer(file.make))


def contour_tables(v: Sequence[Place], w: Sequence[Place]) -> Tables:
    """Return the paper's tables PL and LP for two overlapping polygons whose corners run clockwise."""
    of_v, of_w = values(_lines(v), _points(w)), values(_lines(w), _points(v))
    assert of_v is not None
    assert of_w is not None
    return tables(of_v, of_w)


def _crossing_numbers() -> Iterator[tuple[str, Sequence[str]]]:
    """Compute d of formula (3), which tells how two segments meet, for the four cases that section 3.2 lists.

    One segment is a side of a square, from (0, 4) to (4, 4). The other segment is the first side of a polygon.
    """
    upper = 1
    for name, meaning, polygon in (
        ("d-crossing", "means that $[P_i, P_{i+1}]$ intersects", ((2, 2), (2, 6), (6, 6), (6, 2))),
        ("d-on-segment", "means that a vertex lies on another line segment", ((2, 4), (3, 6), (6, 6), (3, 2))),
        ("d-on-vertex", "means that a vertex overlaps a vertex", ((4, 4), (6, 3), (2, 1))),
        ("d-apart", "means not to intersect", ((2, 2), (2, 3), (6, 3), (6, 2))),
    ):
        yield name, [f"${contour_tables(_SQUARE, polygon).crossing_number(upper, 0)}$ {meaning}"]


def _contour_sense() -> str:
    """Return the vector along a contour that formula (6) needs, ``(P_i - P_{i+1})`` or its opposite.

    The product of this vector with P_A - P_B must have the sign of the index of an intersection: positive if the
    segment enters the contour. The print does not tell in which direction formula (6) traverses a contour, so an
    example decides.
    """
    start, end, a, b = (0, 0), (0, 4), (-1, 1), (1, 2)
    # The segment from A to B crosses the square's left side inward, so formula (6) must be positive.
    of_square = values(_lines(_SQUARE), _points((a, b)))
    assert of_square is not None
    ((_, index),) = clipped(of_square, 0, 1).marks
    for difference, (x, y) in (
        ("(P_i - P_{i+1})", (start[0] - end[0], start[1] - end[1])),
        ("(P_{i+1} - P_i)", (end[0] - start[0], end[1] - start[1])),
    ):
        if sign(x * (a[1] - b[1]) - y * (a[0] - b[0])) == sign(index):
            return difference
    raise AssertionError("expected formula (6) to be positive for one of the two directions of the contour")


def _row(letter: str, scene_drawing: Drawing) -> str:
    return " ".join((f"({letter})", *map(str, scene_drawing.counts)))


def _points(places: Sequence[Place]) -> tuple[Homogeneous, ...]:
    return tuple((x, y, 0, 1) for x, y in places)


def _lines(places: Sequence[Place]) -> list[tuple[int, int, int]]:
    flat = [(x, y, 1) for x, y in places]
    return [line_through(a, b) for a, b in zip(flat, [*flat[1:], flat[0]], strict=True)]
