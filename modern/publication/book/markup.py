"""Write Typst markup from plain text and from the Markdown of the documents.

Text is written as string literals of Typst's code mode (``#"..."``), in which only quotation marks and backslashes have
a meaning.  No character of a text can therefore be interpreted as markup (Typst reference, "Syntax" and "Strings").
"""

import posixpath
import re
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from markdown_it import MarkdownIt
from markdown_it.tree import SyntaxTreeNode

from modern.publication.building import PAGES_OF_FILES

# The directive of a part that the site generates from data, and the language of the code fence that replaces it.
_MADE = re.compile(r"^:::\{made\} (.*)\n:::$", re.MULTILINE)
_MADE_FENCE = "made "
_DIRECTIVE = re.compile(r"^:::\{.*?^:::$\n?|^```\{.*?^```$\n?", re.MULTILINE | re.DOTALL)
_HEAD = re.compile(r"\A---\n.*?\n---\n", re.DOTALL)
_COMMENT = re.compile(r"<!--.*?-->\n?", re.DOTALL)
_FIRST_UNSUPPORTED = 0x2E80  # the first code point of the East Asian scripts, which the fonts of Typst do not contain
# A number with a sign, a unit, or an interval; such cells are aligned to the right.
_NUMBER = re.compile(r"[-−+±]?[\d.,]+(?:[\s%×·^/]|\([−\d.,\sto–-]*\)|[\d.,⁻⁰¹²³⁴-⁹-])*|-|–|")
_RAISED = re.compile("([\u207b\u2070\u00b9\u00b2\u00b3\u2074-\u2079]+)")
_LOWERED = str.maketrans("\u207b\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079", "\u22120123456789")
# Widths in characters: a table has at most _LINE, and the gap between columns _GAP. A column counts with at most _LONG.
# A cell of more than _CELL is a sentence. The longest word has _WORD by default, and a name of at most _NAME stays on
# one line.
_LINE, _LONG, _CELL, _WORD, _GAP, _NAME = 104, 90, 40, 12, 2, 16
# The normal and the smallest font size of tables in points.
_USUAL, _SMALL = 8.5, 6.5
# The normal and the smallest font size of programs in points, and the product of font size and letters on a line.
_CODE, _LEAST, _LETTERS = 7.8, 6.2, 725


def string(text: str) -> str:
    """Return a Typst string. Characters that the fonts lack, such as a Chinese full stop, become Unicode numbers."""
    text = "".join(c if ord(c) < _FIRST_UNSUPPORTED else f"[U+{ord(c):04X}]" for c in text)
    escaped = text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n").replace("\t", "  ")
    return f'"{escaped}"'


def say(text: str) -> str:
    """Return plain text as Typst markup. Raised digits become superscripts: the book's fonts lack most of them."""
    pieces = _RAISED.split(text)
    markup = (
        f"#super({string(piece.translate(_LOWERED))});" if n % 2 else f"#{string(piece)};"
        for n, piece in enumerate(pieces)
        if piece
    )
    return "".join(markup)


def code(text: str) -> str:
    """Return program text within a line as Typst markup."""
    return f"#raw({string(text)});"


def block(text: str) -> str:
    """Return lines of a program as a block.  The letters are smaller if lines are long, down to a limit."""
    size = max(_LEAST, min(_CODE, _LETTERS / max(map(len, text.splitlines()), default=1)))
    return f"#listing({size:.1f}pt, {string(text.rstrip(chr(10)))})\n\n"


def call(name: str, *content: str, **named: str) -> str:
    """Return a call of a Typst function with markup as ``content``. The ``named`` arguments are Typst code."""
    arguments = "".join(f"{key.replace('_', '-')}: {value}, " for key, value in named.items())
    return f"#{name}({arguments}{', '.join(f'[{piece}]' for piece in content)})"


def label(*parts: str) -> str:
    """Return a Typst label made from ``parts``.  A character that labels cannot contain is replaced by its code."""
    joined = "--".join(parts)
    return "".join(c if c.isalnum() and c.isascii() else "-" if c in "-_ " else f".{ord(c):x}." for c in joined)


def heading(title: str, level: int, place: str) -> str:
    """Return a heading with its label as Typst markup."""
    return f"{'=' * level} {say(title)} <{place}>\n\n"


