"""Jobs for two compilers of the time: an independent reader finds each card as written, and check.py is a judge."""

import re
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest

from emulator.errors import CardError, DeckError
from emulator.language.cards import Deck, deck_from_lines, read_deck
from emulator.language.compiler import compile_deck
from emulator.objectdeck import check_job
from emulator.objectdeck.job import Compiler, Job, job
from modern.edition import programs
from modern.publication.decks import named_deck
from tests.support.paths import DATA

# What the simulator's card reader translates, from the comment on its table: digits, letters, and these.
READER = set('0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz .)+$*-/,(=@|!]}"')
DECKS = (
    *((name, f"example{n}") for name in ("program1", "program1_examples") for n in range(1, 7)),
    ("program2", "example4/punched"),
    ("program3", "example5/punched"),
    ("program3", "example6/punched"),
)
COMPILERS: tuple[Compiler, Compiler] = ("fortran2d", "pdq")
CHECK = Path(check_job.__file__)


def exported(source: Deck, data: Sequence[str], compiler: Compiler) -> Job:
    return job(source, compile_deck(source), deck_from_lines("data", data), compiler)


def on_one_line(card: str) -> str:
    """Return the number and the statement of a card of the listing, where a number may touch its statement."""
    number, statement = re.fullmatch(r" *(\d*) *(.*?) *", card[:72]).groups()
    return f"{number}:{statement}"


def read_program(cards: Sequence[str]) -> list[str]:
    """Read cards as FORTRAN II-D does: number in columns 1 to 5, continuation in column 6, statement to column 72."""
    statements: list[str] = []
    for card in cards:
        text = f"{card:<80}"
        if text[72:80].strip() == "ADDED":
            continue
        if text[0] == "C":
            statements.append(text.rstrip())
        elif text[5] not in " 0":
            statements[-1] += text[6:72]
        else:
            statements.append(f"{text[:5].strip()}:{text[6:72].lstrip()}")
    return [statement.rstrip() for statement in statements]


@pytest.mark.parametrize(("name", "deck"), DECKS)
def test_monitor_job_holds_each_card_as_written(name: str, deck: str) -> None:
    listing = [card.text for card in programs.deck(name).cards]
    data = [card.text for card in named_deck(deck).cards]
    cards = list(exported(programs.deck(name), data, "fortran2d").cards())
    first = cards.index("||FORX5") + 2
    end = next(n for n, card in enumerate(cards) if card.strip() == "END") + 1
    expected = [text if text.startswith("C  ") else on_one_line(text) for text in listing]
    assert read_program(cards[first:end]) == expected
    assert cards[end:] == [*data, "||||"]
    assert set("".join(cards)) <= READER
    assert max(map(len, cards)) <= 80


@pytest.mark.parametrize(("name", "deck"), DECKS)
def test_pdq_job_holds_each_card_as_written_except_one_jump(name: str, deck: str) -> None:
    listing = [card.text for card in programs.deck(name).cards]
    data = [card.text for card in named_deck(deck).cards]
    result = exported(programs.deck(name), data, "pdq")
    cards = [card for card in result.source if card[72:] != "ADDED"]
    pairs = [(a, b) for a, b in zip(listing, cards, strict=True) if a != b]
    jump = ("      IF (E(I))112,184,180", "      IF (E(I))112,191,180")
    assert pairs == ([jump] if name == "program2" else [])
    assert list(result.data) == data
    assert set("".join((*cards, *data))) <= READER


@pytest.mark.parametrize("path", sorted((DATA / "compiler_runs").glob("*.f")), ids=lambda path: path.stem)
def test_programs_of_the_compiler_runs_keep_their_statements(path: Path) -> None:
    deck = read_deck(path)
    texts = read_program(exported(deck, (), "fortran2d").source)
    original = read_program([card.text for card in deck.cards])
    if "c1" in path.stem:
        # Its comments contain characters that the simulator cannot read, which become blanks.
        texts, original = ([t for t in each if not t.startswith("C")] for each in (texts, original))
    assert texts == original


def test_added_cards_clear_every_array_without_a_name_or_number_of_the_program() -> None:
    text = ["      DIMENSION A(3,2),K(4),B(1)", " 9001 IZERO=1", "      PUNCH 1,K(1)", "    1 FORMAT(I4)", "      END"]
    result = exported(deck_from_lines("my.f", text), (), "fortran2d")
    added = [card[:72].rstrip() for card in result.source if card.endswith("ADDED")]
    assert added == [
        "      DO 9002 JZERO=1,3",
        "      DO 9002 KZERO=1,2",
        " 9002 A(JZERO,KZERO)=0.",
        "      DO 9003 JZERO=1,4",
        " 9003 K(JZERO)=0",
        "      B(1)=0.",
    ]
    assert result.source[0] == text[0]
    assert compile_deck(deck_from_lines("added.f", result.source))


