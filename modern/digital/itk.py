"""Read volumes with SimpleITK (the extra ``volumes``): files in NIfTI, MetaImage, TIFF or DICOM, and DICOM series.

The modules of :mod:`modern.digital.integrity` check a file first, because SimpleITK accepts damaged files. SimpleITK
runs in a separate process, ``itk_child.py``. The output of this process is hidden from the user, and its failure (an
error, a crash, a hang) becomes a one-line error message. The process returns the array as an NPY file in a temporary
folder. It returns each double of spacing, origin and directions as the shortest decimal text that identifies the
double. These decimals are treated as exact.
"""

import importlib.util
import json
import os
import signal
import stat
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from emulator.files import read_bytes, reason
from modern.digital.integrity.dicom import Unverifiable, check_dicom, has_signature
from modern.digital.integrity.metaimage import check_metaimage
from modern.digital.integrity.nifti import NiftiHeader, check_nifti, position_notes
from modern.digital.integrity.tiff import check_tiff
from modern.digital.scans import Scan
from modern.digital.solids import MAX_CELLS, VolumeError
from modern.digital.world import LPS, Position, World, length_text

SERIES = "DICOM series"
# The format of a file by the extension of its name.
KINDS = {
    ".nii": "NIfTI",
    ".nii.gz": "NIfTI",
    ".mha": "MetaImage",
    ".mhd": "MetaImage",
    ".tif": "TIFF",
    ".tiff": "TIFF",
    ".dcm": "DICOM",
}
# The number of seconds allowed for reading a file, to which one second is added for each megabyte.
LIMIT = 60
_NO_PIXELS = "expected pixel data, found none"
_NOT_DICOM = "not a DICOM file with the mark DICM"
_CHILD = str(Path(__file__).with_name("itk_child.py"))


def kind_of(path: str) -> str | None:
    """Return the name of the format in which SimpleITK reads a path, or None if another reader is used."""
    if path == "-" or "\0" in path:
        return None
    if os.path.isdir(path):
        return SERIES
    return next((kind for ending, kind in KINDS.items() if path.lower().endswith(ending)), None)


def read_itk(path: str, kind: str, series: str | None = None) -> Scan:
    """Read a file or a folder with SimpleITK into a scan indexed [x, y] or [x, y, z].

    ``series`` identifies one of several DICOM series in a folder. Positions are those of SimpleITK. Their axes point
    left, posterior and superior (LPS), and their unit is the millimetre if the format states a unit. A TIFF file has no
    position. Raise FileError if the file cannot be read. Raise VolumeError if the file is damaged, if a voxel has
    several values, if there are more than ``MAX_CELLS`` voxels, or if SimpleITK is not installed, rejects the file,
    crashes or exceeds the time limit.
    """
    if kind == SERIES:
        _check_folder(path)
    else:
        _check_file(path)
    if importlib.util.find_spec("SimpleITK") is None:
        raise VolumeError(f"{path}: reading {kind} needs SimpleITK: pip install 'hull1620[volumes]'")
    sizes, nifti, outside = _checked(path, kind)
    verdicts = _slices(path) if kind == SERIES else {}
    with tempfile.TemporaryDirectory(prefix="hull1620-") as folder:
        seconds = LIMIT + _bytes(path) // 10**6
        code = _run([kind, os.path.abspath(path), folder, str(MAX_CELLS), series or ""], path, seconds)
        try:
            facts = json.loads(Path(folder, "facts.json").read_text(encoding="ascii"))
        except (OSError, ValueError):
            facts = None
        if code != 0 or facts is None:
            raise VolumeError(f"{path}: SimpleITK {_ended(code)} while it read the file")
        if "error" in facts:
            raise VolumeError(f"{path}: {_plain(facts['error'])}")
        array = np.load(Path(folder, "array.npy"), allow_pickle=False)
    if sizes is not None and _without_ones(array.shape) != _without_ones(sizes):
        stated, returned = (" x ".join(map(str, shape)) for shape in (sizes, array.shape))
        raise VolumeError(f"{path}: the header states {stated} voxels, but SimpleITK returns {returned}")
    notes = [*facts["notes"], *([outside.removeprefix(f"{path}: ")] if outside else [])]
    if kind == SERIES:
        notes += _slice_notes(path, facts["files"], verdicts)
    world = _world(facts, path)
    if nifti is not None:
        notes += [*position_notes(nifti, world), *([nifti.scaling] if nifti.scaling else [])]
    return Scan(array, (0,) * array.ndim, path, world, tuple(f"{path}: {_plain(note)}" for note in notes))


def _checked(path: str, kind: str) -> tuple[Sequence[int] | None, NiftiHeader | None, str]:
    """Check a file for damage. Return its number of voxels along each axis, its NIfTI header, and a note.

    The numbers of voxels are None for a DICOM series, and the header is None for formats other than NIfTI. The note may
    be "". Raise VolumeError if the file is damaged.
    """
    if kind == "NIfTI":
        header = check_nifti(path)
        return header.sizes, header, ""
    if kind == "DICOM":
        pixels, _ = check_dicom(path)
        if pixels is None:
            raise VolumeError(f"{path}: {_NO_PIXELS}")
        return pixels, None, ""
    if kind == "MetaImage":
        sizes, outside = check_metaimage(path)
        return sizes, None, outside
    return (check_tiff(path) if kind == "TIFF" else None), None, ""


