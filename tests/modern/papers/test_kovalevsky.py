"""Kovalevsky and Schulz: local corners, the incremental polyhedron against the exact judge, symmetry, flat input."""

from __future__ import annotations

import random
from itertools import pairwise, permutations, product
from unittest.mock import patch

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from numpy.typing import NDArray

from modern.digital.hull import digital_hull
from modern.digital.volumes import Volume, VolumeError, ball, half_ball
from modern.exact_hull import ExactHull, exact_hull
from modern.papers.kovalevsky_schulz import (
    CENTRES,
    INVISIBLE,
    VERTICES,
    VISIBLE,
    CellList,
    Flat,
    convex_polyhedron,
    corners,
    local_corners,
    merged,
    reconstructed,
    straightened,
    voxel_hull,
)
from modern.papers.kovalevsky_schulz.corners import Of, corners_by_neighbours, places
from modern.papers.kovalevsky_schulz.polyhedron import CurrentPolyhedron, Waiting, independent

PLACES = (CENTRES, VERTICES)
WAYS = [(6, VISIBLE), (6, INVISIBLE), (26, VISIBLE), (26, INVISIBLE), (26, None)]
SIZES = st.tuples(*[st.integers(1, 6)] * 3)
VOLUMES = SIZES.flatmap(lambda shape: arrays.arrays(np.bool_, shape)).filter(lambda array: bool(array.any()))


