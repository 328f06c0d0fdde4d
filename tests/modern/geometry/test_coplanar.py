"""Joining faces that are coplanar to within a distance."""

import json
import math
import random
from collections import Counter
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import hull1620
from modern.formats.export import export_text
from modern.geometry import coplanar
from modern.geometry.hull import Hull
from modern.geometry.mesh import Mesh, mesh, sides
from modern.port import convex_hull
from tests.support.solids import dodecahedron, joined_faces

Points = list[tuple[float, float, float]]


def exact(points: object) -> Hull:
    return convex_hull(points, "exact")


def read(points: object, within: object) -> tuple[Hull, coplanar.Joined]:
    hull, found = coplanar.coplanar(exact(points), within)
    assert found is not None
    return hull, found


def test_a_dodecahedron_in_doubles_has_twelve_faces() -> None:
    points = dodecahedron()
    hull = exact(points)
    assert len(hull.faces) > 30
    found, joined = read(points, "1e-9")
    assert [len(face.polygon) for face in found.faces] == [5] * 12
    assert len(found.vertices) == 20
    # Numpy's own planes: the five of every face lie in one, and no five of another do.
    places = np.array(points)
    for face in found.faces:
        corners = places[list(face.polygon)]
        assert np.linalg.svd(corners - corners.mean(axis=0))[1][2] < 1e-15
        lengths = np.linalg.norm(corners - np.roll(corners, 1, axis=0), axis=1)
        assert np.allclose(lengths, lengths[0])
    assert joined.beyond is not None
    assert 0 < joined.square < Fraction(1, 10**30) < 1 < joined.beyond < 2
    assert hull == exact(points)


def test_a_distance_of_zero_joins_nothing() -> None:
    hull = exact(dodecahedron())
    found, joined = coplanar.coplanar(hull, 0)
    assert joined is not None
    assert (found.faces, found.vertices, joined.square) == (hull.faces, hull.vertices, 0)
    summary = "no two of 36 faces lie within 0 of one plane; another face is joined if the distance is "
    assert summary in coplanar.join_summary(joined)


@settings(deadline=None, max_examples=40)
@given(st.integers(3, 9), st.integers(0, 10**6))
def test_a_perturbed_prism_gets_its_original_faces_back(sides_: int, seed: int) -> None:
    """The faces are those of the prism before every coordinate was moved by at most a billionth."""
    draw = random.Random(seed)
    base = [(math.cos(2 * math.pi * k / sides_), math.sin(2 * math.pi * k / sides_)) for k in range(sides_)]
    points = [
        tuple(Fraction(round(1000 * c), 1000) + Fraction(draw.randint(-1000, 1000), 10**12) for c in (x, y, z))
        for z in (0, draw.choice((1, 3)))
        for x, y in base
    ]
    n = sides_
    faces = {frozenset(range(n)), frozenset(range(n, 2 * n))}
    faces |= {frozenset((k, (k + 1) % n, n + k, n + (k + 1) % n)) for k in range(n)}
    found, joined = read(points, Fraction(1, 10**6))
    assert {frozenset(face.polygon) for face in found.faces} == faces
    assert joined.square <= Fraction(1, 10**14)


@settings(deadline=None, max_examples=60)
@given(st.integers(0, 10**6), st.sampled_from(("0.3", "1", "2", "7/3")))
def test_the_joined_faces_follow_the_definition(seed: int, within: str) -> None:
    draw = random.Random(seed)
    points = [tuple(draw.randrange(-9, 10) for _ in range(3)) for _ in range(draw.randrange(5, 14))]
    hull = exact(points)
    if hull.dimension < 3:
        assert coplanar.coplanar(hull, within) == (hull, None)
        return
    try:
        _, joined = coplanar.coplanar(hull, within)
    except coplanar.CoplanarError:
        return
    assert joined is not None
    expected, greatest = joined_faces(mesh(hull), Fraction(within))
    assert sorted(map(sorted, joined.groups)) == expected
    assert joined.square == greatest
    edges = Counter(edge for loop in joined.loops for edge in sides(loop))
    assert set(edges.values()) == {1}
    assert all((b, a) in edges for a, b in edges)
    kept = {place for loop in joined.loops for place in loop}
    assert len(kept) - len(edges) // 2 + len(joined.loops) == 2
    assert set(joined.left_out) == set(range(len(hull.vertices))) - kept


