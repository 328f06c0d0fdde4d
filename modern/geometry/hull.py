"""The data of a convex hull: one type for a point, a segment, a polygon and a polyhedron.

Points are identified by their index in the input, from 0.  Butler's programs number the vertices in the order of
:attr:`Hull.vertices`.  Numbers are exact text: decimals, or fractions ``p/q`` if the decimal expansion does not end.
The text of a binary float is the exact decimal of its value.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, SupportsIndex, TypeVar, overload

from emulator.errors import EmulatorError

DETERMINED = "determined"
NOT_ACCEPTABLE = "DATA NOT ACCEPTABLE"
ERROR = "ERROR IN PROGRAM"
TABLE_FULL = "table of planes is full"
NOT_CLOSED = "the faces do not form a closed surface"

Coefficients = tuple[str, str, str, str]
T = TypeVar("T")


class LazyTuple(Sequence[T]):
    """A sequence of known length, which is computed when it is first accessed.  It equals the tuple of its members."""

    def __init__(self, count: int, make: Callable[[], Iterable[T]]) -> None:
        self._count = count
        self._make: Callable[[], Iterable[T]] | None = make
        self._made: tuple[T, ...] = ()

    def all(self) -> tuple[T, ...]:
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
        return self._at(index)

    def _at(self, index: SupportsIndex | slice) -> T | tuple[T, ...]:
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


class LazyMembers(LazyTuple[T]):
    """A sequence of known length whose members are computed when they are first accessed."""

    def __init__(self, count: int, member: Callable[[int], T]) -> None:
        super().__init__(count, lambda: map(member, range(count)))
        self._member = member

    def _at(self, index: SupportsIndex | slice) -> T | tuple[T, ...]:
        if self._make is None:
            return self._made[index]
        if isinstance(index, slice):
            return tuple(map(self._member, range(self._count)[index]))
        return self._member(range(self._count)[index])


class PointTexts(LazyMembers[tuple[str, str, str]]):
    """A sequence of points whose coordinates are exact text, computed when they are accessed.

    ``floats`` returns a new array of the nearest doubles (n, 3).  ``numbers`` is the array of numbers that the texts
    denote, or None if the points do not come from an array.
    """

    def __init__(
        self, count: int, member: Callable[[int], tuple[str, str, str]], floats: Callable[[], Any], numbers: Any = None
    ) -> None:
        super().__init__(count, member)
        self.floats = floats
        self.numbers = numbers


class LazyFaces(LazyTuple["Face"]):
    """Faces of a hull that are computed on first access.  Their polygons are available without this computation."""

    def __init__(self, polygons: Sequence[tuple[int, ...]], make: Callable[[], "Iterable[Face]"]) -> None:
        super().__init__(len(polygons), make)
        self.polygons = polygons


def as_tuple(members: Sequence[T]) -> tuple[T, ...]:
    """Return a sequence as a tuple.  If it is a tuple already, it is not copied."""
    return members.all() if isinstance(members, LazyTuple) else tuple(members)


@dataclass(frozen=True, slots=True)
class Face:
    """A supporting plane A x + B y + C z + D = 0 of a polyhedron, or a supporting line of a polygon.

    The value of the equation is positive on the outer side.  ``coefficients`` are A, B, C and D as the thesis computes
    them, as sums of products of coordinates of the defining points.  The line of a polygon is computed without one of
    the coordinates x, y, z, whose coefficient is 0 (thesis p. 16-17).  ``lowest`` is the same equation in integers
    without a common divisor.  ``defining`` are the points MM, NN and KK (for a line MM and NN) from which the equation
    was computed.  ``polygon`` are the vertices on the plane in cyclic order, counterclockwise seen from outside.  A
    line has two vertices.  ``on`` are the other input points on the plane or line.
    """

    coefficients: Coefficients
    lowest: tuple[int, int, int, int]
    defining: tuple[int, ...]
    polygon: tuple[int, ...]
    on: tuple[int, ...] = ()


def polygons_of(faces: Sequence[Face]) -> Sequence[tuple[int, ...]]:
    """Return the polygon (vertex indices) of each face."""
    return faces.polygons if isinstance(faces, LazyFaces) else [face.polygon for face in faces]


@dataclass(frozen=True, slots=True)
class Stage:
    """One step in the construction of a hull: the polyhedron H_j after its j-th vertex was added (thesis p. 8-9,
    22-33).

    number: j.
    added: the point that became a vertex.  For H_1 these are its initial points.
    checked: the number of the equation that the point was found to be outside of (NETC in the listing), or 0 for H_1.
    outside: how many equations of the previous hull the added point is outside of.
    struck: the points inside H_j, which the procedure eliminates.
    equations: the defining points of each equation of H_j, in the order of the procedure's table of equations.
    """

    number: int
    added: tuple[int, ...]
    checked: int
    outside: int
    struck: tuple[int, ...]
    equations: tuple[tuple[int, ...], ...]


@dataclass(frozen=True, slots=True)
class Coplanar:
    """A description of how coplanar faces were joined (``modern.geometry.coplanar``).  All distances are decimals.

    within: the distance E.
    faces: the number of faces of the hull before joining.
    deviation: the largest distance of a vertex from the plane of its joined face, to three digits, rounded up.
    beyond: the smallest distance that would join one more face, to three digits, rounded up; or None.
    """

    within: str
    faces: int
    deviation: str
    beyond: str | None = None


@dataclass(frozen=True, slots=True)
class Hull:
    """A convex hull, or the incomplete result of a procedure that found none, as exact text.

    arithmetic: the name of the arithmetic.
    status: ``determined``, the message that the programs type, ``table of planes is full`` if the programs would
        write beyond their arrays, or ``the faces do not form a closed surface`` if epsilon merged too many faces.
    dimension: from 0 for a point to 3 for a polyhedron.
    points: the input as numbers of the arithmetic.
    vertices, boundary, inside: points in the order in which the programs punch them.  The programs punch only the ends
        of a segment.  The points between the ends belong to ``inside``.
    duplicates: pairs of a point and the first point with the same coordinates.  The thesis requires distinct points,
        so duplicates are reported and otherwise ignored.
    plane: the plane of a polygon, as program 1 punches it.
    lines: for a segment, two equations that define its line; for three points, two such equations for each side.
    centre: for a polyhedron the inside point C, the mean of the points of H_1.
    statement: the program and statement number in Butler's listing at which the status was decided.
    corrected: identifiers of the modern corrections that changed a branch of the listing.
    history: the approximations H_j, if the caller requested them.
    coplanar: a description of joined faces, or None.  The vertices of a joined face lie only near its plane.
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
    history: Sequence[Stage] = field(default=(), repr=False)
    coplanar: Coplanar | None = None

    @property
    def determined(self) -> bool:
        return self.status == DETERMINED


class HullRefused(EmulatorError):
    """Raised if a procedure finds no hull in its arithmetic; ``result`` holds the incomplete result and the reason."""

    def __init__(self, result: Any) -> None:
        way = "a smaller epsilon may find" if result.status == NOT_CLOSED else "'exact' always finds"
        super().__init__(
            f"no hull in {result.arithmetic}: {result.status}, decided at {result.statement}; "
            f"{way} a hull, and on_refusal='return' returns the incomplete result"
        )
        self.result = result
