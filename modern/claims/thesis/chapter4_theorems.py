"""Checks of chapter 4 apart from its worked examples and proofs: theorems on sets, steps of proofs, and figures 1 to 4.

The equations of the proofs are transcribed as printed.
"""

from collections.abc import Sequence
from fractions import Fraction
from itertools import product
from random import Random

from modern.claims.evidence import Check, Generator, claim, exhibited, refuted, searched, slip
from modern.claims.sampled_sets import (
    CASES,
    SETS,
    TRIPLES,
    Point,
    SampledSet,
    counterexample_points,
    plane_through,
    plane_value,
    random_triples,
    sampled_sets,
)
from modern.claims.thesis import proofs
from modern.claims.thesis.chapter3_steps import value_v
from modern.claims.thesis.chapter4_examples import theorem_of
from modern.edition.chapter4 import load_theorems
from modern.exact_hull import exact_hull
from modern.geometry.vectors import cross, dot, minus
from modern.port import convex_hull


@claim("thesis.5")
def eight_theorems() -> Check:
    """Check that theorems 4.1 to 4.8 each have a worked example or a proof."""
    examples = {theorem.id for theorem in load_theorems()}
    proved = {name[8:].replace("_", ".") for name in vars(proofs) if name.startswith("theorem_")}
    check = exhibited(examples | proved == {f"4.{k}" for k in range(1, 9)}, "all eight are checked")
    gap = gap_in_4_7()
    return check.unless(gap.evidence.violation, f"one step of the proof of 4.7: {gap.evidence.violation}")


@claim("thesis.108")
def three_points_coplanar() -> Check:
    message = "six triples of points lie in a plane"
    return searched(TRIPLES, 6, [exact_hull(three).dimension < 3 for three in random_triples()], message)


@claim("thesis.113")
def extremes_4_2() -> Check:
    """Check that P1 to P6 of theorem 4.2 are, in this order, the points with the largest and smallest x, y and z."""
    points = [point.at for point in theorem_of("4.2").points]
    passed = all(
        points[2 * k][k] == max(p[k] for p in points) and points[2 * k + 1][k] == min(p[k] for p in points)
        for k in range(3)
    )
    return exhibited(passed, "P1 to P6 are the extremes in x, y and z, the largest before the smallest")


@claim("thesis.117")
def inequalities_without_z() -> Check:
    """Check that the printed inequality A x + B y + C < 0, which lacks z and D, is false at point 6 for equation 7."""
    (point,) = counterexample_points("point_6.csv")
    a, b, c, d = theorem_of("4.2").plane(7).coefficients
    as_printed, right = a * point[0] + b * point[1] + c, plane_value((int(a), int(b), int(c), int(d)), point)
    passed = as_printed > 0 > right and [*map(Fraction, point)] == [*theorem_of("4.2").points[5].at]
    return slip(
        not passed,
        right < 0,
        "A x + B y + C z + D",
        f"at point 6: {as_printed} as printed, {right} with the terms in z and D",
    )


@claim("thesis.287")
def display_of_page_41() -> Check:
    """Check that V is right with the indices of the proof, and that the formula as our text of page 41 has it is 0."""
    value_check = value_v()
    as_text = []
    for (x1, y1, z1), (x2, y2, z2), _ in random_triples():
        first_term = (y2 - y1) * (z2 - z1) - (z2 - z1) * (y2 - y1)
        as_text.append(first_term**2 + ((z2 - z1) * (x2 - x1) - (x2 - x1) * (z2 - z1)) ** 2)
    check = searched(TRIPLES, 6, [value_check.evidence.correction], "with y_i and z_i, V is as in the proof")
    return check.misprinted(not any(as_text), "i for 1 in the differences from the point i")


@claim("thesis.121", "thesis.122", "thesis.124", "thesis.235")
def distance_by_cosines() -> Check:
    """Check that V is (e D)^2 times d^2, the square of the distance by three determinants with direction cosines."""
    checks = []
    for p, q, x in random_triples():
        u, w = minus(q, p), minus(q, x)
        square = dot(u, u)
        # Page 42: the distance of x from the line, by the three two-row determinants of w and u.
        rows = [(w[1], w[2], u[1], u[2]), (w[2], w[0], u[2], u[0]), (w[0], w[1], u[0], u[1])]
        d_squared = sum((Fraction(a * f - b * e) ** 2 / square for a, b, e, f in rows), Fraction(0))
        across = cross(u, minus(x, p))
        checks.append(d_squared * square == dot(across, across) and square == sum(k * k for k in u))
    return searched(TRIPLES, 6, checks, "the formula gives the exact distance for six triples of points")


@claim("thesis.120", "thesis.234")
def display_of_page_42() -> Check:
    """Check the distance by direction cosines, and that the display of our text, with lost signs, is wrong."""
    as_text = []
    for p, q, x in random_triples():
        u, w = minus(q, p), minus(q, x)
        across = cross(u, minus(x, p))
        garbled = (w[1] * u[2] - u[2] * u[1]) ** 2 + 2 * (u[0] * u[1] - u[1] * u[2]) ** 2
        as_text.append(garbled == dot(across, across))
    check = distance_by_cosines()
    return check.misprinted(not any(as_text), "three determinants or brackets, with the indices of V")


