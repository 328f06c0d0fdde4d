"""Claims of the four papers notice a break: each on what it says is so, and on the same thing spoiled."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from types import ModuleType
from typing import Any

import numpy as np
import pytest

import modern.claims.appel_will.steps as details
import modern.claims.appel_will.surfaces as objects
import modern.claims.kovalevsky_schulz.complexes as complexes
import modern.claims.kovalevsky_schulz.polyhedra as kovalevsky
import modern.claims.kovalevsky_schulz.raster as raster
import modern.claims.nakamae_nishita.tables as tables
import modern.claims.nakamae_nishita.visibility as nakamae
import modern.claims.yau_srihari.convexity as convexity
import modern.claims.yau_srihari.envelopes as yau
from modern.claims.register import CONDITION, FAILS, HOLDS
from modern.digital.solids import Volume, listed
from modern.papers.appel_will.corners import preprocess
from modern.papers.appel_will.results import Solid
from modern.papers.kovalevsky_schulz import CENTRES
from modern.papers.yau_srihari.octree import octree

Right = Any


def without_the_root(_: Right) -> object:
    """l is the square of the length."""

    def direction(p: Right, q: Right) -> tuple[Fraction, Fraction, Fraction, int]:
        square = sum((b - a) ** 2 for a, b in zip(p, q, strict=True))
        x, y, z = (Fraction(b - a, square) for a, b in zip(p, q, strict=True))
        return x, y, z, square

    return direction


def without_the_sign(right: Right) -> object:
    """d is a x0 + b y0 + c z0."""
    return lambda *points: (*right(*points)[:3], -right(*points)[3])


def apexes_in_one_plane(_: Right) -> object:
    """Three pits reach the surfaces of the fourth."""
    faces = list(objects.PITS)
    return dict(zip(faces, [(5, 5, 1), (5, 1, 5), (1, 5, 5), (3, 3, 3)], strict=True))


def an_apex_outside(right: Right) -> object:
    """One pit is a spike."""
    return {**right, (1, 2, 3): (5, 5, 5)}


def a_convex_object(_: Right) -> object:
    """Its points alone say what it is."""
    return lambda: Solid(objects.TETRAHEDRON, tuple(objects.PITS))


def corners_that_are_not_kept(right: Right) -> object:
    """Rule two deletes as rule any."""
    return lambda points, surfaces, rule: right(points, surfaces, "any")


def none_deleted(right: Right) -> object:
    """No rule deletes anything."""
    return lambda points, surfaces, rule: right(points, surfaces, "two" if rule == "any" else rule)


def the_surfaces_exchanged_without_effect(right: Right) -> object:
    """The product is its own amount."""
    return lambda *vectors: abs(right(*vectors))


def always_outside(_: Right) -> object:
    return lambda images: True


def unsorted(_: Right) -> object:
    """The star is not sorted by angle."""
    return lambda images: [*images]


def without_c(right: Right) -> object:
    """Formula (1) for lines through the origin only."""
    return lambda a, b: (*right(a, b)[:2], 0)


def without_b(right: Right) -> object:
    return lambda a, b: (right(a, b)[0], 0, right(a, b)[2])


def turned_over(right: Right) -> object:
    """Left for right."""
    return lambda *arguments: -right(*arguments)


def never_crossing(_: Right) -> object:
    return lambda *arguments: False


def one_row_of_corners_missing(right: Right) -> object:
    """The last corners in x are not made."""

    def changed(volume: Volume, of: Right) -> object:
        found = right(volume, of).copy()
        if of != CENTRES:
            found[-1] = False
        return found

    return changed


def nothing_made(right: Right) -> object:
    """Voxels stay voxels."""
    return lambda volume, of: right(volume, CENTRES)


def mirrored(right: Right) -> object:
    """A corner is named by its voxel nearest to the origin: elements are labelled on the other side."""

    def changed(volume: Volume, of: Right) -> object:
        found = right(Volume(volume.array[::-1, ::-1, ::-1], volume.origin), of)
        return found if of != CENTRES else volume.array

    return changed


def below_for_above(_: Right) -> object:
    return lambda f, x, y, z: z <= f(x, y)


def above_for_below(_: Right) -> object:
    return lambda f, x, y, z: z >= f(x, y)


def a_span_too_wide(right: Right) -> object:
    """Near is up to 1 and a third."""

    def changed(p: Right, q: Right, voxel: Right) -> object:
        found = right(p, q, voxel)
        return (found[0] - Fraction(1, 3), found[1] + Fraction(1, 3)) if found else None

    return changed


def every_second_segment(right: Right) -> object:
    return lambda hull: [*right(hull)][::2]


def as_it_was(_: Right) -> object:
    """The expansion is the solid."""
    return lambda region: region


def without_its_minus(right: Right) -> object:
    """Every entry of a loop is positive."""
    return lambda entries, edges: right([*map(abs, entries)], edges)


def without_a_face(right: Right) -> object:
    """The cell list lacks its last face."""
    return lambda cells: replace(right(cells), faces=right(cells).faces[:-1])


def as_corrected_steps(_: Right) -> object:
    """Step 9 takes no line twice."""
    return lambda *names: details.Method()


def removed_as_entered(right: Right) -> object:
    """Edges met again have the direction they would be entered with."""

    def turned(array: Right) -> object:
        hull = right(array)
        steps = tuple(replace(step, removed=tuple((q, p) for p, q in step.removed)) for step in hull.lower.steps)
        return replace(hull, lower=replace(hull.lower, construction=lambda: steps))

    return turned


def joined_anyhow(_: Right) -> object:
    return lambda entries, edges: True


def a_sum_for_a_product(_: Right) -> object:
    return lambda u, v: tuple(a + b for a, b in zip(u, v, strict=True))


def the_greatest_side_missing(right: Right) -> object:
    """A cell's closure has no sides."""
    return lambda cells: frozenset(cells)


