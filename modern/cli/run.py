"""``hull1620 run``: any program of the dialect, on the emulated machine."""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace

from emulator.errors import EmulatorError
from emulator.files import check_writable
from emulator.language.cards import Deck, read_deck
from emulator.machine.machine import Machine
from modern.cli.shared.console import DIFFERS, OK, UsageError, say
from modern.cli.shared.machine import (
    layers_of,
    load_program,
    machine_options,
    profile_lines,
    put_out,
    say_notices,
    tracing,
)
from modern.thesis.job import refusal


def main(args: argparse.Namespace) -> int:
    """Run, put out cards and typed lines, say how it ended."""
    if args.program == "-" and args.deck == "-":
        raise UsageError("program and deck cannot both come from standard input")
    options = replace(machine_options(args), hopper="any")
    check_writable(args.punch, args.typewriter, args.trace)
    program = load_program(args.program, layers_of(args), args.upcase)
    deck = read_deck(args.deck) if args.deck else Deck("no deck", ())
    keyboard = () if "-" in (args.program, args.deck) or sys.stdin is None or sys.stdin.isatty() else sys.stdin
    with tracing(args.trace) as tracer:
        machine = Machine(program, deck, options, keyboard)
        if tracer:
            tracer.watch(program, machine)
        bad: EmulatorError | None = None
        try:
            result = machine.run()
        except EmulatorError as error:
            # What was punched, typed and traced before the bad card is good work.
            bad, result = error, machine.result()
    put_out(args, result.punched, result.typed)
    if bad is not None:
        raise bad
    say_notices(program, result)
    if args.profile:
        say(profile_lines(program, result))
    if not result.ending.normal:
        say([f"hull1620: {result.ending.message}"])
        return DIFFERS
    return DIFFERS if refusal(result) else OK
