"""Kovalevsky and Schulz: local corners, the incremental polyhedron and reconstruction compared with the exact hull."""

from itertools import pairwise, product
from unittest.mock import patch

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from numpy.typing import NDArray

from modern.digital.hull import digital_hull
from modern.digital.solids import Volume, VolumeError, ball, half_ball
from modern.exact_hull import ExactHull, exact_hull
from modern.geometry.vectors import independent
from modern.papers import kovalevsky_schulz as ks
from modern.papers.kovalevsky_schulz import corners
from modern.papers.kovalevsky_schulz.corners import Of, corners_by_neighbours, places
from modern.papers.kovalevsky_schulz.polyhedron import CurrentPolyhedron, Waiting

FEW = settings(max_examples=40)
PLACES = (ks.CENTRES, ks.VERTICES)
WAYS = [(6, ks.VISIBLE), (6, ks.INVISIBLE), (26, ks.VISIBLE), (26, ks.INVISIBLE), (26, None)]
SIZES = st.tuples(*[st.integers(1, 6)] * 3)
VOLUMES = SIZES.flatmap(lambda shape: arrays.arrays(np.bool_, shape)).filter(lambda array: bool(array.any()))


def judged(volume: Volume, of: str) -> ExactHull:
    """Return the exact hull of all voxels, or of all their corners."""
    voxels = volume.coordinates()
    if of == ks.CENTRES:
        return exact_hull(voxels)
    corners = {tuple(voxel + step) for voxel in voxels for step in np.array(list(product((0, 1), repeat=3)))}
    return exact_hull(np.array(sorted(corners)))


def agrees(volume: Volume, of: str, neighbours: int, coplanar: str | None) -> bool:
    """Return True if the paper's method gives the dimension, vertices, planes and polygons of the exact hull."""
    surface, judge = ks.voxel_hull(volume, of, neighbours, coplanar).surface, judged(volume, of)
    vertices = {judge.scaled[index] for index in judge.vertices}
    if isinstance(surface, ks.Flat):
        return surface.dimension == judge.dimension and set(surface.vertices) == vertices
    hull = surface.straight
    faces = {
        plane: _from_lowest([hull.points[number - 1] for number in face.vertices])
        for plane, face in zip(hull.planes(), hull.faces, strict=True)
    }
    expected = {facet.plane: _from_lowest([judge.scaled[index] for index in facet.polygon]) for facet in judge.facets}
    return judge.dimension == 3 and set(hull.points) == vertices and faces == expected


def _from_lowest(polygon: list[tuple[int, ...]]) -> list[tuple[int, ...]]:
    first = polygon.index(min(polygon))
    return polygon[first:] + polygon[:first]


@given(VOLUMES, st.sampled_from(PLACES), st.sampled_from(WAYS))
def test_any_set_of_voxels_has_the_exact_hull(array: np.ndarray, of: str, way: tuple[int, str | None]) -> None:
    assert agrees(Volume(array, (-3, 0, 5)), of, *way)


def is_corner(array: np.ndarray, at: tuple[int, ...], neighbours: int) -> bool:
    """Apply the definition of section 2 to one grid point."""

    def has(point: tuple[int, ...]) -> bool:
        return all(0 <= c < size for c, size in zip(point, array.shape, strict=True)) and bool(array[point])

    steps = [s for s in product((-1, 0, 1), repeat=3) if any(s) and (neighbours == 26 or sum(map(abs, s)) == 1)]
    assert len(steps) == neighbours
    return has(at) and not any(
        has(tuple(c + s for c, s in zip(at, step, strict=True)))
        and has(tuple(c - s for c, s in zip(at, step, strict=True)))
        for step in steps
    )


@FEW
@given(VOLUMES, st.sampled_from([6, 26]))
def test_local_corners_agree_with_the_definition(array: np.ndarray, neighbours: int) -> None:
    mask = corner_mask(Volume(array, (2, -5, 0)), ks.CENTRES, neighbours)
    for at in np.ndindex(array.shape):
        assert mask[at] == is_corner(array, at, neighbours)


