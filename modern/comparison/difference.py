"""List the differences between a computed hull, or the cards that a program punched, and the exact hull.

The differences are missing and extra points and equations, and numerical errors.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isqrt, lcm
from typing import NamedTuple

from emulator.errors import EmulatorError
from modern.comparison.outcome import Equation, Outcome, Vector, from_card_hull, from_hull
from modern.geometry.hull import Hull
from modern.geometry.vectors import lowest_equation
from modern.thesis.cards import CardHull

# The largest difference of coefficients at which two equations still count as the same face, with a numerical error.
NEAR = Fraction(1, 1000)


@dataclass(frozen=True, slots=True)
class Disagreement:
    """The differences between a computed hull and the exact hull of the same points.  Points are input indices.

    ``missed`` has the vertices of the exact hull that are not vertices of the computed hull, and ``added`` has the
    vertices of the computed hull that are not vertices of the exact hull.  ``misfiled`` has the points that the
    computed hull puts into the wrong class: boundary points among the inside points, or inside points among the
    boundary points.  ``error`` is the largest error of a coefficient among the matched equations.  The errors of A, B
    and C are relative to the largest of these three coefficients, the error of D to the largest of all four.  Of the
    input points outside the plane or line of a computed equation, ``excluded_point`` is the one farthest outside, and
    ``excluded`` is its distance, to about twelve digits.  ``places`` has for each equation of the computed hull the
    index of the exact equation that it matches, or -1.
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
        """True if the computed hull is the exact hull, except for small errors of coefficients."""
        wrong_points = self.missed or self.added or self.misfiled
        return not (wrong_points or self.planes_missing or self.planes_extra or self.planes_doubled)

    @property
    def points(self) -> tuple[int, ...]:
        points = self.missed | self.added | self.misfiled
        return tuple(sorted(points if self.excluded_point is None else points | {self.excluded_point}))


def disagreement(outcome: Outcome, judge: Outcome, points: Sequence[Vector]) -> Disagreement:
    """Compare any computed hull (``outcome``) with the exact hull of the same points (``judge``)."""
    missed, added = judge.vertices - outcome.vertices, outcome.vertices - judge.vertices
    classes = dict.fromkeys(outcome.boundary, "boundary") | dict.fromkeys(outcome.inside, "inside")
    exact_classes = dict.fromkeys(judge.boundary, "boundary") | dict.fromkeys(judge.inside, "inside")
    # For lines and for fewer than four points the programs punch only the vertices.
    classified = outcome.dimension >= 2 and (classes or outcome.equations)
    misfiled = (
        {i for i, kind in exact_classes.items() if classes.get(i) != kind and i not in outcome.vertices}
        if classified
        else set()
    )
    misfiled |= {i for i in classes if i not in exact_classes and i not in missed}
    # Match the equations.  Count those without a match, and those whose exact equation another equation has matched.
    matches = _match(outcome.equations, judge.equations)
    places = tuple(match.place for match in matches)
    hits = Counter(places)
    extra = hits.pop(-1, 0)
    missing = len(judge.equations) - len(hits) if outcome.equations or classified else 0
    doubled = sum(hits.values()) - len(hits)
    error = max((match.error for match in matches if match.place >= 0), default=Fraction(0))
    # An equation that equals an equation of the hull excludes no point.
    inexact = [e for e, match in zip(outcome.equations, matches, strict=True) if match.place < 0 or match.error]
    distance, farthest = _excluded(inexact, points)
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
    place: int
    error: Fraction


def _match(equations: Sequence[Equation], exact: Sequence[Equation]) -> list[_Match]:
    """Find for each equation the nearest exact equation, or the first of several that are equally near."""
    by_integers: dict[tuple[int, ...], int] = {}
    for place, equation in enumerate(exact):
        by_integers.setdefault(lowest_equation(equation), place)
    scaled_exact: list[Equation] = []
    matches = []
    for equation in equations:
        place = by_integers.get(lowest_equation(equation), -1)
        if place >= 0 and any(equation[:3]):
            matches.append(_Match(place, Fraction(0)))
            continue
        # Only an equation that is not exact needs the distances to all others.
        scaled_exact = scaled_exact or [_scaled(candidate) for candidate in exact]
        scaled = _scaled(equation)
        errors = [_distance(scaled, candidate) for candidate in scaled_exact]
        best = min(range(len(errors)), key=errors.__getitem__, default=-1)
        near = best >= 0 and errors[best] <= NEAR
        matches.append(_Match(best if near else -1, errors[best] if near else Fraction(0)))
    return matches


