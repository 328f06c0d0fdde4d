"""Translate a program to machine code as IBM's compiler of 1962 did, by rules taken from its only known object deck.

Every statement begins at an even position.  If the code before it has an odd number of digits, a record mark follows
that code.  A branch to a statement goes first to the field of the statement's number.  This field holds a second
branch, which goes to the statement itself.  The object program begins at 08300.
"""

from dataclasses import dataclass, field

from emulator.language import objectcode as op
from emulator.language.expressions import LIBRARY
from emulator.language.ibm1962 import ITEM, LAST_ITEM, VERBS, format_positions
from emulator.language.objectcode import Instruction, Program
from emulator.language.storage import CORES, FIELD, OBJECT_PROGRAM
from emulator.objectdeck import digits as d
from emulator.objectdeck.addresses import Addresses
from emulator.objectdeck.digits import address
from emulator.objectdeck.square_root import square_root

# The Q address of the branch at the end of a DO, which repeats the DO while the variable does not exceed the limit.
_NOT_HIGH = "011" + d.RECORD_MARK + "0"
# The position of a copy of a loop's variable, which is stepped and compared to find the last pass of a list.
_POSITION = "00060"

# Routines of this project for functions that the library lacks.  Each function returns the code of its routine for the
# position at which the routine begins.
ROUTINES = {"SQRT": square_root}


@dataclass(frozen=True, slots=True)
class Unit:
    """A piece of code, as digits that follow each other in core storage from an even position."""

    at: int
    digits: str


@dataclass(frozen=True, slots=True)
class ObjectProgram:
    """An object program: its digits, the positions of its statement numbers and functions, and its end.

    The keys of ``labels`` are the names of statement numbers in the storage map.  ``missing`` names the functions of
    the program that neither the library nor this project supplies.
    """

    units: tuple[Unit, ...]
    labels: dict[str, int]
    functions: dict[str, int]
    missing: tuple[str, ...]
    end: int


def generate(program: Program, core: int = CORES[-1]) -> ObjectProgram:
    """Return the object program for a machine with ``core`` positions.  Its length does not depend on ``core``."""
    return _Generator(program, Addresses(program, core)).run()


