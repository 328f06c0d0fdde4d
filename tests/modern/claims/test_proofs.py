"""Every proof holds, and fails if a hypothesis or the conclusion of one of its steps is altered."""

from __future__ import annotations

import inspect

import pytest

from modern.claims import algebra
from modern.claims.algebra import Proof, Step, not_negative, positive, term, variables, zero
from modern.claims.appel_will import proofs as appel_will
from modern.claims.kovalevsky_schulz import proofs as kovalevsky_schulz
from modern.claims.nakamae_nishita import proofs as nakamae_nishita
from modern.claims.thesis import existence, identities
from modern.claims.thesis import proofs as thesis
from modern.claims.yau_srihari import proofs as yau_srihari

# All functions of these modules that return a proof.
PROOFS: dict[str, Proof] = {
    f"{module.__name__.split('.')[-2]} {name}": function()
    for module in (thesis, identities, kovalevsky_schulz, nakamae_nishita, yau_srihari, appel_will)
    for name, function in vars(module).items()
    if inspect.isfunction(function)
    and function.__module__ == module.__name__
    and function.__annotations__.get("return") in (Proof, "Proof")
}


@pytest.mark.parametrize("name", PROOFS)
def test_every_step_of_a_proof_is_valid(name: str) -> None:
    assert [step.says for step in PROOFS[name].steps if not step.is_valid()] == []


@pytest.mark.parametrize("name", PROOFS)
def test_an_altered_step_is_not_proved_and_is_false(name: str) -> None:
    steps = enumerate(PROOFS[name].steps)
    altered = {f"step {number} {text}": altered for number, step in steps for text, altered in step.alterations()}
    assert [text for text, step in altered.items() if step.is_valid()] == []
    assert [text for text, step in altered.items() if step.refuting_values(seed=1963) is None] == []


def test_proofs_need_valid_certificates_and_their_premises() -> None:
    x, y, p = variables("x y p_x")
    assert not Step("", {"x": not_negative(x)}, not_negative(y), (term("x", y),), ("x",)).is_valid()
    assert not Step("", {"x": not_negative(x)}, positive(x), (term("x"),)).is_valid()
    assert not Step("", {}, not_negative(-x * x), (term("", x),)).is_valid()
    assert not Step("", {"x": zero(x)}, positive(x), (term("x"),)).is_valid()
    assert Step("", {"x": zero(x)}, zero(x * y), (term("x", y),)).is_valid()
    linear, _ = algebra.combination_satisfies()
    assert linear.is_valid()
    assert not Step("", {}, zero(linear.conclusion.value + p * p)).is_valid()


def test_theorems_that_something_exists_have_exact_instances() -> None:
    assert [*existence.coplanar_extremes()] == [True] * 87
    assert all(existence.table_1())
    assert all(existence.outside_several_planes())


def test_instances_are_checked(monkeypatch) -> None:
    # In a smaller cube the planes no longer contain points for every way to coincide.
    monkeypatch.setattr(existence, "SIDE", 2)
    assert not all(existence.coplanar_extremes())
    # Without the first eight points the last one is not outside of H_5.
    points = existence.points_of_h_5()
    monkeypatch.setattr(existence, "points_of_h_5", lambda: points[:7])
    assert not all(existence.outside_several_planes())
