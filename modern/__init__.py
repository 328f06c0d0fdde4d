"""Convex hulls: Butler's procedure over any arithmetic, an exact judge, comparison, studies, the edition.

The names below are the public interface; they are imported when first used.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from modern.digital.hull import DigitalHull, digital_hull
    from modern.geometry.hull import Face, Hull, HullRefused, Stage
    from modern.port import PointsError, RangeError, convex_hull

_HOMES = {
    "modern.digital.hull": ("DigitalHull", "digital_hull"),
    "modern.geometry.hull": ("Face", "Hull", "HullRefused", "Stage"),
    "modern.port": ("PointsError", "RangeError", "convex_hull"),
}

__all__ = [
    "DigitalHull",
    "Face",
    "Hull",
    "HullRefused",
    "PointsError",
    "RangeError",
    "Stage",
    "convex_hull",
    "digital_hull",
]


def __getattr__(name: str) -> object:
    for module, names in _HOMES.items():
        if name in names:
            return getattr(import_module(module), name)
    raise AttributeError(f"module 'modern' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
