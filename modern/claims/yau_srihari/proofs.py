"""Proofs of theorems 1 and 2 of Yau and Srihari; :mod:`modern.claims.algebra` checks the steps."""

from __future__ import annotations

from modern.claims import algebra
from modern.claims.algebra import Proof, Step, dot, not_negative, point, positive, proves, term, turn, variables, zero
from modern.claims.evidence import Check, claim
from modern.claims.kovalevsky_schulz.proofs import lemma_lz
from modern.claims.yau_srihari.envelopes import algorithm_as_printed, disconnected_hull
from modern.papers.yau_srihari import Printed
from modern.papers.yau_srihari.search import Search


def combination_above() -> Step:
    """Return the step: a mean of points on or above a graph is on or above the same mean of graph points below them."""
    m, z_1, z_2, floor_1, floor_2 = variables("m z_1 z_2 floor_1 floor_2")
    points = {"first": not_negative(z_1 - floor_1), "second": not_negative(z_2 - floor_2)}
    return Step(
        "a combination of points on or above the floor is on or above that of the floor",
        {**points, "m": not_negative(m), "rest": not_negative(1 - m)},
        not_negative((1 - m) * z_1 + m * z_2 - (1 - m) * floor_1 - m * floor_2),
        (term("rest first"), term("m second")),
    )


@proves("yau-srihari.40")
@proves("yau-srihari.41", conclusion="a set that consists of all its combinations is convex")
def hull_is_convex() -> Proof:
    m, k, w = variables("m k w")
    weights = {"w": not_negative(w), "k": not_negative(k), "m": not_negative(m), "rest": not_negative(1 - m)}
    new_weight = not_negative((1 - m) * w + m * k)
    return Proof.of(
        "the combinations of points form the smallest convex set that contains the points",
        "A point with the weights w and k in two combinations has the weight (1 - m) w + m k in a combination between "
        "them. This is not negative, and the new weights have the sum (1 - m) + m = 1. So the segment between two "
        "combinations consists of combinations. A convex set that contains the points contains all combinations of "
        "them: if m < 1 is the weight of one point, the combination is between this point and a combination of the "
        "others, which are fewer and have weights divided by 1 - m. So the hull is the intersection of all such sets.",
        Step("the new weight is not negative", weights, new_weight, (term("rest w"), term("m k"))),
        Step("the sum of the weights is 1", {}, zero((1 - m) + m - 1)),
    )


@proves("yau-srihari.47", "yau-srihari.96")
def convex_epigraph() -> Proof:
    return Proof.of(
        "a function is convex exactly if its epigraph is convex, and concave exactly if its hypograph is convex",
        "By definition, f is convex if and only if segments between points of its graph are nowhere below it. If f "
        "is convex, a point between two points of the epigraph is on or above the combination of two points of "
        "the graph, which is on or above the graph. Conversely, take two points of the graph itself: a point between "
        "them is in the epigraph, and so f is at most their combination. A concave function is treated in the same way "
        "with the opposite sign.",
        combination_above(),
    )


@proves("yau-srihari.117", "yau-srihari.118")
def segment_of_graph() -> Proof:
    m, f_x, f_y, f_between, z = variables("m f_x f_y f_between z")
    combined = (1 - m) * f_x + m * f_y
    on_segment = zero(z - combined)
    convex, concave = not_negative(combined - f_between), not_negative(f_between - combined)
    return Proof.of(
        "a segment between two points of the graph is nowhere below the graph of a convex function, and nowhere above "
        "that of a concave one",
        "The point of the segment over (1 - m) X + m Y has the height z = (1 - m) f(X) + m f(Y). The definitions of "
        "convex and concave functions compare this number with the value of f there.",
        Step("not below", {"z": on_segment, "f": convex}, not_negative(z - f_between), (term("z"), term("f"))),
        Step("not above", {"z": on_segment, "f": concave}, not_negative(f_between - z), (term("z", -1), term("f"))),
    )


@proves("yau-srihari.44")
def negative_is_concave() -> Proof:
    m, f_x, f_y, f_between = variables("m f_x f_y f_between")
    convex = {"convex": not_negative((1 - m) * f_x + m * f_y - f_between)}
    concave = not_negative(-f_between - (1 - m) * -f_x - m * -f_y)
    return Proof.of(
        "the negative of a convex function is concave, and vice versa",
        "The definitions differ only in the direction of the inequality, and multiplying by -1 reverses it.",
        Step("-f satisfies the inequality of concave functions", convex, concave, (term("convex"),)),
    )


