"""The pictures of the four papers, drawn from the intermediate results of each method."""

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import combinations

from modern.claims.published import PAPERS, printed_lines
from modern.drawing import svg
from modern.drawing.labels import Label, place_labels
from modern.drawing.layout import Pixel, fit
from modern.drawing.view import Eye, view
from modern.geometry.mesh import sides
from modern.geometry.vectors import Vector
from modern.papers.appel_will import appel_will
from modern.papers.appel_will.hull import Assembled
from modern.papers.appel_will.loops import Loop
from modern.papers.appel_will.pictures import solid_svg, star, star_svg, texts
from modern.papers.appel_will.planar import embedded, map_svg
from modern.papers.appel_will.results import Solid, found_solid, printed_solid
from modern.papers.appel_will.star import vorticity
from modern.papers.kovalevsky_schulz.cells import all_rows
from modern.publication import steps
from modern.publication.site.made import Part, one_of
from modern.publication.site.markup import details, element, escape, figure, preformatted, table, text
from modern.publication.steps import EDGE_OF_CONTOUR, EYE, HIDDEN, REMOVED, SEEN, Level, Plate, Stroke

# The width of a picture in pixels.
WIDTH = 328
_MARGIN = 12
_STYLES = {
    SEEN: 'stroke="#000" stroke-width="1.1" stroke-linecap="round"',
    EDGE_OF_CONTOUR: 'stroke="#000" stroke-width="1.8" stroke-linecap="round"',
    HIDDEN: 'stroke="#777" stroke-width="0.9" stroke-dasharray="4 3"',
    REMOVED: 'stroke="#777" stroke-width="0.8" stroke-dasharray="3 3"',
}
_FONT = f'font-family="{svg.FONT}" font-size="13" fill="#000" text-anchor="middle"'
# The styles of an edge that no loop, one loop and two loops have used.
_USES = (
    'stroke="#777" stroke-width="0.9" stroke-dasharray="3 3"',
    'stroke="#000" stroke-width="1.4"',
    'stroke="#000" stroke-width="3"',
)


def make(argument: str) -> list[Part]:
    """Return the pictures of a paper: ``appel-will``, ``kovalevsky-schulz``, ``yau-srihari`` or ``nakamae-nishita``."""
    makers = {
        "appel-will": _appel_will,
        "kovalevsky-schulz": _cells,
        "yau-srihari": _octree,
        "nakamae-nishita": _hidden_lines,
    }
    return [Part(html=html) for html in makers[one_of(argument, makers)]()]


def _strip(figures: Iterable[str]) -> str:
    return element("ol", "".join(element("li", picture) for picture in figures), cls="strip")


def _captioned(picture: str, key: str, caption: str) -> str:
    """Return a picture whose caption, in plain text, also describes it for screen readers."""
    return figure(picture, key, escape(caption), description=caption)


def _appel_will() -> Iterator[str]:
    printed = printed_solid(printed_lines(next(paper for paper in PAPERS if paper.name == "appel-will")))
    fig14 = appel_will(found_solid("fig14").points)
    fig23 = appel_will(found_solid("fig23").points)
    yield _strip((_solid(printed, "4"), _solid(found_solid("fig18"), "18")))
    fig4 = appel_will(printed.points, printed.surfaces)
    yield _strip((_star(fig4, fig4.edges[0]), _star(fig4, within(fig4))))
    loops = fig14.table.loops
    yield text("p", f"The {len(loops)} loops of Fig. 22 in order. The number at an edge counts its uses so far.")
    yield _strip(_loop(fig14, number, loop) for number, loop in enumerate(loops, 1))
    caption = (
        f"The topological map of the object in Fig. 23, drawn in the plane: {len(fig23.vertices)} points, "
        f"{len(fig23.edges)} edges and {len(fig23.surfaces)} surfaces. No two edges cross."
    )
    yield _captioned(map_svg(fig23.surfaces, fig23.edges, width=340), "map23", caption)


