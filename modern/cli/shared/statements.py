"""Format the statements of the documents and their verdicts as text, in full or as a summary of each document."""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence

from modern.claims.evidence import GRADES
from modern.claims.full import recorded_for
from modern.claims.register import (
    COLUMNS,
    CONDITION,
    DOCUMENTS,
    FAILS,
    HOLDS,
    REPETITION,
    SLIP,
    UNTESTABLE,
    USED,
    Judged,
    column,
    grades,
)
from modern.edition.reproduce import DIFFERENT, EXACT, ORDER

# A function that colours a text in the colour of a kind of verdict.
Paint = Callable[[str, str], str]
# A function that wraps and indents a text.
Indented = Callable[[str], Iterable[str]]

_REASON = {CONDITION: "condition", HOLDS: "note", USED: "note"}
_PAINT_KINDS = {HOLDS: EXACT, CONDITION: ORDER, FAILS: DIFFERENT}
# The words after the number of rows with a verdict: after 1, and after other numbers.
_COUNTED = {
    HOLDS: ("holds", "hold"),
    CONDITION: ("with a condition", "with a condition"),
    FAILS: ("does not hold", "do not hold"),
    SLIP: ("slip", "slips"),
    USED: ("used", "used"),
    UNTESTABLE: ("not testable", "not testable"),
    REPETITION: ("repetition", "repetitions"),
}


def theorem_lines(judgements: Sequence[Judged], paint: Paint, indented: Indented) -> Iterator[str]:
    """Yield the claims of chapter 4 about its worked examples, each with its computed verdict."""
    previous = ""
    for judged in judgements:
        row = judged.statement
        if row.part != previous:
            if previous:
                yield ""
            previous = row.part
            ranges = [
                judged_row.statement.page.split("-")
                for judged_row in judgements
                if judged_row.statement.part == row.part
            ]
            pages = sorted(int(page) for pages in ranges for page in pages)
            yield f"Theorem {row.part} (p. {pages[0]}-{pages[-1]})"
        yield f"  {paint(str(judged.computed), EXACT if judged.agrees else DIFFERENT):<6} {row.says}"
        yield from indented(judged.message)
    if judgements:
        yield ""


def statement_lines(judgements: Sequence[Judged], paint: Paint, indented: Indented) -> Iterator[str]:
    """Yield the full text of each statement: page, words, verdict, reason, and how the verdict was obtained."""
    document = ""
    for judged in judgements:
        row = judged.statement
        if row.document != document:
            document = row.document
            yield f"Statements of {document}"
        grade = "" if row.verdict in (USED, UNTESTABLE) else f", {judged.grade}"
        yield f"  {row.id} ({row.page}, {row.kind}): {paint(row.verdict, _PAINT_KINDS.get(row.verdict, ''))}{grade}"
        yield from indented(f"{row.says} [{row.words}]")
        if row.same:
            yield from indented(f"repeats {row.same}")
        if row.why:
            yield from indented(f"{_REASON.get(row.verdict, 'reason')}: {row.why}")
        if judged.message:
            yield from indented(judged.message)
        for check in judged.checks:
            if (description := check.evidence.describe()) != "exhibited":
                yield from indented(description)
        for full in recorded_for(row.same or row.id):
            yield from indented(f"full search: {int(full.cases):,} cases, seed {full.seed}: {full.result}")
        if row.run:
            yield from indented(f"run: {row.run}")
        if not judged.agrees:
            yield from indented(paint(f"BUT the computed verdict is: {judged.computed}", DIFFERENT))
    if judgements:
        yield ""


def statement_summary(judgements: Sequence[Judged], paint: Paint, indented: Indented) -> Iterator[str]:
    """Yield the numbers of statements by document, verdict and grade, and the ids of those that do not hold."""
    yield "Statements"
    for document in DOCUMENTS:
        rows = [judged for judged in judgements if judged.statement.document == document]
        kinds = Counter(column(judged.statement) for judged in rows)
        counted = ", ".join(f"{kinds[kind]} {_COUNTED[kind][kinds[kind] != 1]}" for kind in COLUMNS if kinds[kind])
        yield f"  {document}: {len(rows)}: {counted}"
        graded = grades(rows)
        yield from indented(f"of those that hold: {', '.join(f'{graded[g]} {g}' for g in GRADES if graded[g])}")
        failing = [judged.statement.id for judged in rows if column(judged.statement) == FAILS]
        if failing:
            yield from indented(f"{_COUNTED[FAILS][len(failing) != 1]}: {', '.join(failing)}")
    for judged in judgements:
        if not judged.agrees:
            message = f"{judged.statement.id}: computed: {judged.computed}: {judged.message}"
            yield from indented(paint(message, DIFFERENT))
    yield f"  verdicts computed in this run: {sum(judged.computed is not None for judged in judgements)}"
    yield "  details: hull1620 reproduce DOCUMENT, or the id of a statement"
    yield ""
