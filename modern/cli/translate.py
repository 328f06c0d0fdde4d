"""``hull1620 translate``: write a program as C or as Fortran for a modern compiler."""

from __future__ import annotations

import argparse

from emulator.files import write_text
from emulator.translation.writers import translated
from modern.cli.shared.console import OK
from modern.cli.shared.programs import source_deck
from modern.edition import programs


def main(args: argparse.Namespace) -> int:
    # Only the programs of the thesis require complete data sets.
    text = translated(source_deck(args), args.to, every_read_ends=args.program not in programs.NAMES)
    write_text(args.output, text)
    return OK
