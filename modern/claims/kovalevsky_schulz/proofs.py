"""Proofs of lemmas LZ, CH and BE of Kovalevsky and Schulz; :mod:`modern.claims.algebra` checks the steps."""

from __future__ import annotations

from collections.abc import Callable

from modern.claims.algebra import (
    Proof,
    Step,
    combination_satisfies,
    dot,
    largest_value,
    not_negative,
    point,
    positive,
    term,
    zero,
)
from modern.claims.evidence import Check, claim


def lemma_lz() -> Proof:
    """Prove that a nonempty part of a finite set that an inequality cuts off contains a vertex of the set's hull."""
    return Proof(
        "a part of a finite set that a linear inequality cuts off contains a point that is no combination of others",
        "The part is not empty, so it contains all points with the largest value of the linear function H. Among them "
        "take those with the largest x, then the largest y, and then the largest z: one point c. If c is a "
        "combination of points of the set with positive weights, all of them have the H of c. Then they have its x, y "
        "and z, and so they are c. More than two points are combined one after the other.",
        (largest_value(), combination_satisfies()[0]),
    )


def lemma_ch() -> Proof:
    """Prove by Minkowski's theorem that a polyhedron with all local corners, its vertices among them, is the hull."""
    return Proof(
        "a convex polyhedron that contains all local corners, and whose vertices are local corners, is the hull",
        "If a point of V is not in K, an inequality of K cuts it off. By lemma LZ the part cut off contains a point "
        "that is no combination, hence a local corner, but K contains these. So K contains V. Let K' be convex, "
        "contain V and have its vertices in K. By Minkowski's theorem a convex polyhedron consists of the combinations "
        "of its vertices. The vertices of K are in V, hence in K', and so K is in K'. In the same way K' is in K.",
        (largest_value(), *combination_satisfies()),
    )


def symmetry() -> Proof:
    """Prove that a rotation or reflection that maps a set to itself maps its hull to itself."""
    return Proof(
        "a rotation or reflection that maps the points to themselves maps their hull to itself",
        "Each coordinate of the image is a linear function with a constant term, so that the image of a combination is "
        "the combination of the images. So combinations of the points are mapped to combinations of them, and the "
        "inverse map shows that all of them are images.",
        combination_satisfies()[:1],
    )


def lemma_be() -> Proof:
    """Prove that the plane through a horizon edge and the new point supports the hull."""
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
    return Proof(
        "the plane through the new point and a horizon edge has the whole polyhedron on one side",
        "Let Q be a point of the edge, and let N_v and N_n be the normals of the visible and of the other face. With "
        "a = -N_n (P - Q) and b = N_v (P - Q), the vector a N_v + b N_n is perpendicular to P - Q and to the edge. "
        "Its product with the way from Q to any point of the polyhedron is not positive. It is negative at inner "
        "points, and so the vector is not zero. b is positive, and a is positive unless the other face is coplanar "
        "with P.",
        (
            Step("the normal is perpendicular to P - Q", {}, zero(dot(normal, new))),
            Step(
                "the normal is perpendicular to the edge",
                {"v": zero(dot(visible, edge)), "n": zero(dot(hidden, edge))},
                zero(dot(normal, edge)),
                (term("v", a), term("n", b)),
            ),
            Step("no point of the polyhedron is beyond the new plane", signs, not_negative(-dot(normal, way)), terms),
            Step("inner points are on the inner side of the new plane", strictly, positive(-dot(normal, way)), terms),
        ),
    )


@claim("kovalevsky-schulz.65", "kovalevsky-schulz.68", "kovalevsky-schulz.124", proof=lemma_lz)
@claim("kovalevsky-schulz.69", "kovalevsky-schulz.121", proof=lemma_ch)
@claim("kovalevsky-schulz.95", proof=symmetry)
@claim("kovalevsky-schulz.71", "kovalevsky-schulz.72", proof=lemma_be)
def proof_of_lemma(proof: Callable[[], Proof]) -> Check:
    return proof().check()
