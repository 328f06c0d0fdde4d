"""Draw results of Appel and Will's method: the hull with its convex edges, and the star polygon of an edge.

Points are labelled with their numbers in the input, and convex edges with their numbers L in the convex edge list. All
decisions are made in integers. Floating-point numbers only place the labels.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from modern.drawing import svg
from modern.drawing.draw import Show, checked_width, filter_scene, pixels_of_points, scene_items, width_of
from modern.drawing.labels import Label, place_labels
from modern.drawing.layout import MARGIN, Pixel, fit, lay_out
from modern.drawing.legend import band, band_height, wrapped
from modern.drawing.scene import scene
from modern.drawing.svg import Style
from modern.drawing.view import view
from modern.geometry.coplanar import Joined
from modern.geometry.hull import DETERMINED, Face
from modern.geometry.hull import Hull as Record
from modern.geometry.mesh import ExportError, Mesh, sides
from modern.geometry.numbers import Point
from modern.geometry.vectors import area_vector, dot, lowest, minus
from modern.papers.appel_will.hull import Assembled
from modern.papers.appel_will.star import Image, Pair, on_one_ray, project, star_polygon, vorticity
from modern.papers.appel_will.surfaces import Surface

WIDTH, WIDER = 640, 1000
# The greatest numbers of points and of convex edges that are numbered.
MOST_POINTS, MOST_LINES = 400, 60
_SIZE, _SMALL = 13.0, 11.0
FONT = f'font-family="{svg.FONT}" font-size="13" fill="#000"'
_LINE_FONT = f'font-family="{svg.FONT}" font-size="11" font-style="italic" fill="#444"'
# A white outline that keeps a number legible on top of lines.
_HALO = 'stroke="#fff" stroke-width="3" paint-order="stroke"'
# The distance between the lines of a legend in pixels.
LEGEND_STEP = 19
GIVEN = Style("given", "given line that is not a convex edge", "line", 'stroke="#777" stroke-width="0.8"')
SIDE = Style("star", "star polygon", "line", 'stroke="#000" stroke-width="1.2" fill="none"')
CLOCKWISE = Style("clockwise", "side that turns clockwise about C", "line", 'stroke="#000" stroke-width="3.4"')
RAY = Style("rays", "ray from C", "line", 'stroke="#aaa" stroke-width="0.8"')
CENTRE = Style("centre", "C", "dot", 'fill="#fff" stroke="#000" stroke-width="1.6"')


class PictureError(ExportError):
    """Raised if a picture cannot be drawn. The message gives the reason in one line."""


def solid_svg(
    hull: Assembled,
    points: Sequence[Point],
    original: Sequence[Surface] = (),
    joined: Joined | None = None,
    eye: Sequence[Fraction] | None = None,
    title: str = "",
    width: int | None = None,
) -> str:
    """Return a picture of the hull and the other lines of the given polyhedron, with hidden edges dashed, as SVG text.

    ``points`` are the coordinates of the input as text. ``original`` are the surfaces of the given polyhedron, if
    known. ``joined`` tells which faces of ``as_mesh(hull)`` are drawn as one face. ``eye`` and ``width`` have the same
    meaning as in ``modern.drawing.draw.draw_svg``. Raise ExportError if there is no hull, or if the view or the width
    is invalid.
    """
    record = as_record(hull, points, joined)
    picture = filter_scene(scene(record, eye), Show())
    width = width_of(picture, width)
    layout = lay_out(picture, width)
    at = pixels_of_points(record, picture, layout)
    drawn = {tuple(sorted((record.vertices[e.start], record.vertices[e.end]))): e for e in picture.edges}
    original_lines = {(min(a, b), max(a, b)) for surface in original for a, b in sides(surface)}
    nonconvex = sorted(original_lines.difference(drawn))
    lines = [(number, pair) for number, pair in enumerate(hull.edges, 1) if pair in drawn]
    numbered = len(points) <= MOST_POINTS
    labelled = numbered and 0 < len(lines) <= MOST_LINES
    legend = "in italics: the number L of each edge in the convex edge list" if labelled else ""
    rows: list[str | Style] = [*([GIVEN] if nonconvex else []), *wrapped(legend, width - 2 * MARGIN)]
    top = layout.height + band_height(picture, width, title, numbered)
    items = [
        *scene_items(record, picture, layout),
        *svg.group(GIVEN.key, GIVEN.attributes, (svg.line(at[a], at[b], named_line(a, b)) for a, b in nonconvex)),
        *(numbers(at, lines if labelled else [], [*drawn, *nonconvex], (width, layout.height)) if numbered else ()),
        *svg.group("legend", FONT, band(picture, width, layout.height, title, numbered)),
        *svg.group("more", FONT, legend_items(rows, top)),
    ]
    return svg.page(width, top + LEGEND_STEP * len(rows) + (4 if rows else 0), title or "Convex edges", items)


def as_mesh(hull: Assembled, points: Sequence[Point]) -> Mesh:
    """Convert the assembled hull to a mesh. The points of the mesh are in the order of ``hull.vertices``."""
    places = {index: place for place, index in enumerate(hull.vertices)}
    faces = tuple(tuple(places[index] for index in surface) for surface in hull.outward())
    return Mesh(hull.dimension, tuple(points[index] for index in hull.vertices), faces)


def as_record(hull: Assembled, points: Sequence[Point], joined: Joined | None = None) -> Record:
    """Convert the assembled hull to a ``Record``, which can be exported. Raise PictureError if it is no hull."""
    if hull.fault:
        raise PictureError(f"there is no hull to draw: {hull.fault}")
    surfaces = hull.outward() if joined is None else joined_surfaces(hull, joined)
    vertices = tuple(sorted({index for surface in surfaces for index in surface})) or hull.vertices
    # Vertices that lie within a merged face are no longer vertices of the record, but boundary points.
    merged_away = set(hull.vertices).difference(vertices)
    first_equal = dict(hull.duplicates)
    rest = [index for index in range(len(points)) if index not in vertices and index not in first_equal]
    solid_faces = hull.surfaces if hull.dimension == 3 else ()
    planes = [(area_vector(hull.points, surface), hull.points[surface[0]]) for surface in solid_faces]
    # Points that are not vertices are on the boundary if they lie in the plane of a surface, otherwise inside.
    on = {index for index in rest if any(not dot(n, minus(hull.points[index], p)) for n, p in planes)}
    if hull.dimension == 3:
        within = [()] * len(surfaces) if joined is None else joined_points(hull, joined)
        faces = [(surface, merged_away.intersection(inner)) for surface, inner in zip(surfaces, within, strict=True)]
    else:
        faces = [(side, set[int]()) for surface in surfaces for side in sides(surface)]
    return Record(
        arithmetic="exact",
        status=DETERMINED,
        dimension=hull.dimension,
        points=tuple(points),
        vertices=vertices,
        boundary=tuple(index for index in rest if index in on or index in merged_away),
        inside=tuple(index for index in rest if index not in on and index not in merged_away),
        duplicates=hull.duplicates,
        faces=tuple(
            Face(("0", "0", "0", "0"), (0, 0, 0, 0), polygon[:3], polygon, tuple(sorted(inner)))
            for polygon, inner in faces
        ),
    )


def joined_surfaces(hull: Assembled, joined: Joined) -> tuple[Surface, ...]:
    """Return the hull's faces, with faces merged as in ``joined``, as cycles of indices of input points."""
    return tuple(tuple(hull.vertices[place] for place in loop) for loop in joined.loops)


