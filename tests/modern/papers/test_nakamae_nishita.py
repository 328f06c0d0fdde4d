"""Tests of formulas (1) to (6) of Nakamae and Nishita, each against an independent computation."""

import itertools
import random
from collections import Counter
from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from modern.drawing.visible import BACK, CONTOUR, FLAT, INNER, line_through, sign, value
from modern.papers.nakamae_nishita.contours import boxes, overlapping, values
from modern.papers.nakamae_nishita.hidden import draw
from modern.papers.nakamae_nishita.nearness import BY_CROSSING, BY_FACE, BY_PLANE, by_plane
from modern.papers.nakamae_nishita.polyhedron import Polyhedron, SceneError
from modern.papers.nakamae_nishita.projection import parallel, perspective
from modern.papers.nakamae_nishita.shapes import cuboid, moved, placed, plate
from modern.papers.nakamae_nishita.solids import height, solid
from tests.support.scenes_at_random import apart, blocks, direction, hull_of, vector
from tests.support.visibility import Judge, wrong

ORIGIN = vector(0, 0, 0)
_WHOLE = st.integers(-20, 20)
_IMAGE = st.tuples(_WHOLE, _WHOLE, st.integers(1, 9))


def box(low: tuple[int, ...], high: tuple[int, ...], thing: str = "") -> Polyhedron:
    name = f"box at {low}"
    size = vector(*(b - a for a, b in zip(low, high, strict=True)))
    return replace(placed(cuboid(name, *size), moved(vector(*low)), name), thing=thing)


def determinant(rows: list[tuple[int | Fraction, ...]]) -> int | Fraction:
    """Compute a determinant by the Leibniz formula, which the program does not use."""
    total: int | Fraction = 0
    for order in itertools.permutations(range(len(rows))):
        product: int | Fraction = (-1) ** sum(a > b for a, b in itertools.combinations(order, 2))
        for row, column_ in zip(rows, order, strict=True):
            product *= row[column_]
        total += product
    return total


# --- the formulas


@given(_IMAGE, _IMAGE, _IMAGE)
def test_formula_1_is_positive_to_the_right_of_the_line(p, a, b) -> None:
    ones = [(Fraction(x, w), Fraction(y, w), Fraction(1)) for x, y, w in (p, a, b)]
    assert sign(value(line_through(a, b), p)) == sign(-determinant(ones))
    # With the y axis upward, (1, 0) is to the right of the line from (0, 0) to (0, 1).
    assert value(line_through((0, 0, 1), (0, 1, 1)), (1, 0, 1)) > 0


@settings(max_examples=20)
@given(st.integers(0, 200))
def test_formula_5_is_its_determinant_and_positive_outside(seed: int) -> None:
    source = random.Random(seed)
    for polyhedron in apart(seed, 3):
        for observer in (parallel(direction(source)), perspective(vector(50, 40, -60), ORIGIN)):
            projected = solid(0, polyhedron, observer, ORIGIN)
            for face, plane, front in zip(polyhedron.faces, projected.planes, projected.signs, strict=True):
                corners = [projected.points[place] for place in face]
                for point in projected.vertices:
                    # The program may choose three other corners of the face, so only the signs agree.
                    dr = -determinant([point, *corners[:3]])
                    assert sign(height(plane, point)) == sign(dr)
                    assert dr <= 0
                # The eye is at infinity on the z axis.
                assert sign(height(plane, (0, 0, 1, 0))) == front


@given(st.lists(_IMAGE, min_size=4, max_size=4))
def test_formula_6_is_the_change_of_formula_1(points: list[tuple[int, int, int]]) -> None:
    (xi, yi), (xj, yj), (xa, ya), (xb, yb) = ((x, y) for x, y, _ in points)
    line = line_through((xi, yi, 1), (xj, yj, 1))
    index = determinant([(xj - xi, yj - yi), (xa - xb, ya - yb)])
    assert index == value(line, (xb, yb, 1)) - value(line, (xa, ya, 1))


def test_formula_4_agrees_with_distances_in_space() -> None:
    """Compute dr = (P1 - P0).(P1 - P2) of two points on one ray in space from the vertices."""
    eye, checked = vector(40, -50, 30), 0
    for seed in range(12):
        polyhedra = apart(seed)
        drawing = draw(polyhedra, perspective(eye, vector(9, 9, 9)))
        for relation in drawing.relations:
            for i, j in relation.tables.crossings():
                ends = []
                v, w = drawing.solids[relation.v], drawing.solids[relation.w]
                for crossed, k, crossing, m in ((v, i, w, j), (w, j, v, i)):
                    a, b = crossed.contour[k], crossed.contour[(k + 1) % len(crossed.contour)]
                    images = (crossed.points[place] for place in (a, b))
                    at_a, at_b = (value(crossing.lines[m], (x, y, weight)) for x, y, _, weight in images)
                    s = Fraction(at_a, at_a - at_b)
                    p, q = crossed.polyhedron.vertices[a], crossed.polyhedron.vertices[b]
                    ends.append([x + s * (y - x) for x, y in zip(p, q, strict=True)])
                p1, p2 = ends
                rays = [[x - e for x, e in zip(p, eye, strict=True)] for p in ends]
                assert all(rays[0][k - 1] * rays[1][k] == rays[0][k] * rays[1][k - 1] for k in range(3))
                dr = sum((x - e) * (x - y) for x, y, e in zip(p1, p2, eye, strict=True))
                assert sign(dr) == -relation.nearer
                checked += 1
    assert checked > 20


