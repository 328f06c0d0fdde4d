"""The ground of every row of the chapter 6 apparatus holds; a superfluous or wrong row is detected."""

import dataclasses
import re
from collections import Counter

import pytest

from modern.edition.apparatus import Change, Row, Text
from modern.edition.chapter6_cards import E14, Card, Chapter, cards, device_files, load_chapter, rebuilt
from modern.edition.chapter6_grounds import numbers, row_faults, well_formed

CHAPTER = load_chapter()
KINDS = {"dropped-zero", "lost-sign", "lost-point", "lost", "fused", "displaced", "noise", "misread", "slip"}


def with_rows(*rows: Row) -> Chapter:
    """Return the chapter with rows that replace those of the same id or are added at the end."""
    new = {row.id: row for row in rows}
    kept = [new.pop(row.id, row) for row in CHAPTER.text.rows]
    text: Text = dataclasses.replace(CHAPTER.text, rows=(*kept, *new.values()))
    return rebuilt(text, CHAPTER.layout)


def faults(chapter: Chapter, row_id: str) -> tuple[str, ...]:
    return row_faults(chapter, chapter.text.row(row_id))


def test_rows_have_grounds_kinds_ids_and_move_characters_only() -> None:
    assert [fault for row in CHAPTER.text.rows for fault in row_faults(CHAPTER, row)] == []
    for row in CHAPTER.text.rows:
        assert row.kind in KINDS
        assert (row.kind == "slip") == (row.layer == "typist")
        assert row.reason.endswith(".")
        assert len(row.evidence) > 20
    ids = [row.id for row in CHAPTER.text.rows]
    pages = [int(row.page) for row in CHAPTER.text.rows]
    assert ids == [f"C6-{n:03d}" for n in range(1, len(ids) + 1)]
    assert pages == sorted(pages)
    for row in CHAPTER.text.rows:
        if row.kind == "displaced":
            old, new = ("".join(getattr(c, part) for c in row.changes) for part in ("witness", "lemma"))
            assert Counter("".join(old.split())) == Counter("".join(new.split())), row.id


def test_dropped_zero_rows_add_a_zero_to_the_run_and_nothing_else() -> None:
    rows = [row for row in CHAPTER.text.rows if row.kind == "dropped-zero"]
    assert rows
    for row in rows:
        (change,) = row.changes
        old, new = ("".join(part.split()) for part in (change.witness, change.lemma))
        assert len(new) == len(old) + 1
        assert re.sub("0+", "0", new) == re.sub("0+", "0", old)


def test_deck_grounds_name_the_same_point() -> None:
    """The card that a ground of kind `deck` names has all three coordinates of the card of the row."""
    seen = 0
    for row in CHAPTER.text.rows:
        for ground in (row.ground, row.ground.get("also", {})):
            if ground.get("kind") != "deck":
                continue
            named = cards(CHAPTER, ground["example"], ground["program"], ground["device"])[ground["card"] - 1]
            lines = {change.line for change in row.changes}
            own = [c for c in all_cards() if lines & {t.line for t in c.tokens if E14.fullmatch(t.text)}]
            assert any(sorted(numbers(c)) == sorted(numbers(named)) for c in own), row.id
            seen += 1
    assert seen > 100


def all_cards() -> list[Card]:
    return [card for e, p, d, _ in device_files(CHAPTER) for card in cards(CHAPTER, e, p, d)]


@pytest.mark.parametrize(
    ("text", "signed", "is_well_formed"),
    [
        (" .20000000E+01-.16000000E+02", False, True),
        (" .2000000E+01", False, False),  # 13 characters
        ("50000000E+01", False, False),  # sign and point gone
        ("+.10000000E+01.20000000E+01", True, False),  # no sign in an input deck
        ("- +.20000000E+01", True, False),  # a list dash
        ("--6000000E+01", False, False),
        (".30000000E+01\t.00000000 E -99", False, False),
        ("8. 2", False, False),
        (". 3", False, False),
        ("3, 4 -2", False, False),
        ("~0000000E-99", False, False),
        ("AX + BY + CZ + D = 0", False, True),
        ("1, 2 3", False, True),
    ],
)
def test_width_ground(text: str, signed: bool, is_well_formed: bool) -> None:
    assert well_formed(text, signed) is is_well_formed


def extra(ground: dict[str, object], change: Change, kind: str = "noise") -> Row:
    return Row("X-1", "chapter6", "ocr", "noise", "None.", "None.", (change,), ground)


@pytest.mark.parametrize(
    ("ground", "change"),
    [
        ({"kind": "width"}, Change("67", ".65020000E+04", " .65020000E+04")),
        (
            {"kind": "deck", "example": 2, "program": 1, "device": "deck", "card": 9, "field": 1},
            Change("67", "0E+04", "0E+04 "),
        ),
        (
            {"kind": "arithmetic", "check": "plane", "example": 5, "program": 3, "equation": 3, "vertices": [2, 3, 5]},
            Change("337", "2,", " 2,"),
        ),
        (
            {"kind": "sibling", "words": "CONVEX HULL", "own": ["58"], "lines": ["17"]},
            Change("58", "CONVEX HULL", "CONVEX  HULL"),
        ),
        ({"kind": "order", "example": 4, "program": 2, "role": "vertex"}, Change("144", "2\t", "2 \t")),
        ({"kind": "order", "lines": ["245", "246"]}, Change("245", ".3", " .3")),
    ],
)  # fmt: skip
def test_a_superfluous_row_is_caught(ground: dict[str, object], change: Change) -> None:
    chapter = with_rows(extra(ground, change))
    (fault,) = faults(chapter, "X-1")
    assert fault.startswith("row X-1: its ground")


def test_guard_wrong_digits_vertices_and_grounds_are_caught() -> None:
    row = CHAPTER.text.row("C6-192")
    change = dataclasses.replace(row.changes[0], lemma=row.changes[0].lemma.replace("00E", "01E"))
    assert change != row.changes[0]
    assert faults(with_rows(dataclasses.replace(row, changes=(change,))), row.id)
    row = CHAPTER.text.row("C6-228")
    change = dataclasses.replace(row.changes[0], lemma="1 2 3")
    assert faults(with_rows(dataclasses.replace(row, changes=(change,))), row.id)
    # Without its minus, C of equation 2 would be the only number of the page that lost a point but not a minus.
    row = CHAPTER.text.row("C6-089")
    assert row.certainty == "probable"
    change = dataclasses.replace(row.changes[0], lemma="\t.00000000E-99")
    assert faults(with_rows(dataclasses.replace(row, changes=(change,))), row.id)
    chapter = with_rows(extra({"kind": "opinion"}, Change("58", "CONVEX", " CONVEX")))
    assert faults(chapter, "X-1") == ("row X-1: unknown kind of ground 'opinion'",)


def test_lost_points_of_example_4_line_by_line() -> None:
    """Page 108: each number whose first witness character is a digit lost its point, and is negative in the print."""
    negatives, zeros = 0, 0
    printed = {line.id: line.text for line in CHAPTER.print}
    tables = [str(n) for n in (*range(143, 148), *range(152, 157))]
    for line in CHAPTER.text.witness:
        if line.id in tables:
            assert line.page == "108"
            cells = [cell.strip() for cell in line.text.split("\t") if "E" in cell]
            for cell, number in zip(cells, E14.findall(printed[line.id]), strict=True):
                assert (cell[0].isdigit()) == number.startswith("-"), (line.id, cell, number)
                negatives += number.startswith("-")
                zeros += number == "-.00000000E-99"
    assert (negatives, zeros) == (13, 1)
