"""Which form of the procedure's steps is taken: numpy's, or the kernels compiled by numba (extra ``fast``).

This is the one place that chooses.  Both give the same numbers and decide alike.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from emulator.compiled.jit import NotInstalled
from modern.port import growth
from modern.port.arithmetic import Arithmetic
from modern.port.binary import FloatArithmetic
from modern.port.equations import Equations, Slack
from modern.port.places import Places
from modern.port.polyhedron import Polyhedron

_MANY = 5_000
"""Points from which on loading the kernels costs less than it saves."""
_KERNELS = "modern.port.stages"


@dataclass(frozen=True, slots=True)
class Steps:
    """A stage of a polyhedron's growth, and the places that satisfy each equation."""

    stage: Callable[[Polyhedron, bool], growth.Grown | None]
    satisfied: Callable[[Equations, Places], list[NDArray[np.int64]]]


def plain_satisfied(table: Equations, places: Places) -> list[NDArray[np.int64]]:
    return table.satisfied(places.coordinates)


PLAIN = Steps(growth.stage, plain_satisfied)


def choose(arithmetic: Arithmetic, places: Places, slack: Slack | None, fast: bool | None) -> Steps:
    """The steps for these points.

    ``fast``: False numpy's; True the kernels; None the kernels where numba is there and it pays: many points, or
    kernels that are loaded already.  Raises NotInstalled where it is True and numba is missing.
    """
    if fast is False or not isinstance(arithmetic, FloatArithmetic) or not _in_range(arithmetic, places, slack):
        return PLAIN
    if fast is None and len(places) < _MANY and _KERNELS not in sys.modules:
        return PLAIN
    try:
        from modern.port import stages  # imported late: numba takes longer to load than most hulls

        return Steps(*stages.load())
    except NotInstalled:
        if fast:
            raise
        return PLAIN


def _in_range(arithmetic: FloatArithmetic, places: Places, slack: Slack | None) -> bool:
    """Whether no number of the procedure can overflow, which numpy notices and compiled code does not.

    The largest are squares of a plane's coefficients, at most 36 M**4 for coordinates up to M, values at a point, at
    most 24 M**3, and e, for all the equations, times a coefficient.
    """
    limit = float(np.finfo(arithmetic.dtype).max)
    largest = max(1.0, float(abs(places.coordinates).max()))
    e = max(1.0, float(arithmetic.tolerance(slack.size, 0))) if slack else 1.0
    return largest < limit**0.25 / 8 and e < limit / (8 * largest**2)
