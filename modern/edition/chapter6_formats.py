"""The columns a FORMAT statement gives, record by record.

Only what the listings of chapter 5 use: ``nX``, ``nH``, ``/``, ``rIw`` and ``rEw.d``.  A Hollerith field is
cut out by its count before any blank is dropped.  Source of the slash rule: n slashes at either end give n
blank cards, n+1 between two fields give n; unused numeric groups at the end are dropped, a literal before
them is punched (thesis, chapters 5 and 6).
"""

from __future__ import annotations

import re
from dataclasses import dataclass

_ITEM = re.compile(r"(\d*)(?:(E)(\d+)\.\d+|(I)(\d+))")
_BLANKS = re.compile(r"(\d+)X")
_HOLLERITH = re.compile(r"(\d+)H")


class FormatTextError(ValueError):
    """A FORMAT text this reader does not know; the message names the place."""


@dataclass(frozen=True, slots=True)
class FormatField:
    """Columns ``first`` to ``last`` (from 1) of a card; ``words`` is the literal text, empty for a number."""

    first: int
    last: int
    words: str = ""


def records(text: str, values: int) -> tuple[tuple[FormatField, ...], ...]:
    """The cards a list of ``values`` numbers gives under FORMAT ``text`` (with its parentheses), in one scan.

    A record without fields is a blank card.  Literal text is given word by word.  Raises FormatTextError for
    an unknown item, and when ``values`` numbers do not fit one scan of the FORMAT.
    """
    if not (text.startswith("(") and text.endswith(")")):
        raise FormatTextError(f"FORMAT {text}: no parentheses around it")
    body = text[1:-1]
    cards: list[list[FormatField]] = [[]]
    at, column, left = 0, 1, values
    while at < len(body):
        if body[at] in ", ":
            at += 1
            continue
        if body[at] == "/":
            cards.append([])
            at, column = at + 1, 1
            continue
        if found := _BLANKS.match(body, at):
            at, column = found.end(), column + int(found[1])
            continue
        if found := _HOLLERITH.match(body, at):
            words = body[found.end() : found.end() + int(found[1])]
            if len(words) != int(found[1]):
                raise FormatTextError(f"FORMAT {text}: {found[0]} has {len(words)} characters")
            for word in re.finditer(r"\S+", words):
                cards[-1].append(FormatField(column + word.start(), column + word.end() - 1, word[0]))
            at, column = found.end() + len(words), column + len(words)
            continue
        found = _ITEM.match(body, at)
        if not found:
            raise FormatTextError(f"FORMAT {text}: cannot read {body[at : at + 8]!r}")
        width = int(found[3] or found[5])
        for _ in range(int(found[1] or 1)):
            if left == 0:
                return tuple(tuple(card) for card in cards)
            cards[-1].append(FormatField(column, column + width - 1))
            column, left = column + width, left - 1
        at = found.end()
    if left:
        raise FormatTextError(f"FORMAT {text}: {left} of {values} numbers are left over")
    return tuple(tuple(card) for card in cards)
