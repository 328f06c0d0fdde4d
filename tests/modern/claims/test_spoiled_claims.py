"""Every check changes its verdict if what it relies on is spoiled; the tables of spoilers are in ``tables``."""

from dataclasses import replace

import pytest

import modern.claims.kovalevsky_schulz.sizes as sizes
import modern.claims.nakamae_nishita.tables as contours
import modern.claims.thesis.chapter3_stages as stages
import modern.claims.thesis.chapter3_wording as wording
from modern.claims.sampled_sets import sampled_sets
from modern.papers.nakamae_nishita.contours import Tables
from tests.modern.claims.spoilers import Spoiler, assert_verdict_changes, unspoiled, verdict
from tests.modern.claims.tables import (
    appel_will,
    kovalevsky_schulz,
    nakamae_nishita,
    thesis_2_and_3,
    thesis_4_to_7,
    yau_srihari,
)
from tests.support.caches import cleared

TABLES = [
    *(appel_will.TABLE, kovalevsky_schulz.TABLE, nakamae_nishita.TABLE),
    *(thesis_2_and_3.TABLE, thesis_4_to_7.TABLE, yau_srihari.TABLE),
]


@pytest.mark.parametrize(("name", "attribute", "spoiler"), [line for table in TABLES for line in table])
def test_verdict_changes_with_spoiled_attribute(name: str, attribute: str, spoiler: Spoiler) -> None:
    assert_verdict_changes(name, attribute, spoiler)


def test_every_check_is_spoiled() -> None:
    # The invariants are spoiled by altered prints in test_invariants.py.
    assert [name for name in unspoiled("modern.claims", TABLES) if ".invariants." not in name] == []


@pytest.mark.parametrize("diameter", [8, 10])
def test_memory_condition_names_the_right_diameters(diameter: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """The claim changes if a cell list is as large as Marching Cubes, or if triangles take less at other diameters."""
    rows = sizes._table_5()
    k = sizes.DIAMETERS.index(diameter)
    triangles, integers, faces, _ = rows[k]
    vertices = 2000 if diameter == 10 else 1
    expected = sizes.memory_requirements()
    for spoiled in ((triangles, integers, faces, integers), (triangles, 10**6, faces, 5 * faces + 3 * vertices)):
        monkeypatch.setattr(sizes, "_table_5", lambda row=spoiled: (*rows[:k], row, *rows[k + 1 :]))
        assert verdict(sizes.memory_requirements()) != verdict(expected)
    assert expected.holds


@pytest.mark.parametrize(("number", "wrong"), [(-2, -1), (-1, 0), (0, -1), (-4, -2)])
def test_wrong_crossing_number_fails(number: int, wrong: int, monkeypatch: pytest.MonkeyPatch) -> None:
    original = Tables.crossing_number

    def spoiled(tables: Tables, i: int, j: int) -> int:
        crossing_number = original(tables, i, j)
        return wrong if crossing_number == number else crossing_number

    with cleared(contours):
        monkeypatch.setattr(Tables, "crossing_number", spoiled)
        assert not contours.formula_3().holds


@pytest.mark.parametrize("name", thesis_2_and_3.PROPERTIES)
def test_stage_property_fails_for_a_spoiled_construction(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    change = thesis_2_and_3.PROPERTIES[name]
    assert stages.stage_property(name, 6).holds
    flat, spatial = (
        tuple(replace(sampled, hull=change(sampled.hull)) for sampled in sampled_sets(dimension, 6))
        for dimension in (2, 3)
    )
    monkeypatch.setattr(stages, "sampled_sets", lambda dimension, _: flat if dimension == 2 else spatial)
    monkeypatch.setattr(stages, "flat_and_spatial_sets", lambda _: (*flat, *spatial))
    try:
        holds = stages.stage_property(name, 6).holds
    except (IndexError, ValueError, StopIteration):
        holds = False
    assert not holds


def test_first_hull_is_often_larger_than_the_hull_of_the_extremes() -> None:
    """As the row says, it is larger in over a fifth of random sets whose six extreme points are not coplanar."""
    measures = [wording._volumes_and_planes(sampled.points, sampled) for sampled in sampled_sets(3, 120)]
    assert sum(first[0] > six[0] > 0 for first, six in measures) > len(measures) / 5


def test_first_sampled_sets_contain_the_cases_that_claims_are_about() -> None:
    for dimension in (2, 3):
        judges = [sampled.judge for sampled in sampled_sets(dimension, 2)]
        assert all(judge.inside for judge in judges)
        assert any(judge.boundary for judge in judges)
        assert dimension == 2 or any(len(facet.polygon) > 3 for judge in judges for facet in judge.facets)
