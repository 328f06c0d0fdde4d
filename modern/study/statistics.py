"""Compute confidence intervals: exact intervals for proportions and counts, and Student's intervals for other means.

A proportion, or a count out of a known total, gets the exact interval of Clopper and Pearson.  Its coverage is at least
the level (.95 by default) for every true proportion, and the interval never extends below 0 or above the total.  This
coverage also holds if samples of several kinds, each with a different proportion, are counted together, because the
count then varies less (Hoeffding).

Student's interval assumes that means are normally distributed.  This interval is used for quantities that are not
counts, such as minutes.  The interval is truncated at limits of the quantity (no time is below 0), which does not lower
its coverage.  Both tails of each interval are equally probable.

References
----------
C. J. Clopper and E. S. Pearson, The use of confidence or fiducial limits illustrated in the case of the binomial,
Biometrika 26 (1934) 404-413.  W. Hoeffding, On the distribution of the number of successes in independent trials, Ann.
Math. Statist. 27 (1956) 713-721.  Student (W. S. Gosset), The probable error of a mean, Biometrika 6 (1908) 1-25.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from math import exp, inf, lgamma, log, log1p, sqrt

LEVEL = 0.95


@dataclass(frozen=True, slots=True)
class Interval:
    """An estimate with the limits of its confidence interval."""

    value: float
    low: float
    high: float


def exact(hits: int, of: int, level: float = LEVEL) -> Interval:
    """Return the exact (Clopper and Pearson) interval of a proportion of ``hits`` in ``of`` samples."""
    if of < 1 or not 0 <= hits <= of:
        raise ValueError(f"expected hits from 0 to the number of samples, found {hits} of {of}")
    tail = (1 - level) / 2
    low = 0.0 if hits == 0 else _root(lambda p: incomplete_beta(hits, of - hits + 1, p) - tail)
    high = 1.0 if hits == of else _root(lambda p: incomplete_beta(hits + 1, of - hits, p) - (1 - tail))
    return Interval(hits / of, low, high)


def count(hits: int, of: int, times: int) -> Interval:
    """Return the expected number of hits in ``times`` samples, with its interval, after ``hits`` in ``of`` samples."""
    share = exact(hits, of)
    return Interval(times * share.value, times * share.low, times * share.high)


def mean(values: Iterable[float], least: float = -inf, most: float = inf) -> Interval:
    """Return the mean of a sample with Student's interval, truncated at the bounds ``least`` and ``most``.

    ``values`` may be an iterator, because the values are read only once (B. P. Welford, Technometrics 4 (1962)
    419-420).  A single value has an infinite interval.
    """
    number, average, squares = 0, 0.0, 0.0
    for value in values:
        number += 1
        step = value - average
        average += step / number
        # The deviations before and after the update; their product avoids the cancellation of sum(x*x) - n*mean*mean.
        squares += step * (value - average)
    return mean_of(number, average, squares, least, most)


def mean_of(number: int, average: float, squares: float, least: float = -inf, most: float = inf) -> Interval:
    """Return Student's interval from the number of values, their mean and the sum of squared deviations from it."""
    if number < 1:
        raise ValueError("a mean needs at least one value")
    if number == 1:
        return Interval(average, -inf, inf)
    half = student(number - 1) * sqrt(squares / (number - 1) / number)
    return Interval(average, max(least, average - half), min(most, average + half))


def student(degrees: int, level: float = LEVEL) -> float:
    """Return t such that a variable with Student's distribution is between -t and t with probability ``level``."""
    # The probability that |T| > t is the incomplete beta function I_x(n/2, 1/2) at x = n/(n + t*t).
    x = _root(lambda p: incomplete_beta(degrees / 2, 0.5, p) - (1 - level))
    return sqrt(degrees * (1 - x) / x)


def incomplete_beta(a: float, b: float, x: float) -> float:
    """Return the regularised incomplete beta function I_x(a, b).

    Notes
    -----
    The continued fraction of the NIST Digital Library of Mathematical Functions, 8.17.22, is evaluated by Lentz's
    method in the form of Thompson and Barnett.  mpmath's ``betainc`` needs seconds for the samples of a large study
    (a and b of some thousands), and scipy is not a requirement of hull1620.
    """
    if x <= 0 or x >= 1:
        return 0.0 if x <= 0 else 1.0
    # The fraction converges quickly below the mean a/(a + b); above it, I_x(a, b) = 1 - I_(1-x)(b, a) (8.17.4).
    if x > (a + 1) / (a + b + 2):
        return 1 - incomplete_beta(b, a, 1 - x)
    front = exp(lgamma(a + b) - lgamma(a) - lgamma(b) + a * log(x) + b * log1p(-x)) / a
    tiny = 1e-300
    fraction, c, d = 1.0, 1.0, 0.0
    for k in range(10_000):
        # Term k of the fraction: d_(2m+1) of 8.17.23 for odd k, d_(2m) for even k.
        m = k // 2
        if k == 0:
            term = 1.0
        elif k % 2:
            term = -(a + m) * (a + b + m) * x / ((a + k - 1) * (a + k))
        else:
            term = m * (b - m) * x / ((a + k - 1) * (a + k))
        # Lentz: c and d are ratios of successive numerators and denominators.  A zero is replaced by a tiny number.
        d = 1 + term * d
        d = 1 / (d if abs(d) > tiny else tiny)
        c = 1 + term / (c if abs(c) > tiny else tiny)
        fraction *= c * d
        if k and abs(c * d - 1) < 1e-15:
            break
    return front * (fraction - 1)


def _root(monotonic: Callable[[float], float]) -> float:
    falling = monotonic(1e-300) > monotonic(1.0)
    low, high = 0.0, 1.0
    for _ in range(200):
        middle = (low + high) / 2
        if (monotonic(middle) > 0) != falling:
            high = middle
        else:
            low = middle
    return (low + high) / 2
