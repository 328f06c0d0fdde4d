"""Why each row of the listings' apparatus must stand: five grounds, each of them tested.

``parse``: without the row the deck does not compile.  ``print``: without it a printed result that came out
comes out no more.  ``deck``: without it a named data deck gives other cards.  ``forced``: with it the card
is a sibling card with names exchanged, and without it is not.  ``cosmetic``: with or without it the object
code is the same.

A row of several steps (:mod:`modern.edition.readings`) needs each: without any one of them the ground must fail.

A row of a layer the committed decks are built without is judged with its layer switched on, in all three
programs, and with the layers its ground names: all rows of the layer against all but this one.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache

from emulator.errors import CompileError, EmulatorError
from emulator.language.cards import Deck, deck_from_text
from emulator.language.compiler import compile_deck
from emulator.language.objectcode import Program
from emulator.language.parser import parse
from emulator.language.statements import sources
from emulator.machine.endings import Ending
from emulator.machine.result import LOOP_WINDOW, Options
from modern.edition import chapter6, programs
from modern.edition.apparatus import Row, built_without
from modern.edition.readings import Step, steps, without_step
from modern.edition.reproduce import EXACT, State, reproduce
from modern.thesis.job import run_hull

LISTED = Options(limit=200_000)
LAYERED = Options(limit=1_000_000, core=60_000)
"""The later layers' tables and cards need a machine of 60,000 positions."""
PATIENCE = 4
"""A job that has not ended after so many times the statements it takes with the row is another."""


@dataclass(frozen=True, slots=True)
class Proof:
    """What a check gave: the row or deck, whether it holds, and in words what was seen."""

    subject: str
    holds: bool
    words: str


def check_decks() -> Iterator[Proof]:
    """Whether witness and rows build each committed deck, character by character."""
    for entry in programs.BUILT_INS:
        built, committed = programs.built(entry.name), programs.committed(entry.name)
        same = built.text() == committed.text()
        compiles = _compiles(entry.name, built, same)
        rows = sum(row.layer in entry.layers for row in programs.text(entry.text).rows)
        yield Proof(
            f"{entry.name}.f",
            same and compiles,
            f"{len(built.cards)} cards {'are' if same else 'ARE NOT'} witness and {rows} rows"
            + ("" if compiles else ", and do NOT compile"),
        )


def _compiles(name: str, built: Deck, same: bool) -> bool:
    try:
        # What every row is judged by is compiled once.
        return bool(programs.program(name) if same else compile_deck(built))
    except CompileError:
        return False


def check_row(row: Row) -> Proof:
    """Whether a row's ground holds."""
    kind = str(row.ground.get("kind", ""))
    test = {"parse": _parse, "print": _print, "deck": _deck, "forced": _forced, "cosmetic": _cosmetic}.get(kind)
    if test is None:
        return Proof(row.id, False, f"names no ground (it says {kind!r})")
    holds, words = test(row, None)
    if holds and row.layer == "ocr":
        for step in _each(row):
            if not test(row, step)[0]:
                return Proof(row.id, False, f"{kind}: {step.pair.lemma!r} for {step.pair.witness!r} is not needed")
    return Proof(row.id, holds, f"{kind}: {words}")


def _each(row: Row) -> tuple[Step, ...]:
    """The steps of a row that has several; a single one is the row."""
    made = steps(row) or ()
    return made if len(made) > 1 else ()


def _name(row: Row) -> str:
    """The built-in program a row is judged by: the one its ground names, else the plain listing."""
    return str(row.ground.get("program", "program1_examples" if row.layer == "examples" else row.text))


def layers_for(row: Row) -> tuple[str, ...]:
    """The layers switched on to judge a row: none for one of the committed decks, else its own and those it names."""
    if row.layer in programs.built_in(_name(row)).layers:
        return ()
    return (row.layer, *(str(layer) for layer in row.ground.get("layers", ())))


def _built(row: Row) -> Deck:
    return programs.built(_name(row), layers_for(row))


