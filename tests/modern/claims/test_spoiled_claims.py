"""Every check changes its verdict if something that it relies on is altered."""

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from functools import partial
from importlib import import_module
from itertools import chain
from types import SimpleNamespace
from typing import Any

import pytest

import modern.claims.kovalevsky_schulz.sizes as sizes
import modern.claims.thesis.chapter3_stages as stages
from emulator.language.cards import deck_from_lines
from emulator.language.compiler import compile_deck
from emulator.language.objectcode import Program
from modern.claims.algebra import IMPOSSIBLE, Proof, Step
from modern.claims.evidence import Decision
from modern.claims.register import decisions
from modern.claims.sampled_sets import SampledSet, sampled_sets
from modern.edition import programs
from modern.geometry.hull import Hull
from tests.modern.claims.spoilers import is_noticed, verdict
from tests.support.caches import cleared


def _edges_as_entered(hull: Any) -> Any:
    """Give the edges that leave the queue the direction in which they entered it."""
    steps = tuple(replace(step, removed=tuple((q, p) for p, q in step.removed)) for step in hull.lower.steps)
    return replace(hull, lower=replace(hull.lower, construction=lambda: steps))


def _with_idle_stage(sampled: SampledSet) -> SampledSet:
    history = sampled.hull.history
    return replace(sampled, hull=replace(sampled.hull, history=(*history, replace(history[-1], added=()))))


def _listing_with(old: str, new: str) -> Callable[[Any], Any]:
    """Replace a word on all cards of the listings."""

    def deck(original: Any, name: str, *layers: tuple[str, ...]) -> object:
        cards = [SimpleNamespace(text=card.text.replace(old, new)) for card in original.deck(name, *layers).cards]
        return SimpleNamespace(cards=cards, text=lambda: "\n".join(card.text for card in cards))

    return lambda original: SimpleNamespace(deck=partial(deck, original), program=original.program)


def _compiled_with(old: str, new: str) -> Callable[[Any], object]:
    """Replace a word on all cards of the listings and compile them."""

    def program(original: Any, name: str) -> Program:
        text = _listing_with(old, new)(original).deck(name).text()
        return compile_deck(deck_from_lines(f"{name}.f", text.split("\n")))

    return lambda original: SimpleNamespace(program=partial(program, original))


def _without_code(original: Any) -> object:
    return SimpleNamespace(deck=original.deck, program=lambda _: SimpleNamespace(code=(), statements=()))


# Spoilers of the checks that no alteration of a single value refutes.
BY_HAND: dict[str, tuple[str, Callable[[Any], object]]] = {
    "appel-will.11": ("area", lambda _: lambda *corners: 1),
    "appel-will.37": ("combinations", lambda original: lambda items, r: [*original(items, r)][1:]),
    "appel-will.80": ("findings", lambda original: lambda paper: [replace(f, produced=()) for f in original(paper)]),
    "kovalevsky-schulz.18": ("local", lambda original: lambda solid, of, n=26: original(solid, of, 32 - n)),
    "kovalevsky-schulz.91": ("results_of", lambda f: lambda paper: [replace(r, printed=r.corrected) for r in f(paper)]),
    "kovalevsky-schulz.166": ("merged", lambda _: lambda cells: cells),
    **dict.fromkeys(("thesis.3", "thesis.155", "thesis.169"), ("programs", _without_code)),
    "thesis.65": ("programs", _listing_with("NETC", "NTC")),
    "thesis.129": ("_c_0", lambda original: lambda *points: original(*points) + 1),
    "thesis.194": ("Machine", lambda _: lambda *arguments: None),
    "thesis.195": ("programs", _listing_with("*C1", "*C2")),
    "thesis.196": ("_translated", lambda _: programs.program),
    "thesis.242": ("_distance_squared", lambda _: lambda x, p, q: Fraction((3 * abs(x[0]) - 2 * x[1] + 5) ** 2, 13)),
    "thesis.261": ("programs", _listing_with("POINTS THAT ARE NOT VERTICES", "")),
    "thesis.262": ("programs", _listing_with("INSIDE PLANES", "PLANES")),
    "thesis.263": ("programs", _compiled_with("INSID=2", "INSID=1")),
    "thesis.269": ("flat_and_spatial_sets", lambda original: lambda size: [*map(_with_idle_stage, original(size))]),
    "thesis.273": ("coordinate_planes", lambda _: lambda: Proof("", "", (Step("", {}, IMPOSSIBLE),))),
    "yau-srihari.85": ("hull_of", lambda original: lambda solid: _edges_as_entered(original(solid))),
}

