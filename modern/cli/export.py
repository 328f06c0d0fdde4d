"""``hull1620 export``: the exact hull of points in the format of another program."""

from __future__ import annotations

import argparse

from modern.cli.shared.console import DIFFERS, OK, UsageError, say
from modern.cli.shared.inputs import points_of
from modern.formats.hulls import format_of, write_hull
from modern.geometry.hull import Hull


def main(args: argparse.Namespace) -> int:
    """Read the points, find the hull, write the file."""
    form = args.format or _form(args.output)
    hull = exact_hull_of(args.points)
    if not hull.determined and form != "json":
        say([f"hull1620: {args.points}: {hull.status}"])
        return DIFFERS
    write_hull(hull, args.output, form)
    return OK if hull.determined else DIFFERS


def exact_hull_of(path: str, history: bool = False) -> Hull:
    """The hull of a file's points in exact arithmetic, with its stages if asked; notes go to standard error."""
    found = points_of(path)
    say(f"note: {note}" for note in found.notes)
    # Imported here, so that a fault of the file is told without waiting.
    from modern.port import convex_hull

    hull = convex_hull(found.points, "exact", history=history, on_refusal="return")
    for point, first in hull.duplicates:
        say([f"note: {found.source}: {found.places[point]}: the point of {found.places[first]} again"])
    return hull


def _form(path: str) -> str:
    if path == "-":
        raise UsageError("export: give a file with -o, or a --format for standard output")
    return format_of(path)
