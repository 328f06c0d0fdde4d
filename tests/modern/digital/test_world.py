"""Positions of voxels: the hull in physical coordinates is the exact image of the hull of indices for any axes."""

import random
from fractions import Fraction
from itertools import product
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from hull1620 import exact_hull as proved
from hull1620 import voxel_hull as hull_of_voxels
from modern.digital.solids import Volume, VolumeError
from modern.digital.world import LAS, LPS, RAS, World, determinant, length_text, voxel_volume, world_of
from modern.exact_hull import exact_hull
from modern.geometry.numbers import number
from modern.papers.kovalevsky_schulz import CENTRES, VERTICES, Of, voxel_hull
from tests.support.digital_judge import random_solid

ONE, NONE = Fraction(1), Fraction(0)
tenths = st.integers(-40, 40).map(lambda n: Fraction(n, 10))
vectors = st.tuples(tenths, tenths, tenths)


@st.composite
def worlds(draw: st.DrawFn) -> World:
    """Draw steps that span space: oblique, mirrored, with negative directions."""
    steps = draw(st.tuples(vectors, vectors, vectors))
    assume(determinant(steps))
    return World(steps, draw(vectors))


def faces(points: Any, polygons: Any) -> set[tuple[Any, ...]]:
    """Return every face as its cycle of points that starts with the least one and keeps its orientation."""
    cycles = set()
    for polygon in polygons:
        cycle = [points[k] for k in polygon]
        first = cycle.index(min(cycle))
        cycles.add((*cycle[first:], *cycle[:first]))
    return cycles


def image_of_every_voxel(volume: Volume, world: World, of: Of) -> list[tuple[Fraction, ...]]:
    """Return all centres, or all eight corners of all voxels, from the definition of the position."""
    halves = [Fraction(0)] if of == CENTRES else [Fraction(-1, 2), Fraction(1, 2)]
    points = {}
    for voxel in volume.coordinates().tolist():
        for shift in product(halves, repeat=3):
            place = [
                world.origin[k] + sum(world.steps[axis][k] * (voxel[axis] + shift[axis]) for axis in range(3))
                for k in range(3)
            ]
            points[tuple(place)] = None
    return list(points)


@settings(deadline=None, max_examples=60)
@given(st.integers(0, 10**9), worlds(), st.tuples(*[st.integers(-9, 9)] * 3), st.sampled_from([VERTICES, CENTRES]))
def test_hull_in_physical_coordinates_is_that_of_the_judge(seed, world, origin, of) -> None:
    solid = random_solid(random.Random(seed), side=4, steps=20)
    volume = Volume(solid, origin, world=world)
    hull = voxel_hull(volume, of)
    mesh = hull.mesh(straight=True)
    points = image_of_every_voxel(volume, world, of)
    judged = exact_hull(points)
    assert mesh.dimension == judged.dimension
    assert {tuple(map(number, point)) for point in mesh.points} == {points[k] for k in judged.vertices}
    if judged.dimension == 3:
        polygons = [facet.polygon for facet in judged.facets]
        assert faces(mesh.numbers(), mesh.faces) == faces(points, polygons)


@settings(deadline=None, max_examples=40)
@given(st.integers(0, 10**9), worlds())
def test_measures_are_those_of_the_judge(seed: int, world: World) -> None:
    volume = Volume(random_solid(random.Random(seed), side=4, steps=20), (1, -2, 3), world=world)
    for of in (VERTICES, CENTRES):
        measures = voxel_hull(volume, of).measures()
        judged = proved(image_of_every_voxel(volume, world, of))
        assert measures.hull_volume == judged.volume
        assert abs(measures.hull_area - judged.area.digits) <= judged.area.digits.scaleb(-48)
        assert measures.volume == volume.count * abs(determinant(world.steps))
        if of == VERTICES:
            assert measures.solidity == measures.volume / judged.volume <= 1
            assert measures.deficiency == judged.volume - measures.volume >= 0


