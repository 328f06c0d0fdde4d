"""The statements of a document: for each statement its page, the words of the document, the verdict and the evidence.

The page contains all statements. The script ``data.js`` hides those that the reader deselects.
"""

from modern.claims.full import FullSearch, recorded_for
from modern.claims.register import COLUMNS, DOCUMENTS, UNTESTABLE, USED, Judged, Statement, column, counts, judged
from modern.claims.sampled_sets import counterexample
from modern.publication.site.made import Part, one_of, slug
from modern.publication.site.markup import definitions, details, element, escape, lowered, preformatted, run_link, text
from modern.study.report import raised

# The sign and the CSS class of each column of the counts.
SIGNS = dict(zip(COLUMNS, ("\u2713", "(\u2713)", "\u2717", "\u2248", "=", "\u2013", "\u2191"), strict=True))
_CLASSES = dict(zip(COLUMNS, ("holds", "condition", "fails", "slip", "used", "untested", "repetition"), strict=True))


def make(argument: str) -> list[Part]:
    """Return the statements of a document, with a section for each page."""
    name = one_of(argument, DOCUMENTS)
    parts = [Part(html=_controls(name))]
    rows_of: dict[str, list[Judged]] = {}
    for judgement in judged(name):
        rows_of.setdefault(judgement.statement.page, []).append(judgement)
    for page, rows_of_page in rows_of.items():
        title = _title(name, page)
        html = element("ol", "".join(map(_statement, rows_of_page)), cls="statements")
        parts.append(Part(title, slug("page", page), html=html))
    return parts


def _title(document: str, page: str) -> str:
    """Return the heading for a page of the thesis, or for a section or figure of one of the papers."""
    if page[:1].isdigit():
        return f"Page {page}" if document == "thesis" else f"Section {page}"
    return "Appendix" if page == "A" else page[:1].upper() + page[1:]


def _controls(document: str) -> str:
    numbers = counts(document)
    boxes = ""
    for name in COLUMNS:
        box = element("input", type="checkbox", value=_CLASSES[name], name="verdict", checked=True)
        boxes += element("label", box + escape(f" {SIGNS[name]} {name}: {numbers[name]}"))
    field = element("label", "Containing " + element("input", type="search", name="words", autocomplete="off"))
    button = text("button", "Show", type="submit")
    shown = text("output", "", cls="shown")
    inner = element("fieldset", text("legend", "Verdicts shown") + boxes) + element("p", f"{field} {button} {shown}")
    return element("form", inner, cls="controls filter", aria_label="Filter of the statements", hidden=True)


def _statement(judgement: Judged) -> str:
    row, name = judgement.statement, column(judgement.statement)
    head = text("a", row.id, href=f"#{row.id}", cls="place")
    sign = element("span", escape(SIGNS[name]), aria_hidden="true")
    head += element("span", sign + " " + text("strong", row.verdict), cls=f"verdict v-{_CLASSES[name]}")
    grade = "" if row.verdict in (USED, UNTESTABLE) else f"{judgement.grade}, "
    head += text("span", grade + row.kind, cls="quiet")
    facts = definitions(
        (
            ("quotation", text("q", row.words) if row.words else ""),
            ("repeats", text("a", row.same, href=f"#{row.same}") if row.same else ""),
            ("reason", escape(row.why)),
            ("check", escape(judgement.message)),
            ("evidence", "<br>".join(escape(check.evidence.describe()) for check in judgement.checks)),
            ("full search", "<br>".join(_full(result) for result in recorded_for(row.same or row.id))),
            ("counterexample", _counterexample(row)),
        ),
        cls="facts",
    )
    body = details("evidence", facts) if facts else ""
    inner = element("div", head, cls="statement-head") + element("p", lowered(raised(row.says))) + body
    return element("li", inner, id=row.id, cls=_CLASSES[name])


def _full(search: FullSearch) -> str:
    return escape(f"{int(search.cases):,} cases of {search.generator}, seed {search.seed}: {search.result}")


def _counterexample(row: Statement) -> str:
    if not row.file:
        return ""
    content = counterexample(row.file)
    lines = content.splitlines()
    excerpt = "\n".join([*lines[:12], f"... {len(lines) - 12} more lines"]) if len(lines) > 14 else content.rstrip("\n")
    name = text("code", f"transcripts/counterexamples/{row.file}")
    run = element("p", "Command: " + text("code", row.run)) if row.run else ""
    if row.file.endswith(".deck"):
        deck = f"counterexamples/{row.file.removesuffix('.deck')}"
        run += element("p", run_link("program1", deck, "Run it in the emulator", next="1"))
    return name + preformatted(excerpt, f"the counterexample {row.file}") + run
