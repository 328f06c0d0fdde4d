"""Checks of Nakamae and Nishita on two contours: correlations, formulas (1) to (3) and (5), the tables PL and LP."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import combinations, permutations, product
from random import Random

from modern.claims.evidence import Check, claim, exhibited, holds_if
from modern.claims.sampled_sets import Point, sampled_sets
from modern.drawing.visible import line_through, sign, value
from modern.exact_hull import ExactHull, exact_hull
from modern.geometry.vectors import cross, dot, minus
from modern.papers.nakamae_nishita.contours import Tables
from modern.papers.nakamae_nishita.results import contour_tables
from modern.papers.nakamae_nishita.solids import height, plane_through

Place = tuple[int, int]

SQUARE: tuple[Place, ...] = ((0, 0), (0, 4), (4, 4), (4, 0))

WITHIN: tuple[Place, ...] = ((1, 1), (1, 3), (3, 3), (3, 1))

ACROSS: tuple[Place, ...] = ((2, 2), (2, 6), (6, 6), (6, 2))

BESIDE: tuple[Place, ...] = ((6, 0), (6, 4), (9, 4), (9, 0))
AGAINST: tuple[Place, ...] = ((0, 2), (1, 3), (2, 2), (1, 1))


def flat(places: tuple[Place, ...]) -> list[tuple[int, int, int]]:
    return [(x, y, 1) for x, y in places]


def lines_of(places: tuple[Place, ...]) -> list[tuple[int, int, int]]:
    corners = flat(places)
    return [line_through(a, b) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]


def tables_of(v: tuple[Place, ...], w: tuple[Place, ...]) -> tuple[list[list[int]], list[list[int]]]:
    """Return PL and LP by formula (2) with rows for V' and columns for V, for contours that may or may not overlap."""
    pl = [[sign(value(line, p)) for line in lines_of(v)] for p in flat(w)]
    lp = [[sign(value(line, p)) for p in flat(v)] for line in lines_of(w)]
    return pl, lp


def _polygons() -> Iterator[tuple[Place, ...]]:
    """Yield convex polygons, clockwise: the squares above and a few random ones."""
    yield from (SQUARE, WITHIN, ACROSS, BESIDE, AGAINST)
    random = Random(32)
    for _ in range(4):
        points = [(random.randint(-2, 6), random.randint(-2, 6), 0) for _ in range(6)]
        ring = exact_hull(points).polygon
        if ring:
            yield tuple(points[k][:2] for k in ring[::-1])


def pairs() -> Iterator[tuple[tuple[Place, ...], tuple[Place, ...]]]:
    for v, w in combinations([*_polygons()], 2):
        yield v, w
        yield w, v


def inside(p: Place, v: tuple[Place, ...]) -> bool:
    return all(value(line, (*p, 1)) >= 0 for line in lines_of(v))


def _apart(v: tuple[Place, ...], w: tuple[Place, ...]) -> bool:
    return any(all(value(line, p) <= 0 for p in flat(b)) for a, b in ((v, w), (w, v)) for line in lines_of(a))


# A pyramid over an upright pentagon that is seen edge-on along z.
ROOF: tuple[Point, ...] = ((0, 0, 0), (4, 0, 0), (4, 0, 2), (2, 0, 3), (0, 0, 2), (2, 5, 1))


@claim("nakamae-nishita.5", "nakamae-nishita.12")
def convex_contour() -> Check:
    """Check that the edges of exactly one front face form one ring that turns clockwise.

    The hulls are seen from oblique directions, and one along a face. The corners of the ring are those of the hull of
    all images; the ring may have straight corners if a face is seen edge-on.
    """
    checks, straight = [], 0
    for points, judge, (u, v) in (
        *((sampled.points, sampled.judge, (31, 17)) for sampled in sampled_sets(3, 3)),
        _roof(),
    ):
        images = [(x + u * z, y + v * z) for x, y, z in points]
        values = [dot(face.plane[:3], (-u, -v, 1)) for face in judge.facets]
        # A directed edge of a front face is on the contour if its reverse belongs to no front face.
        front = [face.polygon for face, face_value in zip(judge.facets, values, strict=True) if face_value > 0]
        sides = {(a, b) for ring in front for a, b in zip(ring, (*ring[1:], ring[0]), strict=True)}
        after = {b: a for a, b in sides if (b, a) not in sides}
        ring = [min(after)]
        while len(ring) < len(after) and after[ring[-1]] != ring[0]:
            ring.append(after[ring[-1]])
        contour = [images[k] for k in ring]
        turns = [side(contour[k - 2], contour[k - 1], contour[k]) for k in range(len(contour))]
        around = sorted({*images})
        corners = {around[k] for k in exact_hull([(x, y, 0) for x, y in around]).polygon}
        checks.append(len(ring) == len(after) and {*turns} <= {-1, 0} and (0 in values or 0 not in turns))
        checks.append({contour[k - 1] for k, turn in enumerate(turns) if turn} == corners)
        straight += turns.count(0)
    message = f"the contours of {len(checks) // 2} hulls turn only clockwise"
    return holds_if(all(checks) and straight > 0, f"{message}; one is straight at a corner of a face seen edge-on")


