"""The arithmetics ``stochastic:P:SEED`` and ``stochastic:BITSb:SEED``, which round decimal or binary results at
random.

:mod:`emulator.numbers.draws` defines the rules of rounding, their sources and the random numbers.  + - * /, the
library functions and powers round the exact result once.  FLOAT, cards and constants are converted without randomness:
decimal numbers are truncated, and binary numbers are rounded to nearest.  Binary numbers have the range of ``mp:BITS``,
so ``stochastic:53b:SEED`` has the precision of binary64 and a larger range.

``stochastic:8:1-10`` runs the seeds 1 to 10 in step (:mod:`emulator.numbers.sampled`).  If there are three runs in
step, the third rounds in the opposite direction to the second, as in CADNA.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

from mpmath.libmp import from_man_exp, mpf_add, mpf_mul, mpf_sub

from emulator.errors import ArgumentError
from emulator.numbers import accumulator
from emulator.numbers.arithmetic import MAX_DIGITS, MIN_DIGITS, Profile, Rules, drawn, rules_of
from emulator.numbers.decimal import DecimalNumbers
from emulator.numbers.draws import CESTAC, MAX_SEED, OPPOSITE, PROPORTIONAL, draw, key_of, randomly
from emulator.numbers.multiprecision import MAX_BITS, MIN_BITS, MultiprecisionNumbers
from emulator.numbers.sampled import MAJORITY, SampledNumbers

NAME = "stochastic"
# The largest number of runs in step.
MAX_RUNS = 1_000
_FORM = re.compile(
    NAME + r":(?P<size>\d{1,9})(?P<binary>b?):(?P<seed>\d{1,10})(-(?P<last>\d{1,10}))?"
    r"(?P<proportional>:proportional)?(?P<majority>:majority)?",
    re.ASCII,
)
# The guard digits of sums.  The proportional rule compares the digits that are cut off with a draw of eight digits; the
# other rules only compare them with zero.
_GUARD, _FEW = 9, 2


@dataclass(frozen=True)
class StochasticNumbers(DecimalNumbers):
    """The arithmetic of decimal numbers that rounds at random."""

    _taken: list[int] = field(default_factory=lambda: [0], compare=False, repr=False)

    @property
    def _drawn(self) -> Rules:  # each access takes the next random number
        self._taken[0] += 1
        return drawn(self._rules, self._taken[0])

    def fresh(self) -> StochasticNumbers:
        return StochasticNumbers(self.profile)

    def seeded(self, seed: int) -> StochasticNumbers:
        """Return the same arithmetic with another seed."""
        return StochasticNumbers(_profile(self.profile.digits, seed, self._rules.random))


@dataclass(frozen=True)
class StochasticBinaryNumbers(MultiprecisionNumbers):
    """The arithmetic of binary numbers that rounds at random."""

    seed: int
    rule: int
    _taken: list[int] = field(default_factory=lambda: [0], compare=False, repr=False)

    @property
    def name(self) -> str:
        return _name(f"{self.bits}b", self.seed, self.rule)

    def fresh(self) -> StochasticBinaryNumbers:
        return self.seeded(self.seed)

    def seeded(self, seed: int) -> StochasticBinaryNumbers:
        """Return the same arithmetic with another seed."""
        return replace(self, seed=seed, _taken=[0])

    @cached_property
    def _key(self) -> int:
        return key_of(self.seed)

    @cached_property
    def _finer(self) -> MultiprecisionNumbers:
        # With twice the bits an exact root has no further digits, and any other root has some.  64 more bits make the
        # rounding of this longer result negligible.
        return MultiprecisionNumbers(2 * self.bits + 64)

    def _draw(self) -> int:
        self._taken[0] += 1
        return draw(self._key, self._taken[0])

    def _rounded(self, value: Any, drawn: int) -> Any:
        """Round an mpmath number, given as its internal tuple, with the random number ``drawn``."""
        sign, mantissa, exponent, bits = value
        excess = bits - self.bits
        if excess > 0:
            whole = randomly(int(mantissa), 1 << excess, 0, self.rule, drawn)
            value = from_man_exp(-whole if sign else whole, exponent + excess)
        return self._context.make_mpf(value)

    def add(self, first: Any, second: Any) -> Any:
        total = self._rounded(mpf_add(first._mpf_, second._mpf_), self._draw())
        return self._in_range(total, accumulator.SUM_OVER, accumulator.SUM_UNDER)

    def subtract(self, first: Any, second: Any) -> Any:
        total = self._rounded(mpf_sub(first._mpf_, second._mpf_), self._draw())
        return self._in_range(total, accumulator.SUM_OVER, accumulator.SUM_UNDER)

    def multiply(self, first: Any, second: Any) -> Any:
        product = self._rounded(mpf_mul(first._mpf_, second._mpf_), self._draw())
        return self._in_range(product, accumulator.PRODUCT_OVER, accumulator.PRODUCT_UNDER)

    def divide(self, dividend: Any, divisor: Any) -> Any:
        number = self._draw()
        (sign, size, exponent, bits), (by_sign, by, by_exponent, by_bits) = dividend._mpf_, divisor._mpf_
        if not size or not by:
            return super().divide(dividend, divisor)
        # Scale the dividend so that the integer quotient has exactly the bits of a mantissa.
        shift = self.bits + by_bits - bits
        if _shifted(size, shift) // _shifted(by, -shift) >> self.bits:
            shift -= 1
        whole = randomly(_shifted(size, shift), _shifted(by, -shift), 0, self.rule, number)
        value = from_man_exp(-whole if sign != by_sign else whole, exponent - by_exponent - shift)
        quotient = self._context.make_mpf(value)
        return self._in_range(quotient, accumulator.QUOTIENT_OVER, accumulator.QUOTIENT_UNDER)

    def function(self, name: str, value: Any) -> tuple[Any, str]:
        return self._once(*self._finer.function(name, self._long(value)))

    def power(self, base: Any, exponent: Any) -> tuple[Any, str]:
        return self._once(*self._finer.power(self._long(base), self._long(exponent)))

    def integer_power(self, base: Any, count: int) -> tuple[Any, str]:
        return self._once(*self._finer.integer_power(self._long(base), count))

    def _long(self, value: Any) -> Any:
        return self._finer._context.make_mpf(value._mpf_)

    def _once(self, value: Any, code: str) -> tuple[Any, str]:
        return self._rounded(value._mpf_, self._draw()), code


def _shifted(size: int, shift: int) -> int:
    return int(size) << max(shift, 0)


def _name(width: str, seed: int, rule: int) -> str:
    return f"{NAME}:{width}:{seed}{':proportional' if rule == PROPORTIONAL else ''}"


def _profile(digits: int, seed: int, rule: int) -> Profile:
    guard = _GUARD if rule == PROPORTIONAL else _FEW
    rules = rules_of(digits, guard=guard, sticky=1)._replace(random=rule, key=key_of(seed))
    return Profile(_name(str(digits), seed, rule), rules)


def stochastic(name: str) -> StochasticNumbers | StochasticBinaryNumbers | SampledNumbers | None:
    """Return the arithmetic called ``stochastic:8:1``, ``stochastic:53b:1:proportional``, ``stochastic:8:1-10`` or
    similar.

    Return None if the name does not begin with ``stochastic``.  Raise ArgumentError for an incomplete or invalid name.
    """
    if name.partition(":")[0] != NAME:
        return None
    match = _FORM.fullmatch(name)
    if not match or (match["majority"] and not match["last"]):
        raise ArgumentError(
            f"{name[:40]}: expected {NAME}:P:SEED for P decimal digits, or {NAME}:BITSb:SEED for BITS bits; SEED is an "
            "integer, or a range such as 1-10 for ten runs that all take the same branches; only :proportional may "
            "follow, and after a range also :majority, as in stochastic:8:1-10:proportional:majority"
        )
    size, seed, last = int(match["size"]), int(match["seed"]), int(match["last"] or match["seed"])
    least, most, what = (MIN_BITS, MAX_BITS, "bits") if match["binary"] else (MIN_DIGITS, MAX_DIGITS, "digits")
    if not least <= size <= most:
        raise ArgumentError(f"{name[:40]}: the number of {what} must be {least} to {most}")
    if max(seed, last) > MAX_SEED:
        raise ArgumentError(f"{name[:40]}: the seed must be 0 to {MAX_SEED}")
    if match["last"] and not 1 <= last - seed < MAX_RUNS:
        raise ArgumentError(f"{name[:40]}: expected a range of 2 to {MAX_RUNS} seeds, such as 1-10")
    rule = PROPORTIONAL if match["proportional"] else CESTAC

    def member(number: int, rule: int = rule) -> StochasticNumbers | StochasticBinaryNumbers:
        if match["binary"]:
            return StochasticBinaryNumbers(size, number, rule)
        return StochasticNumbers(_profile(size, number, rule))

    if not match["last"]:
        return member(seed)
    members = [member(number) for number in range(seed, last + 1)]
    # CADNA's three runs.
    if len(members) == 3 and rule == CESTAC:
        members[2] = member(seed + 1, OPPOSITE)
    return SampledNumbers(name, members, MAJORITY if match["majority"] else "mean")
