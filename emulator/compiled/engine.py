"""The engine compiled: the functions of emulator/compiled/deck.py and those they call, by numba, as they stand.

Numbers must fit into 64 bits: nine digits are the most, whose products have eighteen.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

from emulator.compiled import deck as unattended
from emulator.compiled import devices
from emulator.compiled import kernel as engine
from emulator.compiled.jit import NotInstalled, compiled
from emulator.language import cards, objectcode
from emulator.machine import interpreter, result
from emulator.machine.result import Options
from emulator.numbers import accumulator, arithmetic
from emulator.numbers import columns as conversion
from emulator.numbers.decimal import DecimalNumbers

MAX_DIGITS = 9
INSTEAD = "the plain engine runs instead"

_HELPERS = (
    accumulator.add,
    accumulator.subtract,
    accumulator.subtract_reversed,
    accumulator.multiply,
    accumulator.divide,
    accumulator.negate,
    accumulator.largest,
    accumulator.vanished,
    accumulator.divide_fixed,
    arithmetic.add,
    arithmetic.add_guarded,
    arithmetic.multiply,
    arithmetic.divide,
    arithmetic.from_integer,
    arithmetic.to_integer,
    arithmetic.wrap_integer,
    arithmetic.square_root,
    arithmetic.whole_power,
    conversion.squeeze,
    conversion.is_digit,
    conversion.read_floating,
    conversion.read_fixed,
    conversion.write_e,
    conversion.write_f,
    conversion.write_floating,
    conversion.write_fixed,
    engine.run,
    unattended.load,
    unattended.clear,
    unattended.run_deck,
    devices.begin,
    devices.to_field,
    devices.text,
    devices.column_of,
    devices.end_record,
    devices.put,
    devices.put_typed,
    devices.stamp,
    devices.error,
    devices.item,
)


def why_plain(options: Options) -> str:
    """Why the compiled engine cannot run with these options, one line; empty where it can.

    Code that cannot be made or loaded comes to light in :class:`emulator.compiled.runner.Runner`.
    """
    if not isinstance(options.numbers, DecimalNumbers):
        return f"the compiled engine has no {options.numbers.name} numbers: {INSTEAD}"
    if options.uncut:
        return f"the compiled engine keeps no numbers beside the cards: {INSTEAD}"
    profile = options.numbers.profile
    if profile.digits > MAX_DIGITS:
        return f"{profile.name} has {profile.digits} digits, the compiled engine has at most {MAX_DIGITS}: {INSTEAD}"
    try:
        run_decks()
    except NotInstalled as error:
        return f"{error}: {INSTEAD}"
    return ""


@cache
def run_decks() -> Callable[..., Any]:
    """:func:`emulator.compiled.deck.run_decks` compiled.  Raises emulator.compiled.jit.NotInstalled."""
    modules = (accumulator, arithmetic, cards, conversion, devices, engine, interpreter, objectcode, result, unattended)
    # Nothing is divided by zero and no array is made, so that numba need not look for the one nor count the other's
    # users, which takes half the time.
    return compiled([unattended.run_decks], _HELPERS, modules, error_model="numpy", _nrt=False)[0]
