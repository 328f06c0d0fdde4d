"""``hull1620 voxel-hull``: the hull of a voxel solid by Kovalevsky and Schulz, or the filled digital hull."""

from __future__ import annotations

import argparse
from collections.abc import Iterator

from emulator.files import check_writable, write_text
from modern.cli.shared.console import OK, UsageError, counted
from modern.cli.shared.volumes import volume_of
from modern.digital.volumes import Volume, write_npy
from modern.formats import MESHES
from modern.formats.hulls import mesh_text
from modern.geometry.mesh import Mesh
from modern.papers.kovalevsky_schulz import (
    CENTRES,
    VERTICES,
    VISIBLE,
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
    check_writable(args.output)
    volume = volume_of(args)
    print(f"{volume.source}: {counted(volume.count, 'voxel')}")
    if args.fill:
        _fill(volume, args.output)
        return OK
    of: Of = CENTRES if args.centres else VERTICES
    hull = voxel_hull(volume, of, args.corners or 26, args.coplanar or VISIBLE)
    if args.output is not None and form is not None:
        write_text(args.output, mesh_text(_mesh(hull.surface, args.straight), form))
    for line in _count_lines(hull, of):
        print(line)
    if args.cells and isinstance(hull.surface, Surface):
        for line in all_rows(hull.surface.straight if args.straight else hull.surface.faces):
            print(line)
    return OK


def _check_options(args: argparse.Namespace) -> None:
    """Refuse options that would do nothing.  Raises UsageError."""
    if not args.fill:
        return
    given = {
        "--vertices": args.vertices,
        "--corners": args.corners,
        "--coplanar": args.coplanar,
        "--cells": args.cells,
        "--straight": args.straight,
    }
    useless = [name for name, value in given.items() if value]
    if useless:
        raise UsageError(f"--fill fills the hull of the voxels' centres; {useless[0]} is not for it")


def _form(args: argparse.Namespace) -> str | None:
    """The format of the mesh to write, or None.  Raises UsageError."""
    if args.output is None:
        return None
    if args.fill:
        if not args.output.lower().endswith(".npy"):
            raise UsageError(f"{args.output}: a filled hull is written as an array; the name must end with .npy")
        return None
    form: str = args.output.rpartition(".")[2].lower()
    if form not in MESHES:
        raise UsageError(f"{args.output}: the name must end with one of {', '.join('.' + name for name in MESHES)}")
    return form


def _fill(volume: Volume, output: str | None) -> None:
    # Imported here: only this option needs it.
    from modern.digital.hull import digital_hull

    hull = digital_hull(volume)
    if output is not None:
        write_npy(output, hull.filled)
    print(f"filled hull of the voxels' centres ({hull.kind}): {counted(hull.voxels, 'voxel')}")
    if any(volume.origin):
        print(f"the array's first voxel is {volume.origin}")


def _count_lines(hull: VoxelHull, of: str) -> Iterator[str]:
    """The counts of section 2 and the sizes of section 4."""
    what = "voxels" if of == CENTRES else "voxel vertices"
    counts = ", ".join(f"{count} by {tested} neighbours" for tested, count in hull.corners.items())
    yield f"local corners of the {what}: {counts}"
    surface = hull.surface
    if isinstance(surface, Flat):
        vertices = f" of {len(surface.vertices)} vertices" if surface.dimension == 2 else ""
        yield f"flat: the hull is a {surface.kind}{vertices} and has no cell list"
        return
    triangles, faces, straight = len(surface.triangles.faces), surface.faces, surface.straight
    yield f"inserted: {len(hull.inserted)} local corners; {triangles} triangles"
    yield f"merged: {_cells(faces)}"
    if len(straight.vertices) < len(faces.vertices):
        yield f"with edges in one line merged too: {_cells(straight)}"
    yield (
        f"integers to save: {triangulation_size(triangles)} for the triangles by (5), "
        f"{cell_list_size(len(faces.vertices), len(faces.faces))} for the cell list by (6), "
        f"{economical_size(faces)} counted"
    )


def _cells(cells: CellList) -> str:
    return f"{len(cells.faces)} faces, {len(cells.vertices)} vertices, {len(cells.edges)} edges"


def _mesh(surface: Surface | Flat, straight: bool) -> Mesh:
    """The hull for the writers of mesh files."""
    if isinstance(surface, Flat):
        cycle = tuple(range(len(surface.vertices)))
        return Mesh(surface.dimension, _texts(surface.vertices), (cycle,) if surface.dimension == 2 else ())
    cells = surface.straight if straight else surface.faces
    return Mesh(3, _texts(cells.points), tuple(tuple(v - 1 for v in face.vertices) for face in cells.faces))


def _texts(points: tuple[tuple[int, int, int], ...]) -> tuple[tuple[str, str, str], ...]:
    return tuple((str(x), str(y), str(z)) for x, y, z in points)
