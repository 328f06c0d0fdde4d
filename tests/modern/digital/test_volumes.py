"""Volumes from files and names: correct reading, and one line for every error."""

import gzip
import io
import tracemalloc
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from emulator.errors import EmulatorError, FileError
from modern.digital.scans import chosen
from modern.digital.solids import Volume, VolumeError, ball, half_ball, listed
from modern.digital.volumes import Stated, _parsed, read_volume

STEPS = np.arange(24).reshape(2, 3, 4) % 5
"""Values 0 to 4 that change under every exchange of axes."""


def npy(array: np.ndarray) -> bytes:
    file = io.BytesIO()
    np.save(file, array)
    return file.getvalue()


def nrrd(array: np.ndarray, kind: str, *fields: str, encoding: str = "raw", data: bytes | None = None) -> bytes:
    """Return an NRRD file written by hand from its definition."""
    head = ["NRRD0004", "# a comment", f"type: {kind}", f"dimension: {array.ndim}"]
    head += [f"sizes: {' '.join(map(str, array.shape))}", f"encoding: {encoding}", "key:=value", *fields]
    body = array.tobytes(order="F")
    packed = gzip.compress(body) if encoding in ("gzip", "gz") else body
    return ("\n".join(head) + "\n\n").encode() + (packed if data is None else data)


def parse_volume(data: bytes, source: str, shape: Any = None, dtype: str | None = None) -> Volume:
    return chosen(_parsed(data, source, Stated(shape, dtype))).volume


def same(volume: Volume, array: np.ndarray) -> bool:
    return volume.array.dtype == np.bool_ and np.array_equal(volume.array, array != 0)


def brute_ball(diameter: int, shift: int) -> set[tuple[int, int, int]]:
    """Return the voxels (i, j, k) with |2 (i, j, k) - shift| at most the diameter."""
    reach = range(-diameter - 1, diameter + 2)
    return {
        (i, j, k)
        for i in reach
        for j in reach
        for k in reach
        if (2 * i - shift) ** 2 + (2 * j - shift) ** 2 + (2 * k - shift) ** 2 <= diameter**2
    }


def voxels(volume: Volume) -> set[tuple[int, ...]]:
    return set(map(tuple, volume.coordinates().tolist()))


@pytest.mark.parametrize("diameter", [1, 2, 3, 4, 5, 8, 9])
def test_a_ball_has_the_voxels_within_half_a_diameter_of_its_centre(diameter: int) -> None:
    assert voxels(ball(diameter)) == brute_ball(diameter, 0)
    upper = {voxel for voxel in brute_ball(diameter, 0) if voxel[2] >= 0}
    assert voxels(half_ball(diameter, "voxel")) == upper
    if diameter > 1:
        assert voxels(ball(diameter, "vertex")) == brute_ball(diameter, 1)
        assert voxels(half_ball(diameter)) == {voxel for voxel in brute_ball(diameter, 1) if voxel[2] >= 1}


def test_coordinates_keep_their_order_origin_and_repetitions() -> None:
    volume = parse_volume(b"x,y,z\n7,-2,5\n6,-2,5\n6,-1,4\n6,-2,4\n", "list")
    assert volume.origin == (6, -2, 4)
    assert volume.array.shape == (2, 2, 2)
    assert volume.coordinates().tolist() == [[6, -2, 4], [6, -1, 4], [6, -2, 5], [7, -2, 5]]
    assert volume.notes == ()
    volume = listed(np.array([[-100, 3, 2], [100, 4, 2], [-100, 3, 2]], dtype=np.int8), "list")
    assert (volume.count, volume.origin, volume.array.shape) == (2, (-100, 3, 2), (201, 2, 1))
    assert volume.coordinates().tolist() == [[-100, 3, 2], [100, 4, 2]]
    assert volume.notes == ("list: 1 of 3 voxels are repetitions",)
    assert listed([(5, 6)]).dimension == 2


@pytest.mark.parametrize("kind", [np.bool_, np.uint8, np.int8, np.int64, np.float32, ">i2"])
def test_npy_files_are_read(kind: str) -> None:
    array = STEPS.astype(kind)
    assert same(parse_volume(npy(array), "a.npy"), array)
    assert same(parse_volume(npy(np.asfortranarray(array)), "a.npy"), array)
    assert parse_volume(npy(array[0]), "a.npy").dimension == 2


