"""What a row of an apparatus owes its reader is checked when it is read (fortran_src/README.md)."""

from __future__ import annotations

from pathlib import Path

import pytest

from modern.edition.apparatus import ApparatusError, Text, load

TEXT = """
[text]
id = "t"
title = "T"
witness = "w.txt"
layers = ["ocr"]
default = ["ocr"]
"""
FIELDS = {
    "id": '"T-001"',
    "page": '"64"',
    "card": '"101"',
    "layer": '"ocr"',
    "kind": '"misread"',
    "certainty": '"certain"',
    "reason": '"r"',
    "evidence": '"e"',
    "change": '[{ line = "1", witness = "l", lemma = "1" }]',
}
"""The fields of a row, as TOML."""


def read(folder: Path, **fields: str | None) -> Text:
    """A text of one row whose fields are those above but for the ones given; None leaves a field out."""
    row = "".join(f"{name} = {value}\n" for name, value in {**FIELDS, **fields}.items() if value is not None)
    (folder / "w.txt").write_text("## page 64\n  10l A=B\n")
    (folder / "t.toml").write_text(f"{TEXT}[[row]]\n{row}")
    return load(folder, "t")


@pytest.mark.parametrize("certainty", ["certain", "probable", "conjecture"])
def test_a_row_is_certain_probable_or_a_conjecture(tmp_path: Path, certainty: str) -> None:
    """The three of fortran_src/README.md; the row keeps the word."""
    assert read(tmp_path, certainty=f'"{certainty}"').row("T-001").certainty == certainty


@pytest.mark.parametrize(
    "certainty", ["sure", "", "cert", "Certain", " certain", "certain, probable", "CONJECTURE", "conjectured"]
)
def test_another_certainty_is_refused(tmp_path: Path, certainty: str) -> None:
    """The message names text, row and what may stand there."""
    with pytest.raises(ApparatusError) as caught:
        read(tmp_path, certainty=f'"{certainty}"')
    assert str(caught.value) == "t: row T-001: certainty is one of certain, probable, conjecture"


@pytest.mark.parametrize("certainty", ["1", "true", '["certain"]'])
def test_a_certainty_that_is_no_word_is_refused(tmp_path: Path, certainty: str) -> None:
    with pytest.raises(ApparatusError, match="row T-001: certainty is one of"):
        read(tmp_path, certainty=certainty)


@pytest.mark.parametrize("name", FIELDS)
def test_a_row_without_one_of_its_fields_is_refused(tmp_path: Path, name: str) -> None:
    row = "(without id)" if name == "id" else "T-001"
    with pytest.raises(ApparatusError) as caught:
        read(tmp_path, **{name: None})
    assert str(caught.value) == f"t: row {row} lacks {name}"


def test_every_field_that_is_missing_is_named(tmp_path: Path) -> None:
    with pytest.raises(ApparatusError, match=r"^t: row T-001 lacks page, certainty$"):
        read(tmp_path, page=None, certainty=None)
