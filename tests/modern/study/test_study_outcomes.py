"""Every outcome has a deck, from KNOWN-FAULTS and its grounds, and batches agree with single runs."""

import random
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

import pytest

from emulator.errors import EmulatorError
from emulator.language.objectcode import Line
from emulator.machine.machine import Machine
from emulator.machine.result import Ending, Options
from modern.comparison.difference import NEAR, disagreement
from modern.edition import programs
from modern.edition.grounds import ground_deck
from modern.formats.deck import with_epsilon
from modern.formats.points import parse_input
from modern.study import Cell, Port, Programs, Route
from modern.study.families import draw_sample
from modern.study.families.draws import Drawn
from modern.study.outcomes import OUTCOMES, Answer, answer_of_run, number_text, position, reordered
from modern.study.routes import carry_out, options_of, programs_of
from modern.study.sample import Sample, judge
from modern.thesis.batch import Runs, run_hulls
from modern.thesis.job import HullRun, run_hull
from tests.support import judged as shared
from tests.support.paths import MACHINE_RUNS

MENDED = Programs("mended", layers=("corrected",), core=60_000, limit=1_000_000)
LISTED = Programs("listed", limit=200_000)
DATA = MACHINE_RUNS


def points_of(name: str) -> tuple[tuple[str, str, str], ...]:
    """Return the points of a ground, an example, or one of the fourteen machine runs."""
    ground = ground_deck(name)
    text = ground.text() if ground else (DATA / name / "deck.cards").read_text(encoding="ascii")
    return parse_input(text, name).points


def sample(points: Sequence[Sequence[int | str]] | str) -> Sample:
    given = points_of(points) if isinstance(points, str) else points
    return judge(Drawn(tuple((str(x), str(y), str(z)) for x, y, z in given)), "sample")


def answer(points: Sequence[Sequence[int | str]] | str, route: Route = LISTED) -> Answer:
    (one,) = carry_out(route, [sample(points)], Runs())
    return one


WIDE = (("-9.29338", "-665.584", "77.1559"), ("-901.188", "559.572", "-9.24498"), (".784109", "-.105629", "-6.76054"),
        (".196793", "781.145", "14.3048"))  # fmt: skip
FLAT = ((1, -4659, -4675), (1, -3389, -3405), (1, 141, 125), (1, 3619, 3603))
PRISM = ((117, -992, 357), (117, -992, -864), (556, 830, 357), (-999, -1, 357), (556, 830, -864), (-999, -1, -864))

CASES = [
    ("example5", LISTED, "right", ""),
    ("example2", LISTED, "right", ""),
    ("example1", LISTED, "right", ""),
    ("example3", LISTED, "right", ""),
    ("18_dec3_n6", LISTED, "DATA NOT ACCEPTABLE", "program3 119"),
    ("lastpair", LISTED, "ERROR IN PROGRAM", "program3 147"),
    ("throughc", LISTED, "ERROR IN PROGRAM", "program3 132+3"),
    ("zeroplane", MENDED, "ERROR IN PROGRAM", "program3 216"),
    ("39_prism_n10", LISTED, "endless", "program3 157-169"),
    ("polygon51", LISTED, "out of bounds", "program2 A(52)"),
    ("between", LISTED, "wrong hull", "vertex missed"),
    ("renumber", LISTED, "wrong hull", "vertices of a plane wrong"),
    (WIDE, Programs("moved", layers=("translation", "epsilon"), epsilon="1", core=60_000), "wrong hull",
     "coordinates changed"),
    (FLAT, replace(MENDED, arithmetic="truncating:3"), "wrong hull", "dimension wrong"),
    (((155, -160, -164), (-25, 176, 189), (24, -108, 65)), replace(LISTED, arithmetic="truncating:3"), "wrong hull",
     "equations wrong"),
    (((8, -7, -7), (8, -2, 5), (5, 7, -7), (1, 7, 6), (8, 9, 4)), replace(MENDED, arithmetic="truncating:3"),
     "wrong hull", "plane missed"),
    (PRISM, replace(LISTED, bounds="core"), "stopped otherwise", "select in program3 126+4"),
    ("zeroplane", Port("truncating", "truncating"), "ERROR IN PROGRAM", "program3 133"),
    ("18_dec3_n6", Port("float64", "float64"), "DATA NOT ACCEPTABLE", "program3 119"),
    ("example6", Port("exact"), "right", ""),
]  # fmt: skip


