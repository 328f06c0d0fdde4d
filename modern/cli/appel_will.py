"""``hull1620 appel-will``: the hull of a polyhedron from its convex edges, with the tables of the paper."""

from __future__ import annotations

import argparse
import os
import re
import shutil
import sys
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from fractions import Fraction

from emulator.files import check_writable, decoded, source_name, write_text
from modern.cli.shared.console import DIFFERS, OK, UsageError, counted, say
from modern.cli.shared.inputs import read_given
from modern.drawing.scene import eye_of
from modern.formats import off
from modern.formats.columns import aligned
from modern.formats.off import parse_off
from modern.formats.points import Input, parse_bytes
from modern.geometry.coplanar import (
    FLAT,
    CoplanarError,
    Joined,
    distance_text,
    join,
    join_summary,
    joined_mesh,
    parse_distance,
)
from modern.geometry.mesh import Mesh
from modern.papers.appel_will import PRINTED, Assembled, MapError, Method, appel_will, printed
from modern.papers.appel_will.corners import Preprocessing, Rule
from modern.papers.appel_will.loops import Loop
from modern.papers.appel_will.pictures import as_mesh, joined_points, joined_surfaces, solid_svg, star_svg
from modern.papers.appel_will.planar import map_svg
from modern.papers.appel_will.star import as_printed, in_one_pass
from modern.papers.appel_will.surfaces import Fates, Surface, fates_by_points

KINDS = ("a point", "a segment", "a polygon", "a polyhedron")
RELIED_ON: dict[Rule, str] = {
    "any": "no point is on more than three planes (well behaved)",
    "two": "a vertex of the hull is on three outside corners at least",
    "concave": "the angle of a surface at a vertex of the hull is below 180 degrees",
}
"""What each rule for inside corners relies on."""


MOST = 50
"""Points beyond which the tables are told in a line each."""


def main(args: argparse.Namespace) -> int:
    """Read points and map, find the hull, write it or a picture of it, print the tables."""
    _check_options(args)
    check_writable(args.output)
    eye = None if args.eye is None else eye_of(args.eye.split(","))
    within = None if args.coplanar_within is None else parse_distance(args.coplanar_within)
    data, name = read_given(args.points), source_name(args.points)
    found = parse_bytes(data, name)
    given = parse_off(decoded(data, name), name).faces if found.kind == "off" else ()
    if args.inside_corners and not given:
        raise UsageError(f"{found.source}: --inside-corners needs the surfaces of the polyhedron, in an OFF file")
    method = _method(args)
    if args.star is not None:
        method = replace(method, star=as_printed if args.star == "printed" else in_one_pass)
    try:
        hull = appel_will(found.points, given, replace(method, inside_corners=args.inside_corners))
        surface = None if hull.fault else as_mesh(hull, found.points)
        joined = None if within is None or surface is None or hull.dimension < 3 else join(surface, within)
    except (MapError, CoplanarError) as error:
        raise type(error)(f"{found.source}: {error}") from None
    if args.output is not None and surface is not None:
        write_text(args.output, _written(args, found, given, hull, surface, joined, eye))
    say(f"note: {note}" for note in found.notes)
    if args.literal or args.printed is not None:
        say([f"note: taken as printed: {', '.join(_names(args))}"])
    say(
        f"note: {found.source}: {found.places[index]}: the point of {found.places[first]} again"
        for index, first in hull.duplicates
    )
    if within is not None and surface is not None:
        say([f"note: {found.source}: {FLAT if joined is None else join_summary(joined)}"])
    # A file on standard output must be alone there.
    out = sys.stderr if args.output == "-" else sys.stdout
    brief = len(found.points) > MOST and not (args.all or args.trace)
    columns = shutil.get_terminal_size((100, 24)).columns
    for line in (
        _brief(found, given, hull, joined) if brief else _report(found, given, hull, joined, args.trace, columns)
    ):
        print(line, file=out)
    if method.star is as_printed:
        for line in _false_edges(found, hull):
            print(line, file=out)
    if hull.fault:
        print(f"no hull: {hull.fault}", file=out)
    return DIFFERS if hull.fault else OK


