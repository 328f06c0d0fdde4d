"""Faces read as one: neighbours on a convex surface whose vertices lie within E of one plane.

Points in binary floats seldom lie in a plane exactly: the hull of a dodecahedron in doubles has 36 faces.  The hull
stays as it is; what is made here is a reading of it.  Faces are taken from the largest on (by area; of equals the
first).  To a face that is not joined yet are joined all that are connected with it through edges, turn the same way
(their normals have a positive product) and have every vertex within E of *its* plane.  Distances are compared by their
squares, exactly.  A joined face is the polygon around its faces; a vertex within it is left out.

An E that fits no face of the solid any more is refused: one within which all points lie of the largest face's plane, or
which leaves fewer than four faces, or a face that is not a simple polygon, convex within E.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from decimal import MAX_EMAX, MIN_EMIN, ROUND_CEILING, ROUND_HALF_EVEN, Context, Decimal
from fractions import Fraction

from modern.geometry.hull import Coplanar, Face, Hull
from modern.geometry.mesh import ExportError, Mesh, mesh, sides
from modern.geometry.numbers import finite_decimal, real
from modern.geometry.vectors import area_vector, cross, dot, lowest, minus

IntVector = tuple[int, int, int]
_LEAST = 4
"""Faces of a solid at least."""
_SHOWN, _WORK, _LONGEST = 3, 60, 12


FLAT = "the points lie in one plane: there are no faces to join"


class CoplanarError(ExportError):
    """A distance within which the faces of this surface cannot be read as one; one line that says why."""


@dataclass(frozen=True, slots=True)
class Joined:
    """A convex surface with faces joined.

    within: the distance E.  groups: the surface's faces that make up each joined face, by place, the one whose plane
    is meant first; in the order of their smallest places.  loops: the polygon of each, counterclockwise from outside,
    by place in the surface's points.  left_out: points on no loop.  square: that of the largest distance of a vertex
    from the plane it is joined to.  beyond: that of the distance from which on one more face would be joined, None
    where none could be.
    """

    within: Fraction
    groups: tuple[tuple[int, ...], ...]
    loops: tuple[tuple[int, ...], ...]
    left_out: tuple[int, ...]
    square: Fraction
    beyond: Fraction | None

    @property
    def faces(self) -> int:
        """How many faces the surface itself has."""
        return sum(map(len, self.groups))

    def group_of(self) -> tuple[int, ...]:
        """For every face of the surface the place of the joined face it belongs to."""
        found = {face: place for place, group in enumerate(self.groups) for face in group}
        return tuple(found[face] for face in range(len(found)))


def parse_distance(value: object) -> Fraction:
    """E as a fraction: of decimal text, a fraction ``p/q``, or any real number.  Raises CoplanarError."""
    try:
        found = Fraction(real(value))
    except ValueError as error:
        raise CoplanarError(f"the distance within which faces are coplanar: {error}") from None
    if found < 0:
        raise CoplanarError(f"the distance within which faces are coplanar is 0 or more, not {distance_text(found)}")
    return found


def join(surface: Mesh, within: Fraction) -> Joined:
    """The faces of a closed convex surface, joined within a distance.

    Raises CoplanarError for a distance too large, and for faces that do not close.
    """
    points, scale = _integers(surface)
    normals = [area_vector(points, face) for face in surface.faces]
    sizes = [dot(normal, normal) for normal in normals]
    if not all(sizes):
        raise CoplanarError(f"face {sizes.index(0) + 1} has no area")
    flanks = [lowest(normal) for normal in normals]
    squares = [dot(flank, flank) * scale * scale for flank in flanks]
    beside = {edge: order for order, face in enumerate(surface.faces) for edge in sides(face)}
    limit = within * within
    owner = [-1] * len(normals)
    groups: list[list[int]] = []
    greatest, beyond = Fraction(0), None
    order = sorted(range(len(normals)), key=lambda face: (-sizes[face], face))
    largest = order[0]
    if _depth(points, flanks[largest], surface.faces[largest][0], range(len(points))) <= limit * squares[largest]:
        raise CoplanarError(f"all points lie within {distance_text(within)} of the plane of the largest face")
    for leader in order:
        if owner[leader] >= 0:
            continue
        group = [leader]
        owner[leader] = len(groups)
        base = surface.faces[leader][0]
        for face in group:
            for a, b in sides(surface.faces[face]):
                other = beside.get((b, a))
                if other is None:
                    raise CoplanarError("the faces do not close to a surface")
                if owner[other] >= 0 or dot(flanks[leader], flanks[other]) <= 0:
                    continue
                square = Fraction(_depth(points, flanks[leader], base, surface.faces[other]), squares[leader])
                if square <= limit:
                    owner[other] = len(groups)
                    group.append(other)
                    greatest = max(greatest, square)
                elif beyond is None or square < beyond:
                    beyond = square
        groups.append(group)
    if len(groups) < _LEAST:
        raise CoplanarError(
            f"within {distance_text(within)} the {len(normals)} faces would be {len(groups)}; a solid has four at least"
        )
    groups.sort(key=min)
    loops = tuple(_loop(surface, group, within) for group in groups)
    for loop, group in zip(loops, groups, strict=True):
        if len(group) > 1:
            _check_convex(points, scale, loop, flanks[group[0]], within)
    kept = {place for loop in loops for place in loop}
    left_out = tuple(place for place in range(len(points)) if place not in kept)
    return Joined(within, tuple(map(tuple, groups)), loops, left_out, greatest, beyond)


def joined_mesh(surface: Mesh, found: Joined) -> Mesh:
    """The surface with its faces joined, its points on no face left out."""
    gone = set(found.left_out)
    kept = [place for place in range(len(surface.points)) if place not in gone]
    names = {place: order for order, place in enumerate(kept)}
    faces = tuple(tuple(names[place] for place in loop) for loop in found.loops)
    return Mesh(surface.dimension, tuple(surface.points[place] for place in kept), faces)


def coplanar(hull: Hull, within: object) -> tuple[Hull, Joined | None]:
    """A reading of a hull, with faces joined within a distance, and how they were; of what is flat the hull itself.

    A joined face has the equation of its largest face, and its vertices lie within that distance of it.  Vertices
    within joined faces become boundary points.  Raises CoplanarError, and ExportError where there is no hull.
    """
    limit = parse_distance(within)
    surface = mesh(hull)
    if surface.dimension < 3:
        return hull, None
    found = join(surface, limit)
    gone = [hull.vertices[place] for place in found.left_out]
    faces = tuple(_face(hull, group, loop, set(gone)) for group, loop in zip(found.groups, found.loops, strict=True))
    return (
        replace(
            hull,
            vertices=tuple(index for index in hull.vertices if index not in gone),
            boundary=(*hull.boundary, *gone),
            faces=faces,
            coplanar=Coplanar(
                finite_decimal(limit) or str(limit),
                found.faces,
                root_text(found.square),
                None if found.beyond is None else root_text(found.beyond),
            ),
        ),
        found,
    )


def _face(hull: Hull, group: Sequence[int], loop: Sequence[int], gone: set[int]) -> Face:
    polygon = tuple(hull.vertices[place] for place in loop)
    on = dict.fromkeys(index for face in group for index in hull.faces[face].on)
    within = dict.fromkeys(index for face in group for index in hull.faces[face].polygon if index in gone)
    return replace(hull.faces[group[0]], polygon=polygon, on=(*on, *within))


def join_summary(found: Joined) -> str:
    """What was joined, how far a vertex is off its plane at the most, and from which distance on more would be."""
    within = distance_text(found.within)
    more = "" if found.beyond is None else f"the next face would be joined from {root_text(found.beyond)} on"
    if len(found.groups) == found.faces:
        return f"no two of {found.faces} faces lie within {within} of one plane" + (more and f"; {more}")
    parts = [
        f"{found.faces} faces are read as {len(found.groups)} within {within}",
        f"a vertex is off its plane by {root_text(found.square)} at the most",
    ]
    if found.left_out:
        many = len(found.left_out)
        parts.append(
            "a vertex within a joined face is left out"
            if many == 1
            else f"{many} vertices within joined faces are left out"
        )
    return "; ".join([*parts, more] if more else parts)


def root_text(square: Fraction) -> str:
    """The root of a square to three digits, rounded up."""
    work = Context(prec=_WORK, rounding=ROUND_HALF_EVEN, Emin=MIN_EMIN, Emax=MAX_EMAX)
    root = work.sqrt(work.divide(Decimal(square.numerator), Decimal(square.denominator)))
    rounded = Context(prec=_SHOWN, rounding=ROUND_CEILING, Emin=MIN_EMIN, Emax=MAX_EMAX).plus(root)
    return _plain(rounded)


def distance_text(value: Fraction) -> str:
    """A distance for a message: as it is where that is short, else to six digits."""
    exact = finite_decimal(value)
    text = str(value) if exact is None else _plain(Decimal(exact))
    work = Context(prec=6, Emin=MIN_EMIN, Emax=MAX_EMAX)
    return text if len(text) <= _LONGEST else _plain(work.divide(Decimal(value.numerator), Decimal(value.denominator)))


def _plain(value: Decimal) -> str:
    """40, 0.002, 1e-9."""
    short = value.normalize()
    return f"{short:f}" if -5 < short.adjusted() < _LONGEST else f"{short:g}"


def _integers(surface: Mesh) -> tuple[list[IntVector], int]:
    """The points times the least number that makes them whole, and that number."""
    numbers = surface.numbers()
    scale = math.lcm(*(value.denominator for point in numbers for value in point))
    found = []
    for x, y, z in numbers:
        a, b, c = (value.numerator * (scale // value.denominator) for value in (x, y, z))
        found.append((a, b, c))
    return found, scale


def _depth(points: Sequence[IntVector], flank: IntVector, base: int, places: Sequence[int]) -> int:
    """The square of the largest distance of points from a plane, times the square of the length of its normal."""
    level = dot(flank, points[base])
    return max(abs(level - dot(flank, points[place])) for place in places) ** 2


def _loop(surface: Mesh, group: Sequence[int], within: Fraction) -> tuple[int, ...]:
    """The polygon around the faces of a group."""
    if len(group) == 1:
        return surface.faces[group[0]]
    edges = {edge for face in group for edge in sides(surface.faces[face])}
    border = [(a, b) for a, b in edges if (b, a) not in edges]
    ahead = dict(border)
    found = [min(ahead)] if ahead else []
    while found and ahead[found[-1]] != found[0]:
        found.append(ahead[found[-1]])
        if len(found) > len(ahead):
            break
    if not found or len(found) != len(border):
        raise CoplanarError(f"within {distance_text(within)} a joined face would not be one simple polygon")
    return tuple(found)


def _check_convex(
    points: Sequence[IntVector], scale: int, loop: Sequence[int], flank: IntVector, within: Fraction
) -> None:
    """Refuse a polygon with a corner farther than E within the convex polygon around it, seen along the normal."""
    size = dot(flank, flank)
    corners = [points[place] for place in loop]
    hull = _outer(corners, flank)
    for first, last in zip(hull, [*hull[1:], hull[0] + len(corners)], strict=True):
        p = corners[first]
        along = minus(corners[last % len(corners)], p)
        # The squared length of the side seen along the normal, times the normal's.
        length = dot(along, along) * size - dot(along, flank) ** 2
        for between in range(first + 1, last):
            off = dot(cross(along, minus(corners[between % len(corners)], p)), flank)
            if Fraction(off * off, length * scale * scale) > within * within:
                raise CoplanarError(
                    f"within {distance_text(within)} a joined face would not be convex, by more than that"
                )


def _outer(corners: Sequence[IntVector], flank: IntVector) -> list[int]:
    """The corners of the convex polygon around a polygon, in its order, seen along the normal."""
    dropped = max(range(3), key=lambda axis: abs(flank[axis]))
    u, v = (dropped + 1) % 3, (dropped + 2) % 3
    # Seen along the normal, not along an axis: times the normal's component, to stay whole.
    height = abs(flank[dropped])
    flat = []
    for corner in corners:
        level = corner[dropped] if flank[dropped] > 0 else -corner[dropped]
        flat.append((corner[u] * height - flank[u] * level, corner[v] * height - flank[v] * level))
    order = sorted(range(len(flat)), key=flat.__getitem__)

    def left(i: int, j: int, k: int) -> bool:
        (a, b), (c, d), (e, f) = flat[i], flat[j], flat[k]
        return (c - a) * (f - b) > (d - b) * (e - a)

    def chain(places: Sequence[int]) -> list[int]:
        kept: list[int] = []
        for place in places:
            while len(kept) > 1 and not left(kept[-2], kept[-1], place):
                kept.pop()
            kept.append(place)
        return kept[:-1]

    return sorted({*chain(order), *chain(order[::-1])})
