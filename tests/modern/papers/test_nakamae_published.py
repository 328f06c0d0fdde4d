"""Tests of the published results of Nakamae and Nishita against the computed ones."""

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


def test_every_published_result_has_the_expected_verdict() -> None:
    assert {finding.result.id: finding.kind for finding in findings(PAPER)} == KINDS


@pytest.mark.parametrize("row", [row.id for row in text_of(PAPER).rows])
def test_every_emendation_is_needed(row: str) -> None:
    without = {line.id: line.text.split() for line in build(text_of(PAPER), without=(row,))}
    emendation = next(candidate for candidate in text_of(PAPER).rows if candidate.id == row)
    printed = [without[change.line] for change in emendation.changes]
    lines = [line.split() for result in produced_by(PAPER).values() for line in result]
    assert not any(line in lines for line in printed)


def test_a_different_number_is_reported_as_different() -> None:
    lines = produced_by(PAPER)
    for result in results_of(PAPER):
        if KINDS[result.id] in (EXACT, CORRECTED):
            assert judge(PAPER, result, [lines[result.id][0] + "1"]).kind == DIFFERENT


def test_25_prisms_and_five_plates_have_the_counts_of_table_1_d() -> None:
    """Check the recorded reason, which adds that thirty prisms with as many vertices have ten more faces."""
    zero, up = Fraction(0), (Fraction(0), Fraction(0), Fraction(1))

    def counts(sides: list[int], plates: list[int]) -> tuple[int, int, int, int]:
        shapes = [column("column", round_base("column", n, Fraction(1)), up) for n in sides]
        shapes += [plate("plate", round_base("plate", n, Fraction(1))) for n in plates]
        disjoint = [placed(p, moved((Fraction(10 * k), zero, zero)), f"{k}") for k, p in enumerate(shapes)]
        return draw(disjoint, parallel((1, -2, 3))).counts

    (printed,) = (result.corrected[0].split() for result in results_of(PAPER) if result.id == "table1-d")
    assert printed[1:4] == [str(count) for count in counts([4] * 23 + [3] * 2, [4] * 5)[:3]]
    assert counts([4] * 18 + [3] * 12, [])[:3] == (30, int(printed[2]), int(printed[3]) + 10)
