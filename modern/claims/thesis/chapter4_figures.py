"""Figures 1 to 4 of chapter 4, whose drawings are lost, drawn anew from what the text says of them.

Fig. 1 (p. 39) has data: the six points and eight faces of theorem 4.2.  Figs. 2 and 4 (p. 49, 54) show a hull H_k with
the triangle P_a, P_b, P_NV+1; here both are taken from the construction of a small flat set, two stages of it.  Fig. 3
(p. 52) shows the triangle of H_1 with P_3 at the origin and P_1 P_2 parallel to the y axis.  Views, sizes and letters
are ours.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import combinations

from modern.claims.sampled_sets import SampledSet, sampled_sets
from modern.claims.thesis.chapter4_examples import theorem_of
from modern.drawing import svg
from modern.drawing.layout import Pixel

FIGURES = ("1", "2", "3", "4")
Spot = tuple[int, int]
Line = tuple[Spot, Spot]
_ROOM, _WIDE = 30, 320


def figure(number: str) -> str:
    """A figure as SVG.  Raises KeyError."""
    if number in ("2", "4"):
        return _added(int(number) // 2)
    return {"1": _polyhedron, "3": _triangle}[number]()


def _polyhedron() -> str:
    theorem = theorem_of("4.2")
    spots = {p.name: (int(20 * p.at[0] - 8 * p.at[1]), int(20 * p.at[2] + 6 * p.at[1])) for p in theorem.points}
    sides = sorted({tuple(sorted(pair)) for plane in theorem.planes for pair in combinations(plane.vertices, 2)})
    return _svg("Figure 1", [(spots[a], spots[b]) for a, b in sides], [], spots)


def _added(step: int) -> str:
    """H_k and the triangle that makes H_k+1 of it, in the first flat set that has so many stages."""
    one = next(one for one in sampled_sets(2, 6) if len(one.hull.history) > step)
    before, after = one.stages()[step - 1 : step + 1]
    new = after.vertices[-1]
    gone = {*map(frozenset, before.defining)} - {*map(frozenset, after.defining)}
    (replaced,) = gone
    a, b = sorted(replaced)
    solid = [_side(one, defining) for defining in before.defining]
    names = {"P_a": _spot(one, a), "P_b": _spot(one, b), "P_NV+1": _spot(one, new)}
    return _svg(f"Figure {2 * step}", solid, [_side(one, (a, new)), _side(one, (b, new))], names)


def _spot(one: SampledSet, k: int) -> Spot:
    return 20 * one.points[k][0], 20 * one.points[k][1]


def _side(one: SampledSet, ends: Sequence[int]) -> Line:
    return _spot(one, ends[0]), _spot(one, ends[1])


def _triangle() -> str:
    corners = {"P_3": (0, 0), "P_1": (90, -60), "P_2": (90, 70)}
    axes: list[Line] = [((-40, 0), (140, 0)), ((0, -80), (0, 90))]
    return _svg("Figure 3", list(combinations(corners.values(), 2)), axes, corners)


def _svg(title: str, solid: Iterable[Line], dashed: Iterable[Line], names: dict[str, Spot]) -> str:
    """Lines and names, y upward, in a frame of one width."""
    solid, dashed = list(solid), list(dashed)
    spots = [*names.values(), *(spot for line in (*solid, *dashed) for spot in line)]
    low = min(x for x, _ in spots), min(y for _, y in spots)
    high = max(x for x, _ in spots), max(y for _, y in spots)
    height = high[1] - low[1] + 2 * _ROOM

    def at(spot: Spot) -> Pixel:
        return Pixel(100 * (spot[0] - low[0] + _ROOM), 100 * (high[1] - spot[1] + _ROOM))

    items = [
        svg.line(at(a), at(b), f'stroke="black"{style}')
        for lines, style in ((solid, ""), (dashed, ' stroke-dasharray="6 4"'))
        for a, b in lines
    ]
    for name, spot in names.items():
        corner = at(spot)
        items.append(svg.text(Pixel(corner.x + 400, corner.y - 400), name, 'font-size="14"'))
    width = max(_WIDE, high[0] - low[0] + 2 * _ROOM)
    return svg.page(width, height, f"{title} of chapter 4, drawn from its data", items)
