"""Batches: the compiled engine and the interpreter give the same results for every deck."""

import os
from collections.abc import Sequence

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from emulator.compiled import runner
from emulator.compiled.batch import punched, run_batch
from emulator.errors import CardError, DeckError, EmulatorError
from emulator.language.cards import Card, Deck, deck_from_lines
from emulator.language.compiler import translate
from emulator.language.objectcode import Program
from emulator.machine.machine import Machine
from emulator.machine.result import Options
from emulator.numbers import numbers
from tests.support.decks_at_random import ALL_FUNCTIONS, DATA, programs
from tests.support.deckwork import agreed, program, source, within
from tests.support.systems import COMPILED

pytest.importorskip("numba")

OPTIONS = st.builds(
    Options,
    numbers=st.sampled_from(COMPILED).map(numbers),
    switches=st.frozensets(st.integers(1, 4)),
    bounds=st.sampled_from(["strict", "core"]),
    limit=st.sampled_from([1, 2, 7, 300, 1_000, 1_001]),
)


def decks(*texts: Sequence[str]) -> list[Deck]:
    return [deck_from_lines(f"deck {n}", lines) for n, lines in enumerate(texts, 1)]


def compiled_program(cards: Sequence[str]) -> Program | None:
    """Compile a random program, or return None if the compiler rejects it."""
    try:
        return translate(source(*cards))[0]
    except EmulatorError:
        return None


def count_compiled(lines: Sequence[str], *data: Sequence[str], options: Options | None = None) -> int:
    """Run decks in both engines and return the number that the compiled engine ran."""
    return agreed(program(*lines), decks(*data), options or Options(limit=10_000))


COPY = ["1 READ 2,A,B,I", "PUNCH 3,A,B,I", "GO TO 1", "2 FORMAT(E14.8,F8.3,I5)", "3 FORMAT(3HA =,2E14.8,I5)", "END"]


def test_a_copying_program_runs_in_the_compiled_engine() -> None:
    card = " .20000000E+01     1.5   12"
    assert (
        count_compiled(
            COPY, [card], [card] * 3, [f"{'-.1E-05':14}  -1.250 -999"], [card, f"{'1.E5':>14}{'3.':>8}    7"]
        )
        == 4
    )


AT_RANDOM = int(os.environ.get("HULL1620_SETS", "60"))
"""The number of random programs to compare. Runs with 5,000 found no difference."""


@settings(max_examples=AT_RANDOM, suppress_health_check=[HealthCheck.too_slow])
@given(programs(powers=True), st.lists(DATA, min_size=1, max_size=2), OPTIONS)
def test_random_programs_agree_in_every_profile(cards: list[str], data: list[list[str]], options: Options) -> None:
    """The programs have loops, lists, FORMATs, errors and fields without numbers."""
    random_program = compiled_program(cards)
    if random_program is not None:
        with within(60):
            agreed(random_program, decks(*data), options)


@settings(max_examples=25)
@given(programs(ALL_FUNCTIONS, powers=True), st.lists(DATA, min_size=1, max_size=3), OPTIONS)
def test_random_programs_with_library_functions_agree(cards, data, options) -> None:
    random_program = compiled_program(cards)
    if random_program is not None:
        with within(60):
            agreed(random_program, decks(*data), options)


def test_many_random_programs_stay_in_the_compiled_engine() -> None:
    """Otherwise the two tests above would compare the interpreter with itself. About seven in ten programs do."""
    compiled_runs: list[int] = []

    @settings(max_examples=40, derandomize=True, database=None)
    @given(programs(), DATA)
    def sample(cards: list[str], data: list[str]) -> None:
        random = compiled_program(cards)
        if random is not None:
            compiled_runs.append(agreed(random, decks(data), Options(limit=500)))

    sample()
    assert sum(compiled_runs) > len(compiled_runs) / 3


