"""``hull1620 translate``: write a program as C, modern Fortran or FPCore, or the benchmark for authors of tools."""

import argparse
import os

from emulator.files import write_text
from emulator.language.compiler import compile_deck
from emulator.translation.fpcore import statements
from emulator.translation.writers import translated
from modern.cli.shared.arguments import DOCUMENTS
from modern.cli.shared.console import OK, UsageError, counted, print_notes, write_folder
from modern.cli.shared.programs import source_deck
from modern.edition import programs


def main(args: argparse.Namespace) -> int:
    if args.benchmark is not None:
        if args.program or args.to or args.layers or args.upcase or args.output != "-":
            raise UsageError(
                "--benchmark writes all its files to DIR; omit the program, --to, --layers, --upcase and -o"
            )
        from modern.bench.benchmark import benchmark  # its imports take a second

        texts = benchmark()
        for folder in {os.path.dirname(name) for name in texts}:
            write_folder(os.path.join(args.benchmark, folder), {})
        write_folder(args.benchmark, texts)
        print_notes([f"{counted(len(texts), 'file')} written to {args.benchmark}"])
        return OK
    if not args.program or not args.to:
        raise UsageError("expected a program with --to, or --benchmark DIR")
    write_text(args.output, _text(args))
    return OK


def _text(args: argparse.Namespace) -> str:
    if args.program in DOCUMENTS:
        if args.to != "fpcore":
            raise UsageError(f"{args.program} is a document; its formulas can only be written with --to fpcore")
        if args.layers or args.upcase:
            raise UsageError(f"{args.program} is a document; --layers and --upcase apply to programs only")
        from modern.bench.formulas import fpcore

        return fpcore(args.program)
    deck = source_deck(args)
    if args.to == "fpcore":
        return statements(compile_deck(deck))
    # Only the programs of the thesis require complete data sets.
    return translated(deck, args.to, every_read_ends=args.program not in programs.NAMES)
