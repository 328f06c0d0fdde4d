"""Checks of chapter 2: convex combinations, supporting planes, vertices, and earlier methods, tried on small sets."""

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations, permutations

from modern.claims.evidence import Check, claim, searched, slip
from modern.claims.hulls import exact_hull
from modern.claims.sampled_sets import (
    CASES,
    SETS,
    Plane,
    Point,
    SampledSet,
    counterexample_points,
    plane_through,
    plane_value,
    sampled_sets,
)
from modern.geometry.mesh import sides
from modern.geometry.vectors import cross, dot, lowest, minus, plus


@claim("thesis.18")
def weights_of_combination() -> Check:
    lines = [facet.plane for facet in exact_hull([(0, 0, 0), (4, 0, 0), (0, 4, 0)]).facets]
    weights = [(4 - x - y, x, y) for x in range(-3, 8) for y in range(-3, 8)]
    outcomes = [(min(w) >= 0) == all(plane_value(line, (w[1], w[2], 0)) <= 0 for line in lines) for w in weights]
    inner = sum(min(w) >= 0 for w in weights)
    message = f"of {len(weights)} combinations of the corners of a triangle, whose weights have the sum 1, only the "
    message += f"{inner} without a negative weight are in the triangle"
    return slip(inner == len(weights), all(outcomes), "weights that are not negative and have the sum 1", message)


@claim("thesis.22")
def vertex_formula_with_minus() -> Check:
    points = counterexample_points("middle.csv")
    middle, pair_counts = points[1], {1: 0, -1: 0}
    for p, q in permutations(points, 2):
        share = Fraction(middle[0] - p[0], q[0] - p[0])
        for sign in pair_counts:
            right = all((1 - share) * p[k] + sign * share * q[k] == middle[k] for k in (1, 2))
            pair_counts[sign] += 0 < share < 1 and right
    corrected = 1 not in exact_hull(points).vertices and pair_counts[1] == 2
    message = f"{pair_counts[1]} ordered pairs of points give the middle point {middle} with a plus, "
    return slip(pair_counts[-1], corrected, "a plus", f"{message}and {pair_counts[-1]} with the printed minus")


@claim("thesis.23", dimension=2, full=400)
@claim("thesis.200", dimension=3, full=400)
def vertex_of_hull(dimension: int, cases: int = 1) -> Check:
    checks = []
    for sampled in sampled_sets(dimension, cases):
        for k, point in enumerate(sampled.points):
            # If a point is between two points of the hull, all facets that contain it contain a further given point q.
            # So it suffices to try each q with a point of the hull close by on the other side.
            # The point p + (p - q) / n has the value (1 + 1 / n) p' - q' / n in an equation with the values p' and q'.
            values = [
                [10**9 * plane_value(f.plane, point) - plane_value(f.plane, q) for f in sampled.judge.facets]
                for q in sampled.points
                if q != point
            ]
            checks.append((min(map(max, values)) <= 0) == (k not in sampled.judge.vertices))
    corners = [tuple(4 * (k == axis) for axis in range(3)) for k in (*range(dimension), 3)]
    inner = tuple(int(axis < dimension) for axis in range(3))
    between = [1 for p, q in combinations(corners, 2) if not any(cross(minus(q, p), minus(inner, p)))]  # type: ignore[arg-type]
    alone = not between and len(corners) not in exact_hull([*corners, inner]).vertices
    body = "triangle" if dimension == 2 else "tetrahedron"
    message = f"of {len(checks)} points, exactly the vertices are between no two points of the hull; {inner} inside a "
    return searched(SETS[dimension], cases, [*checks, alone], f"{message}{body} is between no two given points")


@claim("thesis.202", "thesis.27", kind="planes", full=200)
@claim("thesis.201", "appel-will.126", kind="lines", full=400)
def gift_wrapping(kind: str, cases: int = 1) -> Check:
    checks = []
    for sampled in sampled_sets(2 if kind == "lines" else 3, cases):
        expected = {_on(sampled.points, facet.plane) for facet in sampled.judge.facets}
        checks.append((_turned_lines(sampled) if kind == "lines" else _turned_planes(sampled.points)) == expected)
    turned = "lines about unsorted points" if kind == "lines" else "planes first about a line and then about edges"
    message = f"turning {turned} finds exactly the supporting {kind} of {sum(checks)} of {len(checks)} sets"
    return searched(SETS[2 if kind == "lines" else 3], cases, checks, message)


def _on(points: Sequence[Point], plane: Plane) -> frozenset[int]:
    return frozenset(k for k, point in enumerate(points) if not plane_value(plane, point))


def _turned(points: Sequence[Point], p: Point, q: Point) -> Plane:
    """Turn a plane about the line through p and q until no point lies beyond it."""
    best: Plane = (0, 0, 0, 0)
    for point in points:
        if not any(best[:3]) or plane_value(best, point) > 0:
            best = plane_through(p, q, point)
    return best


def _turned_planes(points: Sequence[Point]) -> set[frozenset[int]]:
    # Start with a vertical plane at the smallest point, and turn it about the vertical line.
    x, y, z = p = min(points)
    plane = _turned(points, p, (x, y, z + 1))
    facets_found: set[frozenset[int]] = set()
    queue = [plane]
    while queue:
        plane = queue.pop()
        on = sorted(_on(points, plane))
        flat = exact_hull([points[k] for k in on])
        if flat.dimension == 2:
            if frozenset(on) in facets_found:
                continue
            facets_found.add(frozenset(on))
        # Turn the plane about each edge of the face found, in both directions.
        ring = [points[on[k]] for k in (flat.polygon if flat.dimension == 2 else flat.vertices)]
        queue += [_turned(points, *ends) for a, b in sides(ring) for ends in ((a, b), (b, a))]
    return facets_found


def _turned_lines(sampled: SampledSet) -> set[frozenset[int]]:
    lines_found: set[frozenset[int]] = set()
    first = p = min(sampled.points)
    while not lines_found or p != first:
        on = _on(sampled.points, _turned(sampled.points, p, above(sampled, p)))
        lines_found.add(on)
        # Continue at the far end of the side, as in gift wrapping.
        p = max((sampled.points[k] for k in on), key=lambda q: dot(minus(q, p), minus(q, p)))
    return lines_found


def above(sampled: SampledSet, p: Point) -> Point:
    """Return a point outside the plane of a flat set, perpendicularly above p."""
    assert sampled.judge.plane is not None
    return plus(p, lowest(sampled.judge.plane[:3]))


@claim("thesis.24", dimension=3, full=400)
@claim("thesis.25", dimension=2, full=400)
def planes_from_points(dimension: int, cases: int = CASES) -> Check:
    agreeing = []
    for sampled in sampled_sets(dimension, cases):
        supporting = set()
        for some in combinations(sampled.points, dimension):
            # A line of a flat set is the intersection of this set with a perpendicular plane.
            plane = plane_through(*some, *([above(sampled, some[0])] if dimension == 2 else []))
            values = [plane_value(plane, point) for point in sampled.points]
            if any(plane[:3]) and (max(values) <= 0 or min(values) >= 0):
                supporting.add(_on(sampled.points, plane))
        agreeing.append(supporting == {_on(sampled.points, facet.plane) for facet in sampled.judge.facets})
    tested, facets = ("planes", "facets") if dimension == 3 else ("lines", "edges")
    message = f"in {sum(agreeing)} of {cases} sets, the test of all {tested} finds exactly the {facets} of the exact"
    return searched(SETS[dimension], cases, agreeing, f"{message} hull")
