"""Functions compiled by numba (the extra ``fast``): compiled when first called, and kept in the user's cache folder."""

from __future__ import annotations

import hashlib
import inspect
import os
import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

Function = Callable[..., Any]


class NotInstalled(ValueError):
    """numba was asked for and is not there, or is no numba that compiles this; one line."""


def refused(error: Exception) -> NotInstalled:
    """What numba raised, as one line."""
    said = next(iter(str(error).strip().splitlines()), "")
    return NotInstalled(f"numba cannot make the compiled code: {type(error).__name__}{': ' if said else ''}{said}")


def compiled(
    entries: Sequence[Function], helpers: Sequence[Function], modules: Sequence[ModuleType] = (), **options: Any
) -> list[Function]:
    """The entries compiled; ``helpers`` are the functions they call, and call each other.

    All are written in what numba reads of Python.  Each entry is compiled for the types it is called with, which
    takes seconds once; the machine code is kept in :func:`cache_folder` if that can be written, else for this process
    only.  ``modules`` are those whose constants the functions use; ``options`` are numba's.

    Raises NotInstalled: without numba, with one that refuses the functions, and where NUMBA_DISABLE_JIT keeps it from
    compiling: as Python over numpy's arrays the functions compute something else (codes of eight bits overflow).
    """
    try:
        import numba
        from numba.extending import register_jitable
    except ImportError as error:
        raise NotInstalled(f"compiled code needs numba (extra fast): {error}") from None
    config: Any = numba.config
    if config.DISABLE_JIT:
        raise NotInstalled("compiled code is turned off by NUMBA_DISABLE_JIT")
    for helper in helpers:
        register_jitable(helper)
    before = config.CACHE_DIR
    folder = cache_folder(before, [*entries, *helpers, *modules], repr(options))
    try:
        # numba asks for the folder as it wraps a function, and only then.
        config.CACHE_DIR = str(folder or "")
        return [numba.njit(cache=folder is not None, **options)(entry) for entry in entries]
    except Exception as error:  # numba's own reasons, of no common kind; an option it does not know may wait for a call
        raise refused(error) from None
    finally:
        config.CACHE_DIR = before


def cache_folder(given: str, sources: Sequence[Function | ModuleType], options: str = "") -> Path | None:
    """The folder for code of these sources, below ``given`` (NUMBA_CACHE_DIR) or the user's cache.

    None if it cannot be written.  Its name is of the sources' text and of the options: numba itself looks only at the
    time of the file of an entry, not at what it calls.
    """
    text = "\0".join([options, *map(inspect.getsource, sources)])
    try:
        folder = (Path(given) if given else _users()) / hashlib.sha256(text.encode()).hexdigest()[:16]
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return folder
    except (OSError, RuntimeError):
        return None


def _users() -> Path:
    """Where this user's programs keep what they can make again.  Raises RuntimeError without a home folder."""
    if os.environ.get("XDG_CACHE_HOME"):
        base = Path(os.environ["XDG_CACHE_HOME"])
    elif sys.platform == "win32":
        base = Path(os.environ.get("LOCALAPPDATA") or Path.home())
    elif sys.platform == "darwin":
        base = Path.home() / "Library" / "Caches"
    else:
        base = Path.home() / ".cache"
    return base / "hull1620"
