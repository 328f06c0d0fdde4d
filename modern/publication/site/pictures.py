"""Pictures as they stand in a page: SVG inline, its ids its own, its paper the page's, its greys those of the theme.

The pictures of :mod:`modern.drawing` are told apart by shape and by grey, so that the dark theme may turn their greys
round (``drawing`` of docs/_static/edition.css) without changing what they say.
"""

from __future__ import annotations

import re

from modern.publication.site.markup import element, escape

_GROUND = re.compile(r'<rect (?:x="[^"]*" )?width="[^"]*" height="[^"]*" fill="#fff"/>\n?')
_REFERENCE = re.compile(r'\b(id|href|xlink:href|aria-labelledby|aria-describedby)="(#?)([^"]*)"|url\(#([\w-]+)\)')


_SIZE = re.compile(r'(<svg [^>]*?)width="(\d+)" height="(\d+)"')


def inline(svg: str, key: str, cls: str = "drawing", percent: int = 100) -> str:
    """An SVG file's text as an element of a page, so many percent of its size.

    ``key`` is told to every id within, so that two pictures of a page share none.
    """
    svg = svg[svg.index("<svg") :]
    svg = re.sub(r"<style>.*?</style>\n?", "", svg, flags=re.DOTALL)
    svg = _GROUND.sub("", svg, count=1)
    svg = _SIZE.sub(
        lambda m: f'{m[1]}width="{int(m[2]) * percent // 100}" height="{int(m[3]) * percent // 100}"', svg, 1
    )
    known = set(re.findall(r'\bid="([^"]+)"', svg))

    def own(match: re.Match[str]) -> str:
        attribute, mark, words, url = match.groups()
        if url:
            return f"url(#{url}-{key})" if url in known else match[0]
        if attribute == "id" or mark:
            return f'{attribute}="{mark}{words}-{key}"' if words in known else match[0]
        if attribute.startswith("aria"):
            return f'{attribute}="{" ".join(f"{word}-{key}" for word in words.split())}"'
        return match[0]

    return _REFERENCE.sub(own, svg).replace("<svg ", f'<svg class="{cls}" ', 1).strip()


def described(svg: str, words: str) -> str:
    """A picture with a description in words below its title; a picture that has one is left as it is."""
    if "<desc" in svg:
        return svg
    named = svg.replace("<title>", '<title id="title">', 1).replace(
        "</title>", f'</title>\n<desc id="desc">{escape(words)}</desc>', 1
    )
    return named.replace("<svg ", '<svg aria-labelledby="title" aria-describedby="desc" ', 1)


def figure(svg: str, key: str, caption: str, cls: str = "drawing", words: str = "") -> str:
    """A picture with a caption in HTML, and with ``words`` for who does not see it."""
    svg = described(svg, words) if words else svg
    return element("figure", inline(svg, key, cls) + element("figcaption", caption), cls=f"of-{cls}")
