"""The index of all addresses: error numbers, rows of the apparatus, names and cards.

The lists are plain HTML and can be read, printed and searched without JavaScript.  With it, ``edition.js`` filters them
by the text in the input field.
"""

from collections.abc import Iterable

from emulator.errors import explanations
from modern.edition import programs
from modern.publication.facing import facing
from modern.publication.site.made import Made, Part
from modern.publication.site.markup import element, link, text
from modern.publication.uses import uses


def make(argument: str) -> Made:
    """Return the search field and the lists."""
    field = text("label", "Name, statement number, row or error number: ", for_="find")
    field += element("input", type="search", id="find", autocomplete="off", spellcheck="false", disabled=True)
    field += text("button", "Go to the first match", type="submit")
    field += text("output", "", for_="find", id="found")
    form = element("form", field, cls="finder", role="search", aria_label="Find in the index")
    lists = (
        Part("Error numbers", "error-numbers", html=_list(_errors())),
        Part("Rows of the apparatus", "rows", html=_list(_rows())),
        Part("Names", "names", html=_list(_names())),
    )
    cards = (Part(f"Cards of {name}", f"cards-{name}", html=_list(_cards(name))) for name in programs.NAMES)
    return Made((Part(html=form), *lists, *cards))


def _list(items: Iterable[tuple[str, str]]) -> str:
    inner = "".join(element("li", f"{address} {text('span', description)}") for address, description in items)
    return element("ul", inner, cls="addresses")


def _errors() -> Iterable[tuple[str, str]]:
    for number, explanation in explanations().items():
        yield link("errors", f"error-{number}", f"error {number}"), explanation.title


def _rows() -> Iterable[tuple[str, str]]:
    for name in programs.TEXTS:
        for row in programs.text(name).rows:
            # The page of program1_examples shows only the rows that the listing of program 1 does not have.
            page = name if row in facing(name).rows() else f"{name}_examples"
            description = f"{row.layer}, {row.kind}, {row.certainty}: {programs.cards_of(row)}"
            yield link(page, row.id, row.id), description


def _names() -> Iterable[tuple[str, str]]:
    names = [(entry.name, program) for program in programs.NAMES for entry in uses(program).names]
    for name, program in sorted(names):
        yield link(program, f"name-{name}", name), program


def _cards(name: str) -> Iterable[tuple[str, str]]:
    for card in facing(name).cards:
        yield link(name, card.place, card.place), " ".join(card.text.split())
