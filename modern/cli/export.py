"""``hull1620 export``: the exact hull of points in the format of another program."""

from __future__ import annotations

import argparse
from fractions import Fraction

from modern.cli.shared.console import DIFFERS, OK, UsageError, say
from modern.cli.shared.inputs import points_of
from modern.formats.export import format_of, write_hull
from modern.geometry.coplanar import FLAT, CoplanarError, Joined, coplanar, join_summary, parse_distance
from modern.geometry.hull import Hull


def main(args: argparse.Namespace) -> int:
    """Read the points, find the hull, write the file."""
    form = args.format or _form(args.output)
    hull, notes = exact_hull_of(args.points, procedure=form == "json", within=args.coplanar_within)
    if not hull.determined and form != "json":
        say([f"hull1620: {args.points}: {hull.status}"])
        return DIFFERS
    write_hull(hull, args.output, form)
    say(f"note: {note}" for note in notes)
    return OK if hull.determined else DIFFERS


def exact_hull_of(
    path: str, *, procedure: bool, history: bool = False, within: str | None = None
) -> tuple[Hull, list[str]]:
    """The hull of a file's points in exact arithmetic; and what the user should know of it.

    procedure: it is made by Butler's procedure, for its equations, their order and C, with its stages where ``history``
    asks for them; else by the judge, which takes a fraction of the time where points are many.
    within: read faces as one whose vertices lie within this distance of a plane.
    """
    limit = None if within is None else parse_distance(within)
    found = points_of(path)
    # Imported here, so that a fault of the file is told without waiting.
    if procedure:
        from modern.port import convex_hull

        hull = convex_hull(found.points, "exact", history=history, on_refusal="return")
    else:
        from modern.comparison.outcome import as_hull
        from modern.exact_hull import exact_hull

        hull = as_hull(exact_hull(found.points))
    notes = [*found.notes]
    for point, first in hull.duplicates:
        notes.append(f"{found.source}: {found.places[point]}: the point of {found.places[first]} again")
    if limit is not None and hull.determined:
        hull, joined = read_coplanar(hull, limit, found.source)
        notes.append(f"{found.source}: {join_summary(joined) if joined else FLAT}")
    return hull, notes


def read_coplanar(hull: Hull, limit: Fraction, source: str) -> tuple[Hull, Joined | None]:
    """``coplanar``, its refusal naming the source."""
    try:
        return coplanar(hull, limit)
    except CoplanarError as error:
        raise CoplanarError(f"{source}: --coplanar-within: {error}") from None


def _form(path: str) -> str:
    if path == "-":
        raise UsageError("export: give a file with -o, or a --format for standard output")
    return format_of(path)
