"""The header of a TEI document: title, editors, sources, encoding, profile and revisions (TEI P5, chapter 2)."""

from dataclasses import dataclass
from xml.etree.ElementTree import Element, SubElement

from modern.edition.apparatus import Text
from modern.edition.sources import Document, sources
from modern.publication.tei_schema import FILE_NAME

TEI = "http://www.tei-c.org/ns/1.0"
XML = "http://www.w3.org/XML/1998/namespace"
ID, LANG = f"{{{XML}}}id", f"{{{XML}}}lang"
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
# The layers with modern changes of a program, which are not readings of a source.
PATCHES = ("epsilon", "translation", "corrected")
_CAUSES = {
    "ocr": "the error is the OCR's",
    "typist": "the error is the typist's",
    "author": "the error is the author's",
    "editor": "the change is the editor's",
    "undecidable": "the error may be on the page or in the OCR text",
}


@dataclass(frozen=True, slots=True)
class Heading:
    """The facts of a header.

    ``sha256`` is the hash of the witness's file, or empty for a register. ``text`` is the text with the apparatus that
    the document contains, or None for a register.
    """

    title: str
    document: Document
    version: str
    sha256: str = ""
    text: Text | None = None


def add(parent: Element, name: str, content: str, **attributes: str) -> Element:
    """Add an element that contains ``content`` to the element ``parent``, and return the new element."""
    child = SubElement(parent, name, attributes)
    child.text = content
    return child


def header(root: Element, heading: Heading, moves: Element | None = None) -> Element:
    """Write the header and return its ``classDecl`` element. ``moves`` is the ``listTranspose`` element, if any."""
    document, rows = heading.document, heading.text.rows if heading.text else ()
    dates = sorted({row.date for row in rows if row.date}, reverse=True)
    head = SubElement(root, "teiHeader")
    file = SubElement(head, "fileDesc")
    title = SubElement(file, "titleStmt")
    add(title, "title", heading.title)
    add(title, "author", document.author)
    editors = ", ".join(dict.fromkeys(row.editor for row in rows if row.editor)) or "The hull1620 developers"
    _responsible(title, "ed", "responsible editor: witness, apparatus, cards, commentary and verdicts", editors)
    _responsible(title, "reader", "optical character recognition", "")
    add(SubElement(file, "editionStmt"), "edition", f"hull1620 {heading.version}", n=heading.version)
    published = SubElement(file, "publicationStmt")
    add(published, "publisher", "The hull1620 developers")
    if dates:
        add(published, "date", dates[0], when=dates[0])
    rights = SubElement(published, "availability", status="restricted")
    add(rights, "p", f"The text: {document.rights}")
    add(rights, "licence", "The markup is CC0 1.0.", target="https://creativecommons.org/publicdomain/zero/1.0/")
    _witnesses(SubElement(SubElement(file, "sourceDesc"), "listWit"), heading)
    classes = _encoding(SubElement(head, "encodingDesc"), heading)
    profile = SubElement(head, "profileDesc")
    creation = SubElement(profile, "creation")
    _date(creation, document.year)
    languages = SubElement(profile, "langUsage")
    add(languages, "language", "English: the document and the notes of the editor", ident="en")
    add(languages, "language", "no natural language: FORTRAN statements and numbers", ident="zxx")
    keywords = SubElement(SubElement(profile, "textClass"), "keywords")
    for term in ("convex hull", "IBM 1620", "FORTRAN", document.kind):
        add(keywords, "term", term)
    if moves is not None:
        profile.append(moves)
    if dates:
        revision = SubElement(head, "revisionDesc")
        for date in dates:
            number = sum(row.date == date for row in rows)
            add(revision, "change", f"{number} rows of the apparatus", when=date, who="#ed")
    return classes


def _responsible(title: Element, name: str, task: str, holder: str) -> None:
    statement = SubElement(title, "respStmt", {ID: name})
    add(statement, "resp", task)
    add(statement, "orgName" if holder else "name", holder or "unknown")
    add(
        statement, "note", "The persons are unknown." if holder else "The person, the program and the date are unknown."
    )


def _date(parent: Element, year: str) -> None:
    """Write a year, as ``notBefore`` if the year is only a lower bound (``1971 or later``)."""
    add(parent, "date", year, **{"notBefore" if "or later" in year else "when": year[:4]})


