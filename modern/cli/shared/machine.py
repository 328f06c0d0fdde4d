"""A program and a machine to run it: their arguments, what they put out, and the profile of a run."""

from __future__ import annotations

import argparse
import os
import sys
import textwrap
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from itertools import groupby
from operator import attrgetter
from typing import TextIO

from emulator.errors import FileError, LowerCaseError
from emulator.files import read_text, reason, source_name, write_text, writing
from emulator.language import objectcode as op
from emulator.language.cards import Deck, read_deck
from emulator.language.compiler import compile_deck
from emulator.language.objectcode import Program
from emulator.language.statements import capitals
from emulator.machine.operator import FromFile, Logged, Operator, Output
from emulator.machine.result import Event, Options, Result
from emulator.machine.timing import Row, measure
from emulator.machine.trace import Tracer
from emulator.machine.words import notes
from emulator.numbers import DecimalNumbers, Numbers, numbers
from emulator.numbers.arithmetic import Rules
from emulator.numbers.base import lossless_rules
from emulator.numbers.fields import FALLBACK
from modern.cli.shared.console import UsageError, say
from modern.edition import programs

_MOST_RUN = 10


def layers_of(args: argparse.Namespace) -> tuple[str, ...]:
    """The layers asked for by ``--layers``."""
    return tuple(layer.strip() for layer in args.layers.split(",") if layer.strip())


def source_deck(name: str, layers: tuple[str, ...], upcase: bool = False) -> Deck:
    """A source deck: a built-in program by name, else a file, with capitals for small letters if ``upcase``.

    Raises UsageError for layers with a file (only the built-in programs have an apparatus) and for small letters.
    """
    if name in programs.NAMES:
        return programs.deck(name, layers)
    if layers:
        raise UsageError(f"{name}: --layers is for the built-in programs: {', '.join(programs.NAMES)}")
    try:
        return read_deck(name, capitals if upcase else None)
    except LowerCaseError as error:
        raise UsageError(f"{error}; --upcase reads the whole program so") from None


def load_program(name: str, layers: tuple[str, ...], upcase: bool = False) -> Program:
    """A program compiled: a built-in by name, else a file."""
    if name in programs.NAMES:
        return programs.program(name, layers)
    return compile_deck(source_deck(name, layers, upcase))


def machine_options(args: argparse.Namespace) -> Options:
    """The machine the options describe.  Raises UsageError for an unknown arithmetic or a limit below 1."""
    found = number_system(args.arithmetic, "--arithmetic")
    if args.limit < 1:
        raise UsageError(f"--limit: {args.limit} is not a number of statements")
    return Options(found, frozenset(args.switch), args.core, args.bounds, args.limit)


def number_system(name: str, option: str) -> Numbers:
    """An arithmetic by name.  Raises UsageError, which names the option."""
    try:
        return numbers(name)
    except ValueError as error:
        raise UsageError(f"{option}: {error}") from None


def card_rules(options: Options) -> Rules:
    """How many digits of a card's field the machine takes: all of them where its numbers are not decimal."""
    numbers = options.numbers
    return numbers.profile.rules if isinstance(numbers, DecimalNumbers) else lossless_rules(FALLBACK.width)


def put_out(args: argparse.Namespace, punched: Iterable[str], typed: Iterable[str]) -> None:
    """Cards to ``--punch`` or standard output, typed lines to ``--typewriter`` or standard error."""
    typed_text = "".join(line + "\n" for line in typed)
    if args.typewriter is not None:
        write_text(args.typewriter, typed_text)
    else:
        sys.stderr.write(typed_text)
        sys.stderr.flush()
    write_text(args.punch, "".join(card + "\n" for card in punched))


def say_notices(program: Program, result: Result, said: Collection[tuple[int, int]] = ()) -> None:
    """What is to be noted of a run, but for fields (card and column) said before, and its arithmetic's error codes."""
    say(notes(program, result, said))


class _Lost(Exception):
    """A standard stream takes no more: not an OSError on its way, so that no named file is blamed for it."""

    def __init__(self, error: OSError) -> None:
        super().__init__()
        self.error = error


class _Outlet:
    """A file, or a standard stream where ``path`` is empty, that takes lines."""

    def __init__(self, path: str, file: TextIO | None) -> None:
        self._path, self._file = path, file

    def put(self, text: str) -> None:
        """Write; a standard stream shows it at once, where there is one."""
        if self._file is None:
            return
        try:
            self._file.write(text)
            if not self._path:
                self._file.flush()
        except OSError as error:
            if self._path:
                raise FileError(f"{self._path}: {reason(error)}") from None
            raise _Lost(error) from None


