"""Machine time agrees, within a factor of two, with another compiler's code in a simulator."""

import pytest

from emulator.language.cards import deck_from_lines
from emulator.machine.machine import Machine
from emulator.machine.timing import measure
from modern.edition import chapter6, programs

# example, program, processor seconds of PDQ FORTRAN's code on a Model 1, cards read.
# Example 3 is not among them: its 2.4 s are mostly the setting of arrays to zero, which that deck added.
MEASURED = [
    (1, 1, 11.1, 4),
    (2, 1, 11.5, 10),
    (4, 1, 11.8, 9),
    (4, 2, 25.7, 10),
    (5, 1, 27.2, 16),
    (5, 3, 52.2, 21),
    (6, 1, 19.6, 11),
    (6, 3, 79.8, 16),
]


@pytest.mark.parametrize(("example", "number", "seconds", "cards"), MEASURED)
def test_processor_time_agrees_with_the_simulator(example: int, number: int, seconds: float, cards: int) -> None:
    if number == 1:
        deck = chapter6.input_deck(example)
    else:
        (middle,) = (p.lines for p in chapter6.prints(example) if p.program == 1 and p.device == "punch")
        deck = deck_from_lines("middle", middle)
    program = programs.program(f"program{number}")
    result = Machine(program, deck).run()
    timing = measure(program, result)
    assert seconds / 2 <= timing.processor_seconds <= seconds * 2
    assert result.cards_read == cards
    assert [row.count for row in timing.devices[:2]] == [cards, len(result.punched)]
    assert timing.devices[0].seconds == pytest.approx(cards * 0.24)
    assert timing.devices[1].seconds == pytest.approx(len(result.punched) * 0.48)
