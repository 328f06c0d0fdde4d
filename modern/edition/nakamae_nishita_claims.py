"""Claims of Nakamae and Nishita: contours, the tables PL and LP with their properties, formulas (1) to (6), gaps."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import cache
from itertools import combinations, permutations, product
from random import Random

from modern.drawing.visible import CONTOUR, INNER, line_through, sign, value
from modern.edition.chapter3_claims import points_of
from modern.edition.sampled_sets import sampled_sets
from modern.edition.statements import CONDITION, FAILS, HOLDS, Seen, counterexample, seen
from modern.exact_hull import exact_hull
from modern.geometry.vectors import cross, dot, minus
from modern.papers.nakamae_nishita.contours import Tables, values
from modern.papers.nakamae_nishita.crossings import CLEAR, ENCLOSED, clipped
from modern.papers.nakamae_nishita.hidden import Drawing, draw
from modern.papers.nakamae_nishita.polyhedron import Polyhedron
from modern.papers.nakamae_nishita.projection import parallel
from modern.papers.nakamae_nishita.results import contour_tables
from modern.papers.nakamae_nishita.scenes import parse
from modern.papers.nakamae_nishita.shapes import cuboid, moved, placed
from modern.papers.nakamae_nishita.solids import height, plane_through

Place = tuple[int, int]
SQUARE: tuple[Place, ...] = ((0, 0), (0, 4), (4, 4), (4, 0))
WITHIN: tuple[Place, ...] = ((1, 1), (1, 3), (3, 3), (3, 1))
ACROSS: tuple[Place, ...] = ((2, 2), (2, 6), (6, 6), (6, 2))
BESIDE: tuple[Place, ...] = ((6, 0), (6, 4), (9, 4), (9, 0))


@cache
def _cuboid() -> Drawing:
    return draw(lambda: [cuboid("box", Fraction(2), Fraction(3), Fraction(4))], parallel((3, -5, 2)))


def _flat(places: tuple[Place, ...]) -> list[tuple[int, int, int]]:
    return [(x, y, 1) for x, y in places]


def _lines(places: tuple[Place, ...]) -> list[tuple[int, int, int]]:
    flat = _flat(places)
    return [line_through(a, b) for a, b in zip(flat, [*flat[1:], flat[0]], strict=True)]


def _tables(v: tuple[Place, ...], w: tuple[Place, ...]) -> tuple[list[list[int]], list[list[int]]]:
    """PL and LP by (2), rows for V' and columns for V, whether the contours overlap or not."""
    pl = [[sign(value(line, p)) for line in _lines(v)] for p in _flat(w)]
    lp = [[sign(value(line, p)) for p in _flat(v)] for line in _lines(w)]
    return pl, lp


def _polygons() -> Iterator[tuple[Place, ...]]:
    """Convex polygons, clockwise: the squares above and some at random."""
    yield from (SQUARE, WITHIN, ACROSS, BESIDE)
    random = Random(32)
    for _ in range(4):
        points = [(random.randint(-2, 6), random.randint(-2, 6), 0) for _ in range(6)]
        ring = exact_hull(points).polygon
        if ring:
            yield tuple(points[k][:2] for k in ring[::-1])


def _pairs() -> Iterator[tuple[tuple[Place, ...], tuple[Place, ...]]]:
    for v, w in combinations([*_polygons()], 2):
        yield v, w
        yield w, v


def _inside(p: Place, v: tuple[Place, ...]) -> bool:
    return all(value(line, (*p, 1)) >= 0 for line in _lines(v))


def _apart(v: tuple[Place, ...], w: tuple[Place, ...]) -> bool:
    """Whether a side of one has the other beyond it, or on it."""
    return any(all(value(line, p) <= 0 for p in _flat(b)) for a, b in ((v, w), (w, v)) for line in _lines(a))