@contextmanager
def streaming(args: argparse.Namespace, show: Callable[[str], None] | None = None) -> Iterator[Output]:
    """Where a run's events go as they come: cards as ``--punch`` says, typed lines as ``--typewriter`` does.

    ``show`` is a terminal's way to show a line typed; standard error, where it is a terminal too, then shows none.  A
    named file appears, whole, when the run is over; an exception leaves it as it was.  Raises FileError.
    """

    def outlet(path: str | None) -> _Outlet:
        if path is None or path == "-":
            return _Outlet("", sys.stdout if path else sys.stderr)
        return _Outlet(path, stack.enter_context(writing(path)))

    def put(events: Sequence[Event]) -> None:
        for what, group in groupby(events, key=attrgetter("what")):
            texts = [event.text for event in group]
            if what in outlets:
                outlets[what].put("".join(text + "\n" for text in texts))
            if what == "type" and show is not None:
                for text in texts:
                    show(text)

    try:
        with ExitStack() as stack:
            outlets = {"punch": outlet(args.punch)}
            if show is None or args.typewriter is not None or not is_terminal(sys.stderr):
                outlets["type"] = outlet(args.typewriter)
            yield put
    except _Lost as lost:
        raise lost.error from None


@dataclass(frozen=True)
class Attended:
    """Who operates a run; ``show`` is his terminal's way to show a line typed, if he sits at one."""

    operator: Operator
    show: Callable[[str], None] | None
    file: FromFile | None

    def say_left(self) -> None:
        """Say it where lines of an operator's file were not used."""
        if self.file is not None and self.file.first_unused:
            say([f"note: {self.file.name}: line {self.file.first_unused} and what follows it was not used"])


@contextmanager
def attended(args: argparse.Namespace, program: Program | None = None) -> Iterator[Attended]:
    """The operator that ``--operator`` names, and his ``--log``; ``program`` is one that may ask for him unnamed.

    A program without an operator types the lines of standard input, if that is neither a deck nor a terminal.  Raises
    UsageError, and FileError for a file that is no operator's.
    """
    name: str | None = args.operator
    inputs = [getattr(args, "program", None), args.deck]
    with ExitStack() as stack:
        file: FromFile | None = None
        show: Callable[[str], None] | None = None
        operator: Operator
        if name == "" or (name is None and program is not None and _asks(args, program)):
            from modern.cli.shared.terminal import terminal

            person = stack.enter_context(terminal(args.slow, waits=name is not None))
            operator, show = person, person.show
        elif name is not None and name != "none":
            if name == "-" and "-" in inputs:
                raise UsageError("--operator: standard input is the program or the deck")
            operator = file = FromFile(source_name(name), read_text(name))
        else:
            lies = program is not None and "-" not in inputs and sys.stdin is not None and not sys.stdin.isatty()
            operator = Operator(sys.stdin if lies else ())
        if args.slow and show is None:
            raise UsageError("--slow: nobody sits at a terminal; --operator has the run talk to it")
        if args.log is not None:
            operator = Logged(operator, stack.enter_context(writing(args.log)))
        yield Attended(operator, show, file)


def _asks(args: argparse.Namespace, program: Program) -> bool:
    """Whether somebody sits at the terminal whom the program has something to ask."""
    if not (args.deck and os.path.isfile(args.deck)):
        return False
    if not all(map(is_terminal, (sys.stdin, sys.stdout, sys.stderr))):
        return False
    return "ACCEPT" in program.verbs or any(i.operation == op.PAUSE for i in program.code)


def is_terminal(stream: TextIO | None) -> bool:
    """Whether a standard stream is there and goes to a terminal."""
    return stream is not None and stream.isatty()


@contextmanager
def tracing(path: str | None) -> Iterator[Tracer | None]:
    """A tracer that writes to ``path``, or None; the file appears, whole, when the run is over."""
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
    """Lines no wider than 80 columns."""
    timing = measure(program, result)
    yield f"{program.source}: {result.statements} statements; time on a 1620 Model 1:"
    yield f"  {'cause':<20}{'count':>9}{'seconds':>11}"
    for row in timing.processor:
        yield _timed(row)
    yield f"  {'processor':<20}{'':>9}{timing.processor_seconds:>11.1f}"
    for row in timing.devices:
        yield _timed(row)
    yield f"  {'all, one by one':<20}{'':>9}{timing.seconds:>11.1f}  (reader and punch may run beside)"
    if any(row.estimated for row in timing.processor):
        yield "  ~ contains times that are estimates (no source gives them)"
    operations = "operations: " + ", ".join(f"{name} {count}" for name, count in timing.operations)
    yield from textwrap.wrap(operations, 80, initial_indent="  ", subsequent_indent="    ")
    most = sorted(timing.statements, key=lambda pair: -pair[1])[:_MOST_RUN]
    yield f"  statements run most (of {len(timing.statements)} that ran):"
    for index, count in most:
        line = program.statements[index]
        yield f"  {count:>9}  card {line.place.card:>3} {line.label or '':>5} {line.text[:50]}"


def _timed(row: Row) -> str:
    return f"  {row.cause:<20}{row.count:>9}{row.seconds:>11.1f}{'  ~' if row.estimated else ''}"
