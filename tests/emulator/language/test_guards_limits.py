"""The limits of the compiler: nesting of lists, groups and parentheses, and constant factors of subscripts."""

import pytest

from emulator.language.formats import MAX_LITERAL, MAX_RECORD
from emulator.language.parser import MAX_NESTING
from tests.support.deckwork import code, diagnostics, errors, punched, run
from tests.support.paths import ROOT

FILLED = ["DIMENSION A(9),B(2,4)", "DO 5 I=1,9", "5 A(I)=I"]
"""A(k) is k."""


def cards(statement: str) -> list[str]:
    """Return a long statement on a card of 72 columns and continuation cards of 66 (OPEN-QUESTIONS 1)."""
    return [statement[:72], *(f"     1{statement[k : k + 66]}" for k in range(72, len(statement), 66))]


def nested(item: str, *variables: str) -> str:
    """Return the item in one list per variable, innermost first, each from 1 to 2."""
    for variable in variables:
        item = f"({item},{variable}=1,2)"
    return item


@pytest.mark.parametrize(
    ("item", "card"),
    [
        (nested("J", "J"), " 1 2"),
        (nested("J,K", "J", "K"), " 1 1 2 1 1 2 2 2"),
        (nested("J,K,L", "J", "K", "L"), " 1 1 1 2 1 1 1 2 1 2 2 1 1 1 2 2 1 2 1 2 2 2 2 2"),
    ],
    ids=["one", "two", "three"],
)
def test_lists_may_be_nested_three_deep(item: str, card: str) -> None:
    """One more level than an array has subscripts.  The innermost variable varies fastest, as in nested DOs."""
    assert punched(f"PUNCH 1,{item}", "1 FORMAT(24I2)", "END") == (card,)


@pytest.mark.parametrize(
    "item",
    [nested("J", "J", "K", "L", "M"), f"({nested('J', 'J', 'K', 'L')},M,M=1,2)", f"I,{nested('J', *'JKLM')}"],
    ids=["alone", "with another item", "not the first item"],
)
def test_fourth_level_of_lists_is_rejected(item: str) -> None:
    """There is one message, on the statement's card.  A list next to another one is not nested in it."""
    (message,) = errors("I=1", *cards(f"PUNCH 1,{item}"), "1 FORMAT(24I2)", "END")
    assert (message.card, "nested too deep" in message.message) == (2, True)
    beside = ",".join([nested("J", "J", "K", "L")] * 3)
    assert errors(*cards(f"PUNCH 1,{beside}"), "1 FORMAT(24I2)", "END") == ()


def test_formats_and_parentheses_have_a_limited_depth() -> None:
    # The parentheses of the FORMAT itself do not count: 2(1X,2(I1)) is four fields.
    assert punched("PUNCH 1,(J,J=1,4)", "1 FORMAT(2(1X,2(I1)))", "END") == (" 12 34",)
    (message,) = errors("1 FORMAT(2(1X,2(2(I1))))", "END")
    assert (message.card, message.number) == (1, 11)
    # The limit protects Python's own stack.  It counts the parentheses that are open at the same time.
    sixty = f"{'(' * 60}1.{')' * 60}"
    assert diagnostics(*cards(f"X={sixty}"), "END") == ()
    assert diagnostics(*cards(f"X={sixty}+{sixty}"), "END") == ()
    assert len(errors(*cards(f"X=({sixty})"), "END")) == 1


@pytest.mark.parametrize(
    ("what", "much"),
    [
        ("nested parentheses", f"{MAX_NESTING} deep"),
        ("nested loops in a list", "three"),
        ("nested groups in a FORMAT", "two, not counting the parentheses of the FORMAT itself"),
        ("fields of a FORMAT, with repetitions expanded", "2,000"),
        ("width of X and H", f"{MAX_LITERAL} (p. 37, 41); a larger width causes a warning"),
        ("a record", f"{MAX_RECORD} characters (p. 43, 56); a longer record causes a warning"),
        ("data", "5,988 numbers in 60,000 positions"),
    ],
)
def test_manual_states_every_limit(what: str, much: str) -> None:
    """Limits that are not constants of the code are tested here and with the compiler's messages."""
    assert f"| {what} | {much} |" in (ROOT / "docs" / "reference" / "fortran.md").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("subscript", "element"),
    [("2*3", 6), ("2*3+1", 7), ("2*3-1", 5), ("3*1", 3), ("2+3", 5), ("7-3", 4), ("9*1-8", 1), ("3*3", 9)],
)
def test_constant_subscript_gives_the_address(subscript: str, element: int) -> None:
    """The subscript c*v+k of constants (C26-5619 p. 18) is an address and needs no code."""
    lines = [*FILLED, f"J=A({subscript})", "PUNCH 1,J", "1 FORMAT(I2)", "END"]
    assert punched(*lines) == (f"{element:2}",)
    assert code("DIMENSION A(9)", f"X=A({subscript})", "END")[0] == f"SEND A({element})"


def test_factors_in_subscripts_select_the_element() -> None:
    # B(2*1,2*2) of B(2,4) is row 2, column 4.
    assert code("DIMENSION B(2,4)", "X=B(2*1,2*2-1)", "END")[0] == "SEND B(2,3)"
    assert code("DIMENSION B(2,4)", "B(3-1,2*2)=X", "END")[:2] == ["SEND X", "TRANSMIT B(2,4)"]
    # 2*J+1 is 7 for J = 3, and the limit of the loop stays as it was.
    lines = [*FILLED, "J=3", "K=A(2*J+1)", "L=A(3*J-2)", "PUNCH 1,K,L,J", "1 FORMAT(3I2)", "END"]
    assert punched(*lines) == (" 7 7 3",)


@pytest.mark.parametrize(("subscript", "element"), [("2*3", 6), ("2*4-1", 7), ("2*3-6", 0), ("3-4", -1)])
def test_constant_subscript_out_of_bounds_stops_the_run(subscript: str, element: int) -> None:
    """The message names the computed subscript."""
    result = run("DIMENSION A(5)", f"A({subscript})=1.", "END")
    assert result.ending.kind == "bounds"
    assert str(element) in result.ending.message


@pytest.mark.parametrize("subscript", ["4/2", "2*3*1", "1+2+3", "-2", "-2*J", "-J+5", "+2*J+1-1", "J*2", "1+J"])
def test_other_forms_of_subscript_are_rejected(subscript: str) -> None:
    """C26-5619 p. 18 allows only v, c, v+c, v-c, c*v, c*v+c and c*v-c."""
    (message,) = errors("DIMENSION A(9)", f"X=A({subscript})", "END")
    assert (message.card, message.number) == (2, 0)
    assert "subscript" in message.message
