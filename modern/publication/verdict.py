"""The verdict of exact arithmetic on a run of the emulator's page: the first wrong decision, and the errors of the
hull.

The hull of the program is read from the cards that it punched. The true hull is computed from the points that the
program read (:func:`modern.publication.parting.true_hull`).
"""

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

from emulator.errors import EmulatorError
from emulator.language.cards import Deck
from emulator.language.objectcode import Line, Program
from emulator.machine.divergence import diverge
from emulator.machine.machine import run_with_operator
from emulator.machine.operator import Operator
from emulator.machine.result import Options, Result
from emulator.machine.session import Session
from emulator.machine.words import place_of
from emulator.numbers import numbers
from modern.geometry.vectors import cross, dot, minus
from modern.publication import panel
from modern.publication.parting import Whole, scaled, true_hull
from modern.thesis.cards import read_hull
from modern.thesis.job import refusal, second_program

# The work after which the run is interrupted, to test whether it repeats itself.
_STRIDE = 10_000
_PLURALS = {"vertex": "vertices"}
Hull = dict[str, Any]


def verdict(program: Program, deck: Deck, options: Options) -> dict[str, Any]:
    """Compare a run with exact arithmetic, and its hull with the true hull.

    In the answer, ``lines`` describe the first decision at which exact arithmetic takes another branch, with the tested
    value and the target of the branch in both arithmetics. If there is no such decision, ``lines`` states this, or
    gives the reason why the comparison stopped. ``statement`` is the number of the deciding statement in the run.
    ``says`` is a sentence about the result. ``hull`` is the true hull of the points that the program read, and
    ``final`` is the hull on the punched cards. Each of the two has three lists. ``missed`` has the vertices that only
    the true hull has, and ``extra`` those that only the program's hull has; both hulls have the same two lists.
    ``wrong`` has the numbers of the faces of this hull that the other hull lacks.
    """
    record = panel.Record(program)
    executed: list[int] = []

    def trace(line: Line, session: Session) -> None:
        executed.append(line.index)
        record(line, session)

    session = Session(program, deck, options, tracer=trace)
    try:
        ending, goal = None, 0
        while ending is None and not record.repeats:
            goal += _STRIDE
            ending = run_with_operator(session, Operator(), goal)
        # A run that never ends is compared up to its repetition.
        options = options if ending is not None else replace(options, limit=session.state.work)
        comparison = diverge(program, deck, options.numbers, numbers("exact"), options, values=False)
    except EmulatorError as error:
        return {"lines": [str(error)]}
    result = session.result() if ending is None else session.result(ending)
    hulls, says = _hulls(record.stages, result) if record.stages else ({}, "")
    if second := second_program(result):
        says = f"To see whether the hull is right, run program {second} with the punched cards and compare again."
    decision = comparison.first_decision
    if decision is None:
        same = comparison.apart or "exact arithmetic takes every decision of this run in the same way"
        return hulls | {"lines": [same], "says": says}
    lines = [f"{place_of(decision.line)}: {decision.line.text}"]
    for name, value, target in zip(("eight digits", "exact"), decision.values, decision.targets, strict=True):
        lines.append(f"{name}: {value}, goes to {place_of(target) if target else 'the end'}")
    executions = (n for n, index in enumerate(executed, 1) if index == decision.line.index)
    statement = next(n for count, n in enumerate(executions, 1) if count == decision.time)
    value, exact = decision.values
    wrong = (
        f"Card {decision.line.place.card} decided wrongly: eight digits gave {value}, and the exact value is {exact}."
    )
    return hulls | {"lines": lines, "statement": statement, "says": f"{wrong} {says}".strip()}


def _hulls(stages: Sequence[Hull], result: Result) -> tuple[dict[str, Hull], str]:
    """Return the two hulls by name, and a sentence about their difference."""
    first, last = stages[0], stages[-1]
    exact = [panel.exact(point) for point in first["points"]]
    points = scaled(exact)
    dimension, loops = true_hull(points)
    if dimension == 2:
        loops = tuple(pair for loop in loops for pair in zip(loop, loop[1:] + loop[:1], strict=True))
    corners = sorted({n for loop in loops for n in loop})
    hull = {"points": first["points"], "vertices": corners, "faces": [list(loop) for loop in loops]}
    kind = "side" if dimension == 2 else "face"
    true = f"the true hull has {_count(corners, 'vertex')} and {_count(loops, kind)}"
    if not last.get("final") or refusal(result):
        return {"hull": hull}, f"The program punched no complete hull; {true}."
    # The program may have exchanged or deleted points since the first stage.
    index_of: dict[tuple[Fraction, ...], int] = {point: n for n, point in reversed(list(enumerate(exact)))}
    faces = [[index_of[panel.exact(last["points"][n])] for n in face] for face in last["faces"]]
    vertices = [n for point in read_hull(result.punched).vertices if (n := index_of.get(point)) is not None]
    on, true_on = ([_on(points, face, dimension) for face in some] for some in (faces, loops))
    missed, extra = _without(corners, vertices, points), _without(vertices, corners, points)
    wrong = [n for n, members in enumerate(on) if members not in true_on]
    lost = [n for n, members in enumerate(true_on) if members not in on]
    differences = [
        _count(items, name)
        for items, name in (
            (missed, "missing vertex"),
            (extra, "extra vertex"),
            (lost, f"missing {kind}"),
            (wrong, "wrong equation"),
        )
        if items
    ]
    punched = f"The program punched {_count(vertices, 'vertex')} and {_count(faces, 'equation')}; {true}."
    says = (
        f"{punched} Differences: {', '.join(differences)}."
        if differences
        else f"The hull of the points on these cards is right: {true}."
    )
    marks = {"missed": missed, "extra": extra}
    final = {"points": first["points"], "vertices": vertices, "faces": faces, "wrong": wrong} | marks
    return {"hull": hull | marks | {"wrong": lost}, "final": final}, says


def _without(some: Sequence[int], others: Sequence[int], points: Sequence[Whole]) -> list[int]:
    """Return the indices in ``some`` whose points are not among the points of ``others``."""
    places = {points[n] for n in others}
    return [n for n in some if points[n] not in places]


def _on(points: Sequence[Whole], face: Sequence[int], dimension: int) -> frozenset[Whole]:
    """Return the points in the plane (or on the line) of a face, or none if the plane does not support the hull."""
    a, b = points[face[0]], points[face[1]]
    if dimension == 3:
        normal = cross(minus(b, a), minus(points[face[2]], a))
    else:
        # In a plane, the normal of a line is that of the plane through the line and a point outside it, turned.
        planes = (cross(minus(b, a), minus(point, a)) for point in points)
        normal = cross(next(filter(any, planes), (0, 0, 0)), minus(b, a))
    heights = [dot(normal, minus(point, a)) for point in points]
    if not any(normal) or min(heights) < 0 < max(heights):
        return frozenset()
    return frozenset(point for point, height in zip(points, heights, strict=True) if not height)


def _count(items: Sequence[object], name: str) -> str:
    adjective, _, noun = name.rpartition(" ")
    noun = noun if len(items) == 1 else _PLURALS.get(noun, f"{noun}s")
    return " ".join(filter(None, (str(len(items)), adjective, noun)))
