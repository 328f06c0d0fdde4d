"""Build a text by applying the rows of its apparatus to its witness.

A *witness* is the OCR text of a printed page, kept verbatim.  Lines that begin with ``## `` are page marks.  The editor
added the page marks, and they are not part of the witness.  A *row* is one emendation: its place, the reading of the
witness, the accepted reading (the lemma), the reason and the evidence.  :func:`build` applies the rows of the chosen
layers.  Each line of the result names the witness line or the row that it comes from.

``fortran_src/README.md`` describes the file format.  This module knows nothing about FORTRAN or hulls.
"""

import re
import tomllib
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import date
from functools import lru_cache
from importlib.resources.abc import Traversable
from typing import Any, Literal

from emulator.errors import EmulatorError

PAGE_MARK = "## page "
LAST_COLUMN = 72
# The layers whose text the project supplied.
_OURS = ("lacuna", "examples", "epsilon", "translation", "corrected")
# The kinds of rows that insert text that the witness lacks.
_ADDS = ("lost", "lost-sign", "slip")
_CAUSES = ("ocr", "typist", "author", "editor", "undecidable")
# The default cause of the rows of a layer.  For all other layers it is ``editor``.
_CAUSE = {"ocr": "ocr", "typist": "typist", "author": "author", "print": "undecidable", "lacuna": "undecidable"}
_FIELDS = ("id", "layer", "kind", "reason", "evidence", "change")
_OPTIONAL = ("ground", "cause", "editor", "date", "rdg")
Certainty = Literal["certain", "probable", "conjecture"]


class ApparatusError(EmulatorError, ValueError):
    """Raised if a row of the apparatus is invalid or does not fit the text.  The message names the row."""


@dataclass(frozen=True, slots=True)
class Change:
    """One change of a row.

    ``line`` is the id of a line: the number of a witness line ("17") or the id of an inserted card ("P1-031.2").
    ``lemma`` replaces the fragment ``witness``, which must occur exactly once in the line.  A lemma that contains line
    ends produces several lines.  A line that becomes empty is removed from the text.

    With ``after``, nothing is replaced: the lines of the lemma are inserted after the line.  With ``through``, all
    lines from ``line`` to ``through`` are removed.  With ``through`` and ``form``, these lines are kept but arranged as
    on the coding form (:func:`on_form`).  With ``dense``, the blanks of the line are removed.
    """

    line: str
    witness: str = ""
    lemma: str = ""
    after: bool = False
    through: str = ""
    form: bool = False
    dense: bool = False


@dataclass(frozen=True, slots=True)
class Rejected:
    """A reading that the editor considered and rejected, with the reason."""

    reading: str
    reason: str


@dataclass(frozen=True, slots=True)
class Row:
    """One emendation with its reasons.

    ``cause`` is the origin of the error: ``ocr``, ``typist``, ``author``, ``editor`` or ``undecidable``.  ``page`` is
    derived from the witness lines that the row changes.  ``confirmed`` is True if someone who read the printed page has
    reported the accepted reading.
    """

    id: str
    text: str
    layer: str
    kind: str
    reason: str
    evidence: str
    changes: tuple[Change, ...]
    ground: Mapping[str, Any] = field(default_factory=dict)
    cause: str = "ocr"
    editor: str = ""
    date: str = ""
    rejected: tuple[Rejected, ...] = ()
    page: str = ""
    confirmed: bool = False

    @property
    def certainty(self) -> Certainty:
        """The certainty of the accepted reading, by the first of these rules that applies (fortran_src/README.md).

        A reading that the page confirms is certain.  Cards added by the project and text supplied for a gap are
        conjectures.  A reading is probable if the error may be the author's or the typist's, if its cause is
        undecidable, or if only a similar passage or card supports the reading.  All other readings are certain.
        """
        if self.confirmed:
            return "certain"
        if self.layer in _OURS or not self.ground:
            return "conjecture"
        rests_on_likeness = (self.ground["kind"] == "sibling" and self.kind in _ADDS) or (
            self.ground["kind"] == "forced" and "equation" not in self.ground
        )
        rests_on_whole = self.ground.get("whole", False) or self.ground.get("check") == "minus-with-point"
        cause_in_doubt = self.cause not in ("ocr", "editor") and self.layer != "print"
        if cause_in_doubt or rests_on_likeness or rests_on_whole:
            return "probable"
        return "certain"

    @property
    def witness(self) -> str:
        """The reading of the witness as one line: the fragments of all changes, joined with vertical bars."""
        return " | ".join(_shown(change.witness) or _scope(change) for change in self.changes)

    @property
    def lemma(self) -> str:
        """The accepted reading as one line: the lemmas of all changes, joined with vertical bars."""
        return " | ".join(_shown(change.lemma) or _effect(change) for change in self.changes)


