"""Claims of Nakamae and Nishita: edges seen and hidden, indices of intersections, what is nearer, gaps."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from itertools import combinations, permutations, product

from modern.claims.nakamae_nishita.tables import SQUARE, crosses, inside, lines_of, pairs, side, tables_of
from modern.claims.register import CONDITION, FAILS, HOLDS, Seen, counterexample, seen
from modern.claims.sampled_sets import sampled_sets
from modern.claims.thesis.chapter3_equations import points_of
from modern.drawing.visible import CONTOUR, INNER, line_through, sign, value
from modern.geometry.vectors import cross, dot, minus
from modern.papers.nakamae_nishita.contours import values
from modern.papers.nakamae_nishita.crossings import CLEAR, ENCLOSED, clipped
from modern.papers.nakamae_nishita.hidden import Drawing, draw
from modern.papers.nakamae_nishita.polyhedron import Polyhedron, checked
from modern.papers.nakamae_nishita.projection import parallel
from modern.papers.nakamae_nishita.scenes import parse
from modern.papers.nakamae_nishita.shapes import cuboid, moved, placed


@cache
def _cuboid(way: tuple[int, int, int] = (3, -5, 2)) -> Drawing:
    return draw(lambda: [cuboid("box", Fraction(2), Fraction(3), Fraction(4))], parallel(way))


def faces_and_edges(kind: str = "") -> Seen:
    """A cuboid: three front faces; three inner and six contour edges.

    Along an axis, with a ``kind``: four faces are neither front nor back, and by the letter there is no contour edge;
    with those as back faces there are four.
    """
    (solid,) = _cuboid().solids
    kinds = [edge.kind for edge in solid.edges]
    good = (sum(s > 0 for s in solid.signs), kinds.count(INNER), kinds.count(CONTOUR)) == (3, 3, 6)
    words = f"{kinds.count(INNER)} inner and {kinds.count(CONTOUR)} contour edges of a cuboid"
    if not kind:
        return seen(good, words)
    (along,) = _cuboid((0, 0, 1)).solids
    pairs_ = combinations(zip(along.polyhedron.faces, along.signs, strict=True), 2)
    letter = sum(one * other == -1 and len({*a} & {*b}) == 2 for (a, one), (b, other) in pairs_)
    contour = sum(edge.kind == CONTOUR for edge in along.edges)
    good &= along.signs.count(0) == 4 == contour and not letter
    return Seen(CONDITION if good else FAILS, f"{words}; along an axis {contour} and, by the letter, {letter}")


def contour_edges_hidden_too() -> Seen:
    """Two boxes: pieces of contour edges of the farther are hidden."""
    drawing = _scene("enclosed.toml")
    hidden = {kind for kind in (INNER, CONTOUR) if _hidden(drawing, kind)}
    return Seen(CONDITION if CONTOUR in hidden else FAILS, "contour edges of the box are hidden as well as inner ones")


@cache
def _scene(name: str, *without: str) -> Drawing:
    found = parse(counterexample(name), name)
    return draw(found.make, found.sight.observer(found.make), without, hidden=True)


def _hidden(drawing: Drawing, kind: str) -> int:
    ends = {
        (number, frozenset((edge.start, edge.end)))
        for number, solid in enumerate(drawing.solids)
        for edge in solid.edges
        if edge.kind == kind
    }
    return sum(not p.seen and (p.solid, frozenset((p.start, p.end))) in ends for p in drawing.pieces)


def three_in_line() -> Seen:
    """(1) of three corners in a line."""
    return Seen(
        CONDITION if value(line_through((0, 0, 1), (1, 1, 1)), (2, 2, 1)) == 0 else FAILS, "0 of three in a line"
    )


def indices(kind: str = "") -> Seen:
    """Segments between grid points against a square: the program's indices and those of (6), k being their number.

    In general position, each contour segment that is met by its determinant.  ``k``: whether an index is -1 only where
    there is one intersection.
    """
    good, alone = [], set()
    ways = set()
    for a, b in permutations([(x, y) for x in (-3, 1, 2, 8) for y in (-2, 1, 3, 6)], 2):
        of_square = values(lines_of(SQUARE), [(*a, 0, 1), (*b, 0, 1)])
        if of_square is None or any(0 in column for column in of_square) or 0 in {side(a, b, p) for p in SQUARE}:
            continue
        met = []
        for k, column in enumerate(of_square):
            (xi, yi), (xj, yj) = SQUARE[k], SQUARE[(k + 1) % 4]
            if crosses(SQUARE, k, (a, b), 0):
                determinant = (xj - xi) * (a[1] - b[1]) - (yj - yi) * (a[0] - b[0])
                met.append((Fraction(column[0], column[0] - column[1]), sign(determinant)))
        by_six = tuple((place, len(met) * index) for place, index in sorted(met))
        found = clipped(of_square, 0, 1)
        good.append(found.marks == by_six)
        alone |= {len(met) for _, index in by_six if index == -1}
        ways.add(tuple(index for _, index in found.marks))
    wanted = {(), (1,), (-1,), (2, -2)}
    words = f"{len(good)} segments: 1 going in, -1 coming out, 2 and -2 where both"
    return seen(all(good) and ways == wanted and (not kind or alone == {1}), words)


def touching_is_undecided(kind: str = "") -> Seen:
    """Two boxes that touch: by which rule it was found out which is nearer, and what is hidden without that rule."""
    (relation,) = _scene("stacked.toml").relations
    without = _scene("stacked.toml", "touching")
    less = _hidden(without, INNER) + _hidden(without, CONTOUR) < _hidden(_scene("stacked.toml"), INNER) + _hidden(
        _scene("stacked.toml"), CONTOUR
    )
    good = relation.by == "plane" and less
    words = "decided by a separating plane; without it nothing is hidden"
    return seen(not good, words) if kind else Seen(CONDITION if good else FAILS, words)


def three_conditions() -> Seen:
    """Segments between grid points against a square: those with intersections go in, come out, or both.

    Some more meet a corner from outside, and are none of these.
    """
    found, touching = set(), 0
    grid = [(x, y) for x in (-3, 1, 2, 7) for y in (-3, 1, 3, 6)]
    for a, b in combinations(grid, 2):
        of_square = values(lines_of(SQUARE), [(*a, 0, 1), (*b, 0, 1)])
        if of_square is not None:
            passage = clipped(of_square, 0, 1)
            met = any(side(a, b, p) == 0 and min(a[0], b[0]) < p[0] < max(a[0], b[0]) for p in SQUARE)
            touching += met and passage == CLEAR
            if passage.marks:
                found.add(tuple(index for _, index in passage.marks))
    good = found == {(1,), (-1,), (2, -2)} and touching > 0
    return Seen(CONDITION if good else FAILS, f"in; out; in and out; {touching} touch a corner only")


def sense() -> Seen:
    """The printed product and (6) for a segment that goes in."""
    p, q, a, b = (point[:2] for point in points_of("sense.csv"))
    printed = (p[0] - q[0]) * (a[1] - b[1]) - (p[1] - q[1]) * (a[0] - b[0])
    six = (q[0] - p[0]) * (a[1] - b[1]) - (q[1] - p[1]) * (a[0] - b[0])
    goes_in = value(line_through((*p, 1), (*q, 1)), (*a, 1)) < 0 < value(line_through((*p, 1), (*q, 1)), (*b, 1))
    return Seen(
        FAILS if goes_in and printed < 0 < six else HOLDS, f"as printed {printed}, by (6) {six}, for a segment going in"
    )


def wholly_behind() -> Seen:
    """A box behind a wall: passages without an intersection."""
    corrected, without = _scene("enclosed.toml"), _scene("enclosed.toml", "enclosed")
    alone = any(passage == ENCLOSED for found in corrected.passages for _, passage in found.behind)
    seen_now = sum(p.seen for p in without.pieces) - sum(p.seen for p in corrected.pieces)
    return Seen(
        FAILS if alone and seen_now > 0 else HOLDS, f"{seen_now} edges of the box would be seen through the wall"
    )


def overlap_by_neighbours() -> Seen:
    """Sides of rectangles in one line: by the zeros of PL alone, and with the columns beside, against their ends."""
    zeros, beside = [], []
    for x, y, width in product(range(-5, 8), (-4, 0, 4), (2, 3)):
        other = ((x, y), (x, y + 4), (x + width, y + 4), (x + width, y))
        pl, _ = tables_of(SQUARE, other)
        for i, j in product(range(4), repeat=2):
            one, next_one = pl[j], pl[(j + 1) % 4]
            if one[i] == next_one[i] == 0:
                axis = 0 if SQUARE[i][1] == SQUARE[(i + 1) % 4][1] else 1
                mine = sorted((SQUARE[i][axis], SQUARE[(i + 1) % 4][axis]))
                its = sorted((other[j][axis], other[(j + 1) % 4][axis]))
                overlap = max(mine[0], its[0]) < min(mine[1], its[1])
                zeros.append(overlap)
                apart = any(one[k] <= 0 >= next_one[k] for k in ((i - 1) % 4, (i + 1) % 4))
                beside.append(overlap != apart)
    words = (
        f"{len(zeros)} pairs in one line, of which {zeros.count(False)} do not overlap; the columns beside tell which"
    )
    return Seen(CONDITION if all(beside) and False in zeros else FAILS, words)


def segments_within() -> Seen:
    """Sides of V that cross an inner edge of V', here a diagonal: each has a part within V', some not all of them."""
    good, partly = [], 0
    for v, w in pairs():
        for i, (p, q) in product(range(len(v)), combinations(range(len(w)), 2)):
            if crosses(v, i, (w[p], w[q]), 0):
                a, b = v[i], v[(i + 1) % len(v)]
                found = values(lines_of(w), [(*a, 0, 1), (*b, 0, 1)])
                good.append(found is not None and clipped(found, 0, 1) != CLEAR)
                partly += not (inside(a, w) and inside(b, w))
    words = f"{len(good)} crossings of inner edges, {partly} by segments that are within in part only"
    return Seen(CONDITION if all(good) and partly else FAILS, words)


def table_by_4() -> Seen:
    """The counterexample's eye, contour and edge: the table by the signs of (4), as printed, and by those of (1)."""
    (eye, *contour), ends = (found := points_of("table_by_4.csv"))[:-2], found[-2:]
    by_4 = {sign(dot(minus(p, eye), minus(p, end))) for p in contour for end in ends}
    flat = tuple((x, y) for x, y, _ in contour)
    by_1 = [[sign(value(line, (x, y, 1))) for line in lines_of(flat)] for x, y, _ in ends]
    goes_in = -1 in by_1[0] and -1 not in by_1[1]
    wrong = by_4 == {-1} and goes_in
    return Seen(FAILS if wrong else HOLDS, "by (4) every element is -1, as if nothing met; by (1) the edge goes in")


