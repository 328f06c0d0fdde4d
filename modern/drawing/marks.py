"""The marks of a picture: told apart by shape and by grey, never by colour."""

from __future__ import annotations

from dataclasses import dataclass

from modern.drawing import svg
from modern.drawing.layout import Pixel

RADIUS = "3.2"
_ARM = 320
_LINE, _DOT, _CROSS = "line", "dot", "cross"


@dataclass(frozen=True, slots=True)
class Style:
    """A kind of mark: its class in the file, what the legend calls it, its shape and SVG attributes."""

    key: str
    name: str
    shape: str
    attributes: str


VISIBLE = Style("seen", "edge", _LINE, 'stroke="#000" stroke-width="1.5" stroke-linecap="round"')
HIDDEN = Style("hidden", "hidden edge", _LINE, 'stroke="#555" stroke-dasharray="5 4"')
VERTEX = Style("vertices", "vertex", _DOT, 'fill="#000"')
VERTEX_HIDDEN = Style("vertices-hidden", "hidden vertex", _DOT, 'fill="#888"')
BOUNDARY = Style("boundary", "boundary point", _DOT, 'fill="#fff" stroke="#000" stroke-width="1.3"')
BOUNDARY_HIDDEN = Style(
    "boundary-hidden", "hidden boundary point", _DOT, 'fill="#fff" stroke="#888" stroke-width="1.3"'
)
INSIDE = Style("inside", "inside point", _CROSS, 'fill="none" stroke="#333" stroke-width="1.2"')


def point_mark(style: Style, at: Pixel, title: str = "", more: str = "") -> str:
    """A dot or a cross."""
    if style.shape == _CROSS:
        return svg.saltire(at, _ARM, title, more)
    return svg.circle(at, RADIUS, title, more)


def sample(style: Style, at: Pixel) -> str:
    """The mark in a legend, with its own attributes."""
    if style.shape == _LINE:
        return svg.line(Pixel(at.x - 900, at.y), Pixel(at.x + 900, at.y), style.attributes)
    return point_mark(style, at, more=style.attributes)