@dataclass(frozen=True, slots=True)
class Line:
    """A line of a built text: its id, its text, its page, and the rows that changed it."""

    id: str
    text: str
    page: str
    rows: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Text:
    """A witness with its rows, its layers in the order in which they are applied, and the layers applied by default."""

    id: str
    title: str
    witness: tuple[Line, ...]
    rows: tuple[Row, ...]
    layers: tuple[str, ...]
    default: tuple[str, ...]

    def row(self, row_id: str) -> Row:
        for row in self.rows:
            if row.id == row_id:
                return row
        raise ApparatusError(f"{self.id} has no row {row_id}")


def read_witness(source: str, furniture: Collection[str] = ()) -> tuple[Line, ...]:
    """Return the lines of a witness.  Their ids are line numbers from 1, which do not count page marks.

    Blank lines and the lines in ``furniture``, such as code fences, are counted but not returned.
    """
    lines: list[Line] = []
    page, number = "", 0
    for raw in source.split("\n"):
        if raw.startswith(PAGE_MARK):
            page = raw[len(PAGE_MARK) :].strip()
            continue
        number += 1
        if raw.strip() and raw not in furniture:
            lines.append(Line(str(number), raw.rstrip("\r"), page))
    return tuple(lines)


def load(folder: Traversable, name: str) -> Text:
    """Read the apparatus and the witness of a text from a data folder. Raise ApparatusError if a row is invalid."""
    entry = folder.joinpath("apparatus", f"{name}.toml")
    if not entry.is_file():
        entry = folder.joinpath(f"{name}.toml")
    data = tomllib.loads(entry.read_text(encoding="utf-8"))
    head = data["text"]
    witness = folder.joinpath(*str(head["witness"]).split("/")).read_text(encoding="utf-8")
    lines = read_witness(witness, tuple(head.get("furniture", ())))
    layers = tuple(head["layers"])
    rows = tuple(_row(head, raw) for raw in data.get("row", ()))
    pages, origins = {line.id: line.page for line in lines}, {row.id: row for row in rows}
    rows = tuple(_with_page(row, pages, origins) for row in rows)
    for row_id, times in Counter(row.id for row in rows).items():
        if times > 1:
            raise ApparatusError(f"{head['id']}: row id {row_id} is used {times} times")
    return Text(head["id"], head["title"], lines, rows, layers, tuple(head["default"]))


def confirmed(text: Text, ids: Collection[str]) -> Text:
    """Return the text with the rows of these ids marked as confirmed by the page."""
    return replace(text, rows=tuple(replace(row, confirmed=row.id in ids) for row in text.rows)) if ids else text


def build(
    text: Text, layers: Iterable[str] | None = None, without: Collection[str] = (), instead: Row | None = None
) -> tuple[Line, ...]:
    """Return the lines of the witness after applying the rows of ``layers`` (by default the text's default layers).

    The rows whose ids are in ``without`` are not applied.  ``instead`` replaces the row with the same id.  Layers are
    applied in the order of ``text.layers``.  Raise ApparatusError for an unknown layer, and RowMisfit if the witness
    fragment of a row does not occur exactly once in its line.
    """
    chosen = set(text.default if layers is None else layers)
    unknown = chosen.difference(text.layers)
    if unknown:
        raise ApparatusError(f"{text.id} has no layer {', '.join(sorted(unknown))}; it has {', '.join(text.layers)}")
    order = tuple(layer for layer in text.layers if layer in chosen)
    page = _Page(text.witness)
    for row in (row for layer in order for row in text.rows if row.layer == layer):
        if row.id not in without:
            page.apply(instead if instead and row.id == instead.id else row)
    return tuple(line for line in page.lines() if line.text.strip())


def built_without(text: Text, row_id: str) -> tuple[frozenset[str], tuple[Line, ...]]:
    """Return the ids of a row and of the rows that depend on it, and the text of all layers without these rows.

    Row B depends on row A if B changes a card that A inserts, or a fragment that A supplies.
    """
    removed = {row_id}
    while True:
        try:
            lines = build(text, text.layers, removed)
        except RowMisfit as misfit:
            removed.add(misfit.row_id)
        else:
            return frozenset(removed), lines


class RowMisfit(ApparatusError):
    """Raised if the fragment that a row replaces does not occur at the place that the row names."""

    def __init__(self, row_id: str, message: str) -> None:
        super().__init__(f"row {row_id}: {message}")
        self.row_id = row_id


