"""Claims of chapter 4 beside its worked examples: theorems 4.3 to 4.7, steps of the proofs, figures 1 to 4.

Theorems are looked at in small sets; the equations of the proofs are transcribed as they are printed.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations, product
from random import Random

from modern.claims.register import CONDITION, FAILS, HOLDS, Seen, seen
from modern.claims.sampled_sets import Point, SampledSet, sampled_sets, through, value
from modern.claims.thesis.chapter3_equations import COUNT, points_of, triples
from modern.claims.thesis.chapter3_stages import approximations
from modern.claims.thesis.chapter3_steps import value_v
from modern.claims.thesis.chapter4_examples import ADDED, theorem_of
from modern.edition.chapter4 import load_theorems
from modern.exact_hull import exact_hull
from modern.geometry.vectors import cross, dot, minus
from modern.port import convex_hull


def eight_theorems() -> Seen:
    """The theorems that have worked examples here, and those that have claims: 4.1 to 4.8."""
    examples = {theorem.id for theorem in load_theorems()}
    proofs = {"4.3": theorem_4_3, "4.4": theorem_4_4, "4.5": theorem_4_5, "4.6": theorem_4_6, "4.7": theorem_4_7}
    good = examples | proofs.keys() == {f"4.{k}" for k in range(1, 9)} and gap_in_4_7().verdict == CONDITION
    return Seen(CONDITION if good else FAILS, "4.1 to 4.8, each with a claim here; the step of 4.7 is not proved")


def three_are_coplanar() -> Seen:
    """Three points at random."""
    return seen(all(exact_hull(three).dimension < 3 for three in triples()), "six triples of points")


def extremes_4_2() -> Seen:
    """Largest and smallest x, y and z of the six points, in the order of the theorem."""
    points = [point.at for point in theorem_of("4.2").points]
    good = all(
        points[2 * k][k] == max(p[k] for p in points) and points[2 * k + 1][k] == min(p[k] for p in points)
        for k in range(3)
    )
    return seen(good, "P1 to P6 are the extremes in x, y and z, largest before smallest")


def inequalities_without_z() -> Seen:
    """A x + B y + C at point 6 for equation 7, where the print has it below zero."""
    (point,) = points_of("point_6.csv")
    a, b, c, d = theorem_of("4.2").plane(7).coefficients
    as_printed, right = a * point[0] + b * point[1] + c, value((int(a), int(b), int(c), int(d)), point)
    good = as_printed > 0 > right and [*map(Fraction, point)] == [*theorem_of("4.2").points[5].at]
    return Seen(FAILS if good else HOLDS, f"at point 6 equation 7 is {as_printed} as printed, {right} with z and D")


def theorem_4_3() -> Seen:
    """V and the distance from the line order points alike: V is the distance squared times D squared.

    By our text of the theorem's own display, in which each i is a 1, V is 0 of every point and tells nothing.
    """
    found = value_v()
    as_text = []
    for (x1, y1, z1), (x2, y2, z2), _ in triples():
        one = (y2 - y1) * (z2 - z1) - (z2 - z1) * (y2 - y1)
        as_text.append(one**2 + ((z2 - z1) * (x2 - x1) - (x2 - x1) * (z2 - z1)) ** 2)
    return Seen(
        found.verdict if not any(as_text) else FAILS, f"{found.words}; as our text of p. 41 has it 0 of every point"
    )


def distance_by_cosines(kind: str = "") -> Seen:
    """d squared by three determinants with direction cosines, times (e D)^2, is V; the cosines' squares add to 1.

    ``substituted``: with the cosines put in, and by our text of that display, which has lost signs and indices.
    """
    good, as_text = [], []
    for p, q, x in triples():
        u, w = minus(q, p), minus(q, x)
        square = dot(u, u)
        rows = [(w[1], w[2], u[1], u[2]), (w[2], w[0], u[2], u[0]), (w[0], w[1], u[0], u[1])]
        d_squared = sum((Fraction(a * f - b * e) ** 2 / square for a, b, e, f in rows), Fraction(0))
        across = cross(u, minus(x, p))
        good.append(d_squared * square == dot(across, across) and square == sum(k * k for k in u))
        garbled = (w[1] * u[2] - u[2] * u[1]) ** 2 + 2 * (u[0] * u[1] - u[1] * u[2]) ** 2
        as_text.append(Fraction(garbled, square) == d_squared)
    if kind:
        fine = all(good) and not any(as_text)
        return Seen(CONDITION if fine else FAILS, "exactly, for six triples of points; none as our text has it")
    return seen(all(good), "exactly, for six triples of points")


def e_is_minus_one() -> Seen:
    """The sign e of the counterexample's line, chosen as page 42 says."""
    p, q = points_of("e_minus_one.csv")
    first = next(k for k in (q[2] - p[2], q[1] - p[1], q[0] - p[0]) if k)
    e = 1 if first > 0 else -1
    return Seen(FAILS if e == -1 and e * e == 1 else HOLDS, f"e is {e} where z falls from P1 to P2; its square is 1")