def nothing_left(right: Right) -> object:
    """A step loses a column."""
    return lambda tree: {k: z for n, (k, z) in enumerate(right(tree).items()) if n}


def extreme_nowhere(_: Right) -> object:
    return lambda place, axis, floor: False


def never_enclosed(_: Right) -> object:
    """The edges wholly within count as clear."""
    return nakamae.CLEAR


def all_on_one_side(_: Right) -> object:
    return lambda *arguments: 1


@pytest.mark.parametrize(
    ("module", "claim", "name", "spoil"),
    [
        (objects, "unit_directions", "direction", without_the_root),
        (objects, "planes_of_surfaces", "unit_plane", without_the_sign),
        (objects, "planes_of_surfaces", "direction", without_the_root),
        (objects, "vertex_on_no_convex_plane", "PITS", apexes_in_one_plane),
        (objects, "vertex_on_no_convex_plane", "PITS", an_apex_outside),
        (objects, "surfaces_first relation", "pitted", lambda _: objects.bent),
        (objects, "two_inside_corners", "preprocess", corners_that_are_not_kept),
        (objects, "inside_corner_at_a_vertex", "preprocess", none_deleted),
        (objects, "line_must_run condition", "triple_product", the_surfaces_exchanged_without_effect),
        (objects, "minimum_data", "fig_4", a_convex_object),
        (details, "star_tells_inside", "as_corrected", always_outside),
        (details, "star_tells_inside change", "star_polygon", unsorted),
        (objects, "normal_by_any_two_lines", "cross", a_sum_for_a_product),
        (objects, "normal_by_any_two_lines", "area_normal", lambda _: lambda points, ring: (1, 2, 3)),
        (details, "fourth_loop", "_joined", without_its_minus),
        (details, "fourth_loop", "_joined", joined_anyhow),
        (details, "limit_of_searches", "printed", as_corrected_steps),
        (details, "limit_of_searches", "_comes_again", never_crossing),
        (complexes, "euclidean_cells", "closure", the_greatest_side_missing),
        (yau, "common_to_both_steps", "heights", nothing_left),
        (
            yau,
            "epigraph_at_inner_nodes",
            "graph_side",
            lambda _: lambda tree, above: octree(np.ones((2, 2, 2), dtype=np.bool_)),
        ),
        (kovalevsky, "symmetry", "straightened", without_a_face),
        (kovalevsky, "symmetry", "half_ball", lambda _: lambda diameter: listed([(0, 0, 0), (0, 1, 0), (1, 2, 0)])),
        (yau, "queue_both_ways_round", "octree_hull", removed_as_entered),
        (yau, "common_to_both_steps", "_extreme", extreme_nowhere),
        (nakamae, "nearer_within", "ENCLOSED", never_enclosed),
        (nakamae, "nearer_within", "_hidden", lambda _: lambda drawing, kind: 1),
        (nakamae, "three_conditions", "side", all_on_one_side),
        (tables, "intersections", "side", all_on_one_side),
        (tables, "intersections", "lines_of", lambda right: lambda v: [*right(v)[:-1], right(v)[0]]),
        (tables, "table_properties LP", "sign", turned_over),
        (tables, "table_properties LP", "crosses", lambda _: lambda *arguments: True),
        (tables, "formula 3 in_line", "crosses", never_crossing),
        (tables, "contour_is_convex", "side", turned_over),
        (tables, "correlations", "crosses", never_crossing),
        (tables, "correlations figure", "crosses", never_crossing),
        (tables, "formula 1", "line_through", without_c),
        (tables, "formula 1", "line_through", without_b),
        (tables, "table_properties 1", "sign", turned_over),
        (raster, "corners_hold_centres", "places", one_row_of_corners_missing),
        (raster, "corners_hold_centres first", "places", one_row_of_corners_missing),
        (raster, "corners_hold_centres first", "places", nothing_made),
        (raster, "farthest_voxel", "places", one_row_of_corners_missing),
        (raster, "farthest_voxel figure", "places", nothing_made),
        (raster, "labelled_besides", "places", mirrored),
        (raster, "labelled_besides", "places", one_row_of_corners_missing),
        (convexity, "convex_functions G+", "in_epigraph", below_for_above),
        (convexity, "convex_functions G-", "in_hypograph", above_for_below),
        (convexity, "nearness semidigital", "semidigital_segments", every_second_segment),
        (convexity, "nearness near", "near_span", a_span_too_wide),
        (convexity, "convexity_by_expansion", "half_cell_expansion", as_it_was),
    ],
)
def test_a_claim_of_a_paper_notices_a_break(
    module: ModuleType, claim: str, name: str, spoil: Callable[[Right], object], monkeypatch: pytest.MonkeyPatch
) -> None:
    function, *arguments = claim.split()
    assert getattr(module, function)(*arguments).verdict in (HOLDS, CONDITION)
    monkeypatch.setattr(module, name, spoil(getattr(module, name)))
    assert getattr(module, function)(*arguments).verdict == FAILS


