"""Points read from lists, OBJ, PLY, STL, JSON and NPY files, and invalid files."""

import io
import struct
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from emulator.errors import EmulatorError
from modern.exact_hull import exact_hull
from modern.formats.export import export_text
from modern.formats.ply import surface
from modern.formats.points import Input, parse_bytes
from modern.port import convex_hull
from tests.support.commands import call

POINTS = [("1", "-2.50", "3e-6"), ("12.345678", "0", ".9E91"), ("0", "0", "0"), ("-1", "5", "7")]
EXACT = [tuple(map(Fraction, point)) for point in POINTS]
CUBE = [(x, y, z) for x in (0, 2) for y in (0, 2) for z in (0, 2)]


def read(data: str | bytes, name: str = "points") -> Input:
    return parse_bytes(data.encode() if isinstance(data, str) else data, name)


def numbers(found: Input) -> list[tuple[Fraction, ...]]:
    return [tuple(Fraction(text) for text in point) for point in found.points]


@pytest.mark.parametrize("separator", [",", ", ", ";", " ; ", "\t", " ", "   ", " \t "])
@pytest.mark.parametrize("heading", ["", "x y z", "x1 y1 z1", "X Y Z[mm]", "# x y z", "# a comment\n\n# and another"])
def test_lists_are_read_with_every_separator_and_heading(separator: str, heading: str) -> None:
    head = heading if heading.startswith("#") else separator.join(heading.split(" "))
    text = "\n".join([head, *(separator.join(point) for point in POINTS), ""])
    found = read(text)
    assert (found.kind, numbers(found)) == ("csv", EXACT)
    assert found.places[0] == f"line {2 + head.count(chr(10))}"


@pytest.mark.parametrize("text", ["nan,nan,nan\n1,2,3\n", "x,1,2\n1,2,3\n", "inf inf inf\n1 2 3\n", "1,5;2,5;3,5\n"])
def test_an_invalid_first_row_is_not_taken_for_a_heading(text: str) -> None:
    with pytest.raises(EmulatorError, match=r"line 1, field 1: .* is not a decimal number"):
        read(text)


@pytest.mark.parametrize("form", ["off", "obj", "ply", "stl", "json"])
@settings(deadline=None, max_examples=40)
@given(points=st.lists(st.tuples(*[st.decimals(-99, 99, places=3).map(str)] * 3), min_size=4, max_size=12))
def test_written_files_are_read_exactly(form: str, points: list[tuple[str, str, str]]) -> None:
    hull = convex_hull(points)
    if hull.dimension < 2:
        return
    found = read(export_text(hull, form), f"hull.{form}")
    assert found.kind == form
    if form == "json":
        assert numbers(found) == [tuple(map(Fraction, point)) for point in points]
    else:
        vertices = {tuple(map(Fraction, hull.points[index])) for index in hull.vertices}
        assert set(numbers(found)) == vertices
        assert len(found.points) == len(vertices)
    assert len(exact_hull(found.points).vertices) == len(hull.vertices)


@pytest.mark.parametrize("kind", [np.int8, np.uint64, np.float16, np.float32, np.float64, np.longdouble])
def test_an_array_is_read_exactly(kind: type) -> None:
    array = np.array([(0.1, 0, 3), (100, 5, 0), (7, 7, 7)]).astype(kind)
    file = io.BytesIO()
    np.save(file, array)
    found = read(file.getvalue())
    assert numbers(found) == [tuple(Fraction(*x.as_integer_ratio()) for x in row) for row in array.astype(object)]
    assert (found.kind, found.places) == ("npy", ("row 1", "row 2", "row 3"))


@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize(("word", "code"), [("float", "f"), ("double", "d"), ("short", "h"), ("int32", "i")])
def test_binary_ply_is_read_exactly(order: str, word: str, code: str) -> None:
    name = {"<": "binary_little_endian", ">": "binary_big_endian"}[order]
    header = f"ply\nformat {name} 1.0\ncomment c\nelement camera 1\nproperty uchar a\nelement vertex 2\n"
    header += f"property {word} z\nproperty uchar red\nproperty {word} x\nproperty {word} y\n"
    header += "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    rows = struct.pack(f"{order}B" + f"{code}B{code}{code}" * 2, 7, 3, 255, 1, 2, 6, 0, 4, 5)
    found = read(header.encode() + rows + b"\x03\0\0\0\0")
    assert numbers(found) == [(1, 2, 3), (4, 5, 6)]
    assert found.places == ("vertex 1", "vertex 2")
    with pytest.raises(EmulatorError, match="the file ends after 1 of 2 vertices"):
        read(header.encode() + rows[:-1])
    face = struct.pack(f"{order}Biii", 3, 0, 1, 2)
    with pytest.raises(EmulatorError, match=r"face 1: there is no vertex 2; they are numbered from 0 to 1$"):
        surface(header.encode() + rows + face, "a.ply")


