"""Damaged volumes of every format are rejected in one line or give the true values, never other ones.

Every file is truncated at some places, and a byte of its compressed data is changed at others. ``HULL1620_FUZZ=200``
tries 20 truncations and 200 changed bytes for each file instead of a sample. Files without a checksum are also damaged
in the ways of ``tests/support/mutated.py``, after which they are rejected in one line or read.
"""

import gzip
import importlib
import importlib.util
import os
import random
import re
import struct
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from emulator.errors import FileError
from modern.digital.integrity import streams
from modern.digital.solids import VolumeError
from modern.digital.volumes import Stated, read_scan
from tests.support.itk_forks import fork_server_is_possible
from tests.support.mutated import WAYS, damaged
from tests.support.volumefiles import PLACE, dicom_series, nifti, nrrd, saved

IS_FULL = int(os.environ.get("HULL1620_FUZZ", "0")) >= 200
TRUNCATIONS, CHANGES = (20, 200) if IS_FULL else (4, 10)
VALUES = np.random.default_rng(1620).integers(0, 4, (12, 10, 6)).astype(np.uint8)
"""Values that hardly compress, so that most bytes of compressed data matter."""


@dataclass(frozen=True)
class Sample:
    """A volume: the path to read, the file to damage, and the range of its compressed bytes, if it has any."""

    path: str
    damaged_file: str
    compressed: tuple[int, int] | None = None
    stated: Stated | None = None


def plain(name: str, data: bytes, **options: Any) -> Sample:
    return Sample(saved(name, data), name, **options)


def npz() -> Sample:
    np.savez_compressed("a.npz", scan=VALUES)
    return Sample("a.npz", "a.npz", (0, os.path.getsize("a.npz")))


def npy() -> Sample:
    np.save("a.npy", VALUES)
    return Sample("a.npy", "a.npy")


def nrrd_gzip() -> Sample:
    head = nrrd(VALUES, *PLACE).partition(b"\n\n")[0].replace(b"encoding: raw", b"encoding: gzip") + b"\n\n"
    data = head + gzip.compress(VALUES.tobytes("F"))
    return plain("a.nrrd", data, compressed=(len(head), len(data)))


def nhdr(name: str, damages_header: bool) -> Sample:
    is_packed = name.endswith(".gz")
    head = nrrd(VALUES, *PLACE, f"data file: {name}").partition(b"\n\n")[0] + b"\n"
    raw = VALUES.tobytes("F")
    packed = gzip.compress(raw) if is_packed else raw
    saved(name, packed)
    saved("a.nhdr", head.replace(b"encoding: raw", b"encoding: gzip") if is_packed else head)
    return Sample("a.nhdr", "a.nhdr" if damages_header else name, (0, len(packed)) if is_packed else None)


def image(name: str, compressor: str = "", **options: Any) -> None:
    sitk: Any = importlib.import_module("SimpleITK")

    written = sitk.GetImageFromArray(VALUES.T)
    written.SetSpacing((0.5, 0.25, 2.0))
    writer = sitk.ImageFileWriter()
    writer.SetFileName(name)
    if compressor:
        writer.UseCompressionOn()
        writer.SetCompressor(compressor)
    writer.Execute(written)


def metaimage(name: str, damaged_file: str, compressor: str = "") -> Sample:
    image(name, compressor)
    size, start = os.path.getsize(damaged_file), 0
    if name.endswith(".mha"):
        start = Path(name).read_bytes().index(b"LOCAL\n") + 6
    return Sample(name, damaged_file, (start, size) if compressor else None)


def slices(data_file: str, damaged_file: str) -> Sample:
    """Write a header whose data are in one file for each slice."""
    image("a.mhd")
    head = Path("a.mhd").read_text(encoding="utf-8").replace("= a.raw", f"= {data_file}")
    names = [f"s{number}.raw" for number in range(1, 7)]
    for number, name in enumerate(names):
        saved(name, VALUES[:, :, number].tobytes("F"))
    Path("a.mhd").write_text(head + ("\n".join(names) + "\n" if data_file.startswith("LIST") else ""), encoding="utf-8")
    return Sample("a.mhd", damaged_file)


