"""``hull1620 run``: run a FORTRAN program on the emulated machine."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import replace

from emulator.errors import CardError, DeckError, EmulatorError, OperatorError
from emulator.language.cards import Deck
from emulator.machine.machine import Machine
from emulator.machine.result import Event
from modern.cli.shared.console import DIFFERS, OK, UsageError, check_one_standard_input, print_notes
from modern.cli.shared.inputs import deck_for
from modern.cli.shared.operators import attended
from modern.cli.shared.programs import load_program_and_data, machine_options
from modern.cli.shared.run_output import print_run, streaming, tracing
from modern.thesis.job import Refusals


def main(args: argparse.Namespace) -> int:
    check_one_standard_input(args)
    options = replace(machine_options(args), hopper="any")
    program, data = load_program_and_data(args)
    deck = input_deck(args, data)
    refusals = Refusals()
    failure: EmulatorError | None = None
    with (
        attended(args, program) as attendance,
        streaming(args, attendance.show) as stream,
        tracing(args.trace) as tracer,
    ):

        def output(events: Sequence[Event]) -> None:
            refusals.see(events)
            stream(events)

        machine = Machine(program, deck, options)
        if tracer:
            tracer.watch(program, machine)
        try:
            result = machine.run(attendance.operator, output)
        except (CardError, DeckError, OperatorError) as error:
            # Raise the error after the outputs are closed, so that they keep the output before the invalid card.
            failure, result = error, machine.result()
    if failure is not None:
        raise failure
    attendance.print_unused()
    print_run(args, program, result)
    return OK if result.ending.normal and not refusals.stopped else DIFFERS


def input_deck(args: argparse.Namespace, data: Deck) -> Deck:
    """Return the deck that the arguments name, or the cards after END.  Raise UsageError if both are present."""
    if not data.cards:
        return deck_for(args.program, args.deck) if args.deck else Deck("no deck", ())
    span = f"cards {data.cards[0].number} to {data.cards[-1].number}, after END"
    if args.deck:
        raise UsageError(f"{data.source}: {span}, are data; remove them to read {args.deck}")
    print_notes([f"{data.source}: {span}, are read as the data"])
    return data
