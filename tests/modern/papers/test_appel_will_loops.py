"""The appendix, steps 1 to 10: types of intersection, steps as printed, and use counts (Figs. 20 to 23)."""

from itertools import product

import pytest

from modern.claims.published import PAPERS, results_of
from modern.papers.appel_will import PRINTED, Method, appel_will, printed
from modern.papers.appel_will.loops import find_loops, intersect, surface
from modern.papers.appel_will.results import found_solid
from modern.papers.appel_will.star import as_printed

PAPER = next(paper for paper in PAPERS if paper.name == "appel-will")
CUBE = list(product((0, 1), repeat=3))
FIG_14, FIG_23 = found_solid("fig14").points, found_solid("fig23").points


def entries(points: list[tuple[int, int, int]] | tuple[tuple[int, int, int], ...], *names: str) -> list[list[int]]:
    return [list(loop.entries) for loop in appel_will(points, method=printed(*names)).table.loops]


@pytest.mark.parametrize(
    ("edges", "kind", "signs", "start", "match"),
    [
        ([(1, 5), (1, 7)], 1, (-1, 2), 5, 7),
        ([(4, 9), (2, 4)], 2, (-1, -2), 9, 2),
        ([(2, 4), (4, 9)], 3, (1, 2), 2, 9),
        ([(2, 8), (3, 8)], 4, (1, -2), 2, 3),
    ],
)
def test_types_of_fig_20(edges, kind, signs, start, match) -> None:
    """In every type the loop runs from SP along L1 to the common point and along L2 to MP."""
    crossing = intersect(edges, 0, 1)
    assert crossing is not None
    assert (crossing.kind, crossing.entries, crossing.start, crossing.match) == (kind, signs, start, match)
    assert surface(crossing.entries, edges) == (start, crossing.common)


def test_rules_are_selected_and_searches_without_a_face_stop() -> None:
    assert intersect([(1, 2), (3, 4)], 0, 1) is None
    assert printed() == Method()
    assert printed(*PRINTED) == Method(as_printed, frozenset(PRINTED[1:]))
    with pytest.raises(ValueError, match="'step2' is not one of the names star, step3"):
        printed("step2")
    # All angles are right angles, so the condition alone would find no loop.
    assert entries(CUBE) == entries(CUBE, "step3")
    assert len(entries(CUBE)) == 6
    table = find_loops([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1), (0, 2)])
    assert table.loops == ()
    assert table.stopped == "the loop begun with lines 1 and 2 does not return to its start"
    assert not table.closed


@pytest.mark.parametrize("points", [FIG_14, FIG_23, CUBE], ids=["fig14", "fig23", "cube"])
@pytest.mark.parametrize("names", [(), ("step3",)])
def test_every_loop_adds_one_use_to_its_edges_and_none_has_three(points, names) -> None:
    table = appel_will(points, method=printed(*names)).table
    before = (0,) * len(table.uses)
    for loop in table.loops:
        increased = [label for label, (a, b) in enumerate(zip(before, loop.uses, strict=True), 1) if a != b]
        assert sorted(map(abs, loop.entries)) == increased
        assert max(loop.uses) <= 2
        before = loop.uses
    assert table.closed
    assert before == table.uses


def test_step_3_as_printed_finds_the_same_faces_in_the_same_order() -> None:
    """Without the dot-product condition three of the twelve printed loops run in the opposite sense."""
    for points in (FIG_14, FIG_23):
        preferred, literal = (appel_will(points, method=m) for m in (Method(), printed("step3")))
        assert [set(s) for s in preferred.surfaces] == [set(s) for s in literal.surfaces]
    differing = [
        (a, b)
        for points in (FIG_14, FIG_23)
        for a, b in zip(entries(points), entries(points, "step3"), strict=True)
        if a != b
    ]
    assert len(differing) == 3
    assert all(abs(a[0]) == abs(b[0]) for a, b in differing)


def test_steps_5_and_9_as_printed_fail() -> None:
    # With "go back to step 2", line 1 gets no second try, and the second loop begins with another line.
    (fig22,) = (result.corrected for result in results_of(PAPER) if result.id == "fig22-loops-1-3")
    second_loop = [int(entry) for entry in fig22[0].split("\t")[3].split()]
    for names in ((), ("step3",)):
        assert entries(FIG_14, "step5", *names)[1][0] != second_loop[0]
        assert entries(FIG_14, *names)[1] == second_loop
    # It excludes L1 and L2 only. The face of five points here needs lines 8 and 7 in descending order.
    points = [(-6, -6, 1), (-4, -4, 5), (-8, 14, 8), (-2, 0, 10), (0, 2, 14), (-4, 20, 17)]
    literal = appel_will(points, method=printed("step3", "step9"))
    assert "does not return to its start" in literal.fault
    assert not appel_will(points, method=printed("step3")).fault


def test_steps_7_and_10_as_printed_find_the_loops_in_another_way() -> None:
    # An L1 whose first L2 defines no plane of the hull is skipped.
    points = [(0, 0, 2), (1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, -2)]
    literal, corrected = entries(points, "step7"), entries(points)
    assert sorted(sorted(map(abs, loop)) for loop in literal) == sorted(sorted(map(abs, loop)) for loop in corrected)
    assert literal != corrected
    # Step 5 prevents repeated loops, and step 2 ends when all lines were addressed. No count becomes 2.
    hull = appel_will(FIG_14, method=printed("step10"))
    assert [set(s) for s in hull.surfaces] == [set(s) for s in appel_will(FIG_14).surfaces]
    assert all(max(loop.uses) == 1 for loop in hull.table.loops)
    assert (hull.fault, hull.table.uses, hull.table.in_loops) == ("", (0,) * 9, (2,) * 9)
    # If step 5 is also applied as printed, a face is missing.
    with_5 = appel_will(FIG_14, method=printed("step5", "step10"))
    assert with_5.fault == "3 of 9 edges are not used by exactly two loops"
