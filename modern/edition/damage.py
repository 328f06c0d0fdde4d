"""Damage texts as the OCR damaged the listings, by the pairs of ``fortran_src/apparatus/confusables.toml``.

:func:`rates` gives each pair the rate at which rows of the layer ``ocr`` find it in the listings: its uses divided by
the occurrences of its lemma.  :func:`damaged` exchanges characters of a text at such rates.
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
    """Return the rates of the listings, but lose each sign and point of a text with the chance ``share``."""
    return {**rates(), **{pair: share for pair in table() if pair.cls == "sign" and not pair.witness}}


def uniform(share: float, text: str) -> Rates:
    """Return the same rate for all pairs of characters, so that about ``share`` of a text's characters change."""
    pairs = [pair for pair in table() if pair.cls not in ("comment", "zero") and pair.lemma + pair.witness]
    size = len("".join(text.split()))
    opportunities = sum(text.count(pair.lemma) if pair.lemma else size / 20 for pair in pairs)
    rate = share * size / opportunities
    return {pair: rate if pair.lemma else rate / 20 for pair in pairs}


def damaged(
    text: str, chances: Rates, random: Random, allowed: Callable[[str, int], bool] = lambda text, at: True
) -> list[str]:
    """Damage a text, and return for each of its characters the text that replaces it, including any marks inserted
    after it.

    If a pair of several characters is exchanged, the replacement stands at the first of them.  ``allowed`` tells which
    characters may change.
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
    """Return one of the pairs, chosen at random by the rates of the pairs, or None."""
    number = random.random()
    for pair in pairs:
        number -= chances[pair]
        if number < 0:
            return pair
    return None
