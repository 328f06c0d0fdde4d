"""Checks of Kovalevsky and Schulz: definitions, local corners, Theorem PL, coplanar faces, sizes and symmetry."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from itertools import combinations, permutations, product
from random import Random

import numpy as np

from modern.claims.evidence import Check, claim, holds_if, refuted
from modern.claims.published import PAPERS, printed_lines, produced_by
from modern.claims.sampled_sets import CASES, Point, counterexample_points, plane_value, sampled_sets
from modern.digital.solids import Volume, half_ball, listed
from modern.exact_hull import ExactHull, exact_hull
from modern.geometry.vectors import dot, minus, plus
from modern.papers.kovalevsky_schulz import CENTRES, VERTICES, convex_polyhedron, local_corners
from modern.papers.kovalevsky_schulz.cells import CellList, cell_list_size, triangulation_size
from modern.papers.kovalevsky_schulz.coplanar import EXTENDED, QUADRANGLES, Treatment, coplanar_hull
from modern.papers.kovalevsky_schulz.hull import merged, straightened

GRID = tuple(product(range(3), repeat=3))
# The diameters of the half-balls of Table 5.
DIAMETERS = (8, 10, 12, 14, 16, 18, 20, 22)
PYRAMID: tuple[Point, ...] = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 2))


def random_solid(seed: int, side: int = 4) -> Volume:
    random = Random(seed)
    array = np.array([random.random() < 0.4 for _ in range(side**3)]).reshape(side, side, side)
    return Volume(array, (0, 0, 0))


@cache
def sampled_hulls() -> tuple[tuple[tuple[Point, ...], ExactHull], ...]:
    return tuple((sampled.points, sampled.judge) for sampled in sampled_sets(3, CASES))


@claim(
    "kovalevsky-schulz.1",
    "kovalevsky-schulz.5",
    "kovalevsky-schulz.47",
    "kovalevsky-schulz.75",
    "kovalevsky-schulz.127",
    "kovalevsky-schulz.143",
    kind="condition",
)
@claim("kovalevsky-schulz.10", "kovalevsky-schulz.51")
def algorithm_against_judge(kind: str = "") -> Check:
    """Compare both treatments of coplanar faces with the exact hull, on samples and on a grid of coplanar points."""
    checks = _right_hulls()
    return holds_if(all(checks), f"{len(checks) // 2} hulls agree with the exact hull", conditional=kind)


@cache
def _right_hulls() -> tuple[bool, ...]:
    checks = []
    for coplanar in ("visible", "invisible"):
        for points in (GRID, *(points for points, _ in sampled_hulls())):
            cells = convex_polyhedron(points, coplanar)
            assert isinstance(cells, CellList)
            straight = straightened(merged(cells))
            judge = exact_hull(points)
            checks.append({v.point for v in straight.vertices} == {points[k] for k in judge.vertices})
            checks.append(len(straight.faces) == len(judge.facets))
    return tuple(checks)


@claim("kovalevsky-schulz.6", "kovalevsky-schulz.7", "kovalevsky-schulz.11", "kovalevsky-schulz.125")
def vertices_among_local_corners() -> Check:
    """Check that the vertices of the hull of voxels are among their local corners."""
    checks = []
    for seed in (1, 2):
        volume = random_solid(seed)
        corners = {*map(tuple, local_corners(volume, CENTRES).tolist())}
        points = [*map(tuple, volume.coordinates().tolist())]
        checks.append({points[k] for k in exact_hull(points).vertices} <= corners and len(corners) < len(points))
    return holds_if(all(checks), f"the vertices of {len(checks)} solids are local corners")


@claim("kovalevsky-schulz.9")
def vertices_within_planes() -> Check:
    """Check that all vertices satisfy all planes of the exact hulls."""
    checks = [
        plane_value(f.plane, points[k]) <= 0
        for points, judge in sampled_hulls()
        for f in judge.facets
        for k in judge.vertices
    ]
    return holds_if(all(checks), f"{len(checks)} values are not positive")


@claim("kovalevsky-schulz.14", "kovalevsky-schulz.17", "kovalevsky-schulz.16")
@claim("kovalevsky-schulz.15", kind="condition")
def combinations_not_vertices(kind: str = "") -> Check:
    """Check that midpoints of two points are not vertices, and that a vertex is outside the hull of the others."""
    checks = _combined()
    return holds_if(all(checks), f"{len(checks)} points agree", conditional=kind)


@cache
def _combined() -> tuple[bool, ...]:
    checks = []
    for points, judge in sampled_hulls()[:1]:
        doubled = [plus(p, p) for p in points]
        for p, q in combinations(points[:5], 2):
            checks.append(len(points) not in exact_hull([*doubled, plus(p, q)]).vertices)
        for k in judge.vertices[:3]:
            rest = [p for i, p in enumerate(points) if i != k]
            checks.append(len(rest) in exact_hull([*rest, points[k]]).vertices)
    return tuple(checks)


@claim("kovalevsky-schulz.19")
def local_corner_inside_hull() -> Check:
    """Check a voxel that has both voxels of none of its 13 opposite pairs and yet lies within three neighbours."""
    points = counterexample_points("tripod.csv")
    corners = {*map(tuple, local_corners(listed(points), CENTRES).tolist())}
    middle = points[-1]
    near = all(max(abs(a - b) for a, b in zip(p, middle, strict=True)) == 1 for p in points[:-1])
    wrong = middle in corners and near and len(points) - 1 not in exact_hull(points).vertices
    return refuted(wrong, f"{middle} is a local corner and a convex combination of its {len(points) - 1} neighbours")


@claim("kovalevsky-schulz.48", "kovalevsky-schulz.49", "kovalevsky-schulz.74")
def choice_of_q() -> Check:
    """Check that the product of the normal with P - Q is the same for all corners Q of a face."""
    checks = []
    for points, judge in sampled_hulls():
        for facet in judge.facets:
            products = {dot(facet.plane[:3], minus(points[0], points[k])) for k in facet.polygon}
            checks.append(len(products) == 1)
    return holds_if(all(checks), f"{len(checks)} faces give one product each")


@claim("kovalevsky-schulz.50", "yau-srihari.15")
def points_that_see_no_face() -> Check:
    """Check that grid points that see no face of a hull are in the hull."""
    points, judge = sampled_hulls()[0]
    checks, held = [], 0
    for point in ((x, y, z) for x, y, z in product((-4, -1, 0, 1, 4), repeat=3)):
        unseen = max(plane_value(f.plane, point) for f in judge.facets) <= 0
        inside = point in points or len(points) not in exact_hull([*points, point]).vertices
        checks.append(unseen == inside)
        held += inside
    return holds_if(all(checks) and held > 0, f"{len(checks)} points agree, {held} of them in the hull")


@claim("kovalevsky-schulz.52")
def cube_visible_from_corner() -> Check:
    """Check what is removed from a cube when a point beyond one of its corners is added."""
    cube = [*product((0, 2), repeat=3)]
    judge, after = exact_hull(cube), exact_hull([*cube, (3, 3, 3)])
    visible = [f for f in judge.facets if plane_value(f.plane, (3, 3, 3)) > 0]
    edges = [e for e in judge.edges() if sum({*e} <= {*f.polygon} for f in visible) == 2]
    gone = set(judge.vertices) - set(after.vertices)
    message = "three faces, three edges and one vertex are removed"
    return holds_if((len(visible), len(edges), len(gone)) == (3, 3, 1), message)


@claim("kovalevsky-schulz.54", "kovalevsky-schulz.166")
def coplanar_triangles() -> Check:
    """Check that counting coplanar faces as visible makes more triangles than the hull has faces."""
    cells = convex_polyhedron(GRID, "visible")
    assert isinstance(cells, CellList)
    return holds_if(len(cells.faces) > 6, f"the cube of a grid gets {len(cells.faces)} triangles, and has 6 faces")


@claim("kovalevsky-schulz.58", "kovalevsky-schulz.59")
@claim("kovalevsky-schulz.60", kind="crossing")
def extended_faces(kind: str = "") -> Check:
    """Check that extending faces to coplanar points gives the exact faces, and makes fewer new ones than triangles."""
    if kind:
        hull = coplanar_hull([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (2, 0, 0)], EXTENDED)
        message = f"{hull.extended} faces are extended, and {hull.straightened} edges become collinear"
        return holds_if(hull.extended == 2, message)
    extended, quadrangles_hull = coplanar_hull(GRID, EXTENDED), coplanar_hull(GRID, QUADRANGLES)
    right = list(extended.faces) == sorted(f.polygon for f in exact_hull(GRID).facets)
    return holds_if(
        right and extended.created < quadrangles_hull.created,
        f"the cube of a grid needs {extended.created} new faces, "
        f"and {quadrangles_hull.created} by the method of Fig. 7",
    )


@claim("kovalevsky-schulz.55")
def quadrangles() -> Check:
    """Check a point in the plane of a pyramid's square that sees two of its sides."""
    hull = coplanar_hull([*PYRAMID, (3, 3, 0)], QUADRANGLES)
    message = f"{hull.larger} new face with four corners is merged with the square"
    return holds_if(hull.larger == 1 and hull.merged > 0, message)


