"""``hull1620 listing``: list a program with the run count, the time and the lost digits of each statement.

``--commentary`` adds an explanation of each block of statements and of each variable of a built-in program.
"""

import argparse
import shutil
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from textwrap import wrap

from emulator.errors import DeckError, Diagnostic
from emulator.files import read_text, source_name, write_text
from emulator.language.cards import Deck
from emulator.language.compiler import translate
from emulator.language.objectcode import Program
from emulator.machine.devices import no_deck
from emulator.machine.divergence import Divergence, diverge
from emulator.machine.machine import Machine
from emulator.machine.operator import FromFile, Operator
from emulator.machine.result import Options, Result
from emulator.machine.timing import measure, shares
from emulator.machine.words import notes
from modern.cli.shared.console import BAD_INPUT, DIFFERS, OK, UsageError, check_one_standard_input, print_notes
from modern.cli.shared.inputs import deck_for
from modern.cli.shared.programs import machine_options, number_system, source_deck
from modern.cli.shared.run_output import is_terminal, print_ending
from modern.comparison.sampling import Sampling, in_step, sampled
from modern.edition import programs
from modern.publication.commentary import commentary

_NARROWEST = 40


def main(args: argparse.Namespace) -> int:
    check_one_standard_input(args)
    options = machine_options(args)
    source = source_deck(args)
    notes_above, glosses = _commentary(args) if args.commentary else ({}, [])
    program, messages = translate(source)
    needs_deck = program is not None and args.deck is None and program.uses("READ", "ACCEPT")
    if args.digits and needs_deck:
        raise UsageError("--digits: the program has READ or ACCEPT statements; name a data deck")
    if program is None or needs_deck:
        _write(args.output, [*_plain(source, messages, notes_above), *glosses])
        return OK if program is not None else BAD_INPUT
    deck = deck_for(args.program, args.deck) if args.deck else no_deck(program)
    answers = _answers(args.operator)
    result = Machine(program, deck, options).run(_operator(answers), output=lambda events: None)
    divergence = _compared(args, program, deck, options, answers)
    sampling = None
    if args.digits:
        sampling = in_step(program, deck, sampled(options.numbers), options, lambda: _operator(answers))
    lines = _with_statistics(source, messages, program, result, divergence, sampling, notes_above)
    _write(args.output, [*lines, *glosses])
    print_notes(notes(program, result))
    print_ending(result)
    return OK if result.ending.normal else DIFFERS


def _answers(name: str | None) -> tuple[str, str] | None:
    """Return name and text of the file of ``--operator``, or None for no file. Raise UsageError for the terminal."""
    if name == "":
        raise UsageError(
            "--operator: the listing command cannot ask at the terminal; use --operator=FILE with a file or a log"
        )
    return None if name is None or name == "none" else (source_name(name), read_text(name))


def _operator(answers: tuple[str, str] | None) -> Operator:
    return Operator() if answers is None else FromFile(*answers)


def _compared(
    args: argparse.Namespace, program: Program, deck: Deck, options: Options, answers: tuple[str, str] | None
) -> Divergence | None:
    if args.against == "none":
        return None
    reference = number_system(args.against, "--against")
    try:
        return diverge(program, deck, options.numbers, reference, options, operator=lambda: _operator(answers))
    except DeckError as error:
        print_notes([f"note: the digits that {options.numbers.name} loses were not counted: {error}"])
        return None


def _commentary(args: argparse.Namespace) -> tuple[dict[int, list[str]], list[str]]:
    """Return the lines to print above the first card of each block, and the lines that explain the variables."""
    if args.program not in programs.NAMES or args.layers:
        raise UsageError(f"--commentary: only {', '.join(programs.NAMES)} without --layers have a commentary")
    remarks = commentary(args.program)
    width = min(_width(args.output) or 100, 100)
    above = {
        block.cards.start: [
            "",
            block.title,
            *wrap(block.text, width, initial_indent="    ", subsequent_indent="    "),
            "",
        ]
        for block in remarks.blocks
    }
    glosses = ["", "Variables"]
    for gloss in remarks.variables:
        limits = f" ({gloss.limits[0]} to {gloss.limits[1]})" if gloss.limits else ""
        glosses += wrap(f"    {gloss.name:5s} {gloss.text}{limits}", width, subsequent_indent=" " * 10)
    return above, glosses


