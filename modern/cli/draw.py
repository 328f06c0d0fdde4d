"""``hull1620 draw``: draw the exact hull of points, its construction, or its differences from punched cards."""

import argparse
from pathlib import PurePath

from emulator.language.cards import read_deck
from modern.cli.shared.console import DIFFERS, OK, UsageError, print_notes
from modern.cli.shared.inputs import exact_hull_of
from modern.comparison.difference import card_differences
from modern.drawing.against import draw_against
from modern.drawing.draw import Show, draw_svg
from modern.drawing.scene import eye_of
from modern.drawing.stages import frames, played, strip
from modern.drawing.svg import check_picture, write_picture
from modern.thesis.cards import read_hull


def main(args: argparse.Namespace) -> int:
    check_picture(args.output)
    if args.animate and args.output != "-" and not args.output.lower().endswith(".svg"):
        raise UsageError(f"{args.output}: only an SVG file can be animated; --stages draws the stages in a row")
    eye = None if args.eye is None else eye_of(args.eye.split(","))
    shows_stages = args.stages or args.animate
    if shows_stages and (args.width is not None or args.labels != "programs" or args.no_hidden or args.no_points):
        raise UsageError("--stages and --animate cannot be combined with --width, --labels, --no-hidden or --no-points")
    if args.coplanar_within is not None and (shows_stages or args.against is not None):
        raise UsageError("--coplanar-within cannot be combined with --stages, --animate or --against")
    if args.points == "-" == args.against:
        raise UsageError("points and cards cannot both come from standard input; name a file for one of them")
    hull, notes = exact_hull_of(args.points, procedure=True, history=shows_stages, within=args.coplanar_within)
    if not hull.determined:
        print_notes([f"hull1620: {args.points}: {hull.status}"])
        return DIFFERS
    title = args.title if args.title is not None else "" if args.points == "-" else PurePath(args.points).name
    show = Show(args.labels, not args.no_hidden, not args.no_points)
    if shows_stages:
        stages = frames(hull, eye)
        picture = strip(stages, title) if args.stages else played(stages, title)
    elif args.against is not None:
        cards = read_deck(args.against)
        differences = card_differences(read_hull([card.text for card in cards.cards]), hull, cards.source)
        picture = draw_against(hull, differences, eye, title, args.width, show)
    else:
        picture = draw_svg(hull, eye, title, args.width, show)
    write_picture(args.output, picture)
    print_notes(f"note: {note}" for note in notes)
    return OK
