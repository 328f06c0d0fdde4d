"""Points from a CSV file to a data deck for program 1, exactly or not at all.

A coordinate is a decimal number; E14.8 holds eight significant digits and an exponent of -99 to 99.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from emulator.errors import DeckError
from emulator.files import read_text, source_name

MAX_N = 99
_NUMBER = re.compile(r"([+-]?)(\d*)(?:\.(\d*))?(?:[eE]([+-]?\d{1,6}))?", re.ASCII)


class PointError(DeckError):
    """A point that cannot be put on a card; the message names file, line and column."""


@dataclass(frozen=True, slots=True)
class Decimal:
    """An exact decimal: sign, digits without leading zeros, and a power of ten: .digits times ten to the exponent."""

    negative: bool
    digits: str
    exponent: int


def parse_decimal(text: str) -> Decimal:
    """Read ``12``, ``-1.5``, ``.25e-3``.  Raises ValueError."""
    match = _NUMBER.fullmatch(text.strip())
    if not match or not (match[2] or match[3]):
        raise ValueError(f"{text.strip()!r} is no decimal number")
    whole, fraction = match[2], match[3] or ""
    digits = (whole + fraction).lstrip("0")
    exponent = len(digits) - len(fraction) + int(match[4] or 0)
    return Decimal(match[1] == "-", digits.rstrip("0"), exponent if digits else 0)


def e_field(number: Decimal, truncate: bool) -> str:
    """The 14 columns of E14.8 as the thesis's data sheet punches them: ``+.20000000E+01``.

    Raises ValueError for a ninth significant digit (unless ``truncate``) or an exponent out of range.
    """
    if len(number.digits) > 8 and not truncate:
        raise ValueError(f"{len(number.digits)} significant digits; a card holds 8 (--truncate cuts them)")
    if number.digits and not -99 <= number.exponent <= 99:
        raise ValueError("out of range: the exponent of a card is -99 to 99")
    sign = "-" if number.negative else "+"
    return f"{sign}.{number.digits[:8].ljust(8, '0')}E{'-' if number.exponent < 0 else '+'}{abs(number.exponent):02d}"


def deck_lines(rows: Iterable[tuple[int, list[str]]], source: str, truncate: bool = False) -> tuple[str, ...]:
    """The cards of a deck from numbered rows of three fields.  Raises PointError."""
    points = []
    for line, row in rows:
        if len(row) != 3:
            raise PointError(f"{source}: line {line}, column 1: {len(row)} fields; a point has three, x,y,z")
        fields = []
        for k, text in enumerate(row):
            try:
                fields.append(e_field(parse_decimal(text), truncate))
            except ValueError as error:
                raise PointError(f"{source}: line {line}, field {k + 1}: {error}") from None
        points.append("".join(fields))
    if not points:
        raise PointError(f"{source}: there are no points")
    if len(points) > MAX_N:
        raise PointError(f"{source}: {len(points)} points; N has two columns, so a deck holds at most {MAX_N}")
    return (f"{len(points):2d}", *points)


def read_rows(path: str) -> Iterator[tuple[int, list[str]]]:
    """The rows of a CSV file (``-``: standard input), as :func:`rows` gives them.  Raises FileError."""
    yield from rows(read_text(path), source_name(path))


def rows(text: str, source: str) -> Iterator[tuple[int, list[str]]]:
    """The rows of CSV text with line numbers.

    Blank lines are passed over, and so is a first line without any digit (a heading).  Raises PointError.
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
        raise PointError(f"{source}: line {reader.line_num}, column 1: {error}") from None
