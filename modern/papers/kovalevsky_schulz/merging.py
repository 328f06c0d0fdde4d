"""Merging: triangles of one plane to one face, and edges in one line to one edge (section 2, Figs. 6 and 7)."""

from __future__ import annotations

from modern.papers.kovalevsky_schulz.cells import CellList, Economical, Plane, expanded


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

    Of merged faces these lie straight between their neighbours, for three faces meet in a vertex of the hull.
    """
    dropped = {number for number, vertex in enumerate(cells.vertices, 1) if len(vertex.edges) == 2}
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
