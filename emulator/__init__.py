"""An emulator of the IBM 1620 as a FORTRAN programmer used it.

It covers cards, compiler, interpreter, arithmetic, FORMAT, devices and timing.  The names below are the public
interface.  They are imported on first use, so that importing the package is fast.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from emulator.compiled.batch import run_batch
    from emulator.errors import CardError, CompileError, DeckError, Diagnostic, EmulatorError, FileError
    from emulator.language.cards import Card, Deck, deck_from_lines, deck_from_text, read_deck
    from emulator.language.compiler import compile_deck, translate
    from emulator.language.objectcode import Program
    from emulator.machine.divergence import Divergence, diverge
    from emulator.machine.endings import Ending
    from emulator.machine.machine import Machine
    from emulator.machine.result import Options, Result
    from emulator.machine.timing import Timing, measure
    from emulator.numbers.arithmetic import Profile, profile

_HOMES = {
    "emulator.numbers.arithmetic": ("Profile", "profile"),
    "emulator.compiled.batch": ("run_batch",),
    "emulator.language.cards": ("Card", "Deck", "deck_from_lines", "deck_from_text", "read_deck"),
    "emulator.language.compiler": ("compile_deck", "translate"),
    "emulator.machine.divergence": ("Divergence", "diverge"),
    "emulator.errors": ("CardError", "CompileError", "DeckError", "Diagnostic", "EmulatorError", "FileError"),
    "emulator.machine.machine": ("Machine",),
    "emulator.language.objectcode": ("Program",),
    "emulator.machine.endings": ("Ending",),
    "emulator.machine.result": ("Options", "Result"),
    "emulator.machine.timing": ("Timing", "measure"),
}

__all__ = [
    "Card",
    "CardError",
    "CompileError",
    "Deck",
    "DeckError",
    "Diagnostic",
    "Divergence",
    "EmulatorError",
    "Ending",
    "FileError",
    "Machine",
    "Options",
    "Profile",
    "Program",
    "Result",
    "Timing",
    "compile_deck",
    "deck_from_lines",
    "deck_from_text",
    "diverge",
    "measure",
    "profile",
    "read_deck",
    "run_batch",
    "translate",
]


def named(package: str, homes: Mapping[str, tuple[str, ...]], name: str) -> object:
    """Implement ``__getattr__`` of a package: import a public name from its module and cache it in the package.

    ``homes`` maps each module to its names.  Raise AttributeError for any other name.
    """
    for module, names in homes.items():
        if name in names:
            attribute: object = getattr(import_module(module), name)
            setattr(sys.modules[package], name, attribute)
            return attribute
    raise AttributeError(f"module {package!r} has no attribute {name!r}")


def __getattr__(name: str) -> object:
    return named(__name__, _HOMES, name)


def __dir__() -> list[str]:
    return sorted({*(name for name in globals() if name.startswith("__")), *__all__})
