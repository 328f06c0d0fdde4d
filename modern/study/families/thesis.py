"""Sets like those of the thesis: few points with small integer coordinates, often in one plane or line.

The thesis says that its programs were tested on approximately 70 examples and that two of them failed, but does not
describe the examples (chapter 1).  It prints six of them (chapter 6, p. 103-115), one for each kind of output.
Each kind here is modelled on one of the six, and all are equally likely:

=================  =======  =====================================================================================
kind               example  as printed, and as drawn here
=================  =======  =====================================================================================
three points       1        coordinates to 200: integers from -200 to 200, not collinear
line               2        9 points, from -600 to 6502: an integer direction, multiples from -3000 to 3000
one point          3        1, 2, 3: integers from -9 to 9
plane              4        8 points with y = 2, others from -5 to 7: a plane with integer points, from -9 to 9
slab               5        15 points, y from 1 to 4, others from -12 to 19: -20 to 20, one coordinate from 1 to 4
plane and points   6        example 4 and two points off its plane
=================  =======  =====================================================================================

The four larger examples have 9, 8, 15 and 10 points.  Here the number is drawn from 4 to 17, which has the same mean,
10.5.  Points keep the order in which they were drawn.

Chapter 5 prints part of another set, the data sheet (p. 58-59): its first point, 12, 3, .0146, and the last of its 8
points, 0, .0261, 6.  Two of these six coordinates are decimals of three figures below .1, which no example of chapter 6
has.  The kind ``data sheet`` is modelled on it and is drawn only on request: 8 points with integer coordinates from -12
to 12, of which a given share is replaced by such decimals, from .0100 to .0999.
"""

from collections.abc import Callable, Mapping

from emulator.errors import quoted
from modern.geometry.vectors import cross, minus
from modern.study.families.draws import Count, Draw, Drawn, FamilyError, Whole, drawn

N = (4, 17)
_LARGE, _SMALL, _WIDE, _MULTIPLE = 200, 9, 20, 3000
SHEET = "data sheet"
FORMS = ("alone", "added")
_SHEET_N, _SHEET_SIZE, _PLACES, _UNIT = 8, 12, 4, 10_000


def thesis(
    draw: Draw, kinds: Mapping[str, int] | None = None, n: Count = N, decimals: int = 0, form: str = "alone"
) -> Drawn:
    """A set like those of the thesis, of a kind chosen at random (default: the kinds of chapter 6, equally likely).

    kinds: a weight for each kind that may be chosen.  n: the number of points, for kinds without a fixed number.
    decimals: how many of 1,000 coordinates of a data sheet are decimals.  form: ``alone`` replaces an integer by the
    decimal, as printed, and ``added`` adds the decimal to the integer (12.0146).
    """
    weights = dict.fromkeys(KINDS, 1) if kinds is None else dict(kinds)
    unknown = [kind for kind in weights if kind not in (*KINDS, SHEET)]
    if unknown or not weights or min(weights.values()) < 0 or not any(weights.values()):
        raise FamilyError(f"kinds: expected {', '.join((*KINDS, SHEET))}, each with a weight of 0 or more")
    if not isinstance(decimals, int) or not 0 <= decimals <= 1000:
        raise FamilyError(f"decimals, in thousandths of the coordinates: expected 0 to 1000, found {decimals}")
    if form not in FORMS:
        raise FamilyError(f"form: expected {' or '.join(FORMS)}, found {quoted(form)}")
    pick = draw.whole(1, sum(weights.values()))
    for kind, weight in weights.items():
        pick -= weight
        if pick <= 0:
            if kind == SHEET:
                return drawn(data_sheet(draw, decimals, form), _PLACES, kind=kind)
            return drawn(KINDS[kind](draw, draw.count(n)), kind=kind)
    raise AssertionError


def data_sheet(draw: Draw, decimals: int, form: str) -> list[Whole]:
    """Return eight points like those of the data sheet, with coordinates multiplied by 10^4."""

    def coordinate() -> int:
        whole = draw.whole(-_SHEET_SIZE, _SHEET_SIZE) * _UNIT
        if draw.whole(1, 1000) > decimals:
            return whole
        return draw.whole(100, 999) + (whole if form == "added" else 0)

    return draw.distinct(_SHEET_N, lambda: (coordinate(), coordinate(), coordinate()))


def three_points(draw: Draw, _: int) -> list[Whole]:
    while True:
        p, q, r = draw.distinct(3, lambda: _in_box(draw, _LARGE))
        if any(cross(minus(q, p), minus(r, p))):
            return [p, q, r]


def line(draw: Draw, count: int) -> list[Whole]:
    start, along = _in_box(draw, _SMALL), (0, 0, 0)
    while not any(along):
        along = _in_box(draw, 2)
    return draw.distinct(count, lambda: _plus(start, along, draw.whole(-_MULTIPLE, _MULTIPLE)))


def one_point(draw: Draw, _: int) -> list[Whole]:
    return [_in_box(draw, _SMALL)]


def plane(draw: Draw, count: int) -> list[Whole]:
    """Return points of a plane that is, equally often, perpendicular to an axis (as in example 4) or oblique."""
    if draw.whole(0, 1):
        axis, height = draw.whole(0, 2), draw.whole(-_SMALL, _SMALL)
        return draw.distinct(count, lambda: _replaced(_in_box(draw, _SMALL), axis, height))
    start, u, v = _in_box(draw, _SMALL), (0, 0, 0), (0, 0, 0)
    while not any(cross(u, v)):
        u, v = _in_box(draw, 2), _in_box(draw, 2)
    return draw.distinct(
        count, lambda: _plus(_plus(start, u, draw.whole(-_SMALL, _SMALL)), v, draw.whole(-_SMALL, _SMALL))
    )


def slab(draw: Draw, count: int) -> list[Whole]:
    axis = draw.whole(0, 2)
    return draw.distinct(count, lambda: _replaced(_in_box(draw, _WIDE), axis, draw.whole(1, 4)))


def plane_and_points(draw: Draw, count: int) -> list[Whole]:
    """Return two points, then several points of a plane that contains neither of them, as in example 6."""
    inner = plane(draw, max(count - 2, 2))
    outer = [p for p in draw.distinct(len(inner) + 2, lambda: _in_box(draw, _SMALL)) if p not in inner][:2]
    return [*outer, *inner]


KINDS: Mapping[str, Callable[[Draw, int], list[Whole]]] = {
    "three points": three_points,
    "line": line,
    "one point": one_point,
    "plane": plane,
    "slab": slab,
    "plane and points": plane_and_points,
}


def _in_box(draw: Draw, size: int) -> Whole:
    return draw.whole(-size, size), draw.whole(-size, size), draw.whole(-size, size)


def _replaced(point: Whole, axis: int, value: int) -> Whole:
    x, y, z = (value if k == axis else c for k, c in enumerate(point))
    return x, y, z


def _plus(p: Whole, u: Whole, times: int) -> Whole:
    return p[0] + times * u[0], p[1] + times * u[1], p[2] + times * u[2]
