"""Typst markup from words and from the documents' Markdown.

Words go in as strings of Typst's code (``#"..."``), where nothing but a quotation mark and a backslash has a meaning;
so no character of a text is ever taken for markup.  Typst: Reference, "Syntax" and "Strings".
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, field

from markdown_it import MarkdownIt
from markdown_it.token import Token
from mdit_py_plugins.deflist import deflist_plugin

_DIRECTIVE = re.compile(r"^:::\{.*?^:::$\n?|^```\{.*?^```$\n?", re.MULTILINE | re.DOTALL)
_HEAD = re.compile(r"\A---\n.*?\n---\n", re.DOTALL)
_COMMENT = re.compile(r"<!--.*?-->\n?", re.DOTALL)
_ROLE = re.compile(r"\{([a-z]+)\}\Z")
_FURTHEST = 0x2E80
"""Where the scripts of East Asia begin, of which the fonts that Typst brings have nothing."""
_LINE, _LONG, _CELL, _WORD, _GAP = 104, 90, 40, 12, 2
"""Letters: a table's width; the most that a column counts for; a cell that is no sentence; a word where none is known;
what is between columns."""
_USUAL, _SMALL, _SMALLEST = 8.5, 6.5, 5.0
"""Points: a table's letters; the least for cells each in a line; the least at all."""


def string(words: str) -> str:
    """A Typst string; a character that the book's fonts have not, as the OCR's full stop of Chinese, by its number."""
    words = "".join(c if ord(c) < _FURTHEST else f"[U+{ord(c):04X}]" for c in words)
    escaped = words.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n").replace("\t", "  ")
    return f'"{escaped}"'


def say(words: str) -> str:
    """Words within markup."""
    return f"#{string(words)};" if words else ""


def code(words: str) -> str:
    """Words of a program within a line."""
    return f"#raw({string(words)});"


def block(words: str, size: str = "7.8pt") -> str:
    """Lines of a program, set in a block of their own."""
    return f"#listing({size}, {string(words.rstrip(chr(10)))})\n\n"


def call(name: str, *content: str, **named: str) -> str:
    """A function of Typst called with pieces of markup; ``named`` arguments are code."""
    arguments = "".join(f"{key.replace('_', '-')}: {value}, " for key, value in named.items())
    return f"#{name}({arguments}{', '.join(f'[{one}]' for one in content)})"


def label(*parts: str) -> str:
    """A label of words: what a label may not hold becomes a code of it."""
    words = "--".join(parts)
    return "".join(c if c.isalnum() and c.isascii() else "-" if c in "-_ " else f".{ord(c):x}." for c in words)


def heading(words: str, level: int, place: str) -> str:
    """A heading with its label."""
    return f"{'=' * level} {say(words)} <{place}>\n\n"


def to(place: str, content: str) -> str:
    """A reference to a label: its words and the page."""
    return f"#to(<{place}>)[{content}]"


def table(
    head: Sequence[str], rows: Iterable[Sequence[str]], widths: Sequence[int], words: Sequence[int] | None = None
) -> str:
    """A table of markup; ``widths`` are each column's longest cells, in letters, and ``words`` the longest words."""
    size, columns = columns_of(widths, [min(width, _WORD) for width in widths] if words is None else words)
    cells = "".join(f"[{cell}], " for row in rows for cell in row)
    top = "".join(f"[{call('strong', cell)}], " for cell in head)
    return f"#tabular({size:.1f}pt, ({', '.join(columns)},), ({top}), ({cells}))\n\n"


