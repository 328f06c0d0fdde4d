"""Witness and rows build the committed decks, and every row is needed."""

import re
from dataclasses import replace
from pathlib import Path

import pytest

from emulator.errors import DeckError
from emulator.language.cards import Deck, deck_from_lines, deck_from_text
from modern.edition import chapter6, grounds, programs
from modern.edition.apparatus import ApparatusError, Change, Row, build, built_without, load
from modern.edition.grounds import check_decks, check_row

ROWS = [row for name in programs.TEXTS for row in programs.text(name).rows]
SOURCES = programs.sources()


@pytest.mark.parametrize("name", programs.NAMES)
def test_committed_deck_is_witness_and_rows(name: str) -> None:
    assert programs.committed(name).text() == programs.built(name).text()


@pytest.mark.parametrize(("name", "first", "last"), [("program1", 64, 74), ("program2", 79, 87), ("program3", 93, 102)])
def test_every_page_is_marked(name: str, first: int, last: int) -> None:
    text = SOURCES.joinpath("witness", f"{name}.txt").read_text(encoding="utf-8")
    assert [int(n) for n in re.findall(r"^## page (\d+)$", text, re.M)] == list(range(first, last + 1))


@pytest.mark.parametrize(
    ("row", "page", "cards"),
    [
        ("P1-039", "66", "131+1"),  # a card that row P1-008 inserts
        ("P1-041", "67-68", "146+1 to 154+4"),
        ("P1-043", "64-74", "all cards"),
        ("P1-044", "64-74", "100, FORMAT 1"),
        ("P2-034", "80", "114, 114+1, 114+2"),
        ("P3-040", "94", "110 to 110+3"),
    ],
)
def test_a_row_names_its_pages_and_cards(row: str, page: str, cards: str) -> None:
    emendation = programs.text(f"program{row[1]}").row(row)
    assert (emendation.page, programs.cards_of(emendation)) == (page, cards)


@pytest.mark.parametrize("name", programs.NAMES)
def test_a_card_is_named_by_its_statement(name: str) -> None:
    pairs = list(zip(programs.card_names(name), programs.committed(name).cards, strict=True))
    comments = {number for number, (_, card) in enumerate(pairs) if card.text.startswith("C  ")}
    assert pairs[0][0] == "title"
    for number in comments - {0}:
        following = next(named for k, (named, _) in enumerate(pairs) if k > number and k not in comments)
        assert pairs[number][0] == f"before {following}"
    statements = [pair for number, pair in enumerate(pairs) if number not in comments]
    for number, (card_name, _) in enumerate(statements):
        named, _, steps = card_name.partition("+")  # a statement number, FORMAT and its number, or DIMENSION
        first = number - int(steps or 0)
        assert steps == "" or statements[number - 1][0] in (named, f"{named}+{int(steps) - 1}")
        word, _, label = named.rpartition(" ") if named[-1].isdigit() else (named, "", "")
        assert "".join(statements[first][1].text.split()).startswith(label + word)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.id)
def test_row_is_needed(row: Row) -> None:
    proof = check_row(row)
    assert proof.holds, proof.message


def test_decks_and_optional_layers_hold() -> None:
    row = next(row for row in ROWS if row.text == "program1" and row.kind == "fused")
    (change,) = row.changes
    assert "".join(change.witness.split()) == "".join(change.lemma.split())
    proofs = list(check_decks())
    assert [proof.subject for proof in proofs] == [f"{name}.f" for name in programs.NAMES]
    assert all(proof.holds for proof in proofs)
    for proof in proofs:
        cards = len(programs.committed(proof.subject.removesuffix(".f")).cards)
        assert proof.message.startswith(f"the {cards} cards equal the witness with ")
    assert [proof.message for proof in grounds.check_layers() if not proof.holds] == []


# Each kind of ground fails if it is false.


def superfluous(ground: dict[str, object], row_id: str = "P1-038") -> Row:
    return replace(programs.text("program1").row(row_id), ground=ground)


