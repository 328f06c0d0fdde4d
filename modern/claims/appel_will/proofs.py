"""Proofs of equations and tests of Appel and Will; :mod:`modern.claims.algebra` checks the steps."""

from modern.claims import algebra
from modern.claims.algebra import Proof, Step, bracket, cross, dot, minus, point, positive, proves, term, zero


@proves("appel-will.52")
@proves("thesis.214", conclusion="a point inside a triangle is a combination of the corners with positive weights")
def inside_triangle() -> Proof:
    a, b, c, p = (point(name, 2) for name in "abcp")
    area, weights = bracket(a, b, c), (bracket(b, c, p), bracket(c, a, p), bracket(a, b, p))
    combined = [dot(weights, [corner[k] for corner in (a, b, c)]) for k in (0, 1)]
    return Proof.of(
        "a point is inside a triangle exactly if it is a combination of the corners with positive weights; a weight is "
        "positive exactly if the opposite side, seen from the point, turns in the sense of the corners",
        "The sign of a determinant of three points is their sense of rotation. The determinants of each side and the "
        "point, divided by that of the corners, are the weights of the point as a combination of the corners. The "
        "weights are unique because the corners are not collinear. A point is inside exactly if all are positive.",
        *(Step("the point is the combination", {}, zero(area * p[k] - combined[k])) for k in (0, 1)),
        Step("the weights have the sum 1", {}, zero(area - algebra.total(weights))),
    )


@proves("appel-will.49", "appel-will.50", "appel-will.51")
def triangle_area() -> Proof:
    p, u = point("p", 2), point("u", 2)
    along, height = algebra.variables("along height")
    q = tuple(a + b for a, b in zip(p, u, strict=True))
    # The third corner: p plus a multiple of u, plus another multiple of u turned left by 90 degrees.
    r = (p[0] + along * u[0] - height * u[1], p[1] + along * u[1] + height * u[0])
    # Each row of the determinant has the coordinates x and y of a point, and 1.
    rows = [(*corner, algebra.polynomial(1)) for corner in (p, q, r)]
    return Proof.of(
        "half of the determinant is the area of the triangle; it is positive if the corners run counterclockwise, "
        "negative if they run clockwise, and 0 if they are collinear",
        "Let the vector u be the first side. The third corner is the first corner plus a multiple of u plus h times "
        "the vector u turned left by 90 degrees. The determinant equals h times the square of the length of u. This "
        "product is the base times the signed height, because the turned vector is as long as u.",
        Step("the determinant is base times height", {}, zero(dot(rows[0], cross(*rows[1:])) - height * dot(u, u))),
        Step("the determinant is 0 if the first two corners coincide", {}, zero(dot(rows[0], cross(rows[0], rows[2])))),
    )


@proves("appel-will.81", "appel-will.82")
@proves("appel-will.139", conclusion="a line in the direction of the unit normal is perpendicular to the plane")
def lines_and_planes() -> Proof:
    p, q, n = (point(name, 3) for name in "pqn")
    d, t, length = algebra.variables("d t l")
    unit, line = {"unit": zero(dot(n, n) - 1)}, {"line": zero(dot(n, minus(q, p)))}
    plane, other = {"plane": zero(dot(n, p) + d)}, {"other": zero(dot(n, q) + d)}
    along = tuple(a + t * b for a, b in zip(p, n, strict=True))
    way = minus(along, p)
    value_terms = term("plane"), term("unit", t)
    ends = [(axis, a + length * c - b, length * c - (b - a)) for axis, a, b, c in zip("xyz", p, q, n, strict=True)]
    return Proof.of(
        "on a line with a unit direction, t is the distance from the first point; with the unit normal (a, b, c), "
        "a x + b y + c z + d is the distance from the plane",
        "The squares of a, b and c have the sum 1, because a, b and c are the differences of the coordinates of two "
        "points, divided by the distance of the points. The direction times this distance leads from the first point "
        "to the second, and the direction times t leads to the point at the distance t. The value a x + b y + c z + d "
        "is 0 exactly at the points whose direction from a point of the plane is perpendicular to (a, b, c), and t at "
        "the distance t along the normal, which runs from a point of the plane in the direction (a, b, c).",
        *(Step("t = l is the end", {axis: zero(printed)}, zero(end), (term(axis),)) for axis, end, printed in ends),
        Step("t is the distance", unit, zero(dot(way, way) - t * t), (term("unit", t * t),)),
        Step("a line in the plane is perpendicular", plane | other, line["line"], (term("other"), term("plane", -1))),
        Step("the value is 0 if it is", plane | line, other["other"], (term("line"), term("plane"))),
        Step("the value is the distance", unit | plane, zero(dot(n, along) + d - t), value_terms),
    )


