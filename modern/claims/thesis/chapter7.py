"""Claims of chapters 5 and 7: the machine, the data sheet, where data are refused, errors, the two modifications.

What the programs do is seen by running them on small decks; what eight digits do, on three or four points in the
arithmetic of the emulator.
"""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from itertools import combinations

import numpy as np

from emulator.language.cards import Deck, deck_from_text
from emulator.language.objectcode import code_positions
from emulator.language.storage import FIELD, FUNCTION_NAMES, OBJECT_PROGRAM
from emulator.machine.result import Options
from modern.claims.register import CONDITION, FAILS, HOLDS, Seen, counterexample, seen
from modern.claims.sampled_sets import Point, SampledSet, sampled_sets, through
from modern.claims.thesis.chapter3_equations import COUNT
from modern.comparison.outcome import from_cards
from modern.edition import programs
from modern.exact_hull import exact_hull
from modern.formats.csv import points as csv_points
from modern.formats.deck import coordinate_field, data_deck, exact_points
from modern.geometry.vectors import dot
from modern.port import convex_hull
from modern.port.formulas import at, plane
from modern.port.points import take
from modern.thesis.job import HullRun, run_hull

CORE, SMALLER_CORE = 40_000, 20_000
THREE = ("program1", "program2", "program3")
PLACES = 98
_FOURTH: tuple[Point, ...] = ((-185, 158, -52), (51, -195, -195), (23, -33, 59), (-1517, 1790, 44))
_THREE: tuple[Point, ...] = ((-220, -492, 405), (-70, -270, -113), (-452, 485, -366))


def deck_of(name: str) -> Deck:
    """A counterexample that is a data deck."""
    return deck_from_text(name, counterexample(name))


@cache
def run_of(name: str) -> HullRun:
    """A counterexample that is a data deck through the listing."""
    return run_hull(deck_of(name), programs.program, Options(limit=100_000))


def typed(run: HullRun) -> str:
    """What the typewriter has of all programs of a run."""
    return " / ".join(line for step in run.steps for line in step.result.typed)


def programs_compile(kind: str = "") -> Seen:
    """The decks of the listing compile."""
    cards = {name: len(programs.deck(name).cards) for name in THREE}
    compiled = all(programs.program(name).code for name in THREE)
    words = ", ".join(f"{name}: {n} cards" for name, n in cards.items())
    return Seen((CONDITION if kind else HOLDS) if compiled else FAILS, words)


def _positions(name: str) -> int:
    program = programs.program(name)
    return OBJECT_PROGRAM + FUNCTION_NAMES + code_positions(program) + program.storage.fields * FIELD


def each_program_fits() -> Seen:
    """Positions of each program with its data, by the estimate of the compiler's code; 20,000 would not do."""
    found = [_positions(name) for name in THREE]
    return seen(SMALLER_CORE < max(found) <= CORE, f"about {', '.join(f'{n:,}' for n in found)} positions")


def three_programs_needed() -> Seen:
    """One program of all three would need the code of each beside the data of the largest."""
    code = sum(code_positions(programs.program(name)) for name in THREE)
    data = max(programs.program(name).storage.fields * FIELD for name in THREE)
    total = OBJECT_PROGRAM + FUNCTION_NAMES + code + data
    return Seen(
        CONDITION if total > CORE else FAILS,
        f"about {total:,} positions for the code of all three and the data of the largest",
    )


def fifty_one() -> Seen:
    """Arrays of 51 points, and a deck of fewer for which the places for planes do not do."""
    points, _ = exact_points(deck_of("table.deck"))
    sizes = {entry.size for entry in programs.program("program3").storage.arrays()}
    most = _most_planes(np.array([[int(Fraction(x)) for x in point] for point in points.values()], dtype=np.int64))
    words = f"{len(points)} points need {most} places for planes at once; program 3 has {PLACES}"
    return Seen(CONDITION if sizes == {51, PLACES} and len(points) <= 51 and most > PLACES else FAILS, words)


def _most_planes(points: np.ndarray) -> int:
    """Places in use at once: of each step those before it, three more for each plane replaced, one less at a time."""
    hull = convex_hull(points, history=True)
    pairs = zip(hull.history, hull.history[1:], strict=False)
    return max(len(before.equations) + 2 * after.outside + 1 for before, after in pairs)


