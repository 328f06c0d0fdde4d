"""Collate another transcription of the listings with the edition: compare the texts token by token.

:mod:`modern.edition.transcription` finds the characters of each card in the transcription.
:mod:`modern.edition.tokens` divides the card into tokens and finds their rivals, which are other possible readings.
Each token gets one of four verdicts:

``confirms``          the transcription has the token of the edition, which cannot be a misreading of a rival
``supports a rival``  the transcription has a rival, which cannot be a misreading of the edition's token
``contradicts``       the transcription has another token of the same kind, which cannot be a misreading of the token
``unreadable``        the transcription lacks the passage, has no token of the same kind, or has characters that may be
                      a misreading of the token or of a rival

Characters may be a misreading of a text if the pairs of the table of confusables turn the text into these characters.
A pair is not used if the transcription has the original character of the pair in at least :data:`ENOUGH` places and
never misreads it in this way.  A misreading that is not in the table is used if it occurs at least twice.
"""

import hashlib
import json
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import groupby
from typing import Literal

from modern.edition import programs
from modern.edition.alignment import align_characters
from modern.edition.apparatus import ApparatusError, Row
from modern.edition.readings import Pair, explains, table
from modern.edition.sources import read, sources
from modern.edition.tokens import Rival, rivals, row_rivals, spans
from modern.edition.transcription import align, edition_cards, read_lines
from modern.formats.columns import csv_text

Verdict = Literal["confirms", "supports a rival", "contradicts", "unreadable"]
VERDICTS: tuple[Verdict, ...] = ("confirms", "supports a rival", "contradicts", "unreadable")
_LETTER: Mapping[Verdict, str] = {verdict: verdict[0] for verdict in VERDICTS} | {"contradicts": "x"}
_VERDICT = {letter: verdict for verdict, letter in _LETTER.items()}
# If a transcription has a character this often and never misreads it in a certain way, the edition assumes that the
# transcription does not make this misreading.
ENOUGH = 300
# Misreadings are counted on cards of which at most this share is misread, because other cards may be misaligned.
SOUND = 0.25
FORMAT = "hull1620 collation 1"


@dataclass(frozen=True, slots=True)
class Reading:
    """A token of a card: its text in the edition and in the transcription, the verdict, and the supported rival."""

    edition: str
    transcription: str
    verdict: Verdict
    rival: str = ""


@dataclass(frozen=True, slots=True)
class CollatedCard:
    """A card of the edition, by its index: the lines of the transcription that contain it, and its tokens."""

    card: int
    lines: tuple[int, ...]
    readings: tuple[Reading, ...]


@dataclass(frozen=True, slots=True)
class Collation:
    """The collation of a transcription: its id and file, the hash and number of lines of its text, and its cards.

    ``cards`` has every card of the edition in order, including cards that the transcription lacks.
    """

    id: str
    file: str
    sha256: str
    lines: int
    cards: tuple[CollatedCard, ...]


def collate(text: str, file: str = "") -> Collation:
    """Collate a transcription of the listings, or of a part of them.  ``file`` names the file of the transcription."""
    aligned = align(text)
    pieces = {n: _pieces(n, line) for n, (line, _) in aligned.items()}
    pairs = _pairs(aligned)
    cards = tuple(
        CollatedCard(n, aligned[n][1] if n in aligned else (), tuple(_readings(n, pieces.get(n), pairs)))
        for n in range(len(edition_cards()))
    )
    digest = hashlib.sha256(text.encode()).hexdigest()
    return Collation(digest[:12], file, digest, len(read_lines(text)), cards)