def test_long_statement_continues_for_monitor_and_is_squeezed_or_rejected_for_pdq() -> None:
    text = ["      A=1.+2.", "     1   +3.", "      PUNCH 1,A", "    1 FORMAT(F4.0)", "      END"]
    deck = deck_from_lines("my.f", text)
    assert list(exported(deck, (), "fortran2d").source) == text
    assert exported(deck, (), "pdq").source[0] == "A=1.+2.+3."
    long = ["      A=" + "1.+" * 22, "     1 " + "1.+" * 10 + "1.", *text[2:]]
    with pytest.raises(CardError, match="PDQ FORTRAN has no continuation cards; the statement has"):
        exported(deck_from_lines("my.f", long), (), "pdq")


def test_characters_are_exchanged_and_a_deck_without_end_is_rejected() -> None:
    deck = deck_from_lines("my.f", ["      PUNCH 1", "    1 FORMAT(2HA')", "      END"])
    assert exported(deck, ("1?",), "pdq").source[1] == "    1 FORMAT(2HA@)"
    assert exported(deck, ("1?",), "pdq").data == ("1|",)
    source = programs.deck("program1")
    with pytest.raises(DeckError, match="expected an END card; found none"):
        job(Deck("my.f", source.cards[:-1]), compile_deck(source), source, "pdq")


def check(*words: str, folder: Path) -> tuple[int, str]:
    """Run check.py by itself: no project, no environment."""
    result = subprocess.run(
        [sys.executable, "-I", str(CHECK), *words], cwd=folder, capture_output=True, text=True, env={}, check=False
    )
    return result.returncode, result.stdout + result.stderr


@pytest.mark.parametrize(
    ("expected", "punched", "kind", "code"),
    [
        (" .20000000E+01   1", " .20000000E 01   1", "notation", 0),
        ("-.00000000E-99", " .00000000E-50", "sign of zero", 0),
        (" .66666666E+00", " .66666667E+00", "last digits", 0),
        (" .66666666E+00", " .66666766E+00", "other", 1),
        (" .66666666E+00", "-.66666666E+00", "other", 1),
        ("   1   2", "   1   3", "other", 1),
        ("VERTICES", "VERTICE", "other", 1),
        ("VERTICES", "", "other", 1),
    ],
)
def test_check_names_the_class_of_a_difference(tmp_path, expected, punched, kind, code) -> None:
    (tmp_path / "a").write_text(f"SAME\n{expected}\n", encoding="ascii")
    (tmp_path / "b").write_text(f"SAME\n{punched}\n", encoding="ascii")
    status, report = check("compare", "a", "b", folder=tmp_path)
    assert (status, f"1 {kind}: " in report) == (code, True), report
    assert "2 cards expected, 2 punched, 1 equal" in report


def test_check_reports_cards_in_another_order_and_missing_cards(tmp_path: Path) -> None:
    for name, text in (("a", "ONE\nTWO\n"), ("b", "TWO\nONE\n"), ("c", "ONE\n"), ("none", "")):
        (tmp_path / name).write_text(text, encoding="ascii")
    assert check("compare", "a", "a", folder=tmp_path) == (0, "2 cards expected, 2 punched, 2 equal\n")
    status, report = check("compare", "a", "b", folder=tmp_path)
    assert (status, "2 order: " in report) == (1, True)
    assert check("compare", "a", "c", folder=tmp_path)[0] == 1
    assert check("compare", "none", "none", folder=tmp_path)[0] == 1
    status, report = check("compare", "a", "missing", folder=tmp_path)
    assert (status, report.count("\n"), "missing" in report) == (2, 1, True)


def test_check_joins_decks_and_converts_a_disk(tmp_path: Path) -> None:
    (tmp_path / "a").write_text("ONE  \n", encoding="ascii")
    (tmp_path / "b").write_text("TWO", encoding="ascii")
    assert check("join", "c", "a", "b", folder=tmp_path)[0] == 0
    assert (tmp_path / "c").read_text(encoding="ascii") == "ONE\nTWO\n"
    first, zeros = "019|@}]JR!".ljust(105, "0"), "0" * 105
    (tmp_path / "pack").write_text(f"    0,{first}\n    1,{zeros}\n", encoding="ascii")
    assert check("disk", "pack", "dsk", folder=tmp_path)[0] == 0
    assert (tmp_path / "dsk").read_bytes() == bytes([0, 1, 9, 10, 12, 15, 16, 17, 25, 26]).ljust(210, b"\0")
    for line, message in (
        ("    1,0x9" + zeros[3:], ", column 8: invalid digit 'x'"),
        ("    1 019", ": expected a sector number, a comma and 105 digits"),
        ("    1,019", ": expected 105 digits, found 3; a line is truncated, or two are joined"),
        (f"    1,{zeros}0", ": expected 105 digits, found 106; a line is truncated, or two are joined"),
        (f"    2,{zeros}", ": expected sector 1, found 2; a sector is lost or moved"),
        (f"    0,{zeros}", ": expected sector 1, found 0; a sector is lost or moved"),
    ):
        (tmp_path / "pack").write_text(f"    0,{zeros}\n\n{line}\n", encoding="ascii")
        assert check("disk", "pack", "bad", folder=tmp_path) == (2, f"check.py disk: pack, line 3{message}\n")
        assert not (tmp_path / "bad").exists()
    assert check(folder=tmp_path)[0] == 2
