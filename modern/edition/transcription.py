"""Align the lines of another transcription of the listings with the cards of the edition.

A transcription may have lost lines, and its pages and columns may be in another order.  A Viterbi search therefore
assigns cards to lines.  A line that resembles a card gains points.  Following the order of the cards costs nothing,
skipping cards costs a little, and a jump to any other card costs as many points as a short line gains.

A line may also belong to no card (a page number, a running head).  Two lines may belong to one card (a hyphenated
line), and one line to two cards.  A line with more than two cards is divided first, by aligning its characters with the
cards.  Statement numbers that form a separate column are joined with their statements afterwards.  Line numbers and
columns 73 to 80 are removed if the lines without them resemble the cards more.  A run of consecutive cards is accepted
only if it gains more points than a jump costs, and if its lines resemble no other cards equally well.

Before lines are compared, characters that may be confused are replaced by one character that represents them
(:mod:`modern.edition.alignment`), so that misreadings of the expected kind cost nothing.
"""

import re
import unicodedata
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache

from modern.edition import programs
from modern.edition.alignment import distance, divide, folded
from modern.edition.apparatus import PAGE_MARK
from modern.edition.readings import solid, table

# A jump costs JUMP.  Skipping k cards costs SKIP + k * SKIP_CARD, for at most FARTHEST cards.
JUMP, SKIP, SKIP_CARD, FARTHEST = 14.0, 0.7, 0.3, 25
# CANDIDATES is the number of card texts with which a line is compared.  If the share of differing characters exceeds
# NO_MATCH, the line does not resemble the card.  If it exceeds POOR for every card, the line may be a part of a card or
# contain two.
CANDIDATES, NO_MATCH, POOR = 8, 0.45, 0.15
# A line with more than LONGEST characters, which is more than any two cards have, is divided if it has an anchor
# (eight characters that occur on only one card) for every FEW characters.
LONGEST, FEW = 132, 20
_MARKS = sorted((p.witness for p in table() if p.cls == "noise" and not p.lemma and len(p.witness) > 1), reverse=True)
_NOISE = re.compile("|".join(map(re.escape, _MARKS)) + r"|\\[A-Za-z]+\*?|[\\$}{`\u200b\ufeff]|^\s*[-·•*]\s+")
# Typographic signs that stand for characters of a card, in addition to the compatibility forms of Unicode.
_SIGNS = {sign: to for signs, to in (("−–—‐‑\xad", "-"), ("×∗⋅", "*"), ("‚", ","), ("∕⁄÷", "/")) for sign in signs}
_TYPOGRAPHY = str.maketrans(_SIGNS)
# Line numbers and columns 73 to 80 may be removed if this share of the lines has them.
_MOST = 0.9
_PROSE = re.compile(r"[a-z]{2,}[,;]? [a-z]{2,}")
_LINE_NUMBER = re.compile(r"\s*(\d+)[.:)|]?\s")
_IDENTIFICATION = re.compile(r"(?=.{73,80}$)(.{72}).*\d\s*$")


# The characters of each card and the numbers of the lines that contain them, by the index of the card in the edition.
Texts = dict[int, tuple[str, tuple[int, ...]]]


@dataclass(frozen=True, slots=True)
class EditionCard:
    """A card of a built-in program: its number in the deck, its name, and its characters without blanks.

    ``label`` is the statement number, and ``text`` is the rest of the card.
    """

    program: str
    number: int
    place: str
    label: str
    text: str

    @property
    def solid(self) -> str:
        return self.label + self.text


@dataclass(frozen=True, slots=True)
class Span:
    """Consecutive lines that contain consecutive cards, and the points that they gain.

    ``lines`` are indices of lines in the cleaned transcription, and ``cards`` indices of cards in the edition.
    """

    lines: tuple[int, ...]
    cards: tuple[int, ...]
    gain: float


@cache
def edition_cards() -> tuple[EditionCard, ...]:
    """Return the cards of the three listings in their order."""
    cards = []
    for name in programs.TEXTS:
        for card, place in zip(programs.committed(name).cards, programs.card_names(name), strict=True):
            number = re.match(r" *(\d*)", card.text)
            label = number[1] if number and not card.text.startswith("C  ") else ""
            cards.append(EditionCard(name, card.number, place, label, solid(card.text)[len(label) :]))
    return tuple(cards)


