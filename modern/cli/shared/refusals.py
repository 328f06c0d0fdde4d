"""Why a hull run came to no hull, in words: what decided, what it means, and what to try."""

from __future__ import annotations

import shlex
import textwrap
from collections.abc import Iterator
from dataclasses import dataclass

from modern.thesis.refusals import CORRECTED, Cause, Kind

_MEANS: dict[Kind, str] = {
    "miss": "this point is one of those that equation {equation} was made from, and gives {value} in it instead "
    "of 0: {digits} do not hold the products of its coordinates",
    "centre": "equation {equation} passes through the point C in these digits, so that no side of it is outside",
    "zeros": "equation {equation} is all zeros: its three points lie on one line in these digits",
    "pair": "the search for pairs of equations inside the hull ran beyond the end of the table",
    "repeat": "the search for repeated equations of one plane ran beyond the end of the table",
    "unmet": "no point satisfies three equations exactly, so that none counts as a vertex: {digits} do not hold them",
    "room": "the table of equations has no more places",
    "endless": "the statement limit ended it; more statements (--limit) help only a run that goes on",
    "stopped": "the run met a value or a place it could not go on with",
    "other": "the program takes it for impossible",
}
_LONGER: dict[Kind, str] = {
    "miss": "The programs ask of every equation that the points it was made from satisfy it, to the last digit, "
    "before they trust it. The coefficients A, B, C of a plane are sums of products of two coordinates, D "
    "of three. In {digits} that is exact for coordinates of two or three digits, of more it is not: the "
    "hull may be there, but the programs do not vouch for it. Chapter 7 of the thesis proposes an "
    "interval e within which a value counts as zero: layer epsilon.",
    "centre": "A plane is turned so that C, the mean of the first four vertices, lies on its inner side. Of planes "
    "that will be struck a moment later some contain C, and the program types ERROR IN PROGRAM although "
    "nothing is wrong.",
    "zeros": "In exact numbers a new point is never in line with two vertices whose plane it lies outside of; the "
    "digits that were cut made it so.",
    "pair": "When the two planes struck are the last of the table, the program compares with entries beyond the end.",
    "repeat": "When the plane struck is the last of the table, the program compares with entries beyond the end.",
    "unmet": "The equations of the hull were found, and at the end the programs count, for every point, how many "
    "of them it satisfies to the last digit; a vertex lies on three at least. Coefficients that were cut "
    "are satisfied by none.",
    "room": "Planes are added three at a time before those inside are struck, so that more places are needed for "
    "a while than the hull has faces. The machine would have overwritten the next array (--bounds core).",
    "endless": "A search that ran beyond the end of the table never comes to an end; so does a rounded value that "
    "decides now one way and now the other.",
    "stopped": "What a program asked for was not there: a number never given, an element beyond an array, a value "
    "that the arithmetic cannot decide.",
    "other": "A sum, a difference or a count came out as it cannot in exact numbers.",
}


@dataclass(frozen=True, slots=True)
class Asked:
    """What was asked for, from which the commands to try are made.

    deck: the name of the deck; points: of the file it is to be made from, empty where it is there.  epsilon: chapter
    7's e, empty where none was given.
    """

    deck: str
    points: str = ""
    layers: tuple[str, ...] = ()
    arithmetic: str = "truncating"
    epsilon: str = ""
    uncut: bool = False
    explain: bool = False


def lines(cause: Cause, asked: Asked) -> Iterator[str]:
    """What is said of a run that came to no hull, in lines of 100 columns where they are no command."""
    digits = "eight digits" if asked.arithmetic == "truncating" else f"the digits of {asked.arithmetic}"
    values = {"equation": cause.equation, "value": cause.value, "digits": digits}
    words = [f"program {cause.program}"]
    if cause.decision is not None:
        label = f"{cause.decision.label} " if cause.decision.label else ""
        at = f" at the point {', '.join(cause.point)}" if cause.point else ""
        words.append(f"card {cause.decision.place.card}, {label}{cause.decision.text}, decided{at}")
    yield from _wrapped(f"no hull: {', '.join(words)}", "")
    known = f" (known fault {cause.fault})" if cause.fault else ""
    yield from _wrapped(_MEANS[cause.kind].format(**values) + known, "  ")
    if asked.explain:
        yield from _wrapped(_LONGER[cause.kind].format(**values), "  ")
        if cause.fault:
            row = f"; row {CORRECTED[cause.fault]} of layer corrected corrects it" if cause.fault in CORRECTED else ""
            yield from _wrapped(f"fortran_src/KNOWN-FAULTS.md has it under {cause.fault}{row}.", "  ")
    for k, (command, why) in enumerate(_tries(cause, asked)):
        yield f"  {'    ' if k else 'try:'} {command}"
        if asked.explain:
            yield from _wrapped(why, "         ")
    if not asked.explain:
        yield "  --explain says more"


def _tries(cause: Cause, asked: Asked) -> Iterator[tuple[str, str]]:
    """Commands that help further, and what each is for."""
    deck, corrected = shlex.quote(asked.deck), "corrected" in asked.layers
    if asked.points:
        yield f"hull1620 cards {shlex.quote(asked.points)} -o {deck}", "The deck that the next commands take."
    if cause.fault in CORRECTED and not corrected:
        yield _again(asked, "corrected"), "The programs with what is known to be wrong in them corrected."
    if not (asked.arithmetic == "exact" and asked.uncut and corrected):
        yield (
            f"{_again(asked, 'corrected', 'exact')} --uncut",
            "The same programs where no digit is lost, neither in a number nor on the cards between two programs.",
        )
    if cause.kind in ("miss", "unmet") and not asked.epsilon and "epsilon" not in asked.layers:
        yield (
            f"{_again(asked, 'corrected', asked.arithmetic)} --epsilon .001",
            "Chapter 7's interval: what lies within .001 of zero counts as zero. Which e is right, your data say.",
        )
    if asked.arithmetic != "exact" and asked.layers == ():
        first = "" if cause.program == 1 else f"hull1620 run program1 {deck} --punch program1.cards && "
        yield (
            f"{first}hull1620 diverge program{cause.program} {'program1.cards' if first else deck}",
            "Where these digits first decide otherwise than exact numbers, in the program that stopped.",
        )
    yield f"hull1620 export {deck} -o hull.off", "The true hull of these points, as a file for other programs."


def _again(asked: Asked, layer: str, arithmetic: str = "") -> str:
    """The command with a layer more, and with another arithmetic."""
    layers = ",".join(dict.fromkeys((layer, *asked.layers)))
    name = arithmetic or asked.arithmetic
    words = f"hull1620 hull {shlex.quote(asked.deck)} --layers {layers} --core 60000"
    words += f" --epsilon {asked.epsilon}" if asked.epsilon else ""
    return words + (f" --arithmetic {name}" if name != "truncating" else "")


def _wrapped(text: str, lead: str) -> list[str]:
    return textwrap.wrap(text, 100, initial_indent=lead, subsequent_indent=lead + "  ", break_on_hyphens=False)
