"""Arguments of the commands that draw hulls or write them, from points, faces and voxels.

As in ``modern/cli/arguments.py`` nothing is imported that only a run needs.
"""

from __future__ import annotations

from argparse import ArgumentParser

from modern.cli.shared.arguments import (
    coplanar_argument,
    eye_argument,
    listed,
    output_argument,
    points_argument,
    volume_arguments,
)
from modern.formats import HULLS, MESHES


def export(parser: ArgumentParser) -> None:
    """``export``."""
    points_argument(parser)
    endings = listed(f".{name}" for name in HULLS)
    parser.add_argument(
        "-o", "--output", metavar="FILE", default="-", help=f"a name ending {endings} (default: '-', with --format)"
    )
    parser.add_argument("--format", choices=tuple(HULLS), help="the format, where the name does not say it")
    coplanar_argument(parser)


def draw(parser: ArgumentParser) -> None:
    """``draw``."""
    points_argument(parser)
    output_argument(parser, "FILE.svg")
    parser.set_defaults(endings=(".svg",))
    eye_argument(parser)
    parser.add_argument("--title", metavar="TEXT", help="the line below the picture (default: the name of the file)")
    parser.add_argument("--width", metavar="PIXELS", type=int, help="320 to 4000 (default: 640, for many points 1000)")
    parser.add_argument(
        "--labels",
        choices=("programs", "input", "none"),
        default="programs",
        help="number the vertices as the programs do, by their places in the input, or not (default: programs)",
    )
    parser.add_argument("--no-hidden", action="store_true", help="leave out what is behind the faces seen")
    parser.add_argument("--no-points", action="store_true", help="leave out points that are no vertices")
    coplanar_argument(parser)
    which = parser.add_mutually_exclusive_group()
    which.add_argument(
        "--against", metavar="CARDS", help="show in colour what the cards that hull punched say differently"
    )
    which.add_argument("--stages", action="store_true", help="the construction H1 to Hf, picture by picture")
    which.add_argument("--animate", action="store_true", help="the construction H1 to Hf, played in one picture")


def appel_will(parser: ArgumentParser) -> None:
    """``appel-will``."""
    points_argument(parser, "FILE", " (points and surfaces)")
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--literal", action="store_true", help="every rule of the paper as printed")
    which.add_argument(
        "--printed", metavar="NAME,...", help="only these as printed: star, step3, step5, step7, step9, step10"
    )
    parser.add_argument(
        "--star",
        choices=("printed", "corrected"),
        help="the star polygon test, whatever the other rules (default: corrected; with --literal: printed)",
    )
    parser.add_argument(
        "--inside-corners",
        metavar="RULE",
        choices=("any", "two", "concave"),
        help="delete points on inside corners first: any (right if no point is on more than three planes), "
        "two or concave (right always)",
    )
    parser.add_argument("--trace", action="store_true", help="the use of every edge after each loop")
    words = "list everything (default: the tables of up to 50 points, of more a summary)"
    parser.add_argument("--all", action="store_true", help=words)
    words = "write the hull (.off), or draw it with its convex edges (.svg)"
    parser.add_argument("-o", "--output", metavar="FILE", help=words)
    parser.set_defaults(endings=(".off", ".svg"))
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--map", action="store_true", help="with -o FILE.svg: the topological map instead, in the plane")
    words = "with -o FILE.svg: instead the star polygon of the line of two points"
    which.add_argument("--star-of", metavar="I-J", help=words)
    eye_argument(parser)
    words = "of the picture, 320 to 4000 (default: 640, for many points 1000)"
    parser.add_argument("--width", metavar="PIXELS", type=int, help=words)
    coplanar_argument(parser)


