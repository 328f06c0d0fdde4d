"""Convex hulls: Butler's procedure over any arithmetic, an exact judge, comparison, studies, the edition.

The names below are the public interface; they are imported when first used.
"""

# Part of the distribution hull1620.

from typing import TYPE_CHECKING

from emulator import named

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
    return named(__name__, _HOMES, name)


def __dir__() -> list[str]:
    return sorted({*(name for name in globals() if name.startswith("__")), *__all__})
