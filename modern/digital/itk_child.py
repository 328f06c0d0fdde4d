"""The separate process in which SimpleITK reads a file. It imports nothing of the project and prints nothing.

The arguments are the format, the path, a folder for the result, the largest number of voxels, and the identifier of a
DICOM series or "". The result is two files: ``array.npy``, in which x varies fastest, and ``facts.json``. This second
file has either an error message, or spacing, origin and direction as text, notes for the user and the names of the
files of a series.
"""

import contextlib
import importlib
import json
import os
import re
import sys
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

READERS = {"NIfTI": "NiftiImageIO", "MetaImage": "MetaImageIO", "TIFF": "TIFFImageIO", "DICOM": "GDCMImageIO"}
_POSITION, _ORIENTATION = "0020|0032", "0020|0037"
# Distances between slices that differ by more than this fraction of their mean are reported.
_UNEVEN = 1e-3
_LONGEST_MESSAGE = 160


class Refused(Exception):
    """Raised for input that cannot be read as a volume; the message is one line for the user."""


def main(arguments: Sequence[str]) -> None:
    kind, path, folder, most, series = arguments
    _limit()
    answer = Path(folder, "facts.json")
    try:
        facts = read(kind, path, Path(folder, "array.npy"), int(most), series)
    except Refused as error:
        facts = {"error": str(error)}
    except MemoryError:
        facts = {"error": "there is not enough memory for this"}
    except Exception as error:
        facts = {"error": f"SimpleITK cannot read the file as {kind}: {_message_of(error)}"}
    answer.write_text(json.dumps(facts), encoding="ascii")


def read(kind: str, path: str, target: Path, most: int, series: str) -> dict[str, Any]:
    """Read an image file, write its voxels to ``target`` as an NPY file, and return the contents of ``facts.json``.

    Raise Refused if the image is not a volume. Errors of SimpleITK are not caught.
    """
    import numpy as np

    sitk: Any = importlib.import_module("SimpleITK")
    sitk.ProcessObject.SetGlobalWarningDisplay(False)
    reader: Any
    notes: list[str] = []
    files: Sequence[str] = ()
    if kind in READERS:
        reader = sitk.ImageFileReader()
        reader.SetImageIO(READERS[kind])
        reader.SetFileName(path)
        reader.ReadImageInformation()
        _check(reader.GetSize(), reader.GetNumberOfComponents(), most)
    else:
        reader = sitk.ImageSeriesReader()
        files = _series(sitk, path, series)
        first = sitk.ImageFileReader()
        first.SetFileName(files[0])
        first.ReadImageInformation()
        _check((*first.GetSize()[:2], len(files)), first.GetNumberOfComponents(), most)
        notes += _uneven(sitk, files)
        reader.SetFileNames(files)
    image = reader.Execute()
    array = sitk.GetArrayViewFromImage(image).T
    size, spacing, origin = image.GetSize(), image.GetSpacing(), image.GetOrigin()
    direction, width = image.GetDirection(), len(size)
    if array.ndim == 4 and size[3] == 1:
        # An image with four axes is a volume if the fourth axis, time, has only one point.
        array, width = array[..., 0], 3
        direction = [direction[4 * row + column] for row in range(3) for column in range(3)]
    if array.ndim not in (2, 3):
        raise Refused(f"expected two or three axes, found {array.ndim} axes, {' x '.join(map(str, size))}")
    np.save(target, array, allow_pickle=False)
    placed = kind != "TIFF"
    if kind == "TIFF" and any(length != 1 for length in spacing[:2]):
        notes.append("the resolution of a TIFF file is not used as the spacing of its voxels")
    unit = "mm" if kind.startswith("DICOM") else ""
    if kind == "NIfTI":
        unit = _nifti(reader, notes)
    texts = {"spacing": spacing[:width], "origin": origin[:width], "direction": direction}
    names = [os.path.basename(name) for name in files]
    return {"placed": placed, "unit": unit, "notes": notes, "files": names} | {
        name: [repr(float(number)) for number in numbers] for name, numbers in texts.items()
    }


