"""Checks of the rows of Table 5 of Kovalevsky and Schulz, which lists hulls of half-balls.

The paper does not define how a half-ball is digitised.
"""

from itertools import product

from modern.claims.evidence import Check, claim, exhibited, refuted
from modern.claims.hulls import exact_hull
from modern.claims.invariants import HalfBall, half_balls, may_be_convex
from modern.claims.sampled_sets import Point
from modern.digital.solids import listed
from modern.geometry.vectors import dot, minus
from modern.papers.kovalevsky_schulz import INVISIBLE, VERTICES, local_corners, voxel_hull
from modern.papers.kovalevsky_schulz.cells import CellList, cell_list_size, economical_size
from modern.papers.kovalevsky_schulz.hull import straightened
from modern.papers.kovalevsky_schulz.results import half_ball_cells


def _row(diameter: int) -> HalfBall:
    return next(row for row in half_balls() if row.diameter == diameter)


def _size(cells: CellList) -> int:
    return cell_list_size(len(cells.vertices), len(cells.faces))


@claim("kovalevsky-schulz.86")
def diameter_8() -> Check:
    """Check that no half-ball has 324 integers and 30 faces: they violate Euler's formula and the quarter turns."""
    row = _row(8)
    possible = may_be_convex(int(row.corners), row.faces) or row.has_quarter_turns()
    message = f"(6) implies {row.corners} vertices with {row.faces} faces, which allow {2 * row.faces - 4}; "
    return refuted(not possible, f"{message}quarter turns move all vertices but one in groups of 4")


@claim("kovalevsky-schulz.87", diameter=10)
@claim("kovalevsky-schulz.89", diameter=14)
@claim("kovalevsky-schulz.90", diameter=16)
@claim("kovalevsky-schulz.179", diameter=18)
@claim("kovalevsky-schulz.92", diameter=20)
@claim("kovalevsky-schulz.93", diameter=22)
def row_of_table_5(diameter: int) -> Check:
    """Check that a row of Table 5 counts a half-ball centred on a corner of voxels, with points on straight edges.

    The number of integers is that of formula (6), and not that of the cell list.
    """
    row, cells = _row(diameter), half_ball_cells(diameter)
    hull = straightened(cells)
    agrees = (len(cells.faces), _size(cells)) == (row.faces, row.integers) and row.has_quarter_turns()
    message = f"{len(cells.faces)} faces and {len(cells.vertices)} points give {_size(cells)} integers by formula (6)"
    centred = len(half_ball_cells(diameter, "voxel").faces)
    case = f"a half-ball centred on a voxel, which has {centred} faces"
    if hull != cells:
        case += f", and the {len(hull.vertices)} vertices of the strict hull, which give {_size(hull)} integers"
    case += f"; the cell list itself has {economical_size(cells)} integers"
    is_formula = row.integers not in (economical_size(cells), economical_size(hull))
    refutes = centred != row.faces and is_formula and (hull == cells or _size(hull) != row.integers)
    return exhibited(agrees, message).unless(refutes, case)


@claim("kovalevsky-schulz.88")
def diameter_12() -> Check:
    """Check that a half-ball centred in a layer of voxels has the printed numbers, if only vertices count.

    The half-ball of the other rows, and points on straight edges as in the other rows, give other numbers.
    """
    row, around = _row(12), product(range(-5, 7), range(-5, 7), range(7))
    voxels = [(x, y, z) for x, y, z in around if (2 * x - 1) ** 2 + (2 * y - 1) ** 2 + (2 * z) ** 2 <= 12**2]
    hull = exact_hull(local_corners(listed(voxels), VERTICES))
    size = cell_list_size(len(hull.vertices), len(hull.facets))
    agrees = (len(hull.facets), size) == (row.faces, row.integers)
    message = f"{len(hull.facets)} faces and {len(hull.vertices)} vertices give {size} integers by formula (6)"
    others = half_ball_cells(12)
    cells = voxel_hull(listed(voxels), neighbours=6, coplanar=INVISIBLE).polyhedron.faces
    exact = 3 * len(hull.vertices) + sum(len(facet.polygon) for facet in hull.facets)
    case = f"the half-ball centred on a corner of voxels, which has {len(others.faces)} faces; points on straight "
    case += f"edges, with which {len(cells.vertices)} points give {_size(cells)} integers; and the cell list itself, "
    case += f"which has {exact}"
    refutes = len(others.faces) != row.faces and row.integers not in (exact, _size(cells))
    return exhibited(agrees, message).unless(refutes, case)


@claim("kovalevsky-schulz.96")
def symmetric_faces() -> Check:
    """Check that the hull of the half-ball of diameter 10, whose numbers are printed, has asymmetric faces."""
    points = [vertex.point for vertex in half_ball_cells(10).vertices]
    faces = exact_hull(points).facets
    asymmetric = sum(not _is_symmetric([points[k] for k in facet.polygon]) for facet in faces)
    return refuted(asymmetric > 0, f"{asymmetric} of {len(faces)} faces at the diameter 10 have no symmetry")


def _is_symmetric(ring: list[Point]) -> bool:
    n = len(ring)
    sides = [minus(ring[(k + 1) % n], ring[k]) for k in range(n)]
    marks = [(dot(sides[k], sides[k]), dot(sides[k], sides[(k + 1) % n])) for k in range(n)]
    back = [(dot(sides[-k], sides[-k]), dot(sides[-k], sides[-k - 1])) for k in range(n)]
    turns = any(marks == marks[k:] + marks[:k] for k in range(1, n))
    return turns or any(marks == back[k:] + back[:k] for k in range(n))
