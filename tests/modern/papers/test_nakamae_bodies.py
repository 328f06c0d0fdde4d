"""Tests of reading solids from files: connected components, proofs of convexity, hulls, and merged faces."""

import random
import struct
from fractions import Fraction
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from emulator.errors import EmulatorError, FileError
from modern.exact_hull import exact_hull
from modern.formats.export import export_text
from modern.formats.points import parse_mesh
from modern.formats.tokens import FileMesh
from modern.geometry.coplanar import CoplanarError
from modern.papers.nakamae_nishita.bodies import Bodies, Reading, bodies, read_bodies
from modern.papers.nakamae_nishita.hidden import draw
from modern.papers.nakamae_nishita.polyhedron import Polyhedron, SceneError, checked
from modern.papers.nakamae_nishita.projection import parallel
from modern.port import convex_hull
from tests.support.solids import CUBE, CUBE_FACES, ELL, ELL_FACES, Point, binary_stl, cut, dodecahedron, twelve_faces


def file_mesh(points: list[tuple[object, ...]], faces: list[tuple[int, ...]], name: str = "f") -> FileMesh:
    texts = tuple((str(x), str(y), str(z)) for x, y, z in points)
    return FileMesh(name, texts, tuple(range(len(points))), tuple(faces))


def read_mesh(points: list[tuple[object, ...]], faces: list[tuple[int, ...]], reading: Reading | None = None) -> Bodies:
    return bodies(file_mesh(points, faces), reading or Reading(), "f")


def shape(polyhedron: Polyhedron) -> set[frozenset[tuple[Fraction, ...]]]:
    """Return the faces as sets of points."""
    return {frozenset(polyhedron.vertices[place] for place in face) for face in polyhedron.faces}


@settings(deadline=None, max_examples=20)
@given(st.integers(0, 10**6), st.integers(1, 4), st.booleans(), st.sampled_from(["off", "obj", "ply", "stl"]))
def test_components_are_the_solids_written_to_the_file(seed: int, number: int, inward: bool, form: str) -> None:
    """Write disjoint solids as OFF, OBJ, PLY or STL, with shuffled faces that all run inward or all outward."""
    source = random.Random(seed)
    points: list[tuple[object, ...]] = []
    faces: list[tuple[int, ...]] = []
    solids = []
    while len(solids) < number:
        corners = [tuple(source.randrange(-5, 6) for _ in range(3)) for _ in range(source.randrange(4, 9))]
        corners = [(x + 20 * len(solids), y, z) for x, y, z in corners]
        hull = exact_hull(corners)
        if hull.dimension < 3:
            continue
        place = {index: len(points) + k for k, index in enumerate(hull.vertices)}
        points += [corners[index] for index in hull.vertices]
        polygons = [tuple(place[index] for index in facet.polygon) for facet in hull.facets]
        faces += [face[::-1] for face in polygons] if inward else polygons
        solids.append({frozenset(tuple(map(Fraction, points[k])) for k in face) for face in polygons})
    source.shuffle(faces)
    if form == "off":
        text = f"OFF\n{len(points)} {len(faces)} 0\n" + "".join(" ".join(map(str, p)) + "\n" for p in points)
        data = (text + "".join(" ".join(map(str, (len(f), *f))) + "\n" for f in faces)).encode()
    elif form == "obj":
        rows = ["v " + " ".join(map(str, p)) for p in points]
        signs = [source.choice((str(k + 1), str(k - len(points)), f"{k + 1}/1/2")) for k in range(len(points))]
        data = "\n".join([*rows, *("f " + " ".join(signs[k] for k in face) for face in faces), ""]).encode()
    elif form == "ply":
        data = ply(points, faces, source.choice(("ascii", "binary_little_endian", "binary_big_endian")))
    else:
        data = binary_stl(cut(points, faces))
    result = bodies(parse_mesh(data, f"a.{form}"), Reading(), "a")
    assert len(result.polyhedra) == number
    assert (result.notes == ()) == (number == 1)
    for polyhedron in result.polyhedra:
        assert checked(polyhedron) == polyhedron
        if form != "stl":
            assert shape(polyhedron) in solids
    merged = [{p for face in solid for p in face} for solid in solids]
    assert sorted(map(sorted, merged)) == sorted(sorted(p.vertices) for p in result.polyhedra)