def _check(size: Sequence[int], numbers: int, most: int) -> None:
    """Raise Refused, before the data are read, if an image is not a volume with one number for each voxel."""
    count = 1
    for side in size:
        count *= side
    sides = " x ".join(map(str, size))
    if count > most:
        raise Refused(f"expected at most {most} voxels, found {sides}")
    if numbers != 1:
        raise Refused(f"expected one number for each voxel, found {numbers}")
    if len(size) > 4 or (len(size) == 4 and size[3] != 1):
        raise Refused(f"expected two or three axes, found {len(size)} axes, {sides}")


def _nifti(reader: Any, notes: list[str]) -> str:
    """Return "mm" if a NIfTI file states a unit of length, otherwise "". SimpleITK converts the unit to millimetres.

    Add a note to ``notes`` if the file states no orientation.
    """
    metadata = {key: reader.GetMetaData(key) for key in reader.GetMetaDataKeys()}
    if metadata.get("qform_code") == "0" and metadata.get("sform_code") == "0":
        notes.append("the file states no orientation (qform and sform are 0)")
    return "mm" if int(metadata.get("xyzt_units", "0") or 0) & 7 else ""


def _series(sitk: Any, folder: str, series: str) -> Sequence[str]:
    identifiers = sitk.ImageSeriesReader.GetGDCMSeriesIDs(folder)
    names: dict[str, Sequence[str]] = {
        name: sitk.ImageSeriesReader.GetGDCMSeriesFileNames(folder, name) for name in identifiers
    }
    listed = "; ".join(f"{name} ({len(files)} files)" for name, files in list(names.items())[:6]) or "none"
    if series:
        if series not in names:
            raise Refused(f"there is no series {series[:70]}; the folder has {listed}")
        return names[series]
    if len(names) != 1:
        raise Refused(f"found {len(names)} DICOM series; select one with --series: {listed}")
    return next(iter(names.values()))


def _uneven(sitk: Any, files: Sequence[str]) -> list[str]:
    """Return a list with a note if the slices of a series are not evenly spaced, otherwise an empty list."""
    positions = []
    normal: list[float] = []
    for name in files:
        reader = sitk.ImageFileReader()
        reader.SetFileName(name)
        reader.ReadImageInformation()
        if not (reader.HasMetaDataKey(_POSITION) and reader.HasMetaDataKey(_ORIENTATION)):
            return ["a slice does not state its position"]
        position, turn = (_floats(reader.GetMetaData(key)) for key in (_POSITION, _ORIENTATION))
        if not normal:
            (a, b, c), (d, e, f) = turn[:3], turn[3:]
            normal = [b * f - c * e, c * d - a * f, a * e - b * d]
        positions.append(sum(x * y for x, y in zip(position, normal, strict=True)))
    gaps = [abs(there - here) for here, there in pairwise(positions)]
    if gaps and max(gaps) - min(gaps) > _UNEVEN * (sum(gaps) / len(gaps)):
        return [f"slices are {min(gaps):.6g} to {max(gaps):.6g} mm apart and are treated as evenly spaced"]
    return []


def _floats(text: str) -> list[float]:
    return [float(word) for word in text.split("\\")]


def _message_of(error: Exception) -> str:
    """Return the essential part of SimpleITK's error message, without locations in its source or in memory."""
    message = " ".join(str(error).split())
    message = re.split(r"(?:itk::|sitk::|ITK )ERROR: ", message)[-1]
    message = re.sub(r"\b\w+\((?:0x)?[0-9a-fA-F]+\): ", "", message)
    message = re.sub(r"(?:/[^\s/]+)+/", "", message)
    message = re.sub(r"\W*Reason: Success\W*$", "", message)  # the operating system's text for "no error"
    return (message or type(error).__name__)[:_LONGEST_MESSAGE]


def _limit() -> None:
    """Disable core dumps and limit memory to that of the machine, because a damaged header may request any amount."""
    with contextlib.suppress(ImportError, OSError, ValueError):
        import resource

        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
        _, hard = resource.getrlimit(resource.RLIMIT_AS)
        least = memory if hard == resource.RLIM_INFINITY else min(memory, hard)
        resource.setrlimit(resource.RLIMIT_AS, (least, hard))


if __name__ == "__main__":
    main(sys.argv[1:])
