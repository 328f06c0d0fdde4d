"""The parts of the home page that are made from data: pictures, verdicts, the table of programs, the citation."""

from __future__ import annotations

import hashlib
from collections import Counter

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
from modern.publication.building import citation
from modern.publication.chart import chart
from modern.publication.chart_svg import chart_svg
from modern.publication.facing import Card, facing
from modern.publication.flow import flow
from modern.publication.site.made import Made, Part, one_of
from modern.publication.site.markup import address, element, escape, link, marked, table, text
from modern.publication.site.pictures import figure

SIGNS = {"holds": "\u2713", "holds with a condition": "(\u2713)", "does not hold": "\u2717", "not testable": "\u2013"}
_SHOWN = ("105+3", "130", "131+2", "143", "167")
"""Cards of program 3 that the OCR misread visibly."""


def make(argument: str) -> Made:
    """Return a part of the home page: ``pictures``, ``verdicts``, ``programs`` or ``cite``."""
    parts = {"pictures": _pictures, "verdicts": _verdicts, "programs": _programs, "cite": _cite}
    return Made((Part(html=parts[one_of(argument, parts)]()),))


def _pictures() -> str:
    cards = {card.place: card for card in facing("program3").cards}
    rows = "".join(_restored(cards[place]) for place in _SHOWN)
    page = link("program3", _SHOWN[0], "program 3")
    caption = f"The damaged text and the cards restored from it: {page}, card by card."
    restored = element("figure", element("div", rows, cls="mended") + element("figcaption", caption))
    card = cards["105+3"]
    punched = figure(
        cards_svg(Deck("program3.f", (programs.deck("program3").cards[card.number - 1],)), title="a punched card"),
        "card",
        f"Statement {link('program3', card.place, card.place)} of program 3 as a punched card.",
        "punched",
    )
    points = parse_input(input_deck(6).text(), "example6").points
    hull = convex_hull(points, "exact", on_refusal="return")
    drawn = figure(
        draw_svg(hull), "hull", "The hull of example 6 in exact arithmetic. The programs punch the same hull."
    )
    sheet = figure(
        chart_svg(chart(flow(programs.program("program3"))), 1, lambda box: address("chart3", "sheet-1")),
        "chart",
        f"{link('charts', '', 'Flow charts')} drawn from the compiled programs. The charts of the thesis are lost.",
        "flow",
    )
    return element("div", restored + punched + drawn + sheet, cls="plates broad")


def _restored(card: Card) -> str:
    """Show the witness's reading of a card next to the restored card."""
    piece = card.witness[0]
    left = element("code", marked(piece.text.strip(), _shifted(piece.text, piece.changed), "del"))
    right = element("code", marked(card.text, card.changed, "ins"))
    return element("div", left + element("span", "\u2192", cls="sign", aria_hidden="true") + right)


def _shifted(text: str, spans: tuple[tuple[int, int], ...]) -> list[tuple[int, int]]:
    """Move spans of a text to where they are without the leading blanks."""
    blanks = len(text) - len(text.lstrip())
    return [(first - blanks, last - blanks) for first, last in spans]


def _verdicts() -> str:
    """Return the numbers of verdicts for the five documents, and the comparison of the printed examples."""
    rows = []
    for name in DOCUMENTS:
        document = next(
            document
            for document in sources().documents
            if document.id.startswith(name) or (name == THESIS and "thesis" in document.kind)
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
        document_link = f"{escape(document.author)} {link(f'statements/{name}', '', document.title)}"
        rows.append((document_link, *cells, element("span", bar, cls="weight", aria_hidden="true")))
    statements = table(("document", *VERDICTS, "share"), rows, "Verdicts", "Statements of the five documents")
    return statements + _examples()


def _examples() -> str:
    """Return a list of the printed examples of chapter 6 with the verdict on each."""
    examples = []
    for example in EXAMPLES:
        ok, exact, reordered, different = summary(reproduce((example,), states=("examples",)))
        if different:
            verdict = "different"
        elif ok and not reordered:
            verdict = "exact"
        else:
            verdict = f"{exact} exact, {reordered} in another order"
        examples.append(element("li", link(f"example{example}", "", f"Example {example}") + escape(f": {verdict}")))
    head = text("p", "The printed results of the six examples in chapter 6, compared with today's runs:")
    return head + element("ul", "".join(examples), cls="examples")


def _programs() -> str:
    """Return a table of the programs with their pages, cards, emendations and flow charts."""
    rows = []
    for built_in in programs.BUILT_INS:
        listing = facing(built_in.name)
        pages = [page for page, _ in listing.pages()]
        rows_used = [row for row in listing.rows() if row.layer in built_in.layers]
        certainty = Counter(row.certainty for row in rows_used)
        counts = ", ".join(f"{certainty[c]} {c}" for c in ("certain", "probable", "conjecture") if certainty[c])
        chart_page = built_in.name.replace("program", "chart")
        rows.append(
            (
                link(built_in.name, "", built_in.title),
                text("span", f"{pages[0]}\u2013{pages[-1]}", cls="whole"),
                str(len(listing.cards)),
                f"{len(rows_used)}: {counts}",
                link(chart_page, "", "flow chart"),
            )
        )
    return table(("program", "pages", "cards", "emendations", "control flow"), rows, "Programs")


def _cite() -> str:
    fields = citation()
    year = fields["date-released"].year
    author = fields["authors"][0]["name"]
    reference = f"{author}, \u201c{fields['title']}\u201d, version {fields['version']}, {year}."
    bibtex = (
        f"@software{{hull1620,\n  author  = {{{{{author}}}}},\n  title   = {{{fields['title']}}},\n"
        f"  version = {{{fields['version']}}},\n  year    = {{{year}}}\n}}"
    )
    decks = [
        (text("code", f"{name}.f"), str(len(programs.deck(name).cards)), text("code", _digest(name)))
        for name in programs.NAMES
    ]
    hashes = table(("deck", "cards", "SHA-256"), decks, "Hashes", "The decks of this edition")
    inner = element("blockquote", text("p", reference)) + element(
        "pre", escape(bibtex), tabindex="0", aria_label="BibTeX"
    )
    addresses = (
        f"Cite a card by its address, such as {text('code', 'program3.html#147+2')}, "
        "and a row of the apparatus by its id."
    )
    return inner + element("p", addresses) + hashes


def _digest(name: str) -> str:
    return hashlib.sha256(programs.deck(name).text().encode("ascii")).hexdigest()