FORCED: dict[str, object] = {"kind": "forced", "card": "125+1", "sibling": "125+3"}
FALSE_GROUNDS: list[tuple[str, dict[str, object], str]] = [
    ("P1-043", {"kind": "parse"}, "parse: without the row the deck still compiles"),
    ("P1-038", {"kind": "cosmetic"}, "cosmetic: the object code is not the same with and without the row"),
    ("P1-001", {"kind": "cosmetic"}, "cosmetic: without the row the deck does not compile: not a statement"),
    (
        "P1-001",
        {"kind": "deck", "deck": "example1"},
        "deck: without the row the deck does not compile: not a statement",
    ),
    (
        "P1-001",
        {"kind": "print", "program": "program1", "examples": [2]},
        "print: without the row the deck does not compile: not a statement",
    ),
    (
        "P1-038",
        {"kind": "print", "program": "program1", "examples": [3]},
        "print: example 3, program 1: exact with the row, exact without",
    ),
    # Example 1 is exact only in another order, which does not count.
    (
        "P1-038",
        {"kind": "print", "program": "program1", "examples": [1]},
        "print: example 1, program 1: not exact with the row, not exact without",
    ),
    ("P1-038", {"kind": "print", "program": "program1", "examples": []}, "print: the ground names no example"),
    (
        "P1-018",
        {"kind": "print", "program": "program1", "examples": [2]},
        "print: example 2, program 1: exact with the row, exact without",
    ),
    (
        "P1-043",
        {"kind": "deck", "program": "program1", "deck": "example1"},
        "deck: deck example1 gives the same cards without the row",
    ),
    ("P1-039", {"kind": "deck", "program": "program1", "deck": "nosuch"}, "deck: deck 'nosuch' does not exist"),
    ("P1-018", FORCED | {"rename": ["O3", "O1"]}, "forced: card 125+1 differs from card 125+3 with names exchanged"),
    (
        "P1-038",
        FORCED | {"rename": ["O3", "O1", "X", "Y", "Y", "Z"]},
        "forced: card 125+1 equals card 125+3 with names exchanged also without the row",
    ),
    (
        "P1-018",
        FORCED | {"rename": ["O3", "O1", "X", "Y", "Y", "Z"], "equation": ["125+2", "226"]},
        "forced: cards 125+2 to 226 do not compute V of page 15 with the row, or also without it",
    ),
    ("P1-038", {"kind": "because"}, "unknown kind of ground: 'because'"),
    ("P1-038", {}, "unknown kind of ground: ''"),
]


@pytest.mark.parametrize(
    ("row_id", "ground", "message"), FALSE_GROUNDS, ids=[f"{r}-{g.get('kind')}" for r, g, _ in FALSE_GROUNDS]
)
def test_a_false_ground_fails(row_id: str, ground: dict[str, object], message: str) -> None:
    proof = check_row(superfluous(ground, row_id))
    assert not proof.holds
    assert proof.message.startswith(message)


def test_names_cards_and_layers_without_a_row_are_rejected_or_found() -> None:
    with pytest.raises(ValueError, match="shorter"):
        check_row(superfluous(FORCED | {"rename": ["O3", "O1", "X"]}, "P1-018"))
    deck = deck_from_lines("d.f", ["5 A=1.", "C  COMMENT", "B=2.", "6 END"])
    assert [grounds._card(deck, place) for place in ("5", "5+1", "6")] == ["A=1.", "B=2.", "END"]
    with pytest.raises(DeckError, match=r"^program2 has no layer 'examples'; its layers are "):
        programs.deck("program2", ("examples",))


TRUE_GROUNDS = [
    ("P1-001", "parse: without the row: not a statement of this FORTRAN: C"),
    ("P1-002", "parse: without the row: program1.f: card 22, column 9: write '=' for '#'"),
    (
        "P1-018",
        "forced: card 125+1 equals card 125+3 with O3 for O1, X for Y, Y for Z, and cards 125+1 to 226 compute V of "
        "page 15, but not without the row",
    ),
    ("P1-037", "print: example 2 is exact with the row, not without"),
    ("P1-042", "print: example 5 is exact with the row, not without"),
    ("P1-043", "cosmetic: the object code is the same with and without the row"),
    ("P2-024", "deck: deck between ends with an empty hopper; without the row: different cards"),
    ("P2-026", "deck: deck epsplane ends with an empty hopper; without the row: program2.f: card 53: EPS is undefined"),
]


