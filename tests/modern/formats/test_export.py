"""Hulls written as OFF, OBJ, PLY, STL and JSON, and read back by small separate readers."""

import json
import sys
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from modern.formats.export import export_text, format_of, mesh_text, to_trimesh, write_hull
from modern.formats.off import parse_off
from modern.geometry.hull import Face, Hull, Stage
from modern.geometry.mesh import ExportError, Mesh, mesh
from modern.geometry.numbers import decimal_text, finite_decimal, integer_text, number
from modern.port import convex_hull

Exact = tuple[Fraction, Fraction, Fraction]
Shape = tuple[list[Exact], list[tuple[int, ...]]]

CUBE = [(x, y, z) for x in (0, 2) for y in (0, 2) for z in (0, 2)]
SQUARE = [(0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1), (1, 1, 1), (1, 0, 1)]
SEGMENT = [("0", "0", "0"), ("1.50", "3", "-4.5"), ("0.5", "1", "-1.5")]
POINT = [("1E90", "-2.5", "0.125")]


def exact(words: Sequence[str]) -> Exact:
    x, y, z = (Fraction(word) for word in words)
    return x, y, z


def tiny_off(text: str) -> Shape:
    lines = text.splitlines()
    assert lines[0] == "OFF"
    vertices, faces, _ = map(int, lines[1].split())
    rows = [line.split() for line in lines[2:]]
    assert len(rows) == vertices + faces
    assert all(int(row[0]) == len(row) - 1 for row in rows[vertices:])
    return [exact(row) for row in rows[:vertices]], [tuple(map(int, row[1:])) for row in rows[vertices:]]


def tiny_obj(text: str) -> Shape:
    points, faces = [], []
    for kind, *words in map(str.split, text.splitlines()):
        if kind == "v":
            points.append(exact(words))
        else:
            assert kind == "f"
            faces.append(tuple(int(word) - 1 for word in words))
    return points, faces


def tiny_ply(text: str) -> Shape:
    head, _, body = text.partition("end_header\n")
    assert head.startswith("ply\nformat ascii 1.0\n")
    elements = [line.split()[1:] for line in head.splitlines() if line.startswith("element")]
    rows = iter(line.split() for line in body.splitlines())
    found = {name: [next(rows) for _ in range(int(count))] for name, count in elements}
    assert next(rows, None) is None
    assert all(int(row[0]) == len(row) - 1 for row in found["face"])
    return [exact(row) for row in found["vertex"]], [tuple(map(int, row[1:])) for row in found["face"]]


def tiny_stl(text: str) -> list[tuple[tuple[float, ...], list[Exact]]]:
    lines = [line.split() for line in text.splitlines()]
    assert lines[0][0] == "solid"
    assert lines[-1][0] == "endsolid"
    found = []
    for k in range(1, len(lines) - 1, 7):
        facet, loop, *corners, endloop, endfacet = lines[k : k + 7]
        assert (facet[:2], loop, endloop, endfacet) == (
            ["facet", "normal"],
            ["outer", "loop"],
            ["endloop"],
            ["endfacet"],
        )
        assert all(corner[0] == "vertex" for corner in corners)
        found.append((tuple(map(float, facet[2:])), [exact(corner[1:]) for corner in corners]))
    return found


READERS = {"off": tiny_off, "obj": tiny_obj, "ply": tiny_ply}


def expected(hull: Hull) -> Shape:
    """Return vertices and faces of a polyhedron directly from the hull."""
    places = {index: place for place, index in enumerate(hull.vertices)}
    points = [exact(hull.points[index]) for index in hull.vertices]
    return points, [tuple(places[index] for index in face.polygon) for face in hull.faces]


def triple(a: Exact, b: Exact, c: Exact) -> Fraction:
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])


def less(p: Exact, q: Exact) -> Exact:
    return p[0] - q[0], p[1] - q[1], p[2] - q[2]


_SMALL = st.integers(-4, 4)
_CLOUDS = st.lists(st.tuples(_SMALL, _SMALL, _SMALL), min_size=5, max_size=14)
_UNITS = st.sampled_from(["1", "0.001", "1E90", "-1E-90", "0.3"])


def scaled(points: Sequence[tuple[int, int, int]], unit: str) -> list[tuple[str, str, str]]:
    texts = [tuple(finite_decimal(c * Fraction(unit)) or "" for c in p) for p in points]
    return [(x, y, z) for x, y, z in texts]


