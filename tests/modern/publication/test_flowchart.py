"""Flow charts: every transition of the compiled program is drawn once, and no line crosses a box."""

import xml.etree.ElementTree as ET
from collections import Counter
from dataclasses import replace

import pytest
from hypothesis import example, given, settings

from emulator.errors import EmulatorError
from emulator.language.compiler import translate
from modern.edition.programs import NAMES
from modern.edition.programs import program as built_in
from modern.publication.chart import Chart, chart, wrapped
from modern.publication.chart_svg import chart_svg
from modern.publication.flow import flow
from tests.support.charts import drawn_ways, faults, ways
from tests.support.commands import call
from tests.support.decks_at_random import programs
from tests.support.deckwork import program, source

SVG = "{http://www.w3.org/2000/svg}"
LOOP = ("DO 10 I=1,3", "10 CONTINUE", "20 GO TO 20", "END")


@pytest.mark.parametrize("name", NAMES)
def test_every_transition_of_a_listing_is_drawn_once_without_collisions(name: str) -> None:
    compiled = built_in(name)
    control_flow = flow(compiled)
    drawn = drawn_ways(control_flow)
    assert not ways(compiled) - drawn
    # The chart also draws the transitions to the next statement.
    assert all(taken == "" for _, taken, _ in drawn - ways(compiled))
    assert faults(chart(control_flow)) == []


@settings(max_examples=50, deadline=None)
@given(programs())
@example(["DIMENSION X(3)", "READ 9,(X(K),K=1,3),(X(K),K=1,3)", "9 FORMAT(F4.1)", "END"])
def test_charts_of_random_programs_have_no_collisions(cards: list[str]) -> None:
    try:
        compiled, _ = translate(source(*cards))
    except EmulatorError:
        return
    if compiled is None:
        return
    control_flow = flow(compiled)
    assert not ways(compiled) - drawn_ways(control_flow)
    for height in (860, 300):
        drawn = chart(control_flow, height)
        assert faults(drawn) == []
        assert all(page.height <= height or len(page.boxes) == 1 for page in drawn.pages)


def test_boxes_of_a_small_program() -> None:
    """A DO becomes its first assignment and a decision after its last statement.  An IF has exits on three sides."""
    lines = ["READ 9,N", "J=0", "DO 2 I=1,N", "J=J+I", "2 CONTINUE", "IF(J-5)1,2,3", "1 STOP", "3 J=1", "9 FORMAT(I2)"]
    control_flow = flow(program(*lines, "END"))
    assert [(box.kind, box.name, box.lines) for box in control_flow.boxes] == [
        ("input/output", "card 1", ("READ 9,N",)),
        ("processing", "card 2", ("J=0", "I=1")),
        ("processing", "card 4", ("J=J+I",)),
        ("step", "2", ()),
        ("decision", "card 3", ("I+1 <= N",)),
        ("decision", "card 6", ("J-5",)),
        ("end", "1", ("STOP",)),
        ("processing", "3", ("J=1",)),
        ("end", "card 10", ("END",)),
    ]
    assert [(way.taken, way.side, way.target) for way in control_flow.boxes[5].exits] == [
        ("-", "left", 6),
        ("0", "down", 3),
        ("+", "right", 7),
    ]
    assert [(way.taken, way.side, way.target) for way in control_flow.boxes[4].exits] == [
        ("again", "left", 2),
        ("done", "down", 5),
    ]


def test_a_go_to_is_a_line_without_a_number_and_a_step_with_one() -> None:
    control_flow = flow(program("1 A=1.", "GO TO 3", "2 GO TO 1", "3 IF(A)1,2,2", "END"))
    assert [(box.kind, box.name, box.cards) for box in control_flow.boxes] == [
        ("processing", "1", (1, 2)),
        ("step", "2", (3,)),
        ("decision", "3", (4,)),
        ("end", "card 5", (5,)),
    ]
    assert control_flow.boxes[0].exits[0].target == 2