@claim("kovalevsky-schulz.78")
def formula_5() -> Check:
    """Check that the integers of all vertices and triangles, three for each, exceed formula (5) by 6."""
    checks = []
    for points, _ in sampled_hulls():
        cells = convex_polyhedron(points, "visible")
        assert isinstance(cells, CellList)
        corners, triangles = len(cells.vertices), len(cells.faces)
        checks.append(triangles == 2 * corners - 4)
        checks.append(3 * corners + 3 * triangles == triangulation_size(triangles) + 6)
    message = f"{len(checks) // 2} hulls of triangles need 6 integers more than by (5)"
    return holds_if(all(checks), message, conditional=True)


@claim("kovalevsky-schulz.91")
def integers_per_face() -> Check:
    """Check that Table 5's last column is rounded at diameter 16, so that 1070 / 142 at 18 is 7.54, not 7.53."""
    sixteen, eighteen = (Fraction(100 * integers, faces) for _, _, faces, integers in _table_5()[4:6])
    passed = (int(sixteen), round(sixteen)) == (855, 856) and (int(eighteen), round(eighteen)) == (753, 754)
    return holds_if(passed, "1010 / 118 is printed rounded as 8.56; 1070 / 142 is 7.535", conditional=True)


@cache
def _table_5() -> tuple[tuple[int, int, int, int], ...]:
    """Return the rows of Table 5: printed triangles and integers, and computed faces and integers of the hull."""
    paper = next(paper for paper in PAPERS if paper.name == "kovalevsky-schulz")
    printed, made = printed_lines(paper), produced_by(paper)
    rows = [(printed[name][0].split(), made[name][0].split()) for name in (f"table5-{d}" for d in DIAMETERS)]
    return tuple((int(p[1]), int(p[2]), int(m[4]), int(m[5])) for p, m in rows)


