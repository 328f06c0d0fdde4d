"""Checks of chapters 5 to 7: messages, table sizes, printed hulls, comments, the variable INSID, and translation."""

import re
from collections.abc import Iterable, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import combinations
from operator import mul

from emulator.errors import DeckError
from emulator.language.cards import deck_from_lines
from emulator.language.formats import Literal
from emulator.language.objectcode import Program
from emulator.machine.machine import Machine
from emulator.machine.result import Options
from emulator.machine.timing import measure
from emulator.numbers import numbers
from modern.claims.algebra import Step, not_negative, term, variables, zero
from modern.claims.evidence import Check, claim, exhibited, proved, searched
from modern.claims.hulls import convex_hull, exact_hull
from modern.claims.sampled_sets import BOTH, CASES, SETS, flat_and_spatial_sets
from modern.claims.thesis.chapter3_equations import procedure_against_judge
from modern.claims.thesis.chapter3_stages import stage_property
from modern.claims.thesis.chapter3_steps import all_hold, fourth_point_by_largest
from modern.claims.thesis.chapter3_wording import line_duplicates_as_printed
from modern.claims.thesis.chapter7 import (
    PLACES,
    construction,
    deck_of,
    deck_with,
    entries_of_plane_table,
    points_on,
    run_of,
    typed,
    vertices_of,
)
from modern.comparison.difference import disagreement
from modern.comparison.outcome import from_card_hull, from_cards, from_judge
from modern.edition import programs
from modern.edition.chapter6 import EXAMPLES, input_deck, prints
from modern.thesis.cards import CardHull, read_hull
from modern.thesis.job import COPLANAR, HullRun, run_hull

MOST_POINTS = 51

# The number of points of each example of chapter 6, and their dimension.
_EXAMPLES = {1: (3, 2), 2: (9, 1), 3: (1, 0), 4: (8, 2), 5: (15, 3), 6: (10, 3)}
# Five points that are not coplanar.
_SPACE = ((1, 2, 3), (2, 1, 5), (4, 4, 1), (3, 9, 2), (7, 1, 1))
# Four points that are not coplanar, but are in eight digits.
_NEARLY_FLAT = ((99999999, 0, 0), (0, 99999999, 0), (0, 0, 99999999), (33333333, 33333333, 33333334))
# Seven points for which program 2 removes three points just before a vertex.
_THREE_BEFORE_A_VERTEX = ((0, -1, 0), (1, 1, 0), (-1, 1, 0), (1, -1, 0), (-1, -1, 0), (-1, 0, 0), (1, 0, 0))


@claim("thesis.280", full=300)
def error_in_program(cases: int = CASES) -> Check:
    names = ("throughc.deck", "zeroplane.deck")
    in_a_plane = ((1, 0, 9), (2432, 0, 9), (0, 3, 9), (0, 7061, 9))
    runs = [*map(run_of, names), _first_run("E+36", 4), run_hull(deck_with(in_a_plane), programs.program)]
    ended = [typed(run).endswith("ERROR IN PROGRAM") for run in runs]
    hulls = [convex_hull(points_on(run.steps[0].deck)) for run in runs]
    message = "in exact arithmetic, the corrected procedure never ends with the message; program 3 types it for "
    message += f"{names[0]}, whose hull needs the correction {', '.join(hulls[0].corrected)}"
    outcomes = [procedure_against_judge((2, 3), cases).holds, ended[0] and hulls[0].corrected]
    right = all(ended) and all(hull.determined for hull in hulls) and not any(hull.corrected for hull in hulls[1:])
    case = f"{names[1]}, four points of a plane, and four points of about 1E36, none of which needs a correction"
    return searched(BOTH, 2 * cases, outcomes, message).unless(right, case)


