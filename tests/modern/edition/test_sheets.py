"""Proof sheets: every doubt about the text is on exactly one sheet, and a filled sheet changes the edition."""

import csv
import os
import re
import subprocess
import sys
from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest

from emulator.errors import EmulatorError, FileError
from emulator.language.cards import deck_from_lines
from emulator.language.statements import sources
from modern.edition import programs
from modern.edition.page_answers import Reading
from modern.edition.page_readings import read_sheet, write_state
from modern.edition.sheets import Sheet, questions, sheets, silent_readings
from modern.publication import proof_sheets
from modern.publication.numbered import numbered
from tests.support.paths import ROOT

SHEETS = sheets()
PAGE = next(sheet for sheet in SHEETS if sheet.page == "66")


def filled(sheet: Sheet = PAGE, **answers: str) -> str:
    """Return the table of a sheet with answers; an underscore in a name stands for a hyphen."""
    answers = {"reader": "A. Librarian", "date": "2027-03-31"} | {k.replace("_", "-"): v for k, v in answers.items()}
    lines = list(csv.reader(proof_sheets.table(sheet).splitlines()))
    table = [
        ",".join('"' + c.replace('"', '""') + '"' for c in (*line[:5], answers.get(line[0], ""))) for line in lines
    ]
    return "\n".join([",".join(lines[0]), *table[1:]]) + "\n"


def hull1620(*words: str) -> tuple[int, str, str]:
    """Run the command in a new process, because a state replaces the data of the package."""
    env = {**os.environ, "PYTHONPATH": str(ROOT)}
    run = subprocess.run(
        [sys.executable, "-m", "hull1620", *words],
        capture_output=True,
        text=True,
        encoding="utf-8",
        env=env,
        check=False,
    )
    return run.returncode, run.stdout, run.stderr


def test_every_silent_reading_is_on_exactly_one_sheet() -> None:
    on_sheets = Counter(key for sheet in SHEETS for item in sheet.items for key in item.variants)
    listed = Counter(f"{row['program']} {row['card']} {row['reads']}" for row in silent_readings())
    assert on_sheets == listed
    assert (sum(listed.values()), set(listed.values())) == (3012, {1})


def test_every_open_question_about_the_text_is_on_exactly_one_sheet() -> None:
    # No page answers the questions of the other sections, for example where other copies of the text are.
    about_text = [
        f"Q{item.number}" for item in numbered("fortran_src/OPEN-QUESTIONS.md")[1] if item.section == "The text"
    ]
    assert len(about_text) >= 8
    assert sorted(question.id for sheet in SHEETS for question in sheet.questions) == about_text
    rows = {row.id for name in programs.TEXTS for row in programs.text(name).rows}
    assert {row for question in questions() for row in question.rows} <= rows


def test_every_choice_is_a_card_that_reads_as_the_silent_reading() -> None:
    for sheet in SHEETS:
        for item in sheet.items:
            cards = programs.committed(item.program).cards
            assert item.choices[0].card == cards[item.card - 1].text
            for choice, key in zip(item.choices[1:], item.variants, strict=True):
                reads = key.split(" ", 2)[2]
                if not reads:
                    assert choice.card == ""
                    continue
                (source,) = sources(deck_from_lines("card", [choice.card]))
                assert source.text.rstrip() == reads.rstrip()


def test_each_item_is_once_in_the_form_and_in_the_table() -> None:
    for sheet in (SHEETS[0], PAGE, SHEETS[-1]):
        ids = [entry.id for entry in (*sheet.items, *sheet.questions)]
        boxes = re.findall(r'name="([\w-]+)" value="A"', proof_sheets.html(sheet))
        assert boxes == ids
        assert [row[0] for row in csv.reader(proof_sheets.table(sheet).splitlines())][3:] == ids
        choices = sum(len(entry.choices) + 2 for entry in (*sheet.items, *sheet.questions))
        assert proof_sheets.typst(sheet).count("#tick(") == choices