# --- faces and edges


def test_edges_of_cuboids_and_divided_faces_are_classified() -> None:
    cuboid_ = solid(0, box((0, 0, 0), (1, 2, 3)), parallel((3, -2, 1)), ORIGIN)
    assert Counter(edge.kind for edge in cuboid_.edges) == {INNER: 3, CONTOUR: 6, BACK: 3}
    assert len(cuboid_.contour) == 6
    assert len(cuboid_.segments) == 9
    square = box((0, 0, 0), (1, 1, 1))
    halves = [*square.faces[1:], square.faces[0][:3], (*square.faces[0][2:], square.faces[0][0])]
    for eye in ((1, 2, -3), (1, 2, 3)):
        divided = solid(0, Polyhedron("cube", square.vertices, tuple(halves)), parallel(eye), ORIGIN)
        assert Counter(edge.kind for edge in divided.edges) == {INNER: 3, CONTOUR: 6, BACK: 3, FLAT: 1}


@settings(max_examples=40)
@given(st.integers(0, 300), st.booleans())
def test_the_contour_is_the_hull_of_the_images_clockwise(seed: int, in_perspective: bool) -> None:
    source = random.Random(seed)
    observer = perspective(vector(60, 50, 70), ORIGIN) if in_perspective else parallel(direction(source))
    for number, polyhedron in enumerate(apart(seed, 4)):
        projected = solid(number, polyhedron, observer, ORIGIN)
        contour = projected.contour
        if not contour:
            assert not any(projected.signs)
            continue
        # No vertex is on the left of a contour line.
        sides = values(projected.lines, projected.vertices)
        assert sides is not None
        assert all(min(column_) == 0 for column_ in sides)
        # The contour visits every one of its vertices once and consists of the contour edges.
        assert len(set(contour)) == len(contour)
        segments = {frozenset(pair) for pair in zip(contour, contour[1:] + contour[:1], strict=True)}
        assert segments == {frozenset((edge.start, edge.end)) for edge in projected.edges if edge.kind == CONTOUR}


# --- tables


@settings(max_examples=16)
@given(st.integers(0, 500))
def test_d_tells_how_two_contour_segments_meet(seed: int) -> None:
    source = random.Random(seed)
    polyhedra = blocks(seed) if seed % 2 else apart(seed)
    assume(polyhedra)
    drawing = draw(polyhedra, parallel(direction(source)))
    for relation in drawing.relations:
        v, w = drawing.solids[relation.v], drawing.solids[relation.w]
        crossing = set(relation.tables.crossings())
        # Property 1: if contours overlap, every column of PL and every row of LP has a 1.
        assert all(1 in side for side in (*zip(*relation.tables.pl, strict=True), *relation.tables.lp))
        for i, j in itertools.product(range(len(v.contour)), range(len(w.contour))):
            d = relation.tables.crossing_number(i, j)
            a, b = _flat(v.images[i]), _flat(v.images[(i + 1) % len(v.contour)])
            c, e = _flat(w.images[j]), _flat(w.images[(j + 1) % len(w.contour)])
            assert (d == -4) == _properly_cross(a, b, c, e) == ((i, j) in crossing)
            in_line = _turn(a, b, c) == _turn(a, b, e) == 0
            touching = any(_is_on(p, q, x) for p, q, ends in ((a, b, (c, e)), (c, e, (a, b))) for x in ends)
            assert (d == -1) == (not in_line and bool({a, b} & {c, e}))
            assert (d == -2) == (not in_line and touching and not {a, b} & {c, e})
            assert d in (0, -1, -2, -4)


def _flat(image) -> tuple[Fraction, Fraction]:
    return Fraction(image[0], image[3]), Fraction(image[1], image[3])


def _turn(p, q, x) -> Fraction:
    return (q[0] - p[0]) * (x[1] - p[1]) - (q[1] - p[1]) * (x[0] - p[0])


def _is_on(p, q, x) -> bool:
    along = (x[0] - p[0]) * (x[0] - q[0]) + (x[1] - p[1]) * (x[1] - q[1])
    return _turn(p, q, x) == 0 and along <= 0


def _properly_cross(a, b, c, d) -> bool:
    """Decide by solving for the point of intersection."""
    r, s = (b[0] - a[0], b[1] - a[1]), (d[0] - c[0], d[1] - c[1])
    denominator = r[0] * s[1] - r[1] * s[0]
    if not denominator:
        return False
    t = ((c[0] - a[0]) * s[1] - (c[1] - a[1]) * s[0]) / denominator
    u = ((c[0] - a[0]) * r[1] - (c[1] - a[1]) * r[0]) / denominator
    return 0 < t < 1 and 0 < u < 1


