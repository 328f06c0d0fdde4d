"""Cards become statements: columns, comments and continuation (C26-5619 p. 12; OPEN-QUESTIONS 1 and 2)."""

import pytest

from emulator.errors import CardError
from emulator.language.cards import deck_from_text
from emulator.language.statements import Source, capitals, classify, is_comment, sources
from emulator.language.tree import Place
from tests.support.deckwork import diagnostics, run, source


def only(*lines: str) -> Source:
    (statement,) = sources(source(*lines))
    return statement


@pytest.mark.parametrize(
    ("card", "label", "text"),
    [
        ("X=1.", "", "X=1."),
        ("100 X=1.", "100", "X=1."),
        ("100X=1.", "100", "X=1."),
        ("  1 0 0   X = 1 .", "100", "X=1."),
        ("      X=1.", "", "X=1."),
        (" " * 68 + "X=1.", "", "X=1."),
        ("2157 CONTINUE", "2157", "CONTINUE"),
        ("      DO 101 I = 1 , N", "", "DO101I=1,N"),
        ("      IF (SENSE SWITCH 1) 128, 100", "", "IF(SENSESWITCH1)128,100"),
    ],
)
def test_a_statement_may_start_in_any_column(card: str, label: str, text: str) -> None:
    """C26-5619 p. 12.  The thesis punches ``28FORMAT(`` without a blank."""
    statement = only(card)
    assert (statement.label, statement.text) == (label, text)


def test_places_and_the_columns_of_formats_are_kept() -> None:
    statement = only("28FORMAT (3X,5HA B C)")
    assert (statement.label, statement.kind) == ("28", "format")
    assert statement.text.rstrip() == "(3X,5HA B C)"
    assert statement.places[0] == Place(1, 10)
    assert len(statement.text) == len(statement.places) == 72 - 9
    statement = only("C  X", " 10  A = B")
    assert statement.place == Place(2, 6)
    assert statement.places == (Place(2, 6), Place(2, 8), Place(2, 10))


def test_statement_that_reaches_column_73_gives_one_warning() -> None:
    """Without it a statement could lose its end unnoticed: a sum that ends in 12 at column 73 ends in 1."""
    long = "JK=1" + "+2" * 33 + "+12"
    (message,) = diagnostics(long[:70].ljust(72) + "NAME", long, "  " + long, "END")
    assert (message.card, message.column, message.warning) == (2, 73, True)
    assert message.message.startswith("columns 73 to 80 hold the identification of the card and are not read")
    assert message.message.endswith("(also on card 3)")
    assert diagnostics("X=1.".ljust(72) + "BUTL0010", "C" * 80, "END") == ()


def test_columns_73_to_80_and_other_invalid_characters() -> None:
    # C26-5619 p. 12, the figure.
    assert only("X=1.".ljust(72) + "BUTL0010").text == "X=1."
    assert only(" " * 70 + "X=1.5").text == "X="
    with pytest.raises(CardError, match=r"data\.cards: card 1, column 3: 'x' is not in the card code"):
        run("READ 1,I", "1 FORMAT(I4)", "END", data=["C x"])
    # Columns 73 to 80 alone do not make a statement.
    assert [s.text for s in sources(source(" " * 72 + "BUTL0010", "X=1."))] == ["X=1."]


@pytest.mark.parametrize("card", ["C  A COMMENT", "C", "C  ", "", "     ", "C     X=1."])
def test_comments(card: str) -> None:
    """C26-5619 p. 12: C and two blanks.  A blank card is ignored (OPEN-QUESTIONS 2)."""
    assert is_comment(source(card, "X=1.").cards[0])
    assert only(card, "X=1.").text == "X=1."


@pytest.mark.parametrize("card", ["C-----", "C TEXT", "COMMENT", "Cany text, any \u00e9 #", "C*** 1 ***"])
def test_comments_that_the_compilers_of_the_time_accept(card: str) -> None:
    """IBM's FORTRAN II-D and PDQ FORTRAN, executed (c1 of tests/data/compiler_runs)."""
    assert diagnostics(card, "X=1.", "END") == ()


@pytest.mark.parametrize("card", ["C=A+", "CONTINU", "CONTINUE 5", "CALL SUB(X)", "COMMON X", "C SEE X=1 BELOW"])
def test_comment_that_looks_like_a_statement_gives_a_warning(card: str) -> None:
    (message,) = diagnostics(card, "X=1.", "END")
    assert message.warning
    assert (message.card, message.column) == (1, 1)
    assert "taken as a comment" in message.message