def _roof() -> tuple[tuple[Point, ...], ExactHull, tuple[int, int]]:
    return ROOF, exact_hull(ROOF), (0, 0)


@claim("nakamae-nishita.13")
@claim("nakamae-nishita.14", kind="figure")
def correlations(kind: str = "") -> Check:
    """Classify pairs of polygons independently: exactly one relation applies unless they touch, and then sometimes
    none.
    """
    counts: dict[str, int] = dict.fromkeys(("apart", "encloses", "partly", "touching"), 0)
    checks, some_unrelated = [], False
    for v, w in pairs():
        both = (v, w), (w, v)
        relations = {
            "apart": any(all(value(line, p) < 0 for p in flat(b)) for a, b in both for line in lines_of(a)),
            "encloses": any(all(value(line, p) > 0 for line in lines_of(a) for p in flat(b)) for a, b in both),
            "partly": any(crosses(v, i, w, j) for i in range(len(v)) for j in range(len(w))),
        }
        meet = any(d in (-1, -2) for d, _ in numbers_of_meetings(v, w)) or {*v} & {*w}
        if meet:
            some_unrelated |= not any(relations.values())
            counts["touching"] += 1
        else:
            checks.append(sum(relations.values()) == 1)
            counts = {name: n + relations.get(name, False) for name, n in counts.items()}
    passed = all(checks) and some_unrelated and all(counts.values())
    message = "pairs: " + ", ".join(f"{name} {number}" for name, number in counts.items())
    return holds_if(passed, message, conditional=not kind)


@claim("nakamae-nishita.21", number="1")
@claim("nakamae-nishita.22", number="2")
@claim("nakamae-nishita.29", number="3", kind="in_line")
@claim("nakamae-nishita.30", "nakamae-nishita.31", "nakamae-nishita.32", number="3")
@claim("nakamae-nishita.60", "nakamae-nishita.37", number="5")
def formula(number: str, kind: str = "") -> Check:
    """Compare a formula with an independent computation; (1) for points at known distances to the right of a line.

    (3) ``in_line``: with sides that overlap on one line, about which d says nothing.
    """
    checks: list[bool] = []
    if number == "1":
        for (x1, y1), (x2, y2) in permutations(((0, 0), (0, 4), (3, -2), (5, 1)), 2):
            line, (x, y) = line_through((x1, y1, 1), (x2, y2, 1)), (x2 - x1, y2 - y1)
            for along, right in product((-1, 0, 2), (-3, 0, 1)):
                p = (x1 + along * x + right * y, y1 + along * y - right * x, 1)
                checks.append(value(line, p) == right * (x * x + y * y))
    elif number == "2":
        pl, lp = tables_of(SQUARE, ACROSS)
        program_tables = contour_tables(SQUARE, ACROSS)
        checks = [program_tables.pl == tuple(map(tuple, pl)), program_tables.lp == tuple(map(tuple, lp))]
    elif number == "3":
        meetings = [pair for v, w in pairs() for pair in numbers_of_meetings(v, w)]
        checks = [d == expected for d, expected in meetings] + [{-4, -2, -1, 0} == {d for d, _ in meetings}]
    elif number == "5":
        return _formula_5()
    if kind:
        overlap = overlap_in_line()
        passed = all(checks) and overlap.holds
        return holds_if(passed, f"{len(checks)} cases agree; {overlap.message}", conditional=True)
    return holds_if(bool(checks) and all(checks), f"{len(checks)} cases agree")


def _formula_5() -> Check:
    """Compare the determinant of (5) and the program with the side of the eye, for a face z = 0 seen from above."""
    corners = [(0, 0, 0), (0, 4, 0), (4, 4, 0)]
    plane, signs = plane_through(*((*corner, 1) for corner in corners)), {}
    for z in (-2, 0, 3):
        rows = [(1, 2, z), *corners]
        (a, b, c) = (minus(row, rows[0]) for row in rows[1:])
        signs[z] = (sign(dot(a, cross(b, c))), sign(height(plane, (1, 2, z, 1))))
    passed = all(by_determinant == by_program == sign(z) for z, (by_determinant, by_program) in signs.items())
    return holds_if(passed, "the value is positive above the face, negative below it, and 0 in it", conditional=True)


def numbers_of_meetings(v: tuple[Place, ...], w: tuple[Place, ...]) -> Iterator[tuple[int, int]]:
    """Yield d for each pair of segments, and the value expected from how the segments meet."""
    pl, lp = tables_of(v, w)
    tables = Tables(tuple(map(tuple, pl)), tuple(map(tuple, lp)))
    for i, j in product(range(len(v)), range(len(w))):
        a, b, c, d = v[i], v[(i + 1) % len(v)], w[j], w[(j + 1) % len(w)]
        # Section 3.2: -4 for a crossing, -2 for a vertex on a segment, -1 for a common vertex, else 0.
        touching = [p for p in {a, b} if _between(c, d, p)] + [p for p in {c, d} if _between(a, b, p)]
        in_line = side(a, b, c) == side(a, b, d) == 0
        same = {a, b} & {c, d}
        expected = 0 if in_line else -1 if same else -2 if touching else -4 if crosses(v, i, w, j) else 0
        yield tables.crossing_number(i, j), expected


