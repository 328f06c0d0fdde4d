"""Cell lists: the vertices, edges and faces of a polyhedron's surface, in the form of the paper's Tables 1 to 3.

Vertices, edges and faces are numbered from 1, as in the paper. ``CellList`` is the full list, in which each cell refers
to its neighbours. ``Economical`` contains only the coordinates of the vertices and the vertices of each face.
``expanded`` computes the full list from the economical list.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain, pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from emulator.errors import EmulatorError

IntPoint = tuple[int, int, int]
Plane = tuple[int, int, int, int]
Numbers = NDArray[np.int64]
Array = NDArray[Any]
# The number of values in one batch: few enough for the processor's cache and for BLAS to stay in one thread.
_BLOCK = 1 << 15


class CellListError(EmulatorError):
    """Raised for a cell list that is not a convex polyhedron. The message names the vertex or face, counted from 1."""


@dataclass(frozen=True, slots=True)
class Vertex:
    """A vertex in a cell list (Table 1). ``edges`` has -e for each edge e that starts at it, +e for each that ends at
    it.
    """

    point: IntPoint
    edges: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Edge:
    """An edge in a cell list (Table 2): its two vertices, and the faces on its left and right.

    The edge is seen from outside, in the direction from ``start`` to ``end``.
    """

    start: int
    end: int
    left: int
    right: int


@dataclass(frozen=True, slots=True)
class Face:
    """A face in a cell list (Table 3): pairs (P, L) of a vertex and an edge, counterclockwise as seen from outside.

    Edge L leads from vertex P to the P of the next pair. L is positive if the edge is followed from its start to its
    end, i.e. if the face is on its left.
    """

    pairs: tuple[tuple[int, int], ...]

    @property
    def vertices(self) -> tuple[int, ...]:
        return tuple(vertex for vertex, _ in self.pairs)


@dataclass(frozen=True, slots=True)
class Economical:
    """The short encoding of a polyhedron without edges: the vertices, and each face as a cycle of vertex numbers."""

    points: tuple[IntPoint, ...]
    faces: tuple[tuple[int, ...], ...]

    def integers(self) -> tuple[int, ...]:
        """Return the encoding as integers: the numbers of vertices and faces, the coordinates, and each face.

        A face is encoded by the number of its vertices, followed by the numbers of these vertices.
        """
        head = (len(self.points), len(self.faces))
        coordinates = (number for point in self.points for number in point)
        return (*head, *coordinates, *(number for face in self.faces for number in (len(face), *face)))


@dataclass(frozen=True, slots=True)
class CellList:
    """The full cell list: vertices, edges and faces, each with references to its neighbours (Tables 1 to 3)."""

    vertices: tuple[Vertex, ...]
    edges: tuple[Edge, ...]
    faces: tuple[Face, ...]

    @property
    def points(self) -> tuple[IntPoint, ...]:
        return tuple(vertex.point for vertex in self.vertices)

    def economical(self) -> Economical:
        """Return the short encoding, which omits the edges and all references to them."""
        return Economical(self.points, tuple(face.vertices for face in self.faces))

    def planes(self) -> tuple[Plane, ...]:
        """Return the plane (a, b, c, d) of each face in lowest terms. In the polyhedron a x + b y + c z + d <= 0."""
        return tuple(planes_of(self.points, [face.vertices for face in self.faces]))


def planes_of(points: Sequence[IntPoint], cycles: Sequence[Sequence[int]]) -> list[Plane]:
    """Return the planes of plane polygons in lowest terms.

    A plane is positive on the side from which its polygon is seen to run counterclockwise. ``cycles`` has the numbers,
    from 1, of the points around each polygon. Vertices in line with their neighbours are allowed. Raise CellListError
    for a polygon without area.
    """
    sizes, vertex = _flat(cycles)
    low, shifted = _shifted(points, sizes)
    normals, constants = _planes(shifted, sizes, vertex)
    d = constants.astype(object) - normals.astype(object) @ np.array(low, dtype=object)
    a, b, c = normals.T.tolist()
    return list(zip(a, b, c, d.tolist(), strict=True))


def _shifted(points: Sequence[IntPoint], sizes: Numbers) -> tuple[IntPoint, Array]:
    """Return the least x, y and z of the points, and an array of the points relative to them.

    The array has the type int64 if no result that is computed from it can overflow, otherwise Python integers.
    """
    x, y, z = (min(axis) for axis in zip(*points, strict=True))
    shifted = [(p[0] - x, p[1] - y, p[2] - z) for p in points]
    extent = max(map(max, shifted))
    # A normal is the sum of at most one cross product per vertex, each at most 2 extent^2. The value of a plane at a
    # point has three products of normal and coordinate, and its constant term has three more.
    fits = 12 * int(sizes.max()) * extent**3 < 2**62
    return (x, y, z), np.array(shifted, dtype=np.int64 if fits else object)


def _flat(cycles: Sequence[Sequence[int]]) -> tuple[Numbers, Numbers]:
    sizes = np.fromiter(map(len, cycles), np.int64, len(cycles))
    return sizes, np.fromiter(chain.from_iterable(cycles), np.int64, int(sizes.sum()))


def _planes(points: Array, sizes: Numbers, vertex: Numbers) -> tuple[Array, Array]:
    """Return the normal of each polygon in lowest terms, shape (n, 3), and the constant term of its plane."""
    first = np.cumsum(sizes) - sizes
    corner = points[vertex - 1]
    origin = points[vertex[first] - 1]
    arm = corner - np.repeat(origin, sizes, axis=0)
    (u1, u2, u3), (v1, v2, v3) = arm[:-1].T, arm[1:].T
    # The normal of a polygon is the sum of the cross products of successive arms from its first vertex (a fan). The
    # first arm of each polygon is zero, so the product across the border of two polygons vanishes.
    part = np.zeros_like(arm)
    part[:-1] = np.stack([u2 * v3 - u3 * v2, u3 * v1 - u1 * v3, u1 * v2 - u2 * v1], axis=1)
    normal = np.add.reduceat(part, first, axis=0)
    divisor = np.gcd(np.gcd(normal[:, 0], normal[:, 1]), normal[:, 2])
    if not divisor.all():
        raise CellListError("a face has no area")
    normal = normal // divisor[:, None]
    return normal, -(normal * origin).sum(axis=1)


def assembled(points: Sequence[IntPoint], starts: Numbers, ends: Numbers, sizes: Numbers, signed: Numbers) -> CellList:
    """Return the cell list of faces given as cycles of signed edges.

    ``starts`` and ``ends`` have the vertex numbers, from 1, of each edge. ``sizes`` has the number of edges of each
    face. ``signed`` has the edge numbers of all faces one after another, with the signs of ``Face.pairs``. In the
    result each face begins with its vertex of lowest number.
    """
    edge = abs(signed) - 1
    vertex = np.where(signed > 0, starts[edge], ends[edge])
    first = np.cumsum(sizes) - sizes
    face = np.repeat(np.arange(len(sizes)), sizes)
    # Rotate each cycle of edges. ``place`` has the old index of each new entry.
    lowest = np.flatnonzero(vertex == np.minimum.reduceat(vertex, first)[face])
    shift = np.empty(len(sizes), np.int64)
    shift[face[lowest[::-1]]] = lowest[::-1]
    place = first[face] + (np.arange(len(face)) - 2 * first[face] + shift[face]) % sizes[face]
    pairs = list(zip(vertex[place].tolist(), signed[place].tolist(), strict=True))
    # Table 2: the face that follows an edge in its own direction is on its left (row 0), the other on its right.
    sides = np.empty((2, len(starts)), np.int64)
    sides[(signed < 0).astype(np.int64), edge] = face + 1
    # Table 1: sort the edges by their vertex and then by their number.
    number = np.arange(1, len(starts) + 1)
    at, signed_at = np.concatenate([starts, ends]), np.concatenate([-number, number])
    order = np.lexsort((abs(signed_at), at))
    counts = np.cumsum(np.bincount(at, minlength=len(points) + 1)).tolist()
    around = signed_at[order].tolist()
    bounds = [*first.tolist(), len(pairs)]
    return CellList(
        tuple(Vertex(point, tuple(around[a:b])) for point, (a, b) in zip(points, pairwise(counts), strict=True)),
        tuple(map(Edge, starts.tolist(), ends.tolist(), *sides.tolist())),
        tuple(Face(tuple(pairs[a:b])) for a, b in pairwise(bounds)),
    )


def expanded(encoding: Economical) -> CellList:
    """Return the full cell list for the short encoding.

    Edges are numbered in the order in which the faces use them first, and have the direction of their first use. Raise
    CellListError unless the points are distinct and not all in one plane, each edge is on two faces, V - E + F is 2,
    and each face is plane with no point outside of its plane.
    """
    points, faces = encoding.points, encoding.faces
    if len({*points}) < len(points):
        repeated = next(n for n, point in enumerate(points) if point in points[:n])
        raise CellListError(f"vertices {points.index(points[repeated]) + 1} and {repeated + 1} are the same point")
    try:
        sizes, start = _flat(faces)
    except OverflowError:
        raise CellListError("expected vertex numbers below 2^63, found a larger one") from None
    face = np.repeat(np.arange(len(faces)), sizes)
    _check_cycles(sizes, start, face, len(points))
    # Each entry of a cycle is a half-edge from its vertex to the vertex of the next entry.
    following = np.arange(1, len(start) + 1)
    last = np.cumsum(sizes) - 1
    following[last] = last + 1 - sizes
    end = start[following]
    # Half-edges with the same two vertices are one edge, which has the direction of the first half-edge.
    _, first, edge_of = np.unique(
        np.minimum(start, end) * (len(points) + 1) + np.maximum(start, end), return_index=True, return_inverse=True
    )
    forward = start == start[first][edge_of]
    # Each edge must have as many half-edges in one direction as in the opposite direction. Euler's formula then
    # excludes separate surfaces and surfaces with handles. Convexity is checked last.
    unpaired = np.bincount(edge_of, np.where(forward, 1, -1)).astype(bool)
    if unpaired.any():
        edge = first[unpaired].min()
        raise CellListError(f"the edge from vertex {start[edge]} to {end[edge]} has a face on only one of its sides")
    unused = np.setdiff1d(np.arange(1, len(points) + 1), start)
    if unused.size:
        raise CellListError(f"vertex {unused[0]} belongs to no face")
    if 2 * len(first) != len(start) or len(points) - len(first) + len(faces) != 2:
        raise CellListError(f"{len(points)} vertices, {len(first)} edges and {len(faces)} faces form no polyhedron")
    _check_convex(points, sizes, start, face)
    first_used = np.sort(first)
    number = np.searchsorted(first_used, first)[edge_of] + 1
    return assembled(points, start[first_used], end[first_used], sizes, np.where(forward, number, -number))


def _check_cycles(sizes: Numbers, start: Numbers, face: Numbers, count: int) -> None:
    """Raise CellListError if a face has fewer than three vertices, or a vertex twice, or one that does not exist."""
    too_short = np.flatnonzero(sizes < 3)
    order = np.lexsort((start, face))
    twice = (face[order][1:] == face[order][:-1]) & (start[order][1:] == start[order][:-1])
    invalid = np.concatenate([too_short, face[order][1:][twice]])
    missing = np.flatnonzero((start < 1) | (start > count))
    # If several faces are invalid, report the one with the lowest number.
    if invalid.size and (not missing.size or invalid.min() <= face[missing[0]]):
        raise CellListError(f"face {invalid.min() + 1} has fewer than three vertices, or names a vertex twice")
    if missing.size:
        raise CellListError(f"face {face[missing[0]] + 1}: vertex {start[missing[0]]} does not exist")


def _check_convex(points: Sequence[IntPoint], sizes: Numbers, vertex: Numbers, face: Numbers) -> None:
    """Raise CellListError unless each face is plane, no vertex is outside any face, and some vertex is inside each."""
    _, shifted = _shifted(points, sizes)
    normals, constants = _planes(shifted, sizes, vertex)
    greatest = sum(int(abs(part).max()) * int(shifted.max()) for part in normals.T) + int(abs(constants).max())
    # Sums of integer products below 2^53 are exact in float64 in any order of addition, and BLAS multiplies floats.
    kind = np.float64 if greatest < 2**53 else shifted.dtype
    planes = np.column_stack([normals, constants]).astype(kind)
    columns = np.array([*shifted.T, np.ones(len(points), np.int64)], dtype=kind)
    height = max(1, _BLOCK // len(points))
    for first in range(0, len(planes), height):
        values = planes[first : first + height] @ columns
        if values.max() > 0:
            plane, point = (int(number) + 1 for number in np.argwhere(values > 0)[0])
            raise CellListError(f"face {first + plane}: vertex {point} lies outside of its plane")
        if not values[0].any():
            raise CellListError("all vertices lie in one plane")
    off_plane = np.flatnonzero((normals[face] * shifted[vertex - 1]).sum(axis=1) + constants[face])
    if off_plane.size:
        raise CellListError(f"face {face[off_plane[0]] + 1}: its vertices do not lie in one plane")


def coordinates(_: int, point: IntPoint) -> str:
    return str(point)


def vertex_rows(cells: CellList, label: Callable[[int, IntPoint], str] = coordinates) -> Iterator[str]:
    """Yield the rows of the paper's Table 1, one for each vertex.

    The function ``label`` returns the text for a vertex's coordinates from the number and the point of the vertex.
    """
    for number, vertex in enumerate(cells.vertices, 1):
        yield f"{number}\t{label(number, vertex.point)}\t{_listed(vertex.edges)}"


def edge_rows(cells: CellList) -> Iterator[str]:
    """Yield the rows of the paper's Table 2: the two ends of each edge, and the faces on its left and right."""
    for number, edge in enumerate(cells.edges, 1):
        yield f"{number}\t{edge.start}\t{edge.end}\t{edge.left}\t{edge.right}"


