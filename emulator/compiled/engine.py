"""The engine compiled: the functions of emulator/compiled/deck.py and those they call, by numba, as they stand.

Numbers must fit into 64 bits: nine digits are the most, whose products have eighteen.
"""

from __future__ import annotations

from functools import cache

from emulator.compiled import deck as unattended
from emulator.compiled.jit import Compiled, NotInstalled
from emulator.machine.result import Options
from emulator.numbers.decimal import DecimalNumbers

MAX_DIGITS = 9
INSTEAD = "the plain engine runs instead"


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
def run_decks() -> Compiled:
    """:func:`emulator.compiled.deck.run_decks` for numba to compile.  Raises emulator.compiled.jit.NotInstalled."""
    # Nothing is divided by zero and no array is made, so that numba need not look for the one nor count the other's
    # users, which takes a quarter of the running time.
    return Compiled(unattended.run_decks, error_model="numpy", _nrt=False)