def _write(path: str, lines: Iterable[str]) -> None:
    """Write lines to a file or to standard output; lines for a terminal are truncated to its width."""
    width = _width(path)
    write_text(path, "".join(line[:width].rstrip() + "\n" for line in lines))


def _width(path: str) -> int | None:
    """Return the width of the terminal to which the output goes, or None if it goes elsewhere."""
    if path == "-" and is_terminal(sys.stdout):
        return max(_NARROWEST, shutil.get_terminal_size((80, 24)).columns)
    return None


def _plain(source: Deck, messages: Sequence[Diagnostic], notes_above: Mapping[int, Sequence[str]]) -> Iterator[str]:
    yield f"{source.source}: {len(source.cards)} cards"
    yield from _cards(source, messages, notes_above, {}, 0)
    for message in messages:
        if not 1 <= message.card <= len(source.cards):
            yield message.line(source.source)


def _cards(
    source: Deck,
    messages: Sequence[Diagnostic],
    notes_above: Mapping[int, Sequence[str]],
    statistics: Mapping[int, str],
    width: int,
) -> Iterator[str]:
    """Yield the cards with their statistics, ``width`` columns wide, and the compiler's messages with carets."""
    for card in source.cards:
        yield from notes_above.get(card.number, ())
        yield f"{card.number:5d}{statistics.get(card.number, ''):<{width}}  {card.text}"
        for message in messages:
            if message.card == card.number:
                caret = " " * (message.column - 1) + "^ " if message.column else ""
                kind = "warning" if message.warning else "error"
                yield f"{'':<{width + 7}}{caret}{kind}: {message.message}"


def _with_statistics(
    source: Deck,
    messages: Sequence[Diagnostic],
    program: Program,
    result: Result,
    divergence: Divergence | None,
    sampling: Sampling | None,
    notes_above: Mapping[int, Sequence[str]],
) -> Iterator[str]:
    time = f"{measure(program, result).processor_time} of processor time on a 1620"
    yield f"{program.source}: {result.statements} statements in {time}"
    if divergence is not None:
        yield from _comparison(divergence)
    if sampling is not None:
        yield f"digits that {len(sampling.numbers.members)} stochastic runs have in common: {sampling.numbers.name}"
    yield " card    count  time%  lost" + (" digits" if sampling else "")
    statistics = _statistics(program, result, divergence, sampling)
    yield from _cards(source, messages, notes_above, statistics, 29 if sampling else 22)


def _comparison(divergence: Divergence) -> Iterator[str]:
    studied, reference = divergence.arithmetics
    until = ""
    if divergence.first_decision is not None:
        until = f", up to card {divergence.first_decision.line.place.card}, the first decision that differs"
    yield f"digits lost, of {divergence.digits:.1f}: {studied} against {reference}{until}"
    if divergence.apart:
        yield f"comparison ended: {divergence.apart}"


def _statistics(
    program: Program, result: Result, divergence: Divergence | None, sampling: Sampling | None
) -> dict[int, str]:
    """Return the figures that are printed next to each statement as text, by the number of the statement's first card.

    The columns are the number of times that the statement ran, its share of the processor time, the greatest number of
    digits that one of its values lost, and the least number of digits that stochastic runs estimate for its values.
    """
    counts = dict(measure(program, result).statements)
    seconds = [time.seconds for time in shares(program, result)]
    total = sum(seconds) or 1.0
    losses = divergence.losses if divergence is not None and divergence.digits else ()
    lost = {loss.line.index: f"{loss.worst:.1f}" for loss in losses}
    digits = {row.line.index: f" {row.worst:6.1f}" for row in sampling.statements} if sampling else {}
    columns = {}
    for line in program.statements:
        count, share = counts.get(line.index, 0), 100 * seconds[line.index] / total
        percent = f"{share:.1f}" if count else ""
        figures = f"{count:9d} {percent:>6} {lost.get(line.index, ''):>5}"
        columns[line.place.card] = figures + digits.get(line.index, "")
    return columns
