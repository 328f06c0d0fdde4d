"""The two-dimensional cell list: vertices, edges and faces of a polyhedron's surface, each naming its neighbours.

Tables 1 to 3 of the paper fix the form; all numbers count from 1, as there.  ``CellList`` is the redundant list,
``Economical`` what is left of it when only the coordinates and the vertices of each face are kept; ``expanded`` makes
the first from the second.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from emulator.errors import EmulatorError

IntPoint = tuple[int, int, int]
Plane = tuple[int, int, int, int]
Numbers = NDArray[np.int64]
Array = NDArray[Any]
_BLOCK = 1 << 15
"""So many values are computed at a time: they stay near the processor, and no second one is called in."""


class CellListError(EmulatorError):
    """A list of cells that is not the surface of a convex polyhedron; the message names vertex or face, from 1."""


@dataclass(frozen=True, slots=True)
class Vertex:
    """A 0-cell (Table 1).

    ``edges``: the edges at it in order of their numbers, -e where edge e starts here and +e where it ends here.
    """

    point: IntPoint
    edges: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Edge:
    """A 1-cell (Table 2): its two vertices, and the faces on its left and right.

    Left and right are those of one who stands outside and looks from ``start`` to ``end``.
    """

    start: int
    end: int
    left: int
    right: int


@dataclass(frozen=True, slots=True)
class Face:
    """A 2-cell (Table 3): pairs (P, L) counterclockwise seen from outside; edge L leads from P to the next pair's P.

    L is positive where the edge is followed from its start to its end, so that the face is on its left.
    """

    pairs: tuple[tuple[int, int], ...]

    @property
    def vertices(self) -> tuple[int, ...]:
        return tuple(vertex for vertex, _ in self.pairs)


@dataclass(frozen=True, slots=True)
class Economical:
    """The economical encoding: coordinates of the vertices, and the vertices of each face by number from 1.

    The cycles run counterclockwise seen from outside.
    """

    points: tuple[IntPoint, ...]
    faces: tuple[tuple[int, ...], ...]

    def integers(self) -> tuple[int, ...]:
        """The encoding as a row of numbers: how many vertices and faces; x, y, z of each vertex; n and n vertices of
        each face."""
        head = (len(self.points), len(self.faces))
        coordinates = (number for point in self.points for number in point)
        return (*head, *coordinates, *(number for face in self.faces for number in (len(face), *face)))


@dataclass(frozen=True, slots=True)
class CellList:
    """The redundant cell list of a polyhedron's surface."""

    vertices: tuple[Vertex, ...]
    edges: tuple[Edge, ...]
    faces: tuple[Face, ...]

    @property
    def points(self) -> tuple[IntPoint, ...]:
        """The coordinates of the vertices, in their order."""
        return tuple(vertex.point for vertex in self.vertices)

    def economical(self) -> Economical:
        """The list without what can be found again: the edges, and the edges named by vertices and faces."""
        return Economical(self.points, tuple(face.vertices for face in self.faces))

    def planes(self) -> tuple[Plane, ...]:
        """The plane of every face in lowest terms: H(x, y, z) = a x + b y + c z + d is at most 0 in the polyhedron."""
        return tuple(planes_of(self.points, [face.vertices for face in self.faces]))


def planes_of(points: Sequence[IntPoint], cycles: Sequence[Sequence[int]]) -> list[Plane]:
    """The planes of plane polygons in lowest terms, outward where a polygon is counterclockwise seen from outside.

    cycles: of each polygon its vertices, numbers of points from 1.  Vertices in line with their neighbours do no harm.
    Raises CellListError for a polygon without area.
    """
    sizes, vertex = _flat(cycles)
    low, near = _moved(points, sizes)
    normals, rest = _planes(near, sizes, vertex)
    moved = rest.astype(object) - normals.astype(object) @ np.array(low, dtype=object)
    a, b, c = normals.T.tolist()
    return list(zip(a, b, c, moved.tolist(), strict=True))


