"""The fixture that runs a test once for each engine."""

import pytest

from tests.support.deckwork import ENGINES, MakeMachine


@pytest.fixture(params=sorted(ENGINES))
def engines(request: pytest.FixtureRequest) -> MakeMachine:
    """Return a function that makes a machine, once for each engine."""
    return ENGINES[request.param]