@claim("thesis.282", full=300)
def message_after_wrong_hull(cases: int = 1) -> Check:
    options = Options(numbers=numbers("exact"), limit=30_000)
    right, layers = [], {"program2": ("corrected",)}
    # Program 1 punches the line for two or three points.
    for given in (s.points[:size] for s in flat_and_spatial_sets(cases) for size in (2, 3, None)):
        run = run_hull(deck_with(given), lambda name: programs.program(name, layers.get(name, ())), options)
        hull, points = read_hull(run.final.result.punched), [tuple(map(Fraction, point)) for point in given]
        if _is_announced(run):
            difference = disagreement(from_cards("run", run, points), from_judge(exact_hull(given), points), points)
            named, on = ({k: {*vertices} for vertices, k in part} for part in (_listed(hull), _on_equations(hull)))
            # A plane that program 1 punches for a line can contain the third vertex, too.
            is_line = run.final.number == 1 and named.keys() == on.keys() and all(named[k] <= on[k] for k in on)
            right.append(difference.agrees and (named == on or is_line))
    message = f"in exact arithmetic, {sum(right)} of {len(right)} results with this line agree with the exact hull"
    punched, vertices = vertices_of("silent.deck")
    renumbered = run_hull(deck_with(_THREE_BEFORE_A_VERTEX), programs.program, options)
    hull, seven = read_hull(renumbered.final.result.punched), points_on(renumbered.steps[0].deck)
    is_right = disagreement(from_cards("run", renumbered, seven), from_judge(exact_hull(seven), seven), seven).agrees
    announced = all(map(_is_announced, (run_of("silent.deck"), renumbered)))
    case = f"eight digits: after {len(punched)} of {len(vertices)} vertices of silent.deck, program 3 punches this line"
    case += f"; and by program 2 as listed, with the wrong vertices {hull.satisfied[0][0]} for one of the right lines"
    wrong = announced and is_right and punched != vertices and _on_equations(hull)[0] != _listed(hull)[0]
    if cases > CASES:
        # The run of these 28 points is too long for the quick search.
        full = run_hull(deck_of("table.deck"), programs.program, replace(options, limit=200_000, bounds="core"))
        equations, points = read_hull(full.final.result.punched).equations, points_on(deck_of("table.deck"))
        wrong = wrong and _is_announced(full) and max(sum(map(mul, e, (*p, 1))) for e in equations for p in points) > 0
        case += "; and by a full table: a point of table.deck is outside a plane that program 3 punches"
    generator = replace(BOTH, name=f"{BOTH.name}, and the first two and three points of each")
    return searched(generator, 2 * cases, right, message).unless(wrong, case)


def _is_announced(run: HullRun) -> bool:
    return any("CONVEX HULL HAS BEEN DETERMINED" in card for card in run.final.result.punched)


def _on_equations(hull: CardHull) -> list[tuple[tuple[int, ...], int]]:
    """Return, for each equation, the numbers of the vertices that satisfy it, and the number of the equation."""
    vertices = [*enumerate(hull.vertices, 1)]
    on = [tuple(k for k, vertex in vertices if not sum(map(mul, e, (*vertex, 1)))) for e in hull.equations]
    return [*zip(on, range(1, len(on) + 1), strict=True)]


def _listed(hull: CardHull) -> list[tuple[tuple[int, ...], int]]:
    # A second card lists further vertices of an equation.
    listed: dict[int, list[int]] = {}
    for vertices, number in hull.satisfied:
        listed.setdefault(number, []).extend(vertices)
    # For a single line, the vertices of its equations are not listed: both must be on them.
    single: list[tuple[tuple[int, ...], int]] = [((1, 2), number) for number in range(1, len(hull.equations) + 1)]
    return [(tuple(sorted(vertices)), number) for number, vertices in listed.items()] or single


@cache
def _first_run(exponent: str, size: int = len(_SPACE)) -> HullRun:
    cards = ["".join(f"+.{x}0000000{exponent}" for x in point) for point in _SPACE[:size]]
    return run_hull(deck_from_lines("small", [f"{len(cards):2}", *cards]), programs.program)


@claim("thesis.281", full=100)
def points_are_coplanar(cases: int = CASES) -> Check:
    checks = []
    for sampled in flat_and_spatial_sets(cases):
        typed_by_program1 = construction(sampled.points, programs.program).run.steps[0].result.typed
        checks.append((COPLANAR in typed_by_program1) == sampled.flat)
    message = f"in {sum(checks)} of {len(checks)} runs, program 1 types the message exactly if the set is flat"
    runs = [*map(_first_run, ("E+01", "E-17")), run_hull(deck_with(_NEARLY_FLAT), programs.program)]
    wrong = [COPLANAR in run.steps[0].result.typed for run in runs] == [False, True, True]
    wrong = wrong and exact_hull(_SPACE).dimension == exact_hull(_NEARLY_FLAT).dimension == 3
    case = "five points in space scaled to about 1E-18 and by four points with coordinates of eight digits, which are "
    return searched(BOTH, 2 * cases, checks, message).unless(wrong, f"{case}reported as coplanar")


