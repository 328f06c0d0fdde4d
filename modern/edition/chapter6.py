"""The layout of chapter 6 (``transcripts/chapter6/layout.toml``) and its committed device files.

A *device file* is an input deck, the cards that a program punches, or the lines that it types.  The printed text of
chapter 6 supplies the words and numbers of these files in their order.  In the layer ``layout``, the layout supplies
the columns and blank cards, which the OCR lost and the FORMAT statements determine.  In the layer ``stated``, it
supplies the typed lines, which the thesis describes but does not print.  :mod:`modern.edition.chapter6_cards` combines
text and layout.
"""

import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import Any, Literal, get_args

from emulator.language.cards import Deck, deck_from_text

EXAMPLES = (1, 2, 3, 4, 5, 6)

Output = Literal["punch", "typewriter"]
# The kind of a device file: the input deck, the punched cards or the typed lines.
Device = Literal["deck", "punch", "typewriter"]

# The layer of a device file: ``layout`` if the thesis prints it and only its blanks come from the layout, ``stated`` if
# the thesis describes it in words.
Origin = Literal["layout", "stated"]

# The contents of a card; empty for headings and blank cards.
Role = Literal[
    "", "n", "point", "centre", "plane", "carrier", "inside", "boundary", "vertex", "endpoint", "equation", "incidence"
]


class LayoutError(ValueError):
    """Raised for an error in the layout of chapter 6; the message names the card or the device file."""


@dataclass(frozen=True, slots=True)
class Format:
    """A FORMAT statement: ``text`` is the restored text, and ``listed`` is the OCR text of the listing on ``page``.

    ``note`` explains the difference if the two texts differ.
    """

    program: int
    number: int
    page: str
    text: str
    listed: str
    note: str


@dataclass(frozen=True, slots=True)
class Field:
    """The columns ``first`` to ``last`` of a card, counted from 1.

    ``word`` is True for a printed word and False for a number, which is right-aligned.
    """

    first: int
    last: int
    word: bool

    @property
    def width(self) -> int:
        return self.last - self.first + 1


@dataclass(frozen=True, slots=True)
class CardShape:
    """One of the cards that a FORMAT punches for a list of ``values`` numbers.

    ``record`` is the number of the card among these cards, counted from 1 and including blank cards.
    """

    id: str
    program: int
    format: int
    record: int
    values: int
    fields: tuple[Field, ...]


@dataclass(frozen=True, slots=True)
class DeviceLayout:
    """The layout of a device file.

    In the layer ``layout``, ``span`` has the ids of its first and last printed line, and ``cards`` has its cards with
    their roles.  In the layer ``stated``, ``typed`` has its lines.
    """

    example: int
    program: int
    device: Device
    file: str
    layer: Origin
    span: tuple[str, str] | None
    cards: tuple[tuple[CardShape, Role], ...]
    typed: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Layout:
    formats: tuple[Format, ...]
    cards: tuple[CardShape, ...]
    headings: tuple[str, ...]
    devices: tuple[DeviceLayout, ...]


def load_layout(folder: Traversable) -> Layout:
    """Return the layout in ``layout.toml`` of a folder.

    Raise LayoutError for an unknown card, role, device or layer.
    """
    data = tomllib.loads(folder.joinpath("layout.toml").read_text(encoding="utf-8"))
    shapes: dict[str, CardShape] = {}
    for raw in data["card"]:
        fields = tuple(Field(first, last, kind == "l") for first, last, kind in raw["fields"])
        if raw["id"] in shapes:
            raise LayoutError(f"layout.toml: card {raw['id']} is defined twice")
        shapes[raw["id"]] = CardShape(raw["id"], raw["program"], raw["format"], raw["record"], raw["values"], fields)
    return Layout(
        formats=tuple(Format(**{"listed": raw["text"], "note": "", **raw}) for raw in data["format"]),
        cards=tuple(shapes.values()),
        headings=tuple(str(h["line"]) for h in data["heading"]),
        devices=tuple(_device(raw, shapes) for raw in data["device"]),
    )


def _device(raw: Mapping[str, Any], shapes: Mapping[str, CardShape]) -> DeviceLayout:
    cards: list[tuple[CardShape, Role]] = []
    for item in raw.get("cards", ()):
        entry: Mapping[str, Any] = {"id": item} if isinstance(item, str) else item
        if entry["id"] not in shapes:
            raise LayoutError(f"layout.toml: {raw['file']}: unknown card {entry['id']}")
        role: Role = entry.get("role", "")
        if role not in get_args(Role):
            raise LayoutError(f"layout.toml: {raw['file']}: unknown role {role!r}")
        cards += [(shapes[entry["id"]], role)] * entry.get("times", 1)
    if raw["device"] not in get_args(Device):
        raise LayoutError(f"layout.toml: {raw['file']}: unknown device {raw['device']!r}")
    if raw["layer"] not in get_args(Origin) or (raw["layer"] == "layout") != ("lines" in raw):
        raise LayoutError(f"layout.toml: {raw['file']}: printed lines are required in layer `layout` and only there")
    return DeviceLayout(
        example=raw["example"],
        program=raw["program"],
        device=raw["device"],
        file=raw["file"],
        layer=raw["layer"],
        span=(str(raw["lines"][0]), str(raw["lines"][1])) if "lines" in raw else None,
        cards=tuple(cards),
        typed=tuple(raw.get("typed", ())),
    )


@dataclass(frozen=True, slots=True)
class Print:
    """The lines that a program writes on one device in one example.

    The thesis prints the punched cards; it only describes the typed lines.
    """

    example: int
    program: int
    device: Output
    lines: tuple[str, ...]


def chapter6_folder() -> Traversable:
    """Return the data folder of chapter 6, in a checkout or an installed wheel."""
    return files("transcripts").joinpath("chapter6")


def input_deck(example: int) -> Deck:
    """Return the data deck of an example, which program 1 reads."""
    name = f"example{example}/program1.deck"
    return deck_from_text(name, chapter6_folder().joinpath(*name.split("/")).read_text(encoding="ascii"))


def prints(example: int) -> Iterator[Print]:
    """Yield the cards and the typed lines of each program that an example runs, as the thesis prints or states them."""
    outputs: tuple[Output, ...] = ("punch", "typewriter")
    place = chapter6_folder().joinpath(f"example{example}")
    for program in (1, 2, 3):
        for device in outputs:
            entry = place.joinpath(f"program{program}.{device}")
            if entry.is_file():
                yield Print(example, program, device, tuple(entry.read_text(encoding="ascii").splitlines()))
