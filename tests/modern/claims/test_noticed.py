"""Claims notice a break: each is computed on what it says is so, and on the same thing spoiled."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest

import modern.claims.kovalevsky_schulz.complexes as complexes
import modern.claims.kovalevsky_schulz.polyhedra as kovalevsky
import modern.claims.nakamae_nishita.tables as nakamae_tables
import modern.claims.nakamae_nishita.visibility as nakamae
import modern.claims.thesis.chapter2 as chapter2
import modern.claims.thesis.chapter3_stages as stages
import modern.claims.thesis.chapter4_theorems as proofs
from modern.claims.register import CONDITION, FAILS, HOLDS
from modern.claims.sampled_sets import SampledSet
from modern.edition import chapter4_claims, sampled_sets, statements
from modern.exact_hull import exact_hull
from modern.geometry.hull import Hull, Stage
from modern.papers.nakamae_nishita.contours import Tables
from modern.papers.nakamae_nishita.crossings import Passage

Spoil = Callable[[Hull], Hull]


def _last(hull: Hull, change: Callable[[Stage], Stage]) -> Hull:
    *before, last = hull.history
    return replace(hull, history=(*before, change(last)))


def without_an_equation(hull: Hull) -> Hull:
    """The last hull lacks its first equation."""
    return _last(hull, lambda stage: replace(stage, equations=stage.equations[1:]))


def a_vertex_struck(hull: Hull) -> Hull:
    """A vertex is struck at the first stage, and again at the last."""
    first, *rest = hull.history
    spoiled = replace(first, struck=(*first.struck, hull.vertices[-1]))
    return _last(replace(hull, history=(spoiled, *rest)), lambda s: replace(s, struck=(*s.struck, hull.vertices[-1])))


def a_stage_left_out(hull: Hull) -> Hull:
    """The second stage is missing: its point is never added."""
    return replace(hull, history=(hull.history[0], *hull.history[2:]))


def backwards(hull: Hull) -> Hull:
    """NETC runs from the last to the first."""
    first, *rest = hull.history
    turned = [replace(stage, checked=9 - k) for k, stage in enumerate(rest)]
    return replace(hull, history=(first, *turned))


def a_stage_twice(hull: Hull) -> Hull:
    """The last stage over and over: the construction does not end where it should."""
    return replace(hull, history=(*hull.history, *(hull.history[-1:] * len(hull.points))))


def an_inner_point_added(hull: Hull) -> Hull:
    """The last stage adds a point that is inside."""
    inside = {*range(len(hull.points))} - {*hull.vertices} - {*hull.boundary}
    return _last(hull, lambda stage: replace(stage, added=(min(inside),)) if inside else stage)


@pytest.mark.parametrize(
    ("kind", "spoil"),
    [
        ("contain", an_inner_point_added),
        ("tetrahedra", a_stage_left_out),
        ("hulls", without_an_equation),
        ("final", without_an_equation),
        ("struck", a_vertex_struck),
        ("struck_inside", a_vertex_struck),
        ("contained", a_stage_left_out),
        ("never_back", a_vertex_struck),
        ("finite", a_stage_twice),
        ("settled", backwards),
        ("outside", an_inner_point_added),
        ("largest", an_inner_point_added),
        ("lines", without_an_equation),
        ("planes", without_an_equation),
        ("both_new", an_inner_point_added),
        ("counted", without_an_equation),
        ("moved", without_an_equation),
        ("next", backwards),
        ("used", a_stage_left_out),
        ("once", an_inner_point_added),
        ("triangle", without_an_equation),
        ("convex", backwards),
    ],
)
def test_a_spoiled_construction_is_noticed(kind: str, spoil: Spoil, monkeypatch: pytest.MonkeyPatch) -> None:
    assert stages.approximations(kind, "6").verdict in (HOLDS, CONDITION)
    sets = {
        dimension: tuple(
            SampledSet(one.points, spoil(one.hull), one.judge) for one in sampled_sets.sampled_sets(dimension, 6)
        )
        for dimension in (2, 3)
    }
    monkeypatch.setattr(stages, "sampled_sets", lambda dimension, _: sets[dimension])
    monkeypatch.setattr(stages, "both", lambda _: (*sets[2], *sets[3]))
    try:
        verdict = stages.approximations(kind, "6").verdict
    except (IndexError, ValueError, StopIteration):
        verdict = FAILS
    assert verdict == FAILS


def test_every_kind_of_stage_is_spoiled_above() -> None:
    marks = test_a_spoiled_construction_is_noticed.pytestmark  # type: ignore[attr-defined]
    assert {kind for kind, _ in marks[0].args[1]} == {*stages.KINDS}


def test_a_counterexample_that_is_none_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    """With the origin in the set the printed minus does give the middle point."""
    assert chapter2.vertex_with_minus().verdict == FAILS
    monkeypatch.setattr(chapter2, "points_of", lambda _: [(0, 0, 0), (1, 1, 1), (2, 2, 2)])
    assert chapter2.vertex_with_minus().verdict == HOLDS


def test_three_points_in_a_line_make_no_supporting_plane(monkeypatch: pytest.MonkeyPatch) -> None:
    """A plane that touches a cube along an edge with three points on it has three zeros and is none."""
    points = ((0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 2, 0), (2, 2, 0), (0, 0, 2), (2, 0, 2), (0, 2, 2), (2, 2, 2))
    judge = exact_hull(points)
    wrong = replace(judge, facets=(replace(judge.facets[0], plane=(0, -1, -1, 0)), *judge.facets[1:]))
    one = sampled_sets.sampled_sets(3, 1)[0]
    monkeypatch.setattr(chapter2, "sampled_sets", lambda *_: (SampledSet(points, one.hull, wrong),))
    assert chapter2.supporting_planes().verdict == FAILS
    monkeypatch.setattr(chapter2, "sampled_sets", lambda *_: (SampledSet(points, one.hull, judge),))
    assert chapter2.supporting_planes().verdict == HOLDS


@pytest.mark.parametrize("kind", ["", "bars"])
def test_the_distance_from_a_point_of_the_line_is_not_that_from_the_line(
    kind: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(proofs, "_distance_squared", lambda x, p, q: (x[0] - p[0]) ** 2 + (x[1] - p[1]) ** 2)
    assert proofs.theorem_4_6(kind).verdict == FAILS


def test_an_index_without_its_number_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    right = nakamae.clipped

    def one(values: list[list[int]], first: int, last: int) -> Passage:
        found = right(values, first, last)
        return replace(found, marks=tuple((place, 1 if index > 0 else -1) for place, index in found.marks))

    monkeypatch.setattr(nakamae, "clipped", one)
    assert [nakamae.indices().verdict, nakamae.three_conditions().verdict] == [FAILS, FAILS]


@pytest.mark.parametrize(("value", "wrong"), [(-2, -1), (-1, 0), (0, -1), (-4, -2)])
def test_a_wrong_number_of_a_meeting_is_noticed(value: int, wrong: int, monkeypatch: pytest.MonkeyPatch) -> None:
    right = Tables.crossing_number

    def changed(tables: Tables, i: int, j: int) -> int:
        found = right(tables, i, j)
        return wrong if found == value else found

    monkeypatch.setattr(Tables, "crossing_number", changed)
    assert nakamae_tables.formula("3").verdict == FAILS


def test_a_list_as_large_as_the_triangles_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Any one of the eight half-balls."""
    rows = kovalevsky._table_5()
    assert kovalevsky.memory().verdict == CONDITION
    for k, (triangles, integers, faces, _) in enumerate(rows):
        spoiled = (*rows[:k], (triangles, integers, faces, integers), *rows[k + 1 :])
        monkeypatch.setattr(kovalevsky, "_table_5", lambda spoiled=spoiled: spoiled)
        assert kovalevsky.memory().verdict == FAILS


