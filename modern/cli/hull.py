"""``hull1620 hull``: a checked data deck through program 1 and the program its typewriter names."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from dataclasses import replace
from functools import partial

from emulator.files import check_writable
from emulator.language.cards import Deck
from emulator.language.objectcode import Program
from emulator.machine.machine import Machine
from emulator.machine.result import Event
from modern.cli.shared import refusals
from modern.cli.shared.console import DIFFERS, OK, UsageError, say
from modern.cli.shared.inputs import deck_of
from modern.cli.shared.machine import (
    attended,
    card_rules,
    is_terminal,
    layers_of,
    machine_options,
    profile_lines,
    put_out,
    say_notices,
    tracing,
)
from modern.edition import programs
from modern.formats.deck import check, with_epsilon
from modern.thesis.job import HullRun, run_hull
from modern.thesis.refusals import Cause, explain_run


def main(args: argparse.Namespace) -> int:
    """Check the deck, run every data set, put out the final cards."""
    options = replace(machine_options(args), uncut=args.uncut)
    check_writable(args.punch, args.typewriter, args.trace, args.log)
    layers = layers_of(args)
    if args.epsilon is not None and "epsilon" not in layers:
        layers = (*layers, "epsilon")
    first = "program1_examples" if args.programs == "examples" else "program1"
    checked = check(deck_of(args.deck, points=True), card_rules(options), epsilon="epsilon" in layers)
    load = programs.loader(layers)
    load(first)
    asked = refusals.Asked(args.deck, "", layers, options.numbers.name, args.epsilon or "", args.uncut, args.explain)
    runs: list[tuple[HullRun, Cause | None]] = []
    with attended(args) as who, tracing(args.trace) as tracer:

        def watch(program: Program, machine: Machine) -> None:
            if tracer:
                tracer.watch(program, machine)

        def output(events: Sequence[Event]) -> None:
            for event in events if who.show else ():
                if event.what == "type" and who.show:
                    who.show(event.text)

        for i in range(len(checked.sets)):
            deck = checked.deck(i) if args.epsilon is None else _with_epsilon(checked.deck(i), args.epsilon)
            begun = partial(run_hull, deck, load, options, first, operator=who.operator, output=output)
            runs.append(explain_run(begun, watch))
    typed = [line for run, _ in runs for step in run.steps for line in step.result.typed]
    shown = who.show is not None and args.typewriter is None and is_terminal(sys.stderr)
    put_out(args, [card for run, _ in runs for card in run.final.result.punched], () if shown else typed)
    who.say_left()
    say(f"warning: {warning.message}" for warning in checked.warnings)
    already = {(w.card, w.column) for w in checked.warnings}
    for number, (run, cause) in enumerate(runs, 1):
        for step in run.steps:
            say_notices(step.program, step.result, already if step is run.steps[0] else ())
            if args.profile:
                say(profile_lines(step.program, step.result))
            if not step.result.ending.normal:
                say([f"hull1620: {step.result.ending.message}"])
        if cause is not None:
            say([f"data set {number}:"] if len(runs) > 1 else ())
            say(refusals.lines(cause, asked))
    return OK if all(run.complete for run, _ in runs) else DIFFERS


def _with_epsilon(deck: Deck, epsilon: str) -> Deck:
    try:
        return with_epsilon(deck, epsilon)
    except ValueError as error:
        raise UsageError(f"--{error}") from None
