"""The folder of a study: its rows, their index, and the queries of reports.

``rows/`` holds one JSONL file for each finished chunk, with one line per sample.  A file is either complete or absent,
so the files that exist show which chunks are finished.  Every line ends with its checksum, which is compared whenever
the line is read.  ``index.sqlite`` is made from the lines.
"""

import hashlib
import json
import sqlite3
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path
from typing import Any

from emulator.errors import FileError
from emulator.files import UNFINISHED, reason, writing_bytes
from modern.study.index import JUDGE, Row, clear, enter, open_index
from modern.study.plan import Chunk, Plan, StudyFileError

ROWS = "rows"
_CHECKSUM_FIELD = b',"checksum":"'


def put(path: Path, data: bytes | str) -> None:
    """Write a complete file, or raise StudyFileError and write no file."""
    try:
        with writing_bytes(str(path), durable=True) as file:
            file.write(data.encode("utf-8") if isinstance(data, str) else data)
    except FileError as error:
        raise StudyFileError(str(error)) from None


@dataclass
class Store:
    """The rows of a study on disk, in the order of cells and samples. Readers hold one row at a time in memory."""

    folder: Path
    plan: Plan
    database: sqlite3.Connection

    @classmethod
    def open(cls, folder: Path, plan: Plan) -> "Store":
        """Open the store in an existing folder and remove the unfinished files of an interrupted run.

        Raise StudyFileError if that fails.
        """
        try:
            (folder / ROWS).mkdir(exist_ok=True)
        except OSError as error:
            raise StudyFileError(f"{folder / ROWS}: {reason(error)}") from None
        store = cls(folder, plan, open_index(folder))
        for path in (*folder.glob(f"{UNFINISHED}*"), *(folder / ROWS).glob(f"{UNFINISHED}*")):
            path.unlink(missing_ok=True)
        return store

    def close(self) -> None:
        self.database.close()

    def missing(self) -> list[Chunk]:
        """Build the index from all files of rows, and return the chunks that have no file.

        Raise StudyFileError if a row is damaged.  An earlier index is never reused, because damage in it would go
        unnoticed.
        """
        clear(self.database)
        missing = []
        for chunk, exists in self._files():
            if exists:
                enter(self.database, self._chunk_rows(chunk))
            else:
                missing.append(chunk)
        return missing

    def verify(self) -> tuple[int, list[str]]:
        """Return the number of intact rows, and a message for each damaged file of rows."""
        intact, messages = 0, []
        for chunk, exists in self._files():
            try:
                intact += sum(1 for _ in self._chunk_rows(chunk)) if exists else 0
            except StudyFileError as error:
                messages.append(str(error))
        return intact, messages

    def _files(self) -> Iterator[tuple[Chunk, bool]]:
        """Yield each chunk, and True if its file exists.  Raise StudyFileError if a file belongs to no chunk."""
        present = {path.name for path in (self.folder / ROWS).glob("*.jsonl")}
        foreign = present - {chunk.name for chunk in self.plan.chunks()}
        if foreign:
            raise StudyFileError(f"{self.folder / ROWS}: {min(foreign)} is not a file of rows of this study")
        return ((chunk, chunk.name in present) for chunk in self.plan.chunks())

    def add(self, chunk: Chunk, text: str) -> None:
        """Store the rows of a chunk.  If the rows cannot be written, store nothing and raise StudyFileError."""
        put(self.folder / ROWS / chunk.name, b"".join(map(_with_checksum, text.encode("ascii").splitlines())))
        enter(self.database, map(json.loads, text.splitlines()))

    def rows(self) -> Iterator[Row]:
        """Yield every row of every file.  Raise StudyFileError if a file does not hold the rows of its chunk."""
        for chunk in self.plan.chunks():
            yield from self._chunk_rows(chunk)

    def decks_sha256(self) -> str:
        """Return the SHA-256 of all decks, card by card, in order."""
        digest = hashlib.sha256()
        for row in self.rows():
            digest.update("".join(card + "\n" for card in row["deck"]).encode("ascii"))
        return digest.hexdigest()

    def counts(self, *columns: str, cell: int | None = None, route: str | None = None) -> dict[tuple[Any, ...], int]:
        """Count the results by the values of columns of the index, or of tags such as ``tags.kind``.

        Return the number of results for each tuple of values, sorted by the values.  cell, route: if given, count only
        the results of this cell or route.
        """
        names = [_column(name) for name in columns]
        selected = {name: value for name, value in (("cell", cell), ("route", route)) if value is not None}
        condition = " AND ".join(f"runs.{name} = ?" for name in selected)
        where = f"WHERE {condition}" if selected else ""
        answers = self.database.execute(
            f"SELECT {', '.join(names)}, COUNT(*) FROM runs "
            "JOIN samples ON samples.cell = runs.cell AND samples.place = runs.place "
            f"{where} GROUP BY {', '.join(names)} ORDER BY {', '.join(names)}",
            list(selected.values()),
        )
        return {tuple(row[:-1]): row[-1] for row in answers}

    def query(self, sql: str, values: Sequence[Any] = ()) -> Iterator[tuple[Any, ...]]:
        """Execute an SQL query over the tables ``samples`` and ``runs`` (modern/study/index.py)."""
        return self.database.execute(sql, values)

    def _chunk_rows(self, chunk: Chunk) -> Iterator[Row]:
        """Yield the rows of a chunk. Raise StudyFileError if one is missing, damaged, or belongs to another sample."""
        path = self.folder / ROWS / chunk.name
        try:
            lines = path.read_bytes().splitlines(keepends=True)
        except OSError as error:
            raise StudyFileError(f"{path}: {reason(error)}") from None
        cell = self.plan.cells[chunk.cell]
        routes = {route.name for route in cell.routes}
        for number, (line, index) in enumerate(zip_longest(lines, range(chunk.start, chunk.stop)), 1):
            row = _row(line or b"")
            where = f"{path}: line {number}" + ("" if index is None else f" (sample {index})")
            expected = None if index is None else (index, cell.seed(self.plan.seed, index), routes)
            is_intact = line == _with_checksum((line or b"").rpartition(_CHECKSUM_FIELD)[0] + b"}")
            if not row or not is_intact or (row["index"], row["seed"], set(row["runs"])) != expected:
                raise StudyFileError(f"{where} is damaged; delete the file, and --resume computes it again")
            yield row


def _with_checksum(line: bytes) -> bytes:
    """Return a row with its checksum as last field: 16 hexadecimal digits of the SHA-256 of the other fields."""
    fields = line.removesuffix(b"}")
    return b'%s%s%s"}\n' % (fields, _CHECKSUM_FIELD, hashlib.sha256(fields).hexdigest()[:16].encode("ascii"))


def _row(line: bytes) -> Row | None:
    try:
        row: Row = json.loads(line)
    except ValueError:
        return None
    is_complete = isinstance(row, dict) and {"cell", "index", "seed", "deck", "judge"} <= row.keys()
    return row if is_complete and isinstance(row.get("runs"), dict) else None


def _column(name: str) -> str:
    if name.startswith("tags."):
        key = name.removeprefix("tags.")
        if not key.replace("_", "").isalnum():
            raise ValueError(f"{name!r} is not a tag of a row: expected letters, digits and underscores after 'tags.'")
        return f"json_extract(tags, '$.{key}')"
    if name in ("cell", "route", "outcome", "detail"):
        return f"runs.{name}"
    if name in JUDGE:
        return f"samples.{name}"
    raise ValueError(f"{name!r} is not a column of the index")
