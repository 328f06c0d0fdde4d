"""Volumes from files, and from names of digital balls: which file is read how, and the files that are written.

NPY, NPZ, NRRD, bare numbers and lists of coordinates are read here; NIfTI, MetaImage, TIFF and DICOM by SimpleITK (the
extra ``volumes``), see :mod:`modern.digital.itk`.  Coordinates of an array's voxels are its indices from 0, axes in the
order x, y, z; a list of coordinates keeps those it states.
"""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from emulator.files import read_bytes, source_name, writing_bytes
from modern.digital.arrays import NPY, NPZ, parse_npy, parse_npz, parse_raw
from modern.digital.itk import SERIES, kind_of, read_itk
from modern.digital.nrrd import MAGIC, parse_nrrd, write_nrrd
from modern.digital.scans import Choice, Scan, chosen
from modern.digital.solids import DIGITS, VERTEX, VOXEL, Volume, VolumeError, ball, half_ball, listed
from modern.digital.world import world_of
from modern.formats.csv import rows
from modern.geometry.numbers import quoted, real

__all__ = [
    "VERTEX",
    "VOXEL",
    "Stated",
    "Volume",
    "VolumeError",
    "ball",
    "half_ball",
    "listed",
    "parse_volume",
    "read_scan",
    "read_volume",
    "write_array",
    "write_npy",
]

ARRAYS = (".npy", ".nrrd")
"""The endings of files a filled hull is written to."""
_BALL = re.compile(r"(half-)?ball:([0-9]{1,9})(?::(voxel|vertex))?", re.ASCII)
_WHOLE = re.compile(r"[+-]?[0-9]+", re.ASCII)
_LOOKED_AT = 1 << 16


@dataclass(frozen=True, slots=True)
class Stated:
    """What a file does not say of itself.

    shape, dtype: of bare numbers, x fastest (``uint8`` where only the shape is given).  array: the name of one of
    several arrays (NPZ).  series: the identifier of one of several DICOM series.  spacing, origin: one number an axis,
    of files that do not say where their voxels lie; see ``world_of``.
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
    """The voxels of a file (``-``: standard input), of a folder with a DICOM series, or of a ball: ``ball:32``.

    shape, dtype: of a file of bare numbers, x fastest.  threshold: values from it up are voxels.  labels: values that
    are voxels.  With neither, all values other than 0.  spacing, origin: of a file that does not say where its voxels
    lie.  array: the name of one of several in an NPZ file.  series: the identifier of one of several in a folder.

    Raises FileError for a file that cannot be read, VolumeError for an invalid volume.
    """
    stated = Stated(None if shape is None else tuple(shape), dtype, array, series, spacing, origin)
    try:
        least = None if threshold is None else Fraction(real(threshold))
    except ValueError as error:
        raise VolumeError(f"threshold: {error}") from None
    return chosen(read_scan(os.fspath(path), stated), Choice(least, tuple(labels))).volume


def read_scan(path: str, stated: Stated | None = None) -> Scan:
    """The values of a file, a folder or a ball, before voxels are chosen; see ``read_volume``."""
    stated = stated or Stated()
    named = _BALL.fullmatch(path)
    if named:
        if stated.shape is not None or stated.dtype is not None:
            raise VolumeError(f"{path}: a ball has no --shape and no --dtype")
        make, default = (half_ball, VERTEX) if named[1] else (ball, VOXEL)
        return _placed(_scan(make(int(named[2]), named[3] or default)), stated)
    if re.match(r"(half-)?ball:", path) and not Path(path).exists():
        raise VolumeError(f"{path}: a ball is ball:DIAMETER, half-ball:DIAMETER, with :voxel or :vertex for its centre")
    bare = stated.shape is not None or stated.dtype is not None
    kind = None if bare else kind_of(path)
    if stated.series is not None and kind != SERIES:
        raise VolumeError(f"{path}: only a folder of DICOM files has a series to name")
    if kind is not None:
        return _placed(read_itk(path, kind, stated.series), stated)
    return _placed(_parsed(read_bytes(path), source_name(path), stated), stated)


def parse_volume(data: bytes, source: str, shape: Sequence[int] | None = None, dtype: str | None = None) -> Volume:
    """The voxels of a file's bytes, those whose value is not 0; see ``read_volume``."""
    return chosen(_parsed(data, source, Stated(shape, dtype))).volume


