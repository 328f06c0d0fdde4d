"""Arguments of the command line; nothing heavy is imported here, so that ``--help`` is quick."""

from __future__ import annotations

import argparse
import sys

from modern.cli.paper_arguments import paper_commands
from modern.cli.parsing import Commands, Parser, command


def build_parser() -> argparse.ArgumentParser:
    """The argument parser."""
    parser = Parser(
        prog="hull1620",
        description="Karen Jensen Butler's convex hull programs of 1963, restored and run on an emulated IBM 1620; "
        "exact hulls, studies of numerical error, and four later papers.",
        epilog="PROGRAM.f is a file or one of program1, program2, program3, program1_examples. "
        "'-' is standard input or output.",
    )
    parser.add_argument(
        "--version", action="version", version=f"hull1620 {_version()}" if "--version" in sys.argv else ""
    )
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True, parser_class=Parser)
    for add in (_reproduce, _run, _hull, _cards, _diff, _diverge, _study, _export, _draw, paper_commands):
        add(commands)
    for add in (_apparatus, _check, _map, _compile, _bench):
        add(commands)
    return parser


def _reproduce(commands: Commands) -> None:
    parser = command(
        commands,
        "reproduce",
        "what the thesis and the later papers print, computed, with a verdict on every result",
        "modern.cli.reproduce",
    )
    parser.add_argument(
        "examples", metavar="EXAMPLE", nargs="*", help="1 to 6, a theorem (4.1, 4.2, 4.8) or a paper (default: all)"
    )
    parser.add_argument("--json", metavar="FILE", help="write the verdicts as JSON")


def _run(commands: Commands) -> None:
    parser = command(commands, "run", "run a FORTRAN program on the emulated 1620", "modern.cli.run")
    parser.add_argument("program", metavar="PROGRAM.f")
    parser.add_argument("deck", metavar="DECK", nargs="?", help="data cards, one a line")
    _machine_options(parser)


def _hull(commands: Commands) -> None:
    parser = command(
        commands,
        "hull",
        "the hull of a data deck: program 1, then 2 or 3 as the typewriter says",
        "modern.cli.hull",
    )
    parser.add_argument("deck", metavar="DECK")
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
    _machine_options(parser)


def _cards(commands: Commands) -> None:
    parser = command(commands, "cards", "points to a data deck", "modern.cli.cards")
    parser.add_argument("points", metavar="POINTS.csv", help="three decimal numbers a line")
    parser.add_argument("-o", "--output", metavar="DECK", default="-")
    parser.add_argument(
        "--truncate", action="store_true", help="cut digits a card cannot hold instead of refusing them"
    )


def _diff(commands: Commands) -> None:
    parser = command(
        commands, "diff", "one point set by the 1963 programs, the port and the exact hull", "modern.cli.diff"
    )
    parser.add_argument("points", metavar="POINTS", help="a data deck, CSV points x,y,z or an OFF file")
    parser.add_argument(
        "--epsilon", metavar="E", help="chapter 7's e for layer epsilon and the port; rel:E, for the port only"
    )
    parser.add_argument("--json", metavar="FILE", help="write the comparison as JSON")
    _layers(parser)


def _diverge(commands: Commands) -> None:
    parser = command(
        commands,
        "diverge",
        "run a program over two arithmetics and name the first value and the first decision that differ",
        "modern.cli.diverge",
    )
    parser.add_argument("program", metavar="PROGRAM.f")
    parser.add_argument("deck", metavar="DECK", help="data cards: for program2 and program3 those program 1 punches")
    parser.add_argument("--against", metavar="NAME", default="exact", help="the reference (default: exact)")
    parser.add_argument("--first", action="store_true", help="stop at the first decision that differs; no values")
    parser.add_argument("--json", metavar="FILE", help="write the comparison as JSON")
    _machine(parser)
    parser.set_defaults(limit=1_000_000)


def _study(commands: Commands) -> None:
    parser = command(
        commands, "study", "many samples, each judged: a table, a plot and plain words", "modern.cli.study"
    )
    parser.add_argument("name", metavar="NAME", nargs="?", help="a study built in, or a plan file NAME.toml")
    parser.add_argument("--list", action="store_true", help="list the studies built in")
    parser.add_argument("--samples", metavar="N", type=int, help="samples (--list: the sets they make)")
    parser.add_argument("--seed", metavar="S", type=int, help="the seed of all samples (default: 1963)")
    parser.add_argument("--workers", metavar="W", type=int, help="processes (default: one a processor)")
    parser.add_argument(
        "--dask", metavar="ADDRESS", help="the scheduler of a dask.distributed cluster, for its workers"
    )
    parser.add_argument("--out", metavar="DIR", help="the study's folder (default: its name)")
    parser.add_argument("--resume", action="store_true", help="go on with the study begun in the folder")
    parser.add_argument("--quiet", action="store_true", help="no progress")


