"""Compare the result of the 1963 programs with the true hull, for points that a visitor of the site enters.

The module returns plain data and needs no numpy, so that it runs in the browser. The function :func:`true_hull` tests
every plane through three points, which is fast enough for 51 points. The function shares no code with the programs, the
port or the exact hull. The tests compare its results with the exact hull.
"""

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import partial
from itertools import combinations
from math import lcm
from typing import Any

from emulator.errors import EmulatorError
from emulator.machine.result import Options
from modern.edition import programs
from modern.formats.deck import data_deck
from modern.formats.points import parse_bytes
from modern.geometry.numbers import coordinates
from modern.geometry.vectors import cross, dot, minus
from modern.thesis.cards import read_hull
from modern.thesis.explanation import explanation, first_disagreement
from modern.thesis.job import HullRun, run_hull
from modern.thesis.refusals import explain_run

# The largest number of points; the arrays of the programs have 51 elements.
MOST = 51
# The largest number of statements that a run may execute, three times the number that 51 points need.
LIMIT = 300_000
Whole = tuple[int, int, int]


def parted(text: str) -> dict[str, Any]:
    """Compare the hull that the 1963 programs find with the true hull. ``text`` has one point on each line.

    The answer has ``points`` as typed, the hull ``true`` and the hull ``found`` by the programs. Each hull has
    ``vertices`` (indices from 0) and ``faces`` (loops of indices). A polygon or a line is one face. ``says`` has
    messages about the run. ``reason`` explains why a run gave no hull, and ``part`` names the first decision at which
    exact arithmetic takes another branch. Both have the wording of ``hull --explain``. For invalid input the answer has
    only ``refused``, a message.
    """
    try:
        parsed = parse_bytes(text.encode(), "points")
        deck = data_deck(parsed.points, "points")
    except (EmulatorError, ValueError) as error:
        return {"refused": str(error)}
    if len(parsed.points) > MOST:
        return {"refused": f"{len(parsed.points)} points; the programs accept at most {MOST}"}
    points = scaled([coordinates(point) for point in parsed.points])
    options = Options(limit=LIMIT)
    run, cause = explain_run(partial(run_hull, deck, programs.program, options))
    dimension, faces = true_hull(points)
    messages, program_hull = _program_hull(run, parsed.points)
    true_vertices = {n for face in faces for n in face}
    if program_hull["faces"] or program_hull["vertices"]:
        messages += _differences(true_vertices, set(program_hull["vertices"]), points)
    return {
        "points": [list(point) for point in parsed.points],
        "true": {
            "text": _described(dimension, faces),
            "vertices": sorted(true_vertices),
            "faces": list(map(list, faces)),
        },
        "found": program_hull,
        "says": messages,
        "reason": list(explanation(cause)) if cause is not None else [],
        "part": first_disagreement(run, options),
    }


def _described(dimension: int, faces: Sequence[Sequence[int]]) -> str:
    count = len({n for face in faces for n in face})
    kinds = ("a point", "a line segment with two ends", f"a polygon with {count} vertices")
    return kinds[dimension] if dimension < 3 else f"a polyhedron with {count} vertices and {len(faces)} faces"


def scaled(points: Sequence[tuple[Fraction, Fraction, Fraction]]) -> list[Whole]:
    """Scale points to integers with a common factor."""
    factor = lcm(1, *(value.denominator for point in points for value in point))
    return [(int(x * factor), int(y * factor), int(z * factor)) for x, y, z in points]


def true_hull(points: Sequence[Whole]) -> tuple[int, tuple[tuple[int, ...], ...]]:
    """Return the dimension of the hull and its faces as loops of indices.

    A polygon has one face. A segment is the loop of its two ends, and a point is the loop of itself. A loop contains
    only corners, not the other points on its edges or in its face. Of equal points, only the first is used.
    """
    # Extend the hull from a point to a line, a plane and space, and stop if no point lies outside.
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
    known_faces: set[frozenset[int]] = set()
    for a, b, c in combinations(places, 3):
        normal = cross(minus(points[b], points[a]), minus(points[c], points[a]))
        # Skip three points on a line, and three points of a face that is known already.
        if not any(normal) or any({a, b, c} <= face for face in known_faces):
            continue
        # A plane through three points supports a face if all points lie on one side of it.
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
            known_faces.add(frozenset(within))
            yield _loop(points, within, normal)


