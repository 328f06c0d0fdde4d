"""``hull1620 voxel-hull`` and ``octree-hull`` on scans: selection, notes, position and tables."""

import csv
import os
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from hull1620 import exact_hull, read_points, read_volume
from modern.digital.solids import Volume, ball
from modern.digital.volumes import write_array
from modern.digital.world import LPS, World
from tests.support.commands import call
from tests.support.paths import ROOT
from tests.support.volumefiles import PLACE, nrrd

STEPS = ((Fraction(1, 2), Fraction(0), Fraction(0)), (Fraction(0), Fraction(-1, 2), Fraction(0)))
WORLD = World(
    (*STEPS, (Fraction(0), Fraction(0), Fraction(2))), (Fraction(-10), Fraction(5), Fraction(1, 4)), LPS, "mm"
)


def scan() -> np.ndarray:
    """Write labels 1 (a block of 2 x 2 x 2), 2 (a single voxel) and 7 (a ball of 57 voxels without its middle)."""
    array = np.zeros((12, 12, 9), np.uint8)
    array[0:2, 0:2, 0:2] = 1
    array[3, 0, 0] = 2
    there = ball(5).array.copy()
    there[2, 2, 2] = False
    array[4 : 4 + there.shape[0], 4 : 4 + there.shape[1], 2 : 2 + there.shape[2]][there] = 7
    return array


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    array = scan()
    np.save("scan.npy", array)
    np.savez("scan.npz", scan=array, other=array[:2])
    Path("scan.nrrd").write_bytes(nrrd(array, *PLACE))


def test_the_selection_is_reported(capsys) -> None:
    words = {
        (): "values other than 0, of 0 to 7; 89 voxels",
        ("--label", "1"): "label 1 of 1, 2, 7; 8 voxels",
        ("--label", "7", "--label", "1", "--label", "7"): "labels 7, 1 of 1, 2, 7; 88 voxels",
        ("--threshold", "1.5"): "values of at least 1.5, of 0 to 7; 81 voxels",
    }
    for options, said in words.items():
        for command in ("voxel-hull", "octree-hull"):
            code, _, err = call(capsys, command, "scan.nrrd", *options)
            assert code == 0
            assert err.splitlines()[0] == f"scan.nrrd: {said}; spacing 0.5 0.5 2 mm"
    octree = call(capsys, "octree-hull", "scan.nrrd", "--tables")[2].splitlines()
    assert octree[1:] == ["coordinates: voxel indices; vertices are centres"]
    assert call(capsys, "voxel-hull", "scan.npy")[2].splitlines()[0].endswith("; no spacing stated")
    placed = call(capsys, "voxel-hull", "scan.npy", "--spacing", ".5,.5,2")[2].splitlines()[0]
    assert placed.endswith("spacing 0.5 0.5 2 (unit not stated)")


def test_the_meaning_of_coordinates_is_reported(capsys) -> None:
    assert call(capsys, "voxel-hull", "scan.nrrd")[2].splitlines()[1] == (
        "coordinates: left-posterior-superior; centre of voxel (0, 0, 0) at -10 5 0.25; the array's axes run left, "
        "anterior, superior; vertices are corners, half a voxel from centres"
    )
    ras = call(capsys, "voxel-hull", "scan.nrrd", "--space", "ras", "--centres")[2].splitlines()[1]
    assert ras.startswith("coordinates: right-anterior-superior; centre of voxel (0, 0, 0) at 10 -5 0.25; ")
    assert ras.endswith("run left, anterior, superior; vertices are centres")
    for words in (["scan.nrrd", "--space", "index"], ["scan.npy"]):
        assert call(capsys, "voxel-hull", *words)[2].splitlines()[1] == (
            "coordinates: voxel indices; voxel (x, y, z) extends from (x, y, z) to (x+1, y+1, z+1)"
        )
        assert call(capsys, "voxel-hull", *words, "--centres")[2].splitlines()[1] == (
            "coordinates: voxel indices; vertices are centres"
        )


