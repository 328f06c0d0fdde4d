"""Every valid form of statement, and every rejected form with its card and column."""

import pytest

from emulator.language import tree
from emulator.language.parser import MAX_NESTING, Parsed, parse
from emulator.language.tree import Place
from tests.support.deckwork import diagnostics, source


def parsed(*lines: str) -> Parsed:
    return parse(source(*lines))


def body(line: str) -> tree.Body:
    result = parsed(line)
    assert not result.diagnostics
    return result.statements[0].body


def test_assignment_keeps_columns() -> None:
    statement = body("  X(I) = A + 2.*B")
    assert isinstance(statement, tree.Assignment)
    assert statement.target == tree.Reference("X", (tree.Reference("I", (), Place(1, 5)),), Place(1, 3))
    assert isinstance(statement.value, tree.Sum)
    ((sign, product),) = statement.value.rest
    assert sign == "+"
    assert isinstance(product, tree.Product)
    assert product.first == tree.Number("2.", Place(1, 14))


def expression(text: str) -> str:
    """Return an expression with all its parentheses."""
    statement = body(f"X={text}")
    assert isinstance(statement, tree.Assignment)
    return shown(statement.value)


def shown(node: tree.Expression) -> str:
    match node:
        case tree.Number(text, _):
            return text
        case tree.Reference(name, arguments, _):
            return name + (f"({','.join(map(shown, arguments))})" if arguments else "")
        case tree.Power(base, exponent, _):
            return f"[{shown(base)}**{shown(exponent)}]"
        case tree.Product(first, rest, _):
            return f"[{shown(first)}{''.join(op + shown(part) for op, part in rest)}]"
        case tree.Sum(minus, first, rest, _):
            return f"[{'-' * minus}{shown(first)}{''.join(op + shown(part) for op, part in rest)}]"


@pytest.mark.parametrize(
    ("text", "meaning"),
    [
        ("A", "A"),
        ("+A", "A"),
        ("-A", "[-A]"),
        ("((A))", "A"),
        ("A+B-C", "[A+B-C]"),
        ("A*B/C*D", "[A*B/C*D]"),
        ("A+B*C", "[A+[B*C]]"),
        ("-A*B+C", "[-[A*B]+C]"),
        ("-A**2", "[-[A**2]]"),
        ("A*B**C", "[A*[B**C]]"),
        ("(A**B)**C", "[[A**B]**C]"),
        ("A/(-B)", "[A/[-B]]"),
        ("A-(B-C)", "[A-[B-C]]"),
        ("(A+B)*(C+D)", "[[A+B]*[C+D]]"),
        ("SQRTF(A*B)", "SQRTF([A*B])"),
        ("Y(I,J+1)", "Y(I,[J+1])"),
        ("1.E-5+.5E2+2.E+3", "[1.E-5+.5E2+2.E+3]"),
        ("1.E5+B", "[1.E5+B]"),
    ],
)
def test_expressions(text: str, meaning: str) -> None:
    """C26-5619 p. 14, 19: ** before * and / before + and -, left to right."""
    assert expression(text) == meaning


def test_control_statements() -> None:
    assert body("GO TO 10") == tree.GoTo(10)
    assert body("GO TO (10, 20), I") == tree.ComputedGoTo((10, 20), tree.Reference("I", (), Place(1, 17)))
    assert body("GO TO (10, 20) I") == tree.ComputedGoTo((10, 20), tree.Reference("I", (), Place(1, 16)))
    statement = body("IF (A-B) 1, 2, 3")
    assert isinstance(statement, tree.If)
    assert statement.labels == (1, 2, 3)
    assert body("IF (SENSE SWITCH 3) 1, 2") == tree.IfSwitch(3, (1, 2))
    assert body("CONTINUE") == tree.Continue()
    assert (body("PAUSE"), body("PAUSE 12")) == (tree.Pause(""), tree.Pause("12"))
    assert (body("STOP"), body("STOP 7")) == (tree.Stop(""), tree.Stop("7"))
    assert body("E N D") == tree.End()


def test_do() -> None:
    statement = body("DO 10 I=1,N,2")
    assert isinstance(statement, tree.Do)
    assert (statement.label, statement.variable.name) == (10, "I")
    assert [shown(b) for b in (statement.first, statement.last) + ((statement.step,) if statement.step else ())] == [
        "1",
        "N",
        "2",
    ]
    plain = body("DO 10 I=1,N")
    assert isinstance(plain, tree.Do)
    assert plain.step is None


def test_dimension_format_and_assignment_to_a_name_like_do() -> None:
    statement = body("DIMENSION X(51), A(4,5)")
    assert statement == tree.Dimension((("X", (51,), Place(1, 11)), ("A", (4, 5), Place(1, 18))))
    statement = body("5 FORMAT(2H= ,I4)")
    assert isinstance(statement, tree.Format)
    assert statement.text.rstrip() == "(2H= ,I4)"
    # ``DO10I`` is a name of five characters.
    statement = body("DO 10 I=1")
    assert isinstance(statement, tree.Assignment)
    assert statement.target.name == "DO10I"


@pytest.mark.parametrize("verb", ["READ", "ACCEPT", "PUNCH", "PRINT", "TYPE"])
def test_input_output(verb: str) -> None:
    assert body(f"{verb} 5") == tree.InputOutput(verb, 5, ())
    statement = body(f"{verb} 5, A, X(I), (B, (Y(I,J), J=1,3), I=1,N,2)")
    assert isinstance(statement, tree.InputOutput)
    assert [type(item) for item in statement.items] == [tree.Reference, tree.Reference, tree.Loop]
    loop = statement.items[2]
    assert isinstance(loop, tree.Loop)
    assert loop.variable.name == "I"
    assert isinstance(loop.items[1], tree.Loop)
    assert shown(loop.step) == "2" if loop.step else False