def _without(row: Row, step: Step | None) -> Deck:
    """The deck without a row and those that cannot stand without it, or without one step of the row."""
    if step is None:
        return programs.built(_name(row), layers_for(row), _lost(row))
    return programs.built(_name(row), layers_for(row), (), without_step(row, step))


def _lost(row: Row) -> frozenset[str]:
    return built_without(programs.text(row.text), row.id)[0]


def _compiled(row: Row, step: Step | None) -> tuple[Program | None, str]:
    """The program without the row, or without a step of it; or why there is none."""
    try:
        return _program(_without(row, step))
    except EmulatorError as error:
        return None, str(error)


def _program(deck: Deck) -> tuple[Program | None, str]:
    """A deck's program, or the compiler's first message where there is none.  Raises DeckError for an empty deck."""
    try:
        return compile_deck(deck), ""
    except CompileError as error:
        return None, error.diagnostics[0].message


def _whole(row: Row) -> Program:
    """The program with the row, as it is built in where it is of a committed deck."""
    return programs.with_layers(_name(row), layers_for(row))


def _parse(row: Row, step: Step | None) -> tuple[bool, str]:
    try:
        deck = _without(row, step)
        wrong = [message for message in parse(deck).diagnostics if not message.warning]
        message = wrong[0].message if wrong else _program(deck)[1]
    except EmulatorError as error:
        message = str(error)
    if message:
        return True, f"without it: {message}"
    return False, "without it the deck still compiles"


def _cosmetic(row: Row, step: Step | None) -> tuple[bool, str]:
    whole = _whole(row)
    program, message = _compiled(row, step)
    if program is None:
        return False, f"without it the deck does not compile: {message}"
    same = program.code == whole.code and program.formats == whole.formats
    return same, f"the object code is {'the same with and without it' if same else 'another without it'}"


def _print(row: Row, step: Step | None) -> tuple[bool, str]:
    name = _name(row)
    number = programs.built_in(name).number
    state: State = "listing" if name == "program1" else "examples"
    examples = row.ground.get("examples", ())
    if not examples:
        return False, "names no example"
    program, message = _compiled(row, step)
    if program is None:
        return False, f"without it the deck does not compile: {message}"
    for example in examples:
        with_row, without_row = _printed(example, state, number), _exact(example, state, number, {name: program})
        if not with_row or without_row:
            words = ["exact" if exact else "not exact" for exact in (with_row, without_row)]
            return False, f"example {example}, program {number}: {words[0]} with it, {words[1]} without"
    return True, f"example {', '.join(map(str, examples))} is exact with it, not without"


@cache
def _printed(example: int, state: State, number: int) -> bool:
    """Whether an example comes out as the decks are."""
    return _exact(example, state, number, {})


def _exact(example: int, state: State, number: int, instead: dict[str, Program]) -> bool:
    def load(name: str) -> Program:
        return instead.get(name) or programs.program(name)

    reports = [r for r in reproduce((example,), load, states=(state,)) if r.program == number and r.device == "punch"]
    return bool(reports) and all(report.verdict.kind == EXACT for report in reports)


def _deck(row: Row, step: Step | None) -> tuple[bool, str]:
    deck_name = str(row.ground.get("deck", ""))
    data = ground_deck(deck_name)
    if data is None:
        return False, f"there is no deck {deck_name!r}"
    whole = _whole(row)
    program, message = _compiled(row, step)
    if program is None:
        return False, f"without it the deck does not compile: {message}"
    if whole.storage != program.storage and len(whole.code) == len(program.code):
        # Only sizes differ: a run that leaves an array without the row and not with it is another.
        stopped = _outcome(_name(row), layers_for(row), program, data).ending
        if isinstance(stopped, Ending) and stopped.kind == "bounds" and _has_room(whole, stopped):
            return True, f"deck {deck_name} needs the room; without it: {stopped.message}"
    one = _with_row(_name(row), layers_for(row), deck_name)
    other = _outcome(_name(row), layers_for(row), program, data, PATIENCE * one.longest + LOOP_WINDOW)
    if one.same_as(other):
        return False, f"deck {deck_name} gives the same cards without it"
    ends = one.trouble or "an empty hopper"
    return True, f"deck {deck_name} ends with {ends}; without it: {other.trouble or 'other cards'}"


