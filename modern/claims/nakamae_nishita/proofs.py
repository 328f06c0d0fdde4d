"""Proofs of Nakamae and Nishita on faces, segments and depth; :mod:`modern.claims.algebra` checks the steps."""

from modern.claims import algebra
from modern.claims.algebra import Proof, Step, bracket, cross, dot, minus, point, positive, proves, term, zero


@proves("nakamae-nishita.18")
def front_face() -> Proof:
    images = u, v, w = tuple(point(name, 2) for name in "uvw")
    turn = bracket(u, v, w)
    depths = algebra.variables("r s t")
    # In the coordinates of the eye, a corner is its image (x, y, 1) times its depth.
    central = [(depth * x, depth * y, depth) for (x, y), depth in zip(images, depths, strict=True)]
    parallel = [(*image, depth) for image, depth in zip(images, depths, strict=True)]
    (a, inward), (_, along) = (
        (a, cross(minus(b, a), minus(c, a))) for a, b, c in (tuple(map(tuple, three)) for three in (central, parallel))
    )
    from_eye = dot(inward, a)
    in_front = {name: positive(depth) for name, depth in zip("rst", depths, strict=True)}
    return Proof.of(
        "a convex face is a front face if and only if two successive edges turn clockwise in the projection",
        "The eye is at the origin and looks along z, x points to the right and y down, so that a positive area is "
        "clockwise. The corners a, b, c, ... of a face run clockwise seen from outside, so that the normal (b - a) x "
        "(c - a) points inward. The eye sees the outer side if the product of this normal with the way from the eye to "
        "a is positive. All corners are in front of the eye, so their depths are positive. In a parallel projection "
        "along z, the way from the eye is z itself. All pairs of successive edges of a convex face that are not in "
        "one line turn in the same sense.",
        *(
            Step(
                f"seen from {side}, the corners turn {sense} in the projection",
                {side: positive(sign * from_eye), **in_front},
                positive(sign * turn),
                (term(side),),
                tuple("rst"),
            )
            for side, sense, sign in (("outside", "clockwise", 1), ("inside", "counterclockwise", -1))
        ),
        Step(
            "seen in its own plane, the corners are on a line",
            {"edgewise": zero(from_eye), **in_front},
            zero(turn),
            (term("edgewise"),),
            tuple("rst"),
        ),
        Step("in a parallel projection, the normal has the sign of the turn", {}, zero(along[2] - turn)),
    )


@proves("nakamae-nishita.19")
def three_corners() -> Proof:
    images = u, v, w = tuple(point(name, 2) for name in "uvw")
    # In the paper's figures y points up.
    (x1, y1), (x2, y2), (x, y) = ((x, -y) for x, y in images)
    formula_1 = -(x * (y1 - y2) - y * (x1 - x2) + x1 * y2 - x2 * y1)
    front = front_face()
    return Proof.of(
        "formula (1) for three successive corners that form a convex angle is positive if and only if they belong to a "
        "front face",
        f"{front.argument} If y points up, formula (1) is twice the signed area of the three images. It is 0 only if "
        "the corners are collinear, which a convex angle excludes, or if the face is seen in its own plane.",
        *front.steps,
        Step("formula (1) is twice the signed area", {}, zero(formula_1 - bracket(u, v, w))),
    )


@proves("nakamae-nishita.44")
def product_of_segments() -> Proof:
    p, q, a, b = (point(name, 2) for name in "pqab")
    product, at_a, at_b = algebra.turn(minus(p, q), minus(a, b)), -bracket(p, q, a), -bracket(p, q, b)
    enters, leaves = ({"a": positive(sign * at_a), "b": positive(-sign * at_b)} for sign in (-1, 1))
    return Proof.of(
        "the product is negative if the edge enters the contour at the segment, and positive if it leaves it there",
        "Formula (1) for P_i and P_i+1 is positive to the right, which is inside a clockwise contour. The product is "
        "formula (1) at P_A minus that at P_B. The nearer polyhedron hides the part of the edge inside its contour.",
        Step("the product is negative if the edge enters", enters, positive(-product), (term("a"), term("b"))),
        Step("the product is positive if the edge leaves", leaves, positive(product), (term("a"), term("b"))),
    )


