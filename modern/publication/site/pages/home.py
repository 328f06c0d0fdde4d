"""The parts of the home page that are made from data: pictures, how many verdicts, how to cite."""

from __future__ import annotations

import hashlib
import re
from collections import Counter
from pathlib import Path

from emulator.language.cards import Deck
from modern.claims.register import DOCUMENTS, THESIS, VERDICTS, statements_of
from modern.drawing.draw import draw_svg
from modern.drawing.punched import cards_svg
from modern.edition import programs
from modern.edition.chapter6 import EXAMPLES, input_deck
from modern.edition.reproduce import reproduce, summary
from modern.edition.sources import sources
from modern.formats.points import parse_input
from modern.port import convex_hull
from modern.publication.chart import chart
from modern.publication.chart_svg import chart_svg
from modern.publication.facing import Card, facing
from modern.publication.flow import flow
from modern.publication.site.made import Made, Part, one_of
from modern.publication.site.markup import address, element, escape, link, marked, table, text
from modern.publication.site.pictures import figure

CITATION = Path(__file__).parents[4] / "CITATION.cff"
SIGNS = {"holds": "\u2713", "holds with a condition": "(\u2713)", "does not hold": "\u2717", "not testable": "\u2013"}
_SHOWN = ("105+3", "130", "131+2", "143", "167")
"""Cards of program 3 whose OCR shows what there was to mend."""


def make(argument: str) -> Made:
    """``pictures``, ``verdicts``, ``programs`` or ``cite``."""
    made = {"pictures": _pictures, "verdicts": _verdicts, "programs": _programs, "cite": _cite}
    return Made((Part(html=made[one_of(argument, made)]()),))


def _pictures() -> str:
    found = {card.place: card for card in facing("program3").cards}
    rows = "".join(_line(found[place]) for place in _SHOWN)
    page = link("program3", _SHOWN[0], "program 3")
    words = f"A damaged text, and the cards restored from it: {page}, card by card."
    mended = element("figure", element("div", rows, cls="mended") + element("figcaption", words))
    card = found["105+3"]
    punched = figure(
        cards_svg(Deck("program3.f", (programs.deck("program3").cards[card.number - 1],)), title="a punched card"),
        "card",
        f"Statement {link('program3', card.place, card.place)} of program 3 as the punch made it.",
        "punched",
    )
    points = parse_input(input_deck(6).text(), "example6").points
    hull = convex_hull(points, "exact", on_refusal="return")
    drawn = figure(draw_svg(hull), "hull", "The hull of example 6, by exact numbers: what the programs punch.")
    sheet = figure(
        chart_svg(chart(flow(programs.program("program3"))), 1, lambda box: address("chart3", "sheet-1")),
        "chart",
        f"{link('charts', '', 'Flow charts')} from the compiled programs; the thesis\u2019s own are lost.",
        "flow",
    )
    return element("div", mended + punched + drawn + sheet, cls="plates broad")


def _line(card: Card) -> str:
    piece = card.witness[0]
    left = element("code", marked(piece.text.strip(), _stripped(piece.text, piece.changed), "del"))
    right = element("code", marked(card.text, card.changed, "ins"))
    return element("div", left + element("span", "\u2192", cls="sign", aria_hidden="true") + right)


def _stripped(words: str, spans: tuple[tuple[int, int], ...]) -> list[tuple[int, int]]:
    lead = len(words) - len(words.lstrip())
    return [(first - lead, last - lead) for first, last in spans]


def _verdicts() -> str:
    """The five documents: how many statements hold, and the examples printed."""
    rows = []
    for name in DOCUMENTS:
        document = next(
            each
            for each in sources().documents
            if each.id.startswith(name) or (name == THESIS and "thesis" in each.kind)
        )
        count = Counter(row.verdict for row in statements_of(name))
        cells = [
            f"{count[verdict]}&nbsp;{text('span', SIGNS[verdict], cls='quiet', aria_hidden='true')}"
            for verdict in VERDICTS
        ]
        bar = "".join(
            element("span", "", cls=f"v-{at}", style=f"flex-grow:{count[verdict]}")
            for at, verdict in enumerate(VERDICTS)
            if count[verdict]
        )
        who = f"{escape(document.author)} {link(f'statements/{name}', '', document.title)}"
        rows.append((who, *cells, element("span", bar, cls="weight", aria_hidden="true")))
    statements = table(("document", *VERDICTS, "share"), rows, "Verdicts", "Statements of the five documents")
    return statements + _examples()


def _examples() -> str:
    """Whether the printed examples of chapter 6 come out."""
    cells = []
    for example in EXAMPLES:
        good, exact, order, different = summary(reproduce((example,), states=("examples",)))
        words = "exact" if good and not order and not different else f"{exact} exact, {order} in another order"
        told = f": {words}" if different == 0 else ": different"
        cells.append(element("li", link(f"example{example}", "", f"Example {example}") + escape(told)))
    head = text("p", "The six examples of chapter 6, run as their points were put in, against the print:")
    return head + element("ul", "".join(cells), cls="examples")


def _programs() -> str:
    """The programs: where the thesis prints each, how many cards and rows, and its flow chart."""
    rows = []
    for built_in in programs.BUILT_INS:
        found = facing(built_in.name)
        pages = [page for page, _ in found.pages()]
        own = [row for row in found.rows() if row.layer in built_in.layers]
        sure = Counter(row.certainty for row in own)
        told = ", ".join(f"{sure[each]} {each}" for each in ("certain", "probable", "conjecture") if sure[each])
        chart_page = built_in.name.replace("program", "chart")
        rows.append(
            (
                link(built_in.name, "", built_in.title),
                text("span", f"{pages[0]}\u2013{pages[-1]}", cls="whole"),
                str(len(found.cards)),
                f"{len(own)}: {told}",
                link(chart_page, "", "flow chart"),
            )
        )
    return table(("program", "pages", "cards", "emendations", "where it goes"), rows, "Programs")


def _cite() -> str:
    fields = dict(re.findall(r'^(\S[\w-]*): "?([^"\n]+)"?$', CITATION.read_text(encoding="utf-8"), re.MULTILINE))
    year = fields["date-released"][:4]
    author = "The hull1620 developers"
    words = f"{author}, \u201c{fields['title']}\u201d, version {fields['version']}, {year}."
    bibtex = (
        f"@software{{hull1620,\n  author  = {{{{{author}}}}},\n  title   = {{{fields['title']}}},\n"
        f"  version = {{{fields['version']}}},\n  year    = {{{year}}}\n}}"
    )
    decks = [
        (text("code", f"{name}.f"), str(len(programs.deck(name).cards)), text("code", _digest(name)))
        for name in programs.NAMES
    ]
    hashes = table(("deck", "cards", "SHA-256"), decks, "Hashes", "What this edition of the decks is")
    inner = element("blockquote", text("p", words)) + element("pre", escape(bibtex), tabindex="0", aria_label="BibTeX")
    more = (
        "A card is cited by its address, as "
        + text("code", "program3.html#147+2")
        + "; a row of the apparatus by its name."
    )
    return inner + element("p", more) + hashes


def _digest(name: str) -> str:
    return hashlib.sha256(programs.deck(name).text().encode("ascii")).hexdigest()
