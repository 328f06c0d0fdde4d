"""What studies claim follows the intervals of their figures: rows made up, limits worked out by hand.

All intervals are Clopper and Pearson's; of none in n it ends at 1 - .025**(1/n), of n in n it begins at .025**(1/n).
"""

from __future__ import annotations

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
    """The report on rows made up: ``answer`` of cell, sample and route, ``kind`` of sample."""
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
            enter(store.database, cell.name, rows)
        report: Report = module.report(plan, store)
        return report


def _run(outcome: str, figures: dict[str, Any]) -> dict[str, Any]:
    return {"outcome": outcome, "detail": "somewhere", "figures": figures}


# The study seventy.


def seventies(folder: Path, failures: Sequence[int], slabs: int = 0, mended: int = 0) -> str:
    """The words where the seventies have so many failures; all with the card ``mended``; the first sets are slabs."""
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
        ([1] * 10, "fewer than the thesis's two"),
        ([1] * 9 + [2], "fewer than the thesis's two"),
        ([1] * 8 + [2] * 2, "not to be told from the thesis's two"),
        ([2, 0, 0, 0], "fewer than the thesis's two"),
        ([2, 1, 0, 0], "not to be told from the thesis's two"),
        ([2] * 10, "not to be told from the thesis's two"),
        ([3] * 9 + [2], "not to be told from the thesis's two"),
        ([3] * 10, "more than the thesis's two"),
        ([3, 3, 4, 4], "not to be told from the thesis's two"),
        ([3, 4, 4, 4], "more than the thesis's two"),
    ],
    ids=[
        "to 1.83",
        "to 1.956",
        "to 2.08",
        "to 1.79",
        "to 2.17",
        "2",
        "from 1.954",
        "from 2.04",
        "from 1.93",
        "from 2.12",
    ],
)
def test_seventy_compares_with_two_where_the_whole_interval_is_on_one_side(
    tmp_path: Path, failures: list[int], claim: str
) -> None:
    """Seventy times the limits of 10, 11, 12, 20, 29 and 30 of 700 and of 2, 3, 14 and 15 of 280 (scipy's beta.ppf)."""
    assert claim in seventies(tmp_path, failures)


UNUSUAL, USUAL = "Two failures in seventy are unusual", "Two failures in seventy are nothing unusual"
UNTOLD = "not to be judged from so few seventies"


@pytest.mark.parametrize(
    ("failures", "claim"),
    [
        ([0] * 73, UNUSUAL),
        ([0] * 72, UNUSUAL),
        ([1] * 73, UNUSUAL),
        ([0] * 71, UNTOLD),
        ([2, 0, 0, 0], UNTOLD),
        ([2, 2, 0, 0], USUAL),
        ([3, 3, 0, 0], USUAL),
        ([2, 2, 0, 0, 0], USUAL),
        ([2, 2, 0, 0, 0, 0], UNTOLD),
    ],
    ids=[
        "to .0493",
        "to .04994",
        "one failure each",
        "to .0506",
        "from .006",
        "from .068",
        "three",
        "from .053",
        "from .043",
    ],
)
def test_seventy_calls_two_unusual_where_the_whole_interval_is_below_a_twentieth(
    tmp_path: Path, failures: list[int], claim: str
) -> None:
    """Two or more in a twentieth of the seventies is the limit; 1 of 4 is from .0063 to .806."""
    words = seventies(tmp_path, failures)
    assert [text in words for text in (UNUSUAL, USUAL, UNTOLD)] == [claim == t for t in (UNUSUAL, USUAL, UNTOLD)]


@pytest.mark.parametrize(
    ("failures", "slabs", "claim"),
    [
        ([5, 0, 0, 0], 20, "of seventy such sets: 17.5 (6.1 to 34.4)."),
        ([0, 0], 131, "of seventy such sets: 0.0 (0.0 to 1.9)."),
        ([1, 0], 70, "of seventy such sets: 1.0 (0.0 to 5.4)."),
        ([2, 0], 70, "of seventy such sets: 2.0 (0.2 to 7.0)."),
    ],
)
def test_seventy_says_of_sets_in_space_what_their_interval_allows(
    tmp_path: Path, failures: list[int], slabs: int, claim: str
) -> None:
    """None of 131 ends at 1 - .025**(1/131), 1.944 of seventy.

    5 of 20 is .087 to .491, 1 of 70 .00036 to .077, 2 of 70 .0035 to .099.
    """
    assert claim in seventies(tmp_path, failures, slabs)


