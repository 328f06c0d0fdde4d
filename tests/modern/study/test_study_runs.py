"""A study in its folder gives the same rows whatever the workers, interruptions and failures."""

import errno
import json
import os
import random
import signal
import sqlite3
import subprocess
import sys
import threading
import time
from concurrent.futures import process as process_pool
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from emulator.errors import EmulatorError
from emulator.files import UNFINISHED
from modern.study import Plan, PlanError, Port, Programs, run, run_study, workers
from modern.study.index import NAME as INDEX
from modern.study.plan import Chunk
from modern.study.store import Store, StudyFileError
from modern.study.tomlplan import read_plan
from modern.study.workers import in_processes
from tests.support.paths import ROOT
from tests.support.studied import PLAN, ROUTES, contents

PLAN_FILE = """
name = "long"
samples = 500
[[route]]
name = "exact"
kind = "port"
[[cell]]
key = { n = 4 }
family = "integers"
parameters = { digits = 1, n = 4 }
chunk = 10
"""
WORKER = """
import multiprocessing
from concurrent.futures import ProcessPoolExecutor
from modern.study.workers import _begin_worker

pool = ProcessPoolExecutor(1, multiprocessing.get_context("spawn"), initializer=_begin_worker)
pool.submit(print, "at work", flush=True).result()
pool.submit(input).result()
"""


def contents_without_plots(folder: Path) -> dict[str, bytes]:
    return {name: data for name, data in contents(folder).items() if not name.endswith((".svg", ".png"))}


def forked(folder: Path) -> int:
    """Begin or resume the study in a copy of this process and return its process number."""
    child = os.fork()
    if child:
        return child
    try:
        run_study(PLAN, folder, workers=1, quiet=True, resume=True)
        os._exit(0)
    finally:
        os._exit(1)


def test_rows_and_manifest_describe_the_study(finished: Path) -> None:
    lines = (finished / "rows" / "0001-000000004.jsonl").read_text().splitlines()
    row = json.loads(lines[0])
    assert (row["cell"], row["index"], len(lines)) == (1, 4, 4)
    assert row["deck"][0] == " 9"
    assert row["seed"] == PLAN.cells[1].seed(5, 4)
    assert set(row["runs"]) == {"listed", "exact"}
    assert row["runs"]["exact"]["outcome"] == "right"
    assert row["judge"]["n"] == 9
    manifest = json.loads((finished / "manifest.json").read_text())
    assert manifest["complete"] is True
    assert manifest["plan"] == PLAN.document()
    assert {"python", "numpy", "numba", "hull1620"} == set(manifest["versions"])


def test_workers_end_when_their_parent_process_is_killed() -> None:
    """The pipe that they share closes when the last of them has ended."""
    command = [sys.executable, "-c", WORKER]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, env={**os.environ, "PYTHONPATH": str(ROOT)})
    assert process.stdout is not None
    assert process.stdout.readline() == b"at work\n"
    process.kill()
    process.communicate(timeout=30)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
@pytest.mark.usefixtures("_without_plots")
def test_study_killed_at_random_moments_resumes_to_the_same_files(finished: Path, tmp_path: Path) -> None:
    begun = time.monotonic()
    run_study(PLAN, tmp_path / "timed", workers=1, quiet=True)
    seconds = time.monotonic() - begun
    folder, rng = tmp_path / "killed", random.Random()
    for _ in range(5):
        child = forked(folder)
        time.sleep(rng.uniform(0, seconds / 3))
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        assert not list(folder.glob(f"{INDEX}-*")), "an interrupted run leaves no journal"
    assert os.waitpid(forked(folder), 0)[1] == 0
    assert contents_without_plots(folder) == contents_without_plots(finished)
    with sqlite3.connect(folder / INDEX) as index:
        assert index.execute("SELECT COUNT(*) FROM runs").fetchone() == (2 * PLAN.samples,)


@pytest.mark.skipif(sys.platform == "win32", reason="needs POSIX signals")
@pytest.mark.usefixtures("_without_plots")
def test_ctrl_c_stops_two_workers_at_once_and_the_study_resumes_to_the_same_rows(tmp_path: Path) -> None:
    (tmp_path / "long.toml").write_text(PLAN_FILE)
    command = [sys.executable, "-m", "hull1620", "study", "long.toml", "--workers", "2"]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    process = subprocess.Popen(
        command,
        cwd=tmp_path,
        env=environment,
        stderr=subprocess.PIPE,
        text=True,
        # A shell that runs the tests in the background makes every process it starts ignore Ctrl-C.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    folder = tmp_path / "long"
    try:
        while process.poll() is None and len(list(folder.glob("rows/0*.jsonl"))) < 3:
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=20)
    finally:
        process.kill()
    assert process.returncode == 130
    assert err.splitlines()[-1] == "hull1620: interrupted; finished work is kept, --resume continues the study"
    assert "Traceback" not in err
    plan = read_plan(str(tmp_path / "long.toml"))
    early = {path: path.read_bytes() for path in folder.glob("rows/0*.jsonl")}
    assert 3 <= len(early) < len(list(plan.chunks()))
    run_study(plan, folder, workers=1, quiet=True, resume=True)
    run_study(plan, tmp_path / "whole", workers=1, quiet=True)
    assert all(path.read_bytes() == rows for path, rows in early.items())
    assert contents_without_plots(folder) == contents_without_plots(tmp_path / "whole")


