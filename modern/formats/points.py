"""Read points from files of every supported format: decks, CSV lists, OFF, OBJ, PLY, STL, JSON and NPY.

Surfaces, points with faces, are read from OFF, OBJ, PLY and STL.

Numbers are exact: a decimal has the value of its text, a binary float the value that it stores.  All digits of a field
on a card are read, whereas the programs would drop those after the eighth digit.  The format of a file is recognised by
its first bytes or its first line, and by the extension of its name only if those fit several formats.
"""

import io
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from emulator.errors import FileError, quoted
from emulator.files import POINTS_LIMIT, decoded, read_bytes, source_name
from emulator.language.cards import deck_from_text
from modern.formats import MESHES, POINTS, csv, json, obj, ply, stl
from modern.formats.deck import exact_points
from modern.formats.off import parse_off
from modern.formats.tokens import FileMesh
from modern.geometry.hull import PointTexts
from modern.geometry.numbers import Point, decimal, float_text, integer_text, real

_NPY, _DOUBLE = b"\x93NUMPY", 8


@dataclass(frozen=True, slots=True)
class Input:
    """The points of a file as decimal text, the place of each in the file (such as ``card 3``), and warnings.

    If the file holds an array of numbers, the texts are made when they are accessed.
    """

    source: str
    kind: str
    points: Sequence[Point]
    places: tuple[str, ...]
    notes: tuple[str, ...] = ()


def read_input(path: str) -> Input:
    """Read the points of a file, or of standard input (``-``).  Raise EmulatorError with a one-line message."""
    return parse_bytes(read_bytes(path, limit=POINTS_LIMIT), source_name(path))


def parse_bytes(data: bytes, source: str) -> Input:
    """Read points from the bytes of a text or binary file.  Raise EmulatorError with a one-line message."""
    kind = _binary_kind(data)
    if kind == "npy":
        points = _npy(data, source)
        return _input(source, kind, points, range(1, len(points) + 1), "row")
    if kind == "ply":
        mesh = ply.surface(data, source, with_faces=False)
        return _input(source, kind, mesh.points, mesh.lines, "line" if b"format ascii" in data else "vertex")
    if kind == "stl":
        mesh = stl.surface_binary(data, source)
        return _input(source, kind, mesh.points, mesh.lines, "triangle")
    return parse_input(decoded(data, source), source)


def parse_input(text: str, source: str) -> Input:
    """Read points from the text of a file.  Raise EmulatorError with a one-line message."""
    kind = recognise(text, source)
    if kind == "deck":
        cards, notes = exact_points(deck_from_text(source, text))
        return _input(source, kind, tuple(cards.values()), cards, "card", notes)
    if kind in ("off", "stl"):
        mesh = parse_off(text, source) if kind == "off" else stl.surface(text, source, check_triangles=False)
        return _input(source, kind, mesh.points, mesh.lines)
    if kind == "json":
        points = json.parse(text, source)
        return _input(source, kind, points, range(1, len(points) + 1), "point")
    return _input(source, kind, *(csv.points if kind == "csv" else obj.parse)(text, source))


def parse_mesh(data: bytes, source: str) -> FileMesh:
    """Return the surface in a file, which may have no faces.  Raise FileError if it is not OFF, OBJ, PLY or STL.

    The readers do not check that the faces form a closed surface.  Equal corners of an STL file are one point.  In OFF,
    OBJ and PLY files every vertex is a separate point.
    """
    kind = surface_kind(data, source)
    if not kind:
        raise FileError(f"{source}: expected faces in OFF, OBJ, PLY or STL; this file holds only points")
    if kind == "ply":
        return ply.surface(data, source)
    if kind == "stl" and stl.is_binary(data):
        return stl.surface_binary(data, source)
    reader = {"off": parse_off, "obj": obj.surface, "stl": stl.surface}[kind]
    return reader(decoded(data, source), source)


def surface_kind(data: bytes, source: str) -> str:
    """Return the format of a file if it is one of ``MESHES``, or "" if it is a format of points without faces.

    Raise FileError if the format is unknown.
    """
    kind = kind_of(data, source)
    return kind if kind in MESHES else ""


def kind_of(data: bytes, source: str) -> str:
    """Return the format of a file of points, a key of ``POINTS``.  Raise FileError if it has none of these formats."""
    return _binary_kind(data) or recognise(decoded(data, source), source)