# Steps of proofs are altered in test_proofs.py, printed tables in test_invariants.py, and stages of the hull below.
DECISIONS = [
    decision
    for decision in chain.from_iterable(decisions().values())
    if decision.statement not in BY_HAND
    and "proof" not in dict(decision.subject)
    and decision.function is not stages.stage_property
    and not decision.function.__module__.endswith(".invariants")
]


@pytest.mark.parametrize("decision", DECISIONS, ids=lambda decision: decision.statement)
def test_check_notices_an_alteration(decision: Decision) -> None:
    assert is_noticed(decision)


@pytest.mark.parametrize("statement", BY_HAND)
def test_check_notices_a_spoiler(statement: str, monkeypatch) -> None:
    (decision,) = decisions()[statement]
    module, (attribute, spoiler) = import_module(decision.function.__module__), BY_HAND[statement]
    expected = verdict(decision.function(**dict(decision.subject)))
    with cleared(module):
        monkeypatch.setattr(module, attribute, spoiler(getattr(module, attribute)))
        assert verdict(decision.function(**dict(decision.subject))) != expected


def _with_last_stage(hull: Hull, **changes: Any) -> Hull:
    return replace(hull, history=(*hull.history[:-1], replace(hull.history[-1], **changes)))


def _vertex_eliminated_twice(hull: Hull) -> Hull:
    first, *rest = hull.history
    gone = (*first.struck, hull.vertices[-1])
    return _with_last_stage(replace(hull, history=(replace(first, struck=gone), *rest)), struck=hull.vertices[-1:])


# Alterations of a construction that the check of a property must notice.
PROPERTIES: dict[str, Callable[[Hull], Hull]] = {
    "decreasing": _vertex_eliminated_twice,
    "finite": lambda hull: replace(hull, history=(*hull.history, *hull.history[-1:] * len(hull.points))),
    "vertex_when_added": lambda hull: _with_last_stage(hull, added=hull.inside[:1]),
    **dict.fromkeys(
        ("counts", "renumbering", "replaced_line", "replaced_plane"),
        lambda hull: _with_last_stage(hull, equations=hull.history[-1].equations[1:]),
    ),
}


@pytest.mark.parametrize("name", stages._PROPERTIES)
def test_stage_property_fails_for_an_altered_construction(name: str, monkeypatch) -> None:
    if name not in PROPERTIES:
        assert is_noticed(Decision("", stages.stage_property, (("kind", name),)))
        return
    sets = {k: tuple(replace(s, hull=PROPERTIES[name](s.hull)) for s in sampled_sets(k, 6)) for k in (2, 3)}
    monkeypatch.setattr(stages, "sampled_sets", lambda dimension, _: sets[dimension])
    monkeypatch.setattr(stages, "flat_and_spatial_sets", lambda _: (*sets[2], *sets[3]))
    assert not stages.stage_property(name, 6).holds


@pytest.mark.parametrize("diameter", [8, 10])
def test_memory_condition_names_the_right_diameters(diameter: int, monkeypatch) -> None:
    """The claim changes if a cell list is as large as Marching Cubes, or if triangles take less at other diameters."""
    rows = {row.diameter: row for row in sizes.half_balls()}
    row = rows[diameter]
    integers = 5 * row.faces + 3 * (2000 if diameter == 10 else 1)
    expected = sizes.memory_requirements()
    for changes in ({"integers": row.triangle_integers}, {"triangle_integers": 10**6, "integers": integers}):
        spoiled = {**rows, diameter: replace(row, **changes)}
        monkeypatch.setattr(sizes, "half_balls", lambda spoiled=spoiled: spoiled.values())
        assert verdict(sizes.memory_requirements()) != verdict(expected)
    assert expected.holds


def test_memory_claim_fails_if_cell_lists_are_as_large_as_triangulations(monkeypatch) -> None:
    monkeypatch.setattr(sizes, "economical_size", lambda cells: sizes.triangulation_size(2 * len(cells.vertices) - 4))
    assert not sizes.memory_requirements().holds


def test_first_sampled_sets_contain_the_cases_that_claims_are_about() -> None:
    for dimension in (2, 3):
        judges = [sampled.judge for sampled in sampled_sets(dimension, 2)]
        assert all(judge.inside for judge in judges)
        assert any(judge.boundary for judge in judges)
        assert dimension == 2 or any(len(facet.polygon) > 3 for judge in judges for facet in judge.facets)
