"""An IBM 1620 as its FORTRAN programmer knew it: cards, compiler, engine, arithmetic, FORMAT, devices, time.

The names below are the public interface; they are imported when first used, so that importing the package
costs nothing.
"""

from __future__ import annotations

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
    "numbers.arithmetic": ("Profile", "profile"),
    "compiled.batch": ("run_batch",),
    "language.cards": ("Card", "Deck", "deck_from_lines", "deck_from_text", "read_deck"),
    "language.compiler": ("compile_deck", "translate"),
    "machine.divergence": ("Divergence", "diverge"),
    "errors": ("CardError", "CompileError", "DeckError", "Diagnostic", "EmulatorError", "FileError"),
    "machine.machine": ("Machine",),
    "language.objectcode": ("Program",),
    "machine.endings": ("Ending",),
    "machine.result": ("Options", "Result"),
    "machine.timing": ("Timing", "measure"),
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


def __getattr__(name: str) -> object:
    for module, names in _HOMES.items():
        if name in names:
            return getattr(import_module(f"emulator.{module}"), name)
    raise AttributeError(f"module 'emulator' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