MODES = {"E14.8": "A", "E10.3": "A", "F7.2": "A", "F5.1": "A", "I4": "I", "I2": "I", "2I3": "II", "2(I3,1X)": "II"}
MODES |= {"3X": "", "5H AB C": "", "/": "", "//": ""}
SPECS = st.lists(st.sampled_from(sorted(MODES)), min_size=1, max_size=6)
DIGITS = st.lists(st.integers(0, 79), max_size=8).map(lambda ones: "".join("01"[k in ones] for k in range(80)))
"""Cards of zeros and ones, on which every field holds a number."""


def list_for(specs: list[str], count: int) -> str:
    """Return a list of ``count`` variables of the modes of a FORMAT, repeated if it is longer."""
    modes = "".join(MODES[spec] for spec in specs)
    return "".join(f",{modes[n % len(modes)]}{n}" for n in range(count if modes else 0))


@st.composite
def copying_programs(draw: st.DrawFn) -> list[str]:
    """Return a program that reads by one FORMAT and punches by another, then punches the texts it has read."""
    taken, given_out = draw(SPECS), draw(SPECS)
    read, put = (list_for(specs, draw(st.integers(0, 7))) for specs in (taken, given_out))
    lines = ["DO 5 K=1,7", *(f"I{n}=-K" for n in range(7)), "I3=K*14", *(f"A{n}=I{n}" for n in range(7)), "5 A2=A3/7."]
    lines += [f"1 READ 8{read}", f"PUNCH 9{put}", "PUNCH 8", f"TYPE 9{put}", "GO TO 1"]
    return [*lines, f"8 FORMAT({','.join(taken)})", f"9 FORMAT({','.join(given_out)})", "END"]


def test_random_formats_agree_on_input_and_output() -> None:
    """Slashes, repetitions, texts that are read and written, lists longer and shorter than the FORMAT."""
    compiled_runs: list[int] = []

    @settings(max_examples=AT_RANDOM, database=None)
    @given(
        copying_programs(),
        st.lists(st.lists(DIGITS, max_size=6), min_size=1, max_size=3),
        st.sampled_from(["truncating", "ibm1962"]),
    )
    def sample(cards: list[str], data: list[list[str]], name: str) -> None:
        compiled_runs.append(agreed(program(*cards), decks(*data), Options(limit=500, numbers=numbers(name))))

    sample()
    assert sum(compiled_runs) > len(compiled_runs) / 4


@pytest.mark.parametrize("name", COMPILED)
def test_error_codes_agree(name: str) -> None:
    """They are counted, and typed if the arithmetic does so: E3 and E7 of integer powers, and F8 within a line."""
    lines = ["A=1.E60", "B=A*A", "C=1./B/A/A", "Z=0.", "D=A/Z", "K=5/0", "X=Z**(-1)", "Y=A*A*A", "W=(-A)**2"]
    lines += ["V=1.E-99-1.1E-99", "PUNCH 2,D,X", "2 FORMAT(2E14.8)"]
    options = Options(numbers=numbers(name))
    assert count_compiled([*lines, "END"], ["1"], options=options) == 1
    # The library of 1962 writes a record for F8, which the interpreter does.
    lines += ["PUNCH 1,A,B,C", "1 FORMAT(F5.1,E14.8,E9.4)", "END"]
    assert count_compiled(lines, ["1"], options=options) == (not options.numbers.as_1962)


@pytest.mark.parametrize("name", COMPILED)
def test_roots_and_small_integer_powers_agree(name: str) -> None:
    lines = ["1 READ 2,A,I", "B=SQRT(A)", "C=A**I", "PUNCH 3,B,C", "GO TO 1", "2 FORMAT(E14.8,I4)", "3 FORMAT(2E14.8)"]
    data = [
        f" .{m:08d}E{e:+03d}{i:4d}" for m in (10000000, 12345678, 99999999) for e in (-98, 0, 3, 51) for i in (-1, 0, 2)
    ]
    assert count_compiled([*lines, "END"], data, ["-.40000000E+01   2"], [".0              1"]) >= 2
    assert count_compiled([*lines, "END"], data, options=Options(numbers=numbers(name))) <= 1


