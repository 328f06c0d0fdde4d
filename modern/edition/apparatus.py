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
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from importlib.resources.abc import Traversable
from typing import Any, Literal, get_args

from emulator.errors import EmulatorError

PAGE_MARK = "## page "
LAST_COLUMN = 72
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
class Row:
    """One emendation, with the fields an edition owes its reader (DESIGN, executable apparatus)."""

    id: str
    text: str
    page: str
    card: str
    layer: str
    kind: str
    reason: str
    evidence: str
    certainty: Certainty
    changes: tuple[Change, ...]
    ground: Mapping[str, Any] = field(default_factory=dict)

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
    rows = tuple(_row(head["id"], raw, layers) for raw in data.get("row", ()))
    seen: set[str] = set()
    for row in rows:
        if row.id in seen:
            raise ApparatusError(f"{head['id']}: row {row.id} stands twice")
        seen.add(row.id)
    return Text(head["id"], head["title"], lines, rows, layers, tuple(head["default"]))


def build(text: Text, layers: Iterable[str] | None = None, without: Collection[str] = ()) -> tuple[Line, ...]:
    """Witness plus the rows of ``layers`` (the text's default layers if None), leaving out rows ``without``.

    Layers apply in the text's own order whatever order they are asked for in, so that a later layer may
    change what an earlier one established.  Raises ApparatusError for an unknown layer and for a row whose
    witness fragment does not stand in its line exactly once.
    """
    wanted = set(text.default if layers is None else layers)
    unknown = wanted.difference(text.layers)
    if unknown:
        raise ApparatusError(f"{text.id} has no layer {', '.join(sorted(unknown))}; it has {', '.join(text.layers)}")
    lines = list(text.witness)
    for layer in text.layers:
        if layer not in wanted:
            continue
        for row in text.rows:
            if row.layer == layer and row.id not in without:
                lines = _apply(row, lines)
    return tuple(line for line in lines if line.text.strip())


def lost_with(text: Text, row_id: str) -> frozenset[str]:
    """The row and those that cannot stand without it: they change a card it inserted, or a fragment it supplied."""
    lost = {row_id}
    while True:
        try:
            build(text, text.layers, lost)
        except RowMisfit as misfit:
            lost.add(misfit.row_id)
        else:
            return frozenset(lost)


class RowMisfit(ApparatusError):
    """A row's fragment is not where the row says; carries the row's id."""

    def __init__(self, row_id: str, message: str) -> None:
        super().__init__(f"row {row_id}: {message}")
        self.row_id = row_id


def _apply(row: Row, lines: Sequence[Line]) -> list[Line]:
    result = list(lines)
    inserted = 0
    for change in row.changes:
        at = _index(row, change.line, result)
        if change.through:
            last = _index(row, change.through, result)
            for i in range(at, last + 1):
                text = _on_form(result[i].text) if change.form else ""
                result[i] = Line(result[i].id, text, result[i].page, (*result[i].rows, row.id))
            continue
        line = result[at]
        if change.after:
            new = change.lemma.split("\n")
            ids = [f"{row.id}.{inserted + k + 1}" for k in range(len(new))]
            inserted += len(new)
            result[at + 1 : at + 1] = [Line(i, t, line.page, (row.id,)) for i, t in zip(ids, new, strict=True)]
            continue
        if change.dense:
            result[at] = Line(line.id, "".join(line.text.split()), line.page, (*line.rows, row.id))
            continue
        if line.text.count(change.witness) != 1:
            raise RowMisfit(
                row.id,
                f"{change.witness!r} stands {line.text.count(change.witness)} times in line {line.id}: {line.text!r}",
            )
        pieces = line.text.replace(change.witness, change.lemma).split("\n")
        first = Line(line.id, pieces[0], line.page, (*line.rows, row.id))
        rest = [Line(f"{row.id}.{inserted + k + 1}", t, line.page, (row.id,)) for k, t in enumerate(pieces[1:])]
        inserted += len(rest)
        result[at : at + 1] = [first, *rest]
    return result


def _index(row: Row, line_id: str, lines: Sequence[Line]) -> int:
    for i, line in enumerate(lines):
        if line.id == line_id:
            return i
    raise RowMisfit(row.id, f"there is no line {line_id}")


def _on_form(text: str) -> str:
    """A statement in the columns of the coding form (C26-5619 p. 12); a comment keeps its own."""
    if text.startswith("C  "):
        return text
    words = text.strip()
    number = re.match(r"\d*", words)
    label = number[0] if number else ""
    statement = words[len(label) :].strip()
    card = f"{label:>5} {statement}"
    return card if len(card) <= LAST_COLUMN else label + statement


def _row(text_id: str, raw: Mapping[str, Any], layers: Collection[str]) -> Row:
    name = str(raw.get("id", "(without id)"))
    missing = [
        k for k in ("id", "page", "card", "layer", "kind", "reason", "evidence", "certainty", "change") if k not in raw
    ]
    if missing:
        raise ApparatusError(f"{text_id}: row {name} lacks {', '.join(missing)}")
    if raw["layer"] not in layers:
        raise ApparatusError(f"{text_id}: row {name} is of layer {raw['layer']!r}; the text has {', '.join(layers)}")
    if raw["certainty"] not in get_args(Certainty):
        raise ApparatusError(f"{text_id}: row {name}: certainty is one of {', '.join(get_args(Certainty))}")
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
    return Row(
        id=name,
        text=text_id,
        page=str(raw["page"]),
        card=str(raw["card"]),
        layer=raw["layer"],
        kind=raw["kind"],
        reason=raw["reason"],
        evidence=raw["evidence"],
        certainty=raw["certainty"],
        changes=changes,
        ground=dict(raw.get("ground", {})),
    )


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
