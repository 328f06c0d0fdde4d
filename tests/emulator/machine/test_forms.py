"""FORMAT over several records: repetition, slashes, H and X fields on input (C26-5619 p. 35-43)."""

import pytest

from emulator.errors import CardError, DeckError
from tests.support.deckwork import punched, run

READ_5 = ["READ 1,I,J,K,L,M", "PUNCH 2,I,J,K,L,M", "2 FORMAT(5I3)", "END"]


@pytest.mark.parametrize(
    ("form", "data"),
    [
        ("(5I2)", [" 1 2 3 4 5"]),
        ("(2I2)", [" 1 2 9", " 3 4 9", " 5 9"]),
        ("(I2)", [" 1", " 2", " 3", " 4", " 5"]),
        ("(I2/4I2)", [" 1 9", " 2 3 4 5"]),
        ("(I2//4I2)", [" 1 9", " 9 9", " 2 3 4 5"]),
        ("(/5I2)", [" 9", " 1 2 3 4 5"]),
        ("(I2,3X,4I2)", [" 1999 2 3 4 5"]),
        ("(I2,3HABC,4I2)", [" 1XYZ 2 3 4 5"]),
        ("(5(I2,1X))", [" 1* 2* 3* 4* 5"]),
        ("(I2,78X,4I2/)", [" 1", "  2"]),
    ],
)
def test_five_numbers_are_laid_out_by_each_format(form: str, data: list[str]) -> None:
    if form.endswith("/)"):
        # Four fields lie beyond column 80, and are blank.
        result = run(f"1 FORMAT{form}", "READ 1,I,J", "PUNCH 2,I,J", "2 FORMAT(2I3)", "END", data=data)
        assert result.punched == ("  1  0",)
        return
    assert punched(f"1 FORMAT{form}", *READ_5, data=data) == ("  1  2  3  4  5",)


def test_text_and_columns_read_are_written_again() -> None:
    # C26-5619 p. 41: the columns read are written when the FORMAT is used for output.
    lines = ["READ 1,I", "PUNCH 1,I", "1 FORMAT(5HTITLE,I3)", "END"]
    assert punched(*lines, data=["AB CD 12"]) == ("AB CD 12",)
    # C26-5619 p. 37.
    lines = ["READ 1,I", "PUNCH 1,I", "1 FORMAT(3X,I3)", "END"]
    assert punched(*lines, data=["ABC 12"]) == ("ABC 12",)
    lines = ["READ 1", "PUNCH 1", "PUNCH 1", "1 FORMAT(10HHEADING   )", "END"]
    assert punched(*lines, data=["PROGRAM 1"]) == ("PROGRAM 1", "PROGRAM 1")
    lines = ["READ 1", "PUNCH 1", "1 FORMAT(3HABC)", "END"]
    assert punched(*lines, data=["XYZ"]) == ("XYZ",)
    assert punched("PUNCH 1", "1 FORMAT(3HABC)", "END") == ("ABC",)


def test_every_read_begins_a_new_card() -> None:
    lines = ["READ 1", "READ 2,N", "PUNCH 2,N", "1 FORMAT(I2)", "2 FORMAT(I2)", "END"]
    assert punched(*lines, data=["77", " 5"]) == (" 5",)
    lines = ["READ 1,N", "READ 1,M", "PUNCH 1,N,M", "1 FORMAT(2I2)", "END"]
    assert punched(*lines, data=[" 1 2", " 3 4"]) == (" 1 3",)


def test_formats_are_repeated() -> None:
    lines = ["N=7", "PUNCH 1,N,N,N", "1 FORMAT(/2HN=,I2)", "END"]
    assert punched(*lines) == ("", "N= 7", "", "N= 7", "", "N= 7")
    # IBM FORTRAN II-D, executed (g1 of tests/data/compiler_runs; OPEN-QUESTIONS 4).
    lines = ["I=1", "J=2", "K=3", "L=4", "M=5", "PUNCH 17,I,J,K,L,M"]
    assert punched(*lines, "17 FORMAT(1HA,I2,1HB,2(I2,1HC))", "END") == ("A 1B 2C 3C", " 4C 5C")
    assert punched(*lines, "17 FORMAT(1HA,I2,1HB,2(I2,1HC),2(1HD))", "END") == ("A 1B 2C 3CDD", " 4C 5CDD")
    lines = ["N=7", "PUNCH 1,N,N", "1 FORMAT(I2/)", "END"]
    assert punched(*lines) == (" 7", "", " 7", "")
    lines = ["N=7", "PUNCH 1,N", "1 FORMAT(I2,1H.,I2,1H,)", "END"]
    assert punched(*lines) == (" 7.",)


