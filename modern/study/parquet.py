"""``rows.parquet``: the answers of a study as one flat table, one row per answer, for pandas, DuckDB and the like.

The key of the cell, the tags of a set and the figures of a run have separate columns, such as ``key_n`` and
``figure_statements``, which are null if absent.  A column contains integers if all its values are integers, doubles if
the other values are decimals as text, and text otherwise.
"""

from collections.abc import Callable, Iterator, Mapping
from itertools import islice
from pathlib import Path
from typing import Any, Literal

from modern.study.index import JUDGE, Row
from modern.study.plan import Plan, Value
from modern.study.store import Store, placing

NAME = "rows.parquet"
# The number of answers written at once.
_BATCH = 10_000
Type = Literal["whole", "double", "text"]
_ORDER: tuple[Type, ...] = ("whole", "double", "text")


def write_parquet(folder: Path, plan: Plan, store: Store) -> None:
    """Write the table, unless pyarrow is not installed.  Raise StudyFileError if that fails."""
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError:
        return
    types = column_types(plan, store.rows)
    arrow = {"whole": pyarrow.int64(), "double": pyarrow.float64(), "text": pyarrow.string()}
    schema = pyarrow.schema([(name, arrow[kind]) for name, kind in types.items()])
    answers = _answers(plan, store.rows(), types)
    with placing(folder / NAME) as file, parquet.ParquetWriter(file, schema) as writer:
        while batch := list(islice(answers, _BATCH)):
            writer.write_table(pyarrow.Table.from_pylist(batch, schema=schema))


def column_types(plan: Plan, rows: Callable[[], Iterator[Row]]) -> dict[str, Type]:
    """Return the columns in order, with their types."""
    keys: dict[str, Type] = {}
    for cell in plan.cells:
        _widen(keys, "key_", cell.key, decimals=False)
    tags: dict[str, Type] = {}
    figures: dict[str, Type] = {}
    for row in rows():
        _widen(tags, "tag_", row.get("tags", {}), decimals=False)
        for run in row["runs"].values():
            _widen(figures, "figure_", run["figures"], decimals=True)
    return {
        "cell": "whole",
        **keys,
        "index": "whole",
        "seed": "text",
        **dict(sorted(tags.items())),
        "deck": "text",
        **dict.fromkeys(JUDGE, "whole"),
        "route": "text",
        "outcome": "text",
        "detail": "text",
        **dict(sorted(figures.items())),
    }


def _widen(types: dict[str, Type], lead: str, values: Mapping[str, Value], decimals: bool) -> None:
    """Enter the columns of these values, each with a type wide enough for them and for the earlier values."""
    for name, value in values.items():
        kind = _type(value, decimals)
        types[lead + name] = max(types.get(lead + name, "whole"), kind, key=_ORDER.index)


def _type(value: Value, decimals: bool) -> Type:
    if isinstance(value, int):
        return "whole" if abs(value) < 2**63 else "text"
    try:
        float(value)
    except ValueError:
        return "text"
    return "double" if decimals else "text"


def _answers(plan: Plan, rows: Iterator[Row], types: Mapping[str, Type]) -> Iterator[dict[str, Any]]:
    make: Mapping[Type, Callable[[Value], Any]] = {"whole": int, "double": float, "text": str}
    for row in rows:
        shared: dict[str, Value] = {
            **{f"key_{name}": value for name, value in plan.cells[row["cell"]].key.items()},
            **{f"tag_{name}": value for name, value in row.get("tags", {}).items()},
            **row["judge"],
            "cell": row["cell"],
            "index": row["index"],
            "seed": row["seed"],
            "deck": "".join(card + "\n" for card in row["deck"]),
        }
        for route, run in row["runs"].items():
            figures = {f"figure_{name}": value for name, value in run["figures"].items()}
            answer = {**shared, **figures, "route": route, "outcome": run["outcome"], "detail": run["detail"]}
            yield {name: make[types[name]](value) for name, value in answer.items()}