@claim("kovalevsky-schulz.100")
def memory_requirements() -> Check:
    """Compare the integers of the cell list with those of Marching Cubes and of triangles, for the bodies of Table 5.

    Formula (6) gives the number V of vertices from the number of integers; a hull has 2 V - 4 triangles.
    """
    fewer, more = [], {}
    for diameter, (_, triangulated, faces, cells) in zip(DIAMETERS, _table_5(), strict=True):
        # Formula (6) counts 5 integers for each face and 3 for each vertex.
        own = triangulation_size(2 * ((cells - 5 * faces) // 3) - 4)
        fewer.append(cells < triangulated)
        if cells > own:
            more[diameter] = f"{cells} against {own} at {diameter}"
    fewer.append(cell_list_size(60, 63) < triangulation_size(3560))
    message = (
        f"the cell list is smaller than that of Marching Cubes in {sum(fewer)} of {len(fewer)} cases, but "
        "larger than the triangles of the hull: "
    )
    return holds_if(all(fewer) and {*more} == {10, 18}, message + ", ".join(more.values()), conditional=True)


@claim("kovalevsky-schulz.170", "kovalevsky-schulz.171")
def integers_of_triangles() -> Check:
    """Check that Table 5 prints the integers of formula (5), 4.5 for each of the printed triangles."""
    checks = [triangulation_size(triangles) == integers for triangles, integers, _, _ in _table_5()]
    return holds_if(len(checks) == 8 and all(checks), f"{sum(checks)} of {len(checks)} rows agree")


@claim("kovalevsky-schulz.148", "kovalevsky-schulz.157")
def planar_faces() -> Check:
    """Check that the corners of each face of a half-ball are coplanar and that some vertex has over four edges."""
    cells = _half_ball()
    checks = []
    for face, plane in zip(cells.faces, cells.planes(), strict=True):
        checks.append(all(plane_value(plane, cells.vertices[v - 1].point) == 0 for v in face.vertices))
    most = max(len(vertex.edges) for vertex in cells.vertices)
    return holds_if(all(checks) and most > 4, f"{len(checks)} faces are planar; one vertex has {most} edges")


@claim("kovalevsky-schulz.146", "yau-srihari.17")
def halves_of_sorted_set() -> Check:
    """Check that the halves of points sorted by x are apart if all x differ, and may meet otherwise."""
    apart = []
    for points, _ in sampled_hulls():
        distinct = sorted({p[0]: p for p in points}.values())
        half = len(distinct) // 2
        apart.append(max(p[0] for p in distinct[:half]) < min(p[0] for p in distinct[half:]))
    halves = ([(0, 0, 0), (0, 2, 0)], [(0, 1, 0), (1, 1, 0)])
    meet = sorted(p[0] for half in halves for p in half) == [p[0] for half in halves for p in half]
    meet &= 2 not in exact_hull([*halves[0], halves[1][0]]).vertices
    message = "halves with distinct x are apart; (0, 1) lies between (0, 0) and (0, 2) of the other half"
    return holds_if(all(apart) and meet, message, conditional=True)


@claim("kovalevsky-schulz.161", "yau-srihari.114")
def cells_removed() -> Check:
    """Check what a new point removes: visible faces, edges between two of them, and vertices on these faces only."""
    checks = []
    for points, judge in sampled_hulls():
        for new in ((9, 1, 0), (-8, 3, 7)):
            values = {f: plane_value(f.plane, new) for f in judge.facets}
            after = exact_hull([*points, new])
            if 0 in values.values():
                continue
            # Expected: the invisible faces, and a triangle on each edge that bounds exactly one of them.
            hidden = {frozenset(f.polygon) for f, v in values.items() if v < 0}
            faces = {frozenset(f.polygon) for f in after.facets}
            rim = [e for e in judge.edges() if sum({*e} <= h for h in hidden) == 1]
            checks.append(faces == hidden | {frozenset((*edge, len(points))) for edge in rim})
            checks.append({*after.vertices} == {v for h in hidden for v in h} | {len(points)})
            remaining_edges = {e for e in judge.edges() if any({*e} <= h for h in hidden)}
            checks.append({e for e in after.edges() if len(points) not in e} == remaining_edges)
    message = f"checked for {len(checks) // 3} points outside a hull and in the plane of no face"
    return holds_if(bool(checks) and all(checks), message)


@claim("kovalevsky-schulz.163", treatment="quadrangles")
@claim("kovalevsky-schulz.165")
def collinear_edges(treatment: Treatment = EXTENDED) -> Check:
    """Check that the end of a side is no longer a vertex if a point is added on the line of the side."""
    square = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0), (1, 1, 5)]
    judge = exact_hull([*square, (8, 0, 0)])
    treated = coplanar_hull([*square, (8, 0, 0)], treatment)
    passed = judge.vertices == (0, 2, 3, 4, 5) and treated.straightened > 0
    return holds_if(passed, f"{treated.straightened} edges become collinear; (4, 0, 0) is no longer a vertex")


