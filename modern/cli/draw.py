"""``hull1620 draw``: a line drawing of the exact hull of points."""

from __future__ import annotations

import argparse
from pathlib import PurePath

from emulator.files import write_text
from modern.cli.export import exact_hull_of
from modern.cli.shared.console import DIFFERS, OK, say
from modern.drawing.draw import draw_svg
from modern.drawing.scene import eye_of


def main(args: argparse.Namespace) -> int:
    """Read the points, find the hull, write the picture."""
    eye = None if args.eye is None else eye_of(args.eye.split(","))
    hull = exact_hull_of(args.points)
    if not hull.determined:
        say([f"hull1620: {args.points}: {hull.status}"])
        return DIFFERS
    title = args.title if args.title is not None else "" if args.points == "-" else PurePath(args.points).name
    write_text(args.output, draw_svg(hull, eye, title))
    return OK
