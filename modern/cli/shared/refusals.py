"""Explain why a run of the thesis programs gave no hull: the deciding statement, its meaning, and commands to try."""

from __future__ import annotations

import shlex
import textwrap
from collections.abc import Iterator
from dataclasses import dataclass

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
    "exact if the coordinates have two or three digits, but not if they have more. The hull may be correct, but the "
    "programs cannot confirm it. Chapter 7 of the thesis proposes a tolerance e below which a value counts as zero: "
    "layer epsilon.",
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


@dataclass(frozen=True, slots=True)
class Request:
    """The options of the command that gave no hull, from which the commands to try are made.

    deck: the name of the deck.  points: the file from which the deck is to be made; empty if the deck exists.
    epsilon: the tolerance e of chapter 7, or empty.
    """

    deck: str
    points: str = ""
    layers: tuple[str, ...] = ()
    arithmetic: str = "truncating"
    epsilon: str = ""
    uncut: bool = False
    explain: bool = False


def refusal_lines(cause: Cause, request: Request) -> Iterator[str]:
    """Yield the explanation of a run without a hull, wrapped to 100 columns except for the commands."""
    digits = "eight digits" if request.arithmetic == "truncating" else f"the digits of {request.arithmetic}"
    values = {"equation": cause.equation, "value": cause.value, "digits": digits}
    decision = f"program {cause.program}"
    if cause.decision is not None:
        label = f"{cause.decision.label} " if cause.decision.label else ""
        point = f" for the point {', '.join(cause.point)}" if cause.point else ""
        decision += f", decided by card {cause.decision.place.card}, {label}{cause.decision.text}{point}"
    yield from _wrapped(f"no hull: {decision}", "")
    fault = f" (known fault {cause.fault})" if cause.fault else ""
    yield from _wrapped(_MEANINGS[cause.kind].format(**values) + fault, "  ")
    if request.explain:
        yield from _wrapped(_DETAILS[cause.kind].format(**values), "  ")
        if cause.fault:
            row = CORRECTED.get(cause.fault)
            correction = f"; row {row} of layer corrected corrects it" if row else ""
            yield from _wrapped(f"See fault {cause.fault} in fortran_src/KNOWN-FAULTS.md{correction}.", "  ")
    for number, (command, reason) in enumerate(_commands_to_try(cause, request)):
        yield f"  {'    ' if number else 'try:'} {command}"
        if request.explain:
            yield from _wrapped(reason, "         ")
    if not request.explain:
        yield "  for details add --explain"


def _commands_to_try(cause: Cause, request: Request) -> Iterator[tuple[str, str]]:
    """Yield commands that may help, each with its purpose."""
    deck, is_corrected = shlex.quote(request.deck), "corrected" in request.layers
    if request.points:
        yield f"hull1620 cards {shlex.quote(request.points)} -o {deck}", "Make the deck for the next commands."
    if cause.fault in CORRECTED and not is_corrected:
        yield _with_layer(request, "corrected"), "Run the programs with their known faults corrected."
    if not (request.arithmetic == "exact" and request.uncut and is_corrected):
        yield (
            f"{_with_layer(request, 'corrected', 'exact')} --uncut",
            "Run the same programs without losing digits, neither in numbers nor on the cards between the programs.",
        )
    if cause.kind in ("miss", "unmet") and not request.epsilon and "epsilon" not in request.layers:
        yield (
            f"{_with_layer(request, 'corrected', request.arithmetic)} --epsilon .001",
            "Use the tolerance of chapter 7: a value within .001 of zero counts as zero. Choose e to suit your data.",
        )
    if request.arithmetic != "exact" and request.layers == ():
        first = "" if cause.program == 1 else f"hull1620 run program1 {deck} --punch program1.cards && "
        yield (
            f"{first}hull1620 diverge program{cause.program} {'program1.cards' if first else deck}",
            "Find the first decision of the stopped program on which these digits and exact arithmetic disagree.",
        )
    yield f"hull1620 export {deck} -o hull.off", "Write the exact hull of these points to a file for other programs."


def _with_layer(request: Request, layer: str, arithmetic: str = "") -> str:
    """Return the command with one more layer, and with another arithmetic if one is named."""
    layers = ",".join(dict.fromkeys((layer, *request.layers)))
    name = arithmetic or request.arithmetic
    command = f"hull1620 hull {shlex.quote(request.deck)} --layers {layers} --core 60000"
    command += f" --epsilon {request.epsilon}" if request.epsilon else ""
    return command + (f" --arithmetic {name}" if name != "truncating" else "")


def _wrapped(text: str, lead: str) -> list[str]:
    return textwrap.wrap(text, 100, initial_indent=lead, subsequent_indent=lead + "  ", break_on_hyphens=False)
