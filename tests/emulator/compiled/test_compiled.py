"""The compiled engine: conditions for its use, messages, and the cache of machine code."""

import importlib.util
import io
import json
import linecache
import os
import subprocess
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from emulator.compiled import deck as compiled_deck
from emulator.compiled import devices, runner
from emulator.compiled.batch import run_batch
from emulator.jit.functions import Compiled, NotInstalled, called, digest
from emulator.language.cards import deck_from_lines
from emulator.machine.machine import Machine
from emulator.machine.result import Options
from emulator.numbers import numbers
from emulator.numbers.arithmetic import profile
from tests.support.deckwork import program

LINES = ["READ 1,I", "I=I+1", "PUNCH 1,I", "1 FORMAT(I4)", "END"]
DECK = deck_from_lines("deck", ["  41"])


def test_ten_digits_run_in_the_interpreter() -> None:
    """A product of eighteen digits fits into 64 bits, one of twenty does not."""
    notes: list[str] = []
    options = Options(numbers=numbers("truncating:10"))
    (result,) = run_batch(program(*LINES), [DECK], options, notes.append)
    assert result.punched == ("  42",)
    assert notes == [
        "truncating:10 has 10 digits; the compiled engine supports at most 9: using the interpreter instead"
    ]


def test_without_numba_the_interpreter_runs(monkeypatch) -> None:
    monkeypatch.setitem(sys.modules, "numba", None)
    monkeypatch.setattr(runner, "run_decks", runner.run_decks.__wrapped__)
    notes: list[str] = []
    (result,) = run_batch(program(*LINES), [DECK], None, notes.append)
    assert result == Machine(program(*LINES), DECK).run()
    (note,) = notes
    assert note.startswith("compiled code needs numba: pip install 'hull1620[fast]' (")
    assert note.endswith(": using the interpreter instead")


def note_without_engine(monkeypatch) -> str:
    """Return the note if numba cannot be used, after checking the result."""
    monkeypatch.setattr(runner, "run_decks", runner.run_decks.__wrapped__)
    notes: list[str] = []
    (result,) = run_batch(program(*LINES), [DECK], None, notes.append)
    assert result == Machine(program(*LINES), DECK).run()
    (note,) = notes
    assert note.endswith(": using the interpreter instead")
    assert "\n" not in note
    return note


def test_a_disabled_numba_is_reported(monkeypatch) -> None:
    """With NUMBA_DISABLE_JIT, Python would compute with NumPy's eight-bit codes, whose sums overflow."""
    numba = pytest.importorskip("numba")
    monkeypatch.setattr(numba.config, "DISABLE_JIT", 1)
    assert "NUMBA_DISABLE_JIT turns compiled code off" in note_without_engine(monkeypatch)


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        (Options(numbers=numbers("float64")), "does not support float64 arithmetic"),
        (Options(uncut=True), "does not support --uncut"),
    ],
)
def test_unsupported_options_are_reported(options: Options, reason: str) -> None:
    notes: list[str] = []
    (result,) = run_batch(program(*LINES), [DECK], options, notes.append)
    assert result == Machine(program(*LINES), DECK, options).run()
    assert notes == [f"the compiled engine {reason}: using the interpreter instead"]


