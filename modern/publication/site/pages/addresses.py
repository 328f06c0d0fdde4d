"""Everything that has an address: names, rows, error numbers, statements and cards, in lists that a field filters.

The lists are the page's own text, so that they are read, printed and searched without JavaScript; ``edition.js`` hides
what does not fit the words typed.
"""

from __future__ import annotations

from collections.abc import Iterable

from emulator.errors import explanations
from modern.edition import programs
from modern.edition.apparatus import Row
from modern.publication.facing import facing
from modern.publication.site.made import Made, Part
from modern.publication.site.markup import element, link, text
from modern.publication.uses import uses


def make(argument: str) -> Made:
    """All addresses."""
    field = text("label", "Name, statement, row or error number: ", for_="find")
    field += element("input", type="search", id="find", autocomplete="off", spellcheck="false", disabled=True)
    field += text("button", "Go to the first", type="submit")
    field += text("output", "", for_="find", id="found")
    parts = [Part(html=element("form", field, cls="finder", role="search", aria_label="Find in the index"))]
    parts.append(Part("Error numbers", "error-numbers", html=_list(_errors())))
    parts.append(Part("Rows of the apparatus", "rows", html=_list(_rows())))
    parts.append(Part("Names", "names", html=_list(_names())))
    for name in programs.NAMES:
        parts.append(Part(f"Cards of {name}", f"cards-{name}", html=_list(_cards(name))))
    return Made(tuple(parts))


def _list(items: Iterable[tuple[str, str]]) -> str:
    inner = "".join(element("li", f"{where} {text('span', words)}") for where, words in items)
    return element("ul", inner, cls="addresses")


def _errors() -> Iterable[tuple[str, str]]:
    for number, found in explanations().items():
        yield link("errors", f"error-{number}", f"error {number}"), found.title


def _rows() -> Iterable[tuple[str, str]]:
    for name in programs.TEXTS:
        for row in programs.text(name).rows:
            yield (
                link(page_of(row), row.id, row.id),
                f"{row.layer}, {row.kind}, {row.certainty}: {programs.cards_of(row)}",
            )


def page_of(row: Row) -> str:
    """The page a row stands on: its listing's, or that of the state of the examples."""
    shown = {each.id for each in facing(row.text).rows()}
    return row.text if row.id in shown else f"{row.text}_examples"


def _names() -> Iterable[tuple[str, str]]:
    found = [(each.name, name) for name in programs.NAMES for each in uses(name).names]
    for each, name in sorted(found):
        yield link(name, f"name-{each}", each), name


def _cards(name: str) -> Iterable[tuple[str, str]]:
    for card in facing(name).cards:
        yield link(name, card.place, card.place), " ".join(card.text.split())