def deck_or_points(data: bytes, source: str) -> str:
    """Return the format of a file of points, or "deck" if it is not clearly one of the other formats.

    If the answer is "deck", the reader of decks reads the file next and reports any error in it.  A text whose first
    line has several words is a list only if these words are three numbers, because the first card of a deck may hold
    two numbers: the number of points N and a tolerance e.
    """
    try:
        kind = kind_of(data, source)
        return "deck" if kind == "csv" and not csv.begins_with_point(decoded(data, source)) else kind
    except FileError:
        return "deck"


def _binary_kind(data: bytes) -> str:
    if data.startswith(_NPY):
        return "npy"
    if data.startswith((b"ply\n", b"ply\r")):
        return "ply"
    return "stl" if stl.is_binary(data) else ""


def recognise(text: str, source: str) -> str:
    """Return the format of a text, a key of ``POINTS``, from its first line that is not blank or a comment.

    A word that ends with OFF begins an OFF file, ``solid`` begins an STL file, a brace or bracket begins a JSON file,
    and ``v`` or another keyword of the format begins an OBJ file.  A comma or semicolon indicates a list, and a single
    integer indicates the first card of a deck.  Otherwise the extension of the file decides, and several words
    separated by blanks or tabs are a list.  Raise FileError if none of this applies.
    """
    lines = ((line_number, row.strip()) for line_number, row in enumerate(text.splitlines(), 1))
    line, first = next(((n, row) for n, row in lines if row and not row.startswith("#")), (0, ""))
    if not first:
        raise FileError(f"{source}: there are no points")
    tokens = first.split()
    extension = source.rpartition(".")[2].lower()
    kind = extension if extension in POINTS and extension not in ("npy", "ply") else ""
    if tokens[0].isalnum() and tokens[0].upper().endswith("OFF"):
        return "off"
    if first[0] in "[{":
        return "json"
    if tokens[0].lower() == "solid":
        return "stl"
    if tokens[0] in obj.KEYWORDS and kind in ("", "obj"):
        return "obj"
    if "," in first or ";" in first:
        return "csv"
    if len(tokens) == 1 and tokens[0].isdecimal() and tokens[0].isascii():
        return "deck"
    if kind or len(tokens) > 1:
        return kind or "csv"
    raise FileError(
        f"{source}: line {line}, column 1: {quoted(first)} is neither the first card of a deck (N in columns 1-2) "
        "nor a point x,y,z nor the word OFF"
    )


def _input(
    source: str,
    kind: str,
    points: Sequence[Point],
    numbers: Iterable[int],
    unit: str = "line",
    notes: tuple[str, ...] = (),
) -> Input:
    if not points:
        raise FileError(f"{source}: there are no points")
    return Input(source, kind, points, tuple(f"{unit} {number}" for number in numbers), notes)


def _npy(data: bytes, source: str) -> Sequence[Point]:
    import numpy as np  # not at the top, because text formats do not need it

    try:
        array = np.asarray(np.load(io.BytesIO(data), allow_pickle=False))
    except Exception as error:
        # numpy raises errors of many types for a damaged header: TokenError, IndexError, OverflowError and others.
        reason = " ".join(str(error).split()) or "it cannot be read"
        raise FileError(f"{source}: not an NPY array of numbers: {reason[:120]}") from None
    if array.dtype.kind not in "iuf" or array.ndim != 2 or array.shape[1] != 3:
        raise FileError(
            f"{source}: expected an array of numbers of shape (n, 3), found {array.dtype} of shape {array.shape}"
        )
    if array.dtype.itemsize <= _DOUBLE and np.isfinite(array).all():

        def member(row: int) -> Point:
            x, y, z = (integer_text(n) if isinstance(n, int) else float_text(n) for n in array[row].tolist())
            return x, y, z

        return PointTexts(len(array), member, lambda: np.array(array, np.float64), array)
    points: list[Point] = []
    for row_number, row in enumerate(array.tolist(), 1):
        texts = []
        for axis, value in zip("xyz", row, strict=True):
            try:
                exact = real(value)
                text = integer_text(value) if isinstance(value, int) else float_text(exact)
                if array.dtype.itemsize > _DOUBLE:
                    decimal(text)  # raises for more digits than are read
            except ValueError as error:
                raise FileError(f"{source}: row {row_number}, {axis}: {error}") from None
            texts.append(text)
        points.append((texts[0], texts[1], texts[2]))
    return tuple(points)
