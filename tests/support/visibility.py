"""A judge of hidden lines that casts rays in integers through half-spaces and uses nothing of the program except
polyhedra.

A point of an edge is visible if the edge has a face turned to the eye, the ray from the point to the eye meets the
interior of no polyhedron (for a plate, of no polygon), and the point is no ghost.
"""

import itertools
import math
from collections.abc import Iterator, Sequence
from fractions import Fraction

from modern.papers.nakamae_nishita.hidden import Drawing
from modern.papers.nakamae_nishita.polyhedron import Polyhedron

Point = tuple[int, int, int]


def dot(u, v):
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def minus(u, v):
    return u[0] - v[0], u[1] - v[1], u[2] - v[2]


def cross(u, v):
    return u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]


class Judge:
    """A scene in integers with the ``direction`` to the eye or the ``point`` of the eye."""

    def __init__(self, polyhedra: Sequence[Polyhedron], direction=None, point=None, ghosts: bool = True) -> None:
        numbers = [c for p in polyhedra for v in p.vertices for c in v] + [Fraction(c) for c in point or ()]
        numbers += [c for p in polyhedra for f in p.figures for v in f.corners for c in v]
        self.scale = math.lcm(*(c.denominator for c in numbers))
        self.direction, self.ghosts = direction, ghosts
        self.point = None if point is None else self.whole(point)
        self.polyhedra = polyhedra
        self.points = [[self.whole(v) for v in p.vertices] for p in polyhedra]
        self.corners = [[self.whole(v) for f in p.figures for v in f.corners] for p in polyhedra]
        self.planes = [
            [self._plane([pts[k] for k in face]) for face in p.faces]
            for p, pts in zip(polyhedra, self.points, strict=True)
        ]

    def whole(self, point) -> Point:
        return tuple(int(Fraction(c) * self.scale) for c in point)

    @staticmethod
    def _plane(corners: list[Point]) -> tuple[Point, int]:
        """Return the outward normal and the distance of a face whose corners are clockwise from outside."""
        for k in range(1, len(corners) - 1):
            normal = cross(minus(corners[k + 1], corners[0]), minus(corners[k], corners[0]))
            if any(normal):
                divisor = math.gcd(*normal)
                normal = tuple(c // divisor for c in normal)
                return normal, dot(normal, corners[0])
        raise AssertionError

    def eye_side(self, plane: tuple[Point, int]) -> int:
        """Return 1 if a face of this plane is turned to the eye, 0 if it is edge-on, -1 otherwise."""
        normal, distance = plane
        value = dot(normal, self.direction) if self.point is None else dot(normal, self.point) - distance
        return (value > 0) - (value < 0)

    def edge_faces(self, solid: int, a: int, b: int) -> list[int]:
        return [
            k
            for k, face in enumerate(self.polyhedra[solid].faces)
            if a in face and b in face and self._side(face, a, b)
        ]

    @staticmethod
    def _side(face: tuple[int, ...], a: int, b: int) -> bool:
        i, j = face.index(a), face.index(b)
        return abs(i - j) in (1, len(face) - 1)

    def edges(self, solid: int) -> Iterator[tuple[int, int]]:
        """Yield the edges between faces of different planes."""
        pairs = {
            (min(a, b), max(a, b))
            for face in self.polyhedra[solid].faces
            for a, b in zip(face, face[1:] + face[:1], strict=True)
        }
        for a, b in sorted(pairs):
            f, g = (self.planes[solid][k] for k in self.edge_faces(solid, a, b))
            if f != g:
                yield a, b

    def figure_sides(self) -> Iterator[tuple[int, int, int, int]]:
        """Yield polyhedron, two corners counted after the vertices, and face of every side of a figure."""
        for n, polyhedron in enumerate(self.polyhedra):
            first = len(polyhedron.vertices)
            for figure in polyhedron.figures:
                corners = range(first, first + len(figure.corners))
                first += len(figure.corners)
                for a, b in zip(corners, [*corners[1:], corners[0]], strict=True):
                    yield n, a, b, figure.face

    def hidden(self, point: Point, unit: int) -> bool:
        """Return True if the ray from ``point / unit`` to the eye meets an interior."""
        towards = self.direction if self.point is None else minus(tuple(unit * c for c in self.point), point)
        return any(
            self._meets(planes, pts, point, towards, unit) for planes, pts in zip(self.planes, self.points, strict=True)
        )

    def _meets(self, planes, pts, point: Point, towards: Point, unit: int) -> bool:
        if len(planes) == 2:
            return self._meets_plate(planes[0], pts, point, towards, unit)
        low, high = (0, 1), (1, 0) if self.point is None else (1, 1)
        for normal, distance in planes:
            slope, room = dot(normal, towards), unit * distance - dot(normal, point)
            # Inside: slope * t < room.
            if slope == 0:
                if room <= 0:
                    return False
            elif slope > 0:
                if room * high[1] < high[0] * slope:
                    high = (room, slope)
            elif -room * low[1] > low[0] * -slope:
                low = (-room, -slope)
        return low[0] * high[1] < high[0] * low[1]

    def _meets_plate(self, plane, pts, point: Point, towards: Point, unit: int) -> bool:
        normal, distance = plane
        slope, room = dot(normal, towards), unit * distance - dot(normal, point)
        if slope < 0:
            slope, room = -slope, -room
        if slope == 0 or room <= 0 or (self.point is not None and room >= slope):
            return False
        there = tuple(slope * p + room * d for p, d in zip(point, towards, strict=True))
        turns = [
            dot(
                normal,
                cross(minus(pts[(k + 1) % len(pts)], pts[k]), minus(there, tuple(unit * slope * c for c in pts[k]))),
            )
            for k in range(len(pts))
        ]
        return all(t > 0 for t in turns) or all(t < 0 for t in turns)

    def ghost(self, solid: int, a: int, b: int, point: Point, unit: int) -> bool:
        """Return True if another part of the object extends the plane of a visible face beyond this point."""
        polyhedron = self.polyhedra[solid]
        if not polyhedron.thing or not self.ghosts:
            return False
        along = minus(self.points[solid][b], self.points[solid][a])
        planes = {self.planes[solid][k] for k in self.edge_faces(solid, a, b)}
        for number, sibling in enumerate(self.polyhedra):
            if number == solid or sibling.thing != polyhedron.thing:
                continue
            for face, plane in zip(sibling.faces, self.planes[number], strict=True):
                if plane in planes and self.eye_side(plane) > 0:
                    for c, d in zip(face, face[1:] + face[:1], strict=True):
                        p, q = (tuple(unit * x for x in self.points[number][k]) for k in (c, d))
                        if (
                            not any(cross(along, minus(q, p)))
                            and not any(cross(minus(point, p), minus(q, p)))
                            and dot(minus(point, p), minus(point, q)) < 0
                        ):
                            return True
        return False

    def seen(self, solid: int, a: int, b: int, s: Fraction) -> bool:
        """Return True if the point at a fraction ``s`` of an edge is drawn."""
        if not any(self.eye_side(self.planes[solid][k]) > 0 for k in self.edge_faces(solid, a, b)):
            return False
        point, unit = self.at(self.points[solid][a], self.points[solid][b], s)
        return not self.ghost(solid, a, b, point, unit) and not self.hidden(point, unit)

    @staticmethod
    def at(p: Point, q: Point, s: Fraction) -> tuple[Point, int]:
        up, down = s.numerator, s.denominator
        return tuple((down - up) * m + up * n for m, n in zip(p, q, strict=True)), down


def places(breaks: list[Fraction], samples: int) -> Iterator[Fraction]:
    """Yield fractions of an edge to test: between all breaks, close to each of them, and at even distances.

    They are never simple fractions, where another edge may begin.
    """
    marks = sorted({Fraction(0), Fraction(1), *breaks})
    for low, high in itertools.pairwise(marks):
        yield low + (high - low) * Fraction(4999, 9973)
        yield low + (high - low) / 9973
        yield high - (high - low) / 9973
    for k in range(samples):
        place = Fraction(2 * k + 1, 2 * samples + 1) + Fraction(1, 9973)
        if place not in marks and 0 < place < 1:
            yield place


def wrong(drawing: Drawing, judge: Judge, samples: int = 3) -> tuple[list[tuple[int, int, int, Fraction]], int]:
    """Return the differences of drawing and judge (polyhedron, edge, fraction), and the number of samples."""
    differences, count = [], 0
    drawn: dict[tuple[int, int, int], list[tuple[Fraction, Fraction]]] = {}
    for piece in drawing.pieces:
        if piece.visible:
            drawn.setdefault((piece.solid, piece.start, piece.end), []).append((piece.first, piece.last))
    edges = [(n, a, b) for n in range(len(judge.polyhedra)) for a, b in judge.edges(n)]
    for n, a, b in edges:
        parts = drawn.pop((n, a, b), [])
        for s in places([end for part in parts for end in part], samples):
            count += 1
            if any(low < s < high for low, high in parts) != judge.seen(n, a, b, s):
                differences.append((n, a, b, s))
    for n, a, b, face in judge.figure_sides():
        parts = drawn.pop((n, a, b), [])
        p, q = (judge.corners[n][place - len(judge.points[n])] for place in (a, b))
        for s in places([end for part in parts for end in part], samples):
            count += 1
            seen = judge.eye_side(judge.planes[n][face]) > 0 and not judge.hidden(*judge.at(p, q, s))
            if any(low < s < high for low, high in parts) != seen:
                differences.append((n, a, b, s))
    assert not drawn, "a line that is no edge and no side of a figure"
    return differences, count