def contour_is_convex() -> Seen:
    """The image of a hull is the hull of its points' images: all turns of its contour are clockwise."""
    good = []
    for one in sampled_sets(3, 2):
        images = [(x, y, 0) for x, y, _ in one.points]
        ring = exact_hull(images).polygon[::-1]
        lines = [
            line_through((*images[a][:2], 1), (*images[b][:2], 1))
            for a, b in zip(ring, (*ring[1:], ring[0]), strict=True)
        ]
        good.append(all(value(line, (x, y, 1)) >= 0 for line in lines for x, y, _ in images))
    return seen(all(good), f"{len(good)} hulls: all images on the right of the contour")


def faces_and_edges() -> Seen:
    """A cuboid: three front faces; three inner and six contour edges."""
    (solid,) = _cuboid().solids
    kinds = [edge.kind for edge in solid.edges]
    good = (sum(s > 0 for s in solid.signs), kinds.count(INNER), kinds.count(CONTOUR)) == (3, 3, 6)
    return seen(good, f"{kinds.count(INNER)} inner and {kinds.count(CONTOUR)} contour edges of a cuboid")


def correlations(kind: str = "") -> Seen:
    """Each pair of polygons is apart, encloses, is enclosed, or overlaps in part."""
    found = set()
    for v, w in _pairs():
        around, within = all(_inside(p, v) for p in w), all(_inside(p, w) for p in v)
        found.add("apart" if _apart(v, w) else "encloses" if around or within else "partly")
    return Seen((HOLDS if kind else CONDITION) if len(found) == 3 else FAILS, ", ".join(sorted(found)))


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


def formula(number: str) -> Seen:
    """A formula on small cases, by another way."""
    good: list[bool] = []
    if number == "1":
        for p in _flat(ACROSS + WITHIN):
            (x1, y1, _), (x2, y2, _) = (0, 0, 1), (0, 4, 1)
            right = (p[0] - x1) * (y2 - y1) - (p[1] - y1) * (x2 - x1)
            good.append(sign(value(line_through((0, 0, 1), (0, 4, 1)), p)) == sign(right))
    elif number == "2":
        pl, lp = _tables(SQUARE, ACROSS)
        found = contour_tables(SQUARE, ACROSS)
        good = [found.pl == tuple(map(tuple, pl)), found.lp == tuple(map(tuple, lp))]
    elif number == "3":
        meetings = [pair for v, w in _pairs() for pair in _numbers_of_meetings(v, w)]
        good = [d == wanted for d, wanted in meetings] + [{-4, -2, -1, 0} == {d for d, _ in meetings}]
    elif number == "5":
        return _formula_5()
    return seen(bool(good) and all(good), f"{len(good)} cases")


def _formula_5() -> Seen:
    """By the determinant and by the program, against the side on which the eye is: a face z = 0 seen from above.

    In the face the value is 0.
    """
    corners = [(0, 0, 0), (0, 4, 0), (4, 4, 0)]
    plane, found = plane_through(*((*corner, 1) for corner in corners)), {}
    for z in (-2, 0, 3):
        rows = [(1, 2, z), *corners]
        (a, b, c) = (minus(row, rows[0]) for row in rows[1:])
        found[z] = (sign(dot(a, cross(b, c))), sign(height(plane, (1, 2, z, 1))))
    fine = all(one == other == sign(z) for z, (one, other) in found.items())
    return Seen(CONDITION if fine else FAILS, "positive above the face, negative below it, 0 in it")


def _numbers_of_meetings(v: tuple[Place, ...], w: tuple[Place, ...]) -> Iterator[tuple[int, int]]:
    """d of each pair of segments, and what it is to be: whether they cross, touch in one end or in two, or neither."""
    pl, lp = _tables(v, w)
    tables = Tables(tuple(map(tuple, pl)), tuple(map(tuple, lp)))
    for i, j in product(range(len(v)), range(len(w))):
        a, b, c, d = v[i], v[(i + 1) % len(v)], w[j], w[(j + 1) % len(w)]
        touching = [p for p in {a, b} if _between(c, d, p)] + [p for p in {c, d} if _between(a, b, p)]
        in_line = _side(a, b, c) == _side(a, b, d) == 0
        same = {a, b} & {c, d}
        wanted = 0 if in_line else -1 if same else -2 if touching else -4 if _cross(v, i, w, j) else 0
        yield tables.crossing_number(i, j), wanted


