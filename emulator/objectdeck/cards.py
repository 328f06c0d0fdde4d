"""Object decks: the cards of an object program, and their place in a deck with IBM's library.

The cards of IBM's loader precede the program in a deck.  A card of the program holds four control digits, the length of
its code, the code and a record mark.  The loader stores the code of each card after the code of the previous card, and
advances by the length.  A card with the bounds of the program, the data and the symbol table follows the code.  The
symbol table comes next, with six fields on each card, from the top of core storage downward.  Columns 77 to 80 number
all cards of a deck.
"""

from collections.abc import Iterator, Sequence

from emulator.errors import DeckError
from emulator.language.expressions import LIBRARY
from emulator.language.objectcode import Program
from emulator.language.storage import FIELD, Entry
from emulator.numbers.arithmetic import TRUNCATING
from emulator.numbers.fields import parse_constant
from emulator.objectdeck import digits as d
from emulator.objectdeck.addresses import Addresses
from emulator.objectdeck.digits import address, alphameric, flagged
from emulator.objectdeck.extent import extent
from emulator.objectdeck.generator import ObjectProgram, Unit, generate

_CODE_COLUMNS = 60
_FIELDS_A_CARD = 6
_NUMBER_COLUMN = 76
# The cards of IBM's loader, which precede the object program in a deck.
LOADER_CARDS = 54
END_OF_CODE = "]0]0999" + "0" + d.RECORD_MARK


def object_cards(program: Program, core: int) -> list[str]:
    """Return the cards of a program, without the library and card numbers, for a machine with ``core`` positions.

    Raise DeckError if the program needs a function that neither the library nor this project supplies, or if the
    program does not fit the machine.
    """
    code = generate(program, core)
    if code.missing:
        message = f"no routine for {' and '.join(code.missing)} is known; SQRT is the only function of object decks"
        raise DeckError(f"{program.source}: {message}")
    if overlap := extent(program).overlap(core):
        raise DeckError(f"{program.source}: {overlap}")
    table = list(symbol_table(program, code, core))
    lowest = Addresses(program, core).units(program.storage.fields)
    # This card holds the end of the code, the last position below the data, the end of the symbol table and the top of
    # core storage.
    lengths = address(code.end) + address(lowest) + address(core - 1 - FIELD * len(table)) + "]]000" + "0" * 45
    cards = [*_code_cards(code.units), END_OF_CODE, lengths + address(core - 1) + d.RECORD_MARK]
    for start in range(0, len(table), _FIELDS_A_CARD):
        cards.append("".join(reversed(table[start : start + _FIELDS_A_CARD])) + d.RECORD_MARK)
    return cards


def _code_cards(units: Sequence[Unit]) -> Iterator[str]:
    """Yield the cards that hold the code.  A record mark in the code ends its card, because the loader stops there."""
    for unit in units:
        digits = unit.digits
        while digits:
            mark = digits.find(d.RECORD_MARK)
            piece = digits[: min(_CODE_COLUMNS, mark + 1 if mark >= 0 else _CODE_COLUMNS)]
            # Zeros after a record mark count in the length of the card, but are not punched.
            length = len(piece)
            while piece.endswith(d.RECORD_MARK) and digits[length : length + 1] == "0":
                length += 1
            yield f"]0]0{flagged(f'{length:03d}')}{piece.removesuffix(d.RECORD_MARK)}{d.RECORD_MARK}"
            digits = digits[length:]


def symbol_table(program: Program, code: ObjectProgram, core: int) -> Iterator[str]:
    """Yield the entries of the deck's symbol table, in the order of storage from the top downward."""
    for name in LIBRARY:
        entry = code.functions.get(name)
        yield alphameric(name) if entry is None else _label(entry, 0)
        yield alphameric(name + "F")
    addresses = Addresses(program, core)
    formats = {str(label) for label, _ in program.formats}
    for entry_ in program.storage.entries:
        yield from _fields(entry_, addresses, code, formats)


def _fields(entry: Entry, addresses: Addresses, code: ObjectProgram, formats: set[str]) -> Iterator[str]:
    """Yield the symbol table's entry for a variable, or its two entries for an array."""
    name = entry.name
    if entry.kind == "statement number":
        label = name.removeprefix("after ")
        # No field belongs to a statement number that is used but not defined, because such a program does not compile.
        yield _label(code.labels[name], int(label), "K" if label in formats else "]")
    elif entry.kind == "constant":
        yield _constant(name.removeprefix("constant "))
    elif entry.kind == "temporary":
        yield "]000000" + flagged(f"{int(name.removeprefix('temporary ')):03d}")
    else:
        yield alphameric(name)
        if entry.shape:
            yield d.wide_immediate(entry.shape[0]) + address(addresses.units(entry.first + entry.size - 1))


def _label(position: int, number: int, kind: str = "]") -> str:
    return address(position) + kind + flagged(f"{number:04d}")


def _constant(text: str) -> str:
    if "." not in text:
        digits = flagged(f"{int(text):04d}")
        return "]00000" + digits[:-1] + d.FLAGGED[int(digits[-1])]
    return d.floating_field(*parse_constant(text, TRUNCATING.rules))


def with_library(cards: Sequence[str], library: Sequence[str], source: str) -> list[str]:
    """Return the deck ``library``, which includes IBM's library, with its program replaced by ``cards``.

    The data cards after the library are left out.  Raise DeckError if ``library`` is not a deck with the library.
    """
    end = 0
    while end < len(library) and library[end][_NUMBER_COLUMN:].rstrip() == _number(end + 1):
        end += 1
    ends = [index for index, card in enumerate(library[:end]) if card.startswith(END_OF_CODE)]
    lengths = library[ends[0] + 1] if len(ends) == 1 and ends[0] + 1 < end else ""
    top, end_of_table = (_plain(lengths[start : start + 5]) for start in (65, 10))
    if end > LOADER_CARDS and (top + end_of_table).isdecimal():
        after = ends[0] + 2 - (int(end_of_table) - int(top)) // FIELD // _FIELDS_A_CARD
        if ends[0] + 2 < after < end:
            return numbered([*library[:LOADER_CARDS], *cards, *library[after:end]], 1)
    raise DeckError(
        f"{source}: expected an object deck of IBM 1620 FORTRAN with its library, whose cards are numbered from 1 "
        f"in columns 77 to 80; found {end} such cards{' without a valid symbol table' if end > LOADER_CARDS else ''}"
    )


def numbered(cards: Sequence[str], first: int) -> list[str]:
    """Return the cards with new card numbers in columns 77 to 80, counted from ``first``."""
    return [f"{card[:_NUMBER_COLUMN]:<{_NUMBER_COLUMN}}{_number(index)}" for index, card in enumerate(cards, first)]


def _number(index: int) -> str:
    return flagged(f"{index % 10000:04d}")


def _plain(digits: str) -> str:
    return "".join(str(d.FLAGGED.index(digit)) if digit in d.FLAGGED else digit for digit in digits)
