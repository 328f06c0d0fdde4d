"""``hull1620 digits``: report which digits of a program's results are significant, and which statements lose them.

The report combines four computations: a run in the arithmetic of ``--arithmetic``, the same run in exact arithmetic,
stochastic runs, and a run in interval arithmetic.  Each part of the report is a :class:`Table`, which is written to the
terminal, as CSV and as HTML.
"""

import argparse
import io
import math
import re
import shutil
import textwrap
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from fractions import Fraction
from html import escape
from itertools import zip_longest
from string import Template

from emulator.errors import EmulatorError
from emulator.files import write_text
from emulator.language.cards import Deck
from emulator.language.objectcode import Line, Program
from emulator.machine.devices import no_deck
from emulator.machine.divergence import Divergence, diverge
from emulator.machine.machine import Machine
from emulator.machine.result import Options, Result
from emulator.numbers import Numbers, numbers
from emulator.numbers.draws import MAX_SEED
from emulator.numbers.sampled import SampledNumbers
from emulator.numbers.significance import Estimate
from emulator.numbers.stochastic import MAX_RUNS
from modern.cli.shared.console import DIFFERS, OK, UsageError, check_one_standard_input, counted, print_report
from modern.cli.shared.inputs import deck_for
from modern.cli.shared.programs import load_program, machine_options, number_system
from modern.comparison.sampling import DecisionShares, Independent, Printed, Sampling, in_step, independent, sampled
from modern.comparison.sensitivity import NUMBER, Sensitivity, records_of, sensitivities, shape_of
from modern.formats.columns import csv_text

_NARROWEST, _WIDEST = 60, 120
# The least width to which the column of a statement or a verdict is narrowed.
_SHORTEST = 16


@dataclass(frozen=True)
class Table:
    """A part of the report: a title, sentences, the heads of the columns, and the rows below them."""

    title: str
    sentences: Sequence[str]
    heads: Sequence[str]
    rows: Sequence[Sequence[str]]


def main(args: argparse.Namespace) -> int:
    check_one_standard_input(args)
    if [args.csv, args.html, args.samples].count("-") > 1:
        raise UsageError("only one of --csv, --html and --samples can be standard output; name files for the others")
    options = machine_options(args)
    numbers_in_step = _runs(args, options.numbers)
    reference = number_system(args.against, "--against")
    program = load_program(args)
    deck = deck_for(args.program, args.deck) if args.deck else no_deck(program)
    result = Machine(program, deck, options).run()
    divergence = diverge(program, deck, options.numbers, reference, options)
    sampling = in_step(program, deck, numbers_in_step, options)
    runs = independent(program, deck, numbers_in_step.members, options) if args.independent else None
    truth = _truth(reference, divergence)
    machine, exact = _run(program, deck, options, truth)
    tables = [
        _numbers(result, truth, exact, runs or sampling),
        _decisions(program, deck, options, divergence, (runs or sampling).decisions),
        _statements(divergence, sampling),
    ]
    if args.deck and exact is not None:
        tables.append(_cards(*sensitivities(machine, exact)))
    heading = (
        f"{program.source}, {deck.source}: {options.numbers.name} against {reference.name}; "
        f"{len(numbers_in_step.members)} runs with random rounding{', each with its own branches' if runs else ''} "
        f"({numbers_in_step.name})"
    )
    print_report(args, _terminal(heading, tables))
    if args.csv is not None:
        write_text(args.csv, _csv(tables))
    if args.html is not None:
        write_text(args.html, _html(heading, tables))
    if args.samples is not None:
        _write_samples(args.samples, (runs or sampling).printed)
    return DIFFERS if divergence.decisions or divergence.apart or not result.ending.normal else OK


def _runs(args: argparse.Namespace, studied: Numbers) -> SampledNumbers:
    """Return the stochastic runs that the options request. Raise UsageError if the options are invalid."""
    if isinstance(studied, SampledNumbers):
        if args.runs is not None or args.seed is not None or args.proportional or args.majority:
            known = "already states the number of runs and their seeds"
            raise UsageError(f"{studied.name} {known}; omit --runs, --seed, --proportional and --majority")
        return studied
    runs, seed = 10 if args.runs is None else args.runs, 1 if args.seed is None else args.seed
    if not 2 <= runs <= MAX_RUNS:
        raise UsageError(f"--runs: expected 2 to {MAX_RUNS} runs, found {runs}")
    if not 0 <= seed <= MAX_SEED + 1 - runs:
        raise UsageError(f"--seed: expected 0 to {MAX_SEED + 1 - runs} for {runs} runs, found {seed}")
    return sampled(studied, runs, seed, ":proportional" * args.proportional + ":majority" * args.majority)


