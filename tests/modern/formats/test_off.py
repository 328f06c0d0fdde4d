"""Valid variants of OFF files, and one file for each way in which they can be invalid."""

import pytest

from emulator.errors import FileError
from modern.formats.off import parse_off

GOOD = "OFF\n3 1 3\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"

# name, text of the file
GOOD_OFF = [
    ("plain", GOOD),
    ("no-heading", GOOD.removeprefix("OFF\n")),
    ("one-line", GOOD.replace("OFF\n", "OFF ")),
    ("no-edges", GOOD.replace("3 1 3", "3 1")),
    ("comments", "# a\n\n" + GOOD.replace("\n", " # x\n")),
    ("crlf", GOOD.replace("\n", "\r\n")),
    ("colour", GOOD.replace("3 0 1 2", "3 0 1 2 0.5 0.5 0.5 1")),
    ("no-end", GOOD.rstrip()),
]


@pytest.mark.parametrize("text", [g[1] for g in GOOD_OFF], ids=[g[0] for g in GOOD_OFF])
def test_all_variants_of_plain_off_have_the_same_mesh(text: str) -> None:
    read = parse_off(text, "a.off")
    assert (read.points, read.faces) == ((("0", "0", "0"), ("1", "0", "0"), ("0", "1", "0")), ((0, 1, 2),))
    assert [text.splitlines()[line - 1].split("#")[0].split() for line in read.lines] == [list(p) for p in read.points]


# name, text of the file, the message behind the file's name
BAD_OFF = [
    ("empty", "", "line 1, column 1: the numbers of vertices and faces are missing"),
    ("heading-only", "OFF\n", "line 2, column 1: the numbers of vertices"),
    (
        "coff",
        GOOD.replace("OFF", "COFF"),
        "line 1, column 1: 'COFF' is not supported; write the points as plain ASCII OFF",
    ),
    ("binary", GOOD.replace("OFF", "OFF BINARY"), "line 1, column 5: expected the numbers of vertices, faces"),
    ("count", GOOD.replace("3 1 3", "3 x 3"), "line 2, column 3: 'x' is not a count"),
    ("negative", GOOD.replace("3 1 3", "-3 1 3"), "line 2, column 1: '-3' is not a count"),
    ("four-counts", GOOD.replace("3 1 3", "3 1 3 4"), "line 2, column 1: expected the numbers of vertices, faces"),
    ("two-numbers", GOOD.replace("1 0 0", "1 0"), "line 4, column 3: expected a vertex of 3 numbers, x y z; found 2"),
    (
        "four-numbers",
        GOOD.replace("1 0 0", "1 0 0 7"),
        "line 4, column 7: expected a vertex of 3 numbers, x y z; found 4",
    ),
    ("no-number", GOOD.replace("1 0 0", "1  nan 0"), "line 4, column 4: 'nan' is not a decimal number"),
    ("quotient", GOOD.replace("1 0 0", "1 1/2 0"), "line 4, column 3: '1/2' is not a decimal number"),
    ("digits", GOOD.replace("1 0 0", "1 \u0661 0"), "line 4, column 3: '\u0661' is not a decimal number"),
    ("long", GOOD.replace("1 0 0", "1 " + "x" * 9000 + " 0"), f"line 4, column 3: '{'x' * 40}...' is not a decimal"),
    ("exponent", GOOD.replace("1 0 0", "1 1e99999 0"), "line 4, column 3: the exponent of '1e99999' is not within"),
    ("too-few", "OFF\n3 1 3\n0 0 0\n", "line 4, column 1: the file ends after 1 of 3 vertices"),
    ("no-face", GOOD.replace("3 0 1 2\n", ""), "line 6, column 1: the file ends after 0 of 1 faces"),
    ("short-face", GOOD.replace("3 0 1 2", "4 0 1 2"), "line 6, column 7: the face ends after 3 of 4 vertices"),
    ("no-vertex", GOOD.replace("3 0 1 2", "3 0 1 3"), "line 6, column 7: there is no vertex 3; they are numbered"),
    ("empty-face", GOOD.replace("3 0 1 2", "0"), "line 6, column 1: a face needs at least one vertex"),
    ("bad-colour", GOOD.replace("3 0 1 2", "3 0 1 2 red"), "line 6, column 9: 'red' is not a decimal number"),
    ("more", GOOD + " 1\n", "line 7, column 2: expected the end of the file"),
]


@pytest.mark.parametrize(("text", "words"), [b[1:] for b in BAD_OFF], ids=[b[0] for b in BAD_OFF])
def test_an_invalid_off_file_is_rejected_in_one_line(text: str, words: str) -> None:
    with pytest.raises(FileError) as refused:
        parse_off(text, "a.off")
    message = str(refused.value)
    assert message.startswith(f"a.off: {words}")
    assert "\n" not in message
    assert len(message) < 200
