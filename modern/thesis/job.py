"""A hull from cards to cards: program 1, then program 2 or 3 as the typewriter says (thesis p. 59)."""

from __future__ import annotations

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

Load = Callable[[str], Program]
"""Gives a program compiled, by name."""
Watch = Callable[[Program, Machine], None]
"""Sees each machine before it runs."""


@dataclass(frozen=True, slots=True)
class Step:
    """One program's run within a hull run: its built-in's name, its number in the thesis, and the deck it read."""

    name: str
    number: int
    program: Program
    deck: Deck
    result: Result


@dataclass(frozen=True, slots=True)
class HullRun:
    """The steps of one data set, in order; the last one's punched cards are the final cards."""

    steps: tuple[Step, ...]

    @property
    def final(self) -> Step:
        return self.steps[-1]

    @property
    def refusal(self) -> str:
        """DATA NOT ACCEPTABLE or ERROR IN PROGRAM where a program stopped at it, else empty."""
        return next((r for r in (refusal(step.result) for step in self.steps) if r), "")

    @property
    def complete(self) -> bool:
        return not self.refusal and all(step.result.ending.normal for step in self.steps)


class Refusals:
    """Whether a run stopped at a refusal, from its events as they come."""

    def __init__(self) -> None:
        self._last = self._stopped = ""

    def see(self, events: Iterable[Event]) -> None:
        """Take further events, in order."""
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
        """The refusal typed with no card punched between it and the next data set or the end; else empty."""
        return self._stopped or self._last


def refusal(result: Result) -> str:
    """The refusal a run stopped at, from the events its result holds; else empty."""
    seen = Refusals()
    seen.see(result.events)
    return seen.stopped


def second_program(result: Result) -> int | None:
    """The program that takes the cards of this run of program 1, 2 or 3; None where none does."""
    second = 2 if COPLANAR in result.typed else 3 if NOT_COPLANAR in result.typed else None
    return second if result.ending.normal and not refusal(result) else None


def punched_deck(step: Step) -> Deck:
    """The cards a step punched, as the next program reads them."""
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
    """Run one data set through program 1 and the program its typewriter names.

    With ``options.uncut`` numbers go from program 1 to the next whole, not as the card's digits.  ``first`` is the
    built-in that plays program 1; ``watch`` sees each machine before it runs, ``operator`` serves them all and
    ``output`` sees all events.  Raises what :meth:`emulator.machine.machine.Machine.run` raises.
    """
    options = options or Options()

    def ran(name: str, number: int, deck: Deck, uncut: Sequence[Sequence[Uncut]] = ()) -> Step:
        program = load(name)
        machine = Machine(program, deck, options, uncut=uncut)
        if watch is not None:
            watch(program, machine)
        return Step(name, number, program, deck, machine.run(operator, output, keep=True))

    steps = [ran(first, 1, deck)]
    second = second_program(steps[0].result)
    if second is not None:
        steps.append(ran(f"program{second}", second, punched_deck(steps[0]), steps[0].result.uncut))
    return HullRun(tuple(steps))
