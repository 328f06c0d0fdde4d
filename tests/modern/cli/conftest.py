"""A folder for the command line to be tried in."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.commands import DECK, PROGRAM


@pytest.fixture
def room(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder to be in, with one good deck and one good program."""
    monkeypatch.chdir(tmp_path)
    Path("good.deck").write_text(DECK, encoding="utf-8")
    Path("good.f").write_text(PROGRAM, encoding="utf-8")
    Path("x.deck").write_text("2.\n3.\n", encoding="utf-8")
    return tmp_path
