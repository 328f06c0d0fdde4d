"""Checks of the rows of Table 5 of Kovalevsky and Schulz, which lists hulls of half-balls.

The paper does not define how a half-ball is digitised. A *digitisation* makes four choices. In the plane, and
separately in height, the centre is a voxel or halfway between two. Points exactly at the radius belong to the
half-ball or not, and so does the layer through the centre.
"""

from collections.abc import Iterator
from itertools import product

import numpy as np

from modern.claims.evidence import Check, claim, exhibited, refuted
from modern.claims.invariants import HalfBall, half_balls, may_be_convex
from modern.claims.sampled_sets import Point
from modern.digital.solids import Volume
from modern.exact_hull import ExactHull, exact_hull
from modern.geometry.vectors import dot, minus
from modern.papers.kovalevsky_schulz import VERTICES, local_corners
from modern.papers.kovalevsky_schulz.cells import CellList, cell_list_size
from modern.papers.kovalevsky_schulz.hull import straightened
from modern.papers.kovalevsky_schulz.results import half_ball_cells


def digitisations(diameter: int) -> Iterator[Volume]:
    """Yield the different digitisations of a half-ball; coordinates are doubled, so that centres are integers."""
    side = np.arange(-diameter, diameter + 1)
    distinct: dict[bytes, Volume] = {}
    for plane, height, closed, lowest in product((0, 1), (0, 1), (True, False), (0, 1)):
        x, y, z = np.meshgrid(2 * side - plane, 2 * side - plane, 2 * side - height, indexing="ij")
        squares = x * x + y * y + z * z
        inside = (squares <= diameter**2) if closed else (squares < diameter**2)
        # The lowest layer goes through the centre or is the next above; or it is next to a centre between layers.
        array = inside & (z >= (2 * lowest if height == 0 else 1 - 2 * lowest))
        distinct.setdefault(array.tobytes(), Volume(array, (0, 0, 0)))
    yield from distinct.values()


def _row(diameter: int) -> HalfBall:
    return next(row for row in half_balls() if row.diameter == diameter)


def _size(cells: CellList) -> int:
    return cell_list_size(len(cells.vertices), len(cells.faces))


def _hull(volume: Volume) -> tuple[list[Point], ExactHull]:
    corners: list[Point] = [(int(x), int(y), int(z)) for x, y, z in local_corners(volume, VERTICES)]
    return corners, exact_hull(corners)


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
    """Check that a row of Table 5 has the counts of the half-ball whose centre is a corner of voxels."""
    row, cells = _row(diameter), half_ball_cells(diameter)
    hull = straightened(cells)
    agrees = (len(cells.faces), _size(cells)) == (row.faces, row.integers) and row.has_quarter_turns()
    check = exhibited(agrees, f"{len(cells.faces)} faces and {len(cells.vertices)} points need {_size(cells)} integers")
    if _size(hull) != row.integers:
        return check.unless(
            True, f"the {len(hull.vertices)} vertices of the strict hull, which need {_size(hull)} integers"
        )
    centred = len(half_ball_cells(diameter, "voxel").faces)
    return check.unless(centred != row.faces, f"a half-ball centred on a voxel, which has {centred} faces")


@claim("kovalevsky-schulz.88")
def diameter_12() -> Check:
    """Check that a digitisation other than that of the other rows has the printed counts of diameter 12."""
    row = _row(12)
    hulls = (hull for _, hull in map(_hull, digitisations(12)))
    sizes = ((len(hull.facets), cell_list_size(len(hull.vertices), len(hull.facets))) for hull in hulls)
    check = exhibited((row.faces, row.integers) in sizes, f"a digitisation has {row.faces} faces")
    faces = len(half_ball_cells(12).faces)
    return check.unless(faces != row.faces, f"the half-ball centred on a corner of voxels, which has {faces} faces")


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
