"""The exact hull of points of any dimension: read, build, classify, prove."""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass, replace
from operator import attrgetter

import numpy as np

from modern.exact_hull.certificate import certify
from modern.exact_hull.coordinates import ExactPoint, IntPoint, Points, read_points, scaled_points
from modern.exact_hull.facets import (
    faces,
    independent,
    lowest_terms,
    merged,
    plane_at,
    planes_of,
    polygon,
    segment,
    value,
)
from modern.exact_hull.proposal import propose
from modern.exact_hull.result import CertificateError, ExactHull, Facet, Plane
from modern.exact_hull.surface import BOUND, convex_surface, frame, plane_image

SEED = 1963
MANY = 500
"""Points from which on a hull is proposed before one is built."""
_BLOCK = 1 << 16


def insertion_order(count: int, simplex: Sequence[int]) -> list[int]:
    """A shuffle of the points other than the first four, the same for the same count."""
    used = set(simplex)
    order = [index for index in range(count) if index not in used]
    random.Random(SEED).shuffle(order)
    return order


def _on_facets(points: Sequence[IntPoint], facets: Sequence[Facet], others: Sequence[int] | None = None) -> list[int]:
    """Which of the points, those that are no vertices or ``others``, lie in a facet's plane; all are of the hull."""
    if others is None:
        vertices = {index for facet in facets for index in facet.polygon}
        others = [index for index in range(len(points)) if index not in vertices]
    if not others:
        return []
    holders = [facet.polygon[0] for facet in facets]
    space = frame([points[index] for index in (*holders, *others)])
    planes = [plane_at(facet.plane[:3], held) for facet, held in zip(facets, space.integers, strict=False)]
    images = np.array([plane_image(plane, space.shifts) for plane in planes]).T
    height = max(1, _BLOCK // len(planes))
    found = []
    for start in range(len(holders), len(space.integers), height):
        near = space.images[start : start + height] @ images >= -BOUND
        for row in np.flatnonzero(near.any(axis=1)).tolist():
            point = space.integers[start + row]
            if any(value(planes[column], point) == 0 for column in np.flatnonzero(near[row]).tolist()):
                found.append(others[start + row - len(holders)])
    return found


def _polyhedron(points: Sequence[IntPoint], simplex: Sequence[int], first: Sequence[int] = ()) -> list[Facet]:
    """The faces of distinct points in space, ``simplex`` naming four that are independent.

    ``first``: points to insert before all others, which are quickly done with where these are the vertices.
    """
    space = frame(points)
    order = insertion_order(len(points), simplex)
    if first:
        likely = set(first)
        order.sort(key=lambda index: index not in likely)
    triangles = convex_surface(space, simplex, order)
    return [
        Facet(lowest_terms(plane_at(facet.plane[:3], points[facet.polygon[0]])), facet.polygon)
        for facet in faces(triangles, space.integers)
    ]


def _proposed(points: Sequence[IntPoint], fast: bool | None) -> tuple[list[Facet], list[int]] | None:
    """The facets and boundary points of distinct points in space as they are proposed, or None."""
    proposal = propose(points, fast)
    if proposal is None:
        return None
    corners = proposal.triangles
    turn = corners.argmin(axis=1)
    corners = corners[np.arange(len(corners))[:, None], (turn[:, None] + np.arange(3)) % 3]
    try:
        facets = merged(list(map(tuple, corners.tolist())), planes_of(corners, points), points)
        vertices = [index for facet in facets for index in facet.polygon]
        near = np.setdiff1d(np.concatenate([proposal.near, proposal.triangles.ravel()]), vertices)
        return facets, _on_facets(points, facets, near.tolist())
    except (RuntimeError, ValueError, KeyError):  # no closed surface, now that the points are taken exactly
        return None


@dataclass(frozen=True, slots=True)
class _Distinct:
    """The points read: as integers by a common scale, and those that are not equal to an earlier one."""

    scale: int
    scaled: list[IntPoint]
    places: list[IntPoint]
    names: Sequence[int]
    duplicates: list[tuple[int, int]]


def _distinct(read: Sequence[ExactPoint]) -> _Distinct:
    scale, scaled = scaled_points(read)
    if len(set(scaled)) == len(scaled):
        return _Distinct(scale, scaled, scaled, range(len(scaled)), [])
    first: dict[IntPoint, int] = {}
    duplicates = []
    for index, point in enumerate(scaled):
        earlier = first.setdefault(point, index)
        if earlier != index:
            duplicates.append((index, earlier))
    return _Distinct(scale, scaled, list(first.keys()), list(first.values()), duplicates)


def exact_hull(points: Points, fast: bool | None = None) -> ExactHull:
    """The convex hull of at least one point, exactly, with every point classified and the result proved.

    points: (x, y, z) each; a coordinate is an int, a Fraction, a Decimal, a decimal string (``"-.25E-3"``), a fraction
    ``"p/q"`` or a float, also one of numpy's, which is taken as the binary number it is; or an array of shape (n, 3).
    Of many points in space a hull is proposed in rounded numbers; where the proof refuses that, it is built anew.
    fast: propose by a compiled kernel (numba, the extra ``fast``); None: where it is loaded, or points are very many.
    The result is the same.
    Raises PointsError for anything else, ValueError where numba is asked for and missing, and CertificateError if the
    proof of the result fails.
    """
    read = read_points(points)
    given = _distinct(read)
    places = given.places
    basis = independent(places)
    plane: Plane | None = None
    cycle: tuple[int, ...] = ()
    facets: list[Facet] = []
    if len(basis) == 2:
        facets = segment(places)
    elif len(basis) == 3:
        plane, cycle, facets = polygon(places, basis)
    elif len(basis) == 4:
        likely: set[int] = set()
        proposed = _proposed(places, fast) if len(places) >= MANY else None
        if proposed:
            hull = _classified(given, 3, *proposed)
            try:
                return replace(hull, certificate=certify(read, hull))
            except CertificateError:
                likely = {index for facet in proposed[0] for index in facet.polygon}
        facets = _polyhedron(places, basis, sorted(likely))
    boundary = _on_facets(places, facets) if len(basis) > 2 else []
    hull = replace(_classified(given, len(basis) - 1, facets, boundary), plane=plane)
    hull = replace(hull, polygon=tuple(given.names[index] for index in cycle))
    return replace(hull, certificate=certify(read, hull))


def _classified(given: _Distinct, dimension: int, facets: Sequence[Facet], boundary: Sequence[int]) -> ExactHull:
    """The result without plane and polygon; ``facets`` and ``boundary`` are of the distinct points."""
    count, names = len(given.places), np.array(given.names)
    vertices = sorted({index for facet in facets for index in facet.polygon} or {0})
    inside = np.ones(count, np.bool_)
    inside[vertices] = False
    inside[boundary] = False
    if given.duplicates:
        renamed = names.tolist()
        facets = [Facet(facet.plane, tuple([renamed[index] for index in facet.polygon])) for facet in facets]
    return ExactHull(
        dimension=dimension,
        scale=given.scale,
        scaled=tuple(given.scaled),
        vertices=tuple(names[vertices].tolist()),
        boundary=tuple(names[sorted(boundary)].tolist()),
        inside=tuple(names[inside].tolist()),
        duplicates=tuple(given.duplicates),
        plane=None,
        facets=tuple(sorted(facets, key=attrgetter("plane"))),
    )
