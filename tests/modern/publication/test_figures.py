"""Figures by name: all exist in the committed results, and the article quotes no result as a number."""

import re
from pathlib import Path

import pytest

from modern.publication.figures import Cell, FigureError, cells, figures, filled, named, read_cell
from tests.support import documents
from tests.support.paths import ROOT

DOCS = ROOT / "docs"
MADE = ("commands", "python")
"""What pages put in besides: the references made from the code (test_reference.py)."""


@pytest.fixture(scope="module")
def values() -> dict[str, str]:
    return figures(DOCS)


CELLS = cells(DOCS)


@pytest.mark.parametrize("name", CELLS)
def test_every_cell_exists(name: str) -> None:
    assert read_cell(DOCS, CELLS[name])


def test_every_figure_is_named_quoted_and_filled(values: dict[str, str]) -> None:
    names = {name for page in documents.PAGES for name in named(page.read_text(encoding="utf-8"))}
    assert names - {*values, *MADE} == set()
    quoted = {name for page in documents.PAGES for name in named(page.read_text(encoding="utf-8"))}
    assert sorted(set(CELLS) - quoted) == []
    texts = {page.name: page.read_text(encoding="utf-8") for page in documents.PAGES}
    assert [name for name, text in texts.items() if "{{" in filled(text, dict.fromkeys(named(text), ""))] == []
    text = (DOCS / "article.md").read_text(encoding="utf-8")
    assert typed(text) == []
    assert len(named(text)) > 30


def test_figures_agree_with_other_reports(values: dict[str, str]) -> None:
    report = (DOCS / "weight" / "report.md").read_text(encoding="utf-8")
    assert f"no check detects {values['weight.silent']} ({values['weight.silent-share']})" in report
    assert f"{values['weight.variants']} of {values['weight.variants']} variants were judged" in report
    readme = (ROOT / "fortran_src" / "README.md").read_text(encoding="utf-8")
    assert f"{values['listings.statements']} statements" in readme
    assert f"The witness has {values['listings.characters']} characters" in readme
    assert f"values from -e to +e count as zero ({values['listings.rows-epsilon']} rows)" in readme
    assert values["statements.table"].splitlines()[-1].startswith(f"| all | {values['statements.all.count']} |")
    assert values["examples.run-exact"] == values["examples.run-results"]
    assert (values["seventy.sets"], values["capacity.listed"]) == ("140,000", "98")


REFERENCES = (
    r"^## References\n.*\Z",  # the bibliography
    r"\[\d+\]|\ba \d+ % confidence\s+interval",  # citations, the level of all intervals
    r"^```.*?^```",  # commands
    r"`[^`]*`",  # names
    r"\{\{.*?\}\}",  # figures
    r"\]\([^)]*\)",  # where links lead
    r"\bpp?\. [\d-]+(?:, [\d-]+)*",  # pages
    r"\b(?:chapter|program|theorem|statement|example|row|fig\.|volume|number)s? [\d.+-]+",
    r"\b(?:19|20)\d\d\b",  # years
    r"\b1620\b|\bhull1620\b|\bC26-5619\b",  # the machine, the project, a manual
    r"\*[^*\n]+(?:\n[^*\n]+)?\*",  # titles
    r"\bP[123]-\d+",  # rows
    r"^(?:#+ |)\d+\. ",  # numbers of sections and of references
)


def typed(text: str) -> list[str]:
    """Return the numbers in a text, except those of pages, chapters, years and the like."""
    text = text.replace("**", "")
    for pattern in REFERENCES:
        text = re.sub(pattern, "", text, flags=re.MULTILINE | re.DOTALL | re.IGNORECASE)
    return re.findall(r"\S*\d\S*", text)


@pytest.mark.parametrize(
    ("text", "numbers"),
    [
        ("13.8 % of the seventies", ["13.8"]),
        ("in 1963 (p. 117-118, chapter 7)", []),
        ("{{ seventy.failures }} of 70", ["70"]),
        ("`program3 147` and [x](a.md#1)", []),
    ],
)
def test_a_typed_result_is_detected(text: str, numbers: list[str]) -> None:
    assert typed(text) == numbers


def test_names_are_replaced_by_figures_and_unknown_ones_rejected() -> None:
    text = filled("a {{ x.y-z }} b {{n}} {no} {{ X }}", {"x.y-z": "1 %", "n": "2"})
    assert text == "a 1\N{NO-BREAK SPACE}% b 2 {no} {{ X }}"
    code = "```\n2 (1 to 3) %\n```\n"
    assert filled(f"{code}is 2 (1 to 3) %", {}) == f"{code}is 2\xa0(1\xa0to\xa03)\xa0%"
    assert named("{{ b }} {{ a.c }} {{ b }}") == ("b", "a.c", "b")
    with pytest.raises(FigureError, match=r"unknown figure 'seventy\.mean'"):
        filled("{{ seventy.mean }}", {"seventy.sets": "1"})


@pytest.mark.parametrize("row", [("a",), ("c",), ("b", "2")])
def test_a_missing_or_ambiguous_cell_is_rejected(row: tuple[str, ...], tmp_path: Path) -> None:
    (tmp_path / "t.csv").write_text("x,y,z\na,1,2\na,2,3\nb,1,5\n", encoding="utf-8")
    assert read_cell(tmp_path, Cell("t.csv", ("a", "2"), "z")) == "3"
    with pytest.raises(FigureError, match=r"t\.csv"):
        read_cell(tmp_path, Cell("t.csv", row, "z"))
    with pytest.raises(FigureError, match="column w"):
        read_cell(tmp_path, Cell("t.csv", ("b",), "w"))
