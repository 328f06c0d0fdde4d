"""``hull1620 voxel-hull``: the hull of a voxel solid by Kovalevsky and Schulz, or the filled digital hull."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace

from emulator.files import check_writable, write_text
from modern.cli.shared.console import OK, UsageError, check_numbered, counted, say
from modern.cli.shared.measures import Row, centres_row, csv_text, filled_row, measure_lines, solid_row, table
from modern.cli.shared.volumes import (
    array_note,
    check_array,
    choice_of,
    coordinate_words,
    in_space,
    note_lines,
    printable,
    scan_of,
    spacing_words,
    volume_of,
)
from modern.digital.hull import digital_hull
from modern.digital.scans import label_boxes, label_volume
from modern.digital.solids import Volume
from modern.digital.volumes import write_array
from modern.digital.world import voxel_volume
from modern.formats import MESHES
from modern.formats.export import mesh_text
from modern.papers.kovalevsky_schulz import (
    CENTRES,
    SHUFFLED,
    VERTICES,
    CellList,
    Flat,
    Of,
    Surface,
    VoxelHull,
    voxel_hull,
)
from modern.papers.kovalevsky_schulz.tables import all_rows, cell_list_size, economical_size, triangulation_size


def main(args: argparse.Namespace) -> int:
    """Read the volume, find its hull, print what the paper prints, write the file."""
    _check_options(args)
    form = _form(args)
    check_writable(args.output, args.csv)
    if args.each_label:
        return _each_label(args, form)
    volume, said = volume_of(args)
    if args.fill:
        _fill(volume, said, args.output)
        return OK
    hull = _hull(volume, args)
    measures = hull.measures()
    if args.output is not None and form is not None:
        write_text(args.output, mesh_text(hull.mesh(args.straight), form))
    say([*said, printable(coordinate_words(volume.world, not args.centres))])
    print(f"{volume.source}: {counted(volume.count, 'voxel')}")
    for line in _count_lines(hull):
        print(line)
    for line in measure_lines(measures, volume.world.unit if volume.world else "", not args.centres):
        print(line)
    if args.cells and isinstance(hull.surface, Surface):
        for line in all_rows(hull.surface.straight if args.straight else hull.surface.faces):
            print(line)
    return OK


def _hull(volume: Volume, args: argparse.Namespace) -> VoxelHull:
    of: Of = CENTRES if args.centres else VERTICES
    return voxel_hull(volume, of, args.corners or 26, args.coplanar, args.order)


def _check_options(args: argparse.Namespace) -> None:
    """Refuse options that would do nothing.  Raises UsageError."""
    given = {
        "--vertices": args.vertices,
        "--corners": args.corners,
        "--coplanar": args.coplanar,
        "--order": args.order,
        "--cells": args.cells,
        "--straight": args.straight,
    }
    useless = [name for name, value in given.items() if value]
    if args.fill and useless:
        raise UsageError(f"--fill fills the hull of the voxels' centres; {useless[0]} is not for it")
    if args.each_label and args.cells:
        raise UsageError("--each-label prints a table of labels; --cells is of one hull")
    if args.each_label and args.threshold is not None:
        raise UsageError("--each-label takes whole values; --threshold is not for it")
    if args.csv is not None and not args.each_label:
        raise UsageError("--csv is the table of --each-label")


def _form(args: argparse.Namespace) -> str | None:
    """The format of the mesh to write, or None.  Raises UsageError."""
    if args.output is None:
        return None
    if args.each_label:
        check_numbered(args.output, "label", "label-%d.off")
    if args.fill:
        check_array(args.output)
        if args.each_label and not args.output.lower().endswith(".nrrd"):
            raise UsageError(f"{args.output}: each label's box is written, and its place is kept by .nrrd, not by .npy")
        return None
    form: str = args.output.rpartition(".")[2].lower()
    if form not in MESHES:
        raise UsageError(f"{args.output}: the name must end with one of {', '.join('.' + name for name in MESHES)}")
    return form


def _fill(volume: Volume, said: Iterable[str], output: str | None) -> None:
    hull = digital_hull(volume)
    if output is not None:
        write_array(output, hull.filled, volume)
    say(said)
    print(f"{volume.source}: {counted(volume.count, 'voxel')}")
    print(f"filled hull of the voxels' centres ({hull.kind}): {counted(hull.voxels, 'voxel')}")
    print(f"solidity {hull.solidity}, in voxels; convex deficiency: {counted(hull.deficiency, 'voxel')}")
    if output is not None:
        say(printable(note) for note in array_note(output, volume))


def _each_label(args: argparse.Namespace, form: str | None) -> int:
    """The table of labels, and a file for each where the output has a place for it: all, or none of them."""
    from emulator.progress import Progress  # its room is loaded for many labels only

    asked = choice_of(args).labels
    scan = scan_of(args)
    world = in_space(scan.world, args.space)
    boxes = label_boxes(scan, asked)
    check_writable(*(args.output % label for label in boxes if args.output is not None), args.csv)
    rows: list[Row] = []
    writers: list[Callable[[], None]] = []
    progress = Progress(len(boxes), what="labels")
    for label, box in boxes.items():
        volume = replace(label_volume(scan, label, box), world=world)
        name = args.output % label if args.output is not None else None
        if args.fill:
            filled = digital_hull(volume)
            rows.append(filled_row(label, filled, voxel_volume(world)))
            if name is not None:
                writers.append(lambda name=name, filled=filled: filled.save(name))  # type: ignore[misc]
        else:
            hull = _hull(volume, args)
            rows.append((centres_row if args.centres else solid_row)(label, hull.measures()))
            if name is not None and form is not None:
                text = mesh_text(hull.mesh(args.straight), form)
                writers.append(lambda name=name, text=text: write_text(name, text))  # type: ignore[misc]
        progress.add(1)
    progress.close()
    unit = "voxel" if world is None else world.unit
    for write in writers:
        write()
    if args.csv is not None:
        write_text(args.csv, csv_text(rows, unit))
    say(note_lines(scan.notes))
    say([printable(f"{scan.source}: {counted(len(boxes), 'label')}; {spacing_words(scan.world)}")])
    if not args.fill:
        say([printable(coordinate_words(world, not args.centres))])
    for line in table(rows, unit):
        print(line)
    return OK


def _count_lines(hull: VoxelHull) -> Iterator[str]:
    """The counts of section 2 and the sizes of section 4."""
    what = "voxels" if hull.of == CENTRES else "voxel vertices"
    counts = ", ".join(f"{count} by {tested} neighbours" for tested, count in hull.corners.items())
    yield f"local corners of the {what}: {counts}"
    surface = hull.surface
    if isinstance(surface, Flat):
        vertices = f" of {len(surface.vertices)} vertices" if surface.dimension == 2 else ""
        yield f"flat: the hull is a {surface.kind}{vertices} and has no cell list"
        return
    faces, straight, saved = surface.faces, surface.straight, ""
    if surface.triangulation is None:
        yield f"hull of {len(hull.inserted)} local corners: {_cells(faces)}"
    else:
        triangles, shuffled = len(surface.triangulation.faces), ", shuffled" if hull.order == SHUFFLED else ""
        yield f"inserted: {len(hull.inserted)} local corners{shuffled}; {triangles} triangles"
        yield f"merged: {_cells(faces)}"
        saved = f"{triangulation_size(triangles)} for the triangles by (5), "
    if len(straight.vertices) < len(faces.vertices):
        yield f"with edges in one line merged too: {_cells(straight)}"
    by_formula, counted_so = cell_list_size(len(faces.vertices), len(faces.faces)), economical_size(faces)
    yield f"integers to save: {saved}{by_formula} for the cell list by (6), {counted_so} counted"


def _cells(cells: CellList) -> str:
    return f"{len(cells.faces)} faces, {len(cells.vertices)} vertices, {len(cells.edges)} edges"
