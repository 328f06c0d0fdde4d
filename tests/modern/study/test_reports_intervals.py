"""The conclusions of reports agree with the intervals of their figures, for invented rows with limits computed by hand.

All intervals are Clopper and Pearson's.  That of 0 in n ends at 1 - .025**(1/n), that of n in n begins at .025**(1/n).
"""

from collections.abc import Callable, Sequence
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from emulator.language.cards import deck_from_lines
from emulator.language.compiler import compile_deck
from emulator.machine.machine import Machine
from emulator.machine.result import Options
from modern.study import Cell, Plan
from modern.study.builtin import divergence, seventy
from modern.study.families import draw_sample
from modern.study.index import enter
from modern.study.measures import divergence as measured
from modern.study.outcomes import Figures
from modern.study.report import Report
from modern.study.sample import judge
from modern.study.store import Store
from modern.thesis.job import HullRun, Step

JUDGE = {"n": 10, "dimension": 3, "vertices": 8, "planes": 12, "boundary": 0, "inside": 2}
RIGHT, WRONG = "right", "wrong hull"
Answer = tuple[str, dict[str, Any]]
"""Outcome and figures."""


def reported(
    folder: Path, plan: Plan, module: Any, answer: Callable[[int, int, str], Answer], kind: Callable[[int], str]
) -> Report:
    """Return the report on invented rows; ``answer`` has the arguments cell, sample and route, ``kind`` the sample."""
    with closing(Store.open(folder, plan)) as store:
        for number, cell in enumerate(plan.cells):
            rows = [
                {
                    "cell": number,
                    "index": index,
                    "tags": {"kind": kind(index)},
                    "judge": JUDGE,
                    "runs": {route.name: _run(*answer(number, index, route.name)) for route in cell.routes},
                }
                for index in range(cell.samples)
            ]
            enter(store.database, rows)
        report: Report = module.report(plan, store)
        return report


def _run(outcome: str, figures: dict[str, Any]) -> dict[str, Any]:
    return {"outcome": outcome, "detail": "somewhere", "figures": figures}


# The study seventy.


