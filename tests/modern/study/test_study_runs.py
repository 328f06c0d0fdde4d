"""A study in its folder: the same rows whatever the workers, interruptions and failures."""

from __future__ import annotations

import errno
import json
import os
import random
import signal
import sqlite3
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import pytest

from emulator.files import UNFINISHED
from modern.study import Plan, PlanError, Port, Programs, run_study
from modern.study.index import NAME as INDEX
from modern.study.store import Store, StudyFileError
from tests.support.paths import ROOT
from tests.support.studied import PLAN, ROUTES

SCRIPT = """
import sys
from modern.study import run_study
from tests.support.studied import PLAN

if __name__ == "__main__":
    run_study(PLAN, sys.argv[1], workers=2, resume=True, quiet=True)
"""
WORKER = """
import multiprocessing
from concurrent.futures import ProcessPoolExecutor
from modern.study.workers import _begin_worker

pool = ProcessPoolExecutor(1, multiprocessing.get_context("spawn"), initializer=_begin_worker)
pool.submit(print, "at work", flush=True).result()
pool.submit(input).result()
"""


def contents(folder: Path) -> dict[str, bytes]:
    """All files but the index (whose bytes are sqlite's own business) and the manifest's command."""
    found = {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and not path.name.startswith(INDEX)
    }
    manifest = json.loads(found.pop("manifest.json"))
    manifest.pop("command")
    return {**found, "manifest.json": json.dumps(manifest).encode()}


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("study") / "small"
    run_study(PLAN, folder, workers=1, quiet=True)
    return folder


def start(folder: Path) -> subprocess.Popen[bytes]:
    """The study with two workers, in a process of its own."""
    script = folder.parent / "start.py"
    script.write_text(SCRIPT)
    paths = {**os.environ, "PYTHONPATH": str(ROOT)}
    with (folder.parent / "errors").open("ab") as errors:
        return subprocess.Popen([sys.executable, str(script), str(folder)], env=paths, cwd=folder.parent, stderr=errors)


def forked(folder: Path) -> int:
    """The study begun or resumed in a copy of this process; its number."""
    child = os.fork()
    if child:
        return child
    try:
        run_study(PLAN, folder, workers=1, quiet=True, resume=True)
        os._exit(0)
    finally:
        os._exit(1)


def test_rows_hold_what_they_are_to_hold(finished: Path) -> None:
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


def test_another_seed_gives_other_decks(finished: Path, tmp_path: Path) -> None:
    run_study(replace(PLAN, seed=6), tmp_path / "six", workers=1, quiet=True)
    name = "rows/0000-000000000.jsonl"
    assert contents(tmp_path / "six")[name] != contents(finished)[name]


def test_workers_end_with_the_process_that_began_them() -> None:
    """Killed, it can tell them nothing; the pipe they share closes when the last of them has gone."""
    command = [sys.executable, "-c", WORKER]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, env={**os.environ, "PYTHONPATH": str(ROOT)})
    assert process.stdout is not None
    assert process.stdout.readline() == b"at work\n"
    process.kill()
    process.communicate(timeout=30)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
def test_killed_at_ten_random_moments_it_resumes_to_the_same_files(finished: Path, tmp_path: Path) -> None:
    begun = time.monotonic()
    run_study(PLAN, tmp_path / "timed", workers=1, quiet=True)
    seconds = time.monotonic() - begun
    folder, rng = tmp_path / "killed", random.Random()
    for _ in range(10):
        child = forked(folder)
        time.sleep(rng.uniform(0, seconds / 3))
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
    assert os.waitpid(forked(folder), 0)[1] == 0
    assert contents(folder) == contents(finished)
    with sqlite3.connect(folder / INDEX) as index:
        assert index.execute("SELECT COUNT(*) FROM runs").fetchone() == (2 * PLAN.samples,)


def test_two_workers_stopped_by_ctrl_c_and_resumed_give_the_same_files(finished: Path, tmp_path: Path) -> None:
    folder = tmp_path / "two"
    process = start(folder)
    while process.poll() is None and not list(folder.glob("rows/*.jsonl")):
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)
    process.wait()
    assert "Broken" not in (tmp_path / "errors").read_text()
    assert start(folder).wait() == 0
    assert contents(folder) == contents(finished)


def test_what_is_stopped_between_file_and_index_is_counted_once(finished: Path, tmp_path: Path) -> None:
    """Interrupted after every chunk in turn, before the index has it."""
    folder = tmp_path / "between"
    chunks = list(PLAN.chunks())
    run_study(replace(PLAN), folder, workers=1, quiet=True, resume=True)
    for chunk in chunks[::3]:
        with sqlite3.connect(folder / INDEX) as index:
            index.execute("DELETE FROM chunks WHERE name = ?", (chunk.name,))
            index.execute(
                "DELETE FROM samples WHERE cell = ? AND place BETWEEN ? AND ?",
                (chunk.cell, chunk.start, chunk.stop - 1),
            )
            index.execute(
                "DELETE FROM runs WHERE cell = ? AND place BETWEEN ? AND ?", (chunk.cell, chunk.start, chunk.stop - 1)
            )
    (folder / "rows" / chunks[1].name).unlink()
    (folder / "rows" / f"{UNFINISHED}{chunks[1].name}").write_text("half a li")
    run_study(PLAN, folder, workers=1, quiet=True, resume=True)
    assert contents(folder) == contents(finished)