def test_seventy_counts_what_the_card_saves_by_the_means(tmp_path: Path) -> None:
    """3, 4, 3 and 4 failures as listed and one with the card: 3.5 less 1."""
    assert "the difference: 2.50." in seventies(tmp_path, [3, 4, 3, 4], mended=1)


def test_seventy_takes_the_sets_in_space_as_listed(tmp_path: Path) -> None:
    """Both slabs fail as listed, none does with the card; .158 is the root of .025."""
    assert "Sets in space that fail as listed: 100.0 (15.8 to 100.0) %" in seventies(tmp_path, [2, 2], slabs=2)


# The study divergence.

TWENTY = {
    "program3 116": [RIGHT, RIGHT, WRONG, WRONG, WRONG],
    "program2 169": [RIGHT],
    "program1 127": [WRONG],
    divergence.NOWHERE: [RIGHT] * 10 + [WRONG] * 3,
}
"""How the sets ended that first decide otherwise at a statement, ten in each of two families."""


@pytest.fixture
def twenty(tmp_path: Path) -> Report:
    """The report on them; of two of the sets that follow exact numbers those could not be followed to the end."""
    plan = divergence.plan(10, 1)
    plan = replace(plan, cells=plan.cells[:2])
    ends = [("" if place == divergence.NOWHERE else place, end) for place, found in TWENTY.items() for end in found]

    def answer(cell: int, index: int, route: str) -> Answer:
        place, outcome = ends[10 * cell + index]
        undecided = {"undecided": "exact ended"} if 10 * cell + index >= 18 else {}
        return outcome, {"diverges": place, **undecided}

    return reported(tmp_path, plan, divergence, answer, lambda _: "")


def test_divergence_gives_shares_of_all_sets_and_of_those_of_a_statement(twenty: Report) -> None:
    """The most frequent first, of equals by name, nowhere last."""
    assert [row[:4] for row in twenty.tables[0].rows] == [
        ("program3 116", "5", "25.0 (8.7 to 49.1) %", "2"),
        ("program1 127", "1", "5.0 (0.1 to 24.9) %", "0"),
        ("program2 169", "1", "5.0 (0.1 to 24.9) %", "1"),
        (divergence.NOWHERE, "13", "65.0 (40.8 to 84.6) %", "10"),
    ]
    assert twenty.tables[0].rows[0][4] == "40.0 (5.3 to 85.3) %"


def test_divergence_counts_faults_of_the_digits_apart_from_the_programs_own(twenty: Report) -> None:
    """3 of 7 misled sets end right (.099 to .816); 3 of 13 fail unmisled (.050 to .538)."""
    assert "those that still end in the right hull: 3 of 7, 42.9 (9.9 to 81.6) %." in twenty.conclusions[1]
    assert "those that fail, by the programs' own faults: 3 of 13, 23.1 (5.0 to 53.8) %." in twenty.conclusions[1]


def test_divergence_counts_the_runs_exact_numbers_could_not_follow(twenty: Report) -> None:
    assert "could not follow to a decision that differs: 2." in twenty.conclusions[2]


def diverging(*lines: str, card: str) -> Figures:
    """The measure ``divergence`` of one program of these lines, run in its own arithmetic on one card."""
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
def test_the_measure_compares_eight_digits_with_exact_numbers(lines: list[str], card: str, place: str) -> None:
    """.33333333 * 3 is less than 1, however many digits a third is cut to; an eighth digit is read, a ninth is not."""
    assert diverging(*lines, card=card) == {"diverges": place}


def test_the_measure_says_where_exact_numbers_cannot_follow() -> None:
    """They have no sine of 1."""
    found = diverging("READ 6,A", "7 IF(SIN(A))8,9,8", card="1.")
    assert found["diverges"] == ""
    assert "SIN of 1" in str(found["undecided"])