def tiff(compressor: str = "") -> Sample:
    image("a.tif", compressor)
    directory = int.from_bytes(Path("a.tif").read_bytes()[4:8], "little")
    return Sample("a.tif", "a.tif", (8, directory) if compressor else None)


def dicom() -> Sample:
    image("a.dcm")
    return Sample("a.dcm", "a.dcm")


def series() -> Sample:
    return Sample(dicom_series(VALUES, "ct", range(VALUES.shape[2])), "ct/1.2.3-5.dcm")


NII = nifti(VALUES, (0.5, 0.25, 2), (10, 20, 30))
RAW = VALUES.tobytes("F")
OURS: dict[str, Callable[[], Sample]] = {
    "NPY": npy,
    "NPZ": npz,
    "raw": lambda: plain("a.raw", RAW, stated=Stated(VALUES.shape)),
    "NRRD": lambda: plain("a.nrrd", nrrd(VALUES, *PLACE)),
    "NRRD with gzip": nrrd_gzip,
    "NRRD header of a data file": lambda: nhdr("a.raw", True),
    "NRRD data file": lambda: nhdr("a.raw", False),
    "NRRD data file with gzip": lambda: nhdr("a.raw.gz", False),
}
ITKS: dict[str, Callable[[], Sample]] = {
    "NIfTI": lambda: plain("a.nii", NII),
    "NIfTI with gzip": lambda: plain("a.nii.gz", gzip.compress(NII), compressed=(0, len(gzip.compress(NII)))),
    "MHA": lambda: metaimage("a.mha", "a.mha"),
    "MHA compressed": lambda: metaimage("a.mha", "a.mha", "ZLIB"),
    "MHD": lambda: metaimage("a.mhd", "a.mhd"),
    "MHD data file": lambda: metaimage("a.mhd", "a.raw"),
    "MHD compressed data file": lambda: metaimage("a.mhd", "a.zraw", "ZLIB"),
    "MHD list": lambda: slices("LIST", "a.mhd"),
    "MHD list, one of the files": lambda: slices("LIST 2", "s3.raw"),
    "MHD pattern": lambda: slices("s%d.raw 1 6 1", "a.mhd"),
    "MHD pattern, one of the files": lambda: slices("s%d.raw 1 6 1", "s6.raw"),
    "TIFF": tiff,
    "TIFF with Deflate": lambda: tiff("Deflate"),
    "DICOM": dicom,
    "DICOM series": series,
}
needs_itk = pytest.mark.skipif(not fork_server_is_possible(), reason="SimpleITK, and forks, are needed")
FORMATS = [*OURS, *(pytest.param(name, marks=needs_itk) for name in ITKS)]


def outcome(sample: Sample) -> tuple[Any, ...] | None:
    """Return values and position, or None for a file that is rejected with one clear line."""
    try:
        scan = read_scan(sample.path, sample.stated)
    except (VolumeError, FileError) as error:
        message = str(error)
        assert message.startswith(sample.path.split("/")[0]), message
        assert "\n" not in message
        assert "Success" not in message
        return None
    return scan.values.shape, scan.values.tobytes("F"), scan.world