def columns_of(widths: Sequence[int], words: Sequence[int]) -> tuple[float, list[str]]:
    """The size of a table's letters in points, and how wide each of its columns is, as Typst has it.

    Where all cells fit a column is as wide as it is, or, without sentences, as its cells in somewhat smaller letters.
    Else no column is narrower than its longest word, and what is left goes to those with longer cells; letters get
    smaller where the words alone do not fit.
    """
    room = _LINE - _GAP * len(widths)
    if sum(widths) <= room:
        return _USUAL, ["auto"] * len(widths)
    if sum(widths) * _SMALL <= room * _USUAL and max(widths) <= _CELL:
        return _USUAL * room / sum(widths), [f"{width + _GAP}fr" for width in widths]
    least = sum(words)
    size = max(_SMALLEST, min(_USUAL, _USUAL * room / least))
    more = [min(width, _LONG) - word if width > word else 0 for width, word in zip(widths, words, strict=True)]
    spare = max(0.0, room * _USUAL / size - least) / max(1, sum(more))
    return size, [f"{word + _GAP + spare * each:.1f}fr" for word, each in zip(words, more, strict=True)]


@dataclass
class Markdown:
    """A document's Markdown made Typst.

    ``name`` is its path below ``docs``, ``known`` the documents and addresses of the book; ``level`` what its first
    heading becomes.  ``picture`` gives Typst's name for a picture's file, or nothing where the book has it not.
    """

    name: str
    known: Collection[str]
    level: int
    picture: Callable[[str], str]
    _slugs: dict[str, int] = field(default_factory=dict)

    def typst(self, source: str) -> str:
        """The whole document."""
        text = _DIRECTIVE.sub("", _COMMENT.sub("", _HEAD.sub("", source)))
        tokens = MarkdownIt("commonmark").enable("table").use(deflist_plugin).parse(text)
        return "".join(self._blocks(tokens))

    def _blocks(self, tokens: Sequence[Token]) -> Iterator[str]:
        at = 0
        while at < len(tokens):
            token = tokens[at]
            end = _end(tokens, at)
            yield self._block(token, tokens[at + 1 : end])
            at = max(end, at) + 1

    def _block(self, token: Token, inner: Sequence[Token]) -> str:
        match token.type:
            case "heading_open":
                words = _plain(inner[0])
                first, place = not self._slugs, label(self.name, self._slug(words))
                itself = f"#[] <{label(self.name)}>\n" if first else ""
                return itself + heading(words, self.level + int(token.tag[1]) - 1, place)
            case "paragraph_open":
                words = self._inline(inner[0])
                if _is_title(inner[0]):
                    return call("block", words, sticky="true") + "\n\n"
                return words + ("\n" if token.hidden else "\n\n")
            case "bullet_list_open":
                return call("list", *self._items(inner)) + "\n\n"
            case "ordered_list_open":
                start = str(token.attrs.get("start", 1))
                return call("enum", *self._items(inner), start=start) + "\n\n"
            case "fence" | "code_block":
                return block(token.content)
            case "blockquote_open":
                return call("quote", "".join(self._blocks(inner)), block="true") + "\n\n"
            case "table_open":
                return self._table(inner)
            case "dl_open":
                return self._definitions(inner)
            case "hr":
                return "#line(length: 100%, stroke: 0.4pt)\n\n"
        return ""

    def _items(self, tokens: Sequence[Token]) -> list[str]:
        found, at = [], 0
        while at < len(tokens):
            end = _end(tokens, at)
            found.append("".join(self._blocks(tokens[at + 1 : end])))
            at = end + 1
        return found

    def _definitions(self, tokens: Sequence[Token]) -> str:
        found, at, term = [], 0, ""
        while at < len(tokens):
            end = _end(tokens, at)
            if tokens[at].type == "dt_open":
                term = self._inline(tokens[at + 1])
                place = label(self.name, self._slug(_plain(tokens[at + 1])))
                term = f"#[{term}#[] <{place}>]"
            else:
                found.append(call("terms.item", term, "".join(self._blocks(tokens[at + 1 : end]))).removeprefix("#"))
            at = end + 1
        return f"#terms({', '.join(found)})\n\n"

    def _table(self, tokens: Sequence[Token]) -> str:
        rows: list[list[Token]] = []
        for token in tokens:
            if token.type == "tr_open":
                rows.append([])
            elif token.type == "inline":
                rows[-1].append(token)
        columns = [[_plain(row[k]) for row in rows] for k in range(len(rows[0]))]
        words = [max(len(word) for cell in column for word in cell.split() or ("",)) for column in columns]
        # A head may go on below; a cell is better in a line.
        widths = [max(word, *map(len, column[1:])) for word, column in zip(words, columns, strict=True)]
        made = [[self._inline(cell) for cell in row] for row in rows]
        return table(made[0], made[1:], widths, words)

    def _inline(self, token: Token) -> str:
        out: list[str] = []
        ends: list[str] = []
        for child in token.children or ():
            match child.type:
                case "text":
                    out.append(say(child.content))
                case "softbreak":
                    out.append(" ")
                case "hardbreak":
                    out.append("#linebreak()")
                case "code_inline":
                    out.append(self._role(out, child.content))
                case "em_open" | "strong_open":
                    out.append("#emph[" if child.type == "em_open" else "#strong[")
                case "em_close" | "strong_close":
                    out.append("]")
                case "link_open":
                    place = self._target(str(child.attrs["href"]))
                    opened = f"#to(<{place}>)[" if place else self._outside(str(child.attrs["href"]))
                    out.append(opened)
                    ends.append("]" if opened else "")
                case "link_close":
                    out.append(ends.pop())
                case "image":
                    file = self.picture(posixpath.normpath(posixpath.join(self._folder, str(child.attrs["src"]))))
                    alt = string(child.content)
                    out.append(f"#picture({string(file)}, {alt})" if file else say(child.content))
        return "".join(out)

    def _role(self, out: list[str], words: str) -> str:
        """Words in backquotes: of a role before them (``{card}``), if there is one, else of a program."""
        before = _ROLE.search(out[-1].removesuffix('";')) if out else None
        if before is None:
            return code(words)
        out[-1] = say(out[-1][2:-2].removesuffix(before[0]).replace('\\"', '"').replace("\\\\", "\\"))
        shown, _, rest = words.partition(" <")
        target = rest.rstrip(">") or words
        names = {"card": label("card", *target.split()), "row": label("row", target), "error": label("error", target)}
        place = names.get(before[1], "") or self._target(f"{target}.md" if before[1] == "doc" else "")
        content = say(shown) if rest or before[1] in ("doc", "ref") else code(shown)
        return to(place, content) if place in self.known else content

    @property
    def _folder(self) -> str:
        return posixpath.dirname(self.name)

    def _target(self, address: str) -> str:
        """The label an address of the documents is, or nothing."""
        file, _, part = address.partition("#")
        if not file.endswith(".md") and not (part and not file):
            return ""
        page = posixpath.normpath(posixpath.join(self._folder, file)) if file else self.name
        place = label(page, part) if part else label(page)
        return place if place in self.known else label(page) if label(page) in self.known else ""

    def _outside(self, address: str) -> str:
        return f"#link({string(address)})[" if re.match(r"https?:", address) else ""

    def _slug(self, words: str) -> str:
        """The name of a heading in addresses, as MyST makes it; a second one of the name is counted."""
        slug = re.sub(r"[^\w\- ]", "", words.lower()).replace(" ", "-")
        times = self._slugs.get(slug, 0)
        self._slugs[slug] = times + 1
        return f"{slug}-{times}" if times else slug


def places(name: str, source: str) -> tuple[str, ...]:
    """The labels of a document: its headings and its definitions, and itself, which is its first heading."""
    found = Markdown(name, (), 1, lambda file: "").typst(source)
    return (label(name), *re.findall(r" <([\w.-]+)>(?=\n|\])", found))


def _is_title(paragraph: Token) -> bool:
    """Whether a paragraph is strong words alone: the title of the table below it, which it is not to be parted from."""
    kinds = [child.type for child in paragraph.children or () if child.type != "text" or child.content]
    return kinds[:1] == ["strong_open"] and kinds.index("strong_close") == len(kinds) - 1


def _end(tokens: Sequence[Token], at: int) -> int:
    """Where what begins at a token ends; the token itself where it is whole."""
    depth = 0
    for place in range(at, len(tokens)):
        depth += tokens[place].nesting
        if depth == 0:
            return place
    return len(tokens) - 1


def _plain(token: Token) -> str:
    return "".join(child.content for child in token.children or () if child.type in ("text", "code_inline"))
