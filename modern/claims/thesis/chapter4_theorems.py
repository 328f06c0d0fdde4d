"""Checks of chapter 4 apart from its worked examples: theorems 4.3 to 4.7, steps of the proofs, and figures 1 to 4.

Theorems are checked on small sets. The equations of the proofs are transcribed as printed.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations, product
from random import Random

from modern.claims.evidence import Check, claim, exhibited, holds_if, refuted
from modern.claims.sampled_sets import (
    CASES,
    Point,
    SampledSet,
    counterexample_points,
    plane_through,
    plane_value,
    random_triples,
    sampled_sets,
)
from modern.claims.thesis.chapter3_stages import stage_property
from modern.claims.thesis.chapter3_steps import value_v
from modern.claims.thesis.chapter4_examples import ADDED, theorem_of
from modern.claims.thesis.projections import theorem_4_4
from modern.edition.chapter4 import load_theorems
from modern.exact_hull import exact_hull
from modern.geometry.vectors import cross, dot, minus
from modern.port import convex_hull


@claim("thesis.5")
def eight_theorems() -> Check:
    """Check that theorems 4.1 to 4.8 each have a worked example or a check here."""
    examples = {theorem.id for theorem in load_theorems()}
    proofs = {"4.3": theorem_4_3, "4.4": theorem_4_4, "4.5": theorem_4_5, "4.6": theorem_4_6, "4.7": theorem_4_7}
    passed = examples | proofs.keys() == {f"4.{k}" for k in range(1, 9)} and gap_in_4_7().holds
    message = "theorems 4.1 to 4.8 are all checked; one step of the proof of 4.7 does not follow"
    return holds_if(passed, message, conditional=True)


@claim("thesis.108")
def three_points_coplanar() -> Check:
    message = "six triples of points lie in a plane"
    return holds_if(all(exact_hull(three).dimension < 3 for three in random_triples()), message)


@claim("thesis.113")
def extremes_4_2() -> Check:
    """Check that the six points are the extremes in x, y and z in the order of the theorem."""
    points = [point.at for point in theorem_of("4.2").points]
    passed = all(
        points[2 * k][k] == max(p[k] for p in points) and points[2 * k + 1][k] == min(p[k] for p in points)
        for k in range(3)
    )
    return holds_if(passed, "P1 to P6 are the extremes in x, y and z, the largest before the smallest")


@claim("thesis.117")
def inequalities_without_z() -> Check:
    """Check the printed inequality A x + B y + C < 0 for point 6 and equation 7."""
    (point,) = counterexample_points("point_6.csv")
    a, b, c, d = theorem_of("4.2").plane(7).coefficients
    as_printed, right = a * point[0] + b * point[1] + c, plane_value((int(a), int(b), int(c), int(d)), point)
    passed = as_printed > 0 > right and [*map(Fraction, point)] == [*theorem_of("4.2").points[5].at]
    return refuted(passed, f"at point 6 equation 7 has the value {as_printed} as printed, and {right} with z and D")


@claim("thesis.119")
def theorem_4_3() -> Check:
    """Check that V orders points by their distance from the line: V is the distance squared times D squared."""
    value_check = value_v()
    as_text = []
    for (x1, y1, z1), (x2, y2, z2), _ in random_triples():
        first_term = (y2 - y1) * (z2 - z1) - (z2 - z1) * (y2 - y1)
        as_text.append(first_term**2 + ((z2 - z1) * (x2 - x1) - (x2 - x1) * (z2 - z1)) ** 2)
    return holds_if(
        value_check.holds and not any(as_text),
        f"{value_check.message}; as displayed in our text of p. 41 it is 0 at every point",
        conditional=True,
    )


@claim("thesis.120", kind="display")
@claim("thesis.121", "thesis.122", "thesis.124", "thesis.235")
@claim("thesis.234", kind="substituted")
def distance_by_cosines(kind: str = "") -> Check:
    """Check that d squared, by three determinants with direction cosines, times (e D)^2 is V.

    With any ``kind`` the display in our text, which has lost signs and indices, is compared as well.
    """
    checks, as_text = [], []
    for p, q, x in random_triples():
        u, w = minus(q, p), minus(q, x)
        square = dot(u, u)
        # Page 42: the distance of x from the line, by the three two-row determinants of w and u.
        rows = [(w[1], w[2], u[1], u[2]), (w[2], w[0], u[2], u[0]), (w[0], w[1], u[0], u[1])]
        d_squared = sum((Fraction(a * f - b * e) ** 2 / square for a, b, e, f in rows), Fraction(0))
        across = cross(u, minus(x, p))
        checks.append(d_squared * square == dot(across, across) and square == sum(k * k for k in u))
        garbled = (w[1] * u[2] - u[2] * u[1]) ** 2 + 2 * (u[0] * u[1] - u[1] * u[2]) ** 2
        as_text.append(Fraction(garbled, square) == d_squared)
    if kind:
        passed = all(checks) and not any(as_text)
        message = "the formula agrees exactly for six triples of points; the display in our text agrees for none"
        return holds_if(passed, message, conditional=True)
    return holds_if(all(checks), "the formula agrees exactly for six triples of points")


@claim("thesis.123")
def sign_e() -> Check:
    """Check the sign e of the counterexample's line, chosen as page 42 says."""
    p, q = counterexample_points("e_minus_one.csv")
    first = next(k for k in (q[2] - p[2], q[1] - p[1], q[0] - p[0]) if k)
    e = 1 if first > 0 else -1
    return refuted(e == -1 and e * e == 1, f"e is {e} if z decreases from P1 to P2; its square is 1")