@pytest.mark.parametrize(("form", "second"), [("(I3/I3)", 2), ("(I3//I3)", 3), ("(I3/2HAB/I3)", 3)])
def test_ibm1962_reads_no_card_for_a_slash_before_an_unused_field(form: str, second: int) -> None:
    """The library of 1962, measured (docs/reference/ibm-library.md): the next READ begins with card ``second``."""
    lines = [f"1 FORMAT{form}", "2 FORMAT(2I3)", "READ 1,I", "READ 2,J", "PUNCH 2,I,J", "END"]
    (card,) = punched(*lines, data=["  1", "  2", "  3", "  4"], arithmetic="ibm1962")
    assert card[:6] == f"  1{second:3}"


@pytest.mark.parametrize(("form", "fits"), [("(70X,I2)", True), ("(71X,I2)", False), ("(I2,70X)", True)])
def test_ibm1962_reads_72_columns_of_a_card(form: str, fits: bool) -> None:
    lines = [f"1 FORMAT{form}", "2 FORMAT(I3)", "READ 1,I", "PUNCH 2,I", "END"]
    result = run(*lines, data=["12".rjust(72)], arithmetic="ibm1962")
    assert (result.typed, len(result.punched)) == (((), 1) if fits else (("ERROR F9",), 0))


def test_records_are_truncated_to_72_and_87_columns() -> None:
    """C26-5619 p. 43."""
    lines = ["PUNCH 1", "TYPE 1", "1 FORMAT(40H" + "A" * 40 + ",", "     1 40H" + "B" * 40 + ",", "     2 9HCCCCCCCCC)"]
    result = run(*lines, "END")
    assert result.punched == ("A" * 40 + "B" * 32,)
    assert result.typed == ("A" * 40 + "B" * 40 + "C" * 7,)
    assert [w.split(": ")[2] for w in (n.message for n in result.notices)] == [
        "a record of 89 characters, truncated to 72",
        "a record of 89 characters, truncated to 87",
    ]


def test_blanks_and_minus_zero_in_fields() -> None:
    assert run("PUNCH 1", "1 FORMAT(3HABC,40X,40X)", "END").notices == ()
    result = run("READ 1,A,N", "PUNCH 1,A,N", "1 FORMAT(E14.8,I4)", "END", data=[""])
    assert result.punched == (" .00000000E-99   0",)
    assert [notice.message for notice in result.notices] == [
        "data.cards: card 1, column 1: a blank field is read as zero",
        "data.cards: card 1, column 15: a blank field is read as zero",
    ]
    # Thesis p. 109, the last line of example 4.
    card = "-.00000000E-99 .00000000E-99"
    assert punched("READ 1,A,B", "PUNCH 1,A,B", "1 FORMAT(2E14.8)", "END", data=[card]) == (card,)


@pytest.mark.parametrize(("verb", "device"), [("PUNCH", "punch"), ("TYPE", "type"), ("PRINT", "type")])
def test_print_and_type_use_the_typewriter_and_events_keep_their_order(verb: str, device: str) -> None:
    result = run(f"{verb} 1", "1 FORMAT(3HABC)", "END")
    assert (result.punched, result.typed) == ((("ABC",), ()) if device == "punch" else ((), ("ABC",)))
    assert [(e.what, e.text) for e in result.events] == [(device, "ABC")]


def test_errors_name_the_card_and_column_of_a_field() -> None:
    with pytest.raises(CardError) as caught:
        run("READ 1,I,J", "1 FORMAT(2I4)", "END", data=["   1  X2"])
    assert str(caught.value) == "data.cards: card 1, column 5: 'X2' is not an integer"
    with pytest.raises(CardError) as caught:
        run("READ 1,I,A", "1 FORMAT(2X,I2/E14.8)", "END", data=["  12", "   1.2.3"])
    assert (caught.value.card, caught.value.column) == (2, 1)
    with pytest.raises(DeckError, match=r"data\.cards: card 1, column 1: the deck ends in the middle of a data set"):
        run("READ 1,I,J", "1 FORMAT(I2)", "END", data=[" 1"])


@pytest.mark.parametrize(
    ("lines", "data", "message"),
    [
        (["READ 1,N", "1 FORMAT(E14.8)"], ["1."], "N is fixed point, but its field in FORMAT 1 is E14.8"),
        (["A=1.", "PUNCH 1,A", "1 FORMAT(I4)"], [], "A is floating point, but its field in FORMAT 1 is I4"),
        (["DIMENSION X(2)", "X(2)=1.", "PUNCH 1,X(2)", "1 FORMAT(I4)"], [], "X(2) is floating point"),
    ],
)
def test_the_modes_of_field_and_variable_must_match(lines: list[str], data: list[str], message: str) -> None:
    """C26-5619 p. 43."""
    result = run(*lines, "END", data=data)
    assert result.ending.kind == "mode"
    assert message in result.ending.message
