"""Solids in doubles and as triangles, and a simple exact implementation of the rule that merges coplanar faces."""

import math
import struct
from collections.abc import Sequence
from fractions import Fraction

from modern.geometry.coplanar import coplanar
from modern.geometry.hull import Hull
from modern.geometry.mesh import Mesh
from modern.port import convex_hull

Vector = tuple[Fraction, ...]
Point = tuple[int, int, int]

CUBE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
CUBE_FACES = [(3, 2, 1, 0), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
ELL = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)]
ELL_FACES = [(5, 4, 3, 2, 1, 0), (6, 7, 8, 9, 10, 11), *((k, (k + 1) % 6, (k + 1) % 6 + 6, k + 6) for k in range(6))]


def dodecahedron() -> list[tuple[float, float, float]]:
    """Return a regular dodecahedron around the origin, rotated so that all coordinates have many digits."""
    golden = (1 + math.sqrt(5)) / 2
    points = [(a, b, c) for a in (-1.0, 1.0) for b in (-1.0, 1.0) for c in (-1.0, 1.0)]
    for a in (-1, 1):
        for b in (-1, 1):
            points += [(0, a / golden, b * golden), (a / golden, b * golden, 0), (a * golden, 0, b / golden)]
    turned = [(x * math.cos(0.3) - y * math.sin(0.3), x * math.sin(0.3) + y * math.cos(0.3), z) for x, y, z in points]
    return [(x, y * math.cos(0.7) - z * math.sin(0.7), y * math.sin(0.7) + z * math.cos(0.7)) for x, y, z in turned]


def joined_faces(surface: Mesh, within: Fraction) -> tuple[list[list[int]], Fraction]:
    """Return the groups of merged faces of a convex surface, and the square of the largest distance from a plane."""
    points = surface.numbers()
    corners = [[points[place] for place in face] for face in surface.faces]
    normals = [_normal(face) for face in corners]
    remaining = sorted(range(len(corners)), key=lambda k: (-_dot(normals[k], normals[k]), k))
    groups, greatest = [], Fraction(0)
    while remaining:
        leader = remaining[0]
        group = [leader]
        changed = True
        while changed:
            changed = False
            for face in remaining:
                near = any(len(set(surface.faces[face]) & set(surface.faces[member])) >= 2 for member in group)
                if face in group or not near or _dot(normals[face], normals[leader]) <= 0:
                    continue
                square = max(_square(normals[leader], corners[leader][0], point) for point in corners[face])
                if square <= within**2:
                    group.append(face)
                    greatest = max(greatest, square)
                    changed = True
        groups.append(sorted(group))
        remaining = [face for face in remaining if face not in group]
    return sorted(groups), greatest


def _normal(corners: list[Vector]) -> Vector:
    """Return the sum of the cross products of neighbouring corners."""
    total = [Fraction(0)] * 3
    for (a, b, c), (d, e, f) in zip(corners, [*corners[1:], corners[0]], strict=True):
        total = [old + new for old, new in zip(total, (b * f - c * e, c * d - a * f, a * e - b * d), strict=True)]
    return tuple(total)


def _dot(u: Vector, v: Vector) -> Fraction:
    return sum((a * b for a, b in zip(u, v, strict=True)), Fraction(0))


def _square(normal: Vector, base: Vector, point: Vector) -> Fraction:
    return _dot(normal, tuple(a - b for a, b in zip(point, base, strict=True))) ** 2 / _dot(normal, normal)


def twelve_faces() -> Hull:
    """Return the dodecahedron's hull with merged faces: pentagons that are plane except for rounding."""
    return coplanar(convex_hull(dodecahedron()), "1e-9")[0]


def cut(points: Sequence[Point], faces: Sequence[tuple[int, ...]]) -> list[tuple[Point, ...]]:
    """Return faces divided into triangles from their first corners."""
    return [(points[f[0]], points[f[k]], points[f[k + 1]]) for f in faces for k in range(1, len(f) - 1)]


def binary_stl(triangles: Sequence[Sequence[Point]]) -> bytes:
    """Return triangles as a binary STL file."""
    rows = (struct.pack("<12fH", 0, 0, 0, *(c for corner in t for c in corner), 0) for t in triangles)
    return b"parts".ljust(80) + struct.pack("<I", len(triangles)) + b"".join(rows)
