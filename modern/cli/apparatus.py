"""``hull1620 apparatus``: list, check and weigh the emendations, or compare a transcription with the listings."""

import argparse
import os
import shutil
import sys
import textwrap
from collections import Counter
from collections.abc import Iterator
from importlib.util import find_spec
from multiprocessing import get_context
from pathlib import Path

from emulator.errors import quoted
from emulator.files import read_text, source_name, write_text, writing_bytes
from modern.claims.apparatus_checks import check_everything
from modern.cli.shared.console import DIFFERS, OK, UsageError, print_notes, print_report, write_folder
from modern.edition import programs
from modern.edition.apparatus import Row
from modern.edition.collation import collate, report, to_csv, to_json, verdicts_by_id
from modern.edition.grounds import Proof
from modern.edition.page_answers import READINGS, page_readings
from modern.edition.page_readings import read_sheet, write_state
from modern.edition.sheets import sheets
from modern.edition.sources import place
from modern.formats.columns import aligned

# The greatest number of processes for ``--check``; more processes do not make it faster.
_MOST_PROCESSES = 4


def main(args: argparse.Namespace) -> int:
    _check_options(args)
    if args.sheet:
        return _read_sheets(args)
    if args.state:
        _use(args.state)
    if args.sheets:
        return _write_sheets(args.sheets)
    if args.weigh:
        from modern.edition.weight import weigh
        from modern.edition.weight_report import write_weight

        answers = weigh(Path(args.weigh), args.runs or "", args.workers, args.most)
        print(write_weight(Path(args.weigh), answers), end="")
        return OK
    if args.restore:
        from modern.study.restoration import listings, measure, others, summary

        groups = (listings(), *((others(Path(args.runs)),) if args.runs else ()))
        copies = measure(Path(args.restore), groups, args.most or 1, args.workers)
        print("\n".join(aligned(summary(copies))))
        return OK
    if args.collate is not None:
        return _collate(args)
    if args.json is not None or args.csv is not None:
        raise UsageError("--json and --csv write a collation; add --collate FILE")
    rows = _rows(args)
    if args.text is not None and not (args.check and args.program is None and args.layer is None):
        raise UsageError("--text can only be used with --check, and not with --program or --layer")
    if not args.check:
        width = max(48, min(shutil.get_terminal_size((100, 24)).columns, 120))
        for row in rows:
            print("\n".join(show(row, width)))
        print(f"{len(rows)} rows")
        return OK
    everything = args.program is None and args.layer is None
    workers = min(
        len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1, _MOST_PROCESSES
    )
    proofs = []
    whole = None if args.text is None else (source_name(args.text), read_text(args.text))
    for proof in check_everything(rows, everything, whole, workers):
        proofs.append(proof)
        print(_line(proof), flush=True)
    if everything and find_spec("numpy") is None:
        print(
            "the later papers and the hulls of the layer `corrected` were not checked, because numpy is not installed"
        )
    failed = sum(not proof.holds for proof in proofs)
    print(f"{len(proofs) - failed} of {len(proofs)} checks hold" + (f"; {failed} FAIL" if failed else ""))
    return DIFFERS if failed else OK


def _check_options(args: argparse.Namespace) -> None:
    """Raise UsageError for options that cannot be combined, and for numbers that are too small."""
    tasks = [name for name in ("sheet", "sheets", "weigh", "restore", "collate", "check") if getattr(args, name)]
    if len(tasks) > 1:
        raise UsageError(f"--{tasks[0]} and --{tasks[1]} cannot be combined; choose one")
    for name, least in (("workers", 1), ("most", 0)):
        if (value := getattr(args, name)) < least:
            raise UsageError(f"--{name}: expected at least {least}, found {value}")
    values = {"runs": args.runs, "workers": args.workers > 1, "most": args.most}
    unused = [name for name, value in values.items() if value]
    if unused and not (args.weigh or args.restore):
        raise UsageError(f"--{unused[0]} needs --weigh or --restore")
    if (args.program or args.layer) and tasks not in ([], ["check"]):
        raise UsageError(f"--program and --layer cannot be combined with --{tasks[0]}")


def _collate(args: argparse.Namespace) -> int:
    text = read_text(args.collate)
    collation = collate(text, Path(args.collate).name)
    if not any(card.lines for card in collation.cards):
        raise UsageError(
            f"--collate: no line of {quoted(args.collate)} can be assigned to a card of the listings; "
            "expected the text of a page or of several statements"
        )
    for path, written in ((args.json, to_json), (args.csv, to_csv)):
        if path is not None:
            write_text(path, written(collation))
    print_report(args, report(collation, text))
    return OK


