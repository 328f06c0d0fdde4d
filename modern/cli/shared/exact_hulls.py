"""The exact hull of a file of points, for the commands that write or draw it."""

from __future__ import annotations

from modern.cli.shared.inputs import points_of
from modern.geometry.coplanar import FLAT, CoplanarError, coplanar, join_summary, parse_distance
from modern.geometry.hull import Hull


def exact_hull_of(
    path: str, *, procedure: bool, history: bool = False, within: str | None = None
) -> tuple[Hull, list[str]]:
    """Return the hull of a file's points in exact arithmetic, and notes for the user.

    procedure: use Butler's procedure, which gives its equations, their order and C, and with ``history`` its stages.
    Otherwise use the exact hull, which is much faster for many points.
    within: merge faces whose vertices lie within this distance of one plane.
    """
    limit = None if within is None else parse_distance(within)
    points = points_of(path)
    # These imports take time, and an unreadable file must be reported at once.
    if procedure:
        from modern.port import convex_hull

        hull = convex_hull(points.points, "exact", history=history, on_refusal="return")
    else:
        from modern.comparison.outcome import as_hull
        from modern.exact_hull import exact_hull

        hull = as_hull(exact_hull(points.points))
    notes = [*points.notes]
    for point, first in hull.duplicates:
        notes.append(f"{points.source}: {points.places[point]} repeats the point of {points.places[first]}")
    if limit is not None and hull.determined:
        try:
            hull, joined = coplanar(hull, limit)
        except CoplanarError as error:
            raise CoplanarError(f"{points.source}: --coplanar-within: {error}") from None
        notes.append(f"{points.source}: {join_summary(joined) if joined else FLAT}")
    return hull, notes