class _Page:
    def __init__(self, lines: Iterable[Line]) -> None:
        self._at = {line.id: line for line in lines}
        self._order = list(self._at)

    def lines(self) -> Iterator[Line]:
        return (self._at[name] for name in self._order)

    def apply(self, row: Row) -> None:
        inserted = 0
        for change in row.changes:
            line = self._line(row, change.line)
            if change.through:
                self._line(row, change.through)
                first, last = self._order.index(change.line), self._order.index(change.through)
                for name in self._order[first : last + 1]:
                    text = on_form(self._at[name].text) if change.form else ""
                    self._put(row, self._at[name], text)
            elif change.after:
                inserted = self._insert(row, line, change.lemma.split("\n"), inserted)
            elif change.dense:
                self._put(row, line, "".join(line.text.split()))
            else:
                times = line.text.count(change.witness)
                if times != 1:
                    raise RowMisfit(row.id, f"{change.witness!r} occurs {times} times in line {line.id}: {line.text!r}")
                first_piece, *rest = line.text.replace(change.witness, change.lemma).split("\n")
                self._put(row, line, first_piece)
                inserted = self._insert(row, line, rest, inserted)

    def _line(self, row: Row, name: str) -> Line:
        if name not in self._at:
            raise RowMisfit(row.id, f"line {name} does not exist")
        return self._at[name]

    def _put(self, row: Row, line: Line, text: str) -> None:
        self._at[line.id] = Line(line.id, text, line.page, (*line.rows, row.id))

    def _insert(self, row: Row, behind: Line, texts: Sequence[str], inserted: int) -> int:
        """Insert lines of a row after the line ``behind``, and return how many lines the row has inserted so far."""
        if texts:
            new = [f"{row.id}.{inserted + k}" for k in range(1, len(texts) + 1)]
            at = self._order.index(behind.id) + 1
            self._order[at:at] = new
            for name, text in zip(new, texts, strict=True):
                self._at[name] = Line(name, text, behind.page, (row.id,))
        return inserted + len(texts)


@lru_cache(4096)
def on_form(text: str) -> str:
    """Return a card arranged as on the coding form (form C26-5619, p. 12).

    The statement number is in columns 1 to 5.  The statement begins in column 7, or directly after its number if it
    would otherwise extend beyond column 72.  Comments are not changed.
    """
    if text.startswith("C  "):
        return text
    label_and_statement = text.strip()
    number = re.match(r"\d*", label_and_statement)
    label = number[0] if number else ""
    statement = label_and_statement[len(label) :].strip()
    card = f"{label:>5} {statement}"
    return card if len(card) <= LAST_COLUMN else label + statement


def _row(head: Mapping[str, Any], raw: Mapping[str, Any]) -> Row:
    name, text_id, layers = str(raw.get("id", "(without id)")), head["id"], head["layers"]
    missing = [k for k in _FIELDS if k not in raw]
    if missing:
        raise ApparatusError(f"{text_id}: row {name} lacks {', '.join(missing)}")
    unknown = [k for k in raw if k not in (*_FIELDS, *_OPTIONAL)]
    if unknown:
        raise ApparatusError(f"{text_id}: row {name} has the unknown field {', '.join(unknown)}")
    if raw["layer"] not in layers:
        expected = ", ".join(layers)
        raise ApparatusError(f"{text_id}: row {name}: unknown layer {raw['layer']!r}; expected one of {expected}")
    cause = str(raw.get("cause", _CAUSE.get(raw["layer"], "editor")))
    if cause not in _CAUSES:
        raise ApparatusError(f"{text_id}: row {name}: unknown cause {cause!r}; expected one of {', '.join(_CAUSES)}")
    try:
        changes = tuple(Change(**change) for change in raw["change"])
    except TypeError as error:
        raise ApparatusError(f"{text_id}: row {name}: a change with a missing or an unknown field: {error}") from None
    for change in changes:
        if not (change.witness or change.after or change.through or change.dense):
            raise ApparatusError(
                f"{text_id}: row {name}: a change needs one of the fields `witness`, `after`, `through` and `dense`"
            )
    rejected = tuple(Rejected(str(r.get("reading", "")), str(r.get("reason", ""))) for r in raw.get("rdg", ()))
    if not all(r.reading and r.reason for r in rejected):
        raise ApparatusError(f"{text_id}: row {name}: a rejected reading needs a reading and a reason")
    when = raw.get("date", head.get("date", ""))
    return Row(
        id=name,
        text=text_id,
        layer=raw["layer"],
        kind=raw["kind"],
        reason=raw["reason"],
        evidence=raw["evidence"],
        changes=changes,
        ground=dict(raw.get("ground", {})),
        cause=cause,
        editor=str(raw.get("editor", head.get("editor", ""))),
        date=when.isoformat() if isinstance(when, date) else str(when),
        rejected=rejected,
    )


def _with_page(row: Row, pages: Mapping[str, str], origins: Mapping[str, Row]) -> Row:
    def page(line: str) -> str:
        if line in pages:
            return pages[line]
        maker = origins.get(line.rpartition(".")[0])
        return page(maker.changes[0].line) if maker and maker is not row else ""

    touched = {page(line) for change in row.changes for line in (change.line, change.through) if line}
    in_order = [name for name in dict.fromkeys(pages.values()) if name in touched]
    return replace(row, page="-".join(in_order if len(in_order) < 2 else (in_order[0], in_order[-1])))


def _shown(text: str) -> str:
    return text.replace("\n", " / ")


def _effect(change: Change) -> str:
    return "(set out as on the form)" if change.form else "(without blanks)" if change.dense else "-"


def _scope(change: Change) -> str:
    if change.dense:
        return f"(line {change.line}, spread out)"
    if change.after:
        return f"(nothing after line {change.line})"
    return f"(lines {change.line} to {change.through})"
