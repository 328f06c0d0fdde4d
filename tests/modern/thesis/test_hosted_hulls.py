"""The hull programs in exact, binary and multiple-precision numbers, compared with eight digits and the exact hull."""

import random
from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path

import pytest

from emulator.language.cards import Deck, deck_from_lines, read_deck
from emulator.machine.divergence import diverge
from emulator.machine.endings import looped
from emulator.machine.result import LOOP_WINDOW, Result
from emulator.machine.session import Session
from emulator.numbers import numbers
from modern.comparison.difference import disagreement
from modern.comparison.outcome import Vector, from_cards, from_judge
from modern.edition import chapter6, programs
from modern.exact_hull import exact_hull
from modern.thesis.job import HullRun, Step, run_hull
from tests.support.deckwork import until
from tests.support.judged import OPTIONS, deck_of, differences, sets
from tests.support.paths import MACHINE_RUNS

RUNS = MACHINE_RUNS
FOLDERS = sorted(path for path in RUNS.iterdir() if path.is_dir())
INTEGERS = [folder for folder in FOLDERS if folder.name not in ("18_dec3_n6", "23_dec2_n15")]
"""Decks whose points are integers."""

LIMIT = 60_000


def hull(deck: Deck, name: str = "", layers: tuple[str, ...] = (), uncut: bool = False, limit: int = LIMIT) -> HullRun:
    options = replace(OPTIONS, limit=limit, uncut=uncut, numbers=numbers(name or "truncating"))
    return run_hull(deck, lambda program: programs.with_layers(program, layers), options)


def deck_of_folder(folder: Path) -> Deck:
    return read_deck(str(folder / "deck.cards"))


@cache
def run_of_the_machine(folder: Path) -> HullRun:
    return hull(deck_of_folder(folder))


@pytest.mark.parametrize("folder", INTEGERS, ids=lambda folder: folder.name)
@pytest.mark.parametrize("name", ["exact", "float64", "mp:120"])
def test_decks_of_integers_have_the_same_run_in_other_numbers(folder: Path, name: str) -> None:
    """For two-digit integers, eight decimal digits lead to the same decisions as exact numbers."""
    plain = run_of_the_machine(folder)
    endless = plain.final.result.ending.kind == "limit"
    other = hull(deck_of_folder(folder), name, limit=LIMIT if endless else 100 * LIMIT)
    results = [step.result for step in other.steps]
    if endless:
        results[-1] = after_statements(other.final, name, LIMIT)
    assert [result.counts for result in results] == [step.result.counts for step in plain.steps]
    assert [result.ending for result in results] == [step.result.ending for step in plain.steps]
    if name == "exact":
        assert [result.punched for result in results] == [step.result.punched for step in plain.steps]


def after_statements(step: Step, name: str, statements: int) -> Result:
    """Return the result of a step after the given number of statements, as if that were the limit of the run.

    The limit of the options counts costly statements more than once, so it would stop the run elsewhere.
    """
    session = Session(step.program, step.deck, replace(OPTIONS, limit=100 * statements, numbers=numbers(name)))
    assert until(session, statements - LOOP_WINDOW) is None
    before = list(session.state.counts)
    assert until(session, statements) is None
    return session.result(looped(step.program, statements, before, session.state.counts, session.state.decision))


@pytest.mark.parametrize("example", chapter6.EXAMPLES)
def test_the_examples_in_exact_numbers_have_the_exact_hull(example: int) -> None:
    """Exact numbers give the thesis's six examples as the exact judge has them."""
    deck = chapter6.input_deck(example)
    points = [
        (Fraction(card.columns(1, 14)), Fraction(card.columns(15, 28)), Fraction(card.columns(29, 42)))
        for card in deck.cards[1:]
    ]
    run = hull(deck, "exact")
    assert run.complete
    given: list[Vector] = [tuple(point) for point in points]
    judge = from_judge(exact_hull(points), given)
    found = disagreement(from_cards("exact", run, given), judge, given)
    assert found.agrees or judge.dimension < 2
    assert not found.missed
    assert not found.added


