"""An outcome compared with the judge's: what is missing, what is too much, and by how much it is off."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, isqrt, lcm
from typing import NamedTuple

from modern.comparison.outcome import Equation, Outcome, Vector

NEAR = Fraction(1, 1000)
"""Two equations are the same face, one of them inexact, when no coefficient is off by more than this."""


@dataclass(frozen=True, slots=True)
class Disagreement:
    """How an outcome differs from the judge's; all sets hold places in the input.

    ``error`` is the largest relative error of a coefficient among the equations found, relative to the
    equation's largest coefficient of x, y and z (of D: to the largest of all); ``excluded`` the greatest
    distance, to six digits, of a point outside an equation of the outcome, and which point.  ``places``: for each
    equation of the outcome the judge's it was taken for, -1 where it is like none of them.
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
    places: tuple[int, ...] = ()

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


def disagreement(outcome: Outcome, judge: Outcome, points: Sequence[Vector]) -> Disagreement:
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
    matches = _match(outcome.equations, judge.equations)
    places = tuple(match.place for match in matches)
    hits = Counter(places)
    extra = hits.pop(-1, 0)
    missing = len(judge.equations) - len(hits) if outcome.equations or lists else 0
    doubled = sum(hits.values()) - len(hits)
    error = max((match.error for match in matches if match.place >= 0), default=Fraction(0))
    # What is exactly an equation of the judge's excludes no point.
    others = [e for e, match in zip(outcome.equations, matches, strict=True) if match.place < 0 or match.error]
    distance, farthest = _excluded(others, points)
    return Disagreement(
        frozenset(missed),
        frozenset(added),
        frozenset(misfiled),
        missing,
        extra,
        doubled,
        error,
        distance,
        farthest,
        places,
    )


class _Match(NamedTuple):
    """The judge's equation nearest to one found, -1 where none is near, and how far it is."""

    place: int
    error: Fraction


def _match(found: Sequence[Equation], right: Sequence[Equation]) -> list[_Match]:
    """Each equation found goes to the nearest right one, the first of equals."""
    exactly: dict[tuple[int, ...], int] = {}
    for place, equation in enumerate(right):
        exactly.setdefault(_whole(equation), place)
    scaled: list[Equation] = []
    matches = []
    for equation in found:
        place = exactly.get(_whole(equation), -1)
        if place >= 0 and any(equation[:3]):
            matches.append(_Match(place, Fraction(0)))
            continue
        scaled = scaled or [_scaled(other) for other in right]
        own = _scaled(equation)
        errors = [_distance(own, other) for other in scaled]
        best = min(range(len(errors)), key=errors.__getitem__, default=-1)
        near = best >= 0 and errors[best] <= NEAR
        matches.append(_Match(best if near else -1, errors[best] if near else Fraction(0)))
    return matches


def _whole(numbers: Sequence[Fraction]) -> tuple[int, ...]:
    """The numbers times a positive factor, as integers without common divisor: equal for equal scaled equations."""
    scale = lcm(*(c.denominator for c in numbers))
    whole = [c.numerator * (scale // c.denominator) for c in numbers]
    divisor = gcd(*whole) or 1
    return tuple(c // divisor for c in whole)


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
    if not equations:
        return worst, which
    scale = lcm(*(c.denominator for point in points for c in point))
    places = [tuple(c.numerator * (scale // c.denominator) for c in point) for point in points]
    for equation in equations:
        # The distance is the same for any positive multiple of the equation.
        a, b, c, d = _whole(equation)
        square = a * a + b * b + c * c
        if not square:
            continue
        d *= scale
        for index, (x, y, z) in enumerate(places):
            number = a * x + b * y + c * z + d
            if number > 0:
                value = Fraction(number, scale)
                if value * value > worst * worst * square:
                    worst, which = _root(value * value / square), index
    return worst, which


def _root(square: Fraction) -> Fraction:
    """A square root cut after some twelve significant digits."""
    digits = 10 ** max(12, 12 + len(str(square.denominator)) // 2)
    return Fraction(isqrt(square.numerator * digits * digits // square.denominator), digits)
