"""``reproduce --show``: print and result in two columns or one below the other, with differences marked."""

import json
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from modern.claims.published import PAPERS, findings
from modern.cli.shared.side_by_side import masks_by_column, masks_by_text, side_by_side
from modern.edition.chapter6 import prints
from tests.support.commands import call


def test_two_columns_mark_each_character() -> None:
    assert list(side_by_side(["A=1.25", "B", "C"], ["A=1.35", "B"], 60)) == [
        "      = equal; | different, marked by ^",
        "            print    result",
        "         1  A=1.25 | A=1.35",
        "                ^        ^",
        "         2  B      = B",
        "         3  C      |",
        "            ^        ^",
    ]


def test_a_narrow_terminal_shows_one_text_below_the_other() -> None:
    assert list(side_by_side(["A=1.25", "B"], ["A=1.35", "B"], 26)) == [
        "      = equal; |",
        "      different, marked by",
        "      ^",
        "     1 | print  A=1.25",
        "         result A=1.35",
        "                    ^",
        "     2 =        B",
    ]


def test_marks_follow_columns_words_and_positions() -> None:
    found = list(side_by_side(["N=2", "ONE", "TWO"], ["N=2", "TWO", "ONE"], 60))
    assert found[0].strip() == "= equal; ~ at another position"
    assert not any("^" in line for line in found)
    # A line that occurs twice there and once here is marked.
    assert any("^" in line for line in side_by_side(["ONE", "TWO", "TWO"], ["TWO", "ONE", "ONE"], 60))
    assert masks_by_column("  .5", " .5") == (" ^^^", " ^^^")
    assert masks_by_text("9 1 2 C", "9 1 2 0") == ("      ^", "      ^")
    assert masks_by_text("2 3 4 1 1", "2 1 1") == ("  ^ ^", "")
    (line,) = [line for line in side_by_side(["1\t2"], ["1 2"], 60, columns=False) if line.startswith("         1")]
    assert " = " in line
    # Both lines are marked up to the end of the longer one.
    for one, other in (([], ["1" * 18]), (["1" * 18], []), (["12"], ["1" * 18])):
        *_, line, marks = side_by_side(one, other, 60)
        at = line.index("|") + 2
        assert marks[at:] == ("^" * 18 if "12" not in one else " " + "^" * 17)
        assert max(map(len, side_by_side(one, other, 50))) <= 50


TEXT = st.lists(st.text("ABC .1", max_size=40).map(str.rstrip), max_size=6)


def told(found: list[str]) -> tuple[str, ...]:
    """Return both texts as the lines show them, without blanks: in two columns, or pair by pair."""
    texts = ["", ""]
    at, shown = 0, [0]
    rows = [line for line in found if line.strip(" ^")]
    if any(line.split() == ["print", "result"] for line in rows):
        while rows.pop(0).split() != ["print", "result"]:
            pass
        at = next(line.index("result") for line in found if line.split() == ["print", "result"])
        for line in rows:
            texts[0] += line[12 : at - 3]
            texts[1] += line[at:]
        return tuple(text.replace(" ", "") for text in texts)
    while rows and not re.match(r" +\d+ [=~|]", rows[0]):
        rows.pop(0)
    for line in rows:
        title = line[9:15].strip()
        shown = [["print", "result"].index(title)] if title else [0, 1] if line[7:8] == "=" else shown
        for k in shown:
            texts[k] += line[16:]
    return tuple(text.replace(" ", "") for text in texts)


@given(TEXT, TEXT, st.integers(50, 140), st.booleans())
def test_nothing_is_lost_and_no_line_is_too_long(one: list[str], other: list[str], width: int, columns: bool) -> None:
    found = list(side_by_side(one, other, width, columns=columns))
    assert all(len(line) <= width for line in found)
    assert told(found) == tuple("".join(text).replace(" ", "") for text in (one, other))
    assert bool(found) == bool(one or other)


@pytest.mark.parametrize("width", [60, 100, 170])
@pytest.mark.parametrize("example", [1, 4, 5])
def test_every_card_of_an_example_is_shown(example: int, width: int, monkeypatch, capsys) -> None:
    monkeypatch.setenv("COLUMNS", str(width))
    code, out, err = call(capsys, "reproduce", str(example), "--show")
    assert (code, err) == (0, "")
    lines = out.splitlines()
    assert max(map(len, lines)) <= width
    for printed in prints(example):
        for card in printed.lines:
            if width == 170 and card.strip():
                assert any(re.match(rf" +\d+  {re.escape(card)} +[=~|]", line) for line in lines), card
            elif width == 100 and card.strip():
                assert any(card.rstrip() in line for line in lines), card
    # Exact results have no mark, and different choices of the listing have one.
    exact, listed = out.split("program 1 as listed")
    assert "^" not in exact
    assert "^" in listed


def test_every_result_of_a_paper_that_is_computed_is_shown(monkeypatch, capsys) -> None:
    monkeypatch.setenv("COLUMNS", "200")
    (paper,) = (paper for paper in PAPERS if paper.name == "appel-will")
    code, out, _ = call(capsys, "reproduce", "appel-will", "--show")
    assert code == 0
    for finding in findings(paper):
        assert finding.result.place in out
        for line in finding.produced:
            assert line.strip().expandtabs(2) in out


def test_json_on_standard_output_is_the_only_output(capsys) -> None:
    code, out, err = call(capsys, "reproduce", "1", "--show", "--json", "-")
    assert code == 0
    assert json.loads(out)["reproduced"] is True
    assert "CONVEX HULL" in err
