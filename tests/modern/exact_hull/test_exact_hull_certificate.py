"""The certificate refuses every corruption of a true hull, and the results of a faulty construction."""

from dataclasses import replace
from fractions import Fraction
from types import SimpleNamespace

import numpy as np
import pytest

from modern.exact_hull import CertificateError, Facet, certify, exact_hull
from modern.exact_hull import build as build_module
from modern.exact_hull import certificate as checks
from modern.exact_hull import surface as surface_module
from modern.exact_hull.coordinates import read_points
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
def test_every_single_change_of_a_hull_is_refused(name: str) -> None:
    """A hull has only one valid form, so the certificate must refuse a change of any number or tuple."""
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


def test_a_hull_of_other_points_is_refused() -> None:
    hull = exact_hull(GRID)
    for index, point in enumerate(GRID):
        for moved in ((point[0] + 1, *point[1:]), (Fraction(1, 2) + point[0], *point[1:])):
            with pytest.raises(CertificateError):
                certify([*GRID[:index], moved, *GRID[index + 1 :]], hull)
    with pytest.raises(CertificateError, match="scaled points, found"):
        certify(GRID[:-1], hull)


TOP = (0, 0, 1, -2)


def test_a_cube_without_a_face_is_refused() -> None:
    """Two planes do not determine a corner, and the points inside the face would lie in no plane."""
    hull = exact_hull(GRID)
    refused(GRID, exchanged(hull, facet_with(hull, TOP)), "which contradicts its class")
    cube = [point for point in GRID[:27] if 1 not in point]
    refused(cube, exchanged(exact_hull(cube), 0), "its planes do not determine it")


def test_a_hull_without_facets_is_refused() -> None:
    refused(GRID, replace(exact_hull(GRID), facets=()), "there are no facets")


def test_a_face_in_the_order_seen_from_inside_is_refused() -> None:
    hull = exact_hull(GRID)
    number = facet_with(hull, TOP)
    a, *rest = hull.facets[number].polygon
    refused(GRID, exchanged(hull, number, Facet(TOP, (a, *rest[::-1]))), "does not turn left")


def test_a_plane_that_points_inward_is_refused() -> None:
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
def test_an_invalid_plane_is_refused(plane: tuple[int, ...], message: str) -> None:
    hull = exact_hull(GRID)
    number = facet_with(hull, TOP)
    refused(GRID, exchanged(hull, number, Facet(plane, hull.facets[number].polygon)), message)


def test_a_plane_through_an_edge_that_intersects_the_cube_is_refused() -> None:
    hull = exact_hull(GRID)
    edge = tuple(i for i in hull.vertices if GRID[i][0] == 0 and GRID[i][1] == 0)
    refused(GRID, exchanged(hull, 0, Facet((1, -1, 0, 0), edge)), "is outside of facet")


def test_an_extra_plane_that_touches_an_edge_is_refused() -> None:
    hull = exact_hull(GRID)
    edge = tuple(i for i in hull.vertices if GRID[i][0] == 0 and GRID[i][1] == 0)
    extra = Facet((-1, -1, 0, 0), edge)
    facets = tuple(sorted((*hull.facets, extra), key=lambda facet: facet.plane))
    refused(GRID, replace(hull, facets=facets), "fewer than three vertices")


def test_a_face_split_into_two_triangles_is_refused() -> None:
    hull = exact_hull(GRID)
    number = facet_with(hull, TOP)
    a, b, c, d = hull.facets[number].polygon
    refused(GRID, exchanged(hull, number, Facet(TOP, (a, b, c)), Facet(TOP, (a, c, d))), "a plane occurs twice")
    refused(GRID, exchanged(hull, number, Facet(TOP, (a, b, c))), "its plane contains other vertices than its polygon")


def test_a_point_inside_a_face_is_refused_as_a_vertex() -> None:
    hull = exact_hull(GRID)
    refused(GRID, promoted(hull, GRID.index((1, 1, 2))), "its plane contains other vertices than its polygon")


def test_a_point_inside_an_edge_is_refused_as_a_vertex_of_both_faces() -> None:
    """The result satisfies all other checks, but two planes do not determine the vertex."""
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


def test_an_interior_point_is_refused_as_a_vertex() -> None:
    refused(GRID, promoted(exact_hull(GRID), 13), "point 13 is called a vertex")


def test_the_hull_of_all_points_except_one_vertex_is_refused() -> None:
    """The result is consistent, but a point is outside."""
    for points, hull in one_vertex_short():
        refused(points, hull, "point 4 is outside of facet")


