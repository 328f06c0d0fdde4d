"""HTML of the witness and of the rows of the apparatus, for the pages of listings and of printed examples."""

from collections.abc import Iterable
from functools import cache

from modern.edition import programs
from modern.edition.apparatus import Row
from modern.edition.collation import verdicts_by_id
from modern.edition.grounds import check_row
from modern.edition.sources import place
from modern.publication.site.markup import definitions, element, escape, link, text

GROUNDS = {
    "parse": "without the row, the deck does not compile",
    "print": "without the row, a printed result is no longer reproduced",
    "deck": "without the row, a named deck punches different cards",
    "forced": "with the row, the card equals a similar card with names exchanged",
    "cosmetic": "the object code is the same with and without the row",
    "width": "without the row, a field does not have 14 characters or is not a number",
    "arithmetic": "with the row, the printed plane equation vanishes at its printed vertices",
    "sibling": "the same words are printed in another place",
    "order": "the columns of the witness, a numbering or the page number prove the order",
    "result": "with the row, a computation reproduces a published result",
}
# The possible origins of an error in the witness, as shown on the page of a row.
CAUSES = {
    "ocr": "the OCR",
    "typist": "the typist",
    "author": "the author",
    "editor": "the editor",
    "undecidable": "cannot be decided",
}


def entry(row: Row, places: Iterable[str], page: str) -> str:
    """Return a row as an HTML article. ``places`` are the places of the cards on ``page`` that the row changes."""
    card_links = ", ".join(link(page, place, place) for place in places)
    head = element("h3", text("a", row.id, href=f"#{row.id}", cls="rowid"), cls="row-head")
    kind = escape(f"{row.layer}, {row.kind}; ") + text("strong", row.certainty)
    head += element("p", kind, cls="row-kind")
    fields = definitions(
        (
            ("witness", _reading(row.witness)),
            ("our reading", _reading(row.lemma)),
            *(("collated", escape(f"{name}: {', '.join(v)}")) for name, v in verdicts_by_id(row).items()),
            ("reason", escape(row.reason)),
            *(("rejected", f"{_reading(r.reading)} {escape(r.reason)}") for r in row.rejected),
            ("evidence", escape(row.evidence)),
            ("ground", _ground(row)),
            ("cause", escape(CAUSES[row.cause])),
            ("cards", card_links),
            ("source", escape(_source(row))),
            ("editor", escape(f"{row.editor}, {row.date}")),
        )
    )
    return element("article", head + fields, cls=f"row of-{row.layer}", id=row.id, aria_label=f"row {row.id}")


def _reading(reading: str) -> str:
    return " / ".join(text("code", line) for line in reading.split(" | "))


def _ground(row: Row) -> str:
    kind = str(row.ground.get("kind", ""))
    if not kind:
        return "none: the reading is a conjecture"
    values = ((key, value) for key, value in row.ground.items() if key != "kind")
    parameters = ", ".join(f"{k} {', '.join(map(str, v)) if isinstance(v, list) else v}" for k, v in values)
    in_program = row.text in programs.TEXTS
    meaning = GROUNDS[kind] if in_program or kind != "deck" else "the number also occurs in a deck"
    sentence = f"{escape(kind)}: {escape(meaning)}" + (f" ({escape(parameters)})" if parameters else "") + "."
    return sentence + (f" {text('span', 'Checked: ' + _observed(row.text, row.id), cls='seen')}" if in_program else "")


@cache
def _observed(program: str, row_id: str) -> str:
    """Check the ground of a row and return what the check observed."""
    proof = check_row(programs.text(program).row(row_id))
    return proof.message.partition(": ")[2] or proof.message


def _source(row: Row) -> str:
    where = place(row.text, row.changes[0].line)
    pages = f"p. {row.page}" if "-" not in row.page else f"pp. {row.page}"
    return f"{pages} of the thesis" + (f"; {where.partition(' of ')[0] + ' of its OCR text'}" if where else "")