@given(_CLOUDS, _UNITS)
def test_written_files_have_the_points_and_polygons_of_the_hull(points: list[tuple[int, int, int]], unit: str) -> None:
    hull = convex_hull(scaled(points, unit))
    if hull.dimension < 3:
        return
    want = expected(hull)
    for form, reader in READERS.items():
        assert reader(export_text(hull, form)) == want, form
    read = parse_off(export_text(hull, "off"), "hull.off")
    assert read.points == tuple(hull.points[index] for index in hull.vertices)
    assert [tuple(face) for face in read.faces] == want[1]
    assert all(len(f.polygon) == len(g) for f, g in zip(hull.faces, read.faces, strict=True))


@given(_CLOUDS, _UNITS)
def test_stl_is_closed_and_has_the_volume_of_the_faces(points: list[tuple[int, int, int]], unit: str) -> None:
    hull = convex_hull(scaled(points, unit))
    if hull.dimension < 3:
        return
    triangles = tiny_stl(export_text(hull, "stl"))
    directed = [(t[k], t[k - 2]) for _, t in triangles for k in range(3)]
    assert len(set(directed)) == len(directed)
    assert {(b, a) for a, b in directed} == set(directed)
    vertices, faces = expected(hull)
    middle = vertices[0]
    volume = sum(
        triple(*(less(vertices[face[i]], middle) for i in (0, k, k + 1)))
        for face in faces
        for k in range(1, len(face) - 1)
    )
    assert volume > 0
    assert sum(triple(*(less(p, middle) for p in t)) for _, t in triangles) == volume
    for normal, (a, b, c) in triangles:
        assert abs(sum(n * n for n in normal) - 1) < 1e-8
        u, v = less(b, a), less(c, a)
        largest = max(abs(x) for x in (*u, *v))
        sides = [tuple(float(x / largest) for x in side) for side in (u, v)]
        assert all(abs(sum(n * x for n, x in zip(normal, side, strict=True))) < 1e-8 for side in sides)
        assert triple((Fraction(normal[0]), Fraction(normal[1]), Fraction(normal[2])), u, v) > 0


def test_squares_remain_one_face_in_the_orientation_of_their_plane() -> None:
    hull = convex_hull([*CUBE, (1, 1, 1), (0, 1, 1)])
    _, faces = tiny_off(export_text(hull, "off"))
    assert [len(face) for face in faces] == [4] * 6
    assert export_text(hull, "off").splitlines()[1] == "8 6 12"
    assert len(tiny_stl(export_text(hull, "stl"))) == 12
    hull = convex_hull(SQUARE)
    for form, reader in READERS.items():
        points, faces = reader(export_text(hull, form))
        assert (len(points), [len(face) for face in faces]) == (4, [4]), form
        a, b, c = (points[k] for k in faces[0][:3])
        assert hull.plane is not None
        assert triple(exact(hull.plane[:3]), less(b, a), less(c, a)) > 0
    assert len(tiny_stl(export_text(hull, "stl"))) == 2
    turned = replace(hull, plane=("0", "0", "-16", "16"))
    assert mesh(turned).faces[0][1:] == mesh(hull).faces[0][:0:-1]


@pytest.mark.parametrize(
    "text", ["1.50", "-.25E-3", "1e90", "0.10000000000000000000000000000000000000001", "-0", "12345678901234567890.5"]
)
def test_decimal_text_is_written_unchanged(text: str) -> None:
    hull = replace(convex_hull(CUBE), points=((text, "0", "0"), *convex_hull(CUBE).points[1:]))
    assert f"{text} 0 0" in export_text(hull, "off").splitlines()
    assert f"v {text} 0 0" in export_text(hull, "obj").splitlines()
    assert f"{text} 0 0" in export_text(hull, "ply").splitlines()
    assert f"vertex {text} 0 0" in export_text(hull, "stl").splitlines()


THIRDS = [(Fraction(x, 3), y, Fraction(z, 8)) for x, y, z in CUBE]


