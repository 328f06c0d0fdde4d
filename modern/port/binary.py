"""Binary arithmetics: ``float64`` and ``float32`` in numpy vectors, ``mp:BITS`` in mpmath numbers."""

from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from emulator.numbers.base import binary_value
from modern.geometry.numbers import Exact, exact_text
from modern.port.arithmetic import Arithmetic, RangeError, Scalar, Vector

if TYPE_CHECKING:
    from emulator.numbers.multiprecision import MultiprecisionNumbers  # needs mpmath, which most hulls do not use


@dataclass(frozen=True)
class FloatArithmetic(Arithmetic):
    """IEEE 754 double or single precision.  Decimal input is rounded to a double, then for ``float32`` to a single."""

    dtype: type[np.floating[Any]]

    @property
    def name(self) -> str:
        return np.dtype(self.dtype).name

    def number(self, value: Exact, minus: bool = False) -> Scalar:
        try:
            converted = self.dtype(value.numerator / value.denominator)
        except (OverflowError, FloatingPointError):
            converted = self.dtype("inf")
        if not np.isfinite(converted):
            raise RangeError(f"the number is too large for {self.name}")
        return self.dtype(-0.0) if minus and value == 0 else converted

    def quotient(self, value: Scalar, count: int) -> Scalar:
        return value / self.dtype(count)

    def sign(self, values: Vector) -> NDArray[np.int8]:
        signs: NDArray[np.int8] = np.sign(values).astype(np.int8)
        return signs

    def root(self, value: Scalar) -> Scalar:
        return np.sqrt(value)

    def surely_distinct(self, coordinates: Vector) -> bool:
        # Project the points on an irrational direction: equal points have equal projections, so strictly increasing
        # projections prove that all points differ. Equal projections prove nothing.
        x, y, z = (row.astype(np.float64) for row in coordinates)
        projections = np.sort(x + 0.7320508075688772 * y + 0.23606797749978969 * z)
        return bool((projections[1:] > projections[:-1]).all())

    def exact(self, value: Scalar, degree: int) -> Exact:
        numerator, denominator = value.as_integer_ratio()
        return numerator if denominator == 1 else Fraction(numerator, denominator)

    def text(self, value: Scalar, degree: int) -> str:
        return _float_text(float(value))

    def exacts(self, values: Vector, degree: int) -> list[Exact]:
        return [int(value) if value.is_integer() else Fraction(*value.as_integer_ratio()) for value in values.tolist()]

    def texts(self, values: Vector, degree: int) -> list[str]:
        return [_float_text(value) for value in values.tolist()]


def _float_text(value: float) -> str:
    if value and value.is_integer():
        return str(int(value))
    text = str(Decimal(value))
    return exact_text(Fraction(value)) if "E" in text else text


@dataclass(frozen=True)
class MultiprecisionArithmetic(Arithmetic):
    """The emulator's binary numbers with any number of bits, rounded to nearest, without limits for exponents."""

    system: "MultiprecisionNumbers"

    @property
    def name(self) -> str:
        return self.system.name

    def number(self, value: Exact, minus: bool = False) -> Scalar:
        return self.system.nearest(value.numerator, value.denominator)

    def quotient(self, value: Scalar, count: int) -> Scalar:
        return value / count

    def root(self, value: Scalar) -> Scalar:
        return self.system.function("SQRT", value)[0]

    def exact(self, value: Scalar, degree: int) -> Exact:
        return binary_value(value._mpf_)

    def text(self, value: Scalar, degree: int) -> str:
        return exact_text(self.exact(value, degree))
