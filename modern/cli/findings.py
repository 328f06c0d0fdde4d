"""The lines of ``hull1620 reproduce`` for the results the later papers print."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence

from modern.edition.published import CANNOT, CORRECTED, EXPLAINED, Finding, Paper
from modern.edition.reproduce import DIFFERENT, EXACT, ORDER

_PAINTED_AS = {EXACT: EXACT, CORRECTED: EXACT, EXPLAINED: ORDER, CANNOT: "", DIFFERENT: DIFFERENT}
_MOST_DIFFERENCES = 4

Paint = Callable[[str, str], str]
"""Colours words as a verdict of the given kind."""

Indented = Callable[[str], Iterable[str]]
"""Wraps and indents a line of explanation."""


def finding_lines(paper: Paper, found: Sequence[Finding], paint: Paint, indented: Indented) -> Iterator[str]:
    """A paper's verdicts: a line a result, with what was printed where they differ."""
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
        if finding.kind in (EXPLAINED, DIFFERENT):
            yield from _differences(finding, indented)
    yield ""


def finding_summary(found: Iterable[Finding]) -> str:
    """How many results of the papers have which verdict."""
    kinds = Counter(finding.kind for finding in found)
    parts = [f"{kinds[kind]} {kind}" for kind in (EXACT, CORRECTED, EXPLAINED, CANNOT, DIFFERENT) if kinds[kind]]
    return f"Later papers: {', '.join(parts)}."


def finding_document(found: Iterable[Finding]) -> list[dict[str, object]]:
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


def _differences(finding: Finding, indented: Indented) -> Iterator[str]:
    printed, produced = finding.result.corrected, finding.produced
    longest = max(len(printed), len(produced))
    pairs = [
        (printed[i] if i < len(printed) else "(nothing)", produced[i] if i < len(produced) else "(nothing)")
        for i in range(longest)
    ]
    different = [pair for pair in pairs if pair[0].split() != pair[1].split()]
    for one, other in different[:_MOST_DIFFERENCES]:
        yield from indented(f"printed {one.strip()}; computed {other.strip()}")
    if len(different) > _MOST_DIFFERENCES:
        yield from indented(f"and {len(different) - _MOST_DIFFERENCES} more lines")
