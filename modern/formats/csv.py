"""CSV: rows of fields, and points of three decimal numbers a row."""

from __future__ import annotations

import csv
from collections.abc import Iterator

from emulator.errors import FileError
from modern.geometry.numbers import Point, number, shown


def rows(text: str, source: str) -> Iterator[tuple[int, list[str]]]:
    """The rows of CSV text with line numbers.

    Blank lines are passed over, and so is a first line without any digit (a heading).  Raises FileError.
    """
    reader = csv.reader(text.splitlines())
    first = True
    try:
        for row in reader:
            if not any(field.strip() for field in row):
                continue
            heading = first and not any(any(c.isdigit() for c in field) for field in row)
            first = False
            if not heading:
                yield reader.line_num, row
    except csv.Error as error:
        raise FileError(f"{source}: line {reader.line_num}, column 1: {error}") from None


def points(text: str, source: str) -> tuple[tuple[Point, ...], tuple[int, ...]]:
    """The points of CSV text, x,y,z a row, and the line of each.  Raises FileError, naming line and field."""
    found: list[Point] = []
    lines: list[int] = []
    for line, row in rows(text, source):
        if len(row) != 3:
            raise FileError(f"{source}: line {line}, column 1: {len(row)} fields; a point has three, x,y,z")
        for field, word in enumerate(row, 1):
            try:
                if "/" in word:
                    raise ValueError(f"{shown(word.strip())} is not a decimal number")
                number(word)
            except ValueError as error:
                raise FileError(f"{source}: line {line}, field {field}: {error}") from None
        x, y, z = (word.strip() for word in row)
        found.append((x, y, z))
        lines.append(line)
    return tuple(found), tuple(lines)
