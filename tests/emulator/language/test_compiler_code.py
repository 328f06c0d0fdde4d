"""Object code: the patterns disassembled from a compiler of the time, and the DO of IBM's compiler."""

import pytest

from emulator.language import objectcode as op
from emulator.objectdeck.extent import code_positions
from tests.support.deckwork import code, program

T1, T2 = "temporary 0", "temporary 1"


@pytest.mark.parametrize(
    ("statement", "expected"),
    [
        ("D=A-A*B", ["TOFAC A", "FMP B", "FSBR A", "FMFAC D"]),
        ("D=A*B-A", ["TOFAC A", "FMP B", "FSB A", "FMFAC D"]),
        ("D=A*B-A*B", ["TOFAC A", "FMP B", f"FMFAC {T1}", "TOFAC A", "FMP B", f"FSBR {T1}", "FMFAC D"]),
        ("D=(-1.)*A", ["TOFAC constant 1.", "FMP A", "RSGN", "FMFAC D"]),
        ("D=A*(-1.)", ["TOFAC A", "FMP constant 1.", "RSGN", "FMFAC D"]),
        ("D=-A*B", ["TOFAC A", "FMP B", "RSGN", "FMFAC D"]),
        ("D=A-B-B", ["TOFAC A", "FSB B", "FSB B", "FMFAC D"]),
        ("D=A*B+C*D", ["TOFAC A", "FMP B", f"FMFAC {T1}", "TOFAC C", "FMP D", f"FAD {T1}", "FMFAC D"]),
        ("R=A-B*C-D", ["TOFAC B", "FMP C", "FSB A", "FAD D", "RSGN", "FMFAC R"]),
        ("R=(A-D*C)-B", ["TOFAC D", "FMP C", "FSB A", "FAD B", "RSGN", "FMFAC R"]),
        ("R=A-(-B)", ["TOFAC A", "FAD B", "FMFAC R"]),
        ("R=(-A)*B-C", ["TOFAC A", "FMP B", "FAD C", "RSGN", "FMFAC R"]),
        ("R=A-(B-C*D)", ["TOFAC C", "FMP D", "FSB B", "FAD A", "FMFAC R"]),
        ("R=A/(B-C*D)", ["TOFAC C", "FMP D", "FSB B", "FDVR A", "RSGN", "FMFAC R"]),
        ("R=-A*B+C*D", ["TOFAC A", "FMP B", f"FMFAC {T1}", "TOFAC C", "FMP D", f"FSB {T1}", "FMFAC R"]),
        (
            "R=(A+B)-(C-D*E)*A",
            [*("TOFAC A", "FAD B", f"FMFAC {T1}", "TOFAC D", "FMP E", "FSB C", "FMP A", f"FAD {T1}", "FMFAC R")],
        ),
        ("R=A-SQRT(B-C*D)", ["TOFAC C", "FMP D", "FSBR B", "FUNCTION", "FSBR A", "FMFAC R"]),
        ("I=A-B*C", ["TOFAC B", "FMP C", "FSB A", "FIX", "RSGX", "FMFIX I"]),
        ("R=-I", ["TOFIX I", "FLOAT", "RSGN", "FMFAC R"]),
        ("I=K-L*M-J", ["TOFIX L", "XMP M", "XSB K", "XAD J", "RSGX", "FMFIX I"]),
    ],
)
def test_code_has_the_order_and_the_deferred_signs_of_pdq(statement: str, expected: list[str]) -> None:
    assert code(statement, "END")[:-1] == expected


@pytest.mark.parametrize(
    ("statement", "expected"),
    [
        ("D=A+B*C", ["TOFAC B", "FMP C", "FAD A", "FMFAC D"]),
        ("D=A/(B-C)", ["TOFAC B", "FSB C", "FDVR A", "FMFAC D"]),
        ("D=A*B/C", ["TOFAC A", "FMP B", "FDV C", "FMFAC D"]),
        ("D=-A-B", ["TOFAC A", "FAD B", "RSGN", "FMFAC D"]),
        ("D=(-A)*(-B)", ["TOFAC A", "FMP B", "FMFAC D"]),
        ("D=A**2", ["TOFAC A", "FMP A", "FMFAC D"]),
        ("D=A**3", ["TOFAC A", "POWERX constant 3", "FMFAC D"]),
        ("D=(A+B)**2", ["TOFAC A", "FAD B", f"FMFAC {T1}", f"FMP {T1}", "FMFAC D"]),
        ("D=A**J", ["TOFAC A", "POWERX J", "FMFAC D"]),
        ("D=A**B", ["TOFAC B", "POWER A", "FMFAC D"]),
        ("D=SQRT(A)", ["TOFAC A", "FUNCTION", "FMFAC D"]),
        ("D=A", ["SEND A", "TRANSMIT D"]),
        ("D=-A", ["TOFAC A", "RSGN", "FMFAC D"]),
        ("I=J-K*L", ["TOFIX K", "XMP L", "XSBR J", "FMFIX I"]),
        ("I=J/(K+L)", ["TOFIX K", "XAD L", "XDVR J", "FMFIX I"]),
        ("I=-J", ["TOFIX J", "RSGX", "FMFIX I"]),
        ("I=A", ["TOFAC A", "FIX", "FMFIX I"]),
        ("A=I", ["TOFIX I", "FLOAT", "FMFAC A"]),
        ("A=5/3", ["TOFIX constant 5", "XDV constant 3", "FLOAT", "FMFAC A"]),
    ],
)
def test_expressions(statement: str, expected: list[str]) -> None:
    assert code(statement, "END")[:-1] == expected


