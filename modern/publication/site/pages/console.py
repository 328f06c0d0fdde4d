"""The emulator's page, the comparison of the programs with exact arithmetic, and a point set with a wrong hull."""

import re

from emulator.language.cards import deck_from_text
from modern.comparison.difference import card_differences
from modern.drawing.against import draw_against
from modern.drawing.draw import Show
from modern.edition.programs import program
from modern.edition.sources import read
from modern.formats.points import parse_input
from modern.geometry.numbers import coordinates
from modern.geometry.vectors import cross, dot, minus
from modern.port import convex_hull
from modern.publication.console import console_page, parting_page
from modern.publication.facing import facing
from modern.publication.parting import parted
from modern.publication.site.made import Part, one_of
from modern.publication.site.markup import element, figure, link, preformatted, text
from modern.thesis.cards import read_hull
from modern.thesis.job import run_hull

FILE = "transcripts/counterexamples/silent.deck"


def make(argument: str) -> list[Part]:
    """Return the controls of a page (``machine`` or ``parting``), or the point set with a wrong hull (``wrong``)."""
    if one_of(argument, ("machine", "parting", "wrong")) == "wrong":
        return _wrong()
    return [Part(html=console_page() if argument == "machine" else parting_page())]


def _wrong() -> list[Part]:
    """Return a comparison of a punched hull with the true hull: picture, differences and exact calculation."""
    source = read(FILE)
    points = parse_input(source, "silent.deck").points
    run = run_hull(deck_from_text("silent.deck", source), program)
    punched = run.final.result.punched
    hull = convex_hull(points, "exact", on_refusal="return")
    claim = card_differences(read_hull(punched), hull, "cards")
    answer = parted("\n".join(" ".join(point) for point in points))
    added = " Blue: added by the programs." if claim.added or claim.polygons else ""
    caption = f"The true hull, a tetrahedron. Red: missed by the programs.{added}"
    drawn = figure(draw_against(hull, claim, width=520, show=Show("input")), "wrong", caption, "drawing coloured")
    cards = preformatted("\n".join(punched), "the cards punched")
    differences = "".join(text("li", line) for line in (*answer["says"], answer["part"]))
    statement = _statement_link(answer["part"])
    command = element("p", "To reproduce this result: " + text("code", f"hull1620 hull {FILE}"))
    return [
        Part("The picture", "picture", html=drawn),
        Part("Differences", "found", html=element("ul", differences) + statement + command),
        Part("The cards punched", "cards", html=cards),
        Part("The exact calculation", "exact", html=_worked(tuple(points))),
    ]


def _statement_link(divergence: str) -> str:
    """Return a link to the card that a sentence names: ``... program 3, card 185, ...``."""
    match = re.search(r"program (\d), card (\d+),", divergence)
    assert match is not None, "a divergence names its program and card"
    name = f"program{match[1]}"
    card = next(card for card in facing(name).cards if card.number == int(match[2]))
    return element("p", f"The statement: {link(name, card.place, f'program {match[1]}, {card.place}')}.")


def _worked(points: tuple[tuple[str, ...], ...]) -> str:
    """Return as HTML the exact value, at each of four points, of the equation of the plane through the other three."""
    exact = [coordinates(point) for point in points]
    rows = []
    for out in range(4):
        a, b, c = (exact[k] for k in range(4) if k != out)
        value = dot(cross(minus(b, a), minus(c, a)), minus(exact[out], a))
        number = out + 1
        rows.append(f"<li>The plane through all points except {number} has the value {int(value):,} at {number}.</li>")
    conclusion = "No value is zero, so the points form a tetrahedron, and each of the four points is a vertex."
    return element("ul", "".join(rows)) + text("p", conclusion)
