"""Draw a flow chart as SVG in the symbols of the thesis (p. 60).

The thesis has symbols for the direction of flow, a decision, input and output, processing, and a connector or step. The
picture contains its text as characters, not as outlines, and no meaning depends on colour.
"""

from collections.abc import Callable, Iterator, Sequence

from modern.drawing.svg import escape
from modern.publication.chart import (
    BOX,
    LEFT,
    LETTER,
    MARGIN,
    RADIUS,
    RIGHT,
    ROW,
    SPINE,
    ZONE,
    Chart,
    Page,
    Path,
    Placed,
)
from modern.publication.flow import Box

# A function that returns the address to which a box links, or an empty string for no link.
Link = Callable[[Box], str]

_STYLE = (
    "text{font:9px ui-monospace,Menlo,Consolas,'DejaVu Sans Mono',monospace;fill:#000}"
    ".n{font-weight:bold}.c{text-anchor:middle}.e{text-anchor:end}"
    ".b{fill:#fff;stroke:#000}.w{fill:none;stroke:#000}.r{fill:none;stroke:#000}.d{fill:#000;stroke:none}"
)
_SLANT = 8  # the horizontal offset of the slanted sides of the symbol for input and output


def chart_svg(chart: Chart, page: int | None = None, link: Link | None = None) -> str:
    """Draw one page of a chart, counted from 1, or all pages below each other.

    ``link`` returns the address to which a box links. Raise IndexError for a page that does not exist.
    """
    if page is not None and not 1 <= page <= len(chart.pages):
        raise IndexError(page)
    pages = chart.pages if page is None else chart.pages[page - 1 : page]
    height = sum(sheet.height for sheet in pages)
    start, end = _extent(chart)
    width = end - start
    title = f"Flow chart of {chart.flow.source}" + ("" if page is None else f", page {page} of {len(chart.pages)}")
    # A screen reader does not look for links inside an image.
    role = "img" if link is None else "group"
    boxes = sum(len(sheet.boxes) for sheet in pages)
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
        f'viewBox="{start} 0 {width} {height}" role="{role}" aria-labelledby="title desc">',
        f'<title id="title">{escape(title)}</title>',
        f'<desc id="desc">{boxes} boxes in the order of the cards, from the compiled program. The exits of an IF '
        "are left for minus, below for zero and right for plus. A number in a circle is the target of a jump.</desc>",
        f"<style>{_STYLE}</style>",
        f'<rect x="{start}" width="{width}" height="{height}" fill="#fff"/>',
    ]
    top = 0
    for number, sheet in enumerate(pages, page or 1):
        lines.append(f'<g class="page" transform="translate(0 {top})">')
        lines += _page(chart, sheet, link)
        if len(chart.pages) > 1:
            lines.append(f'<text class="e" x="{end - MARGIN}" y="{sheet.height - 4}">{number}</text>')
        lines.append("</g>")
        top += sheet.height
    return "\n".join([*lines, "</svg>"]) + "\n"


def _extent(chart: Chart) -> tuple[int, int]:
    """Return the left and the right edge of all pages, which are as wide as the page with the most lanes needs."""
    edges = [x for page in chart.pages for path in page.paths for x, _ in path.corners] + [LEFT - ZONE, RIGHT + ZONE]
    return min(edges) - MARGIN, max(edges) + MARGIN


def _short(box: Box) -> str:
    """Return the text in a connector to a box: the number of its statement, or ``c`` and the number of its card."""
    return box.label or f"c{box.cards[0]}"


