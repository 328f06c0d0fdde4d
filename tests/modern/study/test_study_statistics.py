"""Intervals against published values and against scipy's."""

from __future__ import annotations

import math
import statistics as plain

import pytest
from hypothesis import given
from hypothesis import strategies as st

from modern.study.statistics import Interval, exact, incomplete_beta, mean, mean_of, student, wilson


def test_published_intervals() -> None:
    """R. G. Newcombe, Two-sided confidence intervals for the single proportion,
    Statist. Med. 17 (1998) 857-872, Table I.

    Method 3 is Wilson's without correction, method 5 Clopper and Pearson's, both of 95 %.
    """
    for hits, of, by_wilson, by_exact in (
        (81, 263, (0.2553, 0.3662), (0.2527, 0.3676)),
        (15, 148, (0.0624, 0.1605), (0.0578, 0.1617)),
        (0, 20, (0.0000, 0.1611), (0.0000, 0.1684)),
        (1, 29, (0.0061, 0.1718), (0.0009, 0.1776)),
    ):
        for interval, (low, high) in ((wilson(hits, of), by_wilson), (exact(hits, of), by_exact)):
            assert (round(interval.low, 4), round(interval.high, 4)) == (low, high)
            assert interval.value == hits / of


def test_published_values_of_students_t() -> None:
    """NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.2, upper critical values of Student's t."""
    for degrees, level, value in ((1, 0.95, 12.706), (5, 0.95, 2.571), (10, 0.90, 1.812), (100, 0.99, 2.626)):
        assert round(student(degrees, level), 3) == value


@given(st.integers(1, 500), st.data(), st.sampled_from([0.8, 0.95, 0.99]))
def test_intervals_are_scipys(of: int, data: st.DataObject, level: float) -> None:
    stats = pytest.importorskip("scipy.stats")
    hits = data.draw(st.integers(0, of))
    test = stats.binomtest(hits, of)
    for own, method in ((wilson, "wilson"), (exact, "exact")):
        found, other = own(hits, of, level), test.proportion_ci(level, method)
        assert math.isclose(found.low, other.low, abs_tol=1e-8)
        assert math.isclose(found.high, other.high, abs_tol=1e-8)
        assert found.low <= found.value <= found.high


@given(st.floats(0.5, 400), st.floats(0.5, 400), st.floats(0, 1))
def test_the_incomplete_beta_function_is_scipys(a: float, b: float, x: float) -> None:
    special = pytest.importorskip("scipy.special")
    assert math.isclose(incomplete_beta(a, b, x), special.betainc(a, b, x), rel_tol=1e-8, abs_tol=1e-12)


@given(st.lists(st.floats(-1e6, 1e6), min_size=2, max_size=50))
def test_means(values: list[float]) -> None:
    found = mean(iter(values))
    assert math.isclose(found.value, plain.fmean(values), rel_tol=1e-9, abs_tol=1e-6)
    half = student(len(values) - 1) * plain.stdev(values) / math.sqrt(len(values))
    assert math.isclose(found.high - found.low, 2 * half, rel_tol=1e-6, abs_tol=1e-6)


def test_what_is_no_sample() -> None:
    for hits, of in ((1, 0), (-1, 5), (6, 5)):
        for method in (wilson, exact):
            with pytest.raises(ValueError, match="is not a proportion"):
                method(hits, of)
    with pytest.raises(ValueError, match="needs a value"):
        mean([])
    assert mean([3.0]) == mean_of(1, 3.0, 0.0) == Interval(3.0, -math.inf, math.inf)
