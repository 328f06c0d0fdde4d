"""Claims of Nakamae and Nishita: edges seen and hidden, indices of intersections, what is nearer, gaps."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from itertools import combinations, permutations, product

from modern.claims.nakamae_nishita.tables import SQUARE, crosses, inside, lines_of, pairs, side, tables_of
from modern.claims.register import CheckResult, counterexample, fails_if, holds_if
from modern.claims.sampled_sets import counterexample_points, sampled_sets
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


def faces_and_edges(kind: str = "") -> CheckResult:
    """A cuboid: three front faces; three inner and six contour edges.

    Along an axis, with a ``kind``: four faces are neither front nor back, and by the letter there is no contour edge;
    with those as back faces there are four.
    """
    (solid,) = _cuboid().solids
    kinds = [edge.kind for edge in solid.edges]
    passed = (sum(s > 0 for s in solid.signs), kinds.count(INNER), kinds.count(CONTOUR)) == (3, 3, 6)
    message = f"{kinds.count(INNER)} inner and {kinds.count(CONTOUR)} contour edges of a cuboid"
    if not kind:
        return holds_if(passed, message)
    (along,) = _cuboid((0, 0, 1)).solids
    pairs_ = combinations(zip(along.polyhedron.faces, along.signs, strict=True), 2)
    letter = sum(
        first_sign * second_sign == -1 and len({*a} & {*b}) == 2 for (a, first_sign), (b, second_sign) in pairs_
    )
    contour = sum(edge.kind == CONTOUR for edge in along.edges)
    passed &= along.signs.count(0) == 4 == contour and not letter
    return holds_if(passed, f"{message}; along an axis {contour} and, by the letter, {letter}", conditional=True)


def hidden_contour_edges() -> CheckResult:
    """Two boxes: pieces of contour edges of the farther are hidden."""
    drawing = _scene("enclosed.toml")
    hidden = {kind for kind in (INNER, CONTOUR) if _hidden(drawing, kind)}
    return holds_if(CONTOUR in hidden, "contour edges of the box are hidden as well as inner ones", conditional=True)


@cache
def _scene(name: str, *without: str) -> Drawing:
    scene = parse(counterexample(name), name)
    return draw(scene.make, scene.sight.observer(scene.make), without, hidden=True)


def _hidden(drawing: Drawing, kind: str) -> int:
    ends = {
        (number, frozenset((edge.start, edge.end)))
        for number, solid in enumerate(drawing.solids)
        for edge in solid.edges
        if edge.kind == kind
    }
    return sum(not p.seen and (p.solid, frozenset((p.start, p.end))) in ends for p in drawing.pieces)


def three_collinear_points() -> CheckResult:
    """(1) of three corners in a line."""
    return holds_if(value(line_through((0, 0, 1), (1, 1, 1)), (2, 2, 1)) == 0, "0 of three in a line", conditional=True)


def indices(kind: str = "") -> CheckResult:
    """Segments between grid points against a square: the program's indices and those of (6), k being their number.

    In general position, each contour segment that is met by its determinant.  ``k``: whether an index is -1 only where
    there is one intersection.
    """
    checks, alone = [], set()
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
        passage = clipped(of_square, 0, 1)
        checks.append(passage.marks == by_six)
        alone |= {len(met) for _, index in by_six if index == -1}
        ways.add(tuple(index for _, index in passage.marks))
    expected = {(), (1,), (-1,), (2, -2)}
    message = f"{len(checks)} segments: 1 going in, -1 coming out, 2 and -2 where both"
    return holds_if(all(checks) and ways == expected and (not kind or alone == {1}), message)


def touching_solids(kind: str = "") -> CheckResult:
    """Two boxes that touch: by which rule it was found out which is nearer, and what is hidden without that rule."""
    (relation,) = _scene("stacked.toml").relations
    without = _scene("stacked.toml", "touching")
    less = _hidden(without, INNER) + _hidden(without, CONTOUR) < _hidden(_scene("stacked.toml"), INNER) + _hidden(
        _scene("stacked.toml"), CONTOUR
    )
    passed = relation.by == "plane" and less
    message = "decided by a separating plane; without it nothing is hidden"
    return holds_if(not passed, message) if kind else holds_if(passed, message, conditional=True)


def three_conditions() -> CheckResult:
    """Segments between grid points against a square: those with intersections go in, come out, or both.

    Some more meet a corner from outside, and are none of these.
    """
    index_patterns, touching = set(), 0
    grid = [(x, y) for x in (-3, 1, 2, 7) for y in (-3, 1, 3, 6)]
    for a, b in combinations(grid, 2):
        of_square = values(lines_of(SQUARE), [(*a, 0, 1), (*b, 0, 1)])
        if of_square is not None:
            passage = clipped(of_square, 0, 1)
            met = any(side(a, b, p) == 0 and min(a[0], b[0]) < p[0] < max(a[0], b[0]) for p in SQUARE)
            touching += met and passage == CLEAR
            if passage.marks:
                index_patterns.add(tuple(index for _, index in passage.marks))
    passed = index_patterns == {(1,), (-1,), (2, -2)} and touching > 0
    return holds_if(passed, f"in; out; in and out; {touching} touch a corner only", conditional=True)


def sense_of_intersection() -> CheckResult:
    """The printed product and (6) for a segment that goes in."""
    p, q, a, b = (point[:2] for point in counterexample_points("sense.csv"))
    printed = (p[0] - q[0]) * (a[1] - b[1]) - (p[1] - q[1]) * (a[0] - b[0])
    six = (q[0] - p[0]) * (a[1] - b[1]) - (q[1] - p[1]) * (a[0] - b[0])
    goes_in = value(line_through((*p, 1), (*q, 1)), (*a, 1)) < 0 < value(line_through((*p, 1), (*q, 1)), (*b, 1))
    return fails_if(goes_in and printed < 0 < six, f"as printed {printed}, by (6) {six}, for a segment going in")


def edges_wholly_behind() -> CheckResult:
    """A box behind a wall: passages without an intersection."""
    corrected, without = _scene("enclosed.toml"), _scene("enclosed.toml", "enclosed")
    alone = any(passage == ENCLOSED for edge_passages in corrected.passages for _, passage in edge_passages.behind)
    newly_visible = sum(p.seen for p in without.pieces) - sum(p.seen for p in corrected.pieces)
    return fails_if(alone and newly_visible > 0, f"{newly_visible} edges of the box would be seen through the wall")


def overlap_by_neighbours() -> CheckResult:
    """Sides of rectangles in one line: by the zeros of PL alone, and with the columns beside, against their ends."""
    zeros, beside = [], []
    for x, y, width in product(range(-5, 8), (-4, 0, 4), (2, 3)):
        rectangle = ((x, y), (x, y + 4), (x + width, y + 4), (x + width, y))
        pl, _ = tables_of(SQUARE, rectangle)
        for i, j in product(range(4), repeat=2):
            row, next_row = pl[j], pl[(j + 1) % 4]
            if row[i] == next_row[i] == 0:
                axis = 0 if SQUARE[i][1] == SQUARE[(i + 1) % 4][1] else 1
                side_interval = sorted((SQUARE[i][axis], SQUARE[(i + 1) % 4][axis]))
                other_interval = sorted((rectangle[j][axis], rectangle[(j + 1) % 4][axis]))
                overlap = max(side_interval[0], other_interval[0]) < min(side_interval[1], other_interval[1])
                zeros.append(overlap)
                apart = any(row[k] <= 0 >= next_row[k] for k in ((i - 1) % 4, (i + 1) % 4))
                beside.append(overlap != apart)
    message = (
        f"{len(zeros)} pairs in one line, of which {zeros.count(False)} do not overlap; the columns beside tell which"
    )
    return holds_if(all(beside) and False in zeros, message, conditional=True)


def segments_within() -> CheckResult:
    """Sides of V that cross an inner edge of V', here a diagonal: each has a part within V', some not all of them."""
    checks, partly = [], 0
    for v, w in pairs():
        for i, (p, q) in product(range(len(v)), combinations(range(len(w)), 2)):
            if crosses(v, i, (w[p], w[q]), 0):
                a, b = v[i], v[(i + 1) % len(v)]
                values_at_w = values(lines_of(w), [(*a, 0, 1), (*b, 0, 1)])
                checks.append(values_at_w is not None and clipped(values_at_w, 0, 1) != CLEAR)
                partly += not (inside(a, w) and inside(b, w))
    message = f"{len(checks)} crossings of inner edges, {partly} by segments that are within in part only"
    return holds_if(all(checks) and partly, message, conditional=True)


def table_by_formula_4() -> CheckResult:
    """The counterexample's eye, contour and edge: the table by the signs of (4), as printed, and by those of (1)."""
    (eye, *contour), ends = (points := counterexample_points("table_by_4.csv"))[:-2], points[-2:]
    by_4 = {sign(dot(minus(p, eye), minus(p, end))) for p in contour for end in ends}
    flat = tuple((x, y) for x, y, _ in contour)
    by_1 = [[sign(value(line, (x, y, 1))) for line in lines_of(flat)] for x, y, _ in ends]
    goes_in = -1 in by_1[0] and -1 not in by_1[1]
    wrong = by_4 == {-1} and goes_in
    return fails_if(wrong, "by (4) every element is -1, as if nothing met; by (1) the edge goes in")