@pytest.mark.parametrize("card", ["C1=2.", "C(3)=2.", "C =2.", "CA =1.", "CONTINUE"])
def test_not_comments(card: str) -> None:
    assert only(card).text == card.replace(" ", "")


def test_statements_continue_by_column_6() -> None:
    statement = only("      X = A +", "     1 B +", "     2C")
    assert statement.text == "X=A+B+C"
    assert [card.number for card in statement.cards] == [1, 2, 3]
    assert statement.places[-1] == Place(3, 7)
    first = "   10 FORMAT(6HAB"
    statement = only(first.ljust(70) + "12", "     1CD)")
    assert statement.text.rstrip() == (first[12:].ljust(58) + "12CD)")
    assert statement.places[statement.text.index("C")] == Place(2, 7)
    assert only("      X = A +", "C  A COMMENT", "     1 B").text == "X=A+B"
    assert only("      PUNCH 5,(A(I),", "     1 I=1,3)").text == "PUNCH5,(A(I),I=1,3)"


@pytest.mark.parametrize(
    ("card", "texts"),
    [
        ("     0 B", ["X=A+", "B"]),
        ("      Y=1.", ["X=A+", "Y=1."]),
        ("     1Y=1.", ["X=A+", "Y=1."]),
        ("    11 B", ["X=A+", "B"]),
    ],
)
def test_cards_that_are_not_continuations(card: str, texts: list[str]) -> None:
    """A zero in column 6, a character in columns 1 to 5, or a complete statement (OPEN-QUESTIONS 1)."""
    assert [s.text for s in sources(source("      X = A +", card))] == texts


def test_formats_in_column_6_and_capitals_keep_their_characters() -> None:
    # A statement may start in any column, and the parentheses in a Hollerith field need not match.
    cards = source("1 FORMAT(I4)", "     5 FORMAT(4H(A)))", "END")
    assert [(s.label, s.kind) for s in sources(cards)] == [("1", "format"), ("5", "format"), ("", "end")]
    assert capitals("x=\u00df\u00e9\n") == "X=\u00df\u00e9\n"
    with pytest.raises(CardError, match="column 3: '\u00df' is not in the card code"):
        deck_from_text("small.f", capitals("x=\u00df\n"))


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("X=1.", "assignment"),
        ("DO10I=1,5", "do"),
        ("DO10I=1.5", "assignment"),
        ("DO10I=A(1,2)", "assignment"),
        ("GOTO10", "go_to"),
        ("GOTO(1,2),I", "computed_go_to"),
        ("GOTO1=5.", "assignment"),
        ("IF(A)1,2,3", "if"),
        ("IF(SENSESWITCH1)2,3", "if_switch"),
        ("CONTINUE", "continue"),
        ("PAUSE", "pause"),
        ("STOP7", "stop"),
        ("END", "end"),
        ("END=1.", "assignment"),
        ("DIMENSIONX(5)", "dimension"),
        ("READ1,X", "input_output"),
        ("PUNCH1", "input_output"),
        ("TYPE1,(X(I),I=1,5)", "input_output"),
        ("CALLX", "unknown"),
        ("FORMAT", "unknown"),
        ("", "unknown"),
    ],
)
def test_classify(text: str, kind: str) -> None:
    assert classify(text) == kind


SMALL = """\
c  a comment, as it was typed
      do 5 i = 1, 3
c = 2.
Continue
5     punch 6, i
6     format(4hi = , i1)
      end
"""


def test_lower_case_becomes_capitals_except_in_comments() -> None:
    """Cards have no lower-case letters, not even in Hollerith fields.  A comment may contain anything after its C."""
    deck = deck_from_text("small.f", capitals(SMALL))
    assert deck.text() == SMALL.upper().replace("C  A COMMENT, AS IT WAS TYPED", "C  a comment, as it was typed")
    assert [statement.kind for statement in sources(deck)] == [
        "do",
        "assignment",
        "continue",
        "input_output",
        "format",
        "end",
    ]


@pytest.mark.parametrize("text", ["", "\n", "C  \u00e9\u00df\r\n", "C " + "x" * 90 + "\n", "c#\n\nX=1.\n"])
def test_capitals_keep_every_line(text: str) -> None:
    converted = capitals(text)
    assert converted == "C" + text[1:] if text.startswith(("c", "C")) else converted == text
