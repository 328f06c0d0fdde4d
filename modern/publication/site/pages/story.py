"""The figures of the home page's essay: a punched card, the growing hull, a plane that fails to vanish, and the cube.

Every figure is complete without JavaScript; ``story.js`` shows the stages one at a time and moves the slider.
"""

import json
from collections.abc import Sequence
from fractions import Fraction
from itertools import product

from modern.drawing.draw import draw_svg
from modern.drawing.punched import cards_svg
from modern.drawing.stages import frames, strip
from modern.edition import programs
from modern.edition.chapter6 import input_deck
from modern.formats.deck import data_deck
from modern.formats.points import parse_input
from modern.port import convex_hull
from modern.port.arithmetic import at, plane
from modern.port.outcome import texts
from modern.port.points import take
from modern.publication.site.made import Made, Part, one_of
from modern.publication.site.markup import element, figure, inline, link, preformatted, table, text
from modern.thesis.job import run_hull

EXAMPLE = 6
CORNERS = ((127, 418, 52), (231, 64, 377))
FIRST = (213, 305)  # y and z of the first point; the reader chooses x
EYE = (1, 1, 2)  # the hull of the example is broad from this direction
XS = range(5, 1000, 5)


def make(argument: str) -> Made:
    """Return a figure of the essay: ``card``, ``growth``, ``truncation`` or ``cube``."""
    makers = {"card": _card, "growth": _growth, "truncation": _truncation, "cube": _cube}
    return Made((Part(html=makers[one_of(argument, makers)]()),))


def _card() -> str:
    deck = input_deck(EXAMPLE)
    second = type(deck)(deck.source, deck.cards[1:2])
    drawn = cards_svg(second, title="a punched data card")
    return figure(drawn, "card", f"The first point of example {EXAMPLE} on a punched card.", "punched")


def _growth() -> str:
    """Return the stages of the example's hull in the order of the program, one picture for each."""
    points = parse_input(input_deck(EXAMPLE).text(), f"example{EXAMPLE}").points
    stages = frames(convex_hull(points, "exact", history=True), EYE, width=480)
    items = "".join(element("li", inline(strip([stage]), f"stage{stage.stage.number}")) for stage in stages)
    caption = f"The hull of {link(f'example{EXAMPLE}', '', f'example {EXAMPLE}')}, in the order of program 3."
    return element("figure", element("ol", items, cls="stepper") + element("figcaption", caption))


def plane_values(arithmetic: str, points: Sequence[Sequence[int]]) -> tuple[str, list[str]]:
    """Return D of the plane through three points, and the plane's values at them, which should be 0.

    The calculation is that of program 3 (cards 130+3 to 130+10 and 116+4) in the named arithmetic.
    """
    numbers, (x, y, z) = take(points, arithmetic)
    corners = tuple((x[k], y[k], z[k]) for k in range(3))
    equation = plane(*corners)
    d, *values = texts(numbers, (equation[3], *(at(equation, corner) for corner in corners)), (3, 3, 3, 3))
    return d, values


def _truncation() -> str:
    """Return a slider for x of the first of three points, and the values of their plane at them in eight digits."""

    rows = []
    for x in XS:
        points = ((x, *FIRST), *CORNERS)
        exact, _ = plane_values("exact", points)
        machine, values = plane_values("truncating", points)
        rows.append((x, exact, machine, *values))
    head = ("x of the first point", "D, exactly", "D in eight digits", "first point", "second", "third")
    shown = [[text("span", str(cell)) for cell in row] for row in rows if row[0] in (95, 320, 590, 635, 815, 905)]
    summary = element(
        "p", "Value of the plane at its own three points, of which every one should be zero:", cls="quiet"
    )
    html = summary + table(head, shown, "A plane's values at its own points")
    others = " and ".join(f"({', '.join(map(str, point))})" for point in CORNERS)
    caption = (
        f"The plane through (x, {FIRST[0]}, {FIRST[1]}), {others}, as program 3 calculates it. All values are exact \
until D needs more than eight digits on the way. Then the plane misses its own points."
    )
    box = element("div", html, cls="slider", data_rows=json.dumps(rows))
    return element("figure", box + text("figcaption", caption))


def _cube() -> str:
    corners = [tuple(map(str, corner)) for corner in product((0, 1), repeat=3)]
    run = run_hull(data_deck([list(corner) for corner in corners], "cube"), programs.program)
    typed = [event.text for step in run.steps for event in step.result.events if event.what == "type"]
    hull = convex_hull([tuple(map(Fraction, corner)) for corner in corners], "exact")
    statements = sum(step.result.statements for step in run.steps)
    caption = f"The unit cube. After {statements:,} statements the typewriter of the 1620 has typed:"
    why = f"Why: {link('known-faults', '', 'known fault 2')}."
    drawn = figure(draw_svg(hull, width=360), "cube", caption)
    return drawn + preformatted("\n".join(typed), "typewriter") + element("p", why, cls="quiet")
