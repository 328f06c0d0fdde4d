"""Spoilers of the checks of chapters 2 and 3 of the thesis."""

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace

import modern.claims.thesis.chapter3_stages as stages
from modern.claims.sampled_sets import SampledSet
from modern.geometry.hull import Hull, Stage
from tests.modern.claims.spoilers import (
    Original,
    Table,
    all_points_vertices,
    always,
    changed_result,
    check_fails,
    check_holds,
    constant_plus_one,
    counterexample,
    flattened,
    identity,
    negated,
    three_vertices,
    value,
    without_last_point,
)

HullChange = Callable[[Hull], Hull]


def judge_without_facet(original: Original) -> object:
    def spoiled(*arguments: Original) -> object:
        return tuple(
            replace(sampled, judge=replace(sampled.judge, facets=sampled.judge.facets[1:]))
            for sampled in original(*arguments)
        )

    return spoiled


def stage_without_point(original: Original) -> object:
    """Append a stage that adds no point."""

    def spoiled(sampled: SampledSet) -> SampledSet:
        empty_stage = replace(sampled.hull.history[-1], added=())
        return replace(sampled, hull=replace(sampled.hull, history=(*sampled.hull.history, empty_stage)))

    return lambda *arguments: tuple(map(spoiled, original(*arguments)))


def with_last_stage(hull: Hull, change: Callable[[Stage], Stage]) -> Hull:
    *before, last = hull.history
    return replace(hull, history=(*before, change(last)))


def three_last_equations(hull: Hull) -> Hull:
    return with_last_stage(hull, lambda stage: replace(stage, equations=stage.equations[:3]))


three_equations = changed_result(three_last_equations)


def two_equations(hull: Hull) -> Hull:
    return with_last_stage(hull, lambda stage: replace(stage, equations=stage.equations[2:]))


@changed_result
def netc_always_one(hull: Hull) -> Hull:
    return replace(hull, history=tuple(replace(stage, checked=1) for stage in hull.history))


@changed_result
def line_repeated(hull: Hull) -> Hull:
    return replace(hull, lines=(hull.lines[0], hull.lines[0]))


@changed_result
def third_point_first(hull: Hull) -> Hull:
    """Exchange the first points of H_1 in space."""
    if hull.dimension < 3:
        return hull
    first, *rest = hull.history
    a, b, c, d = first.added
    return replace(hull, history=(replace(first, added=(c, a, b, d)), *rest))


def without_boundary(hull: Hull) -> Hull:
    return replace(hull, boundary=())


def without_last_face(hull: Hull) -> Hull:
    return replace(hull, faces=hull.faces[:-1])


def elimination_and_check_exchanged(original: Original) -> object:
    exchanged = {"E": "C", "C": "E", "G": "G"}
    return {program: {k: exchanged[step] for k, step in labels.items()} for program, labels in original.items()}


def without_equation(hull: Hull) -> Hull:
    """Remove the first equation of the last hull."""
    return with_last_stage(hull, lambda stage: replace(stage, equations=stage.equations[1:]))


def vertex_eliminated(hull: Hull) -> Hull:
    """Eliminate a vertex at the first stage and again at the last."""
    first, *rest = hull.history
    spoiled = replace(first, struck=(*first.struck, hull.vertices[-1]))
    return with_last_stage(
        replace(hull, history=(spoiled, *rest)), lambda stage: replace(stage, struck=(*stage.struck, hull.vertices[-1]))
    )


def second_stage_removed(hull: Hull) -> Hull:
    return replace(hull, history=(hull.history[0], *hull.history[2:]))


def netc_decreasing(hull: Hull) -> Hull:
    first, *rest = hull.history
    return replace(hull, history=(first, *(replace(stage, checked=9 - k) for k, stage in enumerate(rest))))


def last_stage_repeated(hull: Hull) -> Hull:
    return replace(hull, history=(*hull.history, *(hull.history[-1:] * len(hull.points))))


def inner_point_added(hull: Hull) -> Hull:
    """Let the last stage add a point that is inside."""
    inside = {*range(len(hull.points))} - {*hull.vertices} - {*hull.boundary}
    return with_last_stage(hull, lambda stage: replace(stage, added=(min(inside),)) if inside else stage)


PROPERTIES: dict[str, HullChange] = {
    "nested": inner_point_added,
    "added_tetrahedra": second_stage_removed,
    "equations": without_equation,
    "last_hull": without_equation,
    "struck_points": vertex_eliminated,
    "struck_inside": vertex_eliminated,
    "contained_points": second_stage_removed,
    "decreasing": vertex_eliminated,
    "finite": last_stage_repeated,
    "accepted_planes": netc_decreasing,
    "farthest_outside": inner_point_added,
    "largest_of_all": inner_point_added,
    "replaced_line": without_equation,
    "replaced_plane": without_equation,
    "two_new_lines": inner_point_added,
    "counts": without_equation,
    "renumbering": without_equation,
    "netc_order": netc_decreasing,
    "vertices_used": second_stage_removed,
    "vertex_when_added": inner_point_added,
    "added_triangle": without_equation,
    "convexity": netc_decreasing,
}


