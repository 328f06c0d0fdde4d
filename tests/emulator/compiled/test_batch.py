"""Batches: the compiled engine gives what the plain one gives, deck for deck, or leaves the deck to it."""

from __future__ import annotations

import os
from collections.abc import Sequence

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from emulator.compiled import runner
from emulator.compiled.batch import punched, results, run_batch
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


def made(cards: Sequence[str]) -> Program | None:
    """A random deck compiled; None where it is refused."""
    try:
        return translate(source(*cards))[0]
    except EmulatorError:
        return None


def alone(lines: Sequence[str], *data: Sequence[str], options: Options | None = None) -> int:
    """How many of the decks the compiled engine ran by itself, agreeing with the plain one."""
    return agreed(program(*lines), decks(*data), options or Options(limit=10_000))


COPY = ["1 READ 2,A,B,I", "PUNCH 3,A,B,I", "GO TO 1", "2 FORMAT(E14.8,F8.3,I5)", "3 FORMAT(3HA =,2E14.8,I5)", "END"]


def test_a_copying_program() -> None:
    card = " .20000000E+01     1.5   12"
    assert alone(COPY, [card], [card] * 3, [f"{'-.1E-05':14}  -1.250 -999"], [card, f"{'1.E5':>14}{'3.':>8}    7"]) == 4


AT_RANDOM = int(os.environ.get("HULL1620_SETS", "200"))
"""How many random programs are compared; 5,000 were, without a difference."""


@settings(max_examples=AT_RANDOM, suppress_health_check=[HealthCheck.too_slow])
@given(programs(powers=True), st.lists(DATA, min_size=1, max_size=2), OPTIONS)
def test_random_programs_in_every_profile(cards: list[str], data: list[list[str]], options: Options) -> None:
    """Every statement the compiled engine takes, in loops, with lists, FORMATs, errors and fields without a number."""
    found = made(cards)
    if found is not None:
        with within(60):
            agreed(found, decks(*data), options)


@settings(max_examples=25)
@given(programs(ALL_FUNCTIONS, powers=True), st.lists(DATA, min_size=1, max_size=3), OPTIONS)
def test_programs_with_every_function(cards: list[str], data: list[list[str]], options: Options) -> None:
    found = made(cards)
    if found is not None:
        with within(60):
            agreed(found, decks(*data), options)


def test_many_of_the_random_programs_stay_in_the_compiled_engine() -> None:
    """Else the two tests above would compare the plain engine with itself.

    Some six in ten do; of twenty programs it may be three or nine, of sixty it is never far from that.
    """
    found: list[int] = []

    @settings(max_examples=60, derandomize=True, database=None)
    @given(programs(), DATA)
    def sample(cards: list[str], data: list[str]) -> None:
        random = made(cards)
        if random is not None:
            found.append(agreed(random, decks(data), Options(limit=500)))

    sample()
    assert sum(found) > len(found) / 3


MODES = {"E14.8": "A", "E10.3": "A", "F7.2": "A", "F5.1": "A", "I4": "I", "I2": "I", "2I3": "II", "2(I3,1X)": "II"}
MODES |= {"3X": "", "5H AB C": "", "/": "", "//": ""}
SPECS = st.lists(st.sampled_from(sorted(MODES)), min_size=1, max_size=6)
DIGITS = st.lists(st.integers(0, 79), max_size=8).map(lambda ones: "".join("01"[k in ones] for k in range(80)))
"""A card of zeros and some ones: a number wherever a field is."""


def by_format(specs: list[str], count: int) -> str:
    """A list of ``count`` names of the modes a FORMAT has, taken again from its start where it is longer."""
    modes = "".join(MODES[spec] for spec in specs)
    return "".join(f",{modes[n % len(modes)]}{n}" for n in range(count if modes else 0))


