"""Arguments of the command line, and the one place where errors become an exit code.

Exit 0: the run ended normally.  1: a program typed DATA NOT ACCEPTABLE or ERROR IN PROGRAM and stopped there,
ran into the statement limit or out of bounds, or a result differs.  2: bad input, said in one line.
"""

from __future__ import annotations

import argparse
import contextlib
import importlib
import os
import sys
from collections.abc import Sequence

OK, DIFFERS, BAD_INPUT = 0, 1, 2


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> None:  # type: ignore[override]
        """One line and exit 2, without the usage lines argparse would print first."""
        self.exit(BAD_INPUT, f"{self.prog}: {message} (try {self.prog} --help)\n")


def build_parser() -> argparse.ArgumentParser:
    """The argument parser; nothing heavy is imported here, so that ``--help`` is quick."""
    parser = _Parser(
        prog="hull1620",
        description="Karen Jensen Butler's convex hull programs of 1963, restored and run on an emulated IBM 1620.",
        epilog="PROGRAM.f is a file or one of program1, program2, program3, program1_examples. "
        "'-' is standard input or output.",
    )
    parser.add_argument(
        "--version", action="version", version=f"hull1620 {_version()}" if "--version" in sys.argv else ""
    )
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True, parser_class=_Parser)

    reproduce = _command(
        commands,
        "reproduce",
        "run the printed examples and judge every printed result",
        "modern.cli.reproduce",
    )
    reproduce.add_argument(
        "examples", metavar="EXAMPLE", nargs="*", help="1 to 6, a theorem (4.1, 4.2, 4.8) or a paper (default: all)"
    )
    reproduce.add_argument("--json", metavar="FILE", help="write the verdicts as JSON")

    run = _command(commands, "run", "run a FORTRAN program on the emulated 1620", "modern.cli.run")
    run.add_argument("program", metavar="PROGRAM.f")
    run.add_argument("deck", metavar="DECK", nargs="?", help="data cards, one a line")
    _machine_options(run)

    hull = _command(
        commands,
        "hull",
        "the hull of a data deck: program 1, then 2 or 3 as the typewriter says",
        "modern.cli.hull",
    )
    hull.add_argument("deck", metavar="DECK")
    hull.add_argument(
        "--programs",
        choices=("listing", "examples"),
        default="listing",
        help="which state of program 1 (default: listing)",
    )
    _machine_options(hull)

    cards = _command(commands, "cards", "points to a data deck", "modern.cli.cards")
    cards.add_argument("points", metavar="POINTS.csv", help="three decimal numbers a line")
    cards.add_argument("-o", "--output", metavar="DECK", default="-")
    cards.add_argument("--truncate", action="store_true", help="cut digits a card cannot hold instead of refusing them")

    diff = _command(
        commands, "diff", "one point set by the 1963 programs, the port and the exact hull", "modern.cli.diff"
    )
    diff.add_argument("points", metavar="POINTS", help="a data deck, CSV points x,y,z or an OFF file")
    diff.add_argument(
        "--epsilon", metavar="E", help="chapter 7's e for layer epsilon and the port; rel:E, for the port only"
    )
    diff.add_argument("--json", metavar="FILE", help="write the comparison as JSON")
    _layers(diff)

    export = _command(commands, "export", "the exact hull of points as a mesh or as JSON", "modern.cli.export")
    export.add_argument("points", metavar="POINTS", help="a data deck, CSV points x,y,z or an OFF file")
    export.add_argument(
        "-o", "--output", metavar="FILE", default="-", help="a name ending .off, .obj, .ply, .stl or .json"
    )
    export.add_argument(
        "--format", choices=("off", "obj", "ply", "stl", "json"), help="the format, where the name does not say it"
    )

    draw = _command(commands, "draw", "a line drawing of the exact hull of points, as SVG", "modern.cli.draw")
    draw.add_argument("points", metavar="POINTS", help="a data deck, CSV points x,y,z or an OFF file")
    draw.add_argument("-o", "--output", metavar="FILE.svg", default="-")
    draw.add_argument("--eye", metavar="X,Y,Z", help="the direction to the eye; write --eye=-1,2,3 before a minus")
    draw.add_argument("--title", metavar="TEXT", help="the line below the picture (default: the name of the file)")

    apparatus = _command(commands, "apparatus", "the emendations of the listings, row by row", "modern.cli.apparatus")
    apparatus.add_argument("--program", metavar="N", help="1, 2 or 3")
    apparatus.add_argument("--layer", metavar="L")
    apparatus.add_argument(
        "--check",
        action="store_true",
        help="prove that witness and rows build the decks, and that each row is needed",
    )

    storage = _command(commands, "map", "the storage map of a program", "modern.cli.storage")
    storage.add_argument("program", metavar="PROGRAM.f")
    storage.add_argument("--core", type=int, choices=(20000, 40000, 60000), default=40000)
    _layers(storage)

    compile_ = _command(commands, "compile", "the object code of a program", "modern.cli.listing")
    compile_.add_argument("program", metavar="PROGRAM.f")
    _layers(compile_)

    check = _command(commands, "check", "the compiler's messages for a program", "modern.cli.check")
    check.add_argument("program", metavar="PROGRAM.f")
    _layers(check)
    return parser


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; returns the exit code."""
    args = build_parser().parse_args(arguments)
    if sys.stdout is None:
        _complain("standard output is closed")
        return BAD_INPUT
    try:
        command = importlib.import_module(args.module)
        code: int = command.main(args)
        sys.stdout.flush()
        return code
    except BrokenPipeError:
        # The reader of a pipe has gone: not an error of ours, and nothing more can be said to it.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return OK
    except KeyboardInterrupt:
        _complain("interrupted")
        return 130
    except OSError as error:
        # What cannot be opened is said where it is known by name; this is an output that fails in mid-writing.
        _complain(f"cannot write: {(error.strerror or str(error)).lower()}")
        return BAD_INPUT
    except Exception as error:
        from emulator.errors import EmulatorError
        from modern.edition.apparatus import ApparatusError

        if isinstance(error, EmulatorError | ApparatusError):
            _complain(str(error))
            return BAD_INPUT
        raise


def _complain(message: str) -> None:
    """One line on standard error, whatever a file's name holds; nothing where there is no standard error."""
    if sys.stderr is not None:
        shown = "".join(c if c.isprintable() else repr(c)[1:-1] for c in message)
        with contextlib.suppress(OSError, ValueError):
            print(f"hull1620: {shown}", file=sys.stderr)


