"""``hull1620 apparatus``: the emendations of the listings, and the proof that each is needed."""

from __future__ import annotations

import argparse
import shutil
import sys
import textwrap
from collections.abc import Iterator

from modern.cli.shared.console import DIFFERS, OK, UsageError
from modern.edition import programs
from modern.edition.apparatus import Row
from modern.edition.chapter6_cards import device_files, load_chapter
from modern.edition.chapter6_checks import check_chapter
from modern.edition.grounds import Proof, check_decks, check_row


def main(args: argparse.Namespace) -> int:
    """List rows, or check them."""
    rows = _rows(args)
    if not args.check:
        width = max(48, min(shutil.get_terminal_size((100, 24)).columns, 120))
        for row in rows:
            print("\n".join(show(row, width)))
        print(f"{len(rows)} rows")
        return OK
    proofs = list(check_decks())
    for proof in proofs:
        print(_line(proof))
    for number, row in enumerate(rows, 1):
        if sys.stderr.isatty():
            print(f"\r{number} of {len(rows)}", end="", file=sys.stderr, flush=True)
        proofs.append(check_row(row))
        print(_line(proofs[-1]))
    if sys.stderr.isatty():
        print("\r", end="", file=sys.stderr)
    if args.program is None and args.layer is None:
        proofs.append(check_transcripts())
        print(_line(proofs[-1]))
    failed = sum(not proof.holds for proof in proofs)
    print(f"{len(proofs) - failed} of {len(proofs)} hold" + (f"; {failed} FAIL" if failed else ""))
    return DIFFERS if failed else OK


def check_transcripts() -> Proof:
    """Whether chapter 6's cards are its witness, rows and layout, and each of its rows is needed."""
    chapter = load_chapter()
    faults = check_chapter(chapter)
    files, rows = len(device_files(chapter)), len(chapter.text.rows)
    words = f"{files} device files are witness, {rows} rows and layout, each row needed"
    return Proof("chapter6", not faults, words if not faults else faults[0])


def _line(proof: Proof) -> str:
    return f"{'holds' if proof.holds else 'FAILS'}  {proof.subject:<18} {proof.words}"


def show(row: Row, width: int) -> Iterator[str]:
    """A row as lines of at most ``width`` columns."""
    yield f"{row.id}  {row.text}  p. {row.page}  {row.card}  [{row.layer}, {row.kind}, {row.certainty}]"
    yield from _folded("reads", row.witness, width)
    yield from _folded("lemma", row.lemma, width)
    yield from _folded("why", row.reason, width)
    yield from _folded("evidence", row.evidence, width)
    ground = ", ".join(f"{key} {value}" for key, value in row.ground.items() if key != "kind")
    yield from _folded("ground", f"{row.ground.get('kind', '')}{': ' + ground if ground else ''}", width)


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
            raise UsageError(f"--program: {args.program!r} is not 1, 2 or 3")
        names = (f"program{number}",)
    rows = [row for name in names for row in programs.text(name).rows]
    if args.layer is not None:
        known = programs.text("program1").layers
        if args.layer not in known:
            raise UsageError(f"--layer: there is no layer {args.layer!r}; there are {', '.join(known)}")
        rows = [row for row in rows if row.layer == args.layer]
    return rows
