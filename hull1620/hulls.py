"""Hulls for a Python program: numpy arrays in and out, exact volume and area, pictures and files."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from functools import cached_property
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from emulator.files import write_text
from emulator.language.cards import Deck
from emulator.machine.result import Options
from modern import exact_hull as judge
from modern import port
from modern.comparison.outcome import as_hull
from modern.drawing.draw import Labels, Show, draw_svg
from modern.edition import programs
from modern.exact_hull.coordinates import Points
from modern.exact_hull.coordinates import read_points as exact_points
from modern.exact_hull.result import Certificate
from modern.formats import deck as decks
from modern.formats.export import to_trimesh, write_hull
from modern.formats.points import read_input
from modern.geometry.coplanar import coplanar, distance_text
from modern.geometry.hull import Face, HullRefused, Stage, as_tuple
from modern.geometry.hull import Hull as Record
from modern.geometry.mesh import ExportError, Mesh, mesh
from modern.geometry.numbers import AREA_DIGITS, coordinates, exact_text, real, sum_of_roots
from modern.geometry.vectors import Vector, six_volumes
from modern.port.outcome import PointTexts
from modern.port.procedure import Epsilon, OnRefusal
from modern.thesis import job
from modern.thesis.job import HullRun

_KINDS = ("point", "segment", "polygon", "polyhedron")

Path = str | os.PathLike[str]
Floats = NDArray[np.float64]
Places = NDArray[np.intp]
Array = TypeVar("Array", bound=NDArray[Any])


@dataclass(frozen=True, repr=False)
class Hull:
    """A convex hull.  Points are named by their place in the input, from 0.

    record: everything as exact text (:class:`modern.geometry.hull.Hull`), which the attributes below are views of.
    certificate: what was counted while the hull was proved; only ``exact_hull`` has one.

    Arrays are of doubles, each number the nearest one, and cannot be written to.
    """

    record: Record
    certificate: Certificate | None = None

    @property
    def arithmetic(self) -> str:
        """The arithmetic the hull was found in."""
        return self.record.arithmetic

    @property
    def status(self) -> str:
        """``determined``, or the message the programs end with."""
        return self.record.status

    @property
    def determined(self) -> bool:
        """Whether there is a hull."""
        return self.record.determined

    @property
    def statement(self) -> str:
        """Program and label of the listing that decided the status; empty from ``exact_hull``."""
        return self.record.statement

    @property
    def dimension(self) -> int:
        """0 point, 1 segment, 2 polygon, 3 polyhedron."""
        return self.record.dimension

    @property
    def faces(self) -> tuple[Face, ...]:
        """The faces of a polyhedron or lines of a polygon: exact equations, vertices in order, other points on them."""
        return as_tuple(self.record.faces)

    @property
    def duplicates(self) -> tuple[tuple[int, int], ...]:
        """(point, the first point with the same coordinates)."""
        return self.record.duplicates

    @property
    def history(self) -> tuple[Stage, ...]:
        """The approximations H1, H2, ..., where ``convex_hull`` was asked for them."""
        return as_tuple(self.record.history)

    @property
    def corrected(self) -> tuple[str, ...]:
        """Rows of the layer ``corrected`` that took a branch other than the listing's."""
        return self.record.corrected

    @cached_property
    def points(self) -> Floats:
        """The points as the arithmetic took them, shape (n, 3)."""
        given = self.record.points
        if isinstance(given, PointTexts):
            return _fixed(given.floats())
        return _fixed(np.array([[_float(text) for text in point] for point in given], np.float64).reshape(-1, 3))

    @property
    def exact_points(self) -> tuple[Vector, ...]:
        """The points as fractions."""
        return tuple(coordinates(point) for point in self.record.points)

    @cached_property
    def vertices(self) -> Places:
        """The points that are vertices, in the order of the procedure; from ``exact_hull`` sorted."""
        return _fixed(np.array(self.record.vertices, np.intp))

    @cached_property
    def boundary(self) -> Places:
        """The points on the hull that are no vertices."""
        return _fixed(np.array(self.record.boundary, np.intp))

    @cached_property
    def inside(self) -> Places:
        """The points inside the hull (of a polygon within its plane, of a segment between its ends)."""
        return _fixed(np.array(self.record.inside, np.intp))

    @cached_property
    def simplices(self) -> Places:
        """The faces cut into triangles, shape (m, 3), counterclockwise seen from outside; as scipy's ConvexHull.

        Of a polygon its triangles, of a segment or a point none.  Raises ExportError where there is no hull.
        """
        triangles = np.array(self._mesh.triangles(), np.intp).reshape(-1, 3)
        return _fixed(self.vertices[triangles])

    @cached_property
    def equations(self) -> Floats:
        """For each of ``simplices`` the unit normal, outward, and the offset: normal @ x + offset <= 0 inside.

        ``faces`` has the equations exactly.  Raises ExportError where there is no hull.
        """
        rows: list[Floats] = []
        for (a, b, c, d), polygon in zip(self._mesh.planes(self.record), self._mesh.faces, strict=True):
            # Scaled by the largest exactly: no product of doubles can overflow.
            largest = max(abs(a), abs(b), abs(c)) or Fraction(1)
            row = np.array([float(number / largest) for number in (a, b, c, d)])
            rows += [row / (np.linalg.norm(row[:3]) or 1.0)] * (len(polygon) - 2)
        return _fixed(np.array(rows, np.float64).reshape(-1, 4))

    @cached_property
    def volume(self) -> Fraction:
        """The volume, exactly; 0 of what is flat.

        Raises ExportError where there is no hull or, found in rounded numbers, its faces do not close.
        """
        surface = self._closed
        return six_volumes(surface.numbers(), surface.faces) / 6 if self.dimension == 3 else Fraction(0)

    @cached_property
    def area(self) -> Decimal:
        """The area of the surface to 50 digits (``AREA_DIGITS``), a sum of square roots; of a polygon its one side.

        It is exact where every face's area is a decimal of no more digits; ``squared_areas`` are exact always.  Raises
        as ``volume``.
        """
        return sum_of_roots(self.squared_areas, AREA_DIGITS)

    @cached_property
    def squared_areas(self) -> tuple[Fraction, ...]:
        """The square of each face's area, exactly, in the order of ``faces``; of a polygon its one."""
        return self._closed.squared_areas()

    def coplanar(self, within: Any) -> Hull:
        """A reading of the hull with faces joined whose vertices lie within a distance of one plane.

        within: the distance, any real number, decimal text or a fraction ``"p/q"``; ``modern.geometry.coplanar`` says
        which faces are joined.  ``record.coplanar`` of the result says how many there were, how far a vertex is off its
        plane at the most, and from which distance on more would be joined.  What is flat is given back as it is.

        The hull itself stays exact.  Of the reading ``equations`` are those of the largest face of each joined one, and
        ``volume`` and ``area`` are those of the reading, cut into triangles.  Raises ExportError for a distance that is
        none, or too large for this solid.
        """
        return Hull(coplanar(self.record, within)[0])

    def draw(
        self,
        eye: Sequence[Any] | None = None,
        title: str = "",
        width: int | None = None,
        labels: Labels = "programs",
        hidden: bool = True,
        others: bool = True,
    ) -> str:
        """A picture as the text of an SVG file, hidden edges dashed; see :func:`modern.drawing.draw.draw_svg`.

        eye: the direction to the eye, three numbers.  labels: number the vertices as the ``programs`` do, by their
        places in the ``input``, or ``none``.  hidden: draw hidden edges.  others: draw points that are no vertices.
        Raises ExportError, and ValueError for an eye of no numbers.
        """
        direction = None if eye is None else [Fraction(real(number)) for number in eye]
        if direction is not None and len(direction) != 3:
            raise ExportError(f"the direction of view is {len(direction)} numbers; it has three")
        return draw_svg(self.record, direction, title, width, Show(labels, hidden, others))

    def save(self, path: Path, digits: int | None = None) -> None:
        """Write the hull to a file, by the ending of its name: .off .obj .ply .stl .json, or .svg for the picture.

        digits: significant digits to round those coordinates to that have no finite decimal; None refuses them.
        Raises ExportError, FileError.
        """
        name = os.fspath(path)
        if name.lower().endswith(".svg"):
            write_text(name, self.draw())
        else:
            write_hull(self.record, name, digits=digits)

    def to_trimesh(self) -> Any:
        """A ``trimesh.Trimesh`` (extra ``mesh``).  Raises ExportError."""
        return to_trimesh(self.record)

    def __repr__(self) -> str:
        count, arithmetic = len(self.record.points), self.arithmetic
        if not self.determined:
            return f"<no hull: {self.status} at {self.statement}; {count} points, {arithmetic}>"
        faces = f", {len(self.faces)} {'faces' if self.dimension == 3 else 'lines'}" if self.faces else ""
        vertices = f"{len(self.record.vertices)} {'vertices' if self.dimension else 'vertex'}"
        read = self.record.coplanar
        within = "" if read is None else f", coplanar within {distance_text(Fraction(read.within))}"
        return f"<hull: {_KINDS[self.dimension]}, {vertices}{faces}; {count} points, {arithmetic}{within}>"

    def _repr_svg_(self) -> str | None:
        return self.draw() if self.determined else None

    @cached_property
    def _mesh(self) -> Mesh:
        return mesh(self.record)

    @cached_property
    def _closed(self) -> Mesh:
        """The mesh, of a polyhedron with every edge between two faces that run along it in opposite ways."""
        if self.dimension == 3 and not self._mesh.closed:
            raise ExportError(f"the faces found in {self.arithmetic} do not close to a surface")
        return self._mesh


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
    """The convex hull of points by Butler's procedure of 1963, in any arithmetic.

    See :func:`modern.port.procedure.convex_hull` for what the arguments are.  points: real numbers of any type (floats
    exactly), decimal strings or fractions ``"p/q"``, three a point; or an array of shape (n, 3).  arithmetic:
    ``exact``, ``float64``, ``float32``, ``mp:BITS``, ``truncating`` (the thesis's eight digits), ``ibm1962``,
    ``truncating:P``, ``guarded:P`` or ``rounding:P``.  on_refusal: where that arithmetic comes to no hull, as of most
    doubles in ``float64``, ``raise`` HullRefused, whose ``result`` says why, or ``return`` that result.

    Raises PointsError (a ValueError) for invalid points and for none at all, HullRefused, ValueError, RangeError.
    """
    try:
        return Hull(port.convex_hull(points, arithmetic, epsilon, translate, history, fast, on_refusal, text))
    except HullRefused as error:
        raise HullRefused(Hull(error.result)) from None


