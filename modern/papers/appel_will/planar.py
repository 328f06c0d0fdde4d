"""Draw a polyhedron as a planar map: each face becomes a region, and the face with most points surrounds the others.

This is Tutte's embedding. The points of the outer surface lie on a circle, and every other point lies at a weighted
mean of its neighbours. For any positive weights no two lines cross and every region is convex. The program computes the
positions several times, and each time increases the weights of the lines around large regions. This makes the sizes of
the regions more equal.

References
----------
W. T. Tutte, "How to draw a graph", Proceedings of the London Mathematical Society 13 (1963).
"""

import math
from collections.abc import Sequence
from fractions import Fraction

from modern.drawing import svg
from modern.drawing.draw import checked_width
from modern.drawing.layout import MARGIN, Pixel, fit
from modern.drawing.legend import wrapped
from modern.drawing.svg import VERTEX, VISIBLE
from modern.geometry.mesh import sides
from modern.papers.appel_will.pictures import (
    FONT,
    LEGEND_STEP,
    MOST_LINES,
    WIDER,
    WIDTH,
    PictureError,
    legend_items,
    named_line,
    numbers,
)
from modern.papers.appel_will.star import Pair
from modern.papers.appel_will.surfaces import Surface

Place = tuple[float, float]
# A map of more than MOST points is illegible. A map of more than CROWD points needs a wider picture.
MOST, CROWD = 100, 24
# The weights are changed _TURNS times, each by a factor of at most _STEP. The first change follows _FIRST relaxations,
# each later change _ROUNDS relaxations.
_TURNS, _FIRST, _ROUNDS, _STEP = 150, 200, 10, 1.1
# The size in square pixels from which on a region is numbered.
_SMALLEST = 160.0
_SURFACES = f'font-family="{svg.FONT}" font-size="15" fill="#999" text-anchor="middle"'


def map_svg(surfaces: Sequence[Surface], edges: Sequence[Pair], title: str = "", width: int | None = None) -> str:
    """Return the planar map of a polyhedron or a polygon, with its points, lines and faces numbered, as SVG text.

    ``edges`` is the convex edge list. The label of a line is its position in this list. If there are more than
    ``MOST_LINES`` lines, none has a label. ``width`` is in pixels. The default is 640, or 1000 for more than ``CROWD``
    points.

    Raise ExportError for a map without surfaces or with more than ``MOST`` points, and for a width out of range.
    """
    if not surfaces:
        raise PictureError("expected a hull with surfaces, found none: there is no map to draw")
    count = len({index for surface in surfaces for index in surface})
    if count > MOST:
        raise PictureError(f"a map of {count} points cannot be drawn legibly; the limit is {MOST} points")
    default = WIDTH if count <= CROWD else WIDER
    width = default if width is None else checked_width(width)
    # The surface with most points becomes the outside, which leaves the most room for the others.
    outer = max(range(len(surfaces)), key=lambda number: (len(surfaces[number]), -number))
    places = embedded(surfaces, outer)
    exact = {index: (Fraction(x), Fraction(y)) for index, (x, y) in places.items()}
    pixel, height = fit(list(exact.values()), width, max(460, width * 460 // 640))
    at = {index: pixel(place) for index, place in exact.items()}
    lines = sorted({(min(a, b), max(a, b)) for surface in surfaces for a, b in sides(surface)})
    number = {pair: k for k, pair in enumerate(edges, 1)} if len(lines) <= MOST_LINES else {}
    # A single polygon is not the outside of other regions, but a region itself.
    inner = [(k, surface) for k, surface in enumerate(surfaces) if k != outer or len(surfaces) == 1]
    polygons = [(k, [at[index] for index in surface]) for k, surface in inner]
    regions = [
        (str(k + 1), _middle(corners))
        for k, corners in polygons
        if abs(_area([c.place for c in corners])) >= 2 * _SMALLEST
    ]
    numbered = [(number[pair], pair) for pair in lines if pair in number]
    legend = "Topological map: points in black, "
    legend += "lines L of the convex edge list in italics, " if number else ""
    legend += "surfaces in grey" if len(regions) == len(inner) else "surfaces in grey if there is room"
    legend += f"; surface {outer + 1} is the outside." if len(surfaces) > 1 else "."
    rows = wrapped(legend, width - 2 * MARGIN)
    items = [
        *svg.group("surfaces", _SURFACES, (svg.text(Pixel(p.x, p.y + 500), name) for name, p in regions)),
        *svg.group(VISIBLE.key, VISIBLE.attributes, (svg.line(at[a], at[b], named_line(a, b)) for a, b in lines)),
        *svg.group(VERTEX.key, VERTEX.attributes, (svg.circle(at[index], svg.RADIUS) for index in sorted(at))),
        *numbers(at, numbered, lines, (width, height), [place.place for _, place in regions]),
        *svg.group("legend", FONT, legend_items(rows, height + 12, title)),
    ]
    total = height + LEGEND_STEP * (len(rows) + bool(title)) + 12
    return svg.page(width, total, title or "Topological map", items)


def embedded(surfaces: Sequence[Surface], outer: int) -> dict[int, Place]:
    """Return the position of each point of a planar map.

    The points of the surface ``outer`` are on the unit circle, and all others are inside it. The first side of
    ``outer`` is at the bottom. Every line must be on two surfaces, which may run in either direction.
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
    # For every inner point, its neighbours, each with the two surfaces at the line to this neighbour.
    neighbours: dict[int, list[tuple[int, int, int]]] = {}
    for line, (first, *opposite) in owners.items():
        for a, b in (line, line[::-1]):
            if a not in places:
                neighbours.setdefault(a, []).append((b, first, opposite[0]))
    places |= dict.fromkeys(neighbours, (0.0, 0.0))
    weights = [1.0] * len(surfaces)
    for turn in range(_TURNS):
        # Gauss-Seidel relaxation of Tutte's linear system: move every inner point to the mean of its neighbours.
        for _ in range(_FIRST if turn == 0 else _ROUNDS):
            for index, around in neighbours.items():
                total = x = y = 0.0
                for neighbour, first, second in around:
                    weight = weights[first] + weights[second]
                    total += weight
                    x += weight * places[neighbour][0]
                    y += weight * places[neighbour][1]
                places[index] = (x / total, y / total)
        # Pull the lines of regions larger than the average tighter, by a bounded factor so that the rounds converge.
        sizes = [abs(_area([places[index] for index in surface])) for surface in surfaces]
        sizes[outer] = 0.0
        mean = sum(sizes) / max(1, len(sizes) - 1)
        for order, size in enumerate(sizes):
            share = size / mean if mean else 1.0
            weights[order] *= min(_STEP, max(1 / _STEP, share))
    return places


def _area(corners: Sequence[Place]) -> float:
    return sum(a * d - b * c for (a, b), (c, d) in zip(corners, [*corners[1:], corners[0]], strict=True))


def _middle(corners: Sequence[Pixel]) -> Pixel:
    return Pixel(sum(c.x for c in corners) // len(corners), sum(c.y for c in corners) // len(corners))
