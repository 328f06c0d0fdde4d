"""The class Hull: a convex hull with numpy arrays, exact volume and area, drawings and files."""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from functools import cached_property
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from emulator.errors import ArgumentError
from emulator.files import write_text
from modern.drawing.draw import Labels, Show, draw_svg
from modern.exact_hull.result import Certificate
from modern.formats.export import to_trimesh, write_hull
from modern.geometry.coplanar import coplanar, distance_text
from modern.geometry.hull import Face, PointTexts, Stage, as_tuple
from modern.geometry.hull import Hull as Record
from modern.geometry.mesh import ExportError, Mesh, mesh
from modern.geometry.numbers import AREA_DIGITS, coordinates, real, sum_of_roots, value_of
from modern.geometry.vectors import Vector, six_volumes

_KINDS = ("point", "segment", "polygon", "polyhedron")

Path = str | os.PathLike[str]
Floats = NDArray[np.float64]
Indices = NDArray[np.intp]
Array = TypeVar("Array", bound=NDArray[Any])


class Area(float):
    """An area as a double, because numpy functions and operations with Fractions accept a double but no Decimal.

    Attributes
    ----------
    digits : Decimal
        The area to 50 significant digits.
    """

    digits: Decimal

    def __new__(cls, digits: Decimal) -> "Area":
        area = super().__new__(cls, digits)
        area.digits = digits
        return area


