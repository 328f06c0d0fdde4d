"""Evidence: the grade of each constructor, the shrinking of counterexamples, and the decorator of checks."""

from __future__ import annotations

from random import Random

import pytest

from modern.claims import evidence
from modern.claims.evidence import Check, Generator, claim, exhausted, exhibited, proved, refuted, search, searched

PAIRS: Generator[tuple[int, ...]] = Generator("pairs", 7, lambda r: (r.randint(-50, 50), r.randint(0, 9)))


def test_grade_and_number_of_cases_follow_from_the_constructor() -> None:
    checks = [proved("p", [1, 1], ""), exhausted("d", [1] * 3, ""), searched(PAIRS, 5, [1], ""), exhibited(1, "")]
    grades = [(check.evidence.grade, check.evidence.cases) for check in checks]
    assert grades == [("proved", 2), ("exhausted", 3), ("searched", 5), ("exhibited", 1)]
    assert all(check.holds for check in checks)
    assert checks[2].evidence.describe() == "searched: pairs, 5 cases, seed 7"


def test_outcomes_conditions_and_slips_decide_a_check() -> None:
    for check in (proved("p", [], ""), exhausted("d", [1, 0], ""), searched(PAIRS, 5, [], "")):
        assert not check.holds
    assert exhibited(1, "").unless(True, "a case").evidence.violation == "a case"
    assert exhibited(1, "").unless(False, "a case").evidence.violation == ""
    assert evidence.slip(False, True, "z", "").evidence.correction == "z"
    assert evidence.slip(False, False, "z", "").evidence.correction == ""
    assert not refuted(True, "").holds


def test_counterexamples_are_shrunk() -> None:
    check = search(PAIRS, lambda pair: pair[0] < 17, 1000, "smaller than 17")
    assert (check.holds, check.message) == (False, "refuted by (17,)")
    assert search(PAIRS, lambda pair: pair[0] <= 50, 1000, "at most 50").holds
    assert evidence.shrink(((5, 5), (3, -8), (0, 1)), lambda points: points[1][1] < 0) == ((), (0, -1))


def test_generators_repeat_their_cases_and_full_searches_need_a_parameter() -> None:
    even = Generator("even numbers", 3, lambda random: random.randint(0, 99), lambda number: number % 2 == 0)
    assert [*even.cases(4)] == [*even.cases(9)][:4]
    assert all(number % 2 == 0 for number in even.cases(20))
    random = Random(3)
    first = next(number for number in iter(lambda: random.randint(0, 99), None) if number % 2 == 0)
    assert next(even.cases(1)) == first

    def check() -> Check:
        return exhibited(True, "")

    with pytest.raises(TypeError, match="a check with a full search needs the parameter 'cases'"):
        claim("x.1", full=9)(check)