def _pieces(n: int, line: str) -> tuple[str, ...]:
    """Return the characters of a line that align with each token of a card.

    A character of the line that stands between two tokens and aligns with neither of them is assigned to the first
    token, with one exception: a letter or digit is assigned to the second token if the second token begins with a
    letter or digit and the first token does not end with one.  Characters that the OCR may have inserted as noise, such
    as specks, are omitted.
    """
    tokens, marks = spans(n), _marks()
    owner = [k for k, (a, b) in enumerate(tokens) for _ in range(a, b)]
    pieces, at, text = [""] * len(tokens), -1, edition_cards()[n].solid
    for i, j in align_characters(text, line):
        if i >= 0:
            at = i
            pieces[owner[i]] += line[j] if j >= 0 else ""
            continue
        inside = 0 <= at < len(text) - 1 and owner[at] == owner[at + 1]
        if inside or line[j] not in marks:
            before, after = text[max(at, 0)], text[min(at + 1, len(text) - 1)]
            joins_next = at < 0 or (line[j].isalnum() and after.isalnum() and not before.isalnum())
            pieces[owner[min(at + 1, len(text) - 1) if joins_next else at]] += line[j]
    return tuple(pieces)


@cache
def _marks() -> frozenset[str]:
    return frozenset(pair.witness for pair in table() if not pair.lemma)


def _pairs(aligned: Mapping[int, tuple[str, tuple[int, ...]]]) -> tuple[Pair, ...]:
    """Return the pairs of characters that the transcription may have confused (see the docstring of the module)."""
    places: Counter[str] = Counter()
    errors: Counter[tuple[str, str]] = Counter()
    for n, (line, _) in aligned.items():
        text = edition_cards()[n].solid
        contested = {k for rival in rivals().get(n, ()) for k in range(rival.first, rival.last + 1)}
        certain = {i for k, (a, b) in enumerate(spans(n)) if k not in contested for i in range(a, b)}
        steps = align_characters(text, line)
        if sum(i < 0 or j < 0 or text[i] != line[j] for i, j in steps) <= SOUND * len(text):
            places.update(text[i] for i in certain)
            errors.update((line[j] if j >= 0 else "", text[i]) for i, j in steps if i in certain)
    pairs = [
        pair
        for pair in table()
        if (
            pair.cls == "comment"
            or len(pair.lemma) != 1
            or len(pair.witness) > 1
            or places[pair.lemma] < ENOUGH
            or errors[pair.witness, pair.lemma]
        )
    ]
    known = {(pair.witness, pair.lemma) for pair in table()}
    others = [
        Pair(a, b, "confusable") for (a, b), count in errors.items() if a != b and count > 1 and (a, b) not in known
    ]
    return (*pairs, *sorted(others, key=lambda pair: (pair.witness, pair.lemma)))


def _readings(n: int, aligned: tuple[str, ...] | None, pairs: tuple[Pair, ...]) -> Iterator[Reading]:
    text = edition_cards()[n].solid
    tokens = [text[a:b] for a, b in spans(n)]
    known = rivals().get(n, ())
    pieces = aligned or ("",) * len(tokens)
    supported: dict[int, Rival] = {}
    for rival in known if aligned else ():
        there = "".join(pieces[rival.first : rival.last + 1])
        here = "".join(tokens[rival.first : rival.last + 1])
        if there == rival.text != here and not explains(there, here, pairs):
            supported |= {k: rival for k in range(rival.first, rival.last + 1) if pieces[k] != tokens[k]}
    for k, token in enumerate(tokens):
        there = pieces[k]
        near = slice(max(k - 1, 0), k + 2)
        if k in supported:
            yield Reading(token, there, "supports a rival", supported[k].text)
        elif there == token:
            doubtful = any(r.first == r.last == k and r.text != token and explains(token, r.text, pairs) for r in known)
            yield Reading(token, there, "unreadable" if doubtful else "confirms")
        elif (
            not _is_truncated(pieces, k, token)
            and _kind(there) == _kind(token) != ""
            and not explains(there, token, pairs)
            and not explains("".join(pieces[near]), "".join(tokens[near]), pairs)
        ):
            yield Reading(token, there, "contradicts")
        else:
            yield Reading(token, there, "unreadable")


