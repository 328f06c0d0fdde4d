"""``hull1620 octree-hull``: the digital hull of a solid from its octree, by Yau and Srihari."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from emulator.files import check_writable, write_text
from modern.cli.shared.console import DIFFERS, OK, UsageError, counted, say
from modern.cli.shared.volumes import array_note, coordinate_words, printable, volume_of
from modern.digital.solids import Volume
from modern.digital.volumes import ARRAYS, write_array
from modern.formats.export import mesh_text
from modern.papers.kovalevsky_schulz import CENTRES, voxel_hull
from modern.papers.yau_srihari import OctreeHull, Printed, octree_hull
from modern.papers.yau_srihari.envelope import Edge, Envelope, Step
from modern.papers.yau_srihari.octree import nodes
from modern.papers.yau_srihari.printed import LITERAL
from modern.papers.yau_srihari.quadtree import Place

Point = tuple[int, int, int]


def main(args: argparse.Namespace) -> int:
    """Read the volume, find its hull, write it, print a summary or every stage."""
    printed = _printed(args)
    check_writable(args.output)
    volume, said = volume_of(args)
    hull = octree_hull(volume, printed)
    array = args.output is not None and args.output.lower().endswith(ARRAYS)
    if array:
        write_array(args.output, hull.filled, volume)
    elif args.output is not None:
        centres = voxel_hull(_in_space(replace(volume, array=hull.filled)), CENTRES)
        write_text(args.output, mesh_text(centres.mesh(straight=True), args.output.rpartition(".")[2].lower()))
        said = (*said, printable(coordinate_words(volume.world, corners=False)))
    elif volume.world is not None and (args.tables or args.trace):
        said = (*said, coordinate_words(None, corners=False))
    say(said)
    x, y, z = (*volume.origin, 0)[:3]
    for line in _lines(hull, volume.source, (x, y, z), args.tables or args.trace, args.trace):
        print(line)
    if printed.names():
        say([f"note: taken as printed: {', '.join(printed.names())}"])
    say(f"note: {fault}" for fault in hull.faults)
    if array:
        say(array_note(args.output, volume))
    return _compared(hull.filled, octree_hull(volume).filled) if printed.names() else OK


def _in_space(volume: Volume) -> Volume:
    """The volume with three axes; of an array of two that has no place in the world, one layer."""
    if volume.dimension == 3 or volume.world is not None:
        return volume
    return replace(volume, array=volume.array[..., None], origin=(*volume.origin, 0))


def _printed(args: argparse.Namespace) -> Printed:
    """The statements to take as printed.  Raises UsageError for an unknown name."""
    if args.literal:
        return LITERAL
    try:
        return Printed() if args.printed is None else Printed.only(*(name.strip() for name in args.printed.split(",")))
    except ValueError as error:
        raise UsageError(f"--printed: {error}") from None


def _compared(literal: NDArray[np.bool_], corrected: NDArray[np.bool_]) -> int:
    """What the printed statements make of the hull; DIFFERS if it is another."""
    missing, more = int(np.count_nonzero(corrected & ~literal)), int(np.count_nonzero(literal & ~corrected))
    print(f"against the corrected algorithm: {counted(missing, 'voxel')} missing, {more} too many")
    return DIFFERS if missing or more else OK


def _lines(hull: OctreeHull, source: str, origin: Point, tables: bool, trace: bool) -> Iterator[str]:
    x, y, z = origin
    over = f"an octree of {counted(nodes(hull.solid), 'node')} over a cube of side {hull.side}"
    yield f"{source}: {counted(hull.solid_voxels, 'voxel')}, {over}"
    if tables:
        for name, heights in (("floor", hull.floor), ("ceiling", hull.ceiling)):
            yield from _table(name, {(i + x, j + y): value + z for (i, j), value in heights.items()})
        yield from _side("floor", hull.lower, hull.columns, origin, 1, trace)
        yield from _side("ceiling", hull.upper, hull.columns, origin, -1, trace)
    else:
        yield _brief("floor", hull.lower, hull.columns)
        yield _brief("ceiling", hull.upper, hull.columns)
    parts = hull.components
    what = "digital hull" if parts == 1 else f"digital points of the hull of {parts} 6-connected parts"
    yield f"{what}: {counted(hull.voxels, 'voxel')}, an octree of {counted(nodes(hull.hull), 'node')}"


def _brief(name: str, found: Envelope, columns: int) -> str:
    """An envelope in a line."""
    what = f"over one line, {len(found.chain)} vertices" if found.chain else counted(len(found.faces), "face")
    return f"{name}: {len(found.reduced)} of {columns} columns are in the reduced set; {what}"


def _table(name: str, heights: dict[Place, int]) -> Iterator[str]:
    """Heights over places, the greatest y first."""
    columns = range(min(x for x, _ in heights), max(x for x, _ in heights) + 1)
    rows = range(max(y for _, y in heights), min(y for _, y in heights) - 1, -1)
    width = max(len(str(number)) for number in (*heights.values(), *columns))
    edge = max(len(str(y)) for y in rows)
    yield f"{name}, x to the right, y up:"
    for y in rows:
        cells = (str(heights[x, y]) if (x, y) in heights else "." for x in columns)
        yield f"  {y:>{edge}} | " + " ".join(f"{cell:>{width}}" for cell in cells)
    yield f"  {'':>{edge}}   " + " ".join(f"{x:>{width}}" for x in columns)


def _side(name: str, found: Envelope, columns: int, origin: Point, sign: int, trace: bool) -> Iterator[str]:
    """The envelope of the floor (``sign`` 1) or of the ceiling, whose heights were negated (-1)."""

    def at(point: Point) -> Point:
        return point[0] + origin[0], point[1] + origin[1], sign * point[2] + origin[2]

    yield f"{name}: {len(found.reduced)} of {columns} columns are in the reduced set:"
    yield from _wrapped(_shown(at(point)) for point in found.reduced)
    if trace:
        for number, step in enumerate(found.steps, 1):
            yield from _trace(number, step, at, sign)
    if found.chain:
        yield f"{name}: over one line; vertices of its envelope:"
        yield from _wrapped(_shown(at(point)) for point in found.chain)
        return
    yield f"{name}: {counted(len(found.faces), 'face')}, outward normal and vertices:"
    for face in found.faces:
        # Turned over, the vertices of a ceiling's face run clockwise seen from outside.
        vertices = " ".join(_shown(at(vertex)) for vertex in face.vertices[::sign])
        yield f"  {_normal(face.normal, sign)}: {vertices}"


def _trace(number: int, step: Step, at: Callable[[Point], Point], sign: int) -> Iterator[str]:
    def edges(found: Iterable[Edge]) -> str:
        return " ".join(f"{_shown(at(p))}-{_shown(at(q))}" for p, q in found) or "none"

    yield f"  step {number}: edge {edges([step.edge])} of a face with normal {_normal(step.normal, sign)}"
    if step.face is None:
        yield f"    no point found, {step.visited} nodes visited"
    else:
        vertices = " ".join(_shown(at(vertex)) for vertex in step.face.vertices)
        yield f"    face {vertices}, {step.visited} nodes visited"
        yield f"    entered {edges(step.entered)}"
        yield f"    removed {edges(step.removed)}"
    yield f"    {step.marked} values entered, {step.waiting} edges waiting"


def _normal(normal: Point, sign: int) -> str:
    """A normal without common divisor, turned over for the ceiling."""
    a, b, c = (number // math.gcd(*normal) for number in normal)
    return _shown((a, b, sign * c))


def _shown(numbers: Iterable[int]) -> str:
    return "(" + ",".join(map(str, numbers)) + ")"


def _wrapped(words: Iterable[str], width: int = 118) -> Iterator[str]:
    """Words in lines of at most ``width`` characters after an indent of two."""
    line = ""
    for word in words:
        if line and len(line) + 1 + len(word) > width:
            yield "  " + line
            line = ""
        line = f"{line} {word}" if line else word
    if line:
        yield "  " + line
