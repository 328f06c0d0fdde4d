"""Volumes as the bytes of files, written by hand from the definitions of the formats, and DICOM series."""

import importlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

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


def saved(name: str, data: bytes) -> str:
    Path(name).parent.mkdir(exist_ok=True)
    Path(name).write_bytes(data)
    return name


def dicom_series(values: np.ndarray, folder: str, heights: Sequence[float], uid: str = "1.2.3") -> str:
    """Write a slice at each height along z with SimpleITK, the last slice first. Return the folder."""
    sitk: Any = importlib.import_module("SimpleITK")

    Path(folder).mkdir(exist_ok=True)
    writer = sitk.ImageFileWriter()
    writer.KeepOriginalImageUIDOn()
    for number, height in reversed(list(enumerate(heights))):
        image = sitk.GetImageFromArray(values[:, :, number].T)
        image.SetSpacing((0.5, 0.25))
        position = {"0020|0032": f"-10\\20\\{height}", "0020|0037": "1\\0\\0\\0\\1\\0", "0020|0013": str(number)}
        names = {"0008|0060": "CT", "0020|000e": uid, "0020|000d": "1.2", "0008|0018": f"{uid}.{number + 1}"}
        for key, value in {**position, **names, "0028|1052": "0", "0028|1053": "1"}.items():
            image.SetMetaData(key, value)
        writer.SetFileName(f"{folder}/{uid}-{number}.dcm")
        writer.Execute(image)
    return folder