def plane_through_c() -> Seen:
    """The deck of KNOWN-FAULTS 3: what is typed, and that the judge has a hull."""
    words = typed(run_of("throughc.deck"))
    points = [[*map(Fraction, point)] for point in exact_points(deck_of("throughc.deck"))[0].values()]
    judge = exact_hull(points)
    good = words.endswith("ERROR IN PROGRAM") and judge.dimension == 3
    return Seen(
        FAILS if good else HOLDS,
        f"typed: {words}; the judge: {len(judge.vertices)} vertices, {len(judge.facets)} planes",
    )


def roots_that_do_not_add_up() -> Seen:
    """The deck of KNOWN-FAULTS 14: the vertices the listing punches are not the judge's."""
    found, judge = vertices_of("between.deck")
    words = f"{len(found ^ judge)} points differ between the punched vertices and the judge's"
    return Seen(CONDITION if found != judge else FAILS, words)


def vertices_of(name: str) -> tuple[set[int], set[int]]:
    """The vertices that the listing punches of a counterexample, and the judge's, by place."""
    points = [tuple(map(Fraction, point)) for point in exact_points(deck_of(name))[0].values()]
    outcome = from_cards("listing", run_of(name), points)
    return set(outcome.vertices), set(exact_hull([*map(list, points)]).vertices)


def silent_loss() -> Seen:
    """Four points of five digits: a wrong hull without a message."""
    found, judge = vertices_of("silent.deck")
    words = typed(run_of("silent.deck"))
    good = found != judge and "NOT ACCEPTABLE" not in words
    return Seen(FAILS if good else HOLDS, f"{len(found)} of {len(judge)} vertices are punched; typed: {words}")


def notation() -> Seen:
    """The names of chapter 3 among the variables of programs 2 and 3."""
    names = {entry.name for entry in programs.program("program3").storage.arrays()}
    text = programs.deck("program3").text() + programs.deck("program2").text()
    wanted = ("NETC", "NE", "NV", "MM", "NN", "KK")
    return seen(
        {"MM", "NN", "KK"} <= names and all(f"{name}=" in text or name in names for name in wanted), ", ".join(wanted)
    )


def inside_heading() -> Seen:
    """Program 3 punches FORMAT 5, the heading of inside points, once: INSID is 1 before, 2 after."""
    cards = [card.text.strip() for card in programs.deck("program3").cards]
    place = next(k for k, card in enumerate(cards) if card.endswith("PUNCH 5"))
    heading = next(card for card in cards if card.startswith("5 FORMAT"))
    good = "INSIDE POINTS" in heading and cards[place + 1] == "INSID=2" and cards.index("INSID=1") < place
    good &= cards[place - 1].endswith("GO TO (109,110), INSID") and cards[place].startswith("109")
    return seen(good, f"{cards[place - 1]} / {cards[place]} / {cards[place + 1]}")


def eight_digits() -> Seen:
    """A card's field has eight digits and no room for a ninth; a ninth digit of a product is dropped."""
    try:
        coordinate_field("1.23456789")
    except ValueError as error:
        return seen(coordinate_field("1.2345678") == "+.12345678E+01", str(error))
    return Seen(FAILS, "a ninth digit fits")


def no_rounding() -> Seen:
    """2/3 in eight digits ends in 6."""
    arithmetic, row = take([("2", "3", "1")], "truncating")
    quotient = arithmetic.text(arithmetic.quotient(row[0][0], 3), 1)
    return seen(Fraction(quotient) == Fraction(66666666, 10**8), f"2 / 3 is {quotient}")


def two_kinds_of_errors(kind: str = "") -> Seen:
    """A third cut to eight digits is another point; coefficients of exact points are cut, or exact with more digits."""
    third = coordinate_field("0.333333333", truncate=True)
    cut, exact = (_coefficients(_THREE, arithmetic) for arithmetic in ("truncating", "exact"))
    wanted = [*map(Fraction, through(*_THREE))]
    differ = [a != b for a, b in zip(cut, wanted, strict=True)]
    good = third == "+.33333333E+00" and any(differ) and exact == wanted
    if kind:
        good &= bool(_misses(_THREE)) and not _misses(_THREE, "exact")
    return seen(
        good, f"1/3 as a card holds it; {sum(differ)} coefficients of a plane cut, none of them in exact numbers"
    )


