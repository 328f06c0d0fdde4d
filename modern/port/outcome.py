"""From the procedure's numbers to the result: exact text, faces, and the stages of the construction."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cmp_to_key
from typing import SupportsIndex, overload

import numpy as np
from numpy.typing import NDArray

from modern.geometry.hull import Coefficients, Face, LazyTuple, Stage
from modern.geometry.numbers import Exact
from modern.port.arithmetic import Arithmetic, Scalar, Vector
from modern.port.table import Equations, Places

PLANE, LINE = (2, 2, 2, 3), (1, 1, 1, 2)
"""Degrees in the coordinates of A, B, C, D of a plane, and of a line's equation."""


def texts(arithmetic: Arithmetic, numbers: Sequence[Scalar], degrees: Sequence[int]) -> tuple[str, ...]:
    return tuple(arithmetic.text(number, degree) for number, degree in zip(numbers, degrees, strict=True))


def coefficients(arithmetic: Arithmetic, numbers: Sequence[Scalar], degrees: Sequence[int]) -> Coefficients:
    a, b, c, d = texts(arithmetic, numbers, degrees)
    return a, b, c, d


def lowest(values: Sequence[Exact]) -> tuple[int, int, int, int]:
    """The equation in integers without common divisor."""
    a, b, c, d = values
    common = math.lcm(a.denominator, b.denominator, c.denominator, d.denominator)
    if common != 1:
        a, b, c, d = (value * common for value in values)
    a, b, c, d = a.numerator, b.numerator, c.numerator, d.numerator
    divisor = math.gcd(a, b, c, d) or 1
    return a // divisor, b // divisor, c // divisor, d // divisor


