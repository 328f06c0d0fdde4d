"""The committed results of the built-in studies belong to the studies as they stand, at their default size."""

from __future__ import annotations

import json
import re

import pytest

from modern.study.registry import names, study
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
