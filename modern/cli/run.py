"""``hull1620 run``: any program of the dialect, on the emulated machine."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import replace

from emulator.errors import CardError, DeckError, EmulatorError, OperatorError
from emulator.files import check_writable
from emulator.language.cards import Deck
from emulator.machine.machine import Machine
from emulator.machine.result import Event
from modern.cli.shared.console import DIFFERS, OK, UsageError, say
from modern.cli.shared.inputs import deck_for
from modern.cli.shared.machine import (
    attended,
    layers_of,
    load_program,
    machine_options,
    profile_lines,
    say_notices,
    streaming,
    tracing,
)
from modern.thesis.job import Refusals


def main(args: argparse.Namespace) -> int:
    """Run, put out cards and typed lines, say how it ended."""
    if args.program == "-" and args.deck == "-":
        raise UsageError("program and deck cannot both come from standard input")
    options = replace(machine_options(args), hopper="any")
    check_writable(args.punch, args.typewriter, args.trace, args.log)
    program = load_program(args.program, layers_of(args), args.upcase)
    deck = deck_for(args.program, args.deck) if args.deck else Deck("no deck", ())
    seen = Refusals()
    bad: EmulatorError | None = None
    with (
        attended(args, program) as who,
        streaming(args, who.show) as stream,
        tracing(args.trace) as tracer,
    ):

        def output(events: Sequence[Event]) -> None:
            seen.see(events)
            stream(events)

        machine = Machine(program, deck, options)
        if tracer:
            tracer.watch(program, machine)
        try:
            result = machine.run(who.operator, output)
        except (CardError, DeckError, OperatorError) as error:
            # What was punched, typed and traced before the bad card is good work.
            bad, result = error, machine.result()
    if bad is not None:
        raise bad
    say_notices(program, result)
    who.say_left()
    if args.profile:
        say(profile_lines(program, result))
    if not result.ending.normal:
        say([f"hull1620: {result.ending.message}"])
        return DIFFERS
    return DIFFERS if seen.stopped else OK
