"""``hull1620 hull``: check a data deck, then run program 1, and program 2 or 3 as program 1 requests."""

import argparse
import sys
from collections.abc import Sequence
from dataclasses import replace
from functools import partial

from emulator.language.objectcode import Program
from emulator.machine.machine import Machine
from emulator.machine.result import Event
from modern.cli.shared.console import DIFFERS, OK, print_notes
from modern.cli.shared.inputs import deck_of, punch_epsilon
from modern.cli.shared.operators import attended
from modern.cli.shared.programs import card_rules, layers_of, machine_options
from modern.cli.shared.refusals import Request, refusal_lines, wrapped
from modern.cli.shared.run_output import is_terminal, print_run, tracing, write_outputs
from modern.edition import programs
from modern.formats.deck import check
from modern.thesis.job import HullRun, run_hull
from modern.thesis.refusals import Cause, explain_run


def main(args: argparse.Namespace) -> int:
    options = replace(machine_options(args), uncut=args.uncut)
    layers = layers_of(args)
    if args.epsilon is not None and "epsilon" not in layers:
        layers = (*layers, "epsilon")
    first_program = "program1_examples" if args.programs == "examples" else "program1"
    checked = check(deck_of(args.deck, points=True), card_rules(options), epsilon="epsilon" in layers)
    load = programs.loader(layers)
    load(first_program)
    request = Request(args.deck, "", layers, options.numbers.name, args.epsilon or "", args.uncut, args.explain)
    runs: list[tuple[HullRun, Cause | None]] = []
    with attended(args) as attendance, tracing(args.trace) as tracer:

        def watch(program: Program, machine: Machine) -> None:
            if tracer:
                tracer.watch(program, machine)

        def output(events: Sequence[Event]) -> None:
            for event in events:
                if event.what == "type" and attendance.show:
                    attendance.show(event.text)

        for i in range(len(checked.sets)):
            deck = checked.deck(i) if args.epsilon is None else punch_epsilon(checked.deck(i), args.epsilon)
            start = partial(run_hull, deck, load, options, first_program, operator=attendance.operator, output=output)
            runs.append(explain_run(start, watch))
    typed = [line for run, _ in runs for step in run.steps for line in step.result.typed]
    # The terminal has already shown the typed lines.
    is_shown = attendance.show is not None and args.typewriter is None and is_terminal(sys.stderr)
    write_outputs(args, [card for run, _ in runs for card in run.final.result.punched], () if is_shown else typed)
    attendance.print_unused()
    print_notes(f"warning: {warning.message}" for warning in checked.warnings)
    reported = {(warning.card, warning.column) for warning in checked.warnings}
    for number, (run, cause) in enumerate(runs, 1):
        for step in run.steps:
            print_run(args, step.program, step.result, reported if step is run.steps[0] else ())
        if cause is not None:
            print_notes([f"data set {number}:"] if len(runs) > 1 else ())
            print_notes(refusal_lines(cause, request))
        if args.explain and options.numbers.name != "exact":
            from modern.thesis.explanation import first_disagreement  # imported here because it imports mpmath

            print_notes(wrapped(first_disagreement(run, options)))
    return OK if all(run.complete for run, _ in runs) else DIFFERS
