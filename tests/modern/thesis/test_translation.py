"""The layer ``translation`` moves the origin to the point C (thesis p. 118-119)."""

import random
from collections import Counter
from functools import cache

import pytest

from emulator.errors import DeckError
from emulator.machine.result import Options
from modern.exact_hull import exact_hull
from modern.thesis.cards import read_hull
from modern.thesis.job import HullRun
from tests.support.judged import Point, differences, distinct, faulty_sets, run, run_all, sets


def with_integer_c(points: list[Point]) -> list[Point] | None:
    """Scale points by 3 in a plane and 4 in space, so that C is an integer point; None if that needs a third digit."""
    factor = 3 if exact_hull(points).dimension == 2 else 4
    if max(max(map(abs, p)) for p in points) * factor > 99:
        return None
    return [(factor * x, factor * y, factor * z) for x, y, z in points]


def test_every_set_with_an_integer_c_is_right() -> None:
    """All numbers are then integers below eight digits, and moving the points back is exact."""
    scaled = ((name, with_integer_c(points)) for name, points in sets(240, 118))
    usable = [(name, points) for name, points in scaled if points is not None]
    assert len(usable) > 80
    assert not faulty_sets(usable, "translation", "corrected")


def small_sets(count: int, flat: bool) -> list[list[Point]]:
    point_sets = []
    for seed in range(count):
        r = random.Random(seed)

        def draw(r: random.Random = r) -> Point:
            return r.randint(-9, 9), r.randint(-9, 9), 1 if flat else r.randint(-9, 9)

        point_sets.append(distinct(draw, r.choice((5, 8, 12, 20))))
    return point_sets


@cache
def runs_of_both_proposals(flat: bool) -> list[HullRun]:
    """Run the programs with e and the translation on forty small sets."""
    hull_runs = run_all(small_sets(40, flat), "epsilon", "translation", "corrected", e=".01")
    return [hull_run for hull_run in hull_runs if isinstance(hull_run, HullRun)]


def test_a_c_with_thirds_mostly_leads_to_refusals() -> None:
    """KNOWN-FAULTS 18: after the translation, points no longer satisfy the lines through them."""
    point_sets = small_sets(40, flat=True)
    hull_runs = run_all(point_sets, "translation", "corrected")
    refusals = Counter(hull_run.refusal for hull_run in hull_runs if isinstance(hull_run, HullRun))
    assert refusals["DATA NOT ACCEPTABLE"] > 20
    assert not faulty_sets([(str(points), points) for points in point_sets], "corrected")


@pytest.mark.parametrize("flat", [False, True])
def test_both_proposals_of_chapter_7_together_classify_all_points(flat: bool) -> None:
    """Only the last digits of equations are lost when they are moved back."""
    inexact = 0
    for points, hull_run in zip(small_sets(40, flat), runs_of_both_proposals(flat), strict=True):
        messages = differences(points, hull_run)
        assert all(message.startswith("equations") for message in messages), messages
        inexact += bool(messages)
    assert inexact


@pytest.mark.parametrize("flat", [False, True])
def test_points_are_punched_with_their_original_coordinates(flat: bool) -> None:
    """Thirds and quarters of two-digit integers are subtracted and added exactly."""
    for points, hull_run in zip(small_sets(40, flat), runs_of_both_proposals(flat), strict=True):
        hull = read_hull(hull_run.final.result.punched)
        assert Counter(hull.inside + hull.boundary + hull.vertices) == Counter(points)


def test_translation_truncates_long_numbers_and_needs_more_core() -> None:
    points = [["0", "0", "1"], ["100", "1", "1"], ["1", "100", "1"], [".12345678", ".87654321", "1"]]
    hull = read_hull(run(points, "epsilon", "translation", "corrected", e="1").final.result.punched)
    inside = (*hull.inside, *hull.boundary, *hull.vertices)
    assert not any(p[0].denominator == 50_000_000 for p in inside)
    assert len(inside) == 4
    # Thesis p. 118: "the translation might not be advisable since it would require more storage".
    with pytest.raises(DeckError, match="OVERLAP"):
        run([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], "translation", options=Options())
