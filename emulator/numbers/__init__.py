"""Arithmetics (number systems) for object code: the 1620's decimal numbers, and binary and exact numbers.

:func:`numbers` returns a system by name, and :mod:`emulator.machine.interpreter` runs object code with it.

To add a decimal arithmetic, for example one that keeps eight digits, rounds quotients and truncates all other results:

1. If :data:`~emulator.numbers.arithmetic.Rules` can express it, add a :class:`~emulator.numbers.arithmetic.Profile`
   to ``PROFILES`` in ``arithmetic.py``, with its source in a comment, as ``ibm1962`` does:
   ``Profile("mine", rules_of(8, quotients=1))``.  For a family with any number of digits, such as ``mine:P``, add an
   entry to ``_FAMILIES`` in that module.  The programs and the port then accept the name, and so does the compiled
   engine up to nine digits.
2. For a rule that ``Rules`` cannot express, add a field to ``Rules`` and an argument to ``rules_of``.  Implement it in
   ``arithmetic.py`` (digits) or ``accumulator.py`` (zeros, signs, overflow), and nowhere else.
3. Add the name to the help of ``--arithmetic`` in ``modern/cli/shared/arguments.py`` and to the tables in
   ``docs/reference/machine.md`` and ``docs/how-to/own-arithmetic.md``.
4. Add tests: the name in ``tests/emulator/numbers/test_arithmetic_laws.py``, measured results with their source in
   ``tests/data/vectors/``, and the rules in ``tests/support/published/specification.py`` with lines of results that
   follow from them.

To add numbers that are not decimal, write a subclass of :class:`~emulator.numbers.base.Numbers` in a new module here,
add its name to :data:`HOSTED` and create it in :func:`hosted`.  Continue with steps 3 and 4, where the test is
``test_number_systems.py``.  ``modern/port/__init__.py`` explains how the port gets the arithmetic.
"""

from __future__ import annotations

from emulator.errors import ArgumentError, expect
from emulator.numbers.arithmetic import Profile, profile, size_in
from emulator.numbers.base import Number, Numbers, Trap, Undecided
from emulator.numbers.decimal import DecimalNumbers

__all__ = [
    "HOSTED",
    "INTERVAL",
    "RANDOM",
    "DecimalNumbers",
    "Number",
    "Numbers",
    "Trap",
    "Undecided",
    "hosted",
    "numbers",
]

# The names of the arithmetics that are not decimal profiles, those that round at random, and intervals.
HOSTED = ("float64", "float32", "mp:BITS", "exact")
RANDOM = ("stochastic:P:SEED", "stochastic:BITSb:SEED")
INTERVAL = "interval:P"


def hosted(name: str) -> Numbers | None:
    """Return the arithmetic with this name, such as ``float64`` or ``exact``, or None for a decimal or unknown name.

    Raise ArgumentError if the number of bits or digits is out of range.
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

        return MultiprecisionNumbers(size_in(name, count, MIN_BITS, MAX_BITS, "bits"))
    if family == "stochastic":
        from emulator.numbers.stochastic import stochastic

        return stochastic(name)
    if family == "interval" and colon:
        from emulator.numbers.interval import MAX_DIGITS, MIN_DIGITS, IntervalNumbers

        return IntervalNumbers(size_in(name, count, MIN_DIGITS, MAX_DIGITS, "digits"))
    return None


def numbers(name: str | Profile) -> Numbers:
    """Return the arithmetic with this name or profile.  Raise ArgumentError for an unknown name."""
    expect(name, (str, Profile), "name")
    if isinstance(name, Profile):
        return DecimalNumbers(name)
    system = hosted(name)
    if system is not None:
        return system
    try:
        return DecimalNumbers(profile(name))
    except ArgumentError as error:
        more = f", {', '.join((*HOSTED, *RANDOM, INTERVAL))}" if str(error).startswith("no arithmetic") else ""
        raise ArgumentError(f"{error}{more}") from None