def nearer_within() -> Seen:
    """A box before a frustum, its contour within the other's: sides of the top are hidden without an intersection.

    Of the frustum's contour nothing is hidden.
    """
    corners = [(x, y, z) for z, low, high in ((0, 0, 8), (2, 3, 5)) for x, y in _ring(low, high)]
    walls = [(k, k + 4, (k + 1) % 4 + 4, (k + 1) % 4) for k in range(4)]
    frustum = Polyhedron(
        "frustum",
        tuple((Fraction(x), Fraction(y), Fraction(z)) for x, y, z in corners),
        ((0, 1, 2, 3), (7, 6, 5, 4), *walls),
    )
    box = placed(cuboid("box", *map(Fraction, (4, 4, 1))), moved((Fraction(2), Fraction(2), Fraction(4))), "box")
    drawing = draw([checked(frustum), box], parallel((0, 0, 1)), hidden=True)
    passages = [passage for found in drawing.passages if found.solid == 0 for _, passage in found.behind]
    whole, met = passages.count(ENCLOSED), sum(bool(passage.marks) for passage in passages)
    good = whole > 0 < met and _hidden(drawing, INNER) > 0 == _hidden(drawing, CONTOUR)
    words = f"{met} inner edges of the frustum meet the contour of the box, {whole} are hidden and do not"
    return Seen(CONDITION if good else FAILS, words)


