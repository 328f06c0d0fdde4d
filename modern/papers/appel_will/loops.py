"""Assemble convex edges into loops, the borders of faces (appendix, steps 1 to 10; Fig. 23).

A line is a convex edge, an edge of the hull. Lines have the numbers L = 1, 2, 3 and so on. Line L has the ends LC1(L)
and LC2(L), with LC1(L) < LC2(L). A loop has the entry L if it runs along the line from LC1(L) to LC2(L), and the entry
-L if it runs from LC2(L) to LC1(L).
"""

from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass

from modern.geometry.vectors import cross, dot, minus
from modern.papers.appel_will.star import IntPoint, Pair

# The number of loops that use an edge, which is the intersection of two planes of the hull.
TIMES = 2


@dataclass(frozen=True, slots=True)
class Loop:
    """The border of a face as a list of edges, and the state of the search after the loop was closed.

    ``entries`` are the paper's LUP(N, 1), LUP(N, 2) and so on for loop N. ``kind`` is the type of the intersection of
    the first two edges (Fig. 20). ``start`` and ``match`` are the points SP and MP of step 8: the loop starts at SP and
    continues from MP. ``uses`` has for each edge L the count IUC(L) after the loop: the number of its uses in all loops
    so far, or in this loop alone if step 10 is applied as printed.
    """

    entries: tuple[int, ...]
    kind: int
    start: int
    match: int
    uses: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class LoopTable:
    """All loops (borders of faces) in the order of the search.

    ``uses`` has the counts IUC at the end. They are wrong, namely all 0, if step 10 is applied as printed. ``stopped``
    is the reason why the search failed, or "".
    """

    loops: tuple[Loop, ...]
    uses: tuple[int, ...]
    stopped: str = ""

    @property
    def in_loops(self) -> tuple[int, ...]:
        """For each edge, the number of its uses in the loops, counted from the loops and not taken from IUC."""
        counts = Counter(abs(entry) for loop in self.loops for entry in loop.entries)
        return tuple(counts[label] for label in range(1, len(self.uses) + 1))

    @property
    def closed(self) -> bool:
        """True if every edge belongs to two loops."""
        return bool(self.uses) and all(count == TIMES for count in self.in_loops)


@dataclass(frozen=True, slots=True)
class Intersection:
    """Two edges L1 and L2 with a common end point, the type of their intersection, and their two entries in a loop.

    ``start`` and ``match`` are the other ends of L1 and L2. Fig. 20 shows the four types, and Fig. 21 the entries. In
    type 1 both lines begin at the common point. In type 2 L1 begins and L2 ends at this point, in type 3 L1 ends and L2
    begins at it, and in type 4 both end at it. The drawings of Figs. 20 and 21 are lost. The text of Figs. 21 and 22
    determines type 1 and the signs of its loop entries. For the other types, the signs follow from the sense of the
    loop, and the project has chosen which of them is called 2, 3 and 4.
    """

    first: int
    second: int
    common: int
    kind: int
    entries: tuple[int, int]
    start: int
    match: int


def intersect(edges: Sequence[Pair], first: int, second: int) -> Intersection | None:
    """Return the intersection of two edges at a common end point, or None if they have none (step 4 of the paper).

    ``first`` and ``second`` are the indices of the edges, from 0.
    """
    ends_1, ends_2 = edges[first], edges[second]
    for kind, (a, b) in enumerate(((0, 0), (0, 1), (1, 0), (1, 1)), 1):
        if ends_1[a] == ends_2[b]:
            # The loop runs along L1 to the common point and away from it along L2. A line is entered with a minus
            # sign if that is against its direction from LC1 to LC2.
            entries = (-(first + 1) if a == 0 else first + 1, second + 1 if b == 0 else -(second + 1))
            return Intersection(first, second, ends_1[a], kind, entries, ends_1[1 - a], ends_2[1 - b])
    return None


def find_loops(points: Sequence[IntPoint], edges: Sequence[Pair], printed: Collection[str] = ()) -> LoopTable:
    """Find all loops (borders of faces) of the convex edges, by steps 1 to 10 of the paper's appendix.

    ``printed`` names the steps to apply as printed, although wrong (see :class:`modern.papers.appel_will.hull.Method`).
    """
    vertices = sorted({end for edge in edges for end in edge})
    uses = [0] * len(edges)  # step 1: all counts IUC are 0
    table = _Table(points, vertices, edges, uses, [], printed)
    loops: list[Loop] = []
    while True:
        begun = _begin(table)
        if begun is None:
            return LoopTable(tuple(loops), tuple(uses))
        entries = _follow(table, begun)
        if entries is None:
            lines = f"lines {begun.first + 1} and {begun.second + 1}"
            return LoopTable(tuple(loops), tuple(uses), f"the loop begun with {lines} does not return to its start")
        # Step 10: count the uses of the lines, enter the loop and start the next one.
        for entry in entries:
            uses[abs(entry) - 1] += 1
        loops.append(Loop(tuple(entries), begun.kind, begun.start, begun.match, tuple(uses)))
        table.on_loops.append(frozenset(surface(entries, edges)))
        if "step10" in printed:
            # As printed the next loop starts at step 1, which clears the counts.
            uses[:] = [0] * len(edges)


