"""The certificate trips on every corruption of a true hull, and on a construction that errs."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest

from modern.exact_hull import CertificateError, Facet, certify, exact_hull
from modern.exact_hull import build as build_module
from modern.exact_hull import certificate as checks
from modern.exact_hull import surface as surface_module
from tests.support.corrupted import (
    BIG,
    GRID,
    OCTAHEDRON,
    PRISM,
    ball,
    exchanged,
    facet_with,
    mutations,
    one_vertex_short,
    promoted,
    refused,
)

SKEW_SQUARE = [(Fraction(x + 2 * y, 2), 3 * x - y, y - 2 * x) for x in range(3) for y in range(3)] * 2
LINE = [(2 * k, 5 - k, 3 * k) for k in (4, 0, 1, 5, 3, 4)]
POINT = [("1.5", 2, 3)] * 3
SETS = {
    "grid": GRID,
    "octahedron": OCTAHEDRON,
    "prism": PRISM,
    "square": SKEW_SQUARE,
    "line": LINE,
    "point": POINT,
    "big": BIG,
}


@pytest.mark.parametrize("name", SETS)
def test_no_single_change_to_a_hull_passes(name: str) -> None:
    """A hull has one true form, so every change to any number or tuple of the result must be refused."""
    points = SETS[name]
    hull = exact_hull(points)
    assert certify(points, hull) == hull.certificate
    tried = 0
    for field in (
        "dimension", "scale", "scaled", "vertices", "boundary", "inside", "duplicates", "plane", "facets", "polygon",
    ):  # fmt: skip
        for changed in mutations(getattr(hull, field)):
            corrupt = replace(hull, **{field: changed})
            if corrupt == hull:
                continue
            tried += 1
            with pytest.raises(CertificateError):
                certify(points, corrupt)
    assert tried > (30 if name == "point" else 100)


def test_the_points_are_looked_at() -> None:
    hull = exact_hull(GRID)
    for index, point in enumerate(GRID):
        for moved in ((point[0] + 1, *point[1:]), (Fraction(1, 2) + point[0], *point[1:])):
            with pytest.raises(CertificateError):
                certify([*GRID[:index], moved, *GRID[index + 1 :]], hull)
    with pytest.raises(CertificateError, match="scaled points for"):
        certify(GRID[:-1], hull)


TOP = (0, 0, 1, -2)


def test_a_face_left_out_of_the_octahedron() -> None:
    refused(OCTAHEDRON, exchanged(exact_hull(OCTAHEDRON), 3), "has only one facet")


def test_a_face_left_out_of_the_cube() -> None:
    """Two planes do not hold a corner; and the points within the face would touch none."""
    hull = exact_hull(GRID)
    refused(GRID, exchanged(hull, facet_with(hull, TOP)), "which contradicts its class")
    cube = [point for point in GRID[:27] if 1 not in point]
    refused(cube, exchanged(exact_hull(cube), 0), "its planes do not determine it")


def test_no_facets() -> None:
    refused(GRID, replace(exact_hull(GRID), facets=()), "there are no facets")


def test_a_face_seen_from_inside() -> None:
    hull = exact_hull(GRID)
    number = facet_with(hull, TOP)
    a, *rest = hull.facets[number].polygon
    refused(GRID, exchanged(hull, number, Facet(TOP, (a, *rest[::-1]))), "no left turn")


def test_a_plane_with_the_opposite_sense() -> None:
    hull = exact_hull(GRID)
    number = facet_with(hull, TOP)
    refused(GRID, exchanged(hull, number, Facet((0, 0, -1, 2), hull.facets[number].polygon)), "is outside of facet")


@pytest.mark.parametrize(
    ("plane", "message"),
    [
        ((0, 0, 2, -4), "lowest terms"),
        ((0, 0, 0, 0), "normal is 0"),
        ((0, 0, 0, 1), "normal is 0"),
        ((0, 0, 1, -3), "is not in its plane"),
        ((0, 0, 1), "not four integers"),
        (tuple(np.array(TOP)), "not four integers"),
    ],
)
def test_a_wrong_plane(plane: tuple[int, ...], message: str) -> None:
    hull = exact_hull(GRID)
    number = facet_with(hull, TOP)
    refused(GRID, exchanged(hull, number, Facet(plane, hull.facets[number].polygon)), message)


def test_a_plane_through_an_edge_that_cuts_the_cube() -> None:
    hull = exact_hull(GRID)
    edge = tuple(i for i in hull.vertices if GRID[i][0] == 0 and GRID[i][1] == 0)
    refused(GRID, exchanged(hull, 0, Facet((1, -1, 0, 0), edge)), "is outside of facet")


def test_a_plane_too_many_that_touches_an_edge() -> None:
    hull = exact_hull(GRID)
    edge = tuple(i for i in hull.vertices if GRID[i][0] == 0 and GRID[i][1] == 0)
    extra = Facet((-1, -1, 0, 0), edge)
    facets = tuple(sorted((*hull.facets, extra), key=lambda facet: facet.plane))
    refused(GRID, replace(hull, facets=facets), "fewer than three vertices")


def test_a_face_left_in_two_triangles() -> None:
    hull = exact_hull(GRID)
    number = facet_with(hull, TOP)
    a, b, c, d = hull.facets[number].polygon
    refused(GRID, exchanged(hull, number, Facet(TOP, (a, b, c)), Facet(TOP, (a, c, d))), "a plane occurs twice")
    refused(GRID, exchanged(hull, number, Facet(TOP, (a, b, c))), "its plane contains other vertices than its polygon")


def test_a_point_of_a_face_called_a_vertex() -> None:
    hull = exact_hull(GRID)
    refused(GRID, promoted(hull, GRID.index((1, 1, 2))), "its plane contains other vertices than its polygon")


def test_a_point_of_an_edge_made_a_vertex_of_both_faces() -> None:
    """Consistent with the surface and with Euler; refused because two planes its planes do not determine it."""
    middle = GRID.index((1, 0, 0))
    hull = promoted(exact_hull(GRID), middle)
    ends = {GRID.index((0, 0, 0)), GRID.index((2, 0, 0))}
    facets = []
    for facet in hull.facets:
        polygon = list(facet.polygon)
        for k, (a, b) in enumerate(zip(facet.polygon, facet.polygon[1:] + facet.polygon[:1], strict=True)):
            if {a, b} == ends:
                polygon.insert(k + 1, middle)
        facets.append(Facet(facet.plane, tuple(polygon)))
    refused(GRID, replace(hull, facets=tuple(facets)), f"point {middle} is called a vertex")


def test_a_point_inside_called_a_vertex() -> None:
    refused(GRID, promoted(exact_hull(GRID), 13), "point 13 is called a vertex")


def test_the_hull_of_all_points_but_one_vertex() -> None:
    """Faultless in itself, but a point is outside."""
    for points, hull in one_vertex_short():
        refused(points, hull, "point 4 is outside of facet")


@pytest.mark.parametrize(("index", "taken_from", "given_to"), [(13, "inside", "boundary"), (4, "boundary", "inside")])
def test_boundary_and_inside_confused(index: int, taken_from: str, given_to: str) -> None:
    hull = exact_hull(GRID)
    corrupt = replace(
        hull,
        **{
            taken_from: tuple(k for k in getattr(hull, taken_from) if k != index),
            given_to: tuple(sorted((*getattr(hull, given_to), index))),
        },
    )
    refused(GRID, corrupt, f"point {index} is .* a facet, which contradicts its class")


def test_a_vertex_called_boundary() -> None:
    hull = exact_hull(GRID)
    corrupt = replace(hull, vertices=hull.vertices[1:], boundary=(hull.vertices[0], *hull.boundary))
    refused(GRID, corrupt, "a point of the polygon is not a vertex")


def test_a_duplicate_called_a_vertex() -> None:
    hull = exact_hull(GRID)
    corrupt = replace(hull, vertices=(*hull.vertices, 28), duplicates=hull.duplicates[:1])
    refused(GRID, corrupt, "point 28 is stated to equal point 28, but first occurs as point 0")


def test_the_second_of_two_equal_points_named_first() -> None:
    hull = exact_hull(OCTAHEDRON + OCTAHEDRON[5:])
    corrupt = replace(hull, vertices=(0, 1, 2, 3, 4, 6), duplicates=((5, 6),))
    refused(OCTAHEDRON + OCTAHEDRON[5:], corrupt, "point 5 is stated to equal point 6")


def test_a_scale_that_is_not_the_least() -> None:
    hull = exact_hull(OCTAHEDRON)
    corrupt = replace(hull, scale=2, scaled=tuple(tuple(2 * n for n in p) for p in hull.scaled))
    refused(OCTAHEDRON, corrupt, "the scale is not the least")


def test_scaled_coordinates_in_numpy_integers() -> None:
    hull = exact_hull(OCTAHEDRON)
    corrupt = replace(hull, scaled=tuple(map(tuple, np.array(hull.scaled))))
    refused(OCTAHEDRON, corrupt, "point 0: its scaled coordinates")


def test_a_pentagram() -> None:
    """Left turns everywhere, but the polygon goes around twice."""
    hull = exact_hull(PRISM)
    number = facet_with(hull, (0, 0, 1, -3))
    a, b, c, d, e = hull.facets[number].polygon
    refused(PRISM, exchanged(hull, number, Facet((0, 0, 1, -3), (a, c, e, b, d))), "goes around 2 times")


def test_two_closed_surfaces_fail_eulers_relation() -> None:
    """No hull can get as far as this check with a fault, so it is called by itself."""
    hull = exact_hull(OCTAHEDRON)
    assert checks._check_polyhedron(hull) == 12
    shift = len(hull.scaled)
    other = [Facet(facet.plane, tuple(index + shift for index in facet.polygon)) for facet in hull.facets]
    both = SimpleNamespace(vertices=range(2 * shift), scaled=hull.scaled * 2, facets=(*hull.facets, *other))
    with pytest.raises(CertificateError, match="Euler's relation does not hold: 12 vertices, 24 edges, 16 facets"):
        checks._check_polyhedron(both)


def test_a_facet_twice_closes_nothing() -> None:
    hull = exact_hull(OCTAHEDRON)
    with pytest.raises(CertificateError, match="twice in the same direction"):
        checks._check_polyhedron(replace(hull, facets=(*hull.facets, hull.facets[0])))


def test_a_polygon_in_the_wrong_order() -> None:
    hull = exact_hull(SKEW_SQUARE)
    a, b, c, d = hull.polygon
    refused(SKEW_SQUARE, replace(hull, polygon=(a, c, b, d)), "no left turn")
    refused(SKEW_SQUARE, replace(hull, polygon=(a, d, c, b)), "no left turn")


def test_an_edge_left_out_of_a_polygon() -> None:
    hull = exact_hull([(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)])
    refused(hull.scaled, exchanged(hull, 0), "its planes do not determine it")


def test_an_edge_with_a_slanted_plane() -> None:
    square = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)]
    hull = exact_hull(square)
    number = facet_with(hull, (0, -1, 0, 0))
    refused(square, exchanged(hull, number, Facet((0, -1, 1, 0), hull.facets[number].polygon)), "at right angles")


def test_a_polygon_whose_plane_has_the_other_sense() -> None:
    hull = exact_hull(SKEW_SQUARE)
    refused(SKEW_SQUARE, replace(hull, plane=tuple(-number for number in hull.plane)), "plane is not positive")


def test_a_polygon_with_a_point_beside_its_plane() -> None:
    """Within every edge's plane, but not in the polygon's: the rank says so first."""
    square = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)]
    hull = exact_hull([*square, (1, 1, 0)])
    refused([*square, (1, 1, 1)], replace(hull, scaled=(*hull.scaled[:4], (1, 1, 1))), "but the points have rank 3")
    with pytest.raises(CertificateError, match="point 4 is not in the polygon's plane"):
        checks._check_polygon(replace(hull, scaled=(*hull.scaled[:4], (1, 1, 1))))


def test_a_segment_with_a_slanted_end() -> None:
    points = [(0, 0, 0), (4, 0, 0)]
    hull = exact_hull(points)
    refused(points, replace(hull, facets=(Facet((-1, 0, 0, 0), (0,)), Facet((1, 1, 0, -4), (1,)))), "at right angles")


def test_a_segment_with_one_end() -> None:
    points = [(0, 0, 0), (4, 0, 0)]
    hull = exact_hull(points)
    one = replace(hull, facets=hull.facets[:1], vertices=(0,), inside=(1,))
    refused(points, one, "the segment has 1 ends")


def test_a_point_with_a_facet_or_without_a_vertex() -> None:
    hull = exact_hull(POINT)
    refused(POINT, replace(hull, facets=(Facet((0, 0, 1, -6), (0,)),)), "a point has one vertex and no facets")
    refused(POINT, replace(hull, vertices=(), inside=(0,)), "a point has one vertex and no facets")


def test_a_polygon_stated_or_missing_against_the_dimension() -> None:
    hull = exact_hull(OCTAHEDRON)
    refused(OCTAHEDRON, replace(hull, polygon=hull.facets[0].polygon), "a polygon is stated if and only if")
    refused(SKEW_SQUARE, replace(exact_hull(SKEW_SQUARE), polygon=()), "a polygon is stated if and only if")


def test_cycles_that_do_not_start_with_the_smallest() -> None:
    hull = exact_hull(OCTAHEDRON)
    a, b, c = hull.facets[0].polygon
    refused(OCTAHEDRON, exchanged(hull, 0, Facet(hull.facets[0].plane, (b, c, a))), "the smallest vertex is not first")
    refused(OCTAHEDRON, exchanged(hull, 0, Facet(hull.facets[0].plane, ())), "the smallest vertex is not first")
    hull = exact_hull(SKEW_SQUARE)
    refused(SKEW_SQUARE, replace(hull, polygon=(*hull.polygon[1:], hull.polygon[0])), "not an order of the vertices")


def test_a_polygon_whose_plane_is_not_in_lowest_terms() -> None:
    hull = exact_hull(SKEW_SQUARE)
    corrupt = replace(hull, plane=tuple(2 * number for number in hull.plane))
    refused(SKEW_SQUARE, corrupt, "the polygon's plane is not in lowest terms")


def test_a_line_through_one_corner_is_no_edge() -> None:
    square = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)]
    hull = exact_hull(square)
    extra = tuple(sorted((*hull.facets, Facet((-1, -1, 0, 0), (0,))), key=lambda facet: facet.plane))
    refused(square, replace(hull, facets=extra), "the facets are not the polygon's edges")


def test_a_polygon_run_through_twice() -> None:
    hull = exact_hull(OCTAHEDRON)
    doubled = Facet(hull.facets[0].plane, hull.facets[0].polygon * 2)
    refused(OCTAHEDRON, exchanged(hull, 0, doubled), "a vertex occurs twice")


def test_dimension_by_rank() -> None:
    assert checks.rank([]) == 0
    assert checks.rank([(0, 0, 0)]) == 0
    assert checks.rank([(2, 4, 6), (-3, -6, -9)]) == 1
    assert checks.rank([(0, 4, 6), (0, -6, -9), (0, 1, 1), (0, 7, -2)]) == 2
    assert checks.rank([(1, 10**30, 1), (1, 10**30 + 1, 1), (1, 10**30, 2)]) == 3


def test_a_construction_that_forgets_points_is_caught(monkeypatch: pytest.MonkeyPatch) -> None:
    points = ball(60, 1)
    assert exact_hull(points).dimension == 3
    order = build_module.insertion_order
    monkeypatch.setattr(build_module, "insertion_order", lambda count, simplex: order(count, simplex)[:10])
    with pytest.raises(CertificateError, match="is outside of facet"):
        exact_hull(points)


def test_a_construction_in_rounded_numbers_is_caught(monkeypatch: pytest.MonkeyPatch) -> None:
    """The surface built from coordinates cut to a multiple of 1024: near enough for its shape, not for its planes."""
    points = ball(60, 2)
    frame = build_module.frame
    monkeypatch.setattr(
        build_module, "frame", lambda given: frame([tuple(number // 1024 * 1024 for number in p) for p in given])
    )
    with pytest.raises(CertificateError, match="is not in its plane"):
        exact_hull(points)


def test_a_construction_that_sees_too_little_is_caught(monkeypatch: pytest.MonkeyPatch) -> None:
    """A point that keeps no triangle although it sees one is left outside."""
    points = ball(60, 3)
    distribute = surface_module.Surface._distribute

    def forgetful(surface, waiting, triangles) -> None:
        for p in waiting[:1]:
            surface.home[p] = -1
        distribute(surface, waiting[1:], triangles)

    monkeypatch.setattr(surface_module.Surface, "_distribute", forgetful)
    with pytest.raises(CertificateError, match="is outside of facet"):
        exact_hull(points)


@pytest.mark.parametrize("times", [0, 2])
def test_a_horizon_that_is_no_simple_cycle_is_caught(monkeypatch: pytest.MonkeyPatch, times: int) -> None:
    """Its first edge left out, or named twice."""
    seen = surface_module.Surface._visible

    def broken(surface, p):
        triangles, horizon = seen(surface, p)
        return triangles, horizon[:1] * times + horizon[1:]

    monkeypatch.setattr(surface_module.Surface, "_visible", broken)
    with pytest.raises(RuntimeError, match="the horizon is not a simple cycle"):
        exact_hull([(0, 0, 0), (9, 0, 0), (0, 9, 0), (0, 0, 9), (5, 5, 5)])


def test_a_construction_that_calls_boundary_inside_is_caught(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(build_module, "_on_facets", lambda points, facets: [])
    with pytest.raises(CertificateError, match="which contradicts its class"):
        exact_hull(GRID)