def test_binary_stl_is_read_exactly_and_each_point_once() -> None:
    triangles = [((0, 0, 0), (1, 0, 0), (0, 1, 0)), ((0, 0, 0), (0, 1, 0), (0.1, 0.2, 3))]
    body = b"".join(struct.pack("<12fH", 0, 0, 1, *sum(triangle, ()), 0) for triangle in triangles)
    found = read(b"solid or not".ljust(80) + struct.pack("<I", 2) + body, "a.stl")
    tenth, fifth = (Fraction(float(np.float32(number))) for number in (0.1, 0.2))
    assert numbers(found) == [(0, 0, 0), (1, 0, 0), (0, 1, 0), (tenth, fifth, 3)]
    assert found.places == ("triangle 1", "triangle 1", "triangle 1", "triangle 2")


@pytest.mark.parametrize(
    "text",
    [
        "[[1,2,3],[0.5,0,1e-2]]",
        '{"points": [["1","2","3"],[".5","0",".01"]]}',
        '{"a": 1, "vertices": [[1,2,3],[5e-1,0,0.010]]}',
    ],
)
def test_json_of_other_programs_is_read(text: str) -> None:
    assert numbers(read(text)) == [(1, 2, 3), (Fraction(1, 2), 0, Fraction(1, 100))]


@pytest.mark.parametrize(
    ("data", "words"),
    [
        ("[[1,2]]", "point 1 is not a list of three numbers"),
        ("[[1,2,null]]", "point 1, z: null is not a number"),
        ("[[1,2,NaN]]", "point 1, z: 'NaN' is not a decimal number"),
        ("{}", 'the JSON object has no list "points"'),
        ("[1", "line 1, column 3: not JSON"),
        ("[" * 100_000, "the JSON is nested too deeply"),
        ("[]", "there are no points"),
        ("v 1 2\n", "line 1, column 5: expected a vertex of 3 numbers, x y z; found 2"),
        ("v 1 2 x\n", "line 1, column 7: 'x' is not a decimal number"),
        ("solid a\nvertex 1 2\n", "line 2, column 10: expected a vertex of 3 numbers"),
        ("solid a\nendsolid a\n", "there are no points"),
        ("ply\nformat ascii 1.0\n", "line 1, column 1: the header has no line end_header"),
        ("ply\nelement vertex 0\nproperty int x\nend_header\n", "line 2, column 1: the format (ascii"),
        ("ply\nformat ascii 1.0\nend_header\n", "the header announces no element vertex"),
        ("ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nend_header\n1\n", "no properties x, y and z"),
        ("ply\nformat ascii 1.0\nelement vertex x\nend_header\n", "line 3, column 16: 'x' is not a count"),
        ("ply\nformat ascii 1.0\nwhat\nend_header\n", "line 3, column 1: 'what' is not a line of a PLY header"),
        (b"\x93NUMPY\x01\0\xff", "not an NPY array of numbers"),
    ],
)
def test_a_damaged_file_is_rejected_in_one_line(data: str | bytes, words: str) -> None:
    with pytest.raises(EmulatorError) as caught:
        read(data, "a")
    assert str(caught.value).startswith("a: ")
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("shape", [(3,), (2, 4), (1, 3, 1)])
def test_an_array_of_another_shape_is_rejected(shape: tuple[int, ...]) -> None:
    file = io.BytesIO()
    np.save(file, np.zeros(shape))
    with pytest.raises(EmulatorError, match="expected an array of numbers of shape"):
        read(file.getvalue())


def test_export_and_cards_read_every_format(tmp_path: Path, capsys) -> None:
    for form in ("off", "obj", "ply", "stl", "json"):
        (tmp_path / f"a.{form}").write_text(export_text(convex_hull(CUBE), form), encoding="ascii")
    np.save(tmp_path / "a.npy", np.array(CUBE, np.float32))
    (tmp_path / "a.txt").write_text("x\ty\tz\n" + "\n".join("\t".join(map(str, p)) for p in CUBE), encoding="ascii")
    for path in sorted(tmp_path.iterdir()):
        code, out, _ = call(capsys, "export", str(path), "--format", "off")
        assert (code, out.splitlines()[1]) == (0, "8 6 12"), path
        code, out, _ = call(capsys, "cards", str(path))
        assert (code, out.splitlines()[0], out.count("\n")) == (0, " 8", 9), path
