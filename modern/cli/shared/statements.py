"""How statements and their verdicts are printed: in full, or summed up by document."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence

from modern.claims.register import CONDITION, DOCUMENTS, FAILS, HOLDS, UNTESTABLE, VERDICTS, Judged
from modern.edition.reproduce import DIFFERENT, EXACT, ORDER

Paint = Callable[[str, str], str]
"""Colours words as a verdict of the given kind."""
Indented = Callable[[str], Iterable[str]]
"""Wraps and indents a line of explanation."""

_WHY = {CONDITION: "condition", HOLDS: "note"}
_STATED_AS = {HOLDS: EXACT, CONDITION: ORDER, FAILS: DIFFERENT, UNTESTABLE: ""}
_PLURAL = {HOLDS: "hold", CONDITION: "with a condition", FAILS: "do not hold", UNTESTABLE: "not testable"}


def theorem_lines(found: Sequence[Judged], paint: Paint, indented: Indented) -> Iterator[str]:
    """The worked examples of chapter 4, claim by claim."""
    for number, judged in enumerate(found):
        row = judged.statement
        if not number or found[number - 1].statement.part != row.part:
            if number:
                yield ""
            pages = sorted(
                {int(page) for one in found if one.statement.part == row.part for page in one.statement.page.split("-")}
            )
            yield f"Theorem {row.part} (p. {pages[0]}-{pages[-1]})"
        yield f"  {paint(str(judged.computed), EXACT if judged.agrees else DIFFERENT):<6} {row.says}"
        yield from indented(judged.message)
    if found:
        yield ""


def statement_lines(found: Sequence[Judged], paint: Paint, indented: Indented) -> Iterator[str]:
    """Statements in full: where it stands, what it says, the verdict, why, and what it rests on."""
    document = ""
    for judged in found:
        row = judged.statement
        if row.document != document:
            document = row.document
            yield f"Statements of {document}"
        yield f"  {row.id} ({row.page}, {row.kind}): {paint(row.verdict, _STATED_AS[row.verdict])}"
        yield from indented(f"{row.says} [{row.words}]")
        if row.why:
            yield from indented(f"{_WHY.get(row.verdict, 'why')}: {row.why}")
        if judged.message:
            yield from indented(judged.message)
        if row.run:
            yield from indented(f"run: {row.run}")
        if not judged.agrees:
            yield from indented(paint(f"BUT the computed verdict is: {judged.computed}", DIFFERENT))
    if found:
        yield ""


def statement_summary(found: Sequence[Judged], paint: Paint, indented: Indented) -> Iterator[str]:
    """How many statements of each document have which verdict, and those that do not hold, by id."""
    yield "Statements"
    for document in DOCUMENTS:
        of = [judged for judged in found if judged.statement.document == document]
        kinds = Counter(judged.statement.verdict for judged in of)
        counted = ", ".join(f"{kinds[kind]} {_PLURAL[kind]}" for kind in VERDICTS if kinds[kind])
        yield f"  {document}: {len(of)}: {counted}"
        failing = [judged.statement.id for judged in of if judged.statement.verdict == FAILS]
        if failing:
            yield from indented(f"do not hold: {', '.join(failing)}")
    for judged in found:
        if not judged.agrees:
            message = f"{judged.statement.id}: computed: {judged.computed}: {judged.message}"
            yield from indented(paint(message, DIFFERENT))
    held = sum(judged.computed is None and judged.statement.verdict != UNTESTABLE for judged in found)
    yield f"  computed just now: {sum(judged.computed is not None for judged in found)}; checked by a test: {held}"
    yield "  in full: hull1620 reproduce DOCUMENT, or a statement's id"
    yield ""
