"""Input on which a product may overflow is left to numpy, because compiled code continues with an infinity."""

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from modern.port import convex_hull, kernels
from modern.port import fast as fast_steps
from modern.port.arithmetic import RangeError
from modern.port.binary import FloatArithmetic
from modern.port.table import PointTable, Slack

TYPES = (np.float64, np.float32)
AXIS = pytest.mark.parametrize("axis", [0, 1, 2])
SIGN = pytest.mark.parametrize("sign", [1, -1])


def unnoticing(kernel: Callable[..., Any]) -> Callable[..., Any]:
    """Return a Python kernel that continues with infinities, as compiled code does."""

    def called(*arguments: Any) -> Any:
        with np.errstate(all="ignore"):
            return kernel(*arguments)

    return called


def by_kernels(
    dtype: type[np.floating[Any]], size: float, e: Fraction | None = None, axis: int = 0, sign: int = 1
) -> bool:
    """Return True if the kernels are chosen for points of that size and that relative e."""
    numbers = FloatArithmetic(dtype)
    coordinates = np.zeros((3, 3), dtype)
    coordinates[axis, 1] = sign * size
    slack = None if e is None else Slack(numbers, e, True)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(fast_steps, "load", lambda name: fast_steps.with_kernels(len, len))
        return fast_steps.choose(numbers, PointTable(coordinates, np.arange(3)), slack, True) is not fast_steps.PLAIN


def sizes(dtype: type[np.floating[Any]]) -> list[float]:
    """Return coordinates around the fourth root of the largest number, four in each power of two."""
    middle = int(np.finfo(dtype).maxexp) // 4
    return [quarter / 4 * 2.0**power for power in range(middle - 5, middle + 3) for quarter in (4, 5, 6, 7)]


@pytest.mark.parametrize("dtype", TYPES)
@AXIS
@SIGN
def test_numpy_runs_if_squares_of_coefficients_may_overflow(dtype, axis, sign) -> None:
    """A, B and C (3.4) are sums of six products of two coordinates: at most 6 M**2, their squares 36 M**4.

    Sizes at least 128 times too small to overflow must go to the kernels. Between the two limits either may run.
    """
    largest = Fraction(float(np.finfo(dtype).max))
    taken = {size: by_kernels(dtype, size, axis=axis, sign=sign) for size in sizes(dtype)}
    for size, kernels_take_it in taken.items():
        square = 36 * Fraction(size) ** 4
        assert not kernels_take_it if square > largest else True, size
        assert kernels_take_it if 128 * square < largest else True, size
    assert set(taken.values()) == {True, False}


@pytest.mark.parametrize("dtype", TYPES)
@pytest.mark.parametrize("size", [0.5, 1.0, 2.0**9, 2.0**20])
def test_numpy_runs_if_epsilon_times_a_coefficient_may_overflow(dtype: type[np.floating[Any]], size: float) -> None:
    """A relative e is multiplied by the largest of A, B and C, at most 6 M**2. An M below 1 counts as 1."""
    largest = Fraction(float(np.finfo(dtype).max))
    coefficient = 6 * max(Fraction(size), Fraction(1)) ** 2
    for eighths in (2, 4, 6, 7, 9, 10, 12, 16, 32, 2**9, 2**20):
        e = largest / coefficient * Fraction(eighths, 8)
        if e <= largest:
            taken = by_kernels(dtype, size, e)
            assert not taken if eighths > 8 else True, eighths
            assert taken if eighths <= 4 else True, eighths
    assert by_kernels(dtype, size, Fraction(0))


WIDE, LONG, OFF = 2.0**-500, 1.5 * 2.0**511, 1.5 * 2.0**481
OVERFLOWING = [
    (-WIDE, 0, 0),
    (WIDE, 0, 0),
    *(
        (x * WIDE, y * LONG, y * LONG)
        for x, y in (
            (-0.25, 1),
            (0.25, 0.9375),
            (-0.4375, -0.5),
            (-0.5625, 1),
            (-0.1875, -0.9375),
            (0.3125, 0.625),
            (0.5, -0.625),
        )
    ),
    (0, OFF, 0),
    (0.5 * WIDE, 2 * OFF, 0),
]
"""Long, narrow and nearly flat points. The squares of program 1 fit, because each of its triangles has a narrow
side.
"""


@pytest.fixture
def quiet_kernels(monkeypatch) -> None:
    """Replace the compiled kernels by Python ones that report no overflow."""
    steps_of = fast_steps.with_kernels(unnoticing(kernels.grow), unnoticing(kernels.satisfied))
    monkeypatch.setattr(fast_steps, "load", lambda name: steps_of)


@pytest.mark.usefixtures("quiet_kernels")
def test_overflow_after_the_opening_is_a_range_error_with_and_without_kernels() -> None:
    """y_j z_k + y_i z_j (3.4) of three of the long points exceeds a double, though each product fits.

    Program 3 computes it, not program 1. Kernels that continue with the infinity report DATA NOT ACCEPTABLE.
    """
    product = Fraction(LONG) ** 2 * Fraction(15, 16)
    assert product < Fraction(float(np.finfo(np.float64).max)) < 2 * product
    for fast in (False, True):
        with pytest.raises(RangeError, match="exceeds the largest number"):
            convex_hull(np.array(OVERFLOWING), "float64", fast=fast)


@pytest.mark.usefixtures("quiet_kernels")
def test_scaled_points_without_overflow_are_determined_with_and_without_kernels() -> None:
    """Scaled by powers of two to a size that never overflows: the set is refused for its size, not for its shape."""
    points = np.array(OVERFLOWING) * (2.0**480, 2.0**-500, 2.0**-500)
    by_numpy, by_kernel = (convex_hull(points, "float64", fast=fast) for fast in (False, True))
    assert by_numpy == by_kernel
    assert by_numpy.determined