@proves("appel-will.157")
@proves("kovalevsky-schulz.74", conclusion="the scalar and the vector product of two vectors determine their angle")
def product_of_lines() -> Proof:
    u, v = point("u", 3), point("v", 3)
    steps = [Step("the product is perpendicular", {}, zero(dot(cross(u, v), line))) for line in (u, v)]
    square = dot(cross(u, v), cross(u, v)) + dot(u, v) * dot(u, v) - dot(u, u) * dot(v, v)
    steps.append(Step("its square is that of the lines less that of their dot product", {}, zero(square)))
    argument = "The product is perpendicular to both lines, which span the surface. Its length and the dot product "
    argument += "are, by Lagrange's identity, the sine and the cosine of the angle times one number. So they determine "
    argument += "the angle, and the product is 0 only for parallel lines."
    return Proof.of("the cross product of two lines of a surface is normal to the surface", argument, *steps)


@proves("nakamae-nishita.34")
def equal_images() -> Proof:
    p, q = point("p", 3), point("q", 3)
    normal = cross(p, q)
    hypotheses = {"depth": positive(q[2]), "x": zero(normal[1]), "y": zero(normal[0])}
    terms = term("x", -q[1]), term("y", -q[0])
    step = Step("the points are collinear", hypotheses, zero(normal[2]), terms, ("depth",))
    return Proof.of(
        "points with the same image are on one line through the eye",
        "If the images x / z and y / z of two points agree, two components of the points' cross product are 0. Then "
        "the third one is 0 too, and the two points and the eye, which is the origin, are on one line.",
        step,
    )


@proves("appel-will.38")
def fewer_pairs() -> Proof:
    (m,) = algebra.variables("m")
    n = m + 5
    difference = n * (n - 1) * (n - 2) - 3 * n * (n - 1)
    terms = (term("m m m"), term("m m", 3), term("m", 4), term("m", 2))  # m^3 + 9 m^2 + 20 m
    return Proof.of(
        "six or more points have fewer pairs than triples",
        "The number of triples of n points is larger than that of pairs by n (n - 1) (n - 5) / 6. This is positive for "
        "n = 5 + m if m is positive.",
        Step("the difference is positive", {"m": positive(m)}, positive(difference), terms),
    )


def fewer_wasted_tests() -> Proof:
    e, f, m = algebra.variables("E F m")
    hypotheses = {"edges": algebra.not_negative(2 * e - 3 * f), "e": positive(e), "m": positive(m)}
    step = Step("E (N - 2) > 3 F", hypotheses, positive(e * (m + 2) - 3 * f), (term("e m"), term("edges")))
    return Proof.of(
        "if N > 4 and one triple in each plane is useful, a smaller part of the pairs than of the triples is wasted",
        "A hull with E edges and F faces has 2 E >= 3 F, because each edge is on two faces and each face has at least "
        "three edges. N points have (N - 2) / 3 times as many triples as pairs. E pairs and F triples are not wasted. "
        "So the wasted part of the pairs is smaller if E (N - 2) is greater than 3 F, as it is for N = 4 + m > 4.",
        step,
    )


@proves("appel-will.27", conclusion="each point of the hull is on the inner side of all planes of the hull")
@proves("appel-will.79", conclusion="the hull stays the same if points inside it are added")
def points_of_hull() -> Proof:
    return Proof.of(
        "a convex combination of points is on the inner side of every plane with all these points on its inner side",
        "The points of the hull are the combinations of the vertices, and all vertices are on the inner side of each "
        "plane. So the object determines its hull, and the hull stays the same if any of the infinitely many points "
        "inside it is added to the object, for example as the apex of a pit.",
        *algebra.combination_satisfies(),
    )


@proves("appel-will.31")
def projections() -> Proof:
    return Proof.of(
        "the image of the hull of points is the hull of their images",
        "The coordinates of an image are linear functions of the point. A central projection also divides them by the "
        "depth, which is positive, and so multiplies the weights by the depths and a common factor. The images of all "
        "combinations of the vertices are thus all combinations of their images, which form a convex polygon.",
        *algebra.combination_satisfies()[:1],
    )


