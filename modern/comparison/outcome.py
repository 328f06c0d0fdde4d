"""A common form for hulls of any origin (Butler's programs, modern procedures, exact hull), for comparing them.

Points are indices into the input.  Equations apply to the coordinates of the input.  The equations describe the
supporting planes of a polyhedron, or the supporting lines of a polygon projected as in the thesis (p. 16-17).  The
projection drops the first coordinate whose coefficient in the polygon's plane is not zero.  In the equations of the
lines, this coordinate has the coefficient 0.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from emulator.machine.endings import Ending
from modern.exact_hull import ExactHull
from modern.exact_hull.coordinates import Coordinates, Objects
from modern.exact_hull.planes import facet_planes
from modern.exact_hull.result import Facets
from modern.geometry.hull import DETERMINED, Coefficients, Face, Hull, LazyFaces, PointTexts
from modern.geometry.numbers import Exact, exact_text
from modern.geometry.vectors import lowest_equation
from modern.thesis.cards import CardHull, read_hull
from modern.thesis.job import HullRun

Vector = tuple[Fraction, ...]
Equation = tuple[Fraction, Fraction, Fraction, Fraction]

# The status for each kind of ending of a run.  A kind that is not listed here is itself the status.
_STATUS = {"limit": "endless", "bounds": "out of bounds", "outside": "out of bounds", "undefined": "undefined value"}


@dataclass(frozen=True, slots=True)
class Outcome:
    """The hull of a point set, computed in any way, in the form used for comparisons.  Points are input indices.

    ``status`` is ``determined``, or the reason why there is no hull. ``dimension`` is -1 if the hull is not determined.
    ``strange`` is the number of points in the result that are not in the input. ``faulty`` has the numbers, from 1, of
    the equations of program 1 that do not vanish at the points that they should contain. ``ending`` is the ending of a
    failed run.
    """

    name: str
    status: str
    dimension: int
    vertices: frozenset[int] = frozenset()
    boundary: frozenset[int] = frozenset()
    inside: frozenset[int] = frozenset()
    equations: tuple[Equation, ...] = ()
    strange: int = 0
    faulty: tuple[int, ...] = ()
    ending: Ending | None = None

    @property
    def determined(self) -> bool:
        return self.status == DETERMINED


def from_cards(name: str, run: HullRun, points: Sequence[Vector]) -> Outcome:
    if run.typed_refusal:
        return Outcome(name, run.typed_refusal, -1)
    failed = next((step for step in run.steps if not step.result.ending.normal), None)
    if failed is not None:
        ending = failed.result.ending
        return Outcome(name, _STATUS.get(ending.kind, ending.kind), -1, ending=ending)
    return from_card_hull(name, run.final.name, read_hull(run.final.result.punched), points)


def from_card_hull(name: str, program: str, hull: CardHull, points: Sequence[Vector]) -> Outcome:
    """Convert a hull that the built-in ``program`` punched on cards to an Outcome."""
    # The points are visited in reverse order, so that of several equal points the first one remains.
    indices = {tuple(point): index for index, point in reversed(list(enumerate(points)))}
    sets, strange = [], 0
    for group in (hull.vertices, hull.boundary, hull.inside):
        known = [indices[point] for point in group if point in indices]
        strange += len(group) - len(known)
        sets.append(frozenset(known))
    # Program 1 alone finds a hull of at most three points: a point, a segment or a triangle.
    dimension = {"program2": 2, "program3": 3}.get(program, min(len(hull.vertices), 3) - 1)
    is_program1 = program not in ("program2", "program3")
    equations = [] if is_program1 else [_four(equation) for equation in hull.equations]
    faulty = _faulty(hull) if is_program1 else ()
    return Outcome(name, DETERMINED, dimension, sets[0], sets[1], sets[2], tuple(equations), strange, faulty)


def from_hull(name: str, hull: Hull) -> Outcome:
    vertices, boundary, inside = map(frozenset, (hull.vertices, hull.boundary, hull.inside))
    faces = hull.faces if hull.dimension >= 2 else ()
    equations = tuple(_four([Fraction(c) for c in face.coefficients]) for face in faces)
    return Outcome(name, hull.status, hull.dimension, vertices, boundary, inside, equations)


def from_judge(hull: ExactHull, points: Sequence[Vector]) -> Outcome:
    """Convert an exact hull to an Outcome.  The edges of a polygon become lines in the projected plane."""
    if hull.dimension == 3:
        equations = [_four([Fraction(c) for c in hull.plane_of(facet)]) for facet in hull.facets]
    elif hull.dimension == 2:
        equations = _lines(hull, points)
    else:
        equations = []
    vertices, boundary, inside = map(frozenset, (hull.vertices, hull.boundary, hull.inside))
    return Outcome("judge", DETERMINED, hull.dimension, vertices, boundary, inside, tuple(equations))


def as_hull(judged: ExactHull) -> Hull:
    """Convert an exact hull to a Hull, the type that Butler's procedure returns.  Points keep their order.

    Numbers become exact text.  The texts of points, and the equations of a polyhedron, are computed on access.
    """
    scaled, scale = judged.scaled, judged.scale
    coordinates = scaled if isinstance(scaled, Coordinates) else Coordinates(scaled, scale)

    def text(index: int) -> tuple[str, str, str]:
        x, y, z = (exact_text(Fraction(number, scale)) for number in coordinates[index])
        return x, y, z

    return Hull(
        arithmetic="exact",
        status=DETERMINED,
        dimension=judged.dimension,
        points=PointTexts(len(coordinates), text, coordinates.floats),
        vertices=judged.vertices,
        boundary=judged.boundary,
        inside=judged.inside,
        duplicates=judged.duplicates,
        faces=_faces(judged, coordinates),
        plane=None if judged.plane is None else _texts(judged.plane_of(judged.plane)),
    )


def _faces(judged: ExactHull, coordinates: Coordinates) -> Sequence[Face]:
    if judged.dimension == 3:
        facets = judged.facets
        polygons = facets.polygons if isinstance(facets, Facets) else [facet.polygon for facet in facets]
        return LazyFaces(polygons, lambda: _polyhedral(judged, coordinates))
    polygons = [*zip(judged.polygon, judged.polygon[1:] + judged.polygon[:1], strict=True)]
    if judged.dimension < 2:
        return ()
    points = [tuple(Fraction(number, judged.scale) for number in point) for point in judged.scaled]
    equations = _lines(judged, points)
    reduced = [lowest_equation(equation) for equation in equations]
    boundary = np.array([(*judged.scaled[index], judged.scale) for index in judged.boundary], object).reshape(-1, 4)
    return tuple(
        Face(_texts(equation), integers, polygon, polygon, _on(judged, boundary @ np.array(integers, object)))
        for equation, integers, polygon in zip(equations, reduced, polygons, strict=True)
    )


def _polyhedral(judged: ExactHull, coordinates: Coordinates) -> Iterator[Face]:
    """Yield the faces of an exact polyhedron, with the boundary points on each."""
    on: dict[int, list[int]] = {}
    if judged.boundary:
        planes = facet_planes(coordinates, judged.facets)
        for rows, facets, signs in planes.near(np.array(judged.boundary)):
            for row, facet in zip(rows[signs == 0].tolist(), facets[signs == 0].tolist(), strict=True):
                on.setdefault(facet, []).append(judged.boundary[row])
    for number, facet in enumerate(judged.facets):
        plane, polygon = judged.plane_of(facet), facet.polygon
        yield Face(_texts(plane), plane, polygon[:3], polygon, tuple(on.get(number, ())))


def _on(judged: ExactHull, values: Objects) -> tuple[int, ...]:
    return tuple(judged.boundary[row] for row in np.flatnonzero(values == 0).tolist())


def _texts(equation: Sequence[Exact]) -> Coefficients:
    a, b, c, d = map(exact_text, equation)
    return a, b, c, d


def _four(equation: Sequence[Fraction]) -> Equation:
    a, b, c, d = equation
    return a, b, c, d


def _lines(hull: ExactHull, points: Sequence[Vector]) -> list[Equation]:
    """Return the equations of a polygon's edges, projected.  Each is negative at the vertices not on its edge."""
    assert hull.plane is not None
    drop = next(k for k in range(3) if hull.plane[k])
    u, v = (k for k in range(3) if k != drop)
    lines: list[Equation] = []
    ring = hull.polygon
    for first, second, third in zip(ring, ring[1:] + ring[:1], ring[2:] + ring[:2], strict=True):
        p, q, r = points[first], points[second], points[third]
        line = [Fraction(0)] * 4
        line[u], line[v] = p[v] - q[v], q[u] - p[u]
        line[3] = -(line[u] * p[u] + line[v] * p[v])
        turn = -1 if line[u] * r[u] + line[v] * r[v] + line[3] > 0 else 1
        lines.append(_four([turn * c for c in line]))
    return lines


def _faulty(hull: CardHull) -> tuple[int, ...]:
    equations = hull.equations
    pairs = hull.satisfied or [((1, 2), number) for number in range(1, len(equations) + 1)]
    return tuple(
        number
        for named, number in pairs
        if number <= len(equations) and any(_value(equations[number - 1], hull.vertices[k - 1]) for k in named)
    )


def _value(equation: Sequence[Fraction], point: Vector) -> Fraction:
    return sum((c * x for c, x in zip(equation, point, strict=False)), equation[3])
