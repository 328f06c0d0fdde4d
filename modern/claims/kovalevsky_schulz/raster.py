"""Checks of Kovalevsky and Schulz on rasters: voxels, their corners, names of corners, and local corners."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from itertools import product

import numpy as np

from modern.claims.evidence import Check, claim, holds_if, refuted
from modern.claims.kovalevsky_schulz.complexes import closure, dimension
from modern.claims.kovalevsky_schulz.polyhedra import random_solid
from modern.claims.sampled_sets import Point, counterexample_points
from modern.digital.solids import Volume, half_ball, listed
from modern.exact_hull import exact_hull
from modern.papers.kovalevsky_schulz import CENTRES, VERTICES, local_corners
from modern.papers.kovalevsky_schulz.corners import places

STEPS: tuple[Point, ...] = tuple((x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1))


def _placed(volume: Volume, of: str) -> set[Point]:
    """Return the coordinates of the voxels of a volume as indices of the array that the program uses."""
    array = places(volume, CENTRES if of == CENTRES else VERTICES)
    return {(x, y, z) for x, y, z in np.argwhere(array).tolist()}


@claim("kovalevsky-schulz.12", "kovalevsky-schulz.13")
@claim("kovalevsky-schulz.25", kind="first")
def corners_against_centres(kind: str = "") -> Check:
    """Check that the hull of the corners is that of the centres with a cube about each, in half units."""
    checks, sizes = [], []
    for volume in (random_solid(1, 3), listed([(0, 0, 0), (1, 0, 0), (1, 1, 0)]), half_ball(8)):
        voxels, corners = _placed(volume, CENTRES), _placed(volume, VERTICES)
        if kind:
            cells = {(2 * x + 1, 2 * y + 1, 2 * z + 1) for x, y, z in voxels}
            voxel_vertices = {tuple(c // 2 for c in cell) for cell in closure(cells) if dimension(cell) == 0}
            checks += [corners == voxel_vertices, {tuple(c // 2 for c in cell) for cell in cells} == voxels]
            sizes.append(f"{len(voxels)} and {len(corners)}")
            continue
        # A centre has odd coordinates in half units; its cube has the eight even corners around it.
        grown = [(2 * x + 2 * i, 2 * y + 2 * j, 2 * z + 2 * k) for x, y, z in sorted(voxels) for i, j, k in STEPS]
        outer, inner = exact_hull([(2 * x, 2 * y, 2 * z) for x, y, z in sorted(corners)]), exact_hull(grown)
        checks.append({f.plane for f in outer.facets} == {f.plane for f in inner.facets})
        middles = [(2 * x + 1, 2 * y + 1, 2 * z + 1) for x, y, z in sorted(voxels)]
        most = [max(_value(outer.scale, plane.plane, middle) for plane in outer.facets) for middle in middles]
        checks.append(max(most) < 0)
        sizes.append(f"{len(middles)} within {len(corners)}")
    return holds_if(all(checks), f"numbers of centres and corners: {', '.join(sizes)}")


def _value(scale: int, plane: tuple[int, ...], point: Point) -> int:
    return sum(n * scale * c for n, c in zip(plane, point, strict=False)) + plane[3]


@claim("kovalevsky-schulz.27")
@claim("kovalevsky-schulz.133", "kovalevsky-schulz.134", "kovalevsky-schulz.135", "kovalevsky-schulz.118", kind="cells")
def topological_raster(kind: str = "") -> Check:
    """Count the (2n + 1)^3 cells of a cube of n voxels on each side, and check their dimensions."""
    if kind == "cells":
        counts = Counter(sum(c % 2 for c in cell) for cell in product(range(3), repeat=3))
        return holds_if(counts == {0: 8, 1: 12, 2: 6, 3: 1}, "one voxel has 8 corners, 12 edges, 6 faces and 1 body")
    ratios = {n: Fraction(cells_of(n), n**3) for n in (1, 10, 100)}
    passed = all(ratio > 8 for ratio in ratios.values()) and ratios[100] < Fraction(82, 10)
    return holds_if(passed, ", ".join(f"n = {n}: {float(r):.2f} times" for n, r in ratios.items()), conditional=True)


def cells_of(n: int) -> int:
    """Return the number of cells of a cube of n voxels on each side, including its border."""
    return len(range(2 * n + 1)) ** 3


@claim("kovalevsky-schulz.28", "kovalevsky-schulz.29", "kovalevsky-schulz.30")
def corner_of_single_voxel() -> Check:
    """Check corners of the counterexample that bound a single voxel but are not local corners by 6 neighbours."""
    volume = listed(counterexample_points("two_voxels.csv"))
    corners = {*map(tuple, local_corners(volume, VERTICES, 6).tolist())}
    array = np.pad(volume.array, 1)
    single = {
        (x, y, z)
        for x, y, z in np.argwhere(places(volume, VERTICES)).tolist()
        if array[x : x + 2, y : y + 2, z : z + 2].sum() == 1
    }
    wrong = single - corners
    message = f"corners that bound one voxel and are not local: {', '.join(map(str, sorted(wrong)))}"
    return refuted(wrong and corners <= single, message)


@claim("kovalevsky-schulz.32")
@claim("kovalevsky-schulz.33", kind="figure")
def farthest_voxel_of_corner(kind: str = "") -> Check:
    """Check that the farthest voxel at a corner has the coordinates of the corner, so that corners differ in name."""
    flat, size = bool(kind), 3
    raster = {(x, y, z) for x in range(size) for y in range(size) for z in range(1 if flat else size)}
    named: dict[Point, Point] = {}
    for x, y, z in _placed(listed(sorted(raster)), VERTICES):
        beside = {(x - i, y - j, z - k) for i, j, k in STEPS} & raster
        if not (flat and z):
            named[x, y, z] = max(beside, key=lambda c: c[0] ** 2 + c[1] ** 2 + c[2] ** 2)
    within = {corner: voxel for corner, voxel in named.items() if size not in corner}
    border = [voxel for corner, voxel in named.items() if size in corner]
    passed = all(corner == voxel for corner, voxel in within.items()) and {*within.values()} == raster
    passed &= len(within) == len(raster) and {*border} <= raster and len(border) == (7 if flat else 37)
    message = f"{len(within)} corners have their own voxels; {len(border)} corners at the border of the space share one"
    return holds_if(passed, message)


@claim("kovalevsky-schulz.174")
def additional_labels() -> Check:
    """Check that exactly the elements behind a voxel, seen from the origin, become labelled in addition."""
    checks, labelled_count = [], 0
    for volume in (random_solid(2, 3), half_ball(8), listed([(0, 0, 0), (1, 0, 0), (1, 1, 0)])):
        voxels = _placed(volume, CENTRES)
        labelled = _placed(volume, VERTICES) - voxels
        beside = {(x + i, y + j, z + k) for x, y, z in voxels for i, j, k in product((-1, 0, 1), repeat=3)} - voxels
        checks.append(labelled <= beside)
        for x, y, z in beside:
            behind = {(x - i, y - j, z - k) for i, j, k in STEPS} & voxels
            checks.append(((x, y, z) in labelled) == bool(behind))
        labelled_count += len(labelled)
    message = f"{labelled_count} elements become labelled, each behind a voxel as seen from the origin"
    return holds_if(all(checks), message)


@claim("kovalevsky-schulz.175")
def edges_at_corner() -> Check:
    """Check that a 0-cell of a Cartesian complex has at most four 1-cells in the plane and six in space."""
    numbers = {}
    for dimensions in (2, 3):
        cells = [*product(range(5), repeat=dimensions)]
        corners = [c for c in cells if not any(x % 2 for x in c)]
        numbers[dimensions] = max(sum(ends_at(edge, corner) for edge in cells) for corner in corners)
    message = f"{numbers[2]} edges in the plane and {numbers[3]} in space"
    return holds_if(numbers == {2: 4, 3: 6}, message, conditional=True)


def ends_at(edge: tuple[int, ...], corner: tuple[int, ...]) -> bool:
    """Return True if a cell has one odd coordinate and is next to a 0-cell."""
    return sum(x % 2 for x in edge) == 1 == sum(abs(a - b) for a, b in zip(edge, corner, strict=True))


@claim("kovalevsky-schulz.154", kind="edge")
@claim("kovalevsky-schulz.155", kind="more")
def corners_of_eight_voxels(kind: str) -> Check:
    """Check the neighbours of a corner for all subsets of its eight voxels.

    ``more``: with two or more voxels some pair of opposite neighbours is present. ``edge``: if an edge at the corner is
    one of two collinear ones, there are at least two voxels. ``first``: with a single voxel no such pair is present.
    """
    checks = []
    for there in product((False, True), repeat=8):
        voxels = [v for v, here in zip(product((0, 1), repeat=3), there, strict=True) if here]
        near = {cell for voxel in voxels for cell in _neighbours(voxel)}
        pairs = [tuple(side if k == axis else 2 for k in range(3)) for axis in range(3) for side in (0, 1)]
        opposite = [pairs[2 * axis] in near and pairs[2 * axis + 1] in near for axis in range(3)]
        if kind == "more":
            checks += [any(opposite)] if len(voxels) > 1 else []
        elif kind == "edge":
            checks += [len(voxels) > 1] if any(opposite) else []
        else:
            checks += [not any(opposite)] if len(voxels) == 1 else []
    return holds_if(all(checks), f"true for {len(checks)} of the 256 subsets of eight voxels")


def _neighbours(voxel: tuple[int, ...]) -> list[tuple[int, ...]]:
    """Return the neighbours of the corner among the corners of a voxel: 0 or 1 on one axis and 2 on the others."""
    return [tuple(voxel[k] if k == axis else 2 for k in range(3)) for axis in range(3)]
