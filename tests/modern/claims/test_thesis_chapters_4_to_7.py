"""The claims of chapters 4 to 7 of the thesis change their verdict when what they rely on is spoiled."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace

import pytest

import modern.claims.thesis.chapter4_examples as examples
import modern.claims.thesis.chapter4_theorems as theorems
import modern.claims.thesis.chapter7 as chapter7
from modern.claims.sampled_sets import counterexample as counterexample_text
from modern.edition.chapter6 import input_deck
from modern.formats.deck import data_deck
from tests.modern.claims.spoilers import (
    Original,
    Spoiler,
    all_points_vertices,
    always,
    assert_verdict_changes,
    changed_result,
    check_fails,
    check_holds,
    constant_negated,
    constant_plus_one,
    counterexample,
    flattened,
    negated,
    plus_one,
    sum_instead_of_product,
    three_vertices,
    without_last_point,
)

EQUAL_VERTICES = ({0, 1}, {0, 1})


def three_dimensional(original: Original) -> object:
    return lambda points: replace(original(points), dimension=3)


def negated_planes(theorem: Original) -> object:
    planes = (replace(plane, coefficients=tuple(-c for c in plane.coefficients)) for plane in theorem.planes)
    return replace(theorem, planes=tuple(planes))


def reversed_points(theorem: Original) -> object:
    return replace(theorem, points=theorem.points[::-1])


def open_surface(theorem: Original) -> object:
    return replace(theorem, planes=theorem.planes[:-1])


def run_of_example_4(_: Original) -> object:
    return lambda name: chapter7.run_hull(input_deck(4), chapter7.programs.program)


def changed_listings(change: Callable[[str], str]) -> Spoiler:
    """Change the cards of all listings."""

    def spoiler(original: Original) -> object:
        def deck(name: str) -> object:
            cards = [SimpleNamespace(text=change(card.text)) for card in original.deck(name).cards]
            return SimpleNamespace(cards=cards, text=lambda: "\n".join(card.text for card in cards))

        return SimpleNamespace(deck=deck, program=original.program)

    return spoiler


def no_code(original: Original) -> object:
    return SimpleNamespace(deck=original.deck, program=lambda name: SimpleNamespace(code=()))


def exact_arithmetic(original: Original) -> object:
    return lambda rows, name: original(rows, "exact")


def full_card(_: Original) -> object:
    return lambda rows, name: SimpleNamespace(cards=[SimpleNamespace(text="1" * 80)])


def correct_z(_: Original) -> object:
    return lambda name: data_deck([["1", "1", "1"]] * 3, "right")


def y1_and_y2_exchanged(original: Original) -> object:
    return lambda x1, y1, y2: original(x1, y2, y1)


def large_exponent(original: Original) -> object:
    return lambda exponent: original("E+01")


def without_epsilon(original: Original) -> object:
    return lambda points, **named: original(points)


def always_with_epsilon(original: Original) -> object:
    return lambda points, **named: original(points, epsilon="20")


def misread_eight(original: Original) -> object:
    """Print 9 for 8."""
    return lambda example: (
        replace(printed, lines=tuple(line.replace(" .80000000E+01", " .90000000E+01") for line in printed.lines))
        for printed in original(example)
    )


def extra_card(original: Original) -> object:
    return lambda points, name: original([*points, points[0]], name)


def without_boundary_heading(original: Original) -> object:
    return lambda printed: tuple(line for line in original(printed) if "BOUNDARY" not in line)


@pytest.mark.parametrize(
    ("claim", "attribute", "spoiler"),
    [
        ("thesis.chapter4_examples.number_of_extremes six_extremes", "exact_hull", flattened),
        ("thesis.chapter4_examples.procedure_of_4_8", "convex_hull", without_last_point),
        ("thesis.chapter4_examples.procedure_of_4_8 theorem", "convex_hull", without_last_point),
        (
            "thesis.chapter4_examples.worked_example 4.1 equations condition",
            "theorem_of",
            changed_result(negated_planes),
        ),
        ("thesis.chapter4_examples.worked_example 4.1 programs", "exact_hull", without_last_point),
        ("thesis.chapter4_examples.worked_example 4.1 six_extremes", "exact_hull", flattened),
        ("thesis.chapter4_examples.worked_example 4.2 equations", "theorem_of", changed_result(negated_planes)),
        ("thesis.chapter4_examples.worked_example 4.2 not_supporting", "_faces", always(set())),
        ("thesis.chapter4_examples.worked_example 4.2 programs", "exact_hull", without_last_point),
        ("thesis.chapter4_examples.worked_example 4.2 signs", "theorem_of", changed_result(negated_planes)),
        ("thesis.chapter4_examples.worked_example 4.8 equations", "theorem_of", changed_result(negated_planes)),
        ("thesis.chapter4_examples.worked_example 4.8 growing", "exact_hull", three_vertices),
        ("thesis.chapter4_examples.worked_example 4.8 last_outside", "theorem_of", changed_result(negated_planes)),
        ("thesis.chapter4_examples.worked_example 4.8 programs", "NOT_ACCEPTABLE", lambda _: "error"),
        ("thesis.chapter4_examples.worked_example 4.8 signs", "theorem_of", changed_result(negated_planes)),
        ("thesis.chapter4_examples.worked_example 4.8 supporting", "_faces", always(set())),
        ("thesis.projections.coordinate_planes", "_with_0", lambda _: lambda point, axis: point),
        (
            "thesis.projections.hull_of_projection",
            "_with_0",
            lambda original: lambda point, axis: original(original(point, axis), (axis + 1) % 3),
        ),
        ("thesis.projections.inside_nonconvex_polyhedron", "_goes_through", always(True)),
        (
            "thesis.projections.inside_nonconvex_polyhedron",
            "_four_times",
            lambda original: lambda numbers: original([abs(x) for x in numbers]),
        ),
        ("thesis.chapter4_theorems.choice_of_first_triangle", "plane_value", negated),
        ("thesis.chapter4_theorems.combinations_inside", "plane_value", negated),
        ("thesis.projections.constant_term_of_4_4", "plane_through", constant_plus_one),
        ("thesis.chapter4_theorems.distance_by_cosines", "cross", sum_instead_of_product),
        ("thesis.chapter4_theorems.distance_by_cosines display", "cross", sum_instead_of_product),
        ("thesis.chapter4_theorems.distance_by_cosines substituted", "cross", sum_instead_of_product),
        ("thesis.chapter4_theorems.eight_theorems", "gap_in_4_7", check_fails),
        ("thesis.chapter4_theorems.extremes_4_2", "theorem_of", changed_result(reversed_points)),
        ("thesis.chapter4_theorems.figure 1", "theorem_of", changed_result(open_surface)),
        ("thesis.chapter4_theorems.figure 2", "stage_property", check_fails),
        ("thesis.chapter4_theorems.figure 3", "lines_of_figure_3", check_fails),
        ("thesis.chapter4_theorems.figure 4", "stage_property", check_fails),
        ("thesis.chapter4_theorems.inequalities_without_z", "counterexample_points", counterexample((0, 0, 0))),
        ("thesis.chapter4_theorems.lines_of_figure_3", "_printed_lines", y1_and_y2_exchanged),
        ("thesis.chapter4_theorems.lines_of_figure_3 condition", "_printed_lines", y1_and_y2_exchanged),
        ("thesis.chapter4_theorems.origin_is_third_point", "plane_value", negated),
        (
            "thesis.chapter4_theorems.outside_unreplaced_line",
            "counterexample_points",
            counterexample((0, 0, 0), (4, 0, 0), (0, 4, 0), (5, 5, 0)),
        ),
        ("thesis.chapter4_theorems.proof_of_4_4 coefficient", "_c_0", plus_one),
        (
            "thesis.chapter4_theorems.proof_of_4_4 letters",
            "plane_through",
            lambda original: lambda p, q, r: original(q, p, r),
        ),
        ("thesis.chapter4_theorems.proof_of_4_4 sum", "_c_0", plus_one),
        ("thesis.chapter4_theorems.sign_e", "counterexample_points", counterexample((0, 0, 0), (0, 0, 1))),
        ("thesis.chapter4_theorems.single_point_outside", "ADDED", lambda original: (*original[:-1], "Q9")),
        ("thesis.chapter4_theorems.single_point_outside", "ADDED", lambda original: original[:-1]),
        ("thesis.chapter4_theorems.theorem_4_3", "value_v", check_fails),
        ("thesis.projections.theorem_4_4", "exact_hull", all_points_vertices),
        ("thesis.chapter4_theorems.theorem_4_5", "plane_value", negated),
        ("thesis.chapter4_theorems.theorem_4_7", "plane_value", always(1)),
        ("thesis.chapter4_theorems.three_points_coplanar", "exact_hull", three_dimensional),
        ("thesis.chapter5.cited_pages", "_WORKS", lambda original: {**original, 6: 200}),
        ("thesis.chapter5.cited_pages", "_CITED", lambda original: {**original, 12: (3,)}),
        ("thesis.chapter5.error_in_program", "run_of", run_of_example_4),
        (
            "thesis.chapter5.error_in_program",
            "convex_hull",
            lambda original: lambda points: replace(original(points), corrected=()),
        ),
        ("thesis.chapter5.first_card", "data_deck", extra_card),
        ("thesis.chapter5.message_after_wrong_hull", "vertices_of", always(EQUAL_VERTICES)),
        ("thesis.chapter5.line_table_size", "convex_hull", without_last_point),
        ("thesis.chapter5.ninth_digit_of_product", "take", exact_arithmetic),
        ("thesis.chapter5.plane_table_size", "PLACES", lambda original: original + 1),
        ("thesis.chapter5.plane_table_size", "exact_hull", without_last_point),
        ("thesis.chapter5.points_are_coplanar", "_first_run", large_exponent),
        ("thesis.chapter5.points_are_coplanar", "exact_hull", flattened),
        ("thesis.chapter5.possible_output", "EXAMPLES", lambda original: original[:-2]),
        ("thesis.chapter5.possible_output", "_punched", without_boundary_heading),
        ("thesis.chapter5.printed_hulls", "exact_hull", flattened),
        ("thesis.chapter5.printed_hulls", "prints", misread_eight),
        ("thesis.chapter5.underflow", "_first_run", large_exponent),
        ("thesis.chapter7.cost_of_orientation", "at", always(0)),
        ("thesis.chapter7.cost_of_translation", "_equations_made", always(0)),
        ("thesis.chapter7.data_sheet blank", "data_deck", full_card),
        ("thesis.chapter7.data_sheet columns", "deck_of", correct_z),
        ("thesis.chapter7.data_sheet digits", "coordinate_field", always("+.3000000E+01")),
        ("thesis.chapter7.data_sheet values", "coordinate_field", always("+.3000000E+01")),
        ("thesis.chapter7.eight_digits", "coordinate_field", always("+.12345678E+01")),
        ("thesis.chapter7.fifty_one_points", "_most_planes", always(98)),
        ("thesis.chapter7.fifty_one_points", "PLACES", lambda _: 200),
        ("thesis.chapter7.fourth_point_off_plane", "_misses", always([])),
        (
            "thesis.chapter7.inside_heading",
            "programs",
            changed_listings(lambda text: text.replace("INSID=2", "INSID=1")),
        ),
        ("thesis.chapter7.interval_instead_of_rejection", "_THREE", lambda _: ((0, 0, 0), (1, 0, 0), (0, 1, 0))),
        ("thesis.chapter7.notation", "programs", changed_listings(lambda text: text.replace("NETC", "NTC"))),
        ("thesis.chapter7.orientation_by_c", "dot", negated),
        ("thesis.chapter7.orientation_by_c", "plane_through_c", check_holds),
        ("thesis.chapter7.orientation_by_constant_term", "plane_through_c", check_holds),
        ("thesis.chapter7.orientation_by_constant_term", "plane_through", constant_negated),
        ("thesis.chapter7.plane_through_c", "run_of", run_of_example_4),
        ("thesis.chapter7.points_off_own_plane", "_misses", always([])),
        ("thesis.chapter7.program_sizes", "CORE", lambda _: chapter7.SMALLER_CORE),
        ("thesis.chapter7.programs_compile", "programs", no_code),
        ("thesis.chapter7.programs_compile condition", "programs", no_code),
        ("thesis.chapter7.programs_rejecting_data", "THREE", lambda original: original[:2]),
        ("thesis.chapter7.quotient_truncated", "take", exact_arithmetic),
        ("thesis.chapter7.silent_loss", "vertices_of", always(EQUAL_VERTICES)),
        ("thesis.chapter7.three_programs_needed", "CORE", lambda _: 200_000),
        ("thesis.chapter7.truncated_roots", "vertices_of", always(EQUAL_VERTICES)),
        ("thesis.chapter7.two_kinds_of_error", "take", exact_arithmetic),
        ("thesis.chapter7.two_kinds_of_error device", "take", exact_arithmetic),
        ("thesis.chapter7.value_against_distance", "at", always(1)),
        ("thesis.chapter7.vertex_within_interval", "convex_hull", always_with_epsilon),
        ("thesis.chapter7.vertex_within_interval", "convex_hull", without_epsilon),
    ],
)
def test_verdict_changes_with_spoiled_attribute(claim: str, attribute: str, spoiler: Spoiler) -> None:
    assert_verdict_changes(claim, attribute, spoiler)


@pytest.mark.parametrize("kind", ["", "bars"])
def test_distance_must_be_measured_from_the_line(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(theorems, "_distance_squared", lambda x, p, q: (x[0] - p[0]) ** 2 + (x[1] - p[1]) ** 2)
    assert not theorems.theorem_4_6(kind).holds


@pytest.mark.parametrize(("text", "place"), [("-4,4,2\n3,4,-1\n", "list"), ("-4,-4,2\n3,4,1\n", "table")])
def test_corrected_slips_of_4_8_are_not_counterexamples(text: str, place: str, monkeypatch: pytest.MonkeyPatch) -> None:
    assert counterexample_text("slips_4_8.csv") == "-4,-4,2\n3,4,-1\n"
    monkeypatch.setattr(examples, "counterexample", lambda _: text)
    assert examples.slips_of_4_8(place).holds
