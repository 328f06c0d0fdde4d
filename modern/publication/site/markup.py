"""HTML as text: elements with escaped words and attributes, addresses within the site.

Nothing here knows a page.  An element is a string; what goes in as ``words`` is escaped, what goes in as ``inner`` is
HTML already.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from html import escape as _escape

HERE = "@/"
"""How an address within the site begins until it is known on what page, and so how deep, it stands."""
_OPERATOR = re.compile(r"(?<=[\w)])[-+*/=,](?=\S)")
_NO_END = frozenset({"input", "br", "img", "hr", "col"})


def escape(words: str) -> str:
    """Words between tags or in an attribute."""
    return _escape(words, quote=True)


def element(name: str, inner: str = "", /, **attributes: str | bool) -> str:
    """An element; an attribute is named as in HTML, with ``_`` for ``-`` and ``cls`` for ``class``.

    An attribute that is False or empty is left out, but ``alt`` and ``value``.
    """
    words = "".join(_attribute(key, value) for key, value in attributes.items())
    return f"<{name}{words}>" if name in _NO_END else f"<{name}{words}>{inner}</{name}>"


def _attribute(key: str, value: str | bool) -> str:
    name = "class" if key == "cls" else key.rstrip("_").replace("_", "-")
    if value is True:
        return f" {name}"
    if not value and name not in ("alt", "value"):
        return ""
    return f' {name}="{escape(str(value))}"'


def text(name: str, words: str, /, **attributes: str | bool) -> str:
    """An element that holds words."""
    return element(name, escape(words), **attributes)


def address(page: str, id: str = "") -> str:
    """The address of a page, or of an element of it, as it is written in HTML that is put into a page."""
    return f"{HERE}{page}.html{'#' + id if id else ''}"


def link(page: str, id: str, words: str, **attributes: str | bool) -> str:
    """A link to an element of a page."""
    return element("a", escape(words), href=address(page, id), **attributes)


def definitions(pairs: Iterable[tuple[str, str]], **attributes: str | bool) -> str:
    """A list of names and what they stand for: pairs of words and HTML; a pair without HTML is left out."""
    inner = "".join(f"<div><dt>{escape(name)}</dt><dd>{value}</dd></div>" for name, value in pairs if value)
    return element("dl", inner, **attributes) if inner else ""


def table(head: Iterable[str], rows: Iterable[Iterable[str]], name: str, caption: str = "") -> str:
    """A table: words of the head, HTML of the cells; the first cell of a row names the row, ``name`` the whole."""
    top = "".join(f'<th scope="col">{escape(words)}</th>' for words in head)
    body = []
    for row in rows:
        first, *rest = row
        body.append(f'<tr><th scope="row">{first}</th>{"".join(f"<td>{cell}</td>" for cell in rest)}</tr>')
    inner = text("caption", caption) if caption else ""
    inner += f"<thead><tr>{top}</tr></thead><tbody>{''.join(body)}</tbody>"
    return element("section", element("table", inner), cls="wide", tabindex="0", aria_label=name)


def marked(words: str, spans: Iterable[tuple[int, int]], name: str) -> str:
    """Words with some of their characters in an element of their own."""
    found, at = [], 0
    for first, last in spans:
        found += [escape(words[at:first]), text(name, words[first:last])]
        at = last
    return "".join([*found, escape(words[at:])])


def code(words: str, spans: Iterable[tuple[int, int]] = (), name: str = "mark") -> str:
    """A card or a line as code that may be broken: never behind its first blanks, else after an operator or a comma."""
    inner = marked(words, spans, name)
    pieces = re.split(r"(<[^>]*>|&[a-z0-9#]+;)", inner)
    broken = "".join(piece if at % 2 else _OPERATOR.sub(r"\g<0><wbr>", piece) for at, piece in enumerate(pieces))
    return element("code", re.sub(r"^( +)([^<&\s])", r'<span class="lead">\1\2</span>', broken))


def shifted(html: str, depth: int) -> str:
    """HTML with the addresses of the site made relative to a page ``depth`` folders below its top."""
    return html.replace(f'"{HERE}', f'"{"../" * depth}')
