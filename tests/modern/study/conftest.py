"""A small finished study, shared by the tests of its folder."""

import shutil
from pathlib import Path

import pytest

from modern.study import run as study_run
from modern.study import run_study
from tests.support.studied import PLAN


@pytest.fixture(scope="session")
def finished(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("study") / "small"
    run_study(PLAN, folder, workers=1, quiet=True)
    return folder


@pytest.fixture
def copied(finished: Path, tmp_path: Path) -> Path:
    """A copy of the finished study, to be damaged."""
    return Path(shutil.copytree(finished, tmp_path / "copied"))


@pytest.fixture
def _without_plots(monkeypatch) -> None:
    """Charts are drawn after the rows are complete, and take longer than they do."""
    monkeypatch.setattr(study_run, "draw", lambda chart, folder: None)
