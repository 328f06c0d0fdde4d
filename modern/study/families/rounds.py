"""Ball, sphere and the surface of a cube, on the grid of whole numbers, drawn without a floating-point operation."""

from __future__ import annotations

from math import isqrt

from modern.study.families.drawing import Count, Draw, Drawn, Whole, drawn, size_of

_FINE = 10**12


def ball(draw: Draw, digits: int, n: Count) -> Drawn:
    """Uniform among the grid points of the ball of radius 10**digits - 1."""
    size = size_of(digits)
    return drawn(draw.distinct(draw.count(n), lambda: in_ball(draw, size)))


def sphere(draw: Draw, digits: int, n: Count) -> Drawn:
    """Directions uniform on the sphere of radius 10**digits - 1, each rounded to the nearest grid point."""
    size = size_of(digits)
    return drawn(draw.distinct(draw.count(n), lambda: on_sphere(draw, size)))


def cube(draw: Draw, digits: int, n: Count) -> Drawn:
    """Uniform on the six faces of the cube from -(10**digits - 1) to 10**digits - 1."""
    size = size_of(digits)

    def point() -> Whole:
        place = [draw.whole(-size, size) for _ in range(3)]
        place[draw.whole(0, 2)] = size * (1 - 2 * draw.whole(0, 1))
        return place[0], place[1], place[2]

    return drawn(draw.distinct(draw.count(n), point))


def in_ball(draw: Draw, size: int) -> Whole:
    """A grid point of the ball of that radius, the centre too."""
    while True:
        x, y, z = (draw.whole(-size, size) for _ in range(3))
        if x * x + y * y + z * z <= size * size:
            return x, y, z


def on_sphere(draw: Draw, size: int) -> Whole:
    """The grid point nearest to a point of the sphere of that radius."""
    x, y, z = in_ball(draw, _FINE)
    while not (x or y or z):
        x, y, z = in_ball(draw, _FINE)
    length = isqrt(x * x + y * y + z * z)
    return nearest(size * x, length), nearest(size * y, length), nearest(size * z, length)


def nearest(number: int, divisor: int) -> int:
    """The whole number nearest to number/divisor, halves away from zero."""
    size = (2 * abs(number) + divisor) // (2 * divisor)
    return size if number >= 0 else -size
