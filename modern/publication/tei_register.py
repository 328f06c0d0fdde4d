"""Write a register of statements as TEI: the quotations as text, and the verdicts as stand-off annotation.

The verdict on a statement is a ``span`` that points to the quotation of the statement.  If the quotation also occurs in
a text of this edition, the quotation refers to the line of that text.
"""

from functools import cache
from xml.etree.ElementTree import Element, SubElement

from modern.claims.apparatus_checks import texts
from modern.claims.register import DOCUMENTS, THESIS, VERDICTS, Statement, statements_of
from modern.edition.apparatus import build
from modern.edition.readings import solid
from modern.edition.sources import Document, sources
from modern.publication.tei_header import ID, Heading, add, header

# The name of each register in modern.claims by the name of its TEI document.
REGISTERS = {f"statements-{name}": name for name in DOCUMENTS}
# The least number of characters of a quotation that is looked up in the texts; shorter ones occur in many lines.
_SHORTEST = 8


def register(root: Element, name: str, version: str) -> None:
    """Write the register ``statements-DOCUMENT`` into an empty TEI element."""
    statements = statements_of(REGISTERS[name])
    document = document_of(REGISTERS[name])
    classes = header(root, Heading(f"Statements of {document.title}, with verdicts", document, version))
    taxonomy = SubElement(classes, "taxonomy", {ID: "verdict"})
    for verdict in VERDICTS:
        add(SubElement(taxonomy, "category", {ID: _category(verdict)}), "catDesc", verdict)
    div = SubElement(SubElement(SubElement(root, "text"), "body"), "div", {"type": "statements"})
    spans = SubElement(SubElement(root, "standOff"), "spanGrp", {"type": "verdicts", "resp": "#ed"})
    page = ""
    for statement in statements:
        if statement.page != page:
            page = statement.page
            SubElement(div, "pb", n=page, edRef="#print")
        ab = SubElement(div, "ab", {ID: statement.id, "type": "statement", "subtype": statement.kind.replace(" ", "-")})
        lines = " ".join(_lines(document, statement.words))
        add(ab, "quote", statement.words, **({"corresp": lines} if lines else {}))
        add(ab, "note", statement.says, type="paraphrase")
        span = SubElement(spans, "span", {ID: f"{statement.id}-verdict", "target": f"#{statement.id}"})
        span.set("ana", f"#{_category(statement.verdict)}")
        span.text = statement.verdict
        _evidence(span, statement)


def _evidence(span: Element, statement: Statement) -> None:
    for kind in ("why", "code", "file", "run", "part"):
        if value := getattr(statement, kind):
            add(span, "note", value, type=kind)
    for result in statement.results:
        add(span, "note", result, type="result")
    if statement.same:
        SubElement(span, "ref", {"type": "same", "target": f"#{statement.same}"}).text = statement.same


def _category(verdict: str) -> str:
    return "verdict-" + verdict.replace(",", "").replace("'", "").replace(" ", "-")


def document_of(register: str) -> Document:
    """Return the document whose statements a register contains."""
    prefix = "butler" if register == THESIS else register
    return next(document for document in sources().documents if document.id.startswith(prefix))


@cache
def _solid_lines(document: str) -> tuple[tuple[str, str], ...]:
    """Return each line of a document's texts without its blanks, together with the address of its TEI element."""
    lines = []
    for name, text in texts().items():
        if sources().excerpt(name).document == document:
            for line in (*text.witness, *build(text)):
                place = f"l{line.id}" if line.id.isdigit() else line.id
                lines.append((solid(line.text), f"{name}.xml#{name}-{place}"))
    return tuple(lines)


def _lines(document: Document, quotation: str) -> tuple[str, ...]:
    sought = solid(quotation)
    if len(sought) < _SHORTEST:
        return ()
    return tuple(dict.fromkeys(address for line, address in _solid_lines(document.id) if sought in line))
