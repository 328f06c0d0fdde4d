"""Measures of solids and hulls in words: lines for one, a table for many labels, and the same as CSV.

Lines and table show fractions to twelve digits; CSV has fifty, and the exact fractions beside.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from decimal import MAX_EMAX, MIN_EMIN, Context, Decimal
from fractions import Fraction

from modern.cli.shared.volumes import printable
from modern.digital.hull import DigitalHull
from modern.digital.measures import Measures
from modern.formats.columns import aligned
from modern.geometry.numbers import AREA_DIGITS, finite_decimal

SHOWN = 12
"""Digits of a number in lines and tables."""


@dataclass(frozen=True, slots=True)
class Column:
    """A column: its heading, its number, and whether CSV has the fraction beside."""

    name: str
    number: int | Fraction | Decimal
    exact: bool = False


Row = tuple[Column, ...]


def centres_row(label: int, found: Measures) -> Row:
    """A label's solid and the hull of its voxels' centres, which cuts the voxels at its rim."""
    return (
        Column("label", label),
        Column("voxels", found.voxels),
        Column("volume", found.volume),
        Column("hull_volume", found.hull_volume, True),
        Column("hull_area", found.hull_area),
    )


def solid_row(label: int, found: Measures) -> Row:
    """A label's solid and the hull of its voxels' corners, which contains it."""
    share, lack = Column("solidity", found.solidity, True), Column("deficiency", found.deficiency, True)
    return (*centres_row(label, found), share, lack)


def filled_row(label: int, found: DigitalHull, cell: Fraction) -> Row:
    """A label's voxels and those of its filled hull, each with its volume."""
    return (
        Column("label", label),
        Column("voxels", found.given),
        Column("hull_voxels", found.voxels),
        Column("solidity", found.solidity, True),
        Column("deficiency", found.deficiency),
        Column("volume", found.given * cell),
        Column("hull_volume", found.voxels * cell),
        Column("deficiency_volume", found.deficiency * cell),
    )


def measure_lines(found: Measures, unit: str, corners: bool) -> Iterator[str]:
    """The measures of one solid and its hull, of corners or of centres."""
    cube, square = (f" {printable(unit)}^{power}" if unit else "" for power in (3, 2))
    yield f"volume of the voxels: {_exact(found.volume)}{cube}"
    yield f"hull: volume {_exact(found.hull_volume)}{cube}"
    yield f"hull: area {_plain(found.hull_area)}{square}{_digits(found.hull_area)}"
    if corners:
        yield f"solidity {_exact(found.solidity)}; convex deficiency {_exact(found.deficiency)}{cube}"


def table(rows: Sequence[Row], unit: str) -> Iterator[str]:
    """The rows under their headings, in columns; numbers to twelve digits."""
    cells = [[column.name.replace("_", " ") for column in rows[0]]]
    cells += [[_shown(column.number) for column in row] for row in rows]
    yield from aligned(cells, right=True)
    plural = "s" if unit == "voxel" else ""
    lengths = f"lengths in {printable(unit)}{plural}" if unit else "unit of lengths not stated"
    yield f"{lengths}; numbers to {SHOWN} digits, with --csv to {AREA_DIGITS} and exact"


def csv_text(rows: Iterable[Row], unit: str) -> str:
    """The rows as CSV: decimals to fifty digits, then the fractions ``p/q`` that they stand for, then the unit."""
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    for place, row in enumerate(rows):
        exact = [column for column in row if column.exact]
        if not place:
            writer.writerow([c.name for c in row] + [f"{c.name}_exact" for c in exact] + ["unit"])
        writer.writerow([_fifty(c.number) for c in row] + [str(c.number) for c in exact] + [printable(unit)])
    return file.getvalue()


def _context(digits: int) -> Context:
    return Context(prec=digits, Emin=MIN_EMIN, Emax=MAX_EMAX)


def _decimal(number: int | Fraction | Decimal, digits: int) -> Decimal:
    work = _context(digits)
    if isinstance(number, Decimal):
        return work.plus(number)
    return work.divide(Decimal(number.numerator), Decimal(number.denominator))


def _fifty(number: int | Fraction | Decimal) -> str:
    return str(number) if isinstance(number, int) else _plain(_decimal(number, AREA_DIGITS))


def _shown(number: int | Fraction | Decimal) -> str:
    return str(number) if isinstance(number, int) else _plain(_decimal(number, SHOWN))


def _exact(number: Fraction) -> str:
    """The number as a decimal, or as a fraction and about what decimal."""
    text = finite_decimal(number)
    if text is not None and len(text) <= 2 * SHOWN:
        return text
    return f"{number}, about {_shown(number)}" if len(str(number)) <= 4 * SHOWN else f"about {_shown(number)}"


def _plain(number: Decimal) -> str:
    """Without the zeros at the end, with an exponent only where it is far from 0."""
    text = finite_decimal(Fraction(number))
    assert text is not None
    return text


def _digits(number: Decimal) -> str:
    """How many digits a root has; one that came out even says nothing."""
    return f", to {AREA_DIGITS} digits" if len(number.as_tuple().digits) >= AREA_DIGITS else ""