@proves("yau-srihari.48")
def theorem_1() -> Proof:
    low, high, z = variables("low high z")
    between = zero((high - low) * z - (high - z) * low - (z - low) * high)
    return Proof.of(
        "the hull consists of the points on or above the convex envelope of the floor and on or below the concave "
        "envelope of the ceiling",
        "A point of the hull is a combination of points of S. Each of these is on or above the floor, so that the "
        "combination is on or above that of floor points with the same weights, and so above or on the envelope. The "
        "ceiling is treated in the same way with the opposite sign. Conversely, as S is finite, each point of an "
        "envelope is a combination of points of S. So both such points over X are in the hull. If their heights low "
        "and high differ, a point at z between them is a combination of them with the weights high - z and z - low.",
        combination_above(),
        Step("a point between the envelopes is a combination of their points", {}, between),
        Step("the weights have the sum high - low", {}, zero((high - z) + (z - low) - (high - low))),
    )


def smallest_solid() -> Proof:
    c, d, k = variables("c d k")
    lower_end = {"d": not_negative(d - c), "k": positive(c + 1 - k)}
    return Proof.of(
        "a solid that contains S and passes the test of convexity contains all digital points of the hull of S",
        "A line along an axis through a digital point d of a solid's hull leaves the hull at two points of faces, and "
        "these are semidigital. If the solid passes the test, it has digital points near both ends. They lie on the "
        "line, because integers that differ by less than 1 are equal. Let k be near the lower end c. As k < c + 1 and "
        "c <= d, the integer k is at most d. The other point is at least d. A simple solid has no gap between these "
        "two points, and so contains d. The hull of a solid that contains S contains the hull of S, the set between "
        "the envelopes (theorem 1). If the digital points of the hull of S pass the test, no such solid is smaller.",
        Step("k is less than d + 1", lower_end, positive(d + 1 - k), (term("d"), term("k"))),
        *theorem_1().steps,
    )


@claim("yau-srihari.49")
def digital_hull_by_envelopes() -> Check:
    message = "if the digital points between the envelopes pass the test, they are the smallest such solid around S"
    stairs = disconnected_hull()
    return smallest_solid().check(message).unless(not stairs.holds, f"voxels like stairs: {stairs.message}")


def theorem_2() -> Proof:
    f, u, w, up = (point(name, 2) for name in ("f", "u", "w", "up"))
    # Cotangents decrease from 0 to 180 degrees; this is their difference times both positive denominators.
    cotangents = dot(f, w) * turn(f, u) - dot(f, u) * turn(f, w)
    outward_p, outward_q = (f[1], -f[0]), (-u[1], u[0])
    smaller, inside = {"p": positive(dot(f, f)), "angles": not_negative(cotangents)}, not_negative(turn(w, u))
    weak = {"w": not_negative(turn(f, w)), "u": not_negative(turn(f, u)), "near": not_negative(turn(w, up))}
    sides = {"upright": positive(turn(f, up)), "far": positive(turn(up, u)), **weak}
    coordinates = tuple(term("inside", coordinate) for coordinate in f)
    return Proof.of(
        "a plane on an edge of a face p is supporting if and only if its interior dihedral angle to p is largest",
        "Project along the edge, so that p becomes the ray f and all points are on one side of it. The interior "
        "dihedral angle of the plane through a point u is the angle from f to u. A point w is inside of that plane if "
        "the turn from w to u has the same sense as from f to u. This is the condition for a smaller angle of w, "
        "multiplied by f f > 0, so that the plane of the largest angle has all points inside, and conversely. The "
        "theorem compares only planes whose outward normals point down, those through points on the far side of the "
        "edge, as seen from above. If p is not upright, points on the side of p have no larger angles than those on "
        "the far side. If p is upright, no point is on its side. The outward normals make the supplement of the "
        "angle, whose smallest value, and not its largest, belongs to the next face.",
        Step("a point with a smaller angle than the plane is inside", smaller, inside, (term("angles"),), ("p",)),
        Step("a point inside has a smaller angle", {"inside": inside}, not_negative(cotangents), coordinates),
        Step("a far point has the larger angle", sides, inside, (term("w far"), term("u near")), ("upright",)),
        Step("the outward normals make the supplement", {}, zero(dot(outward_p, outward_q) + dot(f, u))),
    )


def between_corners() -> Proof:
    u, w, (s, t) = point("u", 2), point("w", 2), variables("s t")
    between = tuple(s * a + t * b for a, b in zip(u, w, strict=True))
    weights = {"s": not_negative(s), "t": not_negative(t), "angles": not_negative(turn(w, u))}
    return Proof.of(
        "if no corner is outside the known face p, and psi is defined, its extremes over a square are at two corners",
        "Project along the edge, as for theorem 2. No point of the square is outside the plane of p or on the line of "
        "the edge, so that no two points are in opposite directions from it. So a point u has no smaller angle than w "
        "if the turn from w to u is not negative. Then a point s u + t w between them has an angle between theirs. "
        "A point of the square is between points of sides, and these are between corners. If the smallest angle is the "
        "largest, too, all angles are equal.",
        Step("the angle is not larger than that of u", weights, not_negative(turn(between, u)), (term("t angles"),)),
        Step("the angle is not smaller than that of w", weights, not_negative(turn(w, between)), (term("s angles"),)),
    )


