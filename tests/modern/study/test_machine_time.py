"""Machine time agrees with runs on IBM's library of 1962, in a simulator that adds the times of instructions."""

import csv

import pytest

from emulator.machine import timing
from emulator.machine.machine import Machine
from modern.bench.ibm1962 import times
from modern.bench.ibm1962.objectdecks import OPTIONS
from tests.support.paths import ROOT

with (ROOT / times.FILE).open(encoding="utf-8", newline="") as file:
    RUNS = {(row["deck"], row["program"]): float(row["library"]) for row in csv.DictReader(file)}
# The processor seconds of PDQ FORTRAN's code, another compiler, for example 6 (simulator, the same formulas).
PDQ = 79.8


@pytest.fixture(scope="module")
def modelled() -> dict[tuple[str, str], timing.Timing]:
    """Return the time tables of the runs with few statements, by deck and program."""
    tables = {}
    for deck_name, name, program, deck, _ in times.subjects(tuple(each for each in times.SETS if each[1] < 20)):
        tables[deck_name, name] = timing.measure(program, Machine(program, deck, OPTIONS).run())
    return tables


def test_times_on_the_library_lie_within_the_bounds(modelled: dict[tuple[str, str], timing.Timing]) -> None:
    outside = {
        key: (table.processor_time, RUNS[key])
        for key, table in modelled.items()
        if not table.processor_time.low <= RUNS[key] <= table.processor_time.high
    }
    assert outside == {}
    assert len(modelled) > 30


def test_modelled_times_agree_with_the_runs(modelled: dict[tuple[str, str], timing.Timing]) -> None:
    # Program 3 computes most; its times are reproduced to two per cent.
    ratios = [RUNS[key] / table.processor_time.seconds for key, table in modelled.items() if key[1] == "program3"]
    assert 0.98 < min(ratios) < max(ratios) < 1.02
    assert 1 < modelled["example 6", "program3"].processor_time.seconds / PDQ < 2
    assert len(RUNS) > 60
    assert {f"{family}, {n} points" for family, n in times.SETS} <= {deck for deck, _ in RUNS}
