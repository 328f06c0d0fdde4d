"""KNOWN-FAULTS.md, entry by entry: a deck shows the fault, its row alone corrects it, and no other row does."""

import re
from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import cache
from itertools import product
from random import Random

import pytest

from emulator.language.cards import Deck, deck_from_lines, read_deck
from emulator.language.objectcode import Line, Program
from emulator.machine.machine import Machine
from emulator.machine.result import Options
from emulator.numbers.fields import Field
from modern.edition import programs
from modern.edition.grounds import ground_deck
from modern.formats.deck import data_deck, with_epsilon
from modern.formats.points import parse_input
from modern.study import Port, Programs
from modern.study.families.draws import Drawn
from modern.study.outcomes import Answer
from modern.study.routes import carry_out
from modern.study.sample import Sample, judge
from modern.thesis.batch import Runs
from modern.thesis.cards import read_hull
from modern.thesis.job import HullRun, run_hull
from tests.support.judged import Point, distinct, faults, faulty_sets, run_all
from tests.support.paths import MACHINE_RUNS

TEXT = programs.sources().joinpath("KNOWN-FAULTS.md").read_text(encoding="utf-8")
ENTRIES = {int(n): entry for n, entry in re.findall(r"^(\d+)\. (.+(?:\n +.+)*)", TEXT, re.M)}
CORRECTIONS = [row.id for name in programs.TEXTS for row in programs.text(name).rows if row.layer == "corrected"]
Triple = tuple[int, int, int]


def sheet(name: str) -> Deck:
    """Return the deck of a ground, or of one of the fourteen machine runs."""
    return ground_deck(name) or read_deck(str(MACHINE_RUNS / name / "deck.cards"))


@cache
def sample(name: str) -> Sample:
    return judge(Drawn(parse_input(sheet(name).text(), name).points), name)


@cache
def answer(name: str, *rows: str) -> Answer:
    """Run a deck through the listing with only these rows of the layer ``corrected``."""
    (result,) = carry_out(Programs("route", rows=rows, core=60_000, limit=1_000_000), [sample(name)], Runs())
    return result


def exactly(name: str) -> str:
    """Return the outcome of the procedure in exact arithmetic, in which no card truncates a number."""
    (result,) = carry_out(Port("exact", "exact"), [sample(name)], Runs())
    return result.outcome


# Entry, deck, outcome, where, and the row that corrects it.
CORRECTED = [
    (1, "lastpair", "ERROR IN PROGRAM", "program3 147", "P3-025"),
    (2, "04_cube8", "ERROR IN PROGRAM", "program3 170", "P3-026"),
    (2, "39_prism_n10", "endless", "program3 157-169", "P3-026"),
    (2, "lastplane", "endless", "program3 157-169", "P3-026"),
    (3, "throughc", "ERROR IN PROGRAM", "program3 132+3", "P3-027"),
    (5, "table", "table full", "program3 MM(99)", "P3-028"),
    (14, "between", "wrong hull", "vertex missed", "P2-024"),
    (15, "renumber", "wrong hull", "vertices of a plane wrong", "P2-025"),
    (16, "polygon51", "out of bounds", "program2 A(52)", "P2-023"),
]


@pytest.mark.parametrize(("entry", "name", "outcome", "where", "row"), CORRECTED)
def test_its_deck_shows_the_fault_and_its_row_alone_corrects_it(entry, name, outcome, where, row) -> None:
    result = answer(name)
    assert (result.outcome, result.detail) == (outcome, where)
    assert answer(name, row).outcome == "right"
    assert row in ENTRIES[entry]
    assert name in ENTRIES[entry]


@pytest.mark.parametrize(("name", "row"), [(name, row) for _, name, _, _, row in CORRECTED])
def test_no_other_row_corrects_it(name: str, row: str) -> None:
    """Only rows of the same program are tried; P3-029 changes a card of P3-027 and needs it."""
    for wrong_row in CORRECTIONS:
        if wrong_row != row and wrong_row[:2] == row[:2]:
            rows = ("P3-027", wrong_row) if wrong_row == "P3-029" else (wrong_row,)
            if row not in rows:
                assert answer(name, *rows).outcome != "right", wrong_row


def test_every_entry_and_correction_has_a_test() -> None:
    # P3-029 only keeps a message; the test of entry 4 covers it.
    assert sorted({row for *_, row in CORRECTED} | {"P3-029"}) == sorted(CORRECTIONS)
    named = {entry for entry, *_ in CORRECTED}
    named |= {int(match[1]) for name in globals() if (match := re.match(r"test_(\d+)_", name))}
    assert named == set(ENTRIES) == set(range(1, len(ENTRIES) + 1))
    for name in programs.TEXTS:
        for row in programs.text(name).rows:
            if row.layer == "corrected":
                entry, *_ = re.findall(r"KNOWN-FAULTS (\d+)", row.reason)
                assert row.id in ENTRIES[int(entry)], row.id


# Faults without a row that corrects them.


def run(name: str | Deck, *layers: str, options: Options | None = None) -> HullRun:
    deck = sheet(name) if isinstance(name, str) else name
    return run_hull(deck, lambda name: programs.with_layers(name, layers), options or Options(core=60_000))