@pytest.mark.parametrize(
    "claim",
    [
        "smallest_neighbourhood",
        "topological_line",
        "raster incident",
        "raster shared",
    ],
)
def test_a_bounding_pair_left_out_is_noticed(claim: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The corner in the middle bounds one voxel less than it should."""
    right = complexes.bounded

    def less(cell: tuple[int, int, int]) -> frozenset[tuple[int, int, int]]:
        return right(cell) - {(3, 3, 3)} if cell == (2, 2, 2) else right(cell)

    name, *arguments = claim.split()
    assert getattr(complexes, name)(*arguments).verdict == HOLDS
    monkeypatch.setattr(complexes, "bounded", less)
    sides = complexes.sides
    monkeypatch.setattr(complexes, "sides", lambda c: sides(c) - {(2, 2, 2)} if c == (3, 3, 3) else sides(c))
    assert getattr(complexes, name)(*arguments).verdict == FAILS


def test_an_interior_that_is_too_small_or_too_large_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    right = complexes.interior
    assert complexes.interior_is_greatest().verdict == HOLDS
    for wrong in (lambda cells: cells, lambda cells: frozenset(sorted(right(cells))[1:])):
        monkeypatch.setattr(complexes, "interior", wrong)
        assert complexes.interior_is_greatest().verdict == FAILS


def test_an_edge_without_a_voxel_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    """One corner less in what the program finds."""
    right = complexes.places

    def less(*arguments: object) -> object:
        found = right(*arguments)  # type: ignore[arg-type]
        found[tuple(found.nonzero()[axis][0] for axis in range(3))] = False
        return found

    monkeypatch.setattr(complexes, "places", less)
    assert complexes.no_loose_cells().verdict == FAILS


def test_slips_that_are_mended_are_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    for text, which in (("-4,4,2\n3,4,-1\n", "list"), ("-4,-4,2\n3,4,1\n", "table")):
        monkeypatch.setattr(chapter4_claims, "counterexample", lambda _, text=text: text)
        assert chapter4_claims.slips_of_4_8(which).verdict == HOLDS
    assert statements.counterexample("slips_4_8.csv") == "-4,-4,2\n3,4,-1\n"
