"""The command ``hull1620 octree-hull``, and the filled hull of ``hull1620 voxel-hull --fill``."""

import re
from pathlib import Path

import numpy as np
import pytest

from modern.formats.off import parse_off
from modern.papers.yau_srihari.printed import NAMES
from tests.support.commands import call
from tests.support.digital_judge import judged, solid_of

STAIR = "x,y,z\n5,0,-1\n5,1,-1\n5,1,0\n6,0,-1\n6,0,0\n6,1,0\n6,2,0\n"


@pytest.fixture
def stair(tmp_path: Path, monkeypatch) -> str:
    monkeypatch.chdir(tmp_path)
    Path("stair.csv").write_text(STAIR, encoding="utf-8")
    return "stair.csv"


def test_tables_print_every_stage_in_the_coordinates_of_the_input(stair: str, capsys) -> None:
    code, out, err = call(capsys, "octree-hull", stair, "--tables")
    assert (code, err) == (0, "")
    assert out == (
        "stair.csv: 7 voxels, an octree of 25 nodes over a cube of side 4\n"
        "floor, x to the right, y up:\n"
        "  2 |  .  0\n"
        "  1 | -1  0\n"
        "  0 | -1 -1\n"
        "       5  6\n"
        "ceiling, x to the right, y up:\n"
        "  2 |  .  0\n"
        "  1 |  0  0\n"
        "  0 | -1  0\n"
        "       5  6\n"
        "floor: 4 of 5 columns are in the reduced set (possible vertices):\n"
        "  (5,0,-1) (5,1,-1) (6,0,-1) (6,2,0)\n"
        "floor: 2 faces, outward normal and vertices:\n"
        "  (0,0,-1): (6,0,-1) (5,0,-1) (5,1,-1)\n"
        "  (1,1,-2): (6,2,0) (6,0,-1) (5,1,-1)\n"
        "ceiling: 4 of 5 columns are in the reduced set (possible vertices):\n"
        "  (5,0,-1) (5,1,0) (6,0,0) (6,2,0)\n"
        "ceiling: 2 faces, outward normal and vertices:\n"
        "  (-1,-1,1): (5,1,0) (5,0,-1) (6,0,0)\n"
        "  (0,0,1): (5,1,0) (6,0,0) (6,2,0)\n"
        "digital hull: 7 voxels, an octree of 25 nodes\n"
    )


def test_the_default_output_is_a_summary(stair: str, capsys) -> None:
    code, out, err = call(capsys, "octree-hull", stair)
    assert (code, err) == (0, "")
    assert out == (
        "stair.csv: 7 voxels, an octree of 25 nodes over a cube of side 4\n"
        "floor: 4 of 5 columns are in the reduced set (possible vertices); 2 faces\n"
        "ceiling: 4 of 5 columns are in the reduced set (possible vertices); 2 faces\n"
        "digital hull: 7 voxels, an octree of 25 nodes\n"
    )
    assert call(capsys, "octree-hull", "ball:16")[1].count("\n") == 4


