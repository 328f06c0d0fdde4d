"""Why a run ended and what is to be noted of it: data, and the one place where they are put into words."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from emulator.language.objectcode import Line, Program
from emulator.numbers.arithmetic import FIXED_POINT, UNDEFINED
from emulator.numbers.fields import Field, Remark

Kind = Literal[
    "hopper",
    "stop",
    "end",
    "limit",
    "bounds",
    "undefined",
    "outside",
    "select",
    "mode",
    "undecided",
    "input",
    "operator",
]
NORMAL: tuple[Kind, ...] = ("hopper", "stop", "end")

Mode = Literal["fixed", "floating"]


@dataclass(frozen=True, slots=True)
class Ending:
    """Why a run ended: the kind, and what there is to know of it.

    ``source`` names the program, ``line`` is the statement the run ended at, ``decision`` the last IF or computed GO TO
    before it, where there was one.  What the other fields hold depends on the kind:

    - hopper, stop, end: nothing; the end is normal.
    - limit: ``count`` is the limit, ``costly`` the work counted for operations that take longer than plain ones; with
      ``line``, the limit does not allow an operation there; ``loop`` the statements begun last, in order, ``repeats``
      says that each was begun more than once.
    - bounds: the array in ``name``, its ``shape``, and the ``subscripts`` asked for.  outside: nothing.
    - undefined: the field's ``name``; ``put_out`` where a list asked for it.
    - select: the value of a computed GO TO in ``subscripts``.
    - mode: the field's ``name`` and the ``mode`` of what it holds; with ``format``, the number of a FORMAT, ``field``
      is the specification it does not fit, None where the FORMAT has no field at all.
    - undecided: what the numbers cannot say, in ``trouble``.  input: in ``trouble``, what is wrong with the deck.
      operator: the operator stopped the run, as ``trouble`` says.
    """

    kind: Kind
    source: str = ""
    line: Line | None = None
    decision: Line | None = None
    name: str = ""
    shape: tuple[int, ...] = ()
    subscripts: tuple[int, ...] = ()
    count: int = 0
    loop: tuple[Line, ...] = ()
    repeats: bool = False
    costly: int = 0
    mode: Mode | None = None
    format: int = 0
    field: Field | None = None
    put_out: bool = False
    trouble: str = ""

    @property
    def normal(self) -> bool:
        return self.kind in NORMAL

    @property
    def span(self) -> tuple[int, int] | None:
        """The first and the last card of the loop, None where there is none."""
        cards = [line.place.card for line in self.loop]
        return (min(cards), max(cards)) if cards else None

    @property
    def message(self) -> str:
        """One line for a user, empty for a normal end."""
        if self.normal:
            return ""
        if self.kind == "input":
            return self.trouble
        source = f"{self.source}: " if self.source else ""
        if self.line is None:
            if self.costly:
                done = f"work as of {self.count} statements, {self.costly} of it for costly operations"
                return f"{source}stopped after {done}{_loop(self)}"
            return f"{source}stopped after {self.count} statements{_loop(self)}"
        return f"{source}card {self.line.place.card}: {_what(self, self.line)}"


def _what(ending: Ending, line: Line) -> str:
    """What is wrong in a statement."""
    there = f"in {line.label} {line.text}" if line.label else f"in {line.text}"
    match ending.kind:
        case "limit":
            more = "a larger --limit or numbers of fewer digits would let it go on"
            return (
                f"the limit of work, {ending.count} statements or what takes their time, ends the run {there}; {more}"
            )
        case "bounds":
            asked, shape = (",".join(map(str, numbers)) for numbers in (ending.subscripts, ending.shape))
            return f"{ending.name}({asked}) is outside {ending.name}({shape}), {there}"
        case "outside":
            return f"a subscript reaches outside the data into the program, {there}"
        case "select":
            return f"a computed GO TO with value {ending.subscripts[0]}, {there}"
        case "undefined" if ending.put_out:
            return f"{ending.name} is undefined where it is put out, in {line.text}"
        case "undefined":
            return f"{ending.name} is undefined where it is computed with, {there}"
        case "mode" if ending.field is not None:
            return f"{ending.name} is {ending.mode} point, its field in FORMAT {ending.format} is {ending.field}"
        case "mode" if ending.format:
            return f"FORMAT {ending.format} has no field for the list"
        case "mode" if ending.put_out:
            return f"{ending.name} holds a number of the other mode"
        case "mode":
            # Only with --bounds core: a neighbour's number.
            return f"{ending.name} holds a number in {ending.mode} point, {there}"
    return f"{ending.trouble}, {there}"


def _loop(ending: Ending) -> str:
    if ending.span is None:
        return ""
    first, last = ending.span
    labels = [str(line.label) for line in ending.loop if line.label]
    span = f"card {first}" if first == last else f"cards {first} to {last}"
    word = "statement" if len(labels) == 1 else "statements"
    among = f", {word} {', '.join(labels[:12])}{' ...' if len(labels) > 12 else ''}" if labels else ""
    return f"; the last ones {'repeat' if ending.repeats else 'are on'} {span}{among}"


def too_costly(program: Program, limit: int, at: int, decision: int, costly: int) -> Ending:
    """The ending at an operation that takes more work than the limit leaves."""
    line, last = program.line_at(at), decided(program, decision)
    return Ending("limit", program.source, line, last, count=limit, costly=costly)


def looped(
    program: Program, limit: int, before: Sequence[int], counts: Sequence[int], decision: int, costly: int = 0
) -> Ending:
    """The ending at the limit: which statements were begun last, from the counts before and after them."""
    ran = [
        (program.statements[counter.statement], new - old)
        for counter, old, new in zip(program.counters, before, counts, strict=True)
        if counter.begins and new > old
    ]
    return Ending(
        "limit",
        program.source,
        decision=decided(program, decision),
        count=limit,
        loop=tuple(sorted((line for line, _ in ran), key=lambda line: line.index)),
        repeats=all(times > 1 for _, times in ran),
        costly=costly,
    )


def out_of_bounds(program: Program, at: int, decision: int, address: int, subscripts: tuple[int, ...]) -> Ending:
    """The ending at a subscript outside the array that begins at ``address``."""
    entry = program.storage.entry_of(address)
    return Ending(
        "bounds",
        program.source,
        program.line_at(at),
        decided(program, decision),
        name=entry.name,
        shape=entry.shape,
        subscripts=subscripts[: len(entry.shape)],
    )


def stopped(program: Program, kind: Kind, at: int, decision: int, subscripts: tuple[int, ...] = ()) -> Ending:
    """An ending at an instruction of which only subscripts are to be known."""
    return Ending(kind, program.source, program.line_at(at), decided(program, decision), subscripts=subscripts)


def unfit(program: Program, at: int, decision: int, address: int, kind: int) -> Ending:
    """The ending at a field that is computed with and holds nothing (``kind``), or a number of the other mode."""
    name, line, last = program.storage.name_of(address), program.line_at(at), decided(program, decision)
    if kind == UNDEFINED:
        return Ending("undefined", program.source, line, last, name=name)
    mode: Mode = "fixed" if kind == FIXED_POINT else "floating"
    return Ending("mode", program.source, line, last, name=name, mode=mode)


def decided(program: Program, decision: int) -> Line | None:
    """The statement of the decision an executor did last; it counts instructions from 1, 0 being none."""
    return program.line_at(decision - 1) if decision else None


@dataclass(frozen=True, slots=True)
class Notice:
    """What is to be noted of a run that goes on.

    - pause: the machine halted at the statement ``line`` and START was pressed.
    - field: a number in a field of a card (of a line typed, with ``typed``) gives cause for a remark.
    - record: a record of FORMAT ``format`` had ``width`` characters, of which the device has room for ``kept``.
    """

    kind: Literal["pause", "field", "record"]
    source: str
    line: Line | None = None
    card: int = 0
    column: int = 0
    typed: bool = False
    remark: Remark | None = None
    format: int = 0
    width: int = 0
    kept: int = 0

    @property
    def message(self) -> str:
        """One line for a user."""
        if self.kind == "pause":
            assert self.line is not None
            return f"{self.source}: PAUSE at {self.line.name}: the operator presses START"
        if self.kind == "record":
            return f"{self.source}: FORMAT {self.format}: a record of {self.width} characters, cut at {self.kept}"
        assert self.remark is not None
        unit = "line" if self.typed else "card"
        return f"{self.source}: {unit} {self.card}, column {self.column}: {self.remark.message}"
