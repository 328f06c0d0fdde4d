"""A drawing as SVG or as HPGL for a plotter.

HPGL is the language of Hewlett-Packard's plotters: pen up, pen down and absolute moves (instructions IN SP LT PU PD).
The drawing consists of straight strokes, one for each visible piece. Where parts of objects touch, a line that belongs
to both may be drawn twice.
"""

from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction

from modern.drawing import svg
from modern.drawing.draw import checked_width
from modern.drawing.layout import MARGIN, Pixel, fit
from modern.drawing.svg import HIDDEN, VISIBLE
from modern.drawing.view import Flat
from modern.papers.nakamae_nishita.hidden import Drawing, Piece
from modern.papers.nakamae_nishita.projection import Homogeneous, image

Point = tuple[int, int]
Stroke = tuple[Point, Point]

# The area, in plotter units of 0.025 mm, that fits a sheet of A4 on every such plotter.
PLOT_WIDTH, PLOT_HEIGHT = 10_000, 7_200

SOLID, DASHED = "LT;", "LT2,2;"


def plot(groups: Iterable[tuple[str, Iterable[Stroke]]]) -> str:
    """Return the text of a plot. Each group has a line type and straight strokes, drawn in the given order.

    The pen stays down if a stroke begins at the end of the previous one.
    """
    lines = ["IN;", "SP1;"]
    for kind, strokes in groups:
        drawn = list(_moves(strokes))
        lines += [kind, *drawn] if drawn else []
    return "\n".join((*lines, "PU;", "SP0;")) + "\n"


def _moves(strokes: Iterable[Stroke]) -> Iterator[str]:
    at: Point | None = None
    for start, end in strokes:
        if start != at:
            yield f"PU{start[0]},{start[1]};"
        yield f"PD{end[0]},{end[1]};"
        at = end


_HIGHEST_SHAPE = Fraction(3, 4)
_BAND = 24


def ends(drawing: Drawing, piece: Piece) -> tuple[Homogeneous, Homogeneous]:
    """Return the two ends of a piece in homogeneous coordinates."""
    points = drawing.solids[piece.solid].points
    a, b = points[piece.start], points[piece.end]
    return _between(a, b, piece.first), _between(a, b, piece.last)


def as_svg(drawing: Drawing, title: str = "", width: int = 640) -> str:
    """Return the text of an SVG file.

    The attribute ``data-edge`` of a line names its polyhedron and the two vertices of its edge, from 1. The numbers of
    figures' corners follow those of the vertices. Raise ExportError for a width out of range.
    """
    pixel, height = fit(_extent(drawing), checked_width(width), int(width * _HIGHEST_SHAPE))

    def lines(visible: bool) -> Iterator[str]:
        for piece, a, b in _strokes(drawing, pixel, visible):
            if a != b:
                yield svg.line(a, b, f'data-edge="{piece.solid + 1}: {piece.start + 1} {piece.end + 1}"')

    items = [
        *svg.group(HIDDEN.key, HIDDEN.attributes, lines(False)),
        *svg.group(VISIBLE.key, VISIBLE.attributes, lines(True)),
    ]
    if title:
        font = f'font-family="{svg.FONT}" font-size="13" fill="#000"'
        items += svg.group("legend", font, [svg.text(Pixel(100 * MARGIN, 100 * height), title)])
        height += _BAND
    return svg.page(width, height, title or "Hidden lines removed", items)


def as_hpgl(drawing: Drawing) -> str:
    """Return the text of a plot on a sheet of A4, with hidden pieces dashed."""
    pixel, height = fit(_extent(drawing), PLOT_WIDTH // 10, PLOT_HEIGHT // 10 - 2 * MARGIN)

    def strokes(visible: bool) -> Iterator[Stroke]:
        for _, *stroke in _strokes(drawing, pixel, visible):
            # Hundredths of a pixel are tenths of a plotter unit. A plotter's y axis points upward.
            start, end = ((round(p.x / 10), 10 * height - round(p.y / 10)) for p in stroke)
            if start != end:
                yield start, end

    return plot(((SOLID, strokes(True)), (DASHED, strokes(False))))


def _strokes(drawing: Drawing, pixel: Callable[[Flat], Pixel], visible: bool) -> Iterator[tuple[Piece, Pixel, Pixel]]:
    """Yield the visible or the hidden pieces with the places of their ends."""
    for piece in drawing.pieces:
        if piece.visible == visible:
            a, b = (pixel(image(end, drawing.observer)) for end in ends(drawing, piece))
            yield piece, a, b


def _extent(drawing: Drawing) -> list[Flat]:
    """Return the images of all vertices, so that the scale does not depend on which pieces are hidden."""
    return [image(point, drawing.observer) for item in drawing.solids for point in item.vertices]


def _between(a: Homogeneous, b: Homogeneous, s: Fraction) -> Homogeneous:
    up, down = s.numerator, s.denominator
    x, y, z, w = ((down - up) * p + up * q for p, q in zip(a, b, strict=True))
    return x, y, z, w
