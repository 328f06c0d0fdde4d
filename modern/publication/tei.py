"""Write a text of the edition as TEI P5: its witness with all emendations, and a program's commentary.

Every line of the witness is an ``ab`` element. By parallel segmentation, an ``app`` element in a line holds the
readings of a passage. Other elements hold changes that no source has: ``choice`` holds a modern patch, ``space`` holds
blanks that the edition adds, and ``surplus`` holds blanks that the edition removes. ``seg`` holds a displaced piece,
and a ``transpose`` element in the header names the ``anchor`` before which the piece belongs. Each row of the apparatus
has one ``app`` with its reasons. If no line has a reading of the row, this ``app`` is in ``standOff``.

The module ``tei_schema`` describes every element, ``tei_header`` writes the header, ``tei_register`` writes the
verdicts on the statements, and ``tei_reading`` restores witness, corrected text and cards from a document.

Source: TEI P5 Guidelines, chapter 2 (header), 11.3.4.5 (transposition), 12.1 (apparatus entries), 12.2.3 (parallel
segmentation), 16.10 (stand-off markup), 18 (feature structures).
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cache
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from modern.claims.apparatus_checks import texts
from modern.edition.apparatus import PAGE_MARK, Row, Text, build
from modern.edition.chapter6_cards import Chapter, cards, device_files, device_layout, load_chapter
from modern.edition.collation import verdicts_by_id
from modern.edition.programs import NAMES
from modern.edition.segments import Piece, Place, Segments, segments
from modern.edition.sources import read, sources
from modern.publication.commentary import commentary
from modern.publication.tei_header import CERTAINTY, ID, LANG, PATCHES, TEI, XML, Heading, add, header
from modern.publication.tei_register import REGISTERS, register
from modern.publication.tei_schema import FILE_NAME, odd, schema

_SPACE = f"{{{XML}}}space"
_MODEL = f'<?xml-model href="{FILE_NAME}" type="application/xml" schematypens="http://relaxng.org/ns/structure/1.0"?>\n'


@dataclass(frozen=True, slots=True)
class _Edition:
    """The state of writing a text.

    ``pieces`` has the contents of the displaced pieces by row and number. ``app_counts`` counts the app elements that
    have been written for each row. ``notes`` has the comments by the id of the line before which they stand.
    """

    text: Text
    pieces: dict[tuple[str, int], tuple[Piece, ...]]
    notes: Mapping[str, Element]
    app_counts: dict[str, int] = field(default_factory=dict)


@cache
def documents() -> tuple[str, ...]:
    """Return the names of all documents: the texts of the edition, and the registers of statements."""
    return (*texts(), *REGISTERS)


def tei(name: str, version: str) -> str:
    """Return a TEI document by its name, such as ``program1``, ``chapter6``, ``appel_will_1976`` or
    ``statements-thesis``.

    ``version`` is the version of the project. Raise KeyError for an unknown name.
    """
    root = Element("TEI", {"xmlns": TEI, ID: name, LANG: "en"})
    if name in REGISTERS:
        register(root, name, version)
    else:
        _text(root, name, version)
    _indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + _MODEL + tostring(root, encoding="unicode") + "\n"


def archive(version: str) -> dict[str, str]:
    """Return all documents, the schema that they name, and the ODD of the schema, as texts by file name."""
    return {f"{name}.xml": tei(name, version) for name in documents()} | {FILE_NAME: schema(), "hull1620.odd": odd()}


def _text(root: Element, name: str, version: str) -> None:
    text = texts()[name]
    listed = name in NAMES
    lines = segments(text)
    pieces = {key: piece for line in lines for key, piece in _pieces_of(line.pieces)}
    notes = _commentary(text) if listed else {}
    edition = _Edition(text, pieces, notes)
    moves = Element("listTranspose")
    for moved, number in pieces:
        move = SubElement(moves, "transpose", corresp=f"#{moved}")
        SubElement(move, "ptr", target=f"#{moved}-{number}")
        SubElement(move, "ptr", target=f"#{moved}-{number}-to")
    excerpt = sources().excerpt(name)
    heading = Heading(text.title, sources().document(excerpt.document), version, excerpt.sha256, text)
    header(root, heading, moves if pieces else None)
    content = SubElement(root, "text")
    body = SubElement(content, "body")
    language = {LANG: "zxx"} if listed else {}
    _witness(SubElement(body, "div", {"type": "listing" if listed else "print"} | language), edition, lines)
    if name == "chapter6":
        _devices(SubElement(body, "div", {"type": "devices"}), load_chapter())
    if listed:
        _variables(SubElement(SubElement(content, "back"), "div", {"type": "variables"}), name)
    if rows := [row for row in text.rows if row.id not in edition.app_counts]:
        entries = SubElement(SubElement(root, "standOff"), "listApp", {"type": "rows"})
        for row in rows:
            sure = {} if row.layer in PATCHES else {"resp": "#ed", "cert": CERTAINTY[row.certainty]}
            classes = f"#layer-{row.layer} #kind-{row.kind} #cause-{row.cause}"
            _notes(SubElement(entries, "app", {ID: row.id, "type": row.layer, "ana": classes} | sure), row)


def _pieces_of(pieces: Iterable[Piece]) -> Iterable[tuple[tuple[str, int], tuple[Piece, ...]]]:
    for piece in pieces:
        if isinstance(piece, Place):
            if piece.moved and piece.new:
                yield (piece.row.id, piece.moved), piece.new
            yield from _pieces_of((*piece.old, *piece.new))


def _witness(div: Element, edition: _Edition, lines: Iterable[Segments]) -> None:
    """Write every line of the witness in order. A line that the apparatus inserts follows its predecessor."""
    groups: dict[str, list[Segments]] = {}  # each line of the witness with the lines inserted after it
    last = ""
    for line in lines:
        last = last if line.inserted else line.id
        groups.setdefault(last, []).append(line)
    number = 0
    for raw in read(sources().excerpt(edition.text.id).file).removesuffix("\n").split("\n"):
        if raw.startswith(PAGE_MARK):
            SubElement(div, "pb", n=raw[len(PAGE_MARK) :].strip(), edRef="#print")
            continue
        number += 1
        if str(number) not in groups:
            # A line outside the text: a page number, a heading, or a blank line.
            _ab(div, edition, f"l{number}", "furniture" if raw.strip() else "blank", (raw,) if raw else ())
        for line in groups.get(str(number), ()):
            if line.id in edition.notes:
                div.append(edition.notes[line.id])
            _ab(div, edition, _place(line.id), "line", line.pieces)


def _ab(div: Element, edition: _Edition, place: str, kind: str, pieces: tuple[Piece, ...]) -> None:
    """Write a line as an ``ab`` element. ``place`` is the last part of its id, and ``kind`` is its type."""
    attributes = {ID: f"{edition.text.id}-{place}", "type": kind, _SPACE: "preserve"}
    number = place.removeprefix("l") if place.startswith("l") else ""
    ab = SubElement(div, "ab", attributes | ({"n": number} if number else {}))
    source_line = sources().excerpt(edition.text.id).line(int(number)) if number else None
    if source_line is not None:
        SubElement(ab, "lb", n=str(source_line), edRef="#ocr")
    _write(ab, edition, pieces)


def _write(parent: Element, edition: _Edition, pieces: Iterable[Piece]) -> None:
    for piece in pieces:
        if isinstance(piece, str):
            if len(parent):
                parent[-1].tail = (parent[-1].tail or "") + piece
            else:
                parent.text = (parent.text or "") + piece
            continue
        row, old, new = piece.row, piece.old, piece.new
        ours = {"resp": "#ed", "corresp": f"#{row.id}"}
        if piece.moved and old:
            seg = SubElement(parent, "seg", {ID: f"{row.id}-{piece.moved}", "corresp": f"#{row.id}"})
            _write(seg, edition, edition.pieces[row.id, piece.moved])
        elif piece.moved:
            SubElement(parent, "anchor", {ID: f"{row.id}-{piece.moved}-to"})
        elif not old and len(new) == 1 and isinstance(new[0], str) and not new[0].strip(" "):
            SubElement(parent, "space", ours | {"dim": "horizontal", "unit": "chars", "quantity": str(len(new[0]))})
        elif not new and len(old) == 1 and isinstance(old[0], str) and not old[0].strip():
            add(parent, "surplus", old[0], **ours, reason="columns")
        elif row.layer in PATCHES:
            choice = SubElement(parent, "choice")
            _write(SubElement(choice, "sic"), edition, old)
            _write(SubElement(choice, "corr", {"type": row.layer} | ours), edition, new)
        else:
            _app(parent, edition, piece)


def _app(parent: Element, edition: _Edition, place: Place) -> None:
    """Write the readings of a row at one place. The first ``app`` of a row has the row's id and notes."""
    row = place.row
    edition.app_counts[row.id] = edition.app_counts.get(row.id, 0) + 1
    first = edition.app_counts[row.id] == 1
    attributes = {"type": row.layer, "ana": f"#layer-{row.layer} #kind-{row.kind}"}
    app = SubElement(parent, "app", attributes | ({ID: row.id} if first else {"corresp": f"#{row.id}"}))
    ours = {"resp": "#ed", "cert": CERTAINTY[row.certainty]}
    if row.layer == "examples":
        _write(SubElement(app, "lem", wit="#ocr"), edition, place.old)
        _write(SubElement(app, "rdg", ours | {"wit": "#examples"}), edition, place.new)
    else:
        # An error of the OCR is not on the page, an error of the author or the typist is.
        collated = verdicts_by_id(row)
        lem = ["#print"] * (row.cause == "ocr") + [f"#{name}" for name, v in collated.items() if set(v) == {"confirms"}]
        _write(SubElement(app, "lem", ours | ({"wit": " ".join(lem)} if lem else {})), edition, place.new)
        wit = "#print #ocr" if row.cause in ("author", "typist") else "#ocr"
        wit += "".join(f" #{name}" for name, v in collated.items() if set(v) == {"supports a rival"})
        _write(SubElement(app, "rdg", wit=wit, cause=row.cause), edition, place.old)
    if first:
        _notes(app, row)


