"""The topological map drawn in the plane: every surface a region, the largest one the outside.

Points lie as Tutte (Proceedings of the London Mathematical Society 13 (1963)) puts them: those of the outside on a
circle, every other one at a mean of its neighbours, so that no two lines cross and every region is convex.  Any
positive weights do for the mean; here lines beside large regions count more, and more from round to round, so that
regions become equal in size where they can.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction

from modern.drawing import svg
from modern.drawing.labels import Label, place_labels
from modern.drawing.layout import MARGIN, Pixel, fit
from modern.drawing.legend import wrapped
from modern.drawing.svg import VERTEX, VISIBLE
from modern.geometry.mesh import sides
from modern.papers.appel_will.edges import Pair
from modern.papers.appel_will.pictures import (
    MOST_LINES,
    WIDER,
    WIDTH,
    PictureError,
    checked_width,
    texts,
    words_row,
)
from modern.papers.appel_will.surfaces import Surface

Place = tuple[float, float]
MOST, CROWD = 100, 24
"""Points beyond which the map is not drawn, as the middle could not be told apart, and beyond which it is wider."""
_TURNS, _FIRST, _ROUNDS, _STEP = 150, 200, 10, 1.1
_LINE, _SMALLEST = 19, 160.0
_LINES = f'font-family="{svg.FONT}" font-size="11" font-style="italic" fill="#444"'
_FONT = f'font-family="{svg.FONT}" font-size="13" fill="#000"'
_SURFACES = f'font-family="{svg.FONT}" font-size="15" fill="#999" text-anchor="middle"'


def map_svg(surfaces: Sequence[Surface], edges: Sequence[Pair], title: str = "", width: int | None = None) -> str:
    """The map of a polyhedron's surfaces, or of the one of a polygon, with points, lines and surfaces numbered.

    edges: the convex edge list, for the lines' numbers; of more than ``MOST_LINES`` they have none.  width: in pixels,
    by default 640, and 1000 for more than ``CROWD`` points.  Raises PictureError for a map without surfaces or of more
    than ``MOST`` points, and for a width out of range.
    """
    if not surfaces:
        raise PictureError("there are no surfaces, so there is no map to draw")
    count = len({index for surface in surfaces for index in surface})
    if count > MOST:
        raise PictureError(f"a map of {count} points is not drawn; of at most {MOST} it can be read")
    width = checked_width(width, WIDTH if count <= CROWD else WIDER)
    outer = max(range(len(surfaces)), key=lambda number: (len(surfaces[number]), -number))
    places = embedded(surfaces, outer)
    exact = {index: (Fraction(x), Fraction(y)) for index, (x, y) in places.items()}
    pixel, height = fit(list(exact.values()), width, max(460, width * 460 // 640))
    at = {index: pixel(place) for index, place in exact.items()}
    lines = sorted({(min(a, b), max(a, b)) for surface in surfaces for a, b in sides(surface)})
    number = {pair: str(k) for k, pair in enumerate(edges, 1)} if len(lines) <= MOST_LINES else {}
    inner = [(k, surface) for k, surface in enumerate(surfaces) if k != outer or len(surfaces) == 1]
    polygons = [(k, [at[index] for index in surface]) for k, surface in inner]
    regions = [(str(k + 1), _middle(corners)) for k, corners in polygons if _room(corners) >= _SMALLEST]
    points = [Label(*at[index].place, str(index + 1)) for index in sorted(at)]
    middles = [
        Label((at[a].x + at[b].x) / 200, (at[a].y + at[b].y) / 200, number[a, b], 11.0)
        for a, b in lines
        if (a, b) in number
    ]
    put = place_labels(
        [*points, *middles],
        [(at[a].place, at[b].place) for a, b in lines],
        [place.place for _, place in regions],
        (float(width), float(height)),
    )
    words = "Topological map: points in black, "
    words += "lines L of the convex edge list in italics, " if number else ""
    words += "surfaces in grey" if len(regions) == len(inner) else "surfaces in grey where there is room"
    words += f"; surface {outer + 1} is the outside." if len(surfaces) > 1 else "."
    rows = [*([words_row(title, bold=True)] if title else []), *map(words_row, wrapped(words, width - 2 * MARGIN))]
    items = [
        *svg.group("surfaces", _SURFACES, (svg.text(Pixel(p.x, p.y + 500), name) for name, p in regions)),
        *svg.group(VISIBLE.key, VISIBLE.attributes, _strokes(at, lines)),
        *svg.group(VERTEX.key, VERTEX.attributes, (svg.circle(at[index], svg.RADIUS) for index in sorted(at))),
        *svg.group("numbers", f'{_FONT} text-anchor="middle"', texts(points, put[: len(points)])),
        *svg.group("lines", f'{_LINES} text-anchor="middle"', texts(middles, put[len(points) :])),
        *svg.group("legend", _FONT, (item for k, row in enumerate(rows) for item in row(height + 12 + _LINE * k))),
    ]
    return svg.page(width, height + _LINE * len(rows) + 12, title or "Topological map", items)


def embedded(surfaces: Sequence[Surface], outer: int) -> dict[int, Place]:
    """Where every point lies, the outer surface on a circle about 0,0 of radius 1, its first line below.

    surfaces: each in either sense; a line is on two of them.
    """
    border = surfaces[outer]
    count = len(border)
    places = {}
    for k, index in enumerate(border):
        angle = math.pi * (2 * k - 1) / count - math.pi / 2
        places[index] = (round(math.cos(angle), 12), round(math.sin(angle), 12))
    owners: dict[Pair, list[int]] = {}
    for order, surface in enumerate(surfaces):
        for a, b in sides(surface):
            owners.setdefault((min(a, b), max(a, b)), []).append(order)
    beside: dict[int, list[tuple[int, int, int]]] = {}
    for line, (left, *right) in owners.items():
        for a, b in (line, line[::-1]):
            if a not in places:
                beside.setdefault(a, []).append((b, left, right[0]))
    places |= dict.fromkeys(beside, (0.0, 0.0))
    weights = [1.0] * len(surfaces)
    for turn in range(_TURNS):
        for _ in range(_FIRST if turn == 0 else _ROUNDS):
            for index, around in beside.items():
                total = x = y = 0.0
                for other, one, two in around:
                    weight = weights[one] + weights[two]
                    total += weight
                    x += weight * places[other][0]
                    y += weight * places[other][1]
                places[index] = (x / total, y / total)
        sizes = [abs(_area([places[index] for index in surface])) for surface in surfaces]
        sizes[outer] = 0.0
        mean = sum(sizes) / max(1, len(sizes) - 1)
        for order, size in enumerate(sizes):
            share = size / mean if mean else 1.0
            weights[order] *= min(_STEP, max(1 / _STEP, share))
    return places


def _area(corners: Sequence[Place]) -> float:
    """Twice the area of a polygon."""
    return sum(a * d - b * c for (a, b), (c, d) in zip(corners, [*corners[1:], corners[0]], strict=True))


def _strokes(at: Mapping[int, Pixel], lines: Sequence[Pair]) -> Iterator[str]:
    for a, b in lines:
        yield svg.line(at[a], at[b], f'data-points="{a + 1} {b + 1}"')


def _room(corners: Sequence[Pixel]) -> float:
    """The area of a polygon in square pixels."""
    return abs(_area([corner.place for corner in corners])) / 2


def _middle(corners: Sequence[Pixel]) -> Pixel:
    """The centre of gravity of a polygon's corners."""
    return Pixel(sum(c.x for c in corners) // len(corners), sum(c.y for c in corners) // len(corners))
