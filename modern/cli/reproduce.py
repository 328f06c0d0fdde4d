"""``hull1620 reproduce``: compute the printed results, check the statements of the documents, and give verdicts."""

import argparse
import os
import shutil
import sys
import textwrap
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from functools import partial
from itertools import zip_longest

from emulator.errors import quoted
from emulator.machine.endings import Ending
from modern.claims.published import CANNOT, CORRECTED, EXPLAINED, PAPERS, Finding, Paper, findings
from modern.claims.register import DOCUMENTS, THESIS, Judged, Judgements, Statement, judge, statements_of
from modern.cli.shared.console import DIFFERS, OK, UsageError, misses_numpy, report_stream, write_json
from modern.cli.shared.side_by_side import side_by_side
from modern.cli.shared.statements import Indented, Paint, statement_lines, statement_summary, theorem_lines
from modern.edition.chapter4 import THEOREMS
from modern.edition.chapter6 import EXAMPLES
from modern.edition.reproduce import DIFFERENT, EXACT, ORDER, SPACING, Part, Report, Verdict, reproduce, summary

_STATES = {"examples": "as the examples were run (program1_examples.f)", "listing": "as listed (program1.f)"}
_COLOURS = {EXACT: "32", SPACING: "33", ORDER: "33", DIFFERENT: "31"}
_PARTS: dict[Part, str] = {
    "points": "points",
    "inside": "inside points",
    "boundary": "boundary points",
    "vertices": "vertices",
    "equations": "equations, up to a factor",
}
_REASON_FOR_ORDER = (
    "the listing moves the extreme points to positions 1 and 2 and then finds the farthest third point; the examples "
    "were printed by an earlier state of program 1, which moved the six extreme points to the front; cards from "
    "program 1 may therefore contain another first tetrahedron"
)
_PAINT_KINDS = {EXACT: EXACT, CORRECTED: EXACT, EXPLAINED: ORDER, CANNOT: "", DIFFERENT: DIFFERENT}
_MOST_LINES = 4
# The first words of the last line: if all results agree, and if one does not.
_OVERALL = ("Every", "NOT every")
# The function side_by_side with the width and the colours of the output.
Compare = Callable[..., Iterator[str]]


def main(args: argparse.Namespace) -> int:
    requested = list(dict.fromkeys(args.examples))
    names = [name for text in requested for name in _results_named(text)] if requested else _all_results()
    examples = [number for number in EXAMPLES if str(number) in names]
    colour = sys.stdout.isatty() and "NO_COLOR" not in os.environ
    out = report_stream(args)
    reports: list[Report] = []
    width = shutil.get_terminal_size((100, 24)).columns
    paint, indented = partial(_paint, colour=colour), partial(_indented, width=width)
    compare = partial(side_by_side, width=width, paint=partial(_paint, kind=DIFFERENT, colour=colour))
    for example in examples:
        new_reports = list(reproduce((example,)))
        reports.extend(new_reports)
        for line in _example_lines(example, new_reports, paint, indented, compare, args.show):
            print(line, file=out)
    results = Judgements(reports)
    parts = {name for name in THEOREMS if name in names}
    left_out: list[str] = []
    skipping = partial(_skipping, left_out, bool(requested))
    theorems: list[Judged] = []
    with skipping("theorems"):
        theorems = [judge(row, results) for row in statements_of(THESIS) if row.part in parts] if parts else []
    for line in theorem_lines(theorems, paint, indented):
        print(line, file=out)
    findings_of_papers: list[Finding] = []
    for paper in (paper for paper in PAPERS if paper.name in names):
        with skipping(paper.name):
            paper_findings = list(findings(paper))
            findings_of_papers += paper_findings
            for line in _finding_lines(paper, paper_findings, paint, indented, compare, args.show):
                print(line, file=out)
    results.add_findings(findings_of_papers)
    known = {judged.statement.id: judged for judged in theorems}
    stated: list[Judged] = []
    with skipping("statements"):
        stated = [known.get(row.id) or judge(row, results) for row in _statements(requested)]
    lines = statement_lines if requested or not stated else statement_summary
    for line in lines(stated, paint, indented):
        print(line, file=out)
    all_agree, *_ = summary(reports)
    all_agree = all_agree and all(judged.agrees for judged in (*theorems, *stated))
    all_agree = all_agree and all(finding.holds for finding in findings_of_papers)
    for line in _summary_lines(reports, theorems, findings_of_papers, all_agree, left_out):
        kind = (EXACT if all_agree else DIFFERENT) if line.startswith(_OVERALL) else ""
        for part in textwrap.wrap(line, max(40, width)):
            print(paint(part, kind), file=out)
    write_json(args, {**_document(reports, theorems, stated, findings_of_papers, all_agree), "left_out": left_out})
    return OK if all_agree else DIFFERS


