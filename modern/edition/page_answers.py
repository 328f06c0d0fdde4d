"""Readings that someone has confirmed or corrected on the printed page, stored in ``fortran_src/readings.csv``.

The edition as published has no such file, because nobody who worked on it has seen the pages.
:mod:`modern.edition.page_readings` writes the file from filled proof sheets, which are tables with the columns
``COLUMNS``.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from io import StringIO

READINGS = "readings.csv"
COLUMNS = ("item", "page", "card", "question", "choices", "answer")
# The rows of a filled sheet that name the reader of the page and the day.
READER, DATE = "reader", "date"


@dataclass(frozen=True, slots=True)
class Reading:
    """One answer of a reader of the printed page.

    ``outcome`` is ``confirmed``, ``changed``, ``answered`` (an open question) or ``unreadable``.  ``card`` is the card
    as the page has it, and ``row`` the row of the apparatus that was added for it.  ``rows`` are the rows that the
    answer makes certain.
    """

    item: str
    page: str
    program: str
    outcome: str
    answer: str
    card: str
    row: str
    rows: str
    reader: str
    date: str


@cache
def page_readings() -> tuple[Reading, ...]:
    """Return the answers of readers of the page that this edition includes; the published edition has none."""
    file = files("fortran_src").joinpath(READINGS)
    return stored_readings(file.read_text(encoding="utf-8")) if file.is_file() else ()


def stored_readings(text: str) -> tuple[Reading, ...]:
    """Return the answers that the text of a ``readings.csv`` holds."""
    return tuple(Reading(**row) for row in csv.DictReader(StringIO(text, newline="")))


def blank_table(rows: Sequence[Mapping[str, str]]) -> str:
    """Return an empty proof sheet as a CSV table: rows for the reader and the date, then the rows of its items."""
    table = StringIO(newline="")
    writer = csv.DictWriter(table, COLUMNS, restval="", lineterminator="\r\n")
    writer.writeheader()
    writer.writerows(
        [{"item": READER, "question": "your name"}, {"item": DATE, "question": "today, as 2027-03-31"}, *rows]
    )
    return table.getvalue()