def read_lines(text: str) -> list[tuple[int, str]]:
    """Return the lines of a transcription with their numbers, without blank lines, page marks and typesetting marks.

    If most letters outside of prose are lower-case, as in a retyped text, all letters become capitals.  A form feed
    does not end a line.
    """
    raw_lines = re.split(r"\r\n|\r|\n", text)
    letters = [c for line in raw_lines if not _PROSE.search(line) for c in line if c.isalpha()]
    is_small = sum(map(str.islower, letters)) > len(letters) / 2
    lines = []
    for number, raw in enumerate(raw_lines, 1):
        cleaned = _NOISE.sub(" ", unicodedata.normalize("NFKC", raw.translate(_TYPOGRAPHY)))
        if cleaned.strip() and not raw.startswith(PAGE_MARK):
            lines.append((number, cleaned.upper() if is_small else cleaned))
    return lines


def _forms(lines: list[tuple[int, str]]) -> Iterator[list[tuple[int, str]]]:
    """Yield the lines unchanged, and also without line numbers, columns 73 to 80, or both, if most lines have them."""
    yield lines
    numbers = [_LINE_NUMBER.match(line) for _, line in lines]
    rising, before, line_before = 0, 0, 0
    for match, (line_number, _) in zip(numbers, lines, strict=True):
        value = int(match[1]) if match else 0
        rising += value == 1 or (value > 1 and value - before in (1, line_number - line_before))
        before, line_before = value, line_number
    yield from _without_identification(lines)
    if rising >= _MOST * len(lines):
        pairs = zip(lines, numbers, strict=True)
        stripped = [(n, line[match.end() :] if match else line) for (n, line), match in pairs]
        yield stripped
        yield from _without_identification(stripped)


def _without_identification(lines: list[tuple[int, str]]) -> Iterator[list[tuple[int, str]]]:
    """Yield the lines without columns 73 to 80 if most lines have them."""
    cards = [_IDENTIFICATION.match(line) for _, line in lines]
    if sum(map(bool, cards)) >= _MOST * len(lines):
        yield [(n, card[1] if card else line) for (n, line), card in zip(lines, cards, strict=True)]


def align(text: str) -> Texts:
    """Return, for each card that a transcription contains, its characters without blanks and the numbers of its lines.

    The keys are the indices of the cards in the edition.
    """
    every = edition_cards()
    index = _Index(every)
    best: tuple[float, list[int], list[str], list[Span]] = (0.0, [], [], [])
    for form in _forms(read_lines(text)):
        pieces = [(number, solid(piece)) for line in form for number, piece in index.divided(*line)]
        lines = [piece for _, piece in pieces]
        spans = [span for run in _span_runs(_best_path(lines, index)) if _is_clear(run, lines, index) for span in run]
        gain = sum(span.gain for span in spans)
        best = max(best, (gain, [number for number, _ in pieces], lines, spans), key=lambda result: result[0])
    _, numbers, lines, spans = best
    if not spans:
        return {}
    texts: Texts = {}
    used: set[int] = set()
    for span in sorted(spans, key=lambda s: -s.gain):
        used.update(span.lines)
        if any(card in texts for card in span.cards):
            continue
        joined = "".join(_unhyphenated(lines[n], n < span.lines[-1]) for n in span.lines)
        span_numbers = tuple(numbers[n] for n in span.lines)
        divided = divide(joined, [every[card].solid for card in span.cards])
        texts.update((card, (piece, span_numbers)) for card, piece in zip(span.cards, divided, strict=True))
    _place_strays(lines, numbers, used, texts, index)
    _join_labels(lines, numbers, used, texts, every)
    return texts


def _unhyphenated(line: str, continues: bool) -> str:
    return line.removesuffix("-") if continues else line


