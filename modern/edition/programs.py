"""The built-in programs: decks as committed, or built from witness and apparatus with further layers."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable

from emulator.errors import DeckError
from emulator.language.cards import Deck, deck_from_lines, deck_from_text
from emulator.language.compiler import compile_deck
from emulator.language.objectcode import Program
from modern.edition.apparatus import Row, Text, build, load


@dataclass(frozen=True, slots=True)
class BuiltIn:
    """A built-in program: its name, its number in the thesis, the text it comes from, and the layers of its deck."""

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
        "program1_examples",
        1,
        "program1",
        (*_BASE, "examples"),
        "program 1 in the state that produced the examples",
    ),
)
NAMES = tuple(built_in.name for built_in in BUILT_INS)
TEXTS = ("program1", "program2", "program3")


def sources() -> Traversable:
    """The data folder ``fortran_src``, in a checkout or an installed wheel."""
    return files("fortran_src")


def built_in(name: str) -> BuiltIn:
    """The built-in program of that name.  Raises KeyError."""
    for entry in BUILT_INS:
        if entry.name == name:
            return entry
    raise KeyError(name)


@cache
def text(name: str) -> Text:
    """The witness and apparatus of ``program1``, ``program2`` or ``program3``."""
    return load(sources(), name)


@cache
def _named(name: str, layers: tuple[str, ...]) -> tuple[tuple[str, frozenset[str]], ...]:
    """For each card of a built-in with ``layers`` what an edition calls it, and the rows that touched it."""
    entry = built_in(name)
    lines = build(text(entry.text), (*entry.layers, *layers))
    found: list[tuple[str, frozenset[str]]] = []
    before: list[int] = []
    label, steps = "", 0
    for number, line in enumerate(lines):
        match = re.match(r"\s*(\d+)\s*(FORMAT)?", line.text)
        if line.text.startswith("C  "):
            before.append(number)
            found.append(("title", frozenset(line.rows)))
            continue
        if match:
            label, steps = ("FORMAT " if match[2] else "") + match[1], 0
        name = f"{label}+{steps}" if steps else label
        name = name or line.text.split("(")[0].split()[0]
        for comment in before if number > 1 else ():
            found[comment] = (f"before {name}", found[comment][1])
        before = []
        steps += bool(label)
        found.append((name, frozenset(line.rows)))
    return tuple(found)


def cards_of(row: Row) -> str:
    """The cards of a listing's row as an edition calls them: ``147+1``, ``FORMAT 9``, ``before 106``, ``131 to 133``.

    They are counted in the deck: a statement number, and how many statements come after it.
    """
    entry = next(b for b in BUILT_INS if b.text == row.text and (row.layer in b.layers or b.name == row.text))
    if row.layer == "examples":
        entry = built_in("program1_examples")
    named = _named(entry.name, () if row.layer in entry.layers else (row.layer,))
    names = [name for name, rows in named if row.id in rows]
    if len(names) > len(named) // 2:
        return "all cards"
    return ", ".join(names) if len(names) < 4 else f"{names[0]} to {names[-1]}"


def committed(name: str) -> Deck:
    """The committed deck of a built-in program."""
    return deck_from_text(f"{name}.f", sources().joinpath(f"{name}.f").read_text(encoding="ascii"))


def built(name: str, layers: Sequence[str] = (), without: Collection[str] = (), instead: Row | None = None) -> Deck:
    """A built-in program built anew from witness and apparatus.

    ``layers`` are added to its own, the rows ``without`` left out; ``instead`` stands in the place of the row of its
    id.  Raises ApparatusError where that does not build, CardError where the result is no deck (a reading the OCR left,
    with a row switched off).
    """
    entry = built_in(name)
    lines = build(text(entry.text), (*entry.layers, *layers), without, instead)
    return deck_from_lines(f"{name}.f", (line.text for line in lines))


def deck(name: str, layers: Sequence[str] = ()) -> Deck:
    """A built-in program's deck, as committed or with layers added.

    Raises DeckError for a layer the program has no row of.
    """
    if not layers:
        return committed(name)
    entry = built_in(name)
    present = {row.layer for row in text(entry.text).rows}
    for layer in layers:
        if layer not in present:
            raise DeckError(f"{name} has no rows of a layer {layer!r}; it has {', '.join(sorted(present))}")
    return built(name, layers)


@cache
def program(name: str, layers: tuple[str, ...] = ()) -> Program:
    """A built-in program compiled; the same object each time, as it is plain data."""
    return compile_deck(deck(name, layers))


def with_layers(name: str, layers: Sequence[str]) -> Program:
    """A built-in program compiled with those of ``layers`` that it has rows of; the three need not have all."""
    present = {row.layer for row in text(built_in(name).text).rows}
    return program(name, tuple(layer for layer in layers if layer in present))


def loader(layers: tuple[str, ...]) -> Callable[[str], Program]:
    """Programs by name with layers added, each layer to those programs that have rows of it.

    Raises DeckError for a layer none of them has.
    """
    present = {row.layer for name in TEXTS for row in text(name).rows}
    for layer in layers:
        if layer not in present:
            further = sorted(present - set(_BASE))
            raise DeckError(f"no program has rows of a layer {layer!r}; the layers are {', '.join(further)}")
    return lambda name: with_layers(name, layers)
