"""Where 1963 and exact numbers part: a visitor's points, what the programs make of them, and what is true.

For the page of the same name, in plain data, and without numpy.  The true hull is found here by looking at every plane
through three points, which 51 points bear (:func:`true_hull`): a way that shares nothing with the programs, the port or
the judge, and that the tests compare with the judge.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import partial
from itertools import combinations
from math import lcm
from typing import Any

from emulator.errors import EmulatorError
from emulator.language.cards import Deck
from emulator.machine.divergence import diverge
from emulator.machine.result import Options
from emulator.numbers import numbers
from modern.edition import programs
from modern.formats.deck import data_deck
from modern.formats.points import parse_bytes
from modern.geometry.numbers import coordinates
from modern.geometry.vectors import cross, dot, minus
from modern.thesis.cards import read_hull
from modern.thesis.job import HullRun, run_hull
from modern.thesis.refusals import Cause, explain_run

MOST = 51
"""Points of a data set, as many as the programs have places for."""
LIMIT = 300_000
"""Work a run may do here: three times what 51 points take."""
Whole = tuple[int, int, int]


def parted(text: str) -> dict[str, Any]:
    """What there is to show of points given as text, a point a line.

    Answers with ``points`` (as typed), ``true`` and ``found``, each ``dimension``, ``vertices`` (numbers from 0) and
    ``faces`` (loops of such numbers; a polygon or a line is one face), ``says``: lines, and ``part``: the first
    statement that eight digits mislead, lines, empty where there is none.  Or with ``refused``, a line.
    """
    try:
        given = parse_bytes(text.encode(), "points")
        deck = data_deck(given.points, "points")
    except (EmulatorError, ValueError) as error:
        return {"refused": str(error)}
    if len(given.points) > MOST:
        return {"refused": f"{len(given.points)} points; the programs take {MOST}"}
    points = scaled([coordinates(point) for point in given.points])
    run, cause = explain_run(partial(run_hull, deck, programs.program, Options(limit=LIMIT)))
    dimension, faces = true_hull(points)
    says, found = _found(run, cause, given.points)
    right = {n for face in faces for n in face}
    if found["faces"] or found["vertices"]:
        says += _compared(right, set(found["vertices"]), points)
    return {
        "points": [list(point) for point in given.points],
        "true": {"dimension": dimension, "vertices": sorted(right), "faces": [list(face) for face in faces]},
        "found": found,
        "says": says,
        "part": list(_part(run, deck)),
    }


def scaled(points: Sequence[tuple[Fraction, Fraction, Fraction]]) -> list[Whole]:
    """Points as whole numbers, each coordinate multiplied by one common number."""
    by = lcm(1, *(value.denominator for point in points for value in point))
    return [(int(x * by), int(y * by), int(z * by)) for x, y, z in points]


def true_hull(points: Sequence[Whole]) -> tuple[int, tuple[tuple[int, ...], ...]]:
    """The hull's dimension, and its faces as loops of places: of a polygon itself, of a line its ends, of a point it.

    A plane through three points is a face's where no two points lie on different sides of it.  Of equal points the
    first is taken.  Points that lie on a side or in a face without being a corner are in no loop.
    """
    places = sorted({point: n for n, point in reversed(list(enumerate(points)))}.values())
    first = places[0]
    second = next((n for n in places if points[n] != points[first]), None)
    if second is None:
        return 0, ((first,),)
    line = minus(points[second], points[first])
    third = next((n for n in places if any(cross(line, minus(points[n], points[first])))), None)
    if third is None:
        ends = sorted(places, key=lambda n: dot(line, points[n]))
        return 1, ((ends[0], ends[-1]),)
    normal = cross(line, minus(points[third], points[first]))
    level = dot(normal, points[first])
    if all(dot(normal, points[n]) == level for n in places):
        return 2, (_loop(points, places, normal),)
    return 3, tuple(_faces(points, places))


def _faces(points: Sequence[Whole], places: Sequence[int]) -> Iterator[tuple[int, ...]]:
    seen: set[frozenset[int]] = set()
    for a, b, c in combinations(places, 3):
        normal = cross(minus(points[b], points[a]), minus(points[c], points[a]))
        if not any(normal) or any({a, b, c} <= face for face in seen):
            continue
        level, sides = dot(normal, points[a]), set()
        within = []
        for n in places:
            height = dot(normal, points[n]) - level
            if height:
                sides.add(height > 0)
                if len(sides) == 2:
                    break
            else:
                within.append(n)
        else:
            seen.add(frozenset(within))
            yield _loop(points, within, normal)


def _loop(points: Sequence[Whole], within: Sequence[int], normal: Whole) -> tuple[int, ...]:
    """The corners of the hull of points in one plane, in order (Andrew's monotone chain, 1979).

    The coordinate in which the normal is largest is left out.
    """
    out = max(range(3), key=lambda axis: abs(normal[axis]))
    across, up = (axis for axis in range(3) if axis != out)
    order = sorted(within, key=lambda n: (points[n][across], points[n][up]))

    def half(some: Sequence[int]) -> list[int]:
        chain: list[int] = []
        for n in some:
            while len(chain) > 1 and _turn(*(points[k] for k in (chain[-2], chain[-1], n))) <= 0:
                chain.pop()
            chain.append(n)
        return chain[:-1]

    def _turn(p: Whole, q: Whole, r: Whole) -> int:
        return (q[across] - p[across]) * (r[up] - p[up]) - (q[up] - p[up]) * (r[across] - p[across])

    return tuple(half(order) + half(order[::-1]))


def _found(run: HullRun, cause: Cause | None, given: Sequence[Sequence[str]]) -> tuple[list[str], dict[str, Any]]:
    """What the programs say, in words and as data."""
    nothing: dict[str, Any] = {"dimension": -1, "vertices": [], "faces": []}
    if not run.complete:
        ending = run.final.result.ending
        lines = [run.refusal or ending.message]
        if cause is not None and cause.decision is not None:
            lines.append(f"decided by program {cause.program}, card {cause.decision.place.card}: {cause.decision.text}")
        if cause is not None and cause.fault:
            lines.append(f"known fault {cause.fault}")
        return lines, nothing
    hull = read_hull(run.final.result.punched)
    where: dict[tuple[Fraction, ...], int] = {}
    for n, point in enumerate(given):
        where.setdefault(coordinates(point), n)
    known = [where.get(point, -1) for point in hull.vertices]
    whole = scaled([coordinates(point) for point in given])
    dimension = {"program1": 1, "program2": 2, "program3": 3}[run.final.name]
    loops = [[known[k - 1] for k in ends] for ends, _ in hull.satisfied]
    if dimension == 3:
        loops = [list(_drawn(whole, loop)) for loop in loops]
    elif dimension == 2:
        loops = [[n for n in loop if n >= 0] for loop in loops]
    strange = known.count(-1)
    count = len(hull.vertices)
    lines = [f"{count} {'vertex' if count == 1 else 'vertices'}, {len(hull.equations)} equations"]
    if strange:
        lines.append(f"of the vertices punched {strange} are no points of the set: their coordinates were cut")
    return lines, {"dimension": dimension, "vertices": [n for n in known if n >= 0], "faces": [x for x in loops if x]}


def _drawn(points: Sequence[Whole], loop: Sequence[int]) -> tuple[int, ...]:
    """The corners a plane of the programs is said to have, in an order to draw them."""
    corners = [n for n in loop if n >= 0]
    for a, b, c in combinations(corners, 3):
        normal = cross(minus(points[b], points[a]), minus(points[c], points[a]))
        if any(normal):
            return _loop(points, corners, normal)
    return tuple(corners)


def _compared(right: set[int], found: set[int], points: Sequence[Whole]) -> list[str]:
    """Vertices missed and points wrongly called vertices, counted from 1; equal points are one."""
    at = {points[n] for n in right}, {points[n] for n in found}
    missed = [n + 1 for n in sorted(right) if points[n] not in at[1]]
    extra = [n + 1 for n in sorted(found) if points[n] not in at[0]]
    if not missed and not extra:
        return ["its vertices are those of the true hull"]
    says = []
    if missed:
        says.append(f"missed: {', '.join(f'point {n}' for n in missed)}")
    if extra:
        says.append(f"no vertex of the true hull: {', '.join(f'point {n}' for n in extra)}")
    return says


def _part(run: HullRun, deck: Deck) -> Iterator[str]:
    """The first decision, of whatever program ran, that exact numbers take otherwise."""
    for step in run.steps:
        try:
            found = diverge(
                step.program, step.deck, numbers("truncating"), numbers("exact"), Options(limit=LIMIT), values=False
            )
        except EmulatorError as error:
            yield str(error)
            return
        first = found.first_decision
        if first is not None:
            number = f"{first.line.label} " if first.line.label else ""
            yield f"program {step.number}, card {first.line.place.card}: {number}{first.line.text}"
            for name, value, target in zip(("eight digits", "exact"), first.values, first.targets, strict=True):
                yield f"{name}: {value}, goes to {target.name if target else 'the end'}"
            return
