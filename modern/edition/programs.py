"""The built-in programs, either as committed decks or built from witness and apparatus with additional layers.

The apparatus is imported only if it is used, because most runs need only the committed decks.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import TYPE_CHECKING

from emulator.errors import DeckError, quoted
from emulator.language.cards import Deck, deck_from_lines, deck_from_text
from emulator.language.compiler import compile_deck
from emulator.language.objectcode import Program

if TYPE_CHECKING:
    from modern.edition.apparatus import Line, Row, Text


@dataclass(frozen=True, slots=True)
class BuiltIn:
    """A built-in program: its name, its number in the thesis, the name of its text, and the layers applied to it."""

    name: str
    number: int
    text: str
    layers: tuple[str, ...]
    title: str


_BASE = ("ocr", "print", "lacuna")

BUILT_INS = (
    BuiltIn("program1", 1, "program1", _BASE, "program 1 as listed"),
    BuiltIn("program2", 2, "program2", _BASE, "program 2 as listed: coplanar points"),
    BuiltIn("program3", 3, "program3", _BASE, "program 3 as listed: points not coplanar"),
    BuiltIn(
        "program1_examples", 1, "program1", (*_BASE, "examples"), "program 1 in the state that produced the examples"
    ),
)
NAMES = tuple(built_in.name for built_in in BUILT_INS)
TEXTS = ("program1", "program2", "program3")


def sources() -> Traversable:
    """Return the data folder ``fortran_src`` of a checkout or an installed wheel."""
    return files("fortran_src")


def built_in(name: str) -> BuiltIn:
    """Return the built-in program of that name.  Raise KeyError if there is none."""
    for entry in BUILT_INS:
        if entry.name == name:
            return entry
    raise KeyError(name)


@cache
def text(name: str) -> Text:
    """Return the witness and the apparatus of a text in ``TEXTS``."""
    from modern.edition.apparatus import confirmed, load
    from modern.edition.page_answers import page_readings

    return confirmed(load(sources(), name), {row for reading in page_readings() for row in reading.rows.split()})


def _lines(
    entry: BuiltIn, layers: Sequence[str], without: Collection[str] = (), instead: Row | None = None
) -> tuple[Line, ...]:
    from modern.edition.apparatus import build

    return build(text(entry.text), (*entry.layers, *layers), without, instead)


@cache
def _named(name: str, layers: tuple[str, ...]) -> tuple[tuple[str, frozenset[str]], ...]:
    """Return the name of each card of a built-in program, and the ids of the rows that changed the card.

    The name of a card consists of the last statement number and the number of cards since then (``147+1``).  The name
    of a comment refers to the statement after it (``before 106``).
    """
    entry = built_in(name)
    lines = _lines(entry, layers)
    named: list[tuple[str, frozenset[str]]] = []
    comments: list[int] = []
    label, steps = "", 0
    for number, line in enumerate(lines):
        match = re.match(r"\s*(\d+)\s*(FORMAT)?", line.text)
        if line.text.startswith("C  "):
            comments.append(number)
            named.append(("title", frozenset(line.rows)))
            continue
        if match:
            label, steps = ("FORMAT " if match[2] else "") + match[1], 0
        name = f"{label}+{steps}" if steps else label
        name = name or line.text.split("(")[0].split()[0]
        for comment in comments if number > 1 else ():
            named[comment] = (f"before {name}", named[comment][1])
        comments = []
        steps += bool(label)
        named.append((name, frozenset(line.rows)))
    return tuple(named)


def card_names(name: str) -> tuple[str, ...]:
    """Return the name of each card of a built-in program, such as ``147+1``."""
    return tuple(card for card, _ in _named(name, ()))


def cards_of(row: Row) -> str:
    """Return the names of the cards that an emendation changes, such as ``147+1``, ``FORMAT 9`` or ``131 to 133``."""
    entry = next(b for b in BUILT_INS if b.text == row.text and (row.layer in b.layers or b.name == row.text))
    if row.layer == "examples":
        entry = built_in("program1_examples")
    named = _named(entry.name, () if row.layer in entry.layers else (row.layer,))
    names = [name for name, rows in named if row.id in rows]
    if len(names) > len(named) // 2:
        return "all cards"
    return ", ".join(names) if len(names) < 4 else f"{names[0]} to {names[-1]}"


def committed(name: str) -> Deck:
    """Return the committed deck of a built-in program."""
    return deck_from_text(f"{name}.f", sources().joinpath(f"{name}.f").read_text(encoding="ascii"))


def built(name: str, layers: Sequence[str] = (), without: Collection[str] = (), instead: Row | None = None) -> Deck:
    """Return the deck of a built-in program, built from witness and apparatus with additional ``layers``.

    ``without`` and ``instead`` are those of :func:`modern.edition.apparatus.build`.  Raise ApparatusError if a row does
    not fit the text, and CardError if a card has a character that cannot be punched.
    """
    lines = _lines(built_in(name), layers, without, instead)
    return deck_from_lines(f"{name}.f", (line.text for line in lines))


def deck(name: str, layers: Sequence[str] = ()) -> Deck:
    """Return the deck of a built-in program with additional layers.

    Raise DeckError for a layer that has no rows for this program.
    """
    if not layers:
        return committed(name)
    entry = built_in(name)
    present = {row.layer for row in text(entry.text).rows}
    for layer in layers:
        if layer not in present:
            raise DeckError(f"{name} has no layer {quoted(layer)}; its layers are {', '.join(sorted(present))}")
    return built(name, layers)


def program(name: str, layers: tuple[str, ...] = ()) -> Program:
    """Return a built-in program, compiled with additional layers.  The result is cached."""
    return _compiled(name, layers)


@cache
def _compiled(name: str, layers: tuple[str, ...]) -> Program:
    return compile_deck(deck(name, layers))


def with_layers(name: str, layers: Sequence[str]) -> Program:
    """Return a built-in program, compiled with those of ``layers`` that have rows for it."""
    present = {row.layer for row in text(built_in(name).text).rows} if layers else set()
    return program(name, tuple(layer for layer in layers if layer in present))


def loader(layers: tuple[str, ...]) -> Callable[[str], Program]:
    """Return a function that compiles the program of a given name with additional layers.

    A program is compiled with those of ``layers`` that have rows for it.  Raise DeckError for a layer that no program
    has.
    """
    # Reading the apparatus takes time, and a program without additional layers does not need it.
    present = {row.layer for name in TEXTS for row in text(name).rows} if layers else set()
    for layer in layers:
        if layer not in present:
            optional = sorted(present - set(_BASE))
            raise DeckError(f"no program has a layer {quoted(layer)}; the layers are {', '.join(optional)}")
    return lambda name: with_layers(name, layers)
