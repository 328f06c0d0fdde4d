"""Points read from decks, CSV and OFF files, invalid files, and the commands ``export`` and ``draw``."""

import csv
import io
import json
from fractions import Fraction
from importlib import resources
from pathlib import Path

import pytest

from emulator.errors import EmulatorError
from modern.cli import export as export_command
from modern.comparison.outcome import as_hull
from modern.exact_hull import exact_hull
from modern.formats.deck import coordinate_field, data_deck, exact_points, with_epsilon
from modern.formats.export import export_text
from modern.formats.off import parse_off
from modern.formats.points import Input, parse_input, read_input, recognise
from modern.geometry.hull import ERROR, Hull
from modern.port import convex_hull
from tests.support.commands import call

CARD = "+.10000000E+01-.25000000E+01+.30000000E-05\n"
DECK = " 2\n" + CARD + "+.12345678E+02+.00000000E+00+.90000000E+91\n"
CSV = "x,y,z\n1,-2.50,3e-6\n\n 12.345678 ,0,.9E91\n"
OFF = "OFF\n2 0 0\n1 -2.50 3e-6\n12.345678 0 .9E91\n"
TETRA = "0,0,0\n1,0,0\n0,1,0\n0,0,1\n0.25,0.25,0.25\n0,0,0\n"


def numbers(found: Input) -> list[tuple[Fraction, ...]]:
    return [tuple(Fraction(text) for text in point) for point in found.points]


# --- reading


@pytest.mark.parametrize(
    ("text", "kind", "places"),
    [(DECK, "deck", ("card 2", "card 3")), (CSV, "csv", ("line 2", "line 4")), (OFF, "off", ("line 3", "line 4"))],
)
def test_a_deck_a_list_and_an_off_file_have_the_same_points(text: str, kind: str, places: tuple[str, ...]) -> None:
    found = parse_input(text, "points")
    assert numbers(found) == [(1, Fraction(-5, 2), Fraction(3, 10**6)), (Fraction("12.345678"), 0, 9 * 10**90)]
    assert (found.kind, found.places, found.notes) == (kind, places, ())


def test_decks_are_read_with_notes_and_without_loss() -> None:
    assert parse_input(CSV, "points").points == (("1", "-2.50", "3e-6"), ("12.345678", "0", ".9E91"))
    assert parse_input(OFF, "points").points == (("1", "-2.50", "3e-6"), ("12.345678", "0", ".9E91"))
    assert parse_input(DECK, "points").points == (("1", "-2.5", "0.000003"), ("12.345678", "0", "9E+90"))
    found = parse_input(DECK + " 1\n" + CARD + " 1\n 2.\n", "a.deck")
    assert len(found.points) == 2
    assert found.notes == ("a.deck: 3 data sets; only the first one is read",)
    found = parse_input(" 1\n 2.\n", "a.deck")
    assert found.points == (("2", "0", "0"),)
    assert found.notes == (
        "a.deck: card 2, column 15: y: a blank field is read as zero",
        "a.deck: card 2, column 29: z: a blank field is read as zero",
    )


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("123456789.1234", "123456789.1234"),
        ("    1.23456789", "1.23456789"),
        ("        -1.5  ", "-1.5"),
        ("-.00000000E+00", "0"),
        ("12345678901234", "123456.78901234"),
        (".99999999E+99 ", "9.9999999E+98"),
    ],
)
def test_all_digits_of_a_card_are_read(field: str, value: str) -> None:
    """In a field without a decimal point, E14.8 assumes it before the eighth digit from the right."""
    found = parse_input(f" 1\n{field}{'0.':<14}{'0.':<14}\n", "a.deck")
    assert found.points == ((value, "0", "0"),)


@pytest.mark.parametrize("example", [1, 2, 3, 4, 5, 6])
def test_every_deck_of_chapter_6_is_read_exactly(example: int) -> None:
    deck = resources.files("transcripts") / "chapter6" / f"example{example}" / "program1.deck"
    text = deck.read_text("ascii")
    found = parse_input(text, deck.name)
    cards = text.splitlines()[1 : len(found.points) + 1]
    assert int(text[:2]) == len(found.points)
    assert numbers(found) == [tuple(Fraction(card[k : k + 14].strip()) for k in (0, 14, 28)) for card in cards]