def _export(commands: Commands) -> None:
    parser = command(commands, "export", "the exact hull of points as a mesh or as JSON", "modern.cli.export")
    parser.add_argument("points", metavar="POINTS", help="a data deck, CSV points x,y,z or an OFF file")
    parser.add_argument(
        "-o", "--output", metavar="FILE", default="-", help="a name ending .off, .obj, .ply, .stl or .json"
    )
    parser.add_argument(
        "--format", choices=("off", "obj", "ply", "stl", "json"), help="the format, where the name does not say it"
    )


def _draw(commands: Commands) -> None:
    parser = command(commands, "draw", "a line drawing of the exact hull of points, as SVG", "modern.cli.draw")
    parser.add_argument("points", metavar="POINTS", help="a data deck, CSV points x,y,z or an OFF file")
    parser.add_argument("-o", "--output", metavar="FILE.svg", default="-")
    parser.add_argument("--eye", metavar="X,Y,Z", help="the direction to the eye; write --eye=-1,2,3 before a minus")
    parser.add_argument("--title", metavar="TEXT", help="the line below the picture (default: the name of the file)")


def _apparatus(commands: Commands) -> None:
    parser = command(commands, "apparatus", "the emendations of the listings, row by row", "modern.cli.apparatus")
    parser.add_argument("--program", metavar="N", help="1, 2 or 3")
    parser.add_argument("--layer", metavar="L")
    parser.add_argument(
        "--check",
        action="store_true",
        help="prove that witness and rows build the decks, and that each row is needed",
    )


def _check(commands: Commands) -> None:
    parser = command(commands, "check", "the compiler's messages for a program", "modern.cli.check")
    parser.add_argument("program", metavar="PROGRAM.f")
    _layers(parser)


def _map(commands: Commands) -> None:
    parser = command(commands, "map", "the storage map of a program", "modern.cli.storage")
    parser.add_argument("program", metavar="PROGRAM.f")
    parser.add_argument("--core", type=int, choices=(20000, 40000, 60000), default=40000)
    _layers(parser)


def _compile(commands: Commands) -> None:
    parser = command(commands, "compile", "the object code of a program", "modern.cli.listing")
    parser.add_argument("program", metavar="PROGRAM.f")
    _layers(parser)


def _bench(commands: Commands) -> None:
    parser = command(commands, "bench", "the speed of the engines side by side", "modern.cli.bench")
    parser.add_argument("--decks", metavar="N", type=int, default=1000, help="decks of 51 points (default: 1000)")
    parser.add_argument("--json", metavar="FILE", help="write the figures as JSON")


def _layers(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--layers",
        metavar="LAYER,...",
        default="",
        help="layers of the apparatus added to a built-in program",
    )


def _machine_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--punch", metavar="FILE", default="-", help="where punched cards go (default: standard output)"
    )
    parser.add_argument("--typewriter", metavar="FILE", help="where typed lines go (default: standard error)")
    parser.add_argument(
        "--profile",
        action="store_true",
        help="count statements and operations, and give the time on the 1620",
    )
    parser.add_argument("--trace", metavar="FILE", help="write every statement with its card and values")
    _machine(parser)


def _machine(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--switch",
        metavar="N",
        type=int,
        action="append",
        choices=(1, 2, 3, 4),
        default=[],
        help="sense switch N on",
    )
    parser.add_argument(
        "--arithmetic",
        metavar="NAME",
        default="truncating",
        help="truncating, ibm1962, truncating:P, guarded:P, rounding:P, float64, float32, mp:BITS or exact",
    )
    parser.add_argument(
        "--core", type=int, choices=(20000, 40000, 60000), default=40000, help="positions of core storage"
    )
    parser.add_argument(
        "--bounds",
        choices=("strict", "core"),
        default="strict",
        help="a subscript out of bounds: stop, or use the neighbour's place as the machine did",
    )
    parser.add_argument(
        "--limit", metavar="N", type=int, default=5_000_000, help="stop after N statements (default: %(default)s)"
    )
    _layers(parser)


def _version() -> str:
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version("hull1620")
    except PackageNotFoundError:
        return "(not installed)"
