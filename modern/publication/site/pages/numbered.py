"""Faults of the originals and open questions, a section each, with the decks that show a fault."""

from __future__ import annotations

import re

from modern.edition.sources import read
from modern.publication.numbered import Item, numbered
from modern.publication.site.made import Made, Part, Target, one_of
from modern.publication.site.markup import element, escape, text

_FILE = re.compile(r"\[([^\]]+)\]\((?!https?:)[^)]+\)")
FILES = {"fortran_src/KNOWN-FAULTS.md": "fault", "fortran_src/OPEN-QUESTIONS.md": "question"}


def make(argument: str) -> Made:
    """The items of one of the two files."""
    kind = FILES[one_of(argument, FILES)]
    opening, items, closing = numbered(argument)
    parts, targets, under = [Part(text=opening)], [], ""
    for item in items:
        if item.under != under:
            under = item.under
            slug = "of-" + "".join(c if c.isalnum() else "-" for c in under.lower())
            parts.append(Part(under, slug, text=_FILE.sub(r"\1", item.before)))
        level = 2 if under else 1
        parts.append(Part(f"{item.number}. {item.title}", f"{kind}-{item.number}", level, text=_linked(item)))
        for deck in item.decks:
            parts.append(Part(html=_deck(deck)))
        targets.append(Target(f"{kind}-{item.number}", f"{kind} {item.number}", f"{kind} {item.number}"))
    if closing[0]:
        parts.append(Part(closing[0], "after", text=_FILE.sub(r"\1", closing[1])))
    return Made(tuple(parts), tuple(targets))


def _linked(item: Item) -> str:
    """The text with the rows of the listings made references; links to files have been resolved for no page here."""
    words = item.text
    for name in item.rows:
        if name.startswith("P"):
            words = words.replace(name, f"{{row}}`{name}`", 1)
    return _FILE.sub(r"\1", words)


def _deck(name: str) -> str:
    cards = read(f"fortran_src/grounds/{name}.deck").rstrip("\n")
    count = cards.count("\n") + 1
    shown = element("pre", escape(cards), tabindex="0", aria_label=f"the deck {name}")
    run = element("p", "run: " + text("code", f"hull1620 hull fortran_src/grounds/{name}.deck"))
    return element(
        "details", text("summary", f"the deck grounds/{name}: {count} cards") + shown + run, cls="deck-shown"
    )
