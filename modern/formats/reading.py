"""Files to text: one line for whatever is wrong with the file itself."""

from __future__ import annotations

import sys
from pathlib import Path

from modern.formats.off import OffMesh, parse_off
from modern.geometry.numbers import ExportError


def read_source(path: str) -> tuple[str, str]:
    """The name messages use and the text of a file; ``-`` is standard input.

    A mark of byte order is left out.  Raises ExportError.
    """
    name = "standard input" if path == "-" else path
    try:
        data = sys.stdin.buffer.read() if path == "-" else Path(path).read_bytes()
    except OSError as error:
        raise ExportError(f"{path}: {(error.strerror or str(error)).lower()}") from None
    except ValueError:
        raise ExportError(f"{path!r}: not a file name") from None
    try:
        return name, data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        column = error.start - data.rfind(b"\n", 0, error.start)
        raise ExportError(f"{name}: line {line}, column {column}: not a text file in UTF-8") from None


def read_off(path: str) -> OffMesh:
    """The points and faces of an OFF file; see ``parse_off``.  Raises ExportError with file, line and column."""
    name, text = read_source(path)
    return parse_off(text, name)
