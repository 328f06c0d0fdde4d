"""The figures that documents quote by name from committed results, and the function that fills them in.

A document quotes a figure by its name between double braces, such as ``{{ seventy.failures }}``. The function
:func:`filled` replaces the names in Markdown text, for the site and for the book. The figures come from the tables in
``docs/studies`` and ``docs/weight`` (``docs/figures.csv`` names their cells), from the edition, and from a run of the
examples.
"""

import csv
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from emulator.files import read_text
from modern.claims.evidence import GRADES
from modern.claims.published import PAPERS, findings
from modern.claims.register import COLUMNS, DOCUMENTS, counts, grades, judged
from modern.edition import programs
from modern.edition.chapter6 import EXAMPLES
from modern.edition.reproduce import reproduce
from modern.publication.building import citation
from modern.study.report import joined, raised
from modern.study.restoration import CLASSES, read_restoration, summary

_PLACE = re.compile(r"\{\{\s*([a-z][\w.-]*)\s*\}\}")
_FENCED = re.compile(r"(^```.*?^```)", re.DOTALL | re.MULTILINE)


class FigureError(ValueError):
    """Raised if a document quotes an unknown figure, or if a table does not contain the cell of a figure."""


@dataclass(frozen=True, slots=True)
class Cell:
    """A cell of a table.

    ``table`` is the path of the file below ``docs``, ``row`` identifies the row by its first cells, and
    ``column`` is the heading of the column.
    """

    table: str
    row: tuple[str, ...]
    column: str


_CHECKS = ("print", "machine", "equation", "sibling")


def filled(text: str, values: Mapping[str, str]) -> str:
    """Replace every ``{{ name }}`` in a text by its value. Raise FigureError for an unknown name.

    Outside blocks of code, no line can break inside an estimate with its interval, or before a percent sign.
    """

    def value(match: re.Match[str]) -> str:
        if match[1] not in values:
            raise FigureError(f"unknown figure {match[1]!r}")
        return values[match[1]]

    pieces = _FENCED.split(_PLACE.sub(value, text))
    return "".join(piece if n % 2 else joined(piece) for n, piece in enumerate(pieces))


def named(text: str) -> tuple[str, ...]:
    """Return the names of the figures that a text quotes, in the order of the text."""
    return tuple(_PLACE.findall(text))


def figures(docs: Path) -> dict[str, str]:
    """Return the value of every figure by name. ``docs`` is the folder of the documents.

    The function runs the examples, which takes some seconds. Raise FigureError if a table does not have the cell of a
    figure, and FileError if a table does not exist.
    """
    return {
        **{name: _formatted(read_cell(docs, cell)) for name, cell in cells(docs).items()},
        **dict(_weight(docs)),
        **dict(_restoration(docs)),
        **dict(_examples()),
        **dict(_papers()),
        **dict(_statements()),
        **dict(_listings()),
        "project.version": str(citation()["version"]),
    }


def cells(docs: Path) -> dict[str, Cell]:
    """Return, by name, the cells of the figures that ``docs/figures.csv`` lists."""
    rows = _table(docs / "figures.csv")
    return {row["figure"]: Cell(row["table"], tuple(row["row"].split("; ")), row["column"]) for row in rows}


def read_cell(docs: Path, cell: Cell) -> str:
    """Return the text of a cell. Raise FigureError unless exactly one row matches and the column exists."""
    matches = [line for line in _table(docs / cell.table) if tuple(line.values())[: len(cell.row)] == cell.row]
    if len(matches) != 1:
        raise FigureError(f"{cell.table}: expected one row {', '.join(cell.row)}, found {len(matches)} rows")
    if cell.column not in matches[0]:
        raise FigureError(f"{cell.table}: expected the column {cell.column}, found {', '.join(matches[0])}")
    return matches[0][cell.column]


def _formatted(value: str) -> str:
    # An integer of five or more digits gets commas, like the other figures.
    return f"{int(value):,}" if value.isdigit() and len(value) > 4 else raised(value)


def _table(path: Path) -> list[dict[str, str]]:
    return list(csv.DictReader(read_text(str(path)).splitlines()))


def _weight(docs: Path) -> Iterator[tuple[str, str]]:
    lines = _table(docs / "weight" / "cards.csv")
    sums = {kind: sum(int(line[kind]) for line in lines) for kind in ("compiler", *_CHECKS, "nothing")}
    compiled = sum(sums.values()) - sums["compiler"]
    yield "weight.variants", f"{sum(sums.values()):,}"
    yield "weight.refused", f"{sums['compiler']:,}"
    yield "weight.compiled", f"{compiled:,}"
    yield "weight.noticed", f"{sum(sums[kind] for kind in _CHECKS):,}"
    yield "weight.silent", f"{sums['nothing']:,}"
    yield "weight.silent-share", f"{100 * sums['nothing'] / compiled:.1f} %"


