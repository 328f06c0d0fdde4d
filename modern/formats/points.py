"""Points from a file of any kind the command line takes: a data deck, CSV points, or the vertices of an OFF file.

The numbers are those that stand in the file, exactly.  Of a deck's field all of its digits are taken, where the
programs on the machine would cut the ninth.
"""

from __future__ import annotations

from dataclasses import dataclass

from emulator.errors import FileError
from emulator.files import read_text, source_name
from emulator.language.cards import deck_from_text
from modern.formats import POINTS, csv
from modern.formats.deck import exact_points
from modern.formats.off import parse_off
from modern.geometry.numbers import Point, shown


@dataclass(frozen=True, slots=True)
class Input:
    """The points of a file, as decimal text.

    ``places`` say where each stands, ``card 3`` or ``line 3``; ``notes`` what the reader should know, a line each.
    """

    source: str
    kind: str
    points: tuple[Point, ...]
    places: tuple[str, ...]
    notes: tuple[str, ...] = ()


def read_input(path: str) -> Input:
    """Read a file (``-``: standard input) and recognise what it is.  Raises EmulatorError (one line)."""
    return parse_input(read_text(path), source_name(path))


def parse_input(text: str, source: str) -> Input:
    """Points from a file's text.  Raises EmulatorError (one line)."""
    found = _READERS[recognise(text, source)](text, source)
    if not found.points:
        raise FileError(f"{source}: there are no points")
    return found


def recognise(text: str, source: str) -> str:
    """Which of ``POINTS`` a file is, by its first line that is neither blank nor a comment of OFF.

    A word that ends with OFF begins an OFF file; a comma makes it CSV; a number alone is a deck's first card.  Else
    the ending of the file's name decides.  Raises FileError.
    """
    lines = ((number_, row.strip()) for number_, row in enumerate(text.splitlines(), 1))
    line, first = next(((n, row) for n, row in lines if row and not row.startswith("#")), (0, ""))
    if not first:
        raise FileError(f"{source}: there are no points")
    words = first.split()
    if words[0].isalnum() and words[0].upper().endswith("OFF"):
        return "off"
    if "," in first:
        return "csv"
    if len(words) == 1 and words[0].isdecimal() and words[0].isascii():
        return "deck"
    ending = source.rpartition(".")[2].lower()
    if ending in POINTS:
        return ending
    raise FileError(
        f"{source}: line {line}, column 1: {shown(first)} is neither the first card of a deck (N in columns 1-2) "
        "nor a point x,y,z nor the word OFF"
    )


def _deck(text: str, source: str) -> Input:
    points, notes = exact_points(deck_from_text(source, text))
    return Input(source, "deck", tuple(points.values()), tuple(f"card {number}" for number in points), notes)


def _csv(text: str, source: str) -> Input:
    points, lines = csv.points(text, source)
    return Input(source, "csv", points, tuple(f"line {line}" for line in lines))


def _off(text: str, source: str) -> Input:
    found = parse_off(text, source)
    return Input(source, "off", found.points, tuple(f"line {line}" for line in found.lines))


_READERS = {"deck": _deck, "csv": _csv, "off": _off}
