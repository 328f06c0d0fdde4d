"""Explain why a run of the 1963 programs found no hull: the statement that stopped it, and the numbers it tested.

A program types DATA NOT ACCEPTABLE if a point that defines a plane or line does not satisfy it exactly (thesis p. 117).
The test is statement 126 of program 2 and statement 119 of program 3.  A program types ERROR IN PROGRAM if it reaches a
state that should be impossible (statements 104, 112, 133).  ``fortran_src/KNOWN-FAULTS.md`` describes the known causes.
:attr:`Cause.fault` is the number of a fault in that file.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from emulator.language.objectcode import Line, Program
from emulator.machine.machine import Machine
from emulator.machine.session import Session
from emulator.machine.trace import contents
from modern.thesis.job import REFUSALS, HullRun, Step, Watch, refusal

# The kinds of causes why a program found no hull.
#
# - miss: a point that defines an equation does not satisfy it in the digits of the machine.
# - centre: in these digits a plane or line passes through the inside point C.  zeros: its coefficients are all zero.
# - pair: the search for pairs of planes inside the hull ran beyond the table.
# - repeat: the search for repeated planes ran beyond the table.
# - unmet: no point satisfies three equations, so that no point becomes a vertex.
# - room: a table is full.  endless: the run reached the statement limit.
# - stopped: the run met a value or an address with which it could not continue.  other: none of these.
Kind = Literal["miss", "centre", "zeros", "pair", "repeat", "room", "endless", "unmet", "stopped", "other"]

# Known faults, and the rows of the layer ``corrected`` that correct them.
CORRECTED = {1: "P3-025", 2: "P3-026", 3: "P3-027", 5: "P3-028", 16: "P2-023"}


@dataclass(frozen=True, slots=True)
class Cause:
    """The reason why one of the programs found no hull.

    ``message`` is the refusal that the program typed, or empty, and ``decision`` is the last IF before it. ``fault`` is
    the number of a known fault that explains the refusal, or 0. ``equation`` is the number of the equation concerned,
    or 0. If a point that defines the equation does not satisfy it, ``point`` has its coordinates, and ``value`` is the
    value of the equation at this point.
    """

    program: int
    kind: Kind
    message: str
    decision: Line | None
    fault: int = 0
    equation: int = 0
    point: tuple[str, ...] = ()
    value: str = ""


def explain_run(run: Callable[..., HullRun], watch: Watch | None = None) -> tuple[HullRun, Cause | None]:
    """Run the hull programs by calling ``run``.  Return the run, and the cause if no hull was found, else None."""
    machines: list[Machine] = []

    def record(program: Program, machine: Machine) -> None:
        machines.append(machine)
        if watch is not None:
            watch(program, machine)

    hull_run = run(watch=record)
    causes = (cause(step, machine) for step, machine in zip(hull_run.steps, machines, strict=True))
    return hull_run, next((first for first in causes if first is not None), None)


def cause(step: Step, machine: Session) -> Cause | None:
    """Return, from the final state of its machine, the reason why a program found no hull, or None if it found one."""
    ending, refused = step.result.ending, refusal(step.result)
    if refused:
        event = next(e for e in reversed(step.result.events) if e.what == "type" and e.text in REFUSALS)
        return _refused(step, machine, refused, event.decision)
    if ending.normal or ending.kind in ("operator", "input"):
        return None
    if ending.kind == "limit":
        # If a search runs beyond the end of the table, it deletes entries that do not exist, and NE, the number of
        # equations, decreases without end.
        beyond = step.number == 3 and _integer(machine, "NE") < 0
        searches = [_SEARCHES[search] for line in ending.loop if line.label and (search := _search(line.label))]
        # The last IF of the loop; the last IF executed depends on the limit.
        decision = next((line for line in reversed(ending.loop) if line.effect.startswith("test")), ending.decision)
        return Cause(step.number, "endless", "", decision, searches[0] if beyond and searches else 0)
    if ending.kind == "bounds":
        return Cause(step.number, "room", "", ending.decision, {2: 16, 3: 5}.get(step.number, 0))
    return Cause(step.number, "stopped", "", ending.decision)


_SEARCHES = {"pair": 1, "repeat": 2}
# For programs 2 and 3: the variable with the number of the equation, the array of its values, the tests, and the arrays
# of coordinates.  A test has its label, the label of the second IF of the layer ``epsilon``, and the variable with the
# number of the tested point.
_MISSES = {
    2: ("I", "D", ((124, 192, "MR"), (125, 193, "NR")), "RST"),
    3: ("J", "E", ((116, 217, "MR"), (117, 218, "NR"), (118, 219, "KR")), "XYZ"),
}
# For programs 1 and 3: the label of the statement that tests if an equation passes through C.
_CENTRES = {1: 204, 3: 132}


def _search(label: int) -> str:
    return "pair" if 141 <= label <= 155 else "repeat" if 164 <= label <= 173 else ""


def _refused(step: Step, machine: Session, message: str, decision: Line | None) -> Cause:
    """Return the cause of a typed message, found from the IF that led to it and from the values in the machine."""
    label = _label(step, decision)
    # A point that defines an equation does not satisfy it.
    if step.number in _MISSES:
        index, values, tests, axes = _MISSES[step.number]
        for test, second_test, name in tests:
            if label in (test, second_test) and message == REFUSALS[0]:
                equation, point = _integer(machine, index), _integer(machine, name)
                place = tuple(_value(machine, axis, point) for axis in axes)
                if step.number == 2:
                    place = _unprojected(place, _integer(machine, "KPROJ"))
                # With the layer epsilon the programs store the value of the equation in EE instead of E(J).
                has_scalar = decision is not None and "EE" in decision.text
                value = _value(machine, "EE") if has_scalar else _value(machine, values, equation)
                return Cause(step.number, "miss", message, decision, 6, equation, place, value)
    # The value of an equation at C is zero.
    if step.number in _CENTRES and label == _CENTRES[step.number]:
        equation = _integer(machine, "I")
        names = ("XA", "XB", "XC", "XD") if step.number == 1 else ("A", "B", "C", "D")
        zeros = not any(float(_value(machine, name, equation)) for name in names)
        known = (4 if zeros else 3) if step.number == 3 else 6
        return Cause(step.number, "zeros" if zeros else "centre", message, decision, known, equation)
    if step.number == 3 and label == 199 and not _integer(machine, "N"):
        return Cause(3, "unmet", message, decision, 6)
    if step.number == 3 and _search(label):
        kind: Kind = "pair" if _search(label) == "pair" else "repeat"
        return Cause(3, kind, message, decision, _SEARCHES[kind])
    return Cause(step.number, "other", message, decision)


def _label(step: Step, decision: Line | None) -> int:
    """Return the number of a statement, or of the nearest numbered statement before it, or 0."""
    before = [] if decision is None else step.program.statements[: decision.index + 1]
    return next((line.label for line in reversed(before) if line.label), 0)


def _unprojected(place: tuple[str, ...], projection: int) -> tuple[str, ...]:
    """Return the coordinates x, y, z of a point that program 2 stores as R, S, T.

    T is the coordinate that the projection drops.
    """
    r, s, t = place
    return {1: (t, r, s), 2: (r, t, s)}.get(projection, (r, s, t))


def _value(machine: Session, name: str, number: int = 1) -> str:
    entry = next(entry for entry in machine.program.storage.entries if entry.name == name)
    return contents(machine, entry.first + number - 1)


def _integer(machine: Session, name: str) -> int:
    return int(_value(machine, name))
