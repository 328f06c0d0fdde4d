"""``hull1620 diverge``: one program over two arithmetics in step."""

from __future__ import annotations

import argparse
import json
import shutil
import textwrap
from collections.abc import Iterator
from dataclasses import replace

from emulator.files import check_writable, write_text
from emulator.language.objectcode import Line
from emulator.machine.comparison import Loss
from emulator.machine.devices import no_deck
from emulator.machine.divergence import Divergence, diverge
from modern.cli.shared.console import DIFFERS, OK, UsageError
from modern.cli.shared.inputs import deck_for
from modern.cli.shared.machine import (
    layers_of,
    load_program,
    machine_options,
    number_system,
)
from modern.edition import programs

_NARROWEST, _WIDEST = 40, 120


def main(args: argparse.Namespace) -> int:
    """Run both, say where they differ; exit 0 where every decision was compared and none differs."""
    if args.program == "-" and args.deck == "-":
        raise UsageError("program and deck cannot both come from standard input")
    check_writable(args.json)
    studied = number_system(args.arithmetic, "--arithmetic")
    reference = number_system(args.against, "--against")
    options = machine_options(args)
    if args.program not in programs.NAMES:
        # Of its own decks the thesis's programs want whole data sets.
        options = replace(options, hopper="any")
    program = load_program(args.program, layers_of(args), args.upcase)
    found = diverge(
        program,
        deck_for(args.program, args.deck) if args.deck else no_deck(program),
        studied,
        reference,
        options,
        values=not args.first,
    )
    width = max(_NARROWEST, min(shutil.get_terminal_size((100, 24)).columns, _WIDEST))
    for line in _report(found, width, values=not args.first):
        print(line)
    if args.json:
        write_text(args.json, json.dumps(_document(found), indent=1) + "\n")
    return DIFFERS if found.decisions or found.apart or _cut_short(found) else OK


def _report(found: Divergence, width: int, values: bool) -> Iterator[str]:
    studied, reference = found.arithmetics
    yield from _wrapped(f"{found.program}, {found.deck}: {studied} against {reference}", width)
    if values:
        yield from _first_value(found, width)
    yield from _first_decision(found, width)
    if found.apart:
        yield from _wrapped(f"not compared further: {found.apart}", width)
    elif _cut_short(found):
        yield from _wrapped(f"not compared further: both were {_cut_short(found)}", width)
    for outcome in () if found.decisions and not values else found.outcomes:
        yield from _wrapped(outcome, width)
    if found.losses and found.digits:
        yield ""
        yield from _table(found, width)


def _cut_short(found: Divergence) -> str:
    """How both runs, in step to their ends, were stopped by the statement limit; empty where they were not."""
    return next((ending.message for ending in found.endings if ending and ending.kind == "limit"), "")


def _first_value(found: Divergence, width: int) -> Iterator[str]:
    first, reference = found.first_value, found.arithmetics[1]
    within = f"besides, {found.within} {_differ(found.within)} by no more than {reference} may itself be off"
    if first is None:
        yield from _wrapped(f"values: {found.compared} compared, none differs", width)
    else:
        counts = f"values: {found.compared} compared, {found.values} differ"
        if found.decisions:
            counts += f", {found.values_in_step} of them before the first decision that does"
        yield from _wrapped(counts, width)
    if found.within:
        yield from _wrapped(f"  {within}", width)
    if first is None:
        return
    yield from _wrapped(f"first value that differs: {_where(first.line)}{_which(first.time)}", width)
    for arithmetic, name, value in zip(found.arithmetics, first.names, first.values, strict=True):
        yield from _wrapped(f"  {arithmetic}: {name} = {value}", width)
    if first.relative is not None:
        yield from _wrapped(f"  relative difference {first.relative:.1e}", width)


def _first_decision(found: Divergence, width: int) -> Iterator[str]:
    first = found.first_decision
    if first is None:
        yield from _wrapped(f"decisions: {found.tested} compared, none differs", width)
        return
    yield from _wrapped(f"decisions: {found.tested} compared, {found.decisions} {_differ(found.decisions)}", width)
    yield from _wrapped(f"first decision that differs: {_where(first.line)}{_which(first.time)}", width)
    for arithmetic, value, target in zip(found.arithmetics, first.values, first.targets, strict=True):
        goes = target.name if target else "the end"
        yield from _wrapped(f"  {arithmetic}: {value}, goes to {goes}", width)


def _differ(count: int) -> str:
    return "differs" if count == 1 else "differ"


def _where(line: Line) -> str:
    return f"card {line.place.card}, {f'{line.label} ' if line.label else ''}{line.text}"


def _which(time: int) -> str:
    return f" (time {time})" if time > 1 else ""


def _wrapped(text: str, width: int) -> list[str]:
    lead = " " * (len(text) - len(text.lstrip()))
    return textwrap.wrap(text, width, subsequent_indent=lead + "  ", break_on_hyphens=False)


def _table(found: Divergence, width: int) -> Iterator[str]:
    """A row for each statement that lost a tenth of a digit or more."""
    losing = [loss for loss in found.losses if loss.worst]
    until = ", up to that decision" if found.decisions else ""
    yield from _wrapped(f"digits lost, of {found.digits:.1f}{until}", width)
    if losing:
        yield "worst median times differ card statement"
    for loss in losing:
        yield _row(loss)[:width].rstrip()
    kept = len(found.losses) - len(losing)
    if kept:
        words = "statement lost no tenth" if kept == 1 else "statements lost no tenth"
        yield from _wrapped(f"{kept} {'other ' if losing else ''}{words} of a digit", width)


def _row(loss: Loss) -> str:
    words = f"{loss.line.label} {loss.line.text}" if loss.line.label else loss.line.text
    return f"{loss.worst:5.1f} {loss.median:6.1f} {loss.times:5d} {loss.differing:6d} {loss.line.place.card:4d} {words}"


def _document(found: Divergence) -> dict[str, object]:
    first, decision = found.first_value, found.first_decision
    return {
        "program": found.program,
        "deck": found.deck,
        "arithmetics": list(found.arithmetics),
        "digits": round(found.digits, 2),
        "values": {
            "compared": found.compared,
            "differing": found.values,
            "differing_in_step": found.values_in_step,
            "within_rounding": found.within,
            "first": first
            and {
                **_statement(first.line),
                "time": first.time,
                "names": list(first.names),
                "values": list(first.values),
                "relative": first.relative,
            },
        },
        "decisions": {
            "compared": found.tested,
            "differing": found.decisions,
            "first": decision
            and {
                **_statement(decision.line),
                "time": decision.time,
                "values": list(decision.values),
                "targets": [target and _statement(target) for target in decision.targets],
            },
        },
        "apart": found.apart,
        "statements": list(found.statements),
        "endings": [ending and {"kind": ending.kind, "message": ending.message} for ending in found.endings],
        "losses": [
            {
                **_statement(loss.line),
                "times": loss.times,
                "differing": loss.differing,
                "worst": loss.worst,
                "median": loss.median,
            }
            for loss in found.losses
        ],
    }


def _statement(line: Line) -> dict[str, object]:
    return {"card": line.place.card, "statement": line.label or None, "text": line.text}
