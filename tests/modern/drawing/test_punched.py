"""Decks drawn as punched cards: holes compared with a list of the 026's code, sizes with the standard, text, errors."""

import re
from fractions import Fraction
from pathlib import Path
from xml.etree import ElementTree

import pytest
from hypothesis import given
from hypothesis import strategies as st

from emulator.errors import CardError, DeckError
from emulator.language.cards import COLUMNS, PUNCHES, RECORD_MARK, RECORD_MARKS, deck_from_lines
from modern.cli.main import main
from modern.drawing.punched import HEIGHT, MOST_CARDS, ROWS, WIDTH, cards_svg
from modern.edition import programs
from tests.support.paths import DATA

SVG = "{http://www.w3.org/2000/svg}"
INCH = 96
"""An inch in pixels."""
CODE = [
    line.split("\t") for line in (DATA / "punches_026.tsv").read_text(encoding="ascii").splitlines() if line[:2] != "# "
]
HOLE = re.compile(r"M([\d.]+) ([\d.]+)h([\d.]+)v([\d.]+)h-([\d.]+)z")


def cards(svg: str) -> list[ElementTree.Element]:
    return [group for group in ElementTree.fromstring(svg).iter(f"{SVG}g") if group.get("class") == "card"]


def holes(card: ElementTree.Element) -> list[tuple[Fraction, Fraction, Fraction, Fraction]]:
    """Return left edge, top edge, width and height of every hole, in inches."""
    drawn = "".join(path.get("d", "") for path in card.iter(f"{SVG}path"))
    matches = HOLE.findall(drawn)
    assert HOLE.sub("", drawn) == ""
    assert all(wide == back for _, _, wide, _, back in matches)
    return [tuple(Fraction(number) / INCH for number in hole[:4]) for hole in matches]


def read(card: ElementTree.Element) -> str:
    """Read the characters of a card from its holes, with a column every .087 inch and a row every .25 inch."""
    rows_by_column: dict[int, set[str]] = {}
    for left, top, width, height in holes(card):
        column = (left + width / 2 - Fraction(251, 1000)) / Fraction(87, 1000) + 1
        row = (top + height / 2) / Fraction(1, 4) - 1
        assert abs(column - round(column)) < Fraction(1, 50)
        assert row == round(row)
        rows_by_column.setdefault(round(column), set()).add(ROWS[int(row)])
    by_holes = {frozenset(rows.split("-")): sign for sign, rows, _ in [*CODE, (RECORD_MARKS[0], "0-2-8", "")]}
    return "".join(
        by_holes[frozenset(rows_by_column[k])] if k in rows_by_column else " "
        for k in range(1, max(rows_by_column, default=0) + 1)
    )


def words(card: ElementTree.Element) -> list[str]:
    return [text.text or "" for text in card.iter(f"{SVG}text")]


def test_punches_are_the_code_of_the_026() -> None:
    """The code has 48 characters with the blank. The graphic @ has the holes of the apostrophe. A 1620 adds 0-2-8."""
    listed = {sign: set(rows.split("-")) for sign, rows, _ in CODE}
    assert len(listed) == 47
    assert {sign: set(code.split("-")) for sign, code in PUNCHES.items() if sign not in f" @{RECORD_MARKS}"} == listed
    assert PUNCHES["@"] == PUNCHES["'"]
    assert PUNCHES[" "] == ""
    assert {PUNCHES[mark] for mark in RECORD_MARKS} == {"0-2-8"}
    assert set("+-*/()=.,$") < set(listed), "the signs of FORTRAN"
    for _, rows, column in CODE:
        assert len(column) == 12
        assert {ROWS[k] for k, mark in enumerate(column) if mark == "o"} == set(rows.split("-"))


@pytest.mark.parametrize(("sign", "rows", "column"), CODE)
def test_every_character_has_its_holes(sign: str, rows: str, column: str) -> None:
    (card,) = cards(cards_svg(deck_from_lines("deck", [sign])))
    assert read(card) == sign
    assert len(holes(card)) == column.count("o")


