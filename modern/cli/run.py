"""``hull1620 run``: run a FORTRAN program on the emulated machine."""

import argparse
import os
from collections.abc import Iterator, Sequence
from dataclasses import replace

from emulator.errors import CardError, DeckError, EmulatorError, OperatorError
from emulator.language.cards import Deck, deck_from_lines, deck_from_text, read_deck
from emulator.language.compiler import compile_deck
from emulator.language.objectcode import Program
from emulator.language.parser import parse
from emulator.machine.machine import Machine
from emulator.machine.operator import PUNCHED, FromFile
from emulator.machine.result import Event, Result
from modern.cli.shared.console import DIFFERS, OK, UsageError, check_one_standard_input, print_notes
from modern.cli.shared.inputs import deck_for
from modern.cli.shared.operators import attended
from modern.cli.shared.programs import machine_options, source_deck
from modern.cli.shared.run_output import print_run, streaming, tracing
from modern.edition import programs
from modern.thesis.job import Refusals


def main(args: argparse.Namespace) -> int:
    check_one_standard_input(args)
    options = replace(machine_options(args), hopper="any")
    jobs = []
    if args.program is not None:
        source = source_deck(args)
        jobs = [(compile_deck(source), input_deck(args, Deck(source.source, parse(source).data)))]
    elif not args.operator or args.operator == "none":
        raise UsageError("PROGRAM.f is missing; name a program, or add --operator=FILE with a log that names one")
    refusals = Refusals()
    failure: EmulatorError | None = None
    results: list[tuple[Program, Result]] = []
    with (
        attended(args, jobs[0][0] if jobs else None) as attendance,
        streaming(args, attendance.show) as stream,
        tracing(args.trace) as tracer,
    ):

        def output(events: Sequence[Event]) -> None:
            refusals.see(events)
            stream(events)

        try:
            for program, deck in jobs or _logged(args, attendance.file, results):
                machine = Machine(program, deck, options)
                if tracer:
                    tracer.watch(program, machine)
                try:
                    results.append((program, machine.run(attendance.operator, output, keep=not jobs)))
                except (CardError, DeckError, OperatorError):
                    results.append((program, machine.result()))
                    raise
        except EmulatorError as error:
            # Raise the error after the outputs are closed, so that they keep the output before the invalid card.
            failure = error
    if failure is not None:
        raise failure
    attendance.print_unused()
    for program, result in results:
        print_run(args, program, result)
    return OK if all(result.ending.normal for _, result in results) and not refusals.stopped else DIFFERS


def _logged(
    args: argparse.Namespace, log: FromFile | None, results: Sequence[tuple[Program, Result]]
) -> Iterator[tuple[Program, Deck]]:
    """Yield the program and the deck of each LOAD action in an operator's log."""
    for load in log.loads if log is not None else ():
        name = load.program.removesuffix(".f")
        if log is None or not load.program:
            raise UsageError(
                f"{args.operator}: expected LOAD with the names of a program and a deck before the actions"
            )
        if name in programs.NAMES:
            program = programs.program(name)
        elif text := log.decks.get(load.program):
            program = compile_deck(deck_from_text(load.program, text))
        else:
            program = compile_deck(read_deck(load.program))
        if load.deck == PUNCHED and results:
            cards = deck_from_lines(PUNCHED, results[-1][1].punched)
        elif load.deck in log.decks:
            cards = deck_from_text(load.deck, log.decks[load.deck])
        elif load.deck and not os.path.exists(load.deck):
            from modern.publication.decks import named_deck  # only a log needs this import, so programs start faster

            try:
                cards = Deck(load.deck, named_deck(load.deck).cards)
            except ValueError as error:
                raise UsageError(f"{args.operator}: {error}") from None
        else:
            cards = deck_for(name, load.deck) if load.deck else Deck("no deck", ())
        yield program, cards


def input_deck(args: argparse.Namespace, data: Deck) -> Deck:
    """Return the deck that the arguments name, or the data cards after END.  Raise UsageError if both exist."""
    if not data.cards:
        return deck_for(args.program, args.deck) if args.deck else Deck("no deck", ())
    span = f"cards {data.cards[0].number} to {data.cards[-1].number}, after END"
    if args.deck:
        raise UsageError(f"{data.source}: {span}, are data; remove them if the program should read {args.deck}")
    print_notes([f"{data.source}: {span}, are read as the data"])
    return data
