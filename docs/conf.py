"""Sphinx's settings for the edition; what makes its pages is ``modern/publication/site``."""

from functools import cache
from pathlib import Path

from sphinx.application import Sphinx

import hull1620
from modern.cli.main import build_parser
from modern.publication import interface
from modern.publication.commands import as_markdown, commands
from modern.publication.figures import figures, filled, named
from modern.publication.site.colours import DARK, LIGHT

project = "hull1620"
author = "The hull1620 developers"
copyright = "2026, The hull1620 developers. MIT licence; the thesis's listings and prints as the objects restored"

extensions = ["myst_parser", "modern.publication.site.extension"]
exclude_patterns = ["console", "**/node_modules"]
myst_enable_extensions = ["colon_fence", "deflist", "attrs_inline", "attrs_block"]
myst_heading_anchors = 4
nitpicky = True

html_theme = "furo"
html_title = "The hull programs of 1963"
html_static_path = ["_static"]
html_css_files = ["edition.css", "data.css", "console.css"]
html_js_files = ["edition.js", ("data.js", {"defer": "defer"})]
html_copy_source = False
html_show_sphinx = False
html_show_search_summary = False  # a summary is fetched, and from the file system nothing can be
html_theme_options = {"navigation_with_keys": False, "light_css_variables": LIGHT, "dark_css_variables": DARK}


@cache
def values() -> dict[str, str]:
    """What pages name between double braces: figures of results, and the references made from the code."""
    made = {
        "commands": as_markdown(commands(build_parser([]))),
        "python": interface.as_markdown(interface.names(hull1620)),
    }
    return {**figures(Path(__file__).parent), **made}


def fill(app: Sphinx, name: str, source: list[str]) -> None:
    """Put them into a page that Sphinx has read."""
    if named(source[0]):
        source[0] = filled(source[0], values())


def setup(app: Sphinx) -> None:
    """Sphinx calls this."""
    app.connect("source-read", fill)
