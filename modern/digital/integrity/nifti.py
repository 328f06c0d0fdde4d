"""Check the header of a NIfTI-1 image file (nifti1.h), the length of its data, and the agreement of the positions
that it states.

SimpleITK replaces invalid sizes, offsets and spacings. It also applies ``scl_inter`` if ``scl_slope`` is 0, although
the standard says that values are then not scaled. Such headers are rejected. If the positions ``qform`` and ``sform``
differ, or the spacing of ``sform`` differs from ``pixdim``, a note says which of them SimpleITK uses.
"""

import math
import os
import struct
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from modern.digital.integrity.streams import check_length, check_sizes, read_gzip
from modern.digital.solids import MAX_CELLS, VolumeError
from modern.digital.world import World

_HEADER, _FIRST_DATA = 348, 352
_NIFTI_2 = 540
# The number of bits of a value by the code of its type.
_BITS = {2: 8, 256: 8, 4: 16, 512: 16, 128: 24, 8: 32, 16: 32, 768: 32, 2304: 32}
_BITS |= {32: 64, 64: 64, 1024: 64, 1280: 64, 1536: 128, 1792: 128, 2048: 256}
# The number of millimetres in a metre and in a micrometre, by the code of the unit.
_MILLIMETRES = {1: 1000.0, 3: 0.001}
_WIDEST = 16 * MAX_CELLS
_TO_LPS = np.diag([-1.0, -1.0, 1.0])
# Positions that differ by less than this fraction of a voxel are considered equal.
_SAME = 0.01

# Three rows of four numbers: the steps of the axes and the origin, in LPS and millimetres.
Affine = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class NiftiHeader:
    """The contents of a NIfTI header.

    ``sizes`` has the number of voxels along each axis, and ``spacing`` has the distances between neighbouring voxels in
    millimetres. ``forms`` has the two positions of the voxels that a header may state, ``qform`` and ``sform``, as
    affine maps. ``scaling`` is a note if the values are scaled, otherwise "".
    """

    sizes: tuple[int, ...]
    spacing: tuple[float, ...]
    forms: Mapping[str, Affine]
    scaling: str


def check_nifti(path: str) -> NiftiHeader:
    """Check a NIfTI file and return its header. Raise VolumeError if the header or the length of the data is wrong."""
    with open(path, "rb") as file:
        head = file.read(_FIRST_DATA)
        available = os.fstat(file.fileno()).st_size
    is_packed = path.lower().endswith(".gz") and head[:2] == b"\x1f\x8b"
    if is_packed:
        head, _ = read_gzip(path, path, -1, _FIRST_DATA)
    header, first, expected = _parsed(head, path)
    if is_packed:
        _, available = read_gzip(path, path, first + expected, 0)
    check_length(path, expected, max(0, available - first))
    return header


def _parsed(head: bytes, path: str) -> tuple[NiftiHeader, int, int]:
    """Return the header of a NIfTI file, and the position and the length of the data in bytes."""
    order = next((mark for mark in "<>" if head[:4] == struct.pack(f"{mark}i", _HEADER)), "")
    if any(head[:4] == struct.pack(f"{mark}i", _NIFTI_2) for mark in "<>"):
        raise VolumeError(f"{path}: NIfTI-2 is not supported; convert the file to NIfTI-1")
    if head[344:348] == b"ni1\0":
        raise VolumeError(f"{path}: a pair of files .hdr and .img is not supported; convert it to one .nii file")
    if not order or len(head) < _FIRST_DATA or head[344:348] != b"n+1\0":
        raise VolumeError(f"{path}: not a NIfTI-1 file, or its header is damaged or truncated")
    count, *dims = struct.unpack_from(f"{order}8h", head, 40)
    kind, bits = struct.unpack_from(f"{order}2h", head, 70)
    qfac, *spacing, offset, slope, intercept = struct.unpack_from(f"{order}11f", head, 76)
    if not 1 <= count <= 7:
        raise VolumeError(f"{path}: dim[0]: expected 1 to 7 axes, found {count}")
    sizes = tuple(dims[:count])
    check_sizes(path, sizes)
    if _BITS.get(kind) != bits:
        raise VolumeError(f"{path}: datatype {kind} does not have bitpix {bits}, or is not supported")
    if not (offset >= _FIRST_DATA and offset < _WIDEST and offset == int(offset)):
        raise VolumeError(f"{path}: vox_offset: expected an integer of at least {_FIRST_DATA}, found {offset:g}")
    for axis, length in enumerate(spacing[: min(count, 3)], 1):
        if not (length > 0 and math.isfinite(length)):
            raise VolumeError(f"{path}: pixdim[{axis}]: expected a positive number, found {length:g}")
    scaling = _scaling(slope, intercept, path)
    scale = _MILLIMETRES.get(head[123] & 7, 1.0)
    forms = _forms(head, order, qfac, tuple(spacing[:3]), scale, path)
    header = NiftiHeader(sizes, tuple(scale * length for length in spacing[: min(count, 3)]), forms, scaling)
    return header, int(offset), math.prod(sizes) * bits // 8


