"""The restorer, and the measurement of its errors."""

import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from emulator.errors import FileError
from modern.edition import programs
from modern.edition.readings import attested
from modern.edition.restorer import restore
from modern.edition.trials import Job, Trial, score
from modern.study.restoration import (
    KINDS,
    ROUND,
    Copy,
    Group,
    _digest,
    blind_restorer,
    damaged_copy,
    listings,
    measure,
    others,
    read_restoration,
    restored_copy,
    rules,
    summary,
)
from tests.support.paths import DATA, ROOT

WEIGHTS = {
    f"{witness}\t{lemma}": count
    for (witness, lemma), count in attested(row for name in programs.TEXTS for row in programs.text(name).rows).items()
}
CARDS = (
    "      DO 10 I=1,N",
    "      X(I)=X(I)+1.",
    "   10 CONTINUE",
    "      PUNCH 20,X(1)",
    "   20 FORMAT(E14.8)",
    "      END",
)


@pytest.mark.parametrize(
    ("card", "damaged", "expected"),
    [
        (0, "      DO l0 I=1,N", ("DO10I=1,N", "certain", "parse")),
        (0, "      DO 10 I#1,N", ("DO10I=1,N", "certain", "parse")),
        (4, "   20 FORMAT(E14.8}", None),
        (2, "   10 \\text{CONTINUE}", ("10CONTINUE", "certain", "parse")),
        # A name that begins with C is not a comment, and prose is a comment that lost its C.
        (1, "      CX#CX+1.", ("CX=CX+1.", "certain", "parse")),
        (1, "      THE SUM OF X, BY J. DOE", ("CTHESUMOFX,BYJ.DOE", "certain", "parse")),
    ],
)
def test_a_card_is_restored_by_its_form(card: int, damaged: str, expected: tuple[str, str, str] | None) -> None:
    cards = [*CARDS[:card], damaged, *CARDS[card + 1 :]]
    (result,) = restore([Job(tuple(cards))], WEIGHTS)
    assert [(r.text, r.certainty, r.ground) for r in result if r.certainty != "abstained"] == [expected] * bool(
        expected
    )
    assert {r.card for r in result} == {card}


def test_sound_cards_and_exchanges_that_only_improve_the_print_are_left_alone() -> None:
    assert restore([Job(CARDS)], WEIGHTS) == [[]]
    for group in (listings(), others(DATA / "period")):
        for cards, trials in zip(group.originals, group.trials, strict=True):
            assert score(cards, trials) == sum(1000 + len(trial.printed) for trial in trials)
    # Two numbers are wrong, and the table corrects one of them, so that the result is still not the printed one.
    cards = ("      X=1.", "      Y=3.", "      PUNCH 20,X", "      PUNCH 20,Y", "   20 FORMAT(F4.1)", "      END")
    trial = Trial((), ("  I.0", "  2.0"))
    assert restore([Job(cards, (trial,))], WEIGHTS) == [[]]


def run_sealed(code: str) -> str:
    """Run code in a process in which the restorer is sealed, and return its last line on standard error."""
    command = [sys.executable, "-c", f"from modern.edition import restorer\nrestorer.seal()\n{code}"]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(command, capture_output=True, text=True, encoding="utf-8", env=environment, cwd=ROOT)
    return (done.stderr.strip().splitlines() or [""])[-1]


@pytest.mark.parametrize(
    ("code", "message"),
    [
        ("from modern.edition import programs; programs.committed('program1')", "may not read program1.f"),
        ("from modern.edition import programs; programs.text('program1')", "may not read program1.toml"),
        ("open('fortran_src/witness/program1.txt')", "may not read program1.txt"),
        ("open('tests/data/period/pi.f')", "may not read pi.f"),
        ("import subprocess; subprocess.run(['cat', 'fortran_src/program1.f'])", "may not use subprocess.Popen"),
    ],
)
def test_a_sealed_process_cannot_read_the_originals(code: str, message: str) -> None:
    assert run_sealed(code) == f"PermissionError: the restorer {message}"


def test_the_restorer_works_where_the_originals_cannot_be_read() -> None:
    """The sealed process gives the same result as the function, so the result depends on the damaged cards alone."""
    jobs = damaged_copy(others(DATA / "period"), "as the OCR", 3)[:2]
    with blind_restorer() as restorer:
        sealed = restorer(jobs)
    assert any(sealed)
    assert sealed == json.loads(json.dumps([[vars_of(r) for r in cards] for cards in restore(jobs, WEIGHTS)]))


