"""The compiler, which translates the syntax tree to object code: statement numbers, DO loops, input, output, storage.

Sources: C26-5619 for the forms of statements and, on p. 56, for the error types.  A DO behaves as in the object code of
IBM's compiler, which we executed: code at the end of the loop adds the step to the variable, and branches back unless
the variable then exceeds the limit.  So a loop runs at least once, and its variable ends at the first value beyond the
limit.
"""

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import assert_never

from emulator.errors import CompileError, DeckError, Diagnostic, Refused, expect, merge_repeated
from emulator.language import objectcode as op
from emulator.language import tree
from emulator.language.cards import RECORD_MARK, Deck
from emulator.language.control_flow import flow_warnings
from emulator.language.expressions import LIBRARY, Emitter, Operand, function_of, is_fixed_name, unknown_function
from emulator.language.foreign import references
from emulator.language.formats import FormatSpec, parse_format
from emulator.language.objectcode import Line, Program
from emulator.language.parser import parse
from emulator.language.storage import CORES, FIELD, FUNCTION_NAMES

VERBS = ("READ", "ACCEPT", "PUNCH", "PRINT", "TYPE")
_LARGEST = (CORES[-1] - FUNCTION_NAMES) // FIELD
_EFFECTS = dict.fromkeys((op.FMFAC, op.FMFIX, op.TRANSMIT), "store")
_EFFECTS |= {op.IF: "test", op.IFX: "test fixed", op.FINISH: "list"}
_NO_DO_END = (tree.Jump, tree.Do, tree.Stop, tree.Format, tree.Dimension, tree.End)


def compile_deck(deck: Deck) -> Program:
    """Compile a source deck.

    Raise CompileError with every message of the compiler, or DeckError for a deck without statements.
    """
    program, diagnostics = translate(deck)
    if program is None:
        raise CompileError(deck.source, diagnostics)
    return program


def translate(deck: Deck) -> tuple[Program | None, tuple[Diagnostic, ...]]:
    """Compile a source deck.  Return the program, or None if there are errors, and all messages in order of cards."""
    expect(deck, Deck, "deck")
    parsed = parse(deck)
    if not parsed.statements and not parsed.diagnostics:
        raise DeckError(f"{deck.source}: the source deck has no statement")
    translation = _Translation(
        deck.source, parsed.statements, refused=parsed.refused, foreign_names=parsed.foreign_names
    )
    translation.diagnostics.extend(parsed.diagnostics)
    translation.run(broken=any(not message.warning for message in parsed.diagnostics))
    if not all(message.warning for message in translation.diagnostics):
        return None, tuple(merge_repeated(translation.diagnostics))
    program = translation.program()
    return program, tuple(merge_repeated([*translation.diagnostics, *flow_warnings(program)]))


@dataclass
class _OpenDo:
    """A DO whose last statement, number ``label``, has not been compiled yet."""

    label: int
    loop: int
    statement: int
    place: tree.Place


