"""The emulator's profile ``ibm1962`` compared with what IBM's library of 1962 was measured to read and write."""

from __future__ import annotations

import pytest

from modern.bench.ibm1962.emulated import emulate
from modern.bench.ibm1962.measured import Measured, load, same


@pytest.mark.parametrize("verb", ["PUNCH", "READ", "TYPE"])
def test_the_emulator_reads_and_writes_as_the_library_was_measured(verb: str) -> None:
    vectors = [vector for vector in load() if vector.statement.verb == verb]
    assert len(vectors) > 30
    wrong = [vector for vector in vectors if not agrees(vector)]
    assert wrong == []


def agrees(vector: Measured) -> bool:
    return same(emulate(vector.statement, cards=vector.cards), vector.outcome)
