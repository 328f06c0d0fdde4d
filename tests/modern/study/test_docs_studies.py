"""The committed results of the built-in studies belong to their current plans, at the default size."""

from __future__ import annotations

import csv
import json
import re
from dataclasses import fields
from inspect import signature

import pytest

from modern.study.families import FAMILIES
from modern.study.measures import MEASURES
from modern.study.plan import Port, Programs
from modern.study.registry import names, study
from modern.study.tomlplan import _CELL, _HEAD
from tests.support.paths import ROOT

DOCS = ROOT / "docs" / "studies"


@pytest.mark.parametrize("name", names())
def test_committed_manifest_agrees_with_the_default_plan(name: str) -> None:
    manifest = json.loads((DOCS / name / "manifest.json").read_text(encoding="utf-8"))
    module = study(name)
    assert manifest["complete"] is True
    assert manifest["plan"] == module.plan(module.SAMPLES, 1963).document()


@pytest.mark.parametrize("name", names())
def test_pictures_and_main_table_of_a_report_exist(name: str) -> None:
    report = (DOCS / name / "report.md").read_text(encoding="utf-8")
    pictures = re.findall(r"!\[[^]]*\]\(([^)]+)\)", report)
    assert pictures
    for picture in pictures:
        assert (DOCS / name / picture).read_text(encoding="utf-8").rstrip().endswith("</svg>")
    assert (DOCS / name / "table.csv").is_file()


def test_pages_and_pictures_linked_in_the_readme_exist() -> None:
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    for path in re.findall(r"\((docs/[\w/.-]+)\)", readme):
        assert (ROOT / path).exists(), path


def cell(study: str, table: str, row: str, column: str) -> str:
    """Return a cell of a committed table, by the text of the first column and the head."""
    with open(DOCS / study / f"{table}.csv", encoding="utf-8", newline="") as file:
        return next(line[column] for line in csv.DictReader(file) if next(iter(line.values())) == row)


def column(study: str, table: str, name: str) -> list[str]:
    with open(DOCS / study / f"{table}.csv", encoding="utf-8", newline="") as file:
        return [line[name] for line in csv.DictReader(file)]


