"""The entry point of Butler's procedure (thesis chapter 3): from points to their hull, in any arithmetic."""

from dataclasses import dataclass, field, replace
from decimal import Decimal
from fractions import Fraction
from typing import Any, Literal

import numpy as np

from emulator.errors import ArgumentError, expect, quoted
from emulator.jit.functions import require_numba
from modern.geometry.hull import DETERMINED, ERROR, Hull, HullRefused
from modern.geometry.numbers import read_epsilon
from modern.geometry.points import Points
from modern.port.arithmetic import Arithmetic, RangeError, Scalar, Vector, at, less
from modern.port.fast import choose
from modern.port.growth import Progress, Stopped, grow
from modern.port.opening import Opening, mean, open_hull, tetrahedron
from modern.port.outcome import LINE, PLANE, coefficients, point_texts, polygon_edges, polyhedral_faces, stages, texts
from modern.port.points import first_of_equals, take
from modern.port.polygon import Polygon, projection, strike_between
from modern.port.polyhedron import Polyhedron, are_vertices, strike_repeats
from modern.port.table import Equations, PointTable, Slack, turned

Epsilon = str | int | float | Fraction | Decimal | np.integer[Any] | np.floating[Any] | None
OnRefusal = Literal["raise", "return"]


def convex_hull(
    points: Points,
    arithmetic: str = "exact",
    epsilon: Epsilon = None,
    translate: bool = False,
    history: bool = False,
    fast: bool | None = None,
    on_refusal: OnRefusal = "raise",
    text: bool = False,
) -> Hull:
    """Return the convex hull of points by Butler's procedure (thesis chapter 3; programs 1 to 3, chapter 5).

    :func:`hull1620.convex_hull` describes the parameters. ``epsilon`` is the tolerance e of the thesis's chapter 7 (p.
    117): the value of an equation at an input point counts as zero if it is from -e to +e. For ``"rel:E"``, e is E
    times the equation's largest coefficient A, B or C. ``translate`` moves the origin to the inside point C, so that
    the sign of the constant term decides how an equation is oriented (p. 118). If ``text`` is true, two steps follow
    the text of chapter 3 instead of the listing: the choice of the fourth point (p. 29), and the order in which planes
    are replaced if a point is outside several of them (p. 32). The corrections of the layer ``corrected`` are built in,
    and :attr:`Hull.corrected` names those that changed a step. Raise PointsError for invalid points, HullRefused if no
    hull was determined (unless ``on_refusal`` is ``"return"``), and RangeError if an intermediate result is too large
    for a float. Raise ArgumentError for any other invalid argument, and if kernels were requested and numba is missing.
    """
    expect(on_refusal, str, "on_refusal")
    if on_refusal not in ("raise", "return"):
        raise ArgumentError(f"on_refusal: expected 'raise' or 'return', found {quoted(on_refusal)}")
    if fast:
        require_numba()
    size = read_epsilon(epsilon)
    with np.errstate(over="raise", invalid="raise", divide="raise", under="ignore"):
        numbers, coordinates = take(points, arithmetic, wide=size is not None)
        try:
            progress = Progress([] if history else None)
            hull = _Run(numbers, coordinates, size, translate, fast, text, progress).hull()
        except FloatingPointError:
            raise RangeError(f"{arithmetic}: a product of coordinates exceeds the largest number") from None
    if on_refusal == "raise" and not hull.determined:
        raise HullRefused(hull)
    return hull


