"""Statements, functions and fields of other FORTRANs are reported once, and the rest of the deck is checked."""

import pytest

from emulator.errors import Diagnostic
from emulator.language.expressions import LIBRARY
from emulator.language.foreign import FOREIGN_FIELDS, FOREIGN_STATEMENTS, identify, suggest_function
from emulator.language.parser import parse
from emulator.language.statements import classify
from tests.support.deckwork import diagnostics, errors, source, within

F = "90 FORMAT(5E14.8)"


def only(*lines: str) -> Diagnostic:
    (message,) = errors(*lines, F, "END")
    return message


STATEMENTS = [
    ("      CALL SUB(A,B)", "CALL belongs to FORTRAN II"),
    ("      CALL EXIT", "CALL EXIT is STOP"),
    ("      COMMON A,B(10)", "COMMON belongs to FORTRAN II"),
    (" COMMON/BLOCK/A,B(10)", "COMMON belongs to FORTRAN II"),
    ("EQUIVALENCE(A,B(1)),(C,D)", "EQUIVALENCE belongs to FORTRAN II"),
    ("RETURN", "RETURN belongs to FORTRAN II"),
    ("EXTERNAL F", "EXTERNAL belongs to FORTRAN IV"),
    ("REAL I,J", "a declaration of types belongs to FORTRAN IV"),
    ("INTEGER X(10)", "a declaration of types belongs to FORTRAN IV"),
    ("REAL*8 X", "a declaration of types"),
    ("DOUBLE PRECISION X", "a declaration of types"),
    ("LOGICAL L", "a declaration of types"),
    (" COMPLEX Z", "a declaration of types"),
    ("IMPLICIT REAL(A-Z)", "IMPLICIT belongs to FORTRAN IV"),
    ("DATA A,B/1.,2./", "DATA belongs to FORTRAN IV"),
    ("DATA(A(I),I=1,3)/1.,2.,3./", "DATA belongs to FORTRAN IV"),
    ("NAMELIST/N/A,B", "NAMELIST"),
    ("PROGRAM MAIN", "PROGRAM"),
    ("ASSIGN 5 TO N", "ASSIGN belongs to FORTRAN II"),
    ("GO TO N,(5,6)", "GO TO to an assigned number belongs to FORTRAN II"),
    ("IF(SENSE LIGHT 1)5,6", "SENSE LIGHT belongs to FORTRAN II"),
    ("SENSE LIGHT 1", "SENSE LIGHT belongs to FORTRAN II"),
    ("IF ACCUMULATOR OVERFLOW 5,6", "a test of overflow"),
    ("IF DIVIDE CHECK 5,6", "a test of overflow"),
    ("IF(A.GT.B) GO TO 5", "a logical IF belongs to FORTRAN IV"),
    ("IF(A.GT.B) X=1.", "a logical IF belongs to FORTRAN IV"),
    ("IF(L) STOP", "a logical IF belongs to FORTRAN IV"),
    ("IF((L)) STOP", "a logical IF belongs to FORTRAN IV"),
    ("IF(A.EQ.1.E5.AND.B.LT.2.)X(1)=A(2)", "a logical IF belongs to FORTRAN IV"),
    ("L=A.GT.B.OR.C.LE.D", "a logical expression belongs to FORTRAN IV"),
    ("FREQUENCY 30(1,2,1)", "FREQUENCY"),
    ("ACCEPT TAPE 90,A", "input and output by paper tape"),
    ("PUNCH TAPE 90,A", "input and output by paper tape"),
    ("READ INPUT TAPE 5,90,A", "magnetic tape"),
    ("WRITE OUTPUT TAPE 6,90,A", "magnetic tape"),
    ("REWIND 3", "magnetic tape"),
    ("END FILE 3", "magnetic tape"),
    ("DEFINE DISK(10,100)", "the disk belongs to FORTRAN II-D"),
    ("RECORD(I)A,B", "the disk belongs to FORTRAN II-D"),
    ("FETCH(I)A,B", "the disk belongs to FORTRAN II-D"),
    ("READ(5,90)A,(B,I=1,3)", "input and output by a unit's number belongs to FORTRAN IV"),
    ("WRITE(6,90)", "input and output by a unit's number belongs to FORTRAN IV"),
    ("PRINT, A, B", "input and output without a FORMAT belongs to GOTRAN"),
    ("READ A, B", "input and output without a FORMAT belongs to GOTRAN"),
    ("ACCEPT, A", "input and output without a FORMAT belongs to GOTRAN"),
    ("PRINT *, A", "input and output without a FORMAT"),
    ("REREAD 90,A", "REREAD"),
    ("*LIST PRINTER", "a control card"),
    ("$IBFTC", "a control card"),
]


