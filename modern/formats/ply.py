"""ASCII PLY (Turk, "The PLY Polygon File Format", 1994): polygons and decimal text, both kept.

A polyhedron is written with its faces, a polygon with one, a segment as an element ``edge``, a point as one vertex.
The properties are declared ``double``: a reader may round what it reads, the text stays exact.  Read are the
vertices, in text or binary of either order of bytes; of an element before them with lists only text.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import islice

from emulator.errors import FileError
from modern.formats.tokens import Line, count, decimal, error, last_line, lines, take
from modern.geometry.mesh import Mesh
from modern.geometry.numbers import Point, float_text, quoted

_UCHAR = 255


def write(mesh: Mesh, digits: int | None = None) -> str:
    """The text of a PLY file.  Raises ExportError."""
    size = "uchar" if all(len(face) <= _UCHAR for face in mesh.faces) else "int"
    lines = ["ply", "format ascii 1.0", f"element vertex {len(mesh.points)}"]
    lines += [f"property double {axis}" for axis in "xyz"]
    lines += [f"element face {len(mesh.faces)}", f"property list {size} int vertex_indices"]
    if mesh.dimension == 1:
        lines += ["element edge 1", "property int vertex1", "property int vertex2"]
    lines += ["end_header", *mesh.decimals(digits)]
    lines += [" ".join(map(str, (len(face), *face))) for face in mesh.faces]
    if mesh.dimension == 1:
        lines.append("0 1")
    return "".join(line + "\n" for line in lines)


_TYPES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f", "double": "d"}
_SIZED = {"int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I"}
_CODES = {**_TYPES, **_SIZED, "float32": "f", "float64": "d"}
_ORDERS = {"binary_little_endian": "<", "binary_big_endian": ">"}
_END = b"end_header"
_MOST_HEADER = 1 << 16


@dataclass(frozen=True, slots=True)
class _Element:
    """What a header announces: a name, how many, and the name and type of each property (of a list: none)."""

    name: str
    count: int
    properties: list[tuple[str, str]] = field(default_factory=list)


def parse(data: bytes, source: str) -> tuple[tuple[Point, ...], tuple[int, ...]]:
    """The vertices of a PLY file, and the line of each (binary: its number, from 1).

    Of text the numbers are those that stand there, of binary floats exactly what they hold.  Raises FileError.
    """
    end = data.find(_END, 0, _MOST_HEADER)
    if end < 0:
        raise FileError(f"{source}: line 1, column 1: the header has no line end_header")
    line_end = data.find(b"\n", end)
    body = len(data) if line_end < 0 else line_end + 1
    kind, elements = _header(data[:end].decode("ascii", "replace"), source)
    place = next((place for place, element in enumerate(elements) if element.name == "vertex"), None)
    if place is None:
        raise FileError(f"{source}: line 1, column 1: the header announces no element vertex")
    names = [name for name, _ in elements[place].properties]
    if not {"x", "y", "z"} <= set(names):
        raise FileError(f"{source}: line 1, column 1: a vertex has no properties x, y and z")
    columns = [names.index(axis) for axis in "xyz"]
    if kind in _ORDERS:
        return _binary(data, body, elements[: place + 1], columns, _ORDERS[kind], source)
    try:
        text = data.decode("ascii")
    except UnicodeDecodeError as wrong:
        line = data.count(b"\n", 0, wrong.start) + 1
        raise FileError(f"{source}: line {line}, column 1: not ASCII, as the header says") from None
    return _text(text, data.count(b"\n", 0, body), elements[: place + 1], columns, source)


def _header(text: str, source: str) -> tuple[str, list[_Element]]:
    kind, elements = "", list[_Element]()
    for line, found in islice(lines(text, ""), 1, None):
        words = [word for word, _ in found]
        if words[0] in ("comment", "obj_info"):
            continue
        if words[0] == "format" and len(words) == 3 and words[1] in ("ascii", *_ORDERS):
            kind = words[1]
        elif words[0] == "element" and len(words) == 3:
            elements.append(_Element(words[1], count(source, line, found[2])))
        elif words[0] == "property" and elements and words[1:2] == ["list"] and len(words) == 5:
            elements[-1].properties.append((words[4], ""))
        elif words[0] == "property" and elements and len(words) == 3 and words[1] in _CODES:
            elements[-1].properties.append((words[2], _CODES[words[1]]))
        else:
            raise error(source, line, found[0], f"{quoted(' '.join(words))} is not a line of a PLY header")
    if not kind:
        raise FileError(f"{source}: line 2, column 1: the format (ascii, {', '.join(_ORDERS)}) is missing")
    return kind, elements


def _text(
    text: str, first: int, elements: list[_Element], columns: list[int], source: str
) -> tuple[tuple[Point, ...], tuple[int, ...]]:
    """The vertices of a text, whose header has ``first`` lines; every element but an empty one takes a line each."""
    found: Iterator[Line] = (line for line in lines(text, "") if line[0] > first)
    last = last_line(text)
    for element in elements[:-1]:
        for _ in take(found, element.count, source, last, element.name):
            pass
    points: list[Point] = []
    places: list[int] = []
    for line, words in take(found, elements[-1].count, source, last, "vertices"):
        if len(words) <= max(columns):
            raise error(source, line, words[-1], f"the vertex ends after {len(words)} of its properties")
        x, y, z = (decimal(source, line, words[column]) for column in columns)
        points.append((x, y, z))
        places.append(line)
    return tuple(points), tuple(places)


def _binary(
    data: bytes, start: int, elements: list[_Element], columns: list[int], order: str, source: str
) -> tuple[tuple[Point, ...], tuple[int, ...]]:
    for element in elements:
        if not all(code for _, code in element.properties):
            raise FileError(f"{source}: lists before or among the vertices of a binary file are not read")
    shapes = [struct.Struct(order + "".join(code for _, code in element.properties)) for element in elements]
    start += sum(shape.size * element.count for shape, element in zip(shapes[:-1], elements, strict=False))
    wanted, shape = elements[-1].count, shapes[-1]
    if start + wanted * shape.size > len(data):
        raise FileError(f"{source}: the file ends after {max(0, len(data) - start) // shape.size} of {wanted} vertices")
    points: list[Point] = []
    for number in range(wanted):
        values = shape.unpack_from(data, start + number * shape.size)
        x, y, z = (float(values[column]) for column in columns)
        if not (math.isfinite(x) and math.isfinite(y) and math.isfinite(z)):
            raise FileError(f"{source}: vertex {number + 1}: a coordinate is not finite")
        points.append((float_text(x), float_text(y), float_text(z)))
    return tuple(points), tuple(range(1, wanted + 1))
