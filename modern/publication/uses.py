"""Who goes where and what is used where in a deck: jumps by card, names and FORMATs with the cards that use them.

Everything is read from the syntax tree, so that it holds for a deck and not for a run.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from typing import Literal

from emulator.language import tree
from emulator.language.compiler import compile_deck
from emulator.language.parser import parse
from emulator.language.storage import Storage
from modern.edition import programs

How = Literal["declared", "set", "used"]
_SIGNS = ("\u2212", "0", "+")


@dataclass(frozen=True, slots=True)
class Jump:
    """A way from one card to another that is not the next: ``taken`` for what (nothing where there is no choice).

    ``kind``: a jump; ``again``, the last statement of a DO going back to the first; ``format``, a list that is read or
    written by a FORMAT.
    """

    card: int
    target: int
    taken: str
    kind: Literal["jump", "again", "format"]


@dataclass(frozen=True, slots=True)
class Name:
    """A name of a program: how large it is, and on what cards it is declared, set and used.

    ``shape`` are the dimensions of an array; ``floating`` the mode; ``function`` a library function.  A card that sets
    a name and uses it too is in both.
    """

    name: str
    floating: bool
    shape: tuple[int, ...]
    fields: int
    function: bool
    declared: tuple[int, ...]
    set: tuple[int, ...]
    used: tuple[int, ...]


@dataclass(frozen=True)
class Uses:
    """Jumps and names of a deck, by card; ``labels`` gives the card of a statement number."""

    labels: dict[int, int]
    jumps: tuple[Jump, ...]
    names: tuple[Name, ...]

    def to(self, card: int) -> tuple[Jump, ...]:
        """Who comes to a card."""
        return tuple(jump for jump in self.jumps if jump.target == card)

    def of(self, card: int) -> tuple[str, ...]:
        """The names that stand on a card."""
        return tuple(name.name for name in self.names if card in (*name.declared, *name.set, *name.used))


@cache
def uses(program: str) -> Uses:
    """Jumps and names of a built-in program's deck."""
    deck = programs.deck(program)
    statements = parse(deck).statements
    labels = {s.label: s.place.card for s in statements if s.label}
    jumps = tuple(jump for s in statements for jump in _jumps(s, labels))
    found: dict[str, dict[How, list[int]]] = {}
    for statement in statements:
        for name, how in _names(statement.body):
            cards = found.setdefault(name, {"declared": [], "set": [], "used": []})[how]
            if statement.place.card not in cards:
                cards.append(statement.place.card)
    storage = compile_deck(deck).storage
    names = tuple(_name(name, how, storage) for name, how in sorted(found.items()))
    return Uses(labels, jumps, names)


def _jumps(statement: tree.Statement, labels: dict[int, int]) -> Iterator[Jump]:
    """The ways that leave a statement, several for one target in one."""
    body, card = statement.body, statement.place.card
    ways: list[tuple[str, int]] = []
    if isinstance(body, tree.GoTo):
        ways = [("", body.label)]
    elif isinstance(body, tree.ComputedGoTo):
        ways = [(str(value), label) for value, label in enumerate(body.labels, 1)]
    elif isinstance(body, tree.If):
        ways = list(zip(_SIGNS, body.labels, strict=True))
    elif isinstance(body, tree.IfSwitch):
        ways = list(zip(("on", "off"), body.labels, strict=True))
    elif isinstance(body, tree.Do):
        yield Jump(labels[body.label], card, "", "again")
    elif isinstance(body, tree.InputOutput):
        yield Jump(card, labels[body.format], body.verb, "format")
    taken: dict[int, list[str]] = {}
    for way, label in ways:
        taken.setdefault(labels[label], []).append(way)
    for target, what in taken.items():
        yield Jump(card, target, ", ".join(filter(None, what)), "jump")


def _names(body: tree.Body) -> Iterator[tuple[str, How]]:
    """Every name of a statement and what is done to it."""
    if isinstance(body, tree.Dimension):
        yield from ((name, "declared") for name, _, _ in body.arrays)
    elif isinstance(body, tree.Assignment):
        yield from _target(body.target)
        yield from _read(body.value)
    elif isinstance(body, tree.If):
        yield from _read(body.value)
    elif isinstance(body, tree.ComputedGoTo):
        yield from _read(body.selector)
    elif isinstance(body, tree.Do):
        yield from _loop(body)
    elif isinstance(body, tree.InputOutput):
        taken = body.verb in ("READ", "ACCEPT")
        for item in body.items:
            yield from _item(item, taken)


def _loop(loop: tree.Do | tree.Loop) -> Iterator[tuple[str, How]]:
    yield loop.variable.name, "set"
    for bound in (loop.first, loop.last, loop.step):
        if bound is not None:
            yield from _read(bound)


def _item(item: tree.Item, taken: bool) -> Iterator[tuple[str, How]]:
    """An item of a list: what is read is set, what is written used."""
    if isinstance(item, tree.Loop):
        yield from _loop(item)
        for inner in item.items:
            yield from _item(inner, taken)
    elif taken:
        yield from _target(item)
    else:
        yield from _read(item)


def _target(reference: tree.Reference) -> Iterator[tuple[str, How]]:
    yield reference.name, "set"
    for argument in reference.arguments:
        yield from _read(argument)


def _read(expression: tree.Expression) -> Iterator[tuple[str, How]]:
    if isinstance(expression, tree.Reference):
        yield expression.name, "used"
        for argument in expression.arguments:
            yield from _read(argument)
    elif isinstance(expression, tree.Power):
        yield from _read(expression.base)
        yield from _read(expression.exponent)
    elif isinstance(expression, (tree.Product, tree.Sum)):
        yield from _read(expression.first)
        for _, part in expression.rest:
            yield from _read(part)


def _name(name: str, how: dict[How, list[int]], storage: Storage) -> Name:
    entry = next((entry for entry in storage.entries if entry.name == name), None)
    return Name(
        name,
        name[0] not in "IJKLMN",
        entry.shape if entry else (),
        entry.size if entry else 0,
        entry is None,
        tuple(how["declared"]),
        tuple(how["set"]),
        tuple(how["used"]),
    )
