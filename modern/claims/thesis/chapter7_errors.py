"""Checks of chapter 7 on errors: truncated coordinates and equations, rejected data, and the tolerance e."""

from decimal import Decimal
from fractions import Fraction
from functools import reduce
from itertools import permutations
from random import Random

from emulator.language.objectcode import Line
from emulator.machine.result import Options
from emulator.machine.session import Session
from modern.claims.evidence import Check, Generator, claim, exhibited, identity, proved, search, searched
from modern.claims.hulls import convex_hull, exact_hull
from modern.claims.sampled_sets import Point, counterexample, plane_through, plane_value
from modern.claims.thesis.chapter7 import deck_with, held, points_on, traced_run, typed
from modern.comparison.difference import disagreement
from modern.comparison.outcome import from_cards, from_hull, from_judge
from modern.edition import programs
from modern.formats.csv import points as csv_points
from modern.formats.deck import coordinate_field, data_deck, with_epsilon
from modern.geometry.vectors import dot
from modern.port.arithmetic import at, plane
from modern.port.points import take
from modern.thesis.job import HullRun, run_hull

_FOURTH: tuple[Point, ...] = ((-185, 158, -52), (51, -195, -195), (23, -33, 59), (-1517, 1790, 44))
_THREE: tuple[Point, ...] = ((-220, -492, 405), (-70, -270, -113), (-452, 485, -366))
# Three points whose plane has the value 0 in eight digits at the fourth point, which is not in this plane.
_AT_ZERO = ((91648, 45552, -98759), (-49645, 45405, 60432), (92322, 38043, 76341), (20944, 48166, -82035))
_REJECTED: tuple[Point, ...] = (*_THREE, (101, 77, -340), (250, 333, 90))
# Five points for which program 3 replaces a plane that misses its points in eight digits before it tests the plane.
_NOT_TESTED: tuple[Point, ...] = ((2, 6, 3), (731, 0, 52), (3, 916, 4), (4, 400, 522), (16, 1, 1))


@claim("thesis.178", "thesis.249")
def two_kinds_of_error() -> Check:
    third = coordinate_field("0.333333333", truncate=True)
    cut, exact = (_coefficients(_THREE, arithmetic) for arithmetic in ("truncating", "exact"))
    exact_coefficients = [*map(Fraction, plane_through(*_THREE))]
    differ = [a != b for a, b in zip(cut, exact_coefficients, strict=True)]
    # The coefficients that need nine digits are truncated. None ends with 0.
    passed = any(differ) and differ == [abs(x) >= 10**8 for x in exact] and exact == exact_coefficients
    message = f"1/3 is truncated on a card, and so is {sum(differ)} coefficient of a plane, which needs nine digits"
    return exhibited(passed and third == "+.33333333E+00", message)


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
        # All numerators of the sevenths are at most 60.
        for first, second in permutations((sevenths, tuple(tuple(7 * x for x in point) for point in points))):
            planes = map(exact_hull(first).plane_of, exact_hull(first).facets)
            is_near &= all(10**7 * at(e, p) <= 60 * sum(map(abs, e[:3])) for e in planes for p in second)
        return is_near and disagreement(from_hull("port", convex_hull(points)), judge, points).agrees

    message = "the hull is that of points whose coordinates differ from the given ones after seven digits; neither it "
    message += "nor the hull of the given points extends beyond a plane of the other by more than such differences"
    check = search(SEVENTHS, approximates, cases, message)
    case = f"calculations in eight digits, with which the programs find the hulls of {sum(found)} of {cases} sets"
    return check.unless(not all(found), case)


@claim("thesis.248", "thesis.183")
def errors_of_machine() -> Check:
    passed = bool(_misses(_THREE)) and not any(_misses(_THREE, name) for name in ("truncating:9", "exact"))
    message = "three points do not satisfy the equation of their plane in eight digits, but do so in nine and exactly"
    return exhibited(passed and two_kinds_of_error().holds, message)


@claim("thesis.179")
def errors_on_any_computer() -> Check:
    argument = "Let numbers have p digits in base b, and let B = b^p be more than 2. The square of B - 1 is "
    argument += "B (B - 2) + 1. It has more than p digits and does not end with 0. The coordinate 1 / (b + 1) has "
    argument += "infinitely many digits"
    # A polynomial of degree 2 that is 0 at three values of B is 0 at all.
    steps = ((base - 1) ** 2 == base * (base - 2) + 1 for base in range(3))
    check = proved(argument, steps, "with a fixed number of digits, some coordinates and some products are not exact")
    case = "exact arithmetic, in which three points with rational coordinates satisfy their own plane"
    return check.unless(not _misses(_THREE, "exact"), case)


