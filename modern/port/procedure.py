"""The hull by the procedure of chapter 3, from points to result, in any arithmetic."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from decimal import Decimal
from fractions import Fraction
from typing import Any, Literal

import numpy as np

from modern.geometry.hull import DETERMINED, ERROR, Hull, HullRefused
from modern.geometry.numbers import real
from modern.port.arithmetic import Arithmetic, RangeError, Scalar, Vector
from modern.port.fast import choose
from modern.port.formulas import at, less
from modern.port.growth import Progress, Stopped
from modern.port.opening import Opening, mean, open_hull, tetrahedron
from modern.port.outcome import LINE, PLANE, Faces, Historian, coefficients, point_texts, texts
from modern.port.points import Points, first_of_equals, take
from modern.port.polygon import Polygon, projection, strike_between
from modern.port.polyhedron import Polyhedron, are_vertices, strike_repeats
from modern.port.table import Equations, Places, Slack, turned

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
    """The convex hull of points by Butler's procedure (thesis chapter 3; programs 1 to 3, chapter 5).

    points: three coordinates each, real numbers of any type (a float is the binary number it holds), decimal strings
    or fractions ``"p/q"``; or an array of shape (n, 3).
    arithmetic: ``exact``, ``float64``, ``float32``, ``mp:BITS``, ``truncating`` (the thesis's eight digits),
    ``ibm1962``, ``truncating:P``, ``guarded:P`` or ``rounding:P``.  epsilon: chapter 7's e (thesis p. 117): where a
    given point is put into an equation a value from -e to +e counts as zero; any real number, or ``"rel:E"``, E times
    the equation's largest coefficient A, B or C.  translate: the origin is moved to C and the constant terms tell how
    equations are turned (thesis p. 118).  history: the result tells every H_j.  fast: compiled kernels (numba, the
    extra ``fast``) for ``float64`` and ``float32``; None: where they are there and points are many.  The result is
    the same.  text: two steps that chapter 3 has otherwise than the listing, as chapter 3 has them (the fourth
    point, p. 29; the order of the planes a point is outside of, p. 32).

    What the layer ``corrected`` changes is built in; :attr:`Hull.corrected` names the rows that mattered.  Numbers
    that are rounded may end in a status other than ``determined``, as the programs do; on_refusal: ``raise`` an error
    then, or ``return`` the result with that status.

    Raises PointsError for invalid points; HullRefused where no hull was determined; ValueError for
    an unknown arithmetic, an invalid epsilon, or kernels asked for where numba is missing or cannot compile; RangeError
    where an intermediate result exceeds what floats hold.
    """
    if on_refusal not in ("raise", "return"):
        raise ValueError(f"on_refusal is 'raise' or 'return', not {on_refusal!r}")
    size = read_epsilon(epsilon)
    with np.errstate(over="raise", invalid="raise", divide="raise", under="ignore"):
        numbers, coordinates = take(points, arithmetic, wide=size is not None)
        try:
            hull = _Run(numbers, coordinates, size, translate, history, fast, text).hull()
        except FloatingPointError:
            raise RangeError(f"{arithmetic}: a product of coordinates exceeds the largest number") from None
    if on_refusal == "raise" and not hull.determined:
        raise HullRefused(hull)
    return hull


def read_epsilon(epsilon: Epsilon) -> tuple[Fraction, bool] | None:
    """An e and whether it is relative.  Raises ValueError."""
    if epsilon is None:
        return None
    relative = isinstance(epsilon, str) and epsilon.startswith("rel:")
    try:
        value = Fraction(real(epsilon.removeprefix("rel:") if isinstance(epsilon, str) else epsilon))
    except ValueError as error:
        raise ValueError(f"epsilon: {error}") from None
    if value < 0:
        raise ValueError("epsilon is negative")
    return value, relative


@dataclass
class _Run:
    """One hull on its way: the parts of the procedure put together."""

    arithmetic: Arithmetic
    given: Vector
    epsilon: tuple[Fraction, bool] | None
    translate: bool
    history: bool
    fast: bool | None
    text: bool
    watcher: Historian | None = field(init=False, default=None)
    progress: Progress = field(init=False, default_factory=Progress)
    slack: Slack | None = field(init=False)
    result: Hull = field(init=False)

    def hull(self) -> Hull:
        numbers = self.arithmetic
        duplicates: tuple[tuple[int, int], ...] = ()
        if numbers.surely_distinct(self.given):
            places = Places(self.given.copy(), np.arange(self.given.shape[1]))
        else:
            distinct, duplicates = first_of_equals(numbers.keys(self.given))
            names = np.array(distinct, dtype=np.int64)
            places = Places(self.given[:, names], names)
        self.slack = Slack(numbers, *self.epsilon) if self.epsilon else None
        opening = open_hull(numbers, places, self.slack, self.text)
        self.result = Hull(
            arithmetic=numbers.name,
            status=DETERMINED,
            dimension={"point": 0, "segment": 1, "triangle": 2, "coplanar": 2}.get(opening.kind, 3),
            points=point_texts(numbers, self.given),
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
                return self.solid(places, opening)
            if opening.kind in ("coplanar", "triangle"):
                return self.coplanar(places, opening)
            if opening.kind == "error":
                return replace(self.result, status=ERROR, statement=opening.label)
        except Stopped as stop:
            return replace(self.finished(stop.label), status=stop.status)
        return replace(self.result, vertices=places.names(slice(0, 2)), inside=places.names(slice(2, None)))

    def solid(self, places: Places, opening: Opening) -> Hull:
        """Programs 1 (199 on) and 3."""
        numbers, centre = self.arithmetic, opening.centre
        assert centre is not None
        self.result = replace(self.result, centre=texts(numbers, centre, (1, 1, 1)))  # type: ignore[arg-type]
        table = tetrahedron(numbers, places, self.slack)
        table.coefficients, through = turned(numbers, table.coefficients, centre)
        if through.any():
            raise Stopped(ERROR, "program1 104")
        test = self.move(places, centre)
        if self.translate:
            table.coefficients[3] = at(tuple(table.coefficients), centre)
        steps = choose(numbers, places, self.slack, False if self.text else self.fast)
        polyhedron = Polyhedron(numbers, places, table, test, self.progress, self.historian(places), text=self.text)
        polyhedron.run(steps.stage)
        self.move_back(places, table, centre)
        count = polyhedron.vertices
        on = strike_repeats(table, steps.satisfied(table, places), len(places), self.progress)
        vertex = are_vertices(on, count, len(places))
        self.progress.boundary += places.names(slice(count, None)) + places.names(np.flatnonzero(~vertex[:count]))
        # With no vertex left the listing finds no vertices of a plane (199).
        known = self.finished("program3 212") if vertex.any() else replace(self.finished("program3 133"), status=ERROR)
        return replace(
            known,
            vertices=places.names(np.flatnonzero(vertex)),
            faces=Faces(numbers, places).polyhedral(table, on, vertex),
        )

    def coplanar(self, places: Places, opening: Opening) -> Hull:
        """Programs 1 (209 on) and 2."""
        numbers = self.arithmetic
        assert opening.plane is not None
        kept = projection(numbers, opening.plane)
        order = {1: [1, 2, 0], 2: [0, 2, 1], 3: [0, 1, 2]}[kept]
        flat = Places(places.coordinates[order], places.who)
        centre = mean(numbers, flat, 3)[:2]
        if opening.kind == "triangle":
            return self.triangle(Polygon(numbers, flat, self.slack, centre, self.progress), kept)
        test = self.move(flat, centre)
        polygon = Polygon(numbers, flat, self.slack, test, self.progress, self.historian(flat))
        polygon.run()
        self.move_back(flat, polygon.table, centre)
        table, count = polygon.table, polygon.vertices
        self.progress.boundary += flat.names(slice(count, None))
        corners = Places(flat.coordinates[:, :count], flat.who[:count])
        ends, gone = strike_between(numbers, table, corners, self.progress)
        on = table.satisfied(flat.coordinates)
        vertex = np.ones(count, np.bool_)
        vertex[gone] = False
        return replace(
            self.finished("program2 191"),
            vertices=corners.names(np.flatnonzero(vertex)),
            faces=Faces(numbers, flat).edges(table, ends, on, kept),
        )

    def triangle(self, polygon: Polygon, kept: int) -> Hull:
        """Three points, which program 1 settles (131): its equations are :attr:`Hull.lines`, faces as of a polygon."""
        table, places = polygon.table, polygon.places
        on = list(table.defining.T)
        return replace(
            self.finished("program1 131"),
            vertices=places.names(slice(None)),
            faces=Faces(self.arithmetic, places).edges(table, table.defining, on, kept),
        )

    def finished(self, label: str) -> Hull:
        """The result with what the progress says."""
        return replace(
            self.result,
            statement=label,
            boundary=tuple(self.progress.boundary),
            inside=tuple(self.progress.inside),
            corrected=tuple(self.progress.corrected),
            history=self.watcher.stages if self.watcher else (),
        )

    def historian(self, places: Places) -> Historian | None:
        self.watcher = Historian(places) if self.history else None
        return self.watcher

    def move(self, places: Places, centre: tuple[Scalar, ...]) -> tuple[Scalar, ...] | None:
        """Move the origin to C if that is wanted; returns the point to turn equations by, None for the origin."""
        if not self.translate:
            return centre
        for axis, value in enumerate(centre):
            places.coordinates[axis] = places.coordinates[axis] - value
        return None

    def move_back(self, places: Places, table: Equations, centre: tuple[Scalar, ...]) -> None:
        """Points and constant terms for the origin as given; what the arithmetic cut of them stays lost."""
        if not self.translate:
            return
        constant = table.coefficients[-1]
        for coefficient, value in zip(table.coefficients, centre, strict=False):
            constant = less(constant, coefficient * value)
        table.coefficients[-1] = constant
        for axis, value in enumerate(centre):
            places.coordinates[axis] = places.coordinates[axis] + value
