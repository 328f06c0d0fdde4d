"""Relations that every printed table and figure must satisfy, whatever the shape of the body.

A convex polyhedron with V vertices, E edges and F faces has V <= 2 F - 4, F <= 2 V - 4, and V - E + F = 2.  If a row of
a table violates such a relation, the row is wrong or counts something else.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, pairwise, product

from modern.claims.evidence import Check, claim, exhibited
from modern.claims.published import PAPERS, printed_lines
from modern.edition.chapter4 import load_theorems
from modern.edition.chapter6 import input_deck, prints
from modern.formats.deck import exact_points
from modern.papers import Lines
from modern.thesis.cards import read_hull

# The name of a relation, and whether the corrected print satisfies it.
Outcome = tuple[str, bool]
# A message names up to this number of relations and counts more of them.
_MOST_NAMES = 4


def corrected_print(paper: str) -> Lines:
    """Return the printed lines of a paper, after the project's emendations, by the id of their result."""
    return printed_lines(next(p for p in PAPERS if p.name == paper))


def numbers_in(line: str) -> list[int]:
    return [int(number) for number in re.findall(r"-?\d+", line)]


def satisfied(place: str, outcomes: Iterable[Outcome]) -> Check:
    """Return the check that the corrected print at ``place`` satisfies all relations, or names the violated ones."""
    relations = [*outcomes]
    violated = [name for name, holds in relations if not holds]
    names = [name for name, _ in relations]
    held = ", ".join(names) if len(names) <= _MOST_NAMES else f"all {len(names)} relations tested"
    message = f"violates: {', '.join(violated)}" if violated else f"satisfies: {held}"
    return exhibited(relations and not violated, f"{place}: the corrected print {message}")


def plane_at(plane: Sequence[Fraction], point: Sequence[Fraction]) -> Fraction:
    return sum((c * x for c, x in zip(plane, (*point, Fraction(1)), strict=True)), Fraction(0))


def may_be_convex(corners: int, faces: int) -> bool:
    """Return True if a convex polyhedron with these numbers of vertices and faces exists."""
    return corners <= 2 * faces - 4 and faces <= 2 * corners - 4


def is_sphere(faces: Iterable[Sequence[object]]) -> bool:
    """Return True if every edge is on two faces and V - E + F = 2: the faces then form a surface like a sphere."""
    rings = [[*face] for face in faces]
    edges = Counter(frozenset(pair) for ring in rings for pair in pairwise([*ring, ring[0]]))
    corners = {corner for ring in rings for corner in ring}
    return {*edges.values()} == {2} and len(corners) - len(edges) + len(rings) == 2


@dataclass(frozen=True, slots=True)
class HalfBall:
    """A row of Table 5 of Kovalevsky and Schulz: a digitised half-ball, and sizes of two descriptions of its hull."""

    diameter: int
    triangles: int
    triangle_integers: int
    faces: int
    integers: int
    per_face: str

    @property
    def corners(self) -> Fraction:
        """The number V of vertices by the paper's formula (6): a hull with F faces is stored in 3 V + 5 F integers."""
        return Fraction(self.integers - 5 * self.faces, 3)

    def has_quarter_turns(self) -> bool:
        """Return True if the numbers of faces and vertices permit that quarter turns map the body to itself.

        A quarter turn moves faces and vertices in groups of four, except either one face and an apex, or two faces.
        """
        top = self.faces % 4 - 1
        return top in (0, 1) and self.corners % 4 == 1 - top


def half_balls() -> Iterator[HalfBall]:
    """Yield the rows of Table 5 as printed, after the project's emendations."""
    for name, rows in corrected_print("kovalevsky-schulz").items():
        if name.startswith("table5-"):
            d, triangles, integers, _, faces, of_cells, per_face = rows[0].split()
            yield HalfBall(int(d), int(triangles), int(integers), int(faces), int(of_cells), per_face)


