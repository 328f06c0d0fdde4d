"""Load the program and configure the machine that the arguments of a command request."""

import argparse
from typing import Literal

from emulator.errors import LowerCaseError
from emulator.language.cards import Deck, read_deck
from emulator.language.compiler import compile_deck
from emulator.language.objectcode import Program
from emulator.language.statements import capitals
from emulator.machine.result import Options
from emulator.numbers import DecimalNumbers, Numbers, numbers
from emulator.numbers.arithmetic import Rules, rules_of
from emulator.numbers.fields import FALLBACK
from modern.cli.shared.console import UsageError
from modern.edition import programs


def layers_of(args: argparse.Namespace) -> tuple[str, ...]:
    """Return the layers that ``--layers`` names."""
    return tuple(layer.strip() for layer in args.layers.split(",") if layer.strip())


def source_deck(args: argparse.Namespace) -> Deck:
    """Return the source deck of the argument PROGRAM.f: a built-in program with its layers, or a file.

    Raise UsageError for a file with layers, because only the built-in programs have an apparatus, and for a file with
    small letters without ``--upcase``.
    """
    name, layers = args.program, layers_of(args)
    if name in programs.NAMES:
        return programs.deck(name, layers)
    if layers:
        names = ", ".join(programs.NAMES)
        raise UsageError(f"{name}: a file has no layers; --layers is for the built-in programs: {names}")
    try:
        return read_deck(name, capitals if args.upcase else None)
    except LowerCaseError as error:
        raise UsageError(f"{error}; --upcase reads small letters of the program as capitals") from None


def load_program(args: argparse.Namespace) -> Program:
    """Return the compiled ``PROGRAM.f``.  Raise EmulatorError if the program cannot be read or compiled."""
    if args.program in programs.NAMES:
        return programs.program(args.program, layers_of(args))
    return compile_deck(source_deck(args))


def machine_options(args: argparse.Namespace) -> Options:
    """Return the machine options that the arguments describe. Raise UsageError for an invalid argument."""
    arithmetic = number_system(args.arithmetic, "--arithmetic")
    if args.limit < 1:
        raise UsageError(f"--limit: expected at least 1 statement, found {args.limit}")
    # Only the programs of the thesis require complete data sets.
    hopper: Literal["first", "any"] = "first" if getattr(args, "program", "program1") in programs.NAMES else "any"
    return Options(arithmetic, frozenset(args.switch), args.core, args.bounds, args.limit, hopper=hopper)


def number_system(name: str, option: str) -> Numbers:
    """Return the arithmetic called ``name``.  Raise UsageError, which names the option, if the name is unknown."""
    try:
        return numbers(name)
    except ValueError as error:
        raise UsageError(f"{option}: {error}") from None


def card_rules(options: Options) -> Rules:
    """Return the rules for reading numbers from cards.

    A decimal arithmetic has its own rules.  For any other arithmetic, the rules keep 14 digits, the width of E14.8.
    """
    arithmetic = options.numbers
    return arithmetic.profile.rules if isinstance(arithmetic, DecimalNumbers) else rules_of(FALLBACK.width)
