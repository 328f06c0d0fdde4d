"""The reading of every row is allowed by the kind of its row and needs each of its steps."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

import pytest

from emulator.language.cards import Deck
from modern.claims.apparatus_checks import check_listing, count_pair_uses, texts
from modern.edition import grounds, programs
from modern.edition.apparatus import Change, Row, Text
from modern.edition.readings import attested, reading_faults, steps, table, without_step
from tests.support.caches import cleared

TEXTS = texts()
PLACES = count_pair_uses(TEXTS)
OCR = [row for text in TEXTS.values() for row in text.rows if row.layer == "ocr"]


def row_of(words: str, kind: str = "misread", lemma: str = "", layer: str = "ocr") -> Row:
    return Row("R", "t", layer, kind, "r", "e", (Change("1", words, lemma),), {"kind": "parse"})


def test_rows_keep_the_rules_of_their_kinds_and_pairs() -> None:
    assert [fault for row in OCR for fault in reading_faults(row, PLACES)] == []
    # Marks that make up a whole fragment are not counted.
    unused = {(pair.witness, pair.lemma) for pair in table()} - set(PLACES)
    assert unused == {("_", ""), ("•", ""), ("·", "")}
    row = row_of("Il=ML", lemma="I1=ML")
    assert list(reading_faults(row, attested([row]))) == [
        "no other row reads 'l' as '1', and the table names no other evidence"
    ]
    assert not list(reading_faults(row_of("KELEO", lemma="KELEQ"), attested([])))


@pytest.mark.parametrize(
    ("kind", "witness", "lemma", "fault"),
    [
        (
            "misread",
            "Il=ML",
            "I1=MS",
            "the pairs that the table of confusables allows for misread do not make the lemma",
        ),
        ("misread", "Il=ML", "I1=ML", ""),
        ("displaced", "C CONVEX HULL", "C CONVEX HULK", "a row of kind displaced must keep the words of the witness"),
        ("displaced", "CONVEX HULL C", "C CONVEX HULL", ""),
        ("fused", ") END", ")\n ENDS", "a row of kind fused must not change a character"),
        ("spacing", "NUMB 2", "NUMB3", "a row of kind spacing must not change a character"),
        ("dropped-zero", ".1000000E+01", ".10000000E+01", ""),
        ("dropped-zero", ".1000000E+01", ".11000000E+01", "allows for dropped-zero do not make"),
        ("dropped-zero", ".1", "0.1", "allows for dropped-zero do not make"),
        ("lost-sign", "5E", "-.5E", ""),
        ("comment", "CHECKING", "C CHECKING", ""),
        ("comment", "CHECKING", "CHECKCING", "allows for comment do not make"),
        ("noise", "\\mathbf{Y}", "Y", ""),
        ("noise", "\\mathbf{Y}", "X", "allows for noise do not make"),
        ("lost", "1 2", "1 2 4", ""),
        ("lost", "1 2", "1 4", "a row of kind lost must keep every character"),
        ("doubled", "8 9", "8", ""),
        ("doubled", "8 9", "7", "a row of kind doubled must only delete words"),
        ("conjecture", "A", "B", "unknown kind 'conjecture' for the layer ocr"),
    ],
)
def test_what_each_kind_allows(kind: str, witness: str, lemma: str, fault: str) -> None:
    faults = list(reading_faults(row_of(witness, kind, lemma), PLACES))
    assert bool(faults) is bool(fault)
    assert all(fault in message for message in faults)


def test_steps_are_the_fewest_and_can_be_undone() -> None:
    row = row_of(" (14.12)", lemma=" (I4,I2)")
    made = steps(row)
    assert made is not None
    assert [(step.pair.witness, step.pair.lemma) for step in made] == [("1", "I"), (".", ","), ("1", "I")]
    assert [without_step(row, step).changes[0].lemma for step in made] == [" (14,I2)", " (I4.I2)", " (I4,12)"]
    assert steps(row_of("A", lemma="B")) is None
    assert steps(row_of("A B", lemma="AB")) == ()


def test_a_step_that_is_not_needed_is_named(monkeypatch) -> None:
    row = programs.text("program1").row("P1-004")
    wrong = replace(row, changes=(replace(row.changes[0], lemma="I1=I"),))
    with altered(wrong):
        proof = check_listing(wrong, PLACES)
    assert not proof.holds
    assert proof.message == "parse: the change of '1' to 'I' is not needed"


@contextmanager
def altered(row: Row) -> Iterator[Text]:
    """Replace the row with the same id in its text, from which decks and programs are then rebuilt."""
    old = TEXTS[row.text]
    text = replace(old, rows=tuple(row if r.id == row.id else r for r in old.rows))
    if row.text not in programs.TEXTS:
        yield text
        return

    def instead(name: str) -> Text:
        return text if name == row.text else TEXTS[name]

    def built(name: str) -> Deck:
        return programs.built(name)

    with cleared(programs, grounds), pytest.MonkeyPatch.context() as patch:
        patch.setattr(programs, "text", instead)
        patch.setattr(programs, "committed", built)
        yield text