def _between(p: Place, q: Place, r: Place) -> bool:
    """Whether r lies on the segment from p to q."""
    along = (r[0] - p[0]) * (r[0] - q[0]) + (r[1] - p[1]) * (r[1] - q[1])
    return _side(p, q, r) == 0 and along <= 0


def _side(p: Place, q: Place, r: Place) -> int:
    return sign((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]))


def indices(kind: str = "") -> Seen:
    """Segments between grid points against a square: the program's indices and those of (6), k being their number.

    In general position, each contour segment that is met by its determinant.  ``k``: whether an index is -1 only where
    there is one intersection.
    """
    good, alone = [], set()
    ways = set()
    for a, b in permutations([(x, y) for x in (-3, 1, 2, 8) for y in (-2, 1, 3, 6)], 2):
        of_square = values(_lines(SQUARE), [(*a, 0, 1), (*b, 0, 1)])
        if of_square is None or any(0 in column for column in of_square) or 0 in {_side(a, b, p) for p in SQUARE}:
            continue
        met = []
        for k, column in enumerate(of_square):
            (xi, yi), (xj, yj) = SQUARE[k], SQUARE[(k + 1) % 4]
            if _cross(SQUARE, k, (a, b), 0):
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


def _cross(v: tuple[Place, ...], i: int, w: tuple[Place, ...], j: int) -> bool:
    a, b, c, d = v[i], v[(i + 1) % len(v)], w[j], w[(j + 1) % len(w)]
    return _side(a, b, c) * _side(a, b, d) == -1 == _side(c, d, a) * _side(c, d, b)


def table_properties(number: str) -> Seen:
    """A property of the tables on pairs of convex polygons."""
    good, needed = [], False
    for v, w in _pairs():
        pl, lp = _tables(v, w)
        columns = [*zip(*pl, strict=True)]
        if number == "1":
            one, other = any(1 not in column for column in columns), any(1 not in row for row in lp)
            good.append((one or other) == _apart(v, w))
            needed |= one != other
        elif number == "2":
            good.append((not any(-1 in row for row in pl)) == all(_inside(p, v) for p in w))
        elif number == "3":
            good += [not any(_cross(v, i, w, j) for j in range(len(w))) for i, c in enumerate(columns) if -1 not in c]
        elif number == "4":
            good += [(-1 not in row) == _inside(p, v) for row, p in zip(pl, w, strict=True)]
        else:
            good += [(-1 not in column) == _inside(p, w) for column, p in zip(zip(*lp, strict=True), v, strict=True)]
            good.append((not any(-1 in row for row in lp)) == all(_inside(p, w) for p in v))
    if not all(good) or not good:
        return Seen(FAILS, f"{sum(good)} of {len(good)} cases")
    return Seen(CONDITION if needed else HOLDS, f"{len(good)} cases")


def overlap_in_a_line() -> Seen:
    """Two squares whose upper sides overlap in a line."""
    pl, lp = _tables(SQUARE, ((2, 2), (2, 4), (6, 4), (6, 2)))
    d = Tables(tuple(map(tuple, pl)), tuple(map(tuple, lp))).crossing_number(1, 1)
    return Seen(CONDITION if d == 0 else FAILS, f"d is {d} of two sides that overlap")


