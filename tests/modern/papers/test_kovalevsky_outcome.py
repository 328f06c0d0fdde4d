"""The cell list of the hull alone, from the digital polytope, against the paper's procedure and the judge."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from modern.digital.solids import Volume, VolumeError, ball, half_ball
from modern.exact_hull import exact_hull
from modern.papers.kovalevsky_schulz import (
    CENTRES,
    INVISIBLE,
    RASTER,
    SHUFFLED,
    VERTICES,
    VISIBLE,
    CellList,
    Coplanar,
    Flat,
    Of,
    expanded,
    hull_cells,
    voxel_hull,
)

SIZES = st.tuples(*[st.integers(1, 7)] * 3)
VOLUMES = SIZES.flatmap(lambda shape: arrays.arrays(np.bool_, shape)).filter(lambda array: bool(array.any()))
PLACES = st.sampled_from([CENTRES, VERTICES])
NEIGHBOURS = st.sampled_from([6, 26])
LAYER = np.indices((7, 7, 7)).sum(axis=0) == 9
SOLIDS = [
    *(ball(diameter, centre) for diameter in (2, 3, 9, 20, 32, 47) for centre in ("voxel", "vertex")),
    *map(half_ball, (8, 15, 22)),
    Volume(np.ones((5, 4, 3), dtype=np.bool_), (10**15, 0, -7), "box"),
    Volume(LAYER, (-2, 0, 5), "slanted layer"),
    Volume(LAYER[:, :, ::-1] | LAYER, (0, 0, 0), "two slanted layers"),
    Volume(np.ones((1, 6, 4), dtype=np.bool_), (0, 0, 0), "sheet"),
    Volume(np.ones((1, 1, 9), dtype=np.bool_), (0, 0, 0), "rod"),
    Volume(np.eye(5, dtype=np.bool_)[:, :, None], (0, 0, 0), "diagonal"),
]


def same(one: CellList | Flat, other: CellList | Flat) -> bool:
    """The same vertices in the same order, and the same faces as cycles of them; or the same flat hull."""
    if isinstance(one, Flat) or isinstance(other, Flat):
        return one == other
    faces = [sorted(face.vertices for face in cells.faces) for cells in (one, other)]
    return one.points == other.points and faces[0] == faces[1]


def routes(volume: Volume, of: Of, neighbours: int, coplanar: Coplanar = VISIBLE) -> tuple[CellList | Flat, ...]:
    """The cell list without an order, and by the procedure in raster order, edges in one line merged."""
    surfaces = [voxel_hull(volume, of, neighbours, *way).surface for way in ((), (coplanar, RASTER))]
    return tuple(surface if isinstance(surface, Flat) else surface.straight for surface in surfaces)


@given(VOLUMES, PLACES, NEIGHBOURS, st.sampled_from([VISIBLE, INVISIBLE]))
def test_any_voxels_have_the_cell_list_of_the_procedure(
    array: np.ndarray, of: Of, neighbours: int, coplanar: Coplanar
) -> None:
    assert same(*routes(Volume(array, (3, -8, 1)), of, neighbours, coplanar))


@given(VOLUMES, PLACES, NEIGHBOURS)
def test_in_raster_order_with_coplanar_faces_visible_no_vertex_is_in_line(
    array: np.ndarray, of: Of, neighbours: int
) -> None:
    """So that merged faces are those of the hull without more ado, whichever neighbours are tested."""
    volume = Volume(array, (0, 0, 0))
    surface, alone = voxel_hull(volume, of, neighbours, order=RASTER).surface, voxel_hull(volume, of).surface
    if isinstance(surface, Flat) or isinstance(alone, Flat):
        assert surface == alone
    else:
        assert same(surface.faces, alone.faces)
        assert len(surface.triangles.faces) == 2 * len(surface.faces.vertices) - 4


@pytest.mark.parametrize("of", [CENTRES, VERTICES])
@pytest.mark.parametrize("volume", SOLIDS, ids=lambda v: v.source)
def test_named_solids(volume: Volume, of: Of) -> None:
    for neighbours in (6, 26):
        assert same(*routes(volume, of, neighbours))
    shuffled = voxel_hull(volume, of, order=SHUFFLED)
    if not isinstance(shuffled.surface, Flat):
        straight, alone = shuffled.surface.straight, voxel_hull(volume, of).polyhedron.faces
        assert sorted(straight.points) == sorted(alone.points)  # numbered as inserted
        assert set(straight.planes()) == set(alone.planes())
        assert shuffled.measures() == voxel_hull(volume, of).measures()


def test_the_comparison_can_fail() -> None:
    one, other = (voxel_hull(ball(diameter)).polyhedron.faces for diameter in (8, 9))
    assert not same(one, other)
    less = hull_cells(voxel_hull(ball(9)).inserted[1:])
    assert not same(other, less)


@pytest.mark.parametrize("volume", [ball(12), half_ball(9)], ids=lambda v: v.source)
def test_faces_are_in_the_order_of_their_vertices_and_all_of_the_judge(volume: Volume) -> None:
    hull = voxel_hull(volume)
    cells, judge = hull.polyhedron.faces, exact_hull(hull.inserted)
    assert [face.vertices for face in cells.faces] == sorted(face.vertices for face in cells.faces)
    assert set(cells.planes()) == {facet.plane for facet in judge.facets}
    assert set(cells.points) == {judge.scaled[index] for index in judge.vertices}
    assert list(cells.points) == sorted(cells.points, key=lambda p: p[::-1])
    assert cells == expanded(cells.economical())


def test_without_an_order_there_are_no_triangles() -> None:
    hull = voxel_hull(half_ball(8))
    assert (hull.order, hull.polyhedron.made) == (None, None)
    with pytest.raises(VolumeError, match="state an order, such as raster"):
        _ = hull.polyhedron.triangles
    for choice in ({"order": RASTER}, {"coplanar": VISIBLE}):
        inserted = voxel_hull(half_ball(8), **choice)  # type: ignore[arg-type]
        assert inserted.order == RASTER
        assert len(inserted.polyhedron.triangles.faces) == 2 * len(inserted.polyhedron.faces.vertices) - 4
    with pytest.raises(ValueError, match="raster or shuffled, not 'sorted'"):
        voxel_hull(ball(4), order="sorted")  # type: ignore[arg-type]
