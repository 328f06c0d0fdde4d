"""Read lists of points: rows of three decimal numbers, separated by commas, semicolons, tabs or blanks."""

import csv
import re
from collections.abc import Iterator, Sequence

from emulator.errors import FileError, quoted
from modern.geometry.numbers import Point, number

_NAME = re.compile(r"[^\W\d_].*", re.DOTALL)
_SHORT, _SIMPLE = 100, re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,3})?")
_NOT_FINITE = ("nan", "inf", "infinity")


def rows(text: str, source: str) -> Iterator[tuple[int, list[str]]]:
    """Yield, for each row of a text, its line number and its fields without the blanks around them.

    The separator is the first of semicolon, comma and tab that the first row contains, or else blanks.  Blank lines and
    lines that begin with ``#`` are skipped.  A first row is also skipped if it is a heading: none of its fields has a
    digit, or all of them are names such as ``x1``.  Raise FileError if the csv module cannot read a row.
    """
    lines = text.splitlines()
    first = next((line for line in lines if line.strip() and not line.lstrip().startswith("#")), "")
    separator = next((mark for mark in ";,\t" if mark in first), "")
    reader = csv.reader((_normalised(line, separator) for line in lines), delimiter=separator or " ")
    heading_possible = True
    try:
        for row in reader:
            fields = [field.strip() for field in row]
            if any(fields):
                if not (heading_possible and _is_heading(fields)):
                    yield reader.line_num, fields
                heading_possible = False
    except csv.Error as error:
        raise FileError(f"{source}: line {reader.line_num}, column 1: {error}") from None


def _normalised(line: str, separator: str) -> str:
    """Return a line as the csv module needs it: "" for a comment, and single blanks if blanks separate the fields."""
    if line.lstrip().startswith("#"):
        return ""
    return line if separator else " ".join(line.split())


def _is_heading(fields: Sequence[str]) -> bool:
    if any(field.lower().lstrip("+-") in _NOT_FINITE for field in fields):
        return False
    has_digit = any(c.isdigit() for field in fields for c in field)
    return not has_digit or all(_NAME.fullmatch(field) for field in fields)


def begins_with_point(text: str) -> bool:
    """Return True if the first row of a list, after any heading, has three decimal numbers."""
    try:
        line, row = next(rows(text, ""))
        _point(row, "", line)
    except (FileError, StopIteration):
        return False
    return True


def points(text: str, source: str) -> tuple[tuple[Point, ...], tuple[int, ...]]:
    """Return the points of a list and the line of each point.  Raise FileError unless each row has three decimals."""
    numbered = [(_point(row, source, line), line) for line, row in rows(text, source)]
    if not numbered and (heading := next((line.strip() for line in text.splitlines() if line.strip()), "")):
        raise FileError(f"{source}: expected points x,y,z, found only the heading {quoted(heading)}")
    return tuple(point for point, _ in numbered), tuple(line for _, line in numbered)


def _point(row: Sequence[str], source: str, line: int) -> Point:
    if len(row) != 3:
        raise FileError(f"{source}: line {line}, column 1: expected a point x,y,z, found {len(row)} fields")
    for column, field in enumerate(row, 1):
        if len(field) < _SHORT and _SIMPLE.fullmatch(field):
            continue  # a valid decimal, whose value is not needed here
        try:
            if "/" in field:
                raise ValueError(f"{quoted(field)} is not a decimal number")
            number(field)
        except ValueError as error:
            raise FileError(f"{source}: line {line}, field {column}: {error}") from None
    x, y, z = row
    return x, y, z
