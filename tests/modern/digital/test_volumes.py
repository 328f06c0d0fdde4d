"""Volumes from files and names: what is read, and one line for whatever is wrong."""

from __future__ import annotations

import gzip
import io
import tracemalloc
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from emulator.errors import EmulatorError, FileError
from modern.digital.volumes import Volume, VolumeError, ball, half_ball, listed, parse_volume, read_volume, write_npy

STEPS = np.arange(24).reshape(2, 3, 4) % 5
"""Values 0 to 4 at places that no exchange of axes leaves alone."""


def npy(array: np.ndarray) -> bytes:
    file = io.BytesIO()
    np.save(file, array)
    return file.getvalue()


def nrrd(array: np.ndarray, kind: str, *fields: str, encoding: str = "raw", data: bytes | None = None) -> bytes:
    """An NRRD file as its definition describes it, written out by hand."""
    head = ["NRRD0004", "# a comment", f"type: {kind}", f"dimension: {array.ndim}"]
    head += [f"sizes: {' '.join(map(str, array.shape))}", f"encoding: {encoding}", "key:=value", *fields]
    body = array.tobytes(order="F")
    packed = gzip.compress(body) if encoding in ("gzip", "gz") else body
    return ("\n".join(head) + "\n\n").encode() + (packed if data is None else data)


def same(volume: Volume, array: np.ndarray) -> bool:
    return volume.array.dtype == np.bool_ and np.array_equal(volume.array, array != 0)


def brute_ball(diameter: int, shift: int) -> set[tuple[int, int, int]]:
    """Voxels (i, j, k) with |2 (i, j, k) - shift| at most the diameter."""
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
def test_balls_are_the_voxels_at_most_half_a_diameter_from_their_centre(diameter: int) -> None:
    assert voxels(ball(diameter)) == brute_ball(diameter, 0)
    upper = {voxel for voxel in brute_ball(diameter, 0) if voxel[2] >= 0}
    assert voxels(half_ball(diameter, "voxel")) == upper
    if diameter > 1:
        assert voxels(ball(diameter, "vertex")) == brute_ball(diameter, 1)
        assert voxels(half_ball(diameter)) == {voxel for voxel in brute_ball(diameter, 1) if voxel[2] >= 1}


def test_a_half_ball_cut_through_a_vertex_is_half_of_the_ball() -> None:
    for diameter in range(2, 30):
        assert 2 * half_ball(diameter).count == ball(diameter, "vertex").count


def test_coordinates_are_in_raster_order_and_count_from_the_origin() -> None:
    found = parse_volume(b"x,y,z\n7,-2,5\n6,-2,5\n6,-1,4\n6,-2,4\n", "list")
    assert found.origin == (6, -2, 4)
    assert found.array.shape == (2, 2, 2)
    assert found.coordinates().tolist() == [[6, -2, 4], [6, -1, 4], [6, -2, 5], [7, -2, 5]]
    assert found.notes == ()


def test_a_voxel_listed_again_is_noted() -> None:
    assert parse_volume(b"1,1\n1,2\n1,1\n", "list").notes == ("list: 1 of 3 voxels are listed before",)


@pytest.mark.parametrize("kind", [np.bool_, np.uint8, np.int8, np.int64, np.float32, ">i2"])
def test_npy(kind: str) -> None:
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
def test_nrrd(encoding: str, kind: str, dtype: str, fields: tuple[str, ...]) -> None:
    array = STEPS.astype(dtype)
    assert same(parse_volume(nrrd(array, kind, *fields, encoding=encoding), "a.nrrd"), array)


@pytest.mark.parametrize(("endian", "dtype"), [("little", "<f4"), ("big", ">f4")])
def test_a_negative_zero_is_no_voxel_in_either_order_of_bytes(endian: str, dtype: str) -> None:
    array = np.array([[1.0, -0.0, 2.0]], dtype=dtype)
    data = nrrd(array, "float", f"endian: {endian}", data=array.tobytes(order="F"))
    assert parse_volume(data, "a.nrrd").array.tolist() == [[True, False, True]]
    assert parse_volume(array.tobytes(), "raw", (1, 3), dtype).array.tolist() == [[True, False, True]]


