"""Show two texts side by side, line by line, and mark every character that differs.

``hull1620 reproduce --show`` uses this module to compare each printed result with the computed one.
"""

import textwrap
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher
from typing import Literal

# "=": the two lines are equal; "~": each line occurs in the other text at another position; "|": the lines differ.
Mark = Literal["=", "~", "|"]
# For each of two lines, a line of carets and blanks; a caret stands below each character that differs.
Masks = tuple[str, str]
Paint = Callable[[str], str]
_LEGEND: dict[Mark, str] = {"=": "equal", "~": "at another position", "|": "different, marked by ^"}
# The smallest number of columns to which a line is broken, even if the terminal is narrower.
_NARROWEST = 24


@dataclass(frozen=True, slots=True)
class _Pair:
    """The lines of both texts at the same position, and the carets that mark their differences."""

    mark: Mark
    lines: tuple[str, str]
    masks: Masks = ("", "")


def masks_by_column(first: str, second: str) -> Masks:
    """Compare two cards column by column, and return the carets that mark their differences."""
    width = max(len(first), len(second))
    differ = [a != b for a, b in zip(first.ljust(width), second.ljust(width), strict=True)]
    mask = "".join("^" if differs else " " for differs in differ).rstrip()
    return mask, mask


def masks_by_text(first: str, second: str) -> Masks:
    """Compare two printed lines without regard to spacing, and return the carets that mark their differences."""
    masks = [["^" if c.strip() else " " for c in line] for line in (first, second)]
    for block in SequenceMatcher(None, first, second, autojunk=False).get_matching_blocks():
        for mask, start in zip(masks, (block.a, block.b), strict=True):
            mask[start : start + block.size] = " " * block.size
    mask_1, mask_2 = ("".join(mask).rstrip() for mask in masks)
    return mask_1, mask_2


def side_by_side(
    first: Sequence[str],
    second: Sequence[str],
    width: int,
    *,
    heads: tuple[str, str] = ("print", "result"),
    columns: bool = True,
    indent: int = 6,
    paint: Paint = str,
) -> Iterator[str]:
    """Yield two texts in two columns, or with the lines of each pair below one another if ``width`` is too small.

    heads: the headings of the two texts.  columns: True to compare column by column, including blanks, False to ignore
    the spacing.  paint: a function that colours a line of carets.  Lines that are too long for ``width`` are broken.
    """
    pairs = list(_pairs(first, second, columns))
    if not pairs:
        return
    longest = [max(max(len(pair.lines[k]), len(pair.masks[k])) for pair in pairs) for k in (0, 1)]
    lead = " " * indent
    left_width = max(longest[0], len(heads[0]))
    marks = [mark for mark in _LEGEND if any(pair.mark == mark for pair in pairs)]
    legend = "; ".join(f"{mark} {_LEGEND[mark]}" for mark in marks)
    yield from textwrap.wrap(legend, max(_NARROWEST, width), initial_indent=lead, subsequent_indent=lead)
    if left_width + 3 + max(longest[1], len(heads[1])) <= width - indent - 6:
        yield f"{lead}{'':>4}  {heads[0]:<{left_width}}   {heads[1]}".rstrip()
        for number, pair in enumerate(pairs, 1):
            yield f"{lead}{number:>4}  {pair.lines[0]:<{left_width}} {pair.mark} {pair.lines[1]}".rstrip()
            if any(pair.masks):
                yield paint(f"{lead}{'':>4}  {pair.masks[0]:<{left_width}}   {pair.masks[1]}".rstrip())
        return
    for number, pair in enumerate(pairs, 1):
        yield from _one_below_the_other(number, pair, heads, width, lead[:2], paint)


def _one_below_the_other(
    number: int, pair: _Pair, heads: tuple[str, str], width: int, lead: str, paint: Paint
) -> Iterator[str]:
    """Yield the two lines of a pair, broken into pieces that fit the width; equal lines are shown once."""
    name_width = max(map(len, heads))
    piece = max(_NARROWEST, width - len(lead) - 8 - name_width)
    # Equal masks of cards are shown once, below the second line.
    first_mask = "" if pair.masks[0] == pair.masks[1] else pair.masks[0]
    lines = [(heads[0], pair.lines[0], first_mask), (heads[1], pair.lines[1], pair.masks[1])]
    if pair.mark == "=":
        lines = [("", pair.lines[0], "")]
    head = f"{number:>4} {pair.mark}"
    for title, line, mask in lines:
        for start in range(0, max(len(line), len(mask), 1), piece):
            name = title if start == 0 else ""
            yield f"{lead}{head:<7}{name:<{name_width}} {line[start : start + piece]}".rstrip()
            head = ""
            if mask[start : start + piece].strip():
                yield paint(f"{lead}{'':<7}{'':<{name_width}} {mask[start : start + piece]}".rstrip())


def _pairs(first: Sequence[str], second: Sequence[str], columns: bool) -> Iterator[_Pair]:
    texts = [[line.expandtabs(2).rstrip() for line in text] for text in (first, second)]
    counts = [Counter(_key(line, columns) for line in text) for text in texts]
    for index in range(max(map(len, texts))):
        present = [text[index] if index < len(text) else None for text in texts]
        keys = [None if line is None else _key(line, columns) for line in present]
        lines = (present[0] or "", present[1] or "")
        if keys[0] == keys[1]:
            yield _Pair("=", lines)
        elif all(key is None or counts[0][key] == counts[1][key] for key in keys):
            yield _Pair("~", lines)
        else:
            yield _Pair("|", lines, (masks_by_column if columns else masks_by_text)(*lines))


def _key(line: str, columns: bool) -> str:
    return line if columns else " ".join(line.split())
