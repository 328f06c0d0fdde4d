"""``hull1620 export-job``: write a program and its data as a job for a compiler of the 1960s, run in SIMH."""

import argparse
from dataclasses import replace
from importlib.resources import files

from emulator.language.cards import Deck
from emulator.language.compiler import compile_deck
from emulator.language.parser import parse
from emulator.machine.machine import Machine
from emulator.objectdeck.job import Change, Job, job
from modern.cli.shared.console import OK, UsageError, counted, print_notes, write_folder
from modern.cli.shared.inputs import deck_of
from modern.cli.shared.programs import machine_options, source_deck

_NEEDED = {
    "fortran2d": """\
monitor.pack
    the disk of Monitor I as text: the file 1620-Monitor-I-No-FP-Image.pack in the
    archive of the same name, folder software/monitor of the public repository
    pkimpel/retro-1620
""",
    "pdq": """\
pdq.txt, pdq-fixed.txt
    the compiler and its subroutines: two files of the public repository
    mdoege/Py1620
""",
}
_README = """\
A job for {title}

This folder holds {source} as cards, and the cards that hull1620 punches for it.
The job compiles and runs the program with the compiler of the time, in the 1620
simulator of SIMH, and compares the punched cards. No code of hull1620 takes part.

1. Build the simulator i1620 of Open SIMH (github.com/open-simh/simh). Do not use
   version 3.8-1: a fault in its comparison spoils sums.
2. Put these files into this folder; they are not part of this project:
{needed}
3. Run in this folder:  i1620 job.ini
   The script needs Python 3 as the command python3. Its last lines list the
   differences by class. To repeat only the comparison, run
   python3 check.py compare expected.cards punched.cards

Cards that differ from the program as listed:
{changes}
"""
_TITLES = {"fortran2d": "IBM FORTRAN II-D under Monitor I", "pdq": "PDQ FORTRAN"}


def main(args: argparse.Namespace) -> int:
    deck = source_deck(args)
    program, data = compile_deck(deck), Deck(deck.source, parse(deck).data)
    if args.deck and data.cards:
        raise UsageError(f"{deck.source}: the cards after END are data; remove them if the job should read {args.deck}")
    if args.deck:
        data = _data(args.deck)
    exported = job(deck, program, data, args.compiler)
    result = Machine(program, data, replace(machine_options(args), hopper="any")).run()
    if not result.punched:
        print_notes([f"note: {deck.source}: the program punches no cards, so the job cannot compare any"])
    write_folder(args.out, folder_of(exported, deck.source, result.punched, args.switch))
    cards = f"{len(exported.source)} cards of the program, {len(exported.data)} of data"
    changes = counted(len(exported.changes), "change")
    print(f"{args.out}: {cards}, {changes} for the old compiler; README.txt says how to run the job")
    return OK


def folder_of(exported: Job, source: str, punched: tuple[str, ...], switches: list[int]) -> dict[str, str]:
    """Return the texts of the files of a job, by file name."""
    decks = {"job.cards": tuple(exported.cards())}
    if exported.compiler == "pdq":
        decks = {"program.cards": exported.source, "data.cards": exported.data}
    decks["expected.cards"] = punched
    readme = _README.format(
        title=_TITLES[exported.compiler],
        source=source,
        needed=_NEEDED[exported.compiler].rstrip(),
        changes="\n".join(_change(change) for change in exported.changes) or "none",
    )
    check = files("emulator.objectdeck").joinpath("check_job.py").read_text(encoding="utf-8")
    cards = {name: "".join(f"{card}\n" for card in deck) for name, deck in decks.items()}
    return {**cards, "job.ini": exported.script(switches), "check.py": check, "README.txt": readme}


def _change(change: Change) -> str:
    place = f"card {change.card}" if change.card else "added cards"
    return "\n".join([f"- {place}: {change.reason}", *(f"    {text}" for text in change.texts)])


def _data(name: str) -> Deck:
    """Return the deck of a file, of an example, or of a name such as ``example4/punched``.

    Raise EmulatorError if the deck cannot be read.
    """
    from modern.publication.decks import named_deck

    try:
        return named_deck(name)
    except ValueError:
        return deck_of(name)