@pytest.mark.parametrize(
    ("text", "source", "kind"),
    [
        ("10\n", "a", "deck"),
        (" 3 \n", "a", "deck"),
        ("1,2,3\n", "a.deck", "csv"),
        ("x,y,z\n", "a", "csv"),
        ("# made by hand\n\nOFF\n", "a", "off"),
        ("OFF 3 1 0\n", "a.csv", "off"),
        ("COFF\n", "a", "off"),
        ("3 1 0\n", "a.off", "off"),
        ("3 1 0\n", "a.deck", "deck"),
        (" 3 points\n", "a.deck", "deck"),
    ],
)
def test_the_first_line_and_the_extension_determine_the_format(text: str, source: str, kind: str) -> None:
    assert recognise(text, source) == kind


def test_points_are_read_from_standard_input(monkeypatch) -> None:
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(b"\xef\xbb\xbf" + CSV.encode()), encoding="utf-8"))
    found = read_input("-")
    assert (found.source, found.kind, len(found.points)) == ("standard input", "csv", 2)


# name, the file's bytes, its name, the message
BAD = [
    ("empty", "", "a.csv", "a.csv: there are no points"),
    ("blank", "\n \n", "a.csv", "a.csv: there are no points"),
    ("heading-only", "x,y,z\n", "a.csv", "a.csv: expected points x,y,z, found only the heading 'x,y,z'"),
    ("no-vertices", "OFF\n0 0 0\n", "a.off", "a.off: there are no points"),
    ("unknown", "\nhello\n", "a.xyz", "a.xyz: line 2, column 1: 'hello' is neither the first card of a deck"),
    ("text", "\nhello you three\n1 2\n", "a.xyz", "a.xyz: line 3, column 1: expected a point x,y,z, found 2 fields"),
    ("unknown-long", "y" * 9999, "a", f"a: line 1, column 1: '{'y' * 40}...' is neither"),
    ("two-fields", "1,2,3\n4,5\n", "a.csv", "a.csv: line 2, column 1: expected a point x,y,z, found 2 fields"),
    ("four-fields", "1,2,3,4\n", "a.csv", "a.csv: line 1, column 1: expected a point x,y,z, found 4 fields"),
    ("no-number", "1,2,3\n4,five,6\n", "a.csv", "a.csv: line 2, field 2: 'five' is not a decimal number"),
    ("no-field", "1,2,\n", "a.csv", "a.csv: line 1, field 3: '' is not a decimal number"),
    ("quotient", "1,2,1/3\n", "a.csv", "a.csv: line 1, field 3: '1/3' is not a decimal number"),
    ("infinite", "1,2,3\n4,5,inf\n", "a.csv", "a.csv: line 2, field 3: 'inf' is not a decimal number"),
    ("digits", "1,2,\u0663\n", "a.csv", "a.csv: line 1, field 3: '\u0663' is not a decimal number"),
    ("long", "1,2," + "9" * 5000 + "\n", "a.csv", "a.csv: line 1, field 3: 5000 digits; at most 4000 are read"),
    ("exponent", "1,2,1e99999\n", "a.csv", "a.csv: line 1, field 3: the exponent of '1e99999' is not within"),
    ("wide-field", "1,2," + "a" * 200000 + "\n", "a.csv", "a.csv: line 1, column 1: field larger than field limit"),
    (
        "deck-n",
        "XX\n" + CARD,
        "a.deck",
        "a.deck: card 1, column 1: the number of points, in columns 1-2, is 'XX', which is not a number",
    ),
    ("deck-short", " 3\n" + CARD, "a", "a: card 2, column 1: the deck ends after 1 of 3 points"),
    ("deck-number", " 1\n+.10000000E+01  1.2.3\n", "a", "a: card 2, column 15: y: '1.2.3' is not a number"),
    ("deck-range", " 1\n.10000000E+100\n", "a", "a: card 2, column 1: x: "),
    ("deck-strange", " 1\n1.e0\n", "a", "a: card 2, column 3: 'e' is not in the card code"),
    ("deck-52", "52\n" + 52 * CARD, "a", "a: card 1, column 1: N is 52; the programs accept 1 to 51 points"),
    ("off-vertex", "OFF\n2 0 0\n1 2 3\n4 5\n", "a.off", "a.off: line 4, column 3: expected a vertex of 3 numbers"),
    ("coff", "COFF\n1 0 0\n1 2 3 0 0 0 1\n", "a.off", "a.off: line 1, column 1: 'COFF' is not supported"),
    ("latin-1", b"1,2,3\n1,\xe9,3\n", "a.csv", "a.csv: line 2, column 3: not a text file in UTF-8"),
    ("nul", "\0\0\0", "a", "a: line 1, column 1: '\\x00\\x00\\x00' is neither"),
]


