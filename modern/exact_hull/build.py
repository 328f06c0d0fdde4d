"""Construct the exact hull of points of any dimension, classify the points, and prove the result."""

import random
from collections.abc import Sequence
from dataclasses import dataclass, replace
from operator import attrgetter

import numpy as np

from emulator.jit.functions import require_numba
from modern.exact_hull.certificate import certify
from modern.exact_hull.coordinates import ExactPoint, IntPoint, read_points, scaled_points
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
from modern.geometry.points import Points

SEED = 1963
# The number of points from which the hull is first proposed in rounded numbers, which is faster, and then proved.
MANY = 500
_BLOCK = 1 << 16


def insertion_order(count: int, simplex: Sequence[int]) -> list[int]:
    """Return a shuffled order of the points that are not in the simplex, the same in every run for the same count."""
    used = set(simplex)
    order = [index for index in range(count) if index not in used]
    random.Random(SEED).shuffle(order)
    return order


def _on_facets(points: Sequence[IntPoint], facets: Sequence[Facet], others: Sequence[int] | None = None) -> list[int]:
    """Return those of ``others`` (by default, all points that are not vertices) that lie in the plane of any facet."""
    if others is None:
        vertices = {index for facet in facets for index in facet.polygon}
        others = [index for index in range(len(points)) if index not in vertices]
    if not others:
        return []
    # The frame moves the points.  A facet's plane there has the same normal, and one vertex determines its constant
    # term.
    bases = [facet.polygon[0] for facet in facets]
    space = frame([points[index] for index in (*bases, *others)])
    planes = [plane_at(facet.plane[:3], base) for facet, base in zip(facets, space.integers, strict=False)]
    images = np.array([plane_image(plane, space.shifts) for plane in planes]).T
    height = max(1, _BLOCK // len(planes))
    boundary = []
    for start in range(len(bases), len(space.integers), height):
        # No point is outside a plane, so values are zero or negative.  One below -bound cannot be zero; the others are
        # evaluated exactly.
        near = space.images[start : start + height] @ images >= -BOUND
        for row in np.flatnonzero(near.any(axis=1)).tolist():
            point = space.integers[start + row]
            if any(value(planes[column], point) == 0 for column in np.flatnonzero(near[row]).tolist()):
                boundary.append(others[start + row - len(bases)])
    return boundary


def _polyhedron(points: Sequence[IntPoint], simplex: Sequence[int], first: Sequence[int] = ()) -> list[Facet]:
    """Return the faces of the hull of distinct points, starting from the four points in ``simplex``.

    The points in ``first`` are inserted first.  Any other point that is inside the hull of these is then discarded at
    once.
    """
    space = frame(points)
    order = insertion_order(len(points), simplex)
    if first:
        likely = set(first)
        order.sort(key=lambda index: index not in likely)
    triangles = convex_surface(space, simplex, order)
    # The frame has moved the points, so the constant terms are computed again.
    return [
        Facet(lowest_terms(plane_at(facet.plane[:3], points[facet.polygon[0]])), facet.polygon)
        for facet in faces(triangles, space.integers)
    ]


def _proposed(points: Sequence[IntPoint], fast: bool | None) -> tuple[list[Facet], list[int]] | None:
    proposal = propose(points, fast)
    if proposal is None:
        return None
    # Rotate each triangle so that the corner with the smallest index is first, as :class:`Facet` requires.
    corners = proposal.triangles
    turn = corners.argmin(axis=1)
    corners = corners[np.arange(len(corners))[:, None], (turn[:, None] + np.arange(3)) % 3]
    try:
        facets = merged(list(map(tuple, corners.tolist())), planes_of(corners, points), points)
        vertices = [index for facet in facets for index in facet.polygon]
        near = np.setdiff1d(np.concatenate([proposal.near, proposal.triangles.ravel()]), vertices)
        return facets, _on_facets(points, facets, near.tolist())
    except (RuntimeError, ValueError, KeyError):  # with the exact points the triangles are not a closed surface
        return None


@dataclass(frozen=True, slots=True)
class _Distinct:
    """The points as integers with a common scale, and the distinct points with their indices."""

    scale: int
    scaled: list[IntPoint]
    distinct: list[IntPoint]
    indices: Sequence[int]
    duplicates: list[tuple[int, int]]


def _distinct(exact: Sequence[ExactPoint]) -> _Distinct:
    scale, scaled = scaled_points(exact)
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
    """Return the exact convex hull of at least one point, with every point classified and the result proved.

    points: three coordinates for each point, or an array of shape (n, 3).  A coordinate is an int, a Fraction, a
    Decimal, a decimal string such as ``"-.25E-3"``, a fraction ``"p/q"``, or a float, also of numpy, which has the
    binary value that it stores.
    fast: propose a hull with a compiled kernel (numba, the extra ``fast``).  None uses the kernel if it is already
    loaded or there are very many points.  The result is the same.

    For many points in space a hull is first proposed in rounded numbers.  If its proof fails, the hull is constructed
    exactly.

    Raise PointsError for invalid points, NotInstalled if ``fast`` is true and numba is missing, and CertificateError if
    the proof of the constructed hull fails.
    """
    if fast:
        require_numba()
    exact = read_points(points)
    prepared = _distinct(exact)
    distinct = prepared.distinct
    basis = independent(distinct)
    plane: Plane | None = None
    cycle: tuple[int, ...] = ()
    facets: list[Facet] = []
    if len(basis) == 2:
        facets = segment(distinct)
    elif len(basis) == 3:
        plane, cycle, facets = polygon(distinct, basis)
    elif len(basis) == 4:
        likely: set[int] = set()
        proposed = _proposed(distinct, fast) if len(distinct) >= MANY else None
        if proposed:
            hull = _classified(prepared, 3, *proposed)
            try:
                return replace(hull, certificate=certify(exact, hull))
            except CertificateError:
                # The proof refused the proposed hull, but its vertices are probably vertices of the true hull, so
                # insert them first.
                likely = {index for facet in proposed[0] for index in facet.polygon}
        facets = _polyhedron(distinct, basis, sorted(likely))
    boundary = _on_facets(distinct, facets) if len(basis) > 2 else []
    hull = replace(_classified(prepared, len(basis) - 1, facets, boundary), plane=plane)
    hull = replace(hull, polygon=tuple(prepared.indices[index] for index in cycle))
    return replace(hull, certificate=certify(exact, hull))


def _classified(prepared: _Distinct, dimension: int, facets: Sequence[Facet], boundary: Sequence[int]) -> ExactHull:
    """Return the result without its plane and polygon.  ``facets`` and ``boundary`` use indices of distinct points."""
    count, indices = len(prepared.distinct), np.array(prepared.indices)
    vertices = sorted({index for facet in facets for index in facet.polygon} or {0})
    inside = np.ones(count, np.bool_)
    inside[vertices] = False
    inside[boundary] = False
    if prepared.duplicates:
        renamed = indices.tolist()
        facets = [Facet(facet.plane, tuple([renamed[index] for index in facet.polygon])) for facet in facets]
    return ExactHull(
        dimension=dimension,
        scale=prepared.scale,
        scaled=tuple(prepared.scaled),
        vertices=tuple(indices[vertices].tolist()),
        boundary=tuple(indices[sorted(boundary)].tolist()),
        inside=tuple(indices[inside].tolist()),
        duplicates=tuple(prepared.duplicates),
        plane=None,
        facets=tuple(sorted(facets, key=attrgetter("plane"))),
    )
