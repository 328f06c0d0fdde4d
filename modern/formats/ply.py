"""PLY (Turk, "The PLY Polygon File Format", 1994): polygons and decimal text, both preserved.

Written files are ASCII.  A polyhedron is written with its faces, a polygon with one face, a segment as an element
``edge``, a point as one vertex.  The properties are declared ``double``: a reader may round them, but the text is
exact.  The reader returns the vertices of ASCII and binary files of either byte order.  In a binary file no list may
precede the vertices or be among their properties.
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
    """An element of a header: (name, struct code) of its properties, with the code "" for a list."""

    name: str
    count: int
    properties: list[tuple[str, str]] = field(default_factory=list)


def parse(data: bytes, source: str) -> tuple[tuple[Point, ...], tuple[int, ...]]:
    """Return the vertices of a PLY file, exactly, and the line of each one or, in a binary file, its number from 1."""
    end = data.find(_END, 0, _MOST_HEADER)
    if end < 0:
        raise FileError(f"{source}: line 1, column 1: the header has no line end_header")
    line_end = data.find(b"\n", end)
    body = len(data) if line_end < 0 else line_end + 1
    kind, elements = _header(data[:end].decode("ascii", "replace"), source)
    vertex_index = next((index for index, element in enumerate(elements) if element.name == "vertex"), None)
    if vertex_index is None:
        raise FileError(f"{source}: line 1, column 1: the header announces no element vertex")
    names = [name for name, _ in elements[vertex_index].properties]
    if not {"x", "y", "z"} <= set(names):
        raise FileError(f"{source}: line 1, column 1: a vertex has no properties x, y and z")
    columns = [names.index(axis) for axis in "xyz"]
    elements = elements[: vertex_index + 1]
    if kind in _ORDERS:
        return _binary(data, body, elements, columns, _ORDERS[kind], source)
    try:
        text = data.decode("ascii")
    except UnicodeDecodeError as wrong:
        line = data.count(b"\n", 0, wrong.start) + 1
        raise FileError(f"{source}: line {line}, column 1: not ASCII, although the header says so") from None
    return _text(text, data.count(b"\n", 0, body), elements, columns, source)


def _header(text: str, source: str) -> tuple[str, list[_Element]]:
    kind, elements = "", list[_Element]()
    for line, tokens in islice(lines(text, ""), 1, None):
        match [text for text, _ in tokens]:
            case ["comment" | "obj_info", *_]:
                continue
            case ["format", ("ascii" | "binary_little_endian" | "binary_big_endian") as name, _]:
                kind = name
            case ["element", name, _]:
                elements.append(_Element(name, count(source, line, tokens[2])))
            case ["property", "list", _, _, name] if elements:
                elements[-1].properties.append((name, ""))
            case ["property", data_type, name] if elements and data_type in _CODES:
                elements[-1].properties.append((name, _CODES[data_type]))
            case header_line:
                raise error(source, line, tokens[0], f"{quoted(' '.join(header_line))} is not a line of a PLY header")
    if not kind:
        raise FileError(f"{source}: line 2, column 1: the format (ascii, {', '.join(_ORDERS)}) is missing")
    return kind, elements


def _text(
    text: str, header_lines: int, elements: list[_Element], columns: list[int], source: str
) -> tuple[tuple[Point, ...], tuple[int, ...]]:
    """Return the vertices of an ASCII file, the last of ``elements``; each item of an element is one line."""
    rows: Iterator[Line] = (line for line in lines(text, "") if line[0] > header_lines)
    last = last_line(text)
    for element in elements[:-1]:
        for _ in take(rows, element.count, source, last, element.name):
            pass
    points: list[Point] = []
    point_lines: list[int] = []
    for line, tokens in take(rows, elements[-1].count, source, last, "vertices"):
        if len(tokens) <= max(columns):
            raise error(source, line, tokens[-1], f"the vertex ends after {len(tokens)} of its properties")
        x, y, z = (decimal(source, line, tokens[column]) for column in columns)
        points.append((x, y, z))
        point_lines.append(line)
    return tuple(points), tuple(point_lines)


def _binary(
    data: bytes, start: int, elements: list[_Element], columns: list[int], order: str, source: str
) -> tuple[tuple[Point, ...], tuple[int, ...]]:
    """Return the vertices of a binary file, the last of ``elements``; the data begin at ``start``."""
    for element in elements:
        if not all(code for _, code in element.properties):
            raise FileError(f"{source}: lists before or among the vertices of a binary file are not supported")
    rows = [struct.Struct(order + "".join(code for _, code in element.properties)) for element in elements]
    start += sum(row.size * element.count for row, element in zip(rows[:-1], elements, strict=False))
    vertices, row = elements[-1].count, rows[-1]
    if start + vertices * row.size > len(data):
        raise FileError(f"{source}: the file ends after {max(0, len(data) - start) // row.size} of {vertices} vertices")
    points: list[Point] = []
    for number in range(vertices):
        values = row.unpack_from(data, start + number * row.size)
        x, y, z = (float(values[column]) for column in columns)
        if not (math.isfinite(x) and math.isfinite(y) and math.isfinite(z)):
            raise FileError(f"{source}: vertex {number + 1}: a coordinate is not finite")
        points.append((float_text(x), float_text(y), float_text(z)))
    return tuple(points), tuple(range(1, vertices + 1))
