"""The print of Appel & Will: the source of Fig. 4, and the agreement of the loops and the map of Fig. 23."""

import pytest

from modern.claims.published import PAPERS, printed_lines, results_of
from modern.papers.appel_will.results import found_solid, printed_solid

PAPER = next(paper for paper in PAPERS if paper.name == "appel-will")
RESULTS = {result.id: result for result in results_of(PAPER)}


def test_fig_4_is_read_from_the_print_and_not_from_our_coordinates() -> None:
    with pytest.raises(KeyError):
        found_solid("fig4")
    solid = printed_solid(printed_lines(PAPER))
    assert (len(solid.points), len(solid.surfaces)) == (10, 7)


def test_the_printed_loops_and_map_of_fig_23_agree() -> None:
    """The rule of Fig. 23 on signs is applied to the corrected print alone."""
    lines = [line.split() for line in RESULTS["fig23-edges"].corrected]
    ends = {int(label): (int(i), int(j)) for label, i, j in lines}
    columns: list[list[int]] = [[] for _ in range(7)]
    for line in RESULTS["fig23-loops"].corrected:
        for column, cell in zip(columns, line.split("\t")[1:], strict=True):
            column.extend(int(entry) for entry in cell.split())
    surfaces = [[ends[abs(entry)][0 if entry > 0 else 1] for entry in column] for column in columns]
    for row, line in enumerate(RESULTS["fig23-map"].corrected):
        cells = line.split("\t")[1:]
        assert [int(c) if c else None for c in cells] == [s[row] if row < len(s) else None for s in surfaces]
