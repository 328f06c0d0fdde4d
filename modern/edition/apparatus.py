"""The executable apparatus: a text is its witness plus the rows of its apparatus.

A *witness* is the OCR text of the printed page, kept verbatim; lines beginning ``## `` are the editor's
page marks and no part of it.  A *row* is one emendation: where it applies, what the witness reads, what
is read instead (the lemma), why, and on what evidence.  :func:`build` applies the rows of chosen layers
and returns lines that still know which witness line, or which row, they came from.

The file format is described in ``fortran_src/README.md``.  Nothing here knows about FORTRAN or hulls.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import date
from functools import lru_cache
from importlib.resources.abc import Traversable
from typing import Any, Literal

from emulator.errors import EmulatorError

PAGE_MARK = "## page "
LAST_COLUMN = 72
_OURS = ("lacuna", "examples", "epsilon", "translation", "corrected")
_LIKENESS = ("sibling",)
_KEPT = 16
"""A page in work is kept before every sixteenth row."""
_ADDS = ("lost", "lost-sign", "slip")
"""Kinds that put in what the witness has not."""
_CAUSES = ("ocr", "typist", "author", "editor", "undecidable")
_CAUSE = {"ocr": "ocr", "typist": "typist", "author": "author", "print": "undecidable", "lacuna": "undecidable"}
"""The cause of a row that names none, by layer; of the other layers it is the editor."""
_FIELDS = ("id", "layer", "kind", "reason", "evidence", "change")
_OPTIONAL = ("ground", "cause", "editor", "date", "rdg")
Certainty = Literal["certain", "probable", "conjecture"]


class ApparatusError(EmulatorError, ValueError):
    """A row that cannot be read or does not fit the text; the message names the row."""


@dataclass(frozen=True, slots=True)
class Change:
    """One place of a row.

    ``line`` is a line's id: a witness line number ("17") or an inserted card ("P1-031.2").  ``witness`` is
    the fragment found there exactly once, ``lemma`` what replaces it; a lemma with line ends makes several
    lines.  A line emptied by a change is no line of the text.  With ``after`` the lemma's lines are inserted
    after the line instead; with ``through`` every line from ``line`` to ``through`` is dropped; with
    ``form`` they are set out as on the coding form: number in columns 1 to 5, statement from column 7, or from
    column 1 where that passes column 72.  With ``dense`` the line loses its blanks.
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
    """A reading considered and not accepted, and why."""

    reading: str
    reason: str


@dataclass(frozen=True, slots=True)
class Row:
    """One emendation, with what a reader of an edition has to know of it.

    ``cause`` says whose the departure is: of ``ocr``, ``typist``, ``author``, ``editor``, or ``undecidable``.
    ``page`` follows from the witness lines the row touches, ``certainty`` from layer, kind and ground; neither is
    stored.
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

    @property
    def certainty(self) -> Certainty:
        """How sure the reading is, by the first rule that applies (fortran_src/README.md).

        Cards of ours and what is conjectured to be missing: conjecture.  What may be the author's or the typist's, or
        whose cause is undecidable, and what rests on likeness to another place alone: probable.  The rest: certain.
        """
        if self.layer in _OURS or not self.ground:
            return "conjecture"
        likeness = self.ground["kind"] in _LIKENESS and self.kind in _ADDS
        whole = self.ground.get("whole", False) or self.ground.get("check") == "minus-with-point"
        departed = self.cause not in ("ocr", "editor") and self.layer != "print"
        if departed or likeness or whole:
            return "probable"
        return "certain"

    @property
    def witness(self) -> str:
        """The witness's reading, for a table: fragments joined with a vertical bar."""
        return " | ".join(_shown(change.witness) or _scope(change) for change in self.changes)

    @property
    def lemma(self) -> str:
        """The accepted reading, for a table."""
        return " | ".join(_shown(change.lemma) or _done(change) for change in self.changes)


