"""The compiler's messages, each with card, column and IBM's error type (C26-5619 p. 56)."""

import pytest

from emulator.errors import CompileError, DeckError
from emulator.language.compiler import compile_deck, translate
from tests.support.deckwork import diagnostics, errors, source, within

F = "90 FORMAT(5E14.8)"

MESSAGES = [
    ("undefined label", ["GO TO 5", "END"], 1, 0, "there is no statement number 5"),
    ("undefined label in IF", ["IF(A)5,6,6", "6 END"], 1, 0, "no statement number 5"),
    ("jump to a FORMAT", ["GO TO 90", F, "END"], 1, 0, "statement 90 is a FORMAT; a program cannot branch to it"),
    ("jump to DIMENSION", ["GO TO 5", "5 DIMENSION X(2)", "END"], 1, 0, "statement 5 cannot be executed"),
    ("missing FORMAT", ["PUNCH 5,A", "END"], 1, 13, "no FORMAT number 5"),
    ("FORMAT number of a statement", ["5 A=1.", "PUNCH 5,A", "END"], 2, 13, "no FORMAT number 5"),
    ("FORMAT without field", ["PUNCH 5,A", "5 FORMAT(3HABC)", "END"], 1, 13, "no field for the numbers"),
    ("FORMAT with a wrong letter", ["5 FORMAT(B4)", "END"], 1, 11, "'B' is not a specification"),
    ("FORMAT unnumbered", ["FORMAT(I4)", "END"], 1, 10, "a FORMAT needs a statement number"),
    ("mixed sum", ["X=A+I", "END"], 1, 5, "mixed"),
    ("mixed product", ["I=J*2.", "END"], 1, 5, "mixed"),
    ("mixed in parenthesis", ["X=A*(B+(C-1))", "END"], 1, 5, "mixed"),
    ("mixed in IF", ["IF(A-1)5,5,5", "5 END"], 1, 5, "mixed"),
    ("fixed to a power", ["I=J**2", "END"], 1, 5, "may not be raised to a power"),
    ("fixed argument", ["X=SQRT(I)", "END"], 1, 5, "needs a floating-point argument"),
    ("two arguments", ["X=SQRT(A,B)", "END"], 1, 0, "needs exactly one argument"),
    ("name too long", ["LENGTH=1", "END"], 1, 6, "more than five"),
    ("no DIMENSION, read", ["A=X(1)", "END"], 1, 0, "X is neither an array nor a library function"),
    ("no DIMENSION, stored", ["X(1)=A", "END"], 1, 0, "X is not an array"),
    ("no DIMENSION, list", ["READ 90,X(1)", F, "END"], 1, 0, "X is neither"),
    ("one subscript of two", ["DIMENSION X(2,2)", "A=X(1)", "END"], 2, 0, "X needs 2 subscripts"),
    ("two subscripts of one", ["DIMENSION X(2)", "X(1,1)=A", "END"], 2, 0, "X needs 1 subscript "),
    ("no subscript", ["DIMENSION X(2)", "A=X", "END"], 2, 0, "the array X needs a subscript"),
    ("no subscript, stored", ["DIMENSION X(2)", "X=A", "END"], 2, 0, "the array X needs a subscript"),
    ("floating subscript", ["DIMENSION X(2)", "A=X(B)", "END"], 2, 0, "fixed-point variable"),
    ("constant subscript with a point", ["DIMENSION X(2)", "A=X(1.)", "END"], 2, 0, "must be integers"),
    ("subscript v+w", ["DIMENSION X(2)", "A=X(I+J)", "END"], 2, 0, "must be integers"),
    ("subscript v/c", ["DIMENSION X(2)", "A=X(I/2)", "END"], 2, 0, "expected a subscript v, c, v+c"),
    ("subscript -v", ["DIMENSION X(2)", "A=X(-I)", "END"], 2, 0, "expected a subscript v, c, v+c"),
    ("dimension twice", ["DIMENSION X(2),X(3)", "END"], 1, 9, "X already has dimensions"),
    ("dimension too late", ["X=1.", "DIMENSION X(3)", "END"], 2, 9, "X was used before its DIMENSION"),
    ("dimension of zero", ["DIMENSION X(0)", "END"], 1, 9, "dimension must be at least 1"),
    ("three dimensions", ["DIMENSION X(2,2,2)", "END"], 1, 9, "more than two dimensions"),
    ("five digits", ["I=12345", "END"], 1, 0, "more than four digits"),
    ("constant too large", ["X=1.E99", "END"], 1, 0, "out of range"),
    ("constant too small", ["X=1.E-101", "END"], 1, 0, "out of range"),
    ("label twice", ["5 A=1.", "5 B=1.", "END"], 2, 0, "statement number 5 is already used on card 1"),
    ("label and FORMAT", ["5 A=1.", "5 FORMAT(I4)", "END"], 2, 0, "already used on card 1"),
    ("DO not closed", ["DO 5 I=1,3", "X=1.", "END"], 1, 0, "number 5, is missing"),
    ("DO ends before", ["5 X=1.", "DO 5 I=1,3", "END"], 2, 0, "number 5, is before the DO"),
    ("DO ends on itself", ["5 DO 5 I=1,3", "END"], 1, 0, "number 5, is before the DO"),
    ("DO ends on GO TO", ["DO 5 I=1,3", "5 GO TO 5", "END"], 2, 0, "a DO cannot end with this statement"),
    ("DO ends on IF", ["DO 5 I=1,3", "5 IF(A)6,6,6", "6 END"], 2, 0, "cannot end with this statement"),
    ("DO ends on a switch", ["DO 5 I=1,3", "5 IF(SENSE SWITCH 1)6,6", "6 END"], 2, 0, "cannot end with this"),
    ("DO ends on computed GO TO", ["DO 5 I=1,3", "5 GO TO(6),J", "6 END"], 2, 0, "cannot end with this statement"),
    ("DO ends on STOP", ["DO 5 I=1,3", "5 STOP", "END"], 2, 0, "cannot end with this statement"),
    ("DO ends on END", ["DO 5 I=1,3", "5 END"], 2, 0, "cannot end with this statement"),
    ("DO with floating variable", ["DO 5 A=1,3", "5 CONTINUE", "END"], 1, 0, "fixed-point variable"),
    ("DO with floating bound", ["DO 5 I=1,A", "5 CONTINUE", "END"], 1, 0, "a bound of a DO"),
    ("DO with constant with point", ["DO 5 I=1.,3", "5 CONTINUE", "END"], 1, 0, "must be an integer"),
    ("DO with an expression", ["DO 5 I=1,N+1", "5 CONTINUE", "END"], 1, 0, "must be an integer"),
    ("DO from zero", ["DO 5 I=0,3", "5 CONTINUE", "END"], 1, 0, "greater than zero"),
    ("DO step zero", ["DO 5 I=1,3,0", "5 CONTINUE", "END"], 1, 0, "greater than zero"),
    ("computed GO TO, floating", ["GO TO(5),A", "5 END"], 1, 0, "fixed-point variable"),
    ("columns after a record mark", ["A=1.| B=2.", "END"], 1, 0, "a record mark (punched 0-2-8) ends a statement"),
    ("two commas before a list", ["READ 5,,A", "5 FORMAT(F5.1)", "END"], 1, 13, "','"),
    ("no such sense switch", ["IF(SENSE SWITCH 5)6,6", "6 END"], 1, 7, "9 is on after the last card"),
    ("too much data", ["DIMENSION X(70,90)", "END"], 1, 0, "OVERLAP"),
]


