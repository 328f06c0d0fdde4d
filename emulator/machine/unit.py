"""What a machine asks of its arithmetic outside the engine: constants, fields of cards, library functions, text.

A field of storage is a pair: of the decimal engine (emulator/compiled/kernel.py) mantissa and exponent; of the hosted
one (emulator/machine/interpreter.py) a number of its system and FLOATING.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

from emulator.language.formats import Field
from emulator.machine.interpreter import FLOATING
from emulator.numbers import functions
from emulator.numbers.arithmetic import Rules
from emulator.numbers.base import Number, Numbers
from emulator.numbers.fields import FALLBACK, parse_constant, read_floating, write_floating

Stored = tuple[Any, int]


class Unit(Protocol):
    """An arithmetic as the machine sees it.  Methods that compute give an error code too, empty for none."""

    def constant(self, text: str) -> Stored:
        """A floating constant.  Raises FieldError."""

    def read(self, field: Field, columns: str) -> tuple[Stored, str]:
        """A number from columns, and a warning.  Raises FieldError."""

    def write(self, field: Field, stored: Stored) -> tuple[str, bool]:
        """A number's columns, and whether it overflowed its field.  Raises Undecided."""

    def function(self, name: str, stored: Stored) -> tuple[Stored, str]: ...

    def power(self, base: Stored, exponent: Stored) -> tuple[Stored, str]: ...

    def integer_power(self, base: Stored, count: int) -> tuple[Stored, str]: ...

    def text(self, stored: Stored) -> str:
        """The number for a trace."""


@dataclass(frozen=True, slots=True)
class DecimalUnit:
    """The functions and fields of a decimal profile."""

    rules: Rules

    def constant(self, text: str) -> Stored:
        return parse_constant(text, self.rules)

    def read(self, field: Field, columns: str) -> tuple[Stored, str]:
        found = read_floating(field, columns, self.rules)
        return (found.mantissa, found.exponent), found.warning

    def write(self, field: Field, stored: Stored) -> tuple[str, bool]:
        return write_floating(field, *stored, self.rules)

    def function(self, name: str, stored: Stored) -> tuple[Stored, str]:
        return _coded(functions.function(name, *stored, self.rules))

    def power(self, base: Stored, exponent: Stored) -> tuple[Stored, str]:
        return _coded(functions.power(base, exponent, self.rules))

    def integer_power(self, base: Stored, count: int) -> tuple[Stored, str]:
        return _coded(functions.integer_power(*base, count, self.rules))

    def text(self, stored: Stored) -> str:
        return write_floating(FALLBACK, *stored, self.rules)[0].strip()


def _coded(value: functions.Value) -> tuple[Stored, str]:
    return (value.mantissa, value.exponent), value.code


@dataclass(frozen=True, slots=True)
class HostedUnit:
    """A number system's."""

    numbers: Numbers

    def constant(self, text: str) -> Stored:
        return self.numbers.constant(text), FLOATING

    def read(self, field: Field, columns: str) -> tuple[Stored, str]:
        value, warning = self.numbers.read(field, columns)
        return (value, FLOATING), warning

    def write(self, field: Field, stored: Stored) -> tuple[str, bool]:
        return self.numbers.write(field, stored[0])

    def function(self, name: str, stored: Stored) -> tuple[Stored, str]:
        return _hosted(self.numbers.function(name, stored[0]))

    def power(self, base: Stored, exponent: Stored) -> tuple[Stored, str]:
        return _hosted(self.numbers.power(base[0], exponent[0]))

    def integer_power(self, base: Stored, count: int) -> tuple[Stored, str]:
        return _hosted(self.numbers.integer_power(base[0], count))

    def text(self, stored: Stored) -> str:
        return self.numbers.text(stored[0])


def _hosted(found: tuple[Number, str]) -> tuple[Stored, str]:
    value, code = found
    return (value, FLOATING), code
