"""``hull1620 hull``: a checked data deck through program 1 and the program its typewriter names."""

from __future__ import annotations

import argparse
from dataclasses import replace

from emulator.files import check_writable
from emulator.language.cards import read_deck
from emulator.language.objectcode import Program
from emulator.machine.machine import Machine
from modern.cli.shared.console import DIFFERS, OK, say
from modern.cli.shared.machine import (
    card_rules,
    layers_of,
    machine_options,
    profile_lines,
    put_out,
    say_notices,
    tracing,
)
from modern.edition import programs
from modern.formats.deck import check
from modern.thesis.job import HullRun, run_hull


def main(args: argparse.Namespace) -> int:
    """Check the deck, run every data set, put out the final cards."""
    options = replace(machine_options(args), uncut=args.uncut)
    check_writable(args.punch, args.typewriter, args.trace)
    layers = layers_of(args)
    first = "program1_examples" if args.programs == "examples" else "program1"
    checked = check(read_deck(args.deck), card_rules(options), epsilon="epsilon" in layers)
    load = programs.loader(layers)
    load(first)
    runs: list[HullRun] = []
    with tracing(args.trace) as tracer:

        def watch(program: Program, machine: Machine) -> None:
            if tracer:
                tracer.watch(program, machine)

        runs.extend(run_hull(checked.deck(i), load, options, first, watch) for i in range(len(checked.sets)))
    put_out(
        args,
        [card for run in runs for card in run.final.result.punched],
        [line for run in runs for step in run.steps for line in step.result.typed],
    )
    say(f"warning: {warning.message}" for warning in checked.warnings)
    already = {(w.card, w.column) for w in checked.warnings}
    for run in runs:
        for step in run.steps:
            say_notices(step.program, step.result, already if step is run.steps[0] else ())
            if args.profile:
                say(profile_lines(step.program, step.result))
            if not step.result.ending.normal:
                say([f"hull1620: {step.result.ending.message}"])
    return OK if all(run.complete for run in runs) else DIFFERS
