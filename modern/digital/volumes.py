"""Volumes from files: coordinate lists as CSV, NPY and NRRD arrays, raw arrays; and from names of digital balls.

Of an array every voxel whose value is not 0 belongs to the set; its coordinates are its indices from 0, axes in the
order x, y, z.  A coordinate list keeps the coordinates it states.
"""

from __future__ import annotations

import io
import math
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from emulator.files import read_bytes, source_name, writing_bytes
from modern.digital.nrrd import MAGIC, parse_nrrd
from modern.digital.solids import DIGITS, VERTEX, VOXEL, Volume, VolumeError, ball, half_ball, listed
from modern.formats.csv import rows
from modern.geometry.numbers import shown

__all__ = [
    "VERTEX",
    "VOXEL",
    "Volume",
    "VolumeError",
    "ball",
    "half_ball",
    "listed",
    "parse_volume",
    "read_volume",
    "write_npy",
]

_BALL = re.compile(r"(half-)?ball:([0-9]{1,9})(?::(voxel|vertex))?", re.ASCII)
_WHOLE = re.compile(r"[+-]?[0-9]+", re.ASCII)
_LOOKED_AT = 1 << 16
_NPY = b"\x93NUMPY"


def read_volume(path: str, shape: Sequence[int] | None = None, dtype: str | None = None) -> Volume:
    """A volume by the name of a file (``-``: standard input) or of a ball: ``ball:32``, ``half-ball:18:vertex``.

    shape, dtype: of a file of bare numbers, x fastest (``uint8`` where only the shape is given).  Other files say
    themselves what they are.  Raises FileError for a file that cannot be read, VolumeError for an invalid volume.
    """
    named = _BALL.fullmatch(path)
    if named:
        if shape is not None or dtype is not None:
            raise VolumeError(f"{path}: a ball has no --shape and no --dtype")
        make, default = (half_ball, VERTEX) if named[1] else (ball, VOXEL)
        return make(int(named[2]), named[3] or default)
    if re.match(r"(half-)?ball:", path) and not Path(path).exists():
        raise VolumeError(f"{path}: a ball is ball:DIAMETER, half-ball:DIAMETER, with :voxel or :vertex for its centre")
    return parse_volume(read_bytes(path), source_name(path), shape, dtype)


def parse_volume(data: bytes, source: str, shape: Sequence[int] | None = None, dtype: str | None = None) -> Volume:
    """A volume from the bytes of a file; see ``read_volume``."""
    if shape is not None or dtype is not None:
        return _of_array(_raw(data, source, shape, dtype or "uint8"), source)
    if data.startswith(_NPY):
        return _of_array(_npy(data, source), source)
    if data.startswith(MAGIC):
        return _of_array(parse_nrrd(data, source), source)
    if b"\0" in data[:_LOOKED_AT]:
        raise VolumeError(f"{source}: neither NPY nor NRRD nor text in UTF-8; bare numbers need --shape NX,NY,NZ")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise VolumeError(
            f"{source}: neither NPY nor NRRD nor text in UTF-8; bare numbers need --shape NX,NY,NZ"
        ) from None
    return _listed(text, source)


def write_npy(path: str, array: NDArray[Any]) -> None:
    """Write an array as NPY (``-``: standard output), whole or not at all.  Raises FileError."""
    with writing_bytes(path) as file:
        np.save(file, array, allow_pickle=False)


def _of_array(array: NDArray[Any], source: str) -> Volume:
    if array.dtype.kind not in "biuf" or array.ndim not in (2, 3):
        raise VolumeError(
            f"{source}: an array of {array.dtype} with {array.ndim} axes; a volume has numbers or truth values, "
            "and two or three axes"
        )
    if array.dtype.kind == "f" and np.isnan(array).any():
        raise VolumeError(f"{source}: a value is not a number (nan), so that nobody can say whether the voxel belongs")
    truth = array if array.dtype == np.bool_ else array != 0
    if not truth.any():
        raise VolumeError(f"{source}: there are no voxels: every value is 0")
    return Volume(truth, (0,) * array.ndim, source)


def _npy(data: bytes, source: str) -> NDArray[Any]:
    try:
        return np.asarray(np.load(io.BytesIO(data), allow_pickle=False))
    except Exception as error:
        # A damaged header ends in whatever error numpy's reader of it meets: TokenError, IndexError, OverflowError ...
        said = " ".join(str(error).split()) or "it cannot be read"
        raise VolumeError(f"{source}: no NPY array of numbers: {said[:120]}") from None


def _raw(data: bytes, source: str, shape: Sequence[int] | None, dtype: str) -> NDArray[Any]:
    try:
        kind = np.dtype(dtype)
    except (TypeError, ValueError, SyntaxError, OverflowError):  # numpy reads a small language here
        raise VolumeError(f"--dtype: {shown(dtype)} is not a type of numbers; for instance uint8, int16, >i2") from None
    if kind.kind not in "biuf":
        raise VolumeError(f"--dtype: {kind} is not a type of numbers; for instance uint8, int16, >i2")
    if shape is None:
        raise VolumeError("--dtype: bare numbers need --shape NX,NY,NZ too")
    if len(shape) not in (2, 3) or min(shape) < 1:
        raise VolumeError("--shape: two or three numbers from 1 on, NX,NY,NZ")
    wanted = math.prod(shape) * kind.itemsize
    if wanted != len(data):
        size = "x".join(map(str, shape))
        raise VolumeError(f"{source}: {len(data)} bytes; {size} numbers of {kind} are {wanted} bytes")
    return np.frombuffer(data, kind).reshape(tuple(shape), order="F")


def _listed(text: str, source: str) -> Volume:
    """The voxels of a list, a line ``x,y,z`` (or ``x,y``) each."""
    found: list[tuple[int, ...]] = []
    for line, row in rows(text, source):
        if len(row) not in (2, 3) or (found and len(row) != len(found[0])):
            due = f"{len(found[0])}" if found else "three, x,y,z (or two, x,y)"
            raise VolumeError(f"{source}: line {line}, column 1: {len(row)} fields; a voxel has {due}")
        for field, word in enumerate(row, 1):
            if not _WHOLE.fullmatch(word.strip()):
                raise VolumeError(f"{source}: line {line}, field {field}: {shown(word.strip())} is not a whole number")
            if len(word.strip().lstrip("+-")) > DIGITS:
                raise VolumeError(f"{source}: line {line}, field {field}: more than {DIGITS} digits")
        found.append(tuple(int(word) for word in row))
    return listed(found, source)
