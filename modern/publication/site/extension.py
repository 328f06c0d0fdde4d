"""The Sphinx extension: the directive ``made``, links to files of the project, and the writer of the HTML.

The templates (``docs/_templates``) make the parts around the text of a page accessible, and the writer makes the text
accessible.
"""

import json
import posixpath
import re
from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx import addnodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective
from sphinx.writers.html5 import HTML5Translator

from modern.publication.building import PAGES_OF_FILES
from modern.publication.site.made import Part, make
from modern.publication.site.markup import element, relative, stacked, text
from modern.publication.site.pages.addresses import places


class MadeDirective(SphinxDirective):
    """The directive ``:::{made} NAME ARGUMENT``, which inserts sections generated from data."""

    required_arguments = 1
    optional_arguments = 1
    final_argument_whitespace = True

    def run(self) -> list[nodes.Node]:
        """Return the nodes of the generated parts. An unknown name or argument ends the build with an error."""
        name, argument = self.arguments[0], "".join(self.arguments[1:])
        try:
            content = make(name, argument)
        except ValueError as error:
            raise self.error(f"made: {error}") from None
        # Links in a file that is shown are relative to its folder, those in other texts to the page.
        is_file = argument.endswith(".md")
        origin = posixpath.dirname(argument if is_file else posixpath.join("docs", self.env.docname))
        top = nodes.container()
        stack: list[tuple[int, nodes.Element]] = [(0, top)]  # the open sections with their levels, the innermost last
        for part in content:
            inner = self._inner(part, origin)
            if part.heading:
                # A section closes the open sections of its own and of deeper levels.
                while stack[-1][0] >= part.level:
                    stack.pop()
                section = nodes.section("", nodes.title("", part.heading), *inner, ids=[part.id], names=[part.id])
                stack[-1][1].append(section)
                stack.append((part.level, section))
            else:
                stack[-1][1].extend(inner)
        if jump := _jump_list(content):
            top.append(nodes.raw("", jump, format="html"))
        return [*top.children]

    def _inner(self, part: Part, origin: str) -> list[nodes.Node]:
        content: list[nodes.Node] = []
        if part.text:
            source = linked(self.env.app, part.text, self.env.docname, origin)
            content += self.parse_text_to_nodes(source, allow_section_headings=False)
        if part.html:
            html = relative(part.html, self.env.docname.count("/"))
            content.append(nodes.raw("", html, format="html"))
        return content


_LONG = 8  # the number of sections from which a page gets a list of them that stays in the window
_SECTION = re.compile(r"(?:Page |Section |Sheet |Error )?(\d\S*?|[EF]\d+)[.:]?(?= |$)")


def _jump_list(content: list[Part]) -> str:
    """Return a bar of links to the sections of a long page, or "" for a short page.  The bar is always visible."""
    parts = [part for part in content if part.heading and part.level == 1]
    if len(parts) < _LONG:
        return ""
    names = ((match[1] if (match := _SECTION.match(part.heading)) else part.heading, part) for part in parts)
    links = "".join(text("a", name, href=f"#{part.id}", title=part.heading) for name, part in names)
    return element("nav", text("span", "Jump to") + links, cls="jump", aria_label="Sections of this page")


_LINK = re.compile(r"\[([^\]\[]*)\]\(([\w./-]+)(#[\w-]*)?\)")
_WHOLE = re.compile(r"^:::\{whole\} (\S+)\n:::$", re.MULTILINE)


def _project_files(app: Sphinx, docname: str, source: list[str]) -> None:
    """Translate the links to files of the project, and include the files that ``:::{whole} FILE`` names."""
    root = Path(app.srcdir).parent

    def whole(match: re.Match[str]) -> str:
        file = match[1]
        return linked(app, (root / file).read_text(encoding="utf-8"), docname, posixpath.dirname(file))

    source[0] = linked(app, source[0], docname, posixpath.join("docs", posixpath.dirname(docname)))
    source[0] = _WHOLE.sub(whole, source[0])