@claim("kovalevsky-schulz.171")
def table_5() -> Check:
    """Check the storage sizes in Kovalevsky and Schulz's Table 5, which are counts of stored integers.

    A list of triangles needs 4.5 integers for each triangle. A cell list with V vertices and F faces needs 3 V + 5 F
    integers.
    """
    outcomes: list[Outcome] = []
    for row in half_balls():
        hundredths = Fraction(100 * row.integers, row.faces)
        outcomes.append((f"4.5 integers at {row.diameter}", 2 * row.triangle_integers == 9 * row.triangles))
        outcomes.append((f"closed surface at {row.diameter}", row.triangles % 2 == 0))
        outcomes.append((f"3 V + 5 F at {row.diameter}", row.corners.denominator == 1))
        rounded = int(hundredths + Fraction(1, 2)) == int(row.per_face.replace(".", ""))
        outcomes.append((f"quotient at {row.diameter}", rounded))
    return satisfied("Table 5", outcomes)


@claim("kovalevsky-schulz.89")
def points_at_diameter_14() -> Check:
    """Check that Table 5 implies too many vertices for diameter 14: F faces allow at most 2 F - 4 vertices."""
    row = next(row for row in half_balls() if row.diameter == 14)
    message = f"Table 5 implies {row.corners} points, but {row.faces} faces allow at most {2 * row.faces - 4} vertices"
    return exhibited(not may_be_convex(int(row.corners), row.faces), message)


def numbers_of_ball() -> list[int]:
    """Return the printed counts of the ball of diameter 32.

    They are the numbers of voxels, of local corners by 6 and by 26 neighbours, of triangles and of faces.
    """
    printed = corrected_print("kovalevsky-schulz")
    names = ("ball-voxels", "ball-corners-6", "ball-corners-26", "ball-triangles", "ball-faces")
    return [
        numbers_in(printed[name][0])[0 if name != "ball-voxels" and name != "ball-triangles" else 1] for name in names
    ]


@claim("kovalevsky-schulz.20", "kovalevsky-schulz.21", "kovalevsky-schulz.64")
def ball_of_diameter_32() -> Check:
    """Check the printed counts of the ball of diameter 32 by its symmetry and by Euler's formula."""
    voxels, corners, near_corners, triangles, faces = numbers_of_ball()
    outcomes = [
        ("an odd number of voxels", voxels % 2 == 1),
        # The corners lie on no plane of symmetry, and the reflections in three planes move them in groups of 8.
        ("numbers of local corners divisible by 8", corners % 8 == near_corners % 8 == 0 and (triangles + 4) % 16 == 0),
        (f"no more triangles than {corners} corners can form", triangles <= 2 * corners - 4),
        ("a number of faces that a hull can have", may_be_convex(near_corners, faces) and faces % 2 == 0),
    ]
    return satisfied("ball of diameter 32", outcomes)


@claim("kovalevsky-schulz.64")
def triangles_of_360_corners() -> Check:
    """Check that 360 local corners, found by testing 26 neighbours, are too few for the printed 1404 triangles."""
    _, _, near_corners, triangles, _ = numbers_of_ball()
    most = 2 * near_corners - 4
    return exhibited(triangles > most, f"{near_corners} corners form at most {most} triangles; {triangles} are printed")


@claim("kovalevsky-schulz.39", "kovalevsky-schulz.40", "kovalevsky-schulz.41", "kovalevsky-schulz.42")
def cell_list() -> Check:
    """Check that the vertices, edges and faces of Tables 1 to 3 agree: every edge is on two vertices and two faces."""
    printed = corrected_print("kovalevsky-schulz")
    edges, faces = ([*map(numbers_in, printed[name])] for name in ("table2", "table3"))
    at = {n: {*numbers_in(row)[-3:]} for n, row in enumerate(printed["table1"], 1)}
    signed = {
        n: {sign * e for e, *pair, _, _ in edges for p, sign in zip(pair, (-1, 1), strict=True) if p == n} for n in at
    }
    # Seen from outside, an edge runs counterclockwise around its left face, and its reverse around its right face.
    passed = [(left, start, e) for e, start, _, left, _ in edges] + [(right, end, -e) for e, _, end, _, right in edges]
    listed = [(n, *pair) for n, _, *ring in faces for pair in zip(ring[::2], ring[1::2], strict=True)]
    outcomes = [
        ("the signed edges at each vertex are those of Table 2", at == signed),
        ("every face has three edges", all(count == 3 == len(ring) / 2 for _, count, *ring in faces)),
        ("the faces form a sphere", is_sphere(ring[::2] for _, _, *ring in faces)),
        ("each edge runs from its start around its left face, and back around its right face", {*passed} == {*listed}),
    ]
    return satisfied("Tables 1 to 3", outcomes)


