"""``transcripts/chapter6/layout.toml`` as typed data: FORMATs, cards and device files.

The print of chapter 6 gives words, numbers and their order.  The layout gives what the OCR lost and the
FORMAT statements still say: columns and blank cards (layer ``layout``), and the typewriter lines that the
thesis states but does not print (layer ``stated``).
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources.abc import Traversable
from typing import Any


class LayoutError(ValueError):
    """A layout that cannot be read; one line naming the card or the device file."""


@dataclass(frozen=True, slots=True)
class Format:
    """A FORMAT statement: ``text`` as restored, ``listed`` as the OCR of the listing has it (page in ``page``)."""

    program: int
    number: int
    page: str
    text: str
    listed: str
    note: str


@dataclass(frozen=True, slots=True)
class Field:
    """Columns ``first`` to ``last`` (from 1); ``word`` for printed words, otherwise a number set to the right."""

    first: int
    last: int
    word: bool

    @property
    def width(self) -> int:
        return self.last - self.first + 1


@dataclass(frozen=True, slots=True)
class CardShape:
    """One card of a FORMAT: card ``record`` (from 1, blank cards counted) for a list of ``values`` numbers."""

    id: str
    program: int
    format: int
    record: int
    values: int
    fields: tuple[Field, ...]
    source: str


@dataclass(frozen=True, slots=True)
class DeviceLayout:
    """One device file: its printed lines and its cards with their roles, or (layer ``stated``) its typed lines."""

    example: int
    program: int
    device: str
    file: str
    layer: str
    span: tuple[str, str] | None
    cards: tuple[tuple[CardShape, str], ...]
    typed: tuple[str, ...]
    source: str


@dataclass(frozen=True, slots=True)
class Layout:
    formats: tuple[Format, ...]
    cards: tuple[CardShape, ...]
    headings: tuple[str, ...]
    devices: tuple[DeviceLayout, ...]


def load_layout(folder: Traversable) -> Layout:
    """Read ``layout.toml`` of a transcript folder.  Raises LayoutError for a card or layer it does not know."""
    data = tomllib.loads(folder.joinpath("layout.toml").read_text(encoding="utf-8"))
    formats = tuple(
        Format(f["program"], f["number"], f["page"], f["text"], f.get("listed", f["text"]), f.get("note", ""))
        for f in data["format"]
    )
    shapes: dict[str, CardShape] = {}
    for raw in data["card"]:
        fields = tuple(Field(first, last, kind == "l") for first, last, kind in raw["fields"])
        if raw["id"] in shapes:
            raise LayoutError(f"layout.toml: card {raw['id']} stands twice")
        shapes[raw["id"]] = CardShape(
            raw["id"], raw["program"], raw["format"], raw["record"], raw["values"], fields, raw["source"]
        )
    return Layout(
        formats=formats,
        cards=tuple(shapes.values()),
        headings=tuple(str(h["line"]) for h in data["heading"]),
        devices=tuple(_device(raw, shapes) for raw in data["device"]),
    )


def _device(raw: Mapping[str, Any], shapes: Mapping[str, CardShape]) -> DeviceLayout:
    cards: list[tuple[CardShape, str]] = []
    for item in raw.get("cards", ()):
        entry: Mapping[str, Any] = {"id": item} if isinstance(item, str) else item
        if entry["id"] not in shapes:
            raise LayoutError(f"layout.toml: {raw['file']}: there is no card {entry['id']}")
        cards += [(shapes[entry["id"]], entry.get("role", ""))] * entry.get("times", 1)
    if raw["layer"] not in ("layout", "stated") or (raw["layer"] == "layout") != ("lines" in raw):
        raise LayoutError(f"layout.toml: {raw['file']}: layer `layout` names printed lines, layer `stated` none")
    return DeviceLayout(
        example=raw["example"],
        program=raw["program"],
        device=raw["device"],
        file=raw["file"],
        layer=raw["layer"],
        span=(str(raw["lines"][0]), str(raw["lines"][1])) if "lines" in raw else None,
        cards=tuple(cards),
        typed=tuple(raw.get("typed", ())),
        source=raw.get("source", ""),
    )
