"""``hull1620 appel-will``: find the hull of a polyhedron from its convex edges, and print the tables of the paper."""

import argparse
import os
import re
import shutil
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from fractions import Fraction

from emulator.errors import quoted
from emulator.files import decoded, source_name, write_text
from modern.cli.shared.console import DIFFERS, OK, UsageError, counted, print_notes, print_report
from modern.cli.shared.inputs import read_input
from modern.drawing.scene import eye_of
from modern.formats import off
from modern.formats.columns import aligned
from modern.formats.off import parse_off
from modern.formats.points import Input, parse_bytes
from modern.geometry import coplanar
from modern.geometry.coplanar import CoplanarError, Joined
from modern.geometry.mesh import Mesh
from modern.papers.appel_will import PRINTED, Assembled, MapError, appel_will, printed
from modern.papers.appel_will.corners import Preprocessing, Rule
from modern.papers.appel_will.loops import Loop
from modern.papers.appel_will.pictures import as_mesh, joined_points, joined_surfaces, solid_svg, star_svg
from modern.papers.appel_will.planar import map_svg
from modern.papers.appel_will.star import as_printed
from modern.papers.appel_will.surfaces import Fates, Surface, fates_by_points

KINDS = ("a point", "a segment", "a polygon", "a polyhedron")
# The assumption under which each rule of ``--inside-corners`` deletes no vertex of the hull.
PREMISES: dict[Rule, str] = {
    "any": "no point lies on more than three planes (the paper calls such an object well behaved)",
    "two": "a vertex of the hull lies on at least three outside corners",
    "concave": "a surface has an angle below 180 degrees at a vertex of the hull",
}

# If there are more points than this, the report summarizes each table in one line.
MOST_POINTS = 50


def main(args: argparse.Namespace) -> int:
    _check_options(args)
    eye = None if args.eye is None else eye_of(args.eye.split(","))
    within = None if args.coplanar_within is None else coplanar.parse_distance(args.coplanar_within)
    data, name = read_input(args.points), source_name(args.points)
    source = parse_bytes(data, name)
    surfaces = parse_off(decoded(data, name), name).faces if source.kind == "off" else ()
    if args.inside_corners and not surfaces:
        raise UsageError(f"{source.source}: --inside-corners needs the surfaces of the polyhedron; use an OFF file")
    names = PRINTED if args.literal else [name.strip() for name in (args.printed or "").split(",") if name.strip()]
    try:
        method = printed(*names)
    except ValueError as error:
        raise UsageError(f"--printed: {error}") from None
    try:
        hull = appel_will(source.points, surfaces, replace(method, inside_corners=args.inside_corners))
        mesh = None if hull.fault else as_mesh(hull, source.points)
        joined = None if within is None or mesh is None or hull.dimension < 3 else coplanar.join(mesh, within)
    except (MapError, CoplanarError) as error:
        raise type(error)(f"{source.source}: {error}") from None
    if args.output is not None and mesh is not None:
        write_text(args.output, _written(args, source, surfaces, hull, mesh, joined, eye))
    print_notes(f"note: {note}" for note in source.notes)
    if args.literal or args.printed is not None:
        print_notes([f"note: these rules are applied as the paper prints them: {', '.join(names)}"])
    print_notes(
        f"note: {source.source}: {source.places[index]} repeats the point of {source.places[first]}"
        for index, first in hull.duplicates
    )
    if within is not None and mesh is not None:
        print_notes([f"note: {source.source}: {coplanar.FLAT if joined is None else coplanar.join_summary(joined)}"])
    is_brief = len(source.points) > MOST_POINTS and not (args.all or args.trace)
    columns = shutil.get_terminal_size((100, 24)).columns
    report = _report(source, surfaces, hull, joined, args.trace, columns)
    print_report(args, _summary(source, surfaces, hull, joined) if is_brief else report)
    print_report(args, _false_edges(source, hull) if method.star is as_printed else ())
    print_report(args, _wrong_counts(hull))
    print_report(args, [f"no hull: {hull.fault}"] if hull.fault else ())
    return DIFFERS if hull.fault else OK