@st.composite
def copying_programs(draw: st.DrawFn) -> list[str]:
    """READ by one FORMAT and PUNCH by another, whatever stands in them; then PUNCH what H and X have read."""
    taken, given_out = draw(SPECS), draw(SPECS)
    read, put = (by_format(specs, draw(st.integers(0, 7))) for specs in (taken, given_out))
    lines = ["DO 5 K=1,7", *(f"I{n}=-K" for n in range(7)), "I3=K*14", *(f"A{n}=I{n}" for n in range(7)), "5 A2=A3/7."]
    lines += [f"1 READ 8{read}", f"PUNCH 9{put}", "PUNCH 8", f"TYPE 9{put}", "GO TO 1"]
    return [*lines, f"8 FORMAT({','.join(taken)})", f"9 FORMAT({','.join(given_out)})", "END"]


def test_any_format_either_way() -> None:
    """Slashes, repeats, texts read and put out again, lists longer and shorter than the FORMAT."""
    found: list[int] = []

    @settings(max_examples=120, database=None)
    @given(copying_programs(), st.lists(st.lists(DIGITS, max_size=6), min_size=1, max_size=3))
    def sample(cards: list[str], data: list[list[str]]) -> None:
        found.append(agreed(program(*cards), decks(*data), Options(limit=500)))

    sample()
    assert sum(found) > len(found) / 4


@pytest.mark.parametrize("name", COMPILED)
def test_error_codes(name: str) -> None:
    """Counted, and typed where the profile does; F8 in the middle of a line, E3 and E7 of whole powers."""
    lines = ["A=1.E60", "B=A*A", "C=1./B/A/A", "Z=0.", "D=A/Z", "K=5/0", "X=Z**(-1)", "Y=A*A*A", "W=(-A)**2"]
    lines += ["V=1.E-99-1.1E-99", "PUNCH 1,A,B,C", "PUNCH 2,D,X", "1 FORMAT(F5.1,E14.8,E9.4)", "2 FORMAT(2E14.8)"]
    assert alone([*lines, "END"], ["1"], options=Options(numbers=numbers(name))) == 1


@pytest.mark.parametrize("name", COMPILED)
def test_roots_and_whole_powers(name: str) -> None:
    lines = ["1 READ 2,A,I", "B=SQRT(A)", "C=A**I", "PUNCH 3,B,C", "GO TO 1", "2 FORMAT(E14.8,I4)", "3 FORMAT(2E14.8)"]
    data = [
        f" .{m:08d}E{e:+03d}{i:4d}" for m in (10000000, 12345678, 99999999) for e in (-98, 0, 3, 51) for i in (-1, 0, 2)
    ]
    assert alone([*lines, "END"], data, ["-.40000000E+01   2"], [".0              1"]) >= 2
    assert alone([*lines, "END"], data, options=Options(numbers=numbers(name))) <= 1


@pytest.mark.parametrize("name", COMPILED)
def test_whole_powers_beyond_a_product(name: str) -> None:
    """The exact power of a number has more digits than the kernel's; where it is multiplied out, it runs there."""
    lines = ["READ 1,A", "B=A**3", "C=A**(-2)", "PUNCH 1,B,C", "1 FORMAT(2E14.8)", "END"]
    multiplies = name == "ibm1962"
    assert alone(lines, [" .33333333E+01"], options=Options(numbers=numbers(name))) == multiplies


def test_endings() -> None:
    """Each way to end, with its message, and PAUSE with its warning."""
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
            assert alone([*start, *lines, "END"], *data, options=options) == 4


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
def test_what_the_compiled_engine_leaves_to_the_plain_one(lines: list[str], data: list[str]) -> None:
    assert alone(lines, data) == 0


def test_an_error_comes_where_its_deck_stands() -> None:
    """The decks before it have their results; the message is the Machine's."""
    card = " .20000000E+01     1.5   12"
    found = results(program(*COPY), decks([card], [card], ["BAD"], [card]), Options())
    assert next(found).ending.kind == "hopper"
    assert next(found).punched
    with pytest.raises(CardError, match=r"deck 3: card 1, column 1: 'BAD' is not a number"):
        next(found)