@pytest.mark.parametrize("name", COMPILED)
def test_larger_integer_powers_are_compiled_only_if_multiplied(name: str) -> None:
    """The exact power has more digits than the kernel supports."""
    lines = ["READ 1,A", "B=A**3", "C=A**(-2)", "PUNCH 1,B,C", "1 FORMAT(2E14.8)", "END"]
    system = numbers(name)
    assert count_compiled(lines, [" .33333333E+01"], options=Options(numbers=system)) == system.as_1962


def test_endings_agree() -> None:
    """Each kind of ending with its message, and PAUSE with its warning."""
    start = ["DIMENSION X(3),M(2,2)", "READ 1,I", "1 FORMAT(I4)"]
    for lines in (
        ["STOP"],
        ["PAUSE", "PAUSE", "DO 5 J=1,3", "5 PAUSE"],
        ["GO TO 6", "5 PAUSE", "STOP", "6 PAUSE", "GO TO 5"],
        ["5 GO TO 5"],
        ["X(I)=1."],
        ["M(I,2)=1"],
        ["A=X(1)+1."],
        ["GO TO (5,5),I", "5 STOP"],
        ["IF(SENSE SWITCH 2)5,6", "5 STOP", "6 PAUSE"],
        ["DO 5 J=1,I", "5 TYPE 1,J", "PUNCH 2", "2 FORMAT(//5HNO. 1//)"],
    ):
        data = [["   1"], ["   2"], ["   4"], ["   9"]]
        for bounds in ("strict", "core"):
            options = Options(limit=200, bounds=bounds, switches=frozenset({2}))
            assert count_compiled([*start, *lines, "END"], *data, options=options) == 4


@pytest.mark.parametrize(
    ("lines", "data"),
    [
        (COPY, ["NO NUMBER"]),
        (COPY, ["             1     2    3", ".1E200"]),
        (COPY, [""]),
        (["READ 1,I", "READ 1,I", "1 FORMAT(I4)", "END"], ["   1"]),
        (["ACCEPT 1,I", "1 FORMAT(I4)", "END"], ["   1"]),
        (["READ 1,A", "A=SIN(A)", "PUNCH 1,A", "1 FORMAT(F5.2)", "END"], ["  1.5"]),
        (["READ 1,A", "A=A**A", "PUNCH 1,A", "1 FORMAT(F5.2)", "END"], ["  1.5"]),
        (["READ 1,A", "PUNCH 1,B", "1 FORMAT(F5.2)", "END"], ["  1.5"]),
        (["READ 1,I", "1 FORMAT(F5.2)", "END"], ["  1.5"]),
        (["READ 1,I", "PUNCH 2,I", "1 FORMAT(I4)", "2 FORMAT(49X,24X,I4)", "END"], ["   1"]),
        (["READ 1,I", "1 FORMAT(I5)", "END"], ["12345"]),
    ],
)
def test_unsupported_decks_run_in_the_interpreter(lines: list[str], data: list[str]) -> None:
    assert count_compiled(lines, data) == 0


def test_errors_of_decks_and_of_the_size_are_raised() -> None:
    card = " .20000000E+01     1.5   12"
    with pytest.raises(CardError, match=r"deck 3: card 1, column 1: 'BAD' is not a number"):
        run_batch(program(*COPY), decks([card], [card], ["BAD"], [card], ["WORSE"]))
    large = program("DIMENSION X(3200)", "X(1)=0.", "END")
    for data in ([], decks([])):
        with pytest.raises(DeckError, match="OVERLAP"):
            run_batch(large, data)
    assert run_batch(program(*COPY), []) == ()


