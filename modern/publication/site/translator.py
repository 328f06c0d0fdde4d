"""The writer of the pages' HTML: Sphinx's own, with corrections for accessibility that a template cannot make.

Templates (``docs/_templates``) correct the frame of a page: landmarks get names, buttons a type, the search a heading.
This module corrects elements of the text.
"""

from typing import Any

from docutils import nodes
from sphinx import addnodes
from sphinx.writers.html5 import HTML5Translator


class AccessibleTranslator(HTML5Translator):
    """Sphinx's HTML writer with scope, tabindex and roles as WCAG 2.2 and the HTML standard require them."""

    def starttag(
        self, node: nodes.Element, tagname: str, suffix: str = "\n", empty: bool = False, **attributes: Any
    ) -> str:
        """Return a start tag.

        A heading cell has the scope of its column, but an empty one is a data cell.  The keyboard can scroll a wide
        table.  The caption of a table of contents is not a heading, because it has no level.  The parameters of a long
        signature are no description list, although Sphinx writes them as ``dl``.
        """
        if tagname == "th":
            tagname, attributes = ("th", attributes | {"scope": "col"}) if node.astext() else ("td", attributes)
        if "table-wrapper" in node.get("classes", ()):
            attributes["tabindex"] = "0"
        if tagname == "dl" and isinstance(node, addnodes.desc_parameterlist):
            attributes["role"] = "presentation"
        if attributes.get("ROLE") == "heading":
            del attributes["ROLE"]
        tag: str = super().starttag(node, tagname, suffix, empty, **attributes)
        return tag

    def visit_literal_block(self, node: nodes.Element) -> None:
        """Let the keyboard scroll a block of code."""
        try:
            super().visit_literal_block(node)
        finally:  # Sphinx raises SkipNode after it has written a highlighted block
            self.body[-1] = self.body[-1].replace("<pre>", '<pre tabindex="0">', 1)

    def visit_entry(self, node: nodes.Element) -> None:
        """Close an empty heading cell as the data cell that :meth:`starttag` began."""
        super().visit_entry(node)
        if isinstance(node.parent.parent, nodes.thead) and not node.astext():
            self.context[-1] = "</td>\n"
