"""The facing text: complete decks, every line of the witness and every row once, and permanent places."""

import hashlib
import re

import pytest

from modern.edition import programs
from modern.edition.apparatus import build
from modern.publication.facing import Card, facing
from modern.publication.measured import runs
from modern.publication.uses import uses


def card(program: str, place: str) -> Card:
    return next(entry for entry in facing(program).cards if entry.place == place)


def shown(card: Card) -> list[str]:
    return [piece.text[a:b] for piece in card.witness for a, b in piece.changed]


@pytest.mark.parametrize("name", programs.NAMES)
def test_the_cards_equal_the_committed_deck(name: str) -> None:
    text = "".join(card.text + "\n" for card in facing(name).cards)
    committed = programs.sources().joinpath(f"{name}.f").read_bytes()
    assert hashlib.sha256(text.encode()).digest() == hashlib.sha256(committed).digest()
    assert [card.number for card in facing(name).cards] == list(range(1, len(text.splitlines()) + 1))


@pytest.mark.parametrize("name", programs.NAMES)
def test_places_are_unique_and_counted_from_the_preceding_number(name: str) -> None:
    cards = facing(name).cards
    assert len({card.place for card in cards}) == len(cards)
    last, steps = 0, 0
    for card in cards:
        if card.kind in ("comment", "title"):
            assert card.place == "title" or card.place.startswith("before-")
            continue
        number = re.match(r"\s*(\d+)", card.text)
        last, steps = (int(number[1]), 0) if number else (last, steps + 1)
        assert card.place == (f"{last}+{steps}" if steps else f"{last}")


@pytest.mark.parametrize("name", programs.NAMES)
def test_counting_may_continue_past_the_next_number(name: str) -> None:
    cards = [card for card in facing(name).cards if card.kind not in ("comment", "title")]
    first = {card.label: at for at, card in enumerate(cards) if card.label}
    names = [card.place for card in cards] + [also for card in cards for also in card.also]
    assert len(set(names)) == len(names)
    for at, card in enumerate(cards):
        for also in card.also:
            label, _, steps = also.partition("+")
            assert first[int(label)] + int(steps) == at


@pytest.mark.parametrize("name", programs.NAMES)
def test_every_line_of_the_witness_is_shown_once(name: str) -> None:
    """A line that became several cards is shown in parts, which together are the line."""
    listing = facing(name)
    parts: dict[int, list[str]] = {}
    for card in listing.cards:
        for piece in card.witness:
            parts.setdefault(piece.line, []).append(piece.text)
    for _, pieces in listing.dropped:
        for piece in pieces:
            parts.setdefault(piece.line, []).append(piece.text)
    assert {line: "".join(texts) for line, texts in parts.items()} == {
        int(line.id): line.text for line in listing.text.witness
    }


@pytest.mark.parametrize("name", programs.NAMES)
def test_unmarked_characters_are_equal_on_both_sides(name: str) -> None:
    for card in facing(name).cards:
        if not card.witness:
            assert card.changed == ((0, len(card.text)),)
            continue
        unchanged = "".join(unmarked(piece.text, piece.changed) for piece in card.witness)
        assert unchanged == unmarked(card.text, card.changed)
        if unchanged and "".join("".join(p.text for p in card.witness).split()) != "".join(card.text.split()):
            assert card.rows, card


def unmarked(text: str, spans: tuple[tuple[int, int], ...]) -> str:
    return "".join(c for at, c in enumerate(text) if not c.isspace() and not any(a <= at < b for a, b in spans))


def test_every_row_is_on_a_page() -> None:
    named = {row.id for name in programs.NAMES for row in facing(name).rows()}
    assert named == {row.id for name in programs.TEXTS for row in programs.text(name).rows}


@pytest.mark.parametrize(
    ("program", "place", "witness", "deck"),
    [
        ("program3", "105+3", ["_"], ["-"]),
        ("program3", "143", ["\\text{", "}"], []),
        ("program1", "125+1", ["0", "1", "1"], ["O", "I", "I"]),
        ("program1", "128", ["."], [","]),
        ("program1", "title", [], []),
    ],
)
def test_changed_characters(program: str, place: str, witness: list[str], deck: list[str]) -> None:
    changed_card = card(program, place)
    assert shown(changed_card) == witness
    assert [changed_card.text[a:b] for a, b in changed_card.changed] == deck


def test_a_line_with_several_cards_is_divided_at_their_starts() -> None:
    parts = [
        (card.place, piece.text.strip())
        for card in facing("program1").cards
        for piece in card.witness
        if piece.line == 68
    ]
    assert len(parts) == 28
    assert parts[1] == ("122", "122 PUNCH 15, NUMB1, A1, B1, ZERO, C1")
    assert parts[-1] == ("133+2", "NUMB1=NUMB1+2")


@pytest.mark.parametrize("name", programs.NAMES)
def test_variants_of_a_layer_give_the_deck_of_that_layer(name: str) -> None:
    listing = facing(name)
    base = programs.built_in(name).layers
    for layer in {variant.layer for card in listing.cards for variant in card.variants}:
        lines = []
        for card in listing.cards:
            here = [variant for variant in card.variants if variant.layer == layer]
            lines += here[0].cards if here else (card.text,)
            assert all(variant.rows for variant in here), card
        assert lines == [line.text for line in build(listing.text, (*base, layer))]


def test_names_of_program_3() -> None:
    names = {name.name: name for name in uses("program3").names}
    place = {card.number: card.place for card in facing("program3").cards}
    kelec = names["KELEQ"]
    assert (kelec.floating, kelec.shape) == (False, ())
    assert place[kelec.set[0]] == "100"
    assert names["A"].shape == (98,)
    assert [place[n] for n in names["A"].declared] == ["0+1"]


@pytest.mark.parametrize("name", programs.NAMES)
def test_executions_add_up_to_the_statements_of_a_run(name: str) -> None:
    for run in runs(name):
        assert run.executions.keys() <= {card.number for card in facing(name).cards if card.kind == "statement"}
        assert abs(sum(time.seconds for time in run.times.values()) - run.processor.seconds) < 1e-6
    assert [run.example for run in runs("program3")] == [5, 6]