def test_an_insertion_that_only_siblings_support_is_probable() -> None:
    cards = (
        "      A1=(X(I2)-X(I1))*Y(I1)+Z(I1)",
        "      B1=(U(I2)-U(I1))*V(I1)+W(I1)",
        "      C1=(R(I2)R(I1))*S(I1)+T(I1)",
        "      R(I1)=S(I2)+T(I2)",
        "      END",
    )
    (result,) = restore([Job(cards)], WEIGHTS)
    assert [(r.card, r.text, r.certainty, r.ground) for r in result] == [
        (2, "C1=(R(I2)-R(I1))*S(I1)+T(I1)", "probable", "sibling")
    ]


def vars_of(restored: object) -> dict[str, object]:
    return {name: getattr(restored, name) for name in ("card", "text", "certainty", "ground")}


def counts(**numbers: int) -> tuple[int, ...]:
    """Return the counts of a copy; each name is the class, the ground and the verdict without blanks."""
    names = ["_".join(kind).strip("_").replace(" ", "") for kind in KINDS]
    assert set(numbers) <= set(names)
    return tuple(numbers.get(name, 0) for name in names)


def test_the_table_counts_errors_with_exact_intervals() -> None:
    copies = [
        Copy("as the OCR", "the listings", 0, 70, counts(certain_parse_right=60, abstained_severalreadings=3)),
        Copy("as the OCR", "g", 1, 40, counts(certain_parse_right=39, certain_print_wrong=1)),
        Copy("signs lost", "g", 0, 9, counts(probable_sibling_right=9)),
    ]
    lines = {line[:3]: line[3:] for line in summary(copies)}
    # Clopper and Pearson's interval for 1 of 100, from their tables: .0003 to .0545.
    assert lines["as the OCR", "certain", "all"] == ("100", "1", "1.00 %", "0.03 to 5.45 %", "0 of 60")
    assert lines["as the OCR", "abstained", "all"][0] == "3"
    assert lines["as the OCR", "damaged", "all"][0] == "110"
    assert lines["signs lost", "probable", "all"][:2] == ("9", "0")


def test_committed_copies_follow_from_the_seed_and_the_present_rules() -> None:
    # One copy of each kind is damaged and restored again.
    copies = {copy.key: copy for copy in read_restoration(ROOT / "docs" / "restoration")}
    group = others(DATA / "period")
    with blind_restorer() as restorer:
        for damage in ROUND:
            assert copies[damage, group.name, 0] == restored_copy(damage, group, 0, restorer)
    head = json.loads((ROOT / "docs" / "restoration" / "copies.jsonl").read_text(encoding="utf-8").splitlines()[0])
    assert head["rules"] == rules()
    assert head["originals"] == _digest((listings(), others(DATA / "period")))


def test_the_committed_copies_are_complete_rounds() -> None:
    """Each kind of damage has the copies of the same rounds, numbered from 0."""
    groups = (listings(), others(DATA / "period"))
    numbers: dict[tuple[str, str], list[int]] = {}
    for damage, group, number in (copy.key for copy in read_restoration(ROOT / "docs" / "restoration")):
        numbers.setdefault((damage, group), []).append(number)
    rounds = {
        len(numbers[damage, g.name]) / k for damage, times in ROUND.items() for g, k in zip(groups, times, strict=True)
    }
    assert len(rounds) == 1
    assert all(sorted(of_group) == list(range(len(of_group))) for of_group in numbers.values())


@pytest.mark.parametrize(
    "line",
    ["{}", "3", '["as the OCR"]', '["as the OCR", "the listings", 0, 1, 5]'],
    ids=["object", "number", "short", "count"],
)
def test_a_file_with_a_line_that_is_no_copy_is_rejected(tmp_path: Path, line: str) -> None:
    period = others(DATA / "period")
    group = Group("one program", period.originals[:1], period.trials[:1])
    measure(tmp_path, [group], 0)
    path = tmp_path / "copies.jsonl"
    head = path.read_text(encoding="utf-8").splitlines()[0]
    path.write_text(f"{head}\n{line}\n", encoding="utf-8")
    with pytest.raises(FileError, match=r"copies\.jsonl: "):
        measure(tmp_path, [group], 0)


def test_a_measurement_continues_where_it_was_interrupted(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setattr("modern.study.restoration.ROUND", {"as the OCR": (2,)})
    period = others(DATA / "period")
    group = Group("one program", period.originals[:1], period.trials[:1])
    copies = measure(tmp_path, [group], 1, 2)
    path = tmp_path / "copies.jsonl"
    complete = path.read_text(encoding="utf-8")
    path.write_text(complete[:-9], encoding="utf-8")
    assert measure(tmp_path, [group], 1) == copies == read_restoration(tmp_path)
    assert path.read_text(encoding="utf-8") == complete
    with pytest.raises(FileError, match="holds copies of other programs or rules"):
        measure(tmp_path, [replace(group, originals=(CARDS,))], 1)


def test_a_folder_without_programs_is_rejected(tmp_path: Path) -> None:
    with pytest.raises(FileError, match=r"has no file whose name ends with \.f$"):
        others(tmp_path)
