"""The time table: counts follow from the object code, seconds from counts and measured times."""

import pytest

from emulator.language import objectcode as op
from emulator.machine import timing
from emulator.objectdeck.extent import code_positions
from tests.support.deckwork import machine


def timed(*lines: str, data: tuple[str, ...] = ()) -> timing.Timing:
    made = machine(*lines, data=data)
    return timing.measure(made.program, made.run())


def test_costs_are_those_of_the_traces_and_the_reference_card() -> None:
    # From traces of IBM's subroutines: FMP 18.3, FDV 54, FSB 12.4, FAD 8.9 to 10.1.
    assert timing.COSTS["FMP"].milliseconds == 18.3
    assert timing.COSTS["FDV"].milliseconds == 54.0
    assert timing.COSTS["FSB"].milliseconds == 12.4
    assert 8.9 <= timing.COSTS["FAD"].milliseconds <= 10.1
    assert not any(timing.COSTS[name].estimated for name in ("FAD", "FSB", "FMP", "FDV"))
    # Reference card X26-5743-2: 250 and 125 cards a minute, 10 characters a second.
    assert (timing.READER_SECONDS, timing.PUNCH_SECONDS, timing.TYPEWRITER_SECONDS) == (0.24, 0.48, 0.1)
    assert set(timing.COSTS) == set(op.NAMES)
    assert set(timing.FIELD_COSTS) == {kind + way for kind in "EFI" for way in "<>"}
    assert set(timing.RECORD_COSTS) == {*"<>"}


def test_stops_lists_and_statements_are_counted() -> None:
    assert dict(timed("A=2.", "END").operations)["STOP"] == 1
    assert "STOP" not in dict(timed("5 READ 1,N", "1 FORMAT(I4)", "GO TO 5", data=("   1",)).operations)
    operations = dict(timed("A=2.", "PUNCH 1,A,(A,I=1,5),A", "1 FORMAT(7E10.3)", "END").operations)
    assert (operations["BEGIN"], operations["ITEM"], operations["DOTEST"], operations["FINISH"]) == (1, 7, 5, 1)
    table = timed("DO 5 I=1,7", "J=I", "5 K=J", "END")
    assert table.statements == ((0, 1), (1, 7), (2, 7), (3, 1))


def test_operations_are_counted_in_every_pass_of_a_loop() -> None:
    operations = dict(timed("A=2.", "DO 5 I=1,7", "B=A*A", "5 C=B/A+A", "END").operations)
    del operations["STOP"]
    assert operations == {
        "SEND": 1,
        "TRANSMIT": 1,
        "TOFIX": 1,
        "FMFIX": 1,
        "TOFAC": 14,
        "FMP": 7,
        "FDV": 7,
        "FAD": 7,
        "FMFAC": 14,
        "DOTEST": 7,
    }


def test_times_are_counts_times_costs_and_functions_are_estimates() -> None:
    table = timed("A=2.", "DO 5 I=1,7", "B=A*A", "5 C=B/A+A", "END")
    expected = sum(timing.COSTS[name].milliseconds * count for name, count in table.operations) / 1000
    assert table.processor_time.seconds == pytest.approx(expected)
    assert table.time.seconds == pytest.approx(expected)
    (row,) = (row for row in timed("A=SIN(1.)", "END").processor if row.cause == "floating point")
    assert row.estimated
    lines = ["READ 1,I", "PUNCH 1,I", "PUNCH 1,I", "TYPE 2", "1 FORMAT(I4)", "2 FORMAT(9HSOME TEXT)", "END"]
    rows = {row.cause: row for row in timed(*lines, data=("   2",)).devices}
    assert [row.count for row in rows.values()] == [1, 2, 10]
    assert [row.time.seconds for row in rows.values()] == pytest.approx([0.24, 0.96, 1.0])


def test_subscripts_records_and_conversion_are_counted() -> None:
    lines = ["DIMENSION X(3),A(2,2)", "READ 1,I,B", "X(I)=B", "A(I,I)=B", "PUNCH 1,I,B", "1 FORMAT(I4,E14.8)", "END"]
    table = timed(*lines, data=("   2 .10000000E+01",))
    rows = {row.cause: row for row in table.processor}
    assert rows["subscripts"].count == 2
    assert rows["subscripts"].time.seconds == pytest.approx(0.0059)
    # A card of two numbers read and written: the records, and the conversion of E14.8 and I4.
    assert rows["number conversion"].count == 6
    assert rows["number conversion"].time.seconds == pytest.approx(0.022 + 0.319 + 0.150 + 0.041 + 0.080 + 0.032)
    assert not any(row.estimated for row in rows.values())


def test_bounds_apply_the_systematic_error_of_each_cause_and_none_to_devices() -> None:
    table = timed("A=2.", "PUNCH 1,A", "1 FORMAT(E14.8)", "END")
    conversion = next(row.time.seconds for row in table.processor if row.cause == "number conversion")
    rest = table.processor_time.seconds - conversion
    low, high = (
        factors[0] * conversion + factors[1] * rest
        for factors in zip(timing.CONVERSION_MODEL, timing.MODEL, strict=True)
    )
    processor, total = table.processor_time, table.time
    assert (processor.low, processor.high, total.low, total.high) == pytest.approx((low, high, low + 0.48, high + 0.48))
    assert low < processor.seconds < high


def test_the_length_grows_with_the_program() -> None:
    """Lengths in the object deck of 1962: a call takes 12 positions, a subscript 24, and a character two."""

    def length(*lines: str) -> int:
        return code_positions(machine(*lines, "END").program)

    assert length("A=B*C") - length("A=B") == 12
    assert length("1 FORMAT(6HABCDEF)") - length("1 FORMAT(3HABC)") == 6
    plain = length("DIMENSION X(5)", "I=1", "A=X(1)")
    assert length("DIMENSION X(5)", "I=1", "A=X(I)") - plain == 24