def overlap_by_neighbours() -> Proof:
    o, p, q, r = (point(name, 2) for name in "opqr")
    (t,) = algebra.variables("t")
    x = tuple((1 - t) * a + t * b for a, b in zip(p, q, strict=True))
    return Proof.of(
        "a segment on the line of a side overlaps the side if and only if the column of each adjacent side has a 1 in "
        "at least one of the two rows of the segment's ends",
        "Let o, p, q and r be successive corners of a contour, p and q not straight, and let x = p + t (q - p) be an "
        "end of the segment. The values of formula (1) at x for the sides o p and q r are t times the value at q, and "
        "1 - t times that at p, which are positive. So the column of o p has a 1 if t > 0, and that of q r if t < 1. A "
        "segment on p q overlaps the side if and only if t > 0 at one of its ends and t < 1 at one of its ends.",
        Step("the value for o p is t times that at q", {}, zero(bracket(o, p, x) - t * bracket(o, p, q))),
        Step("the value for q r is 1 - t times that at p", {}, zero(bracket(q, r, x) - (1 - t) * bracket(q, r, p))),
    )


@proves(*(f"nakamae-nishita.{row}" for row in (23, 24, 25, 26, 27)))
@proves("nakamae-nishita.64", conclusion="a segment that crosses an inner edge is inside the contour of the edge there")
def table_properties() -> Proof:
    at_p, at_q, m, n = algebra.variables("f_p f_q m n")
    signs = {"p": algebra.not_negative(at_p), "q": positive(at_q), "m": positive(m), "n": positive(n)}
    return Proof.of(
        "properties 1 to 4 are true for the table PL, and for the table LP with the roles of the contours exchanged",
        "Let f be formula (1) for a side of V. f is linear, not negative in V, and positive at inner points of V. 1: "
        "If f is not positive at the vertices of V', it is not positive in V', so that V and V' have no common inner "
        "points. 4: Let no f be negative at p, and let q be an inner point of V. Then every f is positive at all "
        "points (m p + n q) / (m + n) between p and q. So the segment from q to p does not leave V before p. 2: By "
        "property 4, V encloses all vertices of V', and so V'. 3: If f is negative at no vertex of V', no segment of "
        "V' has its ends on opposite sides of the side of V, so that no d of this side is -4. LP is the table PL of "
        "V' and V, with rows and columns exchanged. An inner edge of V runs along no side of V, because the images of "
        "its two front faces are on both sides of it. So every f is positive between its ends, and a segment that "
        "crosses the edge is inside V there.",
        *algebra.combination_satisfies(),
        Step("f > 0 between p and q", signs, positive(m * at_p + n * at_q), (term("m p"), term("n q"))),
    )


@proves("nakamae-nishita.41")
@proves("nakamae-nishita.42", conclusion="a segment that not only touches a contour enters it, leaves it, or does both")
def two_intersections() -> Proof:
    at_x, at_z, m, n = algebra.variables("f_x f_z m n")
    signs = {"x": positive(at_x), "z": algebra.not_negative(at_z), "m": positive(m), "n": positive(n)}
    on_y = {**signs, "y": zero(m * at_x + n * at_z)}
    return Proof.of(
        "a segment that does not run along a side of a convex contour has at most two points in common with it, and a "
        "segment that runs along a side has d = -4 for no side",
        "Let x, y and z be three points of the segment on the contour, with y = (m x + n z) / (m + n) between x and "
        "z, and let f be formula (1) for a side with y. f is linear, 0 at y, and not negative at x and z. So f is 0 "
        "at both, because it would otherwise be positive at y, and the segment runs along this side. Then no corner "
        "is on the outer side of its line, so that d is -4 for no side. If x and z are inside, every f is positive at "
        "both and so at y, which is inside too. So the segment enters at most once, and does not enter after it "
        "leaves. A line through a square enters and leaves, and each half of it does one of the two.",
        Step("f > 0 at x is impossible", on_y, algebra.IMPOSSIBLE, (term("m x"), term("n z"), term("y", -1))),
        Step("f > 0 at y", signs, positive(m * at_x + n * at_z), (term("m x"), term("n z"))),
    )


