"""Random decks: every input produces a result within the limit, or an error of the emulator."""

from dataclasses import replace

from hypothesis import given, settings
from hypothesis import strategies as st

from emulator.errors import EmulatorError
from emulator.language.cards import deck_from_lines
from emulator.language.compiler import translate
from emulator.machine.machine import Machine
from emulator.machine.result import Options, Result
from emulator.machine.timing import measure
from emulator.numbers import numbers
from tests.support.decks_at_random import ALL_FUNCTIONS, CARD, CARD_TEXT, DATA, programs, spoilt_programs
from tests.support.deckwork import source, within
from tests.support.systems import DECIMAL

OPTIONS = st.builds(
    Options,
    numbers=st.sampled_from(DECIMAL).map(numbers),
    switches=st.frozensets(st.integers(1, 4)),
    core=st.sampled_from([20_000, 40_000, 60_000]),
    bounds=st.sampled_from(["strict", "core"]),
    limit=st.just(5_000),
)
KEYS = st.lists(st.text(max_size=12), max_size=4)


def exercise(cards: list[str], data: list[str], options: Options, keys: list[str]) -> str:
    """Compile and run; return the kind of the ending, or the name of the error."""
    with within(30):
        try:
            made, messages = translate(source(*cards))
            if made is None:
                assert any(not m.warning for m in messages)
                assert all(1 <= m.card <= len(cards) and 0 <= m.column <= 80 for m in messages)
                assert all("\n" not in m.line("x") for m in messages)
                return "refused"
            machine = Machine(made, deck_from_lines("data", data), options, keys)
            result = machine.run()
        except EmulatorError as caught:
            error = caught
        else:
            return checked_ending(machine, result, options)
        assert str(error)
        assert "\n" not in str(error)
        return type(error).__name__


def checked_ending(machine: Machine, result: Result, options: Options) -> str:
    """Check the properties of every result, and return the kind of its ending."""
    assert result.statements <= options.limit
    assert bool(result.ending.message) == (not result.ending.normal)
    assert "\n" not in result.ending.message
    assert len(machine.state.values) == len(machine.state.kinds) == machine.program.storage.length
    assert measure(machine.program, result).time.seconds >= 0
    return result.ending.kind


@settings(max_examples=80)
@given(st.one_of(programs(), programs(ALL_FUNCTIONS, powers=True), spoilt_programs()), DATA, OPTIONS, KEYS)
def test_random_and_corrupted_programs_end_with_a_result_or_an_error(cards, data, options, keys) -> None:
    exercise(cards, data, replace(options, limit=2_000), keys)


@settings(max_examples=100)
@given(st.lists(CARD, max_size=10), DATA, OPTIONS)
def test_random_cards_end_with_a_result_or_an_error(cards: list[str], data: list[str], options: Options) -> None:
    exercise(cards, data, replace(options, limit=2_000), [])


@settings(max_examples=100)
@given(st.text(min_size=1, max_size=40), CARD_TEXT)
def test_random_formats_read_and_write(text: str, card: str) -> None:
    spec = "".join(c for c in text.upper() if c in "0123456789IEFXH/(),. ")[:40]
    lines = [f"READ 1,{'A' if 'E' in spec else 'I'}", f"PUNCH 1,{'A' if 'E' in spec else 'I'}", f"1 FORMAT({spec})"]
    exercise([*lines, "END"], [card] * 5, Options(limit=1_000), [])


def test_most_random_programs_compile_and_end_in_different_ways() -> None:
    """Tests with random programs prove little if the compiler rejects most of them."""
    kinds: list[str] = []

    @settings(max_examples=60, derandomize=True, database=None)
    @given(programs(), DATA)
    def sample(cards: list[str], data: list[str]) -> None:
        kinds.append(exercise(cards, data, Options(limit=500), []))

    sample()
    assert kinds.count("refused") < len(kinds) / 4
    assert len(set(kinds)) >= 7
    assert sum(kind in ("end", "stop", "hopper") for kind in kinds) >= len(kinds) / 10