@pytest.mark.parametrize("form", ["off", "obj", "ply", "stl"])
def test_a_label_becomes_a_mesh_in_millimetres(form: str, capsys) -> None:
    code, out, _ = call(capsys, "voxel-hull", "scan.nrrd", "--label", "1", "--straight", "-o", f"one.{form}")
    assert code == 0
    corners = {tuple(map(float, point)) for point in read_points(f"one.{form}")}
    assert corners == {(x, y, z) for x in (-10.25, -9.25) for y in (4.25, 5.25) for z in (-0.75, 3.25)}
    assert "volume of the voxels: 4 mm^3\n" in out
    assert "hull: volume 4 mm^3\nhull: area 18 mm^2\nsolidity 1; convex deficiency 0 mm^3\n" in out


def test_faces_stay_outward_if_an_axis_is_reversed(capsys) -> None:
    assert WORLD.mirrors
    call(capsys, "voxel-hull", "scan.nrrd", "--label", "7", "-o", "seven.off")
    lines = Path("seven.off").read_text(encoding="ascii").split("\n")
    count, faces, _ = map(int, lines[1].split())
    points = np.array([[float(word) for word in line.split()] for line in lines[2 : 2 + count]])
    for line in lines[2 + count : 2 + count + faces]:
        a, b, c = points[[int(word) for word in line.split()[1:4]]]
        normal = np.cross(b - a, c - a)
        assert ((points - a) @ normal <= 1e-12).all()
        assert ((points - a) @ normal).min() < 0


def test_the_measures_of_a_hull_are_printed(capsys) -> None:
    call(capsys, "voxel-hull", "scan.nrrd", "--label", "7", "--straight", "-o", "seven.off")
    out = call(capsys, "voxel-hull", "scan.nrrd", "--label", "7")[1].splitlines()
    judged = exact_hull(read_points("seven.off"))
    assert "volume of the voxels: 40 mm^3" in out
    volume, area = judged.volume, judged.area.digits
    assert any(line.startswith(f"hull: volume {volume}, about ") and line.endswith(" mm^3") for line in out)
    (said,) = [line for line in out if line.startswith("hull: area ")]
    assert said.endswith(" mm^2, to 50 digits")
    assert said.split()[2][:49] == str(area)[:49]
    assert any(line.startswith(f"solidity {40 / volume}, about 0.") for line in out)
    centres = call(capsys, "voxel-hull", "scan.nrrd", "--label", "2", "--centres")[1].splitlines()
    assert centres[-3:] == ["volume of the voxels: 0.5 mm^3", "hull: volume 0 mm^3", "hull: area 0 mm^2"]


def test_each_label_has_a_row_and_a_mesh(capsys) -> None:
    code, out, err = call(capsys, "voxel-hull", "scan.nrrd", "--each-label", "--csv", "t.csv", "-o", "label-%02d.stl")
    assert code == 0
    assert sorted(path.name for path in Path().glob("label-*")) == ["label-01.stl", "label-02.stl", "label-07.stl"]
    assert err.startswith("scan.nrrd: 3 labels; spacing 0.5 0.5 2 mm\ncoordinates: left-posterior-superior;")
    head, *rows, foot = out.splitlines()
    assert head.split() == "label voxels volume hull volume hull area solidity deficiency".split()
    assert rows[0].split() == ["1", "8", "4", "4", "18", "1", "0"]
    assert [row.split()[:2] for row in rows] == [["1", "8"], ["2", "1"], ["7", "80"]]
    assert foot == "lengths in mm; numbers to 12 digits (--csv: 50 digits and exact fractions)"
    with open("t.csv", encoding="ascii", newline="") as file:
        table = list(csv.DictReader(file))
    assert [row["unit"] for row in table] == ["mm"] * 3
    for row in table:
        hull = exact_hull(read_points(f"label-{int(row['label']):02d}.stl"))
        assert Fraction(row["hull_volume_exact"]) == hull.volume
        assert abs(Fraction(row["hull_volume"]) - hull.volume) <= hull.volume / 10**49
        assert abs(Fraction(row["hull_area"]) - Fraction(hull.area.digits)) <= Fraction(hull.area.digits) / 10**48
        assert Fraction(row["solidity_exact"]) == Fraction(row["volume"]) / hull.volume
        assert Fraction(row["deficiency_exact"]) == hull.volume - Fraction(row["volume"])