@claim("thesis.123")
def sign_e() -> Check:
    """Check that the sign e, chosen as page 42 says, is not always 1: it is -1 for the line of the counterexample."""
    p, q = counterexample_points("e_minus_one.csv")
    first = next(k for k in (q[2] - p[2], q[1] - p[1], q[0] - p[0]) if k)
    e = 1 if first > 0 else -1
    return slip(e == 1, e * e == 1, "e squared", f"e is {e} if z decreases from P1 to P2; its square is 1")


# The generator of proof_of_4_4, which itself draws two points and a point that divides their segment.
SHARES: Generator[int] = Generator("two points of a plane and a share between them", 44, lambda r: r.randint(1, 9))


@claim("thesis.128", part="coefficient")
@claim("thesis.129", part="sum")
@claim("thesis.130", part="letters")
def proof_of_4_4(part: str) -> Check:
    """Check that C_0 of page 46 is the C of (3.4), and is 0 for a point k between two others.

    part: ``coefficient``, C_0 equals C; ``sum``, the ten printed terms add up to 0; ``letters``, with z for y the
    formula gives -B, and with z for x it gives -A. These signs do not matter because both must be 0.
    """
    if part == "letters":
        message = "the formulas give -B and -A for six triples of points"
        return searched(TRIPLES, 6, [_letters(*three) for three in random_triples()], message)
    random = Random(44)
    coefficient, total, terms = [], [], []
    for _ in range(6):
        xa, ya, xb, yb = (Fraction(random.randint(-9, 9)) for _ in range(4))
        share = Fraction(random.randint(1, 9), 10)
        xk, yk = (1 - share) * xa + share * xb, (1 - share) * ya + share * yb
        c = _c_0((xa, ya), (xb, yb), (xk, yk))
        coefficient.append(c == (xb - xa) * (yk - ya) - (yb - ya) * (xk - xa))
        rest = 1 - share
        # Page 46: the ten printed terms, and the four terms that substituting the coordinates of k gives.
        printed = [xa * yb, -xa * yb * share, -xa * yb * rest, xa * yb * rest, xa * yb * share, -xa * yb]
        printed += [xa * ya * share, -xa * ya * share, xb * yb * rest, -xb * yb * rest]
        total.append(sum(printed) == 0 == c)
        substituted = [xb * ya * rest, xb * yb * share, ya * xa * rest, ya * xb * share]
        terms.append(sorted(printed) == sorted([xa * yb, *substituted]))
    if part == "coefficient":
        return searched(SHARES, 6, coefficient, "C_0 equals the C of (3.4) in six cases")
    check = searched(SHARES, 6, total, "the printed sum is 0, like the C of (3.4), with other terms")
    return check.misprinted(not any(terms), "x_b y_a in the terms that lack it in print")


def _c_0(a: tuple[Fraction, ...], b: tuple[Fraction, ...], k: tuple[Fraction, ...]) -> Fraction:
    """Return C_0 of three points of the x-y plane as page 46 prints it."""
    (xa, ya), (xb, yb), (xk, yk) = a, b, k
    return xa * yb + xb * yk + ya * xk - yb * xk - xa * yk - xb * ya


def _letters(p: Point, q: Point, r: Point) -> bool:
    """Return True if C_0 with z for y is -B, and with z for x is -A, of the plane through the points."""

    def printed(u: int, v: int) -> int:
        (ua, va), (ub, vb), (uk, vk) = ((point[u], point[v]) for point in (p, q, r))
        return ua * vb + ub * vk + va * uk - vb * uk - ua * vk - ub * va

    a, b, c, _ = plane_through(p, q, r)
    return (printed(0, 1), printed(0, 2), printed(2, 1)) == (c, -b, -a)


@claim("thesis.74", "thesis.131", "thesis.238", full=400)
def theorem_4_5(cases: int = CASES) -> Check:
    """Check that each H_j of a flat set is bounded by its lines: each has two vertices on it and none beyond it."""
    checks = []
    for sampled in sampled_sets(2, cases):
        for stage in sampled.stages():
            judge = exact_hull([sampled.points[k] for k in stage.vertices])
            checks.append(
                len(stage.equations) == len(stage.vertices) and _touches(sampled, stage.equations, stage.vertices)
            )
            checks.append(len({*judge.vertices}) <= len(stage.vertices))
    message = f"in {len(checks) // 2} stages no vertex is beyond a line, and each line contains at least two vertices"
    return searched(SETS[2], cases, checks, message)


def _touches(sampled: SampledSet, equations: Sequence[tuple[int, int, int, int]], vertices: Sequence[int]) -> bool:
    values = [[plane_value(plane, sampled.points[k]) for k in vertices] for plane in equations]
    return all(max(row) == 0 and row.count(0) >= 2 for row in values)


