"""The sqlite index of a study: what tables are computed from, made from the rows, again where it is in doubt.

Two tables.  ``samples``: cell, place (the sample's index), n, dimension, vertices, planes, boundary, inside, tags
(JSON).  ``runs``: cell, place, route, outcome, detail, figures (JSON).  ``chunks`` names the files that are in.
One connection writes, and holds the file: a second run in the same folder finds it locked.
"""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterable
from pathlib import Path
from typing import NotRequired, TypedDict

from modern.study.plan import StudyFileError

NAME = "index.sqlite"
_SCHEMA = """
CREATE TABLE IF NOT EXISTS chunks (name TEXT PRIMARY KEY) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS samples (
    cell INTEGER, place INTEGER, n INTEGER, dimension INTEGER, vertices INTEGER, planes INTEGER,
    boundary INTEGER, inside INTEGER, tags TEXT, PRIMARY KEY (cell, place)
) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS runs (
    cell INTEGER, place INTEGER, route TEXT, outcome TEXT, detail TEXT, figures TEXT,
    PRIMARY KEY (cell, place, route)
) WITHOUT ROWID;
"""
JUDGE = ("n", "dimension", "vertices", "planes", "boundary", "inside")
"""What the judge says of a sample's size and of its hull's."""


class RouteRow(TypedDict):
    """One route's answer to a sample, in a row."""

    outcome: str
    detail: str
    figures: dict[str, int | str]


class Row(TypedDict):
    """A line of a file of rows: a sample, what the judge says of it, and each route's answer by its name."""

    cell: int
    index: int
    seed: str
    tags: NotRequired[dict[str, int | str]]
    deck: list[str]
    judge: dict[str, int]
    runs: dict[str, RouteRow]


def open_index(folder: Path) -> sqlite3.Connection:
    """The folder's index, locked for this run; made anew where the file there is not one.

    Raises StudyFileError where another run holds it, or it cannot be written.
    """
    path = folder / NAME
    try:
        try:
            return _opened(path)
        except sqlite3.DatabaseError as error:
            if isinstance(error, sqlite3.OperationalError):
                raise
            for old in folder.glob(f"{NAME}*"):
                old.unlink()
            return _opened(path)
    except sqlite3.Error as error:
        busy = error.sqlite_errorcode in (sqlite3.SQLITE_BUSY, sqlite3.SQLITE_LOCKED)
        words = "another run is at work in this folder" if busy else str(error)
        raise StudyFileError(f"{path}: {words}") from None
    except OSError as error:
        raise StudyFileError(f"{path}: {(error.strerror or str(error)).lower()}") from None


def _opened(path: Path) -> sqlite3.Connection:
    connection = sqlite3.connect(path, timeout=0.5, isolation_level=None)
    try:
        connection.execute("PRAGMA locking_mode = EXCLUSIVE")
        # What a crash of the machine may lose is in the rows' files; a crash of the program loses nothing.
        connection.execute("PRAGMA synchronous = OFF")
        connection.execute("BEGIN EXCLUSIVE")
        for statement in _SCHEMA.split(";"):
            connection.execute(statement)
        connection.execute("COMMIT")
        if connection.execute("PRAGMA quick_check").fetchone()[0] != "ok":
            raise sqlite3.DatabaseError("damaged")
    except sqlite3.Error:
        connection.close()
        raise
    return connection


def known_chunks(index: sqlite3.Connection) -> set[str]:
    """The names of the chunks whose rows are in."""
    return {name for (name,) in index.execute("SELECT name FROM chunks")}


def clear(index: sqlite3.Connection) -> None:
    """Take out every row."""
    index.execute("BEGIN")
    for table in ("chunks", "samples", "runs"):
        index.execute(f"DELETE FROM {table}")
    index.execute("COMMIT")


def enter(index: sqlite3.Connection, name: str, rows: Iterable[Row]) -> None:
    """Put a chunk's rows in, all or none.  Raises StudyFileError."""
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
            index.execute("INSERT INTO chunks VALUES (?)", (name,))
            index.executemany(f"INSERT INTO samples VALUES ({', '.join('?' * 9)})", samples)
            index.executemany(f"INSERT INTO runs VALUES ({', '.join('?' * 6)})", runs)
            index.execute("COMMIT")
        except BaseException:
            if index.in_transaction:
                index.execute("ROLLBACK")
            raise
    except sqlite3.Error as error:
        raise StudyFileError(f"{NAME}: {error}") from None
