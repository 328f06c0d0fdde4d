"""The arithmetics tests run over: every one there is, and of a family a few of its members.

They are made from the emulator's own lists, so that a new set of rules or a new kind of number is tried everywhere.
"""

from __future__ import annotations

from emulator.compiled.runner import MAX_DIGITS as COMPILED_DIGITS
from emulator.numbers import HOSTED
from emulator.numbers.arithmetic import FAMILIES, MAX_DIGITS, MIN_DIGITS, PROFILES


def members(*digits: int) -> tuple[str, ...]:
    """The profiles of the time, and every family with each of these numbers of digits."""
    return (*PROFILES, *(family.replace("P", str(count)) for family in FAMILIES for count in digits))


DECIMAL = members(MIN_DIGITS, 5, MAX_DIGITS)
"""The 1620's decimal numbers, with the fewest digits, with five and with the most."""
COMPILED = members(MIN_DIGITS, 5, COMPILED_DIGITS)
"""Those the compiled engine takes."""
BINARY = tuple(name for name in HOSTED if name.startswith("float"))
SYSTEMS = (*(name.replace("BITS", "24") for name in HOSTED), *members(5))
"""One of each kind of number; all have three digits or more."""