def _is_truncated(pieces: Sequence[str], k: int, token: str) -> bool:
    """Return True if the line ends within the token, or begins within it."""
    ends = k + 1 < len(pieces) and not any(pieces[k + 1 :]) and token.startswith(pieces[k])
    return ends or (k > 0 and not any(pieces[:k]) and token.endswith(pieces[k]))


def _kind(token: str) -> str:
    """Return the kind of a token (``number``, ``name`` or ``sign``), or an empty text if it is none of these."""
    for kind, pattern in (("number", r"\d+"), ("name", r"[A-Z][A-Z0-9]*"), ("sign", r"[-+*/=.,()]+")):
        if re.fullmatch(pattern, token):
            return kind
    return ""


def to_json(collation: Collation) -> str:
    """Return a collation as JSON, with one card on each line.

    A card has a letter for the verdict on each token and, for the tokens that are not confirmed, the characters of the
    transcription.
    """
    head = {"format": FORMAT, "id": collation.id, "file": collation.file, "sha256": collation.sha256}
    head |= {"lines": str(collation.lines), "edition": _edition()}
    lines = []
    for card in collation.cards:
        entry = edition_cards()[card.card]
        letters = "".join(_LETTER[reading.verdict] for reading in card.readings)
        others = {
            str(k): [r.transcription, *([r.rival] if r.rival else [])]
            for k, r in enumerate(card.readings)
            if r.verdict != "confirms" and card.lines
        }
        lines.append(json.dumps([entry.program, entry.number, card.lines, letters, others], ensure_ascii=False))
    return json.dumps(head)[:-1] + ', "cards": [\n' + ",\n".join(lines) + "\n]}\n"


def from_json(text: str, source: str) -> Collation:
    """Read a collation that :func:`to_json` wrote.

    ``source`` is the name of the file for messages.  Raise ApparatusError if the text is not a collation, or if it was
    made for other cards of the edition.
    """
    try:
        data = json.loads(text)
        if data["format"] != FORMAT:
            raise ValueError(data["format"])
        if data["edition"] != _edition():
            message = "the collation was made for other cards of the listings; collate the transcription again"
            raise ApparatusError(f"{source}: {message}")
        cards = tuple(_card(n, raw) for n, raw in enumerate(data["cards"]))
        return Collation(data["id"], data["file"], data["sha256"], int(data["lines"]), cards)
    except (ValueError, KeyError, TypeError, IndexError) as error:
        if isinstance(error, ApparatusError):
            raise
        raise ApparatusError(f"{source}: is not a collation that --collate wrote with --json ({error!r})") from None


def _card(n: int, raw: list[object]) -> CollatedCard:
    program, number, lines, letters, others = raw
    card = edition_cards()[n]
    if (program, number) != (card.program, card.number) or not isinstance(lines, list) or not isinstance(others, dict):
        raise ValueError(f"unknown card {program} {number}")
    readings = []
    for k, ((a, b), letter) in enumerate(zip(spans(n), str(letters), strict=True)):
        token = card.solid[a:b]
        there, *rival = others.get(str(k), [token if letter == "c" else ""])
        readings.append(Reading(token, there, _VERDICT[letter], *rival))
    return CollatedCard(n, tuple(lines), tuple(readings))


@cache
def _edition() -> str:
    return hashlib.sha256("\n".join(card.solid for card in edition_cards()).encode()).hexdigest()


def to_csv(collation: Collation) -> str:
    """Return a collation as a CSV table with a row for each token."""
    rows: list[tuple[object, ...]] = [
        ("program", "card", "place", "lines", "reading", "edition", "transcription", "verdict", "rival")
    ]
    for card in collation.cards:
        entry, lines = edition_cards()[card.card], " ".join(map(str, card.lines))
        for k, r in enumerate(card.readings, 1):
            verdict = (r.edition, r.transcription, r.verdict, r.rival)
            rows.append((entry.program, entry.number, entry.place, lines, k, *verdict))
    return csv_text(rows)