def _ring(low: int, high: int) -> tuple[tuple[int, int], ...]:
    return (low, low), (high, low), (high, high), (low, high)


COUNTS = {"a": (11, 116, 80), "c": (60, 480, 360), "d": (30, 216, 158)}
"""Table 1: polyhedra, vertices and faces."""


def counts_of_d() -> Seen:
    """Table 1 (d): a solid of F faces has 2 F - 4 vertices at most, a plate none of that; the counts need plates.

    In (a) and (c) as many vertices as can be.
    """
    most = {name: 2 * faces - 4 * parts for name, (parts, _, faces) in COUNTS.items()}
    bases = [4] * 23 + [3] * 2
    plates = (len(bases) + 5, 2 * sum(bases) + 5 * 4, sum(bases) + 2 * len(bases) + 5 * 2)
    good = all(most[name] == COUNTS[name][1] for name in "ac")
    good &= most["d"] < COUNTS["d"][1] and plates == COUNTS["d"]
    words = (
        f"30 solids with 158 faces have {most['d']} vertices at most; 25 prisms and five plates have the printed counts"
    )
    return Seen(CONDITION if good else FAILS, words)


def faces_are_convex() -> Seen:
    """Faces of the judge's hulls: the first three corners turn as any three in a row do, about the outward normal."""
    good = []
    for one in sampled_sets(3, 2):
        for facet in one.judge.facets:
            ring = [one.points[k] for k in facet.polygon]
            turns = [cross(minus(ring[k - 1], ring[k - 2]), minus(ring[k], ring[k - 1])) for k in range(len(ring))]
            good.append(all(dot(turn, facet.plane[:3]) > 0 for turn in turns))
    return seen(all(good), f"{len(good)} faces")
