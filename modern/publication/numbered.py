"""Read the numbered items of a Markdown file, which are the known faults or the open questions."""

import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[2]
_ITEM = re.compile(r"^(\d+)\. \*\*(.+?)\*\*", re.MULTILINE | re.DOTALL)
_PLAIN = re.compile(r"^(\d+)\. (?=\S)", re.MULTILINE)
_DECK = re.compile(r"`grounds/(\w+)`")
_ROW = re.compile(r"\b(?:P[123]|C[46]|AW|NN|KS)-\d+\b")


@dataclass(frozen=True, slots=True)
class Item:
    """A numbered item of a Markdown file.

    ``text`` is the Markdown after the title.  ``section`` is the heading above the item, and ``preamble`` the text
    between that heading and the item if the item is the first of its section.  ``decks`` and ``rows`` are the ground
    decks and the rows of the apparatus that the item names.
    """

    number: int
    title: str
    text: str
    section: str
    preamble: str
    decks: tuple[str, ...]
    rows: tuple[str, ...]


@cache
def numbered(file: str) -> tuple[str, tuple[Item, ...], tuple[str, str]]:
    """Return the text before the items of a Markdown file, the items, and the heading and text of the section after
    them.

    An item begins with its number at the start of a line. Its title is the bold text after the number, or else its
    first sentence. Raise ValueError if the numbers are not 1, 2, 3 and so on.
    """
    source = (ROOT / file).read_text(encoding="utf-8").partition("\n")[2]
    items, opening = [], source
    starts = [match.start() for match in _PLAIN.finditer(source)]
    if starts:
        opening = source[: starts[0]]
    headings = re.findall(r"^## (.+)$", opening, re.MULTILINE)
    opening = re.sub(r"^## .+\n?", "", opening, flags=re.MULTILINE)
    section, closing, preamble = headings[-1] if headings else "", ("", ""), ""
    for start, end in zip(starts, [*starts[1:], len(source)], strict=True):
        # A heading after an item begins the next section, or, after the last item, the closing section.
        text, _, following = source[start:end].partition("\n## ")
        next_heading, _, next_text = following.partition("\n")
        if end == len(source) and following:
            closing = (next_heading, next_text.strip())
        number, title, rest = _split_item(text)
        decks, rows = tuple(dict.fromkeys(_DECK.findall(text))), tuple(dict.fromkeys(_ROW.findall(text)))
        items.append(Item(number, title, rest, section, preamble, decks, rows))
        section, preamble = (next_heading, next_text.strip()) if following else (section, "")
    if [item.number for item in items] != list(range(1, len(items) + 1)):
        raise ValueError(f"{file}: the items are not numbered 1, 2, 3 and so on")
    return opening.strip(), tuple(items), closing


def _split_item(text: str) -> tuple[int, str, str]:
    """Return the number, the title and the rest of an item without the indentation of its lines."""
    bold = _ITEM.match(text)
    body = re.sub(r"^ {3,4}", "", text, flags=re.MULTILINE)
    if bold:
        title = " ".join(bold[2].replace("`", "").split()).rstrip(".")
        rest = re.sub(r"^\d+\. \*\*.+?\*\*", "", body, count=1, flags=re.DOTALL).strip()
        return int(bold[1]), title, rest.lstrip(".: ") if rest[:1] in ".:" else rest
    number, _, content = body.partition(". ")
    first = re.split(r"(?<=[a-z)])[.:;]\s|\n", content, maxsplit=1)[0]
    return int(number), " ".join(first.replace("*", "").replace("`", "").split()), content.strip()
