"""Butler's procedure as one would write it today, over any arithmetic."""

from modern.geometry.hull import HullRefused
from modern.geometry.numbers import PointsError
from modern.port.arithmetic import RangeError
from modern.port.procedure import convex_hull

__all__ = ["HullRefused", "PointsError", "RangeError", "convex_hull"]