@claim("thesis.284")
def plane_table_size() -> Check:
    size = next(entry.size for entry in programs.program("program3").storage.arrays() if entry.name == "KK")
    hull = exact_hull([(k, k**2, k**3) for k in range(MOST_POINTS)])
    points, planes, most = len(hull.vertices), len(hull.facets), entries_of_plane_table()
    v, e, f = variables("V E F")
    signs = {"Euler": zero(v - e + f - 2), "edges": not_negative(2 * e - 3 * f)}
    step = Step("F is at most 2 V - 4", signs, not_negative(2 * v - 4 - f), (term("Euler", 2), term("edges")))
    fits = points == MOST_POINTS and planes == 2 * points - 4 == size == PLACES
    argument = "Euler's formula is V - E + F = 2. A plane has three edges or more, and each edge is in two planes."
    message = f"V vertices have at most 2 V - 4 planes, {planes} for {points} points of a curve; they fit the table"
    check = proved(argument, [step.is_valid(), fits], message)
    return check.unless(most > size, f"the intermediate hulls of table.deck, which need {most} entries")


def line_table_size() -> Check:
    size = next(entry.size for entry in programs.program("program2").storage.arrays() if entry.name == "MM")
    # The last point is added first, between two points with the same x, and is not a vertex in the end.
    points = [*((k * (k + 1), k, 0) for k in range(-25, 25)), (600, 0, 0)]
    stages, vertices = convex_hull(points, history=True).history, len(exact_hull(points).vertices)
    # The steps that add the 50th and the 51st point add two lines before they remove one.
    fifty, fifty_one = (len(stage.equations) + 2 for stage in stages[-3:-1])
    check = exhibited(fifty == size, f"50 added points need {fifty} lines at once")
    case = f"a hull of {vertices} vertices to which 51 points were added, which need {fifty_one} lines at once"
    return check.unless(fifty_one > size and vertices < MOST_POINTS == len(points), case)


@claim("thesis.283", full=300)
def lines_of_added_points(cases: int = CASES) -> Check:
    table, counts = line_table_size(), stage_property("counts", cases)
    check = replace(counts, holds=table.holds and counts.holds, message=f"{table.message}; {counts.message}")
    return check.unless(table.evidence.violation, table.evidence.violation)


@claim("thesis.172", examples=(1,))
@claim("thesis.173", examples=(2,))
@claim("thesis.174", examples=(3,))
@claim("thesis.175", examples=(4,))
@claim("thesis.176", examples=(5,))
@claim("thesis.177", examples=(6,))
@claim("thesis.285")
def printed_hulls(examples: Iterable[int] = EXAMPLES) -> Check:
    checks, sets = [], []
    for example in examples:
        points = points_on(input_deck(example))
        judge = exact_hull(points)
        sets.append((len(points), judge.dimension))
        last = [result for result in prints(example) if result.device == "punch"][-1]
        hull = read_hull(last.lines)
        outcome = from_card_hull("print", f"program{last.program}", hull, points)
        difference = disagreement(outcome, from_judge(judge, points), points)
        on_equation = _on_equations(hull)
        complete = difference.error == 0
        # Program 1 prints two planes for each line.
        if last.program == 1:
            planes: dict[tuple[int, ...], list[tuple[Fraction, ...]]] = {}
            for vertices, number in on_equation:
                planes.setdefault(vertices, []).append(hull.equations[number - 1])
            lines = {*combinations(range(1, len(hull.vertices) + 1), 2)}
            complete = planes.keys() == lines and all(len(pair) == 2 and _differ(*pair) for pair in planes.values())
        # Program 2 also prints the plane of the points.
        on_plane = [any(e[:3]) and not any(sum(map(mul, e, (*p, 1))) for p in points) for e in hull.plane]
        complete = complete and on_plane == [True] * (last.program == 2)
        checks.append(difference.agrees and not outcome.strange and complete and on_equation == _listed(hull))
    message = f"{sum(checks)} of {len(checks)} printed hulls equal the exact hull in all points and equations that are "
    message += f"printed; number of points and dimension: {', '.join(f'{n} and {dimension}' for n, dimension in sets)}"
    return exhibited(all(checks) and sets == [_EXAMPLES[example] for example in examples], message)


