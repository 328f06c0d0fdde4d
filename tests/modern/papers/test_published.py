"""The verdicts on published results of all papers, and ``hull1620 reproduce PAPER``."""

import json
from collections import Counter
from dataclasses import replace
from importlib import import_module
from importlib.resources import files
from pathlib import Path

import pytest

from modern.claims import published
from modern.cli.main import main
from modern.edition.apparatus import ApparatusError
from modern.edition.reproduce import DIFFERENT, EXACT

PAPER = published.PAPERS[0]
PLAIN = published.PublishedResult("one", "Fig. 1", "two numbers", ("1 2",), ("1 2",), ())
ROW = next(result.rows[0] for result in published.results_of(PAPER) if result.rows)


@pytest.mark.parametrize(
    ("result", "produced", "kind"),
    [
        (PLAIN, ["1   2"], EXACT),
        (PLAIN, ["1 3"], DIFFERENT),
        (PLAIN, ["1 2", "3"], DIFFERENT),
        (PLAIN, [], DIFFERENT),
        (replace(PLAIN, rows=(ROW,)), ["1 2"], published.CORRECTED),
        (replace(PLAIN, rows=(ROW,)), ["1 3"], DIFFERENT),
        (replace(PLAIN, differs="a slip"), ["1 3"], published.EXPLAINED),
        (replace(PLAIN, differs="a slip"), ["1 2"], DIFFERENT),
        (replace(PLAIN, differs="a slip"), [], DIFFERENT),
        (replace(PLAIN, cannot="no data"), [], published.CANNOT),
        (replace(PLAIN, cannot="no data"), ["1 2"], DIFFERENT),
    ],
)
def test_verdicts(result: published.PublishedResult, produced: list[str], kind: str) -> None:
    finding = published.judge(PAPER, result, produced)
    assert finding.kind == kind
    assert finding.holds == (kind != DIFFERENT)
    assert finding.excused == (kind in (published.EXPLAINED, published.CANNOT))


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        (('"1", "2"', '"2", "3"'), "two: result two: lines 2 to 3 do not exist or are in another result"),
        (('"1", "2"', '"3", "4"'), "two: result two: lines 3 to 4 do not exist or are in another result"),
        (('"1", "1"', '"3", "3"'), "two: lines 2 belong to no result; name them in results.toml"),
    ],
)
def test_every_line_of_the_print_belongs_to_one_result(tmp_path: Path, lines: tuple[str, str], message: str) -> None:
    (tmp_path / "witness.txt").write_text("## page 1\n1 2\n3 4\n5 6\n")
    (tmp_path / "apparatus.toml").write_text(
        '[text]\nid = "two"\ntitle = "two"\nwitness = "witness.txt"\nlayers = ["ocr"]\ndefault = ["ocr"]\n'
    )
    entry = '[[result]]\nid = "{}"\nplace = "p. 1"\nsays = "numbers"\nlines = [{}]\n'
    (tmp_path / "results.toml").write_text(entry.format("one", lines[0]) + entry.format("two", lines[1]))
    with pytest.raises(ApparatusError) as caught:
        published.read_results(PAPER, tmp_path)
    assert str(caught.value) == message


EMENDATIONS = [(paper, row.id) for paper in published.PAPERS for row in published.text_of(paper).rows]


@pytest.mark.parametrize(("paper", "row"), EMENDATIONS, ids=[row for _, row in EMENDATIONS])
def test_every_emendation_is_needed(paper: published.Paper, row: str, tmp_path: Path) -> None:
    """Without the row a result differs, or a line belongs to no result."""
    folder = files("transcripts").joinpath(paper.folder)
    head, *rows = folder.joinpath("apparatus.toml").read_text(encoding="utf-8").split("[[row]]")
    remaining = [part for part in rows if f'id = "{row}"' not in part]
    assert len(remaining) == len(rows) - 1
    (tmp_path / "apparatus.toml").write_text("[[row]]".join([head, *remaining]), encoding="utf-8")
    for name in ("witness.txt", "results.toml"):
        (tmp_path / name).write_bytes(folder.joinpath(name).read_bytes())
    try:
        produced = published.produced_by(paper)
        results = published.read_results(paper, tmp_path)
        assert DIFFERENT in [published.judge(paper, result, produced.get(result.id, ())).kind for result in results]
    except ApparatusError:
        assert row == "AW-09", "only this row deletes lines, which belong to no result"


@pytest.mark.parametrize("paper", published.PAPERS, ids=lambda paper: paper.name)
def test_a_changed_number_is_detected(paper: published.Paper) -> None:
    for finding in published.findings(paper):
        if finding.kind in (EXACT, published.CORRECTED):
            *lines, last = finding.produced
            assert published.judge(paper, finding.result, [*lines, f"{last}1"]).kind == DIFFERENT


@pytest.mark.parametrize("paper", published.PAPERS, ids=lambda paper: paper.name)
def test_the_command_reports_every_verdict(paper: published.Paper, tmp_path: Path, capsys) -> None:
    path = tmp_path / "verdicts.json"
    assert main(["reproduce", paper.name, "--json", str(path)]) == 0
    out = " ".join(capsys.readouterr().out.split())
    verdicts = list(published.findings(paper))
    kinds = Counter(finding.kind for finding in verdicts)
    assert out.startswith(paper.title)
    assert all(f"{count} {kind}" in out for kind, count in kinds.items())
    assert all(finding.result.cannot in out and finding.result.differs in out for finding in verdicts)
    assert out.endswith("Every printed result is reproduced, or a reason is given why it cannot be reproduced.")
    document = json.loads(path.read_text())["papers"]
    assert [(entry["result"], entry["verdict"]) for entry in document] == [(f.result.id, f.kind) for f in verdicts]


def test_a_result_that_is_not_reproduced_gives_exit_code_1(monkeypatch, capsys, request: pytest.FixtureRequest) -> None:
    module = import_module(PAPER.module)
    lines = dict(published.produced_by(PAPER))
    lines["fig14"] = ["1 1 3", *lines["fig14"][1:]]
    monkeypatch.setattr(module, "produced", lambda printed: lines)
    published.produced_by.cache_clear()
    request.addfinalizer(published.produced_by.cache_clear)
    assert main(["reproduce", PAPER.name]) == 1
    out = capsys.readouterr().out
    assert "Fig. 14: different" in out
    assert "printed 1 1 2; computed 1 1 3" in " ".join(out.split())
    assert "NOT every printed result is reproduced." in out
