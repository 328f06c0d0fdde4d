"""The commands, and the one place where one is called and errors become an exit code."""

from __future__ import annotations

import gc
import importlib
import io
import os
import signal
import sys
from collections.abc import Sequence

from emulator.errors import EmulatorError
from modern.cli.arguments import COMMANDS
from modern.cli.shared.console import BAD_INPUT, OK, Parser, check_outputs, complain


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; returns the exit code."""
    words = sys.argv[1:] if arguments is None else list(arguments)
    # The option is complete by itself; what follows it is no value of it.
    words = ["--operator=" if word == "--operator" else word for word in words]
    # A command makes many objects that live to its end: looking for unused ones after every 700 is time lost.
    gc.set_threshold(100_000)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            # A name or a card may hold what a terminal of few characters cannot show.
            stream.reconfigure(errors="backslashreplace")
    # The command's own start (hull1620/__main__.py) leaves Ctrl-C to end the process; from here on it is an exception.
    started = signal.getsignal(signal.SIGINT) is signal.SIG_DFL
    if started:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        args = build_parser(words).parse_args(words)
        if sys.stdout is None:
            complain("standard output is closed")
            return BAD_INPUT
        check_outputs(args)
        code: int = importlib.import_module(f"modern.cli.{args.command.replace('-', '_')}").main(args)
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
    finally:
        if started:
            signal.signal(signal.SIGINT, signal.SIG_DFL)


def build_parser(words: Sequence[str]) -> Parser:
    """The parser of these words: of the one command that is called, or of all."""
    parser = Parser(
        prog="hull1620",
        description="Karen Jensen Butler's convex hull programs of 1963, restored and run on an emulated IBM 1620; "
        "exact hulls, studies of numerical error, and four later papers.",
        epilog="PROGRAM.f is a file or one of program1, program2, program3, program1_examples. "
        "'-' is standard input or output.",
    )
    parser.add_argument("--version", action="version", version=f"hull1620 {_version()}" if "--version" in words else "")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True, parser_class=Parser)
    # Only the command that is called needs its parser; the list of all is for --help and for names there are not.
    for name in words[:1] if words and words[0] in COMMANDS else COMMANDS:
        says, arguments = COMMANDS[name]
        arguments(commands.add_parser(name, help=says, description=says[0].upper() + says[1:] + "."))
    return parser


def parser_of_all() -> Parser:
    """Return the parser of every command, which the reference of the commands is made from."""
    return build_parser([])


def _version() -> str:
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version("hull1620")
    except PackageNotFoundError:
        return "(not installed)"


if __name__ == "__main__":
    sys.exit(main())