def exact_hull(points: Points, fast: bool | None = None) -> Hull:
    """The exact convex hull of points by another algorithm, over integers, with a proof: ``Hull.certificate``.

    points: as of ``convex_hull``.  fast: find what is to be proved by a compiled kernel (extra ``fast``); left alone,
    where it is loaded or points are very many.  Raises PointsError (a ValueError) for invalid points and for none at
    all, and ValueError where numba is asked for and missing.
    """
    found = judge.exact_hull(points, fast)
    return Hull(as_hull(found), found.certificate)


def draw(
    points: Points | Hull,
    eye: Sequence[Any] | None = None,
    title: str = "",
    width: int | None = None,
    labels: Labels = "programs",
    hidden: bool = True,
    others: bool = True,
) -> str:
    """A picture of points' exact hull, or of a hull, as the text of an SVG file; see ``Hull.draw``."""
    return _hull(points).draw(eye, title, width, labels, hidden, others)


def save(points: Points | Hull, path: Path, digits: int | None = None) -> None:
    """Write points' exact hull, or a hull, to a file; see ``Hull.save``."""
    _hull(points).save(path, digits)


def read_points(path: Path) -> tuple[tuple[str, str, str], ...]:
    """The points of a file, as the text that stands there; any kind the commands take.  Raises EmulatorError."""
    return read_input(os.fspath(path)).points


