"""Write a text of the edition as TEI P5 with parallel segmentation: its witness with every emendation.

An *app* element holds the readings of a passage.  ``lem`` is the reading of this edition (the layers of the deck, or
the corrected text).  ``rdg`` with ``wit="#ocr"`` is the reading of the witness.  ``rdg`` with ``resp`` but without
``wit`` is that of a further layer.  An empty reading is an omission.  Apps are nested if a later row changes the
reading of an earlier one.  A card or line is an ``ab`` element: its ``n`` is the line of the witness, and the ``lb`` in
it the line of the whole document.  :mod:`modern.publication.tei_reading` restores witness, corrected text and cards.

Source: TEI P5 Guidelines, chapter 2 (header), 12.1 (apparatus entries), 12.2.3 (parallel segmentation).
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from importlib.resources import files
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from modern.claims.apparatus_checks import texts
from modern.edition.apparatus import PAGE_MARK, Row, Text
from modern.edition.chapter6_cards import Chapter, cards, device_files, device_layout, load_chapter
from modern.edition.programs import BUILT_INS
from modern.edition.segments import Piece, Segments, segments
from modern.edition.sources import Document, read, sources

TEI = "http://www.tei-c.org/ns/1.0"
XML = "http://www.w3.org/XML/1998/namespace"
_ID, _SPACE, _LANG = f"{{{XML}}}id", f"{{{XML}}}space", f"{{{XML}}}lang"
CERTAINTY = {"certain": "high", "probable": "medium", "conjecture": "low"}
LAYERS = {
    "ocr": "a misreading of the OCR; the page certainly has this reading",
    "typist": "a typing error on the page",
    "author": "an error of the author, or indistinguishable from one",
    "print": "a correction that the printed output of the examples proves",
    "lacuna": "a conjecture: text that the listing or the OCR lacks, without which the program does not work",
    "examples": "the earlier state of program 1 that ran the examples, reconstructed from the printed order of points",
    "epsilon": "a proposal of chapter 7: values from -e to +e count as zero",
    "translation": "a proposal of chapter 7: the origin is moved to the inside point C",
    "corrected": "corrections by the project of faults of the original programs",
}


@dataclass(frozen=True, slots=True)
class _Edition:
    """A text while it is written.  ``app_counts`` counts the app elements written so far for each row."""

    text: Text
    document: Document
    printed: frozenset[str]
    app_counts: dict[str, int]


def tei(name: str, version: str) -> str:
    """Return the TEI document of a text of the edition (``program1``, ``chapter6``, ``appel_will_1976``, ...).

    ``version`` is the version of the project.  Raise KeyError for an unknown name.
    """
    text = texts()[name]
    excerpt = sources().excerpt(name)
    document = sources().document(excerpt.document)
    listed = [b.layers for b in BUILT_INS if b.name == name]
    edition = _Edition(text, document, frozenset(listed[0] if listed else text.default), {})
    root = Element("TEI", {"xmlns": TEI, _ID: name, _LANG: "en"})
    _header(root, edition, version)
    body = SubElement(SubElement(root, "text"), "body")
    _witness(SubElement(body, "div", {"type": "listing" if listed else "print"}), edition, read(excerpt.file))
    if name == "chapter6":
        _devices(SubElement(body, "div", {"type": "devices"}), load_chapter())
    _indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(root, encoding="unicode") + "\n"


def _header(root: Element, edition: _Edition, version: str) -> None:
    document, text = edition.document, edition.text
    header = SubElement(root, "teiHeader")
    file = SubElement(header, "fileDesc")
    title = SubElement(file, "titleStmt")
    _add(title, "title", text.title)
    _add(title, "author", document.author)
    role = SubElement(title, "respStmt", {_ID: "ed"})
    _add(role, "resp", "witness, apparatus and cards")
    _add(role, "name", ", ".join(dict.fromkeys(row.editor for row in text.rows if row.editor)) or "the editors")
    _add(SubElement(file, "editionStmt"), "edition", f"hull1620 {version}", n=version)
    published = SubElement(file, "publicationStmt")
    _add(published, "publisher", "The hull1620 developers")
    rights = SubElement(published, "availability", status="restricted")
    _add(rights, "p", f"The text: {document.rights}")
    _add(rights, "licence", "The apparatus is CC0 1.0.", target="https://creativecommons.org/publicdomain/zero/1.0/")
    _source(SubElement(file, "sourceDesc"), edition)
    _encoding(SubElement(header, "encodingDesc"), edition)
    dates = sorted({row.date for row in text.rows if row.date}, reverse=True)
    if dates:
        revision = SubElement(header, "revisionDesc")
        for date in dates:
            rows = sum(row.date == date for row in text.rows)
            _add(revision, "change", f"{rows} rows", when=date, who="#ed")


def _source(source: Element, edition: _Edition) -> None:
    document = edition.document
    witness = SubElement(SubElement(source, "listWit"), "witness", {_ID: "ocr"})
    bibl = SubElement(witness, "bibl")
    _add(bibl, "author", document.author)
    _add(bibl, "title", document.title)
    _add(bibl, "publisher", document.institution)
    _add(bibl, "date", document.year)
    if document.volume:
        _add(bibl, "biblScope", document.volume, unit="volume")
    _add(bibl, "biblScope", document.extent, unit="page")
    if document.doi.startswith("10."):
        _add(bibl, "idno", document.doi, type="DOI")
    _add(bibl, "note", document.held)
    _add(bibl, "idno", document.sha256, type="SHA-256")
    _add(bibl, "idno", sources().excerpt(edition.text.id).sha256, type="SHA-256-of-the-excerpt")


def _encoding(encoding: Element, edition: _Edition) -> None:
    witness = "The OCR text of the pages is the only witness. Every departure from it is an app with the id of its row."
    _add(SubElement(encoding, "projectDesc"), "p", witness)
    editorial = SubElement(encoding, "editorialDecl")
    conventions = (
        "lem is the reading of the edition, rdg with wit that of the witness, rdg with resp alone that of a further "
        "layer, and rdg of type rejected a reading that was considered and not accepted. An empty lem or rdg is an "
        "omission. A line whose readings are all empty does not exist in that state. cert is high for certain, medium "
        "for probable, low for conjecture. n of an ab is the line of the witness, and n of its lb the line of the "
        "whole document."
    )
    _add(editorial, "p", conventions)
    SubElement(encoding, "variantEncoding", method="parallel-segmentation", location="internal")
    classes = SubElement(encoding, "classDecl")
    for kind, names in (("layer", edition.text.layers), ("kind", sorted({row.kind for row in edition.text.rows}))):
        taxonomy = SubElement(classes, "taxonomy", {_ID: kind})
        for name in names:
            category = SubElement(taxonomy, "category", {_ID: f"{kind}-{name}"})
            _add(category, "catDesc", LAYERS[name] if kind == "layer" else name)


def _witness(div: Element, edition: _Edition, source: str) -> None:
    """Write every line of the witness in order, each followed by the lines that rows insert after it."""
    groups: dict[str, list[Segments]] = {}  # each line of the witness with the lines inserted after it
    last = ""
    for line in segments(edition.text):
        last = last if line.inserted else line.id
        groups.setdefault(last, []).append(line)
    number = 0
    for raw in source.removesuffix("\n").split("\n"):
        if raw.startswith(PAGE_MARK):
            SubElement(div, "pb", n=raw[len(PAGE_MARK) :].strip(), ed="print")
            continue
        number += 1
        if str(number) not in groups:
            # A line outside the text: a page number, a heading, or a blank line.
            _ab(div, edition, f"l{number}", "furniture" if raw.strip() else "blank", (raw,) if raw else ())
        for line in groups.get(str(number), ()):
            _ab(div, edition, _place(line.id), "line", line.pieces)


def _ab(div: Element, edition: _Edition, place: str, kind: str, pieces: tuple[Piece, ...]) -> None:
    """Write a line as ``ab``.  The id of witness line 17 ends with ``l17``, that of an inserted line with its row."""
    attributes = {_ID: f"{edition.text.id}-{place}", "type": kind, _SPACE: "preserve"}
    number = place.removeprefix("l") if place.startswith("l") else ""
    ab = SubElement(div, "ab", attributes | ({"n": number} if number else {}))
    source_line = sources().excerpt(edition.text.id).line(int(number)) if number else None
    if source_line is not None:
        SubElement(ab, "lb", n=str(source_line), ed="ocr")
    _write(ab, edition, pieces)


def _write(parent: Element, edition: _Edition, pieces: Iterable[Piece]) -> None:
    for piece in pieces:
        if isinstance(piece, str):
            if len(parent):
                parent[-1].tail = (parent[-1].tail or "") + piece
            else:
                parent.text = (parent.text or "") + piece
            continue
        row = piece.row
        edition.app_counts[row.id] = edition.app_counts.get(row.id, 0) + 1
        first = edition.app_counts[row.id] == 1
        attributes = {"type": row.layer, "ana": f"#layer-{row.layer} #kind-{row.kind}"}
        # The first app of a row has its id; further ones refer to it.
        attributes |= {_ID: row.id} if first else {"corresp": f"#{row.id}"}
        app = SubElement(parent, "app", attributes)
        ours = {"resp": "#ed", "cert": CERTAINTY[row.certainty], "cause": row.cause}
        if row.layer in edition.printed:
            _write(SubElement(app, "lem", ours), edition, piece.new)
            _write(SubElement(app, "rdg", wit="#ocr"), edition, piece.old)
        else:
            _write(SubElement(app, "lem", wit="#ocr"), edition, piece.old)
            _write(SubElement(app, "rdg", ours), edition, piece.new)
        if first:
            _notes(app, row)


def _notes(app: Element, row: Row) -> None:
    for rejected in row.rejected:
        _add(app, "rdg", rejected.reading, type="rejected", resp="#ed")
        _add(app, "note", rejected.reason, type="rejected")
    _add(app, "note", row.reason, type="reason")
    _add(app, "note", row.evidence, type="evidence")
    if row.ground:
        _add(app, "note", "; ".join(f"{key}: {_plain(value)}" for key, value in row.ground.items()), type="ground")


def _plain(value: object) -> str:
    if isinstance(value, list | tuple):
        return ", ".join(map(_plain, value))
    if isinstance(value, Mapping):
        return ", ".join(f"{key} {_plain(inner)}" for key, inner in value.items())
    return str(value).lower() if isinstance(value, bool) else str(value)


def _devices(div: Element, chapter: Chapter) -> None:
    for example, program, device, file in device_files(chapter):
        layout = device_layout(chapter, example, program, device)
        part = SubElement(div, "div", {"type": device, "n": file})
        for card in cards(chapter, example, program, device):
            ab = SubElement(part, "ab", {"type": "card", "n": str(card.number), _SPACE: "preserve"})
            if layout.layer == "stated":
                if card.image:
                    _add(ab, "supplied", card.image, reason="stated", resp="#ed")
                continue
            column = 1
            for token in card.tokens:
                if token.first > column:
                    blanks = str(token.first - column)
                    SubElement(ab, "space", dim="horizontal", unit="chars", quantity=blanks, resp="#ed")
                _add(ab, "seg", token.text, corresp=f"#chapter6-{_place(token.line)}")
                column = token.last + 1


def _place(line: str) -> str:
    return f"l{line}" if line.isdigit() else line


def _add(parent: Element, name: str, content: str, **attributes: str) -> None:
    SubElement(parent, name, attributes).text = content


def _indent(root: Element) -> None:
    """Indent the document, except the ``ab`` elements, in which blanks are significant."""
    originals = [(element, element.text, element.tail) for ab in root.iter("ab") for element in ab.iter()]
    indent(root, " ")
    for element, content, tail in originals:
        element.text = content
        if element.tag != "ab":  # the characters after an ab are not part of it
            element.tail = tail


def schema() -> str:
    """Return the project's RELAX NG schema, which allows only the elements and attributes of these documents."""
    return files("modern").joinpath("publication", "tei.rng").read_text(encoding="utf-8")