@claim("thesis.128", part="coefficient")
@claim("thesis.129", part="sum")
@claim("thesis.130", part="letters")
def proof_of_4_4(part: str) -> Check:
    """Check C_0 as page 46 prints it for two points and a point k between them: it is the C of (3.4), and 0.

    ``letters``: with z for y the formula gives -B, and with z for x it gives -A. The sign does not matter because both
    must be 0.
    """
    if part == "letters":
        message = "the formulas give -B and -A for six triples of points"
        return holds_if(all(_letters(*three) for three in random_triples()), message)
    random = Random(44)
    coefficient, total, terms = [], [], []
    for _ in range(6):
        xa, ya, xb, yb = (Fraction(random.randint(-9, 9)) for _ in range(4))
        share = Fraction(random.randint(1, 9), 10)
        xk, yk = (1 - share) * xa + share * xb, (1 - share) * ya + share * yb
        c = _c_0((xa, ya), (xb, yb), (xk, yk))
        coefficient.append(c == (xb - xa) * (yk - ya) - (yb - ya) * (xk - xa))
        rest = 1 - share
        # Page 46: the ten terms as printed, and the four that the substitution gives.
        printed = [xa * yb, -xa * yb * share, -xa * yb * rest, xa * yb * rest, xa * yb * share, -xa * yb]
        printed += [xa * ya * share, -xa * ya * share, xb * yb * rest, -xb * yb * rest]
        total.append(sum(printed) == 0 == c)
        substituted = [xb * ya * rest, xb * yb * share, ya * xa * rest, ya * xb * share]
        terms.append(sorted(printed) == sorted([xa * yb, *substituted]))
    if part == "coefficient":
        return holds_if(all(coefficient), "they agree exactly in six cases")
    message = "both sums are 0, but their terms differ from those of the substitution"
    return holds_if(all(total) and not any(terms), message, conditional=True)


def _c_0(a: tuple[Fraction, ...], b: tuple[Fraction, ...], k: tuple[Fraction, ...]) -> Fraction:
    """Return C_0 of three points of the x-y plane as page 46 prints it."""
    (xa, ya), (xb, yb), (xk, yk) = a, b, k
    return xa * yb + xb * yk + ya * xk - yb * xk - xa * yk - xb * ya


def _letters(p: Point, q: Point, r: Point) -> bool:
    """Compare C_0 with y replaced by z, and with x replaced by z, with the plane through the points."""

    def printed(u: int, v: int) -> int:
        (ua, va), (ub, vb), (uk, vk) = ((point[u], point[v]) for point in (p, q, r))
        return ua * vb + ub * vk + va * uk - vb * uk - ua * vk - ub * va

    a, b, c, _ = plane_through(p, q, r)
    return (printed(0, 1), printed(0, 2), printed(2, 1)) == (c, -b, -a)


