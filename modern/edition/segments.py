"""A text with both readings of every emendation, for TEI's parallel segmentation (TEI P5 Guidelines, 12.2.3).

:func:`modern.edition.apparatus.build` applies rows and returns only the result.  Here the same rows produce *places*.
A place is a piece of a line with its old reading, its new reading and the row.  Places nest, because a row of a later
layer may change the result of an earlier one.  :func:`reading` extracts the text with any choice of layers from this
tree.
"""

from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace

from modern.edition.apparatus import Change, Row, RowMisfit, Text, on_form


@dataclass(frozen=True, slots=True)
class Place:
    """A piece of a line with two readings: ``old`` before the row is applied, ``new`` after it."""

    row: Row
    old: "tuple[Piece, ...]"
    new: "tuple[Piece, ...]"


Piece = str | Place


@dataclass(frozen=True, slots=True)
class Segments:
    """A line in pieces, with the ``id`` and ``page`` of its :class:`modern.edition.apparatus.Line`."""

    id: str
    page: str
    pieces: tuple[Piece, ...]

    @property
    def inserted(self) -> bool:
        return not self.id.isdigit()


def reading(pieces: Iterable[Piece], layers: Collection[str]) -> str:
    """Return the text of the pieces after the rows of these layers."""
    return "".join(
        piece if isinstance(piece, str) else reading(piece.new if piece.row.layer in layers else piece.old, layers)
        for piece in pieces
    )


def segments(text: Text) -> tuple[Segments, ...]:
    """Return every line of a text with the rows of all layers as places.  Raises RowMisfit as ``build`` does."""
    segmented = _SegmentedText(text)
    for layer in text.layers:
        for row in text.rows:
            if row.layer == layer:
                segmented.apply(row)
    return tuple(segmented.lines)


class _SegmentedText:
    """The lines of a text to which rows are applied one after another."""

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
        raise RowMisfit(row.id, f"line {name} does not exist")

    def _text(self, number: int) -> str:
        return reading(self.lines[number].pieces, self._layers)

    def _whole(self, row: Row, number: int, new: str) -> None:
        line = self.lines[number]
        if self._text(number) != new:
            self.lines[number] = replace(line, pieces=(Place(row, line.pieces, _pieces(new)),))

    def _replace(self, row: Row, change: Change, at: int, inserted: int) -> int:
        text = self._text(at)
        if text.count(change.witness) != 1:
            raise RowMisfit(row.id, f"{change.witness!r} does not occur exactly once in line {change.line}: {text!r}")
        first = text.index(change.witness)
        last = first + len(change.witness)
        lemma, *rest = change.lemma.split("\n")
        if row.layer not in self._default:
            # Optional layers can be combined, and two of them may change the same statement.  A place of such a layer
            # therefore holds only the characters that differ.
            first, lemma = _trimmed(change.witness, first, lemma)
            if not rest:
                tail = _common_prefix(text[first:last][::-1], lemma[::-1])
                last, lemma = last - tail, lemma[: len(lemma) - tail]
        if rest:
            # The rest of the line after the fragment moves to the end of the last new line.
            rest[-1] += text[last:]
            last = len(text)
        line = self.lines[at]
        self.lines[at] = replace(line, pieces=_changed(line.pieces, first, last, row, lemma, self._layers))
        return self._insert(row, at, rest, inserted)

    def _insert(self, row: Row, at: int, texts: list[str], inserted: int) -> int:
        page = self.lines[at].page
        new = [
            Segments(f"{row.id}.{inserted + number}", page, (Place(row, (), _pieces(text)),))
            for number, text in enumerate(texts, 1)
        ]
        self.lines[at + 1 : at + 1] = new
        return inserted + len(texts)


def _trimmed(witness: str, first: int, lemma: str) -> tuple[int, str]:
    length = _common_prefix(witness, lemma)
    return first + length, lemma[length:]


def _common_prefix(a: str, b: str) -> int:
    return next((n for n, (x, y) in enumerate(zip(a, b, strict=False)) if x != y), min(len(a), len(b)))


def _pieces(text: str) -> tuple[Piece, ...]:
    return (text,) if text else ()


def _changed(
    pieces: tuple[Piece, ...], first: int, last: int, row: Row, lemma: str, layers: Collection[str]
) -> tuple[Piece, ...]:
    """Return the pieces with the characters ``first`` to ``last`` (of the text with all layers) turned into a place.

    If one place contains the whole fragment, the new place goes into its new reading.  A place that contains only a
    part of the fragment becomes part of the old reading, and the rest of its text is repeated in both readings.
    """
    before: list[Piece] = []
    within: list[Piece] = []
    behind: list[Piece] = []
    text_before = text_after = ""
    at = 0
    for number, piece in enumerate(pieces):
        text = piece if isinstance(piece, str) else reading((piece,), layers)
        start, end = at, at + len(text)
        at = end
        # The fragment lies inside this place: descend into its new reading.
        if isinstance(piece, Place) and start <= first and last <= end and (first < last or start < first < end):
            inner = _changed(piece.new, first - start, last - start, row, lemma, layers)
            return (*pieces[:number], replace(piece, new=inner), *pieces[number + 1 :])
        if end <= first:
            before.append(piece)
        elif start >= last:
            behind.append(piece)
        elif isinstance(piece, str):
            # Plain text is split at both ends of the fragment.
            before += _pieces(text[: max(first - start, 0)])
            within += _pieces(text[max(first - start, 0) : last - start])
            behind += _pieces(text[last - start :]) if last < end else ()
        else:
            # A place that the fragment overlaps only in part cannot be split, so the whole place becomes part of the
            # old reading.
            text_before += text[: max(first - start, 0)]
            text_after += text[last - start :] if last < end else ""
            within.append(piece)
    return (*before, Place(row, tuple(within), _pieces(text_before + lemma + text_after)), *behind)