def table_rows(study: str, table: str) -> list[dict[str, str]]:
    with open(DOCS / study / f"{table}.csv", encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def quoted() -> list[tuple[str, str]]:
    """Return sentences of docs/explanation by section, with figures taken from the tables."""
    failures = sum(int(n) for n in column("seventy", "causes", "as listed"))
    refused = sum(
        int(n)
        for outcome, n in zip(
            column("seventy", "causes", "outcome"), column("seventy", "causes", "as listed"), strict=True
        )
        if outcome == "DATA NOT ACCEPTABLE"
    )
    assert refused == 0
    third, added = (row for row in table_rows("seventy", "decimals") if row["decimals"] == "33.3 %")
    sizes = {way: cell("rounding", "table", way, "whole numbers up to") for way in column("rounding", "table", "way")}
    (decimal,) = {size for way, size in sizes.items() if not way.startswith("float")}
    tenth = "near a plane with a gap of .1"
    spheres = [n for n in column("capacity", "table", "more than 98 from N =") if n != "-"]
    assert spheres == [cell("capacity", "table", "sphere", "more than 98 from N =")]
    kept, moved = (
        cell("translation", "digits", "numbers to 99", f"eight digits, origin {way}") for way in ("kept", "moved to C")
    )
    three = "capacity, machine-time, divergence"
    most = cell("capacity", "storage", "most places seen", "places")
    return [
        ("seventy", f"seventy such sets have {cell('seventy', 'table', 'as listed', 'failures in 70')} failures"),
        (
            "seventy",
            f"and {cell('seventy', 'table', 'as listed', '70s with 2 or more')} of the groups of seventy have two or",
        ),
        ("seventy", f"P3-025 there are {cell('seventy', 'table', 'last pair mended', 'failures in 70')}."),
        ("seventy", f"None of the {failures} failures is DATA NOT ACCEPTABLE."),
        ("seventy", f"as on the sheet, {third['refused']} are rejected, or {added['refused']}"),
        ("seventy", f"if {third['sheets in 70 for two']} of the seventy are such sheets"),
        ("seventy", f"fail otherwise ({third['failed otherwise']} of {third['sets']})"),
        ("rounding", f"up to {decimal} failed in any decimal arithmetic, up to {sizes['float32']} with float32"),
        ("rounding", f"and up to {sizes['float64']} with float64."),
        ("rounding", f"of .1, truncation finds {cell('rounding', 'exact', tenth, 'truncating')} of the hulls"),
        ("rounding", f"cannot represent a tenth, finds {cell('rounding', 'exact', tenth, 'float64')}."),
        ("epsilon", f"The best, {cell('epsilon', 'best', 'as it is', 'best e')}, finds "),
        ("epsilon", f"finds {cell('epsilon', 'best', 'as it is', 'hulls found with it')} of the hulls."),
        ("epsilon", f"The best scaled e is {cell('epsilon', 'best', 'scaled', 'best e')}, with "),
        ("epsilon", f"with {cell('epsilon', 'best', 'scaled', 'hulls found with it')}. With an e"),
        (
            "epsilon",
            f"failed, {cell('epsilon', 'price', 'greater', 'of these sets')} of the sets end in a plausible but wrong",
        ),
        ("translation", f"from {cell('translation', 'ratio', 'less than 0.5', 'processor time saved')} for hulls with"),
        ("translation", f"to {cell('translation', 'ratio', '1.5 and more', 'processor time saved')} for those"),
        ("translation", f"find {kept} of the hulls, and with the origin moved only {moved}."),
        (
            three,
            f"more than 98 entries, from N = {spheres[0]} on. The largest number observed is {most},",
        ),
        (
            three,
            f"takes about {cell('capacity', 'storage', 'most places seen', 'positions, about')} positions and needs a "
            f"machine of {cell('capacity', 'storage', 'most places seen', 'smallest core')}.",
        ),
        (
            three,
            f"51 points on a sphere take {cell('machine-time', 'table', 'sphere', 'minutes')} minutes.",
        ),
        (
            three,
            f"is program1 196+2, in {cell('divergence', 'table', 'program1 196+2', 'of all sets')} of the sets; "
            f"in {cell('divergence', 'table', 'nowhere', 'of all sets')} all decisions agree.",
        ),
        (
            "How many digits are always enough",
            f"failure is {', '.join(column('digits', 'table', 'least P without failure'))} for d from 1 to 8.",
        ),
    ]


@pytest.mark.parametrize(("section", "sentence"), quoted())
def test_figures_quoted_in_the_documents_are_those_of_the_tables(section: str, sentence: str) -> None:
    pages = ("studies.md", "eight-digits.md")
    text = "\n".join((ROOT / "docs" / "explanation" / page).read_text(encoding="utf-8") for page in pages)
    (paragraphs,) = [part for part in text.split("\n## ") if part.startswith(f"{section}\n")]
    assert sentence in " ".join(paragraphs.split())


def test_statements_are_sorted_by_frequency() -> None:
    assert column("divergence", "table", "first other decision")[0] == "program1 196+2"
    sets = [int(n) for n in column("divergence", "table", "sets")[:-1]]
    assert sets == sorted(sets, reverse=True)


@pytest.mark.parametrize("name", names())
def test_report_contains_every_table(name: str) -> None:
    report = (DOCS / name / "report.md").read_text(encoding="utf-8")
    for path in (DOCS / name).glob("*.csv"):
        with open(path, encoding="utf-8", newline="") as file:
            for row in csv.reader(file):
                assert "| " + " | ".join(row) + " |" in report, path


HOW_TO = (ROOT / "docs" / "how-to" / "own-study.md").read_text(encoding="utf-8")


def rows_of(head: str) -> set[str]:
    """Return the names in the first column of the table with that head."""
    (table,) = re.findall(rf"^\| {re.escape(head)} .*\n\|[-|]+\n((?:\|.*\n)+)", HOW_TO, re.MULTILINE)
    return {name for line in table.splitlines() for name in re.findall(r"`(\w[\w-]*)`", line.split("|")[1])}


@pytest.mark.parametrize(
    ("head", "names"),
    [
        ("at the head", {*_HEAD} - {"route", "cell"}),
        ("in `[[route]]`", {"kind", *(field.name for made in (Programs, Port) for field in fields(made))}),
        ("in `[[cell]]`", {*_CELL}),
        ("family", {*FAMILIES, "file"}),
        ("measure", {*MEASURES}),
    ],
)
def test_how_to_describes_every_key_family_and_measure(head: str, names: set[str]) -> None:
    assert rows_of(head) == names


def test_how_to_describes_every_parameter_of_a_family() -> None:
    for name, family in FAMILIES.items():
        (line,) = re.findall(rf"^\| `{name}` \| (.*?) \|", HOW_TO, re.MULTILINE)
        parameters = [parameter for parameter in signature(family).parameters if parameter != "draw"]
        assert sorted(re.findall(r"`(\w+)`", line)) == sorted(parameters), name


def test_how_to_states_the_defaults_of_a_route() -> None:
    for made in (Programs, Port):
        for field in fields(made):
            if field.name in ("limit", "core", "arithmetic", "state", "bounds"):
                (line,) = re.findall(rf"^\| `{field.name}` \|.*", HOW_TO, re.MULTILINE)
                assert str(field.default) in line.rsplit("|", 2)[1], field.name
