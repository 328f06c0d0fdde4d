"""Identities of chapters 3 and 4 for all real coordinates; :mod:`modern.claims.algebra` checks them."""

from collections.abc import Callable, Iterable

from modern.claims.algebra import (
    IMPOSSIBLE,
    Point,
    Polynomial,
    Proof,
    Step,
    bracket,
    cross,
    dot,
    minus,
    point,
    positive,
    term,
    total,
    turn,
    variables,
    zero,
)
from modern.claims.evidence import Check, claim
from modern.claims.sampled_sets import counterexample_points
from modern.claims.thesis.chapter3_equations import plane_as_printed, with_0
from modern.claims.thesis.proofs import P, Q, X, printed_v, theorem_4_3


def _plane(p: Point, q: Point, r: Point) -> tuple[Polynomial, ...]:
    """Return A, B, C and D of the plane through three points as (3.4) prints them."""
    return plane_as_printed(p, q, r)  # type: ignore[arg-type,return-value]


def _all_zero(says: str, values: Iterable[Polynomial]) -> tuple[Step, ...]:
    return tuple(Step(says, {}, zero(value)) for value in values)


def equation_of_plane() -> Proof:
    *normal, d = _plane(P, Q, X)
    product = minus(tuple(normal), cross(minus(Q, P), minus(X, P)))
    return Proof(
        "(3.4) gives an equation of the plane through three points that are not collinear",
        "(3.4) is 0 at the three points, and A, B and C are the components of the vector product of two sides. "
        "They are all 0 only if the points are collinear, and then the points lie in many planes. Otherwise, they "
        "lie in no other plane, because that product is perpendicular to every plane through them.",
        _all_zero("the value is 0", [*(dot(normal, p) + d for p in (P, Q, X)), *product]),
    )


def one_or_two_points() -> Proof:
    way = minus(Q, P)
    (weight,) = variables("lambda")
    step = Step(
        "no combination with a positive weight of the other point is the point itself",
        {"distinct": positive(dot(way, way)), "weight": positive(weight)}
        | {axis: zero(weight * d) for axis, d in zip("xyz", way, strict=True)},
        IMPOSSIBLE,
        (term("weight weight distinct"), *(term(axis, -weight * d) for axis, d in zip("xyz", way, strict=True))),
    )
    return Proof.of(
        "all points of a set of one or two distinct points are vertices",
        "A point is a vertex if it is no combination, with two positive weights, of two points of the hull. The hull "
        "of one point has no two points. A combination of two points of the segment p q is p plus a weight times q - "
        "p. The weight is positive because only one of them can be p. So the combination is not p, nor, likewise, q.",
        step,
    )


def different_z() -> Proof:
    dx, dy, dz = minus(P, Q)
    step = Step(
        "z differs",
        {"distinct": positive(dx * dx + dy * dy + dz * dz), "x": zero(dx), "y": zero(dy)},
        positive(dz * dz),
        (term("distinct"), term("x", -dx), term("y", -dy)),
    )
    return Proof("distinct points with equal x and y differ in z", "Distinct points differ in a coordinate.", (step,))


def equations_of_line() -> Proof:
    u = minus(Q, P)
    product = cross(u, minus(X, P))
    printed = [
        (Q[j] - P[j]) * X[i] + (P[i] - Q[i]) * X[j] + (Q[i] - P[i]) * P[j] + (P[j] - Q[j]) * P[i]
        for i, j in ((1, 2), (0, 2), (0, 1))
    ]
    steps = [
        Step(
            "the third component is 0",
            {"differ": positive(u[k] * u[k]), "first": zero(product[i]), "second": zero(product[j])},
            zero(product[k]),
            (term("first", -u[i] * u[k]), term("second", -u[j] * u[k])),
            ("differ",),
        )
        for k, i, j in ((0, 1, 2), (1, 0, 2), (2, 0, 1))
    ]
    components = [printed[0] + product[0], printed[1] - product[1], printed[2] + product[2]]
    return Proof(
        "two of (3.1) to (3.3) both hold exactly on the line if each contains a coordinate in which the points differ",
        "A point x is on the line of p and q exactly if the vector product of q - p and x - p is 0. Each printed "
        "equation says that one component of this product is 0. The two chosen equations contain the coordinate in "
        "which p and q differ, and if two such components are 0, the third is 0 too.",
        (*_all_zero("the equation is the component", components), *steps),
    )


