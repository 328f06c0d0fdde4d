"""Object code run in every arithmetic: agreement between arithmetics, and the options of a user."""

import io
import re

import pytest
from hypothesis import given, settings

from emulator.compiled.batch import run_batch
from emulator.errors import EmulatorError
from emulator.language.cards import deck_from_lines
from emulator.language.compiler import translate
from emulator.machine.endings import Ending
from emulator.machine.machine import Machine
from emulator.machine.operator import Operator
from emulator.machine.result import Options, Result
from emulator.machine.trace import Tracer
from emulator.numbers import numbers
from emulator.numbers.base import Numbers
from tests.support.decks_at_random import ALL_FUNCTIONS, DATA, programs
from tests.support.deckwork import plain, program, source, until, within

Ran = tuple[Result | str, Machine | None]
"""A result or the message of an error, and the machine, if the program compiled."""
KEYED = ["1.5", "-7", "2"]
FAR = 1_000
"""The limit of work for each statement to be executed."""
STANDS = Ending("limit", trouble="as many statements are done as were asked for")


def outcome_of(lines: list[str], data: list[str], options: Options, statements: int | None = None) -> Ran:
    """Run to the end, or until the given number of statements."""
    machine = None
    with within(30):
        try:
            made, _ = translate(source(*lines))
            if made is None:
                return "refused", None
            machine = Machine(made, deck_from_lines("data", data), options, KEYED)
            if statements is None:
                return machine.run(), machine
            return machine.result(until(machine, statements, Operator(KEYED)) or STANDS), machine
        except EmulatorError as error:
            return str(error), machine


def both_outcomes(
    lines: list[str], data: list[str], systems: tuple[Numbers, Numbers], statements: int
) -> tuple[Ran, Ran]:
    """Run two arithmetics until each has ended or executed the given number of statements.

    If an operation exceeds all limits in one of them, stop both before its statement.
    """

    def both(statements: int) -> tuple[Ran, Ran]:
        options = (Options(numbers=system, limit=FAR * (statements + 1)) for system in systems)
        first, second = (outcome_of(lines, data, each, statements) for each in options)
        return first, second

    outcomes = both(statements)
    beyond = [
        plain(machine) - 1
        for outcome, machine in outcomes
        if machine and isinstance(outcome, Result) and outcome.ending.kind == "limit" and outcome.ending is not STANDS
    ]
    return both(min(beyond)) if beyond else outcomes


def results(name: str, *lines: str, data: tuple[str, ...] = (), limit: int = 10_000) -> Result:
    options = Options(numbers=numbers(name), limit=limit)
    return Machine(program(*lines), deck_from_lines("data.cards", data), options).run()


@settings(max_examples=30)
@given(programs(), DATA)
def test_python_floats_and_mpmath_with_53_bits_agree(cards: list[str], data: list[str]) -> None:
    """Decisions and cards are equal, except for signs of zeros and after an overflow, which mpmath does not have."""
    runs = both_outcomes(cards, data, (numbers("float64"), numbers("mp:53")), 2_000)
    if any(machine and machine.result().errors for _, machine in runs):
        return
    first, second = (outcome for outcome, _ in runs)
    if isinstance(first, Result) and isinstance(second, Result):
        assert first.counts == second.counts
        assert first.ending.kind == second.ending.kind
        assert [without_zero_signs(card) for card in first.punched] == [
            without_zero_signs(card) for card in second.punched
        ]
    else:
        assert first == second


def without_zero_signs(card: str) -> str:
    """Return a card without the signs of its zeros."""
    return re.sub(r"-(?=\.0*(E-99)?(?!\d))", " ", card)


@pytest.mark.parametrize("name", ["float64", "float32", "mp:24", "exact", "truncating"])
@settings(max_examples=15)
@given(cards=programs(ALL_FUNCTIONS, powers=True), data=DATA)
def test_every_run_ends_with_a_result_or_an_error_of_one_line(name: str, cards: list[str], data: list[str]) -> None:
    outcome, _ = outcome_of(cards, data, Options(numbers=numbers(name), limit=1_000))
    if isinstance(outcome, Result):
        assert bool(outcome.ending.message) == (not outcome.ending.normal)
        assert "\n" not in outcome.ending.message
    else:
        assert "\n" not in outcome


def test_constants_and_numbers_on_cards_are_read_without_loss() -> None:
    lines = ["READ 1,A", "B=.123456789012345", "IF(A-B)2,3,2", "2 STOP", "3 PUNCH 4,A", "1 FORMAT(F20.15)"]
    for name, kind in (("exact", "end"), ("mp:100", "end"), ("float64", "end")):
        result = results(name, *lines, "4 FORMAT(F18.15)", "END", data=(" .123456789012345",))
        assert result.ending.kind == kind
        assert result.punched == ("  .123456789012345",)
    short = Machine(program(*lines, "4 FORMAT(F18.15)", "END"), deck_from_lines("d", [" .123456789012345"])).run()
    assert short.punched == ("  .123456780000000",)


@pytest.mark.parametrize("name", ["exact", "float64", "float32", "mp:30", "mp:200"])
def test_a_card_shows_the_decimal_number_that_was_read(name: str) -> None:
    lines = ["READ 1,A", "PUNCH 1,A", "1 FORMAT(E14.8)", "END"]
    for text in (" .30000000E+00", "-.12345600E-17", " .70000000E-30", " .10000000E-37", " .00000000E-99"):
        assert results(name, *lines, data=(text,)).punched == (text.rstrip(),)


