"""Two texts side by side, line by line, with every character that differs marked: print and result of ``reproduce``."""

from __future__ import annotations

import textwrap
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from difflib import SequenceMatcher
from typing import Literal

Mark = Literal["=", "~", "|"]
"""The same; at another place in the other text; different."""
Masks = tuple[str, str]
"""Below each of two lines: ``^`` under a character that the other line has not there, a blank under any other."""
Row = tuple[Mark, str, str, Masks]
Paint = Callable[[str], str]
_WORDS: dict[Mark, str] = {"=": "the same", "~": "stands at another place", "|": "different, ^ where"}
_LEAST = 24
"""Columns of a text below which lines stand one below the other."""


def by_column(one: str, other: str) -> Masks:
    """Masks of two cards, whose columns count."""
    width = max(len(one), len(other))
    differ = [a != b for a, b in zip(one.ljust(width), other.ljust(width), strict=True)]
    mask = "".join("^" if marked else " " for marked in differ).rstrip()
    return mask, mask


def by_words(one: str, other: str) -> Masks:
    """Masks of two lines of print, whose spacing is no evidence."""
    masks = [["^" if c.strip() else " " for c in line] for line in (one, other)]
    for block in SequenceMatcher(None, one, other, autojunk=False).get_matching_blocks():
        for mask, start in zip(masks, (block.a, block.b), strict=True):
            mask[start : start + block.size] = " " * block.size
    first, second = ("".join(mask).rstrip() for mask in masks)
    return first, second


def beside(
    first: Sequence[str],
    second: Sequence[str],
    width: int,
    *,
    heads: tuple[str, str] = ("print", "result"),
    columns: bool = True,
    indent: int = 6,
    paint: Paint = str,
) -> Iterator[str]:
    """Two texts: in two columns where the terminal has room for both, else each pair one below the other.

    columns: characters are compared column by column, and blanks count; otherwise word by word.  paint: what the lines
    of marks are coloured with.  Lines longer than the terminal is wide go on below.
    """
    rows = list(_rows(first, second, columns))
    if not rows:
        return
    longest = [max(max(len(row[k + 1]), len(row[3][k])) for row in rows) for k in (0, 1)]
    lead = " " * indent
    left = max(longest[0], len(heads[0]))
    used = [mark for mark in _WORDS if any(row[0] == mark for row in rows)]
    words = "; ".join(f"{mark} {_WORDS[mark]}" for mark in used)
    yield from textwrap.wrap(words, max(_LEAST, width), initial_indent=lead, subsequent_indent=lead)
    if left + 3 + max(longest[1], len(heads[1])) <= width - indent - 6:
        yield f"{lead}{'':>4}  {heads[0]:<{left}}   {heads[1]}".rstrip()
        for number, (mark, one, other, masks) in enumerate(rows, 1):
            yield f"{lead}{number:>4}  {one:<{left}} {mark} {other}".rstrip()
            if any(masks):
                yield paint(f"{lead}{'':>4}  {masks[0]:<{left}}   {masks[1]}".rstrip())
        return
    for number, row in enumerate(rows, 1):
        yield from _below(number, row, heads, width, lead[:2], paint)


def _below(number: int, row: Row, heads: tuple[str, str], width: int, lead: str, paint: Paint) -> Iterator[str]:
    """A pair of lines one below the other; lines that are the same once."""
    mark, one, other, masks = row
    name = max(map(len, heads))
    piece = max(_LEAST, width - len(lead) - 8 - name)
    first = "" if masks[0] == masks[1] else masks[0]
    lines = [("", one, "")] if mark == "=" else [(heads[0], one, first), (heads[1], other, masks[1])]
    head = f"{number:>4} {mark}"
    for title, line, mask in lines:
        for at in range(0, max(len(line), len(mask), 1), piece):
            yield f"{lead}{head:<7}{title if at == 0 else '':<{name}} {line[at : at + piece]}".rstrip()
            head = ""
            if mask[at : at + piece].strip():
                yield paint(f"{lead}{'':<7}{'':<{name}} {mask[at : at + piece]}".rstrip())


def _rows(first: Sequence[str], second: Sequence[str], columns: bool) -> Iterator[Row]:
    """Pairs of lines in their order, what a pair is, and the masks of one that differs."""
    texts = [[line.expandtabs(2).rstrip() for line in text] for text in (first, second)]
    known = [Counter(_compared(line, columns) for line in text) for text in texts]
    for at in range(max(map(len, texts))):
        pair = [text[at] if at < len(text) else None for text in texts]
        keys = [None if line is None else _compared(line, columns) for line in pair]
        one, other = (line or "" for line in pair)
        if keys[0] == keys[1]:
            yield "=", one, other, ("", "")
        elif all(key is None or known[0][key] == known[1][key] for key in keys):
            yield "~", one, other, ("", "")
        else:
            yield "|", one, other, (by_column if columns else by_words)(one, other)


def _compared(line: str, columns: bool) -> str:
    return line if columns else " ".join(line.split())