def test_nrrd_with_its_data_in_another_file(tmp_path: Path) -> None:
    array = STEPS.astype("u1")
    (tmp_path / "a.raw").write_bytes(array.tobytes(order="F"))
    header = tmp_path / "a.nhdr"
    header.write_bytes(nrrd(array, "uchar", "data file: a.raw", data=b""))
    assert same(read_volume(str(header)), array)
    (tmp_path / "a.raw").unlink()
    with pytest.raises(FileError, match=r"line 8: a\.raw: no such file"):
        read_volume(str(header))


def test_a_packed_nrrd_is_not_unpacked_beyond_its_sizes() -> None:
    array = np.ones((2, 2, 2), dtype="u1")
    packed = gzip.compress(bytes([1]) * 8 + bytes(10**9))
    tracemalloc.start()
    with pytest.raises(VolumeError, match=r"a\.nrrd: the data go on after the 8 bytes of 2x2x2 numbers"):
        parse_volume(nrrd(array, "uchar", encoding="gzip", data=packed), "a.nrrd")
    assert tracemalloc.get_traced_memory()[1] < 10**7
    tracemalloc.stop()


@pytest.mark.parametrize("damage", [lambda packed: packed[:-8], lambda packed: packed[:-8] + bytes(8)])
def test_a_packed_nrrd_is_checked_by_its_checksum(damage: Callable[[bytes], bytes]) -> None:
    array = np.ones((2, 2, 2), dtype="u1")
    packed = damage(gzip.compress(array.tobytes()))
    with pytest.raises(VolumeError, match=r"a\.nrrd: the data cannot be unpacked"):
        parse_volume(nrrd(array, "uchar", encoding="gzip", data=packed), "a.nrrd")


@given(st.integers(1, 4), st.integers(1, 4), st.integers(1, 4), st.data())
def test_raw_numbers_run_along_x_first(nx: int, ny: int, nz: int, data: st.DataObject) -> None:
    values = data.draw(st.lists(st.integers(0, 3), min_size=nx * ny * nz, max_size=nx * ny * nz))
    values[0] = 1
    found = parse_volume(np.array(values, dtype=">i2").tobytes(), "raw", (nx, ny, nz), ">i2")
    for z in range(nz):
        for y in range(ny):
            for x in range(nx):
                assert found.array[x, y, z] == (values[x + nx * (y + ny * z)] != 0)


def test_raw_bytes_are_uint8_where_no_type_is_given() -> None:
    assert parse_volume(bytes([0, 1, 2, 0]), "raw", (2, 2)).array.tolist() == [[False, True], [True, False]]


def test_names_of_balls() -> None:
    assert read_volume("ball:32").count == 17077
    assert read_volume("ball:6").origin == (-3, -3, -3)
    assert voxels(read_volume("ball:6:vertex")) == voxels(ball(6, "vertex"))
    assert voxels(read_volume("half-ball:6")) == voxels(half_ball(6, "vertex"))
    assert voxels(read_volume("half-ball:6:voxel")) == voxels(half_ball(6, "voxel"))


def test_an_array_written_is_read_again(tmp_path: Path) -> None:
    path = str(tmp_path / "a.npy")
    write_npy(path, STEPS != 0)
    assert same(read_volume(path), STEPS)