@dataclass
class _Generator:
    """The state of the translation of one program to machine code.

    ``places`` holds, for each instruction of the emulator's object code, the position of its machine code.  ``formats``
    is the number of FORMATs translated so far.  If an instruction does not use all of its twelve digits, IBM's compiler
    left old digits of its buffer in the unused ones.  A PAUSE therefore contains the last ten digits of the last call
    (``operands``), and the instruction that begins a DO may contain one digit of an earlier address (``unused``).
    """

    program: Program
    addresses: Addresses
    at: int = OBJECT_PROGRAM
    units: list[Unit] = field(default_factory=list)
    labels: dict[str, int] = field(default_factory=dict)
    places: dict[int, int] = field(default_factory=dict)
    formats: int = 0
    operands: str = d.NONE + d.NONE
    unused: str = "0"

    def run(self) -> ObjectProgram:
        program = self.program
        # The two instructions before the body of a loop set its variable.
        starts = {body - 2: index for index, (_, _, _, body) in enumerate(program.loops)}
        closing = _loops_closed_by_lists(program)
        pc = 0
        while pc < len(program.code):
            instruction = program.code[pc]
            self.places[pc] = self.at
            if instruction.operation == op.COUNT:
                self._count(instruction)
            elif pc in starts:
                self._start_loop(starts[pc])
                pc += 1
            elif instruction.operation == op.ITEM:
                self._items(instruction, closing.get(pc))
            elif not (instruction.operation == op.STOP and instruction.second and self._is_past_branch(pc)):
                self._put(self._code(instruction, pc))
            pc += 1
        self._formats_before(len(program.statements))
        functions = {}
        used = sorted({program.functions[i.address] for i in program.code if i.operation == op.FUNCTION})
        for name in used:
            if name in ROUTINES:
                functions[name] = self.at
                self._put(ROUTINES[name](self.at))
        powers = ["A**B"] if any(i.operation == op.POWER for i in program.code) else []
        missing = tuple(name for name in used if name not in ROUTINES) + tuple(powers)
        return ObjectProgram(tuple(self.units), self.labels, functions, missing, self.at)

    def _put(self, digits: str) -> None:
        if digits:
            self.units.append(Unit(self.at, digits + (d.RECORD_MARK if len(digits) % 2 else "")))
            self.at += len(self.units[-1].digits)

    def _count(self, instruction: Instruction) -> None:
        """Begin a statement: output the FORMATs that precede it, and record the position of the statement."""
        counter = self.program.counters[instruction.address]
        if counter.begins:
            self._formats_before(counter.statement)
            label = self.program.statements[counter.statement].label
            if label:
                self.labels[str(label)] = self.at

    def _formats_before(self, statement: int) -> None:
        while self.formats < len(self.program.formats) and self.program.format_lines[self.formats] <= statement:
            label, spec = self.program.formats[self.formats]
            # The library adds five to the address before it takes the first word.
            self.labels[str(label)] = self.at + 6
            around = d.BRANCH + address(self.addresses.branch(f"after {label}"))
            self._put(around + d.card_text(format_positions(spec)))
            self.labels[f"after {label}"] = self.at
            self.formats += 1

    def _start_loop(self, loop: int) -> None:
        variable = self.program.loops[loop][0]
        first = self.program.code[self.program.loops[loop][3] - 2].address
        target = address(self.addresses.units(variable))
        code = self._with_bound(d.TRANSMIT_FIELD_IMMEDIATE, d.TRANSMIT_FIELD, target, first)
        # To the left of a constant, IBM's compiler punched the last digit of an earlier address.
        if code.startswith(d.TRANSMIT_FIELD_IMMEDIATE):
            code = code[:7] + self.unused + code[8:]
        else:
            self.unused = code[-1]
        self._put(code)

    def _with_bound(self, immediate: str, direct: str, target: str, bound: int, wide: bool = False) -> str:
        """Return an instruction whose operands are the field at ``target`` and a bound of a DO (constant or variable).

        The instruction has the operation code ``immediate`` if the bound is a constant, ``direct`` if it is a variable.
        """
        if bound < self.program.storage.fields:
            return direct + target + address(self.addresses.units(bound))
        value = int(self.program.storage.immediates[bound - self.program.storage.fields][1])
        return immediate + target + (d.wide_immediate(value) if wide else d.immediate(value))

    def _end_loop(self, loop: int) -> str:
        variable, step, limit, body = self.program.loops[loop]
        target = address(self.addresses.units(variable))
        step_forward = self._with_bound(d.ADD_IMMEDIATE, d.ADD, target, step)
        compare = self._with_bound(d.COMPARE_IMMEDIATE, d.COMPARE, target, limit, wide=True)
        return step_forward + compare + d.BRANCH_NO_INDICATOR + address(self.places[body]) + _NOT_HIGH

    def _is_past_branch(self, pc: int) -> bool:
        """Return True if control never reaches END: END has no number and follows a statement that always branches."""
        before = pc - 1
        while before >= 0 and self.program.code[before].operation == op.COUNT:
            before -= 1
        branches = (op.BRANCH, op.IF, op.IFX, op.SELECT, op.SWITCH, op.STOP)
        ends_in_branch = before >= 0 and self.program.code[before].operation in branches
        return ends_in_branch and not self.program.line_at(pc).label

    def _code(self, instruction: Instruction, pc: int) -> str:
        operation = instruction.operation
        if operation in d.PLAIN_ENTRIES:
            return self._call(f"{d.PLAIN_ENTRIES[operation]:05d}", instruction)
        if operation in d.ENTRIES:
            code = self._call(address(d.ENTRIES[operation]), instruction)
            reversed_sign = operation in (op.FSBR, op.XSBR)
            return code + (self._bare_call(d.REVERSE_SIGN) if reversed_sign else "")
        if operation in d.CALLS:
            return self._bare_call(d.CALLS[operation])
        match operation:
            case op.FUNCTION:
                # The call goes to the function's field in the symbol table above the data, which has two fields for
                # each function.
                place = LIBRARY.index(self.program.functions[instruction.address])
                entry = self.addresses.core - 2 * FIELD * place - FIELD
                return d.CALL_IMMEDIATE + address(entry) + address(d.ACCUMULATOR)
            case op.BRANCH:
                return d.BRANCH + self._targets(instruction.address)[0]
            case op.IF | op.IFX:
                return self._test(instruction)
            case op.SWITCH:
                on, off = self._targets(instruction.address)
                return d.BRANCH_INDICATOR + on + f"00{instruction.second}00" + d.BRANCH + off
            case op.SELECT:
                return self._select(instruction)
            case op.DOTEST:
                return self._end_loop(instruction.address)
            case op.BEGIN:
                label = self.program.formats[instruction.second][0]
                entry = VERBS[self.program.verbs[instruction.address]]
                return d.CALL + address(entry) + address(self.addresses.format(label))
            case op.PAUSE:
                # PAUSE uses no operands, so IBM's compiler punched those of the last call.
                return "M8" + self.operands
            case op.STOP:
                # After a halt, START executes the next instruction, so a branch back to the halt follows it.
                return d.HALT + d.NONE + d.NONE + d.BRANCH + address(self.at)
            case _:
                return ""

    def _call(self, entry: str, instruction: Instruction) -> str:
        code = self.addresses.operand(d.CALL_IMMEDIATE + entry, instruction.address, instruction.subscript, self.at)
        self.operands = code[-10:]
        return code

    @staticmethod
    def _bare_call(entry: int) -> str:
        return f"{d.CALL}{entry:05d}{entry - 1:05d}"

    def _targets(self, branch: int) -> list[str]:
        pcs = self.program.branches[branch]
        return [address(self.addresses.branch(self.program.line_at(pc).label)) for pc in pcs]

    def _test(self, instruction: Instruction) -> str:
        negative, zero, positive = self._targets(instruction.address)
        units = d.MANTISSA if instruction.operation == op.IF else d.ACCUMULATOR
        compare = f"{d.COMPARE_IMMEDIATE}{units:05d}{d.immediate(0)}"
        to_zero = d.BRANCH_INDICATOR + zero + d.EQUAL
        return compare + to_zero + d.BRANCH_INDICATOR + positive + d.HIGH + d.BRANCH + negative

    def _select(self, instruction: Instruction) -> str:
        """Return the code of a computed GO TO, followed by its table of addresses, the last target first.

        An entry is the first four digits of a target's address.  The fifth digit is always 0.
        """
        targets = self._targets(instruction.second)
        selector = address(self.addresses.units(instruction.address))
        branch = self.at + 60
        table = branch + 8
        # The position of an entry is computed by subtracting four times the variable from the end of the table.
        return (
            d.MULTIPLY_IMMEDIATE + selector + "000]M"
            + d.SET_FLAG + "00095" + d.NONE
            + d.ADD_IMMEDIATE + f"{d.PRODUCT:05d}" + address(table + 4 * len(targets) + 3)
            + d.TRANSMIT_FIELD + address(branch - 1) + f"{d.PRODUCT:05d}"
            + d.TRANSMIT_FIELD + address(branch + 5) + d.NONE
            + d.BRANCH + d.NONE + d.RECORD_MARK
            + "".join(target[:4] for target in reversed(targets))
        )  # fmt: skip

    def _items(self, instruction: Instruction, loops: tuple[int, ...] | None) -> None:
        """Output the calls that transfer a list item.

        If the item is the last one of its list, ``loops`` holds the loops that end after it.  For other items,
        ``loops`` is None.
        """
        count = op.repeats(instruction)
        for element in range(count):
            is_last = loops is not None and element == count - 1
            if is_last and loops:
                self._put(self._last_pass(loops))
            entry = LAST_ITEM if is_last and not loops else ITEM
            call = d.CALL_IMMEDIATE + address(entry)
            self._put(self.addresses.operand(call, instruction.address + element, instruction.subscript, self.at))

    def _last_pass(self, loops: tuple[int, ...]) -> str:
        """Return code that tells the library to expect a list's last item if all ``loops`` are in their last pass."""
        length = 48 * len(loops) + 12
        past = self.at + length
        text = ""
        for loop in loops:
            variable, step, limit, _ = self.program.loops[loop]
            text += d.TRANSMIT_FIELD + _POSITION + address(self.addresses.units(variable))
            text += self._with_bound(d.ADD_IMMEDIATE, d.ADD, _POSITION, step)
            text += self._with_bound(d.COMPARE_IMMEDIATE, d.COMPARE, _POSITION, limit)
            text += d.BRANCH_NO_INDICATOR + address(past) + d.HIGH
        return text + d.TRANSMIT_FIELD_IMMEDIATE + f"{d.MORE_ITEMS:05d}" + "000]0"


def _loops_closed_by_lists(program: Program) -> dict[int, tuple[int, ...]]:
    """Return for each list the loops that end after its last item, keyed by the index of that item's instruction."""
    closing: dict[int, tuple[int, ...]] = {}
    for pc, instruction in enumerate(program.code):
        if instruction.operation != op.FINISH:
            continue
        loops = []
        before = pc - 1
        while program.code[before].operation in (op.COUNT, op.DOTEST):
            if program.code[before].operation == op.DOTEST:
                loops.append(program.code[before].address)
            before -= 1
        if program.code[before].operation == op.ITEM:
            closing[before] = tuple(loops)
    return closing
