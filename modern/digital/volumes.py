"""Read volumes from files, create digital balls by name, and write arrays.

This module reads NPY, NPZ, NRRD, raw data and lists of coordinates. SimpleITK (the extra ``volumes``) reads NIfTI,
MetaImage, TIFF and DICOM, see :mod:`modern.digital.itk`. In an array, the coordinates of a voxel are its indices from
0, in the order x, y, z.
"""

import os
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from emulator.errors import FileError, expect, quoted
from emulator.files import VOLUME_LIMIT, read_bytes, source_name, writing_bytes
from modern.digital.arrays import NPY, NPZ, parse_npy, parse_npz, parse_raw
from modern.digital.itk import SERIES, kind_of, read_itk
from modern.digital.nrrd import MAGIC, parse_nrrd, write_nrrd
from modern.digital.scans import Choice, Scan, chosen
from modern.digital.solids import DIGITS, VERTEX, VOXEL, Volume, VolumeError, ball, half_ball, listed
from modern.digital.world import world_of
from modern.formats.csv import rows
from modern.formats.points import surface_kind
from modern.geometry.numbers import real

# The file name extensions of arrays that can be written.
ARRAYS = (".npy", ".nrrd")
_BALL = re.compile(r"(half-)?ball:([0-9]{1,9})(?::(voxel|vertex))?", re.ASCII)
_INTEGER = re.compile(r"[+-]?[0-9]+", re.ASCII)
_EXAMINED = 1 << 16
_PAIR = (".hdr", ".img", ".hdr.gz", ".img.gz")


@dataclass(frozen=True, slots=True)
class Stated:
    """Facts about a file that the user states because the file does not contain them; the parameters of
    ``read_volume``.

    If only the shape of raw data is given, their type is ``uint8``.
    """

    shape: Sequence[int] | None = None
    dtype: str | None = None
    array: str | None = None
    series: str | None = None
    spacing: Sequence[object] | None = None
    origin: Sequence[object] | None = None


def read_volume(
    path: str | os.PathLike[str],
    shape: Sequence[int] | None = None,
    dtype: str | None = None,
    *,
    threshold: object = None,
    labels: Sequence[int] = (),
    spacing: Sequence[object] | None = None,
    origin: Sequence[object] | None = None,
    array: str | None = None,
    series: str | None = None,
) -> Volume:
    """Return the voxels of a file (``-`` for standard input), of a folder with a DICOM series, or of a ball.

    ``ball:32`` is the name of a ball of diameter 32.

    Parameters
    ----------
    shape, dtype
        The shape and type of a file of raw data, in which x varies fastest.
    threshold
        A number. Voxels with at least this value belong to the solid.
    labels
        The values of voxels that belong to the solid. Without a threshold or labels, these are all values except 0.
    spacing, origin
        The position of voxels, for a file that does not state it: one number for each axis, as in ``world_of``.
    array
        The name of one of several arrays in an NPZ file.
    series
        The identifier of one of several series in a folder.

    Raises
    ------
    FileError
        The file cannot be read.
    VolumeError
        The volume is invalid.
    """
    expect(path, (str, os.PathLike), "path")
    stated = Stated(None if shape is None else tuple(shape), dtype, array, series, spacing, origin)
    try:
        least = None if threshold is None else Fraction(real(threshold))
    except ValueError as error:
        raise VolumeError(f"threshold: {error}") from None
    return chosen(read_scan(os.fspath(path), stated), Choice(least, tuple(labels))).volume


def read_scan(path: str, stated: Stated | None = None) -> Scan:
    """Return the values in a file, a DICOM folder or a named ball, from which the caller can select voxels.

    For ``path`` and the errors raised, see ``read_volume``.
    """
    stated = stated or Stated()
    ball_name = _BALL.fullmatch(path)
    if ball_name:
        if stated.shape is not None or stated.dtype is not None:
            what = "a generated ball (ball:N or half-ball:N)"
            raise VolumeError(f"{path}: --shape and --dtype are for raw data and cannot be used with {what}")
        make, default = (half_ball, VERTEX) if ball_name[1] else (ball, VOXEL)
        return _with_position(_scan(make(int(ball_name[2]), ball_name[3] or default)), stated)
    if re.match(r"(half-)?ball:", path) and not os.path.exists(path):
        raise VolumeError(
            f"{path}: expected ball:DIAMETER or half-ball:DIAMETER, optionally with :voxel or :vertex for its centre"
        )
    is_raw = stated.shape is not None or stated.dtype is not None
    kind = None if is_raw else kind_of(path)
    if stated.series is not None and kind != SERIES:
        raise VolumeError(f"{path}: a series can be selected only in a folder of DICOM files")
    if kind is not None:
        return _with_position(read_itk(path, kind, stated.series), stated)
    return _with_position(_parsed(read_bytes(path, limit=VOLUME_LIMIT), source_name(path), stated), stated)