@contextmanager
def _skipping(left_out: list[str], is_requested: bool, name: str) -> Iterator[None]:
    """Append ``name`` to ``left_out`` if the ``with`` block fails because numpy is missing.

    If the user has requested the result by name, raise the error instead.
    """
    try:
        yield
    except ModuleNotFoundError as error:
        if is_requested or not misses_numpy(error):
            raise
        left_out.append(name)


def _all_results() -> list[str]:
    return [*map(str, EXAMPLES), *THEOREMS, *(paper.name for paper in PAPERS)]


def _results_named(text: str) -> list[str]:
    """Return the printed results that an argument names, or an empty list if the argument names only statements.

    Raise UsageError for an unknown name.
    """
    if text == THESIS:
        return [*map(str, EXAMPLES), *THEOREMS]
    if text in _all_results():
        return [text]
    if text not in DOCUMENTS and not any(row.id == text for row in _statements([text])):
        raise UsageError(
            f"reproduce: unknown name {quoted(text)}; expected the number of an example (1 to {EXAMPLES[-1]}), "
            f"a theorem ({', '.join(THEOREMS)}), a document ({', '.join(DOCUMENTS)}) or the id of a statement"
        )
    return []


def _statements(names: Sequence[str]) -> list[Statement]:
    """Return the statements of the named documents and those named by id, or all statements if there are no names."""
    documents = {name.partition(".")[0] for name in names} if names else set(DOCUMENTS)
    rows = [row for name in DOCUMENTS if name in documents for row in statements_of(name)]
    return [row for row in rows if row.document in names or row.id in names] if names else rows


def _example_lines(
    example: int, reports: Iterable[Report], paint: Paint, indented: Indented, compare: Compare, show: bool
) -> Iterator[str]:
    yield f"Example {example}"
    state = ""
    is_explained = False
    for report in reports:
        if report.state != state:
            state = report.state
            yield f"  program 1 {_STATES[state]}"
        verdict = report.verdict
        name = f"program {report.program} {'cards' if report.device == 'punch' else 'typed'}"
        yield f"    {name:<16} {paint(verdict.kind, verdict.kind)}"
        yield from indented(_evidence(report))
        if verdict.kind == ORDER:
            reason = "order: as above" if is_explained else _REASON_FOR_ORDER
            yield from indented(f"{_same(verdict)}; {reason}")
            is_explained = True
        ending = _ending(report)
        if ending:
            yield from indented(ending)
        if show or verdict.kind in (DIFFERENT, SPACING):
            heads = ("stated" if report.stated else "print", "result")
            yield from compare(report.printed, report.produced, heads=heads)
    yield ""


def _same(verdict: Verdict) -> str:
    """Return a text with the numbers of points and planes if only their order differs from the print, else ""."""
    counted = ", ".join(f"{count} {_PARTS[part]}" for part, count in verdict.same)
    return f"the same {counted}" if counted else ""


def _ending(report: Report) -> str:
    """Return a message about how the program ended, or an empty string if it ended normally."""
    if report.ending is None:
        return "the program was not reached"
    return report.ending.message if isinstance(report.ending, Ending) else str(report.ending)


def _evidence(report: Report) -> str:
    verdict = report.verdict
    if report.stated:
        if not report.printed:
            return "nothing is typed (stated in chapter 5; chapter 6 prints no typed lines)"
        return f"{' / '.join(report.printed)} (stated in chapter 5; chapter 6 prints no typed lines)"
    return (
        f"printed: {verdict.numbers} numbers and {verdict.words} words on {verdict.cards} cards; "
        f"inferred from the FORMATs: columns and {verdict.blank} blank cards"
    )


