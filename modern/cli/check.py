"""``hull1620 check``: the compiler's messages, with card and column marked."""

from __future__ import annotations

import argparse

from emulator.language.compiler import translate
from modern.cli.shared.console import BAD_INPUT, OK
from modern.cli.shared.machine import layers_of, source_deck


def main(args: argparse.Namespace) -> int:
    """Compile and show every message under its card."""
    deck = source_deck(args.program, layers_of(args), args.upcase)
    program, messages = translate(deck)
    cards = {card.number: card.text for card in deck.cards}
    for message in messages:
        print(message.line(deck.source))
        if message.card in cards:
            print(f"    {cards[message.card]}")
            if message.column:
                print("    " + " " * (message.column - 1) + "^")
    if program is None:
        errors = sum(not message.warning for message in messages)
        print(f"{deck.source}: {errors} error{'s' * (errors != 1)}")
        return BAD_INPUT
    statements, data = len(program.statements), program.storage.fields * 10
    print(
        f"{deck.source}: {len(deck.cards)} cards, {statements} statements to run, {data} positions of data, no errors"
    )
    return OK
