"""Read arrays of numbers from the bytes of a file: NPY, NPZ, or raw data whose shape and type the user states."""

import io
import math
import warnings
import zipfile
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.lib import format as npy
from numpy.typing import NDArray

from emulator.errors import quoted
from modern.digital.solids import MAX_CELLS, VolumeError

NPY, NPZ = b"\x93NUMPY", b"PK\x03\x04"
_LONGEST_MESSAGE = 120
_HEADERS = {(1, 0): npy.read_array_header_1_0, (2, 0): npy.read_array_header_2_0}


def parse_npy(data: bytes, source: str) -> NDArray[Any]:
    """Return the array of an NPY file without copying its data. Raise VolumeError for a damaged or too large file."""
    file = io.BytesIO(data)
    try:
        with warnings.catch_warnings():
            # numpy reads the header as Python source; warnings about that source would only confuse the user.
            warnings.simplefilter("ignore")
            version = npy.read_magic(file)
            if version not in _HEADERS:
                raise ValueError(f"unsupported version {version[0]}.{version[1]}")
            shape, column_major, kind = _HEADERS[version](file)
    except Exception as error:
        # A damaged header can raise any error: TokenError, IndexError, OverflowError and others.
        raise VolumeError(f"{source}: not an NPY array of numbers: {_message_of(error)}") from None
    if kind.kind not in "biufc" or kind.itemsize == 0:
        raise VolumeError(f"{source}: not an NPY array of numbers: its type is {quoted(str(kind))}")
    number = math.prod(shape)
    count, available = number * kind.itemsize, len(data) - file.tell()
    if available != count:
        expected = count if count < 10**18 else "more than 10**18"
        raise VolumeError(f"{source}: not an NPY array of numbers: expected {expected} bytes, found {available}")
    check_size(shape, source)
    array = np.frombuffer(data, kind, number, file.tell()) if number else np.empty(0, kind)
    return _as_truth(array).reshape(shape, order="F" if column_major else "C")


def parse_npz(data: bytes, source: str, name: str | None = None) -> NDArray[Any]:
    """Return the array called ``name`` of an NPZ file, or its only array if ``name`` is None.

    Raise VolumeError if the file has no such array, if it has several arrays and ``name`` is None, and in the cases in
    which ``parse_npy`` raises it.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as packed:
            members = {info.filename.removesuffix(".npy"): info for info in packed.infolist()}
            array_name = _member(sorted(members), source, name)
            with packed.open(members[array_name]) as file:
                # A damaged file may unpack to any size. Reading one byte more than the header states shows the damage.
                size = members[array_name].file_size
                if size > 16 * MAX_CELLS:
                    raise VolumeError(f"{source}: {array_name}: expected at most {MAX_CELLS} numbers")
                body = file.read(size + 1)
    except VolumeError:
        raise
    except Exception as error:
        raise VolumeError(f"{source}: not an NPZ file of arrays: {_message_of(error)}") from None
    return parse_npy(body, f"{source}: {array_name}")


def _member(names: Sequence[str], source: str, name: str | None) -> str:
    if name is None and len(names) == 1:
        return names[0]
    names_text = ", ".join(names[:12]) + (", ..." if len(names) > 12 else "")
    if name is None:
        raise VolumeError(f"{source}: found {len(names)} arrays; select one with --array: {names_text}")
    if name not in names:
        raise VolumeError(f"{source}: there is no array {quoted(name)}; the file has {names_text or 'none'}")
    return name


def parse_raw(data: bytes, source: str, shape: Sequence[int] | None, dtype: str) -> NDArray[Any]:
    """Return the array in a file of raw data, in which x varies fastest.

    Raise VolumeError if the shape or the type is invalid or does not match the number of bytes.
    """
    try:
        kind = np.dtype(dtype)
    except (TypeError, ValueError, SyntaxError, OverflowError):  # numpy parses structured types too
        raise VolumeError(
            f"--dtype: {quoted(dtype)} is not a type of numbers; examples are uint8, int16, >i2"
        ) from None
    if kind.kind not in "biuf":
        raise VolumeError(f"--dtype: {kind} is not a type of numbers; examples are uint8, int16, >i2")
    if shape is None:
        raise VolumeError("--dtype: raw data also need --shape NX,NY,NZ")
    if len(shape) not in (2, 3) or min(shape) < 1:
        raise VolumeError("--shape: expected two or three positive integers NX,NY,NZ")
    check_size(shape, source)
    expected = math.prod(shape) * kind.itemsize
    if expected != len(data):
        size = "x".join(map(str, shape))
        raise VolumeError(f"{source}: expected {expected} bytes for {size} numbers of {kind}, found {len(data)}")
    return _as_truth(np.frombuffer(data, kind)).reshape(tuple(shape), order="F")


def check_size(shape: Sequence[int], source: str) -> None:
    """Raise VolumeError for a volume of this shape if it has more than ``MAX_CELLS`` voxels."""
    if min(shape, default=0) < 0:
        raise VolumeError(f"{source}: invalid shape {quoted(str(tuple(shape)))}")
    if max(math.prod(shape), *shape, 0) > MAX_CELLS:
        size = " x ".join(map(str, shape))
        raise VolumeError(f"{source}: expected at most {MAX_CELLS} voxels, found {size if len(size) < 80 else 'more'}")


def _as_truth(array: NDArray[Any]) -> NDArray[Any]:
    """Convert the bytes of truth values to 0 and 1. A file may hold other bytes, but numpy assumes 0 or 1."""
    return array.view(np.uint8) != 0 if array.dtype == np.bool_ else array


def _message_of(error: Exception) -> str:
    message = " ".join(str(error).split()) or type(error).__name__
    return message[:_LONGEST_MESSAGE]
