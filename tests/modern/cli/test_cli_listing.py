"""A listing: cards with messages, and next to each statement the figures of a run."""

from pathlib import Path

import pytest

from emulator.language.cards import deck_from_lines, read_deck
from emulator.language.compiler import compile_deck
from emulator.machine.divergence import diverge
from emulator.machine.machine import Machine
from emulator.machine.timing import measure, shares
from emulator.numbers import numbers
from modern.edition import programs
from tests.support.commands import call
from tests.support.deckwork import program
from tests.support.paths import ROOT

EXAMPLES = ROOT / "transcripts" / "chapter6"
MINE = ["      A=1.", "      DO 5 I=1,3", "    5 A=A/3.", "      PUNCH 9,A", "    9 FORMAT(E14.8)", "      END"]


@pytest.fixture
def mine(tmp_path: Path, monkeypatch) -> Path:
    """Change to a folder with a program and a deck that the program does not read."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "my.f").write_text("\n".join(MINE) + "\n")
    (tmp_path / "one.deck").write_text("1\n")
    return tmp_path


def columns(line: str) -> tuple[str, str, str, str, str]:
    return line[:5].strip(), line[5:14].strip(), line[14:21].strip(), line[21:27].strip(), line[29:]


def test_a_listing_without_a_deck_has_cards_and_warnings(mine: Path, capsys) -> None:
    reads = [*MINE[:3], "      READ 9,A", *MINE[4:]]
    (mine / "reads.f").write_text("\n".join(reads) + "\n")
    code, out, err = call(capsys, "listing", "reads.f")
    assert (code, err) == (0, "")
    assert out.splitlines() == ["reads.f: 6 cards", *(f"{n:5d}  {card}" for n, card in enumerate(reads, 1))]
    # A program that reads no data runs without a deck.
    assert call(capsys, "listing", "my.f")[1] == call(capsys, "listing", "my.f", "one.deck")[1]
    (mine / "bad.f").write_text("      A=1.\n      A=(B\n      END\n")
    code, out, _ = call(capsys, "listing", "bad.f", "one.deck")
    assert code == 2
    lines = out.splitlines()
    assert lines[2] == "    2        A=(B"
    assert lines[3].lstrip().startswith("^ error: ")
    assert call(capsys, "check", "bad.f")[1].splitlines()[0].endswith(lines[3].partition("error: ")[2])


def test_a_listing_with_a_deck_has_counts_times_and_digits(mine: Path, capsys) -> None:
    code, out, err = call(capsys, "listing", "my.f", "one.deck")
    assert (code, err) == (0, "")
    lines = out.splitlines()
    assert lines[0] == "my.f: 7 statements in 0.6 (0.4 to 0.6) s of processor time on a 1620"
    assert lines[1] == "digits lost, of 8.0: truncating against exact"
    rows = [columns(line) for line in lines[3:]]
    assert [row[4] for row in rows] == MINE
    assert [row[1] for row in rows] == ["1", "1", "3", "1", "", "1"]
    assert sum(float(row[2]) for row in rows if row[2]) == pytest.approx(100.0, abs=0.3)
    # 1/27, truncated to eight digits each time, is .37037036E-01: 8 + log10(1.04E-8/.37) digits are lost.
    assert [row[3] for row in rows] == ["0.0", "0.0", "0.4", "", "", ""]


@pytest.mark.parametrize(("name", "deck"), [("program2", "example4"), ("program3", "example5")])
def test_the_figures_agree_with_profile_and_diverge(capsys, name: str, deck: str) -> None:
    path = str(EXAMPLES / deck / "program1.punch")
    code, out, _ = call(capsys, "listing", name, path)
    assert code == 0
    made = programs.program(name)
    result = Machine(made, read_deck(path)).run()
    timing = measure(made, result)
    rows = {int(row[0]): row for row in map(columns, out.splitlines()[3:]) if row[0]}
    assert {made.statements[index].place.card: times for index, times in timing.statements} == {
        card: int(row[1]) for card, row in rows.items() if row[1] not in ("", "0")
    }
    assert sum(time.seconds for time in shares(made, result)) == pytest.approx(timing.processor_time.seconds)
    found = diverge(made, read_deck(path), numbers("truncating"), numbers("exact"))
    assert {loss.line.place.card: f"{loss.worst:.1f}" for loss in found.losses} == {
        card: row[3] for card, row in rows.items() if row[3]
    }
    assert f"in {timing.processor_time} of" in out.splitlines()[0]


def test_shares_attribute_time_to_each_statement() -> None:
    made = program("A=2.", "DO 5 I=1,10", "5 B=A*A", "READ 9,K,A", "9 FORMAT(I4,E10.2)", "END")
    result = Machine(made, deck_from_lines("d", ["   1 1.0"])).run()
    found = [time.seconds for time in shares(made, result)]
    assert found[2] > 10 * 0.0183
    assert found[3] == pytest.approx((22 + 41 + 150) / 1000)  # a card, an I and an E field
    assert sum(found) == pytest.approx(measure(made, result).processor_time.seconds)


def test_a_program_with_accept_is_listed_with_an_operator_file(mine: Path, capsys) -> None:
    (mine / "ask.f").write_text("    5 ACCEPT 9,A\n      IF(A)5,6,5\n    6 STOP\n    9 FORMAT(E14.8)\n      END\n")
    (mine / "lines").write_text("ENTER 1.5\nENTER 0.0\n")
    code, out, err = call(capsys, "listing", "ask.f", "one.deck", "--operator=lines", "-o", "list.txt")
    assert (code, out, err) == (0, "", "")
    assert [columns(line)[1] for line in (mine / "list.txt").read_text().splitlines()[3:]] == ["2", "2", "1", "", "0"]
    code, out, err = call(capsys, "listing", "ask.f", "one.deck")
    assert (code, out) == (2, "")
    assert "no typed line is left for ACCEPT" in err
    code, out, err = call(capsys, "listing", "ask.f", "one.deck", "--operator")
    assert (code, out, err.count("\n")) == (2, "", 1)


def test_against_none_and_a_run_that_ends_early(mine: Path, capsys) -> None:
    (mine / "loop.f").write_text("    1 X=X1\n      GO TO 1\n      END\n")
    code, out, err = call(capsys, "listing", "loop.f", "one.deck", "--against", "none", "--limit", "101")
    assert code == 1
    loop = "the last statements form a loop on cards 1 to 2, statement 1"
    assert err == f"hull1620: loop.f: stopped after 101 statements; {loop}\n"
    assert [columns(line)[1:4:2] for line in out.splitlines()[2:]] == [("51", ""), ("50", ""), ("0", "")]
    assert "digits" not in out


def test_the_listing_of_a_built_in_program_is_its_compiled_text(capsys) -> None:
    lines = call(capsys, "listing", "program1")[1].splitlines()[1:]
    assert [line[7:] for line in lines] == [card.text for card in programs.deck("program1").cards]
    assert compile_deck(deck_from_lines("again", [line[7:] for line in lines])).statements


def test_a_deck_may_be_an_example_by_name(capsys) -> None:
    named = call(capsys, "listing", "program1", "example4", "--against", "none")
    assert named == call(
        capsys, "listing", "program1", str(EXAMPLES / "example4" / "program1.deck"), "--against", "none"
    )
    assert named[0] == 0