def _run(program: Program, deck: Deck, options: Options, reference: Numbers) -> tuple[Machine, Result | None]:
    """Run the program in the reference arithmetic. The result is None if that arithmetic cannot read the deck."""
    machine = Machine(program, deck, replace(options, numbers=reference))
    try:
        return machine, machine.run()
    except EmulatorError:
        return machine, None


def _truth(reference: Numbers, divergence: Divergence) -> Numbers:
    """Return the reference arithmetic, or binary arithmetic of 200 bits if the reference could not decide a test."""
    ending = divergence.endings[1]
    return numbers("mp:200") if ending is not None and ending.kind == "undecided" else reference


def _numbers(result: Result, truth: Numbers, reference: Result | None, runs: Sampling | Independent) -> Table:
    """Return a table of the printed numbers with their true digits, their estimated digits, and a verdict."""
    studied, exact = records_of(result), records_of(reference) if reference else []
    same = shape_of(studied) == shape_of(exact)
    estimates = {}
    if shape_of(studied) == shape_of(runs.records):
        counts: dict[int, int] = {}
        for number in runs.printed:
            place = counts.get(number.record, 0)
            counts[number.record] = place + 1
            estimates[number.record, place] = number.estimate
    rows = []
    for record, text in enumerate(studied, 1):
        for place, columns in enumerate(NUMBER.findall(text)):
            # No estimate exceeds the number of digits that are printed.
            most = float(len(Decimal(columns).as_tuple().digits))
            true = _common(columns, NUMBER.findall(exact[record - 1])[place], most) if same else None
            estimated = estimates.get((record, place))
            if estimated is not None:
                fewer = min(estimated.parker, most), min(estimated.sohier, most)
                estimated = replace(estimated, parker=fewer[0], sohier=fewer[1])
            rows.append((str(record), columns, _one(true), *_estimated(estimated), _verdict(estimated, true)))
    sentences = [f"true: digits that agree with a run in {truth.name} arithmetic"]
    if not same:
        sentences = [f"the true digits are unknown, because a run in {truth.name} arithmetic prints different records"]
    if studied and not estimates:
        sentences.append("no digits can be estimated, because the runs with random rounding print different records")
    if not result.ending.normal:
        sentences.append(f"the run ended early: {result.ending.outcome}")
    if isinstance(runs, Independent):
        shares = " + ".join(map(str, runs.shares))
        sentences.append(f"sizes of the groups of runs whose records differ only in digits: {shares}")
    return Table("Printed numbers", sentences, ("line", "number", "true", "estimated", "at least", "verdict"), rows)


def _common(first: str, second: str, digits: float) -> float:
    """Return the number of digits in which a printed number agrees with the reference, at most ``digits``."""
    a, b = Fraction(first), Fraction(second)
    if abs(a - b) <= Fraction(10) ** int(Decimal(first).as_tuple().exponent):
        return digits
    return min(max(0.0, -math.log10(abs(a - b) / abs(b))), digits) if b else 0.0


def _one(value: float | None) -> str:
    return "" if value is None else f"{value:.1f}"


def _estimated(estimated: Estimate | None) -> tuple[str, str]:
    if estimated is None:
        return "", ""
    if estimated.is_zero and not estimated.is_exact:
        return "@.0", "0.0"
    return _one(estimated.parker), _one(estimated.sohier)


def _verdict(estimated: Estimate | None, true: float | None) -> str:
    """Return a verdict on a printed number: how many of its digits to believe, or a text such as ``not estimated``."""
    if estimated is None:
        return "not estimated"
    if estimated.is_exact:
        is_wrong = true is not None and true <= estimated.parker - 1
        return "no rounding affects it" + ", but it is wrong" * is_wrong
    if estimated.is_zero:
        return "no digit is significant"
    if true is not None and true < estimated.sohier - 1:
        return "the runs agree, but on a wrong value"
    if estimated.sohier < 1:
        return "no digit is certain"
    return f"believe {counted(math.floor(estimated.sohier), 'digit')}"


