"""The claims of Yau and Srihari change their verdict when what they rely on is spoiled."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import permutations
from types import SimpleNamespace

import numpy as np
import pytest

import modern.claims.yau_srihari.convexity as convexity
import modern.claims.yau_srihari.envelopes as envelopes
from modern.digital.solids import ball
from modern.papers.yau_srihari.octree import octree
from tests.modern.claims.spoilers import (
    Original,
    Spoiler,
    always,
    assert_verdict_changes,
    changed_result,
    identity,
    negated,
    without_first_result,
)


def sign_by_first_coordinate(_: Original) -> object:
    return lambda plane, point: 1 - 2 * (plane[0] % 2)


def without_last_face(hull: Original) -> object:
    return replace(hull, lower=replace(hull.lower, faces=hull.lower.faces[1:]))


def reduced_set_without_vertex(hull: Original) -> object:
    corner = hull.lower.faces[0].vertices[0]
    return replace(hull, lower=replace(hull.lower, reduced=tuple(p for p in hull.lower.reduced if p != corner)))


def upside_down(hull: Original) -> object:
    return replace(hull, lowest=hull.highest, highest=hull.lowest, upper=hull.lower, lower=hull.upper)


def unfilled(hull: Original) -> object:
    return replace(hull, filled=envelopes.array_of(envelopes.SOLID))


def inward_normals(hull: Original) -> object:
    faces = tuple(replace(face, normal=tuple(-n for n in face.normal)) for face in hull.lower.faces)
    return replace(hull, lower=replace(hull.lower, faces=faces))


def half_integer_normals(hull: Original) -> object:
    steps = tuple(replace(step, normal=tuple(Fraction(n, 2) for n in step.normal)) for step in hull.lower.steps)
    return replace(hull, lower=replace(hull.lower, construction=lambda: steps))


def corrected_algorithm(original: Original) -> object:
    return lambda array, printed=None: original(array)


@changed_result
def four_points(sets: Original) -> object:
    return tuple(SimpleNamespace(points=sampled.points[:4], judge=sampled.judge) for sampled in sets)


def small_ball(_: Original) -> object:
    """Use a small solid, in which the search computes more angles."""
    return lambda diameter, centre: ball(8, centre)


def extra_voxel(original: Original) -> object:
    """Make the path digitally convex."""
    return lambda name: [*original(name), (1, 1, 1)]


def neighbour_of_middle(original: Original) -> object:
    """Add a voxel next to the middle of the stairs."""
    return lambda name: [*original(name)[:-1], (2, 2, 1), original(name)[-1]]


def without_facets(original: Original) -> object:
    return lambda points: replace(original(points), facets=())


def closed_interval(_: Original) -> object:
    return lambda x, v: abs(x - v) <= Fraction(1, 2)


def below_graph(_: Original) -> object:
    return lambda f, x, y, z: z <= f(x, y)


def above_graph(_: Original) -> object:
    return lambda f, x, y, z: z >= f(x, y)


@changed_result
def wide_span(span: Original) -> object:
    """Count distances up to 1 1/3 as near."""
    return (span[0] - Fraction(1, 3), span[1] + Fraction(1, 3)) if span else None


@changed_result
def every_second_segment(segments: Original) -> object:
    return [*segments][::2]


@changed_result
def removed_as_entered(hull: Original) -> object:
    """Give removed edges the direction in which they were entered."""
    steps = tuple(replace(step, removed=tuple((q, p) for p, q in step.removed)) for step in hull.lower.steps)
    return replace(hull, lower=replace(hull.lower, construction=lambda: steps))


@changed_result
def column_lost(heights: Original) -> object:
    return dict([*heights.items()][1:])


@pytest.mark.parametrize(
    ("claim", "attribute", "spoiler"),
    [
        ("yau_srihari.convexity.convex_functions", "FUNCTIONS", lambda original: original[1:]),
        ("yau_srihari.convexity.convex_functions G+", "in_epigraph", below_graph),
        ("yau_srihari.convexity.convex_functions G-", "in_hypograph", above_graph),
        ("yau_srihari.convexity.convex_functions negative", "_negative", identity),
        ("yau_srihari.convexity.convexity_by_expansion", "half_cell_expansion", identity),
        ("yau_srihari.convexity.definitions_differ", "is_midpoint_convex", lambda _: convexity.is_digitally_convex),
        ("yau_srihari.convexity.expansion_of_voxel", "half_cell_expansion", identity),
        ("yau_srihari.convexity.midpoint_convexity", "midpoint_cover", without_first_result),
        ("yau_srihari.convexity.midpoint_convexity", "is_midpoint_convex", always(True)),
        ("yau_srihari.convexity.midpoint_covers", "midpoint_cover", without_first_result),
        ("yau_srihari.convexity.nearness near", "near_span", wide_span),
        ("yau_srihari.convexity.nearness semidigital", "semidigital_segments", every_second_segment),
        ("yau_srihari.convexity.simple_with_a_tunnel", "is_simple", always(False)),
        ("yau_srihari.envelopes.algorithm_as_printed angle", "octree_hull", corrected_algorithm),
        ("yau_srihari.envelopes.algorithm_as_printed bound", "octree_hull", corrected_algorithm),
        ("yau_srihari.envelopes.algorithm_as_printed corners", "octree_hull", corrected_algorithm),
        ("yau_srihari.envelopes.algorithm_as_printed marks", "octree_hull", corrected_algorithm),
        ("yau_srihari.envelopes.algorithm_as_printed start", "octree_hull", corrected_algorithm),
        ("yau_srihari.envelopes.algorithm_as_printed triangles", "octree_hull", corrected_algorithm),
        ("yau_srihari.envelopes.algorithm_as_printed truncation", "octree_hull", corrected_algorithm),
        ("yau_srihari.envelopes.angle_counts", "ball", small_ball),
        ("yau_srihari.envelopes.angle_counts", "_beyond", always(10**6)),
        ("yau_srihari.envelopes.another_vertex", "normal_of", lambda original: lambda *points: original(*points[::-1])),
        ("yau_srihari.envelopes.ceiling_by_negation", "_hull", changed_result(upside_down)),
        (
            "yau_srihari.envelopes.deficiency_of_solid",
            "convex_deficiency",
            lambda original: lambda array: ~original(array),
        ),
        ("yau_srihari.envelopes.disconnected_hull", "counterexample_points", neighbour_of_middle),
        ("yau_srihari.envelopes.disconnected_hull", "is_simple", always(True)),
        ("yau_srihari.envelopes.envelopes_against_judge", "_hull", changed_result(unfilled)),
        ("yau_srihari.envelopes.envelopes_against_judge", "_hull", changed_result(without_last_face)),
        ("yau_srihari.envelopes.envelopes_against_judge condition", "is_simple", always(True)),
        ("yau_srihari.envelopes.envelopes_against_judge condition", "_hull", changed_result(without_last_face)),
        (
            "yau_srihari.envelopes.epigraph_at_inner_nodes",
            "graph_side",
            lambda _: lambda tree, above: octree(np.ones((2, 2, 2), dtype=np.bool_)),
        ),
        ("yau_srihari.envelopes.euclidean_convexity", "plane_value", negated),
        ("yau_srihari.envelopes.extreme_points", "_hull", changed_result(reduced_set_without_vertex)),
        ("yau_srihari.envelopes.floor_and_ceiling", "_hull", changed_result(upside_down)),
        ("yau_srihari.envelopes.floor_and_ceiling condition", "_hull", changed_result(upside_down)),
        ("yau_srihari.envelopes.integer_normals", "_hull", changed_result(half_integer_normals)),
        ("yau_srihari.envelopes.light_cap", "plane_value", sign_by_first_coordinate),
        ("yau_srihari.envelopes.light_cap complexity", "sampled_sets", four_points),
        ("yau_srihari.envelopes.minimum_not_unique", "is_digitally_convex", always(False)),
        ("yau_srihari.envelopes.minimum_not_unique", "is_simple", always(True)),
        ("yau_srihari.envelopes.opposite_sides", "plane_value", lambda _: lambda plane, point: point[0] - 1),
        ("yau_srihari.envelopes.outward_normals", "_hull", changed_result(inward_normals)),
        ("yau_srihari.envelopes.pairs_of_points", "combinations", lambda _: permutations),
        ("yau_srihari.envelopes.queued_edges_reversed", "octree_hull", removed_as_entered),
        ("yau_srihari.envelopes.row_and_column_steps", "_extreme", always(False)),
        ("yau_srihari.envelopes.row_and_column_steps", "heights", column_lost),
        ("yau_srihari.envelopes.smallest_convex_solid", "_hull", changed_result(unfilled)),
        ("yau_srihari.envelopes.smallest_convex_solid", "counterexample_points", extra_voxel),
        ("yau_srihari.envelopes.supporting_triangle", "exact_hull", without_facets),
        ("yau_srihari.envelopes.voxels_fill_space", "in_voxel", closed_interval),
    ],
)
def test_verdict_changes_with_spoiled_attribute(claim: str, attribute: str, spoiler: Spoiler) -> None:
    assert_verdict_changes(claim, attribute, spoiler)
