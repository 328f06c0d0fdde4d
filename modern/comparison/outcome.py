"""One form for every hull, so that any two can be compared: points by place in the input, equations by scale.

An outcome's equations are for the coordinates as given: supporting planes of a polyhedron, or of a polygon its
supporting lines projected as the thesis projects them (p. 16-17: the coordinate dropped is the first with a
nonzero coefficient in the polygon's plane, its own coefficient in the line 0).  Everything is exact.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm

import numpy as np

from emulator.machine.endings import Ending
from modern.exact_hull import ExactHull
from modern.geometry.hull import DETERMINED, Coefficients, Face, Hull
from modern.geometry.numbers import exact_text
from modern.thesis.cards import CardHull, read_hull
from modern.thesis.job import HullRun

Vector = tuple[Fraction, ...]
Equation = tuple[Fraction, Fraction, Fraction, Fraction]

_STATUS = {"limit": "endless", "bounds": "out of bounds", "outside": "out of bounds", "undefined": "undefined value"}
"""The status a run's ending is; any other kind is its own name."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """What one route made of a point set.

    ``status`` is ``determined`` or why there is no hull; ``dimension`` -1 where the route does not say.
    ``strange`` counts points it names that are not in the input; ``faulty`` are equations of program 1, by number,
    that do not vanish at the points they are said to contain.  ``ending`` is that of a run which ended badly.
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


def places(points: Sequence[Vector]) -> dict[Vector, int]:
    """Coordinates to the first point that has them."""
    found: dict[Vector, int] = {}
    for index, point in enumerate(points):
        found.setdefault(tuple(point), index)
    return found


def from_cards(name: str, run: HullRun, points: Sequence[Vector]) -> Outcome:
    """The outcome of an emulated run, read from the cards its last program punched."""
    if run.refusal:
        return Outcome(name, run.refusal, -1)
    broken = next((step for step in run.steps if not step.result.ending.normal), None)
    if broken is not None:
        ending = broken.result.ending
        return Outcome(name, _STATUS.get(ending.kind, ending.kind), -1, ending=ending)
    return from_card_hull(name, run.final.name, read_hull(run.final.result.punched), points)


def from_card_hull(name: str, program: str, hull: CardHull, points: Sequence[Vector]) -> Outcome:
    """The outcome a hull on cards is, punched by ``program`` (a built-in's name) as the last of a complete run."""
    where = places(points)
    sets, strange = [], 0
    for group in (hull.vertices, hull.boundary, hull.inside):
        known = [where[point] for point in group if point in where]
        strange += len(group) - len(known)
        sets.append(frozenset(known))
    dimension = {"program2": 2, "program3": 3}.get(program, min(len(hull.vertices), 3) - 1)
    first = program not in ("program2", "program3")
    equations: list[Equation] = []
    if not first:
        equations = [_four(equation) for equation in hull.equations]
    faulty = _faulty(hull) if first else ()
    return Outcome(name, DETERMINED, dimension, sets[0], sets[1], sets[2], tuple(equations), strange, faulty)


def from_hull(name: str, hull: Hull) -> Outcome:
    """The outcome of the port."""
    equations = tuple(_four([Fraction(c) for c in face.coefficients]) for face in hull.faces)
    return Outcome(
        name,
        hull.status,
        hull.dimension,
        frozenset(hull.vertices),
        frozenset(hull.boundary),
        frozenset(hull.inside),
        equations if hull.dimension >= 2 else (),
    )


def from_judge(hull: ExactHull, points: Sequence[Vector]) -> Outcome:
    """The judge's outcome; of a polygon its edges as the lines the thesis would print, exactly."""
    if hull.dimension == 3:
        equations = [_four([Fraction(c) for c in hull.plane_of(facet)]) for facet in hull.facets]
    elif hull.dimension == 2:
        equations = _lines(hull, points)
    else:
        equations = []
    return Outcome(
        "judge",
        DETERMINED,
        hull.dimension,
        frozenset(hull.vertices),
        frozenset(hull.boundary),
        frozenset(hull.inside),
        tuple(equations),
    )


def as_hull(judged: ExactHull) -> Hull:
    """The judge's result in the form of the port's: equations as in ``from_judge``, everything as exact text.

    Points are in the order of the input, where the port has that of the programs; there are no labels, no C, no stages.
    """
    unit = judged.scale
    points = [tuple(Fraction(number, unit) for number in point) for point in judged.scaled]
    if judged.dimension == 3:
        polygons = [facet.polygon for facet in judged.facets]
    else:
        polygons = [*zip(judged.polygon, judged.polygon[1:] + judged.polygon[:1], strict=True)]
    equations = from_judge(judged, points).equations
    whole = [_whole(equation) for equation in equations]
    faces = tuple(
        Face(_texts(equation), integers, polygon[:3], polygon, on)
        for equation, integers, polygon, on in zip(equations, whole, polygons, _on(judged, whole), strict=True)
    )
    return Hull(
        arithmetic="exact",
        status=DETERMINED,
        dimension=judged.dimension,
        points=tuple((exact_text(x), exact_text(y), exact_text(z)) for x, y, z in points),
        vertices=judged.vertices,
        boundary=judged.boundary,
        inside=judged.inside,
        duplicates=judged.duplicates,
        faces=faces,
        plane=None if judged.plane is None else _texts([Fraction(c) for c in judged.plane_of(judged.plane)]),
    )


def _on(judged: ExactHull, planes: Sequence[Sequence[int]]) -> list[tuple[int, ...]]:
    """The boundary points on each plane or line (of the coordinates as given)."""
    if not judged.boundary:
        return [()] * len(planes)
    unit = judged.scale
    there = np.array([(*judged.scaled[index], unit) for index in judged.boundary], dtype=object)
    found = []
    for plane in planes:
        zero = np.flatnonzero(there @ np.array(plane, dtype=object) == 0)
        found.append(tuple(judged.boundary[place] for place in zero.tolist()))
    return found


def _whole(equation: Equation) -> tuple[int, int, int, int]:
    """The equation in integers without common divisor."""
    common = lcm(*(number.denominator for number in equation))
    a, b, c, d = (number.numerator * (common // number.denominator) for number in equation)
    divisor = gcd(a, b, c, d) or 1
    return a // divisor, b // divisor, c // divisor, d // divisor


def _texts(equation: Sequence[Fraction]) -> Coefficients:
    a, b, c, d = map(exact_text, equation)
    return a, b, c, d


def _four(equation: Sequence[Fraction]) -> Equation:
    a, b, c, d = equation
    return a, b, c, d


def _lines(hull: ExactHull, points: Sequence[Vector]) -> list[Equation]:
    """The edges of a polygon as projected lines, negative at the polygon's other vertices."""
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
    """The equations of program 1 that do not vanish at the points they are said to contain."""
    equations = hull.equations
    pairs = hull.satisfied or [((1, 2), number) for number in range(1, len(equations) + 1)]
    return tuple(
        number
        for named, number in pairs
        if number <= len(equations) and any(_value(equations[number - 1], hull.vertices[k - 1]) for k in named)
    )


def _value(equation: Sequence[Fraction], point: Vector) -> Fraction:
    """The left member of an equation at a point."""
    return sum((c * x for c, x in zip(equation, point, strict=False)), equation[3])
