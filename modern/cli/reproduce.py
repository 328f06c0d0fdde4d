"""``hull1620 reproduce``: what the thesis and the later papers print and state, computed, with a verdict on each."""

from __future__ import annotations

import argparse
import json
import os
import shutil
import sys
import textwrap
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import asdict
from functools import partial
from typing import TextIO

from emulator.files import check_writable, write_text
from emulator.machine.endings import Ending
from modern.claims.published import CANNOT, CORRECTED, EXPLAINED, PAPERS, Finding, Paper, findings
from modern.claims.register import DOCUMENTS, THESIS, Judged, Judgements, Statement, judge, statements_of
from modern.cli.shared.beside import beside
from modern.cli.shared.console import DIFFERS, OK, UsageError
from modern.cli.shared.statements import Indented, Paint, statement_lines, statement_summary, theorem_lines
from modern.edition.chapter4 import THEOREMS
from modern.edition.chapter6 import EXAMPLES
from modern.edition.reproduce import DIFFERENT, EXACT, ORDER, SPACING, Part, Report, Verdict, reproduce, summary

_STATES = {"examples": "as the examples were run (program1_examples.f)", "listing": "as listed (program1.f)"}
_COLOURS = {EXACT: "32", SPACING: "33", ORDER: "33", DIFFERENT: "31"}
_MOST_DIFFERENCES = 8
_PARTS: dict[Part, str] = {
    "points": "points",
    "inside": "inside points",
    "boundary": "boundary points",
    "vertices": "vertices",
    "equations": "equations, up to a factor",
}
_WHY_ORDER = (
    "the listing swaps the extreme points into places 1 and 2 and looks for the farthest third; the examples were "
    "printed by an earlier state of program 1, which put the six extremes in front"
)


_PAINTED_AS = {EXACT: EXACT, CORRECTED: EXACT, EXPLAINED: ORDER, CANNOT: "", DIFFERENT: DIFFERENT}
_MOST_LINES = 4
_EVERY = ("Every", "NOT every")
"""How the verdict on everything begins."""


def main(args: argparse.Namespace) -> int:
    """Run the examples, print the verdicts, write them as JSON if asked."""
    asked = list(dict.fromkeys(args.examples))
    named = [*_names()] if not asked else [name for text in asked for name in _meant(text)]
    examples = [number for number in EXAMPLES if str(number) in named]
    check_writable(args.json)
    colour = sys.stdout.isatty() and "NO_COLOR" not in os.environ
    # A JSON document on standard output must be alone there.
    out = sys.stderr if args.json == "-" else sys.stdout
    reports: list[Report] = []
    width = shutil.get_terminal_size((100, 24)).columns
    paint, indented = partial(_paint, colour=colour), partial(_indented, width=width)
    for example in examples:
        found = list(reproduce((example,)))
        reports.extend(found)
        for line in _example_lines(example, found, colour, width, args.show):
            print(line, file=out)
    results = Judgements(reports)
    parts = {name for name in THEOREMS if name in named}
    theorems = [judge(row, results) for row in statements_of(THESIS) if row.part in parts] if parts else []
    for line in theorem_lines(theorems, paint, indented):
        print(line, file=out)
    found_results = list(_papers(named, colour, width, out, args.show))
    results.add_findings(found_results)
    known = {judged.statement.id: judged for judged in theorems}
    stated = [known.get(row.id) or judge(row, results) for row in _rows(asked)]
    for line in statement_lines(stated, paint, indented) if asked else statement_summary(stated, paint, indented):
        print(line, file=out)
    good, *_ = summary(reports)
    good = good and all(judged.agrees for judged in (*theorems, *stated)) and all(f.holds for f in found_results)
    for line in _summary_lines(reports, theorems, found_results, good):
        kind = (EXACT if good else DIFFERENT) if line.startswith(_EVERY) else ""
        for part in textwrap.wrap(line, max(40, width)):
            print(_paint(part, kind, colour), file=out)
    if args.json is not None:
        write_text(args.json, json.dumps(_document(reports, theorems, stated, found_results, good), indent=1) + "\n")
    return OK if good else DIFFERS


def _names() -> list[str]:
    return [*map(str, EXAMPLES), *THEOREMS, *(paper.name for paper in PAPERS)]


def _meant(text: str) -> list[str]:
    """The results that a name stands for: all of the thesis's, none of a paper that prints none or of a statement.

    Raises UsageError for a name that is not one.
    """
    if text == THESIS:
        return [*map(str, EXAMPLES), *THEOREMS]
    if text in _names():
        return [text]
    if text not in DOCUMENTS and not any(row.id == text for row in _rows([text])):
        raise UsageError(
            f"reproduce: there is no example {text!r}; chapter 6 has 1 to {EXAMPLES[-1]}, "
            f"chapter 4 {', '.join(THEOREMS)}, the documents are {', '.join(DOCUMENTS)}; statements have ids"
        )
    return []