def _witnesses(witnesses: Element, heading: Heading) -> None:
    document = heading.document
    bibl = SubElement(SubElement(witnesses, "witness", {ID: "print"}), "bibl")
    add(bibl, "author", document.author)
    add(bibl, "title", document.title)
    add(bibl, "publisher", document.institution)
    _date(bibl, document.year)
    if document.volume:
        add(bibl, "biblScope", document.volume, unit="volume")
    add(bibl, "biblScope", document.extent, unit="page")
    if document.doi.startswith("10."):
        add(bibl, "idno", document.doi, type="DOI")
    add(bibl, "note", "The editors have not seen the printed pages. Its readings are inferred from the OCR text.")
    bibl = SubElement(SubElement(witnesses, "witness", {ID: "ocr", "corresp": "#print"}), "bibl")
    add(bibl, "title", f"{document.held}; {document.lines} lines")
    add(bibl, "idno", document.sha256, type="SHA-256")
    if heading.sha256:
        add(bibl, "idno", heading.sha256, type="SHA-256-of-the-excerpt")
    for entry in sources().collated(document.id):
        bibl = SubElement(SubElement(witnesses, "witness", {ID: entry.id, "corresp": "#print"}), "bibl")
        add(bibl, "title", entry.title)
        add(bibl, "idno", entry.sha256, type="SHA-256-of-the-collation")
        add(bibl, "note", entry.independence)
    if heading.text and any(row.layer == "examples" for row in heading.text.rows):
        state = SubElement(witnesses, "witness", {ID: "examples"})
        state.text = "The earlier state of the program that ran the examples. It is lost and reconstructed here."


def _encoding(encoding: Element, heading: Heading) -> Element:
    SubElement(encoding, "schemaRef", {"type": "RELAXNG", "url": FILE_NAME})
    purpose = "The project restores the programs of the thesis, runs them and checks the statements of five documents."
    add(SubElement(encoding, "projectDesc"), "p", purpose)
    rules = SubElement(encoding, "editorialDecl")
    for rule in (
        "The OCR text of the pages is the only text at hand. Every departure from it has the id of a row.",
        "lem is the reading of the edition; an empty lem or rdg is an omission. A line whose readings are all empty "
        "does not exist in that state. Certainty is high, medium or low for certain, probable and conjecture.",
        "choice holds a modern patch of a program, which is no reading of a source. A patch has no certainty.",
        "space and surplus are blanks that the edition adds and removes. A displaced piece is a seg at its place in "
        "the OCR text; a transpose lists the seg and the anchor before which the print has it.",
        "n of an ab is the line of the excerpt, and n of its lb the line of the whole OCR text.",
    ):
        add(rules, "p", rule)
    SubElement(encoding, "variantEncoding", method="parallel-segmentation", location="internal")
    classes = SubElement(encoding, "classDecl")
    if heading.text:
        layers = heading.text.layers
        edited = [layer for layer in layers if layer in heading.text.default]
        patches = [layer for layer in layers if layer in PATCHES]
        states = [layer for layer in layers if layer not in (*edited, *patches)]
        taxonomy = SubElement(classes, "taxonomy", {ID: "layer"})
        groups = {"edited": edited, "states": states, "patches": patches}
        titles = ("the edited text", "states of the text that are lost", "modern patches")
        for (group, names), description in zip(groups.items(), titles, strict=True):
            if names:
                _categories(taxonomy, f"layers-{group}", description, {f"layer-{name}": LAYERS[name] for name in names})
        kinds = {f"kind-{kind}": kind for kind in sorted({row.kind for row in heading.text.rows})}
        for name, members in (("kind", kinds), ("cause", {f"cause-{key}": text for key, text in _CAUSES.items()})):
            taxonomy = SubElement(classes, "taxonomy", {ID: name})
            for key, description in members.items():
                _categories(taxonomy, key, description, {})
    return classes


def _categories(parent: Element, name: str, description: str, members: dict[str, str]) -> None:
    category = SubElement(parent, "category", {ID: name})
    add(category, "catDesc", description)
    for key, text in members.items():
        _categories(category, key, text, {})