def corner_mask(volume: Volume, of: Of, neighbours: int) -> NDArray[np.bool_]:
    """Return which grid points of a volume are local corners."""
    mask = np.zeros_like(places(volume, of))
    mask[tuple((ks.local_corners(volume, of, neighbours) - volume.origin).T)] = True
    return mask


@FEW
@given(VOLUMES, st.permutations(range(3)), st.integers(1, 40), st.sampled_from(PLACES))
def test_local_corners_do_not_depend_on_slabs_and_memory_order(array, axes, slab, of) -> None:
    """Local corners among the corners of voxels are those of the volume with a voxel for each corner."""
    transposed = array.transpose(axes)
    whole = Volume(places(Volume(transposed.copy(), (0, 0, 0)), of), (0, 0, 0))
    with patch.object(corners, "_SLAB", slab):
        by_neighbours = corners_by_neighbours(Volume(transposed, (0, 0, 0)), of)
    for neighbours, points in by_neighbours.items():
        assert np.array_equal(points, ks.local_corners(whole, ks.CENTRES, neighbours))


def test_corners_and_flat_polygons_are_in_order() -> None:
    points = ks.local_corners(half_ball(8), ks.VERTICES, 6).tolist()
    assert points == sorted(points, key=lambda p: p[::-1])
    assert len(points) == 48
    hull = ks.voxel_hull(Volume(np.ones((3, 1, 3), dtype=np.bool_), (0, 0, 0)), ks.CENTRES)
    assert isinstance(hull.surface, ks.Flat)
    steps = [abs(p[0] - q[0]) + abs(p[2] - q[2]) for p, q in pairwise(hull.surface.vertices)]
    assert steps == [2, 2, 2]


def polyhedron(points: object, coplanar: str = ks.VISIBLE) -> ks.CellList:
    cells = ks.convex_polyhedron(points, coplanar)
    assert isinstance(cells, ks.CellList)
    return cells


@given(
    st.lists(st.tuples(*[st.integers(-2, 2)] * 3), min_size=1, max_size=30), st.sampled_from([ks.VISIBLE, ks.INVISIBLE])
)
def test_any_points_with_duplicates_have_the_exact_hull(points: list[tuple[int, int, int]], coplanar: str) -> None:
    judge = exact_hull(points)
    cells = ks.convex_polyhedron(points, coplanar)
    if isinstance(cells, ks.Flat):
        assert cells.dimension == judge.dimension < 3
        assert set(cells.vertices) == {judge.scaled[index] for index in judge.vertices}
    else:
        assert set(ks.merged(cells).planes()) == {facet.plane for facet in judge.facets}
        assert all(len(face.pairs) == 3 for face in cells.faces)


