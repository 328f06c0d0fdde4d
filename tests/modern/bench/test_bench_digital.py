"""The benchmarks of solids: octree hulls compared with their peers, and the growth of their times."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from modern.bench.suite import digital
from modern.bench.timing import Curve
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


def test_growth_is_printed_and_plotted_with_slopes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("matplotlib")
    without_scikit_image(monkeypatch)
    measured = digital.growth((3, 5))
    assert [curve.name for curve in measured] == ["octree hull", "voxel hull, cell list", "digital hull"]
    assert [count for count, _ in measured[0].points] == [ball(3).count, ball(5).count]
    curves = [Curve("ours", [(10, 1.0), (100, 10.0), (1000, 100.0)]), Curve("theirs", [(10, 2.0)])]
    monkeypatch.setattr(digital, "growth", lambda: curves)
    monkeypatch.setattr(digital, "SLOPES_FROM", 100)
    monkeypatch.setattr(sys, "argv", ["digital", str(tmp_path / "growth.svg")])
    digital.main()
    assert capsys.readouterr().out.splitlines() == [
        "ours 10: 1.0000 s, 100: 10.0000 s, 1,000: 100.0000 s slope 1.00",
        "theirs 10: 2.0000 s",
    ]
    assert "ours: slope 1.00" in (tmp_path / "growth.svg").read_text()


def test_peak_memory_is_that_of_the_measured_process_alone() -> None:
    held = np.ones(300_000_000, dtype=np.int8)
    size, most = digital.peak(7, "voxel")
    assert size == 7**3
    assert 10e6 < most < held.nbytes
