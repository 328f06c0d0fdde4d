"""Invariants of the printed tables and figures: relations that hold for every body, so that its shape need not be
known.

A convex polyhedron with V vertices, E edges and F faces has V <= 2 F - 4, F <= 2 V - 4, and V - E + F = 2.  If a row of
a table violates such a relation, the row is wrong or counts something else.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, pairwise

from modern.claims.published import PAPERS, printed_lines, results_of
from modern.edition.chapter4 import load_theorems
from modern.edition.chapter6_cards import load_chapter
from modern.edition.chapter6_grounds import incidences, of_role, plane_at, planes, vertices
from modern.papers import Lines

# The outcome for one row of a table: the id of its statement, its name, and whether it satisfies the invariant.
Outcome = tuple[str, str, bool]


@dataclass(frozen=True, slots=True)
class Invariant:
    """A relation that the rows of a printed table or figure must satisfy."""

    place: str
    says: str
    outcomes: Callable[[], Iterable[Outcome]]

    def violations(self) -> list[tuple[str, str]]:
        return [(statement, row) for statement, row, holds in self.outcomes() if not holds]


def _printed(paper: str) -> Lines:
    """Return the printed lines of a paper, after our emendations, by the id of their result."""
    return printed_lines(next(p for p in PAPERS if p.name == paper))


def _numbers(line: str) -> list[int]:
    return [int(number) for number in re.findall(r"-?\d+", line)]


def may_be_convex(corners: int, faces: int) -> bool:
    """Return True if a convex polyhedron with these numbers of vertices and faces exists."""
    return corners <= 2 * faces - 4 and faces <= 2 * corners - 4


def is_sphere(faces: Iterable[Sequence[object]]) -> bool:
    """Return True if every edge belongs to two faces and V - E + F = 2, so that the faces form a closed surface."""
    rings = [[*face] for face in faces]
    edges = Counter(frozenset(pair) for ring in rings for pair in pairwise([*ring, ring[0]]))
    corners = {corner for ring in rings for corner in ring}
    return {*edges.values()} == {2} and len(corners) - len(edges) + len(rings) == 2


@dataclass(frozen=True, slots=True)
class HalfBall:
    """A row of Table 5 of Kovalevsky and Schulz: a digitised half-ball and the sizes of its hull."""

    statement: str
    diameter: int
    triangles: int
    triangle_integers: int
    faces: int
    integers: int
    per_face: str

    @property
    def corners(self) -> Fraction:
        """The number of vertices that formula (6) implies: integers = 3 V + 5 F."""
        return Fraction(self.integers - 5 * self.faces, 3)


def half_balls() -> Iterator[HalfBall]:
    """Yield the rows of Table 5 as printed."""
    results = results_of(next(p for p in PAPERS if p.name == "kovalevsky-schulz"))
    rows = (result.printed[0].split() for result in results if result.id.startswith("table5-"))
    for number, (d, triangles, integers, _, faces, of_cells, per_face) in enumerate(rows, 86):
        statement = f"kovalevsky-schulz.{number}"
        yield HalfBall(statement, int(d), int(triangles), int(integers), int(faces), int(of_cells), per_face)


def _of_half_balls(holds: Callable[[HalfBall], bool]) -> Callable[[], Iterator[Outcome]]:
    return lambda: ((row.statement, f"d = {row.diameter}", holds(row)) for row in half_balls())


def _has_quarter_turns(row: HalfBall) -> bool:
    # A quarter turn leaves at most one vertex (an apex on the axis) and at most two faces (base and top) in place.
    top = row.faces % 4 - 1
    return top in (0, 1) and row.corners % 4 == 1 - top


def _rounded(row: HalfBall) -> bool:
    hundredths = Fraction(100 * row.integers, row.faces)
    return int(hundredths + Fraction(1, 2)) == int(row.per_face.replace(".", ""))


def _ball() -> Iterator[Outcome]:
    printed = _printed("kovalevsky-schulz")
    (_, voxels), (corners, _), (near_corners, _), (_, triangles), (faces,) = (
        _numbers(printed[name][0])
        for name in ("ball-voxels", "ball-corners-6", "ball-corners-26", "ball-triangles", "ball-faces")
    )
    yield "kovalevsky-schulz.20", "the centre of the ball is a voxel, as the number is odd", voxels % 2 == 1
    # The corners of voxels lie on no plane of symmetry, and the reflections in three planes move them in groups of 8.
    yield "kovalevsky-schulz.21", "both numbers of corners are multiples of 8", corners % 8 == near_corners % 8 == 0
    yield "kovalevsky-schulz.64", "the triangles have a multiple of 8 corners", (triangles + 4) % 16 == 0
    yield "kovalevsky-schulz.64", "at most 776 corners are used", triangles <= 2 * corners - 4
    yield "kovalevsky-schulz.64", "266 faces are possible", may_be_convex(near_corners, faces) and faces % 2 == 0
    yield "kovalevsky-schulz.22", "at most 360 corners are used", triangles <= 2 * near_corners - 4


def _cell_list() -> Iterator[Outcome]:
    printed = _printed("kovalevsky-schulz")
    ends = {e: (s, t) for e, s, t, _, _ in map(_numbers, printed["table2"])}
    sides = Counter(face for row in printed["table2"] for face in _numbers(row)[3:])
    rings = [_numbers(row)[2:] for row in printed["table3"]]
    at = {n: {*_numbers(row)[-3:]} for n, row in enumerate(printed["table1"], 1)}
    signed = {
        n: {sign * e for e, pair in ends.items() for p, sign in zip(pair, (-1, 1), strict=True) if p == n} for n in at
    }
    yield "kovalevsky-schulz.39", "every edge joins two different vertices", at == signed
    yield "kovalevsky-schulz.40", "every face has three edges", sides == dict.fromkeys(range(1, len(rings) + 1), 3)
    yield "kovalevsky-schulz.41", "the faces form a sphere", is_sphere(ring[::2] for ring in rings)
    passed = sorted(edge for ring in rings for edge in ring[1::2])
    yield (
        "kovalevsky-schulz.41",
        "the two faces of each edge pass it in opposite directions",
        passed == sorted((*ends, *(-e for e in ends))),
    )


def _table_4() -> Iterator[Outcome]:
    printed = _printed("kovalevsky-schulz")
    triangles, corners, integers = _numbers(printed["table4-triangulation"][0])
    yield "kovalevsky-schulz.83", "triangles", 2 * integers == 9 * triangles and abs(triangles - 2 * corners) <= 20
    faces, corners, integers = _numbers(printed["table4-hull"][0])
    yield "kovalevsky-schulz.84", "hull", integers == 3 * corners + 5 * faces and may_be_convex(corners, faces)


def _scenes() -> Iterator[Outcome]:
    printed = _printed("nakamae-nishita")
    for number, scene in enumerate("abcd", 53):
        solids, corners, faces, _ = _numbers(printed[f"table1-{scene}"][0].split(")")[1])
        possible = corners <= 2 * faces - 4 * solids and faces <= 2 * corners - 4 * solids and corners >= 4 * solids
        yield f"nakamae-nishita.{number}", f"({scene})", possible


def _figure_4() -> Iterator[Outcome]:
    rows = [line.split()[1].split(",") for line in _printed("appel-will")["fig4-topological-map"]]
    yield "appel-will.20", "map", is_sphere(rows)


def _columns(rows: Sequence[str]) -> list[list[int]]:
    """Return the columns of a table whose cells are separated by tabs, without the column of row labels."""
    cells = [row.split("\t")[1:] for row in rows]
    return [[n for row in cells if k < len(row) for n in _numbers(row[k])] for k in range(len(cells[0]))]


def _lines_of(rows: Sequence[str]) -> dict[int, tuple[int, int]]:
    return {label: (first, second) for label, first, second in map(_numbers, rows)}


def _is_closed(loop: Sequence[int], lines: Mapping[int, tuple[int, int]]) -> bool:
    """Return True if each signed line of a loop begins at the end of the line before it."""
    ways = [lines[abs(n)][:: 1 if n > 0 else -1] for n in loop]
    return all(here[0] == before[1] for before, here in zip([ways[-1], *ways], ways, strict=False))


def _figures_14_to_23() -> Iterator[Outcome]:
    """Yield the outcomes for Figs. 14, 22 and 23: the lists of lines, the loops with their counts IUC, and the map."""
    printed = _printed("appel-will")
    first, second = (printed[name] for name in ("fig22-loops-1-3", "fig22-loops-4-5"))
    fig22 = [_numbers(cell) for row in (first[0], second[0]) for cell in row.split("\t")[1::2]]
    fig23 = _columns(printed["fig23-loops"])
    for lines_of, loops, at, of_loops in (("fig14", fig22, "65", "111"), ("fig23-edges", fig23, "113", "114")):
        lines = _lines_of(printed[lines_of])
        ends = {p for pair in lines.values() for p in pair}
        yield f"appel-will.{at}", "lines in order", [*lines.values()] == sorted(pair for pair in lines.values())
        yield f"appel-will.{at}", "V - E + F = 2", len(ends) - len(lines) + len(loops) == 2
        uses = Counter(abs(n) for loop in loops for n in loop)
        yield f"appel-will.{of_loops}", "every line is on two loops", uses == dict.fromkeys(lines, 2)
        for number, loop in enumerate(loops, 1):
            yield f"appel-will.{of_loops}", f"loop {number} is closed", _is_closed(loop, lines)
    uses_after = [Counter(abs(n) for loop in fig22[:k] for n in loop) for k in (1, 2, 3)]
    for row in first[1:]:
        label, *rest = _numbers(row)
        yield "appel-will.111", f"IUC of line {label}", rest[::2] == [uses[label] for uses in uses_after]
    corners = [[lines[abs(n)][n < 0] for n in loop] for loop in fig23]
    yield "appel-will.115", "the map in Fig. 23 follows from the loops", _columns(printed["fig23-map"]) == corners
    yield "appel-will.115", "the surfaces of the map form a sphere", is_sphere(corners)


def _examples() -> Iterator[Outcome]:
    """Yield the outcomes for examples 4 to 6 of chapter 6, whose output lists vertices and equations."""
    chapter = load_chapter()
    for example, program in ((4, 2), (5, 3), (6, 3)):
        statement = f"thesis.{171 + example}"
        corners = vertices(chapter, example, program)
        named, equations = incidences(chapter, example, program), planes(chapter, example, program)
        uses = Counter(frozenset(pair) for ring in named.values() for pair in combinations(ring, 2))
        if program == 2:
            closed = {*Counter(v for ring in named.values() for v in ring).values()} == {2}
            yield statement, "every vertex is on two lines", closed and len(named) == len(corners)
        else:
            euler = len(corners) - len(uses) + len(named) == 2 and {*uses.values()} == {2}
            yield statement, "the planes form a sphere", euler and may_be_convex(len(corners), len(named))
        vanish = all(plane_at(equations[n], corners[v - 1]) == 0 for n, ring in named.items() for v in ring)
        yield statement, "the equations vanish at their vertices", vanish
        points = [of_role(chapter, example, program, role) for role in ("inside", "boundary", "vertex")]
        deck = of_role(chapter, example, 1, "point", "deck")
        yield statement, "inside, boundary and vertices add up to N", sum(map(len, points)) == len(deck)


def _tables_of_chapter_4() -> Iterator[Outcome]:
    theorems = {theorem.id: theorem for theorem in load_theorems()}
    table_1, table_8 = theorems["4.2"], theorems["4.8"]
    yield "thesis.115", "Table 1 is a sphere", is_sphere(plane.vertices for plane in table_1.planes)
    hull = [p for p in table_8.points if p.name != "Q9"]
    on = [sum(plane.at(p) == 0 for p in hull) for plane in table_8.planes]
    # A face has as many edges as vertices, and each edge is on two planes: the vertex counts of the planes add to 2 E.
    yield "thesis.150", "V - E + F = 2", 2 * (len(hull) + len(on) - 2) == sum(on)
    yield "thesis.150", "V <= 2 F - 4", may_be_convex(len(hull), len(on))


INVARIANTS: tuple[Invariant, ...] = (
    Invariant(
        "Table 5",
        "4.5 integers for each triangle",
        _of_half_balls(lambda r: 2 * r.triangle_integers == 9 * r.triangles),
    ),
    Invariant(
        "Table 5", "a closed surface has an even number of triangles", _of_half_balls(lambda r: r.triangles % 2 == 0)
    ),
    Invariant("Table 5", "the quotient is rounded to two decimals", _of_half_balls(_rounded)),
    Invariant("Table 5", "integers = 3 V + 5 F for an integer V", _of_half_balls(lambda r: r.corners.denominator == 1)),
    Invariant(
        "Table 5", "V <= 2 F - 4 and F <= 2 V - 4", _of_half_balls(lambda r: may_be_convex(int(r.corners), r.faces))
    ),
    Invariant("Table 5", "quarter turns map the half-ball to itself", _of_half_balls(_has_quarter_turns)),
    Invariant("section 2 of Kovalevsky and Schulz", "the ball is symmetric and its triangles have V corners", _ball),
    Invariant("Tables 1 to 3 of Kovalevsky and Schulz", "the sublists agree", _cell_list),
    Invariant("Table 4 of Kovalevsky and Schulz", "formulas (5) and (6), V <= 2 F - 4", _table_4),
    Invariant("Table 1 of Nakamae and Nishita", "n solids have V <= 2 F - 4 n and F <= 2 V - 4 n", _scenes),
    Invariant("Fig. 4 of Appel and Will", "each line is on two surfaces, V - E + F = 2", _figure_4),
    Invariant("Figs. 14, 22 and 23 of Appel and Will", "loops are closed and use each line twice", _figures_14_to_23),
    Invariant("chapter 6 of the thesis", "the output describes a closed surface of all points", _examples),
    Invariant("tables of chapter 4 of the thesis", "V - E + F = 2", _tables_of_chapter_4),
)
