"""FORMAT specifications (C26-5619 p. 35-43, p. 56 for the error types)."""

import pytest

from emulator.language.formats import Literal, Slash, Spec
from emulator.numbers.fields import Field
from tests.support.deckwork import diagnostics, errors, program


def specs(text: str) -> tuple[Spec, ...]:
    ((number, spec),) = program(f"5 FORMAT{text}", "END").formats
    assert number == 5
    return spec.specs


E, I4 = Field("E", 14, 8), Field("I", 4)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("(I4)", (I4,)),
        ("(4E14.8,3I4)", (E, E, E, E, I4, I4, I4)),
        ("(F7.3)", (Field("F", 7, 3),)),
        ("(E10.0)", (Field("E", 10, 0),)),
        ("(I4,2X,I4)", (I4, Literal("  ", True), I4)),
        ("(I4,2XI4)", (I4, Literal("  ", True), I4)),
        ("(3HABCI4)", (Literal("ABC"), I4)),
        ("(5HA B C)", (Literal("A B C"),)),
        ("(3H), )", (Literal("), "),)),
        ("(2H//)", (Literal("//"),)),
        ("(2HI4)", (Literal("I4"),)),
        ("( 2 I 4 )", (I4, I4)),
        ("( 3 H A ,I4)", (Literal(" A "), I4)),
        ("(//I4/)", (Slash(), Slash(), I4, Slash())),
        ("(I4/I4)", (I4, Slash(), I4)),
        ("(2(I4,1X))", (I4, Literal(" ", True), I4, Literal(" ", True))),
        ("()", ()),
        ("(2(2(I4)))", (I4,) * 4),
        ("(2(I4)I4)", (I4,) * 3),
        ("(1000I4)", (I4,) * 1000),
        ("(2000I4)", (I4,) * 2000),
    ],
)
def test_specifications(text: str, expected: tuple[Spec, ...]) -> None:
    assert specs(text) == expected


def test_invalid_formats_are_reported_once() -> None:
    assert specs("(59H" + "A" * 59 + ")") == (Literal("A" * 59),)
    (message,) = errors("5 FORMAT(70HABC", "END")
    assert (message.number, "runs past the end of the card" in message.message) == (11, True)
    assert [d.number for d in errors("5 FORMAT(E14. 8)", "END")] == [11]
    assert len(errors("PUNCH 5,A", "5 FORMAT(A4)", "END")) == 1
    assert len(errors("PUNCH 5", "5 FORMAT(A4)", "END")) == 1


@pytest.mark.parametrize(
    "text",
    [
        "(A4)",
        "(I)",
        "(I0)",
        "(4)",
        "(E14)",
        "(E14.)",
        "(E.8)",
        "(X)",
        "(H)",
        "(0X)",
        "(0I4)",
        "(I4 I4)",
        "(I4",
        "I4",
        "(I4))",
        "(I4)I4",
        "(-I4)",
        "(I4.2)",
        "(I88)",
        "(10000I1)",
        "(((((I4)))))",
        "((((I4))))",
        "(2000I4,I4)",
    ],
)
def test_invalid_specification_is_error_11(text: str) -> None:
    """C26-5619 p. 56: a wrong letter, or a missing point or number of decimals."""
    lines = [f"5 FORMAT{text}", "END"]
    if text == "I4":
        assert errors(*lines)[0].message == "expected a parenthesis after FORMAT"
        return
    (message,) = errors(*lines)
    assert (message.card, message.number) == (1, 11)
    assert message.column >= 9


@pytest.mark.parametrize(
    ("text", "column", "words"),
    [
        ("(I4,B4)", 13, "'B' is not a specification; the codes are I, E, F, X, H and /"),
        ("(I4,4)", 14, "')' is not a specification"),
        ("(I4,4".ljust(64), 72, "'the end' is not a specification"),
        ("(I4".ljust(64), 72, "expected a closing parenthesis at the end of the FORMAT"),
        ("(10000I1)", 15, "the number 10000 in a FORMAT is too large"),
        ("((((I4))))", 12, "groups in a FORMAT may be nested at most two deep, found three"),
    ],
)
def test_message_and_column_of_a_format_error(text: str, column: int, words: str) -> None:
    (message,) = errors(f"5 FORMAT{text}", "END")
    assert message.column == column
    assert message.message.startswith(words)


@pytest.mark.parametrize(("text", "warned"), [("(49X)", 0), ("(50X)", 1), ("(50H" + "A" * 50 + ")", 1)])
def test_width_of_x_and_h(text: str, warned: int) -> None:
    """C26-5619 p. 37, 41: at most 49."""
    found = diagnostics(f"5 FORMAT{text}", "END")
    assert [d.warning for d in found] == [True] * warned
