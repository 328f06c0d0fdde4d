"""Proofs of Nakamae and Nishita on front faces and overlaps; :mod:`modern.claims.algebra` checks the steps."""

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
        "along z, the way from the eye is z itself. All pairs of successive edges of a convex face turn in the "
        "same sense.",
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


@proves("nakamae-nishita.66")
def overlap_by_neighbours() -> Proof:
    o, p, q, r = (point(name, 2) for name in "opqr")
    (t,) = algebra.variables("t")
    x = tuple((1 - t) * a + t * b for a, b in zip(p, q, strict=True))
    return Proof.of(
        "a segment on the line of a side overlaps the side if and only if the column of each adjacent side has a 1 in "
        "at least one of the two rows of the segment's ends",
        "Let o, p, q and r be successive corners of a contour, none of them straight, and let x = p + t (q - p) be an "
        "end of the segment. The values of formula (1) at x for the sides o p and q r are t times the value at q, and "
        "1 - t times that at p, which are positive. So the column of o p has a 1 if t > 0, and that of q r if t < 1. A "
        "segment on p q overlaps the side if and only if t > 0 at one of its ends and t < 1 at one of its ends.",
        Step("the value for o p is t times that at q", {}, zero(bracket(o, p, x) - t * bracket(o, p, q))),
        Step("the value for q r is 1 - t times that at p", {}, zero(bracket(q, r, x) - (1 - t) * bracket(q, r, p))),
    )
