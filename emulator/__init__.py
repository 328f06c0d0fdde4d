"""An IBM 1620 as its FORTRAN programmer knew it: cards, compiler, engine, arithmetic, FORMAT, devices, time.

The names below are the public interface; they are imported when first used, so that importing the package
costs nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from emulator.arithmetic import Profile, profile
    from emulator.batch import run_batch
    from emulator.cards import Card, Deck, deck_from_lines, deck_from_text, read_deck
    from emulator.compiler import compile_deck, translate
    from emulator.divergence import Divergence, diverge
    from emulator.errors import CardError, CompileError, DeckError, Diagnostic, EmulatorError
    from emulator.machine import Machine
    from emulator.objectcode import Program
    from emulator.result import Ending, Options, Result
    from emulator.timing import Timing, measure

_HOMES = {
    "arithmetic": ("Profile", "profile"),
    "batch": ("run_batch",),
    "cards": ("Card", "Deck", "deck_from_lines", "deck_from_text", "read_deck"),
    "compiler": ("compile_deck", "translate"),
    "divergence": ("Divergence", "diverge"),
    "errors": ("CardError", "CompileError", "DeckError", "Diagnostic", "EmulatorError"),
    "machine": ("Machine",),
    "objectcode": ("Program",),
    "result": ("Ending", "Options", "Result"),
    "timing": ("Timing", "measure"),
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
