"""The words of the console: actions of the operator, halts, and warnings about a run, as lines of text.

A file of actions has one action in capitals on each line: ``ENTER 5``, ``START``, ``STEP 3``, ``STOP``, ``ATTN``,
``SWITCH 1 ON``, ``BREAK 40``, ``BREAK CARD 12``, ``BREAK NE``, ``CLEAR``.  An action other than ENTER and START may
follow the words ``AT n``.  It is then performed on the running machine when n units of work are done, as ``--limit``
counts them.  ENTER is followed by one blank and the text to type.
"""

import re
from collections.abc import Collection, Iterator

from emulator.errors import explanations, quoted
from emulator.language.objectcode import Line, Program
from emulator.machine.result import Result
from emulator.machine.session import Action, Halt

WORDS = ("ENTER", "START", "STEP", "STOP", "ATTN", "SWITCH", "BREAK", "CLEAR")

_VARIABLE = re.compile(r"[A-Z][A-Z0-9]{0,4}(\(\d{1,4}(,\d{1,4})?\))?")
_RUNNING = ("STEP", "STOP", "ATTN", "SWITCH", "BREAK", "CLEAR")
_FORMS = {
    "START": "START",
    "STEP": "STEP, or STEP and a number",
    "STOP": "STOP",
    "ATTN": "AT, a number and ATTN",
    "SWITCH": "SWITCH, 1 to 4, ON or OFF",
    "BREAK": "BREAK and a statement number, CARD and a card number, or a variable",
    "CLEAR": "CLEAR alone, or with a statement number, CARD and a card number, or a variable",
    "AT": f"AT, a number and one of {', '.join(_RUNNING)}",
}


def read_action(line: str) -> tuple[int | None, Action]:
    """Read a line of an operator's file.  Return the amount of work after which to act, or None, and the action.

    The amount of work is the number n of ``AT n`` at the beginning of the line.  Raise ValueError with a message for an
    invalid line.
    """
    word, *operands = line.split() or [""]
    if word == "ENTER":
        return None, Action("ENTER", text=line.partition("ENTER")[2][1:].rstrip())
    if word == "AT":
        at = _number(operands[0]) if len(operands) > 1 else None
        if at is None or operands[1] not in _RUNNING:
            raise ValueError(f"expected {_FORMS['AT']}")
        return at, action(operands[1], operands[2:])
    if word == "ATTN":
        raise ValueError(f"expected {_FORMS['ATTN']}")
    return None, action(word, operands)


def action(word: str, operands: list[str]) -> Action:
    """Return the action that a word other than ENTER and its operands denote.  Raise ValueError if they are invalid."""
    # Operands are an optional CARD, an optional number and, for SWITCH, ON or OFF.
    card = word in ("BREAK", "CLEAR") and operands[:1] == ["CARD"]
    numbers = [_number(text) for text in operands[card : card + 1]]
    number = numbers[0] if numbers else None
    following = operands[card + len(numbers) :]
    match word:
        case "START" | "STOP" | "ATTN" if not operands:
            return Action(word)
        case "STEP" if not operands or (number and not following):
            return Action("STEP", number or 1)
        case "SWITCH" if number in (1, 2, 3, 4) and following in (["ON"], ["OFF"]):
            return Action("SWITCH", number, on=following == ["ON"])
        case "BREAK" | "CLEAR" if number and not following:
            return Action(word, number, card=card)
        case "BREAK" | "CLEAR" if len(operands) == 1 and not card and _VARIABLE.fullmatch(operands[0]):
            return Action(word, name=operands[0])
        case "CLEAR" if not operands:
            return Action("CLEAR")
    if word in _FORMS:
        raise ValueError(f"expected {_FORMS[word]}")
    raise ValueError(f"{quoted(word)} is not an action; the actions are {', '.join(WORDS)}, AT, LOAD")


def _number(text: str) -> int | None:
    return int(text) if text.isascii() and text.isdigit() and len(text) < 16 else None


def action_line(action: Action, at: int | None = None) -> str:
    """Return an action as a line that :func:`read_action` reads.  An automatic START becomes a comment."""
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
            text += f"{' CARD' if action.card else ''} {action.number}" if action.number else f" {action.name}"
    return text.rstrip() if at is None else f"AT {at} {text}"


def halt_line(halt: Halt) -> str:
    """Return one line that says where and why a machine has halted."""
    where = place_of(halt.line)
    match halt.what:
        case "accept":
            again = f"{halt.trouble}; the line is typed again: " if halt.trouble else ""
            return f"{again}ACCEPT waits for a line, {where}"
        case "pause":
            return f"PAUSE{f' {halt.number}' if halt.number else ''} waits for START, {where}"
    return f"stopped ({halt.why}) before {where}: {halt.line.text}"


def place_of(line: Line) -> str:
    """Return the card of a statement, with its statement number if it has one, as text."""
    card = f"card {line.place.card}"
    return f"statement {line.label} ({card})" if line.label else card


def notes(program: Program, result: Result, reported: Collection[tuple[int, int]] = ()) -> Iterator[str]:
    """Yield the messages after a run: its warnings, its error codes, and a note if it ended because no card was left.

    ``reported`` holds the card and column of each field about which the caller has already warned.
    """
    for notice in result.notices:
        if notice.kind != "field" or (notice.card, notice.column) not in reported:
            yield f"warning: {notice.message}"
    if result.ending.kind == "hopper" and result.ending.any_read:
        cards = f"{result.cards_read} card{'s' * (result.cards_read != 1)}"
        yield f"note: {program.source}: the run ended after reading {cards}, because {result.ending.outcome}"
    for error in result.errors:
        times = f", {error.times} times" if error.times > 1 else ""
        yield f"note: {program.source}: {error.code} on card {error.card}: {explanations()[error.code].title}{times}"