BAD_HEADER = nrrd(STEPS.astype("u1"), "uchar")


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", "there are no voxels"),
        (b"x,y,z\n", "there are no voxels"),
        (b"1,2,3\n1,2\n", "line 2, column 1: 2 fields; a voxel has 3"),
        (b"1,2,3,4\n", "line 1, column 1: 4 fields; a voxel has three, x,y,z"),
        (b"1,2,3.5\n", "line 1, field 3: '3.5' is not a whole number"),
        (b"1,2,\n", "line 1, field 3: '' is not a whole number"),
        (b"1,2,-1000000000000000000\n", "line 1, field 3: more than 18 digits"),
        (b"0,0,0\n2000000,2000,2000\n", "lie in a box of 2000001 x 2001 x 2001"),
        (b"\xff\xfe\x00", "neither NPY nor NRRD nor text in UTF-8"),
        (npy(np.zeros((2, 2, 2))), "there are no voxels: every value is 0"),
        (npy(np.ones(8)), "an array of float64 with 1 axes"),
        (npy(np.ones((2, 2, 2), dtype=complex)), "an array of complex128"),
        (npy(np.full((2, 2, 2), np.nan)), "a value is not a number"),
        (npy(np.array([[[None]]], dtype=object)), "no NPY array of numbers: "),
        (npy(STEPS)[:100], "no NPY array of numbers: "),
        (npy(STEPS)[:-5], "no NPY array of numbers: "),
        (BAD_HEADER.replace(b"dimension: 3", b"dimension: 4"), "line 4: 4 axes; a volume has two or three"),
        (BAD_HEADER.replace(b"dimension: 3", b"dimension: x"), "line 4: dimension: 'x' is not a whole number"),
        (BAD_HEADER.replace(b"sizes: 2 3 4", b"sizes: 2 3"), "line 5: sizes: 3 numbers above 0 are due"),
        (BAD_HEADER.replace(b"sizes: 2 3 4", b"sizes: 2 0 4"), "line 5: sizes: 3 numbers above 0 are due"),
        (BAD_HEADER.replace(b"sizes: 2 3 4", b"sizes: 99999 99999 99999"), "line 5: a volume of more than"),
        (BAD_HEADER.replace(b"type: uchar", b"type: block"), "line 3: type: 'block' is not read"),
        (BAD_HEADER.replace(b"type: uchar", b"type: short"), "the header has no field 'endian'"),
        (BAD_HEADER.replace(b"type: uchar", b"type: int\nendian: odd"), "line 4: endian: 'odd' is neither"),
        (BAD_HEADER.replace(b"type: uchar\n", b""), "the header has no field 'type'"),
        (BAD_HEADER.replace(b"encoding: raw", b"encoding: hex"), "line 6: encoding: 'hex' is not read"),
        (BAD_HEADER.replace(b"encoding: raw", b"encoding: gzip"), "the data cannot be unpacked"),
        (BAD_HEADER.replace(b"# a", b"a"), "line 2, column 1: neither a field nor a comment"),
        (BAD_HEADER.replace(b"# a", b"type: a"), "line 3, column 1: type stands twice"),
        (BAD_HEADER.replace(b"key:=", b"byte skip: -1\nkey:="), "line 7: byte skip: only 0 is read"),
        (BAD_HEADER.replace(b"key:=", b"data file: LIST\nkey:="), "line 7: data in several files are not read"),
        (BAD_HEADER.replace(b"type: uchar", b"type: int").replace(b"raw", b"ascii"), "encoding: 'ascii' is not read"),
        (BAD_HEADER[:-3], "the data end after 21 of 24 bytes"),
        (BAD_HEADER + b"12", "the data go on after the 24 bytes of 2x3x4 numbers"),
    ],
)
def test_bad_files_are_told_in_one_line(data: bytes, message: str) -> None:
    with pytest.raises(EmulatorError) as caught:
        parse_volume(data, "file")
    assert str(caught.value).startswith("file: ")
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("shape", "dtype", "message"),
    [
        ((2, 2, 3), None, "file: 8 bytes; 2x2x3 numbers of uint8 are 12 bytes"),
        ((2, 2, 1), "i1", "file: 8 bytes; 2x2x1 numbers of int8 are 4 bytes"),
        ((2, 2, 2), "nonsense", "--dtype: 'nonsense' is not a type of numbers"),
        ((2, 2, 2), ",", "--dtype: ',' is not a type of numbers"),
        ((2, 2, 2), "(99999999999,)u1", "--dtype: '(99999999999,)u1' is not a type of numbers"),
        ((2, 2, 2), "U4", "--dtype: <U4 is not a type of numbers"),
        (None, "u1", "--dtype: bare numbers need --shape"),
        ((8,), "u1", "--shape: two or three numbers"),
        ((0, 2, 2), "u1", "--shape: two or three numbers"),
    ],
)
def test_bad_shapes(shape: tuple[int, ...] | None, dtype: str | None, message: str) -> None:
    with pytest.raises(VolumeError) as caught:
        parse_volume(bytes(range(8)), "file", shape, dtype)
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("ball:0", "ball:0:voxel: the diameter is a whole number from 1 on"),
        ("ball:1:vertex", "ball:1:vertex: there is no voxel in it"),
        ("half-ball:99999", "half-ball:99999:vertex: the diameter is at most 1289"),
        ("ball:x", "ball:x: a ball is ball:DIAMETER"),
        ("ball:8:centre", "ball:8:centre: a ball is ball:DIAMETER"),
        ("missing.npy", "missing.npy: no such file or directory"),
        (".", ".: is a directory"),
        ("a\0b", "'a\\x00b': not a file name"),
    ],
)
def test_bad_names(name: str, message: str) -> None:
    with pytest.raises((FileError, VolumeError)) as caught:
        read_volume(name)
    assert str(caught.value).startswith(message)