def _rows(asked: Sequence[str]) -> list[Statement]:
    """The statements of the documents asked for, and those asked for by id; all where nothing is asked for."""
    documents = {text.partition(".")[0] for text in asked} if asked else set(DOCUMENTS)
    rows = [row for name in DOCUMENTS if name in documents for row in statements_of(name)]
    return [row for row in rows if row.document in asked or row.id in asked] if asked else rows


def _papers(names: Sequence[str], colour: bool, width: int, out: TextIO, show: bool) -> Iterator[Finding]:
    """The verdicts on the papers named, each paper printed when it is judged."""
    for paper in PAPERS:
        if paper.name in names:
            found = list(findings(paper))
            paint = partial(_paint, colour=colour)
            beside_it = partial(_printed_beside, colour=colour, width=width) if show else None
            for line in _finding_lines(paper, found, paint, partial(_indented, width=width), beside_it):
                print(line, file=out)
            yield from found


def _example_lines(
    example: int, reports: Iterable[Report], colour: bool, width: int, show: bool = False
) -> Iterator[str]:
    yield f"Example {example}"
    state = ""
    explained = False
    for report in reports:
        if report.state != state:
            state = report.state
            yield f"  program 1 {_STATES[state]}"
        verdict = report.verdict
        name = f"program {report.program} {'cards' if report.device == 'punch' else 'typed'}"
        yield f"    {name:<16} {_paint(verdict.kind, verdict.kind, colour)}"
        yield from _indented(_evidence(report), width)
        if verdict.kind == ORDER:
            yield from _indented(f"{_same(verdict)}; {'order: as above' if explained else _WHY_ORDER}", width)
            explained = True
        ending = _ending(report)
        if ending:
            yield from _indented(ending, width)
        if show:
            marks = partial(_paint, kind=DIFFERENT, colour=colour)
            heads = ("stated" if report.stated else "print", "result")
            yield from beside(report.printed, report.produced, width, heads=heads, paint=marks)
        elif verdict.kind in (DIFFERENT, SPACING):
            yield from _differences(report, width)
    yield ""


def _same(verdict: Verdict) -> str:
    """What agrees where the order differs; empty of any other verdict."""
    counted = ", ".join(f"{count} {_PARTS[part]}" for part, count in verdict.same)
    return f"the same {counted}" if counted else ""


def _ending(report: Report) -> str:
    """Why the program did not end as it should; empty where it did."""
    if report.ending is None:
        return "the program was not reached"
    return report.ending.message if isinstance(report.ending, Ending) else str(report.ending)


def _evidence(report: Report) -> str:
    verdict = report.verdict
    if report.stated:
        if not report.printed:
            return "nothing is typed (stated in chapter 5; chapter 6 prints no typewriter)"
        return f"{' / '.join(report.printed)} (stated in chapter 5; chapter 6 prints no typewriter)"
    return (
        f"print: {verdict.numbers} numbers and {verdict.words} words on {verdict.cards} cards; "
        f"from the FORMATs: columns and {verdict.blank} blank cards"
    )


