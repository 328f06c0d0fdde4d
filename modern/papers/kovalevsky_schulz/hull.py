"""The complete method: from a set of voxels to the cell list of its convex hull.

The last steps merge the triangles in one plane into a face, and the edges in one line into an edge (section 2, Figs. 6
and 7). If no order of insertion is requested, the merged cell list is computed without inserting the points.
"""

from dataclasses import dataclass
from fractions import Fraction
from typing import Final, Literal

import numpy as np

from emulator.errors import quoted
from modern.digital.intervals import vertex_candidates
from modern.digital.measures import Measures, measures
from modern.digital.solids import NoVoxels, Volume, VolumeError, Voxels, as_volume
from modern.digital.world import World, decimal_or_fraction
from modern.exact_hull import exact_hull
from modern.geometry.mesh import Mesh, cycle_of
from modern.papers.kovalevsky_schulz.cells import CellList, Economical, IntPoint, Plane, expanded
from modern.papers.kovalevsky_schulz.corners import NEIGHBOURS, VERTICES, Of, Points, corners_by_neighbours
from modern.papers.kovalevsky_schulz.polyhedron import VISIBLE, Coplanar, Flat, convex_polyhedron, flat_hull

# The order in which local corners are inserted.
Order = Literal["raster", "shuffled"]
RASTER: Final = "raster"
SHUFFLED: Final = "shuffled"
_SEED = 1963


def merged(cells: CellList) -> CellList:
    """Return the cell list in which the faces of a polyhedron that lie in one plane are merged into one face.

    The common boundary of these faces disappears, whether it is one edge or several, together with the vertices within
    the merged face. A vertex on the boundary of the merged face remains, even if its two edges lie in one line.
    """
    group: dict[Plane, int] = {}
    group_of_face = [group.setdefault(plane, len(group)) for plane in cells.planes()]
    # Only the edges between different planes remain. The edges of a merged face form one cycle, because it is convex.
    successors: list[dict[int, int]] = [{} for _ in group]
    # The left face follows an edge from its start to its end, the right face in the opposite direction (Table 2).
    for edge in cells.edges:
        group_1, group_2 = group_of_face[edge.left - 1], group_of_face[edge.right - 1]
        if group_1 != group_2:
            successors[group_1][edge.start] = edge.end
            successors[group_2][edge.end] = edge.start
    return _renumbered(cells, [cycle_of(successor) for successor in successors])


def straightened(cells: CellList) -> CellList:
    """Return the cell list in which edges that lie in one line are merged: the vertices with only two edges are
    removed.

    If coplanar faces are merged already, such a vertex lies on the line between its neighbours, because at least three
    faces meet in a vertex of the hull.
    """
    removed = {number for number, vertex in enumerate(cells.vertices, 1) if len(vertex.edges) == 2}
    if not removed:
        return cells
    return _renumbered(cells, [[v for v in face.vertices if v not in removed] for face in cells.faces])


def hull_cells(points: Points) -> CellList | Flat:
    """Return the hull of distinct points, shape (n, 3), as a cell list, without inserting the points one by one.

    The result is ``Flat`` if all points lie in one plane. The faces are those of the exact hull, sorted by their cycles
    of vertices. Each cycle begins with its lowest number.

    The paper's procedure finds the same vertices in the same order, and the same faces, on two conditions: it inserts
    the points in raster order, and it counts a face whose plane contains the new point as visible. A point that
    is not a vertex of the hull of the points inserted so far then disappears from the polyhedron, because all faces at
    this point are visible from the new point. Only the numbering of the faces and edges differs.
    """
    # Only the first and the last point of a column (the points with equal x and y) can be vertices of the hull.
    x, y, z = points[np.lexsort(points.T[::-1])].T
    first = np.concatenate(([True], (x[1:] != x[:-1]) | (y[1:] != y[:-1])))
    last = np.concatenate((first[1:], [True]))
    candidates = vertex_candidates(x[first], y[first], z[first], z[last])
    hull = exact_hull(candidates[np.lexsort(candidates.T)])
    if hull.dimension < 3:
        return flat_hull(hull)
    # The vertices are numbered in raster order, as in the paper's procedure.
    numbers = {index: number for number, index in enumerate(hull.vertices, 1)}
    cycles = sorted(tuple(numbers[index] for index in facet.polygon) for facet in hull.facets)
    return expanded(Economical(tuple(hull.scaled[index] for index in hull.vertices), tuple(cycles)))


def _renumbered(cells: CellList, cycles: list[list[int]]) -> CellList:
    """Return the cell list of faces, given as cycles of vertices of ``cells``. Omit vertices that are on no face."""
    # The paper numbers the cells of the merged list consecutively.
    used = sorted({vertex for cycle in cycles for vertex in cycle})
    numbers = {old: new for new, old in enumerate(used, 1)}
    points = tuple(cells.vertices[old - 1].point for old in used)
    return expanded(Economical(points, tuple(tuple(numbers[vertex] for vertex in cycle) for cycle in cycles)))


@dataclass(frozen=True, slots=True)
class Surface:
    """The surface of a hull: a cell list with merged faces and, if an order of insertion was requested, one of
    triangles.
    """

    faces: CellList
    triangulation: CellList | None = None

    @property
    def triangles(self) -> CellList:
        """The triangles that result from inserting points one by one. Raise VolumeError if no points were inserted."""
        if self.triangulation is None:
            raise VolumeError("triangles exist only if the points are inserted one by one, as with order='raster'")
        return self.triangulation

    @property
    def straight(self) -> CellList:
        """The cell list in which edges in one line are merged too. All of its vertices are vertices of the hull."""
        return straightened(self.faces)


