"""Draw how the hull grows, from the first polyhedron H_1 to the last (thesis p. 22-33), in rows or as an animation."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import repeat

from modern.drawing import svg
from modern.drawing.draw import scene_items
from modern.drawing.layout import Layout, Pixel, fit
from modern.drawing.scene import Scene, scene
from modern.drawing.svg import page
from modern.geometry.hull import Hull, Stage
from modern.geometry.mesh import ExportError
from modern.geometry.numbers import coordinates
from modern.port import convex_hull

_CELL, _BAND = 250, 46
_COLUMNS = 3
# An animation shows each stage for this number of seconds, and the last stage for a multiple of it.
_SECONDS, _LAST = 1.6, 3
_FONT = f'font-family="{svg.FONT}" font-size="12" fill="#000"'
ADDED = svg.Style("added", "added", "dot", 'fill="#000" stroke="#fff" stroke-width="1"')
WAITING = svg.Style("waiting", "not tested yet", "dot", 'fill="#fff" stroke="#777"')


@dataclass(frozen=True, slots=True)
class Frame:
    """The picture of one stage of the construction of a hull.

    The last four fields are positions of points in the picture.  ``waiting`` are the points not tested yet, ``struck``
    are the points that have been eliminated as inside so far, and ``added`` are the vertices that this stage added.  In
    the last stage, all points have been tested.  ``boundary`` then has the positions of the points on the boundary of
    the hull that are not vertices.
    """

    stage: Stage
    hull: Hull
    picture: Scene
    layout: Layout
    waiting: tuple[Pixel, ...]
    struck: tuple[Pixel, ...]
    added: tuple[Pixel, ...]
    boundary: tuple[Pixel, ...]

    @property
    def caption(self) -> tuple[str, str]:
        """The two lines below the picture; the second line is empty if the stage eliminated no points."""
        stage = self.stage
        numbers = ", ".join(str(index + 1) for index in stage.added)
        faces = "face" if stage.outside == 1 else "faces"
        added = f" added, outside {stage.outside} {faces}" if stage.number > 1 else ""
        gone = ", ".join(str(index + 1) for index in stage.struck)
        return f"H{stage.number}: point{'' if added else 's'} {numbers}{added}", f"inside: {gone}" if gone else ""


def frames(
    hull: Hull, eye: Sequence[Fraction | int] | None = None, width: int = _CELL, height: int = 10 * _CELL
) -> tuple[Frame, ...]:
    """Return a picture of each stage in the ``history`` of a hull, at most as large as the given size in pixels.

    Raise ExportError if there is no hull or if the hull has no stages.
    """
    if not hull.determined:
        raise ExportError(f"there is no hull: {hull.status}")
    if not hull.history:
        raise ExportError("there are no stages: the first approximation is already the hull")
    whole = scene(hull, None if eye is None else [Fraction(number) for number in eye])
    sight = whole.view
    flat = {index: sight.project(coordinates(point)) for index, point in enumerate(hull.points)}
    pixel, height = fit(list(flat.values()), width, height)
    places = {index: pixel(image) for index, image in flat.items()}
    stage_frames, vertices, eliminated = [], set[int](), set[int]()
    # The hull of a stage is computed exactly from the vertices added so far.
    for stage in hull.history:
        vertices |= set(stage.added)
        eliminated |= set(stage.struck)
        order = sorted(vertices)
        stage_hull = convex_hull([hull.points[index] for index in order], "exact", on_refusal="return")
        picture = replace(scene(stage_hull, [Fraction(number) for number in sight.eye]), boundary=(), inside=())
        at = tuple(places[order[index]] for index in stage_hull.vertices)
        layout = Layout(width, height, at, (), (), tuple((k,) for k in range(len(at))))
        untested = [index for index in flat if index not in vertices and index not in eliminated]
        boundary = set(hull.boundary) if stage is hull.history[-1] else set[int]()
        stage_frames.append(
            Frame(
                stage,
                stage_hull,
                picture,
                layout,
                tuple(places[index] for index in untested if index not in boundary),
                tuple(places[index] for index in sorted(eliminated)),
                tuple(places[index] for index in stage.added),
                tuple(places[index] for index in untested if index in boundary),
            )
        )
    return tuple(stage_frames)


def row(all_frames: Sequence[Frame], title: str) -> str:
    """Return the text of an SVG file that shows the pictures of all stages next to each other, without captions."""
    width, height = all_frames[0].layout.width, all_frames[0].layout.height
    items = []
    for k, frame in enumerate(all_frames):
        items += [f'<g transform="translate({k * width} 0)">', *_drawn(frame), "</g>"]
    return page(len(all_frames) * width, height, title, items)


def strip(all_frames: Sequence[Frame], title: str = "", columns: int = _COLUMNS) -> str:
    """Return the text of an SVG file that shows the pictures of all stages in rows of ``columns`` pictures."""
    cell = (all_frames[0].layout.width, all_frames[0].layout.height + _BAND)
    columns = min(columns, len(all_frames))
    rows = -(-len(all_frames) // columns)
    items = []
    for k, frame in enumerate(all_frames):
        x, y = k % columns * cell[0], k // columns * cell[1]
        items += [f'<g transform="translate({x} {y})">', *_items(frame), "</g>"]
    bottom, legend = _legend(rows * cell[1], columns * cell[0], all_frames)
    return page(columns * cell[0], bottom, title or "H1 to Hf", [*items, *legend])


def played(all_frames: Sequence[Frame], title: str = "") -> str:
    """Return the text of an SVG file that shows the stages in turn, endlessly.

    If the viewer's system asks for reduced motion, only the last stage is shown.
    """
    width, height = all_frames[0].layout.width, all_frames[0].layout.height + _BAND
    steps = len(all_frames) + _LAST - 1
    # The last stage is shown longer. Percentages of the whole cycle, as CSS keyframes require.
    share, last = (f"{100 * many / steps:.4f}".rstrip("0").rstrip(".") for many in (1, _LAST))
    style = (
        "<style>"
        f"@keyframes one{{0%{{visibility:visible}}{share}%,to{{visibility:hidden}}}}"
        f"@keyframes last{{0%{{visibility:visible}}{last}%,to{{visibility:hidden}}}}"
        f".stage{{visibility:hidden;animation:one {steps * _SECONDS:g}s step-end infinite}}"
        ".stage.end{animation-name:last}"
        "@media(prefers-reduced-motion:reduce){.stage{animation:none}.stage.end{visibility:visible}}"
        "</style>"
    )
    items = [style]
    for k, frame in enumerate(all_frames):
        kind = "stage end" if k == len(all_frames) - 1 else "stage"
        items += [f'<g class="{kind}" style="animation-delay:{k * _SECONDS:g}s">', *_items(frame), "</g>"]
    bottom, legend = _legend(height, width, all_frames)
    return page(width, bottom, title or "H1 to Hf", [*items, *legend])


def _items(frame: Frame) -> Iterator[str]:
    yield from _drawn(frame)
    base = frame.layout.height + 12
    texts = (svg.text(Pixel(1200, 100 * (base + 16 * k)), line) for k, line in enumerate(frame.caption) if line)
    yield from svg.group("words", _FONT, texts)
    yield from svg.group("numbers", _FONT, map(_number, frame.stage.added, frame.added, repeat(frame.layout)))


def _number(index: int, at: Pixel, layout: Layout) -> str:
    """Return the number of a point as an SVG text next to its dot, towards the nearest corner of the picture."""
    is_left, is_upper = at.x < 50 * layout.width, at.y < 50 * layout.height
    place = Pixel(at.x + (-700 if is_left else 700), at.y + (-500 if is_upper else 1400))
    return svg.text(place, str(index + 1), 'text-anchor="end"' if is_left else "")


def _drawn(frame: Frame) -> Iterator[str]:
    yield from scene_items(frame.hull, frame.picture, frame.layout)
    yield from svg.group(WAITING.key, WAITING.attributes, (svg.point_mark(WAITING, at) for at in frame.waiting))
    yield from svg.group(svg.INSIDE.key, svg.INSIDE.attributes, (svg.point_mark(svg.INSIDE, at) for at in frame.struck))
    yield from svg.group(ADDED.key, ADDED.attributes, (svg.circle(at, "5") for at in frame.added))
    boundary = (svg.point_mark(svg.BOUNDARY, at) for at in frame.boundary)
    yield from svg.group(svg.BOUNDARY.key, svg.BOUNDARY.attributes, boundary)


def _legend(top: int, width: int, all_frames: Sequence[Frame]) -> tuple[int, list[str]]:
    """Return the bottom of the legend and its elements. Signs that do not fit into a row begin the next row."""
    styles = [(ADDED, "added"), (svg.INSIDE, "inside, eliminated"), (WAITING, WAITING.name)]
    if all_frames[-1].boundary:
        styles.append((svg.BOUNDARY, "on the boundary"))
    items, x, y = [], 12, top
    for style, name in styles:
        needed = 28 + 33 * len(name) // 5
        if x > 12 and x + needed > width:
            x, y = 12, y + 18
        items += [svg.sample(style, Pixel(100 * (x + 6), 100 * (y + 8)))]
        items += [svg.text(Pixel(100 * (x + 18), 100 * (y + 12)), name)]
        x += needed
    return y + 24, svg.group("legend", _FONT, items)