@pytest.mark.parametrize(("points", "route", "outcome", "detail"), CASES)
def test_deck_has_the_expected_outcome(points, route, outcome, detail) -> None:
    found = answer(points, route)
    assert (found.outcome, found.detail) == (outcome, detail)


def test_full_tables_and_every_outcome_have_a_case() -> None:
    # KNOWN-FAULTS 5: with the last pair corrected, the 28 points of the ground reach the end of the table.
    found = answer("table", Programs("one mend", rows=("P3-025",)))
    assert (found.outcome, found.detail) == ("table full", "program3 MM(99)")
    assert answer("table", MENDED).outcome == "right"
    assert {outcome for _, _, outcome, _ in CASES} | {
        "table full",
        "reordered",
        "doubled plane",
        "undefined value",
    } == set(OUTCOMES)


def test_order_is_compared_only_with_the_reference() -> None:
    """The examples' state of program 1 orders points differently from the listing."""
    listed, examples = answer("example5"), answer("example5", Programs("examples", state="examples"))
    assert listed.outcome == examples.outcome == "right"
    assert reordered(examples, listed).outcome == "reordered"
    assert reordered(examples, examples).outcome == "right"
    wrong = answer("lastpair")
    assert reordered(listed, wrong) == listed
    assert reordered(wrong, listed) == wrong


def small_sets(count: int) -> list[list[shared.Point]]:
    """Sets of fewer than 14 points from all families of the tests."""
    return [points for _, points in shared.sets(count, 3) if len(points) < 14]


def run_of(name: str) -> tuple[HullRun, Sample]:
    one = sample(name)
    (run,) = run_hulls([one.deck], programs_of(LISTED)[1], options_of(LISTED))
    assert isinstance(run, HullRun)
    return run, one


def punched_otherwise(run: HullRun, cards: Sequence[str]) -> HullRun:
    last = replace(run.final, result=replace(run.final.result, punched=tuple(cards)))
    return HullRun((*run.steps[:-1], last))


def answered(run: HullRun, one: Sample) -> tuple[str, str]:
    found = answer_of_run(run, one, Options())
    return found.outcome, found.detail


def test_altered_cards_have_the_expected_fault() -> None:
    """Faults that no deck causes: a doubled plane, or a vertex, plane or point too many."""
    run, one = run_of("example5")
    cards = list(run.final.result.punched)
    equations = next(k for k, card in enumerate(cards) if card.startswith("EQUATIONS"))
    rows = [k for k in range(equations, len(cards)) if cards[k].count("E") == 4 and "." in cards[k]]
    first, last = cards[rows[0]], rows[-1]
    count = len(rows)
    again = f"{count + 1:5d}{first[5:]}"
    # The vertices that satisfy the plane repeated are said again with its new number.
    satisfied = [card for card in cards[last + 1 :] if card.split() and card.split()[-1] == "1" and "E" not in card]
    assert satisfied
    more = [card.rstrip()[: len(card.rstrip()) - 1] + str(count + 1) for card in satisfied]
    end = cards.index("CONVEX HULL HAS BEEN DETERMINED")
    twice = [*cards[: last + 1], again, *cards[last + 1 : end], *more, *cards[end:]]
    assert answered(punched_otherwise(run, twice), one) == ("doubled plane", "1")
    assert answered(punched_otherwise(run, [c for k, c in enumerate(cards) if k != last]), one)[1] == "plane missed"
    foreign = again.replace(again.split()[1], "-.12345678E+05")
    extra = [*cards[: last + 1], foreign, *cards[last + 1 :]]
    assert answered(punched_otherwise(run, extra), one) == ("wrong hull", "plane too many")
    inside = next(k for k, card in enumerate(cards) if card.startswith("INSIDE"))
    moved = next(k for k in range(inside, len(cards)) if cards[k].count("E+") == 3)
    assert answered(punched_otherwise(run, [c for k, c in enumerate(cards) if k != moved]), one)[1] == "point misfiled"
    vertices = cards.index("VERTICES")
    corner = next(k for k in range(vertices, len(cards)) if cards[k].count("E") == 3 and "." in cards[k])
    added = [*cards[:corner], f"   1  {cards[moved].strip()}", *cards[corner:]]
    assert answered(punched_otherwise(run, added), one) == ("wrong hull", "vertex too many")
    fewer = [c for k, c in enumerate(cards) if k != corner]
    assert answered(punched_otherwise(run, fewer), one) == ("wrong hull", "vertex missed")