def _differ(first: Sequence[Fraction], second: Sequence[Fraction]) -> bool:
    """Return True if two equations, given by their coefficients, do not describe the same plane."""
    return any(a * d != b * c for (a, b), (c, d) in combinations(zip(first, second, strict=True), 2))


@claim("thesis.17")
def possible_output() -> Check:
    printed = []
    for number in (1, 2, 3):
        program = programs.program(f"program{number}")
        results = [result for k in EXAMPLES for result in prints(k) if result.program == number]
        cards = [line for result in results if result.device == "punch" for line in result.lines]
        statements = " ".join(line.text for line in program.statements)
        punched = {int(label) for label in re.findall(r"PUNCH *(\d+)", statements)}
        specs = [spec for label, form in program.formats if label in punched for spec in form.specs]
        headings = {spec.text.strip() for spec in specs if isinstance(spec, Literal)} - {""}
        printed += [any(heading in card for card in cards) for heading in headings]
    return exhibited(all(printed), "the cards of chapter 6 show all texts of the FORMATs with which the programs punch")


@claim("thesis.279", "thesis.160", "thesis.162")
def first_card() -> Check:
    decks = [[card.text.rstrip() for card in input_deck(example).cards] for example in EXAMPLES]
    listing = programs.deck("program1").text()
    read = ("READ 1,N", "1 FORMAT (I2)", "READ 21,X(I),Y(I),Z(I)", "21 FORMAT (4E14.8")
    right = [len(first) == 2 and [*map(len, others)] == [3 * 14] * int(first) for first, *others in decks]
    message = f"the {len(decks)} printed decks have N, then N cards with 3 x 14 characters, as in the FORMATs"
    return exhibited(all(right) and all(words in listing for words in read), message)


# Six points for which program 3 eliminates the last two planes of its table.
_LAST_PAIR = ((0, 0, 0), (1, 2, 0), (1, 0, 2), (1, 1, 1), (0, 2, 1), (0, 2, 0))
# A deck in a plane and one in space for which the programs punch wrong vertices without a message.
_WRONG_IN_EIGHT_DIGITS = {2: "between.deck", 3: "silent.deck"}
# The rules of chapter 3 that lose a line or the hull, by dimension.
_AS_WORDED = {
    2: (line_duplicates_as_printed, "page 28, which loses a line"),
    3: (fourth_point_by_largest, "page 29, which finds no tetrahedron"),
}


@claim("thesis.1", dimensions=(2, 3), full=300)
@claim("thesis.86", dimensions=(2,), full=300)
@claim("thesis.106", dimensions=(3,), full=300)
def procedure_in_exact_arithmetic(dimensions: tuple[int, ...], cases: int = CASES) -> Check:
    decks = [_WRONG_IN_EIGHT_DIGITS[dimension] for dimension in dimensions]
    wrong = [run_of(deck).complete and len({*map(frozenset, vertices_of(deck))}) == 2 for deck in decks]
    wrong.append(bool(line_table_size().evidence.violation) and entries_of_plane_table() > PLACES)
    case = f"eight digits: the programs punch wrong vertices for {' and '.join(decks)}; by too small tables (thesis.14)"
    for rule, words in (_AS_WORDED[dimension] for dimension in dimensions):
        wrong.append(not rule().holds)
        case += f"; by the rule of {words}"
    if 3 in dimensions:
        last_pair = construction(_LAST_PAIR, programs.program).run
        faults = {"P3-025": last_pair, "P3-026": run_of("cube.deck"), "P3-027": run_of("throughc.deck")}
        for row, run in faults.items():
            corrected = convex_hull(points_on(run.steps[0].deck)).corrected
            wrong.append(typed(run).endswith("ERROR IN PROGRAM") and corrected == (row,))
        case += f"; and by program 3 as listed, which types ERROR IN PROGRAM for sets that need {', '.join(faults)}"
    return procedure_against_judge(dimensions, cases).unless(all(wrong), case)


@claim("thesis.263", full=100)
def inside_heading(cases: int = CASES) -> Check:
    tests = [t for points in SETS[3].cases(cases) for t in construction(points, programs.program).inside]
    after = [is_2 for is_punched, is_2 in tests if is_punched]
    message = f"program 3 tests INSID for each inside point: it is 2 at {sum(after)} of {len(after)} tests after the "
    message += f"heading, and at {sum(map(any, tests)) - len(after)} of {len(tests) - len(after)} tests before it"
    return searched(SETS[3], cases, [after, *(a == b for a, b in tests)], message)


