"""What Kovalevsky and Schulz publish, against what is computed; and the command that prints it."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest

from modern.claims.published import (
    CANNOT,
    CORRECTED,
    EXPLAINED,
    PAPERS,
    findings,
    judge,
    produced_by,
    results_of,
    text_of,
)
from modern.cli.main import main
from modern.digital.volumes import half_ball
from modern.edition.apparatus import build
from modern.edition.reproduce import DIFFERENT, EXACT
from modern.formats.off import parse_off

PAPER = next(paper for paper in PAPERS if paper.name == "kovalevsky-schulz")
KINDS = {
    **dict.fromkeys(("ball-voxels", "ball-corners-6", "ball-corners-26", "ball-triangles", "ball-faces"), EXACT),
    **dict.fromkeys(("table1", "table2", "table3", "formula-5", "table4-triangulation", "table4-hull"), EXACT),
    **dict.fromkeys(("future-car", "triangulations"), CANNOT),
    **{f"table5-{diameter}": EXACT for diameter in range(8, 23, 2)},
    "table5-8": EXPLAINED,
    "table5-12": EXPLAINED,
    "table5-18": CORRECTED,
}


def test_every_verdict() -> None:
    assert {finding.result.id: finding.kind for finding in findings(PAPER)} == KINDS


@pytest.mark.parametrize("row", [row.id for row in text_of(PAPER).rows])
def test_without_a_row_of_the_apparatus_a_result_differs(row: str) -> None:
    corrected = {line.id: line.text for line in build(text_of(PAPER), without=(row,))}
    lines = produced_by(PAPER)
    changed = [
        result.id
        for result in results_of(PAPER)
        if row in {r.id for r in result.rows}
        for change in next(r for r in result.rows if r.id == row).changes
        if [line.split() for line in lines[result.id]] != [corrected[change.line].split()]
    ]
    assert changed


def test_a_number_changed_is_found() -> None:
    lines = produced_by(PAPER)
    for result in results_of(PAPER):
        if KINDS[result.id] in (EXACT, CORRECTED):
            words = lines[result.id][-1].split()
            place = next(place for place, word in enumerate(words) if any(c.isdigit() for c in word))
            words[place] += "1"
            assert judge(PAPER, result, [*lines[result.id][:-1], " ".join(words)]).kind == DIFFERENT


def test_the_printed_values_are_in_the_print() -> None:
    """The witness holds 33 lines of values and no prose."""
    witness = files("transcripts").joinpath(PAPER.folder, "witness.txt").read_text(encoding="utf-8")
    assert len(witness.splitlines()) == 33
    assert max(map(len, witness.splitlines())) < 60


def test_table_5_the_vertices_each_row_implies() -> None:
    """By formula (6) every row but the first has our vertices, that for diameter 12 too."""
    lines = produced_by(PAPER)
    for result in results_of(PAPER):
        if not result.id.startswith("table5-"):
            continue
        faces, integers = map(int, result.corrected[0].split()[4:6])
        ours_faces, ours = map(int, lines[result.id][0].split()[4:6])
        assert (integers - 5 * faces) % 3 == 0
        same = (integers - 5 * faces) == (ours - 5 * ours_faces)
        assert same == (result.id != "table5-8")


def test_table_5_no_half_ball_has_the_printed_triangles() -> None:
    """Marching Cubes makes 2 N - 4 triangles of N squares; the reason given lists these numbers."""
    reason = next(result.cannot for result in results_of(PAPER) if result.id == "triangulations")
    for diameter in range(8, 23, 2):
        wide = np.pad(half_ball(diameter).array, 1)
        squares = sum(int(np.count_nonzero(np.diff(wide, axis=axis))) for axis in range(3))
        printed = next(r for r in results_of(PAPER) if r.id == f"table5-{diameter}").corrected[0].split()[1]
        assert str(2 * squares - 4) in reason.replace(",", "").split()
        assert int(printed) != 2 * squares - 4


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    try:
        code = main(["voxel-hull", *arguments])
    except SystemExit as end:
        code = int(end.code or 0)
    said = capsys.readouterr()
    return code, said.out, said.err


@pytest.fixture(autouse=True)
def _empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


WAYS = (
    "",
    "--order raster",
    "--coplanar visible",
    "--order shuffled",
    "--corners 6 --order shuffled --coplanar invisible",
)


def test_the_command_prints_what_the_paper_prints(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, err = run(capsys, "ball:32", "--corners", "6", "--coplanar", "invisible", "-o", "ball.off")
    assert (code, err) == (0, "coordinates: indices, voxel (x, y, z) from (x, y, z) to (x+1, y+1, z+1)\n")
    for number in ("17077", "776", "360", "1404", "266"):
        assert number in out.replace(",", "").split()
    found = parse_off(Path("ball.off").read_text(encoding="utf-8"), "ball.off")
    assert len(found.faces) == 266
    code, out, err = run(capsys, "ball:32", "--centres")
    assert "260 faces, 342 vertices, 600 edges" in out


def test_triangles_are_counted_where_an_order_is_asked_for(capsys: pytest.CaptureFixture[str]) -> None:
    """Without one, nothing is said of triangles; all else is the same."""
    said = {words: run(capsys, "ball:32", *words.split())[1].splitlines() for words in WAYS}
    assert said[""][2:4] == [
        "hull of 360 local corners: 266 faces, 360 vertices, 624 edges",
        "integers to save: 2410 for the cell list by (6), 2328 counted",
    ]
    assert said["--order raster"][2:5] == [
        "inserted: 360 local corners; 716 triangles",
        "merged: 266 faces, 360 vertices, 624 edges",
        "integers to save: 3222 for the triangles by (5), 2410 for the cell list by (6), 2328 counted",
    ]
    assert said["--coplanar visible"] == said["--order raster"]
    assert said["--order shuffled"][2] == "inserted: 360 local corners, shuffled; 716 triangles"
    assert "1404 triangles" not in said["--corners 6 --order shuffled --coplanar invisible"][2]
    assert {tuple(lines[:2] + lines[-4:]) for lines in said.values()} == {tuple(said[""][:2] + said[""][-4:])}


def test_straight_edges_are_merged_where_asked(capsys: pytest.CaptureFixture[str]) -> None:
    options = ("half-ball:8", "--corners", "6", "--coplanar", "invisible", "-o")
    run(capsys, *options, "kept.off")
    run(capsys, *options, "straight.off", "--straight")
    sizes = [
        len(parse_off(Path(f"{name}.off").read_text(encoding="utf-8"), name).points) for name in ("kept", "straight")
    ]
    assert sizes == [48, 44]


def test_cells_are_printed_as_tables(capsys: pytest.CaptureFixture[str]) -> None:
    Path("one.csv").write_text("0,0,0\n", encoding="utf-8")
    code, out, _ = run(capsys, "one.csv", "--cells", "--order", "raster")
    assert code == 0
    table = [line.split("\t") for line in out.splitlines() if "\t" in line]
    assert [row[0] for row in table] == ["Vertex", *"12345678", "Edge", *map(str, range(1, 13)), "Face", *"123456"]
    assert table[1][1] == "(0, 0, 0)"
    # 9/2 x 12 triangles; 3 x 8 vertices and 5 x 6 faces; the cube's faces have four vertices each.
    assert "integers to save: 54 for the triangles by (5), 54 for the cell list by (6), 48 counted" in out


@pytest.mark.parametrize(
    ("voxels", "says", "off"),
    [
        ("5,5,5\n", "flat: the hull is a point and has no cell list", "1 0 0"),
        ("0,0,0\n1,1,1\n", "flat: the hull is a segment and has no cell list", "2 0 1"),
        ("0,0,0\n1,0,0\n1,1,0\n0,1,0\n", "flat: the hull is a polygon of 4 vertices and has no cell list", "4 1 4"),
    ],
)
def test_flat_solids(capsys: pytest.CaptureFixture[str], voxels: str, says: str, off: str) -> None:
    Path("flat.csv").write_text(voxels, encoding="utf-8")
    code, out, _ = run(capsys, "flat.csv", "--centres", "-o", "flat.off")
    assert code == 0
    assert says in out
    assert Path("flat.off").read_text(encoding="utf-8").splitlines()[1] == off


def test_fill_writes_the_filled_hull(capsys: pytest.CaptureFixture[str]) -> None:
    Path("two.csv").write_text("3,0,0\n5,0,0\n3,0,0\n", encoding="utf-8")
    code, out, err = run(capsys, "two.csv", "--fill", "-o", "filled.npy")
    assert code == 0
    assert "two.csv: 1 of 3 voxels are listed before" in err
    assert "(segment): 3 voxels" in out
    assert "note: the array's first voxel is (3,0,0)" in err
    assert np.load("filled.npy").tolist() == [[[True]], [[True]], [[True]]]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("missing.npy",), "missing.npy: no such file or directory"),
        (("ball:8", "-o", "a.npy"), "a.npy: the name must end with one of .off"),
        (("ball:8", "-o", "a.json"), "a.json: the name must end with one of .off, .obj, .ply, .stl"),
        (("ball:8", "-o", "none/a.off"), "none/a.off: no such file or directory"),
        (("ball:8", "--fill", "-o", "a.off"), "a.off: a filled hull is written as an array"),
        (("ball:8", "--fill", "--cells"), "--cells is not for it"),
        (("ball:8", "--fill", "--corners", "6"), "--corners is not for it"),
        (("ball:8", "--fill", "--order", "raster"), "--order is not for it"),
        (("ball:8", "--shape", "2,2,x"), "--shape: '2,2,x' is not NX,NY,NZ"),
        (("ball:8", "--centres", "--vertices"), "not allowed with argument"),
        (("flat.npy",), "flat.npy: a picture of two dimensions"),
    ],
)
def test_bad_calls_end_with_one_line(
    capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...], message: str
) -> None:
    np.save("flat.npy", np.ones((3, 3), dtype=np.uint8))
    code, _, err = run(capsys, *arguments)
    assert code == 2
    assert message in err
    assert err.count("\n") == 1
    assert sorted(path.name for path in Path().iterdir()) == ["flat.npy"]


def test_too_little_memory_is_one_line(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    def too_much(*_: object) -> None:
        raise MemoryError

    monkeypatch.setattr("modern.cli.voxel_hull.voxel_hull", too_much)
    code, _, err = run(capsys, "ball:4")
    assert (code, err) == (2, "hull1620: there is not enough memory for this\n")
