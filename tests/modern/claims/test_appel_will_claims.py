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
        ("appel_will.convexity.convex_body", "plane_value", negated),
        ("appel_will.convexity.corners_of_convex_polygon", "_area", lambda _: lambda p, q, r: r[0] - p[0]),
        ("appel_will.convexity.deletion_makes_nonconvex", "_area", always(1)),
        ("appel_will.convexity.deletion_passes", "_passed", single_pass),
        ("appel_will.convexity.edge_by_star_test", "as_corrected", always(True)),
        ("appel_will.convexity.inside_triangle", "_area", always(1)),
        ("appel_will.convexity.jarvis_deletions", "exact_hull", three_vertices),
        ("appel_will.convexity.jarvis_deletions condition", "exact_hull", three_vertices),
        (
            "appel_will.convexity.jarvis_start_as_printed",
            "counterexample_points",
            counterexample((-9, -9, 0), (0, 0, 0), (9, 0, 0), (9, 9, 0), (0, 9, 0)),
        ),
        ("appel_will.convexity.method_against_judge", "appel_will", star_of_fig_12),
        ("appel_will.convexity.method_against_judge plain", "appel_will", star_of_fig_12),
        ("appel_will.convexity.numbers_of_combinations fewer", "math", permutations_counted),
        ("appel_will.convexity.numbers_of_combinations formula", "math", permutations_counted),
        ("appel_will.convexity.planar_graph", "_hulls", repeated_facet),
        ("appel_will.convexity.polyhedron_property 1", "dot", negated),
        ("appel_will.convexity.polyhedron_property 2", "plane_value", negated),
        ("appel_will.convexity.polyhedron_property 3", "plane_value", negated),
        ("appel_will.convexity.polyhedron_property 4", "dot", negated),
        ("appel_will.convexity.polyhedron_property 5", "exact_hull", all_points_vertices),
        ("appel_will.convexity.polyhedron_property 5", "_hulls", judge_without_vertex),
        ("appel_will.convexity.star_as_captioned", "as_printed", lambda _: as_corrected),
        ("appel_will.convexity.step_as_printed step10", "printed", corrected_method),
        ("appel_will.convexity.step_as_printed step5", "printed", corrected_method),
        ("appel_will.convexity.step_as_printed step7", "printed", corrected_method),
        ("appel_will.convexity.step_as_printed step9", "printed", corrected_method),
        ("appel_will.convexity.surface_area", "ARM", lambda _: 0),
        ("appel_will.convexity.surface_area", "_surface", always(100)),
        ("appel_will.convexity.triangle_area", "determinant", absolute),
        ("appel_will.graphs.coplanar_loops", "exact_hull", quadrangle_split),
        ("appel_will.graphs.faces_from_graph", "_graph", edge_removed),
        ("appel_will.graphs.faces_from_graph", "_connected", always(True)),
        ("appel_will.graphs.list_of_points", "plane_value", always(0)),
        ("appel_will.graphs.list_of_points", "plane_through", constant_plus_one),
        ("appel_will.steps.closed_loops", "_joined", first_entry_negated),
        ("appel_will.steps.closed_loops twice", "_joined", first_entry_negated),
        ("appel_will.steps.collinear_points", "project", empty_line),
        ("appel_will.steps.fourth_loop", "_joined", always(True)),
        ("appel_will.steps.fourth_loop", "_joined", positive_entries),
        ("appel_will.steps.limit_of_searches", "printed", corrected_method),
        ("appel_will.steps.limit_of_searches", "_comes_again", always(False)),
        ("appel_will.steps.new_lines", "exact_hull", all_points_vertices),
        (
            "appel_will.steps.product_with_repeated_vector",
            "triple_product",
            lambda original: lambda i, k, m: original(i, k, (0, -1, -1)),
        ),
        ("appel_will.steps.star_as_described", "as_printed", lambda _: as_corrected),
        ("appel_will.steps.star_test", "as_corrected", always(True)),
        ("appel_will.steps.star_test change", "star_polygon", unsorted_star),
        ("appel_will.surfaces.corners_of_three_planes", "preprocess", rule_two),
        ("appel_will.surfaces.direction_of_line", "triple_product", absolute),
        ("appel_will.surfaces.direction_of_line condition", "triple_product", absolute),
        ("appel_will.surfaces.hulls_of_surfaces redundant", "bent", surface_removed),
        ("appel_will.surfaces.hulls_of_surfaces relation", "pitted", lambda _: surfaces.bent),
        ("appel_will.surfaces.inside_corner_at_vertex", "preprocess", nothing_deleted),
        ("appel_will.surfaces.inside_corner_at_vertex fails", "preprocess", rule_two),
        ("appel_will.surfaces.minimum_data", "fig_4", convex_solid),
        ("appel_will.surfaces.normal_from_two_lines", "cross", sum_instead_of_product),
        ("appel_will.surfaces.normal_from_two_lines", "area_vector", always((1, 2, 3))),
        ("appel_will.surfaces.normal_line", "plane_through", constant_plus_one),
        ("appel_will.surfaces.objects_with_same_hull", "exact_hull", last_point_outside),
        ("appel_will.surfaces.planes_of_surfaces", "direction", squared_length),
        ("appel_will.surfaces.planes_of_surfaces", "unit_plane", constant_negated),
        ("appel_will.surfaces.preprocessing_cost", "appel_will", no_inside_corners),
        ("appel_will.surfaces.preprocessing_cost cheap", "appel_will", no_inside_corners),
        (
            "appel_will.surfaces.product_of_directions",
            "counterexample_points",
            counterexample((4, 0, 0), (0, 0, 0), (3, 2, 0)),
        ),
        ("appel_will.surfaces.simple_hull_of_complex_object", "exact_hull", all_points_vertices),
        ("appel_will.surfaces.surface_three", "parse_off", tetrahedron_mesh),
        ("appel_will.surfaces.two_inside_corners", "preprocess", rule_any),
        ("appel_will.surfaces.unit_directions", "direction", squared_length),
        ("appel_will.surfaces.vertex_without_supporting_surface", "PITS", spike),
        ("appel_will.surfaces.vertex_without_supporting_surface", "PITS", coplanar_pits),
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