def _differences(report: Report, width: int) -> Iterator[str]:
    differences = report.verdict.differences
    half = max(24, (width - 14) // 2)
    side_by_side = all(len(a) <= half and len(b) <= half for _, a, b in differences[:_MOST_DIFFERENCES])
    if side_by_side:
        yield f"      {'card':>4}  {'printed':<{half}} produced"
    for number, printed, produced in differences[:_MOST_DIFFERENCES]:
        if side_by_side:
            yield f"      {number:>4}  {printed:<{half}} {produced}".rstrip()
        else:
            yield f"      {number:>4}  printed   {printed}"
            yield f"            produced  {produced}"
    if len(differences) > _MOST_DIFFERENCES:
        yield f"      and {len(differences) - _MOST_DIFFERENCES} more"


def _summary_lines(reports: list[Report], theorems: list[Judged], found: list[Finding], good: bool) -> Iterator[str]:
    punched = [r for r in reports if r.device == "punch" and r.state == "examples"]
    listed = [r for r in reports if r.device == "punch" and r.state == "listing"]
    if punched:
        done = [r.verdict for r in punched if r.verdict.kind == EXACT]
        cards, of = (sum(v.cards + v.blank for v in part) for part in (done, [r.verdict for r in punched]))
        numbers = sum(verdict.numbers for verdict in done)
        exact = f"{len(done)} of {len(punched)} printed results exact, {cards} of {of} cards, {numbers} numbers"
        yield f"As the examples were run: {exact}."
        kinds = Counter(r.verdict.kind for r in listed)
        yield f"As listed: {', '.join(f'{kinds[k]} {k}' for k in (EXACT, ORDER, SPACING, DIFFERENT) if kinds[k])}."
    if theorems:
        yield f"Chapter 4: {sum(judged.agrees for judged in theorems)} of {len(theorems)} claims hold."
    if found:
        yield _finding_summary(found)
    what = "printed result comes out" if reports or theorems or found else "statement has the verdict of its row"
    words = f"{_EVERY[0]} {what}" if good else f"{_EVERY[1]} {what}"
    words += ", or it is said why it does not." if good and any(finding.excused for finding in found) else "."
    yield words


def _paint(text: str, kind: str, colour: bool) -> str:
    return f"\x1b[{_COLOURS[kind]}m{text}\x1b[0m" if colour and kind else text


def _indented(text: str, width: int) -> list[str]:
    return textwrap.wrap(text, max(40, width), initial_indent="      ", subsequent_indent="      ")


def _document(
    reports: list[Report], theorems: list[Judged], stated: list[Judged], found: list[Finding], good: bool
) -> dict[str, object]:
    return {
        "reproduced": good,
        "papers": _finding_document(found),
        "theorems": [
            {
                "theorem": judged.statement.part,
                "pages": judged.statement.page,
                "claim": judged.statement.says,
                "holds": judged.agrees,
                "seen": judged.message,
            }
            for judged in theorems
        ],
        "statements": [
            {**asdict(judged.statement), "found": judged.computed, "seen": judged.message, "agrees": judged.agrees}
            for judged in stated
        ],
        "results": [
            {
                "example": report.example,
                "state": report.state,
                "deck": report.deck,
                "program": report.program,
                "device": report.device,
                "evidence": "stated in chapter 5" if report.stated else "printed in chapter 6",
                "verdict": report.verdict.kind,
                "same": _same(report.verdict),
                "reason": _WHY_ORDER if report.verdict.kind == ORDER else "",
                "ending": _ending(report),
                "proved_by_print": {
                    "numbers": report.verdict.numbers,
                    "words": report.verdict.words,
                    "cards": report.verdict.cards,
                },
                "from_formats": {"blank_cards": report.verdict.blank, "columns": True},
                "printed": list(report.printed),
                "produced": list(report.produced),
                "differences": [{"card": n, "printed": a, "produced": b} for n, a, b in report.verdict.differences],
            }
            for report in reports
        ],
    }


def _printed_beside(finding: Finding, colour: bool, width: int) -> Iterator[str]:
    """A paper's result as it is printed beside what is computed; nothing where nothing can be computed."""
    marks = partial(_paint, kind=DIFFERENT, colour=colour)
    heads = ("print", "computed")
    if finding.produced:
        yield from beside(finding.result.printed, finding.produced, width, heads=heads, columns=False, paint=marks)


def _finding_lines(
    paper: Paper,
    found: Sequence[Finding],
    paint: Paint,
    indented: Indented,
    beside_it: Callable[[Finding], Iterable[str]] | None = None,
) -> Iterator[str]:
    """A paper's verdicts: a line a result, with what was printed where they differ, or beside every one."""
    yield paper.title
    for finding in found:
        result = finding.result
        word = paint(finding.kind, _PAINTED_AS[finding.kind])
        yield f"  {result.place}: {word}"
        yield from indented(result.says)
        if finding.excused:
            yield from indented(result.cannot or result.differs)
        if finding.kind == CORRECTED:
            rows = ", ".join(f"{row.id} ({row.kind})" for row in result.rows)
            yield from indented(f"the print corrected by {rows}")
        if beside_it is not None:
            yield from beside_it(finding)
        elif finding.kind in (EXPLAINED, DIFFERENT):
            yield from _finding_differences(finding, indented)
    yield ""


def _finding_summary(found: Iterable[Finding]) -> str:
    """How many results of the papers have which verdict."""
    kinds = Counter(finding.kind for finding in found)
    parts = [f"{kinds[kind]} {kind}" for kind in (EXACT, CORRECTED, EXPLAINED, CANNOT, DIFFERENT) if kinds[kind]]
    return f"Later papers: {', '.join(parts)}."


def _finding_document(found: Iterable[Finding]) -> list[dict[str, object]]:
    """The verdicts as plain data."""
    return [
        {
            "paper": finding.paper,
            "result": finding.result.id,
            "place": finding.result.place,
            "says": finding.result.says,
            "verdict": finding.kind,
            "reason": finding.result.cannot or finding.result.differs,
            "rows": [row.id for row in finding.result.rows],
            "printed": list(finding.result.printed),
            "corrected": list(finding.result.corrected),
            "produced": list(finding.produced),
        }
        for finding in found
    ]


def _finding_differences(finding: Finding, indented: Indented) -> Iterator[str]:
    printed, produced = finding.result.corrected, finding.produced
    longest = max(len(printed), len(produced))
    pairs = [
        (printed[i] if i < len(printed) else "(nothing)", produced[i] if i < len(produced) else "(nothing)")
        for i in range(longest)
    ]
    different = [pair for pair in pairs if pair[0].split() != pair[1].split()]
    for one, other in different[:_MOST_LINES]:
        yield from indented(f"printed {one.strip()}; computed {other.strip()}")
    if len(different) > _MOST_LINES:
        yield from indented(f"and {len(different) - _MOST_LINES} more lines")
