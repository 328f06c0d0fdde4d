"""``hull1620 diverge``: run a program in two arithmetics in step, and report the differing decisions and values."""

import argparse
import shutil
import textwrap
from collections.abc import Iterator

from emulator.language.objectcode import Line
from emulator.machine.devices import no_deck
from emulator.machine.divergence import Divergence, diverge
from modern.cli.shared.console import DIFFERS, OK, check_one_standard_input, counted, print_report, write_json
from modern.cli.shared.inputs import deck_for
from modern.cli.shared.programs import load_program, machine_options, number_system

_NARROWEST, _WIDEST = 40, 120


def main(args: argparse.Namespace) -> int:
    check_one_standard_input(args)
    studied = number_system(args.arithmetic, "--arithmetic")
    reference = number_system(args.against, "--against")
    options = machine_options(args)
    program = load_program(args)
    deck = deck_for(args.program, args.deck) if args.deck else no_deck(program)
    divergence = diverge(program, deck, studied, reference, options, values=not args.first)
    width = max(_NARROWEST, min(shutil.get_terminal_size((100, 24)).columns, _WIDEST))
    print_report(args, _report(divergence, width, values=not args.first))
    write_json(args, _document(divergence))
    return DIFFERS if divergence.decisions or divergence.apart or _limit_message(divergence) else OK


def _report(divergence: Divergence, width: int, values: bool) -> Iterator[str]:
    studied, reference = divergence.arithmetics
    yield from _wrapped(f"{divergence.program}, {divergence.deck}: {studied} against {reference}", width)
    if values:
        yield from _first_value(divergence, width)
    yield from _first_decision(divergence, width)
    if divergence.apart:
        yield from _wrapped(f"comparison ended: {divergence.apart}", width)
    elif _limit_message(divergence):
        yield from _wrapped(f"comparison ended: both runs were {_limit_message(divergence)}", width)
    for outcome in () if divergence.decisions and not values else divergence.outcomes:
        yield from _wrapped(outcome, width)
    if divergence.losses and divergence.digits:
        yield ""
        yield from _table(divergence, width)


def _limit_message(divergence: Divergence) -> str:
    return next((ending.message for ending in divergence.endings if ending and ending.kind == "limit"), "")


def _first_value(divergence: Divergence, width: int) -> Iterator[str]:
    first, reference = divergence.first_value, divergence.arithmetics[1]
    if first is None:
        yield from _wrapped(f"values: {divergence.compared} compared, none differs", width)
    else:
        counts = f"values: {divergence.compared} compared, {divergence.values} differ"
        if divergence.decisions:
            counts += f", {divergence.values_in_step} of them before the first decision that differs"
        yield from _wrapped(counts, width)
    if divergence.within:
        yield from _wrapped(
            f"  {divergence.within} more {_differ(divergence.within)} within the rounding of {reference}", width
        )
    if first is None:
        return
    yield from _wrapped(f"first value that differs: {_place(first.line)}{_execution(first.time)}", width)
    for arithmetic, name, value in zip(divergence.arithmetics, first.names, first.values, strict=True):
        yield from _wrapped(f"  {arithmetic}: {name} = {value}", width)
    if first.relative is not None:
        yield from _wrapped(f"  relative difference {first.relative:.1e}", width)


def _first_decision(divergence: Divergence, width: int) -> Iterator[str]:
    first = divergence.first_decision
    if first is None:
        yield from _wrapped(f"decisions: {divergence.tested} compared, none differs", width)
        return
    yield from _wrapped(
        f"decisions: {divergence.tested} compared, {divergence.decisions} {_differ(divergence.decisions)}", width
    )
    yield from _wrapped(f"first decision that differs: {_place(first.line)}{_execution(first.time)}", width)
    for arithmetic, value, target in zip(divergence.arithmetics, first.values, first.targets, strict=True):
        destination = target.name if target else "the end"
        yield from _wrapped(f"  {arithmetic}: {value}, goes to {destination}", width)


def _differ(count: int) -> str:
    return "differs" if count == 1 else "differ"


def _text(line: Line) -> str:
    return f"{line.label} {line.text}" if line.label else line.text


def _place(line: Line) -> str:
    return f"card {line.place.card}, {_text(line)}"


def _execution(number: int) -> str:
    return f" (execution {number})" if number > 1 else ""


def _wrapped(text: str, width: int) -> list[str]:
    lead = " " * (len(text) - len(text.lstrip()))
    return textwrap.wrap(text, width, subsequent_indent=lead + "  ", break_on_hyphens=False)


def _table(divergence: Divergence, width: int) -> Iterator[str]:
    """Yield a table row for each statement that lost at least a tenth of a digit."""
    losing = [loss for loss in divergence.losses if loss.worst]
    until = ", up to that decision" if divergence.decisions else ""
    yield from _wrapped(f"digits lost, of {divergence.digits:.1f}{until}", width)
    if losing:
        yield "worst median count differ card statement"
    for loss in losing:
        figures = f"{loss.worst:5.1f} {loss.median:6.1f} {loss.times:5d} {loss.differing:6d}"
        yield f"{figures} {loss.line.place.card:4d} {_text(loss.line)}"[:width].rstrip()
    others = len(divergence.losses) - len(losing)
    if others:
        statements = counted(others, "other statement" if losing else "statement")
        yield from _wrapped(f"{statements} lost less than a tenth of a digit", width)


def _document(divergence: Divergence) -> dict[str, object]:
    first, decision = divergence.first_value, divergence.first_decision
    return {
        "program": divergence.program,
        "deck": divergence.deck,
        "arithmetics": list(divergence.arithmetics),
        "digits": round(divergence.digits, 2),
        "values": {
            "compared": divergence.compared,
            "differing": divergence.values,
            "differing_in_step": divergence.values_in_step,
            "within_rounding": divergence.within,
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
            "compared": divergence.tested,
            "differing": divergence.decisions,
            "first": decision
            and {
                **_statement(decision.line),
                "time": decision.time,
                "values": list(decision.values),
                "targets": [target and _statement(target) for target in decision.targets],
            },
        },
        "apart": divergence.apart,
        "statements": list(divergence.statements),
        "endings": [ending and {"kind": ending.kind, "message": ending.message} for ending in divergence.endings],
        "losses": [
            {
                **_statement(loss.line),
                "times": loss.times,
                "differing": loss.differing,
                "worst": loss.worst,
                "median": loss.median,
            }
            for loss in divergence.losses
        ],
    }


def _statement(line: Line) -> dict[str, object]:
    return {"card": line.place.card, "statement": line.label or None, "text": line.text}