def _summary_lines(
    reports: list[Report],
    theorems: list[Judged],
    paper_findings: list[Finding],
    all_agree: bool,
    left_out: Sequence[str],
) -> Iterator[str]:
    punched = [r for r in reports if r.device == "punch" and r.state == "examples"]
    listed = [r for r in reports if r.device == "punch" and r.state == "listing"]
    if punched:
        verdicts = [r.verdict for r in punched]
        exact = [verdict for verdict in verdicts if verdict.kind == EXACT]
        cards, all_cards = (sum(v.cards + v.blank for v in part) for part in (exact, verdicts))
        numbers = sum(verdict.numbers for verdict in exact)
        counts = (
            f"{len(exact)} of {len(punched)} printed results exact, {cards} of {all_cards} cards, {numbers} numbers"
        )
        kinds = Counter(r.verdict.kind for r in listed)
        parts = ", ".join(f"{kinds[k]} {k}" for k in (EXACT, ORDER, SPACING, DIFFERENT) if kinds[k])
        yield f"Printed results with the listing of program 1: {parts}."
        yield f"With program 1 in the state that was rebuilt from these results: {counts}."
    if theorems:
        yield f"Chapter 4: {sum(judged.agrees for judged in theorems)} of {len(theorems)} verdicts are as recorded."
    if paper_findings:
        yield _finding_summary(paper_findings)
    if left_out:
        yield f"Left out, because numpy is not installed: {', '.join(left_out)}."
    has_results = reports or theorems or paper_findings
    verdict = "printed result is reproduced" if has_results else "statement has its recorded verdict"
    has_exceptions = all_agree and any(finding.excused for finding in paper_findings)
    exceptions = ", or a reason is given why it cannot be reproduced" if has_exceptions else ""
    yield f"{_OVERALL[not all_agree]} {'other ' if left_out else ''}{verdict}{exceptions}."


def _paint(text: str, kind: str, colour: bool) -> str:
    return f"\x1b[{_COLOURS[kind]}m{text}\x1b[0m" if colour and kind else text


def _indented(text: str, width: int) -> list[str]:
    return textwrap.wrap(
        text, max(40, width), initial_indent="      ", subsequent_indent="      ", break_on_hyphens=False
    )


def _document(
    reports: list[Report],
    theorems: list[Judged],
    stated: list[Judged],
    paper_findings: list[Finding],
    all_agree: bool,
) -> dict[str, object]:
    return {
        "reproduced": all_agree,
        "papers": _finding_document(paper_findings),
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
            {
                **asdict(judged.statement),
                "found": judged.computed,
                "grade": judged.grade,
                "seen": judged.message,
                "evidence": [asdict(check.evidence) for check in judged.checks],
                "agrees": judged.agrees,
            }
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
                "reason": _REASON_FOR_ORDER if report.verdict.kind == ORDER else "",
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


def _finding_lines(
    paper: Paper,
    paper_findings: Sequence[Finding],
    paint: Paint,
    indented: Indented,
    compare: Compare,
    show: bool,
) -> Iterator[str]:
    """Yield the verdicts on a paper's results.

    show: True to show each printed result next to the computed one, False to show only the lines that differ.
    """
    yield paper.title
    for finding in paper_findings:
        result = finding.result
        yield f"  {result.place}: {paint(finding.kind, _PAINT_KINDS[finding.kind])}"
        yield from indented(result.says)
        if finding.excused:
            yield from indented(result.cannot or result.differs)
        if finding.kind == CORRECTED:
            rows = ", ".join(f"{row.id} ({row.kind})" for row in result.rows)
            yield from indented(f"the printed result was corrected by {rows}")
        if show and finding.produced:
            yield from compare(result.printed, finding.produced, heads=("print", "computed"), columns=False)
        elif not show and finding.kind in (EXPLAINED, DIFFERENT):
            yield from _finding_differences(finding, indented)
    yield ""


def _finding_summary(paper_findings: Iterable[Finding]) -> str:
    kinds = Counter(finding.kind for finding in paper_findings)
    parts = [f"{kinds[kind]} {kind}" for kind in (EXACT, CORRECTED, EXPLAINED, CANNOT, DIFFERENT) if kinds[kind]]
    return f"Later papers: {', '.join(parts)}."


def _finding_document(paper_findings: Iterable[Finding]) -> list[dict[str, object]]:
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
        for finding in paper_findings
    ]


def _finding_differences(finding: Finding, indented: Indented) -> Iterator[str]:
    printed, produced = finding.result.corrected, finding.produced
    pairs = zip_longest(printed, produced, fillvalue="(nothing)")
    different = [pair for pair in pairs if pair[0].split() != pair[1].split()]
    for printed_line, computed_line in different[:_MOST_LINES]:
        yield from indented(f"printed {printed_line.strip()}; computed {computed_line.strip()}")
    if len(different) > _MOST_LINES:
        yield from indented(f"and {len(different) - _MOST_LINES} more lines")
