"""The construction H_1 to H_f (thesis p. 22-33) in pictures: a strip, or one picture that plays them.

Every picture has the same direction of view and the same scale.  It shows the hull of the vertices found so far, the
vertex that was added, the points eliminated because they are inside, and those still to be looked at.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from modern.drawing import svg
from modern.drawing.draw import marked
from modern.drawing.layout import Layout, Pixel, fit
from modern.drawing.scene import Scene, scene
from modern.drawing.svg import page
from modern.geometry.hull import Hull, Stage
from modern.geometry.mesh import ExportError
from modern.geometry.numbers import coordinates
from modern.port import convex_hull

_CELL, _BAND = 250, 46
_COLUMNS = 3
_SECONDS, _LAST = 1.6, 3
"""How long a stage stands, and for how many stages the last."""
_FONT = f'font-family="{svg.FONT}" font-size="12" fill="#000"'
ADDED = svg.Style("added", "added", "dot", 'fill="#000" stroke="#fff" stroke-width="1"')
WAITING = svg.Style("waiting", "not looked at yet", "dot", 'fill="#fff" stroke="#777"')


@dataclass(frozen=True, slots=True)
class Frame:
    """One stage: its picture, where everything lies, and what is said of it."""

    stage: Stage
    hull: Hull
    picture: Scene
    layout: Layout
    waiting: tuple[Pixel, ...]
    struck: tuple[Pixel, ...]
    added: tuple[Pixel, ...]

    @property
    def words(self) -> tuple[str, str]:
        """Two lines below the picture."""
        stage = self.stage
        who = ", ".join(str(index + 1) for index in stage.added)
        faces = "face" if stage.outside == 1 else "faces"
        added = f" added, outside {stage.outside} {faces}" if stage.number > 1 else ""
        gone = ", ".join(str(index + 1) for index in stage.struck)
        return f"H{stage.number}: point{'' if added else 's'} {who}{added}", f"inside: {gone}" if gone else ""


def frames(hull: Hull, eye: Sequence[Fraction | int] | None = None, width: int = _CELL) -> tuple[Frame, ...]:
    """The stages of a hull that was determined with its history.

    Raises ExportError where it has none: of a point, a segment or three points there is nothing to construct.
    """
    if not hull.determined:
        raise ExportError(f"there is no hull: {hull.status}")
    if not hull.history:
        raise ExportError("there are no stages: the first approximation is the hull")
    whole = scene(hull, None if eye is None else [Fraction(number) for number in eye])
    sight = whole.view
    flat = {index: sight.project(coordinates(point)) for index, point in enumerate(hull.points)}
    pixel, height = fit(list(flat.values()), width, 10 * width)
    places = {index: pixel(image) for index, image in flat.items()}
    found, vertices, gone = [], set[int](), set[int]()
    for stage in hull.history:
        vertices |= set(stage.added)
        gone |= set(stage.struck)
        order = sorted(vertices)
        part = convex_hull([hull.points[index] for index in order], "exact", on_refusal="return")
        picture = replace(scene(part, [Fraction(number) for number in sight.eye]), boundary=(), inside=())
        at = tuple(places[order[index]] for index in part.vertices)
        layout = Layout(width, height, at, (), (), tuple((k,) for k in range(len(at))))
        rest = [index for index in flat if index not in vertices and index not in gone]
        found.append(
            Frame(
                stage,
                part,
                picture,
                layout,
                tuple(places[index] for index in rest),
                tuple(places[index] for index in stage.struck),
                tuple(places[index] for index in stage.added),
            )
        )
    return tuple(found)


def strip(found: Sequence[Frame], title: str = "") -> str:
    """All stages side by side, three in a row, as the text of an SVG file."""
    cell = (found[0].layout.width, found[0].layout.height + _BAND)
    columns = min(_COLUMNS, len(found))
    rows = -(-len(found) // columns)
    items = []
    for k, frame in enumerate(found):
        x, y = k % columns * cell[0], k // columns * cell[1]
        items += [f'<g transform="translate({x} {y})">', *_items(frame), "</g>"]
    top = rows * cell[1]
    return page(columns * cell[0], top + 24, title or "H1 to Hf", [*items, *_legend(found, top, title)])


def played(found: Sequence[Frame], title: str = "") -> str:
    """The stages one after another in one place, again and again, as the text of an SVG file.

    Where the reader's system asks for no movement, the last stage stands.
    """
    width, height = found[0].layout.width, found[0].layout.height + _BAND
    steps = len(found) + _LAST - 1
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
    for k, frame in enumerate(found):
        kind = "stage end" if k == len(found) - 1 else "stage"
        items += [f'<g class="{kind}" style="animation-delay:{k * _SECONDS:g}s">', *_items(frame), "</g>"]
    return page(width, height + 24, title or "H1 to Hf", [*items, *_legend(found, height, title)])


def _items(frame: Frame) -> Iterator[str]:
    yield from marked(frame.hull, frame.picture, frame.layout)
    yield from svg.group(WAITING.key, WAITING.attributes, (svg.point_mark(WAITING, at) for at in frame.waiting))
    yield from svg.group(svg.INSIDE.key, svg.INSIDE.attributes, (svg.point_mark(svg.INSIDE, at) for at in frame.struck))
    yield from svg.group(ADDED.key, ADDED.attributes, (svg.circle(at, "5") for at in frame.added))
    base = frame.layout.height + 12
    texts = (svg.text(Pixel(1200, 100 * (base + 16 * k)), words) for k, words in enumerate(frame.words) if words)
    yield from svg.group("words", _FONT, texts)


def _legend(found: Sequence[Frame], top: int, title: str) -> list[str]:
    def items() -> Iterator[str]:
        x = 12
        for style, name in ((ADDED, "added"), (svg.INSIDE, "inside, eliminated"), (WAITING, WAITING.name)):
            yield svg.sample(style, Pixel(100 * (x + 6), 100 * (top + 8)))
            yield svg.text(Pixel(100 * (x + 18), 100 * (top + 12)), name)
            x += 34 + 7 * len(name)

    return svg.group("legend", _FONT, items())
