"""The executable apparatus: witness plus rows builds the decks, and every row is needed."""

from __future__ import annotations

import hashlib
import re
import tomllib
from dataclasses import replace
from pathlib import Path

import pytest

from modern.edition import programs
from modern.edition.apparatus import ApparatusError, Row, build, load
from modern.edition.grounds import check_decks, check_row

ROWS = [row for name in programs.TEXTS for row in programs.text(name).rows]
SOURCES = programs.sources()


@pytest.mark.parametrize("name", programs.NAMES)
def test_committed_deck_is_witness_and_rows(name: str) -> None:
    assert programs.committed(name).text() == programs.built(name).text()


@pytest.mark.parametrize("name", programs.TEXTS)
def test_witness_is_untouched(name: str) -> None:
    """The witness without our page marks has the hash taken of the OCR text."""
    head = tomllib.loads(SOURCES.joinpath("apparatus", f"{name}.toml").read_text(encoding="utf-8"))["text"]
    text = SOURCES.joinpath("witness", f"{name}.txt").read_text(encoding="utf-8")
    kept = "".join(line for line in text.splitlines(keepends=True) if not line.startswith("## page "))
    assert hashlib.sha256(kept.encode()).hexdigest() == head["witness_sha256"]


@pytest.mark.parametrize(("name", "first", "last"), [("program1", 64, 74), ("program2", 79, 87), ("program3", 93, 102)])
def test_every_page_is_marked(name: str, first: int, last: int) -> None:
    text = SOURCES.joinpath("witness", f"{name}.txt").read_text(encoding="utf-8")
    assert [int(n) for n in re.findall(r"^## page (\d+)$", text, re.M)] == list(range(first, last + 1))


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.id)
def test_row_is_needed(row: Row) -> None:
    finding = check_row(row)
    assert finding.holds, finding.words


def test_rows_name_their_page_as_the_witness_has_it() -> None:
    pages = {name: {line.id: line.page for line in programs.text(name).witness} for name in programs.TEXTS}
    for row in ROWS:
        first = row.changes[0].line
        if first in pages[row.text] and "-" not in row.page:
            assert pages[row.text][first] == row.page, row.id


def test_splitting_the_fused_page_changes_only_spacing() -> None:
    row = next(row for row in ROWS if row.text == "program1" and row.kind == "fused")
    (change,) = row.changes
    assert "".join(change.witness.split()) == "".join(change.lemma.split())


def test_the_counts_in_the_readme_are_those_of_the_rows() -> None:
    text = SOURCES.joinpath("README.md").read_text(encoding="utf-8")
    misread = [row for row in ROWS if row.kind == "misread" and row.layer == "ocr"]
    parse = sum(row.ground["kind"] == "parse" for row in misread)
    assert f"in {len(misread)} places" in text
    assert f"gives away {parse} of the {len(misread)}; {len(misread) - parse} left" in text


# Guards: each kind of claim fails where it is false.


def superfluous(ground: dict[str, object], row_id: str = "P1-038") -> Row:
    return replace(programs.text("program1").row(row_id), ground=ground)


FALSE_CLAIMS = [
    ("P1-043", {"kind": "parse"}),
    ("P1-038", {"kind": "cosmetic"}),
    ("P1-038", {"kind": "print", "program": "program1", "examples": [3]}),
    ("P1-038", {"kind": "print", "program": "program1", "examples": []}),
    ("P1-018", {"kind": "print", "program": "program1", "examples": [2]}),
    ("P1-043", {"kind": "deck", "program": "program1", "deck": "example1"}),
    ("P1-039", {"kind": "deck", "program": "program1", "deck": "nosuch"}),
    ("P1-018", {"kind": "forced", "card": "125+1", "sibling": "125+3", "rename": ["O3", "O1"]}),
    ("P1-038", {"kind": "forced", "card": "125+1", "sibling": "125+3", "rename": ["O3", "O1", "X", "Y", "Y", "Z"]}),
    ("P1-038", {"kind": "because"}),
    ("P1-038", {}),
]


@pytest.mark.parametrize(("row_id", "ground"), FALSE_CLAIMS, ids=[f"{r}-{g.get('kind')}" for r, g in FALSE_CLAIMS])
def test_a_false_ground_fails(row_id: str, ground: dict[str, object]) -> None:
    assert not check_row(superfluous(ground, row_id)).holds


def test_check_of_decks_covers_all_four() -> None:
    findings = list(check_decks())
    assert [f.subject for f in findings] == [f"{name}.f" for name in programs.NAMES]
    assert all(f.holds for f in findings)


# The mechanism itself, on a text of three lines.

WITNESS = "## page 1\nalpha l\n\nbeta\n```\n## page 2\n  12 gamma\n"
HEAD = '[text]\nid = "t"\ntitle = "t"\nwitness = "w.txt"\nfurniture = ["```"]\nlayers = ["a", "b"]\ndefault = ["a"]\n'
ROW = (
    '[[row]]\nid = "{id}"\npage = "1"\ncard = "1"\nlayer = "{layer}"\nkind = "k"\ncertainty = "certain"\n'
    'reason = "r"\nevidence = "e"\nchange = [{change}]\n'
)


def text_of(tmp_path: Path, *rows: tuple[str, str, str]) -> Path:
    (tmp_path / "w.txt").write_text(WITNESS)
    body = "".join(ROW.format(id=i, layer=layer, change=change) for i, layer, change in rows)
    (tmp_path / "t.toml").write_text(HEAD + body)
    return tmp_path


def built(folder: Path, *layers: str) -> list[tuple[str, str, str]]:
    return [(line.id, line.text, line.page) for line in build(load(folder, "t"), layers or None)]


def test_lines_are_numbered_without_page_marks(tmp_path: Path) -> None:
    assert built(text_of(tmp_path)) == [("1", "alpha l", "1"), ("3", "beta", "1"), ("5", "  12 gamma", "2")]


def test_changes_of_each_form(tmp_path: Path) -> None:
    folder = text_of(
        tmp_path,
        ("r1", "a", '{ line = "1", witness = " l", lemma = " 1\\ntwo" }'),
        ("r2", "a", '{ line = "3", after = true, lemma = "new" }'),
        ("r3", "b", '{ line = "r2.1", witness = "new", lemma = "newer" }'),
        ("r4", "a", '{ line = "5", through = "5", form = true }'),
    )
    words = ["alpha 1", "two", "beta", "new", "   12 gamma"]
    assert [text for _, text, _ in built(folder)] == words
    assert [text for _, text, _ in built(folder, "a", "b")] == [*words[:3], "newer", words[4]]


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        ([("r", "a", '{ line = "1", witness = "nope", lemma = "" }')], "stands 0 times"),
        ([("r", "a", '{ line = "1", witness = "a", lemma = "" }')], "stands 2 times"),
        ([("r", "a", '{ line = "2", witness = "a", lemma = "" }')], "there is no line 2"),
        ([("r", "c", '{ line = "1", witness = "a", lemma = "" }')], "is of layer 'c'"),
        ([("r", "a", '{ line = "1", lemma = "x" }')], "needs a witness reading"),
        ([("r", "a", '{ line = "1", witness = " l", lemma = "" }')] * 2, "stands twice"),
    ],
)
def test_a_row_that_does_not_fit_is_refused(tmp_path: Path, rows: list[tuple[str, str, str]], message: str) -> None:
    with pytest.raises(ApparatusError, match=message):
        built(text_of(tmp_path, *rows))


def test_unknown_layer_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ApparatusError, match="has no layer z; it has a, b"):
        built(text_of(tmp_path), "z")
