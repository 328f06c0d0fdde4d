"""Line drawings of hulls: parallel projection, hidden edges dashed, vertices numbered as the programs number them.

A convex solid hides an edge exactly when both of the edge's faces turn away from the eye.  That is the sign of
formula (1) of Nakamae and Nishita (``modern.drawing.visible``), in fractions of the exact coordinates;
floating point only chooses where numbers are put.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction

from modern.drawing import svg
from modern.drawing.labels import HEIGHT, Label, place_labels
from modern.drawing.layout import Layout, Pixel, lay_out
from modern.drawing.legend import band, band_height, caption
from modern.drawing.scene import Mark, Scene, scene
from modern.geometry.hull import Hull
from modern.geometry.mesh import ExportError

MOST_NUMBERS = 200
"""Beyond this many vertices they are not numbered; nobody could read it."""

_WIDTH, _NARROWEST, _WIDEST = 640, 320, 4000
_FONT = f'font-family="{svg.FONT}" font-size="13" fill="#000"'
_DARKEST, _RANGE = 196, 56


def draw_svg(hull: Hull, eye: Sequence[Fraction | int] | None = None, title: str = "", width: int = _WIDTH) -> str:
    """A picture of a hull as the text of an SVG file.

    eye: the direction from the hull to the eye.  None chooses: of a polyhedron one from a fixed list in which no face
    is edge-on and no two vertices fall together, of a polygon or a segment one at right angles to it.
    title: a line below the picture.  width: of the file in pixels, 320 to 4000; the height follows.

    Numbers are places in ``Hull.vertices``, from 1; vertices less than 2.5 pixels apart share a label.  Faces that are
    seen are shaded.  An edge with a face edge-on and none seen is on the outline and drawn as seen.  Two faces in one
    plane have no edge between them.  The same hull gives the same text everywhere.

    Raises ExportError where there is no hull, for a direction 0,0,0 or one that shows a polygon or segment edge-on, and
    for a width out of range.
    """
    if not _NARROWEST <= width <= _WIDEST:
        raise ExportError(f"a picture {width} pixels wide is not drawn; {_NARROWEST} to {_WIDEST} are")
    picture = scene(hull, None if eye is None else [Fraction(number) for number in eye])
    layout = lay_out(picture, width)
    numbered = len(picture.images) <= MOST_NUMBERS
    items = [
        *_faces(picture, layout),
        *_edges(picture, layout, hidden=True),
        *_points(hull, picture.inside, layout.inside, svg.INSIDE, "inside point"),
        *_points(hull, picture.boundary, layout.boundary, svg.BOUNDARY_HIDDEN, "boundary point", hidden=True),
        *_vertices(hull, picture, layout, hidden=True),
        *_edges(picture, layout, hidden=False),
        *_points(hull, picture.boundary, layout.boundary, svg.BOUNDARY, "boundary point"),
        *_vertices(hull, picture, layout, hidden=False),
        *(_numbers(picture, layout) if numbered else ()),
        *svg.group("legend", _FONT, band(picture, width, layout.height, title, numbered)),
    ]
    return svg.page(width, layout.height + band_height(picture, width, title), title or caption(picture), items)


def _faces(picture: Scene, layout: Layout) -> list[str]:
    def items() -> Iterator[str]:
        for pane in picture.panes:
            level = f"{_DARKEST + int(_RANGE * pane.light):02x}"
            yield svg.polygon((layout.vertices[place] for place in pane.corners), f'fill="#{level * 3}"')

    return svg.group("faces", "", items())


def _edges(picture: Scene, layout: Layout, hidden: bool) -> list[str]:
    style = svg.HIDDEN if hidden else svg.VISIBLE
    return svg.group(
        style.key,
        style.attributes,
        (
            svg.line(
                layout.vertices[edge.start],
                layout.vertices[edge.end],
                f'data-vertices="{edge.start + 1} {edge.end + 1}"',
            )
            for edge in picture.edges
            if edge.hidden == hidden
        ),
    )


def _vertices(hull: Hull, picture: Scene, layout: Layout, hidden: bool) -> list[str]:
    style = svg.VERTEX_HIDDEN if hidden else svg.VERTEX
    return svg.group(
        style.key,
        style.attributes,
        (
            svg.point_mark(style, layout.vertices[place], _title(hull, index, f"vertex {place + 1}"))
            for place, index in enumerate(hull.vertices)
            if picture.hidden[place] == hidden
        ),
    )


def _points(
    hull: Hull, points: Sequence[Mark], places: Sequence[Pixel], style: svg.Style, name: str, hidden: bool = False
) -> list[str]:
    return svg.group(
        style.key,
        style.attributes,
        (
            svg.point_mark(style, place, _title(hull, mark.index, name))
            for mark, place in zip(points, places, strict=True)
            if mark.hidden == hidden
        ),
    )


def _title(hull: Hull, index: int, name: str) -> str:
    return f"{name}: point {index + 1} ({', '.join(hull.points[index])})"


def _numbers(picture: Scene, layout: Layout) -> list[str]:
    """The numbers of the vertices; grey where all vertices of the label are hidden."""
    labels = [
        Label(*layout.vertices[group[0]].place, ",".join(str(place + 1) for place in group)) for group in layout.groups
    ]
    lines = [(layout.vertices[edge.start].place, layout.vertices[edge.end].place) for edge in picture.edges]
    others = [pixel.place for pixel in (*layout.boundary, *layout.inside)]
    centres = place_labels(labels, lines, others, (float(layout.width), float(layout.height)))

    def items() -> Iterator[str]:
        for label, group, (x, y) in zip(labels, layout.groups, centres, strict=True):
            grey = 'fill="#666"' if all(picture.hidden[place] for place in group) else ""
            yield svg.text(Pixel(round(100 * x), round(100 * (y + HEIGHT / 2)) - 200), label.text, grey)

    return svg.group("numbers", f'{_FONT} text-anchor="middle"', items())
