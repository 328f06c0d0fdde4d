"""The process in which SimpleITK reads a file: run by path, it imports nothing of ours and says nothing.

Its arguments are the kind of file, the path, a folder for the answer, the most voxels and a series' identifier.  The
answer is ``array.npy``, x fastest, and ``facts.json``: spacing, origin and direction as text, or an ``error``.
"""

from __future__ import annotations

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
_UNEVEN = 1e-3
"""Distances of slices that differ by more than this part of their mean are told."""
_SAID = 160


class Refused(Exception):
    """What the user is told in one line."""


def main(arguments: Sequence[str]) -> None:
    """Read the file, write the answer."""
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
        facts = {"error": f"SimpleITK cannot read it as {kind}: {_said(error)}"}
    answer.write_text(json.dumps(facts), encoding="ascii")


def read(kind: str, path: str, target: Path, most: int, series: str) -> dict[str, Any]:
    """Write the array; what else is known of it.  Raises Refused, and whatever the library raises."""
    import numpy as np

    sitk: Any = importlib.import_module("SimpleITK")
    sitk.ProcessObject.SetGlobalWarningDisplay(False)
    reader: Any
    notes: list[str] = []
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
        # A volume with one moment of time is a volume.
        array, width = array[..., 0], 3
        direction = [direction[4 * row + column] for row in range(3) for column in range(3)]
    if array.ndim not in (2, 3):
        raise Refused(f"{array.ndim} axes, {' x '.join(map(str, size))}; a volume has two or three")
    np.save(target, array, allow_pickle=False)
    placed = kind != "TIFF"
    if kind == "TIFF" and any(length != 1 for length in spacing[:2]):
        notes.append("the resolution of a TIFF file is not taken for the spacing of its voxels")
    unit = "mm" if kind.startswith("DICOM") else ""
    if kind == "NIfTI":
        unit = _nifti(reader, notes)
    texts = {"spacing": spacing[:width], "origin": origin[:width], "direction": direction}
    return {"placed": placed, "unit": unit, "notes": notes} | {
        name: [repr(float(number)) for number in numbers] for name, numbers in texts.items()
    }


def _check(size: Sequence[int], numbers: int, most: int) -> None:
    """Refuse what is no volume before it is read."""
    count = 1
    for side in size:
        count *= side
    sides = " x ".join(map(str, size))
    if count > most:
        raise Refused(f"{sides} voxels; at most {most} are read")
    if numbers != 1:
        raise Refused(f"every voxel has {numbers} numbers; a volume has one")
    if len(size) > 4 or (len(size) == 4 and size[3] != 1):
        raise Refused(f"{len(size)} axes, {sides}; a volume has two or three")


def _nifti(reader: Any, notes: list[str]) -> str:
    """The unit of a NIfTI file, which the library turns into millimetres; a note where it has no orientation."""
    said = {key: reader.GetMetaData(key) for key in reader.GetMetaDataKeys()}
    if said.get("qform_code") == "0" and said.get("sform_code") == "0":
        notes.append("the file states no orientation (qform and sform are 0)")
    return "mm" if int(said.get("xyzt_units", "0") or 0) & 7 else ""


def _series(sitk: Any, folder: str, series: str) -> Sequence[str]:
    """The files of the series in a folder, in their order in space."""
    found = sitk.ImageSeriesReader.GetGDCMSeriesIDs(folder)
    names: dict[str, Sequence[str]] = {
        name: sitk.ImageSeriesReader.GetGDCMSeriesFileNames(folder, name) for name in found
    }
    listed = "; ".join(f"{name} ({len(files)} files)" for name, files in list(names.items())[:6]) or "none"
    if series:
        if series not in names:
            raise Refused(f"there is no series {series[:70]}, only {listed}")
        return names[series]
    if len(names) != 1:
        raise Refused(f"{len(names)} DICOM series; --series names one of them: {listed}")
    return next(iter(names.values()))


def _uneven(sitk: Any, files: Sequence[str]) -> list[str]:
    """A note where the slices are not at equal distances, by their positions along the normal of the first."""
    places = []
    normal: list[float] = []
    for name in files:
        reader = sitk.ImageFileReader()
        reader.SetFileName(name)
        reader.ReadImageInformation()
        if not (reader.HasMetaDataKey(_POSITION) and reader.HasMetaDataKey(_ORIENTATION)):
            return ["a slice does not state its position"]
        place, turn = (_floats(reader.GetMetaData(key)) for key in (_POSITION, _ORIENTATION))
        if not normal:
            (a, b, c), (d, e, f) = turn[:3], turn[3:]
            normal = [b * f - c * e, c * d - a * f, a * e - b * d]
        places.append(sum(x * y for x, y in zip(place, normal, strict=True)))
    gaps = [abs(there - here) for here, there in pairwise(places)]
    if gaps and max(gaps) - min(gaps) > _UNEVEN * (sum(gaps) / len(gaps)):
        return [f"slices lie {min(gaps):.6g} to {max(gaps):.6g} mm apart; they are taken as evenly spaced"]
    return []


def _floats(text: str) -> list[float]:
    """The numbers of a DICOM value."""
    return [float(word) for word in text.split("\\")]


def _said(error: Exception) -> str:
    """The last thing an exception of the library says, without places in its source and in memory."""
    words = " ".join(str(error).split())
    words = re.split(r"(?:itk::|sitk::|ITK )ERROR: ", words)[-1]
    words = re.sub(r"\b\w+\((?:0x)?[0-9a-fA-F]+\): ", "", words)
    words = re.sub(r"(?:/[^\s/]+)+/", "", words)
    return (words or type(error).__name__)[:_SAID]


def _limit() -> None:
    """No core file, and no more memory than the machine has: a damaged header may ask for any."""
    with contextlib.suppress(ImportError, OSError, ValueError):
        import resource

        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
        _, hard = resource.getrlimit(resource.RLIMIT_AS)
        least = memory if hard == resource.RLIM_INFINITY else min(memory, hard)
        resource.setrlimit(resource.RLIMIT_AS, (least, hard))


if __name__ == "__main__":
    main(sys.argv[1:])