@dataclass
class _Run:
    """The arguments and the intermediate data of one call of :func:`convex_hull`."""

    arithmetic: Arithmetic
    coordinates: Vector
    epsilon: tuple[Fraction, bool] | None
    translate: bool
    fast: bool | None
    text: bool
    progress: Progress
    slack: Slack | None = field(init=False)
    result: Hull = field(init=False)

    def hull(self) -> Hull:
        numbers = self.arithmetic
        duplicates: tuple[tuple[int, int], ...] = ()
        if numbers.surely_distinct(self.coordinates):
            points = PointTable(self.coordinates.copy(), np.arange(self.coordinates.shape[1]))
        else:
            distinct, duplicates = first_of_equals(numbers.keys(self.coordinates))
            indices = np.array(distinct, dtype=np.int64)
            points = PointTable(self.coordinates[:, indices], indices)
        self.slack = Slack(numbers, *self.epsilon) if self.epsilon else None
        # Program 1 decides if the points are collinear, coplanar or solid, and punches the input of program 2 or 3.
        opening = open_hull(numbers, points, self.slack, self.text)
        self.result = Hull(
            arithmetic=numbers.name,
            status=DETERMINED,
            dimension={"point": 0, "segment": 1, "triangle": 2, "coplanar": 2}.get(opening.kind, 3),
            points=point_texts(numbers, self.coordinates),
            vertices=(),
            boundary=(),
            inside=(),
            duplicates=duplicates,
            statement=f"program1 {opening.label}",
            lines=tuple(coefficients(numbers, row, LINE) for row in opening.lines),
            plane=coefficients(numbers, opening.plane, PLANE) if opening.plane else None,
        )
        try:
            if opening.kind == "solid":
                return self.solid(points, opening)
            if opening.kind in ("coplanar", "triangle"):
                return self.coplanar(points, opening)
            if opening.kind == "error":
                return replace(self.result, status=ERROR, statement=opening.label)
        except Stopped as stop:
            return replace(self.finished(stop.label), status=stop.status)
        return replace(
            self.result, vertices=points.input_indices(slice(0, 2)), inside=points.input_indices(slice(2, None))
        )

    def solid(self, points: PointTable, opening: Opening) -> Hull:
        """Compute the hull of points in space: the end of program 1 (from statement 199 on), then program 3."""
        numbers, centre = self.arithmetic, opening.centre
        assert centre is not None
        self.result = replace(self.result, centre=texts(numbers, centre, (1, 1, 1)))  # type: ignore[arg-type]
        table = tetrahedron(numbers, points, self.slack)
        table.coefficients, through = turned(numbers, table.coefficients, centre)
        # Program 1 stops if C lies in a plane of H_1 (statements 204, 104).
        if through.any():
            raise Stopped(ERROR, "program1 104")
        test = self.move(points, centre)
        if self.translate:
            # If the origin is moved to C, the constant term of an equation becomes the equation's value at C.
            table.coefficients[3] = at(tuple(table.coefficients), centre)
        steps = choose(numbers, points, self.slack, False if self.text else self.fast)
        polyhedron = Polyhedron(numbers, points, table, test, self.progress, text=self.text)
        grow(polyhedron, steps.stage)
        self.move_back(points, table, centre)
        count = polyhedron.vertices
        # Statements 161 to 182 of program 3: strike boundary points, repeated equations, then vertices on fewer than
        # three planes.
        on = strike_repeats(table, steps.satisfied(table, points), len(points), self.progress)
        vertex = are_vertices(on, count, len(points))
        self.progress.boundary += points.input_indices(slice(count, None)) + points.input_indices(
            np.flatnonzero(~vertex[:count])
        )
        # If no vertex remains, the listing stops when it looks for the vertices of a plane (statement 199).
        result = self.finished("program3 212") if vertex.any() else replace(self.finished("program3 133"), status=ERROR)
        return replace(
            result,
            vertices=points.input_indices(np.flatnonzero(vertex)),
            faces=polyhedral_faces(points, table, on, vertex),
        )

    def coplanar(self, points: PointTable, opening: Opening) -> Hull:
        """Compute the hull of coplanar points: the end of program 1 (from statement 209 on), then program 2."""
        numbers = self.arithmetic
        assert opening.plane is not None
        projected_axis = projection(numbers, opening.plane)
        # Statements 211 to 216 of program 1: the coordinate that is projected away comes last.
        order = {1: [1, 2, 0], 2: [0, 2, 1], 3: [0, 1, 2]}[projected_axis]
        flat = PointTable(points.coordinates[order], points.input_index)
        centre = mean(numbers, flat, 3)[:2]
        if opening.kind == "triangle":
            return self.triangle(Polygon(numbers, flat, self.slack, centre, self.progress), projected_axis)
        test = self.move(flat, centre)
        polygon = Polygon(numbers, flat, self.slack, test, self.progress)
        grow(polygon)
        self.move_back(flat, polygon.table, centre)
        table, count = polygon.table, polygon.vertices
        self.progress.boundary += flat.input_indices(slice(count, None))
        corners = PointTable(flat.coordinates[:, :count], flat.input_index[:count])
        ends, gone = strike_between(numbers, table, corners, self.progress)
        on = table.satisfied(flat.coordinates)
        vertex = np.ones(count, np.bool_)
        vertex[gone] = False
        return replace(
            self.finished("program2 191"),
            vertices=corners.input_indices(np.flatnonzero(vertex)),
            faces=polygon_edges(flat, table, ends, on, projected_axis),
        )

    def triangle(self, polygon: Polygon, projected_axis: int) -> Hull:
        """Return the hull of exactly three points, for which program 1 alone is sufficient (statement 131)."""
        table, points = polygon.table, polygon.points
        on = list(table.defining.T)
        return replace(
            self.finished("program1 131"),
            vertices=points.input_indices(slice(None)),
            faces=polygon_edges(points, table, table.defining, on, projected_axis),
        )

    def finished(self, label: str) -> Hull:
        """Return the result decided at the statement ``label``, with the points and corrections recorded so far."""
        return replace(
            self.result,
            statement=label,
            boundary=tuple(self.progress.boundary),
            inside=tuple(self.progress.inside),
            corrected=tuple(self.progress.corrected),
            history=stages(self.progress.history) if self.progress.history else (),
        )

    def move(self, points: PointTable, centre: tuple[Scalar, ...]) -> tuple[Scalar, ...] | None:
        """Move the origin to the inside point C if ``translate`` is set.

        Return the point C, at which oriented equations are negative, or None if C is now the origin.
        """
        if not self.translate:
            return centre
        for axis, value in enumerate(centre):
            points.coordinates[axis] = points.coordinates[axis] - value
        return None

    def move_back(self, points: PointTable, table: Equations, centre: tuple[Scalar, ...]) -> None:
        """Move the origin back: restore points and constant terms.  Digits lost in the translation stay lost."""
        if not self.translate:
            return
        constant = table.coefficients[-1]
        for coefficient, value in zip(table.coefficients, centre, strict=False):
            constant = less(constant, coefficient * value)
        table.coefficients[-1] = constant
        for axis, value in enumerate(centre):
            points.coordinates[axis] = points.coordinates[axis] + value
