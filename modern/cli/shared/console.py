"""How every command speaks: its exit code, its one line for an error, its notes on standard error.

OK: the run ended normally.  DIFFERS: a program typed DATA NOT ACCEPTABLE or ERROR IN PROGRAM and stopped there, ran
into the statement limit or out of bounds, or a result differs.  BAD_INPUT: said in one line.
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
"""A name with one place for a number, as printf has it: ``card-%03d.svg``."""
_INPUTS = ("program", "deck", "points", "volume", "scene", "name", "read")
_OUTPUTS = ("output", "punch", "typewriter", "trace", "json", "log", "csv")


class Parser(argparse.ArgumentParser):
    """Arguments of which an error is said in one line."""

    def error(self, message: str) -> None:  # type: ignore[override]
        """One line and exit 2, without the usage lines argparse would print first."""
        self.exit(BAD_INPUT, f"{self.prog}: {message} (try {self.prog} --help)\n")


def complain(message: str) -> None:
    """One line on standard error, whatever a file's name holds; nothing where there is no standard error."""
    if sys.stderr is not None:
        shown = "".join(c if c.isprintable() else repr(c)[1:-1] for c in message)
        with contextlib.suppress(OSError, ValueError):
            print(f"hull1620: {shown}", file=sys.stderr)


def say(lines: Iterable[str]) -> None:
    """Lines for the user, on standard error."""
    for line in lines:
        print(line, file=sys.stderr)


def counted(count: int, what: str) -> str:
    """``1 voxel``, ``2 voxels``."""
    return f"{count} {what}{'s' * (count != 1)}"


def check_numbered(pattern: str, what: str, example: str) -> None:
    """Refuse an output's name that has no place for a number.  Raises UsageError."""
    if not _NUMBERED.fullmatch(pattern):
        raise UsageError(f"--output: {pattern!r} has no place for a {what} as in {example!r}")


def check_outputs(args: argparse.Namespace) -> None:
    """Refuse an output that is an input, and an ending that the command does not write.  Raises UsageError."""
    given = vars(args)
    inputs = [given[name] for name in _INPUTS if isinstance(given.get(name), str)]
    outputs = [given[name] for name in _OUTPUTS if isinstance(given.get(name), str)]
    real = {os.path.realpath(name) for name in inputs if name != "-" and os.path.isfile(name)}
    for name in outputs:
        if name != "-" and os.path.realpath(name) in real:
            raise UsageError(f"{name}: is the input too; an output never overwrites it")
    # A table that a command prints instead goes into a file of any name.
    endings: tuple[str, ...] = () if given.get("table") else given.get("endings", ())
    output = given.get("output")
    if (
        endings
        and output not in (None, "-")
        and not os.path.isdir(output)
        and not str(output).lower().endswith(endings)
    ):
        raise UsageError(
            f"{output}: the name must end with {' or '.join(endings)}, which is what {args.command} writes"
        )
