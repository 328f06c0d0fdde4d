"""Checks of chapters 5 and 7: the machine, the data sheet, the listings, and the moved origin."""

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache, partial
from itertools import pairwise
from typing import Any

from emulator.language.cards import Deck, deck_from_lines, deck_from_text
from emulator.language.objectcode import Line, Program
from emulator.language.storage import FIELD, FUNCTION_NAMES, OBJECT_PROGRAM
from emulator.machine.machine import Machine
from emulator.machine.result import Options
from emulator.machine.session import Session
from emulator.objectdeck.extent import code_positions
from modern.claims.evidence import Check, claim, exhibited, refuted, searched, slip
from modern.claims.hulls import convex_hull, exact_hull
from modern.claims.register import statements_of
from modern.claims.sampled_sets import BOTH, CASES, Point, counterexample, flat_and_spatial_sets
from modern.claims.thesis.chapter3_steps import between_by_distances
from modern.comparison.outcome import Vector, from_cards
from modern.edition import programs
from modern.formats.deck import coordinate_field, data_deck, exact_points
from modern.port.arithmetic import distance_squared
from modern.port.points import take
from modern.thesis.cards import read_hull
from modern.thesis.job import HullRun, Load, run_hull

# A function that is called before each statement of a run.
Trace = Callable[[str, Line, Session], None]
CORE, SMALLER_CORE = 40_000, 20_000
THREE = ("program1", "program2", "program3")
PLACES = 98
TETRAHEDRON = ((0, 0, 0), (60, 0, 0), (0, 60, 0), (0, 0, 60))


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


def traced_run(points: Iterable[Iterable[object]], trace: Trace, load: Load = programs.program) -> HullRun:
    """Run the programs on a set; before each statement, call ``trace`` with the source, the line and the session."""

    def watch(program: Program, machine: Machine) -> None:
        machine.tracer = partial(trace, program.source)

    return run_hull(deck_with(points), load, Options(limit=100_000), watch=watch)


def held(session: Session, name: str) -> Any:
    """Return the value of a variable or array element of a running program."""
    ((value, _),) = session.held(name)
    return value


@dataclass(frozen=True, slots=True)
class Construction:
    """A run of the programs, with the steps of ``_STEPS`` in order, each with the number NETC, and the tests of INSID.

    ``signs`` has the sign of the value at C of each equation when its sign has been chosen (``_SIGN_CHOSEN``).
    INSID is the variable that program 3 sets to 2 when it has punched the heading INSIDE POINTS. A test of INSID is a
    pair: whether this heading has been punched before the test, and whether INSID is 2.
    """

    run: HullRun
    steps: list[tuple[str, int]]
    inside: list[tuple[bool, bool]]
    signs: list[int]


# The statements of the listings that eliminate inside points (E), test an equation (C) and add a point (G).
_STEPS = {"program2.f": {106: "E", 124: "C", 133: "G"}, "program3.f": {103: "E", 116: "C", 125: "G"}}
# The statement after the choice of an equation's sign, and the names of the equation's number and coefficients.
_SIGN_CHOSEN = {"program1.f": "206 I XA XB XC XD", "program2.f": "105 J A B C", "program3.f": "135 I A B C D"}


@cache
def construction(points: tuple[Point, ...], load: Load) -> Construction:
    """Run the programs on a set once for all checks of its steps."""
    steps: list[tuple[str, int]] = []
    inside: list[tuple[bool, bool]] = []
    signs: list[int] = []

    def trace(source: str, line: Line, session: Session) -> None:
        numbers = session.options.numbers
        if line.label in _STEPS.get(source, {}):
            steps.append((_STEPS[source][line.label], int(held(session, "NETC"))))
        # Statement 108 tests INSID before an inside point is punched.
        if source == "program3.f" and line.label == 108:
            is_punched = any(event.text == "INSIDE POINTS" for event in session.devices.events)
            inside.append((is_punched, held(session, "INSID") == 2))
        label, number, *letters = _SIGN_CHOSEN[source].split()
        if line.label == int(label):
            *slopes, value = [held(session, f"{letter}({held(session, number)})") for letter in letters]
            for k, slope in enumerate(slopes, 1):
                value = numbers.add(value, numbers.multiply(slope, held(session, f"C{k}")))
            signs.append(numbers.sign(value))

    return Construction(traced_run(points, trace, load), steps, inside, signs)


def points_on(deck: Deck) -> list[Vector]:
    return [tuple(map(Fraction, point)) for point in exact_points(deck)[0].values()]


def typed(run: HullRun) -> str:
    """Return the typewriter output of all programs of a run."""
    return " / ".join(line for step in run.steps for line in step.result.typed)


@claim("thesis.3", "thesis.169")
def programs_compile() -> Check:
    cards = {name: len(programs.deck(name).cards) for name in THREE}
    compiled = all(programs.program(name).code for name in THREE)
    message = "all three decks compile: " + ", ".join(f"{name} with {n} cards" for name, n in cards.items())
    return exhibited(compiled, message)


@claim("thesis.155")
def cards_read_and_punched() -> Check:
    words = [{line.text.split()[0] for line in programs.program(name).statements} for name in THREE]
    return exhibited(all({"READ", "PUNCH"} <= of_program for of_program in words), "all programs READ and PUNCH cards")


