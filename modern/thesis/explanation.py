"""Explain in sentences why a run found no hull, and at which decision exact arithmetic first takes another branch.

The commands ``hull`` and ``diff``, and the page of the site on which readers enter points, print the same sentences.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import cache

from emulator.language.cards import deck_from_lines
from emulator.machine.comparison import Decision
from emulator.machine.divergence import diverge
from emulator.machine.machine import Machine
from emulator.machine.result import Options, Uncut
from emulator.numbers import numbers
from modern.thesis.job import HullRun
from modern.thesis.refusals import CORRECTED, Cause


@cache
def _texts() -> dict[str, dict[str, str]]:
    import tomllib  # not at the top, because only explanations need them
    from importlib.resources import files

    source = files("modern.thesis").joinpath("explanations.toml").read_text(encoding="utf-8")
    return tomllib.loads(source)


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
    texts = _texts()[cause.kind]
    meaning, details = texts["meaning"].format(**values), texts["details"].format(**values)
    if cause.fault:
        row = CORRECTED.get(cause.fault)
        correction = f"; row {row} of layer corrected corrects it" if row else ""
        meaning += f" (known fault {cause.fault})"
        details += f" See fault {cause.fault} in fortran_src/KNOWN-FAULTS.md{correction}."
    return decision, meaning, details


def first_disagreement(run: HullRun, options: Options) -> str:
    """Return a sentence on the first decision of a run at which exact arithmetic takes another branch.

    ``options`` are those of the run.

    In the exact run, numbers keep all their digits when one program passes them to the next on cards.  If the exact run
    cannot continue, for example because it divides by zero, the sentence gives the reason.
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
