"""Write and read PLY (Turk, "The PLY Polygon File Format", 1994).  Polygons and decimal text are preserved.

Written files are ASCII.  A polyhedron is written with its faces, a polygon with one face, a segment as an element
``edge``, a point as one vertex.  The text of the coordinates is exact.  The coordinates are declared ``double``, so
other readers may round them.  The reader returns the vertices and faces of ASCII and binary files of either byte order.
The reader rejects triangle strips if faces are needed.
"""

import math
import struct
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import islice
from typing import Any

from emulator.errors import FileError, quoted
from modern.formats.tokens import FileMesh, count, decimal, error, last_line, lines
from modern.geometry.mesh import Mesh
from modern.geometry.numbers import Point, float_text

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
_INTEGERS = {name for name, code in _CODES.items() if code not in "fd"}
_ORDERS = {"binary_little_endian": "<", "binary_big_endian": ">"}
_END = b"end_header"
_MOST_HEADER = 1 << 16


@dataclass(frozen=True, slots=True)
class _Element:
    """A kind of item in a PLY file (vertex or face), with its properties.

    Each property is a triple: its name, the struct code of its values, and the struct code of the length of a list. The
    last code is "" if the property is not a list.
    """

    name: str
    count: int
    properties: list[tuple[str, str, str]] = field(default_factory=list)

    @property
    def plural(self) -> str:
        return {"vertex": "vertices", "face": "faces"}.get(self.name, self.name)

    def index(self, *names: str) -> int | None:
        return next((k for k, (name, _, _) in enumerate(self.properties) if name in names), None)


# A function that reads the next item of a file.  Its arguments are the element of the header and the number of the
# item, from 0. It returns the item's line (in a binary file, its number from 1) and its properties: tokens or numbers,
# or lists of them.
Reader = Callable[[_Element, int], tuple[int, list[Any]]]


def surface(data: bytes, source: str, with_faces: bool = True) -> FileMesh:
    """Return the exact vertices of a PLY file, and its faces unless ``with_faces`` is false.

    For a binary file, ``lines`` in the result has the number of each vertex, from 1, in place of its line.
    """
    end = data.find(_END, 0, _MOST_HEADER)
    if end < 0:
        raise FileError(f"{source}: line 1, column 1: the header has no line end_header")
    line_end = data.find(b"\n", end)
    body = len(data) if line_end < 0 else line_end + 1
    kind, elements = _header(data[:end].decode("ascii", "replace"), source)
    by_name = {element.name: element for element in elements}
    if "vertex" not in by_name:
        raise FileError(f"{source}: line 1, column 1: the header announces no element vertex")
    columns = [by_name["vertex"].index(axis) for axis in "xyz"]
    if None in columns:
        raise FileError(f"{source}: line 1, column 1: a vertex has no properties x, y and z")
    if with_faces and (strips := {"tristrips", "tristrip"} & by_name.keys()):
        raise FileError(f"{source}: the faces are an element {strips.pop()}, but only an element face can be read")
    indices = by_name["face"].index("vertex_indices", "vertex_index") if "face" in by_name else None
    if with_faces and "face" in by_name and (indices is None or by_name["face"].properties[indices][1] in "fd"):
        raise FileError(f"{source}: line 1, column 1: a face has no list vertex_indices")
    read = _binary(data, body, _ORDERS[kind], source) if kind in _ORDERS else _text(data, body, source)
    points: list[Point] = []
    point_lines: list[int] = []
    faces: list[tuple[int, ...]] = []
    remaining = {"vertex", "face"} if with_faces and indices is not None else {"vertex"}
    for element in elements:
        for number in range(element.count if element.properties else 0):
            line, values = read(element, number)
            if element.name == "vertex":
                points.append(_point(source, line, [values[column or 0] for column in columns], kind))
                point_lines.append(line)
            elif element.name == "face" and with_faces:
                faces.append(_face(source, line, values[indices or 0], by_name["vertex"].count, kind))
        remaining.discard(element.name)
        if not remaining:
            break
    return FileMesh(source, tuple(points), tuple(point_lines), tuple(faces))


def _point(source: str, line: int, values: list[Any], kind: str) -> Point:
    if kind in _ORDERS and not all(map(math.isfinite, values)):
        raise FileError(f"{source}: vertex {line}: a coordinate is not finite")
    x, y, z = (float_text(value) if kind in _ORDERS else decimal(source, line, value) for value in values)
    return x, y, z


def _face(source: str, line: int, values: list[Any], vertices: int, kind: str) -> tuple[int, ...]:
    face = tuple(count(source, line, value) if isinstance(value, tuple) else int(value) for value in values)
    wrong = [index for index in face if not 0 <= index < vertices]
    if wrong or not face:
        message = f"there is no vertex {wrong[0]}; they are numbered from 0 to {vertices - 1}" if wrong else "no vertex"
        face_name = f"face {line}" if kind in _ORDERS else f"face in line {line}"
        raise FileError(f"{source}: {face_name}: {message}")
    return face


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
            case ["property", "list", size, data_type, name] if elements and size in _INTEGERS and data_type in _CODES:
                elements[-1].properties.append((name, _CODES[data_type], _CODES[size]))
            case ["property", data_type, name] if elements and data_type in _CODES:
                elements[-1].properties.append((name, _CODES[data_type], ""))
            case header_line:
                raise error(source, line, tokens[0], f"{quoted(' '.join(header_line))} is not a line of a PLY header")
    if not kind:
        raise FileError(f"{source}: line 2, column 1: the format (ascii, {', '.join(_ORDERS)}) is missing")
    return kind, elements


def _text(data: bytes, start: int, source: str) -> Reader:
    try:
        text = data.decode("ascii")
    except UnicodeDecodeError as wrong:
        line = data.count(b"\n", 0, wrong.start) + 1
        raise FileError(f"{source}: line {line}, column 1: not ASCII, although the header says so") from None
    header_lines, last = data.count(b"\n", 0, start), last_line(text)
    rows = (row for row in lines(text, "") if row[0] > header_lines)

    def read(element: _Element, number: int) -> tuple[int, list[Any]]:
        line, tokens = next(rows, (0, []))
        if not tokens:
            message = f"the file ends after {number} of {element.count} {element.plural}"
            raise FileError(f"{source}: line {last}, column 1: {message}")
        values: list[Any] = []
        position = 0
        for _, _, size in element.properties:
            length = 1
            if size and position < len(tokens):
                length = count(source, line, tokens[position])
                position += 1
            if position + length > len(tokens):
                message = f"the {element.name} ends after {len(values)} of {len(element.properties)} properties"
                raise error(source, line, tokens[-1], message)
            values.append(tokens[position : position + length] if size else tokens[position])
            position += length
        return line, values

    return read


def _binary(data: bytes, start: int, order: str, source: str) -> Reader:
    offset = start

    def unpack(codes: str) -> tuple[Any, ...]:
        nonlocal offset
        values = struct.unpack_from(order + codes, data, offset)
        offset += struct.calcsize(order + codes)
        return values

    def read(element: _Element, number: int) -> tuple[int, list[Any]]:
        try:
            if not any(size for _, _, size in element.properties):
                return number + 1, list(unpack("".join(code for _, code, _ in element.properties)))
            values: list[Any] = []
            for _, code, size in element.properties:
                values.append(list(unpack(f"{int(unpack(size)[0])}{code}")) if size else unpack(code)[0])
        except struct.error:
            message = f"the file ends after {number} of {element.count} {element.plural}"
            raise FileError(f"{source}: {message}") from None
        return number + 1, values

    return read
