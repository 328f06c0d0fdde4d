"""The committed results of the built-in studies belong to the studies as they stand, at their default size."""

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
def test_the_manifest_is_that_of_the_default_plan(name: str) -> None:
    manifest = json.loads((DOCS / name / "manifest.json").read_text(encoding="utf-8"))
    found = study(name)
    assert manifest["complete"] is True
    assert manifest["plan"] == found.plan(found.SAMPLES, 1963).document()


@pytest.mark.parametrize("name", names())
def test_every_picture_and_table_of_the_report_is_there(name: str) -> None:
    report = (DOCS / name / "report.md").read_text(encoding="utf-8")
    pictures = re.findall(r"!\[[^]]*\]\(([^)]+)\)", report)
    assert pictures
    for picture in pictures:
        assert (DOCS / name / picture).read_text(encoding="utf-8").rstrip().endswith("</svg>")
    assert (DOCS / name / "table.csv").is_file()


def test_the_readme_shows_pictures_of_two_studies() -> None:
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    shown = set(re.findall(r"\(docs/studies/([\w-]+)/[\w-]+\.svg\)", readme))
    assert len(shown) == 2
    for path in re.findall(r"\((docs/[\w/.-]+)\)", readme):
        assert (ROOT / path).exists(), path


def cell(study: str, table: str, row: str, column: str) -> str:
    """A cell of a committed table, by the first column's text and the head."""
    with open(DOCS / study / f"{table}.csv", encoding="utf-8", newline="") as file:
        return next(line[column] for line in csv.DictReader(file) if next(iter(line.values())) == row)


def column(study: str, table: str, name: str) -> list[str]:
    with open(DOCS / study / f"{table}.csv", encoding="utf-8", newline="") as file:
        return [line[name] for line in csv.DictReader(file)]


def table_rows(study: str, table: str) -> list[dict[str, str]]:
    with open(DOCS / study / f"{table}.csv", encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def quoted() -> list[tuple[str, str]]:
    """Sentences of docs/explanation with their figures taken from the tables, by section."""
    lost = sum(int(n) for n in column("seventy", "causes", "as listed"))
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
        ("seventy", f"and {cell('seventy', 'table', 'as listed', '70s with 2 or more')} of the seventies have two or"),
        ("seventy", f"P3-025 there are {cell('seventy', 'table', 'last pair mended', 'failures in 70')}."),
        ("seventy", f"Of the {lost} failures none is DATA NOT ACCEPTABLE."),
        ("seventy", f"with the sheet's third {third['refused']} are, or {added['refused']}"),
        ("seventy", f"if {third['sheets in 70 for two']} of the seventy are such sheets"),
        ("seventy", f"fail otherwise ({third['failed otherwise']} of {third['sets']})"),
        ("rounding", f"up to {decimal} failed in any decimal way, up to {sizes['float32']} with float32"),
        ("rounding", f"and up to {sizes['float64']} with float64."),
        ("rounding", f"of .1 truncation finds {cell('rounding', 'exact', tenth, 'truncating')} of the hulls"),
        ("rounding", f"cannot hold a tenth, {cell('rounding', 'exact', tenth, 'float64')}."),
        ("epsilon", f"The best, {cell('epsilon', 'best', 'as it is', 'best e')}, finds "),
        ("epsilon", f"finds {cell('epsilon', 'best', 'as it is', 'hulls found with it')} of the hulls;"),
        ("epsilon", f"scaled it is {cell('epsilon', 'best', 'scaled', 'best e')}, with "),
        ("epsilon", f"with {cell('epsilon', 'best', 'scaled', 'hulls found with it')}. Of the sets"),
        ("epsilon", f"failed, {cell('epsilon', 'price', 'greater', 'of these sets')} end in a wrong hull"),
        ("translation", f"from {cell('translation', 'ratio', 'less than 0.5', 'processor time saved')} for hulls"),
        ("translation", f"to {cell('translation', 'ratio', '1.5 and more', 'processor time saved')} for those"),
        ("translation", f"find {kept} of the hulls with eight digits, and {moved} with the origin moved."),
        (
            three,
            f"more than 98 places, from N = {spheres[0]} on; the most seen is {most},",
        ),
        (
            three,
            f"takes about {cell('capacity', 'storage', 'most places seen', 'positions, about')} positions and wants a "
            f"machine of {cell('capacity', 'storage', 'most places seen', 'smallest core')}.",
        ),
        (
            three,
            f"51 points on a sphere take {cell('machine-time', 'table', 'sphere', 'minutes')} minutes.",
        ),
        (
            three,
            f"is program1 196+2, in {cell('divergence', 'table', 'program1 196+2', 'of all sets')} of the sets; "
            f"{cell('divergence', 'table', 'nowhere', 'of all sets')} go through every decision",
        ),
        (
            "How many digits are always enough",
            f"failure is {', '.join(column('digits', 'table', 'least P without failure'))} for d from 1 to 8.",
        ),
    ]


@pytest.mark.parametrize(("section", "words"), quoted())
def test_every_figure_quoted_is_that_of_a_table(section: str, words: str) -> None:
    pages = ("studies.md", "eight-digits.md")
    text = "\n".join((ROOT / "docs" / "explanation" / page).read_text(encoding="utf-8") for page in pages)
    (found,) = [part for part in text.split("\n## ") if part.startswith(f"{section}\n")]
    assert words in " ".join(found.split())


def test_the_first_statement_of_the_table_is_the_most_frequent() -> None:
    assert column("divergence", "table", "first other decision")[0] == "program1 196+2"
    sets = [int(n) for n in column("divergence", "table", "sets")[:-1]]
    assert sets == sorted(sets, reverse=True)


@pytest.mark.parametrize("name", names())
def test_the_report_holds_every_table(name: str) -> None:
    report = (DOCS / name / "report.md").read_text(encoding="utf-8")
    for path in (DOCS / name).glob("*.csv"):
        with open(path, encoding="utf-8", newline="") as file:
            for row in csv.reader(file):
                assert "| " + " | ".join(row) + " |" in report, path


HOW_TO = (ROOT / "docs" / "how-to" / "own-study.md").read_text(encoding="utf-8")


def rows_of(head: str) -> set[str]:
    """The names in the first column of the table with that head."""
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
def test_the_how_to_has_every_key_family_and_measure(head: str, names: set[str]) -> None:
    assert rows_of(head) == names


def test_the_how_to_has_every_parameter_of_a_family() -> None:
    for name, family in FAMILIES.items():
        (line,) = re.findall(rf"^\| `{name}` \| (.*?) \|", HOW_TO, re.MULTILINE)
        taken = [one for one in signature(family).parameters if one != "draw"]
        assert sorted(re.findall(r"`(\w+)`", line)) == sorted(taken), name


def test_the_how_to_has_what_a_route_is_without_a_key() -> None:
    for made in (Programs, Port):
        for field in fields(made):
            if field.name in ("limit", "core", "arithmetic", "state", "bounds"):
                (line,) = re.findall(rf"^\| `{field.name}` \|.*", HOW_TO, re.MULTILINE)
                assert str(field.default) in line.rsplit("|", 2)[1], field.name
