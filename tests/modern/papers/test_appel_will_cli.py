"""The command ``hull1620 appel-will``: its tables, its options and its error messages."""

from pathlib import Path

import pytest

from modern.formats.off import parse_off
from tests.support.commands import call

FIG_4 = """OFF
10 7 15
1 0 2
0 0 2
0 1 1
1 1 1
0 2 1
1 2 1
0 0 0
1 0 0
1 2 0
0 2 0
4 0 1 2 3
4 2 3 5 4
4 4 5 8 9
4 0 1 6 7
4 6 7 8 9
5 0 3 5 8 7
5 1 2 4 9 6
"""
CROWN = """OFF
9 9 16
3 0 0
1 1 0
0 3 0
-1 1 0
-3 0 0
-1 -1 0
0 -3 0
1 -1 0
0 0 4
8 7 6 5 4 3 2 1 0
""" + "".join(f"3 {k} {(k + 1) % 8} 8\n" for k in range(8))


@pytest.fixture
def folder(tmp_path: Path, monkeypatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("fig4.off").write_text(FIG_4, encoding="utf-8")
    Path("crown.off").write_text(CROWN, encoding="utf-8")
    return tmp_path


def section(out: str, head: str) -> list[str]:
    """Return the lines below a heading, up to the next empty line."""
    lines = out.split("\n")
    start = lines.index(head) + 1
    return lines[start : lines.index("", start)]


def test_tables_of_fig_4(folder: Path, capsys) -> None:
    code, out, err = call(capsys, "appel-will", "fig4.off")
    assert (code, err) == (0, "")
    assert "deleted as lying between two others: 4 (1-9), 3 (2-10)" in out
    assert "31 projections; a polyhedron of 8 points" in out
    assert len(section(out, "Convex edge list")) == 13
    assert [row.split()[0] for row in section(out, "Vertex list")[1:]] == ["1", "2", "5", "6", "7", "8", "9", "10"]
    assert section(out, "Topological map")[0] == "surface 1: 2 1 6 5"
    assert section(out, "Input surfaces")[-1] == "added: surface 1"
    assert "IUC" not in out


def test_trace_fits_the_use_counts_to_the_width_of_the_terminal(folder: Path, capsys, monkeypatch) -> None:
    for columns in ("40", "100"):
        monkeypatch.setenv("COLUMNS", columns)
        code, out, _ = call(capsys, "appel-will", "fig4.off", "--trace")
        assert code == 0
        table = section(out, "Loop table")
        assert max(map(len, table)) <= int(columns)
        first = [row for row in table[: table.index("LUP(2,N)  -1 3 -9 -5")] if "IUC" in row]
        counts = [count for row in first for count in row.split()[1:]]
        assert counts == list("110101000000")
        assert "  type 1, start SP 2, match MP 6" in table


def test_literal_lists_the_false_edges_of_the_star_test(folder: Path, capsys) -> None:
    code, out, _ = call(capsys, "appel-will", "fig4.off", "--literal")
    assert code == 1
    assert "lines are not edges of the hull:" in out
    assert out.splitlines()[-1].startswith("no hull: ")
    assert "Input surfaces" not in out
    code, out, err = call(capsys, "appel-will", "fig4.off", "--printed", "step3,step5,step7,step9,step10")
    assert (code, err) == (
        1,
        ("note: these rules are applied as the paper prints them: step3, step5, step7, step9, step10\n"),
    )
    assert "lines are not edges of the hull" not in out
    assert out.splitlines()[-1] == "no hull: the loop begun with lines 3 and 1 does not return to its start"
    code, out, _ = call(capsys, "appel-will", "fig4.off", "--printed", "star")
    assert code == 1
    assert "lines are not edges of the hull" in out


def test_step_3_as_printed_reverses_a_loop(folder: Path, capsys) -> None:
    Path("fig14.csv").write_text("0,0,4\n8,0,4\n4,8,4\n1,-2,0\n9,14,0\n17,-2,0\n", encoding="utf-8")
    _, preferred, _ = call(capsys, "appel-will", "fig14.csv")
    code, as_printed, err = call(capsys, "appel-will", "fig14.csv", "--printed", "step3")
    assert (code, err) == (0, "note: these rules are applied as the paper prints them: step3\n")
    assert "LUP(3,N)  2 6 -7 -3" in preferred
    assert "LUP(3,N)  -2 3 7 -6" in as_printed
    code, out, _ = call(capsys, "appel-will", "fig14.csv", "--printed", "step10")
    assert code == 0
    assert out.endswith("\n9 of 9 counts IUC are wrong at the end: step 10 as printed sets all counts to 0\n")


def test_rule_any_reports_whether_its_condition_is_met(folder: Path, capsys) -> None:
    _, out, _ = call(capsys, "appel-will", "fig4.off", "--inside-corners", "any")
    assert "points deleted before the first projection by the rule any: 3 4" in out
    assert "28 projections" in out
    assert "  it holds for the input surfaces" in out
    _, out, _ = call(capsys, "appel-will", "crown.off", "--inside-corners", "any")
    assert "it does NOT hold at 9: the hull may be wrong" in out
    _, out, _ = call(capsys, "appel-will", "crown.off", "--inside-corners", "two")
    assert "NOT" not in out
    assert "a polyhedron of 5 points" in out


def test_the_output_is_an_off_file_of_the_hull(folder: Path, capsys) -> None:
    assert call(capsys, "appel-will", "fig4.off", "-o", "hull.off")[0] == 0
    mesh = parse_off(Path("hull.off").read_text(encoding="utf-8"), "hull.off")
    assert (len(mesh.points), len(mesh.faces)) == (8, 6)
    code, out, _ = call(capsys, "appel-will", "hull.off")
    assert code == 0
    assert out.count("kept as") == 6
    code, out, err = call(capsys, "appel-will", "fig4.off", "-o", "-")
    assert out == Path("hull.off").read_text(encoding="utf-8")
    assert "Loop table" in err
    assert call(capsys, "appel-will", "fig4.off", "--literal", "-o", "wrong.off")[0] == 1
    assert not Path("wrong.off").exists()


@pytest.mark.parametrize(
    ("text", "summary"),
    [
        ("1,2,3\n", "1 point\n0 projections; a point\n"),
        ("1,2,3\n1,2,3\n2,3,4\n", "a segment of 2 points"),
        ("0,0,0\n1,0,0\n0,1,0\n.25,.25,0\n", "a polygon of 3 points"),
    ],
)
def test_flat_input_has_a_summary(folder: Path, capsys, text: str, summary: str) -> None:
    Path("flat.csv").write_text(text, encoding="utf-8")
    code, out, err = call(capsys, "appel-will", "flat.csv")
    assert code == 0
    assert summary in out
    assert err == ("note: flat.csv: line 2 repeats the point of line 1\n" if text.count("1,2,3") == 2 else "")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["nosuch.off"], "nosuch.off: no such file or directory"),
        (["."], ".: is a directory"),
        (["bad.off"], "bad.off: line 3, column 1: the file ends after 0 of 4 vertices"),
        (["two.off"], "two.off: surface 1: expected at least 3 points, found 2"),
        (["twice.off"], "twice.off: surface 1: it contains a point twice"),
        (["points.csv", "--inside-corners", "any"], "points.csv: --inside-corners needs the surfaces"),
        (["crown.off", "--printed", "step4"], "--printed: 'step4' is not one of the names star, step3, step5,"),
        (["crown.off", "--literal", "--printed", "star"], "not allowed with argument --literal"),
        (["open.off", "--inside-corners", "two"], "open.off: surface 1: line 1-2 lies on 1 surface,"),
        (["fig4.off", "-o", "nosuch/hull.off"], "nosuch/hull.off: no such file or directory"),
        (["fig4.off", "-o", "."], ".: is a directory"),
    ],
)
def test_an_error_is_one_line(folder: Path, capsys, arguments: list[str], message: str) -> None:
    Path("bad.off").write_text("OFF\n4 4 6\n", encoding="utf-8")
    triangle = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n"
    Path("two.off").write_text(triangle + "2 0 1\n", encoding="utf-8")
    Path("twice.off").write_text(triangle + "3 0 1 1\n", encoding="utf-8")
    Path("open.off").write_text(triangle + "3 0 1 2\n", encoding="utf-8")
    Path("points.csv").write_text("0,0,0\n1,0,0\n", encoding="utf-8")
    code, out, err = call(capsys, "appel-will", *arguments)
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert message in err
