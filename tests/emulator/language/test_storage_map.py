"""Storage: addresses, contiguous arrays, and subscripts with and without a check."""

import pytest

from emulator.errors import DeckError
from emulator.language.storage import Allocator, Storage, core_address
from tests.support.deckwork import machine, number, program, punched, run

NEIGHBOURS = ["DIMENSION X(3),Y(3),M(2,2)", "I=4", "J=0"]


def test_arrays_lie_downward_from_the_first_address() -> None:
    # C26-5619 p. 66: 19879 in 20K.  In larger machines the address is higher by the additional core.
    made = program("DIMENSION X(5)", "END")
    first = made.storage.entries[0]
    assert (first.name, first.first, first.size) == ("X", 0, 5)
    assert [core_address(0, core) for core in (20_000, 40_000, 60_000)] == [19_879, 39_879, 59_879]
    assert [core_address(i, 20_000) for i in range(3)] == [19_879, 19_869, 19_859]
    # Bases 64 and 76 elements apart in the executed deck: 19889, 19249, 18489 (10 above element 1).
    made = program("DIMENSION A(64),B(76),C(76)", "END")
    bases = [core_address(entry.first, 20_000) + 10 for entry in made.storage.arrays()]
    assert bases == [19_889, 19_249, 18_489]


def test_fields_in_order_of_first_appearance() -> None:
    """C26-5619 p. 69: programs that name their variables in the same order share values between loads."""
    made = program("DIMENSION X(2)", "10 A=B+2.", "I=J", "A=I", "X(1)=C", "GO TO 10", "END")
    assert [(e.name, e.first) for e in made.storage.entries] == [
        ("X", 0),
        ("10", 2),
        ("A", 3),
        ("B", 4),
        ("constant 2.", 5),
        ("I", 6),
        ("J", 7),
        ("C", 8),
    ]


def test_every_name_takes_one_field() -> None:
    # C26-5619 p. 69.
    assert program("END").storage.fields == 0
    assert program("A=1.", "END").storage.fields == 2
    assert program("5 A=1.", "END").storage.fields == 3
    assert program("A=1.", "B=1.", "END").storage.fields == 3
    assert program("DIMENSION A(4,5)", "I=5", "A(I,I)=1.", "END").storage.fields == 23
    storage = program("DIMENSION X(3),A(2,2)", "K=1", "END").storage
    names = [storage.name_of(i) for i in range(storage.fields)]
    assert names[:7] == ["X(1)", "X(2)", "X(3)", "A(1,1)", "A(2,1)", "A(1,2)", "A(2,2)"]
    assert set(names[7:]) == {"K", "constant 1"}
    allocator = Allocator()
    first = allocator.place("array", "X", (2, 3))
    assert allocator.place("array", "X") is first
    assert allocator.place("variable", "X").first == 6
    assert allocator.storage() == Storage(tuple(allocator.entries.values()), 7, ())


@pytest.mark.parametrize(
    ("statement", "where"),
    [
        ("X(I)=1.", "X(4) is outside its DIMENSION X(3)"),
        ("X(J)=1.", "X(0) is outside its DIMENSION X(3)"),
        ("A=1.+X(I)", "X(4) is outside its DIMENSION X(3)"),
        ("A=X(I+1)", "X(5) is outside its DIMENSION X(3)"),
        ("A=X(J)", "X(0) is outside its DIMENSION X(3)"),
        ("A=-X(I)", "X(4) is outside its DIMENSION X(3)"),
        ("X(5)=1.", "X(5) is outside its DIMENSION X(3)"),
        ("M(I,1)=1", "M(4,1) is outside its DIMENSION M(2,2)"),
        ("M(1,I)=1", "M(1,4) is outside its DIMENSION M(2,2)"),
        ("K=M(J,1)", "M(0,1) is outside its DIMENSION M(2,2)"),
        ("K=M(3,1)", "M(3,1) is outside its DIMENSION M(2,2)"),
    ],
)
def test_strict_bounds(statement: str, where: str) -> None:
    result = run(*NEIGHBOURS, statement, "END")
    assert (result.ending.kind, result.ending.message) == ("bounds", f"deck.f: card 4: {where}, in {statement}")


