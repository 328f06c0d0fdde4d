"""A text as TEI P5, by parallel segmentation: listings and prints with their witness and every emendation in line.

An *app* holds the readings of a place: ``lem`` what this edition prints (the layers of the deck or the corrected
print), ``rdg`` with ``wit="#ocr"`` what the witness has, ``rdg`` with ``resp`` and no witness a reading of a layer
beyond it.  An empty reading is an omission.  Apps nest where a later row changes what an earlier one established.  A
card or line is an ``ab``: ``n`` is the line of the witness, the ``lb`` in it the line of the document's text.  From the
file alone :mod:`modern.publication.tei_reading` gives back witness, corrected text and cards, byte for byte.

Source: TEI P5 Guidelines, chapter 2 (header), 12.1 (apparatus entries), 12.2.3 (parallel segmentation).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
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
"""The TEI's words for ours."""
LAYERS = {
    "ocr": "the page certainly said so; the OCR misread it",
    "typist": "a slip of the retyping that stands on the page",
    "author": "a slip of the author, or one that cannot be told from it",
    "print": "proved by the printed output",
    "lacuna": "conjecture: missing from listing or OCR, needed to run",
    "examples": "the earlier state of program 1, reconstructed from the printed orders",
    "epsilon": "modification of chapter 7: values from -e to +e count as zero",
    "translation": "modification of chapter 7: the origin moved to C",
    "corrected": "modern corrections of faults of the original",
}


@dataclass(frozen=True, slots=True)
class _Edition:
    """What is needed of a text while it is written; ``named`` the rows whose first app has been written, by id."""

    text: Text
    document: Document
    printed: frozenset[str]
    named: dict[str, int]


def tei(name: str, version: str) -> str:
    """The TEI document of a text of the edition (``program1``, ``chapter6``, ``appel_will_1976``, ...).

    ``version`` is the edition's, as the project states it.  Raises KeyError for a name that is no text's.
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
    _words(title, "title", text.title)
    _words(title, "author", document.author)
    role = SubElement(title, "respStmt", {_ID: "ed"})
    _words(role, "resp", "witness, apparatus and cards")
    _words(role, "name", ", ".join(dict.fromkeys(row.editor for row in text.rows if row.editor)) or "the editors")
    _words(SubElement(file, "editionStmt"), "edition", f"hull1620 {version}", n=version)
    published = SubElement(file, "publicationStmt")
    _words(published, "publisher", "The hull1620 developers")
    rights = SubElement(published, "availability", status="restricted")
    _words(rights, "p", f"The text: {document.rights}")
    _words(rights, "licence", "The apparatus is CC0 1.0.", target="https://creativecommons.org/publicdomain/zero/1.0/")
    _source(SubElement(file, "sourceDesc"), edition)
    _encoding(SubElement(header, "encodingDesc"), edition)
    dates = sorted({row.date for row in text.rows if row.date}, reverse=True)
    if dates:
        revision = SubElement(header, "revisionDesc")
        for date in dates:
            rows = sum(row.date == date for row in text.rows)
            _words(revision, "change", f"{rows} rows", when=date, who="#ed")


def _source(source: Element, edition: _Edition) -> None:
    document = edition.document
    witness = SubElement(SubElement(source, "listWit"), "witness", {_ID: "ocr"})
    bibl = SubElement(witness, "bibl")
    _words(bibl, "author", document.author)
    _words(bibl, "title", document.title)
    _words(bibl, "publisher", document.institution)
    _words(bibl, "date", document.year)
    if document.volume:
        _words(bibl, "biblScope", document.volume, unit="volume")
    _words(bibl, "biblScope", document.extent, unit="page")
    if document.doi.startswith("10."):
        _words(bibl, "idno", document.doi, type="DOI")
    _words(bibl, "note", document.held)
    _words(bibl, "idno", document.sha256, type="SHA-256")
    _words(bibl, "idno", sources().excerpt(edition.text.id).sha256, type="SHA-256-of-the-excerpt")


def _encoding(encoding: Element, edition: _Edition) -> None:
    _words(
        SubElement(encoding, "projectDesc"),
        "p",
        "The text an OCR made of the pages is the one witness. Every departure from it is an app with its row's id.",
    )
    editorial = SubElement(encoding, "editorialDecl")
    _words(
        editorial,
        "p",
        "lem has what the edition prints, rdg with wit what the witness has, rdg with resp alone a reading of a layer "
        "beyond the edition's text, rdg of type rejected a reading considered and not accepted. An empty lem or rdg is "
        "an omission. A line whose readings are all empty is no line of that state. cert is high for certain, medium "
        "for probable, low for conjecture. Of an ab, n is the line of the witness, and n of its lb the line of the "
        "whole text.",
    )
    SubElement(encoding, "variantEncoding", method="parallel-segmentation", location="internal")
    classes = SubElement(encoding, "classDecl")
    for kind, names in (("layer", edition.text.layers), ("kind", sorted({row.kind for row in edition.text.rows}))):
        taxonomy = SubElement(classes, "taxonomy", {_ID: kind})
        for name in names:
            category = SubElement(taxonomy, "category", {_ID: f"{kind}-{name}"})
            _words(category, "catDesc", LAYERS[name] if kind == "layer" else name)


def _witness(div: Element, edition: _Edition, source: str) -> None:
    """Every line of the witness's file in its order, each followed by the lines rows put after it."""
    excerpt = sources().excerpt(edition.text.id)
    follow = _followers(segments(edition.text))
    number = 0
    for raw in source.removesuffix("\n").split("\n"):
        if raw.startswith(PAGE_MARK):
            SubElement(div, "pb", n=raw[len(PAGE_MARK) :].strip(), ed="print")
            continue
        number += 1
        lines = follow.get(str(number))
        at = excerpt.line(number)
        if lines is None:
            kind = "furniture" if raw.strip() else "blank"
            _ab(div, edition, f"l{number}", kind, (raw,) if raw else (), at, str(number))
            continue
        for line in lines:
            if line.inserted:
                _ab(div, edition, line.id, "line", line.pieces, None, "")
            else:
                _ab(div, edition, f"l{line.id}", "line", line.pieces, at, line.id)