@pytest.mark.parametrize(("line", "words"), STATEMENTS, ids=[line.strip() for line, _ in STATEMENTS])
def test_foreign_statement_gives_exactly_one_message(line: str, words: str) -> None:
    message = only(line)
    assert (message.card, message.column) == (1, len(line) - len(line.lstrip()) + 1)
    assert words in message.message


def test_every_foreign_statement_has_an_example() -> None:
    tried = {word for line, _ in STATEMENTS if (word := identify(classify(t := line.replace(" ", "")), t))}
    assert {word.name for word in FOREIGN_STATEMENTS} - {word.name for word in tried} == {
        "SUBROUTINE",
        "FUNCTION",
        "BLOCK DATA",
        "ENTRY",
    }


@pytest.mark.parametrize("line", ["IF(A)5,6", "READ", "DO 5 I=", "X=A+", "IF=(", "GO TO", "DATA=+", "WRIT(6,90)A"])
def test_plain_syntax_error_is_not_taken_for_a_foreign_statement(line: str) -> None:
    (message,) = errors(line, "END")
    assert " belongs to " not in message.message


@pytest.mark.parametrize(
    "line", ["COMMON=1.", "CALL=2.", "DATA=3.", "IF=4", "REAL=5.", "DATA(1)=2.", "FIND(I)=3.", "READ=1.", "RETUR=2."]
)
def test_foreign_keywords_may_be_names(line: str) -> None:
    """No word is reserved: a foreign keyword counts only if the statement has no meaning in this FORTRAN."""
    lines = ("DIMENSION DATA(2),FIND(3)", "I=1", " " + line.replace("COMMON", "COMMN"), "END")
    assert errors(*lines) == () if "DATA=" not in line else len(errors(*lines)) == 1


def test_repeated_foreign_statements_give_one_message_with_all_cards() -> None:
    lines = ["  CALL A(X)", "Y=1.", "  CALL B", "5   CALL C(Y,Z)", "GO TO 5"]
    message = only(*lines)
    assert (message.card, message.message[-21:]) == (1, "(also on cards 3, 4)"[-21:].rjust(21))
    many = only(*["  CALL A(X)"] * 9)
    assert many.message.endswith("(also on cards 2, 3, 4, 5 and 4 more)")
    message = only("F(X)=X**2+1.", "ROOTF(A,B)=A/B", "Y=F(2.)+ROOTF(Y,F(Y))", "PUNCH 90,Y")
    assert message.message.startswith("a statement function belongs to FORTRAN II; write its expression")
    assert message.message.endswith("(also on card 2)")


SUBPROGRAMS = [
    "      SUBROUTINE SUB(A,N)",
    "      DIMENSION A(N)",
    "      COMMON /X/Q",
    "      DO 5 I=1,N",
    "    5 A(I)=ABSF(A(I))+",
    "      IF(Q.LT.0.)RETURN",
    "    7 FORMAT(A4)",
    "      RETURN",
    "      END",
]


def test_subprograms_give_one_message_and_the_cards_around_are_checked() -> None:
    program = ["5 X=1.", "GO TO 6", "6 STOP", "END"]
    assert [d.card for d in errors(*program, *SUBPROGRAMS)] == [5]
    assert [d.card for d in errors(*SUBPROGRAMS, *program)] == [1]
    (message,) = errors(*program, *SUBPROGRAMS, *SUBPROGRAMS)
    assert message.message.endswith("the cards from this one to its END are skipped (also on card 14)")
    found = errors("X=A+I", "END", *SUBPROGRAMS, "Y=2.")
    assert [(d.card, d.number) for d in found] == [(1, 5), (3, 0)]
    assert "BLOCK DATA belongs to FORTRAN IV" in only("BLOCK DATA", "DATA X/1./", "END").message
    assert "ENTRY belongs to FORTRAN IV" in only("ENTRY SUB(X)").message