@pytest.mark.parametrize("encoding", ["raw", "gzip", "gz"])
@pytest.mark.parametrize(
    ("kind", "dtype", "fields"),
    [
        ("uchar", "u1", ()),
        ("signed char", "i1", ()),
        ("uint8_t", "u1", ("endian: little",)),
        ("short", "<i2", ("endian: little",)),
        ("unsigned short", ">u2", ("endian: big",)),
        ("int", "<i4", ("endian: little", "space directions: (1,0,0) (0,1,0) (0,0,1)")),
        ("unsigned long long int", ">u8", ("endian: big",)),
        ("float", "<f4", ("endian: little",)),
        ("double", ">f8", ("endian: BIG", "byte skip: 0")),
    ],
)
def test_nrrd_files_are_read(encoding: str, kind: str, dtype: str, fields: tuple[str, ...]) -> None:
    array = STEPS.astype(dtype)
    assert same(parse_volume(nrrd(array, kind, *fields, encoding=encoding), "a.nrrd"), array)


@pytest.mark.parametrize(("endian", "dtype"), [("little", "<f4"), ("big", ">f4")])
def test_a_negative_zero_is_not_a_voxel_in_either_byte_order(endian: str, dtype: str) -> None:
    array = np.array([[1.0, -0.0, 2.0]], dtype=dtype)
    data = nrrd(array, "float", f"endian: {endian}", data=array.tobytes(order="F"))
    assert parse_volume(data, "a.nrrd").array.tolist() == [[True, False, True]]
    assert parse_volume(array.tobytes(), "raw", (1, 3), dtype).array.tolist() == [[True, False, True]]


def test_nrrd_data_can_be_in_another_file(tmp_path: Path) -> None:
    array = STEPS.astype("u1")
    (tmp_path / "a.raw").write_bytes(array.tobytes(order="F"))
    header = tmp_path / "a.nhdr"
    header.write_bytes(nrrd(array, "uchar", "data file: a.raw", data=b""))
    assert same(read_volume(str(header)), array)
    (tmp_path / "a.raw").unlink()
    with pytest.raises(FileError, match=r"line 8: a\.raw: no such file"):
        read_volume(str(header))


def test_a_compressed_nrrd_is_decompressed_only_to_its_size() -> None:
    array = np.ones((2, 2, 2), dtype="u1")
    packed = gzip.compress(bytes([1]) * 8 + bytes(3 * 10**7))
    tracemalloc.start()
    with pytest.raises(VolumeError, match=r"a\.nrrd: expected 8 bytes of data, found more"):
        parse_volume(nrrd(array, "uchar", encoding="gzip", data=packed), "a.nrrd")
    assert tracemalloc.get_traced_memory()[1] < 10**7
    tracemalloc.stop()


@given(st.integers(1, 4), st.integers(1, 4), st.integers(1, 4), st.data())
def test_raw_data_are_read_with_x_fastest(nx: int, ny: int, nz: int, data: st.DataObject) -> None:
    values = data.draw(st.lists(st.integers(0, 3), min_size=nx * ny * nz, max_size=nx * ny * nz))
    values[0] = 1
    volume = parse_volume(np.array(values, dtype=">i2").tobytes(), "raw", (nx, ny, nz), ">i2")
    for z in range(nz):
        for y in range(ny):
            for x in range(nx):
                assert volume.array[x, y, z] == (values[x + nx * (y + ny * z)] != 0)


def test_balls_are_read_by_name_and_accept_no_shape() -> None:
    assert read_volume("ball:32").count == 17077
    assert read_volume("ball:6").origin == (-3, -3, -3)
    assert voxels(read_volume("ball:6:vertex")) == voxels(ball(6, "vertex"))
    assert voxels(read_volume("half-ball:6")) == voxels(half_ball(6, "vertex"))
    assert voxels(read_volume("half-ball:6:voxel")) == voxels(half_ball(6, "voxel"))
    with pytest.raises(VolumeError, match="--shape and --dtype are for raw data"):
        read_volume("ball:8", (2, 2, 2))
    with pytest.raises(VolumeError, match="expected the centre voxel or vertex"):
        ball(8, "edge")


def test_a_written_array_is_restored(tmp_path: Path) -> None:
    path = str(tmp_path / "a.npy")
    np.save(path, STEPS != 0)
    assert same(read_volume(path), STEPS)


