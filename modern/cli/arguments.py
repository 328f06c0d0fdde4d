"""Define the commands, their arguments and their lines in ``--help``.

The arguments of the commands on points and on volumes are defined in ``modern/cli/shared/point_arguments.py`` and
``modern/cli/shared/volume_arguments.py``.  These modules import nothing that is needed only to run a command, so that
``--help`` is fast.
"""

from argparse import ArgumentParser
from collections.abc import Callable

from modern.cli.shared import arguments as shared
from modern.cli.shared import point_arguments, volume_arguments
from modern.cli.shared.arguments import add
from modern.cli.shared.console import Folder, InputFile, OutputFile


def _reproduce(parser: ArgumentParser) -> None:
    names = (
        "the number of an example (1 to 6), a theorem such as 4.1, a document (thesis, yau-srihari, ...) or the id of "
        "a statement of a document, such as thesis.16 (default: everything)"
    )
    add(parser, {"examples NAME": names}, nargs="*")
    add(parser, {"--show": "show each printed result next to the computed one"})
    shared.json_argument(parser, "verdicts")


def _run(parser: ArgumentParser) -> None:
    shared.program_argument(parser, "run; without it, repeat the runs of the log that --operator=FILE names", "?")
    shared.deck_argument(parser, "a file of data cards, one card per line")
    shared.result_arguments(parser)
    shared.upcase_argument(parser)


def _hull(parser: ArgumentParser) -> None:
    shared.deck_argument(
        parser, "a data deck, one of example1 to example6, or a sample of a study, such as seventy/17", None
    )
    programs = "use program 1 as listed, or as the examples of chapter 6 were run (default: listing)"
    add(parser, {"--programs": programs}, choices=("listing", "examples"), default="listing")
    uncut = (
        "pass numbers from program 1 to the next program with all their digits instead of the eight that a card holds"
    )
    add(parser, {"--uncut": uncut})
    shared.epsilon_argument(
        parser, "punch", "on the first card, after the number of points N, and apply the layer epsilon, which reads it"
    )
    explain = "explain why there is no hull, and report the first branch that exact arithmetic takes differently"
    add(parser, {"--explain": explain})
    shared.result_arguments(parser)


def _diverge(parser: ArgumentParser) -> None:
    shared.program_argument(parser, "run")
    shared.deck_argument(
        parser,
        "a file of data cards, or for program2 and program3 a file of the cards that program 1 punched (may be omitted "
        "if the program reads no cards)",
    )
    against = (
        "compare --arithmetic with the arithmetic NAME, and ignore differences that the rounding of NAME may explain "
        "(default: %(default)s)"
    )
    add(parser, {"--against NAME": against}, default="exact")
    add(parser, {"--first": "stop at the first branch that differs; compare no values"})
    shared.json_argument(parser, "comparison")
    shared.compared_machine(parser)


def _digits(parser: ArgumentParser) -> None:
    shared.program_argument(parser, "examine")
    shared.deck_argument(parser, "a file of data cards (may be omitted if the program reads no cards)")
    add(parser, {"--against NAME": "take this arithmetic as the truth (default: %(default)s)"}, default="exact")
    add(parser, {"--runs N": "make N runs with random rounding and the digits of --arithmetic (default: 10)"}, type=int)
    add(parser, {"--seed S": "give the runs the seeds S, S + 1, ... (default: 1)"}, type=int)
    modes = {
        "--proportional": "round up with a probability proportional to the rounded-off part, instead of 1/2",
        "--majority": "let all runs take the branch that most of them would take, instead of the branch of their mean",
        "--independent": "estimate the digits of the printed numbers from runs that each take their own branches",
    }
    add(parser, modes)
    outputs = {
        "--csv FILE": "write the tables to FILE as CSV",
        "--html FILE": "write the report to FILE as an HTML page",
        "--samples FILE": "write the printed numbers of every run to FILE as a NumPy array, one row for each run",
    }
    add(parser, outputs, type=OutputFile)
    shared.compared_machine(parser)