@claim("thesis.74", "thesis.131", "thesis.238")
def theorem_4_5(cases: int = CASES) -> Check:
    """Check that each H_j of a flat set is the hull of its vertices and that its edges are the lines."""
    checks = []
    for sampled in sampled_sets(2, cases):
        for stage in sampled.stages():
            judge = exact_hull([sampled.points[k] for k in stage.vertices])
            checks.append(
                len(stage.equations) == len(stage.vertices) and _touches(sampled, stage.equations, stage.vertices)
            )
            checks.append(len({*judge.vertices}) <= len(stage.vertices))
    message = f"in {len(checks) // 2} stages no vertex is beyond a line, and each line contains at least two vertices"
    return holds_if(all(checks), message)


def _touches(sampled: SampledSet, equations: Sequence[tuple[int, int, int, int]], vertices: Sequence[int]) -> bool:
    values = [[plane_value(plane, sampled.points[k]) for k in vertices] for plane in equations]
    return all(max(row) == 0 and row.count(0) >= 2 for row in values)


@claim("thesis.132")
def combinations_inside() -> Check:
    """Check that convex combinations of the vertices of a hull have no positive value."""
    random = Random(48)
    checks = []
    for sampled in sampled_sets(2, 1):
        for _ in range(8):
            weights = [random.randint(0, 5) + (k == 0) for k, _ in enumerate(sampled.judge.vertices)]
            for facet in sampled.judge.facets:
                mixed = sum(
                    w * plane_value(facet.plane, sampled.points[k])
                    for w, k in zip(weights, sampled.judge.vertices, strict=True)
                )
                checks.append(mixed <= 0)
    return holds_if(all(checks), f"none of {len(checks)} values of combinations is positive")


@claim("thesis.71", "thesis.135", "thesis.136")
@claim("thesis.242", kind="bars")
def theorem_4_6(kind: str = "") -> Check:
    """Check that the values of a line order points by their distance from it, and that the printed formula gives it.

    ``bars`` uses the absolute values as placed in our text.
    """
    checks, as_text = [], []
    for (a, b, c), p, q in (((3, -2, 5), (1, 4), (3, 7)), ((4, -6, 2), (1, 1), (4, 3)), ((0, 5, -10), (0, 2), (1, 2))):
        checks += [a * x + b * y + c == 0 for x, y in (p, q)]
        points = [(x, y) for x, y in product(range(-3, 4), repeat=2) if a * x + b * y + c >= 0]
        values = [a * x + b * y + c for x, y in points]
        squares = [_distance_squared(point, p, q) for point in points]
        both = [*zip(values, squares, strict=True)]
        checks += [(v >= w) == (s >= t) for (v, s), (w, t) in combinations(both, 2)]
        checks += [s * (a * a + b * b) == v * v for v, s in both]
        as_text += [
            s * (a * a + b * b) == (abs(a * x) + b * y + c) ** 2 for (x, y), s in zip(points, squares, strict=True)
        ]
    message = "all pairs of grid points are ordered correctly for three lines"
    if kind:
        return holds_if(all(checks) and not all(as_text), message, conditional=True)
    return holds_if(all(checks), message)


def _distance_squared(x: tuple[int, int], p: tuple[int, int], q: tuple[int, int]) -> Fraction:
    along = q[0] - p[0], q[1] - p[1]
    t = Fraction((x[0] - p[0]) * along[0] + (x[1] - p[1]) * along[1], along[0] ** 2 + along[1] ** 2)
    return (p[0] + t * along[0] - x[0]) ** 2 + (p[1] + t * along[1] - x[1]) ** 2


@claim("thesis.90", "thesis.137", "thesis.142", "thesis.143", "thesis.259")
def theorem_4_7(cases: int = CASES) -> Check:
    """Check that a point is outside at most one line of each H_j of flat sets."""
    numbers = [
        sum(plane_value(plane, point) > 0 for plane in stage.equations)
        for sampled in sampled_sets(2, 2 * cases)
        for stage in sampled.stages()
        for point in sampled.points
    ]
    message = f"in {len(numbers)} pairs of a point and a stage, a point is outside at most {max(numbers)} line"
    return holds_if(max(numbers) == 1, message)


