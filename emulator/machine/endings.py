"""The reasons why a run ended, and the warnings of a run, as data and as messages."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal, get_args

from emulator.language.objectcode import Line, Program
from emulator.machine.interpreter import AT_BOUNDS, AT_COSTLY, AT_SELECT, AT_STOP, AT_UNDEFINED
from emulator.numbers.arithmetic import FIXED_POINT, UNDEFINED
from emulator.numbers.fields import Field, Remark

Normal = Literal["hopper", "stop", "end"]
Kind = (
    Normal
    | Literal["limit", "bounds", "undefined", "outside", "select", "mode", "record", "undecided", "input", "operator"]
)
NORMAL = get_args(Normal)

Mode = Literal["fixed", "floating"]


@dataclass(frozen=True, slots=True)
class Ending:
    """The reason why a run ended.

    ``source`` names the program.  ``line`` is the statement at which the run ended, and ``decision`` is the last IF or
    computed GO TO before it.  The other fields depend on the kind:

    - stop, end: normal ends, without other fields.
    - hopper: a normal end.  ``line`` is the READ that found the hopper empty.  ``any_read`` is True if the option
      ``hopper`` allows a run to end in this way at any READ, and not only at one that begins a data set.  A note after
      the run then reports the empty hopper.
    - limit: ``count`` is the limit.  ``costly`` is the part of the work that was done by operations that take longer
      than a statement.  ``line`` is set if a single operation would exceed the limit.  ``loop`` holds the statements
      executed last, in the order of their cards.  ``repeats`` is True if each statement of ``loop`` was executed more
      than once.
    - bounds: the array ``name``, its ``shape`` and the ``subscripts``.
    - outside: a subscript refers to a position outside the data.  This kind sets no other fields.
    - undefined: the ``name`` of the field.  ``put_out`` is True if an output list contains it.
    - select: a computed GO TO whose variable selects none of its statement numbers.  ``subscripts`` holds the
      variable's value.
    - mode: the ``name`` of the field and the ``mode`` of its number.  If a FORMAT is involved, ``format`` is its
      number, and ``field`` is the specification in it that does not fit the mode, or None if the FORMAT has no fields.
    - record: a record too long for IBM's library of 1962 (ERROR F9).  ``format`` holds the number of its FORMAT.
    - undecided: the arithmetic cannot represent a value or determine its sign.  ``trouble`` is the explanation.
    - input: ``trouble`` says what is wrong with the deck.
    - operator: the operator stopped the run; ``trouble`` says so.
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
    any_read: bool = False

    @property
    def normal(self) -> bool:
        return self.kind in NORMAL

    @property
    def span(self) -> tuple[int, int] | None:
        """The first and last card of the endless loop that ended the run, or None if there was none."""
        cards = [line.place.card for line in self.loop]
        return (min(cards), max(cards)) if cards else None

    @property
    def outcome(self) -> str:
        """One line that says how the run ended, whether normally or not."""
        if self.kind == "hopper" and self.line is not None:
            return f"the hopper was empty at the READ of {self.line.name}"
        return self.message or ("STOP" if self.kind == "stop" else "the end of the program")

    @property
    def message(self) -> str:
        """The reason as one line for the user, or "" if the run ended normally."""
        if self.normal:
            return ""
        if self.kind == "input":
            return self.trouble
        source = f"{self.source}: " if self.source else ""
        if self.line is None:
            if self.costly:
                work = f"the work of {self.count} statements, of which costly operations account for {self.costly}"
                return f"{source}stopped after {work}{_loop(self)}"
            return f"{source}stopped after {self.count} statements{_loop(self)}"
        return f"{source}card {self.line.place.card}: {_trouble_in(self, self.line)}"


def _trouble_in(ending: Ending, line: Line) -> str:
    there = f"in {line.label} {line.text}" if line.label else f"in {line.text}"
    match ending.kind:
        case "limit":
            work = f"one operation would exceed the limit (the work of {ending.count} statements), {there}"
            return f"{work}; use a larger --limit or numbers of fewer digits"
        case "bounds":
            subscripts, shape = (",".join(map(str, numbers)) for numbers in (ending.subscripts, ending.shape))
            return f"{ending.name}({subscripts}) is outside its DIMENSION {ending.name}({shape}), {there}"
        case "outside":
            return f"a subscript reaches outside the data into the program, {there}"
        case "select":
            return f"the value {ending.subscripts[0]} selects no statement number, {there}"
        case "undefined" if ending.put_out:
            return f"{ending.name} is undefined but is written, in {line.text}"
        case "undefined":
            return f"{ending.name} is undefined but is used in a calculation, {there}"
        case "mode" if ending.field is not None:
            return f"{ending.name} is {ending.mode} point, but its field in FORMAT {ending.format} is {ending.field}"
        case "mode" if ending.format:
            return f"FORMAT {ending.format} has no field for the numbers in the list"
        case "mode" if ending.put_out:
            return f"{ending.name} holds a number in {ending.mode} point, which cannot be written, {there}"
        case "record":
            return (
                f"ERROR F9: a record of FORMAT {ending.format} has more characters than the device has columns, {there}"
            )
        case "mode":
            # This occurs only with --bounds core, if a subscript reaches a neighbouring field.
            return f"{ending.name} holds a number in {ending.mode} point, {there}"
    return f"{ending.trouble}, {there}"


