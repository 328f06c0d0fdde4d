"""Run object decks of the project's programs on IBM's library of 1962, and compare the output with the emulator's."""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import zip_longest
from pathlib import Path

from emulator.errors import DeckError
from emulator.language.cards import Deck, deck_from_lines, read_deck
from emulator.language.compiler import compile_deck
from emulator.language.objectcode import PAUSE, Program
from emulator.language.statements import capitals
from emulator.language.storage import OBJECT_PROGRAM
from emulator.machine.machine import Machine
from emulator.machine.operator import FromFile
from emulator.machine.result import Options, Result
from emulator.machine.words import read_action
from emulator.numbers import numbers
from emulator.objectdeck.cards import END_OF_CODE, object_cards, with_library
from emulator.objectdeck.digits import card_text
from emulator.objectdeck.generator import generate
from modern.bench.ibm1962.simulator import Failed, Job, Run, Unavailable, object_deck, run, run_jobs
from modern.edition import programs
from modern.edition.chapter6 import EXAMPLES, input_deck
from modern.thesis.job import run_hull

CORE = 40_000
SECONDS = 120.0
# Columns 78 to 80 of a punched card hold its number.
COLUMNS = 72
OPTIONS = Options(numbers("ibm1962"), core=CORE, bounds="core", hopper="any", limit=200_000)
COUNTEREXAMPLES = "transcripts/counterexamples"
FOLDERS = ("tests/data/period", "tests/data/programs", "tests/data/compiler_runs")

# An address in core storage that neither the library nor a program uses once the deck is loaded.
_HALT_AT = 60

_PROBE = [
    "      A=35.",
    "      B=3.",
    "      C=A-B",
    "      PUNCH 1,C",
    "    1 FORMAT(E14.8)",
    "      STOP",
    "      END",
]


@dataclass(frozen=True, slots=True)
class Comparison:
    """The cards and the typed lines of a program on IBM's library and on the emulator, or the message of an error.

    Blanks at the ends of cards and lines are removed.
    """

    name: str
    library: tuple[tuple[str, ...], tuple[str, ...]] = ((), ())
    emulator: tuple[tuple[str, ...], tuple[str, ...]] = ((), ())
    error: str = ""

    def differences(self) -> Iterator[tuple[str, str]]:
        """Yield a pair for each difference: the card or line of the library, and the one of the emulator."""
        for library, emulator in zip(self.library, self.emulator, strict=True):
            yield from ((a, b) for a, b in zip_longest(library, emulator, fillvalue="") if a != b)


@cache
def library() -> tuple[str, ...]:
    """Return the cards of IBM's object deck, which contains the library.

    Raise Unavailable if the deck or a suitable simulator is missing.  A version of SIMH from before 2015 is unsuitable:
    its compare instruction sets the overflow indicator, which the library's addition tests.
    """
    cards = tuple(object_deck())
    punched = run(_complete(compile_deck(deck_from_lines("probe.f", _PROBE)), cards)).punched
    if [card[:14] for card in punched] != [" .32000000E+02"]:
        raise Unavailable("this simulator subtracts 3. from 35. wrongly; install SIMH of 2015 or later, and set I1620")
    return cards


def _complete(program: Program, cards: Sequence[str], core: int = 20_000) -> list[str]:
    return with_library(object_cards(program, core), cards, "OBJECT_DECK")


def execute(
    program: Program, cards: Sequence[str], keys: Sequence[str] = (), starts: Sequence[Collection[int]] = ()
) -> Run:
    """Run the object deck of a program on IBM's library, with data cards, typed lines and switches at each START.

    Raise Failed if the run does not finish, Unavailable if library or simulator is missing, and EmulatorError if the
    program cannot become an object deck.
    """
    deck = _complete(program, library(), CORE)
    return run(deck, core=CORE, cards=cards, keys=keys, starts=starts, seconds=SECONDS)


def punched(result: Run | Result) -> tuple[str, ...]:
    """Return the punched cards of a run without their sequence numbers."""
    return tuple(card[:COLUMNS].rstrip() for card in result.punched)


