"""The SQLite index of a study, from which reports are computed.  Each run of the study builds the index again.

The table ``samples`` has the columns cell, place (the index of the sample), n, dimension, vertices, planes, boundary,
inside and tags (JSON).  The table ``runs`` has the columns cell, place, route, outcome, detail and figures (JSON).  The
database connection of a run locks the file, so a second run in the same folder fails.
"""

import json
import sqlite3
from collections.abc import Iterable
from pathlib import Path
from typing import Any, NotRequired, TypedDict

from emulator.files import reason
from modern.study.plan import StudyFileError

NAME = "index.sqlite"
_SCHEMA = """
CREATE TABLE IF NOT EXISTS samples (
    cell INTEGER, place INTEGER, n INTEGER, dimension INTEGER, vertices INTEGER, planes INTEGER,
    boundary INTEGER, inside INTEGER, tags TEXT, PRIMARY KEY (cell, place)
) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS runs (
    cell INTEGER, place INTEGER, route TEXT, outcome TEXT, detail TEXT, figures TEXT,
    PRIMARY KEY (cell, place, route)
) WITHOUT ROWID;
"""
# The columns that describe the size of a sample and of its exact hull.
JUDGE = ("n", "dimension", "vertices", "planes", "boundary", "inside")


class Row(TypedDict):
    """A line of a file of rows: a sample, the figures of its exact hull, and the results of the routes.

    runs: the outcome, the detail and the figures of each route, by the name of the route.
    """

    cell: int
    index: int
    seed: str
    tags: NotRequired[dict[str, int | str]]
    deck: list[str]
    judge: dict[str, int]
    runs: dict[str, dict[str, Any]]
    checksum: NotRequired[str]


def open_index(folder: Path) -> sqlite3.Connection:
    """Open and lock the index of a folder.  Replace a damaged index.  Raise StudyFileError if the index is locked."""
    path = folder / NAME
    try:
        try:
            return _opened(path)
        except sqlite3.DatabaseError as error:
            if isinstance(error, sqlite3.OperationalError):
                raise
            for damaged in folder.glob(f"{NAME}*"):
                damaged.unlink()
            return _opened(path)
    except sqlite3.Error as error:
        busy = error.sqlite_errorcode in (sqlite3.SQLITE_BUSY, sqlite3.SQLITE_LOCKED)
        why = "another run is using this folder; wait until it ends" if busy else str(error)
        raise StudyFileError(f"{path}: {why}") from None
    except OSError as error:
        raise StudyFileError(f"{path}: {reason(error)}") from None


def _opened(path: Path) -> sqlite3.Connection:
    connection = sqlite3.connect(path, timeout=0.5, isolation_level=None)
    try:
        connection.execute("PRAGMA locking_mode = EXCLUSIVE")
        # An interruption may leave a damaged index.  This does no harm, because the next run builds the index again.
        connection.execute("PRAGMA synchronous = OFF")
        connection.execute("PRAGMA journal_mode = MEMORY")
        connection.execute("BEGIN EXCLUSIVE")
        for statement in _SCHEMA.split(";"):
            connection.execute(statement)
        connection.execute("COMMIT")
        if connection.execute("PRAGMA quick_check").fetchone()[0] != "ok":
            raise sqlite3.DatabaseError("damaged")
    except (sqlite3.Error, OSError):
        connection.close()
        raise
    return connection


def clear(index: sqlite3.Connection) -> None:
    """Delete all rows of the index."""
    index.executescript("BEGIN; DELETE FROM samples; DELETE FROM runs; COMMIT")


def enter(index: sqlite3.Connection, rows: Iterable[Row]) -> None:
    """Insert the rows of a chunk in one transaction.  Raise StudyFileError if that fails."""
    samples, runs = [], []
    for row in rows:
        key = (row["cell"], row["index"])
        tags = json.dumps(row.get("tags", {}), sort_keys=True)
        samples.append((*key, *(row["judge"][column] for column in JUDGE), tags))
        runs += [
            (*key, route, run["outcome"], run["detail"], json.dumps(run["figures"], sort_keys=True))
            for route, run in row["runs"].items()
        ]
    try:
        index.execute("BEGIN")
        try:
            index.executemany(f"INSERT INTO samples VALUES ({', '.join('?' * 9)})", samples)
            index.executemany(f"INSERT INTO runs VALUES ({', '.join('?' * 6)})", runs)
            index.execute("COMMIT")
        except BaseException:
            if index.in_transaction:
                index.execute("ROLLBACK")
            raise
    except sqlite3.Error as error:
        raise StudyFileError(f"{NAME}: {error}") from None
