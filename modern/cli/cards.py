"""``hull1620 cards``: points to a data deck."""

from __future__ import annotations

import argparse

from emulator.errors import FileError
from emulator.files import write_text
from modern.cli.shared.console import OK, UsageError, say
from modern.cli.shared.inputs import points_of
from modern.formats.deck import MAX_POINTS, UnfitPoint, data_deck, with_epsilon


def main(args: argparse.Namespace) -> int:
    """Read the points, write the deck."""
    found = points_of(args.points)
    source, points = found.source, found.points
    try:
        deck = data_deck(points, source, args.truncate)
    except UnfitPoint as error:
        cut = " (--truncate cuts them)" if error.digits else ""
        raise FileError(f"{source}: {found.places[error.point - 1]}, field {error.field}: {error.why}{cut}") from None
    except ValueError as error:
        raise FileError(f"{source}: {error}") from None
    if args.epsilon is not None:
        try:
            deck = with_epsilon(deck, args.epsilon)
        except ValueError as error:
            raise UsageError(f"--{error}") from None
    write_text(args.output, deck.text())
    say(f"note: {note}" for note in found.notes)
    if len(points) > MAX_POINTS:
        say([f"warning: {source}: {len(points)} points; the programs as listed take at most {MAX_POINTS}"])
    return OK
