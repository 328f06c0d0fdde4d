"""Word the reason why a run of the thesis programs found no hull, and the first branch that exact arithmetic takes
differently.

The commands ``hull`` and ``diff`` and the page of the site on points of the reader's choice print the same sentences.
"""

from collections.abc import Sequence
from dataclasses import replace

from emulator.language.cards import deck_from_lines
from emulator.machine.comparison import Decision
from emulator.machine.divergence import diverge
from emulator.machine.machine import Machine
from emulator.machine.result import Options, Uncut
from emulator.numbers import numbers
from modern.thesis.job import HullRun
from modern.thesis.refusals import CORRECTED, Cause, Kind

_MEANINGS: dict[Kind, str] = {
    "miss": "this point defines equation {equation}, but its value there is {value} instead of 0, because {digits} do "
    "not hold the products of its coordinates",
    "centre": "calculated with {digits}, equation {equation} passes through the inside point C, so neither of its "
    "sides is the outer one",
    "zeros": "all coefficients of equation {equation} are zero, because its three points appear to lie on one line if "
    "calculated with {digits}",
    "pair": "the search for pairs of equations inside the hull ran beyond the end of the table of equations",
    "repeat": "the search for repeated equations of one plane ran beyond the end of the table of equations",
    "unmet": "no point satisfies three equations exactly, so none counts as a vertex; {digits} do not hold the "
    "equations",
    "room": "the table of equations is full",
    "endless": "the run reached the statement limit; a higher --limit helps only if the run would end",
    "stopped": "the run met a value or an address with which it could not continue",
    "other": "the program reached a state that it treats as impossible",
}
_DETAILS: dict[Kind, str] = {
    "miss": "The programs trust an equation only if the points that define it satisfy it to the last digit. The "
    "coefficients A, B, C of a plane are sums of products of two coordinates, and D of three. With {digits} they are "
    "always exact if the coordinates are integers up to 99, and often inexact if they have three digits or more. The "
    "hull may be correct, but the programs cannot confirm it. Chapter 7 of the thesis proposes a tolerance e below "
    "which a value counts as zero: layer epsilon.",
    "centre": "The programs orient every plane so that C, the mean of the first four vertices, lies on its inner side. "
    "Some planes that will be deleted a moment later contain C, and the program then types ERROR IN PROGRAM although "
    "nothing is wrong.",
    "zeros": "In exact arithmetic a new point is never collinear with two vertices of a plane that it lies outside of. "
    "The truncation of digits made these three points appear collinear.",
    "pair": "If the two deleted planes are the last of the table, the program compares entries beyond its end.",
    "repeat": "If the deleted plane is the last of the table, the program compares entries beyond its end.",
    "unmet": "The equations of the hull were found. At the end the programs count, for every point, the equations "
    "that it satisfies to the last digit; a vertex satisfies at least three. No point satisfies equations with "
    "truncated coefficients.",
    "room": "Planes are added three at a time before those inside the hull are deleted, so the table temporarily holds "
    "more planes than the hull has faces. The real machine would have overwritten the next array (--bounds core).",
    "endless": "A search that ran beyond the end of the table never ends. The same happens if rounded values decide a "
    "branch differently each time.",
    "stopped": "The program used a number that was never assigned, an element outside an array, or a value that the "
    "arithmetic cannot compare.",
    "other": "A sum, a difference or a count has a value that is impossible in exact arithmetic.",
}


def digits_of(arithmetic: str) -> str:
    """Return words such as "eight digits" for an arithmetic, as the plural subject of a sentence."""
    return "eight digits" if arithmetic == "truncating" else f"the digits of {arithmetic}"


def explanation(cause: Cause, arithmetic: str = "truncating") -> tuple[str, str, str]:
    """Return three paragraphs: the statement that decided that there is no hull, its meaning, and the background."""
    values = {"equation": cause.equation, "value": cause.value, "digits": digits_of(arithmetic)}
    decision = f"program {cause.program}"
    if cause.decision is not None:
        label = f"{cause.decision.label} " if cause.decision.label else ""
        point = f" for the point {', '.join(cause.point)}" if cause.point else ""
        decision += f", decided by card {cause.decision.place.card}, {label}{cause.decision.text}{point}"
    meaning, details = (table[cause.kind].format(**values) for table in (_MEANINGS, _DETAILS))
    if cause.fault:
        row = CORRECTED.get(cause.fault)
        correction = f"; row {row} of layer corrected corrects it" if row else ""
        meaning += f" (known fault {cause.fault})"
        details += f" See fault {cause.fault} in fortran_src/KNOWN-FAULTS.md{correction}."
    return decision, meaning, details


def first_disagreement(run: HullRun, options: Options) -> str:
    """Return a sentence on the first branch of a run, with these options, that exact arithmetic takes differently.

    In the exact run, the cards between the programs also hold all digits.  If that run cannot continue, for example
    because it divides by zero, the sentence gives the reason.
    """
    exact = replace(options, numbers=numbers("exact"), uncut=True)
    deck = run.steps[0].deck
    uncut: tuple[Sequence[Sequence[Uncut]], Sequence[Sequence[Uncut]]] = ((), ())
    for step in run.steps:
        comparison = diverge(
            step.program,
            step.deck,
            options.numbers,
            exact.numbers,
            options,
            values=False,
            reference_deck=deck,
            uncut=uncut,
        )
        if comparison.first_decision is not None:
            return _sentence(step.number, comparison.first_decision, digits_of(options.numbers.name))
        if any(ending is not None and ending.kind == "limit" for ending in comparison.endings):
            return "every decision up to the statement limit is the same in exact arithmetic"
        if comparison.apart:
            return f"program {step.number}: the comparison with exact arithmetic ended early: {comparison.apart}"
        if step is not run.final:
            # Both runs took the same branches, so that the exact run also ends with the cards for the second program.
            result = Machine(step.program, deck, exact).run(keep=True)
            deck = deck_from_lines(f"cards from {step.name}", result.punched)
            uncut = (step.result.uncut, result.uncut)
    return "every decision is the same in exact arithmetic"


def _sentence(program: int, decision: Decision, digits: str) -> str:
    label = f"{decision.line.label} " if decision.line.label else ""
    statement = f"program {program}, card {decision.line.place.card}, {label}{decision.line.text}"
    rounded, exact = (
        f"the value is {value} and the program goes to {target.name if target else 'the end'}"
        for value, target in zip(decision.values, decision.targets, strict=True)
    )
    difference = f"{statement}; with {digits} {rounded}, exactly {exact}"
    return f"the first branch that exact arithmetic takes differently: {difference}"
