"""Checks of Kovalevsky and Schulz: the algorithm, coplanar faces, and the cell list."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise, product

from modern.claims.evidence import Check, claim, exhibited, search, searched
from modern.claims.hulls import convex_polyhedron, exact_hull
from modern.claims.kovalevsky_schulz.voxels import SOLIDS, Voxels
from modern.claims.sampled_sets import CASES, SETS, Point, plane_value, sampled_sets
from modern.digital.hull import digital_hull
from modern.digital.solids import Volume, ball, listed
from modern.exact_hull import ExactHull
from modern.geometry.mesh import sides
from modern.geometry.vectors import independent
from modern.papers.kovalevsky_schulz import CENTRES, INVISIBLE, VERTICES, VISIBLE, expanded, reconstructed, voxel_hull
from modern.papers.kovalevsky_schulz.cells import CellList, Economical
from modern.papers.kovalevsky_schulz.coplanar import EXTENDED, QUADRANGLES, coplanar_hull
from modern.papers.kovalevsky_schulz.corners import Of, local_corners
from modern.papers.kovalevsky_schulz.hull import merged, straightened
from modern.papers.kovalevsky_schulz.polyhedron import Coplanar, CurrentPolyhedron

GRID: tuple[Point, ...] = tuple((x, y, z) for x, y, z in product(range(3), repeat=3))
PYRAMID: tuple[Point, ...] = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 2))
LARGER_PYRAMID = (*PYRAMID, (3, 3, 0))
# Points outside the sampled hulls, whose coordinates are at most 5.
OUTSIDE: tuple[Point, ...] = ((9, 1, 0), (-8, 3, 7))


def hulls(cases: int) -> tuple[tuple[tuple[Point, ...], ExactHull], ...]:
    return tuple((sampled.points, sampled.judge) for sampled in sampled_sets(3, cases))


def horizon(judge: ExactHull, new: Point) -> list[tuple[int, int]]:
    """Return the edges that belong to exactly one of the faces that are visible from a new point."""
    visible = [{*f.polygon} for f in judge.facets if plane_value(f.plane, new) > 0]
    return [edge for edge in judge.edges() if sum({*edge} <= face for face in visible) == 1]


def polygons(points: Sequence[Point]) -> list[tuple[int, ...]]:
    """Return the faces of the exact hull as sorted cycles of vertices."""
    return sorted(f.polygon for f in exact_hull(points).facets)


def polyhedron(points: object, coplanar: Coplanar = VISIBLE) -> CellList:
    cells = convex_polyhedron(points, coplanar)  # type: ignore[arg-type]
    assert isinstance(cells, CellList)
    return cells


@claim("kovalevsky-schulz.5", "kovalevsky-schulz.75", full=400)
def algorithm_against_judge(cases: int = CASES) -> Check:
    return either_treatment(cases).unless(len(independent(PYRAMID[:4])) < 4, "a square, which contains no tetrahedron")


@claim("kovalevsky-schulz.53", "kovalevsky-schulz.144", full=400)
def either_treatment(cases: int = CASES) -> Check:
    outcomes = []
    for points, judge in ((GRID, exact_hull(GRID)), *hulls(cases)):
        rings = [[points[k] for k in f.polygon] for f in judge.facets]
        for coplanar in (VISIBLE, INVISIBLE):
            straight = straightened(merged(polyhedron(points, coplanar)))
            at, faces = straight.points, straight.faces
            ways = [w for e in straight.edges for w in ((e.start, e.end, e.left), (e.end, e.start, e.right))]
            left = {(at[p - 1], at[q - 1]): {at[k - 1] for k in faces[n - 1].vertices} for p, q, n in ways}
            outcomes.append(left == {side: {*ring} for ring in rings for side in sides(ring)})
            outcomes.append({*straight.planes()} == {f.plane for f in judge.facets})
    message = f"the cell lists of a cubic grid and {cases} sets have the faces and edges of the exact hulls, whether "
    return searched(SETS[3], cases, outcomes, f"{message}coplanar faces count as visible or as invisible")


@claim("kovalevsky-schulz.35", full=400)
def any_order(cases: int = CASES) -> Check:
    outcomes = []
    for points, judge in hulls(cases):
        # The construction starts with the first four points of an order that are not coplanar.
        for order in (sorted(points), *(points[k:] + points[:k] for k in range(len(points)))):
            outcomes.append(exact_hull([order[k] for k in independent(order)]).dimension == 3)
            outcomes.append({*merged(polyhedron(order)).planes()} == {f.plane for f in judge.facets})
    message = f"in {len(outcomes) // 2} orders of points, the construction starts with a tetrahedron and gives the hull"
    check = searched(SETS[3], cases, outcomes, message)
    return check.unless(len(independent(PYRAMID[:4])) < 4, "a square, which contains no tetrahedron")


@claim("kovalevsky-schulz.127", "kovalevsky-schulz.169", "kovalevsky-schulz.77", full=400)
def growing_polyhedra(cases: int = CASES) -> Check:
    outcomes = []
    for points, _ in hulls(cases):
        # The first polyhedron is the hull of the points up to the first four that are not coplanar.
        parts = [points[:n] for n in range(1 + max(independent(points)), len(points) + 1)]
        outcomes += [{*polyhedron(p).planes()} == {f.plane for f in exact_hull(p).facets} for p in parts]
        outcomes += [plane_value(plane, p) <= 0 for part in parts for plane in polyhedron(part).planes() for p in part]
        for (before, cells), new in zip(pairwise(map(polyhedron, parts)), points[len(parts[0]) :], strict=True):
            outcomes += [plane_value(plane, p) <= 0 for plane in cells.planes() for p in before.points]
            outcomes.append(new in cells.points or all(plane_value(plane, new) <= 0 for plane in before.planes()))
    message = "each polyhedron is the intersection of its half-spaces and contains all earlier points and polyhedra; "
    return searched(SETS[3], cases, outcomes, f"{message}each new point becomes a vertex or is already inside")


@claim("kovalevsky-schulz.50", "yau-srihari.15", full=120)
def points_that_see_no_face(cases: int = 1) -> Check:
    outcomes, held = [], 0
    tested: list[Point] = [(x, y, z) for x, y, z in product((1, 4), repeat=3)]
    for (points, judge), point in product(hulls(cases), tested):
        unseen = max(plane_value(f.plane, point) for f in judge.facets) <= 0
        inside = point in points or len(points) not in exact_hull([*points, point]).vertices
        outcomes.append(unseen == inside)
        held += inside
    message = f"of {len(outcomes)} points with coordinates 1 or 4, exactly those in the hull ({held}) see no face"
    return searched(SETS[3], cases, [*outcomes, held], message)


@claim("kovalevsky-schulz.161", "kovalevsky-schulz.51", "kovalevsky-schulz.76", "yau-srihari.114", full=400)
def cells_removed(cases: int = CASES) -> Check:
    checks = []
    for (points, judge), new in product(hulls(cases), OUTSIDE):
        if any(plane_value(f.plane, new) == 0 for f in judge.facets):
            continue
        after = exact_hull([*points, new])
        # The invisible faces must remain, with a new triangle on each edge of the horizon.
        hidden = {frozenset(f.polygon) for f in judge.facets if plane_value(f.plane, new) < 0}
        triangles = {frozenset((*edge, len(points))) for edge in horizon(judge, new)}
        checks.append({frozenset(f.polygon) for f in after.facets} == hidden | triangles)
        checks.append({*after.vertices} == {v for h in hidden for v in h} | {len(points)})
        remaining_edges = {e for e in judge.edges() if any({*e} <= h for h in hidden)}
        checks.append({e for e in after.edges() if len(points) not in e} == remaining_edges)
    generator = replace(SETS[3], name=f"{SETS[3].name}, and two points outside unless they are in the plane of a face")
    message = f"{len(checks) // 3} points outside a hull replace the visible faces, with edges and vertices of only "
    return searched(generator, cases, checks, f"{message}these, by a triangle on each edge of exactly one of them")


@claim("kovalevsky-schulz.52")
def cube_visible_from_corner() -> Check:
    cube = [*product((0, 2), repeat=3)]
    judge, after = exact_hull(cube), exact_hull([*cube, (3, 3, 3)])
    visible = {f for f in judge.facets if plane_value(f.plane, (3, 3, 3)) > 0}
    edges = {frozenset(e) for e in judge.edges() if sum({*e} <= {*f.polygon} for f in visible) == 2}
    planes = {f.plane for f in judge.facets} - {f.plane for f in after.facets}
    removed = {*map(frozenset, judge.edges())} - {*map(frozenset, after.edges())}
    agrees = planes == {f.plane for f in visible} and removed == edges and len(planes) == 3
    return exhibited(agrees, f"{len(planes)} faces and {len(removed)} edges are removed")


@claim("kovalevsky-schulz.166")
def many_coplanar_triangles() -> Check:
    # A prism on twelve points of a circle of radius 5.
    circle = [(x, y) for x, y in product(range(-5, 6), repeat=2) if x * x + y * y == 25]
    cells = polyhedron([(x, y, z) for x, y in circle for z in (0, 1)])
    faces, in_base = len(merged(cells).faces), cells.planes().count((0, 0, -1, 0))
    message = f"a prism with {len(circle)} sides has {len(cells.faces)} triangles, {in_base} of them in each base"
    return exhibited(in_base == len(circle) - 2 == faces - 4, f"{message}; they are merged to {faces} faces")


@claim("kovalevsky-schulz.63", full=400)
def unmerged_triangles(cases: int = CASES) -> Check:
    lists = [polyhedron(points) for points in (GRID, *(points for points, _ in hulls(cases)))]
    outcomes = [{*cells.planes()} == {*merged(cells).planes()} for cells in lists]
    outcomes += [all(len(face.pairs) == 3 for face in cells.faces) for cells in lists]
    message = f"the hulls of a grid and {cases} sets consist of triangles, and merging them changes no plane"
    return searched(SETS[3], cases, outcomes, message)


@claim("kovalevsky-schulz.56", "kovalevsky-schulz.54")
def invisible_needs_fewer_faces() -> Check:
    before, after = (coplanar_hull(points, QUADRANGLES) for points in (PYRAMID, LARGER_PYRAMID))
    invisible, visible = after.created - before.created, _inserted(LARGER_PYRAMID)[0] - _inserted(PYRAMID)[0]
    in_base = polyhedron(LARGER_PYRAMID).planes().count((0, 0, -1, 0))
    passed = [*after.faces] == polygons(LARGER_PYRAMID) and after.larger > before.larger and invisible < visible
    message = f"a point adds {invisible} new faces to a pyramid if coplanar faces count as invisible, and {visible}, "
    return exhibited(passed and in_base > 1, f"{message}{in_base} of them in one plane, if they count as visible")


def _inserted(points: Sequence[Point]) -> tuple[int, int]:
    """Return the number of triangles created, and of faces tested, if coplanar faces count as visible."""
    simplex, tested = independent(points), 0
    current = CurrentPolyhedron(points, simplex, VISIBLE)
    for number in {*range(len(points))}.difference(simplex):
        tested += len(current.faces)
        if first := current.first_visible(number):
            current.extend(number, first)
    # The tetrahedron at the start has four faces.
    return current.last_face - 4, tested


@claim("kovalevsky-schulz.6")
def tests_of_all_voxels() -> Check:
    solid = ball(12)
    corners, voxels = (sorted(map(tuple, p.tolist())) for p in (local_corners(solid, CENTRES), solid.coordinates()))
    tests, pairs, more_tests = _inserted(corners)[1], 13 * len(voxels), _inserted(voxels)[1]
    message = f"the hull of a ball of {len(voxels)} voxels takes {pairs} tests of pairs and {tests} of faces if found "
    message += f"from the {len(corners)} local corners, but {more_tests} tests of faces if found from all voxels"
    return exhibited(tests + pairs < more_tests / 4, message)


@claim("kovalevsky-schulz.58")
def extended_faces() -> Check:
    extended = coplanar_hull(GRID, EXTENDED)
    message = f"the hull of a cubic grid of points is found by extending a face to a point {extended.extended} times"
    return exhibited([*extended.faces] == polygons(GRID) and extended.extended > 0, message)


@claim("kovalevsky-schulz.59", full=2_000)
def fewest_new_faces(cases: int = 3) -> Check:
    def has_fewest(solid: Voxels) -> bool:
        extended = coplanar_hull(solid, EXTENDED)
        fewest = min(coplanar_hull(solid, QUADRANGLES).created, _inserted(solid)[0])
        return [*extended.faces] == polygons(solid) and (extended.created < fewest) == (extended.extended > 0)

    message = "the hulls are exact; extending any face makes fewer new faces than Fig. 7 or visible coplanar faces"
    return search(SOLIDS, has_fewest, cases, message)


@claim("kovalevsky-schulz.60")
def point_in_two_planes() -> Check:
    faces = exact_hull([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]).facets
    coplanar = [{*f.polygon} for f in faces if plane_value(f.plane, (2, 0, 0)) == 0]
    passed = len(coplanar) == 2 and coplanar[0] & coplanar[1] == {0, 1}
    return exhibited(passed, f"{len(coplanar)} faces of a tetrahedron are coplanar with a point in line with an edge")


@claim("kovalevsky-schulz.55")
def quadrangles() -> Check:
    judge, new = exact_hull(PYRAMID), LARGER_PYRAMID[-1]
    (square,) = (f for f in judge.facets if plane_value(f.plane, new) == 0)
    visible = [{*f.polygon} for f in judge.facets if plane_value(f.plane, new) > 0]
    common = [side for side in sides(square.polygon) if any({*side} <= face for face in visible)]
    counts = Counter(end for side in common for end in side)
    ends, between = ({k for k, count in counts.items() if count == n} for n in (1, 2))
    merged_face = {*square.polygon} - between | {len(PYRAMID)}
    faces = polygons(LARGER_PYRAMID)
    outcomes = [len(ends) == len(common) == 2, merged_face in map(set, faces)]
    before, after = (coplanar_hull(points, QUADRANGLES) for points in (PYRAMID, LARGER_PYRAMID))
    outcomes += [after.larger == before.larger + 1, [*after.faces] == faces]
    corners = len(ends | between) + 1
    message = f"the new face has {corners} corners and shares {len(common)} successive edges with the square; "
    return exhibited(all(outcomes) and corners == 4, f"{message}P is joined to the {len(ends)} outer ends of these")


@claim("kovalevsky-schulz.163", treatment="invisible")
@claim("kovalevsky-schulz.165", treatment="extended")
def collinear_edges(treatment: str) -> Check:
    points = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0), (1, 1, 5), (8, 0, 0)]
    cells = merged(polyhedron(points, INVISIBLE))
    removed = {*cells.points} - {*straightened(cells).points}
    becomes = removed == {points[1]} if treatment == INVISIBLE else coplanar_hull(points, EXTENDED).straightened > 0
    passed = exact_hull(points).vertices == (0, 2, 3, 4, 5) and becomes
    return exhibited(passed, f"two edges at {points[1]} become collinear, so that this point is no longer a vertex")


@claim("kovalevsky-schulz.44", "kovalevsky-schulz.160", full=1_000)
def economical_encoding(cases: int = 4) -> Check:
    def returns(solid: Voxels) -> bool:
        cells, judge = polyhedron(solid), exact_hull(solid)
        # The cell list of triangles, and that of the faces of the hull, which have any number of vertices.
        numbers = {k: number for number, k in enumerate(judge.vertices, 1)}
        cycles = tuple(tuple(numbers[k] for k in facet.polygon) for facet in judge.facets)
        edges = expanded(Economical(tuple(solid[k] for k in judge.vertices), cycles)).edges
        hull_edges = {frozenset((numbers[a], numbers[b])) for a, b in judge.edges()}
        on_both_faces = all({e.start, e.end} <= {*cycles[e.left - 1]} & {*cycles[e.right - 1]} for e in edges)
        is_restored = _incidences(expanded(cells.economical())) == _incidences(cells)
        return is_restored and on_both_faces and {frozenset((e.start, e.end)) for e in edges} == hull_edges

    message = "all edges and the two faces of each follow from the faces' vertices, for triangles and for merged faces"
    return search(SOLIDS, returns, cases, message)


def _incidences(cells: CellList) -> tuple[set[tuple[int, ...]], list[set[int]]]:
    """Return (start, end, left face, right face) of each edge in both directions, and the neighbours of each vertex."""
    edges = {(e.start, e.end, e.left, e.right) for e in cells.edges}
    ends = {sign * k: end for k, e in enumerate(cells.edges, 1) for sign, end in ((-1, e.end), (1, e.start))}
    return edges | {(q, p, b, a) for p, q, a, b in edges}, [{ends[k] for k in v.edges} for v in cells.vertices]


def _restored(voxels: object, of: Of) -> list[list[int]]:
    """Return the voxels that the program reconstructs from the cell list of a solid's hull."""
    hull = voxel_hull(listed(voxels), of)  # type: ignore[arg-type]
    restored: list[list[int]] = reconstructed(hull.polyhedron.straight.economical(), of).coordinates().tolist()
    return restored


@claim("kovalevsky-schulz.46", of=VERTICES, full=500)
@claim("kovalevsky-schulz.99", of=CENTRES, full=500)
def reconstruction(of: Of, cases: int = 2) -> Check:
    def restores(solid: Voxels) -> bool:
        volume = listed(solid)
        filled: list[list[int]] = Volume(digital_hull(volume).filled, volume.origin).coordinates().tolist()
        return _restored(solid, of) == filled == _restored(filled, of)

    message = "from the cell list of a solid's hull, the program restores exactly the voxels in the hull"
    return search(SOLIDS, restores, cases, message)