@pytest.mark.parametrize("damage", ["gone", "text", "cut", "zeros"])
def test_a_damaged_index_is_made_anew(finished: Path, tmp_path: Path, damage: str) -> None:
    folder = tmp_path / "damaged"
    run_study(PLAN, folder, workers=1, quiet=True)
    index = folder / INDEX
    whole = index.read_bytes()
    if damage == "gone":
        index.unlink()
    else:
        index.write_bytes(
            {"text": b"this is no database" * 99, "cut": whole[: len(whole) // 2], "zeros": bytes(len(whole))}[damage]
        )
    run_study(PLAN, folder, workers=1, quiet=True, resume=True)
    assert contents(folder) == contents(finished)


@pytest.mark.parametrize("writes", [1, 2, 5, 9, 12])
def test_a_full_disk_is_said_in_a_line_and_resumed_from(
    finished: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, writes: int
) -> None:
    folder, left = tmp_path / "full", [writes]

    def fsync(_: int) -> None:
        left[0] -= 1
        if left[0] < 0:
            raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("emulator.files.os.fsync", fsync)
    with pytest.raises(StudyFileError, match="no space left on device") as full:
        run_study(PLAN, folder, workers=1, quiet=True)
    assert "\n" not in str(full.value)
    assert not list(folder.rglob(f"{UNFINISHED}*"))
    left[0] = 10**6
    run_study(PLAN, folder, workers=1, quiet=True, resume=True)
    assert contents(folder) == contents(finished)


def test_a_full_disk_of_the_index_too(finished: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "index"
    original = Store.open.__func__  # type: ignore[attr-defined]

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


def test_a_study_is_not_overwritten_and_another_not_resumed(finished: Path, tmp_path: Path) -> None:
    before = contents(finished)
    with pytest.raises(PlanError, match="holds a study; --resume"):
        run_study(PLAN, finished, workers=1, quiet=True)
    others = {
        "its seed is 5, not 7": replace(PLAN, seed=7),
        "it has 44 samples, not 45": replace(PLAN, cells=(replace(PLAN.cells[0], samples=25), PLAN.cells[1])),
        "it is of the study small, not other": replace(PLAN, name="other"),
        "its plan is another": replace(PLAN, cells=(replace(PLAN.cells[0], chunk=6), PLAN.cells[1])),
    }
    for words, plan in others.items():
        with pytest.raises(PlanError, match=words):
            run_study(plan, finished, workers=1, quiet=True, resume=True)
    assert contents(finished) == before
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "letter.txt").write_text("keep")
    for resume in (False, True):
        with pytest.raises(PlanError, match="not empty"):
            run_study(PLAN, tmp_path / "mine", workers=1, quiet=True, resume=resume)


def test_another_version_or_program_is_not_resumed(tmp_path: Path) -> None:
    folder = tmp_path / "old"
    plan = replace(PLAN, cells=(replace(PLAN.cells[0], samples=2),))
    run_study(plan, folder, workers=1, quiet=True)
    path = folder / "manifest.json"
    whole = json.loads(path.read_text())
    for change, words in (
        ({"plan": {}}, "it is of the study None"),
        ({"versions": {**whole["versions"], "numpy": "0.1"}}, "begun with numpy 0.1"),
        ({"programs_sha256": {}}, "its programs are others"),
        ({"code_sha256": {}}, "hull1620's own code has changed"),
    ):
        path.write_text(json.dumps({**whole, **change}))
        with pytest.raises(PlanError, match=words):
            run_study(plan, folder, workers=1, quiet=True, resume=True)
    for text in ("{}", "no json", "[]", '{"plan": 3, "versions": {}, "programs_sha256": {}}'):
        path.write_text(text)
        with pytest.raises(PlanError, match="not a manifest of a study"):
            run_study(plan, folder, workers=1, quiet=True, resume=True)


def test_two_runs_in_one_folder_are_one_too_many(finished: Path) -> None:
    held = Store.open(finished, PLAN)
    try:
        with pytest.raises(StudyFileError, match="another run is at work"):
            run_study(PLAN, finished, workers=1, quiet=True, resume=True)
    finally:
        held.close()


@pytest.mark.parametrize(
    ("plan", "words"),
    [
        (replace(PLAN, name="a/b"), "letters, digits"),
        (replace(PLAN, cells=()), "no cells"),
        (replace(PLAN, cells=(PLAN.cells[0], PLAN.cells[0])), "two cells have the key 'n=5'"),
        (replace(PLAN, cells=(replace(PLAN.cells[0], samples=0),)), "samples and chunk"),
        (replace(PLAN, cells=(replace(PLAN.cells[0], routes=()),)), "no routes"),
        (replace(PLAN, cells=(replace(PLAN.cells[0], routes=(ROUTES[0], ROUTES[0])),)), "two routes have the name"),
        (replace(PLAN, cells=(replace(PLAN.cells[0], reference="x"),)), "no route is called 'x'"),
        (replace(PLAN, cells=(replace(PLAN.cells[0], family="x"),)), "no family is called 'x'"),
    ],
)
def test_a_plan_that_cannot_be_carried_out_is_refused_before_it_begins(plan: Plan, words: str, tmp_path: Path) -> None:
    with pytest.raises(PlanError, match=words):
        run_study(plan, tmp_path / "no", quiet=True)
    assert not (tmp_path / "no").exists()


@pytest.mark.parametrize(
    ("route", "words"),
    [
        (Programs("r", arithmetic="roman"), "no arithmetic is called 'roman'"),
        (Programs("r", layers=("gold",)), "layer 'gold'"),
        (Programs("r", rows=("P9-001",)), "no row 'P9-001'"),
        (Programs("r", rows=("P3-029",)), "do not stand without others"),
        (Programs("r", layers=("epsilon",)), "an epsilon needs the layer"),
        (Programs("r", epsilon="1"), "an epsilon needs the layer"),
        (Programs("r", layers=("epsilon",), epsilon="one"), "epsilon: 'one' is not a decimal"),
        (Programs("r", layers=("corrected",)), "OVERLAP"),
        (Programs("r", limit=0), "limit 1 or more"),
        (Programs("r", measures=("beauty",)), "no measure is called 'beauty'"),
        (Port("r", "roman"), "roman"),
        (Port("r", epsilon="-1"), "epsilon"),
    ],
)
def test_a_route_that_cannot_be_gone_is_refused_before_it_begins(
    route: Programs | Port, words: str, tmp_path: Path
) -> None:
    plan = replace(PLAN, cells=(replace(PLAN.cells[0], routes=(route,)),))
    with pytest.raises(Exception, match=words) as refused:
        run_study(plan, tmp_path / "no", quiet=True)
    assert "\n" not in str(refused.value)
    assert not (tmp_path / "no").exists()


def test_reading_the_store(finished: Path) -> None:
    store = Store.open(finished, PLAN)
    try:
        runs = list(store.runs(cell=1, route="listed"))
        assert [run.index for run in runs] == list(range(20))
        assert {run.tags["kind"] for run in runs} == {"slab"}
        counts = store.counts("tags.kind", "outcome", cell=1, route="listed")
        assert sum(counts.values()) == 20
        assert all(kind == "slab" for kind, _ in counts)
        assert sum(store.counts("cell", "route").values()) == 2 * PLAN.samples
        assert next(iter(store.query("SELECT COUNT(*) FROM samples"))) == (PLAN.samples,)
        assert [row["index"] for row in store.rows()] == [*range(24), *range(20)]
        for bad in ("rowid", "tags.a b", "tags.x') --"):
            with pytest.raises(ValueError, match=r"is not a tag|is not a column"):
                store.counts(bad)
    finally:
        store.close()


def test_a_row_file_that_is_none_of_the_plan_is_named(tmp_path: Path) -> None:
    plan = replace(PLAN, cells=(replace(PLAN.cells[0], samples=2),))
    run_study(plan, tmp_path / "s", workers=1, quiet=True)
    (tmp_path / "s/rows/0009-000000000.jsonl").write_text("{}\n")
    with pytest.raises(StudyFileError, match=r"0009-000000000.jsonl is not a chunk of this study"):
        run_study(plan, tmp_path / "s", workers=1, quiet=True, resume=True)


@pytest.mark.parametrize("damage", ["empty", "short", "cut", "noise", "other", "long", "list"])
def test_a_damaged_row_file_is_named_and_not_counted(finished: Path, tmp_path: Path, damage: str) -> None:
    folder = tmp_path / "damaged"
    run_study(PLAN, folder, workers=1, quiet=True)
    path = folder / "rows/0000-000000005.jsonl"
    whole = path.read_bytes()
    lines = whole.splitlines(keepends=True)
    path.write_bytes(
        {
            "empty": b"",
            "short": b"".join(lines[:-1]),
            "cut": whole[:-9],
            "noise": b"\xff\x00" * 400,
            "other": (folder / "rows/0000-000000010.jsonl").read_bytes(),
            "long": whole + lines[0],
            "list": b"[1]\n" * 5,
        }[damage]
    )
    for index in folder.glob(f"{INDEX}*"):
        index.unlink()
    with pytest.raises(StudyFileError, match=r"0000-000000005.jsonl: line \d is damaged") as refused:
        run_study(PLAN, folder, workers=1, quiet=True, resume=True)
    assert "\n" not in str(refused.value)
    path.unlink()
    run_study(PLAN, folder, workers=1, quiet=True, resume=True)
    assert contents(folder) == contents(finished)
