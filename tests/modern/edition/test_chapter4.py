"""The worked examples of theorems 4.1, 4.2 (Table 1) and 4.8 (thesis p. 37-41, 56-57), and that a claim can fail."""

from dataclasses import replace
from fractions import Fraction

import pytest

from modern.claims.register import THESIS, decisions, statements_of
from modern.claims.thesis.chapter4_examples import lost_candidates, worked_example_checks
from modern.edition.chapter4 import THEOREMS, Theorem, load_theorems

BY_ID = {theorem.id: theorem for theorem in load_theorems()}


@pytest.mark.parametrize("name", THEOREMS)
def test_every_claim_of_theorem(name: str) -> None:
    found = worked_example_checks(BY_ID[name])
    assert [claim for claim, seen in found.items() if not seen.holds] == []
    assert len(found) >= 3
    assert "programs" in found
    rows = [row for row in statements_of(THESIS) if row.part == name]
    subjects = {decision.subject for row in rows for decision in decisions()[row.id]}
    claims = [dict(subject).get("claim") for subject in subjects]
    assert {claim for claim in claims if claim is not None} == found.keys()


def moved(theorem: Theorem, name: str) -> Theorem:
    """The theorem with one point moved by one in z."""
    points = tuple(replace(p, at=(p.at[0], p.at[1], p.at[2] + 1)) if p.name == name else p for p in theorem.points)
    return replace(theorem, points=points)


@pytest.mark.parametrize(("theorem", "point"), [("4.1", "P5"), ("4.2", "P3"), ("4.8", "Q4"), ("4.8", "Q9")])
def test_a_moved_point_fails_a_claim(theorem: str, point: str) -> None:
    assert any(not seen.holds for seen in worked_example_checks(moved(BY_ID[theorem], point)).values())


def test_false_equations_fail_and_the_lost_point_has_candidates() -> None:
    theorem = BY_ID["4.8"]
    changed = replace(theorem.planes[0], coefficients=(*theorem.planes[0].coefficients[:3], Fraction(1)))
    found = worked_example_checks(replace(theorem, planes=(changed, *theorem.planes[1:])))
    assert not found["supporting"].holds
    theorem = BY_ID["4.1"]
    candidates = lost_candidates(theorem)
    assert candidates
    for x, y, z in candidates:
        assert 2 * x - 5 * y + 3 * z + 4 == 0
        assert y >= 6