def ply(points: Any, faces: Any, form: str) -> bytes:
    """Return a PLY file whose faces, with a list of colours, come before its vertices, with a list of weights."""
    lines = ["ply", f"format {form} 1.0", f"element face {len(faces)}", "property list uchar uchar colours"]
    lines += ["property list uchar int vertex_indices", f"element vertex {len(points)}", "property float x"]
    lines += ["property list ushort double weights", "property double y", "property int z", "end_header", ""]
    if form == "ascii":
        rows = [f"1 7 {len(face)} {' '.join(map(str, face))}" for face in faces] + [
            f"{x} 0 {y} {z}" for x, y, z in points
        ]
        return ("\n".join([*lines[:-1], *rows]) + "\n").encode()
    order = "<" if form == "binary_little_endian" else ">"
    body = [struct.pack(f"{order}BBB{len(face)}i", 1, 7, len(face), *face) for face in faces]
    body += [struct.pack(f"{order}fHddi", float(x), 1, 0.5, float(y), int(z)) for x, y, z in points]
    return "\n".join(lines).encode() + b"".join(body)


def test_the_faces_of_an_invalid_ply_file_are_rejected_with_their_place() -> None:
    data = ply(CUBE, CUBE_FACES, "ascii")
    assert len(parse_mesh(data, "a.ply").faces) == 6
    for old, new, message in (
        (b"4 0 ", b"4 9 ", "there is no vertex 9; they are numbered from 0 to 7"),
        (b"vertex_indices", b"corners", "a face has no list vertex_indices"),
        (b"element face 6", b"element tristrips 6", "an element tristrips, but only an element face can be read"),
        (b"element vertex 8", b"element vertex 9", "the file ends after 8 of 9 vertices"),
    ):
        assert old in data
        with pytest.raises(FileError, match=message):
            parse_mesh(data.replace(old, new, 1), "a.ply")


def test_touching_solids_in_an_stl_file_are_separate_components() -> None:
    """Two cubes share an edge or a corner. The mesh read from STL contains each common point once."""
    for shift in ((1, 1, 0), (1, 1, 1)):
        second_cube = [tuple(a + b for a, b in zip(p, shift, strict=True)) for p in CUBE]
        data = binary_stl([*cut(CUBE, CUBE_FACES), *cut(second_cube, CUBE_FACES)])
        surface = parse_mesh(data, "a.stl")
        assert len(surface.points) == 16 - (2 if shift == (1, 1, 0) else 1)
        assert len(bodies(surface, Reading(), "a").polyhedra) == 2


def test_the_message_names_the_reflex_edge_and_the_remedies() -> None:
    points = [(x, y, z) for z in (0, 1) for x, y in ELL]
    with pytest.raises(SceneError) as caught:
        read_mesh(points, ELL_FACES)
    assert str(caught.value) == (
        "f: not convex: between faces 5 and 6 the edge of vertices 4 and 10, (1, 1, 0) and (1, 1, 1), is reflex: "
        "face 6 rises 2 above the plane of face 5; divide the solid along this plane, take its hull (hull = true), or, "
        'if the cause is rounding, merge faces within a distance (coplanar_within = "E")'
    )
    result = read_mesh(points, ELL_FACES, Reading(hull=True))
    assert result.notes == ("f: not convex, replaced by its hull",)
    assert sorted(result.polyhedra[0].vertices) == sorted(tuple(map(Fraction, p)) for p in points if p[:2] != (1, 1))


def test_deviations_beyond_the_distance_are_rejected() -> None:
    points = [(x, y, z) for z in (0, 1) for x, y in ELL]
    with pytest.raises(
        SceneError, match=r"between faces 5 and 6 the edge of vertices 4 and 10, .* is reflex: face 6 rises 2 "
    ):
        read_mesh(points, ELL_FACES, Reading(within=Fraction(1, 100)))
    walls = [(k, k + 5, (k + 1) % 5 + 5, (k + 1) % 5) for k in range(5)]
    star = [(x, y, z) for z in (0, 9) for x, y in STAR]
    with pytest.raises(SceneError, match=r"^f: face 1 does not lie within 1/100 of the hull of the vertices$"):
        read_mesh(star, [*walls, (0, 1, 2, 3, 4), (9, 8, 7, 6, 5)], Reading(within=Fraction(1, 100)))


