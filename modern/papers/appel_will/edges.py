"""Convex edges (section "Determination of convex hull edges"): every pair of points, projected parallel to itself."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from modern.papers.appel_will.star import Image, StarTest

IntPoint = tuple[int, int, int]
Pair = tuple[int, int]


@dataclass(frozen=True, slots=True)
class Deleted:
    """A point deleted from the vertex list because it lies on the line between two others (Fig. 13)."""

    point: int
    between: Pair


@dataclass(frozen=True, slots=True)
class Edges:
    """The convex edges i < j in the order of the tests, the points deleted in passing, the number of projections."""

    edges: tuple[Pair, ...]
    deleted: tuple[Deleted, ...]
    projections: int


@dataclass(frozen=True, slots=True)
class Projection:
    """Points projected parallel to the line of a pair, relative to its image C.

    ``images`` are of the points off the line, up to one affine map; ``line`` holds the points on it, the pair
    included, by distance along it ("the distance from the orthographic projection plane can serve as a basis for
    sorting").
    """

    images: list[Image]
    line: list[int]


def project(points: Sequence[IntPoint], pair: Pair, live: Iterable[int]) -> Projection:
    """Project the points ``live`` parallel to the line of ``pair``, two distinct points.

    The image is the pair of coordinates left when each point is moved along the line to the plane where its
    largest component vanishes, times that component: integers, and of the same sense of rotation for all points.
    """
    origin, end = points[pair[0]], points[pair[1]]
    along = [q - p for p, q in zip(origin, end, strict=True)]
    k = max(range(3), key=lambda axis: abs(along[axis]))
    u, v = (k + 1) % 3, (k + 2) % 3
    du, dv, dk = along[u], along[v], along[k]
    # of p: dk (p - origin) - (p - origin)_k along, with the constant parts taken out of the loop
    cu, cv = dk * origin[u] - du * origin[k], dk * origin[v] - dv * origin[k]
    images: list[Image] = []
    line: list[int] = []
    for index in live:
        point = points[index]
        image = (dk * point[u] - du * point[k] - cu, dk * point[v] - dv * point[k] - cv)
        if image == (0, 0):
            line.append(index)
        else:
            images.append(image)
    line.sort(key=lambda index: points[index][k])
    return Projection(images, line)


def convex_edges(points: Sequence[IntPoint], live: Iterable[int], outside: StarTest) -> Edges:
    """Test all pairs of the points ``live``, which are distinct, in the order of their numbers.

    Points between the ends of a line are deleted as soon as one of its pairs is projected, so that the pair tested
    is the longest on its line.  An edge found before to a point deleted later goes with it; only the printed star
    polygon test makes such edges.
    """
    left = dict.fromkeys(sorted(live))
    order = list(left)
    edges: list[Pair] = []
    deleted: list[Deleted] = []
    projections = 0
    for place, i in enumerate(order):
        for j in order[place + 1 :]:
            if i not in left or j not in left:
                continue
            found = project(points, (i, j), left)
            projections += 1
            ends = (found.line[0], found.line[-1])
            for inner in found.line[1:-1]:
                del left[inner]
                deleted.append(Deleted(inner, (min(ends), max(ends))))
            if i in left and j in left and outside(found.images):
                edges.append((i, j))
    kept = (edge for edge in edges if edge[0] in left and edge[1] in left)
    return Edges(tuple(kept), tuple(deleted), projections)
