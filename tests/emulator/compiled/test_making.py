"""While another process compiles the engine the plain one runs, and the results are the same."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from emulator.compiled import batch, making
from emulator.compiled.batch import run_batch
from emulator.compiled.runner import run_decks
from emulator.jit.functions import NotInstalled
from emulator.language.cards import Deck, deck_from_lines
from emulator.machine.machine import Machine
from emulator.machine.result import Options, Result
from tests.support.deckwork import program

LINES = ["READ 1,I", "2 I=I-1", "IF (I) 3,3,2", "3 PUNCH 1,I", "1 FORMAT(I4)", "END"]
DECKS = [deck_from_lines("deck", [f"{number:4d}"]) for number in (3, 900, 5, 7, 800, 2)]


def until(moment: int, file: Path) -> Iterator[Deck]:
    """The decks; with one of them the engine is made."""
    for place, deck in enumerate(DECKS):
        if place == moment:
            file.unlink()
        yield deck


@pytest.fixture
def plainly(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The decks that the plain engine finishes in the meantime."""
    done: list[str] = []

    class Noted(Machine):
        def run(self, *given: Any, **named: Any) -> Result:
            result = super().run(*given, **named)
            if result.ending.kind != "limit":
                done.append(self.deck.cards[0].text.strip())
            return result

    monkeypatch.setattr(batch, "Machine", Noted)
    return done


def test_the_plain_engine_runs_until_the_other_is_made(tmp_path: Path, plainly: list[str]) -> None:
    pytest.importorskip("numba")
    expected = tuple(Machine(program(*LINES), deck).run() for deck in DECKS)
    for moment in range(len(DECKS) + 1):
        file = tmp_path / "compiling"
        file.touch()
        plainly.clear()
        assert run_batch(program(*LINES), until(moment, file), compiling=file) == expected
        # The deck whose coming ends it is asked for while the file is there.
        assert plainly == [deck.cards[0].text.strip() for deck in DECKS[: moment + 1]]
        assert run_batch(program(*LINES), DECKS, compiling=tmp_path / "none") == expected
        assert len(plainly) == min(moment + 1, len(DECKS))


def test_a_long_run_waits_for_the_engine(tmp_path: Path, plainly: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """What would take minutes is not begun in earnest; where the limit is as short, its end is the run's."""
    pytest.importorskip("numba")
    file = tmp_path / "compiling"
    file.touch()
    expected = tuple(Machine(program(*LINES), deck).run() for deck in DECKS)
    monkeypatch.setattr(batch, "SHORT", 100)
    monkeypatch.setattr(batch, "sleep", lambda _: file.unlink())
    assert run_batch(program(*LINES), DECKS, compiling=file) == expected
    assert plainly == ["3"]
    file.touch()
    options = Options(limit=50)
    ends = run_batch(program(*LINES), DECKS, options, compiling=file)
    assert ends == tuple(Machine(program(*LINES), deck, options).run() for deck in DECKS)
    assert file.exists()


class Code:
    keeps, kept = True, False


def gone(file: Path) -> bool:
    for _ in range(1000):
        if not file.exists():
            return True
        time.sleep(0.02)
    return False


def test_the_file_is_there_while_the_process_works(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(making, "run_decks", Code)
    go = tmp_path / "go"
    monkeypatch.setattr(making, "_COMMAND", f"import os, time\nwhile not os.path.exists({str(go)!r}): time.sleep(0.01)")
    with making.being_made() as file:
        assert file is not None
        assert file.exists()
        go.touch()
        assert gone(file)
    monkeypatch.setattr(making, "_COMMAND", "raise SystemExit(1)")
    with making.being_made() as file:
        assert file is not None
        assert gone(file)
    go.unlink()
    monkeypatch.setattr(making, "_COMMAND", f"import os, time\nwhile not os.path.exists({str(go)!r}): time.sleep(0.01)")
    with making.being_made() as file:
        assert file is not None
    assert not file.exists()
    go.touch()


def test_nothing_is_waited_for_where_nothing_can_be_made(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing() -> None:
        raise NotInstalled("compiled code needs numba")

    class Kept(Code):
        kept = True

    class Homeless(Code):
        keeps = False

    for found in (missing, Kept, Homeless):
        monkeypatch.setattr(making, "run_decks", found)
        with making.being_made() as file:
            assert file is None
    monkeypatch.setattr(making, "run_decks", Code)
    monkeypatch.setattr(sys, "executable", "/nowhere/python")
    with making.being_made() as file:
        assert file is None


def test_what_is_made_is_kept() -> None:
    pytest.importorskip("numba")
    making.make()
    assert run_decks().keeps
    assert run_decks().kept