def theorem_4_4(count: str = COUNT) -> Seen:
    """Vertices of flat sets and of their projections along each coordinate their plane is not parallel to."""
    good = []
    for one in sampled_sets(2, int(count)):
        plane = one.judge.plane
        assert plane is not None
        for k in range(3):
            if plane[k]:
                projected = [tuple(0 if axis == k else x for axis, x in enumerate(point)) for point in one.points]
                good.append(exact_hull(projected).vertices == one.judge.vertices)
    return seen(bool(good) and all(good), f"{sum(good)} of {len(good)} projections keep the vertices")


def constant_term_of_4_4() -> Seen:
    """The constant terms of the three coordinate planes, by three points of each; and of planes beside two of them."""
    units = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    constants = {through((0, 0, 0), p, q)[3] for p, q in combinations(units, 2)}
    one, other = through((1, 0, 0), (1, 1, 0), (1, 0, 1)), through((0, 0, 1), (1, 0, 1), (0, 1, 1))
    good = constants == {0} and dot(one[:3], other[:3]) == 0 != one[3] * other[3]
    words = (
        "D_C is 0 of a coordinate plane; the planes x = 1 and z = 1 are perpendicular, though the product of D is not 0"
    )
    return Seen(CONDITION if good else FAILS, words)


def proof_of_4_4(part: str) -> Seen:
    """C_0 as page 46 prints it, for points (a), (b) and k between them: it is (3.4)'s, and 0.

    ``letters``: with z for y it is B with its sign turned, with z for x A: as good, for both are to be 0.
    """
    if part == "letters":
        return seen(all(_letters(*three) for three in triples()), "-B and -A, for six triples of points")
    random = Random(44)
    coefficient, total, terms = [], [], []
    for _ in range(6):
        xa, ya, xb, yb = (Fraction(random.randint(-9, 9)) for _ in range(4))
        share = Fraction(random.randint(1, 9), 10)
        xk, yk = (1 - share) * xa + share * xb, (1 - share) * ya + share * yb
        c = _c_0((xa, ya), (xb, yb), (xk, yk))
        coefficient.append(c == (xb - xa) * (yk - ya) - (yb - ya) * (xk - xa))
        rest = 1 - share
        printed = [xa * yb, -xa * yb * share, -xa * yb * rest, xa * yb * rest, xa * yb * share, -xa * yb]
        printed += [xa * ya * share, -xa * ya * share, xb * yb * rest, -xb * yb * rest]
        total.append(sum(printed) == 0 == c)
        substituted = [xb * ya * rest, xb * yb * share, ya * xa * rest, ya * xb * share]
        terms.append(sorted(printed) == sorted([xa * yb, *substituted]))
    if part == "coefficient":
        return seen(all(coefficient), "exactly, for six cases")
    return Seen(
        CONDITION if all(total) and not any(terms) else FAILS, "both are 0; the terms differ from the substitution's"
    )


def _c_0(a: tuple[Fraction, ...], b: tuple[Fraction, ...], k: tuple[Fraction, ...]) -> Fraction:
    """C_0 of three points of the x-y plane as page 46 prints it."""
    (xa, ya), (xb, yb), (xk, yk) = a, b, k
    return xa * yb + xb * yk + ya * xk - yb * xk - xa * yk - xb * ya


def _letters(p: Point, q: Point, r: Point) -> bool:
    """C_0 with y replaced by z, and with x replaced by z, against the plane through the points."""

    def printed(u: int, v: int) -> int:
        (ua, va), (ub, vb), (uk, vk) = ((point[u], point[v]) for point in (p, q, r))
        return ua * vb + ub * vk + va * uk - vb * uk - ua * vk - ub * va

    a, b, c, _ = through(p, q, r)
    return (printed(0, 1), printed(0, 2), printed(2, 1)) == (c, -b, -a)


def theorem_4_5(count: str = COUNT) -> Seen:
    """Each H_j of flat sets is the hull of its vertices: their edges are the lines."""
    good = []
    for one in sampled_sets(2, int(count)):
        for stage in one.stages():
            judge = exact_hull([one.points[k] for k in stage.vertices])
            good.append(len(stage.equations) == len(stage.vertices) and _touches(one, stage.equations, stage.vertices))
            good.append(len({*judge.vertices}) <= len(stage.vertices))
    return seen(all(good), f"{len(good) // 2} stages: no vertex is beyond a line, and two at least are on each")


