"""Functions that write HTML as strings: elements, addresses within the site, and SVG pictures inside pages.

A parameter called ``inner`` is HTML.  All other texts are plain and are escaped.  The dark theme inverts the pictures
of :mod:`modern.drawing`, which contain only shades of grey (docs/_static/edition.css).
"""

import re
from collections.abc import Iterable
from html import escape as escape
from urllib.parse import urlencode

from modern.study.report import joined

# The prefix of addresses within the site; :func:`relative` replaces it when the depth of the page is known.
HERE = "@/"
_OPERATOR = re.compile(r"(?<=[\w)])[-+*/=,](?=\S)")
_NO_END = frozenset({"input", "br", "img", "hr", "col"})


def element(name: str, inner: str = "", /, **attributes: str | bool) -> str:
    """Return an HTML element with attributes.

    ``cls`` is the attribute ``class``.  In other names, ``_`` stands for ``-``.  An attribute that is False or empty is
    omitted, except ``alt`` and ``value``.
    """
    start = f"<{name}{''.join(_attribute(key, value) for key, value in attributes.items())}>"
    return start if name in _NO_END else f"{start}{inner}</{name}>"


def _attribute(key: str, value: str | bool) -> str:
    name = "class" if key == "cls" else key.rstrip("_").replace("_", "-")
    if value is True:
        return f" {name}"
    return f' {name}="{escape(str(value))}"' if value or name in ("alt", "value") else ""


def text(name: str, content: str, /, **attributes: str | bool) -> str:
    """Return an element that contains plain text."""
    return element(name, escape(content), **attributes)


def preformatted(content: str, name: str) -> str:
    """Return lines of plain text in an element that the keyboard can scroll.

    ``name`` is the label of the element for screen readers.
    """
    return text("pre", content, tabindex="0", aria_label=name)


def details(summary: str, inner: str, **attributes: str | bool) -> str:
    """Return an element that shows its content when the reader opens its summary, which is plain text."""
    return element("details", text("summary", summary) + inner, **attributes)


def bar(shares: Iterable[tuple[str, int]]) -> str:
    """Return a bar divided in proportion to numbers. ``shares`` pairs the CSS class of each part with its number."""
    parts = (element("span", "", cls=cls, style=f"flex-grow:{share}") for cls, share in shares if share)
    return element("span", "".join(parts), cls="weight", aria_hidden="true")


def address(page: str, id: str = "") -> str:
    """Return the address of a page, or of the element ``id`` on it, for use in the HTML of any page."""
    return f"{HERE}{page}.html{'#' + id if id else ''}"


def link(page: str, id: str, content: str, **attributes: str | bool) -> str:
    """Return a link to a page, or to an element of it if ``id`` is not empty."""
    return text("a", content, href=address(page, id), **attributes)


def run_link(program: str, deck: str, content: str, **moment: str) -> str:
    """Return a link that opens the emulator's page and runs a program with a deck.

    ``moment`` has further parameters of the address, such as ``stop``, the card before which the run halts.
    """
    query = urlencode({"program": program, "deck": deck, **moment}, safe="/")
    return text("a", content, href=f"{HERE}console.html?{query}", cls="run-this")


def definitions(pairs: Iterable[tuple[str, str]], **attributes: str | bool) -> str:
    """Return a description list from pairs of plain text and HTML.  Pairs with empty HTML are omitted."""
    inner = "".join(f"<div><dt>{escape(name)}</dt><dd>{value}</dd></div>" for name, value in pairs if value)
    return element("dl", inner, **attributes) if inner else ""


def table(head: Iterable[str], rows: Iterable[Iterable[str]], name: str, caption: str = "") -> str:
    """Return a table from the plain text of its head and the HTML of its cells.

    The first cell of a row is the row's heading.  ``name`` is the label of the table for screen readers.
    """
    top = "".join(f'<th scope="col">{escape(heading)}</th>' for heading in head)
    body = []
    for row in rows:
        first, *rest = row
        body.append(f'<tr><th scope="row">{first}</th>{"".join(f"<td>{joined(cell)}</td>" for cell in rest)}</tr>')
    inner = text("caption", caption) if caption else ""
    inner += f"<thead><tr>{top}</tr></thead><tbody>{''.join(body)}</tbody>"
    return element("section", element("table", inner), cls="wide", tabindex="0", aria_label=name)


_TABLE = re.compile(r"<table\b([^>]*)>(.*?)</table>", re.DOTALL)
_ROW = re.compile(r"<tr\b.*?</tr>", re.DOTALL)
_CELL = re.compile(r"<(t[dh])\b([^>]*)>(.*?)</\1>", re.DOTALL)
_TAG = re.compile(r"<[^>]+>")
# A no-break space in the text of a cell, but not before a unit or in an attribute of a tag.
_NO_BREAK = re.compile("(?<![)])\N{NO-BREAK SPACE}(?!%)(?![^<>]*>)")
# The characters that separate words; a no-break space does not separate them.
_WORD = re.compile(r"[ \n]+")
# The number of letters that fit into one line of a window of 360 pixels, and the most lines of a cell in such a window.
_NARROW, _LINES = 40, 5