def nearer_contour_inside() -> CheckResult:
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
    passages = [
        passage for edge_passages in drawing.passages if edge_passages.solid == 0 for _, passage in edge_passages.behind
    ]
    whole, met = passages.count(ENCLOSED), sum(bool(passage.marks) for passage in passages)
    passed = whole > 0 < met and _hidden(drawing, INNER) > 0 == _hidden(drawing, CONTOUR)
    message = f"{met} inner edges of the frustum meet the contour of the box, {whole} are hidden and do not"
    return holds_if(passed, message, conditional=True)


def _ring(low: int, high: int) -> tuple[tuple[int, int], ...]:
    return (low, low), (high, low), (high, high), (low, high)


COUNTS = {"a": (11, 116, 80), "c": (60, 480, 360), "d": (30, 216, 158)}
"""Table 1: polyhedra, vertices and faces."""


def counts_of_table_1d() -> CheckResult:
    """Table 1 (d): a solid of F faces has 2 F - 4 vertices at most, a plate none of that; the counts need plates.

    In (a) and (c) as many vertices as can be.
    """
    most = {name: 2 * faces - 4 * parts for name, (parts, _, faces) in COUNTS.items()}
    bases = [4] * 23 + [3] * 2
    plates = (len(bases) + 5, 2 * sum(bases) + 5 * 4, sum(bases) + 2 * len(bases) + 5 * 2)
    passed = all(most[name] == COUNTS[name][1] for name in "ac")
    passed &= most["d"] < COUNTS["d"][1] and plates == COUNTS["d"]
    message = (
        f"30 solids with 158 faces have {most['d']} vertices at most; 25 prisms and five plates have the printed counts"
    )
    return holds_if(passed, message, conditional=True)


def convex_faces() -> CheckResult:
    """Faces of the judge's hulls: the first three corners turn as any three in a row do, about the outward normal."""
    checks = []
    for sampled in sampled_sets(3, 2):
        for facet in sampled.judge.facets:
            ring = [sampled.points[k] for k in facet.polygon]
            turns = [cross(minus(ring[k - 1], ring[k - 2]), minus(ring[k], ring[k - 1])) for k in range(len(ring))]
            checks.append(all(dot(turn, facet.plane[:3]) > 0 for turn in turns))
    return holds_if(all(checks), f"{len(checks)} faces")