def _solid(solid: Solid, number: str) -> str:
    hull = appel_will(solid.points, solid.surfaces)
    lines = {tuple(sorted(line)) for surface in solid.surfaces for line in sides(surface)}
    not_convex, new = len(lines.difference(hull.edges)), len(set(hull.edges) - lines)
    caption = f"Fig. {number}: {len(lines)} lines. {not_convex} of them are not convex edges, and "
    points = [(str(x), str(y), str(z)) for x, y, z in solid.points]
    picture = solid_svg(hull, points, solid.surfaces, width=320)
    return _captioned(picture, f"solid{number}", f"{caption}{new} convex edges are new.")


def within(hull: Assembled) -> tuple[int, int]:
    """Return the first pair of vertices, as indices, that no edge joins according to Appel and Will's test."""
    for pair in combinations(hull.vertices, 2):
        images = star(hull, pair).images
        if all(vorticity(a, b) > 0 for a, b in zip(images, (*images[1:], images[0]), strict=True)):
            return pair
    raise ValueError("expected a line that is no edge of the hull, found none")


def _star(hull: Assembled, pair: tuple[int, int]) -> str:
    a, b = pair
    position = "outside, so the line is a convex edge" if pair in hull.edges else "inside, so it is not a convex edge"
    caption = f"Fig. 4, line {a + 1}-{b + 1} in the direction of the line: C is {position}."
    return _captioned(star_svg(hull, pair, width=320), f"star{a + 1}-{b + 1}", caption)


def _loop(hull: Assembled, number: int, loop: Loop) -> str:
    points = ", ".join(str(index + 1) for index in hull.surfaces[number - 1])
    entries = " ".join(map(str, loop.entries))
    return _captioned(loop_svg(hull, number), f"loop{number}", f"Loop {number}: lines {entries}, surface {points}.")


def loop_svg(hull: Assembled, number: int) -> str:
    """Draw the planar map of a hull's edges after a loop is closed (Appel and Will).

    The surface of the loop is grey. The number at each edge is the number of loops found so far that contain the edge.
    The surface with most points is the outside of the map, so its grey area surrounds the map.
    """
    loop, surfaces = hull.table.loops[number - 1], hull.surfaces
    outer = max(range(len(surfaces)), key=lambda k: (len(surfaces[k]), -k))
    places = {k: (Fraction(x), Fraction(y)) for k, (x, y) in embedded(surfaces, outer).items()}
    pixel, height = fit(list(places.values()), WIDTH, WIDTH, 26)
    at = {index: pixel(place) for index, place in places.items()}
    mine = [at[index] for index in surfaces[number - 1]]
    lines = [(at[a].place, at[b].place) for a, b in hull.edges]
    names = [Label(*at[index].place, str(index + 1)) for index in sorted(at)]
    middles = [
        Label((at[a].x + at[b].x) / 200, (at[a].y + at[b].y) / 200, str(uses), 11.0)
        for (a, b), uses in zip(hull.edges, loop.uses, strict=True)
    ]
    put = place_labels([*names, *middles], lines, [], (float(WIDTH), float(height)))

    def edges(uses: int) -> Iterator[str]:
        for (a, b), count in zip(hull.edges, loop.uses, strict=True):
            if count == uses:
                yield svg.line(at[a], at[b], f'data-uses="{uses}"')

    if number - 1 == outer:
        ring = [Pixel(100, 100), Pixel(100 * WIDTH - 100, 100)]
        ring += [Pixel(p.x, 100 * height - 100) for p in reversed(ring)]
        path = "M" + "L".join(f"{svg.number(p.x)} {svg.number(p.y)}" for p in ring) + "ZM"
        path += "L".join(f"{svg.number(p.x)} {svg.number(p.y)}" for p in mine) + "Z"
        ground = [f'<path d="{path}" fill="#ddd" fill-rule="evenodd"/>']
    else:
        ground = [svg.polygon(mine, 'fill="#ddd"')]
    items = [
        *ground,
        *(item for uses, style in enumerate(_USES) for item in svg.group(f"uses-{uses}", style, edges(uses))),
        *svg.group("points", svg.VERTEX.attributes, (svg.circle(at[index], svg.RADIUS) for index in sorted(at))),
        *svg.group("numbers", f'{_FONT} font-weight="bold"', texts(names, put[: len(names)])),
        *svg.group("counts", _FONT.replace('"13"', '"11"'), texts(middles, put[len(names) :])),
    ]
    return svg.page(WIDTH, height, f"Loop {number}", items)


