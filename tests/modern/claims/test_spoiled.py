"""Claims of Appel and Will and of Nakamae and Nishita on spoiled ground: what is found is another verdict."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest

import modern.claims.appel_will.convexity as appel_will
import modern.claims.appel_will.graphs as graphs
import modern.claims.appel_will.steps as details
import modern.claims.appel_will.surfaces as objects
import modern.claims.nakamae_nishita.tables as tables
import modern.claims.nakamae_nishita.visibility as nakamae
from modern.claims.register import CONDITION, HOLDS
from modern.papers.appel_will import Method
from modern.papers.appel_will.star import as_printed
from modern.papers.nakamae_nishita.crossings import CLEAR
from modern.papers.nakamae_nishita.hidden import draw
from modern.papers.nakamae_nishita.projection import parallel
from tests.support.caches import cleared

Right = Any


@pytest.fixture(autouse=True)
def nothing_kept() -> Iterator[None]:
    """What a claim keeps is made anew, before the spoiled run and after it."""
    with cleared(appel_will, details, graphs, objects, nakamae, tables):
        yield


def always(value: object) -> Callable[[Right], object]:
    return lambda _: lambda *arguments, **named: value


def turned_over(right: Right) -> object:
    return lambda *arguments: -right(*arguments)


def all_are_vertices(right: Right) -> object:
    """A hull on which every point is a corner."""

    def changed(points: Right) -> object:
        everyone = tuple(range(len(points)))
        return replace(right(points), vertices=everyone, polygon=everyone, boundary=(), inside=())

    return changed


def a_face_twice(right: Right) -> object:
    def changed(*arguments: Right) -> object:
        return [
            (points, replace(judge, facets=(*judge.facets, judge.facets[0]))) for points, judge in right(*arguments)
        ]

    return changed


def a_face_cut_in_two(right: Right) -> object:
    """A face of four corners is given as two triangles."""

    def changed(points: Right) -> object:
        judge = right(points)
        whole = [facet for facet in judge.facets if len(facet.polygon) != 4]
        cut = [facet for facet in judge.facets if len(facet.polygon) == 4]
        parts = [replace(f, polygon=f.polygon[k : k + 3]) for f in cut for k in (0, 1)]
        return replace(judge, facets=(*whole, *parts))

    return changed


def an_edge_less(right: Right) -> object:
    """The graph lacks one edge."""

    def changed(judge: Right) -> object:
        graph = dict(right(judge))
        one = min(graph)
        other = min(graph[one])
        return {**graph, one: graph[one] - {other}, other: graph[other] - {one}}

    return changed


def points(*found: tuple[int, int, int]) -> Callable[[Right], object]:
    """Another counterexample, which is none."""
    return lambda _: lambda name: [*found]


def as_corrected_steps(_: Right) -> object:
    return lambda *names: appel_will.Method()


def closed(right: Right) -> object:
    """A tetrahedron instead of the mesh."""
    return lambda *arguments: SimpleNamespace(faces=[(0, 1, 2), (0, 2, 3), (0, 3, 1), (1, 3, 2)])


def a_vertex_missing(right: Right) -> object:
    def changed(*arguments: Right) -> object:
        return [(points, replace(judge, vertices=judge.vertices[1:])) for points, judge in right(*arguments)]

    return changed


def first_three_only(right: Right) -> object:
    return lambda points: replace(right(points), vertices=(0, 1, 2))


def one_pass(_: Right) -> object:
    """Nonconvex points are deleted once, and not again."""

    def passed(ring: Right) -> object:
        return [p for k, p in enumerate(ring) if appel_will._area(ring[k - 1], p, ring[(k + 1) % len(ring)]) > 0]

    return passed


def by_fig_12(right: Right) -> object:
    """The star polygon as its caption has it."""
    return lambda points: right(points, method=Method(star=as_printed))


def in_any_order(_: Right) -> object:
    """Choices with an order are counted."""
    return SimpleNamespace(comb=math.perm, factorial=lambda n: n)


def an_inner_line_too_many(right: Right) -> object:
    """A line in a loop runs the other way."""
    return lambda entries, edges: right([-entries[0], *entries[1:]], edges)


def without_a_middle(right: Right) -> object:
    return lambda *arguments: replace(right(*arguments), line=())


def rule_two(right: Right) -> object:
    return lambda points, surfaces, rule: right(points, surfaces, "two")


def no_inside_corners(right: Right) -> object:
    """Nothing is deleted first."""
    return lambda points, surfaces, method: right(points, surfaces, replace(method, inside_corners=None))


def a_surface_missing(right: Right) -> object:
    return lambda: replace(right(), surfaces=right().surfaces[1:])


def a_plane_beside(right: Right) -> object:
    return lambda *points: (*right(*points)[:3], right(*points)[3] + 1)


def fewer_points(right: Right) -> object:
    """What stands in the cube's middle stands outside of it."""
    return lambda points: right([*points[:-1], (9, 9, 9)])


