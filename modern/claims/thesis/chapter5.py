"""Claims of chapters 5 and 6 and of the bibliography: what messages say, places for lines and planes, printed hulls."""

from __future__ import annotations

import re
from fractions import Fraction
from functools import cache

from emulator.language.cards import deck_from_lines
from emulator.language.formats import Literal
from modern.claims.register import CheckResult, fails_if, holds_if
from modern.claims.thesis.chapter7 import PLACES, deck_of, run_of, typed, vertices_of
from modern.comparison.difference import disagreement
from modern.comparison.outcome import from_card_hull, from_judge
from modern.edition import programs
from modern.edition.chapter6 import EXAMPLES, Print, input_deck, prints
from modern.exact_hull import exact_hull
from modern.formats.deck import data_deck, exact_points
from modern.port import convex_hull
from modern.port.points import take
from modern.thesis.cards import read_hull
from modern.thesis.job import COPLANAR, HullRun, run_hull

MOST_POINTS = 51
_SPACE = ((1, 2, 3), (2, 1, 5), (4, 4, 1), (3, 9, 2), (7, 1, 1))
"""Five points in no plane."""


def error_in_program() -> CheckResult:
    """Two decks end with the message: one meets a slip of program 3, the other none but has too many digits for it."""
    names = ("throughc.deck", "zeroplane.deck")
    ended = [typed(run_of(name)).endswith("ERROR IN PROGRAM") for name in names]
    hulls = [convex_hull([*exact_points(deck_of(name))[0].values()]) for name in names]
    passed = (
        all(ended) and all(hull.determined for hull in hulls) and bool(hulls[0].corrected) and not hulls[1].corrected
    )
    message = (
        f"typed of both; over exact numbers {', '.join(hulls[0].corrected)} is needed of the one, nothing of the other"
    )
    return holds_if(passed, message, conditional=True)


def message_after_wrong_hull() -> CheckResult:
    """The last cards of a run that has lost vertices."""
    punched = run_of("silent.deck").final.result.punched
    punched_vertices, hull_vertices = vertices_of("silent.deck")
    announced = any("CONVEX HULL HAS BEEN DETERMINED" in card for card in punched)
    wrong = announced and punched_vertices != hull_vertices
    return fails_if(wrong, f"punched after {len(punched_vertices)} of {len(hull_vertices)} vertices")


@cache
def _first_run(exponent: str) -> HullRun:
    cards = ["".join(f"+.{x}0000000{exponent}" for x in point) for point in _SPACE]
    return run_hull(deck_from_lines("small", [f"{len(cards):2}", *cards]), programs.program)


def points_are_coplanar() -> CheckResult:
    """Five points in space: the message at 10 to the power of -17, where squares are below the smallest number."""
    typed_coplanar = [COPLANAR in _first_run(exponent).steps[0].result.typed for exponent in ("E+01", "E-16", "E-17")]
    passed = typed_coplanar == [False, False, True] and exact_hull(_SPACE).dimension == 3
    return holds_if(passed, "typed of five points in no plane where coordinates are of 1E-18", conditional=True)


def underflow() -> CheckResult:
    """Numbers of one digit times a power of 10: none needs more than eight digits, and the result depends on the power.

    So this error is neither of coordinates nor of truncation.
    """
    hulls = [_first_run(exponent) for exponent in ("E+01", "E-17")]
    names = [run.final.name for run in hulls]
    passed = names == ["program3", "program2"]
    return holds_if(passed, f"the same points, times 1E-18: {names[0]} is asked for, and {names[1]}", conditional=True)


def ninth_digit_of_product() -> CheckResult:
    """Products and sums of eight digits: those that need nine lose the ninth."""
    arithmetic, (coordinates, *_) = take([("99999999", "0", "0"), ("11", "0", "0")], "truncating")
    product = Fraction(arithmetic.exact(coordinates[0] * coordinates[1], 2))
    passed = product == 1_099_999_900 == 99_999_999 * 11 - 89
    return holds_if(passed, f"99999999 times 11 is {product}, for 1099999989")


def plane_table_size() -> CheckResult:
    """98 places: as many as a hull of 51 points can have planes, which is 2N - 4; in between more are needed."""
    size = next(entry.size for entry in programs.program("program3").storage.arrays() if entry.name == "KK")
    hull = exact_hull([(k, k**2, k**3) for k in range(MOST_POINTS)])
    planes = len(hull.facets)
    overrun = convex_hull([*exact_points(deck_of("table.deck"))[0].values()], history=True)
    most = max(
        len(before.equations) + 2 * after.outside + 1
        for before, after in zip(overrun.history, overrun.history[1:], strict=False)
    )
    passed = len(hull.vertices) == MOST_POINTS and planes == 2 * MOST_POINTS - 4 == size == PLACES < most
    message = f"a hull of {len(hull.vertices)} vertices with {planes} planes fits; table.deck needs {most} places"
    return holds_if(passed, message, conditional=True)


