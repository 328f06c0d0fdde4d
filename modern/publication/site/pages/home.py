"""The parts of the home page that are made from data: pictures, verdicts, the table of programs, the citation."""

import hashlib
from collections import Counter

from modern.claims.register import COLUMNS, DOCUMENTS, counts
from modern.edition import programs
from modern.edition.chapter6 import EXAMPLES
from modern.edition.reproduce import State, reproduce
from modern.publication import essay
from modern.publication.building import citation
from modern.publication.facing import Card, facing
from modern.publication.site.downloads import FOLDER, downloads
from modern.publication.site.made import Part, one_of
from modern.publication.site.markup import HERE, bar, element, escape, link, marked, table, text
from modern.publication.site.pages.statements import SIGNS
from modern.publication.tei_register import document_of

# The meaning of each column of the table of verdicts.
_MEANINGS = (
    "a computation confirms it",
    "it is true under a condition that the document does not state",
    "a counterexample refutes it",
    "an error of the author, the typist or the OCR",
    "a definition that our programs follow",
    "it concerns other works, judgements or lost figures",
    "it repeats another statement",
)


def make(argument: str) -> list[Part]:
    """Return a part of a page: ``pictures``, ``verdicts``, ``programs``, ``downloads`` or ``cite``."""
    parts = {"pictures": _pictures, "verdicts": _verdicts, "programs": _programs, "downloads": _files, "cite": _cite}
    return [Part(html=parts[one_of(argument, parts)]())]


def _pictures() -> str:
    cards = {card.place: card for card in facing("program3").cards}
    rows = "".join(_restored(cards[place]) for place in essay.MISREAD)
    page = link("program3", essay.MISREAD[0], "program 3")
    caption = f"The damaged text and the cards restored from it: {page}, card by card."
    return element("figure", element("div", rows, cls="mended") + element("figcaption", caption))


def _restored(card: Card) -> str:
    piece = card.witness[0]
    blanks = len(piece.text) - len(piece.text.lstrip())
    changed = [(first - blanks, last - blanks) for first, last in piece.changed]
    before = element("code", marked(piece.text.strip(), changed, "del"))
    after = element("code", marked(card.text, card.changed, "ins"))
    return element("div", before + element("span", "\u2192", cls="sign", aria_hidden="true") + after)


def _verdicts() -> str:
    rows = []
    for name in DOCUMENTS:
        document, count = document_of(name), counts(name)
        cells = (str(count[verdict]) for verdict in COLUMNS)
        shares = bar((f"v-{at}", count[verdict]) for at, verdict in enumerate(COLUMNS))
        document_link = f"{escape(document.author)} {link(f'statements/{name}', '', document.title)}"
        rows.append((document_link, *cells, shares))
    statements = table(("document", *COLUMNS, "share"), rows, "Verdicts", "Statements of the five documents")
    return statements + _key() + _examples()


def _key() -> str:
    items = []
    for at, (name, meaning) in enumerate(zip(COLUMNS, _MEANINGS, strict=True)):
        sample = element("span", bar([(f"v-{at}", 1)]) + escape(SIGNS[name]), cls="sample", aria_hidden="true")
        items.append(element("li", f"{sample} {element('strong', escape(name))}: {escape(meaning)}"))
    return element("ul", "".join(items), cls="meanings")


def _examples() -> str:
    examples = []
    for example in EXAMPLES:
        listed, rebuilt = (_agreement(example, state) for state in ("listing", "examples"))
        verdict = f": as listed {listed}; as reconstructed {rebuilt}"
        examples.append(element("li", link(f"example{example}", "", f"Example {example}") + escape(verdict)))
    head = text("p", "The printed results of the six examples, compared with program 1 as listed and as reconstructed:")
    return head + element("ul", "".join(examples), cls="examples")


def _agreement(example: int, state: State) -> str:
    reports = [report for report in reproduce((example,), states=(state,)) if not report.stated]
    kinds = Counter(report.verdict.kind for report in reports)
    return ", ".join(f"{count} {kind}" for kind, count in sorted(kinds.items()))


def _programs() -> str:
    rows = []
    for built_in in programs.BUILT_INS:
        listing = facing(built_in.name)
        pages = [page for page, _ in listing.pages()]
        rows_used = [row for row in listing.rows() if row.layer in built_in.layers]
        certainty = Counter(row.certainty for row in rows_used)
        sure = ", ".join(f"{certainty[c]} {c}" for c in ("certain", "probable", "conjecture") if certainty[c])
        rows.append(
            (
                link(built_in.name, "", built_in.title),
                text("span", f"{pages[0]}\u2013{pages[-1]}", cls="whole"),
                str(len(listing.cards)),
                f"{len(rows_used)}: {sure}",
                link(built_in.name.replace("program", "chart"), "", "flow chart"),
            )
        )
    return table(("program", "pages", "cards", "emendations", "control flow"), rows, "Programs")


def _files() -> str:
    rows = []
    for item in downloads():
        size = sum(map(len, item.files.values()))
        megabytes = f"{size / 1e6:.1f} MB" if size >= 1e5 else f"{size / 1e3:.0f} kB"
        content = f"{len(item.files):,} files, {megabytes}" if item.packed else megabytes
        file_link = text("a", item.name, href=f"{HERE}{FOLDER}/{item.name}", download=True)
        rows.append((file_link, escape(item.title), content, escape(item.licence)))
    return table(("file", "contents", "size unpacked", "licence"), rows, "Downloads")


def _cite() -> str:
    fields = citation()
    year = fields["date-released"].year
    author = fields["authors"][0]["name"]
    reference = f"{author}, \u201c{fields['title']}\u201d, version {fields['version']}, {year}."
    bibtex = (
        f"@software{{hull1620,\n  author  = {{{{{author}}}}},\n  title   = {{{fields['title']}}},\n"
        f"  version = {{{fields['version']}}},\n  year    = {{{year}}}\n}}"
    )
    rows = []
    for name in programs.NAMES:
        deck = programs.deck(name)
        digest = hashlib.sha256(deck.text().encode("ascii")).hexdigest()
        rows.append((text("code", f"{name}.f"), str(len(deck.cards)), text("code", digest)))
    hashes = table(("deck", "cards", "SHA-256"), rows, "Hashes", "The decks of this edition")
    card = text("code", "program3.html#147+2")
    addresses = f"Cite a card by its address, such as {card}, and a row of the apparatus by its id."
    citations = element("blockquote", text("p", reference))
    citations += text("pre", bibtex, tabindex="0", aria_label="BibTeX", cls="wraps")
    return citations + element("p", addresses) + hashes
