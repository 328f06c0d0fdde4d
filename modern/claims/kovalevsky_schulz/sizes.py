"""Checks of sections 4 and 5 of Kovalevsky and Schulz: sizes of cell lists and triangulations, and half-balls.

The half-balls are those of Table 5. The paper does not define how a half-ball is digitised.
"""

from fractions import Fraction
from itertools import chain, product

import numpy as np

from modern.claims.evidence import Check, claim, exhausted, exhibited, refuted, slip
from modern.claims.hulls import exact_hull
from modern.claims.invariants import HalfBall, corrected_print, half_balls, may_be_convex, numbers_in
from modern.claims.kovalevsky_schulz.polyhedra import polyhedron
from modern.claims.kovalevsky_schulz.proofs import size_of_triangulation
from modern.claims.published import PAPERS, results_of
from modern.claims.sampled_sets import Point
from modern.digital.solids import Volume, as_volume, half_ball
from modern.geometry.vectors import dot, minus
from modern.papers.kovalevsky_schulz import CENTRES, INVISIBLE, VERTICES, VISIBLE, local_corners, voxel_hull
from modern.papers.kovalevsky_schulz.cells import CellList, cell_list_size, economical_size, triangulation_size
from modern.papers.kovalevsky_schulz.hull import SHUFFLED, merged, straightened
from modern.papers.kovalevsky_schulz.results import half_ball_cells


@claim("kovalevsky-schulz.91")
def integers_per_face() -> Check:
    rows = [result.printed[0].split() for result in results_of(PAPERS[1]) if result.id.startswith("table5-")]
    quotients = [(int(row[6].replace(".", "")), Fraction(100 * int(row[5]), int(row[4]))) for row in rows]
    wrong = [(printed, exact) for printed, exact in quotients if printed != round(exact)]
    rounded_up = [int(exact) < printed == round(exact) for printed, exact in quotients]
    others = "".join(f"; {float(exact / 100):.4f} is printed as {printed / 100}" for printed, exact in wrong)
    is_truncated = [int(exact) for _, exact in wrong] == [printed for printed, _ in wrong]
    correction = ", ".join(str(round(exact) / 100) for _, exact in wrong)
    message = f"{len(rows) - len(wrong)} quotients are rounded, {sum(rounded_up)} of them up{others}"
    return slip(not wrong, is_truncated and any(rounded_up), correction, message)


@claim("kovalevsky-schulz.100")
def memory_requirements() -> Check:
    fewer, more = [], {}
    # Formula (6) gives the number V of vertices from the number of integers. A hull has 2 V - 4 triangles.
    for row in half_balls():
        own = triangulation_size(2 * int(row.corners) - 4)
        fewer.append(row.integers < row.triangle_integers)
        if row.integers > own:
            more[row.diameter] = f"{row.integers} integers against {own} for hull triangles at diameter {row.diameter}"
    printed = corrected_print("kovalevsky-schulz")
    car, triangles = (numbers_in(printed[name][0])[-1] for name in ("table4-hull", "table4-triangulation"))
    fewer.append(car < triangles)
    # Formula (6) is approximate. The hulls of the half-balls give the exact numbers.
    smaller = [economical_size(c) < triangulation_size(2 * len(c.vertices) - 4) for c in chain(*_bodies())]
    exact = {d: f"{economical_size(half_ball_cells(d))} integers at diameter {d}" for d in more}
    message = f"the cell list is smaller than the triangles of Marching Cubes in {sum(fewer)} of {len(fewer)} cases; "
    message += f"by formula (6), {', '.join(more.values())}; the cell lists themselves have {', '.join(exact.values())}"
    return exhibited(all(fewer) and all(smaller) and {*more} == {10, 18}, message)


def _bodies() -> tuple[list[CellList], list[CellList]]:
    bodies = [half_ball_cells(row.diameter) for row in half_balls()]
    return bodies, [straightened(cells) for cells in bodies]


def _size(cells: CellList) -> int:
    return cell_list_size(len(cells.vertices), len(cells.faces))


@claim("kovalevsky-schulz.84")
def integers_of_table_4() -> Check:
    faces, vertices, integers = numbers_in(corrected_print("kovalevsky-schulz")["table4-hull"][0])
    # Euler's formula gives the number of edges, each of which is on two faces.
    edges = vertices + faces - 2
    exact = 3 * vertices + 2 * edges
    counted = all(economical_size(c) == 3 * len(c.vertices) + 2 * len(c.edges) for c in chain(*_bodies()))
    check = exhibited(cell_list_size(vertices, faces) == integers, f"{integers} is the value of formula (6)")
    case = f"the cell list itself: {vertices} vertices and {faces} faces have {edges} edges and need {exact} integers"
    return check.unless(counted and integers not in (exact, exact + faces), case)


