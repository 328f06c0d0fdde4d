"""Divide cards into tokens, and find the other possible readings of these tokens, which are called rivals.

A *token* of a card is its statement number, a keyword, a name, a number, a sign, or a word of a comment or of a
Hollerith text.  A *rival* is another text for one or more consecutive tokens.  The rivals are the alterations that no
check detects (``fortran_src/silent.csv``, written by :mod:`modern.edition.weight`) and the readings that rows of the
layers ``print`` and ``lacuna`` replace.  The readings that rows of the layer ``ocr`` replace are certainly wrong and
are no rivals.
"""

import re
from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache

from modern.edition import programs
from modern.edition.apparatus import Row, build
from modern.edition.edits import common_prefix
from modern.edition.readings import solid
from modern.edition.sheets import silent_readings
from modern.edition.transcription import EditionCard, edition_cards

_KEYWORD = re.compile(r"GOTO|(?:DO|READ|PUNCH|PRINT)(?=\d)|IF(?=\()|DIMENSION|CONTINUE|END$|FORMAT")
_TOKEN = re.compile(r"SENSESWITCH|[A-Z][A-Z0-9]*|\d+|\*\*|.", re.DOTALL)


@dataclass(frozen=True, slots=True)
class Rival:
    """Another text for the tokens ``first`` to ``last`` of a card.

    ``origin`` is the id of the row that replaces this text, or ``silent`` for an alteration that no check detects.
    """

    first: int
    last: int
    text: str
    origin: str


@cache
def spans(card: int) -> tuple[tuple[int, int], ...]:
    """Return the index of the first character of each token of a card, and the index after its last character.

    The indices refer to the text of the card without blanks.  ``card`` is the index of the card in the edition
    (:func:`modern.edition.transcription.edition_cards`).
    """
    entry = edition_cards()[card]
    if entry.text.startswith("C") and not entry.label:
        line = programs.committed(entry.program).cards[entry.number - 1].text
        if line.startswith("C  "):
            return tuple(_words(line, 0))
    tokens = list(_tokens(entry))
    return ((0, len(entry.label)), *tokens) if entry.label else tuple(tokens)


def _words(line: str, at: int) -> Iterator[tuple[int, int]]:
    for word in line.split():
        yield at, at + len(word)
        at += len(word)


def _tokens(entry: EditionCard) -> Iterator[tuple[int, int]]:
    """Yield the tokens of a statement, including each word of a Hollerith text, whose stated length counts blanks."""
    at, text = 0, entry.text
    offset = len(entry.label)
    keyword = _KEYWORD.match(text)
    if keyword:
        at = keyword.end()
        yield offset, offset + at
    if keyword and keyword[0] == "FORMAT":
        raw = programs.committed(entry.program).cards[entry.number - 1].text
        raw, at = raw[raw.index("T") + 1 :], offset + at
        while raw:
            literal = re.match(r"\s*(\d+)H", raw)
            if literal:
                size = len(literal[1])
                yield at, at + size
                yield at + size, at + size + 1
                text = raw[literal.end() : literal.end() + int(literal[1])]
                yield from _words(text, at + size + 1)
                at += size + 1 + len(solid(text))
                raw = raw[literal.end() + int(literal[1]) :]
            elif raw[0] == " ":
                raw = raw[1:]
            else:
                token = re.match(r"\d+|[A-Z]|.", raw)
                assert token is not None
                yield at, at + len(token[0])
                at, raw = at + len(token[0]), raw[token.end() :]
        return
    for match in _TOKEN.finditer(text, at):
        yield offset + match.start(), offset + match.end()


@cache
def rivals() -> Mapping[int, tuple[Rival, ...]]:
    """Return the rivals of each card by the index of the card in the edition."""
    number_of = {(card.program, card.number): n for n, card in enumerate(edition_cards())}
    table: dict[int, list[Rival]] = defaultdict(list)
    for entry in silent_readings():
        if entry["reads"]:
            n = number_of[entry["program"], int(entry["card"])]
            card = edition_cards()[n]
            head = card.solid[: len(card.solid) - len(solid(entry["was"]))]
            table[n].append(_rival(n, head + solid(entry["reads"]), "silent"))
    for row in (row for name in programs.TEXTS for row in programs.text(name).rows if row.layer != "ocr"):
        for n, rival in row_rivals(row):
            table[n].append(rival)
    return {n: tuple(entries) for n, entries in table.items()}


@cache
def _lines(name: str) -> Mapping[str, int]:
    return {line.id: number for number, line in enumerate(build(programs.text(name)), 1)}


def row_rivals(row: Row) -> Iterator[tuple[int, Rival]]:
    """Yield each card that a row of a committed listing changes, with the replaced reading as a rival.

    The card is given as an index into :func:`edition_cards`.  Rows that only change blanks or move words have no
    rivals.  For a card that the row adds, the text of the rival is empty.
    """
    if row.text not in programs.TEXTS or row.layer not in programs.built_in(row.text).layers:
        return
    first = next(n for n, card in enumerate(edition_cards()) if card.program == row.text) - 1
    inserted = 0
    for change in row.changes:
        pieces = [solid(piece) for piece in change.lemma.split("\n")]
        before = solid(change.witness)
        if change.after:
            for _ in pieces:
                inserted += 1
                number = _lines(row.text).get(f"{row.id}.{inserted}")
                if number:
                    yield first + number, _rival(first + number, "", row.id)
        elif len(pieces) == 1 and before != pieces[0] and row.kind != "displaced" and change.line in _lines(row.text):
            n = first + _lines(row.text)[change.line]
            text = edition_cards()[n].solid
            if pieces[0] and text.count(pieces[0]) == 1:
                yield n, _rival(n, text.replace(pieces[0], before), row.id)


def _rival(n: int, reading: str, origin: str) -> Rival:
    """Return the rival that turns card ``n`` into ``reading``: the range of tokens that differ, and its other text."""
    text, tokens = edition_cards()[n].solid, spans(n)
    head = common_prefix(text, reading)
    tail = min(common_prefix(text[::-1], reading[::-1]), len(text) - head, len(reading) - head)
    # An insertion between two tokens belongs to the token before it.
    last_char = max(len(text) - tail - 1, head - (head == len(text) - tail), 0)
    first = next(k for k, (_, b) in enumerate(tokens) if min(head, last_char) < b)
    last = next(k for k, (_, b) in enumerate(tokens) if last_char < b)
    start, end = tokens[first][0], tokens[last][1]
    return Rival(first, last, reading[start : len(reading) - (len(text) - end)], origin)
