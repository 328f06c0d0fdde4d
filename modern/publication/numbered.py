"""Read the numbered items of a Markdown file, which are the known faults or the open questions."""

import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[2]
_BOLD_TITLE = re.compile(r"(\d+)\. \*\*(.+?)\*\*", re.DOTALL)
_DECK = re.compile(r"`grounds/(\w+)`")
_ROW = re.compile(r"\b(?:P[123]|C[46]|AW|NN|KS)-\d+\b")


@dataclass(frozen=True, slots=True)
class Item:
    """A numbered item of a Markdown file.

    ``text`` is the Markdown after the title.  ``section`` is the heading above the item, and ``preamble`` is the text
    between that heading and the item if the item is the first of its section.  ``decks`` are the decks that the item
    names because they show a fault, and ``rows`` are the rows of the apparatus that the item names.
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
    opening, *texts = re.split(r"^(?=\d+\. \S)", source, flags=re.MULTILINE)
    section, preamble, following, items = "", "", "", []
    for heading in re.findall(r"^## (.+)$", opening, re.MULTILINE):
        section = heading
    opening = re.sub(r"^## .+\n?", "", opening, flags=re.MULTILINE)
    for text in texts:
        # A heading after an item begins the next section, or, after the last item, the closing section.
        text, _, following = text.partition("\n## ")
        decks, rows = tuple(dict.fromkeys(_DECK.findall(text))), tuple(dict.fromkeys(_ROW.findall(text)))
        items.append(Item(*_split_item(text), section, preamble, decks, rows))
        next_section, _, next_preamble = following.partition("\n")
        section, preamble = (next_section, next_preamble.strip()) if following else (section, "")
    if [item.number for item in items] != list(range(1, len(items) + 1)):
        raise ValueError(f"{file}: the items are not numbered 1, 2, 3 and so on")
    return opening.strip(), tuple(items), (section, preamble) if following else ("", "")


def _split_item(text: str) -> tuple[int, str, str]:
    """Return the number and the title of an item, and the text after the title without the indentation of its lines."""
    body = re.sub(r"^ {3,4}", "", text, flags=re.MULTILINE)
    if bold := _BOLD_TITLE.match(body):
        title = " ".join(bold[2].replace("`", "").split()).rstrip(".")
        rest = body[bold.end() :].strip()
        return int(bold[1]), title, rest.lstrip(".: ") if rest[:1] in ".:" else rest
    number, _, content = body.partition(". ")
    first = re.split(r"(?<=[a-z)])[.:;]\s|\n", content, maxsplit=1)[0]
    return int(number), " ".join(first.replace("*", "").replace("`", "").split()), content.strip()
