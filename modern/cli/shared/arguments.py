"""Define the arguments that several commands share: inputs, the machine that runs a program, and outputs of results.

The end of the module lists the words with which the shell can complete an argument (package argcomplete, in the extra
``completion``).  The lists repeat the names of examples, because reading the names from the data would be too slow.

Like ``modern/cli/arguments.py``, this module imports nothing that is needed only to run a command.
"""

import sys
from argparse import Action, ArgumentParser, ArgumentTypeError, Namespace, _ActionsContainer
from collections.abc import Iterable, Mapping
from typing import Any

from modern.cli.shared.console import InputFile, OutputFile
from modern.formats import POINTS


def add(parser: _ActionsContainer, texts: Mapping[str, str], **settings: Any) -> None:
    """Add arguments to a parser.

    texts: for each argument, its names and metavar, such as ``-o --output FILE``, and its help text.  An option with
    neither metavar nor ``choices`` is a switch.  settings: the settings of ``add_argument`` for all these arguments.
    """
    for names, text in texts.items():
        *flags, last = names.split()
        if not last.startswith("-"):
            parser.add_argument(*flags, metavar=last, help=text, **settings)
        elif "choices" in settings:
            parser.add_argument(*flags, last, help=text, **settings)
        else:
            parser.add_argument(*flags, last, help=text, action="store_true", **settings)


def result_arguments(parser: ArgumentParser) -> None:
    """Add the options for the outputs and the operator of a run, and the arguments of ``machine_arguments``."""
    add(
        parser,
        {"--punch FILE": "write the punched cards to FILE (default: standard output)"},
        type=OutputFile,
        default="-",
    )
    add(parser, {"--typewriter FILE": "write the typed lines to FILE (default: standard error)"}, type=OutputFile)
    add(parser, {"--profile": "count statements and operations, and estimate the time on the 1620"})
    add(parser, {"--trace FILE": "write every statement with its card and values to FILE"}, type=OutputFile)
    operator = (
        "choose who answers ACCEPT and PAUSE: --operator alone: you, at the terminal; --operator=FILE: a file or "
        "a log; --operator=none: nobody (default: you, if all standard streams are the terminal and the program has "
        "ACCEPT or PAUSE)"
    )
    add(parser, {"--operator =FILE": operator}, type=InputFile)
    add(
        parser,
        {"--log FILE": "record the actions of the operator in FILE; --operator=FILE repeats them"},
        type=OutputFile,
    )
    add(parser, {"--slow": "type on the terminal as slowly as the typewriter of the 1620, ten characters per second"})
    machine_arguments(parser)


def machine_arguments(parser: ArgumentParser) -> None:
    """Add the options that describe the machine on which a program runs, and ``--layers``."""
    switch = {"--switch N": "turn sense switch N (1 to 4) on (default: all are off)"}
    add(parser, switch, type=int, action="append", choices=(1, 2, 3, 4), default=[])
    arithmetic = (
        "calculate with truncating, ibm1962, truncating1962, float64, float32 or exact; with P decimal digits: "
        "truncating:P, guarded:P, rounding:P, interval:P or stochastic:P:SEED; or with BITS binary digits: mp:BITS or "
        "stochastic:BITSb:SEED. stochastic rounds at random; SEED is an integer, or a range such as 1-10 for ten runs "
        "that all take the same branches (default: %(default)s, the eight digits of the thesis)"
    )
    add(parser, {"--arithmetic NAME": arithmetic}, default="truncating")
    core_argument(parser)
    bounds = (
        "if a subscript is out of bounds, stop (strict) or use the neighbouring field as the machine did (core) "
        "(default: %(default)s)"
    )
    add(parser, {"--bounds": bounds}, choices=("strict", "core"), default="strict")
    limit = (
        "stop after N executed statements, or earlier if slow operations take as long as N statements "
        "(default: %(default)s)"
    )
    add(parser, {"--limit N": limit}, type=int, default=5_000_000)
    layers_argument(parser)


def compared_machine(parser: ArgumentParser) -> None:
    """Add ``machine_arguments``, with a lower default of ``--limit`` because comparisons are slow, and ``--upcase``."""
    machine_arguments(parser)
    upcase_argument(parser)
    parser.set_defaults(limit=1_000_000)


def program_argument(parser: ArgumentParser, action: str, nargs: str | None = None) -> None:
    add(parser, {"program PROGRAM.f": f"the program to {action}"}, type=InputFile, nargs=nargs)


def deck_argument(parser: ArgumentParser, text: str, nargs: str | None = "?") -> None:
    add(parser, {"deck DECK": text}, type=InputFile, nargs=nargs)


def output_argument(parser: ArgumentParser, metavar: str = "FILE", formats: str = "") -> None:
    text = f"write to {metavar}{formats} (default: '-', standard output)"
    add(parser, {f"-o --output {metavar}": text}, type=OutputFile, default="-")


def result_file_argument(parser: ArgumentParser, contents: str) -> None:
    """Add ``--output`` to a command that writes no file unless the user names one."""
    add(parser, {"-o --output FILE": f"write {contents}"}, type=OutputFile)


