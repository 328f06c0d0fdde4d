"""The layer ``epsilon``: the interval from -e to +e of chapter 7 (thesis p. 117-118)."""

import random
from fractions import Fraction

import pytest

from emulator.errors import CardError
from emulator.language.cards import Deck, deck_from_lines, read_deck
from emulator.machine.result import Options
from modern.edition import chapter6, programs
from modern.edition.grounds import ground_deck
from modern.exact_hull import exact_hull
from modern.formats import deck as hulldeck
from modern.thesis.batch import run_hulls
from modern.thesis.cards import read_hull
from modern.thesis.job import HullRun
from tests.support.judged import OPTIONS, deck_of, differences, run, run_all, sets
from tests.support.paths import MACHINE_RUNS

RUNS = MACHINE_RUNS
FOLDERS = sorted(path.name for path in RUNS.iterdir() if path.is_dir())
DECKS = [*FOLDERS, *(f"example{n}" for n in range(1, 7))]


def deck_named(name: str) -> Deck:
    return (
        chapter6.input_deck(int(name[7:])) if name.startswith("example") else read_deck(str(RUNS / name / "deck.cards"))
    )


def through(deck: Deck, *layers: str, first: str = "program1", options: Options = OPTIONS) -> HullRun:
    (hull_run,) = run_hulls([deck], programs.loader(layers), options, first)
    assert isinstance(hull_run, HullRun)
    return hull_run


@pytest.mark.parametrize("name", DECKS)
def test_a_blank_e_changes_no_card_and_no_typed_line(name: str) -> None:
    """On every deck that a machine of the time ran, and on every example."""
    short = Options(limit=200_000)
    for first in ("program1", "program1_examples"):
        listed, layered = (
            through(deck_named(name), *layers, first=first, options=short) for layers in ((), ("epsilon",))
        )
        assert listed.final.result.punched == layered.final.result.punched
        assert [s.result.typed for s in listed.steps] == [s.result.typed for s in layered.steps]
        assert listed.final.result.ending.kind == layered.final.result.ending.kind


def test_an_e_of_zero_with_the_corrections_changes_no_card() -> None:
    names, point_sets = zip(*sets(60, 26), strict=True)
    corrected, zero = run_all(point_sets, "corrected"), run_all(point_sets, "epsilon", "corrected", e="0")
    for name, without, with_zero in zip(names, corrected, zero, strict=True):
        assert isinstance(without, HullRun)
        assert isinstance(with_zero, HullRun)
        assert without.final.result.punched == with_zero.final.result.punched, name


@pytest.mark.parametrize(
    ("name", "counts"), [("epscube", (0, 2, 8, 6)), ("epsplane", (0, 2, 4, 4)), ("epsedge", (0, 1, 5, 5))]
)
def test_an_e_classifies_points_of_rotated_solids(name: str, counts: tuple[int, int, int, int]) -> None:
    """A cube, a square and a pentagon, rotated and rounded, with points on faces and edges.

    counts: the numbers of inside points, boundary points, vertices and equations.
    """
    deck = ground_deck(name)
    assert deck is not None
    done = through(deck, "epsilon", "corrected")
    hull = read_hull(done.final.result.punched)
    assert done.complete
    assert (len(hull.inside), len(hull.boundary), len(hull.vertices), len(hull.equations)) == counts
    without = deck_from_lines("no e", [deck.cards[0].text[:2], *(card.text.rstrip() for card in deck.cards[1:])])
    assert read_hull(through(without, "epsilon", "corrected").final.result.punched) != hull


def test_an_e_recognises_lines_and_includes_the_ends_of_its_interval() -> None:
    deck = ground_deck("epsline")
    assert deck is not None
    assert "POINTS ARE COLLINEAR" in [card.strip() for card in through(deck, "epsilon").final.result.punched]
    assert "POINTS ARE COLLINEAR" not in [card.strip() for card in through(deck).final.result.punched]
    # Point 5 has the value e, or just more, in the plane of the first three, which is z = 0 times 16.
    base = ["0", "0", "0"], ["4", "0", "0"], ["0", "4", "0"], ["1", "1", "-4"]
    for height, vertices in ((".5", 4), (".5625", 5)):
        done = run([*base, ["1", "1", height]], "epsilon", "corrected", e="8")
        assert done.complete
        assert len(read_hull(done.final.result.punched).vertices) == vertices, height


def test_an_e_of_a_thousandth_makes_sets_of_three_decimals_right() -> None:
    """KNOWN-FAULTS 6: without e nearly all of them end in DATA NOT ACCEPTABLE."""
    refused = 0
    for seed in range(30):
        r = random.Random(seed)
        texts = [[f"{r.randint(-9999, 9999) / 1000:.3f}" for _ in range(3)] for _ in range(12)]
        refused += run(texts, "corrected").refusal == "DATA NOT ACCEPTABLE"
        done = run(texts, "epsilon", "corrected", e=".001")
        judge = exact_hull([tuple(Fraction(t) for t in p) for p in texts])
        assert done.complete
        assert {tuple(v) for v in read_hull(done.final.result.punched).vertices} == {
            tuple(Fraction(t) for t in texts[k]) for k in judge.vertices
        }
    assert refused > 20


def test_too_large_an_e_loses_vertices_but_no_core() -> None:
    # Chapter 7 warns of this on p. 118: a point that is not on a plane may count as being on it.
    points = [(-9, 0, 0), (9, 0, 0), (0, 9, 0), (0, 0, 9), (0, 1, -1)]
    assert differences(points, run(points, "epsilon", "corrected", e="999"))
    assert not differences(points, run(points, "epsilon", "corrected", e=".1"))
    points = [[str(k), str(k * k % 7), str(k % 5)] for k in range(4)]
    assert through(deck_of(points), "epsilon", options=Options()).final.result.ending.normal


def test_data_not_acceptable_ends_the_run_unless_switch_1_is_on() -> None:
    """Thesis p. 117; KNOWN-FAULTS 10."""
    deck = deck_named("18_dec3_n6")
    off, on = (through(deck, options=Options(switches=frozenset(s), limit=200_000)) for s in ((), (1,)))
    assert off.refusal == "DATA NOT ACCEPTABLE"
    assert off.final.result.typed == ("DATA NOT ACCEPTABLE",)
    assert on.final.result.typed.count("DATA NOT ACCEPTABLE") > 1
    assert on.final.result.statements > off.final.result.statements


def checked(first: str, epsilon: bool = True) -> hulldeck.CheckedDeck:
    return hulldeck.check(deck_from_lines("d", [first, "1.            2.            3."]), epsilon=epsilon)


def test_the_check_of_a_deck_reads_e() -> None:
    assert not checked(" 1+.10000000E-02").warnings
    assert not checked(" 1").warnings
    assert checked(" 1+.10000000E-02", epsilon=False).warnings
    assert [w.message for w in checked(" 1+.10000000E-02 X").warnings] == [
        "d: card 1, column 17: the programs do not read the columns after e"
    ]


@pytest.mark.parametrize("e", ["-.10000000E-02", "ABC"])
def test_the_check_of_a_deck_rejects_an_invalid_e(e: str) -> None:
    with pytest.raises(CardError, match=r"d: card 1, column 3: (the tolerance )?e"):
        checked(" 1" + e)
