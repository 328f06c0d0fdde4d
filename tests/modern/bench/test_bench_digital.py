"""The benchmarks of solids: octree hulls compared with their peers, and the growth of their times."""

from dataclasses import replace

import numpy as np
import pytest

from modern.bench.suite import digital
from modern.digital.solids import ball
from modern.papers.kovalevsky_schulz import voxel_hull


@pytest.fixture(autouse=True)
def one_run(monkeypatch) -> None:
    monkeypatch.setattr("modern.bench.timing.RUNS", 1)


def without_scikit_image(monkeypatch) -> None:
    monkeypatch.setattr(digital, "find_spec", lambda name: None)


def test_table_compares_the_octree_hull_with_the_digital_hull(monkeypatch) -> None:
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
def test_table_reports_a_different_hull(name: str, monkeypatch) -> None:
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