def _coefficients(points: tuple[Point, ...], name: str) -> list[Fraction]:
    arithmetic, rows = take(points, name)
    found = plane(*(tuple(rows[axis][k] for axis in range(3)) for k in range(3)))
    return [Fraction(arithmetic.exact(x, degree)) for x, degree in zip(found, (2, 2, 2, 3), strict=True)]


def _misses(points: tuple[Point, ...], name: str = "truncating") -> list[int]:
    """Which of the points do not satisfy the plane of the first three in the machine's arithmetic."""
    arithmetic, rows = take(points, name)
    all_points = [tuple(rows[axis][k] for axis in range(3)) for k in range(len(points))]
    equation = plane(*all_points[:3])
    return [k for k, point in enumerate(all_points) if not arithmetic.is_zero(at(equation, point))]


def own_plane_missed() -> Seen:
    """Three points of three digits that do not satisfy their own plane."""
    missed = _misses(_THREE)
    return seen(bool(missed), f"points {', '.join(str(_THREE[k]) for k in missed)} of the plane through the three")


def fourth_point_missed() -> Seen:
    """A fourth point exactly in the plane of three that satisfy it."""
    exactly = not any(sum(a * x for a, x in zip(through(*_FOURTH[:3]), (*_FOURTH[3], 1), strict=True)) for _ in (0,))
    return seen(exactly and _misses(_FOURTH) == [3], f"{_FOURTH[3]} lies in the plane of the other three exactly")


def where_data_are_refused() -> Seen:
    """Which programs have the message."""
    has = [name for name in THREE if "DATA NOT ACCEPTABLE" in programs.deck(name).text()]
    return Seen(CONDITION if has == ["program2", "program3"] else FAILS, f"the message stands in {' and '.join(has)}")


def vertex_overlooked() -> Seen:
    """A point about a tenth above a plane, in the port: exactly, and with e = 20."""
    points = [("0", "0", "0"), ("4", "0", "0"), ("0", "4", "0"), ("0", "0", "4"), ("1.4", "1.4", "1.4")]
    without, with_e = convex_hull(points), convex_hull(points, epsilon="20")
    return seen(
        4 in without.vertices and 4 not in with_e.vertices, "(1.4, 1.4, 1.4) is a vertex, with e = 20 it is none"
    )


def interval_is_a_solution() -> Seen:
    """Points in space whose first three miss their own plane: refused, and with e = 10 the hull is right.

    With e = 10,000,000 it is not.
    """
    points = [*_THREE, (101, 77, -340), (250, 333, 90)]
    whole = [tuple(map(str, point)) for point in points]
    hulls = [convex_hull(whole, "truncating", epsilon=e, on_refusal="return") for e in (None, "10", "10000000")]
    judge = exact_hull(points)
    right = [hull.determined and {*hull.vertices} == {*judge.vertices} for hull in hulls]
    words = f"{hulls[0].status}; with e = 10 {hulls[1].status}; with e = 10,000,000 {len(hulls[2].vertices)} vertices"
    return Seen(CONDITION if right == [False, True, False] else FAILS, words)


def value_is_no_distance() -> Seen:
    """A point at the distance 1 of a plane, with a value of a hundredth."""
    found, _ = csv_points(counterexample("short_normal.csv"), "short_normal.csv")
    p, q, r, x = (tuple(map(Fraction, map(str, point))) for point in found)
    a, b, c, d = plane(p, q, r)  # type: ignore[arg-type]
    value = at((a, b, c, d), x)
    distance = value * value / (a * a + b * b + c * c)
    return Seen(CONDITION if distance == 1 and abs(value) == Fraction(1, 100) else FAILS, "value 1/100, distance 1")


