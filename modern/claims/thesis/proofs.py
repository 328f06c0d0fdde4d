"""Proofs of theorems 4.3 to 4.7 of the thesis.

Each proof is an argument in sentences and the steps on which the argument rests; :mod:`modern.claims.algebra` checks
the steps.  Points of the plane are named a, b, c and so on.  The bracket [a, b, c] is positive if c is to the left of
the line from a to b.  The vertices of H_j, a hull of the construction, are named counterclockwise.  A point h is
therefore outside the line a b if [a, b, h] is negative.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from modern.claims.algebra import (
    IMPOSSIBLE,
    Point,
    Polynomial,
    Proof,
    Step,
    bracket,
    combination_satisfies,
    dot,
    largest_value,
    minus,
    not_negative,
    point,
    positive,
    term,
    total,
    turn,
    variables,
    zero,
)
from modern.claims.evidence import Check, claim

P, Q, X = point("p", 3), point("q", 3), point("x", 3)


def printed_v(x: Point, i: Point) -> Polynomial:
    """Return V, by which chapter 3 compares distances from the line P Q, with two points in place of the one printed.

    V is a sum of three squares of differences of two products.  The first products contain the point ``x``, and the
    second products the point ``i``.
    """
    u, w, first = minus(Q, P), minus(Q, i), minus(Q, x)
    rows = (first[1] * u[2] - w[2] * u[1], first[2] * u[0] - w[0] * u[2], first[0] * u[1] - w[1] * u[0])
    return dot(rows, rows)


def theorem_4_3() -> Proof:
    (t,) = variables("t")
    ux, uy, uz = u = minus(Q, P)
    square = dot(u, u)
    to_line = tuple(a - t * b for a, b in zip(minus(Q, X), u, strict=True))
    # The square of the distance of X from a point of the line, times D^2, less V; and the equation of the foot.
    excess, foot = square * dot(to_line, to_line) - printed_v(X, X), dot(u, to_line)
    d_k, d_j, v_k, v_j, dd = variables("d_k^2 d_j^2 V_k V_j D^2")
    # Page 42: the direction cosines times e D are the differences of the coordinates.
    cosines, (d,) = point("lambda", 3), variables("D")
    scaled = {e: [e * d * cosine - a for cosine, a in zip(cosines, u, strict=True)] for e in (1, -1)}
    return Proof.of(
        "V_k >= V_j implies that the point k is at least as far from the line as the point j",
        "D^2 is positive because the points differ in a coordinate. e is 1 or -1 and D^2 is the sum of the squares of "
        "the differences, so the squares of the cosines have the sum 1. The square of the distance of x from any point "
        "of the line, times D^2, is at least V, and equals V at the foot of the perpendicular. So d^2 D^2 is V, e^2 is "
        "1, and dividing by D^2 keeps the order.",
        *(
            Step("D^2 > 0", {"a": positive(a * a)}, positive(square), (term("a"), term("", b), term("", c)))
            for a, b, c in ((ux, uy, uz), (uy, uz, ux), (uz, ux, uy))
        ),
        *(
            Step(
                f"the squares of the direction cosines have the sum 1 if e is {e}",
                {axis: zero(value) for axis, value in zip("xyz", values, strict=True)}
                | {"D": zero(d * d - square), "distinct": positive(square)},
                zero(dot(cosines, cosines) - 1),
                (
                    *(term(axis, value + 2 * a) for axis, value, a in zip("xyz", values, u, strict=True)),
                    term("D", -1 * dot(cosines, cosines)),
                ),
                ("distinct",),
            )
            for e, values in scaled.items()
        ),
        Step("the square of no distance is less than V / D^2", {}, not_negative(excess), (term("", foot),)),
        Step("the square of the distance of the foot is V / D^2", {"t": zero(foot)}, zero(excess), (term("t", foot),)),
        Step(
            "the distances have the order of V",
            {"k": zero(d_k * dd - v_k), "j": zero(d_j * dd - v_j), "V": not_negative(v_k - v_j), "D": positive(dd)},
            not_negative(d_k - d_j),
            (term("k"), term("j", -1), term("V")),
            ("D",),
        ),
    )


def theorem_4_4() -> Proof:
    k, a, b = point("k", 3), point("a", 3), point("b", 3)
    normal = variables("A B C")
    d, share = variables("D lambda")
    f_k, f_a, f_b = (dot(normal, x) + d for x in (k, a, b))
    mixed = tuple(z - (1 - share) * x - share * y for x, y, z in zip(a, b, k, strict=True))
    apart = minus(a, b)
    steps = []
    for axis in range(3):
        i, j = (n for n in range(3) if n != axis)
        lost = normal[axis]
        of_plane = {"tilted": positive(lost * lost), "k": zero(f_k), "a": zero(f_a), "b": zero(f_b)}
        lifted = (term("k", lost), term("a", lost * (share - 1)), term("b", -lost * share))
        of_projection = (term("first", -lost * normal[i]), term("second", -lost * normal[j]))
        for says, way, terms in (
            ("a combination in the projection is a combination in the plane", mixed, lifted),
            ("points with the same projection are equal", apart, (term("a", lost), term("b", -lost))),
        ):
            hypotheses = {**of_plane, "first": zero(way[i]), "second": zero(way[j])}
            steps.append(Step(says, hypotheses, zero(way[axis]), (*terms, *of_projection), ("tilted",)))
    return Proof.of(
        "if the points' plane is not parallel to an axis, leaving out the coordinate of this axis keeps the vertices",
        "A vertex is a point that is not between two others of the hull. Leaving out a coordinate maps points between "
        "others to points between others. Conversely, a point whose projection is between two others is between them, "
        "and different points have different projections.",
        *steps,
    )


def theorem_4_6() -> Proof:
    (x, y), (s, t) = point("p", 2), point("foot", 2)
    a, b, c, v_m, v_j, d_m, d_j, square = variables("A B C v_m v_j d_m^2 d_j^2 A^2+B^2")
    value, on_line = a * x + b * y + c, a * s + b * t + c
    across = b * (x - s) - a * (y - t)
    scaled = (a * a + b * b) * ((x - s) * (x - s) + (y - t) * (y - t)) - value * value
    return Proof.of(
        "on the positive side of a line, a point with a larger value of the line's equation is at least as far away",
        "For every point of the line the square of the distance times A^2 + B^2 is at least the square of the value, "
        "and equal to it at the foot of the perpendicular. A^2 + B^2 is positive, and values that are not negative "
        "have the order of their squares.",
        Step(
            "no point of the line is nearer than the foot of the perpendicular",
            {"line": zero(on_line)},
            not_negative(scaled),
            (term("", across), term("line", on_line - 2 * value)),
        ),
        Step(
            "d^2 (A^2 + B^2) is the square of the value at the foot of the perpendicular",
            {"line": zero(on_line), "foot": zero(across)},
            zero(scaled),
            (term("foot", across), term("line", on_line - 2 * value)),
        ),
        Step(
            "the distances have the order of the values",
            {
                "m": zero(d_m * square - v_m * v_m),
                "j": zero(d_j * square - v_j * v_j),
                "order": not_negative(v_m - v_j),
                "v_j": not_negative(v_j),
                "square": positive(square),
            },
            not_negative(d_m - d_j),
            (term("m"), term("j", -1), term("", v_m - v_j), term("order v_j"), term("order v_j")),
            ("square",),
        ),
    )


def _boundary_steps() -> Iterator[Step]:
    """Yield the steps that prove: a point where a linear function is largest on a set is inside no triangle of it."""
    yield largest_value()
    p, q, r = point("p", 2), point("q", 2), point("r", 2)
    slope = variables("L_1 L_2")
    (ux, uy), (vx, vy) = minus(q, p), minus(r, p)
    equal = {"pq": zero(dot(slope, (ux, uy))), "pr": zero(dot(slope, (vx, vy)))}
    for k, (of_q, of_r) in enumerate(((vy, -uy), (-vx, ux))):
        yield Step(
            "a linear function that is not constant has equal values only at collinear corners",
            {**equal, "slope": positive(slope[k] * slope[k])},
            zero(bracket(p, q, r)),
            (term("pq", slope[k] * of_q), term("pr", slope[k] * of_r)),
            ("slope",),
        )


def theorem_4_7() -> Proof:
    a, b, c, d, h, v = (point(name, 2) for name in "abcdhv")
    between = turn(minus(b, a), minus(d, c))
    weights = -bracket(a, b, h), -bracket(c, a, h), bracket(c, a, b)
    corners = (c, b, h)
    inside = [total(weights) * a[k] - total(w * x[k] for w, x in zip(weights, corners, strict=True)) for k in (0, 1)]
    (kappa,) = variables("kappa")
    quadrilateral = {
        "abc": positive(bracket(a, b, c)),
        "bcd": positive(bracket(b, c, d)),
        "ab": positive(-bracket(a, b, h)),
        "cd": positive(-bracket(c, d, h)),
    }
    sum_of_three = (term("abc bcd"), term("bcd ab"), term("abc cd"))
    return Proof.of(
        "a point of the set is outside at most one line of an H_j",
        "Every vertex of an H_j has the largest value of a linear function on the set: the first two are extreme "
        "points, and each other has the largest value of the equation of a line. So no vertex is inside a triangle of "
        "points of the set. Let h be outside two lines. If they are c a and a b, which meet at the vertex a, then a is "
        "inside the triangle c b h. Otherwise let them be a b and c d, in the order in which the boundary turns by at "
        "most 180 degrees from a b to c d. If b, c, d are collinear, c d is also the line b d, which meets a b at b. "
        "If a, b, c are collinear, a b is also the line a c, which meets c d at c. Otherwise h is outside b c as well, "
        "and b is inside a triangle, or, if the lines are parallel, h cannot be outside both. If two edges are on one "
        "line, the middle one of their ends is between the others, and its linear function is a multiple of the line's "
        "equation. Then h and a vertex v on the other side cannot both have smaller values.",
        *_boundary_steps(),
        *(Step("a is a combination of c, b and h", {}, zero(equation)) for equation in inside),
        Step(
            "the weights of c, b and h are positive, and so is the area of c h b",
            {"cab": positive(bracket(c, a, b)), "ca": positive(-bracket(c, a, h)), "ab": positive(-bracket(a, b, h))},
            positive(bracket(c, h, b)),
            (term("cab"), term("ca"), term("ab")),
        ),
        Step(
            "a point outside a b and c d is outside b c",
            {**quadrilateral, "turn": positive(between)},
            positive(-bracket(b, c, h)),
            sum_of_three,
            ("turn",),
        ),
        Step(
            "no point is outside both of two parallel lines",
            {**quadrilateral, "turn": zero(between)},
            IMPOSSIBLE,
            (*sum_of_three, term("turn", bracket(b, c, h))),
        ),
        *(
            Step(
                "a multiple of a line's equation is larger on one of its sides",
                {
                    "kappa": positive(sign * kappa),
                    "side": positive(sign * bracket(a, b, v)),
                    "largest": not_negative(-kappa * bracket(a, b, v)),
                },
                IMPOSSIBLE,
                (term("kappa side"), term("largest")),
            )
            for sign in (1, -1)
        ),
    )


def theorem_4_5() -> Proof:
    a, b, c, d, p, v, x = (point(name, 2) for name in "abcdpvx")
    weights = bracket(p, b, x), bracket(a, p, x), -bracket(a, b, x)
    area = -bracket(a, b, p)
    return Proof.of(
        "the points at which no line of H_j is positive are the convex combinations of its vertices",
        "A convex combination satisfies the inequalities that its points satisfy. Let [a, b, c] be twice the signed "
        "area of a triangle. In H_1, and in the triangle a b p added to H_k, a point x has the weights [p, b, x], [a, "
        "p, x] and -[a, b, x], which are not negative and have the sum -[a, b, p]. By theorem 4.7 for H_k, p is "
        "outside a b alone. So the neighbouring edges c a and b d are not on the line a b, and all vertices v of H_k "
        "satisfy the inequalities of the new lines a p and p b. Hence H_k+1 contains all combinations. A point of "
        "H_k+1 that satisfies the inequality of a b is in H_k, and any other point of H_k+1 is in the triangle.",
        *combination_satisfies(),
        *(
            Step(
                "a point is a combination of a, b and p",
                {},
                zero(area * x[k] - total(w * y[k] for w, y in zip(weights, (a, b, p), strict=True))),
            )
            for k in (0, 1)
        ),
        Step("the weights add up to the area", {}, zero(area - total(weights))),
        *(
            Step(
                f"a vertex satisfies the new line {name}",
                {
                    "corner": positive(bracket(*corner)),
                    "p": not_negative(bracket(*edge, p)),
                    "outer": positive(area),
                    "v": not_negative(bracket(*edge, v)),
                    "abv": not_negative(bracket(a, b, v)),
                },
                not_negative(bracket(*line, v)),
                (term("p abv"), term("outer v")),
                ("corner",),
            )
            for name, corner, edge, line in (("a p", (c, a, b), (c, a), (a, p)), ("p b", (a, b, d), (b, d), (p, b)))
        ),
    )


@claim("thesis.119", "thesis.235", proof=theorem_4_3)
@claim("thesis.121", proof=theorem_4_3, conclusion="the squares of the three quotients have the sum 1")
@claim("thesis.122", proof=theorem_4_3, conclusion="d^2 e^2 D^2 is V for the distance d of a point from the line")
@claim("thesis.124", proof=theorem_4_3, conclusion="D^2 is positive if the two points of the line are distinct")
@claim("thesis.125", "thesis.197", "thesis.236", proof=theorem_4_4)
@claim("thesis.237", proof=theorem_4_4, conclusion="if C_0 is not 0, points with equal x and y have equal z")
@claim("thesis.74", "thesis.131", "thesis.257", "thesis.258", proof=theorem_4_5)
@claim("thesis.132", proof=theorem_4_5, conclusion="convex combinations of the vertices satisfy all inequalities")
@claim("thesis.133", proof=theorem_4_5, conclusion="a triangle consists of the convex combinations of its corners")
@claim("thesis.238", proof=theorem_4_5, conclusion="no line of H_j is positive at a vertex of H_j")
@claim(
    *("thesis.240", "thesis.241"),
    proof=theorem_4_5,
    conclusion="so H_k+1 consists of H_k and the triangle of the replaced line and the new point",
)
@claim("thesis.71", "thesis.135", proof=theorem_4_6)
@claim("thesis.136", proof=theorem_4_6, conclusion="d^2 (A^2 + B^2) is the square of A x + B y + C for the distance d")
@claim("thesis.137", "thesis.145", "thesis.259", "thesis.278", proof=theorem_4_7)
def proof_of_theorem(proof: Callable[[], Proof], conclusion: str = "") -> Check:
    return proof().check(conclusion)