@pytest.mark.parametrize(
    ("printed", "outcome"),
    [
        (".00000000E-99   .45000000E+02   .00000000E-99  -.90000000E+02", "right"),
        (".00000000E-99  -.20000000E+01   .00000000E-99   .40000000E+01", "right"),
        (".10000000E+01   .45000000E+02   .00000000E-99  -.90000000E+02", "wrong hull"),
        (".00000000E-99   .00000000E-99   .45000000E+02  -.90000000E+02", "wrong hull"),
        (".00000000E-99   .45000000E+02   .00000000E-99  -.91000000E+02", "wrong hull"),
    ],
)
def test_plane_of_coplanar_points_is_checked(printed: str, outcome: str) -> None:
    """Example 4 lies in y = 2.  Its plane is wrong if rotated or moved, and right if multiplied."""
    run, one = run_of("example4")
    cards = list(run.final.result.punched)
    title = next(k for k, card in enumerate(cards) if card.startswith("COEFFICIENTS OF AN EQUATION"))
    where = next(k for k in range(title, len(cards)) if cards[k].count("E") == 4 and "." in cards[k])
    cards[where] = f"{'':7}{printed}"
    assert answered(punched_otherwise(run, cards), one) == (outcome, "" if outcome == "right" else "equations wrong")


def test_detail_of_other_endings_names_the_statement() -> None:
    """No deck has reached an undefined value (OPEN-QUESTIONS 22); the ending of a run is replaced."""
    run, one = run_of("example5")
    line = next(line for line in run.final.program.statements if line.place.card == 99)
    where = f"program3 {position(run.final.program, line)}"

    def ended(ending: Ending) -> tuple[str, str]:
        last = replace(run.final, result=replace(run.final.result, ending=ending))
        return answered(HullRun((*run.steps[:-1], last)), one)

    assert ended(Ending("undefined", line=line, name="A(7)")) == ("undefined value", where)
    assert ended(Ending("mode", line=line, name="A(7)", mode="fixed")) == ("stopped otherwise", f"mode in {where}")
    assert ended(Ending("outside", line=line)) == ("out of bounds", where)
    below = Ending("bounds", line=line, name="A", shape=(98,), subscripts=(0,))
    assert ended(below) == ("out of bounds", "program3 A(0)")
    assert ended(replace(below, subscripts=(99,))) == ("table full", "program3 A(99)")
    assert ended(replace(below, name="X", subscripts=(99,))) == ("out of bounds", "program3 X(99)")
    assert ended(replace(below, name="XY", shape=(3, 9), subscripts=(4, 1))) == ("out of bounds", "program3 XY(4,1)")
    loop = tuple(line for line in run.final.program.statements if 100 <= line.place.card <= 110)
    first, last = position(run.final.program, loop[0]), [line.label for line in loop if line.label][-1]
    assert ended(Ending("limit", count=9, loop=loop, repeats=True)) == ("endless", f"program3 {first}-{last}")


def test_batch_agrees_with_runs_of_single_decks() -> None:
    sets = [points for _, points in shared.sets(40, 5) if len(points) < 20]
    sets += [points_of(f"example{k}") for k in range(1, 7)] + [points_of("lastpair"), points_of("39_prism_n10")]
    data = [shared.deck_of(points) for points in sets]
    options = Options(limit=20_000)
    for first in ("program1", "program1_examples"):
        batch = run_hulls(data, programs.loader(()), options, first)
        assert batch == [run_hull(deck, programs.loader(()), options, first) for deck in data]


def test_unreadable_deck_does_not_stop_the_others() -> None:
    good, bad = shared.deck_of([(0, 0, 0)]), shared.deck_of([(0, 0, 0), (1, 0, 0)])
    bad = replace(bad, cards=bad.cards[:2])
    batch = run_hulls([good, bad, good], programs.loader(()))
    assert isinstance(batch[1], EmulatorError)
    assert batch[0] == batch[2] == run_hull(good, programs.loader(()))


