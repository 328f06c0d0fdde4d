"""Number systems for the object code: the same program over binary, exact or decimal numbers of Python.

:func:`numbers` gives one by its name; :mod:`emulator.machine.interpreter` runs object code over it.
"""

from __future__ import annotations

from emulator.numbers.arithmetic import Profile, profile
from emulator.numbers.base import Number, Numbers, Trap, Undecided
from emulator.numbers.decimal import DecimalNumbers

__all__ = ["HOSTED", "DecimalNumbers", "Number", "Numbers", "Trap", "Undecided", "hosted", "numbers"]

HOSTED = ("float64", "float32", "mp:BITS", "exact")
"""The names of arithmetics that are not decimal profiles of emulator/numbers/arithmetic.py."""


def hosted(name: str) -> Numbers | None:
    """The system ``float64``, ``float32``, ``mp:BITS`` or ``exact``; None for any other name.

    Raises ValueError for a number of bits out of range.
    """
    if name in ("float64", "float32"):
        from emulator.numbers.binary import FloatNumbers

        return FloatNumbers(name)
    if name == "exact":
        from emulator.numbers.exact import ExactNumbers

        return ExactNumbers()
    family, colon, count = name.partition(":")
    if family == "mp" and colon:
        from emulator.numbers.multiprecision import MAX_BITS, MIN_BITS, MultiprecisionNumbers

        if not (count.isdecimal() and count.isascii() and len(count) < 9 and MIN_BITS <= int(count) <= MAX_BITS):
            raise ValueError(f"{name}: the number of bits is {MIN_BITS} to {MAX_BITS}")
        return MultiprecisionNumbers(int(count))
    return None


def numbers(name: str | Profile) -> Numbers:
    """The system of that name, a profile's name included.  Raises ValueError for a name there is not."""
    if isinstance(name, Profile):
        return DecimalNumbers(name)
    found = hosted(name)
    if found is not None:
        return found
    try:
        return DecimalNumbers(profile(name))
    except ValueError as error:
        more = f", {', '.join(HOSTED)}" if str(error).startswith("no arithmetic") else ""
        raise ValueError(f"{error}{more}") from None
