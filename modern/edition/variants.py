"""Generate variants of the listings.  A variant has one token altered as an OCR program or a typist might alter it.

The alterations are:

* Each digit of a statement number is replaced by each other digit in turn.  The number is also replaced by each other
  number in its statement.
* A name is replaced, in turn, by each other name of its statement with the same mode (fixed or floating point).
* An operator is replaced by each other operator in turn.
* Each digit of a constant is increased and decreased by one.
* A character is replaced by each character with which it may be confused (``fortran_src/apparatus/confusables.toml``).
* The counts and separators of a FORMAT, and one letter of each of its literal texts, are changed.
* Each card is left out once.

:mod:`modern.edition.weight` runs the variants.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

from emulator.language.cards import CHARACTERS, RECORD_MARKS, Deck, deck_from_lines
from emulator.language.statements import Source, sources
from modern.edition import programs
from modern.edition.readings import table

_NAME = re.compile(r"[A-Z][A-Z0-9]*")
_NUMBER = re.compile(r"\d+")
# For each kind of statement, a pattern that finds the numbers of other statements in it.
LABELS = {
    "if": re.compile(r"\)(\d+(?:,\d+)*)$"),
    "if_switch": re.compile(r"\)(\d+(?:,\d+)*)$"),
    "go_to": re.compile(r"^GOTO(\d+)$"),
    "computed_go_to": re.compile(r"^GOTO\((\d+(?:,\d+)*)\)"),
    "do": re.compile(r"^DO(\d+)(?=[A-Z])"),
    "input_output": re.compile(r"^(?:READ|PUNCH|PRINT)(\d+)"),
}
_WORDS = {
    "if": "IF",
    "if_switch": "IF(SENSESWITCH",
    "go_to": "GOTO",
    "computed_go_to": "GOTO",
    "dimension": "DIMENSION",
    "continue": "CONTINUE",
    "end": "END",
}
_OPERATORS = "+-*/"
FUNCTIONS = ("SQRT",)


@dataclass(frozen=True, slots=True)
class Variant:
    """A card of a listing with an altered statement.

    ``card`` is the number of the card, from 1, and ``place`` is its name, such as ``147+1``.  ``how`` is the kind of
    the alteration: ``number``, ``name``, ``operator``, ``constant``, ``character``, ``format`` or ``card``.  ``was``
    and ``reads`` are the statement before and after the alteration, without blanks.  ``reads`` is empty if the card is
    left out.
    """

    program: str
    card: int
    place: str
    how: str
    was: str
    reads: str

    @property
    def key(self) -> str:
        return f"{self.program} {self.card} {self.reads}"


@dataclass(frozen=True, slots=True)
class Statement:
    """A statement of a listing with the name of its card.

    ``labels`` has, for each number of another statement in the text, the index of its first digit and the index after
    its last digit.
    """

    source: Source
    place: str
    labels: tuple[tuple[int, int], ...]

    @property
    def card(self) -> int:
        return self.source.cards[0].number


@cache
def statements(name: str) -> tuple[Statement, ...]:
    """Return the statements of a built-in program without comments."""
    listing, label, steps = [], "", 0
    for source in sources(programs.committed(name)):
        word = "FORMAT " if source.kind == "format" else ""
        label, steps = (word + source.label, 0) if source.label else (label, steps + 1)
        place = f"{label}+{steps}" if steps and label else label or source.text.split("(")[0]
        pattern = LABELS.get(source.kind)
        match = pattern.search(source.text) if pattern else None
        spans = (
            [(n.start() + match.start(1), n.end() + match.start(1)) for n in _NUMBER.finditer(match[1])]
            if match
            else []
        )
        listing.append(Statement(source, place, tuple(spans)))
    return tuple(listing)


@cache
def variants(name: str) -> tuple[Variant, ...]:
    """Return every variant of a built-in program once, in the order of its cards."""
    by_key: dict[str, Variant] = {}
    for statement in statements(name):
        for how, reads in _altered(statement):
            variant = Variant(name, statement.card, statement.place, how, statement.source.text, reads)
            if reads != statement.source.text:
                by_key.setdefault(variant.key, variant)
    return tuple(by_key.values())


def _altered(statement: Statement) -> Iterator[tuple[str, str]]:
    source, text = statement.source, statement.source.text
    if source.kind != "end":
        yield "card", ""
    if source.kind == "format":
        yield from (("format", reads) for reads in _formats(text))
        return
    start = len(_WORDS.get(source.kind, ""))
    numbers = [text[a:b] for a, b in statement.labels]
    for a, b in statement.labels:
        for new in (*_digits(text[a:b]), *numbers):
            yield "number", text[:a] + new + text[b:]
    label_spans = [range(a, b) for a, b in statement.labels]
    if source.kind in ("do", "input_output"):
        start = statement.labels[0][1] if statement.labels else len(text)
    names = [match for match in _NAME.finditer(text, start) if match[0] not in FUNCTIONS]
    for match in names:
        for new in sorted({name[0] for name in names} | _alike(match[0])):
            # The first letter determines the mode; a change of mode would not compile.
            if (new[0] in "IJKLMN") is (match[0][0] in "IJKLMN"):
                yield "name", text[: match.start()] + new + text[match.end() :]
    for at in range(start, len(text)):
        if any(at in span for span in label_spans):
            continue
        if text[at] in _OPERATORS and "**" not in text[at - 1 : at + 2]:
            yield from (("operator", text[:at] + new + text[at + 1 :]) for new in _OPERATORS)
        for new in _confused(text[at]):
            yield "character", text[:at] + new + text[at + 1 :]
    for match in _NUMBER.finditer(text, start):
        in_name = match.start() and text[match.start() - 1].isalpha()
        if not in_name and not any(match.start() in span for span in label_spans):
            yield from (("constant", text[: match.start()] + new + text[match.end() :]) for new in _steps(match[0]))


def _digits(number: str) -> Iterator[str]:
    for at, digit in enumerate(number):
        yield from (number[:at] + new + number[at + 1 :] for new in "0123456789" if new != digit)


def _steps(number: str) -> Iterator[str]:
    for at, digit in enumerate(number):
        yield from (number[:at] + str((int(digit) + by) % 10) + number[at + 1 :] for by in (1, -1))


def _alike(name: str) -> set[str]:
    """Return the names in the listings that differ from ``name`` in one character.

    Return no names if ``name`` is one letter.
    """
    if len(name) < 2:
        return set()
    return {known for known in _names() if len(known) == len(name) and sum(map(str.__ne__, name, known)) == 1}


@cache
def _names() -> frozenset[str]:
    return frozenset(
        entry.name for n in programs.TEXTS for entry in programs.program(n).storage.entries if entry.name[:1].isalpha()
    )


@cache
def _confused(char: str) -> tuple[str, ...]:
    pairs = [(p.witness, p.lemma) for p in table() if p.cls == "confusable" and len(p.witness) == len(p.lemma) == 1]
    partners = [b for a, b in (*pairs, *((b, a) for a, b in pairs)) if a == char]
    return tuple(dict.fromkeys(c for c in partners if c in CHARACTERS.difference(RECORD_MARKS)))


def _formats(text: str) -> Iterator[str]:
    """Yield each FORMAT in which one count, one separator, one E, F, I or X, or one letter of a literal is changed."""
    at = 0
    while at < len(text):
        count = re.compile(r"(\d+)H").match(text, at)
        if count:
            first, last = count.end(), count.end() + int(count[1])
            literal = text[first:last]
            letter = next((n for n, c in enumerate(literal) if c.isalpha()), None)
            if letter is not None:
                new = "X" if literal[letter] != "X" else "Y"
                yield text[: first + letter] + new + text[first + letter + 1 :]
            yield from (text[:at] + new + text[count.end() - 1 :] for new in _steps(count[1]))
            at = last
        elif number := _NUMBER.match(text, at):
            yield from (text[:at] + new + text[number.end() :] for new in _steps(number[0]))
            at = number.end()
        else:
            if text[at] == ",":
                yield text[:at] + "." + text[at + 1 :]
            elif text[at] == "/":
                yield text[:at] + text[at + 1 :]
                yield text[:at] + "/" + text[at:]
            elif text[at] in "EIX":
                yield from (text[:at] + new + text[at + 1 :] for new in "EFIX")
            at += 1


def deck_with(name: str, card: int, reads: str) -> Deck:
    """Return the deck of a built-in program with the statement ``reads`` on one card.

    If ``reads`` is empty, the deck lacks the card.
    """
    deck = programs.committed(name)
    old = next(s.source for s in statements(name) if s.card == card)
    word = "FORMAT " if old.kind == "format" else ""
    new = f"{old.label:>5} {word}{reads}"
    new = new if len(new) <= 72 else f"{old.label}{word}{reads}"
    lines = [new if c.number == card else c.text for c in deck.cards if reads or c.number != card]
    return deck_from_lines(deck.source, lines)
