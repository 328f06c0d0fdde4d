"""What several subcommands share: finding programs, setting up a machine, putting out cards and typed lines."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Collection, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import replace

from emulator.errors import DeckError
from emulator.files import write_text, writing
from emulator.language.cards import Deck, read_deck
from emulator.language.compiler import compile_deck
from emulator.language.objectcode import Program
from emulator.machine.result import ERRORS, Options, Result
from emulator.machine.trace import Tracer
from emulator.numbers import DecimalNumbers, Numbers, numbers
from emulator.numbers.arithmetic import TRUNCATING, Rules
from emulator.numbers.base import cutting_rules
from emulator.numbers.fields import FALLBACK
from modern.edition import programs


def layers_of(args: argparse.Namespace) -> tuple[str, ...]:
    """The layers asked for by ``--layers``."""
    return tuple(layer.strip() for layer in args.layers.split(",") if layer.strip())


def source_deck(name: str, layers: tuple[str, ...]) -> Deck:
    """A source deck: a built-in program by name, else a file.

    Raises DeckError for layers with a file: only the built-in programs have an apparatus.
    """
    if name in programs.NAMES:
        return programs.deck(name, layers)
    if layers:
        raise DeckError(f"{name}: --layers is for the built-in programs: {', '.join(programs.NAMES)}")
    return read_deck(name)


def load_program(name: str, layers: tuple[str, ...]) -> Program:
    """A program compiled: a built-in by name, else a file."""
    if name in programs.NAMES:
        return programs.program(name, layers)
    return compile_deck(source_deck(name, layers))


def machine_options(args: argparse.Namespace) -> Options:
    """The machine the options describe.  Raises DeckError for an unknown arithmetic or a limit below 1."""
    found = number_system(args.arithmetic, "--arithmetic")
    if args.limit < 1:
        raise DeckError(f"--limit: {args.limit} is no number of statements")
    options = Options(TRUNCATING, frozenset(args.switch), args.core, args.bounds, args.limit)
    if isinstance(found, DecimalNumbers):
        return replace(options, profile=found.profile)
    return replace(options, numbers=found)


def number_system(name: str, option: str) -> Numbers:
    """An arithmetic by name.  Raises DeckError, which names the option."""
    try:
        return numbers(name)
    except ValueError as error:
        raise DeckError(f"{option}: {error}") from None


def card_rules(options: Options) -> Rules:
    """How many digits of a card's field the machine takes: all of them where its numbers are not decimal."""
    return options.profile.rules if options.numbers is None else cutting_rules(FALLBACK.width)


def put_out(args: argparse.Namespace, punched: Iterable[str], typed: Iterable[str]) -> None:
    """Cards to ``--punch`` or standard output, typed lines to ``--typewriter`` or standard error."""
    typed_text = "".join(line + "\n" for line in typed)
    if args.typewriter is not None:
        write_text(args.typewriter, typed_text)
    else:
        sys.stderr.write(typed_text)
        sys.stderr.flush()
    write_text(args.punch, "".join(card + "\n" for card in punched))


def check_places(*paths: str | None) -> None:
    """Refuse a file that cannot be written before the run, not after it, and two outputs to one file.

    Raises DeckError.
    """
    named = [path for path in paths if path is not None and path != "-"]
    for path in named:
        if not path:
            raise DeckError("a file without a name cannot be written")
        folder = os.path.dirname(os.path.realpath(path))
        if os.path.isdir(path):
            raise DeckError(f"{path}: is a directory")
        if not os.path.isdir(folder):
            raise DeckError(f"{path}: no such file or directory")
        if not os.access(path if os.path.exists(path) else folder, os.W_OK):
            raise DeckError(f"{path}: permission denied")
    real = [os.path.realpath(path) for path in named if os.path.isfile(path) or not os.path.exists(path)]
    if len(set(real)) < len(real):
        raise DeckError("two outputs are to go to one file")


def counted(count: int, what: str) -> str:
    """``1 voxel``, ``2 voxels``."""
    return f"{count} {what}{'s' * (count != 1)}"


def say(lines: Iterable[str]) -> None:
    """Lines for the user, on standard error."""
    for line in lines:
        print(line, file=sys.stderr)


def say_warnings(program: Program, result: Result, said: Collection[str] = ()) -> None:
    """A run's warnings, but for those said before, and its arithmetic's error codes."""
    say(f"warning: {warning}" for warning in result.warnings if warning not in said)
    for error, n in result.errors:
        code = error.split()[0]
        say([f"note: {program.source}: {error}: {ERRORS[code]}{f', {n} times' if n > 1 else ''}"])


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
