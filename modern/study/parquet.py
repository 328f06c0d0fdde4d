"""The rows as Parquet, for whoever reads them with other tools; needs pyarrow (extra ``parquet``)."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from itertools import islice
from pathlib import Path
from typing import Any

import pyarrow as pa
from pyarrow import parquet

from modern.study.files import placing

_BATCH = 10_000
_JUDGE = ("n", "dimension", "vertices", "planes", "boundary", "inside")
SCHEMA = pa.schema(
    [
        *((name, pa.int64()) for name in ("cell", "index")),
        *((name, pa.string()) for name in ("seed", "tags", "deck")),
        *((name, pa.int64()) for name in _JUDGE),
        *((name, pa.string()) for name in ("route", "outcome", "detail", "figures")),
    ]
)


def write_parquet(path: Path, rows: Iterable[dict[str, Any]]) -> None:
    """One row for each answer, in order; tags and figures as JSON, the deck as text.  Raises StudyFileError."""
    answers = _answers(rows)
    with placing(path) as file, parquet.ParquetWriter(file, SCHEMA) as writer:
        while batch := list(islice(answers, _BATCH)):
            writer.write_table(pa.Table.from_pylist(batch, schema=SCHEMA))


def _answers(rows: Iterable[dict[str, Any]]) -> Iterator[dict[str, Any]]:
    for row in rows:
        shared = {
            **{name: row[name] for name in ("cell", "index", "seed")},
            "tags": json.dumps(row.get("tags", {}), sort_keys=True),
            "deck": "".join(card + "\n" for card in row["deck"]),
            **row["judge"],
        }
        for route, run in row["runs"].items():
            figures = json.dumps(run["figures"], sort_keys=True)
            yield {**shared, "route": route, "outcome": run["outcome"], "detail": run["detail"], "figures": figures}
