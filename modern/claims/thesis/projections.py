"""Checks of chapters 3 and 4 on projections and coordinate planes, and on points inside a nonconvex polyhedron."""

from collections.abc import Sequence
from itertools import product

from modern.claims.evidence import Check, claim, exhibited, searched, slip
from modern.claims.hulls import exact_hull
from modern.claims.sampled_sets import (
    CASES,
    SETS,
    Point,
    plane_value,
    sampled_sets,
)
from modern.claims.thesis.chapter4_examples import theorem_of
from modern.claims.thesis.identities import coordinate_planes
from modern.exact_hull import ExactHull
from modern.geometry.vectors import cross, dot, minus

# Rays in this direction from the sampled points meet no edge of the polyhedron.
_RAY: Point = (101, 37, 11)


def _with_0(point: Point, axis: int) -> Point:
    x, y, z = (0 if k == axis else number for k, number in enumerate(point))
    return x, y, z


@claim("thesis.274", full=400)
def hull_of_projection(cases: int = CASES) -> Check:
    """Check that projections of flat sets keep vertices, boundary points, inside points, and the points of each line.

    The exact hull represents a line of a flat set by the plane through the line perpendicular to the set.
    """
    checks = []
    for sampled in sampled_sets(2, cases):
        plane = sampled.judge.plane
        assert plane is not None
        for axis in (k for k in range(3) if plane[k]):
            image = [_with_0(point, axis) for point in sampled.points]
            checks.append(_parts(image, exact_hull(image)) == _parts(sampled.points, sampled.judge))
    message = "projections keep the vertices, the boundary and inside points, and the points of each line"
    return searched(SETS[2], cases, checks, f"{sum(checks)} of {len(checks)} {message}")


def _parts(points: Sequence[Point], hull: ExactHull) -> tuple[object, ...]:
    lines = {frozenset(k for k, point in enumerate(points) if not plane_value(f.plane, point)) for f in hull.facets}
    return {*hull.vertices}, {*hull.boundary}, {*hull.inside}, lines


@claim("thesis.38")
def inside_nonconvex_polyhedron() -> Check:
    """Check that points inside the polyhedron of theorem 4.2 can be outside the plane of one of its faces.

    A point is inside if a ray from it meets an odd number of faces.
    """
    theorem = theorem_of("4.2")
    at = {point.name: _four_times(point.at) for point in theorem.points}
    faces = [[at[name] for name in plane.vertices] for plane in theorem.planes]
    planes = [(*_four_times(plane.coefficients[:3]), 16 * int(plane.coefficients[3])) for plane in theorem.planes]
    inner = [
        point
        for point in product((-3, 1, 5, 10), (-9, -5, -2, 2, 5, 9), (-3, 1, 3, 5, 8))
        if sum(_goes_through(point, face) for face in faces) % 2
    ]
    above = [point for point in inner if any(plane_value(plane, point) > 0 for plane in planes)]
    hull = exact_hull([*at.values()])
    within = all(plane_value(facet.plane, point) < 0 for facet in hull.facets for point in inner)
    message = f"{len(above)} of {len(inner)} points inside the polyhedron are positive in an equation of a face"
    return exhibited(0 < len(above) < len(inner) and within, message)


def _four_times(numbers: Sequence[object]) -> Point:
    x, y, z = (int(4 * number) for number in numbers)  # type: ignore[operator]
    return x, y, z


def _goes_through(start: Point, face: Sequence[Point]) -> bool:
    a, b, c = (minus(corner, start) for corner in face)
    turns = [dot(_RAY, cross(p, q)) > 0 for p, q in ((a, b), (b, c), (c, a))]
    normal = cross(minus(b, a), minus(c, a))
    return len({*turns}) == 1 and (dot(normal, a) > 0) == (dot(normal, _RAY) > 0)


@claim("thesis.273")
def sum_that_ends_with_plus() -> Check:
    """Check that the printed sum lacks its last term, the product D_0 D_C of the constant terms, which is 0."""
    *_, last = "A_0A_C + B_0B_C + C_0C_C +".split("+")
    right = coordinate_planes().check().holds
    return slip(last.strip(), right, "a sum without the plus, or with D_0 D_C", "D_C is 0 for a coordinate plane")