def _decisions(
    program: Program,
    deck: Deck,
    options: Options,
    divergence: Divergence,
    decisions: Sequence[DecisionShares],
) -> Table:
    """Return a table of the decisions on which stochastic runs disagree.

    A sentence above the table names the first decision at which the reference arithmetic takes another branch.
    """
    first = divergence.first_decision
    sentences = [f"{divergence.arithmetics[1]}: {counted(divergence.tested, 'decision')} compared, none differs"]
    if first is not None:
        sentences = [
            f"first decision that {divergence.arithmetics[1]} takes differently: {_place(first.line)}, execution "
            f"{first.time}: {first.values[0]} instead of {first.values[1]}"
        ]
    if divergence.apart:
        sentences.append(f"the comparison with {divergence.arithmetics[1]} ended: {divergence.apart}")
    tested = sum(row.times for row in decisions)
    disputed = [row for row in decisions if row.disputed]
    total = sum(row.disputed for row in disputed)
    sentences.append(
        f"random rounding: {counted(tested, 'decision')} on floating-point numbers; the runs disagree on {total} "
        "(disputed)"
    )
    digits = max(2, math.ceil(min(options.numbers.digits, 1_000)))
    _, guaranteed = _run(program, deck, options, numbers(f"interval:{digits}"))
    if guaranteed is not None:
        unknown = guaranteed.ending.message if guaranteed.ending.kind == "undecided" else ""
        sentences.append(f"intervals of {digits} digits: {unknown or 'every decision is certain'}")
    rows = [
        (
            *_columns(row.line),
            str(row.times),
            str(row.disputed),
            str(row.time),
            "/".join(map(str, row.shares)),
            ("negative", "zero", "positive")[row.taken + 1],
        )
        for row in disputed
    ]
    heads = ("card", "statement", "count", "disputed", "first", "runs -/0/+", "taken")
    return Table("Decisions", sentences, heads, rows)


def _statements(divergence: Divergence, sampling: Sampling) -> Table:
    """Return a table of statements: the digits that their values lost, and the digits that stochastic runs estimate."""
    losses = {loss.line.index: loss for loss in divergence.losses}
    rows = []
    for row in sorted(sampling.statements, key=lambda row: (row.worst, row.line.place.card)):
        loss = losses.get(row.line.index)
        if row.inexact or (loss and loss.worst):
            lost = ("", "") if loss is None else (_one(loss.worst), _one(loss.median))
            digits = _one(row.worst), _one(row.median), _one(row.sure), str(row.zeros)
            rows.append((*_columns(row.line), str(row.times), *lost, *digits))
    most = f"{sampling.numbers.digits:.1f}"
    sentences = [f"losses and estimates are in digits (at most {most}); unlisted statements are exact in every run"]
    if divergence.first_value is not None:
        value = divergence.first_value
        sentences.append(
            f"first value that differs: {_place(value.line)}: {value.values[0]} instead of {value.values[1]}"
        )
    heads = ("card", "statement", "count", "lost", "median lost", "estimated", "median", "at least", "@.0")
    return Table("Statements", sentences, heads, rows)


def _cards(rows: Sequence[Sensitivity], omitted: int) -> Table:
    """Return a table of how much the results change if the last digit of one number on a card changes by one."""

    def size(row: Sensitivity) -> float:
        return math.inf if row.branches else row.change or 0.0

    cells = []
    for row in sorted(rows, key=lambda row: (-size(row), row.card, row.column)):
        effect = "other branches" if row.branches else "none" if row.change is None else f"{row.change:.1e}"
        line = "" if row.record is None else str(row.record)
        cells.append((str(row.card), str(row.column), row.columns.strip(), row.changed.strip(), effect, line))
    sentences = ["the largest relative change of a printed number if one number of the deck changes in its last digit"]
    if omitted:
        sentences.append(f"the last {omitted} numbers that the run reads were not examined")
    return Table("Input cards", sentences, ("card", "column", "number", "changed to", "change", "line"), cells)


def _columns(line: Line) -> tuple[str, str]:
    return str(line.place.card), f"{line.label} {line.text}" if line.label else line.text


def _place(line: Line) -> str:
    return "card {}, {}".format(*_columns(line))


