"""Operands for the published vectors: the boundary cases of each operation, and a fixed sequence of numbers."""

from collections.abc import Iterator
from fractions import Fraction
from itertools import product

from tests.support.published.specification import Arithmetic, Number, ten

Pair = tuple[Number, Number]


class Sequence:
    """Pseudo-random integers that are the same on every machine (Lehmer's generator, modulus 2**61 - 1)."""

    def __init__(self, seed: int) -> None:
        self.state = seed * 7919 + 12345

    def below(self, bound: int) -> int:
        """Return an integer from 0 to ``bound`` - 1."""
        value = 0
        for _ in range(bound.bit_length() // 48 + 1):
            self.state = self.state * 437799614237992725 % (2**61 - 1)
            value = (value << 48) + (self.state >> 13)
        return value % bound

    def one_of(self, *choices: int) -> int:
        return choices[self.below(len(choices))]


def number(mantissa: int, e: int, by: Arithmetic) -> Number:
    """Return ``.ddd * 10**e`` from its digits.  A mantissa of 0 gives a plus zero."""
    return Number(mantissa < 0, abs(mantissa) * ten(e - by.digits))


def zero(minus: bool = False) -> Number:
    return Number(minus, Fraction(0))


def edges(by: Arithmetic) -> list[int]:
    """Return mantissas at which the behaviour changes: powers of ten, halves and all nines."""
    low, high = 10 ** (by.digits - 1), 10**by.digits
    five, fifteen = 5 * low, 15 * low // 10
    mantissas = [low, low + 1, low + 5, fifteen, five - 1, five, five + 1, 9 * low, high - 10, high - 5, high - 1]
    return sorted(set(mantissas))


def mantissa(by: Arithmetic, sequence: Sequence) -> int:
    """Return a mantissa, every second one from :func:`edges`."""
    if sequence.below(2):
        mantissas = edges(by)
        return mantissas[sequence.below(len(mantissas))]
    low = 10 ** (by.digits - 1)
    return low + sequence.below(9 * low)


def signed(size: int, sequence: Sequence) -> int:
    return -size if sequence.below(2) else size


def zero_pairs(by: Arithmetic) -> Iterator[Pair]:
    """Yield every combination of signs of a pair that contains a zero."""
    some = number(25 * 10 ** (by.digits - 2), 1, by)
    numbers = [zero(), zero(True), some, some.reversed()]
    yield from ((a, b) for a, b in product(numbers, numbers) if not (a.size and b.size))


def sum_bounds(by: Arithmetic) -> Iterator[Pair]:
    """Yield zeros, sums at both ends of the range, and sums that only rounding moves out of range."""
    yield from zero_pairs(by)
    low, high, p = 10 ** (by.digits - 1), 10**by.digits - 1, by.digits
    top = number(high, 99, by)
    for half in (5 * low - 1, 5 * low, high):
        for sign in (1, -1):
            yield number(sign * high, 99, by), number(sign * half, 99 - p, by)
            yield number(sign * half, 99 - p, by), number(sign * high, 99, by)
    yield from ((top, number(low, 99, by)), (top.reversed(), number(-low, 99, by)), (top, top.reversed()))
    yield number(5 * low, 99, by), number(-5 * low - 1, 99, by)
    for a, b in product((low, low + 1, high), repeat=2):
        for first, second in ((1, 1), (1, -1), (-1, 1)):
            yield number(first * a, -99, by), number(second * b, -99, by)
    # Sums that are exactly a power of ten.
    for sign in (1, -1):
        yield number(sign * 5 * low, 1, by), number(sign * 5 * low, 1, by)
        yield number(sign * high, 1, by), number(sign * low, 2 - p, by)
    yield number(high, 1, by), number(6 * low, 1 - p, by)
    yield number(-6 * low, 1 - p, by), number(-high, 1, by)
    yield number(low, -98, by), number(-high, -99, by)
    yield number(-low, -98, by), number(high, -99, by)


def sums(by: Arithmetic) -> Iterator[Pair]:
    """Yield pairs with every shift from 0 to more than P digits, near 1 and at both ends of the range."""
    sequence, p = Sequence(by.digits), by.digits
    for _ in range(2000):
        shift = sequence.one_of(0, 0, 1, 1, 2, max(p - 1, 0), p, p + 1, sequence.below(p + 4), 40)
        e = sequence.one_of(1, 1, 0, -5, 99, shift - 99, sequence.below(100) - 50 + shift)
        a, b = signed(mantissa(by, sequence), sequence), signed(mantissa(by, sequence), sequence)
        if max(e, e - shift) <= 99 and e - shift >= -99:
            pair = number(a, e, by), number(b, e - shift, by)
            yield pair if sequence.below(2) else (pair[1], pair[0])


def product_bounds(by: Arithmetic) -> Iterator[Pair]:
    """Yield zeros, products at both ends of the range, and products of nines that rounding carries."""
    yield from zero_pairs(by)
    low, high = 10 ** (by.digits - 1), 10**by.digits - 1
    exponents = (50, 49), (50, 50), (99, 1), (1, 99), (-50, -49), (-49, -49), (-99, 0), (-99, 1)
    for a, b in ((low, low), (high, -high), (-low - 1, high - 9)):
        yield from ((number(a, e, by), number(b, f, by)) for e, f in exponents)
    # A product that is exactly a power of ten.
    yield number(2 * low, 1, by), number(5 * low, 1, by)
    yield number(-4 * low, 3, by), number(25 * low // 10, -1, by)
    # With two digits .12 * .83 is the only product that rounding carries; with more it is exact.
    yield number(12 * low // 10, 1, by), number(83 * low // 10, 0, by)
    yield number(low + 1, 1, by), number(high - 9, 0, by)
    yield number(low + 1, 99, by), number(-(high - 9), 1, by)
    yield number(low + 1, -98, by), number(high - 9, 0, by)


def products(by: Arithmetic) -> Iterator[Pair]:
    """Yield pairs, some with a product next to a tie or next to an integer multiple of the last place."""
    sequence, p = Sequence(by.digits + 100), by.digits
    for _ in range(2000):
        e, f = sequence.below(60) - 30, sequence.below(60) - 30
        a = mantissa(by, sequence)
        b = mantissa(by, sequence)
        way = sequence.below(3)
        if way and a % 2 and a % 5:
            remainder = (5 * 10 ** (p - 1) + sequence.one_of(1, -1)) if way == 1 else sequence.one_of(1, -1)
            b = remainder * pow(a, -1, 10**p) % 10**p
            if b < 10 ** (p - 1):
                continue
        yield number(signed(a, sequence), e, by), number(signed(b, sequence), f, by)


def quotient_bounds(by: Arithmetic) -> Iterator[Pair]:
    """Yield zeros, quotients at both ends of the range, and exact ties (odd numbers / 2, and (8n + 4) / 8)."""
    yield from zero_pairs(by)
    low, high = 10 ** (by.digits - 1), 10**by.digits - 1
    exponents = (50, -49), (50, -50), (99, 1), (99, 0), (-50, 49), (-50, 50), (-99, 1), (-99, 0)
    for a, b in ((low, low), (low, -high), (-high, low + 1)):
        yield from ((number(a, e, by), number(b, f, by)) for e, f in exponents)
    for a in (2 * low + 1, 2 * low + 3, high):
        yield number(a, 3, by), number(2 * low, 1, by)
        yield number(-a, 3, by), number(2 * low, 1, by)
    for n in (low, low + 1, (high - 4) // 8):
        if low <= 8 * n + 4 <= high:
            yield number(8 * n + 4, 2, by), number(-8 * low, 1, by)


def quotients(by: Arithmetic) -> Iterator[Pair]:
    """Yield pairs, some with a quotient as near as possible to a tie or to a multiple of the last place."""
    sequence, p = Sequence(by.digits + 200), by.digits
    for _ in range(2000):
        e, f = sequence.below(60) - 30, sequence.below(60) - 30
        a, b = mantissa(by, sequence), mantissa(by, sequence)
        way = sequence.below(3)
        if way and b % 2 and b % 5:
            remainder = (b + sequence.one_of(1, -1)) // 2 if way == 1 else sequence.one_of(1, -1)
            a = remainder * pow(10**p, -1, b) % b
            if a < 10 ** (p - 1):
                continue
        yield number(signed(a, sequence), e, by), number(signed(b, sequence), f, by)


def comparisons(by: Arithmetic) -> Iterator[Pair]:
    """Yield equal numbers, numbers that differ in the last place, and the pairs of :func:`sums`."""
    sequence = Sequence(by.digits + 300)
    yield from zero_pairs(by)
    low, high = 10 ** (by.digits - 1), 10**by.digits - 1
    for a in edges(by):
        e = sequence.below(20)
        yield number(a, e, by), number(a, e, by)
        yield number(-a, e, by), number(-a, e, by)
        if low < a < high:
            yield number(a, e, by), number(a + 1, e, by)
            yield number(-a, e, by), number(-a + 1, e, by)
    yield number(low, 1, by), number(high, 0, by)
    yield number(-low, 1, by), number(-high, 0, by)
    for sign in (1, -1):
        yield number(sign * (low + 1), -99, by), number(sign * low, -99, by)
        yield number(sign * low, -99, by), number(sign * (low + 1), -99, by)
        yield number(sign * high, 99, by), number(-sign * high, 99, by)
    yield from sums(by)


def powers(by: Arithmetic) -> Iterator[tuple[Number, int]]:
    """Yield numbers of one digit and of all digits, with powers inside, at the ends of, and outside the range."""
    sequence = Sequence(by.digits + 400)
    low = 10 ** (by.digits - 1)
    small = [2 * low, 3 * low, 11 * low // 10, low + 1, 9 * low, 10 * low - 1]
    for _ in range(2000):
        a = signed(sequence.one_of(*small, mantissa(by, sequence)), sequence)
        count = sequence.one_of(0, 1, 2, 3, 4, 5, 7, 10, 20, sequence.below(99), -1, -2, -3, -5, -10)
        e = sequence.one_of(1, 1, 0, 2, 5, -3)
        yield number(a, e, by), count


def power_bounds(by: Arithmetic) -> Iterator[tuple[Number, int]]:
    low, high = 10 ** (by.digits - 1), 10**by.digits - 1
    for count in (0, 1, 2, 3, 9999, -1, -2, -9999):
        yield zero(), count
    yield zero(True), 2
    for count in (9999, 9998, -9999):
        yield from ((number(a, 1, by), count) for a in (2 * low, -2 * low, low, -low))
        yield from ((number(a, 0, by), count) for a in (5 * low, -5 * low))
    for a, e, count in ((low, 50, 2), (low, 51, 2), (high, 49, 2), (-low, 34, 3), (-low, 33, 3), (low, -49, 2)):
        yield number(a, e, by), count
    for a, e, count in ((low, -48, 2), (-low, -33, 3), (-low, -32, 3), (low, 99, -1), (-low, -98, -1), (-low, -99, -1)):
        yield number(a, e, by), count
    for a, e, count in ((low, 50, -2), (low, 51, -2), (low + 1, 50, -2), (-low, -99, 1), (high, 99, 1)):
        yield number(a, e, by), count


def singles(by: Arithmetic) -> Iterator[Number]:
    """Yield zeros, both ends of the range, then numbers of every size."""
    sequence = Sequence(by.digits + 500)
    low, high = 10 ** (by.digits - 1), 10**by.digits - 1
    yield from (zero(), zero(True), number(low, -99, by), number(-low, -99, by))
    yield from (number(high, 99, by), number(-high, 99, by), number(5 * low, 0, by), number(-5 * low, 0, by))
    for e in (0, 1, 2, 3, 4, 5, 6, by.digits, by.digits + 1, by.digits + 3, by.digits + 4, by.digits + 5):
        for a in (low, high, 12 * low // 10, low + sequence.below(9 * low)):
            yield number(signed(a, sequence), e, by)
    for _ in range(1500):
        yield number(signed(mantissa(by, sequence), sequence), sequence.below(24) - 6, by)


def radicands(by: Arithmetic) -> Iterator[Number]:
    """Yield zero, both ends of the range, squares, their neighbours, and numbers with odd and even exponents."""
    sequence = Sequence(by.digits + 600)
    low, high = 10 ** (by.digits - 1), 10**by.digits - 1
    yield zero()
    for a, e in product((low, 2 * low, high), (99, 98, -99, -98)):
        yield number(a, e, by)
    root = 10 ** ((by.digits - 1) // 2)
    for k in (root, root + 1, 2 * root, 3 * root):
        square = k * k
        while square * 10 <= high:
            square *= 10
        for e in (1, 2, 10, -5, -6):
            for a in (square, square + 1, square - 1):
                if low <= a <= high:
                    yield number(a, e, by)
    yield from (number(-2 * low, 1, by), number(-4 * low, 1, by))
    for _ in range(1500):
        a = mantissa(by, sequence)
        yield number(-a if sequence.below(8) == 0 else a, sequence.below(60) - 30, by)


def integer_pairs() -> Iterator[tuple[int, int]]:
    """Yield pairs of fixed-point numbers: the bounds, both signs, zeros, then others."""
    sequence = Sequence(7)
    some = (0, 1, -1, 7, -7, 100, 9999, -9999, 5000, -5001)
    yield from ((9998, 1), (-9998, -1), (-9999, 0), (1, -9998), (9998, -1), (99, 101), (-9, 1111), (3333, 3))
    yield from product(some, some)
    for _ in range(2000):
        bound, second_bound = sequence.one_of(10, 100, 1000, 10_000), sequence.one_of(10, 100, 10_000)
        yield signed(sequence.below(bound), sequence), signed(sequence.below(second_bound), sequence)
