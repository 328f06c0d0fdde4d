"""An outcome held against the judge's: what is missing, what is too much, and by how much it is off."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isqrt

from modern.comparison.outcome import Equation, Outcome, Vector

NEAR = Fraction(1, 1000)
"""Two equations are the same face, one of them inexact, when no coefficient is off by more than this."""


@dataclass(frozen=True, slots=True)
class Disagreement:
    """How an outcome differs from the judge's; all sets hold places in the input.

    ``error`` is the largest relative error of a coefficient among the equations found, relative to the
    equation's largest coefficient of x, y and z (of D: to the largest of all); ``excluded`` the greatest
    distance, to six digits, of a point outside an equation of the outcome, and which point.
    """

    missed: frozenset[int]
    added: frozenset[int]
    misfiled: frozenset[int]
    planes_missing: int
    planes_extra: int
    planes_doubled: int
    error: Fraction
    excluded: Fraction
    excluded_point: int | None

    @property
    def agrees(self) -> bool:
        """Whether the outcome says what the judge says; small errors of coefficients do not count."""
        sets = self.missed or self.added or self.misfiled
        return not (sets or self.planes_missing or self.planes_extra or self.planes_doubled)

    @property
    def points(self) -> tuple[int, ...]:
        """The points concerned."""
        found = self.missed | self.added | self.misfiled
        return tuple(sorted(found if self.excluded_point is None else found | {self.excluded_point}))


def against(outcome: Outcome, judge: Outcome, points: Sequence[Vector]) -> Disagreement:
    """Compare a determined outcome with the judge's."""
    missed, added = judge.vertices - outcome.vertices, outcome.vertices - judge.vertices
    filed = dict.fromkeys(outcome.boundary, "boundary") | dict.fromkeys(outcome.inside, "inside")
    right = dict.fromkeys(judge.boundary, "boundary") | dict.fromkeys(judge.inside, "inside")
    # Of lines and of fewer than four points the programs list the vertices only.
    lists = outcome.dimension >= 2 and (filed or outcome.equations)
    misfiled = (
        {i for i, kind in right.items() if filed.get(i) != kind and i not in outcome.vertices} if lists else set()
    )
    misfiled |= {i for i in filed if i not in right and i not in missed}
    missing, extra, doubled, error = _match(outcome.equations, judge.equations)
    if not outcome.equations and not lists:
        missing = 0
    distance, farthest = _excluded(outcome.equations, points)
    return Disagreement(
        frozenset(missed), frozenset(added), frozenset(misfiled), missing, extra, doubled, error, distance, farthest
    )


def _match(found: Sequence[Equation], right: Sequence[Equation]) -> tuple[int, int, int, Fraction]:
    """(missing, extra, doubled, largest error): each equation found goes to the nearest right one."""
    scaled = [_scaled(equation) for equation in right]
    hits = [0] * len(right)
    extra, worst = 0, Fraction(0)
    for equation in found:
        errors = [_distance(_scaled(equation), other) for other in scaled]
        best = min(range(len(errors)), key=errors.__getitem__, default=None)
        if best is None or errors[best] > NEAR:
            extra += 1
            continue
        hits[best] += 1
        worst = max(worst, errors[best])
    return hits.count(0), extra, sum(n - 1 for n in hits if n > 1), worst


def _scaled(equation: Equation) -> Equation:
    """Divided by the size of its largest coefficient of x, y, z; a plane of zeros stays as it is."""
    size = max(abs(c) for c in equation[:3])
    return equation if not size else tuple(c / size for c in equation)  # type: ignore[return-value]


def _distance(one: Equation, other: Equation) -> Fraction:
    normal = max(abs(a - b) for a, b in zip(one[:3], other[:3], strict=True))
    return max(normal, abs(one[3] - other[3]) / max(Fraction(1), abs(other[3])))


def _excluded(equations: Sequence[Equation], points: Sequence[Vector]) -> tuple[Fraction, int | None]:
    """The greatest distance of a point beyond an equation, and the point."""
    worst, which = Fraction(0), None
    for a, b, c, d in equations:
        square = a * a + b * b + c * c
        if not square:
            continue
        for index, (x, y, z) in enumerate(points):
            value = a * x + b * y + c * z + d
            if value > 0 and value * value > worst * worst * square:
                worst, which = _root(value * value / square), index
    return worst, which


def _root(square: Fraction) -> Fraction:
    """A square root cut after some twelve significant digits."""
    digits = 10 ** max(12, 12 + len(str(square.denominator)) // 2)
    return Fraction(isqrt(square.numerator * digits * digits // square.denominator), digits)
