"""``hull1620 draw``: a line drawing of the exact hull of points, of its construction, or beside a punched result."""

from __future__ import annotations

import argparse
from pathlib import PurePath

from emulator.files import write_text
from emulator.language.cards import read_deck
from modern.cli.export import exact_hull_of
from modern.cli.shared.console import DIFFERS, OK, UsageError, say
from modern.comparison.card_differences import card_differences
from modern.drawing.against import draw_against
from modern.drawing.draw import Show, draw_svg
from modern.drawing.scene import eye_of
from modern.drawing.stages import frames, played, strip
from modern.thesis.cards import read_hull


def main(args: argparse.Namespace) -> int:
    """Read the points, find the hull, write the picture."""
    eye = None if args.eye is None else eye_of(args.eye.split(","))
    staged = args.stages or args.animate
    if staged and (args.width is not None or args.labels != "programs" or args.no_hidden or args.no_points):
        raise UsageError("--stages and --animate have one form: no --width, --labels, --no-hidden, --no-points")
    if args.coplanar_within is not None and (staged or args.against is not None):
        raise UsageError("--coplanar-within reads the hull alone: not with --stages, --animate or --against")
    if args.points == "-" == args.against:
        raise UsageError("points and cards cannot both come from standard input")
    hull, notes = exact_hull_of(args.points, procedure=True, history=staged, within=args.coplanar_within)
    if not hull.determined:
        say([f"hull1620: {args.points}: {hull.status}"])
        return DIFFERS
    title = args.title if args.title is not None else "" if args.points == "-" else PurePath(args.points).name
    show = Show(args.labels, not args.no_hidden, not args.no_points)
    if staged:
        found = frames(hull, eye)
        text = strip(found, title) if args.stages else played(found, title)
    elif args.against is not None:
        cards = read_deck(args.against)
        claim = card_differences(read_hull([card.text for card in cards.cards]), hull, cards.source)
        text = draw_against(hull, claim, eye, title, args.width, show)
    else:
        text = draw_svg(hull, eye, title, args.width, show)
    write_text(args.output, text)
    say(f"note: {note}" for note in notes)
    return OK
