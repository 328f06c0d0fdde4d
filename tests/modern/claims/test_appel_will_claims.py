"""The claims of Appel and Will change their verdict when what they rely on is spoiled."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction
from types import SimpleNamespace

import pytest

import modern.claims.appel_will.convexity as convexity
import modern.claims.appel_will.surfaces as surfaces
from modern.papers.appel_will import Method
from modern.papers.appel_will.corners import preprocess
from modern.papers.appel_will.results import Solid
from modern.papers.appel_will.star import as_corrected, as_printed
from tests.modern.claims.spoilers import (
    Original,
    Spoiler,
    absolute,
    all_points_vertices,
    always,
    assert_verdict_changes,
    changed_result,
    constant_negated,
    constant_plus_one,
    counterexample,
    negated,
    sum_instead_of_product,
    three_vertices,
)


@changed_result
def repeated_facet(hulls: Original) -> object:
    return [(points, replace(judge, facets=(*judge.facets, judge.facets[0]))) for points, judge in hulls]


@changed_result
def judge_without_vertex(hulls: Original) -> object:
    return [(points, replace(judge, vertices=judge.vertices[1:])) for points, judge in hulls]


@changed_result
def quadrangle_split(judge: Original) -> object:
    """Give each face with four corners as two triangles."""
    whole = [facet for facet in judge.facets if len(facet.polygon) != 4]
    quadrangles = [facet for facet in judge.facets if len(facet.polygon) == 4]
    triangles = [replace(facet, polygon=facet.polygon[k : k + 3]) for facet in quadrangles for k in (0, 1)]
    return replace(judge, facets=(*whole, *triangles))


@changed_result
def edge_removed(graph: Original) -> object:
    vertex = min(graph)
    neighbour = min(graph[vertex])
    return {**graph, vertex: graph[vertex] - {neighbour}, neighbour: graph[neighbour] - {vertex}}


corrected_method = always(Method())
tetrahedron_mesh = always(SimpleNamespace(faces=[(0, 1, 2), (0, 2, 3), (0, 3, 1), (1, 3, 2)]))


def single_pass(_: Original) -> object:
    """Delete nonconvex points once and not again."""

    def spoiled(ring: Original) -> object:
        return [p for k, p in enumerate(ring) if convexity._area(ring[k - 1], p, ring[(k + 1) % len(ring)]) > 0]

    return spoiled


def star_of_fig_12(original: Original) -> object:
    return lambda points: original(points, method=Method(star=as_printed))


def permutations_counted(_: Original) -> object:
    return SimpleNamespace(comb=math.perm, factorial=lambda n: n)


def first_entry_negated(original: Original) -> object:
    return lambda entries, edges: original([-entries[0], *entries[1:]], edges)


def positive_entries(original: Original) -> object:
    return lambda entries, edges: original([*map(abs, entries)], edges)


@changed_result
def empty_line(projection: Original) -> object:
    return replace(projection, line=())


def rule_two(original: Original) -> object:
    return lambda points, faces, rule: original(points, faces, "two")


def rule_any(original: Original) -> object:
    return lambda points, faces, rule: original(points, faces, "any")


def nothing_deleted(original: Original) -> object:
    return lambda points, faces, rule: original(points, faces, "two" if rule == "any" else rule)


def no_inside_corners(original: Original) -> object:
    return lambda points, faces, method: original(points, faces, replace(method, inside_corners=None))


@changed_result
def surface_removed(solid: Original) -> object:
    return replace(solid, surfaces=solid.surfaces[1:])


def last_point_outside(original: Original) -> object:
    return lambda points: original([*points[:-1], (9, 9, 9)])


def squared_length(_: Original) -> object:
    """Divide the direction by the square of the length."""

    def direction(p: Original, q: Original) -> tuple[Fraction, Fraction, Fraction, int]:
        square = sum((b - a) ** 2 for a, b in zip(p, q, strict=True))
        x, y, z = (Fraction(b - a, square) for a, b in zip(p, q, strict=True))
        return x, y, z, square

    return direction


def coplanar_pits(_: Original) -> object:
    """Let three pits reach the surfaces of the fourth."""
    return dict(zip(surfaces.PITS, [(5, 5, 1), (5, 1, 5), (1, 5, 5), (3, 3, 3)], strict=True))


def spike(original: Original) -> object:
    return {**original, (1, 2, 3): (5, 5, 5)}


convex_solid = always(Solid(surfaces.TETRAHEDRON, tuple(surfaces.PITS)))


def unsorted_star(_: Original) -> object:
    return lambda images: [*images]


@pytest.mark.parametrize(
    ("claim", "attribute", "spoiler"),
    [
        ("appel-will.5", "plane_value", negated),
        ("appel-will.9", "_area", lambda _: lambda p, q, r: r[0] - p[0]),
        ("appel-will.11", "_area", always(1)),
        ("appel-will.10", "_passed", single_pass),
        ("yau-srihari.12", "as_corrected", always(True)),
        ("appel-will.52", "_area", always(1)),
        ("appel-will.16", "exact_hull", three_vertices),
        ("appel-will.17", "exact_hull", three_vertices),
        (
            "appel-will.15",
            "counterexample_points",
            counterexample((-9, -9, 0), (0, 0, 0), (9, 0, 0), (9, 9, 0), (0, 9, 0)),
        ),
        ("appel-will.64", "appel_will", star_of_fig_12),
        ("appel-will.67", "appel_will", star_of_fig_12),
        ("appel-will.38", "math", permutations_counted),
        ("appel-will.37", "math", permutations_counted),
        ("appel-will.124", "_hulls", repeated_facet),
        ("appel-will.27", "dot", negated),
        ("appel-will.28", "plane_value", negated),
        ("appel-will.66", "plane_value", negated),
        ("appel-will.30", "dot", negated),
        ("appel-will.31", "exact_hull", all_points_vertices),
        ("appel-will.31", "_hulls", judge_without_vertex),
        ("appel-will.59", "as_printed", lambda _: as_corrected),
        ("appel-will.108", "printed", corrected_method),
        ("appel-will.103", "printed", corrected_method),
        ("appel-will.105", "printed", corrected_method),
        ("appel-will.107", "printed", corrected_method),
        ("appel-will.33", "ARM", lambda _: 0),
        ("appel-will.33", "_surface", always(100)),
        ("appel-will.50", "determinant", absolute),
        ("appel-will.158", "exact_hull", quadrangle_split),
        ("appel-will.97", "_graph", edge_removed),
        ("appel-will.97", "_connected", always(True)),
        ("appel-will.150", "plane_value", always(0)),
        ("appel-will.150", "plane_through", constant_plus_one),
        ("appel-will.135", "_joined", first_entry_negated),
        ("yau-srihari.112", "_joined", first_entry_negated),
        ("appel-will.133", "project", empty_line),
        ("appel-will.111", "_joined", always(True)),
        ("appel-will.111", "_joined", positive_entries),
        ("appel-will.148", "printed", corrected_method),
        ("appel-will.148", "_comes_again", always(False)),
        ("appel-will.128", "exact_hull", all_points_vertices),
        (
            "appel-will.159",
            "triple_product",
            lambda original: lambda i, k, m: original(i, k, (0, -1, -1)),
        ),
        ("appel-will.132", "as_printed", lambda _: as_corrected),
        ("appel-will.131", "as_corrected", always(True)),
        ("appel-will.58", "star_polygon", unsorted_star),
        ("appel-will.136", "preprocess", rule_two),
        ("appel-will.140", "triple_product", absolute),
        ("appel-will.85", "triple_product", absolute),
        ("appel-will.77", "bent", surface_removed),
        ("appel-will.78", "pitted", lambda _: surfaces.bent),
        ("appel-will.43", "preprocess", nothing_deleted),
        ("appel-will.155", "preprocess", rule_two),
        ("appel-will.154", "fig_4", convex_solid),
        ("appel-will.157", "cross", sum_instead_of_product),
        ("appel-will.157", "area_vector", always((1, 2, 3))),
        ("appel-will.139", "plane_through", constant_plus_one),
        ("appel-will.79", "exact_hull", last_point_outside),
        ("appel-will.82", "direction", squared_length),
        ("appel-will.82", "unit_plane", constant_negated),
        ("appel-will.152", "appel_will", no_inside_corners),
        ("appel-will.69", "appel_will", no_inside_corners),
        (
            "appel-will.83",
            "counterexample_points",
            counterexample((4, 0, 0), (0, 0, 0), (3, 2, 0)),
        ),
        ("appel-will.91", "exact_hull", all_points_vertices),
        ("appel-will.22", "parse_off", tetrahedron_mesh),
        ("appel-will.73", "preprocess", rule_any),
        ("appel-will.81", "direction", squared_length),
        ("appel-will.76", "PITS", spike),
        ("appel-will.76", "PITS", coplanar_pits),
    ],
)
def test_verdict_changes_with_spoiled_attribute(claim: str, attribute: str, spoiler: Spoiler) -> None:
    assert_verdict_changes(claim, attribute, spoiler)


def test_rule_two_keeps_the_apex_of_the_crown() -> None:
    """The apex is on four inside corners, and on more outside corners than the figure allows."""
    crown = surfaces.crown()
    preprocessed = preprocess(crown.points, crown.surfaces, "two")
    assert sum(8 in corner.line.ends for corner in preprocessed.inside) == 4
    assert 8 not in preprocessed.deleted
