"""The exact hull of points of any dimension: read, build, classify, prove."""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from modern.exact_hull.certificate import certify
from modern.exact_hull.coordinates import IntPoint, Points, common_scale, read_points, to_integers
from modern.exact_hull.facets import faces, independent, lowest_terms, plane_at, polygon, segment, value
from modern.exact_hull.result import ExactHull, Facet, Plane
from modern.exact_hull.surface import BOUND, convex_surface, frame, plane_image

SEED = 1963
_BLOCK = 1 << 16


def insertion_order(count: int, simplex: Sequence[int]) -> list[int]:
    """A shuffle of the points other than the first four, the same for the same count."""
    used = set(simplex)
    order = [index for index in range(count) if index not in used]
    random.Random(SEED).shuffle(order)
    return order


def _on_facets(points: Sequence[IntPoint], facets: Sequence[Facet]) -> list[int]:
    """The points that lie in a facet's plane and are no vertices; all points are of the hull."""
    vertices = {index for facet in facets for index in facet.polygon}
    others = [index for index in range(len(points)) if index not in vertices]
    if not others:
        return []
    space = frame(points)
    planes = [plane_at(facet.plane[:3], space.integers[facet.polygon[0]]) for facet in facets]
    images = np.array([plane_image(plane, space.shifts) for plane in planes]).T
    height = max(1, _BLOCK // len(planes))
    found = []
    for start in range(0, len(others), height):
        block = others[start : start + height]
        near = space.images[block] @ images >= -BOUND
        for row in np.flatnonzero(near.any(axis=1)).tolist():
            point = space.integers[block[row]]
            if any(value(planes[column], point) == 0 for column in np.flatnonzero(near[row]).tolist()):
                found.append(block[row])
    return found


def _polyhedron(points: Sequence[IntPoint], simplex: Sequence[int]) -> list[Facet]:
    """The faces of distinct points in space, ``simplex`` naming four that are independent."""
    space = frame(points)
    triangles = convex_surface(space, simplex, insertion_order(len(points), simplex))
    return [
        Facet(lowest_terms(plane_at(facet.plane[:3], points[facet.polygon[0]])), facet.polygon)
        for facet in faces(triangles, space.integers)
    ]


def exact_hull(points: Points) -> ExactHull:
    """The convex hull of at least one point, exactly, with every point classified and the result proved.

    points: (x, y, z) each; a coordinate is an int, a Fraction, a Decimal, a decimal string (``"-.25E-3"``), a fraction
    ``"p/q"`` or a float, also one of numpy's, which is taken as the binary number it is; or an array of shape (n, 3).
    Raises PointsError for anything else, and CertificateError if the proof of the result fails.
    """
    read = read_points(points)
    scale = common_scale(read)
    scaled = to_integers(read, scale)
    first: dict[IntPoint, int] = {}
    duplicates = []
    for index, point in enumerate(scaled):
        earlier = first.setdefault(point, index)
        if earlier != index:
            duplicates.append((index, earlier))
    places, names = list(first.keys()), list(first.values())

    basis = independent(places)
    plane: Plane | None = None
    cycle: tuple[int, ...] = ()
    facets: list[Facet] = []
    if len(basis) == 2:
        facets = segment(places)
    elif len(basis) == 3:
        plane, cycle, facets = polygon(places, basis)
    elif len(basis) == 4:
        facets = _polyhedron(places, basis)
    vertices = {index for facet in facets for index in facet.polygon} or {0}
    boundary = _on_facets(places, facets) if len(basis) > 2 else []
    outer = vertices.union(boundary)

    def named(indices: Sequence[int]) -> tuple[int, ...]:
        return tuple(names[index] for index in indices)

    hull = ExactHull(
        dimension=len(basis) - 1,
        scale=scale,
        scaled=tuple(scaled),
        vertices=named(sorted(vertices)),
        boundary=named(sorted(boundary)),
        inside=named([index for index in range(len(places)) if index not in outer]),
        duplicates=tuple(duplicates),
        plane=plane,
        facets=tuple(
            sorted(
                (Facet(facet.plane, named(facet.polygon)) for facet in facets),
                key=lambda facet: facet.plane,
            )
        ),
        polygon=named(cycle),
    )
    return replace(hull, certificate=certify(read, hull))
