"""Claims of the thesis notice a break: each on what it says is so, and on the same thing spoiled."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import ModuleType
from typing import Any

import pytest

import modern.claims.thesis.chapter3_equations as claims
import modern.claims.thesis.chapter3_steps as steps
import modern.claims.thesis.chapter3_wording as letter
import modern.claims.thesis.chapter4_examples as examples
import modern.claims.thesis.chapter4_projections as details
import modern.claims.thesis.chapter4_theorems as proofs
import modern.claims.thesis.chapter5 as messages
import modern.claims.thesis.chapter7 as limits
from modern.claims.register import CONDITION, FAILS, HOLDS, Seen
from modern.claims.sampled_sets import SampledSet, sampled_sets
from modern.edition.chapter6 import input_deck

Right = Any
Spoil = Callable[[Right], object]


def it_holds(_: Right) -> object:
    """A step that would be as the listing's."""
    return lambda *arguments: Seen(HOLDS, "")


def it_fails(_: Right) -> object:
    return lambda *arguments: Seen(FAILS, "")


def a_stage_without_a_point(right: Right) -> object:
    """One stage more, which adds nothing."""

    def changed(one: SampledSet) -> SampledSet:
        more = replace(one.hull.history[-1], added=())
        return SampledSet(one.points, replace(one.hull, history=(*one.hull.history, more)), one.judge)

    return lambda *arguments: tuple(map(changed, right(*arguments)))


def three_equations(right: Right) -> object:
    """The last stage has three equations only."""

    def changed(points: Right, *arguments: Right, **named: Right) -> object:
        hull = right(points, *arguments, **named)
        *before, last = hull.history
        return replace(hull, history=(*before, replace(last, equations=last.equations[:3])))

    return changed


def checked_too_early(right: Right) -> object:
    """NETC is one in every stage."""

    def changed(points: Right, *arguments: Right, **named: Right) -> object:
        hull = right(points, *arguments, **named)
        return replace(hull, history=tuple(replace(stage, checked=1) for stage in hull.history))

    return changed


def one_line_twice(right: Right) -> object:
    """A line is given by one equation and its double."""

    def changed(points: Right) -> object:
        hull = right(points)
        return replace(hull, lines=(hull.lines[0], hull.lines[0]))

    return changed


def five_stages_each(right: Right) -> object:
    """Every stage has five times its equations."""

    def changed(points: Right, *arguments: Right, **named: Right) -> object:
        hull = right(points, *arguments, **named)
        return replace(hull, history=tuple(replace(s, equations=s.equations * 5) for s in hull.history))

    return changed


def flattened(right: Right) -> object:
    """The hull of the points with z made 0."""
    return lambda points, *arguments, **named: right([(x, y, 0) for x, y, _ in points], *arguments, **named)


def the_last_point_left_out(right: Right) -> object:
    return lambda points, *arguments, **named: right(points[:-1], *arguments, **named)


def another_order_in_space(right: Right) -> object:
    """In space the third point of H_1 comes first."""

    def changed(points: Right, *arguments: Right, **named: Right) -> object:
        hull = right(points, *arguments, **named)
        if hull.dimension < 3:
            return hull
        first, *rest = hull.history
        a, b, c, d = first.added
        return replace(hull, history=(replace(first, added=(c, a, b, d)), *rest))

    return changed


def whole_numbers(right: Right) -> object:
    """The arithmetic is exact, whatever is asked for."""
    return lambda points, name, **named: right(points, "exact", **named)


def another_deck(_: Right) -> object:
    """A deck that comes out right."""
    return lambda name: limits.run_hull(input_deck(4), limits.programs.program)


def without_boundary_points(right: Right) -> object:
    return lambda one: tuple(line for line in right(one) if "BOUNDARY" not in line)


def checked_before_elimination(right: Right) -> object:
    """What eliminates is taken for what checks."""
    other = {"E": "C", "C": "E", "G": "G"}
    return {program: {k: other[what] for k, what in labels.items()} for program, labels in right.items()}


def without_an_interval(right: Right) -> object:
    return lambda points, **named: right(points)


def always_with_an_interval(right: Right) -> object:
    return lambda points, **named: right(points, epsilon="20")


def an_eight_misread(right: Right) -> object:
    """A print with a 9 for an 8."""
    return lambda example: (
        replace(one, lines=tuple(line.replace(" .80000000E+01", " .90000000E+01") for line in one.lines))
        for one in right(example)
    )


def a_card_more(right: Right) -> object:
    return lambda points, name: right([*points, points[0]], name)


