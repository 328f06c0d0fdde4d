"""Published and measured results as FORTRAN programs: the lines of ``vectors/*.tsv``, each with its source."""

import re
from decimal import Decimal

import pytest

from emulator.language.cards import deck_from_lines
from emulator.machine.machine import Machine
from emulator.machine.result import Options
from emulator.numbers import numbers
from tests.support.deckwork import MakeMachine, number, program
from tests.support.vectorfile import Vector, load


def started(engines: MakeMachine, vector: Vector, lines: list[str], data: tuple[str, ...] = ()) -> Machine:
    return engines(
        program(*lines), deck_from_lines("data", data), Options(numbers=numbers(vector.profile), limit=9_999)
    )


def numbers_on(card: str) -> str:
    """Return the columns of a card before the sequence number of IBM's library, with its exponent -00 as +00."""
    return card[:72].strip().replace("E-00", "E+00")


def check_value(engines: MakeMachine, vector: Vector, field: str) -> None:
    """Run ``D=operation`` or ``M=operation`` after the operands, and compare the card and the error code."""
    expected, _, code = vector.result.partition(" ")
    target = "D" if "." in expected else "M"
    lines = [*vector.setup, f"{target}={vector.operation}", f"PUNCH 1,{target}", f"1 FORMAT({field})", "END"]
    result = started(engines, vector, lines).run()
    assert result.ending.kind == "end"
    assert [numbers_on(card) for card in result.punched] == [expected]
    assert [error.code for error in result.errors] == ([code] if code else [])
    typed = (f"ERROR {code}",) if code and vector.profile == "ibm1962" else ()
    assert result.typed == typed


@pytest.mark.parametrize("vector", load("arithmetic"))
def test_arithmetic(engines: MakeMachine, vector: Vector) -> None:
    check_value(engines, vector, "E14.8" if "." in vector.result else "I5")


@pytest.mark.parametrize("vector", load("zeros"))
def test_sign_of_zero(engines: MakeMachine, vector: Vector) -> None:
    check_value(engines, vector, "E14.8")


@pytest.mark.parametrize("vector", load("fixed"))
def test_fixed_point_and_conversion(engines: MakeMachine, vector: Vector) -> None:
    check_value(engines, vector, "E14.8" if "." in vector.result else "I5")


@pytest.mark.parametrize("vector", load("digits"))
def test_any_number_of_digits(engines: MakeMachine, vector: Vector) -> None:
    machine = started(engines, vector, [*vector.setup, f"D={vector.operation}", "END"])
    assert machine.run().ending.kind == "end"
    assert number(machine, "D") == vector.result


@pytest.mark.parametrize("vector", load("do"))
def test_do(engines: MakeMachine, vector: Vector) -> None:
    label = re.match(r"DO *(\d+) *I *=", vector.operation)[1]
    lines = ["K=0", *vector.setup, vector.operation, f"{label} K=K+1", "PUNCH 99,K,I", "99 FORMAT(I3,I4)", "END"]
    cards = started(engines, vector, lines).run().punched
    assert [numbers_on(card).split() for card in cards] == [vector.result.split()]


@pytest.mark.parametrize("vector", load("if"))
def test_if(engines: MakeMachine, vector: Vector) -> None:
    lines = [*vector.setup, f"IF({vector.operation})11,12,13", "11 K=1", "GO TO 20", "12 K=2", "GO TO 20", "13 K=3"]
    cards = started(engines, vector, [*lines, "20 PUNCH 99,K", "99 FORMAT(I2)", "END"]).run().punched
    assert [numbers_on(card) for card in cards] == [vector.result]


@pytest.mark.parametrize("vector", load("output"))
def test_output(engines: MakeMachine, vector: Vector) -> None:
    names = [statement.split("=")[0] for statement in vector.setup]
    field = vector.operation if vector.operation.startswith("(") else f"({vector.operation})"
    lines = [*vector.setup, ",".join(["PUNCH 1", *names]), f"1 FORMAT{field}", "END"]
    assert started(engines, vector, lines).run().punched == vector.cards


@pytest.mark.parametrize("vector", load("input"))
def test_input(engines: MakeMachine, vector: Vector) -> None:
    name = "N" if vector.operation.startswith("I") else "A"
    lines = [f"READ 1,{name}", f"1 FORMAT({vector.operation})", "END"]
    machine = started(engines, vector, lines, (vector.operands.replace("_", " "),))
    assert machine.run().ending.kind == "end"
    assert number(machine, name) == (vector.result if name == "N" else floating(vector.result))


def floating(text: str) -> str:
    """Return a decimal of at most eight digits as :func:`deckwork.number` writes it, by :mod:`decimal`."""
    sign, digits, power = Decimal(text).as_tuple()
    assert isinstance(power, int)
    lead = "".join(map(str, digits)).lstrip("0")
    if not lead:
        return "-0" if sign else "0"
    return f"{'-' * sign}.{lead.ljust(8, '0')}E{len(lead) + power:+03d}"