def test_the_next_distance_joins_one_more_face() -> None:
    hull = exact([(0, 0, 0), (8, 0, 0), (0, 9, 0), (8, 9, 1), (3, 4, 12)])
    _, first = coplanar.coplanar(hull, 0)
    assert first is not None
    assert first.beyond is not None
    _, second = coplanar.coplanar(hull, coplanar.root_text(first.beyond))
    assert second is not None
    assert len(second.groups) == len(first.groups) - 1
    just_below = Fraction(coplanar.root_text(first.beyond)) * Fraction(99, 100)
    _, still = coplanar.coplanar(hull, just_below)
    assert still is not None
    assert len(still.groups) == len(first.groups)


def test_joined_faces_leave_points_out_and_are_written_in_every_format() -> None:
    cube = [(x, y, z) for x in (0, 100) for y in (0, 100) for z in (0, 100)]
    bumps = [(50, 50, Fraction(100001, 1000)), (40, 60, Fraction(1000009, 10000)), (50, Fraction(-1, 1000), 50)]
    found, joined = read([*cube, *bumps], Fraction(1, 100))
    assert sorted(len(face.polygon) for face in found.faces) == [4] * 6
    assert (sorted(found.vertices), sorted(found.boundary)) == ([*range(8)], [8, 9, 10])
    assert sorted(index for face in found.faces for index in face.on) == [8, 9, 10]
    assert len(coplanar.joined_mesh(mesh(exact([*cube, *bumps])), joined).points) == 8
    # The largest triangle on top runs up to the bump in the middle, and its plane on to twice that height.
    words = "a vertex lies at most 0.002 from the plane of its joined face; 3 vertices inside joined faces are left out"
    assert coplanar.join_summary(joined).startswith(f"14 faces are joined into 6 within 0.01; {words}; another")
    found, _ = read(dodecahedron(), "1e-9")
    sizes = [line.split()[0] for line in export_text(found, "off").splitlines()[22:]]
    assert sizes == ["5"] * 12
    assert export_text(found, "obj").count("\nf ") == 12
    assert export_text(found, "stl").count("facet normal") == 36
    assert json.loads(export_text(found, "json"))["coplanar"]["within"] == "1E-9"
    assert json.loads(export_text(exact(dodecahedron()), "json"))["coplanar"] is None
    assert all(a < b for a, b in pairwise(sorted(found.vertices)))


OCTAHEDRON = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
BARE = [(6, -6, 3), (-5, -8, -5), (-6, 8, -2), (-5, -5, -8), (-8, -5, -2), (8, 5, 7)]
CROOKED = [(8, 1, -9), (-7, 7, 0), (3, -6, 7), (-6, 4, 5), (-9, 9, -3), (-3, 2, -8)]


@pytest.mark.parametrize(
    ("points", "within", "message"),
    [
        (dodecahedron(), 5, "all points lie within 5 of the plane of the largest face"),
        (dodecahedron(), 2, "within 2 the 36 faces would become 2 faces; a solid has at least four faces"),
        (BARE, 6, "within 6 the 8 faces would become 3 faces; a solid has at least four faces"),
        (
            CROOKED,
            "3/2",
            "1.5 is too large: a corner of a joined face lies more than this distance inside the convex hull",
        ),
        (OCTAHEDRON, -1, "the distance within which faces are coplanar must be >= 0, not -1"),
        (OCTAHEDRON, "wide", "the distance within which faces are coplanar: 'wide' is not a decimal number"),
        (OCTAHEDRON, math.inf, "the distance within which faces are coplanar: inf is not finite"),
        (OCTAHEDRON, None, "the distance within which faces are coplanar: expected an int, a float"),
    ],
)
def test_unsuitable_distances_are_rejected(points: Points, within: object, message: str) -> None:
    with pytest.raises(coplanar.CoplanarError) as caught:
        coplanar.coplanar(exact(points), within)
    assert str(caught.value).startswith(message)


