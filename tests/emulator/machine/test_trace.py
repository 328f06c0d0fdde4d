"""The trace: each statement with its card, number, text, and the value that it stored or tested."""

import io

from emulator.machine.trace import Tracer
from tests.support.deckwork import machine


def traced(*lines: str, data: tuple[str, ...] = (), limit: int = 1000, arithmetic: str = "truncating") -> list[str]:
    file = io.StringIO()
    made = machine(*lines, data=data, limit=limit, arithmetic=arithmetic)
    tracer = Tracer(file)
    tracer.watch(made.program, made)
    made.run()
    tracer.close()
    return file.getvalue().splitlines()


def values(*lines: str, **setting: object) -> list[str]:
    """Return the value at the end of each line of the trace."""
    return [line[52:].strip() for line in traced(*lines, **setting)[1:]]


def test_values_copies_lists_and_loops_are_traced() -> None:
    assert traced("DIMENSION X(3)", "I=2", "10 X(I)=1.5*2.", "IF(X(2))20,20,20", "20 IF(I-5)30,30,30", "30 STOP") == [
        "* deck.f: card, number, statement, value",
        "   2       I=2                                       I = 2",
        "   3    10 X(I)=1.5*2.                               X(2) = .30000000E+01",
        "   4       IF(X(2))20,20,20                          .30000000E+01",
        "   5    20 IF(I-5)30,30,30                           -3",
        "   6    30 STOP",
    ]
    assert values("A=1.", "B=A", "J=B", "C=J", "D=-A", "Z=0.", "Y=-Z", "END")[:7] == [
        "A = .10000000E+01",
        "B = .10000000E+01",
        "J = 1",
        "C = .10000000E+01",
        "D = -.10000000E+01",
        "Z = .00000000E-99",
        "Y = -.00000000E-99",
    ]
    assert values("DIMENSION X(3)", "X(1)=X(2)", "END")[0] == "X(1) = undefined"
    assert values("READ 1,I,A", "1 FORMAT(I2,E14.8)", "END", data=(" 5 .20000000E+01",))[0] == (
        "I = 5, A = .20000000E+01"
    )
    assert values("DO 5 I=1,3", "5 K=I+I", "END") == ["I = 1", "K = 2", "K = 4", "K = 6", ""]
    assert len(values("5 K=1", "GO TO 5", "END", limit=7)) == 7


def test_a_tracer_does_not_change_the_run() -> None:
    lines = ["K=0", "5 K=K+1", "IF(K-50)5,6,6", "6 PUNCH 1,K", "1 FORMAT(I4)", "END"]
    plain = machine(*lines).run()
    made = machine(*lines)
    tracer = Tracer(io.StringIO())
    tracer.watch(made.program, made)
    assert made.run() == plain
