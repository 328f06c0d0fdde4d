"""The number of points that fit a machine, by the estimated length of the object program."""

from __future__ import annotations

import pytest

from modern.edition import programs
from modern.thesis.capacity import array_lengths, data_positions, largest


def test_51_to_56_points_fit_40000_positions() -> None:
    """Thesis p. 3: for the 1620 with 40,000 digits the maximum value for N is 51."""
    points = min(largest(programs.program(name), 40_000) for name in programs.TEXTS)
    assert 51 <= points <= 56


def test_the_corrected_tables_need_60000_positions() -> None:
    program = programs.with_layers("program3", ("corrected",))
    assert largest(program, 40_000) < 51 <= largest(program, 60_000)
    assert array_lengths(program)[-1] == "4N-11"


@pytest.mark.parametrize("layers", [(), ("corrected",)])
@pytest.mark.parametrize("name", programs.TEXTS)
def test_for_51_points_the_data_have_their_listed_size(name: str, layers: tuple[str, ...]) -> None:
    program = programs.with_layers(name, layers)
    assert data_positions(program, 51) == program.storage.fields * 10