@dataclass(frozen=True)
class Faces:
    """Makes faces: what they need of the points."""

    arithmetic: Arithmetic
    places: Places

    def whole_points(self, places: Sequence[int]) -> dict[int, IntPoint]:
        """Coordinates as integers in a common unit, exactly, by place."""
        rows = [self.arithmetic.exacts(row[places], 1) for row in self.places.rows]
        unit = math.lcm(*{value.denominator for row in rows for value in row})
        whole = [[value.numerator * (unit // value.denominator) for value in row] for row in rows]
        return dict(zip(places, zip(*whole, strict=True), strict=True))

    def polyhedral(self, table: Equations, on: list[NDArray[np.int64]], vertex: NDArray[np.bool_]) -> Sequence[Face]:
        """The faces of a polyhedron; ``on`` are the places that satisfy each plane, ``vertex`` tells vertices.

        They are made when asked for: places, table and the rest must stay as they are.
        """
        return LazyTuple(len(on), lambda: self._polyhedral(table, on, vertex))

    def _polyhedral(self, table: Equations, on: list[NDArray[np.int64]], vertex: NDArray[np.bool_]) -> list[Face]:
        arithmetic, who, is_vertex = self.arithmetic, self.places.who.tolist(), vertex.tolist()
        known = self.whole_points(np.flatnonzero(vertex).tolist())
        by_row = list(zip(table.coefficients, PLANE, strict=True))
        exact = list(zip(*(arithmetic.exacts(row, degree) for row, degree in by_row), strict=True))
        text = list(zip(*(arithmetic.texts(row, degree) for row, degree in by_row), strict=True))
        found = []
        for k, defining in enumerate(table.defining.T.tolist()):
            satisfied = on[k].tolist()
            corners = [place for place in satisfied if is_vertex[place]]
            others = [] if len(corners) == len(satisfied) else [place for place in satisfied if not is_vertex[place]]
            if len(corners) > 1:
                corners = [corners[i] for i in cyclic([known[place] for place in corners], exact[k][:3])]
            found.append(
                Face(
                    coefficients=text[k],
                    lowest=lowest(exact[k]),
                    defining=tuple([who[place] for place in defining]),
                    polygon=tuple([who[place] for place in corners]),
                    on=tuple([who[place] for place in others]),
                )
            )
        return found

    def edges(
        self, table: Equations, ends: NDArray[np.int64], on: list[NDArray[np.int64]], projection: int
    ) -> tuple[Face, ...]:
        """The lines of a polygon, ``ends`` the places of their vertices; the coordinate projected away gets 0."""
        found = []
        zero = self.arithmetic.number(0)
        for k, satisfied in enumerate(on):
            row = [table.coefficients[i, k] for i in range(3)]
            row.insert(projection - 1, zero)
            exact = [self.arithmetic.exact(value, degree) for value, degree in zip(row, LINE, strict=True)]
            found.append(
                Face(
                    coefficients=coefficients(self.arithmetic, row, LINE),
                    lowest=lowest(exact),
                    defining=self.places.names(table.defining[:, k]),
                    polygon=self.places.names(ends[:, k]),
                    on=self.places.names([place for place in satisfied.tolist() if place not in ends[:, k]]),
                )
            )
        return tuple(found)


class Historian:
    """Notes each H_j as it comes about; what it says is made when asked for."""

    def __init__(self, places: Places) -> None:
        self.places = places
        self._notes: list[tuple[tuple[int, ...], int, int, list[int], NDArray[np.int64]]] = []

    def __call__(self, table: Equations, added: tuple[int, ...], checked: int, outside: int, struck: list[int]) -> None:
        self._notes.append((added, checked, outside, struck, self.places.who[table.defining]))

    @property
    def stages(self) -> Sequence[Stage]:
        """The stages noted so far."""
        notes = self._notes.copy()
        return LazyTuple(len(notes), lambda: (_stage(number, *note) for number, note in enumerate(notes, 1)))


def _stage(
    number: int, added: tuple[int, ...], checked: int, outside: int, struck: list[int], names: NDArray[np.int64]
) -> Stage:
    return Stage(number, added, checked, outside, tuple(struck), tuple(map(tuple, names.T.tolist())))


class PointTexts(Sequence[tuple[str, str, str]]):
    """The points as the arithmetic took them, turned into text when asked for; equal to the tuple of them."""

    def __init__(self, arithmetic: Arithmetic, coordinates: Vector) -> None:
        self._arithmetic = arithmetic
        self._coordinates = coordinates

    def __len__(self) -> int:
        return int(self._coordinates.shape[1])

    def floats(self) -> NDArray[np.float64]:
        """The coordinates as they are, shape (n, 3); a copy."""
        return np.array(self._coordinates.T, np.float64, order="C")

    @overload
    def __getitem__(self, index: SupportsIndex) -> tuple[str, str, str]: ...

    @overload
    def __getitem__(self, index: slice) -> tuple[tuple[str, str, str], ...]: ...

    def __getitem__(self, index: SupportsIndex | slice) -> tuple[str, str, str] | tuple[tuple[str, str, str], ...]:
        if isinstance(index, slice):
            return tuple(self[k] for k in range(len(self))[index])
        x, y, z = texts(self._arithmetic, list(self._coordinates[:, index]), (1, 1, 1))
        return x, y, z

    def __eq__(self, other: object) -> bool:
        return tuple(self) == (tuple(other) if isinstance(other, PointTexts) else other)

    def __hash__(self) -> int:
        return hash(tuple(self))

    def __repr__(self) -> str:
        return repr(tuple(self))


def point_texts(arithmetic: Arithmetic, coordinates: Vector) -> Sequence[tuple[str, str, str]]:
    """The points as the arithmetic took them; of many floats, as text when asked for."""
    lazy = PointTexts(arithmetic, coordinates)
    return lazy if coordinates.dtype.kind == "f" else tuple(lazy)


IntPoint = tuple[int, int, int]


def cyclic(points: Sequence[IntPoint], normal: Sequence[Exact]) -> list[int]:
    """The order in which points of a plane stand around it, seen from where ``normal`` points counterclockwise.

    It begins with the first point.

    ``points`` are the corners of a convex polygon, exactly or nearly so: the order is that of the directions
    from the lowest corner, in the projection along the normal's largest component.
    """
    sizes: list[Exact] = [component if component > 0 else -component for component in normal]
    axis = sizes.index(max(sizes))
    u, v = ((1, 2), (2, 0), (0, 1))[axis]
    if normal[axis] < 0:
        u, v = v, u
    flat = [(p[u], p[v]) for p in points]
    if len(flat) == 3 and (turn := _turn(*flat)):
        return [0, 1, 2] if turn > 0 else [0, 2, 1]
    start = min(range(len(flat)), key=lambda k: flat[k])
    x0, y0 = flat[start]

    def compare(i: int, j: int) -> int:
        (x1, y1), (x2, y2) = flat[i], flat[j]
        turn = _turn(flat[start], flat[i], flat[j])
        if turn:
            return -1 if turn > 0 else 1
        return -1 if abs(x1 - x0) + abs(y1 - y0) < abs(x2 - x0) + abs(y2 - y0) else 1

    order = [start, *sorted((k for k in range(len(flat)) if k != start), key=cmp_to_key(compare))]
    first = order.index(0)
    return order[first:] + order[:first]


def _turn(p: tuple[int, int], q: tuple[int, int], r: tuple[int, int]) -> int:
    """Positive where the way from p by q to r turns left."""
    return (q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1])
