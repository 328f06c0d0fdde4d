"""The loader of ``vectors/*.tsv``: one vector per line, with id, profiles, operation, operands, result and source.

The columns are separated by tabs.  ``#`` begins a comment line, ``_`` is a blank, and ``|`` is the end of a card.
"""

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
        """The operands as statements, one per card."""
        return [card.strip() for card in self.operands.split(";") if card.strip()]

    @property
    def cards(self) -> tuple[str, ...]:
        """The result as cards."""
        return tuple(card.replace("_", " ").rstrip() for card in self.result.split("|"))


def load(name: str) -> list[Any]:
    """Return the vectors of a file as parameters of a test, one per profile of each line."""
    parameters: list[Any] = []
    ids: set[str] = set()
    for row, line in enumerate((FOLDER / f"{name}.tsv").read_text(encoding="ascii").splitlines(), 1):
        if not line or line.startswith("#"):
            continue
        columns = line.split("\t")
        assert len(columns) == 6, f"{name}.tsv:{row}: {len(columns)} columns"
        assert columns[0] not in ids, f"{name}.tsv:{row}: {columns[0]} occurs twice"
        assert columns[5].strip(), f"{name}.tsv:{row}: no source"
        ids.add(columns[0])
        for profile in columns[1].split(","):
            vector = Vector(columns[0], profile, *columns[2:])
            parameters.append(pytest.param(vector, id=f"{vector.id}-{profile}"))
    return parameters
