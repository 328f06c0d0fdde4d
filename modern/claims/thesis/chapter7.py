"""Checks of chapters 5 and 7: the machine, the data sheet, rejected data, errors and the two modifications."""

import re
from collections.abc import Iterable
from decimal import Decimal
from fractions import Fraction
from functools import cache, reduce
from itertools import combinations, pairwise, permutations
from random import Random
from typing import Any

from emulator.language.cards import Deck, deck_from_lines, deck_from_text
from emulator.language.objectcode import Line, Program
from emulator.language.storage import FIELD, FUNCTION_NAMES, OBJECT_PROGRAM
from emulator.machine.machine import Machine
from emulator.machine.result import Options
from emulator.machine.session import Session
from emulator.objectdeck.extent import code_positions
from modern.claims.evidence import Check, Generator, claim, exhibited, identity, proved, refuted, search, searched, slip
from modern.claims.hulls import convex_hull, exact_hull
from modern.claims.register import statements_of
from modern.claims.sampled_sets import CASES, SETS, Point, counterexample, plane_through, plane_value, sampled_sets
from modern.claims.thesis.chapter3_steps import between_by_distances
from modern.comparison.difference import disagreement
from modern.comparison.outcome import Vector, from_cards, from_hull, from_judge
from modern.edition import programs
from modern.formats.csv import points as csv_points
from modern.formats.deck import coordinate_field, data_deck, exact_points
from modern.geometry.vectors import dot
from modern.port.arithmetic import at, distance_squared, plane
from modern.port.points import take
from modern.thesis.cards import read_hull
from modern.thesis.job import HullRun, run_hull

CORE, SMALLER_CORE = 40_000, 20_000
THREE = ("program1", "program2", "program3")
PLACES = 98
_FOURTH: tuple[Point, ...] = ((-185, 158, -52), (51, -195, -195), (23, -33, 59), (-1517, 1790, 44))
_THREE: tuple[Point, ...] = ((-220, -492, 405), (-70, -270, -113), (-452, 485, -366))
_REJECTED: tuple[Point, ...] = (*_THREE, (101, 77, -340), (250, 333, 90))
# Five points for which program 3 replaces a plane that misses its points in eight digits before it tests the plane.
_NOT_TESTED: tuple[Point, ...] = ((2, 6, 3), (731, 0, 52), (3, 916, 4), (4, 400, 522), (16, 1, 1))


def deck_of(name: str) -> Deck:
    """Return a counterexample of ``transcripts/counterexamples`` that is a data deck."""
    return deck_from_text(name, counterexample(name))


@cache
def run_of(name: str) -> HullRun:
    """Run the listing on a counterexample that is a data deck."""
    return run_hull(deck_of(name), programs.program, Options(limit=100_000))


def deck_with(points: Iterable[Iterable[object]]) -> Deck:
    """Return a data deck with the given points."""
    return data_deck([[*map(str, point)] for point in points], "points")


def points_on(deck: Deck) -> list[Vector]:
    return [tuple(map(Fraction, point)) for point in exact_points(deck)[0].values()]


def typed(run: HullRun) -> str:
    """Return the typewriter output of all programs of a run."""
    return " / ".join(line for step in run.steps for line in step.result.typed)


@claim("thesis.3", "thesis.169", "thesis.208")
def programs_compile() -> Check:
    cards = {name: len(programs.deck(name).cards) for name in THREE}
    compiled = all(programs.program(name).code for name in THREE)
    message = "all three decks compile: " + ", ".join(f"{name} with {n} cards" for name, n in cards.items())
    return exhibited(compiled, message)


@claim("thesis.155")
def cards_read_and_punched() -> Check:
    words = [{line.text.split()[0] for line in programs.program(name).statements} for name in THREE]
    return exhibited(all({"READ", "PUNCH"} <= of_program for of_program in words), "all programs have READ and PUNCH")


def _positions(name: str) -> int:
    program = programs.program(name)
    return OBJECT_PROGRAM + FUNCTION_NAMES + code_positions(program) + program.storage.fields * FIELD


