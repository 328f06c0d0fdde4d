"""The state of a session as plain data for the emulator's page: the points with their hull, and core storage.

All numbers come from the variables of the running program. The page only draws these numbers and computes nothing about
the hull.
"""

from array import array
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

from emulator.errors import CompileError, EmulatorError
from emulator.language import objectcode as op
from emulator.language.cards import deck_from_text
from emulator.language.compiler import compile_deck
from emulator.language.ibm1962 import fixed_field, floating_field
from emulator.language.objectcode import Line, Program
from emulator.language.storage import FIELD, FUNCTION_NAMES, OBJECT_PROGRAM, core_address
from emulator.machine.forms import Layout
from emulator.machine.session import Session
from emulator.machine.trace import contents
from emulator.numbers.arithmetic import FIXED_POINT, UNDEFINED
from emulator.objectdeck.digits import card_text
from emulator.objectdeck.extent import code_positions
from modern.geometry.numbers import coordinates
from modern.geometry.vectors import Vector

# The arrays of coordinates in programs 1 and 3, and the arrays in program 2 for each value of its variable KPROJ.
_SPACE = ("X", "Y", "Z")
_FLAT = {1: ("T", "R", "S"), 2: ("R", "T", "S"), 3: ("R", "S", "T")}
# The arrays with the numbers of the points that define each equation.
DEFINING = ("MM", "NN", "KK")
# To recognise a run that never ends, its state is kept after this number of statements, and each time the number
# doubles.
_KEPT = 1024
# The operations that assign a value to a variable.
_STORES = (op.FMFAC, op.FMFIX, op.TRANSMIT)
# The numbers of the statements that begin a data set, a stage of the hull, and the output. The key is an array that
# only program 2 or only program 3 has.
_STAGES = {"R": (100, 106, 170), "KK": (100, 103, 174)}


def stage_labels(program: Program) -> tuple[int, int, int]:
    """Return the numbers of the statements that begin a data set, a stage of the hull, and the output.

    Return zeros for a program other than program 2 and program 3.
    """
    storage = program.storage
    if all(storage.fields_of(name) for name in ("NE", "NV", "MM", "NN")):
        for name, labels in _STAGES.items():
            if storage.fields_of(name):
                return labels
    return 0, 0, 0


def picture(session: Session, state: tuple[list[Any], list[Any]] | None = None) -> dict[str, Any]:
    """Return the points and faces in a program's variables, or an empty result for a program without such variables.

    The result has ``points``, the number of ``vertices``, which are the first points, and ``faces`` as lists of indices
    of points. Points come from the variables X, Y and Z (in program 2, R, S and T), and the number of vertices comes
    from NV. The faces come from the arrays MM, NN and KK, whose first NE entries hold numbers of points. The variables
    have their present values, or those of an earlier ``state``: the list of all stored values and the list of their
    kinds.
    """
    storage = session.program.storage

    def whole(name: str) -> int:
        fields = storage.fields_of(name)
        value = number(session, fields.start, state) if fields else None
        return int(value) if value is not None else 0

    names = _SPACE if storage.fields_of("X") else _FLAT.get(whole("KPROJ"), ())
    axes = [storage.fields_of(name) for name in names]
    if not axes or not all(axes):
        return {}
    count = min(whole("N"), *map(len, axes))
    rows = [[number(session, axis[n], state) for axis in axes] for n in range(count)]
    points = [row for row in rows if None not in row]
    tables = [table for name in DEFINING if len(table := storage.fields_of(name)) > 1]
    faces: list[list[int]] = []
    if len(tables) > 1 and stage_labels(session.program)[0]:
        for k in range(min(whole("NE"), *map(len, tables))):
            corners = [number(session, table[k], state) for table in tables]
            # A table that is being filled or shifted may hold an entry without three points.
            if all(corner is not None and 1 <= corner <= len(points) for corner in corners):
                faces.append([int(corner or 0) - 1 for corner in corners])
    return {"points": points, "vertices": whole("NV") if faces else 0, "faces": faces}


def number(session: Session, field: int, state: tuple[list[Any], list[Any]] | None = None) -> float | None:
    """Return the present value of a field, or its value in an earlier ``state``, as a float.

    Return None if the value is undefined.
    """
    values, kinds = state or (session.state.values, session.state.kinds)
    value, kind = values[field], kinds[field]
    if kind == UNDEFINED:
        return None
    return float(value) if kind == FIXED_POINT else float(session.options.numbers.traced(value))


