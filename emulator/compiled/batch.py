"""Many decks through one program: by the compiled engine where it can, deck by deck in the plain one where not.

The results are those of :class:`emulator.machine.machine.Machine`, deck for deck.  Decks are taken in blocks, so that
memory does not grow with their number.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from itertools import islice
from typing import TypeVar

from emulator.compiled import devices
from emulator.compiled import kernel as engine
from emulator.compiled.engine import INSTEAD, why_plain
from emulator.compiled.jit import NotInstalled
from emulator.compiled.runner import BLOCK, WAYS, Run, Runner, packed, packed_text
from emulator.language.cards import Deck, deck_from_text
from emulator.language.objectcode import Program
from emulator.machine.endings import begun, error_counts, looped, pausing, stopped
from emulator.machine.machine import Machine
from emulator.machine.result import Ending, Event, Options, Result

T = TypeVar("T")
Note = Callable[[str], None]
"""Takes one line for the user."""


def run_batch(
    program: Program, decks: Iterable[Deck], options: Options | None = None, note: Note | None = None
) -> tuple[Result, ...]:
    """The result of each deck, as :meth:`emulator.machine.machine.Machine.run` gives it.  Raises what that raises.

    ``note`` is told, once, why the compiled engine cannot be used, if it cannot.
    """
    return tuple(results(program, decks, options, note))


def results(
    program: Program, decks: Iterable[Deck], options: Options | None = None, note: Note | None = None
) -> Iterator[Result]:
    """As :func:`run_batch`, one result after the other as they are asked for."""
    options = options or Options()
    runner = _runner(program, options, note)
    for block in _blocks(decks):
        runs = runner.runs([packed(deck) for deck in block]) if runner else iter([None] * len(block))
        for deck, run in zip(block, runs, strict=True):
            yield Machine(program, deck, options).run() if run is None else _result(program, deck, options, run)


def punched(
    program: Program, texts: Iterable[str], options: Options | None = None, note: Note | None = None
) -> Iterator[str]:
    """The cards each deck has punched: text in and text out, one card a line.

    Raises what :func:`emulator.language.cards.deck_from_text` and :meth:`emulator.machine.machine.Machine.run` raise.
    """
    options = options or Options()
    runner = _runner(program, options, note)
    for block in _blocks(texts):
        runs = runner.runs([packed_text(text) for text in block]) if runner else iter([None] * len(block))
        for text, run in zip(block, runs, strict=True):
            if run is None:
                cards = Machine(program, deck_from_text("deck", text), options).run().punched
                yield "".join(card + "\n" for card in cards)
            else:
                yield "".join(line[1:] + "\n" for line in run.lines() if line[0] == "P")


def _blocks(items: Iterable[T]) -> Iterator[list[T]]:
    source = iter(items)
    while block := list(islice(source, BLOCK)):
        yield block


def _runner(program: Program, options: Options, note: Note | None) -> Runner | None:
    why = why_plain(options)
    if not why:
        try:
            return Runner(program, options)
        except NotInstalled as error:
            why = f"{error}: {INSTEAD}"
    if note is not None:
        note(why)
    return None


def _result(program: Program, deck: Deck, options: Options, run: Run) -> Result:
    lines: dict[str, list[str]] = {"P": [], "T": []}
    events: list[Event] = []
    cards = iter(deck.cards)
    for line in run.lines():
        letter, text = line[0], line[1:]
        if letter == "B":
            events.append(Event("begin"))
        elif letter == "R":
            events.append(Event("read", next(cards).text))
        else:
            lines[letter].append(text)
            events.append(Event("punch" if letter == "P" else "type", text))
    errors: dict[tuple[str, int], int] = {}
    for at, times in run.errors:
        statement, number = divmod(at, devices.CODES)
        key = "F8" if number == devices.F8 else f"E{number}", program.statements[statement].place.card
        errors[key] = errors.get(key, 0) + times
    return Result(
        punched=tuple(lines["P"]),
        typed=tuple(lines["T"]),
        ending=_ending(program, options, run),
        events=tuple(events),
        warnings=tuple(pausing(program, statement) for statement in run.pauses),
        statements=begun(program, run.counts),
        counts=tuple(run.counts),
        cards_read=run.cards_read,
        numbers=tuple((way, n) for way, n in zip(WAYS, run.numbers, strict=True) if n),
        errors=error_counts(errors),
    )


def _ending(program: Program, options: Options, run: Run) -> Ending:
    if run.reason == devices.AT_HOPPER:
        return Ending("hopper")
    if run.reason == engine.AT_LIMIT:
        return looped(program, options.limit, run.before, run.counts)
    return stopped(program, run.reason, run.registers, run.held)