@claim("thesis.4", "thesis.153")
def program_sizes() -> Check:
    sizes = [_positions(name) for name in THREE]
    message = f"programs 1 to 3 need about {', '.join(map(str, sizes))} positions, by an estimate"
    return exhibited(SMALLER_CORE < max(sizes) <= CORE, message)


@claim("thesis.14")
def fifty_one_points() -> Check:
    points = points_on(deck_of("table.deck"))
    arrays = [{entry.name: entry.size for entry in programs.program(name).storage.arrays()} for name in THREE]
    most = entries_of_plane_table()
    coordinates = {
        of_program[axis] for of_program, axes in zip(arrays, ("XYZ", "RST", "XYZ"), strict=True) for axis in axes
    }
    tetrahedron = [(0, 0, 0), (60, 0, 0), (0, 60, 0), (0, 0, 60)]
    many = [*tetrahedron, *((k, 1, 1) for k in range(1, 48))]
    hull = read_hull(run_hull(deck_with(many), programs.program).final.result.punched)
    right = {tuple(map(int, p)) for p in hull.vertices} == {*tetrahedron} and len(many) == 51
    right = right and coordinates == {51} and arrays[2]["KK"] == PLACES
    check = exhibited(right, "the arrays hold 51 points, and the programs find the hull of a set of 51 points")
    message = f"{len(points)} points that need {most} entries of the plane table at once; program 3 has {PLACES}"
    return check.unless(len(points) <= 51 and most > PLACES, message)


@cache
def entries_of_plane_table() -> int:
    """Return the largest number of entries of the plane table in use at once for the deck ``table.deck``.

    Each step keeps the planes of the previous hull, adds three for each replaced plane and then removes the replaced
    one.
    """
    hull = convex_hull(points_on(deck_of("table.deck")), history=True)
    return max(len(before.equations) + 2 * after.outside + 1 for before, after in pairwise(hull.history))


def plane_through_c() -> Check:
    """Check that a plane through the inside point C ends a run with an error (KNOWN-FAULTS 3), though a hull exists."""
    message = typed(run_of("throughc.deck"))
    points = points_on(deck_of("throughc.deck"))
    judge = exact_hull(points)
    passed = message.endswith("ERROR IN PROGRAM") and "P3-027" in convex_hull(points).corrected
    message = f"typed: {message}; the exact hull has {len(judge.vertices)} vertices and {len(judge.facets)} planes"
    return refuted(passed, message)


@claim("thesis.83", "thesis.84")
def truncated_roots() -> Check:
    sums = {}
    for name in ("exact", "truncating"):
        # The first of these three points is not the middle one.
        arithmetic, (x, y, _) = take(((0, 0, 0), (1, 0, 0), (10**8, 0, 0)), name)
        squares = [distance_squared(x[i], y[i], x[j], y[j]) for i, j in ((0, 1), (0, 2), (1, 2))]
        sums[name] = arithmetic.distances_add_up(*squares)
    punched, judge = vertices_of("between.deck")
    case = "eight digits: the distances of (0, 0) from (1, 0) and (100000000, 0) add up to that of these two points; "
    case += f"other distances do not add up, and {len(judge - punched)} vertex of between.deck is not punched"
    wrong = not sums["exact"] and sums["truncating"] and judge - punched and punched - judge
    return between_by_distances().unless(wrong, case)


def vertices_of(name: str) -> tuple[set[int], set[int]]:
    """Return the vertices that the listing punches for a counterexample, and its exact vertices, as sets of indices."""
    points = points_on(deck_of(name))
    outcome = from_cards("listing", run_of(name), points)
    return set(outcome.vertices), set(exact_hull(points).vertices)


@claim("thesis.159")
def silent_loss() -> Check:
    punched, judge = vertices_of("silent.deck")
    message = typed(run_of("silent.deck"))
    passed = punched != judge and "NOT ACCEPTABLE" not in message
    return refuted(passed, f"{len(punched)} of {len(judge)} vertices are punched; typed: {message}")


