"""Helpers for the tests of the emulator: make, compile and run decks from lines, and read fields of core."""

import signal
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager

import pytest

from emulator.compiled.batch import run_batch
from emulator.compiled.runner import BLOCK, Runner, packed, why_plain
from emulator.errors import Diagnostic, EmulatorError
from emulator.language import objectcode as op
from emulator.language.cards import Deck, deck_from_lines
from emulator.language.compiler import compile_deck, translate
from emulator.language.objectcode import Program
from emulator.machine.endings import Ending
from emulator.machine.machine import Machine, run_with_operator
from emulator.machine.operator import Operator
from emulator.machine.result import Options, Result
from emulator.machine.session import Session
from emulator.machine.state import FLOATING
from emulator.numbers import numbers
from emulator.numbers.arithmetic import FIXED_POINT, MINUS_ZERO, UNDEFINED, ZERO

MakeMachine = Callable[[Program, Deck, Options], Machine]


class ComparedMachine(Machine):
    """A machine whose run is compared with the compiled engine: the result, and every field of core afterwards."""

    def run(self) -> Result:
        pytest.importorskip("numba")
        result = super().run()
        runner = compiled_in_core(self.program, self.options)
        if runner is not None:
            (run,) = runner.runs([packed(self.deck)])
            if run is not None:
                core = list(zip(runner.core.mantissas.tolist(), runner.core.exponents.tolist(), strict=True))
                assert core == [pair(self, address) for address in range(self.program.storage.length)]
        assert run_batch(self.program, [self.deck], self.options) == (result,)
        return result


ENGINES: dict[str, MakeMachine] = {"plain": Machine, "compiled": ComparedMachine}
"""The engines that every vector runs on: a name, and a function that makes a machine."""


def compiled_in_core(program: Program, options: Options) -> Runner | None:
    """Return the compiled engine with a program in core, or None if the interpreter must run it."""
    return None if why_plain(options) else Runner(program, options)


def agreed(program: Program, decks: Sequence[Deck], options: Options) -> int:
    """Run decks on both engines, which must agree.  Return the number of decks that the compiled engine ran alone.

    A deck that raises an error must raise the same from both.
    """
    runner = compiled_in_core(program, options)
    alone = 0
    for start in range(0, len(decks), BLOCK):
        block = decks[start : start + BLOCK]
        runs = runner.runs([packed(deck) for deck in block]) if runner else iter([None] * len(block))
        alone += sum(run is not None for run in runs)
    results = []
    for deck in decks:
        try:
            results.append((deck, Machine(program, deck, options).run()))
        except EmulatorError as error:
            kind, message = type(error), str(error)
        else:
            continue
        with pytest.raises(kind) as caught:
            run_batch(program, [deck], options)
        assert str(caught.value) == message
    batch = run_batch(program, [deck for deck, _ in results], options)
    for (deck, expected), result in zip(results, batch, strict=True):
        assert result == expected, deck.text()
    return alone


def source(*lines: str) -> Deck:
    return deck_from_lines("deck.f", lines)


def program(*lines: str) -> Program:
    return compile_deck(source(*lines))


def diagnostics(*lines: str) -> tuple[Diagnostic, ...]:
    """Return all messages of the compiler, with warnings."""
    return translate(source(*lines))[1]


def errors(*lines: str) -> tuple[Diagnostic, ...]:
    """Return the messages of the compiler that are not warnings."""
    return tuple(d for d in diagnostics(*lines) if not d.warning)


def machine(
    *lines: str,
    data: Iterable[str] = (),
    keyboard: Iterable[str] = (),
    arithmetic: str = "truncating",
    limit: int = 100_000,
    bounds: str = "strict",
    switches: Iterable[int] = (),
    core: int = 40_000,
) -> Machine:
    """Return a machine with the program of ``lines`` in core and ``data`` in its hopper, not yet started."""
    options = Options(numbers=numbers(arithmetic), limit=limit, bounds=bounds, switches=frozenset(switches), core=core)
    return Machine(program(*lines), deck_from_lines("data.cards", data), options, tuple(keyboard))


def run(*lines: str, **setting: object) -> Result:
    """Compile ``lines``, run them, and return the result.  The settings are those of :func:`machine`."""
    return machine(*lines, **setting).run()


def until(session: Session, statements: int, operator: Operator | None = None) -> Ending | None:
    """Run until the given number of plain statements is done.  Return the ending if the run ended before, or None.

    Statements count as for the limit, but without the surcharge of costly operations: the same in every arithmetic.
    """
    while (remaining := statements - plain(session)) > 0:
        ending = run_with_operator(session, operator or Operator(), session.state.work + remaining)
        if ending is not None:
            return ending
    return None


def plain(session: Session) -> int:
    """Return the work of a session with every statement counted as one."""
    return session.state.work - session.state.costly


def punched(*lines: str, **setting: object) -> tuple[str, ...]:
    """Run a program and return the cards it punched.  Fail if the run did not end normally."""
    result = run(*lines, **setting)
    assert result.ending.normal, result.ending.message
    return result.punched


def code(*lines: str) -> list[str]:
    """Return the object code of a deck as ``TOFAC A``, ``RSGN`` and so on, without COUNT."""
    made = program(*lines)
    listing = []
    for instruction in made.code:
        if instruction.operation == op.COUNT:
            continue
        operation = op.NAMES[instruction.operation]
        if instruction.operation < op.COUNT or instruction.operation in (op.POWER, op.POWERX):
            operation += " " + made.storage.name_of(instruction.address)
        listing.append(operation)
    return listing


def pair(of: Machine, address: int) -> tuple[int, int]:
    """Return a field of core as mantissa and exponent (emulator/numbers/arithmetic.py)."""
    value, kind = of.state.values[address], of.state.kinds[address]
    return value if kind == FLOATING else (value, kind)


def number(of: Machine, name: str) -> str:
    """Return a field of core by its name: all digits of a floating number, ``-0``, ``undefined``, or an integer."""
    entry = next(e for e in of.program.storage.entries if e.kind == "variable" and e.name == name)
    mantissa, exponent = pair(of, entry.first)
    if exponent == UNDEFINED:
        return "undefined"
    if exponent == FIXED_POINT:
        return str(mantissa)
    if mantissa == 0:
        return {ZERO: "0", MINUS_ZERO: "-0"}[exponent]
    digits = of.options.numbers.digits
    assert 10 ** (digits - 1) <= abs(mantissa) < 10**digits, "a number in core is normalised"
    return f"{'-' if mantissa < 0 else ''}.{abs(mantissa)}E{exponent:+03d}"


class Hung(Exception):
    """A call that did not return in time."""


@contextmanager
def within(seconds: float) -> Iterator[None]:
    """Raise Hung inside the block if it takes longer than ``seconds``."""

    def ring(*_: object) -> None:
        raise Hung(f"not done after {seconds} s")

    before = signal.signal(signal.SIGALRM, ring)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
