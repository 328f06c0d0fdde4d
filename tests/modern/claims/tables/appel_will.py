"""Spoilers of the checks of Appel and Will."""

from dataclasses import replace
from types import SimpleNamespace

import modern.claims.appel_will.convexity as convexity
import modern.claims.appel_will.surfaces as surfaces
from modern.papers.appel_will import Method
from modern.papers.appel_will.results import Solid
from modern.papers.appel_will.star import as_corrected, as_printed
from tests.modern.claims.spoilers import (
    Original,
    Table,
    absolute,
    all_points_vertices,
    always,
    changed_result,
    check_fails,
    check_holds,
    counterexample,
    negated,
    sum_instead_of_product,
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


def positive_entries(original: Original) -> object:
    return lambda entries, edges: original([*map(abs, entries)], edges)


def rule_two(original: Original) -> object:
    return lambda points, faces, rule: original(points, faces, "two")


def rule_any(original: Original) -> object:
    return lambda points, faces, rule: original(points, faces, "any")


def no_inside_corners(original: Original) -> object:
    return lambda points, faces, method: original(points, faces, replace(method, inside_corners=None))


@changed_result
def surface_removed(solid: Original) -> object:
    return replace(solid, surfaces=solid.surfaces[1:])


def last_point_outside(original: Original) -> object:
    return lambda points: original([*points[:-1], (9, 9, 9)])


def coplanar_pits(_: Original) -> object:
    """Let three pits reach the surfaces of the fourth."""
    return dict(zip(surfaces.PITS, [(5, 5, 1), (5, 1, 5), (1, 5, 5), (3, 3, 3)], strict=True))


def spike(original: Original) -> object:
    return {**original, (1, 2, 3): (5, 5, 5)}


convex_solid = always(Solid(surfaces.TETRAHEDRON, tuple(surfaces.PITS)))


def unsorted_star(_: Original) -> object:
    return lambda images: [*images]


def rule_all(_: Original) -> object:
    """Delete every point."""
    return lambda points, *arguments: SimpleNamespace(deleted=tuple(range(len(points))))


def turned_if_changed(original: Original) -> object:
    """Turn all surfaces that are not listed as in Fig. 4."""
    listed = surfaces.fig_4().surfaces
    return lambda points, faces: tuple(f if faces == listed else f[::-1] for f in original(points, faces))


def without_first_combination(original: Original) -> object:
    return lambda items, r: [*original(items, r)][1:]


@changed_result
def no_figure(found: Original) -> object:
    return [replace(finding, produced=("x",)) for finding in found]


D = "appel-will."
TABLE: Table = [
    (D + "9", "_area", lambda _: lambda p, q, r: r[0] - p[0]),
    (D + "11", "_area", always(1)),
    ("yau-srihari.12", "as_corrected", always(True)),
    (D + "15", "counterexample_points", counterexample((-9, -9, 0), (0, 0, 0), (9, 0, 0), (9, 9, 0), (0, 9, 0))),
    (D + "67", "appel_will", star_of_fig_12),
    (D + "124", "_hulls", repeated_facet),
    (D + "27", "dot", negated),
    (D + "28", "plane_value", negated),
    (D + "66", "plane_value", negated),
    (D + "30", "dot", negated),
    (D + "31", "exact_hull", all_points_vertices),
    (D + "31", "_hulls", judge_without_vertex),
    (D + "59", "as_printed", lambda _: as_corrected),
    (D + "108", "printed", corrected_method),
    (D + "103", "printed", corrected_method),
    (D + "105", "printed", corrected_method),
    (D + "107", "printed", corrected_method),
    (D + "33", "ARM", lambda _: 0),
    (D + "33", "_surface", always(100)),
    (D + "158", "exact_hull", quadrangle_split),
    (D + "97", "_graph", edge_removed),
    (D + "97", "_connected", always(True)),
    (D + "111", "_joined", always(True)),
    (D + "111", "_joined", positive_entries),
    (D + "148", "printed", corrected_method),
    (D + "148", "_comes_again", always(False)),
    (D + "128", "exact_hull", all_points_vertices),
    (D + "159", "triple_product", lambda original: lambda i, k, m: original(i, k, (0, -1, -1))),
    (D + "131", "as_printed", always(True)),
    (D + "58", "star_polygon", unsorted_star),
    (D + "85", "triple_product", absolute),
    (D + "77", "bent", surface_removed),
    (D + "78", "pitted", lambda _: surfaces.bent),
    (D + "154", "fig_4", convex_solid),
    (D + "157", "cross", sum_instead_of_product),
    (D + "79", "exact_hull", last_point_outside),
    (D + "152", "appel_will", no_inside_corners),
    (D + "69", "appel_will", no_inside_corners),
    (D + "83", "counterexample_points", counterexample((4, 0, 0), (0, 0, 0), (3, 2, 0))),
    (D + "91", "exact_hull", all_points_vertices),
    (D + "22", "parse_off", tetrahedron_mesh),
    (D + "73", "preprocess", rule_any),
    (D + "76", "PITS", spike),
    (D + "76", "PITS", coplanar_pits),
    (D + "1", "star_as_captioned", check_holds),
    (D + "10", "_passed", single_pass),
    (D + "38", "comb", lambda _: lambda n, k: k),
    (D + "37", "combinations", without_first_combination),
    (D + "119", "as_corrected", lambda _: lambda images: images[0] == (1, 1)),
    (D + "60", "as_corrected", always(True)),
    (D + "101", "printed", corrected_method),
    (D + "155", "preprocess", rule_two),
    (D + "72", "preprocess", rule_all),
    (D + "74", "preprocess", rule_all),
    (D + "43", "inside_corner_at_vertex", check_fails),
    (D + "84", "oriented", turned_if_changed),
    (D + "32", "_closed", always(False)),
    (D + "140", "triple_product", absolute),
    (D + "80", "findings", no_figure),
    (D + "52", "bracket", lambda original: lambda a, b, c: original(a, c, b) + 1),
]
