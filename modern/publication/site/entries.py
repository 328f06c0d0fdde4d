"""A row of the apparatus as an entry: reading, rejected readings, reason, ground, evidence, certainty.

The one place where a row becomes HTML; the words of each field stand here.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cache

from modern.edition import programs
from modern.edition.apparatus import Row
from modern.edition.grounds import check_row
from modern.edition.sources import place
from modern.publication.site.markup import definitions, element, escape, link, text

LAYERS = {
    "ocr": "what the OCR misread",
    "print": "what the printed output proves",
    "lacuna": "what is missing and needed to run",
    "examples": "program 1 as the examples were run",
    "epsilon": "chapter 7: values within e count as zero",
    "translation": "chapter 7: the origin moved to C",
    "corrected": "our corrections of faults",
    "typist": "slips of the retyping, on the page",
    "author": "slips of the author, or not to be told from them",
}
"""Every layer in few words."""
GROUNDS = {
    "parse": "without it the deck does not compile",
    "print": "without it a printed result comes out no more",
    "deck": "without it a named deck gives other cards",
    "forced": "with it the card is a sibling card with names exchanged",
    "cosmetic": "the object code is the same with and without it",
    "width": "without it a field has not its 14 characters, or is no number",
    "arithmetic": "with it the printed plane vanishes at its printed vertices",
    "sibling": "another place prints the same words",
    "order": "the column in the witness, a numbering, or the page's number",
    "result": "with it a published result comes out that is computed",
}
CAUSES = {
    "ocr": "the OCR",
    "typist": "the typist",
    "author": "the author",
    "editor": "the editor",
    "undecidable": "cannot be decided",
}


def entry(row: Row, cards: Iterable[tuple[str, str]], page: str) -> str:
    """A row; ``cards`` are pairs of address and place on ``page``."""
    touched = ", ".join(link(page, id, place_) for id, place_ in cards)
    head = element("h3", text("a", row.id, href=f"#{row.id}", cls="rowid"), cls="row-head")
    head += text("p", f"{row.layer}, {row.kind}; ", cls="row-kind").replace(
        "</p>", f"{text('strong', row.certainty)}</p>"
    )
    fields = definitions(
        (
            ("witness reads", _reading(row.witness)),
            ("read instead", _reading(row.lemma)),
            *(("rejected", f"{_reading(r.reading)} {escape(r.reason)}") for r in row.rejected),
            ("reason", escape(row.reason)),
            ("evidence", escape(row.evidence)),
            ("ground", _ground(row)),
            ("cause", escape(CAUSES[row.cause])),
            ("cards", touched),
            ("source", escape(_source(row))),
            ("editor", escape(f"{row.editor}, {row.date}")),
        )
    )
    return element("article", head + fields, cls=f"row of-{row.layer}", id=row.id, aria_label=f"row {row.id}")


def _reading(words: str) -> str:
    return " / ".join(text("code", part) for part in words.split(" | "))


def _ground(row: Row) -> str:
    kind = str(row.ground.get("kind", ""))
    if not kind:
        return "none: a conjecture"
    named = ", ".join(_named(row))
    told = GROUNDS[kind] if row.text in programs.TEXTS or kind != "deck" else "the number stands in a deck too"
    words = f"{escape(kind)}: {escape(told)}" + (f" ({escape(named)})" if named else "") + "."
    return words + (f" {text('span', 'Seen: ' + _seen(row), cls='seen')}" if row.text in programs.TEXTS else "")


def _named(row: Row) -> Iterator[str]:
    for key, value in row.ground.items():
        if key != "kind":
            yield f"{key} {', '.join(map(str, value)) if isinstance(value, list) else value}"


@cache
def _checked(name: str, row_id: str) -> str:
    proof = check_row(programs.text(name).row(row_id))
    return proof.message.partition(": ")[2] or proof.message


def _seen(row: Row) -> str:
    """What the check of the ground gave when the page was made."""
    return _checked(row.text, row.id)


def _source(row: Row) -> str:
    where = place(row.text, row.changes[0].line)
    pages = f"p. {row.page}" if "-" not in row.page else f"pp. {row.page}"
    return f"{pages} of the thesis" + (f"; {where.partition(' of ')[0] + ' of its OCR text'}" if where else "")