def write_array(path: str, array: NDArray[np.bool_], volume: Volume) -> None:
    """Write truth values as NRRD, which stores the position of ``volume``, or as NPY, which does not.

    Raise FileError if the file cannot be written. Raise VolumeError for another file name extension, or as
    ``write_nrrd`` does.
    """
    if path.lower().endswith(".nrrd"):
        write_nrrd(path, array, volume)
    elif path.lower().endswith(".npy"):
        with writing_bytes(path) as file:
            np.save(file, array, allow_pickle=False)
    else:
        raise VolumeError(f"{path}: the name must end with {' or '.join(ARRAYS)}")


def _parsed(data: bytes, source: str, stated: Stated) -> Scan:
    if stated.shape is not None or stated.dtype is not None:
        return _of_array(parse_raw(data, source, stated.shape, stated.dtype or "uint8"), source)
    if stated.array is not None and not data.startswith(NPZ):
        raise VolumeError(f"{source}: an array can be selected only in an NPZ file")
    if data.startswith(NPY):
        return _of_array(parse_npy(data, source), source)
    if data.startswith(NPZ):
        return _of_array(parse_npz(data, source, stated.array), source)
    if data.startswith(MAGIC):
        return parse_nrrd(data, source)
    try:
        text = None if b"\0" in data[:_EXAMINED] else data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = None
    if text is None and source.lower().endswith(_PAIR):
        raise VolumeError(
            f"{source}: a pair of files .hdr and .img (NIfTI or Analyze) is not supported; convert it to one .nii file"
        )
    if text is None:
        raise VolumeError(f"{source}: not NPY, NRRD or UTF-8 text; raw data need --shape NX,NY,NZ")
    # Without this test, the heading of a mesh would be read as a heading of columns and its counts as a voxel.
    if _is_mesh(data, source):
        raise VolumeError(
            f"{source}: expected voxels, found a mesh (OFF, OBJ, PLY or STL); hull1620 export finds its hull"
        )
    return _scan(_listed(text, source))


def _is_mesh(data: bytes, source: str) -> bool:
    try:
        return bool(surface_kind(data, source))
    except FileError:
        return False


def _of_array(array: NDArray[Any], source: str) -> Scan:
    return Scan(array, (0,) * array.ndim, source)


def _scan(volume: Volume) -> Scan:
    return Scan(volume.array, volume.origin, volume.source, volume.world, volume.notes)


def _with_position(scan: Scan, stated: Stated) -> Scan:
    """Return a scan at the position that the user states. Raise VolumeError if the file states a position too."""
    if stated.spacing is None and stated.origin is None:
        return scan
    if scan.world is not None:
        raise VolumeError(
            f"{scan.source}: the file states the position of its voxels; spacing and origin cannot be given"
        )
    for number in stated.spacing or ():
        if str(number).startswith("-"):
            raise VolumeError(f"{scan.source}: spacing: expected positive numbers, found {number}")
    try:
        return replace(scan, world=world_of(scan.values.ndim, stated.spacing, stated.origin))
    except VolumeError as error:
        raise VolumeError(f"{scan.source}: {error}") from None


def _listed(text: str, source: str) -> Volume:
    """Return the voxels of a text that has a line ``x,y,z`` or ``x,y`` for each voxel."""
    voxels: list[tuple[int, ...]] = []
    for line, row in rows(text, source):
        if len(row) not in (2, 3) or (voxels and len(row) != len(voxels[0])):
            expected = f"{len(voxels[0])}" if voxels else "3 (x,y,z) or 2 (x,y)"
            raise VolumeError(f"{source}: line {line}, column 1: expected {expected} fields, found {len(row)}")
        for field, text in enumerate(row, 1):
            if not _INTEGER.fullmatch(text.strip()):
                raise VolumeError(f"{source}: line {line}, field {field}: {quoted(text.strip())} is not an integer")
            if len(text.strip().lstrip("+-")) > DIGITS:
                raise VolumeError(f"{source}: line {line}, field {field}: more than {DIGITS} digits")
        voxels.append(tuple(int(text) for text in row))
    return listed(voxels, source)
