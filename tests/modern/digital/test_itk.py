"""NIfTI, MetaImage, TIFF and DICOM read by SimpleITK, which also writes the samples. Every failure is one line."""

import math
import os
import struct
import subprocess
import sys
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from modern.digital import itk
from modern.digital.itk import KINDS, kind_of
from modern.digital.scans import Scan
from modern.digital.solids import VolumeError
from modern.digital.volumes import Stated, read_scan, read_volume, write_array
from modern.digital.world import LPS, RAS
from tests.support.paths import ROOT
from tests.support.volumefiles import dicom_series, nifti, saved

sitk: Any = pytest.importorskip("SimpleITK")
REAL_RUN = itk._run

VALUES = (np.arange(24).reshape(2, 3, 4) % 5).astype(np.int16)
"""Values indexed [x, y, z] that change under every exchange of axes."""
TURNED = (math.cos(0.3), -math.sin(0.3), 0, math.sin(0.3), math.cos(0.3), 0, 0, 0, -1)


@pytest.fixture
def separate_process(monkeypatch) -> None:
    """Read each file in a new process, as the commands do."""
    monkeypatch.setattr(itk, "_run", REAL_RUN)


def written(name: str, direction: Any = (1, 0, 0, 0, -1, 0, 0, 0, 1), values: np.ndarray = VALUES) -> str:
    image = sitk.GetImageFromArray(values.T)
    image.SetSpacing((0.5, 0.25, 2.0)[: values.ndim])
    image.SetOrigin((-12.5, 4.0, 5.0)[: values.ndim])
    if values.ndim == 3:
        image.SetDirection(direction)
    sitk.WriteImage(image, name)
    return name


def series(folder: str, heights: tuple[float, ...] = (0.0, 1.5, 3.0, 4.5), uid: str = "1.2.3") -> str:
    return dicom_series(VALUES, folder, heights, uid)


@pytest.mark.parametrize("name", ["a.nii", "a.nii.gz", "A.NII.GZ", "a.mha", "a.mhd"])
def test_values_and_positions_are_those_of_the_library(name: str) -> None:
    os.rename(written(name.lower()), name)
    scan = read_scan(name)
    assert np.array_equal(scan.values, VALUES)
    assert scan.world is not None
    assert scan.world.steps == ((Fraction(1, 2), 0, 0), (0, Fraction(-1, 4), 0), (0, 0, 2))
    assert scan.world.origin == (Fraction(-25, 2), 4, 5)
    assert scan.world.space == LPS
    assert scan.world.unit == ("mm" if "nii" in name.lower() else "")
    assert scan.notes == ()
    assert scan.world.mirrors


@pytest.mark.parametrize("name", ["a.nii", "a.mha"])
def test_oblique_directions_are_the_columns_of_the_matrix(name: str) -> None:
    scan = read_scan(written(name, TURNED))
    image = sitk.ReadImage(name)
    assert scan.world is not None
    for voxel in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 2, 3)):
        ours = [float(number) for number in scan.world.place(voxel)]
        assert ours == pytest.approx(image.TransformIndexToPhysicalPoint(voxel), abs=1e-12)
    if name == "a.mha":
        # A double becomes the shortest decimal that identifies it, which for a short text is the text.
        assert scan.world.steps[1][1] == Fraction(repr(math.cos(0.3))) / 4


def test_nifti_orientation_is_converted_to_lps() -> None:
    """The positions of the file are RAS, those of the library LPS."""
    for by in ("sform", "qform"):
        Path("a.nii").write_bytes(nifti(VALUES, (0.5, 0.25, 2), (10, 20, 30), by))
        scan = read_scan("a.nii")
        assert np.array_equal(scan.values, VALUES)
        assert scan.world is not None
        assert (scan.world.space, scan.world.unit, scan.world.origin) == (LPS, "mm", (-10, -20, 30))
        assert scan.world.bearings() == (("right", True), ("anterior", True), ("superior", True))
        turned = scan.world.turned(RAS)
        assert turned.origin == (10, 20, 30)
        assert turned.steps == ((Fraction(1, 2), 0, 0), (0, Fraction(1, 4), 0), (0, 0, 2))