def test_selected_labels_have_rows_for_centres_and_filled_hulls(capsys) -> None:
    some = call(capsys, "voxel-hull", "scan.nrrd", "--each-label", "--label", "7", "--label", "2")[1].splitlines()
    assert [line.split()[0] for line in some] == ["label", "7", "2", "lengths"]
    centres = call(capsys, "voxel-hull", "scan.nrrd", "--each-label", "--centres")[1].splitlines()
    assert centres[0].split() == "label voxels volume hull volume hull area".split()
    assert centres[1].split() == ["1", "8", "4", "0.5", "4.5"]
    code, out, _ = call(capsys, "voxel-hull", "scan.npy", "--each-label", "--fill", "-o", "f-%d.nrrd", "--csv", "f.csv")
    assert code == 0
    assert out.splitlines()[3].split()[:5] == ["7", "80", "81", "0.987654320988", "1"]
    assert out.splitlines()[-1].startswith("lengths in voxels; ")
    assert read_volume("f-7.nrrd").count == 81
    assert "80/81" in Path("f.csv").read_text(encoding="ascii").splitlines()[3]


def test_a_filled_hull_keeps_the_position_of_the_scan(capsys) -> None:
    code, out, err = call(capsys, "voxel-hull", "scan.nrrd", "--label", "7", "--fill", "-o", "filled.nrrd")
    assert (code, "note" in err) == (0, False)
    assert out.endswith("polyhedron): 81 voxels\nsolidity, counted in voxels: 80/81; convex deficiency: 1 voxel\n")
    assert read_volume("filled.nrrd").world == WORLD
    call(capsys, "octree-hull", "scan.nrrd", "--label", "7", "-o", "octree.nrrd")
    assert Path("octree.nrrd").read_bytes() == Path("filled.nrrd").read_bytes()
    err = call(capsys, "voxel-hull", "scan.nrrd", "--fill", "-o", "filled.npy")[2]
    assert "note: filled.npy contains no spacing and no origin; an .nrrd file would contain them\n" in err
    call(capsys, "voxel-hull", "scan.nrrd", "--fill", "--space", "ras", "-o", "ras.nrrd")
    assert read_volume("ras.nrrd").world == WORLD.turned("right-anterior-superior")
    call(capsys, "voxel-hull", "scan.nrrd", "--fill", "--space", "index", "-o", "index.nrrd")
    assert read_volume("index.nrrd").world is None