def test_large_coordinates_are_exact() -> None:
    """Values beyond 64 bits are Python's integers, and one unit still decides, in raster order and in another order."""
    far = 10**9
    corners = [(0, 0, 0), (far, 0, 0), (0, far, 0), (0, 0, far)]
    for height, count in ((far // 4, 4), (far // 4 + 1, 5)):
        points = [*corners, (far // 2, far // 4, height)]
        for order in (points, sorted(points, key=lambda p: p[::-1])):
            cells = polyhedron(order, ks.INVISIBLE)
            assert set(ks.straightened(ks.merged(cells)).points) == set(points[:count])
    assert len(polyhedron([*corners, (far // 2, far // 4, far // 4)], ks.INVISIBLE).points) == 4


def test_values_fit_64_bits_at_the_bound() -> None:
    extent = int((2**63 / 24) ** (1 / 3)) - 1
    corners = [(extent * x, extent * y, extent * z) for x, y, z in product((0, 1), repeat=3)]
    many = [*corners, *((extent // 2 + k, extent // 3, extent // 5 + k) for k in range(100))]
    for excess, fits in ((0, True), (9, False)):
        points = [(x + excess * (x > 0), y, z) for x, y, z in many]
        current = CurrentPolyhedron(points, independent(points), ks.INVISIBLE)
        waiting = Waiting(current, range(4, len(points)))
        assert (waiting.array is not None) == fits
        for number, (x, y, z) in enumerate(points[4:], 4):
            values = {f: a * x + b * y + c * z + d for f, (_, _, _, a, b, c, d) in current.faces.items()}
            assert (number in waiting.face) == (max(values.values()) > 0)
            assert number not in waiting.face or values[waiting.face[number]] > 0


@FEW
@given(VOLUMES)
def test_reconstruction_gives_the_filled_hull(array: np.ndarray) -> None:
    """An object is thus reconstructed exactly, from either hull, if and only if it is digitally convex."""
    volume = Volume(array, (4, -7, 2))
    filled = digital_hull(volume)
    expected = Volume(filled.filled, volume.origin).coordinates().tolist()
    for of in PLACES:
        hull = ks.voxel_hull(volume, of)
        if isinstance(hull.surface, ks.Flat):
            assert filled.dimension < 3
            continue
        actual = ks.reconstructed(hull.surface.straight.economical(), of)
        assert actual.coordinates().tolist() == expected
        assert (actual.count == volume.count) == bool((filled.filled == array).all())


@pytest.mark.parametrize("of", PLACES)
@pytest.mark.parametrize("volume", [ball(16), ball(9), ball(10, "vertex"), half_ball(12)], ids=lambda v: v.source)
def test_a_convex_object_is_reconstructed_exactly(volume: Volume, of: str) -> None:
    hull = ks.voxel_hull(volume, of, 6, ks.INVISIBLE).polyhedron
    for cells in (hull.triangles, hull.faces, hull.straight):
        assert ks.reconstructed(cells.economical(), of).coordinates().tolist() == volume.coordinates().tolist()


def test_a_hull_without_voxels_or_with_too_many_is_rejected() -> None:
    thin = polyhedron([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]).economical()
    assert ks.reconstructed(thin, ks.CENTRES).count == 4
    with pytest.raises(VolumeError, match="contains no whole voxel"):
        ks.reconstructed(thin, ks.VERTICES)
    wide = polyhedron([(0, 0, 0), (9999, 0, 0), (0, 9999, 0), (0, 0, 9999)]).economical()
    with pytest.raises(VolumeError, match="a box of 10000 x 10000 x 10000 voxels"):
        ks.reconstructed(wide, ks.CENTRES)


def test_arrays_are_volumes_and_hulls_without_polyhedra_are_rejected() -> None:
    with pytest.raises(VolumeError, match="rod: expected a hull in space, found a segment, which has no cell list"):
        _ = ks.voxel_hull(Volume(np.ones((1, 1, 5), dtype=np.bool_), (0, 0, 0), "rod"), ks.CENTRES).polyhedron
    array = half_ball(8).array
    assert ks.voxel_hull(array).polyhedron.faces == ks.voxel_hull(Volume(array, (0, 0, 0))).polyhedron.faces
    with pytest.raises(VolumeError, match="expected an array of truth values"):
        ks.voxel_hull(np.ones((2, 2, 2)))
    with pytest.raises(VolumeError, match="volume: there are no voxels"):
        ks.voxel_hull(np.zeros((2, 2, 2), dtype=np.bool_))
    with pytest.raises(VolumeError, match="expected a volume of three dimensions, found two"):
        ks.voxel_hull(Volume(np.ones((2, 2), dtype=np.bool_), (0, 0)))
    with pytest.raises(ValueError, match="no points"):
        ks.convex_polyhedron([])


@pytest.mark.parametrize(
    "options", [{"of": "edges"}, {"neighbours": 18}, {"coplanar": "perhaps"}, {"order": "perhaps"}]
)
def test_unknown_options_are_rejected(options: dict[str, object]) -> None:
    with pytest.raises((ValueError, KeyError)):
        ks.voxel_hull(ball(4), **options)
