"""The object code over numbers of every kind: between systems, and as a user sets it up."""

from __future__ import annotations

import io
import re
from dataclasses import dataclass, field
from fractions import Fraction

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
from emulator.numbers.arithmetic import profile as digit_profile
from emulator.numbers.base import Numbers
from emulator.numbers.decimal import DecimalNumbers, Pair
from tests.support.decks_at_random import ALL_FUNCTIONS, DATA, programs
from tests.support.deckwork import plain, program, source, until, within

Ran = tuple[Result | str, Machine | None]
"""A result or an error's words, and the machine where there is one."""
KEYED = ["1.5", "-7", "2"]
FAR = 1_000
"""The limit of work for each statement that is compared."""
STANDS = Ending("limit", trouble="as many statements are done as were asked for")


def ran(lines: list[str], data: list[str], options: Options, statements: int | None = None) -> Ran:
    """A run to its end, or until it has done so many statements."""
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


def side_by_side(
    lines: list[str], data: list[str], systems: tuple[Numbers, Numbers], statements: int
) -> tuple[Ran, Ran]:
    """Runs of two arithmetics until each has ended or done so many statements, whatever an operation costs in it.

    One that is beyond all limits in either stops both before its statement.
    """

    def both(statements: int) -> tuple[Ran, Ran]:
        options = (Options(numbers=system, limit=FAR * (statements + 1)) for system in systems)
        one, other = (ran(lines, data, each, statements) for each in options)
        return one, other

    found = both(statements)
    beyond = [
        plain(machine) - 1
        for outcome, machine in found
        if machine and isinstance(outcome, Result) and outcome.ending.kind == "limit" and outcome.ending is not STANDS
    ]
    return both(min(beyond)) if beyond else found


def results(name: str, *lines: str, data: tuple[str, ...] = (), limit: int = 10_000) -> Result:
    options = Options(numbers=numbers(name), limit=limit)
    return Machine(program(*lines), deck_from_lines("data.cards", data), options).run()


@settings(max_examples=60)
@given(programs(), DATA)
def test_double_precision_twice(cards: list[str], data: list[str]) -> None:
    """Python's floats and mpmath at 53 bits: the same decisions and, signs of zero apart, the same cards.

    Not after an overflow: mpmath has none.
    """
    runs = side_by_side(cards, data, (numbers("float64"), numbers("mp:53")), 2_000)
    if any(machine and machine.result().errors for _, machine in runs):
        return
    one, other = (outcome for outcome, _ in runs)
    if isinstance(one, Result) and isinstance(other, Result):
        assert one.counts == other.counts
        assert one.ending.kind == other.ending.kind
        assert [unsigned(card) for card in one.punched] == [unsigned(card) for card in other.punched]
    else:
        assert one == other


def unsigned(card: str) -> str:
    """A card without the signs of its zeros."""
    return re.sub(r"-(?=\.0*(E-99)?(?!\d))", " ", card)


@dataclass(frozen=True)
class Watched(DecimalNumbers):
    """Decimal numbers that note each result that is not the exact one."""

    cuts: list[str] = field(default_factory=list, compare=False)

    def _noted(self, what: str, found: Pair, same: bool) -> Pair:
        if not same:
            self.cuts.append(what)
        return found

    def add(self, first: Pair, second: Pair) -> Pair:
        found = super().add(first, second)
        return self._noted("sum", found, self._of(found) == self._of(first) + self._of(second))

    def subtract(self, first: Pair, second: Pair) -> Pair:
        found = super().subtract(first, second)
        return self._noted("difference", found, self._of(found) == self._of(first) - self._of(second))

    def subtract_reversed(self, first: Pair, second: Pair) -> Pair:
        found = super().subtract_reversed(first, second)
        return self._noted("difference", found, self._of(found) == self._of(second) - self._of(first))

    def multiply(self, first: Pair, second: Pair) -> Pair:
        found = super().multiply(first, second)
        return self._noted("product", found, self._of(found) == self._of(first) * self._of(second))

    def function(self, name: str, value: Pair) -> tuple[Pair, str]:
        found, code = super().function(name, value)
        return self._noted(name, found, name == "SQRT" and self._of(found) ** 2 == self._of(value)), code

    def integer_power(self, base: Pair, count: int) -> tuple[Pair, str]:
        found, code = super().integer_power(base, count)
        same = 0 <= count <= 30 and self._of(found) == self._of(base) ** count
        return self._noted("power", found, same), code

    def power(self, base: Pair, exponent: Pair) -> tuple[Pair, str]:
        found, code = super().power(base, exponent)
        return self._noted("power", found, False), code

    def _of(self, value: Pair) -> Fraction:
        return Fraction(self.exact(value, 0))


