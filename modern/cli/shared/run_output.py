"""Write the output of a run: punched cards, typed lines, notes, the trace, and the profile of its time."""

import argparse
import sys
import textwrap
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from itertools import groupby
from operator import attrgetter
from typing import TextIO

from emulator.errors import FileError
from emulator.files import reason, write_text, writing
from emulator.language.objectcode import Program
from emulator.machine.operator import Output
from emulator.machine.result import Event, Result
from emulator.machine.timing import Time, measure
from emulator.machine.trace import Tracer
from emulator.machine.words import notes
from emulator.objectdeck.extent import extent
from modern.cli.shared.console import print_notes

_MOST_STATEMENTS = 10


def is_terminal(stream: TextIO | None) -> bool:
    """Return True if a standard stream is open and goes to a terminal."""
    return stream is not None and stream.isatty()


def write_outputs(args: argparse.Namespace, punched: Iterable[str], typed: Iterable[str]) -> None:
    """Write cards to ``--punch`` or standard output, and typed lines to ``--typewriter`` or standard error."""
    typed_text = "".join(line + "\n" for line in typed)
    if args.typewriter is not None:
        write_text(args.typewriter, typed_text)
    else:
        sys.stderr.write(typed_text)
        sys.stderr.flush()
    write_text(args.punch, "".join(card + "\n" for card in punched))


def print_run(
    args: argparse.Namespace, program: Program, result: Result, reported: Collection[tuple[int, int]] = ()
) -> None:
    """Print the notes on a run, its profile if the user gave ``--profile``, and its ending if it is not normal.

    reported: the card and column of each field whose note has already been printed.
    """
    overlap = extent(program).overlap(args.core)
    print_notes([f"warning: {program.source}: {overlap}"] if overlap else [])
    print_notes(notes(program, result, reported))
    if args.profile:
        print_notes(profile_lines(program, result))
    print_ending(result)


def print_ending(result: Result) -> None:
    """Print how a run ended, unless it ended normally.  If a subscript was out of bounds, mention ``--bounds core``."""
    if not result.ending.normal:
        advice = (
            "; --bounds core reads the neighbouring field, as the machine did" if result.ending.kind == "bounds" else ""
        )
        print_notes([f"hull1620: {result.ending.message}{advice}"])


class _StreamError(Exception):
    """Raised instead of a standard stream's OSError, which ``writing`` would report as an error of a named file."""

    def __init__(self, error: OSError) -> None:
        super().__init__()
        self.error = error


class _Destination:
    """A file that receives lines, or a standard stream if ``path`` is empty."""

    def __init__(self, path: str, file: TextIO | None) -> None:
        self._path, self._file = path, file

    def write(self, text: str) -> None:
        """Write text.  A standard stream shows the text at once; a closed standard stream ignores it."""
        if self._file is None:
            return
        try:
            self._file.write(text)
            if not self._path:
                self._file.flush()
        except OSError as error:
            if self._path:
                raise FileError(f"{self._path}: {reason(error)}") from None
            raise _StreamError(error) from None


@contextmanager
def streaming(args: argparse.Namespace, show: Callable[[str], None] | None = None) -> Iterator[Output]:
    """Yield a function that writes the events of a run as they occur: cards to ``--punch``, lines to ``--typewriter``.

    show: a function that shows a typed line to an operator at the terminal, or None.  With ``show``, typed lines are
    not repeated on standard error if standard error is a terminal.  A named file is written completely at the end of
    the run, and an exception leaves an existing file unchanged.  Raise FileError if a file cannot be written.
    """

    def destination(path: str | None) -> _Destination:
        if path is None or path == "-":
            return _Destination("", sys.stdout if path else sys.stderr)
        return _Destination(path, stack.enter_context(writing(path)))

    def write_events(events: Sequence[Event]) -> None:
        for kind, group in groupby(events, key=attrgetter("what")):
            lines = [event.text for event in group]
            if kind in destinations:
                destinations[kind].write("".join(line + "\n" for line in lines))
            if kind == "type" and show is not None:
                for line in lines:
                    show(line)

    try:
        with ExitStack() as stack:
            destinations = {"punch": destination(args.punch)}
            if show is None or args.typewriter is not None or not is_terminal(sys.stderr):
                destinations["type"] = destination(args.typewriter)
            yield write_events
    except _StreamError as stream_error:
        raise stream_error.error from None


@contextmanager
def tracing(path: str | None) -> Iterator[Tracer | None]:
    """Yield a tracer that writes the trace of a run to ``path``, or None without a path."""
    if not path:
        yield None
        return
    with writing(path) as file:
        tracer = Tracer(file)
        try:
            yield tracer
        finally:
            tracer.close()


def profile_lines(program: Program, result: Result) -> Iterator[str]:
    """Yield the profile of a run in at most 80 columns: the time by cause, and the most frequent statements."""
    timing = measure(program, result)
    yield f"{program.source}: {result.statements} statements; time on a 1620 Model 1:"
    yield f"  {'cause':<20}{'count':>9}{'seconds':>11}  with bounds of the systematic error"
    for row in timing.processor:
        yield _profile_row(row.cause, str(row.count), row.time) + ("  ~" if row.estimated else "")
    yield _profile_row("processor", "", timing.processor_time)
    for row in timing.devices:
        yield _profile_row(row.cause, str(row.count), row.time)
    yield _profile_row("sum", "", timing.time) + ", less with overlap"
    if any(row.estimated for row in timing.processor):
        yield "  ~ includes estimated times, which no source states"
    operations = "operations: " + ", ".join(f"{name} {count}" for name, count in timing.operations)
    yield from textwrap.wrap(operations, 80, initial_indent="  ", subsequent_indent="    ")
    most_frequent = sorted(timing.statements, key=lambda pair: -pair[1])[:_MOST_STATEMENTS]
    yield f"  most frequent statements, of {len(timing.statements)} that ran:"
    for index, count in most_frequent:
        line = program.statements[index]
        yield f"  {count:>9}  card {line.place.card:>3} {line.label or '':>5} {line.text[:50]}"


def _profile_row(cause: str, count: str, time: Time) -> str:
    return f"  {cause:<20}{count:>9}{time.seconds:>11.1f}" + f"  ({time.interval})" * (time.seconds > 0)