@pytest.mark.parametrize(("index", "taken_from", "given_to"), [(13, "inside", "boundary"), (4, "boundary", "inside")])
def test_exchanging_boundary_and_inside_is_refused(index: int, taken_from: str, given_to: str) -> None:
    hull = exact_hull(GRID)
    corrupt = replace(
        hull,
        **{
            taken_from: tuple(k for k in getattr(hull, taken_from) if k != index),
            given_to: tuple(sorted((*getattr(hull, given_to), index))),
        },
    )
    refused(GRID, corrupt, f"point {index} is .* a facet, which contradicts its class")


def test_a_vertex_is_refused_as_a_boundary_point() -> None:
    hull = exact_hull(GRID)
    corrupt = replace(hull, vertices=hull.vertices[1:], boundary=(hull.vertices[0], *hull.boundary))
    refused(GRID, corrupt, "a point of the polygon is not a vertex")


def test_a_duplicate_is_refused_as_a_vertex() -> None:
    hull = exact_hull(GRID)
    corrupt = replace(hull, vertices=(*hull.vertices, 28), duplicates=hull.duplicates[:1])
    refused(GRID, corrupt, "point 28 is stated to equal point 28, but first occurs as point 0")


def test_the_second_of_two_equal_points_is_refused_as_the_first() -> None:
    hull = exact_hull(OCTAHEDRON + OCTAHEDRON[5:])
    corrupt = replace(hull, vertices=(0, 1, 2, 3, 4, 6), duplicates=((5, 6),))
    refused(OCTAHEDRON + OCTAHEDRON[5:], corrupt, "point 5 is stated to equal point 6")


def test_a_scale_that_is_not_the_least_is_refused() -> None:
    hull = exact_hull(OCTAHEDRON)
    corrupt = replace(hull, scale=2, scaled=tuple(tuple(2 * n for n in p) for p in hull.scaled))
    refused(OCTAHEDRON, corrupt, "the scale is not the least")


def test_scaled_coordinates_as_numpy_integers_are_refused() -> None:
    hull = exact_hull(OCTAHEDRON)
    corrupt = replace(hull, scaled=tuple(map(tuple, np.array(hull.scaled))))
    refused(OCTAHEDRON, corrupt, "point 0: its scaled coordinates")


def test_a_pentagram_is_refused() -> None:
    """The polygon turns left everywhere, but goes around twice."""
    hull = exact_hull(PRISM)
    number = facet_with(hull, (0, 0, 1, -3))
    a, b, c, d, e = hull.facets[number].polygon
    refused(PRISM, exchanged(hull, number, Facet((0, 0, 1, -3), (a, c, e, b, d))), "goes around 2 times")


def test_two_closed_surfaces_violate_eulers_relation() -> None:
    """Earlier checks refuse every such hull, so this check is called directly."""
    hull = exact_hull(OCTAHEDRON)
    assert checks._check_polyhedron(hull) == 12
    shift = len(hull.scaled)
    other = [Facet(facet.plane, tuple(index + shift for index in facet.polygon)) for facet in hull.facets]
    both = SimpleNamespace(vertices=range(2 * shift), scaled=tuple(hull.scaled) * 2, facets=(*hull.facets, *other))
    with pytest.raises(CertificateError, match="Euler's relation does not hold: 12 vertices, 24 edges, 16 facets"):
        checks._check_polyhedron(both)


def test_an_edge_with_an_inclined_plane_is_refused() -> None:
    square = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)]
    hull = exact_hull(square)
    number = facet_with(hull, (0, -1, 0, 0))
    refused(square, exchanged(hull, number, Facet((0, -1, 1, 0), hull.facets[number].polygon)), "at right angles")


def test_a_polygon_with_the_negative_plane_is_refused() -> None:
    hull = exact_hull(SKEW_SQUARE)
    refused(SKEW_SQUARE, replace(hull, plane=tuple(-number for number in hull.plane)), "plane is not positive")


def test_a_polygon_with_a_point_outside_its_plane_is_refused() -> None:
    """The point is inside the plane of every edge, but not in that of the polygon, which the rank shows first."""
    square = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)]
    hull = exact_hull([*square, (1, 1, 0)])
    refused([*square, (1, 1, 1)], replace(hull, scaled=(*hull.scaled[:4], (1, 1, 1))), "but the points have rank 3")
    with pytest.raises(CertificateError, match="point 4 is not in the polygon's plane"):
        checks._check_polygon(replace(hull, scaled=(*hull.scaled[:4], (1, 1, 1))))


def test_a_segment_with_an_inclined_end_is_refused() -> None:
    points = [(0, 0, 0), (4, 0, 0)]
    hull = exact_hull(points)
    refused(points, replace(hull, facets=(Facet((-1, 0, 0, 0), (0,)), Facet((1, 1, 0, -4), (1,)))), "at right angles")


