"""Layer ``translation``: the origin moved to C (thesis p. 118-119)."""

from __future__ import annotations

import random
from collections import Counter

import pytest

from emulator.errors import DeckError
from emulator.machine.result import Options
from modern.exact_hull import exact_hull
from modern.thesis.cards import read_hull
from tests.support.judged import Point, differences, distinct, faults, run, sets


def whole(points: list[Point]) -> list[Point] | None:
    """The points stretched until C is whole, 3 times in a plane, 4 in space; None where that takes a third digit."""
    factor = 3 if exact_hull(points).dimension == 2 else 4
    if max(max(map(abs, p)) for p in points) * factor > 99:
        return None
    return [(factor * x, factor * y, factor * z) for x, y, z in points]


def test_with_a_whole_c_every_set_is_right() -> None:
    """All numbers are integers below eight digits then, and the moving back is exact."""
    tried = 0
    for name, points in sets(240, 118):
        stretched = whole(points)
        if stretched is not None:
            tried += 1
            assert not faults(stretched, "translation", "corrected"), name
    assert tried > 80


def small_sets(count: int, flat: bool) -> list[list[Point]]:
    found = []
    for seed in range(count):
        r = random.Random(seed)

        def draw(r: random.Random = r) -> Point:
            return r.randint(-9, 9), r.randint(-9, 9), 1 if flat else r.randint(-9, 9)

        found.append(distinct(draw, r.choice((5, 8, 12, 20))))
    return found


def test_thirds_of_c_are_mostly_refused() -> None:
    """KNOWN-FAULTS 18: the points no longer satisfy the lines through them, where they did before the translation."""
    refusals = Counter(run(points, "translation", "corrected").refusal for points in small_sets(40, flat=True))
    assert refusals["DATA NOT ACCEPTABLE"] > 20
    assert not any(faults(points, "corrected") for points in small_sets(40, flat=True))


@pytest.mark.parametrize("flat", [False, True])
def test_chapter_7_s_two_proposals_together(flat: bool) -> None:
    """With e all points are where they belong; only the equations' last digits are lost in moving back."""
    other = 0
    for points in small_sets(40, flat):
        done = run(points, "epsilon", "translation", "corrected", e=".01")
        found = differences(points, done)
        assert all(words.startswith("equations") for words in found), found
        other += bool(found)
    assert other


def test_points_come_back_as_they_were_punched() -> None:
    """Thirds and quarters of two-digit integers leave and return exactly."""
    for flat in (False, True):
        for points in small_sets(40, flat):
            hull = read_hull(run(points, "epsilon", "translation", "corrected", e=".01").final.result.punched)
            assert Counter(hull.inside + hull.boundary + hull.vertices) == Counter(points)


def test_a_point_of_more_digits_than_c_leaves_room_for_comes_back_cut() -> None:
    points = [["0", "0", "1"], ["100", "1", "1"], ["1", "100", "1"], [".12345678", ".87654321", "1"]]
    hull = read_hull(run(points, "epsilon", "translation", "corrected", e="1").final.result.punched)
    inside = (*hull.inside, *hull.boundary, *hull.vertices)
    assert not any(p[0].denominator == 50_000_000 for p in inside)
    assert len(inside) == 4


def test_it_takes_more_than_40000_positions() -> None:
    """Thesis p. 118: "the translation might not be advisable since it would require more storage"."""
    with pytest.raises(DeckError, match="OVERLAP"):
        run([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], "translation", options=Options())