@claim("thesis.65")
def notation() -> Check:
    text = "".join(programs.deck(name).text() for name in THREE[1:])
    symbols = "NETC NE NV MM NN KK N A B C D X Y Z C1 C2 U N1 D1 D2 D3".split()
    names = [symbol for symbol in symbols if re.search(rf"\b{symbol} *[(=]", text)]
    passed = symbols[:6] == names[:6] and 2 * len(names) > len(symbols)
    return exhibited(passed, f"{len(names)} of {len(symbols)} symbols are names in the listings: {', '.join(names)}")


@claim("thesis.263")
def inside_heading() -> Check:
    cards = [card.text.strip() for card in programs.deck("program3").cards]
    place = next(k for k, card in enumerate(cards) if card.endswith("PUNCH 5"))
    heading = next(card for card in cards if card.startswith("5 FORMAT"))
    passed = "INSIDE POINTS" in heading and cards[place + 1] == "INSID=2" and cards.index("INSID=1") < place
    passed &= cards[place - 1].endswith("GO TO (109,110), INSID") and cards[place].startswith("109")
    return exhibited(passed, f"{cards[place - 1]} / {cards[place]} / {cards[place + 1]}")


@claim("thesis.249")
def two_kinds_of_error() -> Check:
    third = coordinate_field("0.333333333", truncate=True)
    cut, exact = (_coefficients(_THREE, arithmetic) for arithmetic in ("truncating", "exact"))
    exact_coefficients = [*map(Fraction, plane_through(*_THREE))]
    differ = [a != b for a, b in zip(cut, exact_coefficients, strict=True)]
    passed = third == "+.33333333E+00" and any(differ) and exact == exact_coefficients
    message = f"1/3 is truncated on a card; coefficients of a plane that are truncated in eight digits: {sum(differ)}"
    return exhibited(passed, message)


def _draw_sevenths(random: Random) -> tuple[Point, ...]:
    numerators = ((random.randint(-60, 60) for _ in range(3)) for _ in range(random.randint(5, 8)))
    return tuple((x, y, z) for x, y, z in numerators)


SEVENTHS: Generator[tuple[Point, ...]] = Generator(
    "5 to 8 points whose coordinates are sevenths", 7, _draw_sevenths, lambda s: len({*s}) == len(s) > 3
)


@claim("thesis.180", full=200)
def hull_of_approximations(cases: int = 3) -> Check:
    found = []

    def approximates(sevenths: tuple[Point, ...]) -> bool:
        texts = [[format(Decimal(k) / 7, ".15f") for k in point] for point in sevenths]
        deck = data_deck(texts, "sevenths", truncate=True)
        points = points_on(deck)
        judge = from_judge(exact_hull(points), points)
        listing = from_cards("listing", run_hull(deck, programs.program, Options(limit=200_000)), points)
        found.append(listing.determined and disagreement(listing, judge, points).agrees)
        pairs = zip((x for p in points for x in p), (Fraction(k, 7) for p in sevenths for k in p), strict=True)
        is_near = all(10**7 * abs(x - y) <= abs(y) for x, y in pairs)
        return is_near and disagreement(from_hull("port", convex_hull(points)), judge, points).agrees

    message = "the hull is that of points whose coordinates differ from the given ones after seven digits"
    check = search(SEVENTHS, approximates, cases, message)
    case = f"calculations in eight digits, with which the programs find the hulls of {sum(found)} of {cases} sets"
    return check.unless(not all(found), case)


@claim("thesis.248", "thesis.183")
def errors_of_machine() -> Check:
    passed = bool(_misses(_THREE)) and not _misses(_THREE, "exact")
    message = "three points do not satisfy the equation of their plane in eight digits, but do so in exact arithmetic"
    return exhibited(passed and two_kinds_of_error().holds, message)