def test_temporaries_are_reused() -> None:
    made = program("D=A*B+C*D", "E=A*B+C*D", "END")
    assert [e.name for e in made.storage.entries if e.kind == "temporary"] == [T1, T2]
    words = code("D=(A+B)*(C+D)-(A-B)*(C-D)", "END")
    assert words.count(f"FMFAC {T1}") == 1
    assert "FMFAC temporary 2" in words
    assert words[-3:-1] == [f"FSBR {words[-3].removeprefix('FSBR ')}", "FMFAC D"]


def test_temporaries_are_those_of_the_deck_of_1962() -> None:
    """TIC3D, card 51: the products have the numbers 1, 3 and 4, and the sums in parentheses 0 and 2 without a field."""
    made = program("M=16*(K1-1)+4*(J3-1)+J2-10*J3", "END")
    names = [e.name for e in made.storage.entries]
    assert names == [
        *("M", "constant 16", "K1", "constant 1", "temporary 1", "constant 4", "J3"),
        *("temporary 3", "J2", "constant 10", "temporary 4"),
    ]
    assert [word for word in code("M=16*(K1-1)+4*(J3-1)+J2-10*J3", "END") if "temporary" in word] == [
        *("FMFIX temporary 1", "XAD temporary 1", "FMFIX temporary 3", "XSBR temporary 3")
    ]


def test_subscripts_become_addresses_or_minus_one() -> None:
    assert code("DIMENSION X(5),A(2,3)", "X(4)=A(2,3)", "END")[:-1] == ["SEND A(2,3)", "TRANSMIT X(4)"]
    made = program("DIMENSION X(5)", "A=X(I)", "GO TO 5", "5 END")
    assert [i.subscript for i in made.code if i.operation == op.SEND] == [0]
    assert {i.subscript for i in made.code if i.operation != op.SEND} == {-1}


@pytest.mark.parametrize(
    ("subscript", "factor", "addend"),
    [("I", 1, 0), ("I+1", 1, 1), ("I-2", 1, -2), ("2*I", 2, 0), ("3*I+4", 3, 4), ("3*I-4", 3, -4)],
)
def test_variable_subscripts(subscript: str, factor: int, addend: int) -> None:
    """C26-5619 p. 18."""
    made = program("DIMENSION X(5)", f"A=X({subscript})", "END")
    (found,) = made.subscripts
    assert (found.c1, found.o1, found.rows, found.columns) == (factor, addend, 5, 0)
    assert made.storage.name_of(found.v1) == "I"


@pytest.mark.parametrize(("statement", "more"), [("A=X(2)", 0), ("A=X(I)", 24), ("A=Y(I,J)", 60), ("A=Y(I,1)", 24)])
def test_a_variable_subscript_takes_the_positions_of_the_deck_of_1962(statement: str, more: int) -> None:
    """Two instructions compute the address.  A second variable needs a multiplication, a flag and an addition."""
    plain, longer = (program("DIMENSION X(5),Y(2,2)", line, "END") for line in ("A=B", statement))
    assert code_positions(longer) - code_positions(plain) == more


def test_do_tests_at_the_bottom() -> None:
    """IBM's object code 10504-10912: set, body, then step and compare."""
    made = program("DO 5 I=2,N,3", "5 A=B", "END")
    names = [op.NAMES[i.operation] for i in made.code if i.operation != op.COUNT]
    assert names == ["TOFIX", "FMFIX", "SEND", "TRANSMIT", "DOTEST", "STOP"]
    ((variable, step, limit, back),) = made.loops
    assert [made.storage.name_of(a) for a in (variable, step, limit)] == ["I", "constant 3", "N"]
    assert made.code[back].operation == op.COUNT
    assert made.code[back + 1].operation == op.SEND


def test_instructions_hold_the_numbers_of_loops_and_branches() -> None:
    made = program("DO 5 I=1,2", "DO 5 J=1,3", "5 A=B", "END")
    tests = [i.address for i in made.code if i.operation == op.DOTEST]
    assert [made.storage.name_of(made.loops[t][0]) for t in tests] == ["J", "I"]
    made = program("5 IF(A)5,6,7", "6 CONTINUE", "7 STOP", "END")
    (targets,) = made.branches
    assert [made.line_at(t).label for t in targets] == [5, 6, 7]
    assert [getattr(op, name) for name in op.NAMES] == list(range(op.STOP + 1))