def test_a_single_run_does_not_import_numba() -> None:
    """Importing numba takes a third of a second."""
    code = (
        "import sys\nfrom hull1620 import Machine, compile_deck, deck_from_lines\n"
        f"lines = {LINES!r}\n"
        "Machine(compile_deck(deck_from_lines('p', lines)), deck_from_lines('d', ['  41'])).run()\n"
        "sys.exit('numba' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


SUM = "def twice(x):\n    return 2 * x\n\n\ndef entry(x):\n    return twice(x) + 1\n"


@pytest.fixture
def cache_folder(tmp_path: Path, monkeypatch) -> Path:
    """The folder of numba's cache."""
    pytest.importorskip("numba")
    monkeypatch.setattr("numba.core.config.CACHE_DIR", str(tmp_path / "cache_folder"))
    return tmp_path / "cache_folder"


def imported(folder: Path, source: str = SUM) -> Compiled:
    """Import ``entry`` of a new module with the given source."""
    path = folder / "entered.py"
    path.write_text(source)
    linecache.clearcache()
    spec = importlib.util.spec_from_file_location("entered", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["entered"] = module
    # Two versions of the source may have the same length and the same second of modification.
    exec(compile(source, str(path), "exec"), vars(module))
    return Compiled(module.entry)


def from_cache(code: Compiled) -> int:
    return sum(code.function.stats.cache_hits.values())


def test_code_is_kept_until_its_source_changes(tmp_path: Path, cache_folder: Path) -> None:
    """The source of a called function, a constant or an option counts too, which numba itself does not check."""
    for source, expected in ((SUM, 11), (SUM.replace("2 * x", "3 * x"), 16)):
        first = imported(tmp_path, source)
        assert first.ready(5)(5) == expected
        assert from_cache(first) == 0
        second = imported(tmp_path, source)
        assert second.ready(5)(5) == expected
        assert from_cache(second) == 1
    assert [path.parent.parent for path in cache_folder.rglob("*.nbi")] == [cache_folder, cache_folder]
    entry = sys.modules["entered"].entry
    assert digest(entry, "") != digest(entry, "other")
    assert called(entry) == [entry, sys.modules["entered"].twice]


def test_code_depends_on_constants_of_other_modules(tmp_path: Path, cache_folder: Path) -> None:
    for number in (2, 3):
        sys.modules["factors"] = ModuleType("factors")
        vars(sys.modules["factors"])["FACTOR"] = number
        code = imported(tmp_path, "from factors import FACTOR\n\n\ndef entry(x):\n    return FACTOR * x\n")
        assert code.ready(5)(5) == 5 * number
        assert from_cache(code) == 0
    del sys.modules["factors"]


@pytest.mark.parametrize("pattern", ["*.nbi", "*.nbc"])
def test_damaged_code_is_compiled_again(tmp_path: Path, cache_folder: Path, pattern: str) -> None:
    imported(tmp_path).ready(5)
    (file,) = cache_folder.rglob(pattern)
    file.write_bytes(b"")
    damaged = imported(tmp_path)
    assert damaged.ready(5)(5) == 11
    assert damaged.function.stats.cache_path is None
    assert imported(tmp_path).ready(5)(5) == 11
    after = imported(tmp_path)
    assert after.ready(5)(5) == 11
    assert from_cache(after) == 1


def test_without_a_cache_folder_code_is_compiled_for_this_process(tmp_path, cache_folder, monkeypatch) -> None:
    def refuse(*given: object, **named: object) -> None:
        raise PermissionError("no place here")

    monkeypatch.setattr("tempfile.TemporaryFile", refuse)
    code = imported(tmp_path)
    assert code.ready(5)(5) == 11
    assert code.function.stats.cache_path is None


def test_an_error_of_numba_is_reported_in_one_line(tmp_path: Path, cache_folder: Path) -> None:
    code = imported(tmp_path, "def entry(x):\n    return open(x)\n")
    with pytest.raises(NotInstalled, match=r"^numba cannot compile the code: TypingError: [^\n]*$"):
        code.ready(5)


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_compiling_is_reported_on_a_terminal_but_loading_is_not(tmp_path, cache_folder, monkeypatch) -> None:
    for file, written in ((Terminal(), True), (Terminal(), False), (io.StringIO(), False)):
        monkeypatch.setattr(sys, "stderr", file)
        imported(tmp_path).ready(5)
        line, _, wiped = file.getvalue().partition("\r")
        assert bool(line) == written
        assert (line, wiped) in (
            ("", ""),
            ("compiling entry; this takes some seconds, but only once", " " * len(line) + "\r"),
        )


SCRIPT = """
import json, sys
from emulator.compiled.batch import run_batch
from emulator.language.cards import deck_from_lines
from emulator.compiled.runner import run_decks
from emulator.language.compiler import compile_deck
program = compile_deck(deck_from_lines("p", json.loads(sys.argv[1])))
run_batch(program, [deck_from_lines("d", ["  41"])])
stats = run_decks().function.stats
print(json.dumps([sum(stats.cache_hits.values()), sum(stats.cache_misses.values())]))
"""


def test_another_process_uses_the_cache() -> None:
    pytest.importorskip("numba")
    run_batch(program(*LINES), [DECK])
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, json.dumps(LINES)], capture_output=True, text=True, check=True, env=os.environ
    )
    hits, misses = json.loads(done.stdout)
    assert hits == 1
    assert misses == 0


def lists(of: Any) -> Any:
    """Return the arrays of a tuple and of its parts as lists of Python integers."""
    if isinstance(of, int):
        return of
    return type(of)(*map(lists, of)) if isinstance(of, tuple) else of.tolist()


@settings(max_examples=10)
@given(st.integers(-9999, 9998), st.sampled_from(["truncating", "ibm1962", "rounding:9"]))
def test_the_engine_runs_as_python_on_lists(number: int, name: str) -> None:
    """The compiled source is ordinary Python."""
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
    done = compiled_deck.run_decks(
        lists(runner.code),
        lists(runner.forms),
        lists(runner.start),
        devices.Cards(list(columns), [0, 1]),
        lists(runner.core),
        lists(runner.tools),
        report,
        profile(name).rules,
        runner.setting,
    )
    assert done == 1
    log = bytes(report.log[: report.ends[0][devices.LOG_TO]]).decode()
    result = Machine(made, deck, options).run()
    assert [line[1:] for line in log.splitlines() if line[0] == "P"] == list(result.punched)