def turned_by_c(count: str = COUNT) -> Seen:
    """The judge's planes of each H_j, which are outward, are negative at C; one that is struck may pass through C."""
    good = []
    for one in sampled_sets(3, int(count)):
        added = one.hull.history[0].added
        total = _sum(one.points, added)
        for stage in one.stages():
            planes = [f.plane for f in exact_hull([one.points[k] for k in stage.vertices]).facets]
            good += [dot(plane[:3], total) + plane[3] * len(added) < 0 for plane in planes]
    through_c = plane_through_c().verdict == FAILS
    return Seen(CONDITION if all(good) and through_c else FAILS, f"{len(good)} planes of all H_j")


def _sum(points: tuple[Point, ...], which: tuple[int, ...]) -> tuple[int, int, int]:
    x, y, z = (sum(points[k][axis] for k in which) for axis in range(3))
    return x, y, z


def constant_term_is_enough(count: str = COUNT) -> Seen:
    """With the origin at C the constant term has the sign of the value at C, in the planes of all H_j, turned or not.

    Of any three points of the set too: where the plane passes through C both are 0.
    """
    good = []
    for one in sampled_sets(3, int(count)):
        added = one.hull.history[0].added
        x, y, z = total = _sum(one.points, added)
        moved = [tuple(len(added) * x - t for x, t in zip(point, total, strict=True)) for point in one.points]
        for defining in {*combinations(range(5), 3), *(d for stage in one.stages() for d in stage.defining)}:
            a, b, c, d = through(*(one.points[k] for k in defining))
            there, constant = a * x + b * y + c * z + d * len(added), through(*(moved[k] for k in defining))[3]  # type: ignore[arg-type]
            good.append((constant > 0, constant < 0) == (there > 0, there < 0))
    return Seen(CONDITION if all(good) and plane_through_c().verdict == FAILS else FAILS, f"{len(good)} constant terms")


def _equations_made(one: SampledSet) -> int:
    stages = one.hull.history
    first = len(stages[0].equations)
    return first + sum(3 * stage.outside for stage in stages[1:])


def normalizing_an_equation() -> Seen:
    """Operations of the formula that puts C into an equation; the constant term is there and takes none."""
    done: list[str] = []

    class Counted(int):
        def __mul__(self, other: int) -> Counted:
            done.append("product")
            return Counted(int(self) * int(other))

        def __add__(self, other: int) -> Counted:
            done.append("sum")
            return Counted(int(self) + int(other))

    at(tuple(map(Counted, (1, -2, 3, -4))), tuple(map(Counted, (5, 6, 7))))
    products, sums = done.count("product"), done.count("sum")
    return seen(products > 0 < sums, f"{products} products and {sums} sums an equation; none with the origin at C")


def translation_depends(count: str = COUNT) -> Seen:
    """Sums saved, three an equation, against sums of the translation, six a point."""
    few = [3 * _equations_made(one) - 6 * len(one.points) for one in sampled_sets(3, int(count))]
    many = 3 * 4 - 6 * 51
    return seen(max(few) > 0 > many, f"sums saved: {', '.join(map(str, few))}; of 51 points in a tetrahedron {many}")


def data_sheet(part: str) -> Seen:
    """The sample cards of pages 58 and 59."""
    if part == "columns":
        points, _ = exact_points(deck_of("z_in_39.deck"))
        z = [point[2] for point in points.values()][-1]
        return Seen(FAILS if Fraction(z) != 1 else HOLDS, f"a z of 1 punched in columns 39 to 52 is read as {z}")
    if part == "blank":
        last = len(data_deck([["3", "12", ".0146"]], "one").cards[-1].text.rstrip())
        return Seen(CONDITION if last == 42 else FAILS, f"three fields of 14 columns end in column {last}")
    if part == "digits":
        printed = "+.3000000E+01"
        whole = coordinate_field("3")
        good = len(printed) == len(whole) - 1 and printed.replace("E", "0E") == whole
        return Seen(CONDITION if good else FAILS, f"{printed} has {len(printed)} characters, a field {len(whole)}")
    numbers = {"12": "+.12000000E+02", ".0146": "+.14600000E-01", ".0261": "+.26100000E-01", "6": "+.60000000E+01"}
    return seen(all(coordinate_field(value) == field for value, field in numbers.items()), ", ".join(numbers))
