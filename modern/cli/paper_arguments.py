"""Arguments of the commands for the later papers."""

from __future__ import annotations

import argparse

from modern.cli.parsing import Commands, command


def paper_commands(commands: Commands) -> None:
    """Add the papers' commands."""
    _appel_will(commands)
    _hidden_line(commands)
    _voxel_hull(commands)
    _octree_hull(commands)


def _appel_will(commands: Commands) -> None:
    parser = command(
        commands,
        "appel-will",
        "the hull of a polyhedron from its convex edges, by Appel & Will",
        "modern.cli.appel_will",
    )
    parser.add_argument("points", metavar="FILE", help="an OFF file (points and surfaces), a data deck or CSV")
    parser.add_argument("--literal", action="store_true", help="star polygon test and loops by the paper's letter")
    parser.add_argument(
        "--star",
        choices=("printed", "mended"),
        help="the star polygon test (default: mended; with --literal: printed)",
    )
    parser.add_argument(
        "--inside-corners",
        metavar="RULE",
        choices=("any", "two", "concave"),
        help="delete points on inside corners first: any (right if no point is on more than three planes), "
        "two or concave (right always)",
    )
    parser.add_argument("--trace", action="store_true", help="the use of every edge after each loop")
    parser.add_argument("-o", "--output", metavar="FILE.off", help="write the hull as an OFF file too")


def _hidden_line(commands: Commands) -> None:
    parser = command(
        commands,
        "hidden-line",
        "convex polyhedra without their hidden lines, by Nakamae & Nishita",
        "modern.cli.hidden_line",
    )
    parser.add_argument(
        "scene",
        metavar="SCENE",
        help="a scene file .toml, a convex polyhedron .off, points to take the hull of, or cuboids, columns, house",
    )
    parser.add_argument(
        "-o", "--output", metavar="FILE", help="SVG, or HPGL with a name ending .hpgl or .plt (default: SVG to '-')"
    )
    parser.add_argument("--eye", metavar="X,Y,Z", help="the direction to the eye; write --eye=-1,2,3 before a minus")
    parser.add_argument("--perspective", action="store_true", help="--eye is the observation point itself")
    parser.add_argument("--towards", metavar="X,Y,Z", help="in perspective: the point looked at (default: the middle)")
    parser.add_argument("--hidden", action="store_true", help="draw hidden lines too, dashed")
    parser.add_argument("--tables", action="store_true", help="print contours, PL and LP tables with d, and indices")
    parser.add_argument(
        "--without",
        metavar="MEND,...",
        default="",
        help="leave out mends of the paper's gaps: enclosed, touching, ends; or its own ghosts",
    )
    parser.add_argument("--title", metavar="TEXT", help="the line below the picture (default: the scene's)")
    parser.add_argument("--width", metavar="PIXELS", type=int, default=640, help="of the SVG (default: 640)")


def _voxel_hull(commands: Commands) -> None:
    parser = command(
        commands,
        "voxel-hull",
        "the hull of a voxel solid by Kovalevsky and Schulz, or its filled digital hull",
        "modern.cli.voxel_hull",
    )
    _volume(parser)
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--centres", action="store_true", help="the hull of the voxels' centres")
    which.add_argument(
        "--vertices",
        action="store_true",
        help="of the voxels' corners (default): from (x, y, z) to (x+1, y+1, z+1) for voxel (x, y, z)",
    )
    parser.add_argument(
        "--corners", type=int, choices=(6, 26), help="neighbours tested for local corners (default: 26)"
    )
    parser.add_argument(
        "--coplanar", choices=("visible", "invisible"), help="faces in a plane with a new point (default: visible)"
    )
    parser.add_argument("--straight", action="store_true", help="merge edges in one line too, for --cells and -o")
    parser.add_argument("--cells", action="store_true", help="print the cell list: vertices, edges and faces")
    parser.add_argument("--fill", action="store_true", help="fill the hull of the centres; -o FILE.npy writes it")
    parser.add_argument("-o", "--output", metavar="FILE", help="a mesh (.off, .obj, .ply, .stl); with --fill an array")


def _octree_hull(commands: Commands) -> None:
    parser = command(
        commands,
        "octree-hull",
        "the digital hull of a voxel solid from its octree, by Yau and Srihari",
        "modern.cli.octree_hull",
    )
    _volume(parser)
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--literal", action="store_true", help="every statement of the paper as printed")
    which.add_argument(
        "--printed",
        metavar="NAME,...",
        help="only these as printed: angle, start, triangles, truncation, bound, corners, marks",
    )
    parser.add_argument("--trace", action="store_true", help="every edge taken from the queue, and what became of it")
    parser.add_argument("-o", "--output", metavar="FILE.npy", help="write the filled hull as an array")


def _volume(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "volume",
        metavar="VOLUME",
        help="an NPY, NRRD or raw array, CSV voxels x,y,z, or ball:32, ball:32:vertex, half-ball:18",
    )
    parser.add_argument("--shape", metavar="NX,NY,NZ", help="of a raw array, x fastest")
    parser.add_argument("--dtype", metavar="TYPE", help="of a raw array's numbers (default: uint8)")