def hidden_line(parser: ArgumentParser) -> None:
    """``hidden-line``."""
    parser.add_argument(
        "scene",
        metavar="SCENE",
        help="a scene file .toml, faces (OFF, OBJ, STL), points to take the hull of, or cuboids, columns, house",
    )
    parser.add_argument(
        "-o", "--output", metavar="FILE", help="SVG (.svg), or HPGL (.hpgl or .plt) (default: SVG to '-')"
    )
    parser.set_defaults(endings=(".svg", ".hpgl", ".plt"))
    eye_argument(parser)
    parser.add_argument("--perspective", action="store_true", help="--eye is the observation point itself")
    parser.add_argument("--towards", metavar="X,Y,Z", help="in perspective: the point looked at (default: the middle)")
    words = "in perspective: cut off what is nearer than this (default: nothing; what is not before the eye is refused)"
    parser.add_argument("--near", metavar="DISTANCE", help=words)
    words = "of a file of faces: the hull of each connected component (default: each has to be convex)"
    parser.add_argument("--hull", action="store_true", help=words)
    coplanar_argument(parser)
    parser.add_argument("--hidden", action="store_true", help="draw hidden lines too, dashed")
    parser.add_argument("--tables", action="store_true", help="print contours, PL and LP tables with d, and indices")
    parser.add_argument(
        "--without",
        metavar="CORRECTION,...",
        default="",
        help="leave out corrections of the paper's gaps: enclosed, touching, ends; or its own ghosts (default: none)",
    )
    parser.add_argument("--title", metavar="TEXT", help="the line below the picture (default: the scene's)")
    parser.add_argument("--width", metavar="PIXELS", type=int, default=640, help="of the SVG (default: 640)")


def voxel_hull(parser: ArgumentParser) -> None:
    """``voxel-hull``."""
    volume_arguments(parser)
    parser.add_argument(
        "--space",
        choices=("file", "lps", "ras", "index"),
        default="file",
        help="coordinates: as the file's, turned to LPS or RAS, or indices, as of files that state no place (default: "
        "file). A position is that of a voxel's centre, and corners lie half a voxel from it; in indices voxel "
        "(x, y, z) has the corners (x, y, z) to (x+1, y+1, z+1), as in the paper",
    )
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--centres", action="store_true", help="the hull of the voxels' centres")
    which.add_argument("--vertices", action="store_true", help="of the voxels' corners (default)")
    parser.add_argument(
        "--corners", type=int, choices=(6, 26), help="neighbours tested for local corners (default: 26)"
    )
    parser.add_argument(
        "--order",
        choices=("raster", "shuffled"),
        help="insert the local corners one by one and count triangles: in the paper's order, or in a quicker one "
        "(default: none is inserted, the cell list is of the hull alone; with --coplanar raster)",
    )
    parser.add_argument(
        "--coplanar",
        choices=("visible", "invisible"),
        help="faces in a plane with a point inserted (default: visible)",
    )
    parser.add_argument("--straight", action="store_true", help="merge edges in one line too, for --cells and -o")
    parser.add_argument("--cells", action="store_true", help="print the cell list: vertices, edges and faces")
    parser.add_argument("--fill", action="store_true", help="fill the hull of the centres; -o writes the voxels")
    parser.add_argument(
        "--each-label",
        action="store_true",
        help="a table: of each label (or of those given) volume, hull, area, solidity and convex deficiency; with "
        "--fill in voxels",
    )
    parser.add_argument(
        "--csv", metavar="FILE", help="with --each-label: the table with all digits and exact fractions"
    )
    mesh = ", ".join(f".{name}" for name in MESHES)
    parser.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        help=f"a mesh ({mesh}); with --fill an array: .nrrd, which keeps spacing and origin, or .npy; with "
        "--each-label a name with a place for the label, as 'label-%%d.off'",
    )


def octree_hull(parser: ArgumentParser) -> None:
    """``octree-hull``."""
    volume_arguments(parser)
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--literal", action="store_true", help="every statement of the paper as printed")
    which.add_argument(
        "--printed",
        metavar="NAME,...",
        help="only these as printed: angle, start, triangles, truncation, bound, corners, marks",
    )
    words = "print floor and ceiling, the reduced sets, and every face (default: a summary)"
    parser.add_argument("--tables", action="store_true", help=words)
    words = "the tables, with every edge taken from the queue and what became of it"
    parser.add_argument("--trace", action="store_true", help=words)
    meshes = tuple(f".{name}" for name in MESHES)
    words = "the filled hull as an array: .nrrd, which keeps spacing and origin, or .npy; or as a mesh "
    parser.add_argument("-o", "--output", metavar="FILE", help=f"{words}({', '.join(meshes)}) over voxels' centres")
    parser.set_defaults(endings=(".nrrd", ".npy", *meshes))