@pytest.mark.parametrize(
    ("after", "first", "messages"),
    [
        (["  1.0  2.0", "X=A+I", "5 FORMAT(A4)", "  CALL EXIT", "END"], 4, ["cards 4 to 8 follow END"]),
        (["", "", "     5", "C", ""], 6, ["cards 6 to 8 follow END"]),
        (["1.", "||||", "2."], 4, ["cards 4 to 4 follow END", "a control card of a monitor follows END"]),
        (["?? JOB"], 0, ["a control card of a monitor follows END"]),
        (["", "C     END"], 0, []),
    ],
)
def test_data_and_control_cards_after_the_program_are_distinguished(after, first, messages) -> None:
    parsed = parse(source("READ 90,X", F, "END", *after))
    assert [card.number for card in parsed.data[:1]] == [first] * bool(first)
    assert [d.message.partition(":")[0].partition(";")[0] for d in parsed.diagnostics] == messages
    assert all(d.warning for d in parsed.diagnostics)


@pytest.mark.parametrize(
    "opening", ["FUNCTION G(X)", "REAL FUNCTION G(X)", "INTEGER FUNCTION G(X)", "      FUNCTION G(I)"]
)
def test_function_defined_in_the_deck_may_be_used(opening: str) -> None:
    (message,) = errors("Y=1.", "X=G(Y)+G(2.)*3.", "END", opening, "G=X", "RETURN", "END")
    assert (message.card, "FUNCTION belongs to FORTRAN II" in message.message) == (4, True)


@pytest.mark.parametrize("line", ["X(I)=2.", "X(1)=2.", "X(I+1)=2."])
def test_element_of_an_undeclared_array_is_not_a_statement_function(line: str) -> None:
    assert only("I=1", line).message == "X is not an array (no DIMENSION before this card)"


def test_names_and_functions_of_foreign_statements_are_reported_once() -> None:
    found = errors("  COMMON A(10),B", "REAL I", "X=A(1)+I", "A(2)=I*2.", "C=B+J", "Z=Q(2)", F, "END")
    assert [(d.card, d.number) for d in found] == [(1, 0), (2, 0), (5, 5), (6, 0)]
    first, second = errors("X=ABSF(Y)", "Z=SQR(X)+ABSF(ABSF(X))", "PUNCH 90,(X,I=1,2)", F, "END")
    known = "; the functions are SIN, COS, ATAN, EXP, LOG and SQRT; "
    assert first.message.startswith(f"ABSF is neither an array nor a library function{known}for ABSF write IF (X)")
    assert first.message.endswith("(also on card 2)")
    assert (second.card, second.column) == (2, 3)
    assert second.message.endswith(known + "for SQR write SQRT")
    lines = ["READ 1,X", "1 FORMAT(10A4)", "2 FORMAT(I2,A1)", "3 FORMAT(1PE14.8)", "4 FORMAT('TEXT')", "5 FORMAT(3A1)"]
    found = errors(*lines, "END")
    assert [(d.card, d.number) for d in found] == [(2, 11), (4, 11), (5, 11)]
    assert found[0].message == FOREIGN_FIELDS["A"] + " (also on cards 3, 6)"
    assert [d.message for d in found[1:]] == [FOREIGN_FIELDS["P"], FOREIGN_FIELDS["'"]]


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("ABS", "for ABS write IF (X) n1, n2, n2 with X=-X as statement n1 and CONTINUE as n2"),
        ("XABSF", "for XABSF write IF (X)"),
        ("ALOG", "for ALOG write LOG"),
        ("ALOG10", "for ALOG10 write LOG(X)/2.3025851"),
        ("ARCTAN", "for ARCTAN write ATAN"),
        ("TANF", "for TANF write SIN(X)/COS(X)"),
        ("FLOATF", "for FLOATF write A=I"),
        ("SQTR", "is SQRT meant?"),
        ("SINE", "is SIN meant?"),
        ("GAMMA", "and SQRT"),
        ("X", "and SQRT"),
        ("LO", "and SQRT"),
    ],
)
def test_unknown_function_gets_a_suggestion(name: str, words: str) -> None:
    assert suggest_function(name, LIBRARY).endswith(words) or words.endswith("IF (X)")
    assert words in suggest_function(name, LIBRARY)