@claim("kovalevsky-schulz.80")
def vertices_of_a_face() -> Check:
    means = []
    for bodies in _bodies():
        points, faces = [sum(len(f.vertices) for f in c.faces) for c in bodies], [len(c.faces) for c in bodies]
        means.append((Fraction(sum(points), sum(faces)), sum(map(Fraction, points, faces)) / len(bodies)))
    texts = [f"{float(a):.2f} for all faces together, {float(b):.2f} for the half-balls' means" for a, b in means]
    f, v, _ = numbers_in(corrected_print("kovalevsky-schulz")["table4-hull"][0])
    message = f"mean number of points of a face: {texts[0]}; {2 * (v + f - 2) / f:.2f} for Table 4"
    check = exhibited(all(round(mean) == 5 for mean in means[0]), message)
    return check.unless(all(round(mean) != 5 for mean in means[1]), f"the mean number of vertices: {texts[1]}")


@claim("kovalevsky-schulz.78")
def formula_5() -> Check:
    octahedron = polyhedron([(x, y, z) for x, y, z in product((-1, 0, 1), repeat=3) if x * x + y * y + z * z == 1])
    triangles, size = len(octahedron.faces), 3 * (len(octahedron.vertices) + len(octahedron.faces))
    case = f"voxels without neighbours: octahedra of {triangles} triangles, each with {size} integers"
    return size_of_triangulation().check().unless(size > 1.1 * triangulation_size(triangles), case)


@claim("kovalevsky-schulz.81")
def formula_6() -> Check:
    groups = (*_bodies(), *([half_ball_cells(row.diameter)] for row in half_balls()))
    points, vertices, *alone = (sum(map(_size, group)) / sum(map(economical_size, group)) for group in groups)
    wrong = [f"{ratio:.2f}" for ratio in alone if abs(ratio - 1) > 0.1]
    check = exhibited(abs(points - 1) < 0.1, f"formula (6) gives {points:.3f} times the exact number of integers")
    case = f"the sum without points on edges ({vertices:.3f} times), and by {len(wrong)} of {len(alone)} half-balls "
    return check.unless(vertices > 1.1 and wrong, f"{case}({', '.join(wrong)} times)")


@claim("kovalevsky-schulz.157")
def edges_at_vertex() -> Check:
    pyramids = [polyhedron([*((k, k * k, 0) for k in range(n)), (0, 0, 1)]) for n in range(3, 21)]
    outcomes = [max(len(vertex.edges) for vertex in merged(p).vertices) == n for n, p in enumerate(pyramids, 3)]
    message = f"in {len(outcomes)} pyramids, the apex has as many edges as the base has sides"
    return exhausted("numbers of edges from 3 to 20", outcomes, message)


def _row(diameter: int) -> HalfBall:
    return next(row for row in half_balls() if row.diameter == diameter)


@claim("kovalevsky-schulz.86")
def diameter_8() -> Check:
    row = _row(8)
    possible = may_be_convex(int(row.corners), row.faces) or row.has_quarter_turns()
    # A list has 3 V + 2 E integers and, if the number of pairs of each face counts, F more; E = V + F - 2.
    constants = [2 * (row.faces - 2) + more for more in (0, row.faces)]
    exact = any((row.integers - constant) % 5 == 0 for constant in constants)
    message = f"formula (6) implies {row.corners} vertices, but {row.faces} faces allow at most {2 * row.faces - 4}; "
    message += "quarter turns permute all vertices except one in groups of 4; "
    message += f"a cell list of V vertices has {' or '.join(f'5 V + {constant}' for constant in constants)} integers"
    return refuted(not possible and not exact, message)


