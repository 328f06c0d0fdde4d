"""Cards: the code of the reference card X26-5743-2 p. 4, and decks read from and written to files."""

import io
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from emulator.errors import CardError, DeckError, FileError
from emulator.language import cards
from emulator.language.cards import CHARACTERS, PUNCHES, RECORD_MARKS, Card, deck_from_lines, deck_from_text, read_deck

texts = st.text(st.sampled_from(sorted(CHARACTERS)), max_size=80)


@pytest.mark.parametrize(
    ("characters", "zone", "first"), [("ABCDEFGHI", "12-", 1), ("JKLMNOPQR", "11-", 1), ("STUVWXYZ", "0-", 2)]
)
def test_letters_of_the_reference_card(characters: str, zone: str, first: int) -> None:
    assert [PUNCHES[c] for c in characters] == [f"{zone}{i}" for i, _ in enumerate(characters, first)]


def test_digits_and_signs_of_the_reference_card() -> None:
    assert [PUNCHES[str(d)] for d in range(10)] == [str(d) for d in range(10)]
    signs = {
        " ": "",
        ".": "12-3-8",
        ")": "12-4-8",
        "+": "12",
        "$": "11-3-8",
        "*": "11-4-8",
        "-": "11",
        "/": "0-1",
        ",": "0-3-8",
        "(": "0-4-8",
        "=": "3-8",
        "@": "4-8",
    }
    assert {c: PUNCHES[c] for c in signs} == signs


def test_only_the_quote_and_the_record_mark_share_their_punches_with_other_characters() -> None:
    """The 026's H keyboard prints the punches 4-8 as a quote, and the reference card prints them as @."""
    shared = {c for c in PUNCHES if list(PUNCHES.values()).count(PUNCHES[c]) > 1}
    assert shared == {"@", "'", *RECORD_MARKS}
    assert len(PUNCHES) == 52


def test_cards_and_decks_have_a_limited_size() -> None:
    card = Card(1, "AB")
    assert card.columns(1, 3) == "AB "
    assert card.columns(80, 80) == " "
    assert deck_from_lines("x", ["A" * 80 + "   "]).cards[0].text == "A" * 80
    with pytest.raises(CardError, match="x: card 1, column 81: a card has 80 columns; this line has 81"):
        deck_from_lines("x", ["A" * 81])
    with pytest.raises(DeckError, match="expected at most 100000 cards, found 100001"):
        deck_from_text("x", "\n" * (cards.MAX_CARDS + 1))
    assert len(deck_from_text("x", "\n" * cards.MAX_CARDS).cards) == cards.MAX_CARDS


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        ("A\nB\n", ["A", "B"]),
        ("A\r\nB\r\n", ["A", "B"]),
        ("A\nB", ["A", "B"]),
        ("A  \n\nB\n", ["A", "", "B"]),
        ("A\n\n", ["A", ""]),
        ("", []),
    ],
)
def test_deck_from_text(text: str, lines: list[str]) -> None:
    deck = deck_from_text("x", text)
    assert [card.text for card in deck.cards] == lines
    assert [card.number for card in deck.cards] == list(range(1, len(lines) + 1))


@pytest.mark.parametrize(
    ("line", "column", "words"),
    [
        ("X=#", 3, "write '=' for '#', the character of a commercial card punch with the same holes"),
        ("%A)", 1, "write '(' for '%'"),
        ("A&B", 2, "write '+' for '&'"),
        ("A\u2311", 2, "write ')' for '\u2311'"),
        ("AbC", 2, "only capital letters"),
        ("A\tB", 2, "character 0x09 is not in the card code"),
        ("A\rB", 2, "character 0x0d"),
        ("A\u00e9", 2, "which has only capital letters' or 'not in the card code"),
        ("A;", 2, "';' is not in the card code"),
        ("A\u221212", 2, "is not in the card code"),
        ("\ufeffA", 1, "is not in the card code"),
        ("A\x1a", 2, "character 0x1a"),
    ],
    ids=ascii,
)
def test_invalid_character_is_reported_with_card_and_column(line: str, column: int, words: str) -> None:
    with pytest.raises(CardError) as caught:
        deck_from_lines("my.deck", ["A", line])
    assert str(caught.value).startswith(f"my.deck: card 2, column {column}: ")
    assert any(part in str(caught.value) for part in words.split("' or '"))
    assert (caught.value.source, caught.value.card, caught.value.column) == ("my.deck", 2, column)


@given(st.lists(texts, max_size=20))
def test_round_trip_through_text(lines: list[str]) -> None:
    deck = deck_from_lines("x", lines)
    assert [card.text for card in deck.cards] == [line.rstrip(" ") for line in lines]
    assert deck_from_text("x", deck.text()) == deck
    assert deck_from_text("x", deck.text().replace("\n", "\r\n")) == deck


@given(st.text(max_size=100))
def test_any_text_gives_a_deck_or_a_card_error(text: str) -> None:
    lines = text.replace("\r\n", "\n").split("\n")
    read = [(n, line) for n, line in enumerate(lines, 1) if not line.startswith("C")]  # a comment holds anything
    strange = [(n, c) for n, line in read for c, char in enumerate(line, 1) if char not in CHARACTERS]
    if not strange and all(len(line.rstrip(" ")) <= 80 for line in lines):
        assert [card.text for card in deck_from_text("x", text + "\n").cards] == [line.rstrip(" ") for line in lines]
        return
    with pytest.raises(CardError) as caught:
        deck_from_text("x", text)
    assert caught.value.column == 81 or (caught.value.card, caught.value.column) in strange


def test_read_deck_from_files(tmp_path: Path) -> None:
    path = tmp_path / "a.deck"
    path.write_bytes(b"A\r\n  B")
    deck = read_deck(str(path))
    assert deck.source == str(path)
    assert [card.text for card in deck.cards] == ["A", "  B"]


@pytest.mark.parametrize(
    ("content", "words"),
    [(b"", "the deck is empty"), (b"\n  \n", "only blank cards"), (b"A\xff\n", "card 1, column 2"), (b"\xc3\xa9", "1")],
)
def test_invalid_deck_file_is_rejected(tmp_path: Path, content: bytes, words: str) -> None:
    path = tmp_path / "a.deck"
    path.write_bytes(content)
    with pytest.raises((CardError, DeckError), match=words) as caught:
        read_deck(str(path))
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", ["missing.deck", ".", "a\0b", "x" * 5000])
def test_missing_deck_file_gives_a_one_line_error(tmp_path: Path, monkeypatch, name: str) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(FileError) as caught:
        read_deck(name)
    assert "\n" not in str(caught.value)


def test_read_deck_from_standard_input(monkeypatch) -> None:
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(b"A\n"), encoding="utf-8"))
    assert read_deck("-") == deck_from_lines("standard input", ["A"])
