"""Checks of Yau and Srihari on the convexity of digital solids: three definitions, and simple solids."""

from itertools import product

import numpy as np

from modern.claims.evidence import Check, claim, exhibited, refuted
from modern.claims.sampled_sets import Point, counterexample_points
from modern.claims.yau_srihari.envelopes import array_of
from modern.papers.yau_srihari.convexity import (
    half_cell_expansion,
    is_digitally_convex,
    is_midpoint_convex,
    is_simple,
)


@claim("yau-srihari.6", "yau-srihari.116")
def definitions_differ() -> Check:
    """Check that two voxels with a common corner are midpoint convex but not a convex solid; a bend is neither."""
    corner, bend = (array_of([(0, 0, 0), (1, 1, 0)]), array_of([(0, 0, 0), (1, 0, 0), (2, 0, 0), (2, 1, 0), (2, 2, 0)]))
    definitions = [(is_midpoint_convex(a), is_digitally_convex(a)) for a in (corner, bend)]
    message = "two voxels with a common corner are convex by 3.2.2 and not by 3.2.3"
    return exhibited(definitions[0] == (True, False) and not definitions[1][1], message)


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
    return exhibited(all(checks), f"{len(checks)} convex solids have convex expansions").unless(
        wider, "nine voxels that are not convex and whose expansion passes the test as well"
    )


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
