"""Figures 1 to 4 as committed are those drawn from the data."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import pytest

from modern.claims.thesis.chapter4_figures import FIGURES, figure
from tests.support.paths import ROOT


@pytest.mark.parametrize("number", FIGURES)
def test_the_committed_figure_is_the_one_drawn(number: str) -> None:
    assert Path(ROOT, "docs", "figures", f"chapter4-{number}.svg").read_text(encoding="utf-8") == figure(number)


@pytest.mark.parametrize(("number", "lines", "names"), [("1", 12, 6), ("3", 5, 3)])
def test_lines_and_names(number: str, lines: int, names: int) -> None:
    tags = [element.tag.rpartition("}")[2] for element in ElementTree.fromstring(figure(number)).iter()]
    assert (tags.count("line"), tags.count("text")) == (lines, names)


@pytest.mark.parametrize("number", ["2", "4"])
def test_a_triangle_is_added_to_a_polygon(number: str) -> None:
    text = figure(number)
    assert text.count("stroke-dasharray") == 2
    assert text.count("<line") >= 5
    assert all(f">{name}<" in text for name in ("P_a", "P_b", "P_NV+1"))


def test_there_are_four() -> None:
    with pytest.raises(KeyError):
        figure("5")