@claim("yau-srihari.71")
def extremes_at_corners() -> Check:
    search, as_printed = Search((0, 0, 0), (0, 1, 0), (-1, 0, 0), Printed()), algorithm_as_printed("corners")
    inside, *corners = (search.score((x, y, 1)) or 0 for x, y in ((0, 1), (-2, 0), (-2, 3), (1, 0), (1, 3)))
    case = "the upright face at the edge from (0, 0, 0) to (0, 1, 0): over the square from (-2, 0) to (1, 3), at the "
    case += f"height 1, psi is smaller at (0, 1) than at the corners; {as_printed.message}"
    return between_corners().check().unless(inside < min(corners) and not as_printed.holds, case)


@proves("yau-srihari.101")
def third_corner() -> Proof:
    at_corner, at_point = variables("L_v L_w")
    corner, same_side = positive(at_corner), not_negative(at_corner * at_point)
    return Proof.of(
        "a plane of theorem 2 supports the envelope if and only if no floor point is opposite to p's third corner",
        "Let L be the plane's equation, positive above the plane. Floor points are on or above the envelope, which "
        "consists of combinations of them. So the plane supports the envelope from below if and only if L is negative "
        "at no floor point. L is not negative at the third corner v: if p is upright, v is above the edge; if not, the "
        "plane contains a floor point beyond the edge, which is not below the plane of p. If L is positive at v, L is "
        "negative at the points opposite to v. If L is 0 at v, the plane is that of p, which is supporting, and no "
        "point is opposite to v.",
        Step("not negative", {"v": corner, "w": same_side}, not_negative(at_point), (term("w"),), ("v",)),
        Step("not opposite", {"v": corner, "w": not_negative(at_point)}, same_side, (term("v w"),)),
    )


@proves("yau-srihari.55")
def extreme_point_of_plane() -> Proof:
    return Proof.of(
        "each supporting plane of the surface contains an extreme point of the surface",
        "A point of the surface is the lowest combination of floor points over its x and y. None of these is above "
        "the surface, because the point of the surface below it would give a lower combination. So every point of the "
        "surface is a combination of points of V, the set of floor points on the surface. On a supporting plane a "
        "linear function has its largest value on the surface, and so the plane contains points of V. By lemma LZ one "
        "of them is no combination of other points of V. So it is not between two points of the surface.",
        *lemma_lz().steps,
    )


@proves("yau-srihari.56")
def extreme_points_in_floor() -> Proof:
    m, n, above, other = variables("m n above other")
    signs = {"above": positive(above), "other": not_negative(other), "m": positive(m), "n": positive(n)}
    return Proof.of(
        "each extreme point of the envelope is a point of the floor",
        "A point v of the surface is a combination of floor points. If v is none of them, v is between one of them and "
        "a combination of the others. Both are on the surface, and v is not extreme: if one of the two were above the "
        "surface, the combination of the surface points below them would be lower than v.",
        Step("it is lower", signs, positive(m * above + n * other), (term("m above"), term("n other"))),
    )


@proves("yau-srihari.84")
def normal_of_starting_face() -> Proof:
    start, end, (c,) = point("w", 3), point("u", 3), variables("c")
    normal, (dx, dy, _) = algebra.cross(algebra.minus(end, start), (0 * c, 0 * c, c)), algebra.minus(end, start)
    return Proof.of(
        "the normal of a starting face has integer components",
        "The components are polynomials with integer coefficients in coordinates that are integers.",
        *(Step("a component", {}, zero(n - p)) for n, p in zip(normal, (c * dy, -c * dx, 0 * c), strict=True)),
    )


@proves("yau-srihari.113")
def number_of_pairs() -> Proof:
    (n,) = variables("n")
    return Proof.of(
        "n points have n (n - 1) / 2 pairs",
        "One point has no pair. A new point has n pairs with the n points before it, and twice n plus n (n - 1) is "
        "(n + 1) n.",
        Step("n new pairs", {}, zero(2 * n + n * (n - 1) - (n + 1) * n)),
    )


@claim("yau-srihari.61")
def angle_of_theorem_2() -> Check:
    as_printed = algorithm_as_printed("angle")
    return theorem_2().check().misprinted(not as_printed.holds, "a theorem about the interior dihedral angle at p")
