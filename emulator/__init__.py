"""An emulator of the IBM 1620 as a FORTRAN programmer used it.

It covers cards, compiler, interpreter, arithmetic, FORMAT, devices and timing.  :mod:`hull1620` lists its public names.
"""

# Part of the distribution hull1620.

from __future__ import annotations

import sys
from collections.abc import Mapping
from importlib import import_module


def named(package: str, homes: Mapping[str, tuple[str, ...]], name: str) -> object:
    """Import a public name from its module and cache it in the package.  This implements ``__getattr__`` of a package.

    ``homes`` maps each module to its names.  Raise AttributeError for any other name.
    """
    for module, names in homes.items():
        if name in names:
            attribute: object = getattr(import_module(module), name)
            setattr(sys.modules[package], name, attribute)
            return attribute
    raise AttributeError(f"module {package!r} has no attribute {name!r}")