def test_what_is_cut_is_noted() -> None:
    for line, cut in (("A=1.E60+3.", True), ("A=1.E20+3.", False), ("A=SQRT(2.)", True), ("A=SQRT(4.)", False)):
        watched = Watched(digit_profile("truncating:28"))
        Machine(program(line, "END"), deck_from_lines("d", []), Options(numbers=watched)).run()
        assert bool(watched.cuts) == cut


@settings(max_examples=60)
@given(programs(), DATA)
def test_long_decimals_exactly(cards: list[str], data: list[str]) -> None:
    """Where no digit is cut and no quotient is taken, 28 decimal digits and exact numbers punch the same cards."""
    whole = [card for card in cards if "/" not in card or "FORMAT" in card]
    statements = before_a_cut(whole, data, 200)
    (one, _), (other, _) = side_by_side(whole, data, (numbers("exact"), numbers("truncating:28")), statements)
    if isinstance(one, Result) and isinstance(other, Result) and one.ending.kind != "undecided" and not other.errors:
        assert one.punched == other.punched
        assert one.counts == other.counts


def before_a_cut(lines: list[str], data: list[str], statements: int) -> int:
    """How many of the statements 28 digits do before the first whose result has more."""
    watched = Watched(digit_profile("truncating:28"))
    made, _ = translate(source(*lines))
    if made is None:
        return statements
    operator = Operator(KEYED)
    machine = Machine(made, deck_from_lines("data", data), Options(numbers=watched, limit=FAR * statements))
    for done in range(statements):
        try:
            ended = until(machine, done + 1, operator)
        except EmulatorError:
            return statements
        if watched.cuts:
            return done
        if ended is not None:
            return statements
    return statements


@pytest.mark.parametrize("name", ["float64", "float32", "mp:24", "exact", "truncating"])
@settings(max_examples=15)
@given(cards=programs(ALL_FUNCTIONS, powers=True), data=DATA)
def test_every_run_ends_with_a_result_or_one_line(name: str, cards: list[str], data: list[str]) -> None:
    outcome, _ = ran(cards, data, Options(numbers=numbers(name), limit=1_000))
    if isinstance(outcome, Result):
        assert bool(outcome.ending.message) == (not outcome.ending.normal)
        assert "\n" not in outcome.ending.message
    else:
        assert "\n" not in outcome


def test_a_number_of_the_source_and_of_a_card_loses_no_digit() -> None:
    lines = ["READ 1,A", "B=.123456789012345", "IF(A-B)2,3,2", "2 STOP", "3 PUNCH 4,A", "1 FORMAT(F20.15)"]
    for name, kind in (("exact", "end"), ("mp:100", "end"), ("float64", "end")):
        result = results(name, *lines, "4 FORMAT(F18.15)", "END", data=(" .123456789012345",))
        assert result.ending.kind == kind
        assert result.punched == ("  .123456789012345",)
    short = Machine(program(*lines, "4 FORMAT(F18.15)", "END"), deck_from_lines("d", [" .123456789012345"])).run()
    assert short.punched == ("  .123456780000000",)


@pytest.mark.parametrize("name", ["exact", "float64", "float32", "mp:30", "mp:200"])
def test_a_card_shows_the_decimal_that_was_read(name: str) -> None:
    lines = ["READ 1,A", "PUNCH 1,A", "1 FORMAT(E14.8)", "END"]
    for text in (" .30000000E+00", "-.12345600E-17", " .70000000E-30", " .10000000E-37", " .00000000E-99"):
        assert results(name, *lines, data=(text,)).punched == (text.rstrip(),)


@pytest.mark.parametrize("name", ["exact", "float64", "mp:100"])
def test_output_cuts_and_does_not_round(name: str) -> None:
    lines = ["A=2./3.", "B=-A", "PUNCH 1,A,B,A", "1 FORMAT(2E14.8,F7.3)", "END"]
    assert results(name, *lines).punched == (" .66666666E+00-.66666666E+00   .666",)