def deck(points: Sequence[Sequence[int]]) -> Deck:
    return data_deck([list(map(str, point)) for point in points], "points")


def ran(name: str | Deck, last: str, label: int, see: Callable[[Machine], object]) -> list[object]:
    """Collect ``see(machine)`` each time the statement with this number of program ``last`` begins."""
    observations: list[object] = []

    def watch(program: Program, machine: Machine) -> None:
        def begins(line: Line, machine: Machine) -> None:
            if program.source == last and line.label == label:
                observations.append(see(machine))

        machine.tracer = begins

    run_hull(sheet(name) if isinstance(name, str) else name, programs.program, watch=watch)
    return observations


def value(machine: Machine, name: str) -> object:
    (entry,) = (entry for entry in machine.program.storage.entries if entry.name == name)
    return machine.state.values[entry.first]


def test_1_another_set_runs_forever() -> None:
    """The run never ends, and NE falls far below zero."""
    job = run(
        deck([(4, 5, 2), (1, 0, 7), (2, 8, 5), (2, 9, 1), (0, 8, 6), (8, 9, 3), (6, 9, 5), (3, 8, 7)]),
        options=Options(limit=20_000),
    )
    assert job.final.result.ending.kind == "limit"
    assert {142, 157} <= {line.label for line in job.final.result.ending.loop}


def test_3_twelve_of_sixty_orders_of_the_cube_show_it_and_the_others_show_fault_2() -> None:
    corners = list(product((0, 1), repeat=3))
    through_c = 0
    for seed in range(60):
        Random(seed).shuffle(corners)
        job = run(deck(corners), options=Options(limit=20_000)).final.result
        typed = [event.decision for event in job.events if event.text == "ERROR IN PROGRAM"]
        if typed and typed[0] is not None and typed[0].text == "IF(E(I))135,133,134":
            through_c += 1
        else:
            assert job.ending.kind == "limit" or (typed[0] is not None and typed[0].label == 170)
    assert through_c == 12
    assert "twelve" in ENTRIES[3]


def test_4_a_plane_of_zeros_keeps_its_message() -> None:
    """P3-027 alone would remove the message; with P3-029 it stays."""
    assert answer("zeroplane").outcome == "ERROR IN PROGRAM"
    assert answer("zeroplane", "P3-027").outcome == "table full"
    assert answer("zeroplane", "P3-027", "P3-029").outcome == "ERROR IN PROGRAM"
    assert exactly("zeroplane") == "right"


def test_6_more_digits_correct_it_but_no_row_does() -> None:
    assert answer("18_dec3_n6").outcome == "DATA NOT ACCEPTABLE"
    for row in CORRECTIONS:
        rows = ("P3-027", row) if row == "P3-029" else (row,)
        assert answer("18_dec3_n6", *rows).outcome == "DATA NOT ACCEPTABLE"
    assert exactly("18_dec3_n6") == "right"


def circle_and(point: Triple) -> list[Sequence[int]]:
    """Fifty points of a circle and one last."""
    points = [[int(float(x)) for x in point] for point in sample("polygon51").drawn.points]
    return [*points[:50], point]


def test_7_the_element_past_the_end_is_copied_and_never_used() -> None:
    """N = 51, the last point inside: element 52 is copied to 51."""
    points = circle_and((0, 10, 0))
    (seen,) = ran(deck(points), "program2.f", 119, lambda machine: (value(machine, "J"), value(machine, "N")))
    assert seen == (51, 50)
    assert run(deck(points)).complete
    assert not faults([(x, y, z) for x, y, z in points])


def test_8_the_jump_into_a_do_that_is_not_running_has_no_effect() -> None:
    """K is at least NE there, so the end of the DO increments it past the limit and continues at 191."""
    before = ran("example4", "program2.f", 191, lambda machine: (value(machine, "K"), value(machine, "NE")))
    assert before
    assert all(isinstance(pair, tuple) and pair[0] >= pair[1] for pair in before)
    jumps = ran("renumber", "program2.f", 184, lambda machine: value(machine, "K"))
    in_the_loop = ran("renumber", "program2.f", 182, lambda machine: value(machine, "K"))
    assert len(jumps) > len(in_the_loop) > 0
    assert answer("example4").outcome in ("right", "reordered")


LATE = [(0, 2, 0), (1, 2, 0), (2, 2, 0), (1, 1, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0)]
LATE_3 = [(0, 3, 0), (2, 0, 2), (0, 1, 0), (1, 0, 1), (3, 3, 0), (3, 1, 0), (0, 2, 0), (3, 2, 0)]


def test_9_the_jump_into_the_range_of_143_leaves_it_before_the_end() -> None:
    """158 branches to 138, and 142 with NPNCH = 2 branches to 160, so 143 is not reached."""
    came = ran(deck(LATE), "program2.f", 138, lambda machine: value(machine, "NPNCH"))
    assert 2 in came
    assert len(ran(deck(LATE), "program2.f", 143, lambda machine: 0)) == came.count(0)
    assert len(ran(deck(LATE), "program2.f", 160, lambda machine: 0)) == came.count(2)
    assert not faults([(x, y, z) for x, y, z in LATE])