@claim("thesis.242")
def bars_of_page_50() -> Check:
    """Check the distance from a line as page 50 gives it: it needs absolute value bars around all three terms."""
    a, b, c, p, q = 3, -2, 5, (1, 4), (3, 7)
    as_text = [
        _distance_squared((x, y), p, q) * (a * a + b * b) == (abs(a * x) + b * y + c) ** 2
        for x, y in product(range(-3, 4), repeat=2)
    ]
    return proofs.theorem_4_6().check().misprinted(not all(as_text), "bars around all three terms")


def _distance_squared(x: tuple[int, int], p: tuple[int, int], q: tuple[int, int]) -> Fraction:
    along = q[0] - p[0], q[1] - p[1]
    t = Fraction((x[0] - p[0]) * along[0] + (x[1] - p[1]) * along[1], along[0] ** 2 + along[1] ** 2)
    return (p[0] + t * along[0] - x[0]) ** 2 + (p[1] + t * along[1] - x[1]) ** 2


@claim("thesis.90", "thesis.137", "thesis.142", "thesis.143", "thesis.259", full=400)
def theorem_4_7(cases: int = CASES) -> Check:
    """Check that a point is outside at most one line of each H_j of flat sets."""
    numbers = [
        sum(plane_value(plane, point) > 0 for plane in stage.equations)
        for sampled in sampled_sets(2, 2 * cases)
        for stage in sampled.stages()
        for point in sampled.points
    ]
    message = f"in {len(numbers)} pairs of a point and a stage, a point is outside at most {max(numbers)} line"
    return searched(SETS[2], 2 * cases, [number <= 1 for number in numbers], message)


@claim("thesis.138")
def choice_of_first_triangle() -> Check:
    """Check that a point may be outside two lines of a triangle that is not chosen by the rule for H_1."""
    triangle, point = [(0, 0, 0), (2, 0, 0), (0, 2, 0)], (-1, -1, 0)
    outside = sum(plane_value(facet.plane, point) > 0 for facet in exact_hull(triangle).facets)
    return exhibited(outside == 2, "(-1, -1) is outside two lines of the triangle (0, 0), (2, 0), (0, 2)")


@claim("thesis.145")
def gap_in_4_7() -> Check:
    """Check a case that the proof of 4.7 does not exclude: outside one line of H_k, but two lines of H_k+1."""
    square = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)]
    lines = [facet.plane for facet in exact_hull(square).facets]
    after = [facet.plane for facet in exact_hull([*square, (5, 2, 0)]).facets]
    new = [plane for plane in after if plane not in lines]
    # Search for a point outside at most one line of the square, but outside a new line and another line.
    point = next(
        (x, y, 0)
        for x in range(-9, 14)
        for y in range(-9, 14)
        if sum(plane_value(plane, (x, y, 0)) > 0 for plane in lines) <= 1
        and any(plane_value(plane, (x, y, 0)) > 0 for plane in new)
        and sum(plane_value(plane, (x, y, 0)) > 0 for plane in after) > 1
    )
    case = f"({point[0]}, {point[1]}), outside at most one line of a square, and outside two after (5, 2) is added"
    return theorem_4_7().unless(point, case)


@claim("thesis.260")
def outside_unreplaced_line() -> Check:
    """Check the counterexample: a point is outside a line of H_1 that is not replaced and so is a line of H_2 too."""
    points = counterexample_points("line_stays.csv")
    sampled = SampledSet(tuple(points), convex_hull(points, history=True), exact_hull(points))
    before, after = sampled.stages()[:2]
    checked = sampled.hull.history[1].checked
    unreplaced = [
        (k + 1, point)
        for k, plane in enumerate(before.equations)
        for point in points
        if k + 1 != checked and plane_value(plane, point) > 0 and plane in after.equations
    ]
    message = ", ".join(f"{point[:2]} is outside line {k}" for k, point in unreplaced)
    return refuted(unreplaced, f"{message}; the line replaced is line {checked}")


@claim("thesis.244", full=400)
def origin_is_third_point(cases: int = CASES) -> Check:
    """Check that no point has a negative x if P_3 is the origin and the line P_1 P_2 is parallel to the y axis."""
    checks = []
    for sampled in sampled_sets(2, cases):
        p, q, r = sampled.hull.history[0].added
        (line,) = (
            e
            for e, d in zip(sampled.stages()[0].equations, sampled.hull.history[0].equations, strict=True)
            if r not in d
        )
        checks += [plane_value(line, point) >= plane_value(line, sampled.points[r]) for point in sampled.points]
        checks.append(
            plane_value(line, sampled.points[p])
            == plane_value(line, sampled.points[q])
            == 0
            > plane_value(line, sampled.points[r])
        )
    return searched(SETS[2], cases, checks, f"{len(checks)} conditions on points and their x hold")
