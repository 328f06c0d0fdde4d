"""SVG as text: numbers without superfluous zeros, text escaped, nothing but ASCII.

The marks of a picture are told apart by shape and by grey, never by colour.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal
from xml.sax.saxutils import escape as _escape

from modern.drawing.layout import Pixel

_LEGAL = re.compile("[\t\n\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
FONT = "Helvetica, Arial, sans-serif"


def number(hundredths: int) -> str:
    """Hundredths of a pixel as text: 1250 is ``12.5``."""
    whole, rest = divmod(abs(hundredths), 100)
    text = f"{whole}.{rest:02d}".rstrip("0").rstrip(".")
    return f"-{text}" if hundredths < 0 and text != "0" else text


def escape(text: str) -> str:
    """Text between tags: markup escaped, characters beyond ASCII as references, those XML forbids as question marks."""
    allowed = "".join(c if _LEGAL.fullmatch(c) else "?" for c in text)
    return _escape(allowed).encode("ascii", "xmlcharrefreplace").decode("ascii")


def line(a: Pixel, b: Pixel, more: str = "") -> str:
    """A straight line."""
    return f'<line x1="{number(a.x)}" y1="{number(a.y)}" x2="{number(b.x)}" y2="{number(b.y)}"{_lead(more)}/>'


def polygon(corners: Iterable[Pixel], more: str = "") -> str:
    """A closed polygon."""
    return f'<polygon points="{" ".join(f"{number(c.x)},{number(c.y)}" for c in corners)}"{_lead(more)}/>'


def circle(centre: Pixel, radius: str, title: str = "", more: str = "") -> str:
    """A circle, with a title where the reader points at it."""
    start = f'<circle cx="{number(centre.x)}" cy="{number(centre.y)}" r="{radius}"{_lead(more)}'
    return f"{start}>{_title(title)}</circle>" if title else f"{start}/>"


def square(centre: Pixel, half: int, title: str = "", more: str = "") -> str:
    """A square, its sides ``half`` hundredths away, with a title where the reader points at it."""
    x, y, size = number(centre.x - half), number(centre.y - half), number(2 * half)
    start = f'<rect x="{x}" y="{y}" width="{size}" height="{size}"{_lead(more)}'
    return f"{start}>{_title(title)}</rect>" if title else f"{start}/>"


def saltire(centre: Pixel, arm: int, title: str = "", more: str = "") -> str:
    """A cross of two slanting lines, each end ``arm`` hundredths away along both axes."""
    ends = [(centre.x + dx * arm, centre.y + dy * arm) for dx, dy in ((-1, -1), (1, 1), (-1, 1), (1, -1))]
    a, b, c, d = (f"{number(x)} {number(y)}" for x, y in ends)
    start = f'<path d="M{a}L{b}M{c}L{d}"{_lead(more)}'
    return f"{start}>{_title(title)}</path>" if title else f"{start}/>"


def text(place: Pixel, words: str, more: str = "") -> str:
    """A line of text; ``place`` is on its base line."""
    return f'<text x="{number(place.x)}" y="{number(place.y)}"{_lead(more)}>{escape(words)}</text>'


def group(name: str, attributes: str, items: Iterable[str]) -> list[str]:
    """Items that share attributes; nothing where there are none."""
    found = list(items)
    return [f'<g class="{name}"{_lead(attributes)}>', *found, "</g>"] if found else []


def page(width: int, height: int, title: str, items: Iterable[str], description: str = "") -> str:
    """A whole file on white ground: a picture, or with a description a document, whose text is read out too."""
    role = "graphics-document document" if description else "img"
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
        f'viewBox="0 0 {width} {height}" role="{role}">'
    )
    titles = [_title(title), *([f"<desc>{escape(description)}</desc>"] if description else [])]
    ground = f'<rect width="{width}" height="{height}" fill="#fff"/>'
    return "\n".join((head, *titles, ground, *items, "</svg>")) + "\n"


def _title(words: str) -> str:
    return f"<title>{escape(words)}</title>"


def _lead(more: str) -> str:
    return f" {more}" if more else ""


RADIUS, SMALL = "3.2", "2"
_ARM, _SMALL_ARM = 320, 200


@dataclass(frozen=True, slots=True)
class Style:
    """A kind of mark: its class in the file, what the legend calls it, its shape and SVG attributes."""

    key: str
    name: str
    shape: Literal["line", "dot", "cross"]
    attributes: str


VISIBLE = Style("seen", "edge", "line", 'stroke="#000" stroke-width="1.5" stroke-linecap="round"')
HIDDEN = Style("hidden", "hidden edge", "line", 'stroke="#555" stroke-dasharray="5 4"')
VERTEX = Style("vertices", "vertex", "dot", 'fill="#000"')
VERTEX_HIDDEN = Style("vertices-hidden", "hidden vertex", "dot", 'fill="#888"')
BOUNDARY = Style("boundary", "boundary point", "dot", 'fill="#fff" stroke="#000" stroke-width="1.3"')
BOUNDARY_HIDDEN = Style(
    "boundary-hidden", "hidden boundary point", "dot", 'fill="#fff" stroke="#888" stroke-width="1.3"'
)
INSIDE = Style("inside", "inside point", "cross", 'fill="none" stroke="#333" stroke-width="1.2"')


def point_mark(style: Style, at: Pixel, title: str = "", more: str = "", small: bool = False) -> str:
    """A dot or a cross; small where there are many."""
    if style.shape == "cross":
        return saltire(at, _SMALL_ARM if small else _ARM, title, more)
    return circle(at, SMALL if small else RADIUS, title, more)


def sample(style: Style, at: Pixel) -> str:
    """The mark in a legend, with its own attributes."""
    if style.shape == "line":
        return line(Pixel(at.x - 900, at.y), Pixel(at.x + 900, at.y), style.attributes)
    return point_mark(style, at, more=style.attributes)
