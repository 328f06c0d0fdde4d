"""Checks of Nakamae and Nishita on whole drawings: scenes of hulls, compared with rays from points towards the eye."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import combinations, count, pairwise, product
from operator import lt, ne
from random import Random
from typing import Any

from modern.claims.evidence import Check, Generator, claim, search, searched
from modern.claims.hulls import exact_hull
from modern.claims.sampled_sets import CASES, SETS, Point, sampled_sets
from modern.drawing.visible import CONTOUR, INNER, sign
from modern.exact_hull import ExactHull
from modern.geometry.mesh import sides
from modern.geometry.vectors import dot, minus, plus
from modern.papers.nakamae_nishita.crossings import ENCLOSED
from modern.papers.nakamae_nishita.hidden import Drawing, Piece, draw
from modern.papers.nakamae_nishita.nearness import BY_FACE
from modern.papers.nakamae_nishita.polyhedron import Figure, Polyhedron, checked
from modern.papers.nakamae_nishita.projection import parallel, perspective

# The points whose hull is a convex polyhedron.
Body = tuple[Point, ...]
EYE = (41, -83, 67)
OBSERVER = perspective(tuple(map(Fraction, EYE)), (Fraction(5), Fraction(5), Fraction(5)))  # type: ignore[arg-type]


def box(low: Point, high: Point) -> Body:
    return tuple((x, y, z) for x, y, z in product(*zip(low, high, strict=True)))


def _draw_body(random: Random, low: Point, size: int, most: int) -> Body:
    x, y, z = ([a + random.randint(0, size) for _ in range(random.randint(4, most))] for a in low)
    return tuple(zip(x, y, z, strict=False))


def _draw_bodies(random: Random) -> tuple[Body, ...]:
    lows = [(random.randint(0, 9), random.randint(0, 9), random.randint(0, 9)) for _ in range(3)]
    return tuple(_draw_body(random, low, 5, 8) for low in lows)


def _apart(bodies: tuple[Body, ...]) -> bool:
    """Return True if all bodies are solids without faces seen edge-on, and no two of them touch."""
    hulls = [exact_hull(body) for body in bodies]
    if any(hull.dimension < 3 or not all(_heights(hull, EYE)) for hull in hulls):
        return False
    # Two bodies are apart if 0 is outside the hull of the differences of their points.
    hulls = [exact_hull(sorted({minus(p, q) for p in v for q in w})) for v, w in combinations(bodies, 2)]
    return all(any(height > 0 for height in _heights(hull, (0, 0, 0))) for hull in hulls)


SCENES = Generator("scenes of three hulls of 4 to 8 points in a cube of 14", 71, _draw_bodies, _apart)


def _draw_nested(random: Random) -> tuple[Body, ...]:
    x, y, z = (way + random.randint(-2, 1) for way in (8, -8, 11))
    return _draw_body(random, (0, 0, 0), 9, 12), _draw_body(random, (x, y, z), 2, 5)


def _is_nested(bodies: tuple[Body, ...]) -> bool:
    """Return True if the second body is nearer, has its contour inside that of the first, and hides part of an edge."""
    if len(bodies) != len("vw") or not _apart(bodies):
        return False
    drawing = drawn(bodies)
    is_enclosed = [(relation.by, relation.nearer) for relation in drawing.relations] == [(BY_FACE, -1)]
    corners = len(drawing.solids[0].polyhedron.vertices)
    return is_enclosed and any(p.last - p.first < 1 for p in drawing.pieces if p.solid == 0 and p.end < corners)


NESTED = Generator("hulls with an edge partly behind a smaller hull, of 4 to 12 points", 61, _draw_nested, _is_nested)


def polyhedron_of(points: Sequence[Point], judge: ExactHull) -> Polyhedron:
    vertices = tuple(tuple(map(Fraction, points[k])) for k in judge.vertices)
    rings = tuple(tuple(map(judge.vertices.index, facet.polygon)) for facet in judge.facets)
    return checked(Polyhedron("hull", vertices, rings))  # type: ignore[arg-type]


def polyhedra(bodies: Sequence[Body], thing: str = "") -> list[Polyhedron]:
    return [replace(polyhedron_of(body, exact_hull(body)), name=f"hull of {body}", thing=thing) for body in bodies]


def _heights(hull: ExactHull, point: Any) -> list[Any]:
    """Return the values of the equations of all faces at a point: they are negative inside the hull."""
    return [dot(facet.plane[:3], point) + facet.plane[3] for facet in hull.facets]


def _behind(point: list[Fraction], hull: ExactHull) -> bool:
    """Return True if the segment from a point to the eye runs through the interior of a hull."""
    first, last = Fraction(0), Fraction(1)
    for a, b in zip(_heights(hull, point), _heights(hull, EYE), strict=True):
        if a >= 0 <= b:
            return False
        if a >= 0:
            first = max(first, a / (a - b))
        elif b >= 0:
            last = min(last, a / (a - b))
    return first < last


def point_of(drawing: Drawing, piece: Piece, share: Fraction) -> list[Fraction]:
    """Return the point in space that is at the fraction ``share`` of the edge to which a piece belongs."""
    polyhedron = drawing.solids[piece.solid].polyhedron
    points = [*polyhedron.vertices, *(corner for figure in polyhedron.figures for corner in figure.corners)]
    return [a + share * (b - a) for a, b in zip(points[piece.start], points[piece.end], strict=True)]


def samples(drawing: Drawing) -> Iterator[tuple[Piece, list[Fraction]]]:
    """Yield each piece of an edge in a drawing with its midpoint in space, and with points next to both of its ends."""
    for piece, percent in product(drawing.pieces, (1, 50, 99)):
        yield piece, point_of(drawing, piece, piece.first + (piece.last - piece.first) * Fraction(percent, 100))


@cache
def drawn(bodies: tuple[Body, ...]) -> Drawing:
    """Draw bodies, each face of which has a figure: the outline of the face, reduced to half its size."""
    solids = []
    for body in polyhedra(bodies):
        rings = [[body.vertices[k] for k in face] for face in body.faces]
        halves = ((tuple(a / 2 + sum(c) / len(r) / 2 for a, *c in zip(p, *r, strict=True)) for p in r) for r in rings)
        solids.append(replace(body, figures=(*map(Figure, count(), map(tuple, halves)),)))
    return draw(solids, OBSERVER, hidden=True)


@cache
def _agrees(bodies: tuple[Body, ...]) -> bool:
    hulls = [exact_hull(body) for body in bodies]
    right = [piece.visible != any(_behind(at, hull) for hull in hulls) for piece, at in samples(drawn(bodies))]
    # All edges, and the sides of the figures on front faces.
    lines = sum(len(hull.edges()) for hull in hulls)
    lines += sum(len(f.polygon) for h in hulls for f, at in zip(h.facets, _heights(h, EYE), strict=True) if at > 0)
    return all(right) and sum(piece.last - piece.first for piece in drawn(bodies).pieces) == lines


@claim("nakamae-nishita.7", full=600)
def pieces_against_rays(cases: int = 1, scenes: Generator[tuple[Body, ...]] = SCENES) -> Check:
    message = "the method divides edges, and sides of figures on front faces, into pieces; of three points of each, "
    return search(scenes, _agrees, cases, f"{message}polyhedra hide none if the piece is visible, and otherwise all")


# Eyes in no plane of a face of a sampled hull. If the last number is 0, the eye is at infinity.
EYES = ((1, 401, 401**2, 0), (-(401**2), 1, 401, 0), (7, 9**4, 9**8, 1), (-(9**8), 7, -(9**4), 1))


@claim("nakamae-nishita.11", full=200)
def edges_that_can_be_visible(cases: int = CASES) -> Check:
    outcomes, hidden = [], 0
    for sampled in sampled_sets(3, cases):
        hull = sampled.judge
        points = [sampled.points[k] for k in hull.vertices]
        for x, y, z, is_near in EYES:
            observer = perspective((x, y, z), (0, 0, 0)) if is_near else parallel((x, y, z))  # type: ignore[arg-type]
            (solid,) = draw([polyhedron_of(sampled.points, hull)], observer).solids
            for edge in solid.edges:
                # A hull hides a midpoint if the points next to it, in the direction of the eye, are inside the hull.
                doubled = plus(points[edge.start], points[edge.end])
                way = minus((2 * x, 2 * y, 2 * z), doubled) if is_near else (x, y, z)
                values = ((dot(f.plane[:3], doubled) + 2 * f.plane[3], dot(f.plane[:3], way)) for f in hull.facets)
                is_hidden = all(at_midpoint < 0 or along < 0 for at_midpoint, along in values)
                outcomes.append(is_hidden != (edge.kind in (INNER, CONTOUR)))
                hidden += is_hidden
    message = f"seen from two points and two directions, hulls hide {hidden} of their own {len(outcomes)} edges: all "
    return searched(SETS[3], cases, [*outcomes, hidden], f"{message}except the inner and the contour edges")


# Two boxes: their sizes, and the place of the second box along y and z. It begins where the first box ends along x.
PARTS: Generator[tuple[int, ...]] = Generator(
    "two boxes with sides from 1 to 4 that have a part of a face in common",
    42,
    lambda r: (*(r.randint(1, 4) for _ in range(6)), r.choice((0, 0, 1, -1)), r.choice((0, 0, 1, -1))),
    lambda p: len(p) == len("xyzuvwbc") and min(p[:6]) > 0 and -p[4] < p[6] < p[1] and -p[5] < p[7] < p[2],
)


@claim("nakamae-nishita.40", full=300)
def coplanar_front_faces(cases: int = 2) -> Check:
    checks, removed = [], 0
    for x, y, z, u, v, w, b, c in PARTS.cases(cases):
        boxes: tuple[Body, ...] = ((0, 0, 0), (x, y, z)), ((x, b, c), (x + u, b + v, c + w))
        ghosts, others = _removed(boxes)
        checks.append(not others)
        removed += bool(ghosts)
    message = f"of the visible lines of {cases} objects of two boxes, exactly those within a plane part of the surface "
    message += f"are removed; {removed} objects have some"
    # The second box covers the right side of the first box, and the third box covers the top of the first.
    edge = _removed((((0, 0, 0), (2, 2, 2)), ((2, 0, 0), (4, 2, 2)), ((0, 0, 2), (2, 2, 4))))[1]
    case = "a step of three boxes: its edge, along which faces of one box meet faces of both others, is removed"
    return searched(PARTS, cases, [*checks, removed], message).unless(edge, case)


def _removed(boxes: tuple[Body, ...]) -> tuple[set[tuple[Fraction, ...]], set[tuple[Fraction, ...]]]:
    """Return the ghost lines of an object of boxes, and the other lines that are drawn only with or without them."""
    bodies = [box(*corners) for corners in boxes]
    with_ghosts, without = (_visible_lines(draw(polyhedra(bodies, thing), OBSERVER)) for thing in ("", "box"))
    ghosts = {line for line in with_ghosts if _is_in_face(line, boxes)}
    return ghosts, without ^ (with_ghosts - ghosts)


def _visible_lines(drawing: Drawing) -> set[tuple[Fraction, ...]]:
    """Return the ends of the visible parts of edges, which are parallel to an axis, divided at integer coordinates."""
    lines = set()
    for piece in drawing.pieces:
        p, q = sorted(point_of(drawing, piece, share) for share in (piece.first, piece.last))
        axis = next(k for k in range(3) if p[k] < q[k])
        places = [p[axis], *map(Fraction, range(math.floor(p[axis]) + 1, math.ceil(q[axis]))), q[axis]]
        ends = [(*p[:axis], place, *p[axis + 1 :]) for place in places]
        lines |= {(*start, *end) for start, end in pairwise(ends) if piece.visible}
    return lines


def _is_in_face(line: tuple[Fraction, ...], boxes: tuple[Body, ...]) -> bool:
    """Return True if boxes fill two adjacent ones of the four quadrants around an edge, so that it is inside a face."""
    ways = product(*((-1, 1) if a == b else (0,) for a, b in zip(line[:3], line[3:], strict=True)))
    near = [[(a + b) / 2 + Fraction(k, 9) for a, b, k in zip(line[:3], line[3:], way, strict=True)] for way in ways]
    full = [at for at in near if any(all(map(lt, low, at)) and all(map(lt, at, high)) for low, high in boxes)]
    return len(full) == 2 and sum(map(ne, *full)) == 1


def _draw_view(random: Random) -> tuple[tuple[Point, ...], Point]:
    (x, y, z), points = (random.randint(-3, 3) for _ in range(3)), SETS[3].draw(random)
    return points, (x, y, z)


VIEWS: Generator[tuple[tuple[Point, ...], Point]] = Generator(
    f"hulls of {SETS[3].name}, seen from directions with components from -3 to 3",
    20,
    _draw_view,
    lambda view: any(view[1]) and exact_hull(view[0]).dimension == len("xyz"),
)


CUTS = replace(
    VIEWS,
    name=f"hulls of {SETS[3].name}, divided by planes through the origin",
    seed=40,
    accepts=lambda cut: VIEWS.accepts(cut) and {-1, 1} <= {sign(dot(cut[1], p)) for p in cut[0]},
)


@claim("nakamae-nishita.39", "nakamae-nishita.40", full=300)
def divided_hull(cases: int = 2) -> Check:
    checks, ghosts = [], 0
    for points, way in CUTS.cases(cases):
        hull = exact_hull(points)
        at = [dot(way, p) for p in points]
        # A factor makes all points at which the plane cuts an edge integers.
        scale = math.lcm(*(abs(at[p] - at[q]) or 1 for p, q in hull.edges()))
        scaled = [(scale * x, scale * y, scale * z) for x, y, z in points]
        lines: list[Point] = []
        expected: set[tuple[Any, ...]] = set()
        for p, q in hull.edges():
            ends: list[Any] = [scaled[p], scaled[q]]
            if at[p] * at[q] < 0:
                ends[1:1] = [tuple((at[p] * b - at[q] * a) // (at[p] - at[q]) for a, b in zip(*ends, strict=True))]
            is_seen = any(dot(f.plane[:3], EYE) > 0 for f in hull.facets if {p, q} <= {*f.polygon})
            expected |= {tuple(sorted(line)) for line in pairwise(ends) if is_seen}
            lines += ends
        parts = [tuple({p for p in lines if side * dot(way, p) >= 0}) for side in (1, -1)]
        with_ghosts, without = (_ends(draw(polyhedra(parts, thing), parallel(EYE))) for thing in ("", "hull"))
        checks.append(without == expected)
        ghosts += len(with_ghosts - expected)
    message = f"drawings of {cases} hulls divided by planes have {ghosts} lines more than those of whole hulls; "
    message += "without the lines between coplanar faces of the parts, the drawings are equal"
    return searched(CUTS, cases, [*checks, ghosts], message)


def _ends(drawing: Drawing) -> set[tuple[Any, ...]]:
    places = ([point_of(drawing, piece, share) for share in (piece.first, piece.last)] for piece in drawing.pieces)
    return {tuple(sorted(map(tuple, ends))) for ends in places}


@claim("nakamae-nishita.20", full=400)
def faces_and_edges(cases: int = 4) -> Check:
    directions: list[Point] = [(x, y, z) for x, y, z in product((-1, 0, 1), repeat=3) if any((x, y, z))]
    # Some faces of the cuboid are edge-on if a component of the direction of view is 0.
    cuboid_: tuple[Point, ...] = tuple((x, y, z) for x in (0, 2) for y in (0, 3) for z in (0, 4))
    views = [*VIEWS.cases(cases), *((cuboid_, way) for way in directions)]
    message = "edges that belong to two front faces are inner edges, and edges that belong to one front face form the "
    message += f"contour, in perspective too; this is also true for a cuboid seen from {len(directions)} directions"
    return searched(VIEWS, cases, [_is_classified(*view, w) for view in views for w in (0, 1)], message)


def _is_classified(points: tuple[Point, ...], way: Point, w: int) -> bool:
    # If w is 0, the eye is at infinity.
    judge, eye = exact_hull(points), (10 * way[0], 10 * way[1], 10 * way[2])
    observer = perspective(eye, (0, 0, 0)) if w else parallel(way)  # type: ignore[arg-type]
    (solid,) = draw([polyhedron_of(points, judge)], observer).solids
    seen = [f.polygon for f in judge.facets if dot(f.plane[:3], eye) + w * f.plane[3] > 0]
    front = [{*map(judge.vertices.index, polygon)} for polygon in seen]
    kinds = {frozenset((edge.start, edge.end)): edge.kind for edge in solid.edges}
    counts = {ends: sum(ends <= face for face in front) for ends in kinds}
    right = all((kinds[e] == INNER, kinds[e] == CONTOUR) == (n == 2, n == 1) for e, n in counts.items())
    ring = {frozenset(ends) for ends in sides(solid.contour)}
    return right and len(kinds) == len(judge.edges()) and ring == {e for e, kind in kinds.items() if kind == CONTOUR}


@claim("nakamae-nishita.61", full=300)
def nearer_contour_inside(cases: int = 1) -> Check:
    # A frustum is seen from above, with a box in front of its top.
    squares = (box((0, 0, 0), (8, 8, 0)), box((3, 3, 2), (5, 5, 2)))
    bodies = polyhedra(((*{*squares[0], *squares[1]},), box((2, 2, 4), (6, 6, 5))))
    drawing = draw(bodies, parallel((0, 0, 1)), hidden=True)
    whole = sum(p == ENCLOSED for edge in drawing.passages if edge.solid == 0 for _, p in edge.behind)
    # A point of the frustum is hidden if its image is inside the square contour of the box, from 2 to 6 in x and y.
    points = [(piece.visible, at) for piece, at in samples(drawing) if piece.solid == 0]
    correct = all(visible != (max(abs(x - 4), abs(y - 4)) < 2) for visible, (x, y, _) in points)
    case = f"the {whole} sides of the top of a frustum, which a box hides although they do not meet its contour"
    return pieces_against_rays(cases, NESTED).unless(correct and whole, case)
