"""Checks of the appendix of Kovalevsky and Schulz: abstract cell complexes, on the cells of a block of voxels.

A cell is a triple of topological coordinates: a coordinate is odd inside a voxel and even between two voxels. Subsets
are random. What a definition calls the smallest or the greatest subset is compared with all candidates.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable
from functools import cache
from itertools import combinations, product
from operator import le
from random import Random

import numpy as np

from modern.claims.evidence import Check, claim, holds_if
from modern.claims.kovalevsky_schulz.polyhedra import random_solid, sampled_hulls
from modern.claims.sampled_sets import Point
from modern.papers.kovalevsky_schulz import VERTICES
from modern.papers.kovalevsky_schulz.corners import places

Cells = frozenset[Point]
SIDE = 2
# The cells of a block of two voxels on each side.
SPACE: Cells = frozenset((x, y, z) for x, y, z in product(range(2 * SIDE + 1), repeat=3))
VOXELS: Cells = frozenset(c for c in SPACE if all(x % 2 for x in c))


def dimension(cell: Point) -> int:
    """Return the number of odd coordinates."""
    return sum(x % 2 for x in cell)


@cache
def sides(cell: Point) -> Cells:
    """Return the cells that bound a cell: some of its odd coordinates are decreased or increased by 1."""
    near = product(*((x - 1, x, x + 1) if x % 2 else (x,) for x in cell))
    return frozenset((x, y, z) for x, y, z in near) - {cell}


@cache
def bounded(cell: Point) -> Cells:
    """Return the cells of the block that a cell bounds, found by a search through all cells."""
    return frozenset(candidate for candidate in SPACE if cell in sides(candidate))


def closure(cells: Iterable[Point]) -> Cells:
    """Return the cells and all cells that bound them."""
    return frozenset(c for cell in cells for c in (cell, *sides(cell)))


def star(cells: Iterable[Point]) -> Cells:
    """Return the cells and all cells that they bound."""
    return frozenset(c for cell in cells for c in (cell, *bounded(cell)))


def interior(cells: Cells) -> Cells:
    """Return the cells for which all cells that they bound are present."""
    return frozenset(cell for cell in cells if bounded(cell) <= cells)


@claim("kovalevsky-schulz.178")
def euclidean_cells() -> Check:
    """Check that two cells of the block, as closed boxes, intersect in the box of their greatest common cell."""
    low = {cell: [x - x % 2 for x in cell] for cell in SPACE}
    high = {cell: [x + x % 2 for x in cell] for cell in SPACE}
    meet, checks = 0, []
    for first, second in combinations(sorted(SPACE), 2):
        common = [*map(max, low[first], low[second])], [*map(min, high[first], high[second])]
        if all(map(le, *common)):
            meet += 1
            greatest = max(closure([first]) & closure([second]), key=dimension, default=None)
            checks.append(greatest is not None and (low[greatest], high[greatest]) == common)
    return holds_if(meet > 0 and all(checks), f"{meet} pairs of boxes meet, each in the box of a cell")


def _subsets(count: int = 8) -> list[Cells]:
    random = Random(14)
    cells = sorted(SPACE)
    return [frozenset(random.sample(cells, random.randint(2, 60))) for _ in range(count)]


def _open(cells: Cells) -> bool:
    return all(bounded(cell) <= cells for cell in cells)


def _closed(cells: Cells) -> bool:
    return all(sides(cell) <= cells for cell in cells)


def _incident(a: Point, b: Point) -> bool:
    return a == b or a in sides(b) or b in sides(a)


def _components(cells: Collection[Point]) -> list[set[Point]]:
    remaining, components = set(cells), []
    while remaining:
        component, queue = set[Point](), [remaining.pop()]
        while queue:
            cell = queue.pop()
            component.add(cell)
            near = (sides(cell) | bounded(cell)) & remaining
            remaining -= near
            queue += near
        components.append(component)
    return components


@claim("kovalevsky-schulz.102", "kovalevsky-schulz.136")
def subcomplex() -> Check:
    """Check that the relation restricted to a subset stays irreflexive, antisymmetric and transitive."""
    checks = []
    everywhere = {(a, b) for a in SPACE for b in bounded(a)}
    for cells in _subsets():
        pairs = {(a, b) for b in cells for a in sides(b) & cells}
        checks.append(pairs == {(a, b) for a, b in everywhere if a in cells and b in cells})
        after = {a: {d for c, d in pairs if c == a} for a, _ in pairs}
        checks.append(all(dimension(a) < dimension(b) and (b, a) not in pairs and a != b for a, b in pairs))
        checks.append(all(after.get(b, set()) <= after[a] for a, b in pairs))
    return holds_if(all(checks), f"true for {len(checks) // 3} subsets of the {len(SPACE)} cells of eight voxels")


@claim("kovalevsky-schulz.130")
def sides_of_cell() -> Check:
    """Count the sides of a voxel and of a corner by dimension."""
    counts = Counter(dimension(c) for c in sides((1, 1, 1)))
    message = "a voxel has 26 sides, and a corner has none"
    return holds_if(counts == {0: 8, 1: 12, 2: 6} and not sides((2, 2, 2)), message)


@claim("kovalevsky-schulz.103", "kovalevsky-schulz.105")
def open_and_closed() -> Check:
    """Check that a subset is open if and only if the rest is closed, and that unions and intersections stay open."""
    checks, neither = [], 0
    for cells in _subsets():
        up, down = star(cells), closure(cells)
        checks += [_open(up), _closed(SPACE - up), _closed(down), _open(SPACE - down)]
        neither += not _open(cells) and not _closed(cells)
    for first, second in combinations(map(star, _subsets(4)), 2):
        checks += [_open(first | second), _open(first & second)]
    message = f"{len(checks)} cases hold; {neither} of the random subsets are neither open nor closed"
    return holds_if(all(checks) and neither > 0, message)


@claim("kovalevsky-schulz.104")
def smallest_neighbourhood() -> Check:
    """Check that a cell and all that it bounds form an open subset, which is not open without any of these cells."""
    checks = []
    for cell in SPACE:
        near = star([cell])
        checks.append(_open(near) and all(not _open(near - {neighbour}) for neighbour in near if neighbour != cell))
    inner = star([(2, 2, 2)])
    message = f"true for {len(checks)} cells; the neighbourhood of the middle corner has {len(inner)} cells"
    return holds_if(all(checks) and len(inner) == 27, message)


@claim("kovalevsky-schulz.106")
def smallest_closed_subset() -> Check:
    """Check that the closure of some voxels is closed, and not closed without any cell except the voxels."""
    checks = []
    for voxels in (*combinations(sorted(VOXELS), 2), tuple(VOXELS)):
        whole = closure(voxels)
        checks.append(_closed(whole) and all(not _closed(whole - {c}) for c in whole if c not in voxels))
        corners = {c for c in whole if dimension(c) == 0}
        checks.append(all(corners >= {c for c in sides(v) if dimension(c) == 0} for v in voxels))
    message = f"true for {len(checks) // 2} sets of voxels, whose closures contain all their corners"
    return holds_if(all(checks), message)


@claim("kovalevsky-schulz.107")
def greatest_open_subset() -> Check:
    """Check that the interior is the greatest open subset, and the complement of the closure of the rest."""
    checks = []
    for cells in (*_subsets(4), closure([(1, 1, 1)]), closure([(1, 1, 1), (3, 1, 1)])):
        inside = interior(cells)
        checks.append(_open(inside) and inside == SPACE - closure(SPACE - cells))
        checks.append(all(not star([cell]) <= cells for cell in cells - inside))
    two = {c for c in interior(closure([(1, 1, 1), (3, 1, 1)])) if dimension(c) == 3}
    message = f"true for the interiors of {len(checks) // 2} subsets"
    return holds_if(all(checks) and two == {(1, 1, 1), (3, 1, 1)}, message)


@claim("kovalevsky-schulz.108")
def boundary() -> Check:
    """Check the boundary, the closure of the faces that bound exactly one voxel, for one and for two voxels."""

    def border(voxels: Collection[Point]) -> Cells:
        return closure(c for c in SPACE if dimension(c) == 2 and sum(c in sides(v) for v in voxels) == 1)

    single_voxel, face_neighbours, corner_neighbours = (
        border([(1, 1, 1)]),
        border([(1, 1, 1), (3, 1, 1)]),
        border([(1, 1, 1), (3, 3, 3)]),
    )
    passed = (
        single_voxel == sides((1, 1, 1)) and (2, 1, 1) not in face_neighbours and len(face_neighbours) == 10 + 20 + 12
    )
    passed &= corner_neighbours == sides((1, 1, 1)) | sides((3, 3, 3)) and all(
        map(_closed, (single_voxel, face_neighbours, corner_neighbours))
    )
    return holds_if(passed, "true for one voxel, two voxels with a common face, and two voxels with a common corner")


@claim("kovalevsky-schulz.158", "kovalevsky-schulz.43", "kovalevsky-schulz.109")
@claim("kovalevsky-schulz.142", kind="patch")
def manifold(kind: str = "") -> Check:
    """Check that the edges and faces around a vertex form a ring, and a row at the rim of a ``patch``."""
    checks, rows = [], 0
    for _, judge in sampled_hulls():
        rings = [facet.polygon for facet in judge.facets][1 if kind else 0 :]
        rim = {*judge.facets[0].polygon}
        for vertex in judge.vertices:
            around = Counter(end for ring in rings if vertex in ring for end in _beside(ring, vertex))
            faces = sum(vertex in ring for ring in rings)
            # At the rim two edges have only one face of the patch, so there is one edge more than faces.
            row = len(around) == faces + 1 and sorted(around.values())[:2] == [1, 1]
            rows += row
            closed = len(around) == faces and {*around.values()} == {2}
            checks.append((row if kind and vertex in rim else closed) and bool(faces))
    message = f"true for {len(checks)} vertices"
    message = f"{message}, {rows} of them at the rim of a patch" if kind else message
    return holds_if(all(checks) and bool(kind) == (rows > 0), message)


def _beside(ring: tuple[int, ...], vertex: int) -> tuple[int, int]:
    k = ring.index(vertex)
    return ring[k - 1], ring[(k + 1) % len(ring)]


@claim("kovalevsky-schulz.111", "kovalevsky-schulz.141")
@claim("kovalevsky-schulz.113", kind="region")
def connected(kind: str = "") -> Check:
    """Check that the smallest relation with the recursion of the definition is that of steps between incident cells.

    ``region``: a star is open and connected, and two distant stars are open and not connected.
    """
    if kind:
        one_star, two_stars = star([(2, 2, 2)]), star([(1, 1, 1)]) | star([(3, 3, 3)])
        passed = (
            _open(one_star)
            and len(_components(one_star)) == 1
            and _open(two_stars)
            and len(_components(two_stars)) == 2
        )
        return holds_if(passed, "the neighbourhood of a corner is a region, and two voxels without their sides are not")
    good_ones = []
    for cells in (frozenset(sorted(s)[:14]) for s in _subsets(3)):
        related = {(a, b) for a in cells for b in cells if _incident(a, b)}
        # Close the incidence relation transitively, as the recursion of the definition does.
        while more := {(a, d) for a, b in related for c, d in related if b == c} - related:
            related |= more
        parts = _components(cells)
        good_ones.append(related == {(a, b) for part in parts for a in part for b in part})
    return holds_if(all(good_ones), f"{len(good_ones)} subsets have the same components")


@claim("kovalevsky-schulz.114")
def solid() -> Check:
    """Check that interiors of closed sets of voxels are solid, and that a block without its middle corner is not."""

    def is_solid(region: Cells) -> bool:
        outside = VOXELS - region
        return all(any(_incident(cell, voxel) for voxel in outside) for cell in SPACE - region)

    checks = [
        is_solid(interior(closure(voxels))) for voxels in ([(1, 1, 1)], [(1, 1, 1), (1, 3, 1)], sorted(VOXELS)[:7])
    ]
    holed = SPACE - closure([(2, 2, 2)])
    checks += [_open(holed), len(_components(holed)) == 1, not is_solid(holed)]
    return holds_if(all(checks), "three regions are solid and one is not")


@claim("kovalevsky-schulz.115")
def half_space() -> Check:
    """Check that voxels that satisfy an inequality form an open, connected and solid subset with the cells between
    them.
    """
    checks = []
    for a, b, c, d in ((1, 0, 0, 2), (1, 1, 0, 4), (1, 2, 3, 10), (1, 1, 1, 7)):
        voxels = {v for v in VOXELS if a * v[0] + b * v[1] + c * v[2] <= d}
        region = interior(closure(voxels))
        outside = VOXELS - region
        rest = all(any(_incident(cell, voxel) for voxel in outside) for cell in SPACE - region)
        checks.append(_open(region) and len(_components(region)) == 1 and rest and region & VOXELS == voxels)
    return holds_if(all(checks), f"{len(checks)} half-spaces of the block are open, connected and solid")


@claim("kovalevsky-schulz.116", "kovalevsky-schulz.117")
def topological_line() -> Check:
    """Check a line of cells 0 to 2n, in which even cells bound odd ones: all but the ends have two incident cells."""
    line = range(2 * SIDE + 1)
    near = {x: [y for y in line if abs(x - y) == 1] for x in line}
    product_pairs = {
        (a, b) for a in SPACE for b in SPACE if a != b and all(_in_line(x, y) for x, y in zip(a, b, strict=True))
    }
    passed = sorted(map(len, near.values())) == [1, 1] + [2] * (len(line) - 2)
    passed &= all(near[x] == [x - 1, x + 1] for x in line[1:-1])
    passed &= product_pairs == {(a, b) for b in SPACE for a in sides(b) & SPACE}
    message = f"a line has {len(line)} cells; the product of three lines has {len(product_pairs)} bounding pairs"
    return holds_if(passed, message)


def _in_line(x: int, y: int) -> bool:
    return x == y or (y % 2 == 1 and abs(x - y) == 1)


@claim("kovalevsky-schulz.152", "kovalevsky-schulz.140", kind="incident")
@claim("kovalevsky-schulz.139", kind="access")
@claim("kovalevsky-schulz.119", "kovalevsky-schulz.137", "kovalevsky-schulz.138", kind="shared")
def raster(kind: str) -> Check:
    """Check one statement about rasters.

    ``access``: the topological raster has one element for each cell. ``incident``: neighbours by coordinates are those
    found by a search. ``shared``: in the standard raster eight cells share a voxel, those that are not farther from the
    origin.
    """
    if kind == "access":
        array = np.zeros((2 * SIDE + 1,) * 3, dtype=np.int64)
        for number, cell in enumerate(sorted(SPACE), 1):
            array[cell] = number
        message = f"{array.size} elements for {len(SPACE)} cells"
        return holds_if(len({*array.ravel().tolist()}) == array.size == len(SPACE), message)
    if kind == "incident":
        checks = []
        for cell in SPACE:
            near = {(x, y, z) for x, y, z in product(*((x - 1, x, x + 1) for x in cell))} & SPACE
            incident = {c for c in near if all(_in_line(x, y) for x, y in zip(c, cell, strict=True))}
            incident |= {c for c in near if all(_in_line(y, x) for x, y in zip(c, cell, strict=True))}
            checks.append(incident == {c for c in SPACE if _incident(c, cell)})
        message = f"for {len(checks)} cells the incident cells by coordinates are those found by a search"
        return holds_if(all(checks), message)
    held: dict[Point, list[int]] = {}
    for cell in SPACE:
        farthest = max(star([cell]) & VOXELS, default=None, key=sum)
        if farthest and all(f >= c for f, c in zip(farthest, cell, strict=True)):
            held.setdefault(farthest, []).append(dimension(cell))
    eight = {tuple(sorted(of)) for of in held.values()} == {(0, 1, 1, 1, 2, 2, 2, 3)} and len(held) == len(VOXELS)
    return holds_if(eight, "eight cells of four dimensions share the coordinates of one voxel")


@claim("kovalevsky-schulz.24", "kovalevsky-schulz.112")
def cells_incident_to_voxels() -> Check:
    """Check that each corner, edge and face in the closure of some voxels is incident to one of them."""
    volume = random_solid(2, 3)
    voxels = [tuple(2 * x + 1 for x in v) for v in volume.coordinates().tolist()]
    whole = {c for v in voxels for c in (v, *sides(v))}
    corners = {tuple(2 * x for x in c) for c in np.argwhere(places(volume, VERTICES)).tolist()}
    counts = Counter(dimension(c) for c in whole)
    passed = corners == {c for c in whole if not any(x % 2 for x in c)}
    passed &= all(any(max(abs(a - b) for a, b in zip(c, v, strict=True)) <= 1 for v in voxels) for c in whole)
    loose = whole | {(99, 98, 98)}
    bad = [c for c in loose if not any(max(abs(a - b) for a, b in zip(c, v, strict=True)) <= 1 for v in voxels)]
    message = (
        f"{counts[0]} corners, {counts[1]} edges and {counts[2]} faces are incident to voxels; an added edge "
        "is detected"
    )
    return holds_if(passed and bad == [(99, 98, 98)], message)
