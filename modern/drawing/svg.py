"""Write SVG elements and files as ASCII text, and convert SVG to PDF and PNG.

The marks defined here differ in shape and in their grey, never in colour.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Literal
from xml.sax.saxutils import escape as _escape

from emulator.files import write_text, writing_bytes
from modern.drawing.layout import Pixel
from modern.geometry.mesh import ExportError

_LEGAL = re.compile("[\t\n\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
FONT = "Helvetica, Arial, sans-serif"
# The file name extensions for a picture.
PICTURES = (".svg", ".pdf", ".png")
_PAGE = b'#set page(width: auto, height: auto, margin: 0pt)\n#image(bytes(sys.inputs.svg), format: "svg")'
_PIXELS_PER_INCH = 192  # A PNG has two pixels for each pixel of the SVG.


def number(hundredths: int) -> str:
    """Return a length in hundredths of a pixel as text in pixels: for 1250 the text ``12.5``."""
    whole, rest = divmod(abs(hundredths), 100)
    text = f"{whole}.{rest:02d}".rstrip("0").rstrip(".")
    return f"-{text}" if hundredths < 0 and text != "0" else text


def escape(text: str) -> str:
    """Escape markup and characters beyond ASCII, and replace characters that XML forbids by question marks."""
    allowed = "".join(c if _LEGAL.fullmatch(c) else "?" for c in text)
    return _escape(allowed).encode("ascii", "xmlcharrefreplace").decode("ascii")


def line(a: Pixel, b: Pixel, attributes: str = "") -> str:
    return (
        f'<line x1="{number(a.x)}" y1="{number(a.y)}" x2="{number(b.x)}" y2="{number(b.y)}"{_after_space(attributes)}/>'
    )


def polygon(corners: Iterable[Pixel], attributes: str = "") -> str:
    return f'<polygon points="{" ".join(f"{number(c.x)},{number(c.y)}" for c in corners)}"{_after_space(attributes)}/>'


def circle(centre: Pixel, radius: str, title: str = "", attributes: str = "") -> str:
    """Return a circle as an SVG element, with an optional title, which a browser shows as a tooltip."""
    start = f'<circle cx="{number(centre.x)}" cy="{number(centre.y)}" r="{radius}"{_after_space(attributes)}'
    return f"{start}>{_title(title)}</circle>" if title else f"{start}/>"


def square(centre: Pixel, half: int, title: str = "", attributes: str = "") -> str:
    """Return a square as an SVG element; ``half`` is half its side in hundredths of a pixel."""
    x, y, size = number(centre.x - half), number(centre.y - half), number(2 * half)
    start = f'<rect x="{x}" y="{y}" width="{size}" height="{size}"{_after_space(attributes)}'
    return f"{start}>{_title(title)}</rect>" if title else f"{start}/>"


def saltire(centre: Pixel, arm: int, title: str = "", attributes: str = "") -> str:
    """Return a diagonal cross as an SVG element; ``arm`` is half its width in hundredths of a pixel."""
    ends = [(centre.x + dx * arm, centre.y + dy * arm) for dx, dy in ((-1, -1), (1, 1), (-1, 1), (1, -1))]
    a, b, c, d = (f"{number(x)} {number(y)}" for x, y in ends)
    start = f'<path d="M{a}L{b}M{c}L{d}"{_after_space(attributes)}'
    return f"{start}>{_title(title)}</path>" if title else f"{start}/>"


def text(place: Pixel, content: str, attributes: str = "") -> str:
    """Return a line of text as an SVG element; ``place`` is a point on its base line."""
    return f'<text x="{number(place.x)}" y="{number(place.y)}"{_after_space(attributes)}>{escape(content)}</text>'


def group(name: str, attributes: str, items: Iterable[str]) -> list[str]:
    elements = list(items)
    return [f'<g class="{name}"{_after_space(attributes)}>', *elements, "</g>"] if elements else []


def page(width: int, height: int, title: str, items: Iterable[str], description: str = "") -> str:
    """Return a complete SVG file with a white background.

    With a ``description``, the file is marked as a document. Screen readers then read the texts in the picture.
    """
    role = "graphics-document document" if description else "img"
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
        f'viewBox="0 0 {width} {height}" role="{role}">'
    )
    titles = [_title(title), *([f"<desc>{escape(description)}</desc>"] if description else [])]
    ground = f'<rect width="{width}" height="{height}" fill="#fff"/>'
    return "\n".join((head, *titles, ground, *items, "</svg>")) + "\n"


def _title(content: str) -> str:
    return f"<title>{escape(content)}</title>"


def _after_space(attributes: str) -> str:
    return f" {attributes}" if attributes else ""


RADIUS, SMALL = "3.2", "2"
_ARM, _SMALL_ARM = 320, 200


@dataclass(frozen=True, slots=True)
class Style:
    """A kind of mark in pictures: its CSS class, its name in the legend, its shape and its SVG attributes."""

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


def point_mark(style: Style, at: Pixel, title: str = "", attributes: str = "", small: bool = False) -> str:
    if style.shape == "cross":
        return saltire(at, _SMALL_ARM if small else _ARM, title, attributes)
    return circle(at, SMALL if small else RADIUS, title, attributes)


def sample(style: Style, at: Pixel) -> str:
    """Return a sample of a style for the legend: a short line or a mark."""
    if style.shape == "line":
        return line(Pixel(at.x - 900, at.y), Pixel(at.x + 900, at.y), style.attributes)
    return point_mark(style, at, attributes=style.attributes)


def check_picture(path: str) -> None:
    """Raise ExportError if writing this picture needs the package typst, which is not installed."""
    if path.lower().endswith(PICTURES[1:]) and find_spec("typst") is None:
        raise ExportError(f"{path}: PDF and PNG need typst: pip install 'hull1620[plot]'")


def write_picture(path: str, svg: str) -> None:
    """Write a picture as PDF or PNG if the file name ends with .pdf or .png, otherwise as SVG.

    Raise FileError if the file cannot be written, and ExportError if typst is needed but not installed.
    """
    if not path.lower().endswith(PICTURES[1:]):
        write_text(path, svg)
        return
    check_picture(path)
    import typst  # imported here because only PDF and PNG need it

    # System fonts are ignored, so that the same picture gives the same bytes everywhere.
    data = typst.compile(
        _PAGE,
        format="pdf" if path.lower().endswith(".pdf") else "png",
        ppi=_PIXELS_PER_INCH,
        sys_inputs={"svg": svg},
        ignore_system_fonts=True,
        timestamp=0,
    )
    with writing_bytes(path) as file:
        file.write(data)