@claim("thesis.4", "thesis.33", "thesis.153")
def program_sizes() -> Check:
    deck_size = OBJECT_PROGRAM + FUNCTION_NAMES
    sizes = [deck_size + code_positions(p) + p.storage.fields * FIELD for p in map(programs.program, THREE)]
    message = f"programs 1 to 3 need about {', '.join(map(str, sizes))} positions, by an estimate"
    return exhibited(all(SMALLER_CORE < size <= CORE for size in sizes), message)


@claim("thesis.14", "thesis.33")
def fifty_one_points() -> Check:
    points = points_on(deck_of("table.deck"))
    arrays = [{entry.name: entry.size for entry in programs.program(name).storage.arrays()} for name in THREE]
    most = entries_of_plane_table()
    coordinates = {sizes[axis] for sizes, axes in zip(arrays, ("XYZ", "RST", "XYZ"), strict=True) for axis in axes}
    many = [*TETRAHEDRON, *((k, 1, 1) for k in range(1, 48))]
    hull = read_hull(run_hull(deck_with(many), programs.program).final.result.punched)
    vertices, inside = ({tuple(map(int, p)) for p in part} for part in (hull.vertices, hull.inside))
    right = vertices == {*TETRAHEDRON} and inside == {*many} - vertices and len(hull.equations) == len(vertices)
    right = right and coordinates == {len(many)} and arrays[2]["KK"] == PLACES < most
    message = f"the arrays hold {len(many)} points, and the programs find the hull of a set of as many points; another "
    message += f"set, of {len(points)} points, needs {most} entries at once in the plane table, which has {PLACES}"
    return exhibited(right and len(points) < len(many), message)


@cache
def entries_of_plane_table() -> int:
    """Return the largest number of entries of the plane table in use at once for the deck ``table.deck``."""
    # Each step adds three planes for each plane that it replaces, and only then removes the replaced planes.
    hull = convex_hull(points_on(deck_of("table.deck")), history=True)
    return max(len(before.equations) + 2 * after.outside + 1 for before, after in pairwise(hull.history))


def plane_through_c() -> Check:
    """Check that a plane through the inside point C ends a run with an error (KNOWN-FAULTS 3), though a hull exists."""
    message, points = typed(run_of("throughc.deck")), points_on(deck_of("throughc.deck"))
    judge = exact_hull(points)
    passed = message.endswith("ERROR IN PROGRAM") and "P3-027" in convex_hull(points).corrected
    message = f"a run types {message}; the exact hull has {len(judge.vertices)} vertices and {len(judge.facets)} planes"
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
    check = between_by_distances()
    message = f"{check.message}; in eight digits, the distances of (0, 0) from (1, 0) and (100000000, 0) add up to "
    message += f"that of these two points, and {len(judge - punched)} vertex of between.deck is not punched"
    wrong = not sums["exact"] and sums["truncating"] and judge - punched and punched - judge
    return replace(check, holds=check.holds and bool(wrong), message=message)


def vertices_of(name: str) -> tuple[set[int], set[int]]:
    """Return the vertices that the listing punches for a counterexample, and its exact vertices, as sets of indices."""
    points = points_on(deck_of(name))
    return set(from_cards("listing", run_of(name), points).vertices), set(exact_hull(points).vertices)


@claim("thesis.159")
def silent_loss() -> Check:
    punched, judge = vertices_of("silent.deck")
    planes = [facet.plane for facet in exact_hull(points_on(deck_of("silent.deck"))).facets]
    digits, words = min(len(str(max(map(abs, plane)))) for plane in planes), typed(run_of("silent.deck"))
    passed = digits > 8 and punched != judge and "NOT ACCEPTABLE" not in words
    message = f"the exact equations need {digits} digits or more; the programs punch {len(punched)} of {len(judge)} "
    return refuted(passed, f"{message}vertices and type only {words}")


@claim("thesis.65")
def notation() -> Check:
    text = "".join(programs.deck(name).text() for name in THREE[1:])
    symbols = "NETC NE NV MM NN KK N A B C D X Y Z C1 C2 U N1 D1 D2 D3".split()
    names = [symbol for symbol in symbols if re.search(rf"\b{symbol} *[(=]", text)]
    passed = symbols[:6] == names[:6] and 2 * len(names) > len(symbols)
    return exhibited(passed, f"{len(names)} of {len(symbols)} symbols are names in the listings: {', '.join(names)}")


@claim("thesis.93", "thesis.189", full=300)
def orientation_by_c(cases: int = CASES) -> Check:
    runs = (construction(sampled.points, programs.program) for sampled in flat_and_spatial_sets(cases))
    checks = [sign < 0 for run in runs for sign in run.signs]
    message = f"programs 1 to 3 choose the signs of {len(checks)} equations, and all are then negative at C, also "
    message += "those that program 3 eliminates in the same step"
    fault = plane_through_c()
    check = searched(BOTH, 2 * cases, checks, message)
    return check.unless(not fault.holds, f"a plane through C that is eliminated in the same step: {fault.message}")


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
        return slip(z == 1, right, "columns 29 to 42", f"program 1 reads a z of 1 in columns 39 to 52 as {float(z)}")
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