def plates_svg(plates: Sequence[Plate], eye: Eye, titles: Sequence[str]) -> tuple[str, ...]:
    """Draw the steps of a method as SVG, all from the same direction and at the same scale."""
    sight = view(eye)

    def ends(plate: Plate) -> Iterator[Vector]:
        for stroke in plate.strokes:
            yield from (stroke.start, stroke.end)
        for pane in plate.panes:
            yield from pane.corners
        yield from (point for point, _ in plate.points)

    pixel, height = fit([sight.project(p) for plate in plates for p in ends(plate)], WIDTH, WIDTH, _MARGIN)

    def at(point: Vector) -> Pixel:
        return pixel(sight.project(point))

    def lines(strokes: Iterable[Stroke], kind: str) -> Iterator[str]:
        return (svg.line(at(stroke.start), at(stroke.end)) for stroke in strokes if stroke.kind == kind)

    def shades(plate: Plate) -> Iterator[str]:
        for pane in plate.panes:
            level = f"{150 + round(90 * pane.light):02x}"
            yield svg.polygon(map(at, pane.corners), f'fill="#{level * 3}"')

    def dots(plate: Plate) -> Iterator[str]:
        for point, hidden in plate.points:
            yield svg.circle(at(point), "3.6", attributes='fill="#fff"' if hidden else 'fill="#000"')

    def drawn(plate: Plate, title: str) -> str:
        items = [*svg.group("faces", 'stroke="#000" stroke-width="0.8"', shades(plate))]
        for kind in (REMOVED, HIDDEN, SEEN, EDGE_OF_CONTOUR):
            items += svg.group(kind, _STYLES[kind], lines(plate.strokes, kind))
        items += svg.group("points", 'stroke="#000" stroke-width="1.1"', dots(plate))
        return svg.page(WIDTH, height, title, items)

    return tuple(drawn(plate, title) for plate, title in zip(plates, titles, strict=True))


def _hidden_lines() -> Iterator[str]:
    eye, plates = steps.hidden_lines()
    everything, facing, nearer, result = plates
    captions = (
        f"1. All {len(everything.strokes)} lines.",
        f"2. Dashed: {facing.count(REMOVED)} edges without a face towards the eye are removed. Bold: contours.",
        f"3. Dashed: {nearer.count(REMOVED)} pieces behind a nearer contour are removed.",
        f"4. Dashed: {result.count(REMOVED)} pieces that only divide one object (ghost lines) are removed. "
        f"The remaining {result.count(SEEN)} pieces are the drawing.",
    )
    yield _strip(_figures(plates, eye, captions, "hidden"))


def _figures(plates: Sequence[Plate], eye: Eye, captions: Sequence[str], key: str) -> Iterator[str]:
    for plate, picture, caption in zip(plates, plates_svg(plates, eye, captions), captions, strict=True):
        yield _captioned(picture, f"{key}-{plate.name.replace(' ', '-')}", caption)


