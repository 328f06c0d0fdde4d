"""The claims of Kovalevsky and Schulz change their verdict when what they rely on is spoiled."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

import modern.claims.kovalevsky_schulz.complexes as complexes
import modern.claims.kovalevsky_schulz.polyhedra as polyhedra
import modern.claims.kovalevsky_schulz.raster as raster
from modern.digital.solids import Volume, listed
from modern.papers.kovalevsky_schulz import CENTRES
from modern.papers.kovalevsky_schulz.coplanar import EXTENDED, QUADRANGLES
from modern.papers.kovalevsky_schulz.hull import merged
from tests.modern.claims.spoilers import (
    Original,
    Spoiler,
    all_points_vertices,
    always,
    assert_verdict_changes,
    changed_result,
    identity,
    negated,
    plus_one,
    without_first_result,
    without_last_point,
)


def merged_immediately(original: Original) -> object:
    """Merge coplanar triangles at once."""
    return lambda points, coplanar="visible": merged(original(points, coplanar))


def only_as(treatment: object) -> Spoiler:
    """Use one treatment of coplanar faces only."""
    return lambda original: lambda points, _: original(points, treatment)


@changed_result
def vertex_moved(cells: Original) -> object:
    first, *rest = cells.vertices
    return replace(cells, vertices=(replace(first, point=(99, 5, 7)), *rest))


def single_cube(_: Original) -> object:
    """Return a body with three edges at each vertex."""
    return lambda: polyhedra._straight(listed([(0, 0, 0)]))


@changed_result
def integer_less_at_18(table: Original) -> object:
    return (*table[:5], (*table[5][:3], table[5][3] - 1), *table[6:])


def chebyshev_neighbours(_: Original) -> object:
    return lambda a, b: a != b and max(abs(x - y) for x, y in zip(a, b, strict=True)) <= 1


def with_itself(original: Original) -> object:
    return lambda cell: original(cell) | {cell}


def singletons(_: Original) -> object:
    return lambda cells: [{cell} for cell in cells]


def single_component(_: Original) -> object:
    return lambda cells: [set(cells)]


def first_two(_: Original) -> object:
    return lambda ring, vertex: (ring[0], ring[1])


def last_corners_removed(original: Original) -> object:
    """Remove the corners with the largest x."""

    def spoiled(volume: Volume, kind: Original) -> object:
        array = original(volume, kind).copy()
        if kind != CENTRES:
            array[-1] = False
        return array

    return spoiled


def centres_only(original: Original) -> object:
    return lambda volume, kind: original(volume, CENTRES)


def mirrored(original: Original) -> object:
    """Name a corner by its voxel nearest to the origin, so that elements on the wrong side are labelled."""

    def spoiled(volume: Volume, kind: Original) -> object:
        array = original(Volume(volume.array[::-1, ::-1, ::-1], volume.origin), kind)
        return array if kind != CENTRES else volume.array

    return spoiled


def exchanged(original: Original) -> object:
    """Exchange the visible and the invisible face."""
    return lambda: ((new, hidden, visible, *rest) for new, visible, hidden, *rest in original())


def third_point_moved(original: Original) -> object:
    return lambda p, q, r: original(p, q, (r[0] + 5, r[1] + 7, r[2] - 3))


def sign_by_first_coordinate(_: Original) -> object:
    return lambda plane, point: 1 - 2 * (plane[0] % 2)


def judges(change: Callable[[Original], Original]) -> Spoiler:
    return lambda original: lambda: tuple((points, change(judge)) for points, judge in original())


def without_two_vertices(judge: Original) -> object:
    return replace(judge, vertices=judge.vertices[2:])


def degenerate_facet(judge: Original) -> object:
    first, *rest = judge.facets
    return replace(judge, facets=(replace(first, polygon=first.polygon[:1]), *rest))


def largest_product(_: Original) -> object:
    """Return a value that is not linear."""
    return lambda u, v: max(abs(a * b) for a, b in zip(u, v, strict=True))


def plain_product(_: Original) -> object:
    return lambda u, v: sum(Fraction(a) * b for a, b in zip(u, v, strict=True))


def corners_moved(original: Original) -> object:
    return lambda corners: original(corners + 1)


def one_axis(original: Original) -> object:
    return lambda voxel: original(voxel)[:1]


def opposite_sides_of_one_axis(_: Original) -> object:
    return lambda voxel: [(n, 2, 2) for n in (0, 1)]


def with_diagonals(_: Original) -> object:
    return lambda cell, corner: max(abs(a - b) for a, b in zip(cell, corner, strict=True)) == 1


def all_corners(_: Original) -> object:
    return lambda volume, *kind: np.argwhere(raster.places(volume, raster.VERTICES))


def without_last_face(original: Original) -> object:
    return lambda cells: replace(original(cells), faces=original(cells).faces[:-1])


def no_closure(_: Original) -> object:
    return lambda cells: frozenset(cells)


@pytest.mark.parametrize(
    ("claim", "attribute", "spoiler"),
    [
        ("kovalevsky_schulz.complexes.boundary", "closure", lambda _: frozenset),
        ("kovalevsky_schulz.complexes.cells_incident_to_voxels", "places", last_corners_removed),
        ("kovalevsky_schulz.complexes.connected", "_components", singletons),
        ("kovalevsky_schulz.complexes.connected region", "_components", single_component),
        ("kovalevsky_schulz.complexes.euclidean_cells", "closure", no_closure),
        ("kovalevsky_schulz.complexes.greatest_open_subset", "interior", identity),
        ("kovalevsky_schulz.complexes.half_space", "interior", identity),
        ("kovalevsky_schulz.complexes.manifold", "_beside", first_two),
        ("kovalevsky_schulz.complexes.manifold patch", "_beside", first_two),
        ("kovalevsky_schulz.complexes.open_and_closed", "star", lambda _: frozenset),
        ("kovalevsky_schulz.complexes.raster access", "SIDE", lambda _: 3),
        ("kovalevsky_schulz.complexes.sides_of_cell", "sides", with_itself),
        ("kovalevsky_schulz.complexes.smallest_closed_subset", "closure", lambda _: frozenset),
        ("kovalevsky_schulz.complexes.solid", "_incident", always(False)),
        ("kovalevsky_schulz.complexes.subcomplex", "sides", with_itself),
        ("kovalevsky_schulz.complexes.subcomplex", "bounded", with_itself),
        ("kovalevsky_schulz.complexes.subcomplex", "dimension", always(1)),
        ("kovalevsky_schulz.lemmas.angles_at_edge", "_horizons", exchanged),
        ("kovalevsky_schulz.lemmas.closed_boundary", "plane_value", sign_by_first_coordinate),
        ("kovalevsky_schulz.lemmas.coefficients_by_cosines", "_cosine", always(Fraction(1, 2))),
        ("kovalevsky_schulz.lemmas.combination_of_three", "exact_hull", all_points_vertices),
        ("kovalevsky_schulz.lemmas.combination_of_three", "cross", always((0, 0, 0))),
        ("kovalevsky_schulz.lemmas.complex_of_polyhedron", "sampled_hulls", judges(degenerate_facet)),
        ("kovalevsky_schulz.lemmas.hull_without_a_vertex", "plane_value", always(0)),
        ("kovalevsky_schulz.lemmas.hulls_of_more_points", "plane_value", negated),
        ("kovalevsky_schulz.lemmas.inner_side", "dot", negated),
        ("kovalevsky_schulz.lemmas.lemma_be", "plane_through", third_point_moved),
        ("kovalevsky_schulz.lemmas.lemma_be normals", "plane_through", third_point_moved),
        ("kovalevsky_schulz.lemmas.lemma_ch", "local_corners", without_first_result),
        ("kovalevsky_schulz.lemmas.lemma_lz", "sampled_hulls", judges(without_two_vertices)),
        ("kovalevsky_schulz.lemmas.lemma_lz proof", "sampled_hulls", judges(without_two_vertices)),
        ("kovalevsky_schulz.lemmas.maximum_of_combinations", "dot", largest_product),
        ("kovalevsky_schulz.lemmas.moved_vertex", "plane_value", always(-1)),
        ("kovalevsky_schulz.lemmas.section_angles", "_cosine", plain_product),
        ("kovalevsky_schulz.lemmas.smaller_polyhedron", "plane_value", always(-1)),
        ("kovalevsky_schulz.lemmas.smaller_polyhedron moved", "plane_value", always(-1)),
        ("kovalevsky_schulz.lemmas.third_condition", "convex_polyhedron", corners_moved),
        ("kovalevsky_schulz.polyhedra.algorithm_against_judge", "merged", identity),
        ("kovalevsky_schulz.polyhedra.algorithm_against_judge condition", "merged", identity),
        ("kovalevsky_schulz.polyhedra.bounding_relation", "bounds", chebyshev_neighbours),
        ("kovalevsky_schulz.polyhedra.cells_removed", "plane_value", negated),
        ("kovalevsky_schulz.polyhedra.choice_of_q", "dot", lambda _: lambda u, v: sum(v)),
        ("kovalevsky_schulz.polyhedra.collinear_edges", "coplanar_hull", without_last_point),
        ("kovalevsky_schulz.polyhedra.collinear_edges quadrangles", "coplanar_hull", without_last_point),
        ("kovalevsky_schulz.polyhedra.combinations_not_vertices", "exact_hull", all_points_vertices),
        ("kovalevsky_schulz.polyhedra.combinations_not_vertices condition", "exact_hull", all_points_vertices),
        ("kovalevsky_schulz.polyhedra.coplanar_triangles", "convex_polyhedron", merged_immediately),
        ("kovalevsky_schulz.polyhedra.cube_visible_from_corner", "exact_hull", all_points_vertices),
        ("kovalevsky_schulz.polyhedra.extended_faces", "coplanar_hull", only_as(QUADRANGLES)),
        ("kovalevsky_schulz.polyhedra.extended_faces crossing", "coplanar_hull", only_as(QUADRANGLES)),
        ("kovalevsky_schulz.polyhedra.formula_5", "convex_polyhedron", merged_immediately),
        ("kovalevsky_schulz.polyhedra.formula_5", "triangulation_size", plus_one),
        ("kovalevsky_schulz.polyhedra.halves_of_sorted_set", "exact_hull", all_points_vertices),
        ("kovalevsky_schulz.polyhedra.integers_of_triangles", "triangulation_size", plus_one),
        ("kovalevsky_schulz.polyhedra.integers_per_face", "_table_5", integer_less_at_18),
        (
            "kovalevsky_schulz.polyhedra.local_corner_inside_hull",
            "local_corners",
            lambda original: lambda *arguments: original(*arguments)[:0],
        ),
        ("kovalevsky_schulz.polyhedra.local_corner_inside_hull", "exact_hull", all_points_vertices),
        ("kovalevsky_schulz.polyhedra.planar_faces", "_half_ball", vertex_moved),
        ("kovalevsky_schulz.polyhedra.planar_faces", "_half_ball", single_cube),
        ("kovalevsky_schulz.polyhedra.points_that_see_no_face", "plane_value", negated),
        ("kovalevsky_schulz.polyhedra.quadrangles", "coplanar_hull", only_as(EXTENDED)),
        ("kovalevsky_schulz.polyhedra.symmetric_faces", "_is_symmetric", always(True)),
        ("kovalevsky_schulz.polyhedra.symmetry", "straightened", without_last_face),
        (
            "kovalevsky_schulz.polyhedra.symmetry",
            "half_ball",
            lambda _: lambda diameter: listed([(0, 0, 0), (0, 1, 0), (1, 2, 0)]),
        ),
        ("kovalevsky_schulz.polyhedra.vertices_among_local_corners", "local_corners", without_first_result),
        ("kovalevsky_schulz.polyhedra.vertices_within_planes", "plane_value", negated),
        ("kovalevsky_schulz.raster.additional_labels", "places", mirrored),
        ("kovalevsky_schulz.raster.additional_labels", "places", last_corners_removed),
        ("kovalevsky_schulz.raster.corner_of_single_voxel", "local_corners", all_corners),
        ("kovalevsky_schulz.raster.corners_against_centres", "places", last_corners_removed),
        ("kovalevsky_schulz.raster.corners_against_centres first", "places", last_corners_removed),
        ("kovalevsky_schulz.raster.corners_against_centres first", "places", centres_only),
        ("kovalevsky_schulz.raster.corners_of_eight_voxels edge", "_neighbours", opposite_sides_of_one_axis),
        ("kovalevsky_schulz.raster.corners_of_eight_voxels more", "_neighbours", one_axis),
        ("kovalevsky_schulz.raster.edges_at_corner", "ends_at", with_diagonals),
        ("kovalevsky_schulz.raster.farthest_voxel_of_corner", "places", last_corners_removed),
        ("kovalevsky_schulz.raster.farthest_voxel_of_corner figure", "places", centres_only),
        ("kovalevsky_schulz.raster.topological_raster", "cells_of", lambda _: lambda n: 8 * n**3),
        (
            "kovalevsky_schulz.raster.topological_raster cells",
            "product",
            lambda original: lambda r, repeat: original(range(2), repeat=repeat),
        ),
    ],
)
def test_verdict_changes_with_spoiled_attribute(claim: str, attribute: str, spoiler: Spoiler) -> None:
    assert_verdict_changes(claim, attribute, spoiler)


@pytest.mark.parametrize("diameter", polyhedra.DIAMETERS)
def test_memory_condition_names_the_right_diameters(diameter: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """The claim fails if a cell list is as large as Marching Cubes, or if triangles take less at other diameters."""
    rows = polyhedra._table_5()
    k = polyhedra.DIAMETERS.index(diameter)
    triangles, integers, faces, _ = rows[k]
    other_vertices = 2000 if diameter in (10, 18) else 1
    assert polyhedra.memory_requirements().holds
    for spoiled in (
        (triangles, integers, faces, integers),
        (triangles, 10**6, faces, 5 * faces + 3 * other_vertices),
    ):
        monkeypatch.setattr(polyhedra, "_table_5", lambda row=spoiled: (*rows[:k], row, *rows[k + 1 :]))
        assert not polyhedra.memory_requirements().holds


@pytest.mark.parametrize("claim", ["smallest_neighbourhood", "topological_line", "raster incident", "raster shared"])
def test_missing_bounding_pair_fails(claim: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the corner in the middle bound one voxel less."""
    bounded, sides = complexes.bounded, complexes.sides
    name, *arguments = claim.split()
    assert getattr(complexes, name)(*arguments).holds
    monkeypatch.setattr(complexes, "bounded", lambda c: bounded(c) - {(3, 3, 3)} if c == (2, 2, 2) else bounded(c))
    monkeypatch.setattr(complexes, "sides", lambda c: sides(c) - {(2, 2, 2)} if c == (3, 3, 3) else sides(c))
    assert not getattr(complexes, name)(*arguments).holds


def test_interior_without_a_cell_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    original = complexes.interior
    monkeypatch.setattr(complexes, "interior", lambda cells: frozenset(sorted(original(cells))[1:]))
    assert not complexes.greatest_open_subset().holds


def test_missing_corner_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    original = complexes.places

    def without_first(*arguments: Original) -> object:
        array = original(*arguments)
        array[tuple(array.nonzero()[axis][0] for axis in range(3))] = False
        return array

    monkeypatch.setattr(complexes, "places", without_first)
    assert not complexes.cells_incident_to_voxels().holds
