"""Alterations of readings: a character of a row of any layer of any text is changed, and a check must notice it.

    python -m tests.modern.edition.alterations COUNT [SEED]

alters COUNT characters, as often in one layer of a text as in any other, and prints the number that each check noticed.
The exit code is 1 if no check noticed an alteration of a reading that is not a conjecture.
"""

import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import cycle, islice
from random import Random

from emulator.errors import EmulatorError
from modern.claims import published
from modern.claims.apparatus_checks import chapter4_faults, paper_faults, texts
from modern.edition import chapter4, programs, sources
from modern.edition.apparatus import ApparatusError, Row, Text
from modern.edition.chapter6 import chapter6_folder
from modern.edition.chapter6_cards import TranscriptError, load_chapter, rebuilt
from modern.edition.chapter6_checks import check_arithmetic, check_files, check_layout, check_tie

SEED = 1963
_ALPHABETS = ("0123456789", "ABCDEFGHIJKLMNOPQRSTUVWXYZ", "abcdefghijklmnopqrstuvwxyz", "+-*/=.,()")


@dataclass(frozen=True, slots=True)
class Alteration:
    """A row of a text in which one character of a lemma is changed."""

    text: Text
    row: Row
    change: str


def alterations(count: int, seed: int = SEED) -> Iterator[Alteration]:
    """Yield random alterations.  Each layer of each text has its turn; every call yields the same ones."""
    random = Random(seed)
    layers: dict[tuple[str, str], list[tuple[Text, Row]]] = {}
    for text in texts().values():
        for row in text.rows:
            if any(_places(change.lemma) for change in row.changes):
                layers.setdefault((text.id, row.layer), []).append((text, row))
    for rows in islice(cycle(layers.values()), count):
        text, row = random.choice(rows)
        at = random.choice([k for k, change in enumerate(row.changes) if _places(change.lemma)])
        lemma = row.changes[at].lemma
        place = random.choice(_places(lemma))
        alphabet = next(a for a in _ALPHABETS if lemma[place] in a)
        new = random.choice(alphabet.replace(lemma[place], ""))
        changed = replace(row.changes[at], lemma=lemma[:place] + new + lemma[place + 1 :])
        changes = (*row.changes[:at], changed, *row.changes[at + 1 :])
        yield Alteration(text, replace(row, changes=changes), f"{lemma} to {changed.lemma}")


def _places(lemma: str) -> list[int]:
    return [k for k, character in enumerate(lemma) if any(character in alphabet for alphabet in _ALPHABETS)]


def noticed_by(alteration: Alteration) -> str:
    """Return the name of the check of ``apparatus --check`` that notices an alteration, or an empty text."""
    row, text = alteration.row, alteration.text
    rows = tuple(row if original.id == row.id else original for original in text.rows)
    altered = replace(text, rows=rows)
    try:
        if text.id in programs.TEXTS:
            return _in_listing(row)
        if text.id == "chapter6":
            chapter = rebuilt(altered, load_chapter().layout)
            faults = (*check_tie(chapter), *check_layout(chapter), *check_arithmetic(chapter))
            return "chapter6" if faults or check_files(chapter, chapter6_folder()) else ""
        if text.id == "chapter4":
            in_data = any(chapter4.theorem_faults(theorem, altered) for theorem in chapter4.load_theorems())
            return "chapter4" if in_data or any(chapter4_faults(altered, r) for r in rows) else ""
        paper = next(paper for paper in published.PAPERS if published.text_of(paper).id == text.id)
        return "results of a paper" if paper_faults(paper, altered, row) else ""
    except (ApparatusError, EmulatorError, TranscriptError):
        return "the text cannot be built"


def _in_listing(row: Row) -> str:
    bases = [entry for entry in programs.BUILT_INS if entry.text == row.text and row.layer in entry.layers]
    if any(programs.built(e.name, (), (), row).text() != programs.committed(e.name).text() for e in bases):
        return "decks"
    with_layer = [
        (programs.built(name, (layer,), (), row).text(), digest)
        for name, layer, digest in sources.sources().layered
        if layer == row.layer and programs.built_in(name).text == row.text
    ]
    different = any(sources.digest(cards) != digest for cards, digest in with_layer)
    return "cards of the optional layers" if different else ""


def main(arguments: list[str]) -> int:
    count, seed = int(arguments[0]), int(arguments[1]) if len(arguments) > 1 else SEED
    checks: Counter[str] = Counter()
    unnoticed = []
    for alteration in alterations(count, seed):
        check = noticed_by(alteration)
        checks[check or "no check"] += 1
        if not check:
            print(f"{alteration.row.id} ({alteration.row.layer}): {alteration.change}")
            unnoticed += [] if alteration.row.certainty == "conjecture" else [alteration]
    print(", ".join(f"{number} noticed by {check}" for check, number in checks.most_common()))
    return int(bool(unnoticed))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
