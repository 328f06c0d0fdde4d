"""Addresses in the object program, and the code that computes the address of an array element.

Element 1 of an array has the highest address, and each element takes ten positions.  The code for a subscript writes
the address of element 0 into the next instruction, and subtracts ten times the subscript from this address.  To
subtract ten times the subscript, the code subtracts the subscript one digit further left.  Before that, the code
multiplies the variable by its factor or, for the second subscript, by the number of rows.
"""

from dataclasses import dataclass
from functools import cached_property

from emulator.language.objectcode import Program, Subscript
from emulator.language.storage import FIELD, core_address
from emulator.objectdeck import digits as d
from emulator.objectdeck.digits import address

_INSTRUCTION = 12


@dataclass(frozen=True)
class Addresses:
    """The addresses of a program's variables and statements in a machine with ``core`` positions of storage."""

    program: Program
    core: int

    def units(self, field: int) -> int:
        """Return the address of a field, which on the 1620 is the position of its last digit."""
        return core_address(field, self.core)

    @cached_property
    def labels(self) -> dict[str, int]:
        """The address of the storage field of each statement number: the position of its last digit."""
        entries = self.program.storage.entries
        return {entry.name: self.units(entry.first) for entry in entries if entry.kind == "statement number"}

    def branch(self, label: int | str) -> int:
        """Return the address to which a branch to a statement goes: the field of the statement's number.

        The field holds a second branch, which goes to the statement itself.
        """
        return self.labels[str(label)] - FIELD + 1

    def format(self, label: int) -> int:
        """Return the position of the last digit of the address that the field of a FORMAT's statement number holds."""
        return self.labels[str(label)] - 3

    def operand(self, call: str, field: int, subscript: int, at: int) -> str:
        """Return an instruction with its operand, preceded by the code that computes the operand's subscript, if any.

        Parameters
        ----------
        call
            The first seven digits of the instruction.
        field
            The number of the operand's field in storage.
        subscript
            The index of the operand's subscript in ``program.subscripts``, or -1 if the address is fixed.
        at
            The position at which the code begins.
        """
        if subscript < 0:
            return call + address(self.units(field))
        part = self.program.subscripts[subscript]
        # The address of the element if all variables of its subscripts are 0.
        base = self.units(part.array) - FIELD * (part.o1 - 1 + (part.rows * (part.o2 - 1) if part.columns else 0))
        steps = self._steps(part)
        if not steps:
            return call + address(base)
        # Each step ends with a subtraction.  One more instruction first writes the address ``base``.
        length = sum(len(code) for code, _ in steps) + _INSTRUCTION * (len(steps) + 1)
        place = at + length + _INSTRUCTION - 1
        text = steps[0][0] + d.TRANSMIT_FIELD_IMMEDIATE + address(place) + address(base)
        for number, (code, subtrahend) in enumerate(steps):
            text += (code if number else "") + d.SUBTRACT + address(place - 1) + address(subtrahend)
        # The code replaces the address in the instruction.  Until it runs, IBM's compiler put the address of the
        # variable there.
        variable = part.v2 if part.v2 >= 0 else part.v1
        return text + call + address(self.units(variable))

    def _steps(self, part: Subscript) -> list[tuple[str, int]]:
        """Return the steps that compute a subscript: for each, its code and the position of the number to subtract."""
        steps = []
        if part.v2 >= 0:
            code = self._product(part.v2, part.rows * part.c2)
            if part.v1 >= 0 and part.c1 == 1:
                return [(code + d.ADD + f"{d.PRODUCT:05d}" + address(self.units(part.v1)), d.PRODUCT)]
            steps.append((code, d.PRODUCT))
        if part.v1 >= 0 and part.c1 == 1:
            steps.append(("", self.units(part.v1)))
        elif part.v1 >= 0:
            steps.append((self._product(part.v1, part.c1), d.PRODUCT))
        return steps

    def _product(self, variable: int, factor: int) -> str:
        """Return code that multiplies a variable by a constant, and marks the product as a field of four digits."""
        multiply = d.MULTIPLY_IMMEDIATE + address(self.units(variable)) + d.wide_immediate(factor)
        return multiply + d.SET_FLAG + f"{d.PRODUCT - 3:05d}" + d.NONE
