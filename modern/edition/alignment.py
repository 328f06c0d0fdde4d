"""Compare short texts character by character: their edit distance, and their best alignment.

References
----------
G. Myers, A fast bit-vector algorithm for approximate string matching based on dynamic programming, J. ACM 46 (1999)
395-415.
"""

from collections.abc import Mapping, Sequence
from functools import cache

from modern.edition.readings import table

# The costs of a character that the other text lacks, of a pair of the table of confusables, and of any other pair.
MISSING, CONFUSABLE, OTHER = 0.9, 0.5, 1.2


def distance(a: str, b: str) -> int:
    """Return the edit distance of two texts.

    The algorithm of Myers (1999) stores a column of the table of distances in two integers.
    """
    if not a or not b:
        return len(a) + len(b)
    masks: dict[str, int] = {}
    for n, char in enumerate(a):
        masks[char] = masks.get(char, 0) | 1 << n
    every, last = (1 << len(a)) - 1, 1 << (len(a) - 1)
    up, down, score = every, 0, len(a)
    for char in b:
        equal = masks.get(char, 0)
        vertical = equal | down
        horizontal = (((equal & up) + up) ^ up) | equal
        rises, falls = (down | ~(horizontal | up)) & every, up & horizontal
        score += bool(rises & last) - bool(falls & last)
        rises, falls = (rises << 1 | 1) & every, falls << 1 & every
        up, down = (falls | ~(vertical | rises)) & every, rises & vertical
    return score


@cache
def _representatives() -> Mapping[int, str]:
    """Map each confusable character to one character that represents all characters it may be confused with."""
    group: dict[str, str] = {}
    for pair in table():
        if pair.cls == "confusable" and len(pair.witness) == len(pair.lemma) == 1:
            a, b = group.get(pair.witness, pair.witness), group.get(pair.lemma, pair.lemma)
            group.update({a: a, b: b})
            group.update({char: b for char, first in group.items() if first == a})
    return {ord(char): first for char, first in group.items()}


@cache
def folded(text: str) -> str:
    """Return a text in which each character is replaced by the representative of all characters confused with it."""
    return text.translate(_representatives())


@cache
def _pair_costs() -> Mapping[tuple[str, str], float]:
    """Return the cost of aligning a character of a card with a confusable character of a line, for all such pairs."""
    return {
        (p.lemma, p.witness): CONFUSABLE
        for p in table()
        if p.cls in ("confusable", "noise") and len(p.witness) == len(p.lemma) == 1
    }


def align_characters(card: str, line: str) -> list[tuple[int, int]]:
    """Return the cheapest alignment of a card's text with the text of a line, as pairs of indices.

    A pair has the index of a character of the card and that of the aligned character of the line.  If the card or the
    line lacks the character, its index is -1.
    """
    if card == line:
        return [(n, n) for n in range(len(card))]
    costs, size = _pair_costs(), len(line)
    # Each row holds the costs of the alignments of a suffix of the card with every suffix of the line.
    rows = [[MISSING * (size - j) for j in range(size + 1)]]
    for char in reversed(card):
        below = rows[-1]
        row = [below[size] + MISSING] * (size + 1)
        for j in range(size - 1, -1, -1):
            sound = line[j]
            match = below[j + 1] + (0.0 if char == sound else costs.get((char, sound), OTHER))
            row[j] = min(match, below[j] + MISSING, row[j + 1] + MISSING)
        rows.append(row)
    rows.reverse()
    steps, i, j = [], 0, 0
    while i < len(card) or j < size:
        if i < len(card) and j < size:
            cost = 0.0 if card[i] == line[j] else costs.get((card[i], line[j]), OTHER)
            if rows[i][j] == rows[i + 1][j + 1] + cost:
                steps.append((i, j))
                i, j = i + 1, j + 1
                continue
        if i < len(card) and rows[i][j] == rows[i + 1][j] + MISSING:
            steps.append((i, -1))
            i += 1
        else:
            steps.append((-1, j))
            j += 1
    return steps


def divide(line: str, cards: Sequence[str]) -> list[str]:
    """Divide the text of a line into one piece for each of several consecutive cards.

    A character that aligns with no card belongs to the same card as the character before it.
    """
    if len(cards) == 1:
        return [line]
    owner = [n for n, card in enumerate(cards) for _ in card]
    pieces, at = [""] * len(cards), 0
    for i, j in align_characters("".join(cards), line):
        at = owner[i] if i >= 0 else at
        if j >= 0:
            pieces[at] += line[j]
    return pieces