def _page(chart: Chart, page: Page, link: Link | None) -> Iterator[str]:
    boxes = chart.flow.boxes
    for path in page.paths:
        way = boxes[path.box].exits[path.way]
        where = f"{boxes[path.box].name} to {boxes[way.target].name}"
        yield f'<path class="w" d="{_line(path.corners)}"><title>{escape(where)}</title></path>'
    for landing in page.landings:
        yield f'<path class="w" d="{_line(landing.corners)}"/>'
    arrived = {boxes[p.box].exits[p.way].target for p in page.paths if p.connector is None}
    arrived |= {landing.box for landing in page.landings}
    for placed in page.boxes:
        box = boxes[placed.box]
        if placed.box in arrived:
            yield f'<path class="d" d="M{SPINE} {placed.top}l-3 -6h6z"/>'
        address = link(box) if link else ""
        if address:
            yield f'<a href="{escape(address)}">'
        yield from _symbol(box, placed)
        if address:
            yield "</a>"
    for path in page.paths:
        way = boxes[path.box].exits[path.way]
        yield from _taken(boxes[path.box], path, page.boxes[path.box - page.boxes[0].box].middle)
        if path.connector:
            to = boxes[way.target]
            yield from _connector(path.connector, _short(to), f"to {to.name}, page {_page_of(chart, way.target)}")
    for landing in page.landings:
        box = boxes[landing.box]
        yield from _connector(landing.centre, _short(box), f"from other exits to {box.name}")


def _page_of(chart: Chart, box: int) -> int:
    return next(n for n, page in enumerate(chart.pages, 1) if page.boxes[0].box <= box <= page.boxes[-1].box)


def _line(corners: Sequence[tuple[int, int]]) -> str:
    return "M" + "L".join(f"{x} {y}" for x, y in corners)


def _symbol(box: Box, placed: Placed) -> Iterator[str]:
    top, bottom, middle = placed.top, placed.bottom, placed.middle
    if box.kind == "step":
        yield from _connector((SPINE, middle), box.label, f"step {box.name}")
        return
    if box.kind == "decision":
        yield _outline((SPINE, top), (RIGHT, middle), (SPINE, bottom), (LEFT, middle))
    elif box.kind == "input/output":
        yield _outline((LEFT + _SLANT, top), (RIGHT, top), (RIGHT - _SLANT, bottom), (LEFT, bottom))
    else:
        corner = f' rx="{placed.height // 2}"' if box.kind == "end" else ""
        yield f'<rect class="b" x="{LEFT}" y="{top}" width="{BOX}" height="{placed.height}"{corner}/>'
    if box.label:
        yield f'<text class="n" x="{LEFT}" y="{top - 2}">{box.label}</text>'
    middled = box.kind in ("decision", "end")
    first = middle - ROW * len(placed.lines) // 2 + 9
    for k, line in enumerate(placed.lines):
        at = f'class="c" x="{SPINE}"' if middled else f'x="{LEFT + _SLANT + 6}"'
        yield f'<text {at} y="{first + ROW * k}" xml:space="preserve">{escape(line)}</text>'


def _outline(*corners: tuple[int, int]) -> str:
    return f'<polygon class="b" points="{" ".join(f"{x},{y}" for x, y in corners)}"/>'


def _taken(box: Box, path: Path, middle: int) -> Iterator[str]:
    """Yield the condition of an exit as a text next to the start of its line."""
    way = box.exits[path.way]
    if not way.taken:
        return
    condition = {"-": "\u2212"}.get(way.taken, way.taken)
    x, y = path.corners[0]
    if way.side == "down":
        place = f'x="{x + 4}" y="{y + 9}"'
    elif way.side == "left":
        place = f'x="{x + 2}" y="{y - 7}"'
    elif x == RIGHT:
        place = f'class="e" x="{x - 2}" y="{y - 7}"'
    else:
        # On the slanted edge, the text is above the line in the upper half and below it in the lower half.
        place = f'x="{x + 4}" y="{y - 3 if y <= middle else y + 9}"'
    yield f"<text {place}>{escape(condition)}</text>"


def _connector(centre: tuple[int, int], label: str, title: str) -> Iterator[str]:
    x, y = centre
    # A circle, wider if the label is long.
    wide = max(RADIUS, round(LETTER * len(label) / 2) + 4)
    yield f'<ellipse class="b" cx="{x}" cy="{y}" rx="{wide}" ry="{RADIUS}"><title>{escape(title)}</title></ellipse>'
    yield f'<text class="c" x="{x}" y="{y + 3}">{escape(label)}</text>'
