"""Checks of Nakamae and Nishita on whole drawings: scenes of boxes, compared with rays from points towards the eye."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import combinations, pairwise, product
from operator import lt, ne
from random import Random

from modern.claims.evidence import Check, Generator, claim, search, searched
from modern.claims.hulls import exact_hull
from modern.claims.nakamae_nishita.tables import overlap
from modern.claims.sampled_sets import CASES, SETS, Point, sampled_sets
from modern.drawing.visible import CONTOUR, INNER
from modern.exact_hull import ExactHull
from modern.geometry.mesh import sides
from modern.geometry.vectors import dot, minus, plus
from modern.papers.nakamae_nishita.crossings import ENCLOSED
from modern.papers.nakamae_nishita.hidden import Drawing, Piece, draw
from modern.papers.nakamae_nishita.nearness import BY_FACE
from modern.papers.nakamae_nishita.polyhedron import Figure, Polyhedron, checked
from modern.papers.nakamae_nishita.projection import parallel, perspective
from modern.papers.nakamae_nishita.shapes import cuboid, moved, placed

# The lowest and the highest corner of a box.
Box = tuple[tuple[int, int, int], tuple[int, int, int]]
EYE = (41, -83, 67)
OBSERVER = perspective(tuple(map(Fraction, EYE)), (Fraction(5), Fraction(5), Fraction(5)))  # type: ignore[arg-type]


def _draw_boxes(random: Random) -> tuple[Box, ...]:
    corners = [tuple(random.randint(0, 9) for _ in range(3)) for _ in range(3)]
    sizes = [tuple(random.randint(1, 5) for _ in range(3)) for _ in range(3)]
    return tuple(zip(corners, map(plus, corners, sizes), strict=True))  # type: ignore[arg-type]


def _apart(boxes: tuple[Box, ...]) -> bool:
    """Return True if all boxes have a positive size and no two of them touch. A reduced case may violate this."""
    if any(min(b - a for a, b in zip(*box, strict=True)) < 1 for box in boxes):
        return False
    return all(any(p[1][k] < q[0][k] or q[1][k] < p[0][k] for k in range(3)) for p, q in combinations(boxes, 2))


SCENES: Generator[tuple[Box, ...]] = Generator("scenes of three boxes in a cube of 15", 71, _draw_boxes, _apart)


def _draw_nested(random: Random) -> tuple[Box, ...]:
    size, extent = (tuple(random.randint(*limits) for _ in range(3)) for limits in ((6, 9), (1, 2)))
    # The smaller box is moved from the middle of the larger one roughly towards the eye.
    low = tuple(s // 2 + way + random.randint(-2, 1) for s, way in zip(size, (8, -16, 12), strict=True))
    small = low, tuple(a + b for a, b in zip(low, extent, strict=True))
    return ((0, 0, 0), size), small  # type: ignore[return-value]


def _is_nested(boxes: tuple[Box, ...]) -> bool:
    """Return True if the second box is nearer, has its contour inside that of the first, and hides part of an edge."""
    if len(boxes) != len("vw") or not _apart(boxes):
        return False
    drawing = drawn(boxes)
    is_enclosed = [(relation.by, relation.nearer) for relation in drawing.relations] == [(BY_FACE, -1)]
    return is_enclosed and any(p.last - p.first < 1 for p in drawing.pieces if p.end < 8)


NESTED: Generator[tuple[Box, ...]] = Generator(
    "boxes with sides from 6 to 9, an edge of which is partly behind a smaller box", 61, _draw_nested, _is_nested
)


def polyhedra(boxes: tuple[Box, ...], thing: str = "") -> list[Polyhedron]:
    made = []
    for low, high in boxes:
        size = [Fraction(b - a) for a, b in zip(low, high, strict=True)]
        place = moved(tuple(map(Fraction, low)))  # type: ignore[arg-type]
        made.append(replace(placed(cuboid(f"box {low}", *size), place, f"box at {low}"), thing=thing))
    return made


def _inside(point: list[Fraction], box: Box) -> tuple[Fraction, Fraction]:
    """Return where the line from a point to the eye enters and leaves a box; unless they meet, the first is larger."""
    ranges = [sorted(((a - p) / (e - p), (b - p) / (e - p))) for p, a, b, e in zip(point, *box, EYE, strict=True)]
    return max(first for first, _ in ranges), min(last for _, last in ranges)


def _behind(point: list[Fraction], box: Box) -> bool:
    """Return True if the ray from a point towards the eye runs through the interior of a box."""
    first, last = _inside(point, box)
    return first < last and last > 0


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
def drawn(boxes: tuple[Box, ...]) -> Drawing:
    """Draw boxes, each face of which has a figure: the outline of the face, reduced to half its size."""
    solids = []
    for box in polyhedra(boxes):
        rings = [[box.vertices[k] for k in face] for face in box.faces]
        figures = [
            [tuple((3 * x + y) / 4 for x, y in zip(p, r[k - 2], strict=True)) for k, p in enumerate(r)] for r in rings
        ]
        solids.append(replace(box, figures=(*map(Figure, range(6), figures),)))  # type: ignore[arg-type]
    return draw(solids, OBSERVER, hidden=True)


@cache
def _agrees(boxes: tuple[Box, ...]) -> bool:
    right = [piece.visible != any(_behind(at, box) for box in boxes) for piece, at in samples(drawn(boxes))]
    # Each box has 12 edges, and 12 sides of figures on its three front faces.
    return all(right) and sum(piece.last - piece.first for piece in drawn(boxes).pieces) == 24 * len(boxes)


@claim("nakamae-nishita.7", full=600)
def pieces_against_rays(cases: int = 2, scenes: Generator[tuple[Box, ...]] = SCENES) -> Check:
    message = "the method divides edges, and figures on front faces, into visible and hidden pieces; boxes hide no "
    return search(scenes, _agrees, cases, f"{message}point tested on visible pieces, and all tested on hidden ones")


# Eyes in no plane of a face of a sampled hull. If the last number is 0, the eye is at infinity.
EYES = ((1, 401, 401**2, 0), (-(401**2), 1, 401, 0), (7, 9**4, 9**8, 1), (-(9**8), 7, -(9**4), 1))


def polyhedron_of(points: Sequence[Point], judge: ExactHull) -> Polyhedron:
    vertices = tuple(tuple(map(Fraction, points[k])) for k in judge.vertices)
    rings = tuple(tuple(map(judge.vertices.index, facet.polygon)) for facet in judge.facets)
    return checked(Polyhedron("hull", vertices, rings))  # type: ignore[arg-type]


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


@claim("nakamae-nishita.15", full=600)
def unrelated_polyhedra(cases: int = 2) -> Check:
    def hide_nothing(boxes: tuple[Box, ...]) -> bool:
        compared = {frozenset((relation.v, relation.w)) for relation in drawn(boxes).relations}
        for v, w in combinations(range(len(boxes)), 2):
            is_common = overlap(_image(boxes[v]), _image(boxes[w]))
            # The program must compare exactly the boxes whose images overlap.
            if ({v, w} in compared) != is_common or any(True for _ in orders(boxes[v], boxes[w]) if not is_common):
                return False
        return True

    return search(SCENES, hide_nothing, cases, "boxes whose contours do not overlap hide nothing of each other")


def _image(box: Box) -> tuple[tuple[int, int], ...]:
    """Return the images of the corners of a box in the plane z = 0, enlarged so that they have integer coordinates."""
    (a, b, c), corners = EYE, product(*zip(*box, strict=True))
    scale = math.lcm(*range(c - 15, c + 1))
    return tuple(((c * x - a * z) * scale // (c - z), (c * y - b * z) * scale // (c - z)) for x, y, z in corners)


def orders(*pair: Box) -> Iterator[int]:
    """Yield for each sampled line of sight through two boxes: 1 if the first is nearer, -1 if the second is, else 0."""
    for low, high in pair:
        for point in product(*(range(a, b + 1) for a, b in zip(low, high, strict=True))):
            (first_v, last_v), (first_w, last_w) = (_inside([*map(Fraction, point)], box) for box in pair)
            if first_v < last_v and first_w < last_w:
                yield (first_v >= last_w) - (first_w >= last_v)


# Two boxes: their sizes, and the place of the second box along y and z. It begins where the first box ends along x.
PARTS: Generator[tuple[int, ...]] = Generator(
    "two boxes with sides from 1 to 4 that have a part of a face in common",
    39,
    lambda r: (*(r.randint(1, 4) for _ in range(6)), r.choice((0, 0, 1, -1)), r.choice((0, 0, 1, -1))),
    lambda p: len(p) == len("xyzuvwbc") and min(p[:6]) > 0 and -p[4] < p[6] < p[1] and -p[5] < p[7] < p[2],
)


@claim("nakamae-nishita.39", "nakamae-nishita.40", full=300)
def divided_object(cases: int = 4) -> Check:
    checks, removed = [], 0
    for x, y, z, u, v, w, b, c in PARTS.cases(cases):
        boxes: tuple[Box, ...] = ((0, 0, 0), (x, y, z)), ((x, b, c), (x + u, b + v, c + w))
        with_ghosts, without = (_visible_lines(draw(polyhedra(boxes, thing), OBSERVER)) for thing in ("", "box"))
        checks.append(without == {line for line in with_ghosts if not _is_in_face(line, boxes)})
        removed += len(with_ghosts) > len(without)
    message = f"{cases} objects consist of two boxes each; of their visible lines, exactly those within a plane part "
    message += f"of the surface are removed as ghost lines; number of objects with such lines: {removed}"
    return searched(PARTS, cases, [*checks, removed], message)


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


def _is_in_face(line: tuple[Fraction, ...], boxes: tuple[Box, ...]) -> bool:
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


@claim("nakamae-nishita.20", full=400)
def faces_and_edges(cases: int = 4) -> Check:
    directions: list[Point] = [(x, y, z) for x, y, z in product((-1, 0, 1), repeat=3) if any((x, y, z))]
    # Some faces of the cuboid are edge-on if a component of the direction of view is 0.
    cuboid_: tuple[Point, ...] = tuple((x, y, z) for x in (0, 2) for y in (0, 3) for z in (0, 4))
    views = [*VIEWS.cases(cases), *((cuboid_, way) for way in directions)]
    message = "edges that belong to two front faces are inner edges, and edges that belong to one front face form the "
    message += f"contour; this is also true for a cuboid seen from {len(directions)} directions"
    return searched(VIEWS, cases, [_is_classified(*view) for view in views], message)


def _is_classified(points: tuple[Point, ...], way: Point) -> bool:
    judge = exact_hull(points)
    (solid,) = draw([polyhedron_of(points, judge)], parallel(way)).solids
    front = [{*map(judge.vertices.index, f.polygon)} for f in judge.facets if dot(f.plane[:3], way) > 0]
    kinds = {frozenset((edge.start, edge.end)): edge.kind for edge in solid.edges}
    counts = {ends: sum(ends <= face for face in front) for ends in kinds}
    right = all((kinds[e] == INNER, kinds[e] == CONTOUR) == (n == 2, n == 1) for e, n in counts.items())
    ring = {frozenset(ends) for ends in sides(solid.contour)}
    return right and len(kinds) == len(judge.edges()) and ring == {e for e, kind in kinds.items() if kind == CONTOUR}


@claim("nakamae-nishita.61", full=300)
def nearer_contour_inside(cases: int = 3) -> Check:
    # A frustum is seen from above, with a box in front of its top.
    squares = [((a, a, z), (b, a, z), (b, b, z), (a, b, z)) for z, a, b in ((0, 0, 8), (2, 3, 5))]
    corners = tuple((Fraction(x), Fraction(y), Fraction(z)) for square in squares for x, y, z in square)
    walls = [(k, k + 4, (k + 1) % 4 + 4, (k + 1) % 4) for k in range(4)]
    frustum = checked(Polyhedron("frustum", corners, ((0, 1, 2, 3), (7, 6, 5, 4), *walls)))
    drawing = draw([frustum, *polyhedra((((2, 2, 4), (6, 6, 5)),))], parallel((0, 0, 1)), hidden=True)
    whole = sum(p == ENCLOSED for edge in drawing.passages if edge.solid == 0 for _, p in edge.behind)
    # A point of the frustum is hidden if its image is inside the square contour of the box, from 2 to 6 in x and y.
    points = [(piece.visible, at) for piece, at in samples(drawing) if piece.solid == 0]
    correct = all(visible != (max(abs(x - 4), abs(y - 4)) < 2) for visible, (x, y, _) in points)
    case = f"the {whole} sides of the top of a frustum, which a box hides although they do not meet its contour"
    return pieces_against_rays(cases, NESTED).unless(correct and whole, case)
