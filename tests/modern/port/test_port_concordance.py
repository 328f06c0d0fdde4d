"""docs/reference/concordance.md: labels and functions exist. The two rules of the text as a variant of the port."""

import random
import re
from importlib import import_module
from pathlib import Path

import pytest

from modern.edition import programs
from modern.port import convex_hull
from tests.support.paths import ROOT

TEXT = Path(ROOT, "docs", "reference", "concordance.md").read_text(encoding="utf-8")
ROWS = [
    [cell.strip() for cell in line.strip("|").split("|")]
    for line in TEXT.splitlines()
    if re.match(r"\| .* \| [\d, -]+ \| [123] \|", line)
]


def test_every_row_names_existing_labels_and_an_existing_function() -> None:
    assert len(ROWS) > 20
    for step, _, program, statements, function in ROWS:
        labels = {card.text[:5].strip() for card in programs.deck(f"program{program}").cards}
        assert set(re.findall(r"\d+", statements)) <= labels, step
        module, *names = function.strip("`").split(".")
        target = import_module(f"modern.port.{module}")
        for name in names:
            target = getattr(target, name)


@pytest.mark.parametrize("seed", range(3))
def test_rules_of_the_text_give_the_same_hull_or_no_fourth_point(seed: int) -> None:
    draw, without = random.Random(seed), 0
    for _ in range(60):
        points = list({(draw.randint(-9, 9), draw.randint(-9, 9), draw.randint(-9, 9)) for _ in range(9)})
        listing, text = convex_hull(points), convex_hull(points, text=True, on_refusal="return")
        if text.determined:
            assert {face.lowest for face in text.faces} == {face.lowest for face in listing.faces}
            assert set(text.vertices) == set(listing.vertices)
        else:
            without += 1
            assert text.statement == "chapter 3, p. 29"
    assert without < 15


def test_rules_of_the_text_differ_only_for_points_in_space() -> None:
    corner = [(1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, 0)]
    assert convex_hull(corner).determined
    assert not convex_hull(corner, text=True, on_refusal="return").determined
    for points in ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)], [(0, 0, 0), (1, 1, 1), (3, 3, 3)]):
        assert convex_hull(points, text=True, on_refusal="return") == convex_hull(points)
