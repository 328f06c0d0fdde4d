"""Draw a hull and a wrong hull of the same points in one picture. Marks show the differences."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from math import atan2

from modern.comparison.difference import CardDifferences
from modern.drawing import svg
from modern.drawing.draw import Show, filter_scene, number_items, pixels_of_points, scene_items, width_of
from modern.drawing.layout import MARGIN, Pixel, lay_out
from modern.drawing.legend import band, band_height, caption
from modern.drawing.scene import scene
from modern.drawing.svg import Style, page
from modern.geometry.hull import Hull

MISSED = Style("missed", "missing vertex", "dot", 'fill="none" stroke="#c1121f" stroke-width="2.4"')
ADDED = Style("added", "false vertex", "dot", 'fill="#1d6fb8" stroke="#fff" stroke-width="1"')
NOT_FOUND = Style("not-found", "missing face", "line", 'fill="#c1121f" fill-opacity="0.22" stroke="#c1121f"')
NO_FACE = Style(
    "no-face", "false face", "line", 'fill="#1d6fb8" fill-opacity="0.25" stroke="#1d6fb8" stroke-dasharray="2 3"'
)
_PLURAL = {
    MISSED.key: "missing vertices",
    ADDED.key: "false vertices",
    NOT_FOUND.key: "missing faces",
    NO_FACE.key: "false faces",
}
_FONT = f'font-family="{svg.FONT}" font-size="13" fill="#000"'
_STEP, _RING, _HALF = 19, "5", 460


def draw_against(
    hull: Hull,
    claim: CardDifferences,
    eye: Sequence[Fraction | int] | None = None,
    title: str = "",
    width: int | None = None,
    show: Show | None = None,
) -> str:
    """Return the picture of a hull and of its differences from a hull read from cards, as the text of an SVG file.

    ``eye``, ``title``, ``width`` and ``show`` have the same meaning as in ``draw_svg``, but all points are drawn even
    if ``show`` omits them.
    """
    show = replace(show or Show(), points=True)
    picture = filter_scene(scene(hull, None if eye is None else [Fraction(number) for number in eye]), show)
    width = width_of(picture, width)
    layout = lay_out(picture, width)
    top = layout.height + band_height(picture, width, title)
    at = pixels_of_points(hull, picture, layout)
    items = [
        *scene_items(hull, picture, layout),
        *_faces(hull, claim, at),
        *_points(hull, claim, at),
        *(number_items(hull, picture, layout, show.labels) if show.labels != "none" else ()),
        *svg.group("legend", _FONT, band(picture, width, layout.height, title, True)),
        *svg.group("differences", _FONT, _legend(claim, top)),
    ]
    rows = max(1, len(_counts(claim)) + bool(claim.others))
    return page(width, top + _STEP * rows + 8, title or caption(picture), items)


def _faces(hull: Hull, claim: CardDifferences, at: Mapping[int, Pixel]) -> Iterator[str]:
    true = ([at[index] for index in hull.faces[k].polygon] for k in claim.not_found)
    yield from svg.group(NOT_FOUND.key, NOT_FOUND.attributes, (svg.polygon(corners) for corners in true))
    called = (_around([at[index] for index in polygon]) for polygon in claim.polygons)
    yield from svg.group(NO_FACE.key, NO_FACE.attributes, (svg.polygon(corners) for corners in called))


def _points(hull: Hull, claim: CardDifferences, at: Mapping[int, Pixel]) -> Iterator[str]:
    def title(index: int, style: Style) -> str:
        return f"{style.name}: point {index + 1} ({', '.join(hull.points[index])})"

    rings = (svg.circle(at[index], _RING, title(index, MISSED)) for index in claim.missed)
    yield from svg.group(MISSED.key, MISSED.attributes, rings)
    squares = (svg.square(at[index], _HALF, title(index, ADDED)) for index in claim.added)
    yield from svg.group(ADDED.key, ADDED.attributes, squares)


def _around(corners: Sequence[Pixel]) -> list[Pixel]:
    """Return the corners of a polygon in order around their centre. In this order no two sides cross."""
    count = len(corners)
    x, y = sum(corner.x for corner in corners), sum(corner.y for corner in corners)
    return sorted(corners, key=lambda corner: atan2(count * corner.y - y, count * corner.x - x))


def _legend(claim: CardDifferences, top: int) -> Iterator[str]:
    for k, (style, count) in enumerate(_counts(claim)):
        base = top + _STEP * k + 4
        at = Pixel((MARGIN + 9) * 100, base * 100 - 450)
        if style is ADDED:
            yield svg.square(at, _HALF, attributes=style.attributes)
        elif style.shape == "dot":
            yield svg.circle(at, _RING, attributes=style.attributes)
        else:
            corners = [Pixel(at.x + x * 900, at.y + y * 500) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            yield svg.polygon(corners, style.attributes)
        yield svg.text(
            Pixel((MARGIN + 26) * 100, base * 100), f"{count} {style.name if count == 1 else _PLURAL[style.key]}"
        )
    if not _counts(claim):
        yield svg.text(Pixel(MARGIN * 100, (top + 4) * 100), "no differences")
    elif claim.others:
        base = top + _STEP * len(_counts(claim)) + 4
        yield svg.text(Pixel(MARGIN * 100, base * 100), f"faces with unknown points, not drawn: {claim.others}")


def _counts(claim: CardDifferences) -> list[tuple[Style, int]]:
    counts = (
        (MISSED, len(claim.missed)),
        (ADDED, len(claim.added)),
        (NOT_FOUND, len(claim.not_found)),
        (NO_FACE, len(claim.polygons)),
    )
    return [(style, count) for style, count in counts if count]
