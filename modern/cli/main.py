"""Parse the command line, call the command, and turn errors into one line and an exit code."""

import gc
import importlib
import io
import os
import signal
import sys
from collections.abc import Sequence

from emulator.errors import EmulatorError
from modern.cli.arguments import COMMANDS
from modern.cli.shared.arguments import complete
from modern.cli.shared.console import BAD_INPUT, OK, Parser, check_outputs, misses_numpy, print_error, version


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command and return its exit code.

    arguments: the arguments after ``hull1620``; by default those of the process.
    """
    if "_ARGCOMPLETE" in os.environ:
        complete(build_parser())
    tokens = sys.argv[1:] if arguments is None else list(arguments)
    # Argparse must not read the word after --operator as its value, because the option is complete without one.
    tokens = ["--operator=" if word == "--operator" else word for word in tokens]
    # Most objects of a command live until its end, so searching for garbage after every 700 of them wastes time.
    gc.set_threshold(300_000)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            # File names and cards may contain characters that the terminal cannot show.
            stream.reconfigure(errors="backslashreplace")
    # Until here Ctrl-C ends the process at once (hull1620/__main__.py); from here on it raises KeyboardInterrupt.
    handles_interrupt = signal.getsignal(signal.SIGINT) is signal.SIG_DFL
    if handles_interrupt:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    code = BAD_INPUT
    try:
        code = _call(tokens)
        if sys.stdout is not None:
            sys.stdout.flush()
    except BrokenPipeError:
        # The program that reads the pipe has closed it, as head does.
        code = OK
    except KeyboardInterrupt:
        print_error("interrupted")
        code = 130
    except MemoryError:
        print_error("not enough memory")
    except OSError as error:
        # A file that cannot be opened raises FileError with its name; here, writing to an open output failed.
        code = BAD_INPUT
        print_error(f"cannot write: {(error.strerror or str(error)).lower()}")
    except EmulatorError as error:
        print_error(str(error))
    finally:
        if handles_interrupt:
            signal.signal(signal.SIGINT, signal.SIG_DFL)
    for stream in (sys.stdout, sys.stderr):
        try:
            if stream is not None:
                stream.flush()
        except OSError as error:
            # Send the rest of the stream to the null device; otherwise Python would fail again when it exits.
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
            code = code if isinstance(error, BrokenPipeError) else BAD_INPUT
    return code


def _call(tokens: Sequence[str]) -> int:
    try:
        args, unknown = build_parser(tokens).parse_known_args(tokens)
    except SystemExit as end:
        return int(end.code or OK)
    if unknown:
        command = f"hull1620 {args.command}"
        print_error(f"unrecognized arguments: {' '.join(unknown)} (try {command} --help)", command)
        return BAD_INPUT
    if sys.stdout is None:
        print_error("standard output is closed")
        return BAD_INPUT
    check_outputs(args)
    try:
        module = importlib.import_module(f"modern.cli.{args.command.replace('-', '_')}")
        return int(module.main(args))
    except ModuleNotFoundError as error:
        if not misses_numpy(error):
            raise
        print_error("this needs numpy, which is not installed (pip install numpy)", f"hull1620 {args.command}")
        return BAD_INPUT


def build_parser(tokens: Sequence[str] = ()) -> Parser:
    """Return the parser of the command that the first token names, or of all commands if no token names one."""
    parser = Parser(
        prog="hull1620",
        description="Run Karen Jensen Butler's convex hull programs of 1963 on an emulated IBM 1620, find exact hulls, "
        "study numerical errors, and run the algorithms of four later papers.",
        epilog="PROGRAM.f is a file, or one of program1, program2 and program3 (the listings of the thesis) and "
        "program1_examples (program 1 as it ran the examples of the thesis). "
        "'-' means standard input or standard output.",
    )
    parser.add_argument("--version", action="version", version=f"hull1620 {version()}" if "--version" in tokens else "")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True, parser_class=Parser)
    # Building every parser takes time; all of them are needed only for --help and for unknown commands.
    for name in tokens[:1] if tokens and tokens[0] in COMMANDS else COMMANDS:
        summary, add_arguments = COMMANDS[name]
        description = summary[0].upper() + summary[1:] + "."
        add_arguments(commands.add_parser(name, help=summary, description=description))
    return parser


if __name__ == "__main__":
    sys.exit(main())
