"""Checks of the listings: comments that mark the steps, and the layer with the translation of chapter 7."""

from fractions import Fraction

from emulator.errors import DeckError
from emulator.machine.result import Options
from modern.claims.evidence import Check, claim, exhibited
from modern.edition import programs
from modern.formats.deck import data_deck
from modern.thesis.cards import read_hull
from modern.thesis.job import run_hull

# Words of the comment cards that mark the steps, in their order.
_STEPS = {
    "program2": ("INSIDE POINTS", "SUPPORTING LINES", "ARE NOT VERTICES", "WERE VERTICES", "MORE THAN ONE EQUATION"),
    "program3": ("INSIDE POINTS", "SUPPORTING PLANES", "INSIDE PLANES", "NOT VERTICES", "MORE THAN ONE EQUATION"),
}


@claim("thesis.261", name="program2")
@claim("thesis.262", name="program3")
def comments_of_steps(name: str) -> Check:
    """Check that the comments of a program mark its steps in the order of chapter 3."""
    comments = [card.text for card in programs.deck(name).cards if card.text.startswith("C") and "ING " in card.text]
    comments += [card.text for card in programs.deck(name).cards if "BUT ARE" in card.text]
    marked = [any(words in comment for comment in comments) for words in _STEPS[name]]
    return exhibited(all(marked), f"{len(marked)} steps of {name} are marked by comments")


@claim("thesis.194")
def storage_of_translation() -> Check:
    """Check that program 3 with the translation does not fit 40,000 positions; as listed it does."""
    deck = data_deck([["0", "0", "0"], ["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]], "four")
    fits = run_hull(deck, programs.program, Options()).final.name == "program3"
    try:
        run_hull(deck, programs.loader(("translation",)), Options())
    except DeckError as error:
        return exhibited(fits and "OVERLAP" in str(error), f"with the translation: {error}")
    return exhibited(False, "the programs with the translation fit 40,000 positions")


@claim("thesis.192")
def points_moved_back() -> Check:
    """Check that the programs with the translation punch the original coordinates, which the translation changes."""
    points = [("1", "2", "3"), ("9", "2", "3"), ("1", "6", "3"), ("1", "2", "7")]
    run = run_hull(data_deck(points, "four"), programs.loader(("translation",)), Options(core=60_000))
    punched = {*read_hull(run.final.result.punched).vertices}
    original = {tuple(map(Fraction, point)) for point in points}
    return exhibited(punched == original, f"{len(punched)} vertices are punched with their original coordinates")
