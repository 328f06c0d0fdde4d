"""Drawings of hulls. Visibility is judged by rays through the solid, without the program's faces."""

import itertools
import math
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from modern.drawing import view
from modern.drawing.draw import draw_svg
from modern.geometry.mesh import ExportError
from modern.port import convex_hull
from tests.support.drawn import BOX, CUBE, EXAMPLE_6, SQUARE, Picture, Plane, Whole, draw


def seen_from(picture: Picture) -> Whole:
    """Return the direction that the legend names."""
    x, y, z = map(int, picture.legend()[0].rpartition(" ")[2].split(","))
    return x, y, z


# --- the judge: supporting planes from all triples of points


def supporting(points: Sequence[Whole]) -> set[Plane]:
    """Return every plane through three points that has no point outside, in lowest terms, oriented outward."""
    planes = set()
    for p, q, r in itertools.combinations(points, 3):
        u, v = ([b - a for a, b in zip(p, end, strict=True)] for end in (q, r))
        normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        if not any(normal):
            continue
        divisor = math.gcd(*normal)
        a, b, c = (n // divisor for n in normal)
        d = -(a * p[0] + b * p[1] + c * p[2])
        values = [a * x + b * y + c * z + d for x, y, z in points]
        if max(values) <= 0:
            planes.add((a, b, c, d))
        elif min(values) >= 0:
            planes.add((-a, -b, -c, -d))
    return planes


def at(plane: Plane, point: Sequence[Fraction | int]) -> Fraction:
    return Fraction(plane[0] * point[0] + plane[1] * point[1] + plane[2] * point[2] + plane[3])


def covered(point: Sequence[Fraction | int], eye: Whole, planes: set[Plane]) -> bool:
    """Return True if the ray from a point of the solid to the eye passes through its interior."""
    low, high = Fraction(0), None
    for plane in planes:
        here, slope = at(plane, point), plane[0] * eye[0] + plane[1] * eye[1] + plane[2] * eye[2]
        if slope == 0:
            if here >= 0:
                return False
        elif slope > 0:
            end = -here / slope
            high = end if high is None else min(high, end)
        else:
            low = max(low, -here / slope)
    return high is not None and low < high


def on_planes(points: Sequence[Sequence[int]], planes: set[Plane]) -> int:
    return sum(all(at(plane, point) == 0 for point in points) for plane in planes)


_SMALL = st.integers(-4, 4)
_CLOUDS = st.lists(st.tuples(_SMALL, _SMALL, _SMALL), min_size=5, max_size=12, unique=True)
_EYES = st.tuples(st.integers(-5, 5), st.integers(-5, 5), st.integers(-5, 5)).filter(any)


@given(_CLOUDS, st.none() | _EYES)
def test_an_edge_is_dashed_if_the_ray_to_the_eye_meets_the_solid(points: list[Whole], eye: Whole | None) -> None:
    hull = convex_hull(points)
    assume(hull.dimension == 3)
    picture = Picture(draw_svg(hull, eye))
    direction = eye or seen_from(picture)
    planes = supporting(points)
    corners = [points[index] for index in hull.vertices]
    expected = {}
    for a, b in itertools.combinations(range(len(corners)), 2):
        if on_planes((corners[a], corners[b]), planes) >= 2:
            middle = [Fraction(p + q, 2) for p, q in zip(corners[a], corners[b], strict=True)]
            expected[a, b] = covered(middle, direction, planes)
    drawn = {**dict.fromkeys(picture.edges("seen"), False), **dict.fromkeys(picture.edges("hidden"), True)}
    assert drawn == expected
    assert len(picture.edges("seen")) + len(picture.edges("hidden")) == len(expected)
    hidden = sorted(f"vertex {k + 1}" for k, p in enumerate(corners) if covered(p, direction, planes))
    assert sorted(title.split(":")[0] for title in picture.titles("vertices-hidden")) == hidden
    behind = sorted(f"point {k + 1}" for k in hull.boundary if covered(points[k], direction, planes))
    assert sorted(title.split(": ")[1].split(" (")[0] for title in picture.titles("boundary-hidden")) == behind
    assert len(picture.titles("boundary")) == len(hull.boundary) - len(behind)
    assert len(picture.titles("inside")) == len(hull.inside)
    faces = {plane for plane in planes if sum(n * e for n, e in zip(plane[:3], direction, strict=True)) > 0}
    assert len(picture.groups.get("faces", [])) == len(faces)


@given(_CLOUDS)
def test_chosen_direction_shows_no_face_edge_on_and_no_two_vertices_in_one_place(points: list[Whole]) -> None:
    hull = convex_hull(points)
    assume(hull.dimension == 3)
    eye = seen_from(Picture(draw_svg(hull)))
    assert all(sum(n * e for n, e in zip(plane[:3], eye, strict=True)) for plane in supporting(points))
    for i, j in itertools.combinations(hull.vertices, 2):
        d = [q - p for p, q in zip(points[i], points[j], strict=True)]
        assert any(d[k - 1] * eye[k] != d[k] * eye[k - 1] for k in range(3))


@given(_CLOUDS, _EYES)
def test_image_is_a_parallel_projection_true_to_scale(points: list[Whole], eye: Whole) -> None:
    hull = convex_hull(points)
    assume(hull.dimension == 3)
    places = Picture(draw_svg(hull, eye)).vertices()
    size = math.sqrt(sum(e * e for e in eye))
    ratios = []
    for a, b in itertools.combinations(range(len(hull.vertices)), 2):
        d = [q - p for p, q in zip(points[hull.vertices[a]], points[hull.vertices[b]], strict=True)]
        along = sum(x * e for x, e in zip(d, eye, strict=True)) / size
        flat = math.sqrt(max(0.0, sum(x * x for x in d) - along * along))
        ratios.append((flat, math.dist(places[a], places[b])))
    scale = max(ratios)[1] / max(ratios)[0]
    assert all(abs(drawn - scale * flat) < 0.05 for flat, drawn in ratios)


@pytest.mark.parametrize(
    ("eye", "right", "up"),
    [
        ((0, -1, 0), (1, 0, 0), (0, 0, 1)),
        ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
        ((0, 1, 0), (-1, 0, 0), (0, 0, 1)),
        ((0, 0, 1), (1, 0, 0), (0, 1, 0)),
        ((0, 0, -2), (1, 0, 0), (0, -1, 0)),
    ],
)
def test_axes_of_the_image_point_right_and_up(eye: Whole, right: Whole, up: Whole) -> None:
    hull, picture = draw(CUBE, eye)
    places = {hull.vertices[k]: place for k, place in picture.vertices().items()}
    middle = tuple(sum(place[k] for place in places.values()) / 8 for k in range(2))
    for index, (x, y) in places.items():
        centred = [2 * c - 1 for c in CUBE[index]]
        assert (x > middle[0]) == (sum(a * b for a, b in zip(centred, right, strict=True)) > 0)
        assert (y < middle[1]) == (sum(a * b for a, b in zip(centred, up, strict=True)) > 0)


def test_a_direction_outside_the_list_is_chosen_if_none_in_it_is_suitable(monkeypatch) -> None:
    monkeypatch.setattr(view, "EYES", ())
    # At t = 2 the curve gives (2, -5, 8): the face x + 2 y + z is edge-on there.
    points = [(Fraction(0), Fraction(0), Fraction(0)), (Fraction(1), Fraction(1), Fraction(1))]
    assert view.choose(points, [(Fraction(1), Fraction(2), Fraction(1))]) == (3, -10, 27)
    assert view.choose(points, [(Fraction(1), Fraction(2), Fraction(2))]) == (2, -5, 8)
    beyond = [points[0], (Fraction(-2), Fraction(5), Fraction(-8))]
    assert view.choose(beyond, []) == (3, -10, 27)


# --- the contents of a picture


def test_picture_of_a_cube_has_its_edges_numbers_and_legend() -> None:
    hull, picture = draw(CUBE)
    assert (len(picture.edges("seen")), len(picture.edges("hidden"))) == (9, 3)
    assert len(picture.titles("vertices-hidden")) == 1
    assert len(picture.groups["faces"]) == 3
    assert picture.legend() == [
        "Polyhedron: 8 vertices, 12 edges, 6 faces; seen from 24,-55,29",
        *("edge", "hidden edge", "hidden vertex", "x", "y", "z"),
    ]
    assert set(picture.numbers()) == {str(k) for k in range(1, 9)}
    dot = next(title for title in picture.titles("vertices") if title.startswith("vertex 1:"))
    first = hull.vertices[0]
    assert dot == f"vertex 1: point {first + 1} ({', '.join(map(str, CUBE[first]))})"


def test_boundary_and_inside_points_are_drawn_and_explained() -> None:
    hull, picture = draw(BOX)
    assert (len(hull.boundary), len(hull.inside)) == (4, 1)
    assert {"boundary point", "hidden boundary point", "inside point"} <= set(picture.legend())
    assert len(picture.titles("boundary")) + len(picture.titles("boundary-hidden")) == 4
    assert "inside point" not in draw(CUBE)[1].legend()


def test_edges_within_a_plane_are_drawn_only_on_two_sides_of_a_sheet() -> None:
    hull = convex_hull(CUBE)
    faces = []
    for face in hull.faces:
        a, b, c, d = face.polygon
        faces += [replace(face, polygon=(a, b, c)), replace(face, polygon=(a, c, d))]
    whole, split = (Picture(draw_svg(h, (24, -55, 29))) for h in (hull, replace(hull, faces=tuple(faces))))
    assert whole.edges("seen") == split.edges("seen")
    assert whole.edges("hidden") == split.edges("hidden")
    # Rounded arithmetic can leave such a thin solid.
    hull = convex_hull(CUBE)
    face = hull.faces[0]
    sheet = replace(
        hull, vertices=face.polygon, boundary=(), inside=(), faces=(face, replace(face, polygon=face.polygon[::-1]))
    )
    assert len(Picture(draw_svg(sheet)).edges("seen")) == 4


def test_a_boundary_point_moved_off_its_face_by_rounding_is_drawn_on_that_face() -> None:
    points = [*CUBE, (Fraction(1, 2), 1, Fraction(1, 2))]
    hull = convex_hull(points)
    assert hull.boundary == (8,)
    moved = replace(hull, points=(*hull.points[:8], ("0.5", "1.0001", "0.5")))
    for drawn in (hull, moved):
        assert len(Picture(draw_svg(drawn, (24, -55, 29))).titles("boundary-hidden")) == 1
        assert len(Picture(draw_svg(drawn, (24, 55, 29))).titles("boundary")) == 1


def test_vertices_and_edges_that_coincide_share_a_number() -> None:
    # 300 units take 552 pixels, so the three points at one end lie within two pixels.
    hull, picture = draw([(0, 0, 0), (300, 0, 0), (0, 1, 0), (0, 0, 1)], (1, -9, 2))
    assert len(set(picture.vertices().values())) == 4
    alone = str(hull.vertices.index(1) + 1)
    together = ",".join(str(k) for k, index in enumerate(hull.vertices, 1) if index != 1)
    assert set(picture.numbers()) == {alone, together}
    hull, picture = draw(CUBE, (1, 0, 0))
    place = {index: str(k) for k, index in enumerate(hull.vertices, 1)}
    together = {frozenset((place[k], place[k + 4])) for k in range(4)}
    assert {frozenset(text.split(",")) for text in picture.numbers()} == together
    assert picture.edges("hidden") == {}


def test_a_polygon_is_drawn_perpendicular_to_the_view() -> None:
    hull, picture = draw(SQUARE)
    places = picture.vertices()
    assert len(picture.edges("seen")) == 4
    sides = [math.dist(places[a], places[b]) for a, b in picture.edges("seen")]
    assert max(sides) - min(sides) < 0.05
    assert picture.legend() == ["Polygon: 4 vertices; seen at right angles", "boundary point", "inside point", "x", "y"]
    by_index = {hull.vertices[k]: place for k, place in places.items()}
    assert by_index[0][0] < by_index[1][0]
    assert by_index[0][1] > by_index[3][1]
    assert "seen from 1,1,1" in draw(SQUARE, (2, 2, 2))[1].legend()[0]
    from_below = draw(SQUARE, (1, 1, -1))[1]
    assert from_below.titles("vertices-hidden") == []
    with pytest.raises(ExportError, match="in the plane of the polygon"):
        draw(SQUARE, (1, 1, 0))


def test_triangles_points_and_slivers_are_drawn() -> None:
    hull, picture = draw([(2, -5, 20), (200, -4, -50), (-30, 80, 4)])
    assert set(picture.edges("seen")) == {(0, 1), (0, 2), (1, 2)}
    assert draw_svg(replace(hull, faces=())) == draw_svg(hull)
    _, picture = draw([(1, 2, 3), (1, 2, 3)])
    assert picture.titles("vertices") == ["vertex 1: point 1 (1, 2, 3)"]
    assert list(picture.numbers()) == ["1"]
    assert picture.legend() == ["Point"]
    sliver = [("0", "0", "0"), ("1", "0", "0"), ("0.3", "1", "0"), ("0.4", "0.3", "1E-40")]
    from_above, from_below = draw(sliver, (1, -2, 5))[1], draw(sliver, (1, -2, -5))[1]
    assert (len(from_above.edges("seen")), len(from_above.edges("hidden"))) == (6, 0)
    assert (len(from_below.edges("seen")), len(from_below.edges("hidden"))) == (3, 3)


@pytest.mark.parametrize("end", [(3, 4, 12), (0, 0, 7), (0, -2, 0), (5, 0, 0)])
def test_a_segment_is_drawn_at_its_full_length(end: Whole) -> None:
    hull, picture = draw([(0, 0, 0), end, tuple(Fraction(c, 2) for c in end)])
    ((a, b),) = picture.edges("seen").values()
    assert hull.inside == (2,)
    assert len(picture.titles("inside")) == 1
    level, tall = b[0] - a[0], a[1] - b[1]
    length, upright = math.hypot(*end), end[2] * (1 if hull.vertices[0] == 0 else -1)
    assert tall / math.hypot(level, tall) == pytest.approx(upright / length, abs=1e-4)
    if end == (5, 0, 0):
        assert (level > 0) == (hull.vertices[0] == 0), "seen from the front, x is to the right"
    with pytest.raises(ExportError, match="along the segment"):
        draw([(0, 0, 0), end], [-2 * c for c in end])


@pytest.mark.parametrize("unit", ["E90", "E-90", "E900", "E-2000"])
def test_scaling_and_translation_do_not_change_the_picture(unit: str) -> None:
    picture = draw(EXAMPLE_6)[1]
    scaled = draw([[f"{c}{unit}" for c in p] for p in EXAMPLE_6])[1]
    for key in ("seen", "hidden"):
        assert scaled.edges(key) == picture.edges(key)
    if unit == "E90":
        assert draw([[str(c + 10**40) for c in p] for p in EXAMPLE_6])[1].edges("seen") == picture.edges("seen")


def test_invalid_directions_widths_and_hulls_are_refused() -> None:
    hull = convex_hull(CUBE)
    with pytest.raises(ExportError, match=r"^expected a direction of view other than 0,0,0$"):
        draw_svg(hull, (0, 0, 0))
    with pytest.raises(ExportError, match=r"^there is no hull: DATA NOT ACCEPTABLE$"):
        draw_svg(replace(hull, status="DATA NOT ACCEPTABLE"))
    for width in (319, 4001):
        with pytest.raises(
            ExportError, match=f"a picture cannot be {width} pixels wide; the width is from 320 to 4000"
        ):
            draw_svg(hull, width=width)
