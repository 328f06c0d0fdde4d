"""NRRD files (Kindlmann, "Definition of NRRD File Format", teem.sourceforge.net/nrrd/format.html): volumes as arrays.

Read are arrays of two or three axes of the standard number types, encoded raw or gzip, with the data after the
header or in one file that a detached header names (``data file: NAME``).  The fastest axis is the first, so the
array is indexed [x, y, z].  Whatever says where the volume lies in the world (spacings, space directions) is passed
over.
"""

from __future__ import annotations

import gzip
import io
import math
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from emulator.files import read_bytes
from modern.digital.solids import MAX_CELLS, VolumeError

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


def parse_nrrd(data: bytes, source: str) -> NDArray[Any]:
    """The array of an NRRD file, indexed [x, y] or [x, y, z].

    source: the name messages use; a detached header's data file is looked for beside it.  Raises VolumeError with the
    header's line for a field that is missing, unknown here or no number, and for data that are too short, too long or
    damaged, FileError for a data file that cannot be read.
    """
    head, body = _cut(data)
    fields = _fields(head, source)
    dimension = _number(fields, "dimension", source)
    if dimension not in (2, 3):
        raise VolumeError(f"{source}: line {fields['dimension'][0]}: {dimension} axes; a volume has two or three")
    line, text = fields.get("sizes", (0, ""))
    words = text.split()
    if len(words) != dimension or not all(_is_count(word) and int(word) for word in words):
        raise VolumeError(f"{source}: line {line}: sizes: {dimension} numbers above 0 are due, here is {text!r}")
    sizes = tuple(int(word) for word in words)
    if math.prod(sizes) > MAX_CELLS:
        raise VolumeError(f"{source}: line {line}: a volume of more than {MAX_CELLS} voxels is not read")
    line, encoding = fields["encoding"]
    if encoding.lower() not in (_RAW, *_PACKED):
        raise VolumeError(f"{source}: line {line}: encoding: {encoding!r} is not read, only raw and gzip")
    kind = _type(fields, source)
    for name in ("line skip", "byte skip"):
        if name in fields and _number(fields, name, source):
            raise VolumeError(f"{source}: line {fields[name][0]}: {name}: only 0 is read")
    if "data file" in fields:
        body = _beside(source, *fields["data file"])
    wanted = math.prod(sizes) * kind.itemsize
    if encoding.lower() in _PACKED:
        body = _unpacked(body, wanted, source)
    if len(body) < wanted:
        raise VolumeError(f"{source}: the data end after {len(body)} of {wanted} bytes")
    if len(body) > wanted:
        raise VolumeError(f"{source}: the data go on after the {wanted} bytes of {'x'.join(map(str, sizes))} numbers")
    return np.frombuffer(body, kind).reshape(sizes, order="F")


def _cut(data: bytes) -> tuple[bytes, bytes]:
    """Header and data: an empty line stands between."""
    ends = [(data.find(mark), len(mark)) for mark in (b"\n\n", b"\r\n\r\n")]
    found = [(at, length) for at, length in ends if at >= 0]
    if not found:
        return data, b""
    at, length = min(found)
    return data[:at], data[at + length :]


def _fields(head: bytes, source: str) -> dict[str, tuple[int, str]]:
    """Every field of the header, lower case, with its line; comments and key/value pairs left out."""
    found: dict[str, tuple[int, str]] = {}
    for line, raw in enumerate(head.decode("latin-1").splitlines(), 1):
        if line == 1 or raw.startswith("#") or not raw.strip():
            continue
        name, colon, value = raw.partition(":")
        if not colon:
            raise VolumeError(f"{source}: line {line}, column 1: neither a field nor a comment of an NRRD header")
        if value.startswith("="):
            continue
        name = {"datafile": "data file", "lineskip": "line skip", "byteskip": "byte skip"}.get(name, name)
        if name.lower() in found:
            raise VolumeError(f"{source}: line {line}, column 1: {name} stands twice")
        found[name.lower()] = (line, value.strip())
    for name in ("type", "dimension", "sizes", "encoding"):
        if name not in found:
            raise VolumeError(f"{source}: the header has no field {name!r}")
    return found


def _is_count(word: str) -> bool:
    return word.isascii() and word.isdigit() and len(word) < 12


def _number(fields: Mapping[str, tuple[int, str]], name: str, source: str) -> int:
    line, text = fields[name]
    if not _is_count(text.removeprefix("-")):
        raise VolumeError(f"{source}: line {line}: {name}: {text!r} is not a whole number")
    return int(text)


def _type(fields: Mapping[str, tuple[int, str]], source: str) -> np.dtype[Any]:
    line, text = fields["type"]
    code = _CODES.get(" ".join(text.lower().split()))
    if code is None:
        raise VolumeError(f"{source}: line {line}: type: {text!r} is not read")
    if code.endswith("1"):
        return np.dtype(code)
    if "endian" not in fields:
        raise VolumeError(f"{source}: the header has no field 'endian', which numbers of {code[1]} bytes need")
    line, text = fields["endian"]
    if text.lower() not in _ENDIANS:
        raise VolumeError(f"{source}: line {line}: endian: {text!r} is neither little nor big")
    return np.dtype(_ENDIANS[text.lower()] + code)


def _beside(source: str, line: int, name: str) -> bytes:
    if name.upper().startswith("LIST") or "%" in name:
        raise VolumeError(f"{source}: line {line}: data in several files are not read")
    return read_bytes(str(Path(source).parent / name), f"{source}: line {line}: {name}")


def _unpacked(body: bytes, wanted: int, source: str) -> bytes:
    """The data of a packed file, checked by its checksum; of longer data one byte more than is wanted."""
    try:
        with gzip.GzipFile(fileobj=io.BytesIO(body)) as packed:
            found = packed.read(wanted)
            return found + packed.read(1)
    except (OSError, EOFError, zlib.error) as error:
        raise VolumeError(f"{source}: the data cannot be unpacked: {str(error).lower()}") from None
