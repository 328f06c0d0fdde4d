"""What the papers' methods do, step by step, as things in space: hidden lines, cells of a ball, octants of a hull.

Of Appel and Will the tables of :mod:`modern.papers.appel_will` are the steps already.  Nothing here has a size or a
colour; a picture takes a direction of view and lays out the strokes.
"""

from __future__ import annotations

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

EYE: Eye = (24, -55, 29)
"""From the front, a little above and from the right."""
ABOVE: Eye = (57, 31, 43)
"""From where all three axes come towards the eye."""
SEEN, EDGE_OF_CONTOUR, HIDDEN, REMOVED = "seen", "contour", "hidden", "removed"
"""What a stroke is; ``removed``: taken away by this step."""


@dataclass(frozen=True, slots=True)
class Stroke:
    """A straight line in space, and what it is."""

    start: Vector
    end: Vector
    kind: str = SEEN


@dataclass(frozen=True, slots=True)
class Pane:
    """A face that is seen, and how much light falls on it, from 0 to 1."""

    corners: tuple[Vector, ...]
    light: float


@dataclass(frozen=True, slots=True)
class Plate:
    """A picture of a step: its name, strokes, faces and points (each with whether it is hidden), all in space."""

    name: str
    strokes: tuple[Stroke, ...] = ()
    panes: tuple[Pane, ...] = ()
    points: tuple[tuple[Vector, bool], ...] = ()

    def count(self, kind: str) -> int:
        """How many strokes are of a kind."""
        return sum(stroke.kind == kind for stroke in self.strokes)


Spans = list[tuple[Fraction, Fraction]]
_WHOLE: Spans = [(Fraction(0), Fraction(1))]


@cache
def hidden_lines(name: str = "house") -> tuple[Eye, tuple[Plate, ...]]:
    """A scene of the project drawn stepwise: all edges; without edges between two faces turned away; without what lies
    behind a nearer contour; without the lines that only divide an object (Nakamae and Nishita, sections 3.1 to 3.5)."""
    given = scene(name)
    x, y, z = (int(number) for number in given.sight.eye)
    observer = given.sight.observer(given.make)
    ghostly, last = draw(given.make, observer, without=(GHOSTS,)), draw(given.make, observer)
    kept, result = _pieces(ghostly), _pieces(last)
    fronts: list[Stroke] = []
    backs: list[Stroke] = []
    behind: list[Stroke] = []
    apart: list[Stroke] = []
    before: list[Stroke] = []
    after: list[Stroke] = []
    for item in last.solids:
        places = (*item.polyhedron.vertices, *(p for f in item.polyhedron.figures for p in f.corners))
        for edge in item.edges:
            if edge.kind in (BACK, OUTLINE):
                backs.append(Stroke(places[edge.start], places[edge.end]))
        for segment in item.segments:
            a, b = places[segment.start], places[segment.end]
            kind = EDGE_OF_CONTOUR if segment.kind == CONTOUR else SEEN
            key = (item.number, segment.start, segment.end)
            fronts.append(Stroke(a, b, kind))
            seen, drawn = kept.get(key, []), result.get(key, [])
            before += _cut(a, b, seen, SEEN)
            behind += _cut(a, b, _without(_WHOLE, seen), REMOVED)
            after += _cut(a, b, drawn, SEEN)
            apart += _cut(a, b, _without(seen, drawn), REMOVED)
    gone = [Stroke(stroke.start, stroke.end, REMOVED) for stroke in backs]
    return (x, y, z), (
        Plate("all", (*(Stroke(s.start, s.end) for s in fronts), *backs)),
        Plate("facing", (*gone, *fronts)),
        Plate("nearer", (*behind, *before)),
        Plate("result", (*apart, *after)),
    )


def _pieces(drawing: Drawing) -> dict[tuple[int, int, int], Spans]:
    """What is seen of every segment."""
    found: dict[tuple[int, int, int], Spans] = {}
    for piece in drawing.pieces:
        if piece.seen:
            found.setdefault((piece.solid, piece.start, piece.end), []).append((piece.first, piece.last))
    return found


