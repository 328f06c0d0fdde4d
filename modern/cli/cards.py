"""``hull1620 cards``: points to a data deck."""

from __future__ import annotations

import argparse

from emulator.files import write_text
from modern.cli.common import say
from modern.cli.exits import OK
from modern.formats.csv import deck_lines, read_rows
from modern.thesis.deck import MAX_POINTS


def main(args: argparse.Namespace) -> int:
    """Read the points, write the deck."""
    source = "standard input" if args.points == "-" else args.points
    lines = deck_lines(read_rows(args.points), source, args.truncate)
    write_text(args.output, "".join(line + "\n" for line in lines))
    if len(lines) - 1 > MAX_POINTS:
        say([f"warning: {source}: {len(lines) - 1} points; the programs as listed take at most {MAX_POINTS}"])
    return OK