def line_table_size() -> CheckResult:
    """Points of a parabola, all of them vertices: lines in use at once, against the 51 places of program 2."""
    size = next(entry.size for entry in programs.program("program2").storage.arrays() if entry.name == "MM")
    most = {}
    for n in (MOST_POINTS - 1, MOST_POINTS):
        history = convex_hull([(k, k * k, 0) for k in range(n)], history=True).history
        most[n] = max(len(stage.equations) for stage in history) + 1
    passed = most[MOST_POINTS - 1] == size < most[MOST_POINTS]
    message = ", ".join(f"{n} vertices: {places} lines at once" for n, places in most.items())
    return holds_if(passed, message, conditional=True)


def printed_hulls() -> CheckResult:
    """The hulls of examples 1 to 6 as chapter 6 prints them, against the judge's of their points."""
    checks = []
    for example in EXAMPLES:
        points = [tuple(map(Fraction, point)) for point in exact_points(input_deck(example))[0].values()]
        last = [result for result in prints(example) if result.device == "punch"][-1]
        printed_outcome = from_card_hull("print", f"program{last.program}", read_hull(last.lines), points)
        checks.append(disagreement(printed_outcome, from_judge(exact_hull(points), points), points).agrees)
    return holds_if(
        all(checks), f"{sum(checks)} of {len(checks)} printed hulls: vertices, boundary and inside points, equations"
    )


def possible_output() -> CheckResult:
    """Headings and messages that the listings punch or type, and those on the cards that chapter 6 prints."""
    missing: dict[str, set[str]] = {"PUNCH": set(), "PRINT": set()}
    for number in (1, 2, 3):
        program = programs.program(f"program{number}")
        cards = [
            line for k in EXAMPLES for result in prints(k) if result.program == number for line in _punched(result)
        ]
        statements = " ".join(line.text for line in program.statements)
        for device, lacking in missing.items():
            format_labels = {int(label) for label in re.findall(rf"{device} *(\d+)", statements)}
            headings = {
                text for k, form in program.formats if k in format_labels for text in map(_heading, form.specs) if text
            }
            lacking |= {heading for heading in headings if not any(heading in card for card in cards)}
    typed_only = {"ERROR IN PROGRAM", "DATA NOT ACCEPTABLE", "POINTS ARE COPLANAR", "POINTS ARE NOT COPLANAR"}
    passed = not missing["PUNCH"] and missing["PRINT"] == typed_only
    return holds_if(passed, f"of the headings punched all; not {', '.join(sorted(missing['PRINT']))}", conditional=True)


def _punched(result: Print) -> tuple[str, ...]:
    return tuple(result.lines) if result.device == "punch" else ()


def _heading(item: object) -> str:
    """The words of a part of a FORMAT that are more than a column's name."""
    return item.text if isinstance(item, Literal) and len(item.text.strip()) > len("NO.") else ""


def first_card() -> CheckResult:
    """N in columns 1 and 2, read by FORMAT 1, then a card for each point."""
    deck = data_deck([["1", "2", "3"]] * 8, "eight")
    cards = [card.text.rstrip() for card in deck.cards]
    listing = programs.deck("program1").text()
    passed = cards[0] in (" 8", "08") and len(cards) == 9 and "READ 1,N" in listing and "1 FORMAT (I2)" in listing
    return holds_if(passed, f"{len(cards)} cards of 8 points, the first one {cards[0]!r}")


_WORKS = {1: 73, 2: 180, 3: 38, 4: 136, 5: 297, 6: 290, 7: 94, 8: 302, 9: 329, 11: 306, 12: 301}
"""Pages of the works of the bibliography, by number (p. 121); work 10 is on pages 51 to 73 of its volume."""
_CITED = {
    2: (38,),
    3: (),
    5: (22, 82, 85, 96, 111, 208),
    6: (195, 201, 218, 219),
    8: (262,),
    9: (29, 33),
    10: (),
    11: (43, 110, 234),
}
"""What the text cites, by number and page (p. 2 to 50)."""


def cited_pages() -> CheckResult:
    """Every page cited is one of the work; eight works of twelve are cited by number."""
    within = [page <= _WORKS[work] for work, pages in _CITED.items() for page in pages]
    uncited = sorted({*_WORKS, 10} - {*_CITED})
    message = f"{sum(within)} of {len(within)} pages; works {', '.join(map(str, uncited))} are cited nowhere by number"
    return holds_if(all(within) and uncited == [1, 4, 7, 12], message, conditional=True)