def _followers(lines: Iterable[Segments]) -> dict[str, list[Segments]]:
    """Each line of the witness with the lines put in after it."""
    found: dict[str, list[Segments]] = {}
    last = ""
    for line in lines:
        last = last if line.inserted else line.id
        found.setdefault(last, []).append(line)
    return found


def _ab(
    div: Element, edition: _Edition, place: str, kind: str, pieces: tuple[Piece, ...], at: int | None, number: str
) -> None:
    names = {_ID: f"{edition.text.id}-{place}", "type": kind, _SPACE: "preserve"}
    ab = SubElement(div, "ab", names | ({"n": number} if number else {}))
    if at is not None:
        SubElement(ab, "lb", n=str(at), ed="ocr")
    _write(ab, edition, pieces)


def _write(parent: Element, edition: _Edition, pieces: Iterable[Piece]) -> None:
    for piece in pieces:
        if isinstance(piece, str):
            _append(parent, piece)
            continue
        row = piece.row
        edition.named[row.id] = edition.named.get(row.id, 0) + 1
        first = edition.named[row.id] == 1
        names = {"type": row.layer, "ana": f"#layer-{row.layer} #kind-{row.kind}"}
        names |= {_ID: row.id} if first else {"corresp": f"#{row.id}"}
        app = SubElement(parent, "app", names)
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
        _words(app, "rdg", rejected.reading, type="rejected", resp="#ed")
        _words(app, "note", rejected.reason, type="rejected")
    _words(app, "note", row.reason, type="reason")
    _words(app, "note", row.evidence, type="evidence")
    if row.ground:
        _words(app, "note", "; ".join(f"{key}: {_plain(value)}" for key, value in row.ground.items()), type="ground")


def _plain(value: object) -> str:
    if isinstance(value, list | tuple):
        return ", ".join(map(_plain, value))
    if isinstance(value, Mapping):
        return ", ".join(f"{key} {_plain(one)}" for key, one in value.items())
    return str(value).lower() if isinstance(value, bool) else str(value)


def _devices(div: Element, chapter: Chapter) -> None:
    """The device files: cards whose words are tied to lines of the print, and whose blanks are the layout's."""
    for example, program, device, file in device_files(chapter):
        layout = device_layout(chapter, example, program, device)
        part = SubElement(div, "div", {"type": device, "n": file})
        for card in cards(chapter, example, program, device):
            ab = SubElement(part, "ab", {"type": "card", "n": str(card.number), _SPACE: "preserve"})
            if layout.layer == "stated":
                if card.image:
                    _words(ab, "supplied", card.image, reason="stated", resp="#ed")
                continue
            at = 1
            for token in card.tokens:
                if token.first > at:
                    SubElement(ab, "space", dim="horizontal", unit="chars", quantity=str(token.first - at), resp="#ed")
                _words(ab, "seg", token.text, corresp=f"#chapter6-{_place(token.line)}")
                at = token.last + 1


def _place(line: str) -> str:
    return f"l{line}" if line.isdigit() else line


def _words(parent: Element, name: str, words: str, **attributes: str) -> Element:
    element = SubElement(parent, name, attributes)
    element.text = words
    return element


def _append(parent: Element, words: str) -> None:
    """Characters at the end of an element's content."""
    if len(parent):
        parent[-1].tail = (parent[-1].tail or "") + words
    else:
        parent.text = (parent.text or "") + words


def _indent(root: Element) -> None:
    """Line ends and indentation everywhere but in what keeps its blanks."""
    kept = {id(ab): _copy(ab) for ab in root.iter("ab")}
    indent(root, " ")
    for ab in root.iter("ab"):
        text, inner = kept[id(ab)]
        ab.text = text
        for element, (words, tail) in zip(list(ab.iter())[1:], inner, strict=True):
            element.text, element.tail = words, tail


def _copy(ab: Element) -> tuple[str | None, list[tuple[str | None, str | None]]]:
    return ab.text, [(element.text, element.tail) for element in list(ab.iter())[1:]]


def names() -> Iterator[str]:
    """The texts that can be written."""
    yield from texts()


def schema() -> str:
    """The project's own RELAX NG schema: the elements and attributes these documents use, and no others."""
    return files("modern").joinpath("publication", "tei.rng").read_text(encoding="utf-8")
