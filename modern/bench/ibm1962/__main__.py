"""``python -m modern.bench.ibm1962``: run statements and object decks on IBM's library of 1962."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from itertools import islice

from emulator.errors import EmulatorError, Refused
from emulator.files import read_text, write_text
from emulator.language.cards import read_deck
from emulator.language.compiler import compile_deck
from modern.bench.ibm1962 import arithmetic, times
from modern.bench.ibm1962.chapter6 import FOLDER, results
from modern.bench.ibm1962.emulated import emulate
from modern.bench.ibm1962.measured import at_random, fields_at_random, load, measure, same
from modern.bench.ibm1962.objectdecks import against_deck, compare, library, subjects
from modern.bench.ibm1962.simulator import Failed, Unavailable, object_deck
from modern.bench.ibm1962.statements import Statement, execute

EPILOG = """
OBJECT_DECK names the file of IBM's object deck of 1962, and I1620 the simulator (default: i1620). If either is missing,
the command prints a line that begins with "skipped" and ends with exit code 0.

examples:
  python -m modern.bench.ibm1962 show TYPE "(I4,F8.3)" --values="12 -.25000000E+01"
  python -m modern.bench.ibm1962 measure --random 500
  python -m modern.bench.ibm1962 chapter6
  python -m modern.bench.ibm1962 show READ "(I5,E14.8)" --values="1 .10000000E+01" --card "   -0     .2E1"
"""
VERBS = ("READ", "ACCEPT", "PUNCH", "TYPE", "PRINT")


def parser() -> argparse.ArgumentParser:
    """Return the parser for the arguments of ``python -m modern.bench.ibm1962``."""
    result = argparse.ArgumentParser(
        prog="python -m modern.bench.ibm1962",
        description=__doc__,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    commands = result.add_subparsers(dest="command", required=True)

    def command(name: str, run: Callable[[argparse.Namespace], int], what: str) -> argparse.ArgumentParser:
        added = commands.add_parser(name, help=what)
        added.set_defaults(run=run)
        return added

    one = command("show", show, "execute one statement and print what it types, punches and stores")
    one.add_argument("verb", choices=VERBS)
    one.add_argument("format", help='a FORMAT, such as "(I4,F8.3)"')
    one.add_argument("--values", default="", help='the numbers of the list, such as --values="12 -.25000000E+01"')
    one.add_argument("--card", action="append", default=[], help="a data card, or a line typed for ACCEPT")
    for committed in (
        command(
            "chapter6",
            run_chapter6,
            "run chapter 6 with all emendations and without each one; compare with the committed results",
        ),
        command("times", run_times, "measure the simulated time of runs; compare it with the committed results"),
    ):
        committed.add_argument("--write", action="store_true", help="replace the committed results")
    command("programs", run_programs, "run all programs on the library and on the emulator; compare their output")
    repeat = command("measure", run_measure, "repeat the stored statements; compare the results with the emulator's")
    repeat.add_argument(
        "--random", type=int, default=0, metavar="N", help="also compare N random statements, N fields and N operations"
    )
    repeat.add_argument("--seed", type=int, default=1, help="the seed of the random statements (default: 1)")
    compiled = command(
        "compile", run_compile, "compare the object code of a program with the program in IBM's object deck"
    )
    compiled.add_argument("source", help="the file of the program")
    return result


def show(options: argparse.Namespace) -> int:
    """Execute one input or output statement on the library, and print its outcome."""
    statement = Statement(options.verb, options.format, options.values.split())
    (outcome,) = execute([(statement, options.card)], object_deck())
    for what, lines in (("typed", outcome.typed), ("punched", outcome.punched), ("number", outcome.numbers)):
        for line in lines:
            print(f"{what:7} [{line}]")
    if outcome.trouble:
        print(f"stopped: {outcome.trouble}")
    return 0


def run_chapter6(options: argparse.Namespace) -> int:
    """Run the examples of chapter 6 on the library.  Return 1 if the results differ from the committed ones."""
    library()
    return max(_committed(f"{FOLDER}/{name}", text, options.write) for name, text in results().items())


def _committed(path: str, text: str, write: bool) -> int:
    """Compare a result with its committed file, replaced first if ``write``.  Return 1 if they differ, else 0."""
    if write:
        write_text(path, text)
    same = read_text(path) == text
    print(f"{path}: {'equal to' if same else 'different from'} the committed results")
    return int(not same)


def run_times(options: argparse.Namespace) -> int:
    """Measure the simulated time of runs on the library.  Return 1 if the times differ from the committed ones."""
    return _committed(times.FILE, times.table(), options.write)


def run_programs(options: argparse.Namespace) -> int:
    """Compare all programs on the library and on the emulator.  Return 1 if a card or a line differs."""
    library()
    exit_code = 0
    for name, program, deck, operator in subjects():
        comparison = compare(name, program, deck, operator)
        differences = list(comparison.differences())
        cards, lines = map(len, comparison.emulator)
        print(f"{name}: {cards} cards and {lines} typed lines, {len(differences)} differ {comparison.error}".rstrip())
        for pair in differences:
            print("  library  [{}]\n  emulator [{}]".format(*pair))
        exit_code = exit_code or int(bool(differences or comparison.error))
    return exit_code


def run_measure(options: argparse.Namespace) -> int:
    """Execute recorded and random statements on library and emulator.  Return 1 if any two results differ."""
    deck, vectors = object_deck(), load()
    again = measure([(vector.statement, vector.cards) for vector in vectors], deck)
    changed = sum(not same(first.outcome, second.outcome) for first, second in zip(vectors, again, strict=True))
    print(f"{len(vectors)} stored statements: {changed} no longer have their stored results on the library")
    for draw in (at_random, fields_at_random):
        again += measure(list(islice(draw(options.seed), options.random)), deck)
    wrong = [vector for vector in again if not same(emulate(vector.statement, cards=vector.cards), vector.outcome)]
    print(f"{len(again)} statements: {len(wrong)} have different results in the emulator and on the library")
    operations = arithmetic.at_random(options.seed, options.random)
    results = list(arithmetic.different(operations, deck)) if operations else []
    print(f"{len(operations)} operations: {len(results)} have different results in the emulator and on the library")
    for vector in wrong:
        print(vector.line())
    for result in results:
        print(*result)
    return int(bool(changed or wrong or results))


def run_compile(options: argparse.Namespace) -> int:
    """Compare the object code of a source deck with the program in IBM's object deck.  Return 1 if they differ."""
    positions, different, cards = against_deck(compile_deck(read_deck(options.source)), object_deck())
    print(f"object program: {different} of {positions} positions differ; symbol table: {cards} cards differ")
    return int(bool(different or cards))


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command of the given arguments.  Print a line and return 0 if the simulator or the deck is missing."""
    options = parser().parse_args(arguments)
    try:
        exit_code: int = options.run(options)
        return exit_code
    except Unavailable as reason:
        print(f"skipped: {reason}")
        return 0
    except (Failed, ValueError, EmulatorError, Refused) as error:
        print(error, file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