def _restoration(docs: Path) -> Iterator[tuple[str, str]]:
    copies = read_restoration(docs / "restoration")
    head, *lines = summary(copies)
    totals = {line[:2]: line[3:] for line in lines if line[2] == "all"}
    for damage, short in (("as the OCR", "ocr"), ("signs lost", "signs")):
        yield f"restoration.{short}-copies", str(sum(copy.damage == damage for copy in copies))
        for name in CLASSES:
            cards, wrong, rate, interval, _ = totals[damage, name]
            yield f"restoration.{short}-{name}-cards", _formatted(cards)
            yield f"restoration.{short}-{name}-wrong", _formatted(wrong)
            yield f"restoration.{short}-{name}-rate", f"{rate} ({interval})"
        for name in ("abstained", "unnoticed", "damaged"):
            yield f"restoration.{short}-{name}", _formatted(totals[damage, name][0])
    rows = [head, ("---", "---", "---", *["---:"] * (len(head) - 3)), *lines]
    yield "restoration.table", "\n".join(f"| {' | '.join(row)} |" for row in rows)


def _examples() -> Iterator[tuple[str, str]]:
    reports = [report for report in reproduce() if not report.stated]
    yield "examples.count", str(len(EXAMPLES))
    for state, name in (("examples", "run"), ("listing", "listed")):
        verdicts = [report.verdict for report in reports if report.state == state]
        kinds = Counter(verdict.kind for verdict in verdicts)
        yield f"examples.{name}-results", str(len(verdicts))
        yield f"examples.{name}-exact", str(kinds["exact"])
        yield f"examples.{name}-reordered", str(kinds["exact in another order"])
        exact = [verdict for verdict in verdicts if verdict.kind == "exact"]
        yield f"examples.{name}-cards", str(sum(verdict.cards + verdict.blank for verdict in exact))
        yield f"examples.{name}-numbers", str(sum(verdict.numbers for verdict in exact))


def _papers() -> Iterator[tuple[str, str]]:
    kinds = Counter(finding.kind for paper in PAPERS for finding in findings(paper))
    yield "papers.results", str(sum(kinds.values()))
    for name in ("exact", "as corrected", "differs, explained", "not reproducible"):
        yield f"papers.{name.replace(', ', '-').replace(' ', '-')}", str(kinds[name])


def _statements() -> Iterator[tuple[str, str]]:
    numbers = {document: counts(document) for document in DOCUMENTS}
    yield from _counted("statements", "table", COLUMNS, {**numbers, "all": sum(numbers.values(), Counter())})
    graded = {document: grades(judged(document)) for document in DOCUMENTS}
    yield from _counted("statements", "grades", GRADES[:4], {**graded, "all": sum(graded.values(), Counter())})


def _counted(
    prefix: str, table: str, columns: Sequence[str], numbers: Mapping[str, Counter[Any]]
) -> Iterator[tuple[str, str]]:
    """Yield the numbers of statements in each document by verdict or grade, and a Markdown table of all numbers.

    The names of the figures begin with ``prefix``. ``columns`` are the verdicts or grades, and ``numbers`` has their
    counts for each document.
    """
    total = "count" if table == "table" else "graded"
    lines = [("document", "statements", *columns), ("---", *("--:",) * (1 + len(columns)))]
    for document, counted in numbers.items():
        cells = [counted.total(), *(counted[name] for name in columns)]
        for name, cell in zip((total, *columns), cells, strict=True):
            yield f"{prefix}.{document}.{name.replace(' ', '-')}", str(cell)
        lines.append((document, *map(str, cells)))
    yield f"{prefix}.{table}", "\n".join(f"| {' | '.join(line)} |" for line in lines)


def _listings() -> Iterator[tuple[str, str]]:
    texts = [programs.text(name) for name in programs.TEXTS]
    layers = Counter(row.layer for text in texts for row in text.rows)
    faults = read_text(str(programs.sources().joinpath("KNOWN-FAULTS.md")))
    questions = read_text(str(programs.sources().joinpath("OPEN-QUESTIONS.md")))
    dimension = programs.committed("program1").text().replace(" ", "")
    yield "listings.statements", str(sum(len(programs.program(name).statements) for name in programs.TEXTS))
    yield "listings.characters", f"{sum(len(''.join(line.text.split())) for text in texts for line in text.witness):,}"
    yield "listings.rows", str(layers.total())
    for layer in ("ocr", "print", "lacuna", "examples", "epsilon", "translation", "corrected"):
        yield f"listings.rows-{layer}", str(layers[layer])
    yield "listings.faults", str(len(re.findall(r"^\d+\. \*\*", faults, re.MULTILINE)))
    entries = re.split(r"^\d+\. ", questions, flags=re.MULTILINE)[1:]
    yield "listings.questions", str(sum("ettled 20" not in entry for entry in entries))
    yield "listings.points", re.findall(r"DIMENSIONX\((\d+)\)", dimension)[0]