def test_ctrl_c_during_the_start_of_a_worker_pool_raises_keyboard_interrupt(monkeypatch) -> None:
    """The pool's own thread has been made but not started, so the pool cannot wait for it."""

    def pressed(thread: threading.Thread) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(process_pool, "_ExecutorManagerThread", type("Begun", (threading.Thread,), {"start": pressed}))
    monkeypatch.setattr(
        process_pool._ExecutorManagerThread, "__init__", lambda one, pool: threading.Thread.__init__(one)
    )
    with pytest.raises(KeyboardInterrupt):
        list(in_processes(PLAN, list(PLAN.chunks()), 2))


def test_first_sample_is_finished_before_workers_start_if_no_compiled_code_exists(monkeypatch) -> None:
    monkeypatch.setattr(workers, "must_compile", lambda: True)
    monkeypatch.setattr(workers, "ProcessPoolExecutor", lambda *_, **__: pytest.fail("a worker starts"))
    chunk, rows = next(in_processes(PLAN, list(PLAN.chunks()), 2))
    assert (chunk, len(rows.splitlines())) == (Chunk(0, 0, 1), 1)


@pytest.mark.parametrize("quiet", [False, True])
def test_failed_compilation_is_reported(quiet: bool, monkeypatch, capsys) -> None:
    monkeypatch.setattr(run, "must_compile", lambda: True)
    monkeypatch.setattr(run, "why_plain", lambda _: "")
    monkeypatch.setenv("NUMBA_DISABLE_JIT", "1")  # compile_engine then raises NotInstalled
    with run._compiling(PLAN, quiet) as process:
        assert process
        assert process.wait(60)
    message = "the engine could not be compiled; the study used the interpreter\n"
    assert capsys.readouterr().err == ("" if quiet else message)


@pytest.mark.parametrize("has_code", [False, True])
def test_repetitions_are_compiled_only_if_they_must_be(has_code: bool, monkeypatch) -> None:
    monkeypatch.setattr(run, "must_compile", lambda: False)
    monkeypatch.setattr(run, "must_compile_repetitions", lambda: not has_code)
    route = Programs("corrected", measures=("alarms",))
    with run._compiling(replace(PLAN, cells=(replace(PLAN.cells[0], routes=(route,)),)), True) as process:
        assert (process is None) == has_code


@pytest.mark.parametrize("writes", [1, 9])
@pytest.mark.usefixtures("_without_plots")
def test_full_disk_gives_a_one_line_error_and_the_study_can_be_resumed(finished, tmp_path, monkeypatch, writes) -> None:
    folder, writes_left = tmp_path / "full", [writes]

    def fsync(_: int) -> None:
        writes_left[0] -= 1
        if writes_left[0] < 0:
            raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("emulator.files.os.fsync", fsync)
    with pytest.raises(StudyFileError, match="no space left on device") as full:
        run_study(PLAN, folder, workers=1, quiet=True)
    assert "\n" not in str(full.value)
    assert not list(folder.rglob(f"{UNFINISHED}*"))
    writes_left[0] = 10**6
    run_study(PLAN, folder, workers=1, quiet=True, resume=True)
    assert contents_without_plots(folder) == contents_without_plots(finished)


def test_study_can_be_resumed_after_the_index_filled_the_disk(finished: Path, tmp_path: Path, monkeypatch) -> None:
    folder = tmp_path / "index"
    original = Store.open.__func__

    def small(cls: type[Store], place: Path, plan: Plan) -> Store:
        store: Store = original(cls, place, plan)
        pages = store.database.execute("PRAGMA page_count").fetchone()[0]
        store.database.execute(f"PRAGMA max_page_count = {pages + 1}")
        return store

    monkeypatch.setattr(Store, "open", classmethod(small))
    with pytest.raises(StudyFileError, match="full"):
        run_study(PLAN, folder, workers=1, quiet=True)
    monkeypatch.undo()
    run_study(PLAN, folder, workers=1, quiet=True, resume=True)
    assert contents(folder) == contents(finished)


def test_study_is_not_overwritten_and_a_different_one_not_resumed(finished: Path, tmp_path: Path) -> None:
    before = contents(finished)
    with pytest.raises(PlanError, match="already holds a study; --resume"):
        run_study(PLAN, finished, workers=1, quiet=True)
    different = {
        "its seed is 5, not 7": replace(PLAN, seed=7),
        "it has 44 samples, not 45": replace(PLAN, cells=(replace(PLAN.cells[0], samples=25), PLAN.cells[1])),
        "the folder holds the study small, not other": replace(PLAN, name="other"),
        "its plan differs from that of this command": replace(
            PLAN, cells=(replace(PLAN.cells[0], chunk=6), PLAN.cells[1])
        ),
    }
    for message, plan in different.items():
        with pytest.raises(PlanError, match=message):
            run_study(plan, finished, workers=1, quiet=True, resume=True)
    assert contents(finished) == before
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "letter.txt").write_text("keep")
    for resume in (False, True):
        with pytest.raises(PlanError, match="not empty"):
            run_study(PLAN, tmp_path / "mine", workers=1, quiet=True, resume=resume)