def test_a_segment_with_one_end_is_refused() -> None:
    points = [(0, 0, 0), (4, 0, 0)]
    hull = exact_hull(points)
    one = replace(hull, facets=hull.facets[:1], vertices=(0,), inside=(1,))
    refused(points, one, "the segment has 1 ends")


def test_a_point_with_a_facet_or_without_a_vertex_is_refused() -> None:
    hull = exact_hull(POINT)
    refused(POINT, replace(hull, facets=(Facet((0, 0, 1, -6), (0,)),)), "a point has one vertex and no facets")
    refused(POINT, replace(hull, vertices=(), inside=(0,)), "a point has one vertex and no facets")


def test_a_polygon_that_contradicts_the_dimension_is_refused() -> None:
    hull = exact_hull(OCTAHEDRON)
    refused(OCTAHEDRON, replace(hull, polygon=hull.facets[0].polygon), "a polygon must be stated for dimension 2")
    refused(SKEW_SQUARE, replace(exact_hull(SKEW_SQUARE), polygon=()), "a polygon must be stated for dimension 2")


def test_cycles_that_do_not_start_with_the_smallest_vertex_are_refused() -> None:
    hull = exact_hull(OCTAHEDRON)
    a, b, c = hull.facets[0].polygon
    refused(OCTAHEDRON, exchanged(hull, 0, Facet(hull.facets[0].plane, (b, c, a))), "the smallest vertex is not first")
    refused(OCTAHEDRON, exchanged(hull, 0, Facet(hull.facets[0].plane, ())), "the smallest vertex is not first")
    hull = exact_hull(SKEW_SQUARE)
    refused(SKEW_SQUARE, replace(hull, polygon=(*hull.polygon[1:], hull.polygon[0])), "not an order of the vertices")


def test_a_polygon_whose_plane_is_not_in_lowest_terms_is_refused() -> None:
    hull = exact_hull(SKEW_SQUARE)
    corrupt = replace(hull, plane=tuple(2 * number for number in hull.plane))
    refused(SKEW_SQUARE, corrupt, "the polygon's plane is not in lowest terms")


def test_a_line_through_one_corner_is_refused_as_an_edge() -> None:
    square = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)]
    hull = exact_hull(square)
    extra = tuple(sorted((*hull.facets, Facet((-1, -1, 0, 0), (0,))), key=lambda facet: facet.plane))
    refused(square, replace(hull, facets=extra), "the facets are not the polygon's edges")


def test_the_rank_of_vectors_is_exact() -> None:
    assert checks.rank([]) == 0
    assert checks.rank([(0, 0, 0)]) == 0
    assert checks.rank([(2, 4, 6), (-3, -6, -9)]) == 1
    assert checks.rank([(0, 4, 6), (0, -6, -9), (0, 1, 1), (0, 7, -2)]) == 2
    assert checks.rank([(1, 10**30, 1), (1, 10**30 + 1, 1), (1, 10**30, 2)]) == 3


def test_a_construction_that_forgets_points_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    points = ball(60, 1)
    assert exact_hull(points).dimension == 3
    order = build_module.insertion_order
    monkeypatch.setattr(build_module, "insertion_order", lambda count, simplex: order(count, simplex)[:10])
    with pytest.raises(CertificateError, match="is outside of facet"):
        exact_hull(points)


def test_a_construction_in_rounded_numbers_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """The surface is constructed from coordinates truncated to multiples of 1024, so that only its planes are wrong."""
    points = ball(60, 2)
    construct = build_module.convex_surface

    def rounded(points, simplex, order):
        return construct(read_points([tuple(number // 1024 * 1024 for number in p) for p in points]), simplex, order)

    monkeypatch.setattr(build_module, "convex_surface", rounded)
    with pytest.raises(CertificateError, match="is not in its plane"):
        exact_hull(points)


def test_a_construction_that_misses_visible_triangles_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """A point that is assigned no triangle although it sees one remains outside."""
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
def test_a_horizon_that_is_not_a_simple_cycle_raises_an_error(monkeypatch: pytest.MonkeyPatch, times: int) -> None:
    """The first edge of the horizon is missing, or occurs twice."""
    seen = surface_module.Surface._visible

    def broken(surface, p):
        triangles, horizon = seen(surface, p)
        return triangles, horizon[:1] * times + horizon[1:]

    monkeypatch.setattr(surface_module.Surface, "_visible", broken)
    with pytest.raises(RuntimeError, match="the horizon is not a simple cycle"):
        exact_hull([(0, 0, 0), (9, 0, 0), (0, 9, 0), (0, 0, 9), (5, 5, 5)])


def test_a_construction_that_calls_boundary_points_inside_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(build_module, "_on_facets", lambda points, facets: np.empty(0, int))
    with pytest.raises(CertificateError, match="which contradicts its class"):
        exact_hull(GRID)