def exact(point: Sequence[float]) -> Vector:
    """Return a point of a picture with its coordinates as Fractions."""
    return coordinates([str(value) for value in point])


def core(program: Program, size: int) -> dict[str, Any]:
    """Return the regions of core storage in the order of addresses, each as name, kind, first and last address."""
    code = OBJECT_PROGRAM + code_positions(program)
    lowest = core_address(program.storage.fields, size) + 1
    regions = [
        ["IBM’s subroutines and tables", "system", 0, OBJECT_PROGRAM - 1],
        [f"object program of {program.source}", "program", OBJECT_PROGRAM, code - 1],
        ["free", "free", code, lowest - 1],
    ]
    for entry in reversed(program.storage.entries):
        first, last = core_address(entry.first + entry.size - 1, size), core_address(entry.first, size)
        regions.append([entry.name, entry.kind, first - FIELD + 1, last])
    regions.append(["names of the library functions", "system", size - FUNCTION_NAMES, size - 1])
    return {"size": size, "regions": regions}


def field_at(session: Session, address: int, writers: dict[int, tuple[int, int]]) -> dict[str, Any]:
    """Return the field of data that contains an address, or an empty answer for another address.

    The answer has ``name``, ``addresses`` (first and last), ``value``, ``digits`` as the 1620 stores them, ``floating``
    and ``writer``. ``digits`` is empty if the arithmetic is not that of the 1620. ``writers`` maps a field to a pair:
    the card that last wrote the field, and the number of that execution among all statements executed in the run.
    """
    field = (session.options.core - 1 - FUNCTION_NAMES - address) // FIELD
    storage = session.program.storage
    if not 0 <= field < storage.fields:
        return {}
    right = core_address(field, session.options.core)
    return {
        "name": storage.name_of(field),
        "addresses": [right - FIELD + 1, right],
        "value": contents(session, field),
        "digits": _digits(session, field),
        "floating": session.state.kinds[field] not in (FIXED_POINT, UNDEFINED),
        "writer": list(writers.get(field, ())),
    }


def _digits(session: Session, field: int) -> str:
    """Return the ten digits of a field in the code of punched cards, in which a digit with a flag is a letter."""
    kind, text = session.state.kinds[field], contents(session, field)
    if kind == UNDEFINED or session.options.numbers.digits != 8:
        return ""
    return card_text(fixed_field(text) if kind == FIXED_POINT else floating_field(text))


def compile_messages(text: str) -> list[list[Any]]:
    """Compile a program and return the messages of the compiler, each as card, column and text."""
    try:
        compile_deck(deck_from_text("program", text))
    except CompileError as error:
        return [[d.card, d.column, d.message] for d in error.diagnostics]
    except EmulatorError as error:
        return [[getattr(error, "card", 0), getattr(error, "column", 0), str(error)]]
    return []


def formats(program: Program) -> list[list[Any]]:
    """Return the FORMATs with which a program reads cards: for each, a title and the fields of its first card."""
    numbers = {i.second: None for i in program.code if i.operation == op.BEGIN and program.verbs[i.address] == "READ"}
    read = (program.formats[number] for number in numbers)
    return [[f"FORMAT {label}", Layout(spec).record_fields(0)] for label, spec in read]


def touched(program: Program) -> list[list[list[str]]]:
    """Return, for each card, the names that its statement writes and the names that it reads."""
    cards = max(line.place.card for line in program.statements)
    names: list[tuple[dict[str, None], dict[str, None]]] = [({}, {}) for _ in range(cards)]
    reading = False
    for instruction, statement in zip(program.code, program.statement_numbers, strict=True):
        if instruction.operation == op.BEGIN:
            reading = program.verbs[instruction.address] in ("READ", "ACCEPT")
        if instruction.operation > op.ITEM or not 0 <= instruction.address < program.storage.fields:
            continue
        entry = program.storage.entry_of(instruction.address)
        writes = instruction.operation in _STORES or (instruction.operation == op.ITEM and reading)
        if entry.kind in ("variable", "array"):
            names[program.statements[statement].place.card - 1][0 if writes else 1][entry.name] = None
    return [[list(written), list(read)] for written, read in names]


def written(session: Session, line: Line) -> Iterator[int]:
    """Yield the fields that the last completed statement wrote."""
    if line.effect == "store":
        yield session.state.stored
    elif line.effect == "list" and session.devices.verb in ("READ", "ACCEPT"):
        yield from session.devices.listed


