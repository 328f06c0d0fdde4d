"""The command line: every command with its arguments, and what ``--help`` says of them.

Those of the commands that draw and write hulls are in ``modern/cli/shared/pictured.py``.  Nothing here imports what a
command needs to run, so that ``--help`` is quick.
"""

from __future__ import annotations

from argparse import ArgumentParser
from collections.abc import Callable

from modern.cli.shared import pictured
from modern.cli.shared.arguments import (
    compared_machine,
    core_argument,
    epsilon_text,
    layers_argument,
    output_argument,
    points_argument,
    result_arguments,
    upcase_argument,
)


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
        "--epsilon",
        metavar="E",
        type=epsilon_text,
        help="punch chapter 7's e after N and add the layer epsilon, which reads it there",
    )
    parser.add_argument("--explain", action="store_true", help="say at length why there is no hull, and what to try")
    result_arguments(parser)


def _cards(parser: ArgumentParser) -> None:
    points_argument(parser)
    parser.add_argument("-o", "--output", metavar="DECK", default="-", help="the deck (default: standard output)")
    parser.add_argument(
        "--truncate", action="store_true", help="cut digits a card cannot hold instead of refusing them"
    )
    parser.add_argument(
        "--epsilon",
        metavar="E",
        type=epsilon_text,
        help="punch chapter 7's e after N, for the layer epsilon",
    )


def _diff(parser: ArgumentParser) -> None:
    points_argument(parser)
    parser.add_argument(
        "--epsilon",
        metavar="E",
        type=epsilon_text,
        help="chapter 7's e for layer epsilon and the port; rel:E, for the port only",
    )
    parser.add_argument("--json", metavar="FILE", help="write the comparison as JSON")
    parser.add_argument("--explain", action="store_true", help="say at length why a program came to no hull")
    layers_argument(parser)


def _diverge(parser: ArgumentParser) -> None:
    parser.add_argument("program", metavar="PROGRAM.f")
    words = "data cards: for program2 and program3 those program 1 punches; none for a program that reads none"
    parser.add_argument("deck", metavar="DECK", nargs="?", help=words)
    parser.add_argument(
        "--against",
        metavar="NAME",
        default="exact",
        help="the reference (default: exact); what its own rounding may explain is no difference",
    )
    parser.add_argument("--first", action="store_true", help="stop at the first decision that differs; no values")
    parser.add_argument("--json", metavar="FILE", help="write the comparison as JSON")
    compared_machine(parser)


def _listing(parser: ArgumentParser) -> None:
    parser.add_argument("program", metavar="PROGRAM.f")
    parser.add_argument("deck", metavar="DECK", nargs="?", help="data cards; with them the program is run")
    words = "digits lost to this arithmetic, or none (default: %(default)s)"
    parser.add_argument("--against", metavar="NAME", default="exact", help=words)
    parser.add_argument("--operator", metavar="=FILE", help="a file or a log that answers ACCEPT and PAUSE")
    output_argument(parser)
    compared_machine(parser)


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
    parser.add_argument("--redraw", metavar="DIR", help="draw the plots of a finished study anew, from its charts.json")
    parser.add_argument("--verify", metavar="DIR", help="compare the rows of the study in DIR with their checksums")
    parser.add_argument("--quiet", action="store_true", help="no progress")


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
    output_argument(parser, "FILE.svg")
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--page", metavar="N", type=int, help="this page alone (default: all, one below the other)")
    which.add_argument("--table", action="store_true", help="every way from box to box as text instead of the picture")
    parser.set_defaults(endings=(".svg",))


def _tei(parser: ArgumentParser) -> None:
    parser.add_argument("text", metavar="TEXT", nargs="?", help="program1, chapter6, ... (default: name them all)")
    output_argument(parser)
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
    "export": ("the exact hull of points as a mesh or as JSON", pictured.export),
    "draw": ("a line drawing of the exact hull of points, as SVG", pictured.draw),
    "appel-will": ("the hull of a polyhedron from its convex edges, by Appel & Will", pictured.appel_will),
    "hidden-line": ("convex polyhedra without their hidden lines, by Nakamae & Nishita", pictured.hidden_line),
    "voxel-hull": (
        "the hull of a voxel solid by Kovalevsky and Schulz, or its filled digital hull",
        pictured.voxel_hull,
    ),
    "octree-hull": ("the digital hull of a voxel solid from its octree, by Yau and Srihari", pictured.octree_hull),
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