def _check_options(args: argparse.Namespace) -> None:
    """Raise UsageError if an option applies only to a picture that the command does not draw."""
    draws = args.output is not None and (args.output == "-" or args.output.lower().endswith(".svg"))
    for option, argument in (("--map", args.map), ("--star-of", args.star_of)):
        if argument and not draws:
            raise UsageError(f"{option} draws a picture: add -o FILE.svg")
    for option, argument in (("--eye", args.eye), ("--width", args.width)):
        if argument is not None and not (draws and (args.output != "-" or args.map or args.star_of)):
            raise UsageError(f"{option} applies only to a picture: add -o FILE.svg")
    if args.eye is not None and (args.map or args.star_of):
        raise UsageError(
            "--eye applies only to a picture of the solid: "
            "--map draws in the plane, and --star-of shows the view along a line"
        )


def _written(
    args: argparse.Namespace,
    source: Input,
    surfaces: Sequence[Surface],
    hull: Assembled,
    mesh: Mesh,
    joined: Joined | None,
    eye: Sequence[Fraction] | None,
) -> str:
    """Return the contents of the output file: a picture, or the hull in the OFF format."""
    name = "" if args.points == "-" else os.path.basename(args.points) if os.path.exists(args.points) else args.points
    if args.map:
        faces = hull.surfaces if joined is None else joined_surfaces(hull, joined)
        return map_svg(faces, hull.edges, name, args.width)
    if args.star_of is not None:
        return star_svg(hull, _pair(args.star_of), name, args.width)
    if args.output.lower().endswith(".svg"):
        return solid_svg(hull, source.points, surfaces, joined, eye, name, args.width)
    return off.write(mesh if joined is None else coplanar.joined_mesh(mesh, joined))


def _pair(text: str) -> tuple[int, int]:
    """Return the indices, from 0, of the two points of a line such as ``3-7``, which counts points from 1."""
    match = re.fullmatch(r"([0-9]{1,9})[-,]([0-9]{1,9})", text.strip())
    if not match:
        raise UsageError(f"--star-of: expected a line I-J by the numbers of its points, found {quoted(text)}")
    return int(match[1]) - 1, int(match[2]) - 1


def _report(
    source: Input, inputs: Sequence[Surface], hull: Assembled, joined: Joined | None, trace: bool, width: int
) -> Iterator[str]:
    yield _first_line(source, inputs)
    if hull.preprocessing is not None:
        yield from _preprocessing(hull.preprocessing)
    if hull.deleted:
        between = (f"{d.point + 1} ({_line(d.between)})" for d in hull.deleted)
        yield f"deleted as lying between two others: {', '.join(between)}"
    yield _kind(hull)
    yield ""
    yield "Vertex list"
    yield from _table(("Point", "X", "Y", "Z"), ((str(i + 1), *source.points[i]) for i in hull.vertices))
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
        yield f"Topological map, faces within {coplanar.distance_text(joined.within)} of one plane merged"
        for number, surface in enumerate(joined_surfaces(hull, joined), 1):
            yield f"surface {number}: {_points(surface)}"
    if inputs and not hull.fault:
        yield ""
        yield from _fates(inputs, _compared(inputs, hull, joined))


def _summary(source: Input, inputs: Sequence[Surface], hull: Assembled, joined: Joined | None) -> Iterator[str]:
    """Yield the short report, which has one line in place of each table. It is used for many points."""
    yield _first_line(source, inputs)
    if hull.preprocessing is not None:
        deleted_first = counted(len(hull.preprocessing.deleted), "point")
        yield f"{deleted_first} deleted before the first projection by the rule {hull.preprocessing.rule}"
    if hull.deleted:
        yield f"{counted(len(hull.deleted), 'point')} deleted as lying between two others"
    yield _kind(hull)
    yield f"convex edge list: {counted(len(hull.edges), 'line')}"
    yield f"loop table: {counted(len(hull.table.loops), 'loop')}{_sizes([loop.entries for loop in hull.table.loops])}"
    if joined is not None:
        surfaces = joined_surfaces(hull, joined)
        within = coplanar.distance_text(joined.within)
        yield f"faces within {within} of one plane merged: {counted(len(surfaces), 'surface')}{_sizes(surfaces)}"
    if inputs and not hull.fault:
        fates = _compared(inputs, hull, joined)
        deleted = sum(number is None for number in fates.of)
        respecified = len(inputs) - deleted - len(fates.unchanged)
        yield (
            f"of {counted(len(inputs), 'input surface')} {len(fates.unchanged)} kept, {respecified} respecified, "
            f"{deleted} deleted; {len(fates.added)} added"
        )
    yield "for all tables add --all"


