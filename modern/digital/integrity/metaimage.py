"""Check the header of a MetaImage file (``.mha``, ``.mhd``), and the length and the checksum of its data.

The data follow the header (``ElementDataFile = LOCAL``), or the header names one or more files: one name, the word
``LIST`` with one name on each following line, or a pattern ``NAME%03d.raw FIRST LAST STEP``. If a list is too short,
SimpleITK returns uninitialised memory.
"""

import math
import os
import re
from collections.abc import Mapping
from pathlib import Path

from emulator.errors import quoted
from emulator.files import reason
from modern.digital.integrity.streams import check_compressed, check_length, check_sizes, outside_note
from modern.digital.solids import VolumeError

# The number of bytes of a value, by the name of its type.
_INTEGERS = {"CHAR": 1, "SHORT": 2, "INT": 4, "LONG": 4, "LONG_LONG": 8}
_BYTES = {f"MET_{sign}{name}": size for name, size in _INTEGERS.items() for sign in ("", "U")}
_BYTES |= {"MET_FLOAT": 4, "MET_DOUBLE": 8}
_FIELD = re.compile(rb"\s*(\w+)\s*[=:]\s*(.*?)\s*", re.DOTALL)
_INTEGER = re.compile(r"-?[0-9]{1,18}", re.ASCII)
_PATTERN = re.compile(r"([^%]*%(?:0?[0-9])?d[^%]*?)((?:\s+[0-9]{1,9})*)", re.ASCII)
_DATA = "ElementDataFile"
_FLAGS = {"True": True, "true": True, "1": True, "False": False, "false": False, "0": False}
_LONGEST_HEADER = 1 << 20


def check_metaimage(path: str) -> tuple[tuple[int, ...], str]:
    """Return the number of voxels along each axis, and a note, which is "" if all data are in the header's folder.

    Raise VolumeError if the header or the data are damaged.
    """
    with open(path, "rb") as file:
        head = file.read(_LONGEST_HEADER)
    fields, local = _fields(head, path)
    axes = _integer(fields, "NDims", path)
    sizes = tuple(_integers(fields, "DimSize", path))
    if len(sizes) != axes:
        raise VolumeError(f"{path}: DimSize: expected {axes} sizes, found {len(sizes)}")
    check_sizes(path, sizes)
    if not _flag(fields, "BinaryData", path, "BinaryData" not in fields):
        raise VolumeError(f"{path}: BinaryData = False (numbers as text) is not supported; save it as binary data")
    if fields.get("ElementType") not in _BYTES:
        raise VolumeError(f"{path}: ElementType: {quoted(fields.get('ElementType', ''))} is not supported")
    size = _BYTES[fields["ElementType"]] * _integer(fields, "ElementNumberOfChannels", path, 1)
    name = fields[_DATA]
    if name in ("LOCAL", "Local", "local"):
        _check_data(path, path, local, math.prod(sizes) * size, fields)
        return sizes, ""
    names, axes_of_file = [name], axes
    if name.startswith("LIST"):
        names, axes_of_file = _listed(head[local:], name, sizes, path)
    elif "%" in name:
        names, axes_of_file = _numbered(name, sizes, path), axes - 1
    if len(names) > 1 and _flag(fields, "CompressedData", path):
        raise VolumeError(f"{path}: compressed data in several files are not supported")
    for data in names:
        source = f"{path}: {data[:80]}"
        _check_data(source, str(Path(path).absolute().parent / data), 0, math.prod(sizes[:axes_of_file]) * size, fields)
    return sizes, next(filter(None, (outside_note(path, data) for data in names)), "")


def _check_data(source: str, path: str, start: int, expected: int, fields: Mapping[str, str]) -> None:
    """Check one file of data. The data begin at byte ``start`` unless the header states their position."""
    skipped = _integer(fields, "HeaderSize", source, 0)
    is_packed = _flag(fields, "CompressedData", source)
    try:
        if os.path.exists(path) and not os.path.isfile(path):
            raise VolumeError(f"{source}: expected a regular file")
        with open(path, "rb") as file:
            available = os.fstat(file.fileno()).st_size
            if skipped < 0 and is_packed:
                raise VolumeError(f"{source}: HeaderSize = {skipped} is not supported for compressed data")
            # HeaderSize counts from the start of the file; -1 means that the data are at its end.
            start = skipped or start
            if skipped < 0:
                start = max(available - expected, 0)
            if not is_packed:
                check_length(source, expected, max(available - start, 0))
                return
            stored = _integer(fields, "CompressedDataSize", source, available - start)
            check_length(source, stored, available - start)
            file.seek(start)
            check_compressed(source, file, stored, expected)
    except OSError as error:
        raise VolumeError(f"{source}: {reason(error)}") from None
    except ValueError:
        raise VolumeError(f"{source}: not a valid file name") from None


