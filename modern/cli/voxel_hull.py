"""``hull1620 voxel-hull``: find the hull of a voxel solid, by Kovalevsky & Schulz, or its filled digital hull."""

import argparse
from collections.abc import Callable, Iterator
from dataclasses import replace

from emulator.files import check_writable, write_text
from modern.cli.shared import volumes
from modern.cli.shared.console import OK, UsageError, check_numbered, counted, print_notes, print_report
from modern.cli.shared.measure_tables import Row, centres_row, csv_text, filled_row, measure_lines, solid_row, table
from modern.cli.shared.volumes import printable, volume_of
from modern.digital.hull import digital_hull
from modern.digital.scans import label_boxes, label_notes, label_volume
from modern.digital.solids import Volume
from modern.digital.volumes import ARRAYS, write_array
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
from modern.papers.kovalevsky_schulz.cells import all_rows, cell_list_size, economical_size, triangulation_size


def main(args: argparse.Namespace) -> int:
    _check_options(args)
    _check_output(args)
    if args.each_label:
        _tabulate_labels(args)
    elif args.fill:
        _fill(args)
    else:
        _report_hull(args)
    return OK


def _report_hull(args: argparse.Namespace) -> None:
    """Find the hull of one volume, write the hull as a mesh, and print its counts, measures and cells."""
    volume, notes = volume_of(args)
    hull = _hull(volume, args)
    measures = hull.measures()
    if args.output is not None:
        write_text(args.output, _mesh(hull, args))
    print_notes([*notes, printable(volumes.coordinate_words(volume.world, not args.centres))])
    print_report(args, [f"{volume.source}: {counted(volume.count, 'voxel')}"])
    print_report(args, _count_lines(hull))
    print_report(args, measure_lines(measures, volume.world.unit if volume.world else "", not args.centres))
    if args.cells and isinstance(hull.surface, Surface):
        print_report(args, all_rows(hull.surface.straight if args.straight else hull.surface.faces))


def _fill(args: argparse.Namespace) -> None:
    """Fill the hull of one volume with voxels, write the voxels as an array, and print their counts."""
    volume, notes = volume_of(args)
    hull = digital_hull(volume)
    if args.output is not None:
        write_array(args.output, hull.filled, volume)
    print_notes(notes)
    print(f"{volume.source}: {counted(volume.count, 'voxel')}")
    print(f"filled hull of the voxels' centres ({hull.kind}): {counted(hull.voxels, 'voxel')}")
    print(f"solidity, counted in voxels: {hull.solidity}; convex deficiency: {counted(hull.deficiency, 'voxel')}")
    if args.output is not None:
        print_notes(printable(note) for note in volumes.array_note(args.output, volume))


# A function that writes the hull of one label to the file of the given name.
Write = Callable[[str], None]


def _tabulate_labels(args: argparse.Namespace) -> None:
    """Print a table of labels, and write a file for each label. If the hull of a label fails, write no file at all."""
    from emulator.progress import Progress  # imported here because only --each-label needs it

    labels = volumes.choice_of(args).labels
    scan = volumes.scan_of(args)
    world = volumes.in_space(scan.world, args.space)
    boxes = label_boxes(scan, labels)
    check_writable(*(args.output % label for label in boxes if args.output is not None), args.csv)
    hull_of_label = _filled_label if args.fill else _label
    progress = Progress(len(boxes), what="labels")
    hulls: dict[int, tuple[Row, Write]] = {}
    for label, box in boxes.items():
        hulls[label] = hull_of_label(label, replace(label_volume(scan, label, box), world=world), args)
        progress.add(1)
    progress.close()
    rows = [row for row, _ in hulls.values()]
    unit = "voxel" if world is None else world.unit
    for label, (_, write) in hulls.items():
        if args.output is not None:
            write(args.output % label)
    if args.csv is not None:
        write_text(args.csv, csv_text(rows, unit))
    print_notes(volumes.note_lines((*scan.notes, *label_notes(scan))))
    print_notes([printable(f"{scan.source}: {counted(len(boxes), 'label')}; {volumes.spacing_words(scan.world)}")])
    if not args.fill:
        print_notes([printable(volumes.coordinate_words(world, not args.centres))])
    print_report(args, table(rows, unit))