def stacked(html: str) -> str:
    """Prepare the tables of a page that are too wide for a phone, and return the HTML of the page.

    Such a table gets the class ``stacks``, and each cell gets the heading of its column as ``data-label``.  In a narrow
    window, the style sheet shows each row of the table as a list.  On paper, the style sheet allows line
    breaks after no-break spaces.
    """

    def labelled(match: re.Match[str]) -> str:
        rows = [[_TAG.sub("", cell[2]).strip() for cell in _CELL.findall(row)] for row in _ROW.findall(match[2])]
        # A column is at least as wide as its longest word, and cells are two letters apart.
        longest = [
            max((len(word) for cell in column for word in _WORD.split(cell)), default=0) + 2
            for column in zip(*rows, strict=False)
        ]
        is_high = any(len(cell) * len(row) > _LINES * _NARROW for row in rows for cell in row if len(row) > 2)
        if len(rows) < 2 or (sum(longest) <= _NARROW and not is_high):
            return match[0]
        head, labels = _ROW.search(match[2]), rows[0]
        assert head is not None, "a table has rows"
        body = _ROW.sub(lambda row: _with_labels(row[0], labels), match[2][head.end() :])
        attributes = match[1].replace('class="', 'class="stacks ') if "class=" in match[1] else ' class="stacks"'
        return f"<table{attributes}>{match[2][: head.end()]}{body}</table>"

    return _TABLE.sub(labelled, html)


def _gap(space: re.Match[str]) -> str:
    """Return a no-break space followed by a ``wbr`` element, at which the style sheet may allow a line break."""
    return f'{space[0]}<wbr class="{"gap" if space.string.startswith("(", space.end()) else "gap inner"}">'


def _with_labels(row: str, labels: list[str]) -> str:
    names = iter(labels)

    def cell(match: re.Match[str]) -> str:
        name, attributes, inner = match.groups()
        label, inner = next(names, ""), _NO_BREAK.sub(_gap, inner)
        attributes += f' data-label="{label}"' if label and inner not in ("", "<p></p>") else ""
        return f"<{name}{attributes}>{inner}</{name}>"

    return _CELL.sub(cell, row)


_INDEX = re.compile(r"\b([A-Z])_(NV\+1|NV|NE|\d+|[a-z](?:[+-]1)?)(?![\w^])")


def lowered(content: str) -> str:
    """Return plain text as HTML in which indices of points and hulls are subscripts: ``H_1``, ``P_NV``, ``H_j-1``."""
    return _INDEX.sub(r"\1<sub>\2</sub>", escape(content))


def marked(content: str, spans: Iterable[tuple[int, int]], name: str) -> str:
    """Return plain text with the given spans of characters wrapped in an element."""
    pieces, end = [], 0
    for first, last in spans:
        pieces += [escape(content[end:first]), text(name, content[first:last])]
        end = last
    return "".join([*pieces, escape(content[end:])])


def code(card: str, spans: Iterable[tuple[int, int]] = (), name: str = "mark") -> str:
    """Return a card as code in which lines may break after an operator or a comma, but not after the leading blanks."""
    pieces = re.split(r"(<[^>]*>|&[a-z0-9#]+;)", marked(card, spans, name))
    # The odd pieces are tags and character references, in which nothing may be inserted.
    broken = "".join(piece if n % 2 else _OPERATOR.sub(r"\g<0><wbr>", piece) for n, piece in enumerate(pieces))
    return element("code", re.sub(r"^( +)([^<&\s])", r'<span class="lead">\1\2</span>', broken))


def relative(html: str, depth: int) -> str:
    """Return HTML in which the addresses of the site are relative to a page ``depth`` folders below the top."""
    return html.replace(f'"{HERE}', f'"{"../" * depth}')


_GROUND = re.compile(r'<rect (?:x="[^"]*" )?width="[^"]*" height="[^"]*" fill="#fff"/>\n?')
_REFERENCE = re.compile(r'\b(id|href|xlink:href|aria-labelledby|aria-describedby)="(#?)([^"]*)"|url\(#([\w-]+)\)')
_SIZE = re.compile(r'(<svg [^>]*?)width="(\d+)" height="(\d+)"')


def inline(svg: str, key: str, cls: str = "drawing", percent: int = 100) -> str:
    """Return the text of an SVG file as an element of a page, with width and height scaled to ``percent``.

    ``key`` is appended to every id in the picture, so that two pictures of a page have no id in common.
    """
    svg = svg[svg.index("<svg") :]
    svg = re.sub(r"<style>.*?</style>\n?", "", svg, flags=re.DOTALL)
    svg = _GROUND.sub("", svg, count=1)
    known = set(re.findall(r'\bid="([^"]+)"', svg))

    def scaled(match: re.Match[str]) -> str:
        width, height = (int(match[k]) * percent // 100 for k in (2, 3))
        return f'{match[1]}width="{width}" height="{height}"'

    def unique(match: re.Match[str]) -> str:
        attribute, hash_sign, names, url = match.groups()
        if url:
            return f"url(#{url}-{key})" if url in known else match[0]
        if attribute == "id" or hash_sign:
            return f'{attribute}="{hash_sign}{names}-{key}"' if names in known else match[0]
        if attribute.startswith("aria"):
            return f'{attribute}="{" ".join(f"{name}-{key}" for name in names.split())}"'
        return match[0]

    return _REFERENCE.sub(unique, _SIZE.sub(scaled, svg, 1)).replace("<svg ", f'<svg class="{cls}" ', 1).strip()


def figure(svg: str, key: str, caption: str, cls: str = "drawing", description: str = "") -> str:
    """Return a picture with a caption in HTML, and with a description for screen readers if the picture has none."""
    if description and "<desc" not in svg:
        svg = svg.replace("<title>", '<title id="title">', 1)
        svg = svg.replace("</title>", f'</title>\n<desc id="desc">{escape(description)}</desc>', 1)
        svg = svg.replace("<svg ", '<svg aria-labelledby="title" aria-describedby="desc" ', 1)
    return element("figure", inline(svg, key, cls) + element("figcaption", caption), cls=f"of-{cls}")