@pytest.mark.parametrize(
    ("lines", "card", "number", "words"), [m[1:] for m in MESSAGES], ids=[m[0].replace(" ", "-") for m in MESSAGES]
)
def test_message(lines: list[str], card: int, number: int, words: str) -> None:
    (message,) = errors(*lines)
    assert (message.card, message.number) == (card, number)
    assert words in message.message


@pytest.mark.parametrize(
    ("line", "column"),
    [("  X = A + I", 11), (" X = Y(2)", 6), ("  GO TO 5", 3), ("  10 PUNCH 5, A", 6), ("  I = J ** 2", 7)],
)
def test_columns(line: str, column: int) -> None:
    (message,) = errors(line, "END")
    assert message.column == column


def test_messages_follow_the_order_of_cards() -> None:
    lines = ["DO 5 I=1,3", "DO 6 J=1,3", "5 X=1.", "6 Y=1.", "END"]
    assert any(
        "must not end after the DO around it, which ends with statement 5" in d.message and d.card == 2
        for d in errors(*lines)
    )
    found = errors("GO TO 7", "X=", "I=A+1", "Y=Z(3)", "END")
    assert [d.card for d in found] == [2, 3, 4]  # where a card does not parse, jumps are not judged
    assert [d.card for d in errors("GO TO 7", "I=A+1", "END")] == [1, 2]


