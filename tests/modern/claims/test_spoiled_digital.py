"""Claims of Kovalevsky and Schulz and of Yau and Srihari on spoiled ground: what is found is another verdict."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import permutations
from types import ModuleType
from typing import Any

import numpy as np
import pytest

import modern.claims.kovalevsky_schulz.complexes as complexes
import modern.claims.kovalevsky_schulz.lemmas as lemmas
import modern.claims.kovalevsky_schulz.polyhedra as kovalevsky
import modern.claims.kovalevsky_schulz.raster as raster
import modern.claims.yau_srihari.convexity as convexity
import modern.claims.yau_srihari.envelopes as yau
from modern.claims.register import CONDITION, HOLDS
from modern.digital.solids import ball, listed
from modern.papers.kovalevsky_schulz.coplanar import EXTENDED, QUADRANGLES
from modern.papers.kovalevsky_schulz.hull import merged
from tests.support.caches import cleared

Right = Any


@pytest.fixture(autouse=True)
def nothing_kept() -> Iterator[None]:
    """What a claim keeps is made anew, before the spoiled run and after it."""
    with cleared(kovalevsky, complexes, lemmas, raster, yau, convexity):
        yield


def always(value: object) -> Callable[[Right], object]:
    return lambda _: lambda *arguments, **named: value


def as_it_is(_: Right) -> object:
    return lambda thing: thing


def turned_over(right: Right) -> object:
    return lambda *arguments: -right(*arguments)


def all_are_vertices(right: Right) -> object:
    """A hull on which every point is a corner."""

    def changed(points: Right) -> object:
        return replace(right(points), vertices=tuple(range(len(points))), boundary=(), inside=())

    return changed


def lacking_the_first(right: Right) -> object:
    return lambda *arguments: right(*arguments)[1:]


def merged_at_once(right: Right) -> object:
    """There are no triangles of one plane."""
    return lambda points, coplanar="visible": merged(right(points, coplanar))


def without_its_last_point(right: Right) -> object:
    return lambda points, treatment: right(points[:-1], treatment)


def only_as(treatment: object) -> Callable[[Right], object]:
    """One treatment of coplanar faces, whatever is asked for."""
    return lambda right: lambda points, _: right(points, treatment)


def a_vertex_moved(right: Right) -> object:
    def changed() -> object:
        cells = right()
        first, *others = cells.vertices
        return replace(cells, vertices=(replace(first, point=(99, 5, 7)), *others))

    return changed


def a_cube_instead(_: Right) -> object:
    """At each vertex three edges."""
    return lambda: kovalevsky._straight(listed([(0, 0, 0)]))


def one_integer_more(right: Right) -> object:
    return lambda *numbers: right(*numbers) + 1


def one_integer_less_at_18(right: Right) -> object:
    def changed() -> object:
        rows = [*right()]
        rows[5] = (*rows[5][:3], rows[5][3] - 1)
        return tuple(rows)

    return changed


def near_is_enough(_: Right) -> object:
    return lambda a, b: a != b and max(abs(x - y) for x, y in zip(a, b, strict=True)) <= 1


def with_itself(right: Right) -> object:
    return lambda cell: right(cell) | {cell}


def each_alone(_: Right) -> object:
    return lambda cells: [{cell} for cell in cells]


def all_together(_: Right) -> object:
    return lambda cells: [set(cells)]


def at_its_start(_: Right) -> object:
    return lambda ring, vertex: (ring[0], ring[1])


def one_row_of_corners_missing(right: Right) -> object:
    def changed(volume: Right, of: Right) -> object:
        found = right(volume, of).copy()
        found[-1] = False
        return found

    return changed


def exchanged(right: Right) -> object:
    """The invisible face for the visible one."""
    return lambda: ((new, hidden, visible, *rest) for new, visible, hidden, *rest in right())


def through_another_point(right: Right) -> object:
    return lambda p, q, r: right(p, q, (r[0] + 5, r[1] + 7, r[2] - 3))


def by_the_first_coordinate(_: Right) -> object:
    """Whether a face is seen has nothing to do with the point."""
    return lambda plane, point: 1 - 2 * (plane[0] % 2)


def judges(change: Callable[[Right], Right]) -> Callable[[Right], object]:
    return lambda right: lambda: tuple((points, change(judge)) for points, judge in right())


def without_two_vertices(judge: Right) -> object:
    return replace(judge, vertices=judge.vertices[2:])


def a_face_of_one_corner(judge: Right) -> object:
    first, *others = judge.facets
    return replace(judge, facets=(replace(first, polygon=first.polygon[:1]), *others))


def of_the_largest(_: Right) -> object:
    """A value that is not linear."""
    return lambda u, v: max(abs(a * b) for a, b in zip(u, v, strict=True))


def not_squared(_: Right) -> object:
    return lambda u, v: sum(Fraction(a) * b for a, b in zip(u, v, strict=True))


def beside_each_other(right: Right) -> object:
    """Local corners are moved by one."""
    return lambda corners: right(corners + 1)


def from_one_axis(right: Right) -> object:
    return lambda voxel: right(voxel)[:1]


def from_all_sides(_: Right) -> object:
    return lambda voxel: [(n, 2, 2) for n in (0, 1)]


def diagonals_too(_: Right) -> object:
    return lambda cell, corner: max(abs(a - b) for a, b in zip(cell, corner, strict=True)) == 1


def hulls(change: Callable[[Right], Right]) -> Callable[[Right], object]:
    return lambda right: lambda: change(right())


def without_a_face(hull: Right) -> object:
    return replace(hull, lower=replace(hull.lower, faces=hull.lower.faces[1:]))


def less_reduced(hull: Right) -> object:
    corner = hull.lower.faces[0].vertices[0]
    return replace(hull, lower=replace(hull.lower, reduced=tuple(p for p in hull.lower.reduced if p != corner)))


def upside_down(hull: Right) -> object:
    return replace(hull, lowest=hull.highest, highest=hull.lowest, upper=hull.lower, lower=hull.upper)


def the_solid_alone(hull: Right) -> object:
    return replace(hull, filled=yau.array_of(yau.SOLID))


def inward(hull: Right) -> object:
    faces = tuple(replace(face, normal=tuple(-n for n in face.normal)) for face in hull.lower.faces)
    return replace(hull, lower=replace(hull.lower, faces=faces))


def starting_normals_in_halves(hull: Right) -> object:
    steps = tuple(replace(step, normal=tuple(Fraction(n, 2) for n in step.normal)) for step in hull.lower.steps)
    return replace(hull, lower=replace(hull.lower, construction=lambda: steps))


def as_corrected(right: Right) -> object:
    return lambda array, printed=None: right(array)


def too_few_points(right: Right) -> object:
    class Few:
        def __init__(self, one: Right) -> None:
            self.points, self.judge = one.points[:4], one.judge

    return lambda *arguments: tuple(map(Few, right(*arguments)))


def small_only(_: Right) -> object:
    """Small solids only, in which the search takes more."""
    return lambda diameter, centre: ball(8, centre)


def with_a_voxel_more(right: Right) -> object:
    """The path has another voxel, and is digitally convex."""
    return lambda name: [*right(name), (1, 1, 1)]


def with_a_voxel_beside(right: Right) -> object:
    """The stairs hold a voxel beside the middle."""
    return lambda name: [*right(name)[:-1], (2, 2, 1), right(name)[-1]]


def every_corner(_: Right) -> object:
    """All corners of voxels are local corners."""
    return lambda volume, *of: np.argwhere(raster.places(volume, raster.VERTICES))


def without_faces(right: Right) -> object:
    return lambda given: replace(right(given), facets=())


def closed_on_both_sides(_: Right) -> object:
    return lambda x, v: abs(x - v) <= Fraction(1, 2)


@pytest.mark.parametrize(
    ("module", "claim", "name", "spoil"),
    [
        (kovalevsky, "algorithm_is_right", "merged", as_it_is),
        (kovalevsky, "algorithm_is_right condition", "merged", as_it_is),
        (kovalevsky, "bounding_relation", "bounds", near_is_enough),
        (kovalevsky, "choice_of_q", "dot", lambda _: lambda u, v: sum(v)),
        (kovalevsky, "combinations_are_no_vertices", "exact_hull", all_are_vertices),
        (kovalevsky, "combinations_are_no_vertices condition", "exact_hull", all_are_vertices),
        (kovalevsky, "coplanar_triangles", "convex_polyhedron", merged_at_once),
        (kovalevsky, "cube_seen_from_a_corner", "exact_hull", all_are_vertices),
        (kovalevsky, "edge_in_line", "coplanar_hull", without_its_last_point),
        (kovalevsky, "edge_in_line quadrangles", "coplanar_hull", without_its_last_point),
        (kovalevsky, "faces_are_planar", "_half_ball", a_vertex_moved),
        (kovalevsky, "faces_are_planar", "_half_ball", a_cube_instead),
        (kovalevsky, "formula_5", "convex_polyhedron", merged_at_once),
        (kovalevsky, "formula_5", "triangulation_size", one_integer_more),
        (kovalevsky, "halves_of_a_sorted_set", "exact_hull", all_are_vertices),
        (kovalevsky, "integers_a_face", "_table_5", one_integer_less_at_18),
        (kovalevsky, "integers_of_triangles", "triangulation_size", one_integer_more),
        (kovalevsky, "local_corners_are_enough", "local_corners", lacking_the_first),
        (kovalevsky, "pairs_are_not_combinations", "local_corners", lambda right: lambda *given: right(*given)[:0]),
        (kovalevsky, "pairs_are_not_combinations", "exact_hull", all_are_vertices),
        (kovalevsky, "symmetric_faces", "_is_symmetric", always(True)),
        (kovalevsky, "quadrangles", "coplanar_hull", only_as(EXTENDED)),
        (kovalevsky, "third_treatment", "coplanar_hull", only_as(QUADRANGLES)),
        (kovalevsky, "third_treatment crossing", "coplanar_hull", only_as(QUADRANGLES)),
        (kovalevsky, "unseen_is_inside", "value", turned_over),
        (kovalevsky, "vertices_satisfy_all", "value", turned_over),
        (kovalevsky, "what_goes", "value", turned_over),
        (complexes, "boundary", "closure", lambda _: frozenset),
        (complexes, "closure_is_smallest", "closure", lambda _: frozenset),
        (complexes, "connected", "_components", each_alone),
        (complexes, "connected region", "_components", all_together),
        (complexes, "half_space", "interior", as_it_is),
        (complexes, "interior_is_greatest", "interior", as_it_is),
        (complexes, "manifold", "_beside", at_its_start),
        (complexes, "manifold patch", "_beside", at_its_start),
        (complexes, "no_loose_cells", "places", one_row_of_corners_missing),
        (complexes, "open_and_closed", "star", lambda _: frozenset),
        (complexes, "raster access", "SIDE", lambda _: 3),
        (complexes, "side_of_a_cell", "sides", with_itself),
        (complexes, "solid", "_incident", always(False)),
        (complexes, "subcomplex", "sides", with_itself),
        (complexes, "subcomplex", "dimension", always(1)),
        (complexes, "subcomplex", "bounded", with_itself),
        (lemmas, "acute_and_obtuse", "_horizons", exchanged),
        (lemmas, "closed_boundary", "value", by_the_first_coordinate),
        (lemmas, "inner_side", "dot", turned_over),
        (lemmas, "lemma_be", "through", through_another_point),
        (lemmas, "lemma_be normals", "through", through_another_point),
        (lemmas, "lemma_ch", "local_corners", lacking_the_first),
        (lemmas, "lemma_lz", "grown", judges(without_two_vertices)),
        (lemmas, "lemma_lz proof", "grown", judges(without_two_vertices)),
        (lemmas, "maximum_of_the_highest", "dot", of_the_largest),
        (lemmas, "moved_vertex_is_lost", "value", lambda _: lambda plane, point: -1),
        (lemmas, "polyhedra_grow", "value", turned_over),
        (lemmas, "polyhedron_is_a_complex", "grown", judges(a_face_of_one_corner)),
        (lemmas, "section", "_cosine", not_squared),
        (lemmas, "smaller_loses_a_vertex", "value", always(0)),
        (lemmas, "coefficients_by_cosines", "_cosine", always(Fraction(1, 2))),
        (lemmas, "smaller_polyhedron", "value", always(-1)),
        (lemmas, "smaller_polyhedron moved", "value", always(-1)),
        (lemmas, "third_condition", "convex_polyhedron", beside_each_other),
        (lemmas, "two_do_not_do", "exact_hull", all_are_vertices),
        (lemmas, "two_do_not_do", "cross", always((0, 0, 0))),
        (raster, "corners_of_eight_voxels edge", "_neighbours", from_all_sides),
        (raster, "corners_of_eight_voxels more", "_neighbours", from_one_axis),
        (raster, "single_voxel", "local_corners", every_corner),
        (raster, "edges_at_a_corner", "ends_at", diagonals_too),
        (raster, "topological_raster", "cells_of", lambda _: lambda n: 8 * n**3),
        (raster, "topological_raster cells", "product", lambda right: lambda r, repeat: right(range(2), repeat=repeat)),
        (yau, "angles_saved", "ball", small_only),
        (yau, "angles_saved", "_beyond", always(10**6)),
        (yau, "another_vertex", "normal_of", lambda right: lambda *points: right(*points[::-1])),
        (yau, "between_the_envelopes", "_hull", hulls(without_a_face)),
        (yau, "between_the_envelopes", "_hull", hulls(the_solid_alone)),
        (yau, "convex_deficiency_", "convex_deficiency", lambda right: lambda array: ~right(array)),
        (yau, "euclidean_convexity", "value", turned_over),
        (yau, "extreme_points", "_hull", hulls(less_reduced)),
        (yau, "floor_and_ceiling", "_hull", hulls(upside_down)),
        (yau, "floor_and_ceiling condition", "_hull", hulls(upside_down)),
        (yau, "between_the_envelopes condition", "_hull", hulls(without_a_face)),
        (yau, "between_the_envelopes condition", "is_simple", always(True)),
        (yau, "points_of_stairs", "is_simple", always(True)),
        (yau, "points_of_stairs", "points_of", with_a_voxel_beside),
        (yau, "smallest_convex_solid", "_hull", hulls(the_solid_alone)),
        (yau, "smallest_convex_solid", "points_of", with_a_voxel_more),
        (yau, "integer_normals", "_hull", hulls(starting_normals_in_halves)),
        (yau, "light_cap", "value", by_the_first_coordinate),
        (yau, "light_cap complexity", "sampled_sets", too_few_points),
        (yau, "negative_of_the_ceiling", "_hull", hulls(upside_down)),
        (yau, "no_unique_minimum", "is_digitally_convex", always(False)),
        (yau, "no_unique_minimum", "is_simple", always(True)),
        (yau, "opposite_sides", "value", lambda _: lambda plane, point: point[0] - 1),
        (yau, "outward_normals", "_hull", hulls(inward)),
        (yau, "pairs_of_points", "combinations", lambda _: permutations),
        (yau, "printed angle", "octree_hull", as_corrected),
        (yau, "printed bound", "octree_hull", as_corrected),
        (yau, "printed corners", "octree_hull", as_corrected),
        (yau, "printed marks", "octree_hull", as_corrected),
        (yau, "printed start", "octree_hull", as_corrected),
        (yau, "printed triangles", "octree_hull", as_corrected),
        (yau, "printed truncation", "octree_hull", as_corrected),
        (yau, "supporting_is_no_face", "exact_hull", without_faces),
        (yau, "voxels_fill_space", "in_voxel", closed_on_both_sides),
        (convexity, "convex_functions negative", "_negative", as_it_is),
        (convexity, "convex_functions", "FUNCTIONS", lambda right: right[1:]),
        (convexity, "definitions_differ", "is_midpoint_convex", lambda _: convexity.is_digitally_convex),
        (convexity, "half_cell_expansion_", "half_cell_expansion", as_it_is),
        (convexity, "midpoint_convexity", "is_midpoint_convex", always(True)),
        (convexity, "midpoint_convexity", "midpoint_cover", lacking_the_first),
        (convexity, "midpoint_covers", "midpoint_cover", lacking_the_first),
        (convexity, "simple_with_a_tunnel", "is_simple", always(False)),
    ],
)
def test_a_claim_on_spoiled_ground_has_another_verdict(
    module: ModuleType, claim: str, name: str, spoil: Callable[[Right], object], monkeypatch: pytest.MonkeyPatch
) -> None:
    """What holds, with a condition or without, does not any more; what does not hold has no counterexample."""
    function, *arguments = claim.split()
    right = getattr(module, function)(*arguments).verdict
    with cleared(module), monkeypatch.context() as patch:
        patch.setattr(module, name, spoil(getattr(module, name)))
        spoiled = getattr(module, function)(*arguments).verdict
    assert (spoiled in (HOLDS, CONDITION)) != (right in (HOLDS, CONDITION))
