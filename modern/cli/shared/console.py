"""What all commands share: exit codes, error messages, notes on standard error, and checks of outputs.

The exit code OK means that the run ended normally.  DIFFERS means that a result differs, or that a program stopped
after typing DATA NOT ACCEPTABLE or ERROR IN PROGRAM, reached the limit of its work, or used a subscript out of bounds.
BAD_INPUT means that the input is invalid.  One line on standard error then explains the error.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import re
import sys
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, TextIO

from emulator.errors import EmulatorError, FileError, quoted

if TYPE_CHECKING:
    from _typeshed import SupportsWrite

OK, DIFFERS, BAD_INPUT = 0, 1, 2


class UsageError(EmulatorError):
    """Raised for options or arguments that are invalid or cannot be combined; the message names the option."""


class InputFile(str):
    """An argument that names a file to read."""


class OutputFile(str):
    """An argument that names a file to write."""


class Folder(str):
    """An argument that names a folder to write to."""


# A file name with one place for a number in the notation of printf: ``card-%03d.svg``.
_NUMBERED = re.compile(r"(?:[^%]|%%)*%(?:0?[1-9])?d(?:[^%]|%%)*")
# Matches a long text that a message quotes from the input: text in quotation marks, or text without a blank.
_LONG = re.compile(r"(?<!\w)'(?:[^'\\]|\\.){120,}'|\S{200,}")


class Parser(argparse.ArgumentParser):
    """A parser that reports an error in one line."""

    def error(self, message: str) -> None:  # type: ignore[override]
        """Print one line and exit with 2, without the usage lines of argparse."""
        print_error(f"{message} (try {self.prog} --help)", self.prog)
        self.exit(BAD_INPUT)

    def _print_message(self, message: str, file: SupportsWrite[str] | None = None) -> None:
        """Write a message, and raise OSError if the output cannot be written; argparse would ignore that error."""
        if stream := file or sys.stderr:
            stream.write(message)


def print_error(message: str, source: str = "hull1620") -> None:
    """Print one line on standard error, if standard error is open.

    Control characters, which the name of a file may contain, are escaped, and long texts of the input are shortened.
    """
    if sys.stderr is not None:
        message = _LONG.sub(lambda match: f"{match[0][:80]}...{match[0][-20:]}", message)
        text = "".join(c if c.isprintable() else repr(c)[1:-1] for c in message)
        with contextlib.suppress(OSError, ValueError):
            print(f"{source}: {text}", file=sys.stderr)


def print_notes(lines: Iterable[str]) -> None:
    """Print lines on standard error."""
    for line in lines:
        print(line, file=sys.stderr)


def report_stream(args: argparse.Namespace) -> TextIO:
    """Return the stream of a command's report: standard error if the command writes data to standard output."""
    outputs = (vars(args).get(name) for name in ("json", "csv", "html", "samples", "output"))
    return sys.stderr if "-" in outputs else sys.stdout


def print_report(args: argparse.Namespace, lines: Iterable[str]) -> None:
    """Print the lines of a report to the stream that ``report_stream`` returns."""
    for line in lines:
        print(line, file=report_stream(args))


def write_folder(folder: str, texts: Mapping[str, str], encoding: str = "ascii") -> None:
    """Write a file for each name and text to a folder, which is made if missing.  Raise FileError if that fails."""
    from emulator.files import reason, writing_bytes  # imported here because --help does not need it

    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        raise FileError(f"{folder}: {reason(error)}") from None
    for name, text in texts.items():
        with writing_bytes(os.path.join(folder, name)) as file:
            file.write(text.encode(encoding, "backslashreplace"))


def misses_numpy(error: ModuleNotFoundError) -> bool:
    """Return True if a module could not be imported because numpy is not installed."""
    return (error.name or "").partition(".")[0] == "numpy"


def version() -> str:
    """Return the version of the installed project."""
    from importlib import metadata  # imported here because few commands need it

    try:
        return metadata.version("hull1620")
    except metadata.PackageNotFoundError:
        return "(not installed)"


def write_json(args: argparse.Namespace, document: object) -> None:
    """Write a document to the file of ``--json``, if the option is given."""
    import json

    from emulator.files import write_text

    if args.json is not None:
        write_text(args.json, json.dumps(document, indent=1) + "\n")


def counted(count: int, noun: str) -> str:
    """Return a count and its noun, in the singular or the plural: ``1 voxel`` or ``2 voxels``."""
    return f"{count} {noun}{'s' * (count != 1)}"


def check_numbered(pattern: str, noun: str, example: str) -> None:
    """Raise UsageError unless the name of an output has a placeholder for a number, such as a label or a card."""
    if not _NUMBERED.fullmatch(pattern):
        raise UsageError(f"--output: {quoted(pattern)} has no place for a {noun}; write a name such as {example!r}")


def check_one_standard_input(args: argparse.Namespace) -> None:
    """Raise UsageError if program and deck are both to be read from standard input."""
    if args.program == "-" and args.deck == "-":
        raise UsageError("program and deck cannot both come from standard input; name a file for one of them")


def check_outputs(args: argparse.Namespace) -> None:
    """Check all outputs of a command before it begins to work.

    Raise UsageError if an output would overwrite an input, or if its name ends with an unsupported format.  Raise
    FileError if an output cannot be written.
    """
    from emulator.files import check_folder, check_writable  # imported here because --help does not need it

    values = vars(args)
    inputs = {
        os.path.realpath(name) for name in values.values() if isinstance(name, InputFile) and os.path.isfile(name)
    }
    outputs = [name for name in values.values() if isinstance(name, OutputFile)]
    for name in outputs:
        if name != "-" and os.path.realpath(name) in inputs:
            raise UsageError(f"{name}: this output is also an input, which would be overwritten; choose another name")
    # The text table of flowchart --table may have any name.
    endings: tuple[str, ...] = () if values.get("table") else values.get("endings", ())
    output = values.get("output") or "-"
    if endings and output != "-" and not os.path.isdir(output) and not output.lower().endswith(endings):
        raise UsageError(f"{output}: {args.command} expects a name that ends with {' or '.join(endings)}")
    check_writable(*outputs)
    for folder in values.values():
        if isinstance(folder, Folder):
            check_folder(folder)
