"""Synthetic transcriptions of the listings whose truth is known.

A page is printed from the cards of the edition, some of them with a rival that the edition rejects.  It is damaged by
the table of confusables and in its structure: lost lines, swapped pages, a separate column of statement
numbers, running heads, page numbers and hyphenated lines.
"""

import re
from collections import Counter
from dataclasses import dataclass
from random import Random

from modern.edition.collation import Collation
from modern.edition.damage import damaged, uniform
from modern.edition.readings import table
from modern.edition.tokens import Rival, rivals, spans
from modern.edition.transcription import edition_cards

CARDS_OF_A_PAGE = 33
HEADS = ("CONVEX HULL OF N POINTS", "K. J. BUTLER  THESIS", "OREGON STATE UNIVERSITY 1963")
# Marks of typesetting that an OCR inserts are not characters of the page.
TYPESETTING = re.compile(r"\\[a-z,]+\{?|</?b>|\{f|[$}]")


@dataclass(frozen=True)
class Synthetic:
    """A transcription, the lines of each card, and each card's tokens on the page and in the transcription."""

    text: str
    lines: dict[int, tuple[int, ...]]
    tokens: dict[int, list[tuple[str, str]]]


def synthetic(seed: int, share: float, planted: int = 60) -> Synthetic:
    """Return a transcription with about this share of its characters damaged and up to ``planted`` rivals."""
    random = Random(seed)
    every = edition_cards()
    chances = uniform(share, "\n".join(card.solid for card in every))
    single = [(n, r) for n, known in rivals().items() for r in known if r.origin == "silent" and r.first == r.last]
    on_page = dict(random.sample(single, planted))
    tokens, written = {}, {}
    for n, card in enumerate(every):
        tokens[n], pieces = [], []
        for k, (a, b) in enumerate(spans(n)):
            rival = on_page.get(n)
            page = rival.text if rival is not None and rival.first == k else card.solid[a:b]
            characters = damaged(page, chances, random)
            # A mark after the last character of a token lies between two tokens and damages neither.
            last = page[-1:] if characters and characters[-1].startswith(page[-1:]) else "".join(characters[-1:])
            tokens[n].append((page, TYPESETTING.sub("", "".join(characters[:-1]) + last)))
            pieces.append("".join(characters))
        written[n] = ("", "".join(pieces)) if not card.label else (pieces[0], "".join(pieces[1:]))
    pages = [range(k, min(k + CARDS_OF_A_PAGE, len(every))) for k in range(0, len(every), CARDS_OF_A_PAGE)]
    for k in random.sample(range(len(pages) - 1), 2):
        pages[k : k + 2] = pages[k + 1], pages[k]
    with_column = set(random.sample(range(len(pages)), 3))
    text: list[str] = []
    lines: dict[int, tuple[int, ...]] = {}
    for number, page in enumerate(pages):
        text += [random.choice(HEADS)] if random.random() < 0.5 else []
        column: dict[int, str] = {}
        for n in page:
            label, body = written[n]
            if random.random() < 0.01:
                continue
            if number in with_column and label:
                column[n], label = label, ""
            line = f"{label:>5} {body}"
            hyphenated = len(body) > 30 and random.random() < 0.08
            text += [line[:-9] + "-", line[-9:]] if hyphenated else [line]
            lines[n] = (len(text) - 1, len(text)) if hyphenated else (len(text),)
        for n, label in column.items():
            text.append(label)
            lines[n] = (len(text), *lines[n])
        text += [str(64 + number)] if random.random() < 0.6 else []
    return Synthetic("\n".join(text) + "\n", lines, tokens)


def scores(truth: Synthetic, collation: Collation) -> Counter[str]:
    """Count cards, aligned cards, readings, readings classified rightly, and false confirmations of a wrong reading.

    A damaged reading is unreadable, and so is one whose damage would make two readings alike; these are also counted
    separately (``alike``).  If the page has a rival, a damaged reading may also be taken as support for a rival.
    """
    count: Counter[str] = Counter()
    for n, card in enumerate(collation.cards):
        count["cards"] += 1
        count["aligned"] += set(card.lines) == set(truth.lines.get(n, ()))
        for k, (reading, (page, transcribed)) in enumerate(zip(card.readings, truth.tokens[n], strict=True)):
            intact = n in truth.lines and transcribed == page
            right = {"confirms" if page == reading.edition else "supports a rival"} if intact else {"unreadable"}
            if not intact and page != reading.edition:
                right.add("supports a rival")
            known = [r for r in rivals().get(n, ()) if r.first == r.last == k]
            alike = intact and reading.verdict == "unreadable" and _alike(page, reading.edition, known)
            count["readings"] += 1
            count["right"] += reading.verdict in right or alike
            count["alike"] += alike
            count["planted"] += page != reading.edition
            count["false"] += reading.verdict == "confirms" and page != reading.edition
    return count


def _alike(page: str, edition: str, known: list[Rival]) -> bool:
    """Return True if one exchange by the table makes the text of the page from a text that rivals it."""
    texts = {edition, *(rival.text for rival in known)} - {page} if known else set()
    return any(
        text[:at] + pair.witness + text[at + len(pair.lemma) :] == page
        for text in texts
        for pair in table()
        for at in range(len(text) + 1)
        if text.startswith(pair.lemma, at)
    )