@pytest.mark.parametrize(("row_id", "message"), TRUE_GROUNDS, ids=[row_id for row_id, _ in TRUE_GROUNDS])
def test_the_message_of_a_true_ground_names_the_evidence(row_id: str, message: str) -> None:
    """Check the messages of some rows of each kind of ground."""
    proof = check_row(next(row for row in ROWS if row.id == row_id))
    assert proof.holds
    assert proof.message.startswith(message)


def test_outcomes_are_equal_if_cards_and_ending_are() -> None:
    job = grounds._outcome("program1", (), programs.program("program1"), chapter6.input_deck(1))
    assert job.same_as(job)
    assert not job.same_as(replace(job, lines=job.lines[1:]))
    refused = replace(job, ending=DeckError("x"))
    assert not job.same_as(refused)
    assert not refused.same_as(job)
    assert refused.same_as(replace(refused, ending=DeckError("x")))
    assert not refused.same_as(replace(refused, ending=DeckError("y")))


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("END", "cards equal the witness with "),
        ("STOP", "cards DIFFER from the witness with "),
        ("GO TO", "cards DIFFER from the witness with "),
    ],
)
def test_a_deck_that_differs_from_its_build_fails(line: str, message: str, monkeypatch) -> None:
    """Replace the last card, END; the message also reports a card that does not compile."""
    cards = [card.text for card in programs.committed("program1").cards]
    changed = deck_from_lines("program1.f", [*cards[:-1], "      " + line])
    monkeypatch.setattr(programs, "built", lambda name: changed if name == "program1" else programs.committed(name))
    proof, *others = check_decks()
    assert proof.holds == (line == "END")
    assert message in proof.message
    assert proof.message.endswith(", and do NOT compile") == (line == "GO TO")
    assert all(other_proof.holds for other_proof in others[:2])


@pytest.mark.parametrize(
    ("program", "layer", "lemma", "altered"),
    [
        ("program2", "corrected", "BL=(R(I1)-R(I3))", "BL=(R(I3)-R(I3))"),
        ("program2", "corrected", "2157,1157,1157", "1157,1157,1157"),
        ("program3", "epsilon", "EPS", "EPT"),
    ],
)
def test_altered_row_of_an_optional_layer_is_noticed(program, layer, lemma, altered, monkeypatch) -> None:
    """The layers that no committed deck contains are compared by their hashes, and by the hulls of their decks."""
    deck = programs.deck

    def changed(name: str, layers: tuple[str, ...] = ()) -> Deck:
        text = deck(name, layers).text()
        return deck_from_text(f"{name}.f", text.replace(lemma, altered, 1) if name == program and layers else text)

    assert lemma in deck(program, (layer,)).text()
    monkeypatch.setattr(programs, "deck", changed)
    assert [proof.subject for proof in grounds.check_layers() if not proof.holds] == [f"layer {layer}"]


# The mechanism on a text of three lines.

WITNESS = "## page 1\nalpha l\n\nbeta\n```\n## page 2\n  12 gamma\n"
HEAD = '[text]\nid = "t"\ntitle = "t"\nwitness = "w.txt"\nfurniture = ["```"]\nlayers = ["a", "b"]\ndefault = ["a"]\n'
ROW = '[[row]]\nid = "{id}"\nlayer = "{layer}"\nkind = "k"\nreason = "r"\nevidence = "e"\nchange = [{change}]\n'


def text_of(tmp_path: Path, *rows: tuple[str, str, str]) -> Path:
    (tmp_path / "w.txt").write_text(WITNESS)
    body = "".join(ROW.format(id=i, layer=layer, change=change) for i, layer, change in rows)
    (tmp_path / "t.toml").write_text(HEAD + body)
    return tmp_path


def built(folder: Path, *layers: str) -> list[tuple[str, str, str]]:
    return [(line.id, line.text, line.page) for line in build(load(folder, "t"), layers or None)]


def test_lines_are_numbered_without_page_marks(tmp_path: Path) -> None:
    assert built(text_of(tmp_path)) == [("1", "alpha l", "1"), ("3", "beta", "1"), ("5", "  12 gamma", "2")]


