"""``hull1620 bench``: compare the speed of the engines with each other and with a modern Fortran compiler."""

from __future__ import annotations

import argparse
import json
import sys

from emulator.files import check_writable, write_text
from modern.bench.measure import document, lines, measure
from modern.cli.shared.console import OK, UsageError, print_notes


def main(args: argparse.Namespace) -> int:
    if args.decks < 1:
        raise UsageError(f"--decks: expected at least 1 deck, found {args.decks}")
    check_writable(args.json)
    figures = measure(args.decks, lambda step: print_notes([f"{step} ..."]))
    sys.stdout.write("".join(line + "\n" for line in lines(figures)))
    if args.json is not None:
        write_text(args.json, json.dumps(document(figures), indent=1) + "\n")
    return OK
