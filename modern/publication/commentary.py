"""The commentary on the programs: what each block of statements does, and what each variable holds.

The texts are data, ``fortran_src/commentary/PROGRAM.toml``.  A block contains the cards from one place to another; the
places are those of :mod:`modern.publication.facing`.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

from modern.edition import programs
from modern.publication.facing import facing
from modern.publication.uses import uses


@dataclass(frozen=True, slots=True)
class Block:
    """Consecutive cards with one purpose.

    ``cards`` are their numbers in the deck.  ``steps`` name rows of the concordance with chapter 3 of the thesis.
    ``marks`` name the variables whose points the picture of the block highlights (:mod:`modern.publication.moments`).
    """

    title: str
    cards: range
    steps: tuple[str, ...]
    text: str
    marks: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Gloss:
    """The explanation of a variable of a program.

    ``limits`` are the smallest and the largest value of an integer variable; None for a floating-point variable.
    ``set_in`` and ``used_in`` are the titles of the blocks that change and read the variable.
    """

    name: str
    text: str
    limits: tuple[int, int] | None
    set_in: tuple[str, ...]
    used_in: tuple[str, ...]


@dataclass(frozen=True)
class Commentary:
    """The blocks of a program in the order of its cards, and its variables in alphabetical order."""

    program: str
    blocks: tuple[Block, ...]
    variables: tuple[Gloss, ...]

    def block_of(self, card: int) -> Block:
        """Return the block that contains a card.  Raise KeyError if there is none."""
        for block in self.blocks:
            if card in block.cards:
                return block
        raise KeyError(card)

    def gloss(self, name: str) -> Gloss:
        """Return the gloss of a variable.  Raise KeyError if there is none."""
        for variable in self.variables:
            if variable.name == name:
                return variable
        raise KeyError(name)


@cache
def commentary(program: str) -> Commentary:
    """Return the commentary on a built-in program; variants of a program share its text.

    A block of a variant ends before the first card of the next block, because the variant may lack some cards.  Raise
    KeyError for an unknown program, and ValueError if the file names a place or a variable that does not exist.
    """
    entry = programs.built_in(program)
    path = programs.sources().joinpath("commentary", f"{entry.text}.toml")
    data = tomllib.loads(path.read_text(encoding="utf-8"))
    cards = facing(program).cards
    number_of = {card.place: card.number for card in cards}
    if entry.name == entry.text:
        blocks = tuple(_blocks(data["block"], number_of))
    else:
        blocks = tuple(reversed([*_blocks_of_variant(data["block"], number_of, entry.text, len(cards))]))
    names = [name for name in uses(program).names if not name.function]
    unknown = set(data["variable"]) - {name.name for name in names}
    if unknown and entry.name == entry.text:
        raise ValueError(f"{path.name}: no variable is called {', '.join(sorted(unknown))}")

    def titles(numbers: tuple[int, ...]) -> tuple[str, ...]:
        return tuple(block.title for block in blocks if any(number in block.cards for number in numbers))

    glosses = []
    for name in names:
        if (row := data["variable"].get(name.name)) is not None:
            limits = tuple(row["range"]) if "range" in row else None
            glosses.append(Gloss(name.name, row["gloss"], limits, titles(name.set), titles(name.used)))
    return Commentary(program, blocks, tuple(glosses))


def _blocks(rows: list[dict[str, object]], number_of: dict[str, int]) -> Iterator[Block]:
    for row in rows:
        first, last = str(row["first"]), str(row["last"])
        if missing := {first, last} - number_of.keys():
            raise ValueError(f"the block {row['title']!r} names a card that does not exist: {', '.join(missing)}")
        yield _block(row, range(number_of[first], number_of[last] + 1))


def _blocks_of_variant(
    rows: list[dict[str, object]], number_of: dict[str, int], text: str, count: int
) -> Iterator[Block]:
    # From the last block to the first, because a block ends before the next one that the variant has.
    places = [card.place for card in facing(text).cards]
    end = count + 1
    for row in reversed(rows):
        block = places[places.index(str(row["first"])) : places.index(str(row["last"])) + 1]
        first = min((number_of[place] for place in block if place in number_of), default=end)
        if first < end:
            yield _block(row, range(first, end))
            end = first


def _block(row: dict[str, object], cards: range) -> Block:
    steps, marks = row.get("steps", []), row.get("marks", [])
    assert isinstance(steps, list)
    assert isinstance(marks, list)
    return Block(str(row["title"]), cards, tuple(steps), str(row["text"]).strip(), tuple(marks))
