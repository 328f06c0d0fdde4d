"""Configuration of Sphinx for the site; ``modern/publication/site`` makes the pages that are built from data."""

from functools import cache
from pathlib import Path

from pygments.lexers.special import TextLexer
from sphinx.application import Sphinx

from modern.publication.figures import figures, filled, named
from modern.publication.site.colours import DARK, LIGHT

project = "hull1620"
author = "The hull1620 developers"
copyright = "2026, The hull1620 developers. MIT licence, except the quoted listings and prints of the thesis"

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinxarg.ext",
    "modern.publication.site.extension",
]
exclude_patterns = ["console", "**/node_modules"]
templates_path = ["_templates"]
myst_enable_extensions = ["colon_fence", "deflist", "attrs_inline", "attrs_block"]
myst_heading_anchors = 4
nitpicky = True
smartquotes_action = "q"  # only quotation marks: two hyphens begin an option and are no dash
# Docstrings name classes and functions that have no page. Such a name is printed as code, without a link.
nitpick_ignore_regex = [("py:.*", ".*")]
autodoc_member_order = "groupwise"
autodoc_preserve_defaults = True
autodoc_typehints = "none"
python_maximum_signature_line_length = 80
napoleon_use_ivar = True

html_theme = "furo"
html_title = "The hull programs of 1963"
html_static_path = ["_static"]
html_favicon = "_static/favicon.svg"
html_css_files = ["edition.css", "data.css", "console.css"]
html_js_files = ["edition.js", ("data.js", {"defer": "defer"}), ("story.js", {"defer": "defer"})]
html_copy_source = False
html_use_index = False  # the page Index takes its place
html_domain_indices = False
html_show_sphinx = False
html_show_search_summary = False  # a browser fetches each summary, which fails for a site opened as files
html_theme_options = {"navigation_with_keys": False, "light_css_variables": LIGHT, "dark_css_variables": DARK}


@cache
def values() -> dict[str, str]:
    """Return the figures of results that pages name between double braces."""
    return figures(Path(__file__).parent)


def fill(app: Sphinx, name: str, source: list[str]) -> None:
    """Replace the names of figures in a page that Sphinx has read."""
    source[0] = filled(source[0], values() if named(source[0]) else {})


def setup(app: Sphinx) -> None:
    """Register :func:`fill` and the language of decks with record marks, which FORTRAN's lexer does not know."""
    app.add_lexer("deck", TextLexer)
    app.connect("source-read", fill)
