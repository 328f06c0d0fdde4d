"""Volumes by SimpleITK (the extra ``volumes``): NIfTI, MetaImage, TIFF, and DICOM files or a folder with a series.

The library runs in a process of its own, ``itk_child.py``: whatever it prints is kept from the user, whatever becomes
of it (an error, a crash, no end) is one line here.  The array comes back as an NPY file of a temporary folder, spacing,
origin and directions as the shortest decimal text that names each double, and are exact from there on.
"""

from __future__ import annotations

import importlib.util
import json
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from emulator.files import read_bytes, reason
from modern.digital.scans import Scan
from modern.digital.solids import MAX_CELLS, VolumeError
from modern.digital.world import LPS, Position, World, length_text

SERIES = "DICOM series"
KINDS = {
    ".nii": "NIfTI",
    ".nii.gz": "NIfTI",
    ".mha": "MetaImage",
    ".mhd": "MetaImage",
    ".tif": "TIFF",
    ".tiff": "TIFF",
    ".dcm": "DICOM",
}
"""What a file is by the ending of its name."""
LIMIT = 60
"""Seconds a file may take to be read, and one more for each megabyte."""
_CHILD = str(Path(__file__).with_name("itk_child.py"))
_DICOM = (128, b"DICM")


def kind_of(path: str) -> str | None:
    """What SimpleITK reads a path as, None for what is read otherwise.  A folder is a DICOM series."""
    if path == "-" or "\0" in path:
        return None
    if os.path.isdir(path):
        return SERIES
    return next((kind for ending, kind in KINDS.items() if path.lower().endswith(ending)), None)


def read_itk(path: str, kind: str, series: str | None = None) -> Scan:
    """The scan of a file or a folder by SimpleITK, indexed [x, y] or [x, y, z]; see ``kind_of``.

    series: the identifier of one of several DICOM series in the folder.  Positions are those of the library: LPS, in
    millimetres where the format says so; a TIFF file has none.

    Raises FileError for a file that cannot be read, VolumeError where SimpleITK is not installed, says that it cannot
    read the file, crashes, or takes longer than ``LIMIT`` allows; where a voxel has several numbers, and for more than
    ``MAX_CELLS`` voxels.
    """
    if kind == SERIES:
        _check_folder(path)
    else:
        _check_file(path)
    if importlib.util.find_spec("SimpleITK") is None:
        raise VolumeError(f"{path}: {kind} is read by SimpleITK: pip install 'hull1620[volumes]'")
    with tempfile.TemporaryDirectory(prefix="hull1620-") as folder:
        seconds = LIMIT + _bytes(path) // 10**6
        code = _run([kind, os.path.abspath(path), folder, str(MAX_CELLS), series or ""], path, seconds)
        facts = _facts(Path(folder, "facts.json"))
        if code != 0 or facts is None:
            raise VolumeError(f"{path}: SimpleITK {_ended(code)} while it read the file")
        if "error" in facts:
            raise VolumeError(f"{path}: {_plain(facts['error'])}")
        array = np.load(Path(folder, "array.npy"), allow_pickle=False)
    notes = tuple(f"{path}: {_plain(note)}" for note in facts["notes"])
    return Scan(array, (0,) * array.ndim, path, _world(facts, path), notes)


def _check_file(path: str) -> None:
    """Refuse a file that cannot be opened, in the words of all files.  Raises FileError."""
    try:
        with open(path, "rb"):
            return
    except (OSError, ValueError):
        read_bytes(path)


def _check_folder(path: str) -> None:
    """Refuse a folder without DICOM files, which have their mark after 128 bytes.  Raises VolumeError."""
    place, mark = _DICOM
    try:
        with os.scandir(path) as entries:
            for entry in entries:
                if entry.is_file():
                    with open(entry.path, "rb") as file:
                        if file.read(place + len(mark))[place:] == mark:
                            return
    except OSError as error:
        raise VolumeError(f"{path}: {reason(error)}") from None
    raise VolumeError(f"{path}: is a directory without a DICOM file; a volume is a file, or a folder with a series")


def _bytes(path: str) -> int:
    """How much there is to read: the file, all of a folder, or of the folder where a header's data may lie."""
    try:
        if path.lower().endswith(".mhd"):
            path = os.path.dirname(os.path.abspath(path))
        if not os.path.isdir(path):
            return os.path.getsize(path)
        with os.scandir(path) as entries:
            return sum(entry.stat().st_size for entry in entries if entry.is_file())
    except OSError:
        return 0


def _run(words: Sequence[str], path: str, seconds: float) -> int:
    """Run the child to its end; its exit code, negative for a signal.  Raises VolumeError where it takes too long."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), "ITK_GLOBAL_DEFAULT_NUMBER_OF_THREADS": "1"}
    command = [sys.executable, "-P", "-W", "ignore", _CHILD, *words]
    try:
        done = subprocess.run(
            command,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            timeout=seconds,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise VolumeError(f"{path}: SimpleITK has not read it within {seconds} seconds") from None
    except OSError as error:
        raise VolumeError(f"{path}: a process for SimpleITK cannot be started: {reason(error)}") from None
    return done.returncode


def _facts(path: Path) -> dict[str, Any] | None:
    """What the child wrote down, None where it did not come to that."""
    try:
        found: dict[str, Any] = json.loads(path.read_text(encoding="ascii"))
    except (OSError, ValueError):
        return None
    return found


def _ended(code: int) -> str:
    if code >= 0:
        return f"ended with exit code {code}"
    try:
        return f"crashed ({signal.Signals(-code).name})"
    except ValueError:
        return f"crashed (signal {-code})"


def _world(facts: dict[str, Any], path: str) -> World | None:
    """The place by spacing, origin and the matrix whose columns are the axes' directions."""
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


def _plain(words: str) -> str:
    """Words of a library on one line, without what a terminal would take for a command."""
    return " ".join("".join(c if c.isprintable() else " " for c in words).split())
