"""Claims of Nakamae and Nishita: contours, the tables PL and LP with their properties, formulas (1) to (6), gaps."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import cache
from itertools import combinations
from random import Random

from modern.drawing.visible import CONTOUR, INNER, line_through, sign, value
from modern.edition.chapter3_claims import points_of
from modern.edition.sampled_sets import sampled_sets, through
from modern.edition.statements import CONDITION, FAILS, HOLDS, Seen, counterexample, seen
from modern.exact_hull import exact_hull
from modern.papers.nakamae_nishita.contours import Tables, values
from modern.papers.nakamae_nishita.crossings import ENCLOSED, clipped
from modern.papers.nakamae_nishita.hidden import Drawing, draw
from modern.papers.nakamae_nishita.projection import parallel
from modern.papers.nakamae_nishita.results import contour_tables
from modern.papers.nakamae_nishita.scenes import parse
from modern.papers.nakamae_nishita.shapes import cuboid

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
        for v, w in _pairs():
            pl, lp = _tables(v, w)
            tables = Tables(tuple(map(tuple, pl)), tuple(map(tuple, lp)))
            for i, j in ((i, j) for i in range(len(v)) for j in range(len(w))):
                good.append((tables.crossing_number(i, j) == -4) == _cross(v, i, w, j))
    elif number == "5":
        corners = [(0, 0, 0), (0, 4, 0), (4, 4, 0)]
        plane = through(*corners)
        good = [plane[2] * z + plane[3] != 0 and (z > 0) == (-plane[2] * z > 0) for z in (-2, 3)]
    else:
        a, b, start, end = (-1, 1), (1, 2), (0, 0), (0, 4)
        determinant = (end[0] - start[0]) * (a[1] - b[1]) - (end[1] - start[1]) * (a[0] - b[0])
        good = [determinant > 0 and value(_lines(SQUARE)[0], (*a, 1)) < 0 < value(_lines(SQUARE)[0], (*b, 1))]
    return seen(bool(good) and all(good), f"{len(good)} cases")


def _cross(v: tuple[Place, ...], i: int, w: tuple[Place, ...], j: int) -> bool:
    a, b, c, d = v[i], v[(i + 1) % len(v)], w[j], w[(j + 1) % len(w)]

    def side(p: Place, q: Place, r: Place) -> int:
        return sign((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]))

    return side(a, b, c) * side(a, b, d) == -1 == side(c, d, a) * side(c, d, b)


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


def three_conditions() -> Seen:
    """Segments between grid points against a square: those with intersections go in, come out, or both."""
    found = set()
    grid = [(x, y) for x in (-3, 1, 2, 7) for y in (-1, 1, 3, 6)]
    for a, b in combinations(grid, 2):
        of_square = values(_lines(SQUARE), [(*a, 0, 1), (*b, 0, 1)])
        if of_square is not None:
            passage = clipped(of_square, 0, 1)
            if passage.marks:
                found.add(tuple(sign(index) for _, index in passage.marks))
    return seen(found == {(1,), (-1,), (1, -1)}, "in; out; in and out")


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
