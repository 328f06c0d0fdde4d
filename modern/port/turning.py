"""Normalising equations: turned so that the point C is on their negative side (thesis p. 24, 30)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from modern.port.arithmetic import Arithmetic, Scalar, Vector
from modern.port.formulas import at


def turned(
    arithmetic: Arithmetic, coefficients: Vector, centre: tuple[Scalar, ...] | None
) -> tuple[Vector, NDArray[np.bool_]]:
    """The equations (columns) turned, and which of them have the value zero at C.

    ``centre`` is None where the origin was moved to C: then the constant term tells (thesis p. 118).  No epsilon
    applies: C is no given point.
    """
    values = coefficients[-1] if centre is None else at(tuple(coefficients), centre)
    signs = arithmetic.sign(values)
    # The listing multiplies by -1.: the product with 1., its sign reversed, so that a zero comes out as minus zero.
    reversed_ = -(coefficients[:, signs > 0] * arithmetic.one)
    result = coefficients.copy()
    result[:, signs > 0] = reversed_
    return result, signs == 0
