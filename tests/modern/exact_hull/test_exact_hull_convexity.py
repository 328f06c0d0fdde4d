"""The proof by local convexity refuses the same corruptions as the proof by all planes, and some special ones."""

import itertools
import math
import pickle
import random
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from modern.exact_hull import CertificateError, ExactHull, Facet, certify, convexity, exact_hull
from modern.exact_hull import build as build_module
from modern.exact_hull import certificate as checks
from modern.exact_hull.coordinates import read_points
from modern.exact_hull.facets import lowest_terms, plane_through
from modern.exact_hull.planes import BOUND, Planes, normal_images
from modern.exact_hull.polygons import check_planes, polygons
from modern.exact_hull.result import Facets, facets_as_arrays
from tests.support.corrupted import BIG, GRID, OCTAHEDRON, PRISM, ball, exchanged, mutations, refused

NEEDLE = [(x, y * 10**6, z) for x in range(3) for y in (0, 1, 5) for z in range(2)] + [(1, 5 * 10**6 + 1, 1)]
SETS = {
    "grid": GRID,
    "octahedron": [*OCTAHEDRON, (0, 0, 0)],
    "prism": [*PRISM, (0, 0, 1), (0, 0, 3)],
    "big": BIG,
    "needle": NEEDLE,
    "ball": ball(30, 4),
    "long": [(x << 1200, y, z) for x, y, z in [*PRISM, (0, 0, 1), (0, 0, 3)]],
    "halves": [tuple(Fraction(number, 2) for number in point) for point in ball(12, 5)],
}


@pytest.fixture(autouse=True)
def _by_convexity(monkeypatch) -> None:
    monkeypatch.setattr(checks, "MANY", 0)
    monkeypatch.setattr(checks, "_check_points", None)


@pytest.mark.parametrize("name", SETS)
def test_every_single_change_of_a_hull_is_refused(name: str) -> None:
    points = SETS[name]
    hull = exact_hull(points)
    assert certify(points, hull) == hull.certificate
    tried = 0
    for field in ("dimension", "vertices", "boundary", "inside", "duplicates", "plane", "facets", "polygon"):
        for changed in mutations(getattr(hull, field)):
            corrupt = replace(hull, **{field: changed})
            if corrupt == hull or changed == getattr(hull, field):
                continue
            tried += 1
            with pytest.raises(CertificateError):
                certify(points, corrupt)
    assert tried > 100


@pytest.mark.parametrize("name", SETS)
def test_every_change_of_a_coordinate_is_refused(name: str) -> None:
    """The change is made in the points alone, or in points and result if that changes the hull."""
    points = SETS[name]
    hull = exact_hull(points)
    for index, axis, step in itertools.product(range(len(points)), range(3), (-1, 1)):
        moved = list(hull.scaled[index])
        moved[axis] += step
        scaled = (*hull.scaled[:index], tuple(moved), *hull.scaled[index + 1 :])
        given = [tuple(Fraction(number, hull.scale) for number in point) for point in scaled]
        with pytest.raises(CertificateError):
            certify(given, hull)
        corrupt = replace(hull, scaled=scaled)
        if exact_hull(given) != corrupt:
            with pytest.raises(CertificateError):
                certify(given, corrupt)


def surface(points, triangles) -> ExactHull:
    """Return triangles as if they were the hull of the points."""
    facets = [Facet(lowest_terms(plane_through(*(points[k] for k in t))), rotated(t)) for t in triangles]
    corners = sorted({index for t in triangles for index in t})
    others = tuple(sorted(set(range(len(points))) - set(corners)))
    ordered = tuple(sorted(facets, key=lambda facet: facet.plane))
    return ExactHull(3, 1, tuple(points), tuple(corners), (), others, (), None, ordered)


def rotated(triangle):
    first = triangle.index(min(triangle))
    return (*triangle[first:], *triangle[:first])


