"""Arrays of numbers from the bytes of a file: NPY, NPZ, and bare numbers whose shape and type the user states."""

from __future__ import annotations

import io
import math
import warnings
import zipfile
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.lib import format as npy
from numpy.typing import NDArray

from modern.digital.solids import MAX_CELLS, VolumeError
from modern.geometry.numbers import quoted

NPY, NPZ = b"\x93NUMPY", b"PK\x03\x04"
_SAID = 120
_HEADERS = {(1, 0): npy.read_array_header_1_0, (2, 0): npy.read_array_header_2_0}


def parse_npy(data: bytes, source: str) -> NDArray[Any]:
    """The array of an NPY file; its data are not copied.

    Raises VolumeError for a damaged header, objects, data shorter or longer than the header says, and more than
    ``MAX_CELLS`` numbers.
    """
    file = io.BytesIO(data)
    try:
        with warnings.catch_warnings():
            # The header is read as Python: what Python has to say of it is no word to the user.
            warnings.simplefilter("ignore")
            version = npy.read_magic(file)
            if version not in _HEADERS:
                raise ValueError(f"version {version[0]}.{version[1]} is of arrays of other things")
            shape, across, kind = _HEADERS[version](file)
    except Exception as error:
        # A damaged header ends in whatever error the reading meets: TokenError, IndexError, OverflowError ...
        raise VolumeError(f"{source}: no NPY array of numbers: {_said(error)}") from None
    if kind.kind not in "biufc" or kind.itemsize == 0:
        raise VolumeError(f"{source}: no NPY array of numbers: its type is {quoted(str(kind))}")
    number = math.prod(shape)
    count, found = number * kind.itemsize, len(data) - file.tell()
    if found != count:
        wanted = count if count < 10**18 else "more than 10**18"
        how = f"the data end after {found} of {wanted} bytes" if found < count else f"{found - count} bytes too many"
        raise VolumeError(f"{source}: no NPY array of numbers: {how}")
    check_size(shape, source)
    array = np.frombuffer(data, kind, number, file.tell()) if number else np.empty(0, kind)
    return _true(array).reshape(shape, order="F" if across else "C")


def parse_npz(data: bytes, source: str, name: str | None = None) -> NDArray[Any]:
    """An array of an NPZ file: the one called ``name``, or the only one.

    Raises VolumeError where there are several and none is named, or none of that name; for a damaged file; and as
    ``parse_npy``.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as packed:
            members = {info.filename.removesuffix(".npy"): info for info in packed.infolist()}
            chosen = _member(sorted(members), source, name)
            with packed.open(members[chosen]) as file:
                # Not more than the file says, whatever comes out: one byte beyond is enough to be told.
                size = members[chosen].file_size
                if size > 16 * MAX_CELLS:
                    raise VolumeError(f"{source}: {chosen}: more than {MAX_CELLS} numbers are not read")
                body = file.read(size + 1)
    except VolumeError:
        raise
    except Exception as error:
        raise VolumeError(f"{source}: no NPZ file of arrays: {_said(error)}") from None
    return parse_npy(body, f"{source}: {chosen}")


def _member(names: Sequence[str], source: str, name: str | None) -> str:
    if name is None and len(names) == 1:
        return names[0]
    there = ", ".join(names[:12]) + (", ..." if len(names) > 12 else "")
    if name is None:
        raise VolumeError(f"{source}: {len(names)} arrays; --array names one of them: {there}")
    if name not in names:
        raise VolumeError(f"{source}: there is no array {quoted(name)}, only {there or 'none'}")
    return name


def parse_raw(data: bytes, source: str, shape: Sequence[int] | None, dtype: str) -> NDArray[Any]:
    """Bare numbers, x fastest.  Raises VolumeError for what is no shape or type, and for data of another size."""
    try:
        kind = np.dtype(dtype)
    except (TypeError, ValueError, SyntaxError, OverflowError):  # numpy reads a small language here
        raise VolumeError(
            f"--dtype: {quoted(dtype)} is not a type of numbers; for instance uint8, int16, >i2"
        ) from None
    if kind.kind not in "biuf":
        raise VolumeError(f"--dtype: {kind} is not a type of numbers; for instance uint8, int16, >i2")
    if shape is None:
        raise VolumeError("--dtype: bare numbers need --shape NX,NY,NZ too")
    if len(shape) not in (2, 3) or min(shape) < 1:
        raise VolumeError("--shape: two or three numbers from 1 on, NX,NY,NZ")
    check_size(shape, source)
    wanted = math.prod(shape) * kind.itemsize
    if wanted != len(data):
        size = "x".join(map(str, shape))
        raise VolumeError(f"{source}: {len(data)} bytes; {size} numbers of {kind} are {wanted} bytes")
    return _true(np.frombuffer(data, kind)).reshape(tuple(shape), order="F")


def check_size(shape: Sequence[int], source: str) -> None:
    """Refuse more than ``MAX_CELLS`` voxels.  Raises VolumeError, which names the limit."""
    if min(shape, default=0) < 0:
        raise VolumeError(f"{source}: a shape of {quoted(str(tuple(shape)))}")
    if max(math.prod(shape), *shape, 0) > MAX_CELLS:
        size = " x ".join(map(str, shape))
        raise VolumeError(f"{source}: {size if len(size) < 80 else 'these'} voxels; at most {MAX_CELLS} are read")


def _true(array: NDArray[Any]) -> NDArray[Any]:
    """Truth values of bytes 0 and 1, which numpy takes for granted."""
    return array.view(np.uint8) != 0 if array.dtype == np.bool_ else array


def _said(error: Exception) -> str:
    """The words of an error on one line, cut to a readable length."""
    words = " ".join(str(error).split()) or type(error).__name__
    return words[:_SAID]
