"""The causes of runs without a hull: known faults, and points that do not satisfy their own plane."""

from dataclasses import replace
from fractions import Fraction
from functools import partial

import pytest

from emulator.language.cards import Deck, read_deck
from emulator.machine.result import Options
from modern.edition import programs
from modern.formats.deck import check, data_deck, with_epsilon
from modern.port.points import fixed_arithmetic
from modern.thesis.cards import read_intermediate
from modern.thesis.job import run_hull
from modern.thesis.refusals import CORRECTED, Cause, explain_run
from tests.support.paths import ROOT

SOLID = [
    *(("3.74", "-1.83", "4.46"), ("-4.56", "3.95", "-0.76"), ("-4.97", "-2.41", "4.89")),
    *(("2.16", "2.37", "3.11"), ("-4.94", "-1.93", "-0.34"), ("4.09", "4.08", "-3.51")),
]
FLAT = [
    ("1.00713", "2.03157", "0"),
    ("-3.11391", "1.04973", "0"),
    (".77719", "-2.90311", "0"),
    ("-2.01971", "-2.6", "0"),
]
FOUR = [
    *(("1.175", "-3.733", "-4.982"), ("3.714", "-2.905", "-2.845")),
    *(("4.824", "3.724", "-2.107"), ("4.615", ".392", "1.778")),
]


def ground(name: str) -> Deck:
    deck = read_deck(str(ROOT / "fortran_src" / "grounds" / f"{name}.deck"))
    return check(deck).deck(0)


def cause_of(deck: Deck, layers: tuple[str, ...] = (), limit: int = 400_000) -> Cause:
    core = 60_000 if layers else 40_000
    run, cause = explain_run(partial(run_hull, deck, programs.loader(layers), Options(limit=limit, core=core)))
    assert not run.complete
    assert cause is not None
    return cause


@pytest.mark.parametrize(
    ("name", "kind", "fault", "text"),
    [
        ("lastpair", "pair", 1, "IF (NE-K) 133, 154, 148"),
        ("lastplane", "endless", 2, "IF(EZ)170,169,170"),
        ("throughc", "centre", 3, "IF(E(I))135,133,134"),
        ("zeroplane", "zeros", 4, "IF(E(I))135,133,134"),
    ],
)
def test_a_known_fault_is_identified_by_its_number(name: str, kind: str, fault: int, text: str) -> None:
    found = cause_of(ground(name))
    assert (found.program, found.kind, found.fault) == (3, kind, fault)
    assert found.decision is not None
    assert found.decision.text == text
    assert (found.message == "ERROR IN PROGRAM") == (kind != "endless")


@pytest.mark.parametrize(("name", "fault"), [("table", 5), ("polygon51", 16)])
def test_a_full_table_is_identified(name: str, fault: int) -> None:
    found = cause_of(ground(name), limit=5_000_000)
    assert (found.kind, found.fault, found.message) == ("room", fault, "")


@pytest.mark.parametrize("name", ["lastpair", "lastplane", "throughc"])
def test_the_named_correction_removes_the_fault(name: str) -> None:
    assert cause_of(ground(name)).fault in CORRECTED
    corrected = programs.loader(("corrected",))
    assert explain_run(partial(run_hull, ground(name), corrected, Options(core=60_000)))[1] is None


def test_limits_unmet_equations_and_hulls_are_told_apart() -> None:
    found = cause_of(ground("table"), limit=100_000)
    assert (found.kind, found.fault) == ("endless", 0)
    found = cause_of(data_deck(FOUR, "points"))
    assert (found.program, found.kind, found.fault, found.message) == (3, "unmet", 6, "ERROR IN PROGRAM")
    points = [("0", "0", "0"), ("4", "0", "0"), ("0", "4", "0"), ("0", "0", "4"), ("1", "1", "1")]
    assert explain_run(partial(run_hull, data_deck(points, "points"), programs.loader(())))[1] is None


@pytest.mark.parametrize(("points", "program"), [(SOLID, 3), (FLAT, 2)])
def test_the_point_that_does_not_satisfy_its_equation_is_named(points, program) -> None:
    """In the port's eight digits the equation that program 1 punched has the same nonzero value at the point."""
    deck = data_deck(points, "points")
    found = cause_of(deck)
    assert (found.program, found.kind, found.fault, found.message) == (program, "miss", 6, "DATA NOT ACCEPTABLE")
    place = tuple(Fraction(number) for number in found.point)
    assert place in [tuple(map(Fraction, point)) for point in points]
    assert Fraction(found.value) != 0
    if program == 3:
        middle = read_intermediate(run_hull(deck, programs.loader(())).steps[0].result.punched)
        assert middle is not None
        eight = fixed_arithmetic("truncating")
        assert eight is not None
        a, b, c, d = (eight.number(number) for number in middle.planes[found.equation - 1][0])
        x, y, z = (eight.number(number) for number in place)
        assert eight.exact(a * x + b * y + c * z + d, 3) == Fraction(found.value)


@pytest.mark.parametrize("points", [SOLID, FLAT, FOUR])
def test_the_cause_with_an_epsilon_of_zero_is_that_without_epsilon(points: list[tuple[str, str, str]]) -> None:
    deck = data_deck(points, "points")
    listed, with_zero = cause_of(deck), cause_of(with_epsilon(deck, "0"), ("epsilon",))
    assert with_zero.fault == 6
    assert replace(with_zero, decision=None) == replace(listed, decision=None)