@pytest.mark.parametrize("name", FORMATS)
def test_a_damaged_volume_is_rejected_or_gives_the_true_values(name: str) -> None:
    sample = (OURS | ITKS)[name]()
    truth = outcome(sample)
    assert truth is not None
    assert truth[:2] == (VALUES.shape, VALUES.tobytes("F"))
    whole = Path(sample.damaged_file).read_bytes()
    draw = random.Random(name)
    damaged_files = [
        ("truncated", whole[:length]) for length in sorted(draw.sample(range(len(whole)), TRUNCATIONS - 1))
    ]
    damaged_files.append(("truncated", whole[:-1]))
    if sample.compressed:
        for position in draw.choices(range(*sample.compressed), k=CHANGES):
            changed = bytearray(whole)
            changed[position] ^= draw.randrange(1, 256)
            damaged_files.append(("changed", bytes(changed)))
    for kind, data in damaged_files:
        Path(sample.damaged_file).write_bytes(data)
        result = outcome(sample)
        assert result in (None, truth), (kind, len(data), [at for at, byte in enumerate(data) if byte != whole[at]])
    for way in range(0 if sample.compressed else WAYS):
        Path(sample.damaged_file).write_bytes(damaged(whole, way, name))
        outcome(sample)


@needs_itk
def test_a_slice_truncated_at_any_byte_is_named_and_not_left_out_of_its_series() -> None:
    sample = series()
    whole = Path(sample.damaged_file).read_bytes()
    for length in range(len(whole)):
        Path(sample.damaged_file).write_bytes(whole[:length])
        message = rejection("ct")
        assert message.startswith("ct/1.2.3-5.dcm: "), message
        assert re.search("damaged|not a DICOM file|bytes of data", message), message


@needs_itk
def test_files_of_a_series_that_are_not_dicom_are_named_as_left_out() -> None:
    sample = series()
    Path("ct/readme").write_text("no image", encoding="utf-8")
    Path("ct/.hidden").write_text("", encoding="utf-8")
    assert read_scan(sample.path).notes[-1] == "ct: files that are not DICOM are left out (1): readme"


