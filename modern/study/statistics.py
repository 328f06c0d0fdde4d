"""Intervals for what samples tell: exact ones of proportions and counts, Student's of the means of other quantities.

A proportion, and a count, which is a proportion of a known number, have Clopper and Pearson's interval: it has at least
the level whatever the truth is, and never passes 0 or the whole.  It keeps the level where samples of several kinds,
each with a proportion of its own, are counted together (Hoeffding: then the count varies less).  Student's
interval supposes that means vary normally; it is for quantities that are no counts, such as minutes, and is cut at
bounds that the quantity itself has (no time is below 0), by which nothing is lost of its level.  Wilson's formula is
here for comparison: it is shorter, and keeps the level only on the mean over proportions.

Sources: C. J. Clopper and E. S. Pearson, The use of confidence or fiducial limits illustrated in the case of the
binomial, Biometrika 26 (1934) 404-413; E. B. Wilson, Probable inference, the law of succession, and statistical
inference, J. Amer. Statist. Assoc. 22 (1927) 209-212; L. D. Brown, T. T. Cai, A. DasGupta, Interval estimation for a
binomial proportion, Statist. Sci. 16 (2001) 101-133, which compares them; W. Hoeffding, On the distribution of the
number of successes in independent trials, Ann. Math. Statist. 27 (1956) 713-721; Student (W. S. Gosset), The probable
error of a mean, Biometrika 6 (1908) 1-25.  All intervals have two equal tails; ``level`` is .95 unless said otherwise.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from math import exp, inf, lgamma, log, log1p, sqrt
from statistics import NormalDist

LEVEL = 0.95


@dataclass(frozen=True, slots=True)
class Interval:
    """An estimate with the limits of its interval."""

    value: float
    low: float
    high: float


def wilson(hits: int, of: int, level: float = LEVEL) -> Interval:
    """Wilson's score interval of a proportion.  Raises ValueError for hits beyond 0 to ``of``, or no samples."""
    _check(hits, of)
    z = NormalDist().inv_cdf((1 + level) / 2)
    share = hits / of
    centre = share + z * z / (2 * of)
    half = z * sqrt(share * (1 - share) / of + z * z / (4 * of * of))
    scale = 1 + z * z / of
    low = 0.0 if hits == 0 else (centre - half) / scale
    high = 1.0 if hits == of else (centre + half) / scale
    return Interval(share, low, high)


def exact(hits: int, of: int, level: float = LEVEL) -> Interval:
    """The exact interval of a proportion (Clopper and Pearson): it holds the level whatever the proportion is.

    Raises ValueError as :func:`wilson`.
    """
    _check(hits, of)
    tail = (1 - level) / 2
    low = 0.0 if hits == 0 else _root(lambda p: incomplete_beta(hits, of - hits + 1, p) - tail)
    high = 1.0 if hits == of else _root(lambda p: incomplete_beta(hits + 1, of - hits, p) - (1 - tail))
    return Interval(hits / of, low, high)


def count(hits: int, of: int, times: int, level: float = LEVEL) -> Interval:
    """How many of ``times`` samples are expected to be hits, where ``hits`` of ``of`` were: the proportion's exact
    interval times ``times``, so that it lies in 0 to ``times``.

    Raises ValueError as :func:`wilson`.
    """
    share = exact(hits, of, level)
    return Interval(times * share.value, times * share.low, times * share.high)


def mean(values: Iterable[float], level: float = LEVEL, least: float = -inf, most: float = inf) -> Interval:
    """The mean of a sample with Student's interval, in one pass (B. P. Welford, Technometrics 4 (1962) 419-420).

    ``least`` and ``most`` are the bounds that the quantity itself has; the interval is cut there.  Raises ValueError
    where there is no value; of one value alone the interval is without bounds.
    """
    number, average, squares = 0, 0.0, 0.0
    for value in values:
        number += 1
        step = value - average
        average += step / number
        squares += step * (value - average)
    return mean_of(number, average, squares, level, least, most)


def mean_of(
    number: int, average: float, squares: float, level: float = LEVEL, least: float = -inf, most: float = inf
) -> Interval:
    """Student's interval from the number of values, their mean, and the sum of squared deviations from it."""
    if number < 1:
        raise ValueError("a mean needs a value")
    if number == 1:
        return Interval(average, -inf, inf)
    half = student(number - 1, level) * sqrt(squares / (number - 1) / number)
    return Interval(average, max(least, average - half), min(most, average + half))


def student(degrees: int, level: float = LEVEL) -> float:
    """The t that a variable of Student's distribution stays within, either side, with the probability ``level``."""
    # P(|T| > t) is the incomplete beta function of n/2, 1/2 at n/(n + t*t).
    x = _root(lambda p: incomplete_beta(degrees / 2, 0.5, p) - (1 - level))
    return sqrt(degrees * (1 - x) / x)


def incomplete_beta(a: float, b: float, x: float) -> float:
    """The regularised incomplete beta function I_x(a, b), by its continued fraction.

    NIST Digital Library of Mathematical Functions 8.17.22, evaluated by Lentz's method in the form of Thompson and
    Barnett; where x is beyond the mean, by I_x(a, b) = 1 - I_(1-x)(b, a) (8.17.4).
    """
    if x <= 0 or x >= 1:
        return 0.0 if x <= 0 else 1.0
    if x > (a + 1) / (a + b + 2):
        return 1 - incomplete_beta(b, a, 1 - x)
    front = exp(lgamma(a + b) - lgamma(a) - lgamma(b) + a * log(x) + b * log1p(-x)) / a
    tiny = 1e-300
    fraction, c, d = 1.0, 1.0, 0.0
    for k in range(10_000):
        m = k // 2
        if k == 0:
            term = 1.0
        elif k % 2:
            term = -(a + m) * (a + b + m) * x / ((a + k - 1) * (a + k))
        else:
            term = m * (b - m) * x / ((a + k - 1) * (a + k))
        d = 1 + term * d
        d = 1 / (d if abs(d) > tiny else tiny)
        c = 1 + term / (c if abs(c) > tiny else tiny)
        fraction *= c * d
        if k and abs(c * d - 1) < 1e-15:
            break
    return front * (fraction - 1)


def _root(rising: Callable[[float], float]) -> float:
    """The zero of a rising function on 0 to 1, by halving."""
    falling = rising(1e-300) > rising(1.0)
    low, high = 0.0, 1.0
    for _ in range(200):
        middle = (low + high) / 2
        if (rising(middle) > 0) != falling:
            high = middle
        else:
            low = middle
    return (low + high) / 2


def _check(hits: int, of: int) -> None:
    if of < 1 or not 0 <= hits <= of:
        raise ValueError(f"{hits} of {of} is not a proportion")
