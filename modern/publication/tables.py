"""Convert tables of reports to tables of the deposit, in which each cell is one number or one text.

The reports print a mean with its interval in one cell, such as ``0.93 (0.88 to 0.98) %``.  The deposit has a column for
the mean and a column for each bound of the interval.  The descriptions of the columns are in ``columns.toml``.
"""

import csv
import re
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from functools import cache
from io import StringIO
from pathlib import Path

# The beginning of the description of a column without an entry in columns.toml.
UNDESCRIBED = "see the report in"
# The cells that stand for a missing value.
MISSING = ("", "-", "none")
_NUMBER = r"-?\d+(?:\.\d+)?"
_INTERVAL = re.compile(rf"({_NUMBER})(?: \(({_NUMBER}) to ({_NUMBER})\))?( %)?")
_RANGE = re.compile(rf"(10\^)?({_NUMBER})(?: to (?:10\^)?({_NUMBER}))?")


@dataclass(frozen=True, slots=True)
class Column:
    """A column of a table.  ``kind`` is its Frictionless type, such as ``integer``."""

    name: str
    kind: str
    description: str
    cells: tuple[str, ...]


def columns(path: str, text: str) -> tuple[Column, ...]:
    """Return the columns of a CSV table with the given path and text.  Raise ValueError if two have the same name."""
    head, *rows = list(csv.reader(StringIO(text)))
    if duplicates := [name for name in head if head.count(name) > 1]:
        raise ValueError(f"{path}: two columns are called {duplicates[0]}")
    return tuple(part for k, name in enumerate(head) for part in _parts(path, name, [row[k] for row in rows]))


def csv_text(table: Sequence[Column]) -> str:
    """Return columns as the text of a CSV file."""
    file = StringIO(newline="")
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow([column.name for column in table])
    writer.writerows(zip(*(column.cells for column in table), strict=True))
    return file.getvalue()


def _parts(path: str, name: str, cells: Sequence[str]) -> list[Column]:
    """Split one column of a report: the bounds of intervals and the ends of ranges become separate columns."""
    about = description(path, name)
    values = [cell for cell in cells if cell not in MISSING]
    if values and all(map(_INTERVAL.fullmatch, values)):
        percent = any(cell.endswith(" %") for cell in values)
        parts = [_groups(_INTERVAL, cell) for cell in cells]
        about += ", in percent" if percent else ""
        has_bounds = any(low for _, low, *_ in parts)
        if not has_bounds and not percent:
            return [Column(name, _kind(values), about, tuple(cells))]
        interval = "interval" if "systematic error" in about else "95 % interval"
        ends = [("", ""), (", low", f"lower bound of the {interval}: "), (", high", f"upper bound of the {interval}: ")]
        return [
            Column(name + end, "number", bound + about, tuple(part[k] for part in parts))
            for k, (end, bound) in enumerate(ends if has_bounds else ends[:1])
        ]
    if values and all(map(_RANGE.fullmatch, values)):
        ranges = (_groups(_RANGE, cell) for cell in cells)
        limits = [(power and "1e", low, high or low) for power, low, high in ranges]
        if all(low == high for _, low, high in limits):
            return [Column(name, "number", about, tuple(power + low for power, low, _ in limits))]
        return [
            Column(f"{name}, from", "number", f"smallest: {about}", tuple(power + low for power, low, _ in limits)),
            Column(f"{name}, to", "number", f"largest: {about}", tuple(power + high for power, _, high in limits)),
        ]
    return [Column(name, "string", about, tuple(cells))]


def _groups(pattern: re.Pattern[str], cell: str) -> list[str]:
    match = pattern.fullmatch(cell)
    return [group or "" for group in match.groups()] if match else [""] * pattern.groups


def _kind(cells: Sequence[str]) -> str:
    return "integer" if all(re.fullmatch(r"-?\d+", cell) for cell in cells) else "number"


@cache
def _descriptions() -> dict[str, str]:
    text = Path(__file__).with_name("columns.toml").read_text(encoding="utf-8")
    table: dict[str, str] = tomllib.loads(text)["columns"]
    return table


def description(path: str, name: str) -> str:
    """Return the description of a column from columns.toml or, without an entry in it, a reference to the report."""
    for pattern, text in _descriptions().items():
        if fnmatchcase(name, pattern):
            literal = len(pattern) - 1
            return text.replace("*", name[literal:]) if pattern.endswith("*") and "?" not in pattern else text
    return f"{UNDESCRIBED} {path.rpartition('/')[0]}"
