"""What Appel & Will print against what is computed, and that every emendation is needed."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path

import pytest

from modern.claims.published import (
    CANNOT,
    CORRECTED,
    PAPERS,
    findings,
    judge,
    printed_lines,
    produced_by,
    results_of,
    text_of,
)
from modern.edition.apparatus import ApparatusError
from modern.edition.reproduce import DIFFERENT, EXACT
from modern.papers.appel_will.results import found_solid, printed_solid

PAPER = next(paper for paper in PAPERS if paper.name == "appel-will")
RESULTS = {result.id: result for result in results_of(PAPER)}
PRODUCED = produced_by(PAPER)
TEXT = text_of(PAPER)
FOLDER: Traversable = files("transcripts").joinpath(PAPER.folder)


@pytest.mark.parametrize("name", RESULTS)
def test_result_comes_out(name: str) -> None:
    result = RESULTS[name]
    finding = judge(PAPER, result, PRODUCED.get(name, ()))
    expected = CANNOT if name == "times" else CORRECTED if result.rows else EXACT
    assert finding.kind == expected


def test_counts_of_the_verdicts() -> None:
    kinds = Counter(finding.kind for finding in findings(PAPER))
    assert kinds == {EXACT: 7, CORRECTED: 8, CANNOT: 1}


@pytest.mark.parametrize("row", [row.id for row in TEXT.rows])
def test_row_is_needed(row: str, tmp_path: Path) -> None:
    """Without the row a printed result is another; AW-09 drops lines that belong to none."""
    text = (FOLDER / "apparatus.toml").read_text(encoding="utf-8")
    head, *rows = text.split("[[row]]")
    kept = [part for part in rows if f'id = "{row}"' not in part]
    assert len(kept) == len(rows) - 1
    (tmp_path / "apparatus.toml").write_text("[[row]]".join([head, *kept]), encoding="utf-8")
    for name in ("witness.txt", "results.toml"):
        (tmp_path / name).write_text((FOLDER / name).read_text(encoding="utf-8"), encoding="utf-8")
    if row == "AW-09":
        with pytest.raises(ApparatusError, match="lines 51, 52 belong to no result"):
            list(findings(PAPER, tmp_path))
    else:
        assert DIFFERENT in [finding.kind for finding in findings(PAPER, tmp_path)]


@pytest.mark.parametrize("name", [name for name in RESULTS if name in PRODUCED])
def test_a_changed_word_is_seen(name: str) -> None:
    first, *rest = RESULTS[name].corrected
    words = first.split()
    changed = replace(RESULTS[name], corrected=(" ".join([*words[:-1], "77"]), *rest))
    assert judge(PAPER, changed, PRODUCED[name]).kind == DIFFERENT


def test_found_coordinates_are_marked_as_such_and_no_result_uses_others() -> None:
    text = (FOLDER / "coordinates.toml").read_text(encoding="utf-8")
    assert "FOUND, NOT PRINTED" in text
    for name in ("fig13", "fig14", "fig18", "fig23"):
        assert found_solid(name).points
    with pytest.raises(KeyError):
        found_solid("fig4")


def test_fig_4_is_read_from_the_print() -> None:
    solid = printed_solid(printed_lines(PAPER))
    assert (len(solid.points), len(solid.surfaces)) == (10, 7)


def test_loops_and_map_of_the_print_say_the_same() -> None:
    """Fig. 23's rule on signs, applied to the corrected print alone."""
    lines = [line.split() for line in RESULTS["fig23-edges"].corrected]
    ends = {int(label): (int(i), int(j)) for label, i, j in lines}
    columns: list[list[int]] = [[] for _ in range(7)]
    for line in RESULTS["fig23-loops"].corrected:
        for column, cell in zip(columns, line.split("\t")[1:], strict=True):
            column.extend(int(word) for word in cell.split())
    surfaces = [[ends[abs(entry)][0 if entry > 0 else 1] for entry in column] for column in columns]
    for place, line in enumerate(RESULTS["fig23-map"].corrected):
        cells = line.split("\t")[1:]
        assert [int(c) if c else None for c in cells] == [s[place] if place < len(s) else None for s in surfaces]