def _notes(app: Element, row: Row) -> None:
    for rejected in row.rejected:
        add(app, "rdg", rejected.reading, type="rejected", resp="#ed")
        add(app, "note", rejected.reason, type="rejected")
    add(app, "note", row.reason, type="reason")
    add(app, "note", row.evidence, type="evidence")
    if row.ground:
        _features(SubElement(app, "note", {"type": "ground"}), row.ground)


def _features(parent: Element, values: Mapping[str, object]) -> None:
    """Write a mapping as a TEI feature structure. The value of the key ``kind`` is the type of the structure."""
    structure = SubElement(parent, "fs", {"type": str(values["kind"])} if "kind" in values else {})
    for key, value in values.items():
        if key != "kind":
            _value(SubElement(structure, "f", name=key), value)


def _value(parent: Element, value: object) -> None:
    if isinstance(value, Mapping):
        _features(parent, value)
    elif isinstance(value, list | tuple):
        collection = SubElement(parent, "vColl", org="list")
        for inner in value:
            _value(collection, inner)
    elif isinstance(value, bool):
        SubElement(parent, "binary", value=str(value).lower())
    elif isinstance(value, int):
        SubElement(parent, "numeric", value=str(value))
    else:
        add(parent, "string", str(value))


def _commentary(text: Text) -> dict[str, Element]:
    """Return the comments on the blocks of a program as notes, by the id of the first line of each block."""
    lines = [line.id for line in build(text)]
    notes = {}
    for number, block in enumerate(commentary(text.id).blocks, 1):
        first, last = (lines[card - 1] for card in (block.cards[0], block.cards[-1]))
        note = Element("note", {ID: f"{text.id}-block-{number}", "type": "commentary", "resp": "#ed", LANG: "en"})
        note.set("target", f"#{text.id}-{_place(first)}")
        note.set("targetEnd", f"#{text.id}-{_place(last)}")
        add(note, "label", block.title)
        add(note, "p", " ".join(block.text.split()))
        if block.steps:
            add(note, "p", f"Steps of chapter 3: {'; '.join(block.steps)}.")
        notes[first] = note
    return notes


