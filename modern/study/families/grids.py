"""Whole numbers and decimals of so many digits, and whole numbers of a box."""

from __future__ import annotations

from modern.port.arithmetic import scaled_decimal
from modern.study.families.drawing import DIGITS, Count, Draw, Drawn, FamilyError, Whole, drawn, size_of, whole_range


def integers(draw: Draw, digits: int, n: Count) -> Drawn:
    """Whole numbers from -(10**digits - 1) to 10**digits - 1, each coordinate uniform."""
    size = size_of(digits)

    def point() -> Whole:
        return draw.whole(-size, size), draw.whole(-size, size), draw.whole(-size, size)

    return drawn(draw.distinct(draw.count(n), point))


def box(draw: Draw, most: int, n: Count, centre: int = 0) -> Drawn:
    """Whole numbers from centre - most to centre + most, each coordinate uniform."""
    if not isinstance(most, int) or not isinstance(centre, int) or most < 1 or abs(centre) + most > size_of(DIGITS):
        raise FamilyError(f"most is {most}, centre {centre}; a card holds whole numbers of {DIGITS} digits")

    def point() -> Whole:
        x, y, z = (draw.whole(centre - most, centre + most) for _ in range(3))
        return x, y, z

    return drawn(draw.distinct(draw.count(n), point))


def decimals(draw: Draw, digits: int, n: Count, exponent: Count = (0, 1)) -> Drawn:
    """Decimals of exactly ``digits`` significant digits and either sign, as .12345 times a power of ten.

    exponent: the power, or the least and the greatest it is drawn from, for each coordinate anew: with more than
    one the digits of two coordinates do not stand one under the other, and a difference of them has more.
    """
    low, high = whole_range(exponent, "exponent")
    if not -20 <= low <= high <= 20:
        raise FamilyError(f"exponent is {low} to {high}; it is from -20 to 20")
    least, most = 10 ** (digits - 1), size_of(digits)

    def coordinate() -> str:
        mantissa = draw.whole(least, most)
        while digits > 1 and mantissa % 10 == 0:
            mantissa = draw.whole(least, most)
        return scaled_decimal(mantissa * (1 - 2 * draw.whole(0, 1)), draw.whole(low, high) - digits)

    count = draw.count(n)
    found: dict[tuple[str, str, str], None] = {}
    for _ in range(200 * count):
        if len(found) < count:
            found[coordinate(), coordinate(), coordinate()] = None
    if len(found) < count:
        raise FamilyError(f"{count} distinct points were not found")
    return Drawn(tuple(found))
