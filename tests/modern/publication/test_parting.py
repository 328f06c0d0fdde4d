"""The comparison with exact arithmetic: its hull against the exact hull, and its messages for known sets."""

import random
import subprocess
import sys

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from modern.edition.chapter6 import input_deck
from modern.edition.sources import read
from modern.exact_hull import exact_hull
from modern.formats.points import parse_bytes
from modern.publication.parting import MOST, parted, true_hull
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


def test_the_corners_of_a_face_are_in_order() -> None:
    _, faces = true_hull([(0, 0, 0), (2, 2, 0), (2, 0, 0), (0, 2, 0), (1, 1, 0), (1, 0, 0)])
    assert sorted(faces[0]) == [0, 1, 2, 3]
    assert abs(faces[0].index(0) - faces[0].index(1)) == 2, "opposite corners are not neighbours"


@pytest.mark.parametrize("example", range(1, 7))
def test_no_decision_differs_in_the_examples(example: int) -> None:
    points = parse_bytes(input_deck(example).text().encode(), "x").points
    answer = parted("\n".join(" ".join(point) for point in points))
    assert answer["part"] == []
    assert "the vertices are those of the true hull" in answer["says"]
    assert sorted(answer["found"]["vertices"]) == answer["true"]["vertices"]


def test_the_silent_set_loses_three_vertices_at_a_named_statement() -> None:
    points = parse_bytes(read("transcripts/counterexamples/silent.deck").encode(), "x").points
    answer = parted("\n".join(" ".join(point) for point in points))
    assert answer["says"] == [
        "1 vertex, 4 equations",
        "vertices of the true hull that the programs missed: point 1, point 2, point 3",
    ]
    assert answer["part"] == [
        "program 3, card 185: IF (EZ) 170, 167, 170",
        "eight digits: 0, goes to statement 167 (card 186)",
        "exact: 27180, goes to statement 170 (card 193)",
    ]


def test_a_rejection_names_its_statement_and_fault() -> None:
    draw = random.Random(1)
    text = "\n".join(" ".join(str(draw.randint(-999, 999) / 10) for _ in range(3)) for _ in range(20))
    answer = parted(text)
    assert answer["says"][0] == "DATA NOT ACCEPTABLE"
    assert answer["says"][1].startswith("decided by program 3, card 55: IF(E(J))119,120,119")
    assert (answer["found"]["faces"], answer["true"]["dimension"]) == ([], 3)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "points"),
        ("1 2\n", "points"),
        ("1 2 x\n3 4 5\n", "points"),
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
assert parted("0 0 0, 1 0 0".replace(", ", chr(10)))["true"]["dimension"] == 1
print("numpy" in sys.modules)
"""
    process = subprocess.run([sys.executable, "-S", "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    assert process.stdout.strip() == "False"
