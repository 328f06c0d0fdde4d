"""Find the smallest edits of words and blanks, and the moves of words, that turn a witness reading into the lemma.

:mod:`modern.edition.segments` turns each edit into a place of the text.  All indices refer to the text before the
edits.
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher

from modern.edition.apparatus import Change


@dataclass(frozen=True, slots=True)
class Edit:
    """A replacement of the characters ``first`` to ``last`` (exclusive) of a text by ``new``.

    ``moved`` is 0, or the number of a moved piece.  The edit that removes the piece and the edit that inserts the piece
    have the same number.
    """

    first: int
    last: int
    new: str
    moved: int = 0


def common_prefix(a: str, b: str) -> int:
    """Return the length of the longest common beginning of two texts."""
    return next((n for n, (x, y) in enumerate(zip(a, b, strict=False)) if x != y), min(len(a), len(b)))


def blank_edits(old: str, new: str) -> Iterator[Edit]:
    """Yield the edits between two texts that differ only in blanks.  Raise ValueError if they do not."""
    at = 0
    for before, after in zip(re.split(r"\S", old), re.split(r"\S", new), strict=True):
        if before != after:
            common = common_prefix(before, after)
            yield Edit(at + common, at + len(before), after[common:])
        at += len(before) + 1


def word_edits(old: str, new: str) -> Iterator[Edit]:
    """Yield the edits after which a text has the words of ``new``.  The blanks between the words may still differ."""
    for edit, _ in _word_edits(old, new):
        yield edit


def _word_edits(old: str, new: str) -> Iterator[tuple[Edit, tuple[range, Sequence[str]]]]:
    """Yield each edit with the indices of the words that it removes, and with the words that it inserts."""
    before, after = ([*re.finditer(r"\S+", text)] for text in (old, new))
    matcher = SequenceMatcher(None, [word[0] for word in before], [word[0] for word in after], autojunk=False)
    for kind, a, b, c, d in matcher.get_opcodes():
        if kind != "equal":
            first = before[a].start() if a < b else before[a - 1].end() if a else 0
            text = new[after[c].start() : after[d - 1].end()] if c < d else ""
            yield Edit(first, before[b - 1].end() if a < b else first, text), (range(a, b), text.split())


def moving_edits(changes: Sequence[Change]) -> list[list[Edit]]:
    """Return the edits of each change of a row that moves words from one place to another.

    Consecutive words that are moved together are one piece.  A row may also insert words that it did not remove
    elsewhere, and remove words that it inserts nowhere.
    """
    tokens = [[*re.finditer(r"\S+", change.witness)] for change in changes]
    edits: list[list[Edit]] = [[] for _ in changes]
    removed: list[tuple[int, int]] = []  # the numbers of a change and of a word in its witness
    inserted: list[tuple[int, int, list[str]]] = []  # the number of a change, the place in its witness, words
    for number, change in enumerate(changes):
        for edit, (taken, added) in _word_edits(change.witness, change.lemma):
            removed += [(number, word) for word in taken]
            # The words appear after the word that stays before them.
            place = tokens[number][taken.start - 1].end() if taken and taken.start else 0 if taken else edit.first
            inserted.append((number, place, list(added)))
    moved = 0
    for target, place, added in inserted:
        while added:
            origin, length = _longest_run(removed, tokens, added)
            if not length:
                edits[target].append(Edit(place, place, added.pop(0)))
                continue
            moved += 1
            number, word = removed[origin]
            first, last = tokens[number][word].start(), tokens[number][word + length - 1].end()
            edits[number].append(Edit(first, last, "", moved))
            edits[target].append(Edit(place, place, changes[number].witness[first:last], moved))
            del removed[origin : origin + length], added[:length]
    for number, word in removed:
        edits[number].append(Edit(*tokens[number][word].span(), ""))
    return edits


def _longest_run(
    removed: Sequence[tuple[int, int]], tokens: Sequence[Sequence[re.Match[str]]], added: Sequence[str]
) -> tuple[int, int]:
    """Return index and length of the longest run of neighbouring words in ``removed`` with which ``added`` begins."""
    best = (0, 0)
    for origin, (number, word) in enumerate(removed):
        length = 0
        while (
            length < len(added)
            and removed[origin + length : origin + length + 1] == [(number, word + length)]
            and tokens[number][word + length][0] == added[length]
        ):
            length += 1
        best = max(best, (origin, length), key=lambda run: run[1])
    return best
