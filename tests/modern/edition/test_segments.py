"""The tree of readings contains every state of a text that ``build`` returns, and every row."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations

import pytest

from modern.claims.apparatus_checks import texts
from modern.edition.apparatus import Line, RowMisfit, Text, build
from modern.edition.segments import Piece, Place, reading, segments

TEXTS = texts()


def states(text: Text) -> Iterator[tuple[str, ...]]:
    """Yield the witness, each step to the text of the edition, and that text with any optional layers."""
    for count in range(len(text.default)):
        yield text.default[:count]
    optional = [layer for layer in text.layers if layer not in text.default]
    for count in range(len(optional) + 1):
        for chosen in combinations(optional, count):
            yield (*text.default, *chosen)


@pytest.mark.parametrize("name", TEXTS)
def test_every_state_equals_the_built_text(name: str) -> None:
    text = TEXTS[name]
    lines = segments(text)
    for layers in states(text):
        texts_of_lines = [text_of_line for line in lines if (text_of_line := reading(line.pieces, layers)).strip()]
        assert texts_of_lines == [line.text for line in build(text, layers)], layers


def rows_in(pieces: tuple[Piece, ...]) -> Iterator[str]:
    for piece in pieces:
        if isinstance(piece, Place):
            yield piece.row.id
            yield from rows_in(piece.old)
            yield from rows_in(piece.new)


@pytest.mark.parametrize("name", TEXTS)
def test_every_row_has_a_place(name: str) -> None:
    row_ids = {row_id for line in segments(TEXTS[name]) for row_id in rows_in(line.pieces)}
    assert row_ids == {row.id for row in TEXTS[name].rows}


def test_layers_change_a_statement_independently_and_misfits_are_named() -> None:
    line = next(line for line in segments(TEXTS["program3"]) if line.id == "121")
    ours = ("ocr", "print", "lacuna")
    assert reading(line.pieces, ours) == "      IF(E(I))135,133,134"
    assert reading(line.pieces, (*ours, "corrected")) == "      IF(E(I))135,216,134"
    assert reading(line.pieces, (*ours, "translation")) == "      IF(D(I))135,133,134"
    assert reading(line.pieces, (*ours, "translation", "corrected")) == "      IF(D(I))135,216,134"
    text = TEXTS["program1"]
    row = text.rows[1]
    strange = replace(row, changes=(replace(row.changes[0], witness="NOT THERE"),))
    with pytest.raises(
        RowMisfit, match=f"row {row.id}: 'NOT THERE' does not occur exactly once in line {row.changes[0].line}"
    ):
        segments(replace(text, rows=(strange,)))
    nowhere = replace(row, changes=(replace(row.changes[0], line="9999"),))
    with pytest.raises(RowMisfit, match=f"row {row.id}: line 9999 does not exist"):
        segments(replace(text, rows=(nowhere,)))


def test_the_rest_of_a_line_follows_a_lemma_of_two_lines() -> None:
    row = replace(TEXTS["program1"].rows[1], layer="ocr")
    changes = (replace(row.changes[0], line="1", witness="B", lemma="x\ny"),)
    text = replace(TEXTS["program1"], witness=(Line("1", "A B C", "64"),), rows=(replace(row, changes=changes),))
    first, second = segments(text)
    assert (reading(first.pieces, ("ocr",)), reading(second.pieces, ("ocr",))) == ("A x", "y C")
    assert (reading(first.pieces, ()), reading(second.pieces, ())) == ("A B C", "")
    assert (first.inserted, second.inserted, second.id) == (False, True, f"{row.id}.1")