def test_strict_bounds_in_lists_and_beyond_the_next_element() -> None:
    result = run(*NEIGHBOURS, "READ 1,X(I)", "1 FORMAT(E14.8)", "END", data=["1."])
    assert result.ending.message == "deck.f: card 4: X(4) is outside its DIMENSION X(3), in READ 1,X(I)"
    assert run("DIMENSION X(3)", "I=3", "A=X(I+2)", "END").ending.kind == "bounds"


def test_core_mode_reaches_neighbours_and_stops_outside_the_data() -> None:
    # Executed: X(n+1) is the first element of the next array, and X(0) the last of the one before.
    lines = ["DIMENSION X(3),Y(3)", "Y(1)=1.", "X(3)=3.", "I=4", "J=0", "X(I)=7.", "Y(J)=8."]
    assert punched(*lines, "PUNCH 1,Y(1),X(3)", "1 FORMAT(2F5.1)", "END", bounds="core") == ("  7.0  8.0",)
    lines = ["DIMENSION M(2,2),N(2)", "M(1,2)=5", "I=3", "K=M(I,1)", "J=3", "M(1,J)=6", "PUNCH 1,K,N(1)"]
    assert punched(*lines, "1 FORMAT(2I3)", "END", bounds="core") == ("  5  6",)
    result = run("DIMENSION X(3)", "I=2000", "X(I)=1.", "END", bounds="core")
    assert result.ending.kind == "outside"
    assert result.ending.message.startswith("deck.f: card 3: a subscript reaches outside the data")


def test_element_one_past_the_end_may_be_copied() -> None:
    """DO 119 J=I,N / R(J)=R(J+1) copies element N+1 of an array of N (OPEN-QUESTIONS 22)."""
    lines = ["DIMENSION X(3),Y(3)", "Y(1)=5.", "DO 1 I=1,3", "1 X(I)=2.", "I=3", "X(I)=X(I+1)"]
    made = machine(*lines, "A=X(I)", "END")
    assert made.run().ending.kind == "end"
    assert number(made, "A") == "undefined"
    result = run(*lines, "A=X(I)+1.", "END")
    assert (result.ending.kind, "X(3) is undefined" in result.ending.message) == ("undefined", True)
    core = machine(*lines, "A=X(I)", "END", bounds="core")
    assert core.run().ending.kind == "end"
    assert number(core, "A") == ".50000000E+01"


def test_overlap_message_names_the_core_size() -> None:
    made = ["DIMENSION X(51,50)", "X(1,1)=1.", "END"]
    with pytest.raises(DeckError, match=r"deck\.f: OVERLAP: .* a machine of 20000 has "):
        machine(*made, core=20_000)
    assert machine(*made, core=40_000).run().ending.kind == "end"


@pytest.mark.parametrize(
    ("statement", "held"),
    [("A=X(I)*1.", "M(1) holds a number in fixed"), ("K=M(J)+1", "X(2) holds a number in floating")],
)
def test_core_mode_stops_at_a_number_of_the_other_mode(statement: str, held: str) -> None:
    """The machine would have used its digits unchanged.  The emulator stops with a message."""
    lines = ["DIMENSION X(2),M(2)", "X(2)=5.", "M(1)=1234", "I=3", "J=0", statement, "END"]
    result = run(*lines, bounds="core")
    assert result.ending.kind == "mode"
    assert held in result.ending.message


def test_core_mode_copies_a_number_of_the_other_mode() -> None:
    """A copy transmits the field without looking at it."""
    lines = [
        "DIMENSION X(2),M(2)",
        "M(1)=1234",
        "I=3",
        "X(1)=X(I)",
        "J=-1",
        "K=M(J)",
        "PUNCH 1,K",
        "1 FORMAT(I4)",
        "END",
    ]
    assert punched(*lines, bounds="core") == ("1234",)


def test_a_field_is_found_by_its_name() -> None:
    storage = program("DIMENSION X(3),M(2,3)", "N=7", "X(1)=N", "M(2,2)=N", "A=2.", "END").storage
    names = [storage.name_of(field) for field in range(storage.fields)]
    assert {"X(3)", "M(1,2)", "M(2,3)", "N", "A"} < {*names}
    named = [name for name in names if not name.startswith("constant")]
    assert [storage.fields_of(name) for name in named] == [range(i, i + 1) for i, n in enumerate(names) if n in named]
    assert [storage.fields_of(name) for name in ("X", "X(4)", "M(3,1)", "M(2)", "Z")] == [range(3), *[range(0)] * 4]
