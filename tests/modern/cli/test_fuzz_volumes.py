"""Every reader of volumes, on files damaged at random: see ``test_fuzz_readers``, and ``HULL1620_FUZZ`` there.

Of those that SimpleITK reads, which take longer, one file is damaged by itself.  The headers of formats with a place
(NRRD, MetaImage, NIfTI) have one here, and hulls are written in it.
"""

from __future__ import annotations

import gzip
import importlib.util
import io
import os
import random
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.support.itk_forks import forks
from tests.support.mutated import FILES, Make, codes_of, saved, solid
from tests.support.volumefiles import nifti

WITHOUT_ITK = importlib.util.find_spec("SimpleITK") is None or not hasattr(os, "fork")
HULL = ["-o", "out.off"]
TABLE = ["--each-label", "--csv", "out.csv", "-o", "out-%d.off"]


def nrrd(draw: random.Random) -> bytes:
    array = solid(draw).astype(np.uint8)
    encoding = draw.choice(("raw", "gzip", "ascii"))
    raw = array.tobytes("F")
    body = {"raw": raw, "gzip": gzip.compress(raw), "ascii": " ".join(map(str, raw)).encode()}[encoding]
    sizes = " ".join(map(str, array.shape))
    return f"NRRD0004\ntype: uint8\ndimension: 3\nsizes: {sizes}\nencoding: {encoding}\n\n".encode() + body


def placed_nrrd(draw: random.Random) -> bytes:
    head, _, body = nrrd(draw).partition(b"\n\n")
    lines = [
        "space: left-posterior-superior",
        f"space directions: ({draw.uniform(-2, 2):.3f},0,0) (0,{draw.uniform(-2, 2):.3f},0.1) (0,0,2.5)",
        f"space origin: ({draw.randrange(-99, 99)},0.25,{draw.uniform(-9, 9)})",
        'space units: "mm" "mm" "mm"',
    ]
    if draw.random() < 0.3:
        lines = ["spacings: 0.5 0.5 2"]
    return head + b"\n" + "\n".join(lines).encode() + b"\n\n" + body


def npz(draw: random.Random) -> bytes:
    file = io.BytesIO()
    (np.savez if draw.random() < 0.5 else np.savez_compressed)(file, scan=solid(draw))
    return file.getvalue()


def placed_nifti(draw: random.Random) -> bytes:
    by, units = draw.choice(("sform", "qform", "none")), draw.choice((0, 2, 3))
    return nifti(solid(draw), (0.5, 0.7, 2), (10, 20, draw.uniform(-9, 9)), by, units)


def metaimage(data: str) -> Make:
    """A header as text; the values after it, or in another file."""

    def make(draw: random.Random) -> bytes:
        array = np.ones((3, 4, 2), np.uint8) if data != "LOCAL" else solid(draw).astype(np.uint8)
        packed = data == "LOCAL" and draw.random() < 0.3
        text = (
            f"ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
            f"CompressedData = {packed}\nTransformMatrix = 1 0 0 0 -1 0 0 0 1\nOffset = -12.5 4 {draw.uniform(-9, 9)}\n"
            f"CenterOfRotation = 0 0 0\nAnatomicalOrientation = RAI\nElementSpacing = 0.7 0.7 {draw.randrange(1, 9)}\n"
            f"DimSize = {' '.join(map(str, array.shape))}\nElementType = MET_UCHAR\nElementDataFile = {data}\n"
        )
        raw = array.tobytes("F")
        return text.encode() + (b"" if data != "LOCAL" else gzip.compress(raw) if packed else raw)

    return make


def by_itk(name: str) -> Make:
    def make(draw: random.Random) -> bytes:
        sitk: Any = pytest.importorskip("SimpleITK")
        image = sitk.GetImageFromArray(solid(draw).astype(np.uint8).T)
        image.SetSpacing((0.7, 0.7, 2.0))
        path = Path(f"../{name}")
        sitk.WriteImage(image, str(path))
        return path.read_bytes()

    return make


def raw(kind: str, count: int) -> Make:
    """The bytes of so many numbers, without a header."""
    return lambda draw: np.array([draw.choice((0, 0, 1, 2)) for _ in range(count - 1)] + [1]).astype(kind).tobytes()


OURS: dict[str, tuple[str, Make, list[str]]] = {
    "npy": ("a.npy", lambda draw: saved(solid(draw)), ["a.npy", *HULL]),
    "npy-labels": ("a.npy", lambda draw: saved(solid(draw)), ["a.npy", "--spacing", "0.5,0.5,2", *TABLE]),
    "npz": ("a.npz", npz, ["a.npz", "--threshold", "0.5", "--fill", "-o", "out.nrrd"]),
    "nrrd": ("a.nrrd", nrrd, ["a.nrrd", *HULL]),
    "nrrd-place": ("a.nrrd", placed_nrrd, ["a.nrrd", *HULL]),
    "nrrd-labels": ("a.nrrd", placed_nrrd, ["a.nrrd", *TABLE]),
    "nrrd-fill": ("a.nrrd", placed_nrrd, ["a.nrrd", "--fill", "-o", "out.nrrd"]),
    "raw": ("a.raw", raw("u1", 27), ["a.raw", "--shape", "3,3,3", "--origin", "1,2,3", *HULL]),
    "raw-floats": (
        "a.raw",
        raw(">f4", 18),
        ["a.raw", "--shape", "3,3,2", "--dtype", ">f4", "--threshold", ".1", *HULL],
    ),
}
ITKS: dict[str, tuple[str, Make, list[str]]] = {
    "nii": ("a.nii", placed_nifti, ["a.nii", *HULL]),
    "nii-labels": ("a.nii", placed_nifti, ["a.nii", "--space", "ras", *TABLE]),
    "nii.gz": ("a.nii.gz", lambda draw: gzip.compress(placed_nifti(draw)), ["a.nii.gz", *HULL]),
    "mha": ("a.mha", metaimage("LOCAL"), ["a.mha", *HULL]),
    "mhd": ("a.mhd", metaimage("../a.raw"), ["a.mhd", "--fill", "-o", "out.nrrd"]),
    "tif": ("a.tif", by_itk("whole.tif"), ["a.tif", *HULL]),
    "dcm": ("a.dcm", by_itk("whole.dcm"), ["a.dcm", *HULL]),
}


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder, the current one, and beside it the values of a header without them."""
    (tmp_path / "a.raw").write_bytes(bytes([0, 1, 2, 1] * 6))
    (tmp_path / "work").mkdir()
    monkeypatch.chdir(tmp_path / "work")
    return tmp_path / "work"


@pytest.mark.parametrize("name", OURS)
def test_a_damaged_volume_is_read_or_refused_in_one_line(
    name: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, make, words = OURS[name]
    codes = codes_of(name, path, make, ["voxel-hull", *words], folder, capsys)
    assert {0, 2} <= codes, codes


@pytest.mark.skipif(WITHOUT_ITK, reason="SimpleITK, and forks, are needed")
@pytest.mark.parametrize("name", ITKS)
def test_a_damaged_volume_for_the_library_is_read_or_refused_in_one_line(
    name: str, folder: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    path, make, words = ITKS[name]
    with forks(monkeypatch) as endings:
        codes = codes_of(name, path, make, ["voxel-hull", *words], folder, capfd, FILES if FILES > 3 else 1)
    assert {0, 2} <= codes, codes
    if FILES > 3:
        with capfd.disabled():
            print(f"\n{name}: {len(codes)} exit codes; the library's process: {dict(endings)}")
