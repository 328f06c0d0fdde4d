"""Checks of chapter 4 apart from its worked examples and proofs: theorems on sets, steps of proofs, and Fig. 3.

The equations of the proofs are transcribed as printed.
"""

from fractions import Fraction
from itertools import product

from modern.claims.algebra import Polynomial, Step, not_negative, point, polynomial, positive, term, variables, zero
from modern.claims.evidence import Check, claim, exhibited, proved, refuted, slip
from modern.claims.hulls import convex_hull, exact_hull
from modern.claims.sampled_sets import SampledSet, counterexample_points, plane_value
from modern.claims.thesis import proofs
from modern.claims.thesis.chapter4_examples import computed_checks, theorem_of, worked_example
from modern.edition.chapter4 import load_theorems


@claim("thesis.5")
def eight_theorems() -> Check:
    examples = {theorem.id for theorem in load_theorems()}
    proofs_by_name = {name[8:].replace("_", "."): f for name, f in vars(proofs).items() if name.startswith("theorem_")}
    is_complete = examples | {*proofs_by_name} == {f"4.{k}" for k in range(1, 9)}
    by_example = [check for name in examples for check in computed_checks(name).values()]
    is_valid = all(check.holds for check in (*by_example, *(proof().check() for proof in proofs_by_name.values())))
    message = f"the examples of theorems {', '.join(sorted(examples))} are right; the project proves the other theorems"
    return exhibited(is_complete and is_valid, message)