@proves("appel-will.72")
def three_planes() -> Proof:
    u, v, w = (point(name, 3) for name in "uvw")
    (side,) = algebra.variables("side")
    volume, square = dot(u, cross(v, w)), dot(u, u)
    opposite = {"u": positive(side), "-u": positive(-side)}
    return Proof.of(
        "if three planes of the object meet at a vertex of its hull, all lines at this vertex are outside corners",
        "Near the vertex, the object lies in an open half-space. Three planes divide space into eight cones, with the "
        "edges u or -u, v or -v, and w or -w. The half-space contains u or -u but not both. So the object fills one "
        "cone, say that of u, v and w, whose triple product [u v w] is positive. The inward normals of the two planes "
        "that meet in u are w x u and u x v. The triple product of u and these normals is the square of u times "
        "[u v w]. It is positive, so that u is an outside corner, and so are v and w. Fewer planes, or three planes "
        "through one line, make no vertex.",
        Step("no half-space contains u and -u", opposite, algebra.IMPOSSIBLE, (term("u"), term("-u"))),
        Step("it is the square times [u v w]", {}, zero(dot(u, cross(cross(w, u), cross(u, v))) - square * volume)),
    )


def least_surface() -> Proof:
    n, m = point("n", 3), point("m", 3)
    difference = dot(n, n) * dot(m, m) - dot(n, m) * dot(n, m)
    terms = tuple(term("", component) for component in cross(n, m))
    step = Step("the square of n m is at most that of n times that of m", {}, algebra.not_negative(difference), terms)
    return Proof.of(
        "the hull has the least surface of all convex bodies that contain the points",
        "Each plane of the hull cuts a part off such a body, or nothing. The surface of this part, projected onto the "
        "plane, covers the section that replaces it. A projection does not enlarge areas, because it multiplies them "
        "by the cosine of the angle between the normals n and m, whose square is at most 1. So no cut enlarges the "
        "surface of the body, and after all cuts the hull remains.",
        step,
    )


@proves("appel-will.85", "appel-will.140")
def inside_corner() -> Proof:
    i, k, second = (point(name, 3) for name in "ikl")
    triple = dot(i, cross(k, second))
    return Proof.of(
        "if the line runs counterclockwise on the first surface, the triple product is negative exactly at inside "
        "corners; if the line runs clockwise there, the product has the opposite sign",
        "Seen from outside, the first surface, with the inward normal K, is to the left of the line I, and the second, "
        "with the normal L, to its right. So the second surface extends from the line in the direction L x I. The "
        "product of this direction with K is negative exactly if the second surface is on the outer side of the first, "
        "where the angle inside the object exceeds 180 degrees. A reversed line is counterclockwise on the "
        "other surface.",
        Step("the product of K and L x I is [IKL]", {}, zero(dot(k, cross(second, i)) - triple)),
        Step("[ILK] has the opposite sign", {}, zero(dot(i, cross(second, k)) + triple)),
    )


@proves("appel-will.73", "appel-will.74")
def outside_corners() -> Proof:
    return Proof.of(
        "a vertex of the hull is on at least three outside corners, so that a point on only one is no such vertex",
        "Some plane touches the object only at the vertex. Cut the object near the vertex by a parallel plane. The "
        "hull of this section has at least three corners. At a corner of its hull the section is not concave, because "
        "no linear function decreases along two directions u and v and also along -u-v. So the line from the vertex "
        "to this corner is an outside corner of the object.",
        *concave_point().steps,
    )


@proves("appel-will.75")
def concave_point() -> Proof:
    first, second = algebra.variables("L_u L_v")
    hypotheses = {"u": positive(-first), "v": positive(-second), "opposite": positive(first + second)}
    terms = term("u"), term("v"), term("opposite")
    return Proof.of(
        "a concave point of a surface is no vertex of the hull",
        "At a vertex of the hull some linear function L decreases along both sides u and v of the surface. At a "
        "concave point the surface contains points in the direction -u-v, along which L would have to decrease too. "
        "That is impossible.",
        Step("L cannot decrease along u, v and -u-v", hypotheses, algebra.IMPOSSIBLE, terms),
    )
