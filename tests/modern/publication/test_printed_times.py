"""Every printed time of the 1620 has the interval of its model, and every mean time that of its samples too."""

import csv
import re
from pathlib import Path

import pytest
from lxml import html

from emulator.machine.timing import COSTS, PUNCH_SECONDS, modelled, nominal
from modern.cli.main import main
from modern.publication.desk import Desk
from modern.publication.site.made import make
from tests.support import documents
from tests.support.paths import ROOT

UNIT = r"(?:ms|s|min|h|(?:micro|milli)?seconds?|minutes?|hours?)"
# A number and a unit, and the interval that is required: in between, or instead of the number.  A run begins at 0 s.
BOUNDS = r"\((?:[\d.,]+ to [\d.,]+|nominal)\)"
TIME = re.compile(rf"(?<![\w.,-])(?!0 s)(\d[\d.,]* to )?\d[\d,]*(?:\.\d+)?( {BOUNDS})?[ \u00a0-]{UNIT}\b")
ROUGH = re.compile(rf"\b(?:half|tenth|twentieth|hundredth|thousandth|fraction|few|some) (?:of an? )?{UNIT}\b")
INTERVAL = rf"[\d.,]+ {BOUNDS}"

# Texts with other times than those of the model, each with the reason why the model's interval does not apply.
OTHER = {
    r"CHANGELOG\.md|docs/explanation/(digital|engines|judge|verdicts)\.md|docs/papers/.*|docs/how-to/voxels\.md": (
        "times of programs on computers of today"
    ),
    r"README\.md|docs/index\.md: .* in ten minutes|docs/tutorial/.*: .* ten minutes|docs/how-to/.*: .* skip:.*": (
        "the time of a reader"
    ),
    r"docs/index\.md: .*estimated range: .*": "the interval is in the sentence",
    r"docs/explanation/context\.md: .* cycle of 20 microseconds.*": "published by IBM",
    r"docs/explanation/studies\.md: .*s work\.": "the size of a chunk on a computer of today",
    r"docs/reference/machine\.md: .*(library takes 124\.4 s|takes 79\.8 s).*": "measured in a simulator",
    r"docs/reference/machine\.md: .*(five minutes|tens of milliseconds).*": "times of the emulator",
}


def bare(text: str) -> list[str]:
    """Return the times in a text that have no interval."""
    return [match[0] for match in TIME.finditer(text) if not match[1] and not match[2]] + [
        match[0] for match in ROUGH.finditer(text)
    ]


def test_times_without_intervals_are_noticed_in_texts_and_listings(capsys) -> None:
    rough = "hundredth of a second"
    assert bare(f"in 20.9 s, 1,364 minutes, about a {rough}") == ["20.9 s", "1,364 minutes", rough]
    assert bare(f"{modelled(20.9)}, {nominal(PUNCH_SECONDS)}, {modelled(0.001)} and {modelled(400)}") == []
    assert main(["listing", "program1", "example1"]) == 0
    first = capsys.readouterr().out.splitlines()[0]
    assert TIME.search(first)
    assert bare(first) == []


def test_no_other_module_formats_a_time_of_the_model() -> None:
    """The desk and the tests may read ``seconds``; only the profile aligns them in a column, next to the interval."""
    formatted = re.compile(r"(?:time|processor|total)\.(?:seconds|low|high):")
    paths = [path for folder in ("emulator", "modern", "hull1620") for path in (ROOT / folder).rglob("*.py")]
    lines = [(path.name, line) for path in paths for line in path.read_text(encoding="utf-8").splitlines()]
    names = [(name, "interval" in line or "data-seconds" in line) for name, line in lines if formatted.search(line)]
    assert set(names) <= {("timing.py", True), ("run_output.py", True), ("machine.py", True)}


def test_the_profile_has_an_interval_in_every_row_except_zeros(capsys) -> None:
    assert main(["hull", "example4", "--profile"]) == 0
    rows = re.findall(r"^  cause .*?\n(.*?)^  operations", capsys.readouterr().err, re.DOTALL | re.MULTILINE)
    assert len(rows) == 2
    for line in "".join(rows).replace("  ~ includes estimated times, which no source states\n", "").splitlines():
        assert re.fullmatch(
            rf"  [a-z ]+? +\d* +(?:0\.0|(?!0\.0 ){INTERVAL.replace(' ', ' +', 1)})(, less with overlap|  ~)?", line
        ), line


@pytest.mark.parametrize(("page", "argument"), [("example", "6"), ("machine", "time"), ("facing", "program3")])
def test_pages_have_intervals(page: str, argument: str) -> None:
    tree = html.fromstring(f"<div>{''.join(part.html for part in make(page, argument))}</div>")
    texts = [
        " ".join(map(str, element.itertext())) for element in tree.iter("td", "text", "title", "figcaption", "span")
    ]
    texts += [str(title) for title in tree.xpath("//@title")]
    texts = [text.replace("\N{NO-BREAK SPACE}", " ") for text in texts]
    times = [time for text in texts for time in TIME.findall(text)]
    assert [time for text in texts for time in bare(text)] == []
    assert len(times) > 3


def test_the_desk_has_intervals() -> None:
    desk = Desk()
    desk.load({"program": "program1", "deck": "example1"})
    desk.run(1)
    desk.act("START")
    assert re.fullmatch(rf"{INTERVAL} {UNIT}", desk.run(10_000)["time"])
    scripts = [path.read_text(encoding="utf-8") for path in (ROOT / "docs" / "_static" / "desk").glob("*.js")]
    assert sum("{time} on a 1620" in script for script in scripts) == 1


@pytest.mark.parametrize("path", documents.PAGES, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_documents_have_intervals(path: Path) -> None:
    name, text = path.relative_to(ROOT).as_posix(), path.read_text(encoding="utf-8")
    places = [f"{name}: {' '.join(part.split())}" for part in re.split(r"\n\n|(?<=[.:]) (?=[A-Z])|(?<=[.:])\n", text)]
    reasons = re.compile("|".join(f"(?:{pattern})" for pattern in OTHER))
    found = [(place, times) for place in places if (times := bare(place)) and not reasons.match(place)]
    assert [(place, times) for place, times in found if not reasons.fullmatch(name)] == []


def test_quoted_times_of_operations_are_those_of_the_model() -> None:
    page = (ROOT / "docs" / "explanation" / "eight-digits.md").read_text(encoding="utf-8")
    quoted = [str(modelled(COSTS[name].milliseconds / 1000)) for name in ("FAD", "FDV")]
    assert [time for time in quoted if time not in " ".join(page.split())] == []
    assert quoted[0] in (ROOT / "docs" / "explanation" / "context.md").read_text(encoding="utf-8")
    time, low, high = re.findall(r"[\d.]+", quoted[0])
    home = " ".join((ROOT / "docs" / "index.md").read_text(encoding="utf-8").split())
    assert f"took about {time} ms to add two numbers (estimated range: {low} to {high} ms)" in home


@pytest.mark.parametrize("path", sorted((ROOT / "docs" / "studies").glob("*/*.csv")), ids=lambda path: path.stem)
def test_times_in_tables_of_studies_have_intervals(path: Path) -> None:
    """A mean has the interval of its samples, and the table has its bounds by the model in a column of its own."""
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    columns = {"minutes", "longest", "seconds", "processor", "reader", "punch", "typewriter"} & set(rows[0])
    cells = [row[column] for row in rows for column in columns]
    assert [cell for cell in cells if not re.fullmatch(INTERVAL, cell)] == []
    if columns:
        assert all(re.fullmatch(r"[\d.]+ to [\d.]+", row["by the model"]) for row in rows)
