"""Estimates of the significant digits of a number from its values in several stochastic runs.

Let m be the mean of N values, s their standard deviation (with the divisor N - 1) and r = s / abs(m).

- *Stott Parker*: the number of digits that the values of the runs have in common, ``-log10(r)`` (D. S. Parker, Monte
  Carlo arithmetic, UCLA CSD-970002, 1997).
- *CESTAC*: the number of significant digits of the mean, ``log10(sqrt(N) / (r t))``, where t is Student's value for
  95 % and N - 1 degrees of freedom (J. Vignes, Math. Comput. Simulation 35 (1993) 233-261).  If the estimate for a
  number is less than 0.5, the number is a *computational zero*: no digit of it is significant.  CADNA rounds the
  estimate to an integer and prints such a number as ``@.0``.  Vignes himself calls a number a computational zero if its
  estimate is at most 0.
- *Sohier*: a lower bound, with confidence 95 %, on the number of digits of one run that are right with probability
  95 %.  The errors are assumed to be normally distributed.  The bound is
  ``-log10(r) - log10((N - 1) / c) / 2 - log10(z)``, where c is the 2.5 % quantile of the chi-square distribution and z
  the 97.5 % quantile of the normal one (D. Sohier et al., Confidence intervals for stochastic arithmetic, ACM Trans.
  Math. Softw. 47 (2021) 10, section 4).  The package ``significantdigits`` computes s with N instead of N - 1, so its
  result is larger by ``log10(N / (N - 1)) / 2``.

Every estimate is at least 0 and at most the number of digits of the arithmetic.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from statistics import NormalDist

_LEVEL = 0.95


@dataclass(frozen=True, slots=True)
class Estimate:
    """The mean of a number's values in several random runs, and three estimates of its significant digits.

    ``is_zero`` is True if the number is a computational zero, ``is_exact`` if all of its values are equal.
    """

    mean: Fraction
    parker: float
    cestac: float
    sohier: float
    is_zero: bool
    is_exact: bool


def estimate(values: Sequence[Fraction | int | None], digits: float) -> Estimate | None:
    """Estimate the significant digits of a number from its values.  Return None if a value is not finite."""
    finite = [value for value in values if value is not None]
    count = len(finite)
    if count < len(values) or count < 2:
        return None
    mean = Fraction(sum(finite), count)
    if all(value == finite[0] for value in finite):
        return Estimate(mean, digits, digits, digits, not mean, True)
    if not mean:
        return Estimate(mean, 0.0, 0.0, 0.0, True, False)
    ratio = math.sqrt(sum(_float((value - mean) / mean) ** 2 for value in finite) / (count - 1))
    parker = -math.log10(ratio) if ratio else math.inf
    cestac = parker + math.log10(math.sqrt(count) / student(count - 1))
    width = math.log10((count - 1) / chi_square(count - 1)) / 2
    sohier = parker - width - math.log10(NormalDist().inv_cdf((1 + _LEVEL) / 2))
    first, second, third = (min(max(estimated, 0.0), digits) for estimated in (parker, cestac, sohier))
    return Estimate(mean, first, second, third, cestac < 0.5, False)


def _float(value: Fraction) -> float:
    """Return a deviation relative to the mean as a float, limited to 1E100 to prevent an overflow."""
    return float(value) if abs(value) < 10**100 else 1e100


@cache
def student(degrees: int) -> float:
    """Return t such that a variable with Student's distribution is between -t and t with probability 95 %."""
    from mpmath import betainc

    return _root(lambda t: 1 - betainc(degrees / 2, 0.5, 0, degrees / (degrees + t * t), regularized=True), _LEVEL)


@cache
def chi_square(degrees: int) -> float:
    """Return the 2.5 % quantile of the chi-square distribution with ``degrees`` degrees of freedom."""
    from mpmath import gammainc

    return _root(lambda x: gammainc(degrees / 2, 0, x / 2, regularized=True), (1 - _LEVEL) / 2)


def _root(increasing: Callable[[float], float], level: float) -> float:
    """Return the argument at which an increasing function reaches a level, by bisection."""
    low, high = 0.0, 1.0
    while increasing(high) < level:
        low, high = high, 2 * high
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if increasing(middle) < level else (low, middle)
    return high