def coordinate_planes() -> Proof:
    planes = [_plane(*(with_0(p, axis) for p in (P, Q, X))) for axis in range(3)]
    others = [c for axis, plane in enumerate(planes) for k, c in enumerate(plane) if k != axis]
    return Proof(
        "the equation of a coordinate plane has one nonzero coefficient, and its constant term is 0",
        "If one coordinate of three points is 0, the coefficients of the two other coordinates are 0, and so is D. The "
        "remaining coefficient is not 0 because the points are not collinear.",
        _all_zero("the coefficient is 0", others),
    )


def perpendicular_projection() -> Proof:
    *normal, _ = _plane(P, Q, X)
    images = [bracket(*((p[i], p[j]) for p in (P, Q, X))) for i, j in ((1, 2), (2, 0), (0, 1))]
    return Proof(
        "a plane is projected to a line if and only if its coefficient for the omitted coordinate is 0",
        "The coefficient is twice the area of the projected triangle of three points. Planes are perpendicular if the "
        "scalar product of their normals is 0. The normal of a coordinate plane has one nonzero component. The rule "
        "omits a coordinate whose coefficient is not 0: x, or y if A is 0, or z if A and B are 0. C is then not 0.",
        _all_zero("the area is the coefficient", [area - a for area, a in zip(images, normal, strict=True)]),
    )


def projection_along_axis() -> Proof:
    ways = [(minus(P, with_0(P, axis)), with_0(Q, axis)) for axis in range(3)]
    return Proof(
        "setting a coordinate to 0 projects a point to a coordinate plane",
        "The vector from the projection to the point is perpendicular to every vector of the coordinate plane.",
        _all_zero("the product is 0", [dot(way, across) for way, across in ways]),
    )


def constant_term_at_c() -> Proof:
    c, values = point("c", 3), []
    for r in (X, (P[0], P[1], P[2] + 1)):
        *normal, d = _plane(P, Q, r)
        *moved, constant = _plane(*(minus(p, c) for p in (P, Q, r)))
        values += [*minus(tuple(normal), tuple(moved)), dot(normal, c) + d - constant]
    return Proof(
        "if the origin is moved to the point C, the constant term becomes the value at C, and all else is unchanged",
        "A line in the plane of x and y has the equation of the upright plane through the line and a point above it.",
        _all_zero("both are equal", values),
    )


def coordinates_of_figure_3() -> Proof:
    third, way = point("r", 2), minus(point("q", 2), point("p", 2))
    moved = {name: (turn(way, u), dot(way, u)) for name in "pqrx" for u in [minus(point(name, 2), third)]}
    image, original = moved["x"], minus(point("x", 2), third)
    return Proof.of(
        "in coordinates that keep all distances, P_3 is the origin, P_1 and P_2 have the same x, and y_1 < y_2",
        "The new coordinates of a point x, times the distance of P_1 and P_2, are products of the vector from P_1 "
        "to P_2 with that from P_3 to x. They keep distances, because the sum of the squares of both products is the "
        "product of the squares of both vectors. If P_1 has a negative x, -x takes the place of x. If P_1, P_2 and P_3 "
        "run clockwise, the change of coordinates is a reflection as well as a movement.",
        *_all_zero("P_3 is the origin", moved["r"]),
        Step("P_1 and P_2 have the same x", {}, zero(moved["p"][0] - moved["q"][0])),
        Step("y_2 - y_1 is a square", {}, zero(moved["q"][1] - moved["p"][1] - dot(way, way))),
        Step("distances are kept", {}, zero(dot(image, image) - dot(way, way) * dot(original, original))),
    )


def _c_0(a: Point, b: Point, k: Point) -> Polynomial:
    """Return C_0 of three points as page 46 prints it, from two coordinates of each point."""
    return a[0] * b[1] + b[0] * k[1] + a[1] * k[0] - b[1] * k[0] - a[0] * k[1] - b[0] * a[1]


def coefficient_c_0() -> Proof:
    *_, c, _ = _plane(P, Q, X)
    return Proof("C_0 is C in (3.4)", "Both are the same polynomial.", _all_zero("C_0 = C", [_c_0(P, Q, X) - c]))


def other_letters() -> Proof:
    a, b, *_ = _plane(P, Q, X)
    with_z = [_c_0(*((p[i], p[j]) for p in (P, Q, X))) for i, j in ((0, 2), (2, 1))]
    return Proof(
        "the formulas for the other coordinate planes give -B and -A",
        "In the proof, only the formula of C_0 changes. The signs do not matter because the coefficients must be 0.",
        _all_zero("the sum is 0", [with_z[0] + b, with_z[1] + a]),
    )


