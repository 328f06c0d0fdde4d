"""The claims of Nakamae and Nishita change their verdict when what they rely on is spoiled."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest

import modern.claims.nakamae_nishita.tables as tables
import modern.claims.nakamae_nishita.visibility as visibility
from modern.papers.nakamae_nishita.contours import Tables
from modern.papers.nakamae_nishita.crossings import CLEAR, Passage
from modern.papers.nakamae_nishita.hidden import draw
from modern.papers.nakamae_nishita.projection import parallel
from modern.papers.nakamae_nishita.shapes import cuboid
from tests.modern.claims.spoilers import (
    Original,
    Spoiler,
    always,
    assert_verdict_changes,
    changed_result,
    negated,
)


def view_along_axis(_: Original) -> object:
    return lambda: draw(lambda: [cuboid("box", *map(Fraction, (2, 3, 4)))], parallel((0, 0, 1)))


def oblique_view(original: Original) -> object:
    return lambda *direction: original()


def oblique_roof(original: Original) -> object:
    """View the roof so that no face is seen edge-on."""
    return lambda: (*original()[:2], (31, 17))


@changed_result
def no_zeros(both_tables: Original) -> object:
    return tuple([[sign or 1 for sign in row] for row in table] for table in both_tables)


def all_rules(original: Original) -> object:
    return lambda name, *without: original(name)


def fewer_corners(original: Original) -> object:
    return {**original, "d": (30, 190, 158)}


@changed_result
def exchanged(contour_tables: Original) -> object:
    return replace(contour_tables, pl=contour_tables.lp, lp=contour_tables.pl)


@changed_result
def negated_coordinates(line: Original) -> object:
    return tuple(-coordinate for coordinate in line)


def line_without_c(original: Original) -> object:
    """Apply formula (1) to lines through the origin only."""
    return lambda a, b: (*original(a, b)[:2], 0)


def line_without_b(original: Original) -> object:
    return lambda a, b: (original(a, b)[0], 0, original(a, b)[2])


def never_enclosed(_: Original) -> object:
    """Count the edges wholly inside as clear."""
    return CLEAR


@pytest.mark.parametrize(
    ("claim", "attribute", "spoiler"),
    [
        ("nakamae_nishita.tables.convex_contour", "side", negated),
        ("nakamae_nishita.tables.convex_contour", "_roof", oblique_roof),
        ("nakamae_nishita.tables.correlations", "crosses", always(False)),
        ("nakamae_nishita.tables.correlations figure", "crosses", always(False)),
        ("nakamae_nishita.tables.formula 1", "line_through", line_without_c),
        ("nakamae_nishita.tables.formula 1", "line_through", line_without_b),
        ("nakamae_nishita.tables.formula 2", "contour_tables", exchanged),
        ("nakamae_nishita.tables.formula 2", "sign", negated),
        ("nakamae_nishita.tables.formula 3", "crosses", always(False)),
        ("nakamae_nishita.tables.formula 3 in_line", "crosses", always(False)),
        ("nakamae_nishita.tables.formula 5", "plane_through", negated_coordinates),
        ("nakamae_nishita.tables.intersection_counts", "side", always(1)),
        (
            "nakamae_nishita.tables.intersection_counts",
            "lines_of",
            lambda original: lambda v: [*original(v)[:-1], original(v)[0]],
        ),
        ("nakamae_nishita.tables.overlap_in_line", "SQUARE", lambda _: ((0, 0), (0, 5), (4, 3), (4, 0))),
        ("nakamae_nishita.tables.table_properties 1", "sign", negated),
        ("nakamae_nishita.tables.table_properties 2", "sign", negated),
        ("nakamae_nishita.tables.table_properties 3", "crosses", always(True)),
        ("nakamae_nishita.tables.table_properties 4", "sign", negated),
        ("nakamae_nishita.tables.table_properties LP", "crosses", always(True)),
        ("nakamae_nishita.tables.table_properties LP", "sign", negated),
        ("nakamae_nishita.visibility.convex_faces", "dot", negated),
        ("nakamae_nishita.visibility.counts_of_table_1d", "COUNTS", fewer_corners),
        ("nakamae_nishita.visibility.edges_wholly_behind", "_scene", all_rules),
        ("nakamae_nishita.visibility.faces_and_edges", "_cuboid", view_along_axis),
        ("nakamae_nishita.visibility.faces_and_edges condition", "_cuboid", oblique_view),
        (
            "nakamae_nishita.visibility.hidden_contour_edges",
            "_hidden",
            lambda _: lambda drawing, kind: int(kind == visibility.INNER),
        ),
        ("nakamae_nishita.visibility.indices", "sign", negated),
        ("nakamae_nishita.visibility.indices k", "sign", negated),
        ("nakamae_nishita.visibility.nearer_contour_inside", "_hidden", always(1)),
        ("nakamae_nishita.visibility.nearer_contour_inside", "ENCLOSED", never_enclosed),
        ("nakamae_nishita.visibility.overlap_by_neighbours", "tables_of", no_zeros),
        ("nakamae_nishita.visibility.segments_within", "clipped", always(CLEAR)),
        ("nakamae_nishita.visibility.sense_of_intersection", "line_through", negated_coordinates),
        ("nakamae_nishita.visibility.table_by_formula_4", "sign", negated),
        (
            "nakamae_nishita.visibility.three_collinear_points",
            "line_through",
            lambda original: lambda *points: (*original(*points)[:2], 1),
        ),
        ("nakamae_nishita.visibility.three_conditions", "side", always(1)),
        ("nakamae_nishita.visibility.touching_solids", "_scene", all_rules),
        ("nakamae_nishita.visibility.touching_solids fails", "_scene", all_rules),
    ],
)
def test_verdict_changes_with_spoiled_attribute(claim: str, attribute: str, spoiler: Spoiler) -> None:
    assert_verdict_changes(claim, attribute, spoiler)


def test_indices_must_count_the_intersections(monkeypatch: pytest.MonkeyPatch) -> None:
    original = visibility.clipped

    def without_count(values: list[list[int]], first: int, last: int) -> Passage:
        passage = original(values, first, last)
        return replace(passage, marks=tuple((place, 1 if index > 0 else -1) for place, index in passage.marks))

    monkeypatch.setattr(visibility, "clipped", without_count)
    assert [visibility.indices().holds, visibility.three_conditions().holds] == [False, False]


@pytest.mark.parametrize(("number", "wrong"), [(-2, -1), (-1, 0), (0, -1), (-4, -2)])
def test_wrong_crossing_number_fails(number: int, wrong: int, monkeypatch: pytest.MonkeyPatch) -> None:
    original = Tables.crossing_number

    def spoiled(contours: Tables, i: int, j: int) -> int:
        crossing_number = original(contours, i, j)
        return wrong if crossing_number == number else crossing_number

    monkeypatch.setattr(Tables, "crossing_number", spoiled)
    assert not tables.formula("3").holds


def test_condition_of_property_3_is_about_polygons_that_touch(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without polygons that touch, property 3 holds as printed and the list of three correlations is complete."""
    apart = [(tables.SQUARE, tables.BESIDE), (tables.SQUARE, tables.WITHIN), (tables.SQUARE, tables.ACROSS)]
    assert [bool(tables.table_properties(name).evidence.violation) for name in ("3", "LP")] == [True] * 2
    monkeypatch.setattr(tables, "pairs", lambda: iter(apart))
    assert [bool(tables.table_properties(name).evidence.violation) for name in ("3", "LP")] == [False] * 2
    assert not tables.correlations().holds


def test_touching_pair_of_the_row_has_a_column_without_minus_one() -> None:
    """Column 0 of PL has no -1, and two values of d are -2."""
    pl, _ = tables.tables_of(tables.SQUARE, tables.AGAINST)
    assert [row[0] for row in pl] == [0, 1, 1, 1]
    numbers = [d for d, _ in tables.numbers_of_meetings(tables.SQUARE, tables.AGAINST)]
    assert numbers.count(-2) == 2


def test_contour_with_a_dent_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    """Count one front face as a back face."""
    original = tables.dot
    front_faces = [0]

    def spoiled(a: Original, b: Original) -> int:
        front_faces[0] += original(a, b) > 0
        return -1 if front_faces[0] == 2 else original(a, b)

    monkeypatch.setattr(tables, "dot", spoiled)
    assert not tables.convex_contour().holds
