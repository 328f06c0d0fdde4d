"""Random scenes for tests of hidden lines: disjoint polyhedra in the cells of a grid, and solids cut into parts."""

import random
from fractions import Fraction

from modern.exact_hull import exact_hull
from modern.papers.nakamae_nishita.polyhedron import Polyhedron
from modern.papers.nakamae_nishita.shapes import (
    column,
    cuboid,
    moved,
    parallelepiped,
    placed,
    plate,
    round_base,
    turned,
)

Vector = tuple[Fraction, Fraction, Fraction]
CELL = 6


def vector(x, y, z) -> Vector:
    return Fraction(x), Fraction(y), Fraction(z)


def hull_of(points: list[Vector], name: str, thing: str = "") -> Polyhedron | None:
    hull = exact_hull(points)
    if hull.dimension < 3:
        return None
    place = {index: k for k, index in enumerate(hull.vertices)}
    faces = tuple(tuple(place[index] for index in facet.polygon[::-1]) for facet in hull.facets)
    return Polyhedron(name, tuple(points[index] for index in hull.vertices), faces, thing)


def random_shape(source: random.Random, name: str) -> Polyhedron:
    """Return a shape whose coordinates are mostly between -2 and 2."""
    kind = source.randrange(6)
    if kind == 0:
        size = [Fraction(source.randint(2, 8), 2) for _ in range(3)]
        return placed(cuboid(name, *size), moved(vector(*(-s / 2 for s in size))), name)
    if kind == 1:
        box = placed(cuboid(name, *vector(2, source.randint(1, 3), 3)), moved(vector(-1, -1, -2)), name)
        return placed(box, turned(Fraction(source.randint(0, 359))), name)
    if kind == 2:
        base = round_base(name, source.randint(3, 8), Fraction(source.randint(2, 4), 2))
        return placed(column(name, base, vector(0, 0, source.randint(1, 3))), moved(vector(0, 0, -1)), name)
    if kind == 3:
        corners = [vector(p[0], p[1], p[0] / 3) for p in round_base(name, source.randint(3, 6), Fraction(2))]
        return plate(name, corners)
    if kind == 4:
        slanted = parallelepiped(name, vector(2, 1, 0), vector(-1, 2, 0), vector(0, source.randint(-1, 1), 2))
        return placed(slanted, moved(vector(Fraction(-1, 2), Fraction(-3, 2), -1)), name)
    while True:
        points = [vector(*(source.randint(-2, 2) for _ in range(3))) for _ in range(source.randint(4, 9))]
        hull = hull_of(points, name)
        if hull:
            return hull


def apart(seed: int, most: int = 14) -> list[Polyhedron]:
    """Return shapes in different cells of a grid, so that no two of them touch."""
    source = random.Random(seed)
    cells = [(i, j, k) for i in range(3) for j in range(3) for k in range(3)]
    shapes = []
    for number, cell in enumerate(source.sample(cells, source.randint(2, most))):
        shift = vector(*(CELL * c + Fraction(source.randint(-4, 4), 10) for c in cell))
        shapes.append(placed(random_shape(source, f"p{number}"), moved(shift), f"p{number}"))
    return shapes


def blocks(seed: int, cuts: int = 9, size: int = 4) -> list[Polyhedron]:
    """Return the parts of a block cut into cuboids with integer corners, without some of them, as up to two objects."""
    source = random.Random(seed)
    parts = [((0, 0, 0), (size, size, size))]
    for _ in range(cuts):
        low, high = parts.pop(source.randrange(len(parts)))
        axes = [k for k in range(3) if high[k] - low[k] > 1]
        if not axes:
            parts.append((low, high))
            continue
        axis = source.choice(axes)
        at = source.randint(low[axis] + 1, high[axis] - 1)
        parts.append((low, tuple(at if k == axis else high[k] for k in range(3))))
        parts.append((tuple(at if k == axis else low[k] for k in range(3)), high))
    remaining = [part for part in parts if source.random() < 0.8]
    polyhedra = []
    for number, (low, high) in enumerate(remaining):
        name = f"b{number}"
        box = placed(cuboid(name, *vector(*(b - a for a, b in zip(low, high, strict=True)))), moved(vector(*low)), name)
        thing = source.choice(["", "one", "one", "two"])
        polyhedra.append(Polyhedron(name, box.vertices, box.faces, thing))
    return polyhedra


def cut(polyhedron: Polyhedron, normal: Vector, distance: Fraction) -> list[Polyhedron]:
    """Return the two parts of a polyhedron on either side of a plane, or the polyhedron if it is on one side."""
    heights = [sum(n * c for n, c in zip(normal, p, strict=True)) - distance for p in polyhedron.vertices]
    between = []
    for face in polyhedron.faces:
        for a, b in zip(face, face[1:] + face[:1], strict=True):
            if heights[a] < 0 < heights[b]:
                s = heights[a] / (heights[a] - heights[b])
                p, q = polyhedron.vertices[a], polyhedron.vertices[b]
                between.append(vector(*(x + s * (y - x) for x, y in zip(p, q, strict=True))))
    parts = []
    for side in (-1, 1):
        points = [p for p, h in zip(polyhedron.vertices, heights, strict=True) if h * side >= 0] + between
        part = hull_of(points, polyhedron.name, polyhedron.thing) if len(points) > 3 else None
        if part:
            parts.append(part)
    return parts


def shards(seed: int, cuts: int = 4) -> list[Polyhedron]:
    """Return the parts of a cuboid cut by random planes, which touch in faces, edges and vertices."""
    source = random.Random(seed)
    parts = [placed(cuboid("s", *vector(4, 4, 4)), moved(vector(-2, -2, -2)), "s")]
    for _ in range(cuts):
        normal = vector(*(source.randint(-3, 3) for _ in range(3)))
        if any(normal):
            distance = Fraction(source.randint(-4, 4), 2)
            parts = [
                piece for part in parts for piece in (cut(part, normal, distance) if source.random() < 0.8 else [part])
            ]
    remaining = [part for part in parts if source.random() < 0.85] or parts
    return [
        Polyhedron(f"s{n}", part.vertices, part.faces, source.choice(["", "one", "one"]))
        for n, part in enumerate(remaining)
    ]


def direction(source: random.Random) -> tuple[int, int, int]:
    """Return a direction, often one in which faces are edge-on and the images of edges coincide."""
    if source.random() < 0.4:
        return source.choice(
            [(1, 0, 0), (0, -1, 0), (0, 0, 1), (1, 1, 0), (1, -1, 1), (2, 1, 1), (1, -2, 0), (3, 3, 1)]
        )
    while True:
        eye = tuple(source.randint(-9, 9) for _ in range(3))
        if any(eye):
            return eye
