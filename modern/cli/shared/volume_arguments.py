"""Define the arguments of the commands that read a volume of voxels.

Like ``modern/cli/arguments.py``, this module imports nothing that is needed only to run a command.
"""

from argparse import ArgumentParser

from modern.cli.shared.arguments import add, printed_arguments, result_file_argument
from modern.cli.shared.console import InputFile, OutputFile
from modern.formats import MESHES


def voxel_hull(parser: ArgumentParser) -> None:
    _volume_arguments(parser)
    space = (
        "give coordinates as in the file, turned to LPS or RAS, or as voxel indices (default: file; indices if "
        "the file states no spacing). A position is that of a voxel's centre; its corners lie half a voxel from it. "
        "With indices, voxel (x, y, z) has the corners (x, y, z) to (x+1, y+1, z+1), as in the paper"
    )
    add(parser, {"--space": space}, choices=("file", "lps", "ras", "index"), default="file")
    which = {
        "--centres": "find the hull of the centres of the voxels",
        "--vertices": "find the hull of the corners of the voxels (default)",
    }
    add(parser.add_mutually_exclusive_group(), which)
    corners = "find the local corners, the possible vertices of the hull, by testing this many neighbours (default: 26)"
    add(parser, {"--corners": corners}, type=int, choices=(6, 26))
    order = (
        "insert the local corners one by one, in the paper's order (raster) or in a random one, which is faster "
        "(shuffled), and count triangles (default: build only the cell list of the final hull; with --coplanar: raster)"
    )
    add(parser, {"--order": order}, choices=("raster", "shuffled"))
    coplanar = "treat a face coplanar with the inserted point as visible or invisible (default: visible)"
    add(parser, {"--coplanar": coplanar}, choices=("visible", "invisible"))
    results = {
        "--straight": "for --cells and -o: also merge edges that lie on one line",
        "--cells": "print the cell list: vertices, edges and faces",
        "--fill": "find all voxels whose centres lie in the hull of the solid's voxel centres; -o writes them",
        "--each-label": "print a table with the volume, hull, area, solidity and convex deficiency of each label, or "
        "of the labels given by --label; with --fill, count voxels",
    }
    add(parser, results)
    csv = (
        "with --each-label: write the table with all digits and exact fractions to FILE ('-': standard output; the "
        "report then goes to standard error)"
    )
    add(parser, {"--csv FILE": csv}, type=OutputFile)
    result_file_argument(
        parser,
        f"a mesh ({', '.join(_MESH_ENDINGS)}); with --fill, an array: .nrrd, which keeps spacing and origin, or .npy; "
        "with --each-label, the name needs a place for the label: 'label-%%d.off'",
    )


def octree_hull(parser: ArgumentParser) -> None:
    _volume_arguments(parser)
    printed_arguments(parser, "statement", "angle, start, triangles, truncation, bound, corners, marks")
    tables = {
        "--tables": "print the floor and the ceiling (the lowest and the highest voxel of each column), their reduced "
        "sets (the voxels that can be vertices), and every face (default: a summary)",
        "--trace": "print the tables of --tables, and for each edge taken from the queue the face found at it, if any",
    }
    add(parser, tables)
    result_file_argument(
        parser,
        "the filled hull as an array, .nrrd, which keeps spacing and origin, or .npy, or as a mesh over the centres of "
        f"the voxels ({', '.join(_MESH_ENDINGS)})",
    )
    parser.set_defaults(endings=(".nrrd", ".npy", *_MESH_ENDINGS))


_MESH_ENDINGS = tuple(f".{name}" for name in MESHES)


def _volume_arguments(parser: ArgumentParser) -> None:
    """Add the volume, the options for properties that its file does not state, and the options that select voxels."""
    volume = (
        "NRRD, NPY, NPZ or a raw array; NIfTI (.nii, .nii.gz), MetaImage (.mha, .mhd), TIFF, DICOM (.dcm, or a "
        "folder with a series), if hull1620[volumes] is installed; CSV with a voxel x,y,z on each line; or a ball by "
        "name: ball:32 has the diameter 32 and its centre in a voxel, ball:32:vertex at a corner; half-ball:18 "
        "is half a ball"
    )
    add(parser, {"volume VOLUME": volume}, type=InputFile)
    label = "select the voxels with the value N; may be repeated (default: all values except 0)"
    add(parser, {"--label N": label}, type=int, action="append", default=[])
    values = {
        "--threshold T": "select the voxels whose value is at least T (>=)",
        "--spacing DX,DY,DZ": "use these distances between voxel centres if the file states none",
        "--origin X,Y,Z": "with --spacing: put the centre of voxel (0, 0, 0) at this point (default: 0,0,0)",
        "--shape NX,NY,NZ": "read a raw array of this shape, x fastest; required for a raw array",
        "--dtype TYPE": "read numbers of this type from a raw array (default: uint8)",
        "--array NAME": "choose an array of an NPZ file with several arrays",
        "--series UID": "choose a series of a folder with several DICOM series",
    }
    add(parser, values)
