"""Sets like those the thesis shows: small, of small whole numbers, many of them in one plane or line.

The thesis says that its programs were tested on approximately 70 examples, of which all but two came out, and
nothing of what they were (chapter 1).  What is left of them are the six of chapter 6 (p. 103-115), one for each kind of
output; so each kind here is modelled on one of the six, and all are equally likely:

=================  =======  =====================================================================================
kind               example  as printed, and as drawn here
=================  =======  =====================================================================================
three points       1        coordinates to 200: whole numbers from -200 to 200, not in line
line               2        9 points, from -600 to 6502: a small whole direction, multiples from -3000 to 3000
one point          3        1, 2, 3: whole numbers from -9 to 9
plane              4        8 points with y = 2, others from -5 to 7: a plane of whole points, from -9 to 9 in it
slab               5        15 points, y from 1 to 4, others from -12 to 19: -20 to 20, one coordinate from 1 to 4
plane and points   6        example 4 and two points off its plane
=================  =======  =====================================================================================

The four larger examples have 9, 8, 15 and 10 points; here the number is drawn from 4 to 17, whose mean is theirs,
10.5.  Points are in the order drawn.

Chapter 5 prints one more set, in part: of the data sheet (p. 58-59) the first point, 12, 3, .0146, and the last of 8,
0, .0261, 6.  Two of its six coordinates are decimals of three figures below .1, which no example of chapter 6 has.  The
kind ``data sheet`` is modelled on it and is drawn only where it is asked for: 8 points of whole numbers from -12 to 12,
of whose coordinates a share is such decimals, from .0100 to .0999.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from modern.study.families.draws import Count, Draw, Drawn, FamilyError, Whole, drawn

N = (4, 17)
_LARGE, _SMALL, _WIDE, _MULTIPLE = 200, 9, 20, 3000
SHEET = "data sheet"
FORMS = ("alone", "added")
_SHEET_N, _SHEET_SIZE, _PLACES, _UNIT = 8, 12, 4, 10_000


def thesis(
    draw: Draw, kinds: Mapping[str, int] | None = None, n: Count = N, decimals: int = 0, form: str = "alone"
) -> Drawn:
    """A set of a kind drawn by weight (default: chapter 6's, all alike), of ``n`` points where the kind does not say.

    decimals: of the data sheet, how many of 1,000 coordinates are decimals.  form: ``alone``, such a decimal stands in
    the place of a whole number, as printed; ``added``, it is added to the whole number (12.0146).
    """
    weights = dict.fromkeys(KINDS, 1) if kinds is None else dict(kinds)
    unknown = [kind for kind in weights if kind not in (*KINDS, SHEET)]
    if unknown or not weights or min(weights.values()) < 0 or not any(weights.values()):
        raise FamilyError(f"kinds are {', '.join((*KINDS, SHEET))}, each with a weight of 0 or more")
    if not isinstance(decimals, int) or not 0 <= decimals <= 1000:
        raise FamilyError(f"decimals is {decimals}; it is a whole number of thousandths, 0 to 1000")
    if form not in FORMS:
        raise FamilyError(f"form is {form!r}; it is {' or '.join(FORMS)}")
    pick = draw.whole(1, sum(weights.values()))
    for kind, weight in weights.items():
        pick -= weight
        if pick <= 0:
            if kind == SHEET:
                return drawn(data_sheet(draw, decimals, form), _PLACES, kind=kind)
            return drawn(KINDS[kind](draw, draw.count(n)), kind=kind)
    raise AssertionError


def data_sheet(draw: Draw, decimals: int, form: str) -> list[Whole]:
    """Eight points like those of the data sheet, times 10^4."""

    def coordinate() -> int:
        whole = draw.whole(-_SHEET_SIZE, _SHEET_SIZE) * _UNIT
        if draw.whole(1, 1000) > decimals:
            return whole
        return draw.whole(100, 999) + (whole if form == "added" else 0)

    return draw.distinct(_SHEET_N, lambda: (coordinate(), coordinate(), coordinate()))


def three_points(draw: Draw, _: int) -> list[Whole]:
    while True:
        p, q, r = draw.distinct(3, lambda: _in_box(draw, _LARGE))
        u, v = _minus(q, p), _minus(r, p)
        if any(u[i] * v[j] != u[j] * v[i] for i, j in ((0, 1), (0, 2), (1, 2))):
            return [p, q, r]


def line(draw: Draw, count: int) -> list[Whole]:
    start, along = _in_box(draw, _SMALL), (0, 0, 0)
    while not any(along):
        along = _in_box(draw, 2)
    return draw.distinct(count, lambda: _plus(start, along, draw.whole(-_MULTIPLE, _MULTIPLE)))


def one_point(draw: Draw, _: int) -> list[Whole]:
    return [_in_box(draw, _SMALL)]


def plane(draw: Draw, count: int) -> list[Whole]:
    """Half of the planes at right angles to an axis, as example 4's, half spanned by two small directions."""
    if draw.whole(0, 1):
        axis, height = draw.whole(0, 2), draw.whole(-_SMALL, _SMALL)
        return draw.distinct(count, lambda: _replaced(_in_box(draw, _SMALL), axis, height))
    start = _in_box(draw, _SMALL)
    while True:
        u, v = _in_box(draw, 2), _in_box(draw, 2)
        if any(u[i] * v[j] != u[j] * v[i] for i, j in ((0, 1), (0, 2), (1, 2))):
            break
    return draw.distinct(
        count, lambda: _plus(_plus(start, u, draw.whole(-_SMALL, _SMALL)), v, draw.whole(-_SMALL, _SMALL))
    )


def slab(draw: Draw, count: int) -> list[Whole]:
    axis = draw.whole(0, 2)
    return draw.distinct(count, lambda: _replaced(_in_box(draw, _WIDE), axis, draw.whole(1, 4)))


def plane_and_points(draw: Draw, count: int) -> list[Whole]:
    """Two points of the box before a plane's others, as example 6 puts its two before example 4's eight."""
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


def _minus(p: Whole, q: Whole) -> Whole:
    return p[0] - q[0], p[1] - q[1], p[2] - q[2]


def _plus(p: Whole, u: Whole, times: int) -> Whole:
    return p[0] + times * u[0], p[1] + times * u[1], p[2] + times * u[2]
