"""What an operator does, as lines of a file, and where a machine stands, as one line: the words of the console.

And what is to be noted of a run when it is over.

One action a line, in capitals: ``ENTER 5``, ``START``, ``STEP 3``, ``STOP``, ``ATTN``, ``SWITCH 1 ON``, ``BREAK 40``,
``BREAK CARD 12``, ``CLEAR``.  ``AT n`` before one of them, but for ENTER and START, says that it is done to a running
machine, when n of work has been done (what ``--limit`` counts).  Of ENTER the line typed is all that follows one blank.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator

from emulator.errors import explanations
from emulator.language.objectcode import Line, Program
from emulator.machine.result import Result
from emulator.machine.session import Action, Halt

WORDS = ("ENTER", "START", "STEP", "STOP", "ATTN", "SWITCH", "BREAK", "CLEAR")

_RUNNING = ("STEP", "STOP", "ATTN", "SWITCH", "BREAK", "CLEAR")
_FORMS = {
    "START": "START",
    "STEP": "STEP, or STEP and a number",
    "STOP": "STOP",
    "ATTN": "AT, a number and ATTN",
    "SWITCH": "SWITCH, 1 to 4, ON or OFF",
    "BREAK": "BREAK and a statement's number, or BREAK CARD and a card's",
    "CLEAR": "CLEAR, CLEAR and a statement's number, or CLEAR CARD and a card's",
    "AT": f"AT, a number and one of {', '.join(_RUNNING)}",
}


def read_action(line: str) -> tuple[int | None, Action]:
    """An action, and the work before it where the line says ``AT``.  Raises ValueError with what is wrong."""
    word, *rest = line.split() or [""]
    if word == "ENTER":
        return None, Action("ENTER", text=line.partition("ENTER")[2][1:].rstrip())
    if word == "AT":
        at = _number(rest[0]) if len(rest) > 1 else None
        if at is None or rest[1] not in _RUNNING:
            raise ValueError(f"the form is {_FORMS['AT']}")
        return at, action(rest[1], rest[2:])
    if word == "ATTN":
        raise ValueError(f"the form is {_FORMS['ATTN']}")
    return None, action(word, rest)


def action(word: str, rest: list[str]) -> Action:
    """An action other than ENTER from its word and what follows.  Raises ValueError with what is wrong."""
    card = word in ("BREAK", "CLEAR") and rest[:1] == ["CARD"]
    numbers = [_number(text) for text in rest[card : card + 1]]
    number = numbers[0] if numbers else None
    after = rest[card + len(numbers) :]
    match word:
        case "START" | "STOP" | "ATTN" if not rest:
            return Action(word)
        case "STEP" if not rest or (number and not after):
            return Action("STEP", number or 1)
        case "SWITCH" if number in (1, 2, 3, 4) and after in (["ON"], ["OFF"]):
            return Action("SWITCH", number, on=after == ["ON"])
        case "BREAK" | "CLEAR" if number and not after:
            return Action(word, number, card=card)
        case "CLEAR" if not rest:
            return Action("CLEAR")
    if word in _FORMS:
        raise ValueError(f"the form is {_FORMS[word]}")
    raise ValueError(f"{word!r} is no word of an operator; they are {', '.join(WORDS)}, AT, LOAD")


def _number(text: str) -> int | None:
    return int(text) if text.isascii() and text.isdigit() and len(text) < 16 else None


def words_of(action: Action, at: int | None = None) -> str:
    """An action as :func:`read_action` reads it; START that nobody asked for is a comment."""
    if action.unasked:
        return "* nobody answers: START"
    text: str = action.word
    match action.word:
        case "ENTER":
            text += f" {action.text}"
        case "STEP":
            text += f" {action.number}" if action.number > 1 else ""
        case "SWITCH":
            text += f" {action.number} {'ON' if action.on else 'OFF'}"
        case "BREAK" | "CLEAR":
            text += f"{' CARD' if action.card else ''} {action.number}" if action.number else ""
    return text.rstrip() if at is None else f"AT {at} {text}"


def standing(halt: Halt) -> str:
    """Where a machine stands and why, in one line."""
    where = place_of(halt.line)
    match halt.what:
        case "accept":
            again = f"{halt.trouble}; the line is typed again: " if halt.trouble else ""
            return f"{again}ACCEPT waits for a line, {where}"
        case "pause":
            return f"PAUSE{f' {halt.number}' if halt.number else ''} waits for START, {where}"
    return f"stopped ({halt.why}) before {where}: {halt.line.text}"


def place_of(line: Line) -> str:
    """A statement by its number, if it has one, and its card."""
    card = f"card {line.place.card}"
    return f"statement {line.label} ({card})" if line.label else card


def notes(program: Program, result: Result, said: Collection[tuple[int, int]] = ()) -> Iterator[str]:
    """What is to be noted of a run, but for fields (card and column) said before, and its arithmetic's error codes."""
    for notice in result.notices:
        if notice.kind != "field" or (notice.card, notice.column) not in said:
            yield f"warning: {notice.message}"
    for error in result.errors:
        times = f", {error.times} times" if error.times > 1 else ""
        yield f"note: {program.source}: {error.code} on card {error.card}: {explanations()[error.code].title}{times}"
