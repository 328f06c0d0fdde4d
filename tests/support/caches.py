"""Cached functions of modules, cleared before and after a test."""

from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType


@contextmanager
def cleared(*modules: ModuleType) -> Iterator[None]:
    """Clear the caches of all functions of the modules, before and after."""
    cached_functions = [
        member
        for module in modules
        for member in vars(module).values()
        if hasattr(member, "cache_clear") and member.__module__ == module.__name__
    ]
    for function in cached_functions:
        function.cache_clear()
    try:
        yield
    finally:
        for function in cached_functions:
            function.cache_clear()
