"""A script of a user, which ``make lint`` checks with mypy --strict: the public names of ``hull1620`` have types."""

from fractions import Fraction

import numpy as np
import numpy.typing as npt

import hull1620
from hull1620 import Hull, HullRefused, Machine, compile_deck, convex_hull, exact_hull, read_deck


def largest(points: npt.NDArray[np.float64]) -> Fraction:
    hull: Hull = exact_hull(points)
    try:
        convex_hull(points.tolist(), "float64", epsilon=1e-9)
    except HullRefused as refused:
        print(refused.result)
    corners: npt.NDArray[np.float64] = hull.points[hull.vertices]
    print(corners.sum(), hull.simplices.shape, hull.area + 1, hull.draw(eye=(1, 2.5, 3)).upper())
    return hull.volume


def cards(name: str) -> tuple[str, ...]:
    program = compile_deck(read_deck(name))
    return Machine(program, hull1620.data_deck([(0, 0, 0)])).run().punched


def invalid() -> None:
    # mypy reports a comment that suppresses no error, so both errors must exist.
    hull1620.exact_hull(3).volume.upper()  # type: ignore[arg-type, attr-defined]
