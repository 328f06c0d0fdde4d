"""Readings that someone has confirmed or corrected on the printed page, stored in ``fortran_src/readings.csv``.

The published edition has no such file, because nobody who worked on it has seen the pages.
:mod:`modern.edition.page_readings` writes the file from filled proof sheets, which are CSV tables with the columns
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
# The items of the two rows of a sheet in which the person who reads the page enters a name and the date.
READER, DATE = "reader", "date"


@dataclass(frozen=True, slots=True)
class Reading:
    """The answer to one item or question, by someone who read the printed page.

    ``outcome`` is ``confirmed``, ``changed``, ``answered`` (for an open question) or ``unreadable``.  ``card`` is the
    card as the page has it, and ``row`` is the id of the row that was added to the apparatus because of this card.
    ``rows`` has the ids of the rows that the answer makes certain, separated by blanks.
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
    """Return the answers that this edition includes.  The published edition has none."""
    file = files("fortran_src").joinpath(READINGS)
    return stored_readings(file.read_text(encoding="utf-8")) if file.is_file() else ()


def stored_readings(text: str) -> tuple[Reading, ...]:
    """Return the answers in the text of a file ``readings.csv``."""
    return tuple(Reading(**row) for row in csv.DictReader(StringIO(text, newline="")))


def blank_table(rows: Sequence[Mapping[str, str]]) -> str:
    """Return a proof sheet without answers as a CSV table: two rows for the reader and the date, then ``rows``."""
    table = StringIO(newline="")
    writer = csv.DictWriter(table, COLUMNS, restval="", lineterminator="\r\n")
    writer.writeheader()
    writer.writerows(
        [{"item": READER, "question": "your name"}, {"item": DATE, "question": "today, as 2027-03-31"}, *rows]
    )
    return table.getvalue()
