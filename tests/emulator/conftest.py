"""The fixture that runs a test once for each engine."""

from __future__ import annotations

import pytest

from tests.support.deckwork import ENGINES, MakeMachine


@pytest.fixture(params=sorted(ENGINES))
def engines(request: pytest.FixtureRequest) -> MakeMachine:
    """One engine after the other: what makes a machine that runs on it."""
    return ENGINES[request.param]