def test_blocks_and_decks_do_not_share_state() -> None:
    card = " .20000000E+01     1.5"
    texts = [[f"{card}{n:5d}"] * (n % 4 + 1) for n in range(2 * runner.BLOCK + 3)]
    assert count_compiled(COPY, *texts) == len(texts)
    # The texts of FORMATs, storage, and the list of PAUSEs are reset for each deck.
    lines = ["M=0", "1 PUNCH 2", "READ 2", "IF(SENSE SWITCH 1)3,1", "3 PAUSE", "GO TO 1", "2 FORMAT(5HFIRST)", "END"]
    assert count_compiled(lines, ["AAAAA", "BBBBB"], ["CCCCC"], ["DDDDD"] * 3) == 3
    lines = ["1 READ 2,A", "TYPE 3,A", "READ 4", "TYPE 4", "GO TO 1", "2 FORMAT(49X,29X,F5.1)", "3 FORMAT(F5.1)"]
    lines += ["4 FORMAT(49X,29X,4HABCD)", "END"]
    card = f"{'77':78}1."
    assert count_compiled(lines, [card] * 4, [card] * 2) == 2


def test_a_log_grows_and_a_deck_that_exceeds_it_runs_in_the_interpreter(monkeypatch) -> None:
    monkeypatch.setattr(runner, "LOG_ROOM", 64)
    monkeypatch.setattr(runner, "MOST_LOG_ROOM", 1 << 10)
    lines = ["READ 1,N", "DO 5 I=1,N", "5 PUNCH 2,I", "1 FORMAT(I4)", "2 FORMAT(5X,I5)", "END"]
    assert count_compiled(lines, *([f"{n:4d}"] for n in (1, 3, 0, 40, 7, 500, 2, 39))) == 7


def test_every_limit_ends_both_engines_at_the_same_place() -> None:
    """Statements, passes of lists, records and typed error codes all count.

    Numbers too large for F fields are only punched by ``truncating``: under ibm1962 they run in the interpreter.
    """
    for name, form in (("truncating", "F5.1/E14.8,3H E=/F9.2"), ("ibm1962", "E14.8/E14.8,3H E=/E10.3")):
        lines = ["A=1.E60", "1 B=A*A", "PUNCH 2,B,(A,I=1,2)", "GO TO 1", f"2 FORMAT({form})", "END"]
        for limit in range(40):
            assert count_compiled(lines, ["1"], options=Options(numbers=numbers(name), limit=limit)) == 1


def test_punched_returns_the_cards_of_each_deck_as_text() -> None:
    card = " .20000000E+01     1.5   12"
    texts = [f"{card}\n{card}\n", card, f"{card}\r\n", f"{card}{' ' * 70}\n"]
    punched_card = "A = .20000000E+01 .15000000E+01   12\n"
    assert list(punched(program(*COPY), texts)) == [punched_card * 2, *[punched_card] * 3]
    assert list(punched(program(*COPY), texts, Options(numbers=numbers("truncating:20")))) == [
        punched_card * 2,
        *[punched_card] * 3,
    ]


@pytest.mark.parametrize("text", ["", "lower case\n", "X" * 81 + "\n", "\N{EURO SIGN}\n", "A\tB\n"])
def test_text_that_is_not_a_deck_is_rejected(text: str) -> None:
    with pytest.raises(EmulatorError):
        list(punched(program(*COPY), [text]))


def test_cards_with_other_characters_run_in_the_interpreter() -> None:
    """Such cards are built in Python; deck_from_lines rejects them."""
    copying = program("READ 1,I", "1 FORMAT(5H     ,I1)", "PUNCH 1,I", "END")
    for text in ("\N{EURO SIGN}EUR 1", "x" * 5 + "1", " " * 5 + "1" + " " * 90, " " * 5 + "1|"):
        deck = Deck("odd", (Card(1, text),))
        assert run_batch(copying, [deck]) == (Machine(copying, deck).run(),)
