"""``python -m modern.bench.ibm1962``: execute a statement with IBM's library of 1962."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from emulator.errors import Refused
from modern.bench.ibm1962.simulator import Failed, Unavailable, object_deck
from modern.bench.ibm1962.statements import Statement, execute

EPILOG = """
OBJECT_DECK names the file of IBM's object deck of 1962, and I1620 the simulator (default: i1620). If either is missing,
the command prints a line that begins with "skipped" and ends with exit code 0.

examples:
  python -m modern.bench.ibm1962 show TYPE "(I4,F8.3)" --values="12 -.25000000E+01"
  python -m modern.bench.ibm1962 show READ "(I5,E14.8)" --values="1 .10000000E+01" --card "   -0     .2E1"
"""
VERBS = ("READ", "ACCEPT", "PUNCH", "TYPE", "PRINT")


def parser() -> argparse.ArgumentParser:
    """Return the parser of the command line."""
    result = argparse.ArgumentParser(
        prog="python -m modern.bench.ibm1962",
        description=__doc__,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    commands = result.add_subparsers(dest="command", required=True)
    show = commands.add_parser("show", help="execute one statement and print what it types, punches and stores")
    show.add_argument("verb", choices=VERBS)
    show.add_argument("format", help='a FORMAT, such as "(I4,F8.3)"')
    show.add_argument("--values", default="", help='the numbers of the list, such as --values="12 -.25000000E+01"')
    show.add_argument("--card", action="append", default=[], help="a data card, or a line typed for ACCEPT")
    return result


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command.  Print a line and return 0 if the simulator or the deck is missing."""
    options = parser().parse_args(arguments)
    try:
        outcome = execute(
            Statement(options.verb, options.format, options.values.split()), object_deck(), cards=options.card
        )
    except Unavailable as reason:
        print(f"skipped: {reason}")
        return 0
    except (Failed, ValueError, Refused) as error:
        print(error, file=sys.stderr)
        return 2
    for what, lines in (("typed", outcome.typed), ("punched", outcome.punched), ("number", outcome.numbers)):
        for line in lines:
            print(f"{what:7} [{line}]")
    if outcome.trouble:
        print(f"stopped: {outcome.trouble}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
