"""Tests of this folder run in an empty folder and read volumes in forks of one process that has loaded SimpleITK."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from modern.digital import itk
from tests.support.itk_forks import Run, fork_server, fork_server_is_possible


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)


@pytest.fixture(scope="package")
def server() -> Iterator[Run | None]:
    if not fork_server_is_possible():
        yield None
        return
    with fork_server() as run:
        yield run


@pytest.fixture(autouse=True)
def _forks(server: Run | None, monkeypatch) -> None:
    if server is not None:
        monkeypatch.setattr(itk, "_run", server)