@dataclass(frozen=True, slots=True, eq=False)
class VoxelHull:
    """The convex hull of a voxel solid, and the counts of Kovalevsky and Schulz's method.

    ``source`` names the solid in messages, and ``voxels`` is the number of its voxels. ``corners`` has the number of
    local corners found by the test of 6 neighbours and the number found by the test of 26. ``inserted`` has the local
    corners whose hull was computed, of shape (n, 3), in raster order. ``order`` is the order in which they were
    inserted one by one, or None if they were not. ``surface`` is ``Flat`` if all points lie in one plane. ``of`` tells
    whether the points are centres or corners of voxels. ``world`` maps voxel coordinates to physical coordinates, or is
    None if the position is unknown.
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
        """The surface of the hull. Raise VolumeError if the hull is flat."""
        if isinstance(self.surface, Flat):
            raise VolumeError(
                f"{self.source}: expected a hull in space, found a {self.surface.kind}, which has no cell list"
            )
        return self.surface

    def mesh(self, straight: bool = False) -> Mesh:
        """Return the hull as a mesh whose coordinates are exact text.

        If the position of the voxels is known, the coordinates are physical. Otherwise they are indices of voxels or
        corners, which are integers as in the paper. The faces are counterclockwise as seen from outside in these
        coordinates. With ``straight``, edges in one line are merged. All vertices are then vertices of the hull.
        """
        points, faces = self._polygons(straight)
        if self.world is None:
            return Mesh(self._dimension, tuple((str(x), str(y), str(z)) for x, y, z in points), faces)
        # The corner (x, y, z) in the paper's coordinates lies half a step before the centre of voxel (x, y, z).
        half = Fraction(1, 2) if self.of == VERTICES else Fraction(0)
        places = (map(decimal_or_fraction, self.world.place([number - half for number in point])) for point in points)
        texts = tuple((x, y, z) for x, y, z in places)
        outward = tuple(face[::-1] for face in faces) if self.world.mirrors else faces
        return Mesh(self._dimension, texts, outward)

    def measures(self) -> Measures:
        """Return the measures of the solid and its hull, in physical units if the position of the voxels is known."""
        return measures(self.voxels, *self._polygons(False), self.world)

    @property
    def _dimension(self) -> int:
        return self.surface.dimension if isinstance(self.surface, Flat) else 3

    def _polygons(self, straight: bool) -> tuple[tuple[IntPoint, ...], tuple[tuple[int, ...], ...]]:
        """Return the vertices, and each face as a cycle of indices of vertices, from 0."""
        if isinstance(self.surface, Flat):
            cycle = tuple(range(len(self.surface.vertices)))
            return self.surface.vertices, (cycle,) if self.surface.dimension == 2 else ()
        cells = self.surface.straight if straight else self.surface.faces
        return cells.points, tuple(tuple(v - 1 for v in face.vertices) for face in cells.faces)


def voxel_hull(
    volume: Volume | Voxels,
    of: Of = VERTICES,
    neighbours: int = 26,
    coplanar: Coplanar | None = None,
    order: Order | None = None,
) -> VoxelHull:
    """Return the hull of a solid's voxels.

    ``volume`` may be an array of truth values indexed [x, y, z]. ``of`` is ``centres`` or ``vertices``, for the hull of
    the voxels' centres or corners. ``neighbours`` is 6 or 26, the number of neighbours in the test for local corners.
    ``coplanar`` is ``visible`` (the default) or ``invisible``: how a face counts whose plane contains the new point.
    ``order`` is ``raster`` as in the paper, or ``shuffled``, a reproducible random order, which is faster. If only
    ``coplanar`` is set, the order is ``raster``. If neither ``coplanar`` nor ``order`` is set, no points are inserted
    and there are no triangles.

    The hull does not depend on ``neighbours``, ``coplanar`` and ``order``. But the number of triangles depends on them,
    and so do the vertices of the cell list that lie in line with two others. Raise VolumeError for a volume of two
    dimensions, NoVoxels for a volume without voxels, and ValueError for another value of an option.
    """
    volume = as_volume(volume)
    if not volume.count:
        raise NoVoxels(f"{volume.source}: there are no voxels")
    if neighbours not in NEIGHBOURS:
        raise ValueError(f"expected 6 or 26 neighbours, found {neighbours}")
    if order is None and coplanar is not None:
        order = RASTER
    # Section 2: only local corners can be vertices. Their numbers by 6 and by 26 neighbours are part of the result.
    corners = corners_by_neighbours(volume, of)
    counts = {count: len(corners[count]) for count in NEIGHBOURS}
    surface = _surface(corners[neighbours], order, coplanar or VISIBLE)
    return VoxelHull(volume.source, volume.count, counts, corners[neighbours], surface, of, volume.world, order)


def _surface(points: Points, order: Order | None, coplanar: Coplanar) -> Surface | Flat:
    """Return the surface of the hull of local corners (the points that can be vertices), given in raster order."""
    if order is None:
        cells = hull_cells(points)
        return cells if isinstance(cells, Flat) else Surface(cells)
    if order == SHUFFLED:
        points = np.random.default_rng(_SEED).permutation(points)
    elif order != RASTER:
        raise ValueError(f"expected {RASTER} or {SHUFFLED} as the order of insertion, found {quoted(order)}")
    triangles = convex_polyhedron(points, coplanar)
    return triangles if isinstance(triangles, Flat) else Surface(merged(triangles), triangles)
