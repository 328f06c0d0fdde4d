"""The paper's route from a set of voxels to the cell list of its convex hull.

The last step is merging: triangles of one plane to one face, and edges in one line to one edge (section 2, Figs. 6
and 7).  Where nobody asks how the points are inserted, the merged list is made without inserting them.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from typing import Final, Literal

import numpy as np

from modern.digital.measures import Measures, measures
from modern.digital.solids import NoVoxels, Volume, VolumeError, Voxels, as_volume
from modern.digital.world import World, decimal_or_fraction
from modern.geometry.mesh import Mesh
from modern.papers.kovalevsky_schulz.cells import CellList, Economical, IntPoint, Plane, expanded
from modern.papers.kovalevsky_schulz.corners import NEIGHBOURS, VERTICES, Of, Points, corners_by_neighbours
from modern.papers.kovalevsky_schulz.outcome import hull_cells
from modern.papers.kovalevsky_schulz.polyhedron import VISIBLE, Coplanar, Flat, convex_polyhedron

Order = Literal["raster", "shuffled"]
"""In which order local corners are inserted."""
RASTER: Final = "raster"
SHUFFLED: Final = "shuffled"
_SEED = 1963


def merged(cells: CellList) -> CellList:
    """The cell list with every two neighbouring faces of one plane made one.

    Their common boundary goes, be it one edge or several, and with it the vertices within the new face; a vertex on
    the new face's boundary stays, also where its two edges lie in one line.
    """
    group: dict[Plane, int] = {}
    of_face = [group.setdefault(plane, len(group)) for plane in cells.planes()]
    following: list[dict[int, int]] = [{} for _ in group]
    for edge in cells.edges:
        left, right = of_face[edge.left - 1], of_face[edge.right - 1]
        if left != right:
            following[left][edge.start] = edge.end
            following[right][edge.end] = edge.start
    return _renewed(cells, [_cycle(after) for after in following])


def straightened(cells: CellList) -> CellList:
    """The cell list with edges in one line made one: without the vertices that have two edges only.

    Of merged faces these lie straight between their neighbours, for three faces meet in a vertex of the hull.  Where
    there are none, the list is what it was.
    """
    dropped = {number for number, vertex in enumerate(cells.vertices, 1) if len(vertex.edges) == 2}
    if not dropped:
        return cells
    return _renewed(cells, [[v for v in face.vertices if v not in dropped] for face in cells.faces])


def _cycle(after: dict[int, int]) -> list[int]:
    """A cycle of vertices from the lowest on, given which follows which."""
    way = [min(after)]
    while after[way[-1]] != way[0]:
        way.append(after[way[-1]])
    return way


def _renewed(cells: CellList, cycles: list[list[int]]) -> CellList:
    """The cell list of these faces, with vertices that no face has left out."""
    kept = sorted({vertex for cycle in cycles for vertex in cycle})
    numbers = {old: new for new, old in enumerate(kept, 1)}
    points = tuple(cells.vertices[old - 1].point for old in kept)
    return expanded(Economical(points, tuple(tuple(numbers[vertex] for vertex in cycle) for cycle in cycles)))


@dataclass(frozen=True, slots=True)
class Surface:
    """The surface of a polyhedron as cell lists: of ``faces``, coplanar triangles merged; ``straight``, edges in one
    line merged too, so that every vertex is one of the hull; and of ``triangles``, where an order of insertion was
    asked for.  ``made``: these, or None.
    """

    faces: CellList
    made: CellList | None = None

    @property
    def triangles(self) -> CellList:
        """The triangles that the points inserted one by one leave.  Raises VolumeError where none were inserted."""
        if self.made is None:
            raise VolumeError("there are no triangles where no points are inserted: state an order, such as raster")
        return self.made

    @property
    def straight(self) -> CellList:
        """Made when it is asked for."""
        return straightened(self.faces)


@dataclass(frozen=True, slots=True, eq=False)
class VoxelHull:
    """The convex hull of a solid and what was counted on the way.

    ``source``: what messages call the solid.  ``voxels``: how many it has.  ``corners``: how many local corners 6 and
    26 neighbours leave.  ``inserted``: those that the hull is of, shape (n, 3), in raster order.  ``surface``: the
    hull, ``Flat`` where the places lie in one plane.  ``of``: whether places are centres or corners of voxels.
    ``world``: where voxels lie, by the coordinates of their centres.  ``order``: in which the local corners were
    inserted, None where none was.
    """

    source: str
    voxels: int
    corners: dict[int, int]
    inserted: Points
    surface: Surface | Flat
    of: Of = VERTICES
    world: World | None = None
    order: Order | None = None

    @property
    def polyhedron(self) -> Surface:
        """The surface where there is one.  Raises VolumeError for a flat hull."""
        if isinstance(self.surface, Flat):
            raise VolumeError(f"{self.source}: flat: the hull is a {self.surface.kind} and has no cell list")
        return self.surface

    def mesh(self, straight: bool = False) -> Mesh:
        """The hull for the writers of mesh files and for the judge, as exact text: positions in the world where the
        voxels have any, a corner half a step from the centres; else whole coordinates, as the paper's.

        The faces are counterclockwise seen from outside in these coordinates.  straight: edges in one line merged, so
        that every vertex is one of the hull.
        """
        points, faces = self._polygons(straight)
        if self.world is None:
            return Mesh(self._dimension, tuple(_three(map(str, point)) for point in points), faces)
        # A voxel's corner with the paper's coordinates of that voxel lies half a step before its centre.
        half = Fraction(1, 2) if self.of == VERTICES else Fraction(0)
        places = (self.world.place([number - half for number in point]) for point in points)
        texts = tuple(_three(map(decimal_or_fraction, place)) for place in places)
        turned = tuple(face[::-1] for face in faces) if self.world.mirrors else faces
        return Mesh(self._dimension, texts, turned)

    def measures(self) -> Measures:
        """The measures of the solid and of its hull, in the world where the voxels have positions there."""
        return measures(self.voxels, *self._polygons(False), self.world)

    @property
    def _dimension(self) -> int:
        return self.surface.dimension if isinstance(self.surface, Flat) else 3

    def _polygons(self, straight: bool) -> tuple[tuple[IntPoint, ...], tuple[tuple[int, ...], ...]]:
        """Vertices, and faces as their places from 0."""
        if isinstance(self.surface, Flat):
            cycle = tuple(range(len(self.surface.vertices)))
            return self.surface.vertices, (cycle,) if self.surface.dimension == 2 else ()
        cells = self.surface.straight if straight else self.surface.faces
        return cells.points, tuple(tuple(v - 1 for v in face.vertices) for face in cells.faces)


def _three(texts: Iterable[str]) -> tuple[str, str, str]:
    x, y, z = texts
    return x, y, z


def voxel_hull(
    volume: Volume | Voxels,
    of: Of = VERTICES,
    neighbours: int = 26,
    coplanar: Coplanar | None = None,
    order: Order | None = None,
) -> VoxelHull:
    """The hull of a solid's voxels (``of="centres"``) or of their corners (``of="vertices"``).

    volume: a volume, or an array of truth values indexed [x, y, z].
    neighbours: 6 or 26, the test that chooses local corners.  coplanar: ``visible`` or ``invisible``, see
    ``convex_polyhedron``.  order: ``raster``, the paper's, or ``shuffled``, which is quicker, the same for as many
    points.  The hull does not depend on any of them, the number of triangles does, and which vertices there are in
    line with others.  Where neither coplanar nor order is given, there are no triangles, and the cell list is that of
    the hull; one alone stands for raster order, or for ``visible``.

    Raises VolumeError for a picture of two dimensions, NoVoxels for a volume without voxels, ValueError for another
    choice.
    """
    volume = as_volume(volume)
    if not volume.count:
        raise NoVoxels(f"{volume.source}: there are no voxels")
    if neighbours not in NEIGHBOURS:
        raise ValueError(f"6 or 26 neighbours are tested, not {neighbours}")
    if order is None and coplanar is not None:
        order = RASTER
    corners = corners_by_neighbours(volume, of)
    counts = {count: len(corners[count]) for count in NEIGHBOURS}
    surface = _surface(corners[neighbours], order, coplanar or VISIBLE)
    return VoxelHull(volume.source, volume.count, counts, corners[neighbours], surface, of, volume.world, order)


def _surface(points: Points, order: Order | None, coplanar: Coplanar) -> Surface | Flat:
    """The surface of the hull of local corners, in raster order."""
    if order is None:
        cells = hull_cells(points)
        return cells if isinstance(cells, Flat) else Surface(cells)
    triangles = convex_polyhedron(ordered(points, order), coplanar)
    return triangles if isinstance(triangles, Flat) else Surface(merged(triangles), triangles)


def ordered(points: Points, order: Order) -> Points:
    """Points in raster order in the order in which they are to be inserted.  Raises ValueError for another order."""
    if order == SHUFFLED:
        return np.random.default_rng(_SEED).permutation(points)
    if order != RASTER:
        raise ValueError(f"points are inserted {RASTER} or {SHUFFLED}, not {order!r}")
    return points