def _check_options(args: argparse.Namespace) -> None:
    """Refuse a picture's options without a picture.  Raises UsageError."""
    picture = args.output is not None and (args.output == "-" or args.output.lower().endswith(".svg"))
    for option, given in (("--map", args.map), ("--star-of", args.star_of)):
        if given and not picture:
            raise UsageError(f"{option} is a picture: it needs -o FILE.svg")
    for option, given in (("--eye", args.eye), ("--width", args.width)):
        if given is not None and not (picture and (args.output != "-" or args.map or args.star_of)):
            raise UsageError(f"{option} is for a picture: it needs -o FILE.svg")
    if args.eye is not None and (args.map or args.star_of):
        raise UsageError("--eye is for the solid; a map has none, and a star polygon is seen along its line")


def _written(
    args: argparse.Namespace,
    found: Input,
    given: Sequence[Surface],
    hull: Assembled,
    surface: Mesh,
    joined: Joined | None,
    eye: Sequence[Fraction] | None,
) -> str:
    """What ``-o`` writes: a picture, or the hull as OFF."""
    name = "" if args.points == "-" else os.path.basename(args.points) if os.path.exists(args.points) else args.points
    if args.map:
        faces = hull.surfaces if joined is None else joined_surfaces(hull, joined)
        return map_svg(faces, hull.edges, name, args.width)
    if args.star_of is not None:
        return star_svg(hull, _pair(args.star_of), name, args.width)
    if args.output.lower().endswith(".svg"):
        return solid_svg(hull, found.points, given, joined, eye, name, args.width)
    return off.write(surface if joined is None else joined_mesh(surface, joined))


def _pair(text: str) -> tuple[int, int]:
    """Two points, counted from 1, as ``3-7``.  Raises UsageError."""
    match = re.fullmatch(r"([0-9]{1,9})[-,]([0-9]{1,9})", text.strip())
    if not match:
        raise UsageError(f"--star-of: {text!r} is not a line I-J, two points by number")
    return int(match[1]) - 1, int(match[2]) - 1


def _names(args: argparse.Namespace) -> Sequence[str]:
    """The rules to take as printed, by name."""
    return PRINTED if args.literal else [name.strip() for name in (args.printed or "").split(",") if name.strip()]


def _method(args: argparse.Namespace) -> Method:
    """Raises UsageError for a rule that does not exist."""
    try:
        return printed(*_names(args))
    except ValueError as error:
        raise UsageError(f"--printed: {error}") from None


def _report(
    found: Input, given: Sequence[Surface], hull: Assembled, joined: Joined | None, trace: bool, width: int
) -> Iterator[str]:
    yield _first(found, given)
    if hull.preprocessing is not None:
        yield from _preprocessing(hull.preprocessing)
    if hull.deleted:
        between = (f"{d.point + 1} ({_line(d.between)})" for d in hull.deleted)
        yield f"deleted as between two others: {', '.join(between)}"
    yield _kind(hull)
    yield ""
    yield "Vertex list"
    yield from _table(("Point", "X", "Y", "Z"), ((str(i + 1), *found.points[i]) for i in hull.vertices))
    yield ""
    yield "Convex edge list"
    rows = ((str(label), str(i + 1), str(j + 1)) for label, (i, j) in enumerate(hull.edges, 1))
    yield from _table(("L", "LC1(L)", "LC2(L)"), rows)
    yield ""
    yield "Loop table"
    for number, loop in enumerate(hull.table.loops, 1):
        yield f"LUP({number},N)  {' '.join(map(str, loop.entries))}"
        if trace:
            yield from _growth(loop, width)
    yield ""
    yield "Topological map"
    for number, surface in enumerate(hull.surfaces, 1):
        yield f"surface {number}: {_points(surface)}"
    if joined is not None:
        yield ""
        yield f"Topological map, faces within {distance_text(joined.within)} of a plane read as one"
        for number, surface in enumerate(joined_surfaces(hull, joined), 1):
            yield f"surface {number}: {_points(surface)}"
    if given and not hull.fault:
        yield ""
        yield from _fates(given, _compared(given, hull, joined))