def _cells() -> Iterator[str]:
    complexes = steps.cells()
    (_, (_, _, _, voxels)), *_ = complexes.counts
    hull = complexes.hull
    hidden_vertices = sum(hidden for _, hidden in complexes.plates[1].points)
    captions = (
        f"The {voxels} voxels of a ball of diameter {steps.DIAMETER}: 3-cells.",
        f"The hull's {len(hull.vertices)} vertices, 0-cells. The {hidden_vertices} hidden ones are hollow.",
        f"Its {len(hull.edges)} edges, 1-cells. Hidden edges are dashed.",
        f"Its {len(hull.faces)} faces, 2-cells. {len(complexes.plates[3].panes)} are visible.",
    )
    yield _strip(_figures(complexes.plates, EYE, captions, "cells"))
    head = ("complex", "0-cells", "1-cells", "2-cells", "3-cells")
    rows = [(escape(name), *map(str, numbers)) for name, numbers in complexes.counts]
    yield table(head, rows, "Numbers of cells", "Cells by dimension")
    cell_list = preformatted("\n".join(all_rows(hull)), "the cell list")
    yield details("The cell list in the form of Tables 1 to 3", cell_list)


def _octree() -> Iterator[str]:
    hull, levels = steps.rods()
    rods = f"Three rods of {steps.RODS} voxels along the axes, {hull.solid_voxels} voxels together"
    yield text("p", f"{rods}, have a digital hull of {hull.voxels} voxels. Its octree, level by level:")
    head = ("level", "side of a cube", "full", "divided", "empty")
    numbers = ((le.number, hull.side >> le.number, le.full, le.divided, le.empty) for le in levels)
    yield table(head, (map(str, row) for row in numbers), "The octree", "Cubes of the hull's octree")
    shown = [level for level in levels if level.plate.strokes]
    captions = [f"The full cubes down to level {level.number}." for level in shown]
    yield _strip(_figures([level.plate for level in shown], steps.ABOVE, captions, "octree"))
    ceiling = "The upper ceiling, a quadtree with the greatest height in every square."
    yield text("p", f"{ceiling} A dotted square has no column. x increases to the right, y upward.")
    yield _strip(_square(level, hull.side) for level in levels)


def _square(level: Level, side: int) -> str:
    columns = sum(quadrant.height is not None for quadrant in level.quadrants)
    content = f"columns in {columns} of {len(level.quadrants)} squares" if level.number else "the whole square"
    caption = f"Level {level.number}: {content}."
    return _captioned(quadrants_svg(level, side), f"quadrants{level.number}", caption)


def quadrants_svg(level: Level, side: int) -> str:
    """Draw the quadrants of a level of the quadtree of heights as squares. A greater height has a lighter grey."""
    room = WIDTH - 2 * _MARGIN
    unit = 100 * room // side

    def squares(occupied: bool) -> Iterator[str]:
        for quadrant in level.quadrants:
            if (quadrant.height is not None) == occupied:
                x = 100 * _MARGIN + quadrant.x * unit
                y = 100 * _MARGIN + (side - quadrant.y - quadrant.side) * unit
                wide = svg.number(quadrant.side * unit)
                grey = f"{190 + 60 * (quadrant.height or 0) // side:02x}" * 3
                fill = f"#{grey}" if occupied else "none"
                place = f'x="{svg.number(x)}" y="{svg.number(y)}" width="{wide}" height="{wide}"'
                yield f'<rect {place} fill="{fill}" data-side="{quadrant.side}"/>'

    def heights() -> Iterator[str]:
        for quadrant in level.quadrants:
            if quadrant.height is not None:
                x = 100 * _MARGIN + quadrant.x * unit + quadrant.side * unit // 2
                y = 100 * _MARGIN + (side - quadrant.y) * unit - quadrant.side * unit // 2 + 450
                yield svg.text(Pixel(x, y), str(quadrant.height))

    items = [
        *svg.group("empty", 'stroke="#777" stroke-width="0.8" stroke-dasharray="1.5 2.5"', squares(False)),
        *svg.group("there", 'stroke="#000" stroke-width="0.9"', squares(True)),
        *svg.group("heights", _FONT, heights()),
    ]
    return svg.page(WIDTH, WIDTH, f"Quadrants of level {level.number}", items)
