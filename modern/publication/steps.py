"""Intermediate results of three papers as objects in space: hidden lines, cells of a ball, octants of a hull.

The objects have no colour. ``site/pages/papers.py`` draws them. For the fourth paper, Appel and Will's, ``papers.py``
draws the convex edges and loops that :mod:`modern.papers.appel_will` returns.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from itertools import product

import numpy as np

from modern.digital.solids import Volume, ball, listed
from modern.drawing.view import Eye
from modern.drawing.visible import BACK, CONTOUR, OUTLINE
from modern.geometry.vectors import Vector, dot
from modern.papers.kovalevsky_schulz import RASTER, voxel_hull
from modern.papers.kovalevsky_schulz.cells import CellList
from modern.papers.nakamae_nishita.hidden import GHOSTS, Drawing, draw
from modern.papers.nakamae_nishita.polyhedron import Polyhedron
from modern.papers.nakamae_nishita.projection import parallel
from modern.papers.nakamae_nishita.scenes import scene
from modern.papers.nakamae_nishita.shapes import cuboid, moved, placed
from modern.papers.yau_srihari.hull import OctreeHull, octree_hull
from modern.papers.yau_srihari.octree import QUADRANTS, divided
from modern.papers.yau_srihari.quadtree import Quadtree, ceiling, sons_of

# The direction of view from the front, slightly above and to the right.
EYE: Eye = (24, -55, 29)
# A direction of view from which all three axes point towards the eye.
ABOVE: Eye = (57, 31, 43)
# The diameter in voxels of the ball in the picture of cells.
DIAMETER = 5
# The kinds of strokes. The step that a picture shows removes the strokes of the kind ``removed``.
SEEN, EDGE_OF_CONTOUR, HIDDEN, REMOVED = "seen", "contour", "hidden", "removed"


@dataclass(frozen=True, slots=True)
class Stroke:
    """A line segment in space and its kind."""

    start: Vector
    end: Vector
    kind: str = SEEN


@dataclass(frozen=True, slots=True)
class Pane:
    """A visible face and its brightness from 0 to 1."""

    corners: tuple[Vector, ...]
    light: float


@dataclass(frozen=True, slots=True)
class Plate:
    """The picture of one step of a method. ``points`` pairs each point with True if it is hidden, else False."""

    name: str
    strokes: tuple[Stroke, ...] = ()
    panes: tuple[Pane, ...] = ()
    points: tuple[tuple[Vector, bool], ...] = ()

    def count(self, kind: str) -> int:
        """Return the number of strokes of a kind."""
        return sum(stroke.kind == kind for stroke in self.strokes)


Spans = list[tuple[Fraction, Fraction]]
_WHOLE: Spans = [(Fraction(0), Fraction(1))]


@cache
def hidden_lines() -> tuple[Eye, tuple[Plate, ...]]:
    """Draw the scene ``house`` in four steps (Nakamae and Nishita, sections 3.1 to 3.5), and return the eye and the
    steps.

    The first step has all lines. The second step removes edges of which both faces are turned away from the eye. The
    third step removes the parts that nearer faces hide. The fourth step removes ghost lines, which only divide a plane
    face of an object.
    """
    model = scene("house")
    x, y, z = (int(number) for number in model.sight.eye)
    observer = model.sight.observer(model.make)
    with_ghosts, final = draw(model.make, observer, without=(GHOSTS,)), draw(model.make, observer)
    visible, result = _visible_spans(with_ghosts), _visible_spans(final)
    fronts: list[Stroke] = []
    backs: list[Stroke] = []
    behind: list[Stroke] = []  # strokes that the third step removes; ``before`` are those that remain
    before: list[Stroke] = []
    ghosts: list[Stroke] = []  # strokes that the fourth step removes; ``after`` are those that remain
    after: list[Stroke] = []
    for item in final.solids:
        places = (*item.polyhedron.vertices, *(p for f in item.polyhedron.figures for p in f.corners))
        for edge in item.edges:
            if edge.kind in (BACK, OUTLINE):
                backs.append(Stroke(places[edge.start], places[edge.end]))
        for segment in item.segments:
            a, b = places[segment.start], places[segment.end]
            kind = EDGE_OF_CONTOUR if segment.kind == CONTOUR else SEEN
            key = (item.number, segment.start, segment.end)
            fronts.append(Stroke(a, b, kind))
            spans, drawn = visible.get(key, []), result.get(key, [])
            before += _strokes(a, b, spans, SEEN)
            behind += _strokes(a, b, _without(_WHOLE, spans), REMOVED)
            after += _strokes(a, b, drawn, SEEN)
            ghosts += _strokes(a, b, _without(spans, drawn), REMOVED)
    removed = [Stroke(stroke.start, stroke.end, REMOVED) for stroke in backs]
    return (x, y, z), (
        Plate("all", (*(Stroke(s.start, s.end) for s in fronts), *backs)),
        Plate("facing", (*removed, *fronts)),
        Plate("nearer", (*behind, *before)),
        Plate("result", (*ghosts, *after)),
    )


def _visible_spans(drawing: Drawing) -> dict[tuple[int, int, int], Spans]:
    visible: dict[tuple[int, int, int], Spans] = {}
    for piece in drawing.pieces:
        if piece.visible:
            visible.setdefault((piece.solid, piece.start, piece.end), []).append((piece.first, piece.last))
    return visible


def _without(spans: Spans, others: Spans) -> Spans:
    for low, high in others:
        spans = [part for a, b in spans for part in ((a, min(b, low)), (max(a, high), b)) if part[0] < part[1]]
    return spans


def _strokes(a: Vector, b: Vector, spans: Spans, kind: str) -> Iterator[Stroke]:
    for low, high in spans:
        yield Stroke(_at(a, b, low), _at(a, b, high), kind)


def _at(a: Vector, b: Vector, share: Fraction) -> Vector:
    x, y, z = (p + (q - p) * share for p, q in zip(a, b, strict=True))
    return x, y, z


@dataclass(frozen=True, slots=True)
class Cells:
    """Pictures of a ball of voxels and its hull, and their numbers of cells.

    ``counts`` has an entry for each cell complex: its name, and the numbers of its 0-, 1-, 2- and 3-cells. ``hull`` is
    the cell list of the hull with coplanar triangles merged.
    """

    plates: tuple[Plate, ...]
    counts: tuple[tuple[str, tuple[int, int, int, int]], ...]
    hull: CellList


@cache
def cells() -> Cells:
    """Return the pictures and the numbers of cells of a ball of voxels with a diameter of ``DIAMETER``."""
    volume = ball(DIAMETER)
    polyhedron = voxel_hull(volume, order=RASTER).polyhedron
    counts = [("the ball's voxels and their boundary", (*_boundary(volume), volume.count))]
    triangles, merged = ("its hull, as triangles", "its hull, coplanar triangles merged")
    for name, cell_list in ((triangles, polyhedron.triangles), (merged, polyhedron.faces)):
        counts.append((name, (len(cell_list.vertices), len(cell_list.edges), len(cell_list.faces), 1)))
    points = [_vector(point) for point in polyhedron.faces.points]
    faces = tuple(tuple(k - 1 for k in face.vertices[::-1]) for face in polyhedron.faces.faces)
    drawing = draw((Polyhedron("hull", tuple(points), faces),), parallel(_vector(EYE)), hidden=True)
    (item,) = drawing.solids
    light = [_light(plane) for plane in polyhedron.faces.planes()]
    panes = [
        Pane(_shrunk([points[k] for k in face]), shade)
        for face, sign, shade in zip(faces, item.signs, light, strict=True)
        if sign > 0
    ]
    edges = [(points[e.start], points[e.end], e.kind == BACK) for e in item.edges]
    front = {k for face, sign in zip(faces, item.signs, strict=True) if sign > 0 for k in face}
    at = tuple((point, k not in front) for k, point in enumerate(points))
    strokes = tuple(Stroke(_at(a, b, _GAP), _at(a, b, 1 - _GAP), HIDDEN if back else SEEN) for a, b, back in edges)
    plates = (
        Plate("voxels", _drawn([_cube(where, 1) for where in volume.coordinates().tolist()], EYE)),
        Plate("vertices", points=at),
        Plate("edges", strokes),
        Plate("faces", panes=tuple(panes)),
    )
    return Cells(plates, tuple(counts), polyhedron.faces)


_GAP = Fraction(1, 8)  # the share of a cell that is omitted at each end, so that adjacent cells are visibly separate


def _vector(point: Iterable[int | Fraction]) -> Vector:
    x, y, z = (Fraction(number) for number in point)
    return x, y, z


def _light(plane: tuple[int, int, int, int]) -> float:
    normal = plane[:3]
    cosine = dot(normal, EYE) / (dot(normal, normal) * dot(EYE, EYE)) ** 0.5
    return max(0.0, float(cosine))


def _shrunk(corners: list[Vector]) -> tuple[Vector, ...]:
    middle = _vector(sum(axis) / len(corners) for axis in zip(*corners, strict=True))
    return tuple(_at(corner, middle, _GAP) for corner in corners)


def _cube(low: Iterable[int], side: int) -> Polyhedron:
    length, name = Fraction(side), " ".join(map(str, low))
    return placed(cuboid(name, length, length, length), moved(_vector(low)), name)


def _drawn(solids: list[Polyhedron], eye: Eye) -> tuple[Stroke, ...]:
    """Draw solids without their hidden lines. If two solids touch, a common edge is drawn once for each of them."""
    drawing = draw(solids, parallel(_vector(eye)), check=False)
    strokes: list[Stroke] = []
    for piece in drawing.pieces:
        vertices = drawing.solids[piece.solid].polyhedron.vertices
        strokes += _strokes(vertices[piece.start], vertices[piece.end], [(piece.first, piece.last)], SEEN)
    return tuple(strokes)


def _boundary(volume: Volume) -> tuple[int, int, int]:
    voxels = {tuple(where) for where in volume.coordinates().tolist()}
    squares: set[tuple[int, ...]] = set()
    # In doubled coordinates a cell is its centre: a coordinate is odd if the cell extends along the axis, else even.
    for where in voxels:
        for axis, step in product(range(3), (-1, 1)):
            neighbour = tuple(number + step * (k == axis) for k, number in enumerate(where))
            if neighbour not in voxels:
                squares.add(tuple(2 * number + 1 + step * (k == axis) for k, number in enumerate(where)))
    # The ends of a cell along the axes in which it extends are the cells of the next lower dimension.
    edges = {_moved(cell, k, step) for cell in squares for k in range(3) if cell[k] % 2 for step in (-1, 1)}
    corners = {_moved(cell, k, step) for cell in edges for k in range(3) if cell[k] % 2 for step in (-1, 1)}
    return len(corners), len(edges), len(squares)


def _moved(cell: tuple[int, ...], axis: int, step: int) -> tuple[int, ...]:
    return (*cell[:axis], cell[axis] + step, *cell[axis + 1 :])


@dataclass(frozen=True, slots=True)
class Quadrant:
    """A square of the quadtree of heights.  ``height`` is None if no column of the hull stands on the square."""

    x: int
    y: int
    side: int
    height: int | None


@dataclass(frozen=True, slots=True)
class Level:
    """A level of the octree and the quadtree of a hull. Level 0 is the whole cube.

    ``quadrants`` are the squares of the quadtree down to this level, each with the greatest height of the hull above
    it. ``full``, ``divided`` and ``empty`` count the nodes of the octree at this level. ``plate`` shows the full cubes
    down to this level.
    """

    number: int
    quadrants: tuple[Quadrant, ...]
    full: int
    divided: int
    empty: int
    plate: Plate


# The length in voxels of the three rods in the picture of the octree.
RODS = 8


@cache
def rods() -> tuple[OctreeHull, tuple[Level, ...]]:
    """Return the digital hull of three rods of voxels along the axes, and the levels of its octree and quadtree."""
    along = [[k if axis == own else 0 for axis in range(3)] for own in range(3) for k in range(RODS)]
    hull = octree_hull(listed(np.unique(np.array(along), axis=0), "three rods"))
    top = ceiling(hull.hull)
    cubes = zip(hull.hull.corners().tolist(), hull.hull.levels.tolist(), strict=True)
    leaves = [(_cube((x, y, z), hull.side >> level), level) for (x, y, z), level in cubes]
    levels: list[Level] = []
    for number in range(hull.side.bit_length()):
        nodes = 8 * levels[-1].divided if levels else 1
        full, divided_nodes = sum(level == number for _, level in leaves), divided(hull.hull, number)
        drawn = [cube for cube, level in leaves if level <= number]
        plate = Plate(f"level {number}", _drawn(drawn, ABOVE) if drawn else ())
        quadrants, empty = tuple(_quadrants(top, number)), nodes - full - divided_nodes
        levels.append(Level(number, quadrants, full, divided_nodes, empty, plate))
    return hull, tuple(levels)


def _quadrants(tree: Quadtree, levels: int, x: int = 0, y: int = 0) -> Iterator[Quadrant]:
    if not levels or tree.is_leaf() or not tree.there.any():
        yield Quadrant(x, y, tree.side, tree.high)
        return
    half = tree.side // 2
    for (i, j), son in zip(QUADRANTS, sons_of(tree), strict=True):
        yield from _quadrants(son, levels - 1, x + i * half, y + j * half)