REFUSED = [
    ("X", 1, 0, "not a statement of this FORTRAN"),
    ("      CALL SUB(X)", 7, 0, "CALL belongs to FORTRAN II"),
    ("SUBROUTINE X", 1, 0, "SUBROUTINE belongs to FORTRAN II"),
    ("X=", 2, 0, "ends too soon"),
    ("X=A+", 4, 0, "ends too soon"),
    ("X=A B)", 6, 0, "')' is not allowed"),
    ("X=(A", 4, 0, "ends too soon"),
    ("X=A+*B", 5, 0, "'*' is not allowed"),
    ("X=A/-B", 5, 0, "'-' is not allowed"),
    ("X=A**B**C", 7, 0, "'**' is not allowed"),
    ("X=A$", 4, 0, "$"),
    ("X=1E5", 4, 0, "is not allowed"),
    ("5=X", 2, 0, "is not allowed"),
    ("X+Y=Z", 2, 0, "is not allowed here; the form is variable = expression"),
    ("ABCDEF=1.", 1, 6, "ABCDEF has more than five characters"),
    ("X=A+LENGTH", 5, 6, "LENGTH has more than five characters"),
    ("I=12345", 3, 0, "12345 has more than four digits"),
    ("GO TO", 5, 0, "ends too soon"),
    ("GO TO X", 1, 0, "an assigned number belongs to FORTRAN II"),
    ("GO TO 0", 7, 0, "0 is not between 1 and 9999"),
    ("GO TO (1,2)", 11, 0, "ends too soon"),
    ("GO TO 10000", 7, 0, "10000 is not between 1 and 9999"),
    ("10000 X=1.", 7, 0, "10000 is not between 1 and 9999"),
    ("IF (A) 1,2", 10, 0, "ends too soon"),
    ("IF (A), 1,2,3", 7, 7, "',' is not allowed"),
    ("IF (A,B) 1,2,3", 6, 0, "',' is not allowed"),
    ("IF (A) 1,2,,3", 12, 0, "',' is not allowed"),
    ("IF A 1,2,3", 1, 0, "not a statement"),
    ("IF (SENSE SWITCH) 1,2", 17, 7, "')' is not allowed"),
    ("IF (SENSE SWITCH 1), 1,2", 20, 7, "',' is not allowed"),
    ("IF (SENSE SWITCH 5) 1,2", 18, 7, "no sense switch 5"),
    ("DO 10 I=1,", 10, 8, "ends too soon"),
    ("DO 10 I=1,2,3,4", 14, 8, "',' is not allowed"),
    (" CONTINUE 5", 11, 0, "'5' is not allowed"),
    ("DIMENSION X(5),", 15, 9, "ends too soon"),
    ("DIMENSION X", 11, 9, "ends too soon"),
    ("DIMENSION X(I)", 13, 9, "'I' is not allowed"),
    ("DIMENSION X(2,3,4)", 11, 9, "X has more than two dimensions"),
    ("READ", 4, 13, "ends too soon"),
    ("PUNCH 5,,A", 9, 13, "',' is not allowed"),
    ("PUNCH 5,3", 9, 13, "'3' is not allowed"),
    ("PUNCH 5,(A(I),I=1)", 18, 13, "')' is not allowed"),
    ("X=" + "(" * 61 + "A", 1, 0, f"nested more than {MAX_NESTING} deep"),
]


@pytest.mark.parametrize(("line", "column", "number", "expected"), REFUSED, ids=[line[:30] for line, *_ in REFUSED])
def test_invalid_statement_is_rejected_with_column_and_type(line: str, column: int, number: int, expected: str) -> None:
    """Error types of C26-5619 p. 56: 6 name, 7 sense switch, 8 DO, 9 DIMENSION, 13 input and output."""
    result = parsed("C  FIRST CARD", line)
    (message,) = result.diagnostics
    assert (message.card, message.column, message.number) == (2, column, number)
    assert expected in message.message
    assert not result.statements


@pytest.mark.parametrize(
    ("line", "number"),
    [
        ("DO 10, I=1,5", 8),
        ("READ X", 13),
        ("10 FORMT(I4)", 10),
        ("READ", 13),
        ("DIMENSION X(5),", 9),
        ("IF (SENSE SWITCH) 1,2", 7),
        ("IF (A), 1,2,3", 7),
        ("10 FORMAT I4", 11),
    ],
)
def test_error_types_of_page_56(line: str, number: int) -> None:
    (message,) = parsed(line).diagnostics
    assert message.number == number


def test_cards_without_a_statement_are_reported_and_parsing_continues() -> None:
    (message,) = parsed("XYZ " + "ABCDEFGHIJ" * 6).diagnostics
    assert message.message == "not a statement of this FORTRAN: XYZ" + ("ABCDEFGHIJ" * 4)[:37]
    (message,) = parsed("100").diagnostics
    assert "expected a statement after the statement number" in message.message
    result = parsed("X=", "Y=1.", "Z==1.", "END")
    assert [d.card for d in result.diagnostics] == [1, 3]
    assert len(result.statements) == 2


@pytest.mark.parametrize(("first", "last"), [("100", ""), ("DIMENSION X(", "     1)"), ("X=1.E", ""), ("GO TO ", "")])
def test_number_may_continue_over_seventy_cards(first: str, last: str) -> None:
    cards = [first, *["     1" + "2" * 66] * 70, last]
    assert diagnostics(*cards, "END")
