"""Run one program on many decks, with the compiled engine if possible and otherwise with the interpreter.

For each deck, the result equals that of :class:`emulator.machine.machine.Machine`.  The decks are processed in blocks,
so that memory does not grow with their number.
"""

from collections.abc import Callable, Iterable, Iterator
from itertools import islice
from typing import TypeVar

from emulator.compiled import devices, kernel
from emulator.compiled.runner import BLOCK, INSTEAD, WAYS, Run, Runner, packed, packed_text, why_plain
from emulator.errors import ArgumentError, expect
from emulator.jit.functions import NotInstalled
from emulator.language.cards import Deck, deck_from_text
from emulator.language.objectcode import Program
from emulator.machine.endings import Ending, Notice, decided, ended_by, looped
from emulator.machine.interpreter import AT_LIMIT
from emulator.machine.machine import Machine
from emulator.machine.result import Event, Options, Result, machine_errors, statements_begun

T = TypeVar("T")
# A function that receives one line for the user.
Note = Callable[[str], None]


def run_batch(
    program: Program, decks: Iterable[Deck], options: Options | None = None, note: Note | None = None
) -> tuple[Result, ...]:
    """Run a program over many decks and return the result of each deck.

    Parameters
    ----------
    note
        A function that receives one line with the reason if the compiled engine cannot be used.

    Raises
    ------
    CardError, DeckError
        For the first deck with an error, as in :meth:`emulator.machine.machine.Machine.run`.
    """
    expect(program, Program, "program")
    try:
        decks = iter(decks)
    except TypeError:
        raise ArgumentError(f"decks: expected a list of decks, found {type(decks).__name__}") from None
    expect(options, (Options, type(None)), "options")
    options = options or Options()
    runner = _runner(program, options, note)
    results: list[Result] = []
    for block in _blocks(decks):
        for deck in block:
            expect(deck, Deck, "deck")
        runs = runner.runs([packed(deck) for deck in block]) if runner else iter([None] * len(block))
        for deck, run in zip(block, runs, strict=True):
            results.append(
                Machine(program, deck, options).run() if run is None else _result(program, deck, options, run)
            )
    return tuple(results)


def punched(
    program: Program, texts: Iterable[str], options: Options | None = None, note: Note | None = None
) -> Iterator[str]:
    """Run a program on many decks, and yield the text of the cards that it punches for each deck.

    ``texts`` are the decks as texts.  Each text, also a yielded one, has one card on each line.  Raise what
    :func:`emulator.language.cards.deck_from_text` and :meth:`emulator.machine.machine.Machine.run` raise.
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
    """Return the compiled engine with this program, or None after telling ``note`` why it cannot be used."""
    reason = why_plain(options)
    if not reason:
        try:
            return Runner(program, options)
        except NotInstalled as error:
            reason = f"{error}: {INSTEAD}"
    if note is not None:
        note(reason)
    return None


def _result(program: Program, deck: Deck, options: Options, run: Run) -> Result:
    lines: dict[str, list[str]] = {"P": [], "T": []}
    events: list[Event] = []
    cards = iter(deck.cards)
    # Each line of the log is a letter (BEGUN, TAKEN, PUNCHED, TYPED of emulator/compiled/devices.py) and a text.
    for line in run.lines():
        letter, text = line[0], line[1:]
        if letter == "B":
            events.append(Event("begin"))
        elif letter == "R":
            events.append(Event("read", next(cards).text))
        elif letter == "P":
            lines["P"].append(text)
            events.append(Event("punch", text))
        else:
            # The text of a typed line follows the numbers of its statement and of the last decision.
            statement, decision = int(text[: devices.STAMP]), int(text[devices.STAMP : 2 * devices.STAMP])
            text = text[2 * devices.STAMP :]
            lines["T"].append(text)
            events.append(Event("type", text, program.statements[statement], decided(program, decision)))
    # The kernel counts the error codes of each statement, but the result counts those of each card.
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
        notices=tuple(Notice("pause", program.source, program.statements[statement]) for statement in run.pauses),
        statements=statements_begun(program, run.counts),
        counts=tuple(run.counts),
        cards_read=run.cards_read,
        cards_punched=len(lines["P"]),
        characters_typed=sum(len(line) + 1 for line in lines["T"]),
        numbers=tuple((way, n) for way, n in zip(WAYS, run.numbers, strict=True) if n),
        errors=machine_errors(errors),
    )


def _ending(program: Program, options: Options, run: Run) -> Ending:
    registers = run.registers
    at, decision, costly = registers[kernel.AT], registers[kernel.DECISION], registers[kernel.COSTLY]
    if run.reason == devices.AT_HOPPER:
        return Ending("hopper", program.source, program.line_at(at), any_read=options.hopper == "any")
    if run.reason == AT_LIMIT:
        return looped(program, options.limit, run.before, run.counts, decision, costly)
    address, subscripts = registers[kernel.ADDRESS], (registers[kernel.INDEX], registers[kernel.INDEX2])
    return ended_by(run.reason, program, options.limit, at, decision, address, run.held, subscripts, costly)
