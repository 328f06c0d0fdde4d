"""Find the edges of the hull: project all points parallel to the line through each pair of points, and test the images.

The line through the pair projects to a point C. The star polygon test (section "Polygon star test") receives the other
images relative to C as pairs of integers, none of them at C. The test returns True if C is outside the star polygon of
these images, that is, if C is a corner of the hull of the images and C. The pair is then an edge of the hull. Only the
sense of rotation of the images about C matters, so an affine map of the images does not change the result.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cmp_to_key
from itertools import pairwise

Image = tuple[int, int]
StarTest = Callable[[Sequence[Image]], bool]


def vorticity(a: Image, b: Image) -> int:
    """Return twice the area of the triangle C, a, b, where C is the origin.

    The result is positive if the triangle runs counterclockwise (Fig. 8).
    """
    return a[0] * b[1] - a[1] * b[0]


def on_one_ray(a: Image, b: Image) -> bool:
    """Return True if two images lie in the same direction from C, the origin (cases I and II of Fig. 12)."""
    return vorticity(a, b) == 0 and a[0] * b[0] + a[1] * b[1] > 0


def star_polygon(images: Sequence[Image]) -> list[Image]:
    """Return the images sorted by polar angle about C, the origin, from 0 to below 360 degrees (Figs. 10 and 11)."""
    return sorted(images, key=cmp_to_key(_angle))


def as_printed(images: Sequence[Image]) -> bool:
    """Apply the test as printed: C is outside if a side turns clockwise *or if two images are on one ray* from C.

    The second condition ("In instances I and II ... the point being tested is considered as being outside") is wrong.
    C is inside if it lies between two successive images in opposite directions (case III). Equal images count as one.
    """
    sides = _sides(star_polygon([*dict.fromkeys(images)]))
    if any(vorticity(a, b) == 0 and not on_one_ray(a, b) for a, b in sides):
        return False
    return not sides or any(vorticity(a, b) < 0 or on_one_ray(a, b) for a, b in sides)


def as_corrected(images: Sequence[Image]) -> bool:
    """Apply the corrected test: C is outside if a side turns clockwise, or if all images are on one ray from C.

    A side that spans exactly 180 degrees (case III of Fig. 12) contains C, so C is not a corner.
    """
    # A side along a ray does not tell how far the images spread about C, so it is skipped.
    sides = [(a, b) for a, b in _sides(star_polygon(images)) if not on_one_ray(a, b)]
    return not sides or any(vorticity(a, b) < 0 for a, b in sides)


def in_one_pass(images: Sequence[Image]) -> bool:
    """Return the result of :func:`as_corrected`, computed without sorting the images.

    C is outside if all images lie within an angle of less than 180 degrees. The pass keeps, as ``first`` and
    ``last``, the images at the two ends of the angle that all images examined so far span.
    """
    if not images:
        return True
    first = last = images[0]
    for image in images:
        from_first, from_last = vorticity(first, image), vorticity(last, image)
        if from_first >= 0 >= from_last:
            # The image is within the angle, unless the angle is a single ray and the image is in the opposite
            # direction.
            if from_first == 0 and from_last == 0 and not on_one_ray(first, image):
                return False
            continue
        if from_first > 0 and from_last > 0:
            last = image
        elif from_first < 0 and from_last < 0:
            first = image
        else:
            # The image is beyond both bounds, so the images span 180 degrees or more.
            return False
    return True


def _sides(star: Sequence[Image]) -> list[tuple[Image, Image]]:
    return [*pairwise(star), (star[-1], star[0])] if star else []


def _angle(a: Image, b: Image) -> int:
    """Compare polar angles. Return a number below 0 if that of ``a`` is smaller, 0 if both are equal, else above 0."""
    lower_a, lower_b = _is_lower(a), _is_lower(b)
    return lower_a - lower_b if lower_a != lower_b else -vorticity(a, b)


def _is_lower(a: Image) -> bool:
    return a[1] < 0 or (a[1] == 0 and a[0] < 0)


IntPoint = tuple[int, int, int]
Pair = tuple[int, int]


@dataclass(frozen=True, slots=True)
class Deleted:
    """A point that was deleted because it lies on the line between two other points (Fig. 13)."""

    point: int
    between: Pair


@dataclass(frozen=True, slots=True)
class Edges:
    """The result of testing all pairs of points: edges (i, j), deleted points, and the number of projections."""

    edges: tuple[Pair, ...]
    deleted: tuple[Deleted, ...]
    projections: int


@dataclass(frozen=True, slots=True)
class Projection:
    """A projection parallel to the line through a pair of points.

    ``images`` are the images of the points that are not on the line, relative to the line's image C. All of them are
    distorted by the same affine map. ``line`` lists the points on the line, including the pair, sorted along it ("the
    distance from the orthographic projection plane can serve as a basis for sorting").
    """

    images: list[Image]
    line: list[int]


def project(points: Sequence[IntPoint], pair: Pair, live: Iterable[int]) -> Projection:
    """Project the points with the indices ``live`` parallel to the line through ``pair``, two distinct points.

    Each point is moved parallel to the line into a coordinate plane, which is perpendicular to the axis of the largest
    component of the line's direction. The image is the pair of the other two coordinates, multiplied by that component
    to make them integers. This common factor does not change the sense of rotation between any two images.
    """
    origin, end = points[pair[0]], points[pair[1]]
    along = [q - p for p, q in zip(origin, end, strict=True)]
    k = max(range(3), key=lambda axis: abs(along[axis]))
    u, v = (k + 1) % 3, (k + 2) % 3
    du, dv, dk = along[u], along[v], along[k]
    # The image of p is dk (p - origin) - (p - origin)_k along. The part (cu, cv) does not depend on p and is computed
    # once, because the loop runs for every point and every pair and takes most of the time of the method.
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
    """Test all pairs of the points with the indices ``live`` in order, and return the pairs that are edges of the hull.

    The points must be distinct. As soon as a pair is projected, all points on its line except the two ends are deleted.
    Therefore only a pair of ends is tested. An edge at a point that is deleted later is not returned. Only the star
    polygon test as printed finds such edges.
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
            # If i or j has just been deleted, the pair of the line's ends is tested in its own turn.
            if i in remaining and j in remaining and outside(projection.images):
                edges.append((i, j))
    final = (edge for edge in edges if edge[0] in remaining and edge[1] in remaining)
    return Edges(tuple(final), tuple(deleted), projections)