@dataclass(frozen=True, slots=True)
class Line:
    """A line of a built text: its id, its words, its page, and the rows that touched it."""

    id: str
    text: str
    page: str
    rows: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Text:
    """A witness and its apparatus.  ``furniture`` are whole lines that are no part of any text (code fences)."""

    id: str
    title: str
    witness: tuple[Line, ...]
    rows: tuple[Row, ...]
    layers: tuple[str, ...]
    default: tuple[str, ...]
    pages: dict[tuple[str, ...], tuple[tuple[Row, ...], dict[int, _Page]]] = field(
        default_factory=dict, init=False, compare=False, repr=False
    )
    """By layers: their rows in order, and the page before some of them; builds that differ later have it in common."""

    def row(self, row_id: str) -> Row:
        for row in self.rows:
            if row.id == row_id:
                return row
        raise ApparatusError(f"{self.id}: there is no row {row_id}")


def read_witness(source: str, furniture: Collection[str] = ()) -> tuple[Line, ...]:
    """The lines of a witness, numbered from 1 without the page marks; furniture and blank lines are left out.

    The numbers count every line of the printed text's OCR, also those left out, so that a number is a place
    in the file a reader can find.
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
    """Read ``apparatus/NAME.toml`` (or ``NAME.toml``) of a data folder with the witness it names.

    Raises ApparatusError where a row lacks a field, uses an unknown layer or repeats an id.
    """
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
    seen: set[str] = set()
    for row in rows:
        if row.id in seen:
            raise ApparatusError(f"{head['id']}: row {row.id} stands twice")
        seen.add(row.id)
    return Text(head["id"], head["title"], lines, rows, layers, tuple(head["default"]))


def build(
    text: Text, layers: Iterable[str] | None = None, without: Collection[str] = (), instead: Row | None = None
) -> tuple[Line, ...]:
    """Witness plus the rows of ``layers`` (the text's default layers if None), leaving out rows ``without``.

    ``instead`` stands in the place of the text's row of its id.

    Layers apply in the text's own order whatever order they are asked for in, so that a later layer may
    change what an earlier one established.  Raises ApparatusError for an unknown layer and for a row whose
    witness fragment does not stand in its line exactly once.
    """
    wanted = set(text.default if layers is None else layers)
    unknown = wanted.difference(text.layers)
    if unknown:
        raise ApparatusError(f"{text.id} has no layer {', '.join(sorted(unknown))}; it has {', '.join(text.layers)}")
    order = tuple(layer for layer in text.layers if layer in wanted)
    rows, kept = text.pages.setdefault(order, (tuple(r for layer in order for r in text.rows if r.layer == layer), {}))
    left_out = {*without, instead.id} if instead else without
    changed = next((n for n, row in enumerate(rows) if row.id in left_out), len(rows))
    done = max((number for number in kept if number <= changed), default=0)
    page = kept[done].copy() if kept else _Page({line.id: line for line in text.witness})
    for number, row in enumerate(rows[done:], done):
        if number <= changed and number % _KEPT == 0 and number not in kept:
            kept[number] = page.copy()
        if instead and row.id == instead.id:
            row = instead
        if row.id not in without:
            page.apply(row)
    return tuple(line for line in page.lines() if line.text.strip())


def built_without(text: Text, row_id: str) -> tuple[frozenset[str], tuple[Line, ...]]:
    """A row with those that cannot stand without it, and the text of all layers without them.

    Such rows change a card it inserted, or a fragment it supplied.
    """
    lost = {row_id}
    while True:
        try:
            lines = build(text, text.layers, lost)
        except RowMisfit as misfit:
            lost.add(misfit.row_id)
        else:
            return frozenset(lost), lines


class RowMisfit(ApparatusError):
    """A row's fragment is not where the row says; carries the row's id."""

    def __init__(self, row_id: str, message: str) -> None:
        super().__init__(f"row {row_id}: {message}")
        self.row_id = row_id


class _Page:
    """A text in work: its lines by id, and their order."""

    def __init__(self, at: dict[str, Line], order: Iterable[str] = ()) -> None:
        self._at, self._order = at, list(order or at)

    def copy(self) -> _Page:
        return _Page(dict(self._at), self._order)

    def lines(self) -> Iterator[Line]:
        return (self._at[name] for name in self._order)

    def apply(self, row: Row) -> None:
        """Make a row's changes.  Raises RowMisfit."""
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
                    raise RowMisfit(row.id, f"{change.witness!r} stands {times} times in line {line.id}: {line.text!r}")
                first_piece, *rest = line.text.replace(change.witness, change.lemma).split("\n")
                self._put(row, line, first_piece)
                inserted = self._insert(row, line, rest, inserted)

    def _line(self, row: Row, name: str) -> Line:
        if name not in self._at:
            raise RowMisfit(row.id, f"there is no line {name}")
        return self._at[name]

    def _put(self, row: Row, line: Line, text: str) -> None:
        self._at[line.id] = Line(line.id, text, line.page, (*line.rows, row.id))

    def _insert(self, row: Row, behind: Line, texts: Sequence[str], inserted: int) -> int:
        """Lines after another, named by the row and numbered from ``inserted`` + 1; how many the row has now."""
        if texts:
            new = [f"{row.id}.{inserted + k}" for k in range(1, len(texts) + 1)]
            at = self._order.index(behind.id) + 1
            self._order[at:at] = new
            for name, text in zip(new, texts, strict=True):
                self._at[name] = Line(name, text, behind.page, (row.id,))
        return inserted + len(texts)


@lru_cache(4096)
def on_form(text: str) -> str:
    """A statement in the columns of the coding form (C26-5619 p. 12); a comment keeps its own."""
    if text.startswith("C  "):
        return text
    words = text.strip()
    number = re.match(r"\d*", words)
    label = number[0] if number else ""
    statement = words[len(label) :].strip()
    card = f"{label:>5} {statement}"
    return card if len(card) <= LAST_COLUMN else label + statement


def _row(head: Mapping[str, Any], raw: Mapping[str, Any]) -> Row:
    name, text_id, layers = str(raw.get("id", "(without id)")), head["id"], head["layers"]
    missing = [k for k in _FIELDS if k not in raw]
    if missing:
        raise ApparatusError(f"{text_id}: row {name} lacks {', '.join(missing)}")
    strange = [k for k in raw if k not in (*_FIELDS, *_OPTIONAL)]
    if strange:
        raise ApparatusError(f"{text_id}: row {name} has {', '.join(strange)}, which no row stores")
    if raw["layer"] not in layers:
        raise ApparatusError(f"{text_id}: row {name} is of layer {raw['layer']!r}; the text has {', '.join(layers)}")
    cause = str(raw.get("cause", _CAUSE.get(raw["layer"], "editor")))
    if cause not in _CAUSES:
        raise ApparatusError(f"{text_id}: row {name}: the cause is one of {', '.join(_CAUSES)}")
    changes = tuple(
        Change(
            line=str(c["line"]),
            witness=c.get("witness", ""),
            lemma=c.get("lemma", ""),
            after=bool(c.get("after", False)),
            through=str(c.get("through", "")),
            form=bool(c.get("form", False)),
            dense=bool(c.get("dense", False)),
        )
        for c in raw["change"]
    )
    for change in changes:
        if not (change.witness or change.after or change.through or change.dense):
            raise ApparatusError(
                f"{text_id}: row {name}: a change needs a witness reading, `after`, `through` or `dense`"
            )
    rejected = tuple(Rejected(str(r.get("reading", "")), str(r.get("reason", ""))) for r in raw.get("rdg", ()))
    if not all(r.reading and r.reason for r in rejected):
        raise ApparatusError(f"{text_id}: row {name}: a rejected reading has a reading and a reason")
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
    """The row with the page, or the first and the last, of the witness lines it touches."""

    def page(line: str) -> str:
        if line in pages:
            return pages[line]
        maker = origins.get(line.rpartition(".")[0])
        return page(maker.changes[0].line) if maker and maker is not row else ""

    touched = {page(line) for change in row.changes for line in (change.line, change.through) if line}
    found = [name for name in dict.fromkeys(pages.values()) if name in touched]
    return replace(row, page="-".join(found if len(found) < 2 else (found[0], found[-1])))


def _shown(text: str) -> str:
    return text.replace("\n", " / ")


def _done(change: Change) -> str:
    return "(set out as on the form)" if change.form else "(without blanks)" if change.dense else "-"


def _scope(change: Change) -> str:
    if change.dense:
        return f"(line {change.line}, spread out)"
    if change.after:
        return f"(nothing after line {change.line})"
    return f"(lines {change.line} to {change.through})"
