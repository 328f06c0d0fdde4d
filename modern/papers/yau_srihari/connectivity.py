"""6-connected parts of a volume (section 3.1 asks for a solid of one part)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def components(volume: NDArray[np.bool_]) -> int:
    """How many 6-connected parts the voxels of an array have: the runs along its last axis are joined to those beside
    them until none touches another part."""
    padded = np.zeros(tuple(length + 2 for length in volume.shape), dtype=np.bool_)
    padded[tuple(slice(1, -1) for _ in volume.shape)] = volume
    starts = padded & ~np.roll(padded, 1, axis=-1)
    run = np.cumsum(starts.ravel(), dtype=np.int64).reshape(padded.shape) - 1
    parent = list(range(int(np.count_nonzero(starts))))

    def root(k: int) -> int:
        while parent[k] != k:
            parent[k] = parent[parent[k]]
            k = parent[k]
        return k

    for axis in range(volume.ndim - 1):
        both = padded & np.roll(padded, 1, axis=axis)
        for a, b in np.unique(np.stack((run[both], np.roll(run, 1, axis=axis)[both])), axis=1).T.tolist():
            parent[root(a)] = root(b)
    return sum(parent[k] == k for k in range(len(parent)))
