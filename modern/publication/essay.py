"""The data of the home page's figures, which the book also shows: a card, a growing hull, a plane, and the cube."""

from collections.abc import Sequence
from itertools import product

from modern.drawing.punched import cards_svg
from modern.drawing.stages import Frame, frames
from modern.drawing.view import Eye
from modern.edition import programs
from modern.edition.chapter6 import input_deck
from modern.formats.deck import data_deck
from modern.formats.points import parse_input
from modern.geometry.hull import Hull
from modern.port import convex_hull
from modern.port.arithmetic import at, plane
from modern.port.outcome import texts
from modern.port.points import take
from modern.thesis.job import HullRun, run_hull

EXAMPLE = 6
# The places of five cards of program 3 that the OCR misread visibly.
MISREAD = ("105+3", "130", "131+2", "143", "167")
# The figure of the plane: the second and the third point, y and z of the first, and the values of x in its table.
CORNERS = ((127, 418, 52), (231, 64, 377))
FIRST = (213, 305)
XS = (95, 320, 590, 635, 815, 905)
HEAD = ("D, exactly", "D in eight digits", "first point", "second", "third")


def card() -> str:
    """Return, as SVG, the card with the first point of the example that the home page shows (:data:`EXAMPLE`)."""
    deck = input_deck(EXAMPLE)
    return cards_svg(type(deck)(deck.source, deck.cards[1:2]), title="a punched data card")


def growth(eye: Eye | None = None, width: int = 250, height: int = 2500) -> tuple[Frame, ...]:
    """Return pictures of the successive hulls of the home page's example, in the order in which they are made."""
    points = parse_input(input_deck(EXAMPLE).text(), f"example{EXAMPLE}").points
    return frames(convex_hull(points, "exact", history=True), eye, width, height)


def plane_values(arithmetic: str, points: Sequence[Sequence[int]]) -> tuple[str, list[str]]:
    """Return the coefficient D of the plane through three points, and the values of its equation at these points.

    The exact values are 0.  The calculation is that of program 3 (cards 130+3 to 130+10 and 116+4) in the named
    arithmetic.
    """
    numbers, (x, y, z) = take(points, arithmetic)
    corners = tuple((x[k], y[k], z[k]) for k in range(3))
    equation = plane(*corners)
    d, *values = texts(numbers, (equation[3], *(at(equation, corner) for corner in corners)), (3, 3, 3, 3))
    return d, values


def plane_row(x: int) -> tuple[str, ...]:
    """Return results of :func:`plane_values` for the home page's plane, whose first point has this x.

    The results are D in exact arithmetic, D in eight-digit arithmetic, and the three values of the equation in
    eight-digit arithmetic.
    """
    points = ((x, *FIRST), *CORNERS)
    (exact, _), (machine, values) = (plane_values(name, points) for name in ("exact", "truncating"))
    return exact, machine, *values


def plane_caption() -> str:
    """Return the sentence that names the points of the plane in the home page's figure of a plane."""
    others = " and ".join(f"({', '.join(map(str, point))})" for point in CORNERS)
    return f"The plane through (x, {FIRST[0]}, {FIRST[1]}), {others}, as program 3 calculates it."


def cube() -> tuple[HullRun, str, Hull]:
    """Return the run of the programs on the unit cube, the lines that they type, and the true hull."""
    corners = [*product((0, 1), repeat=3)]
    run = run_hull(data_deck([[*map(str, corner)] for corner in corners], "cube"), programs.program)
    typed = "\n".join(event.text for step in run.steps for event in step.result.events if event.what == "type")
    return run, typed, convex_hull(corners, "exact")