def report(collation: Collation, text: str) -> Iterator[str]:
    """Yield the lines of a summary: the numbers of cards and of tokens with each verdict, and the differences.

    ``text`` is the transcription.  Only the cards that it contains are counted.
    """
    aligned = [card for card in collation.cards if card.lines]
    yield f"cards: {len(aligned)} of {len(collation.cards)} are in the transcription"
    numbers = [number for number, _ in read_lines(text)]
    skipped = sorted({*numbers} - {line for card in aligned for line in card.lines})
    yield f"lines: {len(skipped)} of {len(numbers)} belong to no card" + (f": {_ranges(skipped)}" if skipped else "")
    counts = Counter(reading.verdict for card in aligned for reading in card.readings)
    yield "readings of these cards: " + ", ".join(f"{counts[verdict]} {verdict}" for verdict in VERDICTS)
    shared, places = shared_errors(collation)
    yield f"errors of our OCR text: {shared} of the {places} on these cards are in the transcription too"
    for card in aligned:
        entry = edition_cards()[card.card]
        place = f"{entry.program} {entry.place}, line {card.lines[0]}"
        # The readings that one rival replaces are reported together; every other difference separately.
        for _, group in groupby(
            enumerate(card.readings), lambda p: p[1].rival if p[1].verdict == "supports a rival" else p[0]
        ):
            readings = [reading for _, reading in group]
            if readings[0].verdict in ("contradicts", "supports a rival"):
                there, here = "".join(r.transcription for r in readings), "".join(r.edition for r in readings)
                yield f"{place}: {readings[0].verdict}: {there or 'nothing'} in the transcription for {here}"


def _ranges(numbers: Sequence[int]) -> str:
    """Return ascending numbers as text, such as ``1-3, 7``, with at most the first ten ranges."""
    runs = [[n for _, n in run] for _, run in groupby(enumerate(numbers), lambda pair: pair[1] - pair[0])]
    texts = [f"{run[0]}-{run[-1]}" if len(run) > 1 else f"{run[0]}" for run in runs]
    return ", ".join(texts[:10]) + (", ..." if len(texts) > 10 else "")


def shared_errors(collation: Collation) -> tuple[int, int]:
    """Return how many misreadings of the OCR text a transcription shares, and how many it could share.

    A transcription could share the misreadings at all places that it contains.  A transcription that shares most of
    these was probably made from the same OCR text or scan and is not independent.
    """
    shared = places = 0
    for row in (row for name in programs.TEXTS for row in programs.text(name).rows if row.kind == "misread"):
        for _, same in _of_row(collation, row):
            places += 1
            shared += same
    return shared, places


def _of_row(collation: Collation, row: Row) -> Iterator[tuple[Verdict, bool]]:
    """Yield the verdict on each place that a row changes, and True if the transcription has the OCR's reading."""
    for n, rival in row_rivals(row):
        card = collation.cards[n]
        if card.lines:
            readings = card.readings[rival.first : rival.last + 1]
            same = "".join(r.transcription for r in readings) == rival.text
            worst = max((r.verdict for r in readings), key=VERDICTS.index)
            decided = next((r.verdict for r in readings if r.verdict in ("supports a rival", "contradicts")), worst)
            yield decided, same


@cache
def registered() -> tuple[Collation, ...]:
    """Return the collations that SOURCES.toml names, with the ids of their transcriptions.

    Raise ApparatusError if a file is not a collation of these listings.
    """
    entries = (entry for entry in sources().transcriptions if entry.file)
    return tuple(replace(from_json(read(entry.file), entry.file), id=entry.id) for entry in entries)


def verdicts_by_id(row: Row) -> dict[str, tuple[Verdict, ...]]:
    """Return the verdicts of every registered collation on the places that a row changes, by the collation's id.

    A collation that has none of these places is omitted.
    """
    by_id = {collation.id: tuple(verdict for verdict, _ in _of_row(collation, row)) for collation in registered()}
    return {name: verdicts for name, verdicts in by_id.items() if verdicts}
