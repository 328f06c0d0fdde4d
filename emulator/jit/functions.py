"""Functions that numba (the extra ``fast``) compiles when they are first needed, and keeps in its cache.

The cache is the folder ``NUMBA_CACHE_DIR``.  Without this variable it is ``__pycache__`` next to the source, or the
user's cache folder if ``__pycache__`` cannot be written.
"""

import hashlib
import inspect
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any

from emulator.errors import ArgumentError

Function = Callable[..., Any]


class NotInstalled(ArgumentError):
    """Raised with a one-line message if numba is missing, turned off, or cannot compile a function."""


def require_numba() -> Any:
    """Return the module numba.  Raise NotInstalled if it is missing, or turned off by NUMBA_DISABLE_JIT."""
    try:
        import numba
    except ImportError as error:
        raise NotInstalled(f"compiled code needs numba: pip install 'hull1620[fast]' ({error})") from None
    config: Any = numba.config
    if config.DISABLE_JIT:
        raise NotInstalled("the environment variable NUMBA_DISABLE_JIT turns compiled code off")
    return numba


class Compiled:
    """A function that numba compiles for given argument types, together with all functions it calls."""

    def __init__(self, entry: Function, **options: Any) -> None:
        """Prepare ``entry`` for compilation with the given options of numba.

        Raise NotInstalled if numba is missing or NUMBA_DISABLE_JIT is set.  The functions must not run uncompiled on
        NumPy arrays, because eight-bit elements would overflow and change the results.
        """
        numba = require_numba()
        for helper in called(entry)[1:]:
            _make_callable(helper)
        # numba's cache detects changes only in the file that defines ``entry``.  A change in another file changes the
        # digest in the name, so that numba compiles again.
        self._entry = FunctionType(entry.__code__, entry.__globals__, entry.__name__, entry.__defaults__)
        self._entry.__qualname__ += "_" + digest(entry, repr(options))
        self._jit = numba.njit(**options)
        self.function: Any = self._jit(self._entry)
        with suppress(RuntimeError):  # if no cache folder can be written, the compiled code serves this process only
            self.function = numba.njit(cache=True, **options)(self._entry)

    @property
    def keeps(self) -> bool:
        """True if numba has a folder in which it can store the compiled code for the next process."""
        return bool(self.function.stats.cache_path)

    @property
    def kept(self) -> bool:
        """True if numba's cache already holds this function, compiled for any types of arguments."""
        return any(self._indexes())

    @property
    def must_compile(self) -> bool:
        """True if a call of :meth:`ready` would compile the function now and store the result in the cache."""
        return self.keeps and not self.kept and not self.function.overloads

    def ready(self, *arguments: Any) -> Function:
        """Return the function compiled for the types of these arguments.

        The first call for these types compiles the function, which takes some seconds and is reported on a terminal.
        Damaged code in the cache is deleted, and the function is compiled for this process only.  Raise NotInstalled if
        numba cannot compile the function.
        """
        import numba

        types = tuple(map(numba.typeof, arguments))
        # Loading from the cache takes only a fraction of a second, so it is not reported.
        fresh = types not in self.function.overloads and self.keeps and not self.kept
        with _shown(f"compiling {self._entry.__name__}; this takes some seconds, but only once" if fresh else ""):
            try:
                self.function.compile(types)
            except Exception:  # a damaged file in the cache can lead to any exception
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
def _shown(line: str) -> Iterator[None]:
    """Show a line on the terminal, if there is one, while the block runs, and erase the line at the end."""
    file = sys.stderr if line and sys.stderr is not None and sys.stderr.isatty() else None
    with suppress(OSError):
        print(line, end="", file=file, flush=True) if file else None
    try:
        yield
    finally:
        with suppress(OSError):
            print(f"\r{' ' * len(line)}\r", end="", file=file, flush=True) if file else None


def _refused(error: Exception) -> NotInstalled:
    message = next(iter(str(error).strip().splitlines()), "")
    return NotInstalled(f"numba cannot compile the code: {type(error).__name__}{': ' if message else ''}{message}")


def called(entry: Function) -> list[Function]:
    """Return a list of the function and all functions that it calls, directly or indirectly."""
    functions = [entry]
    # The list grows during the loop: a breadth-first search of the call graph.
    for function in functions:
        names = inspect.getclosurevars(function).globals.values()
        functions += [value for value in names if isinstance(value, FunctionType) and value not in functions]
    return functions


@cache
def _make_callable(helper: Function) -> None:
    """Let compiled code call the function.  A call from Python still runs it uncompiled."""
    from numba.extending import register_jitable

    register_jitable(helper)


def digest(entry: Function, options: str) -> str:
    """Return a hash of everything that determines the compiled code: modules, constants and options."""
    functions = called(entry)
    text = [options]
    # numba compiles globals into the code as constants, so that their values count as well as the source.
    for module in dict.fromkeys(function.__module__ for function in functions):
        text.append(inspect.getsource(sys.modules[module]))
    for function in functions:
        for name, value in inspect.getclosurevars(function).globals.items():
            if isinstance(value, ModuleType):
                constants = {key: getattr(value, key, None) for key in function.__code__.co_names}
                text += [f"{name}.{key} {n!r}" for key, n in constants.items() if isinstance(n, (int, float))]
            elif not isinstance(value, FunctionType):
                text.append(f"{name} {value!r}")
    return hashlib.sha256("\0".join(text).encode()).hexdigest()[:16]
