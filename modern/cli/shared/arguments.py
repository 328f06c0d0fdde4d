"""Arguments that several commands share: inputs, the machine on which a program runs, and destinations of results.

The end of the module lists the words with which the shell can complete an argument (package argcomplete, in the extra
``completion``).  The names of examples are written out there, because reading them from the data would be too slow.

Like ``modern/cli/arguments.py``, this module imports nothing that is needed only to run a command.
"""

from __future__ import annotations

import sys
from argparse import Action, ArgumentParser, ArgumentTypeError, Namespace
from collections.abc import Iterable

from modern.formats import POINTS


def result_arguments(parser: ArgumentParser) -> None:
    """Add the destinations of a run's results, the operator, and the arguments of ``machine_arguments``."""
    parser.add_argument(
        "--punch", metavar="FILE", default="-", help="write the punched cards to FILE (default: standard output)"
    )
    parser.add_argument("--typewriter", metavar="FILE", help="write the typed lines to FILE (default: standard error)")
    parser.add_argument(
        "--profile", action="store_true", help="count statements and operations, and estimate the time on the 1620"
    )
    parser.add_argument("--trace", metavar="FILE", help="write every statement with its card and values to FILE")
    parser.add_argument(
        "--operator",
        metavar="=FILE",
        help="choose who answers ACCEPT and PAUSE: --operator alone: you, at the terminal; --operator=FILE: a file or "
        "a log; --operator=none: nobody (default: you, if all standard streams are the terminal and the program has "
        "ACCEPT or PAUSE)",
    )
    parser.add_argument("--log", metavar="FILE", help="record the actions of the operator in FILE, for --operator=FILE")
    parser.add_argument("--slow", action="store_true", help="type ten characters per second at the terminal")
    machine_arguments(parser)


def machine_arguments(parser: ArgumentParser) -> None:
    """Add the properties of the machine on which a program runs, and ``--layers``."""
    parser.add_argument(
        "--switch",
        metavar="N",
        type=int,
        action="append",
        choices=(1, 2, 3, 4),
        default=[],
        help="turn sense switch N (1 to 4) on (default: all are off)",
    )
    parser.add_argument(
        "--arithmetic",
        metavar="NAME",
        default="truncating",
        help="calculate with truncating, ibm1962, truncating:P, guarded:P, rounding:P, float64, float32, mp:BITS or "
        "exact (default: %(default)s, the eight digits of the thesis)",
    )
    core_argument(parser)
    parser.add_argument(
        "--bounds",
        choices=("strict", "core"),
        default="strict",
        help="if a subscript is out of bounds, stop (strict) or use the neighbouring field as the machine did (core) "
        "(default: %(default)s)",
    )
    parser.add_argument(
        "--limit",
        metavar="N",
        type=int,
        default=5_000_000,
        help="stop after N executed statements, or earlier if slow operations take as long as N statements "
        "(default: %(default)s)",
    )
    layers_argument(parser)


def compared_machine(parser: ArgumentParser) -> None:
    """Add ``machine_arguments`` and ``--upcase``, with a lower limit because every statement is compared."""
    machine_arguments(parser)
    upcase_argument(parser)
    parser.set_defaults(limit=1_000_000)


def program_argument(parser: ArgumentParser, action: str, nargs: str | None = None) -> None:
    parser.add_argument("program", metavar="PROGRAM.f", nargs=nargs, help=f"the program to {action}")


def output_argument(parser: ArgumentParser, metavar: str = "FILE", formats: str = "") -> None:
    parser.add_argument(
        "-o",
        "--output",
        metavar=metavar,
        default="-",
        help=f"write to {metavar}{formats} (default: '-', standard output)",
    )


def result_file_argument(parser: ArgumentParser, contents: str) -> None:
    """Add an output that is written only on request."""
    parser.add_argument("-o", "--output", metavar="FILE", help=f"write {contents}")


def json_argument(parser: ArgumentParser, contents: str) -> None:
    parser.add_argument(
        "--json",
        metavar="FILE",
        help=f"write the {contents} to FILE as JSON ('-': standard output; the report then goes to standard error)",
    )


def printed_arguments(parser: ArgumentParser, rules: str, names: str) -> None:
    """Add the options that choose which rules a method applies as its paper prints them, instead of corrected."""
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--literal", action="store_true", help=f"apply every {rules} as the paper prints it")
    which.add_argument("--printed", metavar="NAME,...", help=f"apply only these {rules}s as printed: {names}")


