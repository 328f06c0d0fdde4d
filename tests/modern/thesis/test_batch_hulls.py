"""The hull programs in batches: the compiled engine and the interpreter have the same results, card for card.

A larger run: ``HULL1620_SETS=3000 pytest tests/modern/thesis/test_batch_hulls.py``.
"""

import os
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import pytest

from emulator.compiled.batch import run_batch
from emulator.compiled.runner import BLOCK, Runner, packed
from emulator.errors import EmulatorError
from emulator.language.cards import Deck, deck_from_lines, read_deck
from emulator.language.compiler import compile_deck
from emulator.language.objectcode import Program
from emulator.machine.machine import Machine
from emulator.machine.result import Options, Result
from emulator.numbers import numbers
from modern.edition import chapter6, programs
from modern.edition.grounds import ground_deck
from modern.thesis.job import COPLANAR, NOT_COPLANAR
from tests.support.judged import deck_of, sets
from tests.support.paths import MACHINE_RUNS

pytest.importorskip("numba")

COUNT = int(os.environ.get("HULL1620_SETS", "60"))
RUNS = MACHINE_RUNS
LAYERS = [(), ("corrected",), ("epsilon",), ("translation",), ("epsilon", "corrected"), ("translation", "corrected")]
SETTINGS = [
    Options(core=60_000, limit=60_000),
    Options(core=60_000, limit=60_000, bounds="core"),
    Options(core=60_000, limit=2_500, switches=frozenset({1})),
    Options(core=60_000, limit=60_000, numbers=numbers("ibm1962")),
    Options(core=60_000, limit=60_000, numbers=numbers("rounding:9")),
    Options(core=60_000, limit=60_000, numbers=numbers("truncating:4")),
]


def both(program: Program, data: Sequence[Deck], options: Options) -> list[Result | str]:
    """Return results or error messages, after checking that both engines have the same ones."""
    plain: list[Result | str] = []
    for deck in data:
        try:
            plain.append(Machine(program, deck, options).run())
        except EmulatorError as error:
            plain.append(str(error))
    ran = [deck for deck, result in zip(data, plain, strict=True) if isinstance(result, Result)]
    found = iter(run_batch(program, ran, options))
    for deck, result in zip(data, plain, strict=True):
        if isinstance(result, Result):
            assert next(found) == result, deck.text()
        else:
            with pytest.raises(EmulatorError) as caught:
                run_batch(program, [deck], options)
            assert str(caught.value) == result
    return plain


def chain(data: Sequence[Deck], layers: tuple[str, ...], options: Options, first: str = "program1") -> Counter[str]:
    """Run decks through program 1 and the next program with both engines, and count the endings."""
    results = both(programs.with_layers(first, layers), data, options)
    endings = Counter(r.ending.kind if isinstance(r, Result) else "error" for r in results)
    for name, words in (("program2", COPLANAR), ("program3", NOT_COPLANAR)):
        middle = [deck_from_lines("middle", r.punched) for r in results if isinstance(r, Result) and words in r.typed]
        after = both(programs.with_layers(name, layers), middle, options)
        endings.update(r.ending.kind if isinstance(r, Result) else "error" for r in after)
    return endings


def test_both_engines_agree_on_the_examples_and_the_decks_of_the_machine_runs() -> None:
    for first in ("program1", "program1_examples"):
        chain([chapter6.input_deck(n) for n in range(1, 7)], (), Options(), first)
    data = [read_deck(str(folder / "deck.cards")) for folder in sorted(RUNS.iterdir()) if folder.is_dir()]
    for layers in ((), ("corrected",)):
        chain(data, layers, SETTINGS[0])


@pytest.mark.parametrize("layers", LAYERS, ids="+".join)
def test_both_engines_agree_on_sets_of_all_families(layers: tuple[str, ...]) -> None:
    e = ".01" if "epsilon" in layers else ""
    data = [deck_of(points, e) for _, points in sets(COUNT // len(LAYERS), 1963 + LAYERS.index(layers))]
    chain(data, layers, SETTINGS[0])


@pytest.mark.parametrize("setting", range(len(SETTINGS)))
def test_both_engines_agree_under_other_options(setting: int) -> None:
    data = [deck_of(points) for _, points in sets(COUNT // len(SETTINGS), 620 + setting)]
    chain(data, (), SETTINGS[setting])


def test_the_compared_runs_end_in_different_ways() -> None:
    """A comparison of normal runs alone would prove little."""
    data = [deck_of(points) for _, points in sets(20, 5)]
    endings = chain(data, (), SETTINGS[0]) + chain(data, (), SETTINGS[2])
    assert endings["hopper"] > 20
    assert endings["limit"] > 0


def test_both_engines_report_the_overflow_of_the_plane_table() -> None:
    """KNOWN-FAULTS 5: the message of both engines names the array."""
    table = ground_deck("table")
    assert table is not None
    middle = deck_from_lines("middle", Machine(programs.program("program1"), table).run().punched)
    program = compile_deck(programs.built("program3", ("corrected",), {"P3-028"}))
    options = Options(limit=800_000)
    (result,) = both(program, [middle], options)
    assert isinstance(result, Result)
    assert "MM(99) is outside its DIMENSION MM(98)" in result.ending.message
    assert None not in list(Runner(program, options).runs([packed(middle)]))
    both(program, [middle], replace(options, bounds="core", limit=100_000))


def test_both_engines_report_bad_cards_in_a_batch() -> None:
    """The decks have blank fields, letters or too few cards."""
    corners = (("0.", "0.", "0."), ("1.", "0.", "0."), ("0.", "1.", "0."))
    good = [" 3", *(f"{x:>14}{y:>14}{z:>14}" for x, y, z in corners)]
    bad = [good[:3], [], ["X", *good[1:]], [good[0], good[1], "1..2", good[3]], [good[0], "", "5.", good[3]], good[:1]]
    data = [deck_from_lines(f"deck {n}", lines) for n, lines in enumerate([good, *bad, good])]
    results = both(programs.program("program1"), data, Options())
    assert sum(isinstance(r, str) for r in results) == 5
    assert any(isinstance(r, Result) and r.notices for r in results)


def test_the_compiled_engine_runs_ordinary_decks_without_the_interpreter() -> None:
    """This holds for sixty decks and all three programs."""
    data = [deck_of(points) for _, points in sets(60, 3)]
    assert len(data) <= BLOCK
    results = run_batch(programs.program("program1"), data)
    runner = Runner(programs.program("program1"), Options())
    assert None not in list(runner.runs([packed(deck) for deck in data]))
    for name, words in (("program2", COPLANAR), ("program3", NOT_COPLANAR)):
        middle = [packed(deck_from_lines("middle", r.punched)) for r in results if words in r.typed]
        assert len(middle) > 5
        runner = Runner(programs.program(name), Options(limit=100_000))
        assert None not in list(runner.runs(middle))
