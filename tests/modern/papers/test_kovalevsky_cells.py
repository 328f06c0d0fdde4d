"""The cell list: its conventions (Tables 1 to 3), merging, and the conversion to and from the economical encoding."""

from collections import Counter
from dataclasses import replace
from unittest.mock import patch

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from modern.papers import kovalevsky_schulz as ks
from modern.papers.kovalevsky_schulz import cells as cells_module
from modern.papers.kovalevsky_schulz.cells import all_rows, economical_size, planes_of

POINTS = st.lists(st.tuples(*[st.integers(-3, 3)] * 3), min_size=4, max_size=40)
COPLANAR = st.sampled_from([ks.VISIBLE, ks.INVISIBLE])
CUBE = ks.Economical(
    tuple((x, y, z) for z in (0, 2) for y in (0, 2) for x in (0, 2)),
    ((1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (2, 4, 8, 6), (3, 7, 8, 4), (1, 5, 7, 3)),
)


def states(points: list[tuple[int, int, int]], coplanar: str) -> list[ks.CellList]:
    """Return the cell list of triangles, the merged and the straightened one, or none for points in one plane."""
    cells = ks.convex_polyhedron(points, coplanar)
    return [] if isinstance(cells, ks.Flat) else [cells, ks.merged(cells), ks.straightened(ks.merged(cells))]


@settings(max_examples=50)
@given(POINTS, COPLANAR)
def test_the_three_sublists_agree(points: list[tuple[int, int, int]], coplanar: str) -> None:
    for cells in states(points, coplanar):
        around: list[list[int]] = [[] for _ in cells.vertices]
        for number, edge in enumerate(cells.edges, 1):
            around[edge.start - 1].append(-number)
            around[edge.end - 1].append(number)
            left, right = (dict(map(reversed, cells.faces[f - 1].pairs)) for f in (edge.left, edge.right))
            assert left[number] == edge.start
            assert right[-number] == edge.end
        assert [list(vertex.edges) for vertex in cells.vertices] == around
        for face in cells.faces:
            assert face.pairs[0][0] == min(face.vertices)
            for (here, signed), (there, _) in zip(face.pairs, face.pairs[1:] + face.pairs[:1], strict=True):
                edge = cells.edges[abs(signed) - 1]
                assert (here, there) == ((edge.start, edge.end) if signed > 0 else (edge.end, edge.start))
        assert len(cells.vertices) - len(cells.edges) + len(cells.faces) == 2


@settings(max_examples=50)
@given(POINTS, COPLANAR)
def test_merging_gives_maximal_faces_and_straightening_removes_vertices_in_line(points, coplanar) -> None:
    lists = states(points, coplanar)
    if not lists:
        return
    triangles, faces, straight = lists
    assert set(triangles.planes()) == set(faces.planes()) == set(straight.planes())
    assert max(Counter(faces.planes()).values()) == 1
    assert len(straight.edges) == len(straight.vertices) + len(straight.faces) - 2
    assert all(len(vertex.edges) >= 3 for vertex in straight.vertices)
    assert set(straight.points) <= set(faces.points) <= set(triangles.points) <= set(points)
    on_edges = len(faces.vertices) - len(straight.vertices)
    assert len(faces.edges) - len(straight.edges) == on_edges


def test_merging_keeps_a_vertex_on_an_edge_and_drops_one_within_a_face() -> None:
    square = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0), (2, 2, 4)]
    cells = ks.convex_polyhedron([(1, 1, 0), (2, 0, 0), *square], ks.INVISIBLE)
    assert isinstance(cells, ks.CellList)
    assert {(1, 1, 0), (2, 0, 0)} <= set(cells.points)
    assert set(ks.merged(cells).points) == {(2, 0, 0), *square}
    assert set(ks.straightened(ks.merged(cells)).points) == set(square)


@settings(max_examples=50)
@given(POINTS, COPLANAR)
def test_the_economical_encoding_preserves_the_cell_list(points: list[tuple[int, int, int]], coplanar: str) -> None:
    for cells in states(points, coplanar):
        encoding = cells.economical()
        assert ks.expanded(encoding).economical() == encoding
        assert len(encoding.integers()) == economical_size(cells) + 2 + len(cells.faces)


