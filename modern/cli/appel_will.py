"""``hull1620 appel-will``: the hull of a polyhedron from its convex edges, with the tables of the paper."""

from __future__ import annotations

import argparse
import shutil
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from emulator.files import check_writable, decoded, source_name, write_text
from modern.cli.shared.console import DIFFERS, OK, UsageError, counted, say
from modern.cli.shared.inputs import read_given
from modern.formats import off
from modern.formats.off import parse_off
from modern.formats.points import Input, parse_bytes
from modern.geometry.mesh import Mesh
from modern.papers.appel_will import PRINTED, Assembled, MapError, Method, appel_will, printed
from modern.papers.appel_will.corners import Preprocessing, Rule
from modern.papers.appel_will.loops import Loop
from modern.papers.appel_will.star import as_printed, in_one_pass
from modern.papers.appel_will.surfaces import Surface

KINDS = ("a point", "a segment", "a polygon", "a polyhedron")
RELIED_ON: dict[Rule, str] = {
    "any": "no point is on more than three planes (well behaved)",
    "two": "a vertex of the hull is on three outside corners at least",
    "concave": "the angle of a surface at a vertex of the hull is below 180 degrees",
}
"""What each rule for inside corners relies on."""


def main(args: argparse.Namespace) -> int:
    """Read points and map, find the hull, print the tables."""
    check_writable(args.output)
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
    except MapError as error:
        raise MapError(f"{found.source}: {error}") from None
    say(f"note: {note}" for note in found.notes)
    if args.literal or args.printed is not None:
        say([f"note: taken as printed: {', '.join(_names(args))}"])
    say(
        f"note: {found.source}: {found.places[index]}: the point of {found.places[first]} again"
        for index, first in hull.duplicates
    )
    if args.output is not None and not hull.fault:
        write_text(args.output, off.write(_mesh(found, hull)))
    # An OFF file on standard output must be alone there.
    out = sys.stderr if args.output == "-" else sys.stdout
    for line in _report(found, given, hull, args.trace, shutil.get_terminal_size((100, 24)).columns):
        print(line, file=out)
    if method.star is as_printed:
        for line in _false_edges(found, hull):
            print(line, file=out)
    if hull.fault:
        print(f"no hull: {hull.fault}", file=out)
    return DIFFERS if hull.fault else OK


def _names(args: argparse.Namespace) -> Sequence[str]:
    """The rules to take as printed, by name."""
    return PRINTED if args.literal else [name.strip() for name in (args.printed or "").split(",") if name.strip()]


def _method(args: argparse.Namespace) -> Method:
    """Raises UsageError for a rule that does not exist."""
    try:
        return printed(*_names(args))
    except ValueError as error:
        raise UsageError(f"--printed: {error}") from None


def _report(found: Input, given: Sequence[Surface], hull: Assembled, trace: bool, width: int) -> Iterator[str]:
    surfaces = f", {counted(len(given), 'surface')}" if given else ""
    yield f"{found.source}: {counted(len(found.points), 'point')}{surfaces}"
    if hull.preprocessing is not None:
        yield from _preprocessing(hull.preprocessing)
    if hull.deleted:
        between = (f"{d.point + 1} ({_line(d.between)})" for d in hull.deleted)
        yield f"deleted as between two others: {', '.join(between)}"
    of = f" of {len(hull.vertices)} points" if hull.dimension else ""
    yield f"{counted(hull.projections, 'projection')}; {KINDS[hull.dimension]}{of}"
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
    if given and not hull.fault:
        yield ""
        yield from _fates(given, hull)


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


def _fates(given: Sequence[Surface], hull: Assembled) -> Iterator[str]:
    yield "The surfaces given"
    fates = hull.fates(given)
    for number, other in enumerate(fates.of):
        if other is None:
            yield f"surface {number + 1}: deleted"
        else:
            yield f"surface {number + 1}: {'kept' if number in fates.kept else 'respecified'} as surface {other + 1}"
    if fates.added:
        yield f"added: {', '.join(f'surface {number + 1}' for number in fates.added)}"


def _false_edges(found: Input, hull: Assembled) -> Iterator[str]:
    """What the printed star polygon test took for edges."""
    right = set(appel_will(found.points).edges)
    wrong = [label for label, edge in enumerate(hull.edges, 1) if edge not in right]
    if wrong:
        yield ""
        yield f"{len(wrong)} of {len(hull.edges)} edges are none, by images on one ray: {', '.join(map(str, wrong))}"


def _mesh(found: Input, hull: Assembled) -> Mesh:
    places = {index: place for place, index in enumerate(hull.vertices)}
    faces = tuple(tuple(places[index] for index in surface) for surface in hull.outward())
    return Mesh(hull.dimension, tuple(found.points[index] for index in hull.vertices), faces)


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> Iterator[str]:
    cells = [head, *rows]
    widths = [max(len(row[k]) for row in cells) for k in range(len(head))]
    for row in cells:
        yield "  ".join(text.rjust(width) for text, width in zip(row, widths, strict=True))


def _points(indices: Iterable[int]) -> str:
    return " ".join(str(index + 1) for index in indices)


def _line(ends: tuple[int, int]) -> str:
    return f"{ends[0] + 1}-{ends[1] + 1}"