def linked(app: Sphinx, text: str, docname: str, origin: str) -> str:
    """Return a text from the folder ``origin`` with its links translated to links from the page ``docname``.

    A link to a file that is no page becomes a link to the page that contains the file, or plain text.
    """
    root, folder = Path(app.srcdir).parent, posixpath.dirname(docname)

    def page(match: re.Match[str]) -> str:
        title, target, anchor = match.groups()
        file = posixpath.normpath(posixpath.join(origin, target))
        holder = PAGES_OF_FILES.get(file, "")
        if holder in app.env.found_docs:
            return f"[{title}]({posixpath.relpath(holder, folder or '.')}.md{anchor or ''})"
        inside = posixpath.relpath(file, "docs")
        if inside.removesuffix(".md") in app.env.found_docs:
            return f"[{title}]({posixpath.relpath(inside, folder or '.')}{anchor or ''})"
        if (root / file).exists():
            return match[0] if _copied(file) and origin.startswith("docs") else title
        return match[0]

    return _LINK.sub(page, text)


def _copied(file: str) -> bool:
    """Return True if Sphinx copies a linked file to the site, which it does for a picture or a table within docs."""
    return file.startswith("docs/") and not file.endswith((".md", "/")) and "." in posixpath.basename(file)


# A word in code that fits into a line of a phone, and is not broken at its hyphens.
_SHORT = re.compile(r'<span class="pre">([^<]{1,26})</span>')


def _stack_tables(app: Sphinx, name: str, template: str, context: dict[str, Any], tree: object) -> None:
    if "body" in context:
        context["body"] = stacked(_SHORT.sub(r'<span class="pre short">\1</span>', context["body"]))


def _write_places(app: Sphinx, exception: Exception | None) -> None:
    """Write the entries of the Index as a script, because a site that is opened as files cannot fetch data."""
    if exception is not None:
        return
    entries = [[p.name, f"{p.page}.html{'#' + p.id if p.id else ''}", p.description] for p in places()]
    script = f"window.hull1620Places = {json.dumps(entries, separators=(',', ':'))};\n"
    (Path(app.outdir) / "_static" / "places.js").write_text(script, encoding="utf-8")


def _without_descriptions(app: Sphinx, environment: Any) -> None:
    """Remove the entries of commands from the search, which finds each command by its section anyway."""
    environment.domains["commands"].data["commands"].clear()


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directive, the event handlers and the HTML writer. Sphinx calls this function."""
    app.add_directive("made", MadeDirective)
    app.connect("source-read", _project_files)
    app.connect("env-updated", _without_descriptions)
    app.connect("html-page-context", _stack_tables)
    app.connect("build-finished", _write_places)
    app.set_translator("html", AccessibleTranslator)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}


class AccessibleTranslator(HTML5Translator):
    """Sphinx's HTML writer with scope, tabindex and roles as WCAG 2.2 and the HTML standard require them."""

    def starttag(
        self, node: nodes.Element, tagname: str, suffix: str = "\n", empty: bool = False, **attributes: Any
    ) -> str:
        """Return a start tag.

        A heading cell of a table gets the scope ``col``, but an empty one becomes a data cell.  The keyboard can scroll
        a wide table.  The caption of a table of contents is not a heading, because it has no level.  The parameters of
        a long signature are no description list, although Sphinx writes them as ``dl``.
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

    def visit_image(self, node: nodes.Element) -> None:
        """Link a picture to its file, which a phone can enlarge.

        The dark theme inverts the colours of a picture that defines no colours for a dark theme.
        """
        file = Path(self.builder.srcdir) / node["uri"]
        if file.suffix == ".svg" and "prefers-color-scheme" not in file.read_text(encoding="utf-8"):
            node["classes"].append("drawing")
        start = len(self.body)
        super().visit_image(node)
        if not isinstance(node.parent, nodes.reference):
            self.body.insert(start, f'<a href="{node["uri"]}">')
            self.body.append("</a>")

    def visit_entry(self, node: nodes.Element) -> None:
        """End an empty heading cell as a data cell, because :meth:`starttag` began it as a data cell."""
        super().visit_entry(node)
        if isinstance(node.parent.parent, nodes.thead) and not node.astext():
            self.context[-1] = "</td>\n"