def test_axes_corners_and_spaces_are_converted_exactly() -> None:
    # The array is reversed along x, the step is negative and the origin is at the other end.
    solid = random_solid(random.Random(7), side=6)
    size = solid.shape[0]
    forward = world_of(3, (2, 3, "0.5"), (5, 5, 5))
    backward = world_of(3, (-2, 3, "0.5"), (5 + 2 * (size - 1), 5, 5))
    mesh = voxel_hull(Volume(solid, (0, 0, 0), world=forward)).mesh(straight=True)
    reversed_mesh = voxel_hull(Volume(solid[::-1], (0, 0, 0), world=backward)).mesh(straight=True)
    assert faces(mesh.numbers(), mesh.faces) == faces(reversed_mesh.numbers(), reversed_mesh.faces)
    voxel = np.ones((1, 1, 1), np.bool_)
    spaced = hull_of_voxels(voxel, spacing=("0.5", "0.5", 2), origin=(10, 0, -1))
    assert sorted(map(tuple, spaced.points.tolist()))[0] == (9.75, -0.25, -2.0)
    assert sorted(map(tuple, spaced.points.tolist()))[-1] == (10.25, 0.25, 0.0)
    assert spaced.volume == Fraction(1, 2)
    assert hull_of_voxels(voxel, centres=True, spacing=(1, 1, 1), origin=(7, 8, 9)).points.tolist() == [[7, 8, 9]]
    bare = hull_of_voxels(voxel)
    assert (bare.points.min(), bare.points.max()) == (0, 1)
    world = World(((ONE, NONE, NONE), (NONE, -2 * ONE, NONE), (NONE, NONE, 3 * ONE)), (5 * ONE,) * 3, LPS)
    turned = world.turned(RAS)
    assert turned.origin == (-5, -5, 5)
    assert [step[k] for k, step in enumerate(turned.steps)] == [-1, 2, 3]
    assert turned.turned(LPS) == world
    assert world.turned(LAS).origin == (5, -5, 5)
    assert world.bearings() == turned.bearings() == (("left", True), ("anterior", True), ("superior", True))
    assert (world.mirrors, turned.mirrors, world.turned(LAS).mirrors) == (True, True, False)
    with pytest.raises(VolumeError, match="found none"):
        World(world.steps, world.origin).turned(RAS)


def test_axes_and_steps_of_oblique_volumes_are_named() -> None:
    steps = ((ONE / 2, 4 * ONE, ONE), (-3 * ONE, ONE, NONE), (NONE, ONE, -2 * ONE))
    world = World(steps, (NONE,) * 3, RAS)
    assert world.bearings() == (("anterior", False), ("left", False), ("inferior", False))
    assert World(steps, (NONE,) * 3, "scanner-xyz").bearings() == ()
    world = world_of(3, directions=[(0, "-0.1234567891", 0), (3, 0, 4), (0, 1, 1)])
    assert world is not None
    assert world.spacings() == (("0.1234567891", True), ("5", False), ("1.41421", False))


def test_positions_accept_numbers_of_any_real_type() -> None:
    assert world_of(3) is None
    world = world_of(2, spacing=(0.1, "0.1"), unit="mm")
    assert world is not None
    assert (world.steps[0][0], world.steps[1][1], world.origin) == (Fraction(0.1), Fraction(1, 10), (0, 0))
    assert voxel_volume(world) == Fraction(0.1) / 10
    turned = world_of(3, (2, 2, 2), (1, 1, 1), [(0, 1, 0), (1, 0, 0), (0, 0, Fraction(1, 3))])
    assert turned is not None
    assert turned.place((1, 2, 3)) == (5, 3, 3)
    assert voxel_volume(turned) == Fraction(8, 3)
    assert voxel_volume(None) == 1
    assert turned.moved((1, 2, 3)).place((0, 0, 0)) == turned.place((1, 2, 3))


@pytest.mark.parametrize(
    ("place", "message"),
    [
        ({"spacing": (1, 2)}, "spacing: expected 3 numbers, found 2"),
        ({"origin": (1, 2, "x")}, "origin: 'x' is not a decimal number"),
        ({"spacing": (1, 2, float("nan"))}, "spacing: nan is not finite"),
        ({"spacing": (1, 2, 0)}, "the spacing of an axis is 0"),
        ({"directions": [(1, 0, 0)]}, "directions: expected 3 vectors, found 1"),
        ({"directions": [(1, 0, 0), (0, 1, 0), (1, 1, 0)]}, "the directions of the axes are linearly dependent"),
        ({"directions": [(1, 0, 0), (0, 1, 0), (1, 1)]}, "direction of axis 2: expected 3 numbers, found 2"),
    ],
)
def test_invalid_positions_are_reported(place: dict[str, Any], message: str) -> None:
    with pytest.raises(VolumeError) as caught:
        hull_of_voxels(np.ones((2, 2, 2)), **place)
    assert message in str(caught.value)


def test_volumes_need_a_step_for_every_axis_and_pictures_in_space_have_no_area() -> None:
    world = world_of(2, directions=[(1, 0, 1), (0, 1, 0)])
    with pytest.raises(VolumeError, match="2 axes in a space of 3 dimensions"):
        voxel_volume(world)
    with pytest.raises(VolumeError, match="expected 3 spacing vectors, one for each axis of the array, found 2"):
        Volume(np.ones((1, 1, 1), np.bool_), (0, 0, 0), world=world_of(2, (1, 1)))
    with pytest.raises(VolumeError, match="a Volume has its own position"):
        hull_of_voxels(Volume(np.ones((1, 1, 1), np.bool_), (0, 0, 0)), spacing=(1, 1, 1))


@pytest.mark.parametrize("text", ["1e401", "9" * 101, "", "x", "1/2", "0x10"])
def test_numbers_of_headers_are_decimals_of_limited_size(text: str) -> None:
    with pytest.raises(ValueError, match=r"\S"):
        length_text(text)
    assert length_text("-1.5e-2") == Fraction(-3, 200)