def test_warnings_do_not_prevent_a_run() -> None:
    (message,) = diagnostics("X=1.")
    assert message.warning
    assert "no END card" in message.message
    # C26-5619 p. 56: 87 characters.  The rest is lost at run time, so the deck still runs.
    (message,) = diagnostics("5 FORMAT(40X,40X,8X)", "END")
    assert (message.number, message.warning) == (12, True)
    assert (message.card, message.column) == (1, 9)
    assert diagnostics("5 FORMAT(40X,40X,7X)", "END") == ()


def test_a_compile_error_has_every_message_and_its_place() -> None:
    with pytest.raises(CompileError) as caught:
        compile_deck(source("GO TO 5", "GO TO 6", "END"))
    assert str(caught.value) == "deck.f: card 1, column 1: error: there is no statement number 5 (and 1 more)"
    assert len(caught.value.diagnostics) == 2
    (message,) = errors("X=A+I", "END")
    assert message.line("p.f").startswith("p.f: card 1, column 5: error 5: ")
    assert len(errors("IF(A)5,6,5", "6 END")) == 1


@pytest.mark.parametrize("lines", [[], [""], ["C  ONLY A COMMENT", ""]])
def test_deck_without_statements_is_rejected(lines: list[str]) -> None:
    with pytest.raises(DeckError, match=r"deck\.f: the source deck has no statement"):
        translate(source(*lines))


def test_formats_alone_the_largest_core_and_arrays_named_like_functions_compile() -> None:
    assert diagnostics("5 FORMAT(I4)", "END") == ()
    assert [d.warning for d in diagnostics("5 FORMAT(I4)")] == [True]
    # 60,000 positions, less 120 for names, with ten per field (C26-5619 p. 66-67).
    assert diagnostics("DIMENSION X(5988)", "END") == ()
    assert "OVERLAP" in errors("DIMENSION X(5989)", "END")[0].message
    assert diagnostics("DIMENSION X(5987)", "X(1)=Y", "END") == ()
    assert "OVERLAP" in errors("DIMENSION X(5988)", "X(1)=Y", "END")[0].message
    # A DIMENSION makes any name an array, and a name without arguments is a variable.
    assert diagnostics("DIMENSION SIN(3)", "I=2", "SIN(I)=1.", "SQRT=SIN(2)", "END") == ()


@pytest.mark.parametrize("cards", [["E N D", "X=1."], ["GO TO 5", " 05 END", "X=1."], ["END ", "     1"]])
def test_cards_after_an_end_of_any_form_are_data(cards: list[str]) -> None:
    assert [(d.card, d.warning) for d in diagnostics(*cards)] == [(len(cards), True)]


@pytest.mark.parametrize("last", ["5 X=I+1.", "5 X=+*"])
def test_invalid_last_statement_of_a_do_gives_one_message(last: str) -> None:
    assert [d.card for d in errors("DO 5 I=1,3", last, "END")] == [2]


@pytest.mark.parametrize("last", ["5 FORMAT(I4)", "5 DIMENSION X(3)"])
def test_do_cannot_end_with_a_statement_that_is_not_executed(last: str) -> None:
    (message,) = errors("DO 5 I=1,3", last, "END")
    assert (message.card, message.message) == (2, "a DO cannot end with this statement; use CONTINUE")


@pytest.mark.parametrize(
    ("size", "words"), [("9999,9999", "OVERLAP"), ("99999999999", "more than four digits"), ("9999", "OVERLAP")]
)
def test_huge_array_in_a_list_is_rejected_at_once(size: str, words: str) -> None:
    """The compiler makes no object code for an array that no core can hold."""
    with within(2):
        assert words in errors(f"DIMENSION X({size})", "PUNCH 90,X", F, "END")[0].message
