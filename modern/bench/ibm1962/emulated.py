"""Execute an input or output statement with the emulator's arithmetic ``ibm1962``, for comparison with the library."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from emulator.language.cards import deck_from_lines
from emulator.language.compiler import compile_deck
from emulator.language.objectcode import Program
from emulator.machine.result import Options
from emulator.machine.session import Action, Session
from emulator.numbers import numbers
from emulator.numbers.arithmetic import MINUS_ZERO, ZERO, is_negative
from modern.bench.ibm1962.statements import Outcome, Statement

OPTIONS = Options(numbers=numbers("ibm1962"), core=60000)
DIGITS = 8

# The number of columns of a card that hold a statement.
STATEMENT = 66


def source(statement: Statement) -> list[str]:
    """Return the cards of a program that reads the numbers of the statement's list and executes the statement once."""
    names = [("A" if "." in value else "K") + str(k) for k, value in enumerate(statement.values)]
    lines = [f"      READ {2 if name[0] == 'A' else 3},{name}" for name in names]
    lines += _cards("", f"{statement.verb} 1" + "".join(f",{name}" for name in names))
    lines += _cards("    1", f"FORMAT{statement.text}")
    return [*lines, "    2 FORMAT(E14.8)", "    3 FORMAT(I5)", "      STOP", "      END"]


def _cards(label: str, text: str) -> Iterator[str]:
    for k in range(0, len(text), STATEMENT):
        yield f"{label if k == 0 else '     1':6}{text[k : k + STATEMENT]}"


def emulate(statement: Statement, *, cards: Sequence[str] = ()) -> Outcome:
    """Execute a statement with the emulator.  ``cards`` are its data cards or, for ACCEPT, the lines to be typed."""
    program = compile_deck(deck_from_lines("statement", source(statement)))
    keyed = statement.verb == "ACCEPT"
    deck = deck_from_lines("deck", [*map(_card, statement.values), *(() if keyed else cards)])
    session = Session(program, deck, OPTIONS)
    waiting = list(cards)
    while (state := session.advance(OPTIONS.limit)) is None or getattr(state, "what", "") == "accept":
        if state is not None:
            session.act(Action("ENTER", text=waiting.pop(0)))
    result = session.result(state)  # type: ignore[arg-type]
    punched = tuple(card.ljust(80) for card in result.punched)
    values = tuple(_texts(program, session, len(statement.values)))
    return Outcome(result.typed, punched, values, result.ending.message)


def _card(value: str) -> str:
    # Blanks after a number are zeros, so that it must end in the last column of its field.
    return f"{value:>14}" if "." in value else f"{value:>5}"


def _texts(program: Program, session: Session, count: int) -> Iterator[str]:
    entries = {entry.name: entry.first for entry in program.storage.entries}
    for k in range(count):
        fixed = f"K{k}" in entries
        value = session.state.values[entries[f"{'K' if fixed else 'A'}{k}"]]
        yield f"{'-' if is_negative(value) else ''}{abs(value):04}" if fixed else floating_text(*value)


def floating_text(mantissa: int, exponent: int) -> str:
    """Return a floating-point number in the notation of a storage field, such as ``-.25000000E+01``."""
    minus = "-" if mantissa < 0 or exponent == MINUS_ZERO else ""
    exponent = ZERO if mantissa == 0 else exponent
    return f"{minus}.{abs(mantissa):0{DIGITS}}E{'-' if exponent < 0 else '+'}{abs(exponent):02}"
