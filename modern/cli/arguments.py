"""The command line: every command with its arguments, and what ``--help`` says of them.

Nothing here imports what a command needs to run, so that ``--help`` is quick.
"""

from __future__ import annotations

from argparse import ArgumentParser
from collections.abc import Callable

from modern.cli.shared.arguments import (
    coplanar_argument,
    core_argument,
    eye_argument,
    layers_argument,
    listed,
    machine_arguments,
    points_argument,
    result_arguments,
    upcase_argument,
    volume_arguments,
)
from modern.formats import HULLS, MESHES


def _reproduce(parser: ArgumentParser) -> None:
    words = "1 to 6, a theorem (4.1), a document (thesis, yau-srihari, ...) or a statement's id (default: all)"
    parser.add_argument("examples", metavar="NAME", nargs="*", help=words)
    parser.add_argument("--show", action="store_true", help="print beside result, character by character")
    parser.add_argument("--json", metavar="FILE", help="write the verdicts as JSON")


def _run(parser: ArgumentParser) -> None:
    parser.add_argument("program", metavar="PROGRAM.f")
    parser.add_argument("deck", metavar="DECK", nargs="?", help="data cards, one a line")
    result_arguments(parser)
    upcase_argument(parser)


def _hull(parser: ArgumentParser) -> None:
    parser.add_argument(
        "deck", metavar="DECK", help="a data deck, or example1 to example6, or a study's set: seventy/17"
    )
    parser.add_argument(
        "--programs",
        choices=("listing", "examples"),
        default="listing",
        help="which state of program 1 (default: listing)",
    )
    parser.add_argument(
        "--uncut",
        action="store_true",
        help="numbers go from program 1 to the next with all their digits, not with the eight a card holds",
    )
    parser.add_argument(
        "--epsilon", metavar="E", help="punch chapter 7's e after N and add the layer epsilon, which reads it there"
    )
    parser.add_argument("--explain", action="store_true", help="say at length why there is no hull, and what to try")
    result_arguments(parser)


def _cards(parser: ArgumentParser) -> None:
    points_argument(parser)
    parser.add_argument("-o", "--output", metavar="DECK", default="-", help="the deck (default: standard output)")
    parser.add_argument(
        "--truncate", action="store_true", help="cut digits a card cannot hold instead of refusing them"
    )
    parser.add_argument("--epsilon", metavar="E", help="punch chapter 7's e after N, for the layer epsilon")


def _diff(parser: ArgumentParser) -> None:
    points_argument(parser)
    parser.add_argument(
        "--epsilon", metavar="E", help="chapter 7's e for layer epsilon and the port; rel:E, for the port only"
    )
    parser.add_argument("--json", metavar="FILE", help="write the comparison as JSON")
    parser.add_argument("--explain", action="store_true", help="say at length why a program came to no hull")
    layers_argument(parser)


def _diverge(parser: ArgumentParser) -> None:
    parser.add_argument("program", metavar="PROGRAM.f")
    parser.add_argument("deck", metavar="DECK", help="data cards: for program2 and program3 those program 1 punches")
    parser.add_argument(
        "--against",
        metavar="NAME",
        default="exact",
        help="the reference (default: exact); what its own rounding may explain is no difference",
    )
    parser.add_argument("--first", action="store_true", help="stop at the first decision that differs; no values")
    parser.add_argument("--json", metavar="FILE", help="write the comparison as JSON")
    machine_arguments(parser)
    upcase_argument(parser)
    parser.set_defaults(limit=1_000_000)


def _listing(parser: ArgumentParser) -> None:
    parser.add_argument("program", metavar="PROGRAM.f")
    parser.add_argument("deck", metavar="DECK", nargs="?", help="data cards; with them the program is run")
    words = "digits lost to this arithmetic, or none (default: %(default)s)"
    parser.add_argument("--against", metavar="NAME", default="exact", help=words)
    parser.add_argument("--operator", metavar="=FILE", help="a file or a log that answers ACCEPT and PAUSE")
    parser.add_argument("-o", "--output", metavar="FILE", default="-", help="where it goes (default: '-')")
    machine_arguments(parser)
    upcase_argument(parser)
    parser.set_defaults(limit=1_000_000)