def surface(entries: Sequence[int], edges: Sequence[Pair]) -> tuple[int, ...]:
    """Return the points around a face: the end of each edge of its loop at which the loop enters the edge."""
    return tuple(edges[abs(entry) - 1][0 if entry > 0 else 1] for entry in entries)


@dataclass(frozen=True, slots=True)
class _Table:
    """The state of the search for loops: the edges with their points, and how often each was used."""

    points: Sequence[IntPoint]
    vertices: Sequence[int]
    edges: Sequence[Pair]
    uses: list[int]
    on_loops: list[frozenset[int]]
    printed: Collection[str]


def _begin(table: _Table) -> Intersection | None:
    """Return the first two edges of the next loop, or None if all edges have been tried (steps 2 to 8)."""
    for first in range(len(table.edges)):
        if table.uses[first] == TIMES:
            continue
        admissible = _seconds(table, first)
        chosen = next(admissible, None)
        if chosen is None:
            continue
        # If no L2 has a positive product, as in a cube, the first admissible L2 is taken.
        if "step3" not in table.printed and not _acute(table, chosen):
            return next((candidate for candidate in admissible if _acute(table, candidate)), chosen)
        return chosen
    return None


def _seconds(table: _Table, first: int) -> Iterator[Intersection]:
    """Yield the intersection of edge ``first`` with each possible second edge of a new loop (steps 3 to 7)."""
    for second in range(len(table.edges)):
        if second == first or table.uses[second] == TIMES:
            continue
        crossing = intersect(table.edges, first, second)  # step 4
        if crossing is None:
            continue
        # Step 5: three points that already lie on one loop would give its plane again.
        three = {crossing.common, crossing.start, crossing.match}
        if any(three <= loop for loop in table.on_loops):
            if "step5" in table.printed:
                return
        elif _is_convex_plane(table, crossing):
            yield crossing
        elif "step7" in table.printed:
            return


def _is_convex_plane(table: _Table, crossing: Intersection) -> bool:
    """Return True if the plane through two edges does not have points on both of its sides (steps 6 and 7)."""
    normal, origin = _plane(table.points, crossing)
    heights = (dot(normal, minus(table.points[p], origin)) for p in table.vertices)
    sides = {(height > 0) - (height < 0) for height in heights}
    return not {1, -1} <= sides


def _follow(table: _Table, crossing: Intersection) -> list[int] | None:
    """Return the entries of the loop that begins with the two edges of ``crossing`` (steps 9 and 10).

    Return None if the loop does not close. As the appendix advises, the search gives up if the loop does not close
    within as many lines as the hull has edges.
    """
    normal, origin = _plane(table.points, crossing)
    entries = [*crossing.entries]
    excluded = {crossing.first, crossing.second}
    match = crossing.match
    for _ in table.edges:
        # Step 9: find a line L3 from the match point MP whose other end is SP or lies in the plane of the loop.
        for line, (lc1, lc2) in enumerate(table.edges):
            if table.uses[line] == TIMES or line in excluded or match not in (lc1, lc2):
                continue
            beyond = lc2 if lc1 == match else lc1
            if beyond != crossing.start and dot(normal, minus(table.points[beyond], origin)):
                continue
            entries.append(line + 1 if lc1 == match else -(line + 1))
            if beyond == crossing.start:
                return entries
            # Step 9 as printed excludes L1 and L2 only. The line just entered would then match from its other end.
            if "step9" not in table.printed:
                excluded.add(line)
            match = beyond
            break
        else:
            return None
    return None


def _plane(points: Sequence[IntPoint], crossing: Intersection) -> tuple[IntPoint, IntPoint]:
    """Return a normal of the plane of two intersecting edges, and their common point (step 6)."""
    origin = points[crossing.common]
    return cross(minus(points[crossing.start], origin), minus(points[crossing.match], origin)), origin


def _acute(table: _Table, crossing: Intersection) -> bool:
    """Return True if two edges, directed from LC1 to LC2, form an acute angle: their scalar product is positive."""
    points, (p, q), (r, s) = table.points, table.edges[crossing.first], table.edges[crossing.second]
    return dot(minus(points[q], points[p]), minus(points[s], points[r])) > 0
