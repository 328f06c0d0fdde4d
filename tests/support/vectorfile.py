"""The loader of ``vectors/*.tsv``: one vector a line, tabs between id, profiles, operation, operands, result, source.

A seventh column, where it is filled, names a fault of the emulator: that vector is expected to fail.  ``#``
begins a comment line, ``_`` stands for a blank, ``|`` for the end of a card.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import pytest

from tests.support.paths import VECTORS

FOLDER = VECTORS


@dataclass(frozen=True)
class Vector:
    id: str
    profile: str
    operation: str
    operands: str
    result: str
    source: str

    @property
    def setup(self) -> list[str]:
        """The operands as statements, one a card."""
        return [card.strip() for card in self.operands.split(";") if card.strip()]

    @property
    def cards(self) -> tuple[str, ...]:
        """The result as cards."""
        return tuple(card.replace("_", " ").rstrip() for card in self.result.split("|"))


def load(name: str) -> list[Any]:
    """The vectors of a file as parameters of a test, one for each profile of each line."""
    found: list[Any] = []
    seen: set[str] = set()
    for row, line in enumerate((FOLDER / f"{name}.tsv").read_text(encoding="ascii").splitlines(), 1):
        if not line or line.startswith("#"):
            continue
        columns = line.split("\t")
        assert len(columns) in (6, 7), f"{name}.tsv:{row}: {len(columns)} columns"
        assert columns[0] not in seen, f"{name}.tsv:{row}: {columns[0]} stands there twice"
        assert columns[5].strip(), f"{name}.tsv:{row}: no source"
        seen.add(columns[0])
        marks = [pytest.mark.xfail(strict=True, reason=f"BUG: {columns[6]}")] if columns[6:] else []
        for profile in columns[1].split(","):
            vector = Vector(columns[0], profile, *columns[2:6])
            found.append(pytest.param(vector, id=f"{vector.id}-{profile}", marks=marks))
    return found