@claim("thesis.179")
def errors_on_any_computer() -> Check:
    argument = (
        "Let numbers have p digits in base b, and let B = b^p be more than 2. The square of B - 1 is B (B - 2) + 1. "
        "It has more than p digits and does not end with 0. The coordinate 1 / (b + 1) has infinitely many digits"
    )
    # A polynomial of degree 2 that is 0 at three values of B is 0 at all.
    steps = ((base - 1) ** 2 == base * (base - 2) + 1 for base in range(3))
    check = proved(argument, steps, "with a fixed number of digits, some coordinates and some products are not exact")
    case = "exact arithmetic, in which three points with rational coordinates satisfy their own plane"
    return check.unless(not _misses(_THREE, "exact"), case)


def _coefficients(points: tuple[Point, ...], name: str) -> list[Fraction]:
    arithmetic, rows = take(points, name)
    coefficients = plane(*(tuple(rows[axis][k] for axis in range(3)) for k in range(3)))
    return [Fraction(arithmetic.exact(x, degree)) for x, degree in zip(coefficients, (2, 2, 2, 3), strict=True)]


def _misses(points: tuple[Point, ...], name: str = "truncating") -> list[int]:
    """Return the indices of the points that, in an arithmetic, are not on the plane of the first three points."""
    arithmetic, rows = take(points, name)
    all_points = [tuple(rows[axis][k] for axis in range(3)) for k in range(len(points))]
    equation = plane(*all_points[:3])
    return [k for k, point in enumerate(all_points) if not arithmetic.is_zero(at(equation, point))]


@claim("thesis.185")
def fourth_point_off_plane() -> Check:
    exactly = not plane_value(plane_through(*_FOURTH[:3]), _FOURTH[3])
    message = f"{_FOURTH[3]} lies exactly in the plane of the other three points, but alone misses it in eight digits"
    return exhibited(exactly and _misses(_FOURTH) == [3], message)


def _draw_truncated(random: Random) -> tuple[Point, ...]:
    """Return six points; with larger coordinates, the equations of more planes and lines are truncated."""
    limit, is_flat = random.choice((99, 999, 9999)), random.random() < 0.5
    rows = [[random.randint(-limit, limit) for _ in "xyz"] for _ in range(6)]
    return tuple((x, y, 0 if is_flat else z) for x, y, z in rows)


TRUNCATED: Generator[tuple[Point, ...]] = Generator(
    "six points in space or with z = 0, coordinates of two to four digits", 117, _draw_truncated
)
# For programs 2 and 3: the statements that begin the test of equation NETC (T), type that the data are not acceptable
# (R), and continue (A); then the names of the defining points, of the coordinates, and of the coefficients.
_OWN_POINTS = {
    "program2.f": ({124: "T", 126: "R", 128: "A"}, ("MM", "NN"), "RS", "ABC"),
    "program3.f": ({116: "T", 119: "R", 120: "A"}, ("MM", "NN", "KK"), "XYZ", "ABCD"),
}


def _tests_of_own_points(points: tuple[Point, ...]) -> tuple[list[tuple[bool, bool]], HullRun]:
    """Run the programs on a set.  Return their tests of equations with the points that define them, and the run.

    A test is a pair: whether a value of the equation at its points is not zero, and whether the program rejects it.
    """
    misses: list[bool] = []
    rejected: list[bool] = []

    def watch(program: Program, machine: Machine) -> None:
        labels, names, axes, coefficients = _OWN_POINTS.get(program.source, ({}, (), "", ""))

        def trace(line: Line, session: Session) -> None:
            step, numbers = labels.get(line.label), session.options.numbers
            if step == "T":
                n = _held(session, "NETC")
                equation = [_held(session, f"{letter}({n})") for letter in coefficients]
                values = []
                for k in (_held(session, f"{name}({n})") for name in names):
                    point = [_held(session, f"{axis}({k})") for axis in axes]
                    products = [numbers.multiply(a, x) for a, x in zip(equation, point, strict=False)]
                    values.append(reduce(numbers.add, [*products, equation[-1]]))
                misses.append(any(map(numbers.sign, values)))
            elif step:
                rejected.append(step == "R")

        machine.tracer = trace

    run = run_hull(deck_with(points), programs.program, Options(limit=100_000), watch=watch)
    return [*zip(misses, rejected, strict=True)], run