def test_10_with_switch_1_on_a_rejected_set_continues() -> None:
    off, on = (run("18_dec3_n6", options=Options(switches=frozenset(s), limit=50_000)) for s in ((), (1,)))
    assert off.refusal == "DATA NOT ACCEPTABLE"
    assert "DATA NOT ACCEPTABLE" in on.final.result.typed
    assert on.final.result.statements > off.final.result.statements
    assert on.final.result.typed.count("DATA NOT ACCEPTABLE") > 1


def test_11_format_21_reads_fourteen_columns_for_z() -> None:
    """The data sheet of chapter 5 (p. 59) gives it 29 to 52."""
    widths = [part.width for part in dict(programs.program("program1").formats)[21].specs if isinstance(part, Field)]
    assert (sum(widths[:2]) + 1, sum(widths[:3])) == (29, 42)
    assert "columns 29 to 52 to z, but FORMAT 21 reads z from columns 29 to 42" in " ".join(ENTRIES[11].split())


def ends(first: str, points: list[Triple]) -> set[tuple[Fraction, ...]]:
    """Return the endpoints or vertices that the last program punches."""
    job = run_hull(deck(points), programs.program, first=first)
    return set(read_hull(job.final.result.punched).vertices)


@pytest.mark.parametrize(
    ("points", "wrong", "right"),
    [
        ([(0, 0, 0), (1, 1, 1), (2, 2, 2)], [0, 1], [0, 2]),
        ([(0, 0, 0), (0, 5, 5), (0, 1, 1), (0, 2, 2)], [1, 3], [0, 1]),
    ],
)
def test_12_the_state_of_the_examples_chooses_wrong_endpoints(points, wrong, right) -> None:
    assert ends("program1_examples", points) == {tuple(map(Fraction, points[i])) for i in wrong}
    assert ends("program1", points) == {tuple(map(Fraction, points[i])) for i in right}


@pytest.mark.parametrize(
    ("exponent", "words"),
    [
        ("E-16", "POINTS ARE NOT COPLANAR"),
        ("E-17", "POINTS ARE COPLANAR"),
        ("E-49", "POINTS ARE COPLANAR"),
        ("E-50", "POINTS ARE COLLINEAR"),
    ],
)
def test_13_small_points_in_space_pass_for_coplanar_and_smaller_ones_for_collinear(exponent: str, words: str) -> None:
    points = [(1, 2, 3), (2, 1, 5), (4, 4, 1), (3, 9, 2), (7, 1, 1)]
    cards = ["".join(f"+.{x}0000000{exponent}" for x in point) for point in points]
    first = run(deck_from_lines("small", [" 5", *cards])).steps[0].result
    assert words in (*first.typed, *first.punched)


@pytest.mark.parametrize(("points", "program"), [(LATE, "program2"), (LATE_3, "program3")])
def test_17_the_heading_of_boundary_points_is_punched_twice(points: list[Triple], program: str) -> None:
    """The points are right; only the heading is wrong."""
    job = run(deck(points))
    assert job.final.name == program
    assert sum("BOUNDARY POINTS" in line for line in job.final.result.punched) == 2
    assert not faults(points)


def thirds(flat: bool) -> list[list[Point]]:
    """Return sixty sets of 5 to 20 points with integers from -9 to 9."""
    sets = []
    for seed in range(60):
        random = Random(seed)

        def draw(random: Random = random) -> Point:
            return random.randint(-9, 9), random.randint(-9, 9), 1 if flat else random.randint(-9, 9)

        sets.append(distinct(draw, random.choice((5, 8, 12, 20))))
    return sets


@pytest.mark.parametrize(("flat", "refused", "errors"), [(True, 54, 0), (False, 1, 6)])
def test_18_translation_costs_digits(flat: bool, refused: int, errors: int) -> None:
    runs = run_all(thirds(flat), "translation", "corrected")
    refusals = [hull_run.refusal for hull_run in runs if isinstance(hull_run, HullRun)]
    assert refusals.count("DATA NOT ACCEPTABLE") == refused
    assert refusals.count("ERROR IN PROGRAM") == errors
    entry = " ".join(ENTRIES[18].split())
    in_space = f"Of 60 sets in space, they reject {refused} set, and {errors} more sets end in ERROR IN PROGRAM"
    assert (f"reject {refused} of 60 coplanar sets" if flat else in_space) in entry
    assert not faulty_sets([(str(k), points) for k, points in enumerate(thirds(flat))], "corrected")


def test_19_points_nearly_in_a_plane_of_constant_z_are_projected_onto_a_line() -> None:
    points = [["0", "0", "1"], ["10", "0", "1"], ["0", "10", "1"], ["10", "10", "1.01"]]
    job = run(with_epsilon(data_deck(points, "points"), "1"), "epsilon", "corrected")
    hull = read_hull(job.final.result.punched)
    assert job.final.name == "program2"
    assert (len(hull.vertices), len(hull.equations)) == (2, 1)
