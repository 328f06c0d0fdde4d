"""The Sphinx extension: the directive ``made``, the roles that point at data, and links to files that are no pages."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx import addnodes
from sphinx.application import Sphinx
from sphinx.domains.std import StandardDomain
from sphinx.environment import BuildEnvironment
from sphinx.util.docutils import SphinxDirective

from modern.publication.site.made import Made, Part, make
from modern.publication.site.markup import shifted
from modern.publication.site.mend import mend

ROLES = {"card": "{}", "row": "{}", "name": "name {}", "error": "error {}"}
"""A role, and the label of what it points at; ``{name}`program3 KELEQ``` is the label ``name program3 keleq``."""
HOLDERS = {
    "fortran_src/README.md": "text",
    "fortran_src/KNOWN-FAULTS.md": "known-faults",
    "fortran_src/OPEN-QUESTIONS.md": "open-questions",
    "transcripts/README.md": "transcripts",
    "README.md": "index",
    "CHANGELOG.md": "changes",
}
"""Files of the project that are no pages themselves, and the pages that hold or replace them."""


class MadeDirective(SphinxDirective):
    """``:::{made} NAME ARGUMENT``: what a maker makes, as sections of the page."""

    required_arguments = 1
    optional_arguments = 1
    final_argument_whitespace = True

    def run(self) -> list[nodes.Node]:
        """The nodes; an error of the build where the maker refuses."""
        name, argument = self.arguments[0], "".join(self.arguments[1:])
        try:
            found = make(name, argument)
        except ValueError as error:
            raise self.error(f"made: {error}") from None
        _note(self.env, found)
        top: list[nodes.Node] = []
        stack: list[tuple[int, nodes.Element]] = []
        for part in found.parts:
            while part.heading and stack and stack[-1][0] >= part.level:
                stack.pop()
            inner = self._inner(part)
            if part.heading:
                section = nodes.section("", nodes.title("", part.heading), *inner, ids=[part.id], names=[part.id])
                _add(stack, top, section)
                stack.append((part.level, section))
            else:
                for node in inner:
                    _add(stack, top, node)
        return top

    def _inner(self, part: Part) -> list[nodes.Node]:
        found: list[nodes.Node] = []
        if part.text:
            found += self.parse_text_to_nodes(part.text, allow_section_headings=False)
        if part.html:
            html = shifted(part.html, self.env.docname.count("/"))
            found.append(nodes.raw("", html, format="html"))
        return found


def _add(stack: Sequence[tuple[int, nodes.Element]], top: list[nodes.Node], node: nodes.Node) -> None:
    if stack:
        stack[-1][1].append(node)
    else:
        top.append(node)


def _note(env: BuildEnvironment, found: Made) -> None:
    """Make the addresses known to references and to the general index."""
    standard = env.get_domain("std")
    assert isinstance(standard, StandardDomain)
    entries = env.get_domain("index").data["entries"].setdefault(env.docname, [])
    for target in found.targets:
        label = target.label.lower()
        standard.anonlabels[label] = (env.docname, target.id)
        standard.labels[label] = (env.docname, target.id, target.title)
        if target.index:
            entries.append(("single", target.index, target.id, "", None))


def _role(kind: str) -> Any:
    """A role that points at a label made from its words; ``words <label>`` says other words."""

    def role(
        name: str, rawtext: str, text: str, lineno: int, inliner: Any, options: Any = None, content: Any = ()
    ) -> tuple[list[nodes.Node], list[nodes.system_message]]:
        words, _, rest = text.partition(" <")
        label = ROLES.get(kind, "{}").format(rest.rstrip(">") if rest else text).lower()
        shown = words if rest else text.rpartition(" ")[2] if kind in ("card", "name") else text
        reference = addnodes.pending_xref(
            rawtext,
            refdomain="std",
            reftype="ref",
            reftarget=label,
            refexplicit=True,
            refwarn=True,
            classes=[f"to-{kind}"],
        )
        reference += nodes.inline("", shown, classes=["std", "std-ref"])
        env = inliner.document.settings.env
        reference["refdoc"] = env.docname
        return [reference], []

    return role


_LINK = re.compile(r"\[([^\]\[]*)\]\(([\w./-]+)(#[\w-]*)?\)")


_WHOLE = re.compile(r"^:::\{whole\} (\S+)\n:::$", re.MULTILINE)


def _project_files(app: Sphinx, docname: str, source: list[str]) -> None:
    """Put in files that a page holds whole (``:::{whole} fortran_src/README.md``), and make links to files.

    A link to a file that is no page goes to the page that holds it, or becomes its words.
    """
    root = Path(app.srcdir).parent

    def whole(match: re.Match[str]) -> str:
        file = match[1]
        return linked(app, (root / file).read_text(encoding="utf-8"), docname, posixpath.dirname(file))

    source[0] = linked(app, source[0], docname, posixpath.join("docs", posixpath.dirname(docname)))
    source[0] = _WHOLE.sub(whole, source[0])


def linked(app: Sphinx, words: str, docname: str, origin: str) -> str:
    """Text of a file of the folder ``origin`` with its links made those of the page ``docname``."""
    root, folder = Path(app.srcdir).parent, posixpath.dirname(docname)

    def page(match: re.Match[str]) -> str:
        words, target, part = match.groups()
        file = posixpath.normpath(posixpath.join(origin, target))
        holder = HOLDERS.get(file, "")
        if holder in app.env.found_docs:
            return f"[{words}]({posixpath.relpath(holder, folder or '.')}.md{part or ''})"
        inside = posixpath.relpath(file, "docs")
        if inside.removesuffix(".md") in app.env.found_docs:
            return f"[{words}]({posixpath.relpath(inside, folder or '.')}{part or ''})"
        if (root / file).exists():
            return match[0] if _copied(file) and origin.startswith("docs") else words
        return match[0]

    return _LINK.sub(page, words)


def _copied(file: str) -> bool:
    """Whether a link to a file makes Sphinx lay it beside the pages: a picture or a table within docs."""
    return file.startswith("docs/") and not file.endswith((".md", "/")) and "." in posixpath.basename(file)


def _finished(app: Sphinx, exception: Exception | None) -> None:
    if exception is None and app.builder.name == "html":
        mend(Path(app.outdir))


def setup(app: Sphinx) -> dict[str, Any]:
    """Sphinx calls this."""
    app.add_directive("made", MadeDirective)
    for kind in (*ROLES, "at"):
        app.add_role(kind, _role(kind))
    app.connect("source-read", _project_files)
    app.connect("build-finished", _finished)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
