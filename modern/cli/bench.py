"""``hull1620 bench``: compare the speed of the engines with each other and with a modern Fortran compiler."""

import argparse

from modern.bench.measure import document, lines, measure
from modern.cli.shared.console import OK, UsageError, print_notes, print_report, write_json


def main(args: argparse.Namespace) -> int:
    if args.decks < 1:
        raise UsageError(f"--decks: expected at least 1 deck, found {args.decks}")
    figures = measure(args.decks, lambda step: print_notes([f"{step} ..."]))
    print_report(args, lines(figures))
    write_json(args, document(figures))
    return OK