HEADER = nrrd(STEPS.astype("u1"), "uchar")


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", "there are no voxels"),
        (b"x,y,z\n", "there are no voxels"),
        (b"1,2,3\n1,2\n", "line 2, column 1: expected 3 fields, found 2"),
        (b"1,2,3,4\n", "line 1, column 1: expected 3 (x,y,z) or 2 (x,y) fields, found 4"),
        (b"OFF\n4 0 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n", "expected voxels, found a mesh"),
        (b"1,2,3.5\n", "line 1, field 3: '3.5' is not an integer"),
        (b"1,2,\n", "line 1, field 3: '' is not an integer"),
        (b"1,2,-1000000000000000000\n", "line 1, field 3: more than 18 digits"),
        (b"0,0,0\n2000000,2000,2000\n", "found 2000001 x 2001 x 2001"),
        (b"\xff\xfe\x00", "not NPY, NRRD or UTF-8 text"),
        (npy(np.zeros((2, 2, 2))), "there are no voxels: every value is 0"),
        (npy(np.ones(8)), "found an array of float64 with 1"),
        (npy(np.ones((2, 2, 2), dtype=complex)), "an array of complex128"),
        (npy(np.full((2, 2, 2), np.nan)), "a value is not a number"),
        (npy(np.array([[[None]]], dtype=object)), "not an NPY array of numbers: "),
        (npy(STEPS)[:100], "not an NPY array of numbers: "),
        (npy(STEPS)[:-5], "not an NPY array of numbers: "),
        (HEADER.replace(b"dimension: 3", b"dimension: 4"), "line 4: expected two or three axes, found 4"),
        (HEADER.replace(b"dimension: 3", b"dimension: x"), "line 4: dimension: 'x' is not an integer"),
        (HEADER.replace(b"sizes: 2 3 4", b"sizes: 2 3"), "line 5: sizes: expected 3 positive integers"),
        (HEADER.replace(b"sizes: 2 3 4", b"sizes: 2 0 4"), "line 5: sizes: expected 3 positive integers"),
        (HEADER.replace(b"sizes: 2 3 4", b"sizes: 99999 99999 99999"), "line 5: sizes: expected at most"),
        (HEADER.replace(b"type: uchar", b"type: block"), "line 3: type: 'block' is not supported"),
        (HEADER.replace(b"type: uchar", b"type: short"), "the header has no field 'endian'"),
        (HEADER.replace(b"type: uchar", b"type: int\nendian: odd"), "line 4: endian: expected little or big"),
        (HEADER.replace(b"type: uchar\n", b""), "the header has no field 'type'"),
        (HEADER.replace(b"encoding: raw", b"encoding: hex"), "line 6: encoding: expected raw or gzip, found 'hex'"),
        (HEADER.replace(b"encoding: raw", b"encoding: gzip"), "the data cannot be decompressed"),
        (HEADER.replace(b"# a", b"a"), "line 2, column 1: expected a field or a comment"),
        (HEADER.replace(b"# a", b"type: a"), "line 3, column 1: duplicate field type"),
        (HEADER.replace(b"key:=", b"byte skip: -1\nkey:="), "line 7: byte skip: only the value 0 is supported"),
        (HEADER.replace(b"key:=", b"data file: LIST\nkey:="), "line 7: data in several files are not supported"),
        (HEADER.replace(b"type: uchar", b"type: int").replace(b"raw", b"ascii"), "encoding: expected raw or gzip"),
        (HEADER[:-3], "expected 24 bytes of data, found 21"),
        (HEADER + b"12", "expected 24 bytes of data, found more"),
    ],
)
def test_invalid_files_are_reported_in_one_line(data: bytes, message: str) -> None:
    with pytest.raises(EmulatorError) as caught:
        parse_volume(data, "file")
    assert str(caught.value).startswith("file: ")
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("shape", "dtype", "message"),
    [
        ((2, 2, 3), None, "file: expected 12 bytes for 2x2x3 numbers of uint8, found 8"),
        ((2, 2, 1), "i1", "file: expected 4 bytes for 2x2x1 numbers of int8, found 8"),
        ((2, 2, 2), "nonsense", "--dtype: 'nonsense' is not a type of numbers"),
        ((2, 2, 2), ",", "--dtype: ',' is not a type of numbers"),
        ((2, 2, 2), "(99999999999,)u1", "--dtype: '(99999999999,)u1' is not a type of numbers"),
        ((2, 2, 2), "U4", "--dtype: <U4 is not a type of numbers"),
        (None, "u1", "--dtype: raw data also need --shape"),
        ((8,), "u1", "--shape: expected two or three positive integers"),
        ((0, 2, 2), "u1", "--shape: expected two or three positive integers"),
    ],
)
def test_invalid_shapes_and_types_are_reported(shape: tuple[int, ...] | None, dtype: str | None, message: str) -> None:
    with pytest.raises(VolumeError) as caught:
        parse_volume(bytes(range(8)), "file", shape, dtype)
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("ball:0", "ball:0:voxel: expected a positive integer as the diameter"),
        ("ball:1:vertex", "ball:1:vertex: the ball contains no voxel"),
        ("half-ball:99999", "half-ball:99999:vertex: expected a diameter of at most 1289"),
        ("ball:x", "ball:x: expected ball:DIAMETER"),
        ("ball:8:centre", "ball:8:centre: expected ball:DIAMETER"),
        ("missing.npy", "missing.npy: no such file or directory"),
        (".", ".: is a directory"),
        ("a\0b", "'a\\x00b': not a valid file name"),
    ],
)
def test_invalid_names_are_reported(name: str, message: str) -> None:
    with pytest.raises((FileError, VolumeError)) as caught:
        read_volume(name)
    assert str(caught.value).startswith(message)