def _moved(points: Sequence[IntPoint], sizes: Numbers) -> tuple[IntPoint, Array]:
    """The least coordinates, and the points from there: in 64 bits where their planes surely fit, else Python's.

    sizes: how many vertices polygons have.
    """
    x, y, z = (min(axis) for axis in zip(*points, strict=True))
    near = [(p[0] - x, p[1] - y, p[2] - z) for p in points]
    reach = max(map(max, near))
    # A normal is a sum of vector products, each at most 2 reach^2, one for each vertex of the polygon at most; the
    # value at a point has three products with coordinates, and what makes the value 0 on the polygon as many.
    fits = 12 * int(sizes.max()) * reach**3 < 2**62
    return (x, y, z), np.array(near, dtype=np.int64 if fits else object)


def _flat(cycles: Sequence[Sequence[int]]) -> tuple[Numbers, Numbers]:
    """How long cycles are, and what is in them, one after another."""
    sizes = np.fromiter(map(len, cycles), np.int64, len(cycles))
    return sizes, np.fromiter(chain.from_iterable(cycles), np.int64, int(sizes.sum()))


def _planes(near: Array, sizes: Numbers, vertex: Numbers) -> tuple[Array, Array]:
    """Normals without common divisor, shape (n, 3), and what makes the plane's value 0 on a polygon."""
    first = np.cumsum(sizes) - sizes
    corner = near[vertex - 1]
    origin = near[vertex[first] - 1]
    arm = corner - np.repeat(origin, sizes, axis=0)
    (u1, u2, u3), (v1, v2, v3) = arm[:-1].T, arm[1:].T
    part = np.zeros_like(arm)
    part[:-1] = np.stack([u2 * v3 - u3 * v2, u3 * v1 - u1 * v3, u1 * v2 - u2 * v1], axis=1)
    # A polygon's first arm is of no length: the product of its last arm with the next polygon's first is nothing.
    normal = np.add.reduceat(part, first, axis=0)
    divisor = np.gcd(np.gcd(normal[:, 0], normal[:, 1]), normal[:, 2])
    if not divisor.all():
        raise CellListError("a face has no area")
    normal = normal // divisor[:, None]
    return normal, -(normal * origin).sum(axis=1)


def assembled(points: Sequence[IntPoint], starts: Numbers, ends: Numbers, sizes: Numbers, signed: Numbers) -> CellList:
    """A cell list from faces as cycles of signed edges.

    starts, ends: of each edge, by number of the vertex from 1.  sizes: how many edges a face has; signed: these edges,
    face after face, as ``Face.pairs`` has them.  A face's first pair becomes that of its vertex of lowest number.
    """
    edge = abs(signed) - 1
    vertex = np.where(signed > 0, starts[edge], ends[edge])
    first = np.cumsum(sizes) - sizes
    face = np.repeat(np.arange(len(sizes)), sizes)
    lowest = np.flatnonzero(vertex == np.minimum.reduceat(vertex, first)[face])
    shift = np.empty(len(sizes), np.int64)
    shift[face[lowest[::-1]]] = lowest[::-1]
    place = first[face] + (np.arange(len(face)) - 2 * first[face] + shift[face]) % sizes[face]
    pairs = list(zip(vertex[place].tolist(), signed[place].tolist(), strict=True))
    sides = np.empty((2, len(starts)), np.int64)
    sides[(signed < 0).astype(np.int64), edge] = face + 1
    number = np.arange(1, len(starts) + 1)
    at, of = np.concatenate([starts, ends]), np.concatenate([-number, number])
    order = np.lexsort((abs(of), at))
    counts = np.cumsum(np.bincount(at, minlength=len(points) + 1)).tolist()
    around = of[order].tolist()
    bounds = [*first.tolist(), len(pairs)]
    return CellList(
        tuple(Vertex(point, tuple(around[a:b])) for point, (a, b) in zip(points, pairwise(counts), strict=True)),
        tuple(map(Edge, starts.tolist(), ends.tolist(), *sides.tolist())),
        tuple(Face(tuple(pairs[a:b])) for a, b in pairwise(bounds)),
    )


