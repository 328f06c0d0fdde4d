"""SVG pictures inside pages, with ids that are unique in the page and with the background of the page.

The pictures of :mod:`modern.drawing` distinguish things by shape and shades of grey.  The dark theme can therefore
invert the shades (class ``drawing`` in docs/_static/edition.css).
"""

import re

from modern.publication.site.markup import element, escape

_GROUND = re.compile(r'<rect (?:x="[^"]*" )?width="[^"]*" height="[^"]*" fill="#fff"/>\n?')
_REFERENCE = re.compile(r'\b(id|href|xlink:href|aria-labelledby|aria-describedby)="(#?)([^"]*)"|url\(#([\w-]+)\)')
_SIZE = re.compile(r'(<svg [^>]*?)width="(\d+)" height="(\d+)"')


def inline(svg: str, key: str, cls: str = "drawing", percent: int = 100) -> str:
    """Return the text of an SVG file as an element of a page, scaled to ``percent``.

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


def described(svg: str, description: str) -> str:
    """Add a description after the title of a picture, unless it has one."""
    if "<desc" in svg:
        return svg
    titled = svg.replace("<title>", '<title id="title">', 1)
    titled = titled.replace("</title>", f'</title>\n<desc id="desc">{escape(description)}</desc>', 1)
    return titled.replace("<svg ", '<svg aria-labelledby="title" aria-describedby="desc" ', 1)


def figure(svg: str, key: str, caption: str, cls: str = "drawing", description: str = "") -> str:
    """Return a picture with a caption in HTML and, optionally, a description for screen readers."""
    svg = described(svg, description) if description else svg
    return element("figure", inline(svg, key, cls) + element("figcaption", caption), cls=f"of-{cls}")