def test_cubes_are_expanded_and_vertices_in_line_have_planes() -> None:
    cells = ks.expanded(CUBE)
    assert cells.economical() == CUBE
    assert cells.planes() == ((0, 0, -1, 0), (0, 0, 1, -2), (0, -1, 0, 0), (1, 0, 0, -2), (0, 1, 0, -2), (-1, 0, 0, 0))
    assert len(list(all_rows(cells))) == 3 + 8 + 12 + 6
    polygon = [(0, 0, 5), (2, 0, 5), (4, 0, 5), (4, 4, 5), (0, 4, 5)]
    assert planes_of(polygon, [range(1, 6), (5, 4, 2, 1)]) == [(0, 0, 1, -5), (0, 0, -1, 5)]
    with pytest.raises(ks.CellListError, match="no area"):
        planes_of([*polygon, (1, 1, 1), (2, 2, 2), (3, 3, 3)], [range(1, 6), (6, 7, 8)])


# Two octahedra in the same place that have only the vertices 1 and 2 in common: Euler's formula holds.
OCTAHEDRA_ON_ONE_AXIS = ks.Economical(
    ((0, 0, 1), (0, 0, -1), *2 * ((1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0))),
    tuple(
        face
        for base in (3, 7)
        for k in range(4)
        for face in ((1, base + k, base + (k + 1) % 4), (2, base + (k + 1) % 4, base + k))
    ),
)


def faces(*cycles: tuple[int, ...]) -> ks.Economical:
    return replace(CUBE, faces=cycles)


@pytest.mark.parametrize(
    ("encoding", "message"),
    [
        (faces((1, 3), *CUBE.faces[1:]), "face 1 has fewer than three vertices"),
        (faces((1, 3, 1, 2), *CUBE.faces[1:]), "face 1 has fewer than three vertices, or names a vertex twice"),
        (faces((1, 3, 4, 9), *CUBE.faces[1:]), "face 1: vertex 9 does not exist"),
        (faces((0, 3, 4, 2), *CUBE.faces[1:]), "face 1: vertex 0 does not exist"),
        (faces(*CUBE.faces[1:]), "has a face on only one of its sides"),
        (faces((1, 2, 4, 3), *CUBE.faces[1:]), "has a face on only one of its sides"),
        (replace(CUBE, points=(*CUBE.points, (1, 1, 1))), "vertex 9 belongs to no face"),
        (
            ks.Economical(
                (*CUBE.points, *((x + 9, y, z) for x, y, z in CUBE.points)),
                (*CUBE.faces, *(tuple(number + 8 for number in face) for face in CUBE.faces)),
            ),
            "16 vertices, 24 edges and 12 faces form no polyhedron",
        ),
        (replace(CUBE, points=((0, 0, -1), *CUBE.points[1:])), "face 1: its vertices do not lie in one plane"),
        (replace(CUBE, points=((1, 1, 1), *CUBE.points[1:])), "face 1: vertex 2 lies outside of its plane"),
        (faces(*(face[::-1] for face in CUBE.faces)), "lies outside of its plane"),
        (
            ks.Economical(((0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 1, 0)), ((1, 2, 3), (1, 4, 2), (2, 4, 3), (1, 3, 4))),
            "a face has no area",
        ),
        (ks.Economical(((0, 0, 0), (1, 0, 0), (0, 1, 0)), ((1, 2, 3), (1, 3, 2))), "all vertices lie in one plane"),
        (OCTAHEDRA_ON_ONE_AXIS, "vertices 3 and 7 are the same point"),
    ],
)
def test_encodings_of_no_convex_surface_are_rejected(encoding: ks.Economical, message: str) -> None:
    with pytest.raises(ks.CellListError) as caught:
        ks.expanded(encoding)
    assert message in str(caught.value)


def test_a_vertex_one_unit_outside_of_a_large_hull_is_detected() -> None:
    """The values are floats, 64-bit integers or Python's integers, and the planes are tested block by block."""
    for far in (2, 10**4, 10**6, 10**12):
        points = tuple((x * far // 2, y * far // 2, z * far // 2) for x, y, z in CUBE.points)
        assert ks.expanded(replace(CUBE, points=points)).points == points
        triangles = ((1, 3, 4), (1, 4, 2), *CUBE.faces[1:])
        lowered = ((0, 0, 1), *points[1:])
        with (
            pytest.raises(ks.CellListError, match="lies outside of its plane"),
            patch.object(cells_module, "_BLOCK", 3),
        ):
            ks.expanded(ks.Economical(lowered, triangles))