def _label(label: int, volume: Volume, args: argparse.Namespace) -> tuple[Row, Write]:
    """Return the row of a label in the table of measures, and a function that writes its hull as a mesh."""
    hull = _hull(volume, args)
    row = (centres_row if args.centres else solid_row)(label, hull.measures())
    # The text, not the hull, is kept until all labels are done, because it needs less memory.
    mesh = _mesh(hull, args) if args.output is not None else ""
    return row, lambda path: write_text(path, mesh)


def _filled_label(label: int, volume: Volume, args: argparse.Namespace) -> tuple[Row, Write]:
    """Return the row of a label whose hull is filled, and a function that writes the filled hull as an array."""
    hull = digital_hull(volume)
    return filled_row(label, hull, voxel_volume(volume.world)), hull.save


def _hull(volume: Volume, args: argparse.Namespace) -> VoxelHull:
    of: Of = CENTRES if args.centres else VERTICES
    return voxel_hull(volume, of, args.corners or 26, args.coplanar, args.order)


def _mesh(hull: VoxelHull, args: argparse.Namespace) -> str:
    return mesh_text(hull.mesh(args.straight), _ending(args.output))


def _check_options(args: argparse.Namespace) -> None:
    options = ("vertices", "corners", "coplanar", "order", "cells", "straight")
    unused = [name for name in options if getattr(args, name)]
    if args.fill and unused:
        raise UsageError(f"--{unused[0]} has no effect with --fill, which fills the hull of the voxels' centres")
    if args.each_label and args.cells:
        raise UsageError("--cells prints one hull and cannot be combined with --each-label")
    if args.each_label and args.threshold is not None:
        raise UsageError("--threshold cannot be combined with --each-label, which needs integer values")
    if args.csv is not None and not args.each_label:
        raise UsageError("--csv needs --each-label, whose table it writes")


def _check_output(args: argparse.Namespace) -> None:
    """Raise UsageError if the output's name lacks a place for the label, or has the ending of an unsupported format."""
    if args.output is None:
        return
    if args.each_label:
        check_numbered(args.output, "label", "label-%d.off")
    if args.fill:
        if not args.output.lower().endswith(ARRAYS):
            raise UsageError(
                f"{args.output}: a filled hull is written as an array; "
                f"expected a name that ends with {' or '.join(ARRAYS)}"
            )
        if args.each_label and _ending(args.output) != "nrrd":
            raise UsageError(f"{args.output}: only a .nrrd file can hold the position of a label; use label-%d.nrrd")
    elif _ending(args.output) not in MESHES:
        endings = ", ".join(f".{name}" for name in MESHES)
        raise UsageError(f"{args.output}: expected a name that ends with one of {endings}")


def _ending(path: str) -> str:
    return path.rpartition(".")[2].lower()


def _count_lines(hull: VoxelHull) -> Iterator[str]:
    """Yield the counts of local corners (section 2 of the paper) and the sizes of the cell lists (section 4)."""
    noun = "voxels" if hull.of == CENTRES else "voxel vertices"
    counts = ", ".join(f"{count} when testing {tested} neighbours" for tested, count in hull.corners.items())
    yield f"local corners of the {noun}: {counts}"
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
        saved = f"{triangulation_size(triangles)} for the triangles by the paper's formula (5), "
    if len(straight.vertices) < len(faces.vertices):
        yield f"with collinear edges merged: {_cells(straight)}"
    by_formula, by_count = cell_list_size(len(faces.vertices), len(faces.faces)), economical_size(faces)
    yield (
        f"integers to save: {saved}{by_formula} for the cell list by the paper's formula (6), or {by_count} by counting"
    )


def _cells(cells: CellList) -> str:
    return f"{len(cells.faces)} faces, {len(cells.vertices)} vertices, {len(cells.edges)} edges"
