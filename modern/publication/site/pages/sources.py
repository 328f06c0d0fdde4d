"""Where every text comes from: the documents, the excerpts that are witnesses, and their hashes."""

from __future__ import annotations

from modern.edition.sources import Document, sources
from modern.publication.site.made import Made, Part, Target
from modern.publication.site.markup import definitions, element, escape, table, text


def make(argument: str) -> Made:
    """All documents, a section each."""
    parts = [Part(document.title, document.id, html=_document(document)) for document in sources().documents]
    targets = [Target(document.id, document.id, document.title) for document in sources().documents]
    return Made(tuple(parts), tuple(targets))


def _document(document: Document) -> str:
    facts = definitions(
        (
            ("author", escape(document.author)),
            ("kind", escape(document.kind)),
            ("year", escape(document.year)),
            ("institution", escape(document.institution)),
            ("volume, pages", escape(", ".join(filter(None, (document.volume, document.extent))))),
            ("DOI", escape(document.doi)),
            ("what is held", escape(document.held)),
            ("its length", f"{document.bytes:,} bytes, {document.characters:,} characters, {document.lines:,} lines"),
            ("its SHA-256", text("code", document.sha256)),
            ("rights", escape(document.rights)),
        ),
        cls="facts",
    )
    rows = [
        (
            text("code", excerpt.file),
            "; ".join(f"{s.first}-{s.last} from {s.at}{' (in part)' if s.part else ''}" for s in excerpt.stretches[:6])
            + (f"; {len(excerpt.stretches) - 6} more" if len(excerpt.stretches) > 6 else ""),
            text("code", excerpt.sha256[:16]),
        )
        for excerpt in sources().excerpts
        if excerpt.document == document.id
    ]
    head = ("witness", "its lines, and where they begin in the text", "SHA-256, its beginning")
    excerpts = table(head, rows, name=f"Witnesses taken from {document.id}") if rows else ""
    pages = "".join(text("li", f"{page}: lines {first} to {last}") for page, first, last in document.pages)
    where = element("details", text("summary", "pages and lines") + element("ul", pages))
    return facts + excerpts + where
