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
        ("yau-srihari.118", "FUNCTIONS", lambda original: original[1:]),
        ("yau-srihari.47", "in_epigraph", below_graph),
        ("yau-srihari.96", "in_hypograph", above_graph),
        ("yau-srihari.44", "_negative", identity),
        ("yau-srihari.126", "half_cell_expansion", identity),
        ("yau-srihari.27", "is_midpoint_convex", lambda _: convexity.is_digitally_convex),
        ("yau-srihari.26", "half_cell_expansion", identity),
        ("yau-srihari.24", "midpoint_cover", without_first_result),
        ("yau-srihari.24", "is_midpoint_convex", always(True)),
        ("yau-srihari.25", "midpoint_cover", without_first_result),
        ("yau-srihari.32", "near_span", wide_span),
        ("yau-srihari.31", "semidigital_segments", every_second_segment),
        ("yau-srihari.29", "is_simple", always(False)),
        ("yau-srihari.105", "octree_hull", corrected_algorithm),
        ("yau-srihari.66", "octree_hull", corrected_algorithm),
        ("yau-srihari.71", "octree_hull", corrected_algorithm),
        ("yau-srihari.87", "octree_hull", corrected_algorithm),
        ("yau-srihari.83", "octree_hull", corrected_algorithm),
        ("yau-srihari.58", "octree_hull", corrected_algorithm),
        ("yau-srihari.86", "octree_hull", corrected_algorithm),
        ("yau-srihari.129", "ball", small_ball),
        ("yau-srihari.129", "_beyond", always(10**6)),
        ("yau-srihari.99", "normal_of", lambda original: lambda *points: original(*points[::-1])),
        ("yau-srihari.103", "_hull", changed_result(upside_down)),
        (
            "yau-srihari.5",
            "convex_deficiency",
            lambda original: lambda array: ~original(array),
        ),
        ("yau-srihari.36", "counterexample_points", neighbour_of_middle),
        ("yau-srihari.36", "is_simple", always(True)),
        ("yau-srihari.120", "_hull", changed_result(unfilled)),
        ("yau-srihari.120", "_hull", changed_result(without_last_face)),
        ("yau-srihari.49", "is_simple", always(True)),
        ("yau-srihari.49", "_hull", changed_result(without_last_face)),
        (
            "yau-srihari.90",
            "graph_side",
            lambda _: lambda tree, above: octree(np.ones((2, 2, 2), dtype=np.bool_)),
        ),
        ("yau-srihari.41", "plane_value", negated),
        ("yau-srihari.64", "_hull", changed_result(reduced_set_without_vertex)),
        ("yau-srihari.39", "_hull", changed_result(upside_down)),
        ("yau-srihari.50", "_hull", changed_result(upside_down)),
        ("yau-srihari.84", "_hull", changed_result(half_integer_normals)),
        ("yau-srihari.14", "plane_value", sign_by_first_coordinate),
        ("yau-srihari.16", "sampled_sets", four_points),
        ("yau-srihari.109", "is_digitally_convex", always(False)),
        ("yau-srihari.109", "is_simple", always(True)),
        ("yau-srihari.101", "plane_value", lambda _: lambda plane, point: point[0] - 1),
        ("yau-srihari.119", "_hull", changed_result(inward_normals)),
        ("yau-srihari.113", "combinations", lambda _: permutations),
        ("yau-srihari.85", "octree_hull", removed_as_entered),
        ("yau-srihari.128", "_extreme", always(False)),
        ("yau-srihari.128", "heights", column_lost),
        ("yau-srihari.35", "_hull", changed_result(unfilled)),
        ("yau-srihari.35", "counterexample_points", extra_voxel),
        ("yau-srihari.100", "exact_hull", without_facets),
        ("yau-srihari.19", "in_voxel", closed_interval),
    ],
)
def test_verdict_changes_with_spoiled_attribute(claim: str, attribute: str, spoiler: Spoiler) -> None:
    assert_verdict_changes(claim, attribute, spoiler)