@claim("kovalevsky-schulz.83", "kovalevsky-schulz.84")
def table_4() -> Check:
    """Check the printed sizes in Table 4 of Kovalevsky and Schulz against formulas (5) and (6) of their paper.

    Formula (5) gives the number of integers for a triangulation, and (6) for a cell list.  Closed surfaces with the
    printed numbers must also be possible.
    """
    printed = corrected_print("kovalevsky-schulz")
    triangles, corners, integers = numbers_in(printed["table4-triangulation"][0])
    outcomes = [("formula (5)", 2 * integers == 9 * triangles and abs(triangles - 2 * corners) <= 20)]
    faces, corners, integers = numbers_in(printed["table4-hull"][0])
    hull = integers == 3 * corners + 5 * faces and may_be_convex(corners, faces)
    return satisfied("Table 4", [*outcomes, ("formula (6), and numbers that a hull can have", hull)])


def counts_in_table_1(scene: str) -> list[int]:
    """Return the four printed counts for a scene of Table 1 of Nakamae and Nishita.

    They are the numbers of polyhedra, of vertices, of faces, and of points of figures on faces.
    """
    return numbers_in(corrected_print("nakamae-nishita")[f"table1-{scene}"][0].split(")")[1])


@claim("nakamae-nishita.53", scene="a")
@claim("nakamae-nishita.54", scene="b")
@claim("nakamae-nishita.55", scene="c")
def scene_of_solids(scene: str) -> Check:
    """Check that n convex solids can have the printed vertices V and faces F: V <= 2 F - 4 n and F <= 2 V - 4 n."""
    solids, corners, faces, _ = counts_in_table_1(scene)
    possible = corners <= 2 * faces - 4 * solids and faces <= 2 * corners - 4 * solids and corners >= 4 * solids
    return satisfied(f"Table 1 ({scene})", [("possible numbers of vertices and faces", possible)])


@claim("appel-will.20")
def figure_4() -> Check:
    """Check that each line of Appel and Will's Fig. 4 is on two surfaces, which form a surface like a sphere."""
    rows = [line.split()[1].split(",") for line in corrected_print("appel-will")["fig4-topological-map"]]
    return satisfied("Fig. 4", [("each line is on two surfaces, and V - E + F = 2", is_sphere(rows))])


def columns(rows: Sequence[str]) -> list[list[int]]:
    """Return the columns of a table whose cells are separated by tabs, without the column of row labels."""
    cells = [row.split("\t")[1:] for row in rows]
    return [[n for row in cells if k < len(row) for n in numbers_in(row[k])] for k in range(len(cells[0]))]


def is_closed_loop(loop: Sequence[int], lines: Mapping[int, tuple[int, int]]) -> bool:
    """Return True if each line of a loop begins at the end of the one before; a negative number reverses its line."""
    ways = [lines[abs(n)][:: 1 if n > 0 else -1] for n in loop]
    return all(here[0] == before[1] for before, here in zip([ways[-1], *ways], ways, strict=False))