def test_nifti_orientation_spacing_and_scale_are_noted() -> None:
    Path("a.nii").write_bytes(nifti(VALUES, (0.5, 0.25, 2), (0, 0, 0), "none", units=0))
    scan = read_scan("a.nii")
    assert scan.notes == ("a.nii: the file states no orientation (qform and sform are 0)",)
    assert scan.world is not None
    assert scan.world.unit == ""
    scan = oriented(0, 1, (1, 0, 0, 10, 0, 2, 0, 20, 0, 0, 3, 30))
    assert scan.notes == ("a.nii: the sform has the spacing 1 2 3 mm, but pixdim has 0.5 0.25 2 mm, which is used",)
    scan = oriented(1, 0, (0,) * 12, 0.5)
    assert np.array_equal(scan.values, VALUES / 2)
    assert scan.notes == ("a.nii: the values are scaled: 0.5 times the stored value plus 0 (scl_slope, scl_inter)",)


@pytest.mark.parametrize("name", ["a.nii", "a.mha"])
def test_a_single_point_in_time_is_a_volume_and_several_are_refused(name: str) -> None:
    image = sitk.GetImageFromArray(VALUES.T)
    image.SetSpacing((0.5, 0.25, 2.0))
    sitk.WriteImage(sitk.JoinSeries([image], 7.0, 3.0), name)
    scan = read_scan(name)
    assert np.array_equal(scan.values, VALUES)
    assert scan.world is not None
    assert [text for text, _ in scan.world.spacings()] == ["0.5", "0.25", "2"]
    sitk.WriteImage(sitk.JoinSeries([image, image]), name)
    with pytest.raises(VolumeError, match=f"{name}: expected two or three axes, found 4 axes, 2 x 3 x 4 x 2"):
        read_scan(name)


def test_a_tiff_file_has_no_position() -> None:
    scan = read_scan(written("a.tif", values=VALUES.astype(np.uint8)))
    assert np.array_equal(scan.values, VALUES)
    assert scan.world is None
    assert scan.notes == ("a.tif: the resolution of a TIFF file is not used as the spacing of its voxels",)
    placed = read_scan("a.tif", Stated(spacing=("0.1", "0.1", 1)))
    assert placed.world is not None
    assert placed.world.steps[0] == (Fraction(1, 10), 0, 0)
    picture = read_scan(written("b.tiff", values=VALUES[:, :, 0].astype(np.uint8)))
    assert np.array_equal(picture.values, VALUES[:, :, 0])


def test_formats_follow_from_names_and_all_types_are_read() -> None:
    for kind in ("u1", "i1", "u2", "i4", "u4", "f4", "f8"):
        array = VALUES.astype(kind)
        values = read_scan(written("a.mha", values=array)).values
        assert values.dtype == array.dtype
        assert np.array_equal(values, array)
    scan = read_scan(series("ct", (0.0, 1.5, 3.0, 7.5)))
    assert scan.notes == ("ct: slices are 1.5 to 4.5 mm apart and are treated as evenly spaced",)
    assert {kind_of(f"a{ending}") for ending in KINDS} == {"NIfTI", "MetaImage", "TIFF", "DICOM"}
    assert (kind_of("-"), kind_of("a.nrrd"), kind_of("nii"), kind_of("a\0.nii")) == (None, None, None, None)


def test_a_dicom_series_is_read_in_the_order_of_its_slices() -> None:
    scan = read_scan(series("ct"))
    assert np.array_equal(scan.values, VALUES)
    assert scan.world is not None
    assert scan.world.steps == ((Fraction(1, 2), 0, 0), (0, Fraction(1, 4), 0), (0, 0, Fraction(3, 2)))
    assert (scan.world.origin, scan.world.space, scan.world.unit) == ((-10, 20, 0), LPS, "mm")
    assert scan.notes == ()
    assert read_scan("ct/1.2.3-0.dcm").values.shape[:2] == (2, 3)