def _brief(found: Input, given: Sequence[Surface], hull: Assembled, joined: Joined | None) -> Iterator[str]:
    """The report of many points: a line for every table."""
    yield _first(found, given)
    if hull.preprocessing is not None:
        done = hull.preprocessing
        yield f"{counted(len(done.deleted), 'point')} deleted by rule {done.rule} before any projection"
    if hull.deleted:
        yield f"{counted(len(hull.deleted), 'point')} deleted as between two others"
    yield _kind(hull)
    yield f"convex edge list: {counted(len(hull.edges), 'line')}"
    yield f"loop table: {counted(len(hull.table.loops), 'loop')}{_sizes([loop.entries for loop in hull.table.loops])}"
    if joined is not None:
        surfaces = joined_surfaces(hull, joined)
        within = distance_text(joined.within)
        yield f"faces within {within} read as one: {counted(len(surfaces), 'surface')}{_sizes(surfaces)}"
    if given and not hull.fault:
        fates = _compared(given, hull, joined)
        gone = sum(other is None for other in fates.of)
        respecified = len(given) - gone - len(fates.unchanged)
        yield (
            f"of the {counted(len(given), 'surface')} given {len(fates.unchanged)} kept, {respecified} respecified, "
            f"{gone} deleted; {len(fates.added)} added"
        )
    yield "--all lists everything"


def _sizes(loops: Sequence[Sequence[int]]) -> str:
    """How many loops have how many lines."""
    sizes = Counter(map(len, loops))
    return f" ({', '.join(f'{sizes[size]} of {size} lines' for size in sorted(sizes))})" if sizes else ""


def _first(found: Input, given: Sequence[Surface]) -> str:
    surfaces = f", {counted(len(given), 'surface')}" if given else ""
    return f"{found.source}: {counted(len(found.points), 'point')}{surfaces}"


def _kind(hull: Assembled) -> str:
    of = f" of {len(hull.vertices)} points" if hull.dimension else ""
    return f"{counted(hull.projections, 'projection')}; {KINDS[hull.dimension]}{of}"


def _compared(given: Sequence[Surface], hull: Assembled, joined: Joined | None) -> Fates:
    """What became of the surfaces given."""
    if joined is None:
        return hull.fates(given)
    return fates_by_points(given, joined_points(hull, joined), joined_surfaces(hull, joined))


def _preprocessing(done: Preprocessing) -> Iterator[str]:
    lines = (f"{_line(c.line.ends)} (surfaces {c.line.on + 1}, {c.line.beyond + 1})" for c in done.inside)
    yield f"inside corners: {', '.join(lines) or 'none'}"
    yield f"deleted by rule {done.rule} before any projection: {_points(done.deleted) or 'none'}"
    yield f"  relied on: {RELIED_ON[done.rule]}"
    if done.rule == "any":
        if done.crowded:
            yield f"  this is NOT so at {_points(done.crowded)}: the hull may be wrong; rules two and concave are safe"
        else:
            yield "  this is so for the surfaces given"


def _growth(loop: Loop, width: int) -> Iterator[str]:
    """The start of a loop and the use of every edge after it, in as many columns as there is room for."""
    yield f"  type {loop.kind}, SP {loop.start + 1}, MP {loop.match + 1}"
    cell = len(str(len(loop.uses))) + 1
    columns = max(1, (width - len("  IUC(L)")) // cell)
    for first in range(0, len(loop.uses), columns):
        some = loop.uses[first : first + columns]
        yield "  L     " + "".join(f"{label:>{cell}}" for label in range(first + 1, first + len(some) + 1))
        yield "  IUC(L)" + "".join(f"{count:>{cell}}" for count in some)


def _fates(given: Sequence[Surface], fates: Fates) -> Iterator[str]:
    yield "The surfaces given"
    for number, other in enumerate(fates.of):
        if other is None:
            yield f"surface {number + 1}: deleted"
        else:
            fate = "kept" if number in fates.unchanged else "respecified"
            yield f"surface {number + 1}: {fate} as surface {other + 1}"
    if fates.added:
        yield f"added: {', '.join(f'surface {number + 1}' for number in fates.added)}"


def _false_edges(found: Input, hull: Assembled) -> Iterator[str]:
    """What the printed star polygon test took for edges."""
    right = set(appel_will(found.points).edges)
    wrong = [label for label, edge in enumerate(hull.edges, 1) if edge not in right]
    if wrong:
        yield ""
        yield f"{len(wrong)} of {len(hull.edges)} edges are none, by images on one ray: {', '.join(map(str, wrong))}"


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> Iterator[str]:
    return aligned([head, *rows], right=True)


def _points(indices: Iterable[int]) -> str:
    return " ".join(str(index + 1) for index in indices)


def _line(ends: tuple[int, int]) -> str:
    return f"{ends[0] + 1}-{ends[1] + 1}"
