"""``hull1620 run``: any program of the dialect, on the emulated machine."""

from __future__ import annotations

import argparse
import sys

from emulator.cards import Deck, read_deck
from emulator.errors import DeckError
from emulator.machine import Machine
from modern.cli.common import (
    check_places,
    layers_of,
    load_program,
    machine_options,
    put_out,
    say,
    say_warnings,
    tracing,
)
from modern.cli.main import DIFFERS, OK
from modern.cli.profile import profile_lines
from modern.hullrun import refusal


def main(args: argparse.Namespace) -> int:
    """Run, put out cards and typed lines, say how it ended."""
    if args.program == "-" and args.deck == "-":
        raise DeckError("program and deck cannot both come from standard input")
    options = machine_options(args)
    check_places(args)
    program = load_program(args.program, layers_of(args))
    deck = read_deck(args.deck) if args.deck else Deck("no deck", ())
    keyboard = () if "-" in (args.program, args.deck) or sys.stdin is None or sys.stdin.isatty() else sys.stdin
    with tracing(args.trace) as tracer:
        machine = Machine(program, deck, options, keyboard)
        if tracer:
            tracer.watch(program, machine)
        result = machine.run()
    put_out(args, result.punched, result.typed)
    say_warnings(result)
    if args.profile:
        say(profile_lines(program, result))
    if not result.ending.normal:
        say([f"hull1620: {result.ending.message}"])
        return DIFFERS
    return DIFFERS if refusal(result) else OK