def test_computed_go_tos_and_long_statements_are_written_in_boxes() -> None:
    control_flow = flow(program("1 I=2", "GO TO (1,2,1),I", "2 STOP", "END"))
    assert [(way.taken, way.target) for way in control_flow.boxes[1].exits] == [("1, 3", 0), ("2", 2)]
    assert control_flow.boxes[1].lines == ("I",)
    rows = wrapped("C3 = (Y(I2) - Y(I1)) *Z(I1) + (Z(I1) - Z(I2)) *Y(I1)")
    assert all(len(row) <= 39 for row in rows)
    assert "".join("".join(rows).split()) == "C3=(Y(I2)-Y(I1))*Z(I1)+(Z(I1)-Z(I2))*Y(I1)"


def _shifted(drawn: Chart, x: int) -> Chart:
    """Return the chart with the vertical part of every rail moved."""
    page = drawn.pages[0]
    paths = tuple(
        replace(path, corners=tuple((x, b) if 0 < k < 3 else (a, b) for k, (a, b) in enumerate(path.corners)))
        if len(path.corners) > 4  # the line of a jump within the page
        else path
        for path in page.paths
    )
    return replace(drawn, pages=(replace(page, paths=paths), *drawn.pages[1:]))


def test_the_collision_checks_detect_a_bad_chart() -> None:
    drawn = chart(
        flow(program("1 A=1.", "IF(A)1,2,3", "2 A=2.", "B=1.", "3 IF(A)4,1,5", "4 STOP", "5 A=1.", "GO TO 2", "END"))
    )
    assert faults(drawn) == []
    page = drawn.pages[0]
    assert any("through box" in fault for fault in faults(_shifted(drawn, 200)))
    assert any("on one line" in fault for fault in faults(_shifted(drawn, 50)))
    missing = replace(drawn, pages=(replace(page, paths=page.paths[1:]),))
    assert any("not at all" in fault for fault in faults(missing))
    assert any(
        "out of order" in fault for fault in faults(replace(drawn, pages=(replace(page, boxes=page.boxes[:-1]),)))
    )
    wide = tuple(replace(box, lines=("X" * 50,)) for box in page.boxes)
    assert any("too long" in fault for fault in faults(replace(drawn, pages=(replace(page, boxes=wide),))))


def test_the_picture_is_xml_with_every_statement_as_text() -> None:
    drawn = chart(flow(built_in("program2")))
    text = chart_svg(drawn)
    assert text == chart_svg(chart(flow(built_in("program2"))))
    root = ET.fromstring(text)
    rows = Counter(element.text for element in root.iter(f"{SVG}text"))
    for page in drawn.pages:
        for box in page.boxes:
            assert all(rows[line] for line in box.lines)
    assert root.find(f"{SVG}title").text == "Flow chart of program2.f"
    assert len(root.findall(f"{SVG}g")) == len(drawn.pages)


def test_boxes_have_links_and_pages_add_up_to_the_chart() -> None:
    drawn = chart(flow(program(*LOOP)))
    root = ET.fromstring(chart_svg(drawn, link=lambda box: f"x.html#{box.name}" if box.label else ""))
    assert [a.get("href") for a in root.iter(f"{SVG}a")] == ["x.html#10", "x.html#20"]
    drawn = chart(flow(built_in("program1")))
    sheets = [chart_svg(drawn, k) for k in range(1, len(drawn.pages) + 1)]
    heights = [int(ET.fromstring(text).get("height", "0")) for text in sheets]
    assert sum(heights) == int(ET.fromstring(chart_svg(drawn)).get("height", "0"))
    with pytest.raises(IndexError):
        chart_svg(drawn, len(drawn.pages) + 1)


def test_the_command(capsys) -> None:
    code, out, err = call(capsys, "flowchart", "program2", "--page", "2")
    assert (code, err) == (0, "")
    assert out == chart_svg(chart(flow(built_in("program2"))), 2)
    code, out, _ = call(capsys, "flowchart", "program1", "--table")
    assert code == 0
    assert out.splitlines()[:3] == [
        "from      taken for  to",
        "100       next       card 5",
        "card 5    next       101",
    ]
    assert "card 12   -          102" in out.splitlines()
    code, out, err = call(capsys, "flowchart", "program2", "--page", "99")
    assert (code, out) == (2, "")
    assert err.startswith("hull1620: --page: expected 1 to 15, found 99")
