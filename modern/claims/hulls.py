"""Functions that compute hulls and keep their last results, because many checks examine the same sets."""

from collections.abc import Callable, Iterable
from functools import lru_cache, wraps
from typing import Any, Concatenate, ParamSpec, TypeVar

import numpy as np

import modern.exact_hull
import modern.papers.kovalevsky_schulz
import modern.papers.yau_srihari
import modern.port
from modern.digital.solids import Voxels
from modern.papers.yau_srihari import OctreeHull, Printed

P = ParamSpec("P")
R = TypeVar("R")
# More hulls than the checks need at their quick sizes; the full searches compute many more.
_MOST_HULLS = 1024


def _shared(compute: Callable[Concatenate[Any, P], R]) -> Callable[Concatenate[Iterable[Iterable[Any]], P], R]:
    """Cache the results of a function by its points and its options. The results must be immutable."""
    kept = lru_cache(_MOST_HULLS)(compute)

    @wraps(compute)
    def hull(points: Iterable[Iterable[Any]], /, *args: P.args, **options: P.kwargs) -> R:
        return kept(tuple(map(tuple, points)), *args, **options)  # type: ignore[arg-type]

    return hull


exact_hull = _shared(modern.exact_hull.exact_hull)
convex_hull = _shared(modern.port.convex_hull)
convex_polyhedron = _shared(modern.papers.kovalevsky_schulz.convex_polyhedron)


def octree_hull(region: Voxels, printed: Printed | None = None) -> OctreeHull:
    """Return the digital hull of a region by the algorithm of Yau and Srihari, computed once for each region."""
    return _octree_hull(region.shape, region.tobytes(), printed)


@lru_cache(_MOST_HULLS)
def _octree_hull(shape: tuple[int, ...], voxels: bytes, printed: Printed | None) -> OctreeHull:
    hull = modern.papers.yau_srihari.octree_hull(np.frombuffer(voxels, np.bool_).reshape(shape), printed)
    trees = (hull.lowest, hull.highest, hull.lower.tree, hull.upper.tree)
    for array in (
        hull.filled,
        *(grid for tree in trees for grid in (tree.values, tree.there, tree.marked, tree.sides)),
    ):
        array.flags.writeable = False
    return hull
