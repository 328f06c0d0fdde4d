"""Storage maps compared with ``hull1620 map``, and pictures of times compared with the table of times."""

import re
from itertools import pairwise

import pytest
from lxml import etree

from emulator.objectdeck.extent import code_positions
from modern.cli.map import map_lines
from modern.edition import programs
from modern.publication.core import ARRAY, CORE, FREE, NAMES, PROGRAM, SINGLE, SYSTEM, core_map
from modern.publication.site.made import make
from modern.publication.site.pages.machine import example_runs, times_of

SVG = "{http://www.w3.org/2000/svg}"


def _html(argument: str) -> etree._Element:
    """Parse the generated HTML as XML, which fails if its elements are not nested correctly."""
    return etree.fromstring(f"<div>{''.join(part.html for part in make('machine', argument))}</div>")


@pytest.mark.parametrize("name", programs.NAMES)
def test_the_regions_fill_core_without_gaps(name: str) -> None:
    regions = core_map(name).regions
    assert (regions[0].low, regions[-1].high) == (0, CORE - 1)
    assert all(lower.high + 1 == upper.low for lower, upper in pairwise(regions))
    assert sum(region.positions for region in regions) == CORE == 40_000


@pytest.mark.parametrize("name", programs.NAMES)
def test_regions_equal_those_of_the_storage_map(name: str) -> None:
    """``hull1620 map`` prints the same addresses of arrays, length of data and free space."""
    storage = core_map(name)
    printed = "\n".join(map_lines(programs.program(name), CORE))
    arrays = re.findall(r"^  (\S+\(\d+\)) +array +(\d+) +(\d+) +(\d+)$", printed, re.MULTILINE)
    arrays_of_map = [(r.name, str(r.fields[0][1]), str(r.high), str(r.low)) for r in storage.regions if r.kind == ARRAY]
    assert arrays_of_map[::-1] == arrays
    data = re.search(r"data: (\d+) positions, from (\d+) down to (\d+)", printed)
    assert data is not None
    assert storage.positions(ARRAY) + storage.positions(SINGLE) == int(data[1])
    free = re.search(r"free between program and data: ~(\d+)", printed)
    assert free is not None
    assert storage.positions(FREE) == int(free[1])
    assert storage.positions(PROGRAM) == code_positions(programs.program(name))
    assert (storage.positions(SYSTEM), storage.positions(NAMES)) == (8_300, 120)


def test_the_table_agrees_with_the_bars() -> None:
    rows = _html("time").findall(".//tbody/tr")
    for row, run in zip(rows, example_runs(), strict=True):
        cells = [cell.text.replace("\N{NO-BREAK SPACE}", " ") for cell in row.findall("td")]
        assert cells == [*map(str, times_of(run)), str(run.total)]


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
