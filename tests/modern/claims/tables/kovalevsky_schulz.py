"""Spoilers of the checks of Kovalevsky and Schulz."""

from dataclasses import replace
from fractions import Fraction

from modern.digital.solids import half_ball, listed
from modern.papers.kovalevsky_schulz import CENTRES, VISIBLE
from modern.papers.kovalevsky_schulz.coplanar import EXTENDED, QUADRANGLES
from modern.papers.kovalevsky_schulz.hull import merged
from tests.modern.claims.spoilers import (
    Original,
    Spoiler,
    Table,
    all_points_vertices,
    always,
    changed_result,
    identity,
    invalid_step,
    negated,
    plus_one,
    without_last_point,
)


def merged_immediately(original: Original) -> object:
    """Merge coplanar triangles at once."""
    return lambda points, *coplanar: merged(original(points, *coplanar))


def only_as(treatment: object) -> Spoiler:
    """Use one treatment of coplanar faces only."""
    return lambda original: lambda points, _: original(points, treatment)


@changed_result
def integer_less_at_18(table: Original) -> object:
    return (*table[:5], (*table[5][:3], table[5][3] - 99), *table[6:])


def chebyshev_neighbours(_: Original) -> object:
    return lambda a, b: a != b and max(abs(x - y) for x, y in zip(a, b, strict=True)) <= 1


def centres_only(original: Original) -> object:
    return lambda solid, of: original(solid, CENTRES)


def sign_by_first_coordinate(_: Original) -> object:
    return lambda plane, point: 1 - 2 * (plane[0] % 2)


def plain_product(_: Original) -> object:
    return lambda u, v: sum(Fraction(a) * b for a, b in zip(u, v, strict=True))


def corners_moved(original: Original) -> object:
    return lambda corners: original(corners + 1)


def one_axis(original: Original) -> object:
    return lambda voxel: original(voxel)[:1]


def opposite_sides_of_one_axis(_: Original) -> object:
    return lambda voxel: [(n, 2, 2) for n in (0, 1)]


def with_diagonals(_: Original) -> object:
    return lambda cell, corner: max(abs(a - b) for a, b in zip(cell, corner, strict=True)) == 1


@changed_result
def without_last_face(cells: Original) -> object:
    return replace(cells, faces=cells.faces[:-1])


def all_of_26(original: Original) -> object:
    """Return every voxel as a local corner by 26 neighbours."""
    return lambda solid, of=CENTRES, n=26: {*solid} if n == 26 else original(solid, of, n)


def all_points_inside(original: Original) -> object:
    return lambda points: replace(original(points), vertices=())


S = "kovalevsky-schulz."
TABLE: Table = [
    (S + "7", "_local", always(set())),
    (S + "6", "local_corners", always(range(9999))),
    (S + "19", "_local", always(set())),
    (S + "18", "_local", all_of_26),
    (S + "23", "_local", identity),
    (S + "34", "_corners", lambda _: set),
    (S + "21", "local_corners", always(())),
    (S + "22", "triangles_of_ball", always(1404)),
    (S + "24", "_placed", centres_only),
    (S + "12", "plane_value", always(1)),
    (S + "28", "_local", always({(9, 9, 9)})),
    (S + "155", "_neighbours", one_axis),
    (S + "154", "_neighbours", opposite_sides_of_one_axis),
    (S + "27", "cells_of", always(8 * 10**9)),
    (S + "175", "ends_at", with_diagonals),
    (S + "32", "_placed", always({(0, 0, 0)})),
    (S + "33", "_placed", always({(0, 0, 0)})),
    (S + "174", "_placed", centres_only),
    (S + "152", "incident", chebyshev_neighbours),
    (S + "137", "incident", always(True)),
    (S + "67", "exact_hull", all_points_vertices),
    (S + "67", "cross", always((0, 0, 0))),
    (S + "120", "plane_value", always(-1)),
    (S + "65", "largest_value", invalid_step),
    (S + "70", "plane_value", always(-1)),
    (S + "151", "convex_polyhedron", corners_moved),
    (S + "76", "plane_value", sign_by_first_coordinate),
    (S + "73", "_cosine", plain_product),
    (S + "122", "_cosine", always(Fraction(1, 2))),
    (S + "77", "plane_value", negated),
    (S + "1", "independent", lambda _: lambda points: [0, 1, 2, 3]),
    (S + "53", "merged", identity),
    (S + "156", "independent", lambda _: lambda points: [0, 1, 2]),
    (S + "50", "plane_value", negated),
    (S + "161", "plane_value", negated),
    (S + "52", "exact_hull", all_points_vertices),
    (S + "54", "polyhedron", merged_immediately),
    (S + "63", "merged", without_last_face),
    (S + "56", "_created", always(1)),
    (S + "58", "coplanar_hull", only_as(QUADRANGLES)),
    (S + "60", "coplanar_hull", only_as(QUADRANGLES)),
    (S + "55", "coplanar_hull", only_as(EXTENDED)),
    (S + "163", "coplanar_hull", without_last_point),
    (S + "165", "coplanar_hull", without_last_point),
    (S + "44", "expanded", lambda original: lambda e: original(replace(e, faces=e.faces[::-1]))),
    (S + "46", "ball", lambda original: lambda d: listed([(0, 0, 0), (2, 0, 0), (0, 1, 0), (0, 0, 1)])),
    (S + "99", "reconstructed", always(listed([(0, 0, 0)]))),
    (S + "146", "exact_hull", all_points_vertices),
    (S + "78", "polyhedron", merged_immediately),
    (S + "78", "triangulation_size", plus_one),
    (S + "91", "_table_5", integer_less_at_18),
    (S + "100", "triangulation_size", always(0)),
    (S + "96", "_is_symmetric", always(True)),
    (S + "86", "may_be_convex", always(True)),
    (S + "87", "cell_list_size", always(0)),
    (S + "88", "digitisations", lambda _: lambda diameter: [half_ball(diameter)]),
    (S + "157", "polyhedron", lambda original: lambda points: original(points[1:])),
    (S + "64", "hull_of_ball", lambda original: lambda diameter, *_: original(diameter, 6, VISIBLE)),
    (S + "71", "plane_through", always((0, 0, 1, 0))),
    (S + "72", "plane_value", always(1)),
    (S + "15", "exact_hull", all_points_inside),
    (S + "80", "half_ball_cells", lambda original: lambda diameter: original(8)),
    (S + "69", "largest_value", invalid_step),
    (S + "71", "dot", lambda original: lambda u, v: original(u, v) + 1),
]