class _Index:
    """An index that finds cards, with or without their statement numbers, by the trigrams of their folded texts."""

    def __init__(self, cards: Sequence[EditionCard]) -> None:
        self.cards = cards
        self.owners: dict[str, list[int]] = defaultdict(list)
        for n, card in enumerate(cards):
            for text in {card.solid, card.text}:
                self.owners[folded(text)].append(n)
        self.postings: dict[str, list[str]] = defaultdict(list)
        for text in self.owners:
            for gram in set(_trigrams(text)):
                self.postings[gram].append(text)

    def candidates(self, line: str) -> list[tuple[str, float]]:
        """Return the card texts that are most similar to a folded line, with the points that each gains.

        A card text gains a point for each of its characters and loses two for each difference.
        """
        shared: Counter[str] = Counter()
        for gram in set(_trigrams(line)):
            shared.update(self.postings.get(gram, ()))
        likely = sorted(shared, key=lambda text: -shared[text] / (len(text) + len(line)))[:CANDIDATES]
        gains = []
        for text in likely:
            differing, size = distance(text, line), max(len(text), len(line))
            if differing <= NO_MATCH * size:
                gains.append((text, size - 2.0 * differing))
        return gains

    def fused(self, line: str) -> Iterator[tuple[tuple[int, ...], float]]:
        """Yield each pair of consecutive cards that a folded line may contain, with the points that it gains."""
        starts = {
            n for text, owners in self.owners.items() if len(text) > 3 and line.startswith(text[:4]) for n in owners
        }
        for n in starts:
            if n + 1 < len(self.cards):
                text = folded(self.cards[n].solid + self.cards[n + 1].solid)
                differing = distance(text, line)
                if differing <= POOR * len(text) + 1:
                    yield (n, n + 1), len(text) - 2.0 * differing

    def divided(self, number: int, line: str) -> Iterator[tuple[int, str]]:
        """Divide a line that contains more than two cards, and yield the pieces with the number of the line.

        A sequence of eight characters that occurs only once in the cards identifies its card and is called an anchor.
        """
        text = solid(line)
        if len(text) <= LONGEST:
            yield number, line
            return
        joined, owner = "", []
        for n, card in enumerate(self.cards):
            joined += folded(card.solid)
            owner += [n] * len(card.solid)
        anchors = []
        for at in range(len(text) - 8):
            gram = folded(text[at : at + 8])
            first = joined.find(gram)
            if first >= 0 and joined.find(gram, first + 1) < 0:
                anchors.append(owner[first])
        anchors.sort()
        near = [n for n in anchors if abs(n - anchors[len(anchors) // 2]) < len(text) // 4]
        # A line of prose may share a few characters with a card by chance.
        if len(near) * FEW < len(text):
            yield number, line
            return
        # The ends of the line may have no anchor, so one card more is tried on either side.
        pieces = divide(text, [card.solid for card in self.cards[max(near[0] - 1, 0) : near[-1] + 2]])
        yield from ((number, piece) for piece in pieces if piece)


def _trigrams(text: str) -> Iterator[str]:
    padded = f"^{text}$"
    return (padded[n : n + 3] for n in range(len(padded) - 2))


@dataclass(slots=True)
class _Node:
    span: Span
    score: float
    before: "_Node | None"


def _best_path(lines: Sequence[str], index: _Index) -> list[Span]:
    """Return the spans of the best path through all lines by the Viterbi search (see the docstring of the module)."""
    # For each card, the best path that ends with it; before the current line, and before the line before that.
    ends: dict[int, _Node] = {}
    earlier: dict[int, _Node] = {}
    poor_before = False
    for n, line in enumerate(lines):
        text = folded(line)
        single = index.candidates(text)
        best = max((gain for _, gain in single), default=0.0)
        poor = best < len(text) * (1 - 2 * POOR)
        spans = [Span((n,), (card,), gain) for match, gain in single for card in index.owners[match]]
        if best < len(text) - 4:
            spans += [Span((n,), cards, gain) for cards, gain in index.fused(text)]
        nodes = [_extended(ends, span) for span in spans]
        if n and (poor or poor_before):
            whole = folded(_unhyphenated(lines[n - 1], True) + line)
            pairs = [Span((n - 1, n), (c,), g - 1) for match, g in index.candidates(whole) for c in index.owners[match]]
            nodes += [_extended(earlier, span) for span in pairs]
        earlier, poor_before = dict(ends), poor
        for extended in nodes:
            last = extended.span.cards[-1]
            if last not in ends or extended.score > ends[last].score:
                ends[last] = extended
    path = []
    node: _Node | None = max(ends.values(), key=lambda end: end.score, default=None)
    while node is not None:
        path.append(node.span)
        node = node.before
    return path[::-1]


def _span_runs(spans: Sequence[Span]) -> Iterator[list[Span]]:
    """Divide a path at its jumps, and yield the spans of each part."""
    run: list[Span] = []
    for span in spans:
        if run and not 0 < span.cards[0] - run[-1].cards[-1] <= FARTHEST:
            yield run
            run = []
        run.append(span)
    if run:
        yield run


def _is_clear(run: Sequence[Span], lines: Sequence[str], index: _Index) -> bool:
    """Return True if spans gain more points than a jump costs, and their lines resemble no other cards equally well."""
    if sum(span.gain for span in run) <= JUMP:
        return False

    def differing(span: Span, offset: int) -> int:
        cards = [index.cards[card + offset] for card in span.cards]
        line = folded("".join(_unhyphenated(lines[n], n < span.lines[-1]) for n in span.lines))
        rest = "".join(card.solid for card in cards[1:])
        return min(distance(folded(text + rest), line) for text in (cards[0].solid, cards[0].text))

    first, last = run[0].cards[0], run[-1].cards[-1]
    texts = {folded(text) for text in (index.cards[first].solid, index.cards[first].text)}
    offsets = {n - first for text in texts for n in index.owners[text]} - {0}
    return not any(
        last + offset < len(index.cards) and all(differing(span, offset) <= differing(span, 0) for span in run)
        for offset in offsets
    )


def _extended(ends: Mapping[int, _Node], span: Span) -> _Node:
    best: _Node | None = None
    score = -JUMP / 2
    if ends:
        anywhere = max(ends.values(), key=lambda end: end.score)
        best, score = anywhere, anywhere.score - JUMP
        for steps in range(1, FARTHEST + 1):
            before = ends.get(span.cards[0] - steps)
            cost = 0.0 if steps == 1 else SKIP + SKIP_CARD * (steps - 1)
            if before is not None and before.score - cost > score:
                best, score = before, before.score - cost
    return _Node(span, score + span.gain, best)


def _place_strays(lines: Sequence[str], numbers: Sequence[int], used: set[int], texts: Texts, index: _Index) -> None:
    """Assign each unused line to the only missing card that it resembles, if it has at least eight characters."""
    for n, line in enumerate(lines):
        if n in used or len(line) < 8:
            continue
        matches = [(text, gain) for text, gain in index.candidates(folded(line)) if gain >= len(line) * (1 - 2 * POOR)]
        missing = {card for text, _ in matches for card in index.owners[text] if card not in texts}
        if len(missing) == 1:
            texts[missing.pop()] = line, (numbers[n],)
            used.add(n)


def _join_labels(
    lines: Sequence[str], numbers: Sequence[int], used: set[int], texts: Texts, every: Sequence[EditionCard]
) -> None:
    """Put statement numbers before their statements if the OCR has put the numbers into a separate column."""
    line_of = {number: n for n, number in enumerate(numbers)}
    lacking = [
        n for n in sorted(texts) if every[n].label and not folded(texts[n][0]).startswith(folded(every[n].label)[:2])
    ]
    runs = list(_runs([n for n, line in enumerate(lines) if n not in used and len(line) <= 5]))
    for run, likeness in ((run, likeness) for likeness in (1.0, 0.2) for run in runs):
        # The statements stand on the same page: within sixty lines of the column of numbers.
        unused = [n for n in run if n not in used]
        near = [c for c in lacking if abs(line_of[texts[c][1][0]] - run[0]) < 60 + len(run)]
        labels = [folded(every[c].label) for c in near]
        for line, card in _common([folded(lines[n]) for n in unused], labels, likeness):
            text, text_numbers = texts[near[card]]
            texts[near[card]] = lines[unused[line]] + text, (numbers[unused[line]], *text_numbers)
            used.add(unused[line])
            lacking.remove(near[card])


def _runs(numbers: Sequence[int]) -> Iterator[list[int]]:
    """Yield the runs of at least three numbers in which each number exceeds the previous one by one or two."""
    run: list[int] = []
    for n in (*numbers, 10**9):
        if run and n - run[-1] > 2:
            if len(run) > 2:
                yield run
            run = []
        run.append(n)


def _common(a: Sequence[str], b: Sequence[str], likeness: float) -> list[tuple[int, int]]:
    """Align two sequences of texts.  Return the indices of aligned texts, whose likeness is at least ``likeness``.

    The likeness of equal texts is 1.
    """
    best = [[0.0] * (len(b) + 1) for _ in range(len(a) + 1)]
    alike = [[1 - 1.5 * distance(x, y) / max(len(x), len(y)) for y in b] for x in a]
    alike = [[value if value >= likeness else 0.0 for value in row] for row in alike]
    for i in range(len(a) - 1, -1, -1):
        for j in range(len(b) - 1, -1, -1):
            best[i][j] = max(best[i + 1][j], best[i][j + 1], best[i + 1][j + 1] + alike[i][j])
    pairs, i, j = [], 0, 0
    while i < len(a) and j < len(b):
        if alike[i][j] and best[i][j] == best[i + 1][j + 1] + alike[i][j]:
            pairs.append((i, j))
            i, j = i + 1, j + 1
        elif best[i][j] == best[i + 1][j]:
            i += 1
        else:
            j += 1
    return pairs
