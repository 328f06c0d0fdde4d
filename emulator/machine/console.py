"""The console of a halted machine: the commands that a person types, and their output.

The output is plain lines of text, wrapped to a given width.
"""

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
    "START": "START (or Enter): continue the run",
    "STEP": "STEP [N]: run one statement, or N statements",
    "STOP": "STOP: end the run and keep its output",
    "SWITCH": "SWITCH [N [ON or OFF]]: show, flip or set sense switches",
    "BREAK": "BREAK [N, CARD N or NAME]: show or set breakpoints",
    "CLEAR": "CLEAR [N, CARD N or NAME]: remove breakpoints",
    "VARIABLES": "VARIABLES [NAME]: show all variables, or one",
    "CORE": "CORE NAME or ADDRESS: show the storage around it",
    "CARDS": "CARDS: show the last card read and the last punched",
    "HELP": "HELP or ?: show the commands; all can be abbreviated",
}
_AROUND = 4


@dataclass
class Cards:
    """The last card read and the last card punched, taken from the events of a session."""

    read: str = ""
    punched: str = ""

    def see(self, events: Sequence[Event]) -> None:
        """Update the last card read and the last card punched from further events of the run."""
        for event in events:
            if event.what == "read":
                self.read = event.text
            elif event.what == "punch":
                self.punched = event.text


def command(session: Session, text: str, cards: Cards, width: int) -> Action | list[str]:
    """Interpret a line typed at the console.

    Return the requested action, or the lines to show, such as an error message.
    """
    # A command may be abbreviated, and an empty line means START.
    word, *operands = text.upper().replace("?", " HELP ").split() or ["START"]
    matches = [name for name in COMMANDS if name.startswith(word)]
    if len(matches) != 1:
        names = ", ".join(matches or COMMANDS)
        return wrapped(f"{word} {'is ambiguous' if matches else 'is not a command'}: {names}", width)
    (word,) = matches
    match word, operands:
        case "HELP", _:
            return [line for help_text in COMMANDS.values() for line in wrapped(help_text, width)]
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
    # The remaining commands are actions.  A command that is used incorrectly shows its help text.
    if word not in WORDS:
        return wrapped(COMMANDS[word], width)
    try:
        request = action(word, operands)
    except ValueError as error:
        return wrapped(str(error), width)
    if misfit := session.misfit(request):
        return wrapped(misfit, width)
    return request


def flipped(session: Session, number: int) -> Action:
    """Return the action that turns a sense switch on if it is off, and off if it is on."""
    return Action("SWITCH", number, on=not session.switches[number - 1])


def done(session: Session, line: Line, width: int) -> list[str]:
    """Return lines with the value that the last statement stored or tested, or no line if it did neither."""
    text = effect(session, line)
    return wrapped(text, width) if text else []


def wrapped(text: str, width: int) -> list[str]:
    """Return text as lines of at most ``width`` columns."""
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
    """Yield the columns of a card, blanks included, as lines of at most ``width`` columns."""
    for start in range(0, max(len(text), 1), width - 2):
        yield "  " + text[start : start + width - 2]


def _entries(session: Session) -> list[Entry]:
    return [entry for entry in session.program.storage.entries if entry.kind in ("variable", "array")]


def _variables(session: Session, width: int) -> Iterator[str]:
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
            shown = [n for n in fields if session.state.kinds[entry.first + n] != UNDEFINED] if entry.shape else fields
            lines = [f"{entry.element(n):<9} {contents(session, entry.first + n)}"[:width] for n in shown]
            return lines or [f"{name}: no element is defined"]
    return wrapped(f"{session.program.source} has no variable {name}", width)


def _core(session: Session, place: str, width: int) -> list[str]:
    """Return lines with the storage fields around a variable or address, in order of address.

    Addresses decrease as the numbers of array elements increase.
    """
    core = session.options.core
    # An address may be that of any digit of a field; fields are numbered downward from the top of core storage.
    if place.isascii() and place.isdigit() and len(place) < 6:
        field = (core - 1 - FUNCTION_NAMES - int(place)) // FIELD
    else:
        field = next(iter(session.program.storage.fields_of(place)), -1)
    if not 0 <= field < session.program.storage.fields:
        first, last = core_address(session.program.storage.fields - 1, core), core_address(0, core)
        return wrapped(f"{place} is neither a variable nor an address of data ({first} to {last})", width)
    name = session.program.storage.name_of
    return [
        f"{'>' if n == field else ' '} {core_address(n, core):05d} {name(n):<15} {contents(session, n)}"[:width]
        for n in range(field + _AROUND, field - _AROUND - 1, -1)
        if 0 <= n < session.program.storage.fields
    ]


def _switches(session: Session) -> str:
    return ", ".join(f"{n} {'ON' if on else 'OFF'}" for n, on in enumerate(session.switches, 1))


def _breakpoints(session: Session) -> str:
    lines = [session.program.statements[index] for index in sorted(session.breakpoints)]
    return ", ".join([*(place_of(line) for line in lines), *session.watched]) or "no breakpoints"
