"""The comparison of routes with the exact hull, and ``hull1620 diff``."""

import json
from fractions import Fraction
from pathlib import Path

import pytest

from modern.cli.main import main
from modern.comparison.difference import disagreement
from modern.comparison.outcome import Outcome, Vector, from_judge
from modern.exact_hull import exact_hull
from tests.support.paths import MACHINE_RUNS

RUNS = MACHINE_RUNS
TETRAHEDRON = [(0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4), (1, 1, 1), (2, 2, 0)]


def vectors(points: list[tuple[int, int, int]]) -> list[Vector]:
    return [tuple(Fraction(x) for x in point) for point in points]


def judge_of(points: list[tuple[int, int, int]]) -> Outcome:
    return from_judge(exact_hull(points), vectors(points))


def changed(outcome: Outcome, **changes: object) -> Outcome:
    fields = {name: getattr(outcome, name) for name in Outcome.__dataclass_fields__}
    return Outcome(**{**fields, **changes})


def test_an_exact_hull_does_not_differ_from_itself() -> None:
    judge = judge_of(TETRAHEDRON)
    found = disagreement(judge, judge, vectors(TETRAHEDRON))
    assert found.agrees
    assert (found.error, found.excluded, found.points) == (0, 0, ())


def test_every_kind_of_difference_is_detected() -> None:
    judge, points = judge_of(TETRAHEDRON), vectors(TETRAHEDRON)
    missed = disagreement(changed(judge, vertices=judge.vertices - {3}), judge, points)
    assert (missed.missed, missed.agrees) == (frozenset({3}), False)
    added = disagreement(changed(judge, vertices=judge.vertices | {4}), judge, points)
    assert (added.added, added.agrees) == (frozenset({4}), False)
    misfiled = disagreement(changed(judge, boundary=frozenset(), inside=frozenset({4, 5})), judge, points)
    assert (misfiled.misfiled, misfiled.agrees) == (frozenset({5}), False)
    fewer = disagreement(changed(judge, equations=judge.equations[1:]), judge, points)
    assert (fewer.planes_missing, fewer.agrees) == (1, False)
    doubled = disagreement(changed(judge, equations=(*judge.equations, judge.equations[0])), judge, points)
    assert (doubled.planes_doubled, doubled.agrees) == (1, False)
    extra_plane = (Fraction(1), Fraction(2), Fraction(7), Fraction(-100))
    extra = disagreement(changed(judge, equations=(*judge.equations, extra_plane)), judge, points)
    assert (extra.planes_extra, extra.agrees) == (1, False)


def test_a_small_error_of_a_coefficient_is_measured_but_is_no_difference() -> None:
    judge, points = judge_of(TETRAHEDRON), vectors(TETRAHEDRON)
    a, b, c, d = judge.equations[0]
    off = (a, b, c, d + max(abs(a), abs(b), abs(c)) / 10**6)
    found = disagreement(changed(judge, equations=(off, *judge.equations[1:])), judge, points)
    assert found.agrees
    assert 0 < found.error <= Fraction(1, 10**6)
    assert found.excluded > 0
    assert found.excluded_point is not None


@pytest.mark.parametrize(
    ("run", "code", "words"),
    [
        ("01_tetra", 0, "all agree with the exact hull"),
        ("29_collinear_n10", 0, "a segment of 2 vertices"),
        ("35_coplanar_tilt_n14", 0, "a polygon of 6 vertices"),
        ("04_cube8", 1, "differs from the exact hull: listing\n"),
        ("18_dec3_n6", 1, "DATA NOT ACCEPTABLE"),
        ("39_prism_n10", 1, "endless"),
    ],
)
def test_diff_of_the_machine_runs_has_the_known_result(capsys, run: str, code: int, words: str) -> None:
    assert main(["diff", str(RUNS / run / "deck.cards")]) == code
    assert words in capsys.readouterr().out


def test_json_output_covers_points_that_no_card_holds(tmp_path: Path, capsys) -> None:
    path = tmp_path / "p.csv"
    path.write_text("0,0,0\n1,0,0\n0,1,0\n0,0,1.0000000001\n")
    assert main(["diff", str(path), "--json", str(tmp_path / "d.json")]) == 0
    document = json.loads((tmp_path / "d.json").read_text())
    statuses = {route["route"]: route["status"] for route in document["routes"]}
    assert statuses["listing"].startswith("not run: line 4: 11 significant digits")
    assert statuses["port exact"] == "determined"
    assert document["judge"]["vertices"] == [0, 1, 2, 3]
    capsys.readouterr()


def test_an_epsilon_makes_three_decimals_agree(tmp_path: Path, capsys) -> None:
    """The listing refuses the set; with e the programs and the port agree with the exact hull."""
    deck, out = str(RUNS / "18_dec3_n6" / "deck.cards"), str(tmp_path / "d.json")

    def statuses(epsilon: str) -> dict[str, tuple[str, bool]]:
        assert main(["diff", deck, "--epsilon", epsilon, "--json", out]) == 1
        return {
            r["route"]: (r["status"], r["agrees"]) for r in json.loads(Path(out).read_text(encoding="utf-8"))["routes"]
        }

    absolute, scaled = statuses(".01"), statuses("rel:1e-9")
    assert absolute.pop("listing") == scaled.pop("listing") == ("DATA NOT ACCEPTABLE", False)
    assert set(absolute.values()) == {("determined", True)}
    assert scaled.pop("listing + epsilon + corrected")[0] == "not run: a card cannot hold a scaled tolerance, rel:E"
    assert set(scaled.values()) == {("determined", True)}
    capsys.readouterr()


def test_diff_rejects_bad_input_in_one_line(tmp_path: Path, capsys) -> None:
    path = tmp_path / "p.csv"
    path.write_text("0,0,x\n")
    assert main(["diff", str(path)]) == 2
    assert main(["diff", str(tmp_path / "nosuch")]) == 2
    path.write_text("0,0,0\n1,0,0\n")
    assert main(["diff", str(path), "--epsilon", "much"]) == 2
    assert capsys.readouterr().err.count("\n") == 3
