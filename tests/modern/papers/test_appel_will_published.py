"""Every published result of Appel & Will compared with the computed one, and the need for every emendation."""

from __future__ import annotations

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
def test_a_published_result_is_reproduced(name: str) -> None:
    result = RESULTS[name]
    finding = judge(PAPER, result, PRODUCED.get(name, ()))
    expected = CANNOT if name == "times" else CORRECTED if result.rows else EXACT
    assert finding.kind == expected


@pytest.mark.parametrize("row", [row.id for row in TEXT.rows])
def test_every_emendation_is_needed(row: str, tmp_path: Path) -> None:
    """Without the row some result differs. AW-09 deletes lines that do not belong to any result."""
    text = (FOLDER / "apparatus.toml").read_text(encoding="utf-8")
    head, *rows = text.split("[[row]]")
    remaining = [part for part in rows if f'id = "{row}"' not in part]
    assert len(remaining) == len(rows) - 1
    (tmp_path / "apparatus.toml").write_text("[[row]]".join([head, *remaining]), encoding="utf-8")
    for name in ("witness.txt", "results.toml"):
        (tmp_path / name).write_text((FOLDER / name).read_text(encoding="utf-8"), encoding="utf-8")
    if row == "AW-09":
        with pytest.raises(ApparatusError, match="lines 51, 52 do not belong to any result"):
            list(findings(PAPER, tmp_path))
    else:
        assert DIFFERENT in [finding.kind for finding in findings(PAPER, tmp_path)]


@pytest.mark.parametrize("name", [name for name in RESULTS if name in PRODUCED])
def test_a_changed_number_is_detected(name: str) -> None:
    first, *rest = RESULTS[name].corrected
    changed = replace(RESULTS[name], corrected=(" ".join([*first.split()[:-1], "77"]), *rest))
    assert judge(PAPER, changed, PRODUCED[name]).kind == DIFFERENT


def test_fig_4_is_read_from_the_print_and_not_from_our_coordinates() -> None:
    with pytest.raises(KeyError):
        found_solid("fig4")
    solid = printed_solid(printed_lines(PAPER))
    assert (len(solid.points), len(solid.surfaces)) == (10, 7)


def test_the_printed_loops_and_map_of_fig_23_agree() -> None:
    """The rule of Fig. 23 on signs is applied to the corrected print alone."""
    lines = [line.split() for line in RESULTS["fig23-edges"].corrected]
    ends = {int(label): (int(i), int(j)) for label, i, j in lines}
    columns: list[list[int]] = [[] for _ in range(7)]
    for line in RESULTS["fig23-loops"].corrected:
        for column, cell in zip(columns, line.split("\t")[1:], strict=True):
            column.extend(int(entry) for entry in cell.split())
    surfaces = [[ends[abs(entry)][0 if entry > 0 else 1] for entry in column] for column in columns]
    for row, line in enumerate(RESULTS["fig23-map"].corrected):
        cells = line.split("\t")[1:]
        assert [int(c) if c else None for c in cells] == [s[row] if row < len(s) else None for s in surfaces]