def table(
    head: Sequence[str],
    rows: Iterable[Sequence[str]],
    widths: Sequence[int],
    longest: Sequence[int] | None = None,
    right: Collection[int] = (),
) -> str:
    """Return a table as Typst markup.

    For each column, ``widths`` has the length of the longest cell in characters, and ``longest`` has that of the
    longest word. ``right`` has the indices of the columns of numbers, which are aligned to the right. A table that is
    too wide is split, and both halves have the columns that name the rows. Raise ValueError for a table that would need
    letters smaller than ``_SMALL`` points.
    """
    rows = list(rows)
    longest = [min(width, _WORD) for width in widths] if longest is None else longest
    size, columns = columns_of(widths, longest)
    naming = next((k for k in range(1, len(head)) if len({tuple(row[:k]) for row in rows}) == len(rows)), 1)
    if size < _SMALL:
        if len(head) <= naming + 1:
            name = " | ".join(head)
            raise ValueError(f"the table {name} needs letters of {size:.1f} pt; the smallest are {_SMALL} pt")
        middle = (naming + len(head) + 1) // 2
        halves = [[*range(naming), *half] for half in (range(naming, middle), range(middle, len(head)))]
        return "".join(
            table(
                [head[k] for k in half],
                [[row[k] for k in half] for row in rows],
                [widths[k] for k in half],
                [longest[k] for k in half],
                [place for place, k in enumerate(half) if k in right],
            )
            for half in halves
        )
    cells = "".join(f"[{cell}], " for row in rows for cell in row)
    top = "".join(f"[{call('strong', cell)}], " for cell in head)
    aligned = ", ".join("right" if k in right else "left" for k in range(len(head)))
    return f"#tabular({size:.1f}pt, ({', '.join(columns)},), ({aligned},), ({top}), ({cells}))\n\n"


def columns_of(widths: Sequence[int], longest: Sequence[int]) -> tuple[float, list[str]]:
    """Return the font size of a table in points, and the widths of its columns in Typst's notation.

    If all cells fit on one line, columns get their natural width. If no cell is a sentence, the font may be reduced
    until the cells fit. Otherwise every column is at least as wide as its longest word, and columns with longer cells
    share the remaining space. The font is reduced if even the words do not fit.
    """
    room = _LINE - _GAP * len(widths)
    if sum(widths) <= room:
        return _USUAL, ["auto"] * len(widths)
    if sum(widths) * _SMALL <= room * _USUAL and max(widths) <= _CELL:
        return _USUAL * room / sum(widths), [f"{width + _GAP}fr" for width in widths]
    least = sum(longest)
    size = min(_USUAL, _USUAL * room / least)
    extra = [min(width, _LONG) - word if width > word else 0 for width, word in zip(widths, longest, strict=True)]
    spare = max(0.0, room * _USUAL / size - least) / max(1, sum(extra))
    return size, [f"{word + _GAP + spare * weight:.1f}fr" for word, weight in zip(longest, extra, strict=True)]


# The pages that replace files outside the folder of the documents, by the names of these files.
_PAGE_OF = {posixpath.basename(file): f"{page}.md" for file, page in PAGES_OF_FILES.items() if "README" not in file}