def seventies(folder: Path, failures: Sequence[int], slabs: int = 0, mended: int = 0) -> str:
    """Return the conclusions for groups with these failures, ``mended`` with the card; the first sets are slabs."""
    plan = seventy.plan(70 * len(failures), 1)

    def answer(cell: int, index: int, route: str) -> Answer:
        failing = failures[index // 70] if route == seventy.LISTED else mended
        return (WRONG if index % 70 < failing else RIGHT), {"statements": 1}

    return " ".join(
        reported(folder, plan, seventy, answer, lambda index: "slab" if index < slabs else "one point").conclusions
    )


@pytest.mark.parametrize(
    ("failures", "claim"),
    [
        ([1] * 10, "fewer than the two of the thesis"),
        ([1] * 9 + [2], "fewer than the two of the thesis"),
        ([1] * 8 + [2] * 2, "not significantly different from the two of the thesis"),
        ([2, 0, 0, 0], "fewer than the two of the thesis"),
        ([2, 1, 0, 0], "not significantly different from the two of the thesis"),
        ([2] * 10, "not significantly different from the two of the thesis"),
        ([3] * 9 + [2], "not significantly different from the two of the thesis"),
        ([3] * 10, "more than the two of the thesis"),
        ([3, 3, 4, 4], "not significantly different from the two of the thesis"),
        ([3, 4, 4, 4], "more than the two of the thesis"),
    ],
)
def test_seventy_differs_from_the_thesis_only_if_the_whole_interval_does(tmp_path, failures, claim) -> None:
    """The limits for 10, 11, 12, 20, 29 and 30 in 700 and for 2, 3, 14 and 15 in 280 are from scipy (beta.ppf)."""
    assert claim in seventies(tmp_path, failures)


UNUSUAL, USUAL = "Two failures in seventy are unusual", "Two failures in seventy are not unusual"
UNDECIDED = "possibly unusual; there are too few groups to decide"


@pytest.mark.parametrize(
    ("failures", "claim"),
    [
        ([0] * 73, UNUSUAL),
        ([0] * 72, UNUSUAL),
        ([1] * 73, UNUSUAL),
        ([0] * 71, UNDECIDED),
        ([2, 0, 0, 0], UNDECIDED),
        ([2, 2, 0, 0], USUAL),
        ([3, 3, 0, 0], USUAL),
        ([2, 2, 0, 0, 0], USUAL),
        ([2, 2, 0, 0, 0, 0], UNDECIDED),
    ],
)
def test_seventy_calls_two_unusual_only_if_the_whole_interval_is_below_a_twentieth(tmp_path, failures, claim) -> None:
    """The limit is a twentieth of the groups; the interval of 1 in 4 is .0063 to .806."""
    conclusions = seventies(tmp_path, failures)
    assert [text in conclusions for text in (UNUSUAL, USUAL, UNDECIDED)] == [
        claim == t for t in (UNUSUAL, USUAL, UNDECIDED)
    ]


@pytest.mark.parametrize(
    ("failures", "slabs", "claim"),
    [
        ([5, 0, 0, 0], 20, "seventy such sets have 17.5 (6.1 to 34.4) failures on average."),
        ([0, 0], 131, "seventy such sets have 0.0 (0.0 to 1.9) failures on average."),
        ([1, 0], 70, "seventy such sets have 1.0 (0.0 to 5.4) failures on average."),
        ([2, 0], 70, "seventy such sets have 2.0 (0.2 to 7.0) failures on average."),
    ],
)
def test_seventy_reports_the_interval_of_sets_in_space(tmp_path, failures, slabs, claim) -> None:
    """The interval of 0 in 131 ends at 1 - .025**(1/131), 1.944 in seventy.

    5 in 20 is .087 to .491, 1 in 70 .00036 to .077, 2 in 70 .0035 to .099.
    """
    assert claim in seventies(tmp_path, failures, slabs)


def test_seventy_reports_means_and_sets_in_space(tmp_path: Path) -> None:
    # 3, 4, 3 and 4 failures as listed and one with the card: 3.5 - 1.
    assert "2.50 fewer than with the programs as listed." in seventies(tmp_path, [3, 4, 3, 4], mended=1)
    (tmp_path / "slabs").mkdir()
    # Both slabs fail as listed and none with the card; .158 is the square root of .025.
    assert "Of the sets of points in space, 100.0 (15.8 to 100.0) % fail with" in seventies(
        tmp_path / "slabs", [2, 2], slabs=2
    )


# The study divergence.

TWENTY = {
    "program3 116": [RIGHT, RIGHT, WRONG, WRONG, WRONG],
    "program2 169": [RIGHT],
    "program1 127": [WRONG],
    divergence.NOWHERE: [RIGHT] * 10 + [WRONG] * 3,
}
"""The outcomes of the sets by the first statement that decides differently, ten in each of two families."""


@pytest.fixture
def twenty(tmp_path: Path) -> Report:
    """The report on these sets; exact arithmetic could not follow two of the runs without a difference."""
    plan = divergence.plan(10, 1)
    plan = replace(plan, cells=plan.cells[:2])
    ends = [
        ("" if place == divergence.NOWHERE else place, end) for place, outcomes in TWENTY.items() for end in outcomes
    ]

    def answer(cell: int, index: int, route: str) -> Answer:
        place, outcome = ends[10 * cell + index]
        undecided = {"undecided": "exact ended"} if 10 * cell + index >= 18 else {}
        return outcome, {"diverges": place, **undecided}

    return reported(tmp_path, plan, divergence, answer, lambda _: "")


def test_divergence_sorts_statements_by_frequency_and_gives_their_shares(twenty: Report) -> None:
    """Equally frequent statements are sorted by name; nowhere is last."""
    assert [row[:4] for row in twenty.tables[0].rows] == [
        ("program3 116", "5", "25.0 (8.7 to 49.1) %", "2"),
        ("program1 127", "1", "5.0 (0.1 to 24.9) %", "0"),
        ("program2 169", "1", "5.0 (0.1 to 24.9) %", "1"),
        (divergence.NOWHERE, "13", "65.0 (40.8 to 84.6) %", "10"),
    ]
    assert twenty.tables[0].rows[0][4] == "40.0 (5.3 to 85.3) %"


def test_divergence_separates_faults_and_counts_undecided_runs(twenty: Report) -> None:
    # 3 of 7 sets with a difference are right (.099 to .816); 3 of 13 without one fail (.050 to .538).
    assert (
        "Of the sets with a different decision, 3 of 7, 42.9 (9.9 to 81.6) %, still give the right hull."
        in twenty.conclusions[1]
    )
    assert "3 of 13, 23.1 (5.0 to 53.8) %, fail because of faults of the programs." in twenty.conclusions[1]
    assert "In 2 runs, exact arithmetic had to stop before any decision differed." in twenty.conclusions[2]


def diverging(*lines: str, card: str) -> Figures:
    """Return the measure ``divergence`` of a program with these lines, run on one card."""
    program = compile_deck(deck_from_lines("p", [*lines, "8 A=0.", "9 STOP", "6 FORMAT(F14.8)", "END"]))
    deck = deck_from_lines("d", [card])
    result = Machine(program, deck, Options()).run()
    judged = judge(draw_sample(Cell({}, "integers", {"digits": 1, "n": 4}, (), 1), 1, 0), "d")
    return measured(judged, HullRun((Step("program1", 1, program, deck, result),)))


@pytest.mark.parametrize(
    ("lines", "card", "place"),
    [
        (["READ 6,A", "7 B=A/3.", "IF(B*3.-A)8,9,8"], "1.", "program1 7+1"),
        (["READ 6,A", "7 B=A/3.", "IF(B*3.-A)8,9,8"], "9.", ""),
        (["READ 6,A", "7 IF(A-1.)8,9,8"], "1.0000001", ""),
        (["READ 6,A", "7 IF(A-1.)8,9,8"], "1.00000001", "program1 7"),
    ],
    ids=["thirds", "whole thirds", "eight digits", "nine digits"],
)
def test_measure_finds_the_first_decision_that_differs_from_exact_arithmetic(lines, card, place) -> None:
    """A truncated third times 3 is less than 1.  The eighth digit of a card is read, the ninth is not."""
    assert diverging(*lines, card=card) == {"diverges": place}


def test_measure_reports_a_function_without_exact_values() -> None:
    """Exact arithmetic has no sine of 1."""
    figures = diverging("READ 6,A", "7 IF(SIN(A))8,9,8", card="1.")
    assert figures["diverges"] == ""
    assert "SIN of 1" in str(figures["undecided"])
