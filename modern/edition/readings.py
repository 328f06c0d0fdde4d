"""What a row may change: each kind of row has a rule, and characters are exchanged by a table alone.

A row's lemma is made from its witness by steps, each a pair of what the OCR gives and what is read: ``l`` and ``1``.
:func:`steps` finds them, or finds that there is no way.  The kinds:

``displaced``   the words of the witness in another order
``fused``, ``spacing``, ``columns``  the characters of the witness, blanks and line ends apart
``noise``       pairs of the table's ``noise``, or a line that goes
``misread``     pairs of the table, of any class
``dropped-zero``  a zero of a run of zeros
``lost-sign``   signs, points and zeros put in
``comment``     the C of a comment card put before its words
``lost``        words put in among those of the witness, or characters of them
``doubled``     words of the witness: the others are of its neighbours
``overlaid``    no rule: a heading of another table stands where words were
``omission``, ``conjecture`` and the other kinds of cards that are ours: no rule; their grounds alone vouch for them

The table, ``fortran_src/apparatus/confusables.toml``, says of each pair its class.  That a pair occurs elsewhere too is
counted from the rows; one that does not says by what else it is known.
"""

from __future__ import annotations

import tomllib
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache
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
RULED = (*CLASSES, *KEEPS, "displaced", "lost", "doubled", "overlaid")
"""The kinds with a rule."""


@dataclass(frozen=True, slots=True)
class Pair:
    """What the OCR gives and what is read.  ``known``: by what besides our rows; ``cls`` its class."""

    witness: str
    lemma: str
    cls: Class
    known: str = ""


@dataclass(frozen=True, slots=True)
class Step:
    """A pair at a place: the number of the row's change, and where it begins in witness and lemma without blanks."""

    change: int
    at: int
    pair: Pair
    to: int = 0


@cache
def table() -> tuple[Pair, ...]:
    """The pairs of the table, longest first."""
    text = files("fortran_src").joinpath("apparatus", "confusables.toml").read_text(encoding="utf-8")
    pairs = [Pair(p["witness"], p["lemma"], p["class"], p.get("known", "")) for p in tomllib.loads(text)["pair"]]
    return tuple(sorted(pairs, key=lambda pair: (-len(pair.witness) - len(pair.lemma), pair.witness, pair.lemma)))


def solid(text: str) -> str:
    """The text without its blanks."""
    return "".join(text.split())


def steps(row: Row) -> tuple[Step, ...] | None:
    """The fewest steps that make a row's lemmas from its witness, or None where the kind's pairs do not."""
    classes = CLASSES.get(row.kind, frozenset())
    pairs = tuple(pair for pair in table() if pair.cls in classes)
    found: list[Step] = []
    for number, change in enumerate(row.changes):
        if change.after or change.through or change.dense or (row.kind == "noise" and not change.lemma):
            continue
        way = _way(solid(change.witness), solid(change.lemma), pairs)
        if way is None:
            return None
        found += [Step(number, at, pair, to) for at, to, pair in way]
    return tuple(found)


def _way(witness: str, lemma: str, pairs: tuple[Pair, ...]) -> list[tuple[int, int, Pair]] | None:
    """The cheapest way through both texts: equal characters are free, a pair costs one."""
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
                    if pair.cls == "zero" and "0" not in (lemma[j - 1 : j], lemma[j + 1 : j + 2]):
                        continue
                    if pair.cls == "comment" and j > 0:
                        continue
                    _better(best, (i + len(pair.witness), j + len(pair.lemma)), cost + 1, (i, j), pair)
    end = (len(witness), len(lemma))
    if end not in best:
        return None
    found: list[tuple[int, int, Pair]] = []
    at: tuple[int, int] | None = end
    while at is not None:
        _, before, used = best[at]
        if used is not None and before is not None:
            found.append((*before, used))
        at = before
    return found[::-1]


def _better(
    best: dict[tuple[int, int], tuple[int, tuple[int, int] | None, Pair | None]],
    to: tuple[int, int],
    cost: int,
    come: tuple[int, int],
    pair: Pair | None,
) -> None:
    if to not in best or cost < best[to][0]:
        best[to] = (cost, come, pair)


def without_step(row: Row, step: Step) -> Row:
    """The row with one step not made."""
    change = row.changes[step.change]
    lemma = _blanked(change.lemma, step.to, len(step.pair.lemma), step.pair.witness)
    changes = tuple(replace(c, lemma=lemma) if n == step.change else c for n, c in enumerate(row.changes))
    return replace(row, changes=changes)


def _blanked(text: str, at: int, length: int, instead: str) -> str:
    """The text with ``length`` characters from the ``at``-th that is not blank replaced."""
    places = [n for n, char in enumerate(text) if not char.isspace()]
    first = places[at] if at < len(places) else len(text)
    last = places[at + length - 1] + 1 if length else first
    return text[:first] + instead + text[last:]


def attested(rows: Iterable[Row]) -> Counter[tuple[str, str]]:
    """How many places each pair is used at by rows of the layer ``ocr``."""
    found: Counter[tuple[str, str]] = Counter()
    for row in rows:
        if row.layer == "ocr" and row.kind in CLASSES:
            found.update((step.pair.witness, step.pair.lemma) for step in steps(row) or ())
    return found


def reading_faults(row: Row, places: Mapping[tuple[str, str], int]) -> Iterator[str]:
    """In what a row's readings break the rule of its kind.  ``places``: :func:`attested` of all rows."""
    if row.layer != "ocr":
        return
    if row.kind not in RULED:
        yield f"the layer ocr has no kind {row.kind!r}"
    elif row.kind in KEEPS:
        if any(solid(c.witness) != solid(c.lemma) for c in row.changes if c.witness or c.after):
            yield f"{row.kind} keeps every character that is not blank"
    elif row.kind == "displaced":
        marks = {pair.witness for pair in table() if pair.cls == "noise"}
        given = [word for c in row.changes for word in c.witness.split()]
        read = [word for c in row.changes for word in c.lemma.split()]
        if sorted(w for w in given if w not in marks) != sorted(w for w in read if w not in marks):
            yield "displaced words are those of the witness in another order"
    elif row.kind == "lost":
        if not all(_within(solid(c.witness), solid(c.lemma)) for c in row.changes):
            yield "what is lost is put in among what the witness has"
    elif row.kind == "doubled":
        if not all(_within(c.lemma.split(), c.witness.split()) for c in row.changes):
            yield "what is left of a doubled cell are words of it"
    elif row.kind in CLASSES:
        made = steps(row)
        if made is None:
            yield f"no pairs for {row.kind} in the table of confusables make the lemma of the witness"
        for step in made or ():
            pair = step.pair
            if places[pair.witness, pair.lemma] < 2 and not pair.known:
                yield f"{pair.lemma!r} is read as {pair.witness!r} nowhere else"


def _within(some: Iterable[str], all_of_them: Iterable[str]) -> bool:
    """Whether the first stand in the second in their order."""
    rest = iter(all_of_them)
    return all(one in rest for one in some)