def _variables(div: Element, name: str) -> None:
    entries = SubElement(div, "list", {"type": "gloss"})
    for gloss in commentary(name).variables:
        add(entries, "label", gloss.name, **{ID: f"{name}-variable-{gloss.name}"})
        item = SubElement(entries, "item")
        item.text = " ".join(gloss.text.split())
        if gloss.limits:
            least, most = map(str, gloss.limits)
            item.text += " "
            add(item, "num", f"From {least} to {most}.", atLeast=least, atMost=most)


def _devices(div: Element, chapter: Chapter) -> None:
    for example, program, device, file in device_files(chapter):
        layout = device_layout(chapter, example, program, device)
        part = SubElement(div, "div", {"type": device, "n": file})
        for card in cards(chapter, example, program, device):
            ab = SubElement(part, "ab", {"type": "card", "n": str(card.number), _SPACE: "preserve"})
            if layout.layer == "stated":
                if card.image:
                    add(ab, "supplied", card.image, reason="stated", resp="#ed")
                continue
            column = 1
            for token in card.tokens:
                if token.first > column:
                    blanks = str(token.first - column)
                    SubElement(ab, "space", dim="horizontal", unit="chars", quantity=blanks, resp="#ed")
                add(ab, "seg", token.text, corresp=f"#chapter6-{_place(token.line)}")
                column = token.last + 1


def _place(line: str) -> str:
    return f"l{line}" if line.isdigit() else line


def _indent(root: Element) -> None:
    """Indent the document, but not inside ``ab`` elements, in which blanks are significant."""
    originals = [(element, element.text, element.tail) for ab in root.iter("ab") for element in ab.iter()]
    indent(root, " ")
    for element, content, tail in originals:
        element.text = content
        if element.tag != "ab":  # the characters after an ab are not part of it
            element.tail = tail
