"""The console of a machine that stands: what a person types there, and what he is shown.

Everything is plain lines of text no wider than asked, for whatever shows them.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from emulator.language.objectcode import Line
from emulator.language.storage import FIELD, FUNCTION_NAMES, Entry, core_address
from emulator.machine.result import Event
from emulator.machine.session import Action, Session
from emulator.machine.trace import contents, effect
from emulator.machine.words import WORDS, action, place_of
from emulator.numbers.arithmetic import UNDEFINED

COMMANDS = {
    "START": "START (or Enter): the machine goes on",
    "STEP": "STEP [N]: it does one statement, or N",
    "STOP": "STOP: the run ends; what was done is kept",
    "SWITCH": "SWITCH [N [ON or OFF]]: shows, flips, sets sense switches",
    "BREAK": "BREAK [N or CARD N]: shows, sets breakpoints",
    "CLEAR": "CLEAR [N or CARD N]: takes breakpoints away",
    "VARIABLES": "VARIABLES [NAME]: all variables, or one with its elements",
    "CORE": "CORE NAME or ADDRESS: the storage around it",
    "CARDS": "CARDS: the card read last and the card punched last",
    "HELP": "HELP or ?: these words; the first letters will do",
}
_AROUND = 4


@dataclass
class Cards:
    """The card read last and the card punched last, as events tell."""

    read: str = ""
    punched: str = ""

    def see(self, events: Sequence[Event]) -> None:
        """Take further events, in order."""
        for event in events:
            if event.what == "read":
                self.read = event.text
            elif event.what == "punch":
                self.punched = event.text


def command(session: Session, text: str, cards: Cards, width: int) -> Action | list[str]:
    """What a line typed at the console does: an action, or lines to be shown, wrong words among them."""
    word, *rest = text.upper().replace("?", " HELP ").split() or ["START"]
    found = [name for name in COMMANDS if name.startswith(word)]
    if len(found) != 1:
        words = ", ".join(found or COMMANDS)
        return wrapped(f"{word} {'may be' if found else 'is none of'} {words}", width)
    (word,) = found
    match word, rest:
        case "HELP", _:
            return [line for words in COMMANDS.values() for line in wrapped(words, width)]
        case "CARDS", []:
            return list(_cards(session, cards, width))
        case "VARIABLES", []:
            return list(_variables(session, width))
        case "VARIABLES", [name]:
            return _named(session, name, width)
        case "CORE", [place]:
            return _core(session, place, width)
        case "SWITCH", []:
            return [_switches(session)]
        case "SWITCH", [("1" | "2" | "3" | "4") as number]:
            return flipped(session, int(number))
        case "BREAK", []:
            return wrapped(_breakpoints(session), width)
    if word not in WORDS:
        return wrapped(COMMANDS[word], width)
    try:
        done = action(word, rest)
    except ValueError as error:
        return wrapped(str(error), width)
    if done.word in ("BREAK", "CLEAR") and done.number and not session.places(done):
        return wrapped(f"{session.program.source} has nothing to run there", width)
    return done


def flipped(session: Session, number: int) -> Action:
    """The action that flips a sense switch."""
    return Action("SWITCH", number, on=not session.switches[number - 1])


def done(session: Session, line: Line, width: int) -> list[str]:
    """What the statement just done did; nothing for one that has nothing to show."""
    text = effect(session, line)
    return wrapped(text, width) if text else []


def wrapped(text: str, width: int) -> list[str]:
    """Text as lines of at most ``width`` columns."""
    return textwrap.wrap(text, width, subsequent_indent="  ", break_on_hyphens=False)


def _cards(session: Session, cards: Cards, width: int) -> Iterator[str]:
    devices = session.devices
    yield from wrapped(f"read: {devices.position} of {len(session.deck.cards)} cards", width)
    if devices.position:
        yield from _chunks(cards.read, width)
    yield f"punched: {devices.punched}"
    if devices.punched:
        yield from _chunks(cards.punched, width)


def _chunks(text: str, width: int) -> Iterator[str]:
    """A card cut to the width, blanks and all."""
    for start in range(0, max(len(text), 1), width - 2):
        yield "  " + text[start : start + width - 2]


def _entries(session: Session) -> list[Entry]:
    return [entry for entry in session.program.storage.entries if entry.kind in ("variable", "array")]


def _variables(session: Session, width: int) -> Iterator[str]:
    """Every variable with its value; of an array how many elements are defined."""
    for entry in _entries(session):
        if entry.shape:
            kinds = session.state.kinds[entry.first : entry.first + entry.size]
            defined = sum(kind != UNDEFINED for kind in kinds)
            shape = ",".join(map(str, entry.shape))
            yield from wrapped(f"{entry.name}({shape}): {defined} of {entry.size} defined", width)
        else:
            yield f"{entry.name:<6} {contents(session, entry.first)}"[:width]


def _named(session: Session, name: str, width: int) -> list[str]:
    for entry in _entries(session):
        if entry.name == name:
            fields = range(entry.size)
            held = [n for n in fields if session.state.kinds[entry.first + n] != UNDEFINED] if entry.shape else fields
            lines = [f"{entry.element(n):<9} {contents(session, entry.first + n)}"[:width] for n in held]
            return lines or [f"{name}: nothing is defined"]
    return wrapped(f"{session.program.source} has no variable {name}", width)


def _core(session: Session, place: str, width: int) -> list[str]:
    """The fields around one, in order of addresses, which is the other way round than that of elements."""
    core = session.options.core
    if place.isascii() and place.isdigit() and len(place) < 6:
        field = (core - 1 - FUNCTION_NAMES - int(place)) // FIELD
    else:
        field = _field(session, place)
    if not 0 <= field < session.program.storage.fields:
        first, last = core_address(session.program.storage.fields - 1, core), core_address(0, core)
        return wrapped(f"{place} is no variable, and no address of data: {first} to {last}", width)
    name = session.program.storage.name_of
    return [
        f"{'>' if n == field else ' '} {core_address(n, core):05d} {name(n):<15} {contents(session, n)}"[:width]
        for n in range(field + _AROUND, field - _AROUND - 1, -1)
        if 0 <= n < session.program.storage.fields
    ]


def _field(session: Session, place: str) -> int:
    """The field of ``NAME``, ``NAME(2)`` or ``NAME(2,1)``; -1 where there is none."""
    parts = re.fullmatch(r"([A-Z][A-Z0-9]*)(?:\((\d{1,4})(?:,(\d{1,4}))?\))?", place)
    for entry in _entries(session) if parts else ():
        if parts and entry.name == parts[1]:
            subscripts = [int(text) for text in parts.groups()[1:] if text]
            rows = entry.shape[0] if entry.shape else 0
            if not subscripts:
                return entry.first
            if len(subscripts) == len(entry.shape) and all(
                1 <= n <= most for n, most in zip(subscripts, entry.shape, strict=True)
            ):
                return entry.first + subscripts[0] - 1 + (rows * (subscripts[1] - 1) if len(subscripts) > 1 else 0)
    return -1


def _switches(session: Session) -> str:
    return ", ".join(f"{n} {'ON' if on else 'OFF'}" for n, on in enumerate(session.switches, 1))


def _breakpoints(session: Session) -> str:
    lines = [session.program.statements[index] for index in sorted(session.breakpoints)]
    return ", ".join(place_of(line) for line in lines) or "no breakpoints"
