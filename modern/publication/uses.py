"""Cross references of a program: the jumps between its cards, and the cards that use each name and FORMAT.

The module reads the references from the syntax tree and runs no program.
"""

from collections.abc import Iterator
from dataclasses import dataclass, fields, is_dataclass
from functools import cache
from typing import Literal

from emulator.language import tree
from emulator.language.compiler import compile_deck
from emulator.language.parser import parse
from modern.edition import programs

# A card declares, sets or uses a name.
How = Literal["declared", "set", "used"]
_SIGNS = ("\u2212", "0", "+")


@dataclass(frozen=True, slots=True)
class Jump:
    """A reference from the card with the number ``card`` to the card ``target``.

    ``kind`` is ``jump`` for a transfer of control, ``again`` for the return from the last statement of a DO loop to the
    first, and ``format`` for an input or output statement that uses a FORMAT. ``taken`` is the condition of a jump, or
    empty if the jump is unconditional. For a FORMAT, ``taken`` is the verb of the statement.
    """

    card: int
    target: int
    taken: str
    kind: Literal["jump", "again", "format"]


@dataclass(frozen=True, slots=True)
class Name:
    """A name in a program with the cards that declare, set and use it.

    ``floating`` is True for a floating-point name and False for an integer.  ``shape`` has the dimensions of an array,
    and is empty for other names.  ``function`` is True for a library function.  ``declared``, ``set`` and ``used`` are
    numbers of cards.
    """

    name: str
    floating: bool
    shape: tuple[int, ...]
    function: bool
    declared: tuple[int, ...]
    set: tuple[int, ...]
    used: tuple[int, ...]


@dataclass(frozen=True)
class Uses:
    """The references between the cards of a deck, and the names on the cards."""

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
    """Return the cross references of a built-in program."""
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
    shapes = {entry.name: entry.shape for entry in compile_deck(deck).storage.entries}
    names = (
        Name(name, name[0] not in "IJKLMN", shapes.get(name, ()), name not in shapes, *map(tuple, how.values()))
        for name, how in sorted(cards_of.items())
    )
    return Uses(jumps, tuple(names))


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
        return
    assigned = [*_assigned(body)]
    for reference in _references(body):
        yield reference.name, "set" if any(reference is target for target in assigned) else "used"


def _assigned(part: tree.Body | tree.Item, is_input: bool = False) -> Iterator[tree.Reference]:
    """Yield the variables and array elements that a statement, or an item of an input or output list, sets."""
    if isinstance(part, tree.Assignment):
        yield part.target
    elif isinstance(part, tree.Do | tree.Loop):
        yield part.variable
    elif isinstance(part, tree.Reference) and is_input:
        yield part
    if isinstance(part, tree.InputOutput | tree.Loop):
        is_input = is_input or (isinstance(part, tree.InputOutput) and part.verb in ("READ", "ACCEPT"))
        for item in part.items:
            yield from _assigned(item, is_input)


def _references(part: object) -> Iterator[tree.Reference]:
    """Yield all references in a part of the syntax tree, also those in the arguments of another reference."""
    if isinstance(part, tree.Reference):
        yield part
    if isinstance(part, tuple):
        for inner in part:
            yield from _references(inner)
    elif is_dataclass(part):
        for field in fields(part):
            yield from _references(getattr(part, field.name))
