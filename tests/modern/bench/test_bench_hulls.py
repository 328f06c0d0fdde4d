"""The benchmarks of hulls: installed and missing peers, tables and slopes."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from modern.bench.suite import __main__ as bench
from modern.bench.suite import hulls, peers, studies
from modern.bench.suite.peers import installed, qhull
from modern.bench.timing import Curve

POINTS = np.array([(x, y, z) for x in (0, 2) for y in (0, 2) for z in (0, 2)])


def test_tables_work_without_peers(tmp_path: Path, monkeypatch) -> None:
    """Each missing peer has one line, and the project's rows are measured alone."""
    monkeypatch.setenv("CXX", "nothere")
    monkeypatch.setitem(sys.modules, "scipy.spatial", None)
    monkeypatch.setattr(hulls, "RUNS", 1)
    available, remarks = installed(tmp_path)
    assert available == {}
    assert remarks == [
        "Qhull is omitted: scipy is not installed",
        "CGAL is omitted: expected a C++ compiler (c++, g++, clang++, or the value of CXX), found none",
    ]
    table = hulls.table("eight points", POINTS, {"judge": lambda: None}, available)
    assert table.lines()[0].split() == ["eight", "points", "seconds"]


def test_every_table_measures_judge_or_port_and_peers(tmp_path: Path, monkeypatch) -> None:
    pytest.importorskip("scipy")
    monkeypatch.setattr(hulls, "RUNS", 1)
    monkeypatch.setattr(hulls, "find_spec", lambda name: None)
    monkeypatch.setattr(hulls, "starts", lambda: iter(()))
    monkeypatch.setattr(peers, "cgal", lambda folder: qhull())
    names = [line.split()[0].rstrip(",") for line in hulls.lines(100)]
    sets = ["100"] * 4 + ["1,000", "a"]
    assert names == [
        "100",
        "port",
        "Qhull",
        "CGAL",
        *(name for first in sets for name in (first, "judge", "Qhull", "CGAL")),
    ]
    assert bench.GROUPS["hulls"] is hulls.lines
    curves = hulls.growth(installed(tmp_path)[0], (20, 40))
    assert [curve.name for curve in curves] == ["judge, numpy", "port, numpy", "Qhull", "CGAL"]
    assert all([count for count, _ in curve.points] == [20, 40] for curve in curves)


def test_slope_is_the_exponent_of_growth() -> None:
    points = [(10, 99.0), *((count, 2e-6 * count**1.25) for count in (100, 1_000, 10_000))]
    assert Curve("", points).slope(100) == pytest.approx(1.25)
    assert Curve("", points).slope(10_000) is None


def test_linear_algebra_uses_one_thread() -> None:
    """A separate process is needed, because numpy reads the setting when it is loaded."""
    script = "import os, sys, modern.bench; print(os.environ['OPENBLAS_NUM_THREADS'], 'numpy' in sys.modules)"
    environment = {name: value for name, value in os.environ.items() if name != "OPENBLAS_NUM_THREADS"}
    process = subprocess.run(
        [sys.executable, "-c", script], env=environment, capture_output=True, text=True, check=True
    )
    assert process.stdout == "1 False\n"


def test_failed_study_ends_the_timing_with_its_message(capfd) -> None:
    with pytest.raises(SystemExit, match="no-study: the study failed with exit code 2"):
        studies.first_rows("no-study")
    assert "no-study" in capfd.readouterr().err
