"""Checks of the figures of chapter 4 and of the last points of theorem 4.8."""

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from modern.claims.algebra import Point, Polynomial, Step, Term, polynomial, positive, term, variables, zero
from modern.claims.evidence import Check, claim, exhibited, proved, slip
from modern.claims.thesis.chapter4_examples import ADDED, theorem_of
from modern.exact_hull import exact_hull

# The coordinates of Fig. 3: P_3 is the origin, P_1 = (x_1, y_1) and P_2 = (x_1, y_2), with y_1 < y_2.
X1, Y1, Y2 = variables("x_1 y_1 y_2")


def _values(x: Polynomial, y: Polynomial) -> list[Polynomial]:
    return [a * x + b * y + c for a, b, c in _printed_lines(X1, Y1, Y2)]


@claim("thesis.140", "thesis.139")
def lines_of_figure_3() -> Check:
    """Prove that each printed line of Fig. 3 contains two corners of the triangle and is negative at the third."""
    origin = polynomial(0)
    third, first, second = _values(origin, origin), _values(X1, Y1), _values(X1, Y2)
    on = [first[0], second[0], third[1], first[1], third[2], second[2]]
    signs = {"x_1": positive(X1), "order": positive(Y2 - Y1)}
    beside = [(third[0], term("x_1")), (second[1], term("x_1 order")), (first[2], term("x_1 order"))]
    steps = [Step("the line contains the corner", {}, zero(value)) for value in on]
    steps += [Step("the third corner is inside", signs, positive(-value), (by,)) for value, by in beside]
    argument = "The equations vanish at two corners and are negative at the third if x_1 > 0 and y_1 < y_2"
    return proved(argument, (step.is_valid() for step in steps), "all three lines are outward")


@claim("thesis.141")
def outside_of_two_lines() -> Check:
    """Prove that a point outside both lines 2 and 3 of Fig. 3 has a negative x if y_1 is less than y_2."""
    x, y = variables("x y")
    _, second, third = _values(x, y)
    signs = {"order": positive(Y2 - Y1), "line 2": positive(second), "line 3": positive(third)}
    terms = tuple(Term((name,), polynomial(1)) for name in ("line 2", "line 3"))
    step = Step("x is negative", signs, positive(-x), terms, ("order",))
    check = proved("The values of lines 2 and 3 add up to (y_1 - y_2) x", [step.is_valid()], "x is negative")
    case = replace(step, hypotheses={**signs, "order": positive(Y1 - Y2)}).refuting_values(seed=1963)
    return check.unless(case is not None, "points outside of both lines of a triangle with y_1 greater than y_2")


@claim("thesis.243")
def third_equation() -> Check:
    """Check that the third equation of H_1 is that of a line: it is not 0 at all points of the triangle's plane."""
    at_first_point = _values(X1, Y1)[2]
    message = "the third equation is 0 on the line of P_2 and P_3 but not at P_1"
    return slip(not at_first_point.terms, lines_of_figure_3().holds, "a line", message)


def _printed_lines(x1: Polynomial, y1: Polynomial, y2: Polynomial) -> tuple[Point, ...]:
    """Return the coefficients of equations (1), (2) and (3) of page 53."""
    one, none = polynomial(1), polynomial(0)
    return (one, none, -x1), (y1, -x1, none), (-y2, x1, none)


@claim("thesis.148")
def single_point_outside() -> Check:
    """Check that only one of the nine points of theorem 4.8 is outside H_5 and the other eight are its vertices."""
    theorem = theorem_of("4.8")
    eight = [[*point.at] for point in theorem.points if point.name in ADDED]
    hull = exact_hull(eight)
    planes = [hull.plane_of(facet) for facet in hull.facets]
    beyond = {p.name for p in theorem.points if any(_at(plane, p.at) > 0 for plane in planes)}
    message = "only Q9 is outside; the other eight points are the vertices of H_5"
    return exhibited(beyond == {"Q9"} and len(hull.vertices) == len(eight) == 8, message)


def _at(plane: Sequence[Fraction | int], point: Sequence[Fraction]) -> Fraction:
    return sum((Fraction(a) * x for a, x in zip(plane, (*point, Fraction(1)), strict=True)), Fraction(0))