def test_a_property_that_touching_breaks_needs_its_condition(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without polygons that touch, property 3 would hold as it stands, and the three correlations are all."""
    apart = [(tables.SQUARE, tables.BESIDE), (tables.SQUARE, tables.WITHIN), (tables.SQUARE, tables.ACROSS)]
    assert [tables.table_properties(name).verdict for name in ("3", "LP")] == [CONDITION] * 2
    monkeypatch.setattr(tables, "pairs", lambda: iter(apart))
    assert [tables.table_properties(name).verdict for name in ("3", "LP")] == [HOLDS] * 2
    assert tables.correlations().verdict == FAILS


def test_the_pair_of_the_row_has_a_column_without_minus_one_and_touches() -> None:
    """Column 0 of PL, and two values of d."""
    pl, _ = tables.tables_of(tables.SQUARE, tables.AGAINST)
    assert [row[0] for row in pl] == [0, 1, 1, 1]
    numbers = [d for d, _ in tables.numbers_of_meetings(tables.SQUARE, tables.AGAINST)]
    assert numbers.count(-2) == 2


def test_a_contour_with_a_dent_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    """A front face is taken for a back one."""
    right = tables.dot
    seen = [0]

    def changed(a: Right, b: Right) -> int:
        seen[0] += right(a, b) > 0
        return -1 if seen[0] == 2 else right(a, b)

    monkeypatch.setattr(tables, "dot", changed)
    assert tables.contour_is_convex().verdict == FAILS


@pytest.mark.parametrize("diameter", kovalevsky.DIAMETERS)
def test_the_diameters_at_which_triangles_take_less_are_those_of_the_row(
    diameter: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One more body, or one less, and the row is wrong."""
    rows = [*kovalevsky._table_5()]
    at = kovalevsky.DIAMETERS.index(diameter)
    triangles, _, faces, _ = rows[at]
    rows[at] = (triangles, 10**6, faces, 5 * faces + 3 * (2000 if diameter in (10, 18) else 1))
    monkeypatch.setattr(kovalevsky, "_table_5", lambda: tuple(rows))
    assert kovalevsky.memory().verdict == FAILS


def test_the_crown_is_on_more_outside_corners_than_the_figure_allows() -> None:
    """So rule two keeps its apex, which is on four inside corners."""
    crown = objects.crown()
    found = preprocess(crown.points, crown.surfaces, "two")
    assert sum(8 in corner.line.ends for corner in found.inside) == 4
    assert 8 not in found.deleted