@dataclass
class _Translation:
    """The state of one compilation.

    ``jumps`` has a pair for each branch: the statement number to which the branch leads, and the place of the branch in
    the source.  ``opened`` has, for each statement number, the count of open DO loops that end with this statement.
    :class:`~emulator.language.parser.Parsed` defines ``refused`` and ``foreign_names``.
    """

    source: str
    statements: tuple[tree.Statement, ...]
    emitter: Emitter = field(default_factory=Emitter)
    diagnostics: list[Diagnostic] = field(default_factory=list)
    branches: list[tuple[int, ...]] = field(default_factory=list)
    jumps: list[tuple[int, tree.Place]] = field(default_factory=list)
    loops: list[tuple[int, int, int, int]] = field(default_factory=list)
    formats: dict[int, FormatSpec] = field(default_factory=dict)
    format_places: dict[int, int] = field(default_factory=dict)
    format_lines: dict[int, int] = field(default_factory=dict)
    targets: dict[int, int] = field(default_factory=dict)
    open_dos: list[_OpenDo] = field(default_factory=list)
    opened: Counter[int] = field(default_factory=Counter)
    labels: dict[int, tree.Place] = field(default_factory=dict)
    lines: list[Line] = field(default_factory=list)
    refused: frozenset[str] = frozenset()
    foreign_names: frozenset[str] = frozenset()
    ended: bool = False

    def run(self, broken: bool) -> None:
        # FORMATs come first, because a statement may use a FORMAT that follows it.
        self._collect_formats()
        self._check_labels()
        self._check_functions()
        for statement in self.statements:
            try:
                self._statement(statement)
            except Refused as refused:
                if not any(reference.name in self.foreign_names for reference in references(statement.body)):
                    self.diagnostics.append(refused.diagnostic)
            self._close_dos(statement)
        # A DO that is still open has no last statement, unless that statement was rejected by the parser.
        for do in self.open_dos:
            if str(do.label) in self.refused:
                continue
            self._error(do.place, f"the last statement of this DO, number {do.label}, is missing")
        if self.statements and not self.ended and not broken:
            card = self.statements[-1].place.card
            self.diagnostics.append(Diagnostic(card, 0, "the deck has no END card", warning=True))
        if (used := self.emitter.allocator.used) > _LARGEST:
            message = f"OVERLAP: the data need {used * FIELD} positions of core, more than any 1620 has"
            self._error(tree.Place(1, 0), message)
        # If the parser rejected statements, a branch may lead to one of them, so branches cannot be checked.
        if not broken:
            for label, place in self.jumps:
                if label not in self.targets and str(label) not in self.refused:
                    self._error(place, self._why_no_target(label))
        # A program without executable statements still needs a statement at which it stops.
        if not self.lines:
            self.lines.append(Line(0, tree.Place(1, 1), ""))
        if not self.ended:
            self.emitter.count(len(self.lines) - 1, False, "end of the deck")
            self.emitter.emit(op.STOP, second=1)

    def program(self) -> Program:
        code = self.emitter
        return Program(
            source=self.source,
            code=tuple(
                i if (address := code.allocator.final(i.address)) == i.address else replace(i, address=address)
                for i in code.code
            ),
            subscripts=tuple(code.subscripts),
            branches=tuple(tuple(self.targets[label] for label in labels) for labels in self.branches),
            loops=tuple(
                (v, code.allocator.final(step), code.allocator.final(limit), pc) for v, step, limit, pc in self.loops
            ),
            counters=tuple(code.counters),
            formats=tuple(self.formats.items()),
            format_lines=tuple(self.format_lines[label] for label in self.formats),
            storage=code.allocator.storage(),
            statements=tuple(self.lines),
            verbs=VERBS,
            functions=LIBRARY,
        )

    def _error(self, place: tree.Place, message: str, number: int = 0) -> None:
        self.diagnostics.append(Diagnostic(place.card, place.column, message, number))

    def _collect_formats(self) -> None:
        positions = 0
        for statement in self.statements:
            if not isinstance(statement.body, tree.Format):
                continue
            if positions > CORES[-1]:
                message = f"OVERLAP: the FORMATs need {positions} positions of core, more than any 1620 has"
                self._error(statement.place, message)
                break
            if not statement.label:
                self._error(statement.place, "a FORMAT needs a statement number", 10)
                continue
            try:
                spec, warnings = parse_format(statement.body)
            except Refused as error:
                self.diagnostics.append(error.diagnostic)
                spec = FormatSpec(())
            else:
                self.diagnostics.extend(warnings)
            # If two FORMATs have the same number, the first one is used.  _check_labels reports the second one.
            positions += spec.positions
            self.formats.setdefault(statement.label, spec)
        self.format_places = {label: place for place, label in enumerate(self.formats)}

    def _check_labels(self) -> None:
        for statement in self.statements:
            if statement.label in self.labels and statement.label:
                first = self.labels[statement.label].card
                self._error(statement.place, f"statement number {statement.label} is already used on card {first}")
            self.labels.setdefault(statement.label, statement.place)

    def _check_functions(self) -> None:
        """Report every unknown function, also in a statement that has another error."""
        bodies = [statement.body for statement in self.statements]
        arrays = {name for body in bodies if isinstance(body, tree.Dimension) for name, _, _ in body.arrays}
        for body in bodies:
            expressions = body.value if isinstance(body, tree.Assignment) else body
            for reference in references(expressions):
                name = reference.name
                is_known = name in arrays or name in self.foreign_names or function_of(reference, self.emitter.arrays)
                if reference.arguments and not is_known:
                    self.diagnostics.append(unknown_function(reference).diagnostic)

    def _why_no_target(self, label: int) -> str:
        if label in self.formats:
            return f"statement {label} is a FORMAT; a program cannot branch to it"
        if label in self.labels:
            return f"statement {label} cannot be executed, so a program cannot branch to it"
        return f"there is no statement number {label}"

    def _statement(self, statement: tree.Statement) -> None:
        body = statement.body
        if statement.label:
            self.emitter.allocator.place("statement number", str(statement.label))
        if isinstance(body, tree.Format):
            # A FORMAT has a second field, for the branch that leads around its text.
            self.emitter.allocator.place("statement number", f"after {statement.label}")
            self.format_lines.setdefault(statement.label, len(self.lines))
            return
        if isinstance(body, tree.Dimension):
            self._dimension(body)
            return
        index = len(self.lines)
        line = Line(statement.label, statement.place, _statement_text(statement), index=index)
        self.lines.append(line)
        if statement.label:
            self.targets.setdefault(statement.label, len(self.emitter.code))
        self.emitter.begin_statement()
        self.emitter.count(index, True, "statement")
        self._body(body, statement, index)
        # The last instruction tells which effect a trace can show: a store, a test or the end of a list.
        effect = _EFFECTS.get(self.emitter.code[-1].operation)
        if effect:
            self.lines[index] = replace(line, effect=effect)

    def _body(self, body: tree.Body, statement: tree.Statement, index: int) -> None:
        emitter = self.emitter
        match body:
            case tree.Assignment():
                self._assignment(body)
            case tree.GoTo(label):
                emitter.emit(op.BRANCH, address=self._branch((label,), statement.place))
            case tree.ComputedGoTo(labels, selector):
                self._fixed_variable(selector, "the variable of a computed GO TO")
                emitter.emit(op.SELECT, emitter.variable(selector), second=self._branch(labels, statement.place))
            case tree.If(value, labels):
                emitter.load(value)
                emitter.emit(op.IFX if emitter.fixed(value) else op.IF, address=self._branch(labels, statement.place))
            case tree.IfSwitch(switch, labels):
                emitter.emit(op.SWITCH, address=self._branch(labels, statement.place), second=switch)
            case tree.Do():
                self._do(body, statement, index)
            case tree.Continue() | tree.Dimension() | tree.Format():
                pass
            case tree.Pause(number):
                emitter.emit(op.PAUSE, second=int(number or 0))
            case tree.Stop():
                emitter.emit(op.STOP)
            # END stops the run as STOP does.  The second operand, 1 for END, distinguishes the two.
            case tree.End():
                self.ended = True
                emitter.emit(op.STOP, second=1)
            case tree.InputOutput():
                self._input_output(body, statement, index)
            case _:
                assert_never(body)

    def _assignment(self, body: tree.Assignment) -> None:
        emitter, target = self.emitter, body.target
        if target.arguments and target.name not in emitter.arrays:
            message = f"{target.name} is not an array (no DIMENSION before this card)"
            raise Refused(target.place, message, about=target.name)
        to_fixed, from_fixed = is_fixed_name(target.name), emitter.fixed(body.value)
        place = emitter.variable(target)
        # An assignment that only copies a value of the same mode transmits the field with SEND and TRANSMIT, without
        # the accumulator.
        source = emitter.simple(body.value)
        if source is not None and to_fixed == from_fixed:
            emitter.emit(op.SEND, source)
            emitter.emit(op.TRANSMIT, place)
            return
        negative = emitter.deferred(body.value)
        # The value is converted to the mode of the variable (C26-5619 p. 21) before its sign is reversed.
        if to_fixed != from_fixed:
            emitter.emit(op.FIX if to_fixed else op.FLOAT)
        emitter.settle(negative, to_fixed)
        emitter.emit(op.FMFIX if to_fixed else op.FMFAC, place)

    def _dimension(self, body: tree.Dimension) -> None:
        for name, shape, place in body.arrays:
            if name in self.emitter.arrays:
                raise Refused(place, f"{name} already has dimensions", 9)
            if ("variable", name) in self.emitter.allocator.entries:
                raise Refused(place, f"{name} was used before its DIMENSION", 9)
            if 0 in shape:
                raise Refused(place, f"{name}: a dimension must be at least 1, found 0", 9)
            if (size := math.prod(shape)) > _LARGEST:
                raise Refused(place, f"OVERLAP: {name} needs {size * FIELD} positions of core, more than any 1620 has")
            self.emitter.arrays[name] = shape
            self.emitter.allocator.place("array", name, shape)

    def _branch(self, labels: Sequence[int], place: tree.Place) -> int:
        for label in labels:
            self.emitter.allocator.place("statement number", str(label))
            self.jumps.append((label, place))
        self.branches.append(tuple(labels))
        return len(self.branches) - 1

    def _fixed_variable(self, reference: tree.Reference, what: str) -> Operand:
        if reference.name in self.emitter.arrays or reference.arguments or not is_fixed_name(reference.name):
            raise Refused(reference.place, f"{what} must be a fixed-point variable without subscript")
        return self.emitter.variable(reference)

    def _loop(self, loop: tree.Do | tree.Loop, place: tree.Place) -> tuple[int, int, int]:
        """Emit code that stores a DO's first value, and return the addresses of its variable, step and limit."""
        variable = self._fixed_variable(loop.variable, "the variable of a DO")
        bounds = []
        for bound in (loop.first, loop.last, loop.step or tree.Number("1", place)):
            if isinstance(bound, tree.Number) and not bound.floating:
                if int(bound.text) == 0:
                    raise Refused(bound.place, "the bounds and the step of a DO must be greater than zero")
                bounds.append(Operand(self.emitter.allocator.immediate(bound.text)))
            elif isinstance(bound, tree.Reference):
                bounds.append(self._fixed_variable(bound, "a bound of a DO"))
            else:
                raise Refused(bound.place, "a bound of a DO must be an integer or a fixed-point variable")
        # Only the first value is stored here.  DOTEST reads step and limit from their fields at the end of each pass.
        first, last, step = bounds
        self.emitter.emit(op.TOFIX, first)
        self.emitter.emit(op.FMFIX, variable)
        return variable.address, step.address, last.address

    def _do(self, body: tree.Do, statement: tree.Statement, index: int) -> None:
        if body.label in self.labels and self.labels[body.label] <= statement.place:
            raise Refused(statement.place, f"the last statement of this DO, number {body.label}, is before the DO")
        # The statement number gets its field before the variable does, unless it has appeared before (p. 69).
        self.emitter.allocator.place("statement number", str(body.label))
        variable, step, limit = self._loop(body, statement.place)
        self.loops.append((variable, step, limit, len(self.emitter.code)))
        self.open_dos.append(_OpenDo(body.label, len(self.loops) - 1, index, statement.place))
        self.opened[body.label] += 1

    def _close_dos(self, statement: tree.Statement) -> None:
        if not statement.label or not self.opened[statement.label]:
            return
        if isinstance(statement.body, _NO_DO_END):
            self._error(statement.place, "a DO cannot end with this statement; use CONTINUE")
        # Close the innermost DO first.  If it has another last statement, the two ranges overlap but are not nested.
        while self.opened[statement.label]:
            do = self.open_dos.pop()
            self.opened[do.label] -= 1
            if do.label != statement.label:
                what = f"this DO ends with statement {do.label}, but must not end after the DO around it"
                self._error(do.place, f"{what}, which ends with statement {statement.label}")
                continue
            self.emitter.count(do.statement, False, "closing of the DO")
            self.emitter.emit(op.DOTEST, address=do.loop)

    def _input_output(self, body: tree.InputOutput, statement: tree.Statement, index: int) -> None:
        spec = self.formats.get(body.format)
        if spec is None:
            raise Refused(statement.place, f"there is no FORMAT number {body.format}", 13)
        if body.items and not spec.has_fields and spec.specs:
            raise Refused(statement.place, f"FORMAT {body.format} has no field for the numbers in the list", 13)
        self.emitter.allocator.place("statement number", str(body.format))
        self.emitter.emit(op.BEGIN, address=VERBS.index(body.verb), second=self.format_places[body.format])
        for item in body.items:
            self._item(item, statement, index)
        self.emitter.emit(op.FINISH)

    def _item(self, item: tree.Item, statement: tree.Statement, index: int, depth: int = 0) -> None:
        emitter = self.emitter
        # An indexed list is a loop: set the variable, transfer the items, step and test at the bottom.
        if isinstance(item, tree.Loop):
            if depth > 2:
                raise Refused(statement.place, "the parentheses of this list are nested too deep")
            variable, step, limit = self._loop(item, statement.place)
            self.loops.append((variable, step, limit, len(emitter.code)))
            number = len(self.loops) - 1
            emitter.count(index, False, op.LIST_PASS)
            for inner in item.items:
                self._item(inner, statement, index, depth + 1)
            emitter.emit(op.DOTEST, address=number)
            emitter.count(index, False, op.LIST_REST)
            return
        # A negative second operand tells the engines that the item is fixed point.
        sign = -1 if is_fixed_name(item.name) else 1
        # In a list, an array without subscripts stands for all of its elements.
        if item.name in emitter.arrays and not item.arguments:
            entry = emitter.allocator.place("array", item.name)
            emitter.emit(op.ITEM, Operand(entry.first), second=sign * entry.size)
            return
        emitter.emit(op.ITEM, emitter.variable(item), second=sign)


def _statement_text(statement: tree.Statement) -> str:
    """Return the text of a statement without its number and the blanks around it."""
    text = " ".join(RECORD_MARK.split(line[:72])[0].strip() for line in statement.text.split("\n"))
    return text.lstrip("0123456789 ") if statement.label else text
