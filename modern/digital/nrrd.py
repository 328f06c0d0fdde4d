"""Read and write NRRD files (Kindlmann, "Definition of NRRD File Format", teem.sourceforge.net/nrrd/format.html).

The reader accepts arrays with two or three axes of the standard number types, encoded raw or gzip, with the data after
the header or in one file that a detached header names (``data file: NAME``). The first axis varies fastest, so the
array is indexed [x, y, z]. The position (``spacings`` or ``space directions``, ``space origin``, ``space`` and units)
has the exact values of its decimal text. ``space origin`` is the centre of the first voxel. The writer stores truth
values as compressed uint8 together with the position.
"""

import gzip
import io
import math
import re
from collections.abc import Mapping, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from emulator.errors import quoted
from emulator.files import VOLUME_LIMIT, read_bytes, writing_bytes
from modern.digital.integrity.streams import check_length, outside_note, read_gzip
from modern.digital.scans import Scan
from modern.digital.solids import MAX_CELLS, Volume, VolumeError
from modern.digital.world import ANATOMICAL, Position, World, length_text, world_of
from modern.geometry.numbers import finite_decimal

MAGIC = b"NRRD000"
_TYPES = {
    "i1": ("signed char", "int8", "int8_t"),
    "u1": ("uchar", "unsigned char", "uint8", "uint8_t"),
    "i2": ("short", "short int", "signed short", "signed short int", "int16", "int16_t"),
    "u2": ("ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"),
    "i4": ("int", "signed int", "int32", "int32_t"),
    "u4": ("uint", "unsigned int", "uint32", "uint32_t"),
    "i8": ("longlong", "long long", "long long int", "signed long long", "signed long long int", "int64", "int64_t"),
    "u8": ("ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"),
    "f4": ("float",),
    "f8": ("double",),
}
_CODES = {name: code for code, names in _TYPES.items() for name in names}
_ENDIANS = {"little": "<", "big": ">"}
_RAW, _PACKED = "raw", ("gzip", "gz")
_OTHER_NAMES = {
    "datafile": "data file",
    "lineskip": "line skip",
    "byteskip": "byte skip",
    "axismins": "axis mins",
    "axismaxs": "axis maxs",
}
_SPACES = {"lps": ANATOMICAL[0], "ras": ANATOMICAL[1], "las": ANATOMICAL[2]}
_VECTOR = re.compile(r"\(([^()]*)\)")
# What stands for the step of an axis that is not spatial, or for a component of the step.
_NOT_SPATIAL = re.compile(r"\b(none|nan)\b", re.IGNORECASE)
_QUOTED = re.compile(r'"((?:[^"\\]|\\.)*)"')
_IGNORED = ("axis mins", "axis maxs")
_MOST_AXES = 3


def parse_nrrd(data: bytes, source: str) -> Scan:
    """Return the array of an NRRD file, indexed [x, y] or [x, y, z], and its position.

    ``source`` is the path of the file, used in messages and to find the data file of a detached header. Raise
    VolumeError for an invalid or missing field, and for data that are too short, too long or damaged. Raise FileError
    if the data file cannot be read.
    """
    head, *rest = re.split(rb"\n\n|\r\n\r\n", data, maxsplit=1)
    body = rest[0] if rest else b""
    fields = _fields(head, source)
    dimension = _number(fields, "dimension", source)
    if dimension not in (2, 3):
        raise VolumeError(f"{source}: line {fields['dimension'][0]}: expected two or three axes, found {dimension}")
    line, text = fields.get("sizes", (0, ""))
    values = text.split()
    if len(values) != dimension or not all(_is_count(word) and int(word) for word in values):
        raise VolumeError(f"{source}: line {line}: sizes: expected {dimension} positive integers, found {quoted(text)}")
    sizes = tuple(int(word) for word in values)
    if math.prod(sizes) > MAX_CELLS:
        raise VolumeError(
            f"{source}: line {line}: sizes: expected at most {MAX_CELLS} voxels, found {math.prod(sizes)}"
        )
    line, encoding = fields["encoding"]
    if encoding.lower() not in (_RAW, *_PACKED):
        raise VolumeError(f"{source}: line {line}: encoding: expected raw or gzip, found {quoted(encoding)}")
    kind = _type(fields, source)
    for name in ("line skip", "byte skip"):
        if name in fields and _number(fields, name, source):
            raise VolumeError(f"{source}: line {fields[name][0]}: {name}: only the value 0 is supported")
    if "data file" in fields:
        if not body and not data.endswith((b"\n", b"\r")):
            raise VolumeError(f"{source}: the header is truncated: its last line lacks a line break")
        body = _read_data_file(source, *fields["data file"])
    expected = math.prod(sizes) * kind.itemsize
    if encoding.lower() in _PACKED:
        body, length = read_gzip(source, io.BytesIO(body), expected, expected)
    else:
        length = len(body)
    check_length(source, expected, length)
    array = np.frombuffer(body, kind).reshape(sizes, order="F")
    world, notes = _world(fields, dimension, source)
    outside = outside_note(source, fields["data file"][1]) if "data file" in fields else ""
    return Scan(array, (0,) * dimension, source, world, (*notes, outside) if outside else notes)


