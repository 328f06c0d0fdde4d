"""The certificate refuses every corruption of a true hull, and the results of a faulty construction."""

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from operator import attrgetter
from types import SimpleNamespace

import numpy as np
import pytest

from modern.exact_hull import CertificateError, ExactHull, Facet, certify, exact_hull
from modern.exact_hull import build as build_module
from modern.exact_hull import certificate as checks
from modern.exact_hull import surface as surface_module
from modern.exact_hull.coordinates import read_points
from modern.exact_hull.result import Plane
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


def test_hulls_of_other_points_are_refused() -> None:
    hull = exact_hull(GRID)
    for index, point in enumerate(GRID):
        for moved in ((point[0] + 1, *point[1:]), (Fraction(1, 2) + point[0], *point[1:])):
            with pytest.raises(CertificateError):
                certify([*GRID[:index], moved, *GRID[index + 1 :]], hull)
    with pytest.raises(CertificateError, match="scaled points, found"):
        certify(GRID[:-1], hull)
    # The result is consistent, but a point is outside.
    for points, hull in one_vertex_short():
        refused(points, hull, "point 4 is outside of facet")


TOP = (0, 0, 1, -2)
CUBE = [point for point in GRID[:27] if 1 not in point]
SQUARE = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)]
SEGMENT = [(0, 0, 0), (4, 0, 0)]
TWICE = OCTAHEDRON + OCTAHEDRON[5:]


def with_facet(old: Plane, plane: Plane | None, *order: int) -> Callable[[ExactHull], ExactHull]:
    """Return a change of the facet in the plane ``old``: another plane, other corners, or both; or None to drop it.

    ``order`` has the places of the new corners in the old polygon.
    """

    def changed(hull: ExactHull) -> ExactHull:
        number = facet_with(hull, old)
        polygon = hull.facets[number].polygon
        new = () if plane is None else (Facet(plane, tuple(polygon[k] for k in order) if order else polygon),)
        return exchanged(hull, number, *new)

    return changed


def with_extra(plane: Plane, *polygon: int) -> Callable[[ExactHull], ExactHull]:
    return lambda hull: replace(
        hull, facets=tuple(sorted((*hull.facets, Facet(plane, polygon)), key=attrgetter("plane")))
    )


def split(hull: ExactHull) -> ExactHull:
    number = facet_with(hull, TOP)
    a, b, c, d = hull.facets[number].polygon
    return exchanged(hull, number, Facet(TOP, (a, b, c)), Facet(TOP, (a, c, d)))


def moved(index: int, taken_from: str, given_to: str) -> Callable[[ExactHull], ExactHull]:
    """Return a change that moves a point from one class to another."""
    return lambda hull: replace(
        hull,
        **{
            taken_from: tuple(k for k in getattr(hull, taken_from) if k != index),
            given_to: tuple(sorted((*getattr(hull, given_to), index))),
        },
    )


