"""The decks that two compilers of the time ran (tests/data/machine_runs/README.md), compared card for card."""

from pathlib import Path

import pytest

from emulator.language.cards import read_deck
from emulator.machine.result import Options
from modern.edition import programs
from modern.thesis.job import HullRun, run_hull
from tests.support.paths import MACHINE_RUNS

RUNS = MACHINE_RUNS
FOLDERS = sorted(path for path in RUNS.iterdir() if path.is_dir())


def lines(path: Path) -> list[str]:
    """Return the lines of a file without blank lines at its end, which the record of the runs omits."""
    found = [line.rstrip() for line in path.read_text(encoding="utf-8").split("\n")]
    return trimmed(found)


def trimmed(found: list[str]) -> list[str]:
    while found and not found[-1]:
        found = found[:-1]
    return found


def run(folder: Path) -> HullRun:
    return run_hull(read_deck(str(folder / "deck.cards")), programs.program, Options(limit=200_000))


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_every_card_and_typed_line_is_that_of_the_machine(folder: Path) -> None:
    steps = {step.name: step.result for step in run(folder).steps}
    expected = {path.name for path in folder.iterdir()} - {"deck.cards"}
    assert {name.partition(".")[0] for name in expected} == set(steps)
    for name in expected:
        program, _, device = name.partition(".")
        if device == "cards":
            assert trimmed(list(steps[program].punched)) == lines(folder / name)
        elif device == "typewriter":
            assert list(steps[program].typed) == lines(folder / name)
        else:
            assert device == "endless"
            assert steps[program].ending.kind == "limit"
            assert "the last statements form a loop on" in steps[program].ending.message