@cache
def _half_ball() -> CellList:
    return _straight(half_ball(10))


def _straight(volume: Volume) -> CellList:
    cells = convex_polyhedron(local_corners(volume, VERTICES))
    assert isinstance(cells, CellList)
    return straightened(merged(cells))


@claim("kovalevsky-schulz.95")
def symmetry() -> Check:
    """Check that rotations and reflections that map the voxels of a body to themselves map the faces to themselves."""
    short: list[Point] = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    numbers, checks = [], []
    for volume in (half_ball(10), listed(short), listed([*short, (0, 2, 0)])):
        voxels = [(int(x), int(y), int(z)) for x, y, z in np.argwhere(volume.array)]
        cells = _straight(volume)
        points = [vertex.point for vertex in cells.vertices]
        numbers.append(0)
        for order, signs in product(permutations(range(3)), product((1, -1), repeat=3)):
            if {*_moved(voxels, order, signs)} == {*_moved(voxels)}:
                numbers[-1] += 1
                turned, stays = (
                    {frozenset(places[v - 1] for v in face.vertices) for face in cells.faces}
                    for places in (_moved(points, order, signs), _moved(points))
                )
                checks.append(turned == stays)
    message = f"{', '.join(map(str, numbers))} symmetries of three bodies are symmetries of their hulls"
    return holds_if(all(checks) and numbers == [8, 4, 2], message)


