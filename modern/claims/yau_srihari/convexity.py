"""Checks of Yau and Srihari on convexity: of digital solids, by midpoints and half-cell expansion, and of functions."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import cache
from itertools import combinations, product

import numpy as np

from modern.claims.evidence import Check, claim, holds_if, refuted
from modern.claims.sampled_sets import Point, counterexample_points
from modern.claims.yau_srihari.envelopes import SOLID, array_of
from modern.exact_hull import exact_hull
from modern.papers.yau_srihari.convexity import (
    Place,
    half_cell_expansion,
    is_digitally_convex,
    is_midpoint_convex,
    is_simple,
    midpoint_cover,
    near_span,
    semidigital_segments,
)


@claim("yau-srihari.6", "yau-srihari.20", "yau-srihari.116", "yau-srihari.27")
def definitions_differ() -> Check:
    """Check that two voxels with a common corner are midpoint convex but not a convex solid; a bend is neither."""
    corner, bend = (array_of([(0, 0, 0), (1, 1, 0)]), array_of([(0, 0, 0), (1, 0, 0), (2, 0, 0), (2, 1, 0), (2, 2, 0)]))
    definitions = [(is_midpoint_convex(a), is_digitally_convex(a)) for a in (corner, bend)]
    message = "two voxels with a common corner are convex by 3.2.2 and not by 3.2.3"
    return holds_if(definitions[0] == (True, False) and not definitions[1][1], message)


@claim("yau-srihari.24")
def midpoint_convexity() -> Check:
    """Check covers of one to eight voxels, and that a row with a gap is not convex."""
    sizes = [len(midpoint_cover((0, 0, 0), voxel)) for voxel in ((2, 2, 2), (1, 2, 2), (1, 1, 2), (1, 1, 1))]
    gap = is_midpoint_convex(array_of([(0, 0, 0), (2, 0, 0)]))
    message = f"four pairs of voxels have covers of {', '.join(map(str, sizes))} voxels"
    return holds_if(sizes == [1, 2, 4, 8] and not gap, message)


@claim("yau-srihari.107", "yau-srihari.25")
def midpoint_covers() -> Check:
    """Check that the voxels that contain midpoints of two voxels are exactly those of the cover."""
    quarters = [Fraction(k, 4) for k in range(-2, 2)]
    checks = []
    for voxel in ((2, 2, 2), (1, 2, 2), (1, 1, 2), (1, 1, 1), (3, 0, 1)):
        axes = []
        for c in voxel:
            middles = [(a + c + b) / 2 for a in quarters for b in quarters]
            axes.append({v for m in middles for v in range(-1, 4) if m - Fraction(1, 2) < v <= m + Fraction(1, 2)})
        checks.append(set(product(*axes)) == {*map(tuple, midpoint_cover((0, 0, 0), voxel))})
    return holds_if(all(checks), f"{len(checks)} pairs of voxels agree")


@claim("yau-srihari.26")
def expansion_of_voxel() -> Check:
    """Check that one voxel meets eight voxels of the lattice moved by half a cell."""
    cell_count = int(half_cell_expansion(array_of([(0, 0, 0)])).sum())
    return holds_if(
        cell_count == 8,
        f"the expansion of one voxel has {cell_count} voxels, and that of {len(SOLID)} has "
        f"{int(half_cell_expansion(array_of(SOLID)).sum())}",
    )


@claim("yau-srihari.126")
def convexity_by_expansion() -> Check:
    """Check that expansions of convex solids, and of nine voxels without convexity, pass the test of 3.2.3."""
    nine = [(0, 1, 0), (0, 1, 1), (1, 1, 1), (1, 2, 0), (1, 2, 1), (2, 0, 0), (2, 0, 1), (2, 1, 1), (2, 2, 1)]
    steps: list[Point] = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (1, 1, 1)]
    rows = [steps[:2], steps[:3], steps[1:]]
    arrays = [array_of(row) for row in rows]
    checks = [is_digitally_convex(a) and is_digitally_convex(half_cell_expansion(a)) for a in arrays]
    nonconvex = array_of(nine)
    wider = (
        is_simple(nonconvex)
        and not is_digitally_convex(nonconvex)
        and is_digitally_convex(half_cell_expansion(nonconvex))
    )
    message = f"{len(checks)} convex solids have convex expansions, and so have nine voxels that are not convex"
    return holds_if(all(checks) and wider, message, conditional=True)


@claim("yau-srihari.29")
def simple_with_a_tunnel() -> Check:
    """Check that a ring of twelve voxels around a cube's diagonal is simple although its Euler number is a ring's."""
    array = array_of(counterexample_points("tunnel.csv"))
    cells: set[Point] = set()
    for x, y, z in np.argwhere(array).tolist():
        cells.update((2 * x + i, 2 * y + j, 2 * z + k) for i, j, k in product(range(3), repeat=3))
    euler = sum((-1) ** sum(c % 2 for c in cell) for cell in cells)
    message = f"the solid is simple, but its Euler number is {euler}, and a ball has 1"
    return refuted(is_simple(array) and euler == 0, message)


@claim("yau-srihari.31", kind="semidigital")
@claim("yau-srihari.32", kind="near")
def nearness(kind: str = "semidigital") -> Check:
    """Compare the semidigital points and the near points of the convexity test with their definitions.

    ``semidigital``: points of faces, sampled in thirds, with an integer coordinate that is not constant on the face are
    on the segments of the test, and points on these segments have an integer coordinate. ``near``: on each segment, the
    span of the test contains the points whose distance is less than 1 on every axis.
    """
    judge, checks = exact_hull(SOLID), []
    segments = sorted({(min(ends), max(ends)) for ends in semidigital_segments(judge)})
    if kind == "semidigital":
        for face in judge.facets:
            corners = [SOLID[k] for k in face.polygon]
            # A coordinate that is constant on the whole face does not make a point semidigital.
            axes = [axis for axis in range(3) if len({corner[axis] for corner in corners}) > 1]
            for i, j in ((i, j) for i in range(3) for j in range(4)):
                at = _of_triangle(corners, Fraction(i, 3), Fraction((3 - i) * j, 9))
                on = any(_on_segment(at, *ends) for ends in segments)
                checks.append(on or all(at[axis].denominator > 1 for axis in axes))
                checks.append(not on or any(c.denominator == 1 for c in at))
        message = f"{len(checks) // 2} points of faces and {len(segments)} segments agree"
        return holds_if(all(checks) and segments != [], message)
    for (start, end), voxel in product(segments, SOLID):
        span = near_span(start, end, voxel)
        for t in (Fraction(k, 4) for k in range(5)):
            far = max(abs(a + t * (b - a) - c) for a, b, c in zip(start, end, voxel, strict=True))
            checks.append((far < 1) == (span is not None and span[0] < t < span[1]))
    return holds_if(all(checks), f"{len(checks)} pairs of a point and a voxel agree")


def _of_triangle(corners: list[Point], u: Fraction, v: Fraction) -> Place:
    """Return a point of the triangle of the first three corners."""
    x, y, z = (a + u * (b - a) + v * (c - a) for a, b, c in zip(*corners[:3], strict=True))
    return x, y, z


def _on_segment(point: Place, p: Place, q: Place) -> bool:
    along = [b - a for a, b in zip(p, q, strict=True)]
    gone = [b - a for a, b in zip(p, point, strict=True)]
    share = sum(a * b for a, b in zip(along, gone, strict=True)) / (sum(a * a for a in along) or 1)
    return 0 <= share <= 1 and gone == [share * a for a in along]


Height = Callable[[Fraction, Fraction], Fraction]

# Four convex functions, one of them linear; two more concave functions; and three that are neither.
FUNCTIONS: tuple[Height, ...] = (
    lambda x, y: x * x + y * y,
    lambda x, y: x * x - x * y + y * y,
    lambda x, y: abs(x) + max(y, 2 * y),
    lambda x, y: 3 * x - y,
    lambda x, y: -x * x - 2 * y * y,
    lambda x, y: min(x, y, x - y),
    lambda x, y: x * x - y * y,
    lambda x, y: x * x * x,
    lambda x, y: -abs(abs(x) - 1),
)

SHARES = (Fraction(1, 3), Fraction(1, 2), Fraction(2, 3))

PLACES = tuple((Fraction(x), Fraction(y)) for x in (-2, 0, 1, 3) for y in (-1, 2))


def in_epigraph(f: Height, x: Fraction, y: Fraction, z: Fraction) -> bool:
    return z >= f(x, y)


def in_hypograph(f: Height, x: Fraction, y: Fraction, z: Fraction) -> bool:
    return z <= f(x, y)


@claim("yau-srihari.42", "yau-srihari.117", "yau-srihari.43", "yau-srihari.118")
@claim("yau-srihari.44", kind="negative")
@claim("yau-srihari.47", kind="G+")
@claim("yau-srihari.96", kind="G-")
def convex_functions(kind: str = "segment") -> Check:
    """Check nine functions of two coordinates by the inequality, at shares of 1/3, 1/2 and 2/3 between eight points.

    ``segment``: no chord of a convex function is below the graph, and none of a concave one above. ``negative``: the
    negative of a function is concave if and only if the function is convex. ``G+`` and ``G-``: the epigraph (hypograph)
    of a function is a convex set if and only if the function is convex (concave).
    """
    convex, concave = _kinds()
    message = f"{len(convex)} of {len(FUNCTIONS)} functions are convex and {len(concave)} are concave"
    checks = [(len(convex), len(concave)) == (4, 3)]
    for f in FUNCTIONS:
        if kind == "negative":
            checks.append((f in convex) == all(c <= g for c, g in _chords(_negative(f))))
        elif kind != "segment":
            above = kind == "G+"
            checks.append((f in (convex if above else concave)) == _is_convex_set(f, above))
    return holds_if(all(checks), message)


@cache
def _kinds() -> tuple[list[Height], list[Height]]:
    chords = {f: [*_chords(f)] for f in FUNCTIONS}
    convex = [f for f in FUNCTIONS if all(chord >= graph for chord, graph in chords[f])]
    return convex, [f for f in FUNCTIONS if all(chord <= graph for chord, graph in chords[f])]


def _negative(f: Height) -> Height:
    return lambda x, y: -f(x, y)


def _chords(f: Height) -> Iterator[tuple[Fraction, Fraction]]:
    """Yield heights of chords with the height of the graph at the same point."""
    for (a, b), (c, d) in combinations(PLACES, 2):
        for m in SHARES:
            yield (1 - m) * f(a, b) + m * f(c, d), f((1 - m) * a + m * c, (1 - m) * b + m * d)


def _is_convex_set(f: Height, above: bool) -> bool:
    """Return True if the set contains the points between two of its points, on the graph and at other heights."""
    inside = in_epigraph if above else in_hypograph
    beyond = 1 if above else -1
    ends = [(x, y, f(x, y) + more) for x, y in PLACES for more in (0, beyond)]
    ends = [end for end in (*ends, *((x, y, z - 3 * beyond) for x, y, z in ends)) if inside(f, *end)]
    return all(
        inside(f, *((1 - m) * a + m * b for a, b in zip(p, q, strict=True)))
        for p, q in combinations(ends, 2)
        for m in SHARES
    )
