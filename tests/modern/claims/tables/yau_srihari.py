"""Spoilers of the checks of Yau and Srihari."""

from dataclasses import replace
from fractions import Fraction
from itertools import permutations

import numpy as np

import modern.claims.yau_srihari.envelopes as envelopes
from modern.papers.yau_srihari.octree import octree
from tests.modern.claims.spoilers import (
    Original,
    Table,
    always,
    changed_result,
    check_holds,
    identity,
    invalid_step,
)


def reduced_set_without_vertex(hull: Original) -> object:
    corner = hull.lower.faces[0].vertices[0]
    return replace(hull, lower=replace(hull.lower, reduced=tuple(p for p in hull.lower.reduced if p != corner)))


def upside_down(hull: Original) -> object:
    return replace(hull, lowest=hull.highest, highest=hull.lowest, upper=hull.lower, lower=hull.upper)


def upper_negated(hull: Original) -> object:
    faces = (replace(f, vertices=tuple((x, y, -z) for x, y, z in f.vertices)) for f in hull.upper.faces)
    return replace(hull, upper=replace(hull.upper, faces=tuple(faces)))


def unfilled(hull: Original) -> object:
    return replace(hull, filled=envelopes.array_of(envelopes.SOLID))


def half_integer_normals(hull: Original) -> object:
    steps = tuple(replace(step, normal=tuple(Fraction(n, 2) for n in step.normal)) for step in hull.lower.steps)
    return replace(hull, lower=replace(hull.lower, construction=lambda: steps))


def corrected_algorithm(original: Original) -> object:
    return lambda array, printed=None: original(array)


def extra_voxel(original: Original) -> object:
    """Make the path digitally convex."""
    return lambda name: [*original(name), (1, 1, 1)]


def neighbour_of_middle(original: Original) -> object:
    """Add a voxel next to the middle of the stairs."""
    return lambda name: [*original(name)[:-1], (2, 2, 1), original(name)[-1]]


def without_facets(original: Original) -> object:
    return lambda points: replace(original(points), facets=())


@changed_result
def removed_as_entered(hull: Original) -> object:
    """Give removed edges the direction in which they were entered."""
    steps = tuple(replace(step, removed=tuple((q, p) for p, q in step.removed)) for step in hull.lower.steps)
    return replace(hull, lower=replace(hull.lower, construction=lambda: steps))


@changed_result
def column_lost(heights: Original) -> object:
    return dict([*heights.items()][1:])


D = "yau-srihari."
TABLE: Table = [
    (D + "6", "is_midpoint_convex", always(False)),
    (D + "126", "half_cell_expansion", identity),
    (D + "29", "is_simple", always(False)),
    (D + "61", "algorithm_as_printed", check_holds),
    (D + "66", "octree_hull", corrected_algorithm),
    (D + "71", "octree_hull", corrected_algorithm),
    (D + "87", "octree_hull", corrected_algorithm),
    (D + "83", "octree_hull", corrected_algorithm),
    (D + "58", "octree_hull", corrected_algorithm),
    (D + "86", "octree_hull", corrected_algorithm),
    (D + "129", "_beyond", always(10**6)),
    (D + "99", "normal_of", lambda original: lambda *points: original(*points[::-1])),
    (D + "103", "_hull", changed_result(upper_negated)),
    (D + "36", "counterexample_points", neighbour_of_middle),
    (D + "36", "is_simple", always(True)),
    (D + "48", "combination_satisfies", lambda _: lambda: (invalid_step(_)(),)),
    (D + "49", "is_simple", always(True)),
    (D + "90", "graph_side", lambda _: lambda tree, above: octree(np.ones((2, 2, 2), dtype=np.bool_))),
    (D + "84", "hull_of", changed_result(half_integer_normals)),
    (D + "109", "is_digitally_convex", always(False)),
    (D + "109", "is_simple", always(True)),
    (D + "113", "combinations", lambda _: permutations),
    (D + "128", "_extreme", always(False)),
    (D + "128", "heights", column_lost),
    (D + "35", "_hull", changed_result(unfilled)),
    (D + "35", "counterexample_points", extra_voxel),
    (D + "100", "exact_hull", without_facets),
    (D + "120", "_envelopes_agree", always(False)),
    (D + "120", "octree_hull", lambda original: lambda array: original(~array)),
    (D + "67", "octree_hull", corrected_algorithm),
    (D + "5", "convex_deficiency", lambda original: lambda array: ~original(array)),
    (D + "64", "octree_hull", lambda original: lambda array: reduced_set_without_vertex(original(array))),
    (D + "50", "_hull", changed_result(upside_down)),
    (D + "52", "_upper_heights", always((set(), set()))),
    (D + "85", "hull_of", removed_as_entered),
]