def _loop(ending: Ending) -> str:
    if ending.span is None:
        return ""
    first, last = ending.span
    labels = [str(line.label) for line in ending.loop if line.label]
    # At most twelve statement numbers, so that the message stays one line.
    span = f"card {first}" if first == last else f"cards {first} to {last}"
    word = "statement" if len(labels) == 1 else "statements"
    among = f", {word} {', '.join(labels[:12])}{' ...' if len(labels) > 12 else ''}" if labels else ""
    return f"; the last statements {'form a loop on' if ending.repeats else 'are on'} {span}{among}"


def looped(
    program: Program, limit: int, before: Sequence[int], counts: Sequence[int], decision: int, costly: int = 0
) -> Ending:
    """Return the ending of a run that reached its limit of work, with the statements of its last loop."""
    # A statement is part of the loop if its count has grown since ``before``, the counts shortly before the limit.
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


def ended_by(
    reason: int,
    program: Program,
    limit: int,
    at: int,
    decision: int,
    address: int,
    kind: int,
    subscripts: tuple[int, ...],
    costly: int,
) -> Ending:
    """Return the ending of a run for the reason, such as AT_BOUNDS, that the interpreter or the kernel returned.

    The run ended at the instruction ``at``.  ``decision`` is the instruction, counted from 1, of the last IF or
    computed GO TO before it.  ``address`` is the storage field that the instruction ``at`` uses, and for AT_UNDEFINED,
    ``kind`` is the kind of this field.  ``subscripts`` holds the subscripts for AT_BOUNDS, and the value of the
    variable for AT_SELECT.  ``costly`` is the part of the work that slow operations did.
    """
    if reason == AT_STOP:
        return Ending("stop" if program.code[at].second == 0 else "end")
    here = stopped(program, "outside", at, decision)
    if reason == AT_COSTLY:
        return replace(here, kind="limit", count=limit, costly=costly)
    if reason == AT_BOUNDS:
        entry = program.storage.entry_of(address)
        here = replace(here, kind="bounds", name=entry.name, shape=entry.shape)
        return replace(here, subscripts=subscripts[: len(entry.shape)])
    if reason == AT_SELECT:
        return replace(here, kind="select", subscripts=subscripts[:1])
    if reason == AT_UNDEFINED:
        here = replace(here, kind="undefined", name=program.storage.name_of(address))
        # The interpreter returns this reason also for a field that holds a number of the other mode.
        if kind != UNDEFINED:
            return replace(here, kind="mode", mode="fixed" if kind == FIXED_POINT else "floating")
    return here


def stopped(program: Program, kind: Kind, at: int, decision: int) -> Ending:
    """Return an ending of the given kind at the instruction ``at``."""
    return Ending(kind, program.source, program.line_at(at), decided(program, decision))


def decided(program: Program, decision: int) -> Line | None:
    """Return the IF or computed GO TO at instruction ``decision``, counted from 1, or None if ``decision`` is 0."""
    return program.line_at(decision - 1) if decision else None


@dataclass(frozen=True, slots=True)
class Notice:
    """A warning about a run that continues.

    - pause: the machine halted at the statement ``line``, and START was pressed automatically.
    - field: a remark about a number in a field of a card, or of a typed line if ``typed`` is True.
    - record: a record of FORMAT ``format`` had ``width`` characters, and the device truncated it to ``columns``
      characters.
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
    columns: int = 0

    @property
    def message(self) -> str:
        """The warning as one line for the user."""
        if self.kind == "pause":
            assert self.line is not None
            return f"{self.source}: PAUSE at {self.line.name}: the operator presses START"
        if self.kind == "record":
            record = f"a record of {self.width} characters, truncated to {self.columns}"
            return f"{self.source}: FORMAT {self.format}: {record}"
        assert self.remark is not None
        unit = "line" if self.typed else "card"
        return f"{self.source}: {unit} {self.card}, column {self.column}: {self.remark.message}"