D = "thesis."
TABLE: Table = [
    (D + "22", "counterexample_points", counterexample((0, 0, 0), (1, 1, 1), (2, 2, 2))),
    (D + "275", "counterexample_points", counterexample((0, 0, 0), (4, 0, 0), (0, 4, 0), (5, 5, 0))),
    (D + "26", "math", lambda _: SimpleNamespace(comb=lambda n, k: 1)),
    (D + "201", "sampled_sets", judge_without_facet),
    (D + "27", "sampled_sets", judge_without_facet),
    (D + "25", "sampled_sets", judge_without_facet),
    (D + "24", "sampled_sets", judge_without_facet),
    (D + "200", "plane_value", negated),
    (D + "23", "exact_hull", all_points_vertices),
    (D + "18", "plane_value", always(1)),
    (D + "48", "convex_hull", lambda original: lambda points: original(points[:3])),
    (D + "270", "convex_hull", lambda original: lambda points: original(points[:2])),
    (D + "46", "convex_hull", third_point_first),
    (D + "6", "exact_hull", three_vertices),
    (D + "205", "convex_hull", changed_result(without_boundary)),
    (D + "82", "_between", lambda original: lambda a, b, c, *far: original(b, a, c, *far)),
    (D + "230", "exact_hull", all_points_vertices),
    (D + "53", "convex_hull", third_point_first),
    (D + "53", "convex_hull", flattened),
    (D + "52", "plane_as_printed", always((0, 0, 0, 0))),
    (D + "85", "convex_hull", changed_result(two_equations)),
    (D + "103", "convex_hull", changed_result(without_last_face)),
    (D + "42", "convex_hull", line_repeated),
    (D + "44", "convex_hull", line_repeated),
    (D + "45", "convex_hull", line_repeated),
    (D + "87", "counterexample_points", counterexample((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))),
    (D + "88", "dot", negated),
    (D + "67", "counterexample_points", counterexample((1, 0, 0))),
    (D + "104", "plane_value", always(1)),
    (D + "105", "plane_value", always(1)),
    (D + "80", "exact_hull", all_points_vertices),
    (D + "102", "exact_hull", all_points_vertices),
    (D + "49", "_square", negated),
    (D + "81", "convex_hull", changed_result(without_boundary)),
    (D + "231", "exact_hull", all_points_vertices),
    (D + "256", "exact_hull", all_points_vertices),
    (D + "94", "_shared", always(())),
    (D + "95", "convex_hull", without_last_point),
    (D + "97", "plane_value", always(1)),
    (D + "96", "plane_value", always(1)),
    (D + "47", "convex_hull", line_repeated),
    (D + "269", "sampled_sets", stage_without_point),
    (D + "271", "exact_hull", flattened),
    (D + "271", "EXTREMES_IN_A_PLANE", lambda original: (*original, ((0, 0, 3), (3, 1, 0), (1, 4, 1), (-2, 0, -1)))),
    (D + "39", "_volume", always(1)),
    (D + "39", "_extreme_points", identity),
    (D + "79", "convex_hull", netc_always_one),
    (D + "101", "convex_hull", netc_always_one),
    (D + "101", "stage_property", check_fails),
    (D + "286", "_ELIMINATE_CHECK_GROW", elimination_and_check_exchanged),
    (D + "276", "exact_hull", without_last_point),
    (D + "276", "convex_hull", three_equations),
    (D + "272", "code_positions", negated),
    (D + "267", "line_duplicates_as_printed", check_holds),
    (D + "267", "fourth_point_by_largest", check_holds),
    (D + "40", "line_as_printed", constant_plus_one),
    (D + "51", "plane_as_printed", constant_plus_one),
    (D + "62", "line_of_page_19", constant_plus_one),
    (D + "58", "plane_value", negated),
    (D + "1", "silent_loss", check_holds),
    (D + "1", "procedure_against_judge", check_fails),
    (D + "98", "_same_places", always(True)),
    (D + "199", "visible_planes", check_fails),
    (D + "226", "_replaced_facet", always(())),
    (D + "89", "stage_property", check_fails),
    (D + "2", "_PROPERTIES", value(dict.fromkeys(stages._PROPERTIES, lambda sampled: [False]))),
    (D + "267", "plane_duplicates_as_printed", check_fails),
]
