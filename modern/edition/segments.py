"""A text with both readings at every place: what a row found, and what it put there.

:func:`modern.edition.apparatus.build` applies rows and keeps the result.  Here the same rows make *places*: pieces
of a line that have an old and a new reading and know their row.  Places nest, since a row of a later layer may change
what an earlier one established.  From the tree every state of the text can be taken (:func:`reading`): the witness
where no layer is wanted, a deck where its layers are.  This is what parallel segmentation writes (TEI P5 Guidelines,
12.2.3).
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace

from modern.edition.apparatus import Change, Row, RowMisfit, Text, on_form


@dataclass(frozen=True, slots=True)
class Place:
    """A piece of a line with two readings: ``old`` where the row is not applied, ``new`` where it is."""

    row: Row
    old: tuple[Piece, ...]
    new: tuple[Piece, ...]


Piece = str | Place


@dataclass(frozen=True, slots=True)
class Segments:
    """A line in pieces; ``id`` and ``page`` as of :class:`modern.edition.apparatus.Line`."""

    id: str
    page: str
    pieces: tuple[Piece, ...]

    @property
    def inserted(self) -> bool:
        """Whether a row put the line in: the witness has no such line."""
        return not self.id.isdigit()


def reading(pieces: Iterable[Piece], layers: Collection[str]) -> str:
    """The text of pieces with the rows of these layers applied."""
    return "".join(
        piece if isinstance(piece, str) else reading(piece.new if piece.row.layer in layers else piece.old, layers)
        for piece in pieces
    )


def segments(text: Text) -> tuple[Segments, ...]:
    """Every line of a text, those put in too, with every row of every layer as places.

    Raises RowMisfit where a row does not fit, as ``build`` does.
    """
    work = _Work(text)
    for layer in text.layers:
        for row in text.rows:
            if row.layer == layer:
                work.apply(row)
    return tuple(work.lines)


class _Work:
    """The lines of a text in work."""

    def __init__(self, text: Text) -> None:
        self._layers = text.layers
        self._default = text.default
        self.lines = [Segments(line.id, line.page, (line.text,)) for line in text.witness]

    def apply(self, row: Row) -> None:
        inserted = 0
        for change in row.changes:
            at = self._find(row, change.line)
            if change.through:
                for number in range(at, self._find(row, change.through) + 1):
                    self._whole(row, number, on_form(self._text(number)) if change.form else "")
            elif change.after:
                inserted = self._insert(row, at, change.lemma.split("\n"), inserted)
            elif change.dense:
                self._whole(row, at, "".join(self._text(at).split()))
            else:
                inserted = self._replace(row, change, at, inserted)

    def _find(self, row: Row, name: str) -> int:
        for number, line in enumerate(self.lines):
            if line.id == name:
                return number
        raise RowMisfit(row.id, f"there is no line {name}")

    def _text(self, number: int) -> str:
        return reading(self.lines[number].pieces, self._layers)

    def _whole(self, row: Row, number: int, new: str) -> None:
        line = self.lines[number]
        if self._text(number) != new:
            self.lines[number] = replace(line, pieces=(Place(row, line.pieces, _one(new)),))

    def _replace(self, row: Row, change: Change, at: int, inserted: int) -> int:
        text = self._text(at)
        if text.count(change.witness) != 1:
            raise RowMisfit(row.id, f"{change.witness!r} does not stand once in line {change.line}: {text!r}")
        first = text.index(change.witness)
        last = first + len(change.witness)
        lemma, *rest = change.lemma.split("\n")
        if row.layer not in self._default:
            # Layers that combine freely may touch one statement; only what they change is theirs.
            first, lemma = _trimmed(change.witness, first, lemma)
            if not rest:
                tail = _same(text[first:last][::-1], lemma[::-1])
                last, lemma = last - tail, lemma[: len(lemma) - tail]
        if rest:
            # What stands after the fragment goes with the last of the new lines.
            rest[-1] += text[last:]
            last = len(text)
        line = self.lines[at]
        self.lines[at] = replace(line, pieces=_changed(line.pieces, first, last, row, lemma, self._layers))
        return self._insert(row, at, rest, inserted)

    def _insert(self, row: Row, at: int, texts: list[str], inserted: int) -> int:
        page = self.lines[at].page
        new = [
            Segments(f"{row.id}.{inserted + number}", page, (Place(row, (), _one(text)),))
            for number, text in enumerate(texts, 1)
        ]
        self.lines[at + 1 : at + 1] = new
        return inserted + len(texts)


def _trimmed(witness: str, first: int, lemma: str) -> tuple[int, str]:
    """Where a change begins, and its lemma, without the characters at its beginning that it leaves as they are."""
    same = _same(witness, lemma)
    return first + same, lemma[same:]


def _same(one: str, other: str) -> int:
    """How many characters two texts begin with alike."""
    return next((n for n, (a, b) in enumerate(zip(one, other, strict=False)) if a != b), min(len(one), len(other)))


def _one(text: str) -> tuple[Piece, ...]:
    return (text,) if text else ()


def _changed(
    pieces: tuple[Piece, ...], first: int, last: int, row: Row, lemma: str, layers: Collection[str]
) -> tuple[Piece, ...]:
    """Pieces with characters ``first`` to ``last`` (of the text that all layers give) made a place.

    A place that holds the whole fragment takes it into its new reading; one that holds a part of it becomes a part of
    the old reading, and what is left of its text stands on both sides.
    """
    before: list[Piece] = []
    within: list[Piece] = []
    behind: list[Piece] = []
    left = right = ""
    at = 0
    for number, piece in enumerate(pieces):
        words = piece if isinstance(piece, str) else reading((piece,), layers)
        start, end = at, at + len(words)
        at = end
        if isinstance(piece, Place) and start <= first and last <= end and (first < last or start < first < end):
            inner = _changed(piece.new, first - start, last - start, row, lemma, layers)
            return (*pieces[:number], replace(piece, new=inner), *pieces[number + 1 :])
        if end <= first:
            before.append(piece)
        elif start >= last:
            behind.append(piece)
        elif isinstance(piece, str):
            before += _one(words[: max(first - start, 0)])
            within += _one(words[max(first - start, 0) : last - start])
            behind += _one(words[last - start :]) if last < end else ()
        else:
            left += words[: max(first - start, 0)]
            right += words[last - start :] if last < end else ""
            within.append(piece)
    return (*before, Place(row, tuple(within), _one(left + lemma + right)), *behind)