def _listing(parser: ArgumentParser) -> None:
    shared.program_argument(parser, "list")
    shared.deck_argument(parser, "run the program with these data cards")
    against = (
        "count the digits that --arithmetic loses compared with this arithmetic; none skips the comparison "
        "(default: %(default)s)"
    )
    add(parser, {"--against NAME": against}, default="exact")
    digits = (
        "for each statement, add the smallest number of digits that its values have in common in ten runs with random "
        "rounding"
    )
    add(parser, {"--digits": digits})
    add(
        parser,
        {"--operator =FILE": "answer ACCEPT and PAUSE from FILE, which may be a log that --log wrote"},
        type=InputFile,
    )
    add(parser, {"--commentary": "explain the blocks of statements and the variables of a program of the thesis"})
    shared.output_argument(parser)
    shared.compared_machine(parser)


def _study(parser: ArgumentParser) -> None:
    add(parser, {"name NAME": "a built-in study, or a plan file NAME.toml"}, type=InputFile, nargs="?")
    lists = {
        "--list": "list the built-in studies",
        "--families": "list the families of point sets for plan files",
        "--measures": "list the additional figures (measures) that a plan file can name",
    }
    add(parser, lists)
    counts = {
        "--samples N": "draw N point sets in each cell that does not fix its own number (default: see --list)",
        "--seed S": "draw all point sets from this seed (default: 1963)",
        "--workers W": "use W processes (default: one per processor)",
    }
    add(parser, counts, type=int)
    add(parser, {"--dask ADDRESS": "use the workers of the dask.distributed scheduler at ADDRESS"})
    add(parser, {"--out DIR": "write the study to this folder (default: the name of the study)"}, type=Folder)
    studies = {
        "--resume": "continue the unfinished study in the folder",
        "--redraw DIR": "draw the plots of the finished study in DIR again, from its charts.json",
        "--verify DIR": "compare the stored results of the study in DIR with their checksums",
        "--quiet": "show no progress",
    }
    add(parser, studies)


def _apparatus(parser: ArgumentParser) -> None:
    rows = {
        "--program N": "show only the rows of program 1, 2 or 3 (default: all)",
        "--layer L": "show only the rows of this layer (default: all)",
        "--check": "check that the OCR text and the emendations yield the decks, and that each emendation is allowed "
        "and necessary",
    }
    add(parser, rows)
    text = "with --check: compare the excerpts in this project with FILE, the whole OCR text of a document"
    add(parser, {"--text FILE": text}, type=InputFile)
    collate = (
        "compare every reading of the listings with FILE, another transcription of the listings or of a part of them"
    )
    add(parser, {"--collate FILE": collate}, type=InputFile)
    shared.json_argument(parser, "collation")
    add(parser, {"--csv FILE": "with --collate: write a table with a row for each reading"}, type=OutputFile)
    weigh = (
        "alter the tokens of the listings one at a time, and record in FOLDER the first check that detects each "
        "alteration; results already in FOLDER are kept"
    )
    add(parser, {"--weigh FOLDER": weigh}, type=Folder)
    restore = (
        "damage the listings as the OCR did, restore them by the rules of the apparatus in a process that cannot read "
        "the originals, and count the errors for each certainty of a reading; copies already in FOLDER are kept"
    )
    add(parser, {"--restore FOLDER": restore}, type=Folder)
    runs = (
        "with --weigh: also run each data deck FOLDER/SAMPLE/deck.cards; with --restore: also damage the programs in "
        "FOLDER"
    )
    add(parser, {"--runs FOLDER": runs})
    text = (
        "write a proof sheet for each page to FOLDER, as HTML, CSV and PDF, with the questions that only a reader of "
        "the page can answer"
    )
    add(parser, {"--sheets FOLDER": text}, type=Folder)
    text = "read filled sheets: write a changed copy of the edition to the folder of --state, and check it"
    add(parser, {"--sheet FILE": text}, type=InputFile, nargs="+")
    text = (
        "with --sheet: write the changed edition to FOLDER, or change the edition in FOLDER further; without --sheet: "
        "use the edition in FOLDER"
    )
    add(parser, {"--state FOLDER": text}, type=Folder)
    add(parser, {"--workers N": "with --weigh and --restore: use N processes (default: 1)"}, type=int, default=1)
    most = "with --weigh: try only the first N alterations (default: all); with --restore: make N rounds (default: 1)"
    add(parser, {"--most N": most}, type=int, default=0)