@dataclass
class Record:
    """The record of a run. An instance is a tracer of :class:`emulator.machine.session.Session`.

    ``times`` has the work done before each statement. ``writers`` is as in :func:`field_at`. ``stages`` has the
    successive hulls as :func:`picture` returns them. ``repeats`` is 0 until the run returns to an earlier state. Then
    ``repeats`` is the number of statements since that state. Such a run never ends without an action of the operator.
    """

    program: Program | None = None
    times: "array[int]" = field(default_factory=lambda: array("L"))
    writers: dict[int, tuple[int, int]] = field(default_factory=dict)
    stages: list[dict[str, Any]] = field(default_factory=list)
    _fields: set[int] = field(default_factory=set)
    _is_final: bool = False
    _is_new: bool = True
    repeats: int = 0
    # The indices of statements between two assignments to coordinates, and the state before the first assignment.
    _torn: frozenset[int] = frozenset()
    _whole: tuple[list[Any], list[Any]] | None = None
    _switches: list[int] = field(default_factory=list)
    # For each statement: the kept states, each with the number of the statement in the run.
    _states: dict[int, list[tuple[int, tuple[Any, ...]]]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._labels = stage_labels(self.program) if self.program else (0, 0, 0)
        self._torn = _torn(self.program) if self.program else frozenset()

    def __call__(self, line: Line, session: Session) -> None:
        if session.last is not None:
            for address in written(session, session.last):
                self.writers[address] = session.last.place.card, len(self.times)
                self._fields.add(address)
        self.times.append(session.state.work)
        if line.index + 1 in self._torn and line.index not in self._torn:
            self._whole = list(session.state.values), list(session.state.kinds)
        self._recognise(line, session)
        if line.label and line.label in self._labels:
            begins, _, ends = self._labels
            if line.label == begins:
                self._is_new = True
                return
            if self._is_new:
                self.stages.clear()
            # After the last stage the program uses the tables for its output.
            self._is_new, self._is_final = False, line.label == ends
            self.stages.append(picture(session) | {"final": self._is_final})

    def _recognise(self, line: Line, session: Session) -> None:
        """Compare the state of the run with those kept at earlier visits to the statement.

        If two states are equal, the run repeats a loop without end.
        """
        count, state, numbers = len(self.times), session.state, session.options.numbers
        if session.switches != self._switches:
            self._switches = list(session.switches)
            self.forget()
        for earlier, before in self._states.get(line.index, ()):
            if not self.repeats and before[0] == state.values and before == _determining(session):
                self.repeats = count - earlier
        # The rest of a run with random rounding does not depend on the state alone.
        if count >= _KEPT and not count & (count - 1) and numbers.fresh() is numbers:
            self._states.setdefault(line.index, []).append((count, _determining(session)))

    def forget(self) -> None:
        """Forget the kept states, because an action of the operator may change how the run continues."""
        self.repeats, self._states = 0, {}

    def take(self) -> list[int]:
        """Return the fields written since the last call."""
        fields, self._fields = sorted(self._fields), set()
        return fields

    def picture(self, session: Session) -> dict[str, Any]:
        """Return the picture of the present variables, or of the last stage if the hull is complete.

        A program moves a point by assigning its coordinates one after the other. Meanwhile the picture shows the state
        before the first assignment.
        """
        if self._is_final:
            return self.stages[-1]
        return picture(session, self._whole if session.here.index in self._torn else None)


def _torn(program: Program) -> frozenset[int]:
    """Return the indices of statements that assign a coordinate directly after another such statement."""
    coordinates = {*_SPACE, *_FLAT[1]}
    moves = set()
    for instruction, statement in zip(program.code, program.statement_numbers, strict=True):
        if instruction.operation in _STORES and 0 <= instruction.address < program.storage.fields:
            entry = program.storage.entry_of(instruction.address)
            if entry.kind == "array" and entry.name in coordinates:
                moves.add(statement)
    return frozenset(statement for statement in moves if statement - 1 in moves)


def _determining(session: Session) -> tuple[Any, ...]:
    """Return the storage, the accumulators and the number of cards read, which determine how a run continues."""
    state = session.state
    registers = (state.fac, state.fixed, state.last_card, session.devices.position)
    return list(state.values), list(state.kinds), *registers