def test_no_decks_and_a_program_too_large() -> None:
    large = program("DIMENSION X(3200)", "X(1)=0.", "END")
    for data in ([], decks([])):
        with pytest.raises(DeckError, match="OVERLAP"):
            run_batch(large, data)
    assert run_batch(program(*COPY), []) == ()


def test_more_decks_than_a_block() -> None:
    card = " .20000000E+01     1.5"
    texts = [[f"{card}{n:5d}"] * (n % 4 + 1) for n in range(2 * runner.BLOCK + 3)]
    assert alone(COPY, *texts) == len(texts)


def test_a_log_too_long_for_its_room(monkeypatch: pytest.MonkeyPatch) -> None:
    """It grows, and what never fits is left to the plain engine; nothing is lost or doubled."""
    monkeypatch.setattr(runner, "LOG_ROOM", 64)
    monkeypatch.setattr(runner, "MOST_LOG_ROOM", 1 << 10)
    lines = ["READ 1,N", "DO 5 I=1,N", "5 PUNCH 2,I", "1 FORMAT(I4)", "2 FORMAT(5X,I5)", "END"]
    assert alone(lines, *([f"{n:4d}"] for n in (1, 3, 0, 40, 7, 500, 2, 39))) == 7


def test_a_deck_finds_nothing_of_the_one_before() -> None:
    """The text of a FORMAT that reading changed, storage, and PAUSEs met are the next deck's from the start."""
    lines = ["M=0", "1 PUNCH 2", "READ 2", "IF(SENSE SWITCH 1)3,1", "3 PAUSE", "GO TO 1", "2 FORMAT(5HFIRST)", "END"]
    assert alone(lines, ["AAAAA", "BBBBB"], ["CCCCC"], ["DDDDD"] * 3) == 3


def test_columns_beyond_the_card_are_blank() -> None:
    """They are not those of the card after it."""
    lines = ["1 READ 2,A", "TYPE 3,A", "READ 4", "TYPE 4", "GO TO 1", "2 FORMAT(49X,29X,F5.1)", "3 FORMAT(F5.1)"]
    lines += ["4 FORMAT(49X,29X,4HABCD)", "END"]
    card = f"{'77':78}1."
    assert alone(lines, [card] * 4, [card] * 2) == 2


def test_a_limit_wherever_it_falls() -> None:
    """Statements, passes of lists, records and typed error codes all count; each limit stops both engines alike."""
    lines = ["A=1.E60", "1 B=A*A", "PUNCH 2,B,(A,I=1,2)", "GO TO 1", "2 FORMAT(F5.1/E14.8,3H E=/F9.2)", "END"]
    for name in ("truncating", "ibm1962"):
        for limit in range(40):
            assert alone(lines, ["1"], options=Options(numbers=numbers(name), limit=limit)) == 1


def test_text_in_text_out() -> None:
    card = " .20000000E+01     1.5   12"
    texts = [f"{card}\n{card}\n", card, f"{card}\r\n", f"{card}{' ' * 70}\n"]
    one = "A = .20000000E+01 .15000000E+01   12\n"
    assert list(punched(program(*COPY), texts)) == [one * 2, one, one, one]
    assert list(punched(program(*COPY), texts, Options(numbers=numbers("truncating:20")))) == [one * 2, one, one, one]


@pytest.mark.parametrize("text", ["", "lower case\n", "X" * 81 + "\n", "\N{EURO SIGN}\n", "A\tB\n"])
def test_text_that_is_no_deck(text: str) -> None:
    """The errors are those of cards.py and of the Machine."""
    with pytest.raises(EmulatorError):
        list(punched(program(*COPY), [text]))


def test_a_card_not_made_by_the_readers_of_cards() -> None:
    """Columns that deck_from_lines would have refused come through as the Machine has them."""
    copying = program("READ 1,I", "1 FORMAT(5H     ,I1)", "PUNCH 1,I", "END")
    for text in ("\N{EURO SIGN}EUR 1", "x" * 5 + "1", " " * 5 + "1" + " " * 90):
        deck = Deck("odd", (Card(1, text),))
        assert run_batch(copying, [deck]) == (Machine(copying, deck).run(),)
