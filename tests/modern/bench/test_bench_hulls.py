"""The benchmarks of hulls: installed and missing peers, tables and slopes."""

import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from modern.bench.suite import __main__ as bench
from modern.bench.suite import hulls, peers, studies
from modern.bench.suite.peers import Missing, Peers, cgal, qhull
from modern.bench.timing import Curve, Figure, Measured, side_by_side

POINTS = np.array([(x, y, z) for x in (0, 2) for y in (0, 2) for z in (0, 2)])


def compiler(folder: Path, monkeypatch: pytest.MonkeyPatch, script: str) -> None:
    """Install a script as C++ compiler. In it, OUT is the file to create."""
    made = folder / "compiler"
    made.write_text(f'#!/bin/sh\nwhile [ "$1" != -o ]; do shift; done\nOUT=$2\n{script}\n')
    made.chmod(0o755)
    monkeypatch.setenv("CXX", str(made))


PROGRAM = """cat > "$OUT" << 'END'
#!/bin/sh
read -r line
[ "$line" = "0 0 0" ] || exit 1
echo 9.5 8
echo 0.25 8
END
chmod +x "$OUT\""""


def test_cgal_program_times_itself(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The result is the second of its two runs, not the time of the process."""
    compiler(tmp_path, monkeypatch, PROGRAM)
    work = cgal(tmp_path)(POINTS)
    assert work() == Measured(0.25)
    monkeypatch.setattr("modern.bench.timing.RUNS", 2)
    assert side_by_side({"CGAL": work})[0].seconds == (0.25, 0.25)


@pytest.mark.parametrize(
    ("script", "message"),
    [
        (
            'echo "hull.cpp:2: fatal error: CGAL/x.h: No such file" >&2; exit 1',
            "with CGAL's headers: hull.cpp:2: fatal error",
        ),
        ("exit 1", "no reason given"),
    ],
)
def test_missing_headers_are_reported(
    script: str, message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    compiler(tmp_path, monkeypatch, script)
    with pytest.raises(Missing, match=message) as caught:
        cgal(tmp_path)
    assert "\n" not in str(caught.value)


def test_tables_work_without_peers(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each missing peer has one line, and the project's rows are measured alone."""
    monkeypatch.setenv("CXX", "nothere")
    monkeypatch.setitem(sys.modules, "scipy.spatial", None)
    monkeypatch.setattr(hulls, "RUNS", 1)
    with Peers() as available:
        assert available.installed == {}
        assert available.remarks == [
            "Qhull is omitted: scipy is not installed",
            "CGAL is omitted: no C++ compiler is installed (c++, g++, clang++, or CXX)",
        ]
        table = hulls.table("eight points", POINTS, {"judge": lambda: None}, available)
    assert table.lines()[0].split() == ["eight", "points", "seconds"]


def test_table_has_ratios_to_the_peers() -> None:
    rows = (Figure("judge", (0.3, 0.2, 0.1)), Figure("Qhull", (0.1,)), Figure("CGAL", (0.05,)))
    lines = hulls.Table("100 points", rows, ("Qhull", "CGAL")).lines()
    assert [line.split() for line in lines] == [
        ["100", "points", "seconds", "/", "Qhull", "/", "CGAL"],
        ["judge", "0.2000", "2.0", "4.0"],
        ["Qhull", "0.1000", "1.0", "2.0"],
        ["CGAL", "0.0500", "0.5", "1.0"],
    ]
    assert max(map(len, lines)) <= 78


def test_every_table_measures_judge_or_port_and_peers(monkeypatch: pytest.MonkeyPatch) -> None:
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
    with Peers() as available:
        curves = hulls.growth(available, (20, 40))
    assert [curve.name for curve in curves] == ["judge, numpy", "port, numpy", "Qhull", "CGAL"]
    assert all([count for count, _ in curve.points] == [20, 40] for curve in curves)


def test_slope_is_the_exponent_of_growth() -> None:
    points = [(10, 99.0), *((count, 2e-6 * count**1.25) for count in (100, 1_000, 10_000))]
    assert Curve("", points).slope(100) == pytest.approx(1.25)
    assert Curve("", points).slope(10_000) is None


def test_waiting_is_not_counted_as_processor_time() -> None:
    figure = side_by_side({"waits": lambda: time.sleep(0.02)}, clock=time.process_time)[0]
    assert figure.median < 0.01
    assert side_by_side({"waits": lambda: time.sleep(0.02)})[0].median >= 0.02


def test_linear_algebra_uses_one_thread() -> None:
    """A separate process is needed, because numpy reads the setting when it is loaded."""
    script = "import os, sys, modern.bench; print(os.environ['OPENBLAS_NUM_THREADS'], 'numpy' in sys.modules)"
    environment = {name: value for name, value in os.environ.items() if name != "OPENBLAS_NUM_THREADS"}
    process = subprocess.run(
        [sys.executable, "-c", script], env=environment, capture_output=True, text=True, check=True
    )
    assert process.stdout == "1 False\n"


def test_failed_study_ends_the_timing_with_its_message(capfd: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit, match="no-study: the study failed with exit code 2"):
        studies.first_rows("no-study")
    assert "no-study" in capfd.readouterr().err