def test_a_joined_face_with_a_hole_is_rejected() -> None:
    """The surface is not convex: it is the top of a box around a pit with vertical walls."""

    def ring(half: int, z: int) -> list[tuple[int, int, int]]:
        return [(-half, -half, z), (half, -half, z), (half, half, z), (-half, half, z)]

    points = [*ring(9, 0), *ring(9, 9), *ring(3, 9), *ring(3, 4)]
    faces = [(3, 2, 1, 0), (12, 13, 14, 15)]
    for k in range(4):
        m = (k + 1) % 4
        faces += [(k, m, 4 + m, 4 + k), (4 + k, 4 + m, 8 + m, 8 + k), (8 + k, 8 + m, 12 + m, 12 + k)]
    pit = Mesh(3, tuple((str(x), str(y), str(z)) for x, y, z in points), tuple(faces))
    with pytest.raises(
        coplanar.CoplanarError, match=r"^1 is too large: a joined face would not be one simple polygon$"
    ):
        coplanar.join(pit, Fraction(1))
    opened = Mesh(3, pit.points, pit.faces[1:])
    with pytest.raises(coplanar.CoplanarError, match=r"^the faces do not form a closed surface$"):
        coplanar.join(opened, Fraction(1))
    with pytest.raises(coplanar.CoplanarError, match=r"^face 1 has no area$"):
        coplanar.join(Mesh(3, pit.points, ((0, 1, 0), *pit.faces)), Fraction(1))


@given(st.fractions(0, 10**6))
def test_a_root_is_rounded_up_to_three_digits(value: Fraction) -> None:
    text = coplanar.root_text(value)
    assert Fraction(text) ** 2 >= value
    assert Fraction(text) ** 2 <= value * Fraction(1022, 1000)


def test_distances_are_read_and_written() -> None:
    assert [coplanar.distance_text(Fraction(value)) for value in (0.001, 1e-9, "1/3", "0.25", 5, "1/1000003")] == [
        *("0.001", "1e-9", "1/3", "0.25", "5", "1/1000003")
    ]
    assert coplanar.distance_text(Fraction(1, 10**20 + 7)) == "1e-20"
    assert coplanar.parse_distance("1e-9") == Fraction(1, 10**9)
    assert coplanar.parse_distance(np.float32(0.5)) == coplanar.parse_distance("1/2") == Fraction(1, 2)


def test_the_public_hull_has_joined_faces() -> None:
    hull = hull1620.exact_hull(dodecahedron())
    found = hull.coplanar(within=1e-9)
    assert repr(found) == "<hull: polyhedron, 20 vertices, 12 faces; 20 points, exact, coplanar within 1e-9>"
    assert found.record.coplanar is not None
    assert Fraction(found.record.coplanar.within) == Fraction(1e-9)
    assert hull.coplanar("1e-9") != hull
    assert found.record.coplanar is not None
    assert found.record.coplanar.faces == len(hull.faces) == 36
    assert len(found.simplices) == 36
    assert abs(float(found.volume - hull.volume)) < 1e-14
    assert found.draw().count("<polygon") == 6
    assert found.certificate is None
    assert hull.certificate is not None
    square = hull1620.exact_hull([(0, 0, 0), (1, 0, 0), (0, 1, 0)])
    assert square.coplanar(1).faces == square.faces
    with pytest.raises(hull1620.ExportError, match="the plane of the largest face"):
        hull.coplanar(9)