def _scaling(slope: float, intercept: float, path: str) -> str:
    # A slope of 0 means that values are not scaled, and so does nan, which nibabel writes.
    if slope == 0 or math.isnan(slope):
        if intercept != 0 and not math.isnan(intercept):
            raise VolumeError(
                f"{path}: scl_inter is {intercept:g}, but scl_slope is {slope:g}, so values are not scaled"
            )
        return ""
    if not (math.isfinite(slope) and math.isfinite(intercept)):
        raise VolumeError(f"{path}: scl_slope and scl_inter: expected finite numbers, found {slope:g}, {intercept:g}")
    if (slope, intercept) == (1, 0):
        return ""
    return f"the values are scaled: {slope:g} times the stored value plus {intercept:g} (scl_slope, scl_inter)"


def _forms(
    head: bytes, order: str, qfac: float, spacing: tuple[float, ...], scale: float, path: str
) -> dict[str, Affine]:
    qform_code, sform_code = struct.unpack_from(f"{order}2h", head, 252)
    b, c, d, *offsets = struct.unpack_from(f"{order}6f", head, 256)
    rows = struct.unpack_from(f"{order}12f", head, 280)
    forms: dict[str, Affine] = {}
    if qform_code > 0:
        square = b * b + c * c + d * d
        if not (square < 1.001 and math.isfinite(qfac) and all(map(math.isfinite, offsets))):
            raise VolumeError(f"{path}: qform: expected a unit quaternion and finite numbers")
        # The rotation matrix of the quaternion a + bi + cj + dk. The third axis is reversed if qfac is negative.
        a = math.sqrt(max(0.0, 1 - square))
        rotation = np.array(
            [
                [a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
                [2 * (b * c + a * d), a * a + c * c - b * b - d * d, 2 * (c * d - a * b)],
                [2 * (b * d - a * c), 2 * (c * d + a * b), a * a + d * d - b * b - c * c],
            ]
        )
        steps = rotation * np.array([1.0, 1.0, -1.0 if qfac < 0 else 1.0]) * np.nan_to_num(spacing)
        forms["qform"] = scale * _TO_LPS @ np.column_stack([steps, offsets])
    if sform_code > 0:
        if not all(map(math.isfinite, rows)):
            raise VolumeError(f"{path}: sform: expected finite numbers")
        forms["sform"] = scale * _TO_LPS @ np.array(rows).reshape(3, 4)
    return forms


def position_notes(header: NiftiHeader, world: World | None) -> list[str]:
    """Return notes for the user if the positions in the header disagree.

    ``world`` is the position that SimpleITK returned. The notes name the position in the header, ``qform`` or
    ``sform``, that is nearest to ``world``.
    """
    if world is None or len(world.steps) != 3:
        return []
    used = np.array([[float(number) for number in vector] for vector in (*world.steps, world.origin)]).T
    notes = []
    sform, qform = header.forms.get("sform"), header.forms.get("qform")
    if sform is not None and qform is not None and _distance(sform, qform, header) > 0:
        origin_of = {name: _distance(form, used, header, spacing=False) for name, form in header.forms.items()}
        name = min(origin_of, key=lambda form: origin_of[form])
        notes.append(f"qform and sform differ by up to {_distance(sform, qform, header):.3g} mm; the {name} is used")
    if sform is not None and _distance(sform, used, header, spacing=False) == 0:
        lengths = np.linalg.norm(sform[:, : len(header.spacing)], axis=0)
        if np.abs(lengths / header.spacing - 1).max() > _SAME:
            stated, pixdim = (" ".join(f"{x:.6g}" for x in values) for values in (lengths, header.spacing))
            notes.append(f"the sform has the spacing {stated} mm, but pixdim has {pixdim} mm, which is used")
    return notes


def _distance(first: Affine, second: Affine, header: NiftiHeader, spacing: bool = True) -> float:
    """Return by how much two affine maps differ: the largest distance between the two images of a volume's corner.

    Return 0 if this distance is negligible. If ``spacing`` is False, compare only directions and origins: both maps are
    changed to have the spacing of ``pixdim``.
    """
    sides = np.array([*header.sizes, 1, 1][:3], dtype=np.float64)
    corners = np.array([[x, y, z, 1] for x in (0, 1) for y in (0, 1) for z in (0, 1)]) * [*sides, 1]
    if not spacing:
        first, second = (_with_unit_steps(form) for form in (first, second))
        corners[:, :3] = np.sign(corners[:, :3]) * sides * [*header.spacing, 1, 1][:3]
    distance = float(np.linalg.norm(corners @ (first - second).T, axis=1).max())
    return distance if distance > _SAME * min(header.spacing) else 0.0


def _with_unit_steps(form: Affine) -> Affine:
    lengths = np.linalg.norm(form[:, :3], axis=0)
    return np.column_stack([form[:, :3] / np.where(lengths > 0, lengths, 1), form[:, 3]])
