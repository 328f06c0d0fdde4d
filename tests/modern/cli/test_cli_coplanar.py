"""``--coplanar-within``: merged faces are noted, and the hull is exact without the option."""

from pathlib import Path

import pytest

from tests.support.commands import call
from tests.support.solids import dodecahedron

SAID = "36 faces are joined into 12 within 1e-9; a vertex lies at most "


@pytest.fixture(autouse=True)
def room(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("d.csv").write_text("".join(f"{x!r},{y!r},{z!r}\n" for x, y, z in dodecahedron()), encoding="utf-8")
    Path("flat.csv").write_text("0,0,0\n1,0,0\n0,1,0\n", encoding="utf-8")


def test_export_and_draw_read_twelve_faces_and_note_it(capsys) -> None:
    code, out, err = call(capsys, "export", "d.csv", "--format", "off")
    assert (code, out.splitlines()[1].split()[:2], err) == (0, ["20", "36"], "")
    code, out, err = call(capsys, "export", "d.csv", "--format", "off", "--coplanar-within", "1e-9")
    assert (code, out.splitlines()[1]) == (0, "20 12 30")
    assert err.startswith(f"note: d.csv: {SAID}")
    assert err.count("\n") == 1
    code, out, err = call(capsys, "draw", "d.csv", "--coplanar-within", "1e-9")
    assert code == 0
    assert "20 vertices, 30 edges, 12 faces" in out
    assert SAID in err


def test_flat_input_and_faces_that_are_not_joined_are_noted(capsys) -> None:
    code, _, err = call(capsys, "export", "flat.csv", "--format", "off", "--coplanar-within", "1")
    assert (code, err) == (0, "note: flat.csv: the points lie in one plane: there are no faces to join\n")
    code, _, err = call(capsys, "export", "d.csv", "--format", "off", "--coplanar-within", "0")
    assert code == 0
    assert err.startswith(
        "note: d.csv: no two of 36 faces lie within 0 of one plane; another face is joined if the distance is at least"
    )


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("draw", "d.csv", "--coplanar-within", "2"), "d.csv: --coplanar-within: within 2 the 36 faces would become 2"),
        (("export", "d.csv", "-o", "d.off", "--coplanar-within", "9"), "all points lie within 9 of the plane"),
        (("draw", "d.csv", "--coplanar-within", "a"), "the distance within which faces are coplanar: 'a' is not"),
        (("draw", "d.csv", "--coplanar-within=-1"), "must be >= 0, not -1"),
        (("draw", "d.csv", "--coplanar-within", "1", "--stages"), "--coplanar-within cannot be combined with --stages"),
        (
            ("draw", "d.csv", "--coplanar-within", "1", "--against", "c"),
            "--coplanar-within cannot be combined with --stages",
        ),
    ],
)
def test_rejections_are_one_line_and_leave_no_file(arguments: tuple[str, ...], message: str, capsys) -> None:
    code, out, err = call(capsys, *arguments)
    assert (code, out, err.count("\n")) == (2, "", 1), err
    assert message in err
    assert {path.name for path in Path().iterdir()} == {"d.csv", "flat.csv"}
