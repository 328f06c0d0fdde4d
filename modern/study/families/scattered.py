"""Draw points in a box, in a ball, on a sphere or on a cube, and draw prisms, pyramids and nearly flat sets.

Only integers are drawn.  A decimal is an integer times a power of ten.
"""

from math import isqrt

from modern.geometry.numbers import scaled_decimal
from modern.study.families.draws import DIGITS, Count, Draw, Drawn, FamilyError, Whole, drawn, size_of, whole_range

# A direction is drawn as a point of a grid with this radius, before the point is scaled and rounded.
FINE = 10**12


def integers(draw: Draw, digits: int, n: Count) -> Drawn:
    """Points whose coordinates are random integers from -(10**digits - 1) to 10**digits - 1."""
    return box(draw, size_of(digits), n)


def box(draw: Draw, most: int, n: Count, centre: int = 0) -> Drawn:
    """Points whose coordinates are random integers from centre - most to centre + most."""
    if not isinstance(most, int) or not isinstance(centre, int) or most < 1 or abs(centre) + most > size_of(DIGITS):
        given = f"found most = {most} and centre = {centre}"
        raise FamilyError(f"expected integers, most of at least 1, and coordinates of at most {DIGITS} digits, {given}")

    def point() -> Whole:
        x, y, z = (draw.whole(centre - most, centre + most) for _ in range(3))
        return x, y, z

    return drawn(draw.distinct(draw.count(n), point))


def decimals(draw: Draw, digits: int, n: Count, exponent: Count = (0, 1)) -> Drawn:
    """Points whose coordinates are decimals of exactly ``digits`` digits: .12345 times a power of ten, of either sign.

    exponent: the exponent of the power of ten, or a pair of the least and the greatest exponent.  For a pair, the
    exponent of each coordinate is drawn from this range.  Coordinates with different exponents have digits in different
    decimal places, so their difference has more digits.
    """
    low, high = whole_range(exponent, "exponent")
    if not -20 <= low <= high <= 20:
        raise FamilyError(f"exponent: expected -20 to 20, found {low} to {high}")
    least, most = 10 ** (digits - 1), size_of(digits)

    def coordinate() -> str:
        mantissa = draw.whole(least, most)
        while digits > 1 and mantissa % 10 == 0:
            mantissa = draw.whole(least, most)
        return scaled_decimal(mantissa * (1 - 2 * draw.whole(0, 1)), draw.whole(low, high) - digits)

    return Drawn(tuple(draw.distinct(draw.count(n), lambda: (coordinate(), coordinate(), coordinate()))))


def ball(draw: Draw, digits: int, n: Count) -> Drawn:
    """Integer points uniformly distributed in the ball of radius 10**digits - 1."""
    size = size_of(digits)
    return drawn(draw.distinct(draw.count(n), lambda: in_ball(draw, size)))


def sphere(draw: Draw, digits: int, n: Count) -> Drawn:
    """Points uniformly distributed on the sphere of radius 10**digits - 1, rounded to the nearest integer point."""
    size = size_of(digits)
    return drawn(draw.distinct(draw.count(n), lambda: on_sphere(draw, size)))


def cube(draw: Draw, digits: int, n: Count) -> Drawn:
    """Integer points uniformly distributed on the six faces of the cube from -(10**digits - 1) to 10**digits - 1."""
    size = size_of(digits)

    def point() -> Whole:
        coordinates = [draw.whole(-size, size) for _ in range(3)]
        coordinates[draw.whole(0, 2)] = size * (1 - 2 * draw.whole(0, 1))
        return coordinates[0], coordinates[1], coordinates[2]

    return drawn(draw.distinct(draw.count(n), point))


def in_ball(draw: Draw, size: int) -> Whole:
    """Return a random integer point of the ball with radius ``size``; it may be the centre."""
    while True:
        x, y, z = (draw.whole(-size, size) for _ in range(3))
        if x * x + y * y + z * z <= size * size:
            return x, y, z


def on_sphere(draw: Draw, size: int) -> Whole:
    """Return the integer point nearest to a random point of the sphere with radius ``size``."""
    x, y, z = in_ball(draw, FINE)
    while not (x or y or z):
        x, y, z = in_ball(draw, FINE)
    length = isqrt(x * x + y * y + z * z)
    return nearest(size * x, length), nearest(size * y, length), nearest(size * z, length)


def nearest(number: int, divisor: int) -> int:
    """Return the integer nearest to number/divisor; halves are rounded away from zero."""
    size = (2 * abs(number) + divisor) // (2 * divisor)
    return size if number >= 0 else -size


def prism(draw: Draw, digits: int, n: Count) -> Drawn:
    """The points of a prism, in random order: a polygon and its copy moved along an axis, at least 6 points.

    The points of the polygon are rounded from a circle.  All coordinates have absolute values up to 10**digits - 1.
    """
    size = size_of(digits)
    half = max(3, draw.count(n) // 2)
    base = _base(draw, half, size)
    low, high = draw.whole(-size, -1), draw.whole(0, size)
    return _turned(draw, [(x, y, z) for z in (low, high) for x, y in base], "prism")


def pyramid(draw: Draw, digits: int, n: Count) -> Drawn:
    """The points of a pyramid, in random order: a polygon and an apex, at least 4 points."""
    size = size_of(digits)
    base = _base(draw, max(3, draw.count(n) - 1), size)
    apex = draw.whole(-size, size), draw.whole(-size, size), draw.whole(1, size)
    return _turned(draw, [*((x, y, 0) for x, y in base), apex], "pyramid")


def near_coplanar(draw: Draw, digits: int, n: Count, gap: int) -> Drawn:
    """Points nearly in one plane: about a third of them are raised or lowered by 10**-gap.

    x and y are integers of up to ``digits`` digits, and z = p x + q y + s 10**-gap with p, q and s among -1, 0 and 1.
    There are at least 4 points, and at least one lies off the plane.  If z has more than eight digits, no card holds
    the point, and the plan is rejected.
    """
    size, unit = size_of(digits), 10**gap
    if not isinstance(gap, int) or gap < 0:
        raise FamilyError(f"gap: expected an integer of at least 0, for a gap of 10**-gap, found {gap}")
    p, q = draw.whole(-1, 1), draw.whole(-1, 1)
    base = draw.distinct(max(4, draw.count(n)), lambda: (draw.whole(-size, size), draw.whole(-size, size), 0))
    lifts = [draw.random.choice((0, 0, 0, 0, 1, -1)) for _ in base]
    lifts[draw.whole(0, len(lifts) - 1)] = 1
    points = [(x * unit, y * unit, (p * x + q * y) * unit + lift) for (x, y, _), lift in zip(base, lifts, strict=True)]
    return drawn(points, gap)


def _base(draw: Draw, count: int, size: int) -> list[tuple[int, int]]:
    def point() -> Whole:
        while True:
            x, y = draw.whole(-FINE, FINE), draw.whole(-FINE, FINE)
            if 0 < x * x + y * y <= FINE * FINE:
                length = isqrt(x * x + y * y)
                return nearest(size * x, length), nearest(size * y, length), 0

    return [(x, y) for x, y, _ in draw.distinct(count, point)]


def _turned(draw: Draw, points: list[Whole], kind: str) -> Drawn:
    axes = [0, 1, 2]
    draw.random.shuffle(axes)
    draw.random.shuffle(points)
    return drawn([(p[axes[0]], p[axes[1]], p[axes[2]]) for p in points], kind=kind)
