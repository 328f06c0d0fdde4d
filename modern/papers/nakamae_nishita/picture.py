"""Write a drawing as SVG, as HPGL for a plotter, or as text with intermediate results and the paper's Table 1.

HPGL is the language of Hewlett-Packard's plotters. The drawing uses its instructions IN, SP, LT, PU (move with the pen
up) and PD (move with the pen down). The drawing consists of straight strokes, one for each piece. If objects touch, a
line that belongs to both may be drawn twice.
"""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction
from typing import get_args

from modern.drawing import svg
from modern.drawing.draw import checked_width
from modern.drawing.layout import MARGIN, Pixel, fit
from modern.drawing.svg import HIDDEN, VISIBLE
from modern.drawing.view import Flat
from modern.drawing.visible import Kind
from modern.papers.nakamae_nishita.hidden import Drawing, Passages, Piece, Relation
from modern.papers.nakamae_nishita.projection import Homogeneous, image

Point = tuple[int, int]
Stroke = tuple[Point, Point]

# The size of the plot in plotter units of 0.025 mm. It fits a sheet of A4 on all plotters that read HPGL.
PLOT_WIDTH, PLOT_HEIGHT = 10_000, 7_200

SOLID, DASHED = "LT;", "LT2,2;"


def plot(groups: Iterable[tuple[str, Iterable[Stroke]]]) -> str:
    """Return groups of strokes, each with a line type, as the text of an HPGL plot.

    The pen stays down if a stroke begins at the end of the previous stroke.
    """
    lines = ["IN;", "SP1;"]
    for kind, strokes in groups:
        at: Point | None = None
        for start, end in strokes:
            if at is None:
                lines.append(kind)
            if start != at:
                lines.append(f"PU{start[0]},{start[1]};")
            lines.append(f"PD{end[0]},{end[1]};")
            at = end
    return "\n".join((*lines, "PU;", "SP0;")) + "\n"


_HIGHEST_SHAPE = Fraction(3, 4)
_BAND = 24


def ends(drawing: Drawing, piece: Piece) -> tuple[Homogeneous, Homogeneous]:
    """Return the two ends of a visible or hidden piece of an edge, in homogeneous coordinates."""
    points = drawing.solids[piece.solid].points
    a, b = points[piece.start], points[piece.end]
    return _between(a, b, piece.first), _between(a, b, piece.last)


def as_svg(drawing: Drawing, title: str = "", width: int = 640) -> str:
    """Return a drawing as the text of an SVG file.

    The attribute ``data-edge`` of a line has the number of its polyhedron and the numbers of the two vertices of its
    edge, all counted from 1. The corners of figures are numbered after the vertices. Raise ExportError for a width out
    of range.
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
    """Return a drawing as HPGL, the language of pen plotters, for a sheet of A4. Hidden pieces are dashed."""
    pixel, height = fit(_extent(drawing), PLOT_WIDTH // 10, PLOT_HEIGHT // 10 - 2 * MARGIN)

    def strokes(visible: bool) -> Iterator[Stroke]:
        for _, *stroke in _strokes(drawing, pixel, visible):
            # A hundredth of a pixel of the drawing is a tenth of a plotter unit. A plotter's y axis points upward.
            start, end = ((round(p.x / 10), 10 * height - round(p.y / 10)) for p in stroke)
            if start != end:
                yield start, end

    return plot(((SOLID, strokes(True)), (DASHED, strokes(False))))


def _strokes(drawing: Drawing, pixel: Callable[[Flat], Pixel], visible: bool) -> Iterator[tuple[Piece, Pixel, Pixel]]:
    for piece in drawing.pieces:
        if piece.visible == visible:
            a, b = (pixel(image(end, drawing.observer)) for end in ends(drawing, piece))
            yield piece, a, b


def _extent(drawing: Drawing) -> list[Flat]:
    """Return the positions of all vertices, hidden or not, which determine the scale of the picture."""
    return [image(point, drawing.observer) for item in drawing.solids for point in item.vertices]


def _between(a: Homogeneous, b: Homogeneous, s: Fraction) -> Homogeneous:
    up, down = s.numerator, s.denominator
    x, y, z, w = ((down - up) * p + up * q for p, q in zip(a, b, strict=True))
    return x, y, z, w


_KINDS: tuple[Kind, ...] = get_args(Kind)


def table1(drawing: Drawing) -> Iterator[str]:
    """Yield the heading and the row of the paper's Table 1 for a drawing, with the measured times of its steps."""
    counts = drawing.counts
    yield "polyhedra  vertices  faces  points       I      II     III  (seconds)"
    times = "".join(f"{seconds:8.3f}" for seconds in drawing.seconds)
    yield f"{counts[0]:9d}{counts[1]:10d}{counts[2]:7d}{counts[3]:8d}{times}"


def tables(drawing: Drawing) -> Iterator[str]:
    """Yield intermediate results as text: the polyhedra, the overlapping pairs, and the segments behind a contour."""
    for solid in drawing.solids:
        kinds = Counter(edge.kind for edge in solid.edges)
        yield f"{solid.number + 1}. {solid.polyhedron.name}"
        yield "  front faces " + (" ".join(str(k) for k, sign in enumerate(solid.signs, 1) if sign > 0) or "none")
        yield "  contour " + (" ".join(str(place + 1) for place in solid.contour) or "none")
        yield "  edges " + ", ".join(f"{kinds[kind]} {kind}" for kind in _KINDS if kinds[kind])
    for relation in drawing.relations:
        yield from _relation(drawing, relation)
    for passages in drawing.passages:
        if passages.behind or passages.ghosts:
            yield from _passages(drawing, passages)


def _relation(drawing: Drawing, relation: Relation) -> Iterator[str]:
    v, w = drawing.solids[relation.v], drawing.solids[relation.w]
    nearer = {1: f"V = {v.number + 1} is nearer", -1: f"V' = {w.number + 1} is nearer", 0: "neither hides the other"}
    yield f"V = {v.number + 1}, V' = {w.number + 1}: {nearer[relation.nearer]}, by {relation.by}"
    columns = [place + 1 for place in v.contour]
    pair = relation.tables
    # Formulas (2) and (3): rows for the vertices of V', columns for those of V, as the paper prints the tables.
    d = tuple(tuple(pair.crossing_number(i, j) for i in range(len(columns))) for j in range(len(pair.pl)))
    for title, rows in (("PL", pair.pl), ("LP", pair.lp), ("d", d)):
        yield f"  {title:4}" + "".join(f"{column:4d}" for column in columns)
        for place, row in zip(w.contour, rows, strict=True):
            yield f"  {place + 1:4d}" + "".join(f"{number:4d}" for number in row)


def _passages(drawing: Drawing, passages: Passages) -> Iterator[str]:
    segment = drawing.solids[passages.solid].segments[passages.segment]
    yield f"{passages.solid + 1}: {segment.start + 1}-{segment.end + 1} ({segment.kind}), order {passages.order}"
    for near, passage in passages.behind:
        marks = ", ".join(f"{index:+d} at {place}" for place, index in passage.marks)
        yield f"  behind {near + 1}: {marks or 'enclosed'}"
    for low, high in passages.ghosts:
        yield f"  ghost from {low} to {high}"