def _between(p: Place, q: Place, r: Place) -> bool:
    along = (r[0] - p[0]) * (r[0] - q[0]) + (r[1] - p[1]) * (r[1] - q[1])
    return side(p, q, r) == 0 and along <= 0


def side(p: Place, q: Place, r: Place) -> int:
    return sign((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]))


def crosses(v: tuple[Place, ...], i: int, w: tuple[Place, ...], j: int) -> bool:
    a, b, c, d = v[i], v[(i + 1) % len(v)], w[j], w[(j + 1) % len(w)]
    return side(a, b, c) * side(a, b, d) == -1 == side(c, d, a) * side(c, d, b)


@claim("nakamae-nishita.23", number="1")
@claim("nakamae-nishita.24", number="2")
@claim("nakamae-nishita.25", number="3")
@claim("nakamae-nishita.26", number="4")
@claim("nakamae-nishita.27", number="LP")
def table_properties(number: str) -> Check:
    """Check a property of the tables on pairs of convex polygons; ``LP`` checks all four, with rows for columns."""
    checks, touching = [], False
    for v, w in pairs():
        pl, lp = tables_of(v, w)
        tables = Tables(tuple(map(tuple, pl)), tuple(map(tuple, lp)))
        if number != "LP":
            met = [[tables.crossing_number(i, j) for j in range(len(w))] for i in range(len(v))]
            property_checks, touches = _property(number, v, w, [*zip(*pl, strict=True)], met)
            checks += property_checks
            touching |= touches
            continue
        met = [[tables.crossing_number(i, j) for i in range(len(v))] for j in range(len(w))]
        for property_number in "1234":
            property_checks, touches = _property(property_number, w, v, [(*row,) for row in lp], met)
            checks += property_checks
            touching |= touches
    if not all(checks) or not checks:
        return exhibited(False, f"true for {sum(checks)} of {len(checks)} pairs of polygons and lines")
    return holds_if(True, f"true for {len(checks)} pairs of polygons and lines", conditional=touching)


def _property(
    number: str, v: tuple[Place, ...], w: tuple[Place, ...], of_lines: list[tuple[int, ...]], met: list[list[int]]
) -> tuple[list[bool], bool]:
    """Return the results for one pair of polygons, and True if lines without an intersection touch the other polygon.

    ``of_lines`` has the signs of the vertices of w for each line of v, and ``met`` the values of d for the lines of w.
    """
    if number == "1":
        return [_apart(v, w) or all(1 in line for line in of_lines)], False
    if number == "2":
        return [(not any(-1 in line for line in of_lines)) == all(inside(p, v) for p in w)], False
    if number == "4":
        return [(-1 not in at) == inside(p, v) for at, p in zip(zip(*of_lines, strict=True), w, strict=True)], False
    clear = [i for i, line in enumerate(of_lines) if -1 not in line]
    crossed = [any(crosses(v, i, w, j) for j in range(len(w))) for i in clear]
    return [not has_crossing for has_crossing in crossed], any(any(met[i]) for i in clear)


@claim("nakamae-nishita.33")
def overlap_in_line() -> Check:
    """Check d for two squares whose upper sides overlap on one line."""
    pl, lp = tables_of(SQUARE, ((2, 2), (2, 4), (6, 4), (6, 2)))
    d = Tables(tuple(map(tuple, pl)), tuple(map(tuple, lp))).crossing_number(1, 1)
    return holds_if(d == 0, f"d is {d} for two sides that overlap", conditional=True)


@claim("nakamae-nishita.41")
def intersection_counts() -> Check:
    """Check that segments meet contours in at most two points, and that d of (3) is not 0 twice at a corner."""
    counts, along, over_two = set(), 0, 0
    for v in _polygons():
        for a, b in combinations([(x, y) for x in (-3, 0, 2, 4) for y in (-2, 0, 3, 4)], 2):
            places, by_3 = set(), 0
            for i, line in enumerate(lines_of(v)):
                p, q = v[i], v[(i + 1) % len(v)]
                at_a, at_b = value(line, (*a, 1)), value(line, (*b, 1))
                if at_a == at_b == 0:
                    axis = int(p[0] == q[0])
                    mine, its = sorted((a[axis], b[axis])), sorted((p[axis], q[axis]))
                    if max(mine[0], its[0]) < min(mine[1], its[1]):
                        along += 1
                        break
                elif sign(at_a) * sign(at_b) <= 0 and side(a, b, p) * side(a, b, q) <= 0 and at_a != at_b:
                    places.add(Fraction(at_a, at_a - at_b))
                    by_3 += (sign(at_b) - sign(at_a)) * (side(a, b, q) - side(a, b, p)) != 0
            else:
                counts.add(len(places))
                over_two += by_3 > 2
    message = (
        f"segments meet a contour in {', '.join(map(str, sorted(counts)))} points; {along} run along a side, "
        f"and {over_two} meet more than two"
    )
    return holds_if(counts == {0, 1, 2} and along and over_two, f"{message} sides", conditional=True)
