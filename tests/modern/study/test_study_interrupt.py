"""Ctrl-C while a study works: at whatever moment it ends soon and in a line, and nothing that was kept is lost."""

from __future__ import annotations

import ctypes
import os
import random
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from concurrent.futures import process
from pathlib import Path

import pytest

from modern.study import run_study
from modern.study.interrupt import Interrupt, watching
from modern.study.workers import in_processes
from tests.support.paths import ROOT
from tests.support.studied import PLAN

MOMENTS = int(os.environ.get("HULL1620_MOMENTS", "4"))
"""How many moments are tried; more with HULL1620_MOMENTS=40."""
PLAN_FILE = """
name = "long"
samples = 200000
[[route]]
name = "exact"
kind = "port"
[[cell]]
key = { n = 4 }
family = "integers"
parameters = { digits = 1, n = 4 }
chunk = 20
"""
pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")


@pytest.fixture(autouse=True)
def _ctrl_c_means_something() -> Iterator[None]:
    """A shell that runs the tests in the background has every process it begins ignore Ctrl-C."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def started(folder: Path, workers: int) -> subprocess.Popen[str]:
    (folder / "long.toml").write_text(PLAN_FILE)
    command = [sys.executable, "-m", "hull1620", "study", "long.toml", "--workers", str(workers), "--resume"]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    return subprocess.Popen(command, cwd=folder, env=environment, stderr=subprocess.PIPE, text=True)


def rows(folder: Path) -> set[str]:
    return {path.name for path in folder.glob("long/rows/*.jsonl")}


@pytest.mark.parametrize("workers", [1, 2])
def test_at_any_moment_it_ends_in_lines_of_ours(workers: int, tmp_path: Path) -> None:
    rng = random.Random(workers)
    kept: set[str] = set()
    for moment in range(MOMENTS):
        process = started(tmp_path, workers)
        try:
            time.sleep(rng.uniform(0.1, 4))
            process.send_signal(signal.SIGINT)
            _, err = process.communicate(timeout=60)
        finally:
            process.kill()
        assert process.returncode in (130, -signal.SIGINT), (moment, err)
        assert all(
            line.startswith(("hull1620: ", "the compiled engine", "plots need")) or " samples" in line
            for line in err.splitlines()
            if line
        ), err
        assert kept <= rows(tmp_path)
        kept = rows(tmp_path)


def test_the_second_press_stops_at_once(tmp_path: Path) -> None:
    process = started(tmp_path, 2)
    try:
        deadline = time.monotonic() + 60
        while len(rows(tmp_path)) < 3 and time.monotonic() < deadline:
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=30)
    finally:
        process.kill()
    assert "Traceback" not in err
    assert len(rows(tmp_path)) >= 3


def test_the_first_press_finishes_what_is_in_hand_and_says_so(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    interrupt = Interrupt()
    work = in_processes(PLAN, list(PLAN.chunks()), 1, interrupt)
    next(work)
    interrupt.finished += 1
    interrupt.press()
    assert "hull1620: the chunk in hand will be finished first; Ctrl-C again stops now\n" in capsys.readouterr().err
    assert list(work) == []
    with pytest.raises(KeyboardInterrupt):
        interrupt.press()


def test_a_press_while_the_pool_begins_is_a_press(monkeypatch: pytest.MonkeyPatch) -> None:
    """The pool's own thread is made, and not begun: the pool cannot wait for it."""

    def pressed(thread: threading.Thread) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(process, "_ExecutorManagerThread", type("Begun", (threading.Thread,), {"start": pressed}))
    monkeypatch.setattr(process._ExecutorManagerThread, "__init__", lambda one, pool: threading.Thread.__init__(one))
    with pytest.raises(KeyboardInterrupt):
        list(in_processes(PLAN, list(PLAN.chunks()), 2, Interrupt()))


def test_with_nothing_finished_the_first_press_stops() -> None:
    with pytest.raises(KeyboardInterrupt):
        Interrupt(in_hand=3).press()
    with pytest.raises(KeyboardInterrupt):
        Interrupt(finished=3).press()


@pytest.mark.parametrize("falls", [1, 3])
def test_a_press_within_a_librarys_callback_is_not_lost(falls: int, capfd: pytest.CaptureFixture[str]) -> None:
    """Python drops what is raised in a function that C calls, as when numba's compiler hands over its code."""
    left = [falls]

    @ctypes.CFUNCTYPE(None)
    def callback() -> None:
        if left[0]:
            left[0] -= 1
            os.kill(os.getpid(), signal.SIGINT)
            time.sleep(0.001)

    deadline = time.monotonic() + 20

    def work() -> None:
        while left[0]:
            callback()
        while time.monotonic() < deadline:
            time.sleep(0.005)

    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    hook = sys.unraisablehook
    try:
        with pytest.raises(KeyboardInterrupt), watching():
            work()
        assert sys.unraisablehook is hook
    finally:
        signal.signal(signal.SIGINT, before)
    assert time.monotonic() < deadline
    assert capfd.readouterr().err == ""


def test_what_ctrl_c_meant_before_it_means_after() -> None:
    before = signal.getsignal(signal.SIGINT)
    try:
        signal.signal(signal.SIGINT, signal.default_int_handler)
        with watching() as interrupt:
            assert signal.getsignal(signal.SIGINT) == interrupt.press
        assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        with watching():
            assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGINT, before)


def test_a_study_asked_to_end_is_resumed_to_the_same_rows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Pressed as the fourth chunk is kept."""
    from modern.study.store import Store

    run_study(PLAN, tmp_path / "whole", workers=1, quiet=True)
    add, count = Store.add, [0]

    def adding(store: Store, *values: object) -> None:
        add(store, *values)  # type: ignore[arg-type]
        count[0] += 1
        if count[0] == 4:
            os.kill(os.getpid(), signal.SIGINT)

    monkeypatch.setattr(Store, "add", adding)
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(KeyboardInterrupt):
            run_study(PLAN, tmp_path / "cut", workers=1, quiet=True)
    finally:
        signal.signal(signal.SIGINT, before)
    done = sorted((tmp_path / "cut/rows").iterdir())
    assert 4 <= len(done) <= 5
    run_study(PLAN, tmp_path / "cut", workers=1, quiet=True, resume=True)
    for path in (tmp_path / "whole/rows").iterdir():
        assert (tmp_path / "cut/rows" / path.name).read_bytes() == path.read_bytes()