def _has_room(program: Program, ending: Ending) -> bool:
    """Whether the element at which a run stopped is one of the program's array."""
    shape = next(entry.shape for entry in program.storage.entries if entry.name == ending.name)
    return all(1 <= n <= size for n, size in zip(ending.subscripts, shape, strict=True))


def ground_deck(name: str) -> Deck | None:
    """A deck a row names: an example's input data, or one of those made for the purpose."""
    examples = {f"example{number}": number for number in chapter6.EXAMPLES}
    if name in examples:
        return chapter6.input_deck(examples[name])
    entry = programs.sources().joinpath("grounds", f"{name}.deck")
    return deck_from_text(entry.name, entry.read_text(encoding="ascii")) if entry.is_file() else None


@dataclass(frozen=True, slots=True)
class _Outcome:
    """What a data deck gave: every line punched and typed, and the last program's ending, or the error of the job.

    ``longest`` counts the statements of the longer program.
    """

    lines: tuple[str, ...]
    ending: Ending | EmulatorError
    longest: int = 0

    @property
    def trouble(self) -> str:
        """Why the job did not end as it should; empty where it did."""
        return self.ending.message if isinstance(self.ending, Ending) else str(self.ending)

    def same_as(self, other: _Outcome) -> bool:
        """Whether the same was put out and the job ended for the same reason; cards are numbered anew without a row."""
        one, two = self.ending, other.ending
        if isinstance(one, Ending) and isinstance(two, Ending):
            where = [(e.kind, e.name, e.subscripts, [line.label for line in e.loop]) for e in (one, two)]
            return self.lines == other.lines and where[0] == where[1]
        return self.lines == other.lines and str(one) == str(two)


@cache
def _with_row(name: str, layers: tuple[str, ...], deck_name: str) -> _Outcome:
    """What a deck gives with the rows of these layers as they are: many rows are judged by one deck."""
    data = ground_deck(deck_name)
    assert data is not None
    return _outcome(name, layers, programs.with_layers(name, layers), data)


def _outcome(name: str, layers: tuple[str, ...], program: Program, deck: Deck, limit: int = 0) -> _Outcome:
    """What a data deck gives with ``program`` in the place of the built-in ``name``, the others with ``layers``."""
    first = "program1_examples" if name == "program1_examples" else "program1"

    def load(wanted: str) -> Program:
        return program if wanted == name else programs.with_layers(wanted, layers)

    try:
        options = LAYERED if layers else LISTED
        steps = run_hull(deck, load, replace(options, limit=limit or options.limit), first).steps
    except EmulatorError as error:
        return _Outcome((), error)
    lines = tuple(line for step in steps for line in (*step.result.punched, *step.result.typed))
    return _Outcome(lines, steps[-1].result.ending, max(step.result.statements for step in steps))


def _forced(row: Row, step: Step | None) -> tuple[bool, str]:
    card, sibling = str(row.ground["card"]), str(row.ground["sibling"])
    names = list(row.ground["rename"])
    exchange = dict(zip(names[::2], names[1::2], strict=True))
    with_row = _card(_built(row), card)
    other = _renamed(_card(_built(row), sibling), exchange)
    without_row = _card(_without(row, step), card)
    if with_row != other:
        return False, f"card {card} is not card {sibling} with names exchanged"
    if without_row == other:
        return False, f"card {card} is card {sibling} with names exchanged also without it"
    exchanged = ", ".join(f"{a} for {b}" for a, b in exchange.items())
    return True, f"card {card} is card {sibling} with {exchanged}, not so without it"


def _card(deck: Deck, place: str) -> str:
    """The statement at LABEL or LABEL+n, without blanks and number."""
    label, _, steps = place.partition("+")
    statements = list(sources(deck))
    at = next(i for i, s in enumerate(statements) if s.label == label)
    return statements[at + int(steps or 0)].text


def _renamed(text: str, exchange: dict[str, str]) -> str:
    return re.sub(r"[A-Z][A-Z0-9]*", lambda m: exchange.get(m[0], m[0]), text)