def _fields(head: bytes, path: str) -> tuple[dict[str, str], int]:
    """Return the fields of a MetaImage header, and the position after its last line, ``ElementDataFile``."""
    fields: dict[str, str] = {}
    position = 0
    for number, line in enumerate(head.splitlines(keepends=True), 1):
        position += len(line)
        match = _FIELD.fullmatch(line)
        if not match:
            if line.strip():
                raise VolumeError(f"{path}: line {number}: expected a field of a MetaImage header")
            continue
        name, text = match[1].decode("latin-1"), os.fsdecode(match[2])
        if name in fields:
            raise VolumeError(f"{path}: line {number}: duplicate field {name[:40]}")
        fields[name] = text
        if name == _DATA:
            if not line.endswith(b"\n") and len(text.split()) != 1:
                raise VolumeError(f"{path}: line {number}: the last field of the header does not end with a newline")
            return fields, position
    raise VolumeError(f"{path}: the header is truncated: it has no field {_DATA}")


def _listed(lines: bytes, name: str, sizes: tuple[int, ...], path: str) -> tuple[list[str], int]:
    """Return the names of the data files that a header lists, and the number of axes of each file's array."""
    tokens = name.split()
    axes = int(tokens[1]) if len(tokens) == 2 and re.fullmatch("[1-9]", tokens[1], re.ASCII) else len(sizes) - 1
    if tokens[0] != "LIST" or len(tokens) > 2 or not 1 <= axes < len(sizes):
        raise VolumeError(
            f"{path}: {_DATA}: expected LIST and a number of axes below {len(sizes)}, found {quoted(name)}"
        )
    *complete, rest = lines.split(b"\n")
    if rest.strip():
        raise VolumeError(f"{path}: the list of files is truncated: its last line lacks a line break")
    names = [os.fsdecode(line.rstrip()) for line in complete if line.strip()]
    count = math.prod(sizes[axes:])
    if len(names) != count:
        raise VolumeError(f"{path}: expected a list of {count} files, found {len(names)}")
    return names, axes


def _numbered(name: str, sizes: tuple[int, ...], path: str) -> list[str]:
    count = sizes[-1]
    match = _PATTERN.fullmatch(name)
    numbers = [int(word) for word in match[2].split()] if match else []
    first, last, step = numbers if len(numbers) == 3 else (1, count, 1) if not numbers else (0, 0, 0)
    if match is None or step < 1 or len(range(first, last + 1, step)) != count:
        raise VolumeError(f"{path}: {_DATA}: expected NAME%03d FIRST LAST STEP for {count} files, found {quoted(name)}")
    return [match[1] % number for number in range(first, last + 1, step)]


def _flag(fields: Mapping[str, str], name: str, path: str, default: bool = False) -> bool:
    text = fields.get(name)
    if text is None:
        return default
    if text not in _FLAGS:
        raise VolumeError(f"{path}: {name}: expected True or False, found {quoted(text)}")
    return _FLAGS[text]


def _integers(fields: Mapping[str, str], name: str, path: str) -> list[int]:
    numbers = fields.get(name, "").split()
    if not numbers or not all(map(_INTEGER.fullmatch, numbers)):
        raise VolumeError(f"{path}: {name}: expected integers, found {quoted(fields.get(name, 'nothing'))}")
    return [int(number) for number in numbers]


def _integer(fields: Mapping[str, str], name: str, path: str, default: int | None = None) -> int:
    if default is not None and name not in fields:
        return default
    (number, *others) = _integers(fields, name, path)
    if others:
        raise VolumeError(f"{path}: {name}: expected one integer, found {1 + len(others)}")
    return number
