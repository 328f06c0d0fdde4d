"""A hull as a ``trimesh.Trimesh``, for those who have that package; it is not needed for anything else."""

from __future__ import annotations

import importlib
from typing import Any

from modern.geometry.hull import Hull
from modern.geometry.mesh import ExportError, mesh


def to_trimesh(hull: Hull) -> Any:
    """A ``trimesh.Trimesh`` of the hull's vertices in their order and its faces cut into triangles.

    Coordinates are rounded to the nearest binary float; nothing is merged or reordered (``process=False``).
    Raises ExportError where trimesh is not installed, for a hull without area and for numbers too large for a float.
    """
    surface = mesh(hull)
    if surface.dimension < 2:
        raise ExportError(f"a Trimesh holds triangles; the hull has dimension {surface.dimension} and no area")
    try:
        trimesh = importlib.import_module("trimesh")
    except ImportError:
        raise ExportError("to_trimesh needs the package trimesh, which is not installed") from None
    import numpy as np  # here, so that no other format waits for it

    try:
        vertices = np.array([[float(number) for number in point] for point in surface.numbers()], dtype=np.float64)
    except OverflowError:
        raise ExportError("a coordinate is too large for a binary float") from None
    return trimesh.Trimesh(vertices=vertices, faces=np.array(surface.triangles(), dtype=np.int64), process=False)
