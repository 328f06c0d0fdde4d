"""Volumes as the bytes of files, written by hand from the definitions of the formats."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

PLACE = (
    "space: left-posterior-superior",
    "space directions: (0.5,0,0) (0,-0.5,0) (0,0,2)",
    "space origin: (-10,5,0.25)",
    'space units: "mm" "mm" "mm"',
)
"""Fields of an NRRD header: spacing 0.5 0.5 2 mm, the second axis toward anterior."""
_TYPES = {"uint8": 2, "int16": 4, "float32": 16}
"""The type codes of NIfTI."""


def nrrd(array: np.ndarray, *fields: str) -> bytes:
    """Return an NRRD file of bytes. ``fields`` are additional lines of its header."""
    head = ["NRRD0005", "type: uint8", f"dimension: {array.ndim}", f"sizes: {' '.join(map(str, array.shape))}"]
    return "\n".join([*head, "encoding: raw", *fields, "", ""]).encode() + array.astype(np.uint8).tobytes("F")


def nifti(
    array: np.ndarray, spacing: Sequence[float], origin: Sequence[float], by: str = "sform", units: int = 2
) -> bytes:
    """Return a NIfTI file (nifti1.h) with three axes toward right, anterior and superior.

    ``by`` is ``sform``, ``qform``, or ``none`` for no orientation. ``units`` is 2 for millimetres and 0 for none.
    """
    header = bytearray(352)

    def put(at: int, kind: str, *numbers: float) -> None:
        data = np.array(numbers, kind).tobytes()
        header[at : at + len(data)] = data

    put(0, "<i4", 348)
    put(40, "<i2", 3, *array.shape, 1, 1, 1, 1)
    put(70, "<i2", _TYPES[array.dtype.name], 8 * array.itemsize)
    put(76, "<f4", 1, *spacing, 0, 0, 0, 0)
    put(108, "<f4", 352)
    header[123] = units
    put(252, "<i2", by == "qform", by == "sform")
    put(268, "<f4", *origin)
    for row in range(3):
        put(280 + 16 * row, "<f4", *(spacing[row] * (row == k) for k in range(3)), origin[row])
    header[344:348] = b"n+1\0"
    return bytes(header) + array.astype(array.dtype.newbyteorder("<")).tobytes("F")