def expanded(encoding: Economical) -> CellList:
    """The redundant cell list from the economical encoding.

    The edges are numbered as the faces, one after another, first come along them, and start where they are first
    left.  Raises CellListError for what is not the surface of a convex polyhedron.
    """
    points, faces = encoding.points, encoding.faces
    try:
        sizes, start = _flat(faces)
    except OverflowError:
        raise CellListError("the number of a vertex is beyond 64 bits") from None
    face = np.repeat(np.arange(len(faces)), sizes)
    _check_cycles(sizes, start, face, len(points))
    following = np.arange(1, len(start) + 1)
    last = np.cumsum(sizes) - 1
    following[last] = last + 1 - sizes
    end = start[following]
    _, first, same = np.unique(
        np.minimum(start, end) * (len(points) + 1) + np.maximum(start, end), return_index=True, return_inverse=True
    )
    forward = start == start[first][same]
    unpaired = np.bincount(same, np.where(forward, 1, -1)).astype(bool)
    if unpaired.any():
        edge = first[unpaired].min()
        raise CellListError(f"the edge from vertex {start[edge]} to {end[edge]} has a face on one side only")
    unused = np.setdiff1d(np.arange(1, len(points) + 1), start)
    if unused.size:
        raise CellListError(f"vertex {unused[0]}: no face has it")
    if 2 * len(first) != len(start) or len(points) - len(first) + len(faces) != 2:
        raise CellListError(f"{len(points)} vertices, {len(first)} edges and {len(faces)} faces make no polyhedron")
    _check_convex(points, sizes, start, face)
    first_used = np.sort(first)
    number = np.searchsorted(first_used, first)[same] + 1
    return assembled(points, start[first_used], end[first_used], sizes, np.where(forward, number, -number))


def _check_cycles(sizes: Numbers, start: Numbers, face: Numbers, count: int) -> None:
    """That faces have three vertices or more, each once, among those there are."""
    few = np.flatnonzero(sizes < 3)
    order = np.lexsort((start, face))
    twice = (face[order][1:] == face[order][:-1]) & (start[order][1:] == start[order][:-1])
    poor = np.concatenate([few, face[order][1:][twice]])
    absent = np.flatnonzero((start < 1) | (start > count))
    if poor.size and (not absent.size or poor.min() <= face[absent[0]]):
        raise CellListError(f"face {poor.min() + 1}: it has fewer than three vertices, or one of them twice")
    if absent.size:
        raise CellListError(f"face {face[absent[0]] + 1}: there is no vertex {start[absent[0]]}")


def decoded(numbers: Iterable[int]) -> Economical:
    """The economical encoding from its row of numbers.  Raises CellListError where the row ends early or late."""
    row = iter(numbers)
    vertices, faces = _taken(row, 2)
    points = [_taken(row, 3) for _ in range(vertices)]
    cycles = []
    for _ in range(faces):
        (size,) = _taken(row, 1)
        cycles.append(tuple(_taken(row, size)))
    if next(row, None) is not None:
        raise CellListError("numbers are left over after the last face")
    return Economical(tuple((x, y, z) for x, y, z in points), tuple(cycles))


def _taken(row: Iterator[int], count: int) -> list[int]:
    found = [number for _, number in zip(range(count), row, strict=False)]
    if len(found) < count or count < 0:
        raise CellListError("the row of numbers ends before its last face")
    return found


def _check_convex(points: Sequence[IntPoint], sizes: Numbers, vertex: Numbers, face: Numbers) -> None:
    """Definition CP: no vertex outside of a face's plane; and each face's vertices in its plane."""
    _, near = _moved(points, sizes)
    normals, rest = _planes(near, sizes, vertex)
    greatest = sum(int(abs(part).max()) * int(near.max()) for part in normals.T) + int(abs(rest).max())
    # Products of whole numbers whose sums are so small are whole in floats too, in any order of addition.
    kind = np.float64 if greatest < 2**53 else near.dtype
    planes = np.column_stack([normals, rest]).astype(kind)
    columns = np.array([*near.T, np.ones(len(points), np.int64)], dtype=kind)
    width = min(len(points), _BLOCK)
    height = max(1, _BLOCK // width)
    for left in range(0, len(points), width):
        block = np.ascontiguousarray(columns[:, left : left + width])
        for first in range(0, len(planes), height):
            values = planes[first : first + height] @ block
            if values.max() > 0:
                plane, place = (int(number) + 1 for number in np.argwhere(values > 0)[0])
                raise CellListError(f"face {first + plane}: vertex {left + place} lies outside of its plane")
    apart = np.flatnonzero((normals[face] * near[vertex - 1]).sum(axis=1) + rest[face])
    if apart.size:
        raise CellListError(f"face {face[apart[0]] + 1}: its vertices do not lie in one plane")
