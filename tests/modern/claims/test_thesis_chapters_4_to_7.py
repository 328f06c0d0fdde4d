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
        ("thesis.107", "exact_hull", flattened),
        ("thesis.245", "convex_hull", without_last_point),
        ("thesis.146", "convex_hull", without_last_point),
        (
            "thesis.109",
            "theorem_of",
            changed_result(negated_planes),
        ),
        ("thesis.111", "exact_hull", without_last_point),
        ("thesis.233", "exact_hull", flattened),
        ("thesis.115", "theorem_of", changed_result(negated_planes)),
        ("thesis.112", "_faces", always(set())),
        ("thesis.118", "exact_hull", without_last_point),
        ("thesis.116", "theorem_of", changed_result(negated_planes)),
        ("thesis.149", "theorem_of", changed_result(negated_planes)),
        ("thesis.147", "exact_hull", three_vertices),
        ("thesis.91", "theorem_of", changed_result(negated_planes)),
        ("thesis.152", "NOT_ACCEPTABLE", lambda _: "error"),
        ("thesis.151", "theorem_of", changed_result(negated_planes)),
        ("thesis.150", "_faces", always(set())),
        ("thesis.277", "_with_0", lambda _: lambda point, axis: point),
        (
            "thesis.274",
            "_with_0",
            lambda original: lambda point, axis: original(original(point, axis), (axis + 1) % 3),
        ),
        ("thesis.38", "_goes_through", always(True)),
        (
            "thesis.38",
            "_four_times",
            lambda original: lambda numbers: original([abs(x) for x in numbers]),
        ),
        ("thesis.138", "plane_value", negated),
        ("thesis.132", "plane_value", negated),
        ("thesis.126", "plane_through", constant_plus_one),
        ("thesis.235", "cross", sum_instead_of_product),
        ("thesis.120", "cross", sum_instead_of_product),
        ("thesis.234", "cross", sum_instead_of_product),
        ("thesis.5", "gap_in_4_7", check_fails),
        ("thesis.113", "theorem_of", changed_result(reversed_points)),
        ("thesis.114", "theorem_of", changed_result(open_surface)),
        ("thesis.134", "stage_property", check_fails),
        ("thesis.139", "lines_of_figure_3", check_fails),
        ("thesis.144", "stage_property", check_fails),
        ("thesis.117", "counterexample_points", counterexample((0, 0, 0))),
        ("thesis.140", "_printed_lines", y1_and_y2_exchanged),
        ("thesis.141", "_printed_lines", y1_and_y2_exchanged),
        ("thesis.244", "plane_value", negated),
        (
            "thesis.260",
            "counterexample_points",
            counterexample((0, 0, 0), (4, 0, 0), (0, 4, 0), (5, 5, 0)),
        ),
        ("thesis.128", "_c_0", plus_one),
        (
            "thesis.130",
            "plane_through",
            lambda original: lambda p, q, r: original(q, p, r),
        ),
        ("thesis.129", "_c_0", plus_one),
        ("thesis.123", "counterexample_points", counterexample((0, 0, 0), (0, 0, 1))),
        ("thesis.148", "ADDED", lambda original: (*original[:-1], "Q9")),
        ("thesis.148", "ADDED", lambda original: original[:-1]),
        ("thesis.119", "value_v", check_fails),
        ("thesis.236", "exact_hull", all_points_vertices),
        ("thesis.238", "plane_value", negated),
        ("thesis.259", "plane_value", always(1)),
        ("thesis.108", "exact_hull", three_dimensional),
        ("thesis.252", "_WORKS", lambda original: {**original, 6: 200}),
        ("thesis.252", "_CITED", lambda original: {**original, 12: (3,)}),
        ("thesis.280", "run_of", run_of_example_4),
        (
            "thesis.280",
            "convex_hull",
            lambda original: lambda points: replace(original(points), corrected=()),
        ),
        ("thesis.279", "data_deck", extra_card),
        ("thesis.282", "vertices_of", always(EQUAL_VERTICES)),
        ("thesis.283", "convex_hull", without_last_point),
        ("thesis.158", "take", exact_arithmetic),
        ("thesis.284", "PLACES", lambda original: original + 1),
        ("thesis.284", "exact_hull", without_last_point),
        ("thesis.281", "_first_run", large_exponent),
        ("thesis.281", "exact_hull", flattened),
        ("thesis.17", "EXAMPLES", lambda original: original[:-2]),
        ("thesis.17", "_punched", without_boundary_heading),
        ("thesis.285", "exact_hull", flattened),
        ("thesis.285", "prints", misread_eight),
        ("thesis.178", "_first_run", large_exponent),
        ("thesis.195", "at", always(0)),
        ("thesis.196", "_equations_made", always(0)),
        ("thesis.162", "data_deck", full_card),
        ("thesis.161", "deck_of", correct_z),
        ("thesis.163", "coordinate_field", always("+.3000000E+01")),
        ("thesis.160", "coordinate_field", always("+.3000000E+01")),
        ("thesis.181", "coordinate_field", always("+.12345678E+01")),
        ("thesis.157", "_most_planes", always(98)),
        ("thesis.157", "PLACES", lambda _: 200),
        ("thesis.185", "_misses", always([])),
        (
            "thesis.263",
            "programs",
            changed_listings(lambda text: text.replace("INSID=2", "INSID=1")),
        ),
        ("thesis.186", "_THREE", lambda _: ((0, 0, 0), (1, 0, 0), (0, 1, 0))),
        ("thesis.65", "programs", changed_listings(lambda text: text.replace("NETC", "NTC"))),
        ("thesis.189", "dot", negated),
        ("thesis.189", "plane_through_c", check_holds),
        ("thesis.190", "plane_through_c", check_holds),
        ("thesis.190", "plane_through", constant_negated),
        ("thesis.93", "run_of", run_of_example_4),
        ("thesis.183", "_misses", always([])),
        ("thesis.153", "CORE", lambda _: chapter7.SMALLER_CORE),
        ("thesis.169", "programs", no_code),
        ("thesis.207", "programs", no_code),
        ("thesis.184", "THREE", lambda original: original[:2]),
        ("thesis.182", "take", exact_arithmetic),
        ("thesis.159", "vertices_of", always(EQUAL_VERTICES)),
        ("thesis.193", "CORE", lambda _: 200_000),
        ("thesis.84", "vertices_of", always(EQUAL_VERTICES)),
        ("thesis.249", "take", exact_arithmetic),
        ("thesis.248", "take", exact_arithmetic),
        ("thesis.188", "at", always(1)),
        ("thesis.187", "convex_hull", always_with_epsilon),
        ("thesis.187", "convex_hull", without_epsilon),
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