def test_a_filled_sheet_changes_the_text_and_the_confidence_without_python(tmp_path: Path) -> None:
    sheet, state = tmp_path / "page-066.csv", tmp_path / "state"
    sheet.write_text(filled(**{"1_062_1": "A", "1_064_1": "B", "1_063_1": "?", "Q24": "a"}), encoding="utf-8")
    code, out, err = hull1620("apparatus", "--sheet", str(sheet), "--state", str(state))
    assert (code, err) == (0, ""), out
    assert f"{state}: 1 confirmed, 1 unreadable, 1 changed, 1 answered" in out
    page = Path(ROOT, "docs", "how-to", "proof-sheet.md").read_text(encoding="utf-8")
    assert {*re.findall(r"^\S+ +page 66 .*$", page, re.MULTILINE)} < {*out.splitlines()}
    (answers,) = re.findall(r"^item,.*?(?=^```)", page, re.MULTILINE | re.DOTALL)
    assert [(reading.item, reading.outcome) for reading in read_sheet("answers.csv", answers)] == [
        ("1-062-1", "confirmed"),
        ("Q24", "answered"),
    ]
    assert "holds  P1-049             page: page 66, read by A. Librarian, has this card" in out
    assert re.search(r"(\d+) of \1 checks hold\n$", out)
    before, after = (Path(folder, "fortran_src", "program1.f").read_text().splitlines() for folder in (ROOT, state))
    assert [pair for pair in zip(before, after, strict=True) if pair[0] != pair[1]] == [
        ("      GO TO 124", "      GO TO 104")
    ]
    assert programs.text("program1").row("P1-039").certainty == "conjecture"
    listed = hull1620("apparatus", "--program", "1", "--layer", "lacuna", "--state", str(state))[1]
    assert re.findall(r"^P1-0(?:39|40) .*\[lacuna, conjecture, (\w+)\]$", listed, re.MULTILINE) == ["certain"] * 2
    # The answered items and the card that changed are on no sheet any more.
    again = hull1620("apparatus", "--sheets", str(tmp_path / "sheets"), "--state", str(state))[1]
    assert re.search(r"with 2\d{3} silent readings and 7 open questions", again)
    # A row whose reading of the page is altered fails.
    readings = state / "fortran_src" / "readings.csv"
    readings.write_text(readings.read_text().replace("GO TO 104", "GO TO 105"), encoding="utf-8")
    code, out, _ = hull1620("apparatus", "--check", "--program", "1", "--layer", "ocr", "--state", str(state))
    assert code == 1
    assert "FAILS  P1-049             page: page 66, read by A. Librarian, has NOT this card" in out


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ("item,answer\n", "s.csv: row 1: expected the columns item, page, card, question, choices, answer"),
        (filled(), "s.csv: no row has an answer"),
        (filled(reader="", Q24="A"), "s.csv: the row reader needs the name of the person who read the page"),
        (filled(date="March", Q24="A"), "s.csv: row 3: expected a date such as 2027-03-31, found 'March'"),
        (filled(Q24="Z"), "s.csv: row 37: expected A, B, C, ?, or = followed by the text of the page, found 'Z'"),
        (filled(Q24="A").replace("Q24", "Q99"), "s.csv: row 37: no sheet has the item 'Q99'"),
        (filled(Q24="A") + "Q24,,,,,B\n", "s.csv: row 38: item Q24 is answered twice, first in row 37"),
        (filled(**{"1_064_1": "=      GO TO #"}), "s.csv: row 16: card 1, column 13: write '=' for '#'"),
    ],
)
def test_an_error_names_the_row_of_the_sheet(table: str, message: str) -> None:
    with pytest.raises(FileError) as caught:
        read_sheet("s.csv", table)
    assert str(caught.value).startswith(message)


def test_nothing_is_written_if_a_card_does_not_fit(tmp_path: Path) -> None:
    reading = Reading("1-064-1", "66", "program1", "changed", "", "      GO TO (", "", "", "A. Librarian", "2027-03-31")
    with pytest.raises(EmulatorError):
        write_state(str(tmp_path / "state"), [reading])
    both = [replace(reading, card="      GO TO 104"), replace(reading, item="1-064-2")]
    with pytest.raises(FileError, match="items 1-064-1 and 1-064-2 change the same card"):
        write_state(str(tmp_path / "state"), both)
    assert list(tmp_path.iterdir()) == []
    (tmp_path / "notes").mkdir()
    (tmp_path / "notes" / "own.txt").touch()
    with pytest.raises(FileError, match="expected a new folder or a state of the edition"):
        write_state(str(tmp_path / "notes"), both[:1])


def test_a_second_sheet_is_added_to_the_state_and_repeated_answers_are_rejected(tmp_path: Path) -> None:
    state = str(tmp_path / "state")
    write_state(state, read_sheet("a", filled(Q24="C")))
    stored = write_state(state, read_sheet("b", filled(**{"1_064_1": "=  GO TO 124"})))
    assert [(reading.item, reading.outcome) for reading in stored] == [("Q24", "answered"), ("1-064-1", "confirmed")]
    with pytest.raises(FileError, match="item Q24 was already answered by A"):
        write_state(state, read_sheet("c", filled(Q24="A")))
    assert hull1620("apparatus", "--sheet", "missing.csv")[1:] == (
        "",
        "hull1620: --sheet needs --state FOLDER, the folder to which the changed edition is written\n",
    )


def test_the_form_saves_its_answers_as_a_table(tmp_path: Path, chromium) -> None:
    form = tmp_path / "page.html"
    form.write_text(proof_sheets.html(PAGE), encoding="utf-8")
    page = chromium.new_page()
    page.goto(form.as_uri())
    page.fill("[name=reader]", 'A. "B" Librarian')
    page.fill("[name=date]", "2027-03-31")
    page.check("[name='1-064-1'][value=B]")
    page.check("[name=Q24][value='=']")
    page.fill("[name='Q24 other']", "only I1=1")
    with page.expect_download() as download:
        page.click("button")
    text = Path(download.value.path()).read_text(encoding="utf-8")
    name = download.value.suggested_filename
    page.close()
    assert name == "proof-sheet-for-page-66.csv"
    answers = [(reading.item, reading.answer, reading.reader) for reading in read_sheet(name, text)]
    assert answers == [("1-064-1", "B", 'A. "B" Librarian'), ("Q24", "only I1=1", 'A. "B" Librarian')]
