"""Floating-point images of integer points and planes, with a bound on what a sign computed from them may be off.

Points are moved by an integer vector so that they lie about the origin, then every axis is divided by its own power
of two, so that every image |x| <= 1.  A plane A x + B y + C z + D through one of the points is divided by the power
of two that brings the largest of |A| 2^k, |B| 2^l, |C| 2^m (2^k, 2^l, 2^m: the divisors of the axes) to at most 1;
then |D| <= 3.  All images are the nearest float64 (Python's int / int rounds correctly at any length).

The bound.  With e = 2**-54 the images of x and A are off by at most e each, that of D by 4e.  A product of images
is off by 2e, and by e more once rounded; three of them by 9e.  The three additions, in any order and with or without
fused products, meet partial sums below 8 and round by at most 8e each, 24e together.  The sum is off by at most
9e + 4e + 24e = 37e < 64e = 2**-48.  Underflow adds at most some 2**-1070.  So a computed value beyond 2**-48 has the
true sign, and anything nearer to zero is decided in integers.

When the points are small enough all of this arithmetic is exact and the bound is 0; see ``Frame.bound``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from modern.exact_hull.coordinates import IntPoint
from modern.exact_hull.result import Plane

BOUND = 2.0**-48


@dataclass(frozen=True, slots=True)
class Frame:
    """The points a hull is built in: integers about the origin, and their images.

    integers: the points less ``centre``.  images: (n, 4) float64, the fourth column 1.
    shifts: the powers of two that divide the axes.
    bound: 2**-48, or 0 if a plane's value is an integer below 2**53 in all its steps, when float64 is exact: for
    |x| <= X, |y| <= Y, |z| <= Z the normal of a plane through three points is at most 8YZ, 8ZX, 8XY, its D at most
    24XYZ, and every partial sum at most 48XYZ.
    """

    centre: IntPoint
    shifts: IntPoint
    integers: list[IntPoint]
    images: NDArray[np.float64]
    bound: float


def frame(points: Sequence[IntPoint]) -> Frame:
    """The frame of points that do not lie in one plane."""
    columns = list(zip(*points, strict=True))
    centre = tuple((min(column) + max(column)) // 2 for column in columns)
    moved = [[number - middle for number in column] for column, middle in zip(columns, centre, strict=True)]
    largest = [max(max(column), -min(column)) for column in moved]
    shifts = tuple(number.bit_length() for number in largest)
    images = np.ones((len(points), 4))
    for axis in range(3):
        divisor = 1 << shifts[axis]
        images[:, axis] = [number / divisor for number in moved[axis]]
    exact = 48 * largest[0] * largest[1] * largest[2] < 2**53
    return Frame(
        (centre[0], centre[1], centre[2]),
        (shifts[0], shifts[1], shifts[2]),
        list(zip(*moved, strict=True)),
        images,
        0.0 if exact else BOUND,
    )


def plane_image(plane: Plane, shifts: IntPoint) -> tuple[float, float, float, float]:
    """The image of a plane through a point of the frame (its integers, not the points as given)."""
    a, b, c, d = plane
    k, l, m = shifts  # noqa: E741
    power = max(
        a.bit_length() + k if a else 0,
        b.bit_length() + l if b else 0,
        c.bit_length() + m if c else 0,
    )
    return (
        a / (1 << power - k) if a else 0.0,
        b / (1 << power - l) if b else 0.0,
        c / (1 << power - m) if c else 0.0,
        d / (1 << power),
    )
