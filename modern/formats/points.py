"""Points from a file of any kind the command line takes: decks, lists, OFF, OBJ, PLY, STL, JSON and NPY.

The numbers are those that stand in the file, exactly; a binary float is the number it holds.  Of a deck's field all
of its digits are taken, where the programs on the machine would cut the ninth.  What kind a file is, it says itself
by its first bytes or line; only where that leaves it open does the ending of its name decide.
"""

from __future__ import annotations

import io
from collections.abc import Iterable
from dataclasses import dataclass

from emulator.errors import FileError
from emulator.files import decoded, read_bytes, source_name
from emulator.language.cards import deck_from_text
from modern.formats import POINTS, csv, json, obj, ply, stl
from modern.formats.deck import exact_points
from modern.formats.off import parse_off
from modern.geometry.numbers import Point, float_text, integer_text, quoted, real

_NPY = b"\x93NUMPY"


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
    return parse_bytes(read_bytes(path), source_name(path))


def parse_bytes(data: bytes, source: str) -> Input:
    """Points from a file's bytes, of text or of a binary kind.  Raises EmulatorError (one line)."""
    if data.startswith(_NPY):
        return _filled(_npy(data, source))
    if data.startswith((b"ply\n", b"ply\r")):
        return _filled(
            _listed(source, "ply", *ply.parse(data, source), "line" if b"format ascii" in data else "vertex")
        )
    if stl.is_binary(data):
        return _filled(_listed(source, "stl", *stl.parse_binary(data, source), "triangle"))
    return parse_input(decoded(data, source), source)


def parse_input(text: str, source: str) -> Input:
    """Points from a file's text.  Raises EmulatorError (one line)."""
    kind = recognise(text, source)
    if kind == "deck":
        points, notes = exact_points(deck_from_text(source, text))
        return _filled(Input(source, kind, tuple(points.values()), _places("card", points), notes))
    if kind == "off":
        found = parse_off(text, source)
        return _filled(_listed(source, kind, found.points, found.lines))
    if kind == "json":
        points_read = json.parse(text, source)
        return _filled(_listed(source, kind, points_read, range(1, len(points_read) + 1), "point"))
    reader = {"csv": csv.points, "obj": obj.parse, "stl": stl.parse}[kind]
    return _filled(_listed(source, kind, *reader(text, source)))


def recognise(text: str, source: str) -> str:
    """Which of ``POINTS`` a text is, by its first line that is neither blank nor a comment.

    A word that ends with OFF begins an OFF file, ``solid`` an STL file, a brace or bracket JSON, ``v`` or another
    word of its own an OBJ file; a comma or semicolon makes it a list; a number alone is a deck's first card.  Else
    the ending of the file's name decides, and blanks or tabs between words make a list.  Raises FileError.
    """
    lines = ((number_, row.strip()) for number_, row in enumerate(text.splitlines(), 1))
    line, first = next(((n, row) for n, row in lines if row and not row.startswith("#")), (0, ""))
    if not first:
        raise FileError(f"{source}: there are no points")
    words = first.split()
    ending = source.rpartition(".")[2].lower()
    kind = ending if ending in POINTS and ending not in ("npy", "ply") else ""
    if words[0].isalnum() and words[0].upper().endswith("OFF"):
        return "off"
    if first[0] in "[{":
        return "json"
    if words[0].lower() == "solid":
        return "stl"
    if words[0] in obj.KEYWORDS and kind in ("", "obj"):
        return "obj"
    if "," in first or ";" in first:
        return "csv"
    if len(words) == 1 and words[0].isdecimal() and words[0].isascii():
        return "deck"
    if kind or len(words) > 1:
        return kind or "csv"
    raise FileError(
        f"{source}: line {line}, column 1: {quoted(first)} is neither the first card of a deck (N in columns 1-2) "
        "nor a point x,y,z nor the word OFF"
    )


def _listed(source: str, kind: str, points: tuple[Point, ...], places: Iterable[int], unit: str = "line") -> Input:
    return Input(source, kind, points, _places(unit, places))


def _places(unit: str, numbers: Iterable[int]) -> tuple[str, ...]:
    return tuple(f"{unit} {number}" for number in numbers)


def _filled(found: Input) -> Input:
    if not found.points:
        raise FileError(f"{found.source}: there are no points")
    return found


def _npy(data: bytes, source: str) -> Input:
    """The rows of an array of shape (n, 3), counted from 1."""
    import numpy as np  # here, so that no text waits for it

    try:
        array = np.asarray(np.load(io.BytesIO(data), allow_pickle=False))
    except Exception as error:
        # A damaged header ends in whatever error numpy's reader of it meets: TokenError, IndexError, OverflowError ...
        said = " ".join(str(error).split()) or "it cannot be read"
        raise FileError(f"{source}: no NPY array of numbers: {said[:120]}") from None
    if array.dtype.kind not in "iuf" or array.ndim != 2 or array.shape[1] != 3:
        raise FileError(
            f"{source}: an array of {array.dtype} and shape {array.shape}; points are numbers, shape (n, 3)"
        )
    points: list[Point] = []
    for order, row in enumerate(array.tolist(), 1):
        texts = []
        for axis, value in zip("xyz", row, strict=True):
            try:
                exact = real(value)
            except ValueError as error:
                raise FileError(f"{source}: row {order}, {axis}: {error}") from None
            texts.append(integer_text(value) if isinstance(value, int) else float_text(exact))
        points.append((texts[0], texts[1], texts[2]))
    return _listed(source, "npy", tuple(points), range(1, len(points) + 1), "row")
