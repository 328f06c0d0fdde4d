"""The fields of an apparatus row are checked when the row is read (fortran_src/README.md)."""

from pathlib import Path

import pytest

from modern.claims import apparatus_checks
from modern.claims.apparatus_checks import check_everything
from modern.edition import programs
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
    "layer": '"ocr"',
    "kind": '"misread"',
    "reason": '"r"',
    "evidence": '"e"',
    "change": '[{ line = "1", witness = "l", lemma = "1" }]',
}
"""The fields of a row, as TOML."""


def read(folder: Path, **fields: str | None) -> Text:
    """Return a text of one row with some of the fields above replaced; None removes a field."""
    row = "".join(f"{name} = {value}\n" for name, value in {**FIELDS, **fields}.items() if value is not None)
    (folder / "w.txt").write_text("## page 64\n  10l A=B\n")
    (folder / "t.toml").write_text(f"{TEXT}[[row]]\n{row}")
    return load(folder, "t")


@pytest.mark.parametrize("name", ["page", "card", "certainty", "witness"])
def test_derived_fields_cannot_be_stored(tmp_path: Path, name: str) -> None:
    with pytest.raises(ApparatusError, match=f"^t: row T-001 has the unknown field {name}$"):
        read(tmp_path, **{name: '"certain"'})


@pytest.mark.parametrize(
    ("fields", "certainty"),
    [
        ({}, "conjecture"),
        ({"ground": '{ kind = "parse" }'}, "certain"),
        ({"ground": '{ kind = "parse" }', "cause": '"undecidable"'}, "probable"),
        ({"ground": '{ kind = "forced" }'}, "probable"),
        ({"ground": '{ kind = "forced", equation = ["125+1", "226"] }'}, "certain"),
        ({"ground": '{ kind = "sibling" }'}, "certain"),
        ({"ground": '{ kind = "sibling" }', "kind": '"lost"'}, "probable"),
        ({"ground": '{ kind = "order", whole = true }', "kind": '"lost"'}, "probable"),
        ({"ground": '{ kind = "order" }', "kind": '"lost"'}, "certain"),
    ],
)
def test_certainty_follows_from_layer_kind_and_ground(tmp_path: Path, fields: dict[str, str], certainty: str) -> None:
    """The rules of fortran_src/README.md."""
    assert read(tmp_path, **fields).row("T-001").certainty == certainty


def test_derived_fields_and_rejected_readings_are_read(tmp_path: Path) -> None:
    assert read(tmp_path).row("T-001").page == "64"
    assert read(tmp_path).row("T-001").cause == "ocr"
    with pytest.raises(ApparatusError, match=r"expected one of ocr, typist, author, editor, undecidable$"):
        read(tmp_path, cause='"chance"')
    (rejected,) = read(tmp_path, rdg='[{ reading = "I", reason = "r" }]').row("T-001").rejected
    assert (rejected.reading, rejected.reason) == ("I", "r")
    with pytest.raises(ApparatusError, match="a rejected reading needs a reading and a reason"):
        read(tmp_path, rdg='[{ reading = "I" }]')
    with pytest.raises(ApparatusError, match=r"^t: row T-001 lacks reason, evidence$"):
        read(tmp_path, reason=None, evidence=None)


@pytest.mark.parametrize("name", FIELDS)
def test_a_row_without_one_of_its_fields_is_rejected(tmp_path: Path, name: str) -> None:
    row = "(without id)" if name == "id" else "T-001"
    with pytest.raises(ApparatusError) as caught:
        read(tmp_path, **{name: None})
    assert str(caught.value) == f"t: row {row} lacks {name}"


def test_several_processes_return_the_same_proofs_in_the_same_order(monkeypatch) -> None:
    monkeypatch.setattr(apparatus_checks, "_MANY", 1)
    rows = [row for name in programs.TEXTS for row in programs.text(name).rows if row.ground.get("kind") == "parse"]
    rows = rows[: apparatus_checks._CHUNK + 1]
    alone = list(check_everything(rows, True))
    first = [proof.subject for proof in alone].index(rows[0].id)
    assert [proof.subject for proof in alone[first : first + len(rows)]] == [row.id for row in rows]
    assert list(check_everything(rows, True, workers=2)) == alone
