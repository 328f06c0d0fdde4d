"""The front and back matter of the book: title, imprint, how to read it, the figures of the essay, the bibliography."""

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from modern.claims.register import COLUMNS, DOCUMENTS, THESIS, counts
from modern.drawing.draw import draw_svg
from modern.drawing.stages import strip
from modern.edition.sources import Document, sources
from modern.publication import essay
from modern.publication.book.markup import block, code, heading, label, say, string, table
from modern.publication.building import citation, fill
from modern.publication.facing import facing
from modern.publication.tei_register import document_of

# A function that saves a picture under a name, given its SVG text, and returns the name by which Typst finds it.
SavePicture = Callable[[str, str], str]
# The largest width and height of the picture of a stage, in pixels.
FRAME = 212, 230


def title_and_imprint() -> str:
    """Return the title page, the imprint on its back, and the contents, from the template ``front.typ``."""
    fields, thesis = citation(), document_of(THESIS)
    released = fields["date-released"]
    texts = {
        "TITLE": fields["title"],
        "AUTHOR": fields["authors"][0]["name"],
        "VERSION": fields["version"],
        "YEAR": str(released.year),
        "MONTH": str(released.month),
        "DAY": str(released.day),
        "DATE": f"{released:%B} {released.day}, {released.year}",
        "WRITER": thesis.author,
        "THESIS": thesis.title,
        "SOURCE": f"{_cited(thesis)} {thesis.rights}",
    }
    frame = Path(__file__).with_name("front.typ").read_text(encoding="utf-8")
    return fill(frame, **{name: string(text)[1:-1] for name, text in texts.items()})


def how_to_read() -> Iterator[str]:
    """Yield the section that explains the signs in the listings, in the textual notes and in the references."""
    card = next(card for card in facing("program3").cards if card.place == "131+2")
    piece = card.witness[0]
    witness, rows_of_card = f"{piece.line}: {piece.text.strip()}", say(", ".join(card.rows))
    sample = f"#card([{say(card.place)}], [{say('≠')}], {string(card.text)}, {string(witness)}, [{rows_of_card}])"
    yield say(
        "The story and the article can be read without the rest. The listings are for readers who want to check them: "
        "every card is shown with its place, and with the text from which it was restored if that text differs."
    )
    yield f"\n\n#block(above: 10pt, below: 10pt, width: 70%, [{sample}])\n\n"
    rows = (
        ("131+2", "the place of the card: the second statement after statement 131; references use it"),
        ("≠", "the card differs from the OCR text; + marks a card that the OCR text lacks"),
        ("second line", "the line of the OCR text with its number, and the rows of the apparatus that correct it"),
        (
            "right column",
            "the commentary: the purpose of a block of cards, and the steps of chapter 3 in it",
        ),
        ("p. 64", "a rule with this text marks the beginning of a page of the thesis"),
        ("a → b", "in a note: the reading of the OCR text and that of the edition"),
        ("certain, probable, conjecture", "how sure a reading is; the glossary defines these and all other terms"),
        ("thesis.16", "statement 16 of the register of verdicts; the other documents have their own names"),
    )
    yield table([say("sign"), say("meaning")], [[say(a), say(b)] for a, b in rows], (29, 110), (14, 14))
    yield say("A number after a reference is the page of this book. The site has the same text and runs the programs.")
    yield "\n\n"


def made(argument: str, save: SavePicture) -> str:
    """Return the book's form of a generated part of a page, such as ``story card``, or "" if the book omits it."""
    makers: dict[str, Callable[[SavePicture], str]] = {
        "story card": _card,
        "story growth": _growth,
        "story truncation": _truncation,
        "story cube": _cube,
        "home pictures": _mended,
        "home verdicts": _verdicts,
    }
    return makers[argument](save) if argument in makers else ""


def _table(caption: str, head: tuple[str, ...], rows: list[list[str]], widths: tuple[int, ...], right: range) -> str:
    content = table([say(name) for name in head], rows, widths, right=right).strip()
    return f"#figure([{content}], caption: [{say(caption)}])\n\n"


def _picture(file: str, caption: str, width: str, placement: str = "none") -> str:
    return f"#picture({string(file)}, {string(caption)}, width: {width}, placement: {placement})\n\n"


def _card(save: SavePicture) -> str:
    caption = f"The first point of example {essay.EXAMPLE} on a punched card"
    return _picture(save("essay-card", essay.card()), caption, "92%")


def _growth(save: SavePicture) -> str:
    caption = f"The hull of example {essay.EXAMPLE} grows in the order of program 3"
    return _picture(save("essay-growth", strip(essay.growth(None, *FRAME), columns=2)), caption, "62%", "auto")


def _truncation(save: SavePicture) -> str:
    rows = [[say(str(cell)) for cell in (x, *essay.plane_row(x))] for x in essay.XS]
    caption = f"{essay.plane_caption()} Its value at each of the three points should be zero."
    return _table(caption, ("x", *essay.HEAD), rows, (4, 14, 18, 14, 14, 14), range(6))


def _cube(save: SavePicture) -> str:
    _, typed, hull = essay.cube()
    drawn = _picture(save("essay-cube", draw_svg(hull, width=340)), "The unit cube, which program 3 cannot do", "40%")
    return drawn + block(typed)


def _mended(save: SavePicture) -> str:
    cards = {card.place: card for card in facing("program3").cards}
    shown = [cards[place] for place in essay.MISREAD]
    rows = [[code(card.witness[0].text.strip()), "→", code(card.text.strip())] for card in shown]
    caption = "Five damaged lines and the cards restored from them"
    return _table(caption, ("OCR text", "", "restored card"), rows, (40, 2, 40), range(0))


def _verdicts(save: SavePicture) -> str:
    rows = []
    for name in DOCUMENTS:
        count = counts(name)
        rows.append([say(document_of(name).author), *(say(str(count[verdict])) for verdict in COLUMNS)])
    caption = "The verdicts on the statements of the five documents"
    return _table(caption, ("document", *COLUMNS), rows, (34, *map(len, COLUMNS)), range(1, 1 + len(COLUMNS)))


def bibliography(literature: str, persons: Mapping[str, str]) -> Iterator[str]:
    """Yield the bibliography: the documents that SOURCES.toml lists, and then ``literature``, which is Typst markup.

    ``persons`` maps the surname of an author to the author's entry in the index.
    """
    yield heading("The five documents", 2, label("bibliography", "documents"))
    for document in sources().documents:
        marks = "".join(f"#idx({string(entry)});" for name, entry in persons.items() if name in document.author)
        yield f"#source[{marks}{say(_cited(document))} {say(document.held[:1].upper() + document.held[1:] + '.')}]\n\n"
    yield heading("Other literature", 2, label("bibliography", "literature"))
    yield literature


def _cited(document: Document) -> str:
    volume = f", {document.volume}" if document.volume not in ("", "unknown") else ""
    pages = f", pp. {document.extent}" if document.extent != "unknown" else ", volume and pages unknown"
    doi = f" doi:{document.doi}." if document.doi.startswith("10.") else ""
    kind = document.kind[:1].upper() + document.kind[1:]
    place = f"{document.institution}{volume}{pages}. {document.year}.{doi}"
    return f"{document.author}, “{document.title}”. {kind}. {place}"
