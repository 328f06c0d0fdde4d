"""Tests of scenes whose parts are files, and of files with faces drawn without a scene."""

from fractions import Fraction
from pathlib import Path
from xml.etree import ElementTree

import pytest

from modern.formats.export import export_text
from modern.papers.nakamae_nishita.hidden import draw
from modern.papers.nakamae_nishita.projection import parallel
from modern.papers.nakamae_nishita.scenes import read
from tests.support.commands import call
from tests.support.solids import CUBE, CUBE_FACES, ELL, ELL_FACES, binary_stl, cut, twelve_faces
from tests.support.visibility import Judge, wrong

SCENE = """title = "Three files"
[view]
eye = [4, -7, 5]
[[part]]
name = "dodecahedron"
file = "d.off"
coplanar_within = 1e-9
at = [0, 0, 3]
[[part]]
file = "parts/boxes.stl"
at = [4, 0, 0]
count = [1, 2, 1]
step = [0, 4, 0]
[[part]]
name = "ell"
file = "ell.obj"
hull = true
scale = 0.5
turn = 90
at = [-3, -2, 0]
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch) -> Path:
    monkeypatch.chdir(tmp_path)
    inner = tmp_path / "scenes"
    (inner / "parts").mkdir(parents=True)
    (inner / "d.off").write_text(export_text(twelve_faces(), "off"))
    boxes = [[(x + 2 * k, y, z) for x, y, z in CUBE] for k in range(2)]
    (inner / "parts" / "boxes.stl").write_bytes(binary_stl([t for box in boxes for t in cut(box, CUBE_FACES)]))
    rows = [f"v {x} {y} {z}\n" for z in (0, 1) for x, y in ELL]
    rows += ["f " + " ".join(str(k + 1) for k in face) + "\n" for face in ELL_FACES]
    (inner / "ell.obj").write_text("".join(rows))
    (inner / "three.toml").write_text(SCENE)
    return tmp_path


def test_paths_of_parts_are_relative_to_the_folder_of_the_scene(folder: Path, capsys) -> None:
    polyhedra = read("scenes/three.toml").make()
    assert [len(polyhedron.vertices) for polyhedron in polyhedra] == [20, 8, 8, 8, 8, 10]
    assert polyhedra[1].name == "scenes/three.toml: part 2, component 1 of 2, copy 1,1,1"
    ell = polyhedra[-1].vertices
    assert {p[2] for p in ell} == {0, Fraction(1, 2)}
    assert (min(p[0] for p in ell), max(p[1] for p in ell)) == (Fraction(-9, 2), Fraction(-1, 2))
    exact_parts = polyhedra[1:]
    assert wrong(draw(exact_parts, parallel((4, -7, 5))), Judge(exact_parts, direction=(4, -7, 5)))[0] == []
    code, out, err = call(capsys, "hidden-line", "scenes/three.toml", "-o", "a.svg")
    assert (code, out) == (0, "")
    notes = err.splitlines()[:-2]
    assert notes[0].startswith("note: scenes/three.toml: part 1 (dodecahedron): d.off: 36 faces are joined into 12")
    assert notes[1:] == [
        "note: scenes/three.toml: part 2: parts/boxes.stl: 2 connected components",
        "note: scenes/three.toml: part 3 (ell): ell.obj: not convex, replaced by its hull",
    ]
    assert len(list(ElementTree.parse("a.svg").iter())) > 40


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('"d.off"', '"none.off"', "part 1 (dodecahedron): file: none.off: no such file or directory"),
        ('"d.off"', '""', "part 1 (dodecahedron): file: a file without a name cannot be read"),
        ('"d.off"', "3", "part 1: file: expected a string"),
        ('"d.off"', '"three.toml"', "part 1 (dodecahedron): file: three.toml: expected faces, found only points"),
        ("coplanar_within = 1e-9\n", "", "part 1 (dodecahedron): file: d.off: face 1 is not plane: a vertex"),
        ("1e-9", "-1", "must be >= 0, not -1"),
        ("1e-9", "7", "part 1 (dodecahedron): file: d.off: all points lie within 7 of the plane"),
        ("hull = true\n", "", "part 3 (ell): file: ell.obj: not convex: between faces 5 and 6"),
        ("hull = true\n", "hull = 1\n", "part 3: hull: expected true or false"),
        ("scale = 0.5", "scale = 0", "part 3: scale: expected a number greater than 0"),
        ('"ell"\n', '"ell"\nshape = "cuboid"\n', "part 3: file: expected a shape or a file, found both"),
        ("step = [0, 4, 0]\n", "figures = [[[0, 0, 0]]]\nstep = [0, 4, 0]\n", "figures need one connected component"),
        ("count = [1, 2, 1]", "count = [1, 10001, 1]", "at least 1 copy along each axis and at most 20,000"),
        ("at = [4, 0, 0]\n", "hul = true\n", "part 2: 'hul' is not a known field of this table"),
    ],
)
def test_an_invalid_part_is_rejected_with_one_line(folder: Path, old: str, new: str, message: str, capsys) -> None:
    assert SCENE.count(old) == 1
    Path("scenes/three.toml").write_text(SCENE.replace(old, new), encoding="utf-8")
    code, out, err = call(capsys, "hidden-line", "scenes/three.toml", "-o", "a.svg")
    assert (code, out, err.count("\n")) == (2, "", 1), err
    assert message in err
    assert not Path("a.svg").exists()


def test_the_command_draws_files_with_faces(folder: Path, capsys) -> None:
    code, out, err = call(capsys, "hidden-line", "scenes/parts/boxes.stl")
    assert (code, err.splitlines()[0]) == (0, "note: scenes/parts/boxes.stl: 2 connected components")
    assert len(list(ElementTree.fromstring(out).iter("{http://www.w3.org/2000/svg}line"))) == 18
    code, _, err = call(capsys, "hidden-line", "scenes/ell.obj", "-o", "a.svg")
    assert code == 2
    assert "take its hull (--hull), or, if the cause is rounding, merge faces within a distance (--coplanar" in err
    assert call(capsys, "hidden-line", "scenes/ell.obj", "--hull", "-o", "a.svg")[0] == 0
    code, _, err = call(capsys, "hidden-line", "scenes/d.off", "--coplanar-within", "1e-9", "-o", "a.svg")
    assert (code, err.count("36 faces are joined into 12")) == (0, 1)
    code, _, err = call(capsys, "hidden-line", "house", "--hull")
    assert (code, err) == (
        2,
        "hull1620: --hull and --coplanar-within need a file of faces or points; "
        "in a scene file, set hull and coplanar_within\n",
    )


def test_an_output_never_overwrites_a_file_of_the_scene(folder: Path, capsys) -> None:
    Path("scenes/ell.obj").rename("scenes/ell.svg")
    before = Path("scenes/ell.svg").read_text(encoding="utf-8")
    Path("scenes/three.toml").write_text(SCENE.replace("ell.obj", "ell.svg"), encoding="utf-8")
    code, _, err = call(capsys, "hidden-line", "scenes/three.toml", "-o", "scenes/ell.svg")
    assert code == 2
    assert err.startswith(
        "hull1620: scenes/ell.svg: this output is also a file of the scene, which would be overwritten"
    )
    assert Path("scenes/ell.svg").read_text(encoding="utf-8") == before
