"""The card layout against the FORMAT statements of chapter 5."""

import dataclasses
from importlib.resources import files

import pytest

from emulator.errors import Refused
from modern.edition.chapter6_cards import Chapter, TranscriptError, load_chapter, rebuilt
from modern.edition.chapter6_checks import check_layout, records

CHAPTER = load_chapter()


def columns(text: str, values: int) -> list[list[tuple[int, int]]]:
    return [[(field.first, field.last) for field, _ in card] for card in records(text, values)]


@pytest.mark.parametrize(
    ("text", "values", "expected"),
    [
        ("(I2)", 1, [[(1, 2)]]),
        ("(4E14.8,3I4)", 3, [[(1, 14), (15, 28), (29, 42)]]),  # listing 1, FORMAT 21, three of seven
        ("(4E14.8,3I4)", 7, [[(1, 14), (15, 28), (29, 42), (43, 56), (57, 60), (61, 64), (65, 68)]]),
        ("(I4,I2)", 1, [[(1, 4)]]),  # listing 1, FORMAT 25 for N alone
        ("(/2HN=,I4/)", 1, [[], [(1, 2), (3, 6)], []]),  # a slash at either end: a blank card
        ("(2X,3HNO.///)", 0, [[(3, 5)], [], [], []]),  # three slashes at the end: three
        ("(2HAB//2HCD)", 0, [[(1, 2)], [], [(1, 2)]]),  # two between fields: one
        ("(//2HAB)", 0, [[], [], [(1, 2)]]),
        ("(I3,1H,,I3,1H,,I3,15X,I3)", 4, [[(1, 3), (4, 4), (5, 7), (8, 8), (9, 11), (27, 29)]]),
        ("(2X,2H1,,2X,1H2,18X,I3)", 1, [[(3, 4), (7, 7), (26, 28)]]),  # listing 1, FORMAT 17
        ("(7HA = BC )", 0, [[(1, 1), (3, 3), (5, 6)]]),  # words stand apart, their blanks are the layout's
        ("(6X,E14.8,2X,E14.8)", 1, [[(7, 20)]]),  # unused groups are dropped
    ],
)  # fmt: skip
def test_format_columns(text: str, values: int, expected: list[list[tuple[int, int]]]) -> None:
    assert columns(text, values) == expected


@pytest.mark.parametrize(
    ("text", "values", "message"),
    [("(I2)", 2, "1 of 2 numbers"), ("I2", 1, "parenthesis"), ("(5HABC)", 0, "5H"), ("(I2,Q)", 1, "'Q'")],
)
def test_a_format_that_cannot_be_read_is_one_line(text: str, values: int, message: str) -> None:
    with pytest.raises(Refused, match=message) as caught:
        records(text, values)
    assert "\n" not in str(caught.value)


def test_layout_agrees_with_its_formats_and_their_pages() -> None:
    assert check_layout(CHAPTER) == ()
    # `listed` equals the OCR text of the listing except for blanks, and a change to it has a note.
    for entry in CHAPTER.layout.formats:
        assert (entry.listed == entry.text) == (not entry.note), entry
        witness = files("fortran_src").joinpath("witness", f"program{entry.program}.txt").read_text(encoding="utf-8")
        page = next(p for p in witness.split("## page ") if p.startswith(f"{entry.page}\n"))
        assert f"{entry.number}FORMAT{entry.listed}".replace(" ", "") in page.replace(" ", "")


def with_card(card_id: str, **changes: object) -> Chapter:
    """The chapter with one card of the layout changed wherever it is used."""
    layout = CHAPTER.layout
    new = {c.id: dataclasses.replace(c, **changes) if c.id == card_id else c for c in layout.cards}
    devices = tuple(
        dataclasses.replace(d, cards=tuple((new[c.id], role) for c, role in d.cards)) for d in layout.devices
    )
    return rebuilt(CHAPTER.text, dataclasses.replace(layout, cards=tuple(new.values()), devices=devices))


def test_guard_moved_columns_changed_words_and_missing_cards_are_caught() -> None:
    card = next(c for c in CHAPTER.layout.cards if c.id == "p1.10.1")
    moved = tuple(dataclasses.replace(f, first=f.first + 1, last=f.last + 1) for f in card.fields)
    assert check_layout(with_card("p1.10.1", fields=moved)) == (
        "card p1.10.1: its columns differ from those of FORMAT 10",
    )
    # Without the row of the layer typist, example 4 prints CONVES and FORMAT 20 has CONVEX.
    (row,) = [r for r in CHAPTER.text.rows if "CONVES" in r.changes[0].witness]
    faults = check_layout(rebuilt(CHAPTER.text, CHAPTER.layout, {row.id}))
    assert faults == ("example4/program2.punch: line 172 prints CONVES, the FORMAT CONVEX",)
    chapter = without_card("example3/program1.deck", 1)
    with pytest.raises(
        TranscriptError, match=r"^example3/program1.deck: line \S+: '\+\.1.*' remains after the last field$"
    ):
        check_layout(chapter)


def without_card(file: str, at: int) -> Chapter:
    devices = tuple(
        dataclasses.replace(d, cards=d.cards[:at] + d.cards[at + 1 :]) if d.file == file else d
        for d in CHAPTER.layout.devices
    )
    return rebuilt(CHAPTER.text, dataclasses.replace(CHAPTER.layout, devices=devices))


@pytest.mark.parametrize("at", [0, 3, -1])
def test_guard_a_missing_blank_card_is_caught(at: int) -> None:
    cards = next(d.cards for d in CHAPTER.layout.devices if d.file == "example1/program1.punch")
    place = at % len(cards)
    assert not cards[place][0].fields
    (fault,) = check_layout(without_card("example1/program1.punch", place))
    assert fault.startswith("example1/program1.punch: ")
    assert "cannot follow" in fault
