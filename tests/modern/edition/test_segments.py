"""The tree of readings gives every state of a text that building gives, and no row is left out of it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations

import pytest

from modern.claims.apparatus_checks import texts
from modern.edition.apparatus import Line, RowMisfit, Text, build
from modern.edition.segments import Piece, Place, reading, segments

TEXTS = texts()


def states(text: Text) -> Iterator[tuple[str, ...]]:
    """The witness, each step to the edition's text, and that text with any layers beyond it."""
    for count in range(len(text.default)):
        yield text.default[:count]
    beyond = [layer for layer in text.layers if layer not in text.default]
    for count in range(len(beyond) + 1):
        for some in combinations(beyond, count):
            yield (*text.default, *some)


@pytest.mark.parametrize("name", TEXTS)
def test_every_state_is_what_building_gives(name: str) -> None:
    text = TEXTS[name]
    lines = segments(text)
    for layers in states(text):
        found = [words for line in lines if (words := reading(line.pieces, layers)).strip()]
        assert found == [line.text for line in build(text, layers)], layers


def rows_in(pieces: tuple[Piece, ...]) -> Iterator[str]:
    for piece in pieces:
        if isinstance(piece, Place):
            yield piece.row.id
            yield from rows_in(piece.old)
            yield from rows_in(piece.new)


@pytest.mark.parametrize("name", TEXTS)
def test_every_row_has_a_place(name: str) -> None:
    found = {row for line in segments(TEXTS[name]) for row in rows_in(line.pieces)}
    assert found == {row.id for row in TEXTS[name].rows}


def test_two_layers_may_change_one_statement_each_without_the_other() -> None:
    line = next(line for line in segments(TEXTS["program3"]) if line.id == "121")
    ours = ("ocr", "print", "lacuna")
    assert reading(line.pieces, ours) == "      IF(E(I))135,133,134"
    assert reading(line.pieces, (*ours, "corrected")) == "      IF(E(I))135,216,134"
    assert reading(line.pieces, (*ours, "translation")) == "      IF(D(I))135,133,134"
    assert reading(line.pieces, (*ours, "translation", "corrected")) == "      IF(D(I))135,216,134"


def test_a_row_that_does_not_fit_is_named() -> None:
    text = TEXTS["program1"]
    row = text.rows[1]
    strange = replace(row, changes=(replace(row.changes[0], witness="NOT THERE"),))
    with pytest.raises(RowMisfit, match=f"row {row.id}: 'NOT THERE' does not stand once in line {row.changes[0].line}"):
        segments(replace(text, rows=(strange,)))
    nowhere = replace(row, changes=(replace(row.changes[0], line="9999"),))
    with pytest.raises(RowMisfit, match=f"row {row.id}: there is no line 9999"):
        segments(replace(text, rows=(nowhere,)))


def test_a_lemma_of_two_lines_takes_what_follows_with_it() -> None:
    row = replace(TEXTS["program1"].rows[1], layer="ocr")
    changes = (replace(row.changes[0], line="1", witness="B", lemma="x\ny"),)
    text = replace(TEXTS["program1"], witness=(Line("1", "A B C", "64"),), rows=(replace(row, changes=changes),))
    first, second = segments(text)
    assert (reading(first.pieces, ("ocr",)), reading(second.pieces, ("ocr",))) == ("A x", "y C")
    assert (reading(first.pieces, ()), reading(second.pieces, ())) == ("A B C", "")
    assert (first.inserted, second.inserted, second.id) == (False, True, f"{row.id}.1")
