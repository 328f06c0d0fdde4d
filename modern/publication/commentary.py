"""The commentary on the programs: the purpose of each block of statements and the meaning of each variable.

The texts are data, ``fortran_src/commentary/PROGRAM.toml``. For each block, the file names the first and the last card.
:mod:`modern.publication.facing` explains these names, which are called places.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any

from modern.edition import programs
from modern.publication.facing import facing
from modern.publication.uses import uses


@dataclass(frozen=True, slots=True)
class Block:
    """Consecutive cards with one purpose.

    ``cards`` are their numbers in the deck. ``steps`` names rows of the concordance with chapter 3 of the thesis
    (``docs/reference/concordance.md``). ``marks`` names variables that refer to points. The picture of the block
    highlights these points (:mod:`modern.publication.moments`).
    """

    title: str
    cards: range
    steps: tuple[str, ...]
    text: str
    marks: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Gloss:
    """The explanation of a variable of a program.

    ``limits`` has the smallest and the largest value of an integer variable. ``limits`` is None for a floating-point
    variable. ``set_in`` has the titles of the blocks that change the variable.
    """

    name: str
    text: str
    limits: tuple[int, int] | None
    set_in: tuple[str, ...]


@dataclass(frozen=True)
class Commentary:
    """The blocks of a program in the order of its cards, and its variables in alphabetical order."""

    blocks: tuple[Block, ...]
    variables: tuple[Gloss, ...]


@cache
def commentary(program: str) -> Commentary:
    """Return the commentary on a built-in program. Variants of a program share one text.

    A block ends before the first card of the next block. The last card that the file names for a block does not decide
    its end, because a variant may lack this card.  Raise KeyError for an unknown program, and ValueError if the file
    names a place or a variable that does not exist.
    """
    entry = programs.built_in(program)
    path = programs.sources().joinpath("commentary", f"{entry.text}.toml")
    data = tomllib.loads(path.read_text(encoding="utf-8"))
    blocks = tuple(reversed([*_blocks_from_last(data["block"], program, entry.text)]))
    names = [name for name in uses(program).names if not name.function]
    unknown = set(data["variable"]) - {name.name for name in names}
    if unknown and entry.name == entry.text:
        raise ValueError(f"{path.name}: no variable is called {', '.join(sorted(unknown))}")
    glosses = []
    for name in names:
        if (row := data["variable"].get(name.name)) is not None:
            limits = tuple(row["range"]) if "range" in row else None
            set_in = tuple(block.title for block in blocks if any(card in block.cards for card in name.set))
            glosses.append(Gloss(name.name, row["gloss"], limits, set_in))
    return Commentary(blocks, tuple(glosses))


def _blocks_from_last(rows: list[dict[str, Any]], program: str, text: str) -> Iterator[Block]:
    """Yield the blocks of a program, the last one first. ``text`` names the program to whose cards the rows refer."""
    places = [card.place for card in facing(text).cards]
    number_of = {card.place: card.number for card in facing(program).cards}
    end = len(number_of) + 1
    for row in reversed(rows):
        block = places[places.index(row["first"]) : places.index(row["last"]) + 1]
        first = min((number_of[place] for place in block if place in number_of), default=end)
        if first < end:
            steps, marks = tuple(row.get("steps", ())), tuple(row.get("marks", ()))
            yield Block(row["title"], range(first, end), steps, row["text"].strip(), marks)
            end = first