def _study(parser: ArgumentParser) -> None:
    parser.add_argument("name", metavar="NAME", nargs="?", help="a study built in, or a plan file NAME.toml")
    parser.add_argument("--list", action="store_true", help="list the studies built in")
    parser.add_argument("--families", action="store_true", help="list the families of point sets a plan can name")
    parser.add_argument("--measures", action="store_true", help="list the measures a route of a plan can name")
    parser.add_argument("--samples", metavar="N", type=int, help="samples (default: the study's, which --list shows)")
    parser.add_argument("--seed", metavar="S", type=int, help="the seed of all samples (default: 1963)")
    parser.add_argument("--workers", metavar="W", type=int, help="processes (default: one a processor)")
    parser.add_argument(
        "--dask", metavar="ADDRESS", help="the scheduler of a dask.distributed cluster, for its workers"
    )
    parser.add_argument("--out", metavar="DIR", help="the study's folder (default: its name)")
    parser.add_argument("--resume", action="store_true", help="go on with the study begun in the folder")
    parser.add_argument("--quiet", action="store_true", help="no progress")


def _export(parser: ArgumentParser) -> None:
    points_argument(parser)
    endings = listed(f".{name}" for name in HULLS)
    parser.add_argument(
        "-o", "--output", metavar="FILE", default="-", help=f"a name ending {endings} (default: '-', with --format)"
    )
    parser.add_argument("--format", choices=tuple(HULLS), help="the format, where the name does not say it")
    coplanar_argument(parser)


def _draw(parser: ArgumentParser) -> None:
    points_argument(parser)
    parser.add_argument("-o", "--output", metavar="FILE.svg", default="-", help="where it goes (default: '-')")
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


def _appel_will(parser: ArgumentParser) -> None:
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
    parser.add_argument("-o", "--output", metavar="FILE.off", help="write the hull as an OFF file too")
    parser.set_defaults(endings=(".off",))


def _hidden_line(parser: ArgumentParser) -> None:
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
    words = "in perspective: cut off what lies nearer to the eye than this (default: it is refused beside or behind it)"
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


def _voxel_hull(parser: ArgumentParser) -> None:
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
        "--coplanar", choices=("visible", "invisible"), help="faces in a plane with a new point (default: visible)"
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


def _octree_hull(parser: ArgumentParser) -> None:
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


def _apparatus(parser: ArgumentParser) -> None:
    parser.add_argument("--program", metavar="N", help="1, 2 or 3")
    parser.add_argument("--layer", metavar="L", help="of this layer only (default: all)")
    parser.add_argument(
        "--check",
        action="store_true",
        help="prove that witness and rows build the decks, and that each reading is allowed and needed",
    )
    parser.add_argument(
        "--text", metavar="FILE", help="with --check: a document's OCR text, to compare its excerpts with"
    )
    parser.add_argument(
        "--weigh",
        metavar="FOLDER",
        help="alter every token of the listings and record what notices it; goes on where the folder ends",
    )
    parser.add_argument("--runs", metavar="FOLDER", help="with --weigh: folders with a deck.cards each, known decks")
    parser.add_argument("--workers", metavar="N", type=int, default=1, help="with --weigh: processes (default: 1)")
    parser.add_argument(
        "--most", metavar="N", type=int, default=0, help="with --weigh: only the first N variants (default: 0, all)"
    )


def _program(parser: ArgumentParser) -> None:
    parser.add_argument("program", metavar="PROGRAM.f")
    layers_argument(parser)
    upcase_argument(parser)


def _check(parser: ArgumentParser) -> None:
    parser.add_argument("program", metavar="PROGRAM.f", nargs="?")
    parser.add_argument("--explain", metavar="N", help="what error number N means, as 5 or E3; all: every one")
    core_argument(parser)
    layers_argument(parser)
    upcase_argument(parser)


def _flowchart(parser: ArgumentParser) -> None:
    _program(parser)
    parser.add_argument("-o", "--output", metavar="FILE.svg", default="-", help="where it goes (default: '-')")
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--page", metavar="N", type=int, help="this page alone (default: all, one below the other)")
    which.add_argument("--table", action="store_true", help="every way from box to box as text instead of the picture")
    parser.set_defaults(endings=(".svg",))


