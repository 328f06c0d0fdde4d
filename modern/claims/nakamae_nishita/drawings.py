"""Checks of Nakamae and Nishita on whole drawings: scenes of boxes, compared with rays from points towards the eye."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import combinations, product
from random import Random

from modern.claims.evidence import Check, Generator, claim, search, searched
from modern.claims.hulls import exact_hull
from modern.claims.nakamae_nishita.tables import overlap
from modern.claims.sampled_sets import CASES, SETS, Point, sampled_sets
from modern.drawing.visible import CONTOUR, INNER
from modern.exact_hull import ExactHull
from modern.geometry.mesh import sides
from modern.geometry.vectors import dot, plus
from modern.papers.nakamae_nishita.crossings import ENCLOSED
from modern.papers.nakamae_nishita.hidden import Drawing, Piece, draw
from modern.papers.nakamae_nishita.nearness import BY_FACE
from modern.papers.nakamae_nishita.polyhedron import Polyhedron, checked
from modern.papers.nakamae_nishita.projection import parallel
from modern.papers.nakamae_nishita.shapes import cuboid, moved, placed

# The lowest and the highest corner of a box.
Box = tuple[tuple[int, int, int], tuple[int, int, int]]
EYE = (101, -203, 157)


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
    return is_enclosed and any(p.last - p.first < 1 for p in drawing.pieces)


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
    """Return where the line from a point towards the eye enters and leaves a box, in multiples of the vector ``EYE``.

    The line misses the box if the first number is not smaller than the second.
    """
    ranges = [sorted(((a - p) / s, (b - p) / s)) for p, a, b, s in zip(point, *box, EYE, strict=True)]
    return max(first for first, _ in ranges), min(last for _, last in ranges)


def _behind(point: list[Fraction], box: Box) -> bool:
    """Return True if the ray from a point towards the eye runs through the interior of a box."""
    first, last = _inside(point, box)
    return first < last and last > 0


def point_of(drawing: Drawing, piece: Piece, share: Fraction) -> list[Fraction]:
    """Return the point in space that is at the fraction ``share`` of the edge to which a piece belongs."""
    vertices = drawing.solids[piece.solid].polyhedron.vertices
    return [a + share * (b - a) for a, b in zip(vertices[piece.start], vertices[piece.end], strict=True)]


def samples(drawing: Drawing) -> Iterator[tuple[Piece, list[Fraction]]]:
    """Yield each piece of an edge in a drawing with its midpoint in space, and with points next to both of its ends."""
    for piece, percent in product(drawing.pieces, (1, 50, 99)):
        yield piece, point_of(drawing, piece, piece.first + (piece.last - piece.first) * Fraction(percent, 100))


@cache
def drawn(boxes: tuple[Box, ...]) -> Drawing:
    return draw(polyhedra(boxes), parallel(EYE), hidden=True)


@cache
def _agrees(boxes: tuple[Box, ...]) -> bool:
    return all(piece.visible != any(_behind(at, box) for box in boxes) for piece, at in samples(drawn(boxes)))


def pieces_against_rays(cases: int = 3, scenes: Generator[tuple[Box, ...]] = SCENES) -> Check:
    """Check that a piece of an edge is visible if and only if no box hides its midpoint and points next to its ends.

    All edges of the boxes are divided into pieces. Pieces of edges between two back faces are never visible.
    """
    message = "of three points of each piece of an edge, boxes hide none if the method calls the piece visible, and "
    message += "all three otherwise"
    return search(scenes, _agrees, cases, message)


# Directions parallel to no face of a sampled hull: the components of the faces' normals are integers up to 200.
DIRECTIONS: tuple[Point, ...] = ((1, 401, 401**2), (-(401**2), 1, 401), (401, -(401**2), -1))


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
        for way in DIRECTIONS:
            (solid,) = draw([polyhedron_of(sampled.points, hull)], parallel(way)).solids
            for edge in solid.edges:
                # A hull hides a midpoint if the points next to it, in the direction of the eye, are inside the hull.
                doubled = plus(points[edge.start], points[edge.end])
                values = ((dot(f.plane[:3], doubled) + 2 * f.plane[3], dot(f.plane[:3], way)) for f in hull.facets)
                is_hidden = all(at_midpoint < 0 or along < 0 for at_midpoint, along in values)
                outcomes.append(is_hidden != (edge.kind in (INNER, CONTOUR)))
                hidden += is_hidden
    message = f"seen from {len(DIRECTIONS)} directions, hulls hide {hidden} of their own {len(outcomes)} edges: all "
    return searched(SETS[3], cases, [*outcomes, hidden], f"{message}except the inner and the contour edges")


@claim("nakamae-nishita.15", full=600)
def unrelated_polyhedra(cases: int = 3) -> Check:
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
    """Return the images of the corners of a box, by two linear functions that are 0 in the direction of the eye."""
    a, b, c = EYE
    return tuple((b * x - a * y, c * y - b * z) for x, y, z in product(*zip(*box, strict=True)))


def orders(*pair: Box) -> Iterator[int]:
    """Yield for each sampled line of sight through two boxes: 1 if the first is nearer, -1 if the second is, else 0."""
    for low, high in pair:
        for point in product(*(range(a, b + 1) for a, b in zip(low, high, strict=True))):
            (first_v, last_v), (first_w, last_w) = (_inside([*map(Fraction, point)], box) for box in pair)
            if first_v < last_v and first_w < last_w:
                yield (first_v >= last_w) - (first_w >= last_v)


# The sizes of a box, and the place where it is divided along x.
DIVISIONS: Generator[tuple[int, ...]] = Generator(
    "boxes with sides from 2 to 6, divided along x",
    39,
    lambda r: (*(r.randint(2, 6) for _ in range(3)), r.randint(1, 5)),
    lambda d: len(d) == 4 and min(d) > 0 and d[3] < d[0],
)


@claim("nakamae-nishita.39", "nakamae-nishita.40", full=300)
def divided_box(cases: int = 2) -> Check:
    def restores(division: tuple[int, ...]) -> bool:
        x, y, z, cut = division
        halves: tuple[Box, ...] = (((0, 0, 0), (cut, y, z)), ((cut, 0, 0), (x, y, z)))
        scenes = (halves, "box"), (halves, ""), ((((0, 0, 0), (x, y, z)),), "")
        lines = [_visible_lines(draw(polyhedra(boxes, thing), parallel(EYE))) for boxes, thing in scenes]
        together, apart, whole = (sum(abs(b - a) for line in part for a, b in line) for part in lines)
        # The points of an edge of the whole box have two coordinates that are 0 or the size of the box.
        on_box = all(sum(a == b in (0, s) for (a, b), s in zip(e, division, strict=False)) == 2 for e in lines[0])
        return on_box and together == whole < apart

    message = "if the ghost lines are removed, the visible lines of a divided box are on the edges of the whole box "
    message += "and as long as its visible lines; with the ghost lines they are longer"
    return search(DIVISIONS, restores, cases, message)


def _visible_lines(drawing: Drawing) -> list[list[tuple[Fraction, Fraction]]]:
    """Return the coordinates of both ends of each visible piece, as one pair for each axis."""
    ends = ((point_of(drawing, p, p.first), point_of(drawing, p, p.last)) for p in drawing.pieces if p.visible)
    return [[*zip(start, end, strict=True)] for start, end in ends]


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