def double_pyramid(step: int) -> ExactHull:
    """A pentagon between two apexes, with its corners joined in order, or as a pentagram (step 2)."""
    ring = [(4000, 0), (1236, 3804), (-3236, 2351), (-3236, -2351), (1236, -3804)]
    points = [(x, y, 0) for x, y in ring] + [(0, 0, 3000), (0, 0, -3000)]
    around = [(k * step % 5, (k + 1) * step % 5) for k in range(5)]
    return surface(points, [(a, b, 5) for a, b in around] + [(b, a, 6) for a, b in around])


def test_surfaces_that_overlap_or_have_a_dent_are_refused() -> None:
    # The surface passes all other checks, and only the ray shows that it is not convex.
    hull = double_pyramid(1)
    assert certify(hull.scaled, hull).facets == 10
    hull = double_pyramid(2)
    refused(hull.scaled, hull, "a ray from inside meets two facets")
    # The triangles of a point above a face of the octahedron, with the point moved below it.
    points = [*((9 * x, 9 * y, 9 * z) for x, y, z in OCTAHEDRON), (4, 4, 4)]
    triangles = [facet.polygon for facet in exact_hull(points).facets]
    assert len(triangles) == 10
    assert certify(points, surface(points, triangles)).facets == 10
    points[6] = (2, 2, 2)
    refused(points, surface(points, triangles), "is outside of facet")
    points[6] = (3, 3, 3)
    refused(points, surface(points, triangles), "a plane occurs twice")
    # Each surface is valid on its own.
    points = [*OCTAHEDRON, *((x + 9, y, z) for x, y, z in OCTAHEDRON)]
    one = exact_hull(OCTAHEDRON)
    shifted = exact_hull(points[6:])
    other = [Facet(facet.plane, tuple(k + 6 for k in facet.polygon)) for facet in shifted.facets]
    facets = sorted([*one.facets, *other], key=lambda facet: facet.plane)
    refused(points, replace(one, scaled=tuple(points), vertices=tuple(range(12)), facets=tuple(facets)), "Euler")


def test_a_surface_turned_inside_out_is_refused(monkeypatch) -> None:
    hull = exact_hull(OCTAHEDRON)
    facets = [Facet(tuple(-n for n in facet.plane), rotated(facet.polygon[::-1])) for facet in hull.facets]
    facets.sort(key=lambda facet: facet.plane)
    corrupt = replace(hull, facets=tuple(facets))
    with pytest.raises(convexity.Undecided, match="the middle of the vertices is not inside facet"):
        convexity.prove(corrupt)
    monkeypatch.undo()
    refused(OCTAHEDRON, corrupt, "is outside of facet")


@pytest.mark.parametrize("least", [0, 1 << 60], ids=["by convexity", "by all planes"])
def test_changed_arrays_of_facets_are_refused(least: int, monkeypatch) -> None:
    monkeypatch.undo()
    monkeypatch.setattr(checks, "MANY", least)
    points = ball(build_module.MANY, 6)
    hull = exact_hull(points)
    planes, corners, counts = arrays = hull.facets.planes, hull.facets.corners, hull.facets.counts
    of_numpy = planes.copy()
    of_numpy[0, 0] = np.int64(planes[0, 0])
    changed = [(other, corners, counts) for other in (planes + 1, -planes, planes * 2, planes[::-1], of_numpy)]
    others = (corners[::-1], corners + 1, np.roll(corners, 3), corners.astype(float))
    changed += [(planes, other, counts) for other in others]
    changed += [(planes, corners, counts + step) for step in (-1, 1)]
    changed += [(planes[:-1], corners[:-3], counts[:-1])]
    for each in changed:
        refused(points, replace(hull, facets=Facets(*each)), "facet|polygon|vertex")
    assert certify(points, replace(hull, facets=Facets(*map(np.copy, arrays)))) == hull.certificate
    assert pickle.loads(pickle.dumps(hull)) == hull == replace(hull, facets=tuple(hull.facets))