def data_deck(points: Points, truncate: bool = False, epsilon: Epsilon = None) -> Deck:
    """Points as a data deck of the 1963 programs: a card with N, then a card a point.

    truncate: cut the digits beyond the eighth instead of refusing them.  epsilon: chapter 7's e, for the layer
    ``epsilon``.  Raises PointsError, and ValueError for what no card can hold.
    """
    texts = [[exact_text(number) for number in point] for point in exact_points(points)]
    deck = decks.data_deck(texts, "points", truncate)
    return deck if epsilon is None else decks.with_epsilon(deck, exact_text(real(epsilon)))


def run_hull(deck: Deck, layers: Sequence[str] = (), options: Options | None = None) -> HullRun:
    """A data deck through program 1 and the program its typewriter names, as ``hull1620 hull`` runs it.

    layers: of the apparatus, such as ``corrected``, added to the listings.  ``result.final.result.punched`` are the
    cards, ``result.refusal`` the message of a refusal.  Raises EmulatorError.
    """
    return job.run_hull(deck, programs.loader(tuple(layers)), options)


def reproduce(*names: str) -> bool:
    """Print what thesis and papers print, computed again, as ``hull1620 reproduce``; whether everything agrees."""
    from modern.cli.main import main  # the one function that needs the commands

    return main(["reproduce", *names]) == 0


def _hull(points: Points | Hull) -> Hull:
    return points if isinstance(points, Hull) else exact_hull(points)


def _float(text: str) -> float:
    """The nearest double; beyond the largest an infinity."""
    try:
        return float(Fraction(text)) if "/" in text else float(text)
    except OverflowError:
        return float("-inf") if text.startswith("-") else float("inf")


def _fixed(array: Array) -> Array:
    array.setflags(write=False)
    return array