def _tei(parser: ArgumentParser) -> None:
    parser.add_argument("text", metavar="TEXT", nargs="?", help="program1, chapter6, ... (default: name them all)")
    parser.add_argument("-o", "--output", metavar="FILE", default="-", help="where it goes (default: '-')")
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--all", metavar="FOLDER", help="every text, as FOLDER/TEXT.xml")
    which.add_argument("--schema", action="store_true", help="the RELAX NG schema of these documents instead")
    which.add_argument(
        "--check",
        metavar="SCHEMA",
        nargs="?",
        const="",
        help="validate TEXT, or every text, against a RELAX NG schema in XML (default: the project's own)",
    )
    which.add_argument("--read", metavar="FILE.xml", help="from a document alone: its corrected text, or deck")
    parser.add_argument("--layers", metavar="L,...", help="with --read: the layers applied (default: the edition's)")
    parser.add_argument("--witness", action="store_true", help="with --read: the witness instead")
    parser.add_argument("--part", metavar="NAME", help="with --read: a device file, as example1/program1.deck")
    parser.set_defaults(endings=(".xml", ".f", ".txt", ".deck", ".punch", ".typewriter", ".rng"))


def _punched(parser: ArgumentParser) -> None:
    parser.add_argument(
        "deck",
        metavar="DECK",
        help="a deck, one card a line, the name of a built-in program, or an example: example1, seventy/17",
    )
    parser.add_argument(
        "-o",
        "--output",
        metavar="FILE.svg",
        default="-",
        help="one picture, or one a card where the name has a place for its number: 'card-%%03d.svg' (default: '-')",
    )
    parser.add_argument("--across", metavar="N", type=int, default=1, help="cards side by side (default: 1)")
    parser.set_defaults(endings=(".svg",))


def _map(parser: ArgumentParser) -> None:
    parser.add_argument("program", metavar="PROGRAM.f")
    core_argument(parser)
    layers_argument(parser)
    upcase_argument(parser)


def _bench(parser: ArgumentParser) -> None:
    parser.add_argument("--decks", metavar="N", type=int, default=1000, help="decks of 51 points (default: 1000)")
    parser.add_argument("--json", metavar="FILE", help="write the figures as JSON")


COMMANDS: dict[str, tuple[str, Callable[[ArgumentParser], None]]] = {
    "reproduce": ("what the thesis and the later papers print, computed, with a verdict on every result", _reproduce),
    "run": ("run a FORTRAN program on the emulated 1620", _run),
    "hull": ("the hull of a data deck: program 1, then 2 or 3 as the typewriter says", _hull),
    "cards": ("points to a data deck", _cards),
    "diff": ("one point set by the 1963 programs, the port and the exact hull", _diff),
    "diverge": (
        "run a program over two arithmetics and name the first value and the first decision that differ",
        _diverge,
    ),
    "study": ("many samples, each judged: a table, a plot and plain words", _study),
    "export": ("the exact hull of points as a mesh or as JSON", _export),
    "draw": ("a line drawing of the exact hull of points, as SVG", _draw),
    "appel-will": ("the hull of a polyhedron from its convex edges, by Appel & Will", _appel_will),
    "hidden-line": ("convex polyhedra without their hidden lines, by Nakamae & Nishita", _hidden_line),
    "voxel-hull": ("the hull of a voxel solid by Kovalevsky and Schulz, or its filled digital hull", _voxel_hull),
    "octree-hull": ("the digital hull of a voxel solid from its octree, by Yau and Srihari", _octree_hull),
    "apparatus": ("the emendations of the listings, row by row", _apparatus),
    "check": ("the compiler's messages for a program; what an error number means", _check),
    "listing": ("the cards of a program, each with its count, its share of the time and the digits it lost", _listing),
    "map": ("the storage map of a program", _map),
    "compile": ("the object code of a program", _program),
    "flowchart": ("a program's flow of control as a flow chart, in SVG", _flowchart),
    "punched": ("a deck drawn as punched cards, in SVG", _punched),
    "tei": ("listings and prints with their apparatus as TEI P5; and back to decks", _tei),
    "bench": ("the speed of the engines side by side", _bench),
}
"""Every command, named as its module but for - instead of _: what ``--help`` says of it, and its arguments.

A command's module defines ``main(args)``, which returns the exit code.
"""
