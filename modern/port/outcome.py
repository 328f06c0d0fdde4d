"""Convert the state of a finished run to its result: exact text, faces, and the history of the construction."""

from collections.abc import Sequence
from functools import cmp_to_key

import numpy as np
from numpy.typing import NDArray

from modern.geometry.hull import Coefficients, Face, LazyMembers, LazyTuple, PointTexts, Stage
from modern.geometry.numbers import Exact
from modern.geometry.vectors import lowest_equation, whole
from modern.port.arithmetic import Arithmetic, Scalar, Vector
from modern.port.growth import Grown
from modern.port.table import Equations, PointTable

# The degrees, in the coordinates, of A, B, C, D of a plane and of the equation of a line.
PLANE, LINE = (2, 2, 2, 3), (1, 1, 1, 2)


def texts(arithmetic: Arithmetic, numbers: Sequence[Scalar], degrees: Sequence[int]) -> tuple[str, ...]:
    return tuple(arithmetic.text(number, degree) for number, degree in zip(numbers, degrees, strict=True))


def coefficients(arithmetic: Arithmetic, numbers: Sequence[Scalar], degrees: Sequence[int]) -> Coefficients:
    a, b, c, d = texts(arithmetic, numbers, degrees)
    return a, b, c, d


On = list[NDArray[np.int64]]


def polyhedral_faces(points: PointTable, table: Equations, on: On, vertex: NDArray[np.bool_]) -> Sequence[Face]:
    """Return the faces of a polyhedron, computed on first access.  The arguments must not change afterwards."""
    return LazyTuple(len(on), lambda: _polyhedral(points, table, on, vertex))


def _polyhedral(points: PointTable, table: Equations, on: On, vertex: NDArray[np.bool_]) -> list[Face]:
    arithmetic, input_index, is_vertex = table.arithmetic, points.input_index.tolist(), vertex.tolist()
    # The vertices as integers in a common unit, keyed by point index.
    vertices = np.flatnonzero(vertex).tolist()
    rows = [arithmetic.exacts(row[vertices], 1) for row in points.rows]
    integer_points = dict(zip(vertices, whole(list(zip(*rows, strict=True)))[1], strict=True))
    by_row = list(zip(table.coefficients, PLANE, strict=True))
    exact = list(zip(*(arithmetic.exacts(row, degree) for row, degree in by_row), strict=True))
    text = list(zip(*(arithmetic.texts(row, degree) for row, degree in by_row), strict=True))
    faces = []
    for k, defining in enumerate(table.defining.T.tolist()):
        satisfied = on[k].tolist()
        corners = [index for index in satisfied if is_vertex[index]]
        boundary = [] if len(corners) == len(satisfied) else [index for index in satisfied if not is_vertex[index]]
        if len(corners) > 1:
            corners = [corners[i] for i in cyclic([integer_points[index] for index in corners], exact[k][:3])]
        faces.append(
            Face(
                coefficients=text[k],
                lowest=lowest_equation(exact[k]),
                defining=tuple([input_index[index] for index in defining]),
                polygon=tuple([input_index[index] for index in corners]),
                on=tuple([input_index[index] for index in boundary]),
            )
        )
    return faces


def polygon_edges(
    points: PointTable, table: Equations, ends: NDArray[np.int64], on: On, projection: int
) -> tuple[Face, ...]:
    """Return the sides of a polygon as faces.

    ``projection`` is the number of the coordinate along which the points were projected: 1 for x, 2 for y, 3 for z.
    The coefficient of this coordinate is 0.
    """
    arithmetic, faces = table.arithmetic, []
    for k, satisfied in enumerate(on):
        row = [table.coefficients[i, k] for i in range(3)]
        # The listing calls the projection KPROJ (statements 209 to 217).
        row.insert(projection - 1, arithmetic.number(0))
        exact = [arithmetic.exact(value, degree) for value, degree in zip(row, LINE, strict=True)]
        faces.append(
            Face(
                coefficients=coefficients(arithmetic, row, LINE),
                lowest=lowest_equation(exact),
                defining=points.input_indices(table.defining[:, k]),
                polygon=points.input_indices(ends[:, k]),
                on=points.input_indices([index for index in satisfied.tolist() if index not in ends[:, k]]),
            )
        )
    return tuple(faces)


def stages(history: Sequence[tuple[Grown, NDArray[np.int64]]]) -> Sequence[Stage]:
    """Return the steps of the construction (``Progress.history``) as stages, each of which is made when accessed."""

    def member(index: int) -> Stage:
        grown, defining = history[index]
        equations = tuple(map(tuple, defining.T.tolist()))
        return Stage(index + 1, grown.added, grown.checked, grown.outside, tuple(grown.eliminated), equations)

    return LazyMembers(len(history), member)


def point_texts(arithmetic: Arithmetic, coordinates: Vector) -> Sequence[tuple[str, str, str]]:
    """Return the coordinates of all points as text.  Floats are converted when they are accessed."""

    def member(index: int) -> tuple[str, str, str]:
        x, y, z = texts(arithmetic, list(coordinates[:, index]), (1, 1, 1))
        return x, y, z

    lazy = PointTexts(coordinates.shape[1], member, lambda: np.array(coordinates.T, np.float64, order="C"))
    return lazy if coordinates.dtype.kind == "f" else lazy.all()


IntPoint = tuple[int, int, int]


def cyclic(points: Sequence[IntPoint], normal: Sequence[Exact]) -> list[int]:
    """Return the corners of a polygon in counterclockwise order as seen from the tip of ``normal``.

    The first corner remains first. The corners are sorted by their direction from a start corner, in the projection
    along the largest component of the normal.
    """
    sizes: list[Exact] = [component if component > 0 else -component for component in normal]
    # Project along the largest component of the normal: the image is then farthest from degenerate.
    axis = sizes.index(max(sizes))
    u, v = ((1, 2), (2, 0), (0, 1))[axis]
    # Exchanging the axes reverses the orientation, so that counterclockwise stays counterclockwise.
    if normal[axis] < 0:
        u, v = v, u
    flat = [(p[u], p[v]) for p in points]
    # Most faces are triangles, for which one turn decides the order of the corners.
    if len(flat) == 3 and (turn := _turn(*flat)):
        return [0, 1, 2] if turn > 0 else [0, 2, 1]
    start = min(range(len(flat)), key=lambda k: flat[k])
    x0, y0 = flat[start]

    def compare(i: int, j: int) -> int:
        (x1, y1), (x2, y2) = flat[i], flat[j]
        turn = _turn(flat[start], flat[i], flat[j])
        if turn:
            return -1 if turn > 0 else 1
        # Points in the same direction from the start are ordered by their distance.
        return -1 if abs(x1 - x0) + abs(y1 - y0) < abs(x2 - x0) + abs(y2 - y0) else 1

    order = [start, *sorted((k for k in range(len(flat)) if k != start), key=cmp_to_key(compare))]
    first = order.index(0)
    return order[first:] + order[:first]


def _turn(p: tuple[int, int], q: tuple[int, int], r: tuple[int, int]) -> int:
    return (q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1])
