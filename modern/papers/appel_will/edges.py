"""Convex edges (section "Determination of convex hull edges"): the points are projected parallel to every pair."""

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
    """The convex edges (i, j), i < j, in the order of the tests, the deleted points and the number of projections."""

    edges: tuple[Pair, ...]
    deleted: tuple[Deleted, ...]
    projections: int


@dataclass(frozen=True, slots=True)
class Projection:
    """The points projected parallel to the line of a pair, relative to the line's image C.

    ``images`` are the images of the points off the line, up to one affine map. ``line`` lists the points on the line,
    the pair included, sorted along it ("the distance from the orthographic projection plane can serve as a basis for
    sorting").
    """

    images: list[Image]
    line: list[int]


def project(points: Sequence[IntPoint], pair: Pair, live: Iterable[int]) -> Projection:
    """Project the points ``live`` parallel to the line through ``pair``, two distinct points.

    Each point is moved along the line to the coordinate plane perpendicular to the largest component of the line's
    direction. Its image is the other two coordinates times that component. Images are thus integers, and the
    common factor does not change the sense of rotation between any two of them.
    """
    origin, end = points[pair[0]], points[pair[1]]
    along = [q - p for p, q in zip(origin, end, strict=True)]
    k = max(range(3), key=lambda axis: abs(along[axis]))
    u, v = (k + 1) % 3, (k + 2) % 3
    du, dv, dk = along[u], along[v], along[k]
    # The image of p is dk (p - origin) - (p - origin)_k along. Its constant part does not depend on p, so it is
    # computed once: this loop runs for every point and every pair, which is where the method spends its time.
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
    """Test all pairs of the points ``live``, which must be distinct, in the order of their numbers.

    Points between the ends of a line are deleted as soon as a pair on that line is projected, so the pair that is
    tested spans the whole line. Edges found earlier at a point that is deleted later are dropped at the end. Only the
    star polygon test as printed produces such edges.
    """
    remaining = dict.fromkeys(sorted(live))
    order = list(remaining)
    edges: list[Pair] = []
    deleted: list[Deleted] = []
    projections = 0
    for position, i in enumerate(order):
        for j in order[position + 1 :]:
            if i not in remaining or j not in remaining:
                continue
            projection = project(points, (i, j), remaining)
            projections += 1
            # Fig. 13: the points projected onto C are sorted along the line, and all but the two ends are deleted.
            ends = (projection.line[0], projection.line[-1])
            for inner in projection.line[1:-1]:
                del remaining[inner]
                deleted.append(Deleted(inner, (min(ends), max(ends))))
            # i or j may have been deleted just now. The pair of the line's ends is then tested in its own turn.
            if i in remaining and j in remaining and outside(projection.images):
                edges.append((i, j))
    final = (edge for edge in edges if edge[0] in remaining and edge[1] in remaining)
    return Edges(tuple(final), tuple(deleted), projections)