def _without(spans: Spans, others: Spans) -> Spans:
    """The parts of spans that lie in none of the others."""
    for low, high in others:
        spans = [part for a, b in spans for part in ((a, min(b, low)), (max(a, high), b)) if part[0] < part[1]]
    return spans


def _cut(a: Vector, b: Vector, spans: Spans, kind: str) -> Iterator[Stroke]:
    for low, high in spans:
        yield Stroke(_at(a, b, low), _at(a, b, high), kind)


def _at(a: Vector, b: Vector, share: Fraction) -> Vector:
    x, y, z = (p + (q - p) * share for p, q in zip(a, b, strict=True))
    return x, y, z


@dataclass(frozen=True, slots=True)
class Cells:
    """A small ball of voxels and its hull: pictures, and numbers of cells by dimension.

    ``counts``: of a complex its name and the numbers of 0-, 1-, 2- and 3-cells.  ``hull`` is the cell list with
    coplanar triangles merged.
    """

    diameter: int
    plates: tuple[Plate, ...]
    counts: tuple[tuple[str, tuple[int, int, int, int]], ...]
    hull: CellList


@cache
def cells(diameter: int = 5) -> Cells:
    """The ball of that diameter, its local corners' hull, and what their complexes are made of.

    Of the voxels' surface the cells are counted that lie on the boundary; the 3-cells are the voxels, and one for the
    inside of a polyhedron.
    """
    volume = ball(diameter)
    found = voxel_hull(volume, order=RASTER).polyhedron
    counts = [("the ball's voxels and their boundary", (*_boundary(volume), volume.count))]
    for name, cell_list in (
        ("its hull, as triangles", found.triangles),
        ("its hull, coplanar triangles merged", found.faces),
    ):
        counts.append((name, (len(cell_list.vertices), len(cell_list.edges), len(cell_list.faces), 1)))
    points = [_vector(point) for point in found.faces.points]
    faces = tuple(tuple(k - 1 for k in face.vertices[::-1]) for face in found.faces.faces)
    drawing = draw((Polyhedron("hull", tuple(points), faces),), parallel(_vector(EYE)), hidden=True)
    (item,) = drawing.solids
    light = [_light(plane) for plane in found.faces.planes()]
    panes = [
        Pane(_shrunk([points[k] for k in face]), shade)
        for face, sign, shade in zip(faces, item.signs, light, strict=True)
        if sign > 0
    ]
    edges = [(points[e.start], points[e.end], e.kind == BACK) for e in item.edges]
    front = {k for face, sign in zip(faces, item.signs, strict=True) if sign > 0 for k in face}
    at = tuple((point, k not in front) for k, point in enumerate(points))
    strokes = tuple(Stroke(_at(a, b, _NEAR), _at(a, b, 1 - _NEAR), HIDDEN if back else SEEN) for a, b, back in edges)
    plates = (
        Plate("voxels", _drawn([_cube(where, 1) for where in volume.coordinates().tolist()], EYE)),
        Plate("vertices", points=at),
        Plate("edges", strokes),
        Plate("faces", panes=tuple(panes)),
    )
    return Cells(diameter, plates, tuple(counts), found.faces)


_NEAR = Fraction(1, 8)
"""How much of a cell is left out at each end, so that cells beside each other are seen to be two."""


def _vector(point: Iterable[int]) -> Vector:
    x, y, z = (Fraction(number) for number in point)
    return x, y, z


def _light(plane: tuple[int, int, int, int]) -> float:
    normal = plane[:3]
    cosine = dot(normal, EYE) / (dot(normal, normal) * dot(EYE, EYE)) ** 0.5
    return max(0.0, float(cosine))


def _shrunk(corners: list[Vector]) -> tuple[Vector, ...]:
    middle = _vector((0, 0, 0))
    for corner in corners:
        middle = tuple(a + b / len(corners) for a, b in zip(middle, corner, strict=True))  # type: ignore[assignment]
    return tuple(_at(corner, middle, _NEAR) for corner in corners)


def _cube(low: Iterable[int], side: int) -> Polyhedron:
    length, name = Fraction(side), " ".join(map(str, low))
    return placed(cuboid(name, length, length, length), moved(_vector(low)), name)


