"""The file ``charts.json``, which stores the charts of a report so that ``study --redraw`` can draw them again.

The file is a list.  Each chart has a kind (``bars`` or ``lines``), the fields of :class:`modern.study.report.Bars` or
``Lines``, marks, and series with points ``[position, value, low, high]``.  A null stands for an infinite limit of an
interval.
"""

import json
import re
from collections.abc import Iterable
from dataclasses import fields
from math import inf, isfinite
from pathlib import Path
from typing import Any

from emulator.files import reason
from modern.study.plan import StudyFileError
from modern.study.report import Bars, Chart, Lines, Mark, Series
from modern.study.statistics import Interval
from modern.study.store import put

NAME = "charts.json"
_KINDS: dict[str, type[Chart]] = {"bars": Bars, "lines": Lines}
_PARTS = ("kind", "marks", "series")
_FILE_NAME = re.compile(r"[A-Za-z0-9][\w-]*")


def write_charts(folder: Path, charts: Iterable[Chart]) -> None:
    texts = ",\n ".join(_text(chart) for chart in charts)
    put(folder / NAME, f"[{texts}]\n")


def read_charts(folder: Path) -> tuple[Chart, ...]:
    """Read the charts from the folder of a study.  Raise StudyFileError if the file is missing or invalid."""
    path = folder / NAME
    try:
        return tuple(_chart(data) for data in json.loads(path.read_text(encoding="utf-8")))
    except OSError as error:
        raise StudyFileError(f"{path}: {reason(error)}") from None
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError, OverflowError):
        raise StudyFileError(f"{path}: expected a file charts.json that a study has written") from None


def _text(chart: Chart) -> str:
    (kind,) = (kind for kind, chart_type in _KINDS.items() if type(chart) is chart_type)
    labels = {f.name: getattr(chart, f.name) for f in fields(chart) if f.name not in ("series", "marks")}
    marks = [{"at": mark.at, "words": mark.label, "upright": mark.upright} for mark in chart.marks]
    head = json.dumps({"kind": kind, **labels, "marks": marks}, ensure_ascii=False)
    lines = ",\n  ".join(
        json.dumps(
            {"name": series.name, "points": [[x, e.value, _limit(e.low), _limit(e.high)] for x, e in series.points]},
            ensure_ascii=False,
            allow_nan=False,
        )
        for series in chart.series
    )
    return f'{head[:-1]}, "series": [\n  {lines}]}}'


def _limit(value: float) -> float | None:
    return value if isfinite(value) else None


def _chart(data: dict[str, Any]) -> Chart:
    chart_type = _KINDS[data["kind"]]
    types = {f.name: f.type for f in fields(chart_type)}
    labels = {name: _checked(value, types[name]) for name, value in data.items() if name not in _PARTS}
    if not _FILE_NAME.fullmatch(labels["name"]):
        raise ValueError
    marks = tuple(
        Mark(float(mark["at"]), _checked(mark["words"], str), _checked(mark["upright"], bool)) for mark in data["marks"]
    )
    series = tuple(
        Series(_checked(entry["name"], str), tuple(_point(chart_type, *point) for point in entry["points"]))
        for entry in data["series"]
    )
    return chart_type(series=series, marks=marks, **labels)


def _checked(value: Any, expected: Any) -> Any:
    if type(value) is not expected:
        raise TypeError
    return value


def _point(chart_type: type[Chart], x: Any, value: float, low: float | None, high: float | None) -> Any:
    position = float(x) if chart_type is Lines else _checked(x, str)
    return position, Interval(float(value), -inf if low is None else float(low), inf if high is None else float(high))
