"""Spoilers of the checks of chapters 4 to 7 of the thesis."""

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from types import SimpleNamespace

import modern.claims.thesis.chapter7 as chapter7
from modern.claims.algebra import Proof, point
from modern.edition.chapter6 import input_deck
from modern.formats.deck import data_deck
from tests.modern.claims.spoilers import (
    Original,
    Spoiler,
    Table,
    always,
    changed_result,
    check_fails,
    check_holds,
    constant_negated,
    counterexample,
    flattened,
    invalid_step,
    negated,
    plus_one,
    three_vertices,
    without_last_point,
)

EQUAL_VERTICES = ({0, 1}, {0, 1})


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


def failing_proof() -> Proof:
    return Proof("", "", (invalid_step(None)(),))


X = point("x", 3)
D = "thesis."
TABLE: Table = [
    (D + "107", "exact_hull", flattened),
    (D + "245", "convex_hull", without_last_point),
    (D + "146", "convex_hull", without_last_point),
    (D + "109", "theorem_of", changed_result(negated_planes)),
    (D + "111", "exact_hull", without_last_point),
    (D + "233", "exact_hull", flattened),
    (D + "115", "theorem_of", changed_result(negated_planes)),
    (D + "112", "_faces", always(set())),
    (D + "118", "exact_hull", without_last_point),
    (D + "116", "theorem_of", changed_result(negated_planes)),
    (D + "149", "theorem_of", changed_result(negated_planes)),
    (D + "147", "exact_hull", three_vertices),
    (D + "91", "theorem_of", changed_result(negated_planes)),
    (D + "152", "NOT_ACCEPTABLE", lambda _: "error"),
    (D + "151", "theorem_of", changed_result(negated_planes)),
    (D + "150", "_faces", always(set())),
    (D + "277", "_with_0", lambda _: lambda point, axis: point),
    (D + "274", "_with_0", lambda original: lambda point, axis: original(original(point, axis), (axis + 1) % 3)),
    (D + "38", "_goes_through", always(True)),
    (D + "38", "_four_times", lambda original: lambda numbers: original([abs(x) for x in numbers])),
    (D + "138", "plane_value", negated),
    (D + "264", "stage_property", check_fails),
    (D + "113", "theorem_of", changed_result(reversed_points)),
    (D + "114", "theorem_of", changed_result(open_surface)),
    (D + "134", "stage_property", check_fails),
    (D + "144", "stage_property", check_fails),
    (D + "117", "counterexample_points", counterexample((0, 0, 0))),
    (D + "140", "_printed_lines", y1_and_y2_exchanged),
    (D + "141", "_printed_lines", y1_and_y2_exchanged),
    (D + "244", "plane_value", negated),
    (D + "260", "counterexample_points", counterexample((0, 0, 0), (4, 0, 0), (0, 4, 0), (5, 5, 0))),
    (D + "123", "counterexample_points", counterexample((0, 0, 0), (0, 0, 1))),
    (D + "148", "ADDED", lambda original: (*original[:-1], "Q9")),
    (D + "148", "ADDED", lambda original: original[:-1]),
    (D + "137", "largest_value", invalid_step),
    (D + "280", "run_of", run_of_example_4),
    (D + "280", "convex_hull", lambda original: lambda points: replace(original(points), corrected=())),
    (D + "279", "data_deck", extra_card),
    (D + "282", "vertices_of", always(EQUAL_VERTICES)),
    (D + "283", "convex_hull", without_last_point),
    (D + "158", "_digits", always(9)),
    (D + "284", "PLACES", lambda original: original + 1),
    (D + "284", "exact_hull", without_last_point),
    (D + "281", "_first_run", large_exponent),
    (D + "281", "exact_hull", flattened),
    (D + "17", "EXAMPLES", lambda original: original[:-2]),
    (D + "17", "_punched", without_boundary_heading),
    (D + "285", "exact_hull", flattened),
    (D + "285", "prints", misread_eight),
    (D + "178", "_first_run", large_exponent),
    (D + "161", "deck_of", correct_z),
    (D + "160", "coordinate_field", always("+.3000000E+01")),
    (D + "181", "coordinate_field", always("+.12345678E+01")),
    (D + "157", "PLACES", lambda _: 200),
    (D + "185", "_misses", always([])),
    (D + "263", "programs", changed_listings(lambda text: text.replace("INSID=2", "INSID=1"))),
    (D + "186", "_THREE", lambda _: ((0, 0, 0), (1, 0, 0), (0, 1, 0))),
    (D + "65", "programs", changed_listings(lambda text: text.replace("NETC", "NTC"))),
    (D + "189", "dot", negated),
    (D + "189", "plane_through_c", check_holds),
    (D + "190", "plane_through_c", check_holds),
    (D + "190", "plane_through", constant_negated),
    (D + "93", "run_of", run_of_example_4),
    (D + "183", "_misses", always([])),
    (D + "153", "CORE", lambda _: chapter7.SMALLER_CORE),
    (D + "169", "programs", no_code),
    (D + "184", "THREE", lambda original: original[:2]),
    (D + "159", "vertices_of", always(EQUAL_VERTICES)),
    (D + "193", "CORE", lambda _: 200000),
    (D + "84", "vertices_of", always(EQUAL_VERTICES)),
    (D + "249", "take", exact_arithmetic),
    (D + "188", "at", always(1)),
    (D + "187", "convex_hull", always_with_epsilon),
    (D + "187", "convex_hull", without_epsilon),
    (D + "5", "gap_in_4_7", check_fails),
    (D + "139", "lines_of_figure_3", check_fails),
    (D + "243", "lines_of_figure_3", check_fails),
    (D + "242", "_distance_squared", lambda _: lambda x, p, q: Fraction((3 * abs(x[0]) - 2 * x[1] + 5) ** 2, 13)),
    (D + "107", "PLANES", lambda original: original[:-1]),
    (D + "248", "_misses", always([])),
    (D + "179", "_misses", always([])),
    (D + "246", "counterexample", always("-4,4,2\n3,4,-1\n")),
    (D + "247", "counterexample", always("-4,-4,2\n3,4,1\n")),
    (D + "163", "coordinate_field", always("+.3000000E+01")),
    (D + "261", "programs", changed_listings(lambda text: text.replace("SUPPORTING", "SOME"))),
    (
        D + "194",
        "run_hull",
        lambda original: lambda deck, load, options: original(deck, chapter7.programs.program, options),
    ),
    (D + "192", "read_hull", changed_result(lambda hull: replace(hull, vertices=hull.vertices[1:]))),
    (D + "277", "cross", lambda original: lambda u, v: original(u, v)[::-1]),
    (D + "273", "coordinate_planes", lambda _: failing_proof),
    (D + "129", "_c_0", plus_one),
    (D + "50", "counterexample_points", counterexample((0, 0, 0), (0, 0, 0), (0, 0, 0))),
    (D + "287", "_v", lambda original: lambda x, i: original(X, X)),
    (D + "120", "theorem_4_3", lambda _: failing_proof),
    (D + "157", "entries_of_plane_table", always(98)),
    (D + "145", "proofs", lambda _: SimpleNamespace(theorem_4_7=failing_proof)),
]
