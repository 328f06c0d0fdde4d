"""The result of every hull of this project: one type for a point, a segment, a polygon and a polyhedron.

Points are referred to by their place in the input, counting from 0; a program's numbering of vertices is the
order of :attr:`Hull.vertices`.  Numbers are exact text: decimal strings, or fractions ``p/q`` where no finite
decimal exists; a binary float appears as the exact decimal of its value.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, SupportsIndex, TypeVar, overload

from emulator.errors import EmulatorError

DETERMINED = "determined"
NOT_ACCEPTABLE = "DATA NOT ACCEPTABLE"
ERROR = "ERROR IN PROGRAM"
TABLE_FULL = "table of planes is full"

Coefficients = tuple[str, str, str, str]
T = TypeVar("T")


class LazyTuple(Sequence[T]):
    """A tuple whose members are made when one is first asked for; their number is known before.  Equal to the tuple."""

    def __init__(self, count: int, make: Callable[[], Iterable[T]]) -> None:
        self._count = count
        self._make: Callable[[], Iterable[T]] | None = make
        self._made: tuple[T, ...] = ()

    def all(self) -> tuple[T, ...]:
        """The tuple itself."""
        if self._make is not None:
            self._made, self._make = tuple(self._make()), None
        return self._made

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, index: SupportsIndex) -> T: ...

    @overload
    def __getitem__(self, index: slice) -> tuple[T, ...]: ...

    def __getitem__(self, index: SupportsIndex | slice) -> T | tuple[T, ...]:
        return self.all()[index]

    def __iter__(self) -> Iterator[T]:
        return iter(self.all())

    def __eq__(self, other: object) -> bool:
        return self.all() == (other.all() if isinstance(other, LazyTuple) else other)

    def __hash__(self) -> int:
        return hash(self.all())

    def __repr__(self) -> str:
        return repr(self.all())

    def __reduce__(self) -> tuple[Any, ...]:
        return tuple, (self.all(),)


def as_tuple(members: Sequence[T]) -> tuple[T, ...]:
    """The tuple of them; no copy of what is one."""
    return members.all() if isinstance(members, LazyTuple) else tuple(members)


@dataclass(frozen=True, slots=True)
class Face:
    """A supporting plane A x + B y + C z + D = 0, or a supporting line of a polygon, outward as the thesis turns it.

    ``coefficients``: as the thesis scales them, products of coordinate differences of the defining points; of
    a line the coefficient of the coordinate projected away is 0 (thesis p. 16-17).  ``lowest``: the same
    equation in integers without common divisor, of the coefficients as they stand.  ``defining``: the points
    MM, NN, KK (of a line MM, NN) it was made from.  ``polygon``: the vertices on it in cyclic order,
    counterclockwise seen from outside; of a line its two vertices.  ``on``: every other point of the input
    on it.
    """

    coefficients: Coefficients
    lowest: tuple[int, int, int, int]
    defining: tuple[int, ...]
    polygon: tuple[int, ...]
    on: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class Stage:
    """One approximation H_j of the construction (thesis p. 8-9, 22-33).

    ``added``: the point that became a vertex (for H_1 the points it starts from); ``checked``: the number
    NETC of the equation it lay outside of, 0 for H_1; ``struck``: points found inside H_j and eliminated;
    ``equations``: the defining points of its equations, in order of the table; ``outside``: how many of the
    equations the new point lay outside of.
    """

    number: int
    added: tuple[int, ...]
    checked: int
    outside: int
    struck: tuple[int, ...]
    equations: tuple[tuple[int, ...], ...]


@dataclass(frozen=True, slots=True)
class Coplanar:
    """How faces of a hull were read as one (``modern.geometry.coplanar``).

    ``within``: the distance E.  ``faces``: how many the hull itself has.  ``deviation``: the largest distance of a
    vertex from the plane of the face it was joined to; ``beyond``: the distance from which on one more face would be
    joined, None where none could be.  Decimals, the last two to three digits, rounded up.
    """

    within: str
    faces: int
    deviation: str
    beyond: str | None = None


@dataclass(frozen=True, slots=True)
class Hull:
    """A convex hull as a procedure determined it in some arithmetic.

    ``status``: ``determined``, the message the programs end with, or ``table of planes is full`` where they
    would overrun their arrays; ``statement``: program and label of the listing that decided it.  ``dimension``
    0 to 3.  ``points``: the input as the arithmetic took it.  ``vertices``, ``boundary`` and ``inside``: points
    in the order the programs punch them (of a segment they punch the ends only; the points between are
    inside).  ``duplicates``: (point, the first point with the same coordinates); the thesis takes distinct
    points, so these are reported and left out.  ``plane``: the plane of a polygon, as punched; ``lines``: two
    equations a line, of a segment and of the three sides of three points; ``centre``: the point C of a
    polyhedron.
    """

    arithmetic: str
    status: str
    dimension: int
    points: Sequence[tuple[str, str, str]]
    vertices: tuple[int, ...]
    boundary: tuple[int, ...]
    inside: tuple[int, ...]
    duplicates: tuple[tuple[int, int], ...] = ()
    faces: Sequence[Face] = ()
    plane: Coefficients | None = None
    lines: tuple[Coefficients, ...] = ()
    centre: tuple[str, str, str] | None = None
    statement: str = ""
    corrected: tuple[str, ...] = ()
    """Corrections of the layer ``corrected`` that took a branch other than the listing's."""
    history: Sequence[Stage] = field(default=(), repr=False)
    coplanar: Coplanar | None = None
    """Where this is a reading of a hull with faces joined: how they were.  A face's vertices lie near to its plane."""

    @property
    def determined(self) -> bool:
        return self.status == DETERMINED


class HullRefused(EmulatorError):
    """An arithmetic in which the procedure came to no hull; ``result`` is what it came to, with its status."""

    def __init__(self, result: Any) -> None:
        super().__init__(
            f"no hull in {result.arithmetic}: {result.status}, decided at {result.statement}; "
            "'exact' always has one, on_refusal='return' gives the result as it is"
        )
        self.result = result