def test_reversed_missing_and_invalid_faces_are_refused() -> None:
    # The plane of the triangle is right, but its corners have the opposite order.
    hull = exact_hull(OCTAHEDRON)
    refused(OCTAHEDRON, exchanged(hull, 0, Facet(hull.facets[0].plane, rotated(hull.facets[0].polygon[::-1]))), "edge")
    every = [Facet(facet.plane, rotated(facet.polygon[::-1])) for facet in hull.facets]
    refused(OCTAHEDRON, replace(hull, facets=tuple(every)), "does not turn left|outside of facet")
    hull = exact_hull(GRID)
    refused(GRID, exchanged(hull, 0), "belongs to only one facet")
    refused(GRID, replace(hull, facets=(*hull.facets, hull.facets[-1])), "same direction")
    refused(GRID, replace(hull, facets=()), "there are no facets")
    hull = exact_hull(OCTAHEDRON)
    polygon = hull.facets[0].polygon
    for wrong in ((*polygon[:2], 17), (*polygon[:2], -1), (*polygon[:2], 1.0 * polygon[2]), polygon[:2], ()):
        refused(
            OCTAHEDRON,
            exchanged(hull, 0, Facet(hull.facets[0].plane, wrong)),
            "not an index|not a vertex|fewer than three",
        )


@pytest.mark.parametrize("seed", range(3))
def test_the_hull_of_all_points_except_any_vertex_is_refused(seed: int) -> None:
    """The missing vertex is called inside or boundary."""
    points = ball(40, 10 + seed)
    for index in exact_hull(points).vertices:
        rest = [point for k, point in enumerate(points) if k != index]
        hull = exact_hull(rest)

        def named(indices, at=index):
            return tuple(k + (k >= at) for k in indices)

        facets = tuple(Facet(facet.plane, named(facet.polygon)) for facet in hull.facets)
        for inside, boundary in (((index,), ()), ((), (index,))):
            corrupt = replace(
                hull,
                scaled=tuple(points),
                vertices=named(hull.vertices),
                inside=tuple(sorted((*named(hull.inside), *inside))),
                boundary=boundary,
                facets=facets,
            )
            refused(points, corrupt, f"point {index} is outside of facet")


@pytest.mark.parametrize("name", SETS)
def test_cones_and_all_planes_classify_every_point_equally(name: str, monkeypatch) -> None:
    """The classes are determined by cones only, and by all planes only (no triangle is found for any point)."""
    points = SETS[name]
    hull = exact_hull(points)
    cones = certify(points, hull)
    monkeypatch.setattr(convexity._Proof, "_located", lambda proof, away: (np.zeros(len(away), int), away[:, 0] > 9))
    monkeypatch.setattr(convexity, "_BALL", math.inf)
    walked = certify(points, hull)
    assert (walked.edges, walked.facets, walked.vertices) == (cones.edges, cones.facets, cones.vertices)
    monkeypatch.setattr(convexity._Proof, "_walked", lambda proof, triangle, point: -1)
    planes = certify(points, hull)
    assert planes.evaluations >= cones.evaluations
    assert (planes.edges, planes.facets, planes.vertices) == (cones.edges, cones.facets, cones.vertices)


@pytest.mark.parametrize("name", SETS)
def test_a_point_on_an_edge_is_evaluated_in_one_plane(name: str, monkeypatch) -> None:
    points = SETS[name]
    hull = exact_hull(points)
    monkeypatch.setattr(Planes, "largest", None)
    assert certify(points, hull).facets == len(hull.facets)


def test_only_doubtful_points_are_located_in_a_wrong_cone() -> None:
    """Points within the bound of a wall are in doubt; the cone of every other point contains it."""
    points = ball(60, 21)
    hull = exact_hull(points)
    facets = facets_as_arrays(hull.facets)
    sides = polygons(hull, facets)
    images = read_points(hull.scaled).images
    o = images.places[list(hull.vertices)].mean(axis=0)
    cones = convexity.cones(sides, images, o)
    proof = convexity._Proof(hull, sides, check_planes(hull, facets, sides), images, o, cones)
    rng = np.random.default_rng(3)
    away = rng.normal(size=(500, 3)) * 0.2
    found, sure = proof._located(away)
    assert sure.all()
    for place, triangle in zip(away, found, strict=True):
        a, b, c = (images.places[k] - o for k in cones.corners[triangle])
        assert (np.linalg.solve(np.stack([a, b, c], axis=1), place) > 0).all()
    along = images.places[cones.corners[:, 0]] - o
    assert not proof._located(along)[1].any()
    for triangle, corners in enumerate(cones.corners.tolist()):
        holding = [k for k, others in enumerate(cones.corners.tolist()) if corners[0] in others]
        assert proof._walked(triangle, corners[0]) == triangle
        assert proof._walked((triangle + 7) % len(cones.corners), corners[0]) in holding


