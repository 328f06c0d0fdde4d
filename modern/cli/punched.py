"""``hull1620 punched``: draw a deck as punched cards."""

import argparse
from dataclasses import replace

from emulator.files import check_writable, write_text
from emulator.language.cards import Deck
from modern.cli.shared.console import OK, UsageError, check_numbered
from modern.cli.shared.inputs import deck_of
from modern.drawing.punched import cards_svg, check_punched
from modern.edition import programs


def main(args: argparse.Namespace) -> int:
    if args.across < 1:
        raise UsageError(f"--across: expected at least 1 card, found {args.across}")
    deck = programs.deck(args.deck) if args.deck in programs.NAMES else deck_of(args.deck)
    if "%" in args.output:
        _draw_each_card(deck, args.output)
    else:
        write_text(args.output, cards_svg(deck, args.across))
    return OK


def _draw_each_card(deck: Deck, pattern: str) -> None:
    """Write a file for each card; if a card cannot be drawn or a file cannot be written, write no file."""
    check_numbered(pattern, "number", "card-%03d.svg")
    check_punched(deck)
    names = [pattern % card.number for card in deck.cards]
    check_writable(*names)
    for name, card in zip(names, deck.cards, strict=True):
        write_text(name, cards_svg(replace(deck, cards=(card,)), title=f"{deck.source}: card {card.number}"))
