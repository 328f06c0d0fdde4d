"""The star polygon test (section "Polygon star test"): is C within the hull of points in a plane?

Every function here takes the images of points relative to C, none of them at C itself, as pairs of integers, and
tells whether C is outside of the hull of the images and C together, that is a corner of it: then the edge that C is
the image of is convex.  Only the sense of rotation of images about C is used, so the images may be those of any affine
map; no square root is needed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cmp_to_key
from itertools import pairwise

Image = tuple[int, int]
StarTest = Callable[[Sequence[Image]], bool]


def vorticity(a: Image, b: Image) -> int:
    """Twice the area of the triangle C, a, b: positive for a counterclockwise rotation (Fig. 8)."""
    return a[0] * b[1] - a[1] * b[0]


def on_one_ray(a: Image, b: Image) -> bool:
    """Whether a and b are in one direction from C: possibilities I and II of Fig. 12 (of III they are opposite)."""
    return vorticity(a, b) == 0 and a[0] * b[0] + a[1] * b[1] > 0


def star_polygon(images: Sequence[Image]) -> list[Image]:
    """The images by increasing polar angle about C, from 0 to below 360 degrees (Figs. 10 and 11)."""
    return sorted(images, key=cmp_to_key(_angle))


def as_printed(images: Sequence[Image]) -> bool:
    """The test as printed: outside where a side of the star polygon turns clockwise *or two images are on one ray*.

    The second half ("In instances I and II ... the point being tested is considered as being outside") is wrong: of
    a cube it makes edges of the diagonals of all faces.
    """
    star = star_polygon(images)
    return not star or any(vorticity(a, b) < 0 or on_one_ray(a, b) for a, b in _sides(star))


def as_corrected(images: Sequence[Image]) -> bool:
    """The test as it must be: images on one ray carry no information, unless all of them are on one.

    A side that turns clockwise spans more than 180 degrees of the turn about C.  A side of exactly 180 degrees
    (possibility III of Fig. 12) has C within it, so C is no corner.
    """
    sides = [(a, b) for a, b in _sides(star_polygon(images)) if not on_one_ray(a, b)]
    return not sides or any(vorticity(a, b) < 0 for a, b in sides)


def in_one_pass(images: Sequence[Image]) -> bool:
    """What :func:`as_corrected` finds, without sorting: whether all images are in one angle of less than 180 degrees.

    ``first`` and ``last`` bound the angle of the images so far, counterclockwise.
    """
    if not images:
        return True
    first = last = images[0]
    for image in images:
        from_first, from_last = vorticity(first, image), vorticity(last, image)
        if from_first >= 0 >= from_last:
            if from_first == 0 and from_last == 0 and not on_one_ray(first, image):
                return False
            continue
        if from_first > 0 and from_last > 0:
            last = image
        elif from_first < 0 and from_last < 0:
            first = image
        else:
            return False
    return True


def _sides(star: Sequence[Image]) -> list[tuple[Image, Image]]:
    """The sides of the star polygon, the one from the last point to the first included."""
    return [*pairwise(star), (star[-1], star[0])] if star else []


def _angle(a: Image, b: Image) -> int:
    """Order by polar angle: first those from 0 to below 180 degrees."""
    lower_a, lower_b = _is_lower(a), _is_lower(b)
    return lower_a - lower_b if lower_a != lower_b else -vorticity(a, b)


def _is_lower(a: Image) -> bool:
    return a[1] < 0 or (a[1] == 0 and a[0] < 0)
