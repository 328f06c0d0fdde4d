"""The recorded reason why row d of Nakamae and Nishita's Table 1 cannot be computed."""

from fractions import Fraction

from modern.claims.published import PAPERS, results_of
from modern.papers.nakamae_nishita.hidden import draw
from modern.papers.nakamae_nishita.projection import parallel
from modern.papers.nakamae_nishita.shapes import column, moved, placed, plate, round_base

PAPER = next(paper for paper in PAPERS if paper.name == "nakamae-nishita")


def test_25_prisms_and_five_plates_have_the_counts_of_table_1_d() -> None:
    """Check the recorded reason, which adds that thirty prisms with as many vertices have ten more faces."""
    zero, up = Fraction(0), (Fraction(0), Fraction(0), Fraction(1))

    def counts(sides: list[int], plates: list[int]) -> tuple[int, int, int, int]:
        shapes = [column("column", round_base("column", n, Fraction(1)), up) for n in sides]
        shapes += [plate("plate", round_base("plate", n, Fraction(1))) for n in plates]
        disjoint = [placed(p, moved((Fraction(10 * k), zero, zero)), f"{k}") for k, p in enumerate(shapes)]
        return draw(disjoint, parallel((1, -2, 3))).counts

    (printed,) = (result.corrected[0].split() for result in results_of(PAPER) if result.id == "table1-d")
    assert printed[1:4] == [str(count) for count in counts([4] * 23 + [3] * 2, [4] * 5)[:3]]
    assert counts([4] * 18 + [3] * 12, [])[:3] == (30, int(printed[2]), int(printed[3]) + 10)
