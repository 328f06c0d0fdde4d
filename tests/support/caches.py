"""Cached functions of modules, cleared before and after a test."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType


@contextmanager
def cleared(*modules: ModuleType) -> Iterator[None]:
    """Clear the caches of all functions of the modules, before and after."""
    kept = [
        found
        for module in modules
        for found in vars(module).values()
        if hasattr(found, "cache_clear") and found.__module__ == module.__name__
    ]
    for function in kept:
        function.cache_clear()
    try:
        yield
    finally:
        for function in kept:
            function.cache_clear()
