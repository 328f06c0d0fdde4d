"""The statements of a document with their verdicts: each a row with its place, its words, its verdict and its evidence.

All of them stand in the page; controls hide those of other verdicts and kinds, by CSS and some lines of script.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from modern.claims.register import DOCUMENTS, THESIS, VERDICTS, Statement, Verdict, counterexample, statements_of
from modern.edition.sources import Document, sources
from modern.publication.site.made import Made, Part, Target, one_of
from modern.publication.site.markup import definitions, element, escape, text

SIGNS: dict[Verdict, str] = {
    "holds": "\u2713",
    "holds with a condition": "(\u2713)",
    "does not hold": "\u2717",
    "not testable": "\u2013",
}
_CLASSES: dict[Verdict, str] = {
    "holds": "holds",
    "holds with a condition": "condition",
    "does not hold": "fails",
    "not testable": "untested",
}


def document_of(name: str) -> Document:
    """What is held of a document, by its name on the command line."""
    return next(d for d in sources().documents if d.id.startswith(name) or (name == THESIS and "thesis" in d.kind))


def make(argument: str) -> Made:
    """The statements of a document."""
    name = one_of(argument, DOCUMENTS)
    rows = statements_of(name)
    parts = [Part(html=_controls(rows))]
    for page, some in _by_page(rows):
        parts.append(Part(f"Page {page}" if page[:1].isdigit() else page.capitalize(), _slug(page), html=_list(some)))
    targets = [Target(row.id, row.id, f"statement {row.id}") for row in rows]
    return Made(tuple(parts), tuple(targets))


def _by_page(rows: tuple[Statement, ...]) -> Iterator[tuple[str, list[Statement]]]:
    """Statements page by page, in the order in which pages are first met."""
    found: dict[str, list[Statement]] = {}
    for row in rows:
        found.setdefault(row.page, []).append(row)
    yield from found.items()


def _slug(page: str) -> str:
    return "page-" + "".join(c if c.isalnum() else "-" for c in page.lower())


def _controls(rows: tuple[Statement, ...]) -> str:
    """How many there are of each verdict, and a choice of those shown."""
    counts = Counter(row.verdict for row in rows)
    boxes = ""
    for verdict in VERDICTS:
        box = element("input", type="checkbox", value=_CLASSES[verdict], name="verdict", checked=True)
        words = f" {SIGNS[verdict]} {verdict}: {counts[verdict]}"
        boxes += element("label", box + escape(words))
    field = element("label", "Words: " + element("input", type="search", name="words", autocomplete="off"))
    button = text("button", "Show", type="submit")
    shown = text("output", "", cls="shown")
    inner = element("fieldset", text("legend", "Verdicts shown") + boxes) + element("p", f"{field} {button} {shown}")
    return element("form", inner, cls="controls filter", aria_label="Which statements are shown", hidden=True)


def _list(rows: list[Statement]) -> str:
    return element("ol", "".join(map(_statement, rows)), cls="statements")


def _statement(row: Statement) -> str:
    head = text("a", row.id, href=f"#{row.id}", cls="place")
    sign = element("span", escape(SIGNS[row.verdict]), aria_hidden="true")
    head += element("span", sign + " " + text("strong", row.verdict), cls=f"verdict v-{_CLASSES[row.verdict]}")
    head += text("span", row.kind, cls="quiet")
    facts = definitions(
        (
            ("words of the document", text("q", row.words) if row.words else ""),
            ("why", escape(row.why)),
            ("computed by", text("code", row.claim) if row.claim else ""),
            ("results", escape(", ".join(row.results))),
            ("tests", "<br>".join(text("code", name) for name in row.tests)),
            ("counterexample", _counterexample(row)),
        ),
        cls="facts",
    )
    body = element("details", text("summary", "evidence") + facts) if facts else ""
    inner = element("div", head, cls="statement-head") + text("p", row.says) + body
    return element("li", inner, id=row.id, cls=_CLASSES[row.verdict])


def _counterexample(row: Statement) -> str:
    if not row.file:
        return ""
    shown = counterexample(row.file)
    lines = shown.splitlines()
    cut = "\n".join([*lines[:12], f"... {len(lines) - 12} lines more"]) if len(lines) > 14 else shown.rstrip("\n")
    name = text("code", f"transcripts/counterexamples/{row.file}")
    run = element("p", "run: " + text("code", row.run)) if row.run else ""
    return name + element("pre", escape(cut), tabindex="0", aria_label=f"the counterexample {row.file}") + run