def test_changes_of_each_form(tmp_path: Path) -> None:
    folder = text_of(
        tmp_path,
        ("r1", "a", '{ line = "1", witness = " l", lemma = " 1\\ntwo" }'),
        ("r2", "a", '{ line = "3", after = true, lemma = "new" }'),
        ("r3", "b", '{ line = "r2.1", witness = "new", lemma = "newer" }'),
        ("r4", "a", '{ line = "5", through = "5", form = true }'),
    )
    words = ["alpha 1", "two", "beta", "new", "   12 gamma"]
    assert [text for _, text, _ in built(folder)] == words
    assert [text for _, text, _ in built(folder, "a", "b")] == [*words[:3], "newer", words[4]]


def test_a_later_layer_alone(tmp_path: Path) -> None:
    rows = [("r1", "a", '{ line = "1", witness = " l", lemma = " 1" }'), ("r2", "b", '{ line = "3", dense = true }')]
    rows.append(("r3", "b", '{ line = "5", dense = true }'))
    assert [text for _, text, _ in built(text_of(tmp_path, *rows[1:]), "b")] == ["alpha l", "beta", "12gamma"]
    assert [text for _, text, _ in built(text_of(tmp_path, *rows), "b")] == ["alpha l", "beta", "12gamma"]


def test_a_change_replaces_only_its_fragment(tmp_path: Path) -> None:
    text = load(text_of(tmp_path, ("r", "a", '{ line = "1", witness = " l", lemma = " 1" }')), "t")
    changed = replace(text, rows=(replace(text.rows[0], changes=(Change("5", "gamma", "X = 1"),)),))
    assert build(changed)[-1].text == "  12 X = 1"


@pytest.mark.parametrize("name", programs.TEXTS)
def test_builds_that_share_snapshots_equal_separate_builds(name: str) -> None:
    """Build in two orders, and compare each with a text from which nothing was built before."""
    text = replace(programs.text(name))
    for row in (*text.rows[::3], *text.rows[::-4]):
        gone, lines = built_without(text, row.id)
        alone = replace(text, rows=tuple(r for r in text.rows if r.id not in gone))
        assert lines == build(alone, text.layers)
        shorter = replace(row, changes=row.changes[:-1])
        rows = tuple(shorter if r.id == row.id else r for r in text.rows if r.id not in gone - {row.id})
        assert build(text, text.layers, gone - {row.id}, shorter) == build(replace(text, rows=rows), text.layers)


def test_readings_for_a_table(tmp_path: Path) -> None:
    """Lines are separated by a slash and changes by a bar; a change without a fragment is described."""
    several = ['{ line = "1", witness = " l", lemma = " 1\\ntwo" }', '{ line = "3", after = true, lemma = "new" }']
    others = [
        '{ line = "3", through = "5" }',
        '{ line = "3", through = "5", form = true }',
        '{ line = "5", dense = true }',
    ]
    (row,) = load(text_of(tmp_path, ("r", "a", ", ".join(several + others))), "t").rows
    lines = "(lines 3 to 5)"
    assert row.witness == f" l | (nothing after line 3) | {lines} | {lines} | (line 5, spread out)"
    assert row.lemma == " 1 / two | new | - | (set out as on the form) | (without blanks)"


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        ([("r", "a", '{ line = "1", witness = "nope", lemma = "" }')], "occurs 0 times"),
        ([("r", "a", '{ line = "1", witness = "a", lemma = "" }')], "occurs 2 times"),
        ([("r", "a", '{ line = "2", witness = "a", lemma = "" }')], "line 2 does not exist"),
        ([("r", "c", '{ line = "1", witness = "a", lemma = "" }')], "unknown layer 'c'"),
        ([("r", "a", '{ line = "1", lemma = "x" }')], "needs one of the fields"),
        ([("r", "a", '{ line = "1", witness = " l", lemma = "" }')] * 2, "is used 2 times"),
    ],
)
def test_a_row_that_does_not_fit_is_rejected(tmp_path: Path, rows: list[tuple[str, str, str]], message: str) -> None:
    with pytest.raises(ApparatusError, match=message):
        built(text_of(tmp_path, *rows))


def test_an_unknown_layer_is_rejected(tmp_path: Path) -> None:
    with pytest.raises(ApparatusError, match="has no layer z; it has a, b"):
        built(text_of(tmp_path), "z")
