"""Join faces of a hull that are coplanar to within a distance E, for points in binary floats.

Such points are seldom exactly coplanar: the hull of a dodecahedron in doubles has 36 faces, not 12.  This module leaves
the hull as it is and derives a second hull with joined faces from it:

1. Visit the faces in order of area, from the largest to the smallest, and faces of equal area in the order of the hull.
2. Skip a face that already belongs to a joined face.  Otherwise join to it all faces that are connected to it through
   edges, have a normal less than 90 degrees from its normal, and have all vertices within E of its plane.
   Distances are compared exactly, by their squares.
3. The joined face is the polygon that bounds this group of faces.  A vertex in the interior of the polygon is dropped.

E is too large for the solid if all points lie within E of the plane of the largest face, if fewer than four faces
remain, or if a joined face is not a simple polygon that is convex to within E.  Joining then raises CoplanarError.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from decimal import MAX_EMAX, MIN_EMIN, ROUND_CEILING, ROUND_HALF_EVEN, Context, Decimal
from fractions import Fraction

from modern.geometry.hull import Coplanar, Face, Hull
from modern.geometry.mesh import ExportError, Mesh, mesh, sides
from modern.geometry.numbers import finite_decimal, real
from modern.geometry.vectors import area_vector, cross, dot, lowest, minus, whole

IntVector = tuple[int, int, int]
# The smallest number of faces of a solid.
_LEAST = 4
_SHOWN, _WORK, _LONGEST = 3, 60, 12

FLAT = "the points lie in one plane: there are no faces to join"


class CoplanarError(ExportError):
    """Raised if faces cannot be joined within the given distance; the message gives the reason in one line."""


@dataclass(frozen=True, slots=True)
class Joined:
    """A convex surface with faces joined ``within`` the distance E.

    ``groups`` has for each joined face the indices of the faces that it replaces.  Each joined face has the plane of
    the first face that it replaces.  ``loops`` are the polygons of the joined faces, counterclockwise seen from
    outside.  ``left_out`` has the points that belong to no polygon, because they lie inside a joined face.  ``square``
    is the square of the largest distance of a vertex from the plane of its joined face.  ``beyond`` is the square of
    the smallest E that would join one more face, or None if no E would.
    """

    within: Fraction
    groups: tuple[tuple[int, ...], ...]
    loops: tuple[tuple[int, ...], ...]
    left_out: tuple[int, ...]
    square: Fraction
    beyond: Fraction | None

    @property
    def faces(self) -> int:
        """The number of faces of the surface before joining."""
        return sum(map(len, self.groups))

    def group_of(self) -> tuple[int, ...]:
        """Return, for each face of the original surface, the index of the joined face that contains it."""
        groups = {face: index for index, group in enumerate(self.groups) for face in group}
        return tuple(groups[face] for face in range(len(groups)))


def parse_distance(value: object) -> Fraction:
    """Return a distance as a Fraction.  ``value`` is a number or its text.  Raise CoplanarError if it is invalid."""
    try:
        distance = Fraction(real(value))
    except ValueError as error:
        raise CoplanarError(f"the distance within which faces are coplanar: {error}") from None
    if distance < 0:
        raise CoplanarError(f"the distance within which faces are coplanar must be >= 0, not {distance_text(distance)}")
    return distance


def join(surface: Mesh, within: Fraction) -> Joined:
    """Join the faces that are coplanar to within a distance. Raise CoplanarError if the distance is too large."""
    scale, points = whole(surface.numbers())
    normals = [area_vector(points, face) for face in surface.faces]
    sizes = [dot(normal, normal) for normal in normals]
    if not all(sizes):
        raise CoplanarError(f"face {sizes.index(0) + 1} has no area")
    # Normals are reduced to lowest terms, so that the integers in the computation of distances stay small.
    reduced = [lowest(normal) for normal in normals]
    squares = [dot(normal, normal) * scale * scale for normal in reduced]
    face_left_of = {edge: index for index, face in enumerate(surface.faces) for edge in sides(face)}
    limit = within * within
    owner = [-1] * len(normals)
    groups: list[list[int]] = []
    greatest, beyond = Fraction(0), None
    order = sorted(range(len(normals)), key=lambda face: (-sizes[face], face))
    largest = order[0]
    if _depth(points, reduced[largest], surface.faces[largest][0], range(len(points))) <= limit * squares[largest]:
        raise CoplanarError(f"all points lie within {distance_text(within)} of the plane of the largest face")
    for leader in order:
        if owner[leader] >= 0:
            continue
        group = [leader]
        owner[leader] = len(groups)
        base = surface.faces[leader][0]
        # A breadth-first search over the edges: the group grows while the loop traverses it.
        for face in group:
            for a, b in sides(surface.faces[face]):
                neighbour = face_left_of.get((b, a))
                if neighbour is None:
                    raise CoplanarError("the faces do not form a closed surface")
                if owner[neighbour] >= 0 or dot(reduced[leader], reduced[neighbour]) <= 0:
                    continue
                depth = _depth(points, reduced[leader], base, surface.faces[neighbour])
                square = Fraction(depth, squares[leader])
                if square <= limit:
                    owner[neighbour] = len(groups)
                    group.append(neighbour)
                    greatest = max(greatest, square)
                elif beyond is None or square < beyond:
                    beyond = square
        groups.append(group)
    if len(groups) < _LEAST:
        raise CoplanarError(
            f"within {distance_text(within)} the {len(normals)} faces would become {len(groups)} faces; "
            "a solid has at least four faces"
        )
    groups.sort(key=min)
    loops = tuple(_loop(surface, group, within) for group in groups)
    for loop, group in zip(loops, groups, strict=True):
        if len(group) > 1:
            _check_convex(points, scale, loop, reduced[group[0]], within)
    on_loops = {index for loop in loops for index in loop}
    left_out = tuple(index for index in range(len(points)) if index not in on_loops)
    return Joined(within, tuple(map(tuple, groups)), loops, left_out, greatest, beyond)


def joined_mesh(surface: Mesh, joined: Joined) -> Mesh:
    """Return the surface with joined faces.  Points inside joined faces (``joined.left_out``) are omitted."""
    left_out = set(joined.left_out)
    remaining = [index for index in range(len(surface.points)) if index not in left_out]
    new_indices = {index: new for new, index in enumerate(remaining)}
    faces = tuple(tuple(new_indices[index] for index in loop) for loop in joined.loops)
    return Mesh(surface.dimension, tuple(surface.points[index] for index in remaining), faces)


def coplanar(hull: Hull, within: object) -> tuple[Hull, Joined | None]:
    """Return the hull with its coplanar faces joined, and a record of the joining.

    A hull without volume is returned unchanged, with None.  A joined face has the equation of the largest face that it
    replaces, and its vertices are at most ``within`` from the plane of that face.  Vertices inside joined faces become
    boundary points.  Raise CoplanarError if the distance is invalid or too large, and ExportError if the hull was not
    determined.
    """
    limit = parse_distance(within)
    surface = mesh(hull)
    if surface.dimension < 3:
        return hull, None
    joined = join(surface, limit)
    left_out = [hull.vertices[index] for index in joined.left_out]
    faces = tuple(
        _face(hull, group, loop, set(left_out)) for group, loop in zip(joined.groups, joined.loops, strict=True)
    )
    return (
        replace(
            hull,
            vertices=tuple(index for index in hull.vertices if index not in left_out),
            boundary=(*hull.boundary, *left_out),
            faces=faces,
            coplanar=Coplanar(
                finite_decimal(limit) or str(limit),
                joined.faces,
                root_text(joined.square),
                None if joined.beyond is None else root_text(joined.beyond),
            ),
        ),
        joined,
    )


def _face(hull: Hull, group: Sequence[int], loop: Sequence[int], left_out: set[int]) -> Face:
    polygon = tuple(hull.vertices[index] for index in loop)
    on = dict.fromkeys(index for face in group for index in hull.faces[face].on)
    inner = dict.fromkeys(index for face in group for index in hull.faces[face].polygon if index in left_out)
    return replace(hull.faces[group[0]], polygon=polygon, on=(*on, *inner))


def join_summary(joined: Joined) -> str:
    """Return a line for the user: numbers of faces, largest deviation, and the smallest E that joins one more face."""
    within = distance_text(joined.within)
    following = ""
    if joined.beyond is not None:
        following = f"another face is joined if the distance is at least {root_text(joined.beyond)}"
    if len(joined.groups) == joined.faces:
        return f"no two of {joined.faces} faces lie within {within} of one plane" + (following and f"; {following}")
    parts = [
        f"{joined.faces} faces are joined into {len(joined.groups)} within {within}",
        f"a vertex lies at most {root_text(joined.square)} from the plane of its joined face",
    ]
    if joined.left_out:
        count = len(joined.left_out)
        parts.append(
            "1 vertex inside a joined face is left out"
            if count == 1
            else f"{count} vertices inside joined faces are left out"
        )
    return "; ".join([*parts, following] if following else parts)


def root_text(square: Fraction) -> str:
    """Return the square root of ``square`` as text with three significant digits, rounded up."""
    work = Context(prec=_WORK, rounding=ROUND_HALF_EVEN, Emin=MIN_EMIN, Emax=MAX_EMAX)
    root = work.sqrt(work.divide(Decimal(square.numerator), Decimal(square.denominator)))
    rounded = Context(prec=_SHOWN, rounding=ROUND_CEILING, Emin=MIN_EMIN, Emax=MAX_EMAX).plus(root)
    return _plain(rounded)


def distance_text(value: Fraction) -> str:
    """Return a distance as text for a message: all of its digits if they are few, otherwise six significant digits."""
    exact = finite_decimal(value)
    text = str(value) if exact is None else _plain(Decimal(exact))
    work = Context(prec=6, Emin=MIN_EMIN, Emax=MAX_EMAX)
    return text if len(text) <= _LONGEST else _plain(work.divide(Decimal(value.numerator), Decimal(value.denominator)))


def _plain(value: Decimal) -> str:
    """Return the number without trailing zeros. A number that would be long gets an exponent: 40, 0.002, but 1e-9."""
    short = value.normalize()
    return f"{short:f}" if -5 < short.adjusted() < _LONGEST else f"{short:g}"


def _depth(points: Sequence[IntVector], normal: IntVector, base: int, indices: Sequence[int]) -> int:
    """Return the largest squared distance of points from a plane, multiplied by |normal|^2, which makes it an integer.

    ``base`` is the index of a point in the plane, and ``indices`` are the indices of the points to be measured.
    """
    level = dot(normal, points[base])
    return max(abs(level - dot(normal, points[index])) for index in indices) ** 2


def _loop(surface: Mesh, group: Sequence[int], within: Fraction) -> tuple[int, ...]:
    """Return the polygon that bounds a group of faces.  Raise CoplanarError if it is not a simple polygon."""
    if len(group) == 1:
        return surface.faces[group[0]]
    edges = {edge for face in group for edge in sides(surface.faces[face])}
    # An edge inside the group occurs in both directions.
    border = [(a, b) for a, b in edges if (b, a) not in edges]
    following = dict(border)
    loop = [min(following)] if following else []
    while loop and following[loop[-1]] != loop[0]:
        loop.append(following[loop[-1]])
        if len(loop) > len(following):
            break
    if not loop or len(loop) != len(border):
        raise CoplanarError(f"{distance_text(within)} is too large: a joined face would not be one simple polygon")
    return tuple(loop)


def _check_convex(
    points: Sequence[IntVector], scale: int, loop: Sequence[int], normal: IntVector, within: Fraction
) -> None:
    """Raise CoplanarError if a corner of the polygon ``loop`` lies more than E inside the convex hull of the polygon.

    The distance is measured after a projection along the normal.
    """
    size = dot(normal, normal)
    corners = [points[index] for index in loop]
    hull = _outer(corners, normal)
    for first, last in zip(hull, [*hull[1:], hull[0] + len(corners)], strict=True):
        p = corners[first]
        along = minus(corners[last % len(corners)], p)
        # |normal|^2 times the squared length of this side of the hull, seen along the normal.
        length = dot(along, along) * size - dot(along, normal) ** 2
        for between in range(first + 1, last):
            off = dot(cross(along, minus(corners[between % len(corners)], p)), normal)
            if Fraction(off * off, length * scale * scale) > within * within:
                raise CoplanarError(
                    f"{distance_text(within)} is too large: a corner of a joined face lies more than this distance"
                    " inside the convex hull of the face"
                )


def _outer(corners: Sequence[IntVector], normal: IntVector) -> list[int]:
    """Return the indices of the corners on the convex hull of a polygon, in order, seen along the normal."""
    dropped = max(range(3), key=lambda axis: abs(normal[axis]))
    u, v = (dropped + 1) % 3, (dropped + 2) % 3
    # Project along the normal onto the plane of the axes u and v.  Multiply by the normal's dropped component, so that
    # the results are integers.
    height = abs(normal[dropped])
    flat = []
    for corner in corners:
        level = corner[dropped] if normal[dropped] > 0 else -corner[dropped]
        flat.append((corner[u] * height - normal[u] * level, corner[v] * height - normal[v] * level))
    order = sorted(range(len(flat)), key=flat.__getitem__)

    def turns_left(i: int, j: int, k: int) -> bool:
        (a, b), (c, d), (e, f) = flat[i], flat[j], flat[k]
        return (c - a) * (f - b) > (d - b) * (e - a)

    def chain(indices: Sequence[int]) -> list[int]:
        """Return the upper or lower half of the convex hull, by Andrew's algorithm of monotone chains."""
        half: list[int] = []
        for index in indices:
            while len(half) > 1 and not turns_left(half[-2], half[-1], index):
                half.pop()
            half.append(index)
        return half[:-1]

    return sorted({*chain(order), *chain(order[::-1])})