@needs_itk
def test_a_compressed_volume_is_verified_piece_by_piece(monkeypatch) -> None:
    monkeypatch.setattr(streams, "CHUNK", 7)
    for name in ("MHA compressed", "NIfTI with gzip", "TIFF with Deflate"):
        sample = ITKS[name]()
        assert outcome(sample) is not None
        data = Path(sample.damaged_file).read_bytes()
        for length in (len(data) - 1, len(data) // 2):
            Path(sample.damaged_file).write_bytes(data[:length])
            assert outcome(sample) is None


def rejection(path: str) -> str:
    with pytest.raises(VolumeError) as caught:
        read_scan(path)
    assert "\n" not in str(caught.value)
    return str(caught.value).removeprefix(f"{path}: ")


NAN, INFINITY = float("nan"), float("inf")


@needs_itk
@pytest.mark.parametrize(
    ("position", "form", "numbers", "message"),
    [
        (40, "4h", (3, 200, 200, 200), "expected 8000000 bytes of data, found 720"),
        (40, "4h", (3, 12, 10, 5), "expected 600 bytes of data, found more"),
        (40, "4h", (2, 12, 10, 6), "expected 120 bytes of data, found more"),
        (40, "4h", (3, 12, -10, 6), "expected positive sizes, found 12 x -10 x 6"),
        (40, "4h", (3, 0, 10, 6), "expected positive sizes, found 0 x 10 x 6"),
        (40, "4h", (3, 32767, 32767, 32767), "expected at most 2147483648 voxels, found 32767 x 32767 x 32767"),
        (40, "h", (9,), "dim[0]: expected 1 to 7 axes, found 9"),
        (70, "2h", (4, 8), "datatype 4 does not have bitpix 8"),
        (80, "f", (NAN,), "pixdim[1]: expected a positive number, found nan"),
        (88, "f", (-2,), "pixdim[3]: expected a positive number, found -2"),
        (108, "f", (NAN,), "vox_offset: expected an integer of at least 352, found nan"),
        (108, "f", (0,), "vox_offset: expected an integer of at least 352, found 0"),
        (108, "f", (352.5,), "vox_offset: expected an integer of at least 352, found 352.5"),
        (108, "f", (1e6,), "expected 720 bytes of data, found 0"),
        (112, "2f", (INFINITY, 0), "scl_slope and scl_inter: expected finite numbers"),
        (112, "2f", (0, 3), "scl_inter is 3, but scl_slope is 0"),
        (252, "2h3f", (1, 0, 1, 1, 1), "qform: expected a unit quaternion"),
        (280, "f", (NAN,), "sform: expected finite numbers"),
        (344, "4s", (b"ni1\0",), "a pair of files .hdr and .img is not supported; convert it to one .nii file"),
        (344, "4s", (b"",), "not a NIfTI-1 file"),
        (0, "i", (540,), "NIfTI-2 is not supported; convert the file to NIfTI-1"),
    ],
)
def test_invalid_numbers_of_a_nifti_header_are_reported(position, form, numbers, message) -> None:
    data = bytearray(NII)
    struct.pack_into(f"<{form}", data, position, *numbers)
    assert rejection(saved("a.nii", bytes(data))).startswith(message)
    assert rejection(saved("a.nii.gz", gzip.compress(data))).startswith(message)


@needs_itk
@pytest.mark.parametrize(
    ("pattern", "replacement", "message"),
    [
        ("DimSize = 12", "DimSize = 13", "expected 780 bytes of data, found 720"),
        ("DimSize = 12", "DimSize = -12", "expected positive sizes, found -12 x 10 x 6"),
        ("DimSize = 12", "DimSize = 1.5", "DimSize: expected integers"),
        ("DimSize = 12", "DimSize = 9 12", "DimSize: expected 3 sizes, found 4"),
        ("DimSize = 12", "Size = 12", "DimSize: expected integers, found 'nothing'"),
        ("DimSize = 12 10 6", "DimSize = 99999 99999 99999", "expected at most 2147483648 voxels"),
        ("MET_UCHAR", "MET_USHORT", "expected 1440 bytes of data, found 720"),
        ("MET_UCHAR", "MET_BIT", "ElementType: 'MET_BIT' is not supported"),
        ("CompressedData = False", "CompressedData = True", "the data cannot be decompressed"),
        ("CompressedData = False", "CompressedData = Folse", "CompressedData: expected True or False"),
        ("BinaryData = True", "BinaryData = False", "BinaryData = False (numbers as text) is not supported"),
        ("NDims", "HeaderSize = 1000\nNDims", "expected 720 bytes of data, found "),
        ("NDims", "ElementNumberOfChannels = 2\nNDims", "expected 1440 bytes of data, found 720"),
        ("NDims", "NDims = 3\nNDims", "line 3: duplicate field NDims"),
        ("LOCAL", "missing.raw", "missing.raw: no such file or directory"),
        ("LOCAL", "LIST", "expected a list of 6 files, found 0|the list of files is truncated"),
        ("LOCAL", "LIST 3", "ElementDataFile: expected LIST and a number of axes below 3, found 'LIST 3'"),
        ("LOCAL", "s%d.raw 1 7 1", "ElementDataFile: expected NAME%03d FIRST LAST STEP for 6 files"),
        ("LOCAL", "s%d.raw 1 6 0", "ElementDataFile: expected NAME%03d FIRST LAST STEP for 6 files"),
    ],
)
def test_invalid_fields_of_a_metaimage_header_are_reported(pattern: str, replacement: str, message: str) -> None:
    image("a.mha")
    head, mark, body = Path("a.mha").read_bytes().partition(b"LOCAL\n")
    text = (head + mark).decode()
    assert pattern in text
    saved("a.mha", text.replace(pattern, replacement, 1).encode() + body)
    found = rejection("a.mha")
    assert any(found.startswith(start) for start in message.split("|")), found


@needs_itk
def test_a_list_with_too_few_files_is_rejected() -> None:
    slices("LIST", "a.mhd")
    head, _, names = Path("a.mhd").read_text(encoding="utf-8").partition("LIST\n")
    Path("a.mhd").write_text(f"{head}LIST\n{names.partition('s3')[0]}", encoding="utf-8")
    assert rejection("a.mhd") == "expected a list of 6 files, found 2"


@needs_itk
@pytest.mark.parametrize("compressor", ["LZW", "PackBits", "JPEG"])
def test_a_tiff_file_compressed_without_a_checksum_is_rejected(compressor: str) -> None:
    image("a.tif", compressor)
    assert rejection("a.tif") == (
        f"page 1: compression {compressor} has no checksum, so damage would not be noticed; "
        "save the file uncompressed or with Deflate"
    )


def tag(data: bytes, code: int) -> int:
    """Return the position of an entry of the first directory of a little-endian TIFF file."""
    first = int.from_bytes(data[4:8], "little")
    return next(
        at
        for at in range(first + 2, first + 2 + 12 * int.from_bytes(data[first : first + 2], "little"), 12)
        if int.from_bytes(data[at : at + 2], "little") == code
    )


@needs_itk
@pytest.mark.parametrize(
    ("code", "number", "message"),
    [
        (256, 13, "pages 1 and 2 have different sizes or types"),
        (258, 16, "pages 1 and 2 have different sizes or types"),
        (259, 5, "page 1: compression LZW has no checksum"),
        (273, 10**6, "page 1: truncated: a strip or tile is incomplete"),
        (278, 0, "page 1: invalid strips of 0 rows"),
        (278, 3, "page 1: expected 4 strips or tiles, found 1"),
        (279, 10, "page 1: truncated: a strip or tile is incomplete"),
    ],
)
def test_invalid_tags_of_a_tiff_file_are_reported(code: int, number: int, message: str) -> None:
    image("a.tif")
    data = bytearray(Path("a.tif").read_bytes())
    struct.pack_into("<I", data, tag(data, code) + 8, number)
    assert rejection(saved("a.tif", bytes(data))).startswith(message)


@needs_itk
def test_a_tiff_stack_that_imagej_stores_as_one_page_is_rejected() -> None:
    image("a.tif")
    data = Path("a.tif").read_bytes()
    # Add a description, and make the first directory the last one.
    first = int.from_bytes(data[4:8], "little")
    count = int.from_bytes(data[first : first + 2], "little")
    text = b"ImageJ=1.53\nimages=6\n\0"
    entries = [data[first + 2 + 12 * number :][:12] for number in range(count)]
    entries.append(struct.pack("<2H2I", 270, 2, len(text), len(data) + 2 + 12 * (count + 1) + 4))
    entries.sort(key=lambda entry: int.from_bytes(entry[:2], "little"))
    directory = struct.pack("<H", count + 1) + b"".join(entries) + bytes(4)
    data = data[:4] + struct.pack("<I", len(data)) + data[8:] + directory + text
    assert rejection(saved("a.tif", data)) == "expected 6 pages, as its description states, found 1"


@needs_itk
def test_compressed_dicom_is_rejected() -> None:
    image("a.dcm", "JPEG2000")
    assert re.match(
        r"the pixel data are compressed without a checksum \(transfer syntax 1\.2\.\S+\)", rejection("a.dcm")
    )


@needs_itk
@pytest.mark.parametrize("element", [(0x28, 0x10), (0x28, 0x11), (0x28, 0x100)])
@pytest.mark.parametrize("number", [0, 7, 65535])
def test_sizes_of_dicom_must_agree_with_its_pixel_data(element: tuple[int, int], number: int) -> None:
    image("a.dcm")
    data = bytearray(Path("a.dcm").read_bytes())
    at = data.index(struct.pack("<2HI", *element, 2))
    struct.pack_into("<H", data, at + 8, number)
    assert re.match("expected (positive sizes|[0-9]+ bytes of data|at most)", rejection(saved("a.dcm", bytes(data))))


def test_a_detached_nrrd_header_that_ends_within_a_line_is_rejected() -> None:
    nhdr("a.raw", True)
    lines = Path("a.nhdr").read_bytes().replace(b"space origin: (-10,5,0.25)\n", b"") + b"spacings: nan nan na"
    assert rejection(saved("a.nhdr", lines)) == "the header is truncated: its last line lacks a line break"