def _version() -> str:
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version("hull1620")
    except PackageNotFoundError:
        return "(not installed)"


def _command(
    commands: argparse._SubParsersAction[_Parser], name: str, help_: str, module: str
) -> argparse.ArgumentParser:
    parser = commands.add_parser(name, help=help_, description=help_[0].upper() + help_[1:] + ".")
    parser.set_defaults(module=module)
    return parser


def _layers(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--layers",
        metavar="LAYER,...",
        default="",
        help="layers of the apparatus added to a built-in program",
    )


def _machine_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--punch", metavar="FILE", default="-", help="where punched cards go (default: standard output)"
    )
    parser.add_argument("--typewriter", metavar="FILE", help="where typed lines go (default: standard error)")
    parser.add_argument(
        "--switch",
        metavar="N",
        type=int,
        action="append",
        choices=(1, 2, 3, 4),
        default=[],
        help="sense switch N on",
    )
    parser.add_argument(
        "--arithmetic",
        metavar="NAME",
        default="truncating",
        help="truncating, ibm1962, truncating:P or rounding:P",
    )
    parser.add_argument(
        "--core", type=int, choices=(20000, 40000, 60000), default=40000, help="positions of core storage"
    )
    parser.add_argument(
        "--bounds",
        choices=("strict", "core"),
        default="strict",
        help="a subscript out of bounds: stop, or use the neighbour's place as the machine did",
    )
    parser.add_argument(
        "--limit", metavar="N", type=int, default=5_000_000, help="stop after N statements (default: 5000000)"
    )
    parser.add_argument(
        "--profile",
        action="store_true",
        help="count statements and operations, and give the time on the 1620",
    )
    parser.add_argument("--trace", metavar="FILE", help="write every statement with its card and values")
    _layers(parser)


if __name__ == "__main__":
    sys.exit(main())