def _scaled(equation: Equation) -> Equation:
    """Divide an equation by its largest coefficient of x, y or z.  If all three are zero, return it unchanged."""
    size = max(abs(c) for c in equation[:3])
    return equation if not size else tuple(c / size for c in equation)  # type: ignore[return-value]


def _distance(equation: Equation, exact: Equation) -> Fraction:
    normal = max(abs(a - b) for a, b in zip(equation[:3], exact[:3], strict=True))
    return max(normal, abs(equation[3] - exact[3]) / max(Fraction(1), abs(exact[3])))


def _excluded(equations: Sequence[Equation], points: Sequence[Vector]) -> tuple[Fraction, int | None]:
    worst, worst_point = Fraction(0), None
    if not equations:
        return worst, worst_point
    scale = lcm(*(c.denominator for point in points for c in point))
    scaled_points = [tuple(c.numerator * (scale // c.denominator) for c in point) for point in points]
    for equation in equations:
        # The distance is the same for any positive multiple of the equation.
        a, b, c, d = lowest_equation(equation)
        square = a * a + b * b + c * c
        if not square:
            continue
        d *= scale
        for index, (x, y, z) in enumerate(scaled_points):
            number = a * x + b * y + c * z + d
            if number > 0:
                # Squares are compared, so that only a new maximum needs a root.
                value = Fraction(number, scale)
                if value * value > worst * worst * square:
                    worst, worst_point = _root(value * value / square), index
    return worst, worst_point


def _root(square: Fraction) -> Fraction:
    """Return a square root as a fraction, truncated after about twelve significant digits."""
    digits = 10 ** max(12, 12 + len(str(square.denominator)) // 2)
    return Fraction(isqrt(square.numerator * digits * digits // square.denominator), digits)


class UnrelatedCards(EmulatorError):
    """Raised if cards hold no hull, or the hull of points other than the expected ones; the message is one line."""


@dataclass(frozen=True, slots=True)
class CardDifferences:
    """The differences between a hull on punched cards and the exact hull: missing and false vertices and faces.

    ``missed`` has the vertices of the exact hull that are not vertices on the cards.  ``added`` has the vertices on the
    cards that are not vertices of the exact hull.  ``not_found`` has the faces of the exact hull that the cards lack.
    ``polygons`` has for each false face on the cards the vertices that the cards name for it.  ``others`` is the number
    of false faces with fewer than two vertices, which cannot be drawn.
    """

    missed: tuple[int, ...] = ()
    added: tuple[int, ...] = ()
    not_found: tuple[int, ...] = ()
    polygons: tuple[tuple[int, ...], ...] = ()
    others: int = 0


def card_differences(cards: CardHull, hull: Hull, source: str) -> CardDifferences:
    """Compare the cards of the file ``source`` with the exact hull.  Raise UnrelatedCards if they have other points."""
    if not cards.vertices:
        raise UnrelatedCards(f"{source}: these cards have no vertices; 'hull1620 hull' punches cards that have them")
    points = [tuple(Fraction(number) for number in point) for point in hull.points]
    outcome = from_card_hull("cards", _program(cards), cards, points)
    if outcome.strange:
        raise UnrelatedCards(
            f"{source}: {outcome.strange} of the points on these cards are not among the points of the file"
        )
    differences = disagreement(outcome, from_hull("exact", hull), points)
    # The points are visited in reverse order, so that of several equal points the first one remains.
    indices = {point: index for index, point in reversed(list(enumerate(points)))}
    satisfied = {equation: numbers for numbers, equation in cards.satisfied}
    polygons = []
    for equation_number, match in enumerate(differences.places, 1):
        if match < 0:
            numbers = [n for n in satisfied.get(equation_number, ()) if 1 <= n <= len(cards.vertices)]
            polygons.append(tuple(indices[cards.vertices[n - 1]] for n in numbers))
    drawable = tuple(polygon for polygon in polygons if len(polygon) > 1)
    unmatched = set(range(len(hull.faces))) - set(differences.places)
    return CardDifferences(
        missed=tuple(sorted(differences.missed)),
        added=tuple(sorted(differences.added)),
        not_found=tuple(sorted(unmatched)) if differences.planes_missing else (),
        polygons=drawable,
        others=len(polygons) - len(drawable),
    )


def _program(cards: CardHull) -> str:
    if not cards.satisfied or not cards.equations:
        return "program1"
    return "program2" if cards.plane else "program3"