@pytest.mark.parametrize(
    ("module", "claim", "name", "spoil"),
    [
        (claims, "few_points", "convex_hull", lambda right: lambda points: right(points[:2])),
        (claims, "first_two", "convex_hull", another_order_in_space),
        (letter, "steps_of_the_listing", "line_struck_twice", it_holds),
        (letter, "steps_of_the_listing", "fourth_point_by_largest", it_holds),
        (letter, "steps_of_the_listing", "repeats_from_behind", it_fails),
        (letter, "repeats_from_behind", "convex_hull", three_equations),
        (letter, "repeats_from_behind", "exact_hull", the_last_point_left_out),
        (letter, "last_equation 2", "convex_hull", checked_too_early),
        (letter, "last_equation 3", "convex_hull", checked_too_early),
        (letter, "last_equation 3", "approximations", it_fails),
        (letter, "collinear_if_both_hold", "convex_hull", one_line_twice),
        (letter, "more_involved", "code_positions", lambda right: lambda program: -right(program)),
        (letter, "fewer_substitutions", "convex_hull", five_stages_each),
        (letter, "pairs_of_hulls", "sampled_sets", a_stage_without_a_point),
        (
            letter,
            "six_in_a_plane",
            "EXTREMES_IN_A_PLANE",
            lambda right: (*right, ((0, 0, 3), (3, 1, 0), (1, 4, 1), (-2, 0, -1))),
        ),
        (letter, "six_in_a_plane", "exact_hull", flattened),
        (letter, "first_hull_against_six", "_volume", lambda _: lambda *arguments: 1),
        (letter, "first_hull_against_six", "_six", lambda _: lambda points: [*points]),
        (details, "coordinate_planes", "_with_0", lambda _: lambda point, axis: point),
        (
            details,
            "projection_serves",
            "_with_0",
            lambda right: lambda point, axis: right(right(point, axis), (axis + 1) % 3),
        ),
        (details, "inside_is_not_told_by_signs", "_goes_through", lambda _: lambda *arguments: True),
        (
            details,
            "inside_is_not_told_by_signs",
            "_four_times",
            lambda right: lambda numbers: right([abs(x) for x in numbers]),
        ),
        (proofs, "proof_of_4_4 letters", "through", lambda right: lambda p, q, r: right(q, p, r)),
        (proofs, "only_one_outside", "ADDED", lambda right: right[:-1]),
        (proofs, "only_one_outside", "ADDED", lambda right: (*right[:-1], "Q9")),
        (proofs, "eight_theorems", "gap_in_4_7", it_fails),
        (steps, "opening_is_shared", "convex_hull", another_order_in_space),
        (steps, "opening_is_shared", "convex_hull", flattened),
        (examples, "extremes_of_any_number six_extremes", "exact_hull", flattened),
        (messages, "error_in_program", "run_of", another_deck),
        (
            messages,
            "error_in_program",
            "convex_hull",
            lambda right: lambda points: replace(right(points), corrected=()),
        ),
        (messages, "points_are_coplanar", "_first_run", lambda right: lambda exponent: right("E+01")),
        (messages, "points_are_coplanar", "exact_hull", flattened),
        (messages, "noughts_for_small_numbers", "_first_run", lambda right: lambda exponent: right("E+01")),
        (messages, "digits_of_calculations", "take", whole_numbers),
        (messages, "places_for_planes", "exact_hull", the_last_point_left_out),
        (messages, "places_for_planes", "PLACES", lambda right: right + 1),
        (messages, "places_for_lines", "convex_hull", the_last_point_left_out),
        (messages, "printed_hulls", "prints", an_eight_misread),
        (messages, "printed_hulls", "exact_hull", flattened),
        (messages, "first_card", "data_deck", a_card_more),
        (messages, "cited_pages", "_WORKS", lambda right: {**right, 6: 200}),
        (messages, "cited_pages", "_CITED", lambda right: {**right, 12: (3,)}),
        (messages, "possible_output", "_punched", without_boundary_points),
        (messages, "possible_output", "EXAMPLES", lambda right: right[:-2]),
        (letter, "checked_after_elimination", "_ELIMINATE_CHECK_GROW", checked_before_elimination),
        (limits, "vertex_overlooked", "convex_hull", without_an_interval),
        (limits, "vertex_overlooked", "convex_hull", always_with_an_interval),
        (limits, "interval_is_a_solution", "_THREE", lambda _: ((0, 0, 0), (1, 0, 0), (0, 1, 0))),
    ],
)
def test_a_claim_of_the_thesis_notices_a_break(
    module: ModuleType, claim: str, name: str, spoil: Spoil, monkeypatch: pytest.MonkeyPatch
) -> None:
    function, *arguments = claim.split()
    assert getattr(module, function)(*arguments).verdict in (HOLDS, CONDITION)
    monkeypatch.setattr(module, name, spoil(getattr(module, name)))
    assert getattr(module, function)(*arguments).verdict == FAILS


def test_a_counterexample_of_the_thesis_that_is_none_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    """A triangle has no third point on a line; the same vertices punched as the judge has are no wrong hull."""
    assert [letter.line_struck_twice().verdict, messages.hull_has_been_determined().verdict] == [FAILS, FAILS]
    monkeypatch.setattr(letter, "points_of", lambda _: [(0, 0, 0), (4, 0, 0), (0, 4, 0), (5, 5, 0)])
    monkeypatch.setattr(messages, "vertices_of", lambda _: ({0, 1}, {0, 1}))
    assert [letter.line_struck_twice().verdict, messages.hull_has_been_determined().verdict] == [HOLDS, HOLDS]


def test_the_first_hull_is_larger_than_that_of_the_six_as_often_as_its_row_says() -> None:
    """More than a fifth of sets at random, in which the six extreme points are in no plane."""
    found = [letter._first_and_six(one.points, one) for one in sampled_sets(3, 200)]
    assert sum(first[0] > six[0] > 0 for first, six in found) > len(found) / 5


def test_the_first_sets_have_points_inside_and_on_the_boundary_and_a_face_of_four_corners() -> None:
    """Else claims on such points and faces would hold of nothing."""
    for dimension in (2, 3):
        judges = [one.judge for one in sampled_sets(dimension, 2)]
        assert all(judge.inside for judge in judges)
        assert any(judge.boundary for judge in judges)
        assert dimension == 2 or any(len(facet.polygon) > 3 for judge in judges for facet in judge.facets)
