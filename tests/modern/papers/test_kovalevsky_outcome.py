"""Compare the cell list that is computed without inserting points with that of the paper's procedure."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from modern.digital.solids import Volume, VolumeError, ball, half_ball
from modern.exact_hull import exact_hull
from modern.papers import kovalevsky_schulz as ks

SIZES = st.tuples(*[st.integers(1, 7)] * 3)
VOLUMES = SIZES.flatmap(lambda shape: arrays.arrays(np.bool_, shape)).filter(lambda array: bool(array.any()))
PLACES = st.sampled_from([ks.CENTRES, ks.VERTICES])
NEIGHBOURS = st.sampled_from([6, 26])
LAYER = np.indices((7, 7, 7)).sum(axis=0) == 9
SOLIDS = [
    *(ball(diameter, centre) for diameter in (2, 3, 9, 20) for centre in ("voxel", "vertex")),
    *map(half_ball, (8, 15, 22)),
    Volume(np.ones((5, 4, 3), dtype=np.bool_), (10**15, 0, -7), "box"),
    Volume(LAYER, (-2, 0, 5), "slanted layer"),
    Volume(LAYER[:, :, ::-1] | LAYER, (0, 0, 0), "two slanted layers"),
    Volume(np.ones((1, 6, 4), dtype=np.bool_), (0, 0, 0), "sheet"),
    Volume(np.ones((1, 1, 9), dtype=np.bool_), (0, 0, 0), "rod"),
    Volume(np.eye(5, dtype=np.bool_)[:, :, None], (0, 0, 0), "diagonal"),
]


def same(a: ks.CellList | ks.Flat, b: ks.CellList | ks.Flat) -> bool:
    """Return True if both have the same vertices in the same order and the same faces, or are the same flat hull."""
    if isinstance(a, ks.Flat) or isinstance(b, ks.Flat):
        return a == b
    faces = [sorted(face.vertices for face in cells.faces) for cells in (a, b)]
    return a.points == b.points and faces[0] == faces[1]


def direct_and_inserted(
    volume: Volume, of: ks.Of, neighbours: int, coplanar: ks.Coplanar = ks.VISIBLE
) -> tuple[ks.CellList | ks.Flat, ...]:
    """Return the cell list computed directly, and that of the procedure in raster order with straight edges merged."""
    surfaces = [ks.voxel_hull(volume, of, neighbours, *options).surface for options in ((), (coplanar, ks.RASTER))]
    return tuple(surface if isinstance(surface, ks.Flat) else surface.straight for surface in surfaces)


@settings(max_examples=50)
@given(VOLUMES, PLACES, NEIGHBOURS, st.sampled_from([ks.VISIBLE, ks.INVISIBLE]))
def test_any_voxels_have_the_cell_list_of_the_procedure(array, of, neighbours, coplanar) -> None:
    assert same(*direct_and_inserted(Volume(array, (3, -8, 1)), of, neighbours, coplanar))


@settings(max_examples=50)
@given(VOLUMES, PLACES, NEIGHBOURS)
def test_in_raster_order_with_coplanar_faces_visible_no_vertex_is_in_line(array, of, neighbours) -> None:
    """The merged faces are therefore those of the hull without straightening, for 6 and for 26 neighbours."""
    volume = Volume(array, (0, 0, 0))
    surface, direct = ks.voxel_hull(volume, of, neighbours, order=ks.RASTER).surface, ks.voxel_hull(volume, of).surface
    if isinstance(surface, ks.Flat) or isinstance(direct, ks.Flat):
        assert surface == direct
    else:
        assert same(surface.faces, direct.faces)
        assert len(surface.triangles.faces) == 2 * len(surface.faces.vertices) - 4


@pytest.mark.parametrize("of", [ks.CENTRES, ks.VERTICES])
@pytest.mark.parametrize("volume", SOLIDS, ids=lambda v: v.source)
def test_named_solids_have_the_cell_list_of_the_procedure(volume: Volume, of: ks.Of) -> None:
    for neighbours in (6, 26):
        assert same(*direct_and_inserted(volume, of, neighbours))
    shuffled = ks.voxel_hull(volume, of, order=ks.SHUFFLED)
    if not isinstance(shuffled.surface, ks.Flat):
        straight, direct = shuffled.surface.straight, ks.voxel_hull(volume, of).polyhedron.faces
        assert sorted(straight.points) == sorted(direct.points)  # numbered in the order of insertion
        assert set(straight.planes()) == set(direct.planes())
        assert shuffled.measures() == ks.voxel_hull(volume, of).measures()


def test_without_its_first_local_corner_a_ball_has_another_cell_list() -> None:
    hull = ks.voxel_hull(ball(9))
    assert not same(hull.polyhedron.faces, ks.hull_cells(hull.inserted[1:]))


@pytest.mark.parametrize("volume", [ball(12), half_ball(9)], ids=lambda v: v.source)
def test_faces_are_sorted_and_those_of_the_exact_hull(volume: Volume) -> None:
    hull = ks.voxel_hull(volume)
    cells, judge = hull.polyhedron.faces, exact_hull(hull.inserted)
    assert [face.vertices for face in cells.faces] == sorted(face.vertices for face in cells.faces)
    assert set(cells.planes()) == {facet.plane for facet in judge.facets}
    assert set(cells.points) == {judge.scaled[index] for index in judge.vertices}
    assert list(cells.points) == sorted(cells.points, key=lambda p: p[::-1])
    assert cells == ks.expanded(cells.economical())


def test_without_an_order_there_are_no_triangles() -> None:
    hull = ks.voxel_hull(half_ball(8))
    assert (hull.order, hull.polyhedron.triangulation) == (None, None)
    with pytest.raises(VolumeError, match="inserted one by one, as with order='raster'"):
        _ = hull.polyhedron.triangles
    for choice in ({"order": ks.RASTER}, {"coplanar": ks.VISIBLE}):
        inserted = ks.voxel_hull(half_ball(8), **choice)
        assert inserted.order == ks.RASTER
        assert len(inserted.polyhedron.triangles.faces) == 2 * len(inserted.polyhedron.faces.vertices) - 4
    with pytest.raises(ValueError, match="raster or shuffled as the order of insertion, found 'sorted'"):
        ks.voxel_hull(ball(4), order="sorted")
