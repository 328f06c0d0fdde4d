"""Claims of Yau and Srihari on convexity: digital, by midpoints and by half-cell expansion, and of functions."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import cache
from itertools import combinations, product

import numpy as np

from modern.claims.register import CheckResult, fails_if, holds_if
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


def definitions_differ() -> CheckResult:
    """Two voxels at a corner are midpoint convex and not a convex solid; a bend is neither."""
    corner, bend = (
        array_of([(0, 0, 0), (1, 1, 0)]),
        array_of([(0, 0, 0), (1, 0, 0), (2, 0, 0), (2, 1, 0), (2, 2, 0)]),
    )
    definitions = [(is_midpoint_convex(a), is_digitally_convex(a)) for a in (corner, bend)]
    return holds_if(
        definitions[0] == (True, False) and not definitions[1][1],
        "two voxels at a corner: by 3.2.2 convex, by 3.2.3 not",
    )


def midpoint_convexity() -> CheckResult:
    """Covers of one to eight voxels; a gap in a row is not convex."""
    sizes = [len(midpoint_cover((0, 0, 0), voxel)) for voxel in ((2, 2, 2), (1, 2, 2), (1, 1, 2), (1, 1, 1))]
    gap = is_midpoint_convex(array_of([(0, 0, 0), (2, 0, 0)]))
    return holds_if(sizes == [1, 2, 4, 8] and not gap, f"covers of {', '.join(map(str, sizes))} voxels")


def midpoint_covers() -> CheckResult:
    """Voxels that hold midpoints of quarters of two voxels: just those of the cover."""
    quarters = [Fraction(k, 4) for k in range(-2, 2)]
    checks = []
    for voxel in ((2, 2, 2), (1, 2, 2), (1, 1, 2), (1, 1, 1), (3, 0, 1)):
        axes = []
        for c in voxel:
            middles = [(a + c + b) / 2 for a in quarters for b in quarters]
            axes.append({v for m in middles for v in range(-1, 4) if m - Fraction(1, 2) < v <= m + Fraction(1, 2)})
        checks.append(set(product(*axes)) == {*map(tuple, midpoint_cover((0, 0, 0), voxel))})
    return holds_if(all(checks), f"{len(checks)} pairs of voxels")


def expansion_of_voxel() -> CheckResult:
    """One voxel meets eight of the lattice moved by half a cell."""
    cell_count = int(half_cell_expansion(array_of([(0, 0, 0)])).sum())
    return holds_if(
        cell_count == 8, f"{cell_count} of one voxel, {int(half_cell_expansion(array_of(SOLID)).sum())} of {len(SOLID)}"
    )


def convexity_by_expansion() -> CheckResult:
    """Solids and their half-cell expansions by the convexity test of 3.2.3: of a convex one the expansion passes too.

    So does that of nine voxels that are simple and not convex.
    """
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
    message = (
        f"{len(checks)} convex solids and their expansions; nine voxels that are not convex and whose expansion is"
    )
    return holds_if(all(checks) and wider, message, conditional=True)


def simple_with_a_tunnel() -> CheckResult:
    """A ring of twelve voxels around a cube's diagonal: simple, and its Euler number is that of a ring."""
    array = array_of(counterexample_points("tunnel.csv"))
    cells: set[Point] = set()
    for x, y, z in np.argwhere(array).tolist():
        cells.update((2 * x + i, 2 * y + j, 2 * z + k) for i, j, k in product(range(3), repeat=3))
    euler = sum((-1) ** sum(c % 2 for c in cell) for cell in cells)
    return fails_if(is_simple(array) and euler == 0, f"simple, and its Euler number is {euler}, a ball's is 1")


