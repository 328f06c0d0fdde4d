"""Binary arithmetics: ``float64`` and ``float32`` in numpy vectors, ``mp:BITS`` in mpmath numbers."""

from dataclasses import dataclass, field
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from modern.geometry.numbers import Exact, exact_text
from modern.port.arithmetic import Arithmetic, RangeError, Scalar, Vector


@dataclass(frozen=True)
class FloatArithmetic(Arithmetic):
    """IEEE 754 double or single precision.  Decimal input is rounded to a double, then to a single if requested."""

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

    def within(self, values: Vector, slack: Vector) -> NDArray[np.bool_]:
        return np.asarray(abs(values) <= slack)

    def is_zero(self, value: Scalar) -> bool:
        return bool(value == 0)

    def root(self, value: Scalar) -> Scalar:
        return np.sqrt(value)

    def last_largest(self, values: Vector) -> int:
        return len(values) - 1 - int(np.argmax(values[::-1]))

    def descending(self, values: Vector) -> NDArray[np.intp]:
        return np.argsort(values, kind="stable")[::-1]

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


def _context() -> Any:
    from mpmath import MPContext  # not at the top, because most hulls need no numbers of mpmath

    return MPContext()


@dataclass(frozen=True)
class MultiprecisionArithmetic(Arithmetic):
    """Binary floating point with any number of bits, rounded to nearest, without limits for exponents."""

    bits: int
    context: Any = field(default_factory=_context, compare=False)

    def __post_init__(self) -> None:
        self.context.prec = self.bits

    @property
    def name(self) -> str:
        return f"mp:{self.bits}"

    def number(self, value: Exact, minus: bool = False) -> Scalar:
        from mpmath.libmp import from_rational, round_nearest

        return self.context.make_mpf(from_rational(value.numerator, value.denominator, self.bits, round_nearest))

    def quotient(self, value: Scalar, count: int) -> Scalar:
        return value / count

    def sign(self, values: Vector) -> NDArray[np.int8]:
        return np.asarray(values > 0, dtype=np.int8) - np.asarray(values < 0, dtype=np.int8)

    def root(self, value: Scalar) -> Scalar:
        return self.context.sqrt(value)

    def exact(self, value: Scalar, degree: int) -> Exact:
        sign, mantissa, exponent, _ = value._mpf_
        number = -int(mantissa) if sign else int(mantissa)
        return number * 2**exponent if exponent >= 0 else Fraction(number, 2**-exponent)

    def text(self, value: Scalar, degree: int) -> str:
        return exact_text(self.exact(value, degree))