def face_rows(cells: CellList) -> Iterator[str]:
    """Yield the rows of the paper's Table 3: the number of edges of each face, and its pairs (vertex, edge)."""
    for number, face in enumerate(cells.faces, 1):
        yield f"{number}\t{len(face.pairs)}\t{_listed(face.pairs)}"


def all_rows(cells: CellList) -> Iterator[str]:
    yield from ("Vertex\tCoordinates\tEdges", *vertex_rows(cells))
    yield from ("Edge\tStartP\tEndP\tLeftF\tRightF", *edge_rows(cells))
    yield from ("Face\tn\tPairs (P, L)", *face_rows(cells))


def _listed(items: Iterable[object]) -> str:
    return ", ".join(map(str, items))


def triangulation_size(triangles: int) -> Fraction:
    """Return the number of integers in a triangulation, by formula (5).

    The formula assumes half as many vertices as triangles.
    """
    return (Fraction(3, 2) + 3) * triangles


def cell_list_size(vertices: int, faces: int) -> int:
    """Return the number of integers in a short cell list by formula (6), which assumes five vertices for each face."""
    return 3 * vertices + 5 * faces


def economical_size(cells: CellList) -> int:
    """Return the exact number of integers in a short cell list: 3 for each vertex, and 1 for each corner of a face."""
    return 3 * len(cells.vertices) + sum(len(face.pairs) for face in cells.faces)


def cube_triangles(voxel_faces: int) -> int:
    """Return the number of triangles that Marching Cubes creates for a voxel object with this number of outer faces.

    The triangulation has one vertex on each outer face of a voxel, V vertices in total. It forms a sphere, so by
    Euler's formula it has 2 V - 4 triangles.
    """
    return 2 * voxel_faces - 4
