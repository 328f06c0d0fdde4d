"""``hull1620 punched``: a deck drawn as punched cards."""

from __future__ import annotations

import argparse
from dataclasses import replace

from emulator.files import check_writable, write_text
from emulator.language.cards import Deck
from modern.cli.shared.console import OK, UsageError, check_numbered
from modern.cli.shared.inputs import deck_of
from modern.drawing.punched import cards_svg, check_punched
from modern.edition import programs


def main(args: argparse.Namespace) -> int:
    """Read the deck, draw it: in one picture, or in one a card where the name has a place for a number."""
    if args.across < 1:
        raise UsageError(f"--across: {args.across} is not a number of cards")
    deck = programs.deck(args.deck) if args.deck in programs.NAMES else deck_of(args.deck)
    if "%" in args.output:
        _one_a_card(deck, args.output)
    else:
        write_text(args.output, cards_svg(deck, args.across))
    return OK


def _one_a_card(deck: Deck, pattern: str) -> None:
    """A file for each card; none where one of the cards cannot be drawn or one of the files cannot be written."""
    check_numbered(pattern, "number", "card-%03d.svg")
    check_punched(deck)
    names = [pattern % card.number for card in deck.cards]
    check_writable(*names)
    for name, card in zip(names, deck.cards, strict=True):
        write_text(name, cards_svg(replace(deck, cards=(card,)), title=f"{deck.source}: card {card.number}"))