def test_a_fraction_without_finite_decimal_is_rejected_or_rounded() -> None:
    hull = convex_hull(THIRDS)
    place = next(k for k, index in enumerate(hull.vertices, 1) if "/" in hull.points[index][0])
    for form in ("off", "obj", "ply", "stl"):
        with pytest.raises(ExportError) as refused:
            export_text(hull, form)
        assert str(refused.value) == (
            f"vertex {place}, x: '2/3' has no finite decimal; give a number of digits to which it is rounded"
        )
    points, _ = tiny_off(export_text(hull, "off", digits=5))
    assert {p[0] for p in points} == {0, Fraction("0.66667")}
    assert {p[2] for p in points} == {0, Fraction("0.25")}
    halved = [(Fraction(x, 6), y, z) for x, y, z in CUBE]
    assert {p[0] for p in tiny_off(export_text(convex_hull(halved), "off", digits=3))[0]} == {0, Fraction("0.333")}
    assert '"2/3"' in export_text(hull, "json")
    with pytest.raises(ExportError, match="digits: expected at least 1, found 0"):
        export_text(hull, "off", digits=0)


@given(st.fractions())
def test_a_finite_decimal_exists_only_for_powers_of_2_and_5(value: Fraction) -> None:
    rest = value.denominator
    while rest % 2 == 0 or rest % 5 == 0:
        rest //= 2 if rest % 2 == 0 else 5
    text = finite_decimal(value)
    assert (text is not None) == (rest == 1)
    if text is not None:
        assert Fraction(text) == value == number(text)
    else:
        rounded = Fraction(decimal_text(str(value), 12))
        assert abs(rounded - value) <= abs(value) / 10**11


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (Fraction(1, 4), "0.25"),
        (Fraction(-7, 40), "-0.175"),
        (Fraction(10**20), "1" + "0" * 20),
        (Fraction(12 * 10**89), "1.2E+90"),
        (Fraction(-3, 10**90), "-3E-90"),
        (Fraction(1, 10**6), "0.000001"),
        (Fraction(0), "0"),
    ],
)
def test_finite_decimals_have_an_exponent_only_if_they_are_long(value: Fraction, text: str) -> None:
    assert finite_decimal(value) == text


def test_large_faces_integers_and_triangles_are_written() -> None:
    assert integer_text(-(10**5000)) == "-1" + "0" * 5000
    for corners, size in ((255, "uchar"), (256, "int")):
        points = tuple((str(k), str(k * k), "0") for k in range(corners))
        text = mesh_text(Mesh(2, points, (tuple(range(corners)),)), "ply")
        assert f"property list {size} int vertex_indices" in text.splitlines()
        assert len(tiny_ply(text)[1][0]) == corners
    # Example 1 of the thesis: program 1 punches the planes of three points and no supporting lines.
    hull = convex_hull([(2, -5, 20), (200, -4, -50), (-30, 80, 4)])
    bare = mesh(replace(hull, faces=()))
    assert len(bare.faces[0]) == 3
    assert bare == mesh(hull)


def test_a_segment_and_a_point_are_written_without_faces() -> None:
    segment, point = convex_hull(SEGMENT), convex_hull(POINT)
    a, b = (" ".join(segment.points[index]) for index in segment.vertices)
    assert export_text(segment, "off") == f"OFF\n2 0 1\n{a}\n{b}\n"
    assert export_text(segment, "obj") == f"v {a}\nv {b}\nl 1 2\n"
    assert export_text(segment, "ply").endswith(
        f"element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n{a}\n{b}\n0 1\n"
    )
    p = " ".join(point.points[0])
    assert Fraction(p.split()[0]) == 10**90
    assert export_text(point, "off") == f"OFF\n1 0 0\n{p}\n"
    assert export_text(point, "obj") == f"v {p}\np 1\n"
    assert export_text(point, "ply").endswith(f"end_header\n{p}\n")
    for hull, what in ((segment, "a segment"), (point, "a point")):
        with pytest.raises(ExportError, match=f"^STL holds triangles; the hull is {what} and has no area$"):
            export_text(hull, "stl")


@pytest.mark.parametrize("points", [THIRDS, [*CUBE, (1, 1, 1), (1, 1, 0), (0, 0, 0)], SQUARE, SEGMENT, POINT])
def test_json_holds_all_data_of_the_hull(points: list[tuple[int, int, int]]) -> None:
    hull = convex_hull(points, history=True)
    read = json.loads(export_text(hull, "json"))

    def tuples(value: object) -> tuple[object, ...]:
        assert isinstance(value, list)
        return tuple(tuples(item) if isinstance(item, list) else item for item in value)

    faces = []
    for face in read["faces"]:
        lowest = tuple(map(int, face["lowest"]))
        faces.append(replace(Face(**{name: tuples(value) for name, value in face.items()}), lowest=lowest))
    history = tuple(
        Stage(**{name: tuples(value) if isinstance(value, list) else value for name, value in stage.items()})
        for stage in read["history"]
    )
    assert read.pop("type") == "hull"
    read["duplicates"] = [[pair["point"], pair["first"]] for pair in read["duplicates"]]
    rest = {name: tuples(value) if isinstance(value, list) else value for name, value in read.items()}
    assert Hull(**{**rest, "faces": tuple(faces), "history": history}) == hull
    assert all(isinstance(n, str) for f in read["faces"] for n in f["lowest"])