@claim("thesis.113")
def extremes_4_2() -> Check:
    points = [point.at for point in theorem_of("4.2").points]
    extremes = [choose(p[k] for p in points) for k in range(3) for choose in (max, min)]
    passed = extremes == [point[n // 2] for n, point in enumerate(points)]
    return exhibited(passed, "P1 to P6 are the extremes in x, y and z, the largest before the smallest")


@claim("thesis.117")
def inequalities_without_z() -> Check:
    (point,) = counterexample_points("point_6.csv")
    a, b, c, d = theorem_of("4.2").plane(7).coefficients
    as_printed, right = a * point[0] + b * point[1] + c, plane_value((int(a), int(b), int(c), int(d)), point)
    passed = as_printed > 0 > right and [*map(Fraction, point)] == [*theorem_of("4.2").points[5].at]
    message = f"at point 6, the value is {as_printed} as printed, and {right} with the terms in z and D"
    return slip(not passed, right < 0 and worked_example("4.2", "signs").holds, "A x + B y + C z + D", message)


@claim("thesis.123")
def sign_e() -> Check:
    p, q = counterexample_points("e_minus_one.csv")
    first = next(k for k in (q[2] - p[2], q[1] - p[1], q[0] - p[0]) if k)
    e = 1 if first > 0 else -1
    return slip(e == 1, e * e == 1, "the square of e", f"e is {e} if z decreases from P1 to P2; its square is 1")


@claim("thesis.242")
def bars_of_page_50() -> Check:
    a, b, c, p, q = 3, -2, 5, (1, 4), (3, 7)
    squares = {(x, y): _distance_squared((x, y), p, q) for x, y in product(range(-3, 4), repeat=2)}
    as_text = [d2 * (a * a + b * b) == (abs(a * x) + b * y + c) ** 2 for (x, y), d2 in squares.items()]
    return proofs.theorem_4_6().check().misprinted(not all(as_text), "absolute-value bars around A x + B y + C")


def _distance_squared(x: tuple[int, int], p: tuple[int, int], q: tuple[int, int]) -> Fraction:
    u, v = q[0] - p[0], q[1] - p[1]
    t = Fraction((x[0] - p[0]) * u + (x[1] - p[1]) * v, u**2 + v**2)
    return (p[0] + t * u - x[0]) ** 2 + (p[1] + t * v - x[1]) ** 2


@claim("thesis.138")
def choice_of_first_triangle() -> Check:
    triangle, point = [(0, 0, 0), (2, 0, 0), (0, 2, 0)], (-1, -1, 0)
    outside = sum(plane_value(facet.plane, point) > 0 for facet in exact_hull(triangle).facets)
    chosen = convex_hull([*triangle, point], history=True).history[0].added
    message = "(-1, -1) is outside two lines of the triangle (0, 0), (2, 0), (0, 2), which is not H_1"
    return exhibited(outside == 2 and {*chosen} != {0, 1, 2}, message)


@claim("thesis.260")
def outside_unreplaced_line() -> Check:
    points = counterexample_points("line_stays.csv")
    sampled = SampledSet(tuple(points), convex_hull(points, history=True), exact_hull(points))
    before, after = sampled.stages()[:2]
    checked = sampled.hull.history[1].checked
    kept = [(k, plane) for k, plane in enumerate(before.equations, 1) if k != checked and plane in after.equations]
    unreplaced = [(k, point) for k, plane in kept for point in points if plane_value(plane, point) > 0]
    message = ", ".join(f"{point[:2]} is outside line {k}" for k, point in unreplaced)
    return refuted(unreplaced, f"{message}, but the step replaces line {checked}")


# The coordinates of Fig. 3: P_3 is the origin, P_1 = (x_1, y_1) and P_2 = (x_1, y_2), with y_1 < y_2.
X1, Y1, Y2 = variables("x_1 y_1 y_2")


def _values(x: Polynomial, y: Polynomial) -> list[Polynomial]:
    """Return the left sides of equations (1), (2) and (3) of page 53 at a point."""
    return [x - X1, Y1 * x - X1 * y, X1 * y - Y2 * x]


@claim("thesis.140")
def lines_of_figure_3() -> Check:
    origin = polynomial(0)
    third, first, second = _values(origin, origin), _values(X1, Y1), _values(X1, Y2)
    on = [first[0], second[0], third[1], first[1], third[2], second[2]]
    signs = {"x_1": positive(X1), "order": positive(Y2 - Y1)}
    beside = [(third[0], term("x_1")), (second[1], term("x_1 order")), (first[2], term("x_1 order"))]
    steps = [Step("the line contains the corner", {}, zero(value)) for value in on]
    steps += [Step("the third corner is inside", signs, positive(-value), (by,)) for value, by in beside]
    argument = "The equations vanish at two corners and are negative at the third if x_1 > 0 and y_1 < y_2"
    message = "each of the three lines contains two corners and is negative at the third"
    return proved(argument, (step.is_valid() for step in steps), message)


@claim("thesis.141")
def outside_of_two_lines() -> Check:
    x, y = variables("x y")
    _, second, third = _values(x, y)
    signs = {"order": positive(Y2 - Y1), "second": positive(second), "third": positive(third)}
    step = Step("x is negative", signs, positive(-x), (term("second"), term("third")), ("order",))
    argument = "The values of lines 2 and 3 add up to (y_1 - y_2) x"
    return proved(argument, [step.is_valid()], "x is negative at a point outside both lines")


@claim("thesis.244")
def no_negative_x() -> Check:
    (x,) = variables("x")
    signs = {"x_1": positive(2 * X1), "third": not_negative(X1 * X1 - (x - X1) * (x - X1))}
    step = Step("x is not negative", signs, not_negative(x), (term("third"), term("", x)), ("x_1",))
    message = "no x is negative at a point no farther from the line x = x_1 than the origin, if x_1 is positive"
    return proved("2 x_1 x is the sum of x^2 and x_1^2 - (x - x_1)^2", [step.is_valid()], message)


@claim("thesis.142", "thesis.143")
def outside_of_line_1() -> Check:
    # The corner P_1 is the origin, and the coordinate that the linear function L gives is largest there.
    (x, y), (x2, y2), (x3, y3) = corners = [point(name, 2) for name in ("h", "q", "r")]
    slope_x, slope_y = variables("L_1 L_2")
    at_h, at_q, at_r = (slope_x * u + slope_y * v for u, v in corners)
    signs = {
        "area": positive(x2 * y3 - x3 * y2),
        "first": positive(x * y2 - x2 * y),
        "other": positive(x3 * y - x * y3),
        "end": positive(-at_q),
        "third": not_negative(-at_r),
    }
    certificate = (term("end other"), term("third first"))
    step = Step("the point is beyond the corner", signs, positive(at_h), certificate, ("area",))
    argument = "A point outside both lines is beyond their corner P_1, at which a coordinate is largest or smallest of "
    argument += "all. The same is true at P_2, because a reflection exchanges P_1 and P_2"
    return proved(argument, [step.is_valid()], "no point is outside line 1 and another line")


@claim("thesis.243")
def third_equation() -> Check:
    at_first_point = _values(X1, Y1)[2]
    message = "the third equation is 0 on the line of P_2 and P_3 but not at P_1"
    return slip(not at_first_point.terms, lines_of_figure_3().holds, "an equation of the line", message)