def test_one_of_several_series_can_be_selected() -> None:
    series("ct")
    series("ct", (0.0, 2.0, 4.0), "1.2.4")
    with pytest.raises(
        VolumeError, match=r"ct: found 2 DICOM series; select one with --series: .*1\.2\.4\S* \(3 files\)"
    ):
        read_scan("ct")
    with pytest.raises(VolumeError, match=r"there is no series 7; the folder has 1\.2\.3"):
        read_scan("ct", Stated(series="7"))
    listed = sitk.ImageSeriesReader.GetGDCMSeriesIDs("ct")
    three = next(name for name in listed if len(sitk.ImageSeriesReader.GetGDCMSeriesFileNames("ct", name)) == 3)
    assert read_scan("ct", Stated(series=three)).values.shape == (2, 3, 3)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: "missing.nii", "missing.nii: no such file or directory"),
        (lambda: made_folder("empty"), "empty: is a directory without a DICOM file"),
        (lambda: saved("a.nii", b""), "a.nii: not a NIfTI-1 file"),
        (lambda: saved("a.mha", b"ObjectType = Image\nNDims = 3\n"), "a.mha: the header is truncated"),
        (
            lambda: saved("a.mhd", Path(written("b.mhd")).read_bytes().replace(b"b.raw", b"c.raw")),
            "a.mhd: c.raw: no such file",
        ),
        (lambda: saved("a.tif", b"no picture"), "a.tif: not a TIFF file"),
        (lambda: saved("a.dcm", b"no slice"), "a.dcm: not a DICOM file"),
        (lambda: rgb("a.mha"), "a.mha: expected one number for each voxel, found 3"),
        (lambda: endless("a.mha"), "a.mha: NDims: expected integers"),
        (lambda: huge("a.mha"), "a.mha: expected at most 2147483648 voxels, found 9000 x 9000 x 9000"),
    ],
)
def test_invalid_files_are_reported_in_one_line(make: Callable[[], str], message: str, capfd) -> None:
    name = make()
    with pytest.raises(Exception, match=r"\S") as caught:
        read_scan(name)
    assert str(caught.value).startswith(message)
    assert "\n" not in str(caught.value)
    assert ".cxx" not in str(caught.value)  # locations in the library's source
    assert capfd.readouterr() == ("", "")


def made_folder(name: str) -> str:
    Path(name).mkdir()
    Path(name, "notes.txt").write_text("no slice", encoding="utf-8")
    return name


def rgb(name: str) -> str:
    sitk.WriteImage(sitk.GetImageFromArray(np.zeros((4, 3, 2, 3), np.uint8), isVector=True), name)
    return name


def endless(name: str) -> str:
    """Write a number of axes at which ITK 5.4 ends with a segmentation fault."""
    data = Path(written(name)).read_bytes()
    return saved(name, data.replace(b"NDims = 3", b"NDims = 18446744073709551616"))


def huge(name: str) -> str:
    data = Path(written(name)).read_bytes()
    return saved(name, data.replace(b"DimSize = 2 3 4", b"DimSize = 9000 9000 9000"))


@pytest.mark.usefixtures("separate_process")
@pytest.mark.parametrize(
    ("child", "message"),
    [
        ("import os; os.kill(os.getpid(), 11)", "SimpleITK crashed (SIGSEGV) while it read the file"),
        ("import os; os.abort()", "SimpleITK crashed (SIGABRT) while it read the file"),
        ("raise SystemExit(7)", "SimpleITK ended with exit code 7 while it read the file"),
        ("print('noise')", "SimpleITK ended with exit code 0 while it read the file"),
        ("import time; time.sleep(60)", "SimpleITK did not read it within 0.5 seconds"),
    ],
)
def test_every_failure_of_the_library_is_one_line(child: str, message: str, monkeypatch, capfd) -> None:
    Path("child.py").write_text(f"print('noise', flush=True)\n{child}\n", encoding="utf-8")
    monkeypatch.setattr(itk, "_CHILD", "child.py")
    if "sleep" in child:
        monkeypatch.setattr(itk, "LIMIT", 0.5)
    with pytest.raises(VolumeError) as caught:
        read_scan(written("a.nii"))
    assert str(caught.value) == f"a.nii: {message}"
    assert capfd.readouterr() == ("", "")


@pytest.mark.usefixtures("separate_process")
def test_temporary_files_are_removed(monkeypatch, tmp_path: Path) -> None:
    monkeypatch.setenv("TMPDIR", str(tmp_path / "tmp"))
    monkeypatch.setattr("tempfile.tempdir", None)
    (tmp_path / "tmp").mkdir()
    read_scan(written("a.nii"))
    assert os.listdir(tmp_path / "tmp") == []