def random_solid(source: random.Random, side: int = 8) -> Volume:
    """A 6-connected solid grown in a box of ``side`` cubed voxels; now and then flat, or a rod."""
    box = [source.choice((1, *[side] * 15)) for _ in range(3)]
    wanted = source.randint(1, max(1, box[0] * box[1] * box[2] // source.choice((2, 4, 8))))
    here = tuple(source.randrange(size) for size in box)
    found, border = {here}, [here]
    while len(found) < wanted and border:
        at = source.choice(border)
        ways = [
            voxel
            for axis, step in product(range(3), (-1, 1))
            if (voxel := tuple(c + step * (k == axis) for k, c in enumerate(at))) not in found
            and 0 <= voxel[axis] < box[axis]
        ]
        if not ways:
            border.remove(at)
            continue
        found.add(source.choice(ways))
        border = [*border, *(voxel for voxel in ways if voxel in found)]
    array = np.zeros(box, dtype=np.bool_)
    array[tuple(np.array(sorted(found)).T)] = True
    return Volume(array, tuple(source.randint(-9, 9) for _ in range(3)))


def judged(volume: Volume, of: str) -> ExactHull:
    """The exact hull of all voxels, or of all their corners."""
    voxels = volume.coordinates()
    if of == CENTRES:
        return exact_hull(voxels)
    corners = {tuple(voxel + step) for voxel in voxels for step in np.array(list(product((0, 1), repeat=3)))}
    return exact_hull(np.array(sorted(corners)))


def agrees(volume: Volume, of: str, neighbours: int, coplanar: str | None) -> bool:
    """Whether the paper's route has the judge's dimension, vertices, planes and polygons."""
    surface, judge = voxel_hull(volume, of, neighbours, coplanar).surface, judged(volume, of)
    vertices = {judge.scaled[index] for index in judge.vertices}
    if isinstance(surface, Flat):
        return surface.dimension == judge.dimension and set(surface.vertices) == vertices
    hull = surface.straight
    faces = {
        plane: _turned([hull.points[number - 1] for number in face.vertices])
        for plane, face in zip(hull.planes(), hull.faces, strict=True)
    }
    wanted = {facet.plane: _turned([judge.scaled[index] for index in facet.polygon]) for facet in judge.facets}
    return judge.dimension == 3 and set(hull.points) == vertices and faces == wanted


def _turned(polygon: list[tuple[int, ...]]) -> list[tuple[int, ...]]:
    first = polygon.index(min(polygon))
    return polygon[first:] + polygon[:first]


@pytest.mark.parametrize("seed", range(20))
def test_random_solids_have_the_hull_of_the_judge(seed: int) -> None:
    volume = random_solid(random.Random(seed), side=6)
    for of, (neighbours, coplanar) in product(PLACES, WAYS):
        assert agrees(volume, of, neighbours, coplanar), (of, neighbours, coplanar)


@given(VOLUMES, st.sampled_from(PLACES), st.sampled_from(WAYS))
def test_any_set_of_voxels_has_the_hull_of_the_judge(array: np.ndarray, of: str, way: tuple[int, str | None]) -> None:
    assert agrees(Volume(array, (-3, 0, 5)), of, *way)


def test_the_comparison_with_the_judge_can_fail() -> None:
    """Of a cube without one of its voxels the local corners change, and the hull does."""
    cube = Volume(np.ones((3, 3, 3), dtype=np.bool_), (0, 0, 0))
    less = Volume(cube.array.copy(), (0, 0, 0))
    less.array[0, 0, 0] = False
    hull, judge = voxel_hull(less).polyhedron.straight, judged(cube, VERTICES)
    assert set(hull.planes()) != {facet.plane for facet in judge.facets}


def is_corner(array: np.ndarray, at: tuple[int, ...], neighbours: int) -> bool:
    """Section 2, place by place."""

    def has(place: tuple[int, ...]) -> bool:
        return all(0 <= c < size for c, size in zip(place, array.shape, strict=True)) and bool(array[place])

    steps = [s for s in product((-1, 0, 1), repeat=3) if any(s) and (neighbours == 26 or sum(map(abs, s)) == 1)]
    assert len(steps) == neighbours
    return has(at) and not any(
        has(tuple(c + s for c, s in zip(at, step, strict=True)))
        and has(tuple(c - s for c, s in zip(at, step, strict=True)))
        for step in steps
    )


@given(VOLUMES, st.sampled_from([6, 26]))
def test_local_corners_place_by_place(array: np.ndarray, neighbours: int) -> None:
    mask = corner_mask(Volume(array, (2, -5, 0)), CENTRES, neighbours)
    for at in np.ndindex(array.shape):
        assert mask[at] == is_corner(array, at, neighbours)


def corner_mask(volume: Volume, of: Of, neighbours: int) -> NDArray[np.bool_]:
    """Which places of a volume are local corners."""
    found = np.zeros_like(places(volume, of))
    found[tuple((local_corners(volume, of, neighbours) - volume.origin).T)] = True
    return found


@given(VOLUMES, st.permutations(range(3)), st.integers(1, 40), st.sampled_from(PLACES))
def test_local_corners_of_any_slabs_and_order_of_memory(array: np.ndarray, axes: list[int], slab: int, of: Of) -> None:
    """Corners of voxels are the places of the volume that has a voxel for each of them."""
    turned = array.transpose(axes)
    whole = Volume(places(Volume(turned.copy(), (0, 0, 0)), of), (0, 0, 0))
    with patch.object(corners, "_SLAB", slab):
        parts = corners_by_neighbours(Volume(turned, (0, 0, 0)), of)
    for neighbours, points in parts.items():
        assert np.array_equal(points, local_corners(whole, CENTRES, neighbours))


def test_a_box_without_places_has_no_local_corners() -> None:
    assert local_corners(Volume(np.zeros((0, 3, 3), dtype=np.bool_), (0, 0, 0)), CENTRES).shape == (0, 3)


def single_voxel_corners(volume: Volume) -> NDArray[np.bool_]:
    """Which corners of voxels bound one voxel only: the paper's other form of the test of 6 neighbours (Fig. 2).

    Every local corner by 6 neighbours is one; the paper holds the converse for true too, but such a corner is no local
    one where an opposite neighbour belongs to a voxel that does not touch it: (1, 1, 1) of voxels (0, 0, 0) and
    (1, 1, 2).  The vertices of the hull are among both.
    """
    first, rest = slice(None, -1), slice(1, None)
    wide = np.pad(volume.array, 1).astype(np.uint8)
    count = sum(wide[tuple((first, rest)[k] for k in corner)] for corner in product((0, 1), repeat=3))
    return np.asarray(count == 1)


@given(VOLUMES)
def test_a_corner_that_is_local_by_6_neighbours_bounds_one_voxel_only(array: np.ndarray) -> None:
    """Fig. 2, in the direction in which it holds."""
    volume = Volume(array, (0, 0, 0))
    assert not (corner_mask(volume, VERTICES, 6) & ~single_voxel_corners(volume)).any()


@pytest.mark.parametrize("volume", [ball(32), ball(11), ball(12, "vertex"), half_ball(22)], ids=lambda v: v.source)
def test_of_balls_the_corners_of_one_voxel_are_the_local_ones(volume: Volume) -> None:
    assert np.array_equal(corner_mask(volume, VERTICES, 6), single_voxel_corners(volume))


def test_a_corner_of_one_voxel_need_not_be_local() -> None:
    """Against section 2: the corner (1, 1, 1) of voxel (0, 0, 0) lies halfway between two corners, (1, 1, 0) of that
    voxel and (1, 1, 2) of voxel (1, 1, 2), though no edge of a voxel leads to the second."""
    array = np.zeros((2, 2, 3), dtype=np.bool_)
    array[0, 0, 0] = array[1, 1, 2] = True
    volume = Volume(array, (0, 0, 0))
    assert single_voxel_corners(volume)[1, 1, 1]
    assert not corner_mask(volume, VERTICES, 6)[1, 1, 1]


@given(VOLUMES)
def test_more_neighbours_leave_fewer_corners_and_all_vertices(array: np.ndarray) -> None:
    volume = Volume(array, (1, 2, 3))
    six, all_ = (set(map(tuple, local_corners(volume, CENTRES, n).tolist())) for n in (6, 26))
    judge = judged(volume, CENTRES)
    assert {judge.scaled[index] for index in judge.vertices} <= all_ <= six


def test_local_corners_are_in_raster_order() -> None:
    points = local_corners(half_ball(8), VERTICES, 6).tolist()
    assert points == sorted(points, key=lambda p: p[::-1])
    assert len(points) == 48


@given(st.randoms(use_true_random=False), st.sampled_from([VISIBLE, INVISIBLE]))
def test_the_hull_does_not_depend_on_the_order(source: random.Random, coplanar: str) -> None:
    points = local_corners(half_ball(8), VERTICES, 6).tolist()
    first = straightened(merged(polyhedron(points, coplanar)))
    source.shuffle(points)
    again = straightened(merged(polyhedron(points, coplanar)))
    assert set(first.planes()) == set(again.planes())
    assert set(first.points) == set(again.points)


def polyhedron(points: object, coplanar: str = VISIBLE) -> CellList:
    cells = convex_polyhedron(points, coplanar)  # type: ignore[arg-type]
    assert isinstance(cells, CellList)
    return cells


@given(st.lists(st.tuples(*[st.integers(-2, 2)] * 3), min_size=1, max_size=30), st.sampled_from([VISIBLE, INVISIBLE]))
def test_points_given_twice_and_anywhere(points: list[tuple[int, int, int]], coplanar: str) -> None:
    judge = exact_hull(points)
    cells = convex_polyhedron(points, coplanar)
    if isinstance(cells, Flat):
        assert cells.dimension == judge.dimension < 3
        assert set(cells.vertices) == {judge.scaled[index] for index in judge.vertices}
    else:
        assert set(merged(cells).planes()) == {facet.plane for facet in judge.facets}
        assert all(len(face.pairs) == 3 for face in cells.faces)


def test_large_coordinates_are_exact() -> None:
    """Beyond 64 bits values are Python's integers, and one unit still decides, in raster order and in another."""
    far = 10**9
    corners = [(0, 0, 0), (far, 0, 0), (0, far, 0), (0, 0, far)]
    for height, count in ((far // 4, 4), (far // 4 + 1, 5)):
        points = [*corners, (far // 2, far // 4, height)]
        for order in (points, sorted(points, key=lambda p: p[::-1])):
            cells = polyhedron(order, INVISIBLE)
            assert set(straightened(merged(cells)).points) == set(points[:count])
    assert len(polyhedron([*corners, (far // 2, far // 4, far // 4)], INVISIBLE).points) == 4


def test_values_fit_64_bits_at_the_bound() -> None:
    reach = int((2**63 / 24) ** (1 / 3)) - 1
    corners = [(reach * x, reach * y, reach * z) for x, y, z in product((0, 1), repeat=3)]
    many = [*corners, *((reach // 2 + k, reach // 3, reach // 5 + k) for k in range(100))]
    for more, there in ((0, True), (9, False)):
        points = [(x + more * (x > 0), y, z) for x, y, z in many]
        current = CurrentPolyhedron(points, independent(points), INVISIBLE)
        waiting = Waiting(current, range(4, len(points)))
        assert (waiting.places is not None) == there
        for number, (x, y, z) in enumerate(points[4:], 4):
            values = {f: a * x + b * y + c * z + d for f, (_, _, _, a, b, c, d) in current.faces.items()}
            assert (number in waiting.face) == (max(values.values()) > 0)
            assert number not in waiting.face or values[waiting.face[number]] > 0


@pytest.mark.parametrize(
    ("points", "kind", "vertices"),
    [
        ([(5, 6, 7)], "point", {(5, 6, 7)}),
        ([(0, 0, 0), (1, 1, 1), (3, 3, 3)], "segment", {(0, 0, 0), (3, 3, 3)}),
        ([(0, 0, 0), (4, 0, 0), (0, 4, 0), (1, 1, 0)], "polygon", {(0, 0, 0), (4, 0, 0), (0, 4, 0)}),
    ],
)
def test_flat_points(points: list[tuple[int, int, int]], kind: str, vertices: set[tuple[int, int, int]]) -> None:
    flat = convex_polyhedron(points)
    assert isinstance(flat, Flat)
    assert flat.kind == kind
    assert set(flat.vertices) == vertices


def test_a_flat_polygon_is_a_cycle() -> None:
    """A square in space: neighbours in the list are one edge apart, not a diagonal."""
    hull = voxel_hull(Volume(np.ones((3, 1, 3), dtype=np.bool_), (0, 0, 0)), CENTRES)
    assert isinstance(hull.surface, Flat)
    steps = [abs(p[0] - q[0]) + abs(p[2] - q[2]) for p, q in pairwise(hull.surface.vertices)]
    assert steps == [2, 2, 2]


@given(VOLUMES)
def test_reconstruction_gives_the_filled_hull(array: np.ndarray) -> None:
    """From either hull; so an object comes back exactly if and only if it is digitally convex."""
    volume = Volume(array, (4, -7, 2))
    filled = digital_hull(volume)
    wanted = Volume(filled.filled, volume.origin).coordinates().tolist()
    for of in PLACES:
        hull = voxel_hull(volume, of)
        if isinstance(hull.surface, Flat):
            assert filled.dimension < 3
            continue
        found = reconstructed(hull.surface.straight.economical(), of)
        assert found.coordinates().tolist() == wanted
        assert (found.count == volume.count) == bool((filled.filled == array).all())


@pytest.mark.parametrize("of", PLACES)
@pytest.mark.parametrize("volume", [ball(16), ball(9), ball(10, "vertex"), half_ball(12)], ids=lambda v: v.source)
def test_a_convex_object_comes_back_exactly(volume: Volume, of: str) -> None:
    hull = voxel_hull(volume, of, 6, INVISIBLE).polyhedron
    for cells in (hull.triangles, hull.faces, hull.straight):
        assert reconstructed(cells.economical(), of).coordinates().tolist() == volume.coordinates().tolist()


def test_of_a_hull_of_corners_the_voxels_centres_would_let_in_too_much() -> None:
    """Two voxels at a diagonal are digitally convex; their corners' hull holds the centre of (1, 0, 0)."""
    pair = Volume(np.eye(2, dtype=np.bool_)[:, :, None], (0, 0, 0))
    hull = voxel_hull(pair).polyhedron.straight
    assert all(a * 3 + b * 1 + c * 1 + 2 * d <= 0 for a, b, c, d in hull.planes())
    assert reconstructed(hull.economical()).coordinates().tolist() == [[0, 0, 0], [1, 1, 0]]


def test_reconstruction_refuses_what_holds_no_voxel_or_too_many() -> None:
    thin = polyhedron([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]).economical()
    assert reconstructed(thin, CENTRES).count == 4
    with pytest.raises(VolumeError, match="no voxel fits"):
        reconstructed(thin, VERTICES)
    wide = polyhedron([(0, 0, 0), (9999, 0, 0), (0, 9999, 0), (0, 0, 9999)]).economical()
    with pytest.raises(VolumeError, match="a box of 10000 x 10000 x 10000 voxels"):
        reconstructed(wide, CENTRES)


@pytest.mark.parametrize("centre", ["voxel", "vertex"])
@pytest.mark.parametrize("of", PLACES)
def test_the_hull_of_a_ball_keeps_its_48_symmetries(centre: str, of: str) -> None:
    """Section 4: "the convex hull preserves the symmetry of digital objects"."""
    hull = voxel_hull(ball(14, centre), of).polyhedron.straight
    middle = (centre == "vertex") + (of == VERTICES)
    moved = {tuple(2 * c - middle for c in point) for point in hull.points}
    for order, signs in product(permutations(range(3)), product((-1, 1), repeat=3)):
        assert {tuple(signs[k] * point[order[k]] for k in range(3)) for point in moved} == moved


def test_a_flat_hull_has_no_polyhedron() -> None:
    with pytest.raises(VolumeError, match="rod: flat: the hull is a segment and has no cell list"):
        _ = voxel_hull(Volume(np.ones((1, 1, 5), dtype=np.bool_), (0, 0, 0), "rod"), CENTRES).polyhedron


def test_an_array_of_truth_values_is_a_volume() -> None:
    array = half_ball(8).array
    assert voxel_hull(array).polyhedron.faces == voxel_hull(Volume(array, (0, 0, 0))).polyhedron.faces
    with pytest.raises(VolumeError, match="a volume is an array of truth values"):
        voxel_hull(np.ones((2, 2, 2)))
    with pytest.raises(VolumeError, match="volume: there are no voxels"):
        voxel_hull(np.zeros((2, 2, 2), dtype=np.bool_))


def test_a_picture_of_two_dimensions_is_refused() -> None:
    with pytest.raises(VolumeError, match="the paper's solids have three"):
        voxel_hull(Volume(np.ones((2, 2), dtype=np.bool_), (0, 0)))


@pytest.mark.parametrize(
    "options", [{"of": "edges"}, {"neighbours": 18}, {"coplanar": "perhaps"}, {"order": "perhaps"}]
)
def test_options_that_do_not_exist(options: dict[str, object]) -> None:
    with pytest.raises((ValueError, KeyError)):
        voxel_hull(ball(4), **options)  # type: ignore[arg-type]


def test_no_points_have_no_hull() -> None:
    with pytest.raises(ValueError, match="no points"):
        convex_polyhedron([])
