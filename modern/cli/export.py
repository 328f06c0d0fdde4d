"""``hull1620 export``: write the exact hull of points in the format of another program."""

import argparse

from modern.cli.shared.console import DIFFERS, OK, UsageError, print_notes
from modern.cli.shared.inputs import exact_hull_of
from modern.formats.export import format_of, write_hull


def main(args: argparse.Namespace) -> int:
    if args.format is None and args.output == "-":
        raise UsageError("export: add -o FILE, or add --format to write to standard output")
    form = args.format or format_of(args.output)
    hull, notes = exact_hull_of(args.points, procedure=form == "json", within=args.coplanar_within)
    if not hull.determined and form != "json":
        print_notes([f"hull1620: {args.points}: {hull.status}"])
        return DIFFERS
    write_hull(hull, args.output, form)
    print_notes(f"note: {note}" for note in notes)
    return OK if hull.determined else DIFFERS