def touching_is_undecided(kind: str = "") -> Seen:
    """Two boxes that touch: by which rule it was found out which is nearer, and what is hidden without that rule."""
    (relation,) = _scene("stacked.toml").relations
    without = _scene("stacked.toml", "touching")
    less = _hidden(without, INNER) + _hidden(without, CONTOUR) < _hidden(_scene("stacked.toml"), INNER) + _hidden(
        _scene("stacked.toml"), CONTOUR
    )
    good = relation.by == "plane" and less
    return Seen(
        (FAILS if kind else CONDITION) if good else HOLDS, "decided by a separating plane; without it nothing is hidden"
    )


def three_conditions(kind: str = "") -> Seen:
    """Segments between grid points against a square: those with intersections go in, come out, or both."""
    found = set()
    grid = [(x, y) for x in (-3, 1, 2, 7) for y in (-1, 1, 3, 6)]
    for a, b in combinations(grid, 2):
        of_square = values(_lines(SQUARE), [(*a, 0, 1), (*b, 0, 1)])
        if of_square is not None:
            passage = clipped(of_square, 0, 1)
            if passage.marks:
                found.add(tuple(index for _, index in passage.marks))
    good = found == {(1,), (-1,), (2, -2)}
    return Seen((CONDITION if kind else HOLDS) if good else FAILS, "in; out; in and out")


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
        pl, _ = _tables(SQUARE, other)
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
    for v, w in _pairs():
        for i, (p, q) in product(range(len(v)), combinations(range(len(w)), 2)):
            if _cross(v, i, (w[p], w[q]), 0):
                a, b = v[i], v[(i + 1) % len(v)]
                found = values(_lines(w), [(*a, 0, 1), (*b, 0, 1)])
                good.append(found is not None and clipped(found, 0, 1) != CLEAR)
                partly += not (_inside(a, w) and _inside(b, w))
    words = f"{len(good)} crossings of inner edges, {partly} by segments that are within in part only"
    return Seen(CONDITION if all(good) and partly else FAILS, words)


def table_by_4() -> Seen:
    """The counterexample's eye, contour and edge: the table by the signs of (4), as printed, and by those of (1)."""
    (eye, *contour), ends = (found := points_of("table_by_4.csv"))[:-2], found[-2:]
    by_4 = {sign(dot(minus(p, eye), minus(p, end))) for p in contour for end in ends}
    flat = tuple((x, y) for x, y, _ in contour)
    by_1 = [[sign(value(line, (x, y, 1))) for line in _lines(flat)] for x, y, _ in ends]
    goes_in = -1 in by_1[0] and -1 not in by_1[1]
    wrong = by_4 == {-1} and goes_in
    return Seen(FAILS if wrong else HOLDS, "by (4) every element is -1, as if nothing met; by (1) the edge goes in")


def nearer_within() -> Seen:
    """A small box before a large one, its contour within the other's: inner edges of the large one are hidden."""

    def made() -> list[Polyhedron]:
        large = cuboid("large", *map(Fraction, (8, 8, 8)))
        small = cuboid("small", *map(Fraction, (1, 1, 1)))
        x, y, z = map(Fraction, (9, 9, 9))
        return [large, placed(small, moved((x, y, z)), "small")]

    drawing = draw(made, parallel((1, 1, 1)), hidden=True)
    good = _hidden(drawing, INNER) > 0 == _hidden(drawing, CONTOUR)
    return seen(good, f"{_hidden(drawing, INNER)} pieces of inner edges of the large box, none of its contour")


def counts_of_d() -> Seen:
    """Table 1 (d): a solid of F faces has 2 F - 4 vertices at most, a plate none of that; the counts need plates.

    In (a) and (c) as many vertices as can be.
    """
    most = {name: 2 * faces - 4 * parts for name, parts, faces in (("a", 11, 80), ("c", 60, 360), ("d", 30, 158))}
    bases = [4] * 23 + [3] * 2
    plates = (len(bases) + 5, 2 * sum(bases) + 5 * 4, sum(bases) + 2 * len(bases) + 5 * 2)
    good = most["a"] == 116 and most["c"] == 480 and most["d"] < 216 and plates == (30, 216, 158)
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
