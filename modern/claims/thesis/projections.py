"""Checks of chapters 3 and 4 on projections and coordinate planes, and on points inside a nonconvex polyhedron."""

from collections.abc import Sequence
from itertools import combinations, product

from modern.claims.evidence import Check, claim, exhausted, exhibited, searched, slip
from modern.claims.sampled_sets import (
    CASES,
    SETS,
    TRIPLES,
    Point,
    plane_through,
    plane_value,
    random_triples,
    sampled_sets,
)
from modern.claims.thesis.chapter4_examples import theorem_of
from modern.exact_hull import ExactHull, exact_hull
from modern.geometry.vectors import cross, dot, minus

# Rays in this direction from the sampled points meet no edge of the polyhedron.
_RAY: Point = (101, 37, 11)


@claim("thesis.277")
def coordinate_planes() -> Check:
    """Check that the equation of a coordinate plane through three of its points has only one nonzero coefficient."""
    checks = []
    for zero in range(3):
        for three in random_triples():
            p, q, r = (_with_0(point, zero) for point in three)
            checks.append([k for k, number in enumerate(plane_through(p, q, r)) if number] == [zero])
    return searched(TRIPLES, 18, checks, f"{sum(checks)} of {len(checks)} planes have exactly one nonzero coefficient")


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


@claim("thesis.55", "thesis.237")
def perpendicular_projection() -> Check:
    """Check that a triangle's image in a coordinate plane is a segment if and only if the planes are perpendicular."""
    checks = [(_image_area(normal, axis) == 0) == (normal[axis] == 0) for normal in _normals() for axis in range(3)]
    message = "the image of a triangle is a segment if and only if its plane is perpendicular to the coordinate plane"
    return exhausted("26 normals and three coordinate planes", checks, message)


def _normals() -> list[Point]:
    return [(a, b, c) for a in (-1, 0, 2) for b in (-1, 0, 2) for c in (-1, 0, 2) if (a, b, c) != (0, 0, 0)]


def _image_area(normal: Point, axis: int) -> int:
    """Return twice the area of the image of a triangle with the given normal if one coordinate is set to 0."""
    first_side = cross(normal, (1, 0, 0)) if any(normal[1:]) else cross(normal, (0, 1, 0))
    second_side = cross(normal, first_side)
    u, v = (tuple(0 if k == axis else x for k, x in enumerate(side)) for side in (first_side, second_side))
    return cross(u, v)[axis]  # type: ignore[arg-type]


@claim("thesis.198")
def projection_along_axis() -> Check:
    """Check that setting one coordinate of a point to 0 gives the foot of its perpendicular on a coordinate plane."""
    checks = []
    for point in (p for triple in random_triples() for p in triple):
        for axis in range(3):
            foot = tuple(0 if k == axis else x for k, x in enumerate(point))
            unit = tuple(int(k == axis) for k in range(3))
            checks.append(not any(cross(minus(point, foot), unit)))  # type: ignore[arg-type]
    return searched(TRIPLES, 6, checks, "the line from a point to its foot is perpendicular to the plane")


@claim("thesis.56")
def choice_of_projection() -> Check:
    """Check that a triangle's projection on the coordinate plane that the rule chooses has a positive area."""
    chosen = [(normal, 0 if normal[0] else 1 if normal[1] else 2) for normal in _normals()]
    return exhausted("26 normals", [_image_area(normal, axis) for normal, axis in chosen], "no image is a segment")


@claim("thesis.54", "thesis.197", "thesis.125", "thesis.127", "thesis.236", full=400)
def theorem_4_4(cases: int = CASES) -> Check:
    """Check that dropping a coordinate keeps the vertices of a flat set unless the axis is parallel to its plane."""
    checks = []
    for sampled in sampled_sets(2, cases):
        plane = sampled.judge.plane
        assert plane is not None
        for k in range(3):
            if plane[k]:
                projected = [tuple(0 if axis == k else x for axis, x in enumerate(point)) for point in sampled.points]
                checks.append(exact_hull(projected).vertices == sampled.judge.vertices)
    return searched(SETS[2], cases, checks, f"{sum(checks)} of {len(checks)} projections keep the vertices")


@claim("thesis.126")
def constant_terms() -> Check:
    """Check that the constant term of each coordinate plane is 0, and so is its product with D_0."""
    units = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    outcomes = [plane_through((0, 0, 0), p, q)[3] == 0 for p, q in combinations(units, 2)]
    return exhausted("coordinate planes", outcomes, "D_C is 0")


@claim("thesis.273")
def sum_that_ends_with_plus() -> Check:
    """Check that the printed sum, which ends with a plus, is right without it or with a last product that is 0."""
    return slip(
        False, constant_terms().holds, "a sum without the plus, or with D_0 D_C", "D_C is 0 for a coordinate plane"
    )
