"""Reading and writing of files.  Every failure is a ``FileError`` with a one-line message.

All input files and results of the project pass through this module.  Results are written atomically: the old file stays
until the new one is complete.  The path ``-`` is standard input or output.  A pipe or device may never end, so it is
read up to a limit that depends on the expected contents.
"""

import os
import re
import secrets
import stat
import sys
import tempfile
from codecs import BOM_UTF8
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import Any, BinaryIO, TextIO

from emulator.errors import FileError, quoted

# The largest numbers of bytes that are read from a pipe or a device: the first for programs, plans and other text, the
# second for points and decks, the third for volumes.
TEXT_LIMIT, POINTS_LIMIT, VOLUME_LIMIT = 16 << 20, 256 << 20, 1 << 30
_CHUNK = 1 << 20
_MANY_DIGITS = 4000


def source_name(path: str) -> str:
    """Return the name that messages use for the input at ``path``."""
    return "standard input" if path == "-" else path


def read_bytes(path: str, name: str = "", limit: int = TEXT_LIMIT) -> bytes:
    """Return the contents of a file, or of a pipe or device that delivers at most ``limit`` bytes.

    ``name`` replaces the path in messages.  Raise FileError if the file cannot be read, or if
    a pipe or device delivers more bytes.
    """
    if path == "-" and (sys.stdin is None or sys.stdin.closed):
        raise FileError("standard input is closed")
    if not path:
        raise FileError("a file without a name cannot be read")
    try:
        with nullcontext(sys.stdin.buffer) if path == "-" else open(path, "rb") as file:
            if _is_regular(file):
                return file.read()
            data = bytearray()
            while chunk := file.read(_CHUNK):
                data += chunk
                if len(data) > limit:
                    most = f"at most {limit >> 20} MiB can be read from a pipe or device"
                    raise FileError(f"{name or source_name(path)}: {most}; write the data to a file")
            return bytes(data)
    except OSError as error:
        raise FileError(f"{name or source_name(path)}: {reason(error)}") from None
    except ValueError:
        raise FileError(f"{name or quoted(path)}: not a valid file name") from None


def _is_regular(file: BinaryIO) -> bool:
    try:
        return stat.S_ISREG(os.fstat(file.fileno()).st_mode)
    except (OSError, ValueError):
        return False


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


def parse_toml(text: str, parse_float: Callable[[str], Any] = float) -> dict[str, Any]:
    """Return the data of a TOML text.

    Raise ValueError with a one-line message, which usually ends with the position.
    """
    import tomllib  # not at the top, because few commands read TOML

    try:
        return tomllib.loads(text, parse_float=parse_float)
    except RecursionError:
        raise ValueError("the text is nested too deeply") from None
    except tomllib.TOMLDecodeError as error:
        raise ValueError(str(error).splitlines()[0]) from None
    except ValueError as error:
        # Python's int() and ``parse_float`` reject numbers with thousands of digits.
        number = max(re.finditer(r"[0-9_]+", text), key=lambda match: len(match[0]))
        if len(number[0]) < _MANY_DIGITS:
            raise ValueError(str(error)) from None
        line, column = text.count("\n", 0, number.start()) + 1, number.start() - text.rfind("\n", 0, number.start())
        raise ValueError(f"a number has too many digits, {len(number[0])} (at line {line}, column {column})") from None


def reason(error: OSError) -> str:
    """Return the operating system's explanation of an error, for use in a message."""
    return (error.strerror or str(error)).lower()


def write_text(path: str, text: str) -> None:
    """Write an ASCII file atomically.  Raise FileError if it cannot be written."""
    with writing(path) as file:
        file.write(text)


def check_writable(*paths: str | None) -> None:
    """Raise FileError if an output cannot be written or two outputs are the same file.  Call this before a long run."""
    named = [path for path in paths if path is not None and path != "-"]
    real = [os.path.realpath(path) for path in named if path and (os.path.isfile(path) or not os.path.exists(path))]
    for path in named:
        if not path:
            raise FileError("a file without a name cannot be written")
        if os.path.isdir(path):
            raise FileError(f"{path}: is a directory")
        if os.path.exists(path) and not os.access(path, os.W_OK):
            raise FileError(f"{path}: permission denied")
        if os.path.realpath(path) in real:
            try:
                # A result is first written to a temporary file in the same folder, so the folder must be writable too.
                tempfile.TemporaryFile(dir=os.path.dirname(os.path.realpath(path))).close()
            except OSError as error:
                raise FileError(f"{path}: {reason(error)}") from None
    if len(set(real)) < len(real):
        same = next(path for path in named if real.count(os.path.realpath(path)) > 1)
        raise FileError(f"{same}: two outputs have this file name; choose another name for one of them")


def check_folder(path: str | None) -> None:
    """Raise FileError if files cannot be written to a folder, existing or new.  Call this before a long run."""
    if not path:
        return
    folder = os.path.realpath(path)
    while not os.path.lexists(folder):
        folder = os.path.dirname(folder)
    try:
        tempfile.TemporaryFile(dir=folder).close()
    except OSError as error:
        raise FileError(f"{path}: {reason(error)}") from None


# The prefix of the names of files that are still being written.
UNFINISHED = ".unfinished-"


@contextmanager
def writing(path: str) -> Iterator[TextIO]:
    """Open an ASCII file for writing and replace the old file when the block ends without an error.

    The text goes to a temporary file in the same folder, and this file is renamed at the end.  A symbolic link is
    followed and the mode of an existing file is kept.  A device or pipe is written directly.  Raise FileError if
    writing fails.
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
    """Implement :func:`writing` and :func:`writing_bytes`.  ``standard`` is standard output as the matching stream."""
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
        temporary = str(target.with_name(UNFINISHED + secrets.token_hex(8)))
        with open(temporary, **open_arguments) as file:  # type: ignore[call-overload]
            yield file
            if durable:
                file.flush()
                os.fsync(file.fileno())
        if target.exists():
            os.chmod(temporary, target.stat().st_mode & 0o777)
        os.replace(temporary, target)
        temporary = ""
    except OSError as error:
        raise FileError(f"{path}: {reason(error)}") from None
    finally:
        if temporary and os.path.exists(temporary):
            os.unlink(temporary)
