"""Why a run of the 1963 programs came to no hull, as data: the decision it took, and the numbers it took it by.

A program types DATA NOT ACCEPTABLE where a point that defines a plane or line does not satisfy it exactly (thesis
p. 117; program 2 at 126, program 3 at 119), and ERROR IN PROGRAM where what cannot be has come about (104, 112, 133).
What is known of these places stands in ``fortran_src/KNOWN-FAULTS.md``; :attr:`Cause.fault` is the number there.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from emulator.language.objectcode import Line, Program
from emulator.machine.machine import Machine
from emulator.machine.session import Session
from emulator.machine.trace import contents
from modern.thesis.job import REFUSALS, HullRun, Step, Watch, refusal

Kind = Literal["miss", "centre", "zeros", "pair", "repeat", "room", "endless", "unmet", "stopped", "other"]
"""What happened.

- miss: a point that defines an equation does not satisfy it in the machine's digits.
- centre: a plane or line passes through the point C, in these digits.  zeros: its coefficients are all zero.
- pair: the search for pairs of planes inside the hull ran beyond the table.  repeat: that for repeated planes did.
- unmet: no point satisfies three equations, so that none is taken for a vertex.
- room: a table has no more places.  endless: the statement limit was reached.
- stopped: the run met a value or a place it could not go on with.  other: none of these.
"""

CORRECTED = {1: "P3-025", 2: "P3-026", 3: "P3-027", 5: "P3-028", 16: "P2-023"}
"""The rows of the layer ``corrected`` that correct known faults."""


@dataclass(frozen=True, slots=True)
class Cause:
    """Why one step came to no hull.

    program: its number.  message: what it typed, empty where it stopped otherwise.  decision: the last IF before that.
    fault: the number of the known fault, 0 where it is none of them.  equation: the number in the table, 0 where none
    is concerned; point: the coordinates of the point that misses it, value: what it gives instead of zero, in the
    machine's numbers.
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
    """A hull run, and why it came to no hull, if it did not.

    ``run``: :func:`modern.thesis.job.run_hull` with all its arguments but ``watch``, which is given here.
    """
    machines: list[Machine] = []

    def seen(program: Program, machine: Machine) -> None:
        machines.append(machine)
        if watch is not None:
            watch(program, machine)

    done = run(watch=seen)
    causes = (cause(step, machine) for step, machine in zip(done.steps, machines, strict=True))
    return done, next((found for found in causes if found is not None), None)


def cause(step: Step, machine: Session) -> Cause | None:
    """Why a step came to no hull; None where it ended well or the operator stopped it.

    ``machine`` is the one that ran it, as it was left.
    """
    ending, typed = step.result.ending, refusal(step.result)
    if typed:
        event = next(e for e in reversed(step.result.events) if e.what == "type" and e.text in REFUSALS)
        return _refused(step, machine, typed, event.decision)
    if ending.normal or ending.kind in ("operator", "input"):
        return None
    if ending.kind == "limit":
        # A search beyond the end of the table strikes what is not there, and NE falls without end.
        beyond = step.number == 3 and _whole(machine, "NE") < 0
        searches = [_SEARCHES[found] for line in ending.loop if line.label and (found := _search(line.label))]
        return Cause(step.number, "endless", "", ending.decision, searches[0] if beyond and searches else 0)
    if ending.kind == "bounds":
        return Cause(step.number, "room", "", ending.decision, {2: 16, 3: 5}.get(step.number, 0))
    return Cause(step.number, "stopped", "", ending.decision)


_SEARCHES = {"pair": 1, "repeat": 2}
_MISSES = {
    2: ("I", "D", ((124, "MR"), (125, "NR")), "RST"),
    3: ("J", "E", ((116, "MR"), (117, "NR"), (118, "KR")), "XYZ"),
}
"""Of programs 2 and 3: the index of the equation, the array of its values, the point each test is of, coordinates."""
_CENTRES = {1: (204, "I", "E"), 3: (132, "I", "E")}


def _search(label: int) -> str:
    """Which of program 3's searches a statement belongs to."""
    return "pair" if 141 <= label <= 155 else "repeat" if 164 <= label <= 173 else ""


def _refused(step: Step, machine: Session, typed: str, decision: Line | None) -> Cause:
    label = _label(step, decision)
    if step.number in _MISSES:
        index, values, tests, axes = _MISSES[step.number]
        for test, name in tests:
            if label == test and typed == REFUSALS[0]:
                equation, point = _whole(machine, index), _whole(machine, name)
                place = tuple(_value(machine, axis, point) for axis in axes)
                if step.number == 2:
                    place = _turned(place, _whole(machine, "KPROJ"))
                value = _value(machine, values, equation)
                return Cause(step.number, "miss", typed, decision, 6, equation, place, value)
    if step.number in _CENTRES and label == _CENTRES[step.number][0]:
        _, index, values = _CENTRES[step.number]
        equation = _whole(machine, index)
        names = ("XA", "XB", "XC", "XD") if step.number == 1 else ("A", "B", "C", "D")
        zeros = not any(float(_value(machine, name, equation)) for name in names)
        known = (4 if zeros else 3) if step.number == 3 else 6
        return Cause(step.number, "zeros" if zeros else "centre", typed, decision, known, equation)
    if step.number == 3 and label == 199 and not _whole(machine, "N"):
        return Cause(3, "unmet", typed, decision, 6)
    if step.number == 3 and _search(label):
        kind: Kind = "pair" if _search(label) == "pair" else "repeat"
        return Cause(3, kind, typed, decision, _SEARCHES[kind])
    return Cause(step.number, "other", typed, decision)


def _label(step: Step, decision: Line | None) -> int:
    """The label a statement bears, or the nearest before it; 0 where there is none."""
    before = [] if decision is None else step.program.statements[: decision.index + 1]
    return next((line.label for line in reversed(before) if line.label), 0)


def _turned(place: tuple[str, ...], projection: int) -> tuple[str, ...]:
    """R, S, T of program 2 as x, y, z: T is the coordinate that KPROJ drops."""
    r, s, t = place
    return {1: (t, r, s), 2: (r, t, s)}.get(projection, (r, s, t))


def _value(machine: Session, name: str, number: int = 1) -> str:
    """A field, or an element of an array, as text."""
    entry = next(entry for entry in machine.program.storage.entries if entry.name == name)
    return contents(machine, entry.first + number - 1)


def _whole(machine: Session, name: str) -> int:
    return int(_value(machine, name))
