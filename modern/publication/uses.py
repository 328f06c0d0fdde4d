"""Cross references of a deck: the jumps between its cards, and the cards that use each name and FORMAT.

The module reads them from the syntax tree; no program is run.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from typing import Literal

from emulator.language import tree
from emulator.language.compiler import compile_deck
from emulator.language.parser import parse
from emulator.language.storage import Storage
from modern.edition import programs

# What a card does with a name.
How = Literal["declared", "set", "used"]
_SIGNS = ("\u2212", "0", "+")


@dataclass(frozen=True, slots=True)
class Jump:
    """A reference from one card to another.

    ``kind`` is ``jump`` for a transfer of control, ``again`` for the last statement of a DO loop, which returns to the
    first, and ``format`` for an input or output statement that uses a FORMAT.  ``taken`` is the condition of the jump,
    or empty if it is unconditional.
    """

    card: int
    target: int
    taken: str
    kind: Literal["jump", "again", "format"]


@dataclass(frozen=True, slots=True)
class Name:
    """A name in a program with the cards that declare, set and use it.

    ``floating`` is its mode, ``shape`` has the dimensions of an array, ``fields`` is its size in fields, and
    ``function`` is True for a library function.
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
    """The jumps and names of a deck.  ``labels`` maps a statement number to its card."""

    labels: dict[int, int]
    jumps: tuple[Jump, ...]
    names: tuple[Name, ...]

    def to(self, card: int) -> tuple[Jump, ...]:
        """Return the references from other cards to a card."""
        return tuple(jump for jump in self.jumps if jump.target == card)

    def of(self, card: int) -> tuple[str, ...]:
        """Return the names that occur on a card."""
        return tuple(name.name for name in self.names if card in (*name.declared, *name.set, *name.used))


@cache
def uses(program: str) -> Uses:
    """Return the jumps and names of a built-in program."""
    deck = programs.deck(program)
    statements = parse(deck).statements
    labels = {s.label: s.place.card for s in statements if s.label}
    jumps = tuple(jump for s in statements for jump in _jumps(s, labels))
    cards_of: dict[str, dict[How, list[int]]] = {}
    for statement in statements:
        for name, how in _names(statement.body):
            cards = cards_of.setdefault(name, {"declared": [], "set": [], "used": []})[how]
            if statement.place.card not in cards:
                cards.append(statement.place.card)
    storage = compile_deck(deck).storage
    names = tuple(_name(name, how, storage) for name, how in sorted(cards_of.items()))
    return Uses(labels, jumps, names)


def _jumps(statement: tree.Statement, labels: dict[int, int]) -> Iterator[Jump]:
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
    conditions: dict[int, list[str]] = {}
    for condition, label in ways:
        conditions.setdefault(labels[label], []).append(condition)
    for target, of_target in conditions.items():
        yield Jump(card, target, ", ".join(filter(None, of_target)), "jump")


def _names(body: tree.Body) -> Iterator[tuple[str, How]]:
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
        is_input = body.verb in ("READ", "ACCEPT")
        for item in body.items:
            yield from _item(item, is_input)


def _loop(loop: tree.Do | tree.Loop) -> Iterator[tuple[str, How]]:
    yield loop.variable.name, "set"
    for bound in (loop.first, loop.last, loop.step):
        if bound is not None:
            yield from _read(bound)


def _item(item: tree.Item, is_input: bool) -> Iterator[tuple[str, How]]:
    """Yield the names in an item of an input or output list: input sets them, output uses them."""
    if isinstance(item, tree.Loop):
        yield from _loop(item)
        for inner in item.items:
            yield from _item(inner, is_input)
    elif is_input:
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
    shape, fields = (entry.shape, entry.size) if entry else ((), 0)
    declared, assigned, used = tuple(how["declared"]), tuple(how["set"]), tuple(how["used"])
    return Name(name, name[0] not in "IJKLMN", shape, fields, entry is None, declared, assigned, used)