def _sizes(loops: Sequence[Sequence[int]]) -> str:
    """Return how many loops have each number of lines: `` (4 with 3 lines, 1 with 5 lines)``."""
    sizes = Counter(map(len, loops))
    return f" ({', '.join(f'{sizes[size]} with {size} lines' for size in sorted(sizes))})" if sizes else ""


def _first_line(source: Input, inputs: Sequence[Surface]) -> str:
    surfaces = f", {counted(len(inputs), 'surface')}" if inputs else ""
    return f"{source.source}: {counted(len(source.points), 'point')}{surfaces}"


def _kind(hull: Assembled) -> str:
    of = f" of {len(hull.vertices)} points" if hull.dimension else ""
    return f"{counted(hull.projections, 'projection')}; {KINDS[hull.dimension]}{of}"


def _compared(inputs: Sequence[Surface], hull: Assembled, joined: Joined | None) -> Fates:
    """Return which surfaces of the object the hull keeps, keeps with another border (respecifies), or deletes."""
    if joined is None:
        return hull.fates(inputs)
    return fates_by_points(inputs, joined_points(hull, joined), joined_surfaces(hull, joined))


def _preprocessing(preprocessing: Preprocessing) -> Iterator[str]:
    lines = (f"{_line(c.line.ends)} (surfaces {c.line.on + 1}, {c.line.beyond + 1})" for c in preprocessing.inside)
    yield f"inside corners: {', '.join(lines) or 'none'}"
    deleted = _points(preprocessing.deleted) or "none"
    yield f"points deleted before the first projection by the rule {preprocessing.rule}: {deleted}"
    yield f"  premise: {PREMISES[preprocessing.rule]}"
    if preprocessing.rule == "any":
        if preprocessing.crowded:
            points = _points(preprocessing.crowded)
            yield f"  it does NOT hold at {points}: the hull may be wrong; use the rule two or concave"
        else:
            yield "  it holds for the input surfaces"


def _growth(loop: Loop, width: int) -> Iterator[str]:
    """Yield the type, start point SP and match point MP of a loop, and how often each edge has been used so far."""
    yield f"  type {loop.kind}, start SP {loop.start + 1}, match MP {loop.match + 1}"
    cell = len(str(len(loop.uses))) + 1
    columns = max(1, (width - len("  IUC(L)")) // cell)
    for first in range(0, len(loop.uses), columns):
        uses = loop.uses[first : first + columns]
        yield "  L     " + "".join(f"{label:>{cell}}" for label in range(first + 1, first + len(uses) + 1))
        yield "  IUC(L)" + "".join(f"{count:>{cell}}" for count in uses)


def _fates(inputs: Sequence[Surface], fates: Fates) -> Iterator[str]:
    yield "Input surfaces"
    for number, new_number in enumerate(fates.of):
        if new_number is None:
            yield f"surface {number + 1}: deleted"
        else:
            fate = "kept" if number in fates.unchanged else "respecified"
            yield f"surface {number + 1}: {fate} as surface {new_number + 1}"
    if fates.added:
        yield f"added: {', '.join(f'surface {number + 1}' for number in fates.added)}"


def _false_edges(source: Input, hull: Assembled) -> Iterator[str]:
    """Yield a report of the lines that the paper's test for edges, applied as printed, wrongly accepts as edges."""
    edges = set(appel_will(source.points).edges)
    false = [label for label, edge in enumerate(hull.edges, 1) if edge not in edges]
    if false:
        yield ""
        labels = ", ".join(map(str, false))
        yield f"{len(false)} of {len(hull.edges)} lines are not edges of the hull: {labels}"
        yield "the star polygon test as printed accepts them, because images of two points lie on one ray"


def _wrong_counts(hull: Assembled) -> Iterator[str]:
    """Yield a report if step 10, applied as printed, has cleared the counts IUC of lines that the loops use."""
    wrong = sum(count != right for count, right in zip(hull.table.uses, hull.table.in_loops, strict=True))
    if wrong:
        yield ""
        yield f"{wrong} of {len(hull.edges)} counts IUC are wrong at the end: step 10 as printed sets all counts to 0"


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> Iterator[str]:
    return aligned([head, *rows], right=True)


def _points(indices: Iterable[int]) -> str:
    return " ".join(str(index + 1) for index in indices)


def _line(ends: tuple[int, int]) -> str:
    return f"{ends[0] + 1}-{ends[1] + 1}"
