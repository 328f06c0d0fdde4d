"""Prisms and pyramids, whose faces contain many points, and points that lie nearly in one plane."""

from math import isqrt

from modern.study.families.draws import Count, Draw, Drawn, FamilyError, Whole, drawn, size_of
from modern.study.families.scattered import FINE, nearest


def prism(draw: Draw, digits: int, n: Count) -> Drawn:
    """A polygon and its copy moved along an axis: an even number of points, at least 6, in random order.

    The points of the polygon are rounded from a circle.  All coordinates have absolute values up to 10**digits - 1.
    """
    size = size_of(digits)
    half = max(3, draw.count(n) // 2)
    base = _base(draw, half, size)
    low, high = draw.whole(-size, -1), draw.whole(0, size)
    return _turned(draw, [(x, y, z) for z in (low, high) for x, y in base], "prism")


def pyramid(draw: Draw, digits: int, n: Count) -> Drawn:
    """A polygon and an apex, at least 4 points, in random order, with coordinates up to 10**digits - 1."""
    size = size_of(digits)
    base = _base(draw, max(3, draw.count(n) - 1), size)
    apex = draw.whole(-size, size), draw.whole(-size, size), draw.whole(1, size)
    return _turned(draw, [*((x, y, 0) for x, y in base), apex], "pyramid")


def near_coplanar(draw: Draw, digits: int, n: Count, gap: int) -> Drawn:
    """Points of a plane, about a third of them raised or lowered by 10**-gap.

    x and y are integers of up to ``digits`` digits, and z = p x + q y + s 10**-gap with p, q and s among -1, 0 and 1.
    There are at least 4 points, and at least one lies off the plane.  If z has more than eight digits, no card holds
    the point, and the plan is rejected.
    """
    size, unit = size_of(digits), 10**gap
    if not isinstance(gap, int) or gap < 0:
        raise FamilyError(f"gap: expected 0 or more, for 10**-gap, found {gap}")
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
    """Shuffle the points and exchange their axes at random."""
    axes = [0, 1, 2]
    draw.random.shuffle(axes)
    draw.random.shuffle(points)
    return drawn([(p[axes[0]], p[axes[1]], p[axes[2]]) for p in points], kind=kind)