def epsilon_argument(parser: ArgumentParser, verb: str, use: str) -> None:
    help_text = f"{verb} the tolerance e of chapter 7 of the thesis {use}"
    parser.add_argument("--epsilon", metavar="E", type=epsilon_text, help=help_text)


def title_argument(parser: ArgumentParser, default: str) -> None:
    parser.add_argument("--title", metavar="TEXT", help=f"write TEXT below the picture (default: {default})")


def core_argument(parser: ArgumentParser) -> None:
    parser.add_argument(
        "--core",
        type=int,
        choices=(20000, 40000, 60000),
        default=40000,
        help="use a machine with this many positions of core storage (default: %(default)s)",
    )


def eye_argument(parser: ArgumentParser) -> None:
    parser.add_argument(
        "--eye",
        metavar="X,Y,Z",
        help="look from this direction; write --eye=-1,2,3 if X is negative (default: chosen for the points)",
    )


def coplanar_argument(parser: ArgumentParser) -> None:
    parser.add_argument(
        "--coplanar-within",
        metavar="E",
        help="merge neighbouring faces whose vertices lie within the distance E of one plane (default: merge only "
        "exactly coplanar faces)",
    )


def layers_argument(parser: ArgumentParser) -> None:
    parser.add_argument(
        "--layers",
        metavar="LAYER,...",
        default="",
        help="apply these optional layers of emendations to a built-in program: corrected, epsilon, translation, or "
        "examples for program 1 (default: none; for diff: corrected)",
    )


def upcase_argument(parser: ArgumentParser) -> None:
    parser.add_argument("--upcase", action="store_true", help="read small letters of the program as capitals")


def points_argument(parser: ArgumentParser, metavar: str = "POINTS", note: str = "") -> None:
    """Add a file of points in any supported format."""
    parser.add_argument(
        "points",
        metavar=metavar,
        help=f"{listed(POINTS.values())}{note}, or an example: example5, seventy/17, appel-will/fig18",
    )


def listed(names: Iterable[str]) -> str:
    """Return ``a, b or c``."""
    *others, last = names
    return f"{', '.join(others)} or {last}"


def epsilon_text(text: str) -> str:
    """Return ``text`` if it is a valid tolerance e of chapter 7, such as ``.001`` or ``rel:E``, otherwise raise."""
    from modern.geometry.numbers import read_epsilon  # imported here because few commands need it

    try:
        read_epsilon(text)
    except ValueError as error:
        raise ArgumentTypeError(str(error).removeprefix("epsilon: ")) from None
    return text


ARITHMETICS = ("truncating", "ibm1962", "float64", "float32", "exact", "mp:200")
DOCUMENTS = ("thesis", "appel-will", "nakamae-nishita", "kovalevsky-schulz", "yau-srihari")
PROGRAMS = ("program1", "program2", "program3", "program1_examples")
STUDIES = ("capacity", "digits", "divergence", "epsilon", "machine-time", "rounding", "seventy", "translation")
EXAMPLES = (
    *(f"example{number}" for number in range(1, 7)),
    *(f"appel-will/fig{number}" for number in (13, 14, 18, 23)),
    *(f"{study}/0" for study in STUDIES),
)
# The names that an argument accepts besides files, by the name of the argument.
NAMES: dict[str, tuple[str, ...]] = {
    "arithmetic": ARITHMETICS,
    "against": ARITHMETICS,
    "deck": EXAMPLES,
    "examples": (*map(str, range(1, 7)), *DOCUMENTS),
    "name": STUDIES,
    "points": EXAMPLES,
    "program": PROGRAMS,
    "scene": ("columns", "cuboids", "house", *EXAMPLES),
    "text": ("program1", "program2", "program3", "chapter4", "chapter6"),
    "volume": ("ball:32", "ball:32:vertex", "half-ball:18"),
}


def complete(parser: ArgumentParser) -> None:
    """Print the possible words for the line typed so far, and exit."""
    try:
        from argcomplete import autocomplete
        from argcomplete.completers import BaseCompleter, FilesCompleter
    except ImportError:
        sys.exit(1)

    class Candidates(BaseCompleter):
        """The names that the argument accepts, and files."""

        def __call__(
            self, *, prefix: str, action: Action, parser: ArgumentParser, parsed_args: Namespace
        ) -> Iterable[str]:
            return (*NAMES.get(action.dest, ()), *FilesCompleter()(prefix))

    autocomplete(parser, default_completer=Candidates())