def write_nrrd(path: str, array: NDArray[np.bool_], volume: Volume) -> None:
    """Write an array of truth values with the position of a volume as an NRRD file.

    Raise VolumeError if a number of the position has no finite decimal expansion.
    """
    world = volume.world
    if world is None and any(volume.origin):
        world = world_of(array.ndim, origin=(0,) * array.ndim)
    head = [f"{MAGIC.decode()}4", "type: uint8", f"dimension: {array.ndim}"]
    if world is not None:
        head.append(f"space: {world.space}" if world.space else f"space dimension: {len(world.origin)}")
    head += [f"sizes: {' '.join(map(str, array.shape))}", "encoding: gzip"]
    if world is not None:
        head.append(f"space directions: {' '.join(_vector(step, path) for step in world.steps)}")
        head.append(f"space origin: {_vector(world.place(volume.origin), path)}")
        if world.unit:
            head.append("space units: " + " ".join([f'"{world.unit}"'] * len(world.origin)))
    with writing_bytes(path) as file:
        file.write(("\n".join(head) + "\n\n").encode("latin-1", "replace"))
        with gzip.GzipFile(filename="", mode="wb", compresslevel=6, fileobj=file, mtime=0) as packed:
            for place in range(array.shape[-1]):
                packed.write(array[..., place].astype(np.uint8).tobytes("F"))


def _fields(head: bytes, source: str) -> dict[str, tuple[int, str]]:
    """Return the fields of a header, without comments and key/value pairs.

    The keys are the names in lower case, the values pairs of the line number and the text.
    """
    fields: dict[str, tuple[int, str]] = {}
    for line, raw in enumerate(head.decode("latin-1").splitlines(), 1):
        if line == 1 or raw.startswith("#") or not raw.strip():
            continue
        name, colon, value = raw.partition(":")
        if not colon:
            raise VolumeError(f"{source}: line {line}, column 1: expected a field or a comment of an NRRD header")
        if value.startswith("="):
            continue
        canonical_name = _OTHER_NAMES.get(name.lower(), name.lower())
        if canonical_name in fields:
            raise VolumeError(f"{source}: line {line}, column 1: duplicate field {name}")
        fields[canonical_name] = (line, value.strip())
    for name in ("type", "dimension", "sizes", "encoding"):
        if name not in fields:
            raise VolumeError(f"{source}: the header has no field {name!r}")
    return fields


def _is_count(text: str) -> bool:
    return text.isascii() and text.isdigit() and len(text) < 12


def _number(fields: Mapping[str, tuple[int, str]], name: str, source: str) -> int:
    line, text = fields[name]
    if not _is_count(text.removeprefix("-")):
        raise VolumeError(f"{source}: line {line}: {name}: {quoted(text)} is not an integer")
    return int(text)


def _type(fields: Mapping[str, tuple[int, str]], source: str) -> np.dtype[Any]:
    line, text = fields["type"]
    code = _CODES.get(" ".join(text.lower().split()))
    if code is None:
        raise VolumeError(f"{source}: line {line}: type: {quoted(text)} is not supported")
    if code.endswith("1"):
        return np.dtype(code)
    if "endian" not in fields:
        raise VolumeError(
            f"{source}: the header has no field 'endian', which is required for numbers of {code[1]} bytes"
        )
    line, text = fields["endian"]
    if text.lower() not in _ENDIANS:
        raise VolumeError(f"{source}: line {line}: endian: expected little or big, found {quoted(text)}")
    return np.dtype(_ENDIANS[text.lower()] + code)


def _read_data_file(source: str, line: int, name: str) -> bytes:
    if name.upper().startswith("LIST") or "%" in name:
        raise VolumeError(f"{source}: line {line}: data in several files are not supported")
    return read_bytes(str(Path(source).parent / name), f"{source}: line {line}: {name}", VOLUME_LIMIT)


