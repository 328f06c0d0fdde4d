"""Functions compiled by numba (the extra ``fast``): compiled when first needed, and kept where numba keeps code.

That is the folder ``NUMBA_CACHE_DIR``; where none is given, ``__pycache__`` beside the source, or the user's cache
folder if that cannot be written.
"""

from __future__ import annotations

import gc
import hashlib
import inspect
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any

Function = Callable[..., Any]


class NotInstalled(ValueError):
    """Compiled code was asked for, and numba is missing, turned off, or cannot make it; one line."""


class Compiled:
    """A function, with all it calls, that numba compiles for the types it is to be called with."""

    def __init__(self, entry: Function, **options: Any) -> None:
        """``entry`` and what it calls are written in the part of Python that numba compiles; ``options`` are numba's.

        Raises NotInstalled without numba, and where NUMBA_DISABLE_JIT keeps it from compiling: as Python over numpy's
        arrays the functions compute something else (codes of eight bits overflow).
        """
        try:
            import numba
        except ImportError as error:
            raise NotInstalled(f"compiled code needs numba: pip install 'hull1620[fast]' ({error})") from None
        config: Any = numba.config
        if config.DISABLE_JIT:
            raise NotInstalled("compiled code is turned off by NUMBA_DISABLE_JIT")
        for helper in called(entry)[1:]:
            _make_callable(helper)
        # numba looks for changes only in the file of the entry: the name stands for the source of all that it calls.
        self._entry = FunctionType(entry.__code__, entry.__globals__, entry.__name__, entry.__defaults__)
        self._entry.__qualname__ += "_" + digest(entry, repr(options))
        self._jit = numba.njit(**options)
        self.function: Any = self._jit(self._entry)
        with suppress(RuntimeError):  # no folder can be written: the code is for this process only
            self.function = numba.njit(cache=True, **options)(self._entry)

    @property
    def keeps(self) -> bool:
        """Whether there is a folder to keep the code in."""
        return bool(self.function.stats.cache_path)

    @property
    def kept(self) -> bool:
        """Whether code of this function is kept already, for whatever types."""
        return any(self._indexes())

    def ready(self, *arguments: Any) -> Function:
        """The function compiled for the types of these arguments, or loaded: seconds, once, told on a terminal.

        Kept code that cannot be read is thrown away; what is compiled instead is for this process only.  Raises
        NotInstalled where numba cannot compile the function.
        """
        import numba

        types = tuple(map(numba.typeof, arguments))
        fresh = types not in self.function.overloads and self.keeps and not self.kept
        with _said(f"compiling {self._entry.__name__}, once: some seconds" if fresh else ""), _without_collecting():
            try:
                self.function.compile(types)
            except Exception:  # of no common kind: whatever a damaged file leads to
                self._forget()
                self.function = self._jit(self._entry)
                try:
                    self.function.compile(types)
                except Exception as error:
                    raise _refused(error) from None
        return self.function  # type: ignore[no-any-return]

    def _indexes(self) -> Iterator[Path]:
        if self.keeps:
            yield from Path(self.function.stats.cache_path).glob(f"*.{self._entry.__qualname__}-*.nbi")

    def _forget(self) -> None:
        for index in self._indexes():
            with suppress(OSError):
                index.unlink()


@contextmanager
def _said(line: str) -> Iterator[None]:
    """A line on the terminal, if there is one, wiped out at the end."""
    file = sys.stderr if line and sys.stderr is not None and sys.stderr.isatty() else None
    with suppress(OSError):
        print(line, end="", file=file, flush=True) if file else None
    try:
        yield
    finally:
        with suppress(OSError):
            print(f"\r{' ' * len(line)}\r", end="", file=file, flush=True) if file else None


@contextmanager
def _without_collecting() -> Iterator[None]:
    """Python's search for cycles is put off: a compiler makes millions of objects and drops few.

    With it compiling takes a sixth longer.
    """
    on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if on:
            gc.enable()


def _refused(error: Exception) -> NotInstalled:
    """What numba raised, as one line."""
    said = next(iter(str(error).strip().splitlines()), "")
    return NotInstalled(f"numba cannot make the compiled code: {type(error).__name__}{': ' if said else ''}{said}")


def called(entry: Function) -> list[Function]:
    """The function, those it calls by their names, and those that these call."""
    found = [entry]
    for function in found:
        used = inspect.getclosurevars(function).globals.values()
        found += [value for value in used if isinstance(value, FunctionType) and value not in found]
    return found


@cache
def _make_callable(helper: Function) -> None:
    """Let compiled code call the function; called as Python it stays what it is."""
    from numba.extending import register_jitable

    from emulator.jit import inlining

    options = {"pipeline_class": inlining.PartCompiler} if inlining.AVAILABLE else {"inline": "never"}
    register_jitable(**options)(helper)


def digest(entry: Function, options: str) -> str:
    """What the compiled code depends on, in 16 letters: modules of the functions, constants they use, options."""
    functions = called(entry)
    text = [options]
    for module in dict.fromkeys(function.__module__ for function in functions):
        text.append(inspect.getsource(sys.modules[module]))
    for function in functions:
        for name, value in inspect.getclosurevars(function).globals.items():
            if not isinstance(value, (FunctionType, ModuleType)):
                text.append(f"{name} {value!r}")
    return hashlib.sha256("\0".join(text).encode()).hexdigest()[:16]
