"""Rules for the readings of the layer ``ocr``: each kind of row may change the witness only in certain ways.

The lemma of a row is made from the witness by *steps*.  Each step replaces characters of the OCR text by the correct
characters, for example ``l`` by ``1``.  The pairs of characters that may be replaced are listed in
``fortran_src/apparatus/confusables.toml``.  :func:`steps` finds the steps of a row.  The kinds of rows, and the changes
that a row of each kind may make:

``displaced``   puts the words of the witness into another order
``fused``, ``spacing``, ``columns``  change only blanks and line ends
``noise``       uses pairs of the class ``noise``, or deletes a line
``misread``     uses pairs of any class except ``comment``
``dropped-zero``  inserts a zero into a run of zeros
``lost-sign``   inserts signs, points and zeros
``comment``     inserts the C of a comment card before its words
``lost``        inserts words, or characters of words
``doubled``     deletes words that belong to a neighbouring cell of a table
``overlaid``    may make any change: the heading of another table has replaced the words
``page``        may make any change: someone who read the page has reported the card
                (:mod:`modern.edition.page_readings`)
``omission``, ``conjecture`` and the kinds of cards added by the project may make any change

Each pair in the table must be used by at least two rows, or its entry must name other evidence.
"""

import tomllib
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from importlib.resources import files
from typing import Literal

from modern.edition.apparatus import Row

Class = Literal["confusable", "noise", "zero", "sign", "comment"]
CLASSES: Mapping[str, frozenset[Class]] = {
    "noise": frozenset({"noise", "zero"}),
    "misread": frozenset({"confusable", "noise", "zero", "sign"}),
    "dropped-zero": frozenset({"zero"}),
    "lost-sign": frozenset({"sign", "zero"}),
    "comment": frozenset({"comment"}),
}
KEEPS = ("fused", "spacing", "columns")
# The kinds that have a rule.
RULED = (*CLASSES, *KEEPS, "displaced", "lost", "doubled", "overlaid", "page")


@dataclass(frozen=True, slots=True)
class Pair:
    """Characters of the witness that may be replaced by the characters ``lemma``.

    ``known`` is evidence for the pair other than rows that use it.
    """

    witness: str
    lemma: str
    cls: Class
    known: str = ""


@dataclass(frozen=True, slots=True)
class Step:
    """A replacement of characters in one change of a row; the change is given by its index in the row.

    The replaced characters are at index ``at`` of the witness without blanks, and the new characters at index ``to`` of
    the lemma without blanks.
    """

    change: int
    at: int
    pair: Pair
    to: int = 0


@cache
def table() -> tuple[Pair, ...]:
    """Return the pairs of the table of confusables, those with most characters first."""
    text = files("fortran_src").joinpath("apparatus", "confusables.toml").read_text(encoding="utf-8")
    pairs = [Pair(p["witness"], p["lemma"], p["class"], p.get("known", "")) for p in tomllib.loads(text)["pair"]]
    return tuple(sorted(pairs, key=lambda pair: (-len(pair.witness) - len(pair.lemma), pair.witness, pair.lemma)))


def solid(text: str) -> str:
    """Return a text without its blanks."""
    return "".join(text.split())


def steps(row: Row) -> tuple[Step, ...] | None:
    """Return the fewest steps that make the lemmas of a row from its witness, or None if the pairs cannot make them."""
    classes = CLASSES.get(row.kind, frozenset())
    pairs = tuple(pair for pair in table() if pair.cls in classes)
    row_steps: list[Step] = []
    for number, change in enumerate(row.changes):
        if change.after or change.through or change.dense or (row.kind == "noise" and not change.lemma):
            continue
        way = _way(solid(change.witness), solid(change.lemma), pairs)
        if way is None:
            return None
        row_steps += [Step(number, at, pair, to) for at, to, pair in way]
    return tuple(row_steps)


@lru_cache(65536)
def explains(witness: str, lemma: str, pairs: tuple[Pair, ...]) -> bool:
    """Return True if the OCR can have made the witness from the lemma by confusing these pairs of characters."""
    return abs(len(witness) - len(lemma)) < 12 and _way(witness, lemma, pairs) is not None


