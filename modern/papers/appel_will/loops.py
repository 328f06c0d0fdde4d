"""Surface loops from convex edges (appendix, steps 1 to 10), and the topological map (Fig. 23).

A line is an edge of the convex edge list, numbered L from 1, with the ends LC1(L) < LC2(L).  An entry of a loop is L
where the loop runs from LC1 to LC2, else -L.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from modern.geometry.vectors import cross, dot, minus
from modern.papers.appel_will.edges import IntPoint, Pair

TIMES = 2
"""How often each edge is used: an edge is the intersection of two convex planes."""


@dataclass(frozen=True, slots=True)
class Rules:
    """How the appendix is read.

    ``dot_condition``: of the lines L2 that will do, prefer one whose direction has a positive product with that of
    L1 (the main text's condition for two lines that give a plane), else take the first.  Without it the first is
    taken always, as step 3 has it.
    ``step_5``, ``step_7``: "go back to step 2" as printed, so that an L2 rejected there costs its L1 the turn; the
    corrected number is step 3.
    ``step_9``: as printed, which leaves out L1 and L2 only, not the other lines already on the loop.
    ``step_10``: "start another loop at step 1" as printed, so that every loop begins with all counts 0; the
    corrected number is step 2.
    """

    dot_condition: bool = True
    step_5: bool = False
    step_7: bool = False
    step_9: bool = False
    step_10: bool = False


PREFERRED = Rules()
"""The reading that gives all loops as printed, and every face of every hull."""


@dataclass(frozen=True, slots=True)
class Loop:
    """A loop, and the table as it stood when it was closed.

    ``entries`` are LUP(N, 1), LUP(N, 2), ...; ``kind`` the type of the first intersection (Fig. 20); ``start`` and
    ``match`` the points SP and MP of step 8; ``uses`` IUC(1), IUC(2), ... after the loop.
    """

    entries: tuple[int, ...]
    kind: int
    start: int
    match: int
    uses: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class LoopTable:
    """All loops in the order they were found; ``stopped`` says why the search ended before its end, if it did."""

    loops: tuple[Loop, ...]
    uses: tuple[int, ...]
    stopped: str = ""

    @property
    def closed(self) -> bool:
        """Whether every edge is used twice."""
        return bool(self.uses) and all(count == TIMES for count in self.uses)


@dataclass(frozen=True, slots=True)
class Intersection:
    """Lines L1 and L2 with a common point, classified (Fig. 20), and the two entries they make (Fig. 21).

    Type 1: both lines begin at the common point; 2: L1 begins and L2 ends there; 3: L1 ends and L2 begins there; 4:
    both end there.  Figs. 20 and 21 are lost: type 1 and its signs are certain from Figs. 21 and 22, the signs of the
    others follow from the sense of the loop, their numbers are this project's.
    """

    first: int
    second: int
    common: int
    kind: int
    entries: tuple[int, int]
    start: int
    match: int


def intersect(edges: Sequence[Pair], first: int, second: int) -> Intersection | None:
    """Lines ``first`` and ``second`` (numbered from 0), or None where they have no end in common (step 4)."""
    one, other = edges[first], edges[second]
    for kind, (a, b) in enumerate(((0, 0), (0, 1), (1, 0), (1, 1)), 1):
        if one[a] == other[b]:
            entries = (-(first + 1) if a == 0 else first + 1, second + 1 if b == 0 else -(second + 1))
            return Intersection(first, second, one[a], kind, entries, one[1 - a], other[1 - b])
    return None


def find_loops(points: Sequence[IntPoint], edges: Sequence[Pair], rules: Rules) -> LoopTable:
    """Steps 1 to 10.  The points that matter are the ends of the edges ("the vertex list" as reduced)."""
    vertices = sorted({end for edge in edges for end in edge})
    uses = [0] * len(edges)
    table = _Table(points, vertices, edges, uses, [], rules)
    loops: list[Loop] = []
    while True:
        begun = _begin(table)
        if begun is None:
            return LoopTable(tuple(loops), tuple(uses))
        entries = _follow(table, begun)
        if entries is None:
            lines = f"lines {begun.first + 1} and {begun.second + 1}"
            return LoopTable(tuple(loops), tuple(uses), f"the loop begun with {lines} does not come back to its start")
        for entry in entries:
            uses[abs(entry) - 1] += 1
        loops.append(Loop(tuple(entries), begun.kind, begun.start, begun.match, tuple(uses)))
        table.on_loops.append(frozenset(surface(entries, edges)))
        if rules.step_10:
            uses[:] = [0] * len(edges)


def surface(entries: Sequence[int], edges: Sequence[Pair]) -> tuple[int, ...]:
    """A loop's points: of each entry the end it starts from, LC1 of a positive and LC2 of a negative one (Fig. 23)."""
    return tuple(edges[abs(entry) - 1][0 if entry > 0 else 1] for entry in entries)


@dataclass(frozen=True, slots=True)
class _Table:
    """What the search for the next loop looks at: the reduced vertex list, the uses of the edges and the points of the
    loops so far, which grow."""

    points: Sequence[IntPoint]
    vertices: Sequence[int]
    edges: Sequence[Pair]
    uses: list[int]
    on_loops: list[frozenset[int]]
    rules: Rules


def _begin(table: _Table) -> Intersection | None:
    """Steps 2 to 8: the two lines the next loop begins with, or None when all edges were addressed in step 2."""
    for first in range(len(table.edges)):
        if table.uses[first] == TIMES:
            continue
        found = _seconds(table, first)
        chosen = next(found, None)
        if chosen is None:
            continue
        if table.rules.dot_condition and not _acute(table, chosen):
            return next((other for other in found if _acute(table, other)), chosen)
        return chosen
    return None


def _seconds(table: _Table, first: int) -> Iterator[Intersection]:
    """Steps 3 to 7: the lines that make a plane of the hull with line ``first``, on which no loop lies yet."""
    for second in range(len(table.edges)):
        if second == first or table.uses[second] == TIMES:
            continue
        both = intersect(table.edges, first, second)
        if both is None:
            continue
        three = {both.common, both.start, both.match}
        if any(three <= loop for loop in table.on_loops):
            if table.rules.step_5:
                return
        elif _is_convex_plane(table, both):
            yield both
        elif table.rules.step_7:
            return


def _is_convex_plane(table: _Table, both: Intersection) -> bool:
    """Steps 6 and 7: whether all points are in the plane of the two lines or on one side of it."""
    normal, origin = _plane(table.points, both)
    heights = (dot(normal, minus(table.points[p], origin)) for p in table.vertices)
    sides = {(height > 0) - (height < 0) for height in heights}
    return not {1, -1} <= sides


def _follow(table: _Table, both: Intersection) -> list[int] | None:
    """Steps 9 and 10: the entries of the whole loop, or None if it does not close.

    The list is searched no more often than it has lines, as the appendix advises.
    """
    normal, origin = _plane(table.points, both)
    entries = [*both.entries]
    left_out = {both.first, both.second}
    match = both.match
    for _ in table.edges:
        for line, (one, other) in enumerate(table.edges):
            if table.uses[line] == TIMES or line in left_out or match not in (one, other):
                continue
            beyond = other if one == match else one
            if beyond != both.start and dot(normal, minus(table.points[beyond], origin)):
                continue
            entries.append(line + 1 if one == match else -(line + 1))
            if beyond == both.start:
                return entries
            if not table.rules.step_9:
                left_out.add(line)
            match = beyond
            break
        else:
            return None
    return None


def _plane(points: Sequence[IntPoint], both: Intersection) -> tuple[IntPoint, IntPoint]:
    """A normal of the plane of two lines and their common point (step 6)."""
    origin = points[both.common]
    return cross(minus(points[both.start], origin), minus(points[both.match], origin)), origin


def _acute(table: _Table, both: Intersection) -> bool:
    """a_k a_l + b_k b_l + c_k c_l > 0 for the lines as directed from LC1 to LC2."""
    points, (p, q), (r, s) = table.points, table.edges[both.first], table.edges[both.second]
    return dot(minus(points[q], points[p]), minus(points[s], points[r])) > 0
