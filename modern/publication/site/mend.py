"""What theme and docutils leave undone in a finished page, mended: names of landmarks, kinds of buttons, headings.

Each mending is a plain replacement in the page's text; a theme that has mended it itself is left as it is.
"""

from __future__ import annotations

import re
from pathlib import Path

_PLAIN = (
    ('<aside class="sidebar-drawer">', '<aside class="sidebar-drawer" aria-label="Contents of the edition">'),
    ('<aside class="toc-drawer">', '<aside class="toc-drawer" aria-label="On this page">'),
    ('<aside class="toc-drawer no-toc">', '<aside class="toc-drawer no-toc" aria-label="On this page">'),
    ('<button class="theme-toggle"', '<button type="button" class="theme-toggle"'),
    ('<div class="highlight"><pre>', '<div class="highlight"><pre tabindex="0">'),
    ('<div class="table-wrapper', '<div tabindex="0" class="table-wrapper'),
    ('<th class="head"><p></p></th>', '<td class="head"></td>'),
    ('<th class="head', '<th scope="col" class="head'),
    ('<p class="caption" role="heading">', '<p class="caption">'),
    ('<div id="search-results">', '<h1>Search</h1>\n\n<div id="search-results">'),
)
"""What stands in a page, and what is put there instead."""
_ROLE = re.compile(r'<svg class="flow" ([^>]*)role="img"')


def mended(page: str) -> str:
    """A page's HTML, mended.

    A flow chart holds links, so it is a group and no single picture; code and tables that are too wide are
    scrolled by keyboard too.
    """
    for there, instead in _PLAIN:
        page = page.replace(there, instead)
    return _ROLE.sub(r'<svg class="flow" \1role="group"', page)


def mend(folder: Path) -> None:
    """Mend every page of a folder."""
    for file in sorted(folder.rglob("*.html")):
        there = file.read_text(encoding="utf-8")
        now = mended(there)
        if now != there:
            file.write_text(now, encoding="utf-8")
