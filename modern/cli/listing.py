"""``hull1620 listing``: a program's cards, and beside each what a run made of it."""

from __future__ import annotations

import argparse
import shutil
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from emulator.errors import DeckError, Diagnostic
from emulator.files import check_writable, read_text, source_name, write_text
from emulator.language.cards import Deck
from emulator.language.compiler import translate
from emulator.language.objectcode import Program
from emulator.machine.devices import no_deck
from emulator.machine.divergence import Divergence, diverge
from emulator.machine.machine import Machine
from emulator.machine.operator import FromFile, Operator
from emulator.machine.result import Options, Result
from emulator.machine.timing import measure, shares
from modern.cli.shared.console import BAD_INPUT, DIFFERS, OK, UsageError, say
from modern.cli.shared.inputs import deck_for
from modern.cli.shared.machine import (
    is_terminal,
    layers_of,
    machine_options,
    number_system,
    say_notices,
    source_deck,
)
from modern.edition import programs

_NARROWEST = 40


@dataclass(frozen=True)
class _Row:
    """What a run made of the statement that begins on a card; ``lost`` is None where no value was compared."""

    times: int
    share: float
    lost: float | None


def main(args: argparse.Namespace) -> int:
    """Compile, run where there is a deck, print the cards."""
    if args.program == "-" and args.deck == "-":
        raise UsageError("program and deck cannot both come from standard input")
    check_writable(args.output)
    options = machine_options(args)
    source = source_deck(args.program, layers_of(args), args.upcase)
    program, messages = translate(source)
    if program is None or (args.deck is None and program.uses("READ", "ACCEPT")):
        _put_out(args.output, _plain(source, messages))
        return OK if program is not None else BAD_INPUT
    if args.program not in programs.NAMES:
        # Of its own decks the thesis's programs want whole data sets.
        options = replace(options, hopper="any")
    deck = deck_for(args.program, args.deck) if args.deck else no_deck(program)
    answers = _answers(args.operator)
    result = Machine(program, deck, options).run(_operator(answers), output=lambda events: None)
    found = _compared(args, program, deck, options, answers)
    _put_out(args.output, _run(source, messages, program, result, found))
    say_notices(program, result)
    if not result.ending.normal:
        say([f"hull1620: {result.ending.message}"])
        return DIFFERS
    return OK


def _answers(name: str | None) -> tuple[str, str] | None:
    """The name and the text of an operator's file; None where nobody answers.  Raises UsageError for a terminal."""
    if name == "":
        raise UsageError("--operator: a listing takes the operator's answers from a file or a log, --operator=FILE")
    return None if name is None or name == "none" else (source_name(name), read_text(name))


def _operator(answers: tuple[str, str] | None) -> Operator:
    return Operator() if answers is None else FromFile(*answers)


def _compared(
    args: argparse.Namespace, program: Program, deck: Deck, options: Options, answers: tuple[str, str] | None
) -> Divergence | None:
    """The run beside the same in another arithmetic; None where none is asked for."""
    if args.against == "none":
        return None
    reference = number_system(args.against, "--against")
    try:
        return diverge(program, deck, options.numbers, reference, options, operator=lambda: _operator(answers))
    except DeckError as error:
        say([f"note: no digits are compared: {error}"])
        return None


def _put_out(path: str, lines: Iterator[str]) -> None:
    """Lines to a file whole, or to standard output; a terminal gets as much of each as it has columns."""
    width = None
    if path == "-" and is_terminal(sys.stdout):
        width = max(_NARROWEST, shutil.get_terminal_size((80, 24)).columns)
    write_text(path, "".join(line[:width].rstrip() + "\n" for line in lines))


def _plain(source: Deck, messages: Sequence[Diagnostic]) -> Iterator[str]:
    yield f"{source.source}: {len(source.cards)} cards"
    for card in source.cards:
        yield f"{card.number:5d}  {card.text}"
        yield from _marked(messages, card.number, " " * 7)
    for message in messages:
        if not 1 <= message.card <= len(source.cards):
            yield message.line(source.source)


def _marked(messages: Sequence[Diagnostic], card: int, lead: str) -> Iterator[str]:
    """The compiler's messages for a card, each with a mark under its column."""
    for message in messages:
        if message.card == card:
            kind = "warning" if message.warning else "error"
            yield f"{lead}{' ' * (message.column - 1) + '^ ' if message.column else ''}{kind}: {message.message}"


def _run(
    source: Deck, messages: Sequence[Diagnostic], program: Program, result: Result, found: Divergence | None
) -> Iterator[str]:
    seconds = measure(program, result).processor_seconds
    yield f"{program.source}: {result.statements} statements in {seconds:.1f} s of a 1620's processor"
    if found is not None:
        yield from _about(found)
    rows = _rows(program, result, found)
    yield " card    times  time%  lost"
    for card in source.cards:
        row = rows.get(card.number)
        told = ""
        if row is not None:
            lost = "" if row.lost is None else f"{row.lost:.1f}"
            told = f"{row.times:9d} {f'{row.share:.1f}' if row.times else '':>6} {lost:>5}"
        yield f"{card.number:5d}{told:<22}  {card.text}"
        yield from _marked(messages, card.number, " " * 29)


def _about(found: Divergence) -> Iterator[str]:
    studied, reference = found.arithmetics
    until = ""
    if found.first_decision is not None:
        until = f", up to card {found.first_decision.line.place.card}, the first decision that differs"
    yield f"digits lost, of {found.digits:.1f}: {studied} against {reference}{until}"
    if found.apart:
        yield f"not compared further: {found.apart}"


def _rows(program: Program, result: Result, found: Divergence | None) -> dict[int, _Row]:
    """By the card a statement begins on."""
    times = dict(measure(program, result).statements)
    seconds = shares(program, result)
    total = sum(seconds) or 1.0
    lost = {loss.line.index: loss.worst for loss in found.losses} if found is not None and found.digits else {}
    return {
        line.place.card: _Row(times.get(line.index, 0), 100 * seconds[line.index] / total, lost.get(line.index))
        for line in program.statements
    }
