"""The statements of a document: for each statement its page, its words, the verdict and the evidence.

The page contains all statements.  The script ``data.js`` hides those that the reader's choice excludes.
"""

from __future__ import annotations

from collections import Counter

from modern.claims.register import DOCUMENTS, VERDICTS, Statement, Verdict, counterexample, statements_of
from modern.publication.site.made import Made, Part, Target, one_of, slug
from modern.publication.site.markup import definitions, details, element, escape, preformatted, text

SIGNS: dict[Verdict, str] = {
    "holds": "\u2713",
    "holds with a condition": "(\u2713)",
    "does not hold": "\u2717",
    "not testable": "\u2013",
}
_CLASSES = dict(zip(SIGNS, ("holds", "condition", "fails", "untested"), strict=True))


def make(argument: str) -> Made:
    """Return the statements of a document, page by page."""
    name = one_of(argument, DOCUMENTS)
    rows = statements_of(name)
    parts = [Part(html=_controls(rows))]
    rows_of: dict[str, list[Statement]] = {}
    for row in rows:
        rows_of.setdefault(row.page, []).append(row)
    for page, rows_of_page in rows_of.items():
        title = f"Page {page}" if page[:1].isdigit() else page.capitalize()
        html = element("ol", "".join(map(_statement, rows_of_page)), cls="statements")
        parts.append(Part(title, slug("page", page), html=html))
    targets = [Target(row.id, row.id, f"statement {row.id}") for row in rows]
    return Made(tuple(parts), tuple(targets))


def _controls(rows: tuple[Statement, ...]) -> str:
    """Return the form that chooses the statements shown, with the number of statements for each verdict."""
    counts = Counter(row.verdict for row in rows)
    boxes = ""
    for verdict in VERDICTS:
        box = element("input", type="checkbox", value=_CLASSES[verdict], name="verdict", checked=True)
        boxes += element("label", box + escape(f" {SIGNS[verdict]} {verdict}: {counts[verdict]}"))
    field = element("label", "Text: " + element("input", type="search", name="words", autocomplete="off"))
    button = text("button", "Show", type="submit")
    shown = text("output", "", cls="shown")
    inner = element("fieldset", text("legend", "Verdicts shown") + boxes) + element("p", f"{field} {button} {shown}")
    return element("form", inner, cls="controls filter", aria_label="Filter of the statements", hidden=True)


def _statement(row: Statement) -> str:
    head = text("a", row.id, href=f"#{row.id}", cls="place")
    sign = element("span", escape(SIGNS[row.verdict]), aria_hidden="true")
    head += element("span", sign + " " + text("strong", row.verdict), cls=f"verdict v-{_CLASSES[row.verdict]}")
    head += text("span", row.kind, cls="quiet")
    facts = definitions(
        (
            ("quotation", text("q", row.words) if row.words else ""),
            ("reason", escape(row.why)),
            ("check", text("code", row.claim) if row.claim else ""),
            ("results", escape(", ".join(row.results))),
            ("tests", "<br>".join(text("code", name) for name in row.tests)),
            ("counterexample", _counterexample(row)),
        ),
        cls="facts",
    )
    body = details("evidence", facts) if facts else ""
    inner = element("div", head, cls="statement-head") + text("p", row.says) + body
    return element("li", inner, id=row.id, cls=_CLASSES[row.verdict])


def _counterexample(row: Statement) -> str:
    if not row.file:
        return ""
    content = counterexample(row.file)
    lines = content.splitlines()
    excerpt = "\n".join([*lines[:12], f"... {len(lines) - 12} more lines"]) if len(lines) > 14 else content.rstrip("\n")
    name = text("code", f"transcripts/counterexamples/{row.file}")
    run = element("p", "Command: " + text("code", row.run)) if row.run else ""
    return name + preformatted(excerpt, f"the counterexample {row.file}") + run
