"""Corrupted hulls, which the certificate must refuse: single changes, exchanged faces, an extra vertex."""

import random
from collections.abc import Iterator
from dataclasses import replace

import pytest

from modern.exact_hull import CertificateError, ExactHull, Facet, certify, exact_hull
from modern.exact_hull.coordinates import Coordinates

GRID = [(x, y, z) for x in range(3) for y in range(3) for z in range(3)] + [(1, 1, 1), (0, 0, 0)]
OCTAHEDRON = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
PENTAGON = [(0, 4), (4, 1), (2, -3), (-2, -3), (-4, 1)]
PRISM = [(x, y, z) for x, y in PENTAGON for z in (0, 3)]
BIG = [tuple(10**30 * number + 1 for number in point) for point in GRID]


def mutations(value: object) -> Iterator[object]:
    """Yield every tree that differs from ``value`` in a single place.

    A number changes by 1 or in sign.  A member is dropped, doubled or exchanged with the next one.
    """
    if isinstance(value, Facet):
        for plane in mutations(value.plane):
            yield Facet(plane, value.polygon)
        for polygon in mutations(value.polygon):
            yield Facet(value.plane, polygon)
    elif isinstance(value, tuple | Coordinates):
        value = tuple(value)
        for k, member in enumerate(value):
            yield value[:k] + value[k + 1 :]
            yield (*value[: k + 1], *value[k:])
            if k + 1 < len(value):
                yield (*value[:k], value[k + 1], member, *value[k + 2 :])
            for changed in mutations(member):
                yield (*value[:k], changed, *value[k + 1 :])
    elif isinstance(value, int):
        yield value + 1
        yield value - 1
        yield -value
    elif value is None:
        yield (1, 0, 0, 0)


def facet_with(hull: ExactHull, plane: tuple[int, ...]) -> int:
    return next(k for k, facet in enumerate(hull.facets) if facet.plane == plane)


def exchanged(hull: ExactHull, number: int, *new: Facet) -> ExactHull:
    facets = [*hull.facets[:number], *hull.facets[number + 1 :], *new]
    return replace(hull, facets=tuple(sorted(facets, key=lambda facet: facet.plane)))


def refused(points, hull: ExactHull, message: str) -> None:
    with pytest.raises(CertificateError, match=message):
        certify(points, hull)


def promoted(hull: ExactHull, index: int) -> ExactHull:
    """Return the hull with an additional vertex that no polygon has."""
    return replace(
        hull,
        vertices=tuple(sorted((*hull.vertices, index))),
        boundary=tuple(k for k in hull.boundary if k != index),
        inside=tuple(k for k in hull.inside if k != index),
    )


def ball(count: int, seed: int) -> list[tuple[int, ...]]:
    rng = random.Random(seed)
    return [tuple(rng.randrange(10**8) for _ in range(3)) for _ in range(count)]


def one_vertex_short() -> Iterator[tuple[list[tuple[int, ...]], ExactHull]]:
    """Yield points and the hull of all except one vertex, which is called inside or boundary."""
    points: list[tuple[int, ...]] = [(0, 0, 0), (9, 0, 0), (0, 9, 0), (0, 0, 9), (5, 5, 5)]
    hull = exact_hull(points[:4])
    for name in ("inside", "boundary"):
        yield points, replace(hull, scaled=tuple(points), **{name: (4,)})
