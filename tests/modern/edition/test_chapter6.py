"""The printed examples of chapter 6 (thesis p. 103-115) card by card, and verdicts that can fail."""

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from emulator.language.cards import deck_from_text
from emulator.language.compiler import compile_deck
from emulator.language.objectcode import Program
from modern.edition import chapter6, programs
from modern.edition.chapter6 import prints
from modern.edition.reproduce import DIFFERENT, EXACT, ORDER, SPACING, Report, compare, reproduce, summary


@pytest.fixture(scope="module")
def reports() -> dict[tuple[int, str, int, str], Report]:
    return {(r.example, r.state, r.program, r.device): r for r in reproduce()}


PRINTED = [(1, 1), (2, 1), (3, 1), (4, 1), (4, 2), (5, 1), (5, 3), (6, 1), (6, 3)]


@pytest.mark.parametrize(("example", "program"), PRINTED, ids=[f"example_{e}_program_{p}_cards" for e, p in PRINTED])
def test_printed(reports: dict[tuple[int, str, int, str], Report], example: int, program: int) -> None:
    report = reports[example, "examples", program, "punch"]
    assert report.produced == report.printed
    assert report.verdict.kind == EXACT


def test_printed_devices_are_judged_and_their_cards_counted(reports: dict[tuple[int, str, int, str], Report]) -> None:
    judged = {(e, p, d) for e, s, p, d in reports if s == "examples"}
    assert judged == {(p.example, p.program, p.device) for e in range(1, 7) for p in prints(e)}
    assert {(e, p) for e, p, d in judged if d == "punch"} == set(PRINTED)
    for report in reports.values():
        if report.device == "typewriter":
            assert report.stated
            assert report.produced == report.printed
    all_reproduced, exact, reordered, different = summary(reports.values())
    assert all_reproduced
    assert (exact, reordered, different) == (29, 7, 0)


LISTED = {(2, 1): EXACT, (3, 1): EXACT}


@pytest.mark.parametrize(("example", "program"), PRINTED)
def test_through_the_listing(reports: dict[tuple[int, str, int, str], Report], example: int, program: int) -> None:
    """The listing reproduces examples 2 and 3 exactly, and the others in another order."""
    verdict = reports[example, "listing", program, "punch"].verdict
    assert verdict.kind == LISTED.get((example, program), ORDER)
    assert (verdict.kind == ORDER) == bool(verdict.same)


# Every verdict can fail.


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a copy of the folder of chapter 6, which replaces the committed folder."""
    copy = Path(shutil.copytree(str(chapter6.chapter6_folder()), tmp_path / "chapter6"))
    monkeypatch.setattr(chapter6, "chapter6_folder", lambda: copy)
    return copy


@pytest.mark.parametrize(("example", "program"), PRINTED)
def test_one_changed_digit_of_a_print_changes_its_verdict(folder: Path, example: int, program: int) -> None:
    path = folder / f"example{example}" / f"program{program}.punch"
    text = path.read_text()
    at = max(i for i, c in enumerate(text) if c == "E" and text[i - 8 : i].isdigit()) - 8
    digit = str((int(text[at]) + 1) % 10)
    path.write_text(text[:at] + digit + text[at + 1 :])
    verdicts = {(r.program, r.device): r.verdict for r in reproduce((example,)) if r.state == "examples"}
    assert verdicts[program, "punch"].kind == DIFFERENT
    assert len(verdicts[program, "punch"].differences) == 1
    assert not summary(reproduce((example,)))[0]


def test_a_lost_minus_of_a_zero_changes_the_verdict(folder: Path) -> None:
    path = folder / "example6" / "program3.punch"
    assert "-.00000000E-99" in path.read_text()
    path.write_text(path.read_text().replace("-.00000000E-99", " .00000000E-99", 1))
    kinds = {r.program: r.verdict.kind for r in reproduce((6,)) if r.state == "examples" and r.device == "punch"}
    assert kinds[3] == DIFFERENT
    assert not summary(reproduce((6,)))[0]


def test_a_changed_heading_changes_the_verdict(folder: Path) -> None:
    path = folder / "example4" / "program2.punch"
    path.write_text(path.read_text().replace("BOUNDARY POINTS", "BOUNDARY PAINTS"))
    kinds = {r.program: r.verdict.kind for r in reproduce((4,)) if r.state == "examples" and r.device == "punch"}
    assert kinds[2] == DIFFERENT


CARDS = [
    ("program1_examples", "E(LL)=2.", "E(LL)=5.", 5),
    ("program2", "NETC=NETC+1", "NETC=NETC+2", 4),
    ("program3", "B(I)=B(I)*(-1.)", "B(I)=B(I)*(-2.)", 6),
    ("program3", "19 FORMAT (I3,1H,,", "19 FORMAT (I3,1H;,", 5),
]


@pytest.mark.parametrize(("name", "card", "changed", "example"), CARDS)
def test_one_changed_card_of_a_program_changes_a_verdict(name: str, card: str, changed: str, example: int) -> None:
    text = programs.committed(name).text()
    assert text.count(card) == 1
    program = compile_deck(deck_from_text(f"{name}.f", text.replace(card, changed.replace(";", "."))))
    load: Callable[[str], Program] = lambda requested: program if requested == name else programs.program(requested)  # noqa: E731
    all_reproduced, _, _, _ = summary(r for r in reproduce((example,), load) if r.state == "examples")
    assert not all_reproduced


def test_a_difference_in_spacing_has_a_verdict_apart() -> None:
    verdict = compare([" N=   3", "", "X  Y"], ["N= 3", "X Y"], final=True, oriented=False)
    assert verdict.kind == SPACING
    assert (verdict.numbers, verdict.words, verdict.cards, verdict.blank) == (1, 3, 2, 1)


def test_the_same_points_with_a_wrong_plane_differ() -> None:
    plane = " .10000000E+01 .00000000E-99 .00000000E-99-.10000000E+01"
    wrong = " .10000000E+01 .00000000E-99 .00000000E-99-.20000000E+01"
    point_a = " .10000000E+01 .10000000E+01 .00000000E-99"
    point_b = " .10000000E+01 .30000000E+01 .00000000E-99"
    printed = [plane, "   2 3", point_a, point_b]
    assert compare(printed, [plane, "   2 3", point_b, point_a], False, True).kind == ORDER
    assert compare(printed, [wrong, "   2 3", point_b, point_a], False, True).kind == DIFFERENT