def test_message_about_a_missing_library_says_how_to_install_it() -> None:
    written("a.nii")
    code = "import sys; sys.modules['SimpleITK'] = None; import hull1620; hull1620.read_volume('a.nii')"
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    process = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, env=environment)
    assert process.stderr.splitlines()[-1].endswith(
        "a.nii: reading NIfTI needs SimpleITK: pip install 'hull1620[volumes]'"
    )


@pytest.mark.parametrize("direction", [TURNED, (0, 0, 1, -1, 0, 0, 0, 1, 0)])
def test_nrrd_agrees_with_the_library(direction: Any) -> None:
    """Compare the project's reader and writer with those of the library, in both directions."""
    scan = read_scan(written("a.nrrd", direction, VALUES.astype(np.uint8)))
    image = sitk.ReadImage("a.nrrd")
    assert np.array_equal(scan.values, sitk.GetArrayFromImage(image).T)
    volume = read_volume("a.nrrd")
    write_array("b.nrrd", volume.array, volume)
    ours = sitk.ReadImage("b.nrrd")
    assert np.array_equal(sitk.GetArrayFromImage(ours).T, VALUES != 0)
    assert volume.world is not None
    for voxel in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 2, 3)):
        place = image.TransformIndexToPhysicalPoint(voxel)
        assert [float(number) for number in volume.world.place(voxel)] == pytest.approx(place, abs=1e-12)
        assert ours.TransformIndexToPhysicalPoint(voxel) == pytest.approx(place, abs=1e-12)


def test_voxels_of_a_file_read_by_the_library_can_be_selected() -> None:
    written("a.nii.gz")
    volume = read_volume("a.nii.gz", labels=[3])
    assert volume.count == np.count_nonzero(VALUES == 3)
    assert isinstance(read_scan("a.nii.gz"), Scan)
    with pytest.raises(VolumeError, match="the file states the position of its voxels"):
        read_volume("a.nii.gz", spacing=(1, 1, 1))
    with pytest.raises(VolumeError, match="a series can be selected only in a folder of DICOM files"):
        read_scan("a.nii.gz", Stated(series="1"))


def test_time_limit_grows_with_the_size_of_the_files(monkeypatch) -> None:
    limits = []
    monkeypatch.setattr(itk, "_checked", lambda path, kind: (None, None, ""))
    monkeypatch.setattr(itk, "_slices", lambda path: {})
    monkeypatch.setattr(itk, "_run", lambda arguments, path, seconds: limits.append(seconds) or 1)
    Path("far").mkdir()
    for name in ("a.nii", "far/a.mhd"):
        Path(name).write_bytes(b"header")
    Path("far/a.raw").write_bytes(bytes(3 * 10**6))
    Path("far/a.dcm").write_bytes(bytes(128) + b"DICM" + bytes(10**6))
    for name in ("a.nii", "far/a.mhd", "far/a.dcm", "far"):
        with pytest.raises(VolumeError, match="ended with exit code 1"):
            read_scan(name)
    assert limits == [60, 64, 61, 64]


def oriented(qform_code: int, sform_code: int, rows: tuple[float, ...], slope: float = 1) -> Scan:
    """Read a NIfTI file whose sform has other rows than its qform."""
    data = bytearray(nifti(VALUES, (0.5, 0.25, 2), (10, 20, 30)))
    struct.pack_into("<2h", data, 252, qform_code, sform_code)
    struct.pack_into("<12f", data, 280, *rows)
    struct.pack_into("<2f", data, 112, slope, 0)
    Path("a.nii").write_bytes(data)
    return read_scan("a.nii")


def test_nifti_forms_that_differ_are_noted() -> None:
    moved = (0.5, 0, 0, 13, 0, 0.25, 0, 20, 0, 0, 2, 34)
    scan = oriented(1, 2, moved)
    assert scan.notes == ("a.nii: qform and sform differ by up to 5 mm; the qform is used",)
    assert scan.world is not None
    assert scan.world.origin == (-10, -20, 30)
    scan = oriented(1, 1, moved)
    assert scan.notes == ("a.nii: qform and sform differ by up to 5 mm; the sform is used",)
    assert scan.world is not None
    assert scan.world.origin == (-13, -20, 34)
    assert oriented(1, 1, (0.5, 0, 0, 10.001, 0, 0.25, 0, 20, 0, 0, 2, 30)).notes == ()
    assert oriented(0, 1, moved).notes == ()
    assert oriented(2, 0, moved).notes == ()