def _program(parser: ArgumentParser) -> None:
    shared.program_argument(parser, "read")
    shared.layers_argument(parser)
    shared.upcase_argument(parser)


def _compile(parser: ArgumentParser) -> None:
    _program(parser)
    add(parser, {"--object": "punch the program as an object deck for IBM's library of 1962"})
    library = "with --object: replace the program in DECK, an object deck that contains IBM's library"
    add(parser, {"--library DECK": library}, type=InputFile)
    shared.core_argument(parser)
    shared.output_argument(parser)


def _export_job(parser: ArgumentParser) -> None:
    shared.program_argument(parser, "export")
    shared.deck_argument(parser, "a file of data cards, or a deck by name, such as example5 or example5/punched")
    compiler = "write a job for FORTRAN II-D under Monitor I, or for PDQ FORTRAN"
    add(parser, {"--for": compiler}, choices=("fortran2d", "pdq"), required=True, dest="compiler")
    add(parser, {"--out DIR": "write the job to this folder"}, type=Folder, required=True)
    shared.machine_arguments(parser)
    shared.upcase_argument(parser)


def _translate(parser: ArgumentParser) -> None:
    document = "the program to translate, or a document whose formulas are written (thesis, appel-will, ...)"
    add(parser, {"program PROGRAM.f": document}, type=InputFile, nargs="?")
    shared.layers_argument(parser)
    shared.upcase_argument(parser)
    add(parser, {"--to": "write C, free-form Fortran 2018, or FPCore 2.0"}, choices=("fortran", "c", "fpcore"))
    benchmark = (
        "write a benchmark for authors of numerical tools to DIR: programs, formulas, and decks with the decisions "
        "that exact arithmetic takes"
    )
    add(parser, {"--benchmark DIR": benchmark}, type=Folder)
    shared.output_argument(parser)


def _check(parser: ArgumentParser) -> None:
    shared.program_argument(parser, "check", "?")
    add(parser, {"--explain N": "explain an error number, such as 5 or E3; the word all explains every error number"})
    shared.core_argument(parser)
    shared.layers_argument(parser)
    shared.upcase_argument(parser)


def _flowchart(parser: ArgumentParser) -> None:
    _program(parser)
    shared.output_argument(parser, "FILE.svg")
    which = parser.add_mutually_exclusive_group()
    add(which, {"--page N": "draw page N only (default: all pages in one picture)"}, type=int)
    add(which, {"--table": "write a text table of the paths between boxes instead of a picture"})
    parser.set_defaults(endings=(".svg",))


def _tei(parser: ArgumentParser) -> None:
    add(parser, {"text TEXT": "a document such as program1, chapter6 or statements-thesis"}, nargs="?")
    shared.output_argument(parser)
    which = parser.add_mutually_exclusive_group()
    add(which, {"--all FOLDER": "write every document, the schema and its TEI source (ODD) to FOLDER"}, type=Folder)
    add(which, {"--schema": "write the RELAX NG schema of the documents"})
    check = "validate TEXT, or every text, against a RELAX NG schema in XML (default: the project's own)"
    add(which, {"--check SCHEMA": check}, type=InputFile, nargs="?", const="")
    read = "write the corrected text or deck that a document contains"
    add(which, {"--read FILE.xml": read}, type=InputFile)
    readings = {
        "--layers L,...": "with --read: apply these layers of emendations",
        "--witness": "with --read: write the uncorrected OCR text",
        "--part NAME": "with --read: write only a deck such as example1/program1.deck",
    }
    add(parser, readings)
    parser.set_defaults(endings=(".xml", ".f", ".txt", ".deck", ".punch", ".typewriter", ".rng"))