@pytest.mark.parametrize(
    ("name", "voxels"),
    [
        ("stair", STAIR),
        ("row", "x,y,z\n4,4,4\n6,8,4\n"),
        ("layer", "x,y,z\n0,0,7\n3,0,7\n0,3,7\n"),
        ("upright", "x,y,z\n0,0,0\n3,3,0\n0,0,9\n"),
        ("one", "x,y,z\n-3,5,6\n"),
        ("box", "x,y,z\n" + "".join(f"{x},{y},{z}\n" for x in range(4) for y in range(3) for z in range(3))),
        ("roof", "x,y,z\n" + "".join(f"{x},{y},{z}\n" for x in range(5) for y in range(4) for z in range(y + 1))),
        ("plane", "x,y\n2,2\n5,2\n2,9\n"),
    ],
)
def test_the_mesh_is_that_of_export_for_the_centres_of_the_voxels(stair: str, name: str, voxels: str, capsys) -> None:
    Path("v.csv").write_text(voxels, encoding="utf-8")
    rows = [row if row.count(",") == 2 else f"{row},0" for row in voxels.split()[1:]]
    Path("p.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
    assert call(capsys, "octree-hull", "v.csv", "-o", "v.off")[0] == 0
    assert call(capsys, "export", "p.csv", "-o", "p.off")[0] == 0
    actual, expected = (
        (set(mesh.points), {frozenset(mesh.points[k] for k in face) for face in mesh.faces})
        for mesh in (parse_off(Path(name).read_text(encoding="utf-8"), name) for name in ("v.off", "p.off"))
    )
    assert actual == expected


def test_notes_offsets_and_components_are_reported(stair: str, capsys) -> None:
    Path("far.csv").write_text("0,0,0\n0,0,0\n999999999,0,0\n", encoding="utf-8")
    code, out, err = call(capsys, "octree-hull", "far.csv", "-o", "far.npy")
    assert (code, out, err.count("\n")) == (2, "", 1), err
    Path("twice.csv").write_text("0,0,0\n0,0,0\n", encoding="utf-8")
    note = "note: twice.csv: 1 of 2 voxels are repetitions\n"
    assert call(capsys, "octree-hull", "twice.csv")[::2] == (0, note)
    assert call(capsys, "octree-hull", stair, "-o", "hull.npy")[2] == "note: the first voxel of the array is (5,0,-1)\n"
    Path("apart.csv").write_text("0,0\n4,2\n", encoding="utf-8")
    code, out, _ = call(capsys, "octree-hull", "apart.csv", "--tables")
    assert code == 0
    assert "its columns lie on one line; vertices of its envelope:\n  (0,0,0) (4,2,0)\n" in out
    assert out.endswith(
        "digital points of the hull of 2 parts that no voxel faces connect: 3 voxels, an octree of 49 nodes\n"
    )


def test_faces_run_counterclockwise_seen_from_outside(stair: str, capsys) -> None:
    out = call(capsys, "octree-hull", stair, "--tables")[1]
    faces = re.findall(r"^  (\S+): (\S+) (\S+) (\S+)", out, re.MULTILINE)
    assert len(faces) == 4
    for face in faces:
        normal, *points = (np.array([int(number) for number in text.strip("()").split(",")]) for text in face)
        normal_of_points = np.cross(points[1] - points[0], points[2] - points[0])
        assert normal_of_points @ normal > 0
        assert not np.cross(normal_of_points, normal).any()


def test_the_trace_has_a_step_for_every_face(stair: str, capsys) -> None:
    out = call(capsys, "octree-hull", stair, "--trace")[1]
    assert [line for line in out.splitlines() if line.startswith("  step")] == [
        "  step 1: edge (6,0,-1)-(5,0,-1) of a face with normal (0,-1,0)",
        "  step 2: edge (6,2,0)-(6,0,-1) of a face with normal (1,0,0)",
        "  step 1: edge (6,0,0)-(5,0,-1) of a face with normal (0,-1,0)",
        "  step 2: edge (6,2,0)-(6,0,0) of a face with normal (1,0,0)",
    ]
    assert (
        "    pushed (6,0,-1)-(5,1,-1)\n    removed (5,0,-1)-(5,1,-1)\n    3 values recorded, 3 edges in the queue"
        in out
    )


def test_literal_reports_the_difference_and_gives_exit_code_1(stair: str, capsys) -> None:
    code, out, err = call(capsys, "octree-hull", stair, "--literal")
    assert code == 1
    assert out.endswith(
        "digital hull: 8 voxels, an octree of 25 nodes\n"
        "compared with the corrected algorithm: 0 voxels missing, 1 extra\n"
    )
    assert f"note: these statements are applied as the paper prints them: {', '.join(NAMES)}\n" in err
    assert "note: floor: no point found for 4 of 6 edges" in err


def test_printed_statements_that_change_nothing_give_exit_code_0(stair: str, capsys) -> None:
    Path("row.csv").write_text("0,0,0\n1,0,0\n2,0,0\n", encoding="utf-8")
    code, out, err = call(capsys, "octree-hull", "row.csv", "--printed", "marks, start")
    assert code == 0
    assert out.endswith("compared with the corrected algorithm: 0 voxels missing, 0 extra\n")
    assert err == "note: these statements are applied as the paper prints them: start, marks\n"


@pytest.mark.parametrize("command", [["octree-hull"], ["voxel-hull", "--fill"]])
def test_the_filled_hull_is_written_as_an_array(stair: str, command: list[str], capsys) -> None:
    Path("far.csv").write_text("0,0,0\n3,3,3\n0,3,0\n3,0,0\n", encoding="utf-8")
    code, _, _ = call(capsys, *command, "far.csv", "-o", "hull.npy")
    assert code == 0
    expected = judged(solid_of([(0, 0, 0), (3, 3, 3), (0, 3, 0), (3, 0, 0)]))[1]
    assert np.array_equal(np.load("hull.npy"), expected)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["stair.csv", "--printed", "angel"], "--printed: 'angel' is not one of the names angle, start"),
        (["stair.csv", "--printed", ""], "--printed: '' is not one of the names angle, start"),
        (["stair.csv", "--literal", "--printed", "angle"], "not allowed with argument"),
        (["stair.csv", "-o", "hull.svg"], "hull.svg: octree-hull expects a name that ends with .nrrd or .npy or .off"),
        (["stair.csv", "-o", "no/hull.npy"], "no/hull.npy: no such file or directory"),
        (["none.csv"], "none.csv: no such file or directory"),
        (["."], "is a directory"),
        (["ball:0"], "ball:0"),
        (["stair.csv", "--shape", "1,b"], "--shape: expected NX,NY,NZ, found '1,b'"),
    ],
)
def test_an_error_is_one_line(stair: str, arguments: list[str], message: str, capsys) -> None:
    code, out, err = call(capsys, "octree-hull", *arguments)
    assert (code, out) == (2, "")
    assert err.count("\n") == 1
    assert message in err
    assert not list(Path().glob("*.npy"))