def _way(witness: str, lemma: str, pairs: tuple[Pair, ...]) -> list[tuple[int, int, Pair]] | None:
    """Return the fewest pairs that turn the witness into the lemma, each with its indices in both texts.

    The algorithm is the dynamic programme of an edit distance.  A cell has an index in the witness and an index in the
    lemma.  A cell stores the cell from which it was reached, so that the pairs can be traced back from the end.
    """
    best: dict[tuple[int, int], tuple[int, tuple[int, int] | None, Pair | None]] = {(0, 0): (0, None, None)}
    for i in range(len(witness) + 1):
        for j in range(len(lemma) + 1):
            if (i, j) not in best:
                continue
            cost = best[i, j][0]
            if i < len(witness) and j < len(lemma) and witness[i] == lemma[j]:
                _better(best, (i + 1, j + 1), cost, (i, j), None)
            for pair in pairs:
                if witness.startswith(pair.witness, i) and lemma.startswith(pair.lemma, j):
                    # A dropped zero must have another zero next to it: the OCR shortens runs of zeros.
                    if pair.cls == "zero" and "0" not in (lemma[j - 1 : j], lemma[j + 1 : j + 2]):
                        continue
                    if pair.cls == "comment" and j > 0:
                        continue
                    _better(best, (i + len(pair.witness), j + len(pair.lemma)), cost + 1, (i, j), pair)
    end = (len(witness), len(lemma))
    if end not in best:
        return None
    backwards: list[tuple[int, int, Pair]] = []
    at: tuple[int, int] | None = end
    while at is not None:
        _, before, used = best[at]
        if used is not None and before is not None:
            backwards.append((*before, used))
        at = before
    return backwards[::-1]


def _better(
    best: dict[tuple[int, int], tuple[int, tuple[int, int] | None, Pair | None]],
    to: tuple[int, int],
    cost: int,
    origin: tuple[int, int],
    pair: Pair | None,
) -> None:
    if to not in best or cost < best[to][0]:
        best[to] = (cost, origin, pair)


def without_step(row: Row, step: Step) -> Row:
    """Return the row with one of its steps undone: its lemma has the characters of the witness at this place."""
    change = row.changes[step.change]
    lemma = _blanked(change.lemma, step.to, len(step.pair.lemma), step.pair.witness)
    changes = tuple(replace(c, lemma=lemma) if n == step.change else c for n, c in enumerate(row.changes))
    return replace(row, changes=changes)


def _blanked(text: str, at: int, length: int, instead: str) -> str:
    """Replace ``length`` nonblank characters of a text by ``instead``, beginning with the nonblank character ``at``."""
    positions = [n for n, char in enumerate(text) if not char.isspace()]
    first = positions[at] if at < len(positions) else len(text)
    last = positions[at + length - 1] + 1 if length else first
    return text[:first] + instead + text[last:]


def attested(rows: Iterable[Row]) -> Counter[tuple[str, str]]:
    """Return the number of places in which rows of the layer ``ocr`` use each pair (witness, lemma) of characters."""
    uses: Counter[tuple[str, str]] = Counter()
    for row in rows:
        if row.layer == "ocr" and row.kind in CLASSES:
            uses.update((step.pair.witness, step.pair.lemma) for step in steps(row) or ())
    return uses


def reading_faults(row: Row, places: Mapping[tuple[str, str], int]) -> Iterator[str]:
    """Yield a message for each change that the kind of a row forbids.  ``places`` is the result of :func:`attested`."""
    if row.layer != "ocr":
        return
    if row.kind not in RULED:
        yield f"unknown kind {row.kind!r} for the layer ocr"
    elif row.kind in KEEPS:
        if any(solid(c.witness) != solid(c.lemma) for c in row.changes if c.witness or c.after):
            yield f"a row of kind {row.kind} must not change a character that is not blank"
    elif row.kind == "displaced":
        marks = {pair.witness for pair in table() if pair.cls == "noise"}
        witness_words = [word for c in row.changes for word in c.witness.split() if word not in marks]
        lemma_words = [word for c in row.changes for word in c.lemma.split() if word not in marks]
        if sorted(witness_words) != sorted(lemma_words):
            yield "a row of kind displaced must keep the words of the witness and change only their order"
    elif row.kind == "lost":
        if not all(_within(solid(c.witness), solid(c.lemma)) for c in row.changes):
            yield "a row of kind lost must keep every character of the witness in its order"
    elif row.kind == "doubled":
        if not all(_within(c.lemma.split(), c.witness.split()) for c in row.changes):
            yield "a row of kind doubled must only delete words"
    elif row.kind in CLASSES:
        made = steps(row)
        if made is None:
            yield f"the pairs that the table of confusables allows for {row.kind} do not make the lemma"
        for step in made or ():
            pair = step.pair
            if places[pair.witness, pair.lemma] < 2 and not pair.known:
                yield f"no other row reads {pair.witness!r} as {pair.lemma!r}, and the table names no other evidence"


def _within(subsequence: Iterable[str], sequence: Iterable[str]) -> bool:
    rest = iter(sequence)
    return all(element in rest for element in subsequence)
