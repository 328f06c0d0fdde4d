"""The known faults with their decks, the open questions, the sources of the texts, and the error numbers."""

from emulator.errors import explanations
from modern.edition import programs
from modern.edition.sources import Document, Stretch, read, sources
from modern.publication.facing import page_of
from modern.publication.numbered import Item, numbered
from modern.publication.site.made import Part, one_of, slug
from modern.publication.site.markup import definitions, details, element, escape, preformatted, run_link, table, text

# The files of numbered items, with the prefix of their ids.
FILES = {"fortran_src/KNOWN-FAULTS.md": "fault", "fortran_src/OPEN-QUESTIONS.md": "question"}


def make(argument: str) -> list[Part]:
    """Return a section for each item of a numbered file, each document (``sources``) or each error (``errors``)."""
    if one_of(argument, ("sources", "errors", *FILES)) == "errors":
        return _errors()
    if argument == "sources":
        return [Part(document.title, document.id, html=_document(document)) for document in sources().documents]
    kind = FILES[argument]
    opening, items, closing = numbered(argument)
    parts, section = [Part(text=opening)], ""
    for item in items:
        if item.section != section:
            section = item.section
            parts.append(Part(section, slug("of", section), text=item.preamble))
        level = 2 if section else 1
        parts.append(Part(f"{item.number}. {item.title}", f"{kind}-{item.number}", level, text=_linked(item)))
        parts += [Part(html=_deck(deck)) for deck in item.decks]
    if closing[0]:
        parts.append(Part(closing[0], "after", text=closing[1]))
    return parts


def _errors() -> list[Part]:
    parts = []
    for number, explanation in explanations().items():
        lines = "\n".join(explanation.example)
        example = preformatted(lines, f"example of error {number}") if lines else ""
        facts = (("remedy", escape(explanation.remedy)), ("source", escape(explanation.source)))
        html = text("p", explanation.meaning) + example + definitions(facts, cls="facts")
        parts.append(Part(f"Error {number}: {explanation.title}", f"error-{number}", html=html))
    return parts


def _linked(item: Item) -> str:
    """Return the text of an item, in which the ids of emendations of the listings are replaced by links."""
    content = item.text
    for row in item.rows:
        if row.startswith("P"):
            address = f"{page_of(programs.text(f'program{row[1]}').row(row))}.html#{row}"
            html = f'<a class="reference internal" href="{address}"><span class="std std-ref">{row}</span></a>'
            content = content.replace(row, html, 1)
    return content


def _deck(name: str) -> str:
    cards = read(f"fortran_src/grounds/{name}.deck").rstrip("\n")
    count = cards.count("\n") + 1
    run = element("p", "Command: " + text("code", f"hull1620 hull fortran_src/grounds/{name}.deck"))
    link = run_link("program1", f"grounds/{name}", "Run it in the emulator", next="1")
    content = preformatted(cards, f"the deck {name}") + run + element("p", link)
    return details(f"the deck grounds/{name}: {count} cards", content, cls="deck-shown")


def _doi(doi: str) -> str:
    return text("a", doi, href=f"https://doi.org/{doi}") if doi.startswith("10.") else escape(doi)


def _stretch(stretch: Stretch) -> str:
    lines = f"{stretch.first}-{stretch.last}" if stretch.first < stretch.last else str(stretch.first)
    return f"{lines} from {stretch.at}{' (partly)' if stretch.part else ''}"


def _document(document: Document) -> str:
    facts = definitions(
        (
            ("author", escape(document.author)),
            ("kind", escape(document.kind)),
            ("year", escape(document.year)),
            ("institution", escape(document.institution)),
            ("volume, pages", escape(", ".join(dict.fromkeys(filter(None, (document.volume, document.extent)))))),
            ("DOI", _doi(document.doi)),
            ("text available", escape(document.held)),
            ("length", f"{document.bytes:,} bytes, {document.characters:,} characters, {document.lines:,} lines"),
            ("SHA-256", text("code", document.sha256)),
            ("rights", escape(document.rights)),
        ),
        cls="facts",
    )
    rows = [
        (
            text("code", excerpt.file),
            "; ".join(map(_stretch, excerpt.stretches[:6]))
            + (f"; and {len(excerpt.stretches) - 6} more" if len(excerpt.stretches) > 6 else ""),
            text("code", excerpt.sha256[:16]),
        )
        for excerpt in sources().excerpts
        if excerpt.document == document.id
    ]
    head = ("witness", "lines, and the line of the source where each range begins", "start of the SHA-256")
    excerpts = table(head, rows, name=f"Witnesses taken from {document.id}") if rows else ""
    others = [
        (
            text("a", entry.title, href=entry.address) + ("; collated" if entry.file else ""),
            escape(entry.held),
            escape(entry.independence),
        )
        for entry in sources().transcriptions
        if entry.document == document.id
    ]
    head = ("another transcription", "what is known of it", "independence")
    excerpts += table(head, others, name=f"Other transcriptions of {document.id}") if others else ""
    pages = "".join(text("li", f"{page}: lines {first} to {last}") for page, first, last in document.pages)
    return facts + excerpts + details("pages and lines", element("ul", pages))