def test_deciding_statement_agrees_with_a_trace() -> None:
    """It is the last IF before the message in a trace of the run."""
    seen = set()
    for points in small_sets(90):
        one = sample(points)
        (run,) = run_hulls([one.deck], programs_of(LISTED)[1], options_of(LISTED))
        assert isinstance(run, HullRun)
        if run.refusal != "ERROR IN PROGRAM":
            continue
        step = run.final
        told = answer_of_run(run, one, options_of(LISTED)).detail
        lines: list[Line] = []
        machine = Machine(step.program, step.deck, options_of(LISTED))
        machine.tracer = lambda line, _, lines=lines: lines.append(line)
        machine.run()
        typed = max(k for k, line in enumerate(lines) if line.text.startswith("PRINT"))
        assert told == f"{step.name} {position(step.program, lines[typed - 1])}"
        seen.add(told)
    assert len(seen) > 1


def test_single_rows_are_added_without_the_rest_of_their_layer() -> None:
    _, load = programs_of(Programs("one", rows=("P3-025",)))
    others = {row.id for row in programs.text("program3").rows if row.layer == "corrected"} - {"P3-025"}
    built = programs.built("program3", ("corrected",), others)
    assert len(load("program3").statements) == len(programs.program("program3").statements) + 1
    assert [card.text for card in built.cards if card not in programs.committed("program3").cards]
    assert load("program1") == programs.program("program1")
    slabs = Cell({}, "thesis", {"kinds": {"slab": 1}, "n": [12, 17]}, (), 1)
    ones = [judge(draw_sample(slabs, 2, k), "slab") for k in range(120)]
    before = carry_out(LISTED, ones, Runs())
    after = carry_out(replace(LISTED, rows=("P3-025",)), ones, Runs())
    last_pair = ("program3 147", "program3 142-160")
    mended = [late for early, late in zip(before, after, strict=True) if early.detail in last_pair]
    assert "right" in {one.outcome for one in mended}
    assert all(one.detail not in last_pair for one in after)


def test_points_are_compared_as_a_program_with_fewer_digits_reads_them() -> None:
    """Programs with four digits punch truncated points of five digits, whose vertices are still identified."""
    corners = [("10001", "0", "0"), ("0", "10001", "0"), ("0", "0", "10001"), ("-10001", "-10001", "-10001")]
    found = answer(corners, replace(LISTED, arithmetic="truncating:4"))
    assert found.outcome in ("right", "wrong hull")
    assert found.detail != "coordinates changed"


def test_coefficient_error_is_measured() -> None:
    """For planes of three digits with an e, the error is that of the punched cards in exact arithmetic."""
    route = replace(MENDED, layers=("epsilon", "corrected"), epsilon="1000")
    rng, sized = random.Random(4), 0
    ones = [sample([[rng.randint(-2000, 2000) for _ in range(3)] for _ in range(4)]) for _ in range(30)]
    data = [with_epsilon(one.deck, "1000") for one in ones]
    runs = run_hulls(data, programs_of(route)[1], options_of(route))
    for one, found, run in zip(ones, carry_out(route, ones, Runs()), runs, strict=True):
        if found.outcome != "right" or not isinstance(run, HullRun) or run.final.name != "program3":
            continue
        seen = shared.read_hull(run.final.result.punched)
        worst = Fraction(0)
        for equation in seen.equations:
            size = max(map(abs, equation[:3]))
            errors = []
            for other in one.outcome.equations:
                scale = max(map(abs, other[:3]))
                gaps = [abs(a / size - b / scale) for a, b in zip(equation, other, strict=True)]
                errors.append(max(*gaps[:3], gaps[3] / max(Fraction(1), abs(other[3] / scale))))
            worst = max(worst, min(errors))
        assert found.figures["coefficient_error"] == number_text(worst)
        sized += bool(worst)
    assert sized


@pytest.mark.parametrize(
    ("value", "text"),
    [(Fraction(0), "0"), (Fraction(1, 3), "0.333333"), (Fraction(2, 3), "0.666667"), (Fraction(25, 10**12), "2.5E-11")],
)
def test_figures_are_rounded_to_six_digits(value: Fraction, text: str) -> None:
    assert number_text(value) == text


def test_doubled_equation_and_similar_equation_are_distinguished() -> None:
    """``places`` holds the exact equation to which each equation of the run belongs, or -1 beyond NEAR."""
    one = sample("example5")
    right = one.outcome
    a, b, c, d = right.equations[1]
    near, far = (a * (1 + NEAR / 2), b, c, d), (a + 3 * max(map(abs, (a, b, c))), b, c, d)
    found = disagreement(replace(right, equations=(*right.equations, near, far)), right, one.points)
    assert found.places == (*range(len(right.equations)), 1, -1)
    assert (found.planes_doubled, found.planes_extra, found.planes_missing) == (1, 1, 0)