@claim("thesis.51", proof=equation_of_plane)
@claim("thesis.52", proof=equation_of_plane, conclusion="exactly the points in the plane of the three satisfy (3.4)")
@claim("thesis.108", proof=equation_of_plane, conclusion="three points lie in a plane")
@claim("thesis.270", proof=one_or_two_points)
@claim("thesis.42", "thesis.44", "thesis.45", "thesis.47", proof=equations_of_line)
@claim("thesis.46", proof=different_z)
@claim("thesis.126", "thesis.277", proof=coordinate_planes)
@claim("thesis.55", "thesis.126", proof=perpendicular_projection)
@claim("thesis.56", proof=perpendicular_projection, conclusion="the rule omits a coordinate with a nonzero coefficient")
@claim("thesis.237", proof=perpendicular_projection, conclusion="C_0 is 0 exactly if the planes are perpendicular")
@claim("thesis.198", proof=projection_along_axis)
@claim("thesis.139", proof=coordinates_of_figure_3)
@claim("thesis.128", proof=coefficient_c_0)
@claim("thesis.130", proof=other_letters)
@claim("thesis.190", proof=constant_term_at_c)
def proof_of_identity(proof: Callable[[], Proof], conclusion: str = "") -> Check:
    return proof().check(conclusion)


@claim("thesis.129")
def sum_of_page_46() -> Check:
    xa, ya, xb, yb, share = variables("x_a y_a x_b y_b lambda")
    rest = 1 - share
    k = (rest * xa + share * xb, rest * ya + share * yb)
    common = [xa * yb, -xa * yb * share, -xa * yb * rest]
    printed = [*common, xa * yb * rest, xa * yb * share, -xa * yb]
    printed += [xa * ya * share, -xa * ya * share, xb * yb * rest, -xb * yb * rest]
    substituted = [*common, xb * ya * rest, xb * ya * share, -xb * ya]
    substituted += [xa * ya * rest, -xa * ya * rest, xb * yb * share, -xb * yb * share]
    sums = [total(printed), total(substituted), _c_0((xa, ya), (xb, yb), k) - total(substituted)]
    proof = Proof("the printed sum is 0", "All terms cancel.", _all_zero("the sum is 0", sums))
    differ = sorted(str(t.terms) for t in printed) != sorted(str(t.terms) for t in substituted)
    return proof.check().misprinted(differ, "three terms with x_b y_a, and four with lambda and 1 - lambda exchanged")


@claim("thesis.50")
def display_of_page_14() -> Check:
    at = zip("pqx", counterexample_points("v_as_our_text.csv"), strict=True)
    values = {f"{name}_{axis}": c for name, p in at for axis, c in zip("xyz", p, strict=True)}
    is_wrong = printed_v(X, X).at(values) == 0 != printed_v(P, X).at(values)
    return theorem_4_3().check().misprinted(is_wrong, "the index i in the first factor of each product")


@claim("thesis.287")
def display_of_page_41() -> Check:
    is_wrong = not printed_v(P, P).terms
    return theorem_4_3().check().misprinted(is_wrong, "the index i in the first factor of each product")


@claim("thesis.120")
def determinants_of_page_41() -> Check:
    way, cosines = minus(Q, X), point("cosine", 3)
    rows = cross(way, cosines)
    of_foot = dot(way, way) * dot(cosines, cosines) - dot(way, cosines) * dot(way, cosines)
    proof = Proof(
        "the sum of three squared determinants is the squared distance",
        "By Pythagoras, the square of the distance is that of the vector from the point to P_2, less that of its "
        "component along the line. The squares of the direction cosines have the sum 1.",
        _all_zero("the sum is the square of the distance", [dot(rows, rows) - of_foot]),
    )
    fourth = way[2] * cosines[2] - way[0] * cosines[1]
    return proof.check().misprinted((fourth * fourth).terms, "a sum with three determinants")


@claim("thesis.234")
def displays_of_page_42() -> Check:
    (_, ux, uy, uz), (_, wy, _) = (0, *minus(Q, P)), minus(Q, X)
    as_text = (wy * uz - uz * uy) * (wy * uz - uz * uy) + 2 * (ux * uy - uy * uz) * (ux * uy - uy * uz)
    is_wrong = (as_text - printed_v(X, X)).terms
    return theorem_4_3().check().misprinted(is_wrong, "three brackets with the letters and indices of formula V")
