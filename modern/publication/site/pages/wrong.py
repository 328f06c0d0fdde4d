"""A set of which the programs give a wrong hull, beside the true one."""

from __future__ import annotations

import re
from fractions import Fraction

from emulator.language.cards import deck_from_text
from modern.comparison.card_differences import card_differences
from modern.drawing.against import draw_against
from modern.drawing.draw import Show
from modern.edition.programs import program
from modern.edition.sources import read
from modern.formats.points import parse_input
from modern.port import convex_hull
from modern.publication.facing import facing
from modern.publication.parting import parted
from modern.publication.site.made import Made, Part, one_of
from modern.publication.site.markup import element, escape, link, text
from modern.publication.site.pictures import figure
from modern.thesis.cards import read_hull
from modern.thesis.job import run_hull

FILE = "transcripts/counterexamples/silent.deck"


def make(argument: str) -> Made:
    """The page's parts."""
    one_of(argument, ("",))
    source = read(FILE)
    points = parse_input(source, "silent.deck").points
    run = run_hull(deck_from_text("silent.deck", source), program)
    punched = run.final.result.punched
    hull = convex_hull(points, "exact", on_refusal="return")
    claim = card_differences(read_hull(punched), hull, "cards")
    answer = parted("\n".join(" ".join(point) for point in points))
    drawn = figure(
        draw_against(hull, claim, width=520, show=Show("input")),
        "wrong",
        "The true hull, a tetrahedron. In red what the programs missed, in blue what they put in.",
        "drawing coloured",
    )
    cards = element("pre", escape("\n".join(punched)), tabindex="0", aria_label="the cards punched")
    said = "".join(text("li", words) for words in (*answer["says"], *answer["part"]))
    place = _place(answer["part"][0])
    again = element("p", "To do it again: " + text("code", f"hull1620 hull {FILE}"))
    return Made(
        (
            Part("The picture", "picture", html=drawn),
            Part("What was found", "found", html=element("ul", said) + place + again),
            Part("The cards punched", "cards", html=cards),
            Part("How exact numbers go", "exact", html=_worked(points)),
        )
    )


def _place(words: str) -> str:
    """A link to the card that the first words of a parting name: ``program 3, card 185: ...``."""
    found = re.match(r"program (\d), card (\d+):", words)
    assert found, "a parting names its program and card"
    name = f"program{found[1]}"
    card = next(card for card in facing(name).cards if card.number == int(found[2]))
    return element("p", f"The statement stands {link(name, card.place, f'in program {found[1]} at {card.place}')}.")


def _worked(points: tuple[tuple[str, ...], ...]) -> str:
    """The four planes: each one's value at the point it leaves out, exactly."""
    whole = [tuple(Fraction(x) for x in point) for point in points]
    rows = []
    for out in range(4):
        a, b, c = (whole[k] for k in range(4) if k != out)
        u, v, w = ([p[k] - a[k] for k in range(3)] for p in (b, c, whole[out]))
        value = (
            u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0])
        )
        rows.append(f"<li>Plane through all but point {out + 1}: its value at point {out + 1} is {int(value):,}.</li>")
    words = "No value is zero: every point is a vertex, and each plane leaves one point on its inner side."
    return element("ul", "".join(rows)) + text("p", words)
