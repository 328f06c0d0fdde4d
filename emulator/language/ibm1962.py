"""The interface of IBM's library of 1962: entry points, and the digits of numbers, FORMATs and calls in core storage.

The facts were found by running the library in a simulator with hand-written object code
(docs/reference/ibm-library.md).  Here an integer represents a position of core storage: the digit, plus FLAG if the
position has a flag.  The flag is the bit that marks a minus sign or the left end of a field.
"""

import re
from collections.abc import Iterator, Sequence

from emulator.language.formats import FormatSpec, Literal, Slash
from emulator.numbers.fields import Field

FLAG = 16
RECORD_MARK = 10

# Entry points for input and output.  A statement first calls the routine of its verb with the address of the field that
# belongs to the number of its FORMAT.  It then calls ITEM with the address of each number of its list except the last
# one, for which it calls LAST_ITEM.  The address of a field is that of its last digit.
VERBS = {"READ": 4512, "ACCEPT": 4548, "ACCEPT TAPE": 4596}
VERBS |= {"PUNCH": 4748, "TYPE": 4796, "PRINT": 4796, "PUNCH TAPE": 4844}
ITEM, LAST_ITEM = 4992, 4940

# Entry points of arithmetic.  Each routine receives the address of its operand.  TO_FAC loads a field into FAC, and
# FROM_FAC stores FAC into a field, for both kinds of numbers.
TO_FAC, FROM_FAC = 1238, 1306
OPERATIONS = {"FAD": 518, "FSB": 408, "FMP": 1378, "FDV": 1862, "FDVR": 1756, "POWERX": 3670}
FIXED = {"XAD": 2644, "XSB": 2700, "XMP": 2748, "XDV": 2876, "XDVR": 2816}
# Operations on FAC alone.
ALONE = {"RSGN": 2546, "FLOAT": 3222, "FIX": 3494}

# The library stores a FORMAT in words of five digits.  A word is the address of a routine or, for a field, one digit
# for its letter, two for its width and two for its decimals.
OPEN, CLOSE, SLASH, LITERAL = 4044, 4076, 4136, 4264
KINDS = {"E": 5, "F": 6, "I": 9}

# The two-digit codes of the special characters.
_SPECIAL = dict(zip(" .)+$*-/,(=@'", (0, 3, 4, 10, 13, 14, 20, 21, 23, 24, 33, 34, 34), strict=True))
_NUMBER = re.compile(r"([+-]?)\.(\d{8})E([+-])(\d\d)")


def character_code(character: str) -> int:
    """Return the two-digit code by which the 1620 stores a character."""
    if character.isdigit():
        return 70 + int(character)
    for first, base in (("A", 41), ("J", 51), ("S", 62)):
        if first <= character <= chr(ord(first) + 8):
            return base + ord(character) - ord(first)
    return _SPECIAL[character]


def digits(number: int, count: int, *, negative: bool = False) -> list[int]:
    """Return a number as ``count`` digits of core storage, with a flag on the first, and on the last if negative."""
    positions = [int(digit) for digit in f"{number:0{count}}"]
    positions[0] |= FLAG
    positions[-1] |= FLAG if negative else 0
    return positions


def fixed_field(number: str) -> list[int]:
    """Return the ten storage positions that hold a fixed-point number such as ``-12`` or ``-0``."""
    return [0] * 6 + digits(abs(int(number)), 4, negative=number.startswith("-"))


def floating_field(number: str) -> list[int]:
    """Return the ten storage positions that hold a floating-point number such as ``-.25000000E+01``."""
    match = _NUMBER.fullmatch(number)
    if match is None:
        raise ValueError(f"{number!r} is not a number like .25000000E+01")
    sign, mantissa, below, exponent = match.groups()
    return digits(int(mantissa), 8, negative=sign == "-") + digits(int(exponent), 2, negative=below == "-")


def field_text(positions: Sequence[int], kind: str) -> str:
    """Return the number in ten positions as text: ``-0012`` for kind I, ``-.25000000E+01`` for kinds E and F."""
    text = "".join("0123456789|"[position % FLAG] for position in positions)
    if kind == "I":
        return ("-" if positions[9] & FLAG else "") + text[6:]
    mantissa = ("-" if positions[7] & FLAG else "") + "." + text[:8]
    return mantissa + "E" + ("-" if positions[9] & FLAG else "+") + text[8:]


def format_positions(spec: FormatSpec) -> list[int]:
    """Return a FORMAT in the coded form in which the library stores it, as digits of core storage."""
    return [position for word in _words(spec) for position in word]


def _words(spec: FormatSpec) -> Iterator[list[int]]:
    yield digits(OPEN, 5)
    for index, item in enumerate(spec.specs):
        # A list longer than the FORMAT continues after the last word OPEN that the library has passed.
        if index == spec.again and index:
            yield digits(OPEN, 5)
        if isinstance(item, Field):
            yield digits(KINDS[item.kind] * 10000 + item.width * 100 + item.decimals, 5, negative=True)
        elif isinstance(item, Slash):
            yield digits(SLASH, 5)
        else:
            yield from _literal(item)
    yield digits(CLOSE, 5)


def _literal(item: Literal) -> Iterator[list[int]]:
    yield digits(LITERAL, 5)
    yield digits(len(item.text), 2)
    for character in item.text:
        yield digits(character_code(character), 2)


def call(entry: int, address: int = 0) -> list[int]:
    """Return the twelve positions of an instruction that calls a library routine (BTM) or an input/output verb (BT).

    A call copies its operand to the position before the routine's entry.  A routine that works on FAC alone has no
    operand.  It is called by a BT that copies the position before the entry to itself, which changes nothing.
    """
    if entry in ALONE.values():
        return [int(digit) for digit in f"27{entry:05}{entry - 1:05}"]
    return [2 if entry in VERBS.values() else 1, 7, *digits(entry, 5), *digits(address, 5)]