def joined_points(hull: Assembled, joined: Joined) -> list[tuple[int, ...]]:
    """Return the indices of the input points of each merged face, including the points in its interior."""
    return [tuple(index for face in group for index in hull.surfaces[face]) for group in joined.groups]


@dataclass(frozen=True, slots=True)
class Star:
    """The star polygon of a line through two points, which decides if the line is an edge (Figs. 8 to 12).

    In the projection parallel to the line, the image of the line is the point C. ``line`` lists the points on the line
    from end to end. ``order`` lists the other points by the angle of their images about C, and ``images`` lists these
    images relative to C. ``outside`` is True if C is outside the star polygon, i.e. if the line is a convex edge.
    ``clockwise`` has the index of the side that turns clockwise about C, or is empty if there is none.
    """

    line: tuple[int, ...]
    order: tuple[int, ...]
    images: tuple[Image, ...]
    outside: bool
    clockwise: tuple[int, ...]


def star(hull: Assembled, pair: Pair) -> Star:
    """Compute the star polygon of the line through two points. Raise PictureError if the points define no line."""
    a, b = pair
    reason = {
        entry.point: f"it lies between points {entry.between[0] + 1} and {entry.between[1] + 1}"
        for entry in hull.deleted
    }
    if hull.preprocessing is not None:
        reason |= dict.fromkeys(hull.preprocessing.deleted, "it is on an inside corner")
    reason |= {index: f"it equals point {first + 1}" for index, first in hull.duplicates}
    for index in pair:
        if not 0 <= index < len(hull.points):
            raise PictureError(f"point {index + 1} does not exist; the points are 1 to {len(hull.points)}")
        if index in reason:
            raise PictureError(f"point {index + 1} was deleted: {reason[index]}")
    if a == b:
        raise PictureError(f"a line needs two different points, found {a + 1} twice")
    # Fig. 9: project all remaining points along the line, then sort their images by angle about C (Figs. 10 and 11).
    live = [index for index in range(len(hull.points)) if index not in reason]
    line = project(hull.points, pair, live).line
    images = {index: project(hull.points, pair, [index]).images[0] for index in live if index not in line}
    points_at: dict[Image, list[int]] = {}
    for index, image in images.items():
        points_at.setdefault(image, []).append(index)
    order = [index for image in dict.fromkeys(star_polygon(list(images.values()))) for index in points_at[image]]
    polygon = tuple(images[index] for index in order)
    polygon_sides = [*pairwise(polygon), (polygon[-1], polygon[0])] if polygon else []
    clockwise = tuple(k for k, (p, q) in enumerate(polygon_sides) if vorticity(p, q) < 0)
    one_ray = all(on_one_ray(polygon[0], image) for image in polygon)
    return Star(tuple(line), tuple(order), polygon, one_ray or bool(clockwise), clockwise)