def test_standard_input(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(npy(STEPS)), encoding="utf-8"))
    assert same(read_volume("-"), STEPS)
    monkeypatch.setattr("sys.stdin", None)
    with pytest.raises(EmulatorError, match="standard input is closed"):
        read_volume("-")


def test_a_list_of_coordinates() -> None:
    volume = listed(np.array([[-100, 3, 2], [100, 4, 2], [-100, 3, 2]], dtype=np.int8), "list")
    assert (volume.count, volume.origin, volume.array.shape) == (2, (-100, 3, 2), (201, 2, 1))
    assert volume.coordinates().tolist() == [[-100, 3, 2], [100, 4, 2]]
    assert volume.notes == ("list: 1 of 3 voxels are listed before",)
    assert listed([(5, 6)]).dimension == 2


@pytest.mark.parametrize(
    ("coordinates", "message"),
    [
        ([], "there are no voxels"),
        ([1, 2, 3], "two or three a voxel, not an array of int64 of shape (3,)"),
        ([(1, 2, 3, 4)], "of shape (1, 4)"),
        ([(1, 2.5, 3)], "an array of float64"),
        ([(0, 0, 10**18)], "a coordinate has more than 18 digits"),
        (np.array([[2**64 - 1, 0]], dtype=np.uint64), "a coordinate has more than 18 digits"),
        ([(0, 0, 0), (2**31, 0, 0)], "lie in a box of 2147483649 x 1 x 1"),
    ],
)
def test_what_is_no_list_of_coordinates(coordinates: Any, message: str) -> None:
    with pytest.raises(VolumeError) as caught:
        listed(coordinates, "list")
    assert str(caught.value).startswith("list: ")
    assert message in str(caught.value)


def test_a_ball_takes_no_shape_and_no_other_centre() -> None:
    with pytest.raises(VolumeError, match="no --shape"):
        read_volume("ball:8", (2, 2, 2))
    with pytest.raises(VolumeError, match="the centre is voxel or vertex"):
        ball(8, "edge")


@pytest.mark.parametrize(
    ("array", "origin"),
    [
        (np.ones((2, 2), dtype=np.uint8), (0, 0)),
        (np.ones(2, dtype=np.bool_), (0,)),
        (np.ones((2, 2), dtype=np.bool_), (0, 0, 0)),
    ],
)
def test_a_volume_is_made_of_truth_values(array: np.ndarray, origin: tuple[int, ...]) -> None:
    with pytest.raises(VolumeError):
        Volume(array, origin)


HEADERS = [
    b"{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2, (2",
    b"{'descr': ('<f8',), 'fortran_order': False, 'shape': (2, 2, 2)}",
    b"{'descr': '<f8', 'fortran_order': False, 'shape': (99999999999999999999, 2, 2)}",
]


@pytest.mark.parametrize("header", HEADERS)
def test_a_damaged_header_of_an_array_is_one_line(tmp_path: Path, header: bytes) -> None:
    """numpy's reader of it ends in tokenize.TokenError, IndexError, OverflowError."""
    head = header.ljust(118) + b"\n"
    path = tmp_path / "a.npy"
    path.write_bytes(b"\x93NUMPY\x01\x00" + len(head).to_bytes(2, "little") + head + bytes(64))
    with pytest.raises(VolumeError, match="no NPY array of numbers"):
        read_volume(str(path))
