"""Spoilers of the checks of Nakamae and Nishita."""

from dataclasses import replace

from modern.papers.nakamae_nishita.crossings import CLEAR
from tests.modern.claims.spoilers import (
    Original,
    Table,
    always,
    changed_result,
    negated,
    value,
)


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


D = "nakamae-nishita."
TABLE: Table = [
    (D + "12", "side", negated),
    (D + "12", "_roof", oblique_roof),
    (D + "13", "crosses", always(False)),
    (D + "14", "crosses", always(False)),
    (D + "21", "line_through", line_without_c),
    (D + "21", "line_through", line_without_b),
    (D + "22", "contour_tables", exchanged),
    (D + "22", "sign", negated),
    (D + "32", "crosses", always(False)),
    (D + "29", "crosses", always(False)),
    (D + "37", "plane_through", negated_coordinates),
    (D + "41", "side", always(1)),
    (D + "41", "lines_of", lambda original: lambda v: [*original(v)[:-1], original(v)[0]]),
    (D + "23", "sign", negated),
    (D + "24", "sign", negated),
    (D + "25", "crosses", always(True)),
    (D + "26", "sign", negated),
    (D + "27", "crosses", always(True)),
    (D + "27", "sign", negated),
    (D + "63", "dot", negated),
    (D + "56", "COUNTS", fewer_corners),
    (D + "48", "_scene", all_rules),
    (D + "20", "_cuboid", lambda original: lambda way: original((1, 1, 1))),
    (D + "10", "_cuboid", oblique_view),
    (D + "16", "_hidden", always(0)),
    (D + "45", "sign", negated),
    (D + "59", "sign", negated),
    (D + "61", "_hidden", always(1)),
    (D + "61", "ENCLOSED", never_enclosed),
    (D + "66", "tables_of", no_zeros),
    (D + "64", "clipped", always(CLEAR)),
    (D + "44", "line_through", negated_coordinates),
    (D + "65", "sign", negated),
    (D + "19", "line_through", negated_coordinates),
    (D + "42", "side", always(1)),
    (D + "35", "_scene", all_rules),
    (D + "11", "_behind", always(False)),
    (D + "3", "_behind", always(True)),
    (D + "39", "_polyhedra", lambda original: lambda boxes, thing: original(boxes)),
    (D + "17", "BY_FACE", value("")),
    (D + "18", "side", negated),
]