def answers(operator: str) -> tuple[list[str], list[str], list[Collection[int]]]:
    """Return the operator's actions that the simulator can perform, the typed lines, and the switches at each START.

    The simulator cannot be interrupted while it waits for a typed line, so switches are set only at a PAUSE.
    """
    actions: list[str] = []
    keys: list[str] = []
    starts: list[Collection[int]] = []
    on: set[int] = set()
    settings: list[str] = []
    for line in operator.splitlines():
        if not line.strip() or line.startswith("*"):
            continue
        action = read_action(line)[1]
        if action.word == "SWITCH":
            settings.append(line)
            continue
        if action.word == "START":
            for setting in settings:
                switch = read_action(setting)[1]
                on = on | {switch.number} if switch.on else on - {switch.number}
            actions += settings
            starts.append(on)
        else:
            keys.append(action.text)
        actions.append(line)
        settings = []
    return actions, keys, starts


def compare(name: str, program: Program, deck: Deck, operator: str = "") -> Comparison:
    """Run a program on IBM's library and on the emulator with the arithmetic ``ibm1962``, and return both outputs.

    ``operator`` is the text of a file of the operator's actions. The lines that the operator types are compared too.
    """
    actions, keys, starts = answers(operator)
    starts = starts or [()] * sum(instruction.operation == PAUSE for instruction in program.code)
    result = Machine(program, deck, OPTIONS).run(FromFile(name, "\n".join(actions)))
    try:
        executed = execute(program, [card.text for card in deck.cards], keys, starts)
    except (DeckError, Failed) as error:
        return Comparison(name, error=str(error))
    lines = tuple(line.rstrip() for line in executed.typed)
    typed = tuple(e.text.rstrip() for e in result.events if e.what in ("type", "accept") and e.text.strip())
    return Comparison(name, (punched(executed), lines), (punched(result), typed))


def subjects() -> Iterator[tuple[str, Program, Deck, str]]:
    """Yield the programs to compare: for each, its name, the program, an input deck, and its operator's actions."""
    decks = {f"example {example}": input_deck(example) for example in EXAMPLES}
    decks |= {path.name: read_deck(str(path)) for path in sorted(Path(COUNTEREXAMPLES).glob("*.deck"))}
    for first in ("program1_examples", "program1"):
        for title, deck in decks.items():
            for step in run_hull(deck, programs.program, OPTIONS, first).steps:
                # Program 3 does not end if its table of planes is too short (KNOWN-FAULTS).
                if step.result.ending.kind == "limit":
                    continue
                yield f"{title}, {step.name} after {first}", step.program, step.deck, ""
    for path in sorted(path for folder in FOLDERS for path in Path(folder).glob("*.f")):
        data = path.with_suffix(".deck")
        program = compile_deck(read_deck(str(path), capitals))
        operator = path.with_suffix(".operator")
        if data.exists() or not program.uses("READ"):
            actions = operator.read_text(encoding="ascii") if operator.exists() else ""
            yield path.name, program, read_deck(str(data)) if data.exists() else Deck("no deck", ()), actions


def against_deck(source: Program, cards: Sequence[str]) -> tuple[int, int, int]:
    """Compare the object code and the symbol table of a program with those of the program in IBM's object deck.

    Return the number of positions of the object code, the number of positions that differ, and the number of cards of
    the symbol table that differ.
    """
    made = generate(source, 20_000)
    # The loader fills core storage, and the simulator then executes a halt.
    job = Job(_HALT_AT, {_HALT_AT: [4, 8, *[0] * 10]}, examine=[(OBJECT_PROGRAM, made.end - 1)])
    core = run_jobs(cards, [job])[0].core
    different = sum(
        card_text([core[unit.at + offset]]) != digit for unit in made.units for offset, digit in enumerate(unit.digits)
    )
    mine = object_cards(source, 20_000)
    table = mine[mine.index(END_OF_CODE) + 1 :]
    first = next(index for index, card in enumerate(cards) if card.startswith(END_OF_CODE)) + 1
    pairs = zip(table, cards[first : first + len(table)], strict=True)
    return made.end - OBJECT_PROGRAM, different, sum(card != of_deck[:COLUMNS].rstrip() for card, of_deck in pairs)
