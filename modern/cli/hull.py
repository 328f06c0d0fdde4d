"""``hull1620 hull``: a checked data deck through program 1 and the program its typewriter names."""

from __future__ import annotations

import argparse

from emulator.cards import read_deck
from emulator.machine import Machine
from emulator.objectcode import Program
from modern import hulldeck
from modern.cli.common import check_places, layers_of, machine_options, put_out, say, say_warnings, tracing
from modern.cli.main import DIFFERS, OK
from modern.cli.profile import profile_lines
from modern.edition import decks
from modern.hullrun import HullRun, run_hull


def main(args: argparse.Namespace) -> int:
    """Check the deck, run every data set, put out the final cards."""
    options = machine_options(args)
    check_places(args)
    layers = layers_of(args)
    first = "program1_examples" if args.programs == "examples" else "program1"
    checked = hulldeck.check(read_deck(args.deck), options.profile.rules)
    load = _loader(layers)
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
    say(f"warning: {warning}" for warning in checked.warnings)
    for run in runs:
        for step in run.steps:
            # A field the check has warned about is not mentioned again by the machine.
            if not checked.warnings:
                say_warnings(step.result)
            if args.profile:
                say(profile_lines(step.program, step.result))
            if not step.result.ending.normal:
                say([f"hull1620: {step.result.ending.message}"])
    return OK if all(run.complete for run in runs) else DIFFERS


def _loader(layers: tuple[str, ...]):  # type: ignore[no-untyped-def]
    """Programs by name; a layer applies to those programs that have rows of it.

    Raises DeckError where none of the three has.
    """
    from emulator.errors import DeckError

    present = {name: {row.layer for row in decks.text(decks.built_in(name).text).rows} for name in decks.NAMES}
    for layer in layers:
        if not any(layer in found for found in present.values()):
            raise DeckError(f"no program has rows of a layer {layer!r}")
    return lambda name: decks.program(name, tuple(layer for layer in layers if layer in present[name]))