def _held(session: Session, name: str) -> Any:
    """Return the value of a variable or array element of a running program."""
    ((value, _),) = session.held(name)
    return value


@claim("thesis.184", full=600)
def programs_rejecting_data(cases: int = 12) -> Check:
    outcomes, names, accepted = [], [], 0
    for points in TRUNCATED.cases(cases):
        tests, run = _tests_of_own_points(points)
        outcomes += [misses == is_rejected for misses, is_rejected in tests]
        accepted += sum(not is_rejected for _, is_rejected in tests)
        is_last_rejected = bool(tests) and tests[-1][1]
        outcomes.append(is_last_rejected == typed(run).endswith("DATA NOT ACCEPTABLE"))
        names += [run.final.name] if is_last_rejected else []
    rejected = [names.count(name) for name in ("program2", "program3")]
    message = f"programs 2 and 3 reject {rejected[0]} and {rejected[1]} sets, all at an equation that is not zero at "
    message += f"its points, and accept the {accepted} equations that are zero at them"
    check = searched(TRUNCATED, cases, [*outcomes, *rejected, accepted], message)
    deck = deck_with(_REJECTED)
    switched = run_hull(deck, programs.program, Options(switches=frozenset({1})))
    first, *_, last = convex_hull(_NOT_TESTED, "truncating", history=True).history
    replaced = [plane for plane in first.equations if {*plane} not in map(set, last.equations)]
    # The program may compute the equation from its points in any order.
    orders = [[tuple(_NOT_TESTED[k] for k in order) for order in permutations(plane)] for plane in replaced]
    complete = run_hull(deck_with(_NOT_TESTED), programs.program).complete
    missed = complete and any(all(map(_misses, of_plane)) for of_plane in orders)
    continues = not typed(switched).endswith("DATA NOT ACCEPTABLE")
    case = (
        "program 1, which has no such test; by a run with sense switch 1 on, which continues after the message; and by "
        "a plane that misses its points but is replaced before it is tested"
    )
    return check.unless("DATA NOT ACCEPTABLE" not in programs.deck("program1").text() and continues and missed, case)


@claim("thesis.250", "thesis.187")
def vertex_within_interval() -> Check:
    # The last point is above the plane of three others, where 16x + 16y + 16z - 64 is 3.2.
    points = [("0", "0", "0"), ("4", "0", "0"), ("0", "4", "0"), ("0", "0", "4"), ("1.4", "1.4", "1.4")]
    exact, with_epsilon = convex_hull(points), convex_hull(points, epsilon="10")
    message = "(1.4, 1.4, 1.4) is a vertex in exact arithmetic, but a boundary point with the tolerance e = 10"
    passed = 4 in exact.vertices and with_epsilon.boundary == (4,) and {*with_epsilon.vertices} == {0, 1, 2, 3}
    return exhibited(passed, message)


@claim("thesis.186")
def interval_instead_of_rejection() -> Check:
    points = [tuple(map(str, point)) for point in _REJECTED]
    without, hull = (convex_hull(points, "truncating", epsilon=e, on_refusal="return") for e in (None, "10"))
    right = hull.determined and {*hull.vertices} == {*exact_hull(_REJECTED).vertices}
    return exhibited(right and not without.determined, f"without e: {without.status}; with e = 10: {hull.status}")


@claim("thesis.188")
def value_against_distance() -> Check:
    csv_rows, _ = csv_points(counterexample("short_normal.csv"), "short_normal.csv")
    p, q, r, x = (tuple(map(Fraction, map(str, point))) for point in csv_rows)
    a, b, c, d = plane(p, q, r)  # type: ignore[arg-type]
    value = at((a, b, c, d), x)
    distance = value * value / (a * a + b * b + c * c)
    if distance != 1 or abs(value) != Fraction(1, 100):
        return exhibited(False, f"the value is {value} at the distance {distance}")

    def difference(a: int, b: int, c: int, t: int) -> int:
        # The point t (a, b, c) has its foot at the origin, which the plane contains.
        value_of_point = dot((a, b, c), (t * a, t * b, t * c))
        return value_of_point**2 - dot((a, b, c), (a, b, c)) * (t * t) * dot((a, b, c), (a, b, c))

    return identity(difference, (4, 4, 4, 2), "the value is the distance times the length of (A, B, C)")