def test_a_refused_hull_is_written_only_as_json() -> None:
    hull = replace(convex_hull(CUBE), status="ERROR IN PROGRAM")
    for form in ("off", "obj", "ply", "stl"):
        with pytest.raises(ExportError, match=r"^there is no hull: ERROR IN PROGRAM$"):
            export_text(hull, form)
    assert json.loads(export_text(hull, "json"))["status"] == "ERROR IN PROGRAM"


def test_inconsistent_hulls_have_no_mesh() -> None:
    cube, square = convex_hull(CUBE), convex_hull(SQUARE)
    face = cube.faces[0]
    with pytest.raises(ExportError, match=r"^face 1 names point 8, which is not a vertex$"):
        mesh(
            replace(cube, vertices=tuple(k for k in cube.vertices if k != 7), faces=(replace(face, polygon=(0, 1, 7)),))
        )
    with pytest.raises(ExportError, match="do not form one closed polygon"):
        mesh(replace(square, faces=square.faces[:-1]))
    with pytest.raises(ExportError, match="fewer than three"):
        mesh(replace(cube, faces=(replace(cube.faces[0], polygon=cube.vertices[:2]),)))
    with pytest.raises(ExportError, match="has no faces"):
        mesh(replace(cube, faces=()))
    with pytest.raises(ExportError, match="dimension 1 has 2 vertices, not 8"):
        mesh(replace(cube, dimension=1))


def test_the_extension_determines_the_format() -> None:
    names = ("off", "OBJ", "ply", "Stl", "json")
    assert [format_of(f"a.b/c.{name}") for name in names] == [name.lower() for name in names]
    for name in ("a", "a.txt", "off", "a.off/"):
        with pytest.raises(ExportError, match=r"must end with one of .off, .obj, .ply, .stl, .json, .html$"):
            format_of(name)
    with pytest.raises(ExportError, match="'dxf' is not a mesh format"):
        export_text(convex_hull(CUBE), "dxf")


def test_a_failed_export_leaves_the_existing_file(tmp_path: Path) -> None:
    path = tmp_path / "hull.off"
    path.write_text("before")
    with pytest.raises(ExportError):
        write_hull(convex_hull(THIRDS), str(path))
    assert path.read_text() == "before"
    write_hull(convex_hull(CUBE), str(path))
    assert [p.name for p in tmp_path.iterdir()] == ["hull.off"]
    assert tiny_off(path.read_text()) == expected(convex_hull(CUBE))


def test_a_trimesh_has_the_vertices_of_the_hull_in_their_order() -> None:
    pytest.importorskip("trimesh")
    hull = convex_hull(THIRDS)
    found = to_trimesh(hull)
    assert [tuple(row) for row in found.vertices.tolist()] == [
        tuple(float(number(c)) for c in hull.points[index]) for index in hull.vertices
    ]
    assert len(found.faces) == 12
    assert found.is_watertight
    assert found.is_winding_consistent
    assert found.volume == pytest.approx(2 / 3 * 2 * 2 / 8)
    assert len(to_trimesh(convex_hull(SQUARE)).faces) == 2


def test_to_trimesh_rejects_hulls_that_it_cannot_hold(monkeypatch) -> None:
    with pytest.raises(ExportError, match="the hull has dimension 1 and no area"):
        to_trimesh(convex_hull(SEGMENT))
    monkeypatch.setitem(sys.modules, "trimesh", None)
    with pytest.raises(ExportError, match=r"^to_trimesh needs trimesh: pip install 'hull1620\[mesh\]'$"):
        to_trimesh(convex_hull(CUBE))
    monkeypatch.undo()
    pytest.importorskip("trimesh")
    with pytest.raises(ExportError, match="too large for a binary float"):
        to_trimesh(convex_hull([(f"{x}E400", y, z) for x, y, z in CUBE]))