@pytest.mark.parametrize("command", ["export", "draw"])
@pytest.mark.parametrize(("data", "name", "words"), [b[1:] for b in BAD], ids=[b[0] for b in BAD])
def test_invalid_points_are_one_line_and_leave_no_file(
    command, data, name, words, tmp_path, monkeypatch, capsys
) -> None:
    csv.field_size_limit(131_072)  # Python's own limit, which importing frictionless raises in the same process
    monkeypatch.chdir(tmp_path)
    Path(name).write_bytes(data if isinstance(data, bytes) else data.encode())
    code, out, err = call(capsys, command, name, "-o", "out.svg" if command == "draw" else "out.off")
    assert (code, out) == (2, "")
    assert err.startswith(f"hull1620: {words}")
    assert err.count("\n") == 1
    assert len(err) < 260
    assert [path.name for path in Path().iterdir()] == [name]


# --- the subcommands


@pytest.fixture
def room(tmp_path: Path, monkeypatch) -> Path:
    """Change to a folder that holds only a tetrahedron."""
    monkeypatch.chdir(tmp_path)
    Path("t.csv").write_text(TETRA, encoding="utf-8")
    return tmp_path


def test_export_writes_every_format(room: Path, capsys) -> None:
    for form in ("off", "obj", "ply", "stl", "json"):
        code, out, err = call(capsys, "export", "t.csv", "-o", f"t.{form}")
        assert (code, out, err) == (0, "", "note: t.csv: line 6 repeats the point of line 1\n")
        text = Path(f"t.{form}").read_text(encoding="utf-8")
        assert call(capsys, "export", "t.csv", "--format", form)[:2] == (0, text)
    read = parse_off(Path("t.off").read_text(encoding="utf-8"), "t.off")
    assert sorted(read.points) == [("0", "0", "0"), ("0", "0", "1"), ("0", "1", "0"), ("1", "0", "0")]
    assert len(read.faces) == 4
    document = json.loads(Path("t.json").read_text(encoding="utf-8"))
    assert (document["inside"], document["duplicates"]) == ([4], [{"point": 5, "first": 0}])
    # What was written is an input again.
    assert call(capsys, "export", "t.off", "-o", "again.off") == (0, "", "")
    assert set(parse_off(Path("again.off").read_text(encoding="utf-8"), "").points) == set(read.points)


# arguments, words of the message
BAD_ARGUMENTS = [
    (("export", "t.csv"), "export: add -o FILE, or add --format to write to standard output"),
    (("export", "t.csv", "-o", "t.dxf"), "t.dxf: the name must end with one of .off, .obj, .ply, .stl, .json, .html"),
    (("export", "t.csv", "-o", "none/t.off"), "none/t.off: no such file or directory"),
    (("export", "none.csv", "-o", "t.off"), "none.csv: no such file or directory"),
    (("export", "s.csv", "-o", "s.stl"), "STL holds triangles; the hull is a segment and has no area"),
    (("draw", "none.csv", "-o", "t.svg"), "none.csv: no such file or directory"),
    (("draw", "t.csv", "--eye", "0,0,0"), "expected a direction of view other than 0,0,0"),
    (("draw", "t.csv", "--eye", "1,2"), "the direction of view: expected 3 numbers X,Y,Z, found 2"),
    (("draw", "t.csv", "--eye", "1,2,z"), "the direction of view: 'z' is not a number"),
    (("draw", "s.csv", "--eye", "1,1,1"), "the direction of view is along the segment, which would appear as a point"),
]


