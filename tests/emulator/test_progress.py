"""The display of progress, and the distribution of a study's work."""

import io
import threading
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from emulator.progress import Progress
from modern.study import Port, Programs, run_study
from modern.study.run import plain_lines
from modern.study.workers import in_processes
from tests.support.studied import PLAN


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def ticking(step: float) -> Iterator[float]:
    now = 0.0
    while True:
        yield now
        now += step


def test_progress_is_a_bar_on_a_terminal_and_lines_in_a_file(monkeypatch) -> None:
    for columns in (100, 40, 20):
        monkeypatch.setenv("COLUMNS", str(columns))
        clock, file = ticking(1.0), Terminal()
        progress = Progress(100, 20, file, clock=lambda clock=clock: next(clock))
        progress.add(10)
        progress.add(70)
        progress.close()
        drawn = file.getvalue().split("\r")
        assert all(len(line.rstrip("\n")) < columns for line in drawn)
        assert file.getvalue().endswith("\n")
        assert drawn[-1].lstrip("[#.] ").startswith("100 of 100"[:columns])
    plain, clock = io.StringIO(), ticking(25.0)
    progress = Progress(100, 0, plain, clock=lambda: next(clock))
    for _ in range(10):
        progress.add(10)
    progress.close()
    assert plain.getvalue().splitlines()[0].startswith("30 of 100 samples")
    assert len(plain.getvalue().splitlines()) == 3
    silent = Terminal()
    progress = Progress(10, 0, silent, quiet=True)
    progress.add(10)
    progress.close()
    assert silent.getvalue() == ""


def test_progress_ignores_a_closed_pipe() -> None:
    class Broken(io.StringIO):
        def write(self, _: str) -> int:
            raise BrokenPipeError

    clock = ticking(100.0)
    progress = Progress(10, 0, Broken(), clock=lambda: next(clock))
    progress.add(5)
    progress.add(5)
    progress.close()


def test_chunks_are_computed_on_request_without_a_thread() -> None:
    # So memory does not grow with the number of chunks.
    plan = replace(PLAN, cells=(replace(PLAN.cells[0], samples=5_000_000),))
    chunks = [chunk for chunk, _ in zip(plan.chunks(), range(1000), strict=False)]
    made = in_processes(plan, chunks, 1)
    assert [next(made)[0] for _ in range(2)] == chunks[:2]
    made.close()
    before = threading.active_count()
    list(in_processes(PLAN, list(PLAN.chunks())[:1], 1))
    assert threading.active_count() == before


def test_each_arithmetic_that_cannot_be_compiled_is_reported_once() -> None:
    pytest.importorskip("numba")
    wide = (Programs("a", arithmetic="truncating:20"), Programs("b", arithmetic="truncating:20", layers=("corrected",)))
    mixed = (Programs("c"), Programs("d", arithmetic="exact"), Port("e", "truncating:20"))
    lines = plain_lines(replace(PLAN, cells=tuple(replace(cell, routes=wide + mixed) for cell in PLAN.cells)))
    assert [line.split(":")[0] for line in lines] == [
        "truncating",
        "the compiled engine does not support exact arithmetic",
    ]
    assert "supports at most 9" in lines[0]


def test_a_study_reports_that_the_interpreter_runs(tmp_path: Path, monkeypatch, capsys) -> None:
    monkeypatch.setattr("modern.study.run.why_plain", lambda options: "no compiled engine here")
    run_study(PLAN, tmp_path / "loud", workers=1)
    assert capsys.readouterr().err.count("no compiled engine here\n") == 1
    run_study(PLAN, tmp_path / "quiet", workers=1, quiet=True)
    assert capsys.readouterr().err == ""