@dataclass(frozen=True, repr=False)
class Hull:
    """A convex hull, the result of ``convex_hull``, ``exact_hull`` and ``voxel_hull``.

    Points are identified by their index in the input, from 0.  Arrays hold the nearest doubles and are read-only.
    ``simplices``, ``equations``, ``neighbors``, ``volume``, ``area`` and ``squared_areas`` raise ExportError if the
    procedure found no hull.  ``volume``, ``area`` and ``squared_areas`` also raise it if the faces form no closed
    surface because numbers were rounded.

    Attributes
    ----------
    record : modern.geometry.hull.Hull
        All data of the hull as exact text.  The other attributes are derived from it.
    certificate : Certificate or None
        The number of checks of each kind that proved the hull, or None for a hull of ``convex_hull``.
    """

    record: Record
    certificate: Certificate | None = None

    @property
    def arithmetic(self) -> str:
        """The name of the arithmetic in which the hull was computed."""
        return self.record.arithmetic

    @property
    def status(self) -> str:
        """The text ``determined``, or the reason why there is no hull, such as an error message of the programs."""
        return self.record.status

    @property
    def determined(self) -> bool:
        """True if a hull was found.  Butler's procedure fails for some points; ``exact_hull`` always finds a hull."""
        return self.record.determined

    @property
    def closes(self) -> bool:
        """True if a hull was found and its faces form a closed surface, so that it has a volume."""
        try:
            return bool(self._closed)
        except ExportError:
            return False

    @property
    def statement(self) -> str:
        """The program and statement number at which Butler's FORTRAN sets ``status``; empty for ``exact_hull``."""
        return self.record.statement

    @property
    def dimension(self) -> int:
        """The dimension of the hull: 0 for a point, 1 for a segment, 2 for a polygon, 3 for a polyhedron."""
        return self.record.dimension

    @property
    def faces(self) -> tuple[Face, ...]:
        """The faces of a polyhedron or the lines of a polygon, with exact equations and the points on them."""
        return as_tuple(self.record.faces)

    @property
    def duplicates(self) -> tuple[tuple[int, int], ...]:
        """Pairs of indices: that of a repeated point, and that of the first point with the same coordinates."""
        return self.record.duplicates

    @property
    def history(self) -> tuple[Stage, ...]:
        """The growing polyhedra H1, H2, ... that Butler's procedure builds, kept if ``history=True`` was given."""
        return as_tuple(self.record.history)

    @property
    def corrected(self) -> tuple[str, ...]:
        """Identifiers of the modern corrections to Butler's listings that changed a branch of this computation."""
        return self.record.corrected

    @cached_property
    def points(self) -> Floats:
        """The points, rounded to the arithmetic of the hull and then to doubles, shape (n, 3)."""
        points = self.record.points
        if isinstance(points, PointTexts):
            return _read_only(points.floats())
        rows = [[_nearest(value_of(text)) if "/" in text else float(text) for text in point] for point in points]
        return _read_only(np.array(rows))

    @property
    def exact_points(self) -> tuple[Vector, ...]:
        """The coordinates of all points as Fractions."""
        return tuple(coordinates(point) for point in self.record.points)

    @cached_property
    def vertices(self) -> Indices:
        """The indices of the vertices, in the order of Butler's procedure; ``exact_hull`` sorts them."""
        return _read_only(np.array(self.record.vertices, np.intp))

    @cached_property
    def boundary(self) -> Indices:
        """The indices of the points on the surface of the hull that are not vertices."""
        return _read_only(np.array(self.record.boundary, np.intp))

    @cached_property
    def inside(self) -> Indices:
        """The indices of the points inside the hull; for a flat hull, inside the polygon or between the two ends."""
        return _read_only(np.array(self.record.inside, np.intp))

    @cached_property
    def simplices(self) -> Indices:
        """The faces split into triangles, shape (m, 3), counterclockwise seen from outside, as in scipy's ConvexHull.

        A polygon has the triangles of its one face.  A segment or a point has no triangles.
        """
        triangles = np.array(self._mesh.triangles(), np.intp).reshape(-1, 3)
        return _read_only(self.vertices[triangles])

    @cached_property
    def equations(self) -> Floats:
        """The outward unit normal and the offset of each of ``simplices``, shape (m, 4), as in scipy's ConvexHull.

        A point x of the hull has normal @ x + offset <= 0, up to rounding.  The equations in ``faces`` are exact.
        """
        rows: list[Floats] = []
        for (a, b, c, d), polygon in zip(self._mesh.planes(self.record), self._mesh.faces, strict=True):
            # Exact division by the largest coefficient first, so that no product of doubles can overflow.
            largest = max(abs(a), abs(b), abs(c)) or Fraction(1)
            row = np.array([_nearest(number / largest) for number in (a, b, c, d)])
            length = float(np.linalg.norm(row[:3])) or 1.0
            if np.isinf(row[3]):
                row[3] = _nearest(d / largest / Fraction(length)) * length
            rows += [row / length] * (len(polygon) - 2)
        return _read_only(np.array(rows, np.float64).reshape(-1, 4))

    @cached_property
    def neighbors(self) -> Indices:
        """The neighbours of each of ``simplices``, shape (m, 3), as in scipy's ConvexHull.

        Entry k of row i is the index, in ``simplices``, of the triangle that shares with triangle i the edge opposite
        its corner k.  The entry is -1 if there is no such triangle.  This happens only at the boundary of a flat hull.
        """
        corners = self.simplices.tolist()
        owner = {(c[k - 2], c[k - 1]): row for row, c in enumerate(corners) for k in range(3)}
        rows = [[owner.get((c[k - 1], c[k - 2]), -1) for k in range(3)] for c in corners]
        return _read_only(np.array(rows, np.intp).reshape(-1, 3))

    @cached_property
    def volume(self) -> Fraction:
        """The exact volume; 0 for a flat hull."""
        surface = self._closed
        return six_volumes(surface.numbers(), surface.faces) / 6 if self.dimension == 3 else Fraction(0)

    @cached_property
    def area(self) -> Area:
        """The area of the surface; for a polygon, the area that it encloses, counted once.

        The value is the nearest double, and ``area.digits`` is the area to 50 significant digits.  The area is a sum of
        square roots, so unlike ``volume`` it need not be a fraction.  The digits are exact if the area of every face is
        a decimal of at most 50 digits.  ``squared_areas`` are always exact.
        """
        return Area(sum_of_roots(self.squared_areas, AREA_DIGITS))

    @cached_property
    def squared_areas(self) -> tuple[Fraction, ...]:
        """The exact square of the area of each face, in the order of ``faces``; one number for a polygon."""
        return self._closed.squared_areas()

    def coplanar(self, within: Any) -> "Hull":
        """Return a hull in which faces that are coplanar to within a distance are joined.

        Parameters
        ----------
        within : real number or str
            The distance as a number, decimal text or a fraction ``"p/q"``.

        Returns
        -------
        Hull
            A new hull.  A joined face has the equation of the largest of its faces.  ``volume`` and ``area`` are those
            of the joined faces split into triangles.  A flat hull is returned unchanged.

        Raises
        ------
        ExportError
            The distance is invalid, or it is too large for this solid.

        Notes
        -----
        ``modern.geometry.coplanar`` defines which faces are joined, and which distances are too large.
        ``record.coplanar`` of the result has the number of faces before joining, the largest distance of a vertex from
        its plane, and the smallest distance with which more faces would be joined.
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
        """Return a drawing as the text of an SVG file, with hidden edges dashed.

        Parameters
        ----------
        eye : sequence of 3 numbers, optional
            The direction to the eye.
        title : str, optional
            The title of the drawing.
        width : int, optional
            The width in pixels.
        labels : {"programs", "input", "none"}, optional
            ``programs`` numbers the vertices as the programs do, ``input`` by their index in the input, and ``none``
            not at all.
        hidden : bool, optional
            Draw hidden edges.
        others : bool, optional
            Draw the points that are not vertices.

        Raises
        ------
        ExportError
            The hull cannot be drawn, or ``eye`` does not have three numbers.
        ArgumentError
            ``eye`` contains something that is not a number.

        See Also
        --------
        modern.drawing.draw.draw_svg
        """
        direction = None if eye is None else _direction(eye)
        return draw_svg(self.record, direction, title, width, Show(labels, hidden, others))

    def save(self, path: Path, digits: int | None = None) -> None:
        """Write the hull to a file in the format of its extension.

        Parameters
        ----------
        path : str or path-like
            A name that ends with .off, .obj, .ply, .stl, .json, .html or, for a drawing, .svg.
        digits : int, optional
            The number of significant digits to which coordinates without a finite decimal expansion are rounded.
            Without it such a coordinate raises ExportError.

        Raises
        ------
        ExportError
            The format is unknown or cannot hold the hull.
        FileError
            The file cannot be written.
        """
        name = os.fspath(path)
        if name.lower().endswith(".svg"):
            write_text(name, self.draw())
        else:
            write_hull(self.record, name, digits=digits)

    def to_trimesh(self) -> Any:
        """Return the hull as a ``trimesh.Trimesh`` (needs the extra ``mesh``).

        Raises
        ------
        ExportError
            trimesh is not installed, or it cannot hold the hull.
        """
        return to_trimesh(self.record)

    def __repr__(self) -> str:
        count, arithmetic = len(self.record.points), self.arithmetic
        if not self.determined:
            return f"<no hull: {self.status} at {self.statement}; {count} points, {arithmetic}>"
        faces = f", {len(self.faces)} {'faces' if self.dimension == 3 else 'lines'}" if self.faces else ""
        vertices = f"{len(self.record.vertices)} {'vertices' if self.dimension else 'vertex'}"
        joined = self.record.coplanar
        within = "" if joined is None else f", coplanar within {distance_text(Fraction(joined.within))}"
        return f"<hull: {_KINDS[self.dimension]}, {vertices}{faces}; {count} points, {arithmetic}{within}>"

    def _repr_svg_(self) -> str | None:
        return self.draw() if self.determined else None

    @cached_property
    def _mesh(self) -> Mesh:
        return mesh(self.record)

    @cached_property
    def _closed(self) -> Mesh:
        """The surface of the hull as a mesh.  Raise ExportError if an edge does not belong to exactly two faces."""
        if self.dimension == 3 and not self._mesh.closed:
            raise ExportError(f"the faces determined in {self.arithmetic} do not form a closed surface")
        return self._mesh


def _direction(eye: Sequence[Any]) -> list[Fraction]:
    try:
        direction = [Fraction(real(number)) for number in eye]
    except (TypeError, ValueError) as error:
        raise ArgumentError(f"eye: {error}") from None
    if len(direction) != 3:
        raise ExportError(f"expected a direction of view with 3 numbers, found {len(direction)}")
    return direction


def _nearest(value: Fraction) -> float:
    """Return the double nearest to a fraction, or an infinity if it is beyond the largest double."""
    try:
        return float(value)
    except OverflowError:
        return float("-inf") if value < 0 else float("inf")


def _read_only(array: Array) -> Array:
    array.setflags(write=False)
    return array