@dataclass
class Markdown:
    """A translator of one document from Markdown to Typst.

    ``name`` is the path of the document below ``docs``, and ``known`` has all labels of the book.  ``picture`` returns
    the name under which Typst finds the file of a picture, or "" if the book lacks the picture.  ``made`` returns the
    printed form of a part of a page that the site generates from data.  ``subjects`` has the entries of the index by
    label and by name in lower case, and ``names`` matches these names in a text.  If the document has the same title as
    its ``chapter``, the title is not printed again.
    """

    name: str
    known: Collection[str]
    picture: Callable[[str], str]
    made: Callable[[str], str] = lambda argument: ""
    subjects: Mapping[str, str] = field(default_factory=dict)
    names: re.Pattern[str] = re.compile(r"(?!)")
    chapter: str = ""
    _slugs: dict[str, int] = field(default_factory=dict)

    def typst(self, source: str) -> str:
        """Translate the whole document."""
        text = _MADE.sub(rf"~~~{_MADE_FENCE}\1\n~~~", _COMMENT.sub("", _HEAD.sub("", source)))
        # On paper an interval may stand below its estimate, but is not broken itself.
        text = _DIRECTIVE.sub("", text).replace("\N{NO-BREAK SPACE}(", " (")
        return self._blocks(SyntaxTreeNode(MarkdownIt("commonmark").enable("table").parse(text)))

    def _blocks(self, parent: SyntaxTreeNode) -> str:
        return "".join(map(self._block, parent.children))

    def _block(self, node: SyntaxTreeNode) -> str:
        match node.type:
            case "heading":
                title = _plain(node)
                first, place = not self._slugs, label(self.name, self._slug(title))
                itself = f"#[] <{label(self.name)}>\n" if first else ""
                if first and self.chapter.removeprefix("The ").lower() == title.lower():
                    return f"{itself}#[] <{place}>\n\n"
                return itself + heading(title, 1 + int(node.tag[1]), place) + self._entry(place)
            case "paragraph":
                markup = self._inline(node)
                # A paragraph of bold text is the title of a table, which must stay on the table's page.
                if [part.type for part in node.children[0].children if part.type != "text" or part.content] == [
                    "strong"
                ]:
                    return call("block", markup, sticky="true") + "\n\n"
                return markup + ("\n" if node.hidden else "\n\n")
            case "bullet_list":
                return call("list", *map(self._blocks, node.children)) + "\n\n"
            case "ordered_list":
                start = str(node.attrs.get("start", 1))
                return call("enum", *map(self._blocks, node.children), start=start) + "\n\n"
            case "fence" | "code_block":
                is_made = node.info.startswith(_MADE_FENCE)
                return self.made(node.info.removeprefix(_MADE_FENCE)) if is_made else block(node.content)
            case "table":
                return self._table(node)
        raise ValueError(f"{self.name}: the book cannot print an element of the type {node.type}")

    def _table(self, node: SyntaxTreeNode) -> str:
        rows = [row.children for part in node.children for row in part.children]
        columns = [[_plain(row[k]) for row in rows] for k in range(len(rows[0]))]
        longest = [max(len(word) for cell in column for word in re.split(r"[ \n]+", cell)) for column in columns]
        # A heading may be broken into lines; the width depends on the cells.
        widths = [max(word, *map(len, column[1:])) for word, column in zip(longest, columns, strict=True)]
        head, *body = [[self._inline(cell) for cell in row] for row in rows]
        right = [k for k, column in enumerate(columns) if column[1:] and all(map(_NUMBER.fullmatch, column[1:]))]
        # A name of a few words, or a few numbers, are not broken into one word a line.
        least = [max(word, min(width, _NAME)) for word, width in zip(longest, widths, strict=True)]
        return table(head, body, widths, least, right)

    def _inline(self, parent: SyntaxTreeNode) -> str:
        return "".join(self._span(node) for inline in parent.children for node in inline.children)

    def _span(self, node: SyntaxTreeNode) -> str:
        inner = "".join(map(self._span, node.children)) if node.type in ("em", "strong", "link") else ""
        match node.type:
            case "text":
                entries = (self._entry(name.lower()) for name in dict.fromkeys(self.names.findall(node.content)))
                return say(node.content) + "".join(entries)
            case "softbreak":
                return " "
            case "hardbreak":
                return "#linebreak()"
            case "code_inline":
                return code(node.content)
            case "em":
                return f"#emph[{inner}]"
            case "strong":
                return f"#strong[{inner}]"
            case "link":
                address = str(node.attrs["href"])
                if place := self._target(address):
                    return f"{self._entry(place)}#to(<{place}>)[{inner}]"
                return f"#link({string(address)})[{inner}]" if re.match(r"https?:", address) else inner
            case "image":
                file = self.picture(posixpath.normpath(posixpath.join(self._folder, str(node.attrs["src"]))))
                alt = string(node.content[:1].upper() + node.content[1:])
                # Typst moves the picture to the top or the bottom of a page.
                return f"#picture({string(file)}, {alt}, placement: auto)" if file else say(node.content)
        return ""

    def _entry(self, subject: str) -> str:
        """Return an index entry for a label or a name, or an empty string if the index does not have it."""
        return f"#idx({string(self.subjects[subject])});" if subject in self.subjects else ""

    @property
    def _folder(self) -> str:
        return posixpath.dirname(self.name)

    def _target(self, address: str) -> str:
        file, _, part = address.partition("#")
        if not file.endswith(".md") and not (part and not file):
            return ""
        page = posixpath.normpath(posixpath.join(self._folder, file)) if file else self.name
        page = _PAGE_OF.get(posixpath.basename(page), page)
        place = label(page, part) if part else label(page)
        return place if place in self.known else label(page) if label(page) in self.known else ""

    def _slug(self, title: str) -> str:
        """Return the anchor of a heading as MyST derives it; a repeated anchor gets a number."""
        slug = re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")
        times = self._slugs.get(slug, 0)
        self._slugs[slug] = times + 1
        return f"{slug}-{times}" if times else slug


def places(name: str, source: str) -> tuple[str, ...]:
    """Return the labels of a document and of its headings."""
    markup = Markdown(name, (), lambda file: "").typst(source)
    return (label(name), *re.findall(r" <([\w.-]+)>(?=\n|\])", markup))


def _plain(node: SyntaxTreeNode) -> str:
    return "".join(part.content for part in node.walk() if part.type in ("text", "code_inline"))
