"""A text with both readings of every emendation, for TEI's parallel segmentation (TEI P5 Guidelines, 12.2.3).

:func:`modern.edition.apparatus.build` applies rows and returns only the resulting text.  The present module turns the
same rows into *places*.  A place is a piece of a line with its reading before the row, its reading after the row, and
the row.  Places are nested, because a row of a later layer may change the result of an earlier row.  :func:`reading`
returns the text with any choice of layers.

A place contains only the text that changes.  A row that arranges a card in columns has places of blanks only.  A word
that a row moves has two places: one where it disappears and one where it appears.
"""

from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace

from modern.edition.apparatus import Change, Row, RowMisfit, Text, on_form
from modern.edition.edits import Edit, blank_edits, common_prefix, moving_edits, word_edits
from modern.edition.readings import solid


@dataclass(frozen=True, slots=True)
class Place:
    """A piece of a line with two readings: ``old`` before the row is applied, ``new`` after it.

    ``moved`` is 0, or the number of a group of words that a row moves together.  The place that the words leave and the
    place that they enter have the same number.
    """

    row: Row
    old: "tuple[Piece, ...]"
    new: "tuple[Piece, ...]"
    moved: int = 0


Piece = str | Place


@dataclass(frozen=True, slots=True)
class Segments:
    """A line divided into pieces, with the ``id`` and ``page`` of its :class:`modern.edition.apparatus.Line`."""

    id: str
    page: str
    pieces: tuple[Piece, ...]

    @property
    def inserted(self) -> bool:
        return not self.id.isdigit()


def reading(pieces: Iterable[Piece], layers: Collection[str]) -> str:
    """Return the text of the pieces after applying the rows of the given layers."""
    return "".join(
        piece if isinstance(piece, str) else reading(piece.new if piece.row.layer in layers else piece.old, layers)
        for piece in pieces
    )


def segments(text: Text) -> tuple[Segments, ...]:
    """Return every line of a text divided into pieces.  The emended pieces are places."""
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
        if row.kind == "displaced":
            for change, edits in zip(row.changes, moving_edits(row.changes), strict=True):
                self._rewrite(row, change, edits)
            return
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
        line, old = self.lines[number], self._text(number)
        if solid(old) != solid(new):
            self.lines[number] = replace(line, pieces=(Place(row, line.pieces, _pieces(new)),))
        elif solid(new):
            self._edit(row, number, 0, blank_edits(old, new))

    def _edit(self, row: Row, number: int, offset: int, edits: Iterable[Edit]) -> None:
        line = self.lines[number]
        ordered = sorted(edits, key=lambda edit: (edit.first, edit.last))
        # From right to left, because an edit changes the indices of the characters after it.
        for edit in ordered[::-1]:
            place = Place(row, (), _pieces(edit.new), edit.moved)
            pieces = _changed(line.pieces, offset + edit.first, offset + edit.last, place, self._layers)
            line = replace(line, pieces=pieces)
        self.lines[number] = line

    def _first(self, row: Row, change: Change, at: int) -> int:
        text = self._text(at)
        if text.count(change.witness) != 1:
            raise RowMisfit(row.id, f"{change.witness!r} does not occur exactly once in line {change.line}: {text!r}")
        return text.index(change.witness)

    def _rewrite(self, row: Row, change: Change, edits: Iterable[Edit]) -> None:
        # The words of the fragment change first, and then the blanks between them.
        at = self._find(row, change.line)
        first, text = self._first(row, change, at), self._text(at)
        self._edit(row, at, first, edits)
        self._whole(row, at, text[:first] + change.lemma + text[first + len(change.witness) :])

    def _replace(self, row: Row, change: Change, at: int, inserted: int) -> int:
        first, text = self._first(row, change, at), self._text(at)
        last = first + len(change.witness)
        lemma, *rest = change.lemma.split("\n")
        if rest:
            # The rest of the line after the fragment moves to the end of the last new line.
            rest[-1] += text[last:]
            last = len(text)
        elif row.layer in self._default:
            self._rewrite(row, change, word_edits(change.witness, lemma))
            return inserted
        # Optional layers can be combined, and two of them may change the same statement.  A place of such a layer
        # therefore holds only the characters that differ.
        head = common_prefix(text[first:last], lemma)
        first, lemma = first + head, lemma[head:]
        if not rest:
            tail = common_prefix(text[first:last][::-1], lemma[::-1])
            last, lemma = last - tail, lemma[: len(lemma) - tail]
        self._edit(row, at, 0, [Edit(first, last, lemma)])
        return self._insert(row, at, rest, inserted)

    def _insert(self, row: Row, at: int, texts: list[str], inserted: int) -> int:
        page = self.lines[at].page
        new = [
            Segments(f"{row.id}.{inserted + number}", page, (Place(row, (), _pieces(text)),))
            for number, text in enumerate(texts, 1)
        ]
        self.lines[at + 1 : at + 1] = new
        return inserted + len(texts)


def _pieces(text: str) -> tuple[Piece, ...]:
    return (text,) if text else ()


def _changed(
    pieces: tuple[Piece, ...], first: int, last: int, place: Place, layers: Collection[str]
) -> tuple[Piece, ...]:
    """Return the pieces of a line with ``place`` instead of the characters ``first`` to ``last`` of its text.

    If an earlier place contains the whole fragment, the new place is put into the new reading of the earlier place.  If
    an earlier place contains only a part of the fragment, the whole earlier place becomes part of the old reading.  The
    text of the earlier place outside the fragment is then repeated in both readings.
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
            inner = _changed(piece.new, first - start, last - start, place, layers)
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
    new = _pieces(text_before + reading(place.new, layers) + text_after)
    return (*before, replace(place, old=tuple(within), new=new), *behind)
