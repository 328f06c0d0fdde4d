"""Storage maps compared with ``hull1620 map``, and pictures of times compared with the table of times."""

from __future__ import annotations

import re
from itertools import pairwise

import pytest
from lxml import etree

from emulator.language.objectcode import code_positions
from modern.cli.map import map_lines
from modern.edition import programs
from modern.publication.core import ARRAY, CORE, FREE, NAMES, PROGRAM, SINGLE, SYSTEM, core_map
from modern.publication.site.made import make
from modern.publication.site.pages.machine import PARTS, PER_PIXEL, example_runs, map_svg, seconds_of, time_svg
from modern.publication.site.pictures import described

SVG = "{http://www.w3.org/2000/svg}"


def _html(argument: str) -> etree._Element:
    """What is made, which has to nest as XML does."""
    return etree.fromstring(f"<div>{''.join(part.html for part in make('machine', argument).parts)}</div>")


def _rectangles(picture: str, group: str) -> list[etree._Element]:
    return etree.fromstring(picture).findall(f".//{SVG}g[@class='{group}']/{SVG}rect")


@pytest.mark.parametrize("name", programs.NAMES)
def test_the_regions_fill_core_without_gaps(name: str) -> None:
    regions = core_map(name).regions
    assert (regions[0].low, regions[-1].high) == (0, CORE - 1)
    assert all(one.high + 1 == other.low for one, other in pairwise(regions))
    assert sum(region.positions for region in regions) == CORE == 40_000


@pytest.mark.parametrize("name", programs.NAMES)
def test_regions_equal_those_of_the_storage_map(name: str) -> None:
    """What ``hull1620 map`` prints: every array's addresses, the data's length, what is free."""
    found = core_map(name)
    printed = "\n".join(map_lines(programs.program(name), CORE))
    arrays = re.findall(r"^  (\S+\(\d+\)) +array +(\d+) +(\d+) +(\d+)$", printed, re.MULTILINE)
    told = [(r.name, str(r.fields[0][1]), str(r.high), str(r.low)) for r in found.regions if r.kind == ARRAY]
    assert told[::-1] == arrays
    data = re.search(r"data: (\d+) positions, from (\d+) down to (\d+)", printed)
    assert data is not None
    assert found.positions(ARRAY) + found.positions(SINGLE) == int(data[1])
    free = re.search(r"free between: ~(\d+)", printed)
    assert free is not None
    assert found.positions(FREE) == int(free[1])
    assert found.positions(PROGRAM) == code_positions(programs.program(name))
    assert (found.positions(SYSTEM), found.positions(NAMES)) == (8_300, 120)


@pytest.mark.parametrize("name", programs.NAMES)
def test_a_map_is_drawn_to_scale(name: str) -> None:
    found = core_map(name)
    rectangles = _rectangles(map_svg(found), "regions")
    assert [int(each.get("data-positions", "")) for each in rectangles] == [r.positions for r in found.regions]
    heights = [float(each.get("height", "")) * PER_PIXEL for each in rectangles]
    assert heights == pytest.approx([region.positions for region in found.regions])
    assert sum(heights) == pytest.approx(CORE)
    bases = [float(each.get("y", "")) + float(each.get("height", "")) for each in rectangles]
    assert [(bases[0] - base) * PER_PIXEL for base in bases] == pytest.approx([r.low for r in found.regions])


def test_program_3_is_the_fullest() -> None:
    """The thesis's 51 points fit; in half the core no program does."""
    maps = {name: core_map(name) for name in programs.NAMES}
    assert min(maps.values(), key=lambda found: found.positions(FREE)).program == "program3"
    for found in maps.values():
        points = dict(found.points)
        assert points[20_000] == 0
        assert points[40_000] >= 51


def test_bars_of_time_are_complete_and_to_scale() -> None:
    found = example_runs()
    assert [(run.example, run.program) for run in found] == [
        *((1, "program1_examples"), (2, "program1_examples"), (3, "program1_examples")),
        *((4, "program1_examples"), (4, "program2"), (5, "program1_examples"), (5, "program3")),
        *((6, "program1_examples"), (6, "program3")),
    ]
    for run in found:
        assert {row.cause for row in run.rows} == {cause for causes in PARTS.values() for cause in causes}
        assert sum(seconds_of(run)) == pytest.approx(run.total)
    rectangles = _rectangles(time_svg(found), "parts")
    scales = [
        float(each.get("width", "")) / float(each.get("data-seconds", ""))
        for each in rectangles
        if float(each.get("width", "")) > 5
    ]
    assert len(scales) > 20
    assert max(scales) / min(scales) < 1.003
    bars: dict[str, float] = {}
    for each in rectangles:
        bars[each.get("y", "")] = bars.get(each.get("y", ""), 0) + float(each.get("width", ""))
    assert [wide / scales[0] for wide in bars.values()] == pytest.approx([run.total for run in found], rel=0.005)


def test_the_page_describes_the_longest_part_correctly() -> None:
    for run in example_runs():
        parts = dict(zip(PARTS, seconds_of(run), strict=True))
        longest = max(parts, key=lambda name: parts[name])
        assert longest in (("floating point",) if run.program == "program3" else ("card punch", "number conversion"))


def test_the_table_agrees_with_the_bars() -> None:
    rows = _html("time").findall(".//tbody/tr")
    told = [[float(str(cell.text)) for cell in row.findall("td")] for row in rows]
    for cells, run in zip(told, example_runs(), strict=True):
        assert cells == pytest.approx([*seconds_of(run), run.total], abs=0.051)


@pytest.mark.parametrize("argument", ["storage", "time"])
def test_pictures_have_descriptions_and_unique_ids(argument: str) -> None:
    html = _html(argument)
    ids = [str(id) for id in html.xpath("//@id")]
    assert len(set(ids)) == len(ids)
    pictures = html.findall(f".//{SVG}svg")
    assert len(pictures) == (len(programs.NAMES) if argument == "storage" else 1)
    for picture in pictures:
        assert picture.findtext(f"{SVG}title")
        assert picture.findtext(f"{SVG}desc")
        assert {picture.get("aria-labelledby"), picture.get("aria-describedby")} <= set(ids)


def test_a_description_is_not_inserted_twice() -> None:
    once = described(map_svg(core_map("program2")), "words & more")
    assert '<desc id="desc">words &amp; more</desc>' in once
    assert described(once, "others") == once


def test_an_unknown_argument_is_rejected() -> None:
    with pytest.raises(ValueError, match="'drum' is not one of storage, time"):
        make("machine", "drum")
