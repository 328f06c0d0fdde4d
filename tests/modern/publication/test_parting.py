"""The comparison with exact arithmetic: its hull against the exact hull, and its messages for known sets."""

import random
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from modern.edition.chapter6 import input_deck
from modern.edition.sources import read
from modern.exact_hull import exact_hull
from modern.formats.points import parse_bytes
from modern.publication.console import point_sets
from modern.publication.parting import LIMIT, MOST, parted, true_hull
from tests.support.commands import call
from tests.support.paths import ROOT

SMALL = st.tuples(*[st.integers(-3, 3)] * 3)


def judged(points: list[tuple[int, int, int]]) -> tuple[int, set[tuple[int, int, int]]]:
    hull = exact_hull(points)
    return hull.dimension, {points[n] for n in hull.vertices}


def agree(points: list[tuple[int, int, int]]) -> None:
    dimension, faces = true_hull(points)
    assert (dimension, {points[n] for face in faces for n in face}) == judged(points)
    if dimension == 3:
        assert len(faces) == len(exact_hull(points).facets)


@given(st.lists(SMALL, min_size=1, max_size=14))
@settings(deadline=None, max_examples=150)
def test_the_hull_equals_the_exact_hull(points: list[tuple[int, int, int]]) -> None:
    agree(points)


@pytest.mark.parametrize("seed", range(4))
def test_the_hull_equals_the_exact_hull_for_full_data_sets(seed: int) -> None:
    draw = random.Random(seed)
    agree([(draw.randint(-99, 99), draw.randint(-99, 99), draw.randint(-99, 99)) for _ in range(MOST)])


def test_corners_are_in_order_and_equal_points_are_one_vertex() -> None:
    _, faces = true_hull([(0, 0, 0), (2, 2, 0), (2, 0, 0), (0, 2, 0), (1, 1, 0), (1, 0, 0)])
    assert sorted(faces[0]) == [0, 1, 2, 3]
    assert abs(faces[0].index(0) - faces[0].index(1)) == 2, "opposite corners are not neighbours"
    answer = parted("1 2 3\n1 2 3")
    assert answer["says"][0] == "1 vertex, one of them repeated, 2 equations"
    assert (answer["true"]["text"], answer["found"]["vertices"]) == ("a point", [0])


@pytest.mark.parametrize("example", range(1, 7))
def test_no_decision_differs_in_the_examples(example: int) -> None:
    points = parse_bytes(input_deck(example).text().encode(), "x").points
    answer = parted("\n".join(" ".join(point) for point in points))
    assert answer["part"] == "every decision is the same in exact arithmetic"
    assert "the vertices are those of the true hull" in answer["says"]
    assert sorted(answer["found"]["vertices"]) == answer["true"]["vertices"]


def test_the_silent_set_loses_three_vertices_at_a_named_statement() -> None:
    points = parse_bytes(read("transcripts/counterexamples/silent.deck").encode(), "x").points
    answer = parted("\n".join(" ".join(point) for point in points))
    assert answer["says"] == [
        "1 vertex, 4 equations",
        "vertices of the true hull that the programs missed: point 1, point 2, point 3",
    ]
    assert answer["part"] == (
        "the first branch that exact arithmetic takes differently: program 3, card 185, IF (EZ) 170, 167, 170; with "
        "eight digits the value is -100000 and the program goes to statement 170 (card 193), exactly the value is 0 "
        "and the program goes to statement 167 (card 186)"
    )


def drawn(number: int) -> str:
    """Return a set of points; about every third set has more digits than the programs can hold."""
    draw = random.Random(f"parting {number}")
    size = draw.choice((9, 30, 30, 99, 99, 99, 400, 99_999))
    solid = draw.random() < 0.8
    points = [[draw.randint(-size, size) for _ in range(3)] for _ in range(draw.randint(3, 12))]
    return "\n".join(f"{x} {y} {z if solid else 7}" for x, y, z in points)


@pytest.mark.parametrize("number", range(6))
def test_the_page_and_the_command_explain_a_set_in_the_same_words(number: int, tmp_path: Path, capsys) -> None:
    assert agreement(drawn(number), tmp_path, capsys) in ("hull", "refused")


def agreement(text: str, folder: Path, capsys) -> str:
    """Compare the sentences of the page for a set with those of ``hull --explain``; return "hull" or "refused"."""
    answer, deck = parted(text), folder / "points.deck"
    (folder / "points.csv").write_text(text)
    assert call(capsys, "cards", str(folder / "points.csv"), "-o", str(deck))[0] == 0
    code, _, err = call(capsys, "hull", str(deck), "--explain", "--limit", str(LIMIT))
    words = " ".join(err.split())
    assert " ".join(answer["part"].split()) in words
    assert all(" ".join(sentence.split()) in words for sentence in answer["reason"])
    assert bool(answer["reason"]) == ("no hull:" in words) == (code == 1) == (not answer["found"]["vertices"])
    assert not answer["reason"] or answer["says"][0] in words
    return "refused" if answer["reason"] else "hull"


def test_rejections_name_the_branch_and_the_sets_have_three_outcomes() -> None:
    answer = parted(point_sets()["six points of three digits: rejected"])
    assert answer["says"] == ["DATA NOT ACCEPTABLE"]
    assert answer["reason"][0].startswith("program 3, decided by card 51, IF(E(J))119,117,119 for the point")
    assert "program 3, card 51, IF(E(J))119,117,119; with eight digits the value is 10" in answer["part"]
    assert (answer["found"]["faces"], answer["true"]["text"]) == ([], "a polyhedron with 6 vertices and 8 faces")
    answers = [parted(text) for text in point_sets().values()]
    outcomes = [
        "rejected" if answer["reason"] else sorted(answer["found"]["vertices"]) == answer["true"]["vertices"]
        for answer in answers
    ]
    assert outcomes == [False, True, "rejected", "rejected", True]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "points"),
        ("1 2\n", "points"),
        ("1 2 x\n3 4 5\n", "points"),
        ("a b c", "points: expected points x,y,z, found only the heading 'a b c'"),
        ("1 2 3.123456789\n", "point 1, field 3: 10 significant digits; a card holds 8"),
        ("\n".join(f"{n} 0 0" for n in range(52)), "52"),
    ],
)
def test_invalid_points_are_rejected_with_one_line(text: str, message: str) -> None:
    answer = parted(text)
    assert list(answer) == ["refused"]
    assert message in answer["refused"]
    assert "\n" not in answer["refused"]


def test_the_module_does_not_import_numpy() -> None:
    code = f"""
import sys
sys.path[:0] = {sys.path!r}
from modern.publication.parting import parted
assert parted("0 0 0, 1 0 0".replace(", ", chr(10)))["true"]["text"].startswith("a line")
print("numpy" in sys.modules)
"""
    process = subprocess.run([sys.executable, "-S", "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    assert process.stdout.strip() == "False"