# Points, a change of their hull that no change of a single number makes, and a part of the message.
CHANGES = {
    "a face is missing, so the points in it lie in no plane": (GRID, with_facet(TOP, None), "states the opposite"),
    "a face is missing, so two planes do not determine a corner": (
        CUBE,
        with_facet(TOP, None),
        "the planes through it meet in more than one point",
    ),
    "no facets": (GRID, lambda hull: replace(hull, facets=()), "there are no facets"),
    "a face in the order seen from inside": (GRID, with_facet(TOP, TOP, 0, 3, 2, 1), "does not turn left"),
    "a plane that points inward": (GRID, with_facet(TOP, (0, 0, -1, 2)), "is outside of facet"),
    "a plane that is not in lowest terms": (GRID, with_facet(TOP, (0, 0, 2, -4)), "lowest terms"),
    "a plane of zeros": (GRID, with_facet(TOP, (0, 0, 0, 0)), "normal is 0"),
    "a plane without a normal": (GRID, with_facet(TOP, (0, 0, 0, 1)), "normal is 0"),
    "a parallel plane": (GRID, with_facet(TOP, (0, 0, 1, -3)), "is not in its plane"),
    "a plane of three numbers": (GRID, with_facet(TOP, (0, 0, 1)), "not four integers"),
    "a plane of numpy integers": (GRID, with_facet(TOP, tuple(np.array(TOP))), "not four integers"),
    "a plane through an edge that intersects the cube": (
        GRID,
        lambda hull: exchanged(hull, 0, Facet((1, -1, 0, 0), (0, 2))),
        "is outside of facet",
    ),
    "an extra plane that touches an edge": (GRID, with_extra((-1, -1, 0, 0), 0, 2), "fewer than three vertices"),
    "a face split into two triangles": (GRID, split, "a plane occurs twice"),
    "a face without a corner": (GRID, with_facet(TOP, TOP, 0, 1, 2), "contains other vertices than its polygon"),
    "a point inside a face as a vertex": (
        GRID,
        lambda hull: promoted(hull, GRID.index((1, 1, 2))),
        "contains other vertices than its polygon",
    ),
    "an interior point as a vertex": (GRID, lambda hull: promoted(hull, 13), "point 13 is called a vertex"),
    "an interior point on the boundary": (GRID, moved(13, "inside", "boundary"), "point 13 is not on a facet"),
    "a point of the boundary inside": (GRID, moved(4, "boundary", "inside"), "point 4 is on a facet"),
    "a vertex on the boundary": (GRID, moved(0, "vertices", "boundary"), "a point of the polygon is not a vertex"),
    "a duplicate as a vertex": (
        GRID,
        lambda hull: replace(hull, vertices=(*hull.vertices, 28), duplicates=hull.duplicates[:1]),
        "point 28 is stated to equal point 28, but first occurs as point 0",
    ),
    "the second of two equal points as the first": (
        TWICE,
        lambda hull: replace(hull, vertices=(0, 1, 2, 3, 4, 6), duplicates=((5, 6),)),
        "point 5 is stated to equal point 6",
    ),
    "a scale that is not the least": (
        OCTAHEDRON,
        lambda hull: replace(hull, scale=2, scaled=tuple(tuple(2 * n for n in p) for p in hull.scaled)),
        "the scale is not the least number",
    ),
    "scaled coordinates as numpy integers": (
        OCTAHEDRON,
        lambda hull: replace(hull, scaled=tuple(map(tuple, np.array(hull.scaled)))),
        "point 0: its scaled coordinates",
    ),
    "a pentagram, which turns left everywhere": (
        PRISM,
        with_facet((0, 0, 1, -3), (0, 0, 1, -3), 0, 2, 4, 1, 3),
        "the sides of the polygon turn around 2 times",
    ),
    "an edge with an inclined plane": (SQUARE, with_facet((0, -1, 0, 0), (0, -1, 1, 0)), "at right angles"),
    "a line through one corner as an edge": (SQUARE, with_extra((-1, -1, 0, 0), 0), "not the polygon's edges"),
    "the negative plane of a polygon": (
        SKEW_SQUARE,
        lambda hull: replace(hull, plane=tuple(-n for n in hull.plane)),
        "plane is not positive",
    ),
    "twice the plane of a polygon": (
        SKEW_SQUARE,
        lambda hull: replace(hull, plane=tuple(2 * n for n in hull.plane)),
        "not in lowest terms",
    ),
    "no polygon": (SKEW_SQUARE, lambda hull: replace(hull, polygon=()), "must be stated for dimension 2"),
    "a polygon of a polyhedron": (
        OCTAHEDRON,
        lambda hull: replace(hull, polygon=(0, 2, 4)),
        "must be stated for dimension 2",
    ),
    "a polygon that starts with another vertex": (
        SKEW_SQUARE,
        lambda hull: replace(hull, polygon=(*hull.polygon[1:], hull.polygon[0])),
        "does not name every vertex once",
    ),
    "a face that starts with another vertex": (GRID, with_facet(TOP, TOP, 1, 2, 3, 0), "smallest index is not"),
    "a face without corners": (
        OCTAHEDRON,
        lambda hull: exchanged(hull, 0, Facet(hull.facets[0].plane, ())),
        "smallest index is not",
    ),
    "an inclined end of a segment": (SEGMENT, with_facet((1, 0, 0, -4), (1, 1, 0, -4)), "at right angles"),
    "a segment with one end": (
        SEGMENT,
        lambda hull: replace(hull, facets=hull.facets[:1], vertices=(0,), inside=(1,)),
        "the segment has 1 ends",
    ),
    "a facet of a point": (POINT, with_extra((0, 0, 1, -6), 0), "a point has one vertex and no facets"),
    "a point without a vertex": (POINT, moved(0, "vertices", "inside"), "a point has one vertex and no facets"),
}


