"""Run the hull programs on a data deck: program 1, then program 2 or 3, as program 1 requests (thesis p. 59)."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from emulator.language.cards import Deck, deck_from_lines
from emulator.language.objectcode import Program
from emulator.machine.machine import Machine
from emulator.machine.operator import Operator, Output
from emulator.machine.result import Event, Options, Result, Uncut

COPLANAR = "POINTS ARE COPLANAR"
NOT_COPLANAR = "POINTS ARE NOT COPLANAR"
REFUSALS = ("DATA NOT ACCEPTABLE", "ERROR IN PROGRAM")

# A function that returns a compiled program by name.
Load = Callable[[str], Program]
# A function that is called with each machine before it runs.
Watch = Callable[[Program, Machine], None]


@dataclass(frozen=True, slots=True, repr=False)
class Step:
    """The run of one hull program: its name, its number in the thesis, the deck that it read, and the result."""

    name: str
    number: int
    program: Program
    deck: Deck
    result: Result

    def __repr__(self) -> str:
        return f"<step: {self.name}, {len(self.deck.cards)} cards read, {len(self.result.punched)} cards punched>"


@dataclass(frozen=True, slots=True, repr=False)
class HullRun:
    """The runs of the programs for one data set, in order.  The last program punched the cards with the hull."""

    steps: tuple[Step, ...]

    @property
    def final(self) -> Step:
        return self.steps[-1]

    @property
    def typed_refusal(self) -> str:
        """The message DATA NOT ACCEPTABLE or ERROR IN PROGRAM if a program stopped with it, otherwise an empty text."""
        return next(filter(None, (refusal(step.result) for step in self.steps)), "")

    @property
    def refusal(self) -> str:
        """The reason why there is no hull: the typed message or the ending of the run.  Empty if there is a hull."""
        endings = (step.result.ending for step in self.steps)
        return self.typed_refusal or next((ending.message for ending in endings if not ending.normal), "")

    @property
    def complete(self) -> bool:
        return not self.refusal

    def __repr__(self) -> str:
        names = " and ".join(step.name for step in self.steps)
        return f"<hull run: {names}, {len(self.final.result.punched)} cards punched; {self.refusal or 'complete'}>"


class Refusals:
    """A detector of the typed messages with which a program rejects its data, among the events of a run."""

    def __init__(self) -> None:
        self._last = self._stopped = ""

    def see(self, events: Iterable[Event]) -> None:
        """Examine further events of the run, in order."""
        for event in events:
            if self._stopped:
                return
            if event.what == "type" and event.text in REFUSALS:
                self._last = event.text
            elif event.what == "punch":
                self._last = ""
            elif event.what == "begin":
                self._stopped = self._last

    @property
    def stopped(self) -> str:
        """The message that rejected the data set if no card was punched for it afterwards, otherwise an empty text."""
        return self._stopped or self._last


def refusal(result: Result) -> str:
    """Return the message with which a run rejected its data and stopped, or an empty text."""
    refusals = Refusals()
    refusals.see(result.events)
    return refusals.stopped


def second_program(result: Result) -> int | None:
    """Return the number (2 or 3) of the program that reads the cards of this run of program 1, or None."""
    second = 2 if COPLANAR in result.typed else 3 if NOT_COPLANAR in result.typed else None
    return second if result.ending.normal and not refusal(result) else None


def punched_deck(step: Step) -> Deck:
    """Return the cards that a program punched, as a deck for the next program."""
    return deck_from_lines(f"cards from {step.name}", step.result.punched)


def run_hull(
    deck: Deck,
    load: Load,
    options: Options | None = None,
    first: str = "program1",
    watch: Watch | None = None,
    operator: Operator | None = None,
    output: Output | None = None,
) -> HullRun:
    """Run program 1 on one data set, and then program 2 or 3, as program 1 requests on the typewriter.

    With ``options.uncut`` the second program reads the numbers of program 1 with all digits, not only those on cards.
    ``first`` names the built-in program that is used as program 1.  ``watch`` is called with each machine before it
    runs, ``operator`` operates all machines, and ``output`` receives all events.  Raise the errors of
    :meth:`emulator.machine.machine.Machine.run`.
    """
    options = options or Options()

    def run_program(name: str, number: int, deck: Deck, uncut: Sequence[Sequence[Uncut]] = ()) -> Step:
        program = load(name)
        machine = Machine(program, deck, options, uncut=uncut)
        if watch is not None:
            watch(program, machine)
        return Step(name, number, program, deck, machine.run(operator, output, keep=True))

    steps = [run_program(first, 1, deck)]
    second = second_program(steps[0].result)
    if second is not None:
        steps.append(run_program(f"program{second}", second, punched_deck(steps[0]), steps[0].result.uncut))
    return HullRun(tuple(steps))
