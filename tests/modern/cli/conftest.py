"""A folder in which the tests run commands."""

from pathlib import Path

import pytest

from tests.support.commands import DECK, PROGRAM


@pytest.fixture
def room(tmp_path: Path, monkeypatch) -> Path:
    """Change to a folder that holds only a valid deck and a valid program."""
    monkeypatch.chdir(tmp_path)
    Path("good.deck").write_text(DECK, encoding="utf-8")
    Path("good.f").write_text(PROGRAM, encoding="utf-8")
    Path("x.deck").write_text("2.\n3.\n", encoding="utf-8")
    return tmp_path
