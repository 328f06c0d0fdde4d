"""Charts are legible: no overlaps, no hidden series, typographic signs, and a style that works in grey."""

import json
from dataclasses import replace
from itertools import combinations
from math import inf
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from modern.cli.main import main
from modern.publication.site.colours import ROLES
from modern.study import layout, plots
from modern.study.builtin import names as studies
from modern.study.chartfile import read_charts, write_charts
from modern.study.report import Bars, Chart, Lines, Mark, Series
from modern.study.statistics import Interval
from tests.support.paths import ROOT

NEEDS_MATPLOTLIB = pytest.mark.skipif(bool(plots.can_plot()), reason="needs matplotlib")


def lines(count: int, places: int, apart: float = 0.0, **more: Any) -> Lines:
    """Return a chart of constant series, ``apart`` from one another, at x = 1, 2 and so on."""
    series = tuple(
        Series(
            f"series {k}", tuple((float(n + 1), Interval(k * apart, k * apart, k * apart + 0.1)) for n in range(places))
        )
        for k in range(count)
    )
    return Lines("lines", "Lines", "x", "y", series, **more)


def bars(count: int, places: int, **more: Any) -> Bars:
    points = tuple((f"place {n}", Interval(0.5, 0.4, 0.6)) for n in range(places))
    return Bars("bars", "Bars", "x", "y", tuple(Series(f"series {k}", points) for k in range(count)), **more)


MARKS = (Mark(2, "a level"), Mark(3, "a place", upright=True))
CHARTS: dict[str, Chart] = {
    "one line": lines(1, 5, marks=MARKS, note="a note"),
    "side by side": lines(3, 6, marks=MARKS, note="a note"),
    "lines in panels": lines(6, 25, marks=MARKS, note="a note"),
    "logarithmic": replace(lines(2, 8, marks=MARKS, note="n"), log_x=True),
    "bars": bars(3, 5, marks=(Mark(2, "here", upright=True),), note="a note", percent=True),
    "bars in panels": bars(5, 13, marks=(Mark(2, "here", upright=True),), note="a note", percent=True),
}


def laid_out(chart: Chart) -> Any:
    """Return the figure of the chart after its layout."""
    import matplotlib

    with matplotlib.rc_context(plots._STYLE):
        figure = plots.drawn(chart)
        figure.draw_without_rendering()
    return figure


@NEEDS_MATPLOTLIB
@pytest.mark.parametrize("chart", CHARTS.values(), ids=CHARTS)
def test_labels_and_notes_do_not_overlap(chart: Chart) -> None:
    figure = laid_out(chart)
    texts = [text.get_window_extent() for text in figure.texts]
    boxes = [axes.get_window_extent() for axes in figure.axes if axes.axison]
    assert not figure.legends
    assert not any(box.overlaps(other) for box in boxes for other in texts)
    names = [text.get_window_extent() for axes in figure.axes for text in axes.texts]
    assert not any(box.overlaps(other) for box, other in combinations((*names, *texts), 2))
    page = figure.bbox
    assert all(page.x0 <= box.x0 and box.x1 <= page.x1 for box in (*names, *texts))


@NEEDS_MATPLOTLIB
@pytest.mark.parametrize("chart", CHARTS.values(), ids=CHARTS)
def test_every_series_and_mark_is_named_in_the_chart(chart: Chart) -> None:
    figure = laid_out(chart)
    shown = [text.get_text() for axes in figure.axes for text in (*axes.texts, axes.title, axes._left_title)]
    notes = " ".join(text.get_text() for text in figure.texts)
    assert len(chart.series) == 1 or {series.name for series in chart.series} <= set(shown)
    assert all(mark.label in shown or f"dashed line: {mark.label}" in notes for mark in chart.marks)


@NEEDS_MATPLOTLIB
def test_an_svg_has_the_colours_of_both_themes_and_the_type_of_the_site(tmp_path: Path) -> None:
    plots.draw(CHARTS["side by side"], tmp_path)
    svg = (tmp_path / "lines.svg").read_text()
    assert svg.count("@media (prefers-color-scheme: dark)") == 1
    assert f"fill: {plots.INK}" in svg.partition("</defs>")[2]
    assert f"fill: {plots.PAPER}" in svg
    assert plots.DARK[plots.PAPER] == ROLES["paper"][1]
    assert tuple(ROLES[role][0] for role in ("ink", "paper", "quiet")) == (plots.INK, plots.PAPER, plots.QUIET)
    assert "IBMPlexSans" in svg


@NEEDS_MATPLOTLIB
@pytest.mark.parametrize("chart", [lines(3, 6), lines(5, 13), lines(6, 25), lines(6, 6, 0.01)])
def test_no_series_hides_another(chart: Lines) -> None:
    """Markers at the same x are 3.4 points apart, or each series has separate axes."""
    figure = laid_out(chart)
    alone = [axes for axes in figure.axes if axes.axison]
    marked = [[line for line in axes.lines if line.get_marker() not in ("", "None", None)] for axes in alone]
    # The caps of error bars are lines with markers too, but without a line style.
    marked = [[line for line in marks if line.get_linestyle() not in ("None", "")] for marks in marked]
    if len(alone) > 1:
        assert [len(marks) for marks in marked] == [1] * len(chart.series)
        return
    assert len(marked[0]) == len(chart.series)
    points = [line.get_transform().transform(line.get_xydata()) * 72 / figure.dpi for line in marked[0]]
    for one, other in combinations(points, 2):
        for a, b in zip(one, other, strict=True):
            assert ((a - b) ** 2).sum() ** 0.5 > 0.9 * layout.APART


