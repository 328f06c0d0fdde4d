"""The faults and the open questions as data: numbered items of a Markdown file, with the decks and rows they name."""

from __future__ import annotations

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
    """An item: its number, its title, what follows it as Markdown, the heading it stands under, decks and rows.

    ``before`` is what stands between that heading and the item, where it is the first below it.
    """

    number: int
    title: str
    text: str
    under: str
    before: str
    decks: tuple[str, ...]
    rows: tuple[str, ...]


@cache
def numbered(file: str) -> tuple[str, tuple[Item, ...], tuple[str, str]]:
    """What stands before the items of a Markdown file of the project, without its title; the items; heading and text
    of what stands after them.

    An item begins a line with its number; its title is what is in bold there, or its first words up to a point.  Raises
    ValueError where the numbers are not 1, 2, 3 and so on.
    """
    source = (ROOT / file).read_text(encoding="utf-8").partition("\n")[2]
    heads, items, opening = "", [], source
    places = [match.start() for match in _PLAIN.finditer(source)]
    if places:
        opening = source[: places[0]]
    head = re.findall(r"^## (.+)$", opening, re.MULTILINE)
    opening = re.sub(r"^## .+\n?", "", opening, flags=re.MULTILINE)
    heads, closing, before = head[-1] if head else "", ("", ""), ""
    for at, end in zip(places, [*places[1:], len(source)], strict=True):
        text = source[at:end]
        text, _, later = text.partition("\n## ")
        if end == len(source) and later:
            closing = (later.partition("\n")[0], later.partition("\n")[2].strip())
        number, title, rest = _parted(text)
        decks, rows = tuple(dict.fromkeys(_DECK.findall(text))), tuple(dict.fromkeys(_ROW.findall(text)))
        items.append(Item(number, title, rest, heads, before, decks, rows))
        heads, before = (later.partition("\n")[0], later.partition("\n")[2].strip()) if later else (heads, "")
    if [item.number for item in items] != list(range(1, len(items) + 1)):
        raise ValueError(f"{file}: the items are not numbered one by one")
    return opening.strip(), tuple(items), closing


def _parted(text: str) -> tuple[int, str, str]:
    """Number, title and the rest of an item, whose lines are no longer set in."""
    found = _ITEM.match(text)
    body = re.sub(r"^ {3,4}", "", text, flags=re.MULTILINE)
    if found:
        title = " ".join(found[2].replace("`", "").split()).rstrip(".")
        rest = re.sub(r"^\d+\. \*\*.+?\*\*", "", body, count=1, flags=re.DOTALL).strip()
        return int(found[1]), title, rest.lstrip(".: ") if rest[:1] in ".:" else rest
    number, _, words = body.partition(". ")
    first = re.split(r"(?<=[a-z)])[.:;]\s|\n", words, maxsplit=1)[0]
    return int(number), " ".join(first.replace("*", "").replace("`", "").split()), words.strip()