@pytest.mark.parametrize("name", CHANGES)
def test_a_change_is_refused_with_a_message(name: str) -> None:
    points, change, message = CHANGES[name]
    refused(points, change(exact_hull(points)), message)


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


def test_two_surfaces_and_polygons_outside_their_plane_are_refused() -> None:
    # Earlier checks refuse every such hull, so this check is called directly.
    hull = exact_hull(OCTAHEDRON)
    assert checks._check_polyhedron(hull) == 12
    shift = len(hull.scaled)
    other = [Facet(facet.plane, tuple(index + shift for index in facet.polygon)) for facet in hull.facets]
    both = SimpleNamespace(vertices=range(2 * shift), scaled=tuple(hull.scaled) * 2, facets=(*hull.facets, *other))
    with pytest.raises(CertificateError, match="Euler's relation does not hold: 12 vertices, 24 edges, 16 facets"):
        checks._check_polyhedron(both)
    # The point is inside the plane of every edge, but not in that of the polygon, which the rank shows first.
    hull = exact_hull([*SQUARE, (1, 1, 0)])
    refused([*SQUARE, (1, 1, 1)], replace(hull, scaled=(*hull.scaled[:4], (1, 1, 1))), "but that of the points is 3")
    with pytest.raises(CertificateError, match="point 4 is not in the polygon's plane"):
        checks._check_polygon(replace(hull, scaled=(*hull.scaled[:4], (1, 1, 1))))


def test_the_rank_of_vectors_is_exact() -> None:
    assert checks.rank([]) == 0
    assert checks.rank([(0, 0, 0)]) == 0
    assert checks.rank([(2, 4, 6), (-3, -6, -9)]) == 1
    assert checks.rank([(0, 4, 6), (0, -6, -9), (0, 1, 1), (0, 7, -2)]) == 2
    assert checks.rank([(1, 10**30, 1), (1, 10**30 + 1, 1), (1, 10**30, 2)]) == 3


def test_a_construction_that_forgets_points_is_refused(monkeypatch) -> None:
    points = ball(60, 1)
    assert exact_hull(points).dimension == 3
    order = build_module.insertion_order
    monkeypatch.setattr(build_module, "insertion_order", lambda count, simplex: order(count, simplex)[:10])
    with pytest.raises(CertificateError, match="is outside of facet"):
        exact_hull(points)


def test_a_construction_in_rounded_numbers_is_refused(monkeypatch) -> None:
    """The surface is constructed from coordinates truncated to multiples of 1024, so that only its planes are wrong."""
    points = ball(60, 2)
    construct = build_module.convex_surface

    def rounded(points, simplex, order):
        return construct(read_points([tuple(number // 1024 * 1024 for number in p) for p in points]), simplex, order)

    monkeypatch.setattr(build_module, "convex_surface", rounded)
    with pytest.raises(CertificateError, match="is not in its plane"):
        exact_hull(points)


def test_a_construction_that_misses_visible_triangles_is_refused(monkeypatch) -> None:
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
def test_a_horizon_that_is_not_a_simple_cycle_raises_an_error(monkeypatch, times: int) -> None:
    """The first edge of the horizon is missing, or occurs twice."""
    seen = surface_module.Surface._visible

    def broken(surface, p):
        triangles, horizon = seen(surface, p)
        return triangles, horizon[:1] * times + horizon[1:]

    monkeypatch.setattr(surface_module.Surface, "_visible", broken)
    with pytest.raises(RuntimeError, match="the horizon is not a simple cycle"):
        exact_hull([(0, 0, 0), (9, 0, 0), (0, 9, 0), (0, 0, 9), (5, 5, 5)])


def test_a_construction_that_calls_boundary_points_inside_is_refused(monkeypatch) -> None:
    monkeypatch.setattr(build_module, "_on_facets", lambda points, facets: np.empty(0, int))
    with pytest.raises(CertificateError, match="but the hull states the opposite"):
        exact_hull(GRID)