@pytest.mark.parametrize("seed", range(12))
def test_the_message_names_the_deepest_reflex_edge(seed: int) -> None:
    """Read a star-shaped prism whose four reflex edges have known, different depths."""
    source = random.Random(seed)
    outer = [(20, 0), (0, 20), (-20, 0), (0, -20)]
    depths = source.sample(range(1, 10), 4)
    ring = [p for (x, y), (u, v), d in zip(outer, [*outer[1:], outer[0]], depths, strict=True)
            for p in ((x, y), ((x + u) * (10 - d) // 20, (y + v) * (10 - d) // 20))]  # fmt: skip
    n = len(ring)
    points = [(x, y, z) for z in (0, 5) for x, y in ring]
    faces = [tuple(range(n))[::-1], tuple(range(n, 2 * n))]
    faces += [(k, (k + 1) % n, (k + 1) % n + n, k + n) for k in range(n)]
    with pytest.raises(SceneError, match="is reflex: ") as caught:
        read_mesh(points, faces)
    corner = 2 * depths.index(max(depths)) + 1
    assert f"the edge of vertices {corner + 1} and {corner + 1 + n}," in str(caught.value)


def test_rounded_faces_are_rejected_with_their_deviation_and_merged_within_a_distance() -> None:
    points = dodecahedron()
    hull = convex_hull(points)
    triangles = parse_mesh(export_text(hull, "off").encode(), "d.off")
    assert len(bodies(triangles, Reading(), "d").polyhedra[0].faces) == 36
    text = export_text(twelve_faces(), "off").encode()
    with pytest.raises(
        SceneError,
        match=r"^d: face \d+ is not plane: a vertex is \d\.\d+e-16 away from its plane; coplanar_within = \"E\" merges",
    ):
        bodies(parse_mesh(text, "d.off"), Reading(), "d")
    result = bodies(parse_mesh(text, "d.off"), Reading(within=Fraction(1, 10**9)), "d")
    assert result.notes[0].startswith("d: 36 faces are joined into 12 within 1e-9; a vertex lies at most ")
    drawing = draw(result.polyhedra, parallel((3, -5, 2)), hidden=True)
    assert len({(piece.start, piece.end) for piece in drawing.pieces}) == 30
    separate_faces = Polyhedron("d", result.polyhedra[0].vertices, result.polyhedra[0].faces)
    unmerged = draw([separate_faces], parallel((3, -5, 2)), hidden=True)
    assert {(p.start, p.end, p.visible) for p in drawing.pieces} < {
        (p.start, p.end, p.visible) for p in unmerged.pieces
    }
    assert "joined" in {edge.kind for edge in drawing.solids[0].edges}
    with pytest.raises(CoplanarError, match=r"^d: within 2 the 36 faces would become 2 faces; "):
        bodies(parse_mesh(text, "d.off"), Reading(within=Fraction(2)), "d")


def test_the_outline_is_complete_when_a_merged_face_is_edge_on() -> None:
    """One side of a slab bends by 1/1000. Seen along that side, the contour runs between its two merged faces."""
    base = [(0, 0), (10, 0), (Fraction(10001, 1000), 5), (10, 10), (0, 10)]
    points = [(x, y, z) for z in (0, 3) for x, y in base]
    faces = [(4, 3, 2, 1, 0), (5, 6, 7, 8, 9), *((k, (k + 1) % 5, (k + 1) % 5 + 5, k + 5) for k in range(5))]
    (slab,) = read_mesh(points, faces, Reading(within=Fraction(1, 100))).polyhedra
    assert len(set(slab.joined)) == 6
    front, along = draw([slab], parallel((5, 1, 2))), draw([slab], parallel((0, -5, 2)))
    bend = tuple(sorted(k for k, v in enumerate(slab.vertices) if v[1] == 5))
    assert bend not in {(piece.start, piece.end) for piece in front.pieces}
    assert bend in {(piece.start, piece.end) for piece in along.pieces}
    for drawing in (front, along):
        contour = drawing.solids[0].contour
        drawn = {frozenset((piece.start, piece.end)) for piece in drawing.pieces}
        assert all(frozenset(side) in drawn for side in zip(contour, (*contour[1:], contour[0]), strict=True))


@pytest.mark.parametrize(
    ("points", "faces", "message"),
    [
        (CUBE, CUBE_FACES[1:], "f: not closed: only one face at the edge of vertices 1 and 2, (0, 0, 0) and (1, 0, 0)"),
        (CUBE, [(3, 2, 1, 1), *CUBE_FACES[1:]], "f: face 1 does not have at least three different vertices"),
        (
            CUBE,
            [(0, 1, 2, 3), *CUBE_FACES[1:]],
            "f: two faces run in the same direction along the edge of vertices 1 and 2",
        ),
        ([*CUBE[:7], (0, 0, 0)], CUBE_FACES, "f: vertices 1 and 8 are the same point"),
        (
            [*CUBE[:7], (0, 1, "9/8")],
            CUBE_FACES,
            "f: face 2 is not plane: a vertex is 0.0623 away from its plane; coplanar_within",
        ),
    ],
)
def test_invalid_surfaces_are_rejected(points: list[Point], faces: list[tuple[int, ...]], message: str) -> None:
    with pytest.raises(SceneError) as caught:
        read_mesh(points, faces)
    assert str(caught.value).startswith(message)
    assert "\n" not in str(caught.value)


HALF = Fraction(1, 2)
STAR = [(0, 30), (18, -24), (-29, 9), (29, 9), (-18, -24)]
TETRA = [(0, 0, 0), (6, 0, 0), (0, 6, 0), (0, 0, 6)]
MIDDLES = [(3, 0, 0), (0, 3, 0), (0, 0, 3), (3, 3, 0), (3, 0, 3), (0, 3, 3)]
"""The midpoints of the edges 01, 02, 03, 12, 13 and 23, which are the vertices 4 to 9."""


@pytest.mark.parametrize(
    ("points", "faces", "message"),
    [
        (
            [*CUBE, (HALF, 0, 1)],
            [CUBE_FACES[0], (4, 8, 5, 6, 7), *CUBE_FACES[2:], (5, 8, 4)],
            "f: face 7 is not a polygon",
        ),
        (
            [(x, y, z) for z in (0, 9) for x, y in STAR],
            [*((k, k + 5, (k + 1) % 5 + 5, (k + 1) % 5) for k in range(5)), (0, 1, 2, 3, 4), (9, 8, 7, 6, 5)],
            "f: not convex: face 1 does not lie on the hull of the vertices",
        ),
        (
            [*CUBE[:4], *((x, y, 2) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1), (0, HALF), (HALF, 0), (HALF, HALF)))],
            [CUBE_FACES[0], (4, 9, 10, 8), (9, 5, 6, 7, 8, 10), (0, 1, 5, 9, 4), *CUBE_FACES[3:5], (3, 0, 4, 8, 7)],
            "f: face 3 is not convex",
        ),
        (
            [*TETRA, *MIDDLES],
            [face[::-1] for face in ((0, 1, 2), (1, 4, 0, 3), (0, 2, 3), (1, 3, 2))]
            + [face[::-1] for face in ((0, 4, 1, 7, 2, 5), (1, 0, 6, 3, 8), (0, 5, 2, 9, 3, 6), (1, 8, 3, 9, 2, 7))],
            "f: not one closed surface: vertices - edges + faces is not 2",
        ),
    ],
)
def test_closed_surfaces_without_reflex_edges_can_still_be_invalid(points, faces, message) -> None:
    """Reject a degenerate face, a prism over a star, a face that is not convex, and a tetrahedron covered twice."""
    with pytest.raises(SceneError) as caught:
        read_mesh(points, faces)
    assert str(caught.value) == message


def test_notes_report_unused_vertices_and_repeated_points() -> None:
    result = read_mesh([*CUBE, (9, 9, 9)], CUBE_FACES)
    assert result.notes == ("f: 1 of 9 vertices belong to no face",)
    with pytest.raises(SceneError, match=r"^a: expected faces, found only points; hull = true uses their hull$"):
        read_bodies(b"0,0,0\n1,0,0\n0,1,0\n0,0,1\n", "a", Reading())
    for data in (b"0,0,0\n1,0,0\n0,1,0\n0,0,1\n0,0,0\n", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 0 0\n"):
        of_points = read_bodies(data, "a", Reading(hull=True))
        assert len(of_points.polyhedra[0].faces) == 4
        assert of_points.notes == ("a: line 5: this point repeats that of line 1",)
    flat = read_bodies(b"0,0,0\n1,0,0\n0,1,0\n", "a", Reading(hull=True, within=Fraction(1)))
    assert (len(flat.polyhedra[0].faces), flat.notes) == (
        2,
        ("a: the points lie in one plane: there are no faces to join",),
    )


def test_a_plate_is_accepted_and_an_open_surface_is_replaced_by_its_hull() -> None:
    assert len(read_mesh(CUBE[:4], [(0, 1, 2, 3), (3, 2, 1, 0)]).polyhedra[0].faces) == 2
    result = read_mesh(CUBE, CUBE_FACES[1:], Reading(hull=True))
    assert (len(result.polyhedra[0].faces), result.notes) == (6, ("f: not closed, replaced by its hull",))


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"OFF\n0 0 0\n", "expected faces, found only points"),
        (b"v 0 0 0\nf 1 2 3\n", "a.obj: line 2, column 5: there is no vertex '2'; they are numbered from 1 to 1"),
        (b"v 0 0 0\nf -2\n", "a.obj: line 2, column 3: there is no vertex '-2'"),
        (b"v 0 0 0\nf 0\n", "a.obj: line 2, column 3: there is no vertex '0'"),
        (b"v 0 0 0\nf a\n", "a.obj: line 2, column 3: 'a' is not the number of a vertex"),
        (b"v 0 0 0\nf\n", "a.obj: line 2, column 1: a face needs at least one vertex"),
        (b"solid a\nfacet\nvertex 0 0 0\nendfacet\n", "line 4, column 1: expected a triangle of 3 vertices, found 1"),
        (b"solid a\nfacet\nvertex 0 0 0\n", "a.obj: line 3, column 1: the file ends after 1 of 3"),
        (b"ply\n", "a.obj: line 1, column 1"),
    ],
)
def test_malformed_files_are_rejected_with_line_and_column(data: bytes, message: str) -> None:
    with pytest.raises(EmulatorError) as caught:
        read_bodies(data, "a.obj", Reading(points=data.startswith(b"ply")))
    assert message in str(caught.value)
