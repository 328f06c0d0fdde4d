"""The weight of evidence: variants are generated, judged, stored and reported."""

import hashlib
import json
import os
from pathlib import Path

import pytest

from emulator.errors import FileError
from modern.edition import programs
from modern.edition.variants import Variant, deck_with, statements, variants
from modern.edition.weight import EQUATIONS, Bench, alike, benches, equation_of, judged, ordered, weigh
from modern.edition.weight_report import report, unvouched, write_weight
from tests.support.paths import MACHINE_RUNS, ROOT

COMMITTED = ROOT / "docs" / "weight"


@pytest.fixture(scope="module")
def known() -> dict[str, Bench]:
    return benches(str(MACHINE_RUNS))


def variant(program: str, place: str, reads: str) -> Variant:
    """Return the variant of a card with this reading."""
    (match,) = [v for v in variants(program) if v.place == place and v.reads == reads]
    return match


def test_the_misreads_that_no_check_detects(known: dict[str, Bench]) -> None:
    """fortran_src/README.md names these."""
    for program, place, reads in (
        ("program1", "101+6", "IF(N-2)102,105,134"),
        ("program2", "180+1", "IF(MM(K)-I)183,181,181"),
        ("program3", "153", "IF(ID3-3)155,156,133"),
    ):
        assert judged(variant(program, place, reads), known) == "nothing", place


@pytest.mark.parametrize(
    ("program", "place", "reads", "answer"),
    [
        ("program1", "131+1", "", "machine or print"),
        ("program1", "200+3", "DD=X(K)*Y(J)*Z(I)+Y(K)*Z(J)*X(I)-X(J)*Y(I)*Z(K)", "print"),
        ("program1", "192", "E(I)=A3*Y(I)+B3*Z(I)*C3", "equation"),
        ("program1", "146", "", "compiler"),
        ("program2", "112+1", "GOTO104", "nothing"),
        ("program3", "135+1", "DO136L=1,NV", "print"),
    ],
)
def test_the_first_check_that_detects_a_variant(known, program, place, reads, answer) -> None:
    assert judged(variant(program, place, reads), known) in answer


def test_variants_differ_from_their_cards_in_more_than_blanks() -> None:
    for name in programs.TEXTS:
        every = variants(name)
        assert len({v.key for v in every}) == len(every) > 4_000
        assert all(v.was != v.reads for v in every)
        assert {v.how for v in every} == {"number", "name", "operator", "constant", "character", "format", "card"}
        assert len({v.card for v in every if v.how == "card"}) == len(statements(name)) - 1
    for name in programs.TEXTS:
        text = programs.committed(name).text()
        for statement in statements(name)[::7]:
            if statement.source.kind != "format":
                again = deck_with(name, statement.card, statement.source.text).text()
                assert "".join(again.split()) == "".join(text.split())


def test_formulas_of_chapter_3() -> None:
    assert equation_of("program1", "113+1") == "(3.1)"
    assert equation_of("program1", "226") == "the formula for V"
    assert equation_of("program3", "130+9") == "(3.4)"
    assert equation_of("program3", "131") == ""
    assert equation_of("program2", "102+8") == "the point C"


@pytest.mark.parametrize("place", ["102+12", "102+13", "133+10", "133+12", "133+16"])
def test_a_card_that_only_counts_computes_no_formula(place: str) -> None:
    """``MM(1)=1``, ``I1=MM(I)`` and ``NE=NE+1`` are between the cards of (3.5)."""
    assert equation_of("program2", place) == ""


def test_answers_are_stored_and_a_run_is_resumed(tmp_path: Path) -> None:
    first = weigh(tmp_path, "", most=6)
    path = tmp_path / "variants.jsonl"
    stored = path.read_text()
    path.write_text(stored[:-9])
    assert weigh(tmp_path, "", most=6) == first
    assert path.read_text() == stored
    assert set(first) == {v.key for v in ordered()[:6]}
    text = write_weight(tmp_path, first)
    assert "6 of " in text
    assert {p.name for p in tmp_path.iterdir()} == {"variants.jsonl", "report.md", "cards.csv", "silent.csv"}
    path.write_text('{"decks": "others"}\n')
    with pytest.raises(FileError, match="contains results for other listings"):
        weigh(tmp_path, "", most=6)


def test_a_folder_without_decks_is_rejected(tmp_path: Path) -> None:
    with pytest.raises(FileError, match=r"expected folders that contain a file deck\.cards, found none$"):
        weigh(tmp_path / "out", str(tmp_path), most=1)
    assert not (tmp_path / "out").exists()


def committed() -> dict[str, str]:
    lines = (COMMITTED / "variants.jsonl").read_text(encoding="utf-8").splitlines()
    listings = "".join(programs.committed(name).text() for name in programs.NAMES)
    assert json.loads(lines[0]) == {"decks": hashlib.sha256(listings.encode()).hexdigest()}
    return dict(json.loads(line) for line in lines[1:])


def test_committed_answers_cover_every_variant_and_give_the_report(tmp_path: Path) -> None:
    assert set(committed()) == {v.key for v in ordered()}
    write_weight(tmp_path, committed())
    silent = Path(str(programs.sources())) / "silent.csv"
    for path in (COMMITTED / "report.md", COMMITTED / "cards.csv", silent):
        assert path.read_text(encoding="utf-8") == (tmp_path / path.name).read_text(encoding="utf-8"), path.name


JUDGED_AGAIN = int(os.environ.get("HULL1620_WEIGHED", "12"))
"""The number of committed answers that are computed again."""


def test_committed_answers_equal_computed_ones(known: dict[str, Bench]) -> None:
    answers, every = committed(), ordered()
    compiling = [v for v in every if answers[v.key] != "compiler"]
    sample = [*every[: JUDGED_AGAIN // 3], *compiling[: JUDGED_AGAIN - JUDGED_AGAIN // 3]]
    assert {v.key: judged(v, known) for v in sample} == {v.key: answers[v.key] for v in sample}


def test_cards_without_confirmation_and_their_siblings_are_listed() -> None:
    answers = committed()
    named = report(answers).partition("## Cards that no check confirms")[2]
    assert all(f"{v.place} `{v.was.strip()}`" in named for v in unvouched(answers))
    every = ordered()
    for card in unvouched(answers):
        of_it = {answers[v.key] for v in every if (v.program, v.card) == (card.program, card.card)}
        assert of_it <= {"compiler", "nothing"}
    # Cards with exchanged names have the same form, and every card of EQUATIONS computes its formula.
    assert alike("X(L)=X(L+1)") >= 2
    assert alike("X(L)=X(L+1)") == alike("Y(I)=Y(I+1)")
    assert alike("X(L)=Y(I+2)") == 0
    for name, first, last, formula in EQUATIONS:
        places = [s.place for s in statements(name)]
        assert places.index(first) <= places.index(last)
        assert equation_of(name, first) == equation_of(name, last) == formula