def nearness(kind: str = "semidigital") -> CheckResult:
    """What the convexity test takes for semidigital, or near, on the faces of a solid's hull, by the definition.

    ``semidigital``: of thirds of its faces those with a whole coordinate, not counting one that the face has all
    over, are on the test's segments, and all that are have one.  ``near``: on each segment, the points of the test's
    span are those less than 1 away on every axis.
    """
    judge, checks = exact_hull(SOLID), []
    segments = sorted({(min(ends), max(ends)) for ends in semidigital_segments(judge)})
    if kind == "semidigital":
        for face in judge.facets:
            corners = [SOLID[k] for k in face.polygon]
            axes = [axis for axis in range(3) if len({corner[axis] for corner in corners}) > 1]
            for i, j in ((i, j) for i in range(3) for j in range(4)):
                at = _of_triangle(corners, Fraction(i, 3), Fraction((3 - i) * j, 9))
                on = any(_on_segment(at, *ends) for ends in segments)
                checks.append(on or all(at[axis].denominator > 1 for axis in axes))
                checks.append(not on or any(c.denominator == 1 for c in at))
        return holds_if(all(checks) and segments != [], f"{len(checks) // 2} points of faces, {len(segments)} segments")
    for (start, end), voxel in product(segments, SOLID):
        span = near_span(start, end, voxel)
        for t in (Fraction(k, 4) for k in range(5)):
            far = max(abs(a + t * (b - a) - c) for a, b, c in zip(start, end, voxel, strict=True))
            checks.append((far < 1) == (span is not None and span[0] < t < span[1]))
    return holds_if(all(checks), f"{len(checks)} points against voxels")


def _of_triangle(corners: list[Point], u: Fraction, v: Fraction) -> Place:
    """A point of the triangle of the first three corners."""
    x, y, z = (a + u * (b - a) + v * (c - a) for a, b, c in zip(*corners[:3], strict=True))
    return x, y, z


def _on_segment(point: Place, p: Place, q: Place) -> bool:
    """Whether a point lies between two others or on one of them."""
    along = [b - a for a, b in zip(p, q, strict=True)]
    gone = [b - a for a, b in zip(p, point, strict=True)]
    share = sum(a * b for a, b in zip(along, gone, strict=True)) / (sum(a * a for a in along) or 1)
    return 0 <= share <= 1 and gone == [share * a for a in along]


Height = Callable[[Fraction, Fraction], Fraction]

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
"""Convex, both (of the first degree), concave, and neither."""

SHARES = (Fraction(1, 3), Fraction(1, 2), Fraction(2, 3))

PLACES = tuple((Fraction(x), Fraction(y)) for x in (-2, 0, 1, 3) for y in (-1, 2))


def in_epigraph(f: Height, x: Fraction, y: Fraction, z: Fraction) -> bool:
    """Whether a point is in G+(f)."""
    return z >= f(x, y)


def in_hypograph(f: Height, x: Fraction, y: Fraction, z: Fraction) -> bool:
    """Whether a point is in G-(f)."""
    return z <= f(x, y)


def convex_functions(kind: str = "segment") -> CheckResult:
    """Nine functions of two coordinates by the inequality, at shares of 1/3, 1/2 and 2/3 between eight places.

    ``segment``: of a convex one no chord is below the graph, of a concave one none above.  ``negative``: the negative
    of a convex one, and of no other, is concave.  ``G+``, ``G-``: epigraph, or hypograph, of just the convex, or the
    concave, ones holds what lies between two of its points, at heights from the graph on.
    """
    convex, concave = _kinds()
    message = f"{len(convex)} convex, {len(concave)} concave of {len(FUNCTIONS)}"
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
    """Which of the functions are convex, and which are concave."""
    chords = {f: [*_chords(f)] for f in FUNCTIONS}
    convex = [f for f in FUNCTIONS if all(chord >= graph for chord, graph in chords[f])]
    return convex, [f for f in FUNCTIONS if all(chord <= graph for chord, graph in chords[f])]


def _negative(f: Height) -> Height:
    return lambda x, y: -f(x, y)


def _chords(f: Height) -> Iterator[tuple[Fraction, Fraction]]:
    """Heights of chords and of the graph below or above them."""
    for (a, b), (c, d) in combinations(PLACES, 2):
        for m in SHARES:
            yield (1 - m) * f(a, b) + m * f(c, d), f((1 - m) * a + m * c, (1 - m) * b + m * d)


def _is_convex_set(f: Height, above: bool) -> bool:
    """Whether the points between two of the set are of the set, at the ends' own heights and one beyond."""
    inside = in_epigraph if above else in_hypograph
    beyond = 1 if above else -1
    ends = [(x, y, f(x, y) + more) for x, y in PLACES for more in (0, beyond)]
    ends = [end for end in (*ends, *((x, y, z - 3 * beyond) for x, y, z in ends)) if inside(f, *end)]
    return all(
        inside(f, *((1 - m) * a + m * b for a, b in zip(p, q, strict=True)))
        for p, q in combinations(ends, 2)
        for m in SHARES
    )