@pytest.mark.parametrize(("arguments", "words"), BAD_ARGUMENTS, ids=[" ".join(b[0]) for b in BAD_ARGUMENTS])
def test_invalid_arguments_are_one_line_and_leave_no_file(room, capsys, arguments, words) -> None:
    Path("s.csv").write_text("0,0,0\n1,1,1\n", encoding="utf-8")
    before = sorted(path.name for path in room.iterdir())
    code, out, err = call(capsys, *arguments)
    assert (code, out) == (2, "")
    assert err.splitlines()[-1] == f"hull1620: {words}"
    assert sorted(path.name for path in room.iterdir()) == before


def test_meshes_are_exact_hulls_and_json_is_the_hull_of_the_procedure(room: Path, capsys) -> None:
    points = [(3, 4, 8), (6, -3, 7), (1, 2, -5), (4, 2, -3), (4, 2, 4), (1, 2, 7), (-2, 2, 0), (2, 2, 2)]
    Path("e.csv").write_text("".join(f"{x},{y},{z}\n" for x, y, z in points), encoding="utf-8")
    made, judged = convex_hull(points), as_hull(exact_hull(points))
    assert made.vertices != judged.vertices, "the order of the procedure is another than the input's"
    for form in ("off", "obj", "ply", "stl", "html"):
        assert call(capsys, "export", "e.csv", "--format", form) == (0, export_text(judged, form), "")
    found = json.loads(call(capsys, "export", "e.csv", "--format", "json")[1])
    assert tuple(found["vertices"]) == made.vertices
    assert found["centre"] is not None


def test_export_reports_a_hull_that_was_not_determined(room: Path, capsys, monkeypatch) -> None:
    """Exact arithmetic determines every hull, so this one is made by hand."""
    broken = Hull("exact", ERROR, 3, (("0", "0", "0"),), (), (), ())
    monkeypatch.setattr(export_command, "exact_hull_of", lambda *_, **__: (broken, []))
    monkeypatch.setattr("modern.cli.draw.exact_hull_of", lambda *_, **__: (broken, []))
    assert call(capsys, "export", "t.csv", "-o", "t.off") == (1, "", "hull1620: t.csv: ERROR IN PROGRAM\n")
    assert call(capsys, "draw", "t.csv", "-o", "t.svg") == (1, "", "hull1620: t.csv: ERROR IN PROGRAM\n")
    assert [path.name for path in room.iterdir()] == ["t.csv"]
    code, out, _ = call(capsys, "export", "t.csv", "--format", "json")
    assert (code, json.loads(out)["status"]) == (1, ERROR)


def test_decks_of_points_have_these_points_and_invalid_points_raise_an_error() -> None:
    with pytest.raises(EmulatorError):
        parse_input("1 2", "a")
    points = (("1", "-2.5", "0.000003"), ("12.345678", "0", "9E+90"))
    deck = with_epsilon(data_deck(points, "d"), ".5")
    assert deck.cards[0].text == " 2+.50000000E+00"
    assert tuple(exact_points(deck)[0].values()) == points


@pytest.mark.parametrize(
    ("text", "field"),
    [
        ("12", "+.12000000E+02"),
        (" -1.5 ", "-.15000000E+01"),
        (".25e-3", "+.25000000E-03"),
        ("-0.0", "-.00000000E+00"),
        ("000123.45600", "+.12345600E+03"),
        ("0.00012345678", "+.12345678E-03"),
        ("1e98", "+.10000000E+99"),
        ("1e-100", "+.10000000E-99"),
        ("0e12345", "+.00000000E+00"),
    ],
)
def test_a_coordinate_has_the_field_of_the_data_sheet(text: str, field: str) -> None:
    assert coordinate_field(text) == field


def test_coordinates_that_no_card_holds_are_rejected() -> None:
    assert coordinate_field("1.23456789", truncate=True) == "+.12345678E+01"
    for text, words in (
        ("1.23456789", "9 significant digits; a card holds 8"),
        ("1e99", "out of range"),
        ("1e-101", "out of range"),
        ("1/2", "'1/2' is not a decimal number"),
        (".", "'.' is not a decimal number"),
    ):
        with pytest.raises(ValueError, match=words):
            coordinate_field(text)
    with pytest.raises(ValueError, match=r"^point 2, field 3: 9 significant digits"):
        data_deck([("1", "2", "3"), ("1", "2", "1.23456789")], "d")
    with pytest.raises(ValueError, match=r"^100 points; the number of points has two columns"):
        data_deck([("1", "2", "3")] * 100, "d")