HOLLERITH = [
    ("(4HTOTAL,I4)", 2, "4H ends within its text; 5H would fit"),
    ("(1HX = ,F4.1)", 2, "1H ends within its text; 4H would fit"),
    ("(7HTOTAL, K,I4)", 2, "7H ends within its text; 8H would fit"),
    ("(2H(A),I4)", 2, "2H ends within its text; 3H would fit"),
    ("(I4,9H DEGREES 9/)", 5, "9H ends within its text; 10H would fit"),
    ("(4HABC)", 2, "4H includes the parenthesis after its text; 3H would fit"),
    ("(70HABC)", 2, "70H includes the parenthesis after its text; 3H would fit"),
    ("(5HABC/I4)", 2, "5H includes the slash after its text; 3H would fit"),
    ("(6HABC,5HDEFGH,I4)", 2, "6H includes the comma after its text; 3H would fit"),
    ("(2(4HA,B),I4)", 4, "4H includes the parenthesis after its text; 3H would fit"),
]


@pytest.mark.parametrize(("text", "column", "words"), HOLLERITH, ids=[text for text, _, _ in HOLLERITH])
def test_wrong_hollerith_count_gets_a_suggestion(text: str, column: int, words: str) -> None:
    (message,) = errors(f"5 FORMAT{text}", "END")
    assert (message.card, message.column, message.number, message.message) == (1, 8 + column, 11, words)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("(3HABC,A4)", FOREIGN_FIELDS["A"]),
        ("(3HABC,I4", "expected a closing parenthesis at the end of the FORMAT"),
        ("(3HABC,I)", "I needs a width after it"),
        ("(3HABC,F4,4HDEFG)", "F4 lacks a decimal point and a number of decimals, as in F4.4"),
    ],
)
def test_correct_hollerith_count_is_not_blamed_for_another_error(text: str, words: str) -> None:
    (message,) = errors(f"5 FORMAT{text}", "END")
    assert message.message == words


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("(4HABC,I4)", "4H includes a comma, and no comma follows it; write 3H if the comma is a separator"),
        ("(5HABC,2I4)", "5H includes a comma, and no comma follows it; write 3H if the comma is a separator"),
        ("(I2,4HA , F4.1)", "4H includes a comma, and no comma follows it; write 2H if the comma is a separator"),
    ],
)
def test_hollerith_count_that_includes_a_comma_gives_a_warning(text: str, words: str) -> None:
    (message,) = diagnostics(f"5 FORMAT{text}", "END")
    assert (message.warning, message.number, message.message) == (True, 11, words)


@pytest.mark.parametrize(
    "text", ["(4HABC,,I4)", "(4HABC,)", "(4HABC,/I4)", "(1H,I4)", "(3HABCI4)", "(4HA,BCI4)", "(3H(A),I4)"]
)
def test_hollerith_text_may_contain_a_comma(text: str) -> None:
    assert diagnostics(f"5 FORMAT{text}", "END") == ()


@pytest.mark.parametrize(
    "line",
    ["{n} FORMAT(I2,3HA,B,3HC,D,3HE,F,3HG,H,3HI,J,3HK,L,3HM,N,3HO,P,4HQ,RS", "X{n}=ABSF(Y)", "  CALL SUB(X)", "F(X)=Y"],
)
def test_many_foreign_statements_are_reported_quickly(line: str) -> None:
    with within(8):
        assert errors(*(line.format(n=n) for n in range(1, 1500)), "END")