def _coefficients(points: tuple[Point, ...], name: str) -> list[Fraction]:
    arithmetic, rows = take(points, name)
    coefficients = plane(*list(zip(*rows, strict=True))[:3])
    return [Fraction(arithmetic.exact(x, degree)) for x, degree in zip(coefficients, (2, 2, 2, 3), strict=True)]


def _misses(points: tuple[Point, ...], name: str = "truncating") -> list[int]:
    """Return the indices of the points that, in an arithmetic, are not on the plane of the first three points."""
    arithmetic, rows = take(points, name)
    all_points = [*zip(*rows, strict=True)]
    equation = plane(*all_points[:3])
    return [k for k, point in enumerate(all_points) if not arithmetic.is_zero(at(equation, point))]


@claim("thesis.185")
def fourth_point_off_plane() -> Check:
    exactly = not plane_value(plane_through(*_FOURTH[:3]), _FOURTH[3])
    message = f"in eight digits, {_FOURTH[3]} alone of four coplanar points does not satisfy the equation of the plane"
    return exhibited(exactly and _misses(_FOURTH) == [3], message)


def _draw_truncated(random: Random) -> tuple[Point, ...]:
    """Return six points. The larger their coordinates, the more equations of planes and lines are truncated."""
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

    def trace(source: str, line: Line, session: Session) -> None:
        labels, names, axes, coefficients = _OWN_POINTS.get(source, ({}, (), "", ""))
        step, numbers = labels.get(line.label), session.options.numbers
        if step == "T":
            n = held(session, "NETC")
            equation = [held(session, f"{letter}({n})") for letter in coefficients]
            values = []
            for k in (held(session, f"{name}({n})") for name in names):
                point = [held(session, f"{axis}({k})") for axis in axes]
                products = [numbers.multiply(a, x) for a, x in zip(equation, point, strict=False)]
                values.append(reduce(numbers.add, [*products, equation[-1]]))
            misses.append(any(map(numbers.sign, values)))
        elif step:
            rejected.append(step == "R")

    run = traced_run(points, trace)
    return [*zip(misses, rejected, strict=True)], run


@claim("thesis.184", full=600)
def programs_rejecting_data(cases: int = 6) -> Check:
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
    message += f"its defining points, and accept the {accepted} equations that are zero at theirs"
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
    case = "program 1, which has no such test; by a run with sense switch 1 on, which continues after the message; and "
    case += "by a plane that misses its points but is replaced before it is tested"
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
    deck, points = deck_with(_REJECTED), [tuple(map(Fraction, point)) for point in _REJECTED]
    refusal = typed(run_hull(deck, programs.program))
    run = run_hull(with_epsilon(deck, "10"), lambda name: programs.program(name, ("epsilon",)))
    hull, judge = from_cards("epsilon", run, points), from_judge(exact_hull(points), points)
    agrees = hull.determined and disagreement(hull, judge, points).agrees
    message = f"without e, the programs type {refusal}; with e = 10, they find the exact hull, but for truncated digits"
    return exhibited(agrees and refusal.endswith("DATA NOT ACCEPTABLE"), message)


@claim("thesis.188")
def value_against_distance() -> Check:
    csv_rows, _ = csv_points(counterexample("short_normal.csv"), "short_normal.csv")
    *three, x = (tuple(map(Fraction, map(str, point))) for point in csv_rows)
    a, b, c, d = plane(*three)  # type: ignore[arg-type]
    value = at((a, b, c, d), x)
    distance = value * value / (a * a + b * b + c * c)

    def difference(a: int, b: int, c: int, t: int) -> int:
        # The point t (a, b, c) has its foot at the origin, which the plane contains.
        value_of_point = dot((a, b, c), (t * a, t * b, t * c))
        return value_of_point**2 - dot((a, b, c), (a, b, c)) * (t * t) * dot((a, b, c), (a, b, c))

    argument = "If the origin is in the plane, it is the foot of t (A, B, C), at the distance t times the length."
    check = identity(difference, (4, 4, 4, 2), "the value is the distance times the length of (A, B, C)", argument)
    exact = plane_through(*_AT_ZERO[:3])
    is_away = (2000 * plane_value(exact, _AT_ZERO[3])) ** 2 > dot(exact[:3], exact[:3])
    case = f"eight digits, in which the value at {_AT_ZERO[3]} is 0 at a distance of more than 1/2000 from a plane"
    return check.unless(is_away and not _misses(_AT_ZERO) and (distance, abs(value)) == (1, Fraction(1, 100)), case)