@proves("nakamae-nishita.15")
def apart() -> Proof:
    n, q, way = (point(name, 3) for name in ("n", "q", "w"))
    (t,) = algebra.variables("t")
    inner = {"inner": positive(-dot(n, q)), "t": positive(t)}
    along = {"inner": positive(-dot(n, q)), "way": zero(dot(n, way))}
    return Proof.of(
        "polyhedra whose contours do not overlap hide nothing of each other",
        "Two convex polygons that do not overlap are on different sides of a line of the picture. Let f be a linear "
        "function that is 0 on the plane through this line and the eye, not positive on V, and not negative on V'. "
        "If V hides a point p, the line of sight of p runs through an inner point q of V, at which f is negative. Then "
        "f is negative at p too, so that p is no point of V'. The origin is the eye or, in a parallel projection, a "
        "point of the plane.",
        Step("f < 0 at p = t q", inner, positive(-t * dot(n, q)), (term("inner t"),)),
        Step(
            "in a parallel projection, f < 0 at p = q + t w",
            along,
            positive(-dot(n, q) - t * dot(n, way)),
            (term("inner"), term("way", -t)),
        ),
    )


def one_order() -> Proof:
    eye, slope, s, t = algebra.variables("e m s t")
    in_v, in_w = algebra.not_negative(-eye - s * slope), algebra.not_negative(eye + t * slope)
    central = {"eye": positive(eye), "s": positive(s), "v": in_v}
    parallel = {"slope": positive(-slope), "v": in_v, "w": in_w}
    return Proof.of(
        "of two polyhedra, the same one is nearer on all their lines of sight, except where they touch",
        "A plane separates two convex polyhedra V and V' that have no common inner points (those of a plate are the "
        "inner points of its polygon). Let f be a linear function that is 0 on this plane, not positive on V, and not "
        "negative on V'. If the contours overlap, the plane does not contain the eye, because it would then separate "
        "the contours too. Let f be e > 0 at the eye, and e + s m and e + t m at points of V and V' on one line of "
        "sight, at the distances s and t. Then m < 0 and s >= t, and s = t only if the two points are one. So V' is "
        "nearer on all lines of sight; if e < 0, V is. In a parallel projection, m is the same for all lines of sight "
        "and not 0, and s and t are distances from a plane across these lines.",
        Step("m < 0 if e > 0", central, positive(-slope), (term("eye"), term("v")), ("s",)),
        Step("s >= t if m < 0", parallel, algebra.not_negative(s - t), (term("v"), term("w")), ("slope",)),
    )


@proves(*(f"nakamae-nishita.{row}" for row in (29, 30, 31, 32, 33)))
def meeting_of_segments() -> Proof:
    a, b, c, d = (point(name, 2) for name in "abcd")
    at_a, at_b, at_c, at_d = -bracket(c, d, a), -bracket(c, d, b), -bracket(a, b, c), -bracket(a, b, d)
    common = (at_b * p - at_a * q + at_d * r - at_c * s for p, q, r, s in zip(a, b, c, d, strict=True))
    return Proof.of(
        "for segments that are not collinear, d is -4 if they cross, -2 if an end of one is inside the other, -1 if "
        "two ends coincide, and otherwise 0; for collinear segments, d is 0",
        "Let A and B be the values of formula (1) for the segment c d at a and b, and C and D those for a b at c and "
        "d. Since B - A = -(D - C), the two factors of d are 0 or have opposite signs. If both are not 0, then A and B "
        "differ, the lines meet only at (B a - A b) / (B - A) = (D c - C d) / (D - C), and d is -4, -2 or -1. If d is "
        "-4, A and B have opposite signs, and so have C and D: the point is inside both segments. If d is -2, one of "
        "the four values is 0: the point is an end of one segment and inside the other. If d is -1, one value of each "
        "pair is 0: the point is an end of both. If d is 0, the segments are collinear, or one of them is on one side "
        "of the line of the other and does not meet it.",
        Step("B - A = -(D - C)", {}, zero(at_b - at_a + at_d - at_c)),
        *(Step("the two points are one", {}, zero(difference)) for difference in common),
    )