def _moved(points: list[Point], order: tuple[int, ...] = (0, 1, 2), signs: tuple[int, ...] = (1, 1, 1)) -> list[Point]:
    """Return points turned about the middle of their box, in half units."""
    middle = [min(axis) + max(axis) for axis in zip(*points, strict=True)]
    turned = ([2 * p[k] - middle[k] for k in range(3)] for p in points)
    return [(signs[0] * p[order[0]], signs[1] * p[order[1]], signs[2] * p[order[2]]) for p in turned]


@claim("kovalevsky-schulz.96")
def symmetric_faces() -> Check:
    """Count the faces of the half-ball of diameter 10 that some rotation or reflection maps to themselves."""
    cells = _half_ball()
    symmetric = [_is_symmetric([cells.vertices[v - 1].point for v in face.vertices]) for face in cells.faces]
    return holds_if(all(symmetric), f"{sum(symmetric)} of {len(symmetric)} faces are symmetric")


def _is_symmetric(ring: list[Point]) -> bool:
    n = len(ring)
    sides = [minus(ring[(k + 1) % n], ring[k]) for k in range(n)]
    marks = [(dot(sides[k], sides[k]), dot(sides[k], sides[(k + 1) % n])) for k in range(n)]
    back = [(dot(sides[-k], sides[-k]), dot(sides[-k], sides[-k - 1])) for k in range(n)]
    turns = any(marks == marks[k:] + marks[:k] for k in range(1, n))
    return turns or any(marks == back[k:] + back[:k] for k in range(n))


def bounds(a: Point, b: Point) -> bool:
    """Return True if a cell bounds another, by topological coordinates."""
    return a != b and all(x == y or (y % 2 == 1 and abs(x - y) == 1) for x, y in zip(a, b, strict=True))


@claim("kovalevsky-schulz.101", "kovalevsky-schulz.110")
def bounding_relation() -> Check:
    """Check that bounding is antisymmetric and transitive for the cells of a voxel, and that incidence is not."""
    cells: list[Point] = [(x, y, z) for x in range(3) for y in range(3) for z in range(3)]
    pairs = {(a, b) for a in cells for b in cells if bounds(a, b)}
    partial = not any((b, a) in pairs for a, b in pairs)
    partial &= all((a, d) in pairs for a, b in pairs for c, d in pairs if b == c)
    apart = (0, 0, 0), (0, 0, 2)
    loose = (apart[0], (0, 0, 1)) in pairs and (apart[1], (0, 0, 1)) in pairs and apart not in pairs
    rising = all(sum(x % 2 for x in a) < sum(x % 2 for x in b) for a, b in pairs)
    return holds_if(partial and rising and loose, f"the 27 cells of a voxel have {len(pairs)} bounding pairs")