def test_study_of_different_versions_or_programs_is_not_resumed(tmp_path: Path) -> None:
    folder = tmp_path / "old"
    plan = replace(PLAN, cells=(replace(PLAN.cells[0], samples=2),))
    run_study(plan, folder, workers=1, quiet=True)
    path = folder / "manifest.json"
    whole = json.loads(path.read_text())
    for change, message in (
        ({"plan": {}}, "the folder holds the study None"),
        ({"versions": {**whole["versions"], "numpy": "0.1"}}, "begun with numpy 0.1"),
        ({"programs_sha256": {}}, "the listings of the programs or their apparatus have changed"),
        ({"code_sha256": {}}, "the code of hull1620 has changed"),
    ):
        path.write_text(json.dumps({**whole, **change}))
        with pytest.raises(PlanError, match=message):
            run_study(plan, folder, workers=1, quiet=True, resume=True)
    for text in ("{}", "no json", "[]", '{"plan": 3, "versions": {}, "programs_sha256": {}}'):
        path.write_text(text)
        with pytest.raises(PlanError, match="expected the manifest of a study"):
            run_study(plan, folder, workers=1, quiet=True, resume=True)


def test_second_run_in_the_same_folder_fails(finished: Path) -> None:
    held = Store.open(finished, PLAN)
    try:
        with pytest.raises(StudyFileError, match="another run is using this folder"):
            run_study(PLAN, finished, workers=1, quiet=True, resume=True)
    finally:
        held.close()


def with_cell(**changes: Any) -> Plan:
    return replace(PLAN, cells=(replace(PLAN.cells[0], **changes),))


@pytest.mark.parametrize(
    ("plan", "message"),
    [
        (replace(PLAN, name="a/b"), "letters, digits"),
        (replace(PLAN, cells=()), "expected at least one cell"),
        (replace(PLAN, cells=(PLAN.cells[0], PLAN.cells[0])), "two cells have the key 'n=5'"),
        (with_cell(samples=0), "samples and chunk"),
        (with_cell(routes=()), "expected at least one route, found none"),
        (with_cell(routes=(ROUTES[0], ROUTES[0])), "two routes have the name"),
        (with_cell(reference="x"), "the reference 'x' is not one of its routes"),
        (with_cell(family="x"), "no family is called 'x'"),
        (Programs("r", arithmetic="roman"), "no arithmetic is called 'roman'"),
        (Programs("r", layers=("gold",)), "expected the name of a layer, found 'gold'"),
        (Programs("r", rows=("P9-001",)), "expected a row of the apparatus, found 'P9-001'"),
        (Programs("r", rows=("P3-029",)), "depend on other rows"),
        (Programs("r", layers=("epsilon",)), "an epsilon and the layer 'epsilon' must be given together"),
        (Programs("r", epsilon="1"), "an epsilon and the layer 'epsilon' must be given together"),
        (Programs("r", layers=("epsilon",), epsilon="one"), "epsilon: 'one' is not a decimal"),
        (Programs("r", layers=("corrected",)), "OVERLAP"),
        (Programs("r", limit=0), "limit 1 or more"),
        (Programs("r", measures=("beauty",)), "no measure is called 'beauty'"),
        (Programs("r", measures=("plane_table",)), "route r: the measure plane_table does not exist for the programs"),
        (Port("r", measures=("operations",)), "route r: the measure operations does not exist for the port"),
        (Port("r", measures=("plane_table",)), "route r: the measure plane_table needs history = true"),
        (Port("r", "roman"), "roman"),
        (Port("r", epsilon="-1"), "epsilon"),
    ],
)
def test_invalid_plan_is_rejected_before_anything_is_written(plan, message, tmp_path) -> None:
    with pytest.raises(EmulatorError, match=message) as rejection:
        run_study(plan if isinstance(plan, Plan) else with_cell(routes=(plan,)), tmp_path / "no", quiet=True)
    assert "\n" not in str(rejection.value)
    assert not (tmp_path / "no").exists()


def test_store_answers_the_queries_of_reports(finished: Path) -> None:
    store = Store.open(finished, PLAN)
    try:
        counts = store.counts("tags.kind", "outcome", cell=1, route="listed")
        assert sum(counts.values()) == 20
        assert all(kind == "slab" for kind, _ in counts)
        assert sum(store.counts("cell", "route").values()) == 2 * PLAN.samples
        assert next(iter(store.query("SELECT COUNT(*) FROM samples"))) == (PLAN.samples,)
        assert [row["index"] for row in store.rows()] == [*range(24), *range(20)]
        for invalid in ("rowid", "tags.a b", "tags.x') --"):
            with pytest.raises(ValueError, match=r"is not a tag|is not a column"):
                store.counts(invalid)
    finally:
        store.close()