@settings(max_examples=20)
@given(st.integers(0, 500))
def test_bounding_boxes_miss_no_pair_of_overlapping_contours(seed: int) -> None:
    polyhedra = apart(seed)
    drawing = draw(polyhedra, parallel(direction(random.Random(seed))), check=False)
    related = {(relation.v, relation.w) for relation in drawing.relations}
    for v, w in itertools.combinations(drawing.solids, 2):
        if v.contour and w.contour:
            overlap = values(v.lines, w.images) is not None and values(w.lines, v.images) is not None
            assert overlap == ((v.number, w.number) in related)


@given(st.lists(st.tuples(_WHOLE, st.integers(0, 30), _WHOLE, st.integers(0, 30)), max_size=30), st.integers(-70, 70))
def test_overlapping_boxes_are_found_at_every_scale(rectangles: list[tuple[int, int, int, int]], power: int) -> None:
    scale = Fraction(2) ** power
    corners = [
        [
            ((x * scale.numerator), (y * scale.numerator), 0, scale.denominator)
            for x, y in ((left, low), (left + wide, low + tall))
        ]
        for left, wide, low, tall in rectangles
    ]
    pairs = [
        (a, b)
        for (a, p), (b, q) in itertools.combinations(enumerate(rectangles), 2)
        if p[0] <= q[0] + q[1] and q[0] <= p[0] + p[1] and p[2] <= q[2] + q[3] and q[2] <= p[2] + p[3]
    ]
    assert list(overlapping(boxes(corners))) == pairs


# --- near and far


def test_each_criterion_of_nearness_decides_a_case() -> None:
    def by(*polyhedra: Polyhedron) -> tuple[int, str]:
        (relation,) = draw(polyhedra, parallel((2, -3, 1))).relations
        return relation.nearer, relation.by

    assert by(box((0, 0, 0), (2, 2, 2)), box((1, 3, 0), (3, 5, 2))) == (1, BY_CROSSING)
    assert by(box((0, 0, 0), (8, 1, 8)), box((3, 2, 3), (4, 3, 4))) == (1, BY_FACE)
    assert by(box((0, 0, 0), (1, 1, 1)), box((0, 0, 1), (1, 1, 2))) == (-1, BY_PLANE)


def test_crossed_touching_edges_need_a_plane_through_an_edge_and_a_vertex() -> None:
    """No face plane separates two wedges that touch in the middle of an edge of each."""
    lower = hull_of([vector(-2, 0, 0), vector(2, 0, 0), vector(0, -1, -2), vector(0, 1, -2)], "lower")
    upper = hull_of([vector(0, -2, 0), vector(0, 2, 0), vector(-1, 0, 2), vector(1, 0, 2)], "upper")
    assert lower is not None
    assert upper is not None
    for eye, nearer in (((0, 0, 1), -1), ((0, 0, -1), 1), ((1, 1, 9), -1)):
        v, w = (solid(k, p, parallel(eye), ORIGIN) for k, p in enumerate((lower, upper)))
        assert not any(
            all(height(plane, point) >= 0 for point in opposite.vertices)
            for owner, opposite in ((v, w), (w, v))
            for plane in owner.planes
        )
        assert by_plane(v, w)[0] == nearer
        drawing = draw([lower, upper], parallel(eye))
        assert wrong(drawing, Judge([lower, upper], direction=eye))[0] == []


def test_intersecting_polyhedra_are_rejected() -> None:
    with pytest.raises(SceneError, match=r"^box at \(0, 0, 0\) and box at \(1, 1, 1\) intersect;"):
        draw([box((0, 0, 0), (2, 2, 2)), box((1, 1, 1), (3, 3, 3))], parallel((2, -3, 1)))
    with pytest.raises(SceneError, match="intersect"):
        draw([box((0, 0, 0), (9, 9, 9)), box((1, 1, 1), (3, 3, 3))], parallel((2, -3, 1)))
    assert draw([box((0, 0, 0), (2, 2, 2)), box((1, 1, 1), (3, 3, 3))], parallel((2, -3, 1)), check=False).pieces


def test_plates_in_one_plane_hide_nothing_and_edge_on_are_not_drawn() -> None:
    plates = [
        plate("a", [vector(*p, 0) for p in square]) for square in (((0, 0), (2, 0), (2, 2)), ((1, 0), (3, 0), (3, 2)))
    ]
    drawing = draw(plates, parallel((1, -1, 3)))
    assert all(piece.visible and (piece.first, piece.last) == (0, 1) for piece in drawing.pieces)
    assert len(drawing.pieces) == 6
    assert draw([plate("a", [vector(0, 0, 0), vector(1, 0, 0), vector(1, 1, 0)])], parallel((1, 2, 0))).pieces == ()