def test_series_are_side_by_side_if_possible_and_otherwise_in_panels() -> None:
    assert layout.steps(lines(3, 6)) == (-5.5, 0.0, 5.5)
    assert layout.steps(lines(2, 6, apart=1.0)) == (0.0, 0.0)
    assert not layout.panels(lines(3, 6))
    assert layout.panels(lines(6, 25))
    assert not layout.panels(lines(6, 25, apart=1.0))
    assert not layout.panels(bars(5, 8))
    assert layout.panels(bars(5, 9))


@pytest.mark.parametrize(
    ("text", "printed"),
    [
        ("e = 10^-3", "e = 10⁻³"),
        ("10^12", "10¹²"),
        ("k, where e = 10^k", "k, where e = 10ᵏ"),
        ("gap 1E-5", "gap 10⁻⁵"),
        ("2.5E+3", "2.5 × 10⁺³"),
        ("from -1.5 to -.5", "from −1.5 to −.5"),
        ("program1 196+2", "program1 196+2"),
        ("two-digit 3d-1 1963-1964 P3-025", "two-digit 3d-1 1963-1964 P3-025"),
        ("example1E5", "example1E5"),
    ],
)
def test_text_is_typeset(text: str, printed: str) -> None:
    assert layout.typeset(text) == printed


NUMBERS = st.floats(allow_nan=False, allow_infinity=False)
INTERVALS = st.builds(Interval, NUMBERS, NUMBERS | st.just(-inf), NUMBERS | st.just(inf))


@settings(max_examples=12)
@given(st.lists(st.tuples(NUMBERS, INTERVALS)), st.text(st.characters(codec="utf-8")), st.booleans())
def test_charts_are_unchanged_by_writing_and_reading(tmp_path_factory, points, words, log) -> None:
    folder = tmp_path_factory.mktemp("charts")
    line = Lines("a-1", words, "x", words, (Series(words, tuple(points)),), marks=(Mark(1.5, words, log),), log_y=log)
    bar = Bars("b", "", "", "", (Series("s", tuple((str(x), e) for x, e in points)),), percent=log, note=words)
    write_charts(folder, (line, bar))
    assert read_charts(folder) == (line, bar)


@pytest.mark.parametrize(
    "text",
    [
        *("", "{", "3", "[3]", "[{}]", '"abc"', "[" * 100_000),
        '[{"kind": "pie", "name": "a", "marks": [], "series": []}]',
        *(
            json.dumps(
                [{"kind": "lines", "name": "a", "title": "", "x": "", "y": "", "marks": [], "series": [], **wrong}]
            )
            for wrong in (
                {"name": "../a"},
                {"name": ""},
                {"name": 3},
                {"percent": 1},
                {"more": ""},
                {"marks": [{"at": "x", "words": "", "upright": False}]},
                {"series": [{"name": "s", "points": [[1, 2, 3]]}]},
                {"series": [{"name": "s", "points": [["p", 2, 3, 4]]}]},
                {"kind": "bars", "series": [{"name": "s", "points": [[1, 2, 3, 4]]}]},
            )
        ),
    ],
)
def test_damaged_file_of_charts_gives_a_one_line_error(tmp_path: Path, text: str, capsys) -> None:
    (tmp_path / "charts.json").write_text(text)
    assert main(["study", "--redraw", str(tmp_path)]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.endswith("charts.json: expected a file charts.json that a study has written\n")
    assert err.count("\n") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["charts.json"]


@NEEDS_MATPLOTLIB
def test_redrawn_charts_equal_the_original_ones(tmp_path: Path, capsys) -> None:
    first, again = tmp_path / "first", tmp_path / "again"
    charts = (CHARTS["logarithmic"], CHARTS["bars"])
    for folder in (first, again):
        folder.mkdir()
        write_charts(folder, charts)
    for chart in charts:
        plots.draw(chart, first)
    assert main(["study", "--redraw", str(again)]) == 0
    assert capsys.readouterr().out.count("\n") == len(charts)
    assert {path.name: path.read_bytes() for path in first.iterdir()} == {
        path.name: path.read_bytes() for path in again.iterdir()
    }


@pytest.mark.parametrize("name", studies())
def test_committed_charts_belong_to_the_report_and_hide_no_series(name: str) -> None:
    folder = ROOT / "docs" / "studies" / name
    charts = read_charts(folder)
    assert {f"{chart.name}.svg" for chart in charts} == {path.name for path in folder.glob("*.svg")}
    report = (folder / "report.md").read_text(encoding="utf-8")
    for chart in charts:
        assert f"![{chart.title}]({chart.name}.svg)" in report
        for series in chart.series:
            assert all(e.low <= e.value <= e.high for _, e in series.points)
            assert (
                not chart.percent or name == "translation" or all(0 <= e.low <= e.high <= 1 for _, e in series.points)
            )
        if isinstance(chart, Lines) and not layout.panels(chart):
            assert max(layout.hidden(chart)) < 1


def test_bars_can_be_told_from_their_hatching_and_error_bars_in_a_dark_theme() -> None:
    def luminance(colour: str) -> float:
        channels = (int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5))
        red, green, blue = (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels)
        return 0.2126 * red + 0.7152 * green + 0.0722 * blue

    ink = luminance(plots.DARK[plots.INK])
    for fill in plots.FILLS:
        assert (ink + 0.05) / (luminance(plots.DARK.get(fill, fill)) + 0.05) > 3, fill
