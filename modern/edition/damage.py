"""Damage texts as the OCR damaged the listings: exchange characters that ``confusables.toml`` lists as misread.

``fortran_src/apparatus/confusables.toml`` has pairs: characters that the card has (the lemma), and characters that the
OCR read instead (the witness).  :func:`rates` returns how often the OCR misread the characters of a pair in the
listings: the number of places that rows of the layer ``ocr`` correct, divided by the number of places with the lemma.
:func:`damaged` damages a text at such rates.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import cache
from random import Random

from modern.edition import programs
from modern.edition.readings import Pair, attested, table

Rates = Mapping[Pair, float]


@cache
def rates() -> Rates:
    """Return the rate at which the OCR confused each pair of characters in the listings."""
    uses = attested(row for name in programs.TEXTS for row in programs.text(name).rows)
    text = "\n".join(card.text for name in programs.TEXTS for card in programs.committed(name).cards)
    size = len("".join(text.split()))
    return {
        pair: uses[pair.witness, pair.lemma] / (text.count(pair.lemma) if pair.lemma else size)
        for pair in table()
        if uses[pair.witness, pair.lemma] and pair.cls != "comment"
    }


@cache
def with_lost_signs(share: float) -> Rates:
    """Return the rates of the listings, with the rate ``share`` for the loss of each sign and each decimal point."""
    return {**rates(), **{pair: share for pair in table() if pair.cls == "sign" and not pair.witness}}


def uniform(share: float, text: str) -> Rates:
    """Return equal rates for all pairs, such that about the share ``share`` of the characters of a text changes."""
    pairs = [pair for pair in table() if pair.cls not in ("comment", "zero") and pair.lemma + pair.witness]
    size = len("".join(text.split()))
    opportunities = sum(text.count(pair.lemma) if pair.lemma else size / 20 for pair in pairs)
    rate = share * size / opportunities
    return {pair: rate if pair.lemma else rate / 20 for pair in pairs}


def damaged(
    text: str, chances: Rates, random: Random, allowed: Callable[[str, int], bool] = lambda text, at: True
) -> list[str]:
    """Damage a text, and return for each of its characters the damaged text: its replacement and inserted noise.

    If several characters are replaced together, the replacement is at the index of the first.  ``allowed(text, index)``
    returns True if the character at an index may change.
    """
    by_lemma: dict[str, list[Pair]] = {}
    for pair in chances:
        by_lemma.setdefault(pair.lemma[:1], []).append(pair)
    result, at = [], 0
    while at < len(text):
        size, damage = 1, text[at]
        if not text[at].isspace() and allowed(text, at):
            chosen = _drawn([p for p in by_lemma.get(text[at], ()) if text.startswith(p.lemma, at)], chances, random)
            if chosen:
                size, damage = len(chosen.lemma), chosen.witness
            mark = _drawn(by_lemma.get("", ()), chances, random)
            damage += mark.witness if mark else ""
        result += [damage] + [""] * (size - 1)
        at += size
    return result


def _drawn(pairs: Sequence[Pair], chances: Rates, random: Random) -> Pair | None:
    """Draw at most one of the pairs, each with its rate as its probability.  Return None if none is drawn."""
    number = random.random()
    for pair in pairs:
        number -= chances[pair]
        if number < 0:
            return pair
    return None
