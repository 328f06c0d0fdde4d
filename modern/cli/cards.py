"""``hull1620 cards``: punch points as a data deck."""

import argparse

from emulator.errors import FileError
from emulator.files import write_text
from modern.cli.shared.console import OK, print_notes
from modern.cli.shared.inputs import points_of, punch_epsilon
from modern.formats.deck import MAX_POINTS, UnfitPoint, data_deck


def main(args: argparse.Namespace) -> int:
    points = points_of(args.points)
    source, count = points.source, len(points.points)
    try:
        deck = data_deck(points.points, source, args.truncate)
    except UnfitPoint as error:
        remedy = " (--truncate drops the others)" if error.digits else ""
        line = points.places[error.point - 1]
        raise FileError(f"{source}: {line}, field {error.field}: {error.why}{remedy}") from None
    except ValueError as error:
        raise FileError(f"{source}: {error}") from None
    if args.epsilon is not None:
        deck = punch_epsilon(deck, args.epsilon)
    write_text(args.output, deck.text())
    print_notes(f"note: {note}" for note in points.notes)
    if count > MAX_POINTS:
        print_notes([f"warning: {source}: {count} points; the programs as listed accept at most {MAX_POINTS}"])
    return OK