@claim("thesis.138")
def choice_of_first_triangle() -> Check:
    """Check a triangle that is not chosen by the rule: a further point is outside two of its lines."""
    triangle, point = [(0, 0, 0), (2, 0, 0), (0, 2, 0)], (-1, -1, 0)
    outside = sum(plane_value(facet.plane, point) > 0 for facet in exact_hull(triangle).facets)
    return holds_if(outside == 2, "(-1, -1) is outside two lines of the triangle (0, 0), (2, 0), (0, 2)")


@claim("thesis.145")
def gap_in_4_7() -> Check:
    """Check a case that the proof does not exclude: a point outside one line of H_k and two lines of H_k+1."""
    square = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)]
    lines = [facet.plane for facet in exact_hull(square).facets]
    after = [facet.plane for facet in exact_hull([*square, (5, 2, 0)]).facets]
    new = [plane for plane in after if plane not in lines]
    # Search a point outside at most one line of the square that is outside a new line and another one.
    point = next(
        (x, y, 0)
        for x in range(-9, 14)
        for y in range(-9, 14)
        if sum(plane_value(plane, (x, y, 0)) > 0 for plane in lines) <= 1
        and any(plane_value(plane, (x, y, 0)) > 0 for plane in new)
        and sum(plane_value(plane, (x, y, 0)) > 0 for plane in after) > 1
    )
    theorem_holds = theorem_4_7().holds
    message = f"({point[0]}, {point[1]}) is outside at most one line of a square, and outside two after (5, 2) is added"
    return holds_if(theorem_holds, message, conditional=True)


@claim("thesis.260")
def outside_unreplaced_line() -> Check:
    """Check the counterexample: a point is outside a line of H_1 that is not replaced and so remains a line of H_2."""
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


@claim("thesis.243", "thesis.141", kind="condition")
@claim("thesis.140")
def lines_of_figure_3(kind: str = "") -> Check:
    """Check that the printed lines are outward, with P_3 at the origin, P_1 = (x1, y1), P_2 = (x1, y2) and y1 < y2."""
    checks = []
    for x1, y1, y2 in ((3, -1, 2), (5, -4, -1), (2, 1, 6)):
        lines = _printed_lines(x1, y1, y2)
        triangle = ((0, 0), (x1, y1), (x1, y2))
        for a, b, c in lines:
            values = [a * x + b * y + c for x, y in triangle]
            checks.append(max(values) == 0 and values.count(0) == 2)
        checks += [
            x < 0 for x, y in product(range(-6, 7), repeat=2) if all(a * x + b * y + c > 0 for a, b, c in lines[1:])
        ]
    message = f"{len(checks)} lines and points agree"
    return holds_if(all(checks), message, conditional=kind)


def _printed_lines(x1: int, y1: int, y2: int) -> tuple[tuple[int, int, int], ...]:
    """Return the equations (1), (2) and (3) of page 53."""
    return (1, 0, -x1), (y1, -x1, 0), (-y2, x1, 0)


@claim("thesis.244")
def origin_is_third_point(cases: int = CASES) -> Check:
    """Check that no point has a negative x if P_3 is the origin and P_1 P_2 is parallel to the y axis."""
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
    return holds_if(all(checks), f"{len(checks)} conditions hold")


@claim("thesis.148")
def single_point_outside() -> Check:
    """Check that exactly one of the nine points is outside H_5 and that the other eight are its vertices."""
    theorem = theorem_of("4.8")
    eight = [[*point.at] for point in theorem.points if point.name in ADDED]
    hull = exact_hull(eight)
    planes = [hull.plane_of(facet) for facet in hull.facets]
    beyond = {p.name for p in theorem.points if any(_at(plane, p.at) > 0 for plane in planes)}
    message = "only Q9 is outside; the other eight points are the vertices of H_5"
    return holds_if(beyond == {"Q9"} and len(hull.vertices) == len(eight) == 8, message)


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
    return holds_if(closed and beyond > 0, message)


def _added_triangle() -> Check:
    replaced_lines = stage_property("replaced_line")
    return exhibited(replaced_lines.holds, f"each step removes one line and adds two: {replaced_lines.message}")
