"""The commands, and the one place where one is called and errors become an exit code."""

from __future__ import annotations

import importlib
import io
import os
import sys
from collections.abc import Sequence

from emulator.errors import EmulatorError
from modern.cli.shared.console import BAD_INPUT, OK, Parser, complain

COMMANDS = {
    "reproduce": "what the thesis and the later papers print, computed, with a verdict on every result",
    "run": "run a FORTRAN program on the emulated 1620",
    "hull": "the hull of a data deck: program 1, then 2 or 3 as the typewriter says",
    "cards": "points to a data deck",
    "diff": "one point set by the 1963 programs, the port and the exact hull",
    "diverge": "run a program over two arithmetics and name the first value and the first decision that differ",
    "study": "many samples, each judged: a table, a plot and plain words",
    "export": "the exact hull of points as a mesh or as JSON",
    "draw": "a line drawing of the exact hull of points, as SVG",
    "appel-will": "the hull of a polyhedron from its convex edges, by Appel & Will",
    "hidden-line": "convex polyhedra without their hidden lines, by Nakamae & Nishita",
    "voxel-hull": "the hull of a voxel solid by Kovalevsky and Schulz, or its filled digital hull",
    "octree-hull": "the digital hull of a voxel solid from its octree, by Yau and Srihari",
    "apparatus": "the emendations of the listings, row by row",
    "check": "the compiler's messages for a program",
    "map": "the storage map of a program",
    "compile": "the object code of a program",
    "bench": "the speed of the engines side by side",
}
"""Every command, named as its module but for - instead of _, and what ``--help`` says of it.

A command's module defines ``arguments(parser)`` and ``main(args)``, which returns the exit code; it is imported when
the command is called, so that ``--help`` is quick.
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; returns the exit code."""
    words = sys.argv[1:] if arguments is None else list(arguments)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            # A name or a card may hold what a terminal of few characters cannot show.
            stream.reconfigure(errors="backslashreplace")
    try:
        args = build_parser(words).parse_args(words)
        if sys.stdout is None:
            complain("standard output is closed")
            return BAD_INPUT
        code: int = args.main(args)
        sys.stdout.flush()
        return code
    except BrokenPipeError:
        # The reader of a pipe has gone: not an error of ours, and nothing more can be said to it.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return OK
    except KeyboardInterrupt:
        complain("interrupted")
        return 130
    except MemoryError:
        complain("there is not enough memory for this")
        return BAD_INPUT
    except OSError as error:
        # What cannot be opened is said where it is known by name; this is an output that fails in mid-writing.
        complain(f"cannot write: {(error.strerror or str(error)).lower()}")
        return BAD_INPUT
    except EmulatorError as error:
        complain(str(error))
        return BAD_INPUT


def build_parser(words: Sequence[str]) -> Parser:
    """The parser of these words: of all commands, with the arguments of the one that is called."""
    parser = Parser(
        prog="hull1620",
        description="Karen Jensen Butler's convex hull programs of 1963, restored and run on an emulated IBM 1620; "
        "exact hulls, studies of numerical error, and four later papers.",
        epilog="PROGRAM.f is a file or one of program1, program2, program3, program1_examples. "
        "'-' is standard input or output.",
    )
    parser.add_argument("--version", action="version", version=f"hull1620 {_version()}" if "--version" in words else "")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True, parser_class=Parser)
    called = next((word for word in words if not word.startswith("-")), "")
    for name, words_of in COMMANDS.items():
        command = commands.add_parser(name, help=words_of, description=words_of[0].upper() + words_of[1:] + ".")
        if name == called:
            module = importlib.import_module(f"modern.cli.{name.replace('-', '_')}")
            module.arguments(command)
            command.set_defaults(main=module.main)
    return parser


def _version() -> str:
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version("hull1620")
    except PackageNotFoundError:
        return "(not installed)"


if __name__ == "__main__":
    sys.exit(main())