def star_svg(hull: Assembled, pair: Pair, title: str = "", width: int | None = None) -> str:
    """Return a picture of the star polygon of two points, seen along their line, as the text of an SVG file.

    Raise ExportError for invalid points or an invalid width.
    """
    width = WIDTH if width is None else checked_width(width)
    polygon = star(hull, pair)
    a, b = pair
    # The test works on affine images. The picture shows the true parallel projection along the line.
    sight = view(lowest([Fraction(q - p) for p, q in zip(hull.points[a], hull.points[b], strict=True)]))
    flat = {}
    for index in (a, *polygon.order):
        x, y, z = (Fraction(number) for number in hull.points[index])
        flat[index] = sight.project((x, y, z))
    pixel, height = fit(list(flat.values()), width, max(460, width * 460 // 640))
    at = {index: pixel(image) for index, image in flat.items()}
    ends = list(zip(polygon.order, [*polygon.order[1:], *polygon.order[:1]], strict=True))
    shown = [(p, q) for p, q in ends if at[p] != at[q]]
    bold = [ends[k] for k in polygon.clockwise]
    thin = [side for side in shown if side not in bold]
    together: dict[Pixel, list[int]] = {}
    for index in polygon.order:
        together.setdefault(at[index], []).append(index)
    labels = [Label(*place.place, ",".join(str(k + 1) for k in group)) for place, group in together.items()]
    line = polygon.line if polygon.line[0] < polygon.line[-1] else polygon.line[::-1]
    centre = Label(*at[a].place, f"C = {'-'.join(str(k + 1) for k in line)}")
    segments = [(at[p].place, at[q].place) for p, q in shown] + [(at[a].place, at[k].place) for k in polygon.order]
    label_places = place_labels([*labels, centre], segments, [], (float(width), float(height)))
    rows: list[str | Style] = [
        *wrapped(_verdict(polygon, pair), width - 2 * MARGIN),
        SIDE,
        *([CLOCKWISE] if bold else []),
        RAY,
    ]
    items = [
        *svg.group(RAY.key, RAY.attributes, (svg.line(at[a], place) for place in together)),
        *svg.group(SIDE.key, SIDE.attributes, (svg.line(at[p], at[q], named_line(p, q)) for p, q in thin)),
        *svg.group(CLOCKWISE.key, CLOCKWISE.attributes, (svg.line(at[p], at[q], named_line(p, q)) for p, q in bold)),
        *svg.group("points", svg.VERTEX.attributes, (svg.circle(place, svg.RADIUS) for place in together)),
        *svg.group(CENTRE.key, CENTRE.attributes, [svg.circle(at[a], "4.5")]),
        *svg.group("numbers", f'{FONT} text-anchor="middle" {_HALO}', texts([*labels, centre], label_places)),
        *svg.group("legend", FONT, legend_items(rows, height + 12, title)),
    ]
    total = height + LEGEND_STEP * (len(rows) + bool(title)) + 12
    return svg.page(width, total, title or f"Star polygon of line {a + 1}-{b + 1}", items)


def _verdict(polygon: Star, pair: Pair) -> str:
    subject = f"Star polygon of line {pair[0] + 1}-{pair[1] + 1}, seen along the line: C, the image of the line, is"
    if polygon.outside:
        reason = "one side turns clockwise about it" if polygon.clockwise else "all images are on one ray"
        reason = reason if polygon.order else "no point is off the line"
        return f"{subject} outside ({reason}); the line is a convex edge"
    return f"{subject} inside or on a side; the line is not a convex edge"


def named_line(a: int, b: int) -> str:
    return f'data-points="{a + 1} {b + 1}"'


def numbers(
    at: Mapping[int, Pixel],
    lines: Sequence[tuple[int, Pair]],
    edges: Sequence[Sequence[int]],
    size: tuple[int, int],
    occupied: Sequence[tuple[float, float]] = (),
) -> Iterator[str]:
    """Yield the numbers of points and, in italics, the numbers of lines, as SVG elements.

    If possible, the numbers do not overlap ``edges`` (pairs of points) and ``occupied`` (positions in pixels).
    """
    together: dict[Pixel, list[int]] = {}
    for index, place in sorted(at.items()):
        together.setdefault(place, []).append(index)
    points = [Label(*place.place, ",".join(str(k + 1) for k in group), _SIZE) for place, group in together.items()]
    middles = [
        Label((at[a].x + at[b].x) / 200, (at[a].y + at[b].y) / 200, str(number), _SMALL) for number, (a, b) in lines
    ]
    segments = [(at[a].place, at[b].place) for a, b in edges]
    label_places = place_labels([*points, *middles], segments, occupied, (float(size[0]), float(size[1])))
    yield from svg.group("numbers", f'{FONT} text-anchor="middle"', texts(points, label_places[: len(points)]))
    yield from svg.group("lines", f'{_LINE_FONT} text-anchor="middle"', texts(middles, label_places[len(points) :]))


def texts(labels: Sequence[Label], places: Sequence[tuple[float, float]]) -> Iterator[str]:
    for label, (x, y) in zip(labels, places, strict=True):
        yield svg.text(Pixel(round(100 * x), round(100 * (y + label.size * 0.35))), label.text)


def legend_items(rows: Sequence[str | Style], top: int, title: str = "") -> Iterator[str]:
    """Yield a legend whose first base line is ``top``: a bold title, then texts, and samples of styles with their
    names.
    """
    if title:
        yield svg.text(Pixel(MARGIN * 100, top * 100), title, 'font-weight="bold"')
    for k, row in enumerate(rows, bool(title)):
        base = 100 * (top + LEGEND_STEP * k)
        if isinstance(row, Style):
            yield svg.sample(row, Pixel((MARGIN + 9) * 100, base - 450))
            yield svg.text(Pixel((MARGIN + 26) * 100, base), row.name)
        else:
            yield svg.text(Pixel(MARGIN * 100, base), row)