@pytest.mark.parametrize(("digits", "long"), [(2, 0), (8, 0), (16, 0), (40, 0), (400, 0), (2, 90), (2, 1200)])
def test_the_errors_of_images_are_within_the_stated_bounds(digits: int, long: int) -> None:
    """Images of points and normals, and the values of planes, differ from the exact ones by less than the bound."""
    rng = random.Random(digits)
    points = [tuple(rng.randrange(10**digits) // 10 ** rng.randrange(2) for _ in range(3)) for _ in range(12)]
    points = [(x << long, y, z) for x, y, z in points]
    images = read_points(points).images
    table = np.array([lowest_terms(plane_through(*rng.sample(points, 3))) for _ in range(20)], object)
    normals = normal_images(table, images.shifts)
    largest = abs(normals).max(axis=1)
    assert ((largest >= 0.5) & (largest <= 1)).all()
    exact = [
        [Fraction(n - low, 2**shift) for n, low, shift in zip(p, images.low, images.shifts, strict=True)]
        for p in points
    ]
    for place, point in zip(images.places.tolist(), exact, strict=True):
        assert all(abs(Fraction(u) - v) <= Fraction(1, 2**54) for u, v in zip(place, point, strict=True))
    for row, plane in zip(normals, table, strict=True):
        scaled = [Fraction(n) * 2**shift for n, shift in zip(plane[:3], images.shifts, strict=True)]
        width = max(map(abs, scaled)) / max(abs(Fraction(float(n))) for n in row)
        power = 2 ** round(math.log2(width)) if width < 2**1000 else Fraction(2) ** (round(math.log2(int(width))))
        for one, other in zip(row.tolist(), scaled, strict=True):
            assert abs(Fraction(one) - other / power) <= Fraction(1, 2**54)
        p, q = rng.sample(range(12), 2)
        true = sum(n / power * (u - v) for n, u, v in zip(scaled, exact[q], exact[p], strict=True))
        assert abs(Fraction(float(row @ (images.places[q] - images.places[p]))) - true) < BOUND


def test_the_point_of_an_image_is_exact() -> None:
    images = read_points([(3, -7, 10**40), (20, 9, 10**40 + 12345), (4, 4, 10**40 + 5)]).images
    (x, y, z), weight = images.exactly(np.array([0.3, 0.125, 2.0**-70]))
    assert Fraction(x, weight) == 3 + 32 * Fraction(0.3)
    assert Fraction(y, weight) == -7 + 32 * Fraction(1, 8)
    assert Fraction(z, weight) == 10**40 + 2**14 * Fraction(1, 2**70)


def test_signs_in_doubt_are_decided_in_integers() -> None:
    """Points on a face of a wide cube and one unit from it, in each of its cones."""
    side = 10**17
    corners = list(itertools.product((0, side), repeat=3))
    rng = random.Random(9)
    inner = [(rng.randrange(1, side), rng.randrange(1, side), h) for h in (0, 1, side - 1, side) for _ in range(20)]
    hull = exact_hull([*corners, *inner])
    assert [len(hull.boundary), len(hull.inside)] == [40, 40]
    assert hull.certificate.in_integers >= 80
    for index in (hull.boundary[3], hull.inside[7]):
        boundary = tuple(sorted({*hull.boundary} ^ {index}))
        inside = tuple(sorted({*hull.inside} ^ {index}))
        refused(hull.scaled, replace(hull, boundary=boundary, inside=inside), f"point {index} is .* a facet")
