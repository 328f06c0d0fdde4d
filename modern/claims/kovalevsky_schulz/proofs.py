"""Proofs of lemmas LZ, CH and BE of Kovalevsky and Schulz; :mod:`modern.claims.algebra` checks the steps."""

from modern.claims import algebra
from modern.claims.algebra import Proof, Step, dot, minus, not_negative, point, positive, proves, term, variables, zero
from modern.claims.evidence import Check, claim
from modern.claims.hulls import exact_hull
from modern.claims.sampled_sets import Point


@proves("kovalevsky-schulz.66")
def largest_of_part() -> Proof:
    h_c, h_v = variables("H_c H_v")
    signs, terms = {"c": not_negative(h_c), "v": positive(-h_v)}, (term("c"), term("v"))
    return Proof.of(
        "the largest value of H in a part with H >= 0 is the largest in the whole set",
        "H is negative at the points outside the part, and not negative in the part, which is not empty.",
        Step("a point v that is not cut off has a smaller value of H", signs, positive(h_c - h_v), terms),
    )


@proves("kovalevsky-schulz.68")
def last_of_three_choices() -> Proof:
    way = minus(point("p", 3), point("q", 3))
    equal = {axis: zero(d) for axis, d in zip("xyz", way, strict=True)}
    terms = tuple(term(axis, d) for axis, d in zip("xyz", way, strict=True))
    return Proof.of(
        "a single vector remains after the choices of the largest x, y and z",
        "A finite set that is not empty has a largest x, the vectors with this x have a largest y, and the vectors "
        "with both have a largest z. Two vectors that remain have the same x, y and z, and so their distance is 0.",
        Step("the square of their distance is 0", equal, zero(dot(way, way)), terms),
    )


@proves("kovalevsky-schulz.124")
def largest_combination() -> Proof:
    return Proof.of(
        "a point with the largest value of H is a combination only of points with this value",
        "H of a combination is the combination of the values of H. More than two points are combined one after the "
        "other, and only points with positive weights count.",
        algebra.largest_value(),
        algebra.combination_satisfies()[0],
    )


@proves("kovalevsky-schulz.65")
def lemma_lz() -> Proof:
    return Proof.of(
        "a part of a finite set that a linear inequality cuts off contains a point that is no combination of others",
        "The part is not empty, so it contains all points with the largest value of the linear function H. Among them "
        "take those with the largest x, then the largest y, and then the largest z: one point c. If c is a "
        "combination of points of the set with positive weights, all these points have the same H as c. Then they "
        "have the same x, y and z, and so are equal to c. More than two points are combined one after the other.",
        *largest_of_part().steps,
        *last_of_three_choices().steps,
        *largest_combination().steps,
    )


@proves("kovalevsky-schulz.69")
def lemma_ch() -> Proof:
    return Proof.of(
        "a convex polyhedron that contains all local corners, and whose vertices are local corners, is the hull",
        "If a point of the set V is not in the polyhedron K, an inequality of K cuts it off. By lemma LZ the part cut "
        "off contains a local corner, because one of its points is no combination of others. But K contains all local "
        "corners, and so V. Let a convex polyhedron K' contain V and have its vertices in K. It consists of the "
        "combinations of these (Minkowski). As the vertices of K are in V, hence in K', K is in K'. Also K' is in K.",
        algebra.largest_value(),
        *algebra.combination_satisfies(),
    )


@proves("kovalevsky-schulz.14", "kovalevsky-schulz.16", "kovalevsky-schulz.17")
@proves("kovalevsky-schulz.121", conclusion="a smaller convex polyhedron inside another does not have all its vertices")
@proves("kovalevsky-schulz.167", conclusion="a vertex of a convex polyhedron is no combination of its other points")
@proves("appel-will.16", conclusion="a combination of points that are already listed is not a new vertex")
@proves("appel-will.19", conclusion="all vertices of the hull are vertices of the polyhedron")
@proves("appel-will.41", "appel-will.133", conclusion="a point between two others is no vertex of the hull")
def no_combination() -> Proof:
    return Proof.of(
        "a point of a set is a vertex of its hull if and only if it is no combination of other points of the set",
        "A vertex is the only point with the largest value of some linear function, so that a combination of other "
        "points has a smaller value. So no point between two others is a vertex, all vertices of the hull of a set are "
        "in the set, and no vertex of a polyhedron's hull lies inside the polyhedron, a face or an edge. A polyhedron "
        "all of whose vertices are other points of the given one does not contain the vertex. By Minkowski's theorem "
        "every point is a combination of vertices. So a convex polyhedron that contains all vertices contains the "
        "whole polyhedron, and a smaller one inside it does not contain all vertices.",
        algebra.largest_value(),
        *algebra.combination_satisfies(),
    )


@proves("kovalevsky-schulz.49")
@proves("kovalevsky-schulz.173", conclusion="the angle is acute for a visible face and obtuse for an invisible face")
def choice_of_q() -> Proof:
    n, p, q, r = (point(name, 3) for name in "npqr")
    in_face, difference = zero(dot(n, minus(q, r))), zero(dot(n, minus(p, q)) - dot(n, minus(p, r)))
    return Proof.of(
        "the product of a face's normal with the vector P - Q to a point P is the same for all points Q of the face",
        "The normal is perpendicular to vectors from one point of the face to another. So its product with P - Q is "
        "the same for all points Q of the face. By definition VI the product is positive for a visible face, so that "
        "the angle is acute, and negative for an invisible face, so that the angle is obtuse.",
        Step("its product with P - Q does not depend on Q", {"face": in_face}, difference, (term("face", -1),)),
    )