def _half_ball(diameter: int, *centre: int) -> Volume:
    """Return a half-ball; ``centre`` has twice the coordinates of its centre."""
    axis = np.arange(-diameter // 2, diameter // 2 + 1)
    x, y, z = ((2 * axis - c) ** 2 for c in centre)
    return as_volume((x[:, None, None] + y[:, None] + z <= diameter**2)[..., axis >= centre[2]])


@claim("kovalevsky-schulz.87", diameter=10)
@claim("kovalevsky-schulz.89", diameter=14)
@claim("kovalevsky-schulz.90", diameter=16)
@claim("kovalevsky-schulz.179", diameter=18)
@claim("kovalevsky-schulz.92", diameter=20)
@claim("kovalevsky-schulz.93", diameter=22)
def row_of_table_5(diameter: int) -> Check:
    row, cells = _row(diameter), half_ball_cells(diameter)
    hull = straightened(cells)
    agrees = (len(cells.faces), _size(cells)) == (row.faces, row.integers) and row.has_quarter_turns()
    message = f"{len(cells.faces)} faces and {len(cells.vertices)} points give {_size(cells)} integers by formula (6)"
    centres = (0, 1, 0), (0, 0, 0), (0, 0, 1), (1, 1, 0)
    moved = [voxel_hull(_half_ball(diameter, *o), VERTICES, 6, INVISIBLE).polyhedron.faces for o in centres]
    beside, *numbers = [(len(moved_cells.faces), _size(moved_cells)) for moved_cells in moved]
    message += ", and so does a half-ball centred between two voxels" if beside == (row.faces, row.integers) else ""
    case = "half-balls centred on a voxel, between two layers, and between four voxels of a layer, which have "
    case += f"{', '.join(f'{faces} faces and {integers} integers' for faces, integers in numbers)}"
    half, others = half_ball(diameter), {_size(hull)}
    inner = voxel_hull(half, CENTRES, 6, INVISIBLE).polyhedron.faces
    if _size(inner) != row.integers:
        case += f"; the voxels' centres: {len(inner.points)} points, {len(inner.faces)} faces, {_size(inner)} integers"
    if hull != cells:
        case += f"; the {len(hull.vertices)} vertices without points on edges, with {_size(hull)} integers; and 26 "
        ways = (26, INVISIBLE), (26, VISIBLE), (6, VISIBLE), (6, INVISIBLE, SHUFFLED)
        others |= {_size(voxel_hull(half, VERTICES, *way).polyhedron.faces) for way in ways}
        case += f"neighbours, visible coplanar faces, or one random order: at most {max(others)} integers"
    case += f"; the cell list itself has {economical_size(cells)} integers"
    is_formula = row.integers not in (economical_size(cells), economical_size(hull))
    refutes = (row.faces, row.integers) not in numbers and is_formula and (hull == cells or row.integers not in others)
    return exhibited(agrees, message).unless(refutes, case)


@claim("kovalevsky-schulz.88")
def diameter_12() -> Check:
    row, half = _row(12), _half_ball(12, 1, 1, 0)
    hull = exact_hull(local_corners(half, VERTICES))
    size = cell_list_size(len(hull.vertices), len(hull.facets))
    agrees = (len(hull.facets), size) == (row.faces, row.integers)
    message = f"{len(hull.facets)} faces and {len(hull.vertices)} vertices give {size} integers by formula (6)"
    others = half_ball_cells(12)
    cells = voxel_hull(half, neighbours=6, coplanar=INVISIBLE).polyhedron.faces
    exact = 3 * len(hull.vertices) + sum(len(facet.polygon) for facet in hull.facets)
    case = f"the half-ball centred on a corner of voxels, with {len(others.faces)} faces; points on straight edges: "
    case += f"{len(cells.vertices)} points and {_size(cells)} integers; and the cell list itself, with {exact} integers"
    refutes = len(others.faces) != row.faces and row.integers not in (exact, _size(cells))
    return exhibited(agrees, message).unless(refutes, case)


@claim("kovalevsky-schulz.96")
def symmetric_faces() -> Check:
    outcomes, asymmetric = [], {}
    for row in half_balls():
        points = half_ball_cells(row.diameter).points
        rings = [[points[k] for k in facet.polygon] for facet in exact_hull(points).facets]
        asymmetric[row.diameter] = sum(not _is_symmetric(ring) for ring in rings)
        total = min(points)[0] + max(points)[0]
        faces = {*map(frozenset, rings)}
        outcomes.append(faces == {frozenset((total - x, y, z) for x, y, z in face) for face in faces})
        outcomes.append(faces == {frozenset((y, x, z) for x, y, z in face) for face in faces})
    message = f"symmetries of a half-ball map faces to faces; {asymmetric[10]} faces at diameter 10 have no symmetry"
    return exhausted("reflections that generate the symmetries of the half-balls of Table 5", outcomes, message)


def _is_symmetric(ring: list[Point]) -> bool:
    moved = [way[k:] + way[:k] for way in (ring, ring[::-1]) for k in range(len(ring))]
    # The distances to two neighbouring corners determine a convex polygon.
    distances = [[dot(minus(p, q), minus(p, q)) for p, q in product(points[:2], points)] for points in moved]
    return distances.count(distances[0]) > 1