@claim("appel-will.65", number=14)
@claim("appel-will.113", "appel-will.114", "appel-will.115", number=23)
def lines_and_loops(number: int) -> Check:
    """Check that the loops in Appel and Will's Figs. 14, 22 and 23 are closed and that each line is in two loops."""
    printed = corrected_print("appel-will")
    first, second = (printed[name] for name in ("fig22-loops-1-3", "fig22-loops-4-5"))
    fig22 = [numbers_in(cell) for row in (first[0], second[0]) for cell in row.split("\t")[1::2]]
    loops = fig22 if number == 14 else columns(printed["fig23-loops"])
    rows = map(numbers_in, printed["fig14" if number == 14 else "fig23-edges"])
    lines = {label: (start, end) for label, start, end in rows}
    uses = Counter(abs(n) for loop in loops for n in loop)
    outcomes = [
        ("lines in order", [*lines.values()] == sorted(lines.values())),
        ("V - E + F = 2", len({p for pair in lines.values() for p in pair}) - len(lines) + len(loops) == 2),
        ("every line is on two loops", uses == dict.fromkeys(lines, 2)),
        *((f"loop {k} is closed", is_closed_loop(loop, lines)) for k, loop in enumerate(loops, 1)),
    ]
    if number == 14:
        uses_after = [Counter(abs(n) for loop in fig22[:k] for n in loop) for k in (1, 2, 3)]
        for label, *counts in map(numbers_in, first[1:]):
            outcomes.append((f"IUC of line {label}", counts[::2] == [used[label] for used in uses_after]))
    else:
        corners = [[lines[abs(n)][n < 0] for n in loop] for loop in loops]
        outcomes.append(("the map follows from the loops", columns(printed["fig23-map"]) == corners))
        outcomes.append(("the surfaces form a sphere", is_sphere(corners)))
        # The OCR lost the first and the third entry of the third loop.
        lost, kept, lost_too, *rest = loops[2]
        pairs = product((*lines, *(-label for label in lines)), repeat=2)
        closing = [(a, b) for a, b in pairs if is_closed_loop([a, kept, b, *rest], lines)]
        outcomes.append(("only the restored entries close loop 3", closing == [(lost, lost_too)]))
    return satisfied(f"Fig. {number}", outcomes)


@claim("thesis.175", example=4)
@claim("thesis.176", example=5)
@claim("thesis.177", example=6)
def example_of_chapter_6(example: int) -> Check:
    """Check that the printed vertices and equations describe a closed surface, and that all points are classified."""
    hull = read_hull([result for result in prints(example) if result.device == "punch"][-1].lines)
    rings = [ring for ring, _ in hull.satisfied]
    at = Counter(v for ring in rings for v in ring)
    edges = Counter(frozenset(pair) for ring in rings for pair in combinations(ring, 2))
    faces, corners = len(rings), len(hull.vertices)
    # In a plane every vertex is on two lines. In space the faces are triangles, and every edge is on two of them.
    spatial = {*edges.values()} == {2} and corners - len(edges) + faces == 2 and may_be_convex(corners, faces)
    values = [plane_at(hull.equations[n - 1], hull.vertices[v - 1]) for ring, n in hull.satisfied for v in ring]
    points = exact_points(input_deck(example))[0]
    outcomes = [
        ("closed surface", {*at.values()} == {2} and faces == corners if hull.plane else spatial),
        ("the equations are 0 at their vertices", not any(values)),
        ("every input point is classified", len(hull.inside) + len(hull.boundary) + corners == len(points)),
    ]
    return satisfied(f"example {example}", outcomes)


@claim("thesis.150")
def table_of_theorem_4_8() -> Check:
    """Check that the printed points and planes of theorem 4.8 can be the vertices and faces of a convex polyhedron."""
    data = next(data for data in load_theorems() if data.id == "4.8")
    hull = [p for p in data.points if p.name != "Q9"]
    on = [sum(plane.at(p) == 0 for p in hull) for plane in data.planes]
    # A face has as many edges as vertices, and each edge is on two planes: the vertex counts of the planes add to 2 E.
    outcomes = [("V - E + F = 2", 2 * (len(hull) + len(on) - 2) == sum(on))]
    return satisfied("theorem 4.8", [*outcomes, ("V <= 2 F - 4", may_be_convex(len(hull), len(on)))])
