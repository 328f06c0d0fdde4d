"""Every published result of Kovalevsky and Schulz compared with the computed one, and the command voxel-hull."""

from pathlib import Path

import numpy as np
import pytest

from modern.claims.published import CANNOT, CORRECTED, EXPLAINED, PAPERS, findings, produced_by, results_of
from modern.digital.solids import half_ball
from modern.edition.reproduce import EXACT
from modern.formats.off import parse_off
from tests.support.commands import call

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


def test_every_result_has_its_verdict() -> None:
    assert {finding.result.id: finding.kind for finding in findings(PAPER)} == KINDS


def test_the_rows_of_table_5_imply_our_vertices_except_for_diameter_8() -> None:
    """Formula (6) gives the number of vertices from the printed faces and integers."""
    lines = produced_by(PAPER)
    for result in results_of(PAPER):
        if not result.id.startswith("table5-"):
            continue
        faces, integers = map(int, result.corrected[0].split()[4:6])
        our_faces, our_integers = map(int, lines[result.id][0].split()[4:6])
        assert (integers - 5 * faces) % 3 == 0
        same = (integers - 5 * faces) == (our_integers - 5 * our_faces)
        assert same == (result.id != "table5-8")


def test_no_half_ball_has_the_triangles_printed_in_table_5() -> None:
    """Marching Cubes gives 2 N - 4 triangles for N squares. The stated reason lists these numbers."""
    reason = next(result.cannot for result in results_of(PAPER) if result.id == "triangulations")
    for diameter in range(8, 23, 2):
        padded = np.pad(half_ball(diameter).array, 1)
        squares = sum(int(np.count_nonzero(np.diff(padded, axis=axis))) for axis in range(3))
        printed = next(r for r in results_of(PAPER) if r.id == f"table5-{diameter}").corrected[0].split()[1]
        assert str(2 * squares - 4) in reason.replace(",", "").split()
        assert int(printed) != 2 * squares - 4


@pytest.fixture(autouse=True)
def _empty_folder(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)


WAYS = (
    "",
    "--order raster",
    "--coplanar visible",
    "--order shuffled",
    "--corners 6 --order shuffled --coplanar invisible",
)


def test_the_command_prints_the_numbers_of_the_paper(capsys) -> None:
    code, out, err = call(
        capsys, "voxel-hull", "ball:32", "--corners", "6", "--coplanar", "invisible", "-o", "ball.off"
    )
    assert (code, err) == (0, "coordinates: voxel indices; voxel (x, y, z) extends from (x, y, z) to (x+1, y+1, z+1)\n")
    for number in ("17077", "776", "360", "1404", "266"):
        assert number in out.replace(",", "").split()
    mesh = parse_off(Path("ball.off").read_text(encoding="utf-8"), "ball.off")
    assert len(mesh.faces) == 266
    code, out, err = call(capsys, "voxel-hull", "ball:32", "--centres")
    assert "260 faces, 342 vertices, 600 edges" in out


def test_triangles_are_reported_only_if_an_order_is_requested(capsys) -> None:
    output = {options: call(capsys, "voxel-hull", "ball:32", *options.split())[1].splitlines() for options in WAYS}
    assert output[""][2:4] == [
        "hull of 360 local corners: 266 faces, 360 vertices, 624 edges",
        "integers to save: 2410 for the cell list by the paper's formula (6), or 2328 by counting",
    ]
    assert output["--order raster"][2:5] == [
        "inserted: 360 local corners; 716 triangles",
        "merged: 266 faces, 360 vertices, 624 edges",
        "integers to save: 3222 for the triangles by the paper's formula (5), 2410 for the cell list by the "
        "paper's formula (6), or 2328 by counting",
    ]
    assert output["--coplanar visible"] == output["--order raster"]
    assert output["--order shuffled"][2] == "inserted: 360 local corners, shuffled; 716 triangles"
    assert "1404 triangles" not in output["--corners 6 --order shuffled --coplanar invisible"][2]
    assert {tuple(lines[:2] + lines[-4:]) for lines in output.values()} == {tuple(output[""][:2] + output[""][-4:])}


