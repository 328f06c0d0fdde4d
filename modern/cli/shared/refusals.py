"""Explain why a run of the thesis programs gave no hull: the deciding statement, its meaning, and commands to try."""

import shlex
import textwrap
from collections.abc import Iterator
from dataclasses import dataclass

from modern.thesis.refusals import CORRECTED, Cause


@dataclass(frozen=True, slots=True)
class Request:
    """The options of the command that gave no hull; the suggested commands repeat them.

    deck: the name of the deck.  points: the file from which the user must first make the deck, or empty if the deck
    exists.  epsilon: the tolerance e of chapter 7, or empty.
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
    from modern.thesis.explanation import explanation  # imported here because it imports mpmath

    decision, meaning, details = explanation(cause, request.arithmetic)
    yield from wrapped(f"no hull: {decision}")
    yield from wrapped(meaning, "  ")
    if request.explain:
        yield from wrapped(details, "  ")
    for number, (command, reason) in enumerate(_commands_to_try(cause, request)):
        yield f"  {'    ' if number else 'try:'} {command}"
        if request.explain:
            yield from wrapped(reason, "         ")
    if not request.explain:
        yield "  for details add --explain"


def _commands_to_try(cause: Cause, request: Request) -> Iterator[tuple[str, str]]:
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
            "Find the first decision of the stopped program on which its arithmetic and exact arithmetic disagree.",
        )
    yield f"hull1620 export {deck} -o hull.off", "Write the exact hull of these points to a file for other programs."


def _with_layer(request: Request, layer: str, arithmetic: str = "") -> str:
    """Return the command ``hull1620 hull`` of the request with one more layer, and with ``arithmetic`` if given."""
    layers = ",".join(dict.fromkeys((layer, *request.layers)))
    name = arithmetic or request.arithmetic
    command = f"hull1620 hull {shlex.quote(request.deck)} --layers {layers} --core 60000"
    command += f" --epsilon {request.epsilon}" if request.epsilon else ""
    return command + (f" --arithmetic {name}" if name != "truncating" else "")


def wrapped(text: str, lead: str = "") -> list[str]:
    """Return a text broken into lines of at most 100 columns, each with the text ``lead`` in front."""
    return textwrap.wrap(text, 100, initial_indent=lead, subsequent_indent=lead + "  ", break_on_hyphens=False)