def write_npy(path: str, array: NDArray[Any]) -> None:
    """Write an array as NPY (``-``: standard output), whole or not at all.  Raises FileError."""
    with writing_bytes(path) as file:
        np.save(file, array, allow_pickle=False)


def write_array(path: str, array: NDArray[np.bool_], volume: Volume) -> None:
    """Write truth values of a volume's shape: as NRRD, which keeps the volume's place, or as NPY, which cannot.

    Raises FileError, and VolumeError for another ending and as ``write_nrrd``.
    """
    if path.lower().endswith(".nrrd"):
        write_nrrd(path, array, volume)
    elif path.lower().endswith(".npy"):
        write_npy(path, array)
    else:
        raise VolumeError(f"{path}: the name must end with {' or '.join(ARRAYS)}")


def _parsed(data: bytes, source: str, stated: Stated) -> Scan:
    if stated.shape is not None or stated.dtype is not None:
        return _of_array(parse_raw(data, source, stated.shape, stated.dtype or "uint8"), source)
    if stated.array is not None and not data.startswith(NPZ):
        raise VolumeError(f"{source}: only an NPZ file has an array to name")
    if data.startswith(NPY):
        return _of_array(parse_npy(data, source), source)
    if data.startswith(NPZ):
        return _of_array(parse_npz(data, source, stated.array), source)
    if data.startswith(MAGIC):
        return parse_nrrd(data, source)
    if b"\0" in data[:_LOOKED_AT]:
        raise VolumeError(f"{source}: neither NPY nor NRRD nor text in UTF-8; bare numbers need --shape NX,NY,NZ")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise VolumeError(
            f"{source}: neither NPY nor NRRD nor text in UTF-8; bare numbers need --shape NX,NY,NZ"
        ) from None
    return _scan(_listed(text, source))


def _of_array(array: NDArray[Any], source: str) -> Scan:
    return Scan(array, (0,) * array.ndim, source)


def _scan(volume: Volume) -> Scan:
    return Scan(volume.array, volume.origin, volume.source, volume.world, volume.notes)


def _placed(scan: Scan, stated: Stated) -> Scan:
    """The scan with the place the user states.  Raises VolumeError where the file states one."""
    if stated.spacing is None and stated.origin is None:
        return scan
    if scan.world is not None:
        raise VolumeError(f"{scan.source}: the file says where its voxels lie; no spacing and origin are taken beside")
    try:
        return replace(scan, world=world_of(scan.values.ndim, stated.spacing, stated.origin))
    except VolumeError as error:
        raise VolumeError(f"{scan.source}: {error}") from None


def _listed(text: str, source: str) -> Volume:
    """The voxels of a list, a line ``x,y,z`` (or ``x,y``) each."""
    found: list[tuple[int, ...]] = []
    for line, row in rows(text, source):
        if len(row) not in (2, 3) or (found and len(row) != len(found[0])):
            due = f"{len(found[0])}" if found else "three, x,y,z (or two, x,y)"
            raise VolumeError(f"{source}: line {line}, column 1: {len(row)} fields; a voxel has {due}")
        for field, word in enumerate(row, 1):
            if not _WHOLE.fullmatch(word.strip()):
                raise VolumeError(f"{source}: line {line}, field {field}: {quoted(word.strip())} is not a whole number")
            if len(word.strip().lstrip("+-")) > DIGITS:
                raise VolumeError(f"{source}: line {line}, field {field}: more than {DIGITS} digits")
        found.append(tuple(int(word) for word in row))
    return listed(found, source)
