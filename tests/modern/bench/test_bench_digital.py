"""The benchmarks of solids: octree hulls compared with their peers, and the growth of their times."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from modern.bench.suite import __main__ as bench
from modern.bench.suite import digital
from modern.bench.timing import Curve, Figure, plotted
from modern.digital.solids import ball
from modern.papers.kovalevsky_schulz import voxel_hull


@pytest.fixture(autouse=True)
def one_run(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("modern.bench.timing.RUNS", 1)


def without_scikit_image(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(digital, "find_spec", lambda name: None)


def test_table_compares_the_octree_hull_with_the_digital_hull(monkeypatch: pytest.MonkeyPatch) -> None:
    without_scikit_image(monkeypatch)
    table = digital.table(ball(7), slow=True)
    assert table.points == "ball:7:voxel, 179 voxels"
    assert [row.what for row in table.rows] == ["octree hull", "voxel hull, cell list", "digital hull"]
    assert table.peers == ("digital hull",)
    assert {len(line) for line in table.lines()} == {78}
    assert table.lines()[0].endswith("seconds  / digital hull")


def test_scikit_image_runs_once_and_only_for_small_solids(monkeypatch: pytest.MonkeyPatch) -> None:
    calls = []

    def fake(array: Any) -> Any:
        calls.extend([array] * (len(array) > 2))
        return array

    monkeypatch.setattr(digital, "find_spec", lambda name: name == "skimage" or None)
    monkeypatch.setattr(digital, "by_scikit_image", fake)
    assert digital.table(ball(7), slow=True).peers == ("digital hull", "skimage")
    assert digital.table(ball(7), slow=False).peers == ("digital hull",)
    assert len(calls) == 1
    assert max(map(len, digital.table(ball(7), slow=True).lines())) == 78


def test_scikit_image_agrees_with_the_digital_hull() -> None:
    pytest.importorskip("skimage")
    assert np.array_equal(digital.by_scikit_image(ball(5).array), ball(5).array)


@pytest.mark.parametrize("name", ["octree_hull", "voxel_hull", "by_scikit_image"])
def test_table_reports_a_different_hull(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    right = digital.octree_hull
    wrong = {
        "octree_hull": lambda volume: replace(right(volume), filled=~right(volume).filled),
        "voxel_hull": lambda volume, of: voxel_hull(ball(3), of),
        "by_scikit_image": lambda array: ~array,
    }
    monkeypatch.setattr(digital, "find_spec", lambda name: name == "skimage" or None)
    monkeypatch.setattr(digital, "by_scikit_image", lambda array: array)
    assert "OTHER HULLS" not in digital.table(ball(5), slow=True).points
    monkeypatch.setattr(digital, name, wrong[name])
    assert digital.table(ball(5), slow=True).points.endswith(", OTHER HULLS")


def test_digital_group_prints_figures_and_tables(monkeypatch: pytest.MonkeyPatch) -> None:
    assert bench.GROUPS["digital"] is digital.lines
    without_scikit_image(monkeypatch)
    monkeypatch.setattr(digital, "figures", lambda largest: iter([Figure("a figure", (1.0,))]))
    printed = list(digital.lines(31))
    assert [line.split()[0] for line in printed] == ["a", "ball:15:voxel,", "octree", "voxel", "digital"]


def test_growth_is_printed_and_plotted_with_slopes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("matplotlib")
    without_scikit_image(monkeypatch)
    measured = digital.growth((3, 5))
    assert [curve.name for curve in measured] == ["octree hull", "voxel hull, cell list", "digital hull"]
    assert [count for count, _ in measured[0].points] == [ball(3).count, ball(5).count]
    curves = [Curve("ours", [(10, 1.0), (100, 10.0), (1000, 100.0)], {}), Curve("theirs", [(10, 2.0)], {})]
    monkeypatch.setattr(digital, "growth", lambda: curves)
    monkeypatch.setattr(digital, "SLOPES_FROM", 100)
    monkeypatch.setattr(sys, "argv", ["digital", str(tmp_path / "growth.svg")])
    digital.main()
    assert capsys.readouterr().out.splitlines() == [
        "ours 10: 1.0000 s, 100: 10.0000 s, 1,000: 100.0000 s slope 1.00",
        "theirs 10: 2.0000 s",
    ]
    assert "ours: slope 1.00" in (tmp_path / "growth.svg").read_text()


def test_names_of_plotted_curves_contain_slopes(monkeypatch: pytest.MonkeyPatch) -> None:
    drawn: list[Any] = []
    monkeypatch.setattr("modern.bench.timing.plot", lambda curves, path, what: drawn.extend([*curves, path, what]))
    assert list(plotted([Curve("ours", [(1, 1.0), (2, 4.0)], {})], "p.svg", "voxels")) == [
        "ours 1: 1.0000 s, 2: 4.0000 s slope 2.00"
    ]
    assert (drawn[0].name, drawn[1:]) == ("ours: slope 2.00", ["p.svg", "voxels"])


def test_complete_processes_are_measured(monkeypatch: pytest.MonkeyPatch) -> None:
    run: list[list[str]] = []
    monkeypatch.setattr(digital, "find_spec", lambda name: None)
    monkeypatch.setattr(digital, "peak", lambda side, way: (side**3, 1e6))
    monkeypatch.setattr("subprocess.run", lambda command, **options: run.append(command))
    monkeypatch.setattr(digital, "digital_hull", lambda array, fast: None)
    processes = [figure for figure in digital.figures(256) if "a whole process" in figure.what]
    assert [figure.what.split()[:2] for figure in processes] == [
        ["octree-hull", "ball:127,"],
        ["octree-hull", "ball:254,"],
        ["voxel-hull", "ball:255,"],
    ]
    assert [figure.note for figure in processes[1:]] == ["1 MB; bar 10 s, 500 MB", "1 MB; bar 1.4 s"]
    assert run[-1][-2:] == ["voxel-hull", "ball:255"]


def test_peak_memory_is_that_of_the_measured_process_alone() -> None:
    held = np.ones(300_000_000, dtype=np.int8)
    size, most = digital.peak(7, "voxel")
    assert size == 7**3
    assert 10e6 < most < held.nbytes