def test_card_has_the_proportions_of_the_standard() -> None:
    """7 3/8 by 3 1/4 inches. Holes .055 by .125. Margins of column 1, column 80, row 12 and row 9 (ANSI X3.21)."""
    assert Fraction(WIDTH, INCH) == Fraction(59, 8)
    assert Fraction(HEIGHT, INCH) == Fraction(13, 4)
    (card,) = cards(cards_svg(deck_from_lines("deck", ["A" + " " * 78 + "9"])))
    first, _, last = sorted(holes(card))
    assert first[2:] == (Fraction(55, 1000), Fraction(125, 1000))
    assert abs(first[0] + first[2] / 2 - Fraction(251, 1000)) < Fraction(1, 1000)
    assert abs(Fraction(59, 8) - (last[0] + last[2] / 2) - Fraction(251, 1000)) < Fraction(1, 1000)
    assert {hole[1] + hole[3] / 2 for hole in holes(card)} == {Fraction(1, 4), Fraction(1), Fraction(3)}


@given(st.lists(st.text(st.sampled_from(sorted(set(PUNCHES) - {"@"})), max_size=COLUMNS), min_size=1, max_size=4))
def test_holes_and_characters_reproduce_the_deck(lines: list[str]) -> None:
    drawn = cards(cards_svg(deck_from_lines("deck", lines)))
    assert [read(card) for card in drawn] == [RECORD_MARK.sub(RECORD_MARKS[0], line).rstrip(" ") for line in lines]
    assert ["".join(words(card)) for card in drawn] == [line.rstrip(" ") for line in lines]
    for card, line in zip(drawn, lines, strict=True):
        for text in card.iter(f"{SVG}text"):
            assert len(text.get("x", "").split()) == len(line.rstrip(" "))
            assert text.get("{http://www.w3.org/XML/1998/namespace}space") == "preserve"


def test_characters_without_a_punch_and_more_than_a_box_are_refused() -> None:
    deck = deck_from_lines("deck.f", ["A=1", "C  what? #1"])
    with pytest.raises(CardError, match=r"^deck\.f: card 2, column 4: 'w' is not in the card code"):
        cards_svg(deck)
    with pytest.raises(DeckError, match=f"expected at most {MOST_CARDS} cards for one picture, found {MOST_CARDS + 1}"):
        cards_svg(deck_from_lines("deck", ["1"] * (MOST_CARDS + 1)))


@pytest.fixture
def deck(tmp_path: Path, monkeypatch) -> Path:
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "my.deck"
    path.write_text("  3\n 1.5\n\nEND\n", encoding="ascii")
    return path


def test_command_writes_one_picture_or_one_for_each_card(deck: Path, capsys) -> None:
    assert main(["punched", "my.deck", "-o", "cards.svg", "--across", "2"]) == 0
    drawn = cards(Path("cards.svg").read_text(encoding="ascii"))
    assert [read(card) for card in drawn] == ["  3", " 1.5", "", "END"]
    assert main(["punched", "my.deck", "-o", "card-%02d.svg"]) == 0
    names = sorted(path.name for path in Path().glob("card-*.svg"))
    assert names == ["card-01.svg", "card-02.svg", "card-03.svg", "card-04.svg"]
    text = Path("card-04.svg").read_text(encoding="ascii")
    assert [read(card) for card in cards(text)] == ["END"]
    assert "<title>my.deck: card 4</title>" in text
    assert main(["punched", "program2"]) == 0
    drawn = cards(capsys.readouterr().out)
    assert [read(card) for card in drawn] == [card.text for card in programs.deck("program2").cards]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["my.deck", "--across", "0"], "--across: expected at least 1 card, found 0"),
        (
            ["my.deck", "-o", "card-%s.svg"],
            "--output: 'card-%s.svg' has no place for a number; write a name such as 'card-%03d.svg'",
        ),
        (
            ["my.deck", "-o", "%d-%d.svg"],
            "--output: '%d-%d.svg' has no place for a number; write a name such as 'card-%03d.svg'",
        ),
        (["my.deck", "-o", "no/%d.svg"], "no/%d.svg: no such file or directory"),
        (
            ["small.f", "-o", "%d.svg"],
            ("small.f: card 2, column 4: 'x' is not in the card code, which has only capital letters"),
        ),
        (["none.deck"], "none.deck: no such file or directory"),
    ],
)
def test_punched_command_reports_errors_in_one_line(deck: Path, capsys, arguments: list[str], message: str) -> None:
    Path("small.f").write_text("A=1\nC  x\n", encoding="ascii")
    assert main(["punched", *arguments]) == 2
    assert capsys.readouterr().err == f"hull1620: {message}\n"
    assert list(Path().glob("**/*.svg")) == []
