"""What Nakamae and Nishita publish, against what is computed."""

from __future__ import annotations

from fractions import Fraction

import pytest

from modern.claims.published import CANNOT, CORRECTED, PAPERS, findings, judge, produced_by, results_of, text_of
from modern.edition.apparatus import build
from modern.edition.reproduce import DIFFERENT, EXACT
from modern.papers.nakamae_nishita.hidden import draw
from modern.papers.nakamae_nishita.projection import parallel
from modern.papers.nakamae_nishita.shapes import column, moved, placed, plate, round_base

PAPER = next(paper for paper in PAPERS if paper.name == "nakamae-nishita")
KINDS = {
    **dict.fromkeys(("d-crossing", "d-on-segment", "d-on-vertex", "d-apart", "intersections"), EXACT),
    "sense": CORRECTED,
    **dict.fromkeys(("table1-a", "table1-b", "table1-c"), EXACT),
    **dict.fromkeys(("table1-d", "table1-times"), CANNOT),
}


def test_every_verdict() -> None:
    assert {finding.result.id: finding.kind for finding in findings(PAPER)} == KINDS


@pytest.mark.parametrize("row", [row.id for row in text_of(PAPER).rows])
def test_without_a_row_of_the_apparatus_a_result_differs(row: str) -> None:
    without = {line.id: line.text.split() for line in build(text_of(PAPER), without=(row,))}
    touched = next(found for found in text_of(PAPER).rows if found.id == row)
    printed = [without[change.line] for change in touched.changes]
    lines = [line.split() for result in produced_by(PAPER).values() for line in result]
    assert not any(line in lines for line in printed)


def test_another_number_would_be_found() -> None:
    lines = produced_by(PAPER)
    for result in results_of(PAPER):
        if KINDS[result.id] in (EXACT, CORRECTED):
            assert judge(PAPER, result, [lines[result.id][0] + "1"]).kind == DIFFERENT


def test_table_1_d_is_what_25_prisms_and_five_plates_have() -> None:
    """The reason given says so, and that thirty prisms with as many vertices have ten faces more."""
    up, along = (Fraction(0), Fraction(0), Fraction(1)), (Fraction(10), Fraction(0), Fraction(0))

    def counts(sides: list[int], plates: list[int]) -> tuple[int, int, int, int]:
        made = [column("column", round_base("column", n, Fraction(1)), up) for n in sides]
        made += [plate("plate", round_base("plate", n, Fraction(1))) for n in plates]
        apart = [placed(p, moved((k * along[0], along[1], along[2])), f"{k}") for k, p in enumerate(made)]
        return draw(apart, parallel((1, -2, 3))).counts

    (printed,) = (result.corrected[0].split() for result in results_of(PAPER) if result.id == "table1-d")
    assert printed[1:4] == [str(count) for count in counts([4] * 23 + [3] * 2, [4] * 5)[:3]]
    assert counts([4] * 18 + [3] * 12, [])[:3] == (30, int(printed[2]), int(printed[3]) + 10)