def _terminal(heading: str, tables: Sequence[Table]) -> Iterator[str]:
    width = max(_NARROWEST, min(shutil.get_terminal_size((100, 24)).columns, _WIDEST))
    yield from textwrap.wrap(heading, width, subsequent_indent="  ")
    for table in tables:
        yield ""
        yield table.title
        for sentence in table.sentences:
            yield from textwrap.wrap(sentence, width, initial_indent="  ", subsequent_indent="    ")
        if not table.rows:
            continue
        sizes = _sizes(table, width)
        for row in (table.heads, *table.rows):
            pairs = zip(row, sizes.values(), strict=True)
            cells = [textwrap.wrap(cell, size, break_on_hyphens=False) for cell, size in pairs]
            for line in zip_longest(*cells, fillvalue=""):
                yield (
                    "  " + "  ".join(_aligned(cell, *size) for cell, size in zip(line, sizes.items(), strict=True))
                ).rstrip()


def _sizes(table: Table, width: int) -> dict[str, int]:
    """Return the width of each column of a table; columns of text are narrowed to fit a narrow terminal."""
    columns = dict(zip(table.heads, zip(*table.rows, strict=True), strict=True))
    sizes = {head: max(map(len, (head, *cells))) for head, cells in columns.items()}
    if 2 * len(sizes) + sum(sizes.values()) > width:
        sizes = {head: max(map(len, (*head.split(), *cells))) for head, cells in columns.items()}
        excess = 2 * len(sizes) + sum(sizes.values()) - width
        for head in ("statement", "verdict"):
            if head in sizes:
                sizes[head] = min(sizes[head], max(sizes[head] - excess, _SHORTEST))
    return sizes


def _aligned(cell: str, head: str, size: int) -> str:
    return cell.ljust(size) if head in ("statement", "verdict", "taken") else cell.rjust(size)


def _csv(tables: Sequence[Table]) -> str:
    """Return the report as CSV with one row for each cell: its part of the report, row, column and value."""
    cells = (
        (table.title, number, head, cell)
        for table in tables
        for number, row in enumerate(table.rows, 1)
        for head, cell in zip(table.heads, row, strict=True)
    )
    return csv_text((("part", "row", "column", "value"), *cells))


_NUMBER = re.compile(r"-|[-+]?(?:\d+\.?\d*|\.\d+)(?:[Ee][-+]\d+)?")
_PAGE = Template("""<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>$title</title>
<style>
:root { color-scheme: light dark; }
body { font: 1rem/1.5 system-ui, sans-serif; max-width: 70rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.3rem; } h2 { font-size: 1.1rem; margin-top: 2rem; }
div { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: .15rem .8rem .15rem 0; border-bottom: 1px solid #8886; white-space: nowrap; }
td { font-family: ui-monospace, monospace; font-size: .9rem; }
.number { text-align: right; }
@media (max-width: 40rem) {
  th, td { font-size: .75rem; padding-right: .5rem; }
  th, td:last-child { white-space: normal; }
}
</style>
<h1>$title</h1>
$parts
</html>
""")


def _html(heading: str, tables: Sequence[Table]) -> str:
    parts = []
    for table in tables:
        parts += [f"<h2>{escape(table.title)}</h2>", *(f"<p>{escape(sentence)}</p>" for sentence in table.sentences)]
        if table.rows:
            columns = zip(*table.rows, strict=True)
            sides = [" class=number" if all(map(_NUMBER.fullmatch, column)) else "" for column in columns]
            heads = zip(sides, table.heads, strict=True)
            rows = ["".join(f"<th scope=col{side}>{escape(head)}</th>" for side, head in heads)]
            for row in table.rows:
                rows.append("".join(f"<td{side}>{escape(cell)}</td>" for side, cell in zip(sides, row, strict=True)))
            parts.append("<div><table>" + "".join(f"<tr>{row}</tr>" for row in rows) + "</table></div>")
    return _PAGE.substitute(title=escape(heading), parts="\n".join(parts))


def _write_samples(path: str, printed: Sequence[Printed]) -> None:
    import numpy as np

    from emulator.files import writing_bytes

    columns = [[math.nan if value is None else float(value) for value in number.values] for number in printed]
    output = io.BytesIO()
    np.save(output, np.array(columns, dtype=np.float64).reshape(len(columns), -1).T)
    with writing_bytes(path) as file:
        file.write(output.getvalue())