def seen_along_an_axis(_: Right) -> object:
    def drawn() -> object:
        return draw(lambda: [nakamae.cuboid("box", *map(nakamae.Fraction, (2, 3, 4)))], parallel((0, 0, 1)))

    return drawn


def seen_aslant_only(right: Right) -> object:
    return lambda *way: right()


def seen_from_above(right: Right) -> object:
    """No face of the roof is seen edge-on."""
    return lambda: (*right()[:2], (31, 17))


def no_zeros(right: Right) -> object:
    def changed(v: Right, w: Right) -> object:
        return tuple([[n or 1 for n in row] for row in table] for table in right(v, w))

    return changed


def with_all_rules(right: Right) -> object:
    return lambda name, *without: right(name)


def fewer_corners(right: Right) -> object:
    return {**right, "d": (30, 190, 158)}


def exchanged(right: Right) -> object:
    """The tables for one another."""
    return lambda v, w: replace(right(v, w), pl=right(v, w).lp, lp=right(v, w).pl)


def other_side_up(right: Right) -> object:
    return lambda *points: tuple(-n for n in right(*points))


@pytest.mark.parametrize(
    ("module", "claim", "name", "spoil"),
    [
        (appel_will, "area_of_triangle", "determinant", lambda right: lambda *points: abs(right(*points))),
        (appel_will, "convex_body", "value", turned_over),
        (appel_will, "convex_points", "_area", lambda _: lambda p, q, r: r[0] - p[0]),
        (appel_will, "deleting_makes_nonconvex", "_area", always(1)),
        (appel_will, "deleting_passes", "_passed", one_pass),
        (appel_will, "inside_a_triangle", "_area", always(1)),
        (appel_will, "jarvis_deletions", "exact_hull", first_three_only),
        (appel_will, "jarvis_deletions condition", "exact_hull", first_three_only),
        (appel_will, "method_is_right", "appel_will", by_fig_12),
        (appel_will, "method_is_right plain", "appel_will", by_fig_12),
        (appel_will, "numbers_of_combinations fewer", "math", in_any_order),
        (appel_will, "numbers_of_combinations formula", "math", in_any_order),
        (appel_will, "outside_of_the_others", "as_corrected", always(True)),
        (appel_will, "planar_graph", "_hulls", a_face_twice),
        (appel_will, "properties 1", "dot", turned_over),
        (appel_will, "properties 2", "value", turned_over),
        (appel_will, "properties 3", "value", turned_over),
        (appel_will, "properties 4", "dot", turned_over),
        (appel_will, "properties 5", "_hulls", a_vertex_missing),
        (appel_will, "properties 5", "exact_hull", all_are_vertices),
        (appel_will, "surface_area", "ARM", lambda _: 0),
        (appel_will, "surface_area", "_surface", always(100)),
        (
            appel_will,
            "jarvis_by_the_letter",
            "points_of",
            points((-9, -9, 0), (0, 0, 0), (9, 0, 0), (9, 9, 0), (0, 9, 0)),
        ),
        (appel_will, "step_by_the_letter step5", "printed", as_corrected_steps),
        (appel_will, "step_by_the_letter step7", "printed", as_corrected_steps),
        (appel_will, "step_by_the_letter step9", "printed", as_corrected_steps),
        (appel_will, "step_by_the_letter step10", "printed", as_corrected_steps),
        (appel_will, "star_by_the_letter", "as_printed", lambda _: appel_will.as_corrected),
        (details, "closed_loops", "_joined", an_inner_line_too_many),
        (details, "closed_loops twice", "_joined", an_inner_line_too_many),
        (details, "new_lines", "exact_hull", all_are_vertices),
        (details, "points_in_line", "project", without_a_middle),
        (details, "star_in_the_text", "as_printed", lambda _: details.as_corrected),
        (details, "product_with_i_twice", "triple_product", lambda right: lambda i, k, m: right(i, k, (0, -1, -1))),
        (graphs, "coplanar_loops", "exact_hull", a_face_cut_in_two),
        (graphs, "faces_without_dimensions", "_graph", an_edge_less),
        (graphs, "faces_without_dimensions", "_connected", always(True)),
        (graphs, "list_of_points", "value", always(0)),
        (graphs, "list_of_points", "through", a_plane_beside),
        (objects, "complex_object_simple_hull", "exact_hull", all_are_vertices),
        (objects, "corners_of_three_planes", "preprocess", rule_two),
        (objects, "inside_corner_at_a_vertex fails", "preprocess", rule_two),
        (objects, "line_must_run", "triple_product", lambda right: lambda *vectors: abs(right(*vectors))),
        (objects, "many_objects_one_hull", "exact_hull", fewer_points),
        (objects, "normal_line", "through", a_plane_beside),
        (objects, "product_of_directions", "points_of", points((4, 0, 0), (0, 0, 0), (3, 2, 0))),
        (objects, "surface_three", "parse_off", closed),
        (objects, "preprocessing_saves", "appel_will", no_inside_corners),
        (objects, "preprocessing_saves cheap", "appel_will", no_inside_corners),
        (objects, "surfaces_first redundant", "bent", a_surface_missing),
        (nakamae, "contour_edges_hidden_too", "_hidden", lambda _: lambda drawing, kind: int(kind == nakamae.INNER)),
        (nakamae, "counts_of_d", "COUNTS", fewer_corners),
        (nakamae, "faces_and_edges", "_cuboid", seen_along_an_axis),
        (nakamae, "faces_and_edges condition", "_cuboid", seen_aslant_only),
        (tables, "contour_is_convex", "_roof", seen_from_above),
        (nakamae, "faces_are_convex", "dot", turned_over),
        (nakamae, "indices", "sign", turned_over),
        (nakamae, "indices k", "sign", turned_over),
        (nakamae, "overlap_by_neighbours", "tables_of", no_zeros),
        (nakamae, "segments_within", "clipped", always(CLEAR)),
        (nakamae, "three_in_line", "line_through", lambda right: lambda *points: (*right(*points)[:2], 1)),
        (nakamae, "touching_is_undecided", "_scene", with_all_rules),
        (nakamae, "touching_is_undecided fails", "_scene", with_all_rules),
        (nakamae, "wholly_behind", "_scene", with_all_rules),
        (nakamae, "sense", "line_through", other_side_up),
        (nakamae, "table_by_4", "sign", turned_over),
        (tables, "formula 2", "sign", turned_over),
        (tables, "formula 2", "contour_tables", exchanged),
        (tables, "formula 3", "crosses", always(False)),
        (tables, "formula 5", "plane_through", other_side_up),
        (tables, "overlap_in_a_line", "SQUARE", lambda _: ((0, 0), (0, 5), (4, 3), (4, 0))),
        (tables, "table_properties 2", "sign", turned_over),
        (tables, "table_properties 3", "crosses", always(True)),
        (tables, "table_properties 4", "sign", turned_over),
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
