"""Draw hulls as lines in parallel projection. Hidden edges are dashed; vertices are numbered as in Butler's programs.

An edge of a convex solid is hidden if and only if both of its faces are turned away from the eye. The sign of formula
(1) of Nakamae and Nishita (``modern.drawing.visible``) decides this and is computed exactly, with fractions.
Floating-point numbers only choose the positions of labels.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Literal

from modern.drawing import svg
from modern.drawing.labels import HEIGHT, Label, place_labels
from modern.drawing.layout import Layout, Pixel, lay_out
from modern.drawing.legend import band, band_height, caption
from modern.drawing.scene import Scene, scene
from modern.geometry.hull import Hull
from modern.geometry.mesh import ExportError

# The largest number of vertices that are numbered.
MOST_NUMBERS = 400

_WIDTH, _WIDER, _NARROWEST, _WIDEST = 640, 1000, 320, 4000
# With more points than _MANY, marks and numbers are smaller. With more than _CROWD, hidden vertices are not numbered.
_MANY, _CROWD = 60, 120
_FONT = f'font-family="{svg.FONT}" font-size="13" fill="#000"'
_DARKEST, _RANGE = 196, 56

# The labels of vertices: none, their places in ``Hull.vertices`` (the numbers that Butler's programs use), or their
# places in the input.
Labels = Literal["none", "programs", "input"]


@dataclass(frozen=True, slots=True)
class Show:
    """The parts of a picture that the user has chosen to draw."""

    # The numbers of the vertices.
    labels: Labels = "programs"
    # Hidden edges and hidden points.
    hidden: bool = True
    # The points that are not vertices.
    points: bool = True


def draw_svg(
    hull: Hull,
    eye: Sequence[Fraction | int] | None = None,
    title: str = "",
    width: int | None = None,
    show: Show | None = None,
) -> str:
    """Return a picture of a hull as the text of an SVG file.

    ``eye`` is the direction from the hull to the eye. If ``eye`` is None, the program chooses the direction. For a
    polyhedron, it chooses from a fixed list a direction in which no face is edge-on and no two vertices coincide. For a
    polygon or a segment, it chooses a perpendicular direction. ``title`` is a line below the picture. ``width`` is 320
    to 4000 pixels, by default 640, or 1000 for more than 120 points. Raise ExportError if there is no hull, if the
    direction is 0,0,0, if a polygon would appear as a line or a segment as a point, or if the width is out of range.

    Vertices within 2.5 pixels of each other share a label with all their numbers. With more than 120 points only
    visible vertices are numbered, and with more than 400 vertices no vertex is numbered. Visible faces are shaded. If
    one face of an edge is edge-on and the other one is not visible, the edge lies on the outline and is drawn as
    visible. The same hull gives the same text on every machine.
    """
    show = show or Show()
    picture = filter_scene(scene(hull, None if eye is None else [Fraction(number) for number in eye]), show)
    width = width_of(picture, width)
    layout = lay_out(picture, width)
    numbered = show.labels != "none" and len(picture.images) <= MOST_NUMBERS
    explained = numbered or show.labels == "none"
    items = [
        *scene_items(hull, picture, layout),
        *(number_items(hull, picture, layout, show.labels) if numbered else ()),
        *svg.group("legend", _FONT, band(picture, width, layout.height, title, explained)),
    ]
    return svg.page(
        width, layout.height + band_height(picture, width, title, explained), title or caption(picture), items
    )


def filter_scene(picture: Scene, show: Show) -> Scene:
    """Return the scene without the parts that the user has chosen not to draw."""
    if not show.points:
        picture = replace(picture, boundary=(), inside=())
    if not show.hidden:
        picture = replace(picture, boundary=tuple(mark for mark in picture.boundary if not mark.hidden))
    return replace(picture, behind=show.hidden)


def width_of(picture: Scene, width: int | None) -> int:
    """Return the requested width of a picture in pixels, or the default width for its number of points.

    Raise ExportError if the requested width is out of range.
    """
    if width is None:
        return _WIDTH if _points(picture) <= _CROWD else _WIDER
    return checked_width(width)


def checked_width(width: int) -> int:
    """Return the width of a picture, in pixels, unchanged. Raise ExportError if it is out of range."""
    if not _NARROWEST <= width <= _WIDEST:
        raise ExportError(f"a picture cannot be {width} pixels wide; the width is from {_NARROWEST} to {_WIDEST}")
    return width


def _points(picture: Scene) -> int:
    return len(picture.images) + len(picture.boundary) + len(picture.inside)


def scene_items(hull: Hull, picture: Scene, layout: Layout) -> list[str]:
    """Return the SVG elements of faces, edges and points. Hidden edges and points come before visible ones."""
    small = _points(picture) > _MANY

    def edges(style: svg.Style, hidden: bool) -> list[str]:
        ends = ((edge.start, edge.end) for edge in picture.edges if edge.hidden == hidden)
        corners = layout.vertices
        lines = (svg.line(corners[a], corners[b], f'data-vertices="{a + 1} {b + 1}"') for a, b in ends)
        return svg.group(style.key, style.attributes, lines)

    def dots(style: svg.Style, points: Iterable[tuple[Pixel, int, str]]) -> list[str]:
        titled = ((at, f"{name}: point {index + 1} ({', '.join(hull.points[index])})") for at, index, name in points)
        marks = (svg.point_mark(style, at, title, small=small) for at, title in titled)
        return svg.group(style.key, style.attributes, marks)

    def vertices(hidden: bool) -> Iterator[tuple[Pixel, int, str]]:
        for k, index in enumerate(hull.vertices):
            if picture.hidden[k] == hidden:
                yield layout.vertices[k], index, f"vertex {k + 1}"

    def boundary(hidden: bool) -> Iterator[tuple[Pixel, int, str]]:
        both = zip(picture.boundary, layout.boundary, strict=True)
        return ((at, mark.index, "boundary point") for mark, at in both if mark.hidden == hidden)

    inside = zip(picture.inside, layout.inside, strict=True)
    return [
        *_faces(picture, layout),
        *(edges(svg.HIDDEN, True) if picture.behind else ()),
        *dots(svg.INSIDE, ((at, mark.index, "inside point") for mark, at in inside)),
        *dots(svg.BOUNDARY_HIDDEN, boundary(True)),
        *(dots(svg.VERTEX_HIDDEN, vertices(True)) if picture.behind else ()),
        *edges(svg.VISIBLE, False),
        *dots(svg.BOUNDARY, boundary(False)),
        *dots(svg.VERTEX, vertices(False)),
    ]


def pixels_of_points(hull: Hull, picture: Scene, layout: Layout) -> dict[int, Pixel]:
    """Return the position of each point of the input, by its index; duplicates have the position of the first point."""
    pixels = {index: layout.vertices[place] for place, index in enumerate(hull.vertices)}
    for marks, places in ((picture.boundary, layout.boundary), (picture.inside, layout.inside)):
        pixels.update({mark.index: at for mark, at in zip(marks, places, strict=True)})
    return pixels | {index: pixels[first] for index, first in hull.duplicates}


def _faces(picture: Scene, layout: Layout) -> list[str]:
    polygons = []
    for pane in picture.panes:
        level = f"{_DARKEST + int(_RANGE * pane.light):02x}"
        polygons.append(svg.polygon((layout.vertices[place] for place in pane.corners), f'fill="#{level * 3}"'))
    return svg.group("faces", "", polygons)


def number_items(hull: Hull, picture: Scene, layout: Layout, which: Labels) -> list[str]:
    """Return the numbers of the vertices as SVG elements. A label is grey if all vertices that share it are hidden."""
    count = _points(picture)
    size = HEIGHT if count <= _MANY else 10.0 if count <= _CROWD else 9.0
    behind = picture.behind and count <= _CROWD
    # The vertices of a group share a label. If hidden parts are not drawn, hidden vertices are omitted from the label.
    shown = [tuple(place for place in group if behind or not picture.hidden[place]) for group in layout.groups]
    groups = [group for group in shown if group]

    def name(place: int) -> str:
        return str(hull.vertices[place] + 1 if which == "input" else place + 1)

    labels = [Label(*layout.vertices[group[0]].place, ",".join(map(name, group)), size) for group in groups]
    lines = [
        (layout.vertices[edge.start].place, layout.vertices[edge.end].place)
        for edge in picture.edges
        if picture.behind or not edge.hidden
    ]
    other_points = [pixel.place for pixel in (*layout.boundary, *layout.inside)]
    centres = place_labels(labels, lines, other_points, (float(layout.width), float(layout.height)))
    items = []
    for label, group, (x, y) in zip(labels, groups, centres, strict=True):
        grey = 'fill="#666"' if all(picture.hidden[place] for place in group) else ""
        items.append(svg.text(Pixel(round(100 * x), round(100 * (y + size * 0.35))), label.text, grey))
    font = _FONT.replace('"13"', f'"{size:g}"')
    return svg.group("numbers", f'{font} text-anchor="middle"', items)
