"""Files read and written: every trouble with one is a ``FileError``, one clear line.

Decks, points, volumes, scenes and plans all come from files and all results go to files, so this stands at the bottom,
beside the errors.  A path ``-`` is standard input or output.
"""

from __future__ import annotations

import os
import sys
import tempfile
from codecs import BOM_UTF8
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, BinaryIO, TextIO

from emulator.errors import FileError


def source_name(path: str) -> str:
    """What messages call a path that is read."""
    return "standard input" if path == "-" else path


def read_bytes(path: str, name: str = "") -> bytes:
    """All bytes of a file.  ``name``: what messages call it.  Raises FileError."""
    if path == "-" and (sys.stdin is None or sys.stdin.closed):
        raise FileError("standard input is closed")
    if not path:
        raise FileError("a file without a name cannot be read")
    try:
        return sys.stdin.buffer.read() if path == "-" else Path(path).read_bytes()
    except OSError as error:
        raise FileError(f"{name or source_name(path)}: {reason(error)}") from None
    except ValueError:
        raise FileError(f"{name or repr(path)}: not a file name") from None


def read_text(path: str) -> str:
    """The text of a file in UTF-8, without a byte order mark.  Raises FileError, naming the line of a wrong byte."""
    return decoded(read_bytes(path), source_name(path))


def decoded(data: bytes, source: str) -> str:
    """Bytes as text in UTF-8, without a byte order mark.  Raises FileError, naming the line of a wrong byte."""
    data = data.removeprefix(BOM_UTF8)
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError as error:
        before = data[: error.start].decode("utf-8")
        line, column = before.count("\n") + 1, len(before) - before.rfind("\n")
        raise FileError(f"{source}: line {line}, column {column}: not a text file in UTF-8") from None


def reason(error: OSError) -> str:
    """Why the system refused, for the end of a message."""
    return (error.strerror or str(error)).lower()


def write_text(path: str, text: str) -> None:
    """Write a file whole or not at all.  Raises FileError when it cannot be written."""
    with writing(path) as file:
        file.write(text)


def check_writable(*paths: str | None) -> None:
    """Refuse a file that cannot be written before the run, not after it, and two outputs to one file.

    Raises FileError.
    """
    named = [path for path in paths if path is not None and path != "-"]
    for path in named:
        if not path:
            raise FileError("a file without a name cannot be written")
        folder = os.path.dirname(os.path.realpath(path))
        if os.path.isdir(path):
            raise FileError(f"{path}: is a directory")
        if not os.path.isdir(folder):
            raise FileError(f"{path}: no such file or directory")
        if not os.access(path if os.path.exists(path) else folder, os.W_OK):
            raise FileError(f"{path}: permission denied")
    real = [os.path.realpath(path) for path in named if os.path.isfile(path) or not os.path.exists(path)]
    if len(set(real)) < len(real):
        raise FileError("two outputs are to go to one file")


@contextmanager
def writing(path: str) -> Iterator[TextIO]:
    """A text file to write: beside its place first, then renamed, so that it appears whole or not at all.

    A link is followed, an existing file keeps its mode, and what is not a plain file (a device, a pipe) is written
    directly.  Raises FileError when it cannot be written.
    """
    how = {"mode": "w", "encoding": "ascii", "errors": "backslashreplace", "newline": ""}
    with _writing(path, sys.stdout, how) as file:
        yield file


@contextmanager
def writing_bytes(path: str) -> Iterator[BinaryIO]:
    """As ``writing``, for a file of bytes."""
    with _writing(path, getattr(sys.stdout, "buffer", None), {"mode": "wb"}) as file:
        yield file


@contextmanager
def _writing(path: str, standard: Any, how: dict[str, str]) -> Iterator[Any]:
    """``standard`` is standard output in the form wanted, ``how`` the arguments of ``open``."""
    if path == "-":
        yield standard
        standard.flush()
        return
    if not path:
        raise FileError("a file without a name cannot be written")
    beside = ""
    try:
        target = Path(path).resolve()
        if target.exists() and not target.is_file():
            with target.open(**how) as file:  # type: ignore[call-overload]
                yield file
            return
        mode = target.stat().st_mode & 0o777 if target.exists() else 0o666 & ~_umask()
        handle, beside = tempfile.mkstemp(prefix=f".{target.name}.", dir=target.parent)
        with os.fdopen(handle, **how) as file:  # type: ignore[call-overload]
            yield file
        os.chmod(beside, mode)
        os.replace(beside, target)
        beside = ""
    except OSError as error:
        raise FileError(f"{path}: {reason(error)}") from None
    finally:
        if beside and os.path.exists(beside):
            os.unlink(beside)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
