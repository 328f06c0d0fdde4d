"""Format the measures of solids and hulls: as lines for one solid, and as a table or CSV for many labels.

Lines and tables show numbers to twelve digits.  CSV shows fifty digits, and has further columns with the exact
fractions.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from decimal import MAX_EMAX, MIN_EMIN, Context, Decimal
from fractions import Fraction

from modern.cli.shared.volumes import printable
from modern.digital.hull import DigitalHull
from modern.digital.measures import Measures
from modern.formats import columns
from modern.geometry.numbers import AREA_DIGITS, finite_decimal

# The number of digits to which lines and tables show a number.
TABLE_DIGITS = 12


@dataclass(frozen=True, slots=True)
class Cell:
    """A number of a row with the name of its column.

    with_fraction: True if a further column of the CSV table has the exact fraction.
    """

    name: str
    number: int | Fraction | Decimal
    with_fraction: bool = False


Row = tuple[Cell, ...]


def centres_row(label: int, measures: Measures) -> Row:
    """Return a label's row with the hull of its voxels' centres, a hull that excludes parts of the outer voxels."""
    return (
        Cell("label", label),
        Cell("voxels", measures.voxels),
        Cell("volume", measures.volume),
        Cell("hull_volume", measures.hull_volume, True),
        Cell("hull_area", measures.hull_area),
    )


def solid_row(label: int, measures: Measures) -> Row:
    """Return a label's row with the hull of its voxels' corners, a hull that contains the whole solid."""
    solidity = Cell("solidity", measures.solidity, True)
    return (*centres_row(label, measures), solidity, Cell("deficiency", measures.deficiency, True))


def filled_row(label: int, hull: DigitalHull, voxel_volume: Fraction) -> Row:
    """Return a label's row with a hull that was filled with voxels."""
    return (
        Cell("label", label),
        Cell("voxels", hull.given),
        Cell("hull_voxels", hull.voxels),
        Cell("solidity", hull.solidity, True),
        Cell("deficiency", hull.deficiency),
        Cell("volume", hull.given * voxel_volume),
        Cell("hull_volume", hull.voxels * voxel_volume),
        Cell("deficiency_volume", hull.deficiency * voxel_volume),
    )


def measure_lines(measures: Measures, unit: str, corners: bool) -> Iterator[str]:
    """Yield lines with the measures of a solid and of the hull of its voxels' corners or centres."""
    cubic, square = (f" {printable(unit)}^{power}" if unit else "" for power in (3, 2))
    precision = f", to {AREA_DIGITS} digits" if len(measures.hull_area.as_tuple().digits) >= AREA_DIGITS else ""
    yield f"volume of the voxels: {_with_exact(measures.volume)}{cubic}"
    yield f"hull: volume {_with_exact(measures.hull_volume)}{cubic}"
    yield f"hull: area {_plain(measures.hull_area)}{square}{precision}"
    if corners:
        yield f"solidity {_with_exact(measures.solidity)}; convex deficiency {_with_exact(measures.deficiency)}{cubic}"


def table(rows: Sequence[Row], unit: str) -> Iterator[str]:
    """Yield the lines of a table of measures with headings, and a line that states the unit of length."""
    lines = [[cell.name.replace("_", " ") for cell in rows[0]]]
    lines += [[_to_digits(cell.number, TABLE_DIGITS) for cell in row] for row in rows]
    yield from columns.aligned(lines, right=True)
    plural = "s" if unit == "voxel" else ""
    lengths = f"lengths in {printable(unit)}{plural}" if unit else "unit of length not stated"
    yield f"{lengths}; numbers to {TABLE_DIGITS} digits (--csv: {AREA_DIGITS} digits and exact fractions)"


def csv_text(rows: Iterable[Row], unit: str) -> str:
    """Return the rows as CSV: decimals of fifty digits, then the exact fractions ``p/q``, then the unit."""
    lines: list[list[str]] = []
    for row in rows:
        exact = [cell for cell in row if cell.with_fraction]
        if not lines:
            lines.append([c.name for c in row] + [f"{c.name}_exact" for c in exact] + ["unit"])
        decimals = [_to_digits(c.number, AREA_DIGITS) for c in row]
        lines.append(decimals + [str(c.number) for c in exact] + [printable(unit)])
    return columns.csv_text(lines)


def _to_digits(number: int | Fraction | Decimal, digits: int) -> str:
    if isinstance(number, int):
        return str(number)
    context = Context(prec=digits, Emin=MIN_EMIN, Emax=MAX_EMAX)
    if isinstance(number, Decimal):
        return _plain(context.plus(number))
    return _plain(context.divide(Decimal(number.numerator), Decimal(number.denominator)))


def _with_exact(number: Fraction) -> str:
    """Return the exact decimal of a number if it is short, otherwise a rounded decimal.

    The exact fraction precedes the rounded decimal if the fraction is short.
    """
    text = finite_decimal(number)
    if text is not None and len(text) <= 2 * TABLE_DIGITS:
        return text
    about = f"about {_to_digits(number, TABLE_DIGITS)}"
    return f"{number}, {about}" if len(str(number)) <= 4 * TABLE_DIGITS else about


def _plain(number: Decimal) -> str:
    text = finite_decimal(Fraction(number))
    assert text is not None
    return text
