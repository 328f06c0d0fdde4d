"""A study on a dask.distributed cluster writes the same files, even if a worker is killed."""

import os
import signal
import threading
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from modern.study import Plan, PlanError, run_study
from modern.study import workers as study_workers
from tests.support.studied import PLAN, contents

distributed = pytest.importorskip("distributed")
pytestmark = [pytest.mark.filterwarnings("ignore")]


@pytest.fixture(scope="module")
def cluster() -> Iterator[Any]:
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, silence_logs=50
    ) as local_cluster:
        yield local_cluster


def killing(plan: Plan, folder: Path, cluster: Any) -> list[int]:
    """Run the study, kill a worker as soon as the first rows exist, and return the killed process numbers."""
    killed: list[int] = []

    def kill() -> None:
        while not list(folder.glob("rows/0*.jsonl")) and not over.is_set():
            time.sleep(0.01)
        finished = len(list(folder.glob("rows/0*.jsonl")))
        if finished < len(list(plan.chunks())):
            worker = next(iter(cluster.workers.values()))
            killed.append(worker.pid)
            os.kill(worker.pid, signal.SIGKILL)

    over = threading.Event()
    thread = threading.Thread(target=kill)
    thread.start()
    try:
        run_study(plan, folder, dask=cluster.scheduler_address, quiet=True)
    finally:
        over.set()
        thread.join()
    return killed


def test_killed_worker_does_not_change_the_files(cluster: Any, finished: Path, tmp_path: Path) -> None:
    assert killing(PLAN, tmp_path / "dask", cluster)
    assert contents(tmp_path / "dask") == contents(finished)


def test_worker_with_different_versions_is_rejected(cluster: Any, tmp_path: Path, monkeypatch) -> None:
    own = study_workers.versions()
    monkeypatch.setattr(study_workers, "versions", lambda: {**own, "numpy": "0.1"})
    with pytest.raises(PlanError, match=rf"a worker has numpy {own['numpy']}, this process 0.1"):
        run_study(PLAN, tmp_path / "old", dask=cluster.scheduler_address, quiet=True)


def test_worker_without_hull1620_is_rejected(cluster: Any, tmp_path: Path, monkeypatch) -> None:
    def missing() -> None:
        raise ModuleNotFoundError("No module named 'modern'")

    monkeypatch.setattr(study_workers, "_loaded", missing)
    with pytest.raises(PlanError, match=r"a worker cannot load hull1620: .*No module named 'modern'") as rejection:
        run_study(PLAN, tmp_path / "none", dask=cluster.scheduler_address, quiet=True)
    assert "\n" not in str(rejection.value)


@pytest.mark.parametrize("address", ["nonsense", "tcp://127.0.0.1:1"])
def test_address_without_a_cluster_is_rejected(address: str, tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setattr(study_workers, "TIMEOUT", 1)
    with pytest.raises(PlanError) as rejection:
        run_study(PLAN, tmp_path / "no", dask=address, quiet=True)
    assert str(rejection.value).startswith(f"--dask {address}: ")
    assert "\n" not in str(rejection.value)
    assert not (tmp_path / "no").exists()


def test_lost_cluster_gives_a_one_line_error(cluster: Any, tmp_path: Path) -> None:
    """The rows are kept, so that the study can be continued elsewhere.  This test closes the cluster of the module."""
    folder = tmp_path / "gone"

    def close() -> None:
        while not list(folder.glob("rows/0*.jsonl")):
            time.sleep(0.01)
        cluster.close()

    thread = threading.Thread(target=close)
    thread.start()
    plan = replace(PLAN, cells=tuple(replace(cell, samples=4_000) for cell in PLAN.cells))
    with pytest.raises(PlanError, match=r"--dask: .*--resume continues the study") as lost:
        run_study(plan, folder, dask=cluster.scheduler_address, quiet=True)
    thread.join()
    assert "\n" not in str(lost.value)