@pytest.mark.parametrize("name", ["exact", "float64", "float32", "truncating"])
def test_the_sign_of_a_zero_follows_from_the_object_code(name: str) -> None:
    """``A-B*C`` is B*C minus A, reversed: a cancellation gives minus zero (docs/reference/machine.md)."""
    lines = ["A=6.", "B=2.", "C=3.", "D=A-B*C", "E=B*C-A", "F=-D", "PUNCH 1,D,E,F", "1 FORMAT(3E14.8)", "END"]
    assert results(name, *lines).punched == ("-.00000000E-99 .00000000E-99 .00000000E-99",)


def test_minus_zero_in_exact_numbers_is_zero_where_it_is_computed_with() -> None:
    lines = ["A=-0.", "Z=A+A", "Y=A*1.", "X=A", "IF(A)5,6,5", "5 STOP", "6 PUNCH 1,Z,Y,X", "1 FORMAT(3E14.8)", "END"]
    assert results("exact", *lines).punched == (" .00000000E-99 .00000000E-99-.00000000E-99",)


def test_fixed_point_is_the_machines_in_every_system() -> None:
    lines = ["K=9999", "K=K+2", "X=K", "M=12345.9", "L=-2.9", "PUNCH 1,K,X,M,L", "1 FORMAT(I5,F6.2,2I5)", "END"]
    for name in ("exact", "float64", "float32", "mp:60"):
        assert results(name, *lines).punched == ("    1  1.00 2345   -2",)


def test_an_undefined_number_stops_the_run() -> None:
    result = results("exact", "A=B+1.", "END")
    assert (result.ending.kind, result.ending.message) == (
        "undefined",
        "deck.f: card 1: B is undefined but is computed with, in A=B+1.",
    )


def test_bounds_and_copies_past_the_end() -> None:
    start = ["DIMENSION X(3)", "I=3", "X(3)=1."]
    assert results("float64", *start, "Y=X(I+1)", "END").ending.kind == "end"
    assert results("float64", *start, "Y=X(I+1)+1.", "END").ending.kind == "bounds"
    assert results("float64", *start, "I=5", "Y=X(I)", "END").ending.kind == "bounds"


def test_a_trace_shows_all_digits() -> None:
    file = io.StringIO()
    machine = Machine(program("A=1./3.", "B=1./8.", "END"), deck_from_lines("d", []), Options(numbers=numbers("exact")))
    tracer = Tracer(file)
    tracer.watch(machine.program, machine)
    machine.run()
    tracer.close()
    assert "A = 0.33333333333333333333..." in file.getvalue()
    assert "B = 0.125\n" in file.getvalue()


def test_a_batch_runs_over_numbers_too() -> None:
    made = program("READ 1,A", "B=A/3.*3.", "PUNCH 1,B", "1 FORMAT(E14.8)", "END")
    decks = [deck_from_lines("d", [text]) for text in ("2.", "1.")]
    options = Options(numbers=numbers("float64"))
    assert [r.punched for r in run_batch(made, decks, options)] == [(" .20000000E+01",), (" .10000000E+01",)]
    assert [r.punched for r in run_batch(made, decks)] == [(" .19999999E+01",), (" .99999999E+00",)]


@pytest.mark.parametrize("name", ["exact", "truncating", "truncating:20"])
def test_uncut_numbers_go_with_the_cards(name: str) -> None:
    """What one program punches uncut another reads whole; without the numbers beside it reads the columns."""
    found = numbers(name)
    hosting = Options(numbers=found, uncut=True)
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


def test_the_decimal_engine_keeps_numbers_uncut_as_well() -> None:
    options = Options(numbers=numbers("truncating:12"), uncut=True)
    made = program("A=1./3.", "PUNCH 1,A", "1 FORMAT(E14.8)", "END")
    result = Machine(made, deck_from_lines("d", []), options).run()
    assert result.uncut == (((1, 14, (333333333333, 0)),),)
    assert run_batch(made, [deck_from_lines("d", [])], options)[0] == result


def test_without_uncut_nothing_is_kept() -> None:
    result = results("exact", "A=1./3.", "PUNCH 1,A", "1 FORMAT(E14.8)", "END")
    assert result.uncut == ()