def test_volumes_are_read_from_standard_input(monkeypatch) -> None:
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(npy(STEPS)), encoding="utf-8"))
    assert same(read_volume("-"), STEPS)
    monkeypatch.setattr("sys.stdin", None)
    with pytest.raises(EmulatorError, match="standard input is closed"):
        read_volume("-")


@pytest.mark.parametrize(
    ("coordinates", "message"),
    [
        ([], "there are no voxels"),
        ([1, 2, 3], "found an array of int64 of shape (3,)"),
        ([(1, 2, 3, 4)], "of shape (1, 4)"),
        ([(1, 2.5, 3)], "an array of float64"),
        ([(0, 0, 10**18)], "a coordinate has more than 18 digits"),
        (np.array([[2**64 - 1, 0]], dtype=np.uint64), "a coordinate has more than 18 digits"),
        ([(0, 0, 0), (2**31, 0, 0)], "found 2147483649 x 1 x 1"),
    ],
)
def test_invalid_lists_of_coordinates_are_reported(coordinates: Any, message: str) -> None:
    with pytest.raises(VolumeError) as caught:
        listed(coordinates, "list")
    assert str(caught.value).startswith("list: ")
    assert message in str(caught.value)


HEADERS = [
    b"{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2, (2",
    b"{'descr': ('<f8',), 'fortran_order': False, 'shape': (2, 2, 2)}",
    b"{'descr': '<f8', 'fortran_order': False, 'shape': (99999999999999999999, 2, 2)}",
]


@pytest.mark.parametrize("header", HEADERS)
def test_damaged_npy_headers_are_reported_in_one_line(tmp_path: Path, header: bytes) -> None:
    """numpy's reader raises tokenize.TokenError, IndexError and OverflowError for them."""
    head = header.ljust(118) + b"\n"
    path = tmp_path / "a.npy"
    path.write_bytes(b"\x93NUMPY\x01\x00" + len(head).to_bytes(2, "little") + head + bytes(64))
    with pytest.raises(VolumeError, match="not an NPY array of numbers"):
        read_volume(str(path))


def test_spacings_are_positive_and_negative_ones_of_a_file_are_noted() -> None:
    for spacing in ((-1, 1, 1), (1, 1, Fraction(-1, 2)), ("1", "-2", "1")):
        with pytest.raises(VolumeError, match="ball:8:voxel: spacing: expected positive numbers, found -"):
            read_volume("ball:8", spacing=spacing)
    volume = parse_volume(nrrd(STEPS.astype("u1"), "uchar", "spacings: -1 1 1"), "a.nrrd")
    assert volume.notes == ("a.nrrd: line 8: spacings: a negative number reverses its axis",)


@pytest.mark.parametrize("name", ["a.hdr", "a.img"])
def test_pairs_of_files_are_named_as_unsupported(name: str, tmp_path: Path) -> None:
    (tmp_path / name).write_bytes(bytes(348))
    with pytest.raises(VolumeError, match=r"a pair of files \.hdr and \.img .* is not supported"):
        read_volume(str(tmp_path / name))