def _drawn(solids: list[Polyhedron], eye: Eye) -> tuple[Stroke, ...]:
    """Solids with their hidden lines removed; where they touch, the edges of both are drawn."""
    drawing = draw(solids, parallel(_vector(eye)), check=False)
    found: list[Stroke] = []
    for piece in drawing.pieces:
        vertices = drawing.solids[piece.solid].polyhedron.vertices
        found += _cut(vertices[piece.start], vertices[piece.end], [(piece.first, piece.last)], SEEN)
    return tuple(found)


def _boundary(volume: Volume) -> tuple[int, int, int]:
    """How many corners, edges and squares the boundary of the voxels has."""
    there = {tuple(where) for where in volume.coordinates().tolist()}
    squares: set[tuple[int, ...]] = set()
    # In doubled coordinates a cell is its middle: odd where it extends, even where it does not.
    for where in there:
        for axis, step in product(range(3), (-1, 1)):
            beside = tuple(number + step * (k == axis) for k, number in enumerate(where))
            if beside not in there:
                squares.add(tuple(2 * number + 1 + step * (k == axis) for k, number in enumerate(where)))
    found = [squares]
    for _ in range(2):
        found.append({_moved(cell, k, step) for cell in found[-1] for k in range(3) if cell[k] % 2 for step in (-1, 1)})
    return len(found[2]), len(found[1]), len(found[0])


def _moved(cell: tuple[int, ...], axis: int, step: int) -> tuple[int, ...]:
    return (*cell[:axis], cell[axis] + step, *cell[axis + 1 :])


@dataclass(frozen=True, slots=True)
class Quadrant:
    """A square of the quadtree of heights: its corner, its side; ``height`` None where there is no column.

    ``height``: the greatest below it.  ``whole``: it is a leaf and is divided no further.
    """

    x: int
    y: int
    side: int
    height: int | None
    whole: bool


@dataclass(frozen=True, slots=True)
class Level:
    """A level of the trees of a hull, 0 the whole cube.

    quadrants: of the ceiling, as far as they are divided here.  full, divided, empty: how many nodes the octree has at
    this level.  ``plate`` shows the cubes that are full at this level and above it.
    """

    number: int
    quadrants: tuple[Quadrant, ...]
    full: int
    divided: int
    empty: int
    plate: Plate


RODS = 8
"""How long the three rods of the octree's picture are, in voxels."""


@cache
def rods() -> tuple[OctreeHull, tuple[Level, ...]]:
    """Three rods of voxels along the axes, their digital hull by octrees, and its levels."""
    along = [[k if axis == own else 0 for axis in range(3)] for own in range(3) for k in range(RODS)]
    hull = octree_hull(listed(np.unique(np.array(along), axis=0), "three rods"))
    top = ceiling(hull.hull)
    cubes = zip(hull.hull.corners().tolist(), hull.hull.levels.tolist(), strict=True)
    leaves = [(_cube((x, y, z), hull.side >> level), level) for (x, y, z), level in cubes]
    levels: list[Level] = []
    for number in range(hull.side.bit_length()):
        here = 8 * levels[-1].divided if levels else 1
        full, parted = sum(level == number for _, level in leaves), divided(hull.hull, number)
        drawn = [cube for cube, level in leaves if level <= number]
        levels.append(
            Level(
                number,
                tuple(_quadrants(top, number)),
                full,
                parted,
                here - full - parted,
                Plate(f"level {number}", _drawn(drawn, ABOVE) if drawn else ()),
            )
        )
    return hull, tuple(levels)


def _quadrants(tree: Quadtree, levels: int, x: int = 0, y: int = 0) -> Iterator[Quadrant]:
    whole = tree.is_leaf() or not tree.there.any()
    if levels and not whole:
        half = tree.side // 2
        for (i, j), son in zip(QUADRANTS, sons_of(tree), strict=True):
            yield from _quadrants(son, levels - 1, x + i * half, y + j * half)
    else:
        yield Quadrant(x, y, tree.side, tree.high, whole)
