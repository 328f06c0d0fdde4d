"""The committed results of the built-in studies belong to their current plans, at the default size."""

import csv
import json
import re
from dataclasses import fields
from inspect import signature

import pytest

from emulator.language.cards import Deck, deck_from_text
from emulator.machine.result import Options
from emulator.machine.timing import measure
from emulator.numbers import numbers
from modern.edition.chapter6 import input_deck
from modern.edition.programs import with_layers
from modern.study.builtin import names, study
from modern.study.families import FAMILIES
from modern.study.measures import MEASURES
from modern.study.plan import Port, Programs
from modern.study.report import unbroken
from modern.study.tomlplan import _CELL, _HEAD
from modern.thesis.job import run_hull
from tests.support.paths import ROOT


def machine_deck(name: str) -> Deck:
    folder = ROOT / "tests" / "data" / "machine_runs" / name
    return deck_from_text(name, (folder / "deck.cards").read_text(encoding="ascii"))


DOCS = ROOT / "docs" / "studies"


@pytest.mark.parametrize("name", names())
def test_committed_manifest_agrees_with_the_default_plan(name: str) -> None:
    manifest = json.loads((DOCS / name / "manifest.json").read_text(encoding="utf-8"))
    module = study(name)
    assert manifest["complete"] is True
    assert manifest["plan"] == module.plan(module.SAMPLES, 1963).document()


SECTIONS = ("seventy", "rounding", "epsilon", "translation", "capacity, machine-time, divergence", "alarms")


@pytest.mark.parametrize("section", SECTIONS)
def test_intervals_quoted_in_the_explanation_are_those_of_the_tables(section: str) -> None:
    text = (ROOT / "docs" / "explanation" / "studies.md").read_text(encoding="utf-8")
    (paragraphs,) = [part for part in text.split("\n## ") if part.startswith(f"{section}\n")]
    text = re.sub(r"^\|.*$", "", paragraphs, flags=re.MULTILINE)
    intervals = re.findall(r"-?[\d.]+ \(-?[\d.]+ to -?[\d.]+\)(?: %)?", " ".join(text.split()))
    tables = [path.read_text(encoding="utf-8") for name in section.split(", ") for path in (DOCS / name).glob("*.csv")]
    assert intervals
    assert [interval for interval in intervals if not any(interval in table for table in tables)] == []


MOVED = {
    "example 4": ("costs {} of the seconds in example 4", input_deck(4)),
    "example 5": ("and {} in example 5", input_deck(5)),
    "example 6": ("It saves {} in example 6", input_deck(6)),
    "points near a sphere": ("{} for the points near a sphere", machine_deck("25_sphere_int_n20")),
    "random points": ("{} for the random points", machine_deck("12_randint_n40_a99")),
}


@pytest.mark.parametrize("name", MOVED)
def test_times_of_the_moved_origin_are_those_of_the_programs(name: str) -> None:
    """The table by hand: operations and processor seconds of the last program, without and with the translation."""
    sentence, deck = MOVED[name]
    text = (ROOT / "docs" / "explanation" / "studies.md").read_text(encoding="utf-8")
    (table,) = re.findall(rf"^\| {name} ?[(,].*\n.*$", text, re.MULTILINE)
    versions = {"as given": ("corrected",), "moved": ("corrected", "translation")}
    times = []
    for (origin, layers), line in zip(versions.items(), table.splitlines(), strict=True):
        options = Options(numbers("truncating:16"), core=60_000)
        step = run_hull(deck, lambda program, layers=layers: with_layers(program, layers), options).steps[-1]
        measured = measure(step.program, step.result)
        operations = dict(measured.operations)
        additions = sum(operations.get(code, 0) for code in ("FAD", "FSB", "FSBR"))
        seconds = measured.processor_time.seconds
        low, high = map(float, measured.processor_time.interval.split(" to "))
        form = ",.0f" if seconds >= 1000 else ".1f"
        shown = f"{seconds:{form}} ({low:{form}} to {high:{form}})"
        assert line.endswith(f"| {origin} | {additions:,} | {operations['FMP']:,} | {shown} |")
        times.append(seconds)
    share = f"{100 * abs(times[0] - times[1]) / times[0]:.1f} %"
    assert sentence.format(share) in " ".join(text.split())
    assert (times[1] > times[0]) == (name in ("example 4", "example 5"))


@pytest.mark.parametrize("name", names())
def test_report_contains_every_table(name: str) -> None:
    report = (DOCS / name / "report.md").read_text(encoding="utf-8")
    for path in (DOCS / name).glob("*.csv"):
        with open(path, encoding="utf-8", newline="") as file:
            for row in csv.reader(file):
                assert "| " + " | ".join(map(unbroken, row)) + " |" in report, path
    finding = report.split("\n\n")[1]
    assert len(re.findall(r"\d", finding)) > 1, "a report begins with its finding"
    assert not re.search(r"\d\^|\(\S+ to ", report), "powers are raised, and intervals are not broken"


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


def test_how_to_describes_parameters_and_defaults() -> None:
    for name, family in FAMILIES.items():
        (line,) = re.findall(rf"^\| `{name}` \| (.*?) \|", HOW_TO, re.MULTILINE)
        parameters = [parameter for parameter in signature(family).parameters if parameter != "draw"]
        assert sorted(re.findall(r"`(\w+)`", line)) == sorted(parameters), name
    for made in (Programs, Port):
        for field in fields(made):
            if field.name in ("limit", "core", "arithmetic", "state", "bounds"):
                (line,) = re.findall(rf"^\| `{field.name}` \|.*", HOW_TO, re.MULTILINE)
                assert str(field.default) in line.rsplit("|", 2)[1], field.name