def _use(state: str) -> None:
    """Read the edition's data from the folder ``state``, a changed copy, instead of the installed data."""
    if not os.path.isfile(os.path.join(state, "fortran_src", READINGS)):
        raise UsageError(f"{state}: expected a folder that --sheet wrote; it has no fortran_src/{READINGS}")
    if programs.text.cache_info().currsize:
        raise UsageError("--state: this process has already read another edition; run the command in a new process")
    sys.modules.pop("fortran_src", None)
    sys.path.insert(0, os.path.abspath(state))


def _write_sheets(folder: str) -> int:
    """Write a proof sheet for each page as HTML and CSV, and also as PDF in a checkout with Typst and the fonts."""
    from modern.publication import proof_sheets
    from modern.publication.building import BuildError

    all_sheets = sheets({reading.item for reading in page_readings()})
    problem = ""
    for sheet in all_sheets:
        texts = proof_sheets.files(sheet)
        write_folder(folder, texts, "utf-8")
        try:
            if not problem:
                with writing_bytes(os.path.join(folder, f"{next(iter(texts))[:-5]}.pdf")) as file:
                    file.write(proof_sheets.pdf(sheet))
        except (ImportError, BuildError) as error:
            problem = str(error) if isinstance(error, BuildError) else "only a checkout of the project can make PDF"
    readings = sum(len(item.variants) for sheet in all_sheets for item in sheet.items)
    asked = sum(len(sheet.questions) for sheet in all_sheets)
    print(f"{folder}: {len(all_sheets)} proof sheets with {readings} silent readings and {asked} open questions")
    print_notes([f"note: no PDF was written: {problem}"] if problem else [])
    return OK


def _read_sheets(args: argparse.Namespace) -> int:
    """Write a copy of the edition's data that includes the answers of proof sheets, and check it in a new process."""
    if not args.state:
        raise UsageError("--sheet needs --state FOLDER, the folder to which the changed edition is written")
    readings = [reading for name in args.sheet for reading in read_sheet(source_name(name), read_text(name))]
    for item, times in Counter(reading.item for reading in readings).items():
        if times > 1:
            raise UsageError(f"item {item} is answered on {times} sheets; keep only one answer")
    stored = write_state(args.state, readings)
    for reading in readings:
        print(
            f"{reading.item:<8} page {reading.page:<4} {reading.outcome:<10} {reading.card or reading.answer}".rstrip()
        )
    outcomes = Counter(reading.outcome for reading in stored)
    print(f"{args.state}: {', '.join(f'{count} {outcome}' for outcome, count in outcomes.items())}")
    child = get_context("spawn").Process(target=_check_state, args=(args.state,))
    child.start()
    child.join()
    return child.exitcode or OK


def _check_state(state: str) -> None:
    from modern.cli.main import main as command

    sys.exit(command(["apparatus", "--check", "--state", state]))


def _line(proof: Proof) -> str:
    return f"{'holds' if proof.holds else 'FAILS'}  {proof.subject:<18} {proof.message}"


def show(row: Row, width: int) -> Iterator[str]:
    """Yield the lines that describe one emendation, at most ``width`` columns wide."""
    yield f"{row.id}  {row.text}  p. {row.page}  {programs.cards_of(row)}  [{row.layer}, {row.kind}, {row.certainty}]"
    line = row.changes[0].line
    yield from _folded("source", f"{place(row.text, line) or f'after row {line}'}; cause: {row.cause}", width)
    yield from _folded("reads", row.witness, width)
    yield from _folded("lemma", row.lemma, width)
    for name, verdicts in verdicts_by_id(row).items():
        yield from _folded("collated", f"{name}: {', '.join(verdicts)}", width)
    for rejected in row.rejected:
        yield from _folded("rejected", f"{rejected.reading}: {rejected.reason}", width)
    yield from _folded("reason", row.reason, width)
    yield from _folded("evidence", row.evidence, width)
    ground = ", ".join(f"{key} {value}" for key, value in row.ground.items() if key != "kind")
    yield from _folded("ground", f"{row.ground.get('kind', '')}{': ' + ground if ground else ''}", width)
    yield from _folded("editor", f"{row.editor}, {row.date}", width)


def _folded(name: str, text: str, width: int) -> list[str]:
    first = f"    {name:<9} "
    return textwrap.wrap(
        text, width, initial_indent=first, subsequent_indent=" " * len(first), break_long_words=True
    ) or [first.rstrip()]


def _rows(args: argparse.Namespace) -> list[Row]:
    names: tuple[str, ...] = programs.TEXTS
    if args.program is not None:
        number = args.program.removeprefix("program")
        if number not in ("1", "2", "3"):
            raise UsageError(f"--program: {quoted(args.program)} is not one of the programs 1, 2 and 3")
        names = (f"program{number}",)
    rows = [row for name in names for row in programs.text(name).rows]
    if args.layer is not None:
        known = programs.text("program1").layers
        if args.layer not in known:
            raise UsageError(f"--layer: unknown layer {quoted(args.layer)}; expected one of {', '.join(known)}")
        rows = [row for row in rows if row.layer == args.layer]
    return rows
