"""The restorer, and the measurement of its errors."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from emulator.errors import FileError
from modern.edition import programs
from modern.edition.readings import attested
from modern.edition.restorer import restore
from modern.edition.trials import Job, score
from modern.study.restoration import (
    blind_restorer,
    damaged_copy,
    listings,
    others,
    read_restoration,
    rows_of,
    summary,
    write_restoration,
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
    ],
)
def test_a_card_is_restored_by_its_form(card: int, damaged: str, expected: tuple[str, str, str] | None) -> None:
    cards = [*CARDS[:card], damaged, *CARDS[card + 1 :]]
    (result,) = restore([Job(tuple(cards))], WEIGHTS)
    assert [(r.text, r.certainty, r.ground) for r in result if r.certainty != "abstained"] == [expected] * bool(
        expected
    )
    assert {r.card for r in result} == {card}


def test_sound_cards_are_left_alone() -> None:
    assert restore([Job(CARDS)], WEIGHTS) == [[]]


def test_the_printed_results_hold_for_the_originals() -> None:
    for group in (listings(), others(DATA / "period")):
        for cards, trials in zip(group.originals, group.trials, strict=True):
            assert score(cards, trials) == sum(1000 + len(trial.printed) for trial in trials)


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
    jobs = damaged_copy(others(DATA / "period"), 3)[:2]
    with blind_restorer() as restorer:
        sealed = restorer(jobs)
    assert any(sealed)
    assert sealed == json.loads(json.dumps([[vars_of(r) for r in cards] for cards in restore(jobs, WEIGHTS)]))


def vars_of(restored: object) -> dict[str, object]:
    return {name: getattr(restored, name) for name in ("card", "text", "certainty", "ground")}


def test_the_table_counts_errors_with_exact_intervals(tmp_path: Path) -> None:
    row = {
        "group": "g",
        "copy": "0",
        "program": "1",
        "card": "1",
        "damaged": "yes",
        "class": "certain",
        "ground": "parse",
    }
    rows = [{**row, "verdict": "right"}] * 99 + [
        {**row, "verdict": "wrong"},
        {**row, "class": "abstained", "verdict": ""},
    ]
    lines = {line[:2]: line[2:] for line in summary(rows)}
    # Clopper and Pearson's interval for 1 of 100, from their tables: .0003 to .0545.
    assert lines["certain", "all"] == ("100", "100", "1", "1.00 %", "0.03 to 5.45 %")
    assert lines["abstained", "all"][1] == "1"
    assert "0.03 to 5.45 %" in write_restoration(tmp_path, rows)
    assert read_restoration(tmp_path) == rows


def test_the_committed_cards_are_those_of_the_first_copies() -> None:
    """The cards that were damaged follow from the seed; the restoration of one copy is repeated."""
    rows = read_restoration(ROOT / "docs" / "restoration")
    group = others(DATA / "period")
    with blind_restorer() as restorer:
        again = list(rows_of(group, 0, restorer))
    assert [row for row in rows if (row["group"], row["copy"]) == (group.name, "0")] == again


def test_a_folder_without_programs_is_rejected(tmp_path: Path) -> None:
    with pytest.raises(FileError, match=r"has no file whose name ends with \.f$"):
        others(tmp_path)