def _world(fields: Mapping[str, tuple[int, str]], dimension: int, source: str) -> tuple[World | None, tuple[str, ...]]:
    """Return the position of the voxels, None if the header states no usable position, and notes for the user."""
    notes = [
        f"{source}: line {fields[name][0]}: {name} is ignored; space origin states the position"
        for name in _IGNORED
        if name in fields
    ]
    line, steps = _steps(fields, dimension, source)
    if not line:
        at = fields.get("space origin")
        return None, (
            *notes,
            *([f"{source}: line {at[0]}: space origin is ignored, because there are no spacings"] if at else []),
        )
    if steps is None:
        return None, (*notes, f"{source}: line {line}: an axis of the array is not spatial; the position is ignored")
    width = len(steps[0])
    if width > _MOST_AXES:
        return None, (*notes, f"{source}: line {line}: the space has {width} axes; the position is ignored")
    if "space directions" not in fields and any(min(step) < 0 for step in steps):
        notes.append(f"{source}: line {line}: spacings: a negative number reverses its axis")
    origin = _origin(fields, width, source)
    space = fields.get("space", (0, ""))[1]
    space = _SPACES.get(space.lower(), space.lower() if space.lower() in ANATOMICAL else space)
    try:
        return World(steps, origin, space, _unit(fields, source)), tuple(notes)
    except VolumeError as error:
        raise VolumeError(f"{source}: line {line}: {error}") from None


def _steps(
    fields: Mapping[str, tuple[int, str]], dimension: int, source: str
) -> tuple[int, tuple[Position, ...] | None]:
    """Return the number of the header's line that states the steps between voxels, and the steps.

    The line number is 0 if there is no such line. The steps are None if an axis of the array is not spatial.
    """
    spacing_line, spacings = fields.get("spacings", (0, ""))
    words = spacings.lower().split()
    if "space directions" not in fields:
        if not spacing_line or "nan" in words:
            return spacing_line, None
        numbers = _numbers(words, dimension, f"{source}: line {spacing_line}: spacings")
        zero = Fraction(0)
        return spacing_line, tuple(
            tuple(number if k == axis else zero for k in range(dimension)) for axis, number in enumerate(numbers)
        )
    if any(word != "nan" for word in words):
        raise VolumeError(f"{source}: line {spacing_line}: expected no spacings, because space directions state them")
    line, text = fields["space directions"]
    if _NOT_SPATIAL.search(text):
        return line, None
    return line, _vectors(text, dimension, f"{source}: line {line}: space directions")


def _origin(fields: Mapping[str, tuple[int, str]], width: int, source: str) -> Position:
    if "space origin" not in fields:
        return (Fraction(0),) * width
    line, text = fields["space origin"]
    what = f"{source}: line {line}: space origin"
    (vector,) = _vectors(text, 1, what)
    if len(vector) != width:
        raise VolumeError(f"{what}: expected {width} numbers in parentheses, found {quoted(text)}")
    return vector


def _vectors(text: str, count: int, what: str) -> tuple[Position, ...]:
    """Read ``count`` vectors with the same number of components, such as ``(1,0,0)``."""
    vectors = [match.split(",") for match in _VECTOR.findall(text)]
    if len(vectors) != count or _VECTOR.sub("", text).strip():
        expected = "a vector" if count == 1 else f"{count} vectors"
        raise VolumeError(f"{what}: expected {expected} such as (1,0,0), found {quoted(text)}")
    return tuple(_numbers(components, len(vectors[0]), what) for components in vectors)


def _numbers(texts: Sequence[str], count: int, what: str) -> Position:
    if len(texts) != count:
        raise VolumeError(f"{what}: expected {count} numbers, found {len(texts)}")
    try:
        return tuple(length_text(text) for text in texts)
    except ValueError as error:
        raise VolumeError(f"{what}: {error}") from None


def _unit(fields: Mapping[str, tuple[int, str]], source: str) -> str:
    line, text = fields.get("space units") or fields.get("units") or (0, "")
    units = {unit for unit in _QUOTED.findall(text) if unit}
    if len(units) > 1:
        raise VolumeError(f"{source}: line {line}: the axes have different units: {', '.join(sorted(units))[:60]}")
    return units.pop() if units else ""


def _vector(place: Position, path: str) -> str:
    texts = [finite_decimal(number) for number in place]
    if None in texts:
        raise VolumeError(f"{path}: {place[texts.index(None)]} has no finite decimal, which NRRD requires")
    return f"({','.join(text for text in texts if text is not None)})"