def halves() -> Proof:
    c, p, q, w_p, w_q = variables("c p q w_p w_q")
    within = {"p": not_negative(c - p), "q": not_negative(c - q), "w_p": not_negative(w_p), "w_q": not_negative(w_q)}
    below = {**within, "p": positive(c - p), "w_p": positive(w_p)}
    total, terms = (w_p + w_q) * c - w_p * p - w_q * q, (term("w_p p"), term("w_q q"))
    return Proof.of(
        "the hulls of two parts of a sorted set do not meet if no value of the sorted coordinate x is in both parts",
        "Let c be the largest x of the first part, and d the smallest x of the second part, so that c <= d. All "
        "combinations of points of the first part have x <= c, and those of the second part have x >= d. So the hulls "
        "have no common points if c < d. If a point of the first part has x < c, an inner point of its hull has x < c, "
        "because it is between that point and another point of the hull. The second part is treated in the same way. "
        "So the hulls have no common inner points unless x is c at all points of both parts.",
        Step("x of a combination is at most c", within, not_negative(total), terms),
        Step("x of a combination with a point below c is smaller", below, positive(total), terms),
    )


def size_of_triangulation() -> Proof:
    v, e, t, chi = variables("V E T chi")
    surface, vertices = {"sides": zero(3 * t - 2 * e), "chi": zero(v - e + t - chi)}, zero(2 * v - t - 2 * chi)
    return Proof.of(
        "a closed surface of T triangles and Euler number chi has T / 2 + chi vertices and 4.5 T + 3 chi integers",
        "The surface has V vertices and E edges, and chi is V - E + T, or 2 for a sphere. Each triangle has three "
        "sides, and each edge is a side of two triangles. Formula (5) omits 3 chi.",
        Step("twice V is T + 2 chi", surface, vertices, (term("chi", 2), term("sides", -1))),
    )


@proves("kovalevsky-schulz.95")
def symmetry() -> Proof:
    return Proof.of(
        "a rotation or reflection that maps the points to themselves maps their hull to itself",
        "Each coordinate of the image is a linear function with a constant term, so that the image of a combination is "
        "the combination of the images. So combinations of the points are mapped to combinations of them, and the "
        "inverse map shows that all of them are images.",
        *algebra.combination_satisfies()[:1],
    )


@proves("kovalevsky-schulz.71")
@proves("kovalevsky-schulz.72", conclusion="the outward normal of the plane is a N_v + b N_n with positive a and b")
@proves("kovalevsky-schulz.168", conclusion="the new normal's products with vectors into the polyhedron are at most 0")
def lemma_be() -> Proof:
    visible, hidden = point("v", 3), point("n", 3)
    edge, new, way = point("e", 3), point("p", 3), point("w", 3)
    a, b = -dot(hidden, new), dot(visible, new)
    normal = tuple(a * s + b * t for s, t in zip(visible, hidden, strict=True))
    signs = {
        "visible": positive(b),
        "hidden": not_negative(a),
        "within_v": not_negative(-dot(visible, way)),
        "within_n": not_negative(-dot(hidden, way)),
    }
    strictly = {**signs, "within_n": positive(-dot(hidden, way))}
    terms = term("hidden within_v"), term("visible within_n")
    along_edge = {"v": zero(dot(visible, edge)), "n": zero(dot(hidden, edge))}
    combined = term("v", a), term("n", b)
    return Proof.of(
        "the plane through the new point and an edge of the visible faces' boundary has the polyhedron on one side",
        "Let P be the new point, Q a point of the edge, and N_v and N_n the normals of the visible and of the other "
        "face. With a = -N_n (P - Q) and b = N_v (P - Q), the vector a N_v + b N_n is perpendicular to P - Q and to "
        "the edge. Its product with the vector from Q to any point of the polyhedron is not positive. The product is "
        "negative at inner points, and so a N_v + b N_n is not zero. b is positive, and a is positive unless the "
        "other face is coplanar with P.",
        Step("the normal is perpendicular to P - Q", {}, zero(dot(normal, new))),
        Step("the normal is perpendicular to the edge", along_edge, zero(dot(normal, edge)), combined),
        Step("no point of the polyhedron is beyond the new plane", signs, not_negative(-dot(normal, way)), terms),
        Step("inner points are on the inner side of the new plane", strictly, positive(-dot(normal, way)), terms),
    )


@claim("kovalevsky-schulz.146", end=(1, 1, 0))
@claim("yau-srihari.17", end=(0, 3, 0), conclusion="the hulls have no common inner points unless x is always the same")
def halves_of_sorted_set(end: Point, conclusion: str = "") -> Check:
    first, second = [(0, 0, 0), (0, 2, 0)], [(0, 1, 0), end]
    meet = max(p[0] for p in first) <= min(p[0] for p in second) and 2 not in exact_hull([*first, second[0]]).vertices
    overlap = meet and 2 not in exact_hull([*second, first[1]]).vertices
    case = f"the halves {first} and {second}, whose hulls {'overlap' if overlap else 'meet in (0, 1, 0)'}"
    return halves().check(conclusion).unless(overlap if conclusion else meet, case)