def json_argument(parser: ArgumentParser, contents: str) -> None:
    text = f"write the {contents} to FILE as JSON ('-': standard output; the report then goes to standard error)"
    add(parser, {"--json FILE": text}, type=OutputFile)


def printed_arguments(parser: ArgumentParser, rules: str, names: str) -> None:
    """Add the options that select which rules of a method are applied as the paper prints them, not corrected."""
    texts = {
        "--literal": f"apply every {rules} as the paper prints it (default: with the corrections of this project)",
        "--printed NAME,...": f"apply only these {rules}s as printed, and the others corrected: {names}",
    }
    add(parser.add_mutually_exclusive_group(), texts)


def epsilon_argument(parser: ArgumentParser, verb: str, use: str) -> None:
    add(parser, {"--epsilon E": f"{verb} the tolerance e of chapter 7 of the thesis {use}"}, type=epsilon_text)


def title_argument(parser: ArgumentParser, default: str) -> None:
    add(parser, {"--title TEXT": f"write TEXT below the picture (default: {default})"})


def core_argument(parser: ArgumentParser) -> None:
    text = "use a machine with this many positions of core storage (default: %(default)s)"
    add(parser, {"--core": text}, type=int, choices=(20000, 40000, 60000), default=40000)


def eye_argument(parser: ArgumentParser) -> None:
    text = "look from this direction; write --eye=-1,2,3 if X is negative (default: chosen for the points)"
    add(parser, {"--eye X,Y,Z": text})


def coplanar_argument(parser: ArgumentParser) -> None:
    text = (
        "merge neighbouring faces whose vertices lie within the distance E of one plane (default: merge only "
        "exactly coplanar faces)"
    )
    add(parser, {"--coplanar-within E": text})


def layers_argument(parser: ArgumentParser) -> None:
    text = (
        "change a built-in program by these optional layers of the edition: corrected (known faults corrected), "
        "epsilon and translation (the two proposals of chapter 7), or for program 1 examples (its state when the "
        "examples ran) "
        "(default: none; for diff: corrected)"
    )
    add(parser, {"--layers LAYER,...": text}, default="")


def upcase_argument(parser: ArgumentParser) -> None:
    add(parser, {"--upcase": "read small letters of the program as capitals"})


def points_argument(parser: ArgumentParser, metavar: str = "POINTS", note: str = "") -> None:
    """Add an argument that names a file of points in any supported format."""
    text = (
        f"{listed(POINTS.values())}{note}, or the name of a set: example5 of the thesis, sample seventy/17 of a study, "
        "or figure appel-will/fig18 of a paper"
    )
    add(parser, {f"points {metavar}": text}, type=InputFile)


def listed(names: Iterable[str]) -> str:
    """Return the names joined to a text such as ``a, b or c``."""
    *others, last = names
    return f"{', '.join(others)} or {last}"


def epsilon_text(text: str) -> str:
    """Return a valid tolerance e of chapter 7, such as ``.001`` or ``rel:E``.  Raise ArgumentTypeError otherwise."""
    from modern.geometry.numbers import read_epsilon  # imported here because few commands need it

    try:
        read_epsilon(text)
    except ValueError as error:
        raise ArgumentTypeError(str(error).removeprefix("epsilon: ")) from None
    return text


ARITHMETICS = ("truncating", "ibm1962", "float64", "float32", "exact", "mp:200")
DOCUMENTS = ("thesis", "appel-will", "kovalevsky-schulz", "nakamae-nishita", "yau-srihari")
PROGRAMS = ("program1", "program2", "program3", "program1_examples")
STUDIES = (
    "alarms",
    "capacity",
    "digits",
    "divergence",
    "epsilon",
    "machine-time",
    "rounding",
    "seventy",
    "translation",
)
THEOREMS = ("4.1", "4.2", "4.8")
SCENES = ("columns", "cuboids", "house")
TEXTS = (
    *("program1", "program2", "program3", "chapter4", "chapter6"),
    *("appel_will_1976", "kovalevsky_schulz", "nakamae_nishita_1972"),
    *(f"statements-{name}" for name in DOCUMENTS),
)
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
    "examples": (*map(str, range(1, 7)), *THEOREMS, *DOCUMENTS),
    "name": STUDIES,
    "points": EXAMPLES,
    "program": PROGRAMS,
    "scene": (*SCENES, *EXAMPLES),
    "text": TEXTS,
    "volume": ("ball:32", "ball:32:vertex", "half-ball:18"),
}


def complete(parser: ArgumentParser) -> None:
    """Print the words that can complete the command line that the user is typing, and exit."""
    try:
        from argcomplete import autocomplete
        from argcomplete.completers import BaseCompleter, FilesCompleter
    except ImportError:
        sys.exit(1)

    class Candidates(BaseCompleter):
        """Complete an argument with the names in ``NAMES`` and with files."""

        def __call__(
            self, *, prefix: str, action: Action, parser: ArgumentParser, parsed_args: Namespace
        ) -> Iterable[str]:
            return (*NAMES.get(action.dest, ()), *FilesCompleter()(prefix))

    autocomplete(parser, default_completer=Candidates())