def test_integers_in_exact_numbers_with_the_corrections_are_right() -> None:
    """The sets come from every family."""
    for name, points in sets(30, 7):
        if len(points) > 17:
            continue
        run = run_hull(
            deck_of(points),
            lambda program: programs.with_layers(program, ("corrected",)),
            replace(OPTIONS, numbers=numbers("exact"), limit=1_000_000),
        )
        assert differences(points, run) == [], name


def decimals(seed: int) -> list[tuple[str, ...]]:
    """Return points with up to seven decimals, whose coefficients have more digits than a card holds."""
    r = random.Random(seed)
    places = r.choice((1, 3, 5, 7))
    return [
        tuple(f"{r.randint(-(10**places), 10**places) / 10**places:.{places}f}" for _ in range(3))
        for _ in range(r.choice((4, 6, 9)))
    ]


def test_decimals_in_exact_numbers_are_right_if_uncut() -> None:
    """If the numbers pass through cards between the programs, most sets are refused."""
    refused = 0
    for seed in range(20):
        points = decimals(seed)
        deck, given = deck_of(points), [tuple(Fraction(x) for x in p) for p in points]
        run = hull(deck, "exact", ("corrected",), uncut=True)
        assert run.complete, seed
        judge = from_judge(exact_hull(points), given)
        outcome = from_cards("exact", run, given)
        assert (outcome.vertices, outcome.inside) == (judge.vertices, judge.inside), seed
        refused += not hull(deck, "exact", ("corrected",)).complete
    assert refused > 5


def test_diverge_names_the_first_value_that_eight_digits_get_wrong() -> None:
    """In program 3 a defining point does not satisfy its plane in eight digits, but does so exactly."""
    points = [("0", "0", "0"), ("1", "0", "0"), ("0", "1", "0"), ("0.1234567", "0.7654321", "1.3333333")]
    points += [("0.1010101", "0.3333333", "-1.7777777"), ("0.9999999", "0.8888888", "0.0123456")]
    deck = deck_of(points)
    middle = deck_from_lines("middle", hull(deck).steps[0].result.punched)
    found = diverge(programs.program("program3"), middle, numbers("truncating"), numbers("exact"))
    assert found.first_value is not None
    assert found.first_value.line.place.card < 60
    assert found.digits == 8
    assert any(loss.worst > 3 for loss in found.losses)


def test_program_2_compares_square_roots_exactly() -> None:
    """For collinear points AL+CL-BL is exactly zero, and eight digits miss some of these zeros.

    The last of the points with the least x is first taken for a vertex, although it lies between two others.
    """
    r = random.Random(5)
    missed = 0
    for _ in range(40):
        x, low, high, t = r.randint(-9, 0), r.randint(-20, 0), r.randint(1, 20), r.randint(1, 7)
        between = Fraction(low * (8 - t) + high * t, 8)
        corners = [(x, low), (x + r.randint(1, 9), r.randint(-9, 9)), (x, high), (x, float(between))]
        points = [(str(u), str(v), "1") for u, v in corners]
        run = hull(deck_of(points), "exact")
        assert run.final.name == "program2"
        given = [tuple(Fraction(x) for x in p) for p in points]
        judge = from_judge(exact_hull(points), given)
        outcome = from_cards("exact", run, given)
        assert (outcome.vertices, outcome.boundary) == (judge.vertices, judge.boundary), points
        middle = deck_from_lines("middle", run.steps[0].result.punched)
        for name in ("truncating", "float64"):
            found = diverge(programs.program("program2"), middle, numbers(name), numbers("exact"), values=False)
            assert found.apart == ""
            if name == "truncating" and found.first_decision is not None:
                missed += 1
                assert "AL" in found.first_decision.line.text
                assert found.first_decision.values[1] == "0"
    assert missed