# Words of the comment cards that name the steps; each stands on one comment card.
_BOUNDARY = "BOUNDARY POINTS THAT"
_STEPS = {
    "program2": ("INSIDE POINTS", "SUPPORTING LINES", f"{_BOUNDARY} ARE NOT", f"{_BOUNDARY} WERE", "MORE THAN ONE"),
    "program3": ("INSIDE POINTS", "SUPPORTING PLANES", "INSIDE PLANES", f"{_BOUNDARY} ARE NOT", "MORE THAN ONE"),
}


@claim("thesis.261", name="program2")
@claim("thesis.262", name="program3")
def comments_of_steps(name: str) -> Check:
    comments = [card.text for card in programs.deck(name).cards if card.text.startswith("C")]
    named = [sum(words in comment for comment in comments) == 1 for words in _STEPS[name]]
    return exhibited(all(named), f"comments name {len(named)} steps of {name}")


def _translated(name: str) -> Program:
    """Compile a program with its layer ``translation``, which moves the origin; program 1 has no such layer."""
    return programs.program(name, () if name == "program1" else ("translation",))


@claim("thesis.194")
def storage_of_translation() -> Check:
    deck = deck_with([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])
    Machine(programs.program("program3"), deck, Options())
    try:
        Machine(_translated("program3"), deck, Options())
    except DeckError as error:
        return exhibited("OVERLAP" in str(error), f"only with the layer translation, loading fails: {error}")
    return exhibited(False, "the programs with the translation fit 40,000 positions")


@claim("thesis.195")
def sign_without_products() -> Check:
    # The value at C, and the test of the constant term, which is C in the plane and D in space.
    lines = {
        "program2": ("D(J)=A(J)*C1+B(J)*C2+C(J)", "IF(C(J))"),
        "program3": ("E(I)=A(I)*C1+B(I)*C2+C(I)*C3+D(I)", "IF(D(I))"),
    }
    decks = [{name: programs.deck(name, layers) for name in lines} for layers in ((), ("translation",))]
    texts = [{name: deck.text().replace(" ", "") for name, deck in version.items()} for version in decks]
    versions = [[words in text[name] for name, pair in lines.items() for words in pair] for text in texts]
    message = "with the layer translation, a program tests the constant term and not the value at C"
    return exhibited(versions == [[True, False] * 2, [False, True] * 2], message)


@claim("thesis.196")
def total_of_translation() -> Check:
    times, right = [], []
    # The points of a curve are vertices. The others are inside H_1, so that they change no equation.
    for ks, inside in ((range(-3, 4), 0), (range(-3, 4), 30), (range(-4, 5), 28)):
        deck = deck_with([*((k, k**2, k**3) for k in ks), *((1, 7, 9 + k / 10) for k in range(1, inside + 1))])
        last = [run_hull(deck, load, Options(core=60_000)).final for load in (programs.program, _translated)]
        times.append([measure(step.program, step.result).processor_time.seconds for step in last])
        right += [len(read_hull(step.result.punched).vertices) == len(ks) for step in last]
    message = "program 3 takes {0[0]:.1f} s for 7 vertices, {0[1]:.1f} s with the translation; with 30 more points "
    message += "inside, {1[0]:.1f} and {1[1]:.1f} s; for 9 vertices and 28 points inside, {2[0]:.1f} and {2[1]:.1f} s"
    return exhibited(all(right) and [a > b for a, b in times] == [True, False, True], message.format(*times))


@claim("thesis.192", full=300)
def points_moved_back(cases: int = 1) -> Check:
    options, right = Options(numbers=numbers("exact"), core=60_000, limit=60_000), list[bool]()
    for sampled in flat_and_spatial_sets(cases):
        run = run_hull(deck_with(sampled.points), _translated, options)
        # A fault of program 3 stops some runs.
        if run.complete:
            hull, points = read_hull(run.final.result.punched), [tuple(map(Fraction, p)) for p in sampled.points]
            difference = disagreement(from_cards("run", run, points), from_judge(sampled.judge, points), points)
            right.append(difference.agrees and sorted(_on_equations(hull)) == sorted(_listed(hull)))
    return all_hold(BOTH, 2 * cases, right, "hulls are punched in the original coordinates, in exact arithmetic")