def _loop(points: Sequence[Whole], within: Sequence[int], normal: Whole) -> tuple[int, ...]:
    """Return the corners of the hull of points in one plane, in order (Andrew's monotone chain, 1979).

    The points are projected along the axis of the normal's largest component.
    """
    dropped = max(range(3), key=lambda axis: abs(normal[axis]))
    across, up = (axis for axis in range(3) if axis != dropped)
    order = sorted(within, key=lambda n: (points[n][across], points[n][up]))

    def half(ordered: Sequence[int]) -> list[int]:
        chain: list[int] = []
        for n in ordered:
            while len(chain) > 1 and _turn(*(points[k] for k in (chain[-2], chain[-1], n))) <= 0:
                chain.pop()
            chain.append(n)
        return chain[:-1]

    def _turn(p: Whole, q: Whole, r: Whole) -> int:
        return (q[across] - p[across]) * (r[up] - p[up]) - (q[up] - p[up]) * (r[across] - p[across])

    return tuple(half(order) + half(order[::-1]))


def _program_hull(run: HullRun, typed: Sequence[Sequence[str]]) -> tuple[list[str], dict[str, Any]]:
    if not run.complete:
        return [run.refusal or run.final.result.ending.message], {"vertices": [], "faces": []}
    hull = read_hull(run.final.result.punched)
    index_of: dict[tuple[Fraction, ...], int] = {}
    for n, point in enumerate(typed):
        index_of.setdefault(coordinates(point), n)
    indices = [index_of.get(point, -1) for point in hull.vertices]
    points = scaled([coordinates(point) for point in typed])
    dimension = {"program1": 1, "program2": 2, "program3": 3}[run.final.name]
    loops = [[indices[k - 1] for k in ends] for ends, _ in hull.satisfied]
    if dimension == 3:
        loops = [list(_in_order(points, loop)) for loop in loops]
    elif dimension == 2:
        loops = [[n for n in loop if n >= 0] for loop in loops]
    unknown = indices.count(-1)
    count = len(set(hull.vertices))
    repeated = ", one of them repeated" if count < len(hull.vertices) else ""
    lines = [f"{count} {'vertex' if count == 1 else 'vertices'}{repeated}, {len(hull.equations)} equations"]
    if unknown:
        lines.append(f"{unknown} punched vertices are not points of the set: their coordinates were truncated")
    vertices = list(dict.fromkeys(n for n in indices if n >= 0))
    return lines, {"vertices": vertices, "faces": [x for x in loops if x]}


def _in_order(points: Sequence[Whole], loop: Sequence[int]) -> tuple[int, ...]:
    """Return the corners of a face that the programs punched, sorted in their order around the face."""
    corners = [n for n in loop if n >= 0]
    for a, b, c in combinations(corners, 3):
        normal = cross(minus(points[b], points[a]), minus(points[c], points[a]))
        if any(normal):
            return _loop(points, corners, normal)
    return tuple(corners)


def _differences(true_vertices: set[int], punched: set[int], points: Sequence[Whole]) -> list[str]:
    """Describe how the vertices of the two hulls differ, with points counted from 1. Equal points count as one."""
    true_points, punched_points = {points[n] for n in true_vertices}, {points[n] for n in punched}
    missed = [f"point {n + 1}" for n in sorted(true_vertices) if points[n] not in punched_points]
    extra = [f"point {n + 1}" for n in sorted(punched) if points[n] not in true_points]
    if not missed and not extra:
        return ["the vertices are those of the true hull"]
    messages = []
    if missed:
        messages.append(f"vertices of the true hull that the programs missed: {', '.join(missed)}")
    if extra:
        messages.append(f"punched, but not vertices of the true hull: {', '.join(extra)}")
    return messages
