"""``charts.json``: the charts of a report as data, from which ``study --redraw`` draws them anew without the rows.

A list; each chart has kind (``bars`` or ``lines``), the fields of :class:`modern.study.report.Bars` or ``Lines``, and
series with points ``[place, value, low, high]``, where null stands for no limit.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from dataclasses import fields
from math import inf, isfinite
from pathlib import Path
from typing import Any

from modern.study.plan import StudyFileError
from modern.study.report import Bars, Chart, Lines, Mark, Series
from modern.study.statistics import Interval
from modern.study.store import put

NAME = "charts.json"
_KINDS: dict[str, type[Chart]] = {"bars": Bars, "lines": Lines}
_FILE_NAME = re.compile(r"[A-Za-z0-9][\w-]*")


def write_charts(folder: Path, charts: Iterable[Chart]) -> None:
    """The charts to a study's folder.  Raises StudyFileError."""
    texts = ",\n ".join(_text(chart) for chart in charts)
    put(folder / NAME, f"[{texts}]\n")


def read_charts(folder: Path) -> tuple[Chart, ...]:
    """The charts of a study's folder.  Raises StudyFileError where there are none that can be read."""
    path = folder / NAME
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        return tuple(_chart(one) for one in found)
    except OSError as error:
        raise StudyFileError(f"{path}: {(error.strerror or str(error)).lower()}") from None
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError, OverflowError):
        raise StudyFileError(f"{path}: not the charts of a study") from None


def _text(chart: Chart) -> str:
    """A chart as JSON: a line for its words, a line for each series."""
    (kind,) = (kind for kind, made in _KINDS.items() if type(chart) is made)
    data = {f.name: getattr(chart, f.name) for f in fields(chart) if f.name not in ("series", "marks")}
    marks = [{f.name: getattr(mark, f.name) for f in fields(mark)} for mark in chart.marks]
    series = [
        {"name": one.name, "points": [[place, e.value, _bound(e.low), _bound(e.high)] for place, e in one.points]}
        for one in chart.series
    ]
    words = json.dumps({"kind": kind, **data, "marks": marks}, ensure_ascii=False)
    lines = ",\n  ".join(json.dumps(one, ensure_ascii=False, allow_nan=False) for one in series)
    return f'{words[:-1]}, "series": [\n  {lines}]}}'


def _bound(value: float) -> float | None:
    return value if isfinite(value) else None


def _chart(data: dict[str, Any]) -> Chart:
    """Raises ValueError, TypeError or KeyError where the data is not a chart's."""
    made = _KINDS[data["kind"]]
    kinds = {f.name: f.type for f in fields(made)}
    plain = {name: _plain(value, str(kinds[name])) for name, value in data.items() if name not in _PARTS}
    if not _FILE_NAME.fullmatch(plain["name"]):
        raise ValueError
    marks = tuple(
        Mark(float(mark["at"]), _plain(mark["words"], "str"), _plain(mark["upright"], "bool")) for mark in data["marks"]
    )
    series = tuple(
        Series(_plain(one["name"], "str"), tuple(_point(made, *point) for point in one["points"]))
        for one in data["series"]
    )
    return made(series=series, marks=marks, **plain)


_PARTS = ("kind", "marks", "series")
_TYPES: dict[str, type] = {"str": str, "bool": bool}


def _plain(value: Any, kind: str) -> Any:
    if type(value) is not _TYPES[kind]:
        raise TypeError
    return value


def _point(made: type[Chart], place: Any, value: float, low: float | None, high: float | None) -> Any:
    where = float(place) if made is Lines else _plain(place, "str")
    return where, Interval(float(value), -inf if low is None else float(low), inf if high is None else float(high))
