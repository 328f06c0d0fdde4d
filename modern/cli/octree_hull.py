"""``hull1620 octree-hull``: find the digital hull of a solid from its octree, by the algorithm of Yau & Srihari."""

import argparse
import math
import textwrap
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from emulator.files import write_text
from modern.cli.shared.console import DIFFERS, OK, UsageError, counted, print_notes, print_report
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
    printed = _printed(args)
    volume, notes = volume_of(args)
    hull = octree_hull(volume, printed)
    writes_array = args.output is not None and args.output.lower().endswith(ARRAYS)
    if writes_array:
        write_array(args.output, hull.filled, volume)
    elif args.output is not None:
        centres = voxel_hull(_in_space(replace(volume, array=hull.filled)), CENTRES)
        write_text(args.output, mesh_text(centres.mesh(straight=True), args.output.rpartition(".")[2].lower()))
        notes = (*notes, printable(coordinate_words(volume.world, corners=False)))
    elif volume.world is not None and (args.tables or args.trace):
        notes = (*notes, coordinate_words(None, corners=False))
    print_notes(notes)
    x, y, z = (*volume.origin, 0)[:3]
    print_report(args, _lines(hull, volume.source, (x, y, z), args.tables or args.trace, args.trace))
    if printed.names():
        print_notes([f"note: these statements are applied as the paper prints them: {', '.join(printed.names())}"])
    print_notes(f"note: {fault}" for fault in hull.faults)
    if writes_array:
        print_notes(array_note(args.output, volume))
    return _compared(hull.filled, octree_hull(volume).filled) if printed.names() else OK


def _in_space(volume: Volume) -> Volume:
    """Return the volume; a picture without physical coordinates becomes a volume of one layer."""
    if volume.dimension == 3 or volume.world is not None:
        return volume
    return replace(volume, array=volume.array[..., None], origin=(*volume.origin, 0))


def _printed(args: argparse.Namespace) -> Printed:
    """Return the rules that the options apply as the paper prints them. Raise UsageError for an unknown rule."""
    if args.literal:
        return LITERAL
    try:
        return Printed() if args.printed is None else Printed.only(*(name.strip() for name in args.printed.split(",")))
    except ValueError as error:
        raise UsageError(f"--printed: {error}") from None


def _compared(literal: NDArray[np.bool_], corrected: NDArray[np.bool_]) -> int:
    """Print the differences between the hulls by the printed and by the corrected rules. Return the exit code."""
    missing, extra = int(np.count_nonzero(corrected & ~literal)), int(np.count_nonzero(literal & ~corrected))
    print(f"compared with the corrected algorithm: {counted(missing, 'voxel')} missing, {extra} extra")
    return DIFFERS if missing or extra else OK


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
        yield _summary("floor", hull.lower, hull.columns)
        yield _summary("ceiling", hull.upper, hull.columns)
    parts = hull.components
    name = "digital hull" if parts == 1 else f"digital points of the hull of {parts} parts that no voxel faces connect"
    yield f"{name}: {counted(hull.voxels, 'voxel')}, an octree of {counted(nodes(hull.hull), 'node')}"


def _summary(name: str, envelope: Envelope, columns: int) -> str:
    chain, faces = envelope.chain, envelope.faces
    shape = f"they lie on one line, with {len(chain)} vertices" if chain else counted(len(faces), "face")
    return f"{name}: {len(envelope.reduced)} of {columns} columns are in the reduced set (possible vertices); {shape}"


def _table(name: str, heights: dict[Place, int]) -> Iterator[str]:
    """Yield the lines of a table of heights by x and y, with the greatest y in the first row."""
    columns = range(min(x for x, _ in heights), max(x for x, _ in heights) + 1)
    rows = range(max(y for _, y in heights), min(y for _, y in heights) - 1, -1)
    width = max(len(str(number)) for number in (*heights.values(), *columns))
    edge = max(len(str(y)) for y in rows)
    yield f"{name}, x to the right, y up:"
    for y in rows:
        cells = (str(heights[x, y]) if (x, y) in heights else "." for x in columns)
        yield f"  {y:>{edge}} | " + " ".join(f"{cell:>{width}}" for cell in cells)
    yield f"  {'':>{edge}}   " + " ".join(f"{x:>{width}}" for x in columns)


def _side(name: str, envelope: Envelope, columns: int, origin: Point, sign: int, trace: bool) -> Iterator[str]:
    """Yield the report on the lower envelope (``sign`` 1) or on the upper one (-1), which has negated heights."""

    def at(point: Point) -> Point:
        return point[0] + origin[0], point[1] + origin[1], sign * point[2] + origin[2]

    yield f"{name}: {len(envelope.reduced)} of {columns} columns are in the reduced set (possible vertices):"
    yield from _wrapped(_tuple(at(point)) for point in envelope.reduced)
    if trace:
        for number, step in enumerate(envelope.steps, 1):
            yield from _trace(number, step, at, sign)
    if envelope.chain:
        yield f"{name}: its columns lie on one line; vertices of its envelope:"
        yield from _wrapped(_tuple(at(point)) for point in envelope.chain)
        return
    yield f"{name}: {counted(len(envelope.faces), 'face')}, outward normal and vertices:"
    for face in envelope.faces:
        # Negating the heights of the ceiling reverses the orientation of its faces, so their vertices are reversed too.
        vertices = " ".join(_tuple(at(vertex)) for vertex in face.vertices[::sign])
        yield f"  {_normal(face.normal, sign)}: {vertices}"


def _trace(number: int, step: Step, at: Callable[[Point], Point], sign: int) -> Iterator[str]:
    def edge_list(edges: Iterable[Edge]) -> str:
        return " ".join(f"{_tuple(at(p))}-{_tuple(at(q))}" for p, q in edges) or "none"

    yield f"  step {number}: edge {edge_list([step.edge])} of a face with normal {_normal(step.normal, sign)}"
    if step.face is None:
        yield f"    no point found, {step.visited} nodes visited"
    else:
        vertices = " ".join(_tuple(at(vertex)) for vertex in step.face.vertices)
        yield f"    face {vertices}, {step.visited} nodes visited"
        yield f"    pushed {edge_list(step.entered)}"
        yield f"    removed {edge_list(step.removed)}"
    yield f"    {step.marked} values recorded, {step.waiting} edges in the queue"


def _normal(normal: Point, sign: int) -> str:
    """Return a normal divided by the greatest common divisor of its components, with z multiplied by ``sign``."""
    a, b, c = (number // math.gcd(*normal) for number in normal)
    return _tuple((a, b, sign * c))


def _tuple(numbers: Iterable[int]) -> str:
    return "(" + ",".join(map(str, numbers)) + ")"


def _wrapped(points: Iterable[str]) -> list[str]:
    text = " ".join(points)
    return textwrap.wrap(text, 120, initial_indent="  ", subsequent_indent="  ", break_on_hyphens=False)
