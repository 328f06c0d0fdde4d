"""``hull1620 bench``: the engines side by side, and beside the same program through a Fortran compiler of today."""

from __future__ import annotations

import argparse
import json
import sys

from emulator.files import check_writable, write_text
from modern.bench.measure import document, lines, measure
from modern.cli.shared.console import OK, UsageError, say


def main(args: argparse.Namespace) -> int:
    """Measure, print the table, write the figures."""
    if args.decks < 1:
        raise UsageError(f"--decks: {args.decks} is not a number of decks")
    check_writable(args.json)
    bench = measure(args.decks, lambda line: say([f"{line} ..."]))
    sys.stdout.write("".join(line + "\n" for line in lines(bench)))
    if args.json is not None:
        write_text(args.json, json.dumps(document(bench), indent=1) + "\n")
    return OK