def _touches(one: SampledSet, equations: Sequence[tuple[int, int, int, int]], vertices: Sequence[int]) -> bool:
    values = [[value(plane, one.points[k]) for k in vertices] for plane in equations]
    return all(max(row) == 0 and row.count(0) >= 2 for row in values)


def combination_is_inside() -> Seen:
    """Combinations of a hull's vertices have no positive value."""
    random = Random(48)
    good = []
    for one in sampled_sets(2, 1):
        for _ in range(8):
            weights = [random.randint(0, 5) + (k == 0) for k, _ in enumerate(one.judge.vertices)]
            for facet in one.judge.facets:
                mixed = sum(
                    w * value(facet.plane, one.points[k]) for w, k in zip(weights, one.judge.vertices, strict=True)
                )
                good.append(mixed <= 0)
    return seen(all(good), f"{len(good)} values of combinations")


def theorem_4_6(kind: str = "") -> Seen:
    """Values of three lines and distances from them order points alike; ``bars``: with those of our text.

    The distance is that from the foot of the perpendicular; the formula says that times a root it is the value.
    """
    good, as_text = [], []
    for (a, b, c), p, q in (((3, -2, 5), (1, 4), (3, 7)), ((4, -6, 2), (1, 1), (4, 3)), ((0, 5, -10), (0, 2), (1, 2))):
        good += [a * x + b * y + c == 0 for x, y in (p, q)]
        points = [(x, y) for x, y in product(range(-3, 4), repeat=2) if a * x + b * y + c >= 0]
        values = [a * x + b * y + c for x, y in points]
        squares = [_distance_squared(point, p, q) for point in points]
        both = [*zip(values, squares, strict=True)]
        good += [(v >= w) == (s >= t) for (v, s), (w, t) in combinations(both, 2)]
        good += [s * (a * a + b * b) == v * v for v, s in both]
        as_text += [
            s * (a * a + b * b) == (abs(a * x) + b * y + c) ** 2 for (x, y), s in zip(points, squares, strict=True)
        ]
    words = "points of a grid, all pairs, about three lines"
    if kind:
        return Seen(CONDITION if all(good) and not all(as_text) else FAILS, words)
    return seen(all(good), words)


def _distance_squared(x: tuple[int, int], p: tuple[int, int], q: tuple[int, int]) -> Fraction:
    """The square of the distance of a point from the foot of its perpendicular on the line of two others."""
    along = q[0] - p[0], q[1] - p[1]
    t = Fraction((x[0] - p[0]) * along[0] + (x[1] - p[1]) * along[1], along[0] ** 2 + along[1] ** 2)
    return (p[0] + t * along[0] - x[0]) ** 2 + (p[1] + t * along[1] - x[1]) ** 2


def theorem_4_7(count: str = COUNT) -> Seen:
    """Of no H_j of flat sets is a given point outside of two lines."""
    most = looked = 0
    for one in sampled_sets(2, 2 * int(count)):
        for stage in one.stages():
            for point in one.points:
                looked += 1
                most = max(most, sum(value(plane, point) > 0 for plane in stage.equations))
    return seen(most == 1, f"{looked} points and stages: outside of {most} line at most")


def choice_matters_for_4_7() -> Seen:
    """A triangle of three points not chosen so: a further point is outside of two of its lines."""
    triangle, point = [(0, 0, 0), (2, 0, 0), (0, 2, 0)], (-1, -1, 0)
    outside = sum(value(facet.plane, point) > 0 for facet in exact_hull(triangle).facets)
    return seen(outside == 2, "(-1, -1) is outside of two lines of the triangle (0, 0), (2, 0), (0, 2)")


def gap_in_4_7() -> Seen:
    """What the written step does not exclude, and what does: where a used point is no boundary point it happens."""
    square = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)]
    lines = [facet.plane for facet in exact_hull(square).facets]
    after = [facet.plane for facet in exact_hull([*square, (5, 2, 0)]).facets]
    new = [plane for plane in after if plane not in lines]
    point = next(
        (x, y, 0)
        for x in range(-9, 14)
        for y in range(-9, 14)
        if sum(value(plane, (x, y, 0)) > 0 for plane in lines) <= 1
        and any(value(plane, (x, y, 0)) > 0 for plane in new)
        and sum(value(plane, (x, y, 0)) > 0 for plane in after) > 1
    )
    held = theorem_4_7().verdict == HOLDS
    words = f"({point[0]}, {point[1]}) is outside of one line of the square at most and of two after (5, 2) is added"
    return Seen(CONDITION if held else FAILS, words)


