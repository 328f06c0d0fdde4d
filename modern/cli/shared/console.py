"""The interface to the user that all commands share: exit codes, error lines, and notes on standard error.

OK: the run ended normally.  DIFFERS: a result differs, or a program stopped after typing DATA NOT ACCEPTABLE or ERROR
IN PROGRAM, reached the statement limit, or used a subscript out of bounds.  BAD_INPUT: the input is invalid, which one
line on standard error explains.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import re
import sys
from collections.abc import Iterable

from emulator.errors import EmulatorError

OK, DIFFERS, BAD_INPUT = 0, 1, 2


class UsageError(EmulatorError):
    """Options or arguments that cannot be carried out; the message names the option."""


_NUMBERED = re.compile(r"(?:[^%]|%%)*%(?:0?[1-9])?d(?:[^%]|%%)*")
"""A file name with one place for a number in the notation of printf: ``card-%03d.svg``."""
_INPUTS = ("program", "deck", "points", "volume", "scene", "name", "read")
_OUTPUTS = ("output", "punch", "typewriter", "trace", "json", "log", "csv")


class Parser(argparse.ArgumentParser):
    """A parser that reports an error in one line."""

    def error(self, message: str) -> None:  # type: ignore[override]
        """Print one line and exit with 2, without the usage lines of argparse."""
        self.exit(BAD_INPUT, f"{self.prog}: {message} (try {self.prog} --help)\n")


def print_error(message: str) -> None:
    """Print one line on standard error, if it is open; escape control characters, which a file's name may contain."""
    if sys.stderr is not None:
        text = "".join(c if c.isprintable() else repr(c)[1:-1] for c in message)
        with contextlib.suppress(OSError, ValueError):
            print(f"hull1620: {text}", file=sys.stderr)


def print_notes(lines: Iterable[str]) -> None:
    """Print lines on standard error."""
    for line in lines:
        print(line, file=sys.stderr)


def counted(count: int, noun: str) -> str:
    """Return ``1 voxel`` or ``2 voxels``."""
    return f"{count} {noun}{'s' * (count != 1)}"


def check_numbered(pattern: str, noun: str, example: str) -> None:
    """Raise UsageError if the name of an output has no place for a number."""
    if not _NUMBERED.fullmatch(pattern):
        raise UsageError(f"--output: {pattern!r} has no place for a {noun}; write a name such as {example!r}")


def check_one_standard_input(args: argparse.Namespace) -> None:
    """Raise UsageError if program and deck are both to be read from standard input."""
    if args.program == "-" and args.deck == "-":
        raise UsageError("program and deck cannot both come from standard input; name a file for one of them")


def check_outputs(args: argparse.Namespace) -> None:
    """Raise UsageError if an output would overwrite an input, or if its name ends with an unsupported format."""
    values = vars(args)
    inputs = [values[name] for name in _INPUTS if isinstance(values.get(name), str)]
    outputs = [values[name] for name in _OUTPUTS if isinstance(values.get(name), str)]
    input_paths = {os.path.realpath(name) for name in inputs if name != "-" and os.path.isfile(name)}
    for name in outputs:
        if name != "-" and os.path.realpath(name) in input_paths:
            raise UsageError(f"{name}: this output is also an input, which would be overwritten; choose another name")
    # The text table of flowchart --table may have any name.
    endings: tuple[str, ...] = () if values.get("table") else values.get("endings", ())
    output = values.get("output")
    if not endings or output in (None, "-") or os.path.isdir(str(output)):
        return
    if not str(output).lower().endswith(endings):
        raise UsageError(f"{output}: {args.command} expects a name that ends with {' or '.join(endings)}")
