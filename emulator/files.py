"""Reading and writing of files.  Every failure is a ``FileError`` with a one-line message.

All input files and results of the project pass through here.  Results are written atomically: the old file stays until
the new one is complete.  The path ``-`` is standard input or output.
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
    """Return the name that messages use for an input path."""
    return "standard input" if path == "-" else path


def read_bytes(path: str, name: str = "") -> bytes:
    """Return the contents of a file.  ``name`` replaces its path in messages.  Raise FileError if it cannot be read."""
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
    """Return the text of a UTF-8 file without its byte order mark.  Raise FileError if it cannot be read or decoded."""
    return decoded(read_bytes(path), source_name(path))


def decoded(data: bytes, source: str) -> str:
    """Decode UTF-8 without its byte order mark.  Raise FileError with the line and column of the first invalid byte."""
    data = data.removeprefix(BOM_UTF8)
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError as error:
        before = data[: error.start].decode("utf-8")
        line, column = before.count("\n") + 1, len(before) - before.rfind("\n")
        raise FileError(f"{source}: line {line}, column {column}: not a text file in UTF-8") from None


def reason(error: OSError) -> str:
    """Return the operating system's explanation of an error, which is appended to a message."""
    return (error.strerror or str(error)).lower()


def write_text(path: str, text: str) -> None:
    """Write an ASCII file atomically.  Raise FileError if it cannot be written."""
    with writing(path) as file:
        file.write(text)


def check_writable(*paths: str | None) -> None:
    """Check before a long run that all outputs can be written and that no two are the same file.  Raise FileError."""
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
        raise FileError("two outputs have the same file name")


# The beginning of the names of files that are still being written.
UNFINISHED = ".unfinished-"


@contextmanager
def writing(path: str) -> Iterator[TextIO]:
    """Open an ASCII file for writing and replace the old file when the block ends without an error.

    The text goes to a temporary file in the same folder, which is then renamed.  A symbolic link is followed and the
    mode of an existing file is kept.  A device or pipe is written directly.  Raise FileError if writing fails.
    """
    open_arguments = {"mode": "w", "encoding": "ascii", "errors": "backslashreplace", "newline": ""}
    with _writing(path, sys.stdout, open_arguments) as file:
        yield file


@contextmanager
def writing_bytes(path: str, durable: bool = False) -> Iterator[BinaryIO]:
    """Open a binary file for writing, like :func:`writing`.

    If ``durable``, the contents are on disk before the old file is replaced, so that they survive a power failure.
    """
    with _writing(path, getattr(sys.stdout, "buffer", None), {"mode": "wb"}, durable) as file:
        yield file


@contextmanager
def _writing(path: str, standard: Any, open_arguments: dict[str, str], durable: bool = False) -> Iterator[Any]:
    """Implement :func:`writing`.  ``standard`` is standard output as text or bytes."""
    if path == "-":
        yield standard
        standard.flush()
        return
    if not path:
        raise FileError("a file without a name cannot be written")
    temporary = ""
    try:
        target = Path(path).resolve()
        if target.exists() and not target.is_file():
            with target.open(**open_arguments) as file:  # type: ignore[call-overload]
                yield file
            return
        mode = target.stat().st_mode & 0o777 if target.exists() else 0o666 & ~_umask()
        handle, temporary = tempfile.mkstemp(prefix=UNFINISHED, dir=target.parent)
        with os.fdopen(handle, **open_arguments) as file:  # type: ignore[call-overload]
            yield file
            if durable:
                file.flush()
                os.fsync(file.fileno())
        os.chmod(temporary, mode)
        os.replace(temporary, target)
        temporary = ""
    except OSError as error:
        raise FileError(f"{path}: {reason(error)}") from None
    finally:
        if temporary and os.path.exists(temporary):
            os.unlink(temporary)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