@pytest.mark.parametrize("name", ["exact", "float64", "mp:100"])
def test_output_truncates_and_does_not_round(name: str) -> None:
    lines = ["A=2./3.", "B=-A", "PUNCH 1,A,B,A", "1 FORMAT(2E14.8,F7.3)", "END"]
    assert results(name, *lines).punched == (" .66666666E+00-.66666666E+00   .666",)


@pytest.mark.parametrize("name", ["exact", "float64", "float32", "truncating"])
def test_the_sign_of_a_zero_follows_from_the_object_code(name: str) -> None:
    """``A-B*C`` is B*C minus A, reversed: a cancellation gives minus zero (docs/reference/machine.md)."""
    lines = ["A=6.", "B=2.", "C=3.", "D=A-B*C", "E=B*C-A", "F=-D", "PUNCH 1,D,E,F", "1 FORMAT(3E14.8)", "END"]
    assert results(name, *lines).punched == ("-.00000000E-99 .00000000E-99 .00000000E-99",)


def test_zeros_and_fixed_point_numbers_do_not_depend_on_the_arithmetic() -> None:
    lines = ["A=-0.", "Z=A+A", "Y=A*1.", "X=A", "IF(A)5,6,5", "5 STOP", "6 PUNCH 1,Z,Y,X", "1 FORMAT(3E14.8)", "END"]
    assert results("exact", *lines).punched == (" .00000000E-99 .00000000E-99-.00000000E-99",)
    lines = ["K=9999", "K=K+2", "X=K", "M=12345.9", "L=-2.9", "PUNCH 1,K,X,M,L", "1 FORMAT(I5,F6.2,2I5)", "END"]
    for name in ("exact", "float64", "float32", "mp:60"):
        assert results(name, *lines).punched == ("    1  1.00 2345   -2",)


def test_undefined_numbers_and_elements_outside_end_the_run() -> None:
    result = results("exact", "A=B+1.", "END")
    assert (result.ending.kind, result.ending.message) == (
        "undefined",
        "deck.f: card 1: B is undefined but is used in a calculation, in A=B+1.",
    )
    start = ["DIMENSION X(3)", "I=3", "X(3)=1."]
    assert results("float64", *start, "Y=X(I+1)", "END").ending.kind == "end"
    assert results("float64", *start, "Y=X(I+1)+1.", "END").ending.kind == "bounds"
    assert results("float64", *start, "I=5", "Y=X(I)", "END").ending.kind == "bounds"


def test_traces_and_batches_support_every_arithmetic() -> None:
    file = io.StringIO()
    machine = Machine(program("A=1./3.", "B=1./8.", "END"), deck_from_lines("d", []), Options(numbers=numbers("exact")))
    tracer = Tracer(file)
    tracer.watch(machine.program, machine)
    machine.run()
    tracer.close()
    assert "A = 0.33333333333333333333..." in file.getvalue()
    assert "B = 0.125\n" in file.getvalue()
    made = program("READ 1,A", "B=A/3.*3.", "PUNCH 1,B", "1 FORMAT(E14.8)", "END")
    decks = [deck_from_lines("d", [text]) for text in ("2.", "1.")]
    options = Options(numbers=numbers("float64"))
    assert [r.punched for r in run_batch(made, decks, options)] == [(" .20000000E+01",), (" .10000000E+01",)]
    assert [r.punched for r in run_batch(made, decks)] == [(" .19999999E+01",), (" .99999999E+00",)]


@pytest.mark.parametrize("name", ["exact", "truncating", "truncating:20"])
def test_uncut_numbers_accompany_the_cards(name: str) -> None:
    """The next program reads the full numbers; without them it reads the columns."""
    hosting = Options(numbers=numbers(name), uncut=True)
    writer = program("N=7", "A=1./3.", "B=2.", "PUNCH 1,N,A,B", "PUNCH 1,N,B,A", "1 FORMAT(I2,2E14.8)", "END")
    reader = program(
        *["READ 1,N,A,B", "READ 1,N,C,D", "IF(A-D)2,3,2", "2 PUNCH 4,N", "3 X=A*3.", "PUNCH 4,N,X"],
        *["1 FORMAT(I2,2E14.8)", "4 FORMAT(I2,F25.20)", "END"],
    )
    written = Machine(writer, deck_from_lines("d", []), hosting).run()
    assert [[(column, width) for column, width, _ in card] for card in written.uncut] == [[(3, 14), (17, 14)]] * 2
    deck = deck_from_lines("middle", written.punched)
    whole = Machine(reader, deck, hosting, uncut=written.uncut).run()
    cut = Machine(reader, deck, hosting).run()
    expected = {
        "exact": "1.00000000000000000000",
        "truncating": ".99999999000000000000",
        "truncating:20": "." + "9" * 20,
    }
    assert whole.punched == (f" 7{expected[name].rjust(25)}",)
    assert cut.punched == (f" 7{'.99999999000000000000'.rjust(25)}",)


def test_uncut_numbers_are_kept_on_request_only() -> None:
    options = Options(numbers=numbers("truncating:12"), uncut=True)
    made = program("A=1./3.", "PUNCH 1,A", "1 FORMAT(E14.8)", "END")
    result = Machine(made, deck_from_lines("d", []), options).run()
    assert result.uncut == (((1, 14, (333333333333, 0)),),)
    assert run_batch(made, [deck_from_lines("d", [])], options)[0] == result
    result = results("exact", "A=1./3.", "PUNCH 1,A", "1 FORMAT(E14.8)", "END")
    assert result.uncut == ()
