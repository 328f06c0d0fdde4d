"""The emulator's profile ``ibm1962`` compared with what IBM's library of 1962 was measured to read and write."""

from __future__ import annotations

from pathlib import Path

import pytest

from modern.bench.ibm1962.arithmetic import emulated
from modern.bench.ibm1962.emulated import emulate
from modern.bench.ibm1962.measured import Measured, load, same


@pytest.mark.parametrize("verb", ["PUNCH", "READ", "TYPE"])
def test_the_emulator_reads_and_writes_as_the_library_was_measured(verb: str) -> None:
    vectors = [vector for vector in load() if vector.statement.verb == verb]
    assert len(vectors) > 30
    wrong = [vector for vector in vectors if not agrees(vector)]
    assert wrong == []


def test_the_emulator_calculates_as_the_library_was_measured() -> None:
    """Each line has an operation, FAC, the other operand, the library's result and its error code."""
    lines = Path("tests/data/vectors/ibm1962_operations.tsv").read_text(encoding="ascii").splitlines()
    measured = [line.split("\t") for line in lines]
    assert len({operation for operation, *_ in measured}) > 12
    assert [row for row in measured if emulated((row[0], row[1], row[2])) != (row[3], row[4])] == []


def agrees(vector: Measured) -> bool:
    return same(emulate(vector.statement, cards=vector.cards), vector.outcome)
