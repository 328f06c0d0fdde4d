"""Object programs, executed by a small 1620: they store and punch what the emulator does."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from emulator.errors import DeckError
from emulator.numbers.arithmetic import TRUNCATING, ZERO, square_root
from emulator.objectdeck.cards import END_OF_CODE, numbered, object_cards, with_library
from emulator.objectdeck.square_root import square_root as routine
from tests.support.core_1620 import Core
from tests.support.deckwork import program

ARRAYS = "DIMENSION X(5),M(4,3),N(6)"
FILL = ["DO 8 I=1,4", "DO 8 J=1,3", "8 M(I,J)=10*I+J", "DO 9 I=1,5", "9 X(I)=I"]


def punched(*lines: str) -> list[object]:
    """Return the numbers that the object program of some statements punches."""
    core = Core(object_cards(program(*lines, "99 FORMAT(I5,E14.8)", "END"), 20_000))
    core.run()
    return list(core.punched)


@pytest.mark.parametrize(
    ("statements", "numbers"),
    [
        (["A=1.5-2.*3.", "PUNCH 99,A"], [(-45000000, 1)]),
        (["A=2./(3.-4.)", "PUNCH 99,A"], [(-20000000, 1)]),
        (["A=0.", "B=A*(-1.)", "PUNCH 99,B"], [(0, -100)]),
        (["I=7", "J=(I-2)*(I+3)/4-2*I", "PUNCH 99,J"], [-2]),
        (["I=17", "J=100/(I-2)", "PUNCH 99,J"], [6]),
        (["A=-7.9", "I=A", "B=I", "PUNCH 99,I,B"], [-7, (-70000000, 1)]),
        ([ARRAYS, *FILL, "I=2", "J=3", "K=M(I,J)", "L=M(4,J-1)", "PUNCH 99,K,L"], [23, 42]),
        ([ARRAYS, *FILL, "I=2", "PUNCH 99,X(2*I),M(2*I-1,I),M(I,2*I-1),X(I+3)"], [(4, 1), 32, 23, (5, 1)]),
        ([ARRAYS, *FILL, "PUNCH 99,(X(I),I=2,4,2)"], [(2, 1), (4, 1)]),
        ([ARRAYS, *FILL, "K=2", "PUNCH 99,((M(I,J),J=1,K),I=3,4)"], [31, 32, 41, 42]),
        ([ARRAYS, *FILL, "PUNCH 99,M"], [11, 21, 31, 41, 12, 22, 32, 42, 13, 23, 33, 43]),
        (["I=3", "K=2", "DO 5 J=I,9,K", "5 PUNCH 99,J"], [3, 5, 7, 9]),
        (["DO 5 J=4,2", "5 PUNCH 99,J", "PUNCH 99,J"], [4, 5]),
        (["DO 5 I=1,3", "GO TO (1,2,3),I", "1 J=1", "GO TO 5", "2 J=2", "GO TO 5", "3 J=3", "5 PUNCH 99,J"], [1, 2, 3]),
        (["DO 4 I=1,3", "IF (I-2) 1,2,3", "1 J=4", "GO TO 4", "2 J=0", "GO TO 4", "3 J=1", "4 PUNCH 99,J"], [4, 0, 1]),
        (["A=-.5", "IF (A) 1,2,2", "1 PUNCH 99,A", "2 A=0.", "IF (-A) 3,4,3", "3 PUNCH 99,A", "4 CONTINUE"], [(-5, 0)]),
        (["A=SQRT(2.)", "B=SQRT(A*A+.25)", "PUNCH 99,A,B"], [(14142135, 1), (14999999, 1)]),
    ],
)  # fmt: skip
def test_object_programs_punch_the_numbers_of_their_statements(statements: list[str], numbers: list[object]) -> None:
    scaled = [(n[0] * 10 ** (8 - len(str(abs(n[0])))), n[1]) if isinstance(n, tuple) and n[0] else n for n in numbers]
    assert punched(*statements) == scaled


@given(st.integers(10**7, 10**8 - 1), st.integers(-99, 99), st.booleans())
def test_the_root_is_the_exact_root_truncated_to_eight_digits(mantissa: int, exponent: int, minus: bool) -> None:
    core = Core(object_cards(program("END"), 20_000))
    core.put(9000, routine(9000))
    core.set_fac((-mantissa if minus else mantissa, exponent))
    core.run(9000)
    assert core.fac(60) == square_root(mantissa, exponent, TRUNCATING.rules)


def test_the_root_of_zero_is_zero() -> None:
    core = Core(object_cards(program("END"), 20_000))
    core.put(9000, routine(9000))
    core.set_fac((0, -100))
    core.run(9000)
    assert core.fac(60) == (0, ZERO)


def test_the_symbol_table_has_the_fields_of_the_deck_of_1962() -> None:
    """The last two cards of the table: names of variables, constants, statement numbers and temporaries."""
    cards = object_cards(program("DIMENSION X(3),M(2,4)", "5 FORMAT(I3)", "A=2.5", "7 I=10*I", "END"), 20_000)
    table = cards[cards.index(END_OF_CODE) + 2 :]
    fields = [card[k : k + 10] for card in table for k in range(len(card) - 11, -1, -10)]
    assert fields[12:] == [
        *("O700000000", "]]003J9859", "N400000000", "]]002J9779"),
        *(
            "]8306K]005",
            "]8322K]005",
            "M100000000",
            "K5000000]1",
            "]8346]]007",
            "M900000000",
            "]00000]01]",
            "]000000]00",
        ),
    ]


def test_a_deck_with_the_library_keeps_the_loader_and_the_library() -> None:
    cards = object_cards(program("A=1.", "END"), 20_000)
    loader, library = [f"L{k}" for k in range(54)], ["B1", "B2"]
    deck = numbered([*loader, *object_cards(program("I=1", "J=I", "END"), 20_000), *library], 1)
    complete = with_library(cards, [*deck, "data"], "deck")
    assert [card[:76].rstrip() for card in complete] == [*loader, *cards, *library]
    assert complete[-1][76:] == "]" + f"{len(complete):03d}"
    with pytest.raises(DeckError, match=r"deck: expected an object deck .* found 0 such cards"):
        with_library(cards, ["data"], "deck")
    lengths = next(k for k, card in enumerate(deck) if card.startswith(END_OF_CODE)) + 1
    beyond = deck[lengths][:10] + "]]]00" + deck[lengths][15:]
    for damaged in (deck[:lengths], [*deck[:lengths], deck[lengths].replace("9", "X")], [*deck[:lengths], beyond]):
        rest = deck[len(damaged) :] if len(damaged) > lengths else []
        with pytest.raises(DeckError, match=r"found \d+ such cards without a valid symbol table"):
            with_library(cards, [*damaged, *rest], "deck")


@pytest.mark.parametrize(
    ("statement", "message"),
    [("A=SIN(1.)", "no routine for SIN is known"), ("A=2.**B", "A[*][*]B"), ("DIMENSION X(1200)", "OVERLAP")],
)
def test_programs_without_an_object_deck_are_rejected(statement: str, message: str) -> None:
    with pytest.raises(DeckError, match=message):
        object_cards(program(statement, "END"), 20_000)
