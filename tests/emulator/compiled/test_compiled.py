"""The compiled engine: when it is used, what is said when it is not, and that its code is kept."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from emulator.compiled import deck as unattended
from emulator.compiled import engine as compiled
from emulator.compiled import jit as compiling
from emulator.compiled import runner
from emulator.compiled.batch import run_batch
from emulator.language.cards import deck_from_lines
from emulator.machine.machine import Machine
from emulator.machine.result import Options
from emulator.numbers import numbers
from emulator.numbers.arithmetic import profile
from tests.support.deckwork import program

LINES = ["READ 1,I", "I=I+1", "PUNCH 1,I", "1 FORMAT(I4)", "END"]
DECK = deck_from_lines("deck", ["  41"])


def test_ten_digits_are_too_many() -> None:
    """Eighteen digits of a product fit into 64 bits, twenty do not; the plain engine runs, and one line says so."""
    notes: list[str] = []
    options = Options(numbers=numbers("truncating:10"))
    (result,) = run_batch(program(*LINES), [DECK], options, notes.append)
    assert result.punched == ("  42",)
    assert notes == ["truncating:10 has 10 digits, the compiled engine has at most 9: the plain engine runs instead"]


def test_without_numba(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "numba", None)
    monkeypatch.setattr(compiled, "run_decks", compiled.run_decks.__wrapped__)
    notes: list[str] = []
    (result,) = run_batch(program(*LINES), [DECK], None, notes.append)
    assert result == Machine(program(*LINES), DECK).run()
    (note,) = notes
    assert note.startswith("compiled code needs numba (extra fast): ")
    assert note.endswith(": the plain engine runs instead")


def said_instead(monkeypatch: pytest.MonkeyPatch) -> str:
    """What is said where numba does not do; the result is the plain engine's."""
    anew = compiled.run_decks.__wrapped__
    for module in (compiled, runner):
        monkeypatch.setattr(module, "run_decks", anew)
    notes: list[str] = []
    (result,) = run_batch(program(*LINES), [DECK], None, notes.append)
    assert result == Machine(program(*LINES), DECK).run()
    (note,) = notes
    assert note.endswith(": the plain engine runs instead")
    assert "\n" not in note
    return note


def test_a_numba_that_does_not_compile(monkeypatch: pytest.MonkeyPatch) -> None:
    """NUMBA_DISABLE_JIT leaves Python over numpy's eight-bit codes, whose sums overflow: wrong numbers."""
    numba = pytest.importorskip("numba")
    monkeypatch.setattr(numba.config, "DISABLE_JIT", 1)
    assert "turned off by NUMBA_DISABLE_JIT" in said_instead(monkeypatch)


def test_a_numba_that_does_not_know_an_option(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("numba")
    make = compiling.compiled
    monkeypatch.setattr(compiled, "compiled", lambda *given, **options: make(*given, **options, unheard_of=1))
    assert "numba cannot make the compiled code: KeyError: " in said_instead(monkeypatch)


def test_kept_code_that_is_damaged(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It comes to light as the program is put in core, before a deck is begun."""
    pytest.importorskip("numba")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr("numba.core.config.CACHE_DIR", "")
    kernel: Any = compiled.run_decks.__wrapped__()
    kernel._cache.flush()
    (index,) = tmp_path.rglob("*.nbi")
    index.write_bytes(b"")
    assert "numba cannot make the compiled code: EOFError: " in said_instead(monkeypatch)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (Options(numbers=numbers("float64")), "has no float64 numbers"),
        (Options(uncut=True), "keeps no numbers beside the cards"),
    ],
)
def test_numbers_of_python_are_not_for_it(options: Options, words: str) -> None:
    notes: list[str] = []
    (result,) = run_batch(program(*LINES), [DECK], options, notes.append)
    assert result == Machine(program(*LINES), DECK, options).run()
    assert notes == [f"the compiled engine {words}: the plain engine runs instead"]


def test_with_numba_nothing_is_said() -> None:
    pytest.importorskip("numba")
    notes: list[str] = []
    assert run_batch(program(*LINES), [DECK], None, notes.append)[0].punched == ("  42",)
    assert notes == []


def test_nothing_of_it_is_imported_for_a_plain_run() -> None:
    """numba costs a third of a second: who runs one deck does not wait for it."""
    code = (
        "import sys\nfrom emulator import Machine, compile_deck, deck_from_lines\n"
        f"lines = {LINES!r}\n"
        "Machine(compile_deck(deck_from_lines('p', lines)), deck_from_lines('d', ['  41'])).run()\n"
        "sys.exit('numba' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_the_code_is_kept_in_the_users_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    folder = compiling.cache_folder("", [compiled.why_plain])
    assert folder is not None
    assert folder.parent == tmp_path / "hull1620"
    assert compiling.cache_folder("", [compiled.why_plain]) == folder
    assert compiling.cache_folder("", [compiled.run_decks]) != folder
    assert compiling.cache_folder("", [compiled.why_plain], "other options") != folder
    assert compiling.cache_folder(str(tmp_path / "given"), [compiled.why_plain]) == tmp_path / "given" / folder.name


def test_a_cache_that_cannot_be_written_is_none(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    assert compiling.cache_folder(str(tmp_path / "file"), [compiled.why_plain]) is None


SCRIPT = """
import json, sys
from emulator.compiled.batch import run_batch
from emulator.language.cards import deck_from_lines
from emulator.compiled.engine import run_decks
from emulator.language.compiler import compile_deck
program = compile_deck(deck_from_lines("p", json.loads(sys.argv[1])))
run_batch(program, [deck_from_lines("d", ["  41"])])
stats = run_decks().stats
print(json.dumps([sum(stats.cache_hits.values()), sum(stats.cache_misses.values())]))
"""


def test_another_process_need_not_compile() -> None:
    """The suite's own cache: what this process compiled, or found there, the next one finds."""
    pytest.importorskip("numba")
    run_batch(program(*LINES), [DECK])
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, json.dumps(LINES)], capture_output=True, text=True, check=True, env=os.environ
    )
    hits, misses = json.loads(done.stdout)
    assert hits == 1
    assert misses == 0


def lists(of: Any) -> Any:
    """The arrays of a tuple as lists of Python's own integers."""
    return type(of)(*(lists(value) if isinstance(value, tuple) else value.tolist() for value in of))


@settings(max_examples=10)
@given(st.integers(-9999, 9998), st.sampled_from(["truncating", "ibm1962", "rounding:9"]))
def test_the_same_functions_run_as_python(number: int, name: str) -> None:
    """What numba compiles is no other source: it runs as it stands over lists."""
    pytest.importorskip("numba")
    from emulator.compiled.runner import Runner, packed

    options = Options(numbers=numbers(name))
    lines = ["READ 1,I", "A=I", "A=SQRT(A*A+1.)/3.", "PUNCH 2,I,A", "1 FORMAT(I5)", "2 FORMAT(I5,E14.8)", "END"]
    deck = deck_from_lines("deck", [f"{number:5d}"])
    made = program(*lines)
    runner = Runner(made, options)
    columns = packed(deck)
    assert columns is not None
    report = lists(runner.report)
    done = unattended.run_decks(
        lists(runner.code),
        lists(runner.forms),
        lists(runner.start),
        unattended.Cards(list(columns), [0, 1]),
        lists(runner.core),
        report,
        profile(name).rules,
        runner.setting,
    )
    assert done == 1
    log = bytes(report.log[: report.ends[0][unattended.LOG_TO]]).decode()
    result = Machine(made, deck, options).run()
    assert [line[1:] for line in log.splitlines() if line[0] == "P"] == list(result.punched)