def test_one_of_several_arrays_is_named(capsys) -> None:
    assert call(capsys, "voxel-hull", "scan.npz", "--array", "scan", "--label", "1")[0] == 0
    np.savez("one.npz", scan=scan())
    assert call(capsys, "voxel-hull", "one.npz")[0] == 0


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("scan.nrrd --label 9", "scan.nrrd: no voxel has the label 9; the labels are 1, 2, 7"),
        ("scan.nrrd --label x", "argument --label: invalid int value: 'x'"),
        ("scan.nrrd --threshold 8", "the greatest value is 7, below the threshold 8"),
        ("scan.nrrd --threshold high", "--threshold: 'high' is not a decimal number"),
        ("scan.nrrd --threshold 1 --label 1", "a threshold and labels cannot be combined"),
        ("scan.nrrd --spacing 1,1,1", "the file states the position of its voxels"),
        ("scan.npy --spacing 1,1", "scan.npy: spacing: expected 3 numbers, found 2"),
        ("scan.npy --spacing 1,x,1", "--spacing: 'x' is not a decimal number"),
        ("scan.npy --spacing 1,0,1", "scan.npy: the spacing of an axis is 0"),
        ("scan.npy --space ras", "--space ras: the file does not state where its voxels lie"),
        ("scan.npy --spacing 1,1,1 --space lps", "--space lps: the file's space is not named"),
        ("scan.npz", "scan.npz: found 2 arrays; select one with --array: other, scan"),
        ("scan.npz --array third", "scan.npz: there is no array 'third'; the file has other, scan"),
        ("scan.npy --array scan", "scan.npy: an array can be selected only in an NPZ file"),
        ("scan.npy --series 1", "scan.npy: a series can be selected only in a folder of DICOM files"),
        ("scan.nrrd --each-label -o a.off", "'a.off' has no place for a label; write a name such as 'label-%d.off'"),
        ("scan.nrrd --each-label -o a-%d.json", "a-%d.json: expected a name that ends with one of .off"),
        ("scan.nrrd --each-label --fill -o a-%d.off", "expected a name that ends with .npy or .nrrd"),
        ("scan.nrrd --each-label --fill -o a-%d.npy", "only a .nrrd file can hold the position of a label"),
        ("scan.nrrd --each-label --cells", "--cells prints one hull"),
        ("scan.nrrd --each-label --threshold 1", "--threshold cannot be combined"),
        ("scan.nrrd --each-label --label 9", "no voxel has the label 9"),
        ("scan.nrrd --csv t.csv", "--csv needs --each-label"),
        ("scan.nrrd --each-label --csv scan.nrrd", "scan.nrrd: this output is also an input"),
        ("scan.nrrd --fill -o a.off", "expected a name that ends with .npy or .nrrd"),
    ],
)
def test_invalid_requests_are_reported_in_one_line(words: str, message: str, capsys) -> None:
    before = sorted(Path().iterdir())
    code, out, err = call(capsys, "voxel-hull", *words.split())
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert message in err
    assert sorted(Path().iterdir()) == before


@pytest.mark.parametrize(("shape", "code"), [("(2L, 2L, 2L)", 0), ("(2if 1 else 3, 2, 2)", 2)])
def test_warnings_of_python_about_a_header_are_not_shown(shape: str, code: int) -> None:
    """numpy parses the header as Python source, which gives warnings, also for headers of Python 2."""
    head = f"{{'descr': '|u1', 'fortran_order': False, 'shape': {shape}, }}".ljust(117) + "\n"
    Path("a.npy").write_bytes(b"\x93NUMPY\x01\x00" + len(head).to_bytes(2, "little") + head.encode() + b"\1" * 8)
    words = [sys.executable, "-W", "always", "-m", "modern.cli.main", "voxel-hull", "a.npy"]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(words, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == code
    assert [line.split(":")[0] for line in done.stderr.splitlines()] == (
        ["hull1620"] if code else ["a.npy", "coordinates"]
    )


def test_a_name_that_writes_two_labels_to_one_file_is_rejected(capsys) -> None:
    """A width does not truncate a number, so names differ. A missing folder is reported before anything is written."""
    code, _, err = call(capsys, "voxel-hull", "scan.nrrd", "--each-label", "-o", "absent/label-%d.off")
    assert (code, err.count("\n")) == (2, 1)
    assert "absent" in err


def test_a_picture_is_filled_and_has_no_polyhedron(capsys) -> None:
    picture = Volume(scan()[:, :, 0] > 0, (0, 0))
    write_array("picture.npy", picture.array, picture)
    assert call(capsys, "voxel-hull", "picture.npy", "--fill", "--spacing", "1,2")[0] == 0
    code, _, err = call(capsys, "voxel-hull", "picture.npy")
    assert code == 2
    assert "expected a volume of three dimensions, found two" in err