def _punched(parser: ArgumentParser) -> None:
    shared.deck_argument(
        parser, "a deck with one card per line, a built-in program, or an example such as example1 or seventy/17", None
    )
    output = (
        "draw all cards in one picture, or one picture per card if the name contains a place for the card number, "
        "such as 'card-%%03d.svg' (default: '-', standard output)"
    )
    add(parser, {"-o --output FILE.svg": output}, type=OutputFile, default="-")
    add(parser, {"--across N": "draw N cards per row (default: 1)"}, type=int, default=1)
    parser.set_defaults(endings=(".svg",))


def _map(parser: ArgumentParser) -> None:
    shared.program_argument(parser, "map")
    shared.core_argument(parser)
    shared.layers_argument(parser)
    shared.upcase_argument(parser)


def _bench(parser: ArgumentParser) -> None:
    add(parser, {"--decks N": "run program 3 on N decks of 51 points (default: %(default)s)"}, type=int, default=1000)
    shared.json_argument(parser, "figures")


# Every command: its line in ``--help``, and the function that adds its arguments. The module of a command has the same
# name, with underscores for hyphens, and defines ``main(args)``, which returns the exit code.
COMMANDS: dict[str, tuple[str, Callable[[ArgumentParser], None]]] = {
    "reproduce": ("compute the printed results of the thesis and the later papers, and compare them", _reproduce),
    "run": ("run a FORTRAN program on the emulated 1620", _run),
    "hull": ("find the hull of a data deck: run program 1, then the program that it names on the typewriter", _hull),
    "cards": ("punch points as a data deck", point_arguments.cards),
    "diff": (
        "compare the hulls of the 1963 programs and of their port to Python with the exact hull",
        point_arguments.diff,
    ),
    "diverge": ("run a program in two arithmetics, and report the first value and branch that differ", _diverge),
    "digits": ("report which printed digits are significant, and which statements lose them", _digits),
    "study": (
        "find the hulls of many point sets in several ways, compare them with the exact hulls, and write a report",
        _study,
    ),
    "export": ("write the exact hull of points as a mesh or as JSON", point_arguments.export),
    "draw": ("draw the exact hull of points as SVG", point_arguments.draw),
    "appel-will": ("find the hull of a polyhedron from its convex edges, by Appel & Will", point_arguments.appel_will),
    "hidden-line": (
        "draw convex polyhedra without their hidden lines, by Nakamae & Nishita",
        point_arguments.hidden_line,
    ),
    "voxel-hull": ("find the hull of a voxel solid, by Kovalevsky & Schulz", volume_arguments.voxel_hull),
    "octree-hull": (
        "find the digital hull of a voxel solid from its octree, by Yau & Srihari",
        volume_arguments.octree_hull,
    ),
    "apparatus": ("list, check and weigh the emendations of the listings", _apparatus),
    "check": ("compile a program and show the messages, or explain error numbers", _check),
    "compile": ("print the object code of a program, or punch its object deck", _compile),
    "export-job": ("write a program and its data as a job for FORTRAN II-D or PDQ FORTRAN under SIMH", _export_job),
    "translate": ("write a program in C, modern Fortran or FPCore, or a benchmark for numerical tools", _translate),
    "map": ("print the storage map of a program", _map),
    "listing": ("list a program with run counts, times and lost digits next to each card", _listing),
    "flowchart": ("draw the flow chart of a program as SVG", _flowchart),
    "punched": ("draw a deck as punched cards, as SVG", _punched),
    "tei": ("write the edition as TEI P5, validate it, or read decks back from it", _tei),
    "bench": ("compare the speed of the engines that run the emulated programs", _bench),
}
