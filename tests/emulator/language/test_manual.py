"""docs/reference/fortran.md, the manual of the dialect, lists the errors and foreign statements of the compiler."""

import re

import pytest

from emulator.errors import explanations
from emulator.language import foreign
from tests.support.paths import ROOT

TEXT = (ROOT / "docs" / "reference" / "fortran.md").read_text(encoding="utf-8")
WORDS = " ".join(TEXT.split())


@pytest.mark.parametrize("number", explanations())
def test_manual_explains_every_error(number: str) -> None:
    explanation = explanations()[number]
    (section,) = re.findall(rf"^### Error {number}: (.*?)(?=^### |\Z)", TEXT, re.DOTALL | re.MULTILINE)
    example = "```text\n" + "\n".join(explanation.example) + "\n```" if explanation.example else ""
    assert example in section
    remedy = f"*Remedy:* {explanation.remedy}. *Source:* {explanation.source}."
    expected = f"{explanation.title} {explanation.meaning} {example} {remedy}"
    assert " ".join(section.split()) == " ".join(expected.split())


def test_manual_lists_only_existing_errors_and_every_foreign_function() -> None:
    assert re.findall(r"^### Error (\w+):", TEXT, re.MULTILINE) == list(explanations())
    for instead, names in foreign._INSTEAD.items():
        assert f"| {', '.join(names)} | `{instead}` |" in TEXT


@pytest.mark.parametrize(
    "statement", [*foreign.FOREIGN_STATEMENTS, foreign.STATEMENT_FUNCTION], ids=lambda statement: statement.name
)
def test_manual_lists_every_foreign_statement(statement: foreign.ForeignStatement) -> None:
    assert f"| {statement.name} | {statement.origin} | {statement.replacement} |" in TEXT


@pytest.mark.parametrize("letter", foreign.FOREIGN_FIELDS)
def test_manual_lists_every_foreign_field(letter: str) -> None:
    what, instead = foreign.FOREIGN_FIELDS[letter].split("; ")
    assert f"| `{letter}` | {what} | {instead} |" in TEXT
