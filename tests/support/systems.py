"""The arithmetics that tests use: all of them, with a few members of each family.

They are taken from the emulator's own lists, so that every test also covers a new arithmetic.
"""

from emulator.compiled.runner import MAX_DIGITS as COMPILED_DIGITS
from emulator.numbers import HOSTED
from emulator.numbers.arithmetic import FAMILIES, MAX_DIGITS, MIN_DIGITS, PROFILES


def members(*digits: int) -> tuple[str, ...]:
    """Return the profiles of the time, and every family with each of these numbers of digits."""
    return (*PROFILES, *(family.replace("P", str(count)) for family in FAMILIES for count in digits))


DECIMAL = members(MIN_DIGITS, 5, MAX_DIGITS)
"""The decimal arithmetics, with the fewest digits, five, and the most."""
COMPILED = members(MIN_DIGITS, 5, COMPILED_DIGITS)
"""The arithmetics that the compiled engine supports."""
BINARY = tuple(name for name in HOSTED if name.startswith("float"))
SYSTEMS = (*(name.replace("BITS", "24") for name in HOSTED), *members(5))
"""One arithmetic of each kind, with three or more digits."""
