"""Checks of the figures of chapter 4 and of the last points of theorem 4.8."""

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations, product

from modern.claims.evidence import Check, claim, exhausted, exhibited, slip
from modern.claims.thesis.chapter3_stages import stage_property
from modern.claims.thesis.chapter4_examples import ADDED, theorem_of
from modern.exact_hull import exact_hull

# x_1, y_1 and y_2 of triangles with y_1 < y_2.
TRIANGLES = ((3, -1, 2), (5, -4, -1), (2, 1, 6))


@claim("thesis.140")
def lines_of_figure_3() -> Check:
    """Check that the printed lines are outward, with P_3 at the origin, P_1 = (x1, y1), P_2 = (x1, y2) and y1 < y2."""
    checks = []
    for x1, y1, y2 in TRIANGLES:
        for a, b, c in _printed_lines(x1, y1, y2):
            values = [a * x + b * y + c for x, y in ((0, 0), (x1, y1), (x1, y2))]
            checks.append(max(values) == 0 and values.count(0) == 2)
    return exhausted("lines of three triangles", checks, f"{len(checks)} lines are outward")


@claim("thesis.141")
def outside_of_two_lines() -> Check:
    """Check that a point outside of lines 2 and 3 has a negative x if y_1 is less than y_2."""

    def xs(x1: int, y1: int, y2: int) -> list[int]:
        lines = _printed_lines(x1, y1, y2)[1:]
        return [x for x, y in product(range(-6, 7), repeat=2) if all(a * x + b * y + c > 0 for a, b, c in lines)]

    outcomes = [x < 0 for triangle in TRIANGLES for x in xs(*triangle)]
    check = exhausted("points of a grid outside two lines of three triangles", outcomes, "all have a negative x")
    return check.unless(max(xs(3, 2, -1)) > 0, "a triangle with y_1 greater than y_2")


@claim("thesis.243")
def third_equation() -> Check:
    """Check the third equation of H_1, which has no z: it is that of a line of the plane."""
    return slip(False, lines_of_figure_3().holds, "a line", "the equation has x and y only, as the other two")


def _printed_lines(x1: int, y1: int, y2: int) -> tuple[tuple[int, int, int], ...]:
    """Return the equations (1), (2) and (3) of page 53."""
    return (1, 0, -x1), (y1, -x1, 0), (-y2, x1, 0)


@claim("thesis.148")
def single_point_outside() -> Check:
    """Check that exactly one of the nine points is outside H_5 and that the other eight are its vertices."""
    theorem = theorem_of("4.8")
    eight = [[*point.at] for point in theorem.points if point.name in ADDED]
    hull = exact_hull(eight)
    planes = [hull.plane_of(facet) for facet in hull.facets]
    beyond = {p.name for p in theorem.points if any(_at(plane, p.at) > 0 for plane in planes)}
    message = "only Q9 is outside; the other eight points are the vertices of H_5"
    return exhibited(beyond == {"Q9"} and len(hull.vertices) == len(eight) == 8, message)


def _at(plane: Sequence[Fraction | int], point: Sequence[Fraction]) -> Fraction:
    return sum((Fraction(a) * x for a, x in zip(plane, (*point, Fraction(1)), strict=True)), Fraction(0))


@claim("thesis.114", number="1")
@claim("thesis.134", number="2")
@claim("thesis.139", number="3")
@claim("thesis.144", number="4")
def figure(number: str) -> Check:
    return {"1": _figure_1, "2": _added_triangle, "3": lines_of_figure_3, "4": _added_triangle}[number]()


def _figure_1() -> Check:
    theorem = theorem_of("4.2")
    sides: dict[frozenset[str], int] = {}
    for plane in theorem.planes:
        for pair in combinations(plane.vertices, 2):
            sides[frozenset(pair)] = sides.get(frozenset(pair), 0) + 1
    v, e, f = len(theorem.points), len(sides), len(theorem.planes)
    closed = set(sides.values()) == {2} and v - e + f == 2
    beyond = sum(any(plane.at(p) > 0 for p in theorem.points) for plane in theorem.planes)
    message = f"{v} vertices, {e} edges and {f} faces form a closed surface; {beyond} faces have a vertex beyond them"
    return exhibited(closed and beyond > 0, message)


def _added_triangle() -> Check:
    replaced_lines = stage_property("replaced_line")
    return exhibited(replaced_lines.holds, f"each step removes one line and adds two: {replaced_lines.message}")
