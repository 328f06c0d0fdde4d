"""The trace of a run: each statement with its card, its number, and the value that it stored or tested."""

from typing import TextIO

from emulator.language.objectcode import Line, Program
from emulator.machine.session import Session
from emulator.numbers.arithmetic import FIXED_POINT, UNDEFINED


class Tracer:
    """A tracer that writes one line for each statement to ``file``.

    The session calls the tracer when a statement *begins*, so the line of a statement is written when the next one
    begins, or by ``close``.
    """

    def __init__(self, file: TextIO) -> None:
        self._file = file
        self._line: Line | None = None
        self._machine: Session | None = None

    def watch(self, program: Program, machine: Session) -> None:
        """Start tracing a machine, and write a heading with the name of its program."""
        self.close()
        self._machine = machine
        machine.tracer = self
        self._file.write(f"* {program.source}: card, number, statement, value\n")

    def __call__(self, line: Line, machine: Session) -> None:
        self.close()
        self._line = line

    def close(self) -> None:
        """Write the trace line of the last statement, which has no successor to trigger it."""
        if self._line is None or self._machine is None:
            return
        line, self._line = self._line, None
        value = effect(self._machine, line)
        text = f"{line.place.card:4d} {line.label or '':>5} {line.text:<40}  {value}"
        self._file.write(text.rstrip() + "\n")


def effect(machine: Session, line: Line) -> str:
    """Return the value that the last statement stored, such as ``X(3) = .20000000E+01``, or tested."""
    state, name = machine.state, machine.program.storage.name_of
    if line.effect == "store":
        return f"{name(state.stored)} = {contents(machine, state.stored)}"
    if line.effect == "test":
        return machine.options.numbers.traced(state.fac)
    if line.effect == "test fixed":
        return str(state.fixed)
    if line.effect == "list":
        return ", ".join(f"{name(address)} = {contents(machine, address)}" for address in machine.devices.listed)
    return ""


def contents(machine: Session, address: int) -> str:
    """Return the contents of a storage field as text, in the form of its kind (integer or floating point)."""
    # A field is shown by its current kind, since programs may store either mode with --bounds core.
    value, kind = machine.state.values[address], machine.state.kinds[address]
    if kind == UNDEFINED:
        return "undefined"
    return str(value) if kind == FIXED_POINT else machine.options.numbers.traced(value)
