"""``hull1620 check``: show the compiler's messages below their cards, or explain error numbers."""

import argparse
import textwrap
from collections.abc import Iterator

from emulator.errors import explanations
from emulator.language.compiler import translate
from emulator.objectdeck.extent import extent
from modern.cli.shared.console import BAD_INPUT, OK, UsageError, counted
from modern.cli.shared.programs import source_deck

# The greatest number of messages that are printed for one deck.
_MOST_MESSAGES = 100


def main(args: argparse.Namespace) -> int:
    if args.explain is not None:
        if args.program is not None:
            raise UsageError("--explain: expected only an error number, found also a program")
        print("\n".join(explained(args.explain)))
        return OK
    if args.program is None:
        raise UsageError("check: expected a program, or --explain with an error number")
    deck = source_deck(args)
    program, messages = translate(deck)
    cards = {card.number: card.text for card in deck.cards}
    for message in messages[:_MOST_MESSAGES]:
        print(message.line(deck.source))
        if message.card in cards:
            print(f"    {cards[message.card]}")
            if message.column:
                print("    " + " " * (message.column - 1) + "^")
    if len(messages) > _MOST_MESSAGES:
        print(f"{deck.source}: and {len(messages) - _MOST_MESSAGES} more messages")
    if program is None:
        print(f"{deck.source}: {counted(sum(not message.warning for message in messages), 'error')}")
        return BAD_INPUT
    size = extent(program)
    if overlap_message := size.overlap(args.core):
        print(f"{deck.source}: {overlap_message}")
    if size.is_certain(args.core):
        return BAD_INPUT
    sizes = f"{len(deck.cards)} cards, {len(program.statements)} executable statements"
    print(f"{deck.source}: {sizes}, {size.data} positions of data, no errors")
    return OK


def explained(number: str) -> Iterator[str]:
    """Yield the explanation of an error number with an example, in 80 columns; "all" stands for every number.

    Raise UsageError for an unknown number.
    """
    known = explanations()
    for index, name in enumerate(known if number == "all" else [number.upper()]):
        if name not in known:
            raise UsageError(f"--explain: unknown error {number}; expected all, or one of {', '.join(known)}")
        explanation = known[name]
        if index:
            yield ""
        yield from textwrap.wrap(f"error {name}: {explanation.title}", 80, subsequent_indent="    ")
        yield from _paragraph(explanation.meaning)
        yield from (f"    | {card}" for card in explanation.example)
        yield from _paragraph(f"remedy: {explanation.remedy.strip()}")
        yield from _paragraph(f"source: {explanation.source}")


def _paragraph(text: str) -> list[str]:
    return textwrap.wrap(text, 80, initial_indent="  ", subsequent_indent="  ")
