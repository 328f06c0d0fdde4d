"""Compute each published result of Kovalevsky and Schulz, as lines worded like those in the paper.

The paper does not define its bodies exactly. The following definitions reproduce its numbers: the ball of diameter 32
is centred on a voxel, and the half-balls of Table 5 are centred on a corner of voxels. All hulls are hulls of the
voxels' corners. The tables and the 1404 triangles of the ball are reproduced only if local corners are found by 6
neighbours and coplanar faces count as invisible. The paper's text prefers 26 neighbours and visible faces.
"""

from collections.abc import Iterator, Sequence
from decimal import ROUND_HALF_UP, Decimal
from fractions import Fraction
from functools import cache

from modern.digital.solids import ball, half_ball
from modern.papers import Lines
from modern.papers.kovalevsky_schulz.cells import (
    CellList,
    cell_list_size,
    cube_triangles,
    edge_rows,
    face_rows,
    triangulation_size,
    vertex_rows,
)
from modern.papers.kovalevsky_schulz.hull import VoxelHull, voxel_hull
from modern.papers.kovalevsky_schulz.polyhedron import INVISIBLE, Coplanar, convex_polyhedron

# Four points in the arrangement of Fig. 4: points 1, 2, 3 run counterclockwise, and point 4 is behind them.
TETRAHEDRON = ((0, 0, 0), (0, 1, 0), (1, 0, 0), (0, 0, 1))


def produced(printed: Lines) -> Lines:
    """Return the lines of each published result that can be computed, by the result's id in ``results.toml``."""
    lines: dict[str, Sequence[str]] = dict(_ball(32))
    lines.update(_tetrahedron())
    lines["formula-5"] = [f"{_decimal(triangulation_size(1), 1)} integers for each triangle"]
    lines.update(_future_car(printed["future-car"][0], printed["table4-hull"][0]))
    lines.update((name, [_table_5_row(rows[0])]) for name, rows in printed.items() if name.startswith("table5-"))
    return lines


@cache
def hull_of_ball(diameter: int, coplanar: Coplanar) -> VoxelHull:
    return voxel_hull(ball(diameter), neighbours=6, coplanar=coplanar)


@cache
def half_ball_cells(diameter: int) -> CellList:
    """Return the cell list of the hull of a half-ball. As in Table 5, points on straight edges are vertices too."""
    return voxel_hull(half_ball(diameter), neighbours=6, coplanar=INVISIBLE).polyhedron.faces


def _ball(diameter: int) -> Iterator[tuple[str, Sequence[str]]]:
    hull = hull_of_ball(diameter, INVISIBLE)
    yield "ball-voxels", [f"diameter {diameter} contains {hull.voxels} voxels"]
    yield "ball-corners-6", [f"{hull.corners[6]} when testing 6 neighbors"]
    yield "ball-corners-26", [f"{hull.corners[26]} when testing 26 neighbors"]
    yield "ball-triangles", [f"diameter {diameter} contains {len(hull.polyhedron.triangles.faces)} triangles"]
    yield "ball-faces", [f"the hull contains only {len(hull.polyhedron.faces.faces)} faces"]


def _tetrahedron() -> Iterator[tuple[str, Sequence[str]]]:
    # Tables 1 to 3 print the cell list of the tetrahedron of Fig. 4, with symbols instead of coordinates.
    cells = convex_polyhedron(TETRAHEDRON)
    assert isinstance(cells, CellList)
    yield "table1", list(vertex_rows(cells, lambda number, _: f"(x_{number}, y_{number}, z_{number})"))
    yield "table2", list(edge_rows(cells))
    yield "table3", list(face_rows(cells))


def _future_car(surface: str, hull: str) -> Iterator[tuple[str, Sequence[str]]]:
    """Compute the paper's Table 4 from three of its printed counts, because only a picture of the body is known."""
    # Marching Cubes places one vertex in every outer voxel face. Formulas (5) and (6) give the numbers of integers.
    voxel_faces = int(surface.split()[-2])
    triangles = cube_triangles(voxel_faces)
    size = _decimal(triangulation_size(triangles), 0)
    yield "table4-triangulation", [f"MC-triangulation {triangles} ~{triangles // 2} {size}"]
    faces, vertices = map(int, hull.split()[2:4])
    yield "table4-hull", [f"convex hull {faces} {vertices} {cell_list_size(vertices, faces)}"]


def _table_5_row(printed: str) -> str:
    # The paper does not state how the bodies were digitised for Marching Cubes, so its triangles cannot be counted.
    diameter, triangles = map(int, printed.split()[:2])
    size = triangulation_size(triangles)
    cells = half_ball_cells(diameter)
    integers = cell_list_size(len(cells.vertices), len(cells.faces))
    per_face = _decimal(Fraction(integers, len(cells.faces)), 2)
    triangulation = f"{diameter} {triangles} {_decimal(size, 0)} {_decimal(size / triangles, 1)}"
    return f"{triangulation} {len(cells.faces)} {integers} {per_face}"


def _decimal(number: Fraction, decimals: int) -> str:
    exact = Decimal(number.numerator) / Decimal(number.denominator)
    return str(exact.quantize(Decimal(1).scaleb(-decimals), ROUND_HALF_UP))
