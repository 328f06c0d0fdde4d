"""Rows of fields, separated by commas, semicolons, tabs or blanks, and points of three decimal numbers a row."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator, Sequence

from emulator.errors import FileError
from modern.geometry.numbers import Point, number, quoted

_NAME = re.compile(r"[^\W\d_].*", re.DOTALL)
_NO_NUMBER = ("nan", "inf", "infinity")


def rows(text: str, source: str) -> Iterator[tuple[int, list[str]]]:
    """The rows of a text with line numbers, fields stripped of blanks.

    What separates fields is found in the first row: a semicolon, else a comma, else a tab, else blanks.  Blank lines
    and lines that begin with ``#`` are passed over, and so is a first row that is a heading: no field of it holds a
    digit, or every field is a name, as in ``x1,y1,z1``.  Raises FileError.
    """
    lines = text.splitlines()
    first = next((line for line in lines if line.strip() and not line.lstrip().startswith("#")), "")
    mark = next((mark for mark in ";,\t" if mark in first), "")
    reader = csv.reader((_kept(line, mark) for line in lines), delimiter=mark or " ")
    heading = True
    try:
        for row in reader:
            fields = [field.strip() for field in row]
            if any(fields):
                if not (heading and _is_heading(fields)):
                    yield reader.line_num, fields
                heading = False
    except csv.Error as error:
        raise FileError(f"{source}: line {reader.line_num}, column 1: {error}") from None


def _kept(line: str, mark: str) -> str:
    """A line for the reader: a comment is left empty, several blanks are one."""
    if line.lstrip().startswith("#"):
        return ""
    return line if mark else " ".join(line.split())


def _is_heading(fields: Sequence[str]) -> bool:
    if any(field.lower().lstrip("+-") in _NO_NUMBER for field in fields):
        return False
    without = not any(c.isdigit() for field in fields for c in field)
    return without or all(_NAME.fullmatch(field) for field in fields)


def points(text: str, source: str) -> tuple[tuple[Point, ...], tuple[int, ...]]:
    """The points of a text, x y z a row, and the line of each.  Raises FileError, naming line and field."""
    found: list[Point] = []
    lines: list[int] = []
    for line, row in rows(text, source):
        if len(row) != 3:
            raise FileError(f"{source}: line {line}, column 1: {len(row)} fields; a point has three, x,y,z")
        for field, word in enumerate(row, 1):
            try:
                if "/" in word:
                    raise ValueError(f"{quoted(word)} is not a decimal number")
                number(word)
            except ValueError as error:
                raise FileError(f"{source}: line {line}, field {field}: {error}") from None
        x, y, z = row
        found.append((x, y, z))
        lines.append(line)
    return tuple(found), tuple(lines)