def test_straight_merges_edges_and_cells_are_printed_as_tables(capsys) -> None:
    options = ("half-ball:8", "--corners", "6", "--coplanar", "invisible", "-o")
    call(capsys, "voxel-hull", *options, "kept.off")
    call(capsys, "voxel-hull", *options, "straight.off", "--straight")
    sizes = [
        len(parse_off(Path(f"{name}.off").read_text(encoding="utf-8"), name).points) for name in ("kept", "straight")
    ]
    assert sizes == [48, 44]
    Path("one.csv").write_text("0,0,0\n", encoding="utf-8")
    code, out, _ = call(capsys, "voxel-hull", "one.csv", "--cells", "--order", "raster")
    assert code == 0
    table = [line.split("\t") for line in out.splitlines() if "\t" in line]
    assert [row[0] for row in table] == ["Vertex", *"12345678", "Edge", *map(str, range(1, 13)), "Face", *"123456"]
    assert table[1][1] == "(0, 0, 0)"
    # 9/2 x 12 triangles; 3 x 8 vertices and 5 x 6 faces; the cube's faces have four vertices each.
    assert (
        "integers to save: 54 for the triangles by the paper's formula (5), 54 for the cell list by the "
        "paper's formula (6), or 48 by counting" in out
    )


@pytest.mark.parametrize(
    ("voxels", "message", "off"),
    [
        ("5,5,5\n", "flat: the hull is a point and has no cell list", "1 0 0"),
        ("0,0,0\n1,1,1\n", "flat: the hull is a segment and has no cell list", "2 0 1"),
        ("0,0,0\n1,0,0\n1,1,0\n0,1,0\n", "flat: the hull is a polygon of 4 vertices and has no cell list", "4 1 4"),
    ],
)
def test_flat_hulls_are_reported(capsys, voxels: str, message: str, off: str) -> None:
    Path("flat.csv").write_text(voxels, encoding="utf-8")
    code, out, _ = call(capsys, "voxel-hull", "flat.csv", "--centres", "-o", "flat.off")
    assert code == 0
    assert message in out
    assert Path("flat.off").read_text(encoding="utf-8").splitlines()[1] == off


def test_fill_writes_the_filled_hull(capsys) -> None:
    Path("two.csv").write_text("3,0,0\n5,0,0\n3,0,0\n", encoding="utf-8")
    code, out, err = call(capsys, "voxel-hull", "two.csv", "--fill", "-o", "filled.npy")
    assert code == 0
    assert "two.csv: 1 of 3 voxels are repetitions" in err
    assert "(segment): 3 voxels" in out
    assert "note: the first voxel of the array is (3,0,0)" in err
    assert np.load("filled.npy").tolist() == [[[True]], [[True]], [[True]]]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("missing.npy",), "missing.npy: no such file or directory"),
        (("ball:8", "-o", "a.npy"), "a.npy: expected a name that ends with one of .off"),
        (("ball:8", "-o", "a.json"), "a.json: expected a name that ends with one of .off, .obj, .ply, .stl"),
        (("ball:8", "-o", "none/a.off"), "none/a.off: no such file or directory"),
        (("ball:8", "--fill", "-o", "a.off"), "a.off: a filled hull is written as an array"),
        (("ball:8", "--fill", "--cells"), "--cells has no effect with --fill"),
        (("ball:8", "--fill", "--corners", "6"), "--corners has no effect with --fill"),
        (("ball:8", "--fill", "--order", "raster"), "--order has no effect with --fill"),
        (("ball:8", "--shape", "2,2,x"), "--shape: expected NX,NY,NZ, found '2,2,x'"),
        (("ball:8", "--centres", "--vertices"), "not allowed with argument"),
        (("flat.npy",), "flat.npy: expected a volume of three dimensions, found two"),
    ],
)
def test_an_error_is_one_line(capsys, arguments: tuple[str, ...], message: str) -> None:
    np.save("flat.npy", np.ones((3, 3), dtype=np.uint8))
    code, _, err = call(capsys, "voxel-hull", *arguments)
    assert code == 2
    assert message in err
    assert err.count("\n") == 1
    assert sorted(path.name for path in Path().iterdir()) == ["flat.npy"]


def test_too_little_memory_is_one_line(monkeypatch, capsys) -> None:
    def too_much(*_: object) -> None:
        raise MemoryError

    monkeypatch.setattr("modern.cli.voxel_hull.voxel_hull", too_much)
    code, _, err = call(capsys, "voxel-hull", "ball:4")
    assert (code, err) == (2, "hull1620: not enough memory\n")
