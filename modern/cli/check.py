"""``hull1620 check``: the compiler's messages, with card and column marked; error numbers explained."""

from __future__ import annotations

import argparse
import textwrap
from collections.abc import Iterator

from emulator.errors import explanations
from emulator.language.compiler import translate
from emulator.machine.session import overlap
from modern.cli.shared.console import BAD_INPUT, OK, UsageError
from modern.cli.shared.machine import layers_of, source_deck

_MOST = 100
"""Messages that are shown of one deck."""


def main(args: argparse.Namespace) -> int:
    """Compile and show every message under its card, or explain error numbers."""
    if args.explain is not None:
        if args.program is not None:
            raise UsageError("--explain: takes a number and no program")
        print("\n".join(explained(args.explain)))
        return OK
    if args.program is None:
        raise UsageError("check: a program, or --explain and an error number, is missing")
    deck = source_deck(args.program, layers_of(args), args.upcase)
    program, messages = translate(deck)
    cards = {card.number: card.text for card in deck.cards}
    for message in messages[:_MOST]:
        print(message.line(deck.source))
        if message.card in cards:
            print(f"    {cards[message.card]}")
            if message.column:
                print("    " + " " * (message.column - 1) + "^")
    if len(messages) > _MOST:
        print(f"{deck.source}: ... and {len(messages) - _MOST} more")
    if program is None:
        errors = sum(not message.warning for message in messages)
        print(f"{deck.source}: {errors} error{'s' * (errors != 1)}")
        return BAD_INPUT
    lacking = overlap(program, args.core)
    if lacking:
        print(f"{deck.source}: {lacking}")
        return BAD_INPUT
    statements, data = len(program.statements), program.storage.fields * 10
    print(
        f"{deck.source}: {len(deck.cards)} cards, {statements} statements to run, {data} positions of data, no errors"
    )
    return OK


def explained(number: str) -> Iterator[str]:
    """What an error number means, with an example, in 80 columns; ``all`` for every one.

    Raises UsageError for a number there is not.
    """
    known = explanations()
    wanted = list(known) if number == "all" else [number.upper()]
    for at, one in enumerate(wanted):
        if one not in known:
            raise UsageError(f"--explain: there is no error {number}; there are {', '.join(known)}, and all for all")
        found = known[one]
        if at:
            yield ""
        yield from textwrap.wrap(f"error {one}: {found.title}", 80, subsequent_indent="    ")
        for name, text in (("", found.meaning), ("remedy: ", found.remedy.strip()), ("source: ", found.source)):
            yield from textwrap.wrap(name + text, 80, initial_indent="  ", subsequent_indent="  ")
            if not name:
                yield from (f"    | {card}" for card in found.example)