def _slices(folder: str) -> dict[str, str]:
    """Check every file of a folder. Return the fault of each file by its name, or "" for an intact image.

    Raise VolumeError for a damaged DICOM file, because SimpleITK may omit it from its series. A file without pixel data
    counts as damaged if it has the same DICOM class (SOP class) as one of the images.
    """
    remarks, classes = {}, {}
    with os.scandir(folder) as entries:
        for entry in sorted(entries, key=lambda entry: entry.name):
            if not entry.is_file() or entry.name.startswith("."):
                continue
            if not (has_signature(entry.path) or entry.name.lower().endswith(".dcm")):
                remarks[entry.name] = _NOT_DICOM
                continue
            try:
                sizes, classes[entry.name] = check_dicom(entry.path)
                remarks[entry.name] = _NO_PIXELS if sizes is None else ""
            except Unverifiable as error:
                remarks[entry.name] = str(error).removeprefix(f"{entry.path}: ")
    images = {classes[name] for name, remark in remarks.items() if not remark}
    for name, remark in remarks.items():
        if remark == _NO_PIXELS and classes[name] in images:
            raise VolumeError(f"{os.path.join(folder, name)}: damaged or truncated: {_NO_PIXELS}")
    return remarks


def _slice_notes(folder: str, used: Sequence[str], remarks: Mapping[str, str]) -> list[str]:
    """Return notes about files that are not part of the image. Raise VolumeError if a used slice has a fault."""
    for name in used:
        remark = remarks.get(name, _NOT_DICOM)
        if remark:
            raise VolumeError(f"{os.path.join(folder, name)}: {remark}")
    notes = []
    for kind, cause in (("DICOM files without pixel data", _NO_PIXELS), ("files that are not DICOM", _NOT_DICOM)):
        left_out = [name for name, remark in remarks.items() if remark == cause and name != "DICOMDIR"]
        if left_out:
            names = ", ".join(left_out[:4]) + (", ..." if len(left_out) > 4 else "")
            notes.append(f"{kind} are left out ({len(left_out)}): {names}")
    return notes


def _without_ones(sizes: Sequence[int]) -> list[int]:
    sides = list(sizes)
    while sides and sides[-1] == 1:
        sides.pop()
    return sides


def _check_file(path: str) -> None:
    try:
        if not stat.S_ISREG(os.stat(path).st_mode):
            raise VolumeError(f"{path}: expected a regular file")
        with open(path, "rb"):
            return
    except (OSError, ValueError):
        read_bytes(path)


def _check_folder(path: str) -> None:
    """Raise VolumeError for a folder in which no file has the signature of DICOM."""
    try:
        with os.scandir(path) as entries:
            if any(entry.is_file() and has_signature(entry.path) for entry in entries):
                return
    except OSError as error:
        raise VolumeError(f"{path}: {reason(error)}") from None
    raise VolumeError(f"{path}: is a directory without a DICOM file; expected a file, or a folder with a DICOM series")


def _bytes(path: str) -> int:
    """Return an upper bound for the number of bytes to read: the size of the file, or of the folder with the data."""
    try:
        if path.lower().endswith(".mhd"):
            path = os.path.dirname(os.path.abspath(path))
        if not os.path.isdir(path):
            return os.path.getsize(path)
        with os.scandir(path) as entries:
            return sum(entry.stat().st_size for entry in entries if entry.is_file())
    except OSError:
        return 0


def _run(arguments: Sequence[str], path: str, seconds: float) -> int:
    """Run ``itk_child.py`` and return its exit code, which is negative if a signal ended the process.

    Raise VolumeError if the process does not end within ``seconds``.
    """
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), "ITK_GLOBAL_DEFAULT_NUMBER_OF_THREADS": "1"}
    command = [sys.executable, "-P", "-W", "ignore", _CHILD, *arguments]
    try:
        process = subprocess.run(
            command,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            timeout=seconds,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise VolumeError(f"{path}: SimpleITK did not read it within {seconds} seconds") from None
    except OSError as error:
        raise VolumeError(f"{path}: a process for SimpleITK cannot be started: {reason(error)}") from None
    return process.returncode


def _ended(code: int) -> str:
    if code >= 0:
        return f"ended with exit code {code}"
    try:
        return f"crashed ({signal.Signals(-code).name})"
    except ValueError:
        return f"crashed (signal {-code})"


def _world(facts: dict[str, Any], path: str) -> World | None:
    """Return the position of the voxels from the spacing, origin and direction matrix that SimpleITK reports."""
    if not facts["placed"]:
        return None
    try:
        spacing, origin, matrix = (tuple(map(length_text, facts[name])) for name in ("spacing", "origin", "direction"))
        width = len(spacing)
        steps: list[Position] = [
            tuple(matrix[width * row + axis] * spacing[axis] for row in range(width)) for axis in range(width)
        ]
        return World(tuple(steps), origin, LPS if width == 3 else "", facts["unit"])
    except (ValueError, VolumeError) as error:
        raise VolumeError(f"{path}: {_plain(str(error))}") from None


def _plain(message: str) -> str:
    """Return a message of SimpleITK as one line, without control characters."""
    return " ".join("".join(c if c.isprintable() else " " for c in message).split())