@claim("thesis.93", "thesis.189", full=300)
def orientation_by_c(cases: int = CASES) -> Check:
    checks = []
    for sampled in sampled_sets(3, cases):
        added = sampled.hull.history[0].added
        total = _sum(sampled.points, added)
        for stage in sampled.stages():
            planes = [f.plane for f in exact_hull([sampled.points[k] for k in stage.vertices]).facets]
            checks += [dot(plane[:3], total) + plane[3] * len(added) < 0 for plane in planes]
    fault = plane_through_c()
    check = searched(SETS[3], cases, checks, f"{len(checks)} planes of all H_j are negative at the inside point C")
    return check.unless(not fault.holds, f"a plane that is made and eliminated later: {fault.message}")


def _sum(points: tuple[Point, ...], which: tuple[int, ...]) -> tuple[int, int, int]:
    x, y, z = (sum(points[k][axis] for k in which) for axis in range(3))
    return x, y, z


@claim("thesis.190", full=300)
def orientation_by_constant_term(cases: int = CASES) -> Check:
    checks = []
    for sampled in sampled_sets(3, cases):
        added = sampled.hull.history[0].added
        x, y, z = total = _sum(sampled.points, added)
        moved = [tuple(len(added) * x - t for x, t in zip(point, total, strict=True)) for point in sampled.points]
        # Compare the value at C, times the number of points of which C is the mean, with the translated constant term.
        for defining in {*combinations(range(5), 3), *(d for stage in sampled.stages() for d in stage.defining)}:
            a, b, c, d = plane_through(*(sampled.points[k] for k in defining))
            there, constant = a * x + b * y + c * z + d * len(added), plane_through(*(moved[k] for k in defining))[3]  # type: ignore[arg-type]
            checks.append((constant > 0, constant < 0) == (there > 0, there < 0))
    check = searched(SETS[3], cases, checks, f"{len(checks)} constant terms have the sign of the value at C")
    return check.unless(not plane_through_c().holds, "a plane through C, for which both are 0")


@claim("thesis.160", part="values")
@claim("thesis.163", part="digits")
@claim("thesis.161", part="columns")
def data_sheet(part: str) -> Check:
    """Check the sample cards of pages 58 and 59: their values, the digits of one number, or the columns of z."""
    if part == "columns":
        z = max(z for _, _, z in read_hull(run_of("z_in_39.deck").final.result.punched).vertices)
        deck = deck_with([(3, 12, 1)])
        ((*_, in_29),) = read_hull(run_hull(deck, programs.program).final.result.punched).vertices
        right = len(deck.cards[-1].text.rstrip()) == 42 and in_29 == 1
        return slip(z == 1, right, "29 to 42", f"program 1 reads a z of 1 in columns 39 to 52 as {float(z)}")
    if part == "digits":
        (text,) = (row.words for row in statements_of("thesis") if row.id == "thesis.163")
        field = coordinate_field("3")
        message = f"{text} has {len(text)} characters, and a field has {len(field)} columns"
        return slip(len(text) == len(field), field.replace("0E", "E") == text, field, message)
    # The first and the last sample card, with the number 3 as thesis.163 corrects it.
    fields = "+.12000000E+02+.30000000E+01+.14600000E-01", "+.00000000E+02+.26100000E-01+.60000000E+01"
    run = run_hull(deck_from_lines("data sheet", ["02", *fields]), programs.program)
    vertices = [tuple(map(float, point)) for point in read_hull(run.final.result.punched).vertices]
    return exhibited(vertices == [(12, 3, 0.0146), (0, 0.0261, 6)], f"program 1 reads the sample cards as {vertices}")
