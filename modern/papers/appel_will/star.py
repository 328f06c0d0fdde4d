"""The star polygon test (section "Polygon star test"): is C within the hull of points in a plane?

Every function here receives the images of points relative to C as pairs of integers, none of them at C itself. A test
returns True if C is outside, that is, a corner of the hull of the images and C. The edge whose image is C is then
convex. Only the sense of rotation of the images about C matters, so the images may be known up to an affine map, and no
square root is needed.
"""

from collections.abc import Callable, Sequence
from functools import cmp_to_key
from itertools import pairwise

Image = tuple[int, int]
StarTest = Callable[[Sequence[Image]], bool]


def vorticity(a: Image, b: Image) -> int:
    """Return twice the area of the triangle C, a, b, positive for a counterclockwise rotation (Fig. 8)."""
    return a[0] * b[1] - a[1] * b[0]


def on_one_ray(a: Image, b: Image) -> bool:
    """Return True if a and b lie in one direction from C (I and II of Fig. 12; in III they are opposite)."""
    return vorticity(a, b) == 0 and a[0] * b[0] + a[1] * b[1] > 0


def star_polygon(images: Sequence[Image]) -> list[Image]:
    """Sort the images by increasing polar angle about C, from 0 to below 360 degrees (Figs. 10 and 11)."""
    return sorted(images, key=cmp_to_key(_angle))


def as_printed(images: Sequence[Image]) -> bool:
    """Apply the test as printed: outside if a side turns clockwise *or if two images are on one ray*.

    The second condition ("In instances I and II ... the point being tested is considered as being outside") is wrong.
    For a cube it makes the diagonals of all faces convex edges.
    """
    star = star_polygon(images)
    return not star or any(vorticity(a, b) < 0 or on_one_ray(a, b) for a, b in _sides(star))


def as_corrected(images: Sequence[Image]) -> bool:
    """Apply the corrected test: outside if a side turns clockwise, or if all images are on one ray.

    A side that turns clockwise spans more than 180 degrees of the turn about C. A side of exactly 180 degrees
    (possibility III of Fig. 12) contains C, so C is not a corner.
    """
    # Two images on one ray say nothing about the angle between the rays, so sides along a ray are skipped.
    sides = [(a, b) for a, b in _sides(star_polygon(images)) if not on_one_ray(a, b)]
    return not sides or any(vorticity(a, b) < 0 for a, b in sides)


def in_one_pass(images: Sequence[Image]) -> bool:
    """Decide the same as :func:`as_corrected` without sorting.

    C is outside if all images lie within an angle of less than 180 degrees. ``first`` and ``last`` are the images
    that bound that angle so far, counterclockwise.
    """
    if not images:
        return True
    first = last = images[0]
    for image in images:
        from_first, from_last = vorticity(first, image), vorticity(last, image)
        if from_first >= 0 >= from_last:
            # The image is within the angle, unless the angle is still a single ray and the image lies opposite to it.
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
    """List the sides of the star polygon, including the one from the last point to the first."""
    return [*pairwise(star), (star[-1], star[0])] if star else []


def _angle(a: Image, b: Image) -> int:
    """Compare by polar angle: the angles from 0 to below 180 degrees come first."""
    lower_a, lower_b = _is_lower(a), _is_lower(b)
    return lower_a - lower_b if lower_a != lower_b else -vorticity(a, b)


def _is_lower(a: Image) -> bool:
    return a[1] < 0 or (a[1] == 0 and a[0] < 0)
