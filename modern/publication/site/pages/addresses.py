"""The Index: subjects, error numbers, rows of the apparatus, names and cards, each with its address.

The lists are plain HTML and can be read, printed and searched without JavaScript. The script ``edition.js`` filters the
lists by the text in the input field. The script ``find.js`` shows matching entries on the search page, above the
matching pages.
"""

import csv
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from textwrap import shorten

from emulator.errors import explanations
from modern.claims.register import DOCUMENTS, judged
from modern.edition import programs
from modern.edition.apparatus import Row
from modern.edition.chapter6_cards import load_chapter
from modern.publication.building import ROOT
from modern.publication.examples import homes
from modern.publication.facing import facing, page_of
from modern.publication.site.made import Part
from modern.publication.site.markup import element, link, text
from modern.publication.site.pages.hub import summary
from modern.publication.uses import uses

# The programs in the order in which their entries are listed if several programs have the same card or name.
_ORDER = ("program3", "program2", "program1", "program1_examples")


@dataclass(frozen=True, slots=True)
class Place:
    """An entry of the Index: a name, the page and the id of the element to which it leads, and a description."""

    name: str
    page: str
    id: str
    description: str


def make(argument: str) -> list[Part]:
    """Return the search field and the lists."""
    field = text("label", "Subject, name, statement number, row or error number: ", for_="find")
    field += element("input", type="search", id="find", autocomplete="off", spellcheck="false", disabled=True)
    field += text("button", "Go to the first match", type="submit")
    field += text("output", "", for_="find", id="found")
    form = element("form", field, cls="finder", role="search", aria_label="Find in the index")
    lists = (
        Part("Subjects", "subjects", html=_list(_subjects())),
        Part("Error numbers", "error-numbers", html=_list(_errors())),
        Part("Rows of the apparatus", "rows", html=_list(_rows())),
        Part("Names", "names", html=_list(_names())),
    )
    cards = (Part(f"Cards of {name}", f"cards-{name}", html=_list(_cards(name))) for name in programs.NAMES)
    return [Part(html=form), *lists, *cards]


def places() -> Iterator[Place]:
    """Yield the entries of the Index, statements last. If entries have the same name, the best match comes first."""
    for entries in (_subjects(), _errors(), _rows(), _names(), *map(_cards, _ORDER)):
        yield from entries
    for document in DOCUMENTS:
        for judgement in judged(document):
            row = judgement.statement
            description = shorten(f"{row.verdict}: {row.says}", 90, placeholder=" \u2026")
            yield Place(row.id, f"statements/{document}", row.id, description)


def _list(entries: Iterable[Place]) -> str:
    inner = (link(entry.page, entry.id, entry.name) + " " + text("span", entry.description) for entry in entries)
    return element("ul", "".join(element("li", item) for item in inner), cls="addresses")


def _subjects() -> Iterator[Place]:
    with (ROOT / "docs" / "subjects.csv").open(encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            title, _ = summary((ROOT / "docs" / f"{row['page']}.md").read_text(encoding="utf-8"))
            section = f", {row['id'].replace('-', ' ')}" if row["id"] else ""
            yield Place(row["subject"], row["page"], row["id"], title + section)


def _errors() -> Iterator[Place]:
    for number, explanation in explanations().items():
        yield Place(f"error {number}", "errors", f"error-{number}", explanation.title)


def _rows() -> Iterator[Place]:
    for name in programs.TEXTS:
        for row in programs.text(name).rows:
            description = f"{_kinds(row)}: {programs.cards_of(row)}"
            yield Place(row.id, page_of(row), row.id, description)
    for row in load_chapter().text.rows:
        number = homes()[row.id][0] if row.id in homes() else None
        page = "examples" if number is None else f"example{number}"
        yield Place(row.id, page, row.id, _kinds(row))


def _kinds(row: Row) -> str:
    return ", ".join(dict.fromkeys((row.layer, row.kind, row.certainty)))


def _names() -> Iterator[Place]:
    names = [
        (entry.name, _ORDER.index(program), "library function in" if entry.function else "variable of")
        for program in programs.NAMES
        for entry in uses(program).names
    ]
    for name, order, kind in sorted(names):
        yield Place(name, _ORDER[order], f"name-{name}", f"{kind} {_ORDER[order]}")


def _cards(name: str) -> Iterator[Place]:
    for card in facing(name).cards:
        yield Place(card.place, name, card.place, f"{name}: {' '.join(card.text.split())}")