def line_stays() -> Seen:
    """The counterexample: a point outside of a line of H_1 that is not the one replaced, and so is a line of H_2."""
    points = points_of("line_stays.csv")
    one = SampledSet(tuple(points), convex_hull(points, history=True), exact_hull(points))
    before, after = one.stages()[:2]
    checked = one.hull.history[1].checked
    stays = [
        (k + 1, point)
        for k, plane in enumerate(before.equations)
        for point in points
        if k + 1 != checked and value(plane, point) > 0 and plane in after.equations
    ]
    words = ", ".join(f"{point[:2]} is outside of line {k}" for k, point in stays)
    return Seen(FAILS if stays else HOLDS, f"{words}; line {checked} is replaced")


def lines_of_figure_3(kind: str = "") -> Seen:
    """P_3 at the origin, P_1 = (x1, y1), P_2 = (x1, y2) with y1 below y2: the printed lines, outward."""
    good = []
    for x1, y1, y2 in ((3, -1, 2), (5, -4, -1), (2, 1, 6)):
        lines = _printed_lines(x1, y1, y2)
        triangle = ((0, 0), (x1, y1), (x1, y2))
        for a, b, c in lines:
            values = [a * x + b * y + c for x, y in triangle]
            good.append(max(values) == 0 and values.count(0) == 2)
        good += [
            x < 0 for x, y in product(range(-6, 7), repeat=2) if all(a * x + b * y + c > 0 for a, b, c in lines[1:])
        ]
    words = f"{len(good)} lines and points"
    if not all(good):
        return Seen(FAILS, words)
    return Seen(CONDITION if kind else HOLDS, words)


def _printed_lines(x1: int, y1: int, y2: int) -> tuple[tuple[int, int, int], ...]:
    """Equations (1), (2) and (3) of page 53."""
    return (1, 0, -x1), (y1, -x1, 0), (-y2, x1, 0)


def none_below_the_origin(count: str = COUNT) -> Seen:
    """With P_3 at the origin and P_1 P_2 upright no point has a negative x: none is farther to P_3's side than P_3."""
    good = []
    for one in sampled_sets(2, int(count)):
        p, q, r = one.hull.history[0].added
        (line,) = (
            e for e, d in zip(one.stages()[0].equations, one.hull.history[0].equations, strict=True) if r not in d
        )
        good += [value(line, point) >= value(line, one.points[r]) for point in one.points]
        good.append(value(line, one.points[p]) == value(line, one.points[q]) == 0 > value(line, one.points[r]))
    return seen(all(good), f"{len(good)} points")


def only_one_outside() -> Seen:
    """Of the nine points those that a plane of H_5 has on its positive side; the other eight are its vertices."""
    theorem = theorem_of("4.8")
    eight = [[*point.at] for point in theorem.points if point.name in ADDED]
    hull = exact_hull(eight)
    planes = [hull.plane_of(facet) for facet in hull.facets]
    beyond = {p.name for p in theorem.points if any(_at(plane, p.at) > 0 for plane in planes)}
    return seen(beyond == {"Q9"} and len(hull.vertices) == len(eight) == 8, "the other eight are its vertices")


def _at(plane: Sequence[Fraction | int], point: Sequence[Fraction]) -> Fraction:
    return sum((Fraction(a) * x for a, x in zip(plane, (*point, Fraction(1)), strict=True)), Fraction(0))


def figure(number: str) -> Seen:
    """What a figure shows, from its data."""
    return {"1": _figure_1, "2": _added_triangle, "3": lines_of_figure_3, "4": _added_triangle}[number]()


def _figure_1() -> Seen:
    theorem = theorem_of("4.2")
    sides: dict[frozenset[str], int] = {}
    for plane in theorem.planes:
        for pair in combinations(plane.vertices, 2):
            sides[frozenset(pair)] = sides.get(frozenset(pair), 0) + 1
    v, e, f = len(theorem.points), len(sides), len(theorem.planes)
    closed = set(sides.values()) == {2} and v - e + f == 2
    beyond = sum(any(plane.at(p) > 0 for p in theorem.points) for plane in theorem.planes)
    return seen(
        closed and beyond > 0, f"{v} vertices, {e} edges, {f} faces, closed; {beyond} faces have a vertex beyond"
    )


def _added_triangle() -> Seen:
    found = approximations("lines", "2")
    return Seen(found.verdict, f"each step takes one line away and adds two: {found.words}")
