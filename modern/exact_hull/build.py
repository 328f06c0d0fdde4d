"""Construct the exact hull of points of any dimension, classify the points, and prove the result."""

import random
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from operator import attrgetter
from typing import Any

import numpy as np

from emulator.jit.functions import require_numba
from modern.exact_hull.certificate import certify
from modern.exact_hull.coordinates import Coordinates, Ints, read_points
from modern.exact_hull.facets import faces, independent, merged, planes_of, polygon, segment, value
from modern.exact_hull.planes import facet_planes
from modern.exact_hull.proposal import propose
from modern.exact_hull.result import CertificateError, ExactHull, Facet, Facets, Plane
from modern.exact_hull.surface import convex_surface
from modern.geometry.points import Points

SEED = 1963
# The number of points from which the hull is first proposed in rounded numbers, which is faster, and then proved.
MANY = 500
# Four points that span space are first sought among this number of points.  Fewer signs than this are computed singly.
_FEW = 64


def insertion_order(count: int, simplex: Sequence[int]) -> list[int]:
    """Return the indices of all points except those of ``simplex``, in a shuffled order that is always the same."""
    used = set(simplex)
    order = [index for index in range(count) if index not in used]
    random.Random(SEED).shuffle(order)
    return order


def _on_facets(
    points: Coordinates, facets: Sequence[Facet], others: Ints | None = None, likely: Ints | None = None
) -> Ints:
    """Return those of the points ``others`` that lie in the plane of at least one facet.

    By default, ``others`` are all points that are not vertices.  ``likely`` has for each point of ``others`` a facet
    that is tried first, or -1.
    """
    if others is None:
        is_other = np.ones(len(points), np.bool_)
        is_other[_corners(facets)] = False
        others = np.flatnonzero(is_other)
    if len(others) * len(facets) < _FEW:
        on_any = [any(value(facet.plane, points[index]) == 0 for facet in facets) for index in others.tolist()]
        return others[np.array(on_any, np.bool_)]
    planes, on = facet_planes(points, facets), np.zeros(len(others), np.bool_)
    if likely is not None:
        rows = np.flatnonzero(likely >= 0)
        on[rows] = planes.exact(likely[rows], others[rows]) == 0
    rows = np.flatnonzero(~on)
    on[rows] = planes.largest(others[rows])[1] == 0
    return others[on]


def _corners(facets: Sequence[Facet]) -> Any:
    """Return the vertex indices of all polygons in one array, with repetitions."""
    return facets.corners if isinstance(facets, Facets) else [index for facet in facets for index in facet.polygon]


def _proposed(points: Coordinates, basis: Sequence[int], fast: bool | None) -> tuple[Facets, Ints] | None:
    proposal = propose(points, basis, fast)
    if proposal is None:
        return None
    triangles = proposal.triangles
    try:
        facets, face = merged(triangles, planes_of(triangles, points), points)
        candidate, at = np.ones(len(points), np.bool_), np.full(len(points), -1)
        candidate[facets.corners] = False
        at[proposal.near] = np.append(face, -1)[proposal.at]
        others = np.unique(np.concatenate([proposal.near, triangles.ravel()]))
        others = others[candidate[others]]
        return facets, _on_facets(points, facets, others, at[others])
    except (RuntimeError, ValueError, KeyError):  # the triangles are not a closed surface of the exact points
        return None


def exact_hull(points: Points, fast: bool | None = None) -> ExactHull:
    """Return the exact convex hull of at least one point, with every point classified and the result proved.

    :func:`hull1620.exact_hull` describes the parameters.  For many points in space, a hull is first computed in
    floating-point numbers, and then proved exactly.  If this proof fails, the hull is constructed in exact arithmetic.

    Raise PointsError for invalid points, NotInstalled if ``fast`` is true and numba is missing, and CertificateError if
    the proof of the constructed hull fails.
    """
    if fast:
        require_numba()
    scaled = read_points(points)
    distinct, indices = scaled, np.arange(len(scaled))
    if scaled.duplicates:
        indices = np.delete(indices, [index for index, _ in scaled.duplicates])
        distinct = Coordinates(scaled.numbers[indices], scaled.scale)
    basis = independent(distinct[:_FEW])
    if len(basis) < 4:
        basis = independent(distinct.all())
    plane: Plane | None = None
    cycle: tuple[int, ...] = ()
    facets: list[Facet] = []

    def classified(dimension: int, facets: Sequence[Facet], boundary: Ints) -> ExactHull:
        """Return the hull, not yet proved, with the class of each point.  The arguments index the distinct points."""
        vertices = np.flatnonzero(np.bincount(_corners(facets) if len(facets) else [0]))
        inside = np.ones(len(distinct), np.bool_)
        inside[vertices] = False
        inside[boundary] = False
        if isinstance(facets, Facets):
            facets = Facets(facets.planes, indices[facets.corners], facets.counts)
        elif scaled.duplicates:
            renamed = indices.tolist()
            facets = [Facet(facet.plane, tuple([renamed[index] for index in facet.polygon])) for facet in facets]
        return ExactHull(
            dimension=dimension,
            scale=scaled.scale,
            scaled=scaled,
            vertices=tuple(indices[vertices].tolist()),
            boundary=tuple(indices[boundary].tolist()),
            inside=tuple(indices[inside].tolist()),
            duplicates=scaled.duplicates,
            plane=plane,
            facets=facets if isinstance(facets, Facets) else tuple(sorted(facets, key=attrgetter("plane"))),
            polygon=tuple(indices[list(cycle)].tolist()),
        )

    if len(basis) == 2:
        facets = segment(distinct.all())
    elif len(basis) == 3:
        plane, cycle, facets = polygon(distinct.all(), basis)
    elif len(basis) == 4:
        proposed = _proposed(distinct, basis, fast) if len(distinct) >= MANY else None
        if proposed:
            hull = classified(3, *proposed)
            with suppress(CertificateError):
                return replace(hull, certificate=certify(scaled, hull))
        order = insertion_order(len(distinct), basis)
        facets = faces(convex_surface(distinct, basis, order), distinct.all())
    boundary = _on_facets(distinct, facets) if len(basis) > 2 else np.empty(0, np.int64)
    hull = classified(len(basis) - 1, facets, boundary)
    return replace(hull, certificate=certify(scaled, hull))
